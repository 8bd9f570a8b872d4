"""Arithmetic of constants and polynomials that refuses what would take too much memory or time."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from math import log10
from typing import NoReturn

from nag.algebra.number import Irrational, Number, Surd, binary, is_zero
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.tokens import ExpressionError, quote, root_text

MAX_DEGREE = 1_000
MAX_TERMS = 10_000
MAX_BITS = 4_000
MAX_DIGITS = int(MAX_BITS * log10(2))
MAX_IRRATIONAL_SIZE = 200
# Results end within this range, the binary logarithm of what a double holds.
MAX_LOG2 = 1_000
# Elementary operations on coefficients: a few microseconds each.
MAX_WORK = 100_000

Value = Number | Polynomial


@dataclass
class Budget:
    """Work that expressions may still cost, shared by all expressions of a file."""

    left: int = MAX_WORK

    def spend(self, amount: int) -> None:
        """Take ``amount`` away.

        Raises:
            ExpressionError: if it is not there.
        """
        self.left -= amount
        if self.left < 0:
            raise ExpressionError(
                f"more than {MAX_WORK} operations to multiply everything out; "
                "shorten the expressions or introduce variables for their parts"
            )


@dataclass(frozen=True)
class BoundedArithmetic:
    """Sums, products and powers of constants and of polynomials in ``n`` variables.

    A constant stays a number until it meets a polynomial. Every operation raises
    `ExpressionError` before it takes more than the budget or its result grows beyond the limits of
    this module. The variable of index ``unit`` is the imaginary unit, if there is one.
    """

    n: int
    budget: Budget = field(default_factory=Budget)
    unit: int | None = None

    def add(self, parts: Iterable[tuple[int, Value]]) -> Value:
        """The sum of values with signs 1 or -1."""
        constant: Number = Fraction(0)
        terms: dict[Exponents, Number] = {}
        polynomial = False
        for sign, value in parts:
            if not isinstance(value, Polynomial):
                self.budget.spend(1 + 20 * (_operations(constant) + _operations(value)))
                constant = check_size(constant + value if sign > 0 else constant - value)
                continue
            polynomial = True
            self.budget.spend(len(value.terms) * (1 + self.n // 50 + 20 * _operations(value)))
            for e, c in value.terms.items():
                c = c if sign > 0 else -c
                terms[e] = check_size(terms[e] + c) if e in terms else c
            if len(terms) > MAX_TERMS:
                _too_many_terms()
        if not polynomial:
            return constant
        zero = (0,) * self.n
        terms[zero] = check_size(terms[zero] + constant) if zero in terms else constant
        return Polynomial(self.n, terms)

    def multiply(self, left: Value, right: Value) -> Value:
        """The product."""
        sizes = [len(v.terms) if isinstance(v, Polynomial) else 1 for v in (left, right)]
        bits = _bits(left) + _bits(right)
        each = 1 + self.n // 50 + bits // 500 + 20 * (_operations(left) + _operations(right))
        self.budget.spend(sizes[0] * sizes[1] * each)
        if bits > MAX_BITS:
            _too_long(bits)
        if not (isinstance(left, Polynomial) and isinstance(right, Polynomial)):
            product = left * right
            return product if isinstance(product, Polynomial) else check_size(product)
        degree = left.degree + right.degree
        if degree > MAX_DEGREE:
            raise ExpressionError(f"degree {degree} is too high; at most {MAX_DEGREE} is read")
        product = left * right
        if len(product.terms) > MAX_TERMS:
            _too_many_terms()
        return product

    def divide(self, left: Value, right: Value) -> Value:
        """The quotient by a constant."""
        if isinstance(right, Polynomial):
            parts = self.parts(right)
            if parts is None:
                raise ExpressionError(
                    "the divisor contains a variable; multiply the equation by it instead"
                )
            real, imaginary = parts
            if self.unit is None:
                return self.divide(left, real)
            norm = self.add((1, self.multiply(part, part)) for part in parts)
            conjugate = real - imaginary * Polynomial.variable(self.n, self.unit)
            return self.multiply(left, self.divide(conjugate, norm))
        if is_zero(right):
            raise ExpressionError("division by zero; write a divisor that is not zero")
        return self.multiply(left, 1 / right)

    def parts(self, value: Polynomial) -> tuple[Number, Number] | None:
        """The real and the imaginary part of a constant, else None."""
        parts: list[Number] = [Fraction(0), Fraction(0)]
        for e, c in value.terms.items():
            power = 0 if self.unit is None else e[self.unit]
            if sum(e) != power:
                return None
            parts[power % 2] += -c if power % 4 > 1 else c
        return parts[0], parts[1]

    def power(self, base: Value, exponent: Value) -> Value:
        """The power with a whole exponent."""
        if not isinstance(exponent, Fraction):
            raise ExpressionError("the exponent is not a whole number; write a whole number")
        if exponent.denominator != 1:
            shown = quote(str(exponent))
            mend = "write sqrt(...) for a root"
            if isinstance(base, Polynomial):
                mend = root_text(exponent.denominator)
            raise ExpressionError(f"the exponent {shown} is not whole; {mend}")
        k = int(exponent)
        shown = str(k) if abs(k) < 10**30 else "of more than 30 digits"
        if isinstance(base, Polynomial) and k < 0 and self.parts(base) is not None:
            base, k = self.divide(Fraction(1), base), -k
        if isinstance(base, Polynomial):
            if k < 0:
                raise ExpressionError(
                    "a variable has no negative power; write a whole number from 0 up"
                )
            if k * max(base.degree, 1) > MAX_DEGREE:
                raise ExpressionError(
                    f"the exponent {shown} is too large; degrees go up to {MAX_DEGREE}"
                )
            if len(base.terms) == 1:
                ((e, c),) = base.terms.items()
                return Polynomial(self.n, {tuple(k * i for i in e): self.power(c, exponent)})
            return self._multiply_repeatedly(base, k, Polynomial.constant(self.n, 1))
        if k < 0 and is_zero(base):
            raise ExpressionError("division by zero: zero has no negative power")
        if isinstance(base, Fraction) and abs(base) in (0, 1):
            return base ** (k % 2 + 2) if k else Fraction(1)
        if abs(k) * _bits(base) > MAX_BITS:
            raise ExpressionError(
                f"the exponent {shown} is too large: the result has more than "
                f"{MAX_DIGITS} digits; write a smaller one"
            )
        if isinstance(base, Fraction):
            return base**k
        return self._multiply_repeatedly(base if k > 0 else 1 / base, abs(k), Fraction(1))

    def _multiply_repeatedly(self, base: Value, exponent: int, power: Value) -> Value:
        # One factor at a time: the cost of a step is known, that of a square of sums is not.
        for _ in range(exponent):
            power = self.multiply(power, base)
        return power


def check_size(value: Number) -> Number:
    """``value``, if it is small enough to go on with."""
    if _bits(value) > MAX_BITS:
        _too_long(_bits(value))
    if _operations(value) > MAX_IRRATIONAL_SIZE:
        raise ExpressionError(
            f"an irrational number of more than {MAX_IRRATIONAL_SIZE} operations; "
            "write a simpler one"
        )
    return value


def representable(value: Number) -> Number:
    """``value``, if a double can hold it."""
    if isinstance(value, Surd | Irrational):
        mantissa, exponent = binary(value, 15)
        size = mantissa.bit_length() + exponent if mantissa else 0
    else:
        size = value.numerator.bit_length() - value.denominator.bit_length()
    if abs(size) > MAX_LOG2 and value != 0:
        raise ExpressionError(
            f"a number of the order 1e{round(size * log10(2))} arises; "
            "scale the numbers so that they stay between 1e-300 and 1e300"
        )
    return value


def _bits(value: Value) -> int:
    if isinstance(value, Polynomial):
        return max((_bits(c) for c in value.terms.values()), default=1)
    if isinstance(value, Irrational):
        return max((_bits(a) for a in value.arguments), default=1)
    if isinstance(value, Surd):
        return value.bits
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def _operations(value: Value) -> int:
    """Size of the largest irrational number in ``value``."""
    if isinstance(value, Polynomial):
        return max((_operations(c) for c in value.terms.values()), default=0)
    return value.size if isinstance(value, Surd | Irrational) else 0


def _too_long(bits: int) -> NoReturn:
    raise ExpressionError(
        f"a number of about {int(bits * log10(2)) + 1} digits arises; "
        f"at most {MAX_DIGITS} are worked with"
    )


def _too_many_terms() -> NoReturn:
    raise ExpressionError(f"more than {MAX_TERMS} terms; split the equation")
