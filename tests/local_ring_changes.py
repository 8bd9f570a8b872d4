"""Judges singular zeros in many random exact coordinates, from inaccurate points.

    python -m tests.local_ring_changes [COUNT] [NAME ...]

COUNT changes of coordinates of each zero (default 100), each from points 1e-4 to 1e-12 off. It
prints wrong and undecided answers and the processor time of each.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from singular_zeros import ISOLATED, ON_COMPONENTS

from nag.numerics.singular_point import Place, analyse

ERRORS = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def main(count: int, names: list[str]) -> int:
    wrong = 0
    for name, zero in (ISOLATED | ON_COMPONENTS).items():
        if names and name not in names:
            continue
        seconds, undecided, false = [], [], []
        for seed in range(count):
            rng = np.random.default_rng(seed)
            changed, error = zero.changed(rng), ERRORS[seed % len(ERRORS)]
            x = changed.beside(error, rng)
            begin = time.process_time()
            end = analyse(changed.polynomials, x, error, rng)
            seconds.append(time.process_time() - begin)
            known = Place.ISOLATED if zero.multiplicity else Place.ON_COMPONENT
            if end.place is Place.UNDECIDED:
                undecided.append((seed, end.reason))
            elif (end.place, end.multiplicity) != (known, zero.multiplicity):
                false.append((seed, end.place.name, end.multiplicity, end.reason))
        wrong += len(false)
        times = f"{1e3 * np.median(seconds):.1f} ms, at most {1e3 * max(seconds):.1f} ms"
        print(f"{name}: {len(false)} wrong, {len(undecided)} undecided; {times}", flush=True)
        for line in false + undecided:
            print("   ", *line)
    return int(wrong > 0)


if __name__ == "__main__":
    arguments = sys.argv[1:]
    sys.exit(main(int(arguments[0]) if arguments else 100, arguments[1:]))
