"""Complete real curves over many seeds, and circuits of random four-bars and six-bars.

    python tests/many_real_curves.py [SEEDS] [FOUR-BARS] [SIX-BARS]

Those of four-bars follow from Grashof's rule; those of Watt's six-bars are counted by turning the
crank in small steps, with both ways to close each dyad.

Right, undecided and wrong ones are counted; nothing may be wrong.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import networkx
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

# Positions of the crank at which dyads are closed.
STEPS = 60_000


def six_bar(lengths: list[int], extension: tuple[int, int], ground: tuple[int, int]) -> list[str]:
    """A four-bar, and a dyad from a point of its rocker to a second ground pivot."""
    a, b, c, g, rod, arm = lengths
    (e, f), (h, k) = extension, ground
    # The rocker's point, in units of the rocker's length.
    p = f"({g} + ({e}*(u - {g}) - {f}*v)/{c})"
    q = f"(({f}*(u - {g}) + {e}*v)/{c})"
    return [
        f"x^2 + y^2 - {a}^2",
        f"(x - u)^2 + (y - v)^2 - {b}^2",
        f"(u - {g})^2 + v^2 - {c}^2",
        f"(z - {p})^2 + (w - {q})^2 - {rod}^2",
        f"(z - {h})^2 + (w - {k})^2 - {arm}^2",
    ]


def close_dyad(
    start: np.ndarray, first: float, end: np.ndarray, second: float
) -> tuple[np.ndarray, list[np.ndarray]]:
    """Whether two bars from ``start`` and ``end`` meet, and where, on either side."""
    between = end - start
    squared = np.abs(between) ** 2
    # Ends that fall together are no place for a dyad.
    squared = np.where(squared > 0, squared, np.inf)
    along = (first**2 - second**2) / (2 * squared) + 0.5
    aside = first**2 / squared - along**2
    height = np.sqrt(np.maximum(aside, 0))
    return aside > 0, [start + between * (along + side * 1j * height) for side in (1, -1)]


def count_circuits(lengths: list[int], extension: tuple[int, int], ground: tuple[int, int]) -> int:
    """Circuits of `six_bar`, by closing its dyads at many positions of the crank."""
    a, b, c, g, rod, arm = lengths
    crank = a * np.exp(2j * np.pi * np.arange(STEPS) / STEPS)
    closes, pins = close_dyad(crank, b, np.full(STEPS, g + 0j), c)
    both = []
    for pin in pins:
        point = g + (pin - g) * complex(*extension) / c
        both.append(closes & close_dyad(point, rod, np.full(STEPS, complex(*ground)), arm)[0])
    graph = networkx.Graph()
    following = np.roll(np.arange(STEPS), -1)
    for side, real in enumerate(both):
        for i in np.flatnonzero(real):
            graph.add_nodes_from([(i, side, 0), (i, side, 1)])
        for i in np.flatnonzero(real & real[following]):
            graph.add_edges_from(((i, side, k), (following[i], side, k)) for k in (0, 1))
        # Where the second dyad is about to be stretched or folded, its two sides meet; where the
        # first one is, those of the first.
        for here, there in ((np.arange(STEPS), following), (following, np.arange(STEPS))):
            ends = real[here] & ~real[there]
            for i in here[ends & closes[there]]:
                graph.add_edge((i, side, 0), (i, side, 1))
            if side == 0:
                for i in here[ends & ~closes[there] & both[1][here]]:
                    graph.add_edges_from(((i, 0, k), (i, 1, k)) for k in (0, 1))
    return networkx.number_connected_components(graph)


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


def judge_six_bars(count: int) -> bool:
    rng = np.random.default_rng(1)
    right = undecided = done = 0
    while done < count:
        lengths = rng.integers(10, 60, 6).tolist()
        extension, ground = (tuple(rng.integers(-40, 60, 2).tolist()) for _ in range(2))
        circuits = count_circuits(lengths, extension, ground)
        if not circuits:
            continue
        done += 1
        curves = real_curves(nag.decompose(six_bar(lengths, extension, ground)), done)
        if not all(curve.complete for curve in curves):
            undecided += 1
            print("undecided", lengths, extension, ground, [curve.reason for curve in curves])
        elif counted(curves)[0] == {LOOP: circuits}:
            right += 1
        else:
            print("wrong", lengths, extension, ground, counted(curves)[0], circuits)
    print(f"{count} six-bars: {right} as their dyads close, {undecided} undecided")
    return right + undecided == count


def main(seeds: int, count: int, six_bars: int) -> int:
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
    good &= judge_six_bars(six_bars)
    return 0 if good and right + undecided == count else 1


if __name__ == "__main__":
    sys.exit(main(*(int(a) for a in [*sys.argv[1:], *("10", "300", "60")[len(sys.argv) - 1 :]])))
