"""The command ``nag solve``: all isolated solutions of a case."""

from __future__ import annotations

import argparse
import os
import sys
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError, add_case, add_certify, add_running, read_problem
from nag.cli.certify import certified
from nag.cli.running import as_chosen, compilation_notice, progress_line, seconds, writing_json

if TYPE_CHECKING:
    from nag.algebra.system import PolynomialSystem
    from nag.files.cases import Case
    from nag.solving.solutions import SolveResult
    from nag.solving.solve import Progress

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
        help="start system (default: auto, the one with the least work, or parameter where the "
        "case has a [family])",
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Solve a case and write its export; returns the lines to print and whether all is known.

    Raises:
        UsageError: if the system cannot be solved, or the export cannot be written.
    """
    from nag.files.problem import system_of
    from nag.report.solutions import solution_lines
    from nag.solving.start.target import StartError
    from nag.text.table import labelled

    case, model = read_problem(options)
    system = system_of(case, model)
    try:
        with (
            compilation_notice(sys.stderr, options.quiet),
            progress_line(sys.stderr, options.quiet) as progress,
        ):
            result = solve_case(
                case,
                system,
                options.start,
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
    proved = certified(result, options.certify_paths)
    return [*lines, "", *labelled(proved.rows)], result.complete and proved.all_proved


def solve_case(
    case: Case,
    system: PolynomialSystem,
    start: str,
    *,
    seed: int,
    threads: int,
    settings: str,
    progress: Progress | None = None,
) -> SolveResult:
    """All isolated solutions of a case's system, by way of its family if it declares one.

    Raises:
        nag.solving.start.target.StartError: if there is no such start for the case.
    """
    from nag.algebra.rational_map import MapError
    from nag.solving.parameter import solve_family, solve_generic
    from nag.solving.solve import solve
    from nag.solving.start.target import StartError

    family = case.family
    if start == "parameter" and family is None:
        raise StartError("parameter: the case has no [family]; leave out --start")
    common = {"seed": seed, "threads": threads, "settings": settings}
    if family is None or start not in ("auto", "parameter"):
        return solve(system, start=start, progress=progress, **common)
    try:
        solved = solve_generic(
            family.symmetric,
            start="parameter",
            count=family.solutions,
            progress=progress,
            **common,
        )
    except MapError as error:
        raise StartError(f"[family]: {error}") from None
    return solve_family(solved, [family.values], **common)[0]
