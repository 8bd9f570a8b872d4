"""Double-double arithmetic in lanes (Dekker 1971; Knuth; Hida, Li & Bailey 2001).

A double-double is a pair ``(high, low)`` of lanes, ``|low| <= ulp(high) / 2``; about 32 digits.
Everything rests on two error-free transformations, `two_sum` and `two_product`, which hold only
as long as nothing is reassociated or contracted.
"""

from __future__ import annotations

import numpy as np

from nag.algebra.number import Irrational, Number, to_mpf
from nag.machine_code.lanes import fused, load, splat, store


def two_sum(a, b):
    """``(s, e)`` with ``s = fl(a + b)`` and ``s + e = a + b`` exactly."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def two_product(a, b):
    """``(p, e)`` with ``p = fl(a b)`` and ``p + e = a b`` exactly."""
    p = a * b
    return p, fused(a, b, splat(0.0) - p)


def add(ah, al, bh, bl):
    """Sum of two double-doubles."""
    s, e = two_sum(ah, bh)
    t, f = two_sum(al, bl)
    e = e + t
    h = s + e
    e = e - (h - s)
    e = e + f
    s = h + e
    return s, e - (s - h)


def multiply(ah, al, bh, bl):
    """Product of two double-doubles."""
    p, e = two_product(ah, bh)
    e = e + (ah * bl + al * bh)
    s = p + e
    return s, e - (s - p)


def multiply_complex(a, b):
    """Product of two complex double-doubles ``(re high, re low, im high, im low)``."""
    ph, pl = multiply(a[0], a[1], b[0], b[1])
    qh, ql = multiply(a[2], a[3], b[2], b[3])
    zero = splat(0.0)
    rh, rl = add(ph, pl, zero - qh, zero - ql)
    ph, pl = multiply(a[0], a[1], b[2], b[3])
    qh, ql = multiply(a[2], a[3], b[0], b[1])
    ih, il = add(ph, pl, qh, ql)
    return rh, rl, ih, il


def add_complex(a, b):
    """Sum of two complex double-doubles."""
    rh, rl = add(a[0], a[1], b[0], b[1])
    ih, il = add(a[2], a[3], b[2], b[3])
    return rh, rl, ih, il


def load_complex(data, size, k):
    """Complex double-double ``k`` of an array of four blocks of ``size`` vectors."""
    return (
        load(data, k),
        load(data, size + k),
        load(data, 2 * size + k),
        load(data, 3 * size + k),
    )


def store_complex(data, size, k, a):
    """Write a complex double-double, see `load_complex`."""
    store(data, k, a[0])
    store(data, size + k, a[1])
    store(data, 2 * size + k, a[2])
    store(data, 3 * size + k, a[3])


def split(value: Number | complex, scale: float = 1.0) -> tuple[complex, complex]:
    """``value / scale`` as a double-double, high and low part; ``scale`` a power of two."""
    if isinstance(value, Irrational):
        exact = to_mpf(value, 40)
        high = float(exact)
        low = float(exact - high)
    elif isinstance(value, complex | float | np.complexfloating | np.floating):
        return complex(value) / scale, 0j
    else:
        high = float(value)
        low = float(value - type(value)(high)) if np.isfinite(high) else 0.0
    return complex(high / scale), complex(low / scale)
