"""Points of products of projective spaces: differences, and pairs that are one within errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.numerics.array_table import map_rows
from nag.numerics.coincidence import neighbours
from nag.numerics.doubles import SLACK
from nag.tracking.homotopy import norms

Groups = Sequence[Sequence[int]]

# Relative error of a point that is known to all digits: rounding of two homogeneous coordinates,
# and of their quotient.
ROUNDING = 5 * 2.0**-53


def aligned_difference(groups: Groups, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """``first - second`` after turning each group of ``second`` into the phase of ``first``."""
    if len(groups) == 1:
        return first - second * _turn(first, second)
    second = second.copy()
    for indices in groups:
        g = list(indices)
        second[:, g] *= _turn(first[:, g], second[:, g])
    return first - second


def _turn(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """The factors of absolute value 1 that turn rows of ``second`` into the phase of ``first``."""
    product = (second.conj() * first).sum(axis=1, keepdims=True)
    size = np.abs(product)
    there = size > 0
    return np.where(there, product / np.where(there, size, 1), 1)


def coinciding_pairs(groups: Groups, points: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """Pairs ``i < j`` of ends of paths that are one within their errors, shape ``(pairs, 2)``.

    Args:
        groups: of coordinates, each of a projective space.
        points: of unit norm in each group, shape ``(P, N)``.
        errors: their relative errors, shape ``(P,)``.
    """
    radii = SLACK * np.maximum(ROUNDING, errors)
    # |<v, x>|^2 for a fixed v is the same for all multiples of x, and sorts the points.
    key = np.zeros(len(points))
    for indices in groups:
        places, weights = list(indices), np.exp(1j * np.arange(len(indices)) ** 2)
        key += map_rows(lambda some, p=places, w=weights: np.abs(some[:, p] @ w) ** 2, points)
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for i, j in neighbours(key, 2 * points.shape[1] * radii):
        apart = norms(aligned_difference(groups, points[i], points[j]))
        close = apart <= np.maximum(radii[i], radii[j])
        pairs.append(np.sort(np.stack([i[close], j[close]], axis=1), axis=1))
    return np.concatenate(pairs)
