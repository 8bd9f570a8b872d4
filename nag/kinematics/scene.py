"""Bodies, joints, and where they are at the points of a problem's equations.

A mechanism at a reference configuration has bodies and joints of its own. Of a planar linkage the
links are bodies, of a framework the bars; where more than two of them share a pin, each is joined
to the first. Of a table by Denavit and Hartenberg each body carries the frame of the joint before
it, after that joint's turn.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

import numpy as np

from nag.errors import NagError
from nag.kinematics.poses import (
    FreeRod,
    PoseMeasure,
    Poses,
    turn_back,
    turn_product,
    turn_vectors,
)
from nag.mechanism import PLATFORM_ALONE
from nag.mechanism.configuration import Configuration, as_entries
from nag.mechanism.dh import DHEulerModel, DHModel
from nag.mechanism.framework_model import FrameworkModel
from nag.mechanism.joint_types import JOINT_TYPES
from nag.mechanism.linkage import LinkageModel
from nag.mechanism.model import Model
from nag.mechanism.problem import Problem
from nag.mechanism.quaternion import translation
from nag.numerics.read_only import FixedArrays, equal_values
from nag.tracking.run import Run

IDENTITY = (1, 0, 0, 0)
UP = (0, 0, 1)
# Dimensions of a framework's space that planar models leave out.
PLANE = 2


@dataclass(frozen=True, eq=False)
class SceneJoint(FixedArrays):
    """A joint, as each of its two bodies carries it.

    Attributes:
        name: of the joint; of a pin of several bodies with the second one's behind it.
        type: a key of `nag.mechanism.joint_types.JOINT_TYPES`.
        bodies: indices of the two.
        points: of its axis or centre, in the bodies' frames, shape ``(2, 3)``.
        frames: quaternions that take vectors of the joint to the bodies' frames, shape ``(2, 4)``;
            where the joint has not moved both give the same vector.
        axis, second_axis: unit vectors of the joint as it was not moved, or None.
        in_loop: whether it is in a loop; else it moves freely, the equations say nothing of it, and
            it is shown as it was not moved.
    """

    name: str
    type: str
    bodies: tuple[int, int]
    points: np.ndarray
    frames: np.ndarray
    axis: np.ndarray | None
    second_axis: np.ndarray | None = None
    in_loop: bool = True

    __eq__ = equal_values

    def axis_in(self, end: int, second: bool = False) -> np.ndarray:
        """A direction of the joint in the frame of its first or second body."""
        vector = self.second_axis if second else self.axis
        assert vector is not None
        return turn_vectors(self.frames[end], vector)


@dataclass(frozen=True, eq=False)
class Scene(FixedArrays):
    """Bodies and joints, and the way to their poses.

    Attributes:
        bodies: names.
        ground: index of the one that is fixed.
        joints: all of them.
        planar: the unit normal of the plane of motion, or None.
        from_reference: whether angles and slides count from a configuration that is known.
        points: named points, each as a body's index and a place in its frame: of frameworks, and
            pins of a single link.
        variables: those of the equations.
        rods: bodies that turn about a line as they like, which the equations leave out.
        lift: poses at points, shape ``(k, n)``.
        lift_all: of equations of which a point stands for several configurations, all real ones
            above points: which of these each is above, their poses, and what is not known.
    """

    bodies: tuple[str, ...]
    ground: int
    joints: tuple[SceneJoint, ...]
    planar: np.ndarray | None
    from_reference: bool
    points: dict[str, tuple[int, np.ndarray]]
    variables: tuple[str, ...]
    lift: Callable[[np.ndarray], Poses] = field(compare=False)
    lift_all: Callable[[np.ndarray, Run], tuple[np.ndarray, Poses, list[str]]] | None = field(
        default=None, compare=False
    )
    rods: tuple[FreeRod, ...] = ()

    __eq__ = equal_values

    @property
    def centres(self) -> np.ndarray:
        """The middle of each body's joints and named points, in its frame: ``(bodies, 3)``.

        Of bodies that turn about a line the middle of its ends.
        """
        places = [self._places_on(body) for body in range(len(self.bodies))]
        for rod in self.rods:
            for body, ends in zip(rod.bodies, rod.ends, strict=True):
                places[body] = list(ends)
        return np.array([np.mean(own, axis=0) if own else np.zeros(3) for own in places])

    @cached_property
    def measure(self) -> PoseMeasure:
        """By what its configurations are compared."""
        return PoseMeasure(self.centres, self.size, self.rods)

    def _places_on(self, body: int) -> list[np.ndarray]:
        """Joints and named points of a body, in its frame.

        Those of slides are anywhere along or beside them, and count where there are no others.
        """
        joints = [joint for joint in self.joints if body in joint.bodies]
        placed = [joint for joint in joints if "point" in JOINT_TYPES[joint.type].fields]
        named = [point for own, point in self.points.values() if own == body]
        if not placed and not named:
            placed = joints
        return [j.points[j.bodies.index(body)] for j in placed] + named

    @property
    def hanging_joints(self) -> tuple[SceneJoint, ...]:
        """The joints in no loop, which move freely."""
        return tuple(joint for joint in self.joints if not joint.in_loop)

    @cached_property
    def farthest_body(self) -> int | None:
        """The body with the most joints of loops between the ground and itself, a robot's hand.

        None if several have as many.
        """
        reached, distances = {self.ground}, [[self.ground]]
        while distances[-1]:
            pairs = [joint.bodies for joint in self.joints if joint.in_loop]
            pairs += [(b, a) for a, b in pairs]
            following = sorted({b for a, b in pairs if a in distances[-1]} - reached)
            reached |= set(following)
            distances.append(following)
        last = distances[-2]
        return last[0] if len(last) == 1 and len(distances) > 2 else None

    @cached_property
    def size(self) -> float:
        """The largest distance of two joints of one body; 1 where all are in one place."""
        largest = 0.0
        for body in range(len(self.bodies)):
            own = self._places_on(body)
            for i, p in enumerate(own):
                largest = max([largest, *(float(np.linalg.norm(p - q)) for q in own[:i])])
        return largest or 1.0


def scene_of(problem: Problem) -> Scene:
    """The bodies and joints of a problem.

    Raises:
        NagError: if it is one of equations by themselves, or in coordinates that are not real
            where a configuration is.
    """
    made = problem.model
    if isinstance(made, Model):
        return _of_mechanism(made)
    if isinstance(made, LinkageModel):
        return _of_linkage(made)
    if isinstance(made, FrameworkModel):
        return _of_framework(made)
    if isinstance(made, DHModel | DHEulerModel):
        return _of_table(made)
    raise NagError("motion: equations by themselves have no bodies; give a mechanism")


def _vector(values: Sequence[Any]) -> np.ndarray:
    return np.array([float(x) for x in values])


def _unit(values: Sequence[Any]) -> np.ndarray:
    vector = _vector(values)
    return vector / np.linalg.norm(vector)


def _columns(points: np.ndarray) -> list[np.ndarray]:
    return [points[:, i] for i in range(points.shape[1])]


def _stack(entries: Sequence[Any], count: int) -> np.ndarray:
    return np.stack([np.broadcast_to(np.asarray(x, dtype=float), count) for x in entries], axis=-1)


def _of_mechanism(made: Model) -> Scene:
    mechanism = made.mechanism
    names = mechanism.body_names
    back = np.array([turn_back(_vector(mechanism.orientation(b))) for b in names])
    hanging = {joint.name for joint in made.structure.outside}
    joints = []
    for joint in mechanism.joints:
        bodies = tuple(names.index(b) for b in joint.bodies)
        frames = back[list(bodies)]
        joints.append(
            SceneJoint(
                joint.name,
                joint.type,
                bodies,
                turn_vectors(frames, _vector(joint.point)),
                frames,
                None if joint.axis is None else _unit(joint.axis),
                None if joint.second_axis is None else _unit(joint.second_axis),
                joint.name not in hanging,
            )
        )

    normal = None
    if made.space == "planar":
        from nag.mechanism.axes import planar_normal

        normal = _unit(planar_normal(mechanism.joints))
    return Scene(
        names,
        names.index(mechanism.ground),
        tuple(joints),
        normal,
        True,
        {},
        made.system.variables,
        partial(_lift_mechanism, made),
        partial(_lift_poses, made) if made.formulation == PLATFORM_ALONE else None,
        _free_rods(made, back),
    )


def _free_rods(made: Model, back: np.ndarray) -> tuple[FreeRod, ...]:
    """The rods of a model by distances, in the frames of bodies, to which ``back`` turns."""
    from nag.mechanism.rods import RodModel

    if not isinstance(made.form, RodModel):
        return ()
    names = made.mechanism.body_names
    found = []
    for rod in made.form.rods:
        bodies = tuple(names.index(b) for b in rod.frames)
        ends = [[_vector(end) for end in rod.ends_on(b)] for b in rod.frames]
        found.append(FreeRod(bodies, turn_vectors(back[list(bodies)][:, None], np.array(ends))))
    return tuple(found)


def _lift_mechanism(made: Model, points: np.ndarray) -> Poses:
    return _poses_of(made, made.form.lift(_columns(points)), len(points))


def _lift_poses(made: Model, points: np.ndarray, run: Run) -> tuple[np.ndarray, Poses, list[str]]:
    index, placed, notes = made.form.real_configurations(points, run)
    return index, _poses_of(made, placed, len(index)), notes


def _poses_of(made: Model, placed: Configuration, count: int) -> Poses:
    """The bodies of many configurations, given entry by entry."""
    names = made.mechanism.body_names
    return Poses.of(
        [_stack(placed.euler[b], count) for b in names],
        [_stack(placed.position[b], count) for b in names],
        count,
    )


def _pin_joints(
    bodies: Sequence[str],
    pins: Sequence[Sequence[str]],
    shapes: Sequence[np.ndarray],
    hanging: Collection[str] = (),
) -> tuple[SceneJoint, ...]:
    """Revolute joints of plates that share pins; the first plate of a pin carries it.

    Of several the first in a loop does, so that the others' angles against it are those of loops.

    Args:
        hanging: names of plates in no loop.
    """
    found = []
    for pin in dict.fromkeys(p for own in pins for p in own):
        at = [(b, own.index(pin)) for b, own in enumerate(pins) if pin in own]
        if len(at) > 2:
            at.sort(key=lambda own: bodies[own[0]] in hanging)
        (first, place), *others = at
        for body, other in others:
            name = pin if len(others) == 1 else f"{pin}:{bodies[body]}"
            points = np.array([shapes[first][place], shapes[body][other]])
            frames = np.array([IDENTITY, IDENTITY])
            in_loop = not {bodies[first], bodies[body]} & set(hanging)
            axis = np.array(UP)
            joint = SceneJoint(
                name, "revolute", (first, body), points, frames, axis, in_loop=in_loop
            )
            found.append(joint)
    return tuple(found)


def _planar_turns(c: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Quaternions of turns about the normal of the plane."""
    half = np.arctan2(s, c) / 2
    zero = np.zeros_like(half)
    return np.stack([np.cos(half), zero, zero, np.sin(half)], axis=-1)


def _in_plane(places: Sequence[Sequence[Any]]) -> np.ndarray:
    """Places of the plane as points of space."""
    return np.array([[float(x), float(y), 0.0] for x, y in places])


def _of_linkage(made: LinkageModel) -> Scene:
    links = made.linkage.links
    names = tuple(link.name for link in links)
    shapes = [_in_plane(link.shape) for link in links]
    shared = Counter(pin for link in links for pin in link.pins)
    own = {
        pin: (i, shapes[i][k])
        for i, link in enumerate(links)
        for k, pin in enumerate(link.pins)
        if shared[pin] == 1
    }
    return Scene(
        names,
        names.index(made.linkage.ground),
        _pin_joints(names, [link.pins for link in links], shapes, made.free),
        np.array(UP),
        False,
        own,
        made.system.variables,
        partial(_lift_linkage, made),
    )


def _lift_linkage(made: LinkageModel, points: np.ndarray) -> Poses:
    links = made.linkage.links
    names = tuple(link.name for link in links)
    shapes = [_in_plane(link.shape) for link in links]
    held, *moving = made.in_loops
    index = {name: i for i, name in enumerate(names)}
    count = len(points)
    turns = {held.name: np.broadcast_to(IDENTITY, (count, 4))}
    for i, link in enumerate(moving):
        turns[link.name] = _planar_turns(points[:, 2 * i], points[:, 2 * i + 1])
    places = {held.name: np.zeros((count, 3))}
    pins: dict[str, np.ndarray] = {}
    left = [link for link in links if link.name != held.name]
    placed = held
    while True:
        own = index[placed.name]
        for pin, local in zip(placed.pins, shapes[own], strict=True):
            at = places[placed.name] + turn_vectors(turns[placed.name], local)
            pins.setdefault(pin, at)
        following = next((link for link in left if pins.keys() & set(link.pins)), None)
        if following is None:
            break
        placed = following
        left.remove(placed)
        # Links that close nothing turn freely; they are shown unturned.
        turns.setdefault(placed.name, np.broadcast_to(IDENTITY, (count, 4)))
        pin = next(p for p in placed.pins if p in pins)
        local = shapes[index[placed.name]][placed.pins.index(pin)]
        places[placed.name] = pins[pin] - turn_vectors(turns[placed.name], local)
    return Poses.of([turns[n] for n in names], [places[n] for n in names], count)


def _of_framework(made: FrameworkModel) -> Scene:
    if made.system.isotropic:
        raise NagError(
            "motion: a framework in isotropic coordinates is real where no coordinate is; take "
            "nag.mechanism.problem.in_real_coordinates"
        )
    framework = made.framework
    bodies = tuple(f"{a}-{b}" for a, b in framework.bars)
    lengths = [np.sqrt(float(x)) for x in framework.squared_lengths]
    shapes = [np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]]) for length in lengths]
    joints = _pin_joints(bodies, framework.bars, shapes)
    planar = framework.dimension == PLANE
    if not planar:
        joints = tuple(
            SceneJoint(j.name, "spherical", j.bodies, j.points, j.frames, None) for j in joints
        )
    ends = {
        p: (bodies.index(f"{a}-{b}"), k) for a, b in framework.bars for k, p in enumerate((a, b))
    }

    held = set(made.pinned[:2])
    return Scene(
        bodies,
        next(i for i, bar in enumerate(framework.bars) if set(bar) == held),
        joints,
        np.array(UP) if planar else None,
        False,
        {p: (bar, shapes[bar][k]) for p, (bar, k) in ends.items()},
        made.system.variables,
        partial(_lift_framework, made),
    )


def _lift_framework(made: FrameworkModel, points: np.ndarray) -> Poses:
    planar = made.framework.dimension == PLANE
    at = made.places_at(_columns(points))
    places = {name: _stack((*own, 0.0)[:3], len(points)) for name, own in at.items()}
    turns, origins = [], []
    for a, b in made.framework.bars:
        along = places[b] - places[a]
        origins.append(places[a])
        turn = _planar_turns(along[:, 0], along[:, 1]) if planar else _turns_to(along)
        turns.append(turn)
    return Poses.of(turns, origins, len(points))


def _turns_to(vectors: np.ndarray) -> np.ndarray:
    """Quaternions that turn the first axis to vectors, the shortest way; half a turn about the
    third one where that is opposite."""
    unit = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    x, y, z = unit.T
    zero = np.zeros_like(x)
    half = np.stack([1 + x, zero, -z, y], axis=-1)
    half = np.where((x > -1)[:, None], half, np.array([0.0, 0.0, 0.0, 1.0]))
    return half / np.linalg.norm(half, axis=1, keepdims=True)


def _link_transforms(made: DHModel | DHEulerModel) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """The links' rotations, and how far they carry."""
    rotations, places = [], []
    for link in made.loop.links:
        moved, size = translation(link)
        rotations.append(_unit(link[0]))
        places.append(_vector([x / size for x in moved]))
    return rotations, places


def _of_table(made: DHModel | DHEulerModel) -> Scene:
    rows = [made.loop.rows[i] for i in made.loop.open]
    count = len(rows)
    rotations, places = _link_transforms(made)
    joints = []
    for i, row in enumerate(rows):
        before = (i - 1) % count
        points = np.array([places[before], np.zeros(3)])
        frames = np.array([rotations[before], IDENTITY])
        joints.append(SceneJoint(row.name, "revolute", (before, i), points, frames, np.array(UP)))

    names = tuple(f"link{i + 1}" for i in made.loop.open)
    return Scene(
        names,
        count - 1,
        tuple(joints),
        None,
        False,
        {},
        made.system.variables,
        partial(_lift_table, made, rotations, places),
    )


def _about_third(c: Any, s: Any, count: int) -> np.ndarray:
    """Quaternions of turns about the third axis, from cosine and sine of half of them."""
    turn = _stack((c, 0.0, 0.0, s), count)
    return turn / np.linalg.norm(turn, axis=1, keepdims=True)


def _lift_table(
    made: DHModel | DHEulerModel,
    rotations: Sequence[np.ndarray],
    places: Sequence[np.ndarray],
    points: np.ndarray,
) -> Poses:
    rows = [made.loop.rows[i] for i in made.loop.open]
    count, k = len(rows), len(points)
    if isinstance(made, DHModel):
        angles = made.turns(as_entries(_columns(points)), float)
        halves = [angles[row.name] for row in rows]
    else:
        values = made.elimination.images
        entries = as_entries(_columns(points))
        flat = [image(entries, float) for image in values]
        bodies = [_stack(flat[4 * i : 4 * i + 4], k) for i in range(count - 1)]
        bodies.append(np.broadcast_to(IDENTITY, (k, 4)))
        relative = [
            turn_product(turn_back(turn_product(bodies[i - 1], rotations[i - 1])), bodies[i])
            for i in range(count)
        ]
        halves = [(r[:, 0], r[:, 3]) for r in relative]
    turns, origins = [], []
    # The base is the last body, its frame the global one.
    turn, origin = np.broadcast_to(IDENTITY, (k, 4)), np.zeros((k, 3))
    for i, (c, s) in enumerate(halves):
        origin = origin + turn_vectors(turn, places[i - 1])
        turn = turn_product(turn_product(turn, rotations[i - 1]), _about_third(c, s, k))
        turns.append(turn)
        origins.append(origin)
    return Poses.of([*turns[:-1], np.array(IDENTITY)], [*origins[:-1], np.zeros(3)], k)
