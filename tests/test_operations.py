"""Membership of points, components on slices of one's own, projections."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from systems import system

from nag.algebra.system import PolynomialSystem
from nag.decomposition import project, witness_at
from nag.decomposition.decompose import decompose
from nag.witness import membership as membership_module
from nag.witness.membership import Membership, UndecidedError, components_through, memberships
from nag.witness.moving import SliceError
from nag.witness.slices import random_rows, to_slice
from nag.witness.witness import PathCounts, Slice, Status, WitnessSet

MEMBER, FOREIGN, UNDECIDED = Membership.MEMBER, Membership.FOREIGN, Membership.UNDECIDED


def only(of: PolynomialSystem) -> WitnessSet:
    (component,) = decompose(of).components
    return component


CUBIC = system("x y z", "y - x^2", "z - x^3")
CIRCLE = system("x y", "x^2 + y^2 - 1")
HYPERBOLA = system("x y", "x*y - 1")
DOUBLE = system("x y z", "x^2 - y", "z^2")


@pytest.mark.parametrize(
    ("point", "expected"),
    [
        ((0, 2, 3), 1),
        ((0, 0, 3), 2),
        ((0, 0, 0), 3),
        ((1, 2, 3), 0),
        ((0, 1e-3, 0), 2),
    ],
)
def test_every_component_says_whether_a_point_lies_on_it(point, expected: int) -> None:
    planes = decompose(system("x y z", "x*y*z"))
    answers = memberships(planes, np.array(point))
    assert len(answers) == 3
    assert answers.count(MEMBER) == expected and UNDECIDED not in answers
    for component, answer in zip(planes.components, answers, strict=True):
        # Each plane is the zero set of the coordinate that its witness point does not have.
        vanishing = int(np.abs(component.points[0]).argmin())
        assert (answer is MEMBER) == (point[vanishing] == 0)


def test_a_component_that_is_not_reduced_knows_its_points() -> None:
    decomposition = decompose(DOUBLE)
    assert memberships(decomposition, np.array([2, 4, 0])) == (MEMBER,)
    assert memberships(decomposition, np.array([2, 5, 0])) == (FOREIGN,)


def test_what_was_found_is_kept_when_one_membership_is_undecided(monkeypatch) -> None:
    answers = iter([MEMBER, UNDECIDED, FOREIGN])

    def find_members(point, accuracy, sets, *_, **__):
        return [(next(answers), False) for _ in sets], PathCounts(tracked=1)

    monkeypatch.setattr(membership_module, "find_members", find_members)
    planes = decompose(system("x y z", "x*y*z"))
    answers = iter([MEMBER, UNDECIDED, FOREIGN])
    assert memberships(planes, np.zeros(3)) == (MEMBER, UNDECIDED, FOREIGN)
    answers = iter([MEMBER, UNDECIDED, FOREIGN])
    with pytest.raises(UndecidedError, match="component 1 could not be decided; it lies on 0") as e:
        components_through(planes, np.zeros(3))
    assert (e.value.found, e.value.open) == ([0], [1])


def test_a_given_slice_shows_the_points_that_algebra_says() -> None:
    moved = witness_at(CIRCLE, only(CIRCLE), Slice([[5, 0]], [15]))
    expected = np.array([[3, -2j * np.sqrt(2)], [3, 2j * np.sqrt(2)]])
    order = np.argsort(moved.points[:, 1].imag)
    assert np.abs(moved.points[order] - expected).max() < 1e-14
    assert np.allclose(np.abs(moved.slice.A), [[1, 0]], atol=1e-15)
    assert moved.status is Status.IRREDUCIBLE and moved.residual < 1e-15


@given(seed=st.integers(0, 2**32))
@settings(max_examples=10)
def test_moving_away_and_back_leads_to_the_same_points(seed: int) -> None:
    component = only(CUBIC)
    slice_ = to_slice(random_rows(np.random.default_rng(seed), 1, 3))
    there = witness_at(CUBIC, component, slice_)
    assert np.abs(there.points @ there.slice.A.T - there.slice.b).max() < 1e-12
    back = witness_at(CUBIC, there, component.slice)
    distances = np.linalg.norm(back.points[:, None] - component.points[None], axis=2)
    assert sorted(distances.argmin(axis=1)) == [0, 1, 2]
    assert distances.min(axis=1).max() < 1e-12


def test_components_that_are_not_reduced_move_as_well() -> None:
    moved = witness_at(DOUBLE, only(DOUBLE), Slice([[0, 1, 0]], [4]))
    assert np.abs(np.sort_complex(moved.points[:, 0]) - [-2, 2]).max() < 1e-14
    assert moved.multiplicity == 2


@pytest.mark.parametrize(
    ("of", "A", "b", "part"),
    [
        (HYPERBOLA, [[1, 0]], [3], "meets 1 at infinity and 0"),
        (CIRCLE, [[1, 0]], [1], "0 at infinity and 2 where the intersection is not transversal"),
        (CIRCLE, [[0, 0]], [1], "linearly dependent"),
        (CIRCLE, [[np.nan, 0]], [1], "not finite"),
        (CIRCLE, [[1, 0], [0, 1]], [1, 1], "has 2 equations in 2 variables"),
        (CIRCLE, [[1, 0, 0]], [1], "in 3 variables"),
    ],
)
def test_slices_that_do_not_cut_properly_are_refused(of, A, b, part: str) -> None:
    with pytest.raises(SliceError, match=part):
        witness_at(of, only(of), Slice(A, b))


@pytest.mark.parametrize(
    ("of", "coordinates", "expected"),
    [
        (CUBIC, [0], (1, 1, 0, 1)),
        (CUBIC, [1], (1, 1, 0, 2)),
        (CUBIC, [2], (1, 1, 0, 3)),
        (CUBIC, [1, 2], (1, 3, 0, 1)),
        (CUBIC, [0, 1], (1, 2, 0, 1)),
        (CUBIC, [0, 1, 2], (1, 3, 0, 1)),
        (system("x y z", "x^2 + y^2 + z^2 - 1"), [0, 1], (2, 1, 0, 2)),
        (system("x y z", "x^2 + y^2 + z^2 - 1"), [2], (1, 1, 1, 2)),
        (system("x y z", "x^2 + y^2 - 1"), [0, 1], (1, 2, 1, 1)),
        (system("x y z", "x^2 + y^2 - 1"), [2, 0], (2, 1, 0, 2)),
        (HYPERBOLA, [0], (1, 1, 0, 1)),
        (DOUBLE, [2], (0, 1, 1, 2)),
        (DOUBLE, [1, 2], (1, 1, 0, 2)),
        (system("x y", "x - 1", "y - 2"), [1], (0, 1, 0, 1)),
        (system("x y z w", "x - z*w", "y - z^2*w"), [0, 1], (2, 1, 0, 1)),
        (system("x y z w", "x - z^2", "y - z*w", "w^2 - 1 + z"), [0, 1], (1, 4, 0, 1)),
    ],
)
def test_projections_have_the_dimension_and_degree_of_elimination(
    of, coordinates, expected
) -> None:
    found = project(of, only(of), coordinates)
    assert (found.dimension, found.degree, found.fibre_dimension, found.fibre_degree) == expected
    assert len(found.points) == found.degree * found.fibre_degree
    others = [i for i in range(of.n) if i not in coordinates]
    assert not found.slice.A[: found.dimension, others].any()
    assert np.abs(found.points @ found.slice.A.T - found.slice.b).max(initial=0.0) < 1e-10


@pytest.mark.parametrize("coordinates", [[], [0, 0], [2], [-1]])
def test_projections_to_no_coordinates_are_refused(coordinates) -> None:
    with pytest.raises(ValueError, match="coordinates: "):
        project(CIRCLE, only(CIRCLE), coordinates)
