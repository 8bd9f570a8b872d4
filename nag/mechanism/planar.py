"""Planar mechanisms: formulation E with one pair (c, s) for each moving body.

All axes are parallel to a vector n of squared length N. In the frame e, n x e of the plane, not
orthonormal unless N = 1, a turn takes x e + y (n x e) to (c x - N s y) e + (s x + c y) (n x e)
with c^2 + N s^2 = 1, so no square root is needed (PT13 section 5.3 has N = 1).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.elimination import Elimination
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import looped_turns
from nag.mechanism.axes import (
    Vector,
    cross,
    direction,
    dot,
    planar_normal,
    vanishes,
)
from nag.mechanism.configuration import (
    Arithmetic,
    Configuration,
    arithmetic_of,
    as_entries,
    configuration,
)
from nag.mechanism.euler import (
    independent_equations,
    project_onto,
    slide_carrier,
    slide_names,
    turn_from_reference,
    without_slides,
)
from nag.mechanism.graph import Joint
from nag.mechanism.lines import short_links
from nag.mechanism.loops import LoopStructure
from nag.mechanism.quaternion import Quaternion, multiply

Turn = tuple[Any, Any]


@dataclass(frozen=True)
class PlanarModel:
    """A planar mechanism in (c, s) for each moving body, linear equations solved away.

    Prismatic joints have a slide each; those that are polynomials in the other variables are
    eliminated as well. Several loops without slides are left as they are, for paths that are
    tracked in isotropic coordinates (`nag.decomposition.toric_section`).

    Attributes:
        structure: the mechanism's part with loops.
        normal: the common direction of the axes.
        offsets: the turn of each body's local frame at the reference configuration.
        elimination: from all (c, s) to the variables of `system`.
        system: norms and loop equations.
        reference: the reference configuration.
    """

    structure: LoopStructure
    normal: Vector
    offsets: dict[str, Turn]
    elimination: Elimination
    system: PolynomialSystem
    reference: tuple[Number, ...]

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution.

        Exact for exact points, with square roots where half-angles need them.
        """
        arithmetic = arithmetic_of(point)
        convert = arithmetic.convert
        entries = as_entries(point)
        values = [image(entries, convert) for image in self.elimination.images]
        squared = convert(dot(self.normal, self.normal))
        mechanism = self.structure.mechanism
        euler = {}
        for i, body in enumerate(self.structure.moving):
            offset = tuple(convert(x) for x in self.offsets[body])
            turn = _compose((values[2 * i], values[2 * i + 1]), (offset[0], -offset[1]), squared)
            half = _half_turn(turn, self.normal, squared, arithmetic)
            euler[body] = multiply(half, [convert(x) for x in mechanism.orientation(body)])
        slides = {}
        distances = values[2 * len(self.structure.moving) :]
        for joint, distance in zip(_sliding_joints(self.structure), distances, strict=True):
            # Turning is the same for both bodies, so either may carry the slide.
            sign = 1 if slide_carrier(self.structure, joint) == joint.bodies[0] else -1
            slides[joint.name] = tuple(convert(x) * distance * sign for x in direction(joint.axis))
        return configuration(self.structure, euler, arithmetic, slides)

    def project(self, placed: Configuration) -> tuple[Any, ...]:
        """The coordinates of a configuration; (c, s) know no signs of Euler parameters."""
        moving = self.structure.moving
        arithmetic = arithmetic_of([x for body in moving for x in placed.euler[body]])
        turns = [x for body in moving for x in self._turn(body, placed, arithmetic)]
        return project_onto(self.structure, self.elimination, placed, turns)

    def _turn(self, body: str, placed: Configuration, arithmetic: Arithmetic) -> Turn:
        normal = [arithmetic.convert(x) for x in self.normal]
        squared = dot(normal, normal)
        half = turn_from_reference(self.structure, body, placed, arithmetic)
        s = dot(half[1:], normal) / squared
        turn = half[0] * half[0] - squared * (s * s), 2 * half[0] * s
        return _compose(turn, tuple(arithmetic.convert(x) for x in self.offsets[body]), squared)


def planar_model(structure: LoopStructure) -> PlanarModel:
    """The equations of a planar mechanism.

    (c, s) is the turn of a body's local frame where the frame itself lies in the plane of motion,
    else the turn from the reference configuration.
    """
    normal = planar_normal(structure.joints)
    squared = dot(normal, normal)
    frame = _frame(normal)
    names = tuple(f"{t}{i + 1}" for i in range(len(structure.moving)) for t in "cs")
    parameters = len(names)
    names += slide_names(structure)
    n = len(names)
    variables = Polynomial.variables(n)
    mechanism = structure.mechanism
    offsets = {
        b: _offset(mechanism.orientation(b), normal) for b in (structure.base, *structure.moving)
    }
    turns: dict[str, Turn] = {
        body: (variables[2 * i], variables[2 * i + 1]) for i, body in enumerate(structure.moving)
    }
    turns[structure.base] = tuple(Polynomial.constant(n, x) for x in offsets[structure.base])
    slides = dict(
        zip((j.name for j in _sliding_joints(structure)), variables[parameters:], strict=True)
    )
    polynomials = [turns[b][0] ** 2 + turns[b][1] ** 2 * squared - 1 for b in structure.moving]

    def carry(body: str, vector: Vector) -> Turn:
        place = (dot(vector, frame[0]), dot(vector, frame[1]) / squared)
        offset = offsets[body]
        return _apply(turns[body], _apply(_inverse(offset), place, squared), squared)

    for joint in _sliding_joints(structure):
        first, second = (_compose(turns[b], _inverse(offsets[b]), squared) for b in joint.bodies)
        polynomials += [first[0] - second[0], first[1] - second[1]]
    for loop in structure.loops:
        total = (Polynomial(n, {}), Polynomial(n, {}))
        links = short_links(loop.joints)
        for i, body in enumerate(loop.bodies):
            joint = loop.joints[i]
            moved = carry(body, links[i])
            total = (total[0] + moved[0], total[1] + moved[1])
            if joint.name in slides:
                carrier = slide_carrier(structure, joint)
                sign = 1 if carrier == body else -1
                moved = carry(carrier, direction(joint.axis))
                total = tuple(
                    x + slides[joint.name] * y * sign for x, y in zip(total, moved, strict=True)
                )
        polynomials += total
    full = PolynomialSystem(names, tuple(f for f in polynomials if f))
    if looped_turns(full) is None:
        elimination = without_slides(full, parameters)
    else:
        elimination = Elimination(full, names, tuple(range(n)), variables)
    system = independent_equations(elimination)
    start = [x for b in structure.moving for x in offsets[b]] + [Fraction(0)] * (n - parameters)
    return PlanarModel(
        structure, normal, offsets, elimination, system, tuple(elimination.project(start))
    )


def _sliding_joints(structure: LoopStructure) -> list[Joint]:
    return [j for j in structure.joints if j.of_type.slides_only]


def _inverse(turn: Turn) -> Turn:
    return turn[0], -turn[1]


def _frame(normal: Vector) -> tuple[Vector, Vector]:
    """A vector e across ``normal`` and ``normal`` x e: exact, e of unit length where possible."""
    candidates = [cross(normal, tuple(Fraction(int(i == j)) for j in range(3))) for i in range(3)]
    e = direction(next(v for v in candidates if not vanishes(v)))
    return e, cross(normal, e)


def _apply(turn: Turn, place: tuple[Any, Any], squared: Any) -> tuple[Any, Any]:
    """A turned vector, both in coordinates of the frame."""
    (c, s), (x, y) = turn, place
    return c * x - s * (y * squared), s * x + c * y


def _compose(first: Turn, second: Turn, squared: Any) -> Turn:
    """One turn after another."""
    return (
        first[0] * second[0] - squared * first[1] * second[1],
        first[1] * second[0] + first[0] * second[1],
    )


def _offset(orientation: Sequence[Number], normal: Vector) -> Turn:
    """The turn (c, s) of Euler parameters about ``normal``; none for other orientations."""
    if not vanishes(cross(orientation[1:], normal)):
        return Fraction(1), Fraction(0)
    squared = dot(normal, normal)
    half = dot(orientation[1:], normal) / squared
    c = orientation[0] * orientation[0] - squared * (half * half)
    return c, 2 * orientation[0] * half


def _half_turn(turn: Turn, normal: Vector, squared: Any, arithmetic: Arithmetic) -> Quaternion:
    """Euler parameters of a turn (c, s) about ``normal``, from the larger of the two halves."""
    c, s = turn
    axis = [arithmetic.convert(x) for x in normal]
    if isinstance(c, np.ndarray):
        # Of many real turns at once, each by its angle: no root is taken of what may be rounded
        # below zero.
        length = arithmetic.sqrt(squared)
        half = np.arctan2(length * s, c) / 2
        return (np.cos(half), *(x * (np.sin(half) / length) for x in axis))
    if abs(1 + c) >= abs(1 - c):
        cosine = arithmetic.sqrt((1 + c) / 2)
        return (cosine, *(x * (s / (2 * cosine)) for x in axis))
    sine = arithmetic.sqrt((1 - c) / (2 * squared))
    return (s / (2 * sine), *(x * sine for x in axis))
