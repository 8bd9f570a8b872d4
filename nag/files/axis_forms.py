"""The forms in which a line is given: a point and a direction, two points, or Pluecker coordinates.

Pluecker coordinates are a direction and the moment, point x direction, of any point of the line;
the two are orthogonal.
"""

from __future__ import annotations

from nag.algebra.number import Number, is_zero, number_text
from nag.files.case_table import ReadNumber, Table
from nag.mechanism.axes import Vector, cross, difference, dot, vanishes

KEYS = ("through", "line")


def read_line(table: Table, number: ReadNumber) -> tuple[Vector, Vector] | None:
    """A point and the direction of the axis, where it is given by two points or by ``line``."""
    given = [key for key in KEYS if key in table.values]
    if not given:
        return None
    beside = [key for key in (*KEYS, "point", "axis") if key in table.values and key != given[0]]
    if beside:
        table.fail(beside[0], f"{given[0]!r} gives the axis already; leave one of them out")
    return _through(table, number) if given[0] == "through" else _line(table, number)


def _through(table: Table, number: ReadNumber) -> tuple[Vector, Vector]:
    places = table.items("through", "points [x, y, z] of the axis", 2)
    inner = Table(table.file, f"{table.place}: through", dict(zip("12", places, strict=True)))
    first, second = (inner.vector(key, 3, number) for key in "12")
    axis = difference(second, first)
    if vanishes(axis):
        table.fail("through", "both points are the same; an axis needs two different ones")
    return first, axis


def _line(table: Table, number: ReadNumber) -> tuple[Vector, Vector]:
    wanted = "{ direction = [x, y, z], moment = [x, y, z] }"
    inner = Table(table.file, f"{table.place}: line", table.get("line", dict, wanted))
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
