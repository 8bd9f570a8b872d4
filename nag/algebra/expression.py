"""Numbers and polynomials written as text, read by a grammar of our own.

    equation := sum [ "=" sum ]
    sum      := product { ("+" | "-") product }
    product  := signed { ("*" | "/") signed }
    signed   := { "+" | "-" } power
    power    := atom [ ("^" | "**") signed ]
    atom     := number | name | function "(" sum ")" | "(" sum ")"

Numbers are exact: ``0.1`` is 1/10. Functions (``sqrt``, ``sin``, ``cos``) and divisors are
constants, exponents are whole numbers. Nothing is evaluated as code, and what an expression may
cost is bounded before it is spent.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from math import log10
from typing import NoReturn

import mpmath

from nag.algebra.number import PI, Irrational, Number, cosine, is_zero, sine, square_root
from nag.algebra.polynomial import Exponents, Polynomial

MAX_LENGTH = 100_000
MAX_NESTING = 50
MAX_DEGREE = 1_000
MAX_TERMS = 10_000
MAX_BITS = 4_000
MAX_IRRATIONAL_SIZE = 200
# Coefficients and parameters end within this range, the binary logarithm of what a double holds.
MAX_LOG2 = 1_000
# Elementary operations on coefficients: a few microseconds each.
MAX_WORK = 100_000

FUNCTIONS: Mapping[str, Callable[[Number], Number]] = {
    "sqrt": square_root,
    "sin": sine,
    "cos": cosine,
}
RESERVED = frozenset(FUNCTIONS) | {"pi"}

_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)"
    r"|(?P<operator>\*\*|==|[-+*/^()=])"
)
_SPACE = re.compile(r"\s*")
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")


class ExpressionError(ValueError):
    """Text that is no number or polynomial; one line: where, what is wrong, what would be right."""


@dataclass
class Budget:
    """Work that expressions may still cost, shared by all expressions of a file."""

    left: int = MAX_WORK

    def spend(self, amount: int) -> bool:
        """Take ``amount`` away; False if it is not there."""
        self.left -= amount
        return self.left >= 0


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    column: int


@dataclass(frozen=True)
class _Reader:
    """What an expression is read with: names and limits."""

    variables: Mapping[str, int]
    parameters: Mapping[str, Number]
    budget: Budget = field(default_factory=Budget)


def names_in(text: str) -> frozenset[str]:
    """Names that occur in ``text``, none if it is no expression at all."""
    try:
        return frozenset(t.text for t in _tokens(text) if t.kind == "name") - RESERVED
    except ExpressionError:
        return frozenset()


def is_name(text: str) -> bool:
    """Whether ``text`` can name a variable or a parameter."""
    return len(text) <= 100 and _NAME.fullmatch(text) is not None and text not in RESERVED


def nearest(name: str, known: Iterable[str]) -> str:
    """`` (did you mean ...?)`` with the nearest of the known names, or nothing."""
    match = difflib.get_close_matches(name[:100], sorted(known), n=1, cutoff=0.5)
    return f" (did you mean {match[0]!r}?)" if match else ""


def quote(text: str, width: int = 40) -> str:
    """``text`` in quotes on one line, shortened."""
    return repr(text if len(text) <= width else text[: width - 3] + "...")


def parse_number(
    value: str | int | float | Decimal | Number,
    parameters: Mapping[str, Number] | None = None,
    budget: Budget | None = None,
) -> Number:
    """The exact number that ``value`` is or spells.

    Decimals and floats are taken as they are written in base ten: 0.1 is 1/10.

    Raises:
        ExpressionError: if it spells no real number, or one too large to work with.
    """
    if isinstance(value, bool) or not isinstance(
        value, str | int | float | Decimal | Fraction | Irrational
    ):
        raise ExpressionError(f"{_kind(value)} is no number; write a number or an expression")
    if isinstance(value, str):
        return _Parser(value, _Reader({}, parameters or {}, budget or Budget())).number()
    if isinstance(value, Irrational):
        return value
    if isinstance(value, float | Decimal):
        value = _decimal(Decimal(repr(value)) if isinstance(value, float) else value)
    number = Fraction(value)
    if _bits(number) > MAX_BITS:
        raise ExpressionError(
            f"the number has too many digits ({_digits(number)}); at most {_MAX_DIGITS} are read"
        )
    return _representable(number)


def parse_polynomial(
    text: str,
    variables: Sequence[str],
    parameters: Mapping[str, Number] | None = None,
    budget: Budget | None = None,
) -> Polynomial:
    """The polynomial in ``variables`` that ``text`` spells; ``lhs = rhs`` stands for lhs - rhs.

    Raises:
        ExpressionError: if it spells none, or one beyond the limits of this module.
    """
    names = {name: i for i, name in enumerate(variables)}
    return _Parser(text, _Reader(names, parameters or {}, budget or Budget())).polynomial()


_MAX_DIGITS = int(MAX_BITS * log10(2))


def _kind(value: object) -> str:
    names = {bool: "a truth value", list: "a list", dict: "a table", type(None): "nothing"}
    return names.get(type(value), f"a value of type {type(value).__name__}")


def _bits(value: Number) -> int:
    if isinstance(value, Irrational):
        return max((_bits(a) for a in value.arguments), default=1)
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def _operations(value: Number | Polynomial) -> int:
    """Size of the largest irrational number in ``value``."""
    if isinstance(value, Polynomial):
        return max((_operations(c) for c in value.terms.values()), default=0)
    return value.size if isinstance(value, Irrational) else 0


def _representable(value: Number) -> Number:
    if isinstance(value, Irrational):
        near = abs(value.evaluate(15))
        size = int(mpmath.log(near, 2)) if near else 0
    else:
        size = value.numerator.bit_length() - value.denominator.bit_length()
    if value and abs(size) > MAX_LOG2:
        raise ExpressionError(
            f"a number of the order 1e{int(size * log10(2))} arises; "
            "scale the numbers so that they stay between 1e-300 and 1e300"
        )
    return value


def _digits(value: Fraction) -> int:
    return int(_bits(value) * log10(2)) + 1


def _decimal(value: Decimal) -> Fraction:
    if not value.is_finite():
        raise ExpressionError(f"{value} is no number; write a finite number")
    _, digits, exponent = value.as_tuple()
    if len(digits) + abs(int(exponent)) > _MAX_DIGITS:
        raise ExpressionError(
            f"{quote(str(value))} has too many digits; at most {_MAX_DIGITS} are read"
        )
    return Fraction(value)


def _tokens(text: str) -> list[_Token]:
    if len(text) > MAX_LENGTH:
        raise ExpressionError(
            f"the expression is {len(text)} characters long; at most {MAX_LENGTH} are read"
        )
    tokens, at = [], _SPACE.match(text).end()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise ExpressionError(
                f"column {at + 1}: {quote(text[at])} has no meaning here; "
                "write numbers, names, + - * / ^ and parentheses"
            )
        tokens.append(_Token(str(match.lastgroup), match.group(), at + 1))
        at = _SPACE.match(text, match.end()).end()
    tokens.append(_Token("end", "", len(text) + 1))
    return tokens


class _Parser:
    """Recursive descent over the tokens; constants stay numbers until they meet a variable."""

    def __init__(self, text: str, reader: _Reader) -> None:
        self.tokens = _tokens(text)
        self.at = 0
        self.depth = 0
        self.reader = reader
        self.n = len(reader.variables)

    def number(self) -> Number:
        value = self._sum()
        self._finish("")
        return _representable(value)

    def polynomial(self) -> Polynomial:
        value = self._sum()
        if self.token.text == "=":
            self._next()
            right = self._sum()
            value = self._add([(1, value, self.token), (-1, right, self.token)])
        self._finish(" or one '='")
        if not isinstance(value, Polynomial):
            value = Polynomial.constant(self.n, value)
        for c in value.terms.values():
            _representable(c)
        return value

    @property
    def token(self) -> _Token:
        return self.tokens[self.at]

    def _next(self) -> _Token:
        self.at += 1
        return self.tokens[self.at - 1]

    def _fail(self, token: _Token, message: str) -> NoReturn:
        raise ExpressionError(f"column {token.column}: {message}")

    def _spend(self, amount: int, token: _Token) -> None:
        if not self.reader.budget.spend(amount):
            self._fail(
                token,
                f"multiplying this out takes more than {MAX_WORK} operations; "
                "introduce variables for its parts",
            )

    def _finish(self, equation: str) -> None:
        token = self.token
        if token.kind == "end":
            return
        if token.text == ")":
            self._fail(token, "')' without its '('")
        if token.text == "==":
            self._fail(token, "'==' has no meaning here; write a single '='")
        if token.text == "=":
            hint = (
                "leave out all but one '='" if equation else "write the number alone, without '='"
            )
            self._fail(token, f"'=' has no meaning here; {hint}")
        before = self.tokens[self.at - 1]
        if before.kind == "name" and token.text == "(":
            self._fail(
                before,
                f"{quote(before.text)} is not a function"
                f"{nearest(before.text, FUNCTIONS)}; write '*' for a product",
            )
        self._fail(
            token,
            f"{quote(token.text)} follows {quote(before.text)}; "
            "write '*' between them for a product",
        )

    def _sum(self) -> Number | Polynomial:
        parts = []
        sign = 1
        while True:
            parts.append((sign, self._product(), self.tokens[self.at - 1]))
            if self.token.text not in ("+", "-"):
                break
            sign = 1 if self._next().text == "+" else -1
        if len(parts) == 1:
            return parts[0][1]
        return self._add(parts)

    def _add(self, parts: list[tuple[int, Number | Polynomial, _Token]]) -> Number | Polynomial:
        if not any(isinstance(value, Polynomial) for _, value, _ in parts):
            total: Number = Fraction(0)
            for sign, value, token in parts:
                self._spend(1 + 10 * _operations(total) + 10 * _operations(value), token)
                total = self._checked(total + value if sign > 0 else total - value, token)
            return total
        terms: dict[Exponents, Number] = {}
        constant = (0,) * self.n
        for sign, value, token in parts:
            added = value.terms if isinstance(value, Polynomial) else {constant: value}
            self._spend(len(added) * (1 + self.n // 50 + 10 * _operations(value)), token)
            for e, c in added.items():
                c = c if sign > 0 else -c
                terms[e] = self._checked(terms[e] + c, token) if e in terms else c
            if len(terms) > MAX_TERMS:
                self._fail(token, f"more than {MAX_TERMS} terms; split the equation")
        return Polynomial(self.n, terms)

    def _product(self) -> Number | Polynomial:
        value = self._signed()
        while self.token.text in ("*", "/"):
            operator = self._next()
            right = self._signed()
            value = (
                self._divide(value, right, operator)
                if operator.text == "/"
                else self._multiply(value, right, operator)
            )
        return value

    def _multiply(
        self, left: Number | Polynomial, right: Number | Polynomial, token: _Token
    ) -> Number | Polynomial:
        for value in (left, right):
            if isinstance(value, Polynomial) and not value:
                return value
        sizes = [len(v.terms) if isinstance(v, Polynomial) else 1 for v in (left, right)]
        bits = sum(self._bits(v) for v in (left, right))
        each = 1 + self.n // 50 + bits // 500 + 10 * sum(_operations(v) for v in (left, right))
        self._spend(sizes[0] * sizes[1] * each, token)
        if bits > MAX_BITS:
            self._too_long(bits, token)
        if isinstance(left, Polynomial) and isinstance(right, Polynomial):
            degree = left.degree + right.degree
            if degree > MAX_DEGREE:
                self._fail(
                    token, f"degree {degree} is too high; at most {MAX_DEGREE} is worked with"
                )
        elif isinstance(left, Polynomial) or isinstance(right, Polynomial):
            return left * right
        else:
            return self._checked(left * right, token)
        product = left * right
        if len(product.terms) > MAX_TERMS:
            self._fail(token, f"more than {MAX_TERMS} terms; split the equation")
        return product

    def _divide(
        self, left: Number | Polynomial, right: Number | Polynomial, token: _Token
    ) -> Number | Polynomial:
        if isinstance(right, Polynomial):
            self._fail(
                token, "the divisor contains a variable; multiply the equation by it instead"
            )
        if is_zero(right):
            self._fail(token, "division by zero; write a divisor that is not zero")
        return self._multiply(left, 1 / right, token)

    def _signed(self) -> Number | Polynomial:
        sign = 1
        while self.token.text in ("+", "-"):
            sign = sign if self._next().text == "+" else -sign
        value = self._power()
        return value if sign > 0 else -value

    def _power(self) -> Number | Polynomial:
        base = self._atom()
        if self.token.text not in ("^", "**"):
            return base
        token = self._next()
        self._descend(token)
        exponent = self._signed()
        self.depth -= 1
        if isinstance(exponent, Polynomial) or not isinstance(exponent, Fraction):
            self._fail(token, "the exponent is not a whole number; write a whole number")
        if exponent.denominator != 1:
            self._fail(token, f"the exponent {exponent} is not whole; write sqrt(...) for a root")
        return self._raise(base, int(exponent), token)

    def _raise(
        self, base: Number | Polynomial, exponent: int, token: _Token
    ) -> Number | Polynomial:
        shown = quote(str(exponent)) if abs(exponent) < 10**30 else "with more than 30 digits"
        if isinstance(base, Polynomial):
            if exponent < 0:
                self._fail(
                    token, "a variable has no negative power; write a whole number from 0 up"
                )
            if exponent * max(base.degree, 1) > MAX_DEGREE:
                self._fail(
                    token, f"the exponent {shown} is too large; degrees go up to {MAX_DEGREE}"
                )
            power: Number | Polynomial = Polynomial.constant(self.n, 1)
            for _ in range(exponent):
                power = self._multiply(power, base, token)
            return power
        if exponent < 0 and is_zero(base):
            self._fail(token, "zero has no negative power; division by zero")
        if isinstance(base, Fraction) and base in (0, 1, -1):
            return base ** (exponent % 2 + 2) if exponent else Fraction(1)
        if abs(exponent) * self._bits(base) > MAX_BITS:
            self._fail(
                token,
                f"the exponent {shown} is too large: the result has more than "
                f"{_MAX_DIGITS} digits; write a smaller one",
            )
        if isinstance(base, Fraction):
            return base**exponent
        factor = base if exponent > 0 else 1 / base
        power = Fraction(1)
        for _ in range(abs(exponent)):
            power = self._multiply(power, factor, token)
        return power

    def _atom(self) -> Number | Polynomial:
        token = self._next()
        if token.kind == "number":
            return self._literal(token)
        if token.kind == "name":
            if token.text in FUNCTIONS:
                return self._call(token)
            return self._named(token)
        if token.text == "(":
            return self._closed(token)
        if token.kind == "end":
            self.at -= 1
            if self.at == 0:
                raise ExpressionError("the expression is empty; write a number or a polynomial")
            self._fail(token, f"something is missing after {quote(self.tokens[self.at - 1].text)}")
        if token.text == ")" and self.tokens[max(self.at - 2, 0)].text == "(":
            self._fail(token, "empty parentheses; write something between them")
        self._fail(token, f"{quote(token.text)} where a number, a name or '(' is expected")

    def _descend(self, token: _Token) -> None:
        self.depth += 1
        if self.depth > MAX_NESTING:
            self._fail(token, f"nested more than {MAX_NESTING} deep; name the parts as parameters")

    def _closed(self, token: _Token) -> Number | Polynomial:
        self._descend(token)
        value = self._sum()
        self.depth -= 1
        if self.token.text != ")":
            if self.token.kind == "end":
                self._fail(token, "'(' is never closed; write its ')'")
            self._finish("")
        self._next()
        return value

    def _call(self, name: _Token) -> Number:
        if self.token.text != "(":
            self._fail(name, f"{name.text} needs its argument in parentheses: {name.text}(...)")
        value = self._closed(self._next())
        if isinstance(value, Polynomial):
            self._fail(
                name, f"{name.text} of a variable is not polynomial; its argument is constant"
            )
        try:
            return self._checked(FUNCTIONS[name.text](value), name)
        except ValueError as error:
            if isinstance(error, ExpressionError):
                raise
            self._fail(name, f"{error} ({quote(str(value))}); write one that is not negative")

    def _named(self, token: _Token) -> Number | Polynomial:
        name = token.text
        if name in self.reader.variables:
            return Polynomial.variable(self.n, self.reader.variables[name])
        if name in self.reader.parameters:
            return self.reader.parameters[name]
        if name == "pi":
            return PI
        if self.token.text == "(":
            self._fail(token, f"{quote(name)} is not a function; functions are sqrt, sin and cos")
        known = [*self.reader.variables, *self.reader.parameters]
        listed = ", ".join(known[:12]) + (", ..." if len(known) > 12 else "") or "none"
        kinds = "variables and parameters" if self.reader.variables else "parameters"
        self._fail(token, f"unknown name {quote(name)}{nearest(name, known)}; {kinds}: {listed}")

    def _literal(self, token: _Token) -> Fraction:
        mantissa, _, exponent = token.text.lower().partition("e")
        places = len(mantissa) + (
            int(exponent.lstrip("+-")) if len(exponent) < 9 and exponent else 0
        )
        if len(exponent) >= 9 or places > _MAX_DIGITS:
            self._fail(
                token,
                f"the number {quote(token.text)} has too many digits; "
                f"at most {_MAX_DIGITS} are read",
            )
        return Fraction(token.text)

    @staticmethod
    def _bits(value: Number | Polynomial) -> int:
        if isinstance(value, Polynomial):
            return max((_bits(c) for c in value.terms.values()), default=1)
        return _bits(value)

    def _checked(self, value: Number, token: _Token) -> Number:
        if _bits(value) > MAX_BITS:
            self._too_long(_bits(value), token)
        if isinstance(value, Irrational) and value.size > MAX_IRRATIONAL_SIZE:
            self._fail(
                token,
                f"an irrational number of more than {MAX_IRRATIONAL_SIZE} operations; "
                "write a simpler one",
            )
        return value

    def _too_long(self, bits: int, token: _Token) -> NoReturn:
        self._fail(
            token,
            f"a number of about {int(bits * log10(2)) + 1} digits arises; "
            f"at most {_MAX_DIGITS} are worked with",
        )
