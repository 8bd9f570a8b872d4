"""The command ``nag check``: the statements of the founding papers, tested."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_reading, add_running, read_given_case
from nag.cli.running import CommandAnswer, Progress, chosen_run, document_head, name_case, run_row

if TYPE_CHECKING:
    from nag.check.statement import DecidedStatement, Statement

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
    case = None if options.all else read_given_case(options)
    sections = _sections(case, options)
    decided = [(title, _decide(title, rows, options.progress)) for title, rows in sections]

    from nag.check.statement import section_lines, summary
    from nag.text.table import label_lines

    lines = [line for title, rows in decided for line in section_lines(title, rows)]
    everything = [one for _, rows in decided for one in rows]
    lines += label_lines([("answer", summary(everything)), run_row(options)])
    complete = all(one.is_as_expected for one in everything)
    document = document_head(FORMAT, None if case is None else name_case(case)) | {
        "seed": options.seed,
        "settings": options.settings,
        "complete": complete,
        "sections": [
            {"title": title, "statements": [one.document() for one in rows]}
            for title, rows in decided
        ],
    }
    return CommandAnswer(lines, complete, lambda: document)


def _sections(case: Any, options: argparse.Namespace) -> list[tuple[str, tuple[Statement, ...]]]:
    from nag.check.subjects import WITH_CASES, everything, recognised
    from nag.decomposition.decompose import decompose

    def decomposed(system: Any) -> Any:
        return decompose(system, run=chosen_run(options))

    if case is None:
        return everything(decomposed)
    found = recognised(case, decomposed)
    if found is None:
        raise UsageError(
            f"{options.case}: the papers give no components of it; "
            f"they do of {', '.join(WITH_CASES)} (nag check --all)"
        )
    return [
        (found.subject.title, found.subject.statements),
        (f"{case.title}: decomposition", found.comparison),
    ]


def _decide(
    title: str, statements: tuple[Statement, ...], progress: Progress | None
) -> list[DecidedStatement]:
    from nag.check.statement import DecidedStatement

    decided = []
    for i, statement in enumerate(statements):
        if progress is not None:
            progress(title, i, len(statements))
        decided.append(DecidedStatement(statement, statement.verdict()))
    return decided
