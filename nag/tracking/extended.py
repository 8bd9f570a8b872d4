"""The path tracker in double-double arithmetic, one path at a time, for paths that doubles lose.

Near an end where the Jacobian decays fast, rounding in doubles hides the path before the endgame
has seen enough of it. Here points, residuals, Jacobians and their factors carry 32 digits; the
predictor is a cubic Hermite polynomial through the last two points, in doubles; in the endgame it
is one in the logarithm of t.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.records import Complexes, Reals, Wholes
from nag.tracking.double_double import (
    add,
    at,
    clear,
    exact,
    factorize,
    minus,
    norm,
    plus,
    put,
    substitute,
    subtract_product,
    times,
)
from nag.tracking.endgame import (
    BEST_ERROR,
    ENDGAME,
    FAILED,
    LOOP,
    NEXT_IM,
    NEXT_RE,
    PATIENCE,
    PHASE,
    SAVED_IM,
    SAVED_RE,
    SHRINK,
    STEP_SIZE,
    STEPS,
    WINDING,
    Endgame,
    arrived,
    begin,
    endgame_state,
    give_up,
)
from nag.tracking.extended_system import (
    Extended,
    ExtendedWork,
    extended_system,
    extended_work,
    jacobian,
    rows_at,
    values,
)
from nag.tracking.homotopy import Homotopy

# Largest first Newton correction after a prediction, and the size at which corrections stop.
TOLERANCE = 1e-6
CONVERGED = 1e-26
NEWTON_STEPS = 10
# Rounding errors of the values, and the largest that points may have with which tracking goes on.
RESIDUAL = 1e-31
ROUNDING = 1e-6
MOST_STEPS = 12000


class ExtendedBatch(NamedTuple):
    """Paths to be tracked and where their results go, see `nag.tracking.kernel.Batch`."""

    starts: Complexes
    count: int
    first: int
    stride: int
    max_steps: int
    points: Complexes
    outcome: Wholes
    winding: Wholes
    error: Reals
    steps: Wholes
    reason: Wholes


def _lay_patch(s, w, x):
    clear(w.patch, s.N)
    for g in range(s.groups):
        total = 0.0
        for j in range(s.N):
            if s.group_of[j] == g:
                total += x[4 * j] ** 2 + x[4 * j + 2] ** 2
        for j in range(s.N):
            if s.group_of[j] == g:
                w.patch[4 * j] = x[4 * j] / total
                w.patch[4 * j + 2] = -x[4 * j + 2] / total


def _normalize(s, x):
    """Scale each group to about unit norm, by a power of two: nothing is rounded."""
    for g in range(s.groups):
        total = 0.0
        for j in range(s.N):
            if s.group_of[j] == g:
                total += x[4 * j] ** 2 + x[4 * j + 2] ** 2
        scale = 2.0 ** np.rint(-0.5 * math.log2(total))
        for j in range(s.N):
            if s.group_of[j] == g:
                for c in range(4):
                    x[4 * j + c] *= scale


def _tangent(s, w, x, t):
    """Derivative of the path, in doubles; the factors of the Jacobian stay in ``m``."""
    n = s.N
    values(s, w, x, t)
    jacobian(s, w, t)
    if not factorize(n, w.m, w.pivots):
        return False
    clear(w.b, n)
    for block in range(s.value_blocks):
        f = s.factors[2 * s.value_part[block] + 1]
        if f == 0.0:
            continue
        total = 0.0, 0.0, 0.0, 0.0
        for q in range(s.value_start[block], s.value_start[block + 1]):
            total = plus(total, times(at(s.value, q), at(w.slots, s.value_slot[q])))
        subtract_product(w.b, s.value_place[block], exact(f), total)
    for k in range(s.linear):
        for j in range(n):
            subtract_product(w.b, s.rows + k, exact(s.A1[n * k + j]), at(x, j))
    substitute(n, w.m, w.pivots, w.b)
    for j in range(n):
        w.slope[j] = complex(w.b[4 * j], w.b[4 * j + 2])
    return True


def _noise(n, w):
    """Size of a correction that is nothing but rounding errors of the values."""
    for i in range(n):
        put(w.b, i, (RESIDUAL if i % 2 == 1 else -RESIDUAL, 0.0, 0.0, 0.0))
    substitute(n, w.m, w.pivots, w.b)
    return norm(n, w.b)


def _correct(s, w, x, t):
    """Newton's method; sizes of the first and the last correction, and success.

    The Jacobian is that of an earlier point as long as corrections contract fast. Those that do
    not contract are rounding errors, or the point is too far from the path.
    """
    n = s.N
    first = 0.0
    last = 1.0
    used = 0
    for k in range(NEWTON_STEPS):
        values(s, w, x, t)
        if used == 0:
            jacobian(s, w, t)
            if not factorize(n, w.m, w.pivots):
                return 1.0, 1.0, False
        substitute(n, w.m, w.pivots, w.b)
        size = norm(n, w.b)
        if not size < 1e10:
            return 1.0, 1.0, False
        if k == 0:
            first = size
            if first > 0.1:
                return first, size, False
        elif size > 0.5 * last and used == 0:
            return first, size, size < min(ROUNDING, 1e2 * _noise(n, w))
        for j in range(n):
            put(x, j, minus(at(x, j), at(w.b, j)))
        used += 1
        if k > 0 and size > 0.1 * last:
            used = 0
        last = size
        if size < CONVERGED:
            return first, size, True
    return first, last, last < min(ROUNDING, 1e2 * _noise(n, w))


def _turned(e):
    """Whether the path is followed in the logarithm of t."""
    return e.whole[PHASE] in (LOOP, SHRINK)


def _slope_in_logarithm(n, w, t):
    for j in range(n):
        w.slope[j] = w.slope[j] * t


def _predict(n, w, z, gap, known):
    """Point ``y`` a step ``z`` on by Hermite interpolation; if nothing is ``known``, the tangent.

    Returns:
        An estimate of the radius of convergence there; 0 if nothing is known.
    """
    sizes = 0.0, 0.0, 0.0
    for j in range(n):
        here = complex(w.x[4 * j], w.x[4 * j + 2])
        w.here[j] = here
        slope = w.slope[j]
        if known:
            secant = (here - w.old[j]) / gap
            second = (slope - secant) / gap
            third = (slope - 2.0 * secant + w.old_slope[j]) / (gap * gap)
            move = z * (slope + z * (second + (z + gap) * third))
            second = second + gap * third
            a, b, c = sizes
            sizes = a + abs(slope) ** 2, b + abs(second) ** 2, c + abs(third) ** 2
        else:
            move = z * slope
        re, re_low = add(w.x[4 * j], w.x[4 * j + 1], move.real, 0.0)
        im, im_low = add(w.x[4 * j + 2], w.x[4 * j + 3], move.imag, 0.0)
        put(w.y, j, (re, re_low, im, im_low))
    a, b, c = sizes
    if not known:
        return 0.0
    return max((b / c) ** 0.5, (a / c) ** 0.25) if c > 0.0 else 1e6


def track_extended_batch(s: Extended, e: Endgame, w: ExtendedWork, batch: ExtendedBatch) -> None:
    """Track paths ``first, first + stride, ..``; results into the arrays."""
    n = s.N
    max_steps = batch.max_steps
    outcome = batch.outcome
    reason = batch.reason
    steps = batch.steps
    x = w.x
    path = batch.first
    while path < batch.count:
        begin(e, 0)
        for j in range(n):
            put(x, j, exact(batch.starts[n * path + j]))
        t = 1.0 + 0.0j
        goal = complex(e.real[NEXT_RE], e.real[NEXT_IM])
        fresh = True
        known = False
        gap = 0.0j
        h = 0.0
        noise = 1e-16
        turned = False
        taken = 0
        done = 0
        while done < 10:
            taken += 1
            if fresh:
                _normalize(s, x)
                _lay_patch(s, w, x)
                rows_at(s, w, t)
                _first, _last, good = _correct(s, w, x, t)
                good = good and _tangent(s, w, x, t)
                if not good:
                    reason[path] = ENDGAME
                    done = 10 + give_up(e, 0)
                    break
                size = 0.0
                for j in range(n):
                    size += abs(w.slope[j]) ** 2
                size = size**0.5
                fresh = False
                known = False
                turned = _turned(e)
                if turned:
                    _slope_in_logarithm(n, w, t)
                    h = min(0.01, 0.01 / (1e-300 + abs(t) * size))
                else:
                    h = min(0.01, 0.01 / (1e-300 + size)) * max(abs(t), 1e-3)
            delta = goal - t
            if turned:
                ratio = goal / t
                delta = complex(math.log(abs(ratio)), math.atan2(ratio.imag, ratio.real))
            length = abs(delta)
            if h >= length:
                z = delta
                following = goal
            else:
                z = delta / length * min(h, 0.5 * length if h > 0.7 * length else h)
                following = t + z
                if turned:
                    following = t * math.exp(z.real) * complex(math.cos(z.imag), math.sin(z.imag))
            radius = _predict(n, w, z, gap, known)
            rows_at(s, w, following)
            first, last, good = _correct(s, w, w.y, following)
            if not good or first > TOLERANCE:
                h = abs(z) * 0.5
                if good:
                    h = abs(z) * min(0.6, max(0.1, (0.2 * TOLERANCE / first) ** 0.25))
                if h < 1e-13 * (1.0 if turned else abs(t)) or taken > max_steps:
                    reason[path] = STEP_SIZE if taken <= max_steps else STEPS
                    done = 10 + give_up(e, 0)
                continue
            for j in range(n):
                w.old[j] = w.here[j]
                w.old_slope[j] = w.slope[j]
                put(x, j, at(w.y, j))
            gap = z
            t = following
            good = _tangent(s, w, x, t)
            known = True
            noise = max(1e-16, last)
            if turned:
                _slope_in_logarithm(n, w, t)
            grow = (0.2 * TOLERANCE / max(first, 1e-300)) ** 0.25
            h = abs(z) * min(max(grow, 0.3), 2.5)
            if not good or taken > max_steps:
                reason[path] = ENDGAME if not good else STEPS
                done = 10 + give_up(e, 0)
            elif t == goal:
                for j in range(n):
                    w.here[j] = complex(x[4 * j], x[4 * j + 2])
                done = arrived(s, e, 0, w.here, noise, 1.0, 0.0, radius, 0j, t)
                if done == -1:
                    done = 0
                    for j in range(n):
                        put(x, j, exact(e.saved[j]))
                    t = complex(e.real[SAVED_RE], e.real[SAVED_IM])
                    fresh = True
                goal = complex(e.real[NEXT_RE], e.real[NEXT_IM])
                if turned != _turned(e):
                    fresh = True
            size = norm(n, x)
            if size > 4.0 or size < 0.25:
                fresh = True
        outcome[path] = done - 10
        steps[path] = taken
        if done - 10 == FAILED:
            if reason[path] == 0:
                reason[path] = ENDGAME
            for j in range(n):
                batch.points[n * path + j] = complex(x[4 * j], x[4 * j + 2])
            batch.error[path] = np.inf
        else:
            reason[path] = 0
            for j in range(n):
                batch.points[n * path + j] = e.best[j]
            batch.winding[path] = e.whole[WINDING]
            batch.error[path] = e.real[BEST_ERROR]
        path += batch.stride


extended_kernel = Kernel(track_extended_batch, "tracking")


def track_extended(
    homotopy: Homotopy,
    starts: np.ndarray,
    *,
    threads: int,
    end_exponent: int,
    radius: float,
    samples: int,
    max_winding: int,
    levels: int,
    max_steps: int = MOST_STEPS,
) -> tuple[np.ndarray, ...]:
    """Track paths with the endgame of `nag.tracking.endgame` in double-double arithmetic.

    Returns:
        points (P, N), outcome, winding, error, steps and reason of each path, as the kernel in
        doubles gives them; ``outcome`` is `endgame.CAUCHY` or `FAILED`.
    """
    P = len(starts)
    results = (
        np.zeros((P, homotopy.N), dtype=np.complex128),
        np.zeros(P, dtype=np.int64),
        np.zeros(P, dtype=np.int64),
        np.full(P, np.inf),
        np.zeros(P, dtype=np.int64),
        np.zeros(P, dtype=np.int64),
    )
    extended_kernel.prepare()
    arrays = extended_system(homotopy)
    starts = np.ascontiguousarray(starts)
    batches = max(1, min(threads, P))

    def batch(first: int) -> None:
        state = endgame_state(
            homotopy.N, end_exponent, True, False, PATIENCE, radius, samples, max_winding, levels
        )
        paths = ExtendedBatch(starts, P, first, batches, max_steps, *results)
        extended_kernel(arrays, state, extended_work(homotopy), paths)

    if batches == 1:
        batch(0)
    else:
        with ThreadPoolExecutor(batches) as pool:
            list(pool.map(batch, range(batches)))
    return results
