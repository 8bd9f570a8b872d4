"""Axes as lines by Pluecker coordinates: a direction, and the moment point x direction.

Other programs for linkages have their axes like that, rational-linkages among them, whose lines
are read as they are. Any point of an axis may be given: in doubles stands the one nearest to the
middle of the mechanism, found exactly, since one far along the axis would hide all lengths.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import ceil, hypot, log2
from typing import Any

import numpy as np

from nag.algebra.exact_ranks import row_echelon
from nag.algebra.from_python import exact_vector
from nag.algebra.number import Number, is_zero, rounded_fraction
from nag.errors import MechanismError
from nag.mechanism.axes import Vector, cross, difference, dot, vanishes
from nag.mechanism.given_rotation import NEAR
from nag.mechanism.graph import ORIGIN, Joint, Mechanism

# Steps by which points are moved along axes, beside the longest link, at least; digits that
# irrational numbers of steps are taken to.
STEP, DIGITS_OF_STEPS = 4, 40
UNITS = tuple(tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3))
# Decides: Singular values, beside the largest, of directions in which no axis bounds the middle.
PARALLEL = 1e-6
# Steps to the middle; after the first one differences are those of near points.
REFINEMENTS = 2


def loop_of_lines(lines: Iterable[Any]) -> Mechanism:
    """The closed loop of revolute joints about lines, in their order; the first body is fixed.

    Raises:
        MechanismError: if one is no line.
    """
    axes = [_axis(line, i) for i, line in enumerate(lines)]
    count = len(axes)
    joints = [
        Joint(f"J{i + 1}", "revolute", (f"link{i}", f"link{(i + 1) % count}"), point, axis)
        for i, (point, axis) in enumerate(axes)
    ]
    return Mechanism("link0", tuple(joints))


def _axis(line: Any, index: int) -> tuple[Sequence[Any], Sequence[Any]]:
    """A point and the direction of a line."""
    try:
        values = exact_vector(list(line), f"lines[{index}]")
    except TypeError:
        values = ()
    if len(values) != 6:
        raise MechanismError(f"lines[{index}]: give six numbers, a direction and its moment")
    direction, moment = values[:3], values[3:]
    if vanishes(direction):
        raise MechanismError(f"lines[{index}]: its direction has length zero")
    product, squared = dot(direction, moment), dot(direction, direction)
    if not is_zero(product):
        size = float(squared) ** 0.5 * float(dot(moment, moment)) ** 0.5
        if abs(float(product)) > NEAR * size:
            raise MechanismError(
                f"lines[{index}]: direction and moment are not orthogonal; the moment is point x "
                "direction"
            )
    return tuple(x / squared for x in cross(direction, moment)), direction


def middle_of(
    joints: Sequence[Joint], start: Vector = ORIGIN, parallel: float = PARALLEL
) -> Vector:
    """The point with the least squared distances from axes of turns and from centres, rational.

    The same whatever points of their axes the joints name. Of parallel axes the one in the plane
    through ``start`` across them.

    Args:
        parallel: angle below which axes are: where they all but meet may be anywhere.
    """
    placed = [joint for joint in joints if has_place(joint)]
    across = np.array([_projection(joint) for joint in placed]).reshape(-1, 3, 3)
    middle = start
    for _ in range(REFINEMENTS):
        away = [difference(nearest_on_axis(joint, middle), middle) for joint in placed]
        values = [own @ [float(x) for x in d] for own, d in zip(across, away, strict=True)]
        rows = across.reshape(-1, 3), np.array(values).reshape(-1)
        step = np.linalg.lstsq(*rows, rcond=parallel)[0]
        middle = tuple(x + Fraction(d) for x, d in zip(middle, step.tolist(), strict=True))
    return middle


def median_of_places(joints: Sequence[Joint]) -> Vector:
    """The median, coordinate by coordinate, of the points that joints name, rational."""
    named = [[float(x) for x in joint.point] for joint in joints if has_place(joint)]
    return tuple(map(Fraction, np.median(named, axis=0).tolist())) if named else ORIGIN


def _projection(joint: Joint) -> np.ndarray:
    """The matrix that takes the gap from a joint's place to the part that cannot be chosen."""
    if not turns_about_line(joint):
        return np.eye(3)
    axis = np.array([float(x) for x in joint.axis])
    axis /= np.linalg.norm(axis)
    return np.eye(3) - np.outer(axis, axis)


def has_place(joint: Joint) -> bool:
    """Whether it matters where a joint is: where it slides in a plane only directions do."""
    return "point" in joint.of_type.fields


def turns_about_line(joint: Joint) -> bool:
    """Whether any point of its axis may stand for a joint."""
    return bool({"turn", "plane"} & set(joint.of_type.factors)) and joint.second_axis is None


def nearest_on_axis(joint: Joint, to: Vector) -> Vector:
    """The point of a joint's axis that is nearest to a point, exactly; else its centre."""
    if not has_place(joint):
        return to
    if not turns_about_line(joint):
        return joint.point
    along = dot(difference(to, joint.point), joint.axis) / dot(joint.axis, joint.axis)
    return tuple(x + along * y for x, y in zip(joint.point, joint.axis, strict=True))


def given_links(joints: Sequence[Joint]) -> list[Vector]:
    """The vectors from each joint of a loop to the next, between the points that are named."""
    return [difference(joint.point, joints[i - 1].point) for i, joint in enumerate(joints)]


def short_links(joints: Sequence[Joint]) -> list[Vector]:
    """The vectors from each joint of a loop to the next, between points that make them short.

    The i-th one leads from the joint before to the i-th. Any point of its axis may stand for a
    joint that turns about it, any point at all for one that slides alone. Of all choices one has
    the least sum of squares; a joint whose point is farther from that one than some of the longest
    link is moved there, by a round number of steps, so that numbers stay as short as they are.
    """
    ways = [_free_directions(joint) for joint in joints]
    given = given_links(joints)
    free = [(i, way) for i, own in enumerate(ways) for way in own]
    last = len(joints) - 1

    def derivative(k: int, link: int) -> Vector | None:
        i, way = free[k]
        if i == link:
            return way
        before = i == link - 1 or (link == 0 and i == last)
        return tuple(-x for x in way) if before else None

    def product(u: Vector | None, v: Vector | None) -> Number:
        return Fraction(0) if u is None or v is None else dot(u, v)

    slopes = [[derivative(k, link) for link in range(len(joints))] for k in range(len(free))]
    matrix = [
        [
            *(
                sum((product(u, v) for u, v in zip(one, other, strict=True)), Fraction(0))
                for other in slopes
            ),
            -sum((product(u, v) for u, v in zip(one, given, strict=True)), Fraction(0)),
        ]
        for one in slopes
    ]

    def shift_points(shifts: Sequence[Number]) -> list[Vector]:
        points = [joint.point for joint in joints]
        for (i, way), shift in zip(free, shifts, strict=True):
            points[i] = tuple(x + shift * y for x, y in zip(points[i], way, strict=True))
        return [difference(point, points[i - 1]) for i, point in enumerate(points)]

    shifts: list[Number] = [Fraction(0)] * len(free)
    # Where axes are parallel some are free, and stay.
    for row, pivot in zip(*row_echelon(matrix), strict=True):
        shifts[pivot] = row[-1]
    longest = max(_length(link) for link in shift_points(shifts))
    if not longest:
        return given
    sizes = [longest / _length(way) for _, way in free]
    return shift_points([_round_steps(t, size) for t, size in zip(shifts, sizes, strict=True)])


def _length(vector: Vector) -> float:
    return hypot(*map(float, vector))


def _round_steps(shift: Number, size: float) -> Fraction:
    """A shift to within a few sizes, in steps of a power of two; none if it is no longer."""
    step = Fraction(2) ** ceil(log2(STEP * size))
    return round(rounded_fraction(shift, DIGITS_OF_STEPS) / step) * step


def _free_directions(joint: Joint) -> tuple[Vector, ...]:
    """Along which the point of a joint may be moved."""
    if joint.of_type.slides_only:
        return UNITS
    return (joint.axis,) if turns_about_line(joint) else ()


def lines_of(mechanism: Mechanism) -> np.ndarray:
    """Direction, of length 1, and moment of each joint that has an axis, shape ``(k, 6)``."""
    rows = []
    for joint in mechanism.joints:
        if joint.axis is not None:
            direction = np.array([float(x) for x in joint.axis])
            direction /= np.linalg.norm(direction)
            near = nearest_on_axis(joint, ORIGIN)
            moment = np.cross([float(x) for x in near], direction)
            rows.append([*direction, *moment])
    return np.array(rows).reshape(-1, 6)


def exact_lines_of(mechanism: Mechanism) -> tuple[tuple[Number, ...], ...]:
    """The same in the numbers that are given, directions of any length."""
    placed = [joint for joint in mechanism.joints if joint.axis is not None]
    return tuple((*joint.axis, *cross(joint.point, joint.axis)) for joint in placed)
