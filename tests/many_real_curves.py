"""Complete real curves over many seeds, and circuits of random four-bars and six-bars.

    python tests/many_real_curves.py [SEEDS] [FOUR-BARS] [SIX-BARS]

Those of four-bars follow from Grashof's rule; those of Watt's and Stephenson's six-bars are counted
by turning the crank in small steps, with both ways to close each dyad. Of shipped mechanisms they
are known without these curves, as is said beside each.

Right, undecided and wrong ones are counted; nothing may be wrong.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import networkx
import numpy as np
from test_real_curves import CURVES, LOOP, NETWORK, POINT, counted, four_bar, grashof, real_curves

import nag
from nag.mechanism.problem import in_real_coordinates, problem_of
from nag.mechanism.real_assemblies import of_real_assemblies

CASES = Path(__file__).parents[1] / "cases"
# Where nothing is said of crossings, curves are smooth. "Traced" is: from hundreds of random real
# starts, in small steps, by a program that shares nothing with this one, in angles or pins.
MECHANISMS = {
    "bennett": {LOOP: 1},
    "planar/four-bar": {LOOP: 2},
    "planar/four-bar-folding": {NETWORK: 1},
    "planar/four-bar-rhombus": {LOOP: 3},
    "planar/slider-crank": {LOOP: 2},
    "bricard-cube": {LOOP: 1},
    "planar/watt-six-bar": {NETWORK: 2},
    # Traced; the Bennett linkages that it is made of have one circuit each.
    "spatial/goldberg-5r": {LOOP: 1},
    # Traced.
    "spatial/bricard-line-symmetric": {LOOP: 2},
    # Two slider-cranks with one slider, of cranks that turn fully: one reaches less far at both
    # ends, so that the other is bent to one side always, and the slider is on one side; traced.
    "spatial/sarrus": {LOOP: 2},
    # Traced.
    "planar/stephenson-six-bar": {LOOP: 1},
    # The triangle of crank, short side and P closes for 2/3 <= OP <= 10/3, on two arcs of P's
    # circle, and to both sides: a loop each, for the parallelogram and the contraparallelogram.
    "planar/hart-inversor": {LOOP: 4},
    # OC >= 3 by the kite and <= 3 by the crank: all of it is in line, and P turns about B and D,
    # which fall together.
    "planar/peaucellier": {LOOP: 1},
    # C moves where OC >= 5/4, B and D change sides at both ends; once with P on C.
    "planar/peaucellier-placed": {LOOP: 2},
    # Traced with the faces given that are parallelograms: with the two of sides 2 and 1 no real
    # points, with the two of other sides, or three at a corner, two loops each.
    "planar/wunderlich-12-bar": {LOOP: 20},
}


def coupler_curve(
    first: tuple[str, str], second: tuple[str, str], ground: str, point: tuple[str, str]
) -> list[str]:
    """Where a point of a four-bar's coupler gets to, as a sextic in x and y.

    Ground pins are at 0 and ``(ground, 0)``; the coupler's pins and the point are given in one
    position. Of its turn (c, s) both cranks' lengths are linear equations.
    """
    rows = []
    for (px, py), (u, v), foot in (
        (first, ("x", "y"), "0"),
        (second, (f"(x - {ground})", "y"), ground),
    ):
        m, n = f"({point[0]} - ({px}))", f"({point[1]} - ({py}))"
        length = f"(({px} - {foot})^2 + ({py})^2)"
        rows.append(
            (
                f"({u}*{m} + {v}*{n})",
                f"({v}*{m} - {u}*{n})",
                f"({u}^2 + {v}^2 + {m}^2 + {n}^2 - {length})/2",
            )
        )
    (a, b, e), (c, d, f) = rows
    return [f"({e}*{d} - {b}*{f})^2 + ({a}*{f} - {e}*{c})^2 - ({a}*{d} - {b}*{c})^2"]


# A platform between the feet of its legs, squares of whose lengths are k, l and m.
LEGS = [
    "x^2 + y^2 - {k}",
    "(x + 23/17*c - 31/11)^2 + (y + 23/17*s)^2 - {l}",
    "(x + 7/9*c - 13/12*s - 19/14)^2 + (y + 7/9*s + 13/12*c - 37/16)^2 - {m}",
    "c^2 + s^2 - 1",
]
LENGTHS = {"k": "41/13", "l": "29/10", "m": "17/6"}


def with_free_leg(free: str, **lengths: str) -> list[str]:
    """Equations of the platform of benchmarks/planar-3-rpr with two legs held."""
    return [f.format_map(LENGTHS | lengths | {free: free}) for f in LEGS]


# Points of a coupler where lines of the cranks meet draw cusps. Double points by a Groebner basis.
EQUATIONS = {
    # Grashof's rule: two circuits; the cusp is the only real double point.
    "cusp beside a loop": (
        coupler_curve(("6/5", "8/5"), ("53/26", "30/13"), "3", ("27/14", "18/7")),
        {LOOP: 1, NETWORK: 1},
    ),
    # Two circuits, and two double points with conjugate tangents.
    "cusp and isolated points": (
        coupler_curve(("3/5", "4/5"), ("67/13", "36/13"), "4", ("9", "12")),
        {LOOP: 1, NETWORK: 1, POINT: 2},
    ),
    # One circuit, a second cusp where the point passes the ground pin at 0, and a node.
    "two cusps": (
        coupler_curve(("4/5", "3/5"), ("13/10", "8/5"), "5/2", ("8/5", "6/5")),
        {NETWORK: 1},
    ),
    # Four-bars by Grashof's rule, of the legs that are held.
    "platform with leg 1 free": (with_free_leg("k"), {LOOP: 1}),
    "platform with leg 2 free": (with_free_leg("l"), {LOOP: 1}),
    "platform with leg 3 free": (with_free_leg("m"), {LOOP: 1}),
    "platform with a short leg": (with_free_leg("m", k="1/100"), {LOOP: 2}),
    # Negative only where one of the quadrics is, near (3, 0): in one region on a fine grid. Its
    # double points are (1, 1) to (-1, -1), fewer than factors over C have in common.
    "sextic with an oval": (
        ["(x^2 - 1)^2*((x - 3)^2 + y^2 - 1) + (y^2 - 1)^2*((x - 3)^2 + 2*y^2 - 1)"],
        {LOOP: 1, POINT: 4},
    ),
}


def decompose_in_reals(name: str) -> nag.Decomposition:
    """Of a case, in coordinates that are real where it is."""
    problem = problem_of(nag.read_case(CASES / f"{name}.toml"))
    return of_real_assemblies(in_real_coordinates(problem)).decompose()


# Positions of the crank at which dyads are closed.
STEPS = 60_000


def six_bar(
    lengths: list[int], extension: tuple[int, int], ground: tuple[int, int], of_coupler: bool
) -> list[str]:
    """A four-bar, and a dyad from a point of its rocker or coupler to a second ground pivot."""
    a, b, c, g, rod, arm = lengths
    (e, f), (h, k) = extension, ground
    # From where the point is drawn, in units of the link's length.
    m, n, length = ("x", "y", b) if of_coupler else (f"{g}", "0", c)
    p = f"({m} + ({e}*(u - {m}) - {f}*(v - {n}))/{length})"
    q = f"({n} + ({f}*(u - {m}) + {e}*(v - {n}))/{length})"
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


def count_circuits(
    lengths: list[int], extension: tuple[int, int], ground: tuple[int, int], of_coupler: bool
) -> int:
    """Circuits of `six_bar`, by closing its dyads at many positions of the crank."""
    a, b, c, g, rod, arm = lengths
    crank = a * np.exp(2j * np.pi * np.arange(STEPS) / STEPS)
    closes, pins = close_dyad(crank, b, np.full(STEPS, g + 0j), c)
    both = []
    for pin in pins:
        foot, length = (crank, b) if of_coupler else (g, c)
        point = foot + (pin - foot) * complex(*extension) / length
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
        curves = [nag.find_real_curve(c, seed=seed) for c in answer.components if c.dimension == 1]
        if not all(curve.complete for curve in curves):
            undecided += 1
        elif counted(curves)[0] == known:
            right += 1
    seconds = (time.perf_counter() - start) / max(1, seeds)
    wrong = seeds - right - undecided
    print(f"{name:30} right {right:3} undecided {undecided:2} wrong {wrong:2} {seconds:6.2f} s")
    return not wrong


def judge_six_bars(count: int, of_coupler: bool) -> bool:
    rng = np.random.default_rng(1)
    right = undecided = done = 0
    while done < count:
        lengths = rng.integers(10, 60, 6).tolist()
        extension, ground = (tuple(rng.integers(-40, 60, 2).tolist()) for _ in range(2))
        circuits = count_circuits(lengths, extension, ground, of_coupler)
        # Where the four-bar folds its circuits meet, which is not seen in steps.
        if not circuits or grashof(lengths[:4]) is None:
            continue
        done += 1
        curves = real_curves(nag.decompose(six_bar(lengths, extension, ground, of_coupler)), done)
        if not all(curve.complete for curve in curves):
            undecided += 1
            print("undecided", lengths, extension, ground, [curve.reason for curve in curves])
        elif counted(curves)[0] == {LOOP: circuits}:
            right += 1
        else:
            print("wrong", lengths, extension, ground, counted(curves)[0], circuits)
    kind = "Stephenson's" if of_coupler else "Watt's"
    print(f"{count} of {kind} six-bars: {right} as their dyads close, {undecided} undecided")
    return right + undecided == count


def main(seeds: int, count: int, six_bars: int) -> int:
    good = True
    for name, (equations, pieces, _, _) in CURVES.items():
        good &= judge(name, nag.decompose(equations), pieces, seeds)
    for name, pieces in MECHANISMS.items():
        good &= judge(name, decompose_in_reals(name), pieces, seeds)
    for name, (equations, pieces) in EQUATIONS.items():
        good &= judge(name, nag.decompose(equations), pieces, seeds)
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
    for of_coupler in (False, True):
        good &= judge_six_bars(six_bars, of_coupler)
    return 0 if good and right + undecided == count else 1


if __name__ == "__main__":
    sys.exit(main(*(int(a) for a in [*sys.argv[1:], *("10", "300", "60")[len(sys.argv) - 1 :]])))
