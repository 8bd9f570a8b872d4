"""``nag bench --decompose`` and ``--growth``: decompositions, their times, and how they grow."""

from __future__ import annotations

import argparse
import importlib.util
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError, problem_of_case, read_case_file
from nag.cli.running import CommandAnswer

if TYPE_CHECKING:
    from nag.bench.chains import Chain
    from nag.bench.decomposition import Decomposed, PeerDecomposed

CASES = Path("cases")
# Macaulay2 is given up after so many seconds.
PATIENCE = 200.0
# The names of `nag.bench.chains.CHAINS`, which takes longer to load than help to be given.
CHAINS = (
    "rhombi",
    "four-bars",
    "parallelograms",
    "bennett-loops",
    "goldberg-loops",
    "scissors",
    "polygons",
)
MOST_CELLS = 12
# Run unless names are given.
NAMES = (
    "slider-crank",
    "four-bar",
    "rhombus",
    "double-rhombus",
    "literature/sphere-and-cubic",
    "gonzalez",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag bench`` that are about decompositions."""
    parser.add_argument(
        "--decompose",
        action="store_true",
        help="decompose instead of solve: cases named by their path under cases/ without .toml",
    )
    parser.add_argument(
        "--growth",
        type=_cells,
        nargs="?",
        const=0,
        metavar="K",
        help="decompose chains of 1 to K cells (default: as many as take seconds)",
    )
    parser.add_argument(
        "--of",
        choices=CHAINS,
        metavar="CELLS",
        help=f"with --growth: what is chained, one of {', '.join(CHAINS)} (default: {CHAINS[0]}, "
        "of which K have 3^K components)",
    )
    parser.add_argument(
        "--chart", metavar="FILE", help="with --growth: draw time and paths (needs matplotlib)"
    )


def _cells(text: str) -> int:
    if text not in map(str, range(2, MOST_CELLS + 1)):
        raise argparse.ArgumentTypeError(f"{text[:30]!r} is not a number from 2 to {MOST_CELLS}")
    return int(text)


def run(options: argparse.Namespace) -> CommandAnswer:
    """Decompositions or their growth; complete if all answers are right."""
    from nag.files.written_file import TargetError, check_target

    if options.chart is not None and options.growth is None:
        raise UsageError("--chart: is drawn with --growth; ask for that as well")
    if options.of is not None and options.growth is None:
        raise UsageError("--of: is chained with --growth; ask for that as well")
    if options.chart is not None and importlib.util.find_spec("matplotlib") is None:
        raise UsageError("--chart: matplotlib is missing; pip install matplotlib")
    if options.chart is not None:
        try:
            check_target(options.chart)
        except TargetError as error:
            raise UsageError(f"--chart: {error}") from None

    from nag.bench.decomposition import as_json, growth, growth_chart
    from nag.bench.table import decomposition_table, growth_table

    peers: dict[str, PeerDecomposed] = {}
    if options.growth is not None:
        rows = growth(*_chain(options))
        lines = growth_table(rows)
        if options.chart is not None:
            try:
                growth_chart(rows, options.chart)
            except (OSError, ValueError) as error:
                raise UsageError(f"--chart: {options.chart}: {error}") from None
    else:
        rows, peers = _cases(options)
        lines = decomposition_table(rows, peers)
    return CommandAnswer(lines, all(row.right for row in rows), lambda: as_json(rows, peers))


def _chain(options: argparse.Namespace) -> tuple[Chain, int]:
    """What is chained, and how many cells of it at most."""
    from nag.bench import chains

    name = options.of or CHAINS[0]
    chain = chains.CHAINS[name]
    if options.growth > chain.most:
        raise UsageError(f"--growth: of {name} at most {chain.most} are chained")
    return chain, options.growth or chain.longest


def _cases(options: argparse.Namespace) -> tuple[list[Decomposed], dict[str, PeerDecomposed]]:
    from nag.bench.decomposition import macaulay2, macaulay2_installed, measure_decomposition

    known = []
    for name in options.case or NAMES:
        path = Path(name) if name.endswith(".toml") else CASES / f"{name}.toml"
        if not path.is_file():
            raise UsageError(f"--case: {name}: there is no {path}; name a case file")
        case = read_case_file(path)
        known.append((path, case, problem_of_case(case)))
    rows, peers = [], {}
    for path, case, problem in known:
        if not options.quiet:
            print(f"{path.stem} ...", file=sys.stderr, flush=True)
        system, formulation = problem.system, problem.formulation
        truth = case.known_in(formulation)
        rows.append(measure_decomposition(path.stem, system, truth, formulation=formulation))
        if options.peers and macaulay2_installed():
            peers[path.stem] = macaulay2(system, truth, PATIENCE)
    return rows, peers
