"""What a command is told by an option, its function is told by a keyword of that name."""

from __future__ import annotations

import argparse
import inspect
from dataclasses import fields
from functools import reduce
from importlib import import_module
from pathlib import Path

import pytest

import nag
from nag.cli import main
from nag.cli.command_line import COMMANDS
from nag.questions import FILE_OPTIONS

# Functions of other names.
FUNCTIONS = {"family": "solve_family", "report": "write_report", "check": "check_statements"}
# Commands without a function at the top level, and what stands for them.
TERMINAL = {
    "show": "print(nag.read(path))",
    "init": "writes a file to be edited",
    "bench": "measures this machine",
    "chart": "draws measurements of this machine",
    "completion": "is for a shell",
}
# What a terminal alone needs: files of results, which in Python are objects, and a process.
FOR_TERMINALS = {
    "json": "nag.write, and document() of every result",
    "points": "to_numpy() of the result",
    "csv": "to_dataframe() of the result",
    "html": "nag.write of a motion, and the path of nag.write_report",
    "quiet": "nothing is told unless progress= is given",
    "memory_limit": "ends the whole process",
}
# Options by command and name, whose keyword has another name, with the reason.
RENAMED = {
    ("local", "at"): "point",  # a point is given by its name or by itself
    ("member", "at"): "point",
    ("eliminate", "at"): "point",
    ("mobility", "at"): "point",  # of a robot `at`
    ("intersect", "components"): "first",  # and second: two arguments
    ("mobility", "local"): "detail",  # one of which is asked for
    ("mobility", "components"): "detail",
    ("mobility", "curves"): "detail",
    ("plot", "out"): "path",
    ("report", "html"): "path",
    ("model", "from"): "format",  # its --format is that of what it writes
}
# A model tracks no paths, and is made within its bounds of work.
TRACKS_NOTHING = {("model", "time_limit")}
# Everything that the papers state, where no case is given.
WITHOUT_CASE = {("check", "all")}
# Options whose answer is of another kind, or of another question: the function that gives it.
ELSEWHERE = {
    ("decompose", "sweep"): "nag.sweep_parameter",
    ("decompose", "modes"): "nag.decompose_modes",
    ("decompose", "certify"): "nag.certify",
    ("decompose", "certify_paths"): "nag.certify",
    ("solve", "certify"): "nag.certify",
    ("solve", "certify_paths"): "nag.certify",
    ("singular", "free"): "nag.decomposition.singular_parameters",
    ("mobility", "check"): "nag.mechanism.other_equations.other_equations",
    ("local", "check"): "nag.member",
    ("motion", "angles"): "nag.kinematics.motion.Motion.table",
    ("model", "format"): "nag.write",
}
# Keywords that a command has no option for, with the reason.
IN_PYTHON = {
    "variables": "a file names its variables",
    "imaginary": "a file names its imaginary unit",
    "symmetries": "a case declares its symmetries",
    "parameters": "a case, or the table of values, names them",
    "known": "solutions of an earlier call, as an array",
    "count": "a case's [family] has it",
    "progress": "a terminal has a line of its own",
    "found": "a file of --json is kept up to date",
}
OF_MODELS = {
    "modes": "for other assembly modes, which decompose --modes all goes through",
    "space": "for a planar mechanism that is taken as one in space",
}


def options_of(command: str) -> set[str]:
    """Names of a command's options, as keywords are written; not of the file that it reads."""
    parser = argparse.ArgumentParser(add_help=False)
    import_module(f"nag.cli.{command}").add_arguments(parser)
    names = set()
    for action in parser._actions:
        if action.option_strings or action.dest == "point":
            name = action.option_strings[-1] if action.option_strings else action.dest
            names.add(name.removeprefix("--").replace("-", "_"))
    return names


def keywords_of(command: str) -> set[str]:
    """Names of a function's arguments but the first, the run's fields for the run."""
    function = getattr(nag, FUNCTIONS.get(command, command))
    _, *names = inspect.signature(function).parameters
    if "run" in names:
        names += [each.name for each in fields(nag.Run)]
        names.remove("run")
    return {*names}


# Commands that take no case: an export, or nothing that is read.
WITHOUT_CASES = {"certify", "init", "bench", "chart", "completion"}
ASKED = [name for name, *_ in COMMANDS if name not in TERMINAL]


def test_every_command_has_its_function() -> None:
    assert {FUNCTIONS.get(name, name) for name in ASKED} <= {*nag.__all__}


@pytest.mark.parametrize("command", ASKED)
def test_an_option_is_a_keyword_of_the_same_name(command: str) -> None:
    known = keywords_of(command)
    for name in options_of(command) - FOR_TERMINALS.keys():
        if (command, name) in ELSEWHERE:
            _, *path = ELSEWHERE[command, name].split(".")
            assert callable(reduce(getattr, path, import_all(path)))
        elif (command, name) in RENAMED:
            assert RENAMED[command, name] in known, name
        elif (command, name) not in TRACKS_NOTHING | WITHOUT_CASE:
            assert name in known, name


def import_all(path: list[str]) -> object:
    """The package `nag`, once a module is imported that is named by the beginning of a path."""
    for k in range(1, len(path)):
        try:
            import_module(".".join(["nag", *path[:k]]))
        except ModuleNotFoundError:
            break
    return nag


@pytest.mark.parametrize("command", ASKED)
def test_a_keyword_is_an_option_of_the_same_name(command: str) -> None:
    asked = options_of(command)
    renamed = {new for (of, _), new in RENAMED.items() if of == command}
    apart = {*renamed, *FILE_OPTIONS, *IN_PYTHON, *(OF_MODELS if command == "model" else ())}
    if "first" in renamed:
        apart.add("second")
    # What tracks nothing, or is decomposed or solved first only where no export is given.
    apart |= {each.name for each in fields(nag.Run)} if "seed" not in asked else set()
    apart |= {"formulation"} if command in ("certify", "family") else set()
    assert keywords_of(command) - asked <= apart


@pytest.mark.parametrize("command", [name for name, *_ in COMMANDS if name not in WITHOUT_CASES])
def test_a_file_is_read_in_the_same_way_by_every_command(command: str) -> None:
    renamed = {old for (of, old), new in RENAMED.items() if of == command and new in FILE_OPTIONS}
    assert {*FILE_OPTIONS} <= options_of(command)
    assert renamed == ({"from"} if command == "model" else set())


def test_options_stand_before_between_and_behind_the_rest(capsys) -> None:
    case = str(Path(__file__).parent.parent / "cases" / "bennett.toml")
    for words in (
        ["local", case, "reference", "--quiet"],
        ["local", case, "--quiet", "reference"],
        ["local", "--quiet", case, "--seed", "0", "reference"],
    ):
        assert main(words) == 0
        assert "reference: x_J1 = -3/7" in capsys.readouterr().out
    assert main(["local", case, "reference", "--quiet", "again"]) == 2
    assert capsys.readouterr().err.startswith("nag: unrecognized arguments: again")
    assert main(["local", "--help"]) == 0
    assert capsys.readouterr().out.startswith("usage: nag local [OPTION ...] CASE [POINT]\n\nSay")


@pytest.mark.parametrize("command", ASKED)
def test_a_file_is_read_in_the_same_way_by_every_function(command: str) -> None:
    taken = inspect.signature(getattr(nag, FUNCTIONS.get(command, command))).parameters
    assert {name: taken[name].default for name in FILE_OPTIONS} == FILE_OPTIONS
    documented = getattr(nag, FUNCTIONS.get(command, command)).__doc__
    assert "how a file is read, as for `nag.read`" in documented


ARM = """<robot name="arm">
<link name="base"/><link name="a"/><link name="tool"/>
<joint name="j1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
<joint name="j2" type="revolute"><parent link="a"/><child link="tool"/><axis xyz="0 1 0"/></joint>
</robot>
"""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["mobility", "{arm}", "--hold", "hand"], "{arm}: --hold: 'hand' is no link"),
        (["mobility", "{arm}", "--at", "j9 = 1"], "{arm}: --at: 'j9' is no joint"),
        (["mobility", "{arm}", "--hold", "tool", "--at", "j1 = q"], "{arm}: --at: 'j1': column 1"),
        (["mobility", "cases/bennett.toml", "--hold", "x"], "cases/bennett.toml: --hold: is for"),
        (["motion", "cases/bennett.toml", "--drive", "J9=1"], ": --drive: 'J9' is no angle"),
        (["sample", "cases/rhombus.toml", "--component", "7"], "--component: 7: there are"),
        (["mobility", "cases/bennett.toml", "--tolerance", "-1e-3"], "--tolerance: -0.001 is not"),
    ],
)
def test_what_an_option_says_wrongly_is_told_by_the_option(
    words: list[str], said: str, tmp_path: Path, monkeypatch, capsys
) -> None:
    monkeypatch.chdir(Path(__file__).parent.parent)
    arm = tmp_path / "arm.urdf"
    arm.write_text(ARM)
    assert main([word.format(arm=arm) for word in words]) == 2
    error = capsys.readouterr().err
    assert said.format(arm=arm) in error
    assert error.count("\n") == 1


def test_what_a_file_says_wrongly_is_told_by_its_key(tmp_path: Path, capsys) -> None:
    (tmp_path / "arm.urdf").write_text(ARM)
    case = tmp_path / "arm.toml"
    case.write_text('title = "t"\nkind = "robot"\nfile = "arm.urdf"\nhold = ["hand"]\n')
    assert main(["mobility", str(case)]) == 2
    assert "--hold" not in capsys.readouterr().err
    export = tmp_path / "export.json"
    export.write_text('{"format": "other"}')
    assert main(["show", str(export)]) == 2
    assert "--format" not in capsys.readouterr().err


def test_a_file_that_is_not_there_is_told_in_one_way(tmp_path: Path, capsys) -> None:
    gone = str(tmp_path / "gone.toml")
    said = f"{gone}: cannot be read (No such file or directory); give the path of a file that is"
    calls = [nag.read, nag.read_case, nag.read_decomposition, nag.read_solutions]
    calls += [
        nag.solve,
        nag.mobility,
        nag.member,
        lambda path: nag.solve_family("x^2 - b", "b", path),
    ]
    for call in calls:
        with pytest.raises(nag.InputError) as error:
            call(gone)
        assert str(error.value).startswith(said)
    for words in (["solve"], ["show"], ["certify"], ["mobility"], ["family", "--values", gone]):
        assert main([words[0], gone, *words[1:]]) == 2
        assert capsys.readouterr().err.startswith(f"nag: {said}")


def test_an_export_where_a_case_is_wanted_is_told_what_it_is(tmp_path: Path, capsys) -> None:
    components, solutions = str(tmp_path / "components.json"), str(tmp_path / "solutions.json")
    samples = str(tmp_path / "samples.json")
    nag.write(nag.decompose("x*y"), components)
    nag.write(nag.solve("x^2 - 1"), solutions)
    nag.write(nag.sample("x*y", count=1), samples)
    for call in (nag.mobility, nag.motion, nag.modes, nag.decompose_modes, nag.gruebler_kutzbach):
        with pytest.raises(nag.InputError, match="is an export of components, which has no mech"):
            call(components)
    for ask in (nag.certify, nag.decompose, nag.member):
        with pytest.raises(nag.InputError, match="samples, which has no equations; give a case, "):
            ask(samples)
    assert nag.member(components, (0, 1)).on
    assert nag.certify(solutions)
    assert main(["mobility", components]) == 2
    assert "is an export (nag-decomposition), and no case" in capsys.readouterr().err
    assert main(["decompose", samples]) == 2
    said = "has no equations; give a case, or an export of components or solutions\n"
    assert capsys.readouterr().err == f"nag: {samples}: {said}"
    # Longer than any case may be.
    Path(components).write_text(Path(components).read_text() + " " * 3_000_000)
    assert main(["member", components, "--at", "x = 0, y = 1"]) == 0


def test_an_export_stands_for_the_equations_that_it_answers(tmp_path: Path, capsys) -> None:
    equations = ["x^2 + y^2 - 2", "x*(x - y)"]
    answers = nag.decompose(equations), nag.solve(equations)
    files = [str(tmp_path / name) for name in ("components.json", "solutions.json")]
    for found, file in zip(answers, files, strict=True):
        nag.write(found, file)
        for given in (found, file):
            assert nag.decompose(given) == answers[0] and nag.solve(given) == answers[1]
            assert nag.model(given).system == nag.problem(given).system == found.system
            assert nag.local(given, (1, 1)).multiplicity == 1
            assert nag.member(given, (1, 1)).on and len(nag.singular(given)) == 0
            with pytest.raises(nag.NagError, match="what is given has its own, leave it out"):
                nag.solve(given, imaginary="I")
        with pytest.raises(nag.InputError, match="is an export; set is for cases, leave it out"):
            nag.solve(file, set={"x": 1})
        for words in (["solve"], ["decompose"], ["model"], ["member", "--at", "x = 1, y = 1"]):
            assert main([words[0], file, *words[1:], "--quiet"]) == 0
        assert main(["local", file, "--at", "x = 1, y = 1", "--quiet"]) == 0
        assert main(["solve", file, "--set", "x=1"]) == 2
        assert capsys.readouterr().err == f"nag: {file}: is an export; --set is for cases\n"


def test_unknowns_of_what_an_export_answers_become_parameters(tmp_path: Path, capsys) -> None:
    file, values = str(tmp_path / "found.json"), tmp_path / "values.csv"
    nag.write(nag.decompose("x^2 = y"), file)
    values.write_text("y\n1\n4\n")
    assert nag.solve_family(file, "y", [[1], [4]]).counts.tolist() == [2, 2]
    assert nag.singular(file, free="y").texts() == ["y = 0"]
    assert main(["family", file, "--values", str(values), "--quiet"]) == 0
    assert main(["singular", file, "--free", "y", "--quiet"]) == 0


def test_an_export_has_the_symmetries_that_carry_its_components_into_each_other(
    tmp_path: Path,
) -> None:
    file = str(tmp_path / "bennett.json")
    found = nag.decompose("cases/bennett.toml", formulation="E")
    nag.write(found, file)
    again = nag.decompose(file)
    assert [c.orbit for c in again.components] == [c.orbit for c in found.components]


@pytest.mark.parametrize("text", ["a*x^2 - 1\n", "variables x, a\na*x^2 - 1", "imaginary I\na*x-1"])
def test_the_letter_of_the_imaginary_unit_is_told(text: str, tmp_path: Path) -> None:
    file = tmp_path / "system.txt"
    file.write_text(text)
    with pytest.raises(nag.InputError, match="'i' looks like the imaginary unit; it is called 'I'"):
        nag.solve(file, set={"a": "2*i"})
    assert nag.read(file, set={"a": "2*I"}).system.imaginary
