"""Joints of every type: prime components, constraints of PT13 table 1, mobility of loops."""

from dataclasses import replace
from fractions import Fraction

import pytest
from linkages import closed_chain, exact, loops_of_all_joints, residual
from solved import components_of

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.errors import MechanismError, NagError
from nag.mechanism.axes import space_of
from nag.mechanism.euler import euler_parameters, prime_component
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.joint_types import JOINT_TYPES, LINE, JointType
from nag.mechanism.loops import loop_structure
from nag.mechanism.model import ModelError, formulations, model
from nag.mechanism.quaternion import norm_squared
from nag.mechanism.unreduced import Placement, joint_constraints

LOOPS = loops_of_all_joints()
AXES = {"axis": exact(2, -1, 2), "second_axis": exact(0, 2, 1)}


def joint_between(kind: str) -> Joint:
    known = JOINT_TYPES[kind]
    vectors = {key: AXES[key] for key in known.fields if key in AXES}
    return Joint("J", kind, ("A", "B"), exact(1, 2, 3), **vectors)


def polynomials_in_both(kind: str) -> tuple[list[Polynomial], list[list[Polynomial]]]:
    """Norms and SO constraints of two free bodies, and the prime component of each mode."""
    ground = Joint("G", "spherical", ("O", "A"), exact(0, 0, 0))
    closing = Joint("H", "spherical", ("O", "B"), exact(1, 0, 0))
    joint = joint_between(kind)
    structure = loop_structure(Mechanism("O", (ground, joint, closing)))
    parameters = euler_parameters(structure, 8)
    none = (Polynomial(8, {}),) * 3
    frame = exact(1, 0, 0, 0)
    places = [Placement(parameters[b], none, frame) for b in joint.bodies]
    known = JOINT_TYPES[kind]
    values = joint_constraints(joint, *places)[3 * known.coincidences :][: known.orthogonalities]
    norms = [norm_squared(parameters[b]) - 1 for b in joint.bodies]
    modes = [prime_component(structure, parameters, joint, m) for m in range(known.modes)]
    return norms + values, [norms + mode for mode in modes]


def components(polynomials: list[Polynomial]) -> list[tuple[int, int]]:
    system = PolynomialSystem(tuple("abcdefgh"), tuple(f for f in polynomials if f))
    answer = decompose(system)
    assert answer.complete
    return [(c.dimension, c.degree) for c in answer.components]


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "universal", "spherical"])
def test_prime_components_have_the_listed_number_dimension_and_degree(kind):
    known = JOINT_TYPES[kind]
    constraints, modes = polynomials_in_both(kind)
    found = known.components
    assert components(constraints) == [(found.dimension, found.degree)] * found.count
    for mode in modes:
        assert components(mode) == [(found.dimension, found.degree)]


@pytest.mark.parametrize("kind", JOINT_TYPES)
def test_conditions_and_freedoms_of_a_joint_add_up_to_six(kind):
    known = JOINT_TYPES[kind]
    assert known.conditions + known.freedoms == 6
    places = [Placement(exact(1, 0, 0, 0), exact(0, 0, 0), exact(1, 0, 0, 0)) for _ in range(2)]
    values = joint_constraints(joint_between(kind), *places)
    assert values == [0] * known.conditions


# Space, and dimension of every component by the freedoms of the joints; the PPPP loop slides in
# the plane, where four freedoms meet two conditions.
EXPECTED = {
    "slider-crank": ("planar", 1),
    "PPPP": ("planar", 2),
    "RUR": ("spherical", 1),
    "RSSR": ("spatial", 2),
    "ECRR": ("spatial", 1),
    "four-bar": ("planar", 1),
}


@pytest.mark.parametrize("formulation", ["E", "H"])
@pytest.mark.parametrize("name", EXPECTED)
def test_loops_of_all_joints_have_their_mobility_and_lift_to_all_constraints(name, formulation):
    if (name, formulation) == ("PPPP", "H"):
        with pytest.raises(ModelError, match="all its joints slide"):
            model(LOOPS[name], "H")
        return
    m = model(LOOPS[name], formulation)
    space, dimension = EXPECTED[name]
    assert space_of(m.structure.joints) == m.space == space
    assert set(m.system(m.reference)) <= {0}
    assert set(m.unreduced(m.unreduced_point(m.lift(m.reference)))) == {0}
    signs = m.symmetries
    answer = components_of(m.system, tuple(signs))
    assert answer.complete
    assert {c.dimension for c in answer.components} == {dimension}
    for component in answer.components:
        for point in component.points[:4]:
            lifted = m.lift(point)
            at = [complex(x) for x in m.unreduced_point(lifted)]
            assert residual(m.unreduced, at) < 1e-12


def test_bodies_that_are_tied_rigidly_move_as_one():
    m = model(LOOPS["four-bar"])
    assert [j.name for j in m.structure.joints] == ["J0", "J2", "J3", "J4"]
    lifted = m.lift([Fraction(3, 5), Fraction(4, 5), 1, 0][: m.system.n])
    assert lifted.euler["B0"] == lifted.euler["B1"] == (1, 0, 0, 0)
    assert set(lifted.euler) == {"B0", "B1", "B2", "B3", "B4"}


def test_a_mechanism_tied_rigidly_as_a_whole_has_nothing_to_decompose():
    tied = closed_chain(("rigid", (0, 0, 0)), ("revolute", (0, 0, 0), (0, 0, 1)))
    assert loop_structure(tied).loops == ()
    with pytest.raises(ModelError, match="rigid"):
        model(tied)


@pytest.mark.parametrize(
    ("fields", "text", "key"),
    [
        ({"type": "helical"}, "cylindrical joint", "type"),
        ({"type": "revolute"}, "needs its axis", "axis"),
        ({"type": "spherical", "axis": exact(0, 0, 1)}, "has no axis", "axis"),
        ({"type": "universal", "axis": exact(0, 0, 1)}, "needs its second axis", "second_axis"),
        (
            {"type": "universal", "axis": exact(0, 0, 1), "second_axis": exact(0, 0, 2)},
            "same direction",
            "second_axis",
        ),
    ],
)
def test_vectors_that_do_not_belong_to_the_type_are_refused(fields, text, key):
    with pytest.raises(MechanismError, match=text) as caught:
        Mechanism("A", (Joint("J", bodies=("A", "B"), **fields),))
    assert (caught.value.joint, caught.value.key) == ("J", key)


def test_the_translational_joint_is_the_prismatic_one():
    assert Joint("J", "translational", ("A", "B"), axis=exact(1, 0, 0)).type == "prismatic"


@pytest.mark.parametrize("name", LOOPS)
def test_a_type_of_joint_is_its_record_and_nothing_asks_for_its_name(name, monkeypatch):
    named = {f"{name} of mine": known for name, known in JOINT_TYPES.items()}
    monkeypatch.setattr("nag.mechanism.graph.JOINT_TYPES", {**JOINT_TYPES, **named})
    given = LOOPS[name]
    joints = tuple(replace(joint, type=f"{joint.type} of mine") for joint in given.joints)
    for formulation in formulations(given):
        one, other = (model(m, formulation) for m in (given, replace(given, joints=joints)))
        assert (other.system, other.space) == (one.system, one.space)
        assert other.unreduced == one.unreduced


@pytest.mark.parametrize(
    ("numbers", "text"),
    [
        ((LINE, (), 1, 2, 1, ("turn",)), "6 conditions and 1 freedoms; 6 in all"),
        ((LINE, (), 1, 2, 0, ("screw",)), "'screw' is unknown; there are turn, slide, ball, plane"),
        (((*LINE, "pitch"), (), 1, 2, 0, ("turn",)), "'pitch' is unknown; there are point, axis"),
        ((LINE, (), 0, 4, 1, ("turn",)), "4 orthogonalities; at most 3"),
        ((LINE, (), 1, 1, 0, ("turn", "turn")), "second axis"),
    ],
)
def test_a_type_of_joint_whose_numbers_do_not_fit_is_refused(numbers, text):
    with pytest.raises(NagError, match=text):
        JointType(*numbers)


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("formulation", ["E", "H"])
def test_a_slide_whose_axis_turns_is_carried_by_the_first_body(formulation, swapped, monkeypatch):
    groove = JointType(LINE, (), 0, 0, 2, ("slide", "ball"))
    types = {**JOINT_TYPES, "sphere in a groove": groove}
    monkeypatch.setattr("nag.mechanism.graph.JOINT_TYPES", types)
    joints = closed_chain(
        ("sphere in a groove", (0, 0, 0), (1, 2, 2)),
        ("revolute", (1, 0, 0), (0, 1, 2)),
        ("revolute", (1, 2, 0), (1, 1, 1)),
    ).joints
    bodies = joints[0].bodies
    assert "B0" in bodies
    first = replace(joints[0], bodies=bodies[::-1]) if swapped else joints[0]
    m = model(Mechanism("B0", (first, *joints[1:])), formulation)
    answer = components_of(m.system, tuple(m.symmetries))
    assert answer.complete and {c.dimension for c in answer.components} == {0}
    for point in (p for c in answer.components for p in c.points):
        at = [complex(x) for x in m.unreduced_point(m.lift(point))]
        assert residual(m.unreduced, at) < 1e-12


@pytest.mark.parametrize(
    ("word", "type"),
    [
        ("translational", "prismatic"),
        ("slider", "prismatic"),
        ("hinge", "revolute"),
        ("ball", "spherical"),
    ],
)
def test_joints_may_be_called_what_others_call_them(word: str, type: str) -> None:
    axis = (0, 0, 1) if type != "spherical" else None
    joint = Joint(name="J", type=word, bodies=("A", "B"), point=(0, 0, 0), axis=axis)
    assert joint.type == type
