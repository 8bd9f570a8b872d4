"""Orbits: components that symmetries of the system carry into each other.

A symmetry g carries the points on the slice L to points on g(L); moved back to L, they are some of
the points. One point of each component shows which component that is carried to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.monodromy import places_among
from nag.decomposition.splitting import Class, split
from nag.tracking.run import Run
from nag.witness.frame import Frame
from nag.witness.points import Points, move_points
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
        m = (symmetry.of_point(frame.t) - frame.t)[kept] / frame.scales
        return cls(symmetry, M, m)

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
    run: Run,
) -> Orbits:
    """Split points on a generic slice into orbits of components.

    Args:
        evidence: digits to which traces must be linear.
    """
    found = split(points, evidence, rng, run)
    firsts = np.unique(found.labels).tolist()
    used, counts, notes = _images_of(found.points, firsts, actions, rng, run)
    counts += found.counts
    if not notes and not all(_carries_classes(found.labels, images) for images in used):
        notes.append("a symmetry carries a component to something else than a component")
    # Nothing follows by symmetry from a component that is not confirmed.
    if notes or any(c.reason for c in found.classes):
        used = []
    classes = {int(c.indices[0]): c for c in found.classes}
    orbits = [
        Orbit(classes[first], carriers)
        for first, carriers in _orbits_of_classes(found.labels, used)
    ]
    return Orbits(found.points, tuple(orbits), counts, tuple(notes))


@dataclass(frozen=True, eq=False)
class _Images:
    """Where a symmetry takes some points, by index."""

    symmetry: SignedPermutation
    indices: np.ndarray
    places: np.ndarray


def _images_of(
    points: Points,
    indices: Sequence[int],
    actions: Sequence[Action],
    rng: np.random.Generator,
    run: Run,
) -> tuple[list[_Images], PathCounts, list[str]]:
    """Where actions take some points, back on the slice, and what is wrong.

    Actions for which that does not become clear, or that move no point, are left out.
    """
    counts, found, notes = PathCounts(), [], []
    for action in actions if len(indices) else ():
        places, spent = _places(points, indices, action, rng, run)
        counts += spent
        if places is not None and (places < 0).any():
            missing = int((places < 0).sum())
            notes.append(f"{missing} images of points under a symmetry are not among the points")
        elif places is not None and not np.array_equal(places, indices):
            found.append(_Images(action.symmetry, np.array(indices), places))
    return found, counts, notes


def _carries_classes(labels: np.ndarray, images: _Images) -> bool:
    """Whether a symmetry carries every class of points to one class, of as many points."""
    pairs = np.unique(np.stack([labels[images.indices], labels[images.places]]), axis=1)
    sizes = np.bincount(labels)
    single = all(len(np.unique(side)) == pairs.shape[1] for side in pairs)
    return single and np.array_equal(sizes[pairs[0]], sizes[pairs[1]])


def _places(
    points: Points,
    indices: Sequence[int],
    action: Action,
    rng: np.random.Generator,
    run: Run,
) -> tuple[np.ndarray | None, PathCounts]:
    """Where an action takes some points, back on the slice; -1 where no point is there.

    None if that does not become clear; the symmetry is then of no use.
    """
    counts, there = PathCounts(), points.x[indices]
    if points.dimension:
        target, gamma = action.pulled_back(points.rows), complex(unit_complex(rng))
        moved, _, counts = move_points(points, indices, target, gamma, run)
        there = moved.x
    if len(there) < len(indices):
        return None, counts
    places = places_among(action(there), points.x)
    if places is None or len(np.unique(places[places >= 0])) < (places >= 0).sum():
        return None, counts
    return places, counts


def _orbits_of_classes(
    labels: np.ndarray, images: Sequence[_Images]
) -> list[tuple[int, tuple[SignedPermutation, ...]]]:
    """For each orbit of classes its first class, and what carries it into each of the others."""
    carried = [
        (each.symmetry, dict(zip(labels[each.indices], labels[each.places], strict=True)))
        for each in images
    ]
    result, done = [], set()
    for first in np.unique(labels).tolist():
        if first in done:
            continue
        done.add(first)
        orbit: list[tuple[int, SignedPermutation | None]] = [(first, None)]
        for current, carrier in orbit:
            for symmetry, there in carried:
                other = int(there[current])
                if other not in done:
                    done.add(other)
                    orbit.append((other, symmetry.after(carrier) if carrier else symmetry))
        result.append((first, tuple(carrier for _, carrier in orbit[1:] if carrier)))
    return result
