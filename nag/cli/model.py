"""The command ``nag model``: the polynomial system of a case."""

from __future__ import annotations

import argparse

from nag.cli.arguments import add_case, read_problem


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag model``."""
    add_case(parser)


def run(arguments: argparse.Namespace) -> tuple[list[str], bool]:
    """The lines to print; they are always complete.

    Raises:
        UsageError: for bad input.
    """
    from nag.report.answer import model_lines

    return model_lines(*read_problem(arguments)), True
