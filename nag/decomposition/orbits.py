"""Orbits: components that symmetries of the system carry into each other.

A symmetry g carries the points on the slice L to points on g(L); moved back to L, they are a
permutation of all points. Points of one component stay together under it. So a loop is tracked from
one point of each orbit of points only: what it joins, the permutations join elsewhere as well. One
component of each orbit of components is confirmed by its traces, and thereby all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.irreducible import Class, irreducible_classes
from nag.decomposition.monodromy import carried, located
from nag.decomposition.trace import is_linear, second_differences
from nag.witness.fibres import Fibre, Tracker
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import PathCounts

# Loops that join nothing before the rest is split without symmetries.
IDLE_LOOPS = 4
ATTEMPTS = 3


@dataclass(frozen=True, eq=False)
class Action:
    """A symmetry in the coordinates y of the decomposition, an affine map ``y -> M y + m``.

    Attributes:
        symmetry: the signed permutation of the original variables.
        M: real, shape ``(n, n)``.
        m: real, shape ``(n,)``.
    """

    symmetry: SignedPermutation
    M: np.ndarray
    m: np.ndarray

    @classmethod
    def of(
        cls, symmetry: SignedPermutation, T: np.ndarray, t: np.ndarray, kept: Sequence[int]
    ) -> Action:
        """The action on y where ``x = T y + t`` and y are the coordinates ``kept`` of x."""
        kept = list(kept)
        return cls(symmetry, symmetry.of_point(T.T).T[kept], symmetry.of_point(t)[kept])

    def __call__(self, y: np.ndarray) -> np.ndarray:
        """Images of points, shape ``(P, n)``."""
        return y @ self.M.T + self.m

    def pulled_back(self, rows: np.ndarray) -> np.ndarray:
        """The slice that is carried to the slice ``rows``."""
        constant = rows[:, :1] + rows[:, 1:] @ self.m[:, None]
        return np.hstack([constant, rows[:, 1:] @ self.M])


@dataclass(frozen=True, eq=False)
class Orbit:
    """Components that symmetries carry into each other.

    Attributes:
        representative: the component that was worked out.
        carriers: for each other component a symmetry that carries the representative into it.
    """

    representative: Class
    carriers: tuple[SignedPermutation, ...] = ()


@dataclass(frozen=True, eq=False)
class _Points:
    """All points of some fibres on the slice ``rows``, and how to track some of them."""

    fibres: Sequence[Fibre]
    rows: np.ndarray
    rng: np.random.Generator
    tracker: Tracker

    @property
    def x(self) -> np.ndarray:
        return np.vstack([fibre.x for fibre in self.fibres])

    def chosen(self, indices: np.ndarray) -> tuple[list[Fibre], np.ndarray]:
        """The fibres with only these points, and the points' indices in their order."""
        result, start = [], 0
        for fibre in self.fibres:
            mask = np.isin(np.arange(start, start + len(fibre)), indices)
            start += len(fibre)
            if mask.any():
                result.append(fibre.only(mask))
        return result, np.sort(indices)

    def gamma(self) -> complex:
        return complex(unit_complex(self.rng))


def irreducible_orbits(
    fibres: Sequence[Fibre],
    rows: np.ndarray,
    actions: Sequence[Action],
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[list[Orbit], PathCounts, tuple[str, ...]]:
    """Split the points of ``fibres``, all on the slice ``rows``, into orbits of components.

    Every point is in exactly one component of one orbit. Also returns what is wrong with the
    points: where the image of one is not among them, some are missing.
    """
    points, counts, notes = _Points(fibres, rows, rng, tracker), PathCounts(), []
    used: list[tuple[SignedPermutation, np.ndarray]] = []
    for action in actions:
        images, spent = _permutation(points, action)
        counts += spent
        if images is not None and (images < 0).any():
            missing = int((images < 0).sum())
            notes.append(f"{missing} images of points under a symmetry are not among the points")
        elif images is not None and not np.array_equal(images, np.arange(len(images))):
            used.append((action.symmetry, images))
    if not used or notes:
        classes, spent = irreducible_classes(fibres, rows, rng, tracker)
        return [Orbit(c) for c in classes], counts + spent, tuple(notes)
    permutations = [images for _, images in used]
    labels, reasons, spent = _classes(points, permutations)
    if not _carried_to_each_other(labels, permutations):
        notes.append("a symmetry carries a component to something else than a component")
    # Nothing follows by symmetry from a component that is not confirmed.
    if notes or reasons:
        used = []
    orbits = []
    for first, carriers in _orbits_of_classes(labels, used):
        indices = np.flatnonzero(labels == first)
        orbits.append(Orbit(Class(indices, reasons.get(first, "")), carriers))
    return orbits, counts + spent, tuple(notes)


def _carried_to_each_other(labels: np.ndarray, permutations: Sequence[np.ndarray]) -> bool:
    """Whether each permutation carries every class of points to exactly one class."""
    number = len(np.unique(labels))
    return all(
        len(np.unique(np.stack([labels, labels[p]]), axis=1).T) == number for p in permutations
    )


def _permutation(points: _Points, action: Action) -> tuple[np.ndarray | None, PathCounts]:
    """Where an action takes every point, back on the slice; -1 where no point is there.

    None if that does not become clear; the symmetry is then of no use.
    """
    counts, x = PathCounts(), points.x
    target = action.pulled_back(points.rows)
    for attempt in range(ATTEMPTS):
        there: Sequence[Fibre] | None = points.fibres
        if len(points.rows):
            there, spent = carried(
                points.fibres, points.rows, target, points.gamma(), points.tracker
            )
            counts += spent
        if there is None:
            continue
        images = located(action(np.vstack([fibre.x for fibre in there])), x)
        if images is not None and (images < 0).any() and attempt + 1 < ATTEMPTS:
            continue
        if images is not None and len(np.unique(images[images >= 0])) == (images >= 0).sum():
            return images, counts
    return None, counts


def join(labels: np.ndarray, pairs: Sequence[tuple[int, int]], permutations: Sequence) -> None:
    """Merge classes of points, in place, and with them all their images.

    A class is labelled by its smallest point. ``permutations`` are those of the symmetries; they
    carry points of one component to points of one component.
    """
    waiting = list(pairs)
    while waiting:
        i, j = waiting.pop()
        a, b = sorted((labels[i], labels[j]))
        if a != b:
            labels[labels == b] = a
            waiting += [(p[i], p[j]) for p in permutations]


def _orbits_of_points(permutations: Sequence[np.ndarray], total: int) -> np.ndarray:
    """A label for each point: the smallest one of its orbit."""
    labels = np.arange(total)
    for permutation in permutations:
        join(labels, list(enumerate(permutation)), ())
    return labels


def _orbits_of_classes(
    labels: np.ndarray, symmetries: Sequence[tuple[SignedPermutation, np.ndarray]]
) -> list[tuple[int, tuple[SignedPermutation, ...]]]:
    """For each orbit of classes its first class, and what carries it into each of the others."""
    result, done = [], set()
    for first in np.unique(labels).tolist():
        if first in done:
            continue
        done.add(first)
        orbit: list[tuple[int, SignedPermutation | None]] = [(first, None)]
        for current, carrier in orbit:
            for symmetry, permutation in symmetries:
                other = int(labels[permutation[current]])
                if other not in done:
                    done.add(other)
                    orbit.append((other, symmetry.after(carrier) if carrier else symmetry))
        result.append((first, tuple(carrier for _, carrier in orbit[1:] if carrier)))
    return result


def _classes(
    points: _Points, permutations: Sequence[np.ndarray]
) -> tuple[np.ndarray, dict[int, str], PathCounts]:
    """Labels of the components of all points, and why some are not confirmed."""
    x, counts = points.x, PathCounts()
    labels = np.arange(len(x))
    reasons: dict[int, str] = {}
    if len(points.rows) == 0:
        return labels, reasons, counts
    orbits = _orbits_of_points(permutations, len(x))
    confirmed: set[int] = set()
    tested: dict[int, int] = {}
    idle = 0
    while idle < IDLE_LOOPS:
        # A class and its images are confirmed together, by one of them.
        whole = np.isin(orbits, orbits[np.isin(labels, list(confirmed))])
        if whole.all():
            return labels, reasons, counts
        ends, start, spent = _around(points, np.unique(orbits[~whole]), x)
        counts += spent
        before = labels.copy()
        if ends is not None:
            join(labels, list(zip(start, ends, strict=True)), permutations)
        idle = idle + 1 if np.array_equal(before, labels) else 0
        for first in _one_of_each(labels, orbits, ~whole):
            size = int((labels == first).sum())
            if tested.get(first) == size:
                continue
            tested[first] = size
            linear, spent = _linear_on_two_slices(points, np.flatnonzero(labels == first))
            counts += spent
            if linear:
                confirmed.add(first)
    left = np.flatnonzero(~np.isin(orbits, orbits[np.isin(labels, list(confirmed))]))
    fibres, left = points.chosen(left)
    found, spent = irreducible_classes(fibres, points.rows, points.rng, points.tracker)
    for each in found:
        labels[left[each.indices]] = left[each.indices].min()
        if each.reason:
            reasons[int(left[each.indices].min())] = each.reason
    return labels, reasons, counts + spent


def _one_of_each(labels: np.ndarray, orbits: np.ndarray, chosen: np.ndarray) -> list[int]:
    """One class of each orbit of classes among the chosen points.

    Classes are in one orbit when some of their points are; the loops' joins are closed under the
    symmetries, so then all are.
    """
    result, seen = [], set()
    for first in np.unique(labels[chosen]).tolist():
        touched = set(orbits[labels == first].tolist())
        if not touched & seen:
            result.append(first)
            seen |= touched
    return result


def _around(
    points: _Points, start: np.ndarray, x: np.ndarray
) -> tuple[np.ndarray | None, np.ndarray, PathCounts]:
    """Where a loop of slices carries some points; None if that is not clear."""
    counts, rows = PathCounts(), points.rows
    fibres, start = points.chosen(start)
    for _attempt in range(ATTEMPTS):
        middle = random_rows(points.rng, len(rows), rows.shape[1] - 1)
        out, back = points.gamma(), points.gamma()
        there, spent = carried(fibres, rows, middle, out, points.tracker)
        counts += spent
        if there is None:
            continue
        again, spent = carried(there, middle, rows, back, points.tracker)
        counts += spent
        if again is not None:
            ends = located(np.vstack([fibre.x for fibre in again]), x)
            if ends is not None and (ends >= 0).all() and len(np.unique(ends)) == len(ends):
                return ends, start, counts
    return None, start, counts


def _linear_on_two_slices(points: _Points, indices: np.ndarray) -> tuple[bool, PathCounts]:
    """Whether the trace of some points is linear, on their slice and on another one."""
    counts, rows = PathCounts(), points.rows
    fibres, _ = points.chosen(indices)
    for _attempt in range(ATTEMPTS):
        differences, spent = second_differences(fibres, rows, points.rng, points.tracker)
        counts += spent
        if differences is None:
            continue
        if not is_linear(differences):
            return False, counts
        target = random_rows(points.rng, len(rows), rows.shape[1] - 1)
        there, spent = carried(fibres, rows, target, points.gamma(), points.tracker)
        counts += spent
        if there is None:
            continue
        differences, spent = second_differences(there, target, points.rng, points.tracker)
        counts += spent
        if differences is not None:
            return is_linear(differences), counts
    return False, counts
