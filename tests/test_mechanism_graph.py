from fractions import Fraction

import networkx
import pytest
from hypothesis import given
from hypothesis import strategies as st
from linkages import case, exact, four_bar, loop

from nag.errors import MechanismError
from nag.mechanism.graph import Body, Joint, Mechanism, connected_to
from nag.mechanism.loops import loop_structure


def joint(name="J", kind="revolute", bodies=("A", "B"), point=(0, 0, 0), axis=(0, 0, 1)):
    return Joint(name, kind, bodies, exact(*point), exact(*axis))


@pytest.mark.parametrize(
    ("build", "text", "at"),
    [
        (lambda: Mechanism("A", ()), "at least one joint", (None, None, None)),
        (lambda: Mechanism("A", (joint(kind="door"),)), "unknown", ("J", None, "type")),
        (
            lambda: Mechanism("A", (joint(kind="helical"),)),
            "not algebraic",
            ("J", None, "type"),
        ),
        (lambda: Mechanism("A", (joint(bodies=("A", "A")),)), "itself", ("J", None, "bodies")),
        (lambda: Mechanism("A", (joint(bodies=("A",)),)), "two bodies", ("J", None, "bodies")),
        (lambda: Mechanism("A", (joint(axis=(0, 0, 0)),)), "length zero", ("J", None, "axis")),
        (lambda: Mechanism("A", (joint(point=(0, 0)),)), "coordinates", ("J", None, "point")),
        (lambda: Mechanism("A", (joint(), joint())), "two joints", ("J", None, "name")),
        (lambda: Mechanism("C", (joint(),)), "not a body", (None, None, "ground")),
        (
            lambda: Mechanism("A", (joint(), joint("K", bodies=("C", "D")))),
            "no joint connects C, D",
            ("K", "C", "bodies"),
        ),
        (lambda: Mechanism("A", (joint(),), (Body("C"),)), "no joint", (None, "C", "name")),
        (
            lambda: Mechanism("A", (joint(),), (Body("B"), Body("B"))),
            "twice",
            (None, "B", "name"),
        ),
        (
            lambda: Mechanism("A", (joint(),), (Body("B", exact(1, 1, 0, 0)),)),
            "squared norm 2; it must be exactly 1",
            (None, "B", "orientation"),
        ),
        (
            lambda: Mechanism("A", (joint(),), (Body("B", exact(10**300, 0, 0, 0)),)),
            "squared norm 1.0e+600; it must be exactly 1",
            (None, "B", "orientation"),
        ),
        (
            lambda: Mechanism("A", (joint(),), (Body("B", exact(1, 0, 0)),)),
            "4 Euler parameters",
            (None, "B", "orientation"),
        ),
    ],
)
def test_nonsense_is_refused_with_one_line_that_says_where(build, text, at):
    with pytest.raises(MechanismError) as caught:
        build()
    assert text in str(caught.value)
    assert "\n" not in str(caught.value)
    assert (caught.value.joint, caught.value.body, caught.value.key) == at


def test_a_norm_that_is_nearly_one_is_refused():
    nearly = (Fraction(1), Fraction(1, 10**20), Fraction(0), Fraction(0))
    with pytest.raises(MechanismError, match="exactly 1"):
        Mechanism("A", (joint(),), (Body("B", nearly),))


@given(st.lists(st.frozensets(st.sampled_from("abcdefgh"), min_size=1, max_size=3), max_size=8))
def test_what_is_connected_is_what_networkx_says(ties):
    graph = networkx.Graph()
    graph.add_node("a")
    for tie in ties:
        networkx.add_path(graph, sorted(tie))
        graph.add_nodes_from(tie)
    assert connected_to("a", ties) == networkx.node_connected_component(graph, "a")


def test_graph_has_bodies_as_nodes_and_joints_as_edges():
    graph = case("bennett").graph
    assert sorted(graph) == ["B0", "B1", "B2", "B3"]
    assert {key: {a, b} for a, b, key in graph.edges(keys=True)} == {
        "J0": {"B3", "B0"},
        "J1": {"B0", "B1"},
        "J2": {"B1", "B2"},
        "J3": {"B2", "B3"},
    }
    assert graph.edges["B0", "B1", "J1"]["joint"].name == "J1"


def test_two_joints_between_the_same_bodies_are_a_loop():
    mechanism = Mechanism("A", (joint(), joint("K", point=(1, 0, 0))))
    (found,) = loop_structure(mechanism).loops
    assert {j.name for j in found.joints} == {"J", "K"}
    assert set(found.bodies) == {"A", "B"}


def test_loops_are_closed_chains():
    for mechanism in (case("bennett"), case("bricard-cube"), four_bar()):
        (found,) = loop_structure(mechanism).loops
        n = len(found.bodies)
        for i, j in enumerate(found.joints):
            assert set(j.bodies) == {found.bodies[i], found.bodies[(i + 1) % n]}
        single = loop_structure(mechanism).single
        assert single.bodies[:2] == ("B0", "B1")


def test_minimum_cycle_basis_takes_the_short_loops():
    ladder = [
        joint("a", bodies=("G", "P")),
        joint("b", bodies=("P", "Q"), point=(1, 0, 0)),
        joint("c", bodies=("Q", "G"), point=(1, 1, 0)),
        joint("d", bodies=("P", "S"), point=(2, 0, 0)),
        joint("e", bodies=("S", "Q"), point=(2, 1, 0)),
    ]
    loops = loop_structure(Mechanism("G", ladder)).loops
    assert sorted("".join(sorted(j.name for j in p.joints)) for p in loops) == ["abc", "bde"]


def test_dangling_trees_are_cut_off():
    triangle = loop([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 1)] * 3)
    tail = [
        joint("T1", bodies=("B1", "X"), point=(3, 0, 0)),
        joint("T2", bodies=("X", "Y"), point=(4, 0, 0)),
    ]
    structure = loop_structure(Mechanism("B0", triangle.joints + tuple(tail)))
    assert {j.name for j in structure.cut} == {"T1", "T2"}
    assert structure.cut_freedoms == 2
    assert set(structure.moving) == {"B1", "B2"}
    # The ground at the end of the tail: the nearest body with a loop stands in for it.
    structure = loop_structure(Mechanism("Y", triangle.joints + tuple(tail)))
    assert structure.base == "B1"
    assert [(p, c) for p, c, _ in structure.spanning_tree()][-2:] == [("B1", "X"), ("X", "Y")]


def test_a_point_that_is_left_out_is_the_origin() -> None:
    left_out = Joint("A", "prismatic", ("base", "slide"), axis=(0, 0, 1))
    assert Joint("A", "prismatic", ("base", "slide"), None, (0, 0, 1)) == left_out
    assert left_out.point == (0, 0, 0)
