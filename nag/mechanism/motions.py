"""What the poses of a set have in common, in words: displacement groups and screw systems.

The twists of a set at a pose are a linear space of screws, a screw system (Hunt 1978). Where it is
the same at all poses they are those of a group of displacements, followed by a constant one
(Herve 1978): translations, motions in a plane, about a point, ...
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.mechanism.inverse_kinematics import conjugate_pose, multiply_poses
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank
from nag.text.table import count_text, join_words

# Decides: Pitches, moments and entries of unit axes that are zero in what is said of a motion in
# words.
NO_PITCH = 1e-7


@dataclass(frozen=True)
class ScrewSystem:
    """The twists at one pose.

    Attributes:
        rank: number of independent ones.
        turning: number of independent directions of their axes; the others are translations.
        pitches: principal pitches, ascending, lengths; fewer than ``turning`` where those about
            some axes are any.
    """

    rank: int
    turning: int
    pitches: tuple[float, ...]

    def __str__(self) -> str:
        parts = []
        if self.pitches:
            kind = "principal pitches" if len(self.pitches) > 1 else "pitch"
            parts.append(f"{kind} {join_words([f'{p:.4g}' for p in self.pitches])}")
        if self.turning > len(self.pitches):
            count = count_text(self.turning - len(self.pitches), "axis", "axes")
            parts.append(f"{count} of any pitch")
        if self.rank > self.turning:
            parts.append(count_text(self.rank - self.turning, "translation"))
        return f"rank {self.rank}: {', '.join(parts)}"


@dataclass(frozen=True)
class MotionType:
    """What the poses of a set have in common.

    Attributes:
        rank: of the twists at a general pose.
        turning: of their directions.
        group: of displacements that the poses are, after a constant one; empty where they are none.
        place: where in space the group has an axis, a normal or a centre, in words.
        start: the constant displacement in words, where it is no displacement of the group and has
            short ones.
    """

    rank: int
    turning: int
    group: str
    place: str = ""
    start: str = ""

    def __str__(self) -> str:
        if self.group:
            text = f"{self.group} {self.place}".rstrip()
            return f"{text}, {self.start}" if self.start else text
        if not self.turning:
            return f"translation with {count_text(self.rank, 'freedom')}"
        slides = self.rank - self.turning
        about = {1: "about one direction", 2: "about two directions", 3: "in all directions"}
        text = f"turns {about[self.turning]}"
        return text if not slides else f"{text}, with {count_text(slides, 'translation')}"


def twists_at(pose: np.ndarray, tangents: np.ndarray, length: float) -> np.ndarray:
    """The twists, in the ground's coordinates, of tangent vectors at a pose.

    Args:
        pose: Study coordinates, shape ``(8,)``.
        tangents: derivatives of these, shape ``(d, 8)``.
        length: by which lengths are measured.

    Returns:
        Directions of axes and velocities of the origin, shape ``(d, 6)``.
    """
    norm = np.sum(pose[:4] ** 2)
    moved = multiply_poses(tangents, conjugate_pose(pose)[None]) * 2 / norm
    return np.hstack([moved[:, 1:4], moved[:, 5:8] / length])


def _rank(rows: np.ndarray) -> int:
    size = np.abs(rows).max(initial=0.0)
    return 0 if size < NO_PITCH else rows.shape[1] - matrix_corank(rows / size, NEARLY_SINGULAR)


def motion_of(
    poses: np.ndarray,
    systems: Sequence[np.ndarray],
    length: float,
    origin: np.ndarray | None = None,
) -> MotionType:
    """What poses have in common, by some general ones and their twists.

    Args:
        poses: Study coordinates, shape ``(k, 8)``.
        systems: orthonormal bases of the twists, shape ``(d, 6)`` each.
        length: by which lengths are measured.
        origin: the place of the origin of these coordinates; by default it is the global one.
    """
    rank = len(systems[0])
    turning = _rank(systems[0][:, :3])
    if _rank(np.vstack(systems)) > rank:
        return MotionType(rank, turning, "")
    there = np.zeros(3) if origin is None else origin
    return _motion_of_group(systems[0], turning, poses[0], length, there)


def _motion_of_group(
    twists: np.ndarray, turning: int, pose: np.ndarray, length: float, origin: np.ndarray
) -> MotionType:
    """The group whose twists these are, and how it lies; unnamed where its axis is not real."""
    rank = len(twists)
    slides = _translations(twists, turning)
    turn = pose[:4] / np.sqrt(np.sum(pose[:4] ** 2))
    if not _has_real_span(slides) or (turning == 1 and not _has_real_span(twists[:, :3])):
        # Modes without real poses may have such axes, isotropic ones among them.
        return MotionType(rank, turning, "")
    if not turning:
        names = ("", "translation along", "translation parallel to a plane", "translation")
        place = _vector_text(slides[0]) if rank == 1 else ""
        if rank == 2:
            place = f"normal to {_vector_text(np.cross(*slides))}"
        return MotionType(rank, turning, names[rank], place, _start_text(turn))
    axis = _turns(twists, turning)[0][:3]
    along = _vector_text(axis)
    still = np.linalg.norm(np.cross(axis, slides), axis=1) if len(slides) else np.zeros(0)
    moment = _turns(twists, turning)[0][3:]
    if (turning, rank) == (1, 1) and abs(np.sum(axis * moment)) < NO_PITCH:
        place = (
            f"about the line through {_point_on_axis(axis, moment, length, origin)} along {along}"
        )
        return MotionType(rank, turning, "rotation", place)
    if (turning, rank) == (1, 2) and still.max() < NO_PITCH:
        return MotionType(rank, turning, "rotation and translation", f"about and along {along}")
    if (turning, rank) == (1, 3) and np.abs(slides @ axis).max() < NO_PITCH:
        place = f"normal to {along}"
        return MotionType(rank, turning, "planar motion", place, _over_text(turn, axis))
    if (turning, rank) == (1, 4):
        group = "translation and rotation (Schoenflies)"
        return MotionType(rank, turning, group, f"about {along}", _over_text(turn, axis))
    if (turning, rank) == (3, 3):
        # The velocity of the origin of a turn w about the centre c is c x w.
        found = np.linalg.lstsq(_cross_rows(twists[:, :3]), twists[:, 3:].ravel(), rcond=None)[0]
        if np.abs(found.imag).max() > NO_PITCH:
            return MotionType(rank, turning, "spherical motion", "about a complex point")
        centre = found.real * length + origin
        place = f"about the point {_point_text(centre)}"
        return MotionType(rank, turning, "spherical motion", place)
    return MotionType(rank, turning, "all displacements" if rank == 6 else "")


def _point_on_axis(axis: np.ndarray, moment: np.ndarray, length: float, origin: np.ndarray) -> str:
    """The point nearest to the origin of a line that turns are about."""
    turn = axis / axis[np.argmax(np.abs(axis))]
    turn, moment = turn.real, (moment / axis[np.argmax(np.abs(axis))]).real
    size = float(turn @ turn)
    point = np.cross(turn, moment) / size * length + origin
    return _point_text(point - (point @ turn) / size * turn)


def _cross_rows(axes: np.ndarray) -> np.ndarray:
    """The matrix that takes c to all c x w, one below the other."""
    rows = [np.cross(unit, axes).ravel() for unit in np.eye(3)]
    return np.array(rows).T


def _start_text(turn: np.ndarray) -> str:
    """A constant orientation, a unit quaternion, in words; empty for that of the reference."""
    if np.abs(turn.imag).max() > NO_PITCH:
        return "turned by a complex angle"
    if np.linalg.norm(turn[1:]) < NO_PITCH:
        return ""
    turn = turn.real * (1 if turn[0].real >= 0 else -1)
    angle = np.degrees(2 * np.arctan2(np.linalg.norm(turn[1:]), turn[0]))
    return f"turned by {angle:.4g} degrees about {_vector_text(turn[1:])}"


def _over_text(turn: np.ndarray, axis: np.ndarray) -> str:
    """Whether an orientation reverses an axis, in words."""
    motion = np.zeros(8, dtype=complex)
    motion[:4] = turn
    vector = np.array([0, *axis, 0, 0, 0, 0])
    moved = multiply_poses(multiply_poses(motion, vector), conjugate_pose(motion))[1:4]
    return "turned over" if np.linalg.norm(moved + axis) < NO_PITCH * np.linalg.norm(axis) else ""


def _has_real_span(vectors: np.ndarray) -> bool:
    """Whether vectors span what their complex conjugates span; shape ``(d, n)``."""
    return not len(vectors) or _rank(np.vstack([vectors, vectors.conj()])) == _rank(vectors)


def _vector_text(vector: np.ndarray) -> str:
    """A direction, real up to a factor, with its smallest entry one."""
    entries = (vector / vector[np.argmax(np.abs(vector))]).real
    entries[np.abs(entries) < NO_PITCH] = 0
    entries = entries / np.abs(entries[entries != 0]).min()
    first = entries[np.flatnonzero(entries)[0]]
    return _point_text(entries * np.sign(first))


def _point_text(point: np.ndarray) -> str:
    return f"({', '.join(f'{x + 0.0:.4g}' for x in np.where(np.abs(point) < NO_PITCH, 0, point))})"


def _translations(twists: np.ndarray, turning: int) -> np.ndarray:
    """An orthonormal basis of the translations, shape ``(d - turning, 3)``."""
    left, _, _ = np.linalg.svd(twists[:, :3])
    return left[:, turning:].T.conj() @ twists[:, 3:]


def _turns(twists: np.ndarray, turning: int) -> np.ndarray:
    """A complement of the translations, shape ``(turning, 6)``."""
    left, _, _ = np.linalg.svd(twists[:, :3])
    return left[:, :turning].T.conj() @ twists


def screw_system(twists: np.ndarray, length: float) -> ScrewSystem:
    """Rank and principal pitches of real twists.

    The pitch of (w, v) is (w.v) / (w.w); its stationary values are the eigenvalues of the one form
    beside the other, where translations are left out that are orthogonal to all axes. One that is
    not makes the pitch about some axis any.

    Args:
        twists: orthonormal, real, shape ``(d, 6)``; velocities in lengths of ``length``.
    """
    rank, turning = len(twists), _rank(twists[:, :3])
    if not turning:
        return ScrewSystem(rank, 0, ())
    turns = _turns(twists, turning)
    slides = _translations(twists, turning)
    if len(slides):
        # Pitches about axes that no translation of the system has a component along.
        along = slides @ turns[:, :3].T
        _, singular, directions = np.linalg.svd(along)
        free = int(np.sum(singular > NO_PITCH))
        turns = directions[free:] @ turns
        # Velocities along the translations are of no matter.
        turns[:, 3:] -= turns[:, 3:] @ np.linalg.pinv(slides) @ slides
    if not len(turns):
        return ScrewSystem(rank, turning, ())
    axes, moments = turns[:, :3], turns[:, 3:]
    triangle = np.linalg.cholesky(axes @ axes.T)
    inverse = np.linalg.inv(triangle)
    form = axes @ moments.T
    values = np.linalg.eigvalsh(inverse @ (form + form.T) @ inverse.T / 2)
    pitches = [0.0 if abs(v) < NO_PITCH else float(v * length) for v in values]
    return ScrewSystem(rank, turning, tuple(sorted(pitches)))
