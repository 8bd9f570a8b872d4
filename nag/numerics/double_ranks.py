"""Ranks of matrices of doubles: at a gap of singular values, by rows that are far from dependent.

One of three ways to tell a rank; `nag.algebra.exact_ranks` has that of exact matrices, and
`nag.numerics.ball_ranks` that of numbers with radii, which takes over where doubles show no gap.

References:
    Businger & Golub, Linear least squares solutions by Householder transformations, 1965.
"""

from __future__ import annotations

import numpy as np

# A rank is read where neighbouring singular values differ by this factor, below one of the next: at
# a point of a component, and at one that is known to be singular, though perhaps not well.
GAP, SINGULAR, NEARLY_SINGULAR = 1e3, 1e-9, 1e-5
# A singular value, beside the largest, of zero.
NOTHING = 1e-17
# Larger matrices are left to LAPACK, which takes longer to load than smaller ones take.
MOST_ENTRIES = 10_000


def numerical_corank(singular: np.ndarray, columns: int, small: float) -> int:
    """Corank of a balanced Jacobian with ``columns`` columns, at the gap of its singular values.

    The widest gap counts whose lower side is below ``small``, and that is at least a factor
    `GAP`. Entries of a balanced matrix are of order one, so a matrix of rank zero shows a gap
    below one.
    """
    s = np.zeros(columns)
    s[: len(singular)] = singular[:columns]
    s = np.maximum(s / max(1.0, s.max(initial=0.0)), NOTHING)
    above, best, corank = 1.0, GAP, 0
    for rank, value in enumerate(s):
        if value < small and above / value > best:
            best, corank = above / value, columns - rank
        above = value
    return corank


def matrix_corank(matrix: np.ndarray, small: float = SINGULAR) -> int:
    """Corank of a balanced matrix of doubles, see `numerical_corank`."""
    singular = np.linalg.svd(matrix, compute_uv=False)
    return numerical_corank(singular, matrix.shape[1], small)


def pivot_rows(matrix: np.ndarray, count: int | None = None) -> tuple[list[int], np.ndarray]:
    """Rows one by one, each the longest beside the span of those before, and these lengths.

    Args:
        matrix: shape ``(m, n)``.
        count: how many, at most; all that there can be, ``min(m, n)``, if it is left out.
    """
    most = min(matrix.shape)
    count = most if count is None else min(count, most)
    if matrix.size > MOST_ENTRIES:
        from scipy.linalg import qr

        triangle, order = qr(matrix.T, mode="r", pivoting=True)
        return order[:count].tolist(), np.abs(np.diag(triangle))[:count]
    rest, chosen, lengths = np.array(matrix, dtype=complex), [], np.zeros(count)
    for k in range(count):
        left = np.linalg.norm(rest, axis=1)
        left[chosen] = -1.0
        best = int(left.argmax())
        chosen.append(best)
        lengths[k] = left[best]
        if left[best] > 0:
            unit = rest[best] / left[best]
            # Once more, as rounding errors of the first time count beside small rows.
            for _ in range(2):
                rest = rest - (rest @ unit.conj())[:, None] * unit
    return chosen, lengths
