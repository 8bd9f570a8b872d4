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
from nag.decomposition.monodromy import places_among
from nag.decomposition.splitting import Class, split
from nag.witness.fibres import Tracker
from nag.witness.frame import Frame
from nag.witness.points import Points, moved_points
from nag.witness.slices import unit_complex
from nag.witness.witness import PathCounts


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
    def of(cls, symmetry: SignedPermutation, frame: Frame) -> Action:
        """The action on the coordinates of a frame."""
        kept = list(frame.positions)
        M = symmetry.of_point(frame.T.T).T[kept] / frame.scales[:, None]
        return cls(symmetry, M, symmetry.of_point(frame.t)[kept] / frame.scales)

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
class Orbits:
    """Points, and the orbits of components that they fall into; each point is in one component.

    Attributes:
        notes: what is wrong with the points: where the image of one is not among them, some are
            missing.
    """

    points: Points
    orbits: tuple[Orbit, ...]
    counts: PathCounts
    notes: tuple[str, ...] = ()


def irreducible_orbits(
    points: Points,
    actions: Sequence[Action],
    evidence: int,
    rng: np.random.Generator,
    tracker: Tracker,
) -> Orbits:
    """Split points on a generic slice into orbits of components.

    Args:
        evidence: digits to which traces must be linear.
    """
    counts, notes = PathCounts(), []
    used: list[tuple[SignedPermutation, np.ndarray]] = []
    for action in actions:
        images, spent = _permutation(points, action, rng, tracker)
        counts += spent
        if images is not None and (images < 0).any():
            missing = int((images < 0).sum())
            notes.append(f"{missing} images of points under a symmetry are not among the points")
        elif images is not None and not np.array_equal(images, np.arange(len(images))):
            used.append((action.symmetry, images))
    if notes:
        used = []
    permutations = [images for _, images in used]
    found = split(points, permutations, evidence, rng, tracker)
    counts += found.counts
    # Loops that add points leave symmetries alone: then nothing is known of the images.
    if len(found.points) > len(points):
        used, permutations = [], []
    if not _carried_to_each_other(found.labels, permutations):
        notes.append("a symmetry carries a component to something else than a component")
    # Nothing follows by symmetry from a component that is not confirmed.
    reasons = {int(c.indices[0]): c.reason for c in found.classes}
    if notes or any(reasons.values()):
        used = []
    classes = {int(c.indices[0]): c for c in found.classes}
    orbits = [
        Orbit(classes[first], carriers)
        for first, carriers in _orbits_of_classes(found.labels, used)
    ]
    return Orbits(found.points, tuple(orbits), counts, tuple(notes))


def _carried_to_each_other(labels: np.ndarray, permutations: Sequence[np.ndarray]) -> bool:
    """Whether each permutation carries every class of points to exactly one class."""
    number = len(np.unique(labels))
    return all(
        len(np.unique(np.stack([labels, labels[p]]), axis=1).T) == number for p in permutations
    )


def _permutation(
    points: Points, action: Action, rng: np.random.Generator, tracker: Tracker
) -> tuple[np.ndarray | None, PathCounts]:
    """Where an action takes every point, back on the slice; -1 where no point is there.

    None if that does not become clear; the symmetry is then of no use.
    """
    counts, everything = PathCounts(), range(len(points))
    target = action.pulled_back(points.rows)
    there = points
    if points.dimension:
        gamma = complex(unit_complex(rng))
        there, _, counts = moved_points(points, everything, target, gamma, tracker)
    if len(there) < len(points):
        return None, counts
    images = places_among(action(there.x), points.x)
    if images is None or len(np.unique(images[images >= 0])) < (images >= 0).sum():
        return None, counts
    return images, counts


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
