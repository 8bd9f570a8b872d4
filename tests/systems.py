"""Polynomial systems from texts."""

from __future__ import annotations

from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem


def system(variables: str, *equations: str, nonzero: tuple[str, ...] = ()) -> PolynomialSystem:
    """The equations in variables whose names are separated by blanks."""
    names = tuple(variables.split())
    return PolynomialSystem(
        names,
        tuple(parse_polynomial(e, names) for e in equations),
        tuple(parse_polynomial(e, names) for e in nonzero),
    )
