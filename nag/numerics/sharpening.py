"""Newton's method for the equations that deflation leaves, in as many digits as asked for."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import flint

from nag.numerics.descent import Descent, Point, Round, descend
from nag.numerics.digits import log_norm, middle, working
from nag.numerics.exact_system import ExactSystem
from nag.numerics.implicit_function import Matrix
from nag.numerics.power_series import SeriesRing
from nag.numerics.second_round import SecondRound

# Digits in which singular points are judged. What vanishes there stays below 10^ZERO, relative to
# coefficients of one; Newton's method has arrived when its step is below 10^ARRIVED.
DIGITS, ZERO, ARRIVED = 150, -100.0, -125.0
NEWTON_STEPS = 24
# A longer step (decimal logarithm) leads elsewhere.
FURTHEST_STEP = -0.3
# Inverse blocks with larger entries (decimal logarithm) are rounding, or the zero is not regular.
LARGEST_INVERSE = 70.0
# What rounding adds to a value (decimal logarithm): Newton's step cannot become smaller than this
# times the inverse.
ROUNDING = 10.0
# A step below this share of the digits leaves a point that more digits can go on from.
NEARLY = 0.4
# Slopes by which a step gains so many digits are kept for the next one.
FAST = 12.0
# Least gain of a step of Gauss and Newton's method (decimal logarithm), after the first two: less
# is no progress, while by two zeros that are close together each step halves the distance.
GAIN = 0.2


def sharpen(
    system: ExactSystem, x: Sequence[flint.acb], rounds: Sequence[Round], digits: int = DIGITS
) -> tuple[Point, Descent] | None:
    """The zero of the rounds' equations next to ``x``, by Newton's method; None if not found.

    It starts in `DIGITS` digits, and doubles them until they are as many as asked for.
    """
    found: tuple[Point, Descent] | None = None
    point = list(x)
    for stage in _stages(digits):
        last = stage == digits
        with working(stage):
            if len(rounds) == 1:
                found = _sharpened_block(system, point, rounds, stage, last)
            else:
                near = _near(system, point, rounds, stage)
                if near is not None and not last:
                    point = near
                    continue
                found = _sharpened(system, near or point, rounds, stage, last, near is not None)
        if found is None:
            return None
        point = found[0]
    return found


def _near(system: ExactSystem, x: Point, rounds: Sequence[Round], digits: int) -> Point | None:
    """The zero without series, where there is such a way and it leads there."""
    newton = SecondRound.of(system.values_at(digits), len(system.rows), rounds)
    last, point = inf, x
    for step in range(NEWTON_STEPS):
        found = None if newton is None else newton.step(point, digits)
        if found is None:
            return None
        move, inverse = found
        moved, arrived = log_norm(move), _arrived(inverse) - digits
        if not _goes_on(step, moved, last, arrived):
            return None
        point = [middle(a + b) for a, b in zip(point, move, strict=True)]
        if moved < arrived:
            return point
        last = moved
    return None


def _arrived(inverse: float) -> float:
    """Decimal logarithm of the last step beside the digits' end."""
    return max(ARRIVED + DIGITS, ROUNDING + inverse)


def _goes_on(step: int, moved: float, last: float, arrived: float) -> bool:
    """Whether Newton's method stays near and converges."""
    return moved <= FURTHEST_STEP and (step <= 3 or moved <= max(last - 1.0, arrived))


def _stages(digits: int) -> list[int]:
    stages = [digits]
    while stages[0] > DIGITS:
        stages.insert(0, max(DIGITS, stages[0] // 2))
    return stages


def _sharpened(
    system: ExactSystem,
    x: Point,
    rounds: Sequence[Round],
    digits: int,
    last_stage: bool,
    there: bool,
) -> tuple[Point, Descent] | None:
    """The zero by series; ``there``: whether ``x`` is one already, as far as can be told."""
    last, point = inf, x
    # The steps converge quadratically with series of order one in the last round, and cubically,
    # but at the price of longer series, with order two.
    order = 1 if there or len(point) - len(rounds[0].columns) > 2 else 2
    for step in range(NEWTON_STEPS):
        found = descend(system, digits, point, rounds, order)
        if found is None or found.inverse > LARGEST_INVERSE:
            return None
        size = log_norm(found.displacement)
        arrived = _arrived(found.inverse) - digits
        if not _goes_on(step, size, last, arrived):
            return None
        point = [middle(a + b) for a, b in zip(point, found.displacement, strict=True)]
        if size < (arrived if last_stage else max(arrived, -NEARLY * digits)):
            return point, found
        last = size
    return None


def _sharpened_block(
    system: ExactSystem, x: Point, rounds: Sequence[Round], digits: int, last_stage: bool
) -> tuple[Point, Descent] | None:
    """The zero of a regular block of the equations, by values and slopes alone.

    Slopes are kept while steps gain many digits by them; beyond `DIGITS` they are those at ``x``,
    in half the digits, and the steps as long as these allow.
    """
    (this,) = rounds
    values = system.values_at(digits)
    others = [i for i in range(len(system.rows)) if i not in this.rows]
    last, point, inverse, size, slow = inf, x, None, -inf, True
    for step in range(NEWTON_STEPS):
        at = values.values(point)
        if inverse is None or (slow and digits <= DIGITS):
            inverse = _inverse_block(system, point, this, min(digits, max(DIGITS, digits // 2)))
            if inverse is None:
                return None
            size = log_norm(inverse.entries()) if this.columns else -inf
            if size > LARGEST_INVERSE:
                return None
        displacement = [flint.acb(0)] * len(point)
        if this.columns:
            column = flint.acb_mat(len(this.rows), 1, [at[i] for i in this.rows])
            for j, c in zip(this.columns, (inverse * column).mid().entries(), strict=True):
                displacement[j] = -c
        moved = log_norm(displacement)
        arrived = _arrived(size) - digits
        if not _goes_on(step, moved, last, arrived):
            return None
        point = [middle(a + b) for a, b in zip(point, displacement, strict=True)]
        if moved < (arrived if last_stage else max(arrived, -NEARLY * digits)):
            at = values.values(point)
            rest = [at[i] for i in others]
            ring = SeriesRing(len(point) - len(this.columns), 0)
            remaining = [{0: c} if c else {} for c in rest]
            return point, Descent(displacement, ring, remaining, log_norm(rest), size)
        last, slow = moved, last == inf or moved > last - FAST
    return None


def sharpen_regular(system: ExactSystem, x: Sequence[flint.acb], within: float) -> Point | None:
    """The zero of all equations next to ``x`` where their Jacobian has full rank, or None.

    By the method of Gauss and Newton: a part of the equations may have other zeros nearby, or
    nearly the same tangents, where all of them together do not.

    Args:
        within: decimal logarithm of how far the zero may be.
    """
    functions, last, point = system.values_at(DIGITS), inf, list(x)
    inverse, slow = None, True
    with working(DIGITS):
        for step in range(NEWTON_STEPS):
            if inverse is None or slow:
                inverse = _least_squares(functions.jacobian(point))
                if inverse is None:
                    return None
            values = functions.values(point)
            change = (inverse * flint.acb_mat(len(values), 1, values)).mid().entries()
            size = log_norm(change)
            point = [middle(a - b) for a, b in zip(point, change, strict=True)]
            if size > within or (step > 2 and size > last - GAIN):
                return None
            if size < ARRIVED:
                return point
            last, slow = size, last == inf or size > last - FAST
    return None


def _least_squares(slopes: Matrix) -> flint.acb_mat | None:
    """The inverse of Gauss and Newton's method; None where the columns depend on each other."""
    adjoint = flint.acb_mat([[c.conjugate() for c in row] for row in zip(*slopes, strict=True)])
    try:
        return (adjoint * flint.acb_mat(slopes)).solve(adjoint).mid()
    except ZeroDivisionError:
        return None


def predicted(
    system: ExactSystem, point: Point, rounds: Sequence[Round], along: Sequence[flint.acb]
) -> Point | None:
    """The point moved along the smooth set that the rounds leave, to first order at least.

    Args:
        along: displacements of the variables that the rounds do not determine.
    """
    first = rounds[0]
    if len(rounds) > 1 or not first.columns:
        step = descend(system, DIGITS, point, rounds, 2, along)
        if step is None:
            return None
        return [middle(a + b) for a, b in zip(point, step.displacement, strict=True)]
    slopes = system.values_at(DIGITS).jacobian(point)
    free = [j for j in range(len(point)) if j not in first.columns]
    right = [sum(slopes[i][j] * v for j, v in zip(free, along, strict=True)) for i in first.rows]
    block = flint.acb_mat([[slopes[i][j] for j in first.columns] for i in first.rows])
    try:
        change = block.solve(flint.acb_mat(len(right), 1, right)).mid().entries()
    except ZeroDivisionError:
        return None
    moved = list(point)
    for j, v in zip(free, along, strict=True):
        moved[j] = middle(moved[j] + v)
    for j, c in zip(first.columns, change, strict=True):
        moved[j] = middle(moved[j] - c)
    return moved


def _inverse_block(
    system: ExactSystem, point: Point, this: Round, digits: int
) -> flint.acb_mat | None:
    with working(digits):
        slopes = system.values_at(digits).jacobian(point)
        block = [[slopes[i][j] for j in this.columns] for i in this.rows]
        try:
            return flint.acb_mat(block).inv().mid() if block else flint.acb_mat(0, 0)
        except ZeroDivisionError:
            return None
