"""Cases of kind ``robot``: the file of a robot, where its joints stand, what is held and closed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path, PurePosixPath

from nag.algebra.number import Number
from nag.algebra.tokens import nearest, quote
from nag.files.case_table import CaseTable, ReadNumber, read_case_text
from nag.files.robots.reading import read_robot
from nag.files.robots.robot import LoopClosure, Robot, assemble
from nag.mechanism.axes import vanishes
from nag.mechanism.graph import Mechanism
from nag.mechanism.joint_types import JOINT_TYPES, SYNONYMS, VECTORS

LONGEST_NAME = 200
# What may be given of a joint that closes a loop, besides its vectors.
_CLOSURE_KEYS = ("name", "type", "bodies", *VECTORS, "second_point")


def read_robot_case(top: CaseTable, number: ReadNumber) -> tuple[Mechanism, tuple[str, ...]]:
    """The mechanism of a case of kind ``robot``, and what numbers of its file were taken for."""
    name = top.text("file")
    # A case leads to nothing but what lies beside it.
    if PurePosixPath(name).is_absolute() or Path(name).is_absolute() or ".." in Path(name).parts:
        top.fail("file", f"{quote(name)} does not lie beside the case; write a name without '..'")
    if len(name) > LONGEST_NAME:
        top.fail("file", f"{quote(name)} is longer than {LONGEST_NAME} characters; shorten it")
    path = Path(top.file).parent / name
    robot = read_robot(str(path), read_case_text(path))
    hold = top.texts("hold", "names of links") if "hold" in top.values else []
    values = _read_values(top.table("at"), number)
    tables = [(t.text("name"), t) for t in top.tables("closure")]
    closures = [_read_closure(name, t.called(name), robot, number) for name, t in tables]
    taken = [j.name for j in robot.joints] + [c.name for c in robot.closures]
    for i, (name, table) in enumerate(tables):
        if name in taken or name in (other for other, _ in tables[:i]):
            table.called(name).fail("name", "another joint has that name; give it one of its own")
    robot = replace(robot, closures=(*robot.closures, *closures))
    return assemble(robot, top.file, hold, values)


def _read_values(table: CaseTable, number: ReadNumber) -> dict[str, Number]:
    values = {}
    for name, value in table.values.items():
        with table.at(name):
            values[name] = number(value)
    return values


def _read_closure(name: str, table: CaseTable, robot: Robot, number: ReadNumber) -> LoopClosure:
    table.allow(_CLOSURE_KEYS)
    kind = SYNONYMS.get(table.text("type"), table.text("type"))
    if kind not in JOINT_TYPES:
        table.fail(
            "type",
            f"{quote(kind)} is unknown{nearest(kind, JOINT_TYPES)}; write one of "
            f"{', '.join(JOINT_TYPES)}",
        )
    bodies = table.texts("bodies", "names of links", 2)
    for body in bodies:
        if body not in robot.links:
            table.fail("bodies", f"{quote(body)} is no link{nearest(body, robot.links)}")
    if bodies[0] == bodies[1]:
        table.fail("bodies", "are the same; a joint is between two of them")
    needed = JOINT_TYPES[kind].fields
    for key in VECTORS:
        if key in table.values and key not in (*needed, *JOINT_TYPES[kind].optional):
            table.fail(key, f"a {kind} joint has none; leave it out")
    given = (*needed, *(key for key in JOINT_TYPES[kind].optional if key in table.values))
    vectors = {key: table.vector(key, 3, number) for key in given}
    for key in ("axis", "second_axis"):
        if key in vectors and vanishes(vectors[key]):
            table.fail(key, "has length zero; a joint needs a direction")
    second = table.vector("second_point", 3, number) if "second_point" in table.values else None
    return LoopClosure(
        name,
        kind,
        (bodies[0], bodies[1]),
        f"{table.file}: {table.place}",
        **vectors,
        second_point=second,
        closed_here=True,
    )
