"""A system as it is tracked: as many equations as variables, in scaled variables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from math import prod

import numpy as np

from nag.algebra.combinations import of_lowest_degrees
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, find_symmetries
from nag.algebra.system import PolynomialSystem
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import PointMap
from nag.numerics.natural_coordinates import NaturalCoordinates, natural_coordinates
from nag.numerics.precise_point import PrecisePoint, precise_zero
from nag.numerics.zero_values import (
    NONZERO,
    all_vanish,
    possible_zeros,
    vanishes_at_all,
    vanishes_at_point,
)
from nag.solving.isolated_zero import IsolatedZero
from nag.solving.start.choice import FEW
from nag.solving.start.target import Target, most_digits


@dataclass(frozen=True, eq=False)
class SquareProblem:
    """A system, the square one that is tracked, and both in scaled variables.

    Attributes:
        equations: the system's equations, or combinations of lower degrees, in the scaled
            variables.
        nonzero: polynomials that must not vanish, in the scaled variables.
        added: number of random linear equations that cut a solution set of positive dimension.
        squared: whether the square system has solutions that the equations have not.
        sides: 2 where the imaginary unit is an unknown, of whose two values one is asked for.
    """

    system: PolynomialSystem
    equations: tuple[Polynomial, ...]
    nonzero: tuple[Polynomial, ...]
    target: Target
    added: int
    squared: bool
    sides: int = 1

    def on_one_side(self, zeros: int) -> int:
        """How many of so many zeros are asked for: the others are their conjugates."""
        return -(-zeros // self.sides)

    @classmethod
    def of(
        cls,
        system: PolynomialSystem,
        equations: Sequence[Polynomial],
        rng: np.random.Generator,
        natural: NaturalCoordinates | None = None,
    ) -> SquareProblem:
        """The problem for equations of a system, none of them zero.

        Args:
            natural: the coordinates that suit these, if they are known.
        """
        n = system.n
        # Combinations of equations may hide where these come from, and have more digits.
        natural = natural or natural_coordinates(equations, n)
        equations = [natural.polynomial(f) for f in equations]
        digits = most_digits(equations)
        lower = of_lowest_degrees(equations)
        # Of more paths, start systems with the monomials of the equations as given spare as many.
        equations = lower if prod(f.degree for f in lower) <= FEW else equations
        added = max(0, n - len(equations))
        whole = [*equations, *(_random_linear(n, rng) for _ in range(added))]
        target = Target.of(_square_up(whole, n, rng), n, digits, natural)
        nonzero = tuple(target.scaled(f) for f in system.nonzero)
        if len(equations) + added == n:
            mended = tuple(Polynomial(n, terms) for terms in target.given)
        else:
            mended = tuple(target.scaled(natural.inverse.polynomial(f)) for f in whole)
        return cls(system, mended, nonzero, target, added, len(equations) > n)

    @classmethod
    def as_given(cls, system: PolynomialSystem) -> SquareProblem:
        """The problem for as many equations as variables, in the variables that they are given in.

        Raises:
            nag.NagError: if there are more or fewer.
        """
        target = Target(system.n, tuple(dict(f.terms) for f in system.polynomials))
        return cls(system, system.polynomials, system.nonzero, target, 0, False)

    @cached_property
    def symmetry_maps(self) -> tuple[PointMap, ...]:
        """What symmetries of the system do in the scaled variables; none where it was cut."""
        if self.added:
            return ()

        def carry(g: SignedPermutation, y: np.ndarray) -> np.ndarray:
            return self.target.scaled_points(g.of_point(self.target.original(y)))

        return tuple(partial(carry, g) for g in find_symmetries(self.system))

    def solves(self, x: np.ndarray) -> bool | None:
        """Whether all equations vanish at the square system's exact zero near ``x``.

        None if there is no such zero.
        """
        zero = self._zero(x)
        return None if zero is None else all_vanish(self.equations, zero)

    def may_be_excluded(self, x: np.ndarray) -> bool:
        """Whether a polynomial that must not vanish seems to do so at a point."""
        return bool((self._nonzero.residuals(x[None]) <= NONZERO).any()) if self.nonzero else False

    def is_excluded(self, found: IsolatedZero) -> bool | None:
        """Whether a polynomial that must not vanish does at a zero; None if that is not known."""
        x = found.point
        values = self._nonzero.residuals(x[None])[0]
        near = [g for g, value in zip(self.nonzero, values, strict=True) if value <= NONZERO]
        if not near:
            return False
        zero = self._zero(x) if found.multiplicity == 1 and found.fine is None else None
        if zero is not None:
            answers = [vanishes_at_point(g, zero) for g in near]
            return True if True in answers else None if None in answers else False
        start, error = x, found.accuracy
        if found.fine is not None:
            start, error = found.fine.centre, found.fine.error
        zeros = possible_zeros(self.equations, start, error, np.random.default_rng(0))
        answers = [vanishes_at_all(zeros, g) for g in near]
        return True if True in answers else None if None in answers else False

    def _zero(self, x: np.ndarray) -> PrecisePoint | None:
        """The square system's exact zero near ``x``, if there is one."""
        return precise_zero(self._square, x)

    @cached_property
    def _nonzero(self) -> Evaluator:
        return Evaluator.of(self.nonzero, self.target.n)

    @cached_property
    def _square(self) -> BallPolynomials:
        return BallPolynomials.of([Polynomial(self.target.n, dict(r)) for r in self.target.rows])


def _random_linear(n: int, rng: np.random.Generator) -> Polynomial:
    weights = [Fraction(int(w), 128) for w in rng.integers(-128, 129, n + 1)]
    terms = {(0,) * n: weights[n]}
    for i in range(n):
        terms[tuple(int(j == i) for j in range(n))] = weights[i] or Fraction(1)
    return Polynomial(n, terms)


def _square_up(polynomials: list[Polynomial], n: int, rng: np.random.Generator) -> list[Polynomial]:
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
