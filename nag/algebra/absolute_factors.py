"""Irreducibility over the complex numbers, decided exactly for polynomials over the rationals.

References:
    S. Gao, Factoring multivariate polynomials via partial differential equations, 2003.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import numpy as np

from nag.algebra.factoring import is_surely_irreducible, ring
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.prime_field import LARGE

# Larger degrees cost too much memory.
MOST_DEGREE = 12


def is_absolutely_irreducible(f: Polynomial, rng: np.random.Generator) -> bool:
    """Whether an exact polynomial certainly is irreducible over the complex numbers.

    Args:
        f: irreducible over the rationals.
        rng: chooses the plane.
    """
    return most_absolute_factors(f, rng) == 1


def most_absolute_factors(f: Polynomial, rng: np.random.Generator) -> int | None:
    """A number of factors over the complex numbers that an exact polynomial has at most.

    It is the number of factors, but for bad luck. They are no more than those of the restriction
    to a plane, of the same degree, and not divided by a polynomial of one variable. Gao's theorem:
    the number of factors of a square-free plane polynomial f is the dimension of the pairs (g, h),
    of degrees less than f's in x and y, for which ``g/f dx + h/f dy`` is closed.

    Args:
        f: irreducible over the rationals.
        rng: chooses the plane.

    Returns:
        None for a polynomial in one variable, or of too high a degree.
    """
    if not f.exact or f.n < 2 or not 1 <= f.degree <= MOST_DEGREE:
        return None
    if is_surely_irreducible(ring(f.n).of(f), f.n):
        return 1
    plane = _on_a_plane(f, rng)
    if plane.degree < f.degree:
        return None
    try:
        return _closed_forms({e: LARGE.of(c) for e, c in plane.terms.items()})
    except ZeroDivisionError:
        return None


def _on_a_plane(f: Polynomial, rng: np.random.Generator) -> Polynomial:
    x, y = Polynomial.variables(2)
    images = []
    for _ in range(f.n):
        a, b, c = (Fraction(int(k)) for k in rng.integers(-97, 98, 3))
        images.append(x * a + y * b + c)
    return f.compose(images)


def _closed_forms(terms: Mapping[Exponents, int]) -> int:
    """As many, for coefficients modulo the prime; a rank that it lowers gives more, never 1."""
    m, n = (max(e[i] for e in terms) for i in range(2))
    # g = x^i y^j contributes f g_y - g f_y, and h = x^i y^j its mirror image.
    forms = [((i, j), 1) for i in range(m) for j in range(n + 1)]
    forms += [((i, j), 0) for i in range(m + 1) for j in range(n)]
    rows = []
    for (i, j), axis in forms:
        row = [0] * (4 * (m + 1) * (n + 1))
        for (a, b), c in terms.items():
            weight = (j - b) if axis else (a - i)
            if weight:
                power_x, power_y = (a + i, b + j - 1) if axis else (a + i - 1, b + j)
                row[power_x * 2 * (n + 1) + power_y] += c * weight
        rows.append(row)
    return len(rows) - LARGE.rank(rows)
