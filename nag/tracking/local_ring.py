"""Dimension of the local ring at a zero, from Macaulay's matrices in the null directions alone.

The regular part of the equations is solved by power series first. Reference: Dayton & Zeng,
Computing the multiplicity structure in solving polynomial systems, 2005.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from nag.algebra.evaluation import Evaluator

HIGHEST_ORDER = 16
MOST_MONOMIALS = 1200
# Relative size of singular values that count as zero at a point known to rounding.
ZERO = 1e-8


@dataclass(frozen=True, eq=False)
class _Series:
    """Power series in ``m`` variables modulo degree ``order + 1``, as coefficient vectors."""

    m: int
    order: int

    @cached_property
    def monomials(self) -> np.ndarray:
        rows = [e for e in product(range(self.order + 1), repeat=self.m) if sum(e) <= self.order]
        rows.sort(key=lambda e: (sum(e), e))
        return np.array(rows, dtype=np.int64).reshape(len(rows), self.m)

    @cached_property
    def degrees(self) -> np.ndarray:
        return self.monomials.sum(axis=1)

    @cached_property
    def _index(self) -> dict[tuple[int, ...], int]:
        return {tuple(e): i for i, e in enumerate(self.monomials.tolist())}

    @cached_property
    def _targets(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """For each monomial: which monomials it may be multiplied with, and the products."""
        result = []
        for e, d in zip(self.monomials, self.degrees, strict=True):
            fits = np.flatnonzero(self.degrees <= self.order - d)
            products = (self.monomials[fits] + e).tolist()
            result.append((fits, np.array([self._index[tuple(f)] for f in products])))
        return result

    def shifted(self, a: np.ndarray, monomial: int) -> np.ndarray:
        fits, places = self._targets[monomial]
        result = np.zeros_like(a)
        result[places] = a[fits]
        return result

    def multiply(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        result = np.zeros_like(a)
        for k in np.flatnonzero(a):
            result += a[k] * self.shifted(b, int(k))
        return result


def corank_at(singular: np.ndarray, columns: int, accuracy: float) -> int:
    """Corank of a scaled Jacobian, read at the widest gap of its singular values."""
    values = np.zeros(columns)
    values[: min(columns, len(singular))] = singular[:columns]
    floor = max(accuracy, 1e-15)
    # The first entry stands for the size that coefficients of order one give a Jacobian.
    ladder = np.maximum(np.concatenate([[max(values.max(initial=0.0), 0.1)], values]), floor)
    best, corank = 1e2, 0
    for rank in range(columns):
        ratio = ladder[rank] / ladder[rank + 1]
        if ladder[rank + 1] < 1e-3 and ratio > best:
            best, corank = ratio, columns - rank
    return corank


def _values(evaluator: Evaluator, ring: _Series, images: np.ndarray) -> np.ndarray:
    powers: dict[tuple[int, int], np.ndarray] = {}

    def power(i: int, k: int) -> np.ndarray:
        if (i, k) not in powers:
            powers[i, k] = images[i] if k == 1 else ring.multiply(power(i, k - 1), images[i])
        return powers[i, k]

    monomials = np.zeros((len(evaluator.exponents), len(ring.monomials)), dtype=complex)
    for row, exponents in enumerate(evaluator.exponents.tolist()):
        value = np.zeros(len(ring.monomials), dtype=complex)
        value[0] = 1
        for i, k in enumerate(exponents):
            if k:
                value = ring.multiply(power(i, k), value)
        monomials[row] = value
    return evaluator.coefficients @ monomials


def _reduced(
    evaluator: Evaluator, x: np.ndarray, order: int, accuracy: float
) -> tuple[_Series, np.ndarray] | None:
    n = len(x)
    u, s, vh = np.linalg.svd(evaluator.jacobian(x))
    m = corank_at(s, n, accuracy)
    if m == 0:
        return None
    ring, rank = _Series(m, order), n - m
    regular, null = vh[:rank].conj().T, vh[rank:].conj().T
    base = np.zeros((n, len(ring.monomials)), dtype=complex)
    for i, e in enumerate(ring.monomials.tolist()):
        if sum(e) == 1:
            base[:, i] = null[:, e.index(1)]
    base[:, 0] = x
    solved = np.zeros((rank, len(ring.monomials)), dtype=complex)
    values = _values(evaluator, ring, base)
    for _ in range(order if rank else 0):
        correction = u[:, :rank].conj().T @ values / s[:rank, None]
        correction[:, 0] = 0
        solved -= correction
        values = _values(evaluator, ring, base + regular @ solved)
    rest = u[:, rank:].conj().T @ values
    rest[:, ring.degrees <= 1] = 0
    return ring, rest


def _nullity(ring: _Series, generators: np.ndarray, order: int) -> int:
    keep = ring.degrees <= order
    table = []
    for k in np.flatnonzero(ring.degrees < order):
        for g in generators:
            row = ring.shifted(g, int(k))[keep]
            size = np.linalg.norm(row)
            if size > ZERO:
                table.append(row / size)
    columns = int(keep.sum())
    if not table:
        return columns
    s = np.linalg.svd(np.array(table), compute_uv=False)
    return columns - int(np.sum(s > ZERO * s[0]))


def local_dimension(evaluator: Evaluator, x: np.ndarray, accuracy: float = 1e-12) -> int | None:
    """Dimension of the local ring of ``evaluator`` at its zero ``x``, known to rounding.

    None where the dimensions have not settled by order `HIGHEST_ORDER`, or the matrices become
    too large: the zero is not isolated, or of high multiplicity.
    """
    order = 3
    while order <= HIGHEST_ORDER:
        reduced = _reduced(evaluator, x, order, accuracy)
        if reduced is None:
            return 1
        ring, generators = reduced
        if len(ring.monomials) > MOST_MONOMIALS:
            return None
        last = 1
        for k in range(1, order + 1):
            now = _nullity(ring, generators, k)
            if now == last:
                return now
            last = now
        order += 3 if order < 6 else order
    return None
