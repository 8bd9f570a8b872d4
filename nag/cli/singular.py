"""The command ``nag singular``: singular points of components, and where components meet."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from nag.cli import free_parameters
from nag.cli.arguments import add_running
from nag.cli.running import compilation_notice, run_row
from nag.cli.witness_input import (
    Given,
    add_input,
    component_number,
    component_of,
    doubts,
    given,
    head,
    like,
    write_document,
)

if TYPE_CHECKING:
    from nag.decomposition.singular_locus import SingularLocus

FORMAT = "nag-singular"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag singular`` has besides those of every command that runs a case."""
    add_input(parser)
    add_running(parser)
    parser.add_argument(
        "--component",
        type=component_number,
        metavar="N",
        help="only singular points of this component, in the order of the export",
    )
    parser.add_argument(
        "--free",
        metavar="NAMES",
        help="parameters of the case, 'L1, L2, L3': for which values are there singular points?",
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Find singular points and write the export; returns the lines to print and whether all is
    known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    if options.free is not None:
        return free_parameters.run(options)

    with compilation_notice(sys.stderr, options.quiet):
        from nag.decomposition.singular_locus import singular_locus

        found = given(options)
        if options.component is not None:
            component_of(found, options.component, "--component")
        locus = singular_locus(
            found.decomposition,
            only=None if options.component is None else [options.component - 1],
            seed=options.seed,
            threads=options.threads,
            settings=options.settings,
        )
    complete = locus.complete and found.decomposition.complete
    if options.json is not None:
        write_document(_document(found, locus, options, complete), options.json)
    return _lines(found, locus, options), complete


def _document(
    found: Given, locus: SingularLocus, options: argparse.Namespace, complete: bool
) -> dict[str, Any]:
    from nag.files.singular_document import singular_document

    components = found.decomposition.components
    return head(found, FORMAT, options) | {
        "complete": complete,
        "notes": list(locus.notes),
        "variables": list(found.decomposition.system.variables),
        "components": [{"number": i + 1, **like(c)} for i, c in enumerate(components)],
        **singular_document(locus, found.decomposition.system.variables),
    }


def _lines(found: Given, locus: SingularLocus, options: argparse.Namespace) -> list[str]:
    from nag.report.singular import answer_rows, set_lines
    from nag.text.table import labelled, printable
    from nag.witness.shown import paths_text

    decomposition = found.decomposition
    top = answer_rows(locus, decomposition)
    tail = [("open", note) for note in locus.notes] + doubts(found)
    tail.append(("paths", paths_text(locus.paths)))
    tail.append(run_row(options))
    width = max(len(label) for label, _ in top + tail)
    lines = [printable(found.title), "", *labelled(top, width), ""]
    for one in locus.sets:
        rows = set_lines(one, decomposition.system.variables)
        lines += [*labelled([(a, printable(b)) for a, b in rows], width), ""]
    return [*lines, *labelled([(a, printable(b)) for a, b in tail], width)]
