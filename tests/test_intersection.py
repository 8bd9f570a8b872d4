"""Intersections of components with each other and with equations."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from solved import components_of
from systems import system

import nag
from nag.decomposition import intersect_components, intersect_equations, sample
from nag.decomposition.decompose import decompose
from nag.decomposition.intersection import IntersectionError
from nag.files.cases import read_case
from nag.witness.membership import Membership, memberships
from nag.witness.witness import Decomposition

CASES = Path(__file__).parent.parent / "cases"


def kinds(found: Decomposition, accuracy: float = 1e-12) -> Counter[tuple[int, int]]:
    assert found.complete and not found.notes
    assert all(c.residual < 1e-12 and c.accuracy < accuracy for c in found.components)
    return Counter((c.dimension, c.degree) for c in found.components)


# Points at which equations vanish to a high order are known to fewer digits.
SINGULAR = 1e-9
SPHERE = "x^2 + y^2 + z^2 - 1"


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize(
    ("equations", "expected"),
    [
        (["x*y"], {(0, 1): 1}),
        (["x*(y - x^2)"], {(0, 1): 1}),
        (["(x - 2)*(x - 3)"], {}),
        ([f"({SPHERE})*(z - 1/2)"], {(1, 2): 1}),
        # The plane z = 1 touches the sphere in a point, and meets it in two complex lines.
        ([f"({SPHERE})*(z - 1)"], {(1, 1): 2}),
        ([f"({SPHERE})*(x - 1/2)", f"({SPHERE})*(y - 1/3)"], {(0, 1): 2}),
        (["(y - x^2)*(x - 2)", "(z - x^3)*(x - 2)"], {(0, 1): 1}),
        (["x^2 - 1", "y*(x - 1)"], {}),
    ],
)
def test_two_components_meet_where_algebra_says(equations, expected, seed: int) -> None:
    names = "x y" if "z" not in "".join(equations) and len(equations) == 1 else "x y z"
    both = decompose(system(names, *equations), seed=seed)
    assert len(both.components) == 2
    assert kinds(both.components[0].intersect(both.components[1], seed=seed)) == Counter(expected)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize(
    ("equations", "expected"),
    [
        ([f"({SPHERE})^2*(z - 1/2)"], {(1, 2): 1}),
        ([f"({SPHERE})^2*(z - 1/2)^2"], {(1, 2): 1}),
        ([f"({SPHERE})^3*(z - 1)^2"], {(1, 1): 2}),
        (["y^2*(y - x^2)"], {(0, 1): 1}),
        (["y^2*(y - x^2)^2"], {(0, 1): 1}),
        (["y*(y - x^3)^2"], {(0, 1): 1}),
        (["(y^2 - x^3)^3*y^2"], {(0, 1): 1}),
        # The plane meets the umbrella in its axis, twice, and in one more line.
        (["(x^2 - y^2*z)^2*x^2"], {(1, 1): 2}),
        (["(x^2 + y^2 - z^2)^2*z^2"], {(1, 1): 2}),
        (["(y - x^2)*z", "(z - x^3)^2*z"], {(0, 1): 1}),
        (["x^2*y", "x^2*z"], {(0, 1): 1}),
    ],
)
def test_double_components_meet_where_simple_ones_would(equations, expected, seed: int) -> None:
    names = "x y z" if "z" in "".join(equations) else "x y"
    both = decompose(system(names, *equations), seed=seed)
    assert len(both.components) == 2 and any(c.multiplicity > 1 for c in both.components)
    found = both.components[0].intersect(both.components[1], seed=seed)
    assert kinds(found, SINGULAR) == Counter(expected)
    if expected == {(0, 1): 1}:
        assert np.abs(found.components[0].points).max() < SINGULAR


def test_the_curves_of_two_rhombi_with_common_bars_meet_in_twelve_poses() -> None:
    case = read_case(CASES / "gonzalez.toml")
    curves = components_of(case.system)
    assert sorted(c.multiplicity for c in curves.components) == [1, 1, 1, 1, 2, 2]
    for i in range(6):
        assert kinds(curves.components[i].intersect(curves.components[i])) == {(1, 2): 1}
    meetings = [
        kinds(curves.components[i].intersect(curves.components[j]), SINGULAR)
        for i, j in combinations(range(6), 2)
    ]
    assert sorted(meetings, key=len) == [Counter()] * 3 + [Counter({(0, 1): 1})] * 12


@pytest.mark.slow
def test_a_set_that_deflation_does_not_reach_leaves_the_answer_open() -> None:
    case = read_case(CASES / "literature" / "adjacent-minors-3x4.toml")
    minors = components_of(case.system)
    found = minors.components[1].intersect(minors.components[5])
    assert not found.complete
    assert any("could not be made regular" in note for note in found.notes)


@pytest.mark.parametrize(
    "equations", [["x*z - y^2"], ["y - x^2", "z - x^3"], ["z^2", "x^2 - y"], ["x - 1", "y", "z"]]
)
def test_a_component_meets_itself_in_itself(equations) -> None:
    decomposition = decompose(system("x y z", *equations))
    (component,) = decomposition.components
    assert kinds(decomposition.components[0].intersect(decomposition.components[0])) == {
        (component.dimension, component.degree): 1
    }


def test_components_of_different_systems_meet() -> None:
    conic, line = system("x y", "x^2 + y^2 - 1"), system("x y", "x - y")
    first, second = decompose(conic).components[0], decompose(line).components[0]
    found = intersect_components(conic, first, second)
    assert kinds(found) == {(0, 1): 2}
    points = np.sort_complex(np.array([c.points[0, 0] for c in found.components]))
    assert np.abs(points - [-np.sqrt(0.5), np.sqrt(0.5)]).max() < 1e-15


@pytest.mark.parametrize(
    ("further", "expected"),
    [
        (["x^2 - y"], {(1, 4): 1}),
        (["z"], {(1, 2): 1}),
        (["z - 1"], {(1, 1): 2}),
        (["x", "y"], {(0, 1): 2}),
        (["x", "y", "z"], {}),
        (["0"], {(2, 2): 1}),
        ([SPHERE], {(2, 2): 1}),
        (["1"], {}),
        (["(x - 1/2)*(y - 1/2)", "(x - 1/2)*z"], {(1, 2): 1, (0, 1): 2}),
    ],
)
def test_a_component_meets_further_equations_where_algebra_says(further, expected) -> None:
    sphere = system("x y z", SPHERE)
    (component,) = decompose(sphere).components
    found = intersect_equations(sphere, component, system("x y z", *further))
    assert kinds(found) == Counter(expected)


def test_only_the_component_is_met_and_not_its_whole_system() -> None:
    both = system("x y z", f"({SPHERE})*(x - 5)")
    plane, sphere = decompose(both).components
    assert (plane.degree, sphere.degree) == (1, 2)
    further = system("x y z", "y")
    assert kinds(intersect_equations(both, plane, further)) == {(1, 1): 1}
    assert kinds(intersect_equations(both, sphere, further)) == {(1, 2): 1}


def test_what_an_intersection_finds_can_be_worked_with() -> None:
    both = decompose(system("x y z", f"({SPHERE})*(z - 1/2)"))
    (circle,) = both.components[0].intersect(both.components[1]).components
    x = sample(both.system, circle, 5).points
    assert np.abs(x[:, 2] - 0.5).max() < 1e-14
    squares = x[:, 0] ** 2, x[:, 1] ** 2
    sizes = 0.75 + sum(map(np.abs, squares))
    assert (np.abs(sum(squares) - 0.75) < 1e-14 * sizes).all()


def test_the_curves_of_the_rhombus_cross_in_its_flat_poses() -> None:
    case = read_case(CASES / "rhombus.toml")
    rhombus = decompose(case.system)
    assert len(rhombus.components) == 3
    poses = []
    for i, j in combinations(range(3), 2):
        found = rhombus.components[i].intersect(rhombus.components[j])
        assert kinds(found) == {(0, 1): 1}
        (pose,) = found.components[0].points
        rounded = np.round(pose.real)
        assert np.abs(pose - rounded).max() < 1e-12
        assert set(rounded.tolist()) <= {-1.0, 0.0, 1.0}
        for seed in range(4):
            # Slices through rounded poses pass beside the crossing, or not, as rounding has it.
            answers = memberships(rhombus, rounded, seed=seed)
            assert [k for k in range(3) if answers[k] is Membership.MEMBER] == [i, j]
        poses.append(tuple(rounded.tolist()))
    assert len(set(poses)) == 3


def test_the_same_seed_gives_the_same_intersection_for_any_number_of_threads() -> None:
    both = decompose(system("x y z", f"({SPHERE})*(z - 1/2)"))
    first, second = (
        both.components[0].intersect(both.components[1], seed=3, threads=threads)
        for threads in (1, 2)
    )
    assert first == second


def test_a_point_that_deflation_does_not_reach_is_not_passed_over() -> None:
    lines = system("x y", "x*y")
    first = next(c for c in decompose(lines).components if abs(c.points[0, 0]) < 1e-12)
    found = intersect_equations(lines, first, system("x y", "y"))
    # The two systems together cannot tell the point in which x = 0 meets y = 0 from that line.
    assert [c.dimension for c in found.components] == [0] and found.complete
    assert np.abs(found.components[0].points).max() < 1e-12


def test_different_variables_are_refused() -> None:
    conic = system("x y", "x^2 + y^2 - 1")
    with pytest.raises(IntersectionError, match="variables differ: x, y and x, z"):
        intersect_equations(conic, decompose(conic).components[0], system("x z", "x"))


@pytest.mark.parametrize("seed", range(3))
def test_a_component_that_is_not_reduced_meets_equations(seed: int) -> None:
    # Its points are kept with unknowns that deflation added.
    circle = decompose(system("x y z", "x^2 + y^2 - 1", "z^2 + x*(x^2 + y^2 - 1)"), seed=seed)
    (component,) = circle.components
    assert component.multiplicity == 2 and component.fibres[0].cut.aux
    found = intersect_equations(
        circle.system, component, system("x y z", "(x - y)*(4*x - 3*y)"), seed=seed
    )
    assert found.complete and kinds(found) == {(0, 1): 4}
    sides = {abs(round(float(c.points[0, 0].real), 9)) for c in found.components}
    assert sides == {0.6, round(0.5**0.5, 9)}


@pytest.mark.parametrize(
    "equations",
    [
        ["(x^2 + y^2 - 1)*(x^2 + y^2 - 1 - 1/10^16)"],
        ["(x + y + z)*(x + y + z + (y - 2)/10^20)"],
        ["((x - 10^5)*(y - 2*10^5) - z - 3*10^5)*((x - 10^5)*(y - 2*10^5) - z - 3*10^5 - 1)"],
    ],
)
@pytest.mark.parametrize("seed", [0, 1])
def test_components_beside_each_other_are_never_said_to_be_one(
    equations: list[str], seed: int
) -> None:
    whole = nag.decompose(equations, seed=seed)
    assert whole.complete and len(whole.components) == 2
    found = whole.components[0].intersect(whole.components[1], seed=seed)
    larger = max(c.dimension for c in whole.components)
    assert not (found.complete and any(c.dimension == larger for c in found.components))


def test_components_whose_linear_equations_contradict_each_other_do_not_meet() -> None:
    whole = nag.decompose(["y*(x^2 - 1)", "y*(y - 1/10^20)"])
    assert [c.dimension for c in whole.components] == [1, 0, 0]
    found = whole.components[0].intersect(whole.components[1])
    assert found.complete and not found.components


@pytest.mark.parametrize("digits", [3, 5, 7, 9, 12, 15])
@pytest.mark.parametrize("seed", [0, 1])
def test_concentric_circles_do_not_meet_however_close_they_are(digits: int, seed: int) -> None:
    whole = nag.decompose(f"(x^2 + y^2 - 1)*(x^2 + y^2 - 1 - 1/10^{digits})", seed=seed)
    found = whole.components[0].intersect(whole.components[1], seed=seed)
    assert found.complete and not found.components


@pytest.mark.parametrize("digits", [4, 8, 12])
@pytest.mark.parametrize(
    "equation",
    ["({f})*({f} + ({g})/10^{k})", "({f})^2 - 2*({g})^2/10^(2*{k})"],
)
def test_components_that_are_close_to_each_other_meet_where_they_cross(
    equation: str, digits: int
) -> None:
    # They are f = 0 and f + e g = 0, which meet where f = g = 0.
    f, g = "2*x^2 - 3*x*y + y^2 + x - 5", "x + 4*y - 2"
    whole = nag.decompose(equation.format(f=f, g=g, k=digits))
    assert whole.complete and [c.degree for c in whole.components] == [2, 2]
    found = whole.components[0].intersect(whole.components[1])
    assert kinds(found, SINGULAR) == {(0, 1): 2}
    right = [c.points[0] for c in nag.decompose([f, g]).components]
    near = [min(np.abs(x - c.points[0]).max() for x in right) for c in found.components]
    assert max(near) < SINGULAR


@pytest.mark.parametrize("digits", [6, 13])
def test_sheets_of_one_component_meet_a_line_in_as_many_points(digits: int) -> None:
    whole = nag.decompose(f"(y^2 - (x + 2)/10^{2 * digits})*(x - 2)")
    assert whole.complete and [c.degree for c in whole.components] == [1, 2]
    for found in (
        whole.components[0].intersect(whole.components[1]),
        intersect_equations(whole.system, whole.components[1], system("x y", "x - 2")),
    ):
        points = [c.points[0, 1].real * 10**digits for c in found.components]
        assert not found.complete or sorted(np.round(points, 6)) == [-2.0, 2.0]


def test_a_point_at_which_doubles_see_no_rank_is_cut_in_digits() -> None:
    line, point = ["x - 5", "y - z"], ["y - x^2", "y - x^2 - (x - 1)/10^12", "z - 1"]
    found = nag.decompose([f"({a})*({b})" for a in line for b in point])
    curve, isolated = found.components
    assert (curve.dimension, isolated.dimension) == (1, 0)
    # As read from an export that holds no equations that cut it.
    bare = replace(isolated, fibres=())
    assert not intersect_components(found.system, curve, bare).components
    assert kinds(intersect_components(found.system, bare, bare)) == {(0, 1): 1}
