"""The command ``nag certify``: what is proved of the points of an export."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_quiet, add_sharing, is_json
from nag.cli.running import CommandAnswer

if TYPE_CHECKING:
    from nag.numerics.claims import Claim
    from nag.solving.solutions import SolveResult
    from nag.text.table import Row
    from nag.witness.witness import Decomposition


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag certify``."""
    parser.add_argument(
        "export", metavar="EXPORT", help="export of `nag solve --json` or `nag decompose --json`"
    )
    parser.add_argument(
        "--paths",
        action="store_true",
        help="prove the paths to solutions as well, from the start system on, and of components "
        "the loops that connect their points",
    )
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the boxes to FILE as JSON; - for standard output alone",
    )
    add_sharing(parser)
    add_quiet(parser)


def run(options: argparse.Namespace) -> CommandAnswer:
    """What is proved of an export."""
    from nag.algebra.system import system_line
    from nag.files.json_values import read_file
    from nag.questions import certify_result
    from nag.text.table import sheet

    if os.path.isfile(options.export) and not is_json(options.export):
        raise UsageError(
            f"{options.export}: is no export; nag certify proves what `nag solve --json FILE` or "
            "`nag decompose --json FILE` wrote, and --certify of these proves it at once"
        )
    if options.progress is not None:
        options.progress(f"reading {os.path.basename(options.export)}", 0, 0)
    found, title, lost = read_file(options.export, _read_result)
    proved = certify_result(found, options.paths, lost)
    rows = [("system", system_line(found.system)), *proved.rows]
    return CommandAnswer(
        sheet(title, rows),
        proved.all_proved,
        proved.document,
    )


def proof_asked_for(
    options: argparse.Namespace, found: SolveResult | Decomposition
) -> Callable[[], tuple[list[Row], bool]] | None:
    """What proves a result, if ``--certify`` or ``--certify-paths`` is given."""
    if not (options.certify or options.certify_paths):
        return None

    def prove() -> tuple[list[Row], bool]:
        from nag.questions import certify_result

        proved = certify_result(found, options.certify_paths)
        return proved.rows, proved.all_proved

    return prove


def _read_result(value: Any) -> tuple[SolveResult | Decomposition, str, list[Claim]]:
    from nag.files import export, solutions_export
    from nag.files.json_values import ExportError, read_differently

    memory = "a system built in memory"
    if isinstance(value, dict) and value.get("format") == export.FORMAT:
        read = export.export_of(value)
        found, title = read.decomposition, read.origin.title if read.origin else memory
        # Files of version 1 say some things in other words.
        head = read.origin.head if read.origin else {}
        again = found.document(**head) if value["version"] > 1 else value
    else:
        if isinstance(value, dict) and value.get("format") != solutions_export.FORMAT:
            both = f'"{export.FORMAT}" or "{solutions_export.FORMAT}"'
            raise ExportError(f"format: must be {both}")
        solved = solutions_export.solutions_of(value)
        found, title = solved.result, solved.title or memory
        again = found.document(solved.title, solved.file)
    lost = read_differently(value, again)
    return found, title, [_claim_of_field(place, why) for place, why in lost.items()]


def _claim_of_field(place: str, why: str) -> Claim:
    """That a field is read, or follows from the rest of a file, and is not, or does not."""
    from nag.files.json_values import FOLLOWS
    from nag.numerics.claims import Claim, Standing, name_entries
    from nag.solving.solution_claims import LISTS

    standing = Standing.REFUTED if place.rpartition(".")[2] in FOLLOWS else Standing.UNSEEN
    field, entry = re.sub(r"\[\d+\]", "[]", place), re.match(r"(\w+)\[(\d+)\]", place)
    if entry is None:
        return Claim(field, why, standing)
    names = LISTS | {"components": "component"}
    subject = name_entries(names.get(entry[1], f"{entry[1]}, entry"), [int(entry[2])])
    return Claim(field, why, standing, subject)
