"""A joint between two parts with loops, itself in none, moves freely whatever they do."""

import pytest
from linkages import exact, residual

from nag.decomposition.decompose import decompose
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.loops import loop_structure
from nag.mechanism.mobility_at import mobility
from nag.mechanism.model import model

FIRST = (
    ("A", "ga", (0, 0, 0)),
    ("B", "ab", (1, 2, 0)),
    ("C", "bc", (4, 3, 0)),
    ("D", "cg", (5, 0, 0)),
)
SECOND = (
    ("E", "de", (7, 6, 0)),
    ("F", "ef", (8, 9, 0)),
    ("G", "fh", (11, 8, 0)),
    ("H", "hd", (12, 5, 0)),
)
AXES = {"axis": exact(0, 0, 1), "second_axis": exact(1, 0, 0)}


def two_four_bars(bridge: str, keys: tuple[str, ...]) -> Mechanism:
    loops = [
        Joint(name, "revolute", tuple(bodies), exact(*point), AXES["axis"])
        for name, bodies, point in (*FIRST, *SECOND)
    ]
    vectors = {key: AXES[key] for key in keys}
    return Mechanism("g", (*loops, Joint("T", bridge, ("b", "d"), exact(2, 5, 0), **vectors)))


BRIDGES = {
    "revolute": (("axis",), 1),
    "universal": (("axis", "second_axis"), 2),
    "spherical": ((), 3),
}


@pytest.mark.parametrize("formulation", ["E", "H"])
@pytest.mark.parametrize("kind", BRIDGES)
def test_its_freedoms_are_counted_in_every_formulation(kind, formulation):
    keys, freedoms = BRIDGES[kind]
    mechanism = two_four_bars(kind, keys)
    report = mobility(mechanism, formulation=formulation)
    assert report.local_dimension == report.tangent_dimension == 2 + freedoms
    assert {d for d, _ in report.components or ()} == {2 + freedoms}


@pytest.mark.parametrize("formulation", ["E", "H"])
def test_its_bodies_are_carried_along_and_every_constraint_holds(formulation):
    m = model(two_four_bars("universal", BRIDGES["universal"][0]), formulation)
    assert [j.name for j in m.cut] == ["T"] and "joints T" in m.reason
    answer = decompose(m.system, symmetries=m.symmetries)
    assert answer.complete
    for component in answer.components:
        for point in component.points[:4]:
            lifted = [complex(x) for x in m.unreduced_point(m.lift(point))]
            assert residual(m.unreduced, lifted) < 1e-12


def test_joints_of_one_loop_or_of_loops_that_share_a_body_are_no_bridges():
    mechanism = two_four_bars("revolute", ("axis",))
    assert [j.name for j in loop_structure(mechanism).bridges] == ["T"]
    tied = Joint("S", "spherical", ("c", "f"), exact(6, 2, 1))
    assert loop_structure(Mechanism("g", (*mechanism.joints, tied))).bridges == ()
    assert loop_structure(Mechanism("g", mechanism.joints[:4])).bridges == ()
