"""What a mechanism can do does not depend on how it is written down, nor on the formulation."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from linkages import case, general_loop, loops_of_all_joints
from solved import components_of

import nag
from nag.decomposition.decompose import decompose
from nag.mechanism.coordinates import carry_to_euler
from nag.mechanism.graph import Body, Joint, Mechanism
from nag.mechanism.model import ModelError, formulations, model
from nag.mechanism.problem import problem_of
from nag.mechanism.quaternion import norm_squared, rotate
from nag.mechanism.rods import RodModel

LOOPS = loops_of_all_joints()
EXAMPLES = {
    "Bennett": case("bennett"),
    "parallelogram": case("planar-four-bar"),
    "slider-crank": LOOPS["slider-crank"],
    "RUR": LOOPS["RUR"],
    "RSSR": LOOPS["RSSR"],
    "ECRR": LOOPS["ECRR"],
}
# Rational rotations: quaternions whose norm is a square.
TURN = tuple(Fraction(x, 7) for x in (2, 3, -6, 0))
FRAME = tuple(Fraction(x, 9) for x in (1, -4, 8, 0))


def components(mechanism: Mechanism, formulation: str = "auto") -> Counter:
    """Dimension with all freedoms, degree and multiplicity of the components."""
    m = model(mechanism, formulation)
    signs = m.symmetries
    answer = components_of(m.system, tuple(signs))
    assert answer.complete
    free = sum(count for count, _ in m.freedoms_left_out)
    counts: Counter = Counter()
    for c in answer.components:
        counts[c.dimension + free, c.degree, c.multiplicity] += c.orbit
    return counts


def with_vectors(mechanism: Mechanism, place, turn) -> Mechanism:
    def moved(joint: Joint) -> Joint:
        return replace(
            joint,
            point=place(joint.point),
            axis=joint.axis and turn(joint.axis),
            second_axis=joint.second_axis and turn(joint.second_axis),
        )

    return Mechanism(mechanism.ground, tuple(map(moved, mechanism.joints)))


def rigidly_moved(mechanism: Mechanism) -> Mechanism:
    shift = (Fraction(5, 3), Fraction(-7, 2), Fraction(11))
    assert norm_squared(TURN) == 1
    return with_vectors(
        mechanism,
        lambda p: tuple(x + d for x, d in zip(rotate(TURN, p), shift, strict=True)),
        lambda v: rotate(TURN, v),
    )


def scaled(mechanism: Mechanism, factor: Fraction) -> Mechanism:
    return with_vectors(mechanism, lambda p: tuple(x * factor for x in p), lambda v: v)


def relabelled(mechanism: Mechanism) -> Mechanism:
    """Other names, joints in another order, each with its bodies the other way round."""
    names = {b: f"part {i}" for i, b in enumerate(reversed(mechanism.body_names))}
    joints = []
    for i, j in enumerate(mechanism.joints):
        bodies = tuple(names[b] for b in reversed(j.bodies))
        axes = (j.axis, j.second_axis)
        if j.type == "universal":
            axes = axes[::-1]
        joints.append(Joint(f"K{i}", j.type, bodies, j.point, *axes))
    return Mechanism(names[mechanism.ground], tuple(joints[1:] + joints[:1]))


def with_frames(mechanism: Mechanism) -> Mechanism:
    assert norm_squared(FRAME) == 1
    moving = mechanism.body_names[1:]
    return Mechanism(mechanism.ground, mechanism.joints, tuple(Body(b, FRAME) for b in moving))


@cache
def unchanged(name: str) -> Counter:
    """The components of an example as it stands, with plain frames."""
    mechanism = EXAMPLES[name]
    return components(Mechanism(mechanism.ground, mechanism.joints))


CHANGES = {
    "rigid motion": rigidly_moved,
    "names, order and direction": relabelled,
    "scale 1e6": lambda m: scaled(m, Fraction(10**6)),
    "scale 1e-6": lambda m: scaled(m, Fraction(1, 10**6)),
    "local frames": with_frames,
}


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", EXAMPLES)
def test_components_do_not_depend_on_how_the_mechanism_is_written(name, change):
    mechanism = EXAMPLES[name]
    bare = Mechanism(mechanism.ground, mechanism.joints)
    assert components(CHANGES[change](bare)) == unchanged(name)


@pytest.mark.parametrize("name", EXAMPLES)
def test_dimensions_and_counts_do_not_depend_on_the_ground(name):
    """Degrees may: other joints are eliminated."""
    mechanism = EXAMPLES[name]

    def dimensions(counts: Counter) -> Counter:
        return Counter(d for (d, *_), k in counts.items() for _ in range(k))

    expected = dimensions(unchanged(name))
    for ground in mechanism.body_names[1:]:
        moved = Mechanism(ground, mechanism.joints)
        assert dimensions(components(moved)) == expected


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_formulation_leads_to_the_same_components_in_euler_parameters(name):
    mechanism = EXAMPLES[name]
    expected = components(mechanism, "E")
    others = [f for f in formulations(mechanism) if f != "E"]
    assert others
    for formulation in others:
        m = model(mechanism, formulation)
        answer = components_of(m.system)
        _, carried = carry_to_euler(problem_of(m), answer)
        assert carried.complete
        counts: Counter = Counter()
        for c in carried.components:
            counts[c.dimension, c.degree, c.multiplicity] += c.orbit
        assert counts == expected, formulation


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_formulation_that_is_taken_has_the_fewest_paths(name):
    m = model(EXAMPLES[name])
    covered = [a for a in m.alternatives if a.form is not None]
    assert m.formulation == covered[0].formulation
    assert [a.paths for a in covered] == sorted(a.paths for a in covered)


@given(st.integers(5, 6), st.integers(0, 10**6))
@settings(max_examples=6)
def test_random_closed_chains_have_the_mobility_that_counting_says(joints, seed):
    """n revolute joints in general position, closed by construction: n - 6, at least 0."""
    m = model(general_loop(joints, seed))
    answer = decompose(m.system)
    assert answer.complete
    assert {c.dimension for c in answer.components} == {max(joints - 6, 0)}
    if joints == 6:
        assert len(answer.components) == 16
    assert all(c.multiplicity == 1 for c in answer.components)


def test_six_rods_have_forty_assemblies():
    """Stewart-Gough's platform in general position; six rods turn about themselves."""
    rng = np.random.default_rng(4)
    joints = []
    for i in range(6):
        a, b = ([Fraction(int(x), 9) for x in rng.integers(-20, 21, 3)] for _ in range(2))
        joints.append(Joint(f"A{i}", "spherical", ("base", f"rod {i}"), tuple(a)))
        joints.append(Joint(f"B{i}", "spherical", (f"rod {i}", "top"), tuple(b)))
    m = model(Mechanism("base", tuple(joints)))
    assert (m.formulation, m.system.n) == ("S", 7)
    assert isinstance(m.form, RodModel) and m.form.spins == 6
    assert set(m.system(m.reference)) == {0}
    answer = decompose(m.system)
    assert answer.complete
    assert [(c.dimension, c.degree) for c in answer.components] == [(0, 1)] * 40
    for component in answer.components:
        lifted = m.lift(component.points[0])
        at = [complex(x) for x in m.unreduced_point(lifted)]
        values = [abs(complex(f(at))) for f in m.unreduced.polynomials]
        assert max(values) < 1e-9 * max(1, max(map(abs, at))) ** 2


P, Q, T, V = (1, 2, 3), (4, 0, 1), (0, 5, 2), (7, 1, 1)


def spherical(name: str, first: str, second: str, point) -> Joint:
    return Joint(name, "spherical", (first, second), point)


def rod(name: str, first: str, second: str, start, end) -> list[Joint]:
    return [spherical(f"{name}1", first, name, start), spherical(f"{name}2", name, second, end)]


def cranks() -> list[Joint]:
    crank = Joint("A", "revolute", ("base", "a"), (0, 0, 0), (0, 0, 1))
    return [crank, Joint("B", "revolute", ("b", "base"), Q, (1, 1, 0))]


# Rods of length zero (x, y, z) and others (r, s, t), and the mobility.
ZERO_RODS = {
    "between cranks": ([*cranks(), *rod("z", "a", "b", P, P)], 3),
    "between cranks, with a rod": (
        [*cranks(), *rod("z", "a", "b", P, P), *rod("r", "a", "b", V, T)],
        4,
    ),
    "two in a chain": (
        [*cranks(), *rod("z", "a", "y", P, P), spherical("y2", "y", "b", P)],
        6,
    ),
    "a rod in a chain": ([*cranks(), *rod("z", "a", "r", P, P), spherical("r2", "r", "b", T)], 5),
    "in a ring of balls": (
        [spherical("A", "base", "a", V), *rod("z", "a", "b", P, P), spherical("B", "b", "base", Q)],
        6,
    ),
    "ball joint at the ground, three rods": (
        [
            *rod("z", "base", "top", P, P),
            *rod("r", "base", "top", (0, 0, 0), (3, 1, 5)),
            *rod("s", "base", "top", (5, 0, 0), (5, 2, 4)),
            *rod("t", "base", "top", (0, 6, 0), (1, 7, 4)),
        ],
        6,
    ),
    "two make a hinge": ([*rod("z", "base", "top", P, P), *rod("y", "base", "top", Q, Q)], 7),
    "three hold a body": (
        [x for n, p in zip("xyz", (P, Q, T), strict=True) for x in rod(n, "base", "top", p, p)],
        9,
    ),
}


@pytest.mark.parametrize("name", sorted(ZERO_RODS))
def test_a_rod_of_length_zero_is_a_spherical_joint(name: str) -> None:
    joints, mobility = ZERO_RODS[name]
    mechanism = Mechanism("base", tuple(joints))
    for formulation in ("S", "E", "H"):
        report = nag.mobility(mechanism, formulation=formulation, detail="local")
        assert (report.tangent_dimension, report.local_dimension) == (mobility, mobility)
    m = model(mechanism, "S")
    lifted = m.unreduced_point(m.lift(m.reference))
    assert all(f(lifted) == 0 for f in m.unreduced.polynomials)
    assert {d for d, *_ in components(mechanism, "S")} == {mobility}


@pytest.mark.parametrize("name", ["between cranks", "a rod in a chain", "two make a hinge"])
def test_components_with_rods_of_length_zero_are_those_of_euler_parameters(name: str) -> None:
    mechanism = Mechanism("base", tuple(ZERO_RODS[name][0]))
    m = model(mechanism, "S")
    _, carried = carry_to_euler(problem_of(m), decompose(m.system))
    assert carried.complete
    found = Counter({(c.dimension, c.degree, c.multiplicity): 0 for c in carried.components})
    for c in carried.components:
        found[c.dimension, c.degree, c.multiplicity] += c.orbit
    assert found == components(mechanism, "E")


def test_ball_joint_and_three_rods_have_eight_assemblies() -> None:
    mechanism = Mechanism("base", tuple(ZERO_RODS["ball joint at the ground, three rods"][0]))
    assert components(mechanism, "S") == {(6, 1, 1): 8}


def test_a_chain_of_rods_of_length_zero_alone_is_left_to_other_formulations() -> None:
    ring = Mechanism("base", (*rod("z", "base", "y", P, P), spherical("y2", "y", "base", P)))
    with pytest.raises(ModelError, match="nothing turns but rods"):
        model(ring, "S")
    assert nag.mobility(ring).local_dimension == 6
