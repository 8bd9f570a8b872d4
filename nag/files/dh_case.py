"""Cases of kind ``dh``: a single loop by Denavit and Hartenberg's table."""

from __future__ import annotations

from fractions import Fraction

from nag.files.case_table import CaseTable, ReadNumber
from nag.mechanism.dh import DHError, DHLoop, DHModel, HalfAngle, Row, half_angle
from nag.mechanism.graph import Mechanism
from nag.mechanism.parts import model_parts

_JOINT_KEYS = ("name", "a", "d", "alpha", "alpha_half_tangent", "theta", "theta_half_tangent")


def read_dh(top: CaseTable, number: ReadNumber) -> tuple[DHLoop, DHModel | Mechanism]:
    """A table, and the model of its closings; a mechanism of one without open angles."""
    tables = top.tables("joint")
    rows = [_read_row(i, table, number) for i, table in enumerate(tables, 1)]
    try:
        loop = DHLoop(tuple(rows))
        return loop, model_parts(loop)
    except DHError as error:
        if error.joint is None:
            top.fail("joint", error.message)
        tables[error.joint].fail(error.key, error.message)


def _read_row(i: int, table: CaseTable, number: ReadNumber) -> Row:
    table.allow(_JOINT_KEYS)
    name = table.text("name") if "name" in table.values else f"J{i}"
    lengths = []
    for key in ("a", "d"):
        with table.at(key):
            lengths.append(number(table.values.get(key, 0)))
    twist = _half_angle(table, "alpha", number)
    if twist is None:
        table.fail("alpha", "is missing; give the link's twist, or alpha_half_tangent")
    return Row(name, *lengths, twist, _half_angle(table, "theta", number))


def _half_angle(table: CaseTable, key: str, number: ReadNumber) -> HalfAngle | None:
    """(cos : sin) of half an angle that is given itself or by its half-tangent; None if neither."""
    tangent = f"{key}_half_tangent"
    if key in table.values and tangent in table.values:
        table.fail(tangent, f"{key} is given as well; leave one of them out")
    if tangent in table.values:
        with table.at(tangent):
            return Fraction(1), number(table.values[tangent])
    if key not in table.values:
        return None
    with table.at(key):
        return half_angle(number(table.values[key]))
