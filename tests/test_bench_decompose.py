"""Benchmarks of decompositions: the systems are those of the cases, bad input gets one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from linkages import case

from nag.bench.chains import CHAINS
from nag.bench.decomposition import (
    Decomposed,
    PeerDecomposed,
    as_json,
    cell_factor,
    growth,
    growth_chart,
    growth_exponent,
    measure_decomposition,
)
from nag.bench.models import measure_models
from nag.bench.table import decomposition_table as table
from nag.bench.table import models_table
from nag.cli import bench_decompose, main
from nag.files.cases import read_case

CASES = Path(__file__).parent.parent / "cases"


def row(components: int, seconds: float, paths: int = 1, right: bool = True) -> Decomposed:
    return Decomposed(f"{components}", 2, components, 1, paths, 0, seconds, True, right)


@pytest.mark.parametrize(
    "name",
    [
        "rhombus-chain-2",
        "rhombus-chain-3",
        "benchmarks/rhombus-chain-4",
        "benchmarks/rhombus-chain-5",
    ],
)
def test_chains_are_those_of_the_case_files(name: str) -> None:
    case = read_case(CASES / f"{name}.toml")
    rhombi, k = CHAINS["rhombi"], int(name[-1])
    truth = rhombi.truth(k)
    assert rhombi.make(k) == case.system
    assert [(t.dimension, t.degree, t.count) for t in truth] == [
        (t.dimension, t.degree, t.count) for t in case.truth
    ]


def test_growth_is_the_slope_in_logarithms() -> None:
    rows = [row(3**k, 2.0 * 9.0**k, 5 * 3**k) for k in range(1, 5)]
    assert growth_exponent(rows, "seconds") == pytest.approx(2)
    assert growth_exponent(rows, "paths") == pytest.approx(1)
    with pytest.raises(ValueError, match="two chains"):
        growth_exponent(rows[:1], "paths")


def test_the_factor_of_a_cell_is_the_slope_of_the_logarithm() -> None:
    rows = [row(1, 0.25 * 3.0**n, int(n == 1)) for n in range(1, 5)]
    assert cell_factor(rows, "seconds") == pytest.approx(3)
    with pytest.raises(ValueError, match="two chains"):
        cell_factor(rows, "paths")


@pytest.mark.parametrize("name", sorted(CHAINS))
def test_short_chains_are_what_is_known_of_them(name: str) -> None:
    for measured in growth(CHAINS[name], 2):
        assert measured.right


def test_the_command_knows_all_chains() -> None:
    assert tuple(CHAINS) == bench_decompose.CHAINS
    assert max(chain.most for chain in CHAINS.values()) == bench_decompose.MOST_CELLS


def test_a_decomposition_is_measured_against_what_is_known() -> None:
    rhombi = CHAINS["rhombi"]
    system = rhombi.make(1)
    measured = measure_decomposition("chain", system, rhombi.truth(1))
    assert measured.right and measured.complete
    assert (measured.components, measured.dimension, measured.failed) == (3, 1, 0)
    wrong = measure_decomposition("chain", system, rhombi.truth(2))
    assert wrong.complete and not wrong.right


def test_table_shows_what_the_other_program_answers() -> None:
    peers = {
        "3": PeerDecomposed(1.5, 2.0, True),
        "9": PeerDecomposed(None, 200.0, None, "no answer in 200 s"),
    }
    lines = table([row(3, 0.5), row(9, 0.5, right=False)], peers)
    assert lines[1].split()[-4:] == ["0.5000", "1.500", "3.0", "right"]
    assert lines[2].split(maxsplit=8)[6:8] == ["WRONG", "0.5000"]
    assert lines[2].split(maxsplit=8)[8] == "-  > 400  no answer in 200 s"
    rows = json.loads(as_json([row(3, 0.5)], peers))["systems"]
    assert rows[0]["M2"]["seconds"] == 1.5


def test_chart_is_drawn(tmp_path) -> None:
    pytest.importorskip("matplotlib")
    path = tmp_path / "growth.png"
    growth_chart([row(3**k, 0.1 * 3**k, 10 * 3**k) for k in (1, 2, 3)], str(path))
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--decompose", "--case", "none"], "there is no"),
        (["--growth", "1"], "is not a number from 2 to 12"),
        (["--growth", "7"], "at most 6 are chained"),
        (["--of", "polygons"], "ask for that as well"),
        (["--chart", "x.png"], "ask for that as well"),
        (["--decompose", "--json", "/no/such/folder/x.json"], "--json"),
    ],
)
def test_bad_input_gets_one_line(arguments: list[str], message: str, capsys) -> None:
    assert main(["bench", *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1


def test_models_are_measured_in_every_formulation_that_can_be_tracked():
    """Bennett: the unreduced constraints ask for a million paths, half-angles for next to none."""
    rows = measure_models("bennett", case("bennett"), 120, ("H",))
    assert [r.formulation for r in rows] == ["unreduced", "H"]
    assert [r.taken for r in rows] == [False, True]
    unreduced, half = rows
    assert (unreduced.variables, unreduced.equations) == (21, 23)
    assert unreduced.paths is unreduced.seconds is None
    assert (half.variables, half.equations, half.bezout) == (2, 1, 2)
    assert half.components == ((1, 2, 1),)
    assert half.complete and half.paths < 10
    assert any("bennett" in line and "unreduced" in line for line in models_table(rows))


def test_parts_are_measured_in_every_coordinates_with_the_same_components():
    """A four-bar's sextic curve, by the turns of its links and by the places of its pins."""
    parts = read_case(CASES / "planar" / "four-bar.toml").assembly
    turns, pins = measure_models("four-bar", parts, 120)
    assert (turns.formulation, pins.formulation) == ("turns (c, s)", "pins (x, y)")
    assert (turns.taken, pins.taken) == (True, False)
    # The two linear equations are solved: three distances are left.
    assert (turns.variables, turns.equations, turns.bezout, turns.estimate) == (4, 3, 8, 14)
    assert turns.components == pins.components == ((1, 6, 1),)
    assert turns.complete and pins.complete
