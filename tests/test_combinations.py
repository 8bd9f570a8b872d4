"""Combinations of equations with the lowest degrees, and with the fewest terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import prod

import flint
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from linkages import CASES
from systems import system

import nag
from nag.algebra.combinations import of_fewest_terms, of_fewest_variables, of_lowest_degrees
from nag.algebra.exact_ranks import independent_polynomials, rational_matrix
from nag.algebra.polynomial import Polynomial
from nag.bench.atlas.families import FAMILIES
from nag.solving.solve import solve

MONOMIALS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
polynomial = st.dictionaries(
    st.sampled_from(MONOMIALS), st.integers(-2, 2).filter(bool), min_size=1
).map(lambda terms: Polynomial(2, terms))
polynomials = st.lists(polynomial, min_size=1, max_size=4)


def matrix(given: Sequence[Polynomial]) -> flint.fmpq_mat:
    return rational_matrix([[Fraction(f.terms.get(e, 0)) for e in MONOMIALS] for f in given])


def test_two_circles_are_a_circle_and_their_line() -> None:
    x, y = Polynomial.variables(2)
    first, second = x * x + y * y - 1, x * x + y * y - 2 * x
    lower = of_lowest_degrees([first, second])
    assert sorted(f.degree for f in lower) == [1, 2]
    assert {first, second} & set(lower)


@pytest.mark.parametrize(
    ("name", "value", "degrees"),
    [("infinity", 8, [1, 2, 8]), ("triple", 12, [2, 2, 5]), ("osculating", 12, [2, 6])],
)
def test_hidden_equations_of_low_degree_are_found(
    name: str, value: int, degrees: list[int]
) -> None:
    family = next(f for f in FAMILIES if f.name == name)
    found = of_lowest_degrees(family.make(value, np.random.default_rng(5)).system.polynomials)
    assert sorted(f.degree for f in found) == degrees


def test_what_cannot_be_lowered_or_only_by_more_terms_stays_as_it_is() -> None:
    katsura = system("x y z", "x + 2*y + 2*z - 1", "x^2 + 2*y^2 + 2*z^2 - x", "2*x*y + 2*y*z - y")
    dependent = system("x y", "x^2 - y", "2*x^2 - 2*y")
    longer = system("x y", "x^4 + x^2*y + y^2 + 1", "x^4 + x^3 + x*y + y + x + 2")
    for given_ones in (katsura, dependent, longer):
        assert of_lowest_degrees(given_ones.polynomials) == given_ones.polynomials


@given(polynomials)
def test_the_combinations_stay_the_same_and_no_degree_rises(given: list[Polynomial]) -> None:
    found = of_lowest_degrees(given)
    assert len(found) == len(given)
    assert matrix(found).rref() == matrix(given).rref()
    assert prod(f.degree for f in found) <= prod(f.degree for f in given)


def test_paths_are_as_many_as_the_lowest_degrees_ask_for() -> None:
    # A start system that is named is tracked, whatever exact algebra could do.
    found = solve(
        system("x y", "x^3 + x*y + y^2 - 5", "2*x^3 - x*y + 3*y^2 - 7 + x"), start="total"
    )
    assert found.complete
    assert found.paths.tracked == 6 == len(found.solutions)


def test_a_multiple_of_another_equation_is_taken_off() -> None:
    x, y, z = Polynomial.variables(3)
    product, total = x * y * z - 1, x + y + z
    assert of_fewest_terms([product - Fraction(2, 3) * total, total]) == (product, total)


def test_degrees_are_kept() -> None:
    x, y = Polynomial.variables(2)
    low, high = x + y, x**3 + x + y
    assert of_fewest_terms([low, high]) == (low, x**3)


@given(st.lists(polynomial | st.just(Polynomial(2, {})), min_size=1, max_size=4))
def test_the_combinations_can_be_undone(given: list[Polynomial]) -> None:
    found = of_fewest_terms(given)
    assert matrix(found).rref() == matrix(given).rref()
    assert sum(len(f.terms) for f in found) <= sum(len(f.terms) for f in given)
    assert all(f.degree <= g.degree for f, g in zip(found, given, strict=True))


@pytest.mark.parametrize("seed", range(3))
def test_a_mixed_equation_costs_no_paths(seed: int) -> None:
    system = nag.read_case(CASES / "benchmarks/cyclic-5.toml").system
    *others, last = system.polynomials
    mixed = replace(system, polynomials=(*others, last - Fraction(1, 2) * others[1]))
    result = nag.solve(mixed, seed=seed, start="polyhedral")
    assert (result.complete, len(result.solutions)) == (True, 70)
    assert result.paths.tracked == 70


def test_combinations_of_fewest_variables_span_the_same_and_show_what_two_variables_share() -> None:
    x, y, z = Polynomial.variables(3)
    alone = [x * y - 2, y * z - 3, x * 3 - z * 2]
    # What only their combinations show: multiples of each with the third variable.
    mixed = [alone[0] * z + alone[1], alone[0] * z - alone[1] * 2, alone[2] + alone[0] * z]
    found = of_fewest_variables(mixed)
    assert [f.support for f in found] == [{0, 2}, {1, 2}, {0, 1, 2}]
    assert len(independent_polynomials([*mixed, *found])) == len(found) == 3


def test_combinations_of_fewest_variables_are_as_many_as_are_independent() -> None:
    x, y = Polynomial.variables(2)
    assert len(of_fewest_variables([x + y, x - y, x * 2])) == 2
    assert of_fewest_variables([]) == ()
