"""Dimension of the local ring at a zero, from Macaulay's matrices in the null directions alone.

The regular part of the equations is solved by power series first.

References:
    Dayton & Zeng, Computing the multiplicity structure in solving polynomial systems, 2005;
    Bates, Hauenstein, Peterson & Sommese, A numerical local dimension test, 2009.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement
from math import comb

import numpy as np

from nag.algebra.evaluation import Evaluator

# Orders of the Macaulay matrices that are tried; the last is the highest.
ORDERS = (3, 6, 12, 24)
MOST_MONOMIALS = 2000
# Relative size of singular values that count as zero at a point known to rounding.
ZERO = 1e-8


@dataclass(frozen=True, eq=False)
class _Series:
    """Power series in ``m`` variables modulo degree ``order + 1``, as coefficient vectors."""

    m: int
    order: int

    @cached_property
    def monomials(self) -> np.ndarray:
        rows = [
            tuple(chosen.count(i) for i in range(self.m))
            for degree in range(self.order + 1)
            for chosen in combinations_with_replacement(range(self.m), degree)
        ]
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
    evaluator: Evaluator,
    x: np.ndarray,
    along: np.ndarray,
    order: int,
    corank: Callable[[np.ndarray, int], int],
) -> tuple[_Series, np.ndarray] | None:
    """The equations in the null directions alone; None if there are none, or far too many."""
    n, k = along.shape
    u, s, vh = np.linalg.svd(evaluator.jacobian(x) @ along)
    m = corank(s, k)
    if m == 0 or comb(m + order, order) > MOST_MONOMIALS:
        return None
    ring, rank = _Series(m, order), k - m
    regular, null = along @ vh[:rank].conj().T, along @ vh[rank:].conj().T
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


def local_dimension(
    evaluator: Evaluator,
    x: np.ndarray,
    corank: Callable[[np.ndarray, int], int],
    along: np.ndarray | None = None,
) -> int | None:
    """Dimension of the local ring of ``evaluator`` at its zero ``x``, known to rounding.

    Args:
        evaluator: the polynomials, in ``n`` variables.
        x: the zero, shape ``(n,)``.
        corank: says from singular values, shape ``(s,)``, and a number of columns what the corank
            of a Jacobian is.
        along: directions of a linear space through ``x`` to which the equations are restricted,
            shape ``(n, k)``; default: the whole space.

    Returns:
        The dimension, or None where it has not settled by the highest of `ORDERS`, or the matrices
        become too large: the zero is not isolated, or of high multiplicity.
    """
    along = np.eye(len(x)) if along is None else along
    singular = np.linalg.svd(evaluator.jacobian(x) @ along, compute_uv=False)
    if corank(singular, along.shape[1]) == 0:
        return 1
    for order in ORDERS:
        reduced = _reduced(evaluator, x, along, order, corank)
        if reduced is None:
            return None
        ring, generators = reduced
        last = 1
        for k in range(1, order + 1):
            now = _nullity(ring, generators, k)
            if now == last:
                return now
            last = now
    return None
