"""Mechanisms in case files: bodies, and joints in the assembled reference configuration."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nag.algebra.number import Number
from nag.files.axis_forms import KEYS as LINE_KEYS
from nag.files.axis_forms import SECOND_KEYS, read_line, read_second_line
from nag.files.case_table import Table
from nag.mechanism.graph import ORIGIN, Body, Joint, Mechanism, MechanismError
from nag.mechanism.joint_types import JOINT_TYPES, SYNONYMS

ReadNumber = Callable[[Any], Number]

VECTORS = ("point", "axis", "second_axis")


def read_mechanism(top: Table, number: ReadNumber) -> Mechanism:
    """The mechanism of a case of kind ``mechanism``; ``number`` reads an exact number."""
    ground = top.text("ground")
    if "joint" not in top.values:
        top.fail("joint", "is missing; write a table [[joint]] for every joint")
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


def _read_joint(name: str, table: Table, number: ReadNumber) -> Joint:
    kind = table.text("type")
    second_keys = SECOND_KEYS if SYNONYMS.get(kind, kind) == "universal" else ()
    table.allow(("name", "type", "bodies", *VECTORS, *LINE_KEYS, *second_keys))
    bodies = table.texts("bodies", "names of bodies", 2)
    if not all(b.strip() and b.isprintable() for b in bodies):
        table.fail("bodies", "holds an empty or unprintable name; write names of bodies")
    known = JOINT_TYPES.get(SYNONYMS.get(kind, kind))
    # What the type needs is asked for here; what does not belong to it, the joint itself refuses.
    needed = () if known is None else known.fields
    line = read_line(table, number)
    vectors = dict(zip(("point", "axis"), line, strict=True)) if line else {}
    as_line = any(key in table.values for key in second_keys)
    for key in VECTORS:
        wanted = key in table.values or (key in needed and not (as_line and key == "second_axis"))
        if key not in vectors and wanted:
            vectors[key] = table.vector(key, 3, number)
    second = (
        read_second_line(table, number, (vectors["point"], vectors["axis"])) if as_line else None
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


def _read_body(name: str, table: Table, number: ReadNumber) -> Body:
    table.allow(("name", "orientation"))
    orientation = None
    if "orientation" in table.values:
        orientation = table.vector("orientation", 4, number)
    return Body(name=name, orientation=orientation)
