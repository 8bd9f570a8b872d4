"""Exact real numbers: fractions, and expressions that can be evaluated to any precision."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import mpmath

# Two expressions are taken to be equal when they agree to this many digits; a rational identity
# between square roots of case-file numbers that holds so far and then fails is not to be expected.
EQUALITY_DIGITS = 60

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": mpmath.sqrt,
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "+": lambda a, b: a + b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "neg": lambda a: -a,
}


@dataclass(frozen=True, eq=False)
class Irrational:
    """A real number given by an expression in ``sqrt``, ``sin``, ``cos``, ``pi`` and fractions.

    Equality means agreement to `EQUALITY_DIGITS` digits, so results that rest on it are marked
    inexact in the output.
    """

    operation: str
    arguments: tuple[Number, ...] = ()
    _cache: dict[int, Any] = field(default_factory=dict, repr=False)

    def evaluate(self, digits: int) -> Any:
        """The value as an `mpmath.mpf` with about ``digits`` digits."""
        if digits not in self._cache:
            with mpmath.workdps(digits + 10):
                if self.operation == "pi":
                    value = +mpmath.pi
                else:
                    values = [to_mpf(a, digits + 10) for a in self.arguments]
                    value = _FUNCTIONS[self.operation](*values)
            self._cache[digits] = value
        return self._cache[digits]

    def __reduce__(self) -> tuple[Any, ...]:
        return Irrational, (self.operation, self.arguments)

    def __add__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        return self if other == 0 else Irrational("+", (self, _number(other)))

    __radd__ = __add__

    def __neg__(self) -> Number:
        return self.arguments[0] if self.operation == "neg" else Irrational("neg", (self,))

    def __sub__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        return self + (-other)

    def __rsub__(self, other: Number | int) -> Number:
        return (-self) + other

    def __mul__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        if isinstance(other, int | Fraction):
            if other == 0:
                return Fraction(0)
            if other == 1:
                return self
            if other == -1:
                return -self
        if isinstance(other, Irrational) and self.operation == other.operation == "sqrt":
            if self.arguments[0] is other.arguments[0] or self.arguments[0] == other.arguments[0]:
                return self.arguments[0]
        return Irrational("*", (self, _number(other)))

    __rmul__ = __mul__

    def __truediv__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        if is_zero(other):
            raise ZeroDivisionError("division by zero")
        if isinstance(other, int | Fraction):
            return self * (1 / Fraction(other))
        return Irrational("/", (self, other))

    def __rtruediv__(self, other: Number | int) -> Number:
        if is_zero(self):
            raise ZeroDivisionError("division by zero")
        return Irrational("/", (_number(other), self))

    def __pow__(self, exponent: int) -> Number:
        if exponent < 0:
            return 1 / (self**-exponent)
        result: Number = Fraction(1)
        for _ in range(exponent):
            result = self * result
        return result

    def __float__(self) -> float:
        return float(self.evaluate(30))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        return self is other or is_zero(Irrational("+", (self, _number(-other))))

    def __hash__(self) -> int:
        return hash(mpmath.nstr(self.evaluate(30), 20))

    def __lt__(self, other: Number | int) -> bool:
        return self != other and self.evaluate(60) < to_mpf(_number(other), 60)

    def __gt__(self, other: Number | int) -> bool:
        return self != other and self.evaluate(60) > to_mpf(_number(other), 60)

    def __str__(self) -> str:
        return number_text(self)


Number = Fraction | Irrational


def _number(value: Number | int) -> Number:
    return Fraction(value) if isinstance(value, int) else value


def to_mpf(value: Number | int, digits: int) -> Any:
    """``value`` as an `mpmath.mpf` with at least ``digits`` digits."""
    if isinstance(value, Irrational):
        return value.evaluate(digits)
    with mpmath.workdps(digits + 10):
        value = Fraction(value)
        return mpmath.mpf(value.numerator) / value.denominator


def is_zero(value: Number | int) -> bool:
    """Whether ``value`` is zero: exactly for fractions, to `EQUALITY_DIGITS` otherwise."""
    if not isinstance(value, Irrational):
        return value == 0
    return abs(value.evaluate(EQUALITY_DIGITS)) < mpmath.mpf(10) ** (5 - EQUALITY_DIGITS)


def square_root(value: Number | int) -> Number:
    """The non-negative square root, a fraction where ``value`` is the square of one.

    Raises:
        ValueError: if ``value`` is negative.
    """
    from math import isqrt

    value = _number(value)
    if value < 0:
        raise ValueError("square root of a negative number")
    if isinstance(value, Fraction):
        top, bottom = isqrt(value.numerator), isqrt(value.denominator)
        if top * top == value.numerator and bottom * bottom == value.denominator:
            return Fraction(top, bottom)
    return Irrational("sqrt", (value,))


def number_text(value: Number) -> str:
    """``value`` as text in the grammar of `nag.algebra.expression`."""
    if isinstance(value, Fraction):
        return str(value)
    if value.operation == "pi":
        return "pi"
    texts = [number_text(a) for a in value.arguments]
    if value.operation == "neg":
        return f"(-{texts[0]})"
    if value.operation in ("+", "*", "/"):
        left, right = (f"({t})" if "/" in t or t.startswith("-") else t for t in texts)
        return f"({left}{value.operation}{right})"
    return f"{value.operation}({texts[0]})"
