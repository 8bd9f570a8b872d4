"""All isolated solutions of a polynomial system."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import ZeroCount
from nag.solving.branch_solutions import solve_apart
from nag.solving.conjugate_ends import with_conjugate_ends
from nag.solving.judged_ends import JudgedEnds, judged_ends
from nag.solving.missing_zeros import Verdict, counted, doubtful, verdict, with_missing_zeros
from nag.solving.solutions import PathStatistics, Solution, SolveResult
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import check_kind, choose
from nag.solving.start.isotropic import isotropic
from nag.solving.start.target import Start, Target
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.tracking.settings import Settings, named, tighter
from nag.tracking.track import track

Progress = Callable[[str, int, int], None]

# Digits of evidence, beyond the least, of zeros that are to be told from others beside them.
SEPARATING = 60
# Homogenising coordinates of ends at infinity are less than this, or than their errors, which are
# less than the second number.
INFINITE, ROUGHLY_INFINITE = 2e-12, 1e-7


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def solve(
    system: PolynomialSystem,
    *,
    start: str = "auto",
    run: Run = DEFAULT_RUN,
    finite: bool = False,
) -> SolveResult:
    """All isolated solutions of ``system``, each once, with their multiplicities.

    Where equations factor over the rationals, the parts that the system falls into are solved
    apart; what comes down to one variable, or to two equations in two of few solutions, is solved
    exactly. Paths are tracked for the rest, and for a system that a start system is named for.

    Args:
        system: what to solve; its ``groups`` are tried among the multihomogeneous structures.
        start: ``"auto"`` (the least work), ``"total"``, ``"multihomogeneous"``,
            ``"polyhedral"`` or ``"monodromy"``.
        run: a `nag.Run`; its seed, threads, settings and progress may be given one by one.
        finite: whether only a finite solution set is of interest; the result is incomplete, and
            quickly there, if the set proves to have positive dimension.

    Raises:
        nag.StartError: if there would be too many paths.
        ValueError: if there is no such start system or no settings of that name.
    """
    check_kind(start)

    def tracked(part: PolynomialSystem) -> SolveResult:
        return solve_whole(part, start, run, finite)

    # Who names a start system wants its paths.
    return solve_apart(system, tracked, run, start == "auto") or tracked(system)


def solve_whole(
    system: PolynomialSystem, start: str, run: Run, finite: bool = False
) -> SolveResult:
    """The isolated solutions of a system that is tracked as a whole."""
    rng = run.random()
    equations = [f for f in system.polynomials if f]
    if any(f.degree == 0 for f in equations) or system.n == 0:
        return _solve_constants(system, run)
    problem = SquareProblem.of(system, equations, rng)
    run.tell("solve", 0, 1)
    settings, threads = run.settings, run.threads
    turned = None
    if start == "auto":
        turned = isotropic(system, problem.target, settings, run.random(31), threads)
    begin, reason = turned or choose(problem.target, start, system.groups, rng, threads)
    paths = track(begin.homotopy, begin.points, settings, threads, known=begin.known)

    def look(paths: Paths, count: ZeroCount | None = None) -> JudgedEnds:
        ends = judged_ends(problem, begin, with_conjugate_ends(begin, paths), rng, finite)
        # Zeros are counted, where that is possible, whatever ends lost paths were given.
        ends = replace(ends, count=count) if count else counted(problem, begin, paths, ends)
        return with_missing_zeros(problem, begin, paths, ends, rng)

    ends = look(paths)
    unclear = len(ends.close) and not (finite and len(ends.larger.points))
    if unclear and verdict(ends) is not Verdict.ALL:
        # What looks like a multiple zero and is none may be simple ones close together.
        chosen, separating = ends.close, replace(named(settings), evidence=SEPARATING)
        paths = _once_more(begin, paths, chosen, separating, threads)
        ends = look(paths, ends.count)
    if verdict(ends) in (Verdict.MISSING, Verdict.TOO_MANY):
        # An end that is not proved may be another one: what is near it, or a jump.
        chosen = doubtful(paths)
        separating = replace(tighter(named(settings)), evidence=SEPARATING)
        more = _once_more(begin, paths, chosen, separating, threads)
        again = look(more, ends.count)
        if again.zeros > ends.zeros or verdict(again) is Verdict.ALL:
            paths, ends = more, again
    paths = with_conjugate_ends(begin, paths)
    return _result(problem, begin, reason, paths, ends, run)


def _once_more(
    begin: Start, paths: Paths, chosen: np.ndarray, settings: Settings, threads: int
) -> Paths:
    """The paths, those chosen tracked with other settings."""
    again = track(begin.homotopy, begin.points[chosen], settings, threads)
    return paths.track_again(chosen, again)


def begin_of(
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


def ends_of(
    system: PolynomialSystem,
    begin: Start,
    paths: Paths,
    reason: str,
    rng: np.random.Generator,
    run: Run,
) -> SolveResult:
    """The result for a square system whose paths, in its own variables, were tracked already."""
    n = system.n
    target = Target(n, tuple(dict(f.terms) for f in system.polynomials))
    problem = SquareProblem(system, system.polynomials, system.nonzero, target, 0, False)
    return _result(problem, begin, reason, paths, judged_ends(problem, begin, paths, rng), run)


def _solve_constants(system: PolynomialSystem, run: Run) -> SolveResult:
    empty = np.zeros((0, system.n), dtype=complex)
    contradiction = any(f.degree == 0 for f in system.polynomials)
    solutions = ()
    if not contradiction:
        solutions = (Solution(np.zeros(0), 1, True, 0.0, 0.0, 1.0, 16),)
    reason = "an equation is a constant that is not zero" if contradiction else "no variables"
    return SolveResult(
        system,
        solutions,
        empty,
        empty,
        0,
        PathStatistics(),
        "none",
        reason,
        run.seed,
        run.name,
        True,
    )


def _result(
    problem: SquareProblem,
    begin: Start,
    reason: str,
    paths: Paths,
    ends: JudgedEnds,
    run: Run,
) -> SolveResult:
    counts = PathStatistics(
        len(paths),
        *(len(paths.where(status)) for status in PathStatus),
        int(paths.steps.sum()),
    )
    seen = verdict(ends)
    if seen is Verdict.ALL:
        notes = list(ends.notes)
        how = "linear algebra modulo two primes shows"
        if begin.complete and ends.zeros == len(paths):
            how = "so many paths leave"
        reason = f"{reason}; {how} no more than {ends.zeros}"
    else:
        notes = [*ends.unclear, *_open(begin, paths), *ends.notes]
        if seen is not Verdict.UNKNOWN:
            notes.append(f"{ends.zeros} zeros were found, and there are {ends.count.bound}")
    complete = (begin.complete or seen is Verdict.ALL) and not notes
    notes += ends.larger.notes
    if problem.added and not len(ends.larger.points):
        notes.append(
            f"fewer equations than variables: no solution is isolated, and none was found where "
            f"{problem.added} random linear equations are added"
        )
    return SolveResult(
        system=problem.system,
        solutions=ends.solutions,
        on_components=ends.larger.counting,
        undecided=ends.undecided[:0] if seen is Verdict.ALL else ends.undecided,
        excluded=len(ends.excluded),
        paths=counts,
        start=begin.name,
        reason=reason,
        seed=run.seed,
        settings=run.name,
        complete=complete,
        notes=tuple(notes),
        excluded_solutions=ends.excluded,
        pathless=not len(paths),
        on_excluded=ends.larger.excluded,
        on_doubtful=ends.larger.doubtful,
    )


def _open(begin: Start, paths: Paths) -> list[str]:
    """What is left open of the paths that failed, and of those to infinity."""
    notes = []
    failed = len(paths.where(PathStatus.FAILED))
    if failed:
        causes = ", ".join(f"{k} because {why}" for why, k in paths.failures.items())
        notes.append(f"{failed} of {len(paths)} paths failed: {causes}")
    infinite = paths.where(PathStatus.AT_INFINITY)
    far = np.abs(paths.points[infinite][:, list(begin.homotopy.infinity)])
    error = np.minimum(paths.accuracy[infinite], ROUGHLY_INFINITE)
    unsure = int((far.min(axis=1, initial=np.inf) > np.maximum(INFINITE, error)).sum())
    if unsure:
        notes.append(f"{unsure} paths to infinity may end at solutions far out")
    return notes
