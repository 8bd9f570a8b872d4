"""Mechanisms with joints held at given values, or with bodies put somewhere else.

A joint that is held keeps of its factors those that are not, after a constant displacement; a body
that is held by the ground has one all of its own. Such a mechanism has no configuration that is
known: its loops are products in which the constants stand (formulation H), and its assemblies are
what is to be found. Rods between two spherical joints turn about themselves whatever is held: they
are distances (formulation S), which say nothing of that, where such equations can be made.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.number import Number, square_root
from nag.errors import MechanismError
from nag.mechanism import PLATFORM_ALONE
from nag.mechanism.axes import Space, cross, dot, space_of
from nag.mechanism.formulations import description
from nag.mechanism.given_rotation import GivenFrame, turn_about
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.half_angles import LoopClosures
from nag.mechanism.joint_factors import NOTHING, ONE, UNIT, ZERO
from nag.mechanism.loops import LoopStructure, loop_structure
from nag.mechanism.model import Model, check_loops
from nag.mechanism.path_estimates import Alternative, ModelError, path_bound
from nag.mechanism.quaternion import DualQuaternion, dual_multiply, multiply
from nag.mechanism.rods import RodModel, rod_model
from nag.text.table import count_text, join_words

# Estimated paths up to which a platform's legs are not asked for their equations: these take as
# long to be made as so many paths.
FEW_PATHS = 1_000
# By the factors of a joint: its freedoms' names, as `nag.kinematics.joint_values` has them, and
# what type of joint is left when one of them is held; None where none has that freedom alone.
_LEFT: dict[tuple[str, ...], dict[str, str | None]] = {
    ("turn",): {"angle": "rigid"},
    ("slide",): {"slide": "rigid"},
    ("turn", "slide"): {"angle": "prismatic", "slide": "revolute"},
    ("turn", "turn"): {"first": "revolute", "second": "revolute"},
    ("plane",): {"angle": None, "x": None, "y": None},
}


@dataclass(frozen=True)
class HeldMechanism:
    """A mechanism of which some joints, or bodies, are held away from where they are drawn.

    Attributes:
        mechanism: with the joints that are left.
        displacements: of joints, by name, what comes before their own freedoms: a displacement of
            the second body against the first, from where they are drawn.
        held: what is held, in words.
    """

    mechanism: Mechanism
    displacements: Mapping[str, DualQuaternion]
    held: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "displacements", fixed_mapping(self.displacements))


def hold_joint(given: HeldMechanism, joint: str, freedom: str, value: Number) -> HeldMechanism:
    """The mechanism with one freedom of a joint at a value.

    Args:
        given: the mechanism, other joints of which may be held already.
        joint: its name.
        freedom: ``"angle"``, in radians, or ``"slide"``, a length; ``"first"`` or ``"second"`` of a
            universal joint's angles. They count from where the joint is drawn.
        value: angles that are no multiples of pi/12 are rounded to 16 digits.

    Raises:
        MechanismError: if there is no such joint or freedom, or what is left is no type of joint.
    """
    own = _find_joint(given.mechanism, joint)
    left = _LEFT.get(own.of_type.factors, {})
    if own.of_type.turns_only and joint in given.displacements:
        # What is left of a universal joint, one of its angles being held.
        freedom = "angle"
    if freedom not in left:
        raise MechanismError(f"hold: joint {joint!r} has no {freedom} that can be held")
    kind = left[freedom]
    if kind is None:
        raise MechanismError(f"hold: of a {own.type} joint no freedom can be held; hold others")
    axis = own.second_axis if freedom == "second" else own.axis
    assert axis is not None
    moved = _slide(axis, value) if freedom == "slide" else _turn(own.point, axis, value)
    # What is left of a universal joint turns about one axis, seen from where the other one is.
    kept = own.second_axis if freedom == "first" else own.axis
    if freedom == "second":
        kept = GivenFrame(moved[0]).back(kept)
    if kind == "rigid":
        rest = Joint(own.name, kind, own.bodies, own.point)
    else:
        rest = Joint(own.name, kind, own.bodies, own.point, kept)
    before = given.displacements.get(joint, UNIT)
    joints = tuple(rest if j.name == joint else j for j in given.mechanism.joints)
    return HeldMechanism(
        replace(given.mechanism, joints=joints),
        {**given.displacements, joint: dual_multiply(before, moved)},
        (*given.held, joint),
    )


def tie_bodies(mechanism: Mechanism, bodies: Sequence[str]) -> Mechanism:
    """The mechanism with bodies held by the ground where they are drawn, as an arm's hand is.

    Args:
        mechanism: one that may have no loop yet.
        bodies: names; one that is tied already makes no difference.

    Raises:
        MechanismError: if there is no such body.
    """
    joints = list(mechanism.joints)
    for body in bodies:
        _check_body(mechanism, body)
        if body != mechanism.ground and _find_tie(joints, body, mechanism.ground) is None:
            name = _new_name(f"{body} held", joints)
            joints.append(Joint(name, "rigid", (mechanism.ground, body)))
    return replace(mechanism, joints=tuple(joints))


def _check_body(mechanism: Mechanism, body: str) -> None:
    names = mechanism.body_names
    if body not in names:
        raise MechanismError(f"pose: {body[:40]!r} is no body; they are {', '.join(names)}")


def place_body(given: HeldMechanism, body: str, place: GivenFrame) -> HeldMechanism:
    """The mechanism with a body held by the ground somewhere else.

    Args:
        given: the mechanism, whose ground holds the body already (`tie_bodies`).
        body: its name.
        place: where what is at x in the drawing goes, as seen from the ground.

    Raises:
        MechanismError: if there is no such body, it is the ground, or not held.
    """
    mechanism = given.mechanism
    _check_body(mechanism, body)
    if body == mechanism.ground:
        raise MechanismError(f"pose: {body!r} is the ground, which does not move")
    tie = _find_tie(mechanism.joints, body, mechanism.ground)
    if tie is None:
        raise MechanismError(f"pose: {body!r} is not held by the ground; add a rigid joint")
    name = tie.name
    others = tuple(j for j in mechanism.joints if j.name != name)
    held = Joint(name, "rigid", (mechanism.ground, body))
    origin = tuple(x / 2 for x in place.origin)
    moved = place.quaternion, multiply((ZERO, *origin), place.quaternion)
    return HeldMechanism(
        replace(mechanism, joints=(*others, held)),
        {**given.displacements, name: moved},
        (*given.held, body),
    )


def held_model(given: HeldMechanism, formulation: str = "auto") -> Model:
    """The equations of a mechanism that is held: the joints' coordinates, or a platform's poses.

    Those of its rods' distances, if it has any and nothing else needs joints' coordinates; else
    those with the fewest estimated paths. Poses are taken by themselves only where no leg moves
    while the platform stands still: each stands for finitely many configurations then.

    Args:
        given: the mechanism.
        formulation: ``"S"``, ``"H"`` or ``"P"``, as for `nag.model`, or ``"auto"``.

    Raises:
        ModelError: if it has no loop, what is held is in none, or a loop has nothing to eliminate.
    """
    mechanism = given.mechanism
    structure = loop_structure(mechanism, given.displacements)
    check_loops(mechanism, structure)
    inside = {j.name for j in structure.joints}
    for name in given.displacements:
        if name not in inside:
            raise ModelError(f"hold: joint {name!r} is in no loop: whatever it does, others do not")
    space = space_of(structure.joints)
    chosen = _choose_form(given, structure, space, formulation)
    form = chosen.form
    loops = count_text(len(structure.loops), "loop")
    unknowns = count_text(form.system.n, "unknown")
    what = "joint coordinates"
    if isinstance(form, RodModel):
        what = description(chosen, space)
    if chosen.formulation == PLATFORM_ALONE:
        what = f"poses of {form.platform.robot.platform}, its legs eliminated"
    return Model(
        mechanism=mechanism,
        formulation=chosen.formulation,
        space=space,
        reason=f"{space}, {loops}; {', '.join(given.held)} held; {what}: {unknowns}",
        system=form.system,
        reference=(),
        sign_group=1,
        symmetries=(),
        path_bound=path_bound(form.system),
        structure=structure,
        form=form,
    )


def _choose_form(
    given: HeldMechanism, structure: LoopStructure, space: Space, formulation: str
) -> Alternative:
    """The rods' distances, the equations with the fewest paths, or those that are asked for."""
    if formulation in ("auto", "S"):
        try:
            return Alternative("S", rod_model(structure, displacements=given.displacements))
        except ValueError as error:
            if formulation == "S":
                raise ModelError(f"formulation {formulation}: {error}") from None
    closures, problem = None, ""
    if formulation != PLATFORM_ALONE:
        try:
            closures = LoopClosures.of(structure, displacements=given.displacements)
        except ValueError as error:
            problem = str(error)
    paths = inf if closures is None else closures.estimated_paths(space)
    if formulation == PLATFORM_ALONE or (formulation == "auto" and paths > FEW_PATHS):
        from nag.mechanism.pose_model import pose_model

        try:
            poses = Alternative(
                PLATFORM_ALONE, pose_model(structure, displacements=given.displacements)
            )
        except ValueError as error:
            if formulation == PLATFORM_ALONE:
                raise ModelError(f"formulation {formulation}: {error}") from None
        else:
            if formulation == PLATFORM_ALONE:
                return poses
            if not poses.form.left_out and poses.paths < paths:
                return poses
    if closures is None:
        held = join_words(given.held)
        if not any(joint.of_type.freedoms for joint in structure.joints):
            raise ModelError(f"with {held} held no joint of a loop is left that moves; hold less")
        raise ModelError(f"with {held} held too little is left that moves; hold less ({problem})")
    return Alternative("H", closures.model)


def _find_joint(mechanism: Mechanism, name: str) -> Joint:
    for joint in mechanism.joints:
        if joint.name == name:
            return joint
    names = ", ".join(j.name for j in mechanism.joints)
    raise MechanismError(f"hold: {name[:40]!r} is no joint; they are {names}")


def _find_tie(joints: Sequence[Joint], body: str, ground: str) -> Joint | None:
    """The rigid joint by which the ground holds a body."""
    return next((j for j in joints if j.of_type.is_rigid and set(j.bodies) == {body, ground}), None)


def _new_name(name: str, joints: Sequence[Joint]) -> str:
    taken = {j.name for j in joints}
    while name in taken:
        name += "'"
    return name


def _turn(point: Sequence[Number], axis: Sequence[Number], angle: Number) -> DualQuaternion:
    """The turn by an angle about a line."""
    real = turn_about(axis, angle).quaternion
    return real, (ZERO, *cross(point, real[1:]))


def _slide(axis: Sequence[Number], length: Number) -> DualQuaternion:
    """The slide by a length along a direction."""
    half = length / square_root(dot(axis, axis)) / 2
    return (ONE, *NOTHING[1:]), (ZERO, *(half * x for x in axis))
