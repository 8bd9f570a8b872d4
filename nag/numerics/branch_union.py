"""The union of the branches that a system falls apart into: which points stay, how multiple.

A branch's zero set is known by generic points of its components: solutions where only isolated ones
are asked for, points of witness sets else. Where all equations of another branch vanish at one, its
component lies in that zero set: it is a component of that branch too, or part of a larger one.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, TypeVar

import flint
import numpy as np

from nag.algebra.algebraic_zeros import BITS, AlgebraicZero
from nag.algebra.branch_equations import BranchEquations, BranchKind, Vanishing
from nag.algebra.evaluation import Evaluator, may_vanish
from nag.algebra.factoring import Factors, factor_into_irreducibles
from nag.algebra.generic_multiplicity import (
    generic_multiplicity,
)
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.double_ranks import Gradients, independent_gradients
from nag.numerics.zero_values import (
    NONZERO,
    multiplicity_of_all,
    possible_zeros,
    vanishes_at_point,
    widen_point,
)

# Points at which gradients are looked at together.
BLOCK = 1024
# A point, in doubles or in balls, and how far the exact one may be from it.
PointWithError = tuple["np.ndarray | Sequence[flint.acb]", "float | np.ndarray"]


class GenericPoint(ABC):
    """A generic point of a component of a branch.

    Attributes:
        branch: the equations of the branch.
        zero: the exact zero, where it is one of an algebraic branch.
        dimension: of the component.
        rows: slice that the point is isolated on, on ``(1, x)``; None if it is without one.
    """

    branch: BranchEquations
    zero: AlgebraicZero | None
    dimension: int = 0
    rows: np.ndarray | None = None

    @property
    @abstractmethod
    def points(self) -> np.ndarray:
        """Generic points of the component that are known, in doubles, shape ``(P, n)``."""

    @property
    @abstractmethod
    def point(self) -> np.ndarray:
        """One of them, shape ``(n,)``."""

    @property
    @abstractmethod
    def radii(self) -> np.ndarray | None:
        """Errors of the coordinates, shape ``(n,)``, where they are known: of isolated points."""

    @property
    @abstractmethod
    def multiplicity_in_branch(self) -> int:
        """That of the component in the scheme of the branch; 0 if it is not known."""

    @abstractmethod
    def vanishes_in_digits(self, f: Polynomial, image: Polynomial) -> bool | None:
        """Whether a polynomial vanishes where neither doubles nor algebra say so.

        Args:
            image: the polynomial in the variables that elimination leaves.
        """

    @property
    @abstractmethod
    def error(self) -> float | np.ndarray:
        """How far the coordinates of `point` may be from the exact ones; a number or one each."""

    @abstractmethod
    def in_digits(self) -> PointWithError:
        """The point as well as it is known, and its error as `possible_zeros` takes it."""

    @cached_property
    def vanishes(self) -> Vanishing:
        """Whether a polynomial vanishes on the component; None where that is not known."""
        return Vanishing(self._vanishes)

    def _vanishes(self, f: Polynomial) -> bool | None:
        if self.zero is not None and f.exact:
            return self.zero.vanishes(f)
        if (Evaluator.of([f], f.n).residuals(self.points) > NONZERO).any():
            return False
        if (
            self.radii is not None
            and vanishes_at_point(f, widen_point(self.point, self.radii)) is False
        ):
            return False
        image, zero = self.branch.image(f)
        if zero or self.branch.kind in (BranchKind.POINT, BranchKind.LINEAR_SPACE):
            return zero
        return self.vanishes_in_digits(f, image)

    def has_independent_gradients(self, polynomials: Sequence[Polynomial]) -> bool:
        """Whether the gradients of polynomials are certainly independent at the point."""
        if self.zero is not None and all(f.exact for f in polynomials):
            return self.zero.independent(polynomials)
        return independent_gradients(polynomials, self.point, self.error)

    def multiplicity_in(self, generators: Sequence[Polynomial]) -> int:
        """The dimension of the local ring of polynomials at the point; 0 if it is not found."""
        x, error = self.in_digits() if self.zero is None else (self.zero.known_to(BITS), 2.0**-BITS)
        zeros = possible_zeros(generators, x, error, np.random.default_rng(0), self.rows)
        return multiplicity_of_all(zeros) or 0


P = TypeVar("P", bound=GenericPoint)


@dataclass(frozen=True, eq=False)
class BranchZeros(Generic[P]):
    """A branch of a system, by generic points of its components."""

    system: PolynomialSystem
    found: tuple[P, ...]


B = TypeVar("B", bound=BranchZeros[Any])


def find_repeats(
    branches: Sequence[B], is_in_larger: Callable[[B, Any], bool | None]
) -> Iterator[tuple[Any, bool | None]]:
    """Each point, and whether another branch has its component.

    That is one in which its component is part of a larger one, or an earlier one that has it too.
    None where it is not known.

    Args:
        is_in_larger: whether a point of another branch, which is a zero of a branch's equations,
            lies on a component of this branch that is larger than its own; None if not known.
    """
    found = [p for branch in branches for p in branch.found]
    if not found:
        return
    systems = [branch.system.polynomials for branch in branches]
    near = iter(may_vanish(systems, np.array([p.point for p in found]), NONZERO))
    for i, branch in enumerate(branches):
        for point, close in zip(branch.found, near, strict=False):
            others = (j for j in np.flatnonzero(close).tolist() if j != i)
            yield point, _any(_is_repeated(point, branches[j], j < i, is_in_larger) for j in others)


def _is_repeated(
    point: GenericPoint, other: B, earlier: bool, is_in_larger: Callable[[B, Any], bool | None]
) -> bool | None:
    unknown = False
    for f in other.system.polynomials:
        answer = point.vanishes(f)
        if answer is False:
            return False
        unknown |= answer is None
    if unknown:
        return None
    return earlier or is_in_larger(other, point)


def _any(answers: Iterator[bool | None]) -> bool | None:
    unknown = False
    for answer in answers:
        if answer:
            return True
        unknown |= answer is None
    return None if unknown else False


def multiplicities_in_scheme(
    system: PolynomialSystem, found: Sequence[GenericPoint]
) -> Iterator[int]:
    """The multiplicities of the points' components in the scheme of all equations; 0 if not found.

    Args:
        system: the equations, which need not be those of a branch.
    """
    equations = [factor_into_irreducibles(f) for f in system.polynomials if f]
    factors = [*dict.fromkeys(p for each in equations for p, _ in each)]
    gradients = Gradients.of([f for f in system.polynomials if f], system.n)
    counts = [len(each.points) for each in found]
    points = np.concatenate([each.points for each in found]) if found else np.zeros((0, system.n))
    far = Evaluator.of(factors, system.n).residuals(points) > NONZERO
    ranks = _ranks_in_blocks(gradients, found)
    parts = np.split(far, np.cumsum(counts)[:-1])
    for each, rows, rank in zip(found, parts, ranks, strict=bool(found)):
        nonzero = rows.any(axis=0)
        each.vanishes.exclude(p for p, there in zip(factors, nonzero, strict=True) if there)
        yield _multiplicity(equations, rank, each)


def _ranks_in_blocks(gradients: Gradients, found: Sequence[GenericPoint]) -> Iterator[int]:
    """How many gradients are certainly independent at each point."""
    for first in range(0, len(found), BLOCK):
        block = found[first : first + BLOCK]
        errors = [np.broadcast_to(each.error, each.point.shape) for each in block]
        points = np.array([each.point for each in block])
        yield from gradients.ranks(points, np.array(errors)).tolist()


def _multiplicity(equations: Sequence[Factors], rank: int, each: GenericPoint) -> int:
    codimension = len(each.point) - each.dimension
    # A scheme is reduced where as many gradients are independent as its codimension.
    if each.multiplicity_in_branch == 1 and rank >= codimension:
        return 1
    own = each.zero is None and each.multiplicity_in_branch
    if own and each.branch.is_own_ring(equations, each.vanishes):
        return each.multiplicity_in_branch
    return generic_multiplicity(
        equations,
        codimension,
        each.vanishes,
        each.has_independent_gradients,
        each.multiplicity_in,
    )
