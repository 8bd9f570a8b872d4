"""Exact linear algebra: small matrices of numbers, linear dependence of polynomials."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial

Row = tuple[Number, ...]


def row_echelon(rows: Sequence[Sequence[Number]]) -> tuple[list[Row], list[int]]:
    """Reduced row echelon form without its zero rows, and the columns of its pivots."""
    matrix = [list(r) for r in rows]
    pivots: list[int] = []
    done = 0
    for column in range(len(matrix[0]) if matrix else 0):
        found = next((i for i in range(done, len(matrix)) if not is_zero(matrix[i][column])), None)
        if found is None:
            continue
        matrix[done], matrix[found] = matrix[found], matrix[done]
        pivot = matrix[done][column]
        matrix[done] = [x / pivot for x in matrix[done]]
        for i, row in enumerate(matrix):
            if i != done and not is_zero(row[column]):
                factor = row[column]
                own = zip(row, matrix[done], strict=True)
                matrix[i] = [x - factor * y if y else x for x, y in own]
        pivots.append(column)
        done += 1
        if done == len(matrix):
            break
    return [tuple(r) for r in matrix[:done]], pivots


def independent_rows(rows: Sequence[Sequence[Number]]) -> list[int]:
    """Indices of the first rows that span the row space."""
    if not rows:
        return []
    transposed = [tuple(r[i] for r in rows) for i in range(len(rows[0]))]
    return row_echelon(transposed)[1] if transposed else []


def independent_polynomials(polynomials: Sequence[Polynomial]) -> list[Polynomial]:
    """Those polynomials that are no linear combination of earlier ones."""
    monomials = sorted({e for f in polynomials for e in f.terms})
    rows = [[f.terms.get(e, Fraction(0)) for e in monomials] for f in polynomials]
    return [polynomials[i] for i in independent_rows(rows)]


def null_space(rows: Sequence[Sequence[Number]], columns: int) -> list[Row]:
    """A basis of the vectors that all ``rows`` annihilate."""
    reduced, pivots = row_echelon(rows)
    basis = []
    for free in (c for c in range(columns) if c not in pivots):
        vector: list[Number] = [Fraction(0)] * columns
        vector[free] = Fraction(1)
        for row, pivot in zip(reduced, pivots, strict=True):
            vector[pivot] = -row[free]
        basis.append(tuple(vector))
    return basis


def left_inverse(columns: Sequence[Sequence[Number]]) -> list[Row]:
    """Rows y_i with <y_i, columns[j]> = (i == j): the Moore-Penrose left inverse.

    Raises:
        ValueError: if the columns are dependent.
    """
    k = len(columns)
    gram = [
        [sum((x * y for x, y in zip(u, v, strict=True)), Fraction(0)) for v in columns]
        + [Fraction(int(i == j)) for j in range(k)]
        for i, u in enumerate(columns)
    ]
    reduced, pivots = row_echelon(gram)
    if pivots[:k] != list(range(k)):
        raise ValueError("the columns are linearly dependent")
    inverse = [row[k:] for row in reduced]
    size = len(columns[0])
    return [
        tuple(
            sum((w * u[m] for w, u in zip(weights, columns, strict=True)), Fraction(0))
            for m in range(size)
        )
        for weights in inverse
    ]
