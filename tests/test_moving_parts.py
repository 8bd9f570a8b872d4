"""What moves near a configuration, and what of it by itself, is told for whole components."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from linkages import CASES

import nag
from nag.cli import main
from nag.errors import MechanismError
from nag.files.cases import read_case
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.motions import ScrewSystem
from nag.mechanism.moving_parts import MovingParts, find_moving_parts

X, Y, Z = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def mechanism(name: str) -> Mechanism:
    found = read_case(CASES / f"{name}.toml").mechanism
    assert found is not None
    return found


def parts(name: str, dimension: int, body: str | None = None, seed: int = 0) -> MovingParts:
    return find_moving_parts(mechanism(name), dimension, np.random.default_rng(seed), None, body)


def joint(name: str, kind: str, bodies: tuple[str, str], point: tuple, axis: tuple) -> Joint:
    exact = [tuple(map(Fraction, v)) for v in (point, axis)]
    return Joint(name, kind, bodies, exact[0], None if kind == "spherical" else exact[1])


@pytest.mark.parametrize(
    ("name", "dimension", "freedoms"),
    [
        ("robots/3-rrr-planar", 3, "planar motion"),
        ("robots/3-rrr-spherical", 3, "spherical motion"),
        ("robots/tripteron", 3, "translation"),
        ("robots/3-upu-tsai", 3, "translation"),
        ("robots/quadrupteron", 4, "translation and rotation (Schoenflies)"),
        ("robots/hexapod", None, "all displacements"),
    ],
)
def test_freedoms_of_a_platform_are_those_that_the_robot_was_built_for(
    name: str, dimension: int | None, freedoms: str
) -> None:
    if dimension is None:
        dimension = nag.mobility(mechanism(name), detail="local").local_dimension
    found = parts(name, dimension, "platform").body
    assert found is not None and found.motion.group == freedoms


def test_rods_between_balls_are_idle_and_the_rest_is_not() -> None:
    found = parts("robots/3-sps-s", 6)
    assert [(own.bodies, own.count) for own in found.idle] == [
        ((f"link{i}a", f"link{i}b"), 1) for i in (1, 2, 3)
    ]
    rod = Mechanism(
        "base",
        (
            joint("A", "revolute", ("base", "crank"), (0, 0, 0), Z),
            joint("B", "spherical", ("crank", "rod"), (1, 0, 0), Z),
            joint("C", "spherical", ("rod", "rocker"), (3, 2, 1), Z),
            joint("D", "revolute", ("rocker", "base"), (3, 0, 1), X),
        ),
    )
    dimension = nag.mobility(rod, detail="local").local_dimension
    moving = find_moving_parts(rod, dimension, np.random.default_rng(0))
    assert [(own.bodies, own.count, own.turns) for own in moving.idle] == [(("rod",), 1, True)]
    assert "rod turns about itself" in nag.mobility(rod, detail="local").sentence


def test_joints_that_never_move_are_locked_and_their_bodies_rigid_together() -> None:
    # A slide across the plane of a four-bar linkage, in its loop, cannot move.
    corners = [(0, 0, 0), (0, 2, 0), (3, 3, 0), (4, 0, 0)]
    names = ("base", "left", "top", "right")
    turns = [
        joint(f"T{i}", "revolute", (names[i], names[(i + 1) % 4]), corners[i], Z) for i in range(3)
    ]
    slide = joint("S", "prismatic", ("right", "end"), corners[3], Z)
    last = joint("T3", "revolute", ("end", "base"), corners[3], Z)
    made = Mechanism("base", (*turns, slide, last))
    found = find_moving_parts(made, 1, np.random.default_rng(0), None, "end")
    assert found.locked == ("S",) and found.together == (("right", "end"),)
    assert found.body is not None and found.body.motion.group == "rotation"


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_what_moves_does_not_depend_on_where_it_is_looked_at(seed: int) -> None:
    one, other = parts("robots/3-rps", 3, "platform"), parts("robots/3-rps", 3, "platform", seed)
    assert (one.idle, one.locked, one.together) == (other.idle, other.locked, other.together)
    assert one.body is not None and other.body is not None
    assert one.body == other.body
    assert (one.body.motion.rank, one.body.motion.turning) == (3, 2)
    # At the reference the platform is level: two axes in it, and a translation across.
    assert one.body.screws == ScrewSystem(3, 2, (0.0, 0.0))


def test_what_hangs_on_a_joint_turns_about_it_and_is_not_idle() -> None:
    bars = {"A": (0, 0), "B": (0, 1), "C": (3, 2), "D": (3, 0), "E": (4, 1)}
    bodies = ["base crank", "crank coupler", "coupler rocker", "rocker base", "rocker tail"]
    joints = [
        nag.Joint(name, "revolute", tuple(own.split()), (*place, 0), (0, 0, 1))
        for (name, place), own in zip(bars.items(), bodies, strict=True)
    ]
    report = nag.mobility(nag.Mechanism("base", joints), detail="local")
    assert not report.moving.idle
    assert ("hanging", "tail turns about E") in report.moving.rows()
    assert report.sentence == "it moves with 2 freedoms"


@pytest.mark.parametrize("links", [1, 2, 4])
def test_no_link_of_an_arm_is_idle(links: int) -> None:
    joints = [
        nag.Joint(f"R{i}", "revolute", (f"b{i}", f"b{i + 1}"), (i, i * i, 0), (0, i, 1))
        for i in range(links)
    ]
    report = nag.mobility(nag.Mechanism("b0", joints))
    assert not report.moving.idle
    assert [e.bodies for e in report.moving.hanging] == [(f"b{links}",)]
    assert report.sentence == f"it moves with {links} freedom{'s' * (links > 1)}"


@pytest.mark.parametrize("kind", ["revolute", "spherical"])
def test_a_door_on_two_hinges_is_not_idle(kind: str) -> None:
    hinges = [joint(f"H{z}", kind, ("wall", "door"), (0, 0, z), Z) for z in (0, 2)]
    report = nag.mobility(Mechanism("wall", tuple(hinges)))
    assert not report.moving.idle
    assert report.sentence.startswith("it moves with 1 freedom")


def test_the_report_names_the_body_that_is_asked_for_first(capsys) -> None:
    report = nag.mobility(mechanism("robots/tripteron"), of="platform", detail="local")
    assert report.sentence.startswith(
        "platform: 3 freedoms, translation; the mechanism moves with "
    )
    assert str(report).count("platform: 3 freedoms, translation") == 1
    assert report.document()["moving"]["of"]["kind"] == "translation"
    with pytest.raises(MechanismError, match="of: 'nobody' is no body; they are B0, B1"):
        nag.mobility(mechanism("bennett"), of="nobody")
    assert main(["mobility", str(CASES / "bennett.toml"), "--of", "nobody", "--quiet"]) == 2
    said = capsys.readouterr()
    assert not said.out and said.err.startswith("nag: --of: 'nobody' is no body")


def test_a_part_of_a_mechanism_elsewhere_is_described_there() -> None:
    made = mechanism("robots/3-rrr-planar")
    model = nag.model(made)
    there = find_moving_parts(made, 3, np.random.default_rng(5), None, "platform").body
    report = nag.mobility(made, model.reference, of="platform", detail="local")
    assert report.moving is not None and report.moving.body is not None
    assert there is not None and report.moving.body.motion == there.motion


@pytest.mark.parametrize(
    ("name", "options", "status", "said"),
    [
        (
            "spatial/wren-4",
            ["--of", "plate", "--local"],
            1,
            "plate: not known: the configuration is singular",
        ),
        ("spatial/ur5-held", ["--of", "link2"], 0, "link2: no freedom, it stands still"),
        ("bennett", ["--tolerance", "1e-3"], 0, "not looked at"),
    ],
)
def test_what_is_asked_for_and_not_found_is_said(
    name: str, options: list[str], status: int, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    case = str(CASES / f"{name}.toml")
    assert main(["mobility", case, "--quiet", "--budget", "1", *options]) == status
    label = options[0].removeprefix("--")
    (row,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith(label)]
    assert said in row


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("name", "body", "motions"),
    [
        ("spatial/wren-4", "plate", {(2, 0): 1, (2, 2): 2}),
        ("spatial/wren-6", "plate", {(2, 0): 1, (1, 1): 1}),
        ("planar/kinematotropic-square", "plate", {(0, 0): 1, (3, 1): 1}),
    ],
)
def test_a_body_is_described_along_each_motion_through_a_singular_configuration(
    name: str, body: str, motions: dict[tuple[int, int], int], seed: int
) -> None:
    report = nag.mobility(mechanism(name), of=body, seed=seed)
    found = Counter((own.motion.rank, own.motion.turning) for own in report.along)
    assert found == motions and report.complete
    assert report.sentence.startswith(f"{body}: along 1 of ")
    assert [own["body"] for own in report.document()["along"]] == [body] * sum(motions.values())


def test_a_rod_turns_about_itself_besides_what_its_ends_do() -> None:
    report = nag.mobility(mechanism("spatial/wren-4"), of="rod2")
    assert {str(own.motion) for own in report.along} == {
        "spherical motion about the point (4, 3, 0)"
    }
    assert "rod2: along each of 3 motions 3 freedoms" in report.sentence
    assert "6 freedoms, 4 of them by rods that turn idly about themselves" in report.sentence


def crank(name: str, bodies: tuple[str, str], point: tuple) -> Joint:
    return joint(name, "revolute", bodies, point, Z)


def slide(name: str, bodies: tuple[str, str], axis: tuple) -> Joint:
    return joint(name, "prismatic", bodies, (0, 0, 0), axis)


def ball(name: str, bodies: tuple[str, str], point: tuple) -> Joint:
    return joint(name, "spherical", bodies, point, Z)


@pytest.mark.parametrize(
    "joints",
    [
        (
            crank("A", ("base", "crank"), (0, 0, 0)),
            ball("B", ("crank", "tube"), (1, 0, 0)),
            slide("C", ("tube", "rod"), (2, 2, 1)),
            ball("D", ("rod", "rocker"), (3, 2, 1)),
            joint("E", "revolute", ("rocker", "base"), (3, 0, 1), X),
        ),
        (
            slide("A", ("base", "sledge"), (1, 2, 2)),
            ball("B", ("sledge", "tube"), (1, 0, 0)),
            slide("C", ("tube", "rod"), (2, 2, 1)),
            ball("D", ("rod", "base"), (3, 2, 1)),
        ),
    ],
)
def test_a_telescope_between_two_balls_turns_idly(joints: tuple[Joint, ...]) -> None:
    report = nag.mobility(Mechanism("base", joints), detail="local")
    assert report.moving is not None
    assert [(e.bodies, e.count, e.turns) for e in report.moving.idle] == [
        (("tube", "rod"), 1, True)
    ]
    assert "tube with rod turn" in report.sentence


def test_no_part_of_a_ring_of_five_bars_is_idle() -> None:
    corners = [(0, 0, 0), (0, 2, 0), (1, 4, 0), (4, 3, 0), (5, 0, 0)]
    names = ("base", "a", "b", "c", "d")
    turns = [crank(f"T{i}", (names[i], names[(i + 1) % 5]), corners[i]) for i in range(5)]
    found = find_moving_parts(Mechanism("base", tuple(turns)), 2, np.random.default_rng(0))
    assert not found.idle and not found.hanging and not found.locked


def test_single_turns_that_never_move_are_named() -> None:
    corners = [(0, 0, 0), (0, 2, 0), (3, 3, 0), (4, 0, 0)]
    names = ("base", "left", "top", "right")
    turns = [crank(f"T{i}", (names[i], names[(i + 1) % 4]), corners[i]) for i in range(3)]
    cross = Joint("U", "universal", ("right", "base"), corners[3], Z, X)
    found = find_moving_parts(Mechanism("base", (*turns, cross)), 1, np.random.default_rng(0))
    assert found.locked == ("U.second",)
    assert ("locked", "U.second: never moving") in found.rows()


def test_a_body_s_motion_is_told_where_it_is() -> None:
    axes = [(1, 0, 0), (0, 1, 0), (2, 3, 6)]
    joints = [
        joint(f"R{i}", "revolute", (f"b{i}", f"b{i + 1}"), (5, -7, 11), axis)
        for i, axis in enumerate(axes)
    ]
    report = nag.mobility(Mechanism("b0", tuple(joints)), of="b3")
    assert "b3: 3 freedoms, spherical motion about the point (5, -7, 11)" in report.sentence


def between_balls(*inner: Joint, bodies: tuple[str, ...] = ("r1",)) -> Mechanism:
    """Cranks and a rod between two balls, made of several bodies with joints between these."""
    return Mechanism(
        "base",
        (
            crank("A", ("base", "crank"), (0, 0, 0)),
            ball("B", ("crank", bodies[0]), (1, 0, 0)),
            *inner,
            ball("C", (bodies[-1], "rocker"), (3, 2, 1)),
            joint("D", "revolute", ("rocker", "base"), (3, 0, 1), X),
        ),
    )


def idle_of(made: Mechanism) -> list[tuple[tuple[str, ...], int]]:
    report = nag.mobility(made, detail="local")
    assert report.moving is not None
    return [(e.bodies, e.count) for e in report.moving.idle]


def test_freedoms_are_idle_once() -> None:
    """Both halves of a rod turn about the line of the balls: together as well, which is no more."""
    hinge = joint("H", "revolute", ("r1", "r2"), (1, 0, 0), (2, 2, 1))
    made = between_balls(hinge, bodies=("r1", "r2"))
    assert idle_of(made) == [(("r1",), 1), (("r2",), 1)]
    assert "it moves with 3 freedoms, 2 of them idle" in nag.mobility(made).sentence


def test_what_a_rod_carries_turns_idly_with_it() -> None:
    arm = joint("H", "revolute", ("r1", "arm"), (2, 1, 5), (1, 3, 2))
    made = between_balls(arm, bodies=("r1",))
    assert idle_of(made) == [(("r1", "arm"), 1)]
    moving = nag.mobility(made).moving
    assert moving is not None and [e.bodies for e in moving.hanging] == [("arm",)]


def test_rods_between_bodies_that_are_rigid_together_turn_idly() -> None:
    report = nag.mobility(CASES / "robots" / "hexapod-6-3.toml", detail="local")
    assert report.status == "idle"
    assert report.sentence.startswith("it is rigid but for 6 rods that turn idly, with 6 freedoms")
    assert report.moving is not None and not report.moving.hanging
    assert report.moving.together == (("base", "platform"),)


def test_a_decomposition_says_as_well_that_a_platform_is_rigid_but_for_its_rods(capsys) -> None:
    assert main(["decompose", str(CASES / "robots" / "hexapod-6-3.toml"), "--quiet"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "rigid at the reference configuration but for 6 rods that turn idly, with 6" in said


def test_a_body_on_three_slides_and_a_ball_moves_with_all_freedoms() -> None:
    ends = ["B", "x", "y", "z", "body"]
    slides = [
        joint(f"S{i}", "prismatic", tuple(ends[i : i + 2]), (0, 0, 0), axis)
        for i, axis in enumerate([(1, 0, 0), (0, 1, 0), (0, 0, 1)])
    ]
    ball = Joint("S", "spherical", ("z", "body"), (0, 0, 0))
    flying, swinging = (
        Mechanism("B", (*slides, ball)),
        Mechanism("B", (*slides[:2], replace(ball, bodies=("y", "body")))),
    )
    hanging = [nag.mobility(m).moving.hanging for m in (flying, swinging)]
    assert [[(e.bodies, e.count, e.turns) for e in own] for own in hanging] == [
        [(("body",), 6, False)],
        [(("body",), 3, True)],
    ]


def test_a_door_between_parts_that_are_rigid_together_hangs() -> None:
    hinges = [
        joint("low", "revolute", ("wall", "door"), (0, 0, 0), Z),
        joint("high", "revolute", ("frame", "door"), (0, 0, 2), Z),
        Joint("screwed", "rigid", ("wall", "frame")),
    ]
    report = nag.mobility(Mechanism("wall", tuple(hinges)))
    assert report.moving is not None and not report.moving.idle
    assert [e.bodies for e in report.moving.hanging] == [("door",)]


@pytest.mark.parametrize("away", [0, 10**5, 10**7])
def test_bodies_far_from_the_origin_move_as_near_it(away: int) -> None:
    at = (away, -3 * away, 2 * away)
    corners = [(0, 0, 0), (0, 2, 0), (3, 3, 0), (4, 0, 0)]
    names = ("base", "left", "top", "right")
    turns = [
        crank(
            f"T{i}",
            (names[i], names[(i + 1) % 4]),
            tuple(map(sum, zip(corners[i], at, strict=True))),
        )
        for i in range(4)
    ]
    made = Mechanism("base", tuple(turns))
    top = nag.mobility(made, of="top").moving.body
    assert (top.motion.rank, top.motion.turning, top.motion.group) == (1, 1, "")
    left = nag.mobility(made, of="left").moving.body
    assert left.motion.group == "rotation" and left.screws.pitches == (0.0,)
    axes = [(1, 0, 0), (0, 1, 0), (2, 3, 6)]
    wrist = [joint(f"R{i}", "revolute", (f"b{i}", f"b{i + 1}"), at, a) for i, a in enumerate(axes)]
    hand = nag.mobility(Mechanism("b0", tuple(wrist)), of="b3").moving.body
    assert hand.motion.group == "spherical motion" and hand.screws.pitches == (0.0, 0.0, 0.0)


def test_a_turn_is_told_with_its_line() -> None:
    hinge = joint("R", "revolute", ("wall", "door"), (3, 4, 7), (0, 0, 2))
    moving = nag.mobility(Mechanism("wall", (hinge,)), of="door").moving
    assert moving is not None and moving.body is not None
    assert moving.body.motion.place == "about the line through (3, 4, 0) along (0, 0, 1)"


def on_parallel_legs(feet: list[tuple[int, int]]) -> Mechanism:
    """A platform on rods of one length, all upright, with balls at both ends."""
    joints = []
    for i, (x, y) in enumerate(feet):
        joints += [
            ball(f"A{i}", ("base", f"rod{i}"), (x, y, 0)),
            ball(f"B{i}", (f"rod{i}", "platform"), (x, y, 3)),
        ]
    return Mechanism("base", tuple(joints))


FEET = [(1, 0), (3, 1), (0, 4), (-2, 3), (-3, -1), (2, -5)]


def test_a_body_moves_where_all_configurations_are_singular() -> None:
    """On six equal upright legs it moves in circles, and turns about the upright infinitesimally.

    So it does wherever it is: no configuration is reduced.
    """
    report = nag.mobility(on_parallel_legs(FEET), of="platform", detail="local")
    assert (report.tangent_dimension, report.local_dimension) == (9, 8)
    assert report.moving is not None and report.moving.body is not None
    motion = report.moving.body.motion
    assert (motion.rank, motion.turning) == (2, 0)
    assert report.moving.idle_count == 6 and report.never_reduced
    assert report.sentence.startswith("platform: 2 freedoms, translation with 2 freedoms")
    assert "all configurations near by are singular" in report.sentence


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 10**6), turn=st.integers(-3, 3), far=st.integers(-3, 3))
def test_motions_of_singular_components_do_not_depend_on_where_they_are_looked_at(
    seed: int, turn: int, far: int
) -> None:
    made = on_parallel_legs([(x + far, y - turn * x) for x, y in FEET])
    found = find_moving_parts(made, 8, np.random.default_rng(seed), None, "platform")
    assert found.body is not None
    assert (found.body.motion.rank, found.body.motion.turning) == (2, 0)
    assert [e.bodies for e in found.idle] == [(f"rod{i}",) for i in range(6)]


@pytest.mark.parametrize("name", ["robots/3-upu-wrist", "spatial/sarrus-kinematotropic"])
def test_a_configuration_that_is_more_singular_than_others_is_told_to_be(name: str) -> None:
    made = mechanism(name)
    report = nag.mobility(made, detail="local")
    assert report.moving is None and not report.never_reduced
    assert report.unclear == "the configuration is singular; give a point near by"


@pytest.mark.parametrize(
    ("name", "body", "said"),
    [
        ("planar/four-bar", "coupler", "coupler: 1 freedom, turns about one direction"),
        ("planar/double-parallelogram", "top", "top: 1 freedom, translation with 1 freedom"),
        ("planar/watt-six-bar", "crank", "rotation about the line through (0, 0, 0) along"),
        ("spherical/five-bar", "link3", "link3: 2 freedoms, turns about two directions"),
        ("spatial/bennett", "link1", "link1: 1 freedom, rotation about the line"),
        ("planar/prism-parallel", "E-F", "E-F: 1 freedom, translation with 1 freedom"),
        ("planar/braced-square", "C-D", "C-D: no freedom, it stands still"),
    ],
)
def test_links_tables_and_bars_have_freedoms(name: str, body: str, said: str) -> None:
    report = nag.mobility(read_case(CASES / f"{name}.toml"), of=body, budget=0)
    assert report.moving is not None and report.moving.body is not None
    assert said in str(report.moving.body)


def test_a_link_moves_as_its_component_does() -> None:
    bars = {"base": "AD2", "left": "AB1", "top": "BC2", "right": "CD1"}
    made = nag.Linkage.of(bars, "base")
    somewhere = nag.mobility(made, of="top", budget=0)
    assert somewhere.moving is None and somewhere.unclear.startswith("2 components have 1 freedom")
    c, s = Fraction(3, 5), Fraction(4, 5)
    crossed, upright = (1, 0, 1, 0, -1, 0), (c, s, 1, 0, -c, -s)
    report = nag.mobility(made, upright, of="top", detail="local")
    assert report.moving is not None and report.moving.body is not None
    assert (report.moving.body.motion.rank, report.moving.body.motion.turning) == (1, 0)
    report = nag.mobility(made, crossed, of="top", detail="local")
    assert report.unclear == "the configuration is singular; give a point near by"


def test_a_table_moves_alike_in_both_formulations() -> None:
    case = read_case(CASES / "spatial" / "bennett.toml")
    found = [nag.mobility(case, of="link2", formulation=name, budget=0) for name in "HE"]
    kinds = [r.moving.body.motion.rank for r in found if r.moving and r.moving.body]
    assert kinds == [1, 1]


def test_what_has_no_bodies_is_told_to_have_none(capsys: pytest.CaptureFixture[str]) -> None:
    for name, said in (
        ("spatial/octahedron", "a framework in space has points and bars"),
        ("literature/twisted-cubic", "is for mechanisms, whose bodies have names"),
        ("planar/four-bar", "'stick' is no body; they are base, crank, coupler, rocker"),
    ):
        assert main(["mobility", str(CASES / f"{name}.toml"), "--of", "stick", "--quiet"]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert said in line


def test_a_link_of_a_table_with_irrational_twists_is_told() -> None:
    table = nag.DHLoop.of([{"a": "5/3", "alpha": "pi/2"}, {"a": "5/6", "alpha": "pi/6"}] * 2)
    moving = nag.mobility(table, of="link2").moving
    assert moving is not None and "1 freedom" in str(moving.body)


def test_a_body_that_hangs_on_one_joint_may_be_another_one_misspelled() -> None:
    def chain(last: str) -> str:
        places = {"A": (0, 0), "B": (1, 2), "C": (4, 3), "D": (5, 0), "E": (2, 5)}
        bodies = ["base crank", "crank coupler", "coupler rocker", "rocker base", f"coupler {last}"]
        joints = [
            nag.Joint(name, "revolute", tuple(pair.split()), (*place, 0), (0, 0, 1))
            for (name, place), pair in zip(places.items(), bodies, strict=True)
        ]
        return dict(nag.mobility(nag.Mechanism("base", tuple(joints))).rows())["hanging"]

    assert chain("rockr") == "rockr (did you mean 'rocker'?) turns about E"
    assert chain("rockers") == "rockers turns about E"
    assert chain("pendulum") == "pendulum turns about E"
