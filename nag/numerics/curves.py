"""Zeros beside a zero: sets of positive dimension, shown by points that lie on them exactly."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

import flint
import numpy as np

from nag.numerics.ball_ranks import regular_block
from nag.numerics.deflation import MOST_WORK_ROUGHLY, DeflatedPoint, NotDeflated, deflate
from nag.numerics.descent import Block, Point, Round, series_cost
from nag.numerics.digits import (
    BITS,
    DIGITS,
    LOG10_2,
    ROUNDING,
    SPARE,
    log_norm,
    log_size,
    middle,
    working_digits,
)
from nag.numerics.exact_system import ExactSystem
from nag.numerics.far_along import far_value
from nag.numerics.implicit_function import SeriesReduction, eliminate
from nag.numerics.newton import STEPS, find_zero, inverse_of
from nag.numerics.power_series import evaluate
from nag.numerics.series_zeros import ScaledSeries
from nag.numerics.sharpening import ARRIVED, ZERO, predict_along, sharpen

# Binary logarithms of distances at which a smooth set of zeros is followed; the smaller ones where
# it bends too much.
NEAR = (7, 24, 48)
STEP = 3
# How many digits smaller than their distance the errors of points there may be, in this order:
# rounding alone; what the ends of series leave; what is left of multiple zeros.
CLOSER = (12.5, 8.0, 5.0, 2.0)
# Decides: Share of the digits that make a value zero.
VANISHING = 0.75
# Digits in which a zero on a hyperplane is looked at before the set that it may lie on is.
MORE_DIGITS = 600
# Digits of coefficients that ask for no more.
ROUND_NUMBERS = 20
# Part of the usual work for a zero on a hyperplane: there are others.
PATIENCE = 0.05
# Decides: Zeros of truncated series over their scale, beyond which they are none of the system's.
OFF = 1e3
# Binary logarithms of distances at which hyperplanes pass a singular point.
DISTANCES = (5, 9, 13, 17, 21)


def digits_at(system: ExactSystem, k: int) -> int:
    """Digits in which 2^-k to the power of the highest possible order of contact is no zero.

    Long coefficients may be nearly equal, and what is small to their difference's power.
    """
    contact = system.most_zeros * (k + 2) * LOG10_2
    return max(DIGITS, int((contact + _length(system) + SPARE) / VANISHING))


def _length(system: ExactSystem) -> float:
    """Digits that long coefficients ask for."""
    return system.largest_degree * max(0.0, system.longest - ROUND_NUMBERS)


def is_exact_zero(system: ExactSystem, found: DeflatedPoint) -> bool:
    """Whether what should vanish at a zero does so to as many digits as the coefficients ask for.

    Where they are long, zeros may be so close together that fewer digits take them for one.
    """
    long = _length(system)
    return found.exact and (not long or _vanishes(system, found, int(DIGITS + long / VANISHING)))


def order_of_contact(
    system: ExactSystem, point: Point, rounds: Sequence[Round], inverse: float = 0.0
) -> float:
    """Whether the equations vanish along the smooth set that the rounds leave: 0 if they do.

    They are evaluated at a point of the set beside the given one. Where that does not show every
    possible order of contact, they are also evaluated at a point far away. If they do not vanish,
    the order to which they do is returned, roughly, or a lower bound of it; ``inf`` where no
    further points were found.

    Args:
        inverse: of the blocks that were solved for, decimal logarithm: Newton's method converges
            as much nearer to the point.
    """
    for k in _near(inverse):
        beside = _find_beside(system, point, rounds, k)
        if beside is None:
            continue
        first = system.log_residual(beside, DIGITS)
        if first < -VANISHING * DIGITS:
            if digits_at(system, k) <= DIGITS:
                return 0.0
            digits = DIGITS + int(_length(system) / VANISHING)
            begin = (beside, *_join_rounds(system, beside, rounds, inverse))
            far = far_value(system, *begin, digits)
            if far is None:
                return inf
            return 0.0 if far < -VANISHING * digits else max(2.0, -first / ((k + 2) * LOG10_2))
        nearby = _find_beside(system, point, rounds, k + STEP)
        if nearby is not None:
            second = system.log_residual(nearby, DIGITS)
            return max(2.0, (first - second) / (STEP * LOG10_2) - 1)
    return inf


def _near(inverse: float) -> list[int]:
    """Binary logarithms of distances at which points beside a zero are looked for."""
    nearer = int(max(0.0, inverse) / LOG10_2)
    return [k + nearer for k in NEAR]


def point_beside(system: ExactSystem, found: DeflatedPoint) -> Point | None:
    """A point of the smooth set of zeros through a zero, a little off it; None if not found."""
    tries = (_find_beside(system, found.point, found.rounds, k) for k in _near(found.inverse))
    return next((point for point in tries if point is not None), None)


def _find_beside(
    system: ExactSystem, point: Point, rounds: Sequence[Round], k: int
) -> Point | None:
    """A point of the smooth set at distance 2^-k; None if not found."""
    left = len(point) - sum(len(r.columns) for r in rounds)
    along = [flint.acb((1 + (i + 1) * 1j) * 2.0**-k / (i + 2)) for i in range(left)]
    start = predict_along(system, point, rounds, along)
    found = None if start is None else sharpen(system, start, rounds, DIGITS)
    if found is None:
        return None
    moved = log_norm(a - b for a, b in zip(found[0], point, strict=True))
    return found[0] if abs(moved + k * LOG10_2) < 1.5 else None


def _join_rounds(
    system: ExactSystem, point: Point, rounds: Sequence[Round], inverse: float
) -> tuple[Sequence[Round], float]:
    """One round for the set that several leave, and its inverse, if one does at a general point."""
    if len(rounds) == 1:
        return rounds, inverse
    slopes = system.values_at(DIGITS).jacobian(point)
    with working_digits(DIGITS):
        found = regular_block(slopes, system.n, ZERO)
    this = Round(tuple(found.rows), tuple(found.columns))
    if found.rank != sum(len(r.columns) for r in rounds):
        return rounds, inverse
    block, bits = Block.of(system, this, point), BITS
    found = inverse_of(block.jacobian(block.variables, bits), bits)
    return (rounds, inverse) if found is None else ((this,), log_norm(found.entries()))


def curve_through(
    system: ExactSystem,
    found: DeflatedPoint,
    rng: np.random.Generator,
    attempts: int,
    steps: int = STEPS,
) -> int:
    """The dimension of a set of zeros followed to a point, or 0 if none was found.

    On random hyperplanes at smaller and smaller distances from the point, zeros are looked for
    that continue each other; each must be an exact zero there, after a deflation of its own. The
    dimension is a lower bound, one more than that of the set on the hyperplane.

    Args:
        steps: of Newton's method for a zero of the series on the first hyperplane, at most; simple
            ones take few.
    """
    block = Round(found.rounds[0].rows, found.rounds[0].columns)
    order = max(found.rounds[0].order + 2, 4)
    while order > 2 and series_cost(found.corank, order, [block]) > MOST_WORK_ROUGHLY:
        order -= 1
    with working_digits(DIGITS):
        values, rows = system.values_at(DIGITS), system.at(DIGITS)
        series = eliminate(rows, found.point, block.rows, block.columns, order, at_points=values)
        assert series is not None
        nearest = _first_trusted(series)
        for attempt in range(attempts):
            begin = DISTANCES[min(nearest + attempt % 3, len(DISTANCES) - 2)]
            plane = np.rint(64 * rng.normal(size=(2, found.corank))) / 64
            plane = plane[0] + 1j * plane[1]
            dimension = _follow_set(system, found, series, begin, plane, rng, steps)
            if dimension:
                return dimension
    return 0


def _first_trusted(series: SeriesReduction) -> int:
    """The first of the distances where the last terms of series are small beside the first ones."""
    ring = series.ring
    norms = [-inf] * (ring.order + 1)
    for key, c in ((key, c) for one in series.rest for key, c in one.items()):
        norms[ring.degree(key)] = max(norms[ring.degree(key)], log_size(c))
    low = next((d for d in range(2, ring.order) if norms[d] > ZERO), ring.order)
    growth = (norms[-1] - norms[low]) / (ring.order - low) if low < ring.order else -inf
    return next((i for i, k in enumerate(DISTANCES) if growth < k * LOG10_2), len(DISTANCES) - 1)


def _follow_set(
    system: ExactSystem,
    found: DeflatedPoint,
    series: SeriesReduction,
    begin: int,
    plane: np.ndarray,
    rng: np.random.Generator,
    steps: int,
) -> int:
    u: np.ndarray | None = None
    zero: DeflatedPoint | None = None
    for k in [k for k in DISTANCES if k >= begin]:
        scaled = ScaledSeries.of(series.ring, series.rest, -k * LOG10_2)
        u = (
            _begun(scaled, plane, rng, steps)
            if u is None
            else scaled.newton(u / (plane @ u), plane)
        )
        if u is None or np.abs(u).max() > OFF:
            return 0
        along = [flint.acb(complex(c)) / 2**k for c in u]
        start = [middle(flint.acb(evaluate(f, series.ring, along))) for f in series.images]
        sliced = _on_hyperplane(system, found, k, plane)
        if zero is None:
            zero = _zero_near(sliced, start, k, rng)
            if zero is None or not _vanishes(sliced, zero, MORE_DIGITS):
                return 0
            if not _on_set(system, zero, rng):
                return 0
        elif not _continues(sliced, start, k, zero):
            return 0
    return 0 if zero is None else 1 + zero.free


def _begun(
    scaled: ScaledSeries, plane: np.ndarray, rng: np.random.Generator, steps: int
) -> np.ndarray | None:
    """A zero on the hyperplane; in many variables, where all else costs most, from more starts."""
    for _ in range(max(1, len(plane) // 2)):
        u = rng.normal(size=len(plane)) + 1j * rng.normal(size=len(plane))
        found = scaled.newton(u / (plane @ u), plane, steps)
        if found is not None:
            return found
    return None


def _on_hyperplane(
    system: ExactSystem, found: DeflatedPoint, k: int, plane: np.ndarray
) -> ExactSystem:
    """The equations on the hyperplane at distance 2^-k."""
    free = [i for i in range(system.n) if i not in found.rounds[0].columns]
    weights = [flint.acb(complex(c)) for c in plane]
    constant = -flint.acb(1) / 2**k
    for i, w in zip(free, weights, strict=True):
        constant = constant - w * found.point[i]
    row = [
        (tuple(int(i == j) for j in range(system.n)), w) for i, w in zip(free, weights, strict=True)
    ]
    return system.with_row([((0,) * system.n, middle(constant)), *row])


def _zero_near(
    sliced: ExactSystem, start: Point, k: int, rng: np.random.Generator
) -> DeflatedPoint | None:
    """The zero on the hyperplane at distance 2^-k beside a point, if it is one to all digits."""
    tries = [(start, -k * LOG10_2 - closer) for closer in CLOSER]
    regular = find_zero(sliced.functions, start, DIGITS, tries[-1][1])
    if regular is not None:
        tries.insert(0, (regular.point, ARRIVED + ROUNDING))
    for point, reach in tries:
        try:
            zero = deflate(sliced, point, reach, rng, PATIENCE)
        except NotDeflated:
            continue
        if zero.exact:
            return zero
    return None


def _on_set(system: ExactSystem, zero: DeflatedPoint, rng: np.random.Generator) -> bool:
    """Whether a zero on a hyperplane lies on a smooth set of zeros that leaves the hyperplane."""
    try:
        whole = deflate(system, zero.point, ARRIVED + ROUNDING, rng, PATIENCE)
    except NotDeflated:
        return False
    return whole.exact and whole.free > zero.free


def _continues(sliced: ExactSystem, start: Point, k: int, zero: DeflatedPoint) -> bool:
    """Whether there is a zero of the same kind by ``start`` on the hyperplane at distance 2^-k."""
    within = 1 - k * LOG10_2 - CLOSER[-1]
    if len(zero.rounds) == 1 and not zero.free:
        there = find_zero(sliced.functions, start, DIGITS, within)
        return there is not None and sliced.log_residual(there.point, DIGITS) < ZERO
    found = sharpen(sliced, start, zero.rounds)
    if found is None or found[1].defect > ZERO:
        return False
    return log_norm(a - b for a, b in zip(found[0], start, strict=True)) < within


def _vanishes(system: ExactSystem, zero: DeflatedPoint, digits: int) -> bool:
    """Whether a zero is one to so many digits."""
    found = sharpen(system, zero.point, zero.rounds, digits)
    return found is not None and found[1].defect < -VANISHING * digits
