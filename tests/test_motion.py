"""Motions: all bodies along real curves, joints that fit, angles that are known exactly."""

from __future__ import annotations

import cmath
import json
import math
import random
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from linkages import CASES
from traced_curves import trace_loop

import nag
from nag.algebra.evaluation import Evaluator
from nag.errors import NagError
from nag.kinematics import path
from nag.kinematics.driven import Drive, Pose, assemblies_on, read_drives, read_poses
from nag.kinematics.joint_values import joint_errors, joint_values
from nag.kinematics.motion import Motion, MotionError, _real_curve, motion_of
from nag.kinematics.path import Curve, sample_path
from nag.kinematics.poses import Poses, pose_distances, pose_steps, turn_product
from nag.kinematics.scene import Scene, SceneJoint, scene_of
from nag.kinematics.shown import rigid_text
from nag.kinematics.turning_points import values_along
from nag.kinematics.walks import walks_of
from nag.mechanism.linkage import Link, Linkage, linkage_model
from nag.mechanism.problem import Problem, in_real_coordinates, problem_of
from nag.mechanism.real_assemblies import real_assemblies
from nag.numerics.double_ranks import SINGULAR
from nag.pictures.motion_picture import point_of
from nag.real.curve import (
    PictureVerdict,
    PieceKind,
    RealCurve,
    RealEdge,
    RealPiece,
    RealVertex,
    VertexKind,
)
from nag.real.spherical_chart import SphericalChart
from nag.tracking.run import DEFAULT_RUN

ROOT = Path(__file__).parent.parent
# Joints as seen from both bodies, and loops that return, in sizes and radians.
FIT = 1e-12
LOOPS = [
    ("bennett", "H"),
    ("bennett", "E"),
    ("bricard-cube", "H"),
    ("planar/four-bar", "auto"),
    ("planar/slider-crank", "E"),
    ("planar/slider-crank", "H"),
    ("planar/elliptic-trammel", "auto"),
    ("planar/watt-six-bar", "auto"),
    ("planar/four-bar-kite", "auto"),
    ("spatial/rssr", "S"),
    ("spatial/universal-shaft", "H"),
    ("spatial/goldberg-5r", "H"),
    ("spherical/four-bar", "auto"),
]


def read_problem(name: str, formulation: str = "auto") -> Problem:
    case = nag.read_case(ROOT / "cases" / f"{name}.toml")
    return in_real_coordinates(problem_of(case, formulation=formulation))


def start_of(problem: Problem) -> np.ndarray:
    """A smooth real point."""
    if problem.reference is not None:
        return np.array([float(x) for x in problem.reference])
    return next(real_assemblies(problem.parts)).x


@pytest.fixture(scope="module")
def moved():
    """Motions along the loop through a known point, each worked out once."""
    known: dict[tuple[str, str, int], Motion] = {}

    def move(name: str, formulation: str = "auto", samples: int = 120) -> Motion:
        key = (name, formulation, samples)
        if key not in known:
            problem = read_problem(name, formulation)
            curve = trace_loop(problem, start_of(problem))
            known[key] = motion_of(problem, samples=samples, curve_of=lambda _: curve)
        return known[key]

    return move


@pytest.mark.parametrize(("name", "formulation"), LOOPS)
def test_joints_fit_as_both_bodies_see_them_and_loops_return(moved, name, formulation) -> None:
    motion = moved(name, formulation)
    (circuit,) = motion.circuits
    assert circuit.closed and len(circuit) == 121
    poses = circuit.poses
    assert joint_errors(motion.scene, poses).max() < FIT
    assert np.abs(np.linalg.norm(poses.turns, axis=-1) - 1).max() < FIT
    gap = np.abs(poses.places[:, 0] - poses.places[:, -1]).max() / motion.scene.size
    assert gap < FIT
    back = np.abs((poses.turns[:, 0] * poses.turns[:, -1]).sum(axis=-1))
    assert np.abs(back - 1).max() < FIT
    # Neighbouring samples are near each other, quaternions included.
    assert (poses.turns[:, 1:] * poses.turns[:, :-1]).sum(axis=-1).min() > 0.5


@pytest.mark.parametrize(("name", "formulation"), LOOPS)
def test_samples_are_equally_far_from_each_other(moved, name, formulation) -> None:
    motion = moved(name, formulation, samples=720)
    (circuit,) = motion.circuits
    steps = pose_steps(circuit.poses, motion.scene.measure)
    assert steps.max() - steps.min() < 0.01 * steps.mean()
    assert np.diff(circuit.arc) == pytest.approx(np.full(720, circuit.length / 720))


@pytest.mark.parametrize("name", ["bennett", "planar/slider-crank"])
def test_two_formulations_give_the_same_motion_point_for_point(moved, name) -> None:
    one, other = (moved(name, f).circuits[0] for f in ("E", "H"))
    assert one.length == pytest.approx(other.length, rel=1e-11)
    assert one.from_reference and other.from_reference
    forwards = other.values.values
    backwards = forwards[::-1] - forwards[-1] + forwards[0]
    own = one.values.values
    # Where they begin they are the same; which way they run is not said.
    best = min(np.abs(own - x).max() for x in (forwards, backwards))
    assert best < 1e-10


@pytest.mark.parametrize("name", ["bennett", "planar/slider-crank"])
def test_at_equal_angles_of_a_joint_two_formulations_have_the_same_configurations(
    moved, name
) -> None:
    found = []
    for formulation in ("E", "H"):
        motion, problem = moved(name, formulation), read_problem(name, formulation)
        curve = Curve(motion.curves[0], problem.system, motion.scene)
        (walk,) = walks_of(curve.real, curve.coordinates)
        path = sample_path(curve, walk, 121)
        values = values_along(path)
        crank = values.coordinates[0].name
        driven = [
            assemblies_on(path, values, Drive(crank, angle), 1, np.inf)
            for angle in np.linspace(-3, 3, 12)
        ]
        found.append([np.array([each.values for each in own]) for own in driven])
    for one, other in zip(*found, strict=True):
        assert len(one) and len(other)
        gaps = np.abs(np.exp(1j * one[:, None]) - np.exp(1j * other[None])).max(axis=2)
        assert gaps.min(axis=0).max() < 1e-9 and gaps.min(axis=1).max() < 1e-9


# Bennett's, Goldberg's, Myard's, Schatz' and three of Bricard's linkages, Sarrus', and a four-bar
# of the plane whose bodies turn in space.
IN_SPACE = [
    "bennett",
    "spatial/bennett",
    "spatial/goldberg-5r",
    "spatial/myard-5r",
    "spatial/schatz",
    "spatial/bricard-line-symmetric",
    "spatial/bricard-plane-symmetric",
    "bricard-cube",
    "spatial/sarrus",
    "spatial/planar-four-bar",
]


def points_along(name: str, problem: Problem) -> tuple[np.ndarray, Poses]:
    """Samples of a motion, its points and where the bodies are at each."""
    if name == "spatial/sarrus":
        # Circuits cross: no loop is traced past that.
        circuit = motion_of(problem, circuit="all", samples=30).circuits[0]
        return circuit.points, circuit.poses
    real = trace_loop(problem, start_of(problem), step=0.02)
    curve = Curve(real, problem.system, scene_of(problem))
    (walk,) = walks_of(real, curve.coordinates)
    path = sample_path(curve, walk, 31)
    return curve.coordinates.points(path.chart), path.poses


@pytest.mark.parametrize("name", IN_SPACE)
def test_every_point_of_a_motion_in_half_angles_is_one_in_euler_parameters(name: str) -> None:
    halves, euler = (read_problem(name, formulation) for formulation in ("H", "E"))
    points, poses = points_along(name, halves)
    own = np.array([euler_point(halves, euler, x) for x in points])
    equations = Evaluator.of(euler.system.polynomials, euler.system.n)
    assert equations.residuals(own + 0j).max() < FIT
    # No other curve passes: where the motion goes on in half-angles it does in the others.
    n = euler.system.n
    for x in own:
        s = np.linalg.svd(equations.jacobian(x + 0j), compute_uv=False)
        assert s[n - 2] > 1e-4 * s[0] and (len(s) < n or s[n - 1] < FIT * s[0])
    scene = scene_of(euler)
    there = scene.lift(own)
    assert pose_distances(there, poses, scene.measure).max() < FIT
    one, other = (joint_values(*each) for each in ((scene, there), (scene_of(halves), poses)))
    assert np.abs(np.exp(1j * one) - np.exp(1j * other)).max() < FIT


def euler_point(halves: Problem, euler: Problem, point: np.ndarray) -> np.ndarray:
    """The point in Euler parameters, one of each sign, that one in half-angles is."""
    if halves.mechanism is None:
        found = euler.model.of_half_angles(halves.model, [complex(x) for x in point])
    else:
        found = euler.mechanism.project(halves.mechanism.lift(point))
    return np.array([complex(x).real for x in found])


def test_angles_of_bennetts_linkage_have_the_law_that_they_have(moved) -> None:
    # Half-angles of neighbours are in one bilinear relation, so that cotangents of them, counted
    # from a common position, are linear in each other; opposite angles are equal up to sign
    # (Bennett 1914).
    values = moved("bennett", "H").circuits[0].values.values[1:-1]
    x, y = (1 / np.tan(values[:, i] / 2) for i in (0, 1))
    slope = (y[70] - y[10]) / (x[70] - x[10])
    assert np.abs(y - y[10] - slope * (x - x[10])).max() < 1e-9 * np.abs(y).max()
    assert np.abs(values[:, 0] + values[:, 2]).max() < FIT * 100
    assert np.abs(values[:, 1] + values[:, 3]).max() < FIT * 100


def test_joints_of_bennetts_linkage_turn_fully_once(moved) -> None:
    for formulation in "HE":
        circuit = moved("bennett", formulation).circuits[0]
        assert circuit.from_reference
        assert np.abs(circuit.values.values[0]).max() < FIT
        assert [abs(x) for x in circuit.values.turns] == [1, 1, 1, 1]
        assert all(circuit.values.turns_fully(i) for i in range(4))
        assert circuit.values.turning == ()


def test_joints_of_bricards_cube_turn_from_minus_210_to_30_degrees(moved) -> None:
    circuit = moved("bricard-cube", "H").circuits[0]
    ranges = np.degrees(circuit.values.ranges)
    flat = np.abs(ranges - np.array([-210.0, 30.0])).max(axis=1)
    turned = np.abs(ranges - np.array([-30.0, 210.0])).max(axis=1)
    assert np.minimum(flat, turned).max() < 1e-8
    assert len(circuit.values.turning) == 12
    assert not circuit.values.turns.any()


def test_dead_points_of_a_crank_rocker_are_where_crank_and_coupler_are_in_line(moved) -> None:
    # Links 4, 1, 3, 7/2: the rocker turns back where the other end of it is 3 + 1 or 3 - 1 from
    # the crank's pivot.
    circuit = moved("planar/four-bar").circuits[0]
    names = [c.name for c in circuit.values.coordinates]
    angles = [math.acos((16 + 3.5**2 - reach**2) / (2 * 4 * 3.5)) for reach in (3 - 1, 3 + 1)]
    d = names.index("D")
    own = circuit.values.ranges[d]
    assert sorted(np.abs(own)) == pytest.approx(sorted(angles), abs=1e-9)
    assert abs(circuit.values.turns[names.index("A")]) == 1
    assert circuit.values.turns_fully(names.index("A"))
    assert not circuit.values.turns_fully(d)
    # And the coupler's end where the crank is in line with the ground: 4 - 1, 4 + 1.
    c = names.index("C")
    angles = [
        math.pi - math.acos((9 + 3.5**2 - reach**2) / (2 * 3 * 3.5)) for reach in (4 - 1, 4 + 1)
    ]
    away = np.abs(circuit.values.ranges[c])
    assert sorted(away) == pytest.approx(sorted(angles), abs=1e-9)


def test_a_rod_that_turns_about_itself_is_named(moved) -> None:
    motion = moved("spatial/rssr", "S")
    assert motion.freedoms == 2
    assert motion.idle == "rod turns about itself"


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.3, 2.8), st.integers(0, 2**32 - 1))
def test_angles_of_a_universal_joint_are_those_that_it_was_turned_by(
    first: float, second: float, between: float, seed: int
) -> None:
    # Its axes need not be orthogonal.
    rng = np.random.default_rng(seed)
    frame = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    u, v = frame[0], math.cos(between) * frame[0] + math.sin(between) * frame[1]
    one = np.array([1.0, 0, 0, 0])
    joint = SceneJoint("U", "universal", (0, 1), np.zeros((2, 3)), np.array([one, one]), u, v)
    scene = Scene(("a", "b"), 0, (joint,), None, True, {}, (), lambda p: None)
    start = rng.standard_normal(4)
    start /= np.linalg.norm(start)
    turned = turn_product(
        turn_product(start, np.array([math.cos(first / 2), *(math.sin(first / 2) * u)])),
        np.array([math.cos(second / 2), *(math.sin(second / 2) * v)]),
    )
    poses = Poses(np.array([[start], [turned]]), np.zeros((2, 1, 3)))
    assert joint_values(scene, poses)[0] == pytest.approx([first, second], abs=1e-12)
    assert joint_errors(scene, poses)[0, 0] < FIT


def arc(start: int | None, end: int | None, points: list[tuple[float, float]]) -> RealEdge:
    return RealEdge(start, end, np.array(points), np.array(points))


def curve_of(vertices: list[tuple[float, float]], edges: list[RealEdge], *pieces) -> RealCurve:
    made = tuple(RealVertex(VertexKind.SINGULAR, np.array(v)) for v in vertices)
    return RealCurve(("x", "y"), (), made, tuple(edges), tuple(pieces), PictureVerdict.COMPLETE)


# Coordinates of a plane as they are.
PLANE = SphericalChart(2, (), ())


def lemniscate_lobe(sign: float) -> list[tuple[float, float]]:
    """One lobe of (x^2 + y^2)^2 = x^2 - y^2, from the node to the node."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, 81)
    size = np.cos(angles) / (1 + np.sin(angles) ** 2)
    return [(sign * r, r * math.sin(t)) for r, t in zip(size, angles, strict=True)]


def test_a_motion_goes_straight_on_through_a_node() -> None:
    lobes = [arc(0, 0, lemniscate_lobe(s)) for s in (1.0, -1.0)]
    piece = RealPiece(PieceKind.ARC_NETWORK, (0, 1), (0,))
    (walk,) = walks_of(curve_of([(0.0, 0.0)], lobes, piece), PLANE)
    assert walk.closed and len(walk.chart) == 161
    steps = np.diff(np.concatenate([walk.chart, walk.chart[1:2]]), axis=0)
    steps = steps / np.linalg.norm(steps, axis=1, keepdims=True)
    assert (steps[1:] * steps[:-1]).sum(axis=1).min() > 0.98
    assert [v for v, _ in walk.vertices] == [0, 0]


def test_two_circles_that_cross_are_two_motions() -> None:
    angles = np.linspace(0, 2 * np.pi / 3, 30), np.linspace(2 * np.pi / 3, 2 * np.pi, 60)
    high = math.sqrt(3) / 2
    edges = []
    for middle, turn in ((-0.5, -np.pi / 3), (0.5, 2 * np.pi / 3)):
        ends = (1, 0) if middle < 0 else (0, 1)
        for k, own in enumerate(angles):
            points = [(middle + math.cos(a + turn), math.sin(a + turn)) for a in own]
            edges.append(arc(ends[k], ends[1 - k], points))
    piece = RealPiece(PieceKind.ARC_NETWORK, (0, 1, 2, 3), (0, 1))
    walks = walks_of(curve_of([(0.0, high), (0.0, -high)], edges, piece), PLANE)
    assert [w.closed for w in walks] == [True, True]
    for walk, middle in zip(walks, (-0.5, 0.5), strict=True):
        radii = np.linalg.norm(walk.chart - np.array([middle, 0.0]), axis=1)
        assert np.abs(radii - 1).max() < 1e-12


def test_a_motion_turns_back_at_a_cusp_and_ends_where_an_arc_is_open() -> None:
    t = np.linspace(0, 1, 20)
    branches = [arc(0, 1, [(x**2, s * x**3) for x in t]) for s in (1.0, -1.0)]
    vertices = (
        RealVertex(VertexKind.SINGULAR, np.zeros(2)),
        RealVertex(VertexKind.INFINITE, np.array([1.0, 0.0])),
    )
    piece = RealPiece(PieceKind.ARC_NETWORK, (0, 1), (0, 1))
    curve = RealCurve(("x", "y"), (), vertices, tuple(branches), (piece,), PictureVerdict.COMPLETE)
    (walk,) = walks_of(curve, PLANE)
    assert not walk.closed and len(walk.chart) == 39
    assert walk.vertices == ((0, 19),)
    assert np.sign(walk.chart[0, 1]) == -np.sign(walk.chart[-1, 1])


def test_a_closed_walk_may_begin_anywhere() -> None:
    lobes = [arc(0, 0, lemniscate_lobe(s)) for s in (1.0, -1.0)]
    piece = RealPiece(PieceKind.ARC_NETWORK, (0, 1), (0,))
    (walk,) = walks_of(curve_of([(0.0, 0.0)], lobes, piece), PLANE)
    turned = walk.begin_at(7)
    assert np.abs(turned.chart[[0, -1]] - walk.chart[7]).max() < 1e-12
    assert len(turned.chart) == len(walk.chart)
    for vertex, index in turned.vertices:
        assert vertex == 0 and np.abs(turned.chart[index]).max() < 1e-12


def test_a_walk_through_infinity_of_a_quaternion_is_smooth_there() -> None:
    # The hyperbola b^2 - c^2 = 1 of quaternions (1, 0, b, c), a loop that meets infinity twice.
    t = np.linspace(0, 2 * np.pi, 201) - 0.3
    points = np.stack([0 * t, 1 / np.cos(t), np.tan(t)], axis=1)
    unit = np.stack([np.cos(t), 0 * t, 1 + 0 * t, np.sin(t)], axis=1) / math.sqrt(2)
    system = nag.system("a", "a b c", groups=[("a", "b", "c")], nonzero="1 + a^2 + b^2 + c^2")
    coordinates = SphericalChart.of(system)
    edge = RealEdge(None, None, points, points)
    piece = RealPiece(PieceKind.CLOSED_LOOP, (0,), ())
    curve = RealCurve(("a", "b", "c"), (), (), (edge,), (piece,), PictureVerdict.COMPLETE)
    (walk,) = walks_of(curve, coordinates)
    assert walk.closed and np.allclose(walk.chart[:, [3, 0, 1, 2]], unit, rtol=0, atol=1e-14)
    turned = walk.begin_at(70)
    assert np.linalg.norm(np.diff(turned.chart, axis=0), axis=1).max() < 0.04
    assert np.allclose(coordinates.points(walk.chart), points, rtol=1e-12, atol=1e-12)


def test_a_spherical_joint_turns_by_half_a_turn_as_by_any_other() -> None:
    """Quaternions of this rod pass infinity of their chart; lengths are those of traced loops."""
    joints = [
        nag.Joint("A", "revolute", ("base", "crank"), (0, 0, 0), (0, 0, 1)),
        nag.Joint("B", "universal", ("crank", "rod"), (1, 0, 0), (0, 0, 1), (0, 1, 0)),
        nag.Joint("C", "spherical", ("rod", "rocker"), (3, 1, 2)),
        nag.Joint("D", "revolute", ("rocker", "base"), (4, 0, 0), (0, 1, 0)),
    ]
    motion = nag.motion(nag.Mechanism("base", tuple(joints)), circuit="all", samples=120)
    assert motion.complete and len(motion.circuits) == 2
    lengths = sorted(circuit.length for circuit in motion.circuits)
    assert lengths == pytest.approx([13.68, 13.74], abs=0.02)
    scene = motion.scene
    for circuit in motion.circuits:
        assert circuit.closed and not circuit.crossings
        assert joint_errors(scene, circuit.poses).max() < FIT
        steps = pose_steps(circuit.poses, scene.measure)
        assert steps.max() < 1.01 * circuit.length / 120


@pytest.mark.parametrize("seed", range(3))
def test_how_a_rod_turns_about_itself_changes_nothing(seed: int) -> None:
    """A rod between balls comes to point nearly against the direction that it is drawn in.

    With a universal joint for one of the balls, whose second axis is across the rod, it comes to
    all the same places and does not turn about itself.
    """

    def moved_with(kind: str, *axes: tuple[int, int, int]) -> nag.Motion:
        joints = (
            nag.Joint("A", "revolute", ("g", "c"), (0, 1, 3), (3, 0, 0)),
            nag.Joint("D", "revolute", ("g", "o"), (2, -1, 1), (-2, 3, -1)),
            nag.Joint("B", kind, ("c", "r"), (-1, -1, -5), *axes),
            nag.Joint("C", "spherical", ("r", "o"), (-5, -5, 1)),
        )
        return nag.motion(nag.Mechanism("g", joints), seed=seed)

    free, held = moved_with("spherical"), moved_with("universal", (0, 0, 1), (1, -1, 0))
    assert free.scene.rods and not held.scene.rods
    assert len(free.circuits) == len(held.circuits) == 1
    for name in ("A", "D"):
        ends = []
        for motion in (free, held):
            values = motion.circuits[0].values
            dead = [p.value for p in values.turning if p.coordinate == name]
            ends.append(np.unique(np.round(np.mod(dead, 2 * np.pi), 9)))
        assert len(ends[0]) == len(ends[1]) == 2
        assert ends[0] == pytest.approx(ends[1], abs=1e-8)
    (circuit,), scene = free.circuits, free.scene
    assert joint_errors(scene, circuit.poses).max() < FIT
    # Its frame is carried along, and comes back.
    turns, r = circuit.poses.turns, scene.bodies.index("r")
    assert np.linalg.norm(np.diff(turns[r], axis=0), axis=-1).max() < 0.2
    assert abs(turns[r, 0] @ turns[r, -1]) == pytest.approx(1.0, abs=1e-12)
    assert pose_steps(circuit.poses, scene.measure).max() < 1.01 * circuit.length / 360


def test_the_table_has_a_column_for_each_number(moved) -> None:
    motion = moved("planar/four-bar")
    table = motion.table()
    assert list(table)[:6] == ["circuit", "arc", "A", "D", "B", "C"]
    assert {len(column) for column in table.values()} == {121}
    assert len(table) == 2 + 4 + 7 * 4
    assert np.degrees(motion.table(angles="radians")["A"]) == pytest.approx(table["A"])
    pin = np.stack([table["coupler.x"], table["coupler.y"]], axis=-1)
    # The coupler's frame begins at the crank's pin.
    assert np.hypot(pin[:, 0], pin[:, 1]) == pytest.approx(np.ones(121))
    with pytest.raises(NagError, match="circuit: 2 is none"):
        motion.table(2)
    with pytest.raises(NagError, match="angles"):
        motion.table(angles="gon")


def four_bar(lengths: list[Fraction]) -> Linkage:
    links = zip(
        ("base", "crank", "coupler", "rocker"), ("AD", "AB", "BC", "CD"), lengths, strict=True
    )
    zero = Fraction(0)
    return Linkage(
        "base",
        tuple(Link(name, tuple(p), ((zero, zero), (size, zero))) for name, p, size in links),
    )


@pytest.mark.parametrize("seed", range(10))
def test_circuits_and_full_turns_of_four_bars_are_those_of_grashofs_rule(seed: int) -> None:
    rng = random.Random(seed)
    while True:
        lengths = [Fraction(rng.randrange(4, 30), rng.choice([1, 2, 3])) for _ in range(4)]
        least, *middle, most = sorted(lengths)
        # Some assembly, and none in a line.
        if most < least + sum(middle) and least + most != sum(middle):
            break
    turns = least + most < sum(middle)
    motion = nag.motion(linkage_model(four_bar(lengths)), samples=90, seed=seed)
    assert motion.complete and len(motion.circuits) == 1 + turns
    shortest = ["base", "crank", "coupler", "rocker"][lengths.index(least)]
    for circuit in motion.circuits:
        for i, joint in enumerate(motion.scene.joints):
            links = {motion.scene.bodies[b] for b in joint.bodies}
            assert circuit.values.turns_fully(i) == (turns and shortest in links)


@pytest.mark.parametrize("angle", [0.4, -2.0, 3.0])
def test_assemblies_at_a_cranks_angle_are_those_of_the_triangle_that_is_left(angle) -> None:
    # Links 4, 1, 3, 7/2: from the crank's end to the rocker's pivot two sides are left.
    lengths = [Fraction(4), Fraction(1), Fraction(3), Fraction(7, 2)]
    motion = nag.motion(linkage_model(four_bar(lengths)), drive=("A", angle))
    assert motion.complete and len(motion.assemblies) == 2
    gap = complex(4, 0) - complex(math.cos(angle), math.sin(angle))
    inner = math.acos((abs(gap) ** 2 + 9 - 3.5**2) / (2 * 3 * abs(gap)))
    base = math.atan2(gap.imag, gap.real)
    names = [c.name for c in motion.circuits[0].values.coordinates]
    b, a = names.index("B"), names.index("A")
    found = [each.values[b] for each in motion.assemblies]
    wanted = [base + inner - angle, base - inner - angle]
    apart = [min(abs(cmath.exp(1j * x) - cmath.exp(1j * y)) for y in wanted) for x in found]
    assert max(apart) < 1e-12
    assert abs(cmath.exp(1j * found[0]) - cmath.exp(1j * found[1])) > 0.1
    for each in motion.assemblies:
        assert math.cos(each.values[a] - angle) == pytest.approx(1, abs=1e-14)
        assert joint_errors(motion.scene, each.poses).max() < FIT


def test_a_joint_has_its_extreme_value_once_and_none_beyond() -> None:
    case = nag.read_case(ROOT / "cases" / "bricard-cube.toml")
    for degrees, count in ((30, 1), (29.9, 2), (30.1, 0), (-210, 1), (90, 0), (120, 0)):
        motion = nag.motion(case, samples=90, drive=("J0", math.radians(degrees)))
        # -210 is 150 degrees; between 30 and 150 there is nothing.
        assert len(motion.assemblies) == count, degrees


def test_samples_near_an_infinite_half_angle_are_on_the_same_motion() -> None:
    # The middle shafts of Hooke's joint swing between the angle of the shafts and its supplement.
    motion = nag.motion(nag.read_case(ROOT / "cases" / "spherical" / "hooke-joint.toml"))
    assert motion.complete and len(motion.circuits) == 2
    for circuit in motion.circuits:
        names = [c.name for c in circuit.values.coordinates]
        for name in ("J2", "J3"):
            own = np.abs(circuit.values.ranges[names.index(name)])
            ends = [math.acos(3 / 5), math.pi - math.acos(3 / 5)]
            assert sorted(own) == pytest.approx(ends, abs=1e-9)
        assert [abs(circuit.values.turns[names.index(n)]) for n in ("J1", "J4")] == [1, 1]
        assert len(circuit.values.turning) == 4


def test_steps_onto_a_curve_of_more_equations_than_it_needs_do_not_run_along_it() -> None:
    problem = read_problem("spatial/bricard-plane-symmetric")
    curve = trace_loop(problem, start_of(problem), step=0.05)
    whole = Curve(curve, problem.system, scene_of(problem))
    (walk,) = walks_of(curve, whole.coordinates)
    chart = walk.chart
    steps = np.diff(chart, axis=0)
    middle = whole.sharpen((chart[1:] + chart[:-1]) / 2)
    along = ((middle - chart[:-1]) * steps).sum(axis=1) / (steps**2).sum(axis=1)
    assert np.abs(along - 0.5).max() < 0.01
    assert np.abs(whole.equations_at(middle)[0]).max() < 1e-13


def test_joints_fit_where_the_gradient_of_one_of_too_many_equations_vanishes() -> None:
    # A spherical joint leaves four equations of rank three; where all bodies are in the plane of
    # symmetry, half a way from the reference, one of them is singular.
    G = nx.MultiGraph()
    G.add_edge("base", "crank", type="revolute", point=(0, 0, 0), axis=(0, 0, 1))
    G.add_edge("crank", "rod", type="spherical", point=(1, 0, 0))
    axes = {"axis": (0, 0, 1), "second_axis": (1, 0, 0), "bodies": ("rod", "rocker")}
    G.add_edge("rod", "rocker", type="universal", point=(4, 3, 0), **axes)
    G.add_edge("rocker", "base", type="revolute", point=(4, 0, 2), axis=(1, 0, 0))
    mechanism = nag.Mechanism.from_graph(G, ground="base")
    motion = nag.motion(mechanism, samples=12)
    (circuit,) = motion.circuits
    assert joint_errors(motion.scene, circuit.poses).max() < FIT


def test_a_framework_with_a_stretched_loop_moves_by_the_equations_of_its_real_places() -> None:
    """Its own are singular along the whole motion. Grashof: two circuits for either side of D."""
    bars = ["OQ", "OA", "AB", "BQ", "AC", "CB", "BD", "DQ"]
    squares = tuple(Fraction(length**2) for length in (4, 1, 3, 3, 1, 2, 2, 2))
    framework = nag.Framework(2, tuple("OQABCD"), tuple(map(tuple, bars)), squares)
    motion = nag.motion(framework, samples=60)
    assert motion.complete and len(motion.components) == 2
    assert [circuit.closed for circuit in motion.circuits] == [True] * 4
    for circuit in motion.circuits:
        names = [c.name for c in circuit.values.coordinates]
        assert circuit.values.still[names.index("C")]
        assert abs(circuit.values.turns[names.index("O")]) == 1
        ends = np.abs(circuit.values.ranges[names.index("B:B-Q")])
        # The angle between the rods of 3 and 3 where their ends are 3 and 5 apart.
        assert sorted(ends) == pytest.approx(
            sorted(np.pi - np.array([math.acos(1 / 2), math.acos(-7 / 18)])), abs=1e-9
        )


def test_an_inversor_that_cannot_but_be_stretched_only_swings_its_folded_end() -> None:
    """O-A, A-C and C-B are as long as O-B: really B and D fall together, and P turns about them."""
    motion = nag.motion(nag.read_case(CASES / "planar" / "peaucellier.toml"), samples=60)
    (circuit,) = motion.circuits
    moves = {
        c.name
        for c, still in zip(circuit.values.coordinates, circuit.values.still, strict=True)
        if not still
    }
    assert motion.complete and circuit.closed and moves == {"B:P-B", "D:D-P"}


def test_circuits_of_a_rhombus_cross_each_other_where_it_is_flat() -> None:
    case = nag.read_case(ROOT / "cases" / "planar" / "four-bar-rhombus.toml")
    motion = nag.motion(case, samples=90)
    assert motion.complete and len(motion.circuits) == 3
    met = {c.number: [set(x.circuits) for x in c.crossings] for c in motion.circuits}
    assert sorted(map(sorted, met[1])) == [[2], [3]]
    assert sorted(map(sorted, met[2])) == [[1], [3]]
    assert sorted(map(sorted, met[3])) == [[1], [2]]
    for circuit in motion.circuits:
        for crossing in circuit.crossings:
            assert len(crossing.components) == 1
            # All four links lie in one line.
            values = circuit.values.values[crossing.sample]
            assert np.abs(np.sin(values)).max() < 0.1
    still = [set(np.flatnonzero(c.values.still)) for c in motion.circuits]
    assert sorted(map(sorted, still)) == [[], [0, 3], [1, 2]]


def test_a_motion_to_infinity_is_followed_as_far_as_is_said() -> None:
    motion = nag.motion(nag.read_case(ROOT / "cases" / "spatial" / "delassus-rprp.toml"))
    (circuit,) = motion.circuits
    assert circuit.unbounded and not circuit.closed and circuit.through_reference
    assert motion.idle == ""
    assert np.abs(circuit.poses.places).max() < 20 * motion.scene.size
    names = [c.name for c in circuit.values.coordinates]
    b, d = (circuit.values.values[:, names.index(n)] for n in "BD")
    assert np.abs(b + d).max() < 1e-12
    assert joint_errors(motion.scene, circuit.poses).max() < FIT


def test_a_motion_to_infinity_is_followed_equally_far_by_all_equations() -> None:
    """Whatever points the real curve has: to where bodies are five sizes farther than nearest."""
    case = nag.read_case(ROOT / "cases" / "spatial" / "delassus-rprp.toml")
    lengths, rows = [], []
    for formulation, seed in (("E", 0), ("H", 0), ("H", 1), ("H", 2)):
        motion = nag.motion(case, formulation=formulation, seed=seed)
        (circuit,) = motion.circuits
        scene = motion.scene
        places = np.stack([circuit.poses.move(i, c) for i, c in enumerate(scene.centres)])
        far = np.linalg.norm(places - places[scene.ground], axis=2).max(axis=0) / scene.size
        assert np.abs(far[[0, -1]] - far.min() - 5).max() < 1e-3
        lengths.append(circuit.length)
        values = circuit.values.values
        rows.append(values if values[0, 1] < values[-1, 1] else values[::-1])
    assert np.allclose(lengths, lengths[0], rtol=1e-10, atol=0)
    for other in rows[1:]:
        assert np.abs(other - rows[0]).max() < 1e-8


def test_samples_beside_places_where_motions_cross_are_exact() -> None:
    """The kite of the inversor is folded there, and its ends may turn freely, too."""
    motion = nag.motion(nag.read_case(ROOT / "cases" / "planar" / "peaucellier-placed.toml"))
    assert len(motion.circuits) == 2
    for circuit in motion.circuits:
        assert len(circuit.crossings) == 6
        assert joint_errors(motion.scene, circuit.poses).max() < FIT


def count_mirrored_plates() -> int:
    """Real places of a plate that is the mirror image of its base, on three legs as long as
    the root of 17.

    The ends of the legs are at 0, 3, 1 + 2i and at 0, 3, 1 - 2i on the plate. At each angle of the
    plate the differences of the legs' equations are linear in its place; they depend on each other,
    and at the angles at which they do not contradict each other the place is on a line.
    """
    angles = np.linspace(-np.pi, np.pi, 100_001) + 1e-5
    turned = np.exp(1j * angles)
    first, second = 3 * turned - 3, (1 - 2j) * turned - (1 + 2j)
    contradiction = abs(first) ** 2 * second - abs(second) ** 2 * first
    # All of it is along the same direction.
    size = (contradiction / (1j * np.exp(0.5j * angles))).real
    roots = np.flatnonzero(size[1:] * size[:-1] < 0)
    return sum(2 * int(abs(second[k]) / 2 < math.sqrt(17)) for k in roots)


def test_real_assemblies_that_cannot_move_are_told_beside_the_circuits() -> None:
    # Three parallel legs carry a plate like their base, which is only carried along (turned by w,
    # its place is w times the base's circumcentre: too near for the legs), or its mirror image;
    # the whole is mirrored as well.
    motion = nag.motion(CASES / "planar" / "prism-parallel.toml", samples=60)
    assert motion.complete and len(motion.circuits) == 2 and not motion.not_looked_for
    assert len(motion.assemblies) == 2 * count_mirrored_plates() == 12
    for each in motion.assemblies:
        assert joint_errors(motion.scene, each.poses).max() < FIT and each.circuit is None
    assert "12 real assemblies besides that cannot move" in " ".join(str(motion).split())
    assert len(motion.document()["assemblies"]) == len(motion.assembly_table()["A:A-D"]) == 12
    assert motion.only_circuit(2).assemblies == motion.assemblies


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-5, 1e-3])
def test_assemblies_next_to_a_crossing_of_circuits_stay_on_their_own(angle: float) -> None:
    # A deltoid of links 1 and 2: while its arm turns by D the crank turns by -D / 2, at first.
    motion = nag.motion(CASES / "planar" / "four-bar-kite.toml", drive=("D", angle))
    found = sorted(np.mod(each.values[0] + 1.0, 2 * np.pi) - 1.0 for each in motion.assemblies)
    assert len(found) == 2 and all(each.circuit == 2 for each in motion.assemblies)
    assert found[0] == pytest.approx(-angle / 2, abs=angle**3 + 1e-11)
    assert found[1] == pytest.approx(np.pi + 3 * angle / 2, abs=2 * angle**3 + 1e-11)
    for each in motion.assemblies:
        assert joint_errors(motion.scene, each.poses).max() < FIT


@pytest.mark.parametrize("seed", [0, 1, 3, 5])
def test_a_parallelogram_in_half_angles_turns_fully_with_each_seed(seed: int) -> None:
    motion = nag.motion(CASES / "planar-four-bar.toml", circuit="all", samples=60, seed=seed)
    parallelogram, other = motion.circuits
    assert motion.complete and parallelogram.through_reference
    # Two bodies turn about the ground by a whole turn, the third one's middle runs along a circle.
    assert np.abs(parallelogram.values.turns).tolist() == [1, 1, 1, 1]
    assert not parallelogram.values.turning
    assert other.length == pytest.approx(11.0214, rel=1e-4)


NEARLY_FLAT = [
    # Base, crank, coupler, rocker: next to folding, by Grashof's rule in so many circuits.
    ((7.8119, 6.432, 2.743, 1.363), 2),
    ((5.79, 6.392, 3.245, 3.846), 1),
    ((7.0001, 3, 6, 4), 1),
    ((7.000001, 3, 6, 4), 1),
]


@pytest.mark.parametrize(("lengths", "circuits"), NEARLY_FLAT)
def test_circuits_and_dead_points_of_four_bars_that_nearly_fold(lengths, circuits) -> None:
    base, crank, coupler, rocker = lengths
    for seed in range(3):
        given = four_bar([Fraction(str(x)) for x in lengths])
        motion = nag.motion(linkage_model(given), circuit="all", seed=seed)
        assert motion.complete and len(motion.circuits) == circuits
        for circuit in motion.circuits:
            assert len(circuit.values.turning) <= 8
            if circuits == 1 and base - rocker > abs(crank - coupler):
                # The angle at B is least where base and rocker are on a line.
                diagonal = crank**2 + coupler**2 - (base - rocker) ** 2
                least = math.acos(diagonal / (2 * crank * coupler))
                folded = np.abs(np.angle(np.exp(1j * circuit.values.ranges[2]))).max()
                assert folded == pytest.approx(math.pi - least, abs=1e-9)


def test_a_crossing_that_the_search_for_it_just_misses_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    case = nag.read_case(ROOT / "cases" / "planar" / "slider-crank-equal.toml")
    wanted = [len(c.crossings) for c in nag.motion(case, circuit="all", samples=90).circuits]
    find_rank_loss = path._find_rank_loss

    def miss(*given: Any) -> tuple[float, float]:
        place, least = find_rank_loss(*given)
        return place, max(least, 10 * SINGULAR)

    monkeypatch.setattr(path, "_find_rank_loss", miss)
    found = [len(c.crossings) for c in nag.motion(case, circuit="all", samples=90).circuits]
    assert found == wanted and sum(wanted)


@pytest.mark.parametrize("seed", [0, 2, 3])
def test_dead_points_in_narrow_passages_are_exact(seed: int) -> None:
    # The rocker turns as far as crank and coupler reach, 1e-5 less than base and rocker do.
    base, crank, coupler, rocker = lengths = (1.859, 6.11798622, 3.02, 7.279)
    given = four_bar([Fraction(str(x)) for x in lengths])
    (circuit,) = nag.motion(linkage_model(given), circuit="all", seed=seed)
    farthest = math.acos((base**2 + rocker**2 - (crank + coupler) ** 2) / (2 * base * rocker))
    own = [each.value for each in circuit.values.turning if each.coordinate == "D"]
    assert sorted(own) == pytest.approx([-farthest, farthest], abs=1e-9)


RSE = """
title = "RSE"
kind = "mechanism"
ground = "base"

[[joint]]
name = "R"
type = "revolute"
bodies = ["base", "a"]
point = [0, 0, 0]
axis = [0, 0, 1]

[[joint]]
name = "S"
type = "spherical"
bodies = ["a", "c"]
point = [2, 0, 1]

[[joint]]
name = "E"
type = "planar"
bodies = ["c", "base"]
point = [3, 4, 2]
axis = [1, 2, 2]
"""


def slider_crank(pin: tuple[str, str], slider: str) -> nag.Mechanism:
    """A crank about the origin with its pin at a point, and a slider at x on the x axis."""
    up = (0, 0, 1)
    joints = (
        nag.Joint("O", "revolute", ("ground", "crank"), (0, 0, 0), up),
        nag.Joint("B", "revolute", ("crank", "rod"), (*pin, 0), up),
        nag.Joint("S", "revolute", ("rod", "slider"), (slider, 0, 0), up),
        nag.Joint("T", "prismatic", ("ground", "slider"), axis=(1, 0, 0)),
    )
    return nag.Mechanism("ground", joints)


# A rod that is longer than the crank by a hundredth, another that is shorter by 1e-4 of its length,
# and one that is longer by 1e-6, the last two of them also with a thousandth of the size.
CRANKS = [
    (("29/20", "1/50"), "72750023617197/25000000000000"),
    (("-11/100", "63/100"), "-21941710919393/100000000000000"),
    (("-11/100000", "63/100000"), "-21941710919393/100000000000000000"),
    (("24/25", "7/25"), "19200006/10000000"),
    (("24/25000", "7/25000"), "19200006/10000000000"),
]


@pytest.mark.parametrize("formulation", ["E", "H"])
@pytest.mark.parametrize(("pin", "slider"), CRANKS)
def test_circuits_of_slider_cranks_whose_rod_is_nearly_the_crank(
    pin: tuple[str, str], slider: str, formulation: str
) -> None:
    x, y = (float(Fraction(c)) for c in pin)
    crank, rod = math.hypot(x, y), math.hypot(float(Fraction(slider)) - x, y)
    short, long = sorted((crank, rod))
    swing = 2 * math.asin(short / long)
    # The longer one swings, and the slider goes as far as the shorter one is long, both ways.
    widths = {"T": 2 * short, "O" if crank == long else "S": swing}
    for seed in (0, 2, 7):
        asked = slider_crank(pin, slider)
        motion = nag.motion(asked, circuit="all", formulation=formulation, seed=seed)
        assert motion.complete and len(motion.circuits) == 2
        for circuit in motion.circuits:
            values, size = circuit.values, motion.scene.size
            assert joint_errors(motion.scene, circuit.poses).max() < FIT
            dead = [p.coordinate for p in values.turning]
            for i, each in enumerate(values.coordinates):
                if each.name not in widths:
                    assert values.turns_fully(i) and each.name not in dead
                    continue
                width, unit = np.ptp(values.ranges[i]), size if each.name == "T" else 1.0
                assert abs(width - widths[each.name]) < 1e-8 * unit
                assert dead.count(each.name) == 2


def test_dead_points_of_slides_do_not_depend_on_where_a_mechanism_is() -> None:
    pin, slider = ("29/20", "1/50"), "72750023617197/25000000000000"
    x, y = (float(Fraction(c)) for c in pin)
    crank, rod = math.hypot(x, y), math.hypot(float(Fraction(slider)) - x, y)
    away = [10000, -540]
    # The slide's own place, which means nothing, stays at the origin.
    joints = [
        replace(j, point=tuple(p + d for p, d in zip(j.point, (*away, 0), strict=True)))
        if j.type == "revolute"
        else j
        for j in slider_crank(pin, slider).joints
    ]
    for formulation in "EH":
        motion = nag.motion(nag.Mechanism("ground", joints), formulation=formulation)
        assert motion.scene.size == pytest.approx(max(crank, rod))
        (circuit,) = motion.circuits
        ends = sorted(p.value for p in circuit.values.turning if p.coordinate == "T")
        start = float(Fraction(slider))
        assert np.allclose(ends, [rod - crank - start, rod + crank - start], rtol=0, atol=1e-9)


# By 1e-7 from a kite and a rhombus, by 3e-8 and 1e-9 from folding.
NEARLY_SPECIAL = [
    ["2", "3", "3 + 1/10000000", "2 + 1/20000000"],
    ["2", "2 + 1/10000000", "2", "2 + 1/30000000"],
    ["3", "4 + 3/100000000", "5", "6"],
    ["3", "4 + 1/1000000000", "5", "6"],
]


@pytest.mark.parametrize("lengths", NEARLY_SPECIAL)
def test_round_a_motion_joints_reverse_an_even_number_of_times(lengths: list[str]) -> None:
    sizes = [sum(map(Fraction, length.split(" + "))) for length in lengths]
    for seed in range(3):
        motion = nag.motion(four_bar(sizes), circuit="all", seed=seed)
        assert motion.complete and not any(c.crossings for c in motion.circuits)
        for circuit in motion.circuits:
            dead = [p.coordinate for p in circuit.values.turning]
            for i, each in enumerate(circuit.values.coordinates):
                turns = circuit.values.turns_fully(i)
                assert dead.count(each.name) == (0 if turns else 2)


@pytest.mark.parametrize("seed", [0, 5])
def test_motions_that_cross_at_the_reference_pass_it_in_both_formulations(seed: int) -> None:
    # A parallelogram that is drawn flat.
    bodies = ["ground", "crank", "coupler", "rocker"]
    joints = [
        nag.Joint(name, "revolute", (bodies[k], bodies[(k + 1) % 4]), (x, 0, 0), (0, 0, 1))
        for k, (name, x) in enumerate(zip("ABCD", (0, "3/2", "11/2", 4), strict=True))
    ]
    mechanism = nag.Mechanism("ground", tuple(joints))
    lengths = []
    for formulation in "EH":
        motion = nag.motion(mechanism, formulation=formulation, seed=seed)
        assert all(circuit.through_reference for circuit in motion.circuits)
        lengths.append(sorted(circuit.length for circuit in motion.circuits))
    assert len(lengths[0]) == len(lengths[1]) == 2
    assert np.allclose(*lengths, rtol=1e-9, atol=0)


@pytest.mark.parametrize("seed", range(4))
def test_a_circuit_passes_the_reference_with_whatever_signs_of_euler_parameters(
    tmp_path: Path, seed: int
) -> None:
    case = tmp_path / "rse.toml"
    case.write_text(RSE)
    motion = nag.motion(case, circuit="all", seed=seed, samples=24)
    assert [circuit.through_reference for circuit in motion.circuits] == [True, False]


def test_a_joint_that_stands_still_is_at_no_value_beside_its_own() -> None:
    # A kite whose crank and coupler lie on each other turns as one bar, with the arm at rest.
    for angle, throughout in ((0.0, 1), (1e-7, 0)):
        motion = nag.motion(CASES / "planar" / "four-bar-kite.toml", drive=("D", angle))
        assert len(motion.throughout) == throughout


def test_an_isolated_real_point_of_a_curve_is_an_assembly_that_cannot_move() -> None:
    # With the crank turned back the other links reach just as far as they have to.
    lengths = {"crank": ("A", "B", 2), "rod": ("B", "C", 2), "arm": ("C", "D", 2)}
    ends = {"base": ("A", "E", 3), "rocker": ("D", "E", 1)}
    motion = nag.motion(Linkage.of(ends | lengths, "base"), drive={"A": np.pi})
    assert motion.complete and not motion.circuits and motion.freedoms == 0
    (only,) = motion.assemblies
    assert np.abs(np.sin(only.values)).max() < FIT
    assert joint_errors(motion.scene, only.poses).max() < FIT


def test_where_rigid_assemblies_were_not_looked_for_is_said() -> None:
    motion = nag.motion(CASES / "planar" / "kinematotropic-crank.toml", samples=24)
    assert motion.not_looked_for == "on 1 component of dimension 2 or more"
    assert f"were not looked for {motion.not_looked_for}" in rigid_text(motion)


def test_slides_of_a_planar_joint_are_along_the_drawings_axes_where_they_can_be() -> None:
    one, half = np.array([1.0, 0, 0, 0]), np.sqrt(1 / 2)
    for k in range(3):
        axis, ahead = np.eye(3)[k], np.roll(np.eye(3), -k - 1, axis=0)
        joint = SceneJoint("E", "planar", (0, 1), np.zeros((2, 3)), np.array([one, one]), axis)
        scene = Scene(("a", "b"), 0, (joint,), None, True, {}, (), lambda p: None)
        place = 2 * ahead[0] - 3 * ahead[1]
        turns = np.array([[one], [np.array([half, *(half * axis)])]])
        poses = Poses(turns, np.array([[np.zeros(3)], [place]]))
        assert joint_values(scene, poses)[0] == pytest.approx([np.pi / 2, 2, -3], abs=1e-14)
        # The first body carries them along.
        poses = Poses(turns[::-1], np.array([[np.zeros(3)], [place]]))
        assert joint_values(scene, poses)[0] == pytest.approx([-np.pi / 2, -3, -2], abs=1e-14)


def test_an_open_arm_is_told_how_to_be_held() -> None:
    joint = nag.Joint("A", "revolute", ("base", "arm"), (0, 0, 0), (0, 0, 1))
    with pytest.raises(NagError, match=r"no loop.*the hand at a pose"):
        nag.motion(nag.Mechanism("base", (joint,)))


def test_what_does_not_move_with_one_freedom_is_refused() -> None:
    with pytest.raises(MotionError, match="2 freedoms"):
        nag.motion(nag.read_case(ROOT / "cases" / "spherical" / "five-bar.toml"))
    with pytest.raises(MotionError, match="does not move"):
        nag.motion(nag.read_case(ROOT / "cases" / "spherical" / "triangle.toml"))
    with pytest.raises(NagError, match="samples"):
        nag.motion(nag.read_case(ROOT / "cases" / "bennett.toml"), samples=3)
    with pytest.raises(NagError, match="drive: 'J9' is no angle or slide; they are J0, J1, J2"):
        nag.motion(nag.read_case(ROOT / "cases" / "bennett.toml"), drive=("J9", 1.0))
    with pytest.raises(NagError, match="circuit"):
        nag.motion(nag.read_case(ROOT / "cases" / "bennett.toml"), circuit="some")
    with pytest.raises(NagError, match="equations by themselves"):
        nag.motion("x^2 + y^2 - 1")


def test_a_motion_says_what_it_is_in_a_few_lines(moved) -> None:
    text = str(moved("bennett", "H"))
    assert "1 freedom, though counting predicts -2" in text
    assert "begins at the reference configuration" in text
    document = moved("bennett", "H").document()
    assert json.loads(json.dumps(document)) == document


def test_scenes_have_their_joints_at_the_points_of_the_case() -> None:
    problem = read_problem("planar/watt-six-bar")
    scene = scene_of(problem)
    assert scene.bodies[scene.ground] == "base"
    assert [j.name for j in scene.joints] == ["A", "D", "G", "B", "C", "E", "F"]
    framework = scene_of(read_problem("planar/four-bar-kite"))
    assert framework.planar is not None


def test_a_motion_of_one_unknown_and_no_equation_is_a_line() -> None:
    found = nag.motion(CASES / "spatial" / "four-sliders.toml", samples=24)
    (circuit,) = found.circuits
    assert not circuit.closed and found.complete
    table = found.table(circuit.number)
    # All slides run evenly, and the loop closes.
    for joint in ("A", "C", "D"):
        steps = np.diff(table[joint])
        assert np.ptp(steps) < 1e-12 < abs(steps[0])


@pytest.mark.parametrize("coupler_end", [(4, 4), (Fraction(44, 29), Fraction(-64, 29))])
def test_the_motion_of_the_reference_is_the_first_circuit(coupler_end: tuple) -> None:
    """A crank-rocker, assembled in both ways: crank 2, base 5, mirror images in the diagonal."""
    pins = [(0, 0), (0, 2), coupler_end, (5, 0)]
    joints = [
        nag.Joint(f"j{i}", "revolute", (str(i), str((i + 1) % 4)), (*at, 0), (0, 0, 1))
        for i, at in enumerate(pins)
    ]
    mechanism = nag.Mechanism("0", tuple(joints))
    alone, every = (nag.motion(mechanism, circuit=w, samples=24) for w in ("reference", "all"))
    assert (len(alone.circuits), len(every.circuits)) == (1, 2)
    assert [c.through_reference for c in every.circuits] == [True, False]
    assert alone.circuits[0] == every.circuits[0]


def test_a_pin_of_one_link_alone_is_a_point_of_it() -> None:
    links = [
        Link("base", ("A", "D"), ((0, 0), (4, 0))),
        Link("crank", ("A", "B"), ((0, 0), (1, 0))),
        Link("coupler", ("B", "C", "P"), ((0, 0), (3, 0), (1, 2))),
        Link("rocker", ("C", "D"), ((0, 0), (Fraction(7, 2), 0))),
    ]
    motion = nag.motion(Linkage("base", tuple(links)), samples=40)
    assert set(motion.scene.points) == {"P"}
    circuit = motion.circuits[0]
    points = {
        name: circuit.poses.move(*point_of(motion.scene, name)) for name in ("A", "B", "C", "P")
    }
    for one, other, squared in (("A", "B", 1), ("B", "P", 5), ("C", "P", 8)):
        gaps = ((points[one] - points[other]) ** 2).sum(axis=1) - squared
        assert np.abs(gaps).max() < 1e-12


def test_a_circuit_may_be_asked_for_by_its_number() -> None:
    every = nag.motion("cases/planar/four-bar.toml", circuit="all", samples=24)
    one = nag.motion("cases/planar/four-bar.toml", circuit=2, samples=24)
    assert one.circuits == every.circuits[1:2]
    with pytest.raises(NagError, match="circuit: 3 is none; they are 1, 2"):
        nag.motion("cases/planar/four-bar.toml", circuit=3, samples=24)


def test_the_crank_is_in_line_with_the_coupler_at_a_rockers_dead_points() -> None:
    """Base 4, crank 1, coupler 3, rocker 7/2: the crank's pin is 4 or 2 from the rocker's end."""
    circuit = nag.motion("cases/planar/four-bar.toml").circuits[0]
    names = [c.name for c in circuit.values.coordinates]
    crank, rocker = names.index("A"), names.index("D")
    found = {}
    for point in circuit.values.turning:
        if point.coordinate == "D":
            found[point.kind] = math.degrees(point.others[crank]) % 360
            assert point.others[rocker] == pytest.approx(point.value, abs=1e-9)
    stretched = math.degrees(math.acos((4**2 + 4**2 - 3.5**2) / (2 * 4 * 4)))
    folded = math.degrees(math.acos((4**2 + 2**2 - 3.5**2) / (2 * 4 * 2)))
    wanted = {stretched % 360, (folded - 180) % 360}, {-stretched % 360, (180 - folded) % 360}
    assert any(np.allclose(sorted(found.values()), sorted(each), atol=1e-4) for each in wanted)


def test_parts_that_have_no_real_assembly_are_told_why() -> None:
    links = {"base": ("A", "D", 9), "left": ("A", "B", 1), "top": ("B", "C", 3)}
    with pytest.raises(
        nag.NagError, match=r"assembled \(proved\): link base is longer than link left"
    ):
        nag.motion(nag.Linkage.of(links | {"right": ("C", "D", 2)}, "base"))


def test_a_stretched_linkage_is_shaky_and_stands_still() -> None:
    links = {"base": ("A", "D", 6), "left": ("A", "B", 1), "top": ("B", "C", 3)}
    report = nag.mobility(nag.Linkage.of(links | {"right": ("C", "D", 2)}, "base"))
    label, text = report.rows()[0]
    assert label == "mobility" and "A, B, C and D are in line" in text
    assert text.startswith("shaky") and "it does not move" in text


def test_of_several_components_one_that_is_not_followed_leaves_the_others() -> None:
    component = nag.decompose(["x^2 + y^2 + z^2 - 1", "x^2 + y^2 - 1"]).components[0]
    with pytest.raises(nag.ComponentError, match="not reduced"):
        _real_curve(component, False, DEFAULT_RUN)
    undecided = _real_curve(component, True, DEFAULT_RUN)
    assert not undecided.complete and "not reduced" in undecided.reason and not undecided.edges


@pytest.mark.parametrize(
    ("case", "body"),
    [
        ("mobility/delta", "platform"),
        ("robots/hexapod", "platform"),
        ("bennett", "B2"),
        # Both rods are as far.
        ("planar/five-bar", None),
    ],
)
def test_the_body_that_most_joints_part_from_the_ground_is_a_robots_platform(
    case: str, body: str | None
) -> None:
    scene = scene_of(read_problem(case))
    found = scene.farthest_body
    assert (None if found is None else scene.bodies[found]) == body


def test_joints_and_bodies_are_held_at_numbers_of_all_kinds() -> None:
    half, root = 0.5, 2**0.5 / 2
    series = pytest.importorskip("pandas").Series({"J0": "1/2", "J1": 1})
    for held in ({"J0": "1/2", "J1": 1}, {"J0": Fraction(1, 2), "J1": 1.0}, series):
        assert read_drives(held) == (Drive("J0", half), Drive("J1", 1.0))
    assert read_drives(("J0", "sqrt(2)/2")) == (Drive("J0", root),)
    assert read_poses({"B1": ("1/10", "0", Fraction(1, 20))}) == (Pose("B1", (0.1, 0, 0.05)),)
    driven = nag.driven_motion("cases/bennett.toml", "J0", ["1/2", 0.5])
    assert driven.values == (half, half) and driven[0] == driven[1]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"J0": True}, r"drive\['J0'\]: a truth value is no number"),
        ({"J0": "x"}, r"drive\['J0'\]: column 1: unknown name 'x'"),
        ({"J0": float("nan")}, r"drive\['J0'\]: NaN is no number"),
        (b"ab", "drive: give a joint and a value"),
        ("ab", "drive: give a joint and a value"),
        ([("J0", 1), ("J1", 1)], "drive: give a joint and a value"),
    ],
)
def test_what_is_no_number_holds_no_joint(given: Any, message: str) -> None:
    with pytest.raises(NagError, match=message):
        read_drives(given)
    with pytest.raises(NagError, match=r"pose\['B1'\]\[0\]: a truth value is no number"):
        read_poses({"B1": (True, 0, 0)})
    for values in ("12", b"12", {1, 2}):
        with pytest.raises(NagError, match="give a dict of bodies"):
            read_poses({"B1": values})
        with pytest.raises(NagError, match="values: give a list of numbers"):
            nag.driven_motion("cases/bennett.toml", "J0", values)
    with pytest.raises(NagError, match=r"values\[1\]: a truth value is no number"):
        nag.driven_motion("cases/bennett.toml", "J0", [0.5, True])
