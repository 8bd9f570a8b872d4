"""Mechanisms in case files: bodies, and joints in the assembled reference configuration.

An axis is given by a point and a direction, by two points, or by Pluecker coordinates: a direction
and the moment, point x direction, of any point of the line; the two are orthogonal.
"""

from __future__ import annotations

from nag.algebra.number import brief_number_text, is_zero
from nag.errors import MechanismError
from nag.files.case_table import CaseTable, ReadNumber, wanted_text
from nag.mechanism.axes import Vector, cross, difference, dot, nearest, vanishes
from nag.mechanism.graph import ORIGIN, Body, Joint, Mechanism
from nag.mechanism.joint_types import JOINT_TYPES, SYNONYMS, VECTORS

LINE_KEYS = ("through", "line")
SECOND_KEYS = ("second_through", "second_line")
# What no joint can be without, and what to write.
_NEEDED = {
    "name": wanted_text("name"),
    "type": wanted_text("type"),
    "bodies": "a list of 2 names of bodies",
}
# A point and a direction.
Line = tuple[Vector, Vector]


def read_mechanism(top: CaseTable, number: ReadNumber) -> Mechanism:
    """The mechanism of a case of kind ``mechanism``; ``number`` reads an exact number."""
    ground = top.text("ground")
    for table in top.tables("joint"):
        table.require(_NEEDED)
    joint_tables = [(t.text("name"), t) for t in top.tables("joint")]
    body_tables = [(t.text("name"), t) for t in top.tables("body")]
    try:
        joints = [_read_joint(name, t.called(name), number) for name, t in joint_tables]
        bodies = [_read_body(name, t.called(name), number) for name, t in body_tables]
        return Mechanism(ground, tuple(joints), tuple(bodies))
    except MechanismError as error:
        # The last table of a name, as a repeated name is the fault of the later one.
        for culprit, tables in ((error.joint, joint_tables), (error.body, body_tables)):
            for name, table in reversed(tables):
                if name == culprit:
                    table.called(name).fail(error.key, error.message)
        top.fail(error.key, error.message)


def _read_joint(name: str, table: CaseTable, number: ReadNumber) -> Joint:
    kind = table.text("type")
    known = JOINT_TYPES.get(SYNONYMS.get(kind, kind))
    # What the type needs is asked for here; what does not belong to it, the joint itself refuses.
    needed = () if known is None else known.fields
    second_keys = SECOND_KEYS if "second_axis" in needed else ()
    table.allow(("name", "type", "bodies", *VECTORS, *LINE_KEYS, *second_keys))
    bodies = table.texts("bodies", "names of bodies", 2)
    line = _read_line(table, number)
    vectors = dict(zip(("point", "axis"), line, strict=True)) if line else {}
    as_line = any(key in table.values for key in second_keys)
    needed = [k for k in needed if k not in vectors and not (as_line and k == "second_axis")]
    table.require(dict.fromkeys(needed, "a list of 3 numbers"))
    for key in VECTORS:
        if key not in vectors and key in table.values:
            vectors[key] = table.vector(key, 3, number)
    second = (
        _read_second_line(table, number, (vectors["point"], vectors["axis"])) if as_line else None
    )
    if second is not None:
        vectors["point"], vectors["second_axis"] = second
    return Joint(
        name=name,
        type=kind,
        bodies=tuple(bodies),
        point=vectors.get("point", ORIGIN),
        axis=vectors.get("axis"),
        second_axis=vectors.get("second_axis"),
    )


def _read_body(name: str, table: CaseTable, number: ReadNumber) -> Body:
    table.allow(("name", "orientation"))
    orientation = None
    if "orientation" in table.values:
        orientation = table.vector("orientation", 4, number)
    return Body(name=name, orientation=orientation)


def _read_line(table: CaseTable, number: ReadNumber) -> Line | None:
    """A point and the direction of the axis, where it is given by two points or by ``line``."""
    return _line_by(table, number, LINE_KEYS, ("point", "axis"))


def _read_second_line(table: CaseTable, number: ReadNumber, first: Line) -> Line | None:
    """Where a universal joint's axis in its second body, given as a line, meets the first axis.

    The point that both have in common, and the direction of the second one; None if it is not
    given as a line. Parallel axes are left to the joint.
    """
    line = _line_by(table, number, SECOND_KEYS, ("second_axis",))
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


def _line_by(
    table: CaseTable, number: ReadNumber, keys: tuple[str, str], others: tuple[str, ...]
) -> Line | None:
    given = [key for key in keys if key in table.values]
    if not given:
        return None
    beside = [key for key in (*keys, *others) if key in table.values and key != given[0]]
    if beside:
        table.fail(beside[0], f"{given[0]!r} gives the axis already; leave one of them out")
    return (_through if given[0] == keys[0] else _line)(table, number, given[0])


def _through(table: CaseTable, number: ReadNumber, key: str) -> Line:
    places = table.items(key, "points [x, y, z] of the axis", 2)
    inner = CaseTable(table.file, f"{table.place}: {key}", dict(zip("12", places, strict=True)))
    first, second = (inner.vector(place, 3, number) for place in "12")
    axis = difference(second, first)
    if vanishes(axis):
        table.fail(key, "both points are the same; an axis needs two different ones")
    return first, axis


def _line(table: CaseTable, number: ReadNumber, key: str) -> Line:
    wanted = "{ direction = [x, y, z], moment = [x, y, z] }"
    inner = CaseTable(table.file, f"{table.place}: {key}", table.get(key, dict, wanted))
    inner.allow(("direction", "moment"))
    axis, moment = (inner.vector(key, 3, number) for key in ("direction", "moment"))
    if vanishes(axis):
        inner.fail("direction", "has length zero; a line needs a direction")
    product = dot(axis, moment)
    if not is_zero(product):
        inner.fail(
            "moment",
            f"its product with the direction is {brief_number_text(product)}, it must be 0: the "
            "moment is point x direction",
        )
    squared = dot(axis, axis)
    return tuple(x / squared for x in cross(axis, moment)), axis
