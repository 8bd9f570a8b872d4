"""Solve Alt's problem for many seeds and random nine points, and count what is missing.

    python tests/nine_point.py [--seeds 0:3] [--targets 5] [--threads 2]

For each seed the family of `cases/benchmarks/nine-point.toml` is solved for random parameters, and
then for random rational nine points. Prints times and counts; exit status 1 if not all 1442 classes
of six are found and confirmed each time.
"""

from __future__ import annotations

import argparse
import sys
import time
from fractions import Fraction
from pathlib import Path

import numpy as np

from nag.files.cases import read_case
from nag.solving.parameter import Solved, solve_generic, solve_targets

CASE = Path(__file__).resolve().parent.parent / "cases" / "benchmarks" / "nine-point.toml"
CLASSES, ORDER = 1442, 6


def random_points(rng: np.random.Generator) -> list[Fraction]:
    """Displacements of eight random points of a square from a ninth; first coordinates first."""
    points = rng.integers(-1000, 1001, size=(9, 2))
    moved = (points[1:] - points[0]).T.ravel()
    return [Fraction(int(v), 1000) for v in moved]


def first_time(seed: int, threads: int) -> tuple[Solved, bool]:
    """The family solved for random parameters, and whether all classes were found."""
    family = read_case(CASE).family
    wall, processor = time.perf_counter(), time.process_time()
    solved = solve_generic(
        family.symmetric,
        start="parameter",
        count=family.solutions,
        seed=seed,
        threads=threads,
    )
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    classes = solved.classes.members.shape[1]
    print(f"seed {seed}: {classes} classes, {wall:.1f} s, {processor:.1f} s of processor time")
    print(f"  {solved.detail}", flush=True)
    return solved, solved.complete and classes == CLASSES


def one_target(solved: Solved, seed: int, number: int, threads: int) -> tuple[float, bool]:
    """Seconds for random nine points, and whether all solutions were found and confirmed."""
    target = random_points(np.random.default_rng([seed, number, 9]))
    wall, processor = time.perf_counter(), time.process_time()
    (result,) = solve_targets(solved, [target], seed=seed, threads=threads)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    print(
        f"  points {number}: {result.paths.regular} classes, {len(result.solutions)} solutions, "
        f"{len(result.real)} real, {wall:.2f} s, {processor:.2f} s of processor time, "
        f"{result.paths.tracked} paths, {result.paths.steps} steps; {'; '.join(result.notes)}",
        flush=True,
    )
    return wall, result.complete and len(result.solutions) == CLASSES * ORDER


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:3", help="first:last+1")
    parser.add_argument("--targets", type=int, default=5, help="sets of nine points for each seed")
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    wrong, seconds = 0, []
    for seed in range(*map(int, options.seeds.split(":"))):
        solved, right = first_time(seed, options.threads)
        wrong += not right
        for number in range(options.targets):
            wall, right = one_target(solved, seed, number, options.threads)
            seconds.append(wall)
            wrong += not right
    if seconds:
        print(f"{len(seconds)} sets of points: median {np.median(seconds):.2f} s")
    print(f"{wrong} not all 1442 classes")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
