"""Families of systems: solved once for random parameters, then for any."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from systems import family

from nag.errors import StartError
from nag.solving.parameter import solve_generic, solve_targets

LINEAR = family("x y", "a b", "x^2 + y^2 - a", "x*y - b")
NONLINEAR = family("x", "a b", "x^2 - (a^2 + b)*x + a^2*b")


def test_many_targets_are_solved_from_one_generic_solution() -> None:
    solved = solve_generic(LINEAR, seed=1)
    assert len(solved.points) == 4 and solved.complete
    targets = [(Fraction(5), Fraction(2)), (Fraction(10), Fraction(3)), (Fraction(2), Fraction(0))]
    first, second, third = solve_targets(solved, targets)
    for result, pairs in ((first, {(1, 2), (2, 1)}), (second, {(1, 3), (3, 1)})):
        wanted = pairs | {(-a, -b) for a, b in pairs}
        assert result.complete
        assert {tuple(np.rint(p.real)) for p in result.points} == wanted
        assert all(s.real for s in result.solutions)
    root = 2**0.5
    assert np.allclose(np.sort(third.points.real.ravel())[[0, 1, -2, -1]], [-root] * 2 + [root] * 2)


def test_multiple_solutions_for_special_parameters_have_their_multiplicity() -> None:
    solved = solve_generic(LINEAR, seed=2)
    (result,) = solve_targets(solved, [(Fraction(4), Fraction(2))])
    assert [s.multiplicity for s in result.solutions] == [2, 2]
    assert result.complete


def test_parameters_may_enter_in_any_degree() -> None:
    solved = solve_generic(NONLINEAR, seed=3)
    (result,) = solve_targets(solved, [(Fraction(2), Fraction(7))])
    assert sorted(np.rint(result.points.real.ravel())) == [4, 7]
    assert np.abs(result.points - np.rint(result.points.real)).max() < 1e-12


def test_wrong_numbers_of_parameters_are_refused() -> None:
    solved = solve_generic(LINEAR)
    with pytest.raises(StartError, match="target 1: 1 values for 2 parameters"):
        solve_targets(solved, [(Fraction(1),)])
    with pytest.raises(ValueError, match="1 equation for 2 unknowns"):
        family("x y", "a", "x - a")
