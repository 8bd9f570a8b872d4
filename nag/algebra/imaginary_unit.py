"""Complex coefficients: the imaginary unit as one more variable, of which one value counts.

A polynomial over Q(i) is one over Q in its variables and ``I``, modulo ``I^2 + 1``. The zeros of a
system with that equation are those with ``I = i`` and those of the conjugate system with
``I = -i``: two disjoint sets, and every irreducible component lies in one of them. So all that is
exact stays rational; whoever hands out zeros leaves the second set out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from nag.algebra.bounded import Budget, Value
from nag.algebra.expression import parse_number, parse_polynomial
from nag.algebra.number import ComplexNumber, Number, is_zero
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import (
    IMAGINARY_UNITS,
    ExpressionError,
    imaginary_text,
    names_in,
    unit_called,
)

if TYPE_CHECKING:
    import numpy as np

# The name of the unit, of the first that is no other name.
NAMES = ("I", "imaginary_unit", "imaginary_unit_")
# A number with the unit behind it.
_PRINTED = re.compile(r"(?<![\w.])((?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)[ijI](?!\w)")


def name_unit(taken: Iterable[str]) -> str:
    """A name for the imaginary unit besides those that are taken."""
    taken = set(taken)
    return next(name for name in NAMES if name not in taken)


def adjoin_unit(
    variables: Sequence[str],
    polynomials: Iterable[Polynomial],
    nonzero: Iterable[Polynomial] = (),
    groups: Iterable[Sequence[int]] = (),
) -> PolynomialSystem:
    """The system of polynomials whose last variable is the imaginary unit.

    Args:
        variables: names, that of the unit last.
        groups: of the other variables, or of all.
    """
    n = len(variables)
    groups = [tuple(group) for group in groups]
    if groups and not any(n - 1 in group for group in groups):
        groups.append((n - 1,))
    unit = Polynomial.variable(n, n - 1)
    return PolynomialSystem(
        tuple(variables),
        (*(reduce_unit(f) for f in polynomials), unit**2 + 1),
        tuple(reduce_unit(f) for f in nonzero),
        tuple(groups),
        imaginary=True,
    )


def reduce_unit(f: Polynomial) -> Polynomial:
    """The remainder modulo ``I^2 + 1``, the unit being the last variable."""
    terms: dict[Exponents, Number] = {}
    for e, c in f.terms.items():
        key = (*e[:-1], e[-1] % 2)
        c = -c if e[-1] % 4 > 1 else c
        terms[key] = terms[key] + c if key in terms else c
    return Polynomial(f.n, terms)


def values_with_unit(
    values: Mapping[str, Number | ComplexNumber], variables: Sequence[str]
) -> dict[str, Value]:
    """Numbers by name, complex ones as polynomials in variables of which the unit is the last."""
    unit = Polynomial.variable(len(variables), len(variables) - 1)
    return {
        name: value.real + value.imaginary * unit if isinstance(value, ComplexNumber) else value
        for name, value in values.items()
    }


def parse_parameter(
    text: str, units: Sequence[str], known: Mapping[str, Number | ComplexNumber], budget: Budget
) -> Number | ComplexNumber:
    """The number that a text spells, real or complex.

    Args:
        units: names of the imaginary unit; none where there are no complex numbers.
        known: numbers that have names.

    Raises:
        ExpressionError: if it spells no number.
    """
    if not units:
        return parse_number(text, known, budget)  # type: ignore[arg-type]
    for name in IMAGINARY_UNITS:
        if name in names_in(text) - {*units} - known.keys():
            raise ExpressionError(imaginary_text(name, unit_called(units[0])))
    unit = Polynomial.variable(1, 0)
    values = values_with_unit(known, units[:1])
    used = names_in(text) & {*units, *(n for n, v in known.items() if isinstance(v, ComplexNumber))}
    if not used and not has_imaginary_root(text, (), known):
        return parse_number(text, values, budget)
    values |= dict.fromkeys(units[1:], unit)
    name = units[0]
    whole = reduce_unit(parse_polynomial(text, (name,), values, budget, unit=name))
    real, imaginary = (whole.terms.get((k,), Fraction(0)) for k in range(2))
    return real if is_zero(imaginary) else ComplexNumber(real, imaginary)


def has_imaginary_root(
    text: str, variables: Sequence[str], known: Mapping[str, Number | ComplexNumber]
) -> bool:
    """Whether the unit occurs in an expression as the root of a negative number.

    Args:
        known: numbers that have names; complex ones are not looked at.
    """
    if "sqrt" not in text:
        return False
    unit = name_unit((*variables, *known))
    real = {
        name: value
        for name, value in known.items()
        if name not in variables and not isinstance(value, ComplexNumber)
    }
    try:
        f = parse_polynomial(text, (*variables, unit), real, unit=unit)
    except ExpressionError:
        # Whoever reads it says what is wrong.
        return False
    return any(e[-1] for e in f.terms)


def write_out_unit(text: str, unit: str) -> str:
    """A number as it is printed, by this package and by Python, as an expression in the unit.

    There the unit stands right behind its factor, and may be i, j or I.

    >>> write_out_unit("(1.5e-3-2i)", "I")
    '(1.5e-3-2*I)'
    """
    return _PRINTED.sub(rf"\1*{unit}", text)


def as_real(system: PolynomialSystem) -> PolynomialSystem:
    """The same equations, both values of the unit among their zeros."""
    return replace(system, imaginary=False) if system.imaginary else system


def restore_unit(system: PolynomialSystem) -> PolynomialSystem:
    """Equations whose last variable is the imaginary unit, as ones that know it for that."""
    own = [f for f in map(reduce_unit, system.polynomials) if f]
    return adjoin_unit(system.variables, own, system.nonzero, system.groups)


def in_variables_with_unit(system: PolynomialSystem, unit: str) -> PolynomialSystem:
    """The same equations beside those in which a unit occurs."""
    n = system.n + 1
    kept = range(system.n)
    return adjoin_unit(
        (*system.variables, unit),
        [f.with_variables(n, kept) for f in system.polynomials],
        [f.with_variables(n, kept) for f in system.nonzero],
        system.groups,
    )


def real_and_imaginary_parts(system: PolynomialSystem) -> PolynomialSystem:
    """The equations of the real zeros of equations with the imaginary unit, which is left out."""
    n = system.n - 1
    parts: list[Polynomial] = []
    for f in system.polynomials[:-1]:
        for power in range(2):
            terms = {e[:-1]: c for e, c in reduce_unit(f).terms.items() if e[-1] == power}
            if terms:
                parts.append(Polynomial(n, terms))
    groups = (tuple(i for i in group if i < n) for group in system.groups)
    return PolynomialSystem(
        system.variables[:-1], tuple(parts), (), tuple(group for group in groups if group)
    )


def append_unit(points: np.ndarray) -> np.ndarray:
    """Points, shape ``(k, n)``, with i as one more coordinate."""
    import numpy as np

    return np.hstack([points, np.full((len(points), 1), 1j)])


def has_unit(points: np.ndarray) -> np.ndarray:
    """Of points, shape ``(k, n)``, whether the last coordinate is i and not -i, shape ``(k,)``."""
    return points[:, -1].imag > 0
