"""Rounds of solving what is regular at a point: Newton's step for all, and what remains as series.

The equations that are regular at a zero are solved for as many variables, by power series in the
others. What remains has no linear part there; if its terms of lowest order have degree d, its
derivatives of order d - 1 have a linear part, and the same begins anew with them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import comb

import flint

from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import in_bits, log_norm, middle
from nag.numerics.exact_system import ExactSystem, PointValues
from nag.numerics.implicit_function import CONSTANT_STEPS, eliminate
from nag.numerics.newton import inverse_of, newton_step
from nag.numerics.power_series import Series, SeriesRing, Terms, derivatives, evaluate

Point = list[flint.acb]


@dataclass(frozen=True)
class Round:
    """One round: equations and variables solved for, and the order of what remains (0: unknown)."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    order: int = 0

    def joined(self, other: Round) -> Round:
        """One round for this one and another one of the equations that it leaves as they are."""
        rows = (*self.rows, *_untaken_numbers(self.rows, other.rows))
        return Round(
            rows, (*self.columns, *_untaken_numbers(self.columns, other.columns)), other.order
        )


def _untaken_numbers(taken: Sequence[int], places: Sequence[int]) -> list[int]:
    """The numbers at these places among those that are not taken."""
    left = [i for i in range(len(taken) + max(places, default=-1) + 1) if i not in taken]
    return [left[k] for k in places]


@dataclass(frozen=True, eq=False)
class Descent:
    """What all rounds say of a point.

    Attributes:
        displacement: Newton's step, for each variable.
        ring, remaining: the equations that remain after the last round, in the variables that are
            left there.
        defect: decimal logarithm of the largest coefficient that should vanish.
        inverse: decimal logarithm of the largest entry of an inverse block.
    """

    displacement: Point
    ring: SeriesRing
    remaining: list[Series]
    defect: float
    inverse: float


@dataclass(frozen=True, eq=False)
class Block:
    """The equations of a round in the variables that it determines, the others as at a point."""

    functions: BallPolynomials
    x: Point
    columns: tuple[int, ...]

    @classmethod
    def of(cls, system: ExactSystem, this: Round, x: Point) -> Block:
        return cls(system.functions.rows_of(this.rows), list(map(middle, x)), this.columns)

    @property
    def variables(self) -> Point:
        """The coordinates that the round determines."""
        return [self.x[j] for j in self.columns]

    def place(self, y: Sequence[flint.acb]) -> Point:
        """The point with other values of these."""
        placed = dict(zip(self.columns, y, strict=True))
        return [placed.get(j, c) for j, c in enumerate(self.x)]

    def values(self, y: Sequence[flint.acb], bits: int) -> flint.acb_mat:
        """Values of the equations, a column."""
        return self.functions.values(self.place(y), bits)

    def jacobian(self, y: Sequence[flint.acb], bits: int) -> flint.acb_mat:
        """Their derivatives by the variables that the round determines."""
        return _columns(self.functions.jacobian(self.place(y), bits), self.columns)

    def newton_change(self, bits: int) -> Point | None:
        """Newton's step to be added, 0 for the other variables; None where it is singular."""
        step = newton_step(self, self.variables, bits)
        return None if step is None else self._change([-c for c in step], {})

    def tangent_change(self, along: Sequence[flint.acb], bits: int) -> Point | None:
        """How all variables change when the others do by so much, to first order."""
        free = [j for j in range(len(self.x)) if j not in self.columns]
        slopes = self.functions.jacobian(self.x, bits)
        inverse = inverse_of(_columns(slopes, self.columns), bits)
        if inverse is None:
            return None
        with in_bits(bits):
            right = _columns(slopes, free) * flint.acb_mat(len(free), 1, list(along))
            change = (-inverse * right).mid().entries()
        return self._change(change, dict(zip(free, along, strict=True)))

    def _change(self, columns: Sequence[flint.acb], others: Mapping[int, flint.acb]) -> Point:
        placed = {**others, **dict(zip(self.columns, columns, strict=True))}
        return [placed.get(j, flint.acb(0)) for j in range(len(self.x))]


def _columns(matrix: flint.acb_mat, chosen: Sequence[int]) -> flint.acb_mat:
    entries = [matrix[i, j] for i in range(matrix.nrows()) for j in chosen]
    return flint.acb_mat(matrix.nrows(), len(chosen), entries)


def total_order(rounds: Sequence[Round], order: int) -> int:
    """The order of the first round's series so that the last has one of that order."""
    return order + sum(r.order - 1 for r in rounds if r.order)


def series_cost(m: int, order: int, rounds: Sequence[Round]) -> float:
    """Products of coefficients that one monomial's series in ``m`` variables costs, roughly."""
    return comb(2 * m + order, order) * (1 + order / 4 * bool(rounds[0].columns))


def total_work(system: ExactSystem, rounds: Sequence[Round], order: int) -> float:
    """The work of all rounds for series of that order in the last one.

    A round in which nothing is solved for leaves polynomials that are no longer than the given.
    """
    left, total = system.n, 0.0
    for place, this in enumerate(rounds):
        left -= len(this.columns)
        length = total_order(rounds[place:], order)
        if left == system.n:
            length = min(length, system.largest_degree)
            total += comb(left + length, length) * length
        else:
            total += series_cost(left, length, rounds[place:])
    return total


def descend(
    system: ExactSystem,
    digits: int,
    centre: Sequence[flint.acb],
    rounds: Sequence[Round],
    order: int,
    along: Sequence[flint.acb] | None = None,
) -> Descent | None:
    """Newton's step for all rounds at once, and what remains after them as series.

    Args:
        order: of the series of what remains after the last round.
        along: displacements of the variables that the rounds do not determine; default zero.
    """
    at_points = system.values_at(digits)
    with in_bits(at_points.bits):
        return _descend(system.at(digits), centre, rounds, order, along, at_points)


def _descend(
    rows: Sequence[Terms],
    centre: Sequence[flint.acb | int],
    rounds: Sequence[Round],
    order: int,
    along: Sequence[flint.acb] | None,
    at_points: PointValues | None,
) -> Descent | None:
    this = rounds[0]
    total = total_order(rounds, order)
    # Series of this order make the square, or the cube, of an error: so the constants must.
    steps = min(order, CONSTANT_STEPS)
    reduction = eliminate(
        rows, centre, this.rows, this.columns, total, at_points=at_points, steps=steps
    )
    if reduction is None:
        return None
    ring, rest = reduction.ring, reduction.rest
    low = max(this.order, 1)
    defect = log_norm(c for s in rest for k, c in s.items() if ring.degree(k) < low)
    inverse = reduction.inverse
    if len(rounds) > 1 and ring.m:
        derived = derivatives(rest, ring, this.order - 1)
        below = _descend(derived, [0] * ring.m, rounds[1:], order, along, None)
        if below is None:
            return None
        v, remaining, last = below.displacement, below.remaining, below.ring
        defect, inverse = max(defect, below.defect), max(inverse, below.inverse)
    else:
        v = list(along) if along is not None else [flint.acb(0)] * ring.m
        remaining, last = rest, ring
    displacement = [
        flint.acb(evaluate(image, ring, v)) - c
        for image, c in zip(reduction.images, centre, strict=True)
    ]
    return Descent(displacement, last, remaining, defect, inverse)
