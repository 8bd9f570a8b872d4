"""``nag motion``: what it says, writes and refuses."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import nag
from nag.cli import main
from nag.files.json_schema import schema
from nag.kinematics.joint_values import Coordinate
from nag.kinematics.shown import circuit_rows, value_text

CASES = Path(__file__).parent.parent / "cases"


def ask(*words: str) -> int:
    return main(["motion", *words, "--quiet"])


def test_circuits_ranges_and_dead_points_are_said(capsys) -> None:
    assert ask(str(CASES / "planar" / "four-bar.toml")) == 0
    printed = capsys.readouterr().out
    assert "dimension 1, degree 6; 2 circuits" in printed
    assert printed.count("turns fully") == 4
    assert (
        printed.count("29.99\u00b0 to 64.06\u00b0") + printed.count("-64.06\u00b0 to -29.99\u00b0")
        == 2
    )


def test_a_dead_point_that_is_passed_twice_is_written_once(capsys) -> None:
    assert ask(str(CASES / "planar" / "stephenson-six-bar.toml")) == 0
    (line,) = (t for t in capsys.readouterr().out.splitlines() if t.startswith("D "))
    assert line.count("90.00\u00b0 (A -36.87\u00b0)") == 1 and "(A -36.87\u00b0) twice, " in line


def test_angles_are_told_within_a_turn() -> None:
    found = nag.motion(CASES / "planar" / "watt-six-bar.toml")
    for circuit in found.circuits:
        values = circuit.values
        swinging = values.turns == 0
        middles = values.ranges[swinging].mean(axis=1)
        assert len(middles) and (np.abs(middles) <= np.pi + 1e-6).all()
        # Samples and dead points are shifted with the ranges.
        assert (values.values[:, swinging].min(axis=0) >= values.ranges[swinging, 0] - 1e-12).all()
        names = [each.name for each in values.coordinates]
        for point in values.turning:
            low, high = values.ranges[names.index(point.coordinate)]
            assert low <= point.value <= high
            others = np.array(point.others)[swinging]
            assert (others >= values.ranges[swinging, 0] - 1e-9).all()
    texts = [row for circuit in found.circuits for row in circuit_rows(found, circuit)]
    angles = [float(x) for row in texts for x in re.findall(r"\(A (-?[\d.]+)\u00b0", row)]
    assert angles and all(-180 < x <= 180 for x in angles)


def test_circuits_through_the_reference_are_not_told_as_all_of_a_component(capsys) -> None:
    # The rod is longer than the crank: the slider stays on either side of it.
    case = str(CASES / "planar" / "slider-crank.toml")
    assert ask(case) == 0
    assert "1 circuit through the reference configuration\n" in capsys.readouterr().out
    assert ask(case, "--circuit", "all") == 0
    assert "degree 4; 2 circuits\n" in capsys.readouterr().out


def test_a_motion_that_crosses_itself_says_where(capsys) -> None:
    assert ask(str(CASES / "planar" / "four-bar-folding.toml")) == 0
    printed = capsys.readouterr().out
    for share in ("0.0", "50.0"):
        assert f"crosses itself at {share} % of its length\n" in printed


def test_the_table_and_the_document_hold_the_same_numbers(tmp_path, capsys) -> None:
    table, document, page = (tmp_path / f"motion.{kind}" for kind in ("csv", "json", "html"))
    case = str(CASES / "bennett.toml")
    options = ["--samples", "24", "--angles", "radians"]
    files = ["--csv", str(table), "--json", str(document), "--html", str(page)]
    assert ask(case, *options, *files) == 0
    with table.open(newline="") as file:
        head, *rows = csv.reader(file)
    (circuit,) = json.loads(document.read_text())["circuits"]
    numbers = np.array(rows, dtype=float)
    assert numbers.shape == (25, 2 + 4 + 7 * 4)
    for joint in circuit["joints"]:
        assert numbers[:, head.index(joint["name"])].tolist() == joint["values"]
    for body in circuit["bodies"]:
        start = head.index(f"{body['name']}.x")
        assert numbers[:, start : start + 3].tolist() == body["positions"]
        assert numbers[:, start + 3 : start + 7].tolist() == body["quaternions"]
    before = page.read_bytes()
    assert len(before) < 1_000_000
    assert ask(case, *options, *files) == 0
    assert page.read_bytes() == before


def test_assemblies_at_a_value_of_a_joint_are_listed(capsys) -> None:
    assert ask(str(CASES / "planar" / "four-bar.toml"), "--drive", "A=30") == 0
    printed = capsys.readouterr().out
    assert "A at 30.00\u00b0: 2 real assemblies" in printed
    assert "44.09\u00b0" in printed


def test_assemblies_at_each_value_that_a_joint_is_driven_through_are_listed(capsys) -> None:
    assert ask(str(CASES / "planar" / "four-bar.toml"), "--drive", "A=30:60:2") == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    start = lines.index(["A", "assembly", "circuit", "D", "B", "C"])
    assert [row[:4] for row in lines[start + 1 : start + 5]] == [
        ["30.00\u00b0", "1", "1", "-62.22\u00b0"],
        ["30.00\u00b0", "2", "2", "44.09\u00b0"],
        ["60.00\u00b0", "1", "1", "-63.82\u00b0"],
        ["60.00\u00b0", "2", "2", "36.02\u00b0"],
    ]


def test_what_is_at_a_value_is_all_that_its_table_has(tmp_path, capsys) -> None:
    table, case = tmp_path / "a.csv", str(CASES / "planar" / "four-bar.toml")
    assert ask(case, "--drive", "A=30", "--csv", str(table)) == 0
    assert [line.split(",")[0] for line in table.read_text().splitlines()] == ["circuit", "1", "2"]
    capsys.readouterr()
    # The rocker swings from 29.99 to 64.06 degrees, to either side.
    for value in ("120", "110:120:2"):
        assert ask(case, "--drive", f"D={value}", "--csv", str(table)) == 0
        assert len(table.read_text().splitlines()) == 1
        printed = " ".join(capsys.readouterr().out.split())
        assert f"table {table}, without rows: there is no assembly" in printed
    # A circuit that has the value throughout is in it, and assemblies on others.
    assert ask(KITE, "--drive", "D=0", "--csv", str(table), "--samples", "24") == 0
    circuits = [line.split(",")[0] for line in table.read_text().splitlines()[1:]]
    assert circuits == ["1"] * 25 + ["2"] * 2


@pytest.mark.parametrize("value", ["0", "0:10:2"])
def test_each_file_that_is_written_is_named(value: str, tmp_path, capsys) -> None:
    files = {"table": tmp_path / "a.csv", "page": tmp_path / "a.html", "json": tmp_path / "a.json"}
    options = [f"--{file.suffix[1:]}" for file in files.values()]
    words = [x for pair in zip(options, map(str, files.values()), strict=True) for x in pair]
    case = str(CASES / "planar" / "five-bar.toml")
    assert ask(case, "--drive", f"A={value}", "--samples", "24", *words) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert all([label, str(file)] in lines and file.exists() for label, file in files.items())
    assert ask(case, "--drive", "A=0", "--samples", "24", "--json", "-") == 0
    assert json.loads(capsys.readouterr().out)["format"] == "nag-motion"


def test_a_joint_that_is_held_is_said_to_be_and_not_to_stand_still(tmp_path, capsys) -> None:
    page = tmp_path / "a.html"
    case = str(CASES / "planar" / "five-bar.toml")
    assert ask(case, "--drive", "A=30", "--html", str(page)) == 0
    printed = capsys.readouterr().out
    assert printed.count("\nA      held\n") == 2 and "never" not in printed
    assert '["A", "held"]' in page.read_text() or '["A","held"]' in page.read_text()


def test_assemblies_of_a_delta_tell_where_its_platform_is(capsys) -> None:
    held = [word for k in "123" for word in ("--drive", f"R{k}=0")]
    assert ask(str(CASES / "mobility" / "delta.toml"), *held) == 0
    printed = capsys.readouterr().out
    head, *rows = [line.split() for line in printed.split("assembly  ")[1].splitlines()][:9]
    assert head[:5] == ["platform.x", "platform.y", "platform.z", "platform", "turned"]
    # Where it is drawn, and on the other side of the arms along the axis (1, 1, 1).
    zero = "0.00\u00b0"
    assert ["0", "0", "0", zero, zero, zero, zero] in [row[1:] for row in rows]
    moved = next(row[1:4] for row in rows if row[4] == zero and row[1] != "0")
    assert len(set(moved)) == 1
    assert "platform.x to platform.z: the place of its frame" in printed


KITE = str(CASES / "planar" / "four-bar-kite.toml")


def test_a_circuit_on_which_a_joint_stands_still_elsewhere_has_no_assembly(capsys) -> None:
    # Folded, both long links are one and B and D stand still; as a kite they turn.
    for joint in "BD":
        for options in ([], ["--circuit", "2"]):
            assert ask(KITE, "--drive", f"{joint}=20", *options) == 0
            printed = capsys.readouterr().out
            assert f"{joint} at 20.00\u00b0: 2 real assemblies\n" in printed
    assert ask(KITE, "--drive", "D=20", "--circuit", "1") == 0
    assert "D at 20.00\u00b0: 0 real assemblies\n" in capsys.readouterr().out


def test_a_circuit_at_a_value_throughout_is_said(tmp_path, capsys) -> None:
    file = tmp_path / "a.json"
    assert ask(KITE, "--drive", "D=0", "--json", str(file)) == 0
    printed = capsys.readouterr().out
    assert "D at 0.00\u00b0: circuit 1 is at this value throughout; 2 real" in printed
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-motion"))
    assert document["throughout"] == [1]
    assert {each["circuit"] for each in document["assemblies"]} == {2}
    assert ask(KITE, "--drive", "D=0:20:2") == 0
    printed = capsys.readouterr().out
    assert "throughout  0.00\u00b0: circuit 1 is at this value throughout\n" in printed
    assert printed.count("at this value") == 1


def test_a_joint_that_moves_on_no_circuit_cannot_be_driven(tmp_path, capsys) -> None:
    # Two bars on the four-bar's base make a triangle with it.
    case = tmp_path / "triangle.toml"
    bars = [
        f'[[link]]\nname = "{n}"\npins = ["{p}", "F"]\nlength = 3\n'
        for n, p in (("pA", "A"), ("qD", "D"))
    ]
    case.write_text(FOUR_BAR + "".join(bars))
    assert ask(str(case), "--drive", "A:pA=20") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith("--drive: A:pA never moves")


FOUR_BAR = (CASES / "planar" / "four-bar.toml").read_text().split("[[truth")[0]
HANGING = '[[link]]\nname = "pendulum"\npins = ["C", "H"]\nlength = 1\n'


@pytest.mark.parametrize("first", [False, True])
def test_a_link_that_hangs_neither_moves_as_loops_do_nor_stands_still(
    first: bool, tmp_path, capsys
) -> None:
    case, file = tmp_path / "hanging.toml", tmp_path / "a.json"
    head, links = FOUR_BAR.split("[[link]]", 1)
    links = f"[[link]]{links}"
    case.write_text(head + (HANGING + links if first else links + HANGING))
    assert ask(str(case), "--json", str(file)) == 0
    printed = capsys.readouterr().out
    hanging = "joint C:pendulum in no loop, moving freely with 1 freedom; tables and pages show its"
    assert f"{hanging} link unturned" in " ".join(printed.split())
    assert "it moves with 2 freedoms, 1 of them of joints in no loop, counting" in printed
    assert printed.count("C:pendulum  moves freely, in no loop\n") == 2
    document = json.loads(file.read_text())
    jsonschema.validate(document, schema("nag-motion"))
    (own,) = [c["name"] for c in document["coordinates"] if not c["in_loop"]]
    assert own == "C:pendulum"
    for circuit in document["circuits"]:
        assert not any(joint["still"] for joint in circuit["joints"])
        # The rocker's angle is that against the coupler, wherever the pendulum stands in the file.
        (rocker,) = [j for j in circuit["joints"] if j["name"] == "C:rocker"]
        assert len(rocker["turning_points"]) == 2
    assert ask(str(case), "--drive", "C:pendulum=20") == 2
    (line,) = capsys.readouterr().err.splitlines()
    said = "--drive: C:pendulum is in no loop: it turns freely, and nothing else moves with it"
    assert line.endswith(said)


def test_a_hanging_joint_of_a_mechanism_is_not_still(tmp_path, capsys) -> None:
    case = tmp_path / "hanging.toml"
    bennett = (CASES / "bennett.toml").read_text()
    body = json.loads(re.findall(r"bodies = (.*)", bennett)[0])[0]
    head, joints = bennett.split("[[joint]]", 1)
    hanging = f'name = "H"\ntype = "prismatic"\nbodies = ["{body}", "bob"]\n'
    place = "point = [0, 0, 0]\naxis = [0, 0, 1]\n\n"
    case.write_text(f"{head}[[joint]]\n{hanging}{place}[[joint]]{joints}")
    assert ask(str(case)) == 0
    printed = capsys.readouterr().out
    assert "never move" not in printed and "\nH      moves freely, in no loop\n" in printed
    assert "tables and pages show it as drawn" in " ".join(printed.split())
    assert ask(str(case), "--drive", "H=20") == 2
    (line,) = capsys.readouterr().err.splitlines()
    said = "--drive: H is in no loop: it slides freely, and nothing else moves with it"
    assert line.endswith(said)
    assert ask(str(case), "--drive", "J0=10") == 0
    printed = capsys.readouterr().out
    head = next(line for line in printed.splitlines() if line.startswith("assembly"))
    assert head.split()[-4:] == ["J0", "J1", "J2", "J3"]


def test_one_circuit_may_be_asked_for(tmp_path, capsys) -> None:
    table = tmp_path / "motion.csv"
    case = str(CASES / "planar" / "four-bar.toml")
    assert ask(case, "--circuit", "2", "--csv", str(table), "--samples", "12") == 0
    assert {line.split(",")[0] for line in table.read_text().splitlines()[1:]} == {"2"}
    assert "circuit 1 " not in capsys.readouterr().out


def test_angles_that_round_to_zero_have_no_sign() -> None:
    angle, slide = Coordinate("A", "A", "angle"), Coordinate("P", "P", "slide")
    assert value_text(angle, -1e-6) == value_text(angle, 0.0) == "0.00\u00b0"
    assert value_text(angle, -1e-3) == "-0.06\u00b0"
    assert value_text(slide, -1e-12) == "0"


def test_bars_in_space_have_no_table_of_joints(capsys) -> None:
    assert ask(str(CASES / "spatial" / "octahedron-plane-symmetric.toml")) == 0
    printed = capsys.readouterr().out
    assert "circuit 1  closed" in printed and "turns back at" not in printed


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["bennett.toml", "--circuit", "7"], "circuit: 7 is none; they are 1"),
        (["bennett.toml", "--circuit", "first"], "write reference, all, or a circuit's number"),
        (["bennett.toml", "--drive", "J0"], "'J0' is not of the form JOINT=VALUE"),
        (["bennett.toml", "--drive", "J7=1"], "drive: 'J7' is no angle or slide"),
        (["bennett.toml", "--samples", "3"], "3 is not between 12 and 100000"),
        (["bennett.toml", "--csv", "/nowhere/x.csv"], "--csv: /nowhere/x.csv"),
        (["bennett.toml", "--html", "/nowhere/x.html"], "--html: /nowhere/x.html"),
        (["slider-crank.toml"], "is a polynomial system; only mechanisms have a motion"),
        (["spherical/triangle.toml"], "it does not move"),
        (["spherical/five-bar.toml"], "it moves with 2 freedoms"),
        # Its components take long to find, and are not needed for this.
        (["robots/3-rps.toml"], "it moves with 3 freedoms at the reference configuration"),
        (["robots/3-rps.toml", "--drive", "P1=0.1"], "it moves with 2 freedoms with P1 held"),
        (["mobility/delta.toml", "--drive", "R1=20"], "8 freedoms, 6 of them idle, with R1 held"),
        (["planar/four-bar.toml", "--formulation", "H"], "--formulation is for assembled"),
        (
            ["spatial/wren-5.toml"],
            "(multiplicity 4), and such a motion is not followed; nag mobility",
        ),
    ],
)
def test_bad_input_is_one_line(words: list[str], said: str, capsys) -> None:
    name, *rest = words
    assert ask(str(CASES / name), *rest) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line


@pytest.mark.parametrize(
    "words",
    [
        ["planar/five-bar.toml", "--drive", "A=30", "--drive", "E=-20"],
        ["bennett.toml", "--drive", "J0=10:20:2"],
    ],
)
def test_a_page_of_what_does_not_move_is_said_not_to_be_written(words, tmp_path, capsys) -> None:
    name, *rest = words
    page, document = tmp_path / "a.html", tmp_path / "a.json"
    options = [*rest, "--html", str(page), "--json", str(document)]
    assert ask(str(CASES / name), *options) == 1
    # A long path may leave the words on two lines.
    assert "is not written" in " ".join(capsys.readouterr().out.split()) and not page.exists()
    # The answer itself is whole.
    assert json.loads(document.read_text())["complete"]
