"""Robots in URDF and MJCF, as mechanisms with their hands held and their loops closed."""

from __future__ import annotations

import re
from fractions import Fraction
from math import atan2
from pathlib import Path

import numpy as np
import pytest

import nag
from nag.cli import main
from nag.files.cases import read_case
from nag.mechanism.given_rotation import GivenFrame, turns_in_order

HALF = "1.5707963267948966"


def urdf(*joints: tuple[str, str, str, str]) -> str:
    """A chain of joints: type, xyz, rpy, axis."""
    links = "".join(f'<link name="l{k}"/>\n' for k in range(len(joints) + 1))
    text = "".join(
        f'<joint name="j{k + 1}" type="{kind}"><parent link="l{k}"/><child link="l{k + 1}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/></joint>\n'
        for k, (kind, xyz, rpy, axis) in enumerate(joints)
    )
    return f'<?xml version="1.0"?>\n<robot name="arm">\n{links}{text}</robot>\n'


UR5 = urdf(
    ("revolute", "0 0 0.089159", "0 0 0", "0 0 1"),
    ("revolute", "0 0.13585 0", f"0 {HALF} 0", "0 1 0"),
    ("revolute", "0 -0.1197 0.425", "0 0 0", "0 1 0"),
    ("revolute", "0 0 0.39225", f"0 {HALF} 0", "0 1 0"),
    ("revolute", "0 0.093 0", "0 0 0", "0 0 1"),
    ("revolute", "0 0 0.09465", "0 0 0", "0 1 0"),
    ("fixed", "0 0.0823 0", f"0 0 {HALF}", "1 0 0"),
)
SRS = urdf(
    *(
        ("continuous", "0 0 0.3" if k in (3, 4) else "0 0 0", "0 0 0", axis)
        for k, axis in enumerate(["0 0 1", "0 1 0", "0 0 1", "0 1 0", "0 0 1", "0 1 0", "0 0 1"])
    )
)
SCARA = urdf(
    ("revolute", "0 0 0.4", "0 0 0", "0 0 1"),
    ("revolute", "0.3 0 0", "0 0 0", "0 0 1"),
    ("revolute", "0.25 0 0", "0 0 0", "0 0 1"),
    ("prismatic", "0 0 0", "0 0 0", "0 0 -1"),
)
FOUR_BAR = """<mujoco model="four-bar"><compiler angle="radian"/><worldbody>
<body name="a"><joint name="A" axis="0 1 0"/>
 <body name="b" pos="0 0 1"><joint name="B" axis="0 1 0"/>
  <body name="c" pos="2 0 0.5"><joint name="C" axis="0 1 0"/></body></body></body>
</worldbody><equality><connect body1="c" anchor="0.5 0 -1.5"/></equality></mujoco>
"""
LEGS = "".join(
    f"""<body name="u{k}" pos="{x} {y} 0"><joint name="hip{k}" axis="0 0 1"/>
<joint name="lift{k}" axis="{-y} {x} 0"/><body name="f{k}" pos="{x} {y} 0">
<joint name="knee{k}" axis="{-y} {x} 0"/><site name="s{k}" pos="0 0 -1"/>
</body></body>"""
    for k, (x, y) in enumerate([(1, 1), (1, 0), (1, -1), (-1, -1), (-1, 0), (-1, 1)])
)
FEET = "".join(f'<weld body1="f{k}"/>' for k in range(6))
HEXAPOD = f"""<mujoco><worldbody><body name="trunk" pos="0 0 1"><freejoint/>{LEGS}</body>
</worldbody><equality>{FEET}</equality></mujoco>"""


def delta_leg(k: int, inside: str = "") -> str:
    """An arm, and two rods down to the platform, which hangs on the first rod of the first leg."""
    rods = "".join(
        f'<body name="rod{k}{i}" pos="0.5 {y} 0"><joint type="ball"/>{inside if i else ""}</body>'
        for i, y in enumerate(("-0.2", "0.2"))
    )
    return f"""<frame euler="0 0 {120 * k}"><body name="arm{k}" pos="1 0 0">
<joint name="J{k}" axis="0 1 0"/>{rods}</body></frame>"""


PLATFORM = '<body name="platform" pos="-1.1 0 -2"><joint type="ball"/></body>'
RODS = "".join(
    f'<connect body1="rod{k}{i}" body2="platform" anchor="-1.1 0 -2"/>'
    for k in range(3)
    for i in range(2)
    if (k, i) != (0, 1)
)
DELTA = f"""<mujoco><worldbody>{delta_leg(0, PLATFORM)}{delta_leg(1)}{delta_leg(2)}</worldbody>
<equality>{RODS}</equality></mujoco>"""


def local(path: Path, **given: object) -> int:
    case = read_case(path, **given)
    return nag.mobility(case, detail="local").local_dimension


def written(folder: Path, text: str) -> Path:
    path = folder / "robot.xml"
    path.write_text(text)
    return path


ELBOW = {"j1": "0.3", "j2": "-0.7", "j3": "1.1", "j4": "0.4", "j5": "0.9", "j6": "0.2"}


def test_a_general_arm_of_six_turns_is_rigid_with_its_hand_held(tmp_path: Path) -> None:
    assert local(written(tmp_path, UR5), hold=["l7"], at=ELBOW) == 0


def test_an_arm_of_seven_turns_has_one_freedom_left(tmp_path: Path) -> None:
    at = {f"j{k}": f"{k}/5" for k in range(1, 8)}
    assert local(written(tmp_path, SRS), hold=["l7"], at=at) == 1


def test_a_scara_is_rigid_with_its_hand_held(tmp_path: Path) -> None:
    assert local(written(tmp_path, SCARA), hold=["l4"], at={"j2": "pi/3", "j4": "0.1"}) == 0


def test_a_four_bar_closed_by_a_point_has_one_freedom(tmp_path: Path) -> None:
    assert local(written(tmp_path, FOUR_BAR)) == 1


def test_feet_that_are_welded_leave_a_hexapod_of_three_turns_a_leg_rigid(tmp_path: Path) -> None:
    assert local(written(tmp_path, HEXAPOD)) == 0


def test_a_delta_has_three_freedoms_and_six_rods_that_turn(tmp_path: Path) -> None:
    assert local(written(tmp_path, DELTA)) == 3 + 6


def test_angles_in_doubles_and_in_four_decimals_are_recognised(tmp_path: Path) -> None:
    frames = [
        GivenFrame(turns_in_order([Fraction(0), Fraction(t), Fraction(0)], "XYZ").quaternion)
        for t in (HALF, "1.5708", "1.5707")
    ]
    assert all(f.matrix == frames[0].matrix for f in frames)
    assert frames[0].turned((1, 0, 0)) == (0, 0, -1)
    assert "1.57079632679 as pi/2" in read_case(written(tmp_path, UR5)).notes[0]


@pytest.mark.parametrize("text", ["0.3", "-1.2", "2.9999", "3.1", "0.001", "1.57", "-6.1"])
def test_other_angles_are_rational_rotations_next_to_them(text: str) -> None:
    turn = turns_in_order([Fraction(text)], "z")
    rows = GivenFrame(turn.quaternion).matrix
    for i in range(3):
        for j in range(3):
            assert sum(x * y for x, y in zip(rows[i], rows[j], strict=True)) == (i == j)
    angle = atan2(rows[1][0], rows[0][0])
    turns = (angle - float(text)) / 6.283185307179586
    assert abs(turns - round(turns)) < 1e-15
    there = turn.then(turns_in_order([-Fraction(text)], "z"))
    assert there.quaternion[1:] == (0, 0, 0)


BROKEN = {
    "entity": ('<!DOCTYPE robot [<!ENTITY a "b">]><robot/>', "document type"),
    "no xml": ("<robot>", "is not valid XML"),
    "other": ("<sdf/>", "no <robot>"),
    "mimic": (SCARA.replace("</joint>", '<mimic joint="j1"/></joint>', 1), "gears"),
    "number": (SCARA.replace("0.25 0 0", "0.25 nan 0"), "no decimal number"),
    "macro": (SCARA.replace("0.25 0 0", "${a} 0 0"), "xacro"),
    "tag": (FOUR_BAR.replace("connect", "w" * 2000), "<" + "w" * 37 + "...>: is not modelled"),
    "axis": (SCARA.replace("0 0 -1", "0 0 0"), "length zero"),
    "type": (SCARA.replace("prismatic", "prismtic"), "did you mean"),
    "two parents": (SCARA.replace('child link="l2"', 'child link="l1"'), "is the child of a joint"),
    "gear": (FOUR_BAR.replace("<connect", '<joint joint1="A"/><connect'), "is not modelled"),
    "include": (
        FOUR_BAR.replace("<worldbody>", '<include file="/etc/passwd"/><worldbody>'),
        "read",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_bad_files_are_one_line(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, message = BROKEN[name]
    assert main(["mobility", str(written(tmp_path, text))]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line and re.search(r": line \d+, column \d+: ", line)


def test_faults_are_placed_at_the_start_of_their_elements(tmp_path: Path) -> None:
    joint = '<joint name="é" type="revolute"><parent link="a"/><child link="b"/>{}</joint>'
    bad = {
        '<axis xyz="0 0"/>': "line 3, column 68: <axis>: xyz: has 2 entries",
        '<mimic joint="a"/>': "line 3, column 68: <mimic>",
        '<axis xyz="0 0 1"': "line 3, column 85: is not valid XML",
    }
    for text, place in bad.items():
        lines = '<robot name="r">\n<link name="a"/><link name="b"/>\n' + joint.format(text)
        with pytest.raises(nag.CaseError, match=re.escape(place)):
            nag.read(written(tmp_path, f"{lines}</robot>"))
    twice = FOUR_BAR.replace('name="C"', 'name="A"')
    with pytest.raises(nag.CaseError, match=r"line 4, column 32: joint 'A' is there twice"):
        nag.read(written(tmp_path, twice))


def test_links_and_joints_are_asked_for_by_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(written(tmp_path, SCARA))
    for options in (["--hold", "l9"], ["--hold", "l0"], ["--at", "j9=1"], ["--at", "j1"]):
        assert main(["mobility", path, *options]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1
    assert main(["mobility", path, "--hold", "l4", "--at", "j2=pi/3", "--local", "--quiet"]) == 0
    assert "l4 held" in capsys.readouterr().out


BAR = urdf(
    ("revolute", "0 0 0", "0 0 0", "0 0 1"),
    ("revolute", "0 1 0", "0 0 0", "0 0 1"),
    ("revolute", "2 0.5 0", "0 0 0", "0 0 1"),
)
BAR_CASE = """\
title = "a four-bar"
kind = "robot"
file = "bar.urdf"

[parameters]
q = 0

[at]
j1 = "q"

[[closure]]
name = "D"
type = "revolute"
bodies = ["l3", "l0"]
point = [0.5, -1.5, 0]
axis = [0, 0, 1]
"""


def robot_case(folder: Path, text: str = BAR_CASE) -> Path:
    (folder / "bar.urdf").write_text(BAR)
    (folder / "bar.toml").write_text(text)
    return folder / "bar.toml"


def test_a_case_of_a_robot_says_what_the_options_say(tmp_path: Path) -> None:
    (tmp_path / "ur5.urdf").write_text(UR5)
    values = "\n".join(f'{joint} = "{value}"' for joint, value in ELBOW.items())
    case = f'title = "UR5"\nkind = "robot"\nfile = "ur5.urdf"\nhold = ["l7"]\n[at]\n{values}\n'
    (tmp_path / "ur5.toml").write_text(case)
    by_options = read_case(tmp_path / "ur5.urdf", hold=["l7"], at=ELBOW)
    by_case = read_case(tmp_path / "ur5.toml")
    assert by_case.mechanism == by_options.mechanism
    assert by_case.notes == by_options.notes


def test_a_loop_of_urdf_is_closed_where_its_joints_stand(tmp_path: Path) -> None:
    path = robot_case(tmp_path)
    for q in ("0", "0.3", "-2"):
        case = read_case(path, {"q": q})
        closing = case.mechanism.joints[-1]
        assert (closing.name, closing.bodies) == ("D", ("l3", "l0"))
        assert nag.mobility(case, detail="local").local_dimension == 1
    # With j1 at zero, by the lengths in the file.
    assert read_case(path).mechanism.joints[-1].point == (Fraction(5, 2), 0, 0)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"bar.urdf"', '"../bar.urdf"', "file: '../bar.urdf' does not lie beside the case"),
        ('"bar.urdf"', '"/etc/passwd"', "file: '/etc/passwd' does not lie beside the case"),
        ('"bar.urdf"', '"none.urdf"', "cannot be read"),
        ('"bar.urdf"', f'"{"x" * 201}"', "is longer than 200 characters"),
        ('"bar.urdf"', '"bar.toml"', "is no robot"),
        ("j1 = ", "j9 = ", "at: 'j9' is no joint"),
        ('"q"', '"p"', "[at]: j1: column 1: unknown name 'p'"),
        ('"revolute"', '"revolt"', "type: 'revolt' is unknown (did you mean 'revolute'?)"),
        ('"l0"]', '"l9"]', "[[closure]] 1 'D': bodies: 'l9' is no link"),
        ('"l0"]', '"l3"]', "bodies: are the same"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 0]", "axis: has length zero"),
        ("axis = [0, 0, 1]", "", "axis: is missing"),
        ("axis = ", "second_axis = [1, 0, 0]\naxis = ", "second_axis: a revolute joint has none"),
        ("axis = ", "second_point = [2, 0, 0]\naxis = ", "the loop is open by 0.5"),
        ('name = "D"', 'name = "j1"', "another joint has that name"),
        ("[parameters]", 'hold = ["l0"]\n[parameters]', "hold: 'l0' is fixed as it is"),
    ],
)
def test_a_bad_case_of_a_robot_is_one_line(
    old: str, new: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert BAR_CASE.count(old) == 1 or old == '"l0"]'
    path = robot_case(tmp_path, BAR_CASE.replace(old, new))
    assert main(["show", str(path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["model"], "4 revolute joints"),
        (["decompose"], "1 component of dimension 1, degree 4"),
        (["motion"], "it moves with 1 freedom"),
        (["mobility"], "mobile: it moves with 1 freedom"),
        (["sample", "--count", "1"], "dimension 1, degree 4"),
    ],
)
def test_commands_take_cases_of_robots(
    words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([words[0], str(robot_case(tmp_path)), *words[1:]]) == 0
    assert said in capsys.readouterr().out


URDF_ARM = """<robot name="arm"><link name="l0"/><link name="l1"/><link name="l2"/>
<joint name="j1" type="revolute"><parent link="l0"/><child link="l1"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/>
<origin xyz="0 0 0.4"/></joint></robot>"""
MJCF_ARM = """<mujoco><worldbody><body name="b"><joint name="j" type="hinge"/></body></worldbody>
</mujoco>"""


@pytest.mark.parametrize(
    ("text", "old", "new", "said"),
    [
        (URDF_ARM, '<child link="l2"', '<child link="l0"', "'j2': its child 'l0' is above it: "),
        (URDF_ARM, "0.4", "ninety", "'ninety' is no decimal number; write one like 0.5 or 5e-3"),
        (URDF_ARM, "0.4", "1e400", "whose exponent has two digits at the most"),
        (URDF_ARM, "0.4", "0." + "3" * 60, "has more than 60 places; write fewer"),
        (URDF_ARM, "0 0 0.4", "0,0,0.4", "has 1 entry; write 3 numbers, with blanks between them"),
        (URDF_ARM, "robot", "robt", "(did you mean 'robot'?)"),
        (MJCF_ARM, "hinge", "revolute", "'revolute' is unknown (did you mean 'hinge'?)"),
        (MJCF_ARM, "hinge", "prismatic", "'prismatic' is unknown (did you mean 'slide'?)"),
    ],
)
def test_a_fault_of_a_robots_file_is_named_where_it_is_with_what_to_write(
    text: str, old: str, new: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "arm.xml"
    path.write_text(text.replace(old, new))
    assert main(["mobility", str(path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line


def test_a_link_that_floats_moves_with_all_freedoms(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(URDF_ARM.replace('"j1" type="revolute"', '"j1" type="floating"'))
    assert main(["mobility", str(path.resolve()), "--quiet"]) == 0
    assert "l2 turns about j2" in capsys.readouterr().out
    path.write_text(URDF_ARM.replace('"j2" type="revolute"', '"j2" type="floating"'))
    assert main(["mobility", str(path.resolve()), "--quiet"]) == 0
    assert "l2 moves by itself, with 6 freedoms" in capsys.readouterr().out


HELD = ["--hold", "l7", "--at", ", ".join(f"{joint} = {v}" for joint, v in ELBOW.items())]


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (["model"], 0, "6 revolute joints"),
        (["solve"], 0, "8 isolated solutions"),
        (["decompose"], 0, "8 components of dimension 0"),
        (["motion", "--circuit", "all"], 2, "does not move"),
        (["modes"], 2, "3 legs"),
        (["local"], 0, "isolated, of multiplicity 1"),
    ],
)
def test_commands_take_robots_with_their_hands_held(
    words: list[str],
    status: int,
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = str(written(tmp_path, UR5))
    assert main([words[0], path, *words[1:], *HELD]) == status
    shown = capsys.readouterr()
    assert said in shown.out + shown.err


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (["local"], 0, "reference: x_j1 = -3/7, x_j2 = 5/9"),
        (["member"], 0, "on 1 of 2 components; local dimension 0"),
        (["sample", "--count", "1"], 0, "dimension 0, degree 1"),
        (["singular"], 0, "no singular points"),
        (["intersect", "--components", "1", "2"], 0, "they do not meet"),
        (["eliminate"], 2, "there is nothing to eliminate from"),
        (["eliminate", "--component", "3"], 2, "--component: 3: there are components 1 to 2"),
        (["show"], 0, "5 bodies"),
    ],
)
def test_components_and_points_are_asked_of_robots_that_stand_somewhere(
    words: list[str],
    status: int,
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = str(written(tmp_path, SCARA))
    held = ["--hold", "l4", "--at", "j2 = pi/3", "--at", "j4 = 0.1"]
    assert main([words[0], path, *words[1:], *held]) == status
    shown = capsys.readouterr()
    assert said in shown.out + shown.err


LIMITED = """<robot name="arm"><link name="base"/><link name="a"/><link name="hand"/>
<joint name="A" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
 <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="B" type="continuous"><parent link="a"/><child link="hand"/><origin xyz="1 0 0"/>
 <axis xyz="0 0 1"/><limit effort="1" velocity="1"/></joint></robot>"""
RANGES = """<mujoco><default><default class="short"><joint range="-1 1"/></default></default>
<worldbody><body name="a"><joint name="A" class="short"/><body name="b" pos="1 0 0">
<joint name="B" range="-1 1" limited="false"/></body></body></worldbody></mujoco>"""


@pytest.mark.parametrize("text", [LIMITED, RANGES], ids=["urdf", "mjcf"])
def test_limits_of_joints_are_said_not_to_be_used(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(written(tmp_path, text))
    for command in ("show", "mobility"):
        assert main([command, path]) == 0
        assert "limits of 1 joint are not used" in capsys.readouterr().out
    free = text.replace('lower="-1" upper="1" ', "").replace('range="-1 1"', "")
    free = free.replace('type="revolute"', 'type="continuous"')
    assert not read_case(written(tmp_path, free)).notes


def test_postures_say_what_was_moved_and_what_angles_count_from(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    turns = urdf(*(("revolute", "1 0 0", "0 0 0", "0 0 1") for _ in range(3)))
    case = read_case(written(tmp_path, turns))
    first, second, *_ = (joint.name for joint in case.mechanism.joints)
    hand = case.mechanism.body_names[-1]
    words = ["motion", str(case.path), "--at", f"{first} = 0.3, {second} = 0.4", "--quiet"]
    assert main([*words, "--pose", f"{hand}=0,0,0"]) == 0
    found = " ".join(capsys.readouterr().out.split())
    # The elbow is on one side or on the other.
    assert f"driven {hand} moved by (0, 0, 0) from where it is drawn: 2 real assemblies" in found
    assert "angles count from the position in which it is drawn" in found


def test_an_arm_whose_held_hand_keeps_it_still_is_told_how_its_postures_are_found(
    tmp_path: Path, capsys
) -> None:
    path, stand = str(written(tmp_path, SCARA)), ["--at", "j2=pi/3"]
    assert main(["motion", path, "--hold", "l4", *stand, "--quiet"]) == 2
    said = capsys.readouterr().err
    assert said.endswith("; for its postures: --pose l4=0,0,0 in place of --hold\n")
    assert main(["motion", path, "--pose", "l4=0,0,0", *stand, "--quiet"]) == 0
    assert "2 real assemblies" in capsys.readouterr().out
    assert main(["motion", path, "--quiet"]) == 2
    assert "--hold" not in capsys.readouterr().err


@pytest.mark.parametrize(
    "orientation",
    ['zaxis="0 -1 0"', 'axisangle="1 0 0 90"', 'xyaxes="1 0 0 0 0 1"', 'euler="90 0 0"'],
)
def test_each_way_to_write_an_orientation_says_the_same(tmp_path: Path, orientation: str) -> None:
    path = tmp_path / "arm.xml"
    path.write_text(
        f'<mujoco><worldbody><body name="a" {orientation}><joint name="j"/></body></worldbody>'
        "</mujoco>"
    )
    (joint,) = read_case(path).mechanism.joints
    axis = np.array([float(x) for x in joint.axis])
    assert axis / np.linalg.norm(axis) == pytest.approx([0, -1, 0], abs=1e-15)
