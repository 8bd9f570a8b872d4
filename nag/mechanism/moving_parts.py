"""What moves near a configuration: parts that are idle, locked or rigid, and freedoms of a body.

All but a body's screws, which are those at a given configuration, is said of generic ones near it:
the mechanism is smooth there, so that it holds all along the component. Rates of the joints that
close all loops to first order are a null space; each joint contributes its screws (Ball 1900; Hunt,
*Kinematic Geometry of Mechanisms*, 1978). The configurations are real and found by Newton's method
in doubles, in joint coordinates, whatever the formulation of the equations; where a rank is not
clear, nothing is said.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

import networkx
import numpy as np

from nag.errors import NagError
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.inverse_kinematics import multiply_poses
from nag.mechanism.joint_types import COORDINATES
from nag.mechanism.motions import MotionType, ScrewSystem, motion_of, screw_system
from nag.mechanism.quaternion import quaternion_of
from nag.numerics.double_ranks import NEARLY_SINGULAR, SINGULAR
from nag.numerics.doubles import ARRIVED
from nag.text.table import count_text, join_words

# Steps that lead to a generic configuration, and their length; how often one is shortened; and
# Newton's steps.
STEPS, LENGTH, SHORTER, NEWTON = 3, 0.15, 4, 25
# Of more units, those between two others are not looked at.
MOST_UNITS = 60
# Screws of a turn or slide, as 3 + 3 coordinates: turning, and velocity at the origin.
TURNING, SLIDING = slice(0, 3), slice(3, 6)


class NotClear(NagError):
    """A rank that doubles do not decide."""


@dataclass(frozen=True)
class IdleFreedom:
    """Freedoms with which bodies move by themselves, and nothing else does.

    Attributes:
        bodies: one body, or several that are a chain between two others.
        count: of the freedoms.
        turns: whether it is one, a turn about a line or, if three, about a point.
        joint: the only one by which the body is joined to others, if it turns about it; else empty.
    """

    bodies: tuple[str, ...]
    count: int
    turns: bool
    joint: str = ""

    @property
    def alike(self) -> tuple[int, bool, int, str]:
        """What freedoms have in common that are told together."""
        return self.count, self.turns, len(self.bodies), self.joint

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return {"bodies": list(self.bodies), "freedoms": self.count}


@dataclass(frozen=True)
class BodyFreedoms:
    """How a body moves against the ground.

    Attributes:
        body: its name.
        motion: what its poses have in common, all along the component; of rank 0 where it stands
            still.
        screws: the twists that it can have at the configuration itself.
    """

    body: str
    motion: MotionType
    screws: ScrewSystem

    def __str__(self) -> str:
        rank = self.motion.rank
        if not rank:
            return f"{self.body}: no freedom, it stands still"
        text = f"{self.body}: {count_text(rank, 'freedom')}, {self.motion}"
        if self.screws.rank < rank:
            there = f"screws of {self.screws} alone" if self.screws.rank else "none of them"
            return f"{text}; at the configuration {there}"
        return text if self.motion.group else f"{text}; at the configuration {self.screws}"

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return {
            "body": self.body,
            "freedoms": self.motion.rank,
            "translations": self.motion.rank - self.motion.turning,
            "freedoms_there": self.screws.rank,
            "pitches": list(self.screws.pitches),
            "kind": str(self.motion) if self.motion.rank else "",
        }


@dataclass(frozen=True)
class MovingParts:
    """What moves, all along the component through a smooth configuration.

    Attributes:
        freedoms: of the mechanism.
        idle: freedoms with which parts between two others move by themselves.
        hanging: the same of bodies that are joined to one other body alone, as a pendulum and the
            last link of an arm are.
        locked: names of joints that never move; all those between bodies of one of ``together``;
            and of the turns and slides that never move of other joints.
        together: bodies that never move against each other, groups of two and more.
        body: the freedoms of the body that was asked for; None if none was.
    """

    freedoms: int
    idle: tuple[IdleFreedom, ...]
    hanging: tuple[IdleFreedom, ...]
    locked: tuple[str, ...]
    together: tuple[tuple[str, ...], ...]
    body: BodyFreedoms | None

    @property
    def idle_count(self) -> int:
        """How many freedoms are idle."""
        return sum(each.count for each in self.idle)

    @property
    def idle_text(self) -> str:
        """Which parts are idle; empty where none is."""
        return _describe_parts(self.idle)

    def rows(self) -> list[tuple[str, str]]:
        """Labelled lines of what there is to be said."""
        rows = []
        if self.idle:
            rows.append(("idle", f"{count_text(self.idle_count, 'freedom')}: {self.idle_text}"))
        if self.hanging:
            rows.append(("hanging", _describe_parts(self.hanging)))
        if self.locked and self.freedoms:
            rows.append(("locked", f"{', '.join(self.locked)}: never moving"))
        if self.freedoms:
            groups = [" with ".join(own) for own in self.together]
            rows += [("rigid", f"{'; '.join(groups)}: as one body")] if groups else []
        if self.body is not None:
            rows.append(("of", str(self.body)))
        return rows

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return {
            "idle": [e.document() for e in self.idle],
            "hanging": [e.document() for e in self.hanging],
            "locked": list(self.locked),
            "together": [list(own) for own in self.together],
            "of": None if self.body is None else self.body.document(),
        }


def _describe_parts(parts: Sequence[IdleFreedom]) -> str:
    """Which parts move by themselves, and how."""
    texts = []
    for count, turns, bodies, joint in sorted({e.alike for e in parts}):
        own = [e for e in parts if e.alike == (count, turns, bodies, joint)]
        names = join_words([" with ".join(e.bodies) for e in own])
        one = len(own) == 1
        about = "itself" if one else "themselves"
        if turns:
            what = f"turn{'s' * one} about "
            alone = joint or about
            what += alone if count == 1 else ("its point" if one else "their points")
        else:
            freedoms = count_text(count, "freedom")
            what = f"move{'s' * one} by {about}, {'' if one else 'each '}with {freedoms}"
        texts.append(f"{names} {what}")
    return "; ".join(texts)


def find_moving_parts(
    mechanism: Mechanism,
    dimension: int,
    rng: np.random.Generator,
    places: Mapping[str, tuple[np.ndarray, np.ndarray]] | None = None,
    body: str | None = None,
) -> MovingParts:
    """What moves near a smooth configuration.

    Args:
        dimension: of the configuration space there, joints outside all loops included.
        places: for each body how it is displaced against the reference configuration, a rotation
            matrix and a vector; by default it is not.
        body: one whose freedoms are asked for.

    Raises:
        NotClear: if a rank is not clear, or no configuration near by is found.
    """
    chain = _Chain.of(mechanism, places)
    along = [np.zeros(chain.n), *chain.generic(dimension, rng)]
    rates, twists = chain.tangent(along[-1], dimension)
    names = mechanism.body_names
    units = _group(names, twists)
    locked = [
        name
        for joint, own in zip(mechanism.joints, chain.columns, strict=True)
        for name in _locked_names(joint, rates[own])
    ]
    idle, hanging = _idle(mechanism, units, twists) if dimension else ([], [])
    freedoms = None if body is None else _body_freedoms(body, chain, along, dimension)
    together = tuple(own for own in units if len(own) > 1)
    return MovingParts(*(dimension, tuple(idle), tuple(hanging), tuple(locked), together, freedoms))


def _locked_names(joint: Joint, rates: np.ndarray) -> list[str]:
    """A joint if it never moves, or those of its turns and slides that do not, by their names."""
    if joint.of_type.is_rigid:
        return []
    if not _moves(rates):
        return [joint.name]
    factors = joint.of_type.factors
    if not set(factors) <= {"turn", "slide"}:
        return []
    parts = zip(COORDINATES[factors], rates, strict=True)
    return [f"{joint.name}.{part}" for (part, _), own in parts if not _moves(own)]


def _moves(values: np.ndarray) -> bool:
    """Whether values are not zero.

    Raises:
        NotClear: if that is not clear.
    """
    size = float(np.abs(values).max(initial=0.0))
    if SINGULAR < size < NEARLY_SINGULAR:
        raise NotClear("whether a part moves is not clear")
    return size >= NEARLY_SINGULAR


def _corank(matrix: np.ndarray) -> int:
    """Columns less rank.

    Raises:
        NotClear: if the rank is not clear.
    """
    s = np.linalg.svd(matrix, compute_uv=False) if matrix.size else np.zeros(0)
    if ((s > SINGULAR) & (s < NEARLY_SINGULAR)).any():
        raise NotClear("the rank of the parts' motions is not clear")
    return matrix.shape[1] - int((s >= NEARLY_SINGULAR).sum())


def _group(names: Sequence[str], twists: np.ndarray) -> list[tuple[str, ...]]:
    """Bodies that move as one, in their order."""
    groups: list[list[int]] = []
    for i in range(len(names)):
        for own in groups:
            if not _moves(twists[i] - twists[own[0]]):
                own.append(i)
                break
        else:
            groups.append([i])
    return [tuple(names[i] for i in own) for own in groups]


def _idle(
    mechanism: Mechanism, units: Sequence[tuple[str, ...]], twists: np.ndarray
) -> tuple[list[IdleFreedom], list[IdleFreedom]]:
    """Freedoms of one unit, or of several as one, that move nothing else, each once.

    Those of units that are joined to one other unit alone come apart: to move by itself is all that
    these can do.
    """
    names = mechanism.body_names
    unit_of = {body: k for k, own in enumerate(units) for body in own}
    first = [names.index(own[0]) for own in units]
    graph = networkx.Graph()
    graph.add_nodes_from(range(len(units)))
    graph.add_edges_from(tuple(unit_of[b] for b in joint.bodies) for joint in mechanism.joints)
    graph.remove_edges_from(list(networkx.selfloop_edges(graph)))
    taken = np.zeros((twists.shape[2], 0))
    found: list[IdleFreedom] = []
    hanging: list[IdleFreedom] = []
    for own in _parts_between(graph, unit_of[mechanism.ground]):
        others = [twists[first[k]] for k in range(len(units)) if k not in own]
        differences = [twists[first[k]] - twists[first[own[0]]] for k in own[1:]]
        matrix = np.vstack([*others, *differences])
        basis = np.linalg.svd(matrix)[2][matrix.shape[1] - _corank(matrix) :].T
        both = np.hstack([taken, basis])
        count = both.shape[1] - _corank(both) - (taken.shape[1] - _corank(taken))
        if not count:
            continue
        taken = both
        turns = count == basis.shape[1] and _are_turns(twists[first[own[0]]] @ basis)
        at = [j for j in mechanism.joints if len({unit_of[b] for b in j.bodies} - set(own)) == 1]
        at = [j for j in at if {unit_of[b] for b in j.bodies} & set(own)]
        joint = at[0].name if turns and count == 1 and len(at) == 1 else ""
        part = IdleFreedom(tuple(body for k in own for body in units[k]), count, turns, joint)
        beside = set().union(*(graph.neighbors(k) for k in own)) - set(own)
        (hanging if len(beside) == 1 else found).append(part)
    return found, hanging


def _parts_between(graph: networkx.Graph, ground: int) -> list[tuple[int, ...]]:
    """Single units but the ground, and what is connected between two units, the smallest first."""
    single = [(k,) for k in graph if k != ground]
    between: set[tuple[int, ...]] = set()
    for pair in combinations(graph, 2) if len(graph) <= MOST_UNITS else ():
        rest = graph.subgraph(set(graph) - set(pair))
        for part in networkx.connected_components(rest):
            joined = all(part & set(graph.neighbors(k)) for k in pair)
            if len(part) > 1 and ground not in part and joined:
                between.add(tuple(sorted(part)))
    return single + sorted(between, key=lambda part: (len(part), part))


def _are_turns(twists: np.ndarray) -> bool:
    """Whether twists, shape ``(6, k)``, are one turn about a line, or all three about a point."""
    turning, velocity = twists[TURNING], twists[SLIDING]
    symmetric = turning.T @ velocity
    if twists.shape[1] not in (1, 3) or _moves(symmetric + symmetric.T):
        return False
    return _corank(turning) == 0


def _body_freedoms(
    body: str, chain: _Chain, along: Sequence[np.ndarray], dimension: int
) -> BodyFreedoms:
    """The freedoms of a body.

    Args:
        along: joint coordinates of the configuration, and of generic ones near it.
    """
    place = chain.mechanism.body_names.index(body)
    own = [chain.tangent(q, dimension)[1][place] for q in along]
    # Far from the origin, velocities of its point would hide the turns.
    bases = [_basis(twists) for twists in own]
    poses = np.array([chain.study(q, body) for q in along])
    generic = bases[1:] or bases
    if not len(generic[0]):
        return BodyFreedoms(body, MotionType(0, 0, ""), ScrewSystem(0, 0, ()))
    motion = motion_of(poses[-len(generic) :], generic, chain.size, chain.centre)
    here = screw_system(bases[0], chain.size) if len(bases[0]) else ScrewSystem(0, 0, ())
    return BodyFreedoms(body, motion, here)


def _basis(twists: np.ndarray) -> np.ndarray:
    """An orthonormal basis of what twists, shape ``(6, d)``, span, shape ``(rank, 6)``."""
    rank = twists.shape[1] - _corank(twists) if twists.shape[1] else 0
    return np.linalg.svd(twists)[0][:, :rank].T if rank else np.zeros((0, 6))


@dataclass(frozen=True, eq=False)
class _Chain:
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
    ) -> _Chain:
        unmoved = (np.eye(3), np.zeros(3))
        displaced = places or dict.fromkeys(mechanism.body_names, unmoved)
        points = [
            displaced[j.bodies[0]][0] @ _vector(j.point) + displaced[j.bodies[0]][1]
            for j in mechanism.joints
            if j.point is not None
        ]
        centre = np.mean(points, axis=0) if points else np.zeros(3)
        size = max((float(np.linalg.norm(p - centre)) for p in points), default=1.0) or 1.0
        screws = tuple(_screws(j, displaced, centre, size) for j in mechanism.joints)
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
        return cls(mechanism, tuple(tree), closing, screws, columns, centre, size)

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

    def generic(self, dimension: int, rng: np.random.Generator) -> list[np.ndarray]:
        """Joint coordinates of configurations near the given one, generic on its component.

        Raises:
            NotClear: if none is found.
        """
        q, found = np.zeros(self.n), []
        for _ in range(STEPS if dimension else 0):
            tangent = self._tangent(q, dimension)[0]
            direction = tangent @ rng.standard_normal(dimension)
            direction /= np.abs(direction).max()
            for k in range(SHORTER):
                there = self._on_component(q + LENGTH / 2**k * direction, dimension)
                if there is not None:
                    q = there
                    break
            else:
                raise NotClear("no configuration near by was found")
            found.append(q)
        return found or [q]

    def _on_component(self, q: np.ndarray, dimension: int) -> np.ndarray | None:
        """The configuration that Newton's method leads to."""
        rank, step = self.n - dimension, np.inf
        for _ in range(NEWTON):
            gaps, rows, _ = self.equations(q)
            u, s, v = np.linalg.svd(rows, full_matrices=False)
            if rank > len(s) or (rank and s[rank - 1] < NEARLY_SINGULAR):
                return None
            delta = v[:rank].T @ ((u[:, :rank].T @ gaps) / s[:rank])
            q = q - delta
            last, step = step, float(np.abs(delta).max(initial=0.0))
            if step > 1:
                return None
            if step < ARRIVED or (step < SINGULAR and step >= last):
                return q
        return None

    def tangent(self, q: np.ndarray, dimension: int) -> tuple[np.ndarray, np.ndarray]:
        """A basis of the joints' rates at a configuration, and the bodies' twists for each of it.

        Shapes ``(n, d)`` and ``(bodies, 6, d)``.

        Raises:
            NotClear: if there are not so many.
        """
        basis, twists = self._tangent(q, dimension)
        return basis, twists @ basis

    def _tangent(self, q: np.ndarray, dimension: int) -> tuple[np.ndarray, np.ndarray]:
        _, rows, twists = self.equations(q)
        if _corank(rows if len(rows) else np.zeros((1, self.n))) != dimension:
            raise NotClear("the joints' rates are not those of a smooth configuration")
        return np.linalg.svd(rows)[2][self.n - dimension :].T, twists


def _vector(values: Sequence[Any]) -> np.ndarray:
    return np.array([float(x) for x in values])


def _screws(
    joint: Joint,
    displaced: Mapping[str, tuple[np.ndarray, np.ndarray]],
    centre: np.ndarray,
    size: float,
) -> np.ndarray:
    """The screws of a joint's turns and slides, in order, shape ``(k, 6)``."""
    rotations = [displaced[b][0] for b in joint.bodies]
    point = np.zeros(3)
    if joint.point is not None:
        rotation, vector = displaced[joint.bodies[0]]
        point = (rotation @ _vector(joint.point) + vector - centre) / size
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
