"""Multiplicities that the factors of the equations show."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from systems import system

from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.generic_multiplicity import (
    generic_multiplicity,
    local_ideal,
    standard_monomials,
)
from nag.numerics.double_ranks import independent_gradients


@given(st.lists(st.tuples(*[st.integers(0, 4)] * 3), min_size=0, max_size=5))
@settings(max_examples=40)
def test_standard_monomials_are_those_that_no_monomial_divides(exponents) -> None:
    box = 9
    left = [
        e
        for e in product(range(box), repeat=3)
        if not any(all(a >= b for a, b in zip(e, f, strict=True)) for f in exponents)
    ]
    infinite = any(box - 1 in e for e in left)
    assert standard_monomials(exponents, 3) == (None if infinite else len(left))


def test_high_powers_are_counted_without_being_listed() -> None:
    assert standard_monomials([(200, 0, 0), (0, 200, 0), (0, 0, 200)], 3) == 200**3


@pytest.mark.parametrize(
    ("of", "point", "codimension", "expected"),
    [
        (system("x y", "(x^2 + y^2 - 1)^12*(x - 5)"), [0.6, 0.8], 1, 12),
        (system("x y", "x^3*(x - y)", "x^2*y"), [0, 2], 1, 2),
        (system("x y", "x^2", "y^3"), [0, 0], 2, 6),
        (system("x y", "x^2", "x*y", "y^3"), [0, 0], 2, 4),
        (system("x y", "y", "y - x^13"), [0, 0], 2, 13),
        (system("x y z", "(x - 1)^2*z", "(y - x^2)^5"), [1, 1, 7], 2, 10),
        (system("x y z", "z - x^3", "(z - y^2)*(z - 5)", "y^4"), [0, 0, 0], 3, 12),
        (system("x y", "(x^2 - y^3)^3", "(y^2 - x^3)^5"), [0, 0], 2, 15 * 4),
    ],
    ids=str,
)
def test_multiplicities_are_those_of_the_monomial_ideal(of, point, codimension, expected) -> None:
    x = np.array(point, dtype=complex)

    def vanishes(f) -> bool:
        return abs(f(x.tolist())) < 1e-12

    def by_local_ring(generators) -> int | None:
        # The one local ring that is asked for is that of two cusps.
        assert sorted(g.degree for g in generators) == [3, 3]
        return 4

    def independent(polynomials) -> bool:
        return independent_gradients(polynomials, x, 0.0)

    equations = [factor_into_irreducibles(f) for f in of.polynomials]
    found = generic_multiplicity(equations, codimension, vanishes, independent, by_local_ring)
    assert found == expected


def test_gradients_that_depend_on_each_other_show_no_multiplicity() -> None:
    of = system("x y", "x^2 - y^3", "y^2 - x^3")
    origin = np.zeros(2, dtype=complex)
    ideal = local_ideal(
        [factor_into_irreducibles(f) for f in of.polynomials], lambda f: f((0, 0)) == 0
    )

    def independent(polynomials) -> bool:
        return independent_gradients(polynomials, origin, 1e-12)

    assert ideal.multiplicity(2, independent) is None
    assert independent_gradients(of.polynomials, np.array([1, 2], dtype=complex), 1e-12)
    nearly = np.array([1e-14, 1e-15], dtype=complex)
    assert not independent_gradients(of.polynomials, nearly, 1e-12)


def test_gradients_whose_squares_leave_the_range_of_doubles_are_independent() -> None:
    of = system("x y", "x^20 - y", "x^19 + y^2")
    assert independent_gradients(of.polynomials, np.array([1e9, 1e9], dtype=complex), 0.0)
