"""Isolated solutions of systems that fall apart exactly: those of the branches, joined.

Branches whose zeros are algebraic numbers of one variable are solved exactly, the others by
tracking paths. They are solved and joined in coordinates that suit the whole system, exactly: far
from its origin solutions of different branches, or one twice, would be told apart by what rounding
left of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from nag.algebra.algebraic_zeros import AlgebraicZero, algebraic_zeros
from nag.algebra.branch_equations import BranchEquations, BranchKind
from nag.algebra.elimination import Elimination
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.branch_union import (
    BranchZeros,
    GenericPoint,
    PointWithError,
    find_repeats,
    multiplicities_in_scheme,
)
from nag.numerics.coincidence import NEAR
from nag.numerics.digits import DIGITS, bits_of, doubles
from nag.numerics.doubles import SLACK
from nag.numerics.natural_coordinates import NaturalCoordinates, comparable_coordinates
from nag.numerics.precise_point import WORKING_DIGITS
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import (
    WRITTEN,
    choose_alike,
    possible_zeros,
    select_isolated,
    vanishes_at_all,
    widen_error,
)
from nag.solving.isolated_zero import ROUNDING
from nag.solving.path_search import SolveTask
from nag.solving.solutions import LargerSets, PathStatistics, Solution, SolveResult

# Coordinates with larger errors than this, relative to their sizes, are worked out in more digits:
# terms of what gives the variables that were eliminated may cancel.
ROUGH = 1e-9


@dataclass(frozen=True, eq=False)
class _Found(GenericPoint):
    """A solution of one branch.

    Attributes:
        branch: what led there from its equations.
        zero: the exact zero, where it is one of an algebraic branch.
        tracked: the solution of the system that was left; None where none was tracked.
    """

    solution: Solution
    branch: BranchEquations
    zero: AlgebraicZero | None = None
    tracked: Solution | None = None

    @property
    def points(self) -> np.ndarray:
        return self.solution.point[None]

    @property
    def point(self) -> np.ndarray:
        return self.solution.point

    @property
    def radii(self) -> np.ndarray | None:
        return self.solution.radii if self.solution.multiplicity == 1 else None

    @property
    def multiplicity_in_branch(self) -> int:
        return self.solution.multiplicity

    @property
    def error(self) -> float | np.ndarray:
        x, accuracy = self.point, self.solution.accuracy
        if self.solution.precision >= DIGITS:
            # Each coordinate is known to rounding, however small it is beside the others.
            return SLACK * accuracy * np.where(x == 0, 1.0, np.abs(x))
        if self.solution.radii is not None:
            return SLACK * self.solution.radii
        return widen_error(x, accuracy)

    def vanishes_in_digits(self, f: Polynomial, image: Polynomial) -> bool | None:
        return vanishes_at_all(self._zeros, image) if self.tracked is not None else None

    def in_digits(self) -> PointWithError:
        if self.tracked is not None and len(self._zeros) != 1:
            return _point_and_error(self.solution)
        # Zeros of other branches may be close to it.
        y = self._zeros[0].precise.centre if self.tracked is not None else ()
        images = BallPolynomials.of(self.branch.elimination.images)
        return list(images.values(y, bits_of(WORKING_DIGITS)).mid().entries()), WRITTEN

    def carry_solution(
        self, solution: Solution, natural: NaturalCoordinates, equations: Evaluator
    ) -> Solution:
        """The solution, of this branch and of all ``equations``, in the coordinates before.

        Args:
            natural: those that it is in.
        """
        if natural.is_identity:
            return solution
        y = solution.point
        if self.zero is not None:
            x = self.zero.scale_and_shift(natural.scales, natural.origin).point
        else:
            x = natural.inverse.points(y)
        moved = np.abs(y) * natural.sizes
        rounding = np.finfo(float).eps * (np.abs(x) + (moved if self.zero is None else 0.0))
        radii = None if solution.radii is None else solution.radii * natural.sizes + rounding
        accuracy = solution.accuracy
        if self.zero is None:
            error = accuracy * (1 + np.linalg.norm(y)) * natural.sizes.max()
            accuracy = float((error + np.linalg.norm(rounding)) / (1 + np.linalg.norm(x)))
        residual = float(equations.residuals(x[None]).max(initial=0.0))
        return replace(solution, point=x, radii=radii, accuracy=accuracy, residual=residual)

    @cached_property
    def _zeros(self) -> tuple[SingularEnd, ...]:
        """The exact zeros of the system that was tracked that this may be.

        Paths end at a zero as many times as its multiplicity says: no other is meant.
        """
        if self.tracked is None:
            return ()
        equations = self.branch.elimination.system.polynomials
        y, error = _point_and_error(self.tracked)
        zeros = select_isolated(possible_zeros(equations, y, error, np.random.default_rng(0)))
        zeros = tuple(z for z in zeros if z.multiplicity == self.tracked.multiplicity)
        return choose_alike(zeros, y) if len(zeros) > 1 else zeros


def _point_and_error(solution: Solution) -> tuple[np.ndarray, float | np.ndarray]:
    """The point, and its error: of each coordinate where these are known.

    That tells simple zeros from others; in what units a multiple one is seen best, it does not say.
    """
    simple = solution.multiplicity == 1 and solution.radii is not None
    return solution.point, solution.radii if simple else solution.accuracy


@dataclass(frozen=True, eq=False)
class _SolvedBranch(BranchZeros[_Found]):
    """A branch and what was found of it.

    Attributes:
        result: of the system that was tracked; None where nothing was.
        larger: points on solution sets of positive dimension.
        undecided: shape ``(k, n)``.
    """

    result: SolveResult | None
    larger: LargerSets
    undecided: np.ndarray

    def is_in_larger(self, zero: _Found) -> bool:
        """Whether a zero of the equations is no isolated one: these were all found."""
        return bool(len(self.larger.points)) and not _near(zero, self.found)


def solve_exactly(task: SolveTask) -> SolveResult | None:
    """The isolated solutions of a system whose zeros are known exactly.

    Returns:
        None if it falls apart, or comes down neither to one variable nor to few zeros in two.
    """
    facts = task.facts.unconditional
    if task.system.n == 0 or facts.branches.parts is not None:
        return None
    branch = BranchEquations(facts.system, True, facts.branches.curved)
    whole = _solve_exact_branch(branch, facts.exact_zeros, task.system.nonzero)
    if whole is None:
        return None
    natural = NaturalCoordinates.identity(task.system.n)
    return _join_parts(task, natural, [whole], apart=False)


def solve_branches(
    task: SolveTask, others: Callable[[SolveTask], SolveResult]
) -> SolveResult | None:
    """The isolated solutions of a system that falls apart, in coordinates that suit all of it.

    Args:
        others: solves what is left of a branch, and not known exactly.

    Returns:
        None if the system is its own only branch.
    """
    system, facts = task.system, task.facts.unconditional
    if system.n == 0 or facts.branches.parts is None:
        return None
    natural = comparable_coordinates(system.polynomials, system.n)
    nonzero = natural.system(system).nonzero
    parts = []
    for each in facts.branches.parts:
        branch = BranchEquations(natural.system(each.system(facts.system)), True)
        zeros = algebraic_zeros(branch.system, two_variables=task.start == "auto")
        exact = _solve_exact_branch(branch, zeros, nonzero)
        parts.append(exact or _solve_part(branch, nonzero, task, others))
    return _join_parts(task, natural, parts, apart=True)


def _solve_exact_branch(
    branch: BranchEquations,
    zeros: Sequence[AlgebraicZero] | None,
    nonzero: Sequence[Polynomial],
) -> _SolvedBranch | None:
    """A branch that exact algebra solves; None where paths must be tracked.

    Args:
        zeros: all of them, where they are algebraic numbers of one variable.
    """
    system = branch.system
    if zeros is None and branch.kind is BranchKind.SYSTEM:
        return None
    evaluator = Evaluator.of(system.polynomials, system.n)
    none, nothing = np.zeros((0, system.n), dtype=complex), LargerSets.of(system.n)
    if zeros is not None:
        solutions = (_rounded_solution(evaluator, z.point, z.multiplicity, z.real) for z in zeros)
        known = tuple(_Found(s, branch, z) for s, z in zip(solutions, zeros, strict=True))
        return _SolvedBranch(system, known, None, nothing, none)
    if branch.kind is BranchKind.EMPTY:
        return _SolvedBranch(system, (), None, nothing, none)
    # Of a linear space, or a graph over one, every point will do.
    elimination = branch.elimination
    point = elimination.lift(np.ones((1, elimination.system.n), dtype=complex))
    if branch.kind is BranchKind.LINEAR_SPACE:
        excluded = any(branch.image(f)[1] for f in nonzero)
        return _SolvedBranch(
            system, (), None, LargerSets.of(system.n, [(point[0], excluded)]), none
        )
    found = _Found(_rounded_solution(evaluator, point[0], 1, True), branch)
    return _SolvedBranch(system, (found,), None, nothing, none)


def _rounded_solution(
    evaluator: Evaluator, x: np.ndarray, multiplicity: int, real: bool
) -> Solution:
    """A zero that is known exactly, and was rounded once."""
    condition, jacobian = 1.0, evaluator.balanced_jacobian(x)
    # A multiple zero is a simple one of the polynomial that defines it.
    if multiplicity == 1 and not np.isfinite(jacobian).all():
        condition = np.inf
    elif multiplicity == 1:
        s = np.linalg.svd(jacobian, compute_uv=False)
        condition = float(s[0] / s[-1]) if s[-1] > 0 else 1.0
    residual = float(evaluator.residuals(x[None]).max(initial=0.0))
    accuracy = float(np.finfo(float).eps / 2)
    return Solution(x, multiplicity, real, residual, accuracy, condition, 16)


def _solve_part(
    branch: BranchEquations,
    nonzero: Sequence[Polynomial],
    task: SolveTask,
    others: Callable[[SolveTask], SolveResult],
) -> _SolvedBranch:
    """A branch by what solves the system that elimination leaves of it."""
    elimination = branch.elimination
    images = tuple(branch.image(f)[0] for f in nonzero)
    result = others(task.of_part(replace(elimination.system, nonzero=images)))
    # All equations say later which of them are left out.
    solutions = (*result.solutions, *result.excluded_solutions)
    lifted = _lift_solutions(solutions, elimination)
    found = tuple(_Found(x, branch, None, s) for x, s in zip(lifted, solutions, strict=True))
    larger = result.larger.map_points(elimination.lift)
    return _SolvedBranch(branch.system, found, result, larger, elimination.lift(result.undecided))


def _lift_solutions(solutions: Sequence[Solution], elimination: Elimination) -> list[Solution]:
    """The solutions above those of ``elimination.system``.

    Their ``radii`` are known where those of the given ones are, or where more digits were needed.
    """
    if not solutions:
        return []
    given = np.array([s.point for s in solutions])
    points = elimination.lift(given)
    if len(elimination.kept) == points.shape[1]:
        return [replace(s, point=x) for s, x in zip(solutions, points, strict=True)]
    radii = [
        np.full(len(y), s.accuracy * (1 + np.linalg.norm(y))) if s.radii is None else s.radii
        for s, y in zip(solutions, given, strict=True)
    ]
    errors = elimination.lift_radii(given, np.array(radii))
    others = np.delete(np.arange(points.shape[1]), elimination.kept)
    rough = (errors > ROUGH * np.abs(points))[:, others].any(axis=1)
    lifted = []
    for s, x, error, far in zip(solutions, points, errors, rough, strict=True):
        fine = None
        if s.multiplicity == 1 and far:
            own = s.accuracy if s.radii is None else s.radii
            fine = _lift_in_digits(elimination, s.point, own)
        if fine is None:
            lifted.append(replace(s, point=x, radii=None if s.radii is None else error))
            continue
        point, zero_radii = fine
        # What is known to so many digits does not say whether it vanishes.
        known = elimination.lift_radii(s.point, zero_radii)
        lifted.append(replace(s, point=point, radii=ROUNDING * np.abs(point) + known))
    return lifted


def _lift_in_digits(
    elimination: Elimination, y: np.ndarray, error: float | np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """The point above the regular zero near ``y``, to rounding, and the errors of that zero.

    None if there is none.
    """
    equations = elimination.system.polynomials
    zeros = select_isolated(possible_zeros(equations, y, error, np.random.default_rng(0)))
    if len(zeros) != 1 or zeros[0].multiplicity != 1 or zeros[0].precise is None:
        return None
    zero = zeros[0].precise
    images = BallPolynomials.of(elimination.images).values(zero.centre, bits_of(WORKING_DIGITS))
    return doubles(images.mid().entries()), zero.radii


def _join_parts(
    task: SolveTask, natural: NaturalCoordinates, parts: Sequence[_SolvedBranch], apart: bool
) -> SolveResult:
    """The solutions of all parts, which are in ``natural`` coordinates."""
    system = task.system
    undecided = [np.zeros((0, system.n), dtype=complex), *(part.undecided for part in parts)]
    kept: list[_Found] = []
    doubtful: list[_Found] = []
    for each, repeated in find_repeats(parts, _SolvedBranch.is_in_larger):
        if not repeated:
            (doubtful if repeated is None else kept).append(each)
    undecided.append(_points(doubtful, system.n))
    solutions, left_open, excluded = _in_scheme(system, natural, kept, apart)
    undecided.append(_points(left_open, system.n))
    open_points = natural.inverse.points(np.vstack(undecided))
    larger = LargerSets.together(system.n, [part.larger for part in parts])
    larger = larger.map_points(natural.inverse.points)
    results = [part.result for part in parts if part.result is not None]
    told = [note for r in results for note in r.larger.notes]
    doubts = [n for r in results if not r.complete for n in r.notes if n not in told]
    more = len(open_points) - sum(len(part.undecided) for part in parts)
    if more:
        doubts.append(
            f"{-(-more // task.sides)} solutions of one branch may or may not lie in another, or "
            "their multiplicity was not found"
        )
    return SolveResult.of(
        system,
        task.run,
        start=next((r.start for r in results if r.start != "none"), "none"),
        reason=_reason(parts, results, apart),
        solutions=solutions,
        excluded=excluded,
        larger=larger,
        undecided=open_points,
        paths=sum((r.paths for r in results), PathStatistics()),
        doubts=doubts,
        whole=all(r.complete for r in results),
        pathless=any(r.pathless for r in results),
    )


def _reason(parts: Sequence[_SolvedBranch], results: Sequence[SolveResult], apart: bool) -> str:
    if not parts:
        return "the equations contradict each other"
    texts = []
    if apart:
        number = "one branch" if len(parts) == 1 else f"{len(parts)} branches"
        texts.append(f"{number} by the factors of the equations")
    if len(results) < len(parts):
        texts.append(f"{len(parts) - len(results)} solved exactly" if results else "solved exactly")
    texts += dict.fromkeys(r.reason for r in results if r.reason)
    return "; ".join(texts)


def _in_scheme(
    given: PolynomialSystem, natural: NaturalCoordinates, kept: Sequence[_Found], apart: bool
) -> tuple[tuple[Solution, ...], list[_Found], tuple[Solution, ...]]:
    """The solutions, as they are given, with their multiplicities in the scheme of all equations.

    Also those where that was not found, and those where a polynomial vanishes that must not, with
    the multiplicities that they have in their branches.
    """
    system = natural.system(given)
    equations = Evaluator.of(given.polynomials, given.n)
    residuals = Evaluator.of(system.polynomials, system.n).residuals(_points(kept, system.n))
    allowed: list[tuple[_Found, float]] = []
    left_open, excluded, solutions = [], [], []
    for each, residual in zip(kept, residuals, strict=True):
        forbidden = [each.vanishes(f) for f in system.nonzero]
        if any(forbidden):
            excluded.append(each.carry_solution(each.solution, natural, equations))
        elif None in forbidden:
            left_open.append(each)
        else:
            allowed.append((each, float(residual.max(initial=0.0))))
    points = [each for each, _ in allowed]
    known = (each.solution.multiplicity for each in points)
    multiplicities = multiplicities_in_scheme(system, points) if apart else known
    for (each, size), multiplicity in zip(allowed, multiplicities, strict=True):
        if not multiplicity:
            left_open.append(each)
            continue
        solution = replace(each.solution, multiplicity=multiplicity, residual=size)
        solutions.append(each.carry_solution(solution, natural, equations))
    return tuple(solutions), left_open, tuple(excluded)


def _points(found: Sequence[_Found], n: int) -> np.ndarray:
    return np.array([f.solution.point for f in found], dtype=complex).reshape(-1, n)


def _near(each: _Found, others: Sequence[_Found]) -> bool:
    """Whether an isolated solution of another branch is where this one is."""
    x = each.solution.point
    return any(
        np.linalg.norm(other.solution.point - x) < NEAR * (1 + np.linalg.norm(x))
        for other in others
    )
