"""Rounds of solving what is regular at a point: Newton's step for all, and what remains as series.

The equations that are regular at a zero are solved for as many variables, by power series in the
others. What remains has no linear part there; if its terms of lowest order have degree d, its
derivatives of order d - 1 have a linear part, and the same begins anew with them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

import flint

from nag.numerics.digits import log_norm
from nag.numerics.exact_system import ExactSystem, PointValues
from nag.numerics.implicit_function import eliminate
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
        rows = (*self.rows, *_others(self.rows, other.rows))
        return Round(rows, (*self.columns, *_others(self.columns, other.columns)), other.order)


def _others(taken: Sequence[int], places: Sequence[int]) -> list[int]:
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


def total_order(rounds: Sequence[Round], order: int) -> int:
    """The order of the first round's series so that the last has one of that order."""
    return order + sum(r.order - 1 for r in rounds if r.order)


def work(m: int, order: int, rounds: Sequence[Round]) -> float:
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
            total += work(left, length, rounds[place:])
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
    reduction = eliminate(rows, centre, this.rows, this.columns, total, at_points=at_points)
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
