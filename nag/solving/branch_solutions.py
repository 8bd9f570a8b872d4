"""Isolated solutions of systems that fall apart exactly: those of the branches, joined.

Branches whose zeros are algebraic numbers of one variable are solved exactly, the others by
tracking paths.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np

from nag.algebra.algebraic_zeros import BITS, AlgebraicZero, algebraic_zeros
from nag.algebra.branch_equations import BranchEquations, BranchKind, Vanishing
from nag.algebra.branches import branches
from nag.algebra.evaluation import Evaluator, may_vanish
from nag.algebra.factoring import Factors, factored
from nag.algebra.generic_multiplicity import (
    generic_multiplicity,
    independent_gradients,
)
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.scaling import scaled_at
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import (
    NONZERO,
    SLACK,
    WRITTEN,
    alike,
    multiplicity_of_all,
    possible_zeros,
    surely_differs,
    vanishes_at_all,
    widened,
)
from nag.solving.larger_sets import LargerSets
from nag.solving.lifted_solution import lifted_solution
from nag.solving.missing_zeros import DIGITS
from nag.solving.solutions import PathStatistics, Solution, SolveResult

# Solutions that may be the same, found in two branches: relative distance.
NEAR = 1e-7
# Digits to compute with.
WORKING = 120

Tracked = Callable[[PolynomialSystem], SolveResult]


@dataclass(frozen=True, eq=False)
class _Found:
    """A solution of one branch.

    Attributes:
        zero: the exact zero, where it is one of an algebraic branch.
        branch: of any other, what led there from its equations.
        tracked: the solution of the system that was left; None where elimination left one point.
    """

    solution: Solution
    zero: AlgebraicZero | None = None
    branch: BranchEquations | None = None
    tracked: Solution | None = None

    @cached_property
    def vanishes(self) -> Vanishing:
        """Whether a polynomial vanishes at the exact zero."""
        return Vanishing(self._vanishes)

    def _vanishes(self, f: Polynomial) -> bool | None:
        x = self.solution.point
        if self.zero is not None and f.exact:
            return self.zero.vanishes(f)
        if Evaluator.of([f], f.n).residuals(x[None])[0, 0] > NONZERO:
            return False
        if self.zero is not None:
            return None
        radii = self.solution.radii if self.solution.multiplicity == 1 else None
        if radii is not None and surely_differs(f, x, radii):
            return False
        assert self.branch is not None
        image, zero = self.branch.image(f)
        if zero or self.tracked is None:
            return zero
        return vanishes_at_all(self._zeros, image)

    @cached_property
    def _zeros(self) -> tuple[SingularEnd, ...]:
        """The exact zeros of the system that was tracked that this may be.

        Paths end at a zero as many times as its multiplicity says: no other is meant.
        """
        assert self.branch is not None
        assert self.tracked is not None
        equations = self.branch.elimination.system.polynomials
        y, error = _known(self.tracked)
        zeros = possible_zeros(equations, y, error, np.random.default_rng(0))
        zeros = tuple(z for z in zeros if z.multiplicity == self.tracked.multiplicity)
        return alike(zeros, y) if len(zeros) > 1 else zeros

    @cached_property
    def in_digits(self) -> list[Any] | None:
        """The coordinates to 100 digits (FLINT's ``acb``) where it is known which zero this is."""
        if self.tracked is not None and len(self._zeros) != 1:
            return None
        import flint

        from nag.numerics.digits import number, point

        assert self.branch is not None
        with flint.ctx.workdps(WORKING):
            y = point(self._zeros[0].digits) if self.tracked is not None else []
            return [flint.acb(f(y, number)).mid() for f in self.branch.elimination.images]


def _known(solution: Solution) -> tuple[np.ndarray, float | np.ndarray]:
    """The point, and its error: of each coordinate where these are known.

    That tells simple zeros from others; in what units a multiple one is seen best, it does not say.
    """
    simple = solution.multiplicity == 1 and solution.radii is not None
    return solution.point, solution.radii if simple else solution.accuracy


@dataclass(frozen=True, eq=False)
class _Part:
    """A branch and what was found of it.

    Attributes:
        result: of the system that was tracked; None where nothing was.
        larger: points on solution sets of positive dimension.
        undecided: shape ``(k, n)``.
    """

    system: PolynomialSystem
    found: tuple[_Found, ...]
    result: SolveResult | None
    larger: LargerSets
    undecided: np.ndarray

    @property
    def finite(self) -> bool:
        """Whether nothing says that its zero set has positive dimension."""
        return not len(self.larger.points)


def solve_apart(
    system: PolynomialSystem, tracked: Tracked, seed: int, settings: str, exactly: bool
) -> SolveResult | None:
    """The isolated solutions of a system that falls apart, or has zeros that are known exactly.

    Args:
        tracked: solves a system as a whole.
        exactly: whether to solve exactly also what does not fall apart, or leaves two variables.

    Returns:
        None if the system neither falls apart nor comes down to one variable.
    """
    if system.n == 0:
        return None
    apart = branches(replace(system, nonzero=()))
    if apart is None:
        branch = BranchEquations(replace(system, nonzero=()), graphs=True)
        whole = _exact(branch, system.nonzero) if exactly else None
        if whole is None:
            return None
        parts = [whole]
    else:
        every = [BranchEquations(b.system(replace(system, nonzero=())), True) for b in apart]
        parts = [_part(branch, system.nonzero, tracked, exactly) for branch in every]
    return _joined(system, parts, seed, settings, apart is not None)


def _exact(
    branch: BranchEquations, nonzero: Sequence[Polynomial], two_variables: bool = True
) -> _Part | None:
    """A branch that exact algebra solves; None where paths must be tracked."""
    system = branch.system
    zeros = algebraic_zeros(system, two_variables)
    if zeros is None and branch.kind is BranchKind.SYSTEM:
        return None
    evaluator = Evaluator.of(system.polynomials, system.n)
    none, nothing = np.zeros((0, system.n), dtype=complex), LargerSets.of(system.n)
    if zeros is not None:
        known = ((_rounded_solution(evaluator, z.point, z.multiplicity, z.real), z) for z in zeros)
        return _Part(system, tuple(_Found(*each) for each in known), None, nothing, none)
    if branch.kind is BranchKind.EMPTY:
        return _Part(system, (), None, nothing, none)
    # Of a linear space, or a graph over one, every point will do.
    elimination = branch.elimination
    point = elimination.lift(np.ones((1, elimination.system.n), dtype=complex))
    if branch.kind is BranchKind.LINEAR_SPACE:
        excluded = any(branch.image(f)[1] for f in nonzero)
        return _Part(system, (), None, LargerSets.of(system.n, [(point[0], excluded)]), none)
    found = _Found(_rounded_solution(evaluator, point[0], 1, True), None, branch)
    return _Part(system, (found,), None, nothing, none)


def _rounded_solution(
    evaluator: Evaluator, x: np.ndarray, multiplicity: int, real: bool
) -> Solution:
    """A zero that is known exactly, and was rounded once."""
    s = np.linalg.svd(evaluator.balanced_jacobian(x), compute_uv=False)
    # A multiple zero is a simple one of the polynomial that defines it.
    condition = float(s[0] / s[-1]) if multiplicity == 1 and s[-1] > 0 else 1.0
    residual = float(evaluator.residuals(x[None]).max(initial=0.0))
    accuracy = float(np.finfo(float).eps / 2)
    return Solution(x, multiplicity, real, residual, accuracy, condition, 16)


def _part(
    branch: BranchEquations, nonzero: Sequence[Polynomial], tracked: Tracked, exactly: bool
) -> _Part:
    part = _exact(branch, nonzero, two_variables=exactly)
    if part is not None:
        return part
    elimination = branch.elimination
    images = tuple(branch.image(f)[0] for f in nonzero)
    result = tracked(replace(elimination.system, nonzero=images))
    # All equations say later which of them are left out.
    solutions = (*result.solutions, *result.excluded_solutions)
    found = tuple(_Found(lifted_solution(s, elimination), None, branch, s) for s in solutions)
    larger = result.larger.mapped(elimination.lift)
    return _Part(branch.system, found, result, larger, elimination.lift(result.undecided))


def _joined(
    system: PolynomialSystem, parts: Sequence[_Part], seed: int, settings: str, apart: bool
) -> SolveResult:
    undecided = [np.zeros((0, system.n), dtype=complex), *(part.undecided for part in parts)]
    kept: list[_Found] = []
    systems = [part.system.polynomials for part in parts]
    points = _points([f for part in parts for f in part.found], system.n)
    near = iter(may_vanish(systems, points, NONZERO))
    for i, part in enumerate(parts):
        close = list(islice(near, len(part.found)))
        isolated, left_open = _own(i, parts, close)
        kept += isolated
        undecided.append(_points(left_open, system.n))
    solutions, left_open, excluded = _in_scheme(system, kept, apart)
    undecided.append(_points(left_open, system.n))
    open_points = np.vstack(undecided)
    larger = LargerSets.together(system.n, [part.larger for part in parts])
    results = [part.result for part in parts if part.result is not None]
    notes = [note for r in results if not r.complete for note in r.notes]
    notes = [note for note in notes if note not in [n for r in results for n in r.larger.notes]]
    more = len(open_points) - sum(len(part.undecided) for part in parts)
    if more:
        notes.append(
            f"{more} solutions of one branch may or may not lie in another, or their multiplicity "
            "was not found"
        )
    complete = all(r.complete for r in results) and not notes
    notes += larger.notes
    return SolveResult(
        system=system,
        solutions=solutions,
        on_components=larger.counting,
        undecided=open_points,
        excluded=len(excluded),
        paths=sum((r.paths for r in results), PathStatistics()),
        start=next((r.start for r in results if r.start != "none"), "none"),
        reason=_reason(parts, results, apart),
        seed=seed,
        settings=settings,
        complete=complete,
        notes=tuple(dict.fromkeys(notes)),
        excluded_solutions=excluded,
        pathless=any(r.pathless for r in results),
        on_excluded=larger.excluded,
        on_doubtful=larger.doubtful,
    )


def _reason(parts: Sequence[_Part], results: Sequence[SolveResult], apart: bool) -> str:
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
    system: PolynomialSystem, kept: Sequence[_Found], apart: bool
) -> tuple[tuple[Solution, ...], list[_Found], tuple[Solution, ...]]:
    """The solutions with their multiplicities in the scheme of all equations.

    Also those where that was not found, and those where a polynomial vanishes that must not, with
    the multiplicities that they have in their branches.
    """
    equations = [factored(f) for f in system.polynomials if f]
    factors = [*dict.fromkeys(p for each in equations for p, _ in each)]
    points = _points(kept, system.n)
    far = Evaluator.of(factors, system.n).residuals(points) > NONZERO
    residuals = Evaluator.of(system.polynomials, system.n).residuals(points)
    solutions, left_open, excluded = [], [], []
    for each, nonzero, residual in zip(kept, far, residuals, strict=True):
        forbidden = [each.vanishes(f) for f in system.nonzero]
        if any(forbidden):
            excluded.append(each.solution)
            continue
        multiplicity = each.solution.multiplicity
        if apart:
            each.vanishes.exclude(p for p, there in zip(factors, nonzero, strict=True) if there)
            multiplicity = _multiplicity(equations, each)
        if not multiplicity or None in forbidden:
            left_open.append(each)
            continue
        size = float(residual.max(initial=0.0))
        solutions.append(replace(each.solution, multiplicity=multiplicity, residual=size))
    return tuple(solutions), left_open, tuple(excluded)


def _points(found: Sequence[_Found], n: int) -> np.ndarray:
    return np.array([f.solution.point for f in found], dtype=complex).reshape(-1, n)


def _own(
    i: int, parts: Sequence[_Part], near: Sequence[np.ndarray]
) -> tuple[list[_Found], list[_Found]]:
    """The solutions of a branch that are isolated, and no ones of an earlier branch.

    Also those that are left open.

    Args:
        near: for each solution in which branches it may lie, shape ``(branches,)``.
    """
    isolated: list[_Found] = []
    left_open: list[_Found] = []
    for each, close in zip(parts[i].found, near, strict=True):
        place: list[_Found] | None = isolated
        for j in np.flatnonzero(close).tolist():
            if j == i:
                continue
            there = [each.vanishes(f) for f in parts[j].system.polynomials]
            if False in there:
                continue
            if None in there:
                place = left_open
                break
            alone = parts[j].finite or _near(each, parts[j].found)
            if j < i or not alone:
                place = None
            if not alone:
                break
        if place is not None:
            place.append(each)
    return isolated, left_open


def _near(each: _Found, others: Sequence[_Found]) -> bool:
    """Whether an isolated solution of another branch is where this one is."""
    x = each.solution.point
    return any(
        np.linalg.norm(other.solution.point - x) < NEAR * (1 + np.linalg.norm(x))
        for other in others
    )


def _multiplicity(equations: Sequence[Factors], each: _Found) -> int:
    """The multiplicity of a solution in the scheme of all equations; 0 if it was not found."""
    x, accuracy = each.solution.point, each.solution.accuracy
    if each.branch is not None and each.branch.is_own_ring(equations, each.vanishes):
        return each.solution.multiplicity

    def independent(polynomials: Sequence[Polynomial]) -> bool:
        if each.zero is not None and all(f.exact for f in polynomials):
            return each.zero.independent(polynomials)
        if each.solution.precision >= DIGITS:
            # Each coordinate is known to rounding, however small it is beside the others.
            return independent_gradients(*scaled_at(polynomials, x), SLACK * accuracy)
        if each.solution.radii is not None:
            return independent_gradients(polynomials, x, SLACK * each.solution.radii)
        return independent_gradients(polynomials, x, widened(x, accuracy))

    def by_local_ring(generators: Sequence[Polynomial]) -> int | None:
        at, error = _known(each.solution)
        if each.zero is not None:
            at, error = each.zero.known_to(BITS), 2.0**-BITS
        elif each.in_digits is not None:
            # Zeros of other branches may be close to it.
            at, error = each.in_digits, WRITTEN
        return multiplicity_of_all(possible_zeros(generators, at, error, np.random.default_rng(0)))

    return generic_multiplicity(equations, len(x), each.vanishes, independent, by_local_ring)
