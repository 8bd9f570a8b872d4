"""Bodies that rigid joints tie together, taken as one body each.

Triangles of bodies and the like are left as they are: each of their assemblies belongs to other
components. In half-angles a planar triangle's equation factors, so that exact algebra takes it out.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from nag.mechanism.graph import Body, Joint, Mechanism


@dataclass(frozen=True)
class RigidGroups:
    """A mechanism whose rigidly tied bodies are one.

    Attributes:
        original: the mechanism as it was given.
        merged: the same without rigid joints; each group goes by the name of its first body. A
            mechanism of rigid joints only stays as it is.
        leader: that name, for every body of the original.
        idle: joints between two bodies of one group; they cannot move.
    """

    original: Mechanism
    merged: Mechanism
    leader: Mapping[str, str]
    idle: tuple[Joint, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "leader", MappingProxyType(dict(self.leader)))

    @property
    def is_one_body(self) -> bool:
        """Whether nothing is left that moves."""
        return len(set(self.leader.values())) == 1

    def __reduce__(self) -> tuple[object, ...]:
        return RigidGroups, (self.original, self.merged, dict(self.leader), self.idle)


def rigid_groups(mechanism: Mechanism, held: Collection[str] = ()) -> RigidGroups:
    """Tie the bodies of rigid joints together, and of those that are held.

    Joints are in global coordinates of the reference configuration, so that they stay as they are;
    only the names of their bodies change.

    Args:
        held: names of joints.
    """
    ties = {j.name for j in mechanism.joints if j.type == "rigid" or j.name in held}
    leader = {b: b for b in mechanism.body_names}
    order = {b: i for i, b in enumerate(mechanism.body_names)}
    for joint in mechanism.joints:
        if joint.name in ties:
            first, second = sorted((leader[b] for b in joint.bodies), key=order.__getitem__)
            leader = {b: first if name == second else name for b, name in leader.items()}
    kept, idle = [], []
    for joint in mechanism.joints:
        bodies = tuple(leader[b] for b in joint.bodies)
        if joint.name in ties:
            continue
        if bodies[0] == bodies[1]:
            idle.append(joint)
        else:
            kept.append(replace(joint, bodies=bodies))
    if len(kept) == len(mechanism.joints) or not kept:
        return RigidGroups(mechanism, mechanism, leader, tuple(idle))
    used = {b for j in kept for b in j.bodies}
    frames = tuple(Body(b, mechanism.orientation(b)) for b in mechanism.body_names if b in used)
    merged = Mechanism(leader[mechanism.ground], tuple(kept), frames)
    return RigidGroups(mechanism, merged, leader, tuple(idle))
