"""Matrices of rational numbers, by FLINT, which is loaded when one is made."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from nag.algebra.polynomial import Polynomial

if TYPE_CHECKING:
    import flint


def rational_matrix(rows: Sequence[Sequence[Fraction | int]]) -> flint.fmpq_mat:
    """Rows, of which there are some, as a matrix of FLINT's."""
    import flint

    return flint.fmpq_mat([[flint.fmpq(c.numerator, c.denominator) for c in row] for row in rows])


def rank(rows: Sequence[Sequence[Fraction | int]]) -> int:
    """The rank of a matrix that may be empty."""
    return int(rational_matrix(rows).rank()) if rows else 0


def jacobian_rank(polynomials: Sequence[Polynomial], point: Sequence[Fraction]) -> int:
    """The rank of the Jacobian of exact polynomials at a rational point."""
    return rank([[f.derivative(i)(point) for i in range(f.n)] for f in polynomials])
