"""A mechanism in the coordinates of its joints, in doubles: loops, and rates of bodies, near by.

Each joint contributes its screws (Ball 1900; Hunt, *Kinematic Geometry of Mechanisms*, 1978). Rates
that close all loops to first order are a null space of the loops' Jacobian. Where it has the
dimension of the configuration space, that is smooth and the null space is tangent to it. Where all
configurations near by are singular, the Jacobian has the same rank at all of them, and that it has
is what the loops do not ask for by themselves: with this condition the configurations are regular
zeros (deflation: Leykin, Verschelde & Zhao 2006; Hauenstein & Wampler, *Isosingular sets and
deflation*, 2013). It is linear in the screws' rates of change, their brackets with the twists of
the bodies that carry them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from nag.errors import NagError
from nag.mechanism.axes import difference
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.inverse_kinematics import multiply_poses
from nag.mechanism.lines import has_place, middle_of, nearest_on_axis
from nag.mechanism.quaternion import quaternion_of
from nag.numerics.double_newton import count_above, find_zeros
from nag.numerics.double_ranks import NEARLY_SINGULAR, SINGULAR

# Steps that lead to a generic configuration, and their length; how often one is shortened.
STEPS, LENGTH, SHORTER = 3, 0.15, 4
# Steps of that length to a configuration with joints at values, at most.
MOST_STEPS = 100
# Decides: Sizes, beside the distance from the origin, that are errors of rounding.
ROUNDED = 1e-13
# Screws of a turn or slide, as 3 + 3 coordinates: turning, and velocity at the origin.
TURNING, SLIDING = slice(0, 3), slice(3, 6)


class NotClear(NagError):
    """What moves is not known, for the reason that the text says."""


def moves(values: np.ndarray) -> bool:
    """Whether values are not zero.

    Raises:
        NotClear: if that is not clear.
    """
    size = float(np.abs(values).max(initial=0.0))
    if SINGULAR < size < NEARLY_SINGULAR:
        raise NotClear("whether a part moves is not clear in doubles")
    return size >= NEARLY_SINGULAR


def corank(matrix: np.ndarray) -> int:
    """Columns less rank.

    Raises:
        NotClear: if the rank is not clear.
    """
    s = np.linalg.svd(matrix, compute_uv=False) if matrix.size else np.zeros(0)
    if ((s > SINGULAR) & (s < NEARLY_SINGULAR)).any():
        raise NotClear("the rank of the parts' motions is not clear in doubles")
    return matrix.shape[1] - int((s >= NEARLY_SINGULAR).sum())


@dataclass(frozen=True, eq=False)
class JointChains:
    """A mechanism as chains of turns and slides, where lengths are of size one.

    Attributes:
        mechanism: all its bodies and joints.
        tree: ``(parent, child, joint's index)`` for every body but the ground, parents first.
        closing: indices of the joints that close loops.
        screws: of each joint, at the given configuration, shape ``(k, 6)``.
        columns: of each joint's coordinates among all.
        centre: the point that all lengths are taken from, shape ``(3,)``.
        size: of the lengths.
    """

    mechanism: Mechanism
    tree: tuple[tuple[str, str, int], ...]
    closing: tuple[int, ...]
    screws: tuple[np.ndarray, ...]
    columns: tuple[slice, ...]
    centre: np.ndarray
    size: float

    @classmethod
    def of(
        cls,
        mechanism: Mechanism,
        places: Mapping[str, tuple[np.ndarray, np.ndarray]] | None,
    ) -> JointChains:
        unmoved = (np.eye(3), np.zeros(3))
        displaced = places or dict.fromkeys(mechanism.body_names, unmoved)
        # Lengths are differences from the middle, taken exactly: it may be far from the origin.
        middle = middle_of(mechanism.joints)
        there = _vector(middle)
        points = []
        for joint in mechanism.joints:
            rotation, vector = displaced[joint.bodies[0]]
            away = _vector(difference(nearest_on_axis(joint, middle), middle))
            points.append(rotation @ away + (rotation @ there - there + vector))
        placed = [p for p, j in zip(points, mechanism.joints, strict=True) if has_place(j)]
        centre = np.mean(placed, axis=0) if placed else np.zeros(3)
        size = max((float(np.linalg.norm(p - centre)) for p in placed), default=0.0)
        # Axes that meet in a point leave no lengths.
        if size <= ROUNDED * float(np.abs(there).max()):
            size = 1.0
        screws = tuple(
            _screws(j, displaced, (p - centre) / size)
            for j, p in zip(mechanism.joints, points, strict=True)
        )
        ends = np.cumsum([0, *map(len, screws)]).tolist()
        tree, reached, frontier = [], {mechanism.ground}, [mechanism.ground]
        for parent in frontier:
            for i, joint in enumerate(mechanism.joints):
                if parent in joint.bodies and joint.other(parent) not in reached:
                    child = joint.other(parent)
                    reached.add(child)
                    frontier.append(child)
                    tree.append((parent, child, i))
        used = {i for _, _, i in tree}
        closing = tuple(i for i in range(len(mechanism.joints)) if i not in used)
        columns = tuple(slice(a, b) for a, b in pairwise(ends))
        return cls(mechanism, tuple(tree), closing, screws, columns, there + centre, size)

    @property
    def n(self) -> int:
        """Number of joint coordinates."""
        return self.columns[-1].stop

    def displacements(self, q: np.ndarray) -> dict[str, np.ndarray]:
        """Where the bodies are for joint coordinates, as matrices of shape ``(4, 4)``."""
        found = {self.mechanism.ground: np.eye(4)}
        for parent, child, i in self.tree:
            own = self._joint(i, q)
            forward = self.mechanism.joints[i].bodies[0] == parent
            found[child] = found[parent] @ (own if forward else np.linalg.inv(own))
        return found

    def study(self, q: np.ndarray, body: str) -> np.ndarray:
        """How a body is displaced against the given configuration, Study coordinates.

        In coordinates whose origin is the middle.
        """
        place = self.displacements(q)[body]
        turn = np.array([*quaternion_of(place[:3, :3]), 0, 0, 0, 0])
        return multiply_poses(np.array([1.0, 0, 0, 0, 0, *(self.size * place[:3, 3] / 2)]), turn)

    def _joint(self, i: int, q: np.ndarray) -> np.ndarray:
        result = np.eye(4)
        for screw, x in zip(self.screws[i], q[self.columns[i]], strict=True):
            result = result @ _exponential(screw * x)
        return result

    def equations(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Gaps of all loops, their Jacobian, and the bodies' twists for each joint coordinate.

        Shapes ``(6 c,)``, ``(6 c, n)`` and ``(bodies, 6, n)``.
        """
        at = self.displacements(q)
        names = self.mechanism.body_names
        twists = {self.mechanism.ground: np.zeros((6, self.n))}
        own = [self._rates(i, q, at) for i in range(len(self.screws))]
        for parent, child, i in self.tree:
            sign = 1 if self.mechanism.joints[i].bodies[0] == parent else -1
            twists[child] = twists[parent] + sign * own[i]
        gaps, rows = [np.zeros(0)], [np.zeros((0, self.n))]
        for i in self.closing:
            first, second = self.mechanism.joints[i].bodies
            reached = at[first] @ self._joint(i, q)
            # From where the joint takes the second body to where it is.
            gaps.append(_logarithm(at[second] @ np.linalg.inv(reached)))
            rows.append(twists[second] - twists[first] - own[i])
        return np.concatenate(gaps), np.vstack(rows), np.array([twists[b] for b in names])

    def _rates(self, i: int, q: np.ndarray, at: Mapping[str, np.ndarray]) -> np.ndarray:
        """The twist of a joint's second body against the first for each joint coordinate."""
        result = np.zeros((6, self.n))
        place = at[self.mechanism.joints[i].bodies[0]]
        first = self.columns[i].start
        for k, screw in enumerate(self.screws[i]):
            result[:, first + k] = _carry(place, screw)
            place = place @ _exponential(screw * q[first + k])
        return result

    def second_order(self, q: np.ndarray, rates: np.ndarray) -> np.ndarray:
        """How the Jacobian's products with rates change with each joint coordinate.

        Right where the loops are closed, up to multiples of the Jacobian.

        Args:
            rates: shape ``(n, t)``, of the Jacobian's null space.

        Returns:
            Shape ``(t, 6 c, n)``.
        """
        at = self.displacements(q)
        zero = np.zeros((rates.shape[1], 6, self.n))
        twists = {self.mechanism.ground: np.zeros((6, self.n))}
        found = {self.mechanism.ground: zero}
        own = [self._rates(i, q, at) for i in range(len(self.screws))]
        for parent, child, i in self.tree:
            sign = 1 if self.mechanism.joints[i].bodies[0] == parent else -1
            twists[child] = twists[parent] + sign * own[i]
        changes = []
        for i, joint in enumerate(self.mechanism.joints):
            carrier, change = twists[joint.bodies[0]].copy(), zero.copy()
            for j in range(self.columns[i].start, self.columns[i].stop):
                change += rates[j][:, None, None] * _bracket(carrier, own[i][:, j])
                carrier[:, j] = own[i][:, j]
            changes.append(change)
        for parent, child, i in self.tree:
            sign = 1 if self.mechanism.joints[i].bodies[0] == parent else -1
            found[child] = found[parent] + sign * changes[i]
        ends = [self.mechanism.joints[i].bodies for i in self.closing]
        rows = [
            found[second] - found[first] - changes[i]
            for i, (first, second) in zip(self.closing, ends, strict=True)
        ]
        return np.concatenate(rows, axis=1) if rows else zero[:, :0]

    def _conditions(self, q: np.ndarray, singular: int) -> tuple[np.ndarray, np.ndarray]:
        """What configurations satisfy whose Jacobian has a corank, and its derivatives.

        The loops close; if ``singular`` is not 0 it is that corank, and the smallest singular
        values are zero: the block of the Jacobian that belongs to them.
        """
        gaps, rows, _ = self.equations(q)
        if not singular:
            return gaps, rows
        u, s, v = np.linalg.svd(rows)
        rank = self.n - singular
        left, right = u[:, rank:], v[rank:].T
        block = np.zeros((left.shape[1], singular))
        small = s[rank:]
        block[range(len(small)), range(len(small))] = small
        changes = left.T @ self.second_order(q, right)
        return (
            np.concatenate([gaps, block.T.ravel()]),
            np.vstack([rows, changes.reshape(-1, self.n)]),
        )

    def singular_corank(self, dimension: int) -> int:
        """The corank that the Jacobian has at all configurations near the given one.

        0 where that is the dimension of the configuration space, so that they are smooth.

        Raises:
            NotClear: if it is not the same at all of them, or that is not seen to second order.
        """
        q = np.zeros(self.n)
        found = self._corank(q, 0)
        if found == dimension:
            return 0
        if found < dimension:
            raise NotClear("the joints' rates are fewer than the freedoms in doubles")
        deflated = self._corank(q, found)
        if deflated < dimension:
            raise NotClear("the configuration is singular; give a point near by")
        if deflated > dimension:
            raise NotClear(
                "the configuration is singular, and terms of second order do not tell whether all "
                "near by are; give the point of one of these"
            )
        return found

    def _corank(self, q: np.ndarray, singular: int) -> int:
        rows = self._conditions(q, singular)[1]
        return corank(rows if len(rows) else np.zeros((1, self.n)))

    def generic(self, dimension: int, singular: int, rng: np.random.Generator) -> list[np.ndarray]:
        """Joint coordinates of configurations near the given one, generic on its component.

        Args:
            singular: the Jacobian's corank at all of them, 0 if that is the dimension.

        Raises:
            NotClear: if none is found.
        """
        q, found = np.zeros(self.n), []
        for _ in range(STEPS if dimension else 0):
            tangent = self.tangent(q, dimension, singular)[0]
            direction = tangent @ rng.standard_normal(dimension)
            direction /= np.abs(direction).max()
            for k in range(SHORTER):
                there = self._on_component(q + LENGTH / 2**k * direction, dimension, singular)
                if there is not None:
                    q = there
                    break
            else:
                raise NotClear("no configuration near by was found in doubles")
            found.append(q)
        return found or [q]

    def _on_component(self, q: np.ndarray, dimension: int, singular: int) -> np.ndarray | None:
        """The configuration that Newton's method leads to."""

        def conditions(x: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            gaps, rows = self._conditions(x[0], singular)
            return gaps[None], rows[None]

        rank = self.n - dimension
        ends = find_zeros(conditions, q[None], rank=rank)
        (gaps,), (rows,) = conditions(ends.x, np.zeros(1))
        s = np.linalg.svd(rows, compute_uv=False)
        regular = rank <= len(s) and (not rank or s[rank - 1] >= NEARLY_SINGULAR)
        # Conditions that depend on the others are not among those that led there.
        closed = np.abs(gaps).max(initial=0.0) < SINGULAR
        return ends.x[0] if ends.converged[0] and regular and closed else None

    def reach(self, held: Mapping[tuple[str, int], float]) -> tuple[np.ndarray, int] | None:
        """A configuration with joints at values, and the freedoms that the others have there.

        It is followed from the given one, the values changing evenly, by Newton's method.

        Args:
            held: angles in radians and slides from the given configuration, by the joint's name and
                the number of its turn or slide.

        Returns:
            None if it is not reached, or is no regular one.

        Raises:
            NotClear: if the rank of the others' rates is not clear.
        """
        names = [joint.name for joint in self.mechanism.joints]
        goal, free = np.zeros(self.n), np.ones(self.n, dtype=bool)
        for (name, number), value in held.items():
            i = names.index(name)
            k = self.columns[i].start + number
            slides = not self.screws[i][number][TURNING].any()
            goal[k], free[k] = value / self.size if slides else value, False
        steps = int(np.ceil(np.abs(goal).max(initial=0.0) / LENGTH))
        if steps > MOST_STEPS:
            return None
        q = np.zeros(self.n)
        for step in range(1, steps + 1):
            q = np.where(free, q, goal * step / steps)
            arrived = self._close_loops(q, free)
            if arrived is None:
                return None
            q = arrived
        rows = self.equations(q)[1][:, free]
        return q, corank(rows if len(rows) else np.zeros((1, rows.shape[1])))

    def _close_loops(self, q: np.ndarray, free: np.ndarray) -> np.ndarray | None:
        """The configuration next to joint coordinates, of which some are free to change."""

        def equations(x: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            gaps, rows, _ = self.equations(x[0])
            return gaps[None], np.where(free, rows, 0.0)[None]

        ends = find_zeros(equations, q[None], rank=count_above(NEARLY_SINGULAR))
        closed = np.abs(self.equations(ends.x[0])[0]).max(initial=0.0) < SINGULAR
        return ends.x[0] if ends.converged[0] and closed else None

    def tangent(
        self, q: np.ndarray, dimension: int, singular: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """A basis of the joints' rates at a configuration, and the bodies' twists for each of it.

        Shapes ``(n, d)`` and ``(bodies, 6, d)``.

        Raises:
            NotClear: if there are not so many.
        """
        rows = self._conditions(q, singular)[1]
        if corank(rows if len(rows) else np.zeros((1, self.n))) != dimension:
            raise NotClear("the joints' rates are not those of a smooth configuration in doubles")
        basis = np.linalg.svd(rows)[2][self.n - dimension :].T
        return basis, self.equations(q)[2] @ basis


def _vector(values: Sequence[Any]) -> np.ndarray:
    return np.array([float(x) for x in values])


def _screws(
    joint: Joint,
    displaced: Mapping[str, tuple[np.ndarray, np.ndarray]],
    point: np.ndarray,
) -> np.ndarray:
    """The screws of a joint's turns and slides about a point, in order, shape ``(k, 6)``."""
    rotations = [displaced[b][0] for b in joint.bodies]
    axes = [
        None if a is None else _unit(r @ _vector(a))
        for r, a in zip(rotations, (joint.axis, joint.second_axis), strict=True)
    ]
    found: list[np.ndarray] = []
    used = {"turn": 0, "slide": 0}
    for kind in joint.of_type.factors:
        if kind == "ball":
            found += [_turn(point, axis) for axis in np.eye(3)]
        elif kind == "plane":
            found += [_slide(axis) for axis in _across(axes[0])] + [_turn(point, axes[0])]
        else:
            axis = axes[used[kind]]
            used[kind] += 1
            found.append(_turn(point, axis) if kind == "turn" else _slide(axis))
    return np.array(found).reshape(len(found), 6)


def _unit(axis: np.ndarray) -> np.ndarray:
    # By a power of two, which rounds nothing, so that no square overflows.
    axis = np.ldexp(axis, -int(np.frexp(np.abs(axis).max())[1]))
    return axis / np.linalg.norm(axis)


def _across(axis: np.ndarray) -> np.ndarray:
    """Two unit vectors across a unit vector and each other."""
    return np.linalg.svd(axis[None])[2][1:]


def _turn(point: np.ndarray, axis: np.ndarray) -> np.ndarray:
    return np.concatenate([axis, np.cross(point, axis)])


def _slide(axis: np.ndarray) -> np.ndarray:
    return np.concatenate([np.zeros(3), axis])


def _hat(v: np.ndarray) -> np.ndarray:
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def _carry(place: np.ndarray, screw: np.ndarray) -> np.ndarray:
    """A screw that a displacement carries along."""
    turning = place[:3, :3] @ screw[TURNING]
    velocity = place[:3, :3] @ screw[SLIDING]
    return np.concatenate([turning, velocity + np.cross(place[:3, 3], turning)])


def _bracket(twists: np.ndarray, screw: np.ndarray) -> np.ndarray:
    """How fast a screw changes that twists, shape ``(6, n)``, carry along, shape ``(6, n)``."""
    turning, velocity = _hat(screw[TURNING]), _hat(screw[SLIDING])
    return -np.vstack(
        [
            turning @ twists[TURNING],
            velocity @ twists[TURNING] + turning @ twists[SLIDING],
        ]
    )


def _exponential(screw: np.ndarray) -> np.ndarray:
    """The displacement of a turn about a line, or a slide, of unit time."""
    result = np.eye(4)
    angle = float(np.linalg.norm(screw[TURNING]))
    if angle == 0.0:
        result[:3, 3] = screw[SLIDING]
        return result
    axis = _hat(screw[TURNING] / angle)
    result[:3, :3] += np.sin(angle) * axis + (1 - np.cos(angle)) * axis @ axis
    # A point of the line stays where it is.
    point = np.cross(screw[TURNING], screw[SLIDING]) / angle**2
    result[:3, 3] = point - result[:3, :3] @ point
    return result


def _logarithm(displacement: np.ndarray) -> np.ndarray:
    """A small displacement as a twist, to first order."""
    rotation = displacement[:3, :3]
    turning = np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    return np.concatenate([turning / 2, displacement[:3, 3]])
