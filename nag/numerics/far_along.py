"""Whether equations vanish along a smooth set of zeros of some of them, seen far from the point.

Beside a zero, what vanishes along a curve to a high order cannot be told from what vanishes on it:
it takes as many digits as the order is high. Far away no power of the distance is small, and
equations that are not zero along the curve are not small there either. So the curve is followed
away from the point, in small steps, and one look at its end decides, whatever the order is.

References:
    Sommese & Wampler, The numerical solution of systems of polynomials, 2005, on membership.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10

import flint
import numpy as np

from nag.numerics.descent import Block, Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, doubles, log_norm
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import move_point
from nag.numerics.rounds_in_doubles import RoundsInDoubles
from nag.numerics.sharpening import ARRIVED, LARGEST_INVERSE, predict_along, sharpen

# How far a set is followed in the variables that are free, or in any, all of them scaled to a size
# of one (much further out many sets are nearly singular); and in how many steps at most.
FAR, AT_MOST = 5.0, 100.0
STEPS, STEPS_IN_DIGITS = 600, 200
# Directions that are tried: some lead into a branch point.
DIRECTIONS = 3
# What Newton's steps may change after a step, as shares of it, so that it leads to no other sheet:
# the first one after steps by a high order and by a low one; the second one beside the first,
# or, where both are rounding, beside the step. Where it is larger, doubles do no longer.
SMALL, SMALL_ROUGHLY, CONTRACTION, ROUNDING = 0.001, 0.05, 0.05, 1e-6
# The first step, and the least one.
FIRST, LEAST = 1e-2, 1e-30
# Inverses (decimal logarithm) up to which doubles do.
GOOD = 10.0


def far_value(
    system: ExactSystem, point: Point, rounds: Sequence[Round], inverse: float, digits: int
) -> float | None:
    """Decimal logarithm of the equations' values far along the smooth set that rounds leave.

    None if the set could not be followed.

    Args:
        inverse: of the blocks that were solved for, decimal logarithm.
        digits: to which their zeros are known.
    """
    left = len(point) - sum(len(r.columns) for r in rounds)
    known = RoundsInDoubles.of(system, rounds) if inverse < GOOD else None
    for attempt in range(DIRECTIONS):
        turn = np.exp(1j * (0.3 + np.arange(left) + 2.0 * attempt))
        start = _Place(list(point), 0.0, FIRST)
        if known is not None:
            start = _in_doubles(known, turn, start)
        end = _in_digits(system, rounds, turn, start)
        if end is None:
            continue
        size = system.largest_degree * max(0.0, log_norm(end))
        more = digits + int(size)
        found = sharpen(system, end, rounds, more)
        if found is not None:
            return system.log_residual(found[0], more)
    return None


@dataclass(frozen=True, eq=False)
class _Place:
    """Where a set has been followed to: how far in the free variables, and the next step."""

    point: Point
    gone: float
    step: float

    @property
    def far(self) -> bool:
        return self.gone >= FAR or log_norm(self.point) >= log10(AT_MOST)


def _in_doubles(known: RoundsInDoubles, direction: np.ndarray, start: _Place) -> _Place:
    """As far along the set as doubles do."""
    x, gone, h = doubles(start.point), start.gone, start.step
    for _ in range(STEPS):
        if gone >= FAR or np.abs(x).max() >= AT_MOST:
            break
        try:
            # Powers of a point that went astray overflow; the step is taken again, shorter.
            with np.errstate(all="ignore"):
                ahead = known.ahead(x, direction, h)
                first = known.newton(ahead)
                second = known.newton(ahead - first)
        except np.linalg.LinAlgError:
            break
        moved, one, two = (float(np.abs(v).max()) for v in (ahead - x, first, second))
        if one <= SMALL * moved and two <= max(CONTRACTION * one, ROUNDING * moved):
            x, gone = ahead - first - second, gone + h
            h *= 2.0 if one < SMALL / 16 * moved else 1.0
        elif two > CONTRACTION * one and one <= SMALL * moved:
            break
        else:
            h /= 2
            if h < LEAST:
                break
    return _Place([flint.acb(complex(c)) for c in x], gone, h)


def _in_digits(
    system: ExactSystem, rounds: Sequence[Round], direction: np.ndarray, start: _Place
) -> Point | None:
    """The point far along the set, in all digits where doubles did not come there."""
    place, turns = start, [flint.acb(complex(c)) for c in direction]
    if start.gone and not start.far:
        known = sharpen(system, start.point, rounds)
        if known is None:
            return None
        place = _Place(known[0], start.gone, start.step)
    for _ in range(STEPS_IN_DIGITS):
        if place.far:
            return place.point
        place = _step(system, rounds, turns, place)
        if place.step < LEAST:
            return None
    return None


def _step(
    system: ExactSystem, rounds: Sequence[Round], turns: Sequence[flint.acb], place: _Place
) -> _Place:
    """A step along the set, or the same place with a smaller step."""
    x, h = place.point, place.step
    one_round = len(rounds) == 1
    along = [c * h for c in turns]
    ahead = (_ahead if one_round else predict_along)(system, x, rounds, along)
    step = None if ahead is None else _newton(system, rounds, ahead)
    if ahead is not None and step is not None:
        moved = log_norm(a - b for a, b in zip(ahead, x, strict=True))
        one, small = log_norm(step), log10(SMALL if one_round else SMALL_ROUGHLY)
        nearer = move_point(ahead, step, BITS)
        second = _newton(system, rounds, nearer) if one < moved + small else None
        # A second step that is not much smaller may belong to another sheet.
        if second is not None and log_norm(second) <= max(one + log10(CONTRACTION), ARRIVED):
            longer = 2.0 if one < moved + small - (1.2 if one_round else 0.6) else 1.0
            return _Place(move_point(nearer, second, BITS), place.gone + h, h * longer)
    # What the last step left of its error must be small beside the next, smaller one.
    left = _newton(system, rounds, x)
    return _Place(x if left is None else move_point(x, left, BITS), place.gone, h / 2)


def _newton(system: ExactSystem, rounds: Sequence[Round], x: Point) -> Point | None:
    """Newton's step in the variables that the rounds determine; None where they are singular."""
    if len(rounds) > 1:
        found = descend(system, DIGITS, x, rounds, 1)
        return found.displacement if found and found.inverse < LARGEST_INVERSE else None
    return Block.of(system, rounds[0], x).newton_change(BITS)


def _ahead(
    system: ExactSystem, x: Point, rounds: Sequence[Round], along: Sequence[flint.acb]
) -> Point | None:
    """A step along the set of one round, like that in doubles."""

    def tangent(change: Point, share: float) -> Point | None:
        there = move_point(x, change, BITS, share)
        return Block.of(system, rounds[0], there).tangent_change(along, BITS)

    a = tangent([flint.acb(0)] * len(x), 0.0)
    b = a and tangent(a, 0.5)
    c = b and tangent(b, 0.5)
    d = c and tangent(c, 1.0)
    if a is None or b is None or c is None or d is None:
        return None
    for change, share in ((a, 1 / 6), (b, 1 / 3), (c, 1 / 3), (d, 1 / 6)):
        x = move_point(x, change, BITS, share)
    return x
