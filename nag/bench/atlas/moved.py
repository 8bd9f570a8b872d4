"""Cases that ship, in other coordinates: their answers must not change."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import (
    Coordinates,
    combine_equations,
    in_far_coordinates,
    sparsely_changed,
)
from nag.bench.atlas.nine_points import CARRIED, NinePoints
from nag.bench.atlas.points import KnownProblem, points
from nag.bench.verdicts import Components
from nag.files.cases import read_case
from nag.mechanism import PLATFORM_ALONE
from nag.mechanism.legs import parallel_robot
from nag.mechanism.platform import platform_model
from nag.mechanism.problem import problem_of

CASES = Path("cases")

# Cases in coordinates in which they are dense: those that take two seconds or less then.
DENSE: dict[str, tuple[str, ...]] = {
    "moved": (
        "slider-crank", "rhombus", "four-bar", "literature/whitney-umbrella",
        "literature/plane-line-point", "literature/sphere-and-cubic", "literature/cyclic-4",
        "triangle",
    ),
    "moved-papers": (
        "bennett", "bricard-cube", "planar-four-bar", "four-bar-free", "rhombus-free",
        "bennett-variety", "bricard-variety", "graph-curve",
    ),
    "moved-curves": (
        "literature/arcs", "literature/double-parabola", "literature/double-parabola-reversed",
        "literature/sphere-curve-lines-point", "literature/twisted-cubic",
        "literature/twisted-cubic-affine",
    ),
    "moved-ideals": (
        "literature/cuspidal-edge", "literature/double-plane-and-line",
        "literature/embedded-point", "literature/whitney-umbrella-singular",
        "literature/adjacent-minors-2x4", "literature/adjacent-minors-2x6",
        "literature/adjacent-minors-3x3",
    ),
    "moved-frameworks": (
        "planar/assur-triad", "planar/braced-square", "planar/henneberg-6", "planar/k33",
        "planar/peaucellier", "planar/three-prism", "planar/double-parallelogram",
    ),
    "moved-planar": (
        "planar/four-bar-folding", "planar/four-bar-kite", "planar/four-bar-parallelogram",
        "planar/four-bar-rhombus", "planar/four-bar", "planar/slider-crank-equal",
        "planar/elliptic-trammel", "planar/oldham", "planar/five-bar",
    ),
    "moved-loops": (
        "spatial/bennett-isogram-equilateral", "spatial/bennett", "spatial/goldberg-5r",
        "spatial/goldberg-5r-difference", "spatial/myard-5r", "spatial/general-6r",
        "spatial/assembled-4r", "spatial/assembled-5r",
    ),
    "moved-spatial": (
        "spatial/griffis-duffy", "spatial/octahedron", "spatial/planar-four-bar",
        "spatial/stewart-gough", "spatial/bennett-h-negative", "spatial/bennett-h-q5-zero",
        "spatial/delassus-rprp", "spatial/rssr",
    ),
    "moved-spherical": (
        "spherical/five-bar", "spherical/flat-foldable-vertex",
        "spherical/four-bar-equal-opposite", "spherical/four-bar-equal",
        "spherical/four-bar-kite", "spherical/four-bar", "spherical/hooke-joint",
        "spherical/watt-six-bar",
    ),
    "moved-shaky": (
        "shaky/four-bar-flat", "shaky/triangle-stretched", "shaky/two-bars-in-line",
        "shaky/prism-concurrent", "shaky/k33-on-conic",
    ),
    "moved-benchmarks": (
        "benchmarks/cbms1", "benchmarks/cbms2", "benchmarks/griewank-osborne",
        "benchmarks/katsura-6", "benchmarks/kss-5", "benchmarks/mth191", "benchmarks/noon-5",
        "benchmarks/planar-3-rpr",
    ),
    "moved-hard": (
        "benchmarks/stewart-gough", "benchmarks/inverse-6r", "hard/tangents1",
    ),
}  # fmt: skip


# Those that take longer, in coordinates that keep them sparse: decomposed, ..
SPARSE: dict[str, tuple[str, ...]] = {
    "sparse": (
        "gonzalez", "double-rhombus", "rhombus-chain-2", "rhombus-chain-3",
        "benchmarks/rhombus-chain-4", "literature/adjacent-minors-3x4",
        "literature/double-watt-cusp", "spherical/orthogonal-four-bar",
    ),
    "sparse-linkages": (
        "planar/burmester-focal", "planar/roberts-cognates", "planar/roberts-seven-bar",
        "planar/slider-crank", "planar/stephenson-six-bar", "planar/two-kites",
        "planar/watt-six-bar",
        "spatial/four-sliders", "spatial/rccc",
    ),
    "sparse-frameworks": (
        "planar/cube-graph", "planar/dixon-1-k33", "planar/dixon-1-k34", "planar/dixon-2-k44",
        "planar/prism-parallel", "planar/wunderlich-12-bar",
        "spatial/octahedron-line-symmetric", "spatial/octahedron-plane-symmetric",
        "spatial/octahedron-two-flat-positions",
    ),
    "sparse-loops": (
        "spatial/bricard-line-symmetric", "spatial/bricard-plane-symmetric",
        "spatial/bricard-trihedral", "spatial/bricard_cube", "spatial/general-7r",
        "spatial/schatz", "spatial/spherical-pair-6r", "spatial/sarrus", "spatial/bennett-chain-3",
        "spatial/bennett-rounded",
    ),
    "sparse-arms": (
        "spatial/puma-held", "spatial/ur5-held", "spatial/seven-joint-arm",
        "spatial/seven-joint-arm-offset",
    ),
    "sparse-walking": (
        "planar/jansen-leg", "planar/chebyshev-four-bar", "planar/lambda-linkage",
        "planar/hart-inversor", "planar/klann-leg", "planar/peaucellier-placed",
    ),
    "sparse-platforms": (
        "spatial/wren-4", "spatial/wren-5", "spatial/wren-6", "robots/hexapod-6-3",
        "robots/hexapod-6-4", "robots/hexapod-6-5", "robots/hexapod-6-6",
        "spatial/kinematotropic-7r", "spatial/rssr-zero-rod",
        "spherical/agile-eye-held",
    ),
    "sparse-bipyramids": ("spatial/bipyramid", "spatial/bipyramid-pentagon"),
    "sparse-robots": (
        "robots/3-prs", "robots/3-rps", "robots/3-rrr-planar", "robots/3-rrr-spherical",
        "robots/3-rrs", "robots/3-sps-s", "robots/3-upu-snu", "robots/3-upu-tangential",
        "robots/3-upu-tsai", "robots/3-upu-wrist", "robots/3-uu-locked", "robots/4-upu-upright",
        "robots/exechon", "robots/hexapod", "robots/quadrupteron", "robots/tricept",
        "robots/tripteron",
    ),
    "sparse-robots-with-roots": (
        "robots/3-rps-120", "robots/3-upu-snu-120", "robots/3-upu-tsai-120",
        "robots/3-upu-tsai-sevenths",
    ),
    "sparse-planar": (
        "planar/eight-bar", "planar/six-bar-placed", "planar/kinematotropic-crank",
        "planar/kinematotropic-square", "planar/four-bars-in-a-row",
    ),
    "sparse-spatial": ("spatial/sarrus-kinematotropic", "spatial/universal-shaft"),
    "sparse-large": ("benchmarks/rhombus-chain-5",),
}  # fmt: skip
# .. and solved: systems with isolated zeros.
SOLVED: dict[str, tuple[str, ...]] = {
    "solved": (
        "planar/henneberg-8", "planar/triangle-framework", "spatial/general-7r-held",
        "spherical/triangle", "benchmarks/caprasse", "benchmarks/chandra-8", "benchmarks/eco-8",
        "benchmarks/inverse-6r-clustered",
    ),
    "solved-families": (
        "benchmarks/katsura-7", "benchmarks/katsura-8", "benchmarks/katsura-9",
        "benchmarks/katsura-10", "benchmarks/katsura-11", "benchmarks/noon-6",
    ),
    "solved-cyclic": (
        "benchmarks/cyclic-5", "benchmarks/cyclic-6", "benchmarks/cyclic-7",
    ),
    "solved-hard": (
        "hard/cassou", "hard/chemequ", "hard/inverse-position", "hard/pb601", "hard/stewgou40",
        "benchmarks/reimer-5",
    ),
    "solved-polyhedral": (
        "benchmarks/chandra-11", "benchmarks/degree-60", "benchmarks/eisen-60",
        "benchmarks/heart", "benchmarks/kuramoto-6", "benchmarks/pw-1", "benchmarks/rps-10",
    ),
    "solved-large": ("benchmarks/cyclic-8",),
}  # fmt: skip
# Those that are solved by way of their family, which is changed with them.
BY_FAMILY: dict[str, tuple[str, ...]] = {"nine-point": ("benchmarks/nine-point",)}
GROUPS = DENSE | SPARSE | SOLVED | BY_FAMILY


def moved_case(name: str, rng: np.random.Generator) -> KnownProblem:
    """The system of one of `CASES` in other coordinates, its equations mixed."""
    system, truth = case_system(name)
    coordinates = Coordinates.random(system.n, rng)
    moved = [coordinates.of(f) for f in system.polynomials]
    # With more equations than unknowns, mixing would make all of them long.
    equations = combine_equations(moved, rng) if len(moved) <= system.n else tuple(moved)
    nonzero = tuple(coordinates.of(g) for g in system.nonzero)
    return KnownProblem(PolynomialSystem(system.variables, equations, nonzero), truth)


def changed_case(name: str, rng: np.random.Generator) -> KnownProblem:
    """The system of one of `CASES`, changed in one of the ways that keep it sparse."""
    system, truth = case_system(name)
    return KnownProblem(sparsely_changed(system, rng), truth)


# Of each folder those cases that are decomposed in half a second or less, in any coordinates.
ANYWHERE = tuple(
    name for group in (DENSE | SPARSE).values() for name in group if "benchmarks" not in name
)
# Unknowns beyond which a dense change leaves more terms than cases have.
MOST_DENSE = 6


def case_in_far_coordinates(knobs: tuple[str, int], rng: np.random.Generator) -> KnownProblem:
    """One of the cases, at random, in coordinates of a kind that lie far from its own ones."""
    kind, decades = knobs
    while True:
        system, truth = case_system(ANYWHERE[rng.integers(len(ANYWHERE))])
        if kind != "dense" or system.n <= MOST_DENSE:
            return KnownProblem(in_far_coordinates(system, kind, decades, rng), truth)


def nine_points_moved(name: str, rng: np.random.Generator) -> KnownProblem:
    """The nine points of a case in other places, and its family in other unknowns."""
    case = read_case(CASES / f"{name}.toml")
    assert case.family is not None
    made = NinePoints.random(case.family, rng)
    system = made.family.original.at(made.targets[0])
    truth = case_system(name)[1]
    facts = Counter({CARRIED: truth[0, 1, 1]})
    return KnownProblem(system, truth, ("family",), facts=facts, family=made)


def case_system(name: str) -> tuple[PolynomialSystem, Components]:
    """The system of a case, and what is known of it.

    For a mechanism that of the fewest paths, for a parallel robot that of its platform's poses.
    """
    case = read_case(CASES / f"{name}.toml")
    if any(item.formulation == PLATFORM_ALONE for item in case.truth):
        robot = parallel_robot(case.described)
        system = platform_model(robot, np.random.default_rng(0)).system
        formulation = PLATFORM_ALONE
    else:
        problem = problem_of(case)
        system, formulation = problem.system, problem.formulation
    truth = points()
    for item in case.truth:
        if item.formulation in (None, formulation):
            truth[item.dimension, item.degree, item.multiplicity] += item.count
    return system, truth
