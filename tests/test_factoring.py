"""Factors over the rationals, and the branches that systems fall into by them."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from systems import system

from nag.algebra import branch_equations
from nag.algebra.branch_equations import BranchEquations, BranchKind
from nag.algebra.branches import branches
from nag.algebra.expression import parse_polynomial
from nag.algebra.factoring import factor_into_irreducibles, product
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.solving.solve import solve

small = st.lists(
    st.tuples(st.integers(0, 2), st.integers(0, 2), st.fractions(-3, 3, max_denominator=5)),
    min_size=1,
    max_size=3,
)
polynomials = small.map(lambda rows: Polynomial(2, {(i, j): c for i, j, c in rows}))


def texts(of: PolynomialSystem) -> set[frozenset[str]] | None:
    found = branches(of)
    if found is None:
        return None
    return {frozenset(f.text(of.variables) for f in b.polynomials) for b in found}


@given(st.lists(st.tuples(polynomials, st.integers(1, 3)), min_size=1, max_size=3))
@settings(max_examples=30)
def test_the_factors_multiply_to_the_polynomial_up_to_a_constant(parts) -> None:
    f = product([p**k for p, k in parts], 2)
    if not f:
        return
    found = factor_into_irreducibles(f)
    again = product([p**k for p, k in found], 2)
    (lead,) = {Fraction(f.terms[e]) / again.terms[e] for e in f.terms}
    assert again * lead == f
    assert len({p for p, _ in found}) == len(found)
    assert all(factor_into_irreducibles(p) == ((p, 1),) for p, _ in found)


def test_coefficients_that_are_not_algebraic_are_left_as_they_are() -> None:
    f = parse_polynomial("pi*x^2*y", ("x", "y"))
    assert factor_into_irreducibles(f) == ((f, 1),)


def test_huge_coefficients_still_fit_into_doubles() -> None:
    x, y = Polynomial.variables(2)
    f = (x * 10**400 + y) * (y - 1)
    assert all(
        float(max(map(abs, p.terms.values()))) < 1e300 for p, _ in factor_into_irreducibles(f)
    )


@pytest.mark.parametrize(
    ("of", "expected"),
    [
        (system("x y", "x^2 + y^2 - 1", "x*y - 2"), None),
        (system("x y z", "x*y", "x*z"), {("x",), ("y", "z")}),
        (system("x y", "(x^2 + y^2 - 1)^12"), {("x^2 + y^2 - 1",)}),
        (system("x y z w", "x*y", "y*z", "z*w", "w*x"), {("x", "z"), ("y", "w")}),
        (system("x y z", "(x-1)*(x*y-2)", "(x-1)*(x*z+y)"), {("x - 1",), ("x*y - 2", "x*z + y")}),
        (system("x y", "x*(x-1)", "(x-2)*(x-3)"), set()),
        (system("x y", "x", "x - 1"), set()),
        (system("x y z", "(z - 1)*(z - 2)", "x*y + z", "x*y + 5"), set()),
        (system("x y", "x^2 - y", "y*(y-1)"), {("x", "y"), ("y - 1", "x^2 - 1")}),
        (system("x y z", "x*y", "y*z", "z*x"), {("x", "y"), ("x", "z"), ("y", "z")}),
        (system("x y z", "x*y*z", "x*y*(z-1)"), {("x",), ("y",)}),
        (system("x y z", "x - y", "z^2 - 3*z*x", nonzero=("z",)), {("3*x - z", "3*y - z")}),
    ],
)
def test_branches_are_those_that_are_known(of, expected) -> None:
    found = texts(of)
    if expected is None:
        assert found is None
        return
    variables = of.variables

    def spaces(b: frozenset[str]) -> frozenset:
        return frozenset(factor_into_irreducibles(parse_polynomial(t, variables)) for t in b)

    assert {spaces(b) for b in found} == {spaces(frozenset(b)) for b in expected}


def test_what_must_not_vanish_is_no_branch() -> None:
    of = system("x y", "x*(x^2 + y^2 + 1)", "y*(x^2 + y^2 + 1)", nonzero=("x^2 + y^2 + 1",))
    assert texts(of) == {frozenset({"x", "y"})}


def test_too_many_branches_are_not_followed_but_common_factors_are() -> None:
    names = [f"x{i}" for i in range(8)]
    x = Polynomial.variables(8)
    pairs = [(x[i] ** 2 + x[(i + 1) % 8]) ** 2 * (x[i] ** 3 - x[(i + 3) % 8]) for i in range(8)]
    common = x[0] * x[1] - 1
    found = branches(PolynomialSystem(tuple(names), tuple(f * common for f in pairs)))
    assert found is not None and len(found) == 2
    assert {len(b.polynomials) for b in found} == {1, 8}
    assert max(f.degree for b in found for f in b.polynomials) == 5


def test_a_system_that_linear_equations_only_repeat_is_whole() -> None:
    assert branches(system("x y z", "x - 1", "y", "x^2 + y^2 - 1", "z^2 + x*y - 2")) is None


def test_what_kind_a_branch_is_takes_no_elimination_where_equations_are_solved(monkeypatch) -> None:
    monkeypatch.setattr(branch_equations, "eliminate_linear", lambda *_, **__: pytest.fail())
    left = system("x y z", "x - y + 1", "y^2 + z^2 - 1")
    assert BranchEquations(left, graphs=False).kind is BranchKind.SYSTEM
    assert BranchEquations(left, graphs=True).kind is BranchKind.SYSTEM
    assert solve(system("x y z", "x + y + z - 1", "x^2 + 2*y^2 - 3", "y^2 + x*z - 5")).complete


@pytest.mark.parametrize(
    ("equations", "kind"),
    [
        (("x - y + 1", "z - y^2"), BranchKind.LINEAR_SPACE),
        (("x - 1", "y - x^2", "z - y^2"), BranchKind.POINT),
        (("x - y", "x - y + 1", "z^2 - y^2 - 2"), BranchKind.EMPTY),
        (("x - y", "y - x", "z^2 - y^2 - 2"), BranchKind.SYSTEM),
        (("x - y", "2*x - y - 1", "x^2 + y^2 - 2"), BranchKind.LINEAR_SPACE),
    ],
)
def test_what_kind_a_branch_is(equations, kind) -> None:
    assert BranchEquations(system("x y z", *equations), graphs=True).kind is kind
