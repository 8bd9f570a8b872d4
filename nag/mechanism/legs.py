"""The legs of a parallel robot: what joins its platform with the ground, apart from each other.

Without the ground and the platform a robot falls into pieces. A piece that has joints with both is
a leg; so is a joint between the two. What hangs on either of them alone moves by itself and says
nothing of the platform, and neither do trees that hang on a leg.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from nag.algebra.fixed_mapping import fixed_mapping
from nag.errors import MechanismError
from nag.mechanism.graph import Joint, Mechanism, check_mechanism, connected_to
from nag.mechanism.loop_product import Element, joint_elements, opposite
from nag.mechanism.loops import rigid_groups
from nag.mechanism.quaternion import DualQuaternion
from nag.text.table import join_words

# Legs of a body that is taken for the platform without being named.
LEGS_OF_A_PLATFORM = 3
NAMED_PLATFORM = "name the platform"


@dataclass(frozen=True)
class Leg:
    """Joints between the ground and the platform.

    Attributes:
        joints: all of them, those of a serial chain from the ground on.
        bodies: of a serial chain, from the ground to the platform, one more than there are joints;
            empty where the leg has loops of its own.
        displacements: of joints that are held elsewhere, as `half_angles.LoopClosures.of` takes
            them.
    """

    joints: tuple[Joint, ...]
    bodies: tuple[str, ...]
    displacements: Mapping[str, DualQuaternion] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "displacements", fixed_mapping(self.displacements))

    @property
    def is_serial(self) -> bool:
        """Whether it is a chain without loops of its own."""
        return bool(self.bodies)

    @property
    def name(self) -> str:
        """Its joints' names."""
        return "-".join(j.name for j in self.joints)

    @property
    def letters(self) -> str:
        """Its joints' types, as ``RPS``."""
        return "".join(j.of_type.letter for j in self.joints)

    @property
    def freedoms(self) -> int:
        """Of its joints, in space."""
        return sum(j.of_type.freedoms for j in self.joints)

    def elements(self) -> tuple[Element, ...]:
        """The factors of the platform's displacement, of a serial chain."""
        return tuple(e for own in self.elements_by_joint() for e in own)

    def elements_by_joint(self) -> list[tuple[Element, ...]]:
        """The same, those of each joint by themselves."""
        return [
            own if joint.bodies[0] == body else tuple(opposite(own))
            for joint, body in zip(self.joints, self.bodies, strict=False)
            for own in [self.elements_of(joint)]
        ]

    def elements_of(self, joint: Joint) -> tuple[Element, ...]:
        """The elements of a joint, its second body against the first."""
        own = joint_elements(joint, 0, True)
        before = self.displacements.get(joint.name)
        return own if before is None else (Element(None, (before,)), *own)


@dataclass(frozen=True)
class ParallelRobot:
    """A platform and its legs.

    Attributes:
        mechanism: with bodies that are tied rigidly as one.
        ground, platform: names of bodies of it.
        legs: in the order of their first joints.
        aside: joints of no leg: each moves on the ground, the platform or a leg by itself, or with
            others of these.
    """

    mechanism: Mechanism
    ground: str
    platform: str
    legs: tuple[Leg, ...]
    aside: tuple[Joint, ...]


def parallel_robot(
    mechanism: Mechanism,
    platform: str | None = None,
    displacements: Mapping[str, DualQuaternion] = MappingProxyType({}),
) -> ParallelRobot:
    """The platform of a mechanism and its legs.

    Args:
        platform: name of the body; by default the one of the most legs, three at least.
        displacements: of joints that are held elsewhere, as `half_angles.LoopClosures.of` takes
            them.

    Raises:
        MechanismError: if it is no body, the ground or tied to it, or hangs on a single leg, or if
            none is named and there is not one such body.
    """
    check_mechanism(mechanism)
    groups = rigid_groups(mechanism, displaced=tuple(displacements))
    if groups.is_one_body:
        raise MechanismError("all bodies are tied together by rigid joints: nothing moves")
    merged = groups.merged
    if platform is None:
        platform = _platform_of(merged)
    elif platform not in mechanism.body_names:
        raise MechanismError(
            f"platform {platform!r} is no body; the bodies are {', '.join(mechanism.body_names)}"
        )
    elif groups.leader[platform] == merged.ground:
        raise MechanismError(f"platform {platform!r} is the ground, or tied to it; name another")
    else:
        platform = groups.leader[platform]
    legs = tuple(
        replace(
            leg,
            displacements={
                j.name: displacements[j.name] for j in leg.joints if j.name in displacements
            },
        )
        for leg in _legs(merged, platform)
    )
    if len(legs) < 2:
        count = "one leg" if legs else "no leg"
        raise MechanismError(
            f"platform {platform!r} has {count}; a parallel robot has two at least between the "
            f"ground and its platform"
        )
    used = {j.name for leg in legs for j in leg.joints}
    aside = tuple(j for j in merged.joints if j.name not in used)
    return ParallelRobot(merged, merged.ground, platform, legs, aside)


def is_parallel_robot(mechanism: Mechanism) -> bool:
    """Whether all joints of a mechanism are those of the legs of one platform."""
    try:
        robot = parallel_robot(mechanism)
    except MechanismError:
        return False
    return not robot.aside


def _platform_of(mechanism: Mechanism) -> str:
    """The body of the most legs."""
    joints = Counter(b for j in mechanism.joints for b in j.bodies)
    counts = {
        b: len(_legs(mechanism, b))
        for b in mechanism.body_names
        if b != mechanism.ground and joints[b] >= LEGS_OF_A_PLATFORM
    }
    most = max(counts.values(), default=0)
    best = [b for b, count in counts.items() if count == most]
    if most < LEGS_OF_A_PLATFORM:
        raise MechanismError(
            f"no body has {LEGS_OF_A_PLATFORM} legs or more between itself and the ground; "
            f"{NAMED_PLATFORM}"
        ).mended_by("platform")
    if len(best) > 1:
        said = f"bodies {join_words(best)} have {most} legs each; {NAMED_PLATFORM}"
        raise MechanismError(said).mended_by("platform")
    return best[0]


def _legs(mechanism: Mechanism, platform: str) -> tuple[Leg, ...]:
    """What joins the ground with a body."""
    ends = {mechanism.ground, platform}
    inner = [j for j in mechanism.joints if ends.isdisjoint(j.bodies)]
    left = [b for b in mechanism.body_names if b not in ends]
    pieces: list[list[Joint]] = [[j] for j in mechanism.joints if set(j.bodies) == ends]
    while left:
        piece = connected_to(left[0], (j.bodies for j in inner))
        left = [b for b in left if b not in piece]
        pieces.append([j for j in mechanism.joints if not piece.isdisjoint(j.bodies)])
    order = {j.name: i for i, j in enumerate(mechanism.joints)}
    found = []
    for piece_joints in pieces:
        joints = _without_trees(piece_joints, ends)
        if joints:
            found.append(_leg(joints, mechanism.ground, platform))
    return tuple(sorted(found, key=lambda leg: min(order[j.name] for j in leg.joints)))


def _without_trees(joints: Sequence[Joint], ends: set[str]) -> list[Joint]:
    """The joints between the ends, without those that lead nowhere; none if one is not reached."""
    kept = list(joints)
    while True:
        degrees = Counter(b for j in kept for b in j.bodies)
        inner = [j for j in kept if all(b in ends or degrees[b] > 1 for b in j.bodies)]
        if len(inner) == len(kept):
            return kept if all(degrees[b] for b in ends) else []
        kept = inner


def _leg(joints: Sequence[Joint], ground: str, platform: str) -> Leg:
    degrees = Counter(b for j in joints for b in j.bodies)
    inner = [count for b, count in degrees.items() if b not in (ground, platform)]
    if degrees[ground] > 1 or degrees[platform] > 1 or any(count > 2 for count in inner):
        return Leg(tuple(joints), ())
    chain, bodies, left = [], [ground], list(joints)
    while left:
        joint = next(j for j in left if bodies[-1] in j.bodies)
        left.remove(joint)
        chain.append(joint)
        bodies.append(joint.other(bodies[-1]))
    return Leg(tuple(chain), tuple(bodies))
