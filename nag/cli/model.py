"""The command ``nag model``: the polynomial system of a case."""

from __future__ import annotations

import argparse

from nag.cli.arguments import (
    UsageError,
    add_case,
    add_json,
    add_quiet,
    read_problem,
)
from nag.cli.running import CommandAnswer, document_head, name_case
from nag.errors import NagError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag model``."""
    from nag.files.formats import WRITTEN

    add_case(parser, format_option="--from", exports=True)
    add_json(parser)
    add_quiet(parser)
    parser.add_argument(
        "--format",
        dest="written",
        choices=WRITTEN,
        help="print the equations alone, as another program takes them",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """The polynomial system of a case."""
    from nag.report.answer import model_lines

    case, problem = read_problem(options)
    if options.written is not None:
        from nag.files.formats.writing import write_system

        try:
            text = write_system(problem.system, options.written, case.title)
        except NagError as error:
            raise UsageError(f"{case.path}: {error}") from None
        return CommandAnswer(text.splitlines())
    head = document_head("nag-model", name_case(case))
    return CommandAnswer(model_lines(case, problem), document=lambda: head | problem.document())
