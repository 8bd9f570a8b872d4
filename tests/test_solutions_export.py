"""Exports of solutions fit their schema and read back equal; the command prints what it found."""

from __future__ import annotations

import json
import os
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import nag
from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem
from nag.cli import main
from nag.files.json_schema import schema
from nag.files.json_values import ExportError
from nag.files.solutions_export import (
    export_text,
    read_solutions,
    write_solutions,
)
from nag.solving.solutions import FORMAT, VERSION, Solutions, SolveResult
from nag.solving.solve import solve
from nag.text.json_text import lay_out, lay_out_parts

CASE = """
title = "A circle and a cubic"
kind = "system"
variables = ["x", "y"]
equations = ["x^2 + y^2 - 5", "x^2*y - 4"]
"""


@pytest.fixture(scope="module")
def result() -> SolveResult:
    names = ("x", "y")
    equations = ["x^2 + y^3", "y^2*(y - 1)"]
    return solve(PolynomialSystem(names, [parse_polynomial(e, names) for e in equations]), seed=3)


def test_the_schema_is_a_schema_of_what_is_written(result: SolveResult) -> None:
    jsonschema.Draft202012Validator.check_schema(schema("nag-solutions"))
    value = result.document("title", "file.toml")
    jsonschema.validate(value, schema("nag-solutions"))
    assert (value["format"], value["version"]) == (FORMAT, VERSION)
    assert [s["multiplicity"] for s in value["solutions"]].count(4) == 1


def test_an_export_reads_back_equal(result: SolveResult, tmp_path: Path) -> None:
    write_solutions(result, tmp_path / "a.json", "title", "file.toml")
    back = read_solutions(tmp_path / "a.json")
    assert (back.title, back.file) == ("title", "file.toml")
    assert back.result.points.tobytes() == result.points.tobytes()
    assert export_text(back.result, back.title, back.file) == export_text(
        result, "title", "file.toml"
    )
    assert back.result.system == result.system
    assert back.result.paths == result.paths
    assert back.result.method == result.method == "by_branches"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.update(format="other"), "format: must be"),
        (lambda d: d.update(version=2), "version: must be 1"),
        (lambda d: d.pop("solutions"), "'solutions' is missing"),
        (lambda d: d["solutions"][0].update(point=[[0, 0]]), "point: must be of length 2"),
        (lambda d: d["solutions"][0].update(multiplicity=0), "multiplicity: must be an integer"),
        (lambda d: d["system"].update(groups=[["z"]]), "'z' is not one of the variables"),
        (lambda d: d.update(complete=1), "complete: must be true or false"),
    ],
)
def test_what_is_no_export_is_refused_with_its_place(
    change: object, message: str, result: SolveResult, tmp_path: Path
) -> None:
    value = result.document()
    change(value)
    file = tmp_path / "bad.json"
    file.write_text(json.dumps(value), "utf-8")
    with pytest.raises(ExportError, match=message):
        read_solutions(file)


def test_the_command_prints_a_table_and_writes_the_same_bytes_for_any_number_of_threads(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(CASE, "utf-8")
    texts = []
    for threads in ("1", "2"):
        target = tmp_path / f"{threads}.json"
        arguments = ["solve", str(case), "--json", str(target), "--threads", threads, "--quiet"]
        assert main(arguments) == 0
        texts.append(target.read_bytes())
    assert texts[0] == texts[1]
    out = capsys.readouterr().out
    assert "6 isolated solutions" in out
    assert "solved exactly" in out
    value = json.loads(texts[0])
    jsonschema.validate(value, schema("nag-solutions"))
    points = np.array(value["solutions"][0]["point"]).view(float)
    assert points.shape == (2, 2)


def test_bad_input_is_one_line_and_status_two(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(CASE, "utf-8")
    assert main(["solve", str(case), "--start", "best"]) == 2
    assert main(["solve", str(tmp_path / "none.toml")]) == 2
    assert main(["solve", str(case), "--json", str(tmp_path / "no" / "where.json")]) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 3 and all(line.startswith("nag: ") for line in lines)


def test_too_many_paths_are_one_line_and_status_two(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = [f"x{i}" for i in range(8)]
    equations = ", ".join(f'"{v}^10 + {names[i - 1]} - 1"' for i, v in enumerate(names))
    case = tmp_path / "case.toml"
    listed = ", ".join(f'"{v}"' for v in names)
    case.write_text(
        f'title = "x"\nkind = "system"\nvariables = [{listed}]\nequations = [{equations}]\n',
        "utf-8",
    )
    assert main(["solve", str(case), "--start", "total", "--quiet"]) == 2
    assert "100000000 paths" in capsys.readouterr().err


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_what_is_written_part_by_part_is_the_document(count: int, monkeypatch) -> None:
    monkeypatch.setattr("nag.text.json_text.AT_ONCE", 2)
    roots = nag.solve(" * ".join(["1", *(f"(x - {k})" for k in range(count))]))
    text = "".join(lay_out_parts(roots.document_to_write()))
    assert text == lay_out(roots.document())


def test_solutions_are_a_sequence_whose_columns_are_arrays() -> None:
    roots = nag.solve(["x^2 = 2", "y^2 = 3"]).solutions
    assert [roots[k] for k in range(4)] == list(roots) == [*roots[:1], *roots[1:]]
    assert roots[-1] == roots[3] and roots[2] in roots and roots == tuple(roots)
    assert roots != roots[:3] and roots[:0] == ()
    with pytest.raises(IndexError):
        roots[4]
    again = Solutions.of(list(roots), 2)
    assert np.array_equal(again.points, np.array([s.point for s in roots]))
    assert again.accuracy.tolist() == [s.accuracy for s in roots]
    assert again.radii.keys() == {k for k, s in enumerate(roots) if s.radii is not None}


def test_the_command_writes_solutions_as_arrays(tmp_path: Path, capsys) -> None:
    case, file = tmp_path / "case.toml", tmp_path / "roots.npz"
    case.write_text(CASE)
    assert main(["solve", str(case), "--points", str(file), "--quiet"]) == 0
    roots = nag.solve(nag.read_case(case))
    with np.load(file, allow_pickle=False) as arrays:
        assert np.array_equal(arrays["points"], roots.points)
        assert arrays["variables"].tolist() == ["x", "y"]
        for name in ("multiplicity", "real", "residual", "accuracy", "condition", "precision"):
            assert arrays[name].tolist() == [getattr(root, name) for root in roots]
    assert main(["solve", str(case), "--points", str(tmp_path / "no" / "f.npz"), "--quiet"]) == 2
    assert "--points" in capsys.readouterr().err


def test_the_command_writes_solutions_as_a_table(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    pandas = pytest.importorskip("pandas")
    case, file = tmp_path / "case.toml", tmp_path / "roots.parquet"
    case.write_text(CASE)
    assert main(["solve", str(case), "--points", str(file), "--quiet"]) == 0
    roots, frame = nag.solve(nag.read_case(case)), pandas.read_parquet(file)
    for i, name in enumerate(["x", "y"]):
        assert np.array_equal(
            frame[f"{name}.real"] + 1j * frame[f"{name}.imag"], roots.points[:, i]
        )
    for name in ("multiplicity", "real", "residual", "accuracy", "condition", "precision"):
        assert frame[name].tolist() == [getattr(root, name) for root in roots]


def test_a_table_that_cannot_be_written_is_refused_before_the_work(
    tmp_path: Path, capsys, monkeypatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    case, file = tmp_path / "case.toml", tmp_path / "roots.parquet"
    case.write_text(CASE)
    assert main(["solve", str(case), "--points", str(file), "--quiet"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "pip install pandas pyarrow" in said and not file.exists()


def test_two_options_do_not_name_one_file(tmp_path, capsys) -> None:
    case, file = tmp_path / "a.txt", tmp_path / "a.out"
    case.write_text("x^2 - 2\n")
    again = tmp_path / "." / "b" / ".." / "a.out"
    (tmp_path / "b").mkdir()
    told = ["solve", str(case), "--quiet", "--json", str(file), "--points"]
    assert main([*told, str(again)]) == 2 and not file.exists()
    assert "--points" in (said := capsys.readouterr().err) and "--json" in said
    assert main(["solve", str(case), "--quiet", "--json", os.devnull, "--points", os.devnull]) == 0


@pytest.mark.parametrize("start", ["auto", "total", "polyhedral"])
@pytest.mark.parametrize(
    "equations",
    [
        ["x^2 + y^2 - sqrt(2)", "x*y - 1/3"],
        ["x^2 + y^2 - 2", "x*y - 1"],
        ["x^3 + y^2 + z - 1", "x*y*z - 1", "x + y^2 - z"],
    ],
)
def test_what_was_written_is_equal_when_it_is_read(
    equations: list[str], start: str, tmp_path: Path
) -> None:
    solved = nag.solve(equations, start=start)
    nag.write(solved, tmp_path / "solved.json")
    again = nag.read(tmp_path / "solved.json")
    assert again == solved and list(again) == list(solved) and again.larger == solved.larger
    assert all(solution in list(again) for solution in solved)
    assert solved != nag.solve(equations[1:] + ["x + y - 5"] * (len(equations) - 1))
