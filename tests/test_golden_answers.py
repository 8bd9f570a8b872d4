"""Kept answers are compared as answers: what is found counts, not its order or its last digits."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from golden_answers import Grade, Question, ask, compare_answers

import nag
from nag.files.export import export_text
from nag.files.solutions_export import export_text as solutions_text

# Two conics and a line.
CURVES = "(x^2 + y^2 - 1)*(x^2 + 2*y^2 - 3)*(x - 2*y + 3) = 0"
Document = dict[str, Any]


@pytest.fixture(scope="module")
def curves() -> str:
    return export_text(nag.decompose(CURVES, seed=1, threads=1))


@pytest.fixture(scope="module")
def zeros() -> str:
    return solutions_text(nag.solve(["x^2 = 2", "y^2 = x + 5"], seed=1, threads=1))


def _grade(folder: Path, export: str, change: Callable[[Document], None] | None = None) -> Grade:
    """How an answer compares with itself after a change of its export."""
    changed = json.loads(export)
    if change is not None:
        change(changed)
    for name, text in (("a", export), ("b", export if change is None else json.dumps(changed))):
        (folder / f"{name}.json").write_text(text)
        (folder / f"{name}.txt").write_text("nag ask\nexit status 0\n\nanswer  as it is\n")
    return compare_answers(folder / "a", folder / "b")[0]


def _moved(point: list[list[float]], far: float) -> None:
    point[0][0] += far


def test_the_same_bytes_are_told_from_the_same_answer(tmp_path: Path, curves: str) -> None:
    assert _grade(tmp_path, curves) is Grade.BYTES
    assert _grade(tmp_path, curves, lambda d: d["components"].reverse()) is Grade.SAME


def test_order_and_last_digits_of_points_are_no_part_of_an_answer(
    tmp_path: Path, curves: str, zeros: str
) -> None:
    def turn(document: Document) -> None:
        for component in document["components"]:
            for key in ("points", "radii", "digits"):
                component[key].reverse()
            _moved(component["points"][0], component["radii"][0][0])

    assert _grade(tmp_path, curves, turn) is Grade.SAME
    assert _grade(tmp_path, zeros, lambda d: d["solutions"].reverse()) is Grade.SAME


@pytest.mark.parametrize("key", ["degree", "dimension", "multiplicity", "status"])
def test_what_is_said_of_a_component_is_compared(tmp_path: Path, curves: str, key: str) -> None:
    def change(document: Document) -> None:
        document["components"][0][key] = "undecided" if key == "status" else 7

    assert _grade(tmp_path, curves, change) is Grade.OTHER


def test_a_point_that_moved_further_than_its_radii_is_another(
    tmp_path: Path, curves: str, zeros: str
) -> None:
    def change(document: Document) -> None:
        _moved(document["components"][0]["points"][0], 1e-9)

    assert _grade(tmp_path, curves, change) is Grade.OTHER
    far = _grade(tmp_path, zeros, lambda d: _moved(d["solutions"][0]["point"], 1e-9))
    assert far is Grade.OTHER


def test_points_that_change_their_components_are_no_same_answer(
    tmp_path: Path, curves: str
) -> None:
    def swap(document: Document) -> None:
        one, other = (c for c in document["components"] if c["degree"] == 2)
        for key in ("points", "radii", "digits"):
            one[key][0], other[key][0] = other[key][0], one[key][0]

    assert _grade(tmp_path, curves, swap) is Grade.OTHER


def test_points_on_other_slices_are_not_compared(tmp_path: Path, curves: str) -> None:
    other = json.loads(export_text(nag.decompose(CURVES, seed=2, threads=1))) | {"seed": 1}
    grade = _grade(tmp_path, curves, lambda document: document.update(other))
    assert grade is Grade.ELSEWHERE


def test_a_lost_solution_and_another_text_are_told(tmp_path: Path, zeros: str) -> None:
    assert _grade(tmp_path, zeros, lambda d: d["solutions"].pop()) is Grade.OTHER
    assert _grade(tmp_path, zeros) is Grade.BYTES
    text = (tmp_path / "b.txt").read_text()
    (tmp_path / "b.txt").write_text(text.replace("as it is", "as it was"))
    assert compare_answers(tmp_path / "a", tmp_path / "b")[0] is Grade.OTHER
    (tmp_path / "b.txt").write_text("slow: more than 2 s of processor time\n")
    assert compare_answers(tmp_path / "a", tmp_path / "b")[0] is Grade.SLOW


def test_an_answer_is_kept_without_times_and_folders(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    case = "literature/sphere-and-cubic"
    kept = []
    for name in ("first", "second"):
        target = tmp_path / name / "decompose.0"
        words = ("decompose", f"cases/{case}.toml", "--threads", "1", "--quiet")
        text = ask(Question(case, "decompose", words, 0, True, target))
        kept.append((text, Path(f"{target}.json").read_bytes()))
    assert kept[0] == kept[1]
    assert kept[0][0].splitlines()[1] == "exit status 0"
    assert str(tmp_path) not in kept[0][0]
