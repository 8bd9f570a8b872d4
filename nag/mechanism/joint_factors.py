"""Joints as products of factors that are linear in homogeneous coordinates, and their charts.

In dual quaternions a turn about a line h is c + s h, a slide along u is 1 + x eps u/2; a spherical
joint is any quaternion about its centre, a planar one a + b n + eps (x u + y v)/2. Each factor is a
combination of constant dual quaternions, its *generators*, with coefficients that are homogeneous
coordinates of a projective space; a group of affine variables is a chart of that space. All of it
is in global coordinates of the reference configuration, where every factor is the unit.

Lines are not made unit where that would take a square root: with N the squared length of the axis,
h^2 = -N, so c + s h has norm c^2 + N s^2, and the half-angle has tangent s sqrt(N) / c.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import Any

from nag.algebra.exact_ranks import independent_polynomials
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.assembly_modes import mode_rotation
from nag.mechanism.axes import across, direction, dot
from nag.mechanism.graph import Joint
from nag.mechanism.joint_types import FACTOR_KINDS, FREE_KIND, FactorKind
from nag.mechanism.quaternion import DualQuaternion, Quaternion, dual_conjugate, line

ZERO, ONE = Fraction(0), Fraction(1)
NOTHING: Quaternion = (ZERO, ZERO, ZERO, ZERO)
UNIT: DualQuaternion = ((ONE, ZERO, ZERO, ZERO), NOTHING)

# Tangents of the charts' turns: no two alike, none at a special angle, none large enough to spoil
# the conditioning. The points that a chart leaves out are then no special position of the joint.
_CHARTS = tuple(
    Fraction(a, b)
    for a, b in ((3, 7), (-5, 9), (7, 11), (-4, 13), (8, 17), (-9, 19), (6, 23), (-11, 29))
)


@dataclass(frozen=True)
class Factor:
    """One factor of a joint.

    Attributes:
        joint: name of the joint; of a body in the air, its own name.
        kind: what it does, a key of `nag.mechanism.joint_types.FACTOR_KINDS`, or ``"free"``.
        generators: the first is the unit.
        number: which factor of that kind it is in its joint, from 0.
        charts: constants of its chart, as many as it has turning coordinates.
    """

    joint: str
    kind: str
    generators: tuple[DualQuaternion, ...]
    number: int = 0
    charts: tuple[Fraction, ...] = ()

    @property
    def of_kind(self) -> FactorKind:
        """What its kind has."""
        return FREE_KIND if self.kind == "free" else FACTOR_KINDS[self.kind]

    @property
    def dimension(self) -> int:
        """Dimension of its projective space."""
        return len(self.generators) - 1

    @property
    def letters(self) -> tuple[str, ...]:
        """First letters of its variables' names."""
        letters = self.of_kind.letters
        return (letters[self.number],) if self.dimension == 1 else tuple(letters)

    def with_chart(self, first: int) -> Factor:
        """The same with chart constants, those of a model being numbered from ``first``."""
        count = self.of_kind.turning
        return replace(self, charts=tuple(_chart(first + i) for i in range(count)))

    def homogeneous(self, x: Sequence[Any], convert: Any = lambda c: c) -> tuple[Any, ...]:
        """Homogeneous coordinates of the chart's point ``x``."""
        turning = [convert(k) + y for k, y in zip(self.charts, x, strict=False)]
        first = convert(ONE) - sum(
            (convert(k) * y for k, y in zip(self.charts, x, strict=False)), convert(ZERO)
        )
        return (first, *turning, *x[len(turning) :])

    @property
    def reference(self) -> tuple[Fraction, ...]:
        """The reference configuration in the chart."""
        turning = tuple(-k for k in self.charts)
        return turning + (ZERO,) * (self.dimension - len(turning))

    def norm(self, x: Sequence[Polynomial]) -> Polynomial | None:
        """The factor's squared norm in the chart, scaled to leading coefficient 1; None if it is 1.

        Where it vanishes the factor is no displacement.
        """
        if not self.of_kind.turning:
            return None
        values = self.homogeneous(x)[: 1 + len(self.charts)]
        total = values[0] * values[0]
        top = sum((k * k for k in self.charts[:1]), ZERO)
        for value, (real, _) in zip(values[1:], self.generators[1:], strict=False):
            squared = dot(real[1:], real[1:])
            total = total + value * value * squared
        real = self.generators[1][0]
        return total / (top + dot(real[1:], real[1:]))


def _chart(i: int) -> Fraction:
    return _CHARTS[i] if i < len(_CHARTS) else Fraction(i + 4, 2 * i + 15)


def factors_of_joint(joint: Joint) -> tuple[Factor, ...]:
    """The factors whose product is the displacement of the second body against the first."""
    kinds = joint.of_type.factors
    return tuple(
        Factor(joint.name, kind, (UNIT, *_generators(joint, kind, number)), number)
        for i, kind in enumerate(kinds)
        for number in [kinds[:i].count(kind)]
    )


def _generators(joint: Joint, kind: str, number: int) -> tuple[DualQuaternion, ...]:
    """What a factor is combined of besides the unit, ``number`` the same ones before it."""
    if kind == "ball":
        axes = [tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3)]
        return tuple(line(joint.point, a) for a in axes)
    axis = direction(joint.second_axis if number else joint.axis)
    if kind == "turn":
        return (line(joint.point, axis),)
    if kind == "slide":
        return (_shift(axis),)
    return (line(joint.point, axis), *map(_shift, across(axis)))


def free_factor(body: str) -> Factor:
    """Study coordinates of a body: all dual quaternions, of which Study's quadric moves it."""
    units = [tuple(Fraction(int(i == j)) for j in range(4)) for i in range(4)]
    generators = [(u, NOTHING) for u in units] + [(NOTHING, u) for u in units]
    return Factor(body, "free", tuple(generators))


def mode_constant(joint: Joint, mode: int) -> DualQuaternion:
    """The constant displacement of an assembly mode, which follows the joint's factors."""
    if mode == 0:
        return UNIT
    return line(joint.point, mode_rotation(joint, mode)[1:])


def reversed_generators(generators: Sequence[DualQuaternion]) -> tuple[DualQuaternion, ...]:
    """Generators of the opposite displacement, first body against second."""
    return tuple(dual_conjugate(g) for g in generators)


def _shift(vector: Sequence[Number]) -> DualQuaternion:
    return NOTHING, (ZERO, *(x / 2 for x in vector))


@dataclass(frozen=True)
class Charts:
    """The factors of a model, each with a chart.

    Attributes:
        plain: the factors as the joints give them.
        factors: the same with charts.
        groups: the variables of each.
    """

    plain: tuple[Factor, ...]
    factors: tuple[Factor, ...]
    groups: tuple[tuple[int, ...], ...]

    @classmethod
    def of(cls, factors: Sequence[Factor]) -> Charts:
        """Charts without common constants."""
        count, n = 0, 0
        charted, groups = [], []
        for factor in factors:
            charted.append(factor.with_chart(count))
            count += len(charted[-1].charts)
            groups.append(tuple(range(n, n + factor.dimension)))
            n += factor.dimension
        return cls(tuple(factors), tuple(charted), tuple(groups))

    @property
    def n(self) -> int:
        """Number of variables."""
        return sum(f.dimension for f in self.factors)

    @property
    def reference(self) -> tuple[Fraction, ...]:
        """The reference configuration."""
        return tuple(x for f in self.factors for x in f.reference)

    @cached_property
    def values(self) -> dict[Factor, tuple[Polynomial, ...]]:
        """Homogeneous coordinates of the plain factors, as polynomials in the variables."""
        variables = Polynomial.variables(self.n)
        zero = Polynomial(self.n, {})
        return {
            plain: tuple(zero + w for w in factor.homogeneous([variables[i] for i in group]))
            for plain, factor, group in zip(self.plain, self.factors, self.groups, strict=True)
        }

    def at(self, point: Sequence[Any], convert: Any) -> dict[Factor, tuple[Any, ...]]:
        """Homogeneous coordinates of the plain factors at a point."""
        return {
            plain: factor.homogeneous([point[i] for i in group], convert)
            for plain, factor, group in zip(self.plain, self.factors, self.groups, strict=True)
        }

    def system(self, equations: Sequence[Any]) -> PolynomialSystem:
        """Independent equations with coprime coefficients; points of norm zero are excluded."""
        variables, zero = Polynomial.variables(self.n), Polynomial(self.n, {})
        polynomials = [f for f in (zero + f for f in equations) if f]
        norms = [
            f.norm([variables[i] for i in group])
            for f, group in zip(self.factors, self.groups, strict=True)
        ]
        return PolynomialSystem(
            self.names,
            tuple(primitive(f) for f in independent_polynomials(polynomials)),
            tuple(f for f in norms if f is not None),
            self.groups,
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Of the variables: those of the joints with letters before them, where that is a name."""
        if all(f.joint.isascii() and f.joint.isidentifier() for f in self.factors):
            return tuple(f"{letter}_{f.joint}" for f in self.factors for letter in f.letters)
        return tuple(f"x{i + 1}" for i in range(self.n))


def primitive(f: Polynomial) -> Polynomial:
    """``f`` times the rational number that makes its coefficients coprime integers."""
    if not f.exact or not f:
        return f
    denominator = lcm(*(c.denominator for c in f.terms.values()))
    divisor = gcd(*(int(c * denominator) for c in f.terms.values()))
    return f * Fraction(denominator, divisor)
