"""The command ``nag``: a command is a file of its name.

Read in this order, top-down: `command_line` (the list of commands), `running` (starting, telling,
writing and printing), `watched` (the process that waits for the one that works, and ends it),
`arguments` (options that commands share), then any command. `witness_input` is what those that work
with components begin with; `sweep` belongs to `decompose`, files that begin as ``bench`` and
``chart`` do to these. Only `nag.__main__` imports this package.

Each command has ``add_arguments(parser)`` and ``run(options)``, which turns the options into a call
and hands back a `running.CommandAnswer`: the lines to print, whether it is complete, and the
document that ``--json`` writes. `running.answer_of` makes one of a title, rows and the document's
own fields; the documents of `decompose`, `solve` and `certify` are made in `nag.files`, that of
`eliminate` in `nag.report`.

To add a command, write such a file, enter it in `command_line.COMMANDS`, the README and
`docs/commands.md`; what it exports has a ``format`` and its schema in the folder
`nag/files/schema`, to which `tests/test_schemas.py` holds what is written.

The way of ``nag decompose cases/bennett.toml`` from the command to the table leads through
`cli/command_line`, `cli/arguments`, `cli/decompose`, `cli/running`; `files/cases`,
`files/mechanism_case`; `mechanism/graph`, `mechanism/problem`, `mechanism/model`,
`mechanism/loops`, `mechanism/formulations`, `mechanism/half_angles`, `mechanism/loop_product`,
`mechanism/joint_factors`; `algebra/system`; `tracking/run`; `decomposition/decompose`,
`decomposition/method`; `witness/witness`; `decomposition/one_equation`, `decomposition/reduction`,
`decomposition/roots`, `decomposition/final_checks`; `report/answer`; `witness/shown`. What these
call on the way gives them a value, and can be taken by its name; the methods of decomposition that
are asked first leave this case to the next ones.
"""

import sys

try:
    from nag.cli.command_line import main
except KeyboardInterrupt:
    # Ctrl-C while the program is being loaded ends it as it does later.
    sys.stderr.write("nag: interrupted\n")
    sys.exit(130)

__all__ = ["main"]
