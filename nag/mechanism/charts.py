"""Charts for the factors that a model keeps: its variables, their groups and their values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import Any

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.joint_factors import Factor
from nag.mechanism.loop_product import Element
from nag.mechanism.row_reduction import independent_polynomials


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
            charted.append(factor.charted(count))
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
            self._names(),
            tuple(primitive(f) for f in independent_polynomials(polynomials)),
            tuple(f for f in norms if f is not None),
            self.groups,
        )

    def _names(self) -> tuple[str, ...]:
        if all(f.joint.isascii() and f.joint.isidentifier() for f in self.factors):
            return tuple(f"{letter}_{f.joint}" for f in self.factors for letter in f.letters)
        return tuple(f"x{i + 1}" for i in range(self.n))


def factors_in(elements: Sequence[Element]) -> list[Factor]:
    """The factors of a product, each once."""
    return list(dict.fromkeys(e.factor for e in elements if e.factor is not None))


def primitive(f: Polynomial) -> Polynomial:
    """``f`` times the rational number that makes its coefficients coprime integers."""
    if not f.exact or not f:
        return f
    denominator = lcm(*(c.denominator for c in f.terms.values()))
    divisor = gcd(*(int(c * denominator) for c in f.terms.values()))
    return f * Fraction(denominator, divisor)
