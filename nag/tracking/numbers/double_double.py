"""Double-double arithmetic in lanes, about 32 digits (Hida, Li & Bailey 2001)."""

from __future__ import annotations

from dataclasses import dataclass

from nag.machine_code.lanes import fma, load, select_less, splat, store
from nag.tracking.numbers.error_free import quick_two_sum, two_product, two_sum


@dataclass(frozen=True)
class DoubleDouble:
    """Real numbers of two words.

    Attributes:
        words: doubles in a number.
        terms: of the exponential series that are more than rounding errors for arguments up to
            1/64.
        epsilon: relative size of rounding errors.
        small: size, relative to the others, below which a coordinate that may be zero counts as
            this.
    """

    words: int = 2
    terms: int = 14
    epsilon: float = 2.0**-104
    small: float = 2.0**-52

    def exact(self, x):
        """A double as a number."""
        return x, splat(0.0)

    def read(self, data, k):
        """Number ``k`` of an array in memory."""
        return load(data, 2 * k), load(data, 2 * k + 1)

    def write(self, data, k, a):
        """Write number ``k`` of an array in memory."""
        store(data, 2 * k, a[0])
        store(data, 2 * k + 1, a[1])

    def same(self, data, k):
        """Number ``k`` of an array of numbers that are the same in all lanes."""
        return splat(data[2 * k]), splat(data[2 * k + 1])

    def negative(self, a):
        """``-a``."""
        zero = splat(0.0)
        return zero - a[0], zero - a[1]

    def add(self, a, b):
        """``a + b``."""
        s, e = two_sum(a[0], b[0])
        t, f = two_sum(a[1], b[1])
        s, e = quick_two_sum(s, e + t)
        return quick_two_sum(s, e + f)

    def multiply(self, a, b):
        """``a b``."""
        p, e = two_product(a[0], b[0])
        return quick_two_sum(p, e + (a[0] * b[1] + a[1] * b[0]))

    def gather(self, s, a, b):
        """``s + a b`` where the words of ``s`` and of the result may overlap."""
        p, e = two_product(a[0], b[0])
        t, f = two_sum(s[0], p)
        return t, s[1] + (f + fma(a[0], b[1], fma(a[1], b[0], e)))

    def gathered(self, s):
        """The number whose words overlap."""
        return two_sum(s[0], s[1])

    def scale(self, a, power):
        """``a`` times lanes that hold powers of two."""
        return a[0] * power, a[1] * power

    def choose(self, a, b, x, y):
        """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
        return select_less(a, b, x[0], y[0]), select_less(a, b, x[1], y[1])


DOUBLE_DOUBLE = DoubleDouble()
