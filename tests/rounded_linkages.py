"""Rounded overconstrained linkages: gap and least change beside least squares of another kind.

Loops of revolute joints are written as products of SciPy's rotations about lines. A motion is
followed by arc length with `scipy.optimize.least_squares`, one gap after the other, and the least
change of the lines is the shortest solution of the linearised conditions that the gaps' left null
vectors make at several positions. Nothing of `nag.mechanism.nearly_mobile` is used for that.

    python tests/rounded_linkages.py --poses 3 --controls 10
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import overconstrained_linkages as known
from scipy.linalg import null_space
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import nag
from nag.mechanism.graph import Mechanism
from nag.mechanism.nearly_mobile import find_near_motion

Array = np.ndarray

KINDS: dict[str, Callable[[], known.Lines]] = {
    "Bennett": lambda: known.assembled("bennett"),
    "Goldberg": lambda: known.assembled("goldberg-5r"),
    "Bricard, trihedral": lambda: known.assembled("bricard-trihedral"),
    "Bricard, line-symmetric": known.line_symmetric,
    "Bricard, plane-symmetric": known.plane_symmetric,
    "Sarrus": known.sarrus,
}
# Of a motion, in radians, the longest first: next to where two motions meet gaps are sharp. A
# position is found to rounding.
ARCS, EXACT = (0.1, 0.03, 0.01), 1e-15
# Radians after which a motion is given up.
LONGEST = 60.0
POSITIONS = 16
# Steps that close a loop; conditions of sizes below so many gaps are none; gaps beside which the
# number of conditions is seen.
STEPS, ALIKE, SMALL = 20, 10, 1e-8
# Gaps of a loop that is closed; parts by which sizes that are alike differ.
CLOSED, ALIKE_GAPS, ALIKE_CHANGES = 1e-11, 0.1, 0.25
# Gaps at which a motion is given up.
WIDE = 0.03


@dataclass(frozen=True)
class Loop:
    """Lines of a loop in its own units: from the point nearest to all of them, by their distance.

    Attributes:
        axes, feet: unit directions, and the points next to the centre.
        size: the unit.
    """

    axes: Array
    feet: Array
    size: float

    @classmethod
    def of(cls, mechanism: Mechanism, size: float | None = None) -> Loop:
        axes, points = (
            np.array([[float(x) for x in getattr(j, name)] for j in mechanism.joints])
            for name in ("axis", "point")
        )
        axes /= np.linalg.norm(axes, axis=1, keepdims=True)
        across = np.eye(3) - np.einsum("ki,kj->kij", axes, axes)
        sides = across.reshape(-1, 3), np.einsum("kij,kj->ki", across, points).ravel()
        centre = np.linalg.lstsq(*sides, rcond=1e-3)[0]
        feet = np.einsum("kij,kj->ki", across, points - centre)
        size = size or float(np.sqrt((feet**2).sum(axis=1).mean()))
        return cls(axes, feet / size, size)

    def changed(self, change: Array) -> Loop:
        """By a rotation vector of each axis and a shift of each foot, shape (..., n, 2, 3)."""
        axes = np.einsum("...ij,...j->...i", rotations(change[..., 0, :]), self.axes)
        return Loop(axes, self.feet + change[..., 1, :], self.size)

    def placed(self, angles: Array) -> list[tuple[Array, Array]]:
        """Turn and place of what each joint moves, and at last of the product."""
        turn, place = np.eye(3), np.zeros(3)
        found = [(turn, place)]
        own = rotations(angles[..., None] * self.axes)
        steps = self.feet - np.einsum("...ij,...j->...i", own, self.feet)
        for k in range(self.feet.shape[-2]):
            place = place + np.einsum("...ij,...j->...i", turn, steps[..., k, :])
            turn = turn @ own[..., k, :, :]
            found.append((turn, place))
        return found

    def opening(self, angles: Array) -> Array:
        """Rotation vector of the loop's product, and where it takes the centre, shape (..., 6)."""
        turn, place = self.placed(angles)[-1]
        twice = [turn[..., 2, 1], turn[..., 0, 2], turn[..., 1, 0]]
        twice = np.stack(twice, -1) - np.stack(
            [turn[..., 1, 2], turn[..., 2, 0], turn[..., 0, 1]], -1
        )
        sine = np.linalg.norm(twice, axis=-1, keepdims=True) / 2
        cosine = (np.trace(turn, axis1=-2, axis2=-1)[..., None] - 1) / 2
        share = np.where(sine > 1e-9, np.arctan2(sine, cosine) / np.maximum(sine, 1e-9), 1.0)
        return np.concatenate([twice / 2 * share, place], axis=-1)

    def slope(self, angles: Array) -> Array:
        """Of the opening, by the lines as the turns before them place them; where it is small."""
        columns = []
        for axis, foot, (turn, place) in zip(
            self.axes, self.feet, self.placed(angles), strict=False
        ):
            along = turn @ axis
            columns.append(np.concatenate([along, np.cross(place + turn @ foot, along)]))
        return np.array(columns).T

    def gap(self, angles: Array) -> Array:
        """The angle and the distance by which it is open."""
        return np.linalg.norm(self.opening(angles).reshape(2, 3), axis=1)


def rotations(vectors: Array) -> Array:
    """Of rotation vectors, shape (..., 3, 3)."""
    flat = Rotation.from_rotvec(vectors.reshape(-1, 3)).as_matrix()
    return flat.reshape(*vectors.shape, 3)


def follow(loop: Loop, way: int, arc: float = ARCS[0]) -> tuple[Array, bool]:
    """Positions of least gaps, each an arc on from the one before, and whether they come back."""
    q = np.zeros(len(loop.axes))
    tangent = np.linalg.svd(loop.slope(q))[2][-1] * way
    found, left = [q], False
    first = tangent
    while len(found) * arc < LONGEST:
        basis = null_space(tangent[None])
        base = q + arc * tangent
        rest = least_squares(
            lambda z, base=base, basis=basis: loop.opening(base + basis @ z),
            np.zeros(len(q) - 1),
            lambda z, base=base, basis=basis: loop.slope(base + basis @ z) @ basis,
            xtol=EXACT,
            ftol=EXACT,
            gtol=EXACT,
        )
        ahead = base + basis @ rest.x
        tangent = (ahead - q) / np.linalg.norm(ahead - q)
        q = ahead
        found.append(q)
        if loop.gap(q).max() > WIDE:
            break
        away = np.linalg.norm((q + np.pi) % (2 * np.pi) - np.pi)
        left |= away > 3 * arc
        if left and away < arc and tangent @ first > 0:
            return np.array(found), True
    return np.array(found), False


def widest(loop: Loop, positions: Array) -> Array:
    """The largest angle and the largest distance of all gaps."""
    return np.max([loop.gap(q) for q in positions], axis=0)


def least_change(loop: Loop, positions: Array) -> Array:
    """Of the lines, so that the loop closes near positions; shape (n, 2, 3).

    Gaps make conditions differ that are one and the same where the loop moves. How many there are
    is seen where a first change has closed it; the least change satisfies as many.
    """
    n = len(loop.axes)
    _, count = _close(loop, positions, None)
    return _close(loop, positions, count)[0].reshape(n, 2, 3)


def _close(loop: Loop, positions: Array, count: int | None) -> tuple[Array, int]:
    """A change that closes a loop, by Gauss and Newton's steps, and the number of conditions.

    Args:
        count: of the conditions that are satisfied; those above the widest gap of singular values
            if that is not known.
    """
    n = len(loop.axes)
    change, angles = np.zeros(6 * n), positions.copy()
    for _ in range(STEPS):
        now = loop.changed(change.reshape(n, 2, 3))
        rows, right = [], []
        for k, q in enumerate(angles):
            slope, opening = now.slope(q), now.opening(q)
            left, values, *_ = np.linalg.svd(slope)
            conditions = left[:, n - 1 :].T
            # Central differences: a change is small beside one.
            each = (1e-5 * np.eye(6 * n)).reshape(6 * n, n, 2, 3)
            here = change.reshape(n, 2, 3)
            ahead, behind = (loop.changed(here + x).opening(q) for x in (each, -each))
            by_change = (ahead - behind).T / 2e-5
            rows.append(conditions @ by_change)
            right.append(conditions @ (by_change @ change - opening))
            angles[k] = q - np.linalg.pinv(slope, rcond=values[n - 2] / values[0] / 2) @ opening
        u, s, v = np.linalg.svd(np.vstack(rows), full_matrices=False)
        floored = np.maximum(s, 1e-10 * s[0])
        widest_step = 1 + int(np.argmax(floored[:-1] / floored[1:]))
        open_now = max(np.abs(now.opening(q)).max() for q in angles)
        known = count or (widest_step if open_now < SMALL else int((s > ALIKE * open_now).sum()))
        before = change
        change = v[:known].T @ ((u[:, :known].T @ np.concatenate(right)) / s[:known])
        if np.abs(change - before).max() < 1e-13:
            break
    return change, widest_step


def change_between(first: Loop, second: Loop) -> Array:
    """The largest angle between axes, and the largest distance of feet."""
    sines = np.linalg.norm(np.cross(first.axes, second.axes), axis=1)
    angles = np.arctan2(sines, (first.axes * second.axes).sum(axis=1))
    return np.array([angles.max(), np.linalg.norm(first.feet - second.feet, axis=1).max()])


@dataclass(frozen=True)
class Independent:
    """Gap and change of a loop, angles and parts of its size, and what is open after it."""

    whole: bool
    gap: Array
    change: Array
    left_open: Array


def measure(mechanism: Mechanism) -> Independent:
    """What is found without the package."""
    loop = Loop.of(mechanism)
    positions, whole = _follow_both_ways(loop, ARCS[0])
    gap = widest(loop, positions)
    for arc in ARCS[1:]:
        finer = widest(loop, _follow_both_ways(loop, arc)[0])
        settled = _alike(gap, finer, ALIKE_GAPS / 10)
        gap = finer
        if settled:
            break
    chosen = positions[np.linspace(0, len(positions) - 1, POSITIONS + 1).round().astype(int)[:-1]]
    nearest = loop.changed(least_change(loop, chosen))
    closed, _ = follow(nearest, 1)
    return Independent(whole, gap, change_between(loop, nearest), widest(nearest, closed))


def _follow_both_ways(loop: Loop, arc: float) -> tuple[Array, bool]:
    positions, whole = follow(loop, 1, arc)
    if not whole:
        back, _ = follow(loop, -1, arc)
        positions = np.vstack([back[:0:-1], positions])
    return positions, whole


def _alike(ours: Array, theirs: Array, part: float) -> bool:
    """Whether an angle and a length are together of one size."""
    return bool(abs(np.linalg.norm(ours) / np.linalg.norm(theirs) - 1) < part)


def _is_claimed(mechanism: Mechanism, name: str) -> bool:
    """Whether what does not move nearly is said to."""
    near = nag.mobility(mechanism, detail="local", tolerance=1e-3).near
    claimed = near is not None and near.nearly_mobile
    if claimed:
        print(f"{name}: nearly mobile, gap {near.gap}, change {near.change}", flush=True)
    return claimed


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare, and print what differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--poses", type=int, default=1)
    parser.add_argument("--kind", default="", help="only those whose name begins so")
    parser.add_argument("--controls", type=int, default=4)
    options = parser.parse_args(arguments)
    wrong = 0
    for name, make in ((n, m) for n, m in KINDS.items() if n.startswith(options.kind)):
        for digits in (3, 6, 9):
            for pose in range(options.poses):
                mechanism = known.rounded_loop(known.posed(make(), pose), digits)
                start = time.process_time()
                ours = find_near_motion(mechanism, min(2 * 10.0 ** (1 - digits), WIDE))
                taken = time.process_time() - start
                theirs = measure(mechanism)
                scale = np.array([1, ours.size])
                gap = np.array(ours.gap) / scale
                change = np.array(ours.change or (np.inf, np.inf)) / scale
                closed = theirs.left_open.max() < CLOSED
                # Where two motions meet, rounding may lead from one into what is none.
                lost = theirs.gap.max() > WIDE
                same = lost or _alike(gap, theirs.gap, ALIKE_GAPS)
                same &= not closed or _alike(change, theirs.change, ALIKE_CHANGES)
                wrong += not (ours.nearly_mobile and same)
                print(
                    f"{name}, {digits} digits, pose {pose}: "
                    f"gap {gap[0]:.2e} {gap[1]:.2e} for {theirs.gap[0]:.2e} {theirs.gap[1]:.2e}"
                    f"{' (whose motion is lost)' if lost else ''}, "
                    f"change {change[0]:.2e} {change[1]:.2e} for "
                    f"{theirs.change[0]:.2e} {theirs.change[1]:.2e} "
                    f"{'' if closed else '(which does not close it) '}in {taken:.1f} s"
                    f"{'' if ours.nearly_mobile and same else ': DIFFERS'}",
                    flush=True,
                )
    for n in (4, 5, 6, 7):
        for seed in range(options.controls):
            rng = np.random.default_rng(seed)
            axes = known.unit(rng.standard_normal((n, 3)))
            mechanism = known.rounded_loop((axes, rng.standard_normal((n, 3))), 6)
            wrong += _is_claimed(mechanism, f"general {n}R, seed {seed}")
    for name, make in KINDS.items():
        for seed in range(options.controls):
            rng = np.random.default_rng(seed)
            axes, points = known.posed(make(), seed)
            across = np.cross(axes[0], rng.standard_normal(3))
            # Turned as well: a Sarrus linkage with an axis that stays parallel is another one.
            aside = 10 ** rng.uniform(-2, 0) * across / np.linalg.norm(across)
            points[0] += aside
            axes[0] += np.linalg.norm(axes[0]) * aside
            mechanism = known.rounded_loop((axes, points), 9)
            wrong += _is_claimed(mechanism, f"{name} with an axis out of place, seed {seed}")
    controls = options.controls * (4 + len(KINDS))
    print(f"{controls} controls that do not move nearly; {wrong} wrong in all", flush=True)
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
