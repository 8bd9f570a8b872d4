"""Multiplicity of an isolated zero: the dimension of its local ring.

The regular part of the equations is solved by power series first; Macaulay's matrices of what is
left, in as many variables as the Jacobian has null vectors, then give the dual space
(Dayton & Zeng 2005; Bates, Hauenstein, Peterson & Sommese 2009).
"""

from __future__ import annotations

import numpy as np
import scipy.linalg

from nag.algebra.evaluation import Evaluator
from nag.decomposition.cutting import numerical_corank
from nag.decomposition.series import SeriesRing
from nag.decomposition.slices import padded

HIGHEST_ORDER = 24
# Relative size of singular values that count as zero at a point known to rounding.
ZERO = 1e-8


def _series_values(
    evaluator: Evaluator, ring: SeriesRing, images: list[np.ndarray]
) -> list[np.ndarray]:
    """The polynomials at a vector of series."""
    powers: dict[tuple[int, int], np.ndarray] = {}

    def power(i: int, k: int) -> np.ndarray:
        if k == 1:
            return images[i]
        if (i, k) not in powers:
            powers[i, k] = ring.multiply(power(i, k - 1), images[i])
        return powers[i, k]

    one = np.zeros(len(ring), dtype=complex)
    one[0] = 1
    monomials = []
    for exponents in evaluator.exponents:
        value = one
        for i, k in enumerate(exponents):
            if k:
                value = ring.multiply(value, power(i, int(k)))
        monomials.append(value)
    table = np.array(monomials).reshape(len(monomials), len(ring))
    return list(evaluator.coefficients @ table)


def _reduced(
    evaluator: Evaluator, rows: np.ndarray, x: np.ndarray, order: int
) -> tuple[SeriesRing, np.ndarray] | None:
    """The equations along the slice in the null directions alone, to the given order."""
    n = len(x)
    a = padded(rows, 1 + n)[:, 1:]
    along = scipy.linalg.null_space(a) if len(a) else np.eye(n, dtype=complex)
    jacobian = evaluator.jacobian(x) @ along
    u, s, vh = np.linalg.svd(jacobian)
    m = numerical_corank(s, along.shape[1], ZERO)
    rank = along.shape[1] - m
    if m == 0:
        return None
    ring = SeriesRing.of(m, order)
    regular, null = along @ vh[:rank].conj().T, along @ vh[rank:].conj().T
    linear = np.zeros((m, len(ring)), dtype=complex)
    for j in range(m):
        linear[j, ring.monomials.index(tuple(int(i == j) for i in range(m)))] = 1
    base = null @ linear
    base[:, 0] += x
    solved = np.zeros((rank, len(ring)), dtype=complex)
    values = np.array(_series_values(evaluator, ring, list(base + regular @ solved)))
    for _ in range(order):
        correction = u[:, :rank].conj().T @ values / s[:rank, None]
        correction[:, 0] = 0
        solved -= correction
        values = np.array(_series_values(evaluator, ring, list(base + regular @ solved)))
    rest = u[:, rank:].conj().T @ values
    rest[:, ring.degrees() <= 1] = 0
    return ring, rest


def _nullity(ring: SeriesRing, generators: np.ndarray, order: int) -> int:
    """Dimension of the local ring modulo terms of degree above ``order``."""
    keep = ring.degrees() <= order
    table = []
    for exponents in ring.monomials:
        if sum(exponents) < order:
            for g in generators:
                row = ring.shifted(g, exponents)[keep]
                size = np.linalg.norm(row)
                if size > ZERO:
                    table.append(row / size)
    columns = int(keep.sum())
    if not table:
        return columns
    s = np.linalg.svd(np.array(table), compute_uv=False)
    return columns - int(np.sum(s > ZERO * s[0]))


def multiplicity(evaluator: Evaluator, rows: np.ndarray, x: np.ndarray) -> int:
    """Multiplicity of the zero ``x`` of ``evaluator`` on the slice ``rows``; 0 if not found.

    ``x`` must be known to rounding. It is 0 where the dimensions have not settled by order
    `HIGHEST_ORDER`, as at a point that is not isolated on the slice.
    """
    order = 4
    while order <= HIGHEST_ORDER:
        reduced = _reduced(evaluator, rows, x, order)
        if reduced is None:
            return 1
        ring, generators = reduced
        if len(ring) > 3000:
            return 0
        last = 1
        for k in range(1, order + 1):
            now = _nullity(ring, generators, k)
            if now == last and k > 1:
                return now
            last = now
        order *= 2
    return 0
