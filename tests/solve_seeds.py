"""Solve cases for many seeds and count the answers that are wrong or incomplete.

    python tests/solve_seeds.py --seeds 0:100 [--case NAME ...] [--folder benchmarks ...]
        [--start KIND] [--settings NAME] [--threads N]

Cases whose solutions are not all isolated are passed over. Prints one line a case: seeds, answers
that differ from what the case file knows, answers that do not claim to be complete, paths that
failed in all of them, and medians over the seeds. Exit status 1 if an answer is wrong or
incomplete.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from pathlib import Path
from statistics import median

from nag.cases import read_case
from nag.mechanism.model import model
from nag.tracking.solve import solve
from nag.tracking.start.choice import KINDS

CASES = Path(__file__).resolve().parent.parent / "cases"


def run(path: Path, seeds: range, options: argparse.Namespace) -> bool | None:
    """Solve one case for all seeds and print the counts.

    Returns:
        Whether all answers were right and complete; None for a case that is passed over.
    """
    case, formulation = read_case(path), None
    system = case.system
    if case.mechanism is not None:
        chosen = model(case.mechanism)
        system, formulation = chosen.system, chosen.formulation
    truth = [t for t in case.truth if t.formulation in (None, formulation)]
    if not truth or any(t.dimension for t in truth):
        return None
    known: Counter[int] = Counter()
    for item in truth:
        known[item.multiplicity] += item.count
    wrong = incomplete = failed = 0
    seconds, steps = [], []
    for seed in seeds:
        begin = time.process_time()
        answer = solve(
            system,
            start=options.start,
            seed=seed,
            threads=options.threads,
            settings=options.settings,
        )
        seconds.append(time.process_time() - begin)
        steps.append(answer.paths.steps / max(1, answer.paths.tracked))
        found = Counter(s.multiplicity for s in answer.solutions)
        wrong += found != known
        incomplete += not answer.complete
        failed += answer.paths.failed
        if found != known or not answer.complete:
            counts = ", ".join(f"{k} of multiplicity {m}" for m, k in sorted(found.items()))
            notes = "; ".join(answer.notes)
            print(f"  seed {seed}: {counts}; {answer.paths} {notes}", flush=True)
    print(
        f"{path.stem}: {len(seeds)} seeds, {wrong} wrong, {incomplete} incomplete, "
        f"{failed} paths failed; {median(steps):.1f} steps a path, {median(seconds):.3f} s",
        flush=True,
    )
    return not wrong and not incomplete


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:20", help="first:last+1")
    parser.add_argument("--case", action="append", help="stem of a case file; all by default")
    parser.add_argument("--folder", action="append", help="folder under cases/: benchmarks")
    parser.add_argument("--start", choices=KINDS, default="auto")
    parser.add_argument("--settings", default="default")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(":"))
    folders = [CASES / name for name in options.folder or ["benchmarks"]]
    paths = [p for folder in folders for p in sorted(folder.glob("*.toml"))]
    if options.case:
        paths = [p for p in paths if p.stem in options.case]
    results = [run(p, range(first, last), options) for p in paths]
    return 1 if False in results else 0


if __name__ == "__main__":
    sys.exit(main())
