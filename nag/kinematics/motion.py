"""The real motions of a mechanism with one freedom: its circuits, and how far joints move."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from nag.algebra.given import Drives, Moving, Placements, check_choice, check_whole
from nag.decomposition.through import through_points
from nag.errors import NagError
from nag.kinematics.driven import (
    Drive,
    DrivenAssembly,
    Pose,
    assemblies_on,
    check_drive,
    find_doubts_of_held,
    has_value,
    has_value_throughout,
    hold,
    place_frames,
    problem_to_move,
    read_drives,
    read_poses,
)
from nag.kinematics.joint_values import joint_coordinates
from nag.kinematics.path import (
    NARROWINGS,
    PLACES,
    Curve,
    MeasuredWalk,
    Path,
    are_singular,
    find_least,
    interpolate_ahead,
    sample_path,
)
from nag.kinematics.poses import SAME, Poses, join_poses, pose_distances, steady_rods
from nag.kinematics.rigid_assemblies import (
    Configurations,
    RigidAssemblies,
    distinct_assemblies,
    find_components_through,
    find_rigid_assemblies,
)
from nag.kinematics.scene import Scene, scene_of
from nag.kinematics.turning_points import Values, values_along
from nag.kinematics.walks import CurveWalk, walks_of
from nag.mechanism import PLATFORM_ALONE
from nag.mechanism.given_rotation import known_multiple
from nag.mechanism.joint_types import JOINT_TYPES
from nag.mechanism.model import Model
from nag.mechanism.problem import Problem
from nag.mechanism.real_assemblies import no_assembly_text, obstacle, of_real_assemblies
from nag.mechanism.rods import RodModel
from nag.numerics.local_dimension import LocalDimension, local_dimension
from nag.numerics.read_only import RealArray, Several, equal_values
from nag.real.curve import RealCurve
from nag.text.table import count_text, data_frame, join_words, one_line
from nag.tracking.run import DEFAULT_RUN, ENDED_EARLY, Run, Stream, takes_run
from nag.witness.frame import count_expanded, expand_orbits
from nag.witness.witness import Decomposition, WitnessSet

if TYPE_CHECKING:
    import pandas

# Samples of each circuit; an even number of steps, so that halves of coverings are whole ones.
SAMPLES = 360
LEAST_SAMPLES, MOST_SAMPLES = 12, 100_000
# Decides: Steps of samples by which two circuits, or the halves of one in Euler parameters, may be
# apart and be one motion.
BESIDE = 0.1
# Steps along a curve to a point that may be on it.
APPROACHES = 6
# Points on either side of a place, between which a motion is interpolated.
AROUND = 5
# Singular configurations of which it is asked which components pass through them.
MOST_PLACES = 8
# In sizes: how far bodies are followed that go to infinity, beyond where they come nearest.
REACH = 5
# How much longer each step is by which a motion is followed beyond its points towards infinity, and
# how many these are at most.
LENGTHENING, MOST_STEPS_OUT = 1.25, 64

Which = Literal["reference", "all"]


class MotionError(NagError):
    """What has no motion of one freedom, with the reason."""


class PosesError(MotionError):
    """What moves in formulation P, which has the poses of a platform alone."""


class FreedomsError(MotionError):
    """What moves with two freedoms or more."""


class StillError(MotionError):
    """What does not move."""


@dataclass(frozen=True)
class Crossing:
    """A singular configuration on a circuit, where a motion may go on as another one.

    Attributes:
        sample: index of the sample next to it.
        arc: how far it is along the circuit.
        circuits: numbers of the other circuits through it, and of this one if it returns there.
        components: indices of other components through it; None where that is not decided.
    """

    sample: int
    arc: float
    circuits: tuple[int, ...]
    components: tuple[int, ...] | None


@dataclass(frozen=True, eq=False)
class Circuit(Several[RealArray]):
    """One motion, sampled at even distances.

    Attributes:
        number: from 1.
        component: index of the component that it runs on, in `Motion.components`.
        closed: whether it returns to where it began.
        unbounded: whether it goes to infinity at its ends; it is followed for five sizes at most.
        from_reference: whether it begins at the reference configuration.
        through_reference: whether that lies on it.
        arc: how far each sample is from the first, shape ``(k,)``: the root of the sum over bodies
            of squared angles, and squared ways over the size of the mechanism.
        points: in the variables of the equations, shape ``(k, n)``; very large where a
            joint's turn is that of half a turn from its chart's middle.
        poses: of all bodies.
        values: angles and slides of the joints.
        crossings: singular configurations on its way.
    """

    number: int
    component: int
    closed: bool
    unbounded: bool
    from_reference: bool
    through_reference: bool
    arc: RealArray
    points: RealArray
    poses: Poses
    values: Values
    crossings: tuple[Crossing, ...]

    __eq__ = equal_values

    def __repr__(self) -> str:
        kind = "closed" if self.closed else "open"
        return f"Circuit({self.number}, {kind}, length={self.length:.4g}, samples={len(self)})"

    @property
    def length(self) -> float:
        """The whole way."""
        return float(self.arc[-1])

    @property
    def entries(self) -> RealArray:
        """The samples, in the variables of the equations."""
        return self.points

    def to_numpy(self) -> RealArray:
        """The samples in the variables of the equations, shape ``(k, n)``, to be written to."""
        return self.points.copy()

    def table(self, *, angles: str = "degrees") -> dict[str, np.ndarray]:
        """Its samples as columns, each of shape ``(k,)``, as `pandas.DataFrame` takes them.

        ``circuit`` and ``arc``, and angles and slides by the names of the joints; the bodies'
        places are in the table of a `Motion`.

        Args:
            angles: ``"degrees"`` or ``"radians"``.
        """
        check_choice(angles, "angles", ("degrees", "radians"))
        columns = {"circuit": np.full(len(self), self.number), "arc": self.arc}
        for i, each in enumerate(self.values.coordinates):
            column = self.values.values[:, i]
            turned = each.kind == "angle" and angles == "degrees"
            columns[each.name] = np.degrees(column) if turned else column
        return columns

    def to_dataframe(self, *, angles: str = "degrees") -> pandas.DataFrame:
        """The same as a frame of pandas.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(self.table(angles=angles))

    def document(self, scene: Scene) -> dict[str, Any]:
        """The circuit as a JSON object.

        Args:
            scene: the bodies of the motion that it is of, `Motion.scene`.
        """
        values = self.values
        return {
            "number": self.number,
            "component": self.component,
            "closed": self.closed,
            "unbounded": self.unbounded,
            "from_reference": self.from_reference,
            "through_reference": self.through_reference,
            "length": self.length,
            "joints": [
                {
                    "name": each.name,
                    "smallest": float(values.ranges[i, 0]),
                    "largest": float(values.ranges[i, 1]),
                    "whole_turns": int(values.turns[i]),
                    "turns_fully": values.turns_fully(i),
                    "still": bool(values.still[i]),
                    "turning_points": [
                        {"arc": p.arc, "value": p.value, "kind": p.kind, "joints": list(p.others)}
                        for p in values.turning
                        if p.coordinate == each.name
                    ],
                    "values": values.values[:, i].tolist(),
                }
                for i, each in enumerate(values.coordinates)
            ],
            "crossings": [
                {
                    "arc": c.arc,
                    "circuits": list(c.circuits),
                    "components": None if c.components is None else list(c.components),
                }
                for c in self.crossings
            ],
            "arc": self.arc.tolist(),
            "bodies": [
                {
                    "name": name,
                    "positions": self.poses.places[i].tolist(),
                    "quaternions": self.poses.turns[i].tolist(),
                }
                for i, name in enumerate(scene.bodies)
            ],
        }


@dataclass(frozen=True, eq=False)
class Motion(Several[Circuit]):
    """Real motions of a mechanism.

    Attributes:
        scene: its bodies and joints.
        components: those that were looked at, of dimension one.
        curves: the real points of each.
        circuits: the motions on them.
        reason: what was made of the mechanism: its model, in one sentence.
        freedoms: dimension of the configuration space there, freedoms of parts that were left out
            of the equations included.
        counted: what Gruebler and Kutzbach count.
        idle: which parts turn idly, in words; empty where none does or it is not known.
        which: whether only motions through the reference configuration were asked for.
        drive: what was asked to be held; None if nothing was.
        assemblies: with that at its value, on all the circuits; if nothing was, real ones that do
            not move, so that they are on none.
        left_out: which components were not looked at as they have more freedoms; empty if none.
        notes: what is not known.
        not_looked_for: where real assemblies that do not move were not looked for, in words; empty
            if they were everywhere.
        held: joints that are held at values, if the circuits are those of what is left.
        poses: bodies that are held at places.
        idle_count: how many of the freedoms are those of parts that turn idly.
        throughout: numbers of the circuits on which what was asked to be held stands still at its
            value, so that it has it all along them; `assemblies` are those of the others.
    """

    scene: Scene
    components: tuple[WitnessSet, ...]
    curves: tuple[RealCurve, ...]
    circuits: tuple[Circuit, ...]
    reason: str
    freedoms: int
    counted: int
    idle: str
    which: Which
    left_out: str
    notes: tuple[str, ...]
    drive: Drive | None = None
    assemblies: tuple[DrivenAssembly, ...] = ()
    not_looked_for: str = ""
    held: tuple[Drive, ...] = ()
    poses: tuple[Pose, ...] = ()
    idle_count: int = 0
    throughout: tuple[int, ...] = ()

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[Circuit, ...]:
        """The circuits."""
        return self.circuits

    @property
    def complete(self) -> bool:
        """Whether nothing is left open."""
        return not self.notes

    def __str__(self) -> str:
        from nag.kinematics.shown import motion_text

        return motion_text(self)

    __repr__ = one_line

    @property
    def sentence(self) -> str:
        """The mobility in one sentence."""
        freedoms = count_text(self.freedoms, "freedom")
        idle, hanging = self.idle_count, self.hanging_count
        counting = f"counting predicts {self.counted}"
        if self.freedoms != max(self.counted, 0):
            counting = f"though {counting}"
        if not self.freedoms:
            return f"it does not move, {counting}"
        if self.freedoms == idle + hanging:
            parts = ["idly"] * bool(idle) + ["what is in no loop"] * bool(hanging)
            but = " and ".join(parts)
            return f"nothing moves but {but}, with {freedoms}, {counting}"
        if idle:
            freedoms += f", {idle} of them idle"
        if hanging:
            freedoms += f", {hanging} of them of joints in no loop"
        return f"it moves with {freedoms}, {counting}"

    @property
    def hanging_count(self) -> int:
        """How many of the freedoms are those of joints in no loop."""
        return sum(JOINT_TYPES[joint.type].freedoms for joint in self.scene.hanging_joints)

    def table(self, circuit: int = 1, *, angles: str = "degrees") -> dict[str, np.ndarray]:
        """One circuit as columns, each of shape ``(k,)``, as `pandas.DataFrame` takes them.

        ``circuit`` and ``arc``; angles and slides by the names of the joints; of each body
        ``name.x`` to ``name.z``, the place of its frame's origin, and ``name.q0`` to ``name.q3``,
        its unit quaternion.

        Args:
            circuit: its number, from 1.
            angles: ``"degrees"`` or ``"radians"``.
        """
        own = self.circuit(circuit)
        columns = own.table(angles=angles)
        for i, name in enumerate(self.scene.bodies):
            columns |= {f"{name}.{x}": own.poses.places[i, :, k] for k, x in enumerate("xyz")}
            columns |= {f"{name}.q{k}": own.poses.turns[i, :, k] for k in range(4)}
        return columns

    def whole_table(self, *, angles: str = "degrees") -> dict[str, np.ndarray]:
        """All circuits one below the other, or the assemblies where there is no circuit.

        With joints or bodies held the assemblies are behind the circuits of what is left. With a
        joint at a value, of one freedom, they are behind those circuits alone that have the value
        throughout; there may be no row at all.
        """
        shown = [
            c.number for c in self.circuits if self.drive is None or c.number in self.throughout
        ]
        tables = [self.table(number, angles=angles) for number in shown]
        if not tables or self.drive is not None or self.held or self.poses:
            tables.append(self.assembly_table(angles=angles))
        return join_tables(tables)

    def to_dataframe(self, *, angles: str = "degrees") -> pandas.DataFrame:
        """The same as a frame of pandas.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(self.whole_table(angles=angles))

    def assembly_table(self, *, angles: str = "degrees") -> dict[str, np.ndarray]:
        """The assemblies with joints or bodies held, a row each, with the columns of `table`.

        Circuit and arc are 0 and NaN of what is on no circuit.
        """
        check_choice(angles, "angles", ("degrees", "radians"))
        own = self.assemblies
        columns = {
            "circuit": np.array([a.circuit or 0 for a in own], dtype=int),
            "arc": np.array([np.nan if a.arc is None else a.arc for a in own], dtype=float),
        }
        for i, each in enumerate(joint_coordinates(self.scene)):
            column = np.array([a.values[i] for a in own])
            turned = each.kind == "angle" and angles == "degrees"
            columns[each.name] = np.degrees(column) if turned else column
        for i, name in enumerate(self.scene.bodies):
            for k, x in enumerate("xyz"):
                columns[f"{name}.{x}"] = np.array([a.poses.places[i, 0, k] for a in own])
            for k in range(4):
                columns[f"{name}.q{k}"] = np.array([a.poses.turns[i, 0, k] for a in own])
        return columns

    def circuit(self, number: int) -> Circuit:
        """The circuit of a number, from 1.

        Raises:
            NagError: if there is none.
        """
        own = next((c for c in self.circuits if c.number == number), None)
        if own is None:
            numbers = ", ".join(str(c.number) for c in self.circuits)
            there = f"they are {numbers}" if numbers else "there is none"
            raise NagError(f"circuit: {number} is none; {there}")
        return own

    def only_circuit(self, number: int) -> Motion:
        """The same with one circuit; of what is at a value that which is on it.

        Raises:
            NagError: if there is none of that number.
        """
        on_it = tuple(each for each in self.assemblies if each.circuit == number)
        assemblies = self.assemblies if self.drive is None else on_it
        throughout = tuple(each for each in self.throughout if each == number)
        own = (self.circuit(number),)
        return replace(self, circuits=own, assemblies=assemblies, throughout=throughout)

    def document(self) -> dict[str, Any]:
        """The motion as a JSON object without its head; angles are in radians."""
        scene = self.scene
        return {
            "model": self.reason,
            "mobility": {"freedoms": self.freedoms, "counted": self.counted},
            "idle": self.idle,
            "left_out": self.left_out,
            "not_looked_for": self.not_looked_for,
            "notes": list(self.notes),
            "bodies": list(scene.bodies),
            "ground": scene.bodies[scene.ground],
            "coordinates": [
                {"name": c.name, "joint": c.joint, "kind": c.kind, "in_loop": c.in_loop}
                for c in joint_coordinates(scene)
            ],
            "components": [
                {"dimension": c.dimension, "degree": c.degree, "multiplicity": c.multiplicity or 0}
                for c in self.components
            ],
            "drive": None if self.drive is None else asdict(self.drive),
            "held": [asdict(each) for each in self.held],
            "poses": [
                {"body": each.body, "place": each.place, "quaternion": each.quaternion}
                for each in self.poses
            ],
            "throughout": list(self.throughout),
            "assemblies": [each.document() for each in self.assemblies],
            "circuits": [c.document(scene) for c in self.circuits],
        }


def join_tables(tables: Sequence[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Tables of the same columns, one below the other."""
    return {name: np.concatenate([t[name] for t in tables]) for name in tables[0]}


@takes_run
def motion(
    mechanism: Moving,
    *,
    circuit: Which | int = "reference",
    samples: int = SAMPLES,
    formulation: str = "auto",
    drive: Drives | None = None,
    pose: Placements | None = None,
    run: Run = DEFAULT_RUN,
) -> Motion:
    """How a mechanism of one freedom really moves: all joints and bodies along each circuit.

    With joints held at values, or bodies at places, of what is left: its circuits, or all its real
    assemblies where nothing moves any more, as those of an arm whose hand is held.

    Args:
        mechanism: a mechanism, a case, a linkage, a framework or a table, or a problem of one.
        circuit: ``"reference"`` for the motions through the reference configuration, where there is
            one; ``"all"`` for those of all components of dimension one; the number of one of these
            for that one.
        samples: into how many even steps each circuit is divided.
        formulation: of a mechanism's model, as for `nag.model`.
        drive: the name of an angle or slide and a value, in radians or a length, or a dict of
            several; of one freedom, all assemblies on the circuits at which it has the value.
        pose: by the names of bodies that the ground is to hold, the place of a body's frame as a
            motion's table has it, which is how far it is moved from where it is drawn: ``(x, y,
            z)``, or with a quaternion behind it 7 numbers. By ``"BODY@JOINT"`` the place of that
            joint's point instead, in the drawing's coordinates.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        MotionError: if it does not move with one freedom, or has no real motion.
        NagError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> moves = nag.motion(nag.read_case("cases/bennett.toml"))
    >>> [(circuit.closed, round(circuit.length, 2)) for circuit in moves.circuits]
    [(True, 14.97)]
    """
    if not isinstance(circuit, str):
        check_whole(circuit, "circuit", 1)
        every = motion(
            mechanism,
            circuit="all",
            samples=samples,
            formulation=formulation,
            drive=drive,
            pose=pose,
            run=run,
        )
        return every.only_circuit(circuit)
    check_choice(circuit, "circuit", get_args(Which))
    drives, poses = read_drives(drive), read_poses(pose)
    problem = problem_to_move(mechanism, poses, formulation)
    reason = "" if problem.parts is None else obstacle(problem.parts)
    if reason:
        raise MotionError(f"it cannot be assembled (proved): {reason}")
    problem = of_real_assemblies(problem)
    poses = place_frames(problem, poses)
    if poses or len(drives) > 1 or (drives and has_several_freedoms(problem, run)):
        return held_motion(problem, drives, poses, samples=samples, run=run)
    held = drives[0] if drives else None
    if held is None and circuit == "reference":
        _check_freedoms(problem, run)
    try:
        return motion_of(problem, circuit=circuit, samples=samples, drive=held, run=run)
    except FreedomsError:
        if not drives:
            raise
        return held_motion(problem, drives, samples=samples, run=run)


def has_several_freedoms(problem: Problem, run: Run) -> bool:
    """Whether a mechanism has two freedoms or more at its reference configuration."""
    at = _dimension_at_reference(problem, run)
    return at is not None and at.lower > 1


def _dimension_at_reference(problem: Problem, run: Run) -> LocalDimension | None:
    """The local dimension at a mechanism's reference configuration; None where there is none."""
    if not isinstance(problem.model, Model) or not problem.reference:
        return None
    return local_dimension(problem.system, problem.reference, seed=run.seed)


def _check_freedoms(problem: Problem, run: Run) -> None:
    """Refuse a mechanism with several freedoms before its components are looked for.

    At a regular point there is one component alone, so that its dimension decides.

    Raises:
        FreedomsError: if the reference configuration is on a component of several freedoms alone.
    """
    at = _dimension_at_reference(problem, run)
    if at is not None and 1 < at.lower == at.upper == at.tangent_dimension:
        raise _several_freedoms(problem, at.lower, "at the reference configuration")


def held_motion(
    problem: Problem,
    drives: Sequence[Drive],
    poses: Sequence[Pose] = (),
    *,
    samples: int = SAMPLES,
    run: Run = DEFAULT_RUN,
) -> Motion:
    """The circuits of a mechanism with joints held at values and bodies at places.

    Also all its real assemblies that do not move.

    Args:
        problem: in real coordinates.
        drives: the joints.
        poses: the bodies.
        samples: as for `motion`.
        run: how it is worked out.

    Raises:
        MotionError: if what is left moves with two freedoms or more, or has no real assembly.
        NagError: as `nag.kinematics.driven.hold` does.
    """

    def with_held(found: Motion) -> Motion:
        return replace(found, held=tuple(drives), poses=tuple(poses))

    told = run.convert_found(with_held)
    asked = problem.formulation == PLATFORM_ALONE
    left, scene = hold(problem, drives, poses, PLATFORM_ALONE if asked else "auto")
    exact = _are_exact(problem, drives, poses)
    if not poses:
        _check_held_freedoms(problem, left, drives)
    try:
        found, _ = _motion_on(left, scene, "all", samples, told, holding=True, exact=exact)
    except PosesError:
        if asked:
            raise
        left, scene = hold(problem, drives, poses, "H")
        found, _ = _motion_on(left, scene, "all", samples, told, holding=True, exact=exact)
    notes = list(found.notes)
    # Counting has the freedoms of parts that turn idly, and of what hangs in no loop, besides.
    counted = found.counted - found.idle_count - found.hanging_count
    if not (found.circuits or found.assemblies or exact) and counted < 0:
        notes.append(
            "what is held asks for more than there are freedoms: hold fewer joints, or give the "
            "values of one assembly exactly; rounded ones, as of a table of angles, fit none"
        )
    return replace(with_held(found), notes=tuple(notes))


def _are_exact(problem: Problem, drives: Sequence[Drive], poses: Sequence[Pose]) -> bool:
    """Whether what is held is meant as it is written, and does not stand for other numbers.

    Whole numbers, and angles that are multiples of 15 degrees, are no rounded ones.
    """
    kinds = {each.name: each.kind for each in joint_coordinates(scene_of(problem))}
    angles = [each.value for each in drives if kinds.get(each.coordinate) == "angle"]
    numbers = [each.value for each in drives if kinds.get(each.coordinate) != "angle"]
    numbers += [x for each in poses for x in (*each.place, *(each.quaternion or ()))]
    return all(x.is_integer() for x in numbers) and all(
        known_multiple(Fraction(repr(x))) is not None for x in angles
    )


def _check_held_freedoms(problem: Problem, left: Problem, drives: Sequence[Drive]) -> None:
    """Refuse what keeps several freedoms in all of its configurations before these are looked for.

    Loops cost as many freedoms as displacements have, at the most (Gruebler and Kutzbach): what
    counting leaves, all configurations have at least. That there is one is seen where the values
    are reached from the drawing, if it is regular.

    Args:
        problem: the mechanism.
        left: with the joints held.
        drives: these.

    Raises:
        FreedomsError: if all its configurations, and there are some, move with two or more.
    """
    made = problem.model
    if not isinstance(made, Model) or left.model is None:
        return
    counted = left.model.gruebler_kutzbach
    if counted - left.free < 2:
        return
    from nag.mechanism.joint_chains import JointChains, NotClear

    coordinates = joint_coordinates(scene_of(problem))
    held = {}
    for drive in drives:
        each = next(c for c in coordinates if c.name == drive.coordinate)
        own = [c.name for c in coordinates if c.joint == each.joint]
        held[each.joint, own.index(each.name)] = drive.value
    try:
        reached = JointChains.of(made.mechanism, None).reach(held)
    except NotClear:
        return
    if reached is not None and reached[1] == counted:
        names = join_words([drive.coordinate for drive in drives])
        raise _several_freedoms(left, counted - left.free, f"with {names} held")


def motion_of(
    problem: Problem,
    *,
    circuit: Which = "reference",
    samples: int = SAMPLES,
    drive: Drive | None = None,
    run: Run = DEFAULT_RUN,
    curve_of: Callable[[WitnessSet], RealCurve] | None = None,
) -> Motion:
    """The same of a problem in real coordinates.

    Args:
        curve_of: finds the real points of a component; by default `nag.real` does.
    """
    scene = scene_of(problem)
    drives = [] if drive is None else [drive]
    for each in drives:
        check_drive(scene, each)
    which: Which = circuit if scene.from_reference else "all"
    told = run.convert_found(lambda found: replace(found, drive=drive))
    found, made = _motion_on(problem, scene, which, samples, told, curve_of=curve_of)
    if drive is None:
        return found
    return _at_value(problem, found, made, drive, run)


def drive_circuits(
    problem: Problem, drives: Sequence[Drive], *, samples: int = SAMPLES, run: Run = DEFAULT_RUN
) -> Iterator[Motion]:
    """All circuits of a mechanism of one freedom, with the assemblies at each of some values.

    The circuits are found now, the assemblies when they are asked for.
    """
    scene = scene_of(problem)
    for each in drives:
        check_drive(scene, each)
    found, made = _motion_on(problem, scene, "all", samples, run)
    return (_at_value(problem, found, made, each, run) for each in drives)


def _at_value(
    problem: Problem, motion: Motion, made: Sequence[_FoundCircuit], drive: Drive, run: Run
) -> Motion:
    """A motion with the assemblies on its circuits at a value of a joint, each once.

    Circuits to infinity are not followed all the way: with the joint held, the others are found.

    Raises:
        NagError: if the joint moves on none of the circuits.
    """
    column = check_drive(motion.scene, drive)
    if made and all(each.values.still[column] for each in made):
        raise NagError(f"drive: {drive.coordinate} never moves{_on_circuits(motion)}")
    candidates = [
        assembly
        for each in made
        for assembly in assemblies_on(each.path, each.values, drive, each.circuit.number, each.end)
    ]
    candidates += [each for each in motion.assemblies if has_value(motion.scene, each, drive)]
    notes = list(motion.notes)
    unbounded = any(each.circuit.unbounded for each in made)
    if unbounded and motion.which == "reference":
        notes.append(
            "assemblies beyond where circuits to infinity are followed are looked for on all "
            "circuits only"
        )
    elif unbounded:
        alone = run.without_found
        try:
            rest = held_motion(problem, [drive], samples=LEAST_SAMPLES, run=alone)
            candidates += rest.assemblies
            notes += rest.notes
        except NagError as error:
            notes.append(f"assemblies beyond where circuits to infinity are followed: {error}")
    assemblies = tuple(distinct_assemblies(motion.scene, candidates))
    throughout = tuple(
        each.circuit.number
        for each in made
        if has_value_throughout(motion.scene, each.values, drive)
    )
    return replace(
        motion, drive=drive, assemblies=assemblies, notes=tuple(notes), throughout=throughout
    )


def _on_circuits(motion: Motion) -> str:
    """Of which circuits a refusal speaks, where it is not of all."""
    return "" if motion.which == "all" else " on the circuits through the reference configuration"


def _motion_on(
    problem: Problem,
    scene: Scene,
    which: Which,
    samples: int,
    run: Run,
    *,
    holding: bool = False,
    exact: bool = False,
    curve_of: Callable[[WitnessSet], RealCurve] | None = None,
) -> tuple[Motion, list[_FoundCircuit]]:
    """The circuits in a scene, and what they were made of.

    Args:
        holding: whether assemblies that do not move are wanted though nothing else does, as joints
            or bodies are held.
        exact: whether no rounded number holds them.
    """
    if not isinstance(samples, int) or not LEAST_SAMPLES <= samples <= MOST_SAMPLES:
        raise NagError(f"samples: give a whole number from {LEAST_SAMPLES} to {MOST_SAMPLES}")
    alone = problem.formulation == PLATFORM_ALONE
    if not problem.system.n and not holding:
        raise MotionError("no equation has an unknown: nothing moves but what is in no loop")
    inner = run.without_found
    decomposition = problem.decompose(run=inner)
    notes = [] if decomposition.complete else [f"components: {'; '.join(decomposition.notes)}"]
    if alone and any(c.dimension for c in decomposition.components):
        raise PosesError(
            "formulation P: the platform moves, and of the joints above moving poses it says "
            "nothing; take another formulation"
        )
    configurations = _distinct_configurations(problem, decomposition)
    own, left_out = _choose_components(
        problem, decomposition, configurations, which, inner, notes, holding
    )
    found = [configurations.everything.components[i] for i in own]
    several = len(found) > 1
    curve_of = curve_of or (lambda component: _real_curve(component, several, inner, holding))
    made, (idle, idle_count) = problem.model, _find_idle(problem, inner)
    curves: list[RealCurve] = []
    walks: list[_FoundCircuit] = []
    freedoms = 0 if holding else 1

    def motion_so_far(
        circuits: Sequence[Circuit], notes: Sequence[str], rigid: RigidAssemblies | None = None
    ) -> Motion:
        return Motion(
            scene,
            tuple(found[: len(curves)]),
            tuple(curves),
            tuple(circuits),
            made.reason,
            freedoms + problem.free,
            made.gruebler_kutzbach,
            idle,
            which,
            left_out,
            tuple(notes),
            assemblies=() if rigid is None else rigid.assemblies,
            not_looked_for="" if rigid is None else rigid.not_looked_for,
            idle_count=idle_count,
        )

    for i, component in enumerate(found):
        run.tell("real curves", i, len(found))
        real = curve_of(component)
        curves.append(real)
        walks += _circuits_on(problem, scene, i, real, which, samples)
        if walks or not real.complete:
            freedoms = 1
        if not real.complete:
            reason = real.reason or "its real points are undecided"
            notes.append(f"component {i + 1}: {reason}")
        if run.found is not None:
            early = [each.circuit for each in _each_once(scene, walks)]
            run.found(motion_so_far(early, [*notes, ENDED_EARLY]))
    circuits = _each_once(scene, walks)
    known = dict(zip(own, curves, strict=True))
    rigid = find_rigid_assemblies(scene, configurations, known, inner)
    notes += rigid.doubts
    if holding and not exact:
        notes += find_doubts_of_held(problem, rigid.assemblies, configurations.finite)
    if not circuits and not notes and not holding:
        raise MotionError(_no_motion(len(rigid.assemblies), rigid.not_looked_for))
    finished = _with_crossings(circuits, configurations, own, inner)
    return motion_so_far(finished, notes, rigid), circuits


def _real_curve(component: WitnessSet, several: bool, run: Run, holding: bool = False) -> RealCurve:
    """The real points of a component, of several an undecided curve where they are not found.

    Raises:
        RealCurveError: if they are not found and there is no other component.
    """
    from nag.real.find_curve import (
        NotReducedError,
        RealCurveError,
        find_real_curve,
        undecided_curve,
    )

    try:
        return find_real_curve(component, run=run)
    except RealCurveError as error:
        reason = str(error)
        if isinstance(error, NotReducedError):
            advice = "nag mobility says how the mechanism moves at one of them"
            reason = (
                "the component is not reduced: all its configurations are singular (multiplicity "
                f"{component.multiplicity or 'not known'}), and such a motion is not followed; "
                f"{'hold other values' if holding else advice}"
            )
        if not several:
            raise RealCurveError(reason) from None
        return undecided_curve(component._known_system(), reason)


def _distinct_configurations(problem: Problem, decomposition: Decomposition) -> Configurations:
    """All components, those together that are the same configurations."""
    # Of sign changes of Euler parameters the images are.
    same = isinstance(problem.model, Model) and problem.model.sign_group > 1
    classes: list[int] = []
    for component in decomposition.components:
        first, count = len(classes), count_expanded(component)
        classes += [first] * count if same else range(first, first + count)
    return Configurations(expand_orbits(decomposition), tuple(classes))


def _choose_components(
    problem: Problem,
    decomposition: Decomposition,
    configurations: Configurations,
    which: Which,
    run: Run,
    notes: list[str],
    holding: bool,
) -> tuple[list[int], str]:
    """Indices of the components to look at, and what is left out of them.

    Args:
        holding: whether there need not be any, as assemblies are wanted that do not move.
    """
    components = configurations.everything.components
    if which == "reference":
        name = ("the reference configuration", tuple(problem.reference or ()))
        (through,) = through_points(decomposition, [name], run.threads)
        if through.doubt:
            notes.append(through.doubt)
        own = list(through.components)
        where = "at the reference configuration"
    else:
        own = list(dict.fromkeys(configurations.classes))
        where = ""
    curves = [i for i in own if components[i].dimension == 1]
    largest = max((components[i].dimension for i in own), default=0)
    if not curves and not notes and not (holding and largest <= 1):
        if largest > 1:
            raise _several_freedoms(problem, largest, where)
        if problem.parts is not None and not components:
            raise StillError(no_assembly_text(problem))
        advice = "see nag mobility, with tolerance 1e-3 if its numbers are rounded"
        raise StillError(f"it does not move {where}".rstrip() + f"; {advice}")
    larger = sum(components[i].dimension > 1 for i in own)
    left_out = f"{count_text(larger, 'component')} of dimension 2 or more" if larger else ""
    return curves, left_out


def _several_freedoms(problem: Problem, dimension: int, where: str) -> FreedomsError:
    freedoms = count_text(dimension + problem.free, "freedom")
    form = problem.model.form if isinstance(problem.model, Model) else None
    idle = sum(count for _, count in form.idle) if isinstance(form, RodModel) else 0
    if idle:
        freedoms += f", {idle} of them idle,"
    return FreedomsError(
        f"it moves with {freedoms} {where}".rstrip(" ,")
        + "; a motion is that of a mechanism with one: drive joints to values"
    ).mended_by("drive")


def _no_motion(rigid: int, not_looked_for: str) -> str:
    rest = f"; not looked at: what is {not_looked_for}" if not_looked_for else ""
    if rigid:
        assemblies = count_text(rigid, "real assembly", "real assemblies")
        return f"it has no real motion, only {assemblies} that cannot move{rest}"
    return f"it has no real motion: no component of dimension 1 has real points{rest}"


@dataclass(frozen=True, eq=False)
class _FoundCircuit:
    """A circuit, the path and its values that it was made of, and how far along that it ends."""

    circuit: Circuit
    path: Path
    values: Values
    end: float


def _circuits_on(
    problem: Problem, scene: Scene, number: int, real: RealCurve, which: Which, samples: int
) -> list[_FoundCircuit]:
    """The circuits on a curve, or those through the reference configuration, without numbers."""
    references = _references(problem) if scene.from_reference else []
    curve = Curve(real, problem.system, scene)
    found = []
    for walk in walks_of(real, curve.coordinates):
        begun = (_begin_at(curve, walk, reference) for reference in references)
        first = next((each for each in begun if each is not None), None)
        if first is not None or which != "reference":
            on = first is not None
            found.append(_sample(0, number, curve, first or walk, on, samples))
    return found


def _references(problem: Problem) -> list[np.ndarray]:
    """The points of the reference configuration: with all signs of Euler parameters."""
    if problem.reference is None:
        return []
    points = [np.array([float(x) for x in problem.reference])]
    if isinstance(problem.model, Model) and problem.model.sign_group > 1:
        for g in problem.symmetries:
            images = [g.of_point(x) for x in points]
            points += [y for y in images if not any(np.array_equal(y, x) for x in points)]
    return points


def _each_once(scene: Scene, circuits: Iterable[_FoundCircuit]) -> list[_FoundCircuit]:
    """Circuits with their numbers, those through the reference configuration first."""
    found: list[_FoundCircuit] = []
    for made in sorted(circuits, key=lambda c: not c.circuit.through_reference):
        if not any(_is_same_motion(scene, made, other) for other in found):
            found.append(replace(made, circuit=replace(made.circuit, number=len(found) + 1)))
    return found


def _begin_at(curve: Curve, walk: CurveWalk, reference: np.ndarray) -> CurveWalk | None:
    """A walk with a point of the curve on it, begun there if it is closed; None if it is not."""
    coordinates = walk.coordinates
    at = coordinates.align_signs(
        np.repeat(coordinates.chart(reference[None]), len(walk.chart), axis=0), walk.chart
    )
    gaps = walk.chart - at
    nearest = int(np.linalg.norm(gaps, axis=1).argmin())
    if np.linalg.norm(gaps[nearest]) < SAME:
        return walk.begin_at(nearest)
    steps = np.diff(walk.chart, axis=0)
    squares = np.maximum((steps**2).sum(axis=1), np.finfo(float).tiny)
    shares = np.clip(-(gaps[:-1] * steps).sum(axis=1) / squares, 0.0, 1.0)
    distances = np.linalg.norm(gaps[:-1] + shares[:, None] * steps, axis=1)
    segment = int(distances.argmin())
    target = at[segment]
    if are_singular(curve, target[None])[0]:
        passes = _passes_through(walk, segment, target)
        return (
            walk.insert(np.array([segment]), target[None]).begin_at(segment + 1) if passes else None
        )
    point = walk.chart[segment] + shares[segment] * steps[segment]
    ahead = steps[segment] / np.sqrt(squares[segment])
    for _ in range(APPROACHES):
        # Along the chord as far as the reference is, and back to the curve.
        point = curve.sharpen((point + ahead * (ahead @ (target - point)))[None])[0]
        if np.linalg.norm(point - target) < SAME:
            return walk.insert(np.array([segment]), target[None]).begin_at(segment + 1)
    return None


def _passes_through(walk: CurveWalk, segment: int, point: np.ndarray) -> bool:
    """Whether a walk passes a point, next to which Newton's method may lead to another one."""
    last = len(walk.chart) - 1
    if walk.closed:
        around = (segment + np.arange(1 - AROUND, AROUND + 1)) % last
    else:
        around = np.arange(max(segment + 1 - AROUND, 0), min(segment + AROUND, last) + 1)
    chart = walk.coordinates.make_continuous(walk.chart[around])
    near = walk.coordinates.align_signs(point[None], chart[len(chart) // 2])[0]
    between = interpolate_ahead(chart, np.array([near @ (chart[-1] - chart[0])]))
    return bool(np.linalg.norm(between - near) < SAME)


def _sample(
    number: int, component: int, curve: Curve, walk: CurveWalk, on_reference: bool, samples: int
) -> _FoundCircuit:
    walk, unbounded = _within_reach(curve, walk)
    path = sample_path(curve, walk, 2 * samples + 1)
    values = values_along(path, on_reference)
    # Euler parameters may run twice through all configurations, with other signs.
    half = path.poses.at(slice(0, samples + 1)), path.poses.at(slice(samples, None))
    spacing = path.length / (2 * samples)
    twice = walk.closed and bool(
        (pose_distances(*half, curve.scene.measure) < BESIDE * spacing).all()
    )
    step = slice(0, samples + 1) if twice else slice(0, None, 2)
    poses = path.poses.at(step)
    if twice:
        poses = _return_to_start(poses)
    poses = steady_rods(poses, curve.scene.rods, walk.closed).with_continuous_signs()
    return _FoundCircuit(
        Circuit(
            number,
            component,
            walk.closed,
            unbounded,
            on_reference and walk.closed,
            on_reference,
            path.arc[step],
            curve.coordinates.points(path.chart[step]),
            poses,
            _part(values, step, path.length / 2 if twice else np.inf),
            (),
        ),
        path,
        values,
        path.length / 2 if twice else np.inf,
    )


def _within_reach(curve: Curve, walk: CurveWalk) -> tuple[CurveWalk, bool]:
    """A walk as far as bodies stay near, and whether it goes to infinity, as open ones do.

    It ends where they are that far away, and not at the last of its own points before, which are
    others for other equations.
    """
    if walk.closed:
        return walk, False
    walk = _follow_out(curve, walk)
    last = len(walk.chart) - 1
    along = MeasuredWalk(curve, walk, np.arange(last + 1.0))
    far = _reaches(curve, walk.chart)
    limit = _least_reach(along, int(far.argmin())) + REACH * curve.scene.size
    inside = np.flatnonzero(far <= limit)
    low, high = int(inside[0]), int(inside[-1])
    if low == 0 and high == last:
        return walk, True
    # Of each end that is cut off the segment, and the place on it.
    cuts = [(low - 1, _leave_reach(along, low, low - 1, limit))] if low else []
    cuts += [(high, _leave_reach(along, high, high + 1, limit))] if high < last else []
    segments = np.array([segment for segment, _ in cuts])
    points = along.points_at(np.array([place for _, place in cuts]))
    longer = walk.insert(segments, points)
    end = high + len(cuts)
    vertices = tuple((v, i - low) for v, i in longer.vertices if low <= i <= end)
    return replace(longer, chart=longer.chart[low : end + 1], vertices=vertices), True


def _follow_out(curve: Curve, walk: CurveWalk) -> CurveWalk:
    """An open walk with points before and behind its own, until bodies are out of reach.

    Its own end where infinity is near in the variables of the equations.
    """
    nearest = float(_reaches(curve, walk.chart).min())
    last, known = len(walk.chart) - 1, {index for _, index in walk.vertices}
    before, behind = (
        np.empty((0, walk.chart.shape[1])) if end in known else _steps_out(curve, pair, nearest)
        for end, pair in ((0, walk.chart[1::-1]), (last, walk.chart[-2:]))
    )
    chart = np.concatenate([before[::-1], walk.chart, behind])
    vertices = tuple((v, i + len(before)) for v, i in walk.vertices)
    return replace(walk, chart=chart, vertices=vertices)


def _steps_out(curve: Curve, pair: np.ndarray, nearest: float) -> np.ndarray:
    """Points on from the second of a pair until bodies are out of reach, shape ``(k, size)``."""
    points = list(pair)
    for _ in range(MOST_STEPS_OUT):
        (reach,) = _reaches(curve, points[-1][None])
        if reach > nearest + REACH * curve.scene.size:
            break
        step = LENGTHENING * (points[-1] - points[-2])
        points.append(curve.sharpen((points[-1] + step)[None])[0])
    return np.array(points[2:]).reshape(-1, pair.shape[1])


def _reaches(curve: Curve, chart: np.ndarray) -> np.ndarray:
    """How far the farthest body is from the ground at points of a chart, shape ``(k,)``."""
    poses, scene = curve.poses(chart), curve.scene
    middles = [poses.move(i, centre) for i, centre in enumerate(scene.centres)]
    base = middles[scene.ground]
    far = np.max([np.linalg.norm(m - base, axis=1) for m in middles], axis=0)
    return np.where(np.isnan(far), np.inf, far)


def _least_reach(along: MeasuredWalk, nearest: int) -> float:
    """How near all bodies come, beside the point of a walk where they are nearest."""

    def reaches_at(places: np.ndarray) -> np.ndarray:
        return _reaches(along.curve, along.points_at(places))

    return find_least(reaches_at, float(nearest), 1.0, (0.0, len(along.arc) - 1.0))[1]


def _leave_reach(along: MeasuredWalk, inside: float, outside: float, limit: float) -> float:
    """The place between two of a walk up to which all bodies are within a limit."""
    for _ in range(NARROWINGS):
        places = np.linspace(inside, outside, PLACES)
        beyond = _reaches(along.curve, along.points_at(places[1:-1])) > limit
        # The first of them, or the last place of all.
        first = int(np.append(beyond, True).argmax())
        inside, outside = places[first], places[first + 1]
    return float(inside)


def _return_to_start(poses: Poses) -> Poses:
    """Poses that end where they began, as they do to the error of their distances."""
    turns, places = np.array(poses.turns), np.array(poses.places)
    signs = np.sign((turns[:, 0] * turns[:, -1]).sum(axis=-1, keepdims=True))
    turns[:, -1], places[:, -1] = signs * turns[:, 0], places[:, 0]
    return Poses(turns, places)


def _part(values: Values, step: slice, end: float) -> Values:
    """The values at some of the samples, up to a distance from the first."""
    own = np.array(values.values[step])
    angles = np.array([c.kind == "angle" for c in values.coordinates], dtype=bool)
    turns = values.turns
    turning = []
    for point in values.turning:
        if point.arc < end:
            sample = point.sample // (step.step or 1)
            turning.append(replace(point, sample=sample))
    ranges = values.ranges
    if np.isfinite(end):
        turns = np.where(angles, np.round((own[-1] - own[0]) / (2 * np.pi)), 0).astype(int)
        own[-1] = own[0] + 2 * np.pi * turns
        ranges = np.stack([own.min(axis=0), own.max(axis=0)], axis=-1)
        for i, each in enumerate(values.coordinates):
            extreme = [p.value for p in turning if p.coordinate == each.name]
            ranges[i] = min([ranges[i, 0], *extreme]), max([ranges[i, 1], *extreme])
    return Values(values.coordinates, own, tuple(turning), ranges, turns, values.still)


def _is_same_motion(scene: Scene, one: _FoundCircuit, other: _FoundCircuit) -> bool:
    """Whether two circuits run through the same configurations."""
    a, b = one.path, other.path
    spacing = b.length / (len(b.poses) - 1)
    if one.circuit.closed != other.circuit.closed:
        return False
    if abs(one.circuit.length - other.circuit.length) > BESIDE * other.circuit.length:
        return False
    some = np.linspace(0, len(a.poses) - 1, 7).astype(int)[1:-1]
    for i in some:
        at = Poses(
            np.repeat(a.poses.turns[:, i : i + 1], len(b.poses), axis=1),
            np.repeat(a.poses.places[:, i : i + 1], len(b.poses), axis=1),
        )
        distances = pose_distances(at, b.poses, scene.measure)
        if distances.min() > (0.5 + BESIDE) * spacing:
            return False
    return True


@dataclass(frozen=True, eq=False)
class _SingularPlace:
    """A circuit at a singular configuration: how far along, the point and the bodies there."""

    made: _FoundCircuit
    arc: float
    point: np.ndarray
    pose: Poses


def _singular_places(made: _FoundCircuit) -> list[_SingularPlace]:
    """The vertices of the real curve on a path, and where else its equations lose rank."""
    measured = made.path.measured
    walk = measured.walk
    places = [
        (arc, walk.chart[index])
        for (_, arc), (_, index) in zip(measured.vertices, walk.vertices, strict=True)
    ]
    places += [(each.arc, each.points_at(np.zeros(1))[0]) for each in measured.passages]
    return [
        _SingularPlace(
            made,
            arc,
            measured.curve.coordinates.points(chart[None])[0],
            measured.curve.poses(chart[None]),
        )
        for arc, chart in sorted(places, key=lambda p: p[0])
        if arc < made.end
    ]


def _same_poses(places: Sequence[_SingularPlace]) -> np.ndarray:
    """Which of them are one configuration, shape ``(k, k)``."""
    if not places:
        return np.zeros((0, 0), dtype=bool)
    scene = places[0].made.path.curve.scene
    every = join_poses([p.pose for p in places])
    rows = []
    for i in range(len(places)):
        alone = every.at(np.full(len(places), i))
        rows.append(pose_distances(alone, every, scene.measure) < SAME)
    return np.array(rows)


def _with_crossings(
    found: Sequence[_FoundCircuit], configurations: Configurations, own: Sequence[int], run: Run
) -> list[Circuit]:
    """The circuits with the singular configurations on their way."""
    places = [place for made in found for place in _singular_places(made)]
    same = _same_poses(places)
    known: list[tuple[int, tuple[int, ...] | None]] = []
    crossings: dict[int, list[Crossing]] = {made.circuit.number: [] for made in found}
    for i, here in enumerate(places):
        circuit = here.made.circuit
        numbers = {
            other.made.circuit.number for k, other in enumerate(places) if k != i and same[i, k]
        }
        through = next((components for k, components in known if same[i, k]), ())
        if not any(same[i, k] for k, _ in known):
            if len(known) < MOST_PLACES:
                through = find_components_through(configurations, here.point, run)
            else:
                through = None
            known.append((i, through))
        others = None
        if through is not None:
            itself = configurations.classes[own[circuit.component]]
            others = tuple(k for k in through if k != itself)
        step = float(circuit.arc[1] - circuit.arc[0])
        crossings[circuit.number].append(
            Crossing(round(here.arc / step), here.arc, tuple(sorted(numbers)), others)
        )
    return [
        replace(made.circuit, crossings=tuple(crossings[made.circuit.number])) for made in found
    ]


def _find_idle(problem: Problem, run: Run) -> tuple[str, int]:
    """Which parts of a mechanism turn idly, in words, and with how many freedoms.

    Near its reference configuration; where joints are held and there is none, those that turn so
    in all configurations, which its equations leave out.
    """
    made = problem.model
    if not isinstance(made, Model):
        return "", 0
    from nag.mechanism.joint_chains import NotClear
    from nag.mechanism.moving_parts import IdleFreedom, describe_parts, find_moving_parts

    if isinstance(made.form, RodModel) and made.form.displacements:
        parts = [IdleFreedom(bodies, count, True) for bodies, count in made.form.idle]
        return describe_parts(parts), sum(each.count for each in parts)
    if problem.reference is None:
        return "", 0
    try:
        found = find_moving_parts(made.mechanism, 1 + problem.free, run.random(Stream.MOVING_PARTS))
    except NotClear:
        return "", 0
    # What moves alone where nothing else does is the motion itself.
    known = found.idle_count < 1 + problem.free
    return (found.idle_text, found.idle_count) if known else ("", 0)
