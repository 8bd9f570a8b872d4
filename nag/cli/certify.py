"""The command ``nag certify``: what is proved of the points of an export."""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError
from nag.cli.running import writing_json

if TYPE_CHECKING:
    from nag.solving.certificate import SolutionsCertificate
    from nag.solving.certified_paths import ProvedPaths
    from nag.solving.solutions import SolveResult
    from nag.witness.certificate import DecompositionCertificate
    from nag.witness.certified_loops import ProvedMonodromy
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
    parser.add_argument("--json", metavar="FILE", help="write the boxes to FILE as JSON")


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Certify an export; returns the lines to print and whether all points are proved.

    Raises:
        UsageError: if the export cannot be read, or the certificate cannot be written.
    """
    from nag.algebra.system import system_line
    from nag.files.certificate_export import write_certificate
    from nag.text.table import labelled, printable

    found, title = _read(options.export)
    proved = certified(found, options.paths)
    if options.json is not None:
        with writing_json():
            write_certificate(proved.certificate, options.json, proved.paths)
    rows = [("system", system_line(found.system)), *proved.rows]
    return [printable(title), "", *labelled(rows)], proved.all_proved


@dataclass(frozen=True)
class Certified:
    """What was proved of a result.

    Attributes:
        rows: labelled lines; all_proved: whether nothing was left open.
        certificate, paths: of the points, and of the paths or loops, if they were asked for.
    """

    rows: list[tuple[str, str]]
    all_proved: bool
    certificate: SolutionsCertificate | DecompositionCertificate
    paths: ProvedPaths | tuple[ProvedMonodromy, ...] | None = None


def certified(found: SolveResult | Decomposition, paths: bool = False) -> Certified:
    """The certificate of a result, with ``paths`` also of the paths that lead to it."""
    from nag.report.certificate import decomposition_rows, solution_rows
    from nag.solving.certificate import certify_solutions
    from nag.solving.solutions import SolveResult
    from nag.witness.certificate import certify_decomposition

    started = time.perf_counter()
    if isinstance(found, SolveResult):
        certificate = certify_solutions(found)
        rows = solution_rows(certificate, time.perf_counter() - started)
        more = _paths(found) if paths else None
    else:
        certificate = certify_decomposition(found)
        rows = decomposition_rows(certificate, time.perf_counter() - started)
        more = _loops(found) if paths else None
    if more is None:
        return Certified(rows, certificate.all_proved, certificate)
    proved, further, good = more
    return Certified([*rows, *further], certificate.all_proved and good, certificate, proved)


def _paths(found: SolveResult) -> tuple[ProvedPaths | None, list[tuple[str, str]], bool]:
    """The proof of the paths to solutions, its lines, and whether nothing was left open."""
    from nag.report.certificate import paths_rows
    from nag.solving.certified_paths import PathsError, prove_paths

    started = time.perf_counter()
    try:
        proved = prove_paths(found)
    except PathsError as error:
        return None, [("paths", f"not proved: {error}")], False
    rows = paths_rows(proved, len(found.solutions), time.perf_counter() - started)
    simple = sum(s.multiplicity == 1 for s in found.solutions)
    return proved, rows, proved.distinct and not proved.lost and len(proved.solutions) >= simple


def _loops(
    found: Decomposition,
) -> tuple[tuple[ProvedMonodromy, ...], list[tuple[str, str]], bool]:
    """The proof of the loops of all components, its lines, and whether nothing was left open."""
    from nag.report.certificate import loops_rows
    from nag.witness.certified_loops import prove_all

    started = time.perf_counter()
    proved = prove_all(found)
    rows = loops_rows(proved, time.perf_counter() - started)
    return proved, rows, all(m.connected for m in proved)


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
