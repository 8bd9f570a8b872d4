"""Joints that are held at values, bodies at places, and the assemblies with them.

On the circuits of a motion all of them are found along these: between two dead points next to each
other a joint takes a value at most once, so that none is missed between samples. Where the rest
moves, or nothing does, they are solutions of the equations with the joints held
(`nag.mechanism.holding`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.from_python import real_double
from nag.algebra.given import is_a
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.kinematics import CLOSE_A_LOOP, HOLD_FARTHER
from nag.kinematics.joint_values import Coordinate, joint_coordinates, joint_values
from nag.kinematics.path import Path
from nag.kinematics.poses import SAME, Poses, pose_distances, turn_product
from nag.kinematics.scene import Scene, scene_of
from nag.kinematics.turning_points import STILL, Values
from nag.mechanism.dh import DHEulerModel, DHModel, hold_rows
from nag.mechanism.given_rotation import GivenFrame, given_point, given_quaternion, shortened
from nag.mechanism.graph import Mechanism
from nag.mechanism.holding import HeldMechanism, held_model, hold_joint, place_body, tie_bodies
from nag.mechanism.linkage import Linkage, LinkageModel, hold_pin, linkage_model
from nag.mechanism.model import Model
from nag.mechanism.path_estimates import NoLoopError
from nag.mechanism.problem import Problem, in_real_coordinates, problem_of
from nag.mechanism.quaternion import conjugate, multiply
from nag.numerics.double_ranks import NEARLY_SINGULAR
from nag.numerics.read_only import FixedArrays, RealArray, equal_values
from nag.text.table import join_words
from nag.witness.witness import WitnessSet

# Places of bodies, and slides, at most: nothing is that far away.
LARGEST = 1e12
# Steps that narrow an interval in which a joint has a value, to nothing.
STEPS = 60


@dataclass(frozen=True)
class Drive:
    """A joint that is held at a value.

    Attributes:
        coordinate: name of its angle or slide.
        value: in radians, or a length.
    """

    coordinate: str
    value: float


@dataclass(frozen=True)
class Pose:
    """A body that is held by the ground.

    Attributes:
        body: its name.
        place: of its frame's origin, as in a motion's table, or of a joint's point.
        quaternion: of its frame, of any length but zero; None for that of the drawing.
        joint: of the body's joints the one whose point is at the place; empty for the frame.
    """

    body: str
    place: tuple[float, float, float]
    quaternion: tuple[float, float, float, float] | None = None
    joint: str = ""


@dataclass(frozen=True, eq=False)
class DrivenAssembly(FixedArrays):
    """An assembly at the value.

    Attributes:
        circuit: number of the circuit that it is on; None if it is on none.
        arc: how far along that.
        values: angles, between -pi and pi, and slides, shape ``(coordinates,)``.
        poses: of the bodies, at this one configuration.
        point: of one that is on no circuit, in the variables of the equations.
    """

    circuit: int | None
    arc: float | None
    values: RealArray
    poses: Poses
    point: RealArray | None = None

    __eq__ = equal_values

    def document(self) -> dict[str, Any]:
        """The assembly as a JSON object."""
        return {
            "circuit": self.circuit,
            "arc": self.arc,
            "values": self.values.tolist(),
            "positions": self.poses.places[:, 0].tolist(),
            "quaternions": self.poses.turns[:, 0].tolist(),
        }


def read_drives(given: Any) -> tuple[Drive, ...]:
    """Joints and values: a pair of them, or a dict of several, or a series of pandas'.

    Raises:
        NagError: if it is neither.
    """
    if given is None:
        return ()
    named = hasattr(given, "keys")
    pairs = list(given.items()) if named else [given]
    pair = isinstance(given, tuple | list) and len(given) == 2 and isinstance(given[0], str)
    if not (named or pair):
        raise NagError(
            "drive: give a joint and a value, ('A', 0.5), or a dict of several, {'A': 0.5, 'B': 1}"
        )
    return tuple(
        Drive(str(name), real_double(value, f"drive[{str(name)!r}]")) for name, value in pairs
    )


def read_poses(given: Any) -> tuple[Pose, ...]:
    """Bodies and their places: a dict of names to 3 or 7 numbers.

    Raises:
        NagError: if it is something else.
    """
    if given is None:
        return ()
    problem = "pose: give a dict of bodies, {'hand': (x, y, z)}, with a quaternion behind it or not"
    if not hasattr(given, "keys"):
        raise NagError(problem)
    found = []
    for body, numbers in given.items():
        if isinstance(numbers, str | bytes | Set) or not isinstance(numbers, Iterable):
            raise NagError(problem)
        place = f"pose[{str(body)!r}]"
        x = tuple(real_double(each, f"{place}[{i}]") for i, each in enumerate(numbers))
        if len(x) not in (3, 7):
            raise NagError(f"pose: {body!r} has {len(x)} numbers; give 3, or 7 with a quaternion")
        name, joint = split_place(str(body))
        found.append(Pose(name, x[:3], x[3:] or None, joint))  # type: ignore[arg-type]
    return tuple(found)


def split_place(text: str) -> tuple[str, str]:
    """A body, and the joint of it whose point is placed, as ``BODY@JOINT``; or the body alone."""
    body, at, joint = text.rpartition("@")
    return (body.strip(), joint.strip()) if at else (text, "")


def place_frames(problem: Problem, poses: Sequence[Pose]) -> tuple[Pose, ...]:
    """The same poses by the places of frames, of those that are given by a joint's point.

    Raises:
        NagError: if a body has no such joint, or that has no point of its own.
    """
    made = problem.model
    if not isinstance(made, Model):
        return tuple(poses)
    return tuple(_place_frame(made, each) if each.joint else each for each in poses)


def _place_frame(made: Model, pose: Pose) -> Pose:
    own = [
        j for j in made.mechanism.joints if pose.body in j.bodies and j.of_type.turns_about_point
    ]
    chosen = next((j for j in own if j.name == pose.joint), None)
    if chosen is None:
        there = f"those are {join_words([j.name for j in own])}" if own else "it has none"
        raise NagError(
            f"pose: {pose.joint[:40]!r} is no joint of {pose.body[:40]!r} with a point; {there}"
        )
    turned = _displacement(made, replace(pose, place=(0.0, 0.0, 0.0))).placed(chosen.point)
    place = tuple(x - float(y) for x, y in zip(pose.place, turned, strict=True))
    return Pose(pose.body, place, pose.quaternion)  # type: ignore[arg-type]


def tie_placed_bodies(given: Any, bodies: Iterable[str]) -> Any:
    """A mechanism, or a case of one, with bodies held that are to be placed; else what is given."""
    if isinstance(given, Mechanism):
        return tie_bodies(given, tuple(bodies))
    if is_a(given, "nag.files.cases", "Case") and given.mechanism is not None:
        return replace(given, mechanism=tie_bodies(given.mechanism, tuple(bodies)))
    return given


def problem_to_move(mechanism: Any, poses: Sequence[Pose], formulation: str) -> Problem:
    """The problem of a mechanism whose bodies that are to be placed are held.

    Raises:
        NagError: as `nag.mechanism.problem.problem_of` does; if there is no loop, with what to do.
    """
    given = tie_placed_bodies(mechanism, (each.body for each in poses))
    try:
        return in_real_coordinates(problem_of(given, formulation=formulation))
    except NoLoopError as error:
        advice = HOLD_FARTHER if poses else CLOSE_A_LOOP
        raise NoLoopError(f"{error}; {advice}").mended_by("pose") from None


def check_drive(scene: Scene, drive: Drive) -> int:
    """The column of the coordinate that is held.

    Raises:
        NagError: if there is none of that name, it is in no loop, or the value is no number.
    """
    coordinates = joint_coordinates(scene)
    names = [each.name for each in coordinates]
    if drive.coordinate not in names:
        there = f"they are {join_words(names)}" if names else "no joint has one"
        raise NagError(f"drive: {drive.coordinate[:40]!r} is no angle or slide; {there}")
    if not abs(drive.value) <= LARGEST:
        raise NagError(f"drive: the value has to be a number, {LARGEST:.0e} at most")
    column = names.index(drive.coordinate)
    each = coordinates[column]
    if not each.in_loop:
        verb = "turns" if each.kind == "angle" else "slides"
        raise NagError(
            f"drive: {each.joint} is in no loop: it {verb} freely, and nothing else moves with it"
        )
    return column


def hold(
    problem: Problem, drives: Sequence[Drive], poses: Sequence[Pose], formulation: str = "auto"
) -> tuple[Problem, Scene]:
    """What is left to be solved with joints at values and bodies at places, and what it shows.

    Args:
        problem: in real coordinates.
        drives: the joints.
        poses: the bodies.
        formulation: of a mechanism's model, as for `nag.mechanism.holding.held_model`.

    Raises:
        NagError: if a joint or a body is not there or cannot be held, or of what is given none can.
    """
    scene = scene_of(problem)
    coordinates = joint_coordinates(scene)
    chosen = [(coordinates[check_drive(scene, drive)], drive) for drive in drives]
    made = problem.model
    if isinstance(made, DHModel | DHEulerModel) and not poses:
        angles = {each.joint: _as_written(drive.value) for each, drive in chosen}
        held = problem_of(hold_rows(made.loop, angles))
        return held, scene_of(held)
    if isinstance(made, LinkageModel) and not poses:
        return _hold_pins(made.linkage, scene, chosen)
    if not isinstance(made, Model):
        if poses:
            raise NagError(
                "pose: bodies are placed in mechanisms with a reference configuration alone; "
                "give one, or hold joints"
            )
        raise NagError("drive: of frameworks no angle can be held; give a linkage or a mechanism")
    mechanism = HeldMechanism(made.mechanism, {})
    for each, drive in chosen:
        freedom = each.name[len(each.joint) + 1 :] or each.kind
        mechanism = hold_joint(mechanism, each.joint, freedom, _as_written(drive.value))
    for pose in poses:
        mechanism = place_body(mechanism, pose.body, _displacement(made, pose))
    held = problem_of(held_model(mechanism, formulation))
    # A tie that holds its body somewhere else is no joint that is seen.
    joints = tuple(
        j for j in scene.joints if j.type != "rigid" or j.name not in mechanism.displacements
    )
    return held, replace(scene_of(held), joints=joints)


def _as_written(x: float) -> Fraction:
    """The shortest decimal number that is this double: of 0.1 a tenth, as it is meant."""
    return Fraction(repr(float(x)))


@dataclass(frozen=True)
class _LinkInPlate:
    """A link as a part of a plate.

    Attributes:
        plate: name of the plate, one of its links.
        angle: by which the link's frame is turned in that of the plate.
        place: of its origin there, in the plane.
    """

    plate: str
    angle: float = 0.0
    place: complex = 0j

    def inside(self, outer: _LinkInPlate) -> _LinkInPlate:
        """The same link, where its plate is a part of another one."""
        moved = outer.place + np.exp(1j * outer.angle) * self.place
        return _LinkInPlate(outer.plate, self.angle + outer.angle, complex(moved))


def _hold_pins(
    linkage: Linkage, scene: Scene, chosen: Sequence[tuple[Coordinate, Drive]]
) -> tuple[Problem, Scene]:
    """A linkage with pins held, each between the links that it counts from."""
    parts = {link.name: _LinkInPlate(link.name) for link in linkage.links}
    for each, drive in chosen:
        joint = next(j for j in scene.joints if j.name == each.joint)
        first, second = (parts[scene.bodies[b]] for b in joint.bodies)
        if first.plate == second.plate:
            raise NagError(f"drive: {each.name} is between links that are held already")
        angle = drive.value + first.angle - second.angle
        if second.plate == linkage.ground:
            first, second, angle = second, first, -angle
        pin = each.joint.split(":")[0]
        at = [_pin_place(linkage, part.plate, pin) for part in (first, second)]
        linkage = hold_pin(linkage, pin, first.plate, second.plate, _as_written(angle))
        outer = _LinkInPlate(first.plate, angle, complex(at[0] - np.exp(1j * angle) * at[1]))
        for name, part in parts.items():
            if part.plate == second.plate:
                parts[name] = part.inside(outer)
    held = problem_of(linkage_model(linkage))
    plates = scene_of(held)

    def lift(points: np.ndarray) -> Poses:
        poses, count = plates.lift(points), len(points)
        turns, places = [], []
        for name in scene.bodies:
            part = parts[name]
            body = plates.bodies.index(part.plate)
            half = part.angle / 2
            own = np.array([np.cos(half), 0.0, 0.0, np.sin(half)])
            turns.append(turn_product(poses.turns[body], own))
            places.append(poses.move(body, np.array([part.place.real, part.place.imag, 0.0])))
        return Poses.of(turns, places, count)

    return held, replace(scene, variables=plates.variables, lift=lift)


def _pin_place(linkage: Linkage, link: str, pin: str) -> complex:
    """Where a pin is in a link's frame."""
    own = next(k for k in linkage.links if k.name == link)
    x, y = own.shape[own.pins.index(pin)]
    return complex(float(x), float(y))


def _displacement(made: Model, pose: Pose) -> GivenFrame:
    """Where a pose takes a body from where it is drawn."""
    numbers = (*pose.place, *(pose.quaternion or ()))
    if not all(abs(x) <= LARGEST for x in numbers):
        raise NagError(f"pose: the numbers of {pose.body!r} have to be {LARGEST:.0e} at most")
    origin = given_point([_as_written(x) for x in pose.place])
    if pose.quaternion is None:
        return GivenFrame(origin=origin)
    try:
        turned = given_quaternion([_as_written(x) for x in pose.quaternion]).quaternion
    except NagError as error:
        raise NagError(f"pose: the quaternion of {pose.body!r} {error}") from None
    drawn = made.mechanism.orientation(pose.body)
    return GivenFrame(shortened(multiply(turned, conjugate(drawn))), origin)


def is_same_assembly(scene: Scene, one: DrivenAssembly, other: DrivenAssembly) -> bool:
    """Whether two assemblies are the same configuration, as where circuits cross."""
    return bool(pose_distances(one.poses, other.poses, scene.measure)[0] < SAME)


def has_value(scene: Scene, assembly: DrivenAssembly, drive: Drive) -> bool:
    """Whether a joint has a value in an assembly."""
    column = check_drive(scene, drive)
    return _is_at(scene, column, assembly.values[column], drive.value)


def has_value_throughout(scene: Scene, values: Values, drive: Drive) -> bool:
    """Whether a joint stands still at a value all along a motion."""
    column = check_drive(scene, drive)
    value = values.values[0, column]
    return bool(values.still[column]) and _is_at(scene, column, value, drive.value, STILL)


def _is_at(scene: Scene, column: int, value: float, target: float, tolerance: float = SAME) -> bool:
    """Whether a coordinate's value is another one; angles that differ by whole turns are one."""
    away = float(value - target)
    if joint_coordinates(scene)[column].kind == "angle":
        return abs((away + np.pi) % (2 * np.pi) - np.pi) < tolerance
    return abs(away) < tolerance * scene.size


def find_doubts_of_held(
    problem: Problem, assemblies: Sequence[DrivenAssembly], components: Sequence[WitnessSet]
) -> list[str]:
    """Why assemblies may not be all that is meant: next to numbers that are rounded, others move.

    On curves they are isolated for the numbers as they are; of rounded ones they would not be.

    Args:
        problem: what is left with joints and bodies held.
        assemblies: the real ones that do not move.
        components: of dimension 0, all of them.
    """
    if not problem.system.n:
        return []
    points = [x for component in components for x in np.asarray(component.points)]
    known = [each.point for each in assemblies if each.point is not None]
    near = [
        str(i + 1)
        for i, x in enumerate(known)
        if _is_among(x, points) and _is_nearly_singular(problem, x)
    ]
    notes = []
    if near:
        noun = "assembly" if len(near) == 1 else "assemblies"
        notes.append(
            f"{noun} {join_words(near)}: all but singular: what is held in rounded numbers may "
            "stand for a place at which it moves, or where two meet"
        )
    aside = [x for x in points if 0 < np.abs(x.imag).max() < SAME * (1 + np.abs(x).max())]
    if any(_is_nearly_singular(problem, x) for x in aside if not _is_among(x.real, known)):
        notes.append(
            "two assemblies that are all but real and singular: what is held in rounded numbers "
            "may stand for a place where two meet"
        )
    return notes


def _is_among(x: np.ndarray, known: Sequence[np.ndarray]) -> bool:
    return any(np.abs(x - y).max() <= SAME * (1 + np.abs(y).max()) for y in known)


def _is_nearly_singular(problem: Problem, x: np.ndarray) -> bool:
    """Whether a Jacobian is, to the root of rounding, each row beside the size of its terms.

    Changes are those of unit vectors of each group's projective space, so that a half-angle or a
    quaternion near the infinity of its chart is no nearer to singular than elsewhere.
    """
    n, polynomials = problem.system.n, problem.system.polynomials
    changes = _unit_changes(problem.system, x)
    terms = [Polynomial(n, {e: abs(c) for e, c in f.terms.items()}) for f in polynomials]
    slopes = Evaluator.of(terms, n).jacobian(np.abs(x) + 0j) @ np.abs(changes)
    sizes = np.abs(slopes).max(axis=1)
    rows = Evaluator.of(polynomials, n).jacobian(x + 0j) @ changes
    rows = rows / np.where(sizes > 0, sizes, 1)[:, None]
    return bool(np.linalg.svd(rows, compute_uv=False)[n - 1] < NEARLY_SINGULAR)


def _unit_changes(system: PolynomialSystem, x: np.ndarray) -> np.ndarray:
    """Changes of the coordinates by unit steps in the spaces of the groups, as columns, ``(n, n)``.

    For x in a chart of projective space, a step v from (1, x), orthogonal to it and as long as
    (1, x), changes x by v_1 - v_0 x. Variables in no group change by 1.
    """
    found = np.eye(len(x), dtype=complex)
    for group in system.groups:
        own = list(group)
        whole = np.array([1.0, *x[own]], dtype=complex)
        across = np.linalg.svd(whole.conj()[None, :])[2][1:].conj().T * np.linalg.norm(whole)
        found[np.ix_(own, own)] = across[1:] - np.outer(x[own], across[0])
    return found


def assemblies_on(
    path: Path, values: Values, drive: Drive, circuit: int, end: float
) -> list[DrivenAssembly]:
    """The assemblies on one path, as far as ``end``, in their order.

    None where the joint stands still: what has the value is no single place there, but all of the
    path or nothing (`has_value_throughout`).
    """
    scene = path.curve.scene
    column = check_drive(scene, drive)
    each = values.coordinates[column]
    if values.still[column]:
        return []
    nodes = list(zip(path.arc.tolist(), values.values[:, column].tolist(), strict=True))
    nodes += [(p.arc, p.value) for p in values.turning if p.coordinate == each.name]
    nodes = sorted(n for n in nodes if n[0] <= min(end, path.length) + STILL * path.step)
    found = []
    for target in _targets(each, drive.value, nodes):
        gaps = [0.0 if abs(v - target) < STILL else v - target for _, v in nodes]
        for k, (arc, _) in enumerate(nodes):
            last = k == len(nodes) - 1
            if gaps[k] == 0.0 and not (last and path.closed):
                # A dead point that is a sample, too, counts once.
                if not (k and gaps[k - 1] == 0.0):
                    found.append(arc)
            elif not last and gaps[k] * gaps[k + 1] < 0:
                found.append(_narrow(path, column, each, target, arc, nodes[k + 1][0]))
    if not found:
        return []
    arcs = np.array(sorted(found))
    poses = path.curve.poses(path.measured.points_at(arcs))
    own = half_turns_forwards(scene, joint_values(scene, poses))
    return [
        DrivenAssembly(circuit, float(arc), own[k], poses.at(slice(k, k + 1)))
        for k, arc in enumerate(arcs)
    ]


def half_turns_forwards(scene: Scene, values: np.ndarray) -> np.ndarray:
    """The same values, with half turns backwards, but for rounding, as half turns forwards."""
    angles = [each.kind == "angle" for each in joint_coordinates(scene)]
    backwards = np.array(angles, dtype=bool) & (values < STILL - np.pi)
    return np.where(backwards, values + 2 * np.pi, values)


def _targets(each: Coordinate, value: float, nodes: list[tuple[float, float]]) -> list[float]:
    """The value, and those that differ by whole turns, as far as there are any."""
    if each.kind == "slide":
        return [value]
    low, high = (f(v for _, v in nodes) for f in (min, max))
    whole = 2 * np.pi
    first = int(np.ceil((low - STILL - value) / whole))
    last = int(np.floor((high + STILL - value) / whole))
    return [value + whole * k for k in range(first, last + 1)]


def _narrow(
    path: Path, column: int, each: Coordinate, target: float, low: float, high: float
) -> float:
    """How far along a coordinate has a value, between two other places."""
    scene = path.curve.scene

    def gap(arc: float) -> float:
        poses = path.curve.poses(path.measured.points_at(np.array([arc])))
        value = joint_values(scene, poses)[0, column]
        away = float(value - target)
        if each.kind == "angle":
            away = (away + np.pi) % (2 * np.pi) - np.pi
        return away

    ends = [(low, gap(low)), (high, gap(high))]
    for _ in range(STEPS):
        (a, f), (b, g) = ends
        if f * g >= 0 or b - a < STILL**2 * path.step:
            break
        # The chord's zero, but never nearer to an end than a tenth: bisection at the least.
        share = min(max(f / (f - g), 1 / 10), 9 / 10)
        middle = a + share * (b - a)
        value = gap(middle)
        ends[0 if f * value > 0 else 1] = (middle, value)
        if value == 0.0:
            return middle
    return min(ends, key=lambda e: abs(e[1]))[0]
