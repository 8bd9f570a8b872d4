"""Curves that polynomials in one variable give are decomposed exactly, without paths."""

from __future__ import annotations

import numpy as np
import pytest

import nag
from nag.algebra.system import PolynomialSystem


@pytest.mark.parametrize("degree", [3, 7, 12, 20])
def test_a_curve_given_by_polynomials_is_irreducible_and_has_their_highest_degree(
    degree: int,
) -> None:
    answer = nag.decompose([f"y - x^{degree} + 3*x", f"z - 2*x^{degree - 1} - 1"])
    (found,) = answer.components
    assert answer.complete and answer.paths.tracked == 0
    assert (found.dimension, found.degree, found.multiplicity) == (1, degree, 1)
    x, y, z = found.points.T
    assert np.allclose(y, x**degree - 3 * x, rtol=1e-11)
    assert np.allclose(z, 2 * x ** (degree - 1) + 1, rtol=1e-11)
    off = found.slice.A @ found.points.T - found.slice.b[:, None]
    assert (np.abs(off) < 1e-14 * (1 + np.abs(found.points).max(axis=1))).all()


@pytest.mark.parametrize("seed", range(3))
def test_one_variable_may_give_the_others_in_turn(seed: int) -> None:
    equations = ["v - x^2", "w - v*x - 1/3", "u - w - v", "z + u - x"]
    answer = nag.decompose(equations, seed=seed)
    (found,) = answer.components
    assert answer.complete and (found.dimension, found.degree) == (1, 3)


def test_a_curve_on_which_a_condition_fails_is_left_out() -> None:
    plain = nag.system(["y - x^2", "z - x^3"], "x y z")
    for condition, count in (("y*x - z", 0), ("x - 1", 1)):
        g = nag.system([condition], "x y z").polynomials
        system = PolynomialSystem(plain.variables, plain.polynomials, g)
        answer = nag.decompose(system)
        assert answer.complete and len(answer.components) == count


def test_what_is_no_graph_over_one_variable_is_split() -> None:
    answer = nag.decompose(["y - x^2", "z^2 - y"])
    assert answer.complete and [c.degree for c in answer.components] == [2, 2]
