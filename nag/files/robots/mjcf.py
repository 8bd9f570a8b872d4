"""Robots in MJCF, the format of MuJoCo: bodies, joints, and equalities that close loops.

Masses, shapes, actuators and contacts are left out, and so are limits, which is said. Angles are
in degrees unless the file says otherwise; joints of one body are in a row, the first one nearest to
the body's parent.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from nag.algebra.number import PI, Number
from nag.algebra.tokens import nearest, quote
from nag.errors import NagError
from nag.files.case_table import CaseError, line_of
from nag.files.robots.robot import LoopClosure, Robot, RobotJoint, check_unique
from nag.files.robots.xml_file import XmlElement, parse_xml
from nag.mechanism.given_rotation import (
    GivenFrame,
    GivenTurn,
    Taken,
    given_axis,
    given_point,
    given_quaternion,
    next_quaternion,
    turn_about,
    turns_in_order,
)
from nag.mechanism.quaternion import quaternion_of

WORLD = "world"
TYPES = {"hinge": "revolute", "slide": "prismatic", "ball": "spherical", "free": "floating"}
# URDF's words for them, and what a case calls them.
_MEANT = {
    **{other: own for own, other in TYPES.items()},
    "continuous": "hinge",
    "slider": "slide",
}
ORIENTATIONS = ("quat", "axisangle", "euler", "xyaxes", "zaxis")
# What stands for bodies that are not in the file, or made of parts that bend.
REFUSED = ("include", "composite", "flexcomp", "replicate", "attach")
ZEROS = "0 0 0"
MAIN = "main"


def recognise(text: str) -> bool:
    """Whether a text may be a model of MuJoCo's."""
    return text.lstrip().startswith("<") and "<mujoco" in text


@dataclass(frozen=True)
class _Angles:
    """How a file writes angles."""

    degrees: bool
    sequence: str

    def radians(self, value: Fraction) -> Number:
        return value / 180 * PI if self.degrees else value


@dataclass
class _FoundJoints:
    """What is found on the way through the bodies."""

    angles: _Angles
    classes: Mapping[str, Mapping[str, str]]
    joints: list[RobotJoint] = field(default_factory=list)
    bodies: list[tuple[str, str]] = field(default_factory=list)
    sites: dict[str, tuple[str, GivenFrame]] = field(default_factory=dict)


def read(file: str, text: str) -> Robot:
    """The robot that a file describes; its ground is the world.

    Raises:
        CaseError: if it makes no sense; one line says where, and what would be right.
    """
    root = parse_xml(file, text)
    if root.tag != "mujoco":
        root.fail("is no model of MuJoCo; its outermost element is <mujoco>")
    _refuse_within(root)
    angles = _Angles(True, "xyz")
    for compiler in root.all("compiler"):
        if compiler.choice("coordinate", ("local", "global"), "local") == "global":
            compiler.fail(
                "global coordinates are of old versions; save the model anew", "coordinate"
            )
        unit = compiler.choice(
            "angle", ("degree", "radian"), "degree" if angles.degrees else "radian"
        )
        sequence = compiler.attributes.get("eulerseq", angles.sequence)
        if len(sequence) != 3 or not set(sequence) <= set("xyzXYZ"):
            compiler.fail("write three of the letters x, y, z, X, Y, Z", "eulerseq")
        angles = _Angles(unit == "degree", sequence)
    found = _FoundJoints(angles, _classes(root))
    for world in root.all("worldbody"):
        _read_inside(world, WORLD, GivenFrame(), (), None, found)
    if not found.joints:
        root.fail("has no bodies; a mechanism has at least one that moves")
    check_unique([(WORLD, file), *found.bodies], "body")
    check_unique([(j.name, j.where) for j in found.joints], "joint")
    closures = _closures(root, found)
    check_unique(
        [*((j.name, j.where) for j in found.joints), *((c.name, c.where) for c in closures)],
        "joint or equality",
    )
    title = root.attributes.get("model", "").strip()
    title = title if title and title.isprintable() else "a robot"
    return Robot(title, WORLD, tuple(found.joints), tuple(closures))


def _refuse_within(root: XmlElement) -> None:
    stack = [root]
    while stack:
        element = stack.pop()
        if element.tag in REFUSED:
            element.fail("is not read; write the bodies that it stands for into the file")
        stack += element.children


def _classes(root: XmlElement) -> dict[str, dict[str, str]]:
    """Attributes of joints by their default class, those of the class around it among them."""
    classes: dict[str, dict[str, str]] = {MAIN: {}}
    front = [(element, MAIN) for element in root.all("default")]
    while front:
        element, around = front.pop(0)
        name = element.attributes.get("class", MAIN if around == MAIN else "")
        joint = element.one("joint")
        classes[name] = {**classes[around], **(joint.attributes if joint is not None else {})}
        front += [(inner, name) for inner in element.all("default")]
    return classes


def _read_inside(
    element: XmlElement,
    body: str,
    frame: GivenFrame,
    taken: tuple[Taken, ...],
    childclass: str | None,
    found: _FoundJoints,
) -> None:
    """The bodies and sites inside of a body, or of a frame in it."""
    childclass = element.attributes.get("childclass", childclass)
    for child in element.children:
        if child.tag not in ("body", "frame", "site"):
            if child.tag in ("joint", "freejoint") and element.tag != "body":
                child.fail(f"is in a <{element.tag}>; joints are written in a <body>")
            continue
        turn = _orientation(child, found.angles)
        here = frame.then(GivenFrame(turn.quaternion, given_point(child.numbers("pos", 3, ZEROS))))
        if child.tag == "site":
            if "name" in child.attributes:
                found.sites[child.text("name")] = (body, here)
        elif child.tag == "frame":
            _read_inside(child, body, here, taken + turn.taken, childclass, found)
        else:
            _read_body(child, body, here, taken + turn.taken, childclass, found)


def _read_body(
    element: XmlElement,
    parent: str,
    place: GivenFrame,
    taken: tuple[Taken, ...],
    childclass: str | None,
    found: _FoundJoints,
) -> None:
    where = line_of(element.file, element.place)
    named = "name" in element.attributes
    name = element.text("name") if named else f"body {len(found.bodies) + 1}"
    found.bodies.append((name, where))
    own_class = element.attributes.get("childclass", childclass)
    joints = [e for e in element.children if e.tag in ("joint", "freejoint")]
    if not joints:
        found.joints.append(
            RobotJoint(f"{name}.fixed", "rigid", parent, name, place, where, taken=taken)
        )
    for k, joint in enumerate(joints, 1):
        last = k == len(joints)
        read = _read_joint(joint, own_class, found, f"{name}.{k}")
        child = name if last else f"{name}: {read.name}"
        found.joints.append(
            RobotJoint(
                read.name,
                read.type,
                parent,
                child,
                place,
                read.where,
                read.axis,
                read.point,
                read.zero,
                taken,
                read.limited,
            )
        )
        parent, place, taken = child, GivenFrame(), ()
    _read_inside(element, name, GivenFrame(), (), childclass, found)


def _read_joint(
    element: XmlElement, childclass: str | None, found: _FoundJoints, unnamed: str
) -> RobotJoint:
    """A joint in the frame of its body; its links are filled in by that."""
    own = element.attributes.get("class", childclass or MAIN)
    if own not in found.classes:
        element.fail(f"{quote(own)} is no default class{nearest(own, found.classes)}", "class")
    given = XmlElement(
        element.file,
        element.line,
        element.column,
        element.tag,
        {**found.classes[own], **element.attributes},
    )
    name = given.text("name") if "name" in given.attributes else unnamed
    where = line_of(given.file, given.place)
    kind = (
        "free" if given.tag == "freejoint" else given.choice("type", tuple(TYPES), "hinge", _MEANT)
    )
    axis, zero = None, Fraction(0)
    if kind in ("hinge", "slide"):
        try:
            axis = given_axis(given.numbers("axis", 3, "0 0 1"))
        except CaseError:
            raise
        except NagError as error:
            given.fail(str(error), "axis")
        (zero,) = given.numbers("ref", 1, "0")
        if kind == "hinge":
            zero = found.angles.radians(zero)
    point = given_point(given.numbers("pos", 3, ZEROS))
    limited = "range" in given.attributes and given.attributes.get("limited") != "false"
    return RobotJoint(
        name, TYPES[kind], "", "", GivenFrame(), where, axis, point, zero, limited=limited
    )


def _orientation(element: XmlElement, angles: _Angles) -> GivenTurn:
    """The rotation that an element gives in one of five ways."""
    given = [key for key in ORIENTATIONS if key in element.attributes]
    if not given:
        return GivenTurn()
    if len(given) > 1:
        element.fail(f"{given[0]} gives the orientation already; leave one of them out", given[1])
    (key,) = given
    counts = {"quat": 4, "axisangle": 4, "euler": 3, "xyaxes": 6, "zaxis": 3}
    values = element.numbers(key, counts[key])
    try:
        if key == "quat":
            return given_quaternion(values)
        if key == "axisangle":
            return turn_about(given_axis(values[:3]), angles.radians(values[3]))
        if key == "euler":
            return turns_in_order([angles.radians(x) for x in values], angles.sequence)
        vectors = [given_axis(values[i : i + 3]) for i in range(0, len(values), 3)]
    except CaseError:
        raise
    except NagError as error:
        element.fail(str(error), key)
    found = _quaternion_of([[float(x) for x in v] for v in vectors])
    if found is None:
        element.fail("both axes have the same direction; they span a plane", key)
    return next_quaternion(found, f"{key} {' '.join(element.attributes[key].split())[:40]}")


def _quaternion_of(vectors: list[list[float]]) -> list[float] | None:
    """The rotation that takes z to a vector by the shortest way, or x and xy to two."""
    import numpy as np

    first = np.array(vectors[0]) / math.hypot(*vectors[0])
    if len(vectors) == 1:
        x, y, z = first.tolist()
        if z < 0 and x == y == 0:
            return [0.0, 1.0, 0.0, 0.0]
        return [1.0 + z, -y, x, 0.0]
    second = np.array(vectors[1])
    second = second - (second @ first) * first
    length = float(np.linalg.norm(second))
    if not length > 0:
        return None
    second = second / length
    matrix = np.array([first, second, np.cross(first, second)]).T
    return [float(x) for x in quaternion_of(matrix)]


def _closures(root: XmlElement, found: _FoundJoints) -> list[LoopClosure]:
    closures = []
    bodies = [WORLD, *(name for name, _ in found.bodies)]
    for section in root.all("equality"):
        for element in section.children:
            if element.choice("active", ("true", "false"), "true") == "false":
                continue
            if element.tag not in ("connect", "weld"):
                element.fail("is not modelled; connect and weld are: remove it, or fix its joints")
            closures.append(_closure(element, bodies, found, len(closures) + 1))
    return closures


def _closure(
    element: XmlElement, bodies: list[str], found: _FoundJoints, number: int
) -> LoopClosure:
    where = line_of(element.file, element.place, f"<{element.tag}>")
    name = element.text("name") if "name" in element.attributes else f"{element.tag} {number}"
    kind = "spherical" if element.tag == "connect" else "rigid"
    if "site1" in element.attributes or "site2" in element.attributes:
        ends, frames = [], []
        for key in ("site1", "site2"):
            site = element.text(key)
            if site not in found.sites:
                element.fail(f"{quote(site)} is no <site>{nearest(site, found.sites)}", key)
            ends.append(found.sites[site][0])
            frames.append(found.sites[site][1])
        first, second = frames
        _check_two(element, ends)
        if kind == "spherical":
            return LoopClosure(
                name, kind, tuple(ends), where, first.origin, second_point=second.origin
            )
        inverse = _inverse(second)
        return LoopClosure(
            name,
            kind,
            tuple(ends),
            where,
            first.origin,
            second_point=second.origin,
            second_frame=first.then(inverse),
        )
    ends = []
    for key in ("body1", "body2"):
        body = element.text(key) if key == "body1" or key in element.attributes else WORLD
        if body not in bodies:
            element.fail(f"{quote(body)} is no <body>{nearest(body, bodies)}", key)
        ends.append(body)
    _check_two(element, ends)
    if kind == "spherical":
        anchor = given_point(element.numbers("anchor", 3))
        return LoopClosure(name, kind, tuple(ends), where, anchor)
    pose = element.numbers("relpose", 7, "0 1 0 0 0 0 0")
    if not any(pose[3:]):
        return LoopClosure(name, kind, tuple(ends), where)
    relative = GivenFrame(given_quaternion(pose[3:]).quaternion, given_point(pose[:3]))
    inverse = _inverse(relative)
    return LoopClosure(
        name, kind, tuple(ends), where, second_point=inverse.origin, second_frame=relative
    )


def _check_two(element: XmlElement, ends: list[str]) -> None:
    if ends[0] == ends[1]:
        element.fail(f"connects {quote(ends[0])} with itself; it needs two different bodies")


def _inverse(frame: GivenFrame) -> GivenFrame:
    w, x, y, z = frame.quaternion
    return GivenFrame((w, -x, -y, -z), tuple(-x for x in frame.back(frame.origin)))
