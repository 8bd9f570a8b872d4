"""Solve and decompose families of hard systems, whose zero sets are known exactly.

    python tests/hard_families.py [--family NAME ...] [--value VALUE ...] [--seeds 0:3]
        [--method solve|decompose] [--limit SECONDS] [--jobs J] [--settings NAME] [--verify]

Prints one line a family and method: answers that are right, incomplete, slow (ended at the limit
of processor time) or wrong (called complete and not so), and the median and largest processor
time; above it a line for each answer that is not right. `--list` lists families and values;
`--verify` also computes the zero sets exactly and compares them. Exit status 1 if an answer is
wrong or an error.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from exact_counts import zero_set

from nag.bench.atlas import curves, points
from nag.bench.atlas.points import KnownProblem
from nag.bench.timed_runs import TimedRun, timed_runs
from nag.bench.verdicts import (
    METHODS,
    Answer,
    ZeroSet,
    compute_answer,
    describe_run,
    summary,
    verdict,
)

FAMILIES = points.FAMILIES | curves.FAMILIES


@dataclass(frozen=True)
class Task:
    """A member of a family, a method and a seed, of the system's random parts as well."""

    family: str
    value: Any
    seed: int
    method: str
    settings: str = "default"

    @property
    def problem(self) -> KnownProblem:
        return FAMILIES[self.family][0](self.value, np.random.default_rng([self.seed, 20]))

    @property
    def name(self) -> str:
        return f"{self.family} {self.value} seed {self.seed} {self.method}".replace(",", "")


def answer(task: Task) -> Answer:
    """Solve or decompose one."""
    problem = task.problem
    return compute_answer(task.method, problem.system, task.seed, task.settings, problem.symmetries)


def tasks(options: argparse.Namespace) -> Iterator[Task]:
    seeds = range(*map(int, options.seeds.split(":")))
    for family in options.family or FAMILIES:
        make, values = FAMILIES[family]
        for method in [options.method] if options.method else METHODS:
            for value in values:
                if options.value and str(value).replace(" ", "") not in options.value:
                    continue
                if method not in make(value, np.random.default_rng(0)).methods:
                    continue
                yield from (Task(family, value, s, method, options.settings) for s in seeds)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--family", action="append", choices=list(FAMILIES))
    parser.add_argument("--value", action="append", help="like 12 or (2,3,8); all by default")
    parser.add_argument("--seeds", default="0:3", help="first:last+1")
    parser.add_argument("--method", choices=METHODS)
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for one answer")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--settings", default="default")
    parser.add_argument("--list", action="store_true", help="list families and values")
    parser.add_argument("--verify", action="store_true", help="check what is known exactly")
    return parser.parse_args()


def verified(task: Task) -> bool:
    """Whether exact counts agree with the family, as far as there are any."""
    computed = zero_set(task.problem.system)
    if computed is not None and not computed.agrees(task.problem.truth):
        print(f"  {task.name}: the exact zero set is {computed}", flush=True)
        return False
    return True


def main() -> int:
    options = arguments()
    if options.list:
        for name, (make, values) in FAMILIES.items():
            print(f"{name}: {make.__doc__.splitlines()[0]} {', '.join(map(str, values))}")
        return 0
    every = list(tasks(options))
    if options.verify and sum(not verified(task) for task in every):
        return 1
    results: dict[tuple[str, str], list[tuple[str, float]]] = {}
    first = Task("given", 1, 0, "decompose")
    groups = Counter((task.family, task.method) for task in every)
    for run in timed_runs(answer, every, limit=options.limit, jobs=options.jobs, first=first):
        record(run, results, groups)
    everything = [pair for pairs in results.values() for pair in pairs]
    if everything:
        counts = Counter(v for v, _ in everything)
        print(f"total of {len(everything)}: {summary(counts, [s for _, s in everything])}")
    return 1 if any(v in ("wrong", "error") for v, _ in everything) else 0


def record(
    run: TimedRun,
    results: dict[tuple[str, str], list[tuple[str, float]]],
    groups: Counter[tuple[str, str]],
) -> None:
    """Print what is not right, and a family's line when it is done."""
    task, truth = run.task, ZeroSet.of(run.task.problem.truth)
    found = verdict(run, truth)
    if found != "right":
        print(f"  {task.name}: {found}: {describe_run(run, truth)}", flush=True)
    key = (task.family, task.method)
    results.setdefault(key, []).append((found, run.seconds))
    if len(results[key]) == groups[key]:
        counts = Counter(v for v, _ in results[key])
        seconds = [s for _, s in results[key]]
        print(f"{task.family}, {task.method}: {summary(counts, seconds)}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
