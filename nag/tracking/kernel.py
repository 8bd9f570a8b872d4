"""The path tracker's kernel: eight paths at a time, refilled from a queue."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import fma, load, select_less, splat, store
from nag.machine_code.records import Complexes, Reals, Wholes
from nag.tracking.endgame import (
    BEST_ERROR,
    ENDGAME,
    FAILED,
    LOOP,
    MAIN,
    NEXT_IM,
    NEXT_RE,
    NOT_FINITE,
    PHASE,
    REALS,
    SAVED_IM,
    SAVED_RE,
    SHORT_STEPS,
    SHORTCUT,
    SHRINK,
    START,
    STEP_SIZE,
    STEPS,
    WHOLES,
    WINDING,
    Endgame,
    arrived,
    begin,
    give_up,
    retreat,
)
from nag.tracking.jets import (
    System,
    Work,
    complete_slots,
    factors_at,
    incomplete_slots,
    jacobian,
    normalize,
    products,
    right_side,
    values,
)
from nag.tracking.linear_algebra import factorize, pivot_ratio, substitute
from nag.tracking.logarithm import turn
from nag.tracking.predictor import (
    ACCURACY,
    CORRECT,
    FIRST,
    GOAL_IM,
    GOAL_RE,
    GROWTH,
    H_USED,
    LOGARITHMIC,
    PREDICT,
    SCALARS,
    T_IM,
    T_RE,
    THETA,
    H,
    branch_point,
    convergence_radius,
    next_step,
    next_t,
    predict,
)

# Steps after which a straight run to t = 0 ends with the first that is not accepted.
SHORT = 12


def _correct(s, w, norms, k):
    """Add the solution to the point; squared norm of it, the largest of the groups."""
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
    for j in range(s.N):
        store(w.vr, j, load(w.vr, j) + load(w.br, j))
        store(w.vi, j, load(w.vi, j) + load(w.bi, j))
    store(norms, k, largest)


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
    jacobian(s, w)
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


def _accept(s, w, order):
    """Make the current points and Taylor coefficients the base, in the lanes accepted."""
    n = s.N
    half = splat(0.5)
    a = load(w.accepted, 0)
    size = n + 1 + s.value_products
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


# Rows of the lanes' counters.
PATH, ROUNDS, TAKEN, REJECTED, STATE = range(5)
COUNTERS = 5


def _put(s, w, lane, points, k):
    for j in range(s.N):
        x = points[s.N * k + j]
        w.vr[8 * j + lane] = x.real
        w.vi[8 * j + lane] = x.imag


def _fill(s, w, e, f, c, lane, path, starts):
    """Put a path into a lane."""
    _put(s, w, lane, starts, path)
    for k in range(SCALARS):
        f[8 * k + lane] = 0.0
    for k in range(COUNTERS):
        c[8 * k + lane] = 0
    f[8 * T_RE + lane] = 1.0
    c[8 * PATH + lane] = path
    c[8 * STATE + lane] = 1
    begin(e, lane)
    f[8 * GOAL_RE + lane] = e.real[REALS * lane + NEXT_RE]
    f[8 * GOAL_IM + lane] = e.real[REALS * lane + NEXT_IM]


def _restart(s, w, e, f, c, lane):
    """Go back to the point that the endgame saved."""
    _put(s, w, lane, e.saved, lane)
    f[8 * T_RE + lane] = e.real[REALS * lane + SAVED_RE]
    f[8 * T_IM + lane] = e.real[REALS * lane + SAVED_IM]
    f[8 * GOAL_RE + lane] = e.real[REALS * lane + NEXT_RE]
    f[8 * GOAL_IM + lane] = e.real[REALS * lane + NEXT_IM]
    c[8 * STATE + lane] = 1
    c[8 * ROUNDS + lane] = 0
    c[8 * REJECTED + lane] = 0


class Batch(NamedTuple):
    """Paths to be tracked in one batch, where their results go, and the settings.

    ``starts``: points at t = 1, shape (count, N), of which ``first, first + stride, ..`` are
    tracked; ``points``: end points. ``outcome, winding, error, steps, reason``: one each path.
    The rest: see `nag.tracking.settings.Settings`.
    """

    starts: Complexes
    count: int
    first: int
    stride: int
    points: Complexes
    outcome: Wholes
    winding: Wholes
    error: Reals
    steps: Wholes
    reason: Wholes
    order: int
    max_steps: int
    tolerance: float
    newton: float
    newton_end: float
    floor: float
    radius_factor: float
    safety: float
    contraction: float


def track_batch(s: System, w: Work, e: Endgame, batch: Batch) -> None:
    """Track the paths of a batch."""
    n = s.N
    order = batch.order
    max_steps = batch.max_steps
    count = batch.count
    stride = batch.stride
    starts = batch.starts
    points = batch.points
    outcome = batch.outcome
    winding = batch.winding
    error = batch.error
    steps = batch.steps
    reason = batch.reason
    floor = batch.floor
    safety = batch.safety
    theta_max = batch.contraction
    f = w.scalars
    c = w.counters
    x = w.x
    power = 1.0 / (order + 1)
    norms = w.norms
    mode = w.mode
    accepted = w.accepted
    following = batch.first
    busy = 0
    for lane in range(8):
        c[8 * STATE + lane] = -1
        _put(s, w, lane, starts, batch.first)
        if following < count:
            _fill(s, w, e, f, c, lane, following, starts)
            following += stride
            busy += 1
    while busy:
        for lane in range(8):
            state = c[8 * STATE + lane]
            mode[lane] = PREDICT if state == 0 else CORRECT
            if state == 0:
                next_t(w, lane)
            elif state == 1:
                w.tr[lane] = f[8 * T_RE + lane]
                w.ti[lane] = f[8 * T_IM + lane]
        predict(s, w, order)
        _newton_and_jets(s, w, order)
        turning = 0
        for lane in range(8):
            accepted[lane] = 0.0
            state = c[8 * STATE + lane]
            if state < 0:
                continue
            c[8 * TAKEN + lane] += 1
            n0 = norms[lane] ** 0.5
            n1 = norms[8 + lane] ** 0.5
            ending = e.whole[WHOLES * lane + PHASE] != MAIN
            looping = e.whole[WHOLES * lane + PHASE] == LOOP
            closing = looping or e.whole[WHOLES * lane + PHASE] == SHRINK
            tolerance = min(batch.tolerance, 1e-4) if looping else batch.tolerance
            arriving = w.tr[lane] == f[8 * GOAL_RE + lane] and w.ti[lane] == f[8 * GOAL_IM + lane]
            # The Taylor coefficients' Jacobian is that before the correction, which where the
            # Jacobian decays must be small against its smallest singular value.
            newton = batch.newton_end if arriving or closing or state == 1 else batch.newton
            finite = n0 < 1e100 and n1 < 1e100
            ok = finite
            if finite:
                theta = n1 / n0 if n0 > 0.0 else 0.0
                left = min(theta, 1.0) * n1
                if state == 0:
                    f[8 * FIRST + lane] = n0
                    # Corrections that do not contract any more are rounding errors.
                    rounding = n1 <= (1e-7 if ending else 1e-9)
                    f[8 * THETA + lane] = 0.0 if rounding else theta
                    c[8 * ROUNDS + lane] = 0
                    rounding = rounding or (n1 <= floor and c[8 * REJECTED + lane] >= 2)
                    ok = n0 <= tolerance and (theta <= theta_max or rounding)
                else:
                    c[8 * ROUNDS + lane] += 1
                    ok = n0 <= 0.1 and (theta <= 0.5 or n1 <= floor)
                if ok:
                    idle = c[8 * ROUNDS + lane] >= 1 and theta > 0.3
                    if left <= newton or ((c[8 * ROUNDS + lane] >= 3 or idle) and n1 <= floor):
                        accepted[lane] = 1.0
                    elif c[8 * ROUNDS + lane] >= 5:
                        ok = False
            if accepted[lane] > 0.5:
                f[8 * ACCURACY + lane] = left if left > 1e-15 else 1e-15
                if c[8 * ROUNDS + lane] >= 1 and left > newton:
                    f[8 * ACCURACY + lane] = n1
                f[8 * GROWTH + lane] = 0.0
                if state != 1:
                    aim = safety * tolerance
                    n0 = max(f[8 * FIRST + lane], 1e-300)
                    aim = min(aim, 0.3 * theta_max / max(f[8 * THETA + lane], 1e-300) * n0)
                    f[8 * GROWTH + lane] = min((aim / n0) ** power, 4.0)
                if closing or (arriving and e.active):
                    turning = 1
                f[8 * T_RE + lane] = w.tr[lane]
                f[8 * T_IM + lane] = w.ti[lane]
                c[8 * STATE + lane] = 0
                c[8 * REJECTED + lane] = 0
            elif ok:
                # Converging, but not there yet: another Newton step at the same t.
                c[8 * STATE + lane] = 2 if state != 1 else 1
            elif state == 1:
                c[8 * STATE + lane] = -2
                reason[c[8 * PATH + lane]] = START if not ending else ENDGAME
            else:
                c[8 * REJECTED + lane] += 1
                shrink = 0.5
                if finite and state == 0 and f[8 * FIRST + lane] > tolerance:
                    shrink = (safety * tolerance / f[8 * FIRST + lane]) ** power
                    shrink = min(max(shrink, 0.1), 0.6)
                f[8 * H + lane] = f[8 * H_USED + lane] * shrink
                c[8 * STATE + lane] = 0
                size = 1.0
                if f[8 * LOGARITHMIC + lane] < 0.5:
                    size = (f[8 * T_RE + lane] ** 2 + f[8 * T_IM + lane] ** 2) ** 0.5
                if not f[8 * H + lane] > 1e-10 * size:
                    c[8 * STATE + lane] = -2
                    reason[c[8 * PATH + lane]] = STEP_SIZE if finite else NOT_FINITE
            if c[8 * TAKEN + lane] >= max_steps and c[8 * STATE + lane] >= 0:
                accepted[lane] = 0.0
                c[8 * STATE + lane] = -2
                reason[c[8 * PATH + lane]] = STEPS
            if e.whole[WHOLES * lane + PHASE] == SHORTCUT:
                e.whole[WHOLES * lane + SHORT_STEPS] += 1
                if (e.whole[WHOLES * lane + SHORT_STEPS] > SHORT and accepted[lane] < 0.5) or c[
                    8 * STATE + lane
                ] == -2:
                    accepted[lane] = 0.0
                    c[8 * STATE + lane] = -3
        _accept(s, w, order)
        if turning:
            turn(s, w, order, load(f, T_RE), load(f, T_IM))
        for lane in range(8):
            state = c[8 * STATE + lane]
            if state == -1:
                continue
            done = 0
            path = c[8 * PATH + lane]
            if state == -3:
                retreat(s, e, lane, False)
                _restart(s, w, e, f, c, lane)
                continue
            if state == -2:
                done = 10 + give_up(e, lane)
            elif (
                accepted[lane] > 0.5
                and f[8 * T_RE + lane] == f[8 * GOAL_RE + lane]
                and f[8 * T_IM + lane] == f[8 * GOAL_IM + lane]
            ):
                for j in range(n):
                    x[j] = complex(w.base[8 * j + lane], w.base[8 * (n + j) + lane])
                time = complex(f[8 * T_RE + lane], f[8 * T_IM + lane])
                hint = pivot_ratio(n, w.jr, w.ji, lane)
                done = arrived(
                    s,
                    e,
                    lane,
                    x,
                    f[8 * ACCURACY + lane],
                    hint,
                    convergence_radius(norms, order + 1, lane),
                    convergence_radius(w.turned_norms, order - 1, lane),
                    branch_point(s, w, order, lane),
                    time,
                )
                if done == -1:
                    _restart(s, w, e, f, c, lane)
                    continue
                f[8 * GOAL_RE + lane] = e.real[REALS * lane + NEXT_RE]
                f[8 * GOAL_IM + lane] = e.real[REALS * lane + NEXT_IM]
                if done == 0 and c[8 * TAKEN + lane] >= max_steps:
                    reason[path] = STEPS
                    done = 10 + give_up(e, lane)
            if accepted[lane] > 0.5:
                phase = e.whole[WHOLES * lane + PHASE]
                tolerance = min(batch.tolerance, 1e-4) if phase == LOOP else batch.tolerance
                turned = phase in (LOOP, SHRINK)
                next_step(w, order, lane, safety * tolerance, batch.radius_factor, turned)
            if done >= 10:
                outcome[path] = done - 10
                steps[path] = c[8 * TAKEN + lane]
                if done - 10 == FAILED:
                    if reason[path] == 0:
                        reason[path] = ENDGAME
                    for j in range(n):
                        points[n * path + j] = complex(
                            w.base[8 * j + lane], w.base[8 * (n + j) + lane]
                        )
                    error[path] = np.inf
                else:
                    reason[path] = 0
                    for j in range(n):
                        points[n * path + j] = e.best[n * lane + j]
                    winding[path] = e.whole[WHOLES * lane + WINDING]
                    error[path] = e.real[REALS * lane + BEST_ERROR]
                busy -= 1
                c[8 * STATE + lane] = -1
                if following < count:
                    _fill(s, w, e, f, c, lane, following, starts)
                    following += stride
                    busy += 1


track_lanes = Kernel(track_batch, "tracking")
