"""What is known before the work is done: a part of the answer, and marked incomplete."""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import nag
from nag.cli import main, running
from nag.cli.running import chosen_run, take_unfinished, unfinished_file, write_document
from nag.text.json_text import lay_out
from nag.tracking.run import ENDED_EARLY, UNFINISHED

APART = ["(x^2 + y^2 + z^2 - 4)*(x*y - z)", "(x - y)*(x^3 + y*z - 1)"]
ONE_BY_ONE = ["x*z - y^2", "y - x^2 + z*w - z*x^3*w^2", "x*(z - x*y)"]


def kinds(answer: nag.Decomposition) -> Counter:
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)


@pytest.mark.parametrize("equations", [APART, ONE_BY_ONE])
def test_components_are_told_when_they_are_known(equations: list[str]) -> None:
    told: list[nag.Decomposition] = []
    system = nag.system(equations)
    answer = nag.decompose(system, found=told.append)
    assert told and answer == nag.decompose(system)
    for early in told:
        assert early.system == system and early.notes == (UNFINISHED,) and not early.complete
        for component in early:
            # A branch knows neither the others' components nor all that its own are multiple in.
            found = nag.member(answer, component.points[0])
            assert found.complete
            assert any(
                c.dimension > component.dimension
                or (
                    (c.dimension, c.degree) == (component.dimension, component.degree)
                    and c.multiplicity >= component.multiplicity
                )
                for c in found.on
            )
    if equations is ONE_BY_ONE:
        shapes = [Counter((c.dimension, c.degree) for c in d) for d in [*told, answer]]
        assert all(early <= shapes[-1] for early in shapes)


def test_solutions_are_told_before_missing_ones_are_looked_for() -> None:
    told: list[nag.SolveResult] = []
    system = nag.system(["x^2 + y^2 + z^2 - 9", "x*y*z - z^2 + 1", "x^2 + y*z^2 - 3"])
    result = nag.solve(system, found=told.append)
    assert result.complete and result == nag.solve(system)
    for early in told:
        assert not early.complete and early.notes == (UNFINISHED,)
    # Ends that are regular are told before the others are followed.
    assert 0 < len(told[0].solutions) <= len(told[-1].solutions) == len(result.solutions)


def test_the_conjugate_of_a_complex_system_is_not_told_of() -> None:
    told: list[Any] = []
    equations = ["x^2 + y^2 + z^2 - 9*I", "x*y*z - z^2 + I", "x^2 + y*z^2 - 3"]
    system = nag.system(equations, variables="x y z")
    assert len(nag.solve(system, found=told.append).solutions) == len(told[0].solutions)


def test_what_is_told_stands_beside_the_export_until_that_is_there(tmp_path: Path) -> None:
    target = tmp_path / "a.json"
    options = argparse.Namespace(
        seed=0, threads=1, settings="default", progress=None, json=str(target), tell=print
    )
    system = nag.system(APART)
    nag.decompose(system, run=chosen_run(options, lambda found: found.document()))
    kept = nag.read(unfinished_file(str(target)))
    assert isinstance(kept, nag.Decomposition) and not kept.complete and len(kept)
    assert take_unfinished(str(target)) and nag.read(target) == kept
    assert not take_unfinished(str(target)) and not take_unfinished(None)


def test_members_circuits_modes_and_local_answers_are_told_when_they_are_known() -> None:
    members, moves, modes, local = [], [], [], []
    circles = ["x^2 + y^2 = r", "x = a*y"]
    values = [[2 + i / 1000, 1] for i in range(4000)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("nag.tracking.run.BETWEEN", 0.0)
        whole = nag.solve_family(circles, ["r", "a"], values, found=members.append)
    # How many of them are told, beside the first, is a matter of time.
    counts = [int(f.complete.sum()) for f in members]
    assert counts[0] == 1000 and set(counts) <= {1000, 2000, 3000} and whole.complete.all()
    assert all(np.array_equal(f.points, whole.points[: len(f)]) for f in members)

    moving = nag.motion("cases/planar-four-bar.toml", circuit="all", found=moves.append)
    assert moves and moves[-1].notes[-1] == ENDED_EARLY and not moves[-1].complete
    assert [c.length for c in moves[-1].circuits] == [c.length for c in moving.circuits]

    driven = []
    with pytest.MonkeyPatch.context() as patch:
        # Telling takes no time.
        patch.setattr("nag.tracking.run.time", SimpleNamespace(monotonic=lambda: 0.0))
        patch.setattr("nag.tracking.run.BETWEEN", 0.0)
        through = nag.driven_motion(
            "cases/bennett.toml", "J0", [0.2, 0.3, 0.4], found=driven.append
        )
    assert [len(early) for early in driven] == [1, 2] and len(through) == 3 and through.complete
    for early in driven:
        assert not early.complete and early.notes[0] == ENDED_EARLY
        assert (
            early.values == through.values[: len(early)] and early.motions == through[: len(early)]
        )
    held: list[Any] = []
    nag.motion("cases/bennett.toml", drive=("J0", 0.2), found=held.append)
    assert all(early.drive == through[0].drive and not early.complete for early in held) and held

    robot = nag.read_case("cases/robots/3-upu-tsai-120.toml")
    found = nag.modes(robot, found=modes.append)
    assert all(m.notes == (ENDED_EARLY,) and len(m.modes) == len(found.modes) for m in modes)
    described = [sum(m.motion is not None for m in early.modes) for early in modes]
    assert described == sorted(described) and described[-1] == len(found.modes)

    answer = nag.mobility("cases/bennett.toml", found=local.append)
    (early,) = local
    assert early.open == ENDED_EARLY and early.components is None
    assert early.local_dimension == answer.local_dimension == 1


@pytest.mark.parametrize("threads", [1, 2])
def test_all_members_that_are_solved_are_told_when_the_work_is_interrupted(threads: int) -> None:
    told: list[nag.FamilySolutions] = []
    values = [[2 + i / 1000, 1] for i in range(5000)]

    def interrupt(stage: str, done: int, total: int) -> None:
        # Not told of yet: the one before was just now.
        if stage == "members" and done == 4000:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        nag.solve_family(
            ["x^2 + y^2 = r", "x = a*y"],
            ["r", "a"],
            values,
            threads=threads,
            found=told.append,
            progress=interrupt,
        )
    assert len(told[-1]) >= 3000 and told[-1].complete.all()


def test_where_the_solutions_of_members_are_is_said_if_they_were_written(
    tmp_path: Path, capsys
) -> None:
    case, values, target = (str(tmp_path / name) for name in ("a.toml", "a.csv", "a.json"))
    Path(case).write_text(
        'title = "roots"\nkind = "system"\nvariables = ["x"]\nequations = ["x^2 - a"]\n'
        '[parameters]\na = 1\n[family]\nparameters = ["a"]\n'
    )
    Path(values).write_text("a\n1\n4\n")
    ask = ["family", case, "--values", values, "--json", target, "--quiet"]
    for more, said in (([], False), (["--points", str(tmp_path / "a.npz")], True)):
        assert main([*ask, *more]) == 0
        capsys.readouterr()
        assert main(["show", target]) == 0
        assert ("in the arrays of a.npz" in capsys.readouterr().out) is said


@pytest.mark.parametrize(
    ("command", "case", "rest"),
    [
        ("motion", "planar-four-bar", ["--circuit", "all"]),
        ("motion", "bennett", ["--drive", "J0=20"]),
        ("motion", "bennett", ["--drive", "J0=20:40:3"]),
        ("modes", "robots/tripteron", []),
        ("mobility", "bennett", []),
        ("decompose", "four-bar", ["--sweep", "a=2:3:2"]),
    ],
)
def test_what_a_command_keeps_reads_back_as_incomplete(
    command: str, case: str, rest: list[str], tmp_path: Path, capsys, monkeypatch
) -> None:
    kept: list[str] = []

    def keep(document: Any, target: str, option: str = "json", file: str | None = None) -> None:
        kept.append(file or target)
        write_document(document, target, option, file)

    monkeypatch.setattr(running, "write_document", keep)
    monkeypatch.setattr(running, "keeps_unfinished", lambda options: options.json is not None)
    monkeypatch.setattr(running, "forget_unfinished", lambda options: None)
    target = str(tmp_path / "a.json")
    assert main([command, f"cases/{case}.toml", *rest, "--json", target, "--quiet"]) == 0
    assert kept[0] == unfinished_file(target) and kept[-1] == target
    assert take_unfinished(target)
    early = nag.read(target)
    assert early["complete"] is False and early["seed"] == 0
    assert ENDED_EARLY in [*early.get("notes", ()), early.get("open")]
    assert main(["show", target]) == 0
    said = capsys.readouterr().out
    assert "INCOMPLETE" in said and " ".join(ENDED_EARLY.split()[:4]) in said


def test_nothing_unfinished_is_left_by_what_ends(tmp_path: Path) -> None:
    target = tmp_path / "a.json"
    Path(unfinished_file(str(target))).write_text("of an earlier run")
    assert main(["decompose", "cases/rhombus.toml", "--json", str(target), "--quiet"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["a.json"]


@pytest.mark.parametrize("text", ["}", "{", "}\0{", '"', "ü", ", "])
def test_a_list_of_flat_objects_is_laid_out_as_each_by_itself(text: str) -> None:
    flat = {text: text, "b": 1, "c": None, "d": 0.5, "e": True}
    one = lay_out(flat, "  ")
    assert lay_out([flat, flat]) == f"[\n  {one},\n  {one}\n]"
    assert json.loads(lay_out([flat, flat])) == [flat, flat]
