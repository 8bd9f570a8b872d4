"""Cosines of rational turns are residues that satisfy what the cosines do, in every image."""

from __future__ import annotations

import pytest

from nag.algebra.cyclotomic import MOST_DEGREE, CosineField, field_of_cosines
from nag.algebra.expression import parse_number


def numbers(*texts: str) -> list:
    return [parse_number(text) for text in texts]


@pytest.mark.parametrize(
    ("texts", "order", "degree"),
    [
        (["cos(pi/7)"], 14, 3),
        (["cos(2*pi/7)", "sin(2*pi/7)"], 28, 6),
        (["3*cos(pi/9)/2 - 1"], 18, 3),
        (["sin(pi/5)"], 20, 4),
        (["cos(pi/8)", "sqrt(2)"], 16, 4),
        (["sin(pi/7)", "sqrt(7)"], 28, 6),
    ],
)
def test_the_least_field_is_found(texts: list[str], order: int, degree: int) -> None:
    field = field_of_cosines(numbers(*texts))
    assert field is not None
    assert (field.order, field.degree) == (order, degree)
    assert len(field.basis) == degree


@pytest.mark.parametrize("text", ["cos(1)", "pi", "sqrt(2 + cos(pi/7))", "cos(pi/101)"])
def test_other_numbers_and_large_fields_have_none(text: str) -> None:
    assert field_of_cosines(numbers(text)) is None
    assert CosineField(202).degree > MOST_DEGREE


@pytest.mark.parametrize("order", [28, 36, 20, 16, 56])
def test_relations_of_cosines_hold_in_every_image(order: int) -> None:
    field = CosineField(order)
    primes = field.fields(2)
    assert len(primes) == 2
    for image in (image for prime in primes for image in field.conjugates(prime)):
        p = image.modulus
        for j in range(1, 5):
            angle = f"{2 * j}*pi/{order}"
            once, twice = map(image.of, numbers(f"cos({angle})", f"cos(2*{angle})"))
            assert (2 * once * once - 1 - twice) % p == 0
            if order % 4 == 0:
                (sine,) = map(image.of, numbers(f"sin({angle})"))
                assert (once * once + sine * sine - 1) % p == 0


@pytest.mark.parametrize(("order", "square"), [(28, 7), (20, 5), (16, 2), (24, 3), (26, 13)])
def test_square_roots_are_sums_of_cosines_in_every_image(order: int, square: int) -> None:
    field = CosineField(order)
    (prime,) = field.fields(1)
    roots = [image.root(square) for image in field.conjugates(prime)]
    assert all(r * r % prime.modulus == square for r in roots)
    # Half of the conjugates change the sign.
    assert len(set(roots)) == 2


@pytest.mark.parametrize("order", [14, 18, 16, 20, 28])
def test_the_basis_is_one(order: int) -> None:
    field = CosineField(order)
    (prime,) = field.fields(1)
    images = field.conjugates(prime)
    rows = [[image.of(c) for c in field.basis] for image in images]
    assert prime.rank(rows) == field.degree == len(images)


def test_a_number_outside_the_field_has_no_image() -> None:
    (prime,) = CosineField(14).fields(1)
    for number in numbers("cos(pi/9)", "cos(1)"):
        with pytest.raises(ArithmeticError):
            prime.of(number)
