"""Factors of exact polynomials: over the rationals by FLINT, and how many over the complex numbers.

Over the rationals with square roots they are found by norms (`conjugate_factors`).

FLINT is loaded when the first polynomial is factored, and not before.

References:
    S. Gao, Factoring multivariate polynomials via partial differential equations, 2003.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from math import gcd, lcm
from typing import Any

import flint
import numpy as np

from nag.algebra.conjugate_factors import (
    Factors,
    common_factor_with_roots,
    factor_with_roots,
    make_monic,
)
from nag.algebra.exact_ranks import LARGE, PrimeField, field_of
from nag.algebra.flint_numbers import to_fraction, to_rational
from nag.algebra.polynomial import Exponents, Polynomial

# Integer coefficients of more bits are divided by a power of two, so that they fit into doubles.
MOST_BITS = 200
# Larger degrees cost too much memory.
MOST_DEGREE = 12


class Ring:
    """The polynomials over the rationals in ``n`` variables, as FLINT's ``fmpq_mpoly``."""

    def __init__(self, n: int) -> None:
        names = [f"x{i}" for i in range(n)]
        self.n = n
        self.context = flint.fmpq_mpoly_ctx.get(names, flint.Ordering.lex)

    def of(self, f: Polynomial) -> Any:
        """An exact polynomial as FLINT's."""
        terms = {e: to_rational(c) for e, c in f.terms.items()}
        return self.context.from_dict(terms)

    def polynomial(self, f: Any) -> Polynomial:
        """The way back."""
        terms = {tuple(map(int, e)): to_fraction(c) for e, c in f.to_dict().items()}
        return Polynomial(self.n, terms)

    def solve_for(self, f: Any, index: int) -> Any:
        """What ``f = 0`` says of a variable that it contains linearly, with a constant factor."""
        unit = tuple(int(i == index) for i in range(self.n))
        return self.context.gens()[index] - f / f[unit]

    def factors(self, f: Any) -> list[tuple[Any, int]]:
        """The distinct irreducible factors with their exponents; none of a constant.

        A factor has coprime integer coefficients, the leading one positive: factors that are equal
        up to a constant are equal.
        """
        if f.is_constant():
            return []
        if is_surely_irreducible(f, self.n):
            return [(_primitive(f), 1)]
        return [(p, int(k)) for p, k in f.factor()[1]]

    def factor_polynomial(self, f: Any) -> Polynomial:
        """A factor as a polynomial whose coefficients are not too large for doubles."""
        g = self.polynomial(f)
        bits = max((abs(c.numerator).bit_length() for c in g.terms.values()), default=0)
        return g if bits <= MOST_BITS else g * Fraction(1, 2**bits)


@lru_cache(maxsize=64)
def ring(n: int) -> Ring:
    """The ring in ``n`` variables; the same object each time."""
    return Ring(n)


def is_surely_irreducible(f: Any, n: int) -> bool:
    """Whether a polynomial of FLINT's, no constant, is seen to be irreducible over any field.

    Where a variable occurs linearly, factors without it are common to what it is multiplied by and
    to the rest: monomials, if one of both is a single term. A quadric of rank three and more is
    irreducible. To see either takes a fraction of the time of looking for factors.
    """
    if f.total_degree() < 2:
        return True
    exponents = f.monoms()
    for i, degree in enumerate(f.degrees()):
        if degree == 1:
            beside = [e for e in exponents if e[i]]
            rest = [e for e in exponents if not e[i]]
            few, many = (beside, rest) if len(beside) == 1 else (rest, beside)
            if len(few) == 1 and not any(
                k and j != i and all(e[j] for e in many) for j, k in enumerate(few[0])
            ):
                return True
    return f.total_degree() == 2 and _rank_of_quadric(f, exponents, n) > 2


def _rank_of_quadric(f: Any, exponents: Sequence[Sequence[int]], n: int) -> int:
    """The rank of a quadric's matrix modulo a prime, which is no more than its own."""
    if all(max(e) != 1 for e in exponents):
        # Squares and a constant.
        return len(exponents)
    whole = _whole_coefficients(f)[0]
    rows = [[0] * (n + 1) for _ in range(n + 1)]
    for e, c in zip(exponents, whole, strict=True):
        first, second = [n, n, *(j for j, k in enumerate(e) for _ in range(k))][-2:]
        rows[first][second] += c
        rows[second][first] += c
    return LARGE.rank(rows)


def _whole_coefficients(f: Any) -> tuple[list[int], int, int]:
    """A polynomial's coefficients over ``b / a``, and ``a, b``: coprime integers."""
    parts = [(int(c.p), int(c.q)) for c in f.coeffs()]
    a = lcm(*(q for _, q in parts))
    whole = [p * (a // q) for p, q in parts]
    b = gcd(*whole)
    return [c // b for c in whole], a, b


def _primitive(f: Any) -> Any:
    """The multiple that has coprime integer coefficients, the leading one positive."""
    whole, a, b = _whole_coefficients(f)
    if whole[0] < 0:
        b = -b
    return f if a == b == 1 else f * a / b


def factor_into_irreducibles(f: Polynomial) -> Factors:
    """The distinct irreducible factors of ``f`` over its coefficients' field, with their exponents.

    The field is that of the rationals with the square roots in the coefficients, once one of them
    is made one. None of a constant. Factors that are equal up to a constant are equal. A polynomial
    with other coefficients is left as it is, and so is one whose norm is too large.
    """
    if f.degree < 1:
        return ()
    if f.exact:
        over = ring(f.n)
        return tuple((over.factor_polynomial(p), k) for p, k in over.factors(over.of(f)))
    return _factor_with_roots(f) if f.algebraic else ((f, 1),)


@lru_cache(maxsize=256)
def _factor_with_roots(f: Polynomial) -> Factors:
    monic = make_monic(f)
    if monic.exact:
        return factor_into_irreducibles(monic)
    found = factor_with_roots(monic, factor_into_irreducibles)
    if found is None:
        return ((monic, 1),)
    over = ring(f.n)
    return tuple(
        (over.factor_polynomial(_primitive(over.of(p))) if p.exact else p, k) for p, k in found
    )


def product(factors: Iterable[Polynomial], n: int) -> Polynomial:
    result = Polynomial.constant(n, 1)
    for p in factors:
        result = result * p
    return result


def common_factor(polynomials: Sequence[Polynomial]) -> Polynomial | None:
    """The greatest common divisor of exact polynomials, not all zero; None if it is a constant.

    None as well where coefficients are neither rational nor sums of few square roots.
    """
    given = sorted((f for f in polynomials if f), key=lambda f: len(f.terms))
    if not given or not all(f.algebraic for f in given):
        return None
    given = [f if f.exact else make_monic(f) for f in given]
    if not all(f.exact for f in given):
        found = common_factor_with_roots(given)
        return found if found is not None and found.degree > 0 else None
    over = ring(given[0].n)
    common = over.of(given[0])
    for f in given[1:]:
        if common.is_constant():
            break
        common = common.gcd(over.of(f))
    return None if common.is_constant() else over.factor_polynomial(common)


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
        f: irreducible over its coefficients' field.
        rng: chooses the plane.

    Returns:
        None for a polynomial in one variable, or of too high a degree.
    """
    field = field_of([f])
    if field is None or f.n < 2 or not 1 <= f.degree <= MOST_DEGREE:
        return None
    if f.exact and is_surely_irreducible(ring(f.n).of(f), f.n):
        return 1
    plane = _on_a_plane(f, rng)
    if plane.degree < f.degree:
        return None
    try:
        return _closed_forms({e: field.of(c) for e, c in plane.terms.items()}, field)
    except ArithmeticError:
        return None


def _on_a_plane(f: Polynomial, rng: np.random.Generator) -> Polynomial:
    x, y = Polynomial.variables(2)
    images = []
    for _ in range(f.n):
        a, b, c = (Fraction(int(k)) for k in rng.integers(-97, 98, 3))
        images.append(x * a + y * b + c)
    return f.compose(images)


def _closed_forms(terms: Mapping[Exponents, int], field: PrimeField) -> int:
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
    return len(rows) - field.rank(rows)
