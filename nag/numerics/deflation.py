"""Deflation in power series: a singular zero as a regular one of exact equations, unknowns as many.

The equations that are regular at a zero are solved for as many variables. What remains, in the
other variables, has no linear part there; if its terms of lowest order have degree d, its
derivatives of order d - 1 have a linear part, and the same begins anew with them. Each round
determines at least one more variable, so there are at most as many rounds as variables. No
unknowns are added, and multiplicity costs only the order of the series.

The variables and the equations are those that were given, so that the deflated equations are
exact: at a multiple zero everything that should vanish does so to all digits, at a cluster of
zeros it does not.

References:
    Ojika, Watanabe & Mitsui, Deflation algorithm for the multiple roots of a system of nonlinear
    equations, 1983; Leykin, Verschelde & Zhao, Newton's method with deflation, 2006;
    Hauenstein & Wampler, Isosingular sets and deflation, 2013.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import comb, inf, log10, prod
from typing import Any

import flint
import numpy as np

from nag.numerics.ball_ranks import regular_block
from nag.numerics.corank import find_zero_of_corank, may_hide_others
from nag.numerics.descent import Descent, Point, Round, descend, total_work
from nag.numerics.digits import DIGITS, SPARE, log_norm, log_size, middle, working_digits
from nag.numerics.exact_system import ExactSystem
from nag.numerics.implicit_function import jacobian
from nag.numerics.power_series import Series, SeriesRing, Terms, derivatives
from nag.numerics.sharpening import ARRIVED, ROUNDING, ZERO, sharpen

# Orders of the series in which the lowest terms of what remains are looked for, one after the
# other, while they do not cost too much: where all terms so far are zero, and where they are not,
# as at a point that is not known well.
ORDERS = (3, 6, 12, 17, 24, 34, 48, 68, 96, 136, 192, 272, 384)
# Newton's steps after the first may take back half of it, hardly more (decimal logarithm).
TURNS_BACK = 0.5
# Lines on which the sizes of forms are looked at before all of their coefficients are.
LINES = 3
MOST_WORK, MOST_WORK_ROUGHLY = 1e6, 1.5e5


@dataclass(frozen=True, eq=False)
class DeflatedPoint:
    """A point where the rounds' equations vanish, to `digits` digits.

    Attributes:
        free: number of variables that no round determined: the dimension of a smooth set of zeros
            through the point, if not 0.
        defect: decimal logarithm of the largest value that vanishes if the zero is exact.
    """

    point: Point
    rounds: tuple[Round, ...]
    free: int
    defect: float
    inverse: float

    @property
    def exact(self) -> bool:
        return self.defect < ZERO

    @property
    def corank(self) -> int:
        return len(self.point) - len(self.rounds[0].columns)


class NotDeflated(Exception):
    """Deflation did not succeed, for the reason that the text says."""


class SeriesTooLong(NotDeflated):
    """Deflation would cost too much: there may be a singular zero within reach."""


def lowest_order(
    ring: SeriesRing,
    series: Sequence[Series],
    reach: float,
    inverse: float = 0.0,
    first: int = 1,
) -> int | None:
    """The degree of the lowest terms at a zero no further from the origin than ``reach``.

    A term of degree d at the zero makes terms of lower degrees at the origin, at most as large as
    a shift by ``reach`` allows; the lowest that are larger are no such shadows. None if there is
    nothing but zeros, shadows and what stands at the end of the series.

    Args:
        reach: decimal logarithm.
        inverse: of the blocks that were solved for, decimal logarithm: each degree of the series
            loses as many digits.
        first: the first degree that is looked at.
    """
    norms = [-inf] * (ring.order + 1)
    for s in series:
        for key, c in s.items():
            degree = ring.degree(key)
            norms[degree] = max(norms[degree], log_size(c))
    for j in range(first, ring.order):
        if norms[j] <= _noise(j, inverse):
            continue
        shadow = max(
            norms[e] + log10(comb(e, j)) + (e - j) * reach for e in range(j + 1, len(norms))
        )
        if norms[j] > shadow + 0.5:
            return j
    return None


def _lowest_on_lines(
    system: ExactSystem, point: Point, this: Round, degrees: tuple[int, int], reach: float
) -> int | None:
    """The degree in a range of the lowest terms as lines through the point show it.

    What remains has the same orders on them as everywhere, and its series cost little.
    """
    first, order = degrees
    series: list[Series] = []
    inverse = 0.0
    for turn in range(LINES):
        seen = _on_line(system, point, this, order, np.exp(1j * (0.3 + 2.0 * turn)))
        if seen is None:
            return order - 1
        series += seen.remaining
        inverse = max(inverse, seen.inverse)
    return lowest_order(SeriesRing(1, order), series, reach, inverse, first)


def _on_line(
    system: ExactSystem, point: Point, this: Round, order: int, turn: complex
) -> Descent | None:
    """What remains on a line, along which each free variable is ``turn`` times the one before."""
    free = [i for i in range(system.n) if i not in this.columns]
    slope, n = flint.acb(turn), system.n
    lines = system
    for i, j in zip(free[1:], free[:-1], strict=True):
        units = [tuple(int(k == v) for k in range(n)) for v in (i, j)]
        constant = middle(slope * point[j] - point[i])
        terms = [((0,) * n, constant), (units[0], flint.acb(1)), (units[1], -slope)]
        lines = lines.with_row(terms)
    rows = (*this.rows, *range(len(system.rows), len(lines.rows)))
    return descend(lines, DIGITS, point, [Round(rows, (*this.columns, *free[1:]))], order)


def _noise(degree: int, inverse: float) -> float:
    """What a coefficient of a degree may be that is zero; see `lowest_order`."""
    return max(ZERO, SPARE - DIGITS + degree * max(0.0, inverse))


def certain_round(
    slopes: Callable[[Point], list[list[Any]]],
    centre: Point,
    reach: float,
    rng: np.random.Generator,
) -> Round:
    """The largest block of the Jacobian that is regular at all points within ``reach``."""
    n = len(centre)
    size = flint.arb(10) ** flint.arb(reach)
    shifts = np.exp(2j * np.pi * rng.random((2, n)))

    points = [
        [c + middle(size * flint.acb(s)) for c, s in zip(centre, moves, strict=True)]
        for moves in shifts.tolist()
    ]
    block = regular_block(slopes(centre), n, ZERO, [slopes(point) for point in points])
    return Round(tuple(block.rows), tuple(block.columns))


def deflate(
    system: ExactSystem,
    x: Sequence[flint.acb],
    reach: float,
    rng: np.random.Generator,
    patience: float = 1.0,
    most: int | None = None,
) -> DeflatedPoint:
    """Rounds that make the zero within ``reach`` of ``x`` regular, and that zero.

    Where what remains after a round vanishes to all orders that were looked at, the point is left
    as it is in the variables that remain (`Deflated.free` of them): a smooth set of zeros seems to
    pass through it. Where its corank asks for more than ``most`` zeros, a zero of that corank is
    enough.

    Args:
        system: equations, exact.
        x: in the system's scaled variables.
        reach: decimal logarithm of how far the zero may be.
        patience: part of the usual work after which series are too long.
        most: the largest multiplicity that an isolated zero may have there, if that is known.

    Raises:
        NotDeflated: if the rounds lead nowhere, or away from ``x``.
    """
    with working_digits(DIGITS):
        rounds: list[Round] = []
        slopes: Callable[[Point], list[list[Any]]] = system.values_at(DIGITS).jacobian
        point, centre = list(x), list(x)
        farthest = max(reach + 1, ARRIVED)
        rows: list[Terms] = []
        while True:
            this = certain_round(slopes, centre, reach, rng)
            left = len(centre) - len(this.columns)
            if not rounds and asks_for_more(left, most):
                singular = _find_singular(system, x, this, farthest)
                if singular is not None:
                    return singular
            if rounds and left == len(centre):
                raise NotDeflated("its error is too large to see which derivatives vanish there")
            if rounds and _first_step(rows, this, left) > farthest + TURNS_BACK:
                raise NotDeflated("Newton's method leads away from there")
            if rounds and rounds[-1].order == 1:
                # What remained has a linear part, at the sharpened point: both are one block.
                rounds[-1] = rounds[-1].joined(this)
            else:
                rounds.append(this)
            found = sharpen(system, point, rounds)
            if found is None:
                raise NotDeflated("Newton's method does not converge to a zero there")
            point, descent = found
            if log_norm(a - b for a, b in zip(point, x, strict=True)) > farthest:
                raise NotDeflated("the zero found is further away than the error of the point")
            if not left:
                return _regular(system, point, rounds, descent)
            lowest = _lowest_terms(system, point, rounds, reach, descent.inverse, patience)
            if lowest is None:
                return DeflatedPoint(point, tuple(rounds), left, descent.defect, descent.inverse)
            order, descent = lowest
            rounds[-1] = replace(rounds[-1], order=order)
            rows = derivatives(descent.remaining, descent.ring, order - 1)
            slopes = partial(jacobian, rows)
            centre = [flint.acb(0)] * left


def asks_for_more(corank: int, most: int | None) -> bool:
    """Whether isolated zeros of a corank are of larger multiplicity than ``most``, if it is known.

    As many equations as are singular there, in as many variables, have no linear terms.
    """
    return most is not None and most < 2**corank


def _find_singular(
    system: ExactSystem, x: Sequence[flint.acb], this: Round, farthest: float
) -> DeflatedPoint | None:
    """The zero of a round's corank near a point, without deflation.

    None if it is not found, or if the point may stand for another zero beside it.
    """
    found = find_zero_of_corank(system, x, this)
    if found is None:
        return None
    point, defect = found
    if log_norm(a - b for a, b in zip(point, x, strict=True)) > farthest:
        return None
    if may_hide_others(system, point, this, farthest):
        return None
    return DeflatedPoint(point, (this,), 0, defect, -inf)


def _first_step(rows: Sequence[Terms], this: Round, n: int) -> float:
    """Decimal logarithm of Newton's first step from the origin, for a block of equations."""
    n += len(this.columns)
    origin = [flint.acb(0)] * n
    chosen = [rows[i] for i in this.rows]
    slopes = [[row[j] for j in this.columns] for row in jacobian(chosen, origin)]
    values = [next((c for e, c in row if not any(e)), 0) for row in chosen]
    try:
        step = flint.acb_mat(slopes).solve(flint.acb_mat(len(values), 1, values))
    except ZeroDivisionError:
        return inf
    return log_norm(step.mid().entries())


def _regular(
    system: ExactSystem, point: Point, rounds: Sequence[Round], descent: Descent
) -> DeflatedPoint:
    """The zero that the rounds determine, to as many digits whatever its condition."""
    found: tuple[Point, Descent] | None = (point, descent)
    if descent.inverse > ARRIVED + DIGITS - ROUNDING:
        digits = DIGITS + int(descent.inverse)
        found = sharpen(system, point, rounds, digits)
        if found is None:
            raise NotDeflated("Newton's method does not converge in more digits")
    point, descent = found
    return DeflatedPoint(point, tuple(rounds), 0, descent.defect, descent.inverse)


def _lowest_terms(
    system: ExactSystem,
    point: Point,
    rounds: Sequence[Round],
    reach: float,
    inverse: float,
    patience: float,
) -> tuple[int, Descent] | None:
    """The order of the lowest terms of what remains, and the series; None where it vanishes."""
    from nag.numerics.curves import order_of_contact

    contact: float | None = None
    if len(rounds) == 1 and rounds[0].columns:
        # Points beside take a fraction of the time of series, which show nothing along a set.
        contact = order_of_contact(system, point, rounds, inverse)
        if contact == 0:
            return None
    left = len(point) - sum(len(r.columns) for r in rounds)
    least, most, known = 0.0, patience * MOST_WORK, 0
    for order in ORDERS:
        if order < min(least, ORDERS[-1]):
            continue
        if total_work(system, rounds, order) > most:
            raise SeriesTooLong(f"its series in {left} variables are too long at order {order}")
        # Where nothing is solved for, series are the polynomials, which lines do not shorten.
        if known and len(rounds) == 1 and rounds[0].columns and left > 2:
            seen = _lowest_on_lines(system, point, rounds[0], (known, order), reach)
            if seen is None:
                continue
            order = seen + 1
        descent = descend(system, DIGITS, point, rounds, order)
        assert descent is not None
        found = lowest_order(descent.ring, descent.remaining, reach, descent.inverse)
        if found is not None:
            return found, descent
        ring, noisy = descent.ring, _noise(order, descent.inverse) > 0
        sizes = ((log_size(c), ring.degree(k)) for s in descent.remaining for k, c in s.items())
        if any(size > _noise(degree, descent.inverse) for size, degree in sizes):
            most, known = patience * MOST_WORK_ROUGHLY, order
        elif not least:
            # Each round's equations are derivatives, of lower order along the set.
            least = contact or order_of_contact(system, point, rounds, descent.inverse)
            if least == 0:
                return None
            least /= prod(r.order for r in rounds[:-1])
        if noisy:
            break
    raise NotDeflated(f"nothing is seen of what remains to order {order}")
