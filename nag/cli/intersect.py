"""The command ``nag intersect``: the components of the intersection of two components."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_running
from nag.cli.running import as_chosen, compilation_notice, progress_line, run_row
from nag.cli.witness_input import (
    add_input,
    component_number,
    component_of,
    given,
    head,
    like,
    write_document,
)

if TYPE_CHECKING:
    from nag.witness.witness import Decomposition, WitnessSet

FORMAT = "nag-intersection"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag intersect`` has besides those of every command that runs a case."""
    add_input(parser)
    add_running(parser)
    parser.add_argument(
        "--components",
        type=component_number,
        nargs=2,
        required=True,
        metavar=("I", "J"),
        help="numbers of the components, in the order of the export; they may be equal",
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Intersect and write the export; returns the lines to print and whether all is known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    with compilation_notice(sys.stderr, options.quiet):
        from nag.decomposition.intersection import IntersectionError, intersect_components

        found = given(options)
        pair = [component_of(found, number, "--components") for number in options.components]
        try:
            with progress_line(sys.stderr, options.quiet) as progress:
                result = intersect_components(
                    found.decomposition.system,
                    *pair,
                    **as_chosen(options),
                    progress=progress,
                )
        except IntersectionError as error:
            raise UsageError(f"{options.case}: {error}") from None
    complete = result.complete and not any(component.note for component in pair)
    if options.json is not None:
        document = head(found, FORMAT, options) | _document(options, pair, result, complete)
        write_document(document, options.json)
    from nag.text.table import sheet
    from nag.witness.shown import component_table

    top, tail = _rows(options, pair, result, complete)
    return sheet(found.title, top, component_table(result), tail), complete


def _document(
    options: argparse.Namespace,
    pair: Sequence[WitnessSet],
    result: Decomposition,
    complete: bool,
) -> dict[str, Any]:
    from nag.files.export import component_document

    numbered = zip(options.components, pair, strict=True)
    return {
        "complete": complete,
        "notes": list(result.notes),
        "of": [{"number": n, **like(c)} for n, c in numbered],
        "paths": {
            "tracked": result.paths.tracked,
            "failed": result.paths.failed,
            "at_infinity": result.paths.at_infinity,
        },
        "system": {
            "variables": list(result.system.variables),
            "polynomials": result.system.text(),
        },
        "components": [component_document(c, result.system.variables) for c in result.components],
    }


def _rows(
    options: argparse.Namespace,
    pair: Sequence[WitnessSet],
    result: Decomposition,
    complete: bool,
) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """What is written above the table, and below it."""
    from nag.witness.shown import paths_text, remarks, title_line

    top = []
    for number, component in zip(options.components, pair, strict=True):
        kind = f"{number}: dimension {component.dimension}, degree {component.degree}"
        top.append(("component", f"{kind}, {component.status}"))
    # Only a complete answer without components says that there are none.
    nothing = "they do not meet" if complete else "undecided: no common point is certain"
    top.append(("answer", title_line(result) if result.components else nothing))
    if not complete:
        top.append(("", "INCOMPLETE, see below"))
    undecided = [n for n, c in zip(options.components, pair, strict=True) if c.note]
    tail = [("open", line) for line in remarks(result)]
    tail += [("open", f"component {number} is undecided") for number in undecided]
    tail += [
        ("paths", paths_text(result.paths)),
        run_row(options),
    ]
    return top, tail
