"""Newton's method for the equations that deflation leaves, in as many digits as asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from typing import Protocol, TypeVar

import flint

from nag.numerics.descent import Block, Descent, Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, bits_of, log_norm
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import find_zero, move_point
from nag.numerics.power_series import SeriesRing
from nag.numerics.second_round import SecondRound

# What vanishes at a singular point, of `DIGITS` digits, stays below 10^ZERO, relative to
# coefficients of one; Newton's method has arrived when its step is below 10^ARRIVED.
ZERO, ARRIVED = -100.0, -125.0
NEWTON_STEPS = 24
# A longer step (decimal logarithm) leads elsewhere.
FURTHEST_STEP = -0.3
# What a step must be shorter than the one before, after the first ones (decimal logarithm).
GAIN = 1.0
# Inverse blocks with larger entries (decimal logarithm) are rounding, or the zero is not regular.
LARGEST_INVERSE = 70.0
# What rounding adds to a value (decimal logarithm): Newton's step cannot become smaller than this
# times the inverse.
ROUNDING = 10.0
# A step below this share of the digits leaves a point that more digits can go on from.
NEARLY = 0.4


class Step(Protocol):
    """A step of Newton's method for rounds: what is added, and the largest inverse's logarithm."""

    displacement: Point
    inverse: float


S = TypeVar("S", bound=Step)


def sharpen(
    system: ExactSystem, x: Sequence[flint.acb], rounds: Sequence[Round], digits: int = DIGITS
) -> tuple[Point, Descent] | None:
    """The zero of the rounds' equations next to ``x``, by Newton's method; None if not found.

    It starts in `DIGITS` digits, and doubles them until they are as many as asked for.
    """
    if len(rounds) == 1:
        return _sharpen_block(system, list(x), rounds[0], digits)
    found: tuple[Point, Descent] | None = None
    point = list(x)
    for stage in _stages(digits):
        last = stage == digits
        near = _sharpen_without_series(system, point, rounds, stage)
        if near is not None and not last:
            point = near
            continue
        found = _sharpen_by_series(system, near or point, rounds, stage, last, near is not None)
        if found is None:
            return None
        point = found[0]
    return found


def _stages(digits: int) -> list[int]:
    stages = [digits]
    while stages[0] > DIGITS:
        stages.insert(0, max(DIGITS, stages[0] // 2))
    return stages


def _sharpen_block(
    system: ExactSystem, x: Point, this: Round, digits: int
) -> tuple[Point, Descent] | None:
    """The zero of a regular block of the equations, by values and slopes alone."""
    block, point, inverse = Block.of(system, this, x), x, -inf
    if this.columns:
        zero = find_zero(block, block.variables, digits, FURTHEST_STEP, GAIN)
        if zero is None:
            return None
        inverse, point = log_norm(zero.inverse.entries()), block.place(zero.point)
    if inverse > LARGEST_INVERSE:
        return None
    at = system.values_at(digits).values(point)
    rest = [c for i, c in enumerate(at) if i not in this.rows]
    remaining = [{0: c} if c else {} for c in rest]
    ring = SeriesRing(len(point) - len(this.columns), 0)
    displacement = [flint.acb(0)] * len(point)
    return point, Descent(displacement, ring, remaining, log_norm(rest), inverse)


def _sharpen_without_series(
    system: ExactSystem, x: Point, rounds: Sequence[Round], digits: int
) -> Point | None:
    """The zero without series, where there is such a way and it leads there."""
    newton = SecondRound.of(system.values_at(digits), len(system.rows), rounds)
    if newton is None:
        return None
    found = _follow_steps(newton.step, x, digits, True)
    return None if found is None else found[0]


def _sharpen_by_series(
    system: ExactSystem, x: Point, rounds: Sequence[Round], digits: int, last: bool, there: bool
) -> tuple[Point, Descent] | None:
    """The zero by series; ``there``: whether ``x`` is one already, as far as can be told."""
    # The steps converge quadratically with series of order one in the last round, and cubically,
    # but at the price of longer series, with order two.
    order = 1 if there or len(x) - len(rounds[0].columns) > 2 else 2
    return _follow_steps(lambda y: descend(system, digits, y, rounds, order), x, digits, last)


def _follow_steps(
    step: Callable[[Point], S | None], x: Point, digits: int, last_stage: bool
) -> tuple[Point, S] | None:
    """Where steps of Newton's method lead, and the last of them; None if they do not converge.

    Args:
        last_stage: whether the point is to be known to all digits.
    """
    last, point = inf, x
    for count in range(NEWTON_STEPS):
        found = step(point)
        if found is None or found.inverse > LARGEST_INVERSE:
            return None
        size = log_norm(found.displacement)
        arrived = max(ARRIVED + DIGITS, ROUNDING + found.inverse) - digits
        if size > FURTHEST_STEP or (count > 3 and size > max(last - GAIN, arrived)):
            return None
        point = move_point(point, found.displacement, bits_of(digits))
        if size < (arrived if last_stage else max(arrived, -NEARLY * digits)):
            return point, found
        last = size
    return None


def predict_along(
    system: ExactSystem, point: Point, rounds: Sequence[Round], along: Sequence[flint.acb]
) -> Point | None:
    """The point moved along the smooth set that the rounds leave, to first order at least.

    Args:
        along: displacements of the variables that the rounds do not determine.
    """
    if len(rounds) > 1 or not rounds[0].columns:
        step = descend(system, DIGITS, point, rounds, 2, along)
        change = None if step is None else step.displacement
    else:
        change = Block.of(system, rounds[0], point).tangent_change(along, BITS)
    return None if change is None else move_point(point, change, BITS)
