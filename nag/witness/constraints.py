"""Constraints whose Jacobian has full rank along a component, for equations of motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError, NagError
from nag.numerics.natural_coordinates import NaturalCoordinates, natural_coordinates
from nag.numerics.read_only import RealArray
from nag.witness.component_equations import component_system
from nag.witness.witness import WitnessSet

# The singular value that the rank rests on is larger, relative to the largest one; and the next
# one is smaller, relative to that.
REGULAR, BEYOND = 1e-8, 0.1


@dataclass(frozen=True)
class Constraints:
    """As many constraints as a component has codimension, independent along it.

    An overconstrained mechanism has more equations than independent ones, and a fixed choice or
    combination of them need not stay independent all along the motion. At each point those
    combinations are taken that have the largest singular values, so that the Jacobian has the full
    rank wherever the equations have that rank. They are unique but for an orthogonal matrix, on
    which accelerations, forces and projections do not depend, and which may jump from point to
    point; so do not take differences of values or Jacobians at several points: `curvature` has what
    equations of motion need. Rank and combinations are those in natural coordinates, whatever the
    units and the place of the mechanism; each equation is divided by its largest coefficient there.

    Attributes:
        system: the equations that hold on the component.
        dimension: of the component.
    """

    system: PolynomialSystem
    dimension: int

    @property
    def count(self) -> int:
        """How many constraints there are."""
        return self.system.n - self.dimension

    def values(self, point: np.ndarray) -> RealArray:
        """Their values at a real point near the component, shape ``(count,)``.

        Raises:
            ComponentError: if they are not independent there.
        """
        x = self._check_point(point, "point")
        there = self._natural.points(x[None])
        return self._frame(x)[0] @ self._equations.values(there)[0].real

    def jacobian(self, point: np.ndarray) -> RealArray:
        """Their Jacobian at a real point near the component, of full rank, ``(count, n)``.

        Raises:
            ComponentError: if they are not independent there.
        """
        return self._frame(self._check_point(point, "point"))[1]

    def curvature(self, point: np.ndarray, velocity: np.ndarray) -> RealArray:
        """Their second derivatives along a velocity, shape ``(count,)``.

        Accelerations ``a`` on the component have ``jacobian a + curvature = 0``.

        Raises:
            ComponentError: if they are not independent there.
        """
        x, v = self._check_point(point, "point"), self._check_point(velocity, "velocity")
        here, along = self._natural.points(x), v / self._natural.sizes
        series = np.stack([here, along, np.zeros_like(x)], axis=-1)[None]
        second = 2 * self._equations.last_coefficients(series)[0].real
        return self._frame(x)[0] @ second

    @cached_property
    def _natural(self) -> NaturalCoordinates:
        return natural_coordinates(self.system.polynomials, self.system.n)

    @cached_property
    def _equations(self) -> Evaluator:
        return Evaluator.of(self._natural.system(self.system).polynomials, self.system.n)

    def _check_point(self, values: np.ndarray, name: str) -> np.ndarray:
        given = np.asarray(values)
        if given.shape != (self.system.n,) or given.dtype.kind not in "iuf":
            raise NagError(f"{name}: give {self.system.n} real numbers")
        return given.astype(float)

    def _frame(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Orthonormal combinations of the equations, ``(count, N)``, and their Jacobian by x."""
        whole = self._equations.jacobian(self._natural.points(x))
        if np.isrealobj(x):
            whole = whole.real
        left, sizes, _ = np.linalg.svd(whole, full_matrices=False)
        padded = np.zeros(self.system.n + 1)
        padded[: len(sizes)] = sizes
        last, beyond = padded[self.count - 1], padded[self.count]
        if self.count and not (last > REGULAR * padded[0] and beyond < BEYOND * last):
            raise ComponentError(
                f"constraints: rank {self.count} of the equations is not certain at the point: it "
                "is singular, not on the component, or far from the origin beside its distances"
            )
        frame = left[:, : self.count].conj().T
        return frame, frame @ whole / self._natural.sizes


def find_constraints(component: WitnessSet, system: PolynomialSystem | None = None) -> Constraints:
    """Constraints that are independent along a component, see `WitnessSet.constraints`."""
    if system is not None:
        check_type(system, PolynomialSystem, "system", "a nag.PolynomialSystem")
        return Constraints(system, component.dimension)
    own = Constraints(component_system(component._known_system(), component), component.dimension)
    try:
        own._frame(component.points[0])
    except ComponentError:
        raise ComponentError(
            "constraints: the component is not reduced: its equations are singular at all of its "
            "points; give system=, equations of which it is a simple zero set"
        ) from None
    return own
