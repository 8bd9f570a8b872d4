"""Who begins gets a case to edit, is told what can be asked, and is helped to write it."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from linkages import CASES

import nag
from nag.cli import main
from nag.cli.command_line import COMMANDS
from nag.cli.completion import SHELLS, command_words
from nag.cli.init import KINDS


@pytest.mark.parametrize("kind", KINDS)
def test_a_case_to_begin_with_can_be_decomposed(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    assert main(["init", kind, str(file)]) == 0
    assert main(["init", kind]) == 0
    assert file.read_text() in capsys.readouterr().out
    assert nag.decompose(file).complete
    assert main(["init", kind, str(file)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize(
    ("case", "command"),
    [
        ("bennett", "mobility"),
        ("slider-crank", "solve"),
        ("planar/four-bar", "motion"),
        ("robots/3-rps", "modes"),
    ],
)
def test_a_file_alone_says_what_can_be_asked_of_it(
    case: str, command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(CASES / f"{case}.toml")
    assert main([path]) == 0
    shown = capsys.readouterr().out
    assert main(["show", path]) == 0
    assert capsys.readouterr().out == shown
    assert f"nag {command} " in shown and "ask: nag COMMAND" in shown


def test_an_open_arm_is_asked_for_its_inverse_kinematics(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    links = "".join(f'<link name="{name}"/>' for name in ("base", "arm", "hand"))
    turns = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="{a}"/><child link="{b}"/>'
        '<origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>'
        for k, (a, b) in enumerate([("base", "arm"), ("arm", "hand")])
    )
    path = tmp_path / "arm.urdf"
    path.write_text(f'<robot name="arm">{links}{turns}</robot>')
    assert main([str(path)]) == 0
    shown = capsys.readouterr().out
    assert "--pose hand=X,Y,Z" in shown and "--hold hand" in shown


# What each command needs besides the case, so that it is refused for the case's sake alone.
NEEDED = {
    "family": ["--values", "values.csv"],
    "intersect": ["--components", "1", "1"],
    "local": ["--at", "x = 1, y = 0"],
    "member": ["--at", "x = 1, y = 0"],
    "plot": ["--tree", "--out", "tree.svg"],
    "report": ["--html", "report.html"],
}
OF_NO_CASE = {"show", "init", "completion", "bench", "chart", "certify"}
CIRCLE = (
    'title = "Circle"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x^2 + y^2 - 1"]\n'
)
TRIANGLE = (
    'title = "Bars"\nkind = "framework"\npoints = ["A", "B", "C", "D"]\nlengths = [3, 4, 5, 6]\n'
    'bars = [["A", "B"], ["B", "C"], ["C", "D"], ["D", "A"]]\n'
)


@pytest.mark.parametrize(
    "case", [CIRCLE, TRIANGLE, "bennett"], ids=["system", "framework", "mechanism"]
)
def test_all_that_can_be_asked_of_a_file_is_listed(
    case: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("values.csv").write_text("x\n1/2\n")
    Path("case.toml").write_text(
        case if "=" in case else (CASES / f"{case}.toml").read_text("utf-8")
    )
    assert main(["case.toml"]) == 0
    shown = capsys.readouterr().out
    listed = {line.split()[1] for line in shown.splitlines() if line.startswith("nag ")}
    for command in {row[0] for row in COMMANDS} - OF_NO_CASE:
        needed = list(NEEDED.get(command, ()))
        if command in ("local", "member") and case != CIRCLE:
            continue
        status = main([command, "case.toml", *needed, "--quiet"])
        said = capsys.readouterr().err
        assert (command in listed) == (status != 2), (command, said)


def test_what_is_known_names_the_formulation_that_it_is_known_of(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main([str(CASES / "bennett.toml")]) == 0
    shown = capsys.readouterr().out
    assert "known          in formulation H: 1 component of dimension 1, degree 2 " in shown
    assert "known          in formulation E: 2 components of dimension 1, degree 8 " in shown


def test_every_question_is_a_command() -> None:
    from nag.cli.show import HAND, LEGS, OF_COMPONENTS, PAPERS, QUESTIONS

    rows = (*QUESTIONS.values(), HAND, OF_COMPONENTS, (LEGS, PAPERS))
    asked = {name for each in rows for name, _ in each}
    assert asked <= {row[0] for row in COMMANDS}


@pytest.mark.parametrize("command", [row[0] for row in COMMANDS])
def test_help_begins_with_what_must_be_given_and_the_commands_own_options(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--help"]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith(f"usage: nag {command} [OPTION ...] ")
    headings = ["options:", "how the case is read:", "how it is worked out:"]
    places = [shown.find(f"\n{heading}\n") for heading in headings]
    assert [x for x in places if x >= 0] == sorted(x for x in places if x >= 0)
    for option in {"--formulation", "--set", "--hold"} & set(shown.split()):
        assert shown.index(f"  {option} ") > places[1] > 0


def test_exports_are_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found, solved = tmp_path / "found.json", tmp_path / "solved.json"
    nag.write(nag.decompose("x^2 + y^2 - 1"), found)
    nag.write(nag.solve("x^2 - 2"), solved)
    for path, text in ((found, "nag sample"), (solved, "nag certify")):
        assert main([str(path)]) == 0
        assert text in capsys.readouterr().out


def test_a_case_is_shown_with_other_values_of_its_parameters(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, export = str(CASES / "slider-crank.toml"), tmp_path / "found.json"
    assert main([case, "--set", "L1=5/7"]) == 0
    assert "L1 = 5/7" in capsys.readouterr().out
    nag.write(nag.decompose("x^2 + y^2 - 1"), export)
    assert main([str(export), "--set", "L1=5/7"]) == 2
    assert capsys.readouterr().err == f"nag: {export}: is an export; --set is for cases\n"


def test_an_export_shows_the_numbers_of_its_components(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "found.json"
    found = nag.decompose(["x*(x - 1)*(x^2 + y^2 - 1)*(y - 2)", "z*(x - 1)*(y - 2)"])
    nag.write(found, path)
    assert main([str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("number  "))
    rows = [line.split("  ")[0].strip() for line in lines[start + 1 :]]
    numbers = [
        list(range(int(t.split("-")[0]), int(t.split("-")[-1]) + 1))
        for row in rows[: rows.index("")]
        for t in row.split(", ")
    ]
    assert sorted(k for own in numbers for k in own) == list(range(1, len(found) + 1))


@pytest.mark.parametrize("word", ["missing.toml", "folder/missing"])
def test_a_file_that_is_not_there_is_one_line(
    word: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([word]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and word in told


@pytest.mark.parametrize("command", ["decompose", "mobility"])
def test_a_document_goes_to_standard_output_alone(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, file = str(CASES / "bennett.toml"), tmp_path / "answer.json"
    assert main([command, case, "--json", str(file), "--quiet"]) == 0
    capsys.readouterr()
    assert main([command, case, "--json", "-", "--quiet"]) == 0
    assert json.loads(capsys.readouterr().out) == json.loads(file.read_text())


def test_completion_knows_all_commands_and_their_choices() -> None:
    words = command_words()
    assert list(words) == [row[0] for row in COMMANDS]
    assert "polyhedral" in words["solve"]["--start"] and words["init"][""] == KINDS


@pytest.mark.parametrize("shell", SHELLS)
def test_scripts_for_shells_are_written(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    assert all(row[0] in script for row in COMMANDS)


@pytest.mark.skipif(shutil.which("bash") is None, reason="bash is not installed")
@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("solve --start poly", ["polyhedral"]),
        ("solve --start ", list(command_words()["solve"]["--start"])),
        ("init ", list(KINDS)),
        ("deco", ["decompose"]),
        ("decompose --js", ["--json"]),
        ("decompose ", ["mine.toml"]),
        ("mi", ["mine.toml"]),
    ],
)
def test_bash_offers_words_where_these_are_meant_and_files_elsewhere(
    line: str, offered: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "mine.toml").touch()
    assert main(["completion", "bash"]) == 0
    words = " ".join(f"'{word}'" for word in ["nag", *line.split(" ")])
    ask = f"COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}}-1)); _nag"
    script = f"{capsys.readouterr().out}\n{ask}\nprintf '%s\\n' \"${{COMPREPLY[@]}}\""
    done = subprocess.run(
        ["bash", "-c", script], capture_output=True, text=True, check=True, cwd=tmp_path
    )
    assert done.stdout.split("\n")[:-1] == offered and not done.stderr


def test_a_table_of_values_names_the_parameters_of_a_system_in_plain_text(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    np = pytest.importorskip("numpy")
    (tmp_path / "circles.txt").write_text("imaginary i\nx^2 + y^2 = r\nx = i*a*y\n")
    (tmp_path / "values.csv").write_text("a,r\n2,-3\n0,4\n")
    words = ["family", str(tmp_path / "circles.txt"), "--values", str(tmp_path / "values.csv")]
    assert main([*words, "--points", str(tmp_path / "points.npz")]) == 0
    points = np.load(tmp_path / "points.npz")["points"]
    # y^2 (1 - a^2) = r, x = i a y.
    assert np.allclose(np.sort(points[0, :, 1].real), [-1, 1]) and np.allclose(
        points[0, :, 0], 2j * points[0, :, 1]
    )
    assert np.allclose(np.sort(points[1, :, 1].real), [-2, 2])
    bertini = tmp_path / "circles.input"
    bertini.write_text(
        "variable_group x, y;\nparameter a, r;\nconstant c;\nfunction f, g;\na = 1;\nr = 2;\n"
        "c = 1;\nf = x^2 + y^2 - c*r;\ng = x - I*a*y;\n"
    )
    again = ["family", str(bertini), *words[2:], "--points", str(tmp_path / "again.npz")]
    assert main(again) == 0
    roots = np.load(tmp_path / "again.npz")["points"]
    assert np.allclose(np.sort(roots[..., 1].real), np.sort(points[..., 1].real))
    (tmp_path / "values.csv").write_text("b\n2\n")
    assert main(words) == 2
    assert (
        "values.csv: line 1: 'b' does not occur; the names are a, r, x, y"
        in capsys.readouterr().err
    )


def test_who_certifies_a_case_is_told_what_writes_an_export(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["certify", str(CASES / "bennett.toml")]) == 2
    told = capsys.readouterr().err
    assert "is no export" in told and "--json FILE" in told and told.count("\n") == 1


def test_a_certificate_is_shown_as_what_its_exit_status_says(tmp_path: Path, capsys) -> None:
    """Which is of the points: completeness that is not proved is no answer that is incomplete."""
    export, certificate = str(tmp_path / "solved.json"), str(tmp_path / "proved.json")
    quartic = nag.solve(["x^2*y + x - 3", "x*y^2 - y + 1 + x"], start="total", seed=1)
    nag.write(quartic, export)
    assert main(["certify", export, "--json", certificate, "--quiet"]) == 0
    capsys.readouterr()
    assert main(["show", certificate]) == 0
    shown = capsys.readouterr().out
    assert "proved      all points" in shown and "INCOMPLETE" not in shown
    complete = nag.read(certificate)["complete"]
    assert f"complete    {'proved' if complete else 'not proved'}\n" in shown
