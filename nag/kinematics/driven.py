"""Assemblies at a given value of one joint: all real ones on the circuits of a motion.

Between two dead points next to each other a joint takes a value at most once, so that none is
missed between samples.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.errors import NagError
from nag.kinematics.joint_values import Coordinate, joint_coordinates, joint_values
from nag.kinematics.path import Path
from nag.kinematics.poses import Poses
from nag.kinematics.scene import Scene
from nag.kinematics.turning_points import STILL, Values
from nag.text.table import join_words

# Steps that narrow an interval in which a joint has a value, to nothing.
STEPS = 60


@dataclass(frozen=True)
class Drive:
    """A joint that is held at a value.

    Attributes:
        coordinate: name of its angle or slide.
        value: in radians, or a length.
    """

    coordinate: str
    value: float


@dataclass(frozen=True, eq=False)
class DrivenAssembly:
    """An assembly at the value.

    Attributes:
        circuit: number of the circuit that it is on.
        arc: how far along that.
        values: angles, between -pi and pi, and slides, shape ``(coordinates,)``.
        poses: of the bodies, at this one configuration.
    """

    circuit: int
    arc: float
    values: np.ndarray
    poses: Poses


def check_drive(scene: Scene, drive: Drive) -> int:
    """The column of the coordinate that is held.

    Raises:
        NagError: if there is none of that name, or the value is no number.
    """
    names = [each.name for each in joint_coordinates(scene)]
    if drive.coordinate not in names:
        there = f"they are {join_words(names)}" if names else "no joint has one"
        raise NagError(f"drive: {drive.coordinate[:40]!r} is no angle or slide; {there}")
    if not np.isfinite(drive.value):
        raise NagError("drive: the value has to be a finite number")
    return names.index(drive.coordinate)


def assemblies_on(
    path: Path, values: Values, drive: Drive, circuit: int, end: float
) -> list[DrivenAssembly]:
    """The assemblies on one path, as far as ``end``, in their order."""
    scene = path.curve.scene
    column = check_drive(scene, drive)
    each = values.coordinates[column]
    if values.still[column]:
        raise NagError(f"drive: {each.name} never moves on circuit {circuit}")
    step = path.length / (len(path.arc) - 1)
    nodes = [(float(i), float(v)) for i, v in enumerate(values.values[:, column])]
    nodes += [(p.arc / step, p.value) for p in values.turning if p.coordinate == each.name]
    nodes = sorted(n for n in nodes if n[0] <= min(end / step, len(path.arc) - 1) + STILL)
    found = []
    for target in _targets(each, drive.value, nodes):
        gaps = [0.0 if abs(v - target) < STILL else v - target for _, v in nodes]
        for k, (place, _) in enumerate(nodes):
            last = k == len(nodes) - 1
            if gaps[k] == 0.0 and not (last and path.walk.closed):
                # A dead point that is a sample, too, counts once.
                if not (k and gaps[k - 1] == 0.0):
                    found.append(place)
            elif not last and gaps[k] * gaps[k + 1] < 0:
                found.append(_narrow(path, column, each, target, place, nodes[k + 1][0]))
    found.sort()
    return [_assembly(path, circuit, place, step) for place in found]


def _targets(each: Coordinate, value: float, nodes: list[tuple[float, float]]) -> list[float]:
    """The value, and those that differ by whole turns, as far as there are any."""
    if each.kind == "slide":
        return [value]
    low, high = (f(v for _, v in nodes) for f in (min, max))
    whole = 2 * np.pi
    first = int(np.ceil((low - STILL - value) / whole))
    last = int(np.floor((high + STILL - value) / whole))
    return [value + whole * k for k in range(first, last + 1)]


def _chart_at(path: Path, place: float) -> np.ndarray:
    """The point of the curve at a place between samples, shape ``(1, n)``."""
    i = min(int(place), len(path.chart) - 2)
    t = place - i
    return path.curve.sharpen(((1 - t) * path.chart[i] + t * path.chart[i + 1])[None])


def _narrow(
    path: Path, column: int, each: Coordinate, target: float, low: float, high: float
) -> float:
    """The place at which a coordinate has a value, between two others."""
    scene = path.curve.scene

    def gap(place: float) -> float:
        value = joint_values(scene, path.curve.poses(_chart_at(path, place)))[0, column]
        away = float(value - target)
        if each.kind == "angle":
            away = (away + np.pi) % (2 * np.pi) - np.pi
        return away

    ends = [(low, gap(low)), (high, gap(high))]
    for _ in range(STEPS):
        (a, f), (b, g) = ends
        if f * g >= 0 or b - a < STILL**2:
            break
        # The chord's zero, but never nearer to an end than a tenth: bisection at the least.
        share = min(max(f / (f - g), 1 / 10), 9 / 10)
        middle = a + share * (b - a)
        value = gap(middle)
        ends[0 if f * value > 0 else 1] = (middle, value)
        if value == 0.0:
            return middle
    return min(ends, key=lambda e: abs(e[1]))[0]


def _assembly(path: Path, circuit: int, place: float, step: float) -> DrivenAssembly:
    poses = path.curve.poses(_chart_at(path, place))
    return DrivenAssembly(circuit, place * step, joint_values(path.curve.scene, poses)[0], poses)
