"""What a decomposition says of a mechanism does not depend on how the mechanism is written down."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from linkages import case, exact, four_bar, general_loop, spherical_four_bar

from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.mechanism.graph import Body, Joint, Mechanism
from nag.mechanism.model import model
from nag.mechanism.quaternion import multiply, norm_squared, rotate

FEW = settings(max_examples=2)

# Euler parameters of rational rotations: squares of integer quaternions have square norms.
TURNS = st.tuples(*[st.integers(-3, 3)] * 4).filter(any)
SHIFTS = st.tuples(*[st.integers(-5, 5)] * 3)
SUBJECTS = {
    "bennett": lambda: case("bennett"),
    "five": lambda: general_loop(5, 3),
    "planar": four_bar,
    "spherical": spherical_four_bar,
}


def turned(q: tuple[int, ...]) -> tuple[Fraction, ...]:
    square = multiply(exact(*q), exact(*q))
    size = norm_squared(exact(*q))
    return tuple(x / size for x in square)


def moved(mechanism: Mechanism, q, shift=(0, 0, 0), scale=Fraction(1)) -> Mechanism:
    """The mechanism turned by unit Euler parameters, scaled and shifted."""

    def place(point):
        return tuple(scale * x + s for x, s in zip(rotate(q, point), shift, strict=True))

    joints = [replace(j, point=place(j.point), axis=rotate(q, j.axis)) for j in mechanism.joints]
    bodies = [
        replace(b, orientation=b.orientation and multiply(q, b.orientation))
        for b in mechanism.bodies
    ]
    return Mechanism(mechanism.ground, tuple(joints), tuple(bodies))


def answer(mechanism: Mechanism) -> Counter:
    """How many components there are of each dimension, degree and multiplicity."""
    found = decompose(model(mechanism).system)
    assert found.complete
    counts: Counter = Counter()
    for c in found.components:
        counts[c.dimension, c.degree, c.multiplicity] += c.orbit
    return counts


@cache
def unchanged(name: str) -> Counter:
    return answer(SUBJECTS[name]())


def dimensions(answered: Counter) -> Counter:
    counts: Counter = Counter()
    for (dimension, _, multiplicity), count in answered.items():
        counts[dimension, multiplicity] += count
    return counts


def test_the_subjects_are_mobile_and_rigid():
    largest = {name: max(unchanged(name))[0] for name in SUBJECTS}
    assert largest == {"bennett": 1, "five": 0, "planar": 1, "spherical": 1}


@pytest.mark.parametrize("name", SUBJECTS)
@FEW
@given(q=TURNS, shift=SHIFTS)
def test_a_rigid_motion_changes_nothing(name, q, shift):
    mechanism = SUBJECTS[name]()
    assert answer(moved(mechanism, turned(q), shift)) == unchanged(name)


@pytest.mark.parametrize("name", SUBJECTS)
@pytest.mark.parametrize("power", [-6, 6])
def test_the_unit_of_length_changes_nothing(name, power):
    mechanism = SUBJECTS[name]()
    larger = moved(mechanism, exact(1, 0, 0, 0), scale=Fraction(10) ** power)
    assert answer(larger) == unchanged(name)


@pytest.mark.parametrize("name", SUBJECTS)
def test_names_and_the_order_of_a_joints_bodies_change_nothing(name):
    mechanism = SUBJECTS[name]()
    new = {b: f"part {len(b)}{b[::-1]}" for b in mechanism.body_names}
    joints = [
        replace(j, name=f"q{i}", bodies=tuple(new[b] for b in reversed(j.bodies)))
        for i, j in enumerate(mechanism.joints)
    ]
    bodies = [replace(b, name=new[b.name]) for b in mechanism.bodies]
    renamed = Mechanism(new[mechanism.ground], tuple(joints), tuple(bodies))
    assert answer(renamed) == unchanged(name)


@pytest.mark.parametrize("name", SUBJECTS)
def test_any_body_may_be_the_ground(name):
    mechanism = SUBJECTS[name]()
    expected = dimensions(unchanged(name))
    for body in mechanism.body_names[1:]:
        # A ground in the global frame; the others keep theirs.
        frames = tuple(b for b in mechanism.bodies if b.name != body)
        assert dimensions(answer(Mechanism(body, mechanism.joints, frames))) == expected


@pytest.mark.parametrize("name", SUBJECTS)
@FEW
@given(q=TURNS)
def test_local_frames_change_nothing(name, q):
    mechanism = SUBJECTS[name]()
    frames = [Body(b, turned(q)) for b in mechanism.body_names if b != mechanism.ground]
    framed = Mechanism(mechanism.ground, mechanism.joints, tuple(frames))
    assert answer(framed) == unchanged(name)


def serial_chain(seed: int, joints: int) -> Mechanism:
    """Random rational axes carried along by random rational turns, closed where they end.

    The chain is laid out with its joints turned; the last body is the ground, wherever it is.
    """
    import random

    draw = random.Random(seed)
    q, place, chain = exact(1, 0, 0, 0), exact(0, 0, 0), []
    for i in range(joints):
        step = exact(*(draw.randint(-4, 4) for _ in range(3)))
        place = tuple(x + y for x, y in zip(place, rotate(q, step), strict=True))
        axis = exact(draw.randint(1, 4), draw.randint(-3, 3), draw.randint(-3, 3))
        bodies = (f"B{i}", f"B{(i + 1) % joints}")
        chain.append(Joint(f"J{i}", "revolute", bodies, place, rotate(q, axis)))
        turn = turned((draw.randint(1, 4), *(draw.randint(-2, 2) for _ in range(3))))
        q = multiply(q, turn)
    return Mechanism("B0", tuple(chain))


@pytest.mark.parametrize("joints", [3, 4, 5])
@FEW
@given(seed=st.integers(0, 10**6))
def test_a_general_serial_chain_closed_by_construction_is_rigid_where_it_was_closed(joints, seed):
    made = model(serial_chain(seed, joints))
    assert all(value == 0 for value in made.system(made.reference))
    found = decompose(made.system)
    assert found.complete
    assert {(c.dimension, c.degree) for c in found.components} == {(0, 1)}


@pytest.mark.parametrize("seed", range(3))
def test_seven_joints_closed_by_construction_move_with_one_freedom(seed):
    made = model(serial_chain(seed, 7))
    jacobian = [[g(made.reference) for g in row] for row in made.system.jacobian]
    from nag.algebra.exact_ranks import row_echelon

    assert made.system.n - len(row_echelon(jacobian)[0]) == 1


@pytest.mark.parametrize("m", [("2", "4/3", "1/3"), ("1/3", "2", "5"), ("3", "-1/2", "-2/7")])
def test_bennetts_mechanism_moves_whatever_its_parameters(m):
    # The first has q5 = m1 (m0^2 - 1) - 2 m0 = 0.
    values = dict(zip(("m0", "m1", "m2"), m, strict=True))
    from linkages import CASES

    changed = read_case(CASES / "bennett.toml", values)
    assert changed.truth == ()
    assert answer(changed.mechanism) == {(1, 2, 1): 1}
