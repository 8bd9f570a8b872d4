"""Parts that are made in Python lead on: solved, moved and drawn as a case of theirs is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import networkx
import numpy as np
import pytest

import nag

DIAMOND = [("A", "B"), ("B", "C"), ("C", "D"), ("D", "A")]
TWIST, OTHER = {"a": "5/3", "alpha": "pi/2"}, {"a": "5/6", "alpha": "pi/6"}


def graph_of_bars(bars: list[tuple[str, str]], **lengths: Any) -> networkx.Graph:
    graph = networkx.Graph()
    for first, second in bars:
        graph.add_edge(first, second, length=lengths.get(first + second, 1))
    return graph


def test_a_graph_of_bars_goes_straight_into_every_question(tmp_path: Path) -> None:
    rhombus = nag.framework_of_graph(graph_of_bars(DIAMOND))
    assert nag.mobility(rhombus).local_dimension == 1
    kinds = [(c.dimension, c.degree) for c in nag.decompose(rhombus)]
    assert kinds and all(dimension == 1 for dimension, _ in kinds)
    found = nag.motion(rhombus, circuit="all", samples=24)
    assert found.circuits
    picture = nag.plot(rhombus, tmp_path / "path.svg", point="C", circuit="all")
    assert picture.rows[0][0] == "circuit 1"
    assert (tmp_path / "path.svg").read_text().startswith("<?xml")
    braced = nag.framework_of_graph(graph_of_bars([*DIAMOND, ("A", "C")]))
    assert len(nag.solve(braced)) == 4


@pytest.mark.parametrize("number", [1, 1.0, "1", np.float64(1), np.int64(1)])
def test_lengths_are_numbers_of_any_kind(number: Any) -> None:
    bars = graph_of_bars([("A", "B"), ("B", "C"), ("C", "A")], AB=number)
    assert nag.framework_of_graph(bars).squared_lengths == (1, 1, 1)
    assert nag.Framework.of("ABC", ["AB", "BC", "CA"], [number, 1, 1]).squared_lengths[0] == 1
    link = nag.Linkage.of({"base": ("A", "B", number), "rod": "AB1"}, "base").links[0]
    assert link.shape == ((0, 0), (1, 0))
    assert nag.DHLoop.of([{"a": number, "alpha": 0}] * 3).rows[0].a == 1


def test_constructors_make_what_cases_say() -> None:
    case = nag.read_case("cases/planar/four-bar.toml")
    made = nag.Linkage.of(
        {
            link.name: dict(zip(link.pins, link.shape, strict=True))
            for link in case.assembly.linkage.links
        },
        case.assembly.linkage.ground,
    )
    assert made == case.assembly.linkage
    assert nag.solve(made) == nag.solve(case.assembly)


def test_points_may_have_places() -> None:
    square = {"A": (0, 0), "B": (1, 0), "C": (1, 1), "D": (0, 1)}
    assert nag.mobility(nag.Framework.of(square, DIAMOND)).local_dimension == 1
    braced = nag.Framework.of(square, [*DIAMOND, "AC"])
    assert nag.mobility(braced).local_dimension == 0


def test_a_table_is_a_mechanism_where_all_angles_are_given() -> None:
    open_ = nag.DHLoop.of([TWIST, OTHER] * 2)
    assert open_.open == (0, 1, 2, 3)
    assert nag.mobility(open_).local_dimension == 1
    flat = [{"a": 1, "alpha": 0, "theta": "2*pi/3"}] * 3
    assert nag.mobility(nag.DHLoop.of(flat)).local_dimension == 0


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: nag.Framework.of("AB", ["AB"], []), "0 are given for 1 bars"),
        (
            lambda: nag.Framework.of("AB", ["AB"], [-1]),
            "lengths: that of A-B, -1, is not positive; a",
        ),
        (lambda: nag.Framework.of({"A": (0,), "B": (1, 0)}, ["AB"]), "'A' has 1 coordinates"),
        (lambda: nag.Framework.of("AB", ["AB"], ["x"]), r"lengths\[0\]: column 1"),
        (lambda: nag.Linkage.of({"a": ("A", "B")}, "a"), "give .* places of pins by name"),
        (
            lambda: nag.Linkage.of({"a": ("A", "B", 0)}, "a"),
            "link 'a': length: 0 is not positive; a link",
        ),
        (lambda: nag.Linkage.of(None, None), "links: None is given; give a dict by name"),
        (lambda: nag.Framework.of("AB", [("A", "B", 1)]), r"bars\[0\]: .* give a pair of points"),
        (lambda: nag.framework_of_graph("x"), "graph: 'x' is given; give a networkx graph"),
        (lambda: nag.framework_of_graph(None), "graph: None is given; give a networkx graph"),
        (lambda: nag.framework_of_graph(networkx.Graph()), "points: none are given"),
        (lambda: nag.DHLoop.of(None), "rows: None is given"),
        (lambda: nag.DHLoop.of([{"a": 1}] * 3), "row 1: alpha: is missing; give the link's twist"),
        (
            lambda: nag.Framework.of({"A": (0, 0, 0), "B": (1, 0, 0)}, ["AB"]),
            "'A' has 3 coordinates; give 2, or dimension=3",
        ),
        (lambda: nag.DHLoop.of([{"beta": 1}] * 3), "unknown key"),
        (lambda: nag.DHLoop.of([1, 2, 3]), "give a mapping"),
        (lambda: nag.solve(networkx.path_graph(3)), "nag.framework_of_graph"),
    ],
)
def test_what_makes_no_sense_is_one_line(make: Any, said: str) -> None:
    with pytest.raises(nag.NagError, match=said) as raised:
        make()
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("given", "options", "said"),
    [
        ("cases/bennett.toml", {}, "say what to draw, one of onto, joints"),
        ("cases/bennett.toml", {"graph": True, "tree": True}, "give one of onto"),
        ("cases/bennett.toml", {"onto": "x_J1, x_J9"}, "onto: 'x_J9' is not one of"),
        ("cases/bennett.toml", {"joints": "J1, J9"}, "joints: 'J9' is no joint"),
        ("cases/bennett.toml", {"graph": True, "component": 1}, "component: is for onto"),
        ("cases/slider-crank.toml", {"graph": True}, "graph: is for mechanisms"),
        ("x^2 + y^2 - 1", {"onto": "x, y", "component": 2}, "there is one component"),
        ("x^2 + y^2 + 1", {"onto": "x, y"}, "no component of dimension 1 has real points"),
    ],
)
def test_what_cannot_be_drawn_is_one_line(
    given: str, options: dict[str, Any], said: str, tmp_path: Path
) -> None:
    with pytest.raises(nag.NagError, match=said):
        nag.plot(given, tmp_path / "picture.svg", **options)
    assert not (tmp_path / "picture.svg").exists()


def test_a_picture_says_what_is_in_it(tmp_path: Path) -> None:
    path = tmp_path / "curve.svg"
    drawn = nag.plot("(x^2 + y^2 - 1)*(x - 2)", path, onto=["x", "y"])
    assert drawn.complete
    assert [label for label, _ in drawn.rows] == ["component 1", "component 2"]
    assert str(drawn).endswith(f"picture      {path}")
    with pytest.raises(nag.NagError, match=r"ends in \.svg"):
        nag.plot("x^2 + y^2 - 1", tmp_path / "curve.gif", onto="x, y")


PARTS = {
    "linkage": nag.read_case("cases/planar/four-bar.toml").assembly.linkage,
    "framework": nag.Framework.of({"A": (0, 0), "B": (1, 0), "C": (0, 1)}, ["AB", "BC"]),
    "table": nag.DHLoop.of([TWIST, OTHER] * 2),
}


@pytest.mark.parametrize("kind", PARTS)
def test_parts_have_a_model(kind: str) -> None:
    made = nag.model(PARTS[kind])
    assert len(repr(made).splitlines()) == 1 and len(str(made).splitlines()) <= 6
    assert nag.decompose(made) == nag.decompose(PARTS[kind])


def test_files_of_parts_have_their_model() -> None:
    assert nag.model("cases/planar/four-bar.toml") == nag.model(PARTS["linkage"])
    assert [nag.model(PARTS["table"], f).system.n for f in "HE"] == [2, 8]


@pytest.mark.parametrize(
    ("kind", "options", "said"),
    [
        ("framework", {"formulation": "E"}, "formulation E: is for mechanisms and tables"),
        ("table", {"formulation": "Q"}, "formulation Q: a table has formulations H and E"),
        ("linkage", {"space": "planar"}, "space: is for a nag.Mechanism, not for parts"),
        ("linkage", {"modes": [("A", 1)]}, "modes: is for a nag.Mechanism, not for parts"),
    ],
)
def test_what_parts_have_no_model_in_is_said(kind: str, options: dict[str, Any], said: str) -> None:
    with pytest.raises(nag.NagError, match=said):
        nag.model(PARTS[kind], **options)


def test_answers_are_sequences() -> None:
    solutions = nag.solve("x^2 - 2")
    assert [solutions.index(s) for s in solutions] == [0, 1]
    assert solutions.count(solutions[1]) == 1 and solutions[0] in solutions
    components = nag.decompose("(x^2 + y^2 - 1)*(x - y)")
    assert [components.index(c) for c in components] == [0, 1]
    assert list(reversed(components)) == [components[1], components[0]]
