"""Complex numbers: pairs of the numbers of an arithmetic; kernels are given one of these."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nag.machine_code.lanes import fma, select_less, splat, square_root
from nag.tracking.numbers.double_double import DOUBLE_DOUBLE
from nag.tracking.numbers.many_words import OCTUPLE_DOUBLE, QUAD_DOUBLE

# An exponential's argument is halved so often before its series is summed.
HALVINGS = 12
HALVED = 2.0**-HALVINGS
# As often it is squared at last, from an argument of at most 1.
SQUARINGS = 6
# Squares that are smaller have lost digits, or are zero, unless what is squared is made larger.
SMALL_SQUARE, LARGER = 1e-270, 2.0**500


def length(re, im):
    """Absolute value of doubles, however small they are."""
    square = fma(re, re, im * im)
    larger, other = re * splat(LARGER), im * splat(LARGER)
    root = square_root(fma(larger, larger, other * other)) / splat(LARGER)
    return select_less(square, splat(SMALL_SQUARE), root, square_root(square))


def largest(a, b):
    """The larger of two doubles in each lane."""
    return select_less(a, b, b, a)


@dataclass(frozen=True)
class ComplexNumbers:
    """Pairs of numbers, real and imaginary part.

    Attributes:
        number: what real numbers are, and how they are added, multiplied, read and written.
        pivot: part of the largest entry of a column below which a pivot is exchanged.
    """

    number: Any
    pivot: float = 1.0

    def __str__(self) -> str:
        return f"{self.number.words}_words"

    def read(self, data, k):
        """Complex number ``k`` of an array in memory."""
        return self.number.read(data, 2 * k), self.number.read(data, 2 * k + 1)

    def write(self, data, k, a):
        """Write complex number ``k`` of an array in memory."""
        re, im = a
        self.number.write(data, 2 * k, re)
        self.number.write(data, 2 * k + 1, im)

    def same(self, data, k):
        """Complex number ``k`` of an array of numbers that are the same in all lanes."""
        return self.number.same(data, 2 * k), self.number.same(data, 2 * k + 1)

    def exact(self, re, im):
        """The complex number with these doubles as its parts."""
        return self.number.exact(re), self.number.exact(im)

    def rounded(self, a):
        """Real and imaginary part as doubles."""
        re, im = a
        return re[0], im[0]

    def negative(self, a):
        """``-a``."""
        re, im = a
        return self.number.negative(re), self.number.negative(im)

    def add(self, a, b):
        """``a + b``."""
        ar, ai = a
        br, bi = b
        return self.number.add(ar, br), self.number.add(ai, bi)

    def multiply(self, a, b):
        """``a b``."""
        ar, ai = a
        br, bi = b
        re = self.number.add(
            self.number.multiply(ar, br), self.number.negative(self.number.multiply(ai, bi))
        )
        im = self.number.add(self.number.multiply(ar, bi), self.number.multiply(ai, br))
        return re, im

    def weigh(self, a, factor):
        """``a`` times a factor."""
        return self.multiply(factor, a)

    def add_product(self, s, a, b):
        """``s + a b``."""
        return self.add(s, self.multiply(a, b))

    def add_multiple(self, s, a, x):
        """``s + a x`` with a real number."""
        return self.add(s, self.stretch(a, x))

    def is_real(self, data, k):
        """Whether number ``k``, the same in all lanes, of an array is real."""
        return data[self.number.words * (2 * k + 1)] == 0.0

    def term(self, data, k, a):
        """Number ``k``, the same in all lanes, of an array times ``a``."""
        if self.is_real(data, k):
            return self.stretch(a, self.number.same(data, 2 * k))
        return self.multiply(self.same(data, k), a)

    def add_term(self, s, data, k, a):
        """``s + c a`` with number ``k``, the same in all lanes, of an array."""
        return self.add(s, self.term(data, k, a))

    def begin(self, a, b):
        """``a b``, to which products are gathered."""
        return self.gather(self.exact(splat(0.0), splat(0.0)), a, b)

    def gather(self, s, a, b):
        """``s + a b`` where words of ``s`` and of the result may overlap, in half the work."""
        sr, si = s
        ar, ai = a
        br, bi = b
        sr = self.number.gather(self.number.gather(sr, ar, br), self.number.negative(ai), bi)
        si = self.number.gather(self.number.gather(si, ar, bi), ai, br)
        return sr, si

    def gather_real(self, s, a, x):
        """``s + a x`` with a real number; words of ``s`` and of the result may overlap."""
        sr, si = s
        ar, ai = a
        return self.number.gather(sr, ar, x), self.number.gather(si, ai, x)

    def gathered(self, s):
        """The number whose words overlap."""
        sr, si = s
        return self.number.gathered(sr), self.number.gathered(si)

    def scale(self, a, power):
        """``a`` times lanes that hold powers of two."""
        re, im = a
        return self.number.scale(re, power), self.number.scale(im, power)

    def choose(self, a, b, x, y):
        """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
        xr, xi = x
        yr, yi = y
        return self.number.choose(a, b, xr, yr), self.number.choose(a, b, xi, yi)

    def inverse(self, a):
        """``1 / a`` by Newton's method from the inverse in doubles."""
        re, im = self.rounded(a)
        power = select_less(fma(re, re, im * im), splat(SMALL_SQUARE), splat(LARGER), splat(1.0))
        re = re * power
        im = im * power
        size = power / fma(re, re, im * im)
        one = self.exact(splat(1.0), splat(0.0))
        result = self.exact(re * size, splat(0.0) - im * size)
        digits = 1
        while digits < self.number.words:
            rest = self.add(one, self.negative(self.multiply(a, result)))
            result = self.add(result, self.multiply(result, rest))
            digits = digits + digits
        return result

    def magnitude(self, a):
        """Absolute value as a double."""
        re, im = self.rounded(a)
        return length(re, im)

    def size(self, a):
        """What grows with the absolute value, by which pivots are compared."""
        return self.magnitude(a)

    def stretch(self, a, x):
        """``a`` times a real number."""
        re, im = a
        return self.number.multiply(re, x), self.number.multiply(im, x)

    def exponential(self, a, inverses):
        """``exp(a)`` for ``|a|`` up to 64.

        Args:
            inverses: the numbers ``1 / k``, the same in all lanes, in memory.
        """
        one = self.exact(splat(1.0), splat(0.0))
        small = self.scale(a, splat(HALVED))
        # s = exp(..) - 1, of which doubling the argument makes 2 s + s^2, keeps its small digits;
        # where exp(..) itself becomes small, squares do.
        s = small
        for k in range(self.number.terms, 1, -1):
            s = self.gathered(
                self.gather(small, small, self.stretch(s, self.number.same(inverses, k)))
            )
        for _k in range(HALVINGS - SQUARINGS):
            s = self.gathered(self.gather(self.scale(s, splat(2.0)), s, s))
        result = self.add(one, s)
        for _k in range(SQUARINGS):
            result = self.multiply(result, result)
        return result


# By the doubles in a real number.
ARITHMETICS = {
    number.words: ComplexNumbers(number) for number in (DOUBLE_DOUBLE, QUAD_DOUBLE, OCTUPLE_DOUBLE)
}
