"""The smallest sets of vectors whose sum is zero, by reduction of a lattice.

Integer relations among vectors that are known to some digits are short vectors of a lattice
(Lenstra, Lenstra & Lovász 1982). What Gram and Schmidt leave of a reduced basis shows how long
every vector outside the span of its first ones is, so that all relations with coefficients 0 and 1
lie in the span of those (van Hoeij 2002, *Factoring polynomials and the knapsack problem*; for
traces of curves Chèze 2004). Disjoint sets that sum to zero and contain no others are its reduced
echelon form.
"""

from __future__ import annotations

import flint
import numpy as np

from nag.algebra.exact_ranks import row_echelon

# Bits for each vector, beside those of the bound, that let other vectors be seen to be longer: of
# random lattices reduced bases of 36 vectors needed 0.6, of 60 vectors 1.1.
SPARE = 1.5


def smallest_zero_sums(
    vectors: np.ndarray, error: int, weights: np.ndarray
) -> list[list[int]] | None:
    """The sets of vectors that sum to zero and contain no smaller such set, in order.

    Args:
        vectors: Python integers, shape ``(K, m)``.
        error: largest error of a coordinate of the sum of any of them, at least 1.
        weights: random integers, shape ``(m, m)``: sums are looked at in the columns that they
            take coordinates to, so many of them as decide.

    Returns:
        Disjoint lists of indices; None if vectors are not known to enough digits to tell. A sum
        that is found differs from zero by no more than some errors.
    """
    count = len(vectors)
    if not count:
        return []
    projected, unit = _project(vectors, error, weights)
    # Coefficients are multiplied by what makes roundings of entries small.
    spread = 1 << count.bit_length()
    entries = (2 * spread * projected + unit) // (2 * unit)
    columns = entries.shape[1]
    rows = [[spread * (i == j) for j in range(count)] + entries[i].tolist() for i in range(count)]
    reduced = flint.fmpz_mat(rows).lll()
    lengths = _orthogonal_lengths(reduced)
    short = np.flatnonzero(lengths <= spread * np.sqrt(_longest(count, columns)))
    kept = int(short[-1]) + 1 if len(short) else 0
    relations = [[int(reduced[i, j]) // spread for j in range(count)] for i in range(kept)]
    sets = _disjoint_sets(relations)
    if sets is None or any(np.abs(vectors[own].sum(axis=0)).max() > error for own in sets):
        return None
    return sets


def _longest(count: int, columns: int) -> float:
    """Square of the length of a set that sums to zero, with errors and roundings."""
    return count + 1.5**2 * columns


def _project(vectors: np.ndarray, error: int, weights: np.ndarray) -> tuple[np.ndarray, int]:
    """As many columns of the projected vectors as may decide, and the errors of their sums."""
    count, most = len(vectors), weights.shape[1]
    unit = max(1, error) * int(np.abs(weights).sum(axis=0).max())
    first = vectors @ weights[:, :1].astype(object)
    bits = max(1, (int(np.abs(first).max()) // unit).bit_length())
    columns = 1
    while columns < most and bits * columns < _count_bits_needed(count, columns):
        columns += 1
    return vectors @ weights[:, :columns].astype(object), unit


def _count_bits_needed(count: int, columns: int) -> float:
    """Bits of all columns together that let relations be told from other vectors."""
    return count * (np.log2(_longest(count, columns)) / 2 + SPARE)


def _orthogonal_lengths(basis) -> np.ndarray:
    """Lengths of the vectors of a reduced basis without their parts along earlier ones."""
    rows = np.array([[float(x) for x in row] for row in basis.table()])
    return np.abs(np.diag(np.linalg.qr(rows.T, mode="r")))


def _disjoint_sets(relations: list[list[int]]) -> list[list[int]] | None:
    """Disjoint sets whose indicators span what these vectors span; None if there are none such."""
    if not relations:
        return []
    sets = []
    for row in row_echelon(relations)[0]:
        if any(c not in (0, 1) for c in row):
            return None
        sets.append([j for j, c in enumerate(row) if c])
    members = [j for own in sets for j in own]
    return sets if len(set(members)) == len(members) else None
