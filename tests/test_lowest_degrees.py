"""Equations in combinations of the lowest degrees: the same combinations, never higher degrees."""

from __future__ import annotations

from math import prod

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from systems import system

from nag.algebra.lowest_degrees import _echelon, of_lowest_degrees
from nag.algebra.polynomial import Polynomial
from nag.bench.atlas.families import FAMILIES
from nag.solving.solve import solve

MONOMIALS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
polynomials = st.lists(
    st.dictionaries(st.sampled_from(MONOMIALS), st.integers(-2, 2).filter(bool), min_size=1).map(
        lambda terms: Polynomial(2, terms)
    ),
    min_size=1,
    max_size=4,
)


def rank(given: list[Polynomial]) -> int:
    return len(_echelon(given))


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
    assert rank([*given, *found]) == rank(list(found)) == rank(given)
    assert prod(f.degree for f in found) <= prod(f.degree for f in given)


def test_paths_are_as_many_as_the_lowest_degrees_ask_for() -> None:
    # A start system that is named is tracked, whatever exact algebra could do.
    found = solve(
        system("x y", "x^3 + x*y + y^2 - 5", "2*x^3 - x*y + 3*y^2 - 7 + x"), start="total"
    )
    assert found.complete
    assert found.paths.tracked == 6 == len(found.solutions)
