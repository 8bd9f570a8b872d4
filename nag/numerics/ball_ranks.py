"""Ranks of matrices of numbers with errors: one elimination, whose pivots are certainly no zeros.

One of three ways to tell a rank; `nag.algebra.exact_ranks` has that of exact matrices, and
`nag.numerics.double_ranks` that of doubles. An error is known in one of three ways:

- by radii: an entry is no zero where its ball does not hold zero, and the rank that elimination
  finds is a proof that it is no less;
- by copies, the same matrix at points as far away as its error: an entry is no zero where it
  exceeds what it changes by. This is sharper than radii, as errors that depend on each other
  cancel, and is evidence;
- by what counts as nothing in so many digits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from operator import itemgetter
from typing import Any, Protocol

import flint
import numpy as np

from nag.numerics.digits import doubles, log_norm, log_size, middle
from nag.numerics.double_ranks import pivot_rows

Matrix = Sequence[Sequence[Any]]
# Indices of rows and of columns.
Places = tuple[list[int], list[int]]

# Decides: Decimal logarithm of a pivot over its error that makes it no zero.
CLEAR = 0.5
# Pivots, over the largest, of a block that doubles solve for; the rest is for all digits.
WELL = 1e-8


class UnclearRank(Exception):
    """A number is neither clearly zero nor clearly something else."""


@dataclass(frozen=True, eq=False)
class RegularBlock:
    """A regular block of a matrix, as large as is certain.

    Attributes:
        rows, columns: indices, those of one pivot after the other.
        rest: what elimination leaves of the other rows in the other columns, in their order.
    """

    rows: list[int]
    columns: list[int]
    rest: list[list[Any]]

    @property
    def rank(self) -> int:
        return len(self.rows)

    def solve(self, matrix: Matrix, right: Matrix) -> list[list[flint.acb]]:
        """The solution of the block's rows of ``matrix`` for its columns, as balls.

        Args:
            right: all rows of right sides.
        """
        block = flint.acb_mat([[matrix[i][j] for j in self.columns] for i in self.rows])
        return block.solve(flint.acb_mat([list(right[i]) for i in self.rows])).tolist()


def regular_block(
    matrix: Matrix, columns: int, nothing: float | None = None, copies: Sequence[Matrix] = ()
) -> RegularBlock:
    """The largest regular block, the largest certain entry taken as a pivot each time.

    Args:
        columns: number of columns.
        nothing: decimal logarithm of what counts as zero anyway, far above rounding: numbers are
            their midpoints. Radii count if it is left out.
        copies: the matrix at other points, as far away as the error.
    """
    return _eliminate([matrix, *copies], columns, partial(_largest, nothing), nothing is None)


def row_echelon(rows: Matrix, nothing: float) -> list[list[flint.acb]]:
    """The reduced echelon form of rows of so many digits, without the rows that vanish.

    Args:
        nothing: decimal logarithm of what counts as zero.
    """
    columns = len(rows[0]) if rows else 0
    block = _eliminate([rows], columns, partial(_in_first_column, nothing), radii=False)
    return block.solve(rows, rows) if block.rank else []


def known_zero(rest: Iterable[flint.acb | flint.arb], limit: flint.arb) -> bool | None:
    """Whether balls are all zero as far as they tell; None where some are too large to tell.

    Args:
        limit: the largest absolute value in a ball that counts as zero.
    """
    balls = list(rest)
    if not all(z.contains(0) for z in balls):
        return False
    return True if all(z.abs_upper() <= limit for z in balls) else None


def least_size(z: flint.acb | int) -> float:
    """The decimal logarithm of the least absolute value in a ball; ``-inf`` if it may be zero."""
    if isinstance(z, int):
        return log_size(z)
    least = z.abs_lower()
    return log_size(flint.acb(least)) if least > 0 else -inf


def _eliminate(
    matrices: Sequence[Matrix],
    columns: int,
    choose: Callable[[Sequence[Matrix]], Places | None],
    radii: bool,
) -> RegularBlock:
    """Elimination in a matrix and its copies.

    Args:
        choose: which rows and columns are next, of what is left of the matrices; None to end.
        radii: whether they are kept.
    """
    left, right = list(range(len(matrices[0]))), list(range(columns))
    rests = [[list(row) for row in matrix] for matrix in matrices]
    block = RegularBlock([], [], rests[0])
    while left and right:
        places = choose(rests)
        if places is None:
            break
        block.rows.extend(left[i] for i in places[0])
        block.columns.extend(right[j] for j in places[1])
        left, right = _without(left, places[0]), _without(right, places[1])
        rests = [_schur_complement(rest, *places, radii) for rest in rests]
    return RegularBlock(block.rows, block.columns, rests[0])


def _without(values: Sequence[Any], places: Sequence[int]) -> list[Any]:
    gone = set(places)
    return [value for k, value in enumerate(values) if k not in gone]


def _schur_complement(
    matrix: Matrix, rows: list[int], columns: list[int], radii: bool
) -> list[list[Any]]:
    """What is left of the other rows in the other columns when a block has been solved for."""
    rest = [_without(row, columns) for row in _without(matrix, rows)]
    below = [[row[j] for j in columns] for row in _without(matrix, rows)]
    # Zeros stay zeros, also beside numbers of which nothing is known.
    changed = [i for i, factors in enumerate(below) if any(factors)]
    if not changed or not rest[0]:
        return rest
    block = flint.acb_mat([[matrix[i][j] for j in columns] for i in rows])
    solved = block.solve(flint.acb_mat([_without(matrix[i], columns) for i in rows]))
    found = flint.acb_mat([rest[i] for i in changed])
    found -= flint.acb_mat([below[i] for i in changed]) * solved
    for i, row in zip(changed, (found if radii else found.mid()).tolist(), strict=True):
        rest[i] = row
    return rest


def _largest(nothing: float | None, matrices: Sequence[Matrix]) -> Places | None:
    """The largest entry that is certainly no zero."""
    first, *others = matrices
    floor = -inf if nothing is None else nothing
    largest: list[tuple[float, int, int]] = []
    for i, row in enumerate(first):
        size, j = max(((least_size(z), j) for j, z in enumerate(row)), key=itemgetter(0))
        if size > floor:
            largest.append((size, i, j))
    # Noise is that of a row: where its largest entry is no clearer, no other is.
    for size, i, j in sorted(largest, key=itemgetter(0), reverse=True):
        pairs = ((a, b) for other in others for a, b in zip(other[i], first[i], strict=True))
        if all(log_size(a - b) + CLEAR < size for a, b in pairs):
            return [i], [j]
    return None


def _in_first_column(nothing: float, matrices: Sequence[Matrix]) -> Places | None:
    """The largest entry of the first column that has one that is no zero."""
    (matrix,) = matrices
    for j in range(len(matrix[0])):
        size, i = max(((least_size(row[j]), i) for i, row in enumerate(matrix)), key=itemgetter(0))
        if size > nothing:
            return [i], [j]
    return None


class Field(Protocol):
    """What a computation over a field needs beside ``+`` and ``*``.

    `Digits` and `nag.algebra.exact_ranks.PrimeField` have it.
    """

    modulus: int

    def null_space(self, rows: Matrix, columns: int) -> list[list[Any]]:
        """A basis of the vectors that all rows annihilate."""
        ...

    def is_zero(self, a: Any) -> bool: ...

    def product(self, left: Matrix, right: Matrix) -> list[list[Any]]:
        """The product of two matrices, neither of them empty."""
        ...

    def reduced(self, rows: Matrix, columns: int) -> tuple[list[list[Any]], list[int]]:
        """Independent rows combined so that each has a 1 where the others have 0.

        These entries, of which the indices are returned too, are in the first ``columns`` columns.
        """
        ...


@dataclass(frozen=True)
class Digits:
    """Complex numbers known to ``digits`` digits: what is below ``10^zero`` is zero.

    What lies between that and ``10^clear``, beside entries of order one, is not decided.
    """

    digits: int
    zero: float
    clear: float
    modulus: int = 0

    def is_zero(self, a: flint.acb | int) -> bool:
        return self._negligible(log_norm([a]))

    def _negligible(self, size: float) -> bool:
        if self.zero < size < self.clear:
            raise UnclearRank(f"a number of 1e{size:.0f} may be zero or not")
        return size <= self.zero

    def product(self, left: Matrix, right: Matrix) -> list[list[Any]]:
        found = (flint.acb_mat(left) * flint.acb_mat(right)).mid()
        return [[c if c else 0 for c in row] for row in found.tolist()]

    def reduced(self, rows: Matrix, columns: int) -> tuple[list[list[Any]], list[int]]:
        block = self._block([row[:columns] for row in rows], columns)
        if block.rank < len(rows):
            raise UnclearRank("independent rows depend on each other in these digits")
        table = [
            [0 if log_size(c) <= self.zero else middle(c) for c in row]
            for row in block.solve(rows, rows)
        ]
        return table, block.columns

    def null_space(self, rows: Matrix, columns: int) -> list[list[flint.acb]]:
        block = self._block(rows, columns)
        free = _without(range(columns), block.columns)
        basis = [[flint.acb(int(i == j)) for i in range(columns)] for j in free]
        if block.rank and free:
            solution = block.solve(rows, [[row[j] for j in free] for row in rows])
            for c, values in zip(block.columns, solution, strict=True):
                for vector, value in zip(basis, values, strict=True):
                    vector[c] = middle(-value)
        return basis

    def _block(self, rows: Matrix, columns: int) -> RegularBlock:
        """Elimination in blocks: doubles choose a well-conditioned one, digits do the rest."""
        return _eliminate([rows], columns, self._choose, radii=False)

    def _choose(self, matrices: Sequence[Matrix]) -> Places | None:
        (rest,) = matrices
        size = log_norm(c for row in rest for c in row)
        if self._negligible(size):
            return None
        scale = flint.arb(10) ** flint.arb(int(size))
        return _well_conditioned(np.array([doubles([c / scale for c in row]) for row in rest]))


def _well_conditioned(matrix: np.ndarray) -> Places:
    """Rows and columns of a block that doubles see to be regular, as large as possible."""
    columns, lengths = pivot_rows(matrix.T)
    rank = max(1, int(np.sum(lengths > WELL * lengths[0])))
    rows, _ = pivot_rows(matrix[:, columns[:rank]])
    return rows[:rank], columns[:rank]
