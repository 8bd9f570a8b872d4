"""Sets of simple isolated points, found all at once by the paths of a start system.

Equation by equation, one badly conditioned point on the way may spoil what comes after it. Where
the whole solution set is finite and reduced, solving the system as a whole is another way to it.
"""

from __future__ import annotations

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.decomposition.superset import Superset
from nag.solving.solve import solve
from nag.solving.start.target import StartError
from nag.witness.cutting import Equations
from nag.witness.fibres import Fibre, Tracker, admit
from nag.witness.witness import Decomposition, PathCounts, Status

# Solutions that are the same, found by two ways: relative distance.
SAME = 1e-8


def isolated_superset(
    system: PolynomialSystem, rng: np.random.Generator, tracker: Tracker
) -> Superset:
    """All points of a solution set, if it is finite and every one of them is simple.

    Where this is not so, or the solver has doubts, there are no points but a note that says it.
    """
    rows = np.zeros((0, 1 + system.n), dtype=complex)
    nothing = Superset({}, rows, PathCounts(), ("no finite set of simple points was found",))
    if len(system.polynomials) < system.n:
        return nothing
    seed = int(rng.integers(2**31))
    try:
        found = solve(system, seed=seed, threads=tracker.threads, settings=tracker.settings)
    except StartError:
        return nothing
    counts = PathCounts(found.paths.tracked, found.paths.failed, found.paths.at_infinity)
    simple = all(s.multiplicity == 1 for s in found.solutions)
    if not found.complete or found.positive_dimensional or not simple:
        return nothing
    fibres: list[Fibre] = []
    equations = Equations(system.polynomials, system.n)
    for s in found.solutions:
        if not admit(s.point, s.accuracy, fibres, equations, rows, rng, deflate=False):
            return nothing
    if sum(map(len, fibres)) != len(found.solutions):
        return nothing
    return Superset({0: fibres}, rows, counts, ())


def contains(answer: Decomposition, other: Decomposition) -> bool:
    """Whether all points that ``other`` is sure of are points of ``answer`` as well."""
    points = np.vstack([c.points for c in answer.components] or [np.zeros((0, answer.system.n))])
    for component in other.components:
        if component.status is Status.UNDECIDED:
            continue
        for x in component.points:
            distance = np.linalg.norm(points - x, axis=1).min(initial=np.inf)
            if distance > SAME * (1 + np.linalg.norm(x)):
                return False
    return True
