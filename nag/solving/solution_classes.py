"""Solutions up to a finite group of symmetries: classes, compared by invariants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.symmetric_family import SymmetricFamily
from nag.numerics.coincidence import SAFETY, overlapping_pairs
from nag.tracking.projective import ROUNDING

INVARIANTS = 3
# Relative step of the difference quotients that say how errors of points show in the invariants.
STEP = 1e-7
# A class whose invariants have errors beyond this cannot be told: its path counts as lost.
CLEAR = 1e-3


def invariants(
    symmetric: SymmetricFamily, points: np.ndarray, values: np.ndarray, radii: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Numbers that all members of a class share, shape ``(P, k)``, and the radii of balls there.

    Args:
        points: one member of each class, shape ``(P, n)``.
        values: the parameters.
        radii: errors of the points' coordinates, shape ``(P, n)``.
    """
    found = _means(symmetric.images(points, values))
    sizes = 1 + np.linalg.norm(points, axis=1)
    stretch = STEP * sizes / np.maximum(radii, ROUNDING * sizes[:, None]).max(axis=1, initial=0.0)
    turns = np.exp(1j * np.arange(1, 1 + points.shape[1]) ** 2)
    moved = points + stretch[:, None] * radii * turns
    change = np.linalg.norm(_means(symmetric.images(moved, values)) - found, axis=1)
    rounding = ROUNDING * np.linalg.norm(found, axis=1)
    return found, change / stretch + rounding


def radii_of_ends(points: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """Radii of coordinates from the relative errors that the tracker estimates."""
    sizes = 1 + np.linalg.norm(points, axis=1)
    return np.outer(SAFETY * np.maximum(ROUNDING, errors) * sizes, np.ones(points.shape[1]))


def _means(images: np.ndarray) -> np.ndarray:
    """Means over each class of quotients of fixed random affine functions, and of their squares.

    Args:
        images: of each point all members of its class, in any order, shape ``(order, P, n)``.
    """
    rng = np.random.default_rng(7)
    order, count, n = images.shape
    shape = (1 + n, 2 * INVARIANTS)
    weights = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    values = weights[0] + images.reshape(order * count, n) @ weights[1:]
    quotients = (values[:, :INVARIANTS] / values[:, INVARIANTS:]).reshape(order, count, INVARIANTS)
    powers = (1, 2) if order > 1 else (1,)
    return np.concatenate([(quotients**k).mean(axis=0) for k in powers], axis=1)


@dataclass
class SolutionClasses:
    """Solutions for given parameters, one of each class.

    Attributes:
        values: the parameters, shape ``(k,)``.
        symmetric: the family, in whose inner coordinates points and parameters are.
        points: shape ``(P, n)``; of each class the member that was found first.
        known: their invariants, and the radii of these.
    """

    values: np.ndarray
    symmetric: SymmetricFamily
    points: np.ndarray
    known: tuple[np.ndarray, np.ndarray]

    @classmethod
    def of(
        cls, values: np.ndarray, symmetric: SymmetricFamily, points: np.ndarray, errors: np.ndarray
    ) -> SolutionClasses:
        """The classes of these solutions."""
        nothing = invariants(symmetric, points[:0], values, radii_of_ends(points[:0], errors[:0]))
        classes = cls(values, symmetric, points[:0], nothing)
        classes.add(points, errors)
        return classes

    def _usable(
        self, points: np.ndarray, errors: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The points whose classes can be told, with their invariants and radii."""
        radii = radii_of_ends(points, errors)
        found, radii = invariants(self.symmetric, points, self.values, radii)
        usable = np.isfinite(found).all(axis=1) & (radii < CLEAR)
        return points[usable], found[usable], radii[usable]

    def add(self, points: np.ndarray, errors: np.ndarray) -> int:
        """Add the solutions that are of new classes; returns how many."""
        old = len(self.points)
        points, found, radii = self._usable(points, errors)
        points = np.concatenate([self.points, points])
        found, radii = np.concatenate([self.known[0], found]), np.append(self.known[1], radii)
        kept = np.setdiff1d(np.arange(len(points)), overlapping_pairs(found, radii)[:, 1])
        self.points, self.known = points[kept], (found[kept], radii[kept])
        return len(kept) - old

    def missing_from(self, points: np.ndarray, errors: np.ndarray) -> np.ndarray:
        """Those solutions whose classes are not among those of ``points``."""
        points, found, radii = self._usable(points, errors)
        both = np.concatenate([found, self.known[0]]), np.append(radii, self.known[1])
        repeated = overlapping_pairs(*both)[:, 1] - len(points)
        return self.points[np.setdiff1d(np.arange(len(self.points)), repeated)]
