"""Values in balls are those of the polynomials, to all digits that are asked for."""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np

from nag.algebra.expression import parse_polynomial
from nag.algebra.high_precision import BallValues

NAMES = ("x", "y", "z")
TEXTS = ("x^3*y - 2/7*z + 5", "y^2*z^2 - x", "3", "0", "x*y*z - 1/3*x*y + 11*z^4")


def rational(c: Fraction) -> flint.arb:
    return flint.arb(flint.fmpq(c.numerator, c.denominator))


def test_values_and_sizes_of_terms_are_exact_to_the_last_digits() -> None:
    polynomials = [parse_polynomial(text, NAMES) for text in TEXTS]
    values = BallValues(polynomials)
    rng = np.random.default_rng(0)
    for digits in (20, 200):
        with flint.ctx.workdps(digits + 5):
            for _ in range(3):
                point = [Fraction(int(k), 13) for k in rng.integers(-99, 99, 3)]
                found = values.at([flint.acb(rational(x)) for x in point])
                sizes = values.sizes_at([abs(rational(x)) for x in point])
                for f, value, size in zip(polynomials, found, sizes, strict=True):
                    expected = f(point)
                    terms = f([abs(x) for x in point], abs)
                    assert value.imag.contains(0) and value.real.contains(rational(expected))
                    assert size.contains(rational(terms))
                    assert size.rad() <= float(1 + terms) * flint.arb(10) ** -digits
