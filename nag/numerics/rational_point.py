"""Rational coordinates recognised in numbers of many digits."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import flint

from nag.numerics.digits import log_size


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
