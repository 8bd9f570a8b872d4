"""Zeros of two equations in two variables as polynomials in one algebraic number.

The resultant of the equations after a shear that tells their zeros apart is a polynomial in one
variable; over each of its irreducible factors the equations have one root in common.

Reference: Rouillier, Solving zero-dimensional systems through the rational univariate
representation, 1999; Bouzidi et al., Separating linear forms and rational univariate
representations of bivariate systems, 2015.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import flint

# Shears y = u - k x that are tried; all but finitely many tell the zeros apart.
SHEARS = (0, 1, -1, 2, -2, 3, -3, 5, -5, 7, 11, 13)
# Systems with more zeros, by Bezout's theorem, are left to other methods; so are those where the
# square of this number times the bits of the coefficients is larger: below that, roots took at most
# 30 ms in all systems measured, above it up to half a second.
MOST_ZEROS = 30
MOST_WORK = 12_500


@dataclass(frozen=True, eq=False)
class ZeroFamily:
    """Conjugate zeros: one for each root of an irreducible polynomial.

    Attributes:
        minimal: the polynomial, a FLINT ``fmpq_poly``.
        x, y: the coordinates as polynomials in its root, of lower degree.
        multiplicity: intersection multiplicity of the two curves at each of them.
    """

    minimal: Any
    x: Any
    y: Any
    multiplicity: int


def zero_families(f: Any, g: Any) -> tuple[ZeroFamily, ...] | None:
    """All zeros of two polynomials in two variables, FLINT's ``fmpq_mpoly`` in a ring of two.

    None if the curves have a component in common, or that would be too much work.
    """
    if f.is_zero() or g.is_zero():
        return None
    zeros = int(f.total_degree() * g.total_degree())
    if zeros > MOST_ZEROS or zeros**2 * max(_bits(f), _bits(g)) > MOST_WORK:
        return None
    ring = f.context()
    x, u = ring.gens()
    for k in SHEARS:
        first, second = (h.compose(x, u - k * x, ctx=ring) for h in (f, g))
        if not _monic(first):
            first, second = second, first
        # Over a root of the leading coefficient, zeros at infinity would count as well.
        if not _monic(first):
            continue
        resultant = first.resultant(second, 0)
        if resultant.is_zero():
            return None
        found = _separate_zeros(resultant, first, second, k)
        if found is not None:
            return found
    return None


def _bits(f: Any) -> int:
    """Bits of the largest coefficient when all are integers without a common factor."""
    numbers = list(f.coeffs())
    common = math.lcm(*(int(c.q) for c in numbers))
    whole = [int(c.p) * (common // int(c.q)) for c in numbers]
    return (max(map(abs, whole)) // math.gcd(*whole)).bit_length()


def _monic(f: Any) -> bool:
    """Whether the leading coefficient in the first variable is a constant, and not all of f."""
    top = int(f.degrees()[0])
    return top > 0 and all(e[1] == 0 for e in f.to_dict() if e[0] == top)


def _separate_zeros(resultant: Any, f: Any, g: Any, k: int) -> tuple[ZeroFamily, ...] | None:
    """The zeros by the factors of the resultant; None if two have the same second coordinate.

    With a constant leading coefficient of f, the order of the resultant at a root is the sum of the
    intersection multiplicities at the zeros above it.
    """
    found = []
    degree = f.total_degree() * g.total_degree()
    subresultant = _first_subresultant(_rows(f), _rows(g), degree)
    for factor, multiplicity in _second_only(resultant).factor()[1]:
        p = flint.fmpq_poly(factor)
        common = [c % p for c in subresultant]
        if common[1].degree() < 0:
            common = _gcd(_coefficients(f, p), _coefficients(g, p), p)
            common = _divide_modulo(common, _gcd(common, _derivative(common, p), p), p)
        if len(common) != 2:
            return None
        x = -common[0] * _inverse(common[1], p) % p
        u = flint.fmpq_poly([0, 1]) % p
        found.append(ZeroFamily(p, x, (u - k * x) % p, int(multiplicity)))
    return tuple(found)


def _second_only(f: Any) -> Any:
    terms = {int(e[1]): c for e, c in f.to_dict().items()}
    return flint.fmpq_poly([terms.get(i, 0) for i in range(max(terms) + 1)])


def _rows(f: Any) -> list[Any]:
    """The coefficients of the powers of the first variable, polynomials in the second one."""
    rows: dict[int, dict[int, Any]] = {}
    for e, c in f.to_dict().items():
        rows.setdefault(int(e[0]), {})[int(e[1])] = c
    result = []
    for i in range(max(rows) + 1):
        row = rows.get(i, {})
        result.append(flint.fmpq_poly([row.get(j, 0) for j in range(max(row, default=-1) + 1)]))
    return result


def _first_subresultant(f: list[Any], g: list[Any], degree: int) -> list[Any]:
    """The subresultant of degree one, constant coefficient first.

    Where it does not vanish at a root of the resultant, it is the common divisor there. Its
    coefficients are determinants of at most the given degree, found by interpolation.
    """
    m, n = len(f) - 1, len(g) - 1
    if m == 1:
        return f
    if n <= 1:
        return g if n == 1 else [flint.fmpq_poly([]), flint.fmpq_poly([])]
    values: list[Any] = []
    points = list(range(-(degree // 2), degree - degree // 2 + 1))
    for u in points:
        low, high = [c(u) for c in f], [c(u) for c in g]
        table = [[0] * i + low + [0] * (n - 2 - i) for i in range(n - 1)]
        table += [[0] * i + high + [0] * (m - 2 - i) for i in range(m - 1)]
        # Columns stand for rising powers; one of the two lowest is left out.
        values += [_determinant([row[k : k + 1] + row[2:] for row in table]) for k in (0, 1)]
    size = len(points)
    powers = flint.fmpq_mat(size, size, [u**k for u in points for k in range(size)])
    solution = powers.solve(flint.fmpq_mat(size, 2, values))
    return [flint.fmpq_poly([solution[i, j] for i in range(size)]) for j in (0, 1)]


def _determinant(rows: list[list[Any]]) -> Any:
    return flint.fmpq_mat(len(rows), len(rows), [c for row in rows for c in row]).det()


# Polynomials over the field of a root of p: lists of coefficients, the constant one first, each a
# polynomial modulo p; the last one is not zero.


def _coefficients(f: Any, p: Any) -> list[Any]:
    return _trim_zeros([c % p for c in _rows(f)])


def _trim_zeros(f: list[Any]) -> list[Any]:
    while f and f[-1].degree() < 0:
        f = f[:-1]
    return f


def _inverse(c: Any, p: Any) -> Any:
    common, s, _ = c.xgcd(p)
    return s / common[0] % p


def _reductions(f: list[Any], g: list[Any], p: Any) -> Iterator[tuple[int, Any, list[Any]]]:
    """Steps of the division of f by g: power, coefficient of the quotient, what is left of f."""
    inverse = _inverse(g[-1], p)
    while len(f) >= len(g):
        shift, c = len(f) - len(g), f[-1] * inverse % p
        f = [a - c * g[i - shift] % p if i >= shift else a for i, a in enumerate(f)]
        f = _trim_zeros(f[:-1])
        yield shift, c, f


def _gcd(f: list[Any], g: list[Any], p: Any) -> list[Any]:
    while g:
        rest = f
        for _, _, left in _reductions(f, g, p):
            rest = left
        f, g = g, rest
    return f


def _divide_modulo(f: list[Any], g: list[Any], p: Any) -> list[Any]:
    quotient = [flint.fmpq_poly([])] * (len(f) - len(g) + 1)
    for shift, c, _ in _reductions(f, g, p):
        quotient[shift] = c
    return _trim_zeros(quotient)


def _derivative(f: list[Any], p: Any) -> list[Any]:
    return _trim_zeros([i * c % p for i, c in enumerate(f)][1:])
