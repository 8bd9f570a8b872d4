"""Angles of joints against each other, and paths of points, along a motion."""

from __future__ import annotations

import numpy as np

from nag.errors import NagError
from nag.kinematics.joint_values import joint_coordinates
from nag.kinematics.motion import Circuit, Motion
from nag.kinematics.scene import Scene
from nag.pictures.plane_curves import SINGULAR, Axis, CurvesInStyle, draw_plane_curves


def joint_indices(scene: Scene, names: tuple[str, str]) -> tuple[int, int]:
    """Where the values of two joints stand.

    Raises:
        NagError: if there is no value of that name; of joints with several, each has its own.
    """
    if len(names) != 2:
        raise NagError(
            f"joints: give two, whose values are drawn against each other; {len(names)} are given"
        )
    known = [c.name for c in joint_coordinates(scene)]
    for name in names:
        if name not in known:
            raise NagError(f"{name!r} is no joint with an angle or a slide; there are "
                           f"{', '.join(known) or 'none'}")  # fmt: skip
    return known.index(names[0]), known.index(names[1])


def point_of(scene: Scene, name: str) -> tuple[int, np.ndarray]:
    """A body and a place in its frame: a framework's point, or a joint's by its name.

    Raises:
        NagError: if there is none of that name.
    """
    places = {j.name: (j.bodies[1], j.points[1]) for j in scene.joints} | scene.points
    if name not in places:
        raise NagError(f"{name!r} is no point or joint; there are {', '.join(places)}")
    return places[name]


def draw_joint_values(motion: Motion, names: tuple[str, str], title: str, path: str) -> None:
    """The values of two joints against each other, each circuit in a style of its own.

    Raises:
        NagError: if there is no value of a name.
        OSError: if the file cannot be written.
    """
    first, second = joint_indices(motion.scene, names)
    coordinates = joint_coordinates(motion.scene)
    chosen = coordinates[first], coordinates[second]
    units = [np.degrees(1.0) if c.kind == "angle" else 1.0 for c in chosen]
    axes = [Axis(c.name, c.kind == "angle") for c in chosen]
    drawn = [_plane(c, c.values.values[:, [first, second]] * units) for c in motion.circuits]
    draw_plane_curves(drawn, (axes[0], axes[1]), title, path)


def draw_point_paths(
    motion: Motion, name: str, onto: tuple[int, int], title: str, path: str
) -> None:
    """The path of a point in two of the ground's coordinates, of each circuit.

    Raises:
        NagError: if there is no point or joint of that name.
        OSError: if the file cannot be written.
    """
    body, place = point_of(motion.scene, name)
    axes = [Axis(f"{'xyz'[i]} of {name}") for i in onto]
    drawn = [_plane(c, c.poses.move(body, place)[:, list(onto)]) for c in motion.circuits]
    draw_plane_curves(drawn, (axes[0], axes[1]), title, path)


def _plane(circuit: Circuit, points: np.ndarray) -> CurvesInStyle:
    crossings = [c.sample for c in circuit.crossings]
    marked = [(SINGULAR, points[crossings])] if crossings else []
    return CurvesInStyle(f"circuit {circuit.number}", [points], marked)
