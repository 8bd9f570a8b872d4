"""Variables that may be interchanged: found exactly, one path of each orbit leads to all ends."""

from __future__ import annotations

from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag import solve
from nag.algebra.expression import parse_polynomial
from nag.solving.start.interchange import Interchange
from nag.solving.start.target import Target
from nag.solving.start.total_degree import Shape, total_degree
from nag.tracking.known import NOTHING
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.track import track

NOON = [
    "x*(y^2 + z^2) - 11/10*x + 1",
    "y*(x^2 + z^2) - 11/10*y + 1",
    "z*(x^2 + y^2) - 11/10*z + 1",
]
# Three double zeros, one of them on the diagonal, and paths to infinity.
SINGULAR = ["x*y - 1 + (x - y)^2*x", "x*y - 1 + (x - y)^2*y"]
LINEAR = ["x + y + z - 6*w", "x^3 - w*y*z - 2", "y^3 - w*x*z - 2", "z^3 - w*x*y - 2"]


def target(variables: str, equations: list[str]) -> Target:
    names = variables.split()
    return Target.of([parse_polynomial(e, names) for e in equations], len(names))


def found(variables: str, equations: list[str]) -> Interchange:
    return Shape.of(target(variables, equations)).interchange


def same_ends(first: Paths, second: Paths) -> bool:
    """Whether all paths end alike, and where they do as projective points."""
    product = np.abs((first.points.conj() * second.points).sum(axis=1))
    return (
        np.array_equal(first.status, second.status)
        and np.array_equal(first.winding, second.winding)
        and bool((np.abs(product - 1) < 1e-12).all())
    )


def test_variables_are_found_that_may_be_interchanged() -> None:
    assert found("x y z", NOON).blocks == ((0, 1, 2),)
    assert found("x y", SINGULAR).blocks == ((0, 1),)
    assert found("x y z w", LINEAR).blocks == ((0, 1, 2),)


def test_an_equation_belongs_to_its_variable_in_whatever_order() -> None:
    shuffled = found("x y z", [NOON[2], NOON[0], NOON[1]])
    assert shuffled.blocks == ((0, 1, 2),)
    assert shuffled.owner == {0: 1, 1: 2, 2: 0}


@pytest.mark.parametrize(
    "equations",
    [
        ["x^2 + y - 1", "y^2 + 2*x - 1"],
        ["x^2 + x*y - 1", "y^2 - x*y - 1"],
        ["x^2 + y^2 - 1", "x*y - 3"],
        ["x^2 + 3*y - 1", "y^2 + 3*x - 2"],
    ],
)
def test_systems_that_an_interchange_changes_are_left_alone(equations: list[str]) -> None:
    assert found("x y", equations).blocks == ()


@pytest.mark.parametrize(
    ("variables", "equations"), [("x y z", NOON), ("x y", SINGULAR), ("x y z w", LINEAR)]
)
@pytest.mark.parametrize("seed", range(3))
def test_images_are_where_the_paths_themselves_lead(
    variables: str, equations: list[str], seed: int
) -> None:
    start = total_degree(target(variables, equations), np.random.default_rng(seed))
    images = track(start.homotopy, start.points, known=start.known)
    themselves = track(start.homotopy, start.points, known=NOTHING)
    assert len(start.known.orbits.chosen) < len(start.points)
    assert same_ends(images, themselves)
    assert images.steps.sum() < themselves.steps.sum()


def test_as_many_orbits_as_multisets_of_roots() -> None:
    start = total_degree(target("x y z", NOON), np.random.default_rng(0))
    orbits = start.known.orbits
    assert len(orbits.chosen) == comb(3 + 3 - 1, 3)
    assert np.array_equal(orbits.orbit[orbits.chosen], np.arange(len(orbits.chosen)))
    points = start.points[orbits.chosen][orbits.orbit]
    assert np.array_equal(np.take_along_axis(points, orbits.sources, axis=1), start.points)


@given(st.integers(0, 10**6))
def test_symmetric_and_scaled_systems_have_as_many_zeros(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b, c, d = (int(k) for k in rng.integers(-3, 4, 4))
    first = f"x^3 + ({a})*x*y + ({b})*y^2 + ({c})*x + ({d})"
    equations = [first, first.replace("x", "_").replace("y", "x").replace("_", "y")]
    scaled = [e.replace("y", "(3*y)") for e in equations]
    here, there = solve(equations, start="total"), solve(scaled, start="total")
    assert here.complete == there.complete
    if here.complete:
        assert sorted(s.multiplicity for s in here.solutions) == sorted(
            s.multiplicity for s in there.solutions
        )


def test_a_branch_keeps_its_meaning_among_other_coordinates() -> None:
    start = total_degree(target("x y", SINGULAR), np.random.default_rng(1))
    images = track(start.homotopy, start.points, known=start.known)
    themselves = track(start.homotopy, start.points, known=NOTHING)
    assert images.branches.keys() == themselves.branches.keys() and images.branches
    for path, branch in images.branches.items():
        other = themselves.branches[path]
        assert branch.orders == other.orders
        assert np.exp(branch.logs) == pytest.approx(np.exp(other.logs), abs=1e-6)
    assert len(images.where(PathStatus.FAILED)) == 0


@pytest.mark.parametrize(
    ("equations", "number"),
    [(["2*x*y - 1", "2*y*x - 1"], 0), (["x^2 - x*y + 3*y^2", "y^2 - x*y + 3*x^2"], 4)],
)
def test_systems_without_mixed_cells_are_solved(equations: list[str], number: int) -> None:
    result = solve(equations, start="total")
    assert sum(s.multiplicity for s in result.solutions) == number
    assert result.complete
