"""Complex numbers over the arithmetic that a kernel is compiled for: pairs of its numbers."""

from __future__ import annotations

from nag.machine_code.lanes import fma, select_less, splat, square_root
from nag.tracking.numbers import double_double as number

# An exponential's argument is halved so often before its series is summed.
HALVINGS = 12
HALVED = 2.0**-HALVINGS
# As often it is squared at last, from an argument of at most 1.
SQUARINGS = 6
# Squares that are smaller have lost digits, or are zero, unless what is squared is made larger.
SMALL_SQUARE, LARGER = 1e-270, 2.0**500


def read(data, k):
    """Complex number ``k`` of an array in memory."""
    return number.read(data, 2 * k), number.read(data, 2 * k + 1)


def write(data, k, a):
    """Write complex number ``k`` of an array in memory."""
    re, im = a
    number.write(data, 2 * k, re)
    number.write(data, 2 * k + 1, im)


def same(data, k):
    """Complex number ``k`` of an array of numbers that are the same in all lanes."""
    return number.same(data, 2 * k), number.same(data, 2 * k + 1)


def exact(re, im):
    """The complex number with these doubles as its parts."""
    return number.exact(re), number.exact(im)


def rounded(a):
    """Real and imaginary part as doubles."""
    re, im = a
    return re[0], im[0]


def negative(a):
    """``-a``."""
    re, im = a
    return number.negative(re), number.negative(im)


def add(a, b):
    """``a + b``."""
    ar, ai = a
    br, bi = b
    return number.add(ar, br), number.add(ai, bi)


def multiply(a, b):
    """``a b``."""
    ar, ai = a
    br, bi = b
    re = number.add(number.multiply(ar, br), number.negative(number.multiply(ai, bi)))
    im = number.add(number.multiply(ar, bi), number.multiply(ai, br))
    return re, im


def gather(s, a, b):
    """``s + a b`` where words of ``s`` and of the result may overlap: half the work of the two."""
    sr, si = s
    ar, ai = a
    br, bi = b
    sr = number.gather(number.gather(sr, ar, br), number.negative(ai), bi)
    si = number.gather(number.gather(si, ar, bi), ai, br)
    return sr, si


def gather_real(s, a, x):
    """``s + a x`` with a real number; words of ``s`` and of the result may overlap."""
    sr, si = s
    ar, ai = a
    return number.gather(sr, ar, x), number.gather(si, ai, x)


def gathered(s):
    """The number whose words overlap."""
    sr, si = s
    return number.gathered(sr), number.gathered(si)


def scale(a, power):
    """``a`` times lanes that hold powers of two."""
    re, im = a
    return number.scale(re, power), number.scale(im, power)


def choose(a, b, x, y):
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
    xr, xi = x
    yr, yi = y
    return number.choose(a, b, xr, yr), number.choose(a, b, xi, yi)


def inverse(a):
    """``1 / a`` by Newton's method from the inverse in doubles."""
    re, im = rounded(a)
    power = select_less(fma(re, re, im * im), splat(SMALL_SQUARE), splat(LARGER), splat(1.0))
    re = re * power
    im = im * power
    size = power / fma(re, re, im * im)
    one = exact(splat(1.0), splat(0.0))
    result = exact(re * size, splat(0.0) - im * size)
    digits = 1
    while digits < number.WORDS:
        rest = add(one, negative(multiply(a, result)))
        result = add(result, multiply(result, rest))
        digits = digits + digits
    return result


def magnitude(a):
    """Absolute value as a double."""
    re, im = rounded(a)
    return length(re, im)


def length(re, im):
    """Absolute value of doubles, however small they are."""
    square = fma(re, re, im * im)
    larger, other = re * splat(LARGER), im * splat(LARGER)
    root = square_root(fma(larger, larger, other * other)) / splat(LARGER)
    return select_less(square, splat(SMALL_SQUARE), root, square_root(square))


def largest(a, b):
    """The larger of two doubles in each lane."""
    return select_less(a, b, b, a)


def stretch(a, x):
    """``a`` times a real number."""
    re, im = a
    return number.multiply(re, x), number.multiply(im, x)


def exponential(a, inverses):
    """``exp(a)`` for ``|a|`` up to 64.

    Args:
        inverses: the numbers ``1 / k``, the same in all lanes, in memory.
    """
    one = exact(splat(1.0), splat(0.0))
    small = scale(a, splat(HALVED))
    # s = exp(..) - 1, of which doubling the argument makes 2 s + s^2, keeps its small digits;
    # where exp(..) itself becomes small, squares do.
    s = small
    for k in range(number.TERMS, 1, -1):
        s = gathered(gather(small, small, stretch(s, number.same(inverses, k))))
    for _k in range(HALVINGS - SQUARINGS):
        s = gathered(gather(scale(s, splat(2.0)), s, s))
    result = add(one, s)
    for _k in range(SQUARINGS):
        result = multiply(result, result)
    return result
