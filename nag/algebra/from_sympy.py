"""Numbers and polynomials from sympy's expressions, read without importing sympy.

Only whoever has loaded sympy can have such an expression; it is walked from its root down, and
nothing of it is evaluated or expanded by sympy.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

from nag.algebra.bounded import BoundedArithmetic, Budget, Value, check_size
from nag.algebra.expression import parse_number
from nag.algebra.number import PI, cosine, sine, square_root
from nag.algebra.polynomial import Polynomial
from nag.algebra.tokens import ONLY_REAL, ExpressionError, quote

# Horner forms nest once for each degree.
MAX_NESTING = 200
# Of so many bits is a double; sympy's numbers of more are taken as they are written.
DOUBLE_BITS = 53


def is_sympy(value: object) -> bool:
    """Whether ``value`` is an expression, equation, polynomial or number of sympy's."""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(value, sympy.Basic)


def symbol_names(value: Any) -> dict[str, Any]:
    """The symbols in an expression by their names.

    Raises:
        ExpressionError: if two of them have the same name.
    """
    found: dict[str, Any] = {}
    for symbol in value.free_symbols:
        if found.setdefault(str(symbol), symbol) != symbol:
            raise ExpressionError(symbols_text(str(symbol)))
    return found


def symbols_text(name: str) -> str:
    """What to say where two symbols have one name."""
    return (
        f"two symbols are named {quote(name)}, with different assumptions; use one of them "
        "throughout"
    )


def sympy_value(
    value: Any,
    known: Mapping[str, Value],
    n: int,
    budget: Budget,
    unit: Polynomial | None = None,
) -> Value:
    """The number or polynomial in ``n`` variables that an expression stands for.

    An equation ``Eq(lhs, rhs)`` stands for ``lhs - rhs``.

    Args:
        known: what the symbols stand for, by name.
        unit: what the imaginary unit stands for, if it may occur.

    Raises:
        ExpressionError: if it stands for none, or one beyond the limits of `nag.algebra.bounded`.
    """
    sympy = sys.modules["sympy"]
    walk = _Walk(sympy, known, BoundedArithmetic(n, budget), unit)
    if isinstance(value, sympy.Poly):
        value = value.as_expr()
    if isinstance(value, sympy.Equality):
        sides = walk.value(value.lhs, 0), walk.value(value.rhs, 0)
        return walk.arithmetic.add([(1, sides[0]), (-1, sides[1])])
    if value in (sympy.true, sympy.false):
        if value == sympy.true:
            raise ExpressionError("the equation always holds, as sympy says; leave it out")
        raise ExpressionError(
            "the equation never holds, as sympy says, so there is no solution; correct it"
        )
    return walk.value(value, 0)


@dataclass(frozen=True)
class _Walk:
    """The way down an expression."""

    sympy: Any
    known: Mapping[str, Value]
    arithmetic: BoundedArithmetic
    unit: Polynomial | None

    def value(self, e: Any, depth: int) -> Value:
        sympy, arithmetic = self.sympy, self.arithmetic
        arithmetic.budget.spend(1)
        if depth > MAX_NESTING:
            raise ExpressionError(f"nested more than {MAX_NESTING} deep; expand the expression")
        if isinstance(e, sympy.Symbol):
            return self._find_symbol(str(e))
        if isinstance(e, sympy.Rational):
            return check_size(Fraction(int(e.p), int(e.q)))
        if isinstance(e, sympy.Float):
            return parse_number(float(e) if e._prec <= DOUBLE_BITS else Decimal(str(e)))
        if e == sympy.pi:
            return PI
        if isinstance(e, sympy.Add):
            return arithmetic.add([(1, self.value(a, depth + 1)) for a in e.args])
        if isinstance(e, sympy.Mul):
            product: Value = Fraction(1)
            for factor in e.args:
                product = arithmetic.multiply(product, self.value(factor, depth + 1))
            return product
        if isinstance(e, sympy.Pow):
            return self._power(e, depth)
        if isinstance(e, sympy.sin | sympy.cos):
            angle = self.value(e.args[0], depth + 1)
            if isinstance(angle, Polynomial):
                raise ExpressionError(
                    f"{quote(str(e))} is no polynomial; make the sine and the cosine variables "
                    "c and s with c^2 + s^2 = 1"
                )
            return check_size(sine(angle) if isinstance(e, sympy.sin) else cosine(angle))
        if e == sympy.I and self.unit is not None:
            return self.unit
        if e == sympy.I:
            raise ExpressionError(f"it holds sympy's I; {ONLY_REAL}")
        if e == sympy.nan or e.is_infinite:
            raise ExpressionError(
                f"{quote(str(e))} is no finite real number; coefficients are finite and real"
            )
        raise ExpressionError(
            f"{quote(str(e))} is no polynomial; write sums, products and whole powers of symbols, "
            "and constants with sqrt, sin, cos and pi"
        )

    def _power(self, e: Any, depth: int) -> Value:
        base, exponent = (self.value(a, depth + 1) for a in e.args)
        half = isinstance(exponent, Fraction) and exponent.denominator == 2
        if half and not isinstance(base, Polynomial):
            base, exponent = check_size(square_root(base)), 2 * exponent
        return self.arithmetic.power(base, exponent)

    def _find_symbol(self, name: str) -> Value:
        if name in self.known:
            return self.known[name]
        listed = ", ".join(list(self.known)[:12]) or "none"
        raise ExpressionError(f"unknown symbol {quote(name)}; known are: {listed}")
