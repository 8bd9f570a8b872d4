"""Laws of sums of square roots."""

from __future__ import annotations

import pickle
from fractions import Fraction

import flint
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from nag.algebra.exact_ranks import fields_with_roots
from nag.algebra.expression import parse_number, parse_polynomial
from nag.algebra.number import Irrational, is_zero, number_text, square_root
from nag.algebra.polynomial import Polynomial
from nag.algebra.surd import Surd, split_square

BITS = 200

fractions = st.fractions(min_value=-50, max_value=50, max_denominator=30)
radicands = st.sampled_from([1, 2, 3, 5, 6, 7, 10, 12, 15, 21, Fraction(1, 2), Fraction(3, 4)])
sums = st.lists(st.tuples(fractions, radicands), max_size=4).map(
    lambda terms: sum((q * square_root(r) for q, r in terms), Fraction(0))
)
surds = sums.filter(lambda a: isinstance(a, Surd))


def ball(a):
    with flint.ctx.workprec(BITS):
        return a.ball(BITS) if isinstance(a, Surd) else flint.arb(flint.fmpq(*a.as_integer_ratio()))


@given(sums, sums)
def test_sums_and_products_are_those_of_the_values(a, b):
    with flint.ctx.workprec(BITS):
        assert ball(a + b).overlaps(ball(a) + ball(b))
        assert ball(a - b).overlaps(ball(a) - ball(b))
        assert ball(a * b).overlaps(ball(a) * ball(b))
        if b:
            assert ball(a / b).overlaps(ball(a) / ball(b))


@given(sums, sums, sums)
def test_laws_of_a_field_hold_exactly(a, b, c):
    nothing = a * (b + c) - a * b - c * a
    assert isinstance(nothing, Fraction) and nothing == 0
    assert (a * b) * c == a * (b * c) and a + b == b + a and a - a == 0
    if b:
        assert a / b * b == a and b * (1 / b) == 1
    assert a**3 == a * a * a


@given(surds)
def test_what_is_not_zero_is_told_from_zero(a):
    with flint.ctx.workprec(BITS):
        assert not ball(a).contains(0)
    assert a != 0 and not is_zero(a) and a != Fraction(1, 3)


@given(surds, st.integers(100, 400))
def test_a_fraction_next_to_a_sum_is_another_number(a, bits):
    mantissa, exponent = a.binary(bits)
    near = mantissa * Fraction(2) ** exponent
    assert a != near and (a < near) != (a > near) and not is_zero(a - near)


def test_identities_between_roots_are_exact():
    two, three, six = map(square_root, (2, 3, 6))
    assert two * three == six
    assert (two + three) ** 2 == 5 + 2 * six
    assert isinstance((two + three) ** 2 - 2 * six, Fraction)
    assert isinstance(two + three - square_root(5 + 2 * six), Fraction)
    assert square_root(2 + three) == (square_root(6) + two) / 2
    assert square_root(square_root(Fraction(9, 4)) - Fraction(1, 2)) == 1


@given(surds)
def test_the_root_of_a_square_of_a_sum_is_a_sum(a):
    assume(len(a.terms) <= 3)
    root = square_root(a * a)
    assert root == abs(a) and not isinstance(root, Irrational)


@given(st.integers(1, 10**40))
def test_squares_are_split_off(n):
    found = split_square(n)
    if found is not None:
        a, r = found
        assert a * a * r == n
        assert all(k == 1 for _, k in flint.fmpz(r).factor())


def test_radicands_whose_factors_are_out_of_reach_stay_expressions():
    far = (10**25 + 13) * (10**26 + 67)
    root = square_root(far)
    assert isinstance(root, Irrational) and root * root == far


@given(sums)
def test_text_reads_back_to_the_same_sum(a):
    assert parse_number(number_text(a)) == a


@pytest.mark.parametrize("text", ["sqrt(3)/2", "-sqrt(3)/2", "5*sqrt(6)/7", "sqrt(2)"])
def test_one_root_is_written_as_it_was(text):
    assert number_text(parse_number(text)) == text


@given(sums, sums)
def test_order_is_that_of_the_values(a, b):
    with flint.ctx.workprec(BITS):
        assert (a < b) == (ball(a) < ball(b)) and (a > b) == (ball(a) > ball(b))
    assert (a <= b) == (a < b or a == b)


@given(sums)
def test_pickling_keeps_the_sum(a):
    assert pickle.loads(pickle.dumps(a)) == a


@given(sums)
def test_a_hidden_equal_number_is_equal_and_hashes_alike(a):
    hidden = Irrational("+", (a, Irrational("+", (square_root(5), -square_root(5)))))
    assert hidden == a and hash(hidden) == hash(a)


@given(sums, sums)
def test_images_modulo_a_prime_are_those_of_sums_and_products(a, b):
    for field in fields_with_roots(frozenset({2, 3, 5, 7})):
        assert field.is_zero(field.of(a) + field.of(b) - field.of(a + b))
        assert field.is_zero(field.of(a) * field.of(b) - field.of(a * b))
        assert field.is_zero(field.of(a)) == is_zero(a)


coefficients = st.dictionaries(st.tuples(*[st.integers(0, 3)] * 2), sums, min_size=1, max_size=6)


@given(coefficients, coefficients, sums, fractions)
def test_products_of_polynomials_have_the_products_of_their_values(f, g, x, y):
    f, g = Polynomial(2, f), Polynomial(2, g)
    assert (f * g)((x, y)) == f((x, y)) * g((x, y))
    assert parse_polynomial(f.text(("x", "y")), ("x", "y")) == f


@given(st.integers(1, 10**6), st.integers(1, 10**6), st.integers(0, 400))
def test_many_equal_factors_are_divided_out_at_once(a: int, b: int, k: int) -> None:
    found = split_square(a * 10**k)
    alone = split_square(a * 10 ** (k % 2))
    assert found is not None and alone is not None
    assert found == (alone[0] * 10 ** (k // 2), alone[1])


def test_long_numbers_are_not_proved_to_be_prime() -> None:
    assert split_square(5 * 10**20000 + 10**3) is None
    assert split_square(5 * 10**20001) == (5 * 10**10000, 2)
