"""The atlas: each family, its knob, and the values of it that are run."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.bench.atlas import curves, linkages, points
from nag.bench.atlas.moved import (
    BY_FAMILY,
    DENSE,
    SOLVED,
    SPARSE,
    case_in_far_coordinates,
    changed_case,
    moved_case,
    nine_points_moved,
)
from nag.bench.atlas.points import KnownProblem

Make = Callable[[Any, np.random.Generator], KnownProblem]

# Families of systems that take some ten seconds, or half a minute, and seeds of the latter.
PATIENCE = {"solved-hard": 4, "sparse-large": 12, "solved-large": 12, "nine-point": 6}
SEEDS = {"sparse-large": 4, "solved-large": 4, "nine-point": 4}
DIGITS = (2, 4, 8, 12, 16, 20, 30)
# Coordinates in which cases are decomposed, far from their own ones.
FAR_COORDINATES = {
    "translated": "cases, every variable translated by 10^k",
    "third": "cases, a third of the variables translated by 10^k",
    "one": "cases, one variable translated by 10^k",
    "scaled": "cases, each variable scaled by another power of ten, to 10^k",
    "dense": "cases of few variables in dense linear forms of condition 10^k",
}


@dataclass(frozen=True)
class KnobFamily:
    """Systems with a knob.

    Attributes:
        name: short, for options and files; text: what it is; knob: what the values are.
        make: the system for a value of the knob; random numbers choose its coordinates.
        values: easy ones first.
        patience: how many times the usual limit of processor time an answer has.
        seeds: the most that are run; None for as many as are asked for.
        method: what is asked for: ``"solve"``, ``"decompose"``, ``"singular"``, ``"slice"`` or
            ``"family"``.
    """

    name: str
    text: str
    knob: str
    make: Make
    values: tuple[Any, ...]
    method: str = "solve"
    patience: int = 1
    seeds: int | None = None


def _two(make: Make, *first: Any) -> Make:
    """A family of several knobs as one of its last."""
    return lambda value, rng: make((*first, value), rng)


def _sized(k: int, rng: np.random.Generator) -> KnownProblem:
    """Three values of each of two variables, of sizes 10^-k and 10^k."""
    return points.grid((-k, k), rng)


def _plain_polynomial(k: int, rng: np.random.Generator) -> KnownProblem:
    """A polynomial with random integer coefficients, and its value at each zero."""
    x, y = Polynomial.variables(2)
    terms = {(j, 0): int(rng.integers(1, 10)) * (-1) ** int(rng.integers(2)) for j in range(k + 1)}
    return KnownProblem(points.plain(Polynomial(2, terms), y - x**2 - 1), points.points((1, k)))


def _cases(
    groups: Mapping[str, tuple[str, ...]], how: str, make: Make, method: str
) -> Iterator[KnobFamily]:
    """Families of cases that ship."""
    for name, cases in groups.items():
        _, dash, kind = name.partition("-")
        text = f"cases {how}" + (f": {kind}" if dash else "")
        patience, seeds = PATIENCE.get(name, 1), SEEDS.get(name)
        yield KnobFamily(name, text, "case", make, cases, method, patience, seeds)


FAMILIES: tuple[KnobFamily, ...] = (
    KnobFamily(
        "cluster-2", "pairs of zeros close together, two unknowns", "digits of the distance",
        _two(points.cluster, 2, 2), DIGITS,
    ),
    KnobFamily(
        "cluster-3", "pairs of zeros close together, three unknowns", "digits of the distance",
        _two(points.cluster, 3, 2), DIGITS,
    ),
    KnobFamily(
        "triple", "triples of zeros close together, three unknowns", "digits of the distance",
        _two(points.cluster, 3, 3), DIGITS,
    ),
    KnobFamily(
        "multiplicity", "the power of a line meets a circle", "multiplicity",
        points.power_on_circle, (2, 3, 4, 6, 8, 12, 16),
    ),
    KnobFamily(
        "osculating", "curves that touch, in other coordinates", "order of contact",
        points.osculating, (2, 3, 4, 6, 8, 10, 12),
    ),
    KnobFamily(
        "wilkinson", "(x - 1) ... (x - k)", "degree", points.factors, (5, 10, 15, 20, 25, 30),
    ),
    KnobFamily("unity", "x^k = 1", "degree", points.unity, (2, 10, 20, 30, 40, 60)),
    KnobFamily(
        "polynomial", "a random polynomial in one unknown", "degree",
        _plain_polynomial, (2, 10, 20, 30, 40, 60),
    ),
    KnobFamily(
        "infinity", "curves that touch at infinity", "degree", points.to_infinity,
        (2, 3, 4, 5, 6, 8),
    ),
    KnobFamily(
        "far", "10^-k x^4 + x - 1, two coupled unknowns", "k", _two(points.far, 2),
        (2, 4, 8, 12, 16, 20, 30),
    ),
    KnobFamily(
        "far-beside", "zeros of size one, others far out", "k", points.far_beside,
        (2, 4, 8, 12, 16, 20, 30),
    ),
    KnobFamily(
        "far-cluster", "pairs of zeros close together at 10^9", "digits of the distance",
        _two(points.far_cluster, 2, 9), DIGITS,
    ),
    KnobFamily(
        "rounded", "coefficients rounded, so that double zeros split", "digits kept",
        points.rounded, (4, 8, 14, 20, 30, 40),
    ),
    KnobFamily(
        "tangent", "a line that nearly touches a circle", "digits of the distance",
        points.nearly_tangent, DIGITS,
    ),
    KnobFamily(
        "tangent-slice", "a curve, and a plane that nearly touches it", "digits; 0 it does",
        curves.tangent_slice, (0, *DIGITS), "slice",
    ),
    KnobFamily(
        "dependent", "conics with the same directions to k digits", "digits",
        _two(points.nearly_dependent, 1), DIGITS,
    ),
    KnobFamily(
        "sizes", "unknowns of the sizes 10^-k and 10^k", "k", _sized, (0, 2, 4, 6, 8, 10, 12),
    ),
    KnobFamily(
        "hyperbola", "a hyperbola near two lines", "digits of the distance",
        curves.hyperbola, DIGITS, "decompose",
    ),
    KnobFamily(
        "cubic", "a cubic near a circle and a line", "digits of the distance",
        curves.nearly_circle_and_line, DIGITS, "decompose",
    ),
    KnobFamily(
        "skew", "skew lines close together", "digits of the distance",
        curves.close_skew_lines, DIGITS, "decompose",
    ),
    KnobFamily(
        "circles", "concentric circles close together", "digits of the distance",
        curves.close_circles, DIGITS, "decompose",
    ),
    KnobFamily(
        "touching", "circles that nearly touch", "digits of the distance",
        curves.touching_circles, (1, 2, 4, 6, 8, 12, 20), "decompose",
    ),
    KnobFamily(
        "in-space", "a hyperbola near two lines, and a line", "digits of the distance",
        curves.nearly_lines_in_space, DIGITS, "decompose",
    ),
    KnobFamily(
        "bennett", "Bennett's condition violated: mobility 1, then 0", "digits; 0 as it should be",
        linkages.bennett_violated, (0, 2, 6, 10, 15, 20, 30), "decompose",
    ),
    KnobFamily(
        "bricard", "Bricard's cube violated: mobility 1, then 0", "digits; 0 as it should be",
        linkages.bricard_violated, (0, 2, 4, 6, 8, 12, 20, 30), "decompose",
    ),
    KnobFamily(
        "kite", "a kite near a rhombus", "digits of the difference; 0 the rhombus",
        linkages.kite, (0, 2, 4, 8, 12, 20, 30), "decompose",
    ),
    KnobFamily(
        "slider-crank", "slider cranks near singular ones: two nodes, then none",
        "digits; 0 as it should be",
        linkages.slider_crank, (0, 2, 4, 8, 12, 20, 30), "singular",
    ),
    KnobFamily(
        "size", "Bennett's mechanism 10^k times as large", "k",
        linkages.bennett_scaled, (-8, -4, 0, 4, 8), "decompose",
    ),
    KnobFamily(
        "lengths", "a parallelogram's lengths at 10^k", "k",
        linkages.parallelogram, (1, 2, 4, 6, 8, -2, -4, -8), "decompose",
    ),
    *(
        KnobFamily(
            f"far-{kind}", text, "decades", _two(case_in_far_coordinates, kind),
            tuple(range(0, 7)), "decompose", 2,
        )
        for kind, text in FAR_COORDINATES.items()
    ),
    KnobFamily(
        "sheets-apart", "two surfaces far apart cut by one", "decades of the distance",
        curves.sheets_apart, tuple(range(0, 7)), "decompose",
    ),
    *_cases(DENSE, "in other coordinates", moved_case, "decompose"),
    *_cases(SPARSE, "changed, still sparse", changed_case, "decompose"),
    *_cases(SOLVED, "changed, solved", changed_case, "solve"),
    KnobFamily(
        "nine-point", "four-bars through nine points, the points and the family changed", "case",
        nine_points_moved, BY_FAMILY["nine-point"], "family", PATIENCE["nine-point"],
        SEEDS["nine-point"],
    ),
)  # fmt: skip
