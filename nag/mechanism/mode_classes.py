"""Classes of assembly modes that a linear map of Euler parameters carries into each other.

Let n be orthogonal to all axes of a body's joints, and let the body's joints lie on one line along
n. Turning the body half round that line reverses the axes and leaves its link vectors as they are:
a -> a n / |n| carries the equations of one combination of modes into those of the combination in
which all these joints have changed theirs. For the fixed body the same is done to everything else.
One combination of each class is decomposed; the maps are checked on the equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import first_outside_span
from nag.errors import NagError
from nag.mechanism.assembly_modes import Modes, all_modes, number_of_modes
from nag.mechanism.axes import Vector, across, cross, difference, direction, dot, vanishes
from nag.mechanism.euler import (
    euler_parameters,
    loop_closure,
    norms,
    prime_component,
    slide_names,
    slide_variables,
)
from nag.mechanism.graph import Joint
from nag.mechanism.lines import given_links
from nag.mechanism.loops import LoopStructure
from nag.mechanism.quaternion import conjugate, multiply

# Combinations of modes beyond this number are not listed.
MOST_MODES = 2**16


@dataclass(frozen=True)
class Flip:
    """A half-turn of one body that changes the modes of its joints and nothing else.

    Attributes:
        body: the body.
        normal: direction of the line, in global coordinates of the reference configuration.
        joints: names of the joints whose mode changes.
    """

    body: str
    normal: Vector
    joints: frozenset[str]


@dataclass(frozen=True)
class ModeClass:
    """Combinations of modes that flips carry into each other.

    Attributes:
        representative: the first of them, with the fewest changed joints.
        members: all of them.
    """

    representative: Modes
    members: tuple[Modes, ...]


def mode_classes(structure: LoopStructure) -> tuple[ModeClass, ...]:
    """The classes, that of the reference configuration first.

    Every flip that is used was checked exactly on the equations in Euler parameters.

    Raises:
        ValueError: if there are too many combinations.
    """
    count = number_of_modes(structure.joints)
    if count > MOST_MODES:
        raise NagError(
            f"the joints have {count} combinations of assembly modes; at most {MOST_MODES} are "
            "decomposed"
        )
    basis: dict[str, frozenset[str]] = {}
    for flip in flips(structure):
        rest = _reduce_modulo_flips(flip.joints, basis)
        if rest and carries_modes(structure, flip):
            basis[min(rest)] = rest
    classes: dict[tuple[Modes, frozenset[str]], list[Modes]] = {}
    flippable = {j.name for j in structure.joints if _is_flippable(j)}
    for modes in sorted(all_modes(structure.joints), key=len):
        fixed = tuple((name, m) for name, m in modes if name not in flippable)
        changed = frozenset(name for name, _ in modes if name in flippable)
        classes.setdefault((fixed, _reduce_modulo_flips(changed, basis)), []).append(modes)
    return tuple(ModeClass(members[0], tuple(members)) for members in classes.values())


def _reduce_modulo_flips(names: frozenset[str], basis: dict[str, frozenset[str]]) -> frozenset[str]:
    """What is left of a set of joints, modulo those that flips change together."""
    for pivot, change in basis.items():
        if pivot in names:
            names = names ^ change
    return names


def flips(structure: LoopStructure) -> Iterator[Flip]:
    """For each body the half-turn that reverses its joints' axes, where there is one."""
    for body in (structure.base, *structure.moving):
        joints = [j for j in structure.joints if body in j.bodies]
        normal = _normal(body, joints)
        if normal is not None:
            yield Flip(body, normal, frozenset(j.name for j in joints if _is_flippable(j)))


def _is_flippable(joint: Joint) -> bool:
    """Whether a half-turn about a line through its point, across its axis, changes its mode."""
    return joint.of_type.turns_about_point and joint.of_type.modes > 1


def _normal(body: str, joints: Sequence[Joint]) -> Vector | None:
    """The direction of the line about which the body may be turned half round."""
    if not all(j.of_type.turns_about_point for j in joints):
        return None
    axes = [axis for j in joints if (axis := j.axis_in(body)) is not None]
    links = [difference(j.point, joints[0].point) for j in joints[1:]]
    link = next((v for v in links if not vanishes(v)), None)
    crossing = next((n for n in (cross(axes[0], a) for a in axes[1:]) if not vanishes(n)), None)
    if link is not None:
        normal = link
    elif crossing is not None:
        normal = crossing
    elif axes:
        normal = across(axes[0])[0]
    else:
        return None
    if not all(vanishes(cross(normal, v)) for v in links):
        return None
    return direction(normal) if all(is_zero(dot(normal, a)) for a in axes) else None


def carries_modes(structure: LoopStructure, flip: Flip) -> bool:
    """Whether the flip carries the equations of its joints' modes into each other, exactly.

    Checked from the reference modes to the changed ones and back. Each equation belongs to one
    joint or to none, so that only the equations of these joints change, and what the other joints'
    modes are does not matter.
    """
    n = 4 * len(structure.moving) + len(slide_names(structure))
    parameters = euler_parameters(structure, n)
    joints = [j for j in structure.joints if flip.body in (*j.bodies, structure.base)]
    common = [f for j in joints if j.name not in flip.joints for f in _equations(structure, j, n)]
    common += norms(structure, parameters)
    slides = slide_variables(structure, Polynomial.variables(n))
    for loop in structure.loops:
        if flip.body in loop.bodies or flip.body == structure.base:
            links = given_links(loop.joints)
            common += loop_closure(structure, parameters, slides, loop, links)
    changed = [
        [f for j in joints if j.name in flip.joints for f in _equations(structure, j, n, mode)]
        for mode in (0, 1)
    ]
    images, moved = flip_images(structure, flip, n)
    squared = dot(flip.normal, flip.normal)

    def carries(source: Sequence[Polynomial], target: Sequence[Polynomial]) -> bool:
        moved_source = [unit_image(f, images, moved, squared) for f in source]
        return first_outside_span(moved_source, target) is None

    # Equations of different groups do not help each other: each is carried within its own.
    return (
        carries(common, common)
        and carries(changed[0], changed[1])
        and carries(changed[1], changed[0])
    )


def _equations(structure: LoopStructure, joint: Joint, n: int, mode: int = 0) -> list[Polynomial]:
    return prime_component(structure, euler_parameters(structure, n), joint, mode)


def flip_images(
    structure: LoopStructure, flip: Flip, n: int
) -> tuple[list[Polynomial], tuple[int, ...]]:
    """Images of all Euler parameters, |n| times too long, and the variables that are moved."""
    images = list(Polynomial.variables(n))
    turn: Sequence[Number] = (Fraction(0), *flip.normal)
    moved: list[int] = []
    for i, body in enumerate(structure.moving):
        own = images[4 * i : 4 * i + 4]
        if flip.body == body:
            frame = structure.mechanism.orientation(body)
            local = multiply(multiply(conjugate(frame), turn), frame)
            images[4 * i : 4 * i + 4] = multiply(own, local)
        elif flip.body == structure.base:
            images[4 * i : 4 * i + 4] = multiply(conjugate(turn), own)
        else:
            continue
        moved += range(4 * i, 4 * i + 4)
    return images, tuple(moved)


def unit_image(
    f: Polynomial, images: Sequence[Polynomial], moved: Sequence[int], squared: Number
) -> Polynomial:
    """f after a substitution that is sqrt(squared) times too long in the moved variables.

    Exact where all terms have degrees of one parity in these variables, up to one common factor.
    """
    moved_set = set(moved)
    parity = (
        min((sum(k for i, k in enumerate(e) if i in moved_set) for e in f.terms), default=0) % 2
    )
    terms = {}
    for e, c in f.terms.items():
        degree = sum(k for i, k in enumerate(e) if i in moved_set)
        if (degree - parity) % 2:
            raise NagError("the equation has terms of both parities")
        terms[e] = c / squared ** ((degree - parity) // 2)
    return Polynomial(f.n, terms).compose(images)
