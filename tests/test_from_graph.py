"""Mechanisms from networkx graphs and back."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx
import pytest

import nag
from nag.errors import MechanismError
from nag.mechanism.graph import Body

CASES = Path(__file__).parent.parent / "cases"
MECHANISMS = [
    path
    for path in sorted(CASES.rglob("*.toml"))
    if 'kind = "mechanism"' in path.read_text("utf-8")
]


def revolute(graph: nx.Graph, u: Any, v: Any, point: Any, **more: Any) -> None:
    graph.add_edge(u, v, type="revolute", axis=(0, 0, 1), point=point, **more)


def parallelogram(graph: nx.Graph) -> nx.Graph:
    revolute(graph, "base", "left", (0, 0, 0))
    revolute(graph, "left", "top", (0, 1, 0))
    revolute(graph, "top", "right", (2, 1, 0))
    revolute(graph, "right", "base", (2, 0, 0))
    return graph


@pytest.mark.parametrize("path", MECHANISMS, ids=lambda path: path.stem)
def test_a_mechanism_comes_back_from_its_graph(path: Path) -> None:
    mechanism = nag.read_case(path).mechanism
    again = nag.Mechanism.from_graph(mechanism.to_graph())
    assert (again.ground, again.joints) == (mechanism.ground, mechanism.joints)
    assert again.bodies == tuple(b for b in mechanism.bodies if b.orientation is not None)


@pytest.mark.parametrize("kind", [nx.Graph, nx.DiGraph, nx.MultiGraph, nx.MultiDiGraph])
def test_every_kind_of_graph_will_do(kind: Any) -> None:
    mechanism = nag.Mechanism.from_graph(parallelogram(kind()), ground="base")
    ends = {frozenset(j.bodies) for j in mechanism.joints}
    assert ends == {
        frozenset(p)
        for p in ({"base", "left"}, {"left", "top"}, {"top", "right"}, {"right", "base"})
    }
    answer = nag.decompose(mechanism)
    assert [(c.dimension, c.degree) for c in answer.components] == [(1, 2), (1, 2)]


def test_ten_lines_lead_from_a_graph_to_points_of_a_curve() -> None:
    answer = nag.decompose(nag.Mechanism.from_graph(parallelogram(nx.MultiGraph()), ground="base"))
    curve = answer.components[0]
    points = curve.sample(1, 3)
    assert points.shape == (3, answer.system.n)
    assert all(curve.contains(point) for point in points)
    assert not curve.contains(answer.components[1].points[0])
    assert curve.project([0, 1]).dimension == 1


def test_numbers_on_edges_and_nodes_are_exact() -> None:
    graph = nx.MultiGraph(ground=0)
    revolute(graph, 0, 1, (0.1, "1/3", Fraction(2)), name="A")
    graph.nodes[1]["orientation"] = (0.6, 0, 0, 0.8)
    mechanism = nag.Mechanism.from_graph(graph)
    assert mechanism.joints[0].point == (Fraction(1, 10), Fraction(1, 3), Fraction(2))
    assert mechanism.bodies == (
        Body("1", (Fraction(3, 5), Fraction(0), Fraction(0), Fraction(4, 5))),
    )


def test_joints_of_other_types_have_the_attributes_that_they_need() -> None:
    graph = nx.MultiGraph()
    graph.add_edge("a", "b", "S", type="spherical", point=(1, 2, 3))
    graph.add_edge("b", "c", "P", type="translational", axis=(1, 0, 0))
    graph.add_edge(
        "c",
        "a",
        "U",
        type="universal",
        point=(0, 0, 0),
        axis=(1, 0, 0),
        second_axis=(0, 1, 0),
        bodies=("a", "c"),
    )
    mechanism = nag.Mechanism.from_graph(graph, ground="a")
    joints = {joint.name: joint for joint in mechanism.joints}
    assert (joints["S"].type, joints["S"].axis) == ("spherical", None)
    assert (joints["P"].type, joints["P"].axis) == ("prismatic", (1, 0, 0))
    assert (joints["U"].bodies, joints["U"].second_axis) == (("a", "c"), (0, 1, 0))
    assert nag.Mechanism.from_graph(mechanism.to_graph()) == mechanism


def test_parallel_edges_have_names_of_their_own() -> None:
    graph = nx.MultiGraph()
    revolute(graph, "a", "b", (0, 0, 0))
    revolute(graph, "a", "b", (0, 0, 1))
    names = [j.name for j in nag.Mechanism.from_graph(graph, "a").joints]
    assert names == ["a_b", "a_b_1"]


def test_attributes_of_other_programs_are_left_alone() -> None:
    graph = parallelogram(nx.MultiGraph())
    nx.set_edge_attributes(graph, 3.0, "weight")
    nx.set_node_attributes(graph, "red", "color")
    assert len(nag.Mechanism.from_graph(graph, "base").joints) == 4


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda g, e: e.pop("point"),
            "joint 'base_left': point: the edge base - left has no point",
        ),
        (lambda g, e: e.update(type="screw"), "joint 'base_left': type: a helical joint is not"),
        (lambda g, e: e.update(type=1), "joint 'base_left': type: joint type 1 is unknown"),
        (
            lambda g, e: e.update(type="spherical"),
            "joint 'base_left': axis: a spherical joint has no axis; leave it out",
        ),
        (
            lambda g, e: e.update(type="universal", second_axis=(1, 0, 0)),
            r"joint 'base_left': bodies: each axis belongs .* bodies=\('base', 'left'\)",
        ),
        (lambda g, e: e.pop("type"), "joint 'base_left': type: the edge base - left has no type"),
        (
            lambda g, e: e.update(axis=(0, 0, 0)),
            "joint 'base_left': axis: the axis has length zero",
        ),
        (lambda g, e: e.update(axis=(0, 1)), "joint 'base_left': axis: axis has 2 coordinates"),
        (lambda g, e: e.update(point=(0, "x", 0)), r"joint 'base_left': point: coordinates\[1\]: "),
        (lambda g, e: e.update(point=3), "joint 'base_left': point: .* give a sequence"),
        (lambda g, e: e.update(axsi=e.pop("axis")), r"'axsi' \(did you mean 'axis'\?\)"),
        (
            lambda g, e: e.update(bodies=("base", "top")),
            "joint 'base_left': bodies: .*its ends are",
        ),
        (lambda g, e: g.add_node("spare"), "body 'spare': body 'spare' has no joint"),
        (lambda g, e: g.graph.update(ground="floor"), "ground: ground 'floor' is not a body"),
        (lambda g, e: g.graph.clear(), "ground: is missing|is missing; name the fixed body"),
        (lambda g, e: g.nodes["top"].update(orientation=(1, 1, 0, 0)), "body 'top': orientation: "),
        (
            lambda g, e: revolute(g, "left", "top", (0, 0, 0), name="left_top"),
            "two joints are named",
        ),
    ],
)
def test_errors_say_which_joint_or_body_and_what_would_be_right(change: Any, message: str) -> None:
    graph = parallelogram(nx.MultiGraph(ground="base"))
    change(graph, graph.edges["base", "left", 0])
    with pytest.raises(MechanismError, match=message):
        nag.Mechanism.from_graph(graph)


def test_what_is_no_graph_is_refused() -> None:
    with pytest.raises(MechanismError, match="give a networkx graph"):
        nag.Mechanism.from_graph([("a", "b")], "a")
