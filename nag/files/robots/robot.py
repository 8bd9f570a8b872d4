"""Robots as trees of links, and the mechanism that one is when links are held and loops closed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from nag.algebra.expression import parse_number
from nag.algebra.from_python import plain_number
from nag.algebra.number import Irrational, Number, is_zero, rounded_fraction, square_root
from nag.algebra.tokens import ExpressionError, nearest, quote
from nag.errors import MechanismError, NagError
from nag.files.case_table import CaseError, line_of
from nag.mechanism.axes import Vector, cross, difference, dot, vanishes
from nag.mechanism.given_rotation import SHORT, GivenFrame, Taken, turn_about
from nag.mechanism.graph import ORIGIN, Joint, Mechanism, connected_to
from nag.text.table import count_text

UNITS = tuple(tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3))
# Freedoms of these have a value each in a file: an angle, a length.
VALUED = ("revolute", "prismatic")
MAX_JOINTS = 500
# Decides: Lengths by which what is to coincide may be apart in rounded numbers, and is said to.
APART = 1e-6


@dataclass(frozen=True)
class RobotJoint:
    """A joint of a tree.

    Attributes:
        name: unique among the joints.
        type: one of `nag.mechanism.joint_types.JOINT_TYPES`, or ``floating``.
        parent: the link nearer to the ground.
        child: the other one.
        place: the joint's frame in the parent's, and that of the child where the joint is at zero.
        where: file, line and column, for messages.
        axis: in the joint's frame; None for types without one.
        point: a point of the axis in that frame.
        zero: the value at which the child is where it is drawn.
        taken: what the numbers of its place were taken for.
        limited: whether the file says how far it turns or slides.
    """

    name: str
    type: str
    parent: str
    child: str
    place: GivenFrame
    where: str
    axis: Vector | None = None
    point: Vector = ORIGIN
    zero: Number = Fraction(0)
    taken: tuple[Taken, ...] = ()
    limited: bool = False


@dataclass(frozen=True)
class LoopClosure:
    """A joint that closes a loop, given in the frame of the first of its links.

    Attributes:
        name: unique among joints and closures.
        type: one of `nag.mechanism.joint_types.JOINT_TYPES`.
        bodies: the two links.
        where: file and place, for messages.
        point: of the joint, in the first link's frame.
        axis: likewise.
        second_axis: likewise.
        second_point: the same point in the second link's frame, where the file gives it.
        second_frame: the second link's frame in the first link's, where the file gives it.
        closed_here: whether what is not given of the second link is where both meet with the joints
            as they stand, not where the file draws them.
    """

    name: str
    type: str
    bodies: tuple[str, str]
    where: str
    point: Vector = ORIGIN
    axis: Vector | None = None
    second_axis: Vector | None = None
    second_point: Vector | None = None
    second_frame: GivenFrame | None = None
    closed_here: bool = False


@dataclass(frozen=True)
class Robot:
    """A tree of links on a fixed one, and what closes its loops."""

    title: str
    ground: str
    joints: tuple[RobotJoint, ...]
    closures: tuple[LoopClosure, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def links(self) -> tuple[str, ...]:
        """All links, the ground first."""
        return (self.ground, *(j.child for j in self.joints))


def fail(where: str, *parts: str) -> NoReturn:
    """Raise a `CaseError` about a place of a file."""
    raise CaseError(line_of(where, *parts))


def assemble(
    robot: Robot, file: str, hold: Sequence[str] = (), values: Mapping[str, str | Number] = {}
) -> tuple[Mechanism, tuple[str, ...]]:
    """The mechanism that a robot is at given joint values, with links held there; what was taken.

    Args:
        hold: links that are fixed to the ground.
        values: angles in radians and lengths of joints, 0 by default.

    Raises:
        CaseError: if there is no such link or joint, or loops do not close at these values.
    """
    if len(robot.joints) + len(robot.closures) > MAX_JOINTS:
        fail(file, f"has more than {MAX_JOINTS} joints; that is the most that is read")
    moved, taken = _move_joints(robot, file, values)
    frames = _frames(robot, moved)
    joints, floating = [], []
    for joint in robot.joints:
        frame = frames[joint.parent].then(joint.place)
        if joint.type == "floating":
            floating.append((joint, frame))
            continue
        axis = None if joint.axis is None else frame.turned(joint.axis)
        bodies = (joint.parent, joint.child)
        joints.append(_joint(joint.name, joint.type, bodies, frame.placed(joint.point), axis))
    zero = _frames(robot, {}) if moved else frames
    closing = [_closing(closure, frames, zero) for closure in robot.closures]
    joints += _merge_joints([joint for joint, _ in closing])
    joints += [_held(robot, file, link, k) for k, link in enumerate(hold, 1)]
    notes = list(robot.notes)
    for joint, frame in floating:
        ties = [j.bodies for j in joints]
        ties += [(other.parent, other.child) for other, _ in floating if other is not joint]
        if joint.child in connected_to(joint.parent, ties):
            notes.append(f"joint {joint.name} leaves all free, and is left out")
            floating = [f for f in floating if f[0] is not joint]
        else:
            joints += _free_joints(joint, frame)
    notes += [f"{j.name} closes by moving {gap:.2g}" for j, gap in closing if gap]
    if limited := sum(joint.limited for joint in robot.joints):
        notes.append(
            f"limits of {count_text(limited, 'joint')} are not used: what lies beyond them is "
            "counted as well"
        )
    notes += _notes((*(t for j in robot.joints for t in j.taken), *taken))
    try:
        return Mechanism(robot.ground, tuple(joints)), tuple(notes)
    except MechanismError as error:
        where = next((j.where for j in robot.joints if j.name == error.joint), file)
        fail(where, str(error))


def _joint(
    name: str,
    type: str,
    bodies: tuple[str, str],
    point: Vector,
    axis: Vector | None = None,
    second_axis: Vector | None = None,
) -> Joint:
    return Joint(name, type, bodies, point, axis, second_axis)


def _move_joints(
    robot: Robot, file: str, values: Mapping[str, str | Number]
) -> tuple[dict[str, GivenFrame], list[Taken]]:
    """How joints have moved that are not where the file draws them, in their own frames."""
    joints = {joint.name: joint for joint in robot.joints}
    moved, taken = {}, []
    for name, given in values.items():
        joint = joints.get(name)
        if joint is None:
            valued = [j.name for j in robot.joints if j.type in VALUED]
            fail(
                file,
                f"at: {quote(name)} is no joint{nearest(name, valued)}; those with a value are "
                f"{', '.join(valued[:12]) or 'none'}",
            )
        if joint.type not in VALUED or joint.axis is None:
            fail(file, f"at: {quote(name)}: a {joint.type} joint; revolute and prismatic ones move")
        try:
            value = parse_number(plain_number(given)) - joint.zero
            if joint.type == "revolute":
                turn = turn_about(joint.axis, value)
                back = GivenFrame(turn.quaternion).turned(joint.point)
                moved[name] = GivenFrame(turn.quaternion, difference(joint.point, back))
                taken += turn.taken
                continue
        except (ExpressionError, NagError) as error:
            fail(file, f"at: {quote(name)}", str(error))
        moved[name] = GivenFrame(origin=_slid(joint.axis, value))
    return moved, taken


def _slid(axis: Vector, length: Number) -> Vector:
    share = length / square_root(dot(axis, axis))
    if isinstance(share, Irrational):
        share = rounded_fraction(share, SHORT)
    return tuple(share * x for x in axis)


def _frames(robot: Robot, moved: Mapping[str, GivenFrame]) -> dict[str, GivenFrame]:
    """The place of every link; joints come after those that their parents hang on."""
    frames = {robot.ground: GivenFrame()}
    for joint in robot.joints:
        frame = frames[joint.parent].then(joint.place)
        own = moved.get(joint.name)
        frames[joint.child] = frame if own is None else frame.then(own)
    return frames


def _held(robot: Robot, file: str, link: str, number: int) -> Joint:
    links = robot.links
    if link not in links:
        fail(
            file,
            f"hold: {quote(link)} is no link{nearest(link, links)}; the links are "
            f"{', '.join(links[:12])}{', ...' if len(links) > 12 else ''}",
        )
    if link == robot.ground:
        fail(file, f"hold: {quote(link)} is fixed as it is; name a link that moves")
    taken = {j.name for j in robot.joints} | {c.name for c in robot.closures}
    name = f"hold {number}"
    while name in taken:
        name += "'"
    return Joint(name, "rigid", (robot.ground, link))


def _closing(
    closure: LoopClosure, frames: Mapping[str, GivenFrame], zero: Mapping[str, GivenFrame]
) -> tuple[Joint, float]:
    """The joint that closes a loop, and how far that is open at these values of the joints."""
    first, second = (frames[body] for body in closure.bodies)
    drawn = frames if closure.closed_here else zero
    first_zero, second_zero = (drawn[body] for body in closure.bodies)
    joint = _joint(
        closure.name,
        closure.type,
        closure.bodies,
        first.placed(closure.point),
        *(
            None if axis is None else first.turned(axis)
            for axis in (closure.axis, closure.second_axis)
        ),
    )
    there = closure.second_point
    if there is None:
        there = second_zero.seen(first_zero.placed(closure.point))
    gap = difference(second.placed(there), joint.point)
    if closure.type in ("prismatic", "cylindrical"):
        gap = cross(gap, joint.axis)
    elif closure.type == "planar":
        gap = (dot(gap, joint.axis),)
    apart = list(gap)
    directions: Sequence[Vector] = () if closure.axis is None else (closure.axis,)
    if closure.type in ("prismatic", "rigid"):
        directions = UNITS
    for v in directions:
        if closure.second_axis is not None:
            # The angle between both axes of a universal joint stays.
            own = second.turned(second_zero.back(first_zero.turned(closure.second_axis)))
            apart.append(dot(first.turned(v), own) - dot(v, closure.second_axis))
            continue
        if closure.second_frame is not None:
            own = second.turned(closure.second_frame.back(v))
        else:
            own = second.turned(second_zero.back(first_zero.turned(v)))
        apart += difference(own, first.turned(v))
    open_by = max((abs(float(x)) for x in apart if not is_zero(x)), default=0.0)
    if open_by > APART:
        fail(
            closure.where,
            f"the loop is open by {open_by:.3g} here; give values of joints (at) at which it "
            "closes, or the same place twice",
        )
    return joint, open_by


def _merge_joints(joints: Sequence[Joint]) -> list[Joint]:
    """Closures; points of two links that are held together are a hinge if two, a weld if more."""
    found: list[Joint] = []
    for joint in joints:
        k = next((i for i, other in enumerate(found) if _holds_more(other, joint)), None)
        if k is None:
            found.append(joint)
            continue
        other = found[k]
        gap = difference(joint.point, other.point)
        if vanishes(gap) or other.type == "rigid":
            continue
        if other.type == "spherical":
            found[k] = _joint(other.name, "revolute", other.bodies, other.point, gap)
        elif other.axis is not None and not vanishes(cross(gap, other.axis)):
            found[k] = _joint(other.name, "rigid", other.bodies, other.point)
    return found


def _holds_more(first: Joint, second: Joint) -> bool:
    """Whether the second joint is a point of the same two links."""
    same = second.type == "spherical" and set(first.bodies) == set(second.bodies)
    return same and first.type in ("spherical", "revolute", "rigid")


def _free_joints(joint: RobotJoint, frame: GivenFrame) -> list[Joint]:
    """Three slides and a ball, for a link that nothing else holds."""
    bodies = [joint.parent, *(f"{joint.name}: {x}" for x in "xyz"), joint.child]
    found = [
        _joint(f"{joint.name}: {x}", "prismatic", (bodies[i], bodies[i + 1]), ORIGIN, UNITS[i])
        for i, x in enumerate("xyz")
    ]
    ball = _joint(f"{joint.name}: turn", "spherical", (bodies[3], bodies[4]), frame.origin)
    return [*found, ball]


def _notes(taken: Sequence[Taken]) -> list[str]:
    """What angles were taken for, in words."""
    exact = dict.fromkeys((t.given, t.exact) for t in taken if t.exact and t.given != t.exact)
    rounded = dict.fromkeys(t.given for t in taken if not t.exact)
    notes = []
    if exact:
        shown = [f"{given} as {known}" for given, known in list(exact)[:4]]
        more = f", and {len(exact) - 4} more" if len(exact) > 4 else ""
        notes.append(f"angles taken exactly: {', '.join(shown)}{more}")
    if rounded:
        more = f", and {len(rounded) - 4} more" if len(rounded) > 4 else ""
        notes.append(
            f"angles taken to rational rotations within 1e-15: {', '.join(list(rounded)[:4])}{more}"
        )
    return notes


def check_unique(names: Sequence[tuple[str, str]], what: str) -> None:
    """Complain about a name that is there twice; names come with where they are."""
    seen: set[str] = set()
    for name, where in names:
        if name in seen:
            fail(where, f"{what} {quote(name)} is there twice; give each a name of its own")
        seen.add(name)
