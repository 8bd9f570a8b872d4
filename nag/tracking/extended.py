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
from nag.tracking.compiled import CompiledRows
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
from nag.tracking.homotopy import Homotopy
from nag.tracking.precision import split

# Largest first Newton correction after a prediction, and the size at which corrections stop.
TOLERANCE = 1e-6
CONVERGED = 1e-26
NEWTON_STEPS = 10
# Rounding errors of the values, and the largest that points may have with which tracking goes on.
RESIDUAL = 1e-31
ROUNDING = 1e-6
MOST_STEPS = 12000
_SPLITTER = 134217729.0


class Extended(NamedTuple):
    """A homotopy with double-double coefficients, four doubles each: re, re low, im, im low.

    See `nag.tracking.compiled.Tape`; the numbers say how long the arrays are.
    """

    N: int
    rows: int
    linear: int
    groups: int
    products: int
    value_blocks: int
    jacobian_blocks: int
    group_of: Wholes
    first: Wholes
    second: Wholes
    value_place: Wholes
    value_part: Wholes
    value_start: Wholes
    value_slot: Wholes
    value: Reals
    jacobian_place: Wholes
    jacobian_part: Wholes
    jacobian_start: Wholes
    jacobian_slot: Wholes
    jacobian: Reals
    factors: Complexes
    A0: Complexes
    A1: Complexes


class ExtendedWork(NamedTuple):
    """Scratch of one path; double-doubles are four doubles each, see `Extended`.

    ``x, y``: points. ``patch``: linear forms that normalise them. ``slots``: of the last point.
    ``lines``: linear rows at t. ``m``: Jacobian, then its factors. ``b``: values, then solutions.
    ``slope, old, old_slope, here``: tangents and points in doubles.
    """

    x: Reals
    y: Reals
    patch: Reals
    slots: Reals
    lines: Reals
    m: Reals
    b: Reals
    pivots: Wholes
    slope: Complexes
    old: Complexes
    old_slope: Complexes
    here: Complexes


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


def _quads(pairs: list[tuple[complex, complex]]) -> np.ndarray:
    flat = [(h.real, low.real, h.imag, low.imag) for h, low in pairs]
    return np.array(flat, dtype=float).reshape(-1, 4)


def _coefficients(rows: CompiledRows) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of the values and of the Jacobian, in the order of the rows' tape."""
    values: list[tuple[complex, complex]] = []
    blocks: list[tuple[int, int, list[tuple[complex, complex]]]] = []
    for r, (row, scale) in enumerate(zip(rows.parts, rows.scales, strict=True)):
        for part, terms in row:
            derivatives: dict[int, list[tuple[complex, complex]]] = {}
            for e in sorted(terms, reverse=True):
                values.append(split(terms[e], scale))
                for j, k in enumerate(e):
                    if k:
                        derivatives.setdefault(j, []).append(split(terms[e] * k, scale))
            blocks += [(r * rows.N + j, part, derivatives[j]) for j in sorted(derivatives)]
    blocks.sort(key=lambda block: (block[0], block[1]))
    return _quads(values), _quads([pair for *_, block in blocks for pair in block])


def extended_system(homotopy: Homotopy) -> Extended:
    """The arrays of ``homotopy`` for `track_extended_batch`."""
    tape = homotopy.rows.tape
    value, jacobian = _coefficients(homotopy.rows)
    return Extended(
        homotopy.N,
        len(homotopy.rows),
        len(homotopy.A0),
        len(homotopy.groups),
        len(tape.first),
        len(tape.value_place),
        len(tape.jacobian_place),
        homotopy.group_of,
        tape.first,
        tape.second,
        tape.value_place,
        tape.value_part,
        tape.value_start,
        tape.value_slot,
        value,
        tape.jacobian_place,
        tape.jacobian_part,
        tape.jacobian_start,
        tape.jacobian_slot,
        jacobian,
        np.array(homotopy.factors, dtype=np.complex128).reshape(-1, 2),
        np.ascontiguousarray(homotopy.A0),
        np.ascontiguousarray(homotopy.A1),
    )


def _extended_work(homotopy: Homotopy) -> ExtendedWork:
    N = homotopy.N
    slots = N + 1 + len(homotopy.rows.tape.first)
    sizes = [N, N, N, slots, len(homotopy.A0) * N, N * N, N]
    return ExtendedWork(
        *(np.zeros(4 * size) for size in sizes),
        np.zeros(N, dtype=np.int64),
        *(np.zeros(N, dtype=np.complex128) for _ in range(4)),
    )


def _sum(ah, al, bh, bl):
    s = ah + bh
    v = s - ah
    e = (ah - (s - v)) + (bh - v) + (al + bl)
    h = s + e
    return h, e - (h - s)


def _product(ah, al, bh, bl):
    p = ah * bh
    t = _SPLITTER * ah
    a1 = t - (t - ah)
    a2 = ah - a1
    t = _SPLITTER * bh
    b1 = t - (t - bh)
    b2 = bh - b1
    e = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2 + (ah * bl + al * bh)
    h = p + e
    return h, e - (h - p)


def _times(a, b):
    """Product of complex double-doubles."""
    ph, pl = _product(a[0], a[1], b[0], b[1])
    qh, ql = _product(a[2], a[3], b[2], b[3])
    rh, rl = _product(a[0], a[1], b[2], b[3])
    sh, sl = _product(a[2], a[3], b[0], b[1])
    re, re_low = _sum(ph, pl, -qh, -ql)
    im, im_low = _sum(rh, rl, sh, sl)
    return re, re_low, im, im_low


def _plus(a, b):
    re, re_low = _sum(a[0], a[1], b[0], b[1])
    im, im_low = _sum(a[2], a[3], b[2], b[3])
    return re, re_low, im, im_low


def _minus(a, b):
    re, re_low = _sum(a[0], a[1], -b[0], -b[1])
    im, im_low = _sum(a[2], a[3], -b[2], -b[3])
    return re, re_low, im, im_low


def _at(data, k):
    """Complex double-double ``k`` of an array."""
    return data[4 * k], data[4 * k + 1], data[4 * k + 2], data[4 * k + 3]


def _put(data, k, a):
    data[4 * k] = a[0]
    data[4 * k + 1] = a[1]
    data[4 * k + 2] = a[2]
    data[4 * k + 3] = a[3]


def _exact(z):
    return z.real, 0.0, z.imag, 0.0


def _add_product(data, k, a, b):
    _put(data, k, _plus(_at(data, k), _times(a, b)))


def _subtract_product(data, k, a, b):
    _put(data, k, _minus(_at(data, k), _times(a, b)))


def _clear(data, count):
    for k in range(4 * count):
        data[k] = 0.0


def _fill_slots(s, w, x):
    n = s.N
    for j in range(4 * n):
        w.slots[j] = x[j]
    _put(w.slots, n, (1.0, 0.0, 0.0, 0.0))
    for k in range(s.products):
        _put(w.slots, n + 1 + k, _times(_at(w.slots, s.first[k]), _at(w.slots, s.second[k])))


def _blocks(w, count, place, part, start, slot, coefficient, factors, t, out):
    for b in range(count):
        total = 0.0, 0.0, 0.0, 0.0
        for q in range(start[b], start[b + 1]):
            total = _plus(total, _times(_at(coefficient, q), _at(w.slots, slot[q])))
        f = factors[2 * part[b]] + t * factors[2 * part[b] + 1]
        if f != 1.0:
            total = _times(_exact(f), total)
        _put(out, place[b], _plus(_at(out, place[b]), total))


def _rows_at(s, w, t):
    """Linear rows at t as double-doubles: t A1 is not rounded."""
    for k in range(s.linear * s.N):
        _put(w.lines, k, _plus(_times(_exact(t), _exact(s.A1[k])), _exact(s.A0[k])))


def _values(s, w, x, t):
    """Values of all rows; patches are ``patch x - 1``."""
    n = s.N
    _fill_slots(s, w, x)
    _clear(w.b, n)
    _blocks(
        w,
        s.value_blocks,
        s.value_place,
        s.value_part,
        s.value_start,
        s.value_slot,
        s.value,
        s.factors,
        t,
        w.b,
    )
    for k in range(s.linear):
        for j in range(n):
            _add_product(w.b, s.rows + k, _at(w.lines, n * k + j), _at(x, j))
    first = s.rows + s.linear
    for g in range(s.groups):
        w.b[4 * (first + g)] = -1.0
    for j in range(n):
        _add_product(w.b, first + s.group_of[j], _at(w.patch, j), _at(x, j))


def _jacobian(s, w, t):
    """Jacobian of all rows, from the slots of the last `_values`."""
    n = s.N
    _clear(w.m, n * n)
    _blocks(
        w,
        s.jacobian_blocks,
        s.jacobian_place,
        s.jacobian_part,
        s.jacobian_start,
        s.jacobian_slot,
        s.jacobian,
        s.factors,
        t,
        w.m,
    )
    for k in range(s.linear * n):
        _put(w.m, s.rows * n + k, _at(w.lines, k))
    first = s.rows + s.linear
    for j in range(n):
        _put(w.m, (first + s.group_of[j]) * n + j, _at(w.patch, j))


def _inverse(a):
    """``1 / a`` by one Newton step from the inverse in doubles."""
    z = 1.0 / complex(a[0], a[2])
    rough = _exact(z)
    product = _times(a, rough)
    re, re_low = _sum(2.0, 0.0, -product[0], -product[1])
    return _times(rough, (re, re_low, -product[2], -product[3]))


def _factorize(n, m, pivots):
    """LU factors in place, rows exchanged; the diagonal holds inverse pivots."""
    for k in range(n):
        best = -1.0
        row = k
        for i in range(k, n):
            size = m[4 * (n * i + k)] ** 2 + m[4 * (n * i + k) + 2] ** 2
            if size > best:
                best = size
                row = i
        if not best > 0.0:
            return False
        pivots[k] = row
        if row != k:
            for c in range(4 * n):
                m[4 * n * k + c], m[4 * n * row + c] = m[4 * n * row + c], m[4 * n * k + c]
        inverse = _inverse(_at(m, n * k + k))
        _put(m, n * k + k, inverse)
        for i in range(k + 1, n):
            if m[4 * (n * i + k)] == 0.0 and m[4 * (n * i + k) + 2] == 0.0:
                continue
            factor = _times(_at(m, n * i + k), inverse)
            _put(m, n * i + k, factor)
            for j in range(k + 1, n):
                _subtract_product(m, n * i + j, factor, _at(m, n * k + j))
    return True


def _substitute(n, m, pivots, b):
    for k in range(n):
        row = pivots[k]
        if row != k:
            for c in range(4):
                b[4 * k + c], b[4 * row + c] = b[4 * row + c], b[4 * k + c]
    for i in range(n):
        for j in range(i):
            _subtract_product(b, i, _at(m, n * i + j), _at(b, j))
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            _subtract_product(b, i, _at(m, n * i + j), _at(b, j))
        _put(b, i, _times(_at(b, i), _at(m, n * i + i)))


def _norm(n, b):
    total = 0.0
    for j in range(n):
        total += b[4 * j] ** 2 + b[4 * j + 2] ** 2
    return total**0.5


def _lay_patch(s, w, x):
    _clear(w.patch, s.N)
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
    _values(s, w, x, t)
    _jacobian(s, w, t)
    if not _factorize(n, w.m, w.pivots):
        return False
    _clear(w.b, n)
    for block in range(s.value_blocks):
        f = s.factors[2 * s.value_part[block] + 1]
        if f == 0.0:
            continue
        total = 0.0, 0.0, 0.0, 0.0
        for q in range(s.value_start[block], s.value_start[block + 1]):
            total = _plus(total, _times(_at(s.value, q), _at(w.slots, s.value_slot[q])))
        _subtract_product(w.b, s.value_place[block], _exact(f), total)
    for k in range(s.linear):
        for j in range(n):
            _subtract_product(w.b, s.rows + k, _exact(s.A1[n * k + j]), _at(x, j))
    _substitute(n, w.m, w.pivots, w.b)
    for j in range(n):
        w.slope[j] = complex(w.b[4 * j], w.b[4 * j + 2])
    return True


def _noise(n, w):
    """Size of a correction that is nothing but rounding errors of the values."""
    for i in range(n):
        _put(w.b, i, (RESIDUAL if i % 2 == 1 else -RESIDUAL, 0.0, 0.0, 0.0))
    _substitute(n, w.m, w.pivots, w.b)
    return _norm(n, w.b)


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
        _values(s, w, x, t)
        if used == 0:
            _jacobian(s, w, t)
            if not _factorize(n, w.m, w.pivots):
                return 1.0, 1.0, False
        _substitute(n, w.m, w.pivots, w.b)
        size = _norm(n, w.b)
        if not size < 1e10:
            return 1.0, 1.0, False
        if k == 0:
            first = size
            if first > 0.1:
                return first, size, False
        elif size > 0.5 * last and used == 0:
            return first, size, size < min(ROUNDING, 1e2 * _noise(n, w))
        for j in range(n):
            _put(x, j, _minus(_at(x, j), _at(w.b, j)))
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
        re, re_low = _sum(w.x[4 * j], w.x[4 * j + 1], move.real, 0.0)
        im, im_low = _sum(w.x[4 * j + 2], w.x[4 * j + 3], move.imag, 0.0)
        _put(w.y, j, (re, re_low, im, im_low))
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
            _put(x, j, _exact(batch.starts[n * path + j]))
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
                _rows_at(s, w, t)
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
            _rows_at(s, w, following)
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
                _put(x, j, _at(w.y, j))
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
                        _put(x, j, _exact(e.saved[j]))
                    t = complex(e.real[SAVED_RE], e.real[SAVED_IM])
                    fresh = True
                goal = complex(e.real[NEXT_RE], e.real[NEXT_IM])
                if turned != _turned(e):
                    fresh = True
            size = _norm(n, x)
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
        extended_kernel(arrays, state, _extended_work(homotopy), paths)

    if batches == 1:
        batch(0)
    else:
        with ThreadPoolExecutor(batches) as pool:
            list(pool.map(batch, range(batches)))
    return results
