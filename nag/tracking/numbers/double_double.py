"""Double-double arithmetic in lanes, about 32 digits (Hida, Li & Bailey 2001)."""

from __future__ import annotations

from nag.machine_code.lanes import fma, load, select_less, splat, store
from nag.tracking.numbers.error_free import quick_two_sum, two_product, two_sum

WORDS = 2
# Terms of the exponential series that are more than rounding errors for arguments up to 1/64.
TERMS = 14
# Relative size of rounding errors.
EPSILON = 2.0**-104
# Size, relative to the others, below which a coordinate that may be zero counts as this.
SMALL = 2.0**-52


def exact(x):
    """A double as a number."""
    return x, splat(0.0)


def read(data, k):
    """Number ``k`` of an array in memory."""
    return load(data, 2 * k), load(data, 2 * k + 1)


def write(data, k, a):
    """Write number ``k`` of an array in memory."""
    store(data, 2 * k, a[0])
    store(data, 2 * k + 1, a[1])


def same(data, k):
    """Number ``k`` of an array of numbers that are the same in all lanes."""
    return splat(data[2 * k]), splat(data[2 * k + 1])


def negative(a):
    """``-a``."""
    zero = splat(0.0)
    return zero - a[0], zero - a[1]


def add(a, b):
    """``a + b``."""
    s, e = two_sum(a[0], b[0])
    t, f = two_sum(a[1], b[1])
    s, e = quick_two_sum(s, e + t)
    return quick_two_sum(s, e + f)


def multiply(a, b):
    """``a b``."""
    p, e = two_product(a[0], b[0])
    return quick_two_sum(p, e + (a[0] * b[1] + a[1] * b[0]))


def gather(s, a, b):
    """``s + a b`` where the words of ``s`` and of the result may overlap."""
    p, e = two_product(a[0], b[0])
    t, f = two_sum(s[0], p)
    return t, s[1] + (f + fma(a[0], b[1], fma(a[1], b[0], e)))


def gathered(s):
    """The number whose words overlap."""
    return two_sum(s[0], s[1])


def scale(a, power):
    """``a`` times lanes that hold powers of two."""
    return a[0] * power, a[1] * power


def choose(a, b, x, y):
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
    return select_less(a, b, x[0], y[0]), select_less(a, b, x[1], y[1])
