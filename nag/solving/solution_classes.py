"""Solutions up to a finite group of symmetries: classes, compared by invariants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.symmetric_family import SymmetricFamily
from nag.numerics.coincidence import neighbours

# Invariants of points that are known to half the digits differ by less if they are equal.
SAME = 1e-7
INVARIANTS = 3


def invariants(images: np.ndarray) -> np.ndarray:
    """Numbers that all members of a class share, of the size of one, shape ``(P, k)``.

    Means, over the members, of quotients of fixed random affine functions and of their squares.

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


def equal_pairs(values: np.ndarray) -> np.ndarray:
    """Pairs ``i < j`` of rows that are equal to within `SAME`, shape ``(pairs, 2)``."""
    size = 1 + np.abs(values)
    with np.errstate(invalid="ignore"):
        key = np.abs((values / size) @ np.exp(1j * np.arange(values.shape[1]) ** 2))
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for i, j in neighbours(key, np.full(len(key), 4 * SAME * values.shape[1])):
        close = np.abs(values[i] - values[j]) <= SAME * np.minimum(size[i], size[j])
        same = close.all(axis=1)
        pairs.append(np.sort(np.stack([i[same], j[same]], axis=1), axis=1))
    return np.concatenate(pairs)


@dataclass
class Fibre:
    """Solutions for given parameters, one of each class.

    Attributes:
        values: the parameters, shape ``(k,)``.
        symmetric: the family, in whose inner coordinates points and parameters are.
        points: shape ``(P, n)``; of each class the member that was found first.
        known: their invariants.
    """

    values: np.ndarray
    symmetric: SymmetricFamily
    points: np.ndarray
    known: np.ndarray

    @classmethod
    def of(cls, values: np.ndarray, symmetric: SymmetricFamily, points: np.ndarray) -> Fibre:
        """The fibre with these solutions."""
        fibre = cls(values, symmetric, points[:0], invariants(symmetric.images(points[:0], values)))
        fibre.add(points)
        return fibre

    def add(self, points: np.ndarray) -> int:
        """Add the solutions that are of new classes; returns how many."""
        old = len(self.points)
        found = invariants(self.symmetric.images(points, self.values))
        usable = np.isfinite(found).all(axis=1)
        points = np.concatenate([self.points, points[usable]])
        known = np.concatenate([self.known, found[usable]])
        kept = np.setdiff1d(np.arange(len(points)), equal_pairs(known)[:, 1])
        self.points, self.known = points[kept], known[kept]
        return len(kept) - old

    def missing_from(self, points: np.ndarray) -> np.ndarray:
        """Those solutions whose classes are not among those of ``points``."""
        found = invariants(self.symmetric.images(points, self.values))
        both = np.concatenate([found[np.isfinite(found).all(axis=1)], self.known])
        first = len(both) - len(self.known)
        repeated = equal_pairs(both)[:, 1] - first
        return self.points[np.setdiff1d(np.arange(len(self.points)), repeated)]
