"""The path tracker's kernel in doubles: eight paths at a time, refilled from a queue.

Each path runs to t = ``radius``, where its point is kept, and from there straight on to t = 0, for
as long as it gets on: what happens to it there is for `nag.tracking.ends` to find out.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import any_less, fma, load, select_less, splat, store
from nag.machine_code.records import Complexes, Reals, Wholes
from nag.tracking.kernel_arrays import SCALARS, System, Work
from nag.tracking.linear_algebra import factorize, substitute
from nag.tracking.predictor import (
    ACCURACY,
    CORRECT,
    FIRST,
    GOAL,
    GROWTH,
    H_USED,
    LAST,
    OVERLONG,
    PREDICT,
    SEEN_RADIUS,
    SEEN_T,
    THETA,
    H,
    T,
    estimate_radius,
    next_step,
    next_t,
    predict,
    radius_as_seen,
)
from nag.tracking.taylor import (
    complete_slope,
    complete_slots,
    factors_at,
    incomplete_slots,
    jacobian,
    normalize,
    products,
    right_side,
    rounding_errors,
    values,
)

# What a lane does: nothing; predict and correct; correct at its first point; correct once more.
EMPTY, STEPPING, STARTING, CORRECTING = -1, 0, 1, 2
# What became of a step: rejected, because it is too long for the series at its end or for another
# reason; to be corrected once more; accepted.
OVERSTEPPED, REJECTED, UNFINISHED, ACCEPTED = range(4)
# Why a path ended before t = 0, see `nag.tracking.paths.Reason`.
ARRIVED, STEP_SIZE, STEPS, START, NOT_FINITE = 0, 1, 2, 3, 5
# Rows of the lanes' counters.
PATH, ROUNDS, TAKEN, FAILURES, STATE, STRAIGHT = range(6)
# A path of which a step is rejected after so many tries behind the radius is left to others: they
# take a tenth of the time that its end then takes.
PATIENCE = 48
# Second corrections as small as this do not say how much longer a step may be.
ROUNDING = 1e-9
# Least error of a point that is believed.
LEAST = 1e-15
# Steps, relative to t, at which a path is left to others.
SHORTEST = 1e-10
# Corrections are rounding errors if they are at most so many times what these are estimated to be.
NOISY = 10.0
# What stands for the last correction of a point where there is none.
FARTHEST = 1.0
# Corrections as large as this lead nowhere; their squares are still numbers.
OVERFLOW = 1e100


def _length(s, w):
    """Squared norm of the right-hand side, the largest of the groups."""
    zero = splat(0.0)
    largest = zero
    for g in range(s.groups):
        total = zero
        for j in range(s.N):
            if s.group_of[j] == g:
                x = load(w.br, j)
                y = load(w.bi, j)
                total = fma(x, x, fma(y, y, total))
        largest = select_less(total, largest, largest, total)
    return largest


def _correct(s, w, norms, k):
    """Add the solution to the point; its squared norm."""
    store(norms, k, _length(s, w))
    for j in range(s.N):
        store(w.vr, j, load(w.vr, j) + load(w.br, j))
        store(w.vi, j, load(w.vi, j) + load(w.bi, j))


def _measure(s, w, order):
    """Squared norm of the Taylor coefficient in the right-hand side."""
    total = splat(0.0)
    for j in range(s.N):
        x = load(w.br, j)
        y = load(w.bi, j)
        total = fma(x, x, fma(y, y, total))
    store(w.norms, 1 + order, total)


def _newton_and_jets(s, w, order):
    """One Newton step, one simplified one, and the Taylor coefficients of the path."""
    n = s.N
    normalize(s, w)
    factors_at(s, w)
    products(s, w, 0, s.products)
    values(s, w)
    jacobian(s, w, s.moves)
    factorize(n, w.jr, w.ji, w.pivots)
    substitute(n, w.jr, w.ji, w.pivots, w.br, w.bi)
    _correct(s, w, w.norms, 0)
    products(s, w, 0, s.value_products)
    values(s, w)
    substitute(n, w.jr, w.ji, w.pivots, w.br, w.bi)
    # The slots stay those of the point before this correction, which is far smaller than the
    # error of the Taylor coefficients.
    _correct(s, w, w.norms, 1)
    for k in range(1, order + 1):
        if k > 1:
            incomplete_slots(s, w, k)
        right_side(s, w, k)
        substitute(n, w.jr, w.ji, w.pivots, w.br, w.bi)
        _measure(s, w, k)
        complete_slots(s, w, k)
        complete_slope(s, w)


def _accept(s, w, order):
    """Make the current points and Taylor coefficients the base, in the lanes accepted."""
    n = s.N
    half = splat(0.5)
    a = load(w.accepted, 0)
    size = n + 1 + s.inner
    for j in range(n):
        store(w.base, j, select_less(half, a, load(w.vr, j), load(w.base, j)))
        store(w.base, n + j, select_less(half, a, load(w.vi, j), load(w.base, n + j)))
    for k in range(1, order + 1):
        top = 2 * n * k
        for j in range(n):
            q = (k - 1) * size + j
            store(w.base, top + j, select_less(half, a, load(w.cr, q), load(w.base, top + j)))
            q_im = top + n + j
            store(w.base, q_im, select_less(half, a, load(w.ci, q), load(w.base, q_im)))


def _put(s, w, lane, points, k):
    for j in range(s.N):
        x = points[s.N * k + j]
        w.vr[8 * j + lane] = x.real
        w.vi[8 * j + lane] = x.imag


class Batch(NamedTuple):
    """Paths to be tracked in one batch, where their results go, and the settings.

    ``starts``: points at t = 1, shape (count, N), of which ``first, first + stride, ..`` are
    tracked. ``points``: where they ended, at t = 0 if their ``reason`` is 0; ``safe``: their
    points at ``safe_t``, which is ``radius``, or 1 for those that did not get there.
    ``error, steps, reason``: one for each path. The rest: see
    `nag.tracking.settings.Settings`; a ``radius`` of 0 stands for none.
    """

    starts: Complexes
    count: int
    first: int
    stride: int
    points: Complexes
    safe: Complexes
    safe_t: Reals
    error: Reals
    steps: Wholes
    reason: Wholes
    order: int
    max_steps: int
    radius: float
    tolerance: float
    newton: float
    newton_end: float
    floor: float
    radius_factor: float
    safety: float
    contraction: float


def _fill(s, w, lane, path, b):
    """Put a path into a lane."""
    f, c = w.scalars, w.counters
    _put(s, w, lane, b.starts, path)
    for k in range(SCALARS):
        f[8 * k + lane] = 0.0
    for k in range(6):
        c[8 * k + lane] = 0
    f[8 * T + lane] = 1.0
    f[8 * SEEN_T + lane] = 1.0
    f[8 * LAST + lane] = FARTHEST
    f[8 * GOAL + lane] = b.radius
    c[8 * PATH + lane] = path
    c[8 * STATE + lane] = STARTING


def _aim(w):
    """Where each lane's points are to be corrected, and which lanes predict."""
    for lane in range(8):
        state = w.counters[8 * STATE + lane]
        w.mode[lane] = PREDICT if state == STEPPING else CORRECT
        if state == STEPPING:
            next_t(w, lane)
        elif state == STARTING:
            w.tr[lane] = w.scalars[8 * T + lane]


def _too_long(w, lane, b):
    """Whether a step is too long for the radius of convergence at its end, which is kept if so."""
    f = w.scalars
    h = f[8 * H_USED + lane]
    radius = w.radius[lane]
    if h <= OVERLONG * b.radius_factor * (radius + h):
        return False
    f[8 * SEEN_T + lane] = w.tr[lane]
    f[8 * SEEN_RADIUS + lane] = radius
    return True


def _estimate_noise(s, w, b):
    """What rounding errors make of the corrections of lanes in which these do not contract.

    It is asked for where the second is no small part of the first, or the first is none of the last
    one; but not where they are less than the error that is wanted, or so large that another path
    could not be told from rounding errors.
    """
    one = splat(1.0)
    zero = splat(0.0)
    first = load(w.norms, 0)
    second = load(w.norms, 1)
    last = load(w.scalars, LAST)
    stuck = select_less(first * splat(b.contraction * b.contraction), second, one, zero)
    stuck = select_less(last * last * splat(b.contraction * b.contraction), first, one, stuck)
    stuck = select_less(splat(b.newton_end * b.newton_end), second, stuck, zero)
    stuck = select_less(splat(b.floor * b.floor), second, zero, stuck)
    store(w.noise, 0, stuck)
    wanted = 0
    if any_less(zero, stuck):
        for lane in range(8):
            if w.noise[lane] > 0.0 and w.counters[8 * STATE + lane] != EMPTY:
                wanted += 1
    if wanted > 0:
        rounding_errors(s, w)
        substitute(s.N, w.jr, w.ji, w.pivots, w.br, w.bi)
        store(w.noise, 0, stuck * _length(s, w))


def _judged(w, lane, b):
    """Whether the corrections of a lane let it be accepted; sizes for the next step."""
    f, c = w.scalars, w.counters
    state = c[8 * STATE + lane]
    first = math.sqrt(w.norms[lane])
    second = math.sqrt(w.norms[8 + lane])
    noise = max(b.newton_end, NOISY * math.sqrt(w.noise[lane]))
    if not first < OVERFLOW or not second < OVERFLOW:
        return REJECTED
    theta = second / first if first > 0.0 else 0.0
    rounding = second <= noise
    if state == STEPPING:
        f[8 * FIRST + lane] = first
        f[8 * THETA + lane] = 0.0 if rounding or second <= ROUNDING else theta
        c[8 * ROUNDS + lane] = 0
        if not (theta <= b.contraction or rounding):
            return REJECTED
    else:
        c[8 * ROUNDS + lane] += 1
        # Directions in which corrections do not contract may be hidden in the first ones by others.
        if first > max(b.contraction * f[8 * LAST + lane], noise) or not (theta <= 0.5 or rounding):
            return REJECTED
    f[8 * LAST + lane] = second
    if state != STARTING and _too_long(w, lane, b):
        return OVERSTEPPED
    if state == STEPPING and first > b.tolerance:
        return REJECTED
    # The Taylor coefficients' Jacobian is that before the correction.
    exact = w.tr[lane] == f[8 * GOAL + lane] or state == STARTING
    newton = b.newton_end if exact else b.newton
    left = min(theta, 1.0) * second
    if left <= newton or rounding:
        f[8 * ACCURACY + lane] = max(left if left <= newton else second, LEAST)
        return ACCEPTED
    return UNFINISHED if c[8 * ROUNDS + lane] < 5 else REJECTED


def _accepted(w, lane, b):
    """Go on from the point that was accepted."""
    f, c = w.scalars, w.counters
    power = 1.0 / (b.order + 1)
    f[8 * GROWTH + lane] = 0.0
    if c[8 * STATE + lane] != STARTING:
        first = max(f[8 * FIRST + lane], 1e-300)
        aim = min(
            b.safety * b.tolerance, 0.3 * b.contraction / max(f[8 * THETA + lane], 1e-300) * first
        )
        f[8 * GROWTH + lane] = min((aim / first) ** power, 4.0)
    f[8 * T + lane] = w.tr[lane]
    f[8 * LAST + lane] = FARTHEST
    c[8 * STATE + lane] = STEPPING
    c[8 * FAILURES + lane] = 0


def _failed(w, lane, b, verdict):
    """Try a shorter step; the reason why there is none, or 0."""
    f, c = w.scalars, w.counters
    first = math.sqrt(w.norms[lane])
    finite = first < OVERFLOW
    if c[8 * STATE + lane] == STARTING:
        return START
    shrink = 0.5
    if finite and c[8 * STATE + lane] == STEPPING and first > b.tolerance:
        shrink = (b.safety * b.tolerance / first) ** (1.0 / (b.order + 1))
        shrink = min(max(shrink, 0.1), 0.6)
    elif verdict == OVERSTEPPED:
        # By as much as the radius at its end asks for.
        shrink = 1.0
    f[8 * LAST + lane] = FARTHEST
    c[8 * FAILURES + lane] += 1
    longest = b.radius_factor * radius_as_seen(w, lane)
    f[8 * H + lane] = min(f[8 * H_USED + lane] * shrink, longest)
    c[8 * STATE + lane] = STEPPING
    if f[8 * H + lane] > SHORTEST * f[8 * T + lane]:
        return ARRIVED
    return STEP_SIZE if finite else NOT_FINITE


def _close(s, w, lane, b, reason):
    """Write down where a path ended; its lane becomes free."""
    c = w.counters
    n = s.N
    path = c[8 * PATH + lane]
    b.reason[path] = reason
    b.steps[path] = c[8 * TAKEN + lane]
    if c[8 * TAKEN + lane] > 1:
        for j in range(n):
            b.points[n * path + j] = complex(w.base[8 * j + lane], w.base[8 * (n + j) + lane])
    b.error[path] = w.scalars[8 * ACCURACY + lane] if reason == ARRIVED else np.inf
    c[8 * STATE + lane] = EMPTY


def _arrive(s, w, lane, b):
    """A lane reached its goal: the path has ended, or goes on from its safe point."""
    f, c = w.scalars, w.counters
    n = s.N
    if f[8 * T + lane] == 0.0:
        _close(s, w, lane, b, ARRIVED)
        return
    path = c[8 * PATH + lane]
    b.safe_t[path] = f[8 * T + lane]
    for j in range(n):
        b.safe[n * path + j] = complex(w.base[8 * j + lane], w.base[8 * (n + j) + lane])
    f[8 * GOAL + lane] = 0.0


def _advance(s, w, b):
    """What becomes of each lane's step."""
    f, c = w.scalars, w.counters
    for lane in range(8):
        w.accepted[lane] = 0.0
        if c[8 * STATE + lane] == EMPTY:
            continue
        c[8 * TAKEN + lane] += 1
        reason = ARRIVED
        verdict = _judged(w, lane, b)
        if verdict == ACCEPTED:
            w.accepted[lane] = 1.0
            _accepted(w, lane, b)
        elif verdict <= REJECTED:
            reason = _failed(w, lane, b, verdict)
        elif c[8 * STATE + lane] == STEPPING:
            c[8 * STATE + lane] = CORRECTING
        if f[8 * GOAL + lane] == 0.0 and b.radius > 0.0:
            c[8 * STRAIGHT + lane] += 1
            if c[8 * STRAIGHT + lane] > PATIENCE and verdict <= REJECTED:
                reason = STEPS
        if c[8 * TAKEN + lane] >= b.max_steps and f[8 * T + lane] > 0.0:
            reason = STEPS
        if reason != ARRIVED:
            w.accepted[lane] = 0.0
            _close(s, w, lane, b, reason)


def track_batch(s: System, w: Work, b: Batch) -> None:
    """Track the paths of a batch."""
    following = b.first
    busy = 0
    for lane in range(8):
        _put(s, w, lane, b.starts, b.first)
        w.counters[8 * STATE + lane] = EMPTY
        if following < b.count:
            _fill(s, w, lane, following, b)
            following += b.stride
            busy += 1
    while busy > 0:
        _aim(w)
        predict(s, w, b.order)
        _newton_and_jets(s, w, b.order)
        estimate_radius(w, b.order)
        _estimate_noise(s, w, b)
        _advance(s, w, b)
        _accept(s, w, b.order)
        busy = 0
        for lane in range(8):
            if w.accepted[lane] > 0.5:
                if w.scalars[8 * T + lane] == w.scalars[8 * GOAL + lane]:
                    _arrive(s, w, lane, b)
                next_step(w, b.order, lane, b.safety * b.tolerance, b.radius_factor)
            if w.counters[8 * STATE + lane] == EMPTY and following < b.count:
                _fill(s, w, lane, following, b)
                following += b.stride
            if w.counters[8 * STATE + lane] != EMPTY:
                busy += 1


track_lanes = Kernel(track_batch)
