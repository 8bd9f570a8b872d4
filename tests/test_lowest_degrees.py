"""Combinations of equations of the lowest degrees: the same equations, by exact linear algebra."""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np
import pytest
from systems import system

from nag.algebra.lowest_degrees import of_lowest_degrees
from nag.algebra.polynomial import Polynomial
from nag.bench.atlas.families import FAMILIES
from nag.solving.solve import solve


def rank(polynomials: Sequence[Polynomial]) -> int:
    monomials = sorted({e for f in polynomials for e in f.terms})
    entries = [f.terms.get(e, 0) for f in polynomials for e in monomials]
    fractions = [flint.fmpq(c.numerator, c.denominator) for c in entries]
    return flint.fmpq_mat(len(polynomials), len(monomials), fractions).rank()


@pytest.mark.parametrize(
    ("name", "value", "degrees"),
    [("infinity", 8, [1, 2, 8]), ("triple", 12, [2, 2, 5]), ("osculating", 12, [2, 6])],
)
def test_hidden_equations_of_low_degree_are_found(
    name: str, value: int, degrees: list[int]
) -> None:
    family = next(f for f in FAMILIES if f.name == name)
    given = family.make(value, np.random.default_rng(5)).system.polynomials
    lower = of_lowest_degrees(given)
    assert sorted(f.degree for f in lower) == degrees
    assert rank(given) == rank(lower) == rank([*given, *lower]) == len(given)


def test_what_cannot_be_lowered_or_only_by_more_terms_stays_as_it_is() -> None:
    katsura = system("x y z", "x + 2*y + 2*z - 1", "x^2 + 2*y^2 + 2*z^2 - x", "2*x*y + 2*y*z - y")
    dependent = system("x y", "x^2 - y", "2*x^2 - 2*y")
    longer = system("x y", "x^4 + x^2*y + y^2 + 1", "x^4 + x^3 + x*y + y + x + 2")
    for given in (katsura, dependent, longer):
        assert of_lowest_degrees(given.polynomials) == given.polynomials


def test_equations_that_need_not_change_are_kept() -> None:
    given = system("x y", "x^2 + y^2 - 1", "x^2 + y^2 - 4*x + 3*y - 2").polynomials
    lower = of_lowest_degrees(given)
    assert sorted(f.degree for f in lower) == [1, 2]
    assert set(lower) & set(given)


def test_paths_are_as_many_as_the_lowest_degrees_ask_for() -> None:
    given = system("x y", "x^3 + x*y + y^2 - 5", "2*x^3 - x*y + 3*y^2 - 7 + x")
    # Two products of degree 2 and 3; the start system is asked for, so that paths are tracked.
    found = solve(given, start="total")
    assert found.complete
    assert found.paths.tracked == 6 == len(found.solutions)
