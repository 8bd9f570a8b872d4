"""All isolated solutions of a polynomial system."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.high_precision import vanish
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.coincidence import clusters, conjugates_present
from nag.numerics.singular_point import Place, analyse
from nag.solving.branch_solutions import solve_apart
from nag.solving.solutions import PathStatistics, Solution, SolveResult
from nag.solving.start.choice import check_kind, choose
from nag.solving.start.target import Start, Target
from nag.tracking.homotopy import Homotopy
from nag.tracking.paths import Paths, PathStatus
from nag.tracking.settings import Settings, named
from nag.tracking.track import merged, track

Progress = Callable[[str, int, int], None]

# Digits of evidence, beyond the least, of zeros that are to be told from others beside them.
SEPARATING = 60
# |f| over the sum of |terms|: zeros lie below 2.5e-13 at sharpened points, others above 2e-6.
ON = 1e-9
# End points with larger values than this are no zeros, however badly they are known.
NEARLY = 1e-5
# Homogenising coordinates of ends at infinity are less than this, or than their errors, which are
# less than the second number.
INFINITE, ROUGHLY_INFINITE = 2e-12, 1e-7
# Points evaluated at once.
BLOCK = 2048


def solve(
    system: PolynomialSystem,
    *,
    start: str = "auto",
    seed: int = 0,
    threads: int = 1,
    settings: Settings | str = "default",
    progress: Progress | None = None,
) -> SolveResult:
    """All isolated solutions of ``system``, each once, with their multiplicities.

    Where equations factor over the rationals, the parts that the system falls into are solved
    apart; what comes down to one variable, or to two equations in two of few solutions, is solved
    exactly. Paths are tracked for the rest, and for a system that a start system is named for.

    Args:
        system: what to solve; its ``groups`` are tried among the multihomogeneous structures.
        start: ``"auto"`` (the least work), ``"total"``, ``"multihomogeneous"``,
            ``"polyhedral"`` or ``"monodromy"``.
        seed: of the random numbers; the same seed gives the same answer for any ``threads``.
        threads: number of threads.
        settings: tracking settings.
        progress: called with a stage, the work done and the whole work.

    Raises:
        nag.solving.start.target.StartError: if there would be too many paths.
        ValueError: if there is no such start system or no settings of that name.
    """
    named(settings)
    check_kind(start)
    name = settings if isinstance(settings, str) else "custom"

    def tracked(part: PolynomialSystem) -> SolveResult:
        return _solve_whole(part, start, seed, threads, settings, progress)

    # Who names a start system wants its paths.
    return solve_apart(system, tracked, seed, name, start == "auto") or tracked(system)


def _solve_whole(
    system: PolynomialSystem,
    start: str,
    seed: int,
    threads: int,
    settings: Settings | str,
    progress: Progress | None,
) -> SolveResult:
    """The isolated solutions of a system that is tracked as a whole."""
    name = settings if isinstance(settings, str) else "custom"
    rng = np.random.default_rng(seed)
    equations = [f for f in system.polynomials if f]
    if any(f.degree == 0 for f in equations) or system.n == 0:
        return _nothing(system, seed, name)
    problem = _Problem.of(system, equations, rng)
    if progress:
        progress("solve", 0, 1)
    begin, reason = choose(problem.target, start, system.groups, rng, threads)
    paths = track(begin.homotopy, begin.points, settings, threads)
    ends = _Ends.of(problem, begin, paths, rng)
    if len(ends.close):
        # What looks like a multiple zero and is none may be simple ones close together.
        separating = replace(named(settings), evidence=SEPARATING)
        more = track(begin.homotopy, begin.points[ends.close], separating, threads)
        paths = merged(paths, more, ends.close)
        ends = _Ends.of(problem, begin, paths, rng)
    return _result(problem, begin, reason, paths, ends, seed, name)


def begin_of(
    system: PolynomialSystem,
    seed: int = 0,
    start: str = "auto",
    settings: Settings | str = "default",
) -> tuple[Homotopy, float, int]:
    """The homotopy of the first attempt, and the seconds and steps that tracking it takes."""
    rng = np.random.default_rng(seed)
    problem = _Problem.of(system, [f for f in system.polynomials if f], rng)
    begin, _ = choose(problem.target, start, system.groups, rng, 1)
    started = time.perf_counter()
    paths = track(begin.homotopy, begin.points, settings)
    return begin.homotopy, time.perf_counter() - started, int(paths.steps.sum())


@dataclass(frozen=True, eq=False)
class _Problem:
    """A system, the square one that is tracked, and both in scaled variables.

    Attributes:
        equations: the system's equations in the scaled variables.
        nonzero: what must not vanish, in the scaled variables.
        added: number of random linear equations that cut a solution set of positive dimension.
        squared: whether the square system has solutions that the equations have not.
    """

    system: PolynomialSystem
    equations: tuple[Polynomial, ...]
    nonzero: Evaluator
    target: Target
    added: int
    squared: bool

    @classmethod
    def of(
        cls, system: PolynomialSystem, equations: Sequence[Polynomial], rng: np.random.Generator
    ) -> _Problem:
        n = system.n
        added = max(0, n - len(equations))
        slices = [_random_linear(n, rng) for _ in range(added)]
        square = _squared([*equations, *slices], n, rng)
        target = Target.of(square, n)
        nonzero = Evaluator.of([target.scaled(f) for f in system.nonzero], n)
        mended = tuple(target.scaled(f) for f in [*equations, *slices])
        return cls(system, mended, nonzero, target, added, len(equations) > n)

    def solves(self, x: np.ndarray) -> bool | None:
        """Whether all equations vanish at the square system's exact zero near ``x``.

        None if there is no such zero.
        """
        n = self.target.n
        square = [Polynomial(n, dict(row)) for row in self.target.rows]
        jacobian = Evaluator.of(square, n).jacobian(x)
        return vanish(self.equations, square, np.zeros((0, 1 + n)), jacobian, x)


def ends_of(
    system: PolynomialSystem,
    begin: Start,
    paths: Paths,
    reason: str,
    rng: np.random.Generator,
    seed: int,
    settings: str,
) -> SolveResult:
    """The result for a square system whose paths, in its own variables, were tracked already."""
    n = system.n
    target = Target(n, tuple(dict(f.terms) for f in system.polynomials))
    nonzero = Evaluator.of(system.nonzero, n)
    problem = _Problem(system, system.polynomials, nonzero, target, 0, False)
    return _result(
        problem, begin, reason, paths, _Ends.of(problem, begin, paths, rng), seed, settings
    )


def _random_linear(n: int, rng: np.random.Generator) -> Polynomial:
    weights = [Fraction(int(w), 128) for w in rng.integers(-128, 129, n + 1)]
    terms = {(0,) * n: weights[n]}
    for i in range(n):
        terms[tuple(int(j == i) for j in range(n))] = weights[i] or Fraction(1)
    return Polynomial(n, terms)


def _squared(polynomials: list[Polynomial], n: int, rng: np.random.Generator) -> list[Polynomial]:
    """``n`` polynomials: those of highest degree, each with multiples of the others added."""
    if len(polynomials) == n:
        return polynomials
    order = sorted(range(len(polynomials)), key=lambda i: (-polynomials[i].degree, i))
    kept, rest = order[:n], order[n:]
    result = []
    for i in kept:
        total = polynomials[i]
        size = _largest(total)
        for j in rest:
            weight = Fraction(int(rng.integers(64, 192)) * int(rng.choice([-1, 1])), 128)
            total = total + polynomials[j] * (weight * size / _largest(polynomials[j]))
        result.append(total)
    return result


def _largest(f: Polynomial) -> Fraction:
    return Fraction(max(abs(float(c)) for c in f.terms.values()))


def _nothing(system: PolynomialSystem, seed: int, settings: str) -> SolveResult:
    empty = np.zeros((0, system.n), dtype=complex)
    contradiction = any(f.degree == 0 for f in system.polynomials)
    solutions = ()
    if not contradiction:
        solutions = (Solution(np.zeros(0), 1, True, 0.0, 0.0, 1.0, 16),)
    reason = "an equation is a constant that is not zero" if contradiction else "no variables"
    return SolveResult(
        system, solutions, empty, empty, 0, PathStatistics(), "none", reason, seed, settings, True
    )


def _result(
    problem: _Problem,
    begin: Start,
    reason: str,
    paths: Paths,
    ends: _Ends,
    seed: int,
    settings: str,
) -> SolveResult:
    counts = PathStatistics(
        len(paths),
        *(len(paths.where(status)) for status in PathStatus),
        int(paths.steps.sum()),
    )
    notes = list(ends.notes)
    if counts.failed:
        causes = ", ".join(f"{k} because {why}" for why, k in paths.failures.items())
        notes.append(f"{counts.failed} of {counts.tracked} paths failed: {causes}")
    infinite = paths.where(PathStatus.AT_INFINITY)
    far = np.abs(paths.points[infinite][:, list(begin.homotopy.infinity)])
    error = np.minimum(paths.accuracy[infinite], ROUGHLY_INFINITE)
    unsure = int((far.min(axis=1, initial=np.inf) > np.maximum(INFINITE, error)).sum())
    if unsure:
        notes.append(f"{unsure} paths to infinity may end at solutions far out")
    complete = begin.complete and not notes
    if len(ends.on_components):
        notes.append(
            f"the solution set has positive dimension; {len(ends.on_components)} end points lie "
            "on it and are no isolated solutions"
        )
    elif problem.added:
        notes.append(
            f"fewer equations than variables: no solution is isolated, and none was found where "
            f"{problem.added} random linear equations are added"
        )
    return SolveResult(
        system=problem.system,
        solutions=ends.solutions,
        on_components=ends.on_components,
        undecided=ends.undecided,
        excluded=ends.excluded,
        paths=counts,
        start=begin.name,
        reason=reason,
        seed=seed,
        settings=settings,
        complete=complete,
        notes=tuple(notes),
    )


@dataclass(frozen=True, eq=False)
class _Ends:
    """The end points of all paths, sorted; coordinates are those of the original variables.

    ``close``: the paths to those undecided.
    """

    solutions: tuple[Solution, ...]
    on_components: np.ndarray
    undecided: np.ndarray
    excluded: int
    notes: tuple[str, ...]
    close: np.ndarray

    @classmethod
    def of(cls, problem: _Problem, begin: Start, paths: Paths, rng: np.random.Generator) -> _Ends:
        n = problem.system.n
        evaluator = Evaluator.of(problem.equations, n)
        finite = paths.where(PathStatus.REGULAR, PathStatus.SINGULAR)
        points = begin.affine(paths.points[finite])
        accuracy = paths.accuracy[finite]
        residual = _residuals(evaluator, points)
        regular = paths.status[finite] == PathStatus.REGULAR
        on = residual < np.maximum(ON, accuracy)
        notes: list[str] = []
        lost = ~on
        if problem.squared:
            # Whether a regular zero is one of all equations is decided exactly, below.
            on |= regular & (residual < NEARLY)
            lost = ~on & (residual < NEARLY)
        if lost.any():
            notes.append(f"{int(lost.sum())} end points are zeros of the equations only roughly")
        finite, points, accuracy, residual = finite[on], points[on], accuracy[on], residual[on]
        regular = regular[on]
        multiplicity = np.ones(len(points), dtype=np.int64)
        condition = paths.condition[finite]
        isolated: list[int] = []
        on_components: list[np.ndarray] = []
        undecided: list[np.ndarray] = []
        # Regular ends are distinct, as the tracker has seen.
        several = np.flatnonzero(~regular)
        groups = [np.array([i]) for i in np.flatnonzero(regular)]
        groups += [several[g] for g in clusters(points[several], accuracy[several])]
        close: list[int] = []
        for group in groups:
            best = int(group[np.argmin(accuracy[group])]) if len(group) > 1 else int(group[0])
            if problem.added:
                on_components.append(points[best])
                continue
            if regular[best]:
                solves = problem.solves(points[best]) if problem.squared else True
                if solves is None:
                    undecided.extend(points[group])
                elif solves:
                    isolated.append(best)
                continue
            end = analyse(problem.equations, points[best], float(accuracy[best]), rng)
            if end.place is not Place.ISOLATED:
                elsewhere = on_components if end.place is Place.ON_COMPONENT else undecided
                elsewhere.extend(points[group])
                if end.place is Place.UNDECIDED:
                    close.extend(finite[group].tolist())
                continue
            isolated.append(best)
            points[best], accuracy[best] = end.point, end.accuracy
            multiplicity[best], condition[best] = end.multiplicity, end.condition
            residual[best] = evaluator.residuals(end.point[None]).max()
            if begin.complete and not problem.squared and end.multiplicity != len(group):
                notes.append(
                    f"{len(group)} paths end at a solution of multiplicity {end.multiplicity}"
                )
        points, accuracy, residual = points[isolated], accuracy[isolated], residual[isolated]
        multiplicity, condition = multiplicity[isolated], condition[isolated]
        sizes = 1 + np.abs(points).max(axis=1, initial=0.0)
        imaginary = np.abs(points.imag).max(axis=1, initial=0.0)
        real = imaginary <= np.maximum(1e2 * accuracy, 1e-10) * sizes
        if undecided:
            notes.append(
                f"{len(undecided)} end points may or may not be isolated solutions, or several "
                "that are close together"
            )
        if not conjugates_present(points, accuracy, multiplicity, real):
            notes.append("the conjugate of a solution is missing")
        kept = ~_vanishes(problem.nonzero, points, accuracy)
        original = problem.target.original
        described = zip(
            original(points),
            multiplicity.tolist(),
            real.tolist(),
            residual.tolist(),
            accuracy.tolist(),
            condition.tolist(),
            paths.precision[finite[isolated]].tolist(),
            strict=True,
        )
        return cls(
            tuple(Solution(*x) for x, keep in zip(described, kept, strict=True) if keep),
            original(np.array(on_components).reshape(-1, n)),
            original(np.array(undecided).reshape(-1, n)),
            int((~kept).sum()),
            tuple(notes),
            np.array(sorted(close), dtype=np.int64),
        )


def _residuals(evaluator: Evaluator, points: np.ndarray) -> np.ndarray:
    """The largest residual at each point; a block at a time, as there may be 10^5 points."""
    blocks = [points[k : k + BLOCK] for k in range(0, len(points), BLOCK)]
    found = [evaluator.residuals(block).max(axis=1, initial=0.0) for block in blocks]
    return np.concatenate([np.zeros(0), *found])


def _vanishes(nonzero: Evaluator, points: np.ndarray, accuracy: np.ndarray) -> np.ndarray:
    """At which points one of the polynomials vanishes that must not, shape ``(P,)``."""
    if not len(nonzero.coefficients):
        return np.zeros(len(points), dtype=bool)
    least = nonzero.residuals(points).min(axis=1)
    return least < np.maximum(1e-8, 1e2 * accuracy)
