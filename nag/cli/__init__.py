"""The command ``nag``: one file a command, read `command_line`, `arguments` and `running` first.

Each command has ``add_arguments(parser)`` and ``run(arguments)``, which returns the lines to print
and whether the answer is complete. Nothing imports this package.
"""

from nag.cli.command_line import main

__all__ = ["main"]
