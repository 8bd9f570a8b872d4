"""The command ``nag solve``: all isolated solutions of a case."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_certify,
    add_format,
    add_robot,
    add_running,
    add_start,
    read_problem,
)
from nag.cli.certify import proof_asked_for
from nag.cli.running import CommandAnswer, chosen_run, name_case, run_row, write_arrays

if TYPE_CHECKING:
    from nag.solving.solutions import SolveResult


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag solve``."""
    add_case(parser)
    add_robot(parser)
    add_format(parser)
    add_running(parser)
    add_certify(parser)
    parser.add_argument(
        "--points", metavar="FILE", help="write the solutions to FILE as NumPy arrays (.npz)"
    )
    add_start(
        parser,
        "start system (default: auto, parameter where the case has a [family] whose number of "
        "solutions is known, else the one with the least work)",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """All isolated solutions of a case."""
    import numpy as np

    from nag.errors import StartError
    from nag.report.solutions import realisations, solution_lines
    from nag.solving.solutions import NUMBERS

    case, problem = read_problem(options)

    def document_of(found: SolveResult) -> dict[str, Any] | None:
        same = found.system == problem.system
        return found.document_to_write(*name_case(case)) if same else None

    try:
        result = problem.solve(start=options.start, run=chosen_run(options, document_of))
    except StartError as error:
        raise UsageError(f"{options.case}: {error}") from None
    if options.points is not None:
        table = result.table
        arrays = {name: getattr(table, name) for name in ("points", *NUMBERS)}
        names = np.array(result.system.variables, dtype=str)
        write_arrays({**arrays, "variables": names}, options.points, "points")
    return CommandAnswer(
        solution_lines(result, case, problem, run_row(options, places=2)),
        result.complete,
        lambda: {
            **result.document_to_write(*name_case(case)),
            **({"realisations": found} if (found := realisations(problem, result)) else {}),
        },
        proof_asked_for(options, result),
    )
