"""The path tracker in double-double arithmetic, one path at a time, for paths that doubles lose.

Near an end where the Jacobian decays fast, rounding in doubles hides the path before the endgame
has seen enough of it. Here points, residuals, Jacobians and their factors carry 32 digits; the
predictor is a cubic Hermite polynomial through the last two points, in doubles.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numba
import numpy as np

from nag.tracking.compiled import CompiledRows
from nag.tracking.endgame import (
    BEST_ERROR,
    ENDGAME,
    FAILED,
    NEXT_IM,
    NEXT_RE,
    SAVED_IM,
    SAVED_RE,
    STEP_SIZE,
    STEPS,
    WINDING,
    arrived,
    begin,
    endgame_state,
    give_up,
)
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_cache import Kernel
from nag.tracking.precision import split

# Largest first Newton correction after a prediction, and the size at which corrections stop.
TOLERANCE = 1e-6
CONVERGED = 1e-26
NEWTON_STEPS = 8
MOST_STEPS = 6000
_SPLITTER = 134217729.0


class Extended(NamedTuple):
    """A homotopy with double-double coefficients, shape ``(.., 4)``: re, re low, im, im low."""

    N: int
    rows: int
    groups: int
    group_of: Any
    first: Any
    second: Any
    value_place: Any
    value_part: Any
    value_start: Any
    value_slot: Any
    value: Any
    jacobian_place: Any
    jacobian_part: Any
    jacobian_start: Any
    jacobian_slot: Any
    jacobian: Any
    factors: Any
    A0: Any
    A1: Any


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
        len(homotopy.groups),
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


@numba.njit(nogil=True)
def _sum(ah, al, bh, bl):
    s = ah + bh
    v = s - ah
    e = (ah - (s - v)) + (bh - v) + (al + bl)
    h = s + e
    return h, e - (h - s)


@numba.njit(nogil=True)
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


@numba.njit(nogil=True)
def _times(a, b, out):
    """``out = a b``, complex double-doubles in arrays of four."""
    ph, pl = _product(a[0], a[1], b[0], b[1])
    qh, ql = _product(a[2], a[3], b[2], b[3])
    rh, rl = _product(a[0], a[1], b[2], b[3])
    sh, sl = _product(a[2], a[3], b[0], b[1])
    out[0], out[1] = _sum(ph, pl, -qh, -ql)
    out[2], out[3] = _sum(rh, rl, sh, sl)


@numba.njit(nogil=True)
def _accumulate(total, a, sign):
    total[0], total[1] = _sum(total[0], total[1], sign * a[0], sign * a[1])
    total[2], total[3] = _sum(total[2], total[3], sign * a[2], sign * a[3])


@numba.njit(nogil=True)
def _slots(s, x, slots):
    n = s.N
    slots[:n] = x
    slots[n] = 0.0
    slots[n, 0] = 1.0
    for k in range(len(s.first)):
        _times(slots[s.first[k]], slots[s.second[k]], slots[n + 1 + k])


@numba.njit(nogil=True)
def _blocks(slots, place, part, start, slot, coefficient, factors, t, out):
    work = np.zeros(4)
    total = np.zeros(4)
    factor = np.zeros(4)
    for b in range(len(place)):
        total[:] = 0.0
        for q in range(start[b], start[b + 1]):
            _times(coefficient[q], slots[slot[q]], work)
            _accumulate(total, work, 1.0)
        f = factors[part[b], 0] + t * factors[part[b], 1]
        if f != 1.0:
            factor[0] = f.real
            factor[2] = f.imag
            _times(factor, total, work)
            total[:] = work
        _accumulate(out[place[b]], total, 1.0)


@numba.njit(nogil=True)
def _rows_at(s, t, rows):
    """Linear rows at t as double-doubles: t A1 is not rounded."""
    one = np.zeros(4)
    two = np.zeros(4)
    out = np.zeros(4)
    one[0] = t.real
    one[2] = t.imag
    for k in range(len(s.A0)):
        for j in range(s.N):
            two[0] = s.A1[k, j].real
            two[2] = s.A1[k, j].imag
            _times(one, two, out)
            two[0] = s.A0[k, j].real
            two[2] = s.A0[k, j].imag
            _accumulate(out, two, 1.0)
            rows[k, j] = out


@numba.njit(nogil=True)
def _values(s, x, t, rows, patch, slots, out):
    """Values of all rows; patches are ``patch x - 1``."""
    n = s.N
    work = np.zeros(4)
    _slots(s, x, slots)
    out[:] = 0.0
    _blocks(
        slots, s.value_place, s.value_part, s.value_start, s.value_slot, s.value, s.factors, t, out
    )
    for k in range(len(s.A0)):
        for j in range(n):
            _times(rows[k, j], x[j], work)
            _accumulate(out[s.rows + k], work, 1.0)
    first = s.rows + len(s.A0)
    for g in range(s.groups):
        out[first + g, 0] = -1.0
    for j in range(n):
        _times(patch[j], x[j], work)
        _accumulate(out[first + s.group_of[j]], work, 1.0)


@numba.njit(nogil=True)
def _jacobian(s, t, rows, patch, slots, out):
    """Jacobian of all rows, from the slots of the last `_values`."""
    n = s.N
    out[:] = 0.0
    flat = out.reshape(n * n, 4)
    _blocks(
        slots,
        s.jacobian_place,
        s.jacobian_part,
        s.jacobian_start,
        s.jacobian_slot,
        s.jacobian,
        s.factors,
        t,
        flat,
    )
    for k in range(len(s.A0)):
        out[s.rows + k] = rows[k]
    first = s.rows + len(s.A0)
    for j in range(n):
        out[first + s.group_of[j], j] = patch[j]


@numba.njit(nogil=True)
def _inverse(a, out):
    """``out = 1 / a`` by one Newton step from the inverse in doubles."""
    z = 1.0 / complex(a[0], a[2])
    out[:] = 0.0
    out[0] = z.real
    out[2] = z.imag
    work = np.zeros(4)
    again = np.zeros(4)
    _times(a, out, work)
    work[:] = -work
    work[0], work[1] = _sum(2.0, 0.0, work[0], work[1])
    _times(out, work, again)
    out[:] = again


@numba.njit(nogil=True)
def _factorize(m, pivots):
    """LU factors in place, rows exchanged; the diagonal holds inverse pivots."""
    n = len(pivots)
    work = np.zeros(4)
    inverse = np.zeros(4)
    for k in range(n):
        best = -1.0
        row = k
        for i in range(k, n):
            size = m[i, k, 0] ** 2 + m[i, k, 2] ** 2
            if size > best:
                best = size
                row = i
        if not best > 0.0:
            return False
        pivots[k] = row
        if row != k:
            for j in range(n):
                for c in range(4):
                    m[k, j, c], m[row, j, c] = m[row, j, c], m[k, j, c]
        _inverse(m[k, k], inverse)
        m[k, k] = inverse
        for i in range(k + 1, n):
            if m[i, k, 0] == 0.0 and m[i, k, 2] == 0.0:
                continue
            _times(m[i, k], inverse, work)
            m[i, k] = work
            for j in range(k + 1, n):
                _times(m[i, k], m[k, j], work)
                _accumulate(m[i, j], work, -1.0)
    return True


@numba.njit(nogil=True)
def _substitute(m, pivots, b):
    n = len(pivots)
    work = np.zeros(4)
    for k in range(n):
        row = pivots[k]
        if row != k:
            for c in range(4):
                b[k, c], b[row, c] = b[row, c], b[k, c]
    for i in range(n):
        for j in range(i):
            _times(m[i, j], b[j], work)
            _accumulate(b[i], work, -1.0)
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            _times(m[i, j], b[j], work)
            _accumulate(b[i], work, -1.0)
        _times(b[i], m[i, i], work)
        b[i] = work


@numba.njit(nogil=True)
def _norm(b):
    total = 0.0
    for j in range(len(b)):
        total += b[j, 0] ** 2 + b[j, 2] ** 2
    return total**0.5


@numba.njit(nogil=True)
def _patch(s, x, patch):
    patch[:] = 0.0
    for g in range(s.groups):
        total = 0.0
        for j in range(s.N):
            if s.group_of[j] == g:
                total += x[j, 0] ** 2 + x[j, 2] ** 2
        for j in range(s.N):
            if s.group_of[j] == g:
                patch[j, 0] = x[j, 0] / total
                patch[j, 2] = -x[j, 2] / total


@numba.njit(nogil=True)
def _normalize(s, x):
    """Scale each group to about unit norm, by a power of two: nothing is rounded."""
    for g in range(s.groups):
        total = 0.0
        for j in range(s.N):
            if s.group_of[j] == g:
                total += x[j, 0] ** 2 + x[j, 2] ** 2
        scale = 2.0 ** np.round(-0.5 * np.log2(total))
        for j in range(s.N):
            if s.group_of[j] == g:
                for c in range(4):
                    x[j, c] *= scale


@numba.njit(nogil=True)
def _tangent(s, x, t, rows, patch, slots, m, pivots, b, out):
    """Derivative of the path, in doubles; the factors of the Jacobian stay in ``m``."""
    n = s.N
    _values(s, x, t, rows, patch, slots, b)
    _jacobian(s, t, rows, patch, slots, m)
    if not _factorize(m, pivots):
        return False
    b[:] = 0.0
    total = np.zeros(4)
    work = np.zeros(4)
    factor = np.zeros(4)
    for block in range(len(s.value_place)):
        f = s.factors[s.value_part[block], 1]
        if f == 0.0:
            continue
        total[:] = 0.0
        for q in range(s.value_start[block], s.value_start[block + 1]):
            _times(s.value[q], slots[s.value_slot[q]], work)
            _accumulate(total, work, 1.0)
        factor[0] = f.real
        factor[2] = f.imag
        _times(factor, total, work)
        _accumulate(b[s.value_place[block]], work, -1.0)
    for k in range(len(s.A0)):
        for j in range(n):
            factor[0] = s.A1[k, j].real
            factor[2] = s.A1[k, j].imag
            _times(factor, x[j], work)
            _accumulate(b[s.rows + k], work, -1.0)
    _substitute(m, pivots, b)
    for j in range(n):
        out[j] = complex(b[j, 0], b[j, 2])
    return True


@numba.njit(nogil=True)
def _correct(s, x, t, rows, patch, slots, m, pivots, b):
    """Newton's method with one Jacobian; sizes of the first two corrections, and success."""
    _values(s, x, t, rows, patch, slots, b)
    _jacobian(s, t, rows, patch, slots, m)
    if not _factorize(m, pivots):
        return 1.0, 1.0, False
    first = 0.0
    last = 1.0
    for k in range(NEWTON_STEPS):
        _substitute(m, pivots, b)
        size = _norm(b)
        if not size < 1e10:
            return 1.0, 1.0, False
        for j in range(s.N):
            _accumulate(x[j], b[j], -1.0)
        if k == 0:
            first = size
            if first > 0.1:
                return first, size, False
        elif size > 0.25 * last and size > 1e-20:
            return first, size, False
        last = size
        if size < CONVERGED or (k > 0 and size < 1e-20):
            return first, size, True
        _values(s, x, t, rows, patch, slots, b)
    return first, last, last < 1e-16


@numba.njit(nogil=True, cache=True)
def track_extended_batch(
    s, e, starts, indices, max_steps, points, outcome, winding, error, steps, reason
):
    """Track the paths of ``starts`` at ``indices``; results into the arrays."""
    n = s.N
    slots = np.zeros((n + 1 + len(s.first), 4))
    rows = np.zeros((len(s.A0), n, 4))
    m = np.zeros((n, n, 4))
    b = np.zeros((n, 4))
    pivots = np.zeros(n, dtype=np.int64)
    patch = np.zeros((n, 4))
    x = np.zeros((n, 4))
    y = np.zeros((n, 4))
    slope = np.zeros(n, dtype=np.complex128)
    old = np.zeros(n, dtype=np.complex128)
    old_slope = np.zeros(n, dtype=np.complex128)
    here = np.zeros(n, dtype=np.complex128)
    for path in indices:
        begin(e, 0)
        x[:] = 0.0
        for j in range(n):
            x[j, 0] = starts[path, j].real
            x[j, 2] = starts[path, j].imag
        t = 1.0 + 0.0j
        goal = complex(e.real[NEXT_RE], e.real[NEXT_IM])
        fresh = True
        known = False
        gap = 0.0j
        h = 0.0
        taken = 0
        done = 0
        while done < 10:
            taken += 1
            if fresh:
                _normalize(s, x)
                _patch(s, x, patch)
                _rows_at(s, t, rows)
                _, _, good = _correct(s, x, t, rows, patch, slots, m, pivots, b)
                good = good and _tangent(s, x, t, rows, patch, slots, m, pivots, b, slope)
                if not good:
                    reason[path] = ENDGAME
                    done = 10 + give_up(e, 0)
                    break
                size = 0.0
                for j in range(n):
                    size += abs(slope[j]) ** 2
                h = min(0.01, 0.01 / (1e-300 + size**0.5)) * max(abs(t), 1e-3)
                fresh = False
                known = False
            delta = goal - t
            length = abs(delta)
            if h >= length:
                z = delta
                following = goal
            else:
                z = delta / length * min(h, 0.5 * length if h > 0.7 * length else h)
                following = t + z
                z = following - t
            for j in range(n):
                c = complex(x[j, 0], x[j, 2])
                here[j] = c
                if known:
                    secant = (c - old[j]) / gap
                    second = (slope[j] - secant) / gap
                    third = (slope[j] - 2.0 * secant + old_slope[j]) / (gap * gap)
                    move = z * (slope[j] + z * (second + (z + gap) * third))
                else:
                    move = z * slope[j]
                y[j, 0], y[j, 1] = _sum(x[j, 0], x[j, 1], move.real, 0.0)
                y[j, 2], y[j, 3] = _sum(x[j, 2], x[j, 3], move.imag, 0.0)
            _rows_at(s, following, rows)
            first, _, good = _correct(s, y, following, rows, patch, slots, m, pivots, b)
            if not good or first > TOLERANCE:
                h = abs(z) * 0.5
                if good:
                    h = abs(z) * min(0.6, max(0.1, (0.2 * TOLERANCE / first) ** 0.25))
                if h < 1e-13 * abs(t) or taken > max_steps:
                    reason[path] = STEP_SIZE if taken <= max_steps else STEPS
                    done = 10 + give_up(e, 0)
                continue
            old[:] = here
            old_slope[:] = slope
            gap = z
            x[:] = y
            t = following
            good = _tangent(s, x, t, rows, patch, slots, m, pivots, b, slope)
            known = True
            grow = (0.2 * TOLERANCE / max(first, 1e-300)) ** 0.25
            h = abs(z) * min(max(grow, 0.3), 2.5)
            if not good or taken > max_steps:
                reason[path] = ENDGAME if not good else STEPS
                done = 10 + give_up(e, 0)
            elif t == goal:
                for j in range(n):
                    here[j] = complex(x[j, 0], x[j, 2])
                done = arrived(s, e, 0, here, 1e-16, 1.0, 0.0, t)
                if done == -1:
                    done = 0
                    x[:] = 0.0
                    for j in range(n):
                        x[j, 0] = e.saved[j].real
                        x[j, 2] = e.saved[j].imag
                    t = complex(e.real[SAVED_RE], e.real[SAVED_IM])
                    fresh = True
                goal = complex(e.real[NEXT_RE], e.real[NEXT_IM])
            size = _norm(x)
            if size > 4.0 or size < 0.25:
                fresh = True
        outcome[path] = done - 10
        steps[path] = taken
        if done - 10 == FAILED:
            if reason[path] == 0:
                reason[path] = ENDGAME
            for j in range(n):
                points[path, j] = complex(x[j, 0], x[j, 2])
            error[path] = np.inf
        else:
            reason[path] = 0
            points[path] = e.best[:n]
            winding[path] = e.whole[WINDING]
            error[path] = e.real[BEST_ERROR]


def _example() -> tuple[Any, ...]:
    from nag.algebra.polynomial import Polynomial
    from nag.tracking.compiled import compile_rows

    x = Polynomial.variable(1, 0)
    homotopy = Homotopy(compile_rows([x**2 - 1]))
    zeros = np.zeros(1, dtype=np.int64)
    return (
        extended_system(homotopy),
        endgame_state(2, 1, True, False, 0.1, 8, 2, 2),
        np.zeros((1, 2), dtype=np.complex128),
        zeros,
        1,
        np.zeros((1, 2), dtype=np.complex128),
        zeros,
        zeros,
        np.zeros(1),
        zeros,
        zeros,
    )


extended_kernel = Kernel(track_extended_batch, _example)


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
    batches = max(1, min(threads, P))

    def batch(first: int) -> None:
        state = endgame_state(
            homotopy.N, end_exponent, True, False, radius, samples, max_winding, levels
        )
        indices = np.arange(first, P, batches)
        extended_kernel(arrays, state, starts, indices, max_steps, *results)

    if batches == 1:
        batch(0)
    else:
        with ThreadPoolExecutor(batches) as pool:
            list(pool.map(batch, range(batches)))
    return results
