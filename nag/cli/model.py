"""The command ``nag model``: the polynomial system of a case."""

from __future__ import annotations

import argparse

from nag.cli.arguments import add_case, add_json, read_problem
from nag.cli.running import CommandAnswer, document_head, name_case


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag model``."""
    add_case(parser)
    add_json(parser)


def run(options: argparse.Namespace) -> CommandAnswer:
    """The polynomial system of a case."""
    from nag.report.answer import model_lines

    case, problem = read_problem(options)
    head = document_head("nag-model", name_case(case))
    return CommandAnswer(model_lines(case, problem), document=lambda: head | problem.document())
