"""Branches of a zero set and their components: what vanishes on them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.algebraic_zeros import AlgebraicZero
from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.vanishing import Vanishing, follows
from nag.numerics.singular_point import SingularEnd
from nag.numerics.small_values import NONZERO
from nag.numerics.zero_values import alike, possible_zeros, vanishes_at_all
from nag.witness.confirm import vanishing
from nag.witness.fibres import Fibre
from nag.witness.membership import component_fibres
from nag.witness.multiplicity import ACCURACY
from nag.witness.witness import Decomposition, WitnessSet


@dataclass(frozen=True, eq=False)
class Equations:
    """The equations of a branch, and what is left of them when linear ones are solved."""

    system: PolynomialSystem

    @cached_property
    def elimination(self) -> Elimination:
        return eliminate_linear(self.system, graphs=False)


@dataclass(frozen=True, eq=False)
class Component:
    """A component of a branch.

    Attributes:
        branch: the branch.
        zero: the exact zero, where it is one of an algebraic branch.
    """

    witness: WitnessSet
    branch: Equations
    zero: AlgebraicZero | None = None

    @property
    def system(self) -> PolynomialSystem:
        return self.branch.system

    @cached_property
    def vanishes(self) -> Vanishing:
        """Whether a polynomial vanishes on the component."""
        return Vanishing(self._vanishes)

    def _vanishes(self, f: Polynomial) -> bool | None:
        if self.zero is not None and f.exact:
            return self.zero.vanishes(f)
        if (Evaluator.of([f], f.n).residuals(self.witness.points) > NONZERO).any():
            return False
        elimination = self.branch.elimination
        image = f.compose(elimination.images)
        if not elimination.system.polynomials and f.exact:
            return not image
        if follows(image, elimination):
            return True
        fibre = self._fibre
        if fibre is None:
            # Doubles do not see that the points are regular.
            return vanishes_at_all(self.zeros, f)
        answer = vanishing(fibre.cut, f, self.witness.slice.rows, fibre.points[:1])[0]
        return vanishes_at_all(self.zeros, f) if answer is None else answer

    @cached_property
    def _fibre(self) -> Fibre | None:
        """The points with equations that cut them; None where these are not regular zeros."""
        try:
            return component_fibres(self.system, self.witness)[0]
        except ValueError:
            return None

    @cached_property
    def zeros(self) -> tuple[SingularEnd, ...]:
        """The exact zeros on the slice that the first point may stand for."""
        x, rows = self.witness.points[0], self.witness.slice.rows
        accuracy = self.witness.accuracy
        if self.witness.fibres or self.witness.multiplicity != 1:
            # Of what was sharpened by a deflation no more is known.
            accuracy = max(accuracy, ACCURACY)
        rng = np.random.default_rng(0)
        zeros = possible_zeros(self.system.polynomials, x, accuracy, rng, rows)
        return alike(zeros, x) if len(zeros) > 1 else zeros


@dataclass(frozen=True, eq=False)
class Part:
    """A branch and its components."""

    system: PolynomialSystem
    components: tuple[Component, ...]
    answer: Decomposition | None
