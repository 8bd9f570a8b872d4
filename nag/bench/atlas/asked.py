"""What families ask for: zeros, components, singular points, points on a slice, by a family."""

from __future__ import annotations

from collections import Counter

import numpy as np

from nag.bench.atlas.nine_points import CARRIED
from nag.bench.atlas.points import KnownProblem
from nag.bench.reference import Reference, ReferenceError
from nag.bench.verdicts import Answer, Components, compute_answer
from nag.decomposition.decompose import decompose
from nag.decomposition.singular_points import SingularSet, singular_locus
from nag.solving.parameter import solve_generic, solve_targets
from nag.witness.moving import SliceError, witness_at
from nag.witness.witness import Decomposition

# Facts that are counted.
SINGULAR = "singular point of local dimension {}, tangent dimension {}, multiplicity {}"
MET = "simple point on the slice, where its radii say"
ELSEWHERE = "point on the slice, not where its radii say"
NOT_SIMPLE = "slice that is refused"


def ask_method(method: str, problem: KnownProblem, seed: int, settings: str) -> Answer:
    """The answer of ``"solve"``, ``"decompose"``, ``"singular"``, ``"slice"`` or ``"family"``."""
    if method == "family":
        return _of_family(problem, seed, settings)
    if method in ("singular", "slice"):
        whole = decompose(problem.system, seed=seed, settings=settings)
        ask = _singular if method == "singular" else _on_slice
        return ask(problem, whole, seed, settings)
    return compute_answer(method, problem.system, seed, settings, problem.symmetries)


def _components(whole: Decomposition) -> Components:
    found: Components = Counter()
    for c in whole.components:
        found[c.dimension, c.degree, c.multiplicity or 0] += c.orbit
    return found


def _singular(problem: KnownProblem, whole: Decomposition, seed: int, settings: str) -> Answer:
    """The components, and their singular points."""
    locus = singular_locus(whole, seed=seed, settings=settings)
    facts: Counter[str] = Counter()
    for one in locus.sets:
        facts[_singular_text(one)] += one.degree
    complete = whole.complete and locus.complete
    notes = "; ".join([*whole.notes, *locus.notes])
    return Answer("singular", _components(whole), complete, notes, facts)


def _singular_text(one: SingularSet) -> str:
    local, multiplicities = one.local, sorted(m or 0 for m in one.multiplicities.values())
    text = SINGULAR.format(local.dimension, local.tangent_dimension, *multiplicities)
    if one.dimension or len(multiplicities) > 1:
        text += f", {one.dimension} {multiplicities}"
    return text


def _on_slice(problem: KnownProblem, whole: Decomposition, seed: int, settings: str) -> Answer:
    """The components, and where that of the largest degree meets the slice of the problem.

    Each point is compared with the zero that is proved next to it; a slice that is refused leaves
    the question open, except where it does touch.
    """
    facts: Counter[str] = Counter()
    complete, notes = whole.complete, "; ".join(whole.notes)
    component = max(whole.components, key=lambda c: c.degree)
    assert problem.slice is not None
    try:
        found = witness_at(problem.system, component, problem.slice, seed=seed, settings=settings)
        reference = Reference.of(problem.system, found.points, found.slice.rows)
    except SliceError as error:
        facts[NOT_SIMPLE] += 1
        complete &= NOT_SIMPLE in problem.facts
        notes += str(error)
    except ReferenceError as error:
        facts[str(error)] += 1
    else:
        off = np.abs((found.points - reference.high) - reference.low)
        for inside in (off <= found.radii).all(axis=1):
            facts[MET if inside else ELSEWHERE] += 1
    return Answer("slice", _components(whole), complete, notes, facts)


def _of_family(problem: KnownProblem, seed: int, settings: str) -> Answer:
    """The zeros for moved points, and how many of the case's they are carried to.

    The family is solved once for random parameters, and from there for both.
    """
    points, common = problem.family, {"seed": seed, "settings": settings}
    assert points is not None
    count = points.case.solutions
    solved = solve_generic(points.family, start="parameter", count=count, **common)
    moved, unmoved = solve_targets(solved, points.targets, **common)
    found: Components = Counter((0, 1, s.multiplicity) for s in moved.solutions)
    facts = Counter({CARRIED: points.carried(moved, unmoved)})
    complete = moved.complete and unmoved.complete
    notes = "; ".join([*moved.notes, *unmoved.notes])
    return Answer("family", found, complete, f"{moved.paths} {notes}", facts)
