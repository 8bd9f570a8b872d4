"""A component in the coordinates that are left when its system's linear equations are solved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.reduction import Reduction
from nag.errors import ComponentError
from nag.numerics.natural_coordinates import NaturalCoordinates, scale_coordinates
from nag.tracking.run import Run
from nag.witness.change_of_coordinates import carry_component
from nag.witness.close_points import CLOSE, PointInWords, follow_slice, with_newton_constant
from nag.witness.component_equations import component_system
from nag.witness.cutting import Cut
from nag.witness.cutting_in_digits import cut_fibres
from nag.witness.fibres import Fibre, move_regular
from nag.witness.moving import SliceError, orthonormal_rows
from nag.witness.slices import even_rows, unit_complex
from nag.witness.witness import PathCounts, WitnessSet

# What is said of an answer where no path led on from the given points.
NOT_MOVED = "the witness points could not be moved to a generic slice"


class IntersectionError(ComponentError):
    """Sets that cannot be intersected; the message is one line."""


@dataclass(frozen=True, eq=False)
class Operand:
    """A component to be intersected, and the coordinates of the system that it is one of."""

    reduction: Reduction
    component: WitnessSet

    @classmethod
    def of(cls, system: PolynomialSystem, component: WitnessSet) -> Operand:
        if component.points.shape[1] != system.n:
            raise IntersectionError(
                f"the component has {component.points.shape[1]} coordinates, its system {system.n}"
            )
        return cls(Reduction.of(system), component)

    @classmethod
    def in_branch(cls, system: PolynomialSystem, component: WitnessSet) -> Operand:
        """`of` the branch of a system that the component is one of, if it has branches."""
        return cls.of(component_system(system, component), component)

    def carry(self, natural: NaturalCoordinates) -> Operand:
        """The component in other coordinates."""
        if natural.is_identity:
            return self
        system = natural.system(self.reduction.system)
        return Operand.of(system, carry_component(self.component, natural, system))

    @property
    def n(self) -> int:
        return self.reduction.n

    @property
    def rows(self) -> np.ndarray:
        cut = self.component.slice
        rows = self.reduction.frame.pulled_back(cut.A, cut.b)
        own = scale_coordinates(self.reduction.reduced.polynomials, self.n)
        sizes = np.concatenate([[1.0], own.sizes])
        try:
            return orthonormal_rows(rows * sizes) / sizes
        except SliceError:
            return even_rows(rows, sizes)

    def fibres(self, rng: np.random.Generator) -> list[Fibre]:
        """The witness points with cuts, deflated ones if the component is not reduced.

        Raises:
            IntersectionError: if no cut is found for a point.
        """
        rows = self.rows
        kept = [self._reduce_fibre(fibre, rows) for fibre in self.component.fibres]
        if kept and all(len(f.cut.polynomials) == self.n + f.cut.aux - f.dimension for f in kept):
            return [self._with_fine(fibre, fibre.fine) for fibre in kept]
        deflate = self.component.multiplicity != 1
        points = self.component.points[:, self.reduction.kept]
        equations = self.reduction.equations
        fibres = cut_fibres(points, self.component.accuracy, equations, rows, rng, deflate)
        if fibres is None:
            raise IntersectionError("the witness points are no regular zeros of the system")
        return [
            self._with_fine(
                fibre, dict(enumerate(map(PointInWords.of_doubles, fibre.points))) | fibre.fine
            )
            for fibre in fibres
        ]

    def _with_fine(self, fibre: Fibre, known: Mapping[int, PointInWords]) -> Fibre:
        """A fibre with more digits of the points that are close to other zeros of its cut.

        Those that are close to zeros of other equations only need none. The slice is rounded beside
        the component's own one, and followed by points in all their digits.
        """
        if not known:
            return fibre
        polynomials, rows = fibre.cut.polynomials, fibre.rows
        there = {i: follow_slice(polynomials, rows, each) for i, each in known.items()}
        found = {i: with_newton_constant(polynomials, rows, each) for i, each in there.items()}
        steep = {i: each for i, each in found.items() if each.curvature * CLOSE > 1}
        return replace(fibre, fine=steep)

    def _reduce_fibre(self, fibre: Fibre, rows: np.ndarray) -> Fibre:
        """A fibre in the coordinates that are left, its linear equations solved."""
        aux = fibre.cut.aux
        unknowns = range(self.n, self.n + aux)
        images = [f.with_variables(self.n + aux, range(self.n)) for f in self.reduction.images]
        images += [Polynomial.variable(self.n + aux, i) for i in unknowns]
        left = [f.compose(images) for f in fibre.cut.polynomials]
        points = np.hstack([fibre.x[:, self.reduction.kept], fibre.points[:, fibre.cut.n :]])
        kept = [*self.reduction.kept, *range(fibre.cut.n, fibre.cut.n + aux)]
        fine = {i: replace(each, words=each.words[kept]) for i, each in fibre.fine.items()}
        return Fibre(Cut(self.n, aux, tuple(f for f in left if f)), rows, points, fine)


def move_to_flag(
    fibres: list[Fibre], flag: np.ndarray, rng: np.random.Generator, run: Run
) -> tuple[list[Fibre] | None, PathCounts]:
    """Fibres carried to the leading rows of a generic flag; None if a path fails."""
    d = fibres[0].dimension
    if d == 0:
        return fibres, PathCounts()
    return move_regular(fibres, flag[:d], complex(unit_complex(rng)), run)
