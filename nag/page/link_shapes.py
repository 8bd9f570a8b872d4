"""What links and joints look like: rods, rings, pins, rails and plates, in the bodies' frames.

In space a link is a rod along the common perpendicular of the axes of its two joints, and along
these to where the joints are; where the axes meet, an arc about the point in which they do. In the
plane it is a rounded slab in a layer of its own, and a plate where it has more pins than two.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from nag.kinematics.joint_values import across
from nag.kinematics.poses import turn_back, turn_vectors
from nag.kinematics.scene import Scene, SceneJoint
from nag.mechanism.joint_types import JOINT_TYPES

# Lengths over the typical link's: of rods, rings and pins, and of slabs in the plane.
ROD, RING, RING_LENGTH, PIN, BALL = 0.052, 0.1, 0.125, 0.045, 0.1
SLAB, THICKNESS = 0.085, 0.05
# Axes whose unit vectors have a product below this are shown as parallel ones, and those that pass
# each other within this share of a link as ones that meet.
PARALLEL, MEETING = 0.02, 1e-6
# Feet of common perpendiculars that are further from the joint's given point, in sizes, are left.
FAR = 1.5
# Steps of an arc.
ARC = 24


@dataclass(frozen=True)
class BodyShape:
    """One piece of a body.

    Attributes:
        kind: ``rod`` (two ends), ``tube`` (points), ``ring``, ``pin`` (centre and axis), ``ball``,
            ``block`` (centre, axis, second axis), ``rail`` (two ends, second axis), ``slab``
            (points), ``disc`` (centre, axis) or ``pivot`` (a point).
        at: its points and directions, in the body's frame.
        sizes: radius, length and the like.
    """

    kind: str
    at: tuple[tuple[float, ...], ...]
    sizes: tuple[float, ...] = ()


@dataclass(frozen=True)
class Shapes:
    """Shapes of all bodies.

    Attributes:
        bodies: for each body its shapes.
        hubs: where joints are shown: for each joint a place on its first body.
        link: the typical length.
        front: how far before the plane of motion the foremost layer ends.
    """

    bodies: tuple[tuple[BodyShape, ...], ...]
    hubs: tuple[tuple[float, ...], ...]
    link: float
    front: float = 0.0


def link_shapes(scene: Scene, slides: dict[str, tuple[float, float]]) -> Shapes:
    """What the bodies of a scene look like.

    Args:
        slides: by joint, from where to where it slides along its axis.
    """
    scene = _with_slides_at_pins(scene)
    link = typical_length(scene)
    if scene.planar is not None:
        return _planar_shapes(scene, slides, link)
    return _spatial_shapes(scene, slides, link)


def _with_slides_at_pins(scene: Scene) -> Scene:
    """The scene with slides shown where a body's other joint is: any point of it is as good."""
    joints = []
    for joint in scene.joints:
        if JOINT_TYPES[joint.type].turns_about_point or "point" in JOINT_TYPES[joint.type].fields:
            joints.append(joint)
            continue
        # The block is on the body that moves.
        end = 0 if joint.bodies[1] == scene.ground else 1
        body = joint.bodies[end]
        others = [
            j.points[j.bodies.index(body)]
            for j in scene.joints
            if body in j.bodies and j is not joint and "point" in JOINT_TYPES[j.type].fields
        ]
        if not others or joint.type == "rigid":
            joints.append(joint)
            continue
        own = joint.points[end]
        nearest = min(others, key=lambda p: float(np.linalg.norm(p - own)))
        shift = turn_vectors(turn_back(joint.frames[end]), nearest - own)
        moved = np.array(joint.points) + turn_vectors(joint.frames, shift)
        joints.append(replace(joint, points=moved))
    return replace(scene, joints=tuple(joints))


def typical_length(scene: Scene) -> float:
    lengths = []
    for body in range(len(scene.bodies)):
        own = _points_of(scene, body)
        lengths += [float(np.linalg.norm(p - q)) for i, p in enumerate(own) for q in own[:i]]
    lengths = [x for x in lengths if x > MEETING * scene.size]
    return float(np.median(lengths)) if lengths else scene.size


def _points_of(scene: Scene, body: int) -> list[np.ndarray]:
    own = [j.points[j.bodies.index(body)] for j in scene.joints if body in j.bodies]
    return own + [point for b, point in scene.points.values() if b == body]


def _slides(joint: SceneJoint) -> bool:
    return "slide" in JOINT_TYPES[joint.type].factors


def _has_line(joint: SceneJoint) -> bool:
    """Whether it is about, or along, one line."""
    return JOINT_TYPES[joint.type].factors in (("turn",), ("turn", "slide"))


def _shape(kind: str, at: Sequence[np.ndarray], sizes: Sequence[float] = ()) -> BodyShape:
    return BodyShape(kind, tuple(tuple(map(float, p)) for p in at), tuple(map(float, sizes)))


def _spatial_shapes(scene: Scene, slides: dict[str, tuple[float, float]], link: float) -> Shapes:
    feet = _feet(scene, link)
    hubs = _hubs(scene, feet, link)
    bodies: list[list[BodyShape]] = [[] for _ in scene.bodies]
    for body, shapes in enumerate(bodies):
        shapes += _link(scene, body, feet, hubs, link)
    for k, joint in enumerate(scene.joints):
        _add_joint(
            bodies, joint, hubs[k], slides.get(joint.name, (0.0, 0.0)), link, bool(scene.points)
        )
    places = tuple(
        tuple(map(float, _hub(scene, j, 0, hubs[k]))) for k, j in enumerate(scene.joints)
    )
    return Shapes(tuple(map(tuple, bodies)), places, link)


def _feet(scene: Scene, link: float) -> dict[tuple[int, int], tuple[float, float]]:
    """For each body's joint about a line where on it its link ends, from the joint's point.

    The second number is the distance of the axes; where it is zero they meet there.
    """
    found: dict[tuple[int, int], tuple[float, float]] = {}
    for body in range(len(scene.bodies)):
        own = [k for k, j in enumerate(scene.joints) if body in j.bodies]
        lines = [k for k in own if _has_line(scene.joints[k])]
        if len(own) != 2 or len(lines) != 2:
            continue
        (p, u), (q, v) = (_line(scene.joints[k], body) for k in lines)
        normal = np.cross(u, v)
        squared = float(normal @ normal)
        if squared < PARALLEL**2:
            continue
        gap = q - p
        s = float(np.cross(gap, v) @ normal) / squared
        t = float(np.cross(gap, u) @ normal) / squared
        distance = abs(float(gap @ normal)) / np.sqrt(squared)
        if max(abs(s), abs(t)) <= FAR * scene.size:
            apart = distance if distance > MEETING * link else 0.0
            found[body, lines[0]], found[body, lines[1]] = (s, apart), (t, apart)
    return found


def _line(joint: SceneJoint, body: int) -> tuple[np.ndarray, np.ndarray]:
    end = joint.bodies.index(body)
    return joint.points[end], joint.axis_in(end)


def _hubs(
    scene: Scene, feet: dict[tuple[int, int], tuple[float, float]], link: float
) -> list[float]:
    """Where each joint is shown on its axis, from the joint's point.

    In the middle of the feet of links of some length; where links of all its bodies meet the next
    axis, a link away from there.
    """
    hubs = []
    for k, joint in enumerate(scene.joints):
        own = [feet[b, k] for b in joint.bodies if (b, k) in feet]
        long = [foot for foot, distance in own if distance]
        if long:
            hubs.append(float(np.mean(long)))
        elif len(own) == 2:
            hubs.append(own[0][0] + link)
        else:
            hubs.append(0.0)
    return hubs


def _hub(scene: Scene, joint: SceneJoint, end: int, along: float) -> np.ndarray:
    point = joint.points[end]
    return point + along * joint.axis_in(end) if _has_line(joint) else point


def _link(
    scene: Scene,
    body: int,
    feet: dict[tuple[int, int], tuple[float, float]],
    hubs: Sequence[float],
    link: float,
) -> list[BodyShape]:
    """What joins a body's joints."""
    own = [k for k, j in enumerate(scene.joints) if body in j.bodies]
    ends = [_hub(scene, scene.joints[k], scene.joints[k].bodies.index(body), hubs[k]) for k in own]
    ends += [point for b, point in scene.points.values() if b == body and not own]
    radius = ROD * link
    if len(ends) < 2:
        return []
    if len(ends) == 2 and len(own) == 2 and all((body, k) in feet for k in own):
        corners = []
        for k in own:
            point, axis = _line(scene.joints[k], body)
            corners.append(point + feet[body, k][0] * axis)
        if feet[body, own[0]][1] == 0.0:
            arms = [end - corners[0] for end in ends]
            sizes = [float(np.linalg.norm(a)) for a in arms]
            if min(sizes) > radius and abs(sizes[0] - sizes[1]) < radius:
                return [_shape("tube", _arc(corners[0], *arms), (radius,))]
        way = [ends[0], corners[0], corners[1], ends[1]]
        return [_shape("tube", _without_repeats(way, radius), (radius,))]
    ends = _without_same(ends, radius / 100)
    if len(ends) < 2:
        return []
    if len(ends) == 2:
        return [_shape("rod", ends, (radius,))]
    middle = np.mean(ends, axis=0)
    return [
        *(_shape("rod", (end, middle), (radius,)) for end in ends),
        _shape("ball", (middle,), (1.3 * radius,)),
    ]


def _without_repeats(points: Sequence[np.ndarray], least: float) -> list[np.ndarray]:
    kept = [points[0]]
    for point in points[1:-1]:
        if min(float(np.linalg.norm(point - p)) for p in (kept[-1], points[-1])) > least / 100:
            kept.append(point)
    return [*kept, points[-1]]


def _arc(centre: np.ndarray, first: np.ndarray, second: np.ndarray) -> list[np.ndarray]:
    """Points about a centre, from one place to another as far from it."""
    size = np.linalg.norm(first)
    a, b = first / size, second / np.linalg.norm(second)
    angle = float(np.arccos(np.clip(a @ b, -1.0, 1.0)))
    rest = b - (a @ b) * a
    if np.linalg.norm(rest) < PARALLEL:
        rest = across(a)[0]
    rest = rest / np.linalg.norm(rest)
    return [centre + size * (np.cos(x) * a + np.sin(x) * rest) for x in np.linspace(0, angle, ARC)]


def _add_joint(
    bodies: list[list[BodyShape]],
    joint: SceneJoint,
    along: float,
    slide: tuple[float, float],
    link: float,
    bars: bool,
) -> None:
    """The two halves of a joint in space, or the point of a framework's bars."""
    factors = JOINT_TYPES[joint.type].factors
    first, second = (bodies[b] for b in joint.bodies)
    at = [
        point + (along * joint.axis_in(k) if _has_line(joint) else 0.0)
        for k, point in enumerate(joint.points)
    ]
    ring, length = RING * link, RING_LENGTH * link
    if factors == ("turn",):
        axes = [joint.axis_in(k) for k in (0, 1)]
        second.append(_shape("ring", (at[1], axes[1]), (ring, 1.05 * length)))
        for side in (-1.0, 1.0):
            centre = at[0] + side * 1.05 * length * axes[0]
            first.append(_shape("ring", (centre, axes[0]), (ring, 0.95 * length)))
        first.append(_shape("pin", (at[0], axes[0]), (PIN * link, 3.5 * length)))
    elif factors == ("ball",):
        if bars:
            # Of many bars at one point the ball is nobody's.
            first.append(_shape("steelball", (at[0],), (1.5 * ROD * link,)))
        else:
            first.append(_shape("ball", (at[0],), (BALL * link,)))
            second.append(_shape("socket", (at[1],), (1.12 * BALL * link,)))
    elif factors == ("turn", "turn"):
        assert joint.axis is not None and joint.second_axis is not None
        u, v = joint.axis_in(0), joint.axis_in(1, second=True)
        cross = 3.2 * length
        first.append(_shape("pin", (at[0], u), (PIN * link, cross)))
        second.append(_shape("pin", (at[1], v), (PIN * link, cross)))
        for shapes, place, axis in ((first, at[0], u), (second, at[1], v)):
            for side in (-1.0, 1.0):
                ends = place + side * 0.45 * cross * axis
                shapes.append(_shape("ring", (ends, axis), (0.8 * ring, 0.45 * length)))
        second.append(_shape("steelball", (at[1],), (1.5 * PIN * link,)))
    elif factors == ("slide",) or factors == ("turn", "slide"):
        axes = [joint.axis_in(k) for k in (0, 1)]
        low, high = min(slide) - 2.5 * length, max(slide) + 2.5 * length
        ends = (at[0] + low * axes[0], at[0] + high * axes[0])
        side = _side(joint, 0)
        if factors == ("slide",):
            first.append(_shape("rail", (*ends, side), (0.7 * ring,)))
            second.append(
                _shape("block", (at[1], axes[1], _side(joint, 1)), (2.2 * length, 1.35 * ring))
            )
        else:
            first.append(_shape("bar", ends, (0.6 * ring,)))
            second.append(_shape("ring", (at[1], axes[1]), (1.15 * ring, 2.0 * length)))
    elif factors == ("plane",):
        axes = [joint.axis_in(k) for k in (0, 1)]
        first.append(_shape("disc", (at[0], axes[0]), (0.6 * link, 0.25 * ring)))
        centre = at[1] + 0.3 * ring * axes[1]
        second.append(_shape("disc", (centre, axes[1]), (0.2 * link, 0.3 * ring)))
    else:
        for k, shapes in enumerate((first, second)):
            shapes.append(_shape("ball", (at[k],), (1.2 * ROD * link,)))


def _side(joint: SceneJoint, end: int) -> np.ndarray:
    """A direction across the axis, the same for both bodies where the joint has not moved."""
    assert joint.axis is not None
    return turn_vectors(joint.frames[end], across(joint.axis)[0])


def _planar_shapes(scene: Scene, slides: dict[str, tuple[float, float]], link: float) -> Shapes:
    """Slabs in layers, pins through them, and pivots on the ground."""
    assert scene.planar is not None
    layers = _layers(scene)
    radius, thick = SLAB * link, THICKNESS * link
    bodies: list[list[BodyShape]] = [[] for _ in scene.bodies]
    hubs = []
    for body, shapes in enumerate(bodies):
        normal = _normal_in(scene, body)
        lift = layers[body] * 1.25 * thick * normal
        own = [j for j in scene.joints if body in j.bodies]
        points = _without_same([j.points[j.bodies.index(body)] for j in own], radius / 100)
        points += [p for b, p in scene.points.values() if b == body and not own]
        if body == scene.ground:
            continue
        if len(points) > 1:
            corners = [p - (p @ normal) * normal + lift for p in points]
            shapes.append(_shape("slab", (normal, *corners), (radius, thick)))
        elif own and not any(_slides(j) for j in own):
            shapes.append(
                _shape("slab", (normal, points[0] + lift, points[0] + lift), (radius, thick))
            )
    for joint in scene.joints:
        first, second = joint.bodies
        normals = [_normal_in(scene, b) for b in joint.bodies]
        own = [layers[first], layers[second]]
        flat = [p - (p @ n) * n for p, n in zip(joint.points, normals, strict=True)]
        hubs.append(tuple(map(float, flat[0])))
        if JOINT_TYPES[joint.type].slides_only:
            rail = 1 if second == scene.ground else 0
            _add_planar_slide(bodies, scene, joint, rail, slides, flat, normals, own, radius, thick)
            continue
        if joint.type != "revolute":
            continue
        low, high = min(own) - 0.75, max(own) + 0.75
        if scene.ground in joint.bodies:
            k = joint.bodies.index(scene.ground)
            bodies[scene.ground].append(_shape("pivot", (flat[k], normals[k]), (radius,)))
            low = -0.6
        centre = flat[0] + (low + high) / 2 * 1.25 * thick * normals[0]
        length = (high - low) * 1.25 * thick
        bodies[first].append(_shape("pin", (centre, normals[0]), (0.55 * radius, length)))
    front = (max(layers) + 1) * 1.25 * thick
    return Shapes(tuple(map(tuple, bodies)), tuple(hubs), link, front)


def _add_planar_slide(
    bodies: list[list[BodyShape]],
    scene: Scene,
    joint: SceneJoint,
    rail: int,
    slides: dict[str, tuple[float, float]],
    flat: Sequence[np.ndarray],
    normals: Sequence[np.ndarray],
    layers: Sequence[int],
    radius: float,
    thick: float,
) -> None:
    """A rail on one body, and a block that slides on it on the other."""
    block = 1 - rail
    low, high = sorted(slides.get(joint.name, (0.0, 0.0)))
    if rail == 1:
        low, high = -high, -low
    axis = joint.axis_in(rail)
    # The rail lies in the layer of its body, the block around it.
    level = layers[rail] if joint.bodies[rail] != scene.ground else layers[block]
    lift = level * 1.25 * thick * normals[rail]
    ends = [flat[rail] + x * axis + lift for x in (low - 3.5 * radius, high + 3.5 * radius)]
    kind = "groundrail" if joint.bodies[rail] == scene.ground else "rail"
    side = np.cross(normals[rail], axis)
    bodies[joint.bodies[rail]].append(_shape(kind, (*ends, side), (0.45 * radius,)))
    at = flat[block] + level * 1.25 * thick * normals[block]
    own = joint.axis_in(block)
    shape = _shape(
        "block", (at, own, np.cross(normals[block], own)), (4 * radius, 0.95 * radius, 1.1 * thick)
    )
    bodies[joint.bodies[block]].append(shape)


def _without_same(points: Sequence[np.ndarray], least: float) -> list[np.ndarray]:
    kept: list[np.ndarray] = []
    for point in points:
        if all(float(np.linalg.norm(point - p)) > least for p in kept):
            kept.append(point)
    return kept


def _normal_in(scene: Scene, body: int) -> np.ndarray:
    """The normal of the plane of motion in a body's frame."""
    assert scene.planar is not None
    for joint in scene.joints:
        if body in joint.bodies:
            return turn_vectors(joint.frames[joint.bodies.index(body)], scene.planar)
    return scene.planar


def _layers(scene: Scene) -> list[int]:
    """A layer for each body, others for bodies that share a joint; the ground's is the lowest."""
    layers: list[Any] = [None] * len(scene.bodies)
    layers[scene.ground] = 0
    for body in range(len(scene.bodies)):
        if layers[body] is None:
            taken = {
                layers[b] for j in scene.joints if body in j.bodies for b in j.bodies if b != body
            }
            layers[body] = next(k for k in range(1, len(scene.bodies) + 2) if k not in taken)
    return layers
