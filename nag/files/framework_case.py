"""Cases of kind ``framework``: points and the bars between them."""

from __future__ import annotations

from typing import Any

from nag.algebra.number import Number
from nag.algebra.tokens import is_part_name, part_name_text
from nag.files.case_table import CaseTable, ReadNumber, kind_of
from nag.mechanism.framework import Framework, FrameworkError, placed_framework
from nag.mechanism.framework_model import FrameworkModel, framework_model

_LENGTHS = ("lengths", "squared_lengths")


def read_framework(top: CaseTable, number: ReadNumber) -> tuple[Framework, FrameworkModel]:
    """A framework, given by a placement or by lengths, and its model."""
    dimension = top.count("dimension", 2, default=2)
    if dimension > 3:
        top.fail("dimension", f"is {dimension}; write 2 for the plane or 3 for space")
    bars = _read_bars(top)
    try:
        if isinstance(top.values.get("points"), dict):
            for key in _LENGTHS:
                if key in top.values:
                    top.fail(key, "the points have places, which fix the lengths; leave it out")
            framework = placed_framework(dimension, _read_places(top, dimension, number), bars)
        else:
            names = _read_names(top.texts("points", "names of points"), top)
            squared = _read_squared_lengths(top, len(bars), number)
            framework = Framework(dimension, tuple(names), tuple(bars), tuple(squared))
        return framework, framework_model(framework)
    except FrameworkError as error:
        top.fail(error.key, error.message)


def _read_names(names: list[str], top: CaseTable) -> list[str]:
    for name in names:
        if not is_part_name(name):
            top.fail("points", part_name_text(name, "point"))
    return names


def _read_places(
    top: CaseTable, dimension: int, number: ReadNumber
) -> dict[str, tuple[Number, ...]]:
    table = top.table("points")
    _read_names(list(table.values), top)
    return {name: table.vector(name, dimension, number) for name in table.values}


def _read_bars(top: CaseTable) -> list[tuple[str, str]]:
    bars = []
    for i, bar in enumerate(top.items("bars", 'pairs of points ["A", "B"]'), 1):
        if not isinstance(bar, list) or len(bar) != 2 or not all(isinstance(p, str) for p in bar):
            found = f"a list of {len(bar)}" if isinstance(bar, list) else kind_of(bar)
            top.fail(f"bars {i}", f'is {found}; write the names of two points, ["A", "B"]')
        bars.append((bar[0], bar[1]))
    return bars


def _read_squared_lengths(top: CaseTable, count: int, number: ReadNumber) -> list[Any]:
    given = [key for key in _LENGTHS if key in top.values]
    if len(given) != 1:
        top.fail(
            "lengths",
            "is there beside squared_lengths; leave one of them out"
            if given
            else 'is missing; give one for each bar, or places of the points, A = ["1/2", 3]',
        )
    values = top.vector(given[0], count, number)
    for i, value in enumerate(values, 1):
        if not value > 0:
            top.fail(f"{given[0]} {i}", "is not positive; a bar has a positive length")
    return [x * x for x in values] if given[0] == "lengths" else list(values)
