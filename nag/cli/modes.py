"""The command ``nag modes``: the operation modes of a parallel robot."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import (
    StoreOnce,
    add_reading,
    add_running,
    budget_seconds,
    error_in_file,
    only_assembled,
    read_given_case,
)
from nag.cli.running import (
    CommandAnswer,
    answer_document,
    answer_of,
    chosen_run,
    name_case,
    say_first,
)
from nag.mechanism import MODES_BUDGET

if TYPE_CHECKING:
    from nag.mechanism.modes_report import OperationModes

# Of the labels: what is printed first is aligned with what comes later.
WIDTH = len("transition")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag modes`` has besides those of every command that runs a case."""
    parser.add_argument("case", metavar="CASE", help="case file (TOML), or a robot in URDF or MJCF")
    add_reading(parser)
    add_running(parser)
    parser.add_argument(
        "--platform",
        action=StoreOnce,
        metavar="NAME",
        help="the body whose poses are looked at (default: the one with the most legs between "
        "itself and the ground, three at least)",
    )
    parser.add_argument(
        "--budget",
        type=budget_seconds,
        default=MODES_BUDGET,
        metavar="SECONDS",
        help="no path is tracked where all of them are estimated to take longer than this, in "
        f"seconds of a common processor (default: {MODES_BUDGET})",
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """The operation modes of a parallel robot."""
    from nag.errors import MechanismError
    from nag.files.answer_export import fields_of
    from nag.interpolation.vanishing import InterpolationError
    from nag.mechanism import PLATFORM_ALONE
    from nag.mechanism.operation_modes import modes_in_steps
    from nag.report.agreement import agreement_text, compare
    from nag.witness.shown import paths_text

    case = read_given_case(options)
    if case.mechanism is None:
        raise only_assembled(case, "nag modes")

    def document_of(early: OperationModes) -> dict[str, Any]:
        return answer_document(options, name_case(case), fields_of(early), False)

    how = chosen_run(options, document_of)
    given = case.mechanism, options.platform
    try:
        for found in modes_in_steps(*given, budget=options.budget, run=how):
            blocks = found.rows(), found.table(), found.mode_rows()
            say_first(options, name_case(case), *blocks, width=WIDTH)
    except (MechanismError, InterpolationError) as error:
        raise error_in_file(options.case, error) from None
    decomposition = found.decomposition
    tail = [*case.note_rows, *found.tail()]
    known = [t for t in case.truth if t.formulation]
    # Of modes that were not looked for nothing is compared.
    looked = found.complete or bool(found.modes)
    agreement = compare(decomposition, known, PLATFORM_ALONE) if looked else None
    if agreement is not None:
        tail.append(("known", agreement_text(agreement)))
    tail.append(("paths", paths_text(decomposition.paths)))
    fields, complete = fields_of(found), found.complete
    return answer_of(options, name_case(case), blocks, tail, fields, complete, width=WIDTH)
