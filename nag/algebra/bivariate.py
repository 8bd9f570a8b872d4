"""Zeros of two equations in two variables as polynomials in one algebraic number.

The resultant of the equations after a shear that tells their zeros apart is a polynomial in one
variable; over each of its irreducible factors the equations have one root in common.

Reference: Rouillier, Solving zero-dimensional systems through the rational univariate
representation, 1999; Bouzidi et al., Separating linear forms and rational univariate
representations of bivariate systems, 2015.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

# Shears y = u - k x that are tried; all but finitely many tell the zeros apart.
SHEARS = (0, 1, -1, 2, -2, 3, -3, 5, -5, 7, 11, 13)
# Systems with more zeros, by Bezout's theorem, are left to other methods.
MOST_ZEROS = 30


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

    None if the curves have a component in common, or there may be more than `MOST_ZEROS` zeros.
    """
    if f.total_degree() * g.total_degree() > MOST_ZEROS or f.is_zero() or g.is_zero():
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
        found = _separated(resultant, first, second, k)
        if found is not None:
            return found
    return None


def _monic(f: Any) -> bool:
    """Whether the leading coefficient in the first variable is a constant, and not all of f."""
    top = int(f.degrees()[0])
    return top > 0 and all(e[1] == 0 for e in f.to_dict() if e[0] == top)


def _separated(resultant: Any, f: Any, g: Any, k: int) -> tuple[ZeroFamily, ...] | None:
    """The zeros by the factors of the resultant; None if two have the same second coordinate.

    With a constant leading coefficient of f, the order of the resultant at a root is the sum of the
    intersection multiplicities at the zeros above it.
    """
    import flint

    found = []
    for factor, multiplicity in _second_only(resultant).factor()[1]:
        p = flint.fmpq_poly(factor)
        common = _gcd(_coefficients(f, p), _coefficients(g, p), p)
        common = _divided(common, _gcd(common, _derivative(common, p), p), p)
        if len(common) != 2:
            return None
        x = -common[0] * _inverse(common[1], p) % p
        u = flint.fmpq_poly([0, 1]) % p
        found.append(ZeroFamily(p, x, (u - k * x) % p, int(multiplicity)))
    return tuple(found)


def _second_only(f: Any) -> Any:
    import flint

    terms = {int(e[1]): c for e, c in f.to_dict().items()}
    return flint.fmpq_poly([terms.get(i, 0) for i in range(max(terms) + 1)])


# Polynomials over the field of a root of p: lists of coefficients, the constant one first, each a
# polynomial modulo p; the last one is not zero.


def _coefficients(f: Any, p: Any) -> list[Any]:
    import flint

    rows: dict[int, dict[int, Any]] = {}
    for e, c in f.to_dict().items():
        rows.setdefault(int(e[0]), {})[int(e[1])] = c
    result = []
    for i in range(max(rows) + 1):
        row = rows.get(i, {})
        result.append(flint.fmpq_poly([row.get(j, 0) for j in range(max(row, default=-1) + 1)]) % p)
    return _trimmed(result)


def _trimmed(f: list[Any]) -> list[Any]:
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
        f = _trimmed(f[:-1])
        yield shift, c, f


def _gcd(f: list[Any], g: list[Any], p: Any) -> list[Any]:
    while g:
        rest = f
        for _, _, left in _reductions(f, g, p):
            rest = left
        f, g = g, rest
    return f


def _divided(f: list[Any], g: list[Any], p: Any) -> list[Any]:
    import flint

    quotient = [flint.fmpq_poly([])] * (len(f) - len(g) + 1)
    for shift, c, _ in _reductions(f, g, p):
        quotient[shift] = c
    return _trimmed(quotient)


def _derivative(f: list[Any], p: Any) -> list[Any]:
    return _trimmed([i * c % p for i, c in enumerate(f)][1:])
