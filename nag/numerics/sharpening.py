"""Newton's method for the equations that deflation leaves, in as many digits as asked for."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import flint

from nag.numerics.descent import Block, Descent, Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, bits_of, log_norm
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import find_zero, move_point
from nag.numerics.power_series import SeriesRing

# Decides, measured: Decimal logarithm of what vanishes at a singular point, of 150 digits, and of
# entries of the dual space's matrices there: all below -149; of a pivot of the Loewner matrix, of
# 200 digits.
ZERO = -100.0
# The same of Newton's last step: half way from that to all digits.
ARRIVED = (ZERO - DIGITS) / 2
# Newton's steps, at most.
NEWTON_STEPS = 24
# A longer step (decimal logarithm) leads elsewhere.
FURTHEST_STEP = -0.3
# What a step must be shorter than the one before, after the first ones (decimal logarithm).
GAIN = 1.0
# Decides: The same of an inverse that says that a zero is not regular after all.
LARGEST_INVERSE = 70.0
# What rounding adds to a value (decimal logarithm): Newton's step cannot become smaller than this
# times the inverse.
ROUNDING = 10.0
# A step below this share of the digits leaves a point that more digits can go on from.
NEARLY = 0.4


def sharpen(
    system: ExactSystem, x: Sequence[flint.acb], rounds: Sequence[Round], digits: int = DIGITS
) -> tuple[Point, Descent] | None:
    """The zero of the rounds' equations next to ``x``, by Newton's method; None if not found.

    Where more digits are asked for than points are judged in, they are doubled from twice as many
    at most: each step doubles those that are known.
    """
    if len(rounds) == 1:
        return _sharpen_block(system, list(x), rounds[0], digits)
    found: tuple[Point, Descent] | None = None
    point = list(x)
    for stage in _stages(digits):
        found = _sharpen_by_series(system, point, rounds, stage, stage == digits)
        if found is None:
            return None
        point = found[0]
    return found


def _stages(digits: int) -> list[int]:
    stages = [digits]
    while stages[0] > 2 * DIGITS:
        stages.insert(0, stages[0] // 2)
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


def _sharpen_by_series(
    system: ExactSystem, x: Point, rounds: Sequence[Round], digits: int, last_stage: bool
) -> tuple[Point, Descent] | None:
    """The zero by series of all rounds, and what they say there; None if it is not found.

    With series of order one in the last round steps converge quadratically. Those of order two are
    longer: with them Newton's method converges from further away, and cubically.
    """
    few = len(x) - len(rounds[0].columns) <= 2
    for order in (1, 2) if few else (1,):
        found = _follow_steps(system, x, rounds, digits, order, last_stage)
        if found is not None:
            return found
    return None


def _follow_steps(
    system: ExactSystem,
    x: Point,
    rounds: Sequence[Round],
    digits: int,
    order: int,
    last_stage: bool,
) -> tuple[Point, Descent] | None:
    """Where steps of Newton's method lead, and the last of them; None if they do not converge.

    Args:
        last_stage: whether the point is to be known to all digits.
    """
    last, point = inf, x
    for count in range(NEWTON_STEPS):
        found = descend(system, digits, point, rounds, order)
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
