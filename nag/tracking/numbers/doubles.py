"""Doubles as an arithmetic: the methods of the others, where one word is all that there is.

Products are gathered by multiply-adds, in the order that is written here; see `complex_numbers` for
what the methods are.
"""

from __future__ import annotations

from dataclasses import dataclass

from nag.machine_code.lanes import fma, fnma, load, select_less, splat, store


@dataclass(frozen=True)
class Doubles:
    """Real numbers of one word."""

    words: int = 1

    def read(self, data, k):
        """Number ``k`` of an array in memory."""
        return load(data, k)

    def write(self, data, k, a):
        """Write number ``k`` of an array in memory."""
        store(data, k, a)

    def same(self, data, k):
        """Number ``k`` of an array of numbers that are the same in all lanes."""
        return splat(data[k])


@dataclass(frozen=True)
class ComplexDoubles:
    """Pairs of doubles.

    Attributes:
        number: what real numbers are.
        pivot: a row stays where it is unless the size of its pivot is less than this part of the
            largest one: most exchanges of partial pivoting would bring nothing (Duff, Erisman and
            Reid, Direct Methods for Sparse Matrices, 1986, 5.2).
    """

    number: Doubles = Doubles()
    pivot: float = 0.01

    def __str__(self) -> str:
        return "doubles"

    def read(self, data, k):
        """Complex number ``k`` of an array in memory."""
        return load(data, 2 * k), load(data, 2 * k + 1)

    def write(self, data, k, a):
        """Write complex number ``k`` of an array in memory."""
        re, im = a
        store(data, 2 * k, re)
        store(data, 2 * k + 1, im)

    def same(self, data, k):
        """Complex number ``k`` of an array of numbers that are the same in all lanes."""
        return splat(data[2 * k]), splat(data[2 * k + 1])

    def exact(self, re, im):
        """The complex number with these parts."""
        return re, im

    def negative(self, a):
        """``-a``."""
        re, im = a
        return splat(0.0) - re, splat(0.0) - im

    def add(self, a, b):
        """``a + b``."""
        ar, ai = a
        br, bi = b
        return ar + br, ai + bi

    def subtract(self, a, b):
        """``a - b``."""
        ar, ai = a
        br, bi = b
        return ar - br, ai - bi

    def multiply(self, a, b):
        """``a b``."""
        ar, ai = a
        br, bi = b
        return fnma(ai, bi, ar * br), fma(ai, br, ar * bi)

    def weigh(self, a, factor):
        """``a`` times a factor."""
        return self.multiply(a, factor)

    def stretch(self, a, x):
        """``a`` times a real number."""
        re, im = a
        return re * x, im * x

    def begin(self, a, b):
        """``a b``, to which products are gathered."""
        return self.multiply(a, b)

    def gather(self, s, a, b):
        """``s + a b``."""
        sr, si = s
        ar, ai = a
        br, bi = b
        return fnma(ai, bi, fma(ar, br, sr)), fma(ai, br, fma(ar, bi, si))

    def gathered(self, s):
        """What was gathered."""
        return s

    def add_product(self, s, a, b):
        """``s + a b``."""
        return self.gather(s, a, b)

    def add_multiple(self, s, a, x):
        """``s + a x`` with a real number."""
        sr, si = s
        ar, ai = a
        return fma(ar, x, sr), fma(ai, x, si)

    def add_term(self, s, data, k, a):
        """``s + c a`` with number ``k``, the same in all lanes, of an array."""
        return self.gather(s, self.same(data, k), a)

    def subtract_product(self, s, a, b):
        """``s - a b``."""
        sr, si = s
        ar, ai = a
        br, bi = b
        return fma(ai, bi, fnma(ar, br, sr)), fnma(ai, br, fnma(ar, bi, si))

    def choose(self, a, b, x, y):
        """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
        xr, xi = x
        yr, yi = y
        return select_less(a, b, xr, yr), select_less(a, b, xi, yi)

    def square(self, a):
        """Square of the absolute value."""
        re, im = a
        return fma(re, re, im * im)

    def add_square(self, s, a):
        """``s`` and the square of the absolute value."""
        re, im = a
        return fma(re, re, fma(im, im, s))

    def size(self, a):
        """What grows with the absolute value, by which pivots are compared."""
        return self.square(a)

    def inverse(self, a):
        """``1 / a``."""
        re, im = a
        inverse = splat(1.0) / self.square(a)
        return re * inverse, splat(0.0) - im * inverse


DOUBLES = ComplexDoubles()
