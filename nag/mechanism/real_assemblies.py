"""Whether parts that are not assembled have a real assembly: what is proved, and what was found.

A side that is longer than a way round it, over other sides, forbids real assemblies; that is exact.
For a single loop in the plane it is also the only obstacle. A side that is as long as a way round
it puts the way in line (`straight_lines`): real assemblies are those of the equations with places
in line. They are looked for by Newton's method from random real points, and where it finds none,
as at singular ones, on the components themselves if these are few and small.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import combinations
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import is_zero
from nag.algebra.polynomial import Polynomial
from nag.mechanism.assembly import AssemblyModel, Side
from nag.mechanism.dh import TableModel
from nag.mechanism.framework_model import (
    FrameworkModel,
    cartesian_model,
    model_in_line,
    space_models,
)
from nag.mechanism.straight_lines import ForcedLines, Line, find_forced_lines
from nag.numerics.double_ranks import matrix_corank
from nag.numerics.doubles import ROUGH
from nag.numerics.zero_values import ON
from nag.text.table import count_text
from nag.tracking.run import Run, Stream
from nag.witness.frame import expand_orbits
from nag.witness.gauss_newton import IterationEnd, descend, polish
from nag.witness.real_points import STARTS
from nag.witness.witness import WitnessSet

if TYPE_CHECKING:
    from nag.mechanism.problem import Problem

# Degrees of components up to which their real points are looked for where random starts lead to
# none; as many paths as that takes may take a decomposition in real coordinates.
MOST_DEGREE = 16
# Hinges from which on a loop closes in general numbers.
FEWEST_IN_GENERAL = 6


def obstacle(parts: AssemblyModel) -> str:
    """Why there is no real assembly, by exact lengths; empty if no side is too long.

    >>> import nag
    >>> obstacle(nag.read_case("cases/planar/four-bar.toml").assembly)
    ''
    """
    return _forced_lines(tuple(parts.sides)).obstacle


@lru_cache(maxsize=32)
def _forced_lines(sides: tuple[Side, ...]) -> ForcedLines:
    return find_forced_lines(sides)


def lines_of_real(problem: Problem) -> ForcedLines | None:
    """Which places are in line in every real assembly; None where that is not looked at.

    It is not of parts that are given assembled, nor where nothing but plates is in line.
    """
    parts = problem.parts
    if parts is None or parts.reference is not None:
        return None
    forced = _forced_lines(tuple(parts.sides))
    return forced if forced.lines else None


def of_real_assemblies(problem: Problem) -> Problem:
    """The problem of the real assemblies, where lengths put places in line in all of them.

    In coordinates that are real where these are, with the linear equations of places in line: real
    zeros are the same, and singular no more for the lengths' sake. The problem itself elsewhere.
    """
    from nag.mechanism.problem import in_real_coordinates, problem_of

    forced = lines_of_real(problem)
    if forced is None:
        return problem
    parts = in_real_coordinates(problem).parts
    assert parts is not None
    if isinstance(parts, FrameworkModel):
        parts = _pin_beside_lines(parts, forced.lines)
    places = parts.place_polynomials()
    rows = [f for line in forced.lines for f in _in_line(line, places) if f.terms]
    system = replace(parts.system, polynomials=(*parts.system.polynomials, *rows))
    return problem_of(replace(parts, system=system))  # type: ignore[type-var]


def _pin_beside_lines(parts: FrameworkModel, lines: Sequence[Line]) -> FrameworkModel:
    """A framework with points pinned that are not in line in all real realisations, if any are."""
    framework = parts.framework
    if framework.dimension == 3:
        beside = next(space_models(framework, lines), None)
        parts = model_in_line(framework) if beside is None else beside
    return replace(parts, smaller=None)


def _in_line(line: Line, places: Mapping[str, Sequence[Polynomial]]) -> Iterator[Polynomial]:
    """That places are where they are on a line with two of them, linear in all coordinates."""
    first, *others = line
    base = next(p for p in others if not is_zero(line[p] - line[first]))
    length = line[base] - line[first]
    for other in others:
        share = (line[other] - line[first]) / length
        for x, y, z in zip(places[first], places[base], places[other], strict=True):
            yield z - x - (y - x) * share


def no_assembly_text(problem: Problem) -> str:
    """That parts have no assembly, not even a complex one, and what to do if that is rounding.

    Args:
        problem: of the parts as they are given.
    """
    forced = lines_of_real(problem)
    if forced is not None:
        return f"it cannot be assembled: {forced.text}, and do not fit so"
    text = "it cannot be assembled, not even with complex coordinates"
    # Six conditions close a loop, so that fewer hinges close in special numbers only.
    if isinstance(problem.parts, TableModel) and len(problem.parts.loop.open) < FEWEST_IN_GENERAL:
        text += (
            "; a table of fewer than six hinges that turn rarely closes in rounded numbers: write "
            'them exactly, as a = "sqrt(2)" and alpha = "pi/6", or give the hinges in one '
            'assembly, as kind = "mechanism", and ask nag mobility with a tolerance'
        )
    return text


def tangent_dimension_at(given: Problem, parts: AssemblyModel, point: np.ndarray) -> int:
    """The dimension of first-order motions of parts, without what lengths force on real ones.

    Args:
        given: the problem of the parts, without places in line.
        parts: as `of_real_assemblies` gives them.
        point: a real assembly, or a general one of a component.
    """
    if isinstance(parts, FrameworkModel):
        return _framework_motions_at(parts, point)
    # A link is held, so that the equations' own motions are those that count.
    own = given.system
    return matrix_corank(Evaluator.of(own.polynomials, own.n).balanced_jacobian(point))


def _framework_motions_at(parts: FrameworkModel, point: np.ndarray) -> int:
    """First-order motions of the points without those of the whole, whichever are pinned."""
    names = [side.ends for side in parts.sides]
    places = parts.place_polynomials()
    where = [complex(x) for x in point]
    at = np.array([[complex(f(where)) for f in own] for own in places.values()])
    index = {name: i for i, name in enumerate(places)}
    at = at * np.sqrt([float(m) for m in parts.metric])
    d = at.shape[1]
    rows = np.zeros((len(names), at.size), dtype=complex)
    for row, (first, second) in zip(rows, names, strict=True):
        gap = at[index[first]] - at[index[second]]
        row[d * index[first] :][:d], row[d * index[second] :][:d] = gap, -gap
    turns = [np.zeros((d, d)) for _ in range(d * (d - 1) // 2)]
    for turn, (i, j) in zip(turns, combinations(range(d), 2), strict=True):
        turn[i, j], turn[j, i] = 1, -1
    shifts = [np.tile(unit, len(at)) for unit in np.eye(d)]
    motions = np.array([*shifts, *((at @ turn).ravel() for turn in turns)])
    return _corank(rows) - (at.size - _corank(motions))


def _corank(rows: np.ndarray) -> int:
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    balanced = rows / np.where(size > 0, size, 1.0)
    return matrix_corank(balanced)


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
    rng = np.random.default_rng([seed, Stream.REAL_ASSEMBLIES])
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


def count_real(problem: Problem, components: Sequence[WitnessSet]) -> tuple[int, int | None]:
    """How many assemblies finite components are, and how many of them are real.

    The latter is None where a point is known to too few digits to tell.
    """
    parts = problem.parts
    assert parts is not None
    finite = [c for c in components if c.dimension == 0]
    points = [x for c in finite for x in c.points]
    known = all(float(np.max(c.errors, initial=0.0)) < ROUGH for c in finite)
    real = sum(parts.is_real(x) for x in points) // parts.points_of_each if known else None
    return len(points) // parts.points_of_each, real


def real_text(problem: Problem, moving: Sequence[WitnessSet], run: Run) -> str:
    """What is known of the real assemblies beside that complex ones move, in one clause.

    Empty where a real one was found that moves like these, as `real_doubt` says.
    """
    forced = lines_of_real(problem)
    if forced is None or forced.obstacle:
        return real_doubt(problem, moving, run)
    real = of_real_assemblies(problem)
    found = real.decompose(run=run)
    start = f"in every real {problem.parts.solution} {forced.text}"  # type: ignore[union-attr]
    if not found.complete:
        return f"{start}; what moves there is not known: {'; '.join(found.notes)}"
    components = expand_orbits(found).components
    along = [c for c in components if c.dimension]
    if along:
        freedoms = count_text(max(c.dimension for c in along) + problem.free, "freedom")
        doubt = real_doubt(real, along, run)
        return f"{start}; so placed it moves with {freedoms}; {doubt or 'a real one was found'}"
    number, count = count_real(real, components)
    if count is None:
        return f"{start}; it does not move there, and whether any is real is not known"
    if not count:
        of = f": none of {count_text(number, 'complex one')} in line is real" if number else ""
        return f"{start}, but there is no real one{of}"
    only = count_text(count, f"real {problem.parts.solution}")  # type: ignore[union-attr]
    return f"{start}; it does not move there: {only} in all"
