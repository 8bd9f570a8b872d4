"""Factors over the rational numbers with square roots, and the branches that they make."""

from __future__ import annotations

from fractions import Fraction
from math import prod

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import nag
from nag.algebra.branches import branches
from nag.algebra.conjugate_factors import (
    common_factor_with_roots,
    exact_quotient,
    field_of_coefficients,
    find_norm,
    make_monic,
)
from nag.algebra.expression import parse_polynomial
from nag.algebra.factoring import common_factor, factor_into_irreducibles, most_absolute_factors
from nag.algebra.number import square_root
from nag.algebra.polynomial import Polynomial

VARIABLES = ["x", "y", "z"]


def of(text: str) -> Polynomial:
    return parse_polynomial(text, VARIABLES)


@pytest.mark.parametrize(
    "factors",
    [
        {"x - sqrt(3)": 2},
        {"x - sqrt(3)*y": 1, "y*z + x - sqrt(3)": 1},
        {"x^2 + sqrt(3)*y - 1": 2, "x^2 - sqrt(3)*y - 1": 1, "z + 1": 1},
        {"x - sqrt(3)*y": 1, "x + sqrt(3)*y": 1, "x + sqrt(3)*z": 1},
        {"x - sqrt(3)*y": 1, "x + sqrt(2)*y": 1, "x^2 + y^2 - sqrt(6)*z": 1},
        {"x^2 + y^2 - 1": 1, "x*y - sqrt(5)/7 + z^2": 3},
        {"x^3 + sqrt(3)*y^3 + z^3 + 5*sqrt(3)/11": 1, "x^3 - x*y*z + 12345/678": 1},
        {"x^2 - sqrt(6)*y^2": 1, "x^2 + 2*y^2": 1},
    ],
)
def test_products_of_irreducible_polynomials_are_taken_apart(factors: dict[str, int]) -> None:
    f = prod((of(text) ** k for text, k in factors.items()), start=of("1 + sqrt(3)"))
    found = factor_into_irreducibles(f)
    assert {make_monic(p): k for p, k in found} == {
        make_monic(of(t)): k for t, k in factors.items()
    }


@pytest.mark.parametrize(
    "text", ["x^2 - sqrt(3)", "x^2 + sqrt(3)*y^2 + z", "x^4 + y^4 + sqrt(2)*x"]
)
def test_irreducible_polynomials_stay_whole(text: str) -> None:
    assert factor_into_irreducibles(of(text)) == ((make_monic(of(text)), 1),)


def test_a_root_in_front_is_no_irrational_coefficient() -> None:
    f = of("x^2 - y^2")
    assert factor_into_irreducibles(f * square_root(3)) == factor_into_irreducibles(f)


coefficients = st.tuples(st.integers(-5, 5), st.integers(-3, 3)).map(
    lambda ab: Fraction(ab[0], 3) + ab[1] * square_root(2)
)
polynomials = st.dictionaries(st.tuples(*[st.integers(0, 2)] * 2), coefficients, max_size=4).map(
    lambda terms: Polynomial(2, terms)
)


@settings(deadline=None)
@given(polynomials, polynomials, polynomials)
def test_the_common_factor_divides_and_is_the_largest(
    f: Polynomial, g: Polynomial, h: Polynomial
) -> None:
    if not (f and g and h):
        return
    found = common_factor_with_roots([f * h, g * h])
    assert found is not None
    for multiple in (f * h, g * h):
        quotient = exact_quotient(multiple, found)
        assert quotient is not None and quotient * found == multiple
    assert exact_quotient(found, make_monic(h)) is not None


@settings(deadline=None)
@given(polynomials, polynomials)
def test_factors_multiply_to_the_polynomial(f: Polynomial, g: Polynomial) -> None:
    if (f * g).degree < 1:
        return
    product = Polynomial.constant(2, 1)
    for p, k in factor_into_irreducibles(f * g):
        product = product * p**k
    assert make_monic(product) == make_monic(f * g)


@given(polynomials, polynomials)
def test_norms_are_rational_and_multiply(f: Polynomial, g: Polynomial) -> None:
    field = field_of_coefficients([of("sqrt(2)*x")])
    norms = [find_norm(p, field) for p in (f, g, f * g)]
    assert norms[0] * norms[1] == norms[2] and norms[2].exact


def test_a_common_factor_with_roots_is_found() -> None:
    common = common_factor([of("(x - sqrt(3)*y)*(x + 1)"), of("(x - sqrt(3)*y)*(y - sqrt(2))")])
    assert common == of("x - sqrt(3)*y")
    assert common_factor([of("x - sqrt(3)*y"), of("x + sqrt(3)*y")]) is None


def test_factors_over_the_complex_numbers_are_counted_with_roots() -> None:
    rng = np.random.default_rng(0)
    assert most_absolute_factors(of("x^2 + sqrt(3)*y^2*z^2"), rng) == 2
    assert most_absolute_factors(of("x^2 + sqrt(3)*y^2 - z"), rng) == 1


def test_equations_with_roots_that_factor_have_branches() -> None:
    system = nag.system(["(x - sqrt(3)*y)*(x + z)", "x^2 - 3*y^2 - (x - sqrt(3)*y)*z"], "x y z")
    found = branches(system)
    assert found is not None
    # On x = sqrt(3) y the other equation is nothing; elsewhere it factors once more.
    planes = [b for b in found if len(b.polynomials) == 1]
    assert [b.polynomials for b in planes] == [(of("x - sqrt(3)*y"),)]
    answer = nag.decompose(system)
    assert [(c.dimension, c.degree) for c in answer.components] == [(2, 1), (1, 1)]
