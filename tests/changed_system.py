"""Exact random changes of coordinates and of equations that keep a system sparse."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

# Sizes of scalings: powers of ten up to this.
DECADES = 4
# Unknowns, and equations, to which a multiple of another one is added.
MIXED = 3


def changed(system: PolynomialSystem, rng: np.random.Generator) -> PolynomialSystem:
    """The system in other coordinates, with other equations of the same ideal.

    Every variable is scaled by a power of ten and shifted, multiples of some variables are added
    to others, and multiples of some equations to others of at least their degree.
    """
    n = system.n
    x = Polynomial.variables(n)
    forms = [
        _power(rng) * x[i] + Fraction(int(rng.integers(-9, 10)), int(rng.integers(1, 8)))
        for i in range(n)
    ]
    for i, j in _pairs(n, rng):
        forms[i] = forms[i] + _small(rng) * forms[j]
    polynomials = [f.compose(forms) for f in system.polynomials]
    for i, j in _pairs(len(polynomials), rng):
        if polynomials[i].degree >= polynomials[j].degree:
            polynomials[i] = polynomials[i] + _small(rng) * polynomials[j]
    scaled = tuple(_power(rng) * f for f in polynomials)
    return replace(
        system, polynomials=scaled, nonzero=tuple(f.compose(forms) for f in system.nonzero)
    )


def _power(rng: np.random.Generator) -> Fraction:
    return Fraction(10) ** int(rng.integers(-DECADES, DECADES + 1))


def _small(rng: np.random.Generator) -> Fraction:
    return Fraction(int(rng.choice([-3, -2, -1, 1, 2, 3])), int(rng.integers(1, 4)))


def _pairs(n: int, rng: np.random.Generator) -> list[tuple[int, int]]:
    """Some pairs of different numbers below ``n``."""
    return [tuple(rng.choice(n, 2, replace=False).tolist()) for _ in range(MIXED if n > 1 else 0)]
