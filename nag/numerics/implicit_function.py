"""The regular part of equations solved for as many variables, by power series in the others.

The series become known one degree after the other. Of every product of theirs the terms of one
degree are made when they are asked for, once; when the series' terms of that degree are known,
what changes is linear in them.

References:
    Krantz & Parks, The implicit function theorem, 2002;
    van der Hoeven, Relax, but don't be too lazy, 2002;
    the reduction is Lyapunov's and Schmidt's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

import flint

from nag.numerics.ball_polynomials import MonomialProducts, factors_of
from nag.numerics.digits import ROUNDING, log_norm, middle
from nag.numerics.exact_system import PointValues
from nag.numerics.power_series import (
    Series,
    SeriesRing,
    Terms,
    compose_series,
    product_of,
    shift_polynomials,
)


@dataclass(frozen=True, eq=False)
class Composition:
    """Polynomials with a series put in for each variable.

    Attributes:
        ring: of the series.
        products: pairs of the factors' places: first comes one, then the series, then the products.
        matrix: coefficients of the polynomials, in that order.
        parts: the terms of degree 0, 1, .. of each, in that order.
    """

    ring: SeriesRing
    products: tuple[tuple[int, int], ...]
    matrix: list[list[Any]]
    parts: list[list[Series]]

    @classmethod
    def of(cls, rows: Sequence[Terms], n: int, ring: SeriesRing) -> Composition:
        """Polynomials in ``n`` variables, for series of which nothing is known yet."""
        made = MonomialProducts(n)
        places = {e: made.place(factors_of(e)) for row in rows for e, _ in row}
        width = 1 + n + len(made.pairs)
        matrix: list[list[Any]] = []
        for row in rows:
            line: list[Any] = [0] * width
            for e, c in row:
                line[places[e]] = line[places[e]] + c
            matrix.append(line)
        return cls(ring, tuple(made.pairs), matrix, [[] for _ in range(width)])

    def extended(self, series: Sequence[Series]) -> list[Series]:
        """The polynomials' terms of the next degree, when the series have these terms of it."""
        degree = len(self.parts[0])
        one: Series = {} if degree else {0: 1}
        for part, terms in zip(self.parts, [one, *series], strict=False):
            part.append(terms)
        for part, (i, j) in zip(self.parts[1 + len(series) :], self.products, strict=True):
            part.append(self._product(self.parts[i], self.parts[j], degree))
        terms = [part[degree] for part in self.parts]
        kept = [k for k, series in enumerate(terms) if series]
        matrix = [[row[k] for k in kept] for row in self.matrix]
        return product_of(matrix, [terms[k] for k in kept], self.ring.modulus)

    def lower(self, steps: Mapping[int, Series]) -> None:
        """Subtract terms of the last degree, which is not 0, from those of some series."""
        series = len(self.parts) - len(self.products) - 1
        found = [{}, *(steps.get(i, {}) for i in range(series))]
        for i, j in self.products:
            total: Series = {}
            for step, other in ((found[i], j), (found[j], i)):
                constant = self.parts[other][0].get(0, 0)
                if step and constant:
                    self.ring.add(total, step, constant)
            found.append(total)
        for part, step in zip(self.parts, found, strict=True):
            self.ring.add(part[-1], step, -1)

    def _product(self, a: Sequence[Series], b: Sequence[Series], degree: int) -> Series:
        """The terms of one degree; of a square, those of two different degrees count twice."""
        if self.ring.m == 1:
            return self._product_in_one(a, b, degree)
        square, result, modulus = a is b, {}, self.ring.modulus
        for k in range(degree // 2 + 1 if square else degree + 1):
            first, second = a[k], b[degree - k]
            if not first or not second:
                continue
            twice = square and 2 * k < degree
            for i, x in first.items():
                if twice:
                    x = x + x
                for j, y in second.items():
                    key = i + j
                    if key in result:
                        result[key] += x * y
                    else:
                        result[key] = x * y
        return {k: c % modulus for k, c in result.items()} if modulus else result

    def _product_in_one(self, a: Sequence[Series], b: Sequence[Series], degree: int) -> Series:
        """The same in one variable, where each degree has one term."""
        total: Any = None
        middle = (degree + 1) // 2 if a is b else degree + 1
        for first, second in zip(a[:middle], b[degree::-1], strict=False):
            if first and second:
                (x,), (y,) = first.values(), second.values()
                total = x * y if total is None else total + x * y
        if a is b:
            total = None if total is None else total + total
            if degree % 2 == 0 and a[middle]:
                (x,) = a[middle].values()
                total = x * x if total is None else total + x * x
        if total is None:
            return {}
        modulus = self.ring.modulus
        return {degree * self.ring.unit(0): total % modulus if modulus else total}


Matrix = list[list[Any]]

# Newton steps for the values at the centre, which may not be zero yet. Slopes are taken anew after
# each but those that are rounding, `ROUNDING` digits beside those that the inverse takes: what is
# deflated by their series converges no faster than they are known.
CONSTANT_STEPS = 2


@dataclass(frozen=True, eq=False)
class SeriesReduction:
    """Equations in the variables that are left.

    Attributes:
        ring: of series in these variables.
        images: all variables as such series.
        rest: the equations that were not solved.
        inverse: decimal logarithm of the largest entry of the solved block's inverse.
    """

    ring: SeriesRing
    images: list[Series]
    rest: list[Series]
    inverse: float


def jacobian(rows: Sequence[Terms], centre: Sequence[Any], modulus: int = 0) -> list[list[Any]]:
    """The derivatives of polynomials at a point, a list for each polynomial."""
    n = len(centre)
    result: list[list[Any]] = []
    if not any(centre):
        for row in rows:
            gradient: list[Any] = [0] * n
            for e, c in row:
                if sum(e) == 1:
                    gradient[e.index(1)] = c
            result.append(gradient)
        return result
    ring = SeriesRing(n, 1, modulus)
    images = [{0: c, ring.unit(i): 1} for i, c in enumerate(centre)]
    for value in compose_series(rows, images, ring):
        result.append([value.get(ring.unit(i), 0) for i in range(n)])
    return result


def eliminate(
    rows: Sequence[Terms],
    centre: Sequence[Any],
    solved: Sequence[int],
    columns: Sequence[int],
    order: int,
    modulus: int = 0,
    at_points: PointValues | None = None,
    steps: int = CONSTANT_STEPS,
) -> SeriesReduction | None:
    """Solve the equations ``solved`` for the variables ``columns`` as series in the others.

    Args:
        rows: polynomials in ``n`` variables.
        centre: the point at which the series are made, ``n`` numbers. The equations need not
            vanish there; the values of ``columns`` are corrected so that they do.
        solved, columns: as many indices of rows as of variables.
        order: of the series.
        modulus: a prime, for arithmetic modulo it.
        at_points: the same rows as functions, where they are known so: a faster way to their
            values and slopes.
        steps: of Newton's method for the values of ``columns``.

    Returns:
        None if the block of the Jacobian is singular.
    """
    free = [i for i in range(len(centre)) if i not in columns]
    others = [i for i in range(len(rows)) if i not in solved]
    ring = SeriesRing(len(free), order if free else 0, modulus)
    rest_rows = [rows[i] for i in others]
    if not columns:
        images = _images(centre, free, ring)
        return SeriesReduction(
            ring, images, shift_polynomials(rest_rows, centre, ring), -float("inf")
        )
    chosen = [rows[i] for i in solved]
    functions = at_points or _Rows(rows, modulus)
    found = _at_centre(functions, centre, solved, columns, modulus, steps)
    if found is None:
        return None
    centre, gradients, inverse = found
    images, rest = _images(centre, free, ring), [{} for _ in rest_rows]
    outer = [[gradients[i][j] for j in columns] for i in others]
    composition = Composition.of([*chosen, *rest_rows], len(centre), ring)
    for degree in range(ring.order + 1):
        # Terms of degree 0 and 1 are there before; others are made by the steps of their degree.
        known: list[Series] = [{} for _ in images]
        if degree <= 1:
            known = [{k: c for k, c in s.items() if ring.degree(k) == degree} for s in images]
        values = composition.extended(known)
        for series, value in zip(rest, values[len(chosen) :], strict=True):
            series.update(value)
        if not degree:
            continue
        # What a step changes in terms of its degree is linear in it.
        steps = product_of(inverse, values[: len(chosen)], modulus)
        for j, step in zip(columns, steps, strict=True):
            ring.add(images[j], step, -1)
        for series, change in zip(rest, product_of(outer, steps, modulus), strict=True):
            ring.add(series, change, -1)
        if degree < ring.order:
            composition.lower(dict(zip(columns, steps, strict=True)))
    return SeriesReduction(ring, images, rest, 0.0 if modulus else _size(inverse))


def _images(centre: Sequence[Any], free: Sequence[int], ring: SeriesRing) -> list[Series]:
    """The variables as constants, and the free ones as what is left variable."""
    images: list[Series] = [{0: c} if c else {} for c in centre]
    for place, i in enumerate(free if ring.order else ()):
        images[i][ring.unit(place)] = 1
    return images


@dataclass(frozen=True)
class _Rows:
    """Polynomials as functions, by series."""

    rows: Sequence[Terms]
    modulus: int

    def values(self, x: Sequence[Any]) -> list[Any]:
        ring = SeriesRing(0, 0, self.modulus)
        constants = [{0: c} if c else {} for c in x]
        return [value.get(0, 0) for value in compose_series(self.rows, constants, ring)]

    def jacobian(self, x: Sequence[Any]) -> Matrix:
        return jacobian(self.rows, x, self.modulus)


def _at_centre(
    functions: PointValues | _Rows,
    centre: Sequence[Any],
    solved: Sequence[int],
    columns: Sequence[int],
    modulus: int,
    steps: int,
) -> tuple[list[Any], Matrix, Matrix] | None:
    """The corrected centre, the Jacobian there, and the inverse of its block."""
    x = list(centre)
    for steps_left in range(steps, -1, -1):
        gradients = functions.jacobian(x)
        inverse = _inverse([[gradients[i][j] for j in columns] for i in solved], modulus)
        if inverse is None:
            return None
        if not steps_left:
            break
        values = functions.values(x)
        column = [{0: values[i]} if values[i] else {} for i in solved]
        moves = [value.get(0, 0) for value in product_of(inverse, column, modulus)]
        for j, step in zip(columns, moves, strict=True):
            x[j] = (x[j] - step) % modulus if modulus else middle(x[j] - flint.acb(step))
        if not any(moves) or (not modulus and log_norm(moves) < _rounding(inverse)):
            break
    return x, gradients, inverse


def _rounding(inverse: Matrix) -> float:
    return ROUNDING + max(0.0, _size(inverse)) - flint.ctx.dps


def _size(matrix: Matrix) -> float:
    """The decimal logarithm of the largest entry."""
    return log_norm(c for row in matrix for c in row)


def _inverse(block: Matrix, modulus: int) -> Matrix | None:
    try:
        if modulus:
            found = flint.nmod_mat(len(block), len(block), list(chain(*block)), modulus).inv()
            return [[int(c) for c in row] for row in found.tolist()]
        exact = flint.acb_mat([[flint.acb(c) for c in row] for row in block]).inv()
        return exact.mid().tolist()
    except ZeroDivisionError:
        return None
