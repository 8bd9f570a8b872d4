"""Units: coordinates in which the sizes of a zero set are comparable, for whatever starts from it.

With ``x = 2^k y``, a power for each variable, nothing is rounded: equations, slices, points, error
radii and what cuts them go there and come back as they are. An operation on components begins by
going there and ends by coming back, so that nothing in between needs to know of sizes: distances,
ranks and errors that are relative to the whole point see all of its coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.natural_coordinates import LEAST_SCALE
from nag.numerics.scaling import scaled_terms, variable_scales
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.slices import random_rows
from nag.witness.witness import Decomposition, Slice, WitnessSet


@dataclass(frozen=True, eq=False)
class Units:
    """Coordinates ``y`` with ``x = 2^powers y``.

    Attributes:
        powers: integers, shape ``(n,)``.
    """

    powers: np.ndarray

    @classmethod
    def of(cls, polynomials: Sequence[Polynomial], n: int) -> Units:
        """Those that make the coefficients comparable; those that are given, where that is little.

        >>> import nag
        >>> system = nag.system("(1024*x)^2 + y^2 - 1", "x y")
        >>> Units.of(system.polynomials, system.n).powers.tolist()
        [-10, 0]
        """
        powers = variable_scales(polynomials, n)
        comparable = 2 ** np.abs(powers).max(initial=0) < LEAST_SCALE
        return cls(np.zeros_like(powers) if comparable else powers)

    @property
    def same(self) -> bool:
        """Whether the coordinates are those that are given."""
        return not self.powers.any()

    @property
    def sizes(self) -> np.ndarray:
        """What the coordinates ``y`` are multiplied by, shape ``(n,)``."""
        return np.ldexp(1.0, self.powers)

    @property
    def inverse(self) -> Units:
        """The way back."""
        return Units(-self.powers)

    def random_rows(self, rng: np.random.Generator, codimension: int) -> np.ndarray:
        """A slice of ``x`` that is generic in the coordinates ``y``, as rows on ``(1, x)``."""
        rows = random_rows(rng, codimension, len(self.powers))
        return rows / np.concatenate([[1.0], self.sizes])

    def of_system(self, system: PolynomialSystem) -> PolynomialSystem:
        """The equations of ``y``, each over the power of two next to its largest coefficient."""
        if self.same:
            return system
        polynomials, nonzero = (
            tuple(Polynomial(f.n, scaled_terms(f, self.powers)) for f in several)
            for several in (system.polynomials, system.nonzero)
        )
        return replace(system, polynomials=polynomials, nonzero=nonzero)

    def of_component(self, component: WitnessSet, system: PolynomialSystem | None) -> WitnessSet:
        """The component of ``y``, on the same slice.

        Args:
            system: what it is a component of, in these coordinates.
        """
        if self.same:
            return component if component.system is system else replace(component, system=system)
        A, b = component.slice.A * self.sizes, component.slice.b
        norms = np.frexp(np.linalg.norm(A, axis=1))[1]
        return replace(
            component,
            slice=Slice(np.ldexp(1.0, -norms)[:, None] * A, np.ldexp(1.0, -norms) * b),
            points=component.points / self.sizes,
            radii=component.radii / self.sizes,
            fibres=tuple(self.of_fibre(fibre) for fibre in component.fibres),
            system=system,
        )

    def of_decomposition(self, whole: Decomposition) -> Decomposition:
        """The decomposition with the components of ``y``."""
        if self.same:
            return whole
        system = self.of_system(whole.system)
        components = tuple(self.of_component(c, system) for c in whole.components)
        return replace(whole, system=system, components=components)

    def of_fibre(self, fibre: Fibre) -> Fibre:
        """A fibre's points and equations; unknowns that deflation added are left as they are."""
        n, aux = fibre.cut.n, fibre.cut.aux
        powers = np.concatenate([self.powers, np.zeros(aux, dtype=self.powers.dtype)])
        polynomials = [Polynomial(n + aux, scaled_terms(f, powers)) for f in fibre.cut.polynomials]
        fine = {
            i: replace(each, words=np.ldexp(each.words, -powers[:, None, None]))
            for i, each in fibre.fine.items()
        }
        points = fibre.points * np.ldexp(1.0, -powers)
        return Fibre(Cut(n, aux, tuple(polynomials)), fibre.dimension, points, fine)
