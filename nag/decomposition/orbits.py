"""Orbits: components that symmetries of the system carry into each other.

A symmetry g carries the points on the slice L to points on g(L); moved back to L, they are some of
the points. One point of each component shows which component that is carried to. Where the points
on L are all known, classes of them are carried (`irreducible_orbits`); else components, which may
be carried to others that were not known (`group_into_orbits`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.monodromy import locate_points
from nag.decomposition.splitting import Split, split_points
from nag.numerics.coincidence import coincident
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.frame import Frame, image
from nag.witness.moving import witness_at
from nag.witness.points import Points, move_points
from nag.witness.slices import unit_complex
from nag.witness.witness import PathCounts, Slice, WitnessSet

T = TypeVar("T")


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


def irreducible_orbits(
    points: Points,
    actions: Sequence[Action],
    evidence: int,
    rng: np.random.Generator,
    run: Run,
) -> Split:
    """Split points on a generic slice into orbits of components, of which it tells one each.

    Args:
        evidence: digits to which traces must be linear.
    """
    found = split_points(points, evidence, rng, run)
    firsts = np.unique(found.labels).tolist()
    used, counts, notes = _images_of(found.points, firsts, actions, rng, run)
    counts += found.counts
    if not notes and not all(_carries_classes(found.labels, images) for images in used):
        notes.append("a symmetry carries a component to something else than a component")
    # Nothing follows by symmetry from a component that is not confirmed.
    if notes or any(c.reason for c in found.classes):
        used = []
    by_first = {int(c.indices[0]): c for c in found.classes}
    classes = tuple(
        replace(by_first[first], carriers=carriers)
        for first, carriers in _orbits_of_classes(found.labels, used)
    )
    return replace(found, classes=classes, counts=counts, notes=tuple(notes))


@dataclass(frozen=True, eq=False)
class _PointImages:
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
) -> tuple[list[_PointImages], PathCounts, list[str]]:
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
            found.append(_PointImages(action.symmetry, np.array(indices), places))
    return found, counts, notes


def _carries_classes(labels: np.ndarray, images: _PointImages) -> bool:
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
    places = locate_points(action(there), points.x)
    if places is None or len(np.unique(places[places >= 0])) < (places >= 0).sum():
        return None, counts
    return places, counts


def _orbits_of_classes(
    labels: np.ndarray, images: Sequence[_PointImages]
) -> list[tuple[int, tuple[SignedPermutation, ...]]]:
    """For each orbit of classes its first class, and what carries it into each of the others."""
    maps = [dict(zip(labels[g.indices], labels[g.places], strict=True)) for g in images]

    def carry(known: Sequence[int], current: int, k: int, _: SignedPermutation) -> int | None:
        there = int(maps[k][current])
        return None if there in known else there

    result, done = [], set[int]()
    for first in np.unique(labels).tolist():
        if first not in done:
            ways, members = find_orbit(first, [g.symmetry for g in images], carry)
            done.update(members)
            result.append((first, ways))
    return result


def find_orbit(
    first: T,
    generators: Sequence[SignedPermutation],
    carry: Callable[[Sequence[T], T, int, SignedPermutation], T | None],
) -> tuple[tuple[SignedPermutation, ...], list[T]]:
    """The orbit of something under a group, itself first, and what carries it into each other.

    Args:
        carry: for what is known of the orbit, one of it, the index of a generator, and what carries
            the first one into that one's image: the image, or None if it is known.
    """
    ways, members = list[SignedPermutation](), [first]
    for i, member in enumerate(members):
        for k, generator in enumerate(generators):
            way = generator.after(ways[i - 1]) if i else generator
            there = carry(members, member, k, way)
            if there is not None:
                ways.append(way)
                members.append(there)
    return tuple(ways), members


@takes_run
def group_into_orbits(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    symmetries: Sequence[SignedPermutation],
    *,
    run: Run = DEFAULT_RUN,
) -> tuple[list[WitnessSet], PathCounts]:
    """One component of each orbit, with the symmetries that carry it into the others.

    An image of a component is told from the others by one of its points, moved to the common
    slice. Images that are in nobody's list are added to the orbit all the same.

    Args:
        components: complete ones, those of one dimension on a common slice.
        symmetries: signed permutations that keep the system.

    Raises:
        nag.witness.moving.SliceError: if points cannot be moved to the common slice.
    """
    rest, found, tracked = list(components), [], 0

    def move(component: WitnessSet, target: Slice) -> WitnessSet:
        nonlocal tracked
        if component.dimension == 0:
            return component
        tracked += component.degree
        return witness_at(system, component, target, run=run)

    def carry(
        known: Sequence[WitnessSet], _: WitnessSet, __: int, way: SignedPermutation
    ) -> WitnessSet | None:
        first = known[0]
        there = image(first, way)
        end = move(_first_point(there), first.slice)
        if any(_is_among(end, member) for member in known):
            return None
        # Components that stand earlier have their whole orbits.
        for k, other in enumerate(rest):
            if other.dimension == first.dimension and _is_among(end, other):
                return rest.pop(k)
        return move(there, first.slice)

    while rest:
        first = rest.pop(0)
        ways, _ = find_orbit(first, symmetries, carry)
        found.append(replace(first, orbit=1 + len(ways), images=ways))
    return found, PathCounts(tracked)


def _first_point(component: WitnessSet) -> WitnessSet:
    """A witness set with one of its points only, to be moved."""
    fibres = tuple(fibre.only([0]) for fibre in component.fibres[:1])
    own = {name: getattr(component, name)[:1] for name in ("points", "radii", "digits")}
    return replace(component, **own, fibres=fibres)


def _is_among(end: WitnessSet, component: WitnessSet) -> bool:
    """Whether the one point of a witness set is among those of another."""
    error = max(end.accuracy, component.accuracy)
    return bool(coincident(component.points, end.points[0], error).any())
