"""Angles and slides of joints along poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from nag.kinematics.poses import Poses, turn_back, turn_product, turn_vectors
from nag.kinematics.scene import Scene, SceneJoint
from nag.mechanism.joint_types import COORDINATES, JOINT_TYPES


@dataclass(frozen=True)
class Coordinate:
    """One freedom of a joint that has a value.

    Attributes:
        name: the joint's, with what it is behind it where the joint has several.
        joint: the joint's name.
        kind: ``"angle"``, in radians, or ``"slide"``, a length.
        in_loop: whether the joint is in a loop; else it moves freely, whatever its value here.
    """

    name: str
    joint: str
    kind: Literal["angle", "slide"]
    in_loop: bool = True


def joint_coordinates(scene: Scene) -> tuple[Coordinate, ...]:
    """What `joint_values` gives, in its order; spherical joints have no angles."""
    return tuple(
        Coordinate(
            f"{joint.name}.{part}" if len(parts) > 1 else joint.name,
            joint.name,
            kind,
            joint.in_loop,
        )
        for joint in scene.joints
        for parts in [COORDINATES[JOINT_TYPES[joint.type].factors]]
        for part, kind in parts
    )


def joint_values(scene: Scene, poses: Poses) -> np.ndarray:
    """Angles in radians, each between -pi and pi, and slides, shape ``(k, coordinates)``.

    An angle is that by which the second body has turned against the first about the axis, a slide
    how far the joint's point on the second is from that on the first, along the axis. They count
    from the reference configuration, where there is one, else from the bodies' own frames. Of a
    universal joint the first angle is that about the first body's axis; the slides of a planar one
    are along the directions of `across`, which the first body carries.
    """
    columns = [x for joint in scene.joints for x in _values(joint, poses)]
    return np.stack(columns, axis=-1) if columns else np.zeros((len(poses), 0))


def unwrap_angles(coordinates: tuple[Coordinate, ...], values: np.ndarray) -> np.ndarray:
    """Values along a curve, with angles that do not jump by whole turns; the first ones stay."""
    angles = [i for i, each in enumerate(coordinates) if each.kind == "angle"]
    unwrapped = values.copy()
    unwrapped[:, angles] = np.unwrap(values[:, angles], axis=0)
    return unwrapped


def _values(joint: SceneJoint, poses: Poses) -> list[np.ndarray]:
    factors = JOINT_TYPES[joint.type].factors
    if not COORDINATES[factors]:
        return []
    first, second = joint.bodies
    before = turn_product(poses.turns[first], joint.frames[0])
    relative = turn_product(turn_back(before), turn_product(poses.turns[second], joint.frames[1]))
    if factors == ("turn", "turn"):
        return _two_angles(joint, relative)
    found = []
    if factors[0] in ("turn", "plane"):
        found.append(2 * np.arctan2(relative[:, 1:] @ joint.axis, relative[:, 0]))
        found[-1] = (found[-1] + np.pi) % (2 * np.pi) - np.pi
    if factors[-1] in ("slide", "plane"):
        gap = poses.move(second, joint.points[1]) - poses.move(first, joint.points[0])
        gap = turn_vectors(turn_back(before), gap)
        directions = [joint.axis] if factors[-1] == "slide" else across(joint.axis)
        found += [gap @ u for u in directions]
    return found


def _two_angles(joint: SceneJoint, relative: np.ndarray) -> list[np.ndarray]:
    """Angles about both axes of a universal joint.

    The relative quaternion is (c + s u)(c' + s' v) = cc' - ss' (u.v) + sc' u + cs' v + ss' u x v,
    with u and v at any angle, so that its coordinates in this basis give the products of cosines
    and sines of half the angles.
    """
    u, v = joint.axis, joint.second_axis
    assert u is not None and v is not None
    basis = np.stack([u, v, np.cross(u, v)], axis=-1)
    along_u, along_v, along_both = np.linalg.solve(basis, relative[:, 1:].T)
    one = relative[:, 0] + along_both * (u @ v)
    return [
        np.arctan2(
            2 * (one * along_u + along_v * along_both),
            one**2 + along_v**2 - along_u**2 - along_both**2,
        ),
        np.arctan2(
            2 * (one * along_v + along_u * along_both),
            one**2 + along_u**2 - along_v**2 - along_both**2,
        ),
    ]


def across(axis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors across a unit vector, with which they are right-handed: x and y of a plane.

    Of an axis along z they are x and y of the drawing, along x y and z, along y z and x: the first
    is the next vector of the drawing after that which the axis is nearest to, across the axis.
    """
    nearest = int(np.abs(axis).argmax())
    first = np.eye(3)[(nearest + 1) % 3]
    first = first - (first @ axis) * axis
    first /= np.linalg.norm(first)
    return first, np.cross(axis, first)


def joint_errors(scene: Scene, poses: Poses) -> np.ndarray:
    """How far joints are open, shape ``(k, joints)``.

    The largest of the distance of their points as both bodies carry them, over the size of the
    scene, but along what slides, and of the differences of their axes.
    """
    return np.stack([_errors(j, poses, scene.size) for j in scene.joints], axis=-1)


def _errors(joint: SceneJoint, poses: Poses, size: float) -> np.ndarray:
    own = JOINT_TYPES[joint.type]
    first, second = joint.bodies
    gap = poses.move(second, joint.points[1]) - poses.move(first, joint.points[0])
    errors = np.zeros(len(poses))
    if joint.axis is not None:
        axes = [poses.turn(b, joint.axis_in(k)) for k, b in enumerate(joint.bodies)]
        if own.orthogonalities == 1:
            other = poses.turn(second, joint.axis_in(1, second=True))
            assert joint.second_axis is not None
            errors = np.abs((axes[0] * other).sum(axis=-1) - joint.axis @ joint.second_axis)
        elif own.orthogonalities:
            errors = np.linalg.norm(axes[0] - axes[1], axis=-1)
        along = (gap * axes[0]).sum(axis=-1)
        if own.gaps == 2:
            gap = gap - along[:, None] * axes[0]
        elif own.gaps == 1:
            gap = along[:, None]
    return np.maximum(errors, np.linalg.norm(gap, axis=-1) / size)
