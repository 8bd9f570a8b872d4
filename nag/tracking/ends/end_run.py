"""The kernel that follows eight paths to their ends, in the arithmetic that it is compiled for.

All lanes make a step together: each is predicted, corrected, and expanded into Taylor series.
A lane is at t > 0 (`STEP`), or tries whether Newton's method converges at t = 0 (`FINISH`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import any_less, load, select_less, splat, store
from nag.machine_code.records import Reals, Wholes
from nag.tracking.ends.branch import (
    LONGEST,
    estimate_radius,
    expand_logarithms,
    extrapolate,
    longest_step,
    predict,
    tail_at_end,
    tails,
)
from nag.tracking.ends.corrector import correct
from nag.tracking.ends.kept_points import keep, steepest
from nag.tracking.ends.linear_algebra import substitute
from nag.tracking.ends.log_series import block_sums, right_side
from nag.tracking.ends.records import FINISH, IDLE, STEP, Room
from nag.tracking.evaluation import complete_slots, incomplete_slots
from nag.tracking.kernel_arrays import KernelEquations
from nag.tracking.numbers.complex_numbers import ARITHMETICS, ComplexNumbers
from nag.tracking.predictor import OVERLONG

# How a path ended: it is lost where its rounding errors, or its steps, leave it nothing to go on.
OPEN, REGULAR, LIMIT, LOST, TOO_LONG = range(5)
# Rounding error times Newton's constant at which an arithmetic gives up.
LOSING = 1e-3
# Size of the next terms of a series at t = 0 from which on Newton's method is tried there, in parts
# of those of the last trial.
TRIAL, SMALLER = 1e-2, 0.1
# Decides: Part of the tail of a series that converges that a finer one's must be for its winding
# number to count instead.
BETTER = 1e-2
# Steps, in the logarithm of t, that get a path nowhere; so often in a row they were shortened; and
# where t leaves the range of doubles.
SHORTEST, MOST_REJECTED, LAST_T = 1e-7, 25, 1e-280


class EndBatch(NamedTuple):
    """Paths to be followed, and where their results go.

    ``starts``: points of the paths, numbers as in `KernelEquations`, shape (count, N, 2, words), at
    ``t``, shape (count, words). ``ends``: points at which to try Newton's method at t = 0 first,
    like ``starts``, if ``tried`` is 0; ``straight``: 0 where not to try it later. ``rough,
    rough_ends``: 1 where starts, or ends, are known to the digits of doubles only; ``rough`` is set
    to 0 where a safe point is found. ``latest``: largest t at which a limit is taken for one.
    ``outcome, winding, steps, evaluations``: one for each path. ``points``: like ``starts``, the
    end, or where the path is, at ``t``; ``safe, safe_t``: likewise the last point that is known
    well. ``limits``: of those that have one, see `extrapolate`, shape (count, N, 4, 2, words).
    ``errors``: rounding errors of the coordinates, shape (count, N); ``met``: 1 for those that have
    exceeded them a thousandfold. ``curvature``: estimate of Newton's constant. ``accuracy``:
    expected error of a prediction; ``contraction``: largest contraction of Newton's method after
    it; ``tail``: largest last term of a power series that is taken to converge; ``radius_factor``:
    largest step as part of the radius of convergence. ``max_steps``: of each path, 0 for those that
    are only tried. ``close``: 1 where other paths may run beside these, in directions of which
    corrections along the paths say nothing.
    """

    count: int
    order: int
    ends: Reals
    tried: Wholes
    straight: Wholes
    rough: Wholes
    rough_ends: Wholes
    starts: Reals
    t: Reals
    latest: Reals
    outcome: Wholes
    winding: Wholes
    steps: Wholes
    evaluations: Wholes
    points: Reals
    safe: Reals
    safe_t: Reals
    limits: Reals
    errors: Reals
    met: Reals
    curvature: Reals
    max_steps: Wholes
    max_winding: int
    close: int
    accuracy: float
    contraction: float
    tail: float
    radius_factor: float


def _put(z, s, r, lane, data, path):
    """Coordinates of a lane from an array of numbers."""
    for k in range(2 * z.number.words * s.N):
        r.slots[8 * k + lane] = data[2 * z.number.words * s.N * path + k]


def _set_time(z, r, lane, t, path, zero):
    for k in range(z.number.words):
        r.t[8 * k + lane] = 0.0 if zero else t[z.number.words * path + k]


def _fill(z, s, r, lane, path, b):
    """Put a path into a lane."""
    r.based[lane] = r.saved[lane] = r.wanted[lane] = r.settled[lane] = 0.0
    r.here[lane] = r.h[lane] = r.seen_t[lane] = r.seen_radius[lane] = 0.0
    r.first[lane] = r.last[lane] = r.contraction[lane] = r.known[lane] = r.excess[lane] = 0.0
    r.taken[lane] = r.evaluated[lane] = r.rejected[lane] = r.winding[lane] = r.waited[lane] = 0
    r.path[lane] = path
    r.tried[lane] = TRIAL
    r.curvature[lane] = b.curvature[path]
    for j in range(s.N):
        r.met[8 * j + lane] = b.met[s.N * path + j]
    if b.tried[path] == 0:
        r.mode[lane] = FINISH
        r.rough[lane] = b.rough_ends[path]
        _set_time(z, r, lane, b.t, path, True)
        _put(z, s, r, lane, b.ends, path)
    else:
        _begin(z, s, r, lane, b)


def _begin(z, s, r, lane, b):
    """Go to the path's own point."""
    path = r.path[lane]
    r.mode[lane] = STEP
    r.rough[lane] = b.rough[path]
    _set_time(z, r, lane, b.t, path, False)
    _put(z, s, r, lane, b.starts, path)


def _expand(z, s, r, order):
    """Taylor coefficients of the path."""
    for m in range(1, order + 1):
        incomplete_slots(z, s, r, m)
        block_sums(z, s, r, m, r.partial, 0)
        right_side(z, s, r, m)
        substitute(z, s, r, r.right)
        complete_slots(z, s, r, m)
        block_sums(z, s, r, m, r.series, (m - 1) * (s.N + 1 + s.inner))


def _close(z, s, r, lane, b, outcome, data):
    """Results of a path, its point from ``data``; the lane becomes free."""
    path = r.path[lane]
    b.outcome[path] = outcome
    b.winding[path] = r.winding[lane]
    b.steps[path] += r.taken[lane]
    b.evaluations[path] += r.evaluated[lane]
    b.curvature[path] = r.curvature[lane]
    numbers = 2 * z.number.words * s.N
    if outcome == REGULAR or r.based[lane] > 0.5:
        for k in range(numbers):
            b.points[numbers * path + k] = data[8 * k + lane]
        if outcome != REGULAR:
            for k in range(z.number.words):
                b.t[z.number.words * path + k] = r.time[8 * k + lane]
    if r.saved[lane] > 0.5:
        b.rough[path] = 0
        for k in range(numbers):
            b.safe[numbers * path + k] = r.safe[8 * k + lane]
        for k in range(z.number.words):
            b.safe_t[z.number.words * path + k] = r.safe_time[8 * k + lane]
    for j in range(s.N):
        error = r.base_errors[8 * j + lane]
        if outcome == REGULAR:
            error = r.errors[8 * j + lane] * r.excess[lane]
        b.errors[s.N * path + j] = error
        b.met[s.N * path + j] = r.met[8 * j + lane]
    if outcome == LIMIT:
        for k in range(4 * numbers):
            b.limits[4 * numbers * path + k] = r.limits[8 * k + lane]
    r.mode[lane] = IDLE


def _reject_step(z, s, r, lane, b):
    """A step or a finish that failed: a shorter step, or none if there is none."""
    if r.mode[lane] == FINISH:
        if r.based[lane] < 0.5:
            if b.max_steps[r.path[lane]] == 0:
                _close(z, s, r, lane, b, LOST, r.base)
            else:
                _begin(z, s, r, lane, b)
            return
        r.mode[lane] = STEP
    elif r.based[lane] < 0.5:
        _close(z, s, r, lane, b, LOST, r.base)
        return
    else:
        r.h[lane] *= 0.4
        r.rejected[lane] += 1
        if r.h[lane] < SHORTEST or r.rejected[lane] > MOST_REJECTED:
            _close(z, s, r, lane, b, LOST, r.base)
            return
    r.wanted[lane] = 1.0


def _too_long(r, lane, b):
    """Whether a step is too long for the series at its end, whose radius is kept if so.

    See `nag.tracking.predictor.radius_as_seen`; where the series holds on the whole way back to
    the beginning of the step, its last coefficients may be rounding errors.
    """
    h = r.h[lane]
    radius = r.measures[lane]
    if r.based[lane] < 0.5 or h <= OVERLONG * b.radius_factor * (radius + h):
        return False
    if r.measures[8 + lane] * h ** (1.0 * b.order) <= b.accuracy:
        return False
    r.seen_t[lane] = r.t[lane]
    r.seen_radius[lane] = radius
    return True


def _nearest(r, lane):
    """Radius of convergence at a lane's base as seen from further on, in the logarithm of t."""
    seen = r.seen_t[lane]
    if not 0.0 < seen < r.here[lane]:
        return LONGEST
    return math.log(r.here[lane] / seen) + r.seen_radius[lane]


def _shorten(z, s, r, lane, b):
    """Another step from the base of one that was too long, by what that one saw."""
    r.h[lane] = b.radius_factor * _nearest(r, lane)
    r.rejected[lane] += 1
    r.wanted[lane] = 1.0
    if r.rejected[lane] > MOST_REJECTED:
        _close(z, s, r, lane, b, LOST, r.base)


def _predict(z, s, r, order):
    """Where the lanes that want it are to be corrected next."""
    one = splat(1.0)
    finishing = load(r.mode, 0) - one
    predict(z, s, r, order, load(r.wanted, 0), finishing, load(r.h, 0))
    store(r.wanted, 0, splat(0.0))


def _advance(z, s, r, lane, b, best, winding):
    """What follows an accepted step: a limit, a trial at t = 0, or another step."""
    path = r.path[lane]
    rejected = r.rejected[lane]
    r.here[lane] = r.t[lane]
    r.based[lane] = 1.0
    r.rejected[lane] = 0
    curvature = max(r.curvature[lane], 1.0)
    if r.known[lane] * curvature > LOSING:
        _close(z, s, r, lane, b, LOST, r.base)
        return
    converged_here = best <= b.tail
    converged = converged_here and r.t[lane] <= b.latest[path]
    r.waited[lane] = r.waited[lane] + 1 if converged else 0
    if r.winding[lane] != winding:
        r.waited[lane] = min(r.waited[lane], 1)
    r.winding[lane] = winding
    if r.taken[lane] >= b.max_steps[path] or r.here[lane] < LAST_T:
        _close(z, s, r, lane, b, TOO_LONG, r.base)
        return
    steep = max(curvature, steepest(z, r, lane)) if b.close > 0 else curvature
    goal = min(b.accuracy, b.contraction / steep)
    h = min(longest_step(s, r, b.order, lane, goal), b.radius_factor * _nearest(r, lane))
    if converged_here:
        # Further in, rounding errors grow: no further than a limit is wanted.
        h = min(h, max(2.0, math.log(r.here[lane] / b.latest[path])))
    r.h[lane] = min(h, r.h[lane]) if rejected > 0 else h
    # Tails that are rounding errors, as of paths that stay where they are, say nothing new.
    end = max(tail_at_end(s, r, b.order, lane), z.number.epsilon)
    near = SMALLER * r.tried[lane]
    if b.close > 0:
        near = min(near, b.contraction / steep)
    if end <= near and b.straight[path] != 0:
        r.tried[lane] = end
        r.mode[lane] = FINISH
        r.wanted[lane] = 1.0
    elif r.waited[lane] >= 2:
        _close(z, s, r, lane, b, LIMIT, r.base)
    else:
        r.wanted[lane] = 1.0


def _best_winding(s, r, b):
    """The w with the smallest tail in each lane, and that tail, into the first measures.

    A power series in t^(1/w) is one for the multiples of w as well: the first one will do, unless
    another one converges far better. So near the end any series may seem to converge.
    """
    best = splat(1e300)
    chosen = splat(0.0)
    enough = splat(b.tail)
    better = splat(BETTER)
    for w in range(1, b.max_winding + 1):
        tail = tails(s, r, b.order, float(w))
        bound = select_less(enough, best, best, better * best)
        chosen = select_less(tail, bound, splat(float(w)), chosen)
        best = select_less(tail, bound, tail, best)
    store(r.measures, 0, best)
    store(r.measures, 1, chosen)


def follow_batch(z: ComplexNumbers, s: KernelEquations, r: Room, b: EndBatch) -> None:
    """Follow all paths of a batch."""
    following = 0
    busy = 0
    for lane in range(8):
        r.mode[lane] = IDLE
        path = min(lane, b.count - 1)
        _fill(z, s, r, lane, path, b)
        if lane < b.count:
            busy += 1
            following += 1
        else:
            r.mode[lane] = IDLE
    while busy > 0:
        correct(z, s, r, b)
        stepping = 0
        for lane in range(8):
            r.accepted[lane] = 0.0
            mode = r.mode[lane]
            if mode == IDLE:
                continue
            r.taken[lane] += 1
            contracted = r.contraction[lane] <= b.contraction
            if r.settled[lane] > 1.5 or not contracted:
                _reject_step(z, s, r, lane, b)
            elif mode == FINISH:
                curvature = max(r.curvature[lane], 1.0)
                if r.known[lane] * curvature <= LOSING:
                    _close(z, s, r, lane, b, REGULAR, r.slots)
                else:
                    _reject_step(z, s, r, lane, b)
            else:
                r.accepted[lane] = 1.0
                stepping += 1
        if stepping > 0:
            _expand(z, s, r, b.order)
            expand_logarithms(z, s, r, b.order)
            estimate_radius(z, s, r, b.order)
            for lane in range(8):
                r.evaluated[lane] += b.order if r.accepted[lane] > 0.5 else 0
                if r.accepted[lane] > 0.5 and _too_long(r, lane, b):
                    r.accepted[lane] = 0.0
                    _shorten(z, s, r, lane, b)
            keep(z, s, r, b.order)
            _best_winding(s, r, b)
            if any_less(load(r.measures, 0), splat(2.0 * b.tail)):
                extrapolate(z, s, r, b.order, load(r.measures, 1))
            for lane in range(8):
                if r.accepted[lane] > 0.5:
                    best, winding = r.measures[lane], int(r.measures[8 + lane])
                    _advance(z, s, r, lane, b, best, winding)
        _predict(z, s, r, b.order)
        for lane in range(8):
            if r.mode[lane] == IDLE and following < b.count:
                _fill(z, s, r, lane, following, b)
                following += 1
        busy = 0
        for lane in range(8):
            if r.mode[lane] > IDLE:
                busy += 1


KERNELS = {words: Kernel(follow_batch, z) for words, z in ARITHMETICS.items()}
