"""The command ``nag member``: the components that a point lies on."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError
from nag.cli.running import CommandAnswer, answer_of, chosen_run
from nag.cli.witness_input import (
    ONE_POINT,
    POINT_AT,
    add_input,
    add_point,
    chosen_point,
    doubt_rows,
    read_components,
    with_tested_traces,
)

if TYPE_CHECKING:
    from nag.witness.membership import PointMembership


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag member`` has besides those of every command that runs a case."""
    add_input(parser, POINT_AT)
    add_point(parser, " (default: the only one that has a name)")


def run(options: argparse.Namespace) -> CommandAnswer:
    """Which components a point lies on."""
    from nag.algebra.system import values_text
    from nag.files.answer_export import fields_of
    from nag.text.table import align
    from nag.witness.membership import locate_point

    if options.point is not None and options.at is not None:
        raise UsageError(ONE_POINT)
    found = with_tested_traces(
        read_components(options, lambda *known: chosen_point(options, *known))
    )
    system = found.decomposition.system
    variables = system.own_variables
    point = chosen_point(options, system, found.points)
    located = locate_point(found.decomposition, point, run=chosen_run(options))
    fields = fields_of(located)
    top = [
        ("point", values_text(variables, point[: len(variables)])),
        ("equations", _equations_text(located)),
        ("answer", _answer_text(located)),
    ]
    tail = doubt_rows(found.decomposition)
    if located.open:
        numbers = ", ".join(map(str, located.open))
        tail.append(("open", f"membership could not be decided for component {numbers}"))
    complete = found.decomposition.complete and located.complete
    rows = located.rows()
    blocks = top, align(rows, [4]) if rows else []
    return answer_of(options, found.case, blocks, tail, fields, complete)


def _equations_text(located: PointMembership) -> str:
    from nag.numerics.zero_values import ON
    from nag.text.table import magnitude

    if located.exact:
        return "hold exactly"
    hold = "hold to rounding" if located.residual < ON else "do not hold"
    return f"{hold}, relative residual {magnitude(located.residual)}"


def _answer_text(located: PointMembership) -> str:
    if located.on:
        text = f"on {len(located.on)} of {len(located.components)} components; local dimension "
        largest = max(c.dimension for c in located.on)
        return f"{text}{largest}{' at least' if located.open else ''}"
    if located.open:
        return "not known"
    missing = " that was found, though it is a solution: one is missing" if located.exact else ""
    return f"on no component{missing}"
