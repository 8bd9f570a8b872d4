"""Exact ideals: divisions, dimension and degree, intersections, quotients, irreducibility."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra import groebner
from nag.algebra.expression import parse_polynomial
from nag.algebra.groebner import (
    UnfinishedBasis,
    dimension_and_degree,
    divisor,
    ideal,
    ideal_of,
    intersection,
    quotient,
    remainder,
)
from nag.algebra.rational_function import FunctionField
from nag.check.bricard_variety import certainly_irreducible
from nag.check.rings import determinant, intersect_in, minors, smooth


def of(names: str, *equations: str):
    variables = tuple(names.split())
    return ideal_of([parse_polynomial(f, variables) for f in equations], variables)


@pytest.mark.parametrize(
    ("names", "equations", "dimension", "degree"),
    [
        ("x y z", ["y - x^2", "z - x^3"], 1, 3),
        ("x y", ["x^2 + y^2 - 1"], 1, 2),
        ("x y", ["x^2", "x*y"], 1, 1),
        ("x y", ["x^2", "y^3"], 0, 6),
        ("x y", ["x", "x - 1"], -1, 0),
        ("x y z", ["x*y", "x*z", "y*z"], 1, 3),
        ("x y z", ["0"], 3, 1),
        ("x y z w", ["x*z - y^2", "y*w - z^2", "x*w - y*z"], 2, 3),
    ],
)
def test_dimension_and_degree_of_known_ideals(names, equations, dimension, degree) -> None:
    found = of(names, *equations)
    assert (found.dimension, found.degree) == (dimension, degree)


exponents = st.tuples(*[st.integers(0, 3)] * 3)


@given(st.lists(exponents, min_size=1, max_size=5))
def test_the_hilbert_series_counts_the_monomials_outside(monomials) -> None:
    dimension, degree = dimension_and_degree(monomials, 3)

    def outside(d: int) -> int:
        points = (e for e in product(range(d + 1), repeat=3) if sum(e) <= d)
        return sum(
            not any(all(a <= b for a, b in zip(f, e, strict=True)) for f in monomials)
            for e in points
        )

    if dimension < 0:
        assert outside(3) == 0
        return
    # Beyond degree 9 the count is a polynomial with leading term degree d^dimension/dimension!.
    values = [outside(d) for d in range(10, 11 + dimension)]
    difference = sum((-1) ** (dimension - i) * comb(dimension, i) * v for i, v in enumerate(values))
    assert difference == degree > 0


def test_division_keeps_parameters_and_says_what_is_in_the_ideal() -> None:
    field = FunctionField("x y m")
    x, y, m = field.variables
    basis = [divisor(f.numerator, 2) for f in (m * x - y, (m + 1) * y**2 - 1)]
    inside = (m * x - y) * (x + 3) + ((m + 1) * y**2 - 1) * (m + y)
    assert remainder(inside.numerator, basis, 2) == 0
    rest = remainder((inside + 1).numerator, basis, 2)
    assert rest != 0 and rest.degrees()[:2] == (0, 0)


def test_intersection_and_quotient_of_two_lines() -> None:
    axes = of("x y", "x*y")
    assert intersection(of("x y", "x"), of("x y", "y")) == axes
    x = axes.field.context.gens()[0]
    assert quotient(axes, x) == of("x y", "y")
    assert axes != of("x y", "x")


def test_ideals_without_common_zeros_intersect_in_their_product() -> None:
    parts = [of("x y", f"x - {k}", "y^2 - 2") for k in range(4)]
    whole = of("x y", "x*(x - 1)*(x - 2)*(x - 3)", "y^2 - 2")
    assert intersect_in(whole, parts)
    assert not intersect_in(whole, parts[:3])
    assert not intersect_in(whole, [*parts, parts[0]])


def test_a_basis_that_grows_too_large_is_given_up(monkeypatch) -> None:
    monkeypatch.setattr(groebner, "BOUNDS", (3, 5, 10))
    with pytest.raises(UnfinishedBasis, match="3 polynomials grows too large"):
        of("x y z", "x^3 + y^2*z - 7", "y^3 + z^2*x - 5", "z^3 + x^2*y - 3")


@pytest.mark.parametrize(
    ("names", "equations", "irreducible"),
    [
        ("x y", ["x^2 + y^2 - 1"], True),
        ("x y", ["x^2 + y^2"], False),
        ("x y", ["x^2 - 2*y^2"], False),
        ("x y z", ["y - x^2", "z - x^3"], True),
        ("x y z", ["x^2 + y^2 - 1", "z^2 - 2"], False),
        ("x y z", ["x^2 + y^2 - z^2 - 1"], True),
        ("x y z", ["(x + y + z - 1)^2"], False),
        ("x y z", ["x*(z - 1)", "x*(y - 1)", "x*(x - 1)"], True),
    ],
)
def test_irreducibility_over_the_complex_numbers(names, equations, irreducible) -> None:
    """Of the components of highest dimension: the last one is a plane with a point apart."""
    assert certainly_irreducible(of(names, *equations)) is irreducible


numbers = st.builds(Fraction, st.integers(-9, 9), st.integers(1, 5))


@given(numbers, numbers)
def test_rational_functions_compute_like_their_values(a, b) -> None:
    field = FunctionField("x y")
    x, y = field.variables
    at = {"x": a, "y": b}
    f = (x**2 - y**2) / (x - y) + Fraction(1, 3) - y * 2
    assert f.denominator.is_constant()
    assert f.at(at) == a + b + Fraction(1, 3) - 2 * b
    if a:
        assert (y / x**2).at(at) == (1 / (x**2 / (y + 1)) - x**-2).at(at) == b / a**2
    assert (x + 1) * (x - 1) - x**2 == -1
    assert 1 - x != x - 1 and not x - x


def test_functions_of_different_fields_and_zero_divisors_are_refused() -> None:
    (x,), (y,) = FunctionField("x").variables, FunctionField("y").variables
    with pytest.raises(ValueError, match="different fields"):
        _ = x + y
    with pytest.raises(ZeroDivisionError):
        _ = 1 / (x - x)
    with pytest.raises(ZeroDivisionError):
        (1 / x).at({"x": Fraction(0)})


def test_minors_and_smoothness() -> None:
    assert determinant([[1, 2, 3], [4, 5, 6], [7, 8, 10]]) == -3
    assert len(list(minors([[1] * 6] * 4, 4))) == 15
    field = FunctionField("x y", "degrevlex")
    x, y = field.variables
    assert smooth(field, [x**2 + y**2 - 1], 1)
    assert not smooth(field, [y**2 - x**3], 1)
    assert ideal(field, []).contains([x.numerator]) is False
