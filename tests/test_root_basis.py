"""Sums of square roots and cosines of rational turns have one form each, and it is exact."""

from __future__ import annotations

from fractions import Fraction
from math import gcd, lcm

import flint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.exact_ranks import NumberField, row_echelon
from nag.algebra.expression import parse_number, parse_polynomial
from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import PI, Irrational, Number, cosine, number_text, sine, square_root
from nag.algebra.root_basis import (
    MOST_DEGREE,
    ball_of,
    cosine_of_turns,
    degree_of,
    generator,
    relation,
)
from nag.algebra.surd import Surd

# Parts of a turn whose cosines are of all kinds: towers, sines, cosines, square roots.
ORDERS = (5, 7, 9, 11, 13, 15, 16, 20, 21, 24, 28, 32, 36, 60, 72)
PARTS = (7, 9, 16, 20, 28)


def numbers(*texts: str) -> list[Number]:
    return [parse_number(text) for text in texts]


@st.composite
def sums(draw: st.DrawFn, orders: tuple[int, ...] = PARTS) -> Surd | Fraction:
    """Sums of some cosines of parts of a turn, of a root and of a rational number."""
    n = draw(st.sampled_from(orders))
    small = st.fractions(-3, 3, max_denominator=4)
    total: Surd | Fraction = draw(small) + draw(small) * square_root(
        draw(st.sampled_from([2, 3, 7]))
    )
    for _ in range(draw(st.integers(1, 2))):
        total = total + draw(small) * cosine(Fraction(2 * draw(st.integers(0, n)), n) * PI)
    return total


@pytest.mark.parametrize("n", ORDERS)
def test_cosines_and_sines_have_their_values(n: int) -> None:
    for k in range(n):
        turns = Fraction(k, n)
        with flint.ctx.workprec(200):
            angle = flint.fmpq(2 * k, n)
            values = flint.arb.cos_pi_fmpq(angle), flint.arb.sin_pi_fmpq(angle)
            for found, value in zip((cosine, sine), values, strict=True):
                own = found(2 * turns * PI)
                assert isinstance(own, Surd | Fraction)
                ball = own.ball(190) if isinstance(own, Surd) else to_rational(own)
                assert abs(value - ball) < flint.arb(2) ** -180


@pytest.mark.parametrize("order", [5, 7, 9, 11, 13, 16, 17, 25, 27, 29, 32, 49, 64])
def test_relations_of_generators_hold(order: int) -> None:
    with flint.ctx.workprec(300):
        total = ball_of(generator(order)) ** degree_of(order)
        for root, c in relation(order).items():
            total -= c * ball_of(root)
        assert total.contains(0)
        assert total.rad() < flint.arb(2) ** -150


@given(st.sampled_from(ORDERS), st.integers(-50, 50), st.integers(-50, 50))
def test_the_addition_theorem_is_exact(n: int, a: int, b: int) -> None:
    first, second = Fraction(2 * a, n) * PI, Fraction(2 * b, n) * PI
    assert cosine(first) * cosine(second) - sine(first) * sine(second) == cosine(first + second)
    assert sine(first) ** 2 + cosine(first) ** 2 == 1


def test_cosines_of_large_degree_stay_expressions() -> None:
    assert cosine_of_turns(Fraction(1, 101)) is None
    assert isinstance(cosine(Fraction(1, 101) * PI), Irrational)
    for n in range(1, 8 * MOST_DEGREE**2):
        both = lcm(4, n)
        degree = sum(1 for a in range(both) if gcd(a, both) == 1) / 2
        assert (cosine_of_turns(Fraction(1, n)) is None) == (degree > MOST_DEGREE)


@pytest.mark.parametrize(
    ("texts", "degree"),
    [
        (["1/2"], 1),
        (["cos(pi/7)"], 3),
        (["cos(2*pi/7)", "sin(2*pi/7)"], 6),
        (["sin(pi/7)", "sqrt(7)"], 6),
        (["3*cos(pi/9)/2 - 1"], 3),
        (["sin(pi/5)"], 4),
        (["sin(pi/5)", "sqrt(5)"], 4),
        (["cos(pi/8)", "sqrt(2)"], 4),
        (["cos(2*pi/13)"], 12),
        (["sqrt(6)"], 2),
        (["sqrt(6)", "sqrt(10)", "sqrt(15)"], 4),
        (["cos(pi/7)", "sqrt(21)"], 6),
    ],
)
def test_a_field_has_as_many_images_and_automorphisms_as_its_degree(
    texts: list[str], degree: int
) -> None:
    field = NumberField.of(numbers(*texts))
    assert field.degree == len(field.automorphisms()) == degree
    (prime,) = field.fields(1)
    images = field.conjugates(prime)
    # The basis is one: its images are independent.
    assert prime.rank([[image.of(c) for c in field.basis] for image in images]) == degree


@given(sums(), sums())
def test_images_modulo_a_prime_are_those_of_sums_and_products(
    a: Surd | Fraction, b: Surd | Fraction
) -> None:
    field = NumberField.of([a, b])
    (prime,) = field.fields(1)
    for image in field.conjugates(prime)[:: max(1, field.degree // 3)]:
        p = image.modulus
        assert image.of(a + b) == (image.of(a) + image.of(b)) % p
        assert image.of(a * b) == image.of(a) * image.of(b) % p


@given(sums((7, 9, 16, 20)), sums((7, 16)))
def test_automorphisms_keep_sums_and_products(a: Surd | Fraction, b: Surd | Fraction) -> None:
    for units in NumberField.of([a, b]).automorphisms()[:8]:
        first, second, total, product = (
            x.conjugate(units) if isinstance(x, Surd) else x for x in (a, b, a + b, a * b)
        )
        assert first + second == total
        assert first * second == product


@given(sums())
def test_what_is_not_zero_has_an_inverse(a: Surd | Fraction) -> None:
    if a:
        assert 1 / a * a == 1


@given(sums())
def test_text_reads_back_to_the_same_sum(a: Surd | Fraction) -> None:
    assert parse_number(str(a)) == a


@given(sums((7, 9, 16)))
def test_the_root_of_a_square_is_a_sum(a: Surd | Fraction) -> None:
    assert square_root(a * a) == abs(a)


@pytest.mark.parametrize(
    ("root", "same"),
    [
        ("sqrt(2 + sqrt(2))", "2*cos(pi/8)"),
        ("sqrt(2 + sqrt(2 + sqrt(2)))", "2*cos(pi/16)"),
        ("sqrt(10 - 2*sqrt(5))/4", "sin(pi/5)"),
        ("sqrt(2 - 2*cos(2*pi/7))", "2*sin(pi/7)"),
        ("sqrt(2 + 2*cos(2*pi/9))", "2*cos(pi/9)"),
    ],
)
def test_nested_roots_are_cosines(root: str, same: str) -> None:
    first, second = numbers(root, same)
    assert isinstance(first, Surd)
    assert first == second


def test_a_root_in_no_abelian_field_stays_an_expression() -> None:
    # A conjugate of each is negative, so that the root has one that is not real.
    for text in ("sqrt(1 + sqrt(2))", "sqrt(cos(2*pi/7))"):
        assert isinstance(parse_number(text), Irrational)


def test_one_cosine_is_written_as_one() -> None:
    assert str(parse_number("3*cos(pi/7)/2")) == "3*cos(pi/7)/2"
    assert str(parse_number("sin(pi/5)")) == "cos(3*pi/10)"


def test_a_matrix_loses_rank_where_its_determinant_is_zero_exactly() -> None:
    c, d = numbers("2*cos(2*pi/7)", "2*cos(4*pi/7)")
    assert len(row_echelon([[c, Fraction(1)], [c * c - 2, d / c]])[1]) == 1
    assert len(row_echelon([[c, Fraction(1)], [c * c - 2, 1 + d / c]])[1]) == 2


def test_polynomials_fall_apart_over_the_field_of_their_coefficients() -> None:
    f = parse_polynomial("(x - 2*cos(2*pi/7)*y)*(x^2 + y^2 - 2*cos(4*pi/7) - 3)", ["x", "y"])
    assert sorted(g.degree for g, _ in factor_into_irreducibles(f)) == [1, 2]
    # The quadric is one of two conjugate lines over the field of the cosines of ninths.
    g = parse_polynomial("x^2 - 4*cos(2*pi/9)^2*y^2", ["x", "y"])
    assert sorted(h.degree for h, _ in factor_into_irreducibles(g)) == [1, 1]


@given(sums((7, 16)), sums((11, 13)), sums((9, 5)))
def test_sums_in_no_common_small_field_are_expressions_with_the_same_value(
    a: Number, b: Number, c: Number
) -> None:
    for found, value in (
        (a + b, float(a) + float(b)),
        (a * b + c, float(a) * float(b) + float(c)),
        ((a - b) * c, (float(a) - float(b)) * float(c)),
    ):
        assert float(found) == pytest.approx(value, abs=1e-12)
        again = parse_number(number_text(found))
        assert again - found == 0
    assert (a + b) - b == a
    assert a * b == b * a
