"""The equations of a branch of a system, and what follows from them; each is worked out once.

Whether polynomials vanish on a component is said as far as exact algebra shows it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property

from nag.algebra.elimination import (
    Elimination,
    eliminate_linear,
    linear_variables,
    use_linear,
)
from nag.algebra.factoring import Factors, factor_into_irreducibles
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem


@dataclass(frozen=True, eq=False)
class Vanishing:
    """Whether polynomials vanish on a component; each is decided once.

    Attributes:
        decide: decides it; None where that is not known.
    """

    decide: Callable[[Polynomial], bool | None]
    _known: dict[Polynomial, bool | None] = field(default_factory=dict)

    def __call__(self, f: Polynomial) -> bool | None:
        if f not in self._known:
            self._known[f] = self.decide(f)
        return self._known[f]

    def exclude(self, polynomials: Iterable[Polynomial]) -> None:
        """Take note of polynomials that certainly do not vanish."""
        self._known.update(dict.fromkeys(polynomials, False))


def follows(image: Polynomial, elimination: Elimination) -> bool:
    """Whether a polynomial, in the variables that are left, vanishes where a system does.

    That is seen where it is zero, or has a factor that is one of the irreducible equations.
    """
    return not image or any(
        p in elimination.irreducible for p, _ in factor_into_irreducibles(image)
    )


class BranchKind(Enum):
    """What elimination shows a branch to be."""

    EMPTY = "no points"
    POINT = "one point"
    LINEAR_SPACE = "a linear space, or the graph of polynomials over one"
    SYSTEM = "the zeros of equations that are left"


@dataclass(frozen=True, eq=False)
class BranchEquations:
    """A branch of a system, which all its components share.

    Attributes:
        graphs: whether equations of degree two and more are solved for variables as well.
        curved: whether it is known before that elimination ends with equations left.
    """

    system: PolynomialSystem
    graphs: bool
    curved: bool = False
    _images: dict[Polynomial, tuple[Polynomial, bool]] = field(default_factory=dict)
    _own: dict[frozenset[Polynomial], bool] = field(default_factory=dict)

    @cached_property
    def elimination(self) -> Elimination:
        """The way to fewer variables."""
        return eliminate_linear(self.system, graphs=self.graphs)

    @cached_property
    def kind(self) -> BranchKind:
        """What the branch is, as far as elimination shows.

        Its dimension, where no equation is left, is the number of variables that are. It has no
        points where a polynomial that must not vanish does so identically.
        """
        if not self.system.nonzero and (self.curved or self._is_solved):
            return BranchKind.SYSTEM
        reduced = self.elimination.system
        if any(f.degree == 0 for f in reduced.polynomials) or not all(reduced.nonzero):
            return BranchKind.EMPTY
        if reduced.polynomials:
            return BranchKind.SYSTEM
        return BranchKind.LINEAR_SPACE if reduced.n else BranchKind.POINT

    @property
    def _is_solved(self) -> bool:
        """Whether there is nothing to solve but linear equations for variables of their own.

        The others are then those that are left.
        """
        equations = [f for f in self.system.polynomials if f]
        curved = [f for f in equations if f.degree > 1]
        if not curved or (self.graphs and any(linear_variables(f) for f in curved)):
            return False
        often = Counter(i for f in equations for i in f.support)
        linear = [f for f in equations if f.degree <= 1]
        return all(any(often[i] == 1 for i in f.support) for f in linear)

    def image(self, f: Polynomial) -> tuple[Polynomial, bool]:
        """A polynomial in the variables that are left, and whether it is seen to vanish there."""
        if f not in self._images:
            image = f.compose(self.elimination.images)
            self._images[f] = image, follows(image, self.elimination)
        return self._images[f]

    def is_own_ring(
        self, equations: Sequence[Factors], vanishes: Callable[[Polynomial], bool | None]
    ) -> bool:
        """Whether it has the local ring of all equations at a generic point of a component.

        So it is where one simple factor of each equation may vanish there, and these are the
        branch's, perhaps when the linear ones have been used: the others are units.
        """
        there = [[(p, k) for p, k in factors if vanishes(p) is not False] for factors in equations]
        if not all(len(own) == 1 and own[0][1] == 1 for own in there):
            return False
        given = frozenset(own[0][0] for own in there)
        if given not in self._own:
            self._own[given] = self._has(given)
        return self._own[given]

    def _has(self, given: frozenset[Polynomial]) -> bool:
        """Whether other equations have the same ideal, once their linear ones have been used."""
        linear = {p for p in given if p.degree == 1}
        branch = set(self.system.polynomials)
        if linear != {p for p in branch if p.degree == 1}:
            return False
        rules = sorted(linear, key=str)
        return _use_linear(rules, given - linear) == _use_linear(rules, branch - linear)


def _use_linear(linear: Sequence[Polynomial], others: Collection[Polynomial]) -> set[Polynomial]:
    """Polynomials in which linear equations have been used, up to constants."""
    rules, rest = list(linear), list(others)
    while rules:
        p = rules.pop()
        if p.degree != 1:
            continue
        rules, rest = use_linear(p, rules), use_linear(p, rest)
    return {f * (1 / f.terms[max(f.terms)]) for f in rest if f}
