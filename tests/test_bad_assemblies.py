"""Every mistake in a case that gives a mechanism by its parts is answered with one line."""

from __future__ import annotations

import re

import pytest

from nag.cli import main
from nag.files.cases import read_case

DH = 'title = "t"\nkind = "dh"\n' + '[[joint]]\na = 1\nalpha = "pi/2"\n' * 4
GIVEN = DH.replace('alpha = "pi/2"\n', 'alpha = "pi/2"\ntheta = 0\n')
FRAMEWORK = """\
title = "t"
kind = "framework"
points = ["A", "B", "C"]
bars = [["A", "B"], ["B", "C"], ["C", "A"]]
lengths = [3, 4, 5]
"""
PLACED = FRAMEWORK.replace("lengths = [3, 4, 5]\n", "").replace(
    'points = ["A", "B", "C"]\n', "points = { A = [0, 0], B = [3, 0], C = [0, 4] }\n"
)
LINKAGE = """\
title = "t"
kind = "linkage"
ground = "base"
link = [
  { name = "base", pins = ["A", "D"], length = 4 },
  { name = "crank", pins = ["A", "B"], length = 1 },
  { name = "rod", pins = ["B", "C"], length = 3 },
  { name = "rocker", pins = ["C", "D"], length = 2 },
]
"""
MECHANISM = """\
title = "t"
kind = "mechanism"
ground = "A"
joint = [
  { name = "J", type = "revolute", bodies = ["A", "B"], point = [0, 0, 0], axis = [0, 0, 1] },
  { name = "K", type = "revolute", bodies = ["A", "B"], point = [1, 0, 0], axis = [0, 0, 1] },
]
"""
LINE = "point = [1, 0, 0], axis = [0, 0, 1]"


def line(text: str) -> str:
    return MECHANISM.replace(LINE, text)


def universal(text: str) -> str:
    between = '", bodies = ["A", "B"], '
    return MECHANISM.replace(f"revolute{between}{LINE}", f"universal{between}{text}")


def table(old: str, new: str) -> str:
    return DH.replace(old, new, 1)


BROKEN: dict[str, tuple[str, str]] = {
    # name: (content, what the line says after the name of the file)
    "plates in a framework": (
        FRAMEWORK.replace("bars", 'plates = [["A", "B", "C"]]\nbars', 1),
        'plates: plates are links of kind = "linkage": [[link]] with pins and their shape',
    ),
    "unknown kind": (
        DH.replace('"dh"', '"dhh"'),
        "kind: 'dhh' is no kind of case; write one of system, mechanism, dh, robot, framework, "
        "linkage",
    ),
    "key of another kind": (
        DH + "[points]\nA = [0, 0]\n",
        "points: belongs to a case of kind 'framework'; leave it out",
    ),
    "formulation of a framework": (
        FRAMEWORK
        + '[[truth.component]]\ndimension = 0\ndegree = 1\nformulation = "E"\nsource = "s"\n',
        "[[truth.component]] 1: formulation: a system has no formulation; leave it out",
    ),
    "two joints": (
        DH[: DH.rindex("[[joint]]")][: -len('[[joint]]\na = 1\nalpha = "pi/2"\n')],
        "joint: a loop needs at least 3 joints, not 2",
    ),
    "twist missing": (
        table('alpha = "pi/2"\n', ""),
        "[[joint]] 1: alpha: is missing; give the link's twist, or alpha_half_tangent",
    ),
    "twist twice": (
        table('alpha = "pi/2"\n', 'alpha = "pi/2"\nalpha_half_tangent = 1\n'),
        "[[joint]] 1: alpha_half_tangent: alpha is given as well; leave one of them out",
    ),
    "name twice": (
        DH.replace("a = 1\n", 'a = 1\nname = "J"\n'),
        "[[joint]] 2: name: another joint has that name",
    ),
    "unknown key in a table": (
        table("a = 1\n", "a = 1\nr = 2\n"),
        "[[joint]] 1: r: unknown key; the keys here are name, a, d, alpha, alpha_half_tangent, "
        "theta, theta_half_tangent",
    ),
    "two open angles": (
        GIVEN.replace("theta = 0\n", "", 2),
        "joint: 2 open angles; leave at least three open, or give all of them",
    ),
    "a loop that does not close": (
        GIVEN.replace('"pi/2"', "0"),
        "joint: the loop does not close: after the last row a gap of 4 and a turn of 0 degrees are "
        "left; correct the table, or leave angles out to find how it closes",
    ),
    "axes in one line": (
        DH.replace("a = 1", "a = 0").replace('"pi/2"', "0"),
        "joint: all axes are one line: every joint turns freely",
    ),
    "bar to nowhere": (
        FRAMEWORK.replace('["C", "A"]', '["C", "D"]'),
        "bars: a bar ends in 'D', which is no point",
    ),
    "bar to itself": (
        FRAMEWORK.replace('["C", "A"]', '["C", "C"]'),
        "bars: a bar joins 'C' with itself",
    ),
    "bar twice": (
        FRAMEWORK.replace('["C", "A"]', '["B", "A"]'),
        "bars: 'B' and 'A' are joined by two bars; leave one out",
    ),
    "bar of three": (
        FRAMEWORK.replace('["C", "A"]', '["C", "A", "B"]'),
        'bars 3: is a list of 3; write the names of two points, ["A", "B"]',
    ),
    "bar of length zero": (
        PLACED.replace("[0, 4]", "[3, 0]"),
        "bars: the bar from 'B' to 'C' has length zero; make its ends one point",
    ),
    "negative length": (
        FRAMEWORK.replace("[3, 4, 5]", "[3, -4, 5]"),
        "lengths 2: is not positive; a bar has a positive length",
    ),
    "lengths missing": (
        FRAMEWORK.replace("lengths = [3, 4, 5]\n", ""),
        'lengths: is missing; give one for each bar, or places of the points, A = ["1/2", 3]',
    ),
    "lengths of placed points": (
        PLACED.replace("bars", "lengths = [3, 4, 5]\nbars"),
        "lengths: the points have places, which fix the lengths; leave it out",
    ),
    "loose parts": (
        FRAMEWORK.replace('"C"]\n', '"C", "D", "E"]\n')
        .replace('["C", "A"]', '["C", "A"], ["D", "E"]')
        .replace("[3, 4, 5]", "[3, 4, 5, 6]"),
        "bars: no bars connect D, E with 'A'; parts that are not connected move freely, take them "
        "one by one",
    ),
    "one bar": (
        FRAMEWORK.replace('"B", "C"]\n', '"B"]\n')
        .replace(', ["B", "C"], ["C", "A"]', "")
        .replace("[3, 4, 5]", "[3]"),
        "points: 2 points in dimension 2 leave nothing to place; add points",
    ),
    "bars in line in space": (
        'title = "t"\nkind = "framework"\ndimension = 3\n'
        'bars = [["A", "B"], ["B", "C"], ["C", "D"]]\n'
        "[points]\nA = [0, 0, 0]\nB = [1, 0, 0]\nC = [3, 0, 0]\nD = [4, 0, 0]\n",
        "bars: all bars that meet are in line; a framework in space needs two that are not, which "
        "are pinned",
    ),
    "dimension four": (
        "dimension = 4\n" + FRAMEWORK,
        "dimension: is 4; write 2 for the plane or 3 for space",
    ),
    "ground that is no link": (
        LINKAGE.replace('"base"\n', '"floor"\n'),
        "ground: 'floor' is no link; the links are base, crank, rod, rocker",
    ),
    "two grounds": (
        LINKAGE.replace('ground = "base"', 'ground = ["base", "rod"]'),
        'ground: is a list; write a text in quotes: ground = "..."',
    ),
    "link of length zero": (
        LINKAGE.replace("length = 3", "length = 0"),
        "[[link]] 3 'rod': length: pins 'B' and 'C' are at the same place: a link of length zero; "
        "make them one pin",
    ),
    "length for three pins": (
        LINKAGE.replace('["B", "C"]', '["B", "C", "P"]'),
        "[[link]] 3 'rod': length: is for two pins, here are 3; write their places: shape",
    ),
    "length and shape": (
        LINKAGE.replace("length = 3", "length = 3, shape = [[0, 0], [3, 0]]"),
        "[[link]] 3 'rod': length: is given beside 'shape'; write a length for two pins, or a "
        "shape for more",
    ),
    "loose link": (
        LINKAGE.replace('["C", "D"]', '["E", "F"]'),
        "[[link]] 4 'rocker': pins: no pin connects it with the ground 'base'",
    ),
    "no loop": (
        LINKAGE.replace('["C", "D"]', '["C", "F"]'),
        "the links form no loop: each turns freely, there is nothing to solve; of one link alone "
        "are the pins D of base, F of rocker",
    ),
    "two points of an axis that are one": (
        line("through = [[1, 2, 3], [1, 2, 3]]"),
        "[[joint]] 2 'K': through: both points are the same; an axis needs two different ones",
    ),
    "one point of an axis": (
        line("through = [[1, 2, 3]]"),
        "[[joint]] 2 'K': through: has 1 entries; write a list of 2 points [x, y, z] of the axis",
    ),
    "moment that fits no line": (
        line("line = { direction = [0, 0, 1], moment = [0, 1, 2] }"),
        "[[joint]] 2 'K': line: moment: its product with the direction is 2, it must be 0: the "
        "moment is point x direction",
    ),
    "direction of length zero": (
        line("line = { direction = [0, 0, 0], moment = [0, 1, 2] }"),
        "[[joint]] 2 'K': line: direction: has length zero; a line needs a direction",
    ),
    "axis twice": (
        line(LINE + ", through = [[0, 0, 0], [0, 0, 1]]"),
        "[[joint]] 2 'K': point: 'through' gives the axis already; leave one of them out",
    ),
    "axes of a universal joint that do not meet": (
        universal("point = [0, 0, 0], axis = [0, 0, 1], second_through = [[0, 3, 0], [4, 3, 1]]"),
        "[[joint]] 2 'K': second_through: passes the first axis at a distance of 3; the axes of a "
        "universal joint meet",
    ),
    "second axis twice": (
        universal(
            "point = [0, 0, 0], axis = [0, 0, 1], second_axis = [1, 0, 0], "
            "second_line = { direction = [1, 0, 0], moment = [0, 0, 0] }"
        ),
        "[[joint]] 2 'K': second_axis: 'second_line' gives the axis already; leave one of them out",
    ),
    "the same joint twice": (
        line("point = [0, 0, 0], axis = [0, 0, -2]"),
        "[[joint]] 2 'K': axis: the same axis joins 'A' and 'B' in joint 'J' already; leave one "
        "of them out",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_one_line_says_where_what_and_what_would_be_right(name, tmp_path, capsys):
    text, message = BROKEN[name]
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    assert main(["decompose", str(path)]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err == f"nag: {path}: {message}\n"


@pytest.mark.parametrize(
    ("option", "value", "message"),
    [
        ("--set", "m", "'m' is not of the form NAME=VALUE"),
        (
            "--set",
            "zeta=1",
            "[parameters]: zeta: is no parameter of the case; the parameters are a, b",
        ),
        ("--set", "b=1/0", "b: "),
        ("--sweep", "b=1:2", "'b=1:2' is not of the form NAME=FIRST:LAST:COUNT"),
        ("--sweep", "b=1:1:5", "both ends are the same; write --set"),
        ("--sweep", "b=1:2:1", "'1' is no number of values from 2 to 1000"),
        ("--sweep", "b=1:sqrt(2):3", "'sqrt(2)' is no number; write 1.5 or 3/2"),
        ("--sweep", "b=1/0:2:3", "'1/0' is no number; write 1.5 or 3/2"),
    ],
)
def test_values_of_parameters_that_make_no_sense_are_answered_with_one_line(
    option, value, message, tmp_path, capsys
):
    path = tmp_path / "case.toml"
    path.write_text(LINKAGE + "[parameters]\na = 1\nb = 2\n", encoding="utf-8")
    assert main(["decompose", str(path), option, value]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.count("\n") == 1
    assert message in output.err


@pytest.mark.parametrize("text", [DH, FRAMEWORK, PLACED, LINKAGE, MECHANISM])
def test_the_parts_of_these_cases_are_sound_without_their_fault(text, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    assert re.fullmatch("dh|framework|linkage|mechanism", read_case(path).kind)
