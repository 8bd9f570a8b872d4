"""Bounds of the number of zeros by linear algebra modulo primes."""

import pytest

import nag
from nag.algebra.exact_ranks import fields_with_roots
from nag.algebra.zero_count import LARGEST, most_zeros

PRIMES = [field.modulus for field in fields_with_roots(frozenset(), LARGEST)]


@pytest.mark.parametrize("prime", PRIMES)
def test_a_zero_that_one_prime_brings_to_infinity_is_counted(prime: int) -> None:
    equations = nag.system([f"{prime}*x^2 + x - 1", "y - x"]).polynomials
    assert most_zeros(equations).bound == 2


def test_a_curve_that_a_prime_takes_away_is_no_finite_set() -> None:
    f = f"({PRIMES[0]}*x*y - 1)"
    equations = nag.system([f"{f}*x", f"{f}*(y + 1)"]).polynomials
    assert most_zeros(equations) is None


@pytest.mark.parametrize(
    ("equations", "count"),
    [
        (["x^3 + x*y^2 - 1 + z", "y^3 - x*z + 2", "z^3 - x*y*z + x - 5"], 27),
        (["x^2 - y", "x*y - 1"], 3),
        (["x^2", "x*y", "y^3"], 4),
        (["x*y - 1", "x + y - 2"], 2),
    ],
)
def test_zeros_are_counted_with_multiplicity(equations: list[str], count: int) -> None:
    assert most_zeros(nag.system(equations).polynomials) == (count, True)


@pytest.mark.parametrize(
    ("equations", "count"),
    [
        (["x^2 + sqrt(3)*y^2 - 1", "x*y - sqrt(2)/7"], 4),
        # Above one root of x^2 - 3 there are two zeros, above the other one.
        (["x^2 - 3", "(x - sqrt(3))*y", "y^2 - y"], 3),
    ],
)
def test_zeros_of_equations_with_square_roots_are_counted(equations: list[str], count: int) -> None:
    assert most_zeros(nag.system(equations).polynomials) == (count, True)
