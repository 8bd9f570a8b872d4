"""The command ``nag solve``: all isolated solutions of a case."""

from __future__ import annotations

import argparse
import os
import sys

from nag.cli.arguments import UsageError, add_case, add_certify, add_running, read_problem
from nag.cli.certify import certify_result
from nag.cli.running import as_chosen, compilation_notice, progress_line, seconds, writing_json

STARTS = ("auto", "total", "multihomogeneous", "polyhedral", "monodromy", "parameter")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag solve``."""
    add_case(parser)
    add_running(parser)
    add_certify(parser)
    parser.add_argument(
        "--start",
        choices=STARTS,
        default="auto",
        help="start system (default: auto, parameter where the case has a [family] whose number of "
        "solutions is known, else the one with the least work)",
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Solve a case and write its export; returns the lines to print and whether all is known.

    Raises:
        UsageError: if the system cannot be solved, or the export cannot be written.
    """
    from nag.errors import StartError
    from nag.interface.solve import solve
    from nag.report.solutions import solution_lines
    from nag.text.table import labelled

    case, model = read_problem(options)
    try:
        with (
            compilation_notice(sys.stderr, options.quiet),
            progress_line(sys.stderr, options.quiet) as progress,
        ):
            result = solve(
                case if model is None else model,
                start=options.start,
                **as_chosen(options),
                progress=progress,
            )
    except StartError as error:
        raise UsageError(f"{options.case}: {error}") from None
    if options.json is not None:
        from nag.files.solutions_export import write_solutions

        with writing_json():
            write_solutions(result, options.json, case.title, os.path.basename(options.case))
    lines = solution_lines(result, case, model, seconds(options))
    if not (options.certify or options.certify_paths):
        return lines, result.complete
    proved = certify_result(result, options.certify_paths)
    return [*lines, "", *labelled(proved.rows)], result.complete and proved.all_proved
