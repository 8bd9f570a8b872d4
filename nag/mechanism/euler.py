"""Formulation E: Euler parameters of every moving body, joints by their prime components.

Tuomela 2025 (T25), sections 2 and 3; Piipponen & Tuomela 2013 (PT13), section 5. A revolute joint
with axis chi says R(a) chi_a = +-R(b) chi_b, with chi_a and chi_b the axis in the bodies' local
frames. With r = conj(a) b the sign + is chi_a r = r chi_b, the eigenspace of T25 lemma 2.1: two
equations linear in r, bilinear in (a, b). It is the component that holds at the reference
configuration.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import accumulate
from operator import mul
from string import ascii_lowercase
from typing import Any

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.exact_ranks import independent_polynomials, rank, row_echelon
from nag.algebra.number import Number, square_root
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.assembly_modes import REFERENCE, Modes, mode_rotation
from nag.mechanism.axes import Vector, across, difference, direction, dot
from nag.mechanism.configuration import (
    Arithmetic,
    Configuration,
    arithmetic_of,
    as_entries,
    configuration,
)
from nag.mechanism.graph import Joint
from nag.mechanism.lines import given_links, short_links
from nag.mechanism.loops import Loop, LoopStructure
from nag.mechanism.quaternion import Quaternion, conjugate, multiply, norm_squared, rotate

Parameters = Mapping[str, Quaternion]
Slides = Mapping[str, Sequence[Any]]


@dataclass(frozen=True)
class EulerModel:
    """A mechanism in Euler parameters, linear equations solved away.

    Attributes:
        structure: the mechanism's part with loops.
        elimination: from all Euler parameters and slides to the variables of `system`.
        system: norms, prime components of the joints and loop equations.
        reference: the reference configuration; empty in other assembly modes.
        symmetries: for each moving body whose sign a -> -a is a symmetry of `system`, the signs
            that it gives to the variables.
        modes: the assembly modes.
    """

    structure: LoopStructure
    elimination: Elimination
    system: PolynomialSystem
    reference: tuple[Number, ...]
    symmetries: tuple[tuple[int, ...], ...]
    modes: Modes = REFERENCE

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution, exact for exact points."""
        arithmetic = arithmetic_of(point)
        convert = arithmetic.convert
        entries = as_entries(point)
        values = [image(entries, convert) for image in self.elimination.images]
        structure = self.structure
        euler = {body: tuple(values[4 * i : 4 * i + 4]) for i, body in enumerate(structure.moving)}
        given = slide_variables(structure, values)
        slides = {
            joint.name: _slide(structure, joint, given[joint.name], euler, arithmetic)
            for joint in structure.joints
            if given[joint.name]
        }
        return configuration(structure, euler, arithmetic, slides)

    def project(self, placed: Configuration) -> tuple[Any, ...]:
        """The coordinates of a configuration; the signs of Euler parameters are taken as given."""
        entries = [x for body in self.structure.moving for x in placed.euler[body]]
        return project_onto(self.structure, self.elimination, placed, entries)


def euler_model(
    structure: LoopStructure, spherical: bool = False, modes: Modes = REFERENCE
) -> EulerModel:
    """The equations of a mechanism in Euler parameters.

    Args:
        structure: its part with loops.
        spherical: whether all joints turn about one point, so that loops close by themselves.
        modes: assembly modes of the joints that are not in that of the reference configuration.
    """
    full = euler_system(structure, spherical, modes)
    elimination = without_slides(full, 4 * len(structure.moving))
    system = independent_equations(elimination)
    start = [x for b in structure.moving for x in structure.mechanism.orientation(b)]
    start += [Fraction(0)] * (full.n - len(start))
    changes = sign_changes(len(structure.moving), elimination)
    symmetries = tuple(signs for signs in changes if _is_symmetry(system, signs))
    reference = () if modes else tuple(elimination.project(start))
    return EulerModel(structure, elimination, system, reference, symmetries, modes)


def estimated_euler_paths(structure: LoopStructure, spherical: bool = False) -> int:
    """What `nag.mechanism.path_estimates.estimated_paths` says of the equations, by their look.

    Bodies that slide along each other turn together. Each that turns alone has a norm, joints at
    the base leave it fewer parameters, others are bilinear; a loop's equations are quadrics, or
    cubics where a slide is carried about, less those that slides in the base's axes are solved by.

    Args:
        structure: the mechanism's part with loops.
        spherical: as for `euler_model`.
    """
    together = {body: body for body in (structure.base, *structure.moving)}
    for joint in structure.joints:
        if joint.of_type.orthogonalities == 3:
            one, other = sorted((together[b] for b in joint.bodies), key=structure.base.__ne__)
            together = {b: one if of == other else of for b, of in together.items()}
    turning = set(together.values()) - {structure.base}
    conditions: dict[str, list[tuple[Number, ...]]] = {body: [] for body in turning}
    degrees = [2] * len(turning)
    for joint in structure.joints:
        ends = {together[b] for b in joint.bodies}
        count = joint.of_type.orthogonalities
        free = ends - {structure.base}
        if len(ends) == 1 or not count:
            continue
        if count == 2 and len(free) == 1:
            conditions[free.pop()] += mode_conditions(joint, 0)
        else:
            degrees += [2] * 2 if count == 2 else [2 * len(free)]
    unknowns = sum(4 - rank(rows) for rows in conditions.values())
    carried = [
        j for j in structure.joints if together[slide_carrier(structure, j)] != structure.base
    ]
    slides = [(j, u) for j in structure.joints for u in slide_directions(j)]
    fixed = [(j, u) for j, u in slides if j not in carried]
    solved: list[tuple[Number, ...]] = []
    for loop in structure.loops if not spherical else ():
        cubic = any(j in loop.joints and j in carried for j, _ in slides)
        for i in range(3):
            row = tuple(
                u[i]
                * (1 if loop.bodies[loop.joints.index(j)] == slide_carrier(structure, j) else -1)
                if j in loop.joints
                else Fraction(0)
                for j, u in fixed
            )
            if rank([*solved, row]) > len(solved):
                solved.append(row)
            else:
                degrees.append(3 if cubic else 2)
    unknowns += len(slides) - len(solved)
    return sum(accumulate(sorted(degrees)[:unknowns], mul))


def euler_system(
    structure: LoopStructure, spherical: bool = False, modes: Modes = REFERENCE
) -> PolynomialSystem:
    """Norms, prime components and loop equations in all Euler parameters and slides."""
    names = (*parameter_names(len(structure.moving)), *slide_names(structure))
    parameters = euler_parameters(structure, len(names))
    slides = slide_variables(structure, Polynomial.variables(len(names)))
    polynomials = norms(structure, parameters)
    for joint in structure.joints:
        mode = dict(modes).get(joint.name, 0)
        polynomials += prime_component(structure, parameters, joint, mode)
    if not spherical:
        for loop in structure.loops:
            # Of a joint whose axis is turned round, its point is where both bodies meet.
            links = given_links(loop.joints) if modes else short_links(loop.joints)
            polynomials += loop_closure(structure, parameters, slides, loop, links)
    return PolynomialSystem(names, tuple(f for f in polynomials if f))


def without_slides(full: PolynomialSystem, parameters: int) -> Elimination:
    """Linear equations solved, then slides that are polynomials in the other variables.

    Such slides are no coordinates: the configuration space is their graph over the rest (PT13,
    definition 2.1). Degrees are counted in the Euler parameters and the slides that stay.
    """
    linear = eliminate_linear(full, graphs=False)
    stay = [k for k, index in enumerate(linear.kept) if index < parameters]
    graphs = eliminate_linear(linear.system, keep=stay, graphs=True)
    return Elimination(
        graphs.system,
        linear.original_variables,
        tuple(linear.kept[k] for k in graphs.kept),
        tuple(image.compose(graphs.images) for image in linear.images),
    )


def slide_names(structure: LoopStructure) -> tuple[str, ...]:
    """slide1, slide2, ... for the slides of the joints, in their order."""
    count = sum(len(slide_directions(j)) for j in structure.joints)
    return tuple(f"slide{i + 1}" for i in range(count))


def slide_variables(structure: LoopStructure, values: Sequence[Any]) -> dict[str, tuple[Any, ...]]:
    """The slides of each joint, by its name, among all Euler parameters and slides."""
    rest = list(values[4 * len(structure.moving) :])
    slides = {}
    for joint in structure.joints:
        count = len(slide_directions(joint))
        slides[joint.name], rest = tuple(rest[:count]), rest[count:]
    return slides


def _slide(
    structure: LoopStructure,
    joint: Joint,
    distances: Sequence[Any],
    euler: Mapping[str, Sequence[Any]],
    arithmetic: Arithmetic,
) -> tuple[Any, ...]:
    """The gap from the first body to the second, in the first body's reference coordinates."""
    convert = arithmetic.convert
    total = (convert(Fraction(0)),) * 3
    for distance, along in zip(distances, slide_directions(joint), strict=True):
        total = tuple(t + distance * convert(x) for t, x in zip(total, along, strict=True))
    carrier, (first, second) = slide_carrier(structure, joint), joint.bodies
    if carrier == first:
        return total
    orientation = structure.mechanism.orientation
    relative = []
    for body in (first, second):
        reference = [convert(x) for x in orientation(body)]
        placed = euler.get(body, reference)
        relative.append(multiply(placed, conjugate(reference)))
    turned = rotate(multiply(conjugate(relative[0]), relative[1]), total)
    return tuple(-x for x in turned)


def independent_equations(elimination: Elimination) -> PolynomialSystem:
    """What elimination leaves, without equations that depend linearly on the others."""
    reduced = elimination.system
    return replace(reduced, polynomials=tuple(independent_polynomials(reduced.polynomials)))


def sign_changes(bodies: int, elimination: Elimination) -> Iterator[tuple[int, ...]]:
    """The signs of the kept variables where a body's Euler parameters change theirs, body by body.

    None for bodies of which no variable is kept.
    """
    for i in range(bodies):
        signs = tuple(-1 if index // 4 == i else 1 for index in elimination.kept)
        if -1 in signs:
            yield signs


def parameter_names(bodies: int) -> tuple[str, ...]:
    """a0 to a3 for the first moving body, b0 to b3 for the second, as in T25."""
    letters = ascii_lowercase if bodies <= 26 else [f"q{i + 1}_" for i in range(bodies)]
    return tuple(f"{letter}{k}" for letter in letters[:bodies] for k in range(4))


def euler_parameters(structure: LoopStructure, n: int) -> dict[str, Quaternion]:
    """Euler parameters of every body as polynomials: variables, and constants for the base."""
    variables = Polynomial.variables(n)
    parameters: dict[str, Quaternion] = {
        body: tuple(variables[4 * i : 4 * i + 4]) for i, body in enumerate(structure.moving)
    }
    fixed = structure.mechanism.orientation(structure.base)
    parameters[structure.base] = tuple(Polynomial.constant(n, x) for x in fixed)
    return parameters


def norms(structure: LoopStructure, parameters: Parameters) -> list[Polynomial]:
    """|a|^2 - 1 for every moving body."""
    return [norm_squared(parameters[b]) - 1 for b in structure.moving]


def prime_component(
    structure: LoopStructure, parameters: Parameters, joint: Joint, mode: int = 0
) -> list[Polynomial]:
    """The equations of one prime component of a joint's SO constraints, norms left out.

    With r = conj(a) b in global coordinates of the reference configuration: r lies in the plane of
    the turns about the axis, after the mode's constant rotation (two linear equations); r is the
    constant rotation of a joint that slides only (b is linear in a); a universal joint has one
    quadric in r, a spherical joint nothing.
    """
    first, second = joint.bodies
    a, b = (_in_reference_frame(structure, parameters, body) for body in (first, second))
    constant = mode_rotation(joint, mode)
    conditions = joint.of_type.orthogonalities
    if conditions == 0:
        return []
    if conditions == 1:
        u, v = direction(joint.axis), direction(joint.second_axis)
        turned = dot(rotate(a, u), rotate(b, v))
        scale = norm_squared(a) * norm_squared(b)
        return [turned - scale * dot(u, v)]
    if conditions == 3:
        return list(difference(b, multiply(a, unit_multiple(constant))))
    relative = multiply(conjugate(a), b)
    return [dot(row, relative) for row in mode_conditions(joint, mode)]


def mode_conditions(joint: Joint, mode: int) -> list[tuple[Number, ...]]:
    """Rows whose products with the relative orientation r vanish in an assembly mode.

    Two for a turn about an axis, three for a joint that keeps orientations, none for the others.
    """
    conditions = joint.of_type.orthogonalities
    if conditions < 2:
        return []
    back = conjugate(mode_rotation(joint, mode))
    line = (Fraction(0), *direction(joint.axis))
    columns = []
    for i in range(4):
        unit = tuple(Fraction(int(i == j)) for j in range(4))
        turn = multiply(unit, back)
        if conditions == 3:
            columns.append(turn[1:])
        else:
            columns.append(difference(multiply(line, turn), multiply(turn, line)))
    return row_echelon([tuple(c[i] for c in columns) for i in range(len(columns[0]))])[0]


def unit_multiple(constant: Sequence[Number]) -> tuple[Number, ...]:
    """A quaternion of length one, with a square root where there is no rational one."""
    length = square_root(norm_squared(constant))
    return tuple(x / length for x in constant)


def slide_directions(joint: Joint) -> tuple[Vector, ...]:
    """The directions in which a joint slides."""
    gaps = joint.of_type.gaps
    if not gaps:
        return ()
    along = direction(joint.axis)
    return (along,) if gaps == 2 else across(along)


def slide_carrier(structure: LoopStructure, joint: Joint) -> str:
    """The body whose axes the slides of a joint are given in.

    It is the base, where that is one of the two and the axis keeps its direction in both, which
    makes loop equations shorter; else the first body, in which the gaps are given.
    """
    either = joint.of_type.keeps_axis and structure.base in joint.bodies
    return structure.base if either else joint.bodies[0]


def loop_closure(
    structure: LoopStructure,
    parameters: Parameters,
    slides: Slides,
    loop: Loop,
    links: Sequence[Vector],
) -> list[Polynomial]:
    """The sum of R(a_i) v_i over a loop's bodies, v_i from a body's one joint to its other.

    Slides add their distance along their direction in the body that carries them.

    Args:
        links: the vectors v_i at the reference configuration.
    """
    total: Sequence[Any] = (Fraction(0),) * 3
    for i, body in enumerate(loop.bodies):
        turned = rotate(parameters[body], _local(structure, body, links[i]))
        total = tuple(x + y for x, y in zip(turned, total, strict=True))
        joint = loop.joints[i]
        carrier = slide_carrier(structure, joint)
        # The gap leads from the body that carries it to the other one.
        sign = 1 if carrier == body else -1
        for distance, along in zip(slides[joint.name], slide_directions(joint), strict=True):
            turned = rotate(parameters[carrier], _local(structure, carrier, along))
            total = tuple(x + distance * y * sign for x, y in zip(total, turned, strict=True))
    return list(total)


def _in_reference_frame(structure: LoopStructure, parameters: Parameters, body: str) -> Quaternion:
    """Euler parameters of the frame that is the global one at the reference configuration."""
    return multiply(parameters[body], conjugate(structure.mechanism.orientation(body)))


def _local(structure: LoopStructure, body: str, vector: Sequence[Number]) -> tuple[Number, ...]:
    """A vector of the reference configuration in the local frame of ``body``."""
    return rotate(conjugate(structure.mechanism.orientation(body)), vector)


def _is_symmetry(system: PolynomialSystem, signs: Sequence[int]) -> bool:
    """Whether every polynomial is carried to itself or to its negative."""
    flipped = [i for i, s in enumerate(signs) if s < 0]
    return all(
        len({sum(e[i] for i in flipped) % 2 for e in f.terms}) == 1 for f in system.polynomials
    )


def project_onto(
    structure: LoopStructure, elimination: Elimination, placed: Configuration, turns: Sequence[Any]
) -> tuple[Any, ...]:
    """The point of a system, linear equations solved away, that a configuration is.

    Args:
        turns: the coordinates of the bodies' turns; those of slides are worked out.
    """
    entries = list(turns)
    arithmetic = arithmetic_of(entries)
    for joint in structure.joints:
        if slide_directions(joint):
            entries += _distances(structure, joint, placed, arithmetic)
    return tuple(elimination.project(entries))


def turn_from_reference(
    structure: LoopStructure, body: str, placed: Configuration, arithmetic: Arithmetic
) -> Sequence[Any]:
    """The turn of a body from the reference configuration."""
    reference = [arithmetic.convert(x) for x in structure.mechanism.orientation(body)]
    return multiply(placed.euler[body], conjugate(reference))


def _distances(
    structure: LoopStructure, joint: Joint, placed: Configuration, arithmetic: Arithmetic
) -> list[Any]:
    """How far a joint has slid along each of its directions."""
    point = [arithmetic.convert(x) for x in joint.point]
    carrier = slide_carrier(structure, joint)
    turns = {b: turn_from_reference(structure, b, placed, arithmetic) for b in joint.bodies}
    at = {
        b: [r + x for r, x in zip(placed.position[b], rotate(turns[b], point), strict=True)]
        for b in joint.bodies
    }
    gap = rotate(conjugate(turns[carrier]), difference(at[joint.other(carrier)], at[carrier]))
    directions = ([arithmetic.convert(x) for x in u] for u in slide_directions(joint))
    return [dot(gap, u) / dot(u, u) for u in directions]
