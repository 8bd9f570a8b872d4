"""Tests local dimensions at witness points of the components of cases.

    python -m tests.local_dimension_of_cases [--changes COUNT] FILE ...

It decomposes each case and prints wrong and undecided answers, and the longest processor time of
a point. With ``--changes``, points are judged in so many random exact coordinates too: so many for
each kind of component of a case (of one dimension, degree, multiplicity), its components in turn.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from local_points import plain
from singular_zeros import Zero

import nag
from nag.witness.witness import WitnessSet

# A witness point is known to so many digits, and in other coordinates to two less.
ACCURACY, CHANGED = 1e-10, 1e-8


def judged(system: nag.PolynomialSystem, component: WitnessSet) -> nag.LocalDimension:
    """At a generic point, which lies on no other component."""
    return nag.local_dimension(system, component.points[0], accuracy=ACCURACY)


def in_other_coordinates(
    system: nag.PolynomialSystem, component: WitnessSet, seed: int
) -> tuple[nag.LocalDimension, float]:
    """The answer at one of its points in random coordinates, and its processor time."""
    point = component.points[seed % len(component.points)]
    zero = Zero(list(system.polynomials), point, 0).changed(np.random.default_rng(seed))
    begin = time.process_time()
    found = nag.local_dimension(plain(zero.polynomials), zero.point, accuracy=CHANGED, seed=seed)
    return found, time.process_time() - begin


def verdict(found: nag.LocalDimension, dimension: int) -> str:
    """What is not right about an answer; empty if it is decided and true."""
    if not found.lower <= dimension <= found.upper:
        return f"WRONG {found.lower} to {found.upper}: {found.reason}"
    return "" if found.decided else f"{found.lower} to {found.upper}: {found.reason}"


def main(files: list[str], changes: int) -> int:
    wrong = undecided = total = 0
    slowest = 0.0
    for file in files:
        case = nag.read_case(file)
        system = case.system or nag.model(case.mechanism).system
        seconds, lines = [0.0], []
        components = nag.decompose(case).components
        kinds = [(c.dimension, c.degree, c.multiplicity) for c in components]
        for i, component in enumerate(components):
            begin = time.process_time()
            answers = {-1: (judged(system, component), time.process_time() - begin)}
            if any(system.polynomials):
                for seed in range(kinds[:i].count(kinds[i]), changes, kinds.count(kinds[i])):
                    answers[seed] = in_other_coordinates(system, component, seed)
            for seed, (found, spent) in answers.items():
                seconds.append(spent)
                text = verdict(found, component.dimension)
                wrong, undecided = wrong + ("WRONG" in text), undecided + bool(text)
                lines += [f"    {i + 1}, {seed}: {text}"] if text else []
        total += len(seconds) - 1
        slowest = max(slowest, *seconds)
        name = Path(file).stem
        times = f"{np.median(seconds):.2f} s, at most {max(seconds):.2f} s"
        print(f"{name}: {len(components)} components, {system.n} variables, {times}")
        print("".join(f"{line}\n" for line in lines), end="", flush=True)
    print(f"{wrong} wrong, {undecided - wrong} undecided of {total}; at most {slowest:.2f} s")
    return int(wrong > 0)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="+")
    parser.add_argument("--changes", type=int, default=0)
    given = parser.parse_args()
    sys.exit(main(given.files, given.changes))
