"""Values, Jacobians and Taylor coefficients of a homotopy in lanes."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numba
import numpy as np

from nag.tracking.homotopy import Homotopy
from nag.tracking.lanes import aligned, fma, fnma, load, pointer, splat, square_root, store


class System(NamedTuple):
    """A homotopy as flat arrays (see `nag.tracking.compiled.Tape` for blocks and slots).

    The numbers say how long the arrays are. Factor ``2 p`` is a, ``2 p + 1`` is b of part ``p``.
    """

    N: int
    rows: int
    linear: int
    groups: int
    parts: int
    value_products: int
    products: int
    value_blocks: int
    jacobian_blocks: int
    infinities: int
    first: Any
    second: Any
    value_place: Any
    value_part: Any
    value_start: Any
    value_slot: Any
    value_re: Any
    value_im: Any
    value_real: Any
    jacobian_place: Any
    jacobian_part: Any
    jacobian_start: Any
    jacobian_slot: Any
    jacobian_re: Any
    jacobian_im: Any
    jacobian_real: Any
    factor_re: Any
    factor_im: Any
    moving: Any
    A0_re: Any
    A0_im: Any
    A1_re: Any
    A1_im: Any
    linear_moving: Any
    group_of: Any
    infinity: Any


class Work(NamedTuple):
    """Scratch vectors of one batch of lanes.

    ``vr, vi``: slots; the first N are the point. ``v1r .. v3i``: Taylor coefficients of the slots.
    ``jr, ji``: Jacobian, then its factors. ``br, bi``: right-hand side. ``pr, pi``: patch.
    ``fr, fi``: the parts' factors at t. ``base``: point and three Taylor coefficients at the last
    accepted t, real and imaginary parts in turn. ``tr, ti``: t. ``norms``: squared norms of the two
    Newton corrections and of the three Taylor coefficients. ``mode``: 0 in the lanes that predict.
    ``zr, zi``: their steps in t. ``accepted``: 1 in the lanes whose step is accepted.
    """

    vr: Any
    vi: Any
    v1r: Any
    v1i: Any
    v2r: Any
    v2i: Any
    v3r: Any
    v3i: Any
    jr: Any
    ji: Any
    br: Any
    bi: Any
    pr: Any
    pi: Any
    fr: Any
    fi: Any
    pivots: Any
    base: Any
    tr: Any
    ti: Any
    norms: Any
    mode: Any
    zr: Any
    zi: Any
    accepted: Any


def _real_blocks(start: np.ndarray, coefficient: np.ndarray) -> np.ndarray:
    real = [not coefficient[a:b].imag.any() for a, b in pairwise(start)]
    return np.array(real, dtype=np.int64)


def _parts(array: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    array = array.ravel()
    return np.ascontiguousarray(array.real), np.ascontiguousarray(array.imag)


def system(homotopy: Homotopy) -> System:
    """The arrays of ``homotopy``."""
    tape = homotopy.rows.tape
    factors = np.array(homotopy.factors, dtype=np.complex128).reshape(-1, 2)
    moving = (factors[:, 1] != 0) | (factors[:, 0] != 1)
    value, jacobian = tape.value_coefficient, tape.jacobian_coefficient
    return System(
        homotopy.N,
        len(homotopy.rows),
        len(homotopy.A0),
        len(homotopy.groups),
        len(factors),
        tape.value_products,
        len(tape.first),
        len(tape.value_place),
        len(tape.jacobian_place),
        len(homotopy.infinity),
        tape.first,
        tape.second,
        tape.value_place,
        tape.value_part,
        tape.value_start,
        tape.value_slot,
        *_parts(value),
        _real_blocks(tape.value_start, value),
        tape.jacobian_place,
        tape.jacobian_part,
        tape.jacobian_start,
        tape.jacobian_slot,
        *_parts(jacobian),
        _real_blocks(tape.jacobian_start, jacobian),
        *_parts(factors),
        moving.astype(np.int64),
        *_parts(homotopy.A0),
        *_parts(homotopy.A1),
        homotopy.A1.any(axis=1).astype(np.int64),
        homotopy.group_of,
        np.array(homotopy.infinity, dtype=np.int64),
    )


def work(homotopy: Homotopy) -> Work:
    """Scratch vectors for ``homotopy``."""
    N = homotopy.N
    tape = homotopy.rows.tape
    slots = N + 1 + len(tape.first)
    value_slots = N + 1 + tape.value_products
    parts = len(homotopy.factors)
    sizes = [slots] * 2 + [value_slots] * 6 + [N * N] * 2 + [N] * 4 + [parts] * 2 + [N, 8 * N, 1, 1]
    return Work(*(aligned(size) for size in [*sizes, 6, 1, 1, 1, 1]))


@numba.njit(nogil=True)
def bare(s, w):
    """The same tuples with pointers for arrays."""
    system = System(
        s.N,
        s.rows,
        s.linear,
        s.groups,
        s.parts,
        s.value_products,
        s.products,
        s.value_blocks,
        s.jacobian_blocks,
        s.infinities,
        pointer(s.first),
        pointer(s.second),
        pointer(s.value_place),
        pointer(s.value_part),
        pointer(s.value_start),
        pointer(s.value_slot),
        pointer(s.value_re),
        pointer(s.value_im),
        pointer(s.value_real),
        pointer(s.jacobian_place),
        pointer(s.jacobian_part),
        pointer(s.jacobian_start),
        pointer(s.jacobian_slot),
        pointer(s.jacobian_re),
        pointer(s.jacobian_im),
        pointer(s.jacobian_real),
        pointer(s.factor_re),
        pointer(s.factor_im),
        pointer(s.moving),
        pointer(s.A0_re),
        pointer(s.A0_im),
        pointer(s.A1_re),
        pointer(s.A1_im),
        pointer(s.linear_moving),
        pointer(s.group_of),
        pointer(s.infinity),
    )
    work = Work(
        pointer(w.vr),
        pointer(w.vi),
        pointer(w.v1r),
        pointer(w.v1i),
        pointer(w.v2r),
        pointer(w.v2i),
        pointer(w.v3r),
        pointer(w.v3i),
        pointer(w.jr),
        pointer(w.ji),
        pointer(w.br),
        pointer(w.bi),
        pointer(w.pr),
        pointer(w.pi),
        pointer(w.fr),
        pointer(w.fi),
        pointer(w.pivots),
        pointer(w.base),
        pointer(w.tr),
        pointer(w.ti),
        pointer(w.norms),
        pointer(w.mode),
        pointer(w.zr),
        pointer(w.zi),
        pointer(w.accepted),
    )
    return system, work


@numba.njit(nogil=True)
def _block(first, last, slot, cr, ci, real, vr, vi):
    re = splat(0.0)
    im = splat(0.0)
    if real != 0:
        for q in range(first, last):
            c = splat(cr[q])
            re = fma(c, load(vr, slot[q]), re)
            im = fma(c, load(vi, slot[q]), im)
    else:
        for q in range(first, last):
            c = splat(cr[q])
            d = splat(ci[q])
            x = load(vr, slot[q])
            y = load(vi, slot[q])
            re = fnma(d, y, fma(c, x, re))
            im = fma(d, x, fma(c, y, im))
    return re, im


@numba.njit(nogil=True)
def _add(br, bi, k, re, im):
    store(br, k, load(br, k) + re)
    store(bi, k, load(bi, k) + im)


@numba.njit(nogil=True)
def products(s, w, first, last):
    """Products ``first .. last - 1`` of the slots."""
    for k in range(first, last):
        ar = load(w.vr, s.first[k])
        ai = load(w.vi, s.first[k])
        br = load(w.vr, s.second[k])
        bi = load(w.vi, s.second[k])
        store(w.vr, s.N + 1 + k, fnma(ai, bi, ar * br))
        store(w.vi, s.N + 1 + k, fma(ai, br, ar * bi))


@numba.njit(nogil=True)
def factors_at(s, w):
    """Factors ``a + t b`` of all parts at the lanes' t."""
    tr = load(w.tr, 0)
    ti = load(w.ti, 0)
    store(w.vr, s.N, splat(1.0))
    store(w.vi, s.N, splat(0.0))
    for p in range(s.parts):
        br = splat(s.factor_re[2 * p + 1])
        bi = splat(s.factor_im[2 * p + 1])
        store(w.fr, p, fnma(ti, bi, fma(tr, br, splat(s.factor_re[2 * p]))))
        store(w.fi, p, fma(ti, br, fma(tr, bi, splat(s.factor_im[2 * p]))))


@numba.njit(nogil=True)
def _scaled(s, w, part, re, im):
    if s.moving[part] == 0:
        return re, im
    fr = load(w.fr, part)
    fi = load(w.fi, part)
    return fnma(im, fi, re * fr), fma(im, fr, re * fi)


@numba.njit(nogil=True)
def values(s, w):
    """Minus the values of all rows at the lanes' points and t, into the right-hand side."""
    zero = splat(0.0)
    for k in range(s.N):
        store(w.br, k, zero)
        store(w.bi, k, zero)
    for b in range(s.value_blocks):
        re, im = _block(
            s.value_start[b],
            s.value_start[b + 1],
            s.value_slot,
            s.value_re,
            s.value_im,
            s.value_real[b],
            w.vr,
            w.vi,
        )
        re, im = _scaled(s, w, s.value_part[b], re, im)
        _add(w.br, w.bi, s.value_place[b], zero - re, zero - im)
    tr = load(w.tr, 0)
    ti = load(w.ti, 0)
    for k in range(s.linear):
        re = zero
        im = zero
        for j in range(s.N):
            q = k * s.N + j
            cr = splat(s.A0_re[q])
            ci = splat(s.A0_im[q])
            if s.linear_moving[k] != 0:
                dr = splat(s.A1_re[q])
                di = splat(s.A1_im[q])
                cr = fnma(ti, di, fma(tr, dr, cr))
                ci = fma(ti, dr, fma(tr, di, ci))
            x = load(w.vr, j)
            y = load(w.vi, j)
            re = fma(ci, y, fnma(cr, x, re))
            im = fnma(ci, x, fnma(cr, y, im))
        store(w.br, s.rows + k, re)
        store(w.bi, s.rows + k, im)
    patches = s.rows + s.linear
    for g in range(s.groups):
        store(w.br, patches + g, splat(1.0))
    for j in range(s.N):
        k = patches + s.group_of[j]
        x = load(w.vr, j)
        y = load(w.vi, j)
        p = load(w.pr, j)
        q = load(w.pi, j)
        store(w.br, k, fma(q, y, fnma(p, x, load(w.br, k))))
        store(w.bi, k, fnma(q, x, fnma(p, y, load(w.bi, k))))


@numba.njit(nogil=True)
def jacobian(s, w):
    """The Jacobian of all rows at the lanes' points and t."""
    zero = splat(0.0)
    n = s.N
    for k in range(n * n):
        store(w.jr, k, zero)
        store(w.ji, k, zero)
    for b in range(s.jacobian_blocks):
        re, im = _block(
            s.jacobian_start[b],
            s.jacobian_start[b + 1],
            s.jacobian_slot,
            s.jacobian_re,
            s.jacobian_im,
            s.jacobian_real[b],
            w.vr,
            w.vi,
        )
        re, im = _scaled(s, w, s.jacobian_part[b], re, im)
        _add(w.jr, w.ji, s.jacobian_place[b], re, im)
    tr = load(w.tr, 0)
    ti = load(w.ti, 0)
    for k in range(s.linear):
        for j in range(n):
            q = k * s.N + j
            cr = splat(s.A0_re[q])
            ci = splat(s.A0_im[q])
            if s.linear_moving[k] != 0:
                dr = splat(s.A1_re[q])
                di = splat(s.A1_im[q])
                cr = fnma(ti, di, fma(tr, dr, cr))
                ci = fma(ti, dr, fma(tr, di, ci))
            store(w.jr, (s.rows + k) * n + j, cr)
            store(w.ji, (s.rows + k) * n + j, ci)
    patches = s.rows + s.linear
    for j in range(n):
        k = patches + s.group_of[j]
        store(w.jr, k * n + j, load(w.pr, j))
        store(w.ji, k * n + j, load(w.pi, j))


@numba.njit(nogil=True)
def _slot_jet_1(s, w):
    zero = splat(0.0)
    store(w.v1r, s.N, zero)
    store(w.v1i, s.N, zero)
    for k in range(s.value_products):
        a = s.first[k]
        b = s.second[k]
        a0r, a0i, a1r, a1i = load(w.vr, a), load(w.vi, a), load(w.v1r, a), load(w.v1i, a)
        b0r, b0i, b1r, b1i = load(w.vr, b), load(w.vi, b), load(w.v1r, b), load(w.v1i, b)
        re = fnma(a1i, b0i, fma(a1r, b0r, fnma(a0i, b1i, a0r * b1r)))
        im = fma(a1i, b0r, fma(a1r, b0i, fma(a0i, b1r, a0r * b1i)))
        store(w.v1r, s.N + 1 + k, re)
        store(w.v1i, s.N + 1 + k, im)


@numba.njit(nogil=True)
def _slot_jet_2(s, w):
    zero = splat(0.0)
    store(w.v2r, s.N, zero)
    store(w.v2i, s.N, zero)
    for k in range(s.value_products):
        a = s.first[k]
        b = s.second[k]
        a0r, a0i, b2r, b2i = load(w.vr, a), load(w.vi, a), load(w.v2r, b), load(w.v2i, b)
        re = fnma(a0i, b2i, a0r * b2r)
        im = fma(a0i, b2r, a0r * b2i)
        a1r, a1i, b1r, b1i = load(w.v1r, a), load(w.v1i, a), load(w.v1r, b), load(w.v1i, b)
        re = fnma(a1i, b1i, fma(a1r, b1r, re))
        im = fma(a1i, b1r, fma(a1r, b1i, im))
        a2r, a2i, b0r, b0i = load(w.v2r, a), load(w.v2i, a), load(w.vr, b), load(w.vi, b)
        re = fnma(a2i, b0i, fma(a2r, b0r, re))
        im = fma(a2i, b0r, fma(a2r, b0i, im))
        store(w.v2r, s.N + 1 + k, re)
        store(w.v2i, s.N + 1 + k, im)


@numba.njit(nogil=True)
def _slot_jet_3(s, w):
    zero = splat(0.0)
    store(w.v3r, s.N, zero)
    store(w.v3i, s.N, zero)
    for k in range(s.value_products):
        a = s.first[k]
        b = s.second[k]
        a0r, a0i, b3r, b3i = load(w.vr, a), load(w.vi, a), load(w.v3r, b), load(w.v3i, b)
        re = fnma(a0i, b3i, a0r * b3r)
        im = fma(a0i, b3r, a0r * b3i)
        a1r, a1i, b2r, b2i = load(w.v1r, a), load(w.v1i, a), load(w.v2r, b), load(w.v2i, b)
        re = fnma(a1i, b2i, fma(a1r, b2r, re))
        im = fma(a1i, b2r, fma(a1r, b2i, im))
        a2r, a2i, b1r, b1i = load(w.v2r, a), load(w.v2i, a), load(w.v1r, b), load(w.v1i, b)
        re = fnma(a2i, b1i, fma(a2r, b1r, re))
        im = fma(a2i, b1r, fma(a2r, b1i, im))
        a3r, a3i, b0r, b0i = load(w.v3r, a), load(w.v3i, a), load(w.vr, b), load(w.vi, b)
        re = fnma(a3i, b0i, fma(a3r, b0r, re))
        im = fma(a3i, b0r, fma(a3r, b0i, im))
        store(w.v3r, s.N + 1 + k, re)
        store(w.v3i, s.N + 1 + k, im)


@numba.njit(nogil=True)
def _right_side(s, w, vr, vi, lr, li, with_value):
    """Minus a Taylor coefficient of the rows, the unknown coefficient of the point taken as 0.

    ``vr, vi``: slots' coefficients of this order (used if ``with_value``); ``lr, li``: one lower.
    """
    zero = splat(0.0)
    for k in range(s.N):
        store(w.br, k, zero)
        store(w.bi, k, zero)
    for b in range(s.value_blocks):
        part = s.value_part[b]
        first = s.value_start[b]
        last = s.value_start[b + 1]
        real = s.value_real[b]
        if with_value:
            re, im = _block(first, last, s.value_slot, s.value_re, s.value_im, real, vr, vi)
            re, im = _scaled(s, w, part, re, im)
            _add(w.br, w.bi, s.value_place[b], zero - re, zero - im)
        if s.moving[part] != 0:
            re, im = _block(first, last, s.value_slot, s.value_re, s.value_im, real, lr, li)
            c = splat(s.factor_re[2 * part + 1])
            d = splat(s.factor_im[2 * part + 1])
            _add(
                w.br,
                w.bi,
                s.value_place[b],
                fnma(re, c, im * d),
                zero - fma(re, d, im * c),
            )
    for k in range(s.linear):
        if s.linear_moving[k] != 0:
            re = zero
            im = zero
            for j in range(s.N):
                cr = splat(s.A1_re[k * s.N + j])
                ci = splat(s.A1_im[k * s.N + j])
                x = load(lr, j)
                y = load(li, j)
                re = fma(ci, y, fnma(cr, x, re))
                im = fnma(ci, x, fnma(cr, y, im))
            store(w.br, s.rows + k, re)
            store(w.bi, s.rows + k, im)


@numba.njit(nogil=True)
def _clear(n, target_r, target_i):
    zero = splat(0.0)
    for j in range(n):
        store(target_r, j, zero)
        store(target_i, j, zero)


@numba.njit(nogil=True)
def normalize(s, w):
    """Scale the lanes' points to unit norm in each group and lay the patch through them."""
    for g in range(s.groups):
        total = splat(0.0)
        for j in range(s.N):
            if s.group_of[j] == g:
                x = load(w.vr, j)
                y = load(w.vi, j)
                total = fma(x, x, fma(y, y, total))
        scale = splat(1.0) / square_root(total)
        for j in range(s.N):
            if s.group_of[j] == g:
                x = load(w.vr, j) * scale
                y = load(w.vi, j) * scale
                store(w.vr, j, x)
                store(w.vi, j, y)
                store(w.pr, j, x)
                store(w.pi, j, splat(0.0) - y)
