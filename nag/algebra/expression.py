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

from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from numbers import Complex, Real
from typing import Any, NoReturn

from nag.algebra.bounded import (
    MAX_DIGITS,
    BoundedArithmetic,
    Budget,
    Value,
    check_size,
    representable,
)
from nag.algebra.number import (
    PI,
    Irrational,
    Number,
    Surd,
    cosine,
    is_zero,
    sine,
    square_root,
)
from nag.algebra.polynomial import Polynomial
from nag.algebra.tokens import (
    IMAGINARY_UNITS,
    ONLY_REAL,
    PI_NAMES,
    ExpressionError,
    Token,
    imaginary_text,
    nearest,
    quote,
    root_text,
    tokenize,
)

__all__ = ["ExpressionError", "parse_number", "parse_polynomial"]

MAX_NESTING = 50

_FUNCTIONS: Mapping[str, Callable[[Number], Number]] = {
    "sqrt": square_root,
    "sin": sine,
    "cos": cosine,
}


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
    if isinstance(value, str):
        return _Parser(value, (), parameters or {}, budget or Budget()).number()
    if isinstance(value, Surd | Irrational):
        return value
    if not isinstance(value, Real | Decimal) and isinstance(value, Complex):
        raise ExpressionError(f"{value} is complex; {ONLY_REAL}")
    if isinstance(value, bool) or not isinstance(value, int | float | Decimal | Fraction):
        raise ExpressionError(f"{_kind(value)} is no number; write a number or an expression")
    if isinstance(value, float | Decimal):
        value = _decimal(Decimal(repr(float(value))) if isinstance(value, float) else value)
    return representable(check_size(Fraction(value)))


def parse_polynomial(
    text: str,
    variables: Sequence[str],
    parameters: Mapping[str, Value] | None = None,
    budget: Budget | None = None,
    *,
    unit: str | None = None,
) -> Polynomial:
    """The polynomial in ``variables`` that ``text`` spells; ``lhs = rhs`` stands for lhs - rhs.

    Args:
        parameters: numbers, or polynomials in the same variables, by name.
        unit: the variable that is the imaginary unit; numbers with it are divisors, too.

    Raises:
        ExpressionError: if it spells none, or one beyond the limits of `nag.algebra.bounded`.
    """
    return _Parser(text, variables, parameters or {}, budget or Budget(), unit).polynomial()


def _kind(value: object) -> str:
    names = {bool: "a truth value", list: "a list", dict: "a table", type(None): "nothing"}
    return names.get(type(value), f"a value of type {type(value).__name__}")


def _decimal(value: Decimal) -> Fraction:
    if not value.is_finite():
        raise ExpressionError(f"{value} is no number; write a finite number")
    _, digits, exponent = value.as_tuple()
    if len(digits) + abs(int(exponent)) > MAX_DIGITS:
        _too_many_digits(str(value))
    return Fraction(value)


def _too_many_digits(text: str) -> NoReturn:
    raise ExpressionError(
        f"the number {quote(text)} has too many digits; at most {MAX_DIGITS} are read"
    )


class _Parser:
    """Recursive descent over the tokens."""

    def __init__(
        self,
        text: str,
        variables: Sequence[str],
        parameters: Mapping[str, Value],
        budget: Budget,
        unit: str | None = None,
    ) -> None:
        self.text, self.tokens = text, tokenize(text)
        budget.spend(len(self.tokens))
        self.at = 0
        self.depth = 0
        self.variables = {name: i for i, name in enumerate(variables)}
        self.parameters = parameters
        place = None if unit is None else self.variables[unit]
        self.arithmetic = BoundedArithmetic(len(variables), budget, place)

    def number(self) -> Number:
        value = self._sum()
        self._finish("write the number alone, without '='")
        return representable(value)

    def polynomial(self) -> Polynomial:
        value = self._sum()
        if self.token.text == "=":
            equals = self._next()
            value = self._apply(equals, self.arithmetic.add, [(1, value), (-1, self._sum())])
        self._finish("leave out all but one '='")
        if not isinstance(value, Polynomial):
            value = Polynomial.constant(len(self.variables), value)
        for coefficient in value.terms.values():
            representable(coefficient)
        return value

    @property
    def token(self) -> Token:
        return self.tokens[self.at]

    def _next(self) -> Token:
        self.at += 1
        return self.tokens[self.at - 1]

    def _fail(self, token: Token, message: str) -> NoReturn:
        raise ExpressionError(message, token.column)

    def _apply(self, token: Token, operation: Callable[..., Value], *arguments: Any) -> Value:
        try:
            return operation(*arguments)
        except ExpressionError as error:
            self._fail(token, str(error))

    def _finish(self, instead_of_equals: str) -> None:
        token = self.token
        if token.kind == "end":
            return
        if token.text == ")":
            self._fail(token, "')' without its '('; write both or none")
        if token.text == "==":
            self._fail(token, "'==' has no meaning here; write a single '='")
        if token.text == "=":
            self._fail(token, f"'=' has no meaning here; {instead_of_equals}")
        before = self.tokens[self.at - 1]
        if "\n" in self.text[before.column : token.column]:
            self._fail(token, f"{quote(token.text)} begins another line; write one equation a text")
        if before.kind == "name" and token.text == "(":
            self._fail(
                before,
                f"{quote(before.text)} is not a function"
                f"{nearest(before.text, _FUNCTIONS)}; write '*' for a product",
            )
        if before.kind == "number" and token.text in IMAGINARY_UNITS:
            text = before.text + token.text
            self._fail(before, imaginary_text(text, "write '*' for a product"))
        self._fail(
            token,
            f"{quote(token.text)} follows {quote(before.text)}; "
            "write '*' between them for a product",
        )

    def _sum(self) -> Value:
        first = self.token
        parts = [(1, self._product())]
        while self.token.text in ("+", "-"):
            sign = 1 if self._next().text == "+" else -1
            parts.append((sign, self._product()))
        return parts[0][1] if len(parts) == 1 else self._apply(first, self.arithmetic.add, parts)

    def _product(self) -> Value:
        value = self._read_signed()
        while self.token.text in ("*", "/"):
            operator = self._next()
            times = self.arithmetic.multiply if operator.text == "*" else self.arithmetic.divide
            value = self._apply(operator, times, value, self._read_signed())
        return value

    def _read_signed(self) -> Value:
        sign = 1
        while self.token.text in ("+", "-"):
            sign = sign if self._next().text == "+" else -sign
        value = self._power()
        return value if sign > 0 else -value

    def _power(self) -> Value:
        base = self._atom()
        if self.token.text not in ("^", "**"):
            return base
        operator = self._next()
        self._descend(operator)
        exponent = self._read_signed()
        self.depth -= 1
        return self._apply(operator, self.arithmetic.power, base, exponent)

    def _atom(self) -> Value:
        token = self._next()
        if token.kind == "number":
            return self._literal(token)
        if token.kind == "name":
            return self._call(token) if token.text in _FUNCTIONS else self._read_name(token)
        if token.text == "(":
            return self._read_parentheses(token)
        if token.kind == "end" and self.at == 1:
            raise ExpressionError("the expression is empty; write a number or a polynomial")
        before = self.tokens[self.at - 2]
        if token.kind == "end":
            self._fail(token, f"something is missing after {quote(before.text)}; write it")
        if token.text == ")" and before.text == "(":
            self._fail(token, "empty parentheses; write something between them")
        self._fail(token, f"{quote(token.text)} is out of place; write a number, a name or '('")

    def _descend(self, token: Token) -> None:
        self.depth += 1
        if self.depth > MAX_NESTING:
            self._fail(token, f"nested more than {MAX_NESTING} deep; name the parts as parameters")

    def _read_parentheses(self, opening: Token) -> Value:
        self._descend(opening)
        value = self._sum()
        self.depth -= 1
        if self.token.kind == "end" or self.token.text == "=":
            self._fail(opening, "'(' is never closed; write its ')'")
        if self.token.text != ")":
            self._finish("")
        self._next()
        return value

    def _call(self, name: Token) -> Value:
        if self.token.text != "(":
            self._fail(name, f"{name.text} needs parentheses; write {name.text}(...)")
        value = self._read_parentheses(self._next())
        if isinstance(value, Polynomial):
            value = self._real_constant(name, value)
        unit = self.arithmetic.unit
        if name.text == "sqrt" and unit is not None and value < 0:
            root = check_size(square_root(-value))
            return root * Polynomial.variable(len(self.variables), unit)
        try:
            return check_size(_FUNCTIONS[name.text](value))
        except ExpressionError as error:
            self._fail(name, str(error))
        except ValueError as error:
            self._fail(name, f"{error} ({quote(str(value))}); write another one")

    def _real_constant(self, name: Token, value: Polynomial) -> Number:
        """The number that a function is asked of."""
        parts = self.arithmetic.parts(value)
        if parts is None:
            mend = root_text(2)
            if name.text != "sqrt":
                mend = "take a cosine and a sine for variables, with the equation c^2 + s^2 = 1"
            self._fail(name, f"{name.text} of a variable is no polynomial; {mend}")
        if not is_zero(parts[1]):
            mend = "write its value"
            if name.text == "sqrt":
                mend += ", or take a variable s for it, with the equation s^2 = ..., for both roots"
            self._fail(name, f"{name.text} of a complex number is not worked out; {mend}")
        return parts[0]

    def _read_name(self, token: Token) -> Value:
        name = token.text
        if name in self.variables:
            return Polynomial.variable(len(self.variables), self.variables[name])
        if name in self.parameters:
            return self.parameters[name]
        if name in PI_NAMES:
            return PI
        if self.token.text == "(":
            self._fail(token, f"{quote(name)} is not a function; write sqrt, sin or cos")
        if name in IMAGINARY_UNITS:
            mend = f"{ONLY_REAL}; a name of your own goes among the parameters"
            if self.variables:
                mend = f"write imaginary = {name!r} if it is, or list it among the variables"
            self._fail(token, imaginary_text(name, mend))
        known = [*self.variables, *self.parameters]
        kinds = "variables and parameters" if self.variables else "parameters"
        listed = ", ".join(known[:12]) + (", ..." if len(known) > 12 else "") or "none"
        self._fail(
            token, f"unknown name {quote(name)}{nearest(name, known)}; {kinds} here: {listed}"
        )

    def _literal(self, token: Token) -> Fraction:
        if token.text.isdigit() and len(token.text) <= MAX_DIGITS:
            return Fraction(int(token.text))
        mantissa, _, exponent = token.text.lower().partition("e")
        too_long = len(mantissa) + len(exponent) > MAX_DIGITS
        if too_long or len(mantissa) + abs(int(exponent or 0)) > MAX_DIGITS:
            self._apply(token, _too_many_digits, token.text)
        return Fraction(token.text)
