"""Robots in URDF, the Unified Robot Description Format of ROS.

Links and joints are read; masses, shapes and transmissions are left out, and so are limits,
which is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from nag.algebra.tokens import nearest, quote
from nag.errors import NagError
from nag.files.case_table import CaseError, line_of
from nag.files.robots.robot import Robot, RobotJoint, check_unique
from nag.files.robots.xml_file import XmlElement, parse_xml
from nag.mechanism.given_rotation import GivenFrame, given_axis, given_point, turns_in_order

TYPES = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "fixed": "rigid",
    "floating": "floating",
    "planar": "planar",
}
X_AXIS = "1 0 0"
# Joints of a circle that are named.
MOST_NAMED = 10


def recognise(text: str) -> bool:
    """Whether a text may be a robot in URDF."""
    return text.lstrip().startswith("<") and "<robot" in text


def read(file: str, text: str) -> Robot:
    """The robot that a file describes.

    Raises:
        CaseError: if it makes no sense; one line says where, and what would be right.
    """
    root = parse_xml(file, text)
    if root.tag != "robot":
        root.fail("is no robot in URDF; its outermost element is <robot>")
    links = {link.text("name"): link for link in root.all("link")}
    check_unique([(e.text("name"), line_of(file, e.place)) for e in root.all("link")], "link")
    elements = root.all("joint")
    if not elements:
        root.fail("has no <joint>; a mechanism has at least one")
    check_unique([(e.text("name"), line_of(file, e.place)) for e in elements], "joint")
    joints = [_joint(element, links) for element in elements]
    children: dict[str, XmlElement] = {}
    for joint, element in zip(joints, elements, strict=True):
        if joint.child in children:
            element.fail(
                f"{quote(joint.child)} is the child of a joint already "
                f'({children[joint.child].place}); a case of kind "robot" closes loops'
            )
        children[joint.child] = element
    roots = [name for name in links if name not in children]
    if len(roots) != 1:
        said = ", ".join(roots[:5]) if roots else "none: every link is a child"
        root.fail(f"one link is the child of no joint, the root; here that is {said}")
    title = root.attributes.get("name", "").strip()
    title = title if title and title.isprintable() else "a robot"
    return Robot(title, roots[0], tuple(_order_joints(file, roots[0], joints)))


def _joint(element: XmlElement, links: dict[str, XmlElement]) -> RobotJoint:
    name, kind = element.text("name"), element.text("type")
    if kind not in TYPES:
        element.fail(
            f"{quote(kind)} is unknown{nearest(kind, TYPES)}; write one of {', '.join(TYPES)}",
            "type",
        )
    mimic = element.one("mimic")
    if mimic is not None:
        mimic.fail(
            f"joint {quote(name)} copies another one; gears are not modelled: remove <mimic>, or "
            "make the joint fixed"
        )
    ends = []
    for tag in ("parent", "child"):
        end = element.one(tag)
        if end is None:
            element.fail(f'has no <{tag}>; write <{tag} link="..."/>')
        link = end.text("link")
        if link not in links:
            end.fail(f"{quote(link)} is no <link>{nearest(link, links)}", "link")
        ends.append(link)
    origin, axis = element.one("origin"), None
    place, taken = GivenFrame(), ()
    if origin is not None:
        rpy = origin.numbers("rpy", 3, "0 0 0")
        try:
            turn = turns_in_order(rpy, "XYZ")
        except NagError as error:
            origin.fail(str(error), "rpy")
        place = GivenFrame(turn.quaternion, given_point(origin.numbers("xyz", 3, "0 0 0")))
        taken = turn.taken
    if TYPES[kind] in ("revolute", "prismatic", "planar"):
        given = element.one("axis")
        axis = (Fraction(1), Fraction(0), Fraction(0))
        if given is not None:
            try:
                axis = given_axis(given.numbers("xyz", 3, X_AXIS))
            except CaseError:
                raise
            except NagError as error:
                given.fail(str(error), "xyz")
    where = line_of(element.file, element.place)
    # A continuous joint may have a <limit> of its speed alone.
    limited = kind in ("revolute", "prismatic") and bool(element.all("limit"))
    return RobotJoint(name, TYPES[kind], *ends, place, where, axis, taken=taken, limited=limited)


def _order_joints(file: str, root: str, joints: list[RobotJoint]) -> list[RobotJoint]:
    """The joints from the root on."""
    by_parent: dict[str, list[RobotJoint]] = {}
    for joint in joints:
        by_parent.setdefault(joint.parent, []).append(joint)
    found, front = [], [root]
    while front:
        here = by_parent.pop(front.pop(0), [])
        found += here
        front += [joint.child for joint in here]
    if by_parent:
        circle = _circle(joints, next(iter(by_parent.values()))[0])
        last = max(circle, key=joints.index)
        after = circle.index(last) + 1
        circle = [*circle[after:], *circle[:after]]
        names = ", ".join(quote(joint.name) for joint in circle[:MOST_NAMED])
        names += ", .." if len(circle) > MOST_NAMED else ""
        ways = "goes" if len(circle) == 1 else "go"
        raise CaseError(
            line_of(
                last.where,
                f"joint {quote(last.name)}: its child {quote(last.child)} is above it: {names} "
                f"{ways} round in a circle, not on the root {quote(root)}; name another "
                'child (a case of kind "robot" closes loops)',
            )
        )
    return found


def _circle(joints: Sequence[RobotJoint], stray: RobotJoint) -> list[RobotJoint]:
    """The joints of the circle above one that does not hang on the root, parents first."""
    above = {joint.child: joint for joint in joints}
    way = [stray]
    while (parent := above[way[-1].parent]) not in way:
        way.append(parent)
    return way[way.index(parent) :][::-1]
