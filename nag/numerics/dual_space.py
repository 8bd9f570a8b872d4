"""The dual space of a local ring, degree by degree: its dimension is the multiplicity.

A functional takes coefficients of a power series: it is given by a weight for each monomial. The
dual space of an ideal consists of those that vanish on it; multiplying by a variable shifts such a
functional to one of lower degree. So the functionals of degree k are put together from those of
lower degree, and matrices are as large as the multiplicity, not as the number of monomials.

References:
    Mourrain, Isolated points, duality and residues, 1997;
    Dayton & Zeng, Computing the multiplicity structure in solving polynomial systems, 2005.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from nag.numerics.ball_ranks import Field
from nag.numerics.power_series import Series, SeriesRing

# Local rings of higher dimension are not worked out.
MOST_FUNCTIONALS = 400


@dataclass(frozen=True, eq=False)
class DualSpace:
    """The dual space up to some degree.

    Attributes:
        hilbert: the number of functionals of each degree, from 0 on.
        finite: whether there are none of higher degree; then the zero is isolated.
    """

    hilbert: tuple[int, ...]
    finite: bool

    @property
    def dimension(self) -> int:
        return sum(self.hilbert)


@dataclass(eq=False)
class _Basis:
    """Functionals so far: those of the last degree are added at the end.

    Attributes:
        keys: monomials that have a weight in some functional, and their places.
        functionals: the weights of each, as many as ``keys``.
        leading: for each functional a monomial that has weight 1 there and 0 in those added with
            it and after it.
        shifts: for each variable, what multiplication with it makes of each functional.
    """

    keys: dict[int, int]
    functionals: list[list[Any]]
    leading: list[int]
    shifts: list[list[list[Any]]]

    @property
    def size(self) -> int:
        return len(self.functionals)


def dual_space(
    field: Field,
    m: int,
    series: Callable[[int], tuple[SeriesRing, Sequence[Series]]],
    highest: int,
    stop: Callable[[Sequence[int]], bool],
) -> DualSpace:
    """The dual space at the origin of equations in ``m`` variables, up to degree ``highest``.

    Args:
        field: the arithmetic.
        m: number of variables.
        series: the equations as power series, of the order that is asked for at least.
        highest: the last degree.
        stop: told the numbers of functionals of each degree so far, says whether to go no further.

    Raises:
        nag.numerics.ball_ranks.UnclearRank: if a rank cannot be read.
    """
    if m == 1:
        return _in_one_variable(series, highest, stop)
    basis = _Basis({0: 0}, [[1]], [0], [[[0]] for _ in range(m)])
    hilbert = [1]
    ring, equations = series(min(2, highest))
    for degree in range(1, highest + 1):
        if degree > ring.order:
            # In many variables longer series cost more than making them again.
            more = max(2, ring.order // 2) if m == 2 else max(1, ring.order // (m + 1))
            ring, equations = series(min(ring.order + more, highest))
        found = _next(field, ring, equations, basis)
        if not found:
            return DualSpace(tuple(hilbert), True)
        hilbert.append(len(found))
        if sum(hilbert) > MOST_FUNCTIONALS or stop(hilbert):
            break
        _extend(field, ring, basis, found)
    return DualSpace(tuple(hilbert), False)


def _in_one_variable(
    series: Callable[[int], tuple[SeriesRing, Sequence[Series]]],
    highest: int,
    stop: Callable[[Sequence[int]], bool],
) -> DualSpace:
    """One functional for each degree below that of the lowest term."""
    ring, equations = series(min(2, highest))
    hilbert = [1]
    for degree in range(1, highest + 1):
        if degree > ring.order:
            ring, equations = series(min(2 * ring.order, highest))
        if any(degree * ring.unit(0) in f for f in equations):
            return DualSpace(tuple(hilbert), True)
        hilbert.append(1)
        if len(hilbert) > MOST_FUNCTIONALS or stop(hilbert):
            break
    return DualSpace(tuple(hilbert), False)


def _next(
    field: Field, ring: SeriesRing, equations: Sequence[Series], basis: _Basis
) -> list[list[Any]]:
    """New functionals, each as the coefficients of its shifts in the basis."""
    s, m = basis.size, ring.m
    turned = [[list(row) for row in zip(*shift, strict=True)] for shift in basis.shifts]
    rows: list[list[Any]] = []
    for first, second in combinations(range(m), 2):
        between, after = [0] * ((second - first - 1) * s), [0] * ((m - second - 1) * s)
        for plus, minus in zip(turned[second], turned[first], strict=True):
            if any(plus) or any(minus):
                negative = [-c if c else 0 for c in minus]
                rows.append([0] * (first * s) + plus + between + negative + after)
    rows += _weights(field, ring, basis, equations)
    for key in basis.leading[1:]:
        row: list[Any] = [0] * (s * m)
        k = _first(ring, key)
        place = basis.keys.get(key - ring.unit(k))
        if place is not None:
            row[k * s : (k + 1) * s] = [weights[place] for weights in basis.functionals]
        rows.append(row)
    return field.null_space(rows, s * m)


def _first(ring: SeriesRing, key: int) -> int:
    """The first variable in a monomial."""
    return next(i for i, e in enumerate(ring.exponents(key)) if e)


def _weights(
    field: Field, ring: SeriesRing, basis: _Basis, equations: Sequence[Series]
) -> list[list[Any]]:
    """What a functional makes of equations, as linear forms in the coefficients of its shifts."""
    m, count = ring.m, len(equations)
    # A monomial counts for its first variable, taken out of it.
    lowered: list[list[Any]] = [[0] * (m * count) for _ in basis.keys]
    first: dict[int, int] = {}
    for number, f in enumerate(equations):
        for key, c in f.items():
            if not key:
                continue
            k = first.setdefault(key, -1)
            if k < 0:
                k = first[key] = _first(ring, key)
            place = basis.keys.get(key - ring.unit(k))
            if place is not None:
                lowered[place][number * m + k] = c
    found = field.product(basis.functionals, lowered)
    columns = list(zip(*found, strict=True))
    return [
        [c for k in range(m) for c in columns[number * m + k]] for number in range(count) if columns
    ]


def _extend(field: Field, ring: SeriesRing, basis: _Basis, found: list[list[Any]]) -> None:
    """Add the functionals with these shifts, reduced so that each has a monomial of its own."""
    s, m = basis.size, ring.m
    keys: dict[int, int] = {}
    moves: list[list[tuple[int, int]]] = []
    for k in range(m):
        here = [(p, key) for key, p in basis.keys.items() if not any(ring.exponents(key)[:k])]
        moves.append([(p, keys.setdefault(key + ring.unit(k), len(keys))) for p, key in here])
    rows = [[*[0] * len(keys), *vector] for vector in found]
    for k in range(m):
        part = field.product([v[k * s : (k + 1) * s] for v in found], basis.functionals)
        for row, weights in zip(rows, part, strict=True):
            for source, target in moves[k]:
                if weights[source]:
                    row[target] = row[target] + weights[source]
    rows, pivots = field.reduced(rows, len(keys))
    names = list(keys)
    basis.leading.extend(names[p] for p in pivots)
    for key in names:
        basis.keys.setdefault(key, len(basis.keys))
    width = len(basis.keys)
    for weights in basis.functionals:
        weights.extend([0] * (width - len(weights)))
    places = [basis.keys[key] for key in names]
    for shift in basis.shifts:
        for line in shift:
            line.extend([0] * len(rows))
    for row in rows:
        weights = [0] * width
        for place, c in zip(places, row, strict=False):
            weights[place] = c
        basis.functionals.append(weights)
        for k, shift in enumerate(basis.shifts):
            start = len(keys) + k * s
            shift.append([*row[start : start + s], *[0] * len(rows)])


@dataclass
class CurveSearch:
    """Looks for a set of zeros through a point when its dual space has grown for some degrees.

    Attributes:
        degrees: of the dual space after which to look, each once.
        look: the dimension of the set that so many attempts find, 0 if there is none.
        dimension: what was found.
    """

    degrees: Sequence[int]
    look: Callable[[int], int]
    dimension: int = 0
    times: int = 0

    def succeeds(self, hilbert: Sequence[int]) -> bool:
        """Whether a set is known, when the dual space has these dimensions by degree."""
        growing = list(hilbert[-3:]) == sorted(hilbert[-3:])
        if self.times < len(self.degrees) and growing and len(hilbert) > self.degrees[self.times]:
            self.times += 1
            self.dimension = self.look(4 * self.times)
        return self.dimension > 0

    def last(self) -> bool:
        """The same where the dual space cannot be followed further."""
        if self.times < len(self.degrees):
            self.times += 1
            self.dimension = self.look(4 * self.times)
        return self.dimension > 0
