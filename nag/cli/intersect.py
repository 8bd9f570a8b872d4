"""The command ``nag intersect``: the components of the intersection of two components."""

from __future__ import annotations

import argparse
from dataclasses import asdict

from nag.cli.arguments import error_in_file
from nag.cli.running import CommandAnswer, answer_of, chosen_run
from nag.cli.witness_input import (
    add_input,
    component_number,
    component_of,
    numbered_row,
    read_components,
)

FORMAT = "nag-intersection"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag intersect`` has besides those of every command that runs a case."""
    add_input(parser)
    parser.add_argument(
        "--components",
        type=component_number,
        nargs=2,
        required=True,
        metavar=("I", "J"),
        help="numbers of the components, in the order of the export; they may be equal",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """The intersection of two components."""
    from nag.decomposition.intersection import IntersectionError, intersect_components
    from nag.witness.shown import component_table, paths_text, remarks, title_line

    found = read_components(options)
    numbers = options.components
    pair = [component_of(found, number, "--components") for number in numbers]
    system = found.decomposition.system
    try:
        result = intersect_components(system, *pair, run=chosen_run(options))
    except IntersectionError as error:
        raise error_in_file(options.case, error) from None
    complete = result.complete and not any(component.note for component in pair)
    numbered = list(zip(numbers, pair, strict=True))
    variables = result.system.variables
    fields = {
        "format": FORMAT,
        "notes": list(result.notes),
        "of": [c.facts(n) for n, c in numbered],
        "paths": asdict(result.paths),
        "system": {"variables": list(variables), "polynomials": result.system.text()},
        "components": [c.document(variables) for c in result.components],
    }
    # Only a complete answer without components says that there are none.
    nothing = "they do not meet" if complete else "undecided: no common point is certain"
    top = [numbered_row(*each) for each in numbered]
    top.append(("answer", title_line(result) if result.components else nothing))
    if not complete:
        top.append(("", "INCOMPLETE, see below"))
    tail = [("open", line) for line in remarks(result)]
    tail += [("open", f"component {number} is undecided") for number, c in numbered if c.note]
    tail.append(("paths", paths_text(result.paths)))
    return answer_of(options, found.case, (top, component_table(result)), tail, fields, complete)
