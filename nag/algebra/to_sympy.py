"""Polynomials and points as sympy has them, exact where they are; sympy is imported here alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from nag.algebra.flint_numbers import to_fraction
from nag.algebra.number import Number, Surd, number_text
from nag.algebra.root_basis import Root, is_sine, powers_of, radicand_of
from nag.errors import NagError

if TYPE_CHECKING:
    from nag.algebra.polynomial import Polynomial


def _sympy() -> Any:
    try:
        import sympy
    except ImportError:
        raise NagError("to_sympy: sympy is not installed; pip install sympy") from None
    return sympy


def to_sympy_number(value: Number) -> Any:
    """An exact number as sympy has it."""
    sympy = _sympy()
    if isinstance(value, Fraction):
        return sympy.Rational(value.numerator, value.denominator)
    if isinstance(value, Surd):
        parts = ((r, to_fraction(q)) for r, q in value.terms.items())
        return sympy.Add(*(to_sympy_number(q) * _to_sympy_root(r) for r, q in parts))
    # The text is one that this package wrote: functions, numbers and pi.
    return sympy.sympify(number_text(value).replace("^", "**"))


def _to_sympy_root(root: Root) -> Any:
    """A member of the basis of sums of roots."""
    sympy = _sympy()
    found = sympy.sqrt(radicand_of(root))
    for order, k in powers_of(root):
        angle = 2 * sympy.pi / order
        found *= (4 * sympy.sin(angle) if is_sine(order) else 2 * sympy.cos(angle)) ** k
    return found


def to_sympy_polynomials(
    polynomials: Iterable[Polynomial], names: Sequence[str], imaginary: bool = False
) -> list[Any]:
    """Polynomials as sympy's expressions, in symbols of their variables' names.

    Args:
        imaginary: whether the last variable is the imaginary unit, and becomes sympy's.

    Raises:
        nag.NagError: if sympy is not installed.
    """
    sympy = _sympy()
    symbols = [sympy.Symbol(name) for name in names]
    if imaginary:
        symbols[-1] = sympy.I
    return [
        sympy.Add(
            *(
                to_sympy_number(c)
                * sympy.Mul(*(x**k for x, k in zip(symbols, exponents, strict=True) if k))
                for exponents, c in f.terms.items()
            )
        )
        for f in polynomials
    ]


def to_sympy_point(names: Sequence[str], point: Iterable[complex]) -> dict[Any, Any]:
    """A rounded point: sympy's floats by symbols.

    Raises:
        nag.NagError: if sympy is not installed.
    """
    sympy = _sympy()

    def value(z: complex) -> Any:
        real, imag = sympy.Float(z.real), sympy.Float(z.imag)
        return real + imag * sympy.I if z.imag else real

    return {sympy.Symbol(n): value(complex(z)) for n, z in zip(names, point, strict=True)}
