"""Complex double-doubles in kernels: arithmetic, and linear systems.

A number is four doubles: real part, its low part, imaginary part, its low part. Arrays hold one
number after the other. No operation may be contracted or reassociated.
"""

from __future__ import annotations

# 2^27 + 1 splits a double into two halves (Dekker 1971).
SPLITTER = 134217729.0


def add(ah, al, bh, bl):
    s = ah + bh
    v = s - ah
    e = (ah - (s - v)) + (bh - v) + (al + bl)
    h = s + e
    return h, e - (h - s)


def multiply(ah, al, bh, bl):
    p = ah * bh
    t = SPLITTER * ah
    a1 = t - (t - ah)
    a2 = ah - a1
    t = SPLITTER * bh
    b1 = t - (t - bh)
    b2 = bh - b1
    e = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2 + (ah * bl + al * bh)
    h = p + e
    return h, e - (h - p)


def times(a, b):
    """Product of complex double-doubles."""
    ph, pl = multiply(a[0], a[1], b[0], b[1])
    qh, ql = multiply(a[2], a[3], b[2], b[3])
    rh, rl = multiply(a[0], a[1], b[2], b[3])
    sh, sl = multiply(a[2], a[3], b[0], b[1])
    re, re_low = add(ph, pl, -qh, -ql)
    im, im_low = add(rh, rl, sh, sl)
    return re, re_low, im, im_low


def plus(a, b):
    re, re_low = add(a[0], a[1], b[0], b[1])
    im, im_low = add(a[2], a[3], b[2], b[3])
    return re, re_low, im, im_low


def minus(a, b):
    re, re_low = add(a[0], a[1], -b[0], -b[1])
    im, im_low = add(a[2], a[3], -b[2], -b[3])
    return re, re_low, im, im_low


def at(data, k):
    """Complex double-double ``k`` of an array."""
    return data[4 * k], data[4 * k + 1], data[4 * k + 2], data[4 * k + 3]


def put(data, k, a):
    data[4 * k] = a[0]
    data[4 * k + 1] = a[1]
    data[4 * k + 2] = a[2]
    data[4 * k + 3] = a[3]


def exact(z):
    return z.real, 0.0, z.imag, 0.0


def add_product(data, k, a, b):
    put(data, k, plus(at(data, k), times(a, b)))


def subtract_product(data, k, a, b):
    put(data, k, minus(at(data, k), times(a, b)))


def clear(data, count):
    for k in range(4 * count):
        data[k] = 0.0


def reciprocal(a):
    """``1 / a`` by one Newton step from the inverse in doubles."""
    z = 1.0 / complex(a[0], a[2])
    rough = exact(z)
    product = times(a, rough)
    re, re_low = add(2.0, 0.0, -product[0], -product[1])
    return times(rough, (re, re_low, -product[2], -product[3]))


def factorize(n, m, pivots):
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
        inverse = reciprocal(at(m, n * k + k))
        put(m, n * k + k, inverse)
        for i in range(k + 1, n):
            if m[4 * (n * i + k)] == 0.0 and m[4 * (n * i + k) + 2] == 0.0:
                continue
            factor = times(at(m, n * i + k), inverse)
            put(m, n * i + k, factor)
            for j in range(k + 1, n):
                subtract_product(m, n * i + j, factor, at(m, n * k + j))
    return True


def substitute(n, m, pivots, b):
    for k in range(n):
        row = pivots[k]
        if row != k:
            for c in range(4):
                b[4 * k + c], b[4 * row + c] = b[4 * row + c], b[4 * k + c]
    for i in range(n):
        for j in range(i):
            subtract_product(b, i, at(m, n * i + j), at(b, j))
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            subtract_product(b, i, at(m, n * i + j), at(b, j))
        put(b, i, times(at(b, i), at(m, n * i + i)))


def norm(n, b):
    total = 0.0
    for j in range(n):
        total += b[4 * j] ** 2 + b[4 * j + 2] ** 2
    return total**0.5
