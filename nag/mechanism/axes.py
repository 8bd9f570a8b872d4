"""Lines in space, decided exactly: vectors, and what the axes of a mechanism have in common."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd
from typing import Any, Literal

from nag.algebra.number import Number, is_zero, square_root
from nag.mechanism.graph import Joint

Vector = tuple[Any, Any, Any]
Space = Literal["planar", "spherical", "spatial"]


def dot(u: Sequence[Any], v: Sequence[Any]) -> Any:
    """The bilinear product <u, v>, without conjugation."""
    return sum((x * y for x, y in zip(u[1:], v[1:], strict=True)), u[0] * v[0])


def cross(u: Sequence[Any], v: Sequence[Any]) -> Vector:
    """The vector product u x v."""
    return (
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    )


def difference(u: Sequence[Any], v: Sequence[Any]) -> tuple[Any, ...]:
    """u - v."""
    return tuple(x - y for x, y in zip(u, v, strict=True))


def vanishes(u: Sequence[Number]) -> bool:
    """Whether all entries are zero."""
    return all(is_zero(x) for x in u)


def direction(axis: Sequence[Number]) -> Vector:
    """A multiple of ``axis``: of unit length where that is rational, else with small integers.

    The line stays the same; a rational unit vector keeps every norm in the models equal to 1, and
    where there is none the models carry the squared length instead of a square root.
    """
    if not all(isinstance(x, Fraction) for x in axis):
        return tuple(axis)
    denominator = 1
    for x in axis:
        denominator = denominator * x.denominator // gcd(denominator, x.denominator)
    divisor = gcd(*(int(x * denominator) for x in axis))
    primitive = tuple(x * denominator / divisor for x in axis)
    length = square_root(dot(primitive, primitive))
    if isinstance(length, Fraction):
        return tuple(x / length for x in primitive)
    return primitive


def parallel(first: Joint, second: Joint) -> bool:
    """Whether the axes have the same direction."""
    return vanishes(cross(first.axis, second.axis))


def skew(first: Joint, second: Joint) -> bool:
    """Whether the axes neither meet nor are parallel."""
    return not is_zero(dot(difference(second.point, first.point), cross(first.axis, second.axis)))


def coincident(first: Joint, second: Joint) -> bool:
    """Whether the axes are the same line."""
    return parallel(first, second) and on_axis(second.point, first)


def on_axis(point: Sequence[Number], joint: Joint) -> bool:
    """Whether ``point`` lies on the axis of ``joint``."""
    return vanishes(cross(difference(point, joint.point), joint.axis))


def meeting_point(first: Joint, second: Joint) -> Vector | None:
    """The point in which two axes that are not parallel meet, or None."""
    normal = cross(first.axis, second.axis)
    if vanishes(normal) or skew(first, second):
        return None
    gap = difference(second.point, first.point)
    t = dot(cross(gap, second.axis), normal) / dot(normal, normal)
    return tuple(p + t * x for p, x in zip(first.point, first.axis, strict=True))


def space_of(joints: Sequence[Joint]) -> Space:
    """The smallest geometry that holds all axes.

    Planar if all are parallel, spherical if all pass through one point, else spatial.
    """
    first = joints[0]
    other = next((j for j in joints[1:] if not parallel(first, j)), None)
    if other is None:
        return "planar"
    centre = meeting_point(first, other)
    if centre is not None and all(on_axis(centre, j) for j in joints):
        return "spherical"
    return "spatial"
