"""Values, Jacobians and Taylor coefficients of a homotopy in lanes."""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, fnma, load, splat, square_root, store


def _value_blocks(s):
    """The coefficients of the values: where each block starts, slots, numbers, which are real."""
    return s.value_start, s.value_slot, s.value_re, s.value_im, s.value_real


def _jacobian_blocks(s):
    """The same of the Jacobian."""
    return s.jacobian_start, s.jacobian_slot, s.jacobian_re, s.jacobian_im, s.jacobian_real


def _block(blocks, b, vr, vi, shift):
    """The sum of a block's coefficients times slots."""
    start, slot, cr, ci, real = blocks
    first = start[b]
    last = start[b + 1]
    re = splat(0.0)
    im = splat(0.0)
    if real[b] != 0:
        for q in range(first, last):
            c = splat(cr[q])
            re = fma(c, load(vr, shift + slot[q]), re)
            im = fma(c, load(vi, shift + slot[q]), im)
    else:
        for q in range(first, last):
            c = splat(cr[q])
            d = splat(ci[q])
            x = load(vr, shift + slot[q])
            y = load(vi, shift + slot[q])
            re = fnma(d, y, fma(c, x, re))
            im = fma(d, x, fma(c, y, im))
    return re, im


def _add(br, bi, k, re, im):
    store(br, k, load(br, k) + re)
    store(bi, k, load(bi, k) + im)


def products(s, w, first, last):
    """Products ``first .. last - 1`` of the slots."""
    for k in range(first, last):
        ar = load(w.vr, s.first[k])
        ai = load(w.vi, s.first[k])
        br = load(w.vr, s.second[k])
        bi = load(w.vi, s.second[k])
        store(w.vr, s.N + 1 + k, fnma(ai, bi, ar * br))
        store(w.vi, s.N + 1 + k, fma(ai, br, ar * bi))


def factors_at(s, w):
    """Factors of all parts at the lanes' t."""
    t = load(w.tr, 0)
    store(w.vr, s.N, splat(1.0))
    store(w.vi, s.N, splat(0.0))
    if s.toric != 0:
        for lane in range(8):
            first = w.counters[lane] * s.parts
            for p in range(s.parts):
                weight = s.weights[first + p]
                w.fr[8 * p + lane] = math.exp(-weight * w.tr[lane])
                w.fi[8 * p + lane] = -weight
        return
    for p in range(s.parts):
        br = splat(s.factor_re[2 * p + 1])
        bi = splat(s.factor_im[2 * p + 1])
        store(w.fr, p, fma(t, br, splat(s.factor_re[2 * p])))
        store(w.fi, p, fma(t, bi, splat(s.factor_im[2 * p])))


def _scaled(s, w, part, re, im):
    if s.moving[part] == 0:
        return re, im
    fr = load(w.fr, part)
    if s.toric != 0:
        return re * fr, im * fr
    fi = load(w.fi, part)
    return fnma(im, fi, re * fr), fma(im, fr, re * fi)


def values(s, w):
    """Minus the values of all rows at the lanes' points and t, into the right-hand side."""
    zero = splat(0.0)
    for k in range(s.N):
        store(w.br, k, zero)
        store(w.bi, k, zero)
    for b in range(s.value_blocks):
        re, im = _block(_value_blocks(s), b, w.vr, w.vi, 0)
        re, im = _scaled(s, w, s.value_part[b], re, im)
        _add(w.br, w.bi, s.value_place[b], zero - re, zero - im)
    t = load(w.tr, 0)
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
                cr = fma(t, dr, cr)
                ci = fma(t, di, ci)
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
        pr = load(w.pr, j)
        pi = load(w.pi, j)
        store(w.br, k, fma(pi, y, fnma(pr, x, load(w.br, k))))
        store(w.bi, k, fnma(pi, x, fnma(pr, y, load(w.bi, k))))


def jacobian(s, w):
    """The Jacobian of all rows at the lanes' points and t."""
    zero = splat(0.0)
    n = s.N
    for k in range(n * n):
        store(w.jr, k, zero)
        store(w.ji, k, zero)
    for b in range(s.jacobian_blocks):
        re, im = _block(_jacobian_blocks(s), b, w.vr, w.vi, 0)
        re, im = _scaled(s, w, s.jacobian_part[b], re, im)
        _add(w.jr, w.ji, s.jacobian_place[b], re, im)
    t = load(w.tr, 0)
    for k in range(s.linear):
        for j in range(n):
            q = k * s.N + j
            cr = splat(s.A0_re[q])
            ci = splat(s.A0_im[q])
            if s.linear_moving[k] != 0:
                dr = splat(s.A1_re[q])
                di = splat(s.A1_im[q])
                cr = fma(t, dr, cr)
                ci = fma(t, di, ci)
            store(w.jr, (s.rows + k) * n + j, cr)
            store(w.ji, (s.rows + k) * n + j, ci)
    patches = s.rows + s.linear
    for j in range(n):
        k = patches + s.group_of[j]
        store(w.jr, k * n + j, load(w.pr, j))
        store(w.ji, k * n + j, load(w.pi, j))


def incomplete_slots(s, w, k):
    """Taylor coefficients of order ``k >= 2`` of the slots, those of the point taken as 0."""
    zero = splat(0.0)
    size = s.N + 1 + s.value_products
    top = (k - 1) * size
    for j in range(s.N + 1):
        store(w.cr, top + j, zero)
        store(w.ci, top + j, zero)
    for q in range(s.value_products):
        a = s.first[q]
        b = s.second[q]
        re = zero
        im = zero
        # The second factor is a coordinate, whose coefficient of this order is taken as 0.
        if a > s.N:
            ar, ai = load(w.cr, top + a), load(w.ci, top + a)
            br, bi = load(w.vr, b), load(w.vi, b)
            re = fnma(ai, bi, ar * br)
            im = fma(ai, br, ar * bi)
        for i in range(k - 1):
            m = i * size + a
            n = (k - 2 - i) * size + b
            ar, ai = load(w.cr, m), load(w.ci, m)
            br, bi = load(w.cr, n), load(w.ci, n)
            re = fnma(ai, bi, fma(ar, br, re))
            im = fma(ai, br, fma(ar, bi, im))
        store(w.cr, top + s.N + 1 + q, re)
        store(w.ci, top + s.N + 1 + q, im)


def complete_slots(s, w, k):
    """Add to the coefficients of order ``k`` what the point's own coefficients contribute.

    These are the solution in the right-hand side. The contribution is linear in them, so that a
    product needs two multiplications. For order 1 there is nothing to add to.
    """
    zero = splat(0.0)
    top = (k - 1) * (s.N + 1 + s.value_products)
    for j in range(s.N):
        re, im = load(w.br, j), load(w.bi, j)
        store(w.dr, j, re)
        store(w.di, j, im)
        store(w.cr, top + j, re)
        store(w.ci, top + j, im)
    store(w.dr, s.N, zero)
    store(w.di, s.N, zero)
    store(w.cr, top + s.N, zero)
    store(w.ci, top + s.N, zero)
    for q in range(s.value_products):
        a = s.first[q]
        b = s.second[q]
        ar, ai = load(w.vr, a), load(w.vi, a)
        br, bi = load(w.dr, b), load(w.di, b)
        re = fnma(ai, bi, ar * br)
        im = fma(ai, br, ar * bi)
        ar, ai = load(w.dr, a), load(w.di, a)
        br, bi = load(w.vr, b), load(w.vi, b)
        re = fnma(ai, bi, fma(ar, br, re))
        im = fma(ai, br, fma(ar, bi, im))
        m = s.N + 1 + q
        store(w.dr, m, re)
        store(w.di, m, im)
        if k > 1:
            re = re + load(w.cr, top + m)
            im = im + load(w.ci, top + m)
        store(w.cr, top + m, re)
        store(w.ci, top + m, im)


def _lower_block(s, w, k, b):
    if k == 1:
        return _block(_value_blocks(s), b, w.vr, w.vi, 0)
    shift = (k - 2) * (s.N + 1 + s.value_products)
    return _block(_value_blocks(s), b, w.cr, w.ci, shift)


def _toric_right_side(s, w, k):
    size = s.N + 1 + s.value_products
    for b in range(s.value_blocks):
        part = s.value_part[b]
        q = s.value_start[b]
        slot = s.value_slot[q]
        minus = load(w.fi, part)
        re, im = load(w.vr, slot), load(w.vi, slot)
        # Horner's rule for the sum of minus^j / j! times the coefficient of order k - j.
        for m in range(1, k + 1):
            rate = minus * splat(1.0 / (k - m + 1))
            re = re * rate
            im = im * rate
            if k > 1:
                re = re + load(w.cr, (m - 1) * size + slot)
                im = im + load(w.ci, (m - 1) * size + slot)
        f = load(w.fr, part)
        c = f * splat(s.value_re[q])
        d = f * splat(s.value_im[q])
        _add(w.br, w.bi, s.value_place[b], fnma(re, c, im * d), splat(0.0) - fma(re, d, im * c))


def right_side(s, w, k):
    """Minus the Taylor coefficient of order ``k`` of the rows, that of the point taken as 0."""
    zero = splat(0.0)
    size = s.N + 1 + s.value_products
    for j in range(s.N):
        store(w.br, j, zero)
        store(w.bi, j, zero)
    if s.toric != 0:
        _toric_right_side(s, w, k)
    for b in range(0 if s.toric != 0 else s.value_blocks):
        part = s.value_part[b]
        if k > 1:
            re, im = _block(_value_blocks(s), b, w.cr, w.ci, (k - 1) * size)
            re, im = _scaled(s, w, part, re, im)
            _add(w.br, w.bi, s.value_place[b], zero - re, zero - im)
        if s.moving[part] != 0:
            re, im = _lower_block(s, w, k, b)
            c = splat(s.factor_re[2 * part + 1])
            d = splat(s.factor_im[2 * part + 1])
            _add(
                w.br,
                w.bi,
                s.value_place[b],
                fnma(re, c, im * d),
                zero - fma(re, d, im * c),
            )
    for q in range(s.linear):
        if s.linear_moving[q] != 0:
            re = zero
            im = zero
            for j in range(s.N):
                cr = splat(s.A1_re[q * s.N + j])
                ci = splat(s.A1_im[q * s.N + j])
                if k == 1:
                    x, y = load(w.vr, j), load(w.vi, j)
                else:
                    x, y = load(w.cr, (k - 2) * size + j), load(w.ci, (k - 2) * size + j)
                re = fma(ci, y, fnma(cr, x, re))
                im = fnma(ci, x, fnma(cr, y, im))
            store(w.br, s.rows + q, re)
            store(w.bi, s.rows + q, im)


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
