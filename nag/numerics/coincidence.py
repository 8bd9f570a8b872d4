"""Points that coincide within their errors, found among neighbours in a projection."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

# End points that are closer than this (relative) are one; distinct solutions hardly ever are.
SAME = 1e-8


def neighbours(key: np.ndarray, width: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Pairs of indices whose keys differ by at most the width, the first one's or the second's.

    Args:
        key: real, shape ``(P,)``; points that coincide must have keys that do.
        width: shape ``(P,)``.

    Yields:
        Indices of the pairs that lie 1, 2, .. places apart in the order of the keys.
    """
    order = np.argsort(key, kind="stable")
    key, width = key[order], width[order]
    widest = float(width.max(initial=0.0))
    for apart in range(1, len(key)):
        difference = key[apart:] - key[:-apart]
        if not (difference <= widest).any():
            return
        near = np.flatnonzero(difference <= np.maximum(width[apart:], width[:-apart]))
        if len(near):
            yield order[near], order[near + apart]


def clusters(points: np.ndarray, accuracy: np.ndarray, floor: float = SAME) -> list[np.ndarray]:
    """Indices of points that coincide within their errors, a cluster each, in the points' order.

    Args:
        points: complex, shape ``(P, n)``.
        accuracy: relative errors, shape ``(P,)``.
        floor: relative distance below which points coincide whatever their accuracy.
    """
    count, n = points.shape
    tolerance = np.maximum(floor, 1e2 * accuracy) * (1 + np.linalg.norm(points, axis=1))
    label = np.arange(count)

    def root(i: int) -> int:
        while label[i] != i:
            label[i] = label[label[i]]
            i = label[i]
        return i

    weights = np.exp(1j * np.arange(1, n + 1) ** 2)
    for i, j in neighbours((points @ weights).real, np.sqrt(n) * tolerance):
        close = np.linalg.norm(points[i] - points[j], axis=1)
        same = close <= np.maximum(tolerance[i], tolerance[j])
        for a, b in zip(i[same].tolist(), j[same].tolist(), strict=True):
            first, second = sorted((root(a), root(b)))
            label[second] = first
    if (label == np.arange(count)).all():
        return list(np.arange(count)[:, None])
    groups: dict[int, list[int]] = {}
    for i in range(count):
        groups.setdefault(root(i), []).append(i)
    return [np.array(g) for g in groups.values()]


def conjugates_present(
    points: np.ndarray, accuracy: np.ndarray, multiplicity: np.ndarray, real: np.ndarray
) -> bool:
    """Whether the conjugate of each point is one too, with the same multiplicity.

    Args:
        points: complex, shape ``(P, n)``; accuracy: relative errors; multiplicity; real: which
            points are their own conjugates; all shape ``(P,)``.
    """
    taken = real.copy()
    n = points.shape[1]
    tolerance = np.maximum(SAME, 2e2 * accuracy) * (1 + np.linalg.norm(points, axis=1))
    # Conjugate points share their real parts.
    weights = np.exp(1j * np.arange(1, n + 1) ** 2).real
    for i, j in neighbours(points.real @ weights, np.sqrt(n) * tolerance):
        distance = np.linalg.norm(points[i] - points[j].conj(), axis=1)
        pair = (distance <= np.maximum(tolerance[i], tolerance[j])) & ~taken[i] & ~taken[j]
        pair &= multiplicity[i] == multiplicity[j]
        taken[i[pair]] = taken[j[pair]] = True
    return bool(taken.all())
