"""Where joints stand still: extreme values of angles and slides along a motion."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from nag.kinematics.joint_values import Coordinate, joint_coordinates, joint_values, unwrap_angles
from nag.kinematics.path import Path
from nag.numerics.read_only import BooleanArray, FixedArrays, IntegerArray, RealArray, equal_values

# Decides: By how much a joint moves that never does, slides beside the size of the mechanism: 1e-14
# was seen; others moved by 1e-3 and more.
STILL = 1e-9
# Shares of the way between samples by which the parabolas through three points narrow.
NARROWER = (1.0, 0.3, 0.1, 0.03, 0.01)


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
class Values(FixedArrays):
    """Angles and slides along a motion.

    Attributes:
        coordinates: which.
        values: at the samples, unwrapped, shape ``(k, coordinates)``.
        turning: dead points, along the motion.
        ranges: smallest and largest value of each, dead points included.
        turns: by how many whole turns the angle of each grows along a closed motion, or 0.
        still: whether each never moves; of what is in no loop, and moves freely, it is not said.
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


def values_along(path: Path, from_reference: bool = False) -> Values:
    """Angles and slides along a path, and where they are extreme.

    Args:
        from_reference: whether angles count from a configuration on it. Else the middle of what an
            angle takes that does not turn on is between half a turn back and half a turn forth.
    """
    scene = path.curve.scene
    coordinates = joint_coordinates(scene)
    values = unwrap_angles(coordinates, joint_values(scene, path.poses))
    in_loop = np.array([each.in_loop for each in coordinates], dtype=bool)
    angles = np.array([each.kind == "angle" for each in coordinates], dtype=bool)
    units = np.where(angles, 1.0, scene.size)
    still = (np.ptp(values, axis=0) < STILL * units) & in_loop
    whole = np.zeros(len(coordinates), dtype=int)
    if path.closed:
        whole[angles] = np.round((values[-1] - values[0])[angles] / (2 * np.pi)).astype(int)
    extremes = _find_extremes(path, coordinates, in_loop & ~still, units)
    turning = _refine(path, coordinates, values, extremes)
    ranges = np.stack([values.min(axis=0), values.max(axis=0)], axis=-1)
    for i, each in enumerate(coordinates):
        own = [p.value for p in turning if p.coordinate == each.name]
        ranges[i] = min([ranges[i, 0], *own]), max([ranges[i, 1], *own])
    found = Values(coordinates, values, tuple(turning), ranges, whole, still)
    return found if from_reference else _centre(found, angles & (whole == 0))


def _centre(found: Values, columns: np.ndarray) -> Values:
    """The same with angles by whole turns less or more, so that the middle of each is within one.

    Args:
        columns: which coordinates are angles that may be shifted.
    """
    # A middle at half a turn, to rounding, is at half a turn forth.
    turns = np.round(found.ranges.mean(axis=1) / (2 * np.pi) - STILL)
    shift = np.where(columns, 2 * np.pi * turns, 0.0)
    if not shift.any():
        return found
    by_name = {each.name: by for each, by in zip(found.coordinates, shift.tolist(), strict=True)}
    turning = tuple(
        replace(
            p,
            value=p.value - by_name[p.coordinate],
            others=tuple((np.array(p.others) - shift).tolist()),
        )
        for p in found.turning
    )
    return replace(
        found,
        values=found.values - shift,
        ranges=found.ranges - shift[:, None],
        turning=turning,
    )


@dataclass(frozen=True, eq=False)
class _Extremes:
    """Points of a walk next to dead points, shape ``(E,)``.

    Attributes:
        arc: how far along they are; width: how far their neighbours are from them, at the most.
        column: the coordinate that is extreme; smallest: whether it is smallest; near: its value.
    """

    arc: np.ndarray
    width: np.ndarray
    column: np.ndarray
    smallest: np.ndarray
    near: np.ndarray


def _find_extremes(
    path: Path, coordinates: tuple[Coordinate, ...], moving: np.ndarray, units: np.ndarray
) -> _Extremes:
    """The points of the walk at which coordinates that move reverse.

    They are nearer to each other than samples where the curve turns sharply.

    Args:
        moving: which coordinates do; units: sizes that they are compared with.
    """
    curve, arc = path.curve, path.measured.arc
    poses = curve.poses(path.measured.walk.chart)
    values = unwrap_angles(coordinates, joint_values(curve.scene, poses))
    if path.closed:
        # One point more before the first, which is the last but one.
        values = np.vstack([values[-2] - values[-1] + values[0], values])
        arc = np.concatenate([[arc[-2] - arc[-1]], arc])
    found = []
    for column in np.flatnonzero(moving).tolist():
        steps = np.diff(values[:, column]) / units[column]
        # A value that stays the same to rounding has no direction of its own.
        signs = np.sign(np.where(np.abs(steps) < STILL / 10, 0.0, steps))
        # Round a closed motion a coordinate reverses an even number of times.
        before = next(filter(None, signs[::-1].tolist()), 0.0) if path.closed else 0.0
        for i, sign in enumerate(signs.tolist()):
            if before * sign < 0 and i > 0:
                found.append((i, column, sign > 0))
            before = sign or before
    at, columns, smallest = np.array(found, dtype=int).reshape(-1, 3).T
    width = np.maximum(arc[at + 1] - arc[at], arc[at] - arc[at - 1])
    return _Extremes(arc[at], width, columns, smallest.astype(bool), values[at, columns])


def _nearest_turns(
    coordinates: tuple[Coordinate, ...], values: np.ndarray, near: np.ndarray
) -> tuple[float, ...]:
    """Values whose angles are within half a turn of those of a sample."""
    angles = np.array([each.kind == "angle" for each in coordinates], dtype=bool)
    turned = near + (values - near + np.pi) % (2 * np.pi) - np.pi
    return tuple(np.where(angles, turned, values).tolist())


def _refine(
    path: Path, coordinates: tuple[Coordinate, ...], values: np.ndarray, extremes: _Extremes
) -> list[TurningPoint]:
    """The dead points next to samples, along the motion; all are refined together."""
    near, columns = extremes.near, extremes.column
    if not len(near):
        return []
    angle = np.array([each.kind == "angle" for each in coordinates], dtype=bool)[columns]

    def values_at(places: np.ndarray) -> np.ndarray:
        chart = path.measured.points_at(extremes.arc + places * extremes.width)
        return joint_values(path.curve.scene, path.curve.poses(chart))

    def own_of(there: np.ndarray) -> np.ndarray:
        own = there[np.arange(len(there)), columns]
        return np.where(angle, near + (own - near + np.pi) % (2 * np.pi) - np.pi, own)

    # Places in widths from the nearest point.
    at, curved = np.zeros(len(near)), np.ones(len(near), dtype=bool)
    for width in NARROWER:
        low, middle, high = (own_of(values_at(at + width * k)) for k in (-1.0, 0.0, 1.0))
        bend = high - 2 * middle + low
        curved &= bend != 0
        step = np.clip((low - high) / (2 * np.where(curved, bend, 1.0)), -1.0, 1.0)
        at += np.where(curved, step * width, 0.0)
    every = values_at(at)
    last = own_of(every)
    better = np.isfinite(last) & np.where(extremes.smallest, last <= near, last >= near)
    best = np.where(better, last, near)
    turning = []
    for k, arc in enumerate((extremes.arc + at * extremes.width).tolist()):
        # What is the first sample to rounding is not the last.
        arc = arc % path.length if path.closed and abs(arc) > STILL else max(arc, 0.0)
        sample = round(arc / path.step)
        there = _nearest_turns(coordinates, every[k], values[sample])
        kind = "smallest" if extremes.smallest[k] else "largest"
        name = coordinates[columns[k]].name
        turning.append(TurningPoint(name, sample, arc, float(best[k]), kind, there))
    return sorted(turning, key=lambda p: (p.arc, p.coordinate))
