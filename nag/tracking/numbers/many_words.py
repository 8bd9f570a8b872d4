"""Numbers of four or eight doubles in lanes, about 64 and 120 digits, without branches.

Words are summed by order: what rounding leaves of a sum goes into that of the next order (Priest
1991; Hida, Li & Bailey 2001). Nothing is said of sizes there, so that every sum is `two_sum`.
Sums are tuples of the words of some order and up; what is done with one and those that follow is
done with the rest of the tuple in the same way.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nag.machine_code.lanes import fma, splat
from nag.tracking.numbers.double_double import DOUBLE_DOUBLE
from nag.tracking.numbers.error_free import two_product, two_sum


def _add_double(s, x):
    """Add a double of the order of the first word to a sum."""
    if len(s) == 1:
        return (s[0] + x,)
    first, rest = two_sum(s[0], x)
    return (first, *_add_double(s[1:], rest))


def _add_product(s, x, y):
    """Add a product of two doubles, of the order of the first word, to a sum."""
    product, rest = two_product(x, y)
    s = _add_double(s, product)
    return (*s[:1], *_add_double(s[1:], rest))


def _add_order(s, a, b):
    """Add the products of one order: of a word of ``a`` each, and one of ``b`` from its end on."""
    s = _add_product(s, a[0], b[-1])
    return s if len(a) == 1 else _add_order(s, a[1:], b[:-1])


def _last_order(a, b):
    """The products of one order, as in `_add_order`, of which a double is enough."""
    if len(a) == 1:
        return a[0] * b[0]
    return fma(a[0], b[-1], _last_order(a[1:], b[:-1]))


def _add_products(s, a, b):
    """Add all products of words, from those of the order of the first word of a sum on."""
    if len(s) == 1:
        return (s[0] + _last_order(a, b),)
    s = _add_order(s, a[: len(a) - len(s) + 1], b[: len(a) - len(s) + 1])
    return (*s[:1], *_add_products(s[1:], a, b))


def _add_words(a, b):
    """The sum of two numbers, in words that may overlap."""
    if len(a) == 1:
        return (a[0] + b[0],)
    first, rest = two_sum(a[0], b[0])
    return (first, *_add_double(_add_words(a[1:], b[1:]), rest))


def _carry_up(s):
    """Carry from the last word to the first."""
    if len(s) == 1:
        return s
    rest = _carry_up(s[1:])
    first, second = two_sum(s[0], rest[0])
    return (first, second, *rest[1:])


def _carry_down(s):
    """Carry from the first word to the last, what is left of each two to the next two."""
    if len(s) == 1:
        return s
    first, rest = two_sum(s[0], s[1])
    return (first, *_carry_down((rest, *s[2:])))


@dataclass(frozen=True)
class ManyWords:
    """Real numbers of twice as many words as those of ``half`` have.

    Attributes:
        half: words are read, written and chosen as those of two of its numbers.
        words, terms: see `nag.tracking.numbers.double_double.DoubleDouble`.
        bits: that rounding leaves of a number.
    """

    half: Any
    words: int
    terms: int
    bits: int

    @property
    def epsilon(self) -> float:
        """Relative size of rounding errors."""
        return 2.0**-self.bits

    @property
    def small(self) -> float:
        """Relative size below which a coordinate that may be zero counts as this."""
        return 2.0 ** -(self.bits // 2)

    def exact(self, x):
        """A double as a number."""
        return (*self.half.exact(x), *self.half.exact(splat(0.0)))

    def read(self, data, k):
        """Number ``k`` of an array in memory."""
        return (*self.half.read(data, 2 * k), *self.half.read(data, 2 * k + 1))

    def write(self, data, k, a):
        """Write number ``k`` of an array in memory."""
        self.half.write(data, 2 * k, a[: self.half.words])
        self.half.write(data, 2 * k + 1, a[self.half.words :])

    def same(self, data, k):
        """Number ``k`` of an array of numbers that are the same in all lanes."""
        return (*self.half.same(data, 2 * k), *self.half.same(data, 2 * k + 1))

    def negative(self, a):
        """``-a``."""
        upper, lower = a[: self.half.words], a[self.half.words :]
        return (*self.half.negative(upper), *self.half.negative(lower))

    def add(self, a, b):
        """``a + b``."""
        return self.gathered(_add_words(a, b))

    def multiply(self, a, b):
        """``a b``."""
        product, rest = two_product(a[0], b[0])
        later = (rest, *self.exact(splat(0.0))[2:])
        return self.gathered((product, *_add_products(later, a, b)))

    def gather(self, s, a, b):
        """``s + a b`` where the words of ``s`` and of the result may overlap."""
        return _add_products(s, a, b)

    def gathered(self, s):
        """The number whose words overlap."""
        s = _carry_up(s)
        return (*s[:1], *_carry_down(s[1:]))

    def scale(self, a, power):
        """``a`` times lanes that hold powers of two."""
        upper, lower = a[: self.half.words], a[self.half.words :]
        return (*self.half.scale(upper, power), *self.half.scale(lower, power))

    def choose(self, a, b, x, y):
        """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
        upper = self.half.choose(a, b, x[: self.half.words], y[: self.half.words])
        lower = self.half.choose(a, b, x[self.half.words :], y[self.half.words :])
        return (*upper, *lower)


QUAD_DOUBLE = ManyWords(DOUBLE_DOUBLE, 4, 25, 205)
OCTUPLE_DOUBLE = ManyWords(QUAD_DOUBLE, 8, 43, 412)
