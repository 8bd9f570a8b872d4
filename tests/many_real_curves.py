"""Complete real curves over many seeds, and circuits of random four-bars by Grashof's rule.

    python tests/many_real_curves.py [SEEDS] [FOUR-BARS]

Right, undecided and wrong ones are counted; nothing may be wrong.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from test_real_curves import CURVES, LOOP, NETWORK, counted, four_bar, grashof, real_curves

import nag

CASES = Path(__file__).parents[1] / "cases"
# Pieces of all components together, as known.
MECHANISMS = {
    "bennett": {LOOP: 1},
    "planar/four-bar": {LOOP: 2},
    "planar/four-bar-folding": {NETWORK: 1},
    "planar/four-bar-rhombus": {LOOP: 3},
    "planar/slider-crank": {LOOP: 2},
    "bricard-cube": {LOOP: 1},
    "planar/watt-six-bar": {NETWORK: 2},
}


def judge(name: str, answer: nag.Decomposition, known: dict, seeds: int) -> bool:
    right = undecided = 0
    start = time.perf_counter()
    for seed in range(seeds):
        curves = real_curves(answer, seed)
        if not all(curve.complete for curve in curves):
            undecided += 1
        elif counted(curves)[0] == known:
            right += 1
    seconds = (time.perf_counter() - start) / max(1, seeds)
    wrong = seeds - right - undecided
    print(f"{name:26} right {right:3} undecided {undecided:2} wrong {wrong:2} {seconds:6.2f} s")
    return not wrong


def main(seeds: int, count: int) -> int:
    good = True
    for name, (equations, pieces, _, _) in CURVES.items():
        good &= judge(name, nag.decompose(equations), pieces, seeds)
    for name, pieces in MECHANISMS.items():
        answer = nag.decompose(nag.read_case(CASES / f"{name}.toml"))
        good &= judge(name, answer, pieces, seeds)
    rng = np.random.default_rng(0)
    right = undecided = done = 0
    while done < count:
        lengths = rng.integers(10, 100, 4).tolist()
        circuits = grashof(lengths)
        if circuits is None:
            continue
        done += 1
        curves = real_curves(four_bar(lengths), done)
        if not all(curve.complete for curve in curves):
            undecided += 1
            print("undecided", lengths, [curve.reason for curve in curves])
        elif counted(curves)[0] == {LOOP: circuits}:
            right += 1
        else:
            print("wrong", lengths, counted(curves))
    print(f"{count} four-bars: {right} as Grashof's rule says, {undecided} undecided")
    return 0 if good and right + undecided == count else 1


if __name__ == "__main__":
    sys.exit(main(*(int(a) for a in [*sys.argv[1:], "10", "300"][:2])))
