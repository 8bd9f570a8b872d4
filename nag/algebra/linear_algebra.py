"""Exact linear algebra: rows over the rationals, and matrices modulo a prime.

Row reduction, linear dependence of polynomials and ranks of Jacobians. What is modulo a prime is
done by FLINT, which is loaded when a matrix is made.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import flint

from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.errors import NagError

if TYPE_CHECKING:
    import numpy as np

Rows = Sequence[Sequence[int]]


@dataclass(frozen=True)
class PrimeField:
    """Arithmetic modulo a prime below 2^64; numbers are integers, of any size where they are taken.

    A `nag.numerics.null_space.Field`.
    """

    modulus: int

    def of(self, c: Fraction | int) -> int:
        """The image of a rational number.

        Raises:
            ZeroDivisionError: if the prime divides its denominator.
        """
        if c.denominator % self.modulus == 0:
            raise ZeroDivisionError(f"{self.modulus} divides a denominator")
        return c.numerator * pow(c.denominator, -1, self.modulus) % self.modulus

    def is_zero(self, a: int) -> bool:
        return a % self.modulus == 0

    def matrix(self, rows: Rows) -> flint.nmod_mat:
        """Rows of integers, of which there are some."""
        found = flint.nmod_mat(len(rows), len(rows[0]), self.modulus)
        # Most entries are zero, as a rule, and each that is entered is taken modulo the prime.
        for i, row in enumerate(rows):
            for j, c in enumerate(row):
                if c:
                    found[i, j] = c
        return found

    def rank(self, rows: Rows) -> int:
        """At most that of the same rows over the rationals."""
        return self.matrix(rows).rank() if rows else 0

    def product(self, left: Rows, right: Rows) -> list[list[int]]:
        found = self.matrix(left) * self.matrix(right)
        return [list(map(int, row)) for row in found.tolist()]

    def reduced(self, rows: Rows, columns: int) -> tuple[list[list[int]], list[int]]:
        found, rank = self.matrix(rows).rref()
        table = [list(map(int, row)) for row in found.tolist()][:rank]
        return table, [next(j for j, c in enumerate(row) if c) for row in table]

    def null_space(self, rows: Rows, columns: int) -> list[list[int]]:
        if not rows:
            return [[int(i == j) for j in range(columns)] for i in range(columns)]
        basis, nullity = self.matrix(rows).nullspace()
        return [[int(basis[i, j]) for i in range(columns)] for j in range(nullity)]


# For ranks and images of random numbers: wrong with a probability of some 1e-15.
LARGE = PrimeField(2**61 - 1)


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
        raise NagError("the columns are linearly dependent")
    inverse = [row[k:] for row in reduced]
    size = len(columns[0])
    return [
        tuple(
            sum((w * u[m] for w, u in zip(weights, columns, strict=True)), Fraction(0))
            for m in range(size)
        )
        for weights in inverse
    ]


def rational_matrix(rows: Sequence[Sequence[Fraction | int]]) -> flint.fmpq_mat:
    """Rows, of which there are some, as a matrix of FLINT's."""
    return flint.fmpq_mat([[flint.fmpq(c.numerator, c.denominator) for c in row] for row in rows])


def rational_rank(rows: Sequence[Sequence[Fraction | int]]) -> int:
    """The rank of a matrix that may be empty."""
    return int(rational_matrix(rows).rank()) if rows else 0


def jacobian_rank(polynomials: Sequence[Polynomial], point: Sequence[Fraction]) -> int:
    """The rank of the Jacobian of exact polynomials at a rational point."""
    return rational_rank([[f.derivative(i)(point) for i in range(f.n)] for f in polynomials])


def is_dependent(polynomials: Sequence[Polynomial], rng: np.random.Generator) -> bool:
    """Whether the Jacobian of as many polynomials as variables is singular everywhere.

    Then there are no isolated zeros. Said by its rank at a random point modulo a prime, which is
    smaller than elsewhere with a probability below 1e-15; never said of irrational coefficients.
    """
    n, p = len(polynomials), LARGE.modulus
    if not all(f.exact for f in polynomials):
        return False
    try:
        residues = [[(e, LARGE.of(c)) for e, c in f.terms.items()] for f in polynomials]
    except ZeroDivisionError:
        return False
    point = [int(x) for x in rng.integers(1, p, n)]
    inverse = [pow(x, -1, p) for x in point]
    rows = []
    for terms in residues:
        row = [0] * n
        for exponents, value in terms:
            for x, k in zip(point, exponents, strict=True):
                value = value * pow(x, k, p) % p if k else value
            # The derivative of a monomial is the monomial times k / x.
            for i, k in enumerate(exponents):
                if k:
                    row[i] += value * k * inverse[i]
        rows.append(row)
    return LARGE.rank(rows) < n
