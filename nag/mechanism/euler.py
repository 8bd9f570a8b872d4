"""Formulation E: Euler parameters of every moving body, joints by their prime components.

Tuomela 2025 (T25), sections 2 and 3; Piipponen & Tuomela 2013 (PT13), section 5. A revolute joint
with axis chi says R(a) chi_a = +-R(b) chi_b, with chi_a and chi_b the axis in the bodies' local
frames. With r = conj(a) b the sign + is chi_a r = r chi_b, the eigenspace of T25 lemma 2.1: two
equations linear in r, bilinear in (a, b). It is the component that holds at the reference
configuration.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from string import ascii_lowercase
from typing import Any

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.axes import cross, difference, direction, dot, vanishes
from nag.mechanism.configuration import Configuration, arithmetic_of, as_entries, configuration
from nag.mechanism.graph import Joint
from nag.mechanism.loops import Loop, LoopStructure
from nag.mechanism.quaternion import Quaternion, conjugate, multiply, norm_squared, rotate
from nag.mechanism.row_reduction import independent_polynomials, row_echelon

Parameters = Mapping[str, Quaternion]


@dataclass(frozen=True)
class EulerModel:
    """A mechanism in Euler parameters, linear equations solved away.

    Attributes:
        structure: the mechanism's part with loops.
        elimination: from all Euler parameters to those of `system`.
        system: norms, prime components of the joints and loop equations.
        reference: the reference configuration.
        symmetries: for each moving body whose sign a -> -a is a symmetry of `system`, the signs
            that it gives to the variables.
    """

    structure: LoopStructure
    elimination: Elimination
    system: PolynomialSystem
    reference: tuple[Number, ...]
    symmetries: tuple[tuple[int, ...], ...]

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution, exact for exact points."""
        arithmetic = arithmetic_of(point)
        entries = as_entries(point)
        values = [image(entries, arithmetic.convert) for image in self.elimination.images]
        euler = {
            body: tuple(values[4 * i : 4 * i + 4]) for i, body in enumerate(self.structure.moving)
        }
        return configuration(self.structure, euler, arithmetic)


def euler_model(structure: LoopStructure, spherical: bool = False) -> EulerModel:
    """The equations of a mechanism in Euler parameters.

    Args:
        structure: its part with loops.
        spherical: whether all axes pass through one point, so that loops close by themselves.
    """
    parameters = euler_parameters(structure)
    polynomials = norms(structure, parameters)
    for joint in structure.joints:
        polynomials += prime_component(structure, parameters, joint)
    if not spherical:
        for loop in structure.loops:
            polynomials += loop_closure(structure, parameters, loop)
    names = variable_names(structure)
    full = PolynomialSystem(names, tuple(f for f in polynomials if f))
    elimination = eliminate_linear(full, graphs=False)
    reduced = elimination.system
    system = PolynomialSystem(
        reduced.variables, tuple(independent_polynomials(reduced.polynomials)), reduced.nonzero
    )
    start = [x for b in structure.moving for x in structure.mechanism.orientation(b)]
    symmetries = []
    for i in range(len(structure.moving)):
        signs = tuple(-1 if index // 4 == i else 1 for index in elimination.kept)
        if -1 in signs and _is_symmetry(system, signs):
            symmetries.append(signs)
    return EulerModel(
        structure, elimination, system, tuple(elimination.project(start)), tuple(symmetries)
    )


def unreduced_system(structure: LoopStructure) -> PolynomialSystem:
    """Every constraint in all Euler parameters of all moving bodies, nothing eliminated.

    Norms, the orthogonality constraints of PT13 table 1 (quartics), the prime components of the
    joints, and the loop equations.
    """
    parameters = euler_parameters(structure)
    polynomials = norms(structure, parameters)
    for joint in structure.joints:
        polynomials += orthogonality(structure, parameters, joint)
        polynomials += prime_component(structure, parameters, joint)
    for loop in structure.loops:
        polynomials += loop_closure(structure, parameters, loop)
    return PolynomialSystem(variable_names(structure), tuple(f for f in polynomials if f))


def unreduced_point(structure: LoopStructure, placed: Configuration) -> tuple[Any, ...]:
    """The point of `unreduced_system` that a configuration is."""
    return tuple(x for body in structure.moving for x in placed.euler[body])


def variable_names(structure: LoopStructure) -> tuple[str, ...]:
    """a0 to a3 for the first moving body, b0 to b3 for the second, as in T25."""
    bodies = len(structure.moving)
    letters = ascii_lowercase if bodies <= 26 else [f"q{i + 1}_" for i in range(bodies)]
    return tuple(f"{letter}{k}" for letter in letters[:bodies] for k in range(4))


def euler_parameters(structure: LoopStructure) -> dict[str, Quaternion]:
    """Euler parameters of every body as polynomials: variables, and constants for the base."""
    n = 4 * len(structure.moving)
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
    structure: LoopStructure, parameters: Parameters, joint: Joint
) -> list[Polynomial]:
    """The two equations of a revolute joint's component at the reference configuration."""
    first, second = joint.bodies
    relative = multiply(conjugate(parameters[first]), parameters[second])
    zero = Fraction(0)
    left = (zero, *_local(structure, first, direction(joint.axis)))
    right = (zero, *_local(structure, second, direction(joint.axis)))
    columns = []
    for i in range(4):
        unit = tuple(Fraction(int(i == j)) for j in range(4))
        columns.append(difference(multiply(left, unit), multiply(unit, right)))
    rows, _ = row_echelon([tuple(c[i] for c in columns) for i in range(4)])
    return [dot(row, relative) for row in rows]


def orthogonality(
    structure: LoopStructure, parameters: Parameters, joint: Joint
) -> list[Polynomial]:
    """<R(a) eta, R(b) chi> and <R(a) xi, R(b) chi>, with eta and xi across the axis (T25 eq. 7)."""
    first, second = joint.bodies
    axis = direction(joint.axis)
    across = []
    for i in range(3):
        candidate = cross(axis, tuple(Fraction(int(i == j)) for j in range(3)))
        if not vanishes(candidate) and all(not vanishes(cross(candidate, v)) for v in across):
            across.append(candidate)
    turned = rotate(parameters[second], _local(structure, second, axis))
    return [dot(rotate(parameters[first], _local(structure, first, v)), turned) for v in across[:2]]


def loop_closure(structure: LoopStructure, parameters: Parameters, loop: Loop) -> list[Polynomial]:
    """The sum of R(a_i) v_i over a loop's bodies, v_i from a body's one joint to its other."""
    total: Sequence[Any] = (Fraction(0),) * 3
    for i, body in enumerate(loop.bodies):
        link = difference(loop.joints[i].point, loop.joints[i - 1].point)
        turned = rotate(parameters[body], _local(structure, body, link))
        total = tuple(x + y for x, y in zip(turned, total, strict=True))
    return list(total)


def _local(structure: LoopStructure, body: str, vector: Sequence[Number]) -> tuple[Number, ...]:
    """A vector of the reference configuration in the local frame of ``body``."""
    return rotate(conjugate(structure.mechanism.orientation(body)), vector)


def _is_symmetry(system: PolynomialSystem, signs: Sequence[int]) -> bool:
    """Whether every polynomial is carried to itself or to its negative."""
    flipped = [i for i, s in enumerate(signs) if s < 0]
    return all(
        len({sum(e[i] for i in flipped) % 2 for e in f.terms}) == 1 for f in system.polynomials
    )
