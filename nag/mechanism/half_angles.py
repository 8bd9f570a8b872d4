"""Formulation H: a single loop in half-angles, two joints eliminated linearly.

A turn about the line h = axis + eps (point x axis) is the dual quaternion c + s h, with (c : s) a
point of a projective line. The loop closes when the product over all joints is a real number. Let
g and k be the last two lines and A the product over the other joints; the last two joints can
close the loop exactly when conj(A) lies in span(1, g, k, gk), which is linear in A. Angles are
relative to the reference configuration.

Lines are not made unit where that would take a square root: with N the squared length of the axis,
h^2 = -N, so c + s h has norm c^2 + N s^2, and the half-angle has tangent s sqrt(N) / c.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.axes import coincident, direction, dot, parallel, skew
from nag.mechanism.configuration import (
    Arithmetic,
    Configuration,
    arithmetic_of,
    as_entries,
    configuration,
)
from nag.mechanism.graph import Joint
from nag.mechanism.loops import Loop, LoopStructure
from nag.mechanism.quaternion import (
    DualQuaternion,
    Quaternion,
    conjugate,
    dual_conjugate,
    dual_multiply,
    line,
    multiply,
    norm_squared,
    scale,
)
from nag.mechanism.row_reduction import independent_polynomials, left_inverse, null_space

# Tangents of the charts' turns: no two alike, none at a special angle, none large enough to spoil
# the conditioning. The point that a chart leaves out is then no special position of its joint.
_CHARTS = tuple(
    Fraction(a, b)
    for a, b in ((3, 7), (-5, 9), (7, 11), (-4, 13), (8, 17), (-9, 19), (6, 23), (-11, 29))
)


@dataclass(frozen=True)
class HalfAngleModel:
    """A single loop as equations in one coordinate for each kept joint.

    Attributes:
        structure: the mechanism's part with loops.
        loop: the loop, read so that its last two joints are the eliminated ones.
        charts: for each kept joint the k of its chart (c : s) = (1 - k x : k + x).
        system: the equations; one group for each variable; norm-zero points are excluded.
        reference: the reference configuration, x = -k.
        coordinates: rows that give conj(A) in the basis 1, g, k, gk.
    """

    structure: LoopStructure
    loop: Loop
    charts: tuple[Fraction, ...]
    system: PolynomialSystem
    reference: tuple[Number, ...]
    coordinates: tuple[tuple[Number, ...], ...]

    def angles(self, point: Sequence[Any]) -> tuple[tuple[Any, Any], ...]:
        """(c, s) of every joint of `loop`, the eliminated ones included, up to scale each."""
        arithmetic = arithmetic_of(point)
        return self._angles(as_entries(point), arithmetic)

    def _angles(self, point: Sequence[Any], arithmetic: Arithmetic) -> tuple[tuple[Any, Any], ...]:
        convert = arithmetic.convert
        kept = tuple(
            (1 - convert(k) * x, convert(k) + x) for k, x in zip(self.charts, point, strict=True)
        )
        joints = self.loop.joints[:-2]
        product = _product(
            [_turn(c, s, _line(j, arithmetic)) for (c, s), j in zip(kept, joints, strict=True)]
        )
        flat = [x for part in dual_conjugate(product) for x in part]
        w00, w10, w01, w11 = (
            sum((convert(y) * x for y, x in zip(row, flat, strict=True)), convert(Fraction(0)))
            for row in self.coordinates
        )
        # The matrix has rank one; its largest entry is never zero, w00 is at half a turn.
        matrix = ((w00, w01), (w10, w11))
        row, column = max(
            ((i, j) for i in (0, 1) for j in (0, 1)), key=lambda ij: abs(matrix[ij[0]][ij[1]])
        )
        return (*kept, (matrix[0][column], matrix[1][column]), matrix[row])

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution.

        Exact for exact points (with square roots where norms are no squares). Points of norm zero
        are no configurations.

        Raises:
            ZeroDivisionError: at a point of norm zero.
        """
        arithmetic = arithmetic_of(point)
        angles = self._angles(as_entries(point), arithmetic)
        convert = arithmetic.convert
        one = convert(Fraction(1))
        turns: list[Quaternion] = [(one, 0 * one, 0 * one, 0 * one)]
        for (c, s), joint in zip(angles[:-1], self.loop.joints[:-1], strict=True):
            axis = [convert(x) for x in direction(joint.axis)]
            turns.append(multiply(turns[-1], (c, *(s * x for x in axis))))
        base = conjugate(turns[self.loop.bodies.index(self.structure.base)])
        mechanism = self.structure.mechanism
        euler = {}
        for body, turn in zip(self.loop.bodies, turns, strict=True):
            relative = multiply(base, turn)
            reference = [convert(x) for x in mechanism.orientation(body)]
            unit = scale(relative, 1 / arithmetic.sqrt(norm_squared(relative)))
            euler[body] = multiply(unit, reference)
        return configuration(self.structure, euler, arithmetic)


def half_angle_model(structure: LoopStructure) -> HalfAngleModel:
    """The loop equations of a single loop in half-angles.

    Raises:
        ValueError: if there is not exactly one loop, it has fewer than three joints, or all its
            axes coincide.
    """
    loop = _choose_eliminated(structure)
    kept, (first, second) = loop.joints[:-2], loop.joints[-2:]
    n = len(kept)
    charts = tuple(
        _CHARTS[i] if i < len(_CHARTS) else Fraction(i + 4, 2 * i + 15) for i in range(n)
    )
    exact = Arithmetic(lambda c: c, lambda x: x)
    variables = Polynomial.variables(n)
    product = _product(
        [
            _turn(1 - k * x, k + x, _line(joint, exact))
            for k, x, joint in zip(charts, variables, kept, strict=True)
        ]
    )
    flat = [x for part in dual_conjugate(product) for x in part]
    basis = _basis(first, second)
    equations = [_combine(row, flat) for row in null_space(basis, 8)]
    coordinates = tuple(left_inverse(basis))
    if not skew(first, second):
        w00, w10, w01, w11 = (_combine(row, flat) for row in coordinates)
        equations.append(w00 * w11 - w10 * w01)
    system = PolynomialSystem(
        _variable_names(kept),
        tuple(_primitive(f) for f in independent_polynomials(equations)),
        tuple(_norm(k, joint, x) for k, joint, x in zip(charts, kept, variables, strict=True)),
        tuple((i,) for i in range(n)),
    )
    return HalfAngleModel(structure, loop, charts, system, tuple(-k for k in charts), coordinates)


def _choose_eliminated(structure: LoopStructure) -> Loop:
    """The loop, turned so that its last two axes are skew, or else at least not the same line."""
    loop = structure.single
    if loop is None:
        raise ValueError(
            f"half-angles need a single loop; this mechanism has {len(structure.loops)}"
        )
    n = len(loop.joints)
    if n < 3:
        raise ValueError(f"half-angles need a loop of at least 3 joints; this one has {n}")
    if any(j.type != "revolute" for j in loop.joints):
        raise ValueError("half-angles are for revolute joints")
    readings = [loop.rotated(i) for i in range(n)]
    for suits in (skew, lambda g, k: not parallel(g, k), lambda g, k: not coincident(g, k)):
        for reading in readings:
            if suits(*reading.joints[-2:]):
                return reading
    raise ValueError("all axes of the loop coincide: every joint turns freely")


def _line(joint: Joint, arithmetic: Arithmetic) -> DualQuaternion:
    point = [arithmetic.convert(x) for x in joint.point]
    return line(point, [arithmetic.convert(x) for x in direction(joint.axis)])


def _turn(c: Any, s: Any, h: DualQuaternion) -> DualQuaternion:
    """c + s h."""
    real, dual = (tuple(s * x for x in part) for part in h)
    return (c + real[0], *real[1:]), dual


def _product(factors: Sequence[DualQuaternion]) -> DualQuaternion:
    result = factors[0]
    for factor in factors[1:]:
        result = dual_multiply(result, factor)
    return result


def _basis(first: Joint, second: Joint) -> list[list[Number]]:
    """1, g, k and gk as vectors of 8 numbers, for the lines g and k of two joints."""
    exact = Arithmetic(lambda c: c, lambda x: x)
    g, k = _line(first, exact), _line(second, exact)
    zero, one = Fraction(0), Fraction(1)
    unit = ((one, zero, zero, zero), (zero, zero, zero, zero))
    return [[x for part in q for x in part] for q in (unit, g, k, dual_multiply(g, k))]


def _combine(row: Sequence[Number], flat: Sequence[Polynomial]) -> Polynomial:
    return sum((f * c for c, f in zip(row, flat, strict=True)), Polynomial(flat[0].n, {}))


def _norm(k: Fraction, joint: Joint, x: Polynomial) -> Polynomial:
    """c^2 + N s^2 in the chart, with leading coefficient 1: x^2 + 1 for a unit axis."""
    axis = direction(joint.axis)
    squared = dot(axis, axis)
    return ((1 - k * x) ** 2 + (k + x) ** 2 * squared) / (k * k + squared)


def _primitive(f: Polynomial) -> Polynomial:
    """``f`` times the rational number that makes its coefficients coprime integers."""
    if not f.exact or not f:
        return f
    denominator = lcm(*(c.denominator for c in f.terms.values()))
    divisor = gcd(*(int(c * denominator) for c in f.terms.values()))
    return f * Fraction(denominator, divisor)


def _variable_names(joints: Sequence[Joint]) -> tuple[str, ...]:
    if all(j.name.isascii() and j.name.isidentifier() for j in joints):
        return tuple(f"x_{j.name}" for j in joints)
    return tuple(f"x{i + 1}" for i in range(len(joints)))
