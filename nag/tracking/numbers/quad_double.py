"""Quad-double arithmetic in lanes, about 64 digits (Hida, Li & Bailey 2001), without branches.

Words are read, written and chosen as those of two double-doubles.
"""

from __future__ import annotations

from nag.machine_code.lanes import fma, splat
from nag.tracking.numbers import double_double as half
from nag.tracking.numbers.error_free import (
    quick_two_sum,
    three_sum,
    three_sum_rounded,
    two_product,
    two_sum,
)

WORDS = 4
# Terms of the exponential series that are more than rounding errors for arguments up to 1/64.
TERMS = 25
# Relative size of rounding errors.
EPSILON = 2.0**-205
# Size, relative to the others, below which a coordinate that may be zero counts as this.
SMALL = 2.0**-102


def exact(x):
    """A double as a number."""
    zero = splat(0.0)
    return x, zero, zero, zero


def read(data, k):
    """Number ``k`` of an array in memory."""
    return half.read(data, 2 * k) + half.read(data, 2 * k + 1)


def write(data, k, a):
    """Write number ``k`` of an array in memory."""
    half.write(data, 2 * k, a[:2])
    half.write(data, 2 * k + 1, a[2:])


def same(data, k):
    """Number ``k`` of an array of numbers that are the same in all lanes."""
    return half.same(data, 2 * k) + half.same(data, 2 * k + 1)


def negative(a):
    """``-a``."""
    return half.negative(a[:2]) + half.negative(a[2:])


def _normalized(a, b, c, d, e):
    """The sum of five numbers of decreasing size as four that do not overlap."""
    d, e = quick_two_sum(d, e)
    c, d = quick_two_sum(c, d)
    b, c = quick_two_sum(b, c)
    a, b = quick_two_sum(a, b)
    b, c = quick_two_sum(b, c)
    c, d = quick_two_sum(c, d)
    d = d + e
    return a, b, c, d


def add(a, b):
    """``a + b``."""
    s, e = two_sum(a[0], b[0])
    t, f = two_sum(a[1], b[1])
    u, g = two_sum(a[2], b[2])
    v, h = two_sum(a[3], b[3])
    t, e = two_sum(t, e)
    u, e, f = three_sum(u, e, f)
    v, e = three_sum_rounded(v, e, g)
    return _normalized(s, t, u, v, e + f + h)


def _products(a, b):
    """Products of the leading words, the largest first, and what rounding took from each."""
    p0, q0 = two_product(a[0], b[0])
    p1, q1 = two_product(a[0], b[1])
    p2, q2 = two_product(a[1], b[0])
    p3, q3 = two_product(a[0], b[2])
    p4, q4 = two_product(a[1], b[1])
    p5, q5 = two_product(a[2], b[0])
    return p0, p1, p2, p3, p4, p5, q0, q1, q2, q3, q4, q5


def multiply(a, b):
    """``a b``."""
    p0, p1, p2, p3, p4, p5, q0, q1, q2, q3, q4, q5 = _products(a, b)
    p1, p2, q0 = three_sum(p1, p2, q0)
    p2, q1, q2 = three_sum(p2, q1, q2)
    p3, p4, p5 = three_sum(p3, p4, p5)
    s0, t0 = two_sum(p2, p3)
    s1, t1 = two_sum(q1, p4)
    s2 = q2 + p5
    s1, t0 = two_sum(s1, t0)
    s2 = s2 + (t0 + t1)
    s1 = s1 + (a[0] * b[3] + a[1] * b[2] + a[2] * b[1] + a[3] * b[0] + q0 + q3 + q4 + q5)
    return _normalized(p0, p1, s0, s1, s2)


def gather(s, a, b):
    """``s + a b`` where the words of ``s`` and of the result may overlap."""
    p0, p1, p2, p3, p4, p5, q0, q1, q2, q3, q4, q5 = _products(a, b)
    last = fma(a[0], b[3], fma(a[1], b[2], fma(a[2], b[1], fma(a[3], b[0], q3 + q4 + q5))))
    s0, e0 = two_sum(s[0], p0)
    s1, e1 = two_sum(s[1], p1)
    s1, e2 = two_sum(s1, p2)
    s1, e3 = two_sum(s1, q0)
    s1, e4 = two_sum(s1, e0)
    s2, f0 = two_sum(s[2], p3)
    s2, f1 = two_sum(s2, p4)
    s2, f2 = two_sum(s2, p5)
    s2, f3 = two_sum(s2, q1)
    s2, f4 = two_sum(s2, q2)
    s2, f5 = two_sum(s2, e1)
    s2, f6 = two_sum(s2, e2)
    s2, f7 = two_sum(s2, e3)
    s2, f8 = two_sum(s2, e4)
    rest = ((f0 + f1) + (f2 + f3)) + ((f4 + f5) + (f6 + f7)) + (f8 + last)
    return s0, s1, s2, s[3] + rest


def gathered(s):
    """The number whose words overlap."""
    c, d = two_sum(s[2], s[3])
    b, c = two_sum(s[1], c)
    a, b = two_sum(s[0], b)
    b, c = two_sum(b, c)
    c, d = two_sum(c, d)
    return a, b, c, d


def scale(a, power):
    """``a`` times lanes that hold powers of two."""
    return half.scale(a[:2], power) + half.scale(a[2:], power)


def choose(a, b, x, y):
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
    return half.choose(a, b, x[:2], y[:2]) + half.choose(a, b, x[2:], y[2:])
