"""Random points of a component, real ones near a point, components found from random points."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from systems import system

from nag.algebra.evaluation import Evaluator
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition import discover, real_points_near, sample
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.mechanism.model import model
from nag.witness import moving
from nag.witness.frame import expand_orbits
from nag.witness.membership import Membership, memberships
from nag.witness.sampling import SamplingError
from nag.witness.witness import Decomposition, Status

CASES = Path(__file__).parent.parent / "cases"


def case(name: str) -> PolynomialSystem:
    return read_case(CASES / f"{name}.toml").system


@pytest.mark.parametrize(
    "of",
    [
        system("x y z", "y - x^2", "z - x^3"),
        system("x y z", "x^2 + y^2 + z^2 - 1"),
        system("x y z", "z^2", "x^2 - y"),
        system("x y", "x^2 - 2", "y - x"),
        system("x y"),
        case("slider-crank"),
    ],
)
def test_samples_are_distinct_points_of_the_component_to_rounding(of) -> None:
    decomposition = decompose(of)
    component = decomposition.components[0]
    samples = sample(of, component, 6)
    assert samples.points.shape == (6, of.n)
    assert samples.residual < 1e-14 and samples.accuracy < 1e-12
    residuals = Evaluator.of(of.polynomials, of.n).residuals(samples.points)
    assert residuals.max(initial=0.0) == samples.residual
    if component.dimension:
        gaps = np.linalg.norm(samples.points[:, None] - samples.points[None], axis=2)
        assert (gaps + np.eye(6)).min() > 1e-3
        assert Membership.MEMBER is memberships(decomposition, samples.points[0])[0]
    else:
        known = component.points
        assert all(np.linalg.norm(known - x, axis=1).min() < 1e-12 for x in samples.points)


def test_samples_depend_on_the_seed_and_on_nothing_else() -> None:
    of = case("slider-crank")
    component = decompose(of).components[0]
    first, second = (sample(of, component, 3, seed=4, threads=k).points for k in (1, 2))
    assert first.tobytes() == second.tobytes()
    assert np.abs(sample(of, component, 3, seed=5).points - first).min() > 0
    assert sample(of, component, 2, seed=4).points.tobytes() == first[:2].tobytes()


def test_paths_that_fail_end_the_sampling_with_what_was_found(monkeypatch) -> None:
    circle = system("x y", "x^2 + y^2 - 1")
    component = decompose(circle).components[0]
    moves, true_move = [], moving.move

    def failing(*arguments: object, **options: object) -> object:
        moves.append(arguments)
        found = true_move(*arguments, **options)
        for ends in found:
            if len(moves) > 2:
                ends.regular[:] = False
        return found

    monkeypatch.setattr(moving, "move", failing)
    with pytest.raises(SamplingError, match="point 3 of 5: the path to it failed") as error:
        sample(circle, component, 5)
    assert error.value.found.points.shape == (2, 2)


@pytest.mark.parametrize(
    ("of", "near", "nearest"),
    [
        (system("x y", "x^2 + y^2 - 1"), [3, 4], [0.6, 0.8]),
        (system("x y", "x^2 + y^2 - 1"), [0.6, 0.8], [0.6, 0.8]),
        (system("x y z", "z - x^2 - y^2"), [0, 0, -3], [0, 0, 0]),
        (system("x y z", "z^2", "x - y"), [1, 3, 1], [2, 2, 0]),
        (system("x y", "x - 1/2", "y - 1/4"), [1, 1], [0.5, 0.25]),
    ],
)
def test_the_nearest_real_point_is_found(of, near, nearest) -> None:
    (component,) = decompose(of).components
    found = real_points_near(of, component, near)
    assert found.reason == "" and found.undecided == 0
    assert found.stationary[0]
    assert np.abs(found.points[0] - nearest).max() < 1e-8
    assert found.points.dtype == float and found.residual < 1e-13
    assert np.all(np.diff(found.distances) >= 0)
    assert abs(found.distances[0] - np.linalg.norm(np.subtract(near, nearest))) < 1e-8


@pytest.mark.parametrize("near", [[0, 0, 3], [0, 0, 40], [0.1, 0, 3], [-7, 2, 5]])
def test_points_that_have_arrived_are_stationary_to_rounding(near) -> None:
    # Inside a paraboloid the set bends towards the given point; from its axis a circle is nearest.
    of = system("x y z", "z - x^2 - y^2")
    found = real_points_near(of, decompose(of).components[0], near, starts=6)
    x, y, _ = found.points[0]
    gap = found.points[0] - near
    tangents = np.array([[1, 0, 2 * x], [0, 1, 2 * y]])
    assert found.stationary.all()
    assert np.abs(tangents @ gap).max() < 1e-9 * (1 + np.linalg.norm(near)) * (1 + abs(x) + abs(y))
    if near[:2] == [0, 0]:
        assert abs(found.distances[0] - np.sqrt(near[2] - 0.25)) < 1e-12 * near[2]


@pytest.mark.parametrize("seed", range(20))
def test_steps_along_a_valley_arrive(seed: int) -> None:
    # Next to a circle of points that are nearly as near.
    of = system("x y z", "z - x^2 - y^2")
    component = decompose(of).components[0]
    found = real_points_near(of, component, [0.1, 0, 3], starts=6, seed=seed)
    assert found.stationary.all()


def test_a_component_without_real_points_yields_none_and_says_so() -> None:
    of = system("x y", "x^2 + y^2 + 1")
    found = real_points_near(of, decompose(of).components[0], [0, 0])
    assert len(found) == 0
    assert found.reason == "no real zero of the equations was found from 24 starting points"


def test_real_points_of_other_components_do_not_count() -> None:
    of = system("x y", "(x^2 + y^2 + 1)*(x - 3)")
    line, conic = decompose(of).components
    assert (line.degree, conic.degree) == (1, 2)
    found = real_points_near(of, line, [2, 5])
    assert np.abs(found.points - [[3, 5]]).max() < 1e-8
    none = real_points_near(of, conic, [2, 5])
    assert len(none) == 0 and "no real zero" in none.reason


def test_real_points_of_a_component_that_is_not_reduced_are_found() -> None:
    # Its points are kept with unknowns that deflation added.
    of = system("x y z", "x^2 + y^2 - 1", "z^2 + x*(x^2 + y^2 - 1)")
    component = decompose(of).components[0]
    assert component.multiplicity == 2 and component.fibres[0].cut.aux
    found = real_points_near(of, component, [3, 4, 1])
    assert len(found) and found.stationary[0]
    assert np.abs(found.points[0] - [0.6, 0.8, 0]).max() < 1e-7


def test_a_mechanism_keeps_its_real_reference_configuration() -> None:
    cube = model(read_case(CASES / "bricard-cube.toml").mechanism)
    reference = np.array([float(x) for x in cube.reference])
    (curve,) = decompose(cube.system).components
    found = real_points_near(cube.system, curve, reference, starts=4)
    assert np.abs(found.points[0] - reference).max() < 1e-8


@pytest.mark.parametrize("near", [[0.0], [0, np.nan], [[0, 0]]])
def test_points_that_are_none_are_refused(near) -> None:
    of = system("x y", "x^2 + y^2 - 1")
    with pytest.raises(ValueError, match="2 finite real numbers"):
        real_points_near(of, decompose(of).components[0], near)


def kinds(answer: Decomposition) -> Counter[tuple[int, int, int]]:
    assert not answer.complete
    assert all(c.status is Status.IRREDUCIBLE for c in answer.components)
    assert all(c.residual < 1e-12 for c in answer.components)
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)


@pytest.mark.parametrize(
    ("of", "expected", "seed"),
    [
        (case("double-rhombus"), {(2, 4, 1): 9}, 0),
        (case("bricard-variety"), {(1, 8, 1): 1}, 1),
        (case("slider-crank"), {(2, 8, 1): 1}, 0),
        (system("x y z", "x^2 - y", "z^2"), {(1, 2, 2): 1}, 1),
        (system("x y z", "x*(x - 1)*(z - y)", "y*(x - 1)"), {(2, 1, 1): 1, (1, 1, 1): 2}, 0),
        (system("x y z", "x*(x - 1)*(z - y)", "y*(x - 1)"), {(2, 1, 1): 1, (1, 1, 1): 2}, 1),
        (system("x y", "x^2 - 1", "y^2 - 4"), {(0, 1, 1): 4}, 0),
        (system("x y", "x^2 - 1", "y^2 - 4"), {(0, 1, 1): 4}, 1),
        (system("x y", "x - 1", "y - 2"), {(0, 1, 1): 1}, 0),
        (system("x y"), {(2, 1, 1): 1}, 0),
        (system("x", "1"), {}, 0),
        (system("x", "x", "x - 1"), {}, 0),
    ],
)
def test_components_are_discovered_from_random_points(of, expected, seed: int) -> None:
    answer = discover(of, seed=seed)
    assert kinds(answer) == Counter(expected)
    assert "components may be missing" in answer.notes[0]


def test_what_is_discovered_does_not_depend_on_threads() -> None:
    of = case("four-bar")
    assert discover(of, seed=2, starts=20, threads=1) == discover(of, seed=2, starts=20, threads=2)


def test_few_starts_find_some_components_and_each_is_whole() -> None:
    answer = discover(case("double-rhombus"), starts=4)
    assert 1 <= len(answer.components) <= 4
    assert set(kinds(answer)) == {(2, 4, 1)}
    assert "of 4 random points" in answer.notes[0]


def test_the_cube_in_euler_parameters_is_one_orbit_of_sixteen_curves() -> None:
    cube = model(read_case(CASES / "bricard-cube.toml").mechanism, "E")
    assert (cube.system.n, len(cube.system.polynomials)) == (16, 16)
    signs = cube.symmetries
    answer = discover(cube.system, starts=6, symmetries=signs)
    assert kinds(answer) == {(1, 8, 1): 1}
    assert answer.components[0].orbit == 16
    curves = expand_orbits(answer)
    assert kinds(curves) == {(1, 8, 1): 16}
    reference = np.array([float(x) for x in cube.reference])
    assert memberships(curves, reference).count(Membership.MEMBER) == 1


def test_symmetries_add_what_was_not_met_and_join_what_was() -> None:
    of = system("x y", "(x^2 - 1)*(y^2 - x)*(y^2 + x)")
    flip = SignedPermutation.of_signs((-1, 1))
    for starts in (3, 60):
        answer = discover(of, starts=starts, symmetries=[flip])
        assert all(c.orbit == 2 for c in answer.components)
        met = set(kinds(expand_orbits(answer)))
        assert met <= {(1, 1, 1), (1, 2, 1)}
    assert kinds(expand_orbits(answer)) == {(1, 1, 1): 2, (1, 2, 1): 2}


def test_points_that_doubles_do_not_see_as_regular_are_drawn_all_the_same() -> None:
    # A double point and one beside it, in units of 1e-9.
    answer = decompose(system("x y", "(x^2 - 2/10^30)*(x - 1)", "y^3 - x*y - 1/10^20"))
    for component in answer.components:
        found = sample(answer.system, component, 4, seed=1)
        assert len(found.points) == 4
        assert {p.tobytes() for p in found.points} <= {p.tobytes() for p in component.points}
