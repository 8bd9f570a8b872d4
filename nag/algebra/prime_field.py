"""Numbers and matrices modulo a prime, by FLINT, which is loaded when a matrix is made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import flint

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
        import flint

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
