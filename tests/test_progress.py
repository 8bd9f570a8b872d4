"""Where Python is used, progress is shown where someone reads it."""

from __future__ import annotations

import sys
from dataclasses import replace
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

import nag
from nag.text.progress_line import progress_line
from nag.tracking.settings import find_settings


class Output:
    """What a notebook shows of a cell's output."""

    def __init__(self) -> None:
        self.texts: list[str] = []

    def update(self, shown: dict[str, str], raw: bool) -> None:
        assert raw
        self.texts.append(shown["text/plain"])


@pytest.fixture
def notebook(monkeypatch: pytest.MonkeyPatch) -> list[Output]:
    """The outputs of a cell in a notebook."""
    outputs: list[Output] = []

    def display(shown: dict[str, str], raw: bool, display_id: bool) -> Output:
        assert display_id
        outputs.append(Output())
        outputs[-1].update(shown, raw)
        return outputs[-1]

    python, shown = ModuleType("IPython"), ModuleType("IPython.display")
    python.get_ipython = lambda: SimpleNamespace(kernel=object())  # type: ignore[attr-defined]
    shown.display = display  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "IPython", python)
    monkeypatch.setitem(sys.modules, "IPython.display", shown)
    return outputs


def test_a_notebook_shows_one_line_that_changes_and_is_empty_at_the_end(
    notebook: list[Output], monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    monkeypatch.setattr("nag.text.progress_line.time.monotonic", lambda: now[0])
    with progress_line() as line:
        assert line is not None
        for step, now[0] in ((1, 1.0), (2, 2.0)):
            line("tracking 4 paths", step, 4)
    (output,) = notebook
    assert [text[:40] for text in output.texts] == [
        "[#####---------------] 25 % tracking 4 p",
        "[##########----------] 50 % tracking 4 p",
        "",
    ]


def test_a_call_shows_its_progress_and_its_answer_does_not_depend_on_that(
    notebook: list[Output], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("nag.text.progress_line.INTERVAL", 0.0)
    equations = ["x^2 + y^2 - 3", "x*y^3 - 1"]
    shown = nag.solve(equations, seed=1, start="total", progress=True)
    assert shown == nag.solve(equations, seed=1, start="total")
    assert any("tracking 8 paths: 8 of 8" in text for text in notebook[0].texts)
    assert notebook[0].texts[-1] == ""


def test_ends_in_more_digits_are_counted_those_at_infinity_and_failures_by_themselves() -> None:
    told: list[tuple[str, int, int]] = []
    few = replace(find_settings("fast"), digits=32)
    found = nag.solve(
        ["x^9*y^2 - y - 1", "x^7*y^9 + x^2"],
        start="total",
        settings=few,
        progress=lambda *step: told.append(step),
    )
    stages = [step for step in told if step[0].startswith("ends of ")]
    assert [step[1] for step in stages] == sorted(step[1] for step in stages)
    ends = found.paths
    assert ends.at_infinity > 0 and ends.failed > 0
    remark = f"{ends.at_infinity} to infinity, {ends.failed} failed"
    count = ends.at_infinity + ends.failed
    assert stages[-1] == (f"ends of {count} paths in more digits; {remark}", count, count)


@pytest.mark.parametrize("given", [False, "bar", 1])
def test_what_is_no_progress_is_refused(given: Any) -> None:
    with pytest.raises(nag.NagError, match=r"progress: .*give True for a bar"):
        nag.solve(["x - 1"], progress=given)
