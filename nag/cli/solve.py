"""The command ``nag solve``: all isolated solutions of a case."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    add_case,
    add_certify,
    add_running,
    add_start,
    error_in_file,
    read_problem,
)
from nag.cli.certify import proof_asked_for
from nag.cli.running import (
    CommandAnswer,
    check_tables,
    chosen_run,
    name_case,
    run_row,
    write_arrays,
    write_table,
)

if TYPE_CHECKING:
    from nag.solving.solutions import SolveResult


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag solve``."""
    add_case(parser, exports=True)
    add_running(parser)
    add_certify(parser)
    parser.add_argument(
        "--points",
        metavar="FILE",
        help="write the solutions to FILE as NumPy arrays, or as a table where it is called "
        "something.parquet (which needs pandas and pyarrow)",
    )
    add_start(
        parser,
        "start system (default: auto, parameter where the case has a [family] whose number of "
        "solutions is known, else the one with the least work)",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """All isolated solutions of a case."""
    from nag.errors import StartError
    from nag.files.written_file import ending_of
    from nag.report.solutions import realisations, solution_lines

    as_table = options.points is not None and ending_of(options.points) == ".parquet"
    if as_table:
        check_tables("points")
    case, problem = read_problem(options)

    def document_of(found: SolveResult) -> dict[str, Any] | None:
        same = found.system == problem.system
        return found.document_to_write(*name_case(case)) if same else None

    try:
        result = problem.solve(start=options.start, run=chosen_run(options, document_of))
    except StartError as error:
        raise error_in_file(options.case, error) from None
    if options.points is not None:
        write = write_table if as_table else write_arrays
        write(_columns(result, as_table), options.points, "points")
    return CommandAnswer(
        solution_lines(result, case, problem, run_row(options, places=2)),
        result.complete,
        lambda: {
            **result.document_to_write(*name_case(case)),
            **({"realisations": found} if (found := realisations(problem, result)) else {}),
        },
        proof_asked_for(options, result),
    )


def _columns(result: SolveResult, as_table: bool) -> dict[str, Any]:
    """What is known of the solutions by name, points as one array, or each part of a coordinate."""
    import numpy as np

    from nag.text.table import split_parts

    table, names = result.table, result.system.variables
    numbers = {name: getattr(table, name) for name in table.numbers}
    if not as_table:
        return {"points": table.points, **numbers, "variables": np.array(names, dtype=str)}
    # As in frames, without the imaginary unit.
    own = result.system.own_variables
    return split_parts(dict(zip(own, table.to_numpy().T, strict=True))) | numbers
