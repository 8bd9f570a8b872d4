"""The command ``nag report``: all that is found of a mechanism, in one page."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_case, add_running, read_problem
from nag.cli.running import CommandAnswer, chosen_run, run_row, write_document

if TYPE_CHECKING:
    from nag.witness.witness import Decomposition

BYTES_IN_A_MEGABYTE = 1_000_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag report`` has besides those of every command that runs a case."""
    add_case(parser)
    add_running(parser)
    parser.add_argument(
        "--html",
        metavar="FILE",
        required=True,
        help="write the page to FILE; it needs no network",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """All that is found of a mechanism, in one page."""
    case, problem = read_problem(options, exports=False)
    if problem.model is None:
        raise UsageError(f"{options.case}: is a polynomial system; reports are of mechanisms")
    from nag.files.export import Origin
    from nag.page.mechanism_report import report_of
    from nag.text.table import sheet

    head = Origin.of(case, problem).head

    def document_of(early: Decomposition) -> dict[str, Any] | None:
        return early.document(**head) if early.system == problem.system else None

    found = report_of(case, problem, chosen_run(options, document_of))
    write_document(found.page, options.html, "html")
    size = len(found.page.encode()) / BYTES_IN_A_MEGABYTE
    rows = [*found.rows(), ("page", f"{options.html}, {size:.2f} MB")]
    return CommandAnswer(
        sheet(case.title, rows, [run_row(options)]),
        found.complete,
        lambda: found.decomposition.document(**head),
    )
