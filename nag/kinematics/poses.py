"""Places and turns of bodies at many points at once.

Quaternions are arrays of shape ``(..., 4)``, real part first, of norm one; a vector has shape
``(..., 3)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.mechanism.quaternion import conjugate, multiply, rotate
from nag.numerics.read_only import FixedArrays, RealArray, equal_values, handed_over


def turn_product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Products of quaternions, one turn after another."""
    return np.stack(np.broadcast_arrays(*multiply(_parts(a), _parts(b))), axis=-1)


def turn_back(a: np.ndarray) -> np.ndarray:
    """Conjugates of quaternions."""
    return np.stack(conjugate(_parts(a)), axis=-1)


def turn_vectors(a: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Vectors, turned by quaternions of norm one."""
    return np.stack(np.broadcast_arrays(*rotate(_parts(a), _parts(v))), axis=-1)


def _parts(a: np.ndarray) -> tuple[np.ndarray, ...]:
    return tuple(np.moveaxis(np.asarray(a, dtype=float), -1, 0))


# Decides: Distance in radians and sizes at which two configurations are one: vertices are known to
# half the digits, others that are special lay beyond 1e-3. Imaginary parts, beside a point, of what
# rounding may have parted from a double real zero.
SAME = 1e-6


@dataclass(frozen=True, eq=False)
class Poses(FixedArrays):
    """Where bodies are, at ``k`` configurations.

    Attributes:
        turns: unit quaternions of each body's frame, shape ``(bodies, k, 4)``.
        places: of its origin, shape ``(bodies, k, 3)``.
    """

    turns: RealArray
    places: RealArray

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for name in ("turns", "places"):
            object.__setattr__(self, name, handed_over(getattr(self, name)))

    def __len__(self) -> int:
        return self.turns.shape[1]

    @classmethod
    def of(cls, turns: Sequence[np.ndarray], places: Sequence[np.ndarray], count: int) -> Poses:
        """Bodies one by one; what does not change may be given once."""
        return cls(
            np.stack([np.broadcast_to(q, (count, 4)) for q in turns]),
            np.stack([np.broadcast_to(r, (count, 3)) for r in places]),
        )

    def move(self, body: int, point: np.ndarray) -> RealArray:
        """Where a point of a body is, given in its frame, shape ``(k, 3)``."""
        return self.places[body] + turn_vectors(self.turns[body], point)

    def turn(self, body: int, vector: np.ndarray) -> RealArray:
        """A direction of a body, given in its frame, shape ``(k, 3)``."""
        return turn_vectors(self.turns[body], vector)

    def at(self, indices: np.ndarray | slice) -> Poses:
        """Some of the configurations."""
        return Poses(self.turns[:, indices].copy(), self.places[:, indices].copy())

    def with_continuous_signs(self) -> Poses:
        """The same with signs of quaternions that do not jump; the first ones stay."""
        products = (self.turns[:, 1:] * self.turns[:, :-1]).sum(axis=-1)
        signs = np.cumprod(np.where(products < 0, -1.0, 1.0), axis=1)
        signs = np.concatenate([np.ones((len(signs), 1)), signs], axis=1)
        return Poses(self.turns * signs[:, :, None], self.places)


@dataclass(frozen=True, eq=False)
class FreeRod(FixedArrays):
    """Bodies, fixed to each other, that turn about a line as they like.

    Attributes:
        bodies: indices.
        ends: two points of the line in the frame of each, shape ``(bodies, 2, 3)``.
    """

    bodies: tuple[int, ...]
    ends: RealArray

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "ends", handed_over(self.ends))

    def direction(self, k: int) -> RealArray:
        """Unit vector along the line in the frame of the ``k``-th of its bodies."""
        span = self.ends[k, 1] - self.ends[k, 0]
        return np.asarray(span / np.linalg.norm(span))


@dataclass(frozen=True, eq=False)
class PoseMeasure:
    """By what configurations are compared: the same in whatever coordinates they were found.

    Attributes:
        centres: a point of each body, in its frame, shape ``(bodies, 3)``; of a free rod one on its
            line.
        size: a length.
        rods: bodies of which only the line counts that they turn about.
    """

    centres: np.ndarray
    size: float
    rods: tuple[FreeRod, ...] = ()


def join_poses(several: Sequence[Poses]) -> Poses:
    """The configurations of all of them, one after another."""
    return Poses(
        np.concatenate([each.turns for each in several], axis=1),
        np.concatenate([each.places for each in several], axis=1),
    )


def pose_steps(poses: Poses, measure: PoseMeasure) -> np.ndarray:
    """How far configurations are from the ones before them, shape ``(k - 1,)``.

    The root of the sum over bodies of the squared angle turned by, and of the squared way of a
    point of each over the size. Turns of free rods about themselves do not count.
    """
    return pose_distances(poses.at(slice(1, None)), poses.at(slice(None, -1)), measure)


def pose_distances(one: Poses, other: Poses, measure: PoseMeasure) -> np.ndarray:
    """The same between configurations of two lists, those with the same number."""
    # Chords of unit quaternions: arc cosines lose half of the digits where turns are alike.
    chords = np.sqrt(np.maximum(_least_square(one.turns, other.turns), 0.0))
    angles = 4 * np.arcsin(np.minimum(chords / 2, 1.0))
    for rod in measure.rods:
        for k, body in enumerate(rod.bodies):
            along = rod.direction(k)
            chord = np.linalg.norm(one.turn(body, along) - other.turn(body, along), axis=-1)
            angles[body] = 2 * np.arcsin(np.minimum(chord / 2, 1.0))
    ways = one.places - other.places
    for body, centre in enumerate(measure.centres):
        ways[body] += turn_vectors(one.turns[body], centre)
        ways[body] -= turn_vectors(other.turns[body], centre)
    squares = (angles**2).sum(axis=0) + (ways**2).sum(axis=(0, 2)) / measure.size**2
    return np.sqrt(squares)


def steady_rods(poses: Poses, rods: Sequence[FreeRod], closed: bool) -> Poses:
    """The same with rods that turn about themselves as little as possible along the way.

    What is left of it after a closed motion is spread over all of that.
    """
    turns, places = poses.turns.copy(), poses.places.copy()
    for rod in rods:
        first = rod.bodies[0]
        along, own = poses.turn(first, rod.direction(0)), poses.turns[first]
        before, after = along[:-1], along[1:]
        product = (before * after).sum(axis=-1, keepdims=True)
        least = np.concatenate([1 + product, np.cross(before, after)], axis=-1)
        least /= np.linalg.norm(least, axis=-1, keepdims=True)
        more = turn_product(own[1:], turn_back(turn_product(least, own[:-1])))
        each = 2 * np.arctan2((more[:, 1:] * after).sum(axis=-1), more[:, 0])
        angles = -np.concatenate([[0.0], np.cumsum(each)])
        if closed:
            left = (angles[-1] + np.pi) % (2 * np.pi) - np.pi
            angles -= left * np.linspace(0, 1, len(angles))
        half = angles[:, None] / 2
        spin = np.concatenate([np.cos(half), np.sin(half) * along], axis=-1)
        fixed = poses.move(first, rod.ends[0, 0])
        for body in rod.bodies:
            turns[body] = turn_product(spin, poses.turns[body])
            places[body] = fixed + turn_vectors(spin, poses.places[body] - fixed)
    return Poses(turns, places)


def _least_square(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Squared distances of quaternions up to sign."""
    return np.minimum(((a - b) ** 2).sum(axis=-1), ((a + b) ** 2).sum(axis=-1))
