"""Loops between two systems of a family, which lead from solutions that are known to new ones.

If all solutions of all systems of a family form one irreducible set, loops of its coefficients lead
from any solution to any other (Duff, Hill, Jensen, Lee, Leykin & Sommars, Solving polynomial
systems via homotopy continuation and monodromy, 2019). Solutions are told apart by keys: their own
coordinates, or numbers that all members of a class share.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

# Points and their relative errors.
Ends = tuple[np.ndarray, np.ndarray]
# Where paths from points arrive.
Way = Callable[[np.ndarray], Ends]


@dataclass(eq=False)
class DistinctSolutions:
    """Solutions of one system, each once.

    Attributes:
        points: shape ``(P, n)``.
        keys, radii: by which they are told apart, shape ``(P, k)``, and those of balls about these.
        key_of: of points and their errors those that can be told, with their keys and radii.
        pairs_of: pairs ``i < j`` of keys that are one, shape ``(pairs, 2)``.
        most: how many there may be; None if that is not known.
    """

    points: np.ndarray
    keys: np.ndarray
    radii: np.ndarray
    key_of: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]
    pairs_of: Callable[[np.ndarray, np.ndarray], np.ndarray]
    most: int | None = None

    def add(self, points: np.ndarray, errors: np.ndarray) -> int:
        """Add those that are new; returns how many."""
        old = len(self.points)
        points, keys, radii = self.key_of(points, errors)
        points, keys = np.concatenate([self.points, points]), np.concatenate([self.keys, keys])
        radii = np.append(self.radii, radii)
        new = np.setdiff1d(np.arange(old, len(points)), self.pairs_of(keys, radii)[:, 1])
        if self.most is not None:
            new = new[: self.most - old]
        kept = np.append(np.arange(old), new)
        self.points, self.keys, self.radii = points[kept], keys[kept], radii[kept]
        return len(new)

    def missing_from(self, points: np.ndarray, errors: np.ndarray) -> np.ndarray:
        """Those that are not among ``points``."""
        points, keys, radii = self.key_of(points, errors)
        both = np.concatenate([keys, self.keys]), np.append(radii, self.radii)
        repeated = self.pairs_of(*both)[:, 1] - len(points)
        return self.points[np.setdiff1d(np.arange(len(self.points)), repeated)]


def run_loop(here: DistinctSolutions, there: DistinctSolutions, out: Way, back: Way) -> int:
    """Follow a way from all solutions of a system, and back; how many new ones that leads to.

    The way is one to one: what it did not reach leads back to solutions that are new.
    """
    ends = out(here.points)
    found = there.add(*ends)
    return found + here.add(*back(there.missing_from(*ends)))
