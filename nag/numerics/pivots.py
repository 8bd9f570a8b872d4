"""Rank at a point that is known roughly: elimination beside what the error may change."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from operator import itemgetter

import flint

from nag.numerics.digits import log_size

Matrix = list[list[flint.acb]]

# An entry is no zero if it exceeds what the error may change by this factor (decimal logarithm).
CLEAR = 0.5


def pivots(
    at: Callable[[int], Matrix], columns: int, copies: int, floor: float
) -> tuple[list[int], list[int]]:
    """Rows and columns of the largest block that is regular whatever the error of the point.

    Args:
        at: the matrix at the point (0), and at others as far from it as its error (from 1 on).
        columns: number of columns.
        copies: how many others there are.
        floor: decimal logarithm of what counts as zero anyway.
    """
    matrices = [[list(row) for row in at(i)] for i in range(copies + 1)]
    left, right = list(range(len(matrices[0]))), list(range(columns))
    rows: list[int] = []
    chosen: list[int] = []
    while left and right:
        best = _largest(matrices, left, right, floor)
        if best is None:
            break
        i, j = best
        left.remove(i)
        right.remove(j)
        rows.append(i)
        chosen.append(j)
        for matrix in matrices:
            _eliminate(matrix, i, j, left, right)
    return rows, chosen


def _largest(
    matrices: Sequence[Matrix], left: list[int], right: list[int], floor: float
) -> tuple[int, int] | None:
    first, *others = matrices
    largest: list[tuple[float, int, int]] = []
    for i in left:
        sizes = [(log_size(first[i][j]), j) for j in right]
        known = [entry for entry in sizes if floor < entry[0] < inf]
        if known:
            size, j = max(known, key=itemgetter(0))
            largest.append((size, i, j))
    # Noise is that of a row: where its largest entry is no clearer, no other is.
    for size, i, j in sorted(largest, key=itemgetter(0), reverse=True):
        changes = (other[i][k] - first[i][k] for other in others for k in right)
        if all(log_size(change) + CLEAR < size for change in changes):
            return i, j
    return None


def _eliminate(matrix: Matrix, i: int, j: int, left: list[int], right: list[int]) -> None:
    pivot = matrix[i][j]
    if not pivot:
        return
    for k in left:
        if matrix[k][j]:
            factor = matrix[k][j] / pivot
            for c in right:
                if matrix[i][c]:
                    matrix[k][c] = matrix[k][c] - factor * matrix[i][c]
