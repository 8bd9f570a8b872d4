"""Parameter homotopies: a family solved once for random parameters, then for many given ones.

Reference: Morgan & Sommese, Coefficient-parameter polynomial continuation, 1989.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from nag.algebra.family import Family
from nag.algebra.given import check_whole
from nag.algebra.imaginary_unit import append_unit, as_real, has_unit
from nag.algebra.number import ComplexNumber, Number
from nag.algebra.rational_map import MapError
from nag.algebra.symmetric_family import FamilyMember, SymmetricFamily
from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import Completeness, judge_number
from nag.errors import StartError
from nag.numerics.read_only import FixedArrays, equal_values
from nag.numerics.system_facts import SystemFacts
from nag.solving.certificate import bound_of_zeros
from nag.solving.parameter_line import parameter_line
from nag.solving.path_search import PathSearch, SolveTask
from nag.solving.solutions import SolveResult
from nag.solving.solve import leave_out_conjugate, solve, solve_without_paths
from nag.solving.solve_classes import (
    SolvedClasses,
    line_of_classes,
    solve_classes,
    solve_random_member,
)
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import choose
from nag.solving.start.family_monodromy import random_values
from nag.solving.start.target import StartSystem, Target
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import PathStatus
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.tracking.settings import Settings
from nag.tracking.track import track

__all__ = ["Family", "Solved", "solve_generic", "solve_member", "solve_targets"]

# The stream of random numbers of the member whose zeros are counted, and its largest parameter.
COUNTED, LARGEST_VALUE = 1 << 32, 1000
# That of the rational member that is solved, and the denominator of its parameters.
RATIONAL, GRID = (1 << 32) + 1, 1 << 20


@dataclass(frozen=True, eq=False)
class Solved(FixedArrays):
    """A family solved for random parameters: what `solve_targets` starts from.

    Attributes:
        values: the parameters, complex, shape ``(k,)``.
        points: the isolated solutions there, shape ``(P, n)``.
        complete: whether these are all: all paths to them arrived, at regular solutions, or loops
            find no more of them than the number that is known.
        detail: how they were found.
        classes: one solution of each class, where only these are followed.
        notes: what is to be said of a number of solutions that is given.
        positive_dimensional: whether there is a solution set of positive dimension besides, as far
            as it was met.
    """

    family: Family
    values: np.ndarray
    points: np.ndarray
    complete: bool
    detail: str = ""
    classes: SolvedClasses | None = None
    notes: tuple[str, ...] = ()
    positive_dimensional: bool = False

    __eq__ = equal_values


@takes_run
def solve_generic(
    family: Family | SymmetricFamily,
    *,
    start: str = "auto",
    count: int | None = None,
    run: Run = DEFAULT_RUN,
) -> Solved:
    """Solve a family for random complex parameters.

    Args:
        family: what to solve; of a symmetric one, one solution of each class is followed, now and
            in `solve_targets`.
        start: a start system as for `nag.solving.solve.solve`, or ``"parameter"``: from one
            solution, which Newton's method finds together with its parameters, by loops of the
            family's own parameters. That takes a few paths for each solution there is, and is what
            ``"auto"`` means for a symmetric family.
        count: with ``"parameter"``, the known number of solutions; without it an answer is not
            called complete, as loops prove nothing. Algebra is asked what it says of that number.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        NagError: if ``count`` is no number of solutions.
        StartError: if there would be too many paths, or loops have nothing to begin with.
        nag.algebra.rational_map.MapError: if the symmetries do not fit the family.
    """
    check_count(count)
    rng = run.random()
    given = family if isinstance(family, SymmetricFamily) else SymmetricFamily(family)
    family = given.original
    if start == "parameter" or (start == "auto" and len(given) > 1):
        classes = solve_random_member(given, count, rng, run.threads, run.progress)
        solved = Solved(
            family,
            given.outer_values(classes.values),
            given.outer(classes.members.reshape(-1, family.n)),
            classes.complete,
            classes.detail,
            classes,
        )
        return compare_with_count(solved, count, run)
    values = random_values(family, rng)
    target = Target(family.n, family.terms([complex(v) for v in values]))
    if not all(target.rows):
        # An equation that vanishes leaves infinitely many solutions, and no start system has these.
        return _solve_from_rational(family, values, start, run)
    begin, _ = choose(target, start, (), rng, run.threads)
    paths = track(begin.homotopy, begin.points, run.settings, run.threads)
    points = begin.affine(paths.points[paths.where(PathStatus.REGULAR)])
    points = points[has_unit(points)] if family.imaginary else points
    if begin.complete and not len(paths.where(PathStatus.FAILED, PathStatus.SINGULAR)):
        return Solved(family, values, points, True)
    return _solve_from_rational(family, values, start, run)


def _solve_from_rational(family: Family, values: np.ndarray, start: str, run: Run) -> Solved:
    """The family at random parameters, by paths from a random rational member.

    That is solved with all that `nag.solving.solve.solve` knows of rational systems; where every
    member has infinitely many solutions, paths alone do not tell how many are isolated.
    """
    rng = run.random(RATIONAL)
    # No small numbers, at which members would be special ones.
    odd = 2 * rng.integers(GRID // 4, 3 * GRID // 4, len(values)) + 1
    here = [Fraction(v, GRID) for v in (odd * rng.choice([-1, 1], len(values))).tolist()]
    result = solve(family.at(here), start=start, run=run.without_found)
    simple = [each.point for each in result.solutions if each.multiplicity == 1]
    points = np.array(simple, dtype=np.complex128).reshape(len(simple), family.n)
    ends = move_regular(family, np.array([complex(v) for v in here]), points, values, run)
    complete = result.complete and len(ends) == len(result.solutions)
    infinite = result.positive_dimensional
    return Solved(family, values, ends, complete, positive_dimensional=infinite)


def move_regular(
    family: Family, here: np.ndarray, points: np.ndarray, there: np.ndarray, run: Run
) -> np.ndarray:
    """Regular solutions at given parameters, by paths from those at others, shape ``(S, n)``."""
    line = parameter_line(family, here, there)
    paths = track(line.homotopy, line.starts(points), run.settings, run.threads)
    return line.affine(paths.points[paths.where(PathStatus.REGULAR)])


@takes_run
def solve_targets(
    solved: Solved,
    targets: Sequence[Sequence[Number | ComplexNumber]],
    *,
    run: Run = DEFAULT_RUN,
) -> list[SolveResult]:
    """Solve a family for each of the given exact parameters, by as many paths as it has solutions.

    Raises:
        StartError: if a target has a wrong number of parameters.
    """
    results = []
    for number, values in enumerate(targets):
        k = len(solved.family.parameters)
        if len(values) != k:
            raise StartError(f"target {number + 1}: {len(values)} values for {k} parameters")
        is_complex = any(isinstance(v, ComplexNumber) for v in values)
        if solved.classes is not None and not solved.family.imaginary and not is_complex:
            rng = run.random(number)
            given = (solved.classes, values, rng, run)
            results.append(solve_classes(*given))
            continue
        whole = _with_unit(solved) if is_complex else solved
        begin = _start(whole, values)
        paths = track(begin.homotopy, begin.points, run.settings, run.threads)
        detail = solved.detail or f"{len(begin.points)} solutions for random parameters"
        reason = f"parameter homotopy: {detail}"
        system = whole.family.at(values)
        task = SolveTask(SystemFacts(system), "auto", run)
        problem = SquareProblem.as_given(task.system)
        search = PathSearch.of(task, problem, begin, reason, paths, run.random(number))
        result = search.result()
        results.append(leave_out_conjugate(result, system) if system.imaginary else result)
    return [replace(result, method="by_family") for result in results]


def _with_unit(solved: Solved) -> Solved:
    """The same with the imaginary unit as an unknown, in which complex parameters are exact."""
    if solved.family.imaginary:
        return solved
    points = append_unit(solved.points)
    return replace(solved, family=solved.family.with_unit(), points=points)


@takes_run
def solve_member(
    system: PolynomialSystem,
    member: FamilyMember,
    *,
    exact_first: bool = True,
    run: Run = DEFAULT_RUN,
) -> SolveResult:
    """All isolated solutions of one member of a family, by way of random parameters.

    What exact algebra decides needs neither paths nor the family, as in `nag.solving.solve.solve`.

    Args:
        system: what to solve.
        member: which one of which family it is. Where no number of solutions is known, an answer
            is complete only if exact algebra gives it.
        exact_first: whether exact algebra is asked before paths are tracked.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        StartError: if loops have nothing to begin with, there would be too many paths, or the
            symmetries do not fit the family.
    """
    task = SolveTask(SystemFacts(as_real(system)), "auto", run, sides=1 + system.imaginary)
    exact = solve_without_paths(task) if exact_first else None
    if exact is not None:
        return leave_out_conjugate(exact, system) if system.imaginary else exact
    try:
        generic = solve_generic(
            member.symmetric,
            start="parameter",
            count=member.solutions,
            run=run,
        )
    except MapError as error:
        raise StartError(f"[family]: {error}") from None
    (result,) = solve_targets(generic, [member.values], run=run)
    return replace(result, system=system, notes=(*result.notes, *generic.notes))


def check_count(count: int | None) -> None:
    """Make sure that a number of solutions, if one is given, is a whole number from 1 up.

    Raises:
        NagError: if it is not.
    """
    if count is not None:
        check_whole(count, "count", 1)


def compare_with_count(solved: Solved, given: int | None, run: Run) -> Solved:
    """A family with as many solutions as were given, and what algebra says of that number.

    Bezout's bounds and a count modulo two primes are of a member with random rational parameters,
    of its finitely many zeros by their multiplicities; those that were found are simple.
    """
    if given is None or not solved.complete:
        return solved
    rng = run.random(COUNTED)
    values = [Fraction(v) for v in rng.integers(1, LARGEST_VALUE, len(solved.values)).tolist()]
    system = solved.family.at(values)
    found = len(solved.points)
    if bound_of_zeros(system)[0] == found:
        return _with_detail(solved, "and Bezout's bound agrees")
    # Those of the conjugate system are counted with them.
    sides = 1 + system.imaginary
    count = SystemFacts(system).count_zeros(sides * found, False)
    seen = judge_number(sides * found, count)
    if seen is Completeness.ALL:
        return _with_detail(solved, "and a count modulo two primes agrees")
    if count is not None and seen is not Completeness.UNKNOWN:
        counted = count.bound // sides
        note = (
            f"{counted} are counted modulo primes: the given number of solutions, {given}, is "
            "wrong, or zeros are multiple"
        )
        classes = solved.classes and replace(solved.classes, complete=False)
        return replace(solved, complete=False, classes=classes, notes=(note,))
    note = f"that these are all rests on the given number of solutions, {given}, not checked"
    return replace(solved, notes=(note,))


def _with_detail(solved: Solved, more: str) -> Solved:
    """The same with more of how its solutions were found."""
    detail = f"{solved.detail}, {more}"
    classes = solved.classes and replace(solved.classes, detail=detail)
    return replace(solved, detail=detail, classes=classes)


def begin_of_family(
    solved: Solved, values: Sequence[Number], settings: Settings | str = "default"
) -> tuple[Homotopy, float, int]:
    """The homotopy to given parameters, and the seconds and steps that tracking it takes."""
    if solved.classes is None:
        begin = _start(solved, values)
        homotopy, starts = begin.homotopy, begin.points
    else:
        line, starts = line_of_classes(solved.classes, values)
        homotopy = line.homotopy
    started = time.perf_counter()
    paths = track(homotopy, starts, settings, endgame=solved.classes is None)
    return homotopy, time.perf_counter() - started, int(paths.steps.sum())


def _start(solved: Solved, values: Sequence[Number | ComplexNumber]) -> StartSystem:
    line = parameter_line(solved.family, solved.values, values)
    groups = (tuple(range(solved.family.n)),)
    return StartSystem(
        "parameter", line.homotopy, line.starts(solved.points), groups, solved.complete
    )
