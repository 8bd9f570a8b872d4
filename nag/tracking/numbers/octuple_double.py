"""Numbers of eight doubles in lanes, about 120 digits, without branches.

Words are summed by order: what rounding leaves of a sum goes into that of the next order (Priest
1991; Hida, Li & Bailey 2001). Nothing is said of sizes there, so that every sum is `two_sum`.
They are read, written and chosen as those of two quad-doubles.
"""

from __future__ import annotations

from nag.machine_code.lanes import splat
from nag.tracking.numbers import quad_double as half
from nag.tracking.numbers.error_free import two_product, two_sum

WORDS = 8
# Terms of the exponential series that are more than rounding errors for arguments up to 1/64.
TERMS = 43
# Relative size of rounding errors.
EPSILON = 2.0**-412
# Size, relative to the others, below which a coordinate that may be zero counts as this.
SMALL = 2.0**-206


def exact(x):
    """A double as a number."""
    zero = splat(0.0)
    return x, zero, zero, zero, zero, zero, zero, zero


def read(data, k):
    """Number ``k`` of an array in memory."""
    return half.read(data, 2 * k) + half.read(data, 2 * k + 1)


def write(data, k, a):
    """Write number ``k`` of an array in memory."""
    half.write(data, 2 * k, a[:4])
    half.write(data, 2 * k + 1, a[4:])


def same(data, k):
    """Number ``k`` of an array of numbers that are the same in all lanes."""
    return half.same(data, 2 * k) + half.same(data, 2 * k + 1)


def negative(a):
    """``-a``."""
    return half.negative(a[:4]) + half.negative(a[4:])


def _from_6(s, x):
    """Add a double of order 6 to a sum, the words of which are sums of doubles of their orders."""
    s6, x = two_sum(s[6], x)
    return s[0], s[1], s[2], s[3], s[4], s[5], s6, s[7] + x


def _from_5(s, x):
    s5, x = two_sum(s[5], x)
    return _from_6((s[0], s[1], s[2], s[3], s[4], s5, s[6], s[7]), x)


def _from_4(s, x):
    s4, x = two_sum(s[4], x)
    return _from_5((s[0], s[1], s[2], s[3], s4, s[5], s[6], s[7]), x)


def _from_3(s, x):
    s3, x = two_sum(s[3], x)
    return _from_4((s[0], s[1], s[2], s3, s[4], s[5], s[6], s[7]), x)


def _from_2(s, x):
    s2, x = two_sum(s[2], x)
    return _from_3((s[0], s[1], s2, s[3], s[4], s[5], s[6], s[7]), x)


def _from_1(s, x):
    s1, x = two_sum(s[1], x)
    return _from_2((s[0], s1, s[2], s[3], s[4], s[5], s[6], s[7]), x)


def _normalized(s):
    """The same sum in words that do not overlap."""
    g, h = two_sum(s[6], s[7])
    f, g = two_sum(s[5], g)
    e, f = two_sum(s[4], f)
    d, e = two_sum(s[3], e)
    c, d = two_sum(s[2], d)
    b, c = two_sum(s[1], c)
    a, b = two_sum(s[0], b)
    b, c = two_sum(b, c)
    c, d = two_sum(c, d)
    d, e = two_sum(d, e)
    e, f = two_sum(e, f)
    f, g = two_sum(f, g)
    g, h = two_sum(g, h)
    return a, b, c, d, e, f, g, h


def add(a, b):
    """``a + b``."""
    s0, e0 = two_sum(a[0], b[0])
    s1, e1 = two_sum(a[1], b[1])
    s2, e2 = two_sum(a[2], b[2])
    s3, e3 = two_sum(a[3], b[3])
    s4, e4 = two_sum(a[4], b[4])
    s5, e5 = two_sum(a[5], b[5])
    s6, e6 = two_sum(a[6], b[6])
    s = s0, s1, s2, s3, s4, s5, s6, a[7] + b[7] + e6
    s = _from_1(s, e0)
    s = _from_2(s, e1)
    s = _from_3(s, e2)
    s = _from_4(s, e3)
    s = _from_5(s, e4)
    s = _from_6(s, e5)
    return _normalized(s)


def _product_1(s, x, y):
    """Add a product of order 1 to a sum."""
    p, q = two_product(x, y)
    return _from_2(_from_1(s, p), q)


def _product_2(s, x, y):
    p, q = two_product(x, y)
    return _from_3(_from_2(s, p), q)


def _product_3(s, x, y):
    p, q = two_product(x, y)
    return _from_4(_from_3(s, p), q)


def _product_4(s, x, y):
    p, q = two_product(x, y)
    return _from_5(_from_4(s, p), q)


def _product_5(s, x, y):
    p, q = two_product(x, y)
    return _from_6(_from_5(s, p), q)


def _product_6(s, x, y):
    p, q = two_product(x, y)
    s = _from_6(s, p)
    return s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7] + q


def _later_products(s, a, b):
    """Add to a sum all of ``a b`` but the product of the first words."""
    s = _product_1(s, a[0], b[1])
    s = _product_1(s, a[1], b[0])
    s = _product_2(s, a[0], b[2])
    s = _product_2(s, a[1], b[1])
    s = _product_2(s, a[2], b[0])
    s = _product_3(s, a[0], b[3])
    s = _product_3(s, a[1], b[2])
    s = _product_3(s, a[2], b[1])
    s = _product_3(s, a[3], b[0])
    s = _product_4(s, a[0], b[4])
    s = _product_4(s, a[1], b[3])
    s = _product_4(s, a[2], b[2])
    s = _product_4(s, a[3], b[1])
    s = _product_4(s, a[4], b[0])
    s = _product_5(s, a[0], b[5])
    s = _product_5(s, a[1], b[4])
    s = _product_5(s, a[2], b[3])
    s = _product_5(s, a[3], b[2])
    s = _product_5(s, a[4], b[1])
    s = _product_5(s, a[5], b[0])
    s = _product_6(s, a[0], b[6])
    s = _product_6(s, a[1], b[5])
    s = _product_6(s, a[2], b[4])
    s = _product_6(s, a[3], b[3])
    s = _product_6(s, a[4], b[2])
    s = _product_6(s, a[5], b[1])
    s = _product_6(s, a[6], b[0])
    last = a[0] * b[7] + a[1] * b[6] + a[2] * b[5] + a[3] * b[4]
    last = last + (a[4] * b[3] + a[5] * b[2] + a[6] * b[1] + a[7] * b[0])
    return s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7] + last


def multiply(a, b):
    """``a b``."""
    zero = splat(0.0)
    p, q = two_product(a[0], b[0])
    return _normalized(_later_products((p, q, zero, zero, zero, zero, zero, zero), a, b))


def gather(s, a, b):
    """``s + a b`` where the words of ``s`` and of the result may overlap."""
    p, q = two_product(a[0], b[0])
    s0, p = two_sum(s[0], p)
    s = _from_1((s0, s[1], s[2], s[3], s[4], s[5], s[6], s[7]), p)
    return _later_products(_from_1(s, q), a, b)


def gathered(s):
    """The number whose words overlap."""
    return _normalized(s)


def scale(a, power):
    """``a`` times lanes that hold powers of two."""
    return half.scale(a[:4], power) + half.scale(a[4:], power)


def choose(a, b, x, y):
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
    return half.choose(a, b, x[:4], y[:4]) + half.choose(a, b, x[4:], y[4:])
