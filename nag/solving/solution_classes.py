"""Solutions up to a finite group of symmetries: classes, compared by invariants."""

from __future__ import annotations

import numpy as np

from nag.algebra.symmetric_family import SymmetricFamily
from nag.numerics.coincidence import SAFETY, overlapping_pairs
from nag.solving.start.monodromy_loops import DistinctSolutions
from nag.tracking.projective import ROUNDING

INVARIANTS = 3
# Relative step of the difference quotients that say how errors of points show in the invariants.
STEP = 1e-7
# Decides: Errors of a class's invariants from which on it is not told from others: its path is
# lost.
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


def distinct_classes(
    values: np.ndarray, symmetric: SymmetricFamily, points: np.ndarray, errors: np.ndarray
) -> DistinctSolutions:
    """Solutions for given parameters, one of each class, told apart by `invariants`.

    Args:
        values: the parameters, shape ``(k,)``.
        symmetric: the family, in whose inner coordinates points and parameters are.
        points: solutions, shape ``(P, n)``, with their relative errors.
    """

    def usable(x: np.ndarray, off: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        found, radii = invariants(symmetric, x, values, radii_of_ends(x, off))
        clear = np.isfinite(found).all(axis=1) & (radii < CLEAR)
        return x[clear], found[clear], radii[clear]

    nothing = usable(points[:0], errors[:0])
    classes = DistinctSolutions(*nothing, usable, overlapping_pairs)
    classes.add(points, errors)
    return classes
