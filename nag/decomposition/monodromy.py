"""Monodromy: loops of slices permute the points of a fibre and merge those of one component."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import cKDTree

from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import PathCounts

ATTEMPTS = 3
# An end is one of the known points when it is that near and the next one is a thousand times
# farther; it is none of them when it is farther than the second bound from all.
NEAR = 1e-6
FAR = 1e-4


def match(ends: np.ndarray, points: np.ndarray) -> np.ndarray | None:
    """The permutation p with ``ends[i]`` at ``points[p[i]]``; None if there is none."""
    nearest = located(ends, points)
    if nearest is None or (nearest < 0).any():
        return None
    return nearest if len(np.unique(nearest)) == len(points) else None


def located(ends: np.ndarray, points: np.ndarray) -> np.ndarray | None:
    """Indices of the ``points`` that ``ends`` are, -1 for none; None if that is not clear.

    An end belongs to the nearest point if it is a thousand times nearer than the next one.
    """
    if len(ends) == 0 or points.shape[1] == 0:
        return np.zeros(len(ends), dtype=int)
    tree = cKDTree(np.hstack([points.real, points.imag]))
    distances, indices = tree.query(np.hstack([ends.real, ends.imag]), k=[1, 2])
    nearest, closest = indices[:, 0], distances[:, 0]
    scale = 1 + np.linalg.norm(points[nearest], axis=1)
    hit = (closest < NEAR * scale) & (closest < 1e-3 * distances[:, 1])
    if not (hit | (closest > FAR * scale)).all():
        return None
    return np.where(hit, nearest, -1)


def carried(
    fibres: Sequence[Fibre],
    source: np.ndarray,
    target: np.ndarray,
    gamma: complex,
    tracker: Tracker,
) -> tuple[list[Fibre] | None, PathCounts]:
    """The fibres on another generic slice, or None if a path did not arrive regularly."""
    counts, result = PathCounts(), []
    for fibre in fibres:
        ends = move(fibre, source, target, gamma, tracker)
        counts += ends.counts.repeatable
        if not ends.regular.all():
            return None, counts
        result.append(Fibre(fibre.cut, fibre.dimension, ends.points))
    return result, counts


def loop(
    fibres: Sequence[Fibre], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[np.ndarray | None, PathCounts]:
    """The permutation of all points of ``fibres`` along a random loop of slices.

    None if no permutation was obtained in a few attempts, the later ones with careful tracking.
    """
    counts = PathCounts()
    points = np.vstack([fibre.x for fibre in fibres])
    for _attempt in range(ATTEMPTS):
        middle = random_rows(rng, len(rows), rows.shape[1] - 1)
        out, back = unit_complex(rng, 2)
        there, spent = carried(fibres, rows, middle, complex(out), tracker)
        counts += spent
        if there is None:
            continue
        again, spent = carried(there, middle, rows, complex(back), tracker)
        counts += spent
        if again is None:
            continue
        permutation = match(np.vstack([fibre.x for fibre in again]), points)
        if permutation is not None:
            return permutation, counts
    return None, counts


def merge(labels: np.ndarray, permutation: np.ndarray) -> np.ndarray:
    """Labels of the classes after every point was joined with its image."""
    labels = labels.copy()
    for i, j in enumerate(permutation):
        if labels[i] != labels[j]:
            labels[labels == max(labels[i], labels[j])] = min(labels[i], labels[j])
    return labels
