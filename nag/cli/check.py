"""The command ``nag check``: the statements of the founding papers, tested."""

from __future__ import annotations

import argparse

from nag.cli.arguments import UsageError, add_reading, add_running, read_given_case
from nag.cli.running import CommandAnswer, chosen_run, document_head, name_case, run_row

FORMAT = "nag-statements"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag check``."""
    parser.add_argument(
        "case", metavar="CASE", nargs="?", help="case file (TOML) of a mechanism of the papers"
    )
    parser.add_argument("--all", action="store_true", help="all statements of both papers")
    add_reading(parser)
    add_running(parser)


def run(options: argparse.Namespace) -> CommandAnswer:
    """The papers' statements; complete if all are decided as expected."""
    if options.all == (options.case is not None):
        raise UsageError("give either a case file or --all, and not both")
    if options.all and options.set:
        raise UsageError("--set: is for a case file")
    case = None if options.all else read_given_case(options, exports=True)
    from nag.check.statement import summary
    from nag.questions import check_statements
    from nag.text.table import label_lines

    found = check_statements(case, run=chosen_run(options))
    lines = [*found.lines(), *label_lines([("answer", summary(found)), run_row(options)])]
    document = document_head(FORMAT, None if case is None else name_case(case)) | {
        "seed": options.seed,
        "settings": options.settings,
        **found.document(),
    }
    return CommandAnswer(lines, found.complete, lambda: document)
