"""Joints held at values and bodies held at places: what is left, against geometry by hand."""

import json
import math
from fractions import Fraction
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import nag
from nag.cli import main
from nag.files.json_schema import schema
from nag.kinematics.driven import Drive, hold
from nag.kinematics.joint_values import joint_coordinates, joint_errors
from nag.kinematics.motion import Motion, held_motion
from nag.kinematics.poses import turn_product, turn_vectors
from nag.kinematics.rigid_assemblies import isolated_assemblies
from nag.kinematics.shown import assembly_rows
from nag.mechanism.joint_chains import JointChains
from nag.mechanism.leg_ways import count_ways, find_leg_ways
from nag.mechanism.legs import Leg
from nag.mechanism.linkage import Link, Linkage, linkage_model
from nag.mechanism.problem import problem_of
from nag.tracking.run import Run

ROOT = Path(__file__).resolve().parent.parent
CASES = ROOT / "cases"
FIT = 1e-10
ORIGIN, UP = (0, 0, 0), (0, 0, 1)


def names_of(motion: Motion) -> list[str]:
    return [c.name for c in joint_coordinates(motion.scene)]


def loop(*joints: tuple[str, tuple, tuple, tuple | None]) -> nag.Mechanism:
    """A single loop of joints: type, point, axis and second axis."""
    count = len(joints)
    return nag.Mechanism(
        "0",
        tuple(
            nag.Joint(f"j{i}", kind, (str(i), str((i + 1) % count)), point, axis, second)
            for i, (kind, point, axis, second) in enumerate(joints)
        ),
    )


GENERAL = [
    ("revolute", (0, 0, 0), (0, 0, 1), None),
    ("revolute", (2, 0, 1), (1, 2, 2), None),
    ("revolute", (1, 3, 0), (2, -1, 1), None),
    ("revolute", (-1, 2, 2), (3, 1, -1), None),
    ("revolute", (-2, 1, 0), (1, 1, 4), None),
    ("revolute", (0, -2, 1), (2, 3, 6), None),
]
HELD = {
    "revolute": (("revolute", (1, -1, 2), (2, 2, 1), None), {"j6": 0.4}),
    "prismatic": (("prismatic", (1, -1, 2), (2, 2, 1), None), {"j6": 0.3}),
    "cylindrical": (
        ("cylindrical", (1, -1, 2), (2, 2, 1), None),
        {"j6.angle": 0.4, "j6.slide": -0.2},
    ),
    "universal": (
        ("universal", (1, -1, 2), (2, 2, 1), (1, -2, 2)),
        {"j6.first": 0.4, "j6.second": -0.7},
    ),
}


@pytest.mark.parametrize("kind", HELD)
def test_every_freedom_that_is_held_has_its_value_in_each_assembly(kind: str) -> None:
    joint, drive = HELD[kind]
    mechanism = loop(*GENERAL, joint)
    motion = held_motion(problem_of(mechanism), [Drive(*each) for each in drive.items()])
    assert motion.complete and not motion.circuits and motion.freedoms == 0
    assert len(motion.assemblies) >= 2 and len(motion.assemblies) % 2 == 0
    names = names_of(motion)
    for each in motion.assemblies:
        for name, value in drive.items():
            assert each.values[names.index(name)] == pytest.approx(value, abs=FIT)
        assert joint_errors(motion.scene, each.poses).max() < FIT


def test_assemblies_on_circuits_are_those_with_the_joint_held() -> None:
    case = nag.read_case(CASES / "bennett.toml")
    on_circuits = nag.motion(case, circuit="all", drive=("J0", 0.1), samples=60)
    problem = problem_of(case)
    held = held_motion(problem, [Drive("J0", 0.1)])
    found = [sorted(tuple(a.values) for a in m.assemblies) for m in (on_circuits, held)]
    assert len(found[0]) == 1
    assert np.allclose(*found, atol=1e-8)


@pytest.mark.parametrize("seed", [0, 1])
def test_an_arm_reaches_the_pose_of_its_hand_in_every_assembly(seed: int) -> None:
    case = nag.read_case(CASES / "spatial" / "puma-held.toml")
    (tie,) = [j for j in case.mechanism.joints if j.type == "rigid"]
    hand = next(b for b in tie.bodies if b != case.mechanism.ground)
    turn = np.array([0.9, 0.1, -0.2, 0.15])
    pose = (0.05, -0.1, 0.08, *turn)
    motion = nag.motion(case, pose={hand: pose}, seed=seed)
    assert motion.complete and len(motion.assemblies) in (2, 4, 6, 8)
    body = motion.scene.bodies.index(hand)
    for each in motion.assemblies:
        assert joint_errors(motion.scene, each.poses).max() < FIT
        assert np.allclose(each.poses.places[body, 0], pose[:3], atol=FIT)
        found = each.poses.turns[body, 0]
        assert abs(abs(found @ turn) / np.linalg.norm(turn) - 1) < FIT
        # The arm's own joints, one after another, take the hand there.
        place, turned = forward(case.mechanism, motion, each, hand)
        assert np.allclose(place, pose[:3], atol=FIT)
        assert abs(abs(turned @ turn) / np.linalg.norm(turn) - 1) < FIT


ARM = [
    ("j1", "base", "l1", (0, 0, 0), (0, 0, 1)),
    ("j2", "l1", "l2", ("3/10", 0, "1/2"), (0, 1, 0)),
    ("j3", "l2", "l3", ("3/10", 0, "3/2"), (0, 1, 0)),
    ("j4", "l3", "l4", ("1/2", "1/10", "8/5"), (1, 0, 0)),
    ("j5", "l4", "l5", ("7/5", "1/10", "8/5"), (0, 1, 0)),
    ("j6", "l5", "tool", ("7/5", "1/10", "8/5"), (1, 0, 0)),
]


@pytest.mark.parametrize("behind", [False, True])
def test_what_hangs_behind_a_placed_body_says_nothing_of_whether_its_pose_is_reached(
    behind: bool,
) -> None:
    # Five joints take the body to a pose of five freedoms: of six numbers that are rounded none.
    joints = [
        nag.Joint(name, "revolute", bodies, tuple(map(Fraction, point)), axis)
        for name, *bodies, point, axis in ARM[: 6 if behind else 5]
    ]
    arm = nag.Mechanism("base", tuple(joints))
    drawn = nag.motion(arm, pose={"l5": (0, 0, 0)})
    assert drawn.complete and len(drawn.assemblies) == 2
    assert (drawn.freedoms, drawn.hanging_count) == (behind, behind)
    assert drawn.sentence.startswith(
        "nothing moves but what is in no loop, with 1 freedom" if behind else "it does not move"
    )
    assert "j6" not in assembly_rows(drawn)[0]
    # Where turns of all five take it, rounded to 16 digits.
    place, turned = np.zeros(3), np.array([1.0, 0, 0, 0])
    for joint, half in zip(joints, (0.1, 0.05, -0.15, 0.2, 0.25), strict=False):
        own = np.array([math.cos(half), *(math.sin(half) * x for x in map(float, joint.axis))])
        point = np.array([float(x) for x in joint.point])
        shift = point - turn_vectors(own[None], point[None])[0]
        place = place + turn_vectors(turned[None], shift[None])[0]
        turned = turn_product(turned[None], own[None])[0]
    rounded = nag.motion(arm, pose={"l5": (*place, *turned)})
    assert not rounded.assemblies and not rounded.complete
    (note,) = rounded.notes
    assert note.startswith("what is held asks for more than there are freedoms")


def forward(mechanism, motion, assembly, hand: str) -> tuple[np.ndarray, np.ndarray]:
    """Where turns about the drawn axes by the angles take the hand's frame."""
    values = dict(zip(names_of(motion), assembly.values, strict=True))
    place, turned = np.zeros(3), np.array([1.0, 0, 0, 0])
    body = mechanism.ground
    chain = []
    while body != hand:
        joint = next(
            j
            for j in mechanism.joints
            if j.type == "revolute" and body in j.bodies and j not in chain
        )
        chain.append(joint)
        axis = np.array([float(x) for x in joint.axis])
        axis /= np.linalg.norm(axis)
        sign = 1 if joint.bodies[0] == body else -1
        half = sign * values[joint.name] / 2
        own = np.array([math.cos(half), *(math.sin(half) * axis)])
        point = np.array([float(x) for x in joint.point])
        shift = point - turn_vectors(own[None], point[None])[0]
        place = place + turn_vectors(turned[None], shift[None])[0]
        turned = turn_product(turned[None], own[None])[0]
        body = joint.other(body)
    return place, turned


def test_a_five_bars_circuits_are_one_where_its_rods_reach_everywhere_and_two_elsewhere() -> None:
    # With crank A at an angle, the dyad reaches from its end to the other crank's if their distance
    # is between the difference and the sum of the rods. The difference is never reached from below
    # sqrt(18) - sqrt(13); where the sum is never reached either, the dyad's sides are two circuits.
    case = nag.read_case(CASES / "planar" / "five-bar.toml")
    degrees = [0, 30, 60]
    driven = nag.driven_motion(case, "A", [math.radians(x) for x in degrees], samples=60)
    assert driven.complete
    counts = []
    for x in degrees:
        # The first pin is at (0, 2) where the angle is 0; the other crank turns about (5, 0).
        end = 2 * complex(-math.sin(math.radians(x)), math.cos(math.radians(x)))
        around = [abs(end - 5 - math.sqrt(2) * np.exp(1j * t)) for t in np.linspace(0, 7, 4001)]
        parts = max(around) > math.sqrt(13) + math.sqrt(18)
        counts.append(1 if parts else 2)
    assert [len(m.circuits) for m in driven] == counts == [2, 2, 1]
    for motion in driven:
        for circuit in motion.circuits:
            assert joint_errors(motion.scene, circuit.poses).max() < FIT
            column = names_of(motion).index("A")
            assert np.ptp(circuit.values.values[:, column]) < FIT
    table = driven.table()
    pairs = set(zip(table["driven"].tolist(), table["circuit"].tolist(), strict=True))
    # The crank at 60 degrees carries on what one of the two circuits becomes.
    both = {(0, 1), (0, 2), (30, 1), (30, 2)}
    assert pairs in (both | {(60, 1)}, both | {(60, 2)})
    lengths = [c for c in driven.continuations if c.moves]
    assert sorted((c.first, len(c.members)) for c in lengths) == [(0, 2), (0, 3)]


def test_a_driven_crank_of_one_freedom_has_assemblies_at_each_value() -> None:
    driven = nag.driven_motion(CASES / "bennett.toml", "J0", [0.2, 0.3, 0.4], samples=60)
    table = driven.table(angles="radians")
    assert np.allclose(table["driven"], table["J0"], atol=FIT)
    assert len(table["arc"]) == sum(len(motion.assemblies) for motion in driven)
    assert [len(m.assemblies) for m in driven] == [1, 1, 1]
    (only,) = driven.continuations
    assert (only.moves, only.first, only.members) == (False, 0, (0, 0, 0))
    assert len(driven) == 3 and driven[1] is list(driven)[1]


def test_a_tables_joint_is_held() -> None:
    motion = nag.motion(
        CASES / "spherical" / "five-bar.toml", drive={"J1": 0.5, "J2": 1.0}, samples=60
    )
    assert motion.complete and len(motion.assemblies) == 2
    assert names_of(motion) == ["J3", "J4", "J5"]


def test_what_is_held_is_written_as_its_schema_says(tmp_path, capsys) -> None:
    file, page = tmp_path / "a.json", tmp_path / "a.html"
    five = str(CASES / "planar" / "five-bar.toml")
    table = tmp_path / "a.csv"
    arguments = ["--drive", "A=0:60:3", "--samples", "24", "--csv", str(table)]
    main(["motion", five, *arguments, "--json", str(file), "--html", str(page)])
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-driven-motion"))
    assert document["format"] == "nag-driven-motion" and len(document["motions"]) == 3
    assert '"held":' in page.read_text()
    head, *lines = table.read_text().splitlines()
    assert head.startswith("driven,circuit,arc,A,B")
    assert {round(float(line.split(",")[0]), 9) for line in lines} == {0.0, 30.0, 60.0}
    main(["motion", five, "--drive", "A=0", "--drive", "E=20", "--json", str(file)])
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-motion"))
    assert [each["coordinate"] for each in document["held"]] == ["A", "E"]
    assert all(each["circuit"] is None for each in document["assemblies"])
    assert "real assemblies" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--drive", "Z=1"], "'Z' is no angle or slide"),
        (["--drive", "A=1:2"], "is not of the form"),
        (["--drive", "A=1:2:1"], "between 2 and 1000"),
        (["--drive", "A=1:2:3", "--drive", "B=1:2:3"], "one joint is driven"),
        (["--drive", "A=x"], "is not of the form"),
        (["--drive", "A=1", "--drive", "A=2"], "'A' is given twice"),
        (["--pose", "rod1=1,2"], "is not of the form"),
        (["--pose", "nobody=1,2,3"], "'nobody' is no body"),
        (["--pose", "base=1,2,3"], "is the ground"),
        (["--pose", "rod1=1,2,3,0,0,0,0"], "quaternion"),
    ],
)
def test_what_cannot_be_held_is_refused_in_one_line(arguments, said, capsys) -> None:
    with pytest.raises(SystemExit) as stop:
        raise SystemExit(main(["motion", str(CASES / "planar" / "five-bar.toml"), *arguments]))
    assert stop.value.code == 2
    error = capsys.readouterr().err
    assert said in error and "Traceback" not in error


def test_a_held_value_of_thirty_degrees_is_exact() -> None:
    problem = problem_of(nag.read_case(CASES / "planar" / "five-bar.toml"))
    held, _ = hold(problem, [Drive("A", math.radians(30))], [])
    roots = {
        r
        for f in held.system.polynomials
        for c in f.terms.values()
        for r in getattr(c, "terms", {1: 0})
    }
    assert roots == {1, 3}
    rounded, _ = hold(problem, [Drive("A", 0.3)], [])
    assert all(
        isinstance(c, Fraction) for f in rounded.system.polynomials for c in f.terms.values()
    )


def open_arm() -> nag.Mechanism:
    points = [(0, 0, 0), (2, 0, 0), (3, 1, 0)]
    names = ["base", "upper", "fore", "hand"]
    joints = (
        nag.Joint(f"j{i}", "revolute", (names[i], names[i + 1]), point, UP)
        for i, point in enumerate(points)
    )
    return nag.Mechanism("base", tuple(joints))


def test_an_arm_that_nothing_holds_is_held_where_its_hand_is_put() -> None:
    # Two links of lengths 2 and sqrt(2), and a hand that turns by 2 atan(1/5): two elbows.
    motion = nag.motion(open_arm(), pose={"hand": (0.1, 0.2, 0, 1, 0, 0, 0.2)})
    assert motion.complete and len(motion.assemblies) == 2
    for each in motion.assemblies:
        first, second, third = each.values
        assert first + second + third == pytest.approx(2 * math.atan(0.2), abs=FIT)
        # The wrist is where the hand takes it.
        turn = np.exp(2j * math.atan(0.2))
        wrist = 0.1 + 0.2j + turn * (3 + 1j)
        elbow = 2 * np.exp(1j * first)
        assert abs(elbow + np.exp(1j * (first + second)) * (1 + 1j) - wrist) < FIT


def link(name: str, pins: str, length: int) -> Link:
    places = ((Fraction(0), Fraction(0)), (Fraction(length), Fraction(0)))
    return Link(name, tuple(pins), places)


def test_a_linkages_pins_are_held_between_the_links_that_they_count_from() -> None:
    links = [("base", "AE", 5), ("crank", "AB", 2), ("rod", "BC", 4), ("arm", "CD", 4)]
    linkage = Linkage("base", tuple(link(*each) for each in (*links, ("rocker", "ED", 1))))
    drive = {"A": math.radians(60), "E": 0.3}
    motion = nag.motion(linkage_model(linkage), drive=drive)
    assert motion.complete and len(motion.assemblies) == 2
    # The dyad between the ends of both cranks.
    ends = 2 * np.exp(1j * drive["A"]), 5 + np.exp(1j * drive["E"])
    gap = ends[1] - ends[0]
    for each, sign in zip(motion.assemblies, (-1, 1), strict=True):
        values = dict(zip(names_of(motion), each.values, strict=True))
        rod = gap / abs(gap) * np.exp(1j * sign * math.acos(abs(gap) / 8))
        assert abs(np.exp(1j * (values["A"] + values["B"])) - rod) < FIT
        assert all(abs(values[name] - drive[name]) < FIT for name in drive)
        assert joint_errors(motion.scene, each.poses).max() < FIT
    one = nag.motion(linkage_model(linkage), drive={"B": 0.4, "C": -1.0}, samples=60)
    assert all(joint_errors(one.scene, each.poses).max() < FIT for each in one.assemblies)


def test_assemblies_beyond_where_a_circuit_to_infinity_is_followed_are_found() -> None:
    # Newton's method on the closure from many starts finds two, with slides up to 27 and 31.
    case = CASES / "spatial" / "rccc.toml"
    for angle, found, on in (
        (88.9, [(-20.43, 14.72, -19.43), (20.3, -13.33, 27.21)], [1, None]),
        (89.3, [(-23.35, 16.65, -22.74), (23.24, -15.26, 30.58)], [None, None]),
    ):
        motion = nag.motion(case, circuit="all", drive=("A", math.radians(angle)), samples=24)
        each = sorted(motion.assemblies, key=lambda a: a.values[2])
        assert [tuple(a.values[[2, 4, 6]].round(2)) for a in each] == found
        assert [a.circuit for a in each] == on
        assert all(joint_errors(motion.scene, a.poses).max() < FIT * 20 for a in each)


def test_an_assembly_where_circuits_cross_counts_once() -> None:
    motion = nag.motion(CASES / "planar" / "four-bar-parallelogram.toml", drive=("A", 0.0))
    assert len(motion.assemblies) == 1


def straight_arm(reach: float) -> Motion:
    """The open arm with its wrist so far away, in rounded numbers."""
    turn, out = np.exp(0.7j), np.exp(0.3j)
    place = reach * out - turn * (3 + 1j)
    pose = (place.real, place.imag, 0, math.cos(0.35), 0, 0, math.sin(0.35))
    return nag.motion(open_arm(), pose={"hand": pose})


@pytest.mark.parametrize("off", [0.0, 1e-15, -1e-15])
def test_a_pose_that_is_singular_but_for_rounding_is_said_to_be(off: float) -> None:
    motion = straight_arm(2 + math.sqrt(2) + off)
    assert not motion.complete and "singular" in motion.notes[0]
    assert straight_arm(3.0).complete and len(straight_arm(3.0).assemblies) == 2
    assert straight_arm(4.0).complete and not straight_arm(4.0).assemblies


def test_a_body_to_be_placed_that_is_not_there_is_named_though_nothing_else_holds() -> None:
    with pytest.raises(nag.NagError, match=r"pose: 'claw' is no body; they are .*hand"):
        nag.motion(open_arm(), pose={"claw": (0, 0, 0)})


def test_assemblies_that_differ_by_half_turns_of_all_bodies_are_two() -> None:
    # An elbow above and one below, each with the shoulder turned either way.
    turns = [
        ((0, 0, 0), UP),
        ((0, 0, 1), (0, 1, 0)),
        ((3, 0, 1), (0, 1, 0)),
        ((3, 0, 3), (0, 1, 0)),
    ]
    names = ["base", "l1", "l2", "l3", "l4", "hand"]
    joints = (
        nag.Joint(f"j{i}", "revolute", (names[i], names[i + 1]), point, axis)
        for i, (point, axis) in enumerate([*turns, ((4, 0, 3), (1, 0, 0))])
    )
    motion = nag.motion(nag.Mechanism("base", tuple(joints)), pose={"hand": ORIGIN})
    assert [each.values[0] for each in motion.assemblies] == pytest.approx([0, 0, math.pi, math.pi])
    assert any(np.allclose(each.values, 0, atol=FIT) for each in motion.assemblies)


def test_a_stretched_arm_whose_pose_is_in_whole_numbers_is_no_rounded_one() -> None:
    motion = nag.motion(open_arm_of(2, 4), pose={"hand": ORIGIN})
    assert motion.complete and len(motion.assemblies) == 1
    turned = nag.motion(open_arm_of(2, 4), pose={"hand": (*ORIGIN, 0.8, 0, 0, 0.6)})
    assert len(turned.assemblies) == 1 and not turned.complete


def open_arm_of(*places: int) -> nag.Mechanism:
    """An arm in the plane, stretched, with hinges at the origin and so far from it."""
    points = [0, *places]
    names = ["base", *(f"link{x}" for x in places), "hand"]
    return nag.Mechanism(
        "base",
        tuple(
            nag.Joint(f"j{i}", "revolute", (names[i], names[i + 1]), (x, 0, 0), UP)
            for i, x in enumerate(points)
        ),
    )


@pytest.mark.parametrize(
    ("pose", "angles"),
    [
        ((0, 0, 0), [(0, 0)]),
        # The elbow is at (0, 2), the hand not turned.
        ((-2, 2, 0), [(90, -90)]),
        ((0, 0, 0, 1, 0, 0, 1), [(90, 0)]),
        ((1, 1, 0), []),
    ],
)
def test_an_arm_of_two_joints_reaches_a_pose_or_does_not(pose, angles) -> None:
    motion = nag.motion(open_arm_of(2), pose={"hand": pose})
    found = [np.degrees(each.values) for each in motion.assemblies]
    assert motion.complete and np.allclose(found, angles, atol=1e-8)
    assert len(found) == len(angles)


def test_what_holds_too_much_is_told_what_to_hold_instead() -> None:
    with pytest.raises(nag.NagError, match=r"one joint moves freely.*two joints or more between"):
        nag.motion(open_arm_of(2), pose={"link2": ORIGIN})
    five = CASES / "planar" / "five-bar.toml"
    with pytest.raises(nag.NagError, match=r"no joint of a loop is left that moves; hold less$"):
        nag.motion(five, drive=dict.fromkeys("ABCDE", 0.0))
    # Two joints that are left have one assembly.
    held = nag.motion(five, drive=dict.fromkeys("ABC", 0.0))
    assert held.complete and np.allclose([each.values for each in held.assemblies], 0, atol=FIT)


def test_circuits_and_assemblies_besides_are_in_the_table_of_what_is_held() -> None:
    # A wrist whose first and last axes are one turns idly; with its middle turned it does not.
    names = ["base", "l1", "l2", "l3", "l4", "l5", "hand"]
    y, z = (0, 1, 0), (0, 0, 1)
    places = [(0, 0, 0), (0, 0, 1), (3, 0, 1), (3, 0, 3), (3, 0, 3), (3, 0, 3)]
    joints = [
        nag.Joint(f"j{i}", "revolute", (names[i], names[i + 1]), place, axis)
        for i, (place, axis) in enumerate(zip(places, (z, y, y, z, y, z), strict=True))
    ]
    motion = nag.motion(nag.Mechanism("base", tuple(joints)), pose={"hand": ORIGIN}, samples=12)
    assert len(motion.circuits) == 2 and len(motion.assemblies) == 4
    circuits = motion.whole_table()["circuit"].tolist()
    assert circuits == [1] * 13 + [2] * 13 + [0] * 4


def test_half_turns_are_told_forwards() -> None:
    motion = nag.motion(CASES / "planar" / "five-bar.toml", drive={"A": math.pi, "E": 0.0})
    held = names_of(motion).index("A")
    assert all(assembly.values[held] > 0 for assembly in motion.assemblies)


def rps_robot() -> nag.Mechanism:
    """A platform on three legs, each a hinge, a slide and a ball, over a base twice its size."""
    joints, corners = [], [(2, 0), (-1, Fraction(17, 10)), (-1, Fraction(-17, 10))]
    for k, (x, y) in enumerate(corners, 1):
        low, up, top = f"low{k}", f"up{k}", (x / Fraction(2), y / Fraction(2), 3)
        along = (-x / Fraction(2), -y / Fraction(2), 3)
        joints += [
            nag.Joint(f"R{k}", "revolute", ("base", low), (x, y, 0), (-y, x, 0)),
            nag.Joint(f"P{k}", "prismatic", (low, up), None, along),
            nag.Joint(f"S{k}", "spherical", (up, "platform"), top),
        ]
    return nag.Mechanism("base", tuple(joints))


def test_a_ball_turned_to_the_end_of_its_quaternions_chart_is_not_all_but_singular() -> None:
    motion = nag.motion(rps_robot(), drive={"P1": 0.1, "P2": 0.0, "P3": 0.0})
    assert len(motion.assemblies) == 16 and motion.complete and not motion.notes


def test_a_pose_that_asks_for_too_much_in_rounded_numbers_is_left_open() -> None:
    pose = (-2.998876829652815, 1.6650327512175565, 0, 0.7188563932301292, 0, 0, -0.695158604860912)
    motion = nag.motion(CASES / "planar" / "five-bar.toml", pose={"rod1": pose})
    assert not motion.assemblies and not motion.complete


def test_what_holds_a_joint_and_a_body_at_once_may_leave_no_unknown_of_a_loop() -> None:
    case = CASES / "planar" / "five-bar.toml"
    motion = nag.motion(case, pose={"rod1": (0, 0, 0)}, drive={"A": 0.0})
    assert len(motion.assemblies) == 2


def test_assemblies_are_a_table_where_there_is_no_circuit(tmp_path) -> None:
    table = tmp_path / "a.csv"
    five = str(CASES / "planar" / "five-bar.toml")
    main(["motion", five, "--drive", "A=30", "--drive", "E=-20", "--csv", str(table), "--quiet"])
    head, *lines = table.read_text().splitlines()
    assert head.startswith("circuit,arc,A,B,C,D,E,base.x") and len(lines) == 2


@pytest.mark.parametrize("turn", [(), (0.9, 0.1, -0.2, 0.15)])
def test_a_joints_point_of_a_held_body_is_where_it_is_asked_for(turn: tuple[float, ...]) -> None:
    case = nag.read_case(CASES / "spatial" / "puma-held.toml")
    (tie,) = [j for j in case.mechanism.joints if j.type == "rigid"]
    hand = next(b for b in tie.bodies if b != case.mechanism.ground)
    wrist = next(j for j in case.mechanism.joints if hand in j.bodies and j.type == "revolute")
    drawn = np.array([float(x) for x in wrist.point])
    place = drawn + np.array([0.03, -0.02, 0.05])
    motion = nag.motion(case, pose={f"{hand}@{wrist.name}": (*place, *turn)})
    assert motion.assemblies
    body = motion.scene.bodies.index(hand)
    for each in motion.assemblies:
        assert np.allclose(each.poses.move(body, drawn)[0], place, atol=FIT)
    if not turn:
        # Not turned, it is as far from where it is drawn as its frame is.
        moved = nag.motion(case, pose={hand: tuple(place - drawn)})
        assert len(moved.assemblies) == len(motion.assemblies)


@pytest.mark.parametrize(
    ("name", "said"),
    [("{hand}@nothing", "'nothing' is no joint of"), ("nobody@j", "'nobody'")],
)
def test_a_point_of_no_joint_is_refused(name: str, said: str) -> None:
    case = nag.read_case(CASES / "spatial" / "puma-held.toml")
    (tie,) = [j for j in case.mechanism.joints if j.type == "rigid"]
    hand = next(b for b in tie.bodies if b != case.mechanism.ground)
    with pytest.raises(nag.NagError, match=said):
        nag.motion(case, pose={name.format(hand=hand): (0, 0, 0)})


def test_parts_without_a_reference_are_told_that_no_body_can_be_placed() -> None:
    with pytest.raises(
        nag.NagError, match="pose: bodies are placed in mechanisms with a reference"
    ):
        nag.motion(CASES / "planar" / "four-bar.toml", pose={"crank": (0, 0, 0)})


def turned_about(axis: tuple[int, int, int], angle: float) -> np.ndarray:
    half = angle / 2
    return np.array([math.cos(half), *(math.sin(half) * np.array(axis))])


def test_a_rod_on_a_universal_joint_reaches_its_places_in_two_ways() -> None:
    joints = (
        nag.Joint("U", "universal", ("base", "rod"), (0, 0, 0), (1, 0, 0), (0, 1, 0)),
        nag.Joint("S", "spherical", ("rod", "platform"), (1, 2, 3)),
    )
    leg = Leg(joints, ("base", "rod", "platform"))
    assert count_ways(leg.elements(), Run()) == 2
    first, second = (turned_about(*x) for x in (((1, 0, 0), 0.4), ((0, 1, 0), -0.7)))
    turn = turn_product(first, second)
    # The ball's point goes where both turns take it; the platform is turned as it was.
    point = np.array([1.0, 2.0, 3.0])
    moved = turn_vectors(turn, point) - point
    pose = np.array([1.0, 0, 0, 0, 0, *(moved / 2)])
    rng = np.random.default_rng(0)
    ways = find_leg_ways(leg.elements(), pose, 2, 1.0, rng)
    assert len(ways.joints) == 2 and not ways.missing
    for way in ways.joints:
        one, other = (2 * math.atan2(u[1], u[0]) for u in way[:2])
        both = turn_product(turned_about((1, 0, 0), one), turned_about((0, 1, 0), other))
        assert np.allclose(turn_vectors(both, point), point + moved, atol=FIT)
    firsts = [2 * math.atan2(way[1][1], way[1][0]) % (2 * math.pi) for way in ways.joints]
    assert abs(firsts[0] - firsts[1]) > 0.1


def wrist_robot() -> nag.Mechanism:
    """A platform on a universal joint, and two rods of given length from universal joints to it."""
    joints = [nag.Joint("B", "universal", ("base", "platform"), ORIGIN, UP, (1, 0, 0))]
    for k, low, top in ((1, (3, 0, -1), (2, 1, 1)), (2, (-1, 3, -1), (-1, 2, 1))):
        along = tuple(x - y for x, y in zip(top, low, strict=True))
        joints += [
            nag.Joint(f"U{k}", "universal", ("base", f"low{k}"), low, (1, 0, 0), (0, 1, 0)),
            nag.Joint(f"P{k}", "prismatic", (f"low{k}", f"up{k}"), None, along),
            nag.Joint(f"S{k}", "spherical", (f"up{k}", "platform"), top),
        ]
    return nag.Mechanism("base", tuple(joints))


def test_assemblies_by_poses_are_those_by_joints() -> None:
    problem = problem_of(wrist_robot())
    drives = (Drive("P1", 0.1), Drive("P2", 0.05))
    found = []
    for formulation in ("P", "H"):
        left, scene = hold(problem, drives, (), formulation)
        assert left.formulation == formulation
        points = [c for c in left.decompose().components if c.dimension == 0]
        own, notes = isolated_assemblies(scene, points, Run())
        assert not notes
        found.append(np.array([each.values for each in own]))
    # Two poses of the platform, which each of both legs reaches in two ways.
    assert len(found[0]) == len(found[1]) == 8
    gaps = np.abs(found[0][:, None] - found[1][None]).max(axis=2)
    assert gaps.min(axis=0).max() < FIT and gaps.min(axis=1).max() < FIT


def test_a_hexapods_platform_is_solved_for_with_all_slides_held() -> None:
    # Each leg reaches a pose in two ways: half a turn of its universal joint turns the rod over.
    case = nag.read_case(CASES / "robots" / "hexapod.toml")
    slides = [j.name for j in case.mechanism.joints if j.type == "prismatic"]
    motion = nag.motion(case, drive=dict.fromkeys(slides, 0.0))
    assert motion.complete and "its legs eliminated" in motion.reason
    count, rest = divmod(len(motion.assemblies), 2**6)
    assert count and not rest
    assert max(joint_errors(motion.scene, a.poses).max() for a in motion.assemblies) < FIT
    drawn = [a for a in motion.assemblies if np.abs(a.values).max() < 1e-9]
    assert len(drawn) == 1


def test_a_platform_that_moves_is_not_taken_by_its_poses() -> None:
    with pytest.raises(nag.NagError, match="formulation P: the platform moves"):
        nag.motion(wrist_robot(), drive={"P1": 0.1}, pose=None, formulation="P")


def turned_points(quaternions: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Where turns of any length take points, scaled by their squared lengths: ``(k, m, 3)``."""
    w, v = quaternions[:, None, :1], quaternions[:, None, 1:]
    across = np.cross(v, points)
    return (w * w - (v * v).sum(-1, keepdims=True)) * points + 2 * (
        v * (v * points).sum(-1, keepdims=True) + w * across
    )


def count_poses(low: np.ndarray, high: np.ndarray, lengths: np.ndarray, slides: bool) -> int:
    """Poses of a body with points at distances from others, by Newton's method from many starts."""
    rng = np.random.default_rng(1)
    size = np.abs(low).max()
    x = np.hstack([rng.normal(size=(1000, 4)), size * rng.uniform(-2, 2, size=(1000, 3))])
    x = x[:, : 7 if slides else 4]

    def errors(x: np.ndarray) -> np.ndarray:
        ends = turned_points(x[:, :4], high) + (x[:, None, 4:] if slides else 0)
        own = ((ends - low) ** 2).sum(-1) - lengths**2
        return np.hstack([own, (x[:, :4] ** 2).sum(-1, keepdims=True) - 1])

    for _ in range(60):
        values, step = errors(x), 1e-6
        slopes = np.stack(
            [
                (errors(x + step * unit) - errors(x - step * unit)) / (2 * step)
                for unit in np.eye(x.shape[1])
            ],
            axis=-1,
        )
        move = np.linalg.pinv(slopes, rcond=1e-9) @ values[..., None]
        x = x - np.clip(move[..., 0], -1, 1)
    x = x[np.abs(errors(x)).max(axis=1) < 1e-9]
    found: list[np.ndarray] = []
    for own in x:
        own = own * np.where(np.arange(len(own)) < 4, np.sign(own[np.abs(own[:4]).argmax()]), 1)
        if all(np.abs(own - other).max() > 1e-5 for other in found):
            found.append(own)
    return len(found)


def turn_around(axis: np.ndarray, at: np.ndarray, angle: float, points: np.ndarray) -> np.ndarray:
    unit = axis / np.linalg.norm(axis)
    half = np.array([[math.cos(angle / 2), *(math.sin(angle / 2) * unit)]])
    return at + turned_points(half, points - at)[0]


def test_a_delta_whose_arms_are_held_has_the_assemblies_that_newtons_method_finds() -> None:
    # Each rod turns about itself in all of them, which leaves them as they are.
    case = nag.read_case(CASES / "mobility" / "delta.toml")
    drive = {"R1": math.radians(20), "R2": math.radians(10), "R3": 0.0}
    motion = nag.motion(case, drive=drive)
    assert motion.complete and not motion.circuits
    assert motion.sentence.startswith("nothing moves but idly, with 6 freedoms")
    assert "rod1l" in motion.idle and motion.idle_count == 6
    assert max(joint_errors(motion.scene, a.poses).max() for a in motion.assemblies) < FIT
    joints = {j.name: np.array([float(x) for x in j.point]) for j in case.mechanism.joints}
    axes = {j.name: j.axis for j in case.mechanism.joints}
    low, high = [], []
    for arm, angle in drive.items():
        axis = np.array([float(x) for x in axes[arm]])
        for side in "lr":
            own = joints[f"S{arm[1]}{side}a"][None]
            low.append(turn_around(axis, joints[arm], angle, own)[0])
            high.append(joints[f"S{arm[1]}{side}b"])
    rods = [joints[f"S{k}{s}a"] - joints[f"S{k}{s}b"] for k in "123" for s in "lr"]
    lengths = np.linalg.norm(rods, axis=1)
    number = count_poses(np.array(low), np.array(high), lengths, True)
    assert len(motion.assemblies) == number == 8


def test_a_leg_with_a_held_slide_between_two_balls_is_a_rod_of_that_length() -> None:
    case = nag.read_case(CASES / "robots" / "3-sps-s.toml")
    motion = nag.motion(case, drive={"P1": 0.1, "P2": 0.0, "P3": -0.2})
    assert motion.complete and not motion.circuits and motion.freedoms == motion.idle_count == 3
    assert "link1a with link1b" in motion.idle
    assert max(joint_errors(motion.scene, a.poses).max() for a in motion.assemblies) < FIT
    joints = {j.name: j.point for j in case.mechanism.joints if j.type == "spherical"}
    middle = np.array(next(p for n, p in joints.items() if n[-1] not in "ab"), dtype=float)
    low, high = (np.array([joints[f"S{k}{e}"] for k in "123"], dtype=float) for e in "ab")
    lengths = np.linalg.norm(high - low, axis=1) + np.array([0.1, 0.0, -0.2])
    number = count_poses(low - middle, high - middle, lengths, False)
    assert len(motion.assemblies) == number > 0


def test_a_held_rssc_moves_along_its_rods_sphere() -> None:
    crank, rod_end = np.array([1.0, 0, 0.5]), np.array([3.0, 3, 2])
    at, along = np.array([5.0, 1, 0]), np.ones(3) / math.sqrt(3)
    mechanism = nag.Mechanism(
        "base",
        (
            nag.Joint("A", "revolute", ("base", "crank"), ORIGIN, UP),
            nag.Joint("B", "spherical", ("crank", "rod"), (1, 0, Fraction(1, 2))),
            nag.Joint("C", "spherical", ("rod", "rocker"), (3, 3, 2)),
            nag.Joint("D", "cylindrical", ("base", "rocker"), (5, 1, 0), (1, 1, 1)),
        ),
    )
    motion = nag.motion(mechanism, drive={"A": math.radians(30)}, samples=60)
    assert motion.complete and motion.freedoms == 2 and motion.idle == "rod turns about itself"
    (circuit,) = motion.circuits
    assert joint_errors(motion.scene, circuit.poses).max() < FIT
    # The rocker reaches the sphere about the crank's end as far as the line along its slide does.
    end = turn_around(np.array(UP), np.zeros(3), math.radians(30), crank[None])[0]
    length = np.linalg.norm(rod_end - crank)
    angles = np.linspace(-math.pi, math.pi, 20001)
    places = np.array([turn_around(along, at, x, rod_end[None])[0] for x in angles])
    gap = places - end
    across = (gap**2).sum(1) - (gap @ along) ** 2
    reached = angles[across <= length**2]
    column = names_of(motion).index("D.angle")
    assert np.allclose(circuit.values.ranges[column], [reached[0], reached[-1]], atol=1e-3)


def rod_on_a_four_bar() -> nag.Mechanism:
    """A four-bar in the plane whose rocker moves another one, across it, by a rod."""
    joints = [
        nag.Joint("A", "revolute", ("base", "crank"), (0, 0, 0), UP),
        nag.Joint("B", "revolute", ("crank", "coupler"), (1, 0, 0), UP),
        nag.Joint("C", "revolute", ("coupler", "rocker"), (3, 3, 0), UP),
        nag.Joint("D", "revolute", ("base", "rocker"), (5, 0, 0), UP),
        nag.Joint("S1", "spherical", ("rocker", "rod"), (4, 2, 1)),
        nag.Joint("S2", "spherical", ("rod", "lever"), (6, 3, 3)),
        nag.Joint("E", "revolute", ("base", "lever"), (7, 1, 2), (1, 0, 0)),
    ]
    return nag.Mechanism("base", tuple(joints))


def test_a_rod_beside_a_loop_without_rods_is_a_distance_too() -> None:
    crank, limit = math.radians(-20), 2 * math.pi
    held = held_motion(problem_of(rod_on_a_four_bar()), [Drive("A", crank)])
    assert held.complete and not held.circuits and "as distances" in held.reason
    assert held.freedoms == held.idle_count == 1
    assert max(joint_errors(held.scene, a.poses).max() for a in held.assemblies) < FIT

    def place(axis: tuple, at: tuple, angle: float, point: tuple) -> np.ndarray:
        whole = (np.array(x, dtype=float) for x in (axis, at))
        return turn_around(*whole, angle, np.array([point], dtype=float))[0]

    def zeros(gap) -> list[float]:
        values = np.array([gap(x) for x in np.linspace(0, limit, 4001)])
        return [limit * i / 4000 for i in np.flatnonzero(values[:-1] * values[1:] < 0)]

    # The four-bar closes in two ways, and each time the lever in some.
    end = place(UP, ORIGIN, crank, (1, 0, 0))
    closed = zeros(lambda x: ((place(UP, (5, 0, 0), x, (3, 3, 0)) - end) ** 2).sum() - 13)
    found = []
    for x in closed:
        ball = place(UP, (5, 0, 0), x, (4, 2, 1))
        levers = zeros(
            lambda y, at=ball: ((place((1, 0, 0), (7, 1, 2), y, (6, 3, 3)) - at) ** 2).sum() - 9
        )
        found += [(x, y) for y in levers]
    own = [names_of(held).index(name) for name in "DE"]
    values = np.array([each.values[own] for each in held.assemblies]) % limit
    assert len(closed) == 2 and len(found) == len(values) == 4
    gaps = np.abs(values[:, None] - np.array(found)[None]).max(axis=2)
    assert gaps.min(axis=0).max() < 2e-3 and gaps.min(axis=1).max() < 2e-3


def test_a_rod_alone_between_what_is_held_fits_or_does_not() -> None:
    case = nag.read_case(CASES / "spatial" / "rssr.toml")
    drawn = nag.motion(case, drive={"A": 0.0, "D": 0.0})
    assert drawn.complete and len(drawn.assemblies) == 1 and not drawn.circuits
    assert drawn.freedoms == drawn.idle_count == 1
    other = nag.motion(case, drive={"A": 0.0, "D": 0.1})
    assert not other.assemblies and "more than there are freedoms" in other.notes[0]


def test_values_are_reached_from_the_drawing_or_are_not() -> None:
    five = JointChains.of(nag.read_case(CASES / "planar" / "five-bar.toml").mechanism, None)
    reached = five.reach({("A", 0): 0.5})
    assert reached is not None
    q, freedoms = reached
    assert freedoms == 1 and q[0] == 0.5 and np.abs(five.equations(q)[0]).max() < FIT
    # The crank of this one turns by 153 degrees.
    rssr = JointChains.of(nag.read_case(CASES / "spatial" / "rssr.toml").mechanism, None)
    assert rssr.reach({("A", 0): math.radians(150)}) is not None
    assert rssr.reach({("A", 0): math.radians(160)}) is None
