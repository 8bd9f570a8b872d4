"""Where a Jacobian is singular everywhere no zero is isolated, and none is looked for by paths."""

from fractions import Fraction

import numpy as np
import pytest
from linkages import general_loop

from nag.algebra.exact_ranks import is_dependent
from nag.algebra.number import Irrational
from nag.algebra.polynomial import Polynomial
from nag.decomposition import isolated
from nag.decomposition.decompose import decompose
from nag.decomposition.isolated import is_finite, solve_at_once
from nag.decomposition.method import Task
from nag.mechanism.framework import placed_framework
from nag.mechanism.framework_model import framework_model
from nag.mechanism.model import model
from nag.numerics.system_facts import SystemFacts
from nag.tracking.run import Run
from nag.witness.witness import PathCounts

X, Y, Z = Polynomial.variables(3)
DEPENDENT = (X * X + Y * Y - 1, (X * X + Y * Y) ** 2 + Z * Z, Z - Fraction(1, 3))
# Two bipyramids hinged on a common edge: as many bars as make a rigid framework, and it swings.
BANANA = {
    "A": (0, 0, 0),
    "B": (0, 0, 5),
    "C": (3, 1, 2),
    "D": (1, 3, 1),
    "E": (2, 2, 4),
    "F": (-3, 1, 1),
    "G": (-2, -2, 3),
    "H": (-1, 2, 2),
}
TRIANGLES = ("CDE", "FGH")


@pytest.mark.parametrize("seed", range(5))
def test_dependent_polynomials_are_told_from_independent_ones(seed):
    rng = np.random.default_rng(seed)
    assert is_dependent(DEPENDENT, rng)
    assert not is_dependent((X * Y - 1, Y * Z - 2, X + Y + Z), rng)


def test_nothing_is_said_of_irrational_coefficients():
    root = Irrational("sqrt", (Fraction(2),))
    polynomials = [f * root for f in DEPENDENT]
    assert not is_dependent(polynomials, np.random.default_rng(0))


def test_no_paths_are_tracked_to_isolated_realisations_where_there_are_none(monkeypatch):
    places = {p: tuple(map(Fraction, x)) for p, x in BANANA.items()}
    bars = [(a, b) for a in "AB" for b in "CDEFGH"]
    bars += [(t[i], t[i - 1]) for t in TRIANGLES for i in range(3)]
    system = framework_model(placed_framework(3, places, bars)).system
    assert len(system.polynomials) == system.n

    def solve(*_, **__):
        raise AssertionError("paths were tracked")

    monkeypatch.setattr(isolated, "solve", solve)
    assert is_finite(system, np.random.default_rng(0), Run()) == (False, PathCounts())


def test_paths_that_only_said_that_a_set_is_finite_are_counted():
    task = Task(SystemFacts(model(general_loop(6, 4), "H").system), (), Run())
    finite, spent = is_finite(task.reduction.reduced, task.rng, task.run)
    points = solve_at_once(task, finite=True)
    assert finite and points is not None and spent.tracked > 0
    assert decompose(task.system).paths.tracked == spent.tracked + points.paths.tracked
