"""Solve cases for many seeds and count the answers that are right, wrong, incomplete or slow.

    python tests/solve_seeds.py --seeds 0:100 [--case NAME ...] [--folder benchmarks ...]
        [--start KIND] [--settings NAME] [--threads N] [--jobs J] [--limit SECONDS]

Cases whose solutions are not all isolated are passed over. Right: complete, with the numbers of
solutions of each multiplicity that the case file knows; wrong: complete, with others; slow: ended
at the limit of processor time. Prints one line a case: these counts, paths that failed and, over
the seeds, the median number of steps and the median and largest processor time. Exit status 1 if
an answer is not right.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from statistics import median

from nag.algebra.system import PolynomialSystem
from nag.bench.timed_runs import TimedRun, timed_runs
from nag.files.cases import read_case
from nag.mechanism.model import model
from nag.solving.solve import solve
from nag.solving.start import ASKED_FOR

CASES = Path(__file__).resolve().parent.parent / "cases"


@dataclass(frozen=True)
class Task:
    """A case to be solved with one seed."""

    path: Path
    seed: int
    start: str
    settings: str
    threads: int


@dataclass(frozen=True)
class Answer:
    """Solutions by multiplicity, whether they are said to be all, and what is said beside."""

    found: Counter[int]
    complete: bool
    failed: int
    steps: float
    text: str


@cache
def subject(path: Path) -> tuple[PolynomialSystem, Counter[int] | None]:
    """The system of a case and its isolated solutions by multiplicity, None if not known."""
    case, formulation = read_case(path), None
    system = case.system
    if case.mechanism is not None:
        chosen = model(case.mechanism)
        system, formulation = chosen.system, chosen.formulation
    truth = [t for t in case.truth if t.formulation in (None, formulation)]
    if not truth or any(t.dimension for t in truth):
        return system, None
    known: Counter[int] = Counter()
    for item in truth:
        known[item.multiplicity] += item.count
    return system, known


def answer(task: Task) -> Answer:
    """Solve once."""
    system, _ = subject(task.path)
    result = solve(
        system, start=task.start, seed=task.seed, threads=task.threads, settings=task.settings
    )
    found = Counter(s.multiplicity for s in result.solutions)
    counts = ", ".join(f"{k} of multiplicity {m}" for m, k in sorted(found.items()))
    text = f"{counts or 'none'}; {result.paths} {'; '.join(result.notes)}"
    steps = result.paths.steps / max(1, result.paths.tracked)
    return Answer(found, result.complete, result.paths.failed, steps, text)


def verdict(run: TimedRun, known: Counter[int]) -> str:
    """``"right"``, ``"wrong"``, ``"incomplete"`` or ``"slow"``; an error is a wrong answer."""
    if run.value is None:
        return "slow" if run.slow else "wrong"
    if not run.value.complete:
        return "incomplete"
    return "right" if run.value.found == known else "wrong"


def report(path: Path, runs: Sequence[TimedRun], known: Counter[int]) -> bool:
    """Print the line of one case; whether all its answers are right."""
    verdicts = Counter(verdict(run, known) for run in runs)
    steps = [run.value.steps for run in runs if run.value is not None]
    seconds = [run.seconds for run in runs]
    failed = sum(run.value.failed for run in runs if run.value is not None)
    counts = ", ".join(f"{verdicts[v]} {v}" for v in ("right", "wrong", "incomplete", "slow"))
    print(
        f"{path.stem}: {len(runs)} seeds, {counts}, {failed} paths failed; "
        f"{median(steps or [0]):.1f} steps a path, median {median(seconds):.3f} s, "
        f"largest {max(seconds):.3f} s",
        flush=True,
    )
    return verdicts["right"] == len(runs)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:20", help="first:last+1")
    parser.add_argument("--case", action="append", help="stem of a case file; all by default")
    parser.add_argument("--folder", action="append", help="folder under cases/: benchmarks")
    parser.add_argument("--start", choices=ASKED_FOR, default="auto")
    parser.add_argument("--settings", default="default")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds for one seed")
    options = parser.parse_args()
    seeds = range(*map(int, options.seeds.split(":")))
    folders = [CASES / name for name in options.folder or ["benchmarks"]]
    paths = [p for folder in folders for p in sorted(folder.glob("*.toml"))]
    if options.case:
        paths = [p for p in paths if p.stem in options.case]
    right = True
    for path in paths:
        _, known = subject(path)
        if known is None:
            continue
        tasks = [Task(path, s, options.start, options.settings, options.threads) for s in seeds]
        first = Task(CASES / "benchmarks" / "caprasse.toml", 0, "auto", "default", 1)
        runs = []
        for run in timed_runs(answer, tasks, limit=options.limit, jobs=options.jobs, first=first):
            runs.append(run)
            if verdict(run, known) != "right":
                text = run.error or (run.value.text if run.value else f"over {run.seconds:g} s")
                print(f"  seed {run.task.seed}: {verdict(run, known)}: {text}", flush=True)
        right &= report(path, runs, known)
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
