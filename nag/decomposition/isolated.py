"""Finite solution sets, found all at once by the paths of a start system, and their sizes.

Equation by equation, one badly conditioned point on the way may spoil what comes after it. Where
the whole solution set is finite, solving the system as a whole is another way to it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import prod

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.exact_ranks import is_dependent
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import Completeness, judge_number, most_zeros
from nag.decomposition.final_checks import judge_components
from nag.decomposition.method import Task
from nag.decomposition.orbits import group_into_orbits
from nag.errors import StartError
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import coincident
from nag.numerics.double_ranks import corank_on_component
from nag.numerics.precise_point import precise_zero
from nag.numerics.system_facts import SystemFacts
from nag.numerics.zero_values import NONZERO, vanishes_at_point
from nag.solving.solutions import Solution, SolveResult
from nag.solving.solve import solve
from nag.tracking.run import Run
from nag.witness.cutting import dyadic
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet, even_radii

# A set whose points would take more paths is not asked first whether it is finite.
MOST_PATHS = 20_000


def is_finite(
    system: PolynomialSystem, rng: np.random.Generator, run: Run
) -> tuple[bool, PathCounts]:
    """Whether the zero set of as many equations as variables is seen to be finite, by which paths.

    A set of positive dimension meets a generic hyperplane. What all equations but one leave there
    must be finite too, and the last equation must vanish nowhere on it. What `system.nonzero`
    excludes does not count.
    """
    n, none = system.n, PathCounts()
    if n < 2 or len(system.polynomials) != n:
        return False, none
    hardest = max(range(n), key=lambda i: (system.polynomials[i].degree, -i))
    others = [f for i, f in enumerate(system.polynomials) if i != hardest]
    if prod(f.degree for f in others) > MOST_PATHS:
        return False, none
    # A generator of its own, so that what follows does not depend on this.
    if is_dependent(system.polynomials, np.random.default_rng(n)):
        return False, none
    plane = Polynomial.constant(n, Fraction(float(dyadic(rng, (1,))[0])))
    for weight, x in zip(dyadic(rng, (n,)), Polynomial.variables(n), strict=True):
        plane = plane + x * Fraction(float(weight))
    cut = PolynomialSystem(system.variables, (*others, plane), system.nonzero)
    found = _solve(SystemFacts(cut), rng, run, True)
    if found is None or found.pathless:
        return False, none
    # What failed here leaves nothing open: the set is intersected equation by equation then.
    spent = PathCounts(found.paths.tracked, 0, found.paths.at_infinity)
    last = system.polynomials[hardest]
    near = Evaluator.of([last], n).residuals(found.points)[:, 0] <= NONZERO
    met = any(_meets_last(cut, last, x) for x in found.points[near])
    if found.complete and not found.perhaps_infinite and not met:
        return True, spent
    # What paths leave open may be proved.
    return not met and most_zeros(system.polynomials) is not None, spent


def _meets_last(cut: PolynomialSystem, last: Polynomial, x: np.ndarray) -> bool:
    """Whether the last equation vanishes, or may do so, at a zero of the others on the plane."""
    *others, plane = cut.polynomials
    row = np.array([[float(plane.terms.get(e, 0)) for e in _linear(cut.n)]])
    zero = precise_zero(BallPolynomials.of(others, row), x)
    return zero is None or vanishes_at_point(last, zero) is not False


def _linear(n: int) -> list[tuple[int, ...]]:
    """The exponents of 1 and of the variables."""
    return [tuple(int(i == j) for i in range(n)) for j in range(-1, n)]


def _solve(
    facts: SystemFacts, rng: np.random.Generator, run: Run, finite: bool
) -> SolveResult | None:
    """The isolated solutions of a system; None if it has no start system."""
    own = replace(run, seed=int(rng.integers(2**31)))
    try:
        return solve(facts.system, run=own, finite=finite, facts=facts)
    except StartError:
        return None


def solve_at_once(task: Task, finite: bool = False) -> Decomposition | None:
    """The points of a solution set, if it is finite and the solver has no doubts.

    Args:
        finite: whether it is known to be, but for what `system.nonzero` excludes.
    """
    system = task.system
    if len(system.polynomials) < system.n:
        return None
    outside = finite and bool(system.nonzero)
    found = _solve(task.facts, task.rng, task.run, not outside)
    if found is None or not found.complete or (found.pathless and not finite):
        return None
    if found.positive_dimensional or (found.perhaps_infinite and not outside):
        return None
    components = _components(found, system, task.symmetries)
    paths = PathCounts(found.paths.tracked, found.paths.failed, found.paths.at_infinity)
    return judge_components(system, components, paths, task.run)


def solve_for_points(answer: Decomposition, task: Task) -> Decomposition | None:
    """The answer with all isolated points of its system, if the solver has no doubts of these.

    A start system has a path for each, whatever else there is. Intersecting with one equation after
    the other has one too, but it may begin where a curve is badly conditioned.
    """
    system = answer.system
    larger = [c for c in answer.components if c.dimension > 0]
    if len(system.polynomials) < system.n or any(c.status is Status.UNDECIDED for c in larger):
        return None
    found = _solve(task.facts, task.rng, task.run, False)
    if found is None or not found.complete:
        return None
    points = _components(found, system, task.symmetries)
    tracked = answer.paths.tracked + found.paths.tracked
    whole = replace(
        answer,
        components=(*larger, *points),
        paths=PathCounts(tracked, 0, answer.paths.at_infinity),
        complete=True,
        notes=(),
    )
    return whole if contains_points(whole, _only_points(answer)) else None


def _only_points(answer: Decomposition) -> Decomposition:
    points = tuple(c for c in answer.components if c.dimension == 0)
    return replace(answer, components=points)


def count_points(answer: Decomposition, task: Task) -> Decomposition:
    """An answer of points alone, beside the number of zeros that exact algebra knows.

    Args:
        task: of its system, and whether multiplicities are those of it.
    """
    system = answer.system
    if answer.dimension > 0 or system.nonzero or len(system.polynomials) < system.n:
        return answer
    # At points that are regular the scheme of the system is simple, whatever is asked for.
    scheme = task.scheme or all(c.corank == 0 for c in answer.components)
    zeros = sum(
        ((c.multiplicity or 0) if scheme else 1) * c.degree * c.orbit for c in answer.components
    )
    count = task.facts.count_zeros(zeros, not answer.complete)
    verdict = judge_number(zeros, count)
    if (
        count is None
        or verdict is Completeness.UNKNOWN
        or (verdict is Completeness.MISSING and not scheme)
    ):
        return answer
    if verdict is Completeness.ALL:
        decided = all(c.status is Status.IRREDUCIBLE for c in answer.components)
        return replace(answer, complete=True, notes=()) if decided else answer
    doubt = count.difference(zeros, task.sides)
    return replace(answer, complete=False, notes=(*answer.notes, doubt))


def _components(
    found: SolveResult, system: PolynomialSystem, symmetries: Sequence[SignedPermutation]
) -> list[WitnessSet]:
    evaluator = Evaluator.of(system.polynomials, system.n)
    points = [_component(s, evaluator, system) for s in found.solutions]
    return group_into_orbits(system, points, symmetries)[0] if symmetries else points


def _component(solution: Solution, evaluator: Evaluator, system: PolynomialSystem) -> WitnessSet:
    n, radii = system.n, solution.radii
    x = solution.point[None]
    return WitnessSet(
        slice=Slice(np.zeros((0, n)), np.zeros(0)),
        points=x,
        multiplicity=solution.multiplicity,
        status=Status.IRREDUCIBLE,
        residual=solution.residual,
        radii=even_radii(x, solution.accuracy) if radii is None else radii[None],
        digits=[solution.precision],
        corank=corank_on_component(evaluator, solution.point, 0, solution.multiplicity),
        multidegree=np.array(1) if system.groups else None,
    )


def contains_points(answer: Decomposition, other: Decomposition) -> bool:
    """Whether all points that ``other`` is sure of are points of ``answer`` as well."""
    points = np.vstack([c.points for c in answer.components] or [np.zeros((0, answer.system.n))])
    error = max((c.accuracy for c in answer.components), default=0.0)
    for component in other.components:
        if component.status is Status.UNDECIDED:
            continue
        for x in component.points:
            if not coincident(points, x, max(error, component.accuracy)).any():
                return False
    return True
