"""A joint driven through several values, and what the rest can do at each of them.

Of one freedom these are the assemblies with each value; of two, the circuits that are left. What is
next to what at the following value is taken for its continuation, if either is the nearest of the
other: between values that are far apart circuits may have met and parted.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.from_python import real_double
from nag.algebra.given import Drives, Moving, Placements
from nag.errors import NagError
from nag.kinematics import MOST_VALUES
from nag.kinematics.driven import (
    Drive,
    Pose,
    check_drive,
    place_frames,
    problem_to_move,
    read_drives,
    read_poses,
)
from nag.kinematics.joint_values import Coordinate, joint_coordinates
from nag.kinematics.motion import (
    SAMPLES,
    Circuit,
    FreedomsError,
    Motion,
    drive_circuits,
    has_several_freedoms,
    held_motion,
    join_tables,
)
from nag.kinematics.poses import Poses, pose_distances
from nag.kinematics.scene import Scene, scene_of
from nag.mechanism.problem import Problem
from nag.mechanism.real_assemblies import of_real_assemblies
from nag.numerics.read_only import Several, equal_values
from nag.text.table import data_frame, one_line
from nag.tracking.run import DEFAULT_RUN, ENDED_EARLY, Run, TellFound, takes_run

if TYPE_CHECKING:
    import pandas

# Samples of a circuit that are compared with those of another one.
COMPARED = 60


@dataclass(frozen=True)
class Continuation:
    """A circuit, or an assembly that does not move, as it goes on from value to value.

    Attributes:
        moves: whether it is a circuit.
        first: index of the value at which it begins.
        members: index of the circuit, or of the assembly, at each of the values from there on.
    """

    moves: bool
    first: int
    members: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class DrivenMotion(Several[Motion]):
    """A mechanism with a joint at one value after another.

    Attributes:
        coordinate: the joint's angle or slide.
        values: in radians, or lengths.
        motions: what is left at each.
        continuations: how circuits and assemblies go on, by where they begin.
        notes: what is not known, besides what each of the motions says.
    """

    coordinate: Coordinate
    values: tuple[float, ...]
    motions: tuple[Motion, ...]
    continuations: tuple[Continuation, ...]
    notes: tuple[str, ...] = ()

    __eq__ = equal_values

    @property
    def complete(self) -> bool:
        """Whether nothing is left open at any value."""
        return not self.notes and all(motion.complete for motion in self.motions)

    @property
    def entries(self) -> tuple[Motion, ...]:
        """What is left at each value."""
        return self.motions

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.kinematics.shown import driven_text

        return driven_text(self)

    def table(self, *, angles: str = "degrees") -> dict[str, np.ndarray]:
        """What is left at each value, one below the other, with the value as first column.

        Circuits have the numbers of their continuations: what goes on has the same one.

        Args:
            angles: ``"degrees"`` or ``"radians"``.
        """
        turned = self.coordinate.kind == "angle" and angles == "degrees"
        # Degrees that were given come back as they were.
        values = np.round(np.degrees(self.values), 12) if turned else np.array(self.values)
        moving = [each for each in self.continuations if each.moves]
        tables = []
        for k, (value, motion) in enumerate(zip(values, self.motions, strict=True)):
            # Circuits are those of what is left only where the joint is held.
            held = motion.drive is None
            columns = motion.whole_table(angles=angles)
            if held and motion.circuits:
                numbers = {
                    motion.circuits[each.members[k - each.first]].number: number
                    for number, each in enumerate(moving, start=1)
                    if 0 <= k - each.first < len(each.members)
                }
                own = [numbers.get(c, 0) for c in columns["circuit"].tolist()]
                columns = columns | {"circuit": np.array(own, dtype=int)}
            tables.append({"driven": np.full(len(columns["arc"]), value)} | columns)
        return join_tables(tables)

    def to_dataframe(self, *, angles: str = "degrees") -> pandas.DataFrame:
        """The same as a frame of pandas.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(self.table(angles=angles))

    def document(self) -> dict[str, Any]:
        """All of it as a JSON object without its head; angles are in radians."""
        return {
            "coordinate": self.coordinate.name,
            "kind": self.coordinate.kind,
            "notes": list(self.notes),
            "values": list(self.values),
            "motions": [motion.document() for motion in self.motions],
            "continuations": [
                {
                    "of": "circuit" if each.moves else "assembly",
                    "first": each.first,
                    "members": list(each.members),
                }
                for each in self.continuations
            ],
        }


@takes_run
def driven_motion(
    mechanism: Moving,
    coordinate: str,
    values: Sequence[float],
    *,
    samples: int = SAMPLES,
    formulation: str = "auto",
    drive: Drives | None = None,
    pose: Placements | None = None,
    run: Run = DEFAULT_RUN,
) -> DrivenMotion:
    """What a mechanism can do with a joint at one value after another.

    Args:
        mechanism: as for `nag.motion`.
        coordinate: the name of an angle or slide.
        values: in radians, or lengths, in the order in which it is driven through them.
        samples: as for `nag.motion`.
        formulation: as for `nag.motion`.
        drive: other joints that are held, as `nag.motion` takes them.
        pose: bodies that are held, as `nag.motion` takes them.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.kinematics.motion.MotionError: if with the joint held two freedoms or more are left.
        NagError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> driven = nag.driven_motion("cases/bennett.toml", "J0", [0.2, 0.4])
    >>> [len(motion.assemblies) for motion in driven]
    [1, 1]
    """
    if isinstance(values, str | bytes | Set) or not isinstance(values, Iterable):
        raise NagError("values: give a list of numbers, [0.1, 0.2]")
    numbers = [real_double(value, f"values[{i}]") for i, value in enumerate(values)]
    if not 1 <= len(numbers) <= MOST_VALUES:
        raise NagError(f"values: give 1 to {MOST_VALUES}, not {len(numbers)}")
    others, poses = read_drives(drive), read_poses(pose)
    problem = of_real_assemblies(problem_to_move(mechanism, poses, formulation))
    poses = place_frames(problem, poses)
    scene = scene_of(problem)
    steps = [Drive(coordinate, value) for value in numbers]
    column = check_drive(scene, steps[0])
    motions: list[Motion] = []

    def through(notes: tuple[str, ...] = ()) -> DrivenMotion:
        own = tuple(each.value for each in steps[: len(motions)])
        named = joint_coordinates(scene)[column]
        return DrivenMotion(named, own, tuple(motions), _continuations(motions), notes)

    def first_values() -> DrivenMotion:
        rest = f"{len(steps) - len(motions)} of {len(steps)} values were not reached"
        return through((ENDED_EARLY, rest))

    with TellFound(run, first_values) as tell:
        run.tell("values", 0, len(steps))
        for motion in _motions(problem, steps, others, poses, samples, run.without_found):
            motions.append(motion)
            run.tell("values", len(motions), len(steps))
            tell(len(motions) < len(steps))
    return through()


def _motions(
    problem: Problem,
    steps: Sequence[Drive],
    others: Sequence[Drive],
    poses: Sequence[Pose],
    samples: int,
    run: Run,
) -> Iterator[Motion]:
    """What is left at each value, one after another."""
    if not others and not poses and not has_several_freedoms(problem, run):
        try:
            return drive_circuits(problem, steps, samples=samples, run=run)
        except FreedomsError:
            pass
    return (
        held_motion(problem, (*others, step), poses, samples=samples, run=run) for step in steps
    )


def _continuations(motions: Sequence[Motion]) -> tuple[Continuation, ...]:
    """How circuits and assemblies go on; those of one freedom have circuits of their own."""
    found: list[Continuation] = []
    for moves in (True, False):
        if moves and motions[0].drive is not None:
            continue
        open_ones: dict[int, Continuation] = {}
        before: list[Poses] = []
        for i, motion in enumerate(motions):
            own = _places(motion, moves)
            pairs = _nearest_pairs(motion.scene, before, own)
            going: dict[int, Continuation] = {}
            for k in range(len(own)):
                earlier = open_ones.pop(pairs[k]) if k in pairs else Continuation(moves, i, ())
                going[k] = replace(earlier, members=(*earlier.members, k))
            found += open_ones.values()
            open_ones, before = going, own
        found += open_ones.values()
    return tuple(sorted(found, key=lambda each: (not each.moves, each.first, each.members)))


def _places(motion: Motion, moves: bool) -> list[Poses]:
    """Where all bodies are along each circuit, at some of the samples, or in each assembly."""
    if not moves:
        return [each.poses for each in motion.assemblies]
    return [_some(circuit) for circuit in motion.circuits]


def _some(circuit: Circuit) -> Poses:
    step = max(1, len(circuit) // COMPARED)
    return circuit.poses.at(slice(None, None, step))


def _nearest_pairs(scene: Scene, before: Sequence[Poses], after: Sequence[Poses]) -> dict[int, int]:
    """Of places at a value and at the next, which are the nearest to each other."""
    if not before or not after:
        return {}
    gaps = np.array([[_gap(scene, a, b) for b in before] for a in after])
    nearest, back = gaps.argmin(axis=1), gaps.argmin(axis=0)
    return {k: int(b) for k, b in enumerate(nearest) if back[b] == k}


def _gap(scene: Scene, one: Poses, other: Poses) -> float:
    """How far the places of either are from the nearest ones of the other, at most."""
    count, most = len(one), len(other)
    left = Poses(np.repeat(one.turns, most, axis=1), np.repeat(one.places, most, axis=1))
    right = Poses(np.tile(other.turns, (1, count, 1)), np.tile(other.places, (1, count, 1)))
    distances = pose_distances(left, right, scene.measure).reshape(count, most)
    return float(max(distances.min(axis=0).max(), distances.min(axis=1).max()))


def range_of(motions: Sequence[Motion], each: Continuation) -> tuple[float, float]:
    """Shortest and longest of the circuits of a continuation."""
    own = motions[each.first : each.first + len(each.members)]
    lengths = [m.circuits[k].length for m, k in zip(own, each.members, strict=True)]
    return min(lengths), max(lengths)
