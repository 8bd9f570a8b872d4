"""The path tracker's kernel in doubles: eight paths at a time, refilled from a queue.

Each path runs to t = ``radius``, where its point is kept, and from there straight on to t = 0, for
as long as it gets on: what happens to it there is for `nag.tracking.ends` to find out.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import any_less, load, select_less, splat, store
from nag.machine_code.records import Complexes, Reals, Wholes
from nag.numerics.doubles import ROUNDED
from nag.tracking.evaluation import complete_slots, incomplete_slots, products
from nag.tracking.kernel_arrays import KernelEquations, Work
from nag.tracking.linear_algebra import factorize, substitute
from nag.tracking.numbers.doubles import DOUBLES, ComplexDoubles
from nag.tracking.predictor import (
    CORRECT,
    OVERLONG,
    PREDICT,
    estimate_radius,
    next_step,
    next_t,
    predict,
    radius_as_seen,
)
from nag.tracking.taylor import (
    complete_slope,
    factors_of_member,
    factors_or_powers_at,
    jacobian_and_slopes,
    normalize,
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
# Decides: Steps tried behind the safe point before a path that does not get on goes to
# more digits, where a step takes some forty times as long. Ends that are far out need most: of
# chandra-10's 512 paths 110 arrive within 48, 350 within 120, 467 within these, 469 within 400.
PATIENCE = 240
# Second corrections as small as this do not say how much longer a step may be.
ROUNDING = 1e-9
# Steps, relative to t, at which a path is left to others.
SHORTEST = 1e-10
# Decides: Rounding errors of a correction, as estimated, that it may be and need not contract any
# more: such lay below 3.3, others above 30 but for 1 in 100, and a few between.
NOISY = 10.0
# What stands for the last correction of a point where there is none.
FARTHEST = 1.0
# Corrections as large as this lead nowhere; their squares are still numbers.
OVERFLOW = 1e100


def _length(z, s, w):
    """Squared norm of the right-hand side, the largest of the groups."""
    zero = splat(0.0)
    largest = zero
    for g in range(s.groups):
        total = zero
        for j in range(s.N):
            if s.group_of[j] == g:
                total = z.add_square(total, z.read(w.right, j))
        largest = select_less(total, largest, largest, total)
    return largest


def _correct(z, s, w, k):
    """Add the solution to the point; its squared norm."""
    store(w.norms, k, _length(z, s, w))
    for j in range(s.N):
        z.write(w.slots, j, z.add(z.read(w.slots, j), z.read(w.right, j)))


def _measure(z, s, w, order):
    """Squared norm of the Taylor coefficient in the right-hand side."""
    total = splat(0.0)
    for j in range(s.N):
        total = z.add_square(total, z.read(w.right, j))
    store(w.norms, 1 + order, total)


def _newton_and_jets(z, s, w, order):
    """One Newton step, one simplified one, and the Taylor coefficients of the path."""
    n = s.N
    normalize(z, s, w)
    factors_or_powers_at(z, s, w)
    products(z, s, w, 0, s.products)
    values(z, s, w)
    jacobian_and_slopes(z, s, w)
    factorize(z, n, w.matrix, w.pivots)
    substitute(z, n, w.matrix, w.pivots, w.right)
    _correct(z, s, w, 0)
    products(z, s, w, 0, s.value_products)
    values(z, s, w)
    substitute(z, n, w.matrix, w.pivots, w.right)
    # The slots stay those of the point before this correction, which is far smaller than the
    # error of the Taylor coefficients.
    _correct(z, s, w, 1)
    for k in range(1, order + 1):
        if k > 1:
            incomplete_slots(z, s, w, k)
        right_side(z, s, w, k)
        substitute(z, n, w.matrix, w.pivots, w.right)
        _measure(z, s, w, k)
        complete_slots(z, s, w, k)
        complete_slope(z, s, w)


def _accept(z, s, w, order):
    """Make the current points and Taylor coefficients the base, in the lanes accepted."""
    for j in range(s.N):
        _keep(z, w, j, z.read(w.slots, j))
    for k in range(1, order + 1):
        top = (k - 1) * (s.N + 1 + s.inner)
        for j in range(s.N):
            _keep(z, w, k * s.N + j, z.read(w.series, top + j))


def _keep(z, w, k, x):
    z.write(w.base, k, z.choose(splat(0.5), load(w.accepted, 0), x, z.read(w.base, k)))


class Batch(NamedTuple):
    """Paths to be tracked in one batch, where their results go, and the settings.

    ``starts``: points at t = 1, shape (count, N), of which ``first, first + stride, ..`` are
    tracked; ``member``: whose factors each of them has. ``points``: where they ended, at t = 0 if
    their ``reason`` is 0; ``safe``: their
    points at ``safe_t``, which is ``radius``, or 1 for those that did not get there.
    ``error, steps, reason``: one for each path. The rest: see
    `nag.tracking.settings.Settings`; a ``radius`` of 0 stands for none.
    """

    starts: Complexes
    member: Wholes
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


def _put(s, w, lane, b, path):
    for j in range(s.N):
        x = b.starts[s.N * path + j]
        w.slots[16 * j + lane] = x.real
        w.slots[16 * j + 8 + lane] = x.imag
    if s.toric == 0:
        factors_of_member(s, w, lane, b.member[path])


def _fill(s, w, lane, path, b):
    """Put a path into a lane."""
    _put(s, w, lane, b, path)
    w.h[lane] = w.taken_h[lane] = w.first[lane] = w.theta[lane] = 0.0
    w.accuracy[lane] = w.growth[lane] = w.seen_radius[lane] = 0.0
    w.rounds[lane] = w.taken[lane] = w.straight[lane] = 0
    w.here[lane] = 1.0
    w.seen_t[lane] = 1.0
    w.last[lane] = FARTHEST
    w.goal[lane] = b.radius
    w.path[lane] = path
    w.state[lane] = STARTING


def _aim(w):
    """Where each lane's points are to be corrected, and which lanes predict."""
    for lane in range(8):
        state = w.state[lane]
        w.mode[lane] = PREDICT if state == STEPPING else CORRECT
        if state == STEPPING:
            next_t(w, lane)
        elif state == STARTING:
            w.t[lane] = w.here[lane]


def _too_long(w, lane, b):
    """Whether a step is too long for the radius of convergence at its end, which is kept if so."""
    h = w.taken_h[lane]
    radius = w.radius[lane]
    if h <= OVERLONG * b.radius_factor * (radius + h):
        return False
    w.seen_t[lane] = w.t[lane]
    w.seen_radius[lane] = radius
    return True


def _estimate_noise(z, s, w, b):
    """What rounding errors make of the corrections of lanes in which these do not contract.

    It is asked for where the second is no small part of the first, or the first is none of the last
    one; but not where they are less than the error that is wanted, or so large that another path
    could not be told from rounding errors.
    """
    one = splat(1.0)
    zero = splat(0.0)
    first = load(w.norms, 0)
    second = load(w.norms, 1)
    last = load(w.last, 0)
    stuck = select_less(first * splat(b.contraction * b.contraction), second, one, zero)
    stuck = select_less(last * last * splat(b.contraction * b.contraction), first, one, stuck)
    stuck = select_less(splat(b.newton_end * b.newton_end), second, stuck, zero)
    stuck = select_less(splat(b.floor * b.floor), second, zero, stuck)
    store(w.noise, 0, stuck)
    wanted = 0
    if any_less(zero, stuck):
        for lane in range(8):
            if w.noise[lane] > 0.0 and w.state[lane] != EMPTY:
                wanted += 1
    if wanted > 0:
        rounding_errors(z, s, w)
        substitute(z, s.N, w.matrix, w.pivots, w.right)
        store(w.noise, 0, stuck * _length(z, s, w))


def _judge_corrections(w, lane, b):
    """Whether the corrections of a lane let it be accepted; sizes for the next step."""
    state = w.state[lane]
    first = math.sqrt(w.norms[lane])
    second = math.sqrt(w.norms[8 + lane])
    noise = max(b.newton_end, NOISY * math.sqrt(w.noise[lane]))
    if not first < OVERFLOW or not second < OVERFLOW:
        return REJECTED
    theta = second / first if first > 0.0 else 0.0
    rounding = second <= noise
    if state == STEPPING:
        w.first[lane] = first
        w.theta[lane] = 0.0 if rounding or second <= ROUNDING else theta
        w.rounds[lane] = 0
        if not (theta <= b.contraction or rounding):
            return REJECTED
    else:
        w.rounds[lane] += 1
        # Directions in which corrections do not contract may be hidden in the first ones by others.
        if first > max(b.contraction * w.last[lane], noise) or not (theta <= 0.5 or rounding):
            return REJECTED
    w.last[lane] = second
    if state != STARTING and _too_long(w, lane, b):
        return OVERSTEPPED
    if state == STEPPING and first > b.tolerance:
        return REJECTED
    # The Taylor coefficients' Jacobian is that before the correction.
    exact = w.t[lane] == w.goal[lane] or state == STARTING
    newton = b.newton_end if exact else b.newton
    left = min(theta, 1.0) * second
    if left <= newton or rounding:
        w.accuracy[lane] = max(left if left <= newton else second, ROUNDED)
        return ACCEPTED
    return UNFINISHED if w.rounds[lane] < 5 else REJECTED


def _accept_step(w, lane, b):
    """Go on from the point that was accepted."""
    power = 1.0 / (b.order + 1)
    w.growth[lane] = 0.0
    if w.state[lane] != STARTING:
        first = max(w.first[lane], 1e-300)
        aim = min(b.safety * b.tolerance, 0.3 * b.contraction / max(w.theta[lane], 1e-300) * first)
        w.growth[lane] = min((aim / first) ** power, 4.0)
    w.here[lane] = w.t[lane]
    w.last[lane] = FARTHEST
    w.state[lane] = STEPPING


def _reject_step(w, lane, b, verdict):
    """Try a shorter step; the reason why there is none, or 0."""
    first = math.sqrt(w.norms[lane])
    finite = first < OVERFLOW
    if w.state[lane] == STARTING:
        return START
    shrink = 0.5
    if finite and w.state[lane] == STEPPING and first > b.tolerance:
        shrink = (b.safety * b.tolerance / first) ** (1.0 / (b.order + 1))
        shrink = min(max(shrink, 0.1), 0.6)
    elif verdict == OVERSTEPPED:
        # By as much as the radius at its end asks for.
        shrink = 1.0
    w.last[lane] = FARTHEST
    longest = b.radius_factor * radius_as_seen(w, lane)
    w.h[lane] = min(w.taken_h[lane] * shrink, longest)
    w.state[lane] = STEPPING
    if w.h[lane] > SHORTEST * w.here[lane]:
        return ARRIVED
    return STEP_SIZE if finite else NOT_FINITE


def _close(s, w, lane, b, reason):
    """Write down where a path ended; its lane becomes free."""
    n = s.N
    path = w.path[lane]
    b.reason[path] = reason
    b.steps[path] = w.taken[lane]
    if w.taken[lane] > 1:
        for j in range(n):
            b.points[n * path + j] = complex(w.base[16 * j + lane], w.base[16 * j + 8 + lane])
    b.error[path] = w.accuracy[lane] if reason == ARRIVED else np.inf
    w.state[lane] = EMPTY


def _arrive(s, w, lane, b):
    """A lane reached its goal: the path has ended, or goes on from its safe point."""
    n = s.N
    if w.here[lane] == 0.0:
        _close(s, w, lane, b, ARRIVED)
        return
    path = w.path[lane]
    b.safe_t[path] = w.here[lane]
    for j in range(n):
        b.safe[n * path + j] = complex(w.base[16 * j + lane], w.base[16 * j + 8 + lane])
    w.goal[lane] = 0.0


def _advance(s, w, b):
    """What becomes of each lane's step."""
    for lane in range(8):
        w.accepted[lane] = 0.0
        if w.state[lane] == EMPTY:
            continue
        w.taken[lane] += 1
        reason = ARRIVED
        verdict = _judge_corrections(w, lane, b)
        if verdict == ACCEPTED:
            w.accepted[lane] = 1.0
            _accept_step(w, lane, b)
        elif verdict <= REJECTED:
            reason = _reject_step(w, lane, b, verdict)
        elif w.state[lane] == STEPPING:
            w.state[lane] = CORRECTING
        if w.goal[lane] == 0.0 and b.radius > 0.0:
            w.straight[lane] += 1
            if w.straight[lane] > PATIENCE and verdict <= REJECTED:
                reason = STEPS
        if w.taken[lane] >= b.max_steps and w.here[lane] > 0.0:
            reason = STEPS
        if reason != ARRIVED:
            w.accepted[lane] = 0.0
            _close(s, w, lane, b, reason)


def track_batch(z: ComplexDoubles, s: KernelEquations, w: Work, b: Batch) -> None:
    """Track the paths of a batch."""
    following = b.first
    busy = 0
    for lane in range(8):
        _put(s, w, lane, b, b.first)
        w.state[lane] = EMPTY
        if following < b.count:
            _fill(s, w, lane, following, b)
            following += b.stride
            busy += 1
    while busy > 0:
        _aim(w)
        predict(z, s, w, b.order)
        _newton_and_jets(z, s, w, b.order)
        estimate_radius(w, b.order)
        _estimate_noise(z, s, w, b)
        _advance(s, w, b)
        _accept(z, s, w, b.order)
        busy = 0
        for lane in range(8):
            if w.accepted[lane] > 0.5:
                if w.here[lane] == w.goal[lane]:
                    _arrive(s, w, lane, b)
                next_step(w, b.order, lane, b.safety * b.tolerance, b.radius_factor)
            if w.state[lane] == EMPTY and following < b.count:
                _fill(s, w, lane, following, b)
                following += b.stride
            if w.state[lane] != EMPTY:
                busy += 1


track_lanes = Kernel(track_batch, DOUBLES)
