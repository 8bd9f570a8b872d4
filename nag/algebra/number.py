"""Real numbers: fractions and sums of square roots, exact, and expressions in other functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple

from nag.algebra.root_basis import cosine_of_turns
from nag.algebra.surd import Surd, natural_power, normal_sum, root_of_fraction, root_of_surd
from nag.errors import NagError

# Two expressions are taken to be equal when they agree to this many digits; an identity between
# case-file numbers that holds so far and then fails is not to be expected.
EQUALITY_DIGITS = 60

# Digits that a sum may lose to cancellation before it counts as zero. Each is tried in turn.
_GUARDS = (10, 40, 40 + EQUALITY_DIGITS)


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
    # A sum of roots that is multiplied by another.
    "exact": lambda a: a,
}
# Of a larger angle nothing is left when turns are taken off to the working precision.
LARGEST_ANGLE = 1e15
_CANCELLING = ("+", "sin", "cos")


@dataclass(frozen=True, eq=False)
class Irrational:
    """A real number given by an expression in ``sqrt``, ``sin``, ``cos``, ``pi`` and exact numbers.

    Sums of square roots of fractions and of cosines of rational turns are no such expressions:
    `Surd` has them. Exact factors are
    kept in front, and equal radicands are multiplied out. Equality means agreement to
    `EQUALITY_DIGITS` digits, so results that rest on it are marked inexact in the output.
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
            inner = (a.size for a in self.arguments if not isinstance(a, Fraction))
            self._cache[-1] = 1 + sum(inner)
        return self._cache[-1]

    def __reduce__(self) -> tuple[Any, ...]:
        return Irrational, (self.operation, self.arguments)

    def __add__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Number):
            return NotImplemented
        if isinstance(other, int | Fraction):
            return self if other == 0 else Irrational("+", (self, Fraction(other)))
        (p, core), (q, other_core) = _split(self), _split(other)
        if core is not None and other_core is not None and _are_alike(core, other_core):
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
        if not isinstance(other, int | Number):
            return NotImplemented
        return self + (-other)

    def __rsub__(self, other: Number | int) -> Number:
        return (-self) + other

    def __mul__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Number):
            return NotImplemented
        (p, core), (q, other_core) = _split(self), _split(_number(other))
        if other_core is None:
            return _times(p * q, core)
        if core.operation == other_core.operation == "sqrt":
            return p * q * square_root(core.arguments[0] * other_core.arguments[0])
        return _times(p * q, Irrational("*", (core, other_core)))

    __rmul__ = __mul__

    def __truediv__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Number):
            return NotImplemented
        return self * _inverse(_number(other))

    def __rtruediv__(self, other: Number | int) -> Number:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return _inverse(self) * other

    def __pow__(self, exponent: int) -> Number:
        if exponent < 0:
            return _inverse(self) ** -exponent
        result: Number = natural_power(self, exponent)
        return result

    def __float__(self) -> float:
        return float(self.evaluate(30))

    def __bool__(self) -> bool:
        return not is_zero(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, int | Number):
            return NotImplemented
        return self is other or is_zero(self - other)

    def __hash__(self) -> int:
        # A number that equals a fraction or a sum of roots must hash like it.
        with _mpmath().workdps(EQUALITY_DIGITS):
            value = self.evaluate(EQUALITY_DIGITS)
            if abs(value) < 10**15:
                digits = int(_mpmath().nint(value * 10**40))
                near = Fraction(digits, 10**40).limit_denominator(10**15)
                if self == near:
                    return hash(near)
            return hash(float(value))

    def _sign_of_difference(self, other: Number | int) -> int:
        return sign(self - other)

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


def _expression_of_sums(operation: str, left: Surd, right: Surd) -> Irrational:
    """The sum or product of sums of roots that share no field of a small degree."""
    return Irrational(
        operation, (left, right if operation == "+" else Irrational("exact", (right,)))
    )


Surd.make_expression = staticmethod(_expression_of_sums)

# Numbers that are known exactly, and numbers.
Exact = Fraction | Surd
Number = Fraction | Surd | Irrational


class ComplexNumber(NamedTuple):
    """A complex number, exact; not a `Number`, all of which are real."""

    real: Number
    imaginary: Number

    def __complex__(self) -> complex:
        """The nearest complex double."""
        return complex(float(self.real), float(self.imaginary))

    def __str__(self) -> str:
        """The number in the grammar of `nag.algebra.expression`; ``I`` is the imaginary unit."""
        size = number_text(self.imaginary)
        sign, size = ("-", size[1:]) if size.startswith("-") else ("+", size)
        size = f"({size})" if " " in size else size
        unit = "I" if size == "1" else f"{size}*I"
        if is_zero(self.real):
            return unit if sign == "+" else f"-{unit}"
        return f"{number_text(self.real)} {sign} {unit}"


PI = Irrational("pi")


def _number(value: Number | int) -> Number:
    return Fraction(value) if isinstance(value, int) else value


def _split(value: Number) -> tuple[Exact, Irrational | None]:
    """``value`` as an exact factor and what it multiplies (nothing, for an exact number)."""
    if not isinstance(value, Irrational):
        return value, None
    if value.operation == "neg":
        factor, core = _split(value.arguments[0])
        return -factor, core
    if value.operation == "*" and not isinstance(value.arguments[0], Irrational):
        return value.arguments[0], value.arguments[1]
    return Fraction(1), value


def _times(factor: Exact, core: Irrational | None) -> Number:
    if core is None or factor == 0:
        return factor
    if factor == 1:
        return core
    if factor == -1:
        return Irrational("neg", (core,))
    return Irrational("*", (factor, core))


def _are_alike(left: Number, right: Number) -> bool:
    """Whether two expressions are written the same way."""
    if left is right:
        return True
    if not isinstance(left, Irrational):
        return not isinstance(right, Irrational) and left == right
    if not isinstance(right, Irrational):
        return False
    return left.operation == right.operation and all(
        map(_are_alike, left.arguments, right.arguments)
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
        if isinstance(value, Surd):
            mantissa, exponent = value.binary(_mpmath().mp.prec)
            return _mpmath().ldexp(mantissa, exponent)
        value = Fraction(value)
        return _mpmath().mpf(value.numerator) / value.denominator


def is_zero(value: Number | int) -> bool:
    """Whether ``value`` is zero: exactly, of an expression to `EQUALITY_DIGITS`."""
    if isinstance(value, Irrational):
        return value.evaluate(EQUALITY_DIGITS) == 0
    return not value


def sign(value: Number | int) -> int:
    """1, 0 or -1."""
    if isinstance(value, Surd):
        return value.sign()
    if isinstance(value, Irrational):
        return int(_mpmath().sign(value.evaluate(EQUALITY_DIGITS)))
    return (value > 0) - (value < 0)


def square_root(value: Number | int) -> Number:
    """The non-negative square root, exact where it is a sum of rational multiples of roots.

    Raises:
        ValueError: if ``value`` is negative.
    """
    value = _number(value)
    if value < 0:
        raise NagError("square root of a negative number")
    root: Number | None = None
    if isinstance(value, Fraction):
        root = root_of_fraction(value)
    elif isinstance(value, Surd):
        root = root_of_surd(value)
    return Irrational("sqrt", (value,)) if root is None else root


def pi_multiple(value: Number) -> Fraction | None:
    """The fraction ``q`` with ``value = q*pi`` if the expression shows one, else None."""
    factor, core = _split(value)
    if factor == 0:
        return Fraction(0)
    if core is None or not isinstance(factor, Fraction):
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
    """The sine, exact where `cosine` is."""
    value = _number(value)
    turns = pi_multiple(value)
    if turns is None:
        return Irrational("sin", (_bounded_angle(value),))
    turns %= 2
    if turns >= 1:
        return -sine(_times_pi(turns - 1))
    acute = min(turns, 1 - turns)
    found = cosine_of_turns(Fraction(1, 4) - acute / 2)
    return Irrational("sin", (_times_pi(acute),)) if found is None else normal_sum(found)


def cosine(value: Number | int) -> Number:
    """The cosine, exact at rational turns whose cosines have small degrees."""
    value = _number(value)
    turns = pi_multiple(value)
    if turns is None:
        return Irrational("cos", (_bounded_angle(value),))
    return sine(_times_pi(turns + Fraction(1, 2)))


def _times_pi(factor: Fraction) -> Number:
    return _times(factor, PI)


def number_text(value: Number | complex) -> str:
    """``value`` as text in the grammar of `nag.algebra.expression`; ``I`` is the imaginary unit."""
    if isinstance(value, complex):
        size = f"{abs(value.imag):.17g}"
        unit = "I" if size == "1" else f"{size}*I"
        if not value.real:
            return f"-{unit}" if value.imag < 0 else unit
        return f"{value.real:.17g} {'-' if value.imag < 0 else '+'} {unit}"
    if not isinstance(value, Irrational):
        return str(value)
    if value.operation == "pi":
        return "pi"
    texts = [number_text(a) for a in value.arguments]
    if value.operation == "neg":
        return f"(-{texts[0]})"
    if value.operation == "exact":
        return texts[0]
    if value.operation in ("+", "*", "/"):
        left, right = (f"({t})" if "/" in t or t.startswith("-") else t for t in texts)
        return f"({left}{value.operation}{right})"
    return f"{value.operation}({texts[0]})"


def inexact_parts(value: Number | complex) -> list[Irrational]:
    """The parts of a number's expression that are not known exactly, as ``cos(1)``.

    >>> from nag.algebra.expression import parse_number
    >>> [number_text(part) for part in inexact_parts(parse_number("2 + 3*cos(1)*sqrt(2)"))]
    ['cos(1)']
    """
    if not isinstance(value, Irrational):
        return []
    if value.operation in ("+", "*", "/", "neg", "exact"):
        return [part for a in value.arguments for part in inexact_parts(a)]
    return [value]


def brief_number_text(value: Number) -> str:
    """``value`` as `number_text` gives it, to six digits where that is longer than 40 letters."""
    text = number_text(value)
    if len(text) <= 40:
        return text
    import mpmath

    with mpmath.workdps(20):
        return str(mpmath.nstr(to_mpf(value, 20), 6))


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
    mantissa, exponent = binary(value, digits)
    return mantissa * Fraction(2) ** exponent


def binary(value: Surd | Irrational, digits: int) -> tuple[int, int]:
    """Integers m and k, for which ``m 2^k`` has at least so many digits in common with it."""
    if isinstance(value, Surd):
        return value.binary(int(digits * 3.33) + 4)
    negative, mantissa, exponent, _ = to_mpf(value, digits)._mpf_
    return int(-mantissa if negative else mantissa), int(exponent)


def decimal_text(value: Number, digits: int) -> str:
    """An irrational number to so many digits, a rational one as it is."""
    if isinstance(value, Fraction):
        return number_text(value)
    import mpmath

    mantissa, exponent = binary(value, digits)
    with mpmath.workdps(digits + 5):
        return str(mpmath.nstr(mpmath.ldexp(mantissa, exponent), digits, strip_zeros=False))
