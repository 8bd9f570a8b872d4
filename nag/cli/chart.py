"""The command ``nag chart``: where methods fail, and speed against accuracy."""

from __future__ import annotations

import argparse

from nag.cli import chart_speed, chart_stability
from nag.cli.arguments import Parser
from nag.cli.running import CommandAnswer


def add_arguments(parser: Parser) -> None:
    """The charts, each with arguments of its own."""
    charts = parser.add_subparsers(dest="chart", metavar="CHART", required=True)
    for name, module, text in CHARTS:
        command = charts.add_parser(name, allow_abbrev=False, help=text, description=text)
        module.add_arguments(command)
        command.set_defaults(of_chart=module)


def run(options: argparse.Namespace) -> CommandAnswer:
    """A chart; complete if all answers were right."""
    return options.of_chart.run(options)


CHARTS = (
    (
        "speed-accuracy",
        chart_speed,
        "Solve cases in many settings, arithmetics and programs, and draw error against time.",
    ),
    (
        "stability",
        chart_stability,
        "Run the atlas of families with a knob, and count answers right, undecided and wrong.",
    ),
)
