"""Tests local dimensions at witness points of the components of cases.

    python -m tests.local_dimension_of_cases FILE ...

It decomposes each case and prints wrong and undecided answers, and the longest processor time of
a point.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import nag
from nag.witness.witness import WitnessSet


def judged(system: nag.PolynomialSystem, component: WitnessSet) -> nag.LocalDimension:
    """At a generic point, which lies on no other component."""
    return nag.local_dimension(system, component.points[0], accuracy=1e-10)


def main(files: list[str]) -> int:
    wrong = 0
    for file in files:
        case = nag.read_case(file)
        system = case.system or nag.model(case.mechanism).system
        seconds, lines = [0.0], []
        components = nag.decompose(case).components
        for i, component in enumerate(components):
            begin = time.process_time()
            found = judged(system, component)
            seconds.append(time.process_time() - begin)
            if found.decided and found.dimension != component.dimension:
                wrong += 1
                lines.append(f"    {i + 1}: WRONG {found.dimension}: {found.reason}")
            elif not found.decided:
                lines.append(f"    {i + 1}: {found.lower} to {found.upper}: {found.reason}")
        name = Path(file).stem
        print(f"{name}: {len(components)} components, {system.n} variables, {max(seconds):.2f} s")
        print("".join(f"{line}\n" for line in lines), end="", flush=True)
    print(f"{wrong} wrong")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
