"""What follows from the equations of a branch: hidden factors, contradictions, fewer generators."""

from __future__ import annotations

from collections import Counter

import pytest

import nag
from nag.algebra.branches import branches
from nag.algebra.consequences import MOST_EQUATIONS, consequences, generators
from nag.algebra.factoring import ring
from nag.algebra.groebner import ideal_of
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose


def flint(system: PolynomialSystem) -> list:
    return [ring(system.n).of(f) for f in system.polynomials]


def linear_parts(system: PolynomialSystem) -> list[set[str]]:
    """The linear equations of each branch."""
    found = branches(system)
    assert found is not None
    return [{f.text(system.variables) for f in branch.linear} for branch in found]


def test_irreducible_equations_whose_consequences_have_factors_fall_apart() -> None:
    # On t = 0 all three vanish where u = 0 and v^2 = 1, which is a square for each pair of them.
    conics = ["u^2 + v^2", "u^2 + 2*v^2", "u^2 + u*v + 3*v^2"]
    equations = [f"{f} - {k}*(1 - t) + t*w" for k, f in enumerate(conics, 1)]
    parts = linear_parts(nag.system(["t*(t - 1)", *equations], "t u v w"))
    assert any({"t", "u"} <= own for own in parts)


def test_a_branch_whose_equations_have_no_zero_disappears() -> None:
    equations = ["t*(t - 1)", "t*(x*y - 1) + (1 - t)*(x - 3)", "t*(x*z - 1) + (1 - t)*(y - 3)"]
    empty = ["t*(y*z - x) + (1 - t)*z", "t*(y + z + x^2) + (1 - t)*(x*y*z)"]
    parts = linear_parts(nag.system([*equations, *empty], "t x y z"))
    assert not any("t - 1" in own for own in parts)


@pytest.mark.parametrize("condition", ["x", "x*(y - 5)"])
def test_a_branch_that_lies_where_it_must_not_disappears(condition: str) -> None:
    # On t = 1 the equations say x^2 = 0, though none of them has the factor x.
    conics = ["x^2 + y^2 - 1", "2*x^2 + y^2 - 1"]
    equations = ["t*(t - 1)", f"{conics[0]} + (1 - t)*y", f"{conics[1]} + (1 - t)*(x - 2)"]
    assert any("t - 1" in own for own in linear_parts(nag.system(equations, "t x y")))
    held = linear_parts(nag.system(equations, "t x y", nonzero=[condition]))
    assert held and not any("t - 1" in own for own in held)


def test_fewer_generators_of_lower_degrees_are_the_same_ideal() -> None:
    twisted = ["y - x^2", "z - x*y", "x*z - y^2", "x^3 - z", "x^2*z - y*z"]
    system = nag.system(twisted, "x y z")
    over = ring(system.n)
    found = consequences(flint(system))
    assert found is not None and found.codimension == 2
    chosen = [over.polynomial(f) for f in generators([*flint(system), *found.basis])]
    assert len(chosen) <= 3 and max(f.degree for f in chosen) == 2
    names = ("x", "y", "z")
    assert ideal_of(chosen, names) == ideal_of(system.polynomials, names)


def test_no_basis_is_asked_for_of_many_equations() -> None:
    many = nag.system([f"x^2 - {k}*y" for k in range(1, MOST_EQUATIONS + 2)], "x y")
    assert consequences(flint(many)) is None
    assert consequences(flint(nag.system(["x^2 - y"], "x y"))) is None


def test_a_branch_of_more_equations_than_it_needs_keeps_its_components_and_multiplicities() -> None:
    # A twisted cubic, cut out by three quadrics and a cubic, twice, and a plane.
    cubic = ["y*w - x^2", "z*w - x*y", "x*z - y^2"]
    equations = [f"({f})^2*(t - 2)" for f in cubic] + ["(t - 2)*(t - 3)", "(t - 2)*(w - 1)"]
    answer = decompose(nag.system(equations, "t x y z w"))
    assert answer.complete
    kinds = Counter((c.dimension, c.degree) for c in answer.components)
    assert kinds == {(4, 1): 1, (1, 3): 1}
    (curve,) = (c for c in answer.components if c.dimension == 1)
    assert curve.multiplicity > 1
