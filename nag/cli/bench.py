"""The command ``nag bench``: the benchmark systems, their counts and their times."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from nag.cli import bench_decompose, bench_models, bench_scale
from nag.cli.arguments import UsageError, add_quiet, problem_of_case, read_case_file, whole
from nag.cli.running import CommandAnswer

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
# Those whose steps are explained unless names are given.
EXPLAINED = ("katsura-8", "katsura-9", "katsura-10", "katsura-11", "cyclic-7")


def _seconds(text: str) -> int:
    return whole(text, 1, 10**6)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag bench``."""
    parser.add_argument(
        "what",
        nargs="?",
        choices=("systems", "models", "scale"),
        default="systems",
        help="the benchmark systems, every mechanism in every formulation, or what a path costs in "
        "time, memory and on disk, and what very many would (default: systems)",
    )
    parser.add_argument(
        "--patience",
        type=_seconds,
        default=bench_models.PATIENCE,
        metavar="SECONDS",
        help="models: time for each formulation (default: %(default)s)",
    )
    parser.add_argument(
        "--case",
        action="append",
        metavar="NAME",
        help="a benchmark, by its file's name without .toml, or a case file (repeatable)",
    )
    parser.add_argument(
        "--folder",
        metavar="DIR",
        help=f"folder of the benchmarks (default: {FOLDER}; of mechanisms {bench_models.FOLDER})",
    )
    parser.add_argument(
        "--explain",
        action="store_true",
        help="say where the time of a step goes: what its parts take, beside what their arithmetic "
        "would",
    )
    parser.add_argument("--peers", action="store_true", help="run M2 and phc too, where installed")
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the table to FILE as JSON, or - for standard output alone",
    )
    add_quiet(parser)
    bench_decompose.add_arguments(parser)


def files(names: list[str] | None, folder: str, default: tuple[str, ...] = NAMES) -> list[Path]:
    """The case files to run.

    Raises:
        UsageError: if there is no such benchmark.
    """
    there = Path(folder)
    if not there.is_dir() and not names:
        raise UsageError(f"--folder: {folder}: is no folder; name the one that has the benchmarks")
    result = []
    for name in names or default:
        path = Path(name) if name.endswith(".toml") else there / f"{name}.toml"
        if not path.is_file():
            known = ", ".join(sorted(p.stem for p in there.glob("*.toml")))
            if not known:
                raise UsageError(
                    f"--case: {name}: no benchmark is in the folder {folder}; name the one that "
                    "has them (--folder)"
                )
            raise UsageError(f"--case: {name}: no such benchmark; there are {known}")
        result.append(path)
    return result


def run(options: argparse.Namespace) -> CommandAnswer:
    """The benchmarks; complete if all counts are right."""
    if options.what == "models":
        return bench_models.run(options)
    if options.what == "scale":
        return bench_scale.run(options)
    if options.folder is None:
        options.folder = str(FOLDER)
    if options.decompose or any(x is not None for x in (options.growth, options.chart, options.of)):
        return bench_decompose.run(options)
    if options.explain:
        return _explain(options)

    from nag.bench.measure import as_json, flop_rate, measure
    from nag.bench.peers import installed_programs, run_peer
    from nag.bench.table import table
    from nag.errors import StartError

    cases = []
    for path in files(options.case, options.folder):
        case = read_case_file(path)
        problem = problem_of_case(case)
        known = [t for t in case.known_in(problem.formulation) if t.dimension == 0]
        expected = sum(t.count for t in known) if known else None
        cases.append((path, problem.system, expected, problem.family))
    rate = flop_rate()
    programs = installed_programs() if options.peers else []
    rows, peers = [], {}
    for path, system, expected, family in cases:
        if not options.quiet:
            print(f"{path.stem} ...", file=sys.stderr, flush=True)
        try:
            rows.append(measure(path.stem, path, system, expected, 0, rate, family=family))
        except StartError as error:
            raise UsageError(f"{path}: {error}") from None
        peers[path.stem] = {p: run_peer(p, system, PATIENCE) for p in programs}
    documents = {
        name: {p: peer.document() for p, peer in found.items()} for name, found in peers.items()
    }
    return CommandAnswer(
        table(rows, peers, programs, rate),
        all(row.right for row in rows),
        lambda: as_json(rows, rate, documents),
    )


def _explain(options: argparse.Namespace) -> CommandAnswer:
    """Where the time of a step goes."""
    from nag.bench.measure import flop_rate
    from nag.bench.step_parts import measure_step
    from nag.bench.table import step_table
    from nag.errors import StartError

    rate, costs = flop_rate(), []
    for path in files(options.case, options.folder, EXPLAINED):
        system = problem_of_case(read_case_file(path)).system
        if not options.quiet:
            print(f"{path.stem} ...", file=sys.stderr, flush=True)
        try:
            costs.append(measure_step(path.stem, system))
        except StartError as error:
            raise UsageError(f"{path}: {error}") from None
    document = {
        "format": "nag-bench-steps",
        "flops_per_second": rate,
        "systems": [cost.document() for cost in costs],
    }
    return CommandAnswer(step_table(costs, rate), True, lambda: document)
