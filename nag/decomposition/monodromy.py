"""Monodromy: loops of slices permute the points of a component."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from nag.numerics.coincidence import BEYOND, MISS, classify_arrivals
from nag.numerics.doubles import ROUGH
from nag.tracking.run import Run
from nag.witness.close_points import PointInWords, distance
from nag.witness.points import Points, move_points
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import PathCounts

# Decides, measured: Distance of an end from its point over that from the next: below 1e-14, or
# above 0.01. What is not nearer says nothing.
NEARER = 1e-3
# Of more distances than FEW only those are computed that a projection does not show to be long, at
# most so many at once.
FEW, MOST_DISTANCES = 1_000, 100_000
# Coordinates of a point, over its largest, that slices of its sizes take for larger ones.
LEAST_SIZE = 1e-8
NOTHING: Mapping[int, PointInWords] = MappingProxyType({})


@dataclass(frozen=True, eq=False)
class LoopEnds:
    """Where a loop led.

    Attributes:
        origins: indices of the points whose paths came back regularly.
        ends: their ends.
        places: indices of the points that the ends are, -1 for new ones; None if that is not clear.
    """

    origins: np.ndarray
    ends: Points
    places: np.ndarray | None

    def only(self, mask: np.ndarray) -> LoopEnds:
        """Some of the ends, of which it is clear which points they are."""
        which = np.flatnonzero(mask)
        return LoopEnds(self.origins[which], self.ends.only(which), self.places[which])

    def join_to(self, points: Points, starts: Points | None = None) -> tuple[Points, np.ndarray]:
        """The points with the new ones at the end, and the pairs that the loop joins, ``(m, 2)``.

        It must be clear which points the ends are.

        Args:
            starts: where paths came from, if these are not the same points.
        """
        starts = starts or points
        new = self.places < 0
        places = np.where(new, len(points) + np.cumsum(new) - 1, self.places)
        for k in np.flatnonzero(new).tolist():
            cut = starts.cuts[starts.which[self.origins[k]]]
            points = points.with_point(cut, self.ends.z[k], self.ends.fine.get(k))
        return points, np.column_stack([self.origins, places])


def locate_ends(ends: Points, points: Points) -> np.ndarray | None:
    """Indices of the ``points`` that ``ends`` are, -1 for none; None if that is not clear."""
    return locate_points(ends.x, points.x, ends.fine, points.fine)


def locate_points(
    ends: np.ndarray,
    points: np.ndarray,
    fine_ends: Mapping[int, PointInWords] = NOTHING,
    fine: Mapping[int, PointInWords] = NOTHING,
) -> np.ndarray | None:
    """Indices of the ``points`` that ``ends`` are, -1 for none; None if that is not clear.

    An end belongs to the nearest point if it is a thousand times nearer than the next one. Ends
    and points that are known to more digits are compared in them.
    """
    if len(ends) == 0 or points.shape[1] == 0:
        return np.zeros(len(ends), dtype=int)
    if not len(points):
        return np.full(len(ends), -1)
    nearest, closest, next_one = _two_nearest(ends, points)
    for i in fine_ends:
        apart = np.array(
            [distance(ends[i], fine_ends[i], x, fine.get(j)) for j, x in enumerate(points)]
        )
        nearest[i] = apart.argmin()
        closest[i], next_one[i] = np.sort(np.append(apart, np.inf))[:2]
    scale = 1 + np.linalg.norm(points[nearest], axis=1)
    near, doubtful = classify_arrivals(closest / scale, ROUGH)
    hit = near & (closest < NEARER * next_one)
    if (doubtful | (near & ~hit)).any():
        return None
    return np.where(hit, nearest, -1)


def _two_nearest(ends: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The nearest point of each end, its distance, and that of the next one.

    Distances are infinite where they are too long to matter: beyond those that `classify_arrivals`
    takes for one or for doubtful, or, of the next point, by far longer than that of the nearest
    one.
    """
    if len(ends) * len(points) <= FEW:
        return _of_all(ends, points)
    n = points.shape[1]
    weights = np.exp(1j * np.arange(1, n + 1) ** 2) / np.sqrt(n)
    keys, own = (points @ weights).real, (ends @ weights).real
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    width = 2 * max(MISS, BEYOND * ROUGH) * (1 + np.linalg.norm(ends, axis=1))
    first, last = np.searchsorted(keys, own - width), np.searchsorted(keys, own + width, "right")
    nearest = np.zeros(len(ends), dtype=int)
    closest, next_one = np.full((2, len(ends)), np.inf)
    totals = np.cumsum(last - first)
    for k in range(int(totals[-1]) // MOST_DISTANCES + 1):
        some = np.flatnonzero((last > first) & (totals // MOST_DISTANCES == k))
        if not len(some):
            continue
        counts = last[some] - first[some]
        begins = np.cumsum(counts) - counts
        i = np.repeat(some, counts)
        j = order[np.arange(len(i)) + np.repeat(first[some] - begins, counts)]
        distances = np.linalg.norm(ends[i] - points[j], axis=1)
        by_distance = np.lexsort((distances, i))
        nearest[some], closest[some] = j[by_distance[begins]], distances[by_distance[begins]]
        several = counts > 1
        next_one[some[several]] = distances[by_distance[begins[several] + 1]]
    open_ones = np.flatnonzero((closest > NEARER * width) & (closest <= width))
    for own in np.array_split(open_ones, 1 + len(open_ones) * len(points) // MOST_DISTANCES):
        if len(own):
            nearest[own], closest[own], next_one[own] = _of_all(ends[own], points)
    return nearest, closest, next_one


def _of_all(ends: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same from all distances."""
    distances = np.linalg.norm(ends[:, None] - points[None], axis=2)
    nearest = distances.argmin(axis=1)
    rows = np.arange(len(ends))
    closest = distances[rows, nearest]
    distances[rows, nearest] = np.inf
    return nearest, closest, distances.min(axis=1)


def run_loop(
    points: Points,
    start: Sequence[int],
    rng: np.random.Generator,
    run: Run,
    scaled: bool = False,
) -> tuple[LoopEnds, PathCounts]:
    """Carry some points round a random loop of slices.

    Args:
        scaled: whether the slice half-way is one that is generic where coordinates are divided by
            those of one of the points. Where the points of a set are of very different sizes, so
            are its branch points, and slices near the origin lead round none of them.
    """
    middle = random_rows(rng, points.dimension, points.n)
    if scaled:
        sizes = np.abs(points.x[rng.choice(start)])
        middle[:, 1:] /= np.maximum(sizes, LEAST_SIZE * sizes.max())
        middle /= np.linalg.norm(middle[:, 1:], axis=1, keepdims=True)
    out, back = (complex(g) for g in unit_complex(rng, 2))
    half, origins, counts = move_points(points, start, middle, out, run)
    again, order, spent = move_points(half, range(len(half)), points.rows, back, run)
    places = locate_ends(again, points)
    if places is not None and not ends_are_distinct(again, places):
        places = None
    return LoopEnds(origins[order], again, places), counts + spent


def ends_are_distinct(ends: Points, places: np.ndarray) -> bool:
    """Whether no two ends are one point; where they are, a path has jumped.

    Args:
        places: indices of the points that the ends are, -1 for new ones.
    """
    known, new = places[places >= 0], np.flatnonzero(places < 0)
    if len(np.unique(known)) < len(known):
        return False
    if not len(new):
        return True
    among = ends.only(new)
    if among.fine:
        return _are_distinct_in_digits(among)
    # Each of them is the nearest to itself.
    apart = _two_nearest(among.x, among.x)[2] / (1 + np.linalg.norm(among.x, axis=1))
    near, doubtful = classify_arrivals(apart, ROUGH)
    return not (near | doubtful).any()


def _are_distinct_in_digits(ends: Points) -> bool:
    """Whether no two of some ends are one point, those that have more digits compared in these."""
    for k in range(1, len(ends)):
        among = locate_ends(ends.only([k]), ends.only(range(k)))
        if among is None or (among >= 0).any():
            return False
    return True
