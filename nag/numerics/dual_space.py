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

from nag.numerics.null_space import Field
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


@dataclass(frozen=True, eq=False)
class _Basis:
    """Functionals, their leading monomials, and what multiplication with each variable makes."""

    functionals: list[Series]
    leading: list[int]
    shifts: list[list[dict[int, Any]]]


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
        nag.numerics.null_space.UnclearRank: if a rank cannot be read.
    """
    basis = _Basis([{0: 1}], [0], [[{} for _ in range(m)]])
    hilbert = [1]
    ring, equations = series(min(2, highest))
    for degree in range(1, highest + 1):
        if degree > ring.order:
            ring, equations = series(min(ring.order + max(2, ring.order // 2), highest))
        found = _next(field, ring, equations, basis)
        if not found:
            return DualSpace(tuple(hilbert), True)
        hilbert.append(len(found))
        if sum(hilbert) > MOST_FUNCTIONALS or stop(hilbert):
            break
        _extend(field, ring, basis, found)
    return DualSpace(tuple(hilbert), False)


def _next(
    field: Field, ring: SeriesRing, equations: Sequence[Series], basis: _Basis
) -> list[list[Any]]:
    """New functionals, each as the coefficients of its shifts in the basis."""
    s, m = len(basis.functionals), ring.m
    rows: list[list[Any]] = []
    for first, second in combinations(range(m), 2):
        commute: dict[int, list[Any]] = {}
        for i in range(s):
            for place, other, sign in ((first, second, 1), (second, first, -1)):
                for j, c in basis.shifts[i][other].items():
                    row = commute.setdefault(j, [0] * (s * m))
                    row[place * s + i] = row[place * s + i] + sign * c
        rows.extend(commute.values())
    for f in equations:
        rows.append(_weights(ring, basis, f))
    for key in basis.leading[1:]:
        rows.append(_weights(ring, basis, {key: 1}))
    return field.null_space(rows, s * m)


def _weights(ring: SeriesRing, basis: _Basis, f: Series) -> list[Any]:
    """What a functional makes of ``f``, as a linear form in the coefficients of its shifts."""
    s = len(basis.functionals)
    row: list[Any] = [0] * (s * ring.m)
    lowered: list[dict[int, Any]] = [{} for _ in range(ring.m)]
    for key, c in f.items():
        if key:
            k = next(i for i, e in enumerate(ring.exponents(key)) if e)
            lowered[k][key - ring.unit(k)] = c
    for k, part in enumerate(lowered):
        for i, functional in enumerate(basis.functionals):
            short, long = sorted((part, functional), key=len)
            total = sum((c * long[key] for key, c in short.items() if key in long), 0)
            row[k * s + i] = total % ring.modulus if ring.modulus else total
    return row


def _extend(field: Field, ring: SeriesRing, basis: _Basis, found: list[list[Any]]) -> None:
    """Add the functionals with these shifts, reduced so that each has a monomial of its own."""
    s, m = len(basis.functionals), ring.m
    new: list[tuple[Series, list[Any]]] = []
    for vector in found:
        functional: Series = {}
        for k in range(m):
            for i, other in enumerate(basis.functionals):
                weight = vector[k * s + i]
                if not weight:
                    continue
                for key, c in other.items():
                    if any(ring.exponents(key)[:k]):
                        continue
                    raised = key + ring.unit(k)
                    total = functional.get(raised, 0) + weight * c
                    functional[raised] = total % ring.modulus if ring.modulus else total
        new.append((functional, list(vector)))
    for place in range(len(new)):
        functional, vector = new[place]
        keys = list(functional)
        lead = keys[field.largest([functional[k] for k in keys])]
        inverse = field.inverse(functional[lead])
        functional = {k: _times(c, inverse, ring) for k, c in functional.items()}
        vector = [_times(c, inverse, ring) for c in vector]
        new[place] = functional, vector
        basis.leading.append(lead)
        for other in range(len(new)):
            if other != place and new[other][0].get(lead):
                factor = new[other][0][lead]
                ring.add(new[other][0], functional, -factor)
                new[other][0][lead] = 0
                moved = zip(new[other][1], vector, strict=True)
                reduced = [_times(1, a - factor * b, ring) for a, b in moved]
                new[other] = new[other][0], reduced
    for functional, vector in new:
        basis.functionals.append({k: c for k, c in functional.items() if c})
        parts = [vector[k * s : (k + 1) * s] for k in range(m)]
        basis.shifts.append([{i: c for i, c in enumerate(part) if c} for part in parts])


def _times(a: Any, b: Any, ring: SeriesRing) -> Any:
    return a * b % ring.modulus if ring.modulus else a * b
