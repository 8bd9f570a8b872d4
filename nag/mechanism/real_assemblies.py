"""Whether parts that are not assembled have a real assembly: what is proved, and what was found.

A side that is longer than a way round it, over other sides, forbids real assemblies; that is exact.
For a single loop in the plane it is also the only obstacle. Otherwise real assemblies are looked
for by Newton's method from random real points, and where it finds none, as at singular ones, on
the components themselves if these are few and small.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number, square_root
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.framework_model import FrameworkModel, cartesian_model
from nag.numerics.zero_values import ON
from nag.text.table import count_text, join_words
from nag.tracking.run import Run
from nag.witness.frame import expand_orbits
from nag.witness.gauss_newton import IterationEnd, descend, polish
from nag.witness.real_points import STARTS
from nag.witness.witness import WitnessSet

if TYPE_CHECKING:
    from nag.mechanism.problem import Problem

# Degrees of components up to which their real points are looked for where random starts lead to
# none; as many paths as that takes may take a decomposition in real coordinates.
MOST_DEGREE = 16


def obstacle(parts: AssemblyModel) -> str:
    """Why there is no real assembly, by exact lengths; empty if no side is too long.

    >>> import nag
    >>> obstacle(nag.read_case("cases/planar/four-bar.toml").assembly)
    ''
    """
    import networkx

    sides = parts.sides
    graph: networkx.Graph = networkx.Graph()
    for side in sides:
        graph.add_edge(*side.ends, side=side, length=sqrt(float(side.squared)))
    for side in sides:
        others = graph.copy()
        others.remove_edge(*side.ends)
        try:
            way = networkx.dijkstra_path(others, *side.ends, weight="length")
        except networkx.NetworkXNoPath:
            continue
        along = [others.edges[pair]["side"] for pair in pairwise(way)]
        reach: Number = sum((square_root(s.squared) for s in along), square_root(0))
        if square_root(side.squared) > reach:
            names = join_words(list(dict.fromkeys(s.name for s in along)))
            return f"{side.name} is longer than {names} together"
    return ""


def real_assemblies(parts: AssemblyModel, seed: int = 0) -> Iterator[IterationEnd]:
    """Real assemblies that may move, found by Newton's method from some random starts.

    The Jacobian's rank is not full there, as it is nowhere where assemblies move. In the variables
    of equations with real coordinates; accurate to rounding.
    """
    system, size = parts.system, 1.0
    if isinstance(parts, FrameworkModel) and parts.system.isotropic:
        system = cartesian_model(parts.framework).system
        squared = parts.framework.squared_lengths
        squares = [float(s / squared[0]) for s in squared]
        size = 1 + sqrt(max(squares))
    evaluator = Evaluator.of(system.polynomials, system.n)
    nonzero = Evaluator.of(system.nonzero, system.n)
    rng = np.random.default_rng([seed, 19])
    for _ in range(STARTS):
        near = descend(evaluator, size * rng.standard_normal(system.n))
        if near is None:
            continue
        zero = polish(evaluator, near)
        if zero.converged and zero.corank and (nonzero.residuals(zero.x[None] + 0j) > ON).all():
            yield zero


def real_doubt(problem: Problem, moving: Sequence[WitnessSet], run: Run) -> str:
    """Why it is not known that assemblies move with real coordinates, in one clause.

    Empty where a real one was found that is not singular, or from which a real curve leaves: others
    may be isolated among real ones, as a node with complex tangents is.

    Args:
        problem: of parts that are not assembled.
        moving: its components of dimension one and more.
    """
    parts = problem.parts
    assert parts is not None
    reason = obstacle(parts)
    if reason:
        return f"there is no real one, which is proved: {reason}"
    coranks = {c.corank for c in moving}
    found = False
    for zero in real_assemblies(parts):
        if zero.corank in coranks:
            return ""
        found = True
    if found:
        return "only singular real ones were found, which need not move"
    return _doubt_of_components(problem, moving, run)


def _doubt_of_components(problem: Problem, moving: Sequence[WitnessSet], run: Run) -> str:
    """The same by real points of the components, to which Newton's method does not lead."""
    from nag.mechanism.path_estimates import fewest_estimated_paths
    from nag.mechanism.problem import in_real_coordinates
    from nag.real.real_pieces import MOST_PATHS, Reality, find_real_points

    nothing = f"no real one was found from {STARTS} starting points, which proves nothing"
    real = in_real_coordinates(problem)
    if fewest_estimated_paths(real.system) > MOST_PATHS:
        return nothing
    if real is not problem:
        components = expand_orbits(real.decompose(run=run)).components
        moving = [c for c in components if c.dimension]
    if any(c.degree > MOST_DEGREE for c in moving):
        return nothing
    pieces = [find_real_points(c, run=run) for c in moving]
    if any(d > 0 for each in pieces for d in each.dimensions):
        return ""
    count = sum(each.reality is Reality.FOUND for each in pieces)
    proved = all(each.each_piece for each in pieces)
    if count and proved:
        return f"all real ones are isolated, on {count_text(count, 'component')}: they cannot move"
    if count:
        # An isolated real point of one component may lie on another one that moves.
        return (
            f"real ones were found on {count_text(count, 'component')}, isolated there; whether "
            "they move on others is not known"
        )
    return "there is no real one, by all components' real points" if proved else nothing


def real_text(problem: Problem, moving: Sequence[WitnessSet], run: Run) -> str:
    """One clause: whether there are real assemblies that move, and what that rests on."""
    return real_doubt(problem, moving, run) or "a real one was found"
