"""Lines in space, decided exactly: vectors, and what the axes of a mechanism have in common."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd
from typing import Any, Literal

from nag.algebra.number import Number, is_zero, square_root
from nag.errors import NagError
from nag.mechanism.graph import Joint

Vector = tuple[Any, Any, Any]
Space = Literal["planar", "spherical", "spatial"]

# Squared length from which an integer direction is shortened.
LONG = 100


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
    where there is none the models carry the squared length instead of a square root. Long integer
    vectors are divided by a power of two near their length: a norm c^2 + N s^2 with a large N is so
    small at ordinary turns that it cannot be told from zero.
    """
    if not all(isinstance(x, Fraction) for x in axis):
        return tuple(axis)
    denominator = 1
    for x in axis:
        denominator = denominator * x.denominator // gcd(denominator, x.denominator)
    divisor = gcd(*(int(x * denominator) for x in axis))
    primitive = tuple(x * denominator / divisor for x in axis)
    squared = dot(primitive, primitive)
    length = square_root(squared)
    if isinstance(length, Fraction):
        return tuple(x / length for x in primitive)
    if squared > LONG:
        return tuple(x / 2 ** (int(squared).bit_length() // 2) for x in primitive)
    return primitive


def parallel(first: Joint, second: Joint) -> bool:
    """Whether the axes have the same direction."""
    return vanishes(cross(first.axis, second.axis))


def skew(first: Joint, second: Joint) -> bool:
    """Whether the axes neither meet nor are parallel."""
    return not is_zero(dot(difference(second.point, first.point), cross(first.axis, second.axis)))


def on_axis(point: Sequence[Number], joint: Joint) -> bool:
    """Whether ``point`` lies on the axis of ``joint``."""
    return vanishes(cross(difference(point, joint.point), joint.axis))


def meeting_point(first: Joint, second: Joint) -> Vector | None:
    """The point in which two axes that are not parallel meet, or None."""
    if parallel(first, second) or skew(first, second):
        return None
    return nearest((first.point, first.axis), (second.point, second.axis))


def nearest(first: tuple[Vector, Vector], second: tuple[Vector, Vector]) -> Vector:
    """The point of a line, a point and a direction, that is nearest to one not parallel to it."""
    (p, u), (q, v) = first, second
    normal = cross(u, v)
    t = dot(cross(difference(q, p), v), normal) / dot(normal, normal)
    return tuple(x + t * y for x, y in zip(p, u, strict=True))


def same_line(first: Joint, second: Joint) -> bool:
    """Whether both have one and the same axis."""
    return parallel(first, second) and on_axis(second.point, first)


def zero_length(link: str, first: str, second: str) -> str:
    """What is said of a link whose two joints have one axis."""
    return f"{link} has length zero: {first} and {second} turn about one line"


def across(axis: Sequence[Number]) -> tuple[Vector, Vector]:
    """Two vectors e2 and e3 = axis x e2 orthogonal to ``axis`` and to each other."""
    units = [tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3)]
    candidates = [cross(axis, unit) for unit in units]
    second = direction(next(v for v in candidates if not vanishes(v)))
    if all(isinstance(x, Fraction) for x in second):
        size = max(abs(x) for x in second)
        second = tuple(x / size for x in second) if size > 1 else second
    return second, cross(axis, second)


def space_of(joints: Sequence[Joint]) -> Space:
    """The smallest geometry that holds all joints.

    Planar if all axes of revolute joints are parallel and all slides orthogonal to them; spherical
    if all joints turn about one point; else spatial. Rigid joints fit everywhere.
    """
    free = [j for j in joints if not j.of_type.is_rigid]
    if _planar_normal(free) is not None:
        return "planar"
    if all(j.of_type.turns_about_point for j in free):
        centre = _centre(free)
        if centre is not None and all(_turns_about(centre, j) for j in free):
            return "spherical"
    return "spatial"


def planar_normal(joints: Sequence[Joint]) -> Vector:
    """The normal of the plane in which a planar mechanism moves."""
    normal = _planar_normal([j for j in joints if not j.of_type.is_rigid])
    if normal is None:
        raise NagError("the mechanism is not planar")
    return direction(normal)


def _planar_normal(joints: Sequence[Joint]) -> Vector | None:
    if not all(j.of_type.turns_only or j.of_type.slides_only for j in joints):
        return None
    turns = [j.axis for j in joints if j.of_type.turns_only]
    slides = [j.axis for j in joints if j.of_type.slides_only]
    normal = turns[0] if turns else _normal_of(slides)
    if not all(vanishes(cross(normal, axis)) for axis in turns):
        return None
    return normal if all(is_zero(dot(normal, axis)) for axis in slides) else None


def _normal_of(slides: Sequence[Vector]) -> Vector:
    """A vector orthogonal to the first two directions that differ, or to the only one."""
    if not slides:
        return Fraction(0), Fraction(0), Fraction(1)
    products = (cross(slides[0], axis) for axis in slides[1:])
    return next((p for p in products if not vanishes(p)), across(slides[0])[1])


def _centre(joints: Sequence[Joint]) -> Vector | None:
    """The point about which all joints turn, if they do."""
    fixed = next((j for j in joints if not j.of_type.turns_only), None)
    if fixed is not None:
        return fixed.point
    if not joints:
        return None
    other = next((j for j in joints[1:] if not parallel(joints[0], j)), None)
    return None if other is None else meeting_point(joints[0], other)


def _turns_about(centre: Vector, joint: Joint) -> bool:
    if joint.of_type.turns_only:
        return on_axis(centre, joint)
    return vanishes(difference(centre, joint.point))
