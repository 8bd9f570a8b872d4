"""All isolated solutions of a polynomial system: the methods, the bounds and the finders, in turn.

Each of `METHODS` is asked and answers, or leaves the system to the next ones; the second one takes
it apart and asks the next ones for its branches. Where paths are tracked, as many zeros as one of
`BOUNDS` allows are all; until so many are known, or none is left, each of `PATHLESS` and `AGAIN`
looks for more.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from nag.algebra.imaginary_unit import as_real, has_unit, real_and_imaginary_parts
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import Completeness, ZeroCount
from nag.numerics.system_facts import SystemFacts
from nag.numerics.zero_values import possible_zeros, vanishes_at_all
from nag.solving.branch_solutions import solve_branches, solve_exactly
from nag.solving.isolated_zero import are_within_errors
from nag.solving.missing_zeros import find_at_lost_paths, find_by_sizes
from nag.solving.path_search import Bound, PathSearch, SolveTask
from nag.solving.solutions import Solution, SolveResult
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import check_kind, choose, mixed_volume
from nag.solving.start.isotropic import isotropic
from nag.solving.start.target import StartSystem
from nag.text.progress import REMARK
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.run import DEFAULT_RUN, UNFINISHED, Run, Stream, TellFound, answers_early
from nag.tracking.settings import Settings, find_settings, tighten
from nag.tracking.track import PathsSoFar, track

# Digits of evidence, beyond the least, of zeros that are to be told from others beside them.
SEPARATING = 60
# The stream of random numbers of answers that are told early, which change no later one, and the
# coordinates of ends that are kept for them: with more of these the work goes on behind a ledger.
EARLY, MOST_EARLY = (1 << 32) + 2, 1 << 19
# Where only a finite set is of interest, one path of so many is tracked and judged first, if these
# are so many, and at most so many: where one ends on a larger set, the others need not be tracked.
TRIED_OF, LEAST_TRIED, MOST_TRIED = 32, 8, 64

# Answers what is left of a task by the methods after the one that asks.
Others = Callable[[SolveTask], SolveResult]
Method = Callable[[SolveTask, Others], SolveResult | None]
Finder = Callable[[PathSearch], PathSearch]


@answers_early
@np.errstate(over="ignore", invalid="ignore")
def solve(
    system: PolynomialSystem,
    *,
    start: str = "auto",
    run: Run = DEFAULT_RUN,
    finite: bool = False,
    facts: SystemFacts | None = None,
) -> SolveResult:
    """All isolated solutions of ``system``, each once, with their multiplicities.

    Where equations factor over the rationals, the parts that the system falls into are solved
    apart; what comes down to one variable, or to two equations in two of few solutions, is solved
    exactly. Paths are tracked for the rest, and for a system that a start system is named for.

    Args:
        system: what to solve; its ``groups`` are tried among the multihomogeneous structures.
        start: one of `nag.solving.start.KINDS`, or ``"auto"`` for that of the least work.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.
        finite: whether only a finite solution set is of interest; the result is incomplete, and
            quickly there, if the set proves to have positive dimension.
        facts: what is known of the system.

    Raises:
        nag.StartError: if there would be too many paths.
        ValueError: if there is no such start system or no settings of that name.
    """
    check_kind(start)
    run.tell("solving", 0, 0)
    if system.imaginary:
        told = run.found
        if told is not None:
            run = replace(run, found=lambda found: told(leave_out_conjugate(found, system)))
        both = SolveTask(SystemFacts(as_real(system)), start, run, finite, sides=2)
        return leave_out_conjugate(solve_by(tuple(METHODS), both), system)
    return solve_by(tuple(METHODS), SolveTask(facts or SystemFacts(system), start, run, finite))


def leave_out_conjugate(result: SolveResult, system: PolynomialSystem) -> SolveResult:
    """The solutions in which the imaginary unit is i; those with -i are the conjugate system's."""

    both, parts = as_real(system), real_and_imaginary_parts(system).polynomials

    def chosen(solutions: Sequence[Solution]) -> tuple[Solution, ...]:
        kept = (s for s in solutions if s.point[-1].imag > 0)
        # What paths lead to is the unit to rounding; it is known exactly.
        exact = (replace(s, point=np.append(s.point[:-1], 1j)) for s in kept)
        return tuple(replace(s, real=is_real_zero(s.point, s.accuracy, both, parts)) for s in exact)

    def points(found: np.ndarray) -> np.ndarray:
        return found[has_unit(found)]

    excluded = chosen(result.excluded_solutions)
    larger = result.larger.map_points(points)
    # What says how many points lie on larger sets says it of those that are kept.
    told = result.larger.notes
    notes = [note for note in result.notes if note not in told]
    return replace(
        result,
        system=system,
        notes=(*notes, *larger.notes),
        solutions=chosen(result.solutions),
        excluded=len(excluded),
        excluded_solutions=excluded,
        on_components=larger.counting,
        undecided=points(result.undecided),
        on_excluded=larger.excluded,
        on_doubtful=larger.doubtful,
    )


def is_real_zero(
    point: np.ndarray, accuracy: float, system: PolynomialSystem, parts: Sequence[Polynomial]
) -> bool:
    """Whether all coordinates of a zero but the last one, the imaginary unit, are real.

    Conjugates are no zeros here, so that a small imaginary part says nothing; at a real zero the
    real and the imaginary parts of all equations vanish.

    Args:
        point: the zero, shape ``(n,)``; accuracy: its relative error.
        system: the equations, the unit's own among them, as `as_real` gives them.
        parts: `real_and_imaginary_parts` of the equations.
    """
    if not are_within_errors(point[None, :-1], np.array([accuracy]))[0]:
        return False
    zeros = possible_zeros(system.polynomials, point, accuracy, np.random.default_rng(0))
    return all(vanishes_at_all(zeros, f) is not False for f in parts)


def solve_without_paths(task: SolveTask) -> SolveResult | None:
    """The solutions of a system that falls apart, or has zeros that are known exactly."""
    return find_answer(EXACT, task, tuple(METHODS))


def solve_by(methods: Sequence[Method], task: SolveTask) -> SolveResult:
    """The answer of the first method that has one, by its name; the last one has always one."""
    answer = find_answer(methods, task, methods)
    assert answer is not None, "the last method answers whatever it is asked"
    return answer


def find_answer(
    methods: Sequence[Method], task: SolveTask, every: Sequence[Method]
) -> SolveResult | None:
    """The answer of the first of some methods that has one; ``every``: also those after them."""
    for k, method in enumerate(methods):
        task.run.tell(f"solving, {method.__name__.replace('_', ' ')}", 0, 0)
        answer = method(task, partial(solve_by, every[k + 1 :]))
        if answer is not None:
            return replace(answer, method=method.__name__)
    return None


# --- Methods


def by_algebra(task: SolveTask, _: Others) -> SolveResult | None:
    """Zeros of polynomials in one variable, or of two equations in two, exactly."""
    # Who names a start system wants its paths.
    return solve_exactly(task) if task.start == "auto" else None


def by_branches(task: SolveTask, others: Others) -> SolveResult | None:
    """The zeros of the branches that the factors of the equations leave, without repeats."""
    return solve_branches(task, others)


def by_constants(task: SolveTask, _: Others) -> SolveResult | None:
    """Equations without variables, or one that is a constant."""
    system = task.system
    if any(f.degree == 0 for f in system.polynomials if f):
        reason = "an equation is a constant that is not zero"
        return SolveResult.of(system, task.run, reason=reason)
    if system.n:
        return None
    only = Solution(np.zeros(0), 1, True, 0.0, 0.0, 1.0, 16)
    return SolveResult.of(system, task.run, reason="no variables", solutions=(only,))


def by_turns(task: SolveTask, _: Others) -> SolveResult | None:
    """Equations of turns in loops: from all their zeros in isotropic coordinates, at rest."""
    if task.start != "auto":
        return None
    run = task.run
    given = task.system, task.problem.target, run.settings, run.random(Stream.TURNS), run.threads
    found = isotropic(*given)
    return None if found is None else _track_from(task, *found)


def by_paths(task: SolveTask, _: Others) -> SolveResult:
    """The ends of paths from the start system that is asked for, or has the least work."""
    problem, groups = task.problem, task.system.groups
    given = problem.target, task.start, groups, task.rng, task.run.threads
    return _track_from(task, *choose(*given))


# In the order in which they are asked, with what is said of each; `SolveResult.method` names the
# one that answered.
METHODS: dict[Method, str] = {
    by_algebra: "by algebra alone, without paths: polynomials in one variable, or two equations in "
    "two",
    by_branches: "the equations have factors: the branches that these leave are solved apart",
    by_constants: "by algebra alone, without paths: the equations are constants",
    by_turns: "all zeros of turns in loops, by paths in isotropic coordinates",
    by_paths: "by paths from the zeros of a start system",
}
METHOD_TEXTS = {method.__name__: text for method, text in METHODS.items()} | {
    "by_family": "by paths from the zeros of a member of the family with random parameters",
}
# Those that a member of a family is asked as well.
EXACT: tuple[Method, ...] = (by_algebra, by_branches)


# --- Bounds of the number of isolated zeros, each counted by its multiplicity


def number_of_paths(search: PathSearch) -> Bound | None:
    """Bezout's number, that of groups, or another: a start system may have a path for each zero."""
    count = ZeroCount(len(search.tracked), False)
    return Bound(count, "so many paths leave") if search.begin.complete else None


def volume_of_polytopes(search: PathSearch) -> Bound | None:
    """The mixed volume, where it was found on the way or is little work."""
    volume = mixed_volume(search.problem.target, search.begin, search.problem.squared)
    return None if volume is None else Bound(ZeroCount(volume, False), "the mixed volume leaves")


def modulo_primes(search: PathSearch) -> Bound | None:
    """The dimension of the quotient by the ideal, modulo two primes."""
    count = search.task.facts.count_zeros(search.zeros, search.has_doubts)
    return None if count is None else Bound(count, "linear algebra modulo two primes shows")


# In the order in which they are asked, until one is met.
BOUNDS = (number_of_paths, volume_of_polytopes, modulo_primes)


def _bound(search: PathSearch) -> PathSearch:
    """The same with the least bound, where the zeros may be finitely many and a doubt is left."""
    infinite = search.problem.added or len(search.ends.larger.points)
    if search.bound is not None or search.is_clear or infinite:
        return search
    found: list[Bound] = []
    for ask in BOUNDS:
        bound = ask(search)
        if bound is not None:
            found.append(bound)
            if bound.count.bound == search.zeros:
                break
    least = min(found, key=lambda b: (b.count.bound, not b.count.exact), default=None)
    return replace(search, bound=least)


# --- Finders of zeros beside those that paths have reached


def close_ends(search: PathSearch) -> PathSearch:
    """What looks like a multiple zero and is none may be simple ones close together."""
    chosen, ends = search.ends.close, search.ends
    if not len(chosen) or (search.task.finite and len(ends.larger.points)):
        return search
    settings = replace(find_settings(search.task.run.settings), evidence=SEPARATING)
    return _look(_track_again(search, chosen, settings))


def doubtful_ends(search: PathSearch) -> PathSearch:
    """An end that is not proved may be another one: what is near it, or a jump."""
    if search.completeness not in (Completeness.MISSING, Completeness.TOO_MANY):
        return search
    settings = replace(tighten(find_settings(search.task.run.settings)), evidence=SEPARATING)
    again = _look(_track_again(search, search.doubtful, settings))
    better = again.zeros > search.zeros or again.completeness is Completeness.ALL
    return again if better else search


# Those that need no paths, and those that track some again, each in its turn.
PATHLESS: tuple[Finder, ...] = (find_at_lost_paths, find_by_sizes)
AGAIN: tuple[Finder, ...] = (close_ends, doubtful_ends)


def _track_from(task: SolveTask, begin: StartSystem, reason: str) -> SolveResult:
    """The zeros that paths from a start system lead to, and those that are found beside them."""
    run = task.run
    stage = f"tracking {len(begin.points)} paths"
    run.tell(stage, 0, 0)
    if task.finite and len(begin.points) >= TRIED_OF * LEAST_TRIED:
        tried = _track_some(task, begin, reason)
        if len(tried.ends.larger.counting):
            return tried.result()

    def tell(so_far: PathsSoFar) -> None:
        name = f"ends of {so_far.total} paths in more digits" if so_far.in_digits else stage
        counts = {
            "doubtful": so_far.doubtful,
            "to infinity": so_far.infinite,
            "failed": so_far.failed,
        }
        run.tell(_with_counts(name, counts), so_far.done, so_far.total)

    seen: list[Paths] = []

    def first_zeros() -> SolveResult:
        own = task.problem, begin, reason, Paths.concatenate(seen), run.random(EARLY)
        return _result_so_far(PathSearch.of(task, *own))

    with TellFound(run, first_zeros) as tell_found:

        def tell_all(so_far: PathsSoFar) -> None:
            tell(so_far)
            if run.found is None or so_far.paths is None:
                return
            ends = so_far.paths.select_rows(so_far.paths.where(PathStatus.REGULAR))
            if len(ends) and sum(each.points.size for each in (*seen, ends)) <= MOST_EARLY:
                seen.append(ends)
                tell_found(True)

        how = run.settings, run.threads
        paths = track(begin.homotopy, begin.points, *how, known=begin.known, tell=tell_all)
    seen.clear()
    ends = {
        "to infinity": len(paths.where(PathStatus.AT_INFINITY)),
        "failed": len(paths.where(PathStatus.FAILED)),
    }
    run.tell(_with_counts(f"judging the ends of {len(paths)} paths", ends), 0, 0)
    search = PathSearch.of(task, task.problem, begin, reason, paths, task.rng)
    if run.found is not None:
        run.found(_result_so_far(search))
    search = _look(search)
    for find in AGAIN:
        if search.completeness is not Completeness.ALL:
            search = find(search)
    return search.result()


def _track_some(task: SolveTask, begin: StartSystem, reason: str) -> PathSearch:
    """What a few of the paths say."""
    count = len(begin.points)
    chosen = np.linspace(0, count, min(count // TRIED_OF, MOST_TRIED), endpoint=False, dtype=int)
    # An isolated zero may be the end of paths that are left out.
    some = replace(begin, complete=False)
    paths = track(begin.homotopy, begin.points[chosen], task.run.settings, task.run.threads)
    return PathSearch.of(
        task, task.problem, some, reason, paths, task.run.random(Stream.TRIED_PATHS)
    )


def _result_so_far(search: PathSearch) -> SolveResult:
    """What would be the answer if the work ended here."""
    return replace(search.result(), complete=False, notes=(UNFINISHED,))


def _with_counts(stage: str, counts: dict[str, int]) -> str:
    """A stage, and how many paths are what."""
    remark = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    return f"{stage}{REMARK}{remark}" if remark else stage


def _look(search: PathSearch) -> PathSearch:
    """What is known once bounds and the finders that need no paths were asked."""
    search = _bound(search)
    for find in PATHLESS:
        if search.completeness is not Completeness.ALL:
            search = find(search)
    return search


def _track_again(search: PathSearch, chosen: np.ndarray, settings: Settings) -> PathSearch:
    """The paths, those chosen tracked with other settings."""
    begin, threads = search.begin, search.task.run.threads
    return search.replace_paths(
        chosen, track(begin.homotopy, begin.points[chosen], settings, threads)
    )


def time_first_attempt(
    system: PolynomialSystem,
    seed: int = 0,
    start: str = "auto",
    settings: Settings | str = "default",
) -> tuple[Homotopy, float, int]:
    """The homotopy of the first attempt, and the seconds and steps that tracking it takes."""
    rng = np.random.default_rng(seed)
    problem = SquareProblem.of(system, [f for f in system.polynomials if f], rng)
    begin, _ = choose(problem.target, start, system.groups, rng, 1)
    started = time.perf_counter()
    paths = track(begin.homotopy, begin.points, settings, known=begin.known)
    return begin.homotopy, time.perf_counter() - started, int(paths.steps.sum())
