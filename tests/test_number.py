"""Laws of exact and irrational numbers."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.expression import parse_number
from nag.algebra.number import (
    PI,
    Irrational,
    cosine,
    is_zero,
    number_text,
    sine,
    square_root,
    to_mpf,
)

fractions = st.fractions(min_value=-50, max_value=50, max_denominator=30)
radicands = st.fractions(min_value=0, max_value=50, max_denominator=30)
numbers = st.one_of(
    fractions,
    st.builds(lambda q, r: q * square_root(r), fractions, radicands),
    st.builds(lambda p, q, r: p + q * square_root(r), fractions, fractions, radicands),
    st.builds(lambda q: q * PI, fractions),
)


@given(radicands)
def test_square_root_squares_back_exactly(r):
    square = square_root(r) ** 2
    assert isinstance(square, Fraction) and square == r


@given(fractions)
def test_square_root_of_a_square_is_rational(q):
    assert square_root(q * q) == abs(q)
    assert isinstance(square_root(q * q), Fraction)


@given(radicands, radicands)
def test_products_of_square_roots_are_square_roots_of_products(r, s):
    assert square_root(r) * square_root(s) == square_root(r * s)


@given(numbers, numbers, numbers)
def test_field_laws(a, b, c):
    assert a * (b + c) == a * b + a * c
    assert a + b == b + a
    assert a - a == 0
    if not is_zero(b):
        assert a / b * b == a


@given(numbers, numbers)
def test_order_is_that_of_the_values(a, b):
    if a == b:
        assert not a < b and not a > b and a <= b and a >= b
        assert hash(a) == hash(b)
    else:
        assert (a < b) == (to_mpf(a, 40) < to_mpf(b, 40))
        assert (a < b) != (a > b)
        assert (a <= b) == (a < b)


@given(numbers)
def test_text_reads_back_to_an_equal_number(a):
    assert parse_number(number_text(a)) == a


@given(numbers)
def test_pickling_keeps_the_number(a):
    assert pickle.loads(pickle.dumps(a)) == a


def test_evaluation_has_the_digits_that_were_asked_for():
    value = (square_root(2) + PI) / 3
    with mpmath.workdps(320):
        error = abs(value.evaluate(300) - (mpmath.sqrt(2) + mpmath.pi) / 3)
    assert error < mpmath.mpf(10) ** -299


def test_cancellation_costs_no_digits():
    near = Fraction(math.isqrt(2 * 10**60), 10**30)
    difference = square_root(2) - near
    with mpmath.workdps(150):
        expected = mpmath.sqrt(2) - mpmath.mpf(near.numerator) / near.denominator
        assert abs(to_mpf(difference, 50) / expected - 1) < mpmath.mpf(10) ** -49
    assert not is_zero(difference) and difference > 0


def test_small_numbers_are_not_zero():
    assert not is_zero(square_root(2) / 10**90)


def test_identities_between_sums_are_recognised():
    assert is_zero(square_root(2) + square_root(3) - square_root(5 + 2 * square_root(6)))
    assert (1 + square_root(2)) * (1 - square_root(2)) == -1
    assert hash((1 + square_root(2)) * (1 - square_root(2))) == hash(-1)


@pytest.mark.parametrize("k", range(-24, 49))
def test_sine_and_cosine_at_multiples_of_a_twelfth_of_pi(k):
    angle = Fraction(k, 12) * PI
    with mpmath.workdps(70):
        turn = mpmath.mpf(k) / 12
        assert abs(to_mpf(sine(angle), 50) - mpmath.sinpi(turn)) < mpmath.mpf(10) ** -49
        assert abs(to_mpf(cosine(angle), 50) - mpmath.cospi(turn)) < mpmath.mpf(10) ** -49
    assert sine(angle) ** 2 + cosine(angle) ** 2 == 1


def test_special_angles_are_exact():
    assert sine(PI / 6) == Fraction(1, 2) and isinstance(sine(PI / 6), Fraction)
    assert cosine(2 * PI / 3) == Fraction(-1, 2)
    assert isinstance(cosine(PI / 2), Fraction)
    assert 2 * cosine(PI / 6) == square_root(3)
    assert sine(PI / 4) ** 2 == Fraction(1, 2)
    assert sine(Fraction(0)) == 0 and cosine(Fraction(0)) == 1


def test_zero_has_no_inverse_however_it_is_written():
    hidden = Irrational("+", (square_root(2), -square_root(2)))
    with pytest.raises(ZeroDivisionError):
        1 / hidden
    with pytest.raises(ZeroDivisionError):
        square_root(2) / hidden
    with pytest.raises(ZeroDivisionError):
        square_root(2) / 0


def test_negative_radicands_are_refused():
    with pytest.raises(ValueError, match="negative"):
        square_root(-1)
    with pytest.raises(ValueError, match="negative"):
        square_root(1 - square_root(2))
