"""The command ``nag certify``: what is proved of the points of an export."""

from __future__ import annotations

import argparse
import re
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import add_quiet
from nag.cli.running import CommandAnswer

if TYPE_CHECKING:
    from nag.numerics.claims import Claim
    from nag.solving.certificate import SolutionsCertificate
    from nag.solving.certified_paths import ProvedPaths
    from nag.solving.solutions import SolveResult
    from nag.text.table import Row
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
    add_quiet(parser)


def run(options: argparse.Namespace) -> CommandAnswer:
    """What is proved of an export."""
    from nag.algebra.system import system_line
    from nag.files.json_values import read_file
    from nag.text.table import sheet

    found, title, lost = read_file(options.export, _read_result)
    proved = certify_result(found, options.paths, lost)
    rows = [("system", system_line(found.system)), *proved.rows]
    return CommandAnswer(
        sheet(title, rows),
        proved.all_proved,
        lambda: proved.certificate.document(proved.claims, proved.paths),
    )


def proof_asked_for(
    options: argparse.Namespace, found: SolveResult | Decomposition
) -> Callable[[], tuple[list[Row], bool]] | None:
    """What proves a result, if ``--certify`` or ``--certify-paths`` is given."""
    if not (options.certify or options.certify_paths):
        return None

    def prove() -> tuple[list[Row], bool]:
        proved = certify_result(found, options.certify_paths)
        return proved.rows, proved.all_proved

    return prove


@dataclass(frozen=True)
class Certified:
    """What was proved of a result.

    Attributes:
        rows: labelled lines; all_proved: whether nothing was refuted or left open.
        certificate, paths: of the points, and of the paths or loops, if they were asked for.
        claims: how every statement of an export of the result stands.
    """

    rows: list[tuple[str, str]]
    all_proved: bool
    certificate: SolutionsCertificate | DecompositionCertificate
    paths: ProvedPaths | tuple[ProvedMonodromy, ...] | None
    claims: tuple[Claim, ...]


def certify_result(
    found: SolveResult | Decomposition, paths: bool = False, lost: Sequence[Claim] = ()
) -> Certified:
    """The certificate of a result, with ``paths`` also of the paths that lead to it.

    Args:
        lost: fields of an export that are not in what was read of it.
    """
    from nag.numerics.claims import claims_rows, nothing_against
    from nag.solving.certificate import certify_solutions
    from nag.solving.solutions import SolveResult
    from nag.witness.certificate import certify_decomposition

    started = time.perf_counter()
    if isinstance(found, SolveResult):
        certificate, prove = certify_solutions(found), _paths
    else:
        certificate, prove = certify_decomposition(found), _loops
    claims = certificate.claims
    rows = certificate.rows(time.perf_counter() - started)
    proved, further, good, claims = prove(certificate) if paths else (None, [], True, claims)
    claims = (*claims, *lost)
    good = good and certificate.all_proved and nothing_against(claims)
    return Certified([*rows, *further, *claims_rows(claims)], good, certificate, proved, claims)


Further = tuple[Any, list[tuple[str, str]], bool, tuple["Claim", ...]]


def _paths(certificate: SolutionsCertificate) -> Further:
    """The proof of the paths to solutions, its lines, whether nothing was left open, statements."""
    from nag.solving.certified_paths import PathsError, prove_paths
    from nag.solving.solution_claims import claims_of_paths

    found, started = certificate.result, time.perf_counter()
    try:
        proved = prove_paths(found)
    except PathsError as error:
        return None, [("paths", f"not proved: {error}")], False, certificate.claims
    rows = proved.rows(len(found.solutions), time.perf_counter() - started)
    simple = sum(s.multiplicity == 1 for s in found.solutions)
    good = proved.distinct and not proved.lost and len(proved.solutions) >= simple
    return proved, rows, good, claims_of_paths(certificate, proved.others)


def _loops(certificate: DecompositionCertificate) -> Further:
    """The proof of the loops of all components, its lines, whether all is proved, statements."""
    from nag.decomposition.trace import linear_traces
    from nag.witness.certified_loops import loops_rows, prove_all
    from nag.witness.component_claims import claims_of_loops

    found, started = certificate.decomposition, time.perf_counter()
    proved = prove_all(found)
    connected = [m.connected for m in proved]
    claims = claims_of_loops(certificate, connected, linear_traces(found))
    rows = loops_rows(proved, time.perf_counter() - started)
    return proved, rows, all(connected), claims


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
