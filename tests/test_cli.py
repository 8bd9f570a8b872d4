"""The command line: what it prints, how it ends, and that bad input gets one clear line."""

from __future__ import annotations

import argparse
import errno
import json
import os
import re
import signal
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

import nag
from nag.cli import main
from nag.cli.arguments import UsageError
from nag.cli.running import chosen_run
from nag.files.export import read_export
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet

CASES = Path(__file__).parent.parent / "cases"

LINES = """
title = "Two lines"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 - y^2"]
[[point]]
name = "crossing"
at = { x = 0, y = 0 }
[[point]]
name = "elsewhere"
at = { x = 1, y = 0 }
[[truth.component]]
dimension = 1
degree = 1
count = 2
source = "a schoolbook"
"""


def two_lines(system, **changes: object) -> Decomposition:
    slice_ = Slice([[0.6, 0.8]], [1.0])
    components = [
        WitnessSet(slice_, [point], 1, Status.IRREDUCIBLE, 0.0, [[1e-16, 0.0]], [32], 1)
        for point in ([5 / 7, 5 / 7], [-5.0, 5.0])
    ]
    plain = Decomposition(system, tuple(components), PathCounts(2), 0, "default", (0,), True)
    return replace(plain, **changes)


class Engine:
    """Stands in for the decomposition, which has tests of its own, and remembers its calls."""

    def __init__(self) -> None:
        self.calls: list[dict[str, object]] = []
        self.changes: dict[str, object] = {}
        self.through: list[int] = [0, 1]
        self.error: BaseException | None = None

    def decompose(self, system, run: nag.Run, **options: object) -> Decomposition:
        self.calls.append({**run.short, **options})
        if self.error is not None:
            raise self.error
        return two_lines(system, **{"seed": run.seed, **self.changes})

    def components_through(self, decomposition, point, **options: object) -> list[int]:
        assert point.tolist() == [0, 0]
        return self.through


@pytest.fixture
def engine(monkeypatch) -> Engine:
    fake = Engine()
    monkeypatch.setattr("nag.decomposition.decompose.decompose", fake.decompose)
    monkeypatch.setattr("nag.witness.membership.components_through", fake.components_through)
    return fake


@pytest.fixture
def case(tmp_path) -> str:
    file = tmp_path / "lines.toml"
    file.write_text(LINES)
    return str(file)


@pytest.fixture
def complaint(capsys) -> Iterator:
    """Runs a command line that must end with status 2, nothing printed and one line."""

    def run(*argv: str) -> str:
        assert main(argv) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("nag: ")
        assert err.endswith("\n") and err[:-1].isprintable()
        return err

    return run


def test_an_answer_says_all_that_it_rests_on(engine, case, capsys) -> None:
    assert main(["decompose", case, "--seed", "7"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    lines = out.splitlines()
    assert lines[0] == "Two lines"
    rows = {line.split()[0]: " ".join(line.split()[1:]) for line in lines[1:] if line.strip()}
    assert rows["system"] == "2 variables (x, y), 1 equation: 1 of degree 2"
    assert rows["answer"] == "2 components of dimension 1, degree 1"
    assert rows["1-2"] == "1 1 1 2 irreducible 0.0e+00 5.0e-17 32"
    assert "1 at crossing: on 2 components of dimension 1, degree 1" in out
    assert "elsewhere is no solution of the equations" in out
    assert rows["paths"] == "2 tracked, 0 to infinity, 0 failed"
    assert rows["run"].startswith("seed 7, settings default, ")
    assert rows["known"] == (
        "agrees with what is known: 2 components of dimension 1, degree 1 (a schoolbook)"
    )


def test_options_reach_the_decomposition(engine, case) -> None:
    words = ["--seed=3", "--threads=2", "--settings=careful", "--quiet"]
    assert main(["decompose", case, *words]) == 0
    (call,) = engine.calls
    expected = nag.Run(seed=3, threads=2, settings="careful").short | {"symmetries": ()}
    assert call == expected


@pytest.mark.parametrize("doubt", ["undecided", "failed paths", "point missed"])
def test_an_incomplete_answer_ends_with_status_1_and_says_why(
    engine, case, capsys, doubt: str, tmp_path
) -> None:
    target = tmp_path / "answer.json"
    if doubt == "undecided":
        engine.changes = {"complete": False, "notes": ("a component is undecided",)}
    elif doubt == "failed paths":
        engine.changes = {"complete": False, "paths": PathCounts(5, 1), "notes": ("1 path failed",)}
    else:
        engine.through = []
    assert main(["decompose", case, "--json", str(target)]) == 1
    out, _ = capsys.readouterr()
    assert "INCOMPLETE" in out
    expected = {
        "undecided": "a component is undecided",
        "failed paths": "1 path failed",
        "point missed": "crossing: no component that was found passes through it",
    }[doubt]
    assert expected in out
    content = json.loads(target.read_text())
    assert content["complete"] is False
    assert content["notes"] == [expected]


def test_membership_that_cannot_be_decided_leaves_the_answer_incomplete(
    engine, case, capsys, monkeypatch
) -> None:
    def undecided(*_: object, **__: object) -> list[int]:
        raise ValueError("could not be decided")

    monkeypatch.setattr("nag.witness.membership.components_through", undecided)
    assert main(["decompose", case]) == 1
    assert "crossing: could not be decided" in capsys.readouterr().out


def test_the_export_is_the_answer_and_names_no_place_and_no_time(
    engine, case, tmp_path, capsys
) -> None:
    first, second = tmp_path / "1.json", tmp_path / "2.json"
    assert main(["decompose", case, "--json", str(first), "--threads", "1"]) == 0
    assert main(["decompose", case, "--json", str(second), "--threads", "2"]) == 0
    assert first.read_bytes() == second.read_bytes()
    export = read_export(first)
    assert export.origin.title == "Two lines"
    assert export.origin.file == "lines.toml"
    assert export.origin.kind == "system"
    assert export.decomposition == two_lines(export.decomposition.system)
    assert str(tmp_path) not in first.read_text()


def test_bennett_moves_though_counting_says_that_it_is_rigid(tmp_path, capsys) -> None:
    case, exports = str(CASES / "bennett.toml"), []
    for threads in ("1", "2"):
        target = tmp_path / f"{threads}.json"
        argv = ["decompose", case, "--seed", "5", "--threads", threads, "--json", str(target)]
        assert main([*argv, "--quiet"]) == 0
        out, err = capsys.readouterr()
        assert err == ""
        assert (
            "mobility  it moves with 1 freedom at the reference configuration, though counting"
            in out
        )
        assert "known     agrees with what is known" in out
        exports.append(target.read_bytes())
    assert exports[0] == exports[1]
    export = read_export(tmp_path / "1.json")
    assert export.origin.formulation == "H"
    (curve,) = export.decomposition.components
    assert (curve.dimension, curve.degree, curve.multidegree.tolist()) == (1, 2, [1, 1])


def test_the_formulation_that_is_asked_for_is_used(capsys) -> None:
    for formulation, variables in {"E": 8, "H": 2}.items():
        argv = ["model", str(CASES / "bennett.toml"), "--formulation", formulation]
        assert main(argv) == 0
        out, _ = capsys.readouterr()
        words = " ".join(out.split())
        assert f"model formulation {formulation}: spatial" in words
        assert f"system {variables} variables" in words


def test_bennett_moves_in_euler_parameters_as_well_and_signs_are_counted(capsys) -> None:
    argv = ["decompose", str(CASES / "bennett.toml"), "--formulation", "E"]
    assert main([*argv, "--quiet"]) == 0
    out, _ = capsys.readouterr()
    assert "8 sign changes of Euler parameters keep the equations" in out
    assert (
        "mobility  it moves with 1 freedom at the reference configuration, though counting" in out
    )
    assert "known     agrees with what is known: 2 components of dimension 1, degree 8" in out


def test_joints_that_were_cut_off_count_as_mobility(tmp_path, capsys) -> None:
    file = tmp_path / "case.toml"
    four_bar = (CASES / "planar-four-bar.toml").read_text("utf-8")
    body = four_bar.split('bodies = ["')[1].split('"')[0]
    file.write_text(
        f'{four_bar}\n[[joint]]\nname = "loose"\ntype = "revolute"\n'
        f'bodies = ["{body}", "flag"]\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n'
    )
    assert main(["decompose", str(file), "--quiet"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert (
        "mobility it moves with 2 freedoms at the reference configuration, 1 of them by the " in out
    )
    assert "joints that were cut off, counting predicts 2; on 1 component" in out


def test_a_mechanism_without_a_model_gets_one_line(complaint, tmp_path) -> None:
    file = tmp_path / "door.toml"
    file.write_text(
        'title = "A door"\nkind = "mechanism"\nground = "wall"\n[[joint]]\nname = "hinge"\n'
        'type = "revolute"\nbodies = ["wall", "door"]\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n'
    )
    for command in ("model", "decompose"):
        said = complaint(command, str(file))
        assert "door.toml: the mechanism has no loop" in said and "--hold LINK" in said


def test_the_model_of_a_system_is_the_system(case, capsys) -> None:
    assert main(["model", case]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "  x^2 - y^2 = 0\n" in out
    assert "crossing\n  x = 0, y = 0\n" in out


@pytest.mark.parametrize(
    ("argv", "part"),
    [
        (["frobnicate"], "is no command and no file"),
        ([], "say what to do"),
        (["--seed", "3", "decompose", "{case}"], "--seed: options stand behind a command"),
        (
            ["init", "linkage", "/nowhere/case.toml"],
            "nag: /nowhere/case.toml: there is no directory",
        ),
        (["decompse"], "did you mean 'decompose'"),
        (["decompose"], "CASE"),
        (["decompose", "{case}", "extra"], "unrecognized arguments: extra (see nag decompose -"),
        (["decompose", "{case}", "--frob"], "unrecognized arguments"),
        (["decompose", "{case}", "--see", "1"], "unrecognized arguments"),
        (["decompose", "{case}", "--seed"], "expected one argument"),
        (["decompose", "{case}", "--seed", "-1"], "--seed"),
        (["decompose", "{case}", "--seed", "1.5"], "not a whole number"),
        (["decompose", "{case}", "--seed", "9" * 5000], "not a whole number"),
        (["decompose", "{case}", "--seed", str(2**63)], "is not between"),
        (["decompose", "{case}", "--threads", "0"], "is not between 1"),
        (["decompose", "{case}", "--threads", "\u0663"], "not a whole number"),
        (["decompose", "{case}", "--settings", "sloppy"], "invalid choice"),
        (["decompose", "{case}", "--formulation", "X"], "invalid choice"),
        (["decompose", "{case}", "--formulation", "E"], "is for assembled mechanisms"),
        (["decompose", "{folder}/none.toml"], "none.toml"),
        (["decompose", "{folder}"], "directory"),
        (["decompose", ""], ""),
        (["decompose", "a\0b"], ""),
        (["decompose", "a\nb\x1b[31m"], "[31m"),
        (["a\nb\x1b[31m"], "is no command and no file"),
        (["decompose", "x" * 5000], "too long"),
        (["model", "{folder}/none.toml"], "none.toml"),
        (["decompose", "{case}", "--json", "{folder}"], "is a directory"),
        (["decompose", "{case}", "--json", "{folder}/none/a.json"], "there is no directory"),
        (["decompose", "{case}", "--json", "{case}/a.json"], "there is no directory"),
        (["decompose", "{case}", "--json", "{case}"], "is the case file"),
        (["decompose", "{case}", "--json", ""], "is a directory"),
        (["decompose", "{case}", "--json", "{folder}/a.csv"], ".csv holds no JSON; name it .json"),
        (["solve", "{case}", "--points", "{folder}/a.csv"], "no arrays and no table; name it .npz"),
        (
            ["family", "{case}", "--values", "v.csv", "--points", "{folder}/a.parquet"],
            "--points: {folder}/a.parquet: a file that ends in .parquet holds no arrays; name it",
        ),
        (["motion", "{case}", "--csv", "{folder}/a.npz"], "holds no table; name it .csv"),
        (["motion", "{case}", "--html", "{folder}/a.json"], "holds no page; name it .html"),
        (["decompose", "{case}", "--json", "a\0b"], "is not a file name"),
    ],
)
def test_bad_input_gets_one_line(engine, case, complaint, argv, part) -> None:
    folder = str(Path(case).parent)
    message = complaint(*(word.format(case=case, folder=folder) for word in argv))
    assert part.format(folder=folder) in message
    assert engine.calls == []
    assert Path(case).read_text() == LINES
    assert os.listdir(folder) == ["lines.toml"]


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may read and write all")
def test_files_without_permission_get_one_line(engine, case, complaint, tmp_path) -> None:
    target = tmp_path / "answer.json"
    target.write_text("old")
    target.chmod(0o444)
    assert "Permission denied" in complaint("decompose", case, "--json", str(target))
    assert target.read_text() == "old"
    Path(case).chmod(0)
    assert "Permission denied" in complaint("decompose", case)


def test_an_answer_is_printed_even_if_the_export_fails_at_the_end(
    engine, case, tmp_path, capsys, monkeypatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("nag.files.written_file.os.fsync", full)
    assert main(["decompose", case, "--json", str(tmp_path / "answer.json")]) == 2
    out, err = capsys.readouterr()
    assert "2 components of dimension 1, degree 1" in out
    assert err.endswith("answer.json: cannot be written: No space left on device\n")
    assert os.listdir(tmp_path) == ["lines.toml"]


def test_interruption_is_one_line_and_status_130(engine, case, capsys) -> None:
    engine.error = KeyboardInterrupt()
    assert main(["decompose", case]) == 130
    assert capsys.readouterr() == ("", "nag: interrupted\n")


def test_too_little_memory_is_one_line_and_status_1(engine, case, capsys) -> None:
    engine.error = MemoryError()
    assert main(["decompose", case]) == 1
    assert capsys.readouterr() == ("", "nag: not enough memory for this case\n")


def test_a_mistake_of_our_own_is_not_passed_off_as_bad_input(engine, case) -> None:
    engine.error = ValueError("a bug")
    with pytest.raises(ValueError, match="a bug"):
        main(["decompose", case])


@pytest.mark.parametrize("argv", [["--help"], ["decompose", "--help"], ["model", "--help"]])
def test_help_is_printed(argv, capsys) -> None:
    assert main(argv) == 0
    out, err = capsys.readouterr()
    assert out.startswith("usage: nag") and err == ""


def test_version_is_printed(capsys) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"nag {nag.__version__}\n"


def _nag(*argv: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "nag", *argv], text=True, timeout=120, check=False, **options
    )


def test_a_reader_that_goes_away_is_no_error(case) -> None:
    read, write = os.pipe()
    os.close(read)
    done = _nag("model", case, stdout=write, stderr=subprocess.PIPE)
    os.close(write)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    "words",
    [
        ["solve", "case.txt", "--points", "-"],
        ["family", "case.txt", "--values", "values.csv", "--points", "-"],
        ["motion", "case.txt", "--csv", "-"],
        ["motion", "case.txt", "--html", "-"],
        ["plot", "case.txt", "--tree", "--out", "-"],
    ],
    ids=lambda words: f"{words[0]} {words[-2]}",
)
def test_only_documents_go_to_standard_output(
    words: list[str], tmp_path, monkeypatch, capsys
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("case.txt").write_text("x^2 - 2\n")
    Path("values.csv").write_text("a\n1\n")
    assert main(words) == 2
    told = capsys.readouterr()
    assert told.err.startswith(f"nag: {words[-2]}") and told.err.count("\n") == 1
    assert not told.out and not Path("-").exists()


def test_a_full_disk_is_told_of_the_file_that_was_named(tmp_path, monkeypatch) -> None:
    target = tmp_path / "answer.json"
    options = argparse.Namespace(
        seed=0, threads=1, settings="default", progress=None, json=str(target), tell=print
    )

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("nag.files.written_file.os.fsync", full)
    run = chosen_run(options, lambda found: found.document())
    with pytest.raises(UsageError) as told:
        run.found(nag.decompose("x"))
    assert str(told.value) == f"--json: {target}: cannot be written: No space left on device"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is always full")
def test_a_full_disk_under_standard_output_is_one_line(case) -> None:
    with open("/dev/full", "w") as full:
        done = _nag("model", case, stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 2
    assert done.stderr == "nag: standard output cannot be written: No space left on device\n"


def test_titles_that_the_terminal_cannot_show_are_escaped(tmp_path) -> None:
    file = tmp_path / "case.toml"
    file.write_text(LINES.replace("Two lines", "Zwei Gerädén"), encoding="utf-8")
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = _nag("model", str(file), env=environment, capture_output=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("Zwei Ger\\xe4d\\xe9n\n")


def test_help_loads_nothing_heavy() -> None:
    heavy = {"numpy", "flint", "llvmlite", "scipy", "mpmath", "networkx"}
    code = (
        f"import sys, nag.cli; nag.cli.main(['--help']); print(*sorted({heavy} & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.endswith("\n\n")


def test_ctrl_c_ends_a_process_with_status_130_and_one_line(case, tmp_path) -> None:
    script = tmp_path / "run.py"
    script.write_text(
        "import signal, sys, time\n"
        "import nag.cli.model\n"
        # What is started in the background may ignore the signal.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def wait(arguments):\n"
        "    print('ready', flush=True)\n"
        "    time.sleep(60)\n"
        "nag.cli.model.run = wait\n"
        "sys.exit(nag.cli.main(['model', 'x']))\n"
    )
    process = subprocess.Popen(
        [sys.executable, str(script)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "ready\n", process.communicate()[1]
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert (process.returncode, err) == (130, "nag: interrupted\n")


def test_the_factors_of_one_equation_are_what_is_decomposed_with_symmetries_or_without(
    tmp_path, capsys
) -> None:
    file = tmp_path / "case.toml"
    equation = 'title = "t"\nkind = "system"\nvariables = ["x", "y", "z"]\n' + (
        'equations = ["(x + y)^2 - 2*z^2"]\n'
    )
    left = "exact linear algebra leaves one equation"
    for symmetry, paths in (("", False), ('[[symmetry]]\nmap = { z = "-z" }\n', True)):
        file.write_text(equation + symmetry)
        assert main(["model", str(file)]) == 0
        text = " ".join(capsys.readouterr().out.split())
        assert left in text and "paths" not in text
        assert main(["decompose", str(file), "--quiet"]) == 0
        text = " ".join(capsys.readouterr().out.split())
        assert left in text and "2 components of dimension 2, degree 1" in text
        # One for each image of a component that is looked for among the others.
        assert f"paths {2 if paths else 0} tracked" in text
        assert ("without paths" not in text) is paths


def test_an_interruption_while_arguments_are_read_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from nag.cli import command_line

    def parser(words: list[str]) -> argparse.ArgumentParser:
        signal.raise_signal(signal.SIGINT)
        return argparse.ArgumentParser()

    monkeypatch.setattr(command_line, "parser", parser)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        assert main(["decompose", "case.toml"]) == 130
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)
    assert capsys.readouterr().err == "nag: interrupted\n"


@pytest.mark.parametrize(
    ("name", "first"),
    [
        ("bennett", "mobility  it moves with 1 freedom at the reference configuration, though "),
        (
            "spatial/rssr",
            "mobility  it moves with 2 freedoms at the reference configuration, 1 of ",
        ),
        ("planar/four-bar", "mobility  it moves with 1 freedom, on 1 component; a real assembly"),
        ("rhombus", "answer     3 components of dimension 1, degree 2"),
    ],
)
def test_what_was_asked_is_said_first(name: str, first: str, capsys) -> None:
    assert main(["decompose", str(CASES / f"{name}.toml"), "--quiet"]) == 0
    assert capsys.readouterr().out.splitlines()[2].startswith(first)


def test_the_angles_of_the_first_linkage_count_from_the_ground(capsys) -> None:
    assert main(["init", "linkage"]) == 0
    links = {link["name"]: link["pins"] for link in tomllib.loads(capsys.readouterr().out)["link"]}
    assert [links["crank"][0], links["rocker"][0]] == links["base"]


def test_where_names_keep_a_loop_open_it_is_said_first(tmp_path, capsys) -> None:
    joints = (("base", "crank"), ("crank", "rod"), ("rod", "slyder"), ("slider", "base"))
    rows = [
        f'{{name = "J{i}", type = "revolute", bodies = ["{a}", "{b}"], point = [{i}, {i % 2}, 0], '
        "axis = [0, 0, 1]}"
        for i, (a, b) in enumerate(joints)
    ]
    file = tmp_path / "open.toml"
    kind = 'title = "t"\nkind = "mechanism"\nground = "base"'
    file.write_text(f"{kind}\njoint = [{', '.join(rows)}]\n")
    assert main(["mobility", str(file), "--quiet"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "there is no loop: slyder and slider hang on one joint each" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["init"], "required: {linkage,mechanism,framework,dh,system}"),
        (["completion"], "required: {bash,zsh,fish}"),
        (
            ["bench", "--case", "none", "--folder", "away"],
            "no benchmark is in the folder away; name",
        ),
        (["local", "CASE", "--at", "z = 0"], "'z' is not one of the variables; they are x, y"),
        (["plot", "CASE", "--onto", "x,z", "--out", "a.svg"], "'z' is not one of the variables; t"),
    ],
)
def test_bad_input_names_what_there_is(words, said, tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    case = tmp_path / "case.toml"
    case.write_text('title = "t"\nkind = "system"\nvariables = ["x", "y"]\nequations = ["x*y"]\n')
    assert main([str(case) if word == "CASE" else word for word in words]) == 2
    assert said in capsys.readouterr().err


def test_solve_says_who_finds_sets_of_positive_dimension(tmp_path, capsys) -> None:
    (tmp_path / "lines.txt").write_text("x*y\n")
    assert main(["solve", str(tmp_path / "lines.txt"), "--quiet"]) == 0
    assert "hint    `nag decompose` finds" in capsys.readouterr().out


def test_a_linkage_with_a_coupler_point_says_how_its_curve_is_found(tmp_path, capsys) -> None:
    (tmp_path / "case.toml").write_text(
        'title = "t"\nkind = "linkage"\nground = "base"\nlink = [\n'
        '{ name = "base", pins = ["A", "D"], length = 4 },\n'
        '{ name = "crank", pins = ["A", "B"], length = 2 },\n'
        '{ name = "rod", pins = ["B", "C", "P"], shape = [[0, 0], [3, 0], [1, 2]] },\n'
        '{ name = "rocker", pins = ["C", "D"], length = 3 },\n]\n'
    )
    assert main([str(tmp_path / "case.toml")]) == 0
    assert "the curve that P draws? (--onto x_P,y_P)" in capsys.readouterr().out
    assert main([str(CASES / "planar" / "four-bar.toml")]) == 0
    assert "--onto x_" not in capsys.readouterr().out


def test_a_degree_says_to_which_coordinates_it_belongs(capsys) -> None:
    degrees = {}
    for formulation in ("H", "E"):
        for command in ("decompose", "mobility"):
            case = str(CASES / "bennett.toml")
            assert main([command, case, "--formulation", formulation, "--quiet"]) == 0
            out = capsys.readouterr().out
            said = f"belongs to the coordinates, here formulation {formulation}; in others it may"
            assert said in " ".join(out.split())
            degrees.setdefault(formulation, set()).add(re.search(r"degree (\d+)", out)[1])
    assert degrees == {"H": {"2"}, "E": {"8"}}
