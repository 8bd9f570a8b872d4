from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from linkages import case, exact, four_bar, general_loop, loop, spherical_four_bar

from nag.algebra.number import is_zero, square_root
from nag.algebra.polynomial import Polynomial
from nag.mechanism.euler import euler_parameters, prime_component
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.loops import loop_structure
from nag.mechanism.model import ModelError, model
from nag.mechanism.quaternion import multiply
from nag.mechanism.unreduced import Placement, joint_constraints


def test_bricards_cube_is_16_quadrics_in_16_unknowns():
    system = model(case("bricard-cube"), "E").system
    assert (system.n, system.degrees) == (16, (2,) * 16)


def test_bennett_is_10_quadrics_in_8_unknowns():
    system = model(case("bennett"), "E").system
    assert (system.n, system.degrees) == (8, (2,) * 10)


@pytest.mark.parametrize("formulation", ["E", "H"])
@pytest.mark.parametrize(
    "mechanism",
    [
        case("bennett"),
        case("bricard-cube"),
        case("planar-four-bar"),
        general_loop(6, 1),
        general_loop(7, 2),
        spherical_four_bar(),
        four_bar((1, 2, 2), ((2, 1, -2), (2, -2, 1))),
        four_bar((1, 1, 1), ((1, -1, 0), (1, 1, -2))),
    ],
)
def test_reference_configuration_is_an_exact_solution(mechanism, formulation):
    m = model(mechanism, formulation)
    assert m.formulation == formulation
    assert all(type(x) is Fraction for x in m.reference)
    assert set(m.system(m.reference)) == {0}
    lifted = m.lift(m.reference)
    assert set(m.unreduced(m.unreduced_point(lifted))) == {0}
    for body in mechanism.body_names:
        assert lifted.euler[body] == mechanism.orientation(body)
        assert lifted.position[body] == (0, 0, 0)


def test_prime_component_holds_for_turns_about_the_joint_and_not_for_the_other_mode():
    structure = loop_structure(case("bennett"))
    mechanism = structure.mechanism
    n = 4 * len(structure.moving)
    parameters = euler_parameters(structure, n)
    joint = next(j for j in structure.joints if j.name == "J2")
    component = prime_component(structure, parameters, joint)
    origin = (Polynomial(n, {}),) * 3
    places = [Placement(parameters[b], origin, mechanism.orientation(b)) for b in joint.bodies]
    both = joint_constraints(joint, *places)[3:]
    assert (len(component), len(both)) == (2, 2)
    assert [f.degree for f in component] == [2, 2]
    assert [f.degree for f in both] == [4, 4]
    start = {b: mechanism.orientation(b) for b in structure.moving}
    axis = joint.axis
    # A turn of B2 about the axis of J2, and a half-turn across it that reverses the axis.
    turn = (Fraction(3, 7), *(Fraction(2, 5) * x for x in axis))
    across = (Fraction(0), axis[1], -axis[0], Fraction(0))
    for motion, holds in ((turn, True), (across, False)):
        moved = {**start, "B2": multiply(motion, start["B2"])}
        point = [x for b in structure.moving for x in moved[b]]
        assert len(point) == n
        assert all(f(point) == 0 for f in component) is holds
        assert all(f(point) == 0 for f in both)


def test_sign_changes_are_symmetries_of_the_reduced_system():
    for name, bodies in (("bennett", 3), ("bricard-cube", 5)):
        m = model(case(name), "E")
        assert m.sign_group == 2**bodies
        assert len(m.symmetries) == bodies
        variables = Polynomial.variables(m.system.n)
        for choice in product((False, True), repeat=2):
            images = variables
            for symmetry, used in zip(m.symmetries, choice, strict=False):
                if used:
                    images = symmetry.of_point(images)
            for f in m.system.polynomials:
                assert f.compose(images) in (f, -f)
        # Every variable belongs to one body.
        assert np.all(np.sum(np.array([g.signs for g in m.symmetries]) < 0, axis=0) == 1)


def test_half_angles_and_the_plane_have_no_sign_group():
    for m in (model(case("bennett"), "H"), model(case("planar-four-bar"), "E")):
        assert (m.sign_group, m.symmetries) == (1, ())


def test_spherical_loops_close_by_themselves():
    m = model(spherical_four_bar(), "E")
    assert (m.space, m.formulation) == ("spherical", "E")
    # 12 Euler parameters, 4 of them solved for; 3 norms and 2 joints of two moving bodies.
    assert (m.system.n, len(m.system.polynomials)) == (8, 7)


def test_two_loops_in_space():
    """A 7R with a second chain of four joints between two of its bodies."""
    first = general_loop(7, 2)
    second = general_loop(5, 6)
    rename = {"B0": "B0", "B1": "C1", "B2": "C2", "B3": "C3", "B4": "B3"}
    chain = [
        Joint(f"K{i}", j.type, tuple(rename[b] for b in j.bodies), j.point, j.axis)
        for i, j in enumerate(second.joints)
        if set(j.bodies) != {"B4", "B0"}
    ]
    m = model(Mechanism("B0", (*first.joints, *chain)), "E")
    assert (m.formulation, len(m.structure.loops)) == ("E", 2)
    # 9 moving bodies; two equations for each of 3 joints at the ground are solved for.
    assert len(m.structure.moving) == 9
    assert m.system.n == 9 * 4 - 3 * 2
    assert len(m.system.polynomials) == 9 + 2 * 3 + 2 * (11 - 3)
    assert set(m.system(m.reference)) == {0}
    assert set(m.unreduced(m.unreduced_point(m.lift(m.reference)))) == {0}


def test_a_door_on_two_hinges_turns_and_on_two_skew_ones_does_not():
    door = model(loop([(0, 0, 0), (0, 0, 1)], [(0, 0, 1)] * 2))
    assert door.system.text() == ["c1^2 + s1^2 - 1"]
    stuck = model(loop([(0, 0, 0), (1, 0, 0)], [(0, 0, 1), (0, 1, 1)]))
    assert stuck.system.text() == ["a0^2 - 1"]


def test_square_roots_in_the_geometry_are_carried():
    root = square_root(Fraction(3))
    joints = [
        Joint(j.name, j.type, j.bodies, j.point, (j.axis[0], j.axis[1] + root, j.axis[2]))
        for j in general_loop(5, 3).joints
    ]
    for formulation in ("E", "H"):
        m = model(Mechanism("B0", joints), formulation)
        assert not m.system.exact
        assert all(is_zero(v) for v in m.system(m.reference))
        lifted = m.lift(m.reference)
        assert all(is_zero(v) for v in m.unreduced(m.unreduced_point(lifted)))


def test_open_chains_are_refused_in_one_line():
    joint = Joint("J", "revolute", ("A", "B"), exact(0, 0, 0), exact(0, 0, 1))
    with pytest.raises(ModelError, match="no loop") as caught:
        model(Mechanism("A", (joint,)))
    assert "\n" not in str(caught.value)
    with pytest.raises(ModelError, match="unknown"):
        model(case("bennett"), "X")
