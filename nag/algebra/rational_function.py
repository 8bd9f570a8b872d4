"""Rational functions over the rationals, by FLINT: formulas evaluated at their own variables.

A formula that vanishes as a rational function vanishes at all values of its parameters.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

import flint

from nag.algebra.polynomial import sum_terms
from nag.errors import NagError

Order = Literal["lex", "degrevlex"]


class FunctionField:
    """The field of rational functions in variables with names, the largest variable first.

    Attributes:
        names: the variables' names.
        order: order of the monomials of its polynomials.
        context: FLINT's ring of polynomials with whole coefficients.
    """

    def __init__(self, names: str | Sequence[str], order: Order = "lex") -> None:
        self.names = tuple(names.split() if isinstance(names, str) else names)
        self.order = order
        self.context = flint.fmpz_mpoly_ctx.get(self.names, flint.Ordering[order])

    @property
    def variables(self) -> tuple[RationalFunction, ...]:
        """The variables as functions."""
        one = self.context.from_dict({(0,) * len(self.names): 1})
        return tuple(RationalFunction(self, x, one) for x in self.context.gens())

    def __call__(self, value: int | Fraction) -> RationalFunction:
        """A constant function."""
        value = Fraction(value)
        zero = (0,) * len(self.names)
        numerator = {zero: value.numerator} if value else {}
        return RationalFunction(
            self,
            self.context.from_dict(numerator),
            self.context.from_dict({zero: value.denominator}),
        )


@dataclass(frozen=True, eq=False)
class RationalFunction:
    """A quotient of coprime polynomials; ``+ - * / **`` with its like, integers and fractions."""

    field: FunctionField
    numerator: Any
    denominator: Any

    def _coerce(self, other: Any) -> RationalFunction | None:
        if isinstance(other, RationalFunction):
            if other.field is not self.field:
                raise NagError("functions of different fields do not mix")
            return other
        return self.field(other) if isinstance(other, int | Fraction) else None

    def _quotient(self, numerator: Any, denominator: Any) -> RationalFunction:
        divisor = numerator.gcd(denominator)
        if not divisor.is_one():
            numerator, denominator = numerator // divisor, denominator // divisor
        return RationalFunction(self.field, numerator, denominator)

    def __add__(self, other: Any) -> RationalFunction:
        other = self._coerce(other)
        if other is None:
            return NotImplemented
        if self.denominator == other.denominator:
            return self._quotient(self.numerator + other.numerator, self.denominator)
        return self._quotient(
            self.numerator * other.denominator + other.numerator * self.denominator,
            self.denominator * other.denominator,
        )

    __radd__ = __add__

    def __neg__(self) -> RationalFunction:
        return RationalFunction(self.field, -self.numerator, self.denominator)

    def __sub__(self, other: Any) -> RationalFunction:
        other = self._coerce(other)
        return NotImplemented if other is None else self + (-other)

    def __rsub__(self, other: Any) -> RationalFunction:
        return (-self) + other

    def __mul__(self, other: Any) -> RationalFunction:
        other = self._coerce(other)
        if other is None:
            return NotImplemented
        return self._quotient(
            self.numerator * other.numerator, self.denominator * other.denominator
        )

    __rmul__ = __mul__

    def inverse(self) -> RationalFunction:
        """One over it.

        Raises:
            ZeroDivisionError: of the function 0.
        """
        if not self:
            raise ZeroDivisionError("a function is divided by the function 0")
        return RationalFunction(self.field, self.denominator, self.numerator)

    def __truediv__(self, other: Any) -> RationalFunction:
        other = self._coerce(other)
        return NotImplemented if other is None else self * other.inverse()

    def __rtruediv__(self, other: Any) -> RationalFunction:
        return self.inverse() * other

    def __pow__(self, exponent: int) -> RationalFunction:
        if exponent < 0:
            return self.inverse() ** -exponent
        return RationalFunction(self.field, self.numerator**exponent, self.denominator**exponent)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, RationalFunction | int | Fraction):
            return NotImplemented
        return not self - other

    def __hash__(self) -> int:
        # Quotients are unique up to a common sign.
        return hash((self.field.names, str(self.numerator**2), str(self.denominator**2)))

    def __bool__(self) -> bool:
        return self.numerator != 0

    def at(self, values: Mapping[str, Fraction]) -> Fraction:
        """The value where each variable has the given one.

        Raises:
            ZeroDivisionError: if the denominator vanishes there.
        """
        point = [Fraction(values[name]) for name in self.field.names]
        return _value(self.numerator, point) / _value(self.denominator, point)

    def __repr__(self) -> str:
        text = str(self.numerator)
        return text if self.denominator.is_one() else f"({text})/({self.denominator})"


def _value(polynomial: Any, point: Sequence[Fraction]) -> Fraction:
    terms = ((tuple(map(int, e)), Fraction(int(c))) for e, c in polynomial.to_dict().items())
    return sum_terms(terms, point, Fraction(0))
