"""Values, Jacobians and Taylor coefficients of a homotopy in lanes."""

from __future__ import annotations

import math

from nag.machine_code.lanes import fma, fnma, load, splat, square_root, store
from nag.tracking.linear_algebra import PHASE

# Relative error of a double.
EPSILON = 2.0**-53


def _value_blocks(s):
    """The coefficients of the values: where each block starts, slots, numbers, which are real."""
    return s.value_start, s.value_slot, s.value_re, s.value_im, s.value_real


def _jacobian_blocks(s):
    """The same of the Jacobian."""
    return s.jacobian_start, s.jacobian_slot, s.jacobian_re, s.jacobian_im, s.jacobian_real


def _block(blocks, b, vr, vi):
    """The sum of a block's coefficients times slots."""
    start, slot, cr, ci, real = blocks
    first = start[b]
    last = start[b + 1]
    re = splat(0.0)
    im = splat(0.0)
    if real[b] != 0:
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
    """A number times the factor of a part."""
    if s.moving[part] == 0:
        return re, im
    fr = load(w.fr, part)
    if s.toric != 0:
        return re * fr, im * fr
    fi = load(w.fi, part)
    return fnma(im, fi, re * fr), fma(im, fr, re * fi)


def _moved(s, part, re, im, mr, mi):
    """Add a number times the derivative of a part's factor."""
    if s.moving[part] == 0:
        return mr, mi
    br = splat(s.factor_re[2 * part + 1])
    bi = splat(s.factor_im[2 * part + 1])
    return fnma(im, bi, fma(re, br, mr)), fma(im, br, fma(re, bi, mi))


def _row(s, w, k, vr, vi):
    """Polynomial row ``k`` of the slots, and its derivative by t alone."""
    re = splat(0.0)
    im = splat(0.0)
    mr = splat(0.0)
    mi = splat(0.0)
    for b in range(s.value_begin[k], s.value_begin[k + 1]):
        xr, xi = _block(_value_blocks(s), b, vr, vi)
        part = s.value_part[b]
        yr, yi = _scaled(s, w, part, xr, xi)
        re = re + yr
        im = im + yi
        mr, mi = _moved(s, part, xr, xi, mr, mi)
    return re, im, mr, mi


def values(s, w):
    """Minus the values of all rows at the lanes' points and t, into the right-hand side.

    Besides, the derivative of polynomial rows, and of linear ones that move, by t alone.
    """
    zero = splat(0.0)
    for k in range(s.rows):
        re, im, mr, mi = _row(s, w, k, w.vr, w.vi)
        store(w.br, k, zero - re)
        store(w.bi, k, zero - im)
        store(w.sr, k, mr)
        store(w.si, k, mi)
    t = load(w.tr, 0)
    for k in range(s.linear):
        re, im = _line(s, k, s.A0_re, s.A0_im, w.vr, w.vi)
        if s.linear_moving[k] != 0:
            mr, mi = _line(s, k, s.A1_re, s.A1_im, w.vr, w.vi)
            store(w.sr, s.rows + k, mr)
            store(w.si, s.rows + k, mi)
            re = fma(t, mr, re)
            im = fma(t, mi, im)
        store(w.br, s.rows + k, zero - re)
        store(w.bi, s.rows + k, zero - im)
    patches = s.rows + s.linear
    for g in range(s.groups):
        store(w.br, patches + g, splat(1.0))
        store(w.bi, patches + g, zero)
    for j in range(s.N):
        k = patches + s.group_of[j]
        x = load(w.vr, j)
        y = load(w.vi, j)
        pr = load(w.pr, j)
        pi = load(w.pi, j)
        store(w.br, k, fma(pi, y, fnma(pr, x, load(w.br, k))))
        store(w.bi, k, fnma(pi, x, fnma(pr, y, load(w.bi, k))))


def _line(s, k, re, im, vr, vi):
    """Row ``k`` of a matrix times the coordinates."""
    xr = splat(0.0)
    xi = splat(0.0)
    for j in range(s.N):
        cr = splat(re[k * s.N + j])
        ci = splat(im[k * s.N + j])
        x = load(vr, j)
        y = load(vi, j)
        xr = fnma(ci, y, fma(cr, x, xr))
        xi = fma(ci, x, fma(cr, y, xi))
    return xr, xi


def rounding_errors(s, w):
    """Errors that rounding makes of the values of all rows, into the right-hand side.

    Those of a row's terms are independent of each other: what they make together is about the root
    of the sum of their squares.
    """
    for k in range(s.rows):
        total = splat(0.0)
        for b in range(s.value_begin[k], s.value_begin[k + 1]):
            size = splat(0.0)
            for q in range(s.value_start[b], s.value_start[b + 1]):
                c = s.value_re[q]
                d = s.value_im[q]
                square = _square(w.vr, w.vi, s.value_slot[q])
                size = fma(splat(c * c + d * d), square, size)
            part = s.value_part[b]
            if s.moving[part] != 0:
                f = load(w.fr, part)
                size = size * (f * f if s.toric != 0 else _square(w.fr, w.fi, part))
            total = total + size
        _write_error(w, k, total)
    t = load(w.tr, 0)
    for k in range(s.linear):
        total = splat(0.0)
        for j in range(s.N):
            q = k * s.N + j
            fixed = splat(s.A0_re[q] * s.A0_re[q] + s.A0_im[q] * s.A0_im[q])
            moving = splat(s.A1_re[q] * s.A1_re[q] + s.A1_im[q] * s.A1_im[q])
            total = fma(fma(moving, t * t, fixed), _square(w.vr, w.vi, j), total)
        _write_error(w, s.rows + k, total)
    for g in range(s.groups):
        _write_error(w, s.rows + s.linear + g, splat(1.0))


def _square(re, im, k):
    """Square of the absolute value."""
    x, y = load(re, k), load(im, k)
    return fma(x, x, y * y)


def _write_error(w, k, square):
    """Rounding errors of terms with a sum of squares; phases that no smooth vector cancels."""
    size = square_root(square) * splat(EPSILON)
    store(w.br, k, size * splat(math.cos(PHASE * (k * k))))
    store(w.bi, k, size * splat(math.sin(PHASE * (k * k))))


def _entry(s, w, k, moves):
    """Entry ``k`` of the Jacobian, and of its derivative by t if that is wanted."""
    re = splat(0.0)
    im = splat(0.0)
    mr = splat(0.0)
    mi = splat(0.0)
    for b in range(s.jacobian_begin[k], s.jacobian_begin[k + 1]):
        xr, xi = _block(_jacobian_blocks(s), b, w.vr, w.vi)
        part = s.jacobian_part[b]
        yr, yi = _scaled(s, w, part, xr, xi)
        re = re + yr
        im = im + yi
        if moves != 0:
            mr, mi = _moved(s, part, xr, xi, mr, mi)
    store(w.jr, k, re)
    store(w.ji, k, im)
    if moves != 0:
        store(w.mr, k, mr)
        store(w.mi, k, mi)


def jacobian(s, w, moves):
    """The Jacobian of all rows at the lanes' points and t.

    Besides, if ``moves`` is 1, the derivative of its polynomial rows by t alone.
    """
    n = s.N
    for k in range(s.rows * n):
        _entry(s, w, k, moves)
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
    for k in range(patches * n, n * n):
        store(w.jr, k, splat(0.0))
        store(w.ji, k, splat(0.0))
    for j in range(n):
        k = patches + s.group_of[j]
        store(w.jr, k * n + j, load(w.pr, j))
        store(w.ji, k * n + j, load(w.pi, j))


def incomplete_slots(s, w, k):
    """Taylor coefficients of order ``k >= 2`` of the slots, those of the point taken as 0."""
    size = s.N + 1 + s.inner
    for q in range(s.value_products):
        a = s.first[q]
        b = s.second[q]
        re = splat(0.0)
        im = splat(0.0)
        # The second factor is a coordinate, whose coefficient of this order is taken as 0.
        if a > s.N:
            ar, ai = load(w.dr, a), load(w.di, a)
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
        store(w.dr, s.N + 1 + q, re)
        store(w.di, s.N + 1 + q, im)


def complete_slots(s, w, k):
    """The coefficients of order ``k`` of the coordinates, and with them of the inner products.

    Those of the coordinates are the solution in the right-hand side. What they contribute is linear
    in them, so that a product needs two multiplications. For order 1 there is nothing to add to.
    """
    top = (k - 1) * (s.N + 1 + s.inner)
    for j in range(s.N):
        re, im = load(w.br, j), load(w.bi, j)
        store(w.er, j, re)
        store(w.ei, j, im)
        store(w.cr, top + j, re)
        store(w.ci, top + j, im)
    for q in range(s.inner):
        a = s.first[q]
        b = s.second[q]
        ar, ai = load(w.vr, a), load(w.vi, a)
        br, bi = load(w.er, b), load(w.ei, b)
        re = fnma(ai, bi, ar * br)
        im = fma(ai, br, ar * bi)
        ar, ai = load(w.er, a), load(w.ei, a)
        br, bi = load(w.vr, b), load(w.vi, b)
        re = fnma(ai, bi, fma(ar, br, re))
        im = fma(ai, br, fma(ar, bi, im))
        m = s.N + 1 + q
        store(w.er, m, re)
        store(w.ei, m, im)
        if k > 1:
            re = re + load(w.dr, m)
            im = im + load(w.di, m)
        store(w.cr, top + m, re)
        store(w.ci, top + m, im)


def complete_slope(s, w):
    """Add what the solution in the right-hand side contributes to the derivative by t alone.

    That is linear in it: for polynomial rows, the derivative of the Jacobian times it.
    """
    n = s.N
    for k in range(s.rows if s.moves != 0 else 0):
        re = load(w.sr, k)
        im = load(w.si, k)
        # Two sums of each part, which do not wait for one another.
        re_too = splat(0.0)
        im_too = splat(0.0)
        for j in range(n):
            q = k * n + j
            if s.jacobian_begin[q] < s.jacobian_begin[q + 1]:
                mr, mi = load(w.mr, q), load(w.mi, q)
                x, y = load(w.br, j), load(w.bi, j)
                re = fma(mr, x, re)
                im = fma(mr, y, im)
                re_too = fnma(mi, y, re_too)
                im_too = fma(mi, x, im_too)
        store(w.sr, k, re + re_too)
        store(w.si, k, im + im_too)
    for k in range(s.linear):
        if s.linear_moving[k] != 0:
            re, im = _line(s, k, s.A1_re, s.A1_im, w.br, w.bi)
            store(w.sr, s.rows + k, re)
            store(w.si, s.rows + k, im)


def _toric_right_side(s, w, k):
    for j in range(s.N):
        store(w.br, j, splat(0.0))
        store(w.bi, j, splat(0.0))
    size = s.N + 1 + s.inner
    for b in range(s.value_blocks):
        part = s.value_part[b]
        q = s.value_start[b]
        slot = s.value_slot[q]
        minus = load(w.fi, part)
        re, im = load(w.vr, slot), load(w.vi, slot)
        # Horner's rule for the sum of minus^j / j! times the coefficient of order k - j.
        for m in range(1, k):
            rate = minus * splat(1.0 / (k - m + 1))
            re = fma(re, rate, load(w.cr, (m - 1) * size + slot))
            im = fma(im, rate, load(w.ci, (m - 1) * size + slot))
        re = re * minus
        im = im * minus
        if k > 1:
            re = re + load(w.dr, slot)
            im = im + load(w.di, slot)
        f = load(w.fr, part)
        c = f * splat(s.value_re[q])
        d = f * splat(s.value_im[q])
        row = s.value_place[b]
        store(w.br, row, load(w.br, row) - fnma(im, d, re * c))
        store(w.bi, row, load(w.bi, row) - fma(re, d, im * c))


def right_side(s, w, k):
    """Minus the Taylor coefficient of order ``k`` of the rows, that of the point taken as 0.

    The derivative by t alone does not depend on t: its coefficient of order ``k - 1`` is what t
    contributes, and is replaced by the next one, as far as lower orders give it.
    """
    zero = splat(0.0)
    if s.toric != 0:
        _toric_right_side(s, w, k)
        return
    for j in range(s.N):
        store(w.br, j, zero - load(w.sr, j))
        store(w.bi, j, zero - load(w.si, j))
        store(w.sr, j, zero)
        store(w.si, j, zero)
    for j in range(s.rows if k > 1 else 0):
        re, im, mr, mi = _row(s, w, j, w.dr, w.di)
        store(w.br, j, load(w.br, j) - re)
        store(w.bi, j, load(w.bi, j) - im)
        store(w.sr, j, mr)
        store(w.si, j, mi)


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
