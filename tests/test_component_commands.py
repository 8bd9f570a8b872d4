"""nag member, nag sample, nag intersect, nag decompose --method sampling."""

from __future__ import annotations

import errno
import json
import re
import shlex
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import nag
from nag.cli import main
from nag.files.export import read_export
from nag.files.json_schema import schema

CASES = Path(__file__).parent.parent / "cases"

CROSS = """
title = "A circle and a line"
kind = "system"
variables = ["x", "y"]
equations = ["(x^2 + y^2 - 1)*(x - y)"]
[[point]]
name = "crossing"
at = { x = "sqrt(2)/2", y = "sqrt(2)/2" }
[[point]]
name = "right"
at = { x = 1, y = 0 }
[[point]]
name = "outside"
at = { x = 7, y = 0 }
"""


@pytest.fixture
def case(tmp_path) -> str:
    file = tmp_path / "cross.toml"
    file.write_text(CROSS)
    return str(file)


@pytest.fixture
def export(case, tmp_path, capsys) -> str:
    file = str(tmp_path / "cross.json")
    assert main(["decompose", case, "--quiet", "--json", file]) == 0
    capsys.readouterr()
    return file


def document(kind: str, file: Path) -> dict:
    content = json.loads(file.read_text())
    jsonschema.validate(content, schema(kind))
    assert content["format"] == kind and content["case"]["file"] == "cross.toml"
    return content


@pytest.mark.parametrize("kind", ["nag-membership", "nag-samples", "nag-intersection"])
def test_schemas_are_schemas(kind: str) -> None:
    jsonschema.Draft202012Validator.check_schema(schema(kind))


@pytest.mark.parametrize(
    ("point", "exact", "answers"),
    [
        (["crossing"], True, ["member", "member"]),
        (["right"], True, ["foreign", "member"]),
        (["outside"], False, ["foreign", "foreign"]),
        (["--at", "y = sqrt(2)/2, x=1/sqrt(2)"], True, ["member", "member"]),
        (["--at", "x=3/5,y=-4/5"], True, ["foreign", "member"]),
        # Decimals are exact: x = y holds, and x^2 + y^2 = 1 does to 16 digits only.
        (["--at", "x=0.7071067811865476,y=0.7071067811865476"], True, ["member", "foreign"]),
        (["--at", "x=0.6000000000000001,y=0.8"], False, ["foreign", "member"]),
        (["--at", "x=0.61,y=0.8"], False, ["foreign", "foreign"]),
    ],
)
def test_member_says_which_components_a_point_lies_on(
    case, tmp_path, capsys, point, exact, answers
) -> None:
    target = tmp_path / "member.json"
    assert main(["member", case, *point, "--quiet", "--json", str(target)]) == 0
    content = document("nag-membership", target)
    assert [c["answer"] for c in content["components"]] == answers
    assert [(c["number"], c["degree"]) for c in content["components"]] == [(1, 1), (2, 2)]
    assert content["exact"] is exact and content["complete"] is True
    out = capsys.readouterr().out
    on = answers.count("member")
    expected = f"on {on} of 2 components; local dimension 1" if on else "on no component"
    assert f"answer     {expected}\n" in out


def test_an_export_answers_as_its_case_does(case, export, capsys) -> None:
    at = ["--at", "x = 3/5, y = 4/5", "--quiet"]
    assert main(["member", export, *at]) == 0
    first = capsys.readouterr().out
    assert main(["member", case, *at]) == 0
    second = capsys.readouterr().out
    assert first.split("\nrun")[0] == second.split("\nrun")[0]


def test_the_reference_of_a_mechanism_is_a_point(capsys) -> None:
    assert main(["member", str(CASES / "bennett.toml"), "reference", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "equations  hold exactly" in out
    assert "on 1 of 1 components; local dimension 1" in out


def test_samples_are_written_to_rounding_and_do_not_depend_on_threads(
    export, tmp_path, capsys
) -> None:
    files = []
    for threads in ("1", "2"):
        target = tmp_path / f"{threads}.json"
        argv = ["sample", export, "--component", "2", "--count", "25", "--threads", threads]
        assert main([*argv, "--quiet", "--seed", "3", "--json", str(target)]) == 0
        files.append(target.read_bytes())
    assert files[0] == files[1]
    content = document("nag-samples", target)
    assert content["component"]["degree"] == 2 and content["residual"] < 1e-14
    points = np.array(content["points"]) @ [1, 1j]
    assert points.shape == (25, 2)
    assert np.abs((points**2).sum(axis=1) - 1).max() < 1e-12
    assert "25, the first 20 are shown" in capsys.readouterr().out


def test_intersect_finds_the_crossings(export, tmp_path, capsys) -> None:
    target = tmp_path / "meet.json"
    argv = ["intersect", export, "--components", "1", "2", "--quiet", "--json", str(target)]
    assert main(argv) == 0
    content = document("nag-intersection", target)
    assert [(c["dimension"], c["degree"]) for c in content["components"]] == [(0, 1), (0, 1)]
    points = np.array([c["points"] for c in content["components"]]) @ [1, 1j]
    assert np.abs(np.abs(points) - np.sqrt(0.5)).max() < 1e-14
    assert "answer     2 components of dimension 0, degree 1" in capsys.readouterr().out


def test_components_that_do_not_meet_are_a_complete_answer(tmp_path, capsys) -> None:
    file = tmp_path / "parallel.toml"
    file.write_text(
        'title = "Parallels"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x^2 - 1"]\n'
    )
    assert main(["intersect", str(file), "--components", "1", "2", "--quiet"]) == 0
    assert "answer     they do not meet" in capsys.readouterr().out


def test_components_that_are_undecided_are_not_said_to_be_apart(tmp_path, capsys) -> None:
    file, target = tmp_path / "parallel.toml", tmp_path / "parallel.json"
    file.write_text(
        'title = "Parallels"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x^2 - 1"]\n'
    )
    assert main(["decompose", str(file), "--quiet", "--json", str(target)]) == 0
    content = json.loads(target.read_text())
    content["components"][0] |= {"status": "undecided", "note": "its trace was not tested"}
    content["complete"] = False
    target.write_text(json.dumps(content))
    capsys.readouterr()
    assert main(["intersect", str(target), "--components", "1", "2", "--quiet"]) == 1
    shown = capsys.readouterr().out
    assert "do not meet" not in shown and "answer     undecided" in shown


@pytest.mark.parametrize(
    "command",
    [
        ["intersect", "--components", "1", "2"],
        ["member", "--at", "x = 1, y = 1"],
        ["sample", "--component", "2"],
        ["singular"],
        ["eliminate", "--component", "2"],
    ],
)
def test_a_component_without_some_of_its_points_is_refused(
    command: list[str], export: str, tmp_path, capsys
) -> None:
    content = json.loads(Path(export).read_text())
    circle = content["components"][1]
    assert circle["degree"] == 2
    circle["degree"] = 1
    for name in ("points", "radii", "digits"):
        circle[name] = circle[name][:1]
    for part in circle["cut_by"]:
        part["points"], part["unknowns"] = 1, part["unknowns"][:1]
    file = tmp_path / "half.json"
    file.write_text(json.dumps(content))
    assert main([command[0], str(file), *command[1:], "--quiet"]) == 2
    line = capsys.readouterr().err
    assert "component 2: the sum of its points" in line and line.count("\n") == 1


def test_an_incomplete_decomposition_leaves_memberships_incomplete(case, tmp_path, capsys) -> None:
    file = tmp_path / "sampled.json"
    argv = ["decompose", case, "--method", "sampling", "--starts", "12", "--quiet"]
    assert main([*argv, "--json", str(file)]) == 1
    out = capsys.readouterr().out
    assert "INCOMPLETE" in out
    assert "12 random points; components may be missing" in " ".join(out.split())
    assert len(read_export(file).decomposition.components) == 2
    assert main(["member", str(file), "--at", "x=1,y=0", "--quiet"]) == 1
    assert "the decomposition is incomplete" in capsys.readouterr().out


def test_other_values_of_parameters_are_taken(capsys) -> None:
    crank = str(CASES / "slider-crank.toml")
    assert main(["singular", crank, "--quiet"]) == 0
    assert "2 isolated singular points" in capsys.readouterr().out
    # L1 = 3 is the sum of no other two lengths, nor is one of these with it.
    assert main(["singular", crank, "--quiet", "--set", "L1=3"]) == 0
    assert "no singular points" in capsys.readouterr().out
    assert main(["singular", crank, "--free", "L1,L2", "--set", "L1=3"]) == 2
    assert "--set L1: is an unknown by --free" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("argv", "part"),
    [
        (["member", "{case}"], "which point? write either --at"),
        (["member", "{case}", "right", "--at", "x=1,y=0"], "which point? write either --at"),
        (["member", "{case}", "rigth"], "has no point 'rigth' (did you mean 'right'?)"),
        (["member", "{export}", "right"], "has no named points; write coordinates, --at"),
        (["member", "{case}", "--at", "x=1"], "--at: no value for y"),
        (["member", "{case}", "--at", "x=1,y"], "write 'variable = number'"),
        (["member", "{case}", "--at", ""], "write 'variable = number'"),
        (["member", "{case}", "--at", "x=1,x=2,y=0"], "x is given twice"),
        (["member", "{case}", "--at", "x=1,z=2"], "'z' is not one of the variables"),
        (["member", "{case}", "--at", "x=1/0,y=0"], "--at: x: "),
        (["member", "{case}", "--at", "x=__import__('os'),y=0"], "--at: x: "),
        (["member", "{export}", "--at", "x=1,y=0", "--formulation", "E"], "is an export"),
        (["member", "{export}", "--at", "x=1,y=0", "--set", "a=1"], "--set is for cases"),
        (["singular", "{case}", "--set", "a=1"], "a: is no parameter of the case; it has none"),
        (["member", "{folder}/none.json", "--at", "x=1"], "none.json"),
        (["sample", "{export}", "--component", "3"], "--component: 3: there are components 1 to 2"),
        (["sample", "{export}", "--component", "0"], "is not a component's number"),
        (["sample", "{export}", "--count", "0"], "is not between 1 and"),
        (["sample", "{export}", "--count", "1e9"], "is not a whole number"),
        (["intersect", "{export}"], "--components"),
        (["intersect", "{export}", "--components", "1"], "--components"),
        (["intersect", "{export}", "--components", "1", "9"], "there are components 1 to 2"),
        (["sample", "{export}", "--json", "{export}"], "name another file"),
        (["decompose", "{case}", "--starts", "5"], "--starts: is for --method sampling"),
        (["decompose", "{case}", "--method", "guessing"], "invalid choice"),
    ],
)
def test_bad_input_gets_one_line(case, export, capsys, argv, part) -> None:
    words = {"case": case, "export": export, "folder": str(Path(case).parent)}
    assert main([word.format(**words) for word in argv]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("nag: ") and err.count("\n") == 1
    assert part in err


def test_exports_that_are_none_get_one_line(tmp_path, capsys) -> None:
    file = tmp_path / "broken.json"
    file.write_text('{"format": "nag-decomposition", "version": 1}')
    assert main(["sample", str(file)]) == 2
    assert capsys.readouterr().err.startswith("nag: ")
    file.write_text('{"format"')
    assert main(["sample", str(file)]) == 2
    assert "is not JSON" in capsys.readouterr().err


def test_the_commands_that_are_shown_run(tmp_path, monkeypatch, capsys) -> None:
    page = (CASES.parent / "docs" / "commands.md").read_text("utf-8")
    lines = re.findall(r"^    nag (.* rhombus\.json.*)$", page, re.MULTILINE)
    assert [line.split()[0] for line in lines] == ["decompose", "member", "sample", "intersect"]
    (tmp_path / "cases").symlink_to(CASES)
    monkeypatch.chdir(tmp_path)
    printed = []
    for line in lines:
        assert main([*shlex.split(line), "--quiet"]) == 0
        printed.append(capsys.readouterr().out)
    assert "on 1 of 3 components; local dimension 1" in printed[1]
    assert len(json.loads((tmp_path / "points.json").read_text())["points"]) == 100
    assert "1 component of dimension 0, degree 1" in printed[3]


@pytest.mark.parametrize(
    "words",
    [
        ["solve", "{case}"],
        ["local", "{case}", "right"],
        ["member", "{export}", "--at", "x = 1, y = 0"],
        ["sample", "{export}"],
        ["intersect", "{export}", "--components", "1", "2"],
        ["certify", "{export}"],
    ],
)
def test_every_answer_is_printed_even_if_its_document_cannot_be_written(
    case, export, words, tmp_path, capsys, monkeypatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("time.perf_counter", lambda: 0.0)
    words = [word.format(case=case, export=export) for word in words]
    main([*words, "--quiet"])
    expected = capsys.readouterr().out
    monkeypatch.setattr("nag.files.written_file.os.fsync", full)
    assert main([*words, "--quiet", "--json", str(tmp_path / "answer.json")]) == 2
    out, err = capsys.readouterr()
    assert err.endswith("answer.json: cannot be written: No space left on device\n")
    assert out == expected


def test_coordinates_of_samples_are_printed_to_what_is_known_of_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "line.txt").write_text("x^2 + y^2 - 1\nz*x\n")
    for more in ([], ["--real"]):
        words = ["sample", str(tmp_path / "line.txt"), "--count", "4", "--quiet", *more]
        assert main(words) == 0
        lines = capsys.readouterr().out.splitlines()
        start = next(i for i, line in enumerate(lines) if line.startswith("point  "))
        for line in lines[start + 1 : start + 5]:
            # The component is x = 0, y = 1 or y = -1, with any z.
            _, x, y, z, *real_dimension = line.split()
            assert real_dimension == ["1"] * len(more)
            assert x == "0" and y in ("1", "-1") and z.endswith("i") == (not more)


def test_who_is_given_no_equations_is_told_how_to_get_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "cubic.txt"
    file.write_text("x*z - y^2\ny*w - z^2\nx*w - y*z\n")
    assert main(["eliminate", str(file), "--quiet"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    hint = re.search(r"hint (--onto \S+) gives equations in these variables", shown)
    assert "equations none" in shown and hint
    assert main(["eliminate", str(file), "--quiet", *hint[1].split()]) == 0
    shown = capsys.readouterr().out
    assert shown.count(" = 0\n") == 3 and "hint" not in shown


def test_a_family_says_where_its_solutions_can_be_had(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "circle.txt").write_text("x^2 + y^2 = r\nx*y = s\n")
    (tmp_path / "values.csv").write_text("r,s\n5,2\n2,1\n")
    words = ["family", str(tmp_path / "circle.txt"), "--values", str(tmp_path / "values.csv")]
    assert main([*words, "--quiet"]) == 0
    shown = capsys.readouterr().out
    # The circle of radius sqrt(2) touches x y = 1.
    assert "1 member was solved by itself" in shown and "--points FILE writes" in shown


def test_the_point_of_no_coordinates_is_on_the_component_of_no_equation(tmp_path, capsys) -> None:
    export = tmp_path / "export.json"
    nag.write(nag.decompose(["0"]), export)
    for where in (["0"], nag.decompose(["0"]), export):
        assert list(nag.member(where, []).numbers) == [1]
    assert main(["member", str(export), "--at", "", "--quiet"]) == 0
    assert "on 1 of 1 components" in capsys.readouterr().out
