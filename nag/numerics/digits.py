"""Complex numbers of many digits: FLINT's balls by their midpoints; rationals among them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from fractions import Fraction
from math import inf, log10, nextafter

import flint
import numpy as np

from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import Number, Surd, binary
from nag.numerics.doubles import LARGEST, SMALLEST

# Decimal logarithm of 2.
LOG10_2 = 0.30102999566398120


# Bits in which products with powers of two are exact.
EXACT = 1 << 20


def bits_of(digits: float) -> int:
    """Bits of numbers with so many decimal digits."""
    return round((digits + 1) / LOG10_2)


def written_error(digits: int) -> float:
    """Relative error of a number known by so many written digits, of which half `SPARE` are not."""
    return 10.0 ** (SPARE / 2 - digits)


# Digits in which singular points are judged, and what vanishes at zeros of a hundred digits.
DIGITS = 150
BITS = bits_of(DIGITS)
# Digits that rounding may have taken of a number that little was done with.
ROUNDING = 5.0
# Decides: Digits that computing may take: in so many of a hundred two points may differ that are
# one, and coefficients as small are zero.
SPARE = 20
# Doubles that a number known beyond doubles is the sum of, where paths start from it.
WORDS = 4


def in_bits(bits: int) -> AbstractContextManager[object]:
    """A context in which FLINT's numbers have so many bits: it has no other way to be told."""
    return flint.ctx.workprec(bits)


def working_digits(digits: int) -> AbstractContextManager[object]:
    """A context in which arithmetic has so many decimal digits."""
    return in_bits(bits_of(digits))


def to_ball(c: Number | complex | int | flint.acb) -> flint.acb:
    """``c`` at the working precision; doubles are exact."""
    if isinstance(c, flint.acb):
        return c
    if isinstance(c, Fraction):
        return flint.acb(to_rational(c))
    if isinstance(c, int | float | complex | np.number):
        return flint.acb(complex(c)) if not isinstance(c, int) else flint.acb(c)
    if isinstance(c, Surd):
        return flint.acb(c.ball(flint.ctx.prec))
    mantissa, exponent = binary(c, flint.ctx.dps + 5)
    return flint.acb(flint.arb(mantissa) * flint.arb(2) ** exponent)


def to_point(x: Iterable[complex | flint.acb]) -> list[flint.acb]:
    """A point of exact doubles, or the middles of balls."""
    return [middle(to_ball(v)) for v in x]


def real_of_words(words: np.ndarray) -> flint.arb:
    """A sum of doubles, exactly."""
    with in_bits(EXACT):
        return sum(map(flint.arb, words.tolist()), flint.arb(0))


def number_of_words(words: np.ndarray) -> flint.acb:
    """A complex number from sums of doubles, shape ``(2, words)``, exactly."""
    return flint.acb(real_of_words(words[0]), real_of_words(words[1]))


def words_of_number(z: flint.acb, count: int) -> np.ndarray:
    """Real and imaginary part as sums of so many doubles, the largest first, ``(2, count)``."""
    words = np.zeros((2, count))
    with in_bits(EXACT):
        for k, rest in enumerate((z.real.mid(), z.imag.mid())):
            for i in range(count):
                words[k, i] = float(rest)
                rest = (rest - words[k, i]).mid()
    return words


def middle(z: flint.acb) -> flint.acb:
    """The midpoint of a ball, as an exact number."""
    return z.mid()


def times_power_of_two(z: flint.acb, k: int) -> flint.acb:
    """``2^k z``, which rounds nothing."""
    with in_bits(EXACT):
        return z * flint.arb(2) ** k


def change_units(
    x: Sequence[flint.acb], scales: Sequence[Number], origin: Sequence[Number], bits: int
) -> list[flint.acb]:
    """``scales x + origin`` in each coordinate."""
    with in_bits(bits):
        triples = zip(x, scales, origin, strict=True)
        return [z * to_ball(scale) + to_ball(b) for z, scale, b in triples]


def log_size(z: flint.acb | int) -> float:
    """The decimal logarithm of ``|z|`` to within a factor of three; also beyond doubles' range.

    It is ``inf`` where nothing is known of z, as of a quotient by what may be zero.
    """
    if isinstance(z, int):
        return LOG10_2 * z.bit_length() if z else -np.inf
    try:
        size = abs(complex(z))
    except OverflowError:
        size = np.inf
    if SMALLEST < size < LARGEST:
        return log10(size)
    if not z:
        return -np.inf
    if not z.is_finite():
        return np.inf
    mantissa, exponent = z.mid().abs_upper().man_exp()
    return LOG10_2 * (mantissa.bit_length() + int(exponent)) if mantissa else -np.inf


def log_norm(values: Iterable[flint.acb]) -> float:
    """The decimal logarithm of the largest absolute value, roughly; ``-inf`` if there is none."""
    values = list(values)
    try:
        sizes = [abs(complex(z)) for z in values]
    except OverflowError:
        return max(map(log_size, values))
    # Where nothing is out of doubles' range, one logarithm says it.
    top = max(sizes, default=0.0)
    if top > SMALLEST and sum(sizes) < LARGEST:
        return log10(top)
    return max(map(log_size, values), default=-np.inf)


def doubles(x: Sequence[flint.acb]) -> np.ndarray:
    """The point rounded, shape ``(n,)``."""
    return np.array([complex(v) for v in x], dtype=complex)


def round_up(value: flint.arb) -> float:
    """A double that is no less."""
    return nextafter(float(value.upper()), inf)


def rational(z: flint.acb, digits: int) -> Fraction | None:
    """The simplest rational number next to ``z``, if its size shows that it is no accident.

    A number of so many digits has rational approximations whose numerator and denominator have
    half as many digits each; one that has less than a third of them is not there by chance.
    """
    if log_size(z.imag if isinstance(z.imag, flint.acb) else flint.acb(z.imag)) > -0.8 * digits:
        return None
    mantissa, exponent = z.real.mid().man_exp()
    value = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    found = value.limit_denominator(10 ** (digits // 3))
    return found if abs(found - value) < Fraction(1, 10 ** (4 * digits // 5)) else None


def rational_point(point: Sequence[flint.acb], digits: int) -> list[Fraction] | None:
    """All coordinates as rational numbers, or None."""
    found = [rational(z, digits) for z in point]
    return None if None in found else [q for q in found if q is not None]
