"""The command ``nag decompose``: the irreducible components of a case, and the mobility."""

from __future__ import annotations

import argparse
import sys
import time

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_running,
    check_json,
    read_problem,
    whole,
)
from nag.cli.certify import add_certify, certified

MOST_STARTS = 10**6


def _starts(text: str) -> int:
    return whole(text, 1, MOST_STARTS)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag decompose``."""
    add_case(parser)
    add_running(parser)
    add_certify(parser)
    parser.add_argument(
        "--expand",
        action="store_true",
        help="list every component, not one of each orbit of the system's symmetries",
    )
    parser.add_argument(
        "--method",
        choices=("complete", "sampling"),
        default="complete",
        help="find all components, or those that Newton's method reaches from random points, for "
        "systems that are too large; that is never complete (default: complete)",
    )
    parser.add_argument(
        "--starts",
        type=_starts,
        metavar="N",
        help="with --method sampling: number of random points (default: 100)",
    )


def run(arguments: argparse.Namespace) -> tuple[list[str], bool]:
    """Decompose and write the export; returns the lines to print and whether all is known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    started = time.perf_counter()
    if arguments.starts is not None and arguments.method != "sampling":
        raise UsageError("--starts: is for --method sampling")
    if arguments.json is not None:
        check_json(arguments.json, arguments.case)
    case, model = read_problem(arguments)

    from nag.cli.progress import compilation_notice, progress_line

    with (
        compilation_notice(sys.stderr, arguments.quiet),
        progress_line(sys.stderr, arguments.quiet) as progress,
    ):
        from nag.decomposition import decompose
        from nag.decomposition.through import accounted, through_points
        from nag.files.problem import points_of, symmetries_of, system_of
        from nag.witness.expansion import expanded

        if arguments.method == "sampling":
            from nag.decomposition import by_sampling

            decomposition = by_sampling(
                system_of(case, model),
                seed=arguments.seed,
                threads=arguments.threads,
                settings=arguments.settings,
                progress=progress,
                symmetries=symmetries_of(case, model),
                **({} if arguments.starts is None else {"starts": arguments.starts}),
            )
        else:
            decomposition = decompose(
                system_of(case, model),
                seed=arguments.seed,
                threads=arguments.threads,
                settings=arguments.settings,
                progress=progress,
                symmetries=symmetries_of(case, model),
            )
        if arguments.expand:
            decomposition = expanded(decomposition)
        points = through_points(decomposition, points_of(case, model), arguments.threads)

    from nag.files.export import write_decomposition
    from nag.files.problem import origin
    from nag.files.written_file import TargetError
    from nag.report.answer import answer_lines
    from nag.report.table import labelled

    decomposition = accounted(decomposition, points)
    failure = None
    if arguments.json is not None:
        try:
            write_decomposition(decomposition, arguments.json, origin(case, model))
        except TargetError as error:
            failure = f"--json: {error}"
    seconds = time.perf_counter() - started
    lines = answer_lines(decomposition, case, model, points, seconds)
    if failure is not None:
        raise UsageError(failure, lines)
    if not arguments.certify:
        return lines, decomposition.complete
    certificate, rows = certified(decomposition)
    return [*lines, "", *labelled(rows)], decomposition.complete and certificate.all_proved
