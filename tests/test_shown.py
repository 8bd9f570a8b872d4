"""What results show at the prompt and in notebooks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import nag
from nag.decomposition import real_points_near, sample
from nag.text.table import LINE, html_table


def bennett() -> Any:
    return nag.read_case("cases/bennett.toml").mechanism


def circle() -> Any:
    return nag.decompose("x^2 + y^2 = 1").components[0]


def crowd() -> Any:
    names = [f"x{i}" for i in range(40)]
    return nag.system([f"{name}^2 - {i}" for i, name in enumerate(names)])


SHOWN: dict[str, Callable[[], Any]] = {
    "system": lambda: nag.system(["x^2 + y^2 = 1"]),
    "large system": crowd,
    "mechanism": bennett,
    "larger mechanism": lambda: nag.read_case("cases/bricard-cube.toml").mechanism,
    "model": lambda: nag.model(bennett()),
    "decomposition": lambda: nag.decompose(bennett()),
    "no component": lambda: nag.decompose(["x*y - 1", "x"]),
    "solutions": lambda: nag.solve(["x^2 + y^2 - 1", "x - y"]),
    "samples": lambda: sample(circle().system, circle(), 3),
    "no samples": lambda: sample(circle().system, circle(), 0),
    "projection": lambda: circle().project(["x"]),
    "real points": lambda: real_points_near(circle().system, circle(), np.array([3.0, 0.0])),
    "no real points": lambda: real_points_near(
        (c := nag.decompose("x^2 + y^2 + 1 = 0").components[0]).system, c, np.zeros(2), starts=3
    ),
    "local dimension": lambda: nag.local_dimension(nag.system("x^3 = y^2"), (0, 0)),
    "isolated": lambda: nag.local_dimension(nag.system(["x^3 = y^2", "x*y"]), (0, 0)),
    "no local dimension": lambda: nag.local_dimension(nag.system("x^3 = y^2"), (1.0, 2.0)),
    "configuration": lambda: nag.model(bennett()).lift((0, 0)),
    "configuration in doubles": lambda: nag.model(bennett()).lift((0.25, 0.125j)),
    "larger configuration": lambda: (
        model := nag.model(nag.read_case("cases/bricard-cube.toml").mechanism)
    ).lift(model.reference),
    "no solution": lambda: nag.solve(["x*y - 1", "x"]),
}


@pytest.mark.parametrize("name", SHOWN)
def test_one_line_at_the_prompt_and_at_most_five_where_printed(name: str) -> None:
    shown = SHOWN[name]()
    assert len(repr(shown)) <= LINE and "\n" not in repr(shown)
    lines = str(shown).splitlines()
    assert 2 <= len(lines) <= 5
    assert max(map(len, lines)) <= LINE


def test_components_and_solutions_are_one_line_in_lists_and_five_by_themselves() -> None:
    for item in (
        nag.decompose("x^2 + y^2 = 1").components[0],
        nag.solve("x^2 = 2").solutions[0],
    ):
        assert len(repr(item).splitlines()) == 1
        assert len(str(item).splitlines()) == 5


def test_a_decomposition_says_what_it_rests_on() -> None:
    answer = nag.decompose(["(x^2 + y^2 - 1)^2"], seed=3)
    rows = dict(line.strip().split("  ", 1) for line in str(answer).splitlines()[1:])
    rows = {label: text.strip() for label, text in rows.items()}
    assert rows["answer"] == "1 component of dimension 1, degree 2, multiplicity 2"
    assert rows["status"] == "complete"
    assert rows["rests on"].startswith("residual ")
    assert rows["run"].startswith("seed 3, settings default; paths: ")
    left = replace(answer, complete=False, notes=("2 paths failed", "another doubt"))
    assert "status    INCOMPLETE: 2 paths failed (and 1 more)" in str(left)


class Table(HTMLParser):
    """The cells of each row, and that every tag is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.rows: list[list[str]] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        assert attrs == []
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open[-1] in ("td", "th"):
            self.rows[-1].append(data)


def test_a_notebook_shows_a_row_for_each_kind_of_component() -> None:
    rows = Table(nag.decompose(["(x^2 + y^2 - 1)*(x - y)*(x + y)"])._repr_html_()).rows
    assert rows[0][:5] == ["number", "dimension", "degree", "multiplicity", "count"]
    assert [row[:5] for row in rows[1:]] == [["1-2", "1", "1", "1", "2"], ["3", "1", "2", "1", "1"]]


def test_a_notebook_shows_a_row_for_each_solution_joint_point_and_equation() -> None:
    solutions = Table(nag.solve(["x^2 - 4", "y - x"])._repr_html_()).rows
    assert solutions[0][1:3] == ["x", "y"]
    assert sorted(row[1:3] for row in solutions[1:]) == [["-2", "-2"], ["2", "2"]]
    joints = Table(bennett()._repr_html_()).rows
    assert [row[0] for row in joints] == ["joint", *(j.name for j in bennett().joints)]
    points = Table(nag.decompose("x^2 + y^2 = 1").components[0]._repr_html_()).rows
    assert [row[0] for row in points] == ["point", "1", "2"]
    assert points[0][1:] == ["x", "y", "error"]
    assert all(0 < float(row[-1]) < 1e-15 for row in points[1:])
    equations = Table(nag.system(["x = 1", "x*y = 2"])._repr_html_()).rows
    assert equations[1:] == [["1", "1", "x - 1"], ["2", "2", "x*y - 2"]]


def test_a_notebook_shows_a_row_for_each_point_and_body() -> None:
    one = circle()
    points = Table(sample(one.system, one, 3)._repr_html_()).rows
    assert [row[0] for row in points] == ["point", "1", "2", "3"]
    near = Table(real_points_near(one.system, one, np.array([3.0, 0.0]))._repr_html_()).rows
    assert near[0] == ["point", "x0", "x1", "distance", "stationary"]
    assert near[1][3:] == ["2", "yes"]
    image = Table(one.project(["x"])._repr_html_()).rows
    assert len(image) == 1 + 2
    bodies = Table(nag.model(bennett()).lift((0, 0))._repr_html_()).rows
    assert [row[0] for row in bodies] == ["body", *bennett().body_names]


def test_what_there_is_of_points_is_said() -> None:
    one = circle()
    text = str(real_points_near(one.system, one, np.array([3.0, 0.0])))
    assert text.startswith("RealPoints: ") and "nearest at distance 2\n" in text
    assert "dimension 1, degree 1" in str(one.project(["x"]))
    assert "isolated, of multiplicity 5" in str(SHOWN["isolated"]())
    assert "undecided" in str(SHOWN["no local dimension"]())
    assert "no real zero" in str(SHOWN["no real points"]())


def test_what_is_shown_in_a_notebook_is_escaped() -> None:
    text = html_table("<b>", [["<script>", "a"], ["&", "\x1b[2J"]], "<i>")
    assert "<script>" not in text and "<b>" not in text and "<i>" not in text
    assert "\x1b" not in text
    assert Table(text).rows == [["<script>", "a"], ["&", "\\x1b[2J"]]
