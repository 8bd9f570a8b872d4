"""The forms in which a line is given: a point and a direction, two points, or Pluecker coordinates.

Pluecker coordinates are a direction and the moment, point x direction, of any point of the line;
the two are orthogonal.
"""

from __future__ import annotations

from nag.algebra.number import Number, is_zero, number_text
from nag.files.case_table import ReadNumber, Table
from nag.mechanism.axes import Vector, cross, difference, dot, nearest, vanishes

KEYS = ("through", "line")
SECOND_KEYS = ("second_through", "second_line")
# A point and a direction.
Line = tuple[Vector, Vector]


def read_line(table: Table, number: ReadNumber) -> Line | None:
    """A point and the direction of the axis, where it is given by two points or by ``line``."""
    return _read(table, number, KEYS, ("point", "axis"))


def read_second_line(table: Table, number: ReadNumber, first: Line) -> Line | None:
    """Where a universal joint's axis in its second body, given as a line, meets the first axis.

    The point that both have in common, and the direction of the second one; None if it is not
    given as a line. Parallel axes are left to the joint.
    """
    line = _read(table, number, SECOND_KEYS, ("second_axis",))
    if line is None:
        return None
    (p, u), (q, v) = first, line
    normal, apart = cross(u, v), difference(q, p)
    if vanishes(normal):
        return p, v
    squared, gap = dot(normal, normal), dot(apart, normal)
    if not is_zero(gap):
        key = next(key for key in SECOND_KEYS if key in table.values)
        distance = abs(float(gap)) / float(squared) ** 0.5
        table.fail(
            key,
            f"passes the first axis at a distance of {distance:.6g}; the axes of a universal joint "
            "meet",
        )
    return nearest(first, line), v


def _read(
    table: Table, number: ReadNumber, keys: tuple[str, str], others: tuple[str, ...]
) -> Line | None:
    given = [key for key in keys if key in table.values]
    if not given:
        return None
    beside = [key for key in (*keys, *others) if key in table.values and key != given[0]]
    if beside:
        table.fail(beside[0], f"{given[0]!r} gives the axis already; leave one of them out")
    return (_through if given[0] == keys[0] else _line)(table, number, given[0])


def _through(table: Table, number: ReadNumber, key: str) -> Line:
    places = table.items(key, "points [x, y, z] of the axis", 2)
    inner = Table(table.file, f"{table.place}: {key}", dict(zip("12", places, strict=True)))
    first, second = (inner.vector(place, 3, number) for place in "12")
    axis = difference(second, first)
    if vanishes(axis):
        table.fail(key, "both points are the same; an axis needs two different ones")
    return first, axis


def _line(table: Table, number: ReadNumber, key: str) -> Line:
    wanted = "{ direction = [x, y, z], moment = [x, y, z] }"
    inner = Table(table.file, f"{table.place}: {key}", table.get(key, dict, wanted))
    inner.allow(("direction", "moment"))
    axis, moment = (inner.vector(key, 3, number) for key in ("direction", "moment"))
    if vanishes(axis):
        inner.fail("direction", "has length zero; a line needs a direction")
    product = dot(axis, moment)
    if not is_zero(product):
        inner.fail(
            "moment",
            f"its product with the direction is {_short(product)}, it must be 0: the moment is "
            "point x direction",
        )
    squared = dot(axis, axis)
    return tuple(x / squared for x in cross(axis, moment)), axis


def _short(value: Number) -> str:
    text = number_text(value)
    return text if len(text) <= 40 else f"{float(value):.6g}"
