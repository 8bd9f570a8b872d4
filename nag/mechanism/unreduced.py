"""The unreduced model: every constraint of every joint, in all Euler parameters and positions.

Piipponen & Tuomela 2013 (PT13), table 1 and eqs. 4 to 6. Nothing is eliminated and no assembly mode
is chosen, so every reduced model's configurations must satisfy it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.axes import Vector, across, cross, difference, direction, dot
from nag.mechanism.configuration import Configuration
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.quaternion import Quaternion, conjugate, norm_squared, rotate


@dataclass(frozen=True)
class Placement:
    """Where a body is, and its orientation at the reference configuration.

    Attributes:
        euler: Euler parameters.
        position: of the point that is at the global origin in the reference configuration.
        reference: Euler parameters at the reference configuration.
    """

    euler: Quaternion
    position: Sequence[Any]
    reference: Sequence[Number]

    def turn_vector(self, vector: Sequence[Number]) -> Vector:
        """R chi, for a vector given in the reference configuration."""
        return rotate(self.euler, rotate(conjugate(self.reference), vector))

    def move_point(self, point: Sequence[Number]) -> Vector:
        """r + R chi, for a point given in the reference configuration."""
        return tuple(r + x for r, x in zip(self.position, self.turn_vector(point), strict=True))


def coincidence(first: Placement, second: Placement, point: Sequence[Number]) -> list[Any]:
    """The C constraint: one point of both bodies (PT13 eq. 4)."""
    return list(difference(second.move_point(point), first.move_point(point)))


def orthogonality(
    first: Placement, second: Placement, u: Sequence[Number], v: Sequence[Number]
) -> Any:
    """The SO constraint <R_a u, R_b v> = <u, v>, zero for orthogonal vectors (PT13 eq. 5)."""
    return dot(first.turn_vector(u), second.turn_vector(v)) - dot(u, v)


def gap(first: Placement, second: Placement, u: Sequence[Number], point: Sequence[Number]) -> Any:
    """The O constraint: no gap along a vector of the first body (PT13 eq. 6)."""
    return dot(first.turn_vector(u), difference(second.move_point(point), first.move_point(point)))


def joint_constraints(joint: Joint, first: Placement, second: Placement) -> list[Any]:
    """The constraints of PT13 table 1, zero in an assembled configuration."""
    asked = joint.of_type
    axis = direction((Fraction(0), Fraction(0), Fraction(1)) if joint.axis is None else joint.axis)
    e2, e3 = across(axis)
    values: list[Any] = []
    if asked.coincidences:
        values += coincidence(first, second, joint.point)
    if asked.orthogonalities == 1:
        values.append(orthogonality(first, second, axis, direction(joint.second_axis)))
    if asked.orthogonalities >= 2:
        values += [orthogonality(first, second, e, axis) for e in (e2, e3)]
    if asked.orthogonalities == 3:
        values.append(orthogonality(first, second, e2, cross(axis, e2)))
    if asked.gaps:
        along = (e2, e3) if asked.gaps == 2 else (axis,)
        values += [gap(first, second, e, joint.point) for e in along]
    return values


def unreduced_system(mechanism: Mechanism) -> PolynomialSystem:
    """Norms and joint constraints in the Euler parameters and positions of all moving bodies."""
    moving = mechanism.body_names[1:]
    n = 7 * len(moving)
    variables = Polynomial.variables(n)
    placements = {
        mechanism.ground: Placement(
            tuple(Polynomial.constant(n, x) for x in mechanism.orientation(mechanism.ground)),
            (Polynomial(n, {}),) * 3,
            mechanism.orientation(mechanism.ground),
        )
    }
    for i, body in enumerate(moving):
        own = variables[7 * i : 7 * i + 7]
        placements[body] = Placement(own[:4], own[4:], mechanism.orientation(body))
    polynomials = [norm_squared(placements[b].euler) - 1 for b in moving]
    for joint in mechanism.joints:
        polynomials += joint_constraints(joint, *(placements[b] for b in joint.bodies))
    return PolynomialSystem(unreduced_names(len(moving)), tuple(f for f in polynomials if f))


def unreduced_names(moving: int) -> tuple[str, ...]:
    """q1_0 to q1_3 and r1_1 to r1_3 for the first moving body, and so on."""
    return tuple(
        name
        for i in range(1, moving + 1)
        for name in (*(f"q{i}_{k}" for k in range(4)), *(f"r{i}_{k}" for k in range(1, 4)))
    )


def unreduced_point(mechanism: Mechanism, placed: Configuration) -> tuple[Any, ...]:
    """The point of `unreduced_system` that a configuration is."""
    return tuple(
        x for b in mechanism.body_names[1:] for x in (*placed.euler[b], *placed.position[b])
    )


def placements(mechanism: Mechanism, placed: Configuration) -> Mapping[str, Placement]:
    """Every body of a configuration, for the constraints above."""
    return {
        b: Placement(placed.euler[b], placed.position[b], mechanism.orientation(b))
        for b in mechanism.body_names
    }
