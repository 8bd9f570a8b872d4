"""Newton's step for two rounds of deflation, by Jacobians in place of power series.

Where the first round leaves terms of second order, the derivatives that the second one is about are
entries of the Schur complement of the first one's block. Their own derivatives are differences of
Jacobians: right to half of the digits, so that Newton's method converges as fast as with exact ones
until that, and then by as many digits a step.

References:
    Hauenstein & Wampler, Isosingular sets and deflation, 2013.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import flint

from nag.numerics.descent import Point, Round
from nag.numerics.digits import LOG10_2, in_bits, log_norm, middle
from nag.numerics.exact_system import PointValues
from nag.numerics.implicit_function import Matrix


@dataclass(frozen=True, eq=False)
class SecondStep:
    """Newton's step to be added, and the decimal logarithm of the first block's inverse."""

    displacement: Point
    inverse: float


@dataclass(frozen=True, eq=False)
class SecondRound:
    """Two rounds, the first of which leaves terms of second order.

    Attributes:
        functions: the equations.
        first: the first round.
        free, others: the variables and the equations that it leaves.
        entries: which slopes vanish, as places among the others and among the free variables.
        solved: places among the free variables that these determine.
    """

    functions: PointValues
    first: Round
    free: tuple[int, ...]
    others: tuple[int, ...]
    entries: tuple[tuple[int, int], ...]
    solved: tuple[int, ...]

    @classmethod
    def of(
        cls, functions: PointValues, equations: int, rounds: Sequence[Round]
    ) -> SecondRound | None:
        """None where the rounds are of other kinds."""
        if len(rounds) != 2 or rounds[0].order != 2 or not rounds[0].columns:
            return None
        first, second = rounds
        free = tuple(i for i in range(functions.n) if i not in first.columns)
        others = tuple(i for i in range(equations) if i not in first.rows)
        # The derivatives stand row by row, those by the last variable first.
        m = len(free)
        entries = tuple((i // m, m - 1 - i % m) for i in second.rows)
        return cls(functions, first, free, others, entries, second.columns)

    def step(self, x: Point) -> SecondStep | None:
        """Newton's step; None where a block is singular."""
        with in_bits(self.functions.bits):
            return self._step(x)

    def _step(self, x: Point) -> SecondStep | None:
        slopes, values = self.functions.jacobian(x), self.functions.values(x)
        rows, size = self.first.rows, len(self.entries)
        try:
            inverse = _part(slopes, rows, self.first.columns).inv().mid()
            tangents = (inverse * _part(slopes, rows, self.free)).mid()
            weights = (_part(slopes, self.others, self.first.columns) * inverse).mid()
            block = inverse * flint.acb_mat(len(rows), 1, [values[i] for i in rows])
            moves = [self._move(block.mid().entries())]
            moves += [self._move([row[k] for row in tangents.tolist()], k) for k in self.solved]
            here = self._slopes(slopes, tangents, weights)
            change, *bending = (
                self._slopes(self._derived(x, move, slopes), tangents, weights) for move in moves
            )
            right = [a + b for a, b in zip(here, change, strict=True)]
            columns = [c for line in zip(*bending, strict=True) for c in line]
            found = flint.acb_mat(size, size, columns).solve(flint.acb_mat(size, 1, right))
        except ZeroDivisionError:
            return None
        total = moves[0]
        for c, move in zip(found.mid().entries(), moves[1:], strict=True):
            total = [middle(a - c * b) for a, b in zip(total, move, strict=True)]
        return SecondStep(total, log_norm(inverse.entries()))

    def _move(self, taken: Sequence[flint.acb], free: int | None = None) -> Point:
        """So much less of the first block's variables, and one more of a free one."""
        result = [flint.acb(0)] * self.functions.n
        for j, c in zip(self.first.columns, taken, strict=True):
            result[j] = -c
        if free is not None:
            result[self.free[free]] = flint.acb(1)
        return result

    def _slopes(
        self, jacobian: Matrix, tangents: flint.acb_mat, weights: flint.acb_mat
    ) -> list[flint.acb]:
        """The entries of what is left of a matrix when the first block is eliminated."""
        rows, columns = self.first.rows, self.first.columns
        whole = _part(jacobian, self.others, self.free)
        whole = whole - _part(jacobian, self.others, columns) * tangents
        above = _part(jacobian, rows, self.free) - _part(jacobian, rows, columns) * tangents
        table = (whole - weights * above).mid().tolist()
        return [table[i][k] for i, k in self.entries]

    def _derived(self, x: Point, move: Point, slopes: Matrix) -> Matrix:
        """How the Jacobian changes along a move."""
        size = log_norm(move)
        if size == -inf:
            return [[flint.acb(0)] * len(row) for row in slopes]
        share = flint.arb(2) ** -int(self.functions.bits / 2 + size / LOG10_2)
        ahead = [middle(a + b * share) for a, b in zip(x, move, strict=True)]
        further = self.functions.jacobian(ahead)
        return [
            [middle((b - a) / share) for a, b in zip(*lines, strict=True)]
            for lines in zip(slopes, further, strict=True)
        ]


def _part(matrix: Matrix, rows: Sequence[int], columns: Sequence[int]) -> flint.acb_mat:
    entries = [matrix[i][j] for i in rows for j in columns]
    return flint.acb_mat(len(rows), len(columns), entries)
