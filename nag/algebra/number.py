"""Exact real numbers: fractions, and expressions that can be evaluated to any precision."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from math import isqrt
from typing import Any

from nag.errors import NagError

# Two expressions are taken to be equal when they agree to this many digits; a rational identity
# between square roots of case-file numbers that holds so far and then fails is not to be expected.
EQUALITY_DIGITS = 60

# Digits that a sum may lose to cancellation before it counts as zero. Each is tried in turn.
_GUARDS = (10, 40, 40 + EQUALITY_DIGITS)

# Square factors of radicands are looked for below this bound: sqrt(12) is 2*sqrt(3).
_SQUARE_BOUND = 200


def _mpmath() -> Any:
    # Loading it takes longer than what is done with rational numbers alone.
    import mpmath

    return mpmath


_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": lambda a: _mpmath().sqrt(a),
    "sin": lambda a: _mpmath().sin(a),
    "cos": lambda a: _mpmath().cos(a),
    "+": lambda a, b: a + b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "neg": lambda a: -a,
}
# Of a larger angle nothing is left when turns are taken off to the working precision.
LARGEST_ANGLE = 1e15
_CANCELLING = ("+", "sin", "cos")


@dataclass(frozen=True, eq=False)
class Irrational:
    """A real number given by an expression in ``sqrt``, ``sin``, ``cos``, ``pi`` and fractions.

    Rational factors are kept in front and equal radicands are multiplied out, so products, powers
    and inverses of ``q*sqrt(r)`` are exact, and rational where they should be. Otherwise equality
    means agreement to `EQUALITY_DIGITS` digits, so results that rest on it are marked inexact in
    the output.
    """

    operation: str
    arguments: tuple[Number, ...] = ()
    _cache: dict[int, Any] = field(default_factory=dict, repr=False)

    def evaluate(self, digits: int) -> Any:
        """The value as an `mpmath.mpf` with about ``digits`` correct digits; 0 if it is zero."""
        if digits not in self._cache:
            self._cache[digits] = self._evaluate(digits)
        return self._cache[digits]

    def _evaluate(self, digits: int) -> Any:
        for guard in _GUARDS:
            with _mpmath().workdps(digits + guard + 5):
                if self.operation == "pi":
                    return +_mpmath().pi
                values = [to_mpf(a, digits + guard) for a in self.arguments]
                value = _FUNCTIONS[self.operation](*values)
                if self.operation not in _CANCELLING:
                    return value
                scale = max(abs(v) for v in values)
                if abs(value) > scale * _mpmath().mpf(10) ** (5 - guard):
                    return value
        return _mpmath().mpf(0)

    @property
    def size(self) -> int:
        """Number of operations written out, shared parts counted each time."""
        if -1 not in self._cache:
            inner = (a.size for a in self.arguments if isinstance(a, Irrational))
            self._cache[-1] = 1 + sum(inner)
        return self._cache[-1]

    def __reduce__(self) -> tuple[Any, ...]:
        return Irrational, (self.operation, self.arguments)

    def __add__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        if not isinstance(other, Irrational):
            return self if other == 0 else Irrational("+", (self, Fraction(other)))
        (p, core), (q, other_core) = _split(self), _split(other)
        if _same(core, other_core):
            return _times(p + q, core)
        total = Irrational("+", (self, other))
        return Fraction(0) if is_zero(total) else total

    __radd__ = __add__

    def __neg__(self) -> Number:
        factor, core = _split(self)
        return _times(-factor, core)

    def __pos__(self) -> Number:
        return self

    def __abs__(self) -> Number:
        return -self if self < 0 else self

    def __sub__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        return self + (-other)

    def __rsub__(self, other: Number | int) -> Number:
        return (-self) + other

    def __mul__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        (p, core), (q, other_core) = _split(self), _split(_number(other))
        if other_core is None:
            return _times(p * q, core)
        if core.operation == other_core.operation == "sqrt":
            return p * q * square_root(core.arguments[0] * other_core.arguments[0])
        return _times(p * q, Irrational("*", (core, other_core)))

    __rmul__ = __mul__

    def __truediv__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        return self * _inverse(_number(other))

    def __rtruediv__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction):
            return NotImplemented
        return _inverse(self) * other

    def __pow__(self, exponent: int) -> Number:
        if exponent < 0:
            return _inverse(self) ** -exponent
        result: Number = Fraction(1)
        base: Number = self
        while exponent:
            if exponent & 1:
                result = base * result
            exponent >>= 1
            if exponent:
                base = base * base
        return result

    def __float__(self) -> float:
        return float(self.evaluate(30))

    def __bool__(self) -> bool:
        return not is_zero(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, int | Fraction | Irrational):
            return NotImplemented
        return self is other or is_zero(self - other)

    def __hash__(self) -> int:
        # A number that equals a fraction must hash like it.
        with _mpmath().workdps(EQUALITY_DIGITS):
            value = self.evaluate(EQUALITY_DIGITS)
            if abs(value) < 10**15:
                digits = int(_mpmath().nint(value * 10**40))
                near = Fraction(digits, 10**40).limit_denominator(10**15)
                if self == near:
                    return hash(near)
            return hash(_mpmath().nstr(value, 20))

    def _sign_of_difference(self, other: Number | int) -> int:
        difference = self - other
        if isinstance(difference, Irrational):
            return int(_mpmath().sign(difference.evaluate(EQUALITY_DIGITS)))
        return (difference > 0) - (difference < 0)

    def __lt__(self, other: Number | int) -> bool:
        return self._sign_of_difference(other) < 0

    def __le__(self, other: Number | int) -> bool:
        return self._sign_of_difference(other) <= 0

    def __gt__(self, other: Number | int) -> bool:
        return self._sign_of_difference(other) > 0

    def __ge__(self, other: Number | int) -> bool:
        return self._sign_of_difference(other) >= 0

    def __str__(self) -> str:
        return number_text(self)


Number = Fraction | Irrational

PI = Irrational("pi")


def _number(value: Number | int) -> Number:
    return Fraction(value) if isinstance(value, int) else value


def _split(value: Number) -> tuple[Fraction, Irrational | None]:
    """``value`` as a rational factor and what it multiplies (nothing, for a fraction)."""
    if isinstance(value, Fraction):
        return value, None
    if value.operation == "neg":
        factor, core = _split(value.arguments[0])
        return -factor, core
    if value.operation == "*" and isinstance(value.arguments[0], Fraction):
        return value.arguments[0], value.arguments[1]
    return Fraction(1), value


def _times(factor: Fraction, core: Irrational) -> Number:
    if factor == 0:
        return Fraction(0)
    if factor == 1:
        return core
    if factor == -1:
        return Irrational("neg", (core,))
    return Irrational("*", (factor, core))


def _same(left: Irrational | None, right: Irrational | None) -> bool:
    """Whether two expressions are written the same way."""
    if left is right:
        return True
    if left is None or right is None or left.operation != right.operation:
        return False
    return all(
        _same(a, b)
        if isinstance(a, Irrational) and isinstance(b, Irrational)
        else a is b
        if isinstance(a, Irrational) or isinstance(b, Irrational)
        else a == b
        for a, b in zip(left.arguments, right.arguments, strict=True)
    )


def _inverse(value: Number) -> Number:
    if is_zero(value):
        raise ZeroDivisionError("division by zero")
    factor, core = _split(value)
    if core is None:
        return 1 / factor
    if core.operation == "sqrt":
        return core / core.arguments[0] / factor
    if core.operation == "/":
        return Irrational("/", (core.arguments[1], core.arguments[0])) / factor
    return _times(1 / factor, Irrational("/", (Fraction(1), core)))


def to_mpf(value: Number | int, digits: int) -> Any:
    """``value`` as an `mpmath.mpf` with at least ``digits`` digits."""
    if isinstance(value, Irrational):
        return value.evaluate(digits)
    with _mpmath().workdps(digits + 10):
        value = Fraction(value)
        return _mpmath().mpf(value.numerator) / value.denominator


def is_zero(value: Number | int) -> bool:
    """Whether ``value`` is zero: exactly for fractions, to `EQUALITY_DIGITS` otherwise."""
    if not isinstance(value, Irrational):
        return value == 0
    return value.evaluate(EQUALITY_DIGITS) == 0


def square_root(value: Number | int) -> Number:
    """The non-negative square root, a fraction where ``value`` is the square of one.

    Raises:
        ValueError: if ``value`` is negative.
    """
    value = _number(value)
    if value < 0:
        raise NagError("square root of a negative number")
    if isinstance(value, Irrational):
        return Irrational("sqrt", (value,))
    root, radicand = 1, value.numerator * value.denominator
    for k in range(2, _SQUARE_BOUND):
        while radicand and radicand % (k * k) == 0:
            root, radicand = root * k, radicand // (k * k)
    exact = isqrt(radicand)
    if exact * exact == radicand:
        return Fraction(root * exact, value.denominator)
    core = Irrational("sqrt", (Fraction(radicand),))
    return _times(Fraction(root, value.denominator), core)


def pi_multiple(value: Number) -> Fraction | None:
    """The fraction ``q`` with ``value = q*pi`` if the expression shows one, else None."""
    factor, core = _split(value)
    if factor == 0:
        return Fraction(0)
    if core is None:
        return None
    if core.operation == "pi":
        return factor
    if core.operation == "+":
        parts = [pi_multiple(a) for a in core.arguments]
        if None not in parts:
            return factor * (parts[0] + parts[1])
    return None


def _bounded_angle(value: Number) -> Number:
    if abs(to_mpf(value, 20)) > LARGEST_ANGLE:
        raise NagError(f"an angle beyond {LARGEST_ANGLE:.0e} is no angle; reduce it by turns")
    return value


def sine(value: Number | int) -> Number:
    """The sine, in square roots at the multiples of pi/6 and pi/4."""
    value = _number(value)
    turns = pi_multiple(value)
    if turns is None:
        return Irrational("sin", (_bounded_angle(value),))
    turns %= 2
    if turns >= 1:
        return -sine(_times_pi(turns - 1))
    acute = min(turns, 1 - turns)
    squared = {
        Fraction(0): Fraction(0),
        Fraction(1, 6): Fraction(1, 4),
        Fraction(1, 4): Fraction(1, 2),
        Fraction(1, 3): Fraction(3, 4),
        Fraction(1, 2): Fraction(1),
    }
    if acute in squared:
        return square_root(squared[acute])
    return Irrational("sin", (_times_pi(acute),))


def cosine(value: Number | int) -> Number:
    """The cosine, in square roots at the multiples of pi/6 and pi/4."""
    value = _number(value)
    turns = pi_multiple(value)
    if turns is None:
        return Irrational("cos", (_bounded_angle(value),))
    return sine(_times_pi(turns + Fraction(1, 2)))


def _times_pi(factor: Fraction) -> Number:
    return _times(factor, PI)


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


def decimal_digits(c: Number) -> int:
    """Decimal digits of a rational number's numerator or denominator, whichever has more.

    0 for numbers that are not rational.
    """
    if isinstance(c, int | Fraction):
        c = Fraction(c)
        return len(str(max(abs(c.numerator), c.denominator)))
    return 0


def rounded_fraction(value: Number, digits: int) -> Fraction:
    """A number as a fraction, an irrational one rounded to so many digits."""
    if isinstance(value, Fraction):
        return value
    sign, mantissa, exponent, _ = to_mpf(value, digits)._mpf_
    whole = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    return -whole if sign else whole
