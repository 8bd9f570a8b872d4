"""The operation modes of parallel robots are those that are known, wherever a robot stands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from linkages import CASES

import nag
from nag.algebra.exact_ranks import null_space
from nag.algebra.number import square_root
from nag.cli import main
from nag.decomposition.intersection import intersect_components
from nag.errors import MechanismError, NagError
from nag.files.cases import read_case
from nag.mechanism import operation_modes
from nag.mechanism.axes import cross
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.inverse_kinematics import REACHED, multiply_poses, reach_poses
from nag.mechanism.isotropic_limits import is_isotropic_limit
from nag.mechanism.joint_factors import factors_of_joint
from nag.mechanism.leg_image import (
    COORDINATES,
    forms_about_origin,
    image_of_chain,
    study_quadric,
)
from nag.mechanism.legs import Leg, parallel_robot
from nag.mechanism.loop_product import Element, displacement
from nag.mechanism.modes_report import ModeReality, OperationModes, Transition
from nag.mechanism.motions import motion_of, screw_system
from nag.mechanism.platform import platform_model
from nag.mechanism.quaternion import rotate
from nag.report.agreement import AgreementKind, compare

ROBOTS = sorted(path.stem for path in (CASES / "robots").glob("*.toml"))
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def robot(name: str) -> Mechanism:
    mechanism = read_case(CASES / "robots" / f"{name}.toml").mechanism
    assert mechanism is not None
    return mechanism


@cache
def found_modes(name: str, seed: int = 0) -> OperationModes:
    return nag.modes(robot(name), seed=seed)


def kinds(found: OperationModes) -> Counter[tuple[int, int]]:
    assert found.complete
    return Counter((m.dimension, m.degree) for m in found.modes)


def chain(*joints: tuple[str, dict]) -> Leg:
    """Joints one after the other."""
    bodies = tuple(f"B{i}" for i in range(len(joints) + 1))
    made = [
        Joint(f"J{i}", kind, (bodies[i], bodies[i + 1]), **given)
        for i, (kind, given) in enumerate(joints)
    ]
    return Leg(tuple(made), bodies)


def at(point: tuple, axis: tuple | None = None, second_axis: tuple | None = None) -> dict:
    return {"point": point, "axis": axis, "second_axis": second_axis}


CHAINS = {
    "UPS": chain(
        ("universal", at((1, 2, 0), X, Y)), ("prismatic", {"axis": (1, 1, 3)}),
        ("spherical", at((2, 3, 3))),
    ),
    "RPS": chain(
        ("revolute", at((1, 2, 0), Y)), ("prismatic", {"axis": (1, 0, 3)}),
        ("spherical", at((2, 2, 3))),
    ),
    "UPU": chain(
        ("universal", at((3, 0, 0), Y, (4, 0, 2))), ("prismatic", {"axis": (-2, 0, 4)}),
        ("universal", at((1, 0, 4), (4, 0, 2), Y)),
    ),
    "UU": chain(("universal", at((3, 0, 0), Y, X)), ("universal", at((3, 0, 4), X, Y))),
    "CC": chain(("cylindrical", at((1, 2, 3), X)), ("cylindrical", at((2, 0, 1), (1, 1, 2)))),
    "PRRR": chain(
        ("prismatic", {"axis": X}), *(("revolute", at((2, k, k * k), X)) for k in range(3))
    ),
    "RS": chain(("revolute", at((1, 2, 0), Y)), ("spherical", at((2, 3, 3)))),
    "RRR": chain(
        ("revolute", at((1, 2, 0), Y)), ("revolute", at((0, 1, 1), X)),
        ("revolute", at((3, 1, 2), (1, 1, 1))),
    ),
    "CS": chain(("cylindrical", at((1, 2, 0), Y)), ("spherical", at((2, 3, 3)))),
}  # fmt: skip
# Dimension of the image, and degrees of its forms besides Study's quadric.
IMAGES = {
    "UPS": (6, []),
    "RPS": (5, [2]),
    "UPU": (5, [2]),
    "UU": (4, [2, 2]),
    "CC": (4, [2, 2]),
    "PRRR": (4, [1, 1]),
    "RS": (4, [2] * 5),
    "RRR": (3, [2] * 8),
    "CS": (5, [4]),
}


@pytest.mark.parametrize("name", sorted(CHAINS))
def test_the_forms_of_a_leg_have_the_degrees_that_are_known(name: str) -> None:
    image = image_of_chain(CHAINS[name].elements(), np.random.default_rng(0))
    assert image.cuts
    assert (image.dimension, [f.degree for f in image.forms]) == IMAGES[name]


numbers = st.fractions(-5, 5, max_denominator=6)


@pytest.mark.parametrize("name", ["RPS", "CC", "RRR", "CS", "PRRR"])
@settings(max_examples=10, deadline=None)
@given(data=st.data())
def test_the_forms_of_a_leg_vanish_exactly_at_its_poses(name: str, data: st.DataObject) -> None:
    leg = CHAINS[name]
    image = image_of_chain(leg.elements(), np.random.default_rng(1))
    factors = [f for joint in leg.joints for f in factors_of_joint(joint)]
    values = {f: [Fraction(1)] + [data.draw(numbers) for _ in range(f.dimension)] for f in factors}
    real, dual = displacement(leg.elements(), values, Fraction)
    assert all(f((*real, *dual)) == 0 for f in (study_quadric(), *image.forms))


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_has_the_modes_that_are_known(name: str) -> None:
    case = read_case(CASES / "robots" / f"{name}.toml")
    found = found_modes(name)
    assert found.complete
    assert not found.spurious
    agreement = compare(found.decomposition, case.truth, "P")
    assert agreement is not None
    assert agreement.verdict is AgreementKind.AGREES
    assert not agreement.unlisted


def test_robots_name_their_sources() -> None:
    assert len(ROBOTS) >= 12
    for name in ROBOTS:
        truth = read_case(CASES / "robots" / f"{name}.toml").truth
        assert truth, name
        assert all(t.source for t in truth) and any(t.formulation == "P" for t in truth), name


@pytest.mark.parametrize("name", ROBOTS)
def test_the_largest_mode_through_the_reference_and_idle_turns_are_the_local_dimension(
    name: str,
) -> None:
    found = found_modes(name)
    idle = sum(leg.idle for leg in found.model.legs)
    report = nag.mobility(robot(name), detail="local")
    assert report.local_dimension == found.dimension_at_reference + idle


@pytest.mark.parametrize("seed", range(1, 4))
@pytest.mark.parametrize("name", ["3-rps", "3-upu-snu"])
def test_another_seed_finds_the_same_modes_in_the_same_order(name: str, seed: int) -> None:
    one, other = found_modes(name), found_modes(name, seed)
    assert kinds(one) == kinds(other)
    for a, b in zip(one.modes, other.modes, strict=True):
        assert (a.equations, a.reality, str(a.motion)) == (b.equations, b.reality, str(b.motion))
    assert one.transitions == other.transitions


def moved(mechanism: Mechanism, turn: tuple, shift: tuple, scale: Fraction) -> Mechanism:
    """The robot elsewhere, turned by an unnormalised quaternion, and of another size."""
    norm = sum(q * q for q in turn)

    def turned(v: tuple | None) -> tuple | None:
        return None if v is None else tuple(x / norm for x in rotate(turn, v))

    joints = [
        replace(
            j,
            point=tuple(scale * x + s for x, s in zip(turned(j.point), shift, strict=True)),
            axis=turned(j.axis),
            second_axis=turned(j.second_axis),
        )
        for j in mechanism.joints
    ]
    return Mechanism(mechanism.ground, tuple(joints))


@settings(max_examples=3, deadline=None)
@given(
    turn=st.tuples(*[st.integers(-3, 3).map(Fraction)] * 4).filter(any),
    shift=st.tuples(*[st.integers(-20, 20).map(Fraction)] * 3),
    scale=st.fractions(Fraction(1, 7), 10, max_denominator=7),
)
def test_the_modes_of_a_robot_do_not_depend_on_where_it_stands(
    turn: tuple, shift: tuple, scale: Fraction
) -> None:
    there = nag.modes(moved(robot("3-upu-tsai"), turn, shift, scale))
    here = found_modes("3-upu-tsai")
    assert kinds(there) == kinds(here)
    groups = [Counter(m.motion.group for m in found.modes) for found in (here, there)]
    assert groups[0] == groups[1]
    known = [Counter(t.kinds for t in found.transitions) for found in (here, there)]
    assert known[0] == known[1]


@pytest.mark.parametrize("name", ["3-upu-tsai-120", "tricept"])
def test_a_robot_elsewhere_has_the_same_system_and_modes_in_the_same_order(name: str) -> None:
    here = found_modes(name)
    far = tuple(map(Fraction, (10**6, -2 * 10**6, "1000000.1")))
    there = nag.modes(moved(robot(name), (1, 0, 0, 0), far, Fraction(1)))
    assert there.model.system == here.model.system
    assert there.model.origin == tuple(a + b for a, b in zip(here.model.origin, far, strict=True))
    assert there.transitions == here.transitions
    back = tuple(-c for c in far)
    for a, b in zip(here.modes, there.modes, strict=True):
        assert a.component == b.component
        told = forms_about_origin((*b.linear, *b.quadratic), back)
        assert set(told) == {*a.linear, *a.quadratic}


@pytest.mark.parametrize("name", ["RPS", "RRR", "CS", "PRRR"])
def test_forms_about_another_origin_are_those_of_the_leg_there(name: str) -> None:
    leg, place = CHAINS[name], (Fraction(3), Fraction(-1, 2), Fraction(10**6))
    joints = [
        replace(j, point=tuple(x + c for x, c in zip(j.point, place, strict=True)))
        for j in leg.joints
    ]
    there = image_of_chain(replace(leg, joints=tuple(joints)).elements(), np.random.default_rng(0))
    here = image_of_chain(leg.elements(), np.random.default_rng(0))
    assert forms_about_origin(here.forms, place) == there.forms


def test_modes_say_in_words_what_they_are() -> None:
    words = Counter(str(m.motion) for m in found_modes("3-upu-snu").modes)
    assert words == {
        "translation": 1,
        "translation, turned by 180 degrees about (1, 1, 1)": 1,
        "planar motion normal to (1, 1, 1)": 1,
        "planar motion normal to (1, 1, 1), turned over": 1,
        "spherical motion about the point (0, 0, 0)": 1,
        "turns about two directions, with 1 translation": 4,
    }
    (plane,) = found_modes("3-rrr-planar").modes
    assert str(plane.motion) == "planar motion normal to (1, 1, 1)"
    here, over = found_modes("quadrupteron").modes
    assert str(over.motion) == f"{here.motion}, turned over"


def test_conjugate_modes_are_told_from_real_ones() -> None:
    found = found_modes("3-upu-snu")
    pairs = [(i, m.conjugate) for i, m in enumerate(found.modes) if m.conjugate is not None]
    assert pairs == [(7, 8), (8, 7)]
    assert all((m.reality is ModeReality.REAL) == (i < 7) for i, m in enumerate(found.modes))
    assert all(m.really_reached for m in found.modes[:7])


def test_what_is_said_of_a_complex_mode_in_words_says_that_it_is_complex() -> None:
    found = found_modes("3-upu-snu")
    assert [", of complex poses" in m.motion_text for m in found.modes] == [False] * 7 + [True] * 2
    assert "7 of them real, 2 complex" in found.answer
    texts = dict(found.mode_rows())
    assert "no real poses but some of those where it meets mode 9" in texts["mode 8"]
    assert "no real motion along 8 and 9" in dict(found.tail())["reference"]


def test_linear_modes_are_given_by_forms_that_satisfy_the_legs_exactly() -> None:
    for mode in found_modes("3-upu-tsai").modes[:4]:
        assert mode.is_linear
        units = [tuple(int(i == j) for j in range(8)) for i in range(8)]
        rows = [[f.terms.get(e, Fraction(0)) for e in units] for f in mode.linear]
        basis = null_space(rows, 8)
        for f in found_modes("3-upu-tsai").model.forms:
            for k in range(20):
                weights = [Fraction(k**i % 7 - 3) for i in range(len(basis))]
                point = [
                    sum(w * v[i] for w, v in zip(weights, basis, strict=True)) for i in range(8)
                ]
                assert f(point) == 0


def test_transitions_of_linear_modes_are_those_that_paths_find() -> None:
    found = found_modes("3-upu-snu")
    exact = {t.modes: t.kinds for t in found.transitions}
    system = found.decomposition.system
    for i, j in ((0, 1), (0, 4), (2, 5), (3, 4)):
        met = intersect_components(system, found.modes[i].component, found.modes[j].component)
        assert met.complete
        assert tuple((c.dimension, c.degree) for c in met.components) == exact.get((i, j), ())


def test_a_leg_reaches_its_poses_and_no_others() -> None:
    rng = np.random.default_rng(5)
    for name in ("RPS", "RRR", "UU"):
        elements = CHAINS[name].elements()
        poses = []
        for _ in range(4):
            pose = np.array([1.0, 0, 0, 0, 0, 0, 0, 0])
            for e in elements:
                weights = rng.standard_normal(len(e.generators))
                own = np.array([[float(c) for part in g for c in part] for g in e.generators])
                pose = multiply_poses(pose, weights @ own)
            poses.append(pose)
        assert (reach_poses([elements], np.array(poses), 3.0, rng) < REACHED).all()
        other = rng.standard_normal((3, 8))
        other[:, 4] = -(other[:, 1:4] * other[:, 5:]).sum(axis=1) / other[:, 0]
        assert (reach_poses([elements], other, 3.0, rng) > 1e-3).all()


def test_one_real_pose_that_all_legs_reach_is_enough() -> None:
    def slide(axis: tuple) -> tuple[Element, ...]:
        return chain(("prismatic", {"axis": axis})).elements()

    poses = np.zeros((3, 8))
    poses[:, 0] = 1
    poses[0, 5:] = poses[1, 5] = poses[2, 6] = 1
    along = [slide(X), slide((2, 0, 0))]
    rng = np.random.default_rng(6)
    found = reach_poses(along, poses, 1.0, rng, real=True, one=True)
    assert (found < REACHED).tolist() == [[False] * 2, [True] * 2, [False] * 2]
    # No pose is reached by both of these, and each reaches its own.
    found = reach_poses([slide(X), slide(Y)], poses, 1.0, rng, real=True, one=True)
    assert (found < REACHED).tolist() == [[False] * 2, [True, False], [False, True]]


UPRIGHT = chain(
    ("universal", at((3, 0, 0), Z, Y)), ("prismatic", {"axis": (-2, 0, 4)}),
    ("universal", at((1, 0, 4), Y, Z)),
)  # fmt: skip


def isotropic_pose(leg: Leg, by: complex) -> np.ndarray:
    """A pose at which the leg's form vanishes; the outer axes differ by (1, i, 0) and by more."""
    pose = np.array([0.7, 1j + by, 1, 0.4, 0, 0.3, -0.2, 0.5], dtype=complex)
    pose[4] = -pose[1:4] @ pose[5:] / pose[0]
    (form,) = image_of_chain(leg.elements(), np.random.default_rng(0)).forms
    # In the direction of x both equations are of the second degree.
    along = np.array([0, 0, 0, 0, -pose[1] / pose[0], 1, 0, 0])
    values = [complex(form(list(pose + t * along))) for t in (0, 1, -1)]
    slope, bend = (values[1] - values[2]) / 2, (values[1] + values[2]) / 2 - values[0]
    roots = np.roots([bend, slope, values[0]] if abs(bend) > 1e-12 else [slope, values[0]])
    return pose + roots[0] * along


@pytest.mark.parametrize("by", [0.0, 1e-3])
def test_a_leg_whose_outer_axes_differ_by_an_isotropic_vector_comes_near_only(by: float) -> None:
    elements, rng = UPRIGHT.elements(), np.random.default_rng(8)
    pose = isotropic_pose(UPRIGHT, by)
    residuals = reach_poses([elements], pose[None], 4.0, rng)
    assert is_isotropic_limit(elements, pose) == (not by)
    assert (residuals[0, 0] < REACHED) == bool(by)


def test_a_leg_has_limits_where_its_middle_axis_makes_equal_angles_with_the_outer_ones() -> None:
    # The pose takes (0, 3, 4) to (0, 0, 5) and that to another vector by an isotropic one.
    turn = np.array([3.0, 1, 0, 0, 0, 0, 0, 0])
    pose = multiply_poses(isotropic_pose(UPRIGHT, 0), turn)
    for middle, has in (((0, 1, 3), True), ((0, 1, 1), False), ((1, 0, 0), True)):
        outer = [("revolute", at((0, 0, 0), Z)), ("revolute", at((1, 1, 0), (0, 3, 4)))]
        leg = chain(outer[0], ("revolute", at((1, 0, 2), middle)), outer[1])
        assert is_isotropic_limit(leg.elements(), pose) == has
    assert not is_isotropic_limit(CHAINS["UPS"].elements(), pose)


@pytest.mark.parametrize("seed", range(2))
def test_components_that_legs_do_not_reach_leave_the_answer_complete(seed: int) -> None:
    found = found_modes("4-upu-upright", seed)
    limits = [(m.dimension, m.degree, m.limits) for m in found.modes if m.limits]
    assert limits == [(3, 1, (0, 1, 2, 3))] * 2
    assert kinds(found) == {(4, 2): 2, (3, 1): 2}
    assert all(m.reached for m in found.modes if not m.limits)
    assert found.answer.startswith("2 operation modes, each of dimension 4, degree 2; and 2 ")


@pytest.mark.parametrize("real", [True, False])
def test_a_pose_across_all_that_a_leg_reaches_is_not_reached(real: bool) -> None:
    slides = chain(*[("prismatic", {"axis": axis}) for axis in (X, X, Y)]).elements()
    half_turns = np.eye(8)[1:4]
    rng = np.random.default_rng(7)
    found = reach_poses([slides], half_turns, 1.0, rng, real=real)
    assert (found >= 1).all()


def test_pitches_of_screw_systems_are_those_of_their_axes() -> None:
    twists = np.zeros((3, 6))
    for i, (axis, point, pitch) in enumerate(((X, (0, 0, 0), 2), (Y, (0, 0, 0), 5), (Z, Z, -1))):
        twists[i] = [*axis, *(np.cross(point, axis) + pitch * np.array(axis))]
    assert screw_system(twists, 3.0).pitches == pytest.approx((-3, 6, 15))
    slide = np.array([[0, 0, 0, 0, 0, 1.0]])
    with_slide = screw_system(np.vstack([twists[:2], slide]), 1.0)
    assert (with_slide.rank, with_slide.turning) == (3, 2)
    assert with_slide.pitches == pytest.approx((2, 5))
    # A slide along an axis makes its pitch any.
    assert screw_system(np.vstack([twists[2:], slide]), 1.0).pitches == ()


def turns_and_slides(turning: list[tuple], slides: list[tuple]) -> np.ndarray:
    """An orthonormal basis of twists through the origin."""
    rows = [(*w, 0, 0, 0) for w in turning] + [(0, 0, 0, *v) for v in slides]
    return np.linalg.svd(np.array(rows, dtype=complex), full_matrices=False)[2]


@pytest.mark.parametrize(
    ("twists", "real"),
    [
        (turns_and_slides([Z], [X, Y]), True),
        (turns_and_slides([(1, 1j, 0)], [(1, 1j, 0), Z]), False),
        (turns_and_slides([(3, 4j, 5)], [(4j, -3, 0), (5, 0, -3)]), False),
        (turns_and_slides([(1j, 0, 0)], [Y, Z]), True),
        (turns_and_slides([], [(1, 1j, 0)]), False),
        (turns_and_slides([Y], [X, Y, Z]), True),
        (turns_and_slides([(0, 1, 1j)], [X, Y, Z]), False),
    ],
)
def test_groups_about_directions_that_are_not_real_have_no_name(
    twists: np.ndarray, real: bool
) -> None:
    standing = np.eye(8, dtype=complex)[:1]
    assert bool(motion_of(standing, [twists, twists], 1.0).group) == real


def test_a_complex_orientation_is_told() -> None:
    pose = np.zeros((1, 8), dtype=complex)
    pose[0, [0, 3]] = 5 / 4, 3j / 4
    twists = turns_and_slides([], [X, Y, Z])
    assert str(motion_of(pose, [twists, twists], 1.0)) == "translation, turned by a complex angle"


def test_a_screw_system_that_changes_is_no_group() -> None:
    pose = np.array([[1.0, 0, 0, 0, 0, 0, 0, 0]])
    about = [np.array([[*axis, 0, 0, 0]], dtype=float) for axis in (X, X, Y)]
    assert motion_of(pose, about[:2], 1.0).group == "rotation"
    assert motion_of(pose, about, 1.0).group == ""


def test_legs_are_what_joins_platform_and_ground() -> None:
    found = parallel_robot(robot("exechon"))
    assert found.platform == "platform"
    assert [leg.letters for leg in found.legs] == ["UPR", "UPR", "SPR"]
    hanging = Joint("T", "revolute", ("link1a", "tool"), (0, 0, 0), X)
    with_tool = Mechanism("base", (*robot("exechon").joints, hanging))
    again = parallel_robot(with_tool)
    assert [leg.letters for leg in again.legs] == ["UPR", "UPR", "SPR"]
    assert [j.name for j in again.aside] == ["T"]


def test_a_coupler_of_a_loop_may_be_named_as_the_platform() -> None:
    found = nag.modes(read_case(CASES / "bennett.toml").mechanism, "B2")
    assert kinds(found) == {(1, 2): 1}
    assert found.dimension_at_reference == 1


def two_platforms() -> Mechanism:
    joints = [
        Joint(f"{body}{k}", "spherical", ("base", body), (k, k * k, i))
        for i, body in enumerate(("left", "right"))
        for k in range(3)
    ]
    return Mechanism("base", tuple(joints))


def with_parallelograms() -> Mechanism:
    """Three legs, each an arm and a parallelogram."""
    joints = []
    for k, axis in enumerate((X, Y, Z)):
        p, q = (axis[2], axis[0], axis[1]), tuple(cross(axis, (axis[2], axis[0], axis[1])))
        near, far = q, tuple(a + b for a, b in zip(p, q, strict=True))
        joints += [
            Joint(f"R{k}", "revolute", ("base", f"arm{k}"), (0, 0, 0), axis),
            Joint(f"A{k}", "revolute", (f"arm{k}", f"left{k}"), near, axis),
            Joint(f"B{k}", "revolute", (f"arm{k}", f"right{k}"), far, axis),
            Joint(f"C{k}", "revolute", (f"left{k}", "plate"), tuple(2 * x for x in near), axis),
            Joint(f"D{k}", "revolute", (f"right{k}", "plate"), tuple(2 * x for x in far), axis),
        ]
    return Mechanism("base", tuple(joints))


@pytest.mark.parametrize(
    ("make", "platform", "message"),
    [
        (lambda: read_case(CASES / "bennett.toml").mechanism, None, "no body has 3 legs"),
        (lambda: robot("3-rps"), "base", "is the ground"),
        (lambda: robot("3-rps"), "hand", "is no body"),
        (two_platforms, None, "bodies left and right have 3 legs each"),
        (with_parallelograms, None, "leg .* has loops of its own"),
    ],
)
def test_what_is_no_robot_is_refused(
    make: Callable[[], Mechanism], platform: str | None, message: str
) -> None:
    with pytest.raises(MechanismError, match=message):
        nag.modes(make(), platform)


ROOT_3 = square_root(Fraction(3))


def at_120_degrees(*leg: tuple[str, dict]) -> Mechanism:
    """A leg three times, turned about z."""
    joints = []
    for k, (c, s) in enumerate(
        [(1, 0), (Fraction(-1, 2), ROOT_3 / 2), (Fraction(-1, 2), -ROOT_3 / 2)]
    ):
        bodies = ["base", *(f"L{k}{i}" for i in range(len(leg) - 1)), "platform"]
        for i, (kind, own) in enumerate(leg):
            turned = {
                name: (c * x - s * y, s * x + c * y, z * 1) for name, (x, y, z) in own.items()
            }
            joints.append(Joint(f"J{k}{i}", kind, (bodies[i], bodies[i + 1]), **turned))
    return Mechanism("base", tuple(joints))


def rps_at_120_degrees() -> Mechanism:
    return at_120_degrees(
        ("revolute", {"point": (2, 0, 0), "axis": Y}),
        ("prismatic", {"axis": (-1, 0, 3)}),
        ("spherical", {"point": (1, 0, 3)}),
    )


def tsai_at_120_degrees() -> Mechanism:
    return at_120_degrees(
        ("universal", {"point": (3, 0, 0), "axis": Y, "second_axis": (2, 0, 1)}),
        ("prismatic", {"axis": (-1, 0, 2)}),
        ("universal", {"point": (1, 0, 4), "axis": (2, 0, 1), "second_axis": Y}),
    )


def radial_at_120_degrees() -> Mechanism:
    return at_120_degrees(
        ("universal", {"point": (2, 0, 0), "axis": X, "second_axis": Y}),
        ("prismatic", {"axis": (-1, 0, 3)}),
        ("universal", {"point": (1, 0, 3), "axis": Y, "second_axis": X}),
    )


@pytest.mark.parametrize(
    ("make", "known"),
    [
        (rps_at_120_degrees, {(3, 7): 2}),
        (tsai_at_120_degrees, {(3, 1): 4, (3, 11): 1}),
        pytest.param(radial_at_120_degrees, {(3, 1): 7, (3, 4): 2}, marks=pytest.mark.slow),
    ],
)
def test_robots_drawn_at_120_degrees_have_the_modes_of_rational_drawings(
    make: Callable[[], Mechanism], known: dict[tuple[int, int], int]
) -> None:
    assert kinds(nag.modes(make())) == Counter(known)


def test_a_mode_is_known_to_be_real_where_newtons_method_for_the_legs_leads_to_others() -> None:
    robot = rps_at_120_degrees()
    universal = replace(robot.joints[2], type="universal", axis=Y, second_axis=X)
    found = nag.modes(replace(robot, joints=(*robot.joints[:2], universal, *robot.joints[3:])))
    # By minimal primes over Q(sqrt 3) in Singular; each is parametrised by real coordinates.
    assert kinds(found) == {(2, 2): 2, (2, 4): 2}
    assert all(m.reality is ModeReality.REAL for m in found.modes)


def test_forms_of_a_leg_with_square_roots_vanish_at_its_poses_exactly() -> None:
    root_2 = square_root(Fraction(2))
    leg = chain(
        ("revolute", {"point": (root_2, 0, 1), "axis": (1, ROOT_3, 0)}),
        ("prismatic", {"axis": (ROOT_3, -1, 3)}),
        ("spherical", {"point": (1, root_2 + ROOT_3, 3)}),
    )
    elements = leg.elements()
    image = image_of_chain(elements, np.random.default_rng(0))
    assert image.cuts and [f.degree for f in image.forms] == [2]
    rng = np.random.default_rng(1)
    for _ in range(3):
        values = {
            e.factor: tuple(Fraction(int(c)) for c in rng.integers(-9, 10, len(e.generators)))
            for e in elements
            if e.factor is not None
        }
        pose = [x for part in displacement(elements, values, lambda c: c) for x in part]
        assert all(f(pose) == 0 for f in image.forms)
        assert any(f([*pose[:7], pose[7] + 1]) != 0 for f in image.forms)


def heptagon_robot() -> Mechanism:
    """Four UPU legs at corners of regular heptagons, their outer axes upright."""
    joints = []
    for k in (0, 1, 2, 4):
        turn = f"({2 * k}*pi/7)"
        middle = (f"-sin{turn}", f"cos{turn}", 0)
        joints += [
            Joint(
                f"U{k}",
                "universal",
                ("base", f"low{k}"),
                (f"3*cos{turn}", f"3*sin{turn}", 0),
                Z,
                middle,
            ),
            Joint(
                f"P{k}",
                "prismatic",
                (f"low{k}", f"high{k}"),
                axis=(f"-2*cos{turn}", f"-2*sin{turn}", 4),
            ),
            Joint(
                f"V{k}",
                "universal",
                (f"high{k}", "plate"),
                (f"cos{turn}", f"sin{turn}", 4),
                middle,
                Z,
            ),
        ]
    return Mechanism("base", tuple(joints))


def test_a_robot_with_cosines_has_the_modes_of_one_with_rational_numbers() -> None:
    found, alike = nag.modes(heptagon_robot()), found_modes("4-upu-upright")
    assert kinds(found) == kinds(alike)
    assert [(m.limits, m.reality) for m in found.modes] == [
        (m.limits, m.reality) for m in alike.modes
    ]
    assert [str(m.motion) for m in found.modes[:2]] == [str(m.motion) for m in alike.modes[:2]]
    names = [f"{c}{k}" for c in "xy" for k in range(4)]
    linear = [{f.text(names) for f in m.linear} for m in found.modes[:2]]
    assert linear == [{"x1", "x2"}, {"x0", "x3"}]


def test_the_forms_of_a_leg_with_cosines_vanish_at_its_poses() -> None:
    legs = parallel_robot(heptagon_robot()).legs
    elements = legs[1].elements()
    (form,) = image_of_chain(elements, np.random.default_rng(0)).forms
    values = {e.factor: [Fraction(1), Fraction(k, 3)] for k, e in enumerate(elements, 1)}
    pose = [x for part in displacement(elements, values, lambda c: c) for x in part]
    assert form(pose) == 0
    assert form([*pose[:5], pose[5] + 1, *pose[6:]]) != 0


def test_robots_in_no_field_of_cosines_are_refused() -> None:
    joints = [replace(j, point=("cos(1)", *j.point[1:])) for j in robot("3-rrr-planar").joints]
    with pytest.raises(MechanismError, match="sines and cosines of rational multiples of pi"):
        nag.modes(Mechanism("base", tuple(joints)))


def test_modes_that_take_longer_than_the_budget_are_not_looked_for() -> None:
    found = nag.modes(robot("3-rps"), budget=0)
    assert not found.complete and not found.modes
    assert found.dimension_at_reference is None
    assert found.answer == "no operation mode is known"
    (note,) = found.notes
    assert "a budget of 0 s" in note
    with pytest.raises(NagError, match="budget"):
        nag.modes(robot("3-rps"), budget=-1)


def test_the_command_says_that_an_answer_is_incomplete_for_its_budget(
    capsys: pytest.CaptureFixture[str],
) -> None:
    case = str(CASES / "robots" / "3-rps.toml")
    assert main(["modes", case, "--budget", "0"]) == 1
    assert "INCOMPLETE" in capsys.readouterr().out


def test_the_command_tells_bad_input_in_one_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    case = str(CASES / "robots" / "tripteron.toml")
    for words in (
        [case, "--platform", "hand"],
        [str(CASES / "literature" / "arcs.toml")],
        [str(CASES / "bennett.toml")],
    ):
        assert main(["modes", *words, "--quiet"]) == 2
        told = capsys.readouterr().err
        assert told.count("\n") == 1
        assert words[0] in told


def test_the_command_prints_modes_and_transitions(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["modes", str(CASES / "robots" / "3-rps.toml"), "--quiet"]) == 0
    text = capsys.readouterr().out
    assert "2 operation modes, each of dimension 3, degree 7" in text
    assert "mode 1      x1 + x2 + x3 = 0" in text
    assert "transition  1 and 2: dimension 2, degree 4" in text
    assert "agrees with what is known" in text
    assert COORDINATES[0] in text


def test_modes_are_printed_before_transitions_are_looked_for_and_once(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    case = str(CASES / "robots" / "3-rps.toml")
    assert main(["modes", case, "--quiet"]) == 0
    whole = capsys.readouterr().out

    def ended(*_: object) -> OperationModes:
        raise KeyboardInterrupt

    monkeypatch.setattr(operation_modes, "find_transitions", ended)
    assert main(["modes", case, "--quiet"]) == 130
    early = capsys.readouterr().out
    assert whole.startswith(early)
    assert "2 operation modes" in early and "\nmode 2 " in early and "transition" not in early


def test_what_is_not_found_is_said_only_of_modes_without_a_real_pose_that_is_known() -> None:
    found = found_modes("3-rrr-planar")
    (mode,) = found.moving
    assert mode.through_reference
    nowhere = (1.0,) * len(mode.residuals)
    for through, said in ((True, False), (False, True)):
        other = replace(mode, through_reference=through, real_residuals=nowhere)
        ((_, text),) = replace(found, modes=(other,)).mode_rows()
        assert ("no real pose" in text) == said


def inclined_upu() -> nag.Mechanism:
    """A 3-UPU robot with upright legs, whose middle axes are not normal to the outer ones."""
    joints = []
    corners = ((1, 0), (Fraction(-3, 5), Fraction(4, 5)), (0, -1))
    for i, (c, s) in enumerate(corners):
        foot, along, up = (3 * c, 3 * s, 0), (-s, c, 0), (0, 0, 1)
        middle = (c - Fraction(2, 5) * s, s + Fraction(2, 5) * c, 0)
        head, first, second = (*foot[:2], 4), ("base", f"a{i}"), (f"b{i}", "platform")
        joints += [
            nag.Joint(f"A{i}", "universal", first, foot, along, second_axis=middle),
            nag.Joint(f"P{i}", "prismatic", (f"a{i}", f"b{i}"), axis=up),
            nag.Joint(f"B{i}", "universal", second, head, middle, second_axis=along),
        ]
    return nag.Mechanism("base", joints)


def test_quartics_of_legs_are_singular_along_translations_alone() -> None:
    model = platform_model(parallel_robot(inclined_upu()), np.random.default_rng(0))
    shift, turn = np.array([1.0, 0, 0, 0, 0, 2, -3, 5]), np.array([1.0, 2, -1, 3, 0, 0, 0, 0])
    for leg in model.legs:
        assert [f.degree for f in leg.image.forms] == [4]
        assert leg.is_singular_at(shift) and not leg.is_singular_at(turn)


def test_what_a_multiplicity_comes_from_is_said() -> None:
    found = found_modes("3-rrr-planar")
    (mode,) = found.moving
    multiple = replace(mode, component=replace(mode.component, multiplicity=4))
    for singular, said in (((), "touch all along it"), ((0, 2), "singular all along it")):
        other = replace(found, modes=(replace(multiple, singular_legs=singular),))
        (text,) = [text for label, text in other.tail() if label == "multiple"]
        assert said in text and text.startswith("mode 1: multiplicity 4 ")
    assert not any(label == "multiple" for label, _ in found.tail())


def test_modes_that_meet_are_not_said_to_be_open_whether_they_do() -> None:
    some, none = (Transition((0, 1), kinds, "no end") for kinds in (((0, 1),) * 16, ()))
    assert some.open_text == "modes 1 and 2 meet, and in what all is not known: no end"
    assert none.open_text == "whether modes 1 and 2 meet is not known: no end"
    found = replace(found_modes("3-rps"), transitions=(some, none))
    texts = [text for label, text in found.tail() if label == "transition"]
    assert texts[0].startswith("1 and 2: they meet, and in what all is not known; found are ")
    assert texts[0].endswith("dimension 0, degree 1 (16 times)")
    assert texts[1] == "1 and 2: not known whether they meet"


@pytest.mark.parametrize("seed", [1, 5])
def test_real_poses_of_modes_are_found_where_most_are_beyond_reach(seed: int) -> None:
    """4-PRRR+R, upright and turned over: seeds for which no pose taken at random is reached."""
    ends = (
        (X, (2, 5, 4), (2, 3, 6), (2, 1, 1)),
        (Y, (4, 2, 5), (6, 2, 3), (1, 2, 1)),
        (X, (-3, -4, 3), (-3, -2, 5), (-3, 1, 1)),
        (Y, (-5, -2, 4), (-3, -2, 6), (1, -2, 1)),
    )
    joints = []
    for i, (axis, *points) in enumerate(ends):
        bodies = ("base", *(f"{part}{i}" for part in "abcd"), "platform")
        joints.append(Joint(f"P{i}", "prismatic", bodies[:2], None, axis))
        pairs = zip(points, bodies[1:4], bodies[2:5], strict=True)
        joints += [
            Joint(f"R{i}{k}", "revolute", (one, other), at, axis)
            for k, (at, one, other) in enumerate(pairs)
        ]
        joints.append(Joint(f"U{i}", "revolute", bodies[4:], points[-1], Z))
    found = nag.modes(Mechanism("base", tuple(joints)), seed=seed)
    assert [(m.dimension, m.through_reference) for m in found.moving] == [(4, True), (4, False)]
    over = found.moving[1]
    assert over.really_reached and max(over.real_residuals) < REACHED
    # The pose is on the mode: it turns over, and is a displacement.
    assert np.abs(over.real_pose[[0, 3]]).max() < 1e-8
    assert abs(over.real_pose[:4] @ over.real_pose[4:]) < 1e-8


@pytest.mark.parametrize("name", ["3-rps", "3-upu-tsai", "3-rrr-spherical"])
def test_a_robot_far_from_the_origin_has_the_modes_that_it_has_near_it(name: str) -> None:
    at = (10**6, -2 * 10**6, 10**6)
    near = robot(name)
    joints = (
        j if j.point is None else replace(j, point=tuple(map(sum, zip(j.point, at, strict=True))))
        for j in near.joints
    )
    far = nag.modes(replace(near, joints=tuple(joints)))
    here = found_modes(name)
    assert far.complete and kinds(far) == kinds(here)
    assert [t.kinds for t in far.transitions] == [t.kinds for t in here.transitions]
    for mode, known in zip(far.modes, here.modes, strict=True):
        assert (mode.motion.group, mode.motion.start) == (known.motion.group, known.motion.start)
        if mode.screws is not None and known.screws is not None:
            assert mode.screws.pitches == pytest.approx(known.screws.pitches, rel=1e-6)
        # Equations and the pose are those in the coordinates that are given.
        pose = mode.real_pose
        for form in (*mode.linear, *mode.quadratic):
            size = sum(abs(form.terms[e]) * 3e6**form.degree for e in form.terms)
            assert abs(float(form(pose.tolist()))) < 1e-12 * float(size)
    if name == "3-rrr-spherical":
        place = far.modes[0].motion.place
        assert place == "about the point (1e+06, -2e+06, 1e+06)"


def test_the_model_of_a_robot_says_that_its_platform_may_be_asked_about_alone(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name, said in (("robots/3-rrs", True), ("robots/tricept", True), ("bennett", False)):
        assert main(["model", str(CASES / f"{name}.toml")]) == 0
        assert ("  P: the poses of" in capsys.readouterr().out) == said


@pytest.mark.parametrize("factor", [Fraction(1, 300), Fraction(300)])
def test_legs_reach_the_modes_of_a_robot_in_any_unit(factor: Fraction) -> None:
    made = robot("3-rps")
    joints = tuple(
        replace(j, point=tuple(factor * x for x in j.point)) if j.point is not None else j
        for j in made.joints
    )
    found = nag.modes(replace(made, joints=joints))
    assert found.complete
    assert [(m.dimension, m.degree) for m in found.modes] == [(3, 7), (3, 7)]


def test_frames_of_modes_hold_texts_and_numbers() -> None:
    frame = nag.modes(CASES / "robots" / "tripteron.toml").to_dataframe()
    assert frame[["motion", "reality"]].to_numpy().tolist() == [["translation", "real"]]
    assert {type(x) for x in frame["motion"]} == {type(x) for x in frame["reality"]} == {str}
