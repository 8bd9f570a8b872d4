"""Null spaces in high precision, behind the interface that a prime field has as well."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import flint
import numpy as np

from nag.numerics.digits import doubles, log_norm, middle

Rows = Sequence[Sequence[Any]]

# Pivots in doubles, over the largest, of a block that is solved for at once; what is left of the
# matrix is looked at in all digits.
WELL = 1e-8


class UnclearRank(Exception):
    """A number is neither clearly zero nor clearly something else."""


class Field(Protocol):
    """What a computation over a field needs beside ``+`` and ``*``.

    `Digits` and `nag.algebra.exact_ranks.PrimeField` have it.
    """

    modulus: int

    def null_space(self, rows: Rows, columns: int) -> list[list[Any]]:
        """A basis of the vectors that all rows annihilate."""
        ...

    def is_zero(self, a: Any) -> bool: ...

    def product(self, left: Rows, right: Rows) -> list[list[Any]]:
        """The product of two matrices, neither of them empty."""
        ...

    def reduced(self, rows: Rows, columns: int) -> tuple[list[list[Any]], list[int]]:
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

    def product(self, left: Rows, right: Rows) -> list[list[flint.acb]]:
        found = (flint.acb_mat(left) * flint.acb_mat(right)).mid()
        return [[c if c else 0 for c in row] for row in found.tolist()]

    def reduced(self, rows: Rows, columns: int) -> tuple[list[list[flint.acb]], list[int]]:
        table = [list(row) for row in rows]
        pivots: list[int] = []
        for place, row in enumerate(table):
            pivots.append(max(range(columns), key=lambda j: log_norm([row[j]])))
            lead = row[pivots[-1]]
            table[place] = [middle(c / lead) if c else 0 for c in row]
            table[place][pivots[-1]] = flint.acb(1)
            for i, other in enumerate(table):
                factor = other[pivots[-1]]
                if i == place or not factor:
                    continue
                table[i] = [
                    middle(a - factor * b) if b else a
                    for a, b in zip(other, table[place], strict=True)
                ]
                table[i][pivots[-1]] = 0
        return table, pivots

    def null_space(self, rows: Rows, columns: int) -> list[list[flint.acb]]:
        """Elimination in blocks: doubles choose a well-conditioned one, digits do the rest."""
        matrix = [[flint.acb(c) for c in row] for row in rows]
        left, chosen = self._echelon(matrix, columns)
        free = [j for j in range(columns) if j not in chosen]
        basis = []
        solution: Any = None
        if chosen and free:
            block = flint.acb_mat([[matrix[i][j] for j in chosen] for i in left])
            right = flint.acb_mat([[matrix[i][j] for j in free] for i in left])
            solution = block.solve(right)
        for k, j in enumerate(free):
            vector = [flint.acb(0)] * columns
            vector[j] = flint.acb(1)
            for i, c in enumerate(chosen):
                vector[c] = middle(-solution[i, k])
            basis.append(vector)
        return basis

    def _echelon(self, matrix: list[list[flint.acb]], columns: int) -> tuple[list[int], list[int]]:
        """Rows and columns of a regular block beside which nothing else is left."""
        rows: list[int] = []
        chosen: list[int] = []
        while True:
            others = [i for i in range(len(matrix)) if i not in rows]
            free = [j for j in range(columns) if j not in chosen]
            rest = _schur_complement(matrix, rows, chosen, others, free)
            size = log_norm(c for row in rest for c in row)
            if not others or not free or self._negligible(size):
                return rows, chosen
            scale = flint.arb(10) ** flint.arb(int(size))
            block = np.array([doubles([c / scale for c in row]) for row in rest])
            i, j = _well_conditioned(block)
            rows += [others[k] for k in i]
            chosen += [free[k] for k in j]


def _schur_complement(
    matrix: list[list[flint.acb]],
    rows: list[int],
    chosen: list[int],
    others: list[int],
    free: list[int],
) -> list[list[flint.acb]]:
    rest = [[matrix[i][j] for j in free] for i in others]
    if not rows or not others or not free:
        return rest
    block = flint.acb_mat([[matrix[i][j] for j in chosen] for i in rows])
    right = flint.acb_mat([[matrix[i][j] for j in free] for i in rows])
    below = flint.acb_mat([[matrix[i][j] for j in chosen] for i in others])
    found = flint.acb_mat(rest) - below * block.solve(right).mid()
    return [[middle(c) for c in row] for row in found.tolist()]


def _well_conditioned(block: np.ndarray) -> tuple[list[int], list[int]]:
    """Rows and columns of a block that doubles see to be regular, as large as possible."""
    columns, diagonal = _pivoted(block)
    rank = max(1, int(np.sum(diagonal > WELL * diagonal[0])))
    rows, _ = _pivoted(block[:, columns[:rank]].T)
    return rows[:rank], columns[:rank]


def _pivoted(block: np.ndarray) -> tuple[list[int], np.ndarray]:
    """The order of the columns in a QR decomposition that always takes the longest, and lengths."""
    rest, lengths = np.array(block, dtype=complex), []
    order = list(range(rest.shape[1]))
    for k in range(min(rest.shape)):
        norms = np.linalg.norm(rest[:, k:], axis=0)
        best = k + int(norms.argmax())
        lengths.append(norms[best - k])
        if not lengths[-1]:
            break
        order[k], order[best] = order[best], order[k]
        rest[:, [k, best]] = rest[:, [best, k]]
        q = rest[:, k] / lengths[-1]
        for _ in range(2):
            rest[:, k + 1 :] -= np.outer(q, q.conj() @ rest[:, k + 1 :])
    return order, np.array(lengths)
