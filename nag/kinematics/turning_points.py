"""Where joints stand still: extreme values of angles and slides along a motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.kinematics.joint_values import Coordinate, joint_coordinates, joint_values, unwrap_angles
from nag.kinematics.path import Path, along_three
from nag.numerics.read_only import BooleanArray, IntegerArray, RealArray, equal_values

# Decides: By how much a joint moves that never does: 1e-14 was seen; others moved by 1e-3 and more.
STILL = 1e-9
# Shares of the way between samples by which the parabolas through three points narrow.
NARROWER = (1.0, 0.05, 0.05)


@dataclass(frozen=True)
class TurningPoint:
    """A dead point: a joint reverses there.

    Attributes:
        coordinate: its name.
        sample: index of the sample next to it.
        arc: how far it is along the motion.
        value: the angle in radians, unwrapped, or slide.
        kind: ``"largest"`` or ``"smallest"`` of the values near it.
        others: the values of all coordinates there, in their order.
    """

    coordinate: str
    sample: int
    arc: float
    value: float
    kind: str
    others: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Values:
    """Angles and slides along a motion.

    Attributes:
        coordinates: which.
        values: at the samples, unwrapped, shape ``(k, coordinates)``.
        turning: dead points, along the motion.
        ranges: smallest and largest value of each, dead points included.
        turns: by how many whole turns the angle of each grows along a closed motion, or 0.
        still: whether each never moves.
    """

    coordinates: tuple[Coordinate, ...]
    values: RealArray
    turning: tuple[TurningPoint, ...]
    ranges: RealArray
    turns: IntegerArray
    still: BooleanArray

    __eq__ = equal_values

    def turns_fully(self, index: int) -> bool:
        """Whether an angle takes all values."""
        low, high = self.ranges[index]
        return self.coordinates[index].kind == "angle" and bool(high - low >= 2 * np.pi - STILL)


def values_along(path: Path) -> Values:
    """Angles and slides along a path, and where they are extreme."""
    scene = path.curve.scene
    coordinates = joint_coordinates(scene)
    values = unwrap_angles(coordinates, joint_values(scene, path.poses))
    still = np.ptp(values, axis=0) < STILL
    whole = np.zeros(len(coordinates), dtype=int)
    if path.walk.closed:
        angles = np.array([each.kind == "angle" for each in coordinates], dtype=bool)
        whole[angles] = np.round((values[-1] - values[0])[angles] / (2 * np.pi)).astype(int)
    turning = [
        point
        for column in range(len(coordinates))
        if not still[column]
        for point in _extremes(path, coordinates, values, column)
    ]
    turning.sort(key=lambda p: (p.arc, p.coordinate))
    ranges = np.stack([values.min(axis=0), values.max(axis=0)], axis=-1)
    for i, each in enumerate(coordinates):
        own = [p.value for p in turning if p.coordinate == each.name]
        ranges[i] = min([ranges[i, 0], *own]), max([ranges[i, 1], *own])
    return Values(coordinates, values, tuple(turning), ranges, whole, still)


def _extremes(
    path: Path, coordinates: tuple[Coordinate, ...], values: np.ndarray, column: int
) -> list[TurningPoint]:
    """The dead points of one coordinate."""
    own = values[:, column]
    chart = path.chart
    if path.walk.closed:
        # One sample more before the first, which is the last but one.
        own = np.concatenate([[own[-2] - own[-1] + own[0]], own])
        chart = np.concatenate([path.before_first[None], chart])
    steps = np.diff(own)
    # A value that stays the same to rounding has no direction of its own.
    signs = np.sign(np.where(np.abs(steps) < STILL / 10, 0.0, steps))
    found = []
    before = 0.0
    for i, sign in enumerate(signs):
        if before * sign < 0 and i > 0:
            index = i - 1 if path.walk.closed else i
            triple = chart[i - 1 : i + 2]
            parameter, value, all_values = _refine(path, triple, own[i], column, sign > 0)
            step = path.arc[1] - path.arc[0]
            arc = path.arc[index] + parameter * step
            # What is the first sample to rounding is not the last.
            arc = arc % path.length if path.walk.closed and abs(arc) > STILL else max(arc, 0.0)
            kind = "smallest" if sign > 0 else "largest"
            sample = round(arc / step)
            there = _nearest_turns(coordinates, all_values, values[index])
            name = coordinates[column].name
            found.append(TurningPoint(name, sample, float(arc), value, kind, there))
        before = sign or before
    return found


def _nearest_turns(
    coordinates: tuple[Coordinate, ...], values: np.ndarray, near: np.ndarray
) -> tuple[float, ...]:
    """Values whose angles are within half a turn of those of a sample."""
    angles = np.array([each.kind == "angle" for each in coordinates], dtype=bool)
    turned = near + (values - near + np.pi) % (2 * np.pi) - np.pi
    return tuple(np.where(angles, turned, values).tolist())


def _refine(
    path: Path, triple: np.ndarray, near: float, column: int, smallest: bool
) -> tuple[float, float, np.ndarray]:
    """Place, in steps from the middle one of three samples, value of an extreme one, and all."""
    scene, at = path.curve.scene, 0.0
    coordinates = joint_coordinates(scene)
    kind = coordinates[column].kind

    def values_at(t: np.ndarray) -> np.ndarray:
        chart = along_three(*triple, t)
        return joint_values(scene, path.curve.poses(path.curve.sharpen(chart)))

    def value_at(t: np.ndarray) -> np.ndarray:
        values = values_at(t)[:, column]
        if kind == "angle":
            values = near + (values - near + np.pi) % (2 * np.pi) - np.pi
        return values

    best = near
    for width in NARROWER:
        low, middle, high = value_at(at + width * np.array([-1.0, 0.0, 1.0]))
        bend = high - 2 * middle + low
        if not bend:
            break
        at += float(np.clip((low - high) / (2 * bend), -1.0, 1.0)) * width
    last = float(value_at(np.array([at]))[0])
    if np.isfinite(last) and (last <= near if smallest else last >= near):
        best = last
    return at, float(best), values_at(np.array([at]))[0]
