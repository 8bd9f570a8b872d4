"""Tests local dimensions in many random exact coordinates, from inaccurate points.

    python -m tests.local_dimension_changes [COUNT] [NAME ...]

COUNT changes of coordinates of each point (default 100), each from points 1e-4 to 1e-12 off. It
prints wrong and undecided answers and the processor time of each.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from local_points import ALL, Known
from singular_zeros import Zero

from nag.numerics.local_dimension import LocalDimension, local_dimension

ERRORS = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def judged(point: Known, seed: int) -> tuple[LocalDimension, float]:
    """The answer and its processor time."""
    rng, error = np.random.default_rng(seed), ERRORS[seed % len(ERRORS)]
    changed = point.changed(rng)
    at = np.array(changed.point, dtype=complex)
    beside = Zero([], at, 0).beside(error, rng)
    # It is off by that much relative to its largest coordinate: more, relative to the others.
    accuracy = error * max(1.0, float(np.abs(at).max()))
    begin = time.process_time()
    found = local_dimension(changed.system, beside, accuracy=accuracy, seed=seed)
    return found, time.process_time() - begin


def right(point: Known, found: LocalDimension) -> bool:
    """Whether an answer is true: the bounds hold the dimension, and what is decided agrees."""
    if found.tangent_dimension is None:
        return True
    agree = not found.decided or (found.multiplicity or 0) == point.multiplicity
    return (
        found.tangent_dimension == point.tangent
        and found.lower <= point.dimension <= found.upper
        and agree
    )


def main(count: int, names: list[str]) -> int:
    wrong = total = 0
    for name, point in ALL.items():
        if names and name not in names:
            continue
        seconds, undecided, false = [], [], []
        for seed in range(count):
            found, spent = judged(point, seed)
            seconds.append(spent)
            line = (seed, found.tangent_dimension, found.lower, found.upper, found.reason)
            if not right(point, found):
                false.append(line)
            elif not found.decided:
                undecided.append(line)
        wrong += len(false)
        total += count
        times = f"{1e3 * np.median(seconds):.0f} ms, at most {1e3 * max(seconds):.0f} ms"
        print(f"{name}: {len(false)} wrong, {len(undecided)} undecided; {times}", flush=True)
        for line in false + undecided:
            print("   ", *line)
    print(f"{wrong} wrong of {total}")
    return int(wrong > 0)


if __name__ == "__main__":
    arguments = sys.argv[1:]
    sys.exit(main(int(arguments[0]) if arguments else 100, arguments[1:]))
