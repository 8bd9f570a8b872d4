"""Singular points of components, intersections, tangent cones, parameters with singular points."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from fractions import Fraction

import jsonschema
import numpy as np
import pytest
from linkages import CASES
from local_points import plain
from singular_zeros import polynomials

import nag
from nag.algebra.evaluation import Evaluator
from nag.algebra.expression import parse_number
from nag.bench.atlas.linkages import slider_crank
from nag.cli import main
from nag.decomposition.linear_hull import add_hull_equations
from nag.decomposition.reduction import Reduction
from nag.decomposition.singular_points import SingularLocus, singular_locus
from nag.files.json_schema import schema
from nag.numerics.tangent_cone import tangent_cone
from nag.tracking.run import Run


def locus_of(name: str) -> tuple[nag.PolynomialSystem, SingularLocus]:
    system = nag.read_case(CASES / f"{name}.toml").system
    assert system is not None
    return system, singular_locus(nag.decompose(system))


def places(locus: SingularLocus) -> set[tuple[int, ...]]:
    """The isolated singular points, which have integer coordinates here."""
    points = np.array([one.points[0] for one in locus.sets if one.dimension == 0])
    assert np.abs(points - np.rint(points.real)).max() < 1e-14
    return {tuple(np.rint(x.real).astype(int).tolist()) for x in points}


def test_the_slider_crank_has_two_cones() -> None:
    system, locus = locus_of("slider-crank")
    assert locus.complete and locus.smooth == ()
    assert places(locus) == {(0, 1, 0, -1, 0, -1), (0, -1, 0, 1, 0, 1)}
    for one in locus.sets:
        assert (one.essential, one.intersection, one.multiplicities) == ((0,), False, {0: 2})
        assert (one.local.tangent_dimension, one.local.dimension) == (3, 2)
        assert one.cone is not None and one.cone.dimension == 2
        assert one.cone.text(system.variables) == "2*c1^2 - c2^2 - c3^2 = 0"


@pytest.mark.parametrize("seed", [0, 11, 13, 15])
def test_nodes_of_slider_cranks_are_all_found(seed: int) -> None:
    # On the way, a double zero meets its equations in doubles 1.5e-8 beside it.
    problem = slider_crank(0, np.random.default_rng([seed, 20]))
    whole = nag.decompose(problem.system, seed=seed)
    locus = singular_locus(whole, seed=seed)
    assert (locus.complete, locus.notes) == (True, ())
    found = sorted(tuple(np.round(one.points[0].real).astype(int)) for one in locus.sets)
    assert found == [(0, -1, 0, 1, 0, 1), (0, 1, 0, -1, 0, -1)]


def test_the_curves_of_the_rhombus_are_smooth_and_meet_in_pairs() -> None:
    _, locus = locus_of("rhombus")
    assert locus.complete and locus.smooth == (0, 1, 2)
    assert places(locus) == {(1, 0, 1, 0, 1, 0), (-1, 0, 1, 0, -1, 0), (1, 0, -1, 0, -1, 0)}
    assert all(one.intersection and not one.essential for one in locus.sets)
    assert {tuple(one.multiplicities) for one in locus.sets} == {(0, 1), (0, 2), (1, 2)}
    assert locus.proved == (0, 1, 2)


def test_components_of_two_rhombi_meet_in_circles_and_points() -> None:
    _, locus = locus_of("double-rhombus")
    assert locus.complete and locus.proved == locus.smooth == tuple(range(9))
    found = Counter((one.dimension, one.degree, len(one.multiplicities)) for one in locus.sets)
    assert found == {(1, 2, 2): 18, (0, 1, 4): 9}
    assert {(one.local.tangent_dimension, one.local.dimension) for one in locus.sets} == {
        (3, 2),
        (4, 2),
    }


def test_a_component_is_cut_by_the_equations_of_its_linear_hull() -> None:
    answer = nag.decompose(["(x - y)*(x^2 + y^2 - 1)", "z^2 - x^2 - 3*x*(x - y)"])
    rng, tracker = np.random.default_rng(3), Run()
    found = [add_hull_equations(answer.system, c, rng, tracker) for c in answer.components]
    left = [Reduction.of(system).n for system, _ in found]
    assert sorted(zip(left, [c.degree for c in answer.components], strict=True)) == [
        (1, 1),
        (1, 1),
        (3, 4),
    ]
    for (system, _), component in zip(found, answer.components, strict=True):
        assert Evaluator.of(system.polynomials, 3).residuals(component.points).max() < 1e-14


def test_a_multiple_component_is_judged_by_equations_of_its_own() -> None:
    """A nodal cubic that is double in the system."""
    found = nag.decompose(
        [
            "z*(x + y + 1) + w*(x - 3)",
            "z^2 + w*z*x",
            "w^2 + z*w + z^2*(y - 4)",
            "y^2 - x^3 - x^2 + z*x + w*y",
        ]
    )
    i = next(i for i, c in enumerate(found.components) if c.multiplicity > 1)
    locus = singular_locus(found)
    assert locus.complete and i in locus.examined
    [node] = locus.sets
    assert node.multiplicities == {i: 2}
    assert np.abs(node.points).max() < 1e-12


def test_no_component_of_two_rhombi_between_fixed_bars_is_singular_itself() -> None:
    """Two of the six are multiple."""
    _, locus = locus_of("gonzalez")
    assert locus.complete and locus.smooth == locus.proved == tuple(range(6))
    assert all(one.intersection and not one.essential for one in locus.sets)
    assert len(locus.sets) == 4


@pytest.mark.parametrize("name", ["bricard-variety", "bennett-variety"])
def test_varieties_of_single_loops_are_smooth(name: str) -> None:
    _, locus = locus_of(name)
    assert (locus.complete, locus.sets, locus.smooth) == (True, (), (0,))
    assert locus.proved == (0,)


@pytest.mark.parametrize("name", ["whitney-umbrella", "cuspidal-edge"])
def test_a_double_line_of_a_surface_is_essential(name: str) -> None:
    _, locus = locus_of(f"literature/{name}")
    (one,) = locus.sets
    assert (one.dimension, one.degree, one.multiplicities, one.intersection) == (
        1,
        1,
        {0: 2},
        False,
    )
    assert np.abs(one.points[0, :2]).max() < 1e-14
    assert locus.complete and locus.smooth == ()


# Singular points, and the multiplicities of the components there.
KINDS = {
    "a node and a line through it": (
        ("x y", "(y^2 - x^3 - x^2)*(y - 2*x)"),
        {(((0, 0)), frozenset({1, 2})), (((3, 6)), frozenset({1}))},
    ),
    "a cusp": (("x y", "y^2 - x^3"), {((0, 0), frozenset({2}))}),
    "a triple point": (("x y", "x^3 - x^2*y + y^3 + x^4"), {((0, 0), frozenset({3}))}),
    "a line that meets a plane": (("x y z", "x*y, x*z"), {((0, 0, 0), frozenset({1}))}),
    "lines that do not meet": (("x y z", "x*(x - 1), y*x + z*(x - 1), (x - 1)*y"), set()),
    "a smooth conic": (("x y", "x^2 + y^2 - 1"), set()),
}


@pytest.mark.parametrize("name", sorted(KINDS))
def test_multiplicities_tell_essential_singular_points_from_intersections(name: str) -> None:
    (variables, equations), expected = KINDS[name]
    system = plain(polynomials(variables, *equations.split(", ")))
    locus = singular_locus(nag.decompose(system))
    found = {
        (tuple(np.rint(one.points[0].real).astype(int).tolist()), _values(one.multiplicities))
        for one in locus.sets
    }
    assert locus.complete, locus.notes
    assert found == expected and len(locus.sets) == len(expected)


def _values(multiplicities: dict[int, int]) -> frozenset[int]:
    return frozenset(multiplicities.values())


@pytest.mark.parametrize(("third", "seed"), [("f", 0), ("(a + b + c)", 1)])
def test_a_cone_that_more_equations_cut_than_its_codimension(third: str, seed: int) -> None:
    """Matrices of rank one: random combinations of minors are singular along sets through 0."""
    minors = [f"a*{third} - c*d", f"b*{third} - c*e", "a*e - b*d"]
    locus = singular_locus(nag.decompose(minors, seed=seed), seed=seed)
    assert locus.complete
    (vertex,) = locus.sets
    assert (vertex.dimension, vertex.multiplicities) == (0, {0: 3})
    assert np.abs(vertex.points).max() < 1e-12


def test_a_singular_line_that_is_found_twice_is_one() -> None:
    """The cone over the twisted cubic times a line."""
    equations = ["x*z - y^2 + 0*v", "y*w - z^2", "x*w - y*z"]
    locus = singular_locus(nag.decompose(nag.system(equations, "x y z w v")))
    assert [(one.dimension, one.degree, one.multiplicities) for one in locus.sets] == [
        (1, 1, {0: 3})
    ]
    assert locus.complete


def test_tangent_cones_are_the_terms_of_lowest_order() -> None:
    def cone(equations: Iterable[str], point: list, variables: str = "x y z") -> str:
        system = plain(polynomials(variables, *equations))
        found = tangent_cone(system, [parse_number(str(c)) for c in point])
        assert found is not None
        return found.text(variables.split())

    assert cone(["x^2 + y^2 - z^2 + x^3"], [0, 0, 0]) == "x^2 + y^2 - z^2 = 0"
    assert cone(["y^2 - x^2*(x + 1)", "z - x*y"], [0, 0, 0]) == "x^2 - y^2 = 0"
    assert cone(["y^2 - x^3"], [0, 0], "x y") == "y^2 = 0"
    moved = "(x - sqrt(2))^3 + (x - sqrt(2))*(y - 1) + 3*(y - 1)^3"
    assert cone([moved], ["sqrt(2)", 1], "x y") == "x*y = 0"


def test_tangent_cones_with_irrational_coefficients_have_them_in_decimals() -> None:
    """A node at sqrt(2), where y^2 = 8 (sqrt(2) + 5) x^2 to lowest order, and one at i."""
    found = tangent_cone(nag.system("y^2 - (x^2 - 2)^2*(x + 5)"), [parse_number("sqrt(2)"), 0])
    assert found is not None
    assert found.text("xy") == f"x^2 - {1 / (8 * (2**0.5 + 5)):.8g}*y^2 = 0"
    found = tangent_cone(nag.system("y^2 + (x^2 + 1)^2*(x + 5)/4"), np.array([1e-9 + 1j, 0]))
    assert found is not None
    assert found.text("xy") == "x^2 + (-0.19230769+0.038461538i)*y^2 = 0"


def test_it_is_said_that_a_tangent_cone_has_equations_of_higher_degree() -> None:
    """The cone of x y = 0, z^3 = x^4 + y^4 is x y = 0, z^3 = 0."""
    equations = ["x*y", "z^3 - x^4 - y^4"]
    (origin,) = singular_locus(nag.decompose(equations)).sets
    lines = [text for _, text in origin.rows("xyz")]
    assert any("x*y = 0" in text and "further equations" in text for text in lines)
    (node,) = singular_locus(nag.decompose("y^2 - x^2*(x + 1)")).sets
    assert not any("further" in text or "not found" in text for _, text in node.rows("xy"))


def test_equations_of_the_tangent_space_are_those_of_first_order() -> None:
    system = nag.system(["y^2 - x^2*(x + 1)", "z - 3*x + x*y"], "x y z")
    found = tangent_cone(system, [0, 0, 0])
    assert found is not None
    assert (found.text("xyz"), found.tangent_text("xyz")) == ("9*y^2 - z^2 = 0", "3*x - z = 0")
    crank = nag.read_case(CASES / "slider-crank.toml").system
    assert crank is not None
    found = tangent_cone(crank, [0, 1, 0, -1, 0, -1])
    assert found is not None
    assert found.tangent_text(crank.variables) == "s1 = 0, s2 = 0, s3 = 0"


def test_a_rounded_singular_point_has_the_same_cone() -> None:
    system = plain(polynomials("x y", "(x - 1/3)^2 - 5*(y - 2)^2 + (y - 2)^5"))
    found = tangent_cone(system, np.array([1 / 3 + 1e-10, 2]))
    assert found is not None and found.text(["x", "y"]) == "x^2 - 5*y^2 = 0"
    assert found.forms[0][(2, 0)] == Fraction(1)


def test_the_lengths_with_singular_slider_cranks_are_found(tmp_path, capsys) -> None:
    file = tmp_path / "lengths.json"
    case = str(CASES / "slider-crank.toml")
    assert main(["singular", case, "--free", "L1, L2, L3", "--quiet", "--json", str(file)]) == 0
    assert "singular  L1 - L2 - L3 = 0" in capsys.readouterr().out
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-singular-parameters"))
    # PT13 7.2 leaves out the sum, which is zero for no lengths.
    assert {c[0] for c in document["conditions"] if len(c) == 1} == {
        "L1 + L2 + L3",
        "L1 - L2 - L3",
        "L1 + L2 - L3",
        "L1 - L2 + L3",
    }
    assert all(len(c) == 1 for c in document["conditions"])


def test_the_command_writes_what_its_schema_says(tmp_path, capsys) -> None:
    file = tmp_path / "singular.json"
    case = str(CASES / "rhombus.toml")
    assert main(["singular", case, "--quiet", "--component", "1", "--json", str(file)]) == 0
    assert "2 isolated singular points" in capsys.readouterr().out
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-singular"))
    assert document["examined"] == document["smooth"] == [1]
    for arguments in (["--component", "4"], ["--free", "c"], ["--free", "a,a"]):
        assert main(["singular", case, "--quiet", *arguments]) == 2
        assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("exponent", [12, 16, 20])
def test_three_lines_that_nearly_pass_through_one_point_meet_in_three(exponent: int) -> None:
    locus = singular_locus(nag.decompose(f"x*(y - x)*(x + y - 2 - 1/10^{exponent})*(x - 1)"))
    meeting = Counter(tuple(one.multiplicities) for one in locus.sets)
    assert locus.complete and len(locus.sets) == 5
    assert set(meeting.values()) == {1} and {len(pair) for pair in meeting} == {2}


def test_sheets_that_come_near_to_each_other_and_do_not_meet_are_smooth() -> None:
    locus = singular_locus(nag.decompose("(y - x^2)*(y - x^2 - 1/10^25)"))
    assert not locus.sets and locus.complete


def test_what_is_smooth_is_told_before_all_is_known() -> None:
    told: list[SingularLocus] = []
    found = nag.decompose("(y - x^2)*(y^2 - x^3)")
    locus = singular_locus(found, run=Run(found=told.append))
    assert [one.complete for one in told] == [False] * 3
    assert set(told[-1].smooth) == set(locus.smooth) and len(locus.smooth) == 1
    assert all("ended early" in one.notes[0] for one in told)


def test_the_command_tells_the_components_first(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["singular", str(CASES / "planar" / "four-bar-rhombus.toml"), "--quiet"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert (
        lines[2]
        == "of      3 components of dimension 1, degree 2, whose singular points are looked for"
    )


@pytest.mark.parametrize("factor", ["(x - 1)^2", "(x^2 - 2)^3"])
def test_multiple_points_are_singular_with_their_multiplicity(factor: str) -> None:
    found = nag.singular([f"{factor}*x", "y*x"])
    assert found.complete
    power, count = int(factor[-1]), 2 if "^2 -" in factor else 1
    points = np.sort(np.array([one.points[0, 0] for one in found.sets]).real)
    assert np.abs(points - ([1] if count == 1 else [-(2**0.5), 2**0.5])).max() < 1e-14
    for one in found.sets:
        (multiplicity,) = one.multiplicities.values()
        assert multiplicity == power and one.essential
        assert (one.local.tangent_dimension, one.local.dimension) == (1, 0)


def test_a_component_is_not_smooth_because_its_equations_lose_rank_on_more_than_its_points() -> (
    None
):
    # Of the matrices of rank one two of the three minors are given; that of no entries is singular.
    found = nag.singular(nag.system(["a*e - b*d", "b*f - c*e"], "a b c d e f"))
    (minors,) = (
        i for i, c in enumerate(nag.decompose(["a*e - b*d", "b*f - c*e"])) if c.degree == 3
    )
    assert minors not in found.smooth and not found.complete
    assert any("its equations lose rank" in note for note in found.notes)
    whole = nag.singular(["a*e - b*d", "b*f - c*e", "a*f - c*d"])
    (origin,) = whole.sets
    assert origin.dimension == 0 and whole.complete
