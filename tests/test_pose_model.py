"""Formulation P: what a platform's poses say is true of the joints, or it is not said."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from linkages import CASES, residual

import nag
from nag.cli import main
from nag.errors import MechanismError
from nag.files.cases import read_case
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.model import Model, ModelError, find_pose_model
from nag.mechanism.operation_modes import decompose_poses
from nag.mechanism.problem import problem_of
from nag.tracking.run import DEFAULT_RUN

ROBOTS = sorted(path.stem for path in (CASES / "robots").glob("*.toml"))
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


@cache
def poses(name: str) -> Model:
    return nag.model(read_case(CASES / "robots" / f"{name}.toml").mechanism, "P")


def with_kept_joints() -> Mechanism:
    """Two legs RPS, and one UPU whose axes are in general position."""
    joints = []
    for k, (foot, hand) in enumerate((((0, 0, 0), (1, 0, 4)), ((5, 0, 0), (4, 1, 4)))):
        along = tuple(b - a for a, b in zip(foot, hand, strict=True))
        joints += [
            Joint(f"R{k}", "revolute", ("base", f"low{k}"), foot, Y if k else X),
            Joint(f"P{k}", "prismatic", (f"low{k}", f"high{k}"), axis=along),
            Joint(f"S{k}", "spherical", (f"high{k}", "plate"), hand),
        ]
    joints += [
        Joint("U", "universal", ("base", "low"), (2, 5, 0), (1, 1, 0), (1, -1, 1)),
        Joint("P", "prismatic", ("low", "high"), axis=(0, -1, 4)),
        Joint("V", "universal", ("high", "plate"), (2, 4, 4), (1, 2, 0), (2, -1, 3)),
    ]
    return Mechanism("base", tuple(joints))


@pytest.mark.parametrize("name", ROBOTS)
def test_poses_tell_the_dimensions_at_a_reference_where_legs_are_regular(name: str) -> None:
    model = poses(name)
    known = nag.mobility(model.mechanism, detail="local")
    if not model.reference:
        with pytest.raises(MechanismError, match="singular configuration of a leg"):
            nag.mobility(model, detail="local")
        return
    found = nag.mobility(model, detail="local")
    assert found.local_dimension == known.local_dimension
    assert found.tangent_dimension == known.tangent_dimension


def general_points(model: Model) -> list[np.ndarray]:
    return [c.points[0] for c in nag.decompose(model).components]


def lifting_error(model: Model, point: np.ndarray) -> float:
    lifted = model.unreduced_point(model.lift(point))
    return residual(model.unreduced, [complex(x) for x in lifted])


@pytest.mark.parametrize("name", ["3-rps", "3-sps-s", "3-upu-tsai", "tripteron", "tricept"])
def test_general_poses_lift_to_configurations(name: str) -> None:
    model = poses(name)
    points = general_points(model)
    assert points
    assert max(lifting_error(model, p) for p in points) < 1e-10


def test_poses_beside_kept_joints_lift_to_configurations_with_these() -> None:
    model = nag.model(with_kept_joints(), "P")
    assert model.system.n > 7
    rng = np.random.default_rng(0)
    reference = np.array([complex(x) for x in model.reference])
    point = reference + 0.01 * rng.standard_normal(len(reference))
    for _ in range(20):
        value = np.array([f(list(point)) for f in model.system.polynomials])
        rows = np.array([[g(list(point)) for g in row] for row in model.system.jacobian])
        # There are more equations than the codimension: what depends is rounding beside the set.
        sizes = np.linalg.norm(rows, axis=1)
        point = point - np.linalg.lstsq(rows / sizes[:, None], value / sizes, rcond=1e-6)[0]
    assert lifting_error(model, point) < 1e-10


@pytest.mark.parametrize("name", ["3-rps", "quadrupteron"])
def test_the_reference_pose_lifts_to_the_reference_exactly(name: str) -> None:
    model = poses(name)
    lifted = model.lift(model.reference)
    assert sorted(lifted.euler) == sorted(model.mechanism.body_names)
    assert all(tuple(q) == (1, 0, 0, 0) for q in lifted.euler.values())
    assert all(tuple(p) == (0, 0, 0) for p in lifted.position.values())


def test_idle_legs_are_counted_besides() -> None:
    assert poses("3-sps-s").freedoms_left_out == (
        (3, "legs that move while the platform stands still"),
    )
    assert poses("3-rps").freedoms_left_out == ()


def test_components_that_a_leg_is_not_known_to_reach_leave_the_answer_open() -> None:
    platform = poses("3-rps").form.platform
    others = platform.legs[1:]
    equations = len(platform.system.polynomials) - len(others)
    without = replace(platform.system, polynomials=platform.system.polynomials[:equations])
    assert decompose_poses(platform, DEFAULT_RUN).complete
    found = decompose_poses(replace(platform, system=without), DEFAULT_RUN)
    assert found.components
    assert not found.complete
    assert {note.split()[2] for note in found.notes} == {leg.leg.name for leg in others}


def folded() -> Mechanism:
    """Three legs RRR in a plane, of which one is stretched: there its joints' twists depend."""
    legs = (
        ((0, 0, 0), (1, 1, 0), (2, 2, 0)),
        ((6, 0, 0), (7, 2, 0), (4, 3, 0)),
        ((3, 7, 0), (4, 6, 0), (3, 4, 0)),
    )
    joints = []
    for k, points in enumerate(legs):
        bodies = ("base", f"low{k}", f"high{k}", "plate")
        joints += [
            Joint(f"J{k}{i}", "revolute", (bodies[i], bodies[i + 1]), points[i], Z)
            for i in range(3)
        ]
    return Mechanism("base", tuple(joints))


def test_at_a_stretched_leg_poses_say_nothing_of_the_mobility() -> None:
    model = nag.model(folded(), "P")
    assert model.reference == ()
    with pytest.raises(MechanismError, match="singular configuration of a leg"):
        nag.mobility(folded(), formulation="P")
    assert [(c.dimension, c.degree) for c in nag.decompose(model).components] == [(3, 1)]


def test_a_pose_is_no_configuration_to_ask_for_the_mobility_at() -> None:
    model = poses("3-rps")
    with pytest.raises(MechanismError, match="no configuration of the joints"):
        nag.mobility(model, model.reference)


def test_what_is_asked_at_a_configuration_is_asked_of_the_joints() -> None:
    # The equations of poses take 5 paths, the fewest of all.
    robot = poses("tripteron")
    assert nag.model(robot.mechanism).formulation != "P"
    assert robot.alternatives[-1].formulation == "P"
    assert robot.alternatives[-1].paths == 5


def test_components_are_those_of_poses_where_all_others_are_out_of_reach(
    capsys: pytest.CaptureFixture[str],
) -> None:
    case = CASES / "robots" / "3-upu-tsai.toml"
    model = nag.model(case)
    assert model.formulation == "E" and find_pose_model(model).formulation == "P"
    # Those of three PRS legs are within reach, in joints as well.
    assert find_pose_model(nag.model(CASES / "robots" / "3-prs.toml")) is None
    assert find_pose_model(find_pose_model(model)) is None
    found = nag.decompose(case)
    assert [(c.dimension, c.degree) for c in found.components] == [(3, 1)] * 4 + [(3, 11)]
    assert main(["decompose", str(case), "--quiet"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "components of its poses; the joints may have several above one" in text
    assert "not seen components are those of the platform's poses, closed" in text


def test_a_robot_whose_paths_are_out_of_reach_has_short_equations() -> None:
    joints = []
    for i, (c, s) in enumerate(((1, 0), (Fraction(-3, 5), Fraction(4, 5)), (0, -1))):
        along, out = (-s, c, 0), (c, s, 0)
        places = ((3 * c, 3 * s, 0), (4 * c, 4 * s, 1), (3 * c, 3 * s, 2))
        links = ("base", f"low{i}", f"high{i}", "platform")
        axes = ((out, along), (along, None), (along, out))
        for k, (place, (axis, second)) in enumerate(zip(places, axes, strict=True)):
            kind = "revolute" if second is None else "universal"
            joint = Joint(f"{k}{i}", kind, links[k : k + 2], place, axis, second_axis=second)
            joints.append(joint)
    model = nag.model(Mechanism("base", tuple(joints)))
    assert model.formulation == "E"
    assert "short equations, as paths are out of reach" in model.reason
    # Half-angles have fewer of them, as do those of loops that are tracked apart.
    assert model.alternatives[0].formulation == "H"


@pytest.mark.parametrize(
    ("case", "options", "message"),
    [
        ("bennett.toml", [], "no body has 3 legs"),
        ("robots/3-rps.toml", ["--coordinates", "euler"], "those of a pose only"),
        ("robots/3-rps.toml", ["--method", "sampling"], "finds no poses"),
    ],
)
def test_what_poses_do_not_cover_is_told_in_one_line(
    case: str, options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["decompose", str(CASES / case), "--formulation", "P", "--quiet", *options]
    assert main(words) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert message in told
    with pytest.raises(ModelError, match="no body has 3 legs"):
        nag.model(read_case(CASES / "bennett.toml").mechanism, "P")


def test_other_assembly_modes_have_no_poses_of_their_own() -> None:
    with pytest.raises(ModelError, match="as they are assembled"):
        nag.model(poses("3-rps").mechanism, "P", modes=(("R1", 1),))


def test_the_command_and_its_export_say_that_components_are_those_of_poses(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, export = str(CASES / "robots" / "3-rps.toml"), str(tmp_path / "3-rps.json")
    assert main(["decompose", case, "--formulation", "P", "--json", export, "--quiet"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "components of its poses; the joints may have several above one" in text
    assert "not seen components are those of the platform's poses, closed" in text
    assert "agrees with what is known" in text
    assert main(["show", export]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "of 3-RPS (3-rps.toml) model formulation P: spatial" in shown
    assert "components of its poses" in shown


def test_poses_have_fewer_components_than_configurations_where_legs_move_in_one_pose():
    # So the formulation is not chosen by itself, however few paths it takes.
    case = read_case(CASES / "planar" / "two-kites.toml")
    kinds = {
        name: sorted(
            (c.dimension, c.degree, c.orbit)
            for c in problem_of(case, formulation=name).decompose().components
        )
        for name in ("E", "P")
    }
    assert kinds == {"E": [(1, 4, 1), (1, 4, 1), (2, 4, 1)], "P": [(1, 1, 1)]}


def test_poses_that_a_leg_reaches_in_the_limit_are_no_doubt() -> None:
    # Two planes of complex poses, to which the legs come as near as one likes.
    found = nag.decompose(CASES / "robots" / "4-upu-upright.toml")
    assert found.complete
    assert [(c.dimension, c.degree) for c in found.components] == [(4, 2)] * 2 + [(3, 1)] * 2


def test_poses_do_not_tell_the_mobility_where_a_leg_is_singular(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "folded.toml"
    nag.write(folded(), case)
    assert main(["decompose", str(case), "--formulation", "P", "--quiet"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "mobility not known from poses, as a leg or its equations are singular" in text
