"""A system in the coordinates in which its zero set is worked out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of, change_units, times_power_of_two
from nag.numerics.natural_coordinates import (
    NaturalCoordinates,
    natural_coordinates,
    scale_coordinates,
)
from nag.witness.close_points import DIGITS, PointInWords, fine_of_balls
from nag.witness.cutting import Cut, Equations
from nag.witness.frame import Frame


@dataclass(frozen=True, eq=False)
class Reduction:
    """A system, and what is left of it when linear equations have been solved.

    Attributes:
        system: the system that was given.
        natural: the coordinates in which its linear equations were solved.
        elimination: how these were solved.
        reduced: the system in the coordinates that are left, perhaps scaled.
        frame: how these sit in the original ones.
    """

    system: PolynomialSystem
    natural: NaturalCoordinates
    elimination: Elimination
    reduced: PolynomialSystem
    frame: Frame
    _lifted: dict[Cut, Cut] = field(default_factory=dict, repr=False)

    @classmethod
    def of(
        cls,
        system: PolynomialSystem,
        scaled: bool = False,
        natural: NaturalCoordinates | None = None,
    ) -> Reduction:
        """The reduction; ``scaled``: from natural coordinates, to comparable coefficients.

        Args:
            natural: the coordinates that suit the equations, if they are known.
        """
        if not scaled:
            natural = NaturalCoordinates.identity(system.n)
        elif natural is None:
            natural = natural_coordinates(system.polynomials, system.n)
        elimination = eliminate_linear(natural.system(system), graphs=False)
        reduced, frame = elimination.system, Frame.of(elimination, natural)
        if scaled:
            scales = scale_coordinates(reduced.polynomials, reduced.n)
            reduced, frame = scales.system(reduced), frame.scaled(scales.sizes)
        return cls(system, natural, elimination, reduced, frame)

    @property
    def n(self) -> int:
        return self.reduced.n

    @property
    def kept(self) -> list[int]:
        """The original variable that each coordinate is, but for its scale."""
        return list(self.elimination.kept)

    @property
    def images(self) -> tuple[Polynomial, ...]:
        """The natural coordinates as polynomials in the coordinates before these were scaled."""
        return self.elimination.images

    @cached_property
    def scales(self) -> np.ndarray:
        """Of the coordinates beside the natural ones that they are, powers of two."""
        natural = np.array([float(self.natural.scales[i]) for i in self.kept])
        return np.exp2(np.rint(np.log2(self.frame.scales / natural)))

    def lifted(self, cut: Cut) -> Cut:
        """A square system in these coordinates as one in the original variables.

        The equations that the linear ones were solved for come after it.
        """
        if cut not in self._lifted:
            n, total = self.system.n, self.system.n + cut.aux
            place = [*self.kept, *range(n, total)]
            powers = np.round(np.log2(self.scales)).astype(int)
            rows = [_undo_scales(f, powers).with_variables(total, place) for f in cut.polynomials]
            for i, image in enumerate(self.images):
                if i not in self.kept:
                    x = Polynomial.variable(total, i)
                    rows.append(x - image.with_variables(total, self.kept))
            original = map(self.natural.inverse.polynomial, rows)
            self._lifted[cut] = Cut(n, cut.aux, tuple(original))
        return self._lifted[cut]

    def lifted_fine(self, point: PointInWords) -> PointInWords:
        """A point in these coordinates as one in the original variables, in all its digits."""
        y, powers = point.balls(), np.round(np.log2(self.scales)).astype(int).tolist()
        own = [times_power_of_two(z, k) for z, k in zip(y, powers, strict=False)]
        images, bits = BallPolynomials.of(self.images), bits_of(2 * DIGITS)
        there = images.values(own, bits).mid().entries()
        x = change_units(there, self.natural.scales, self.natural.origin, bits)
        return fine_of_balls([*x, *y[self.n :]], point.curvature)

    @cached_property
    def equations(self) -> Equations:
        """The equations in these coordinates."""
        return Equations(self.reduced.polynomials, self.n)

    @cached_property
    def nonzero(self) -> Evaluator:
        """The polynomials that must not vanish, in these coordinates."""
        return Evaluator.of(self.reduced.nonzero, self.n)

    @cached_property
    def original(self) -> Evaluator:
        """The equations that were given."""
        return Evaluator.of(self.system.polynomials, self.system.n)


def _undo_scales(f: Polynomial, powers: Sequence[int]) -> Polynomial:
    """``f(x / 2^powers)``; further variables are left as they are."""
    if not any(powers):
        return f
    terms = {}
    for exponents, c in f.terms.items():
        shift = sum(int(p) * k for p, k in zip(powers, exponents, strict=False))
        terms[exponents] = c * Fraction(2) ** -shift
    return Polynomial(f.n, terms)
