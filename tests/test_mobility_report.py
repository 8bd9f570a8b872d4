"""nag.mobility and nag mobility: counted, tangent and local mobility, and what they mean."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from typing import Any

import jsonschema
import numpy as np
import pytest
from linkages import CASES, case, exact, four_bar, general_loop, loop, spherical_four_bar
from local_points import sarrus

import nag
from nag.algebra.number import square_root
from nag.cli import main
from nag.decomposition import components_through
from nag.decomposition.growth import grow_component
from nag.files.json_schema import schema
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.problem import Problem
from nag.numerics.local_dimension import NoSolution
from nag.text.progress_line import ProgressLine

Z = (0, 0, 1)


def bars(*points: tuple) -> Mechanism:
    """A planar loop of bars from point to point."""
    return loop([(*p, 0) for p in points], [Z] * len(points))


# counted, tangent dimension, local dimension, dimensions of the components, status
REPORTS = {
    "Bennett": (case("bennett"), -2, 1, 1, {1}, "overconstrained"),
    "Bricard": (case("bricard-cube"), 0, 1, 1, {1}, "overconstrained"),
    "Sarrus": (sarrus(), 0, 1, 1, {1}, "overconstrained"),
    "parallelogram": (four_bar(), 1, 1, 1, {1}, "mobile"),
    "spherical": (spherical_four_bar(), 1, 1, 1, {1}, "mobile"),
    "flat parallelogram": (
        bars((0, 0), (1, 0), (3, 0), (2, 0)),
        *(1, 2, 1, {1}, "at a crossing of components"),
    ),
    "five axes": (general_loop(5, 1), -1, 0, 0, {0}, "rigid"),
    "a triangle": (bars((0, 0), (2, 0), (1, 1)), 0, 0, 0, {0}, "rigid"),
    "a flat triangle": (bars((0, 0), (3, 0), (2, 0)), 0, 1, 0, {0}, "shaky"),
}


@pytest.mark.parametrize("name", sorted(REPORTS))
def test_what_a_mechanism_does_at_its_reference_configuration(name: str) -> None:
    mechanism, *numbers, dimensions, status = REPORTS[name]
    report = nag.mobility(mechanism)
    found = [report.gruebler_kutzbach, report.tangent_dimension, report.local_dimension]
    assert found == numbers
    assert report.status == status, report
    assert report.components is not None and {d for d, _ in report.components} == dimensions
    # A degree is told, with what it belongs to, where something moves.
    assert len(str(report).splitlines()) == 5 + (max(dimensions) > 0)


def legs(*feet: tuple[int, int]) -> Mechanism:
    """A platform on parallel legs of equal lengths, with spherical joints at both ends."""
    joints = []
    for i, foot in enumerate(feet):
        for below, above, height in (("base", f"leg{i}", 0), (f"leg{i}", "platform", 8)):
            name = f"{below}{i}-{above}"
            joints.append(Joint(name, "spherical", (below, above), exact(*foot, height)))
    return Mechanism("base", tuple(joints))


def test_all_motions_that_meet_at_a_reference_are_told_on_every_seed() -> None:
    # Sheets touch there: a slice beside the point meets them in several points next to it.
    made = nag.model(legs((5, 0), (4, 3), (0, 5), (-4, 3)))
    answer = nag.decompose(made)
    found = [(c.dimension, c.degree, c.multiplicity) for c in answer.components]
    assert answer.complete and found == [(2, 2, 2), (2, 12, 1), (2, 12, 1)]
    at = np.array(made.reference, dtype=complex)
    for seed in range(6):
        assert components_through(answer, at, exact=made.reference, seed=seed) == [0, 1, 2]


def test_a_shaky_structure_has_its_multiplicity() -> None:
    report = nag.mobility(REPORTS["a flat triangle"][0])
    assert report.multiplicity == 2
    assert "isolated solution of multiplicity 2" in report.sentence


def test_joints_outside_loops_add_their_freedoms() -> None:
    arm = Joint("arm", "revolute", ("B1", "hand"), (Fraction(9), Fraction(0), Fraction(0)), Z)
    base = four_bar()
    report = nag.mobility(Mechanism(base.ground, (*base.joints, arm), base.bodies))
    assert (report.local_dimension, report.tangent_dimension, report.free) == (2, 2, 1)
    assert {d for d, _ in report.components} == {2}
    chain = nag.mobility(Mechanism("B1", (arm,)))
    assert (chain.local_dimension, chain.status, chain.components) == (1, "mobile", None)


def test_rods_add_their_turns_about_themselves_in_every_formulation() -> None:
    by_rods = nag.mobility(case("spatial/rssr"), formulation="S")
    whole = nag.mobility(case("spatial/rssr"), formulation="E")
    assert (by_rods.free, by_rods.local_dimension, by_rods.tangent_dimension) == (1, 2, 2)
    assert by_rods.same_motion(whole) and whole.free == 0
    assert "1 by rods that turn idly about themselves" in str(by_rods)


def test_another_configuration_may_be_given() -> None:
    mechanism = REPORTS["flat parallelogram"][0]
    tilted = nag.mobility(mechanism, [1, 0, "3/5", Fraction(4, 5)], formulation="E")
    assert (tilted.tangent_dimension, tilted.local_dimension, tilted.status) == (1, 1, "mobile")
    angle = ["1", "0", "0.5403023058681398", "0.8414709848078965"]
    turned = nag.mobility(mechanism, angle, formulation="E")
    assert turned.components == tilted.components and not turned.open
    assert nag.mobility(mechanism, [float(x) for x in angle], formulation="E").status == "mobile"
    rounded = nag.mobility(mechanism, [1.0, 1e-12, 1.0, 0.0], formulation="E", detail="local")
    assert (rounded.tangent_dimension, rounded.local_dimension) == (2, 1)
    with pytest.raises(NoSolution):
        nag.mobility(mechanism, [2, 0, 1, 0], formulation="E", detail="local")


def test_an_isolated_configuration_is_none_of_those_that_are_far_off() -> None:
    # One of the 16 configurations has a half-angle of tangent -161.
    points = [(1, 4, -1), (0, 1, -4), (1, 0, -4), (3, -4, 3), (3, -3, 5), (-1, 0, -1)]
    axes = [(-3, 4, 2), (2, -3, -1), (1, 1, 4), (1, -2, -1), (1, 2, -2), (-3, 2, -4)]
    report = nag.mobility(loop(points, axes))
    assert report.components == ((0, 1),) and report.status == "rigid"


# Points and axes of a robot arm with a held hand, as they stand in files of doubles.
ARM = (
    [
        "-0.5451183290109842 -0.2828777967976045 0.2648259038808266",
        "0 0 0",
        "0 0 0.089159",
        "-0.1841681936025738 -0.05696989830639916 0.46792212802611005",
        "-0.5421621410767345 -0.16771040340100046 0.35200432696319967",
        "-0.5099061105196493 -0.27198538118906035 0.35200432696319967",
    ],
    [
        "-0.5055691960999009 -0.8070621088590519 0.3050418666328928",
        "0 0 1",
        *["0.29552020666133955 -0.955336489125606 6.123233995736766e-17"] * 3,
        "-0.37202555194225967 -0.11508098899676876 -0.9210609940028851",
    ],
)


def test_an_arm_in_full_doubles_is_at_one_of_its_eight_configurations() -> None:
    # Right angles and parallels hold to rounding, so that the Jacobian is singular to rounding.
    points, axes = ([tuple(text.split()) for text in texts] for texts in ARM)
    report = nag.mobility(loop(points, axes))
    assert report.components == ((0, 1),) and report.status == "rigid" and not report.open


# Local dimension, tangent dimension, status, and what another formulation is.
GENERAL = {
    "spatial/bennett": (1, 1, "overconstrained", "E"),
    "spatial/assembled-4r": (0, 0, "rigid", "E"),
    "planar/henneberg-6": (0, 0, "rigid", "coordinates (x, y)"),
    "planar/watt-six-bar": (1, 1, "mobile", "pins"),
    "spatial/octahedron": (0, 0, "rigid", "A-B-F pinned"),
}


@pytest.mark.parametrize("name", sorted(GENERAL))
def test_parts_are_taken_at_a_general_configuration_in_any_formulation(
    name: str, tmp_path, capsys
) -> None:
    file = tmp_path / "mobility.json"
    path = str(CASES / f"{name}.toml")
    assert main(["mobility", path, "--check", "--json", str(file), "--quiet"]) == 0
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-mobility"))
    keys = ("local_dimension", "tangent_dimension", "status")
    assert (*(document[key] for key in keys), document["check"]["formulation"]) == GENERAL[name]
    assert document["check"]["agrees"]
    capsys.readouterr()


def test_parts_that_do_not_fit_are_answered_with_one_line(tmp_path, capsys) -> None:
    file = tmp_path / "loop.toml"
    rows = "{a = 1, alpha = 0}, " * 3 + '{a = 1, alpha = "pi/2"}'
    file.write_text(f'title = "t"\nkind = "dh"\njoint = [{rows}]\n')
    assert main(["mobility", str(file), "--quiet"]) == 2
    error = capsys.readouterr().err
    assert "it cannot be assembled, not even with complex coordinates; a table of fewer" in error
    assert main(["mobility", str(file), "--local", "--quiet"]) == 2
    assert "give --at, or leave out --local" in capsys.readouterr().err


def test_a_framework_by_lengths_is_placed_by_x_and_y(tmp_path, capsys) -> None:
    file = tmp_path / "framework.toml"
    file.write_text(
        """
title = "A rhombus"
kind = "framework"
points = ["A", "B", "C", "D"]
bars = [["A", "B"], ["B", "C"], ["C", "D"], ["D", "A"]]
lengths = [2, 2, 2, 2]
"""
    )
    at = ["--at", "x_C = 8/5, y_C = 4/5, x_D = 3/5, y_D = 4/5", "--check", "--quiet"]
    assert main(["mobility", str(file), *at]) == 0
    assert "it moves with 1 freedom" in capsys.readouterr().out
    assert main(["mobility", str(file), "--at", "x_C = 2, y_C = 1, x_D = 0, y_D = 0"]) == 2
    assert "is no configuration" in capsys.readouterr().err


def test_the_command_writes_what_its_schema_says(tmp_path, capsys) -> None:
    file = tmp_path / "mobility.json"
    arguments = ["mobility", "--quiet", "--json", str(file)]
    assert main([*arguments, str(CASES / "bennett.toml")]) == 0
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-mobility"))
    assert document["local_dimension"] == document["tangent_dimension"] == 1
    assert (document["gruebler_kutzbach"], document["check"]) == (-2, None)
    capsys.readouterr()
    assert main([*arguments, "--check", str(CASES / "planar-four-bar.toml")]) == 0
    assert "unknowns, agrees" in capsys.readouterr().out
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-mobility"))
    assert document["check"]["agrees"] is True


def test_bad_input_is_one_line(tmp_path, capsys) -> None:
    for arguments in (
        [str(CASES / "slider-crank.toml")],
        [str(tmp_path / "none.toml")],
        [str(CASES / "bennett.toml"), "--at", "x_J1 = 0, x_J2 = 0"],
        [str(CASES / "bennett.toml"), "--at", "x_J1 = 0"],
    ):
        assert main(["mobility", *arguments]) == 2
        assert capsys.readouterr().err.count("\n") == 1


@pytest.fixture
def lost_paths(monkeypatch: pytest.MonkeyPatch) -> None:
    """Decompositions lose paths, as those of arms and linkages in full doubles may."""
    whole = Problem.decompose

    def lose_paths(problem: Problem, **options: Any) -> nag.Decomposition:
        return replace(whole(problem, **options), complete=False, notes=("3 paths failed",))

    monkeypatch.setattr(Problem, "decompose", lose_paths)


def test_the_component_through_a_smooth_point_is_reached_from_there(lost_paths: None) -> None:
    for name, degree in (("Bennett", 2), ("spherical", 4), ("five axes", 1)):
        for detail in ("through", "components"):
            report = nag.mobility(REPORTS[name][0], detail=detail)
            assert report.components == ((report.local_dimension, degree),) and not report.open


def test_what_is_certain_of_a_smooth_point_is_said_where_the_degree_is_not(
    lost_paths: None,
) -> None:
    report = nag.mobility(REPORTS["Bennett"][0], detail="components", budget=0)
    assert report.components == ((1, None),) and report.status == "overconstrained"
    assert "1 through the configuration: dimension 1, reduced, degree 1 at least" in str(report)
    assert "the decomposition is incomplete: 3 paths failed" in report.open
    # Two components cross there, whatever is known of them.
    crossing = nag.mobility(REPORTS["flat parallelogram"][0])
    assert "not known: the decomposition is incomplete: 3 paths failed" in str(crossing)
    assert "smooth" not in str(crossing)


@pytest.fixture
def no_decomposition(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever decomposes fails."""

    def refuse(problem: Problem, **options: Any) -> nag.Decomposition:
        raise AssertionError("nothing is to be decomposed")

    monkeypatch.setattr(Problem, "decompose", refuse)


@pytest.mark.parametrize("name", ["Bennett", "Bricard", "Sarrus", "parallelogram", "spherical"])
def test_at_a_smooth_point_nothing_else_is_decomposed(name: str, no_decomposition: None) -> None:
    mechanism, *_, status = REPORTS[name]
    report = nag.mobility(mechanism)
    assert report.status == status and report.least_degree is None and not report.open
    assert report.rests_on.startswith("one component passes through a smooth point")
    short = nag.mobility(mechanism, budget=0)
    assert short.components == ((1, None),) and short.least_degree == 1 and not short.open
    assert (short.status, short.sentence) == (report.status, report.sentence)


@pytest.mark.parametrize("name", ["Bennett", "parallelogram", "spherical"])
def test_the_degree_from_the_point_is_that_of_a_decomposition(name: str) -> None:
    by_loops, whole = (nag.mobility(REPORTS[name][0], detail=d) for d in ("through", "components"))
    assert by_loops.components == whole.components
    assert whole.rests_on == "a decomposition of all configurations"


def test_a_bounded_degree_is_a_complete_answer_and_the_same_on_any_machine(
    tmp_path, capsys, no_decomposition: None
) -> None:
    file = tmp_path / "mobility.json"
    asked = ["mobility", str(CASES / "bennett.toml"), "--budget", "0", "--quiet"]
    answers = []
    for threads in ("1", "2"):
        assert main([*asked, "--json", str(file), "--threads", threads]) == 0
        document = json.loads(file.read_text())
        jsonschema.validate(document, schema("nag-mobility"))
        answers.append(document)
    assert answers[0] == answers[1] and answers[0]["complete"] and answers[0]["budget"] == 0
    reduced = {"dimension": 1, "degree": None, "multiplicity": 1, "real": True}
    assert answers[0]["components"] == [reduced]
    assert answers[0]["degree_at_least"] == 1
    assert "degree 1 at least" in capsys.readouterr().out


def test_what_was_asked_is_said_first_and_then_what_it_rests_on(capsys) -> None:
    assert main(["mobility", str(CASES / "bennett.toml"), "--quiet"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1] == ""
    labels = [line.split("  ")[0] for line in lines[2:]]
    assert labels == ["mobility", "counted", "model", "local", "components", "degree", "run"]
    assert {line[12] == " " for line in lines[2:]} == {False}


def test_what_is_known_before_the_components_is_printed_before_they_are_looked_for(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    printed: dict[str, str] = {}

    def tell(_: ProgressLine, stage: str, *__: int) -> None:
        printed[stage] = printed.get(stage, "") + capsys.readouterr().out

    monkeypatch.setattr(ProgressLine, "__call__", tell)
    assert main(["mobility", str(CASES / "bennett.toml")]) == 0
    early = "".join(printed.values())
    assert "local       tangent dimension 1, local dimension 1" in early
    assert early.count("mobility    overconstrained") == 1 and "components" not in early
    assert capsys.readouterr().out.startswith("components  1 through the configuration")


def test_a_singular_reference_whose_decomposition_takes_too_long_is_said_to_be_open() -> None:
    wren = nag.read_case(CASES / "spatial" / "wren-5.toml").mechanism
    report = nag.mobility(wren, budget=0)
    assert (report.tangent_dimension, report.local_dimension, report.components) == (8, 7, None)
    assert "more than a budget of 0 s allows" in report.open
    assert report.status == "overconstrained"


@pytest.mark.parametrize(
    ("name", "modes"),
    [
        ("3-upu-snu", [(3, 1), (3, 1), (3, 4), (3, 4)]),
        ("3-upu-snu-120", [(3, 1), (3, 1), (3, 4), (3, 4)]),
        ("3-upu-tangential", [(3, 1), (3, 1), (3, 10)]),
        ("3-upu-wrist", [(3, 1), (3, 14)]),
    ],
)
def test_where_motions_of_a_robot_meet_and_its_legs_are_regular_its_modes_are_the_components(
    name: str, modes: list[tuple[int, int]]
) -> None:
    found = nag.mobility(nag.read_case(CASES / "robots" / f"{name}.toml"))
    assert sorted(found.components) == modes and not found.open
    assert max(found.components)[0] == found.local_dimension
    assert found.status == "at a crossing of components"
    assert "by the platform's poses" in dict(found.rows())["components"]


def test_of_a_robot_of_many_paths_that_are_within_the_budget_poses_are_asked_first() -> None:
    # Three UPR legs at 120 degrees: the joints' equations take 64,800 paths, poses 254.
    joints, root = [], square_root(3)
    for k, (c, s) in enumerate(((2, 0 * root), (-1, root), (-1, -root))):
        bodies = ("base", f"low{k}", f"high{k}", "plate")
        across, out = (-s, c, 0), (c, s, 0)
        joints += [
            Joint(f"U{k}", "universal", bodies[:2], (2 * c, 2 * s, 0), across, out),
            Joint(f"P{k}", "prismatic", bodies[1:3], (0, 0, 0), (-c, -s, 5)),
            Joint(f"R{k}", "revolute", bodies[2:], (c, s, 5), across),
        ]
    found = nag.mobility(Mechanism("base", tuple(joints)))
    assert (found.tangent_dimension, found.local_dimension) == (3, 1)
    assert sorted(found.components) == [(1, 1), (1, 2), (1, 2), (1, 2)]
    assert "by the platform's poses" in dict(found.rows())["components"]


def test_components_that_are_nowhere_reduced_are_told_with_their_multiplicity() -> None:
    """Six equal parallel rods: the platform's circles have tangents of one dimension more."""
    places = [(0, 0), (3, 0), (4, 2), (2, 5), (-1, 3), (1, 1)]
    joints = [
        nag.Joint(f"{end}{i}", "spherical", pair, (x, y, z), None)
        for i, (x, y) in enumerate(places)
        for end, pair, z in (("A", ("base", f"rod{i}"), 0), ("B", (f"rod{i}", "plate"), 5))
    ]
    report = nag.mobility(nag.Mechanism("base", tuple(joints)), of="plate")
    assert (report.tangent_dimension, report.local_dimension) == (9, 8)
    assert (report.components, report.multiplicities) == (((8, 2),), (2,))
    assert "all configurations near by are singular" in report.sentence
    assert "degree 2, multiplicity 2" in str(report)


@pytest.mark.parametrize("name", ["3-upu-snu", "3-upu-snu-120"])
def test_complex_components_are_not_counted_as_motions(name: str) -> None:
    report = nag.mobility(nag.read_case(CASES / "robots" / f"{name}.toml"))
    assert report.real == (True, True, False, False)
    assert "; 2 real motions meet here; 2 more components" in report.sentence
    assert [c["real"] for c in report.document()["components"]] == list(report.real)
    assert report.unreal == 0 and report.local_dimension == 3


@pytest.mark.parametrize(
    ("text", "status"), [("0.1", 0), ("0", 0), ("-1", 2), ("nan", 2), ("x", 2)]
)
def test_a_budget_is_a_number_of_seconds(
    text: str, status: int, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(CASES / "bennett.toml")
    assert main(["mobility", path, "--quiet", "--budget", text]) == status
    said = capsys.readouterr()
    assert (f"budget {text} s" in said.out) if not status else ("number of seconds" in said.err)


def test_the_work_of_sharp_points_is_paid_for() -> None:
    mechanism = nag.read_case(CASES / "robots" / "exechon.toml").mechanism
    system = nag.model(mechanism).system
    point = np.array([complex(x) for x in nag.model(mechanism).reference])
    rich = grow_component(system, point, 3, seconds=30.0)
    assert rich.degree == 244
    # Half of what it took are zeros in balls, without which the degree is not known.
    poor = grow_component(system, point, 3, seconds=0.6 * (30 - rich.seconds))
    assert poor.degree is None and poor.least == 244 and poor.seconds > -0.2


def test_numbers_that_are_not_known_exactly_are_told(tmp_path, capsys) -> None:
    text = (CASES / "spatial" / "rssr.toml").read_text("utf-8")
    file = tmp_path / "rssr.toml"
    file.write_text(text.replace("[3, 2, 2]", '[3, 2, "2*cos(1)"]'), "utf-8")
    assert main(["mobility", str(file), "--local", "--quiet"]) == 0
    assert "numbers     cos(1) is not known exactly" in capsys.readouterr().out
    assert main(["mobility", str(CASES / "spatial" / "rssr.toml"), "--local", "--quiet"]) == 0
    assert "numbers" not in capsys.readouterr().out


@pytest.mark.parametrize(("name", "leads"), [("kinematotropic-7r", True), ("rccc", False)])
def test_a_regular_reference_of_what_is_kinematotropic_leads_on(
    name: str, leads: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(CASES / "spatial" / f"{name}.toml")
    assert main(["mobility", path, "--quiet", "--local"]) == 0
    said = capsys.readouterr().out
    assert ("elsewhere   motions with 1 and 2 freedoms are known of it" in said) is leads


@pytest.mark.parametrize(
    ("name", "first", "before"),
    [
        (
            "bennett",
            "mobility    overconstrained: it moves with 1 freedom, though",
            "counted",
        ),
        (
            "planar/kinematotropic-crank",
            "so far      it moves with 2 freedoms at the most; the configuration",
            "mobility    kinematotropic point: it moves with 2 freedoms",
        ),
        ("shaky/triangle-stretched", "mobility    shaky: ", "counted"),
    ],
)
def test_what_was_asked_is_the_first_line_and_in_python_the_answer(
    name: str, first: str, before: str, capsys
) -> None:
    path = str(CASES / f"{name}.toml")
    assert main(["mobility", path, "--quiet"]) == 0
    title, empty, said, *others = capsys.readouterr().out.splitlines()
    assert title and not empty and said.startswith(first)
    assert any(line.startswith(before) for line in others)
    assert str(nag.mobility(path)).startswith("mobility    ")


def test_components_without_real_assemblies_are_told_apart() -> None:
    """Two triangles with three bars between them, of which there are most often complex ones."""
    bars = ["AB", "BC", "CA", "DE", "EF", "FD", "AD", "BE", "CF"]
    frame = nag.Framework.of("ABCDEF", bars, [3, 4, 5, 3, 4, 5, 2, "5/2", "11/5"])
    every = nag.decompose(frame)
    points = [x for component in every for x in component.points]
    real = sum(nag.model(frame).is_real(x) for x in points)
    report = nag.mobility(frame)
    assert (len(report.components), report.without_real) == (real, len(points) - real)
    said = dict(report.rows())["components"]
    assert 0 < real < len(points)
    assert said == (
        f"{real} of dimension 0, degree 1, with real assemblies; {len(points) - real} without"
    )
