"""What the zero set of a small system is, exactly: its isolated zeros and its components.

In one unknown by square-free factorisation, for two equations in two unknowns by a resultant in
general coordinates, for all else by standard bases (`singular_counts`). What is generic for almost
all numbers is computed for random ones modulo a large prime; an error has odds of about the number
of zeros to the fourth power over that prime.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from fractions import Fraction

import flint

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.verdicts import Components, ZeroSet

PRIME = 1902797279921331653
ORDER = flint.Ordering.degrevlex
RATIONAL = flint.fmpq_mpoly_ctx.get(("x", "y"), ORDER)
MODULAR = flint.nmod_mpoly_ctx.get(("x", "y"), PRIME, ORDER)


def zero_set(system: PolynomialSystem) -> ZeroSet | None:
    """The zero set of ``system`` with rational coefficients, None if that is too much to ask.

    It is for systems in more than two unknowns, or of more equations than unknowns, where Singular
    is not installed or takes too long.
    """
    equations = [f for f in system.polynomials if f]
    if any(f.degree == 0 for f in equations):
        return ZeroSet.of(Counter())
    if not equations:
        return ZeroSet.of(Counter({(system.n, 1, 1): 1}))
    if system.n == 1:
        return ZeroSet.of(zeros_on_the_line(equations))
    if system.n == 2 and len(equations) <= 2:
        return ZeroSet.of(components_in_the_plane(equations))
    from singular_counts import standard_zero_set

    return standard_zero_set(system.n, equations)


def zeros_on_the_line(equations: Sequence[Polynomial]) -> Components:
    """The common zeros of polynomials in one variable, none of them zero."""
    common = flint.fmpq_poly()
    for f in equations:
        dense = [Fraction(0)] * (f.degree + 1)
        for (k,), c in f.terms.items():
            dense[k] = c
        common = common.gcd(flint.fmpq_poly([rational(c) for c in dense]))
    return Counter(
        {(0, 1, e): sum(g.degree() for g, k in common.factor()[1] if k == e)
         for _, e in common.factor()[1]}
    )  # fmt: skip


def rational(value: Fraction) -> flint.fmpq:
    return flint.fmpq(value.numerator, value.denominator)


def modular(value: Fraction | flint.fmpq, prime: int = PRIME) -> int:
    """``value`` modulo ``prime``.

    Raises:
        ZeroDivisionError: if the prime divides the denominator.
    """
    top, bottom = (int(v) % prime for v in _parts(value))
    if not bottom:
        raise ZeroDivisionError(f"{value} has no value modulo {prime}")
    return top * pow(bottom, -1, prime) % prime


def _parts(value: Fraction | flint.fmpq) -> tuple[int, int]:
    if isinstance(value, Fraction):
        return value.numerator, value.denominator
    return int(value.p), int(value.q)


def components_in_the_plane(equations: Sequence[Polynomial]) -> Components:
    """Curves and isolated points of the zero set of one or two polynomials, none of them zero.

    The curves are the common factor. An isolated point is a zero of the cofactors off the curves,
    and its multiplicity is that of the cofactors' ideal, as the common factor is a unit there.
    """
    f, g = (
        RATIONAL.from_dict({e: rational(c) for e, c in h.terms.items()})
        for h in (equations[0], equations[-1])
    )
    common = f.gcd(g)
    found: Components = Counter()
    for factor, multiplicity in common.factor()[1]:
        pieces = absolute_factors(factor)
        found[1, int(factor.total_degree()) // pieces, multiplicity] += pieces
    if len(equations) == 2:
        for multiplicity, count in points_of_intersection(f / common, g / common, common).items():
            found[0, 1, multiplicity] += count
    return found


def absolute_factors(f: flint.fmpq_mpoly) -> int:
    """Number of factors over the complex numbers of a polynomial irreducible over the rationals.

    S. Gao, Factoring multivariate polynomials via partial differential equations, 2003: the
    dimension of the space of pairs (g, h), of degrees less than f's in x and y, respectively, for
    which g/f dx + h/f dy is closed.
    """
    m, n = f.degrees()
    if not m or not n:
        return m + n
    terms = {e: modular(c) for e, c in f.to_dict().items()}
    # g = x^i y^j contributes f g_y - g f_y, and h = x^i y^j its mirror image.
    forms = [((i, j), 1) for i in range(m) for j in range(n + 1)]
    forms += [((i, j), 0) for i in range(m + 1) for j in range(n)]
    rows = []
    for (i, j), axis in forms:
        row = [0] * (4 * (m + 1) * (n + 1))
        for (a, b), c in terms.items():
            weight = (j - b) if axis else (a - i)
            e = (a + i, b + j - 1) if axis else (a + i - 1, b + j)
            if weight:
                row[e[0] * 2 * (n + 1) + e[1]] += c * weight
        rows.append([v % PRIME for v in row])
    return len(rows) - flint.nmod_mat(rows, PRIME).rank()


def points_of_intersection(
    f: flint.fmpq_mpoly, g: flint.fmpq_mpoly, off: flint.fmpq_mpoly
) -> Counter[int]:
    """Common zeros of two polynomials without a common factor at which ``off`` is not zero.

    Returns:
        How many there are of each intersection multiplicity.
    """
    if not f.total_degree() or not g.total_degree():
        return Counter()
    rng = random.Random(20)
    x, y = MODULAR.gens()
    # With a generic c different points have different first coordinates, and no point is lost to
    # infinity: the resultant's roots are the points, with their multiplicities.
    c, t = rng.randrange(PRIME), rng.randrange(PRIME)
    f, g, off = (
        MODULAR.from_dict({e: modular(v) for e, v in h.to_dict().items()}).compose(x + c * y, y)
        for h in (f, g, off)
    )
    if any(h.degrees()[1] != h.total_degree() for h in (f, g)):
        raise ArithmeticError("the coordinates are not general")
    points = _in_x(f.resultant(g, "y"))
    if off.total_degree() > 0:
        # A combination of f and g has no common factor with what they are divided by.
        points = _without(points, _in_x((f + t * g).resultant(off, "y")))
    return Counter({k: h.degree() for h, k in points.factor_squarefree()[1] if h.degree()})


def _in_x(f: flint.nmod_mpoly) -> flint.nmod_poly:
    terms = {e[0]: int(c) for e, c in f.to_dict().items()}
    return flint.nmod_poly([terms.get(k, 0) for k in range(max(terms, default=0) + 1)], PRIME)


def _without(f: flint.nmod_poly, g: flint.nmod_poly) -> flint.nmod_poly:
    """``f`` without its roots that are also those of ``g``."""
    common = f.gcd(g)
    while common.degree() > 0:
        f = f // common
        common = f.gcd(common)
    return f
