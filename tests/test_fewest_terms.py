"""Combinations of equations with the fewest terms."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from linkages import CASES

import nag
from nag.algebra.fewest_terms import of_fewest_terms
from nag.algebra.polynomial import Polynomial


def test_a_multiple_of_another_equation_is_taken_off() -> None:
    x, y, z = Polynomial.variables(3)
    product, total = x * y * z - 1, x + y + z
    assert of_fewest_terms([product - Fraction(2, 3) * total, total]) == (product, total)


def test_degrees_are_kept() -> None:
    x, y = Polynomial.variables(2)
    low, high = x + y, x**3 + x + y
    assert of_fewest_terms([low, high]) == (low, x**3)


@given(st.lists(st.lists(st.integers(-2, 2), min_size=6, max_size=6), min_size=2, max_size=4))
def test_the_combinations_can_be_undone(rows: list[list[int]]) -> None:
    import flint

    x, y = Polynomial.variables(2)
    monomials = [x**2, x * y, y**2, x, y, Polynomial.constant(2, Fraction(1))]
    equations = [
        sum((Fraction(c) * m for c, m in zip(row, monomials, strict=True)), Polynomial(2, {}))
        for row in rows
    ]
    found = of_fewest_terms(equations)

    def matrix(polynomials: list[Polynomial]) -> flint.fmpq_mat:
        exponents = [next(iter(m.terms)) for m in monomials]
        entries = [
            flint.fmpq(c.numerator, c.denominator)
            for f in polynomials
            for c in (Fraction(f.terms.get(e, 0)) for e in exponents)
        ]
        return flint.fmpq_mat(len(polynomials), len(exponents), entries)

    def whole(polynomials: list[Polynomial]) -> object:
        reduced, rank = matrix(polynomials).rref()
        return reduced, rank

    assert whole(list(found)) == whole(equations)
    assert sum(len(f.terms) for f in found) <= sum(len(f.terms) for f in equations)
    assert all(f.degree <= g.degree for f, g in zip(found, equations, strict=True))


@pytest.mark.parametrize("seed", range(3))
def test_a_mixed_equation_costs_no_paths(seed: int) -> None:
    system = nag.read_case(CASES / "benchmarks/cyclic-5.toml").system
    *others, last = system.polynomials
    mixed = replace(system, polynomials=(*others, last - Fraction(1, 2) * others[1]))
    result = nag.solve(mixed, seed=seed, start="polyhedral")
    assert (result.complete, len(result.solutions)) == (True, 70)
    assert result.paths.tracked == 70
