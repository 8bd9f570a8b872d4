"""Values and slopes in balls hold the exact ones, to nearly all the bits that are asked for."""

from __future__ import annotations

from fractions import Fraction
from math import prod

import flint
import numpy as np
import pytest

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of

NAMES = ("x", "y", "z")
TEXTS = ("x^3*y*z^2 - 2/7*z + 5", "y^2*z^2 - x + x^4", "3", "0", "x*y*z - 1/3*x*y + 11*z^4", "y")
SLICES = np.array([[1.5, 0, -2.25j, 3], [0, 1j, 0, 0]])
POLYNOMIALS = [parse_polynomial(text, NAMES) for text in TEXTS]


def to_many_digits(c: Fraction) -> flint.arb:
    with flint.ctx.workprec(4096):
        return flint.arb(flint.fmpq(c.numerator, c.denominator))


@pytest.mark.parametrize("bits", [64, 128, 512])
def test_values_and_slopes_hold_the_exact_ones(bits: int) -> None:
    system, rng = BallPolynomials.of(POLYNOMIALS, SLICES), np.random.default_rng(0)
    with flint.ctx.workprec(bits):
        for _ in range(3):
            point = [Fraction(int(k), 13) for k in rng.integers(-99, 99, 3)]
            at = [flint.acb(flint.arb(x.numerator) / x.denominator) for x in point]
            values, slopes = system.values(at, bits).entries(), system.jacobian(at, bits).tolist()
            for f, value, row in zip(POLYNOMIALS, values, slopes, strict=False):
                assert value.real.contains(to_many_digits(f(point)))
                for i, slope in enumerate(row):
                    assert slope.imag.contains(0)
                    assert slope.real.contains(to_many_digits(f.derivative(i)(point)))
                    assert slope.real.rad() < flint.arb(2) ** (40 - bits)
            for line, value, row in zip(SLICES, values[6:], slopes[6:], strict=True):
                there = [complex(c) for c in line]
                parts = [flint.acb(c) * z for c, z in zip(there[1:], at, strict=True)]
                assert value.overlaps(sum(parts, flint.acb(there[0])))
                assert row == [flint.acb(c) for c in there[1:]]


def test_the_same_polynomials_are_evaluated_to_the_bits_of_each_time() -> None:
    system, x = BallPolynomials.of(POLYNOMIALS[:1], SLICES[:0]), [flint.acb(3)] * 3
    for bits in (64, 512, 64):
        for ball in (system.values(x, bits)[0, 0], system.jacobian(x, bits)[0, 2]):
            assert 2.0 ** -(bits + 4) < float(ball.real.rad()) < 2.0 ** (16 - bits)


def test_terms_that_cancel_leave_what_is_beside_them_however_small() -> None:
    tiny = parse_polynomial("x^2 - y^2 + 1/2^900", NAMES)
    value = BallPolynomials.of([tiny]).values([flint.acb(3)] * 3, 128)[0, 0]
    assert value == flint.acb(2) ** -900


def test_slopes_on_a_box_hold_those_at_its_points() -> None:
    system, rng = BallPolynomials.of(POLYNOMIALS, SLICES), np.random.default_rng(1)
    centre, radius = rng.standard_normal(3) + 1j * rng.standard_normal(3), 2.0**-4
    disc = flint.acb(flint.arb(0, radius), flint.arb(0, radius))
    on_box = system.jacobian([flint.acb(complex(z)) + disc for z in centre], 53).entries()
    for _ in range(20):
        off = rng.uniform(-radius, radius, 3) + 1j * rng.uniform(-radius, radius, 3)
        at = system.jacobian([flint.acb(complex(z)) for z in centre + off], 53).entries()
        assert all(box.contains(slope) for box, slope in zip(on_box, at, strict=True))


@pytest.mark.parametrize("digits", [20, 200])
def test_sizes_of_terms_are_right_to_the_last_digits(digits: int) -> None:
    system, rng = BallPolynomials.of(POLYNOMIALS), np.random.default_rng(0)
    with flint.ctx.workdps(digits + 5):
        point = [Fraction(int(k), 13) for k in rng.integers(-99, 99, 3)]
        at = [flint.acb(flint.arb(x.numerator) / x.denominator) for x in point]
    for f, size in zip(POLYNOMIALS, system.sizes(at, bits_of(digits + 5)), strict=True):
        terms = f([abs(x) for x in point], abs)
        assert size.contains(to_many_digits(terms))
        assert size.rad() <= float(1 + terms) * flint.arb(10) ** -digits


def test_rows_of_many_terms_hold_exact_values_and_slopes_and_sizes() -> None:
    # (1 + 2 x - y/3 ..)(.. ) in six variables: 3^6 terms, two more rows beside it.
    n = 6
    x = Polynomial.variables(n)
    many = prod(
        (a * a * (i + 1) - a * Fraction(2, 7) + 3 for i, a in enumerate(x)), start=1 + 0 * x[0]
    )
    few, rng = x[0] * x[5] - 1, np.random.default_rng(3)
    system = BallPolynomials.of([few, many, few + many])
    point = [Fraction(int(k), 13) for k in rng.integers(-40, 40, n)]
    for bits in (64, 300):
        with flint.ctx.workprec(bits):
            at = [flint.acb(flint.arb(c.numerator) / c.denominator) for c in point]
            slopes, sizes = system.jacobian(at, bits).tolist(), system.sizes(at, bits)
            values = system.values(at, bits).entries()
            assert str(system.rows_of([1]).values(at, bits)[0, 0]) == str(values[1])
        for f, value, row, size in zip((few, many, few + many), values, slopes, sizes, strict=True):
            assert value.real.contains(to_many_digits(f(point)))
            assert value.real.rad() < flint.arb(2) ** (60 - bits)
            assert size.contains(to_many_digits(f([abs(c) for c in point], abs)))
            for i, slope in enumerate(row):
                assert slope.real.contains(to_many_digits(f.derivative(i)(point)))
                assert slope.real.rad() < flint.arb(2) ** (60 - bits)


def test_a_row_more_leaves_those_above_as_they_are() -> None:
    x = [flint.acb(3, 1), flint.acb(-2), flint.acb(1, 7)]
    whole, above = BallPolynomials.of(POLYNOMIALS, SLICES), BallPolynomials.of(POLYNOMIALS)
    assert whole.above is above and len(whole) == len(above) + len(SLICES)
    values = list(map(str, whole.values(x, 90).entries()))
    assert values[: len(above)] == list(map(str, above.values(x, 90).entries()))
    chosen = whole.rows_of([0, 7]).values(x, 90).entries()
    assert list(map(str, chosen)) == [values[0], values[7]]
