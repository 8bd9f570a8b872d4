"""Irreducible components of one dimension: monodromy merges points, the trace test confirms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.decomposition.monodromy import carried, loop, merge
from nag.decomposition.trace import is_linear, second_differences, smallest_linear_unions
from nag.witness.fibres import Fibre, Tracker
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import PathCounts

# Loops that merge nothing before sums of traces are searched, and loops after which to give up:
# the worst of the measured systems needed 23.
IDLE_LOOPS = 4
MOST_LOOPS = 100
ATTEMPTS = 4


@dataclass(frozen=True, eq=False)
class Class:
    """Points of one component, as indices into all points of the fibres.

    ``reason`` says why they could not be confirmed to be a whole component; empty if they were.
    """

    indices: np.ndarray
    reason: str = ""


def _differences(
    fibres: Sequence[Fibre], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[np.ndarray | None, PathCounts]:
    counts = PathCounts()
    for _attempt in range(ATTEMPTS):
        differences, spent = second_differences(fibres, rows, rng, tracker)
        counts += spent
        if differences is not None:
            return differences, counts
    return None, counts


def _elsewhere(
    fibres: Sequence[Fibre], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[np.ndarray | None, PathCounts]:
    """Second differences of the same points carried to another generic slice."""
    counts = PathCounts()
    for _attempt in range(ATTEMPTS):
        target = random_rows(rng, len(rows), rows.shape[1] - 1)
        there, spent = carried(fibres, rows, target, complex(unit_complex(rng)), tracker)
        counts += spent
        if there is not None:
            differences, spent = second_differences(there, target, rng, tracker)
            counts += spent
            if differences is not None:
                return differences, counts
    return None, counts


def irreducible_classes(
    fibres: Sequence[Fibre], rows: np.ndarray, rng: np.random.Generator, tracker: Tracker
) -> tuple[list[Class], PathCounts]:
    """Split the points of ``fibres``, all on the slice ``rows``, into irreducible components.

    Loops merge points until the trace of every class is linear, on this slice and on another one.
    Where loops no longer merge, the smallest unions of classes with a linear trace are taken.
    """
    total = sum(len(fibre) for fibre in fibres)
    if len(rows) == 0:
        return [Class(np.array([i])) for i in range(total)], PathCounts()
    first, counts = _differences(fibres, rows, rng, tracker)
    if first is None:
        return [Class(np.arange(total), "the trace could not be computed")], counts
    labels = np.arange(total)
    idle = 0
    for _ in range(MOST_LOOPS):
        classes = [np.flatnonzero(labels == label) for label in np.unique(labels)]
        if all(is_linear(first[c]) for c in classes):
            break
        open_points = np.concatenate([c for c in classes if not is_linear(first[c])])
        if idle >= IDLE_LOOPS:
            waiting = [c for c in classes if not is_linear(first[c])]
            unions = smallest_linear_unions(waiting, first)
            if sum(map(len, unions)) == len(waiting):
                for union in unions:
                    joined = np.concatenate([waiting[c] for c in union])
                    labels[joined] = labels[joined].min()
                break
        active = _subset(fibres, open_points)
        permutation, spent = loop(active, rows, rng, tracker)
        counts += spent
        if permutation is None:
            idle += 1
            continue
        order = np.sort(open_points)
        whole = np.arange(total)
        whole[order] = order[permutation]
        merged = merge(labels, whole)
        idle = idle + 1 if np.array_equal(merged, labels) else 0
        labels = merged
    second, spent = _elsewhere(fibres, rows, rng, tracker)
    counts += spent
    result = []
    for label in np.unique(labels):
        indices = np.flatnonzero(labels == label)
        reason = ""
        if not is_linear(first[indices]):
            reason = "its trace is not linear: points are missing, or loops did not join them"
        elif second is None or not is_linear(second[indices]):
            reason = "its trace is not linear on a second slice"
        result.append(Class(indices, reason))
    return result, counts


def _subset(fibres: Sequence[Fibre], indices: np.ndarray) -> list[Fibre]:
    """The fibres with only the points of the given indices, in rising order."""
    result, start = [], 0
    for fibre in fibres:
        mask = np.isin(np.arange(start, start + len(fibre)), indices)
        if mask.any():
            result.append(fibre.only(mask))
        start += len(fibre)
    return result
