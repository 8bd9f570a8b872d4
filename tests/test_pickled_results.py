"""What all results have in common: equality, one line, what they hold, arrays that stay."""

from __future__ import annotations

import ast
import copy
import json
import pickle
from collections.abc import Hashable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from functools import cache
from pathlib import Path
from tempfile import gettempdir
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import nag
from nag.cli import main
from nag.files.json_schema import schema
from nag.numerics.read_only import equal_entries

BENNETT = "cases/bennett.toml"


@cache
def found() -> nag.Decomposition:
    return nag.decompose("(x^2 + y^2 - 1)*(x - y)")


@cache
def solved() -> nag.SolveResult:
    return nag.solve(["x^2 - 2", "y^2 - x"])


RESULTS = {
    "decompose": found,
    "component": lambda: found().components[0],
    "member": lambda: nag.member(found(), [0, 1]),
    "sample": lambda: nag.sample(found()),
    "singular": lambda: nag.singular(found()),
    "singular parameters": lambda: nag.singular("x^2 - a", free="a"),
    "intersect": lambda: nag.intersect(found(), 1, 2),
    "eliminate": lambda: nag.eliminate(["y - x^2", "z - x^3"], "y, z"),
    "certified components": lambda: nag.certify(found()),
    "certified points": lambda: nag.certify(solved()),
    "solve": solved,
    "family": lambda: nag.solve_family(["x^2 = a"], ["a"], [[1], [2]]),
    "local": lambda: nag.local("x^2 - y^3", [0, 0]),
    "real points": lambda: nag.find_real_points(found().components[0]),
    "real curve": lambda: nag.find_real_curve(found().components[0]),
    "mobility": lambda: nag.mobility(BENNETT),
    "motion": lambda: nag.motion(BENNETT),
    "motion of a linkage": lambda: nag.motion("cases/planar/four-bar.toml"),
    "circuit": lambda: nag.motion(BENNETT).circuits[0],
    "driven motion": lambda: nag.driven_motion(BENNETT, "J0", [0.1, 0.2]),
    "modes": lambda: nag.modes("cases/robots/3-rps.toml"),
    "statements": lambda: nag.check_statements("cases/slider-crank.toml"),
    "sweep": lambda: nag.sweep_parameter("cases/rhombus.toml", "b", [1, 2]),
    "assembly modes": lambda: nag.decompose_modes(BENNETT),
    "report": lambda: nag.write_report(BENNETT, Path(gettempdir()) / "nag-report.html"),
    "case": lambda: nag.read(BENNETT),
    "model": lambda: nag.model(BENNETT),
    "problem": lambda: nag.problem(BENNETT),
    "system": lambda: nag.system(["x^2 - sqrt(2)*y", "y - 1"]),
    "solution": lambda: solved()[0],
    "solutions": lambda: solved()[:1],
    "singular set": lambda: nag.singular(found())[0],
    "framework": lambda: nag.Framework.of("ABC", ["AB", "BC", "CA"], [3, 4, "sqrt(2)"]),
    "linkage": lambda: nag.read("cases/planar/four-bar.toml").assembly.linkage,
    "table": lambda: nag.DHLoop.of([{"a": 1, "alpha": "pi/2"}, {"a": 2, "alpha": "pi/6"}] * 2),
    "model of a linkage": lambda: nag.model("cases/planar/four-bar.toml"),
    "mechanism": lambda: nag.read(BENNETT).mechanism,
    "picture": lambda: nag.plot(BENNETT, Path(gettempdir()) / "nag-picture.svg", graph=True),
}
# What holds several things, and of what kind these are.
SEVERAL = {
    "decompose": nag.WitnessSet,
    "intersect": nag.WitnessSet,
    "member": nag.WitnessSet,
    "solve": nag.Solution,
    "solutions": nag.Solution,
    "system": nag.Polynomial,
    "eliminate": str,
    "sample": np.ndarray,
    "family": np.ndarray,
    "real points": np.ndarray,
    "circuit": np.ndarray,
    "singular set": np.ndarray,
    "singular": object,
    "singular parameters": object,
    "real curve": object,
    "motion": object,
    "motion of a linkage": object,
    "driven motion": object,
    "modes": object,
    "statements": object,
    "sweep": object,
    "assembly modes": object,
}
# What is one thing, though it has parts: an answer, or a description.
ONE = {
    "component",
    "certified components",
    "certified points",
    "solution",
    "local",
    "mobility",
    "case",
    "model",
    "problem",
    "framework",
    "linkage",
    "table",
    "model of a linkage",
    "mechanism",
    "picture",
    "report",
}


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_equal_to_themselves_after_a_pickle(name: str) -> None:
    result: Any = RESULTS[name]()
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        assert again == result


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_one_line_at_the_prompt(name: str) -> None:
    text = repr(RESULTS[name]())
    assert len(text) <= 100 and "\n" not in text


def test_what_public_functions_return_is_asked_for_here() -> None:
    """All but results of `find_real_curve` and the like, which are of the same classes."""
    stub = ast.parse((Path(nag.__file__).parent / "__init__.pyi").read_text("utf-8"))
    functions = [node for node in stub.body if isinstance(node, ast.FunctionDef)]
    returned = {ast.unparse(node.returns) for node in functions if node.returns is not None}
    kinds = {name.strip() for text in returned for name in text.split("|")}
    kinds -= {"None", "int", "dict[str, Any]", "SolutionsExport", "AssemblyModel"}
    assert kinds <= {type(result()).__name__ for result in RESULTS.values()}
    assert SEVERAL.keys() | ONE == RESULTS.keys()


@pytest.mark.parametrize("name", SEVERAL)
def test_what_holds_several_things_is_a_sequence_of_them(name: str) -> None:
    result = RESULTS[name]()
    held = list(result)
    assert len(result) == len(held) and bool(result) == bool(held)
    assert all(isinstance(each, SEVERAL[name]) for each in held)
    assert len(result[:1]) == len(held[:1]) and len(result[:0]) == 0
    for k in (0, -1):
        assert equal_entries(result[k], held[k]) and held[k] in result
    with pytest.raises(IndexError):
        result[len(held)]


@pytest.mark.parametrize("name", sorted(ONE))
def test_what_is_one_thing_has_no_length(name: str) -> None:
    assert not hasattr(RESULTS[name](), "__len__")


@pytest.mark.parametrize("name", RESULTS)
def test_what_is_made_of_a_result_for_other_programs_is_as_long(name: str) -> None:
    result = RESULTS[name]()
    if name in SEVERAL:
        converted = {
            "to_numpy": {np.ndarray, nag.Solution},
            "to_sympy": {nag.Solution, nag.Polynomial},
            "to_dataframe": {nag.WitnessSet, nag.Solution, object},
        }
        for method, kinds in converted.items():
            if SEVERAL[name] in kinds and name not in ("solutions",):
                assert hasattr(result, method), method
    if hasattr(result, "to_numpy"):
        array = result.to_numpy()
        assert array.flags.writeable and (name not in SEVERAL or len(array) == len(result))
    if hasattr(result, "to_sympy") and not isinstance(result, nag.Solution):
        held = result if name in SEVERAL else result.to_numpy()
        assert len(result.to_sympy()) == len(held)
    if hasattr(result, "to_dataframe"):
        assert list(result.to_dataframe().columns)


def arrays_in(value: Any, seen: set[int]) -> Iterator[np.ndarray]:
    """Arrays that a result holds, at any depth."""
    if id(value) in seen:
        return
    seen.add(id(value))
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from arrays_in(item, seen)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from arrays_in(item, seen)
    elif is_dataclass(value):
        for each in fields(value):
            if not each.name.startswith("_"):
                yield from arrays_in(getattr(value, each.name), seen)


@pytest.mark.parametrize("name", RESULTS)
def test_no_array_of_a_result_can_be_made_writeable(name: str) -> None:
    for array in arrays_in(RESULTS[name](), set()):
        with pytest.raises(ValueError, match="WRITEABLE"):
            array.setflags(write=True)


@pytest.mark.parametrize("name", ["solve", "sample", "decompose", "family", "real points"])
def test_nor_after_a_pickle_or_a_copy(name: str) -> None:
    result = RESULTS[name]()
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        part = again[0] if name == "decompose" else again
        with pytest.raises(ValueError, match="WRITEABLE"):
            part.points.setflags(write=True)


def test_tables_of_solutions_are_put_together() -> None:
    first, last = solved()[:1], solved()[1:]
    assert first + last == solved().solutions
    with pytest.raises(
        nag.NagError, match="the solutions do not go together: they are in x, y, and in x"
    ):
        first + nag.solve("x^2 - 2")[:1]


def test_the_imaginary_unit_is_no_coordinate_elsewhere() -> None:
    gaussian = nag.solve("x^2 + I", imaginary="I")
    assert gaussian.to_numpy().shape == (2, 1)
    assert [[str(symbol) for symbol in point] for point in gaussian.to_sympy()] == [["x"], ["x"]]
    assert nag.sample(nag.system("x*(y - I)", imaginary="I"), count=2).to_numpy().shape == (2, 2)


def incomplete() -> dict[str, Any]:
    """Results that are not complete, by how their line begins."""
    told: dict[str, Any] = {}
    patch = pytest.MonkeyPatch()
    patch.setattr("nag.tracking.run.time", SimpleNamespace(monotonic=lambda: 0.0))
    patch.setattr("nag.tracking.run.BETWEEN", 0.0)

    def tell(answer: Any) -> None:
        told[type(answer).__name__] = answer

    nag.decompose(["(x^2 + y^2 - 4)*(x*y - z)", "(x - y)*(x^3 + y*z - 1)"], found=tell)
    nag.solve(["x^2 + y^2 + z^2 - 9", "x*y*z - z^2 + 1", "x^2 + y*z^2 - 3"], found=tell)
    nag.mobility(BENNETT, found=tell)
    nag.motion(BENNETT, found=tell)
    nag.driven_motion(BENNETT, "J0", [0.1, 0.2], found=tell)
    nag.modes("cases/robots/3-rps.toml", found=tell)
    patch.undo()
    family = nag.solve_family(["x^2 = a"], ["a"], [[1], [2]])
    others = [
        replace(family, complete=np.array([True, False])),
        replace(nag.sample(found()), doubt="a point may be missing"),
        replace(nag.eliminate(["y - x^2", "z - x^3"], "y, z"), note="a degree is missing"),
        replace(nag.singular(found()), complete=False),
    ]
    return told | {type(each).__name__: each for each in others}


def test_results_that_are_incomplete_say_so_in_one_line_at_the_prompt() -> None:
    results = incomplete()
    assert {*results} >= {"Decomposition", "SolveResult", "MobilityReport", "Motion"}
    assert {*results} >= {"DrivenMotion", "OperationModes", "FamilySolutions", "ImageIdeal"}
    for name, result in results.items():
        text = repr(result)
        assert text.startswith(f"<{name} (INCOMPLETE)") and len(text) <= 100 and "\n" not in text
    for name in sorted(RESULTS):
        assert "INCOMPLETE" not in repr(RESULTS[name]())


def test_a_component_alone_answers_what_a_decomposition_does() -> None:
    line = next(c for c in found().components if c.degree == 1)
    assert nag.sample(line, count=3).points.shape == (3, 2)
    assert len(nag.member(line, [2, 2]).on) == 1 and not nag.member(line, [1, 0]).on
    for ask in (nag.find_real_curve, nag.find_real_points):
        with pytest.raises(nag.NagError, match=r"component: which one\? 1 and 2 .*; give the num"):
            ask(found())


# Answers of which files have what the commands write, and are not read back as what they are.
WRITTEN = {
    "member": "nag-membership",
    "eliminate": "nag-elimination",
    "certified components": "nag-certificate",
    "certified points": "nag-certificate",
    "family": "nag-family",
    "local": "nag-local-dimension",
    "real curve": "nag-real-curve",
    "mobility": "nag-mobility",
    "motion": "nag-motion",
    "motion of a linkage": "nag-motion",
    "driven motion": "nag-driven-motion",
    "modes": "nag-operation-modes",
    "statements": "nag-statements",
    "sweep": "nag-sweep",
    "assembly modes": "nag-modes",
}


@pytest.mark.parametrize("name", WRITTEN)
def test_answers_are_written_as_the_commands_write_them(name: str, tmp_path: Path) -> None:
    result = RESULTS[name]()
    nag.write(result, tmp_path / "answer.json")
    again = nag.read(tmp_path / "answer.json")
    assert isinstance(again, dict) and again["format"] == WRITTEN[name]
    assert not set(again) - set(schema(WRITTEN[name])["properties"])
    below = json.loads(json.dumps(result.document()))
    if name != "local":
        assert {key: again[key] for key in below} == below
    assert main(["show", str(tmp_path / "answer.json")]) == 0


def test_what_is_written_is_what_the_command_writes_but_for_the_run(tmp_path: Path) -> None:
    one, other = tmp_path / "one.json", tmp_path / "other.json"
    assert main(["mobility", BENNETT, "--json", str(one), "--quiet"]) == 0
    nag.write(nag.mobility(BENNETT), other)
    given, again = (json.loads(file.read_text()) for file in (one, other))
    unknown = {"case", "seed", "settings", "budget", "configuration", "known"}
    assert given.keys() == again.keys()
    assert {key for key in given if given[key] != again[key]} <= unknown


def test_every_answer_says_whether_it_is_complete() -> None:
    parts = {"component", "circuit", "solution", "solutions", "singular set", "case", "model"}
    parts |= {"problem", "system", "framework", "linkage", "table", "model of a linkage"}
    for name in RESULTS.keys() - parts - {"mechanism"}:
        complete: Any = RESULTS[name]().complete
        assert complete is True or complete.all() or name == "real points", name
    assert RESULTS["sweep"]()[0].complete and len(repr(RESULTS["sweep"]()[0])) < 80


@pytest.mark.parametrize("name", RESULTS)
def test_what_cannot_be_hashed_says_so(name: str) -> None:
    result = RESULTS[name]()
    try:
        hash(result)
    except TypeError as error:
        assert str(error) == f"unhashable type: {type(result).__name__!r}"
        assert not isinstance(result, Hashable)
