"""The command ``nag model``: the polynomial system of a case."""

from __future__ import annotations

import argparse

from nag.cli.arguments import add_case, read_problem
from nag.cli.running import CommandAnswer


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag model``."""
    add_case(parser)


def run(arguments: argparse.Namespace) -> CommandAnswer:
    """The polynomial system of a case."""
    from nag.report.answer import model_lines

    return CommandAnswer(model_lines(*read_problem(arguments)))
