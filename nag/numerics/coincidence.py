"""Points that coincide within their errors: balls about them that meet.

Errors are estimates, so that the balls are larger than these by a factor. Of many points those that
coincide are found among neighbours in a projection. What pairs join, of these or of others, are
classes, each labelled by its smallest index.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from nag.numerics.array_table import map_rows

# Decides: Estimated errors that two points may be apart and be one: what the balls are wider by.
SAFETY = 1e2
# Decides, measured: Least relative error of a point in doubles. The same ones lay within 1e-15,
# others beyond 0.05, where systems are not made to have close ones; isolated zeros that it makes
# meet are told apart in 150 digits.
LEAST = 1e-11
# Decides, measured: Ends of paths that may have led to a known point and did: such as had lay
# within 5e-11.
HIT = 1e-8
# Decides, measured: Such as had not: all lay beyond 7e-4. What falls between is undecided.
MISS = 1e-5
# Decides: The same in errors of the end.
BEYOND = 1e4
# Decides: Errors that a point may be off what it is on, and within which other zeros may be the one
# that it stands for: it is undecided then, or they are looked at once.
SPREAD = 10.0
# Decides: Distance of zeros that a point may stand for, in each coordinate where there are several,
# whose error is not known; of ends of lost paths from what they may lead to, of solutions in two
# branches that are compared in more digits; error of a nearest point where a set may be singular.
NEAR = 1e-6
# Decides: Distance, beside its size, of ends that may have led to one multiple zero, however badly
# they are known: thousands of times what is estimated of such ends.
ANYWHERE_NEAR = 1e-3


# Pairs of neighbours that are looked at together.
PAIRS = 1 << 11
# Images of a point under a group that are looked at: of more some are left out, as to find them
# would take longer than to judge what they are.
MOST_IMAGES = 1 << 7

# What carries points, shape ``(P, n)``, to others.
PointMap = Callable[[np.ndarray], np.ndarray]


def radii_of_balls(points: np.ndarray, errors: np.ndarray | float) -> np.ndarray:
    """Radii of the balls that points lie in, from their relative errors, shape ``(P,)``."""
    sizes = map_rows(lambda some: np.linalg.norm(some, axis=1), points)
    return SAFETY * np.maximum(LEAST, errors) * (1 + sizes)


def coincident(points: np.ndarray, x: np.ndarray, error: np.ndarray | float) -> np.ndarray:
    """Which points may be the one at ``x``, as booleans of shape ``(P,)``.

    Args:
        points: shape ``(P, n)``.
        x: shape ``(n,)``.
        error: the larger one of the relative errors, of all points together or of each.
    """
    return np.linalg.norm(points - x, axis=1) <= radii_of_balls(x[None], error)


@dataclass(frozen=True, eq=False)
class SortedPoints:
    """Points that are asked for by where they may be.

    Attributes:
        points: complex, shape ``(P, n)``.
        key: of each a sum of its real parts with weights of at most 1, in increasing order.
        order: whose they are.
    """

    points: np.ndarray
    key: np.ndarray
    order: np.ndarray

    @classmethod
    def of(cls, points: np.ndarray) -> SortedPoints:
        """The same points, sorted once."""
        key = map_rows(lambda some: some.real @ _weights(points.shape[1]), points)
        order = np.argsort(key, kind="stable")
        return cls(points, key[order], order)

    def near(self, x: np.ndarray, radius: float) -> np.ndarray:
        """Indices, increasing, of all points within a distance of ``x``, and of some beyond."""
        middle = float(x.real @ _weights(len(x)))
        # What rounding adds to a sum is far less than the ball is wider by.
        width = (1 + LEAST) * np.sqrt(len(x)) * radius + LEAST * (1 + np.linalg.norm(x))
        first, last = np.searchsorted(self.key, [middle - width, middle + width])
        return np.sort(self.order[first:last])

    def coincident(self, x: np.ndarray, error: float) -> np.ndarray:
        """Indices, increasing, of the points that may be the one at ``x``; see `coincident`."""
        near = self.near(x, float(radii_of_balls(x[None], error)[0]))
        return near[coincident(self.points[near], x, error)]


def _weights(n: int) -> np.ndarray:
    """Weights of real parts, which a point and its conjugate share."""
    return np.cos(np.arange(1, n + 1) ** 2)


def neighbours(key: np.ndarray, width: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Pairs of indices whose keys differ by at most the width, the first one's or the second's.

    Args:
        key: real, shape ``(P,)``; points that coincide must have keys that do.
        width: shape ``(P,)``.

    Yields:
        Indices of the pairs that lie 1, 2, .. places apart in the order of the keys, some at a
        time.
    """
    order = np.argsort(key, kind="stable")
    key, width = key[order], width[order]
    # Those whose width reaches up, and down, so many places: farther off there are fewer.
    up = down = np.arange(len(key))
    for apart in range(1, len(key)):
        up = up[up < len(key) - apart]
        up = up[key[up + apart] - key[up] <= width[up]]
        down = down[down >= apart]
        down = down[key[down] - key[down - apart] <= width[down]]
        near = np.union1d(up, down - apart)
        if not len(near):
            return
        for first in range(0, len(near), PAIRS):
            some = near[first : first + PAIRS]
            yield order[some], order[some + apart]


def classify_arrivals(
    distances: np.ndarray, errors: np.ndarray | float
) -> tuple[np.ndarray, np.ndarray]:
    """Which ends of paths have led to a known point, and of which that is not clear.

    Args:
        distances: from the point, relative to its size, shape ``(P,)``.
        errors: the larger ones of the relative errors of the ends and of the point.
    """
    same = distances < np.maximum(HIT, SAFETY * errors)
    return same, ~same & (distances < np.maximum(MISS, BEYOND * errors))


def overlapping_pairs(points: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Pairs ``i < j`` of points one of which lies in the ball of the other, shape ``(pairs, 2)``.

    Args:
        points: complex, shape ``(P, n)``.
        radii: of the balls, shape ``(P,)``.
    """
    n = points.shape[1]
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    weights = np.exp(1j * np.arange(1, n + 1) ** 2)
    for i, j in neighbours((points @ weights).real, np.sqrt(n) * radii):
        close = np.linalg.norm(points[i] - points[j], axis=1) <= np.maximum(radii[i], radii[j])
        pairs.append(np.sort(np.stack([i[close], j[close]], axis=1), axis=1))
    return np.concatenate(pairs)


def radius_about(x: np.ndarray, error: float) -> float:
    """How far from a point the ends may be of all paths that lead to one zero near it.

    Args:
        x: shape ``(n,)``; error: of the end there, relative.
    """
    return max(ANYWHERE_NEAR, SAFETY * error) * (1 + float(np.linalg.norm(x)))


def clusters(points: np.ndarray, accuracy: np.ndarray) -> list[np.ndarray]:
    """Indices of points that coincide within their errors, a cluster each, in the points' order.

    Args:
        points: complex, shape ``(P, n)``.
        accuracy: relative errors, shape ``(P,)``.
    """
    every = np.arange(len(points))
    if len(points) < 2:
        return list(every[:, None])
    pairs = overlapping_pairs(points, radii_of_balls(points, accuracy))
    return group_by_label(join_labels(len(points), [pairs]), every)


def join_labels(total: int, pairs: Sequence[np.ndarray]) -> np.ndarray:
    """For each of ``total`` points the smallest one of its class, shape ``(total,)``.

    Args:
        pairs: of points that are in one class, arrays of shape ``(m, 2)``.
    """
    labels = np.arange(total)
    first, second = np.concatenate([np.zeros((0, 2), dtype=int), *pairs]).T
    while True:
        least = np.minimum(labels[first], labels[second])
        lower = labels.copy()
        for places in (labels[first], labels[second]):
            np.minimum.at(lower, places, least)
        lower = lower[lower]
        if np.array_equal(lower, labels):
            return labels
        labels = lower[lower]


def group_by_label(labels: np.ndarray, among: np.ndarray) -> list[np.ndarray]:
    """Some points by their labels, smallest first."""
    order = among[np.argsort(labels[among], kind="stable")]
    return np.split(order, np.flatnonzero(np.diff(labels[order])) + 1) if len(order) else []


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
    tolerance = 2 * radii_of_balls(points, accuracy)
    # Conjugate points share their real parts.
    key = map_rows(lambda some: some.real @ _weights(n), points)
    for i, j in neighbours(key, np.sqrt(n) * tolerance):
        distance = np.linalg.norm(points[i] - points[j].conj(), axis=1)
        pair = (distance <= np.maximum(tolerance[i], tolerance[j])) & ~taken[i] & ~taken[j]
        pair &= multiplicity[i] == multiplicity[j]
        for a, b in zip(i[pair].tolist(), j[pair].tolist(), strict=True):
            # Of points close together each is the conjugate of one only.
            if not taken[a] and not taken[b]:
                taken[a] = taken[b] = True
    return bool(taken.all())


def point_orbit(x: np.ndarray, maps: Sequence[PointMap]) -> np.ndarray:
    """The images of a point under the finite group that some maps and conjugation generate.

    Args:
        x: shape ``(n,)``.

    Returns:
        Points of shape ``(images, n)``, the point itself first.
    """
    images = new = x[None]
    while len(new) and len(images) < MOST_IMAGES:
        moved = np.vstack([new.conj(), *(g(new) for g in maps)])
        known = np.vstack([images, moved])
        first = len(images)
        kept = [
            k for k in range(first, len(known)) if not coincident(known[:k], known[k], LEAST).any()
        ]
        new = known[kept]
        images = np.vstack([images, new])
    return images
