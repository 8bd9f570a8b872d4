"""The option ``--sweep``: the components for many values of a parameter."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, read_problem
from nag.cli.running import CommandAnswer, answer_document, chosen_run, name_case, run_row

if TYPE_CHECKING:
    from nag.decomposition.sweep import Swept

MOST_VALUES = 1000
_NUMBER = re.compile(r"[+-]?[0-9]{1,15}(\.[0-9]{1,15}|/[0-9]{1,15})?")


@dataclass(frozen=True)
class AskedSweep:
    """Equally spaced values of a parameter.

    Attributes:
        name: of the parameter.
        values: exact, two or more.
    """

    name: str
    values: tuple[Fraction, ...]


def sweep_of(text: str) -> AskedSweep:
    """What ``NAME=FIRST:LAST:COUNT`` says."""
    name, equals, numbers = text.partition("=")
    parts = [part.strip() for part in numbers.split(":")]
    if not (name.strip() and equals and len(parts) == 3):
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is not of the form NAME=FIRST:LAST:COUNT")
    for part in parts[:2]:
        if not _NUMBER.fullmatch(part) or re.search(r"/0+$", part):
            raise argparse.ArgumentTypeError(f"{part[:30]!r} is no number; write 1.5 or 3/2")
    first, last = (Fraction(part) for part in parts[:2])
    if first == last:
        raise argparse.ArgumentTypeError("both ends are the same; write --set")
    if not (parts[2].isascii() and parts[2].isdigit() and 2 <= int(parts[2][:9]) <= MOST_VALUES):
        raise argparse.ArgumentTypeError(
            f"{parts[2][:30]!r} is no number of values from 2 to {MOST_VALUES}"
        )
    count = int(parts[2])
    step = (last - first) / (count - 1)
    return AskedSweep(name.strip(), tuple(first + step * k for k in range(count)))


def run(arguments: argparse.Namespace) -> CommandAnswer:
    """The table of a sweep, which is complete if every line of it is.

    Raises:
        UsageError: for an option that does not go with a sweep.
    """
    for option, given in (
        ("--expand", arguments.expand),
        ("--method sampling", arguments.method == "sampling"),
    ):
        if given:
            raise UsageError(f"--sweep: is not for {option}; leave it out")
    asked: AskedSweep = arguments.sweep
    settings = list(arguments.set)
    if any(name == asked.name for name, _ in settings):
        raise UsageError(f"--sweep: {asked.name} is set by --set as well; leave one of them out")

    arguments.set = [*settings, (asked.name, asked.values[0])]
    case, first = read_problem(arguments, exports=False)

    from nag.decomposition.sweep import Sweep
    from nag.files.answer_export import fields_of
    from nag.questions import sweep_parameter
    from nag.text.table import align, sheet
    from nag.tracking.run import ENDED_EARLY

    def document_of(values: Sequence[Swept], ended: bool = True) -> dict[str, Any]:
        fields = {
            **fields_of(Sweep(asked.name, tuple(values))),
            "notes": [ENDED_EARLY] if ended else [],
            "count": len(asked.values),
        }
        complete = not ended and all(each.decomposition.complete for each in values)
        return answer_document(arguments, name_case(case), fields, complete)

    how = chosen_run(arguments, document_of)
    formulation = first.formulation or "auto"
    swept = sweep_parameter(case, asked.name, asked.values, formulation=formulation, run=how)
    text = (
        f"{swept.followed_count} of {len(swept)} values, from the components for a general value; "
        "those that a single value may have besides are not looked for there"
    )
    reasons = dict.fromkeys(each.reason for each in swept if each.reason)
    tail = [("followed", text), *(("by itself", reason) for reason in reasons)]
    lines = sheet(case.title, align(swept.rows(), (1, 3)), [*tail, run_row(arguments, ())])
    return CommandAnswer(lines, swept.complete, lambda: document_of(swept, ended=False))
