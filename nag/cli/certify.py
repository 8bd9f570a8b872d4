"""The command ``nag certify``: what is proved of the points of an export."""

from __future__ import annotations

import argparse
import time
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError
from nag.cli.running import writing_json

if TYPE_CHECKING:
    from nag.solving.certificate import SolutionsCertificate
    from nag.solving.solutions import SolveResult
    from nag.witness.certificate import DecompositionCertificate
    from nag.witness.witness import Decomposition


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag certify``."""
    parser.add_argument(
        "export", metavar="EXPORT", help="export of `nag solve --json` or `nag decompose --json`"
    )
    parser.add_argument("--json", metavar="FILE", help="write the boxes to FILE as JSON")


def add_certify(parser: argparse.ArgumentParser) -> None:
    """The option of the commands that find points."""
    parser.add_argument(
        "--certify",
        action="store_true",
        help="prove a zero in a box about each point found, as `nag certify` does of an export; "
        "the answer is complete only if all are proved",
    )


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Certify an export; returns the lines to print and whether all points are proved.

    Raises:
        UsageError: if the export cannot be read, or the certificate cannot be written.
    """
    from nag.files.certificate_export import write_certificate
    from nag.report.table import labelled, printable, system_line

    found, title = _read(options.export)
    certificate, rows = certified(found)
    if options.json is not None:
        with writing_json():
            write_certificate(certificate, options.json)
    rows = [("system", system_line(found.system)), *rows]
    return [printable(title), "", *labelled(rows)], certificate.all_proved


def certified(
    found: SolveResult | Decomposition,
) -> tuple[SolutionsCertificate | DecompositionCertificate, list[tuple[str, str]]]:
    """The certificate of a result, and its lines."""
    from nag.report.certificate import decomposition_rows, solution_rows
    from nag.solving.certificate import certify_solutions
    from nag.solving.solutions import SolveResult
    from nag.witness.certificate import certify_decomposition

    started = time.perf_counter()
    if isinstance(found, SolveResult):
        solved = certify_solutions(found)
        return solved, solution_rows(solved, time.perf_counter() - started)
    decomposed = certify_decomposition(found)
    return decomposed, decomposition_rows(decomposed, time.perf_counter() - started)


def _read(path: str) -> tuple[SolveResult | Decomposition, str]:
    """What an export of either kind holds, and the title of its case."""
    from nag.files.export import FORMAT, Export, export_of
    from nag.files.json_values import ExportError, read_file
    from nag.files.solutions_export import SolutionsExport, solutions_of

    def convert(value: object) -> Export | SolutionsExport:
        of_components = isinstance(value, dict) and value.get("format") == FORMAT
        return export_of(value) if of_components else solutions_of(value)

    try:
        found = read_file(path, convert)
    except ExportError as error:
        raise UsageError(str(error)) from None
    memory = "a system built in memory"
    if isinstance(found, SolutionsExport):
        return found.result, found.title or memory
    return found.decomposition, found.origin.title if found.origin else memory
