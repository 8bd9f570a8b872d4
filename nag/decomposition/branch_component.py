"""A component of a branch of a system: what vanishes on it, and which zeros its points are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.algebraic_zeros import AlgebraicZero
from nag.algebra.branch_equations import BranchEquations, BranchKind, Vanishing
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.numerics.zero_values import (
    NONZERO,
    WRITTEN,
    surely_differs,
    vanishes_at_all,
)
from nag.witness.component_equations import component_fibres
from nag.witness.confirm import vanishing
from nag.witness.exact_points import exact_zeros
from nag.witness.fibres import Fibre
from nag.witness.witness import WitnessSet


@dataclass(frozen=True, eq=False)
class BranchComponent:
    """A component of a branch.

    Attributes:
        zero: the exact zero, where it is one of an algebraic branch.
    """

    witness: WitnessSet
    branch: BranchEquations
    zero: AlgebraicZero | None = None

    @cached_property
    def vanishes(self) -> Vanishing:
        """Whether a polynomial vanishes on the component."""
        return Vanishing(self._vanishes)

    def _vanishes(self, f: Polynomial) -> bool | None:
        if self.zero is not None and f.exact:
            return self.zero.vanishes(f)
        if (Evaluator.of([f], f.n).residuals(self.witness.points) > NONZERO).any():
            return False
        known = self._each_known and self.witness.multiplicity == 1
        if known and surely_differs(f, self.witness.points[0], self.witness.radii[0]):
            return False
        _, zero = self.branch.image(f)
        if zero or self.branch.kind in (BranchKind.POINT, BranchKind.LINEAR_SPACE):
            return zero
        multiple = self._isolated and self.witness.multiplicity != 1
        fibre = None if multiple and self.zeros else self._fibre
        if fibre is None:
            # Doubles do not see that the points are regular, or are of a zero known to 100 digits.
            return vanishes_at_all(self.zeros, f)
        first = fibre.only(np.arange(len(fibre)) == 0)
        (answer,) = vanishing(first.cut, f, self.witness.slice.rows, first.points, first.fine)
        return vanishes_at_all(self.zeros, f) if answer is None else answer

    @property
    def _isolated(self) -> bool:
        """Whether it is a point that paths ended at."""
        return not self.witness.fibres and not self.witness.dimension

    @property
    def _each_known(self) -> bool:
        """Whether it is a point of which the error of each coordinate is known."""
        return self._isolated and bool(np.ptp(self.witness.radii[0]) > 0)

    def place_among(self, equations: Sequence[Polynomial]) -> Place:
        """Where it lies among zeros of others, if it is an isolated point and one of these."""
        if self.witness.dimension or self.zero is not None or len(self.zeros) != 1:
            return Place.UNDECIDED
        rng = np.random.default_rng(0)
        return analyse(equations, self.zeros[0].digits, WRITTEN, rng, place_only=True).place

    @cached_property
    def _fibre(self) -> Fibre | None:
        """The points with equations that cut them; None where these are not regular zeros."""
        try:
            return component_fibres(self.branch.system, self.witness)[0]
        except ValueError:
            return None

    @cached_property
    def zeros(self) -> tuple[SingularEnd, ...]:
        """The exact zeros on the slice that the first point may stand for."""
        return exact_zeros(self.branch.system.polynomials, self.witness)
