"""The benchmarks: they can be read, their counts are known, the table says what was measured."""

from __future__ import annotations

import json
import stat
from pathlib import Path

import numpy as np
import pytest

from nag.bench.measure import Measured, as_json
from nag.bench.peers import Peer, run_peer
from nag.bench.step_parts import PARTS, PartCost, StepCost, count_flops, measure_step
from nag.bench.table import step_table, table
from nag.cli import main
from nag.cli.bench import NAMES, files
from nag.files.cases import read_case
from nag.solving.start.target import Target
from nag.solving.start.total_degree import total_degree

FOLDER = Path(__file__).parent.parent / "cases" / "benchmarks"


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.toml")), ids=lambda p: p.stem)
def test_every_benchmark_can_be_read_and_has_a_source(path: Path) -> None:
    case = read_case(path)
    assert case.truth and all(t.source for t in case.truth)


def test_the_default_benchmarks_are_there() -> None:
    assert [p.stem for p in files(None, str(FOLDER))] == list(NAMES)


def test_unknown_benchmarks_are_one_line_and_status_two(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["bench", "--case", "katsura-99", "--folder", str(FOLDER)]) == 2
    assert "no such benchmark" in capsys.readouterr().err


def measured(**changes: object) -> Measured:
    values = {
        "case": "toy",
        "expected": 4,
        "solutions": 4,
        "complete": True,
        "start": "total",
        "paths": 4,
        "steps": 80,
        "seconds": 0.01,
        "two_threads": 0.01,
        "process": 0.5,
        "microseconds": 1.0,
        "flops": 1000,
        "bound": 0.1,
    }
    return Measured(**(values | changes))


def test_ratios_are_those_of_solving() -> None:
    peers = {"toy": {"M2": Peer("M2", 0.2, 1.0, 4), "phc": Peer("phc", None, 0.5, 4)}}
    lines = table([measured()], peers, ["M2", "phc"], 1e10)
    assert lines[1].split()[-2:] == ["20", "50"]
    assert "WRONG" not in "".join(lines)
    assert "WRONG: toy" in table([measured(solutions=3)], peers, ["M2", "phc"], 1e10)[-1]


def test_the_json_holds_every_measurement() -> None:
    value = json.loads(as_json([measured()], 1e10, {}))
    assert value["benchmarks"][0]["right"] is True
    assert value["flops_per_second"] == 1e10


def test_a_step_costs_more_where_there_are_more_terms() -> None:
    def flops(name: str) -> int:
        system = read_case(FOLDER / f"{name}.toml").system
        start = total_degree(Target.of(system.polynomials, system.n), np.random.default_rng(0))
        return sum(count_flops(start.homotopy).values())

    assert flops("katsura-6") < flops("katsura-8") < flops("katsura-10")


@pytest.mark.parametrize(
    ("program", "script", "wanted"),
    [
        ("M2", "echo 'result .25 4'", Peer("M2", 0.25, 0.0, 4)),
        ("M2", "echo stuck", Peer("M2", None, 0.0, None, "no answer")),
        ("phc", "printf 'THE SOLUTIONS :\\n 4 2\\n' >> system", Peer("phc", None, 0.0, 4)),
    ],
)
def test_what_other_programs_say_is_read(
    program: str, script: str, wanted: Peer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fake = tmp_path / program
    fake.write_text(f"#!/bin/sh\n{script}\n", "utf-8")
    fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    system = read_case(FOLDER / "griewank-osborne.toml").system
    peer = run_peer(program, system, 20.0)
    assert (peer.seconds, peer.solutions, peer.remark) == (
        wanted.seconds,
        wanted.solutions,
        wanted.remark,
    )


def test_a_step_is_explained_by_its_parts() -> None:
    cost = measure_step("katsura-6", read_case(FOLDER / "katsura-6.toml").system)
    assert [part.name for part in cost.parts] == [part.name for part in PARTS]
    assert all(part.flops > 0 and part.microseconds > 0 for part in cost.parts)
    spent = sum(part.microseconds for part in cost.parts)
    assert cost.unexplained == pytest.approx(cost.microseconds - spent)


def test_parts_are_told_beside_what_their_arithmetic_takes() -> None:
    parts = (PartCost("values", 1000, 0.25), PartCost("Jacobian", 3000, 0.5))
    lines = step_table([StepCost("toy", 1.0, parts)], rate=1e10)
    assert [line.split() for line in lines[1:5]] == [
        ["toy", "a", "step", "4000", "0.400", "1.000", "2.50"],
        ["values", "1000", "0.100", "0.250", "2.50"],
        ["Jacobian", "3000", "0.300", "0.500", "1.67"],
        ["between", "them", "-", "-", "0.250", "-"],
    ]


def test_steps_are_explained_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    command = ["bench", "--explain", "--case", "katsura-6", "--folder", str(FOLDER), "--quiet"]
    assert main([*command, "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["format"] == "nag-bench-steps"
    (system,) = document["systems"]
    assert system["case"] == "katsura-6" and len(system["parts"]) == len(PARTS)
