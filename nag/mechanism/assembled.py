"""Parts at one of their assemblies, as a mechanism: bodies and joints where they are there.

The links of a planar linkage are bodies, the bars of a framework in the plane, and the links of a
table between open joints, each under the name that a motion gives it; where more than two of them
share a pin each is joined to the first. Places are doubles: what rests on them is numerical.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from nag.errors import MechanismError
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.dh import DHEulerModel, TableModel
from nag.mechanism.framework_model import FrameworkModel
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.joint_factors import UNIT
from nag.mechanism.linkage import LinkageModel
from nag.mechanism.quaternion import (
    conjugate,
    dual_multiply,
    multiply,
    norm_squared,
    rotate,
    translation,
)

PLANE = 2
UP = (0, 0, 1)


def bodies_of(parts: AssemblyModel) -> tuple[str, ...]:
    """The names of the bodies that parts are made of, the ground among them.

    Raises:
        MechanismError: if they have none.
    """
    if isinstance(parts, LinkageModel):
        return tuple(link.name for link in parts.linkage.links)
    if isinstance(parts, TableModel):
        return tuple(f"link{i + 1}" for i in parts.loop.open)
    if isinstance(parts, FrameworkModel) and parts.framework.dimension == PLANE:
        return tuple(map("-".join, parts.framework.bars))
    raise MechanismError(
        "of: a framework in space has points and bars, which may turn about themselves, and no "
        "bodies; leave it out"
    )


def assemble_parts(parts: AssemblyModel, point: Sequence[Any] | None) -> Mechanism:
    """The mechanism that parts make at a real assembly.

    Args:
        point: in the variables of their equations; None for the placement of a framework.

    Raises:
        MechanismError: if parts have no bodies, or two joints of the same two are at one place.
    """
    names = bodies_of(parts)
    if isinstance(parts, LinkageModel):
        pins = [link.pins for link in parts.linkage.links]
        return _of_plates(names, pins, parts.pin_places(point or ()), parts.linkage.ground)
    if isinstance(parts, FrameworkModel):
        framework = parts.framework
        places: Mapping[str, Sequence[Any]]
        if point is None:
            places = dict(zip(framework.points, framework.placement or (), strict=True))
        else:
            places = parts.real_places([complex(float(x)) for x in point])
        held = set(parts.pinned)
        ground = next("-".join(bar) for bar in framework.bars if set(bar) <= held)
        return _of_plates(names, framework.bars, places, ground)
    return _of_table(names, parts, [float(x) for x in point or ()])


def _of_plates(
    names: Sequence[str],
    pins: Sequence[Sequence[str]],
    places: Mapping[str, Sequence[Any]],
    ground: str,
) -> Mechanism:
    """Plates in the plane that share pins."""
    joints = []
    for pin, (x, y) in places.items():
        first, *others = [n for n, own in zip(names, pins, strict=True) if pin in own]
        for other in others:
            name = pin if len(others) == 1 else f"{pin}:{other}"
            joints.append(Joint(name, "revolute", (first, other), (x, y, 0), UP))
    return Mechanism(ground, tuple(joints))


def _of_table(names: Sequence[str], parts: Any, point: Sequence[float]) -> Mechanism:
    """A closed table, in the frame of its last link, the ground."""
    turns = _turns(parts, point)
    total, joints = UNIT, []
    for i, (number, (c, s)) in enumerate(zip(parts.loop.open, turns, strict=True)):
        link = _round_to_unit(parts.loop.links[i - 1])
        total = _round_to_unit(dual_multiply(total, link))
        moved, size = translation(total)
        axis = [float(x) / float(size) for x in rotate(total[0], UP)]
        at = [float(x) / float(size) for x in moved]
        bodies = names[i - 1], names[i]
        joints.append(Joint(parts.loop.rows[number].name, "revolute", bodies, at, axis))
        total = _round_to_unit(dual_multiply(total, ((c, 0.0, 0.0, s), (0.0, 0.0, 0.0, 0.0))))
    return Mechanism(names[-1], tuple(joints))


def _round_to_unit(given: Any) -> Any:
    """A dual quaternion of norm 1 in doubles."""
    size = float(norm_squared([float(x) for x in given[0]])) ** 0.5
    return tuple(tuple(float(x) / size for x in part) for part in given)


def _turns(parts: Any, point: Sequence[float]) -> list[tuple[float, float]]:
    """Cosine and sine of half the angle of each open joint, up to scale."""
    names = [parts.loop.rows[i].name for i in parts.loop.open]
    if not isinstance(parts, DHEulerModel):
        angles = parts.turns(point, float)
        return [angles[name] for name in names]
    flat = [float(x) for x in parts.elimination.lift(point)]
    bodies = [flat[4 * i : 4 * i + 4] for i in range(len(names) - 1)] + [[1.0, 0.0, 0.0, 0.0]]
    found = []
    for i, body in enumerate(bodies):
        link = [float(x) for x in parts.links[i - 1][0]]
        turn = multiply(conjugate(multiply(bodies[i - 1], link)), body)
        found.append((turn[0], turn[3]))
    return found
