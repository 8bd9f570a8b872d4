"""The terms of lowest order of equations at a singular point: its tangent cone.

In the coordinates of the tangent space the equations have no linear part; their parts of lowest
order are the equations of lowest degree of the tangent cone, and all of them if there is one.

Reference:
    Cox, Little & O'Shea, Ideals, Varieties, and Algorithms, chapter 9, section 7.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.digits import log_size, working
from nag.numerics.implicit_function import eliminate
from nag.numerics.local_dimension import local_dimension
from nag.numerics.located_zero import exact_zero
from nag.numerics.power_series import Series, SeriesRing
from nag.numerics.rational_point import rational
from nag.numerics.sharpening import DIGITS

# Orders beyond this are not looked at.
HIGHEST = 8
# Decimal logarithm of what is zero in 150 digits.
NOTHING = -90.0


@dataclass(frozen=True, eq=False)
class TangentCone:
    """The lowest-order part of a zero set at a point, in the coordinates ``u = x - p``.

    Attributes:
        coordinates: indices of the variables that are coordinates of the tangent space; the others
            depend on them in first order.
        degree: of the forms.
        forms: a basis of the equations of that degree, in all variables; rational.
        dimension: of their zero set in the tangent space, not less than that of the tangent cone;
            None if it is not decided.
    """

    coordinates: tuple[int, ...]
    degree: int
    forms: tuple[Polynomial, ...]
    dimension: int | None

    def text(self, variables: Sequence[str]) -> str:
        """The equations, with the variables' names for their distances from the point."""
        return ", ".join(f"{f.text(variables)} = 0" for f in self.forms)


def tangent_cone(
    system: PolynomialSystem,
    point: Sequence[Any] | np.ndarray,
    *,
    accuracy: float = 1e-8,
    seed: int = 0,
) -> TangentCone | None:
    """The tangent cone at a singular point; None where its equations are not found rational.

    Args:
        point: exact numbers, or doubles, which are sharpened first.
        accuracy: of a point of doubles, as for `nag.local_dimension`.
    """
    with working(DIGITS):
        zero, factors = exact_zero(system.polynomials, point, accuracy, np.random.default_rng(seed))
        if zero is None or not zero.tangent:
            return None
        rows, block = zero.system.at(DIGITS), zero.block
        for order in range(2, HIGHEST + 1):
            found = eliminate(rows, zero.found.point, block.rows, block.columns, order)
            if found is None:
                return None
            parts = [_part(found.ring, s, order) for s in found.rest]
            parts = [part for part in parts if part]
            if parts:
                break
        else:
            return None
        free = tuple(i for i in range(system.n) if i not in block.columns)
        forms = _rational_forms(parts, [factors[i] for i in free])
    if forms is None:
        return None
    inner = PolynomialSystem(tuple(f"u{i}" for i in range(len(free))), tuple(forms))
    dimension = local_dimension(inner, [0] * len(free), seed=seed).dimension
    outer = tuple(f.with_variables(system.n, free) for f in forms)
    return TangentCone(free, order, outer, dimension)


def _part(ring: SeriesRing, series: Series, order: int) -> dict[tuple[int, ...], flint.acb]:
    return {
        ring.exponents(key): flint.acb(c)
        for key, c in series.items()
        if ring.degree(key) == order and log_size(c) > NOTHING
    }


def _rational_forms(
    parts: Sequence[dict[tuple[int, ...], flint.acb]], factors: Sequence[Any]
) -> list[Polynomial] | None:
    """Independent combinations of forms with coprime integer coefficients, or None."""
    monomials = sorted({e for part in parts for e in part}, reverse=True)
    left = []
    for part in parts:
        row = []
        for e in monomials:
            c = part.get(e, flint.acb(0))
            for k, factor in zip(e, factors, strict=True):
                c = c / factor**k
            row.append(c)
        left.append(row)
    forms = []
    for row in _reduced(left):
        numbers = [rational(c, DIGITS - 30) for c in row]
        if None in numbers:
            return None
        forms.append(_primitive({e: q for e, q in zip(monomials, numbers, strict=True) if q}))
    return forms


def _reduced(rows: list[list[flint.acb]]) -> list[list[flint.acb]]:
    """The reduced echelon form, without the rows that vanish."""
    done: list[list[flint.acb]] = []
    for column in range(len(rows[0])):
        sizes = [log_size(row[column]) for row in rows]
        best = max(range(len(rows)), key=sizes.__getitem__, default=None)
        if best is None or sizes[best] <= NOTHING:
            continue
        pivot = rows.pop(best)
        pivot = [c / pivot[column] for c in pivot]
        rows = [_minus(row, pivot, column) for row in rows]
        done = [_minus(row, pivot, column) for row in done] + [pivot]
        if not rows:
            break
    return done


def _minus(row: list[flint.acb], pivot: list[flint.acb], column: int) -> list[flint.acb]:
    factor = row[column]
    return [a - factor * b for a, b in zip(row, pivot, strict=True)]


def _primitive(terms: dict[tuple[int, ...], Fraction]) -> Polynomial:
    denominator = lcm(*(q.denominator for q in terms.values()))
    divisor = gcd(*(int(q * denominator) for q in terms.values()))
    scale = Fraction(denominator, divisor)
    n = len(next(iter(terms)))
    return Polynomial(n, {e: q * scale for e, q in terms.items()})
