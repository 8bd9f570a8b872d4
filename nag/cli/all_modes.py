"""``nag decompose --modes all``: the components of every assembly mode."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError
from nag.cli.running import seconds, writing_json

if TYPE_CHECKING:
    from nag.files.cases import Case


def run_all_modes(
    arguments: argparse.Namespace,
    case: Case,
    progress: Callable[[str, int, int], None],
) -> tuple[list[str], bool]:
    """Decompose one combination of each class; returns the lines to print and whether all is known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    from nag.files.modes_export import write_modes
    from nag.mechanism.mode_decomposition import decompose_modes
    from nag.mechanism.model import ModelError
    from nag.report.modes import modes_lines

    try:
        answer = decompose_modes(
            case.mechanism,
            arguments.formulation or "auto",
            arguments.coordinates or ("joint" if arguments.formulation == "H" else "euler"),
            seed=arguments.seed,
            threads=arguments.threads,
            settings=arguments.settings,
            progress=progress,
        )
    except ModelError as error:
        raise UsageError(f"{arguments.case}: {error}") from None
    lines = modes_lines(answer, case.title, seconds(arguments))
    if arguments.json is not None:
        with writing_json(lines):
            write_modes(answer, arguments.json, case)
    return lines, answer.complete
