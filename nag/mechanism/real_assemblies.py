"""Whether parts that are not assembled have a real assembly: what is proved, and what was found.

A side that is longer than a way round it, over other sides, forbids real assemblies; that is exact.
For a single loop in the plane it is also the only obstacle. Otherwise real assemblies are looked
for by Newton's method from random real points; where none is found, nothing is proved.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import pairwise
from math import sqrt

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Number, square_root
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.framework_model import FrameworkModel, cartesian_model
from nag.numerics.zero_values import ON
from nag.text.table import join_words
from nag.witness.gauss_newton import IterationEnd, descend, polish
from nag.witness.real_points import STARTS


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
    if isinstance(parts, FrameworkModel) and parts.coordinates.startswith("z"):
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


def real_doubt(parts: AssemblyModel, coranks: Collection[int]) -> str:
    """Why it is not known that assemblies move with real coordinates, in one clause.

    Empty where a real one was found that is not singular: the others may be isolated among real
    ones, as a node with complex tangents is.

    Args:
        coranks: of the Jacobian at general points of the sets of assemblies that move.
    """
    reason = obstacle(parts)
    if reason:
        return f"there is no real one, which is proved: {reason}"
    found = False
    for zero in real_assemblies(parts):
        if zero.corank in coranks:
            return ""
        found = True
    if found:
        return "only singular real ones were found, which need not move"
    return f"no real one was found from {STARTS} starting points, which proves nothing"


def real_text(parts: AssemblyModel, coranks: Collection[int]) -> str:
    """One clause: whether there are real assemblies that move, and what that rests on.

    Args:
        coranks: as for `real_doubt`.
    """
    return real_doubt(parts, coranks) or "a real one was found"
