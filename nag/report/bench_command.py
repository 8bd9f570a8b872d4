"""The command ``nag bench``: the benchmark systems, their counts and their times."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from nag.report import bench_decompose
from nag.report.bench_decompose import BenchError

if TYPE_CHECKING:
    from nag.bench.measure import Measured
    from nag.bench.peers import Peer

FOLDER = Path("cases") / "benchmarks"
# Another program is given up after so many seconds.
PATIENCE = 300.0
# Run unless names are given.
NAMES = (
    "katsura-8",
    "katsura-9",
    "katsura-10",
    "katsura-11",
    "cyclic-5",
    "cyclic-6",
    "cyclic-7",
    "noon-5",
    "noon-6",
    "chandra-8",
    "eco-8",
    "reimer-5",
    "inverse-6r",
    "stewart-gough",
    "planar-3-rpr",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag bench``."""
    parser.add_argument(
        "--case",
        action="append",
        metavar="NAME",
        help="a benchmark, by its file's name without .toml, or a case file (repeatable)",
    )
    parser.add_argument(
        "--folder",
        default=str(FOLDER),
        metavar="DIR",
        help=f"folder of the benchmarks (default: {FOLDER})",
    )
    parser.add_argument("--peers", action="store_true", help="run M2 and phc too, where installed")
    parser.add_argument("--json", metavar="FILE", help="write the table to FILE as JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")
    bench_decompose.add_arguments(parser)


def files(names: list[str] | None, folder: str) -> list[Path]:
    """The case files to run.

    Raises:
        BenchError: if there is no such benchmark.
    """
    there = Path(folder)
    if not there.is_dir() and not names:
        raise BenchError(f"--folder: {folder}: is no folder; name the one that has the benchmarks")
    result = []
    for name in names or NAMES:
        path = Path(name) if name.endswith(".toml") else there / f"{name}.toml"
        if not path.is_file():
            known = ", ".join(sorted(p.stem for p in there.glob("*.toml")))
            raise BenchError(f"--case: {name}: no such benchmark; there are {known or 'none'}")
        result.append(path)
    return result


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Run the benchmarks; returns the lines to print and whether all counts are right.

    Raises:
        BenchError: if a benchmark cannot be read, or the table cannot be written.
    """
    if options.decompose or options.growth is not None or options.chart is not None:
        return bench_decompose.run(options)

    from nag.bench.measure import as_json, flop_rate, measure
    from nag.bench.peers import installed, run_peer
    from nag.cases import CaseError, read_case
    from nag.mechanism.model import ModelError, model
    from nag.report.target import TargetError, write_target
    from nag.tracking.start.target import StartError

    cases = []
    for path in files(options.case, options.folder):
        try:
            case = read_case(path)
            made = model(case.mechanism) if case.mechanism is not None else None
        except (CaseError, ModelError) as error:
            raise BenchError(str(error)) from None
        formulation = made.formulation if made else None
        known = [t for t in case.truth if t.dimension == 0 and t.formulation in (None, formulation)]
        system = made.system if made else case.system
        expected = sum(t.count for t in known) if known else None
        cases.append((path, system, expected, case.family))
    rate = flop_rate()
    programs = installed() if options.peers else []
    rows, peers = [], {}
    for path, system, expected, family in cases:
        if not options.quiet:
            print(f"{path.stem} ...", file=sys.stderr, flush=True)
        try:
            rows.append(measure(path.stem, path, system, expected, 0, rate, family=family))
        except StartError as error:
            raise BenchError(f"{path}: {error}") from None
        peers[path.stem] = {p: run_peer(p, system, PATIENCE) for p in programs}
    if options.json is not None:
        documents = {
            name: {p: peer.document() for p, peer in found.items()} for name, found in peers.items()
        }
        try:
            write_target(options.json, as_json(rows, rate, documents))
        except TargetError as error:
            raise BenchError(f"--json: {error}") from None
    return table(rows, peers, programs, rate), all(row.right for row in rows)


def table(
    rows: list[Measured], peers: dict[str, dict[str, Peer]], programs: list[str], rate: float
) -> list[str]:
    """The benchmarks as aligned lines; times in seconds, those of a step in microseconds."""
    from nag.report.table import align

    head = ["system", "solutions", "known", "start", "paths", "steps/path", "solve", "2 threads"]
    head += ["process", "us/step", "bound"]
    head += [cell for p in programs for cell in (f"{p} found", f"{p} solve", f"{p} process")]
    head += [f"x {p}" for p in programs]
    lines = [head]
    for row in rows:
        cells = [
            row.case,
            str(row.solutions) + ("" if row.complete else " incomplete"),
            "-" if row.expected is None else str(row.expected),
            row.start,
            str(row.paths),
            f"{row.steps / max(row.paths, 1):.0f}",
            f"{row.seconds:.4f}",
            f"{row.two_threads:.4f}",
            f"{row.process:.2f}",
            f"{row.microseconds:.2f}",
            f"{row.bound:.2f}",
        ]
        found = peers.get(row.case, {})
        for p in programs:
            peer = found[p]
            seconds = "-" if peer.seconds is None else f"{peer.seconds:.3f}"
            cells += [str(peer.solutions or peer.remark), seconds, f"{peer.process:.2f}"]
        for p in programs:
            reference = found[p].seconds or found[p].process
            cells.append(f"{reference / row.seconds:.0f}" if found[p].solutions else "-")
        lines.append(cells)
    text = align(lines, {0, 3})
    text += [
        "",
        "solve: seconds, warm, one thread; process: a whole process; bound: microseconds that a",
        f"step's operations take at {rate / 1e9:.1f} Gflop/s, measured; x: how many times as long",
        "the other program solves (its whole process where it does not say).",
    ]
    wrong = [row.case for row in rows if not row.right]
    if wrong:
        text.append(f"WRONG: {', '.join(wrong)}")
    return text
