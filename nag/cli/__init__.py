"""The command ``nag``: one file a command, read `command_line`, `arguments` and `running` first.

Each command has ``add_arguments(parser)`` and ``run(options)``, which turns the options into a call
and hands back an `Answer`; starting, telling, writing and printing is done by `running`. Nothing
imports this package. `witness_input` is what the commands that work with components begin with.

To add a command, write such a file and enter it in `command_line.COMMANDS`; the schema of what it
exports, if it does, goes to the folder `nag/files/schema`.

The way of ``nag decompose cases/bennett.toml`` from the command to the table leads through
`cli/command_line`, `cli/decompose`, `cli/arguments`; `files/cases`, `files/mechanism_case`;
`mechanism/graph`, `mechanism/problem`, `mechanism/model`, `mechanism/loops`,
`mechanism/formulations`, `mechanism/half_angles`, `mechanism/loop_product`,
`mechanism/joint_factors`; `algebra/system`; `tracking/run`; `decomposition/components`,
`decomposition/method`; `witness/witness`; `decomposition/one_equation`, `decomposition/reduction`,
`decomposition/roots`, `decomposition/final_checks`; `report/answer`, `witness/shown`.
What these call on the way gives them a value, and can be taken by its name.
"""

from nag.cli.command_line import main

__all__ = ["main"]
