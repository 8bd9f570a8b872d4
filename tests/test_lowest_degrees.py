"""Equations in combinations of the lowest degrees: the same combinations, never higher degrees."""

from __future__ import annotations

from math import prod

from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.lowest_degrees import _echelon, of_lowest_degrees
from nag.algebra.polynomial import Polynomial

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
    assert sorted(f.degree for f in of_lowest_degrees([first, second])) == [1, 2]


def test_highest_terms_that_are_independent_leave_the_equations_as_they_are() -> None:
    x, y = Polynomial.variables(2)
    given = (x * x + y * y - 1, x * y + y * y - 2 * x)
    assert of_lowest_degrees(given) == given


@given(polynomials)
def test_the_combinations_stay_the_same_and_no_degree_rises(given: list[Polynomial]) -> None:
    found = of_lowest_degrees(given)
    assert len(found) == len(given)
    assert rank([*given, *found]) == rank(list(found)) == rank(given)
    assert prod(f.degree for f in found) <= prod(f.degree for f in given)
