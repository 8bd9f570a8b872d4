"""Truncated power series in a few variables, as vectors of coefficients."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np


@dataclass(frozen=True, eq=False)
class SeriesRing:
    """Power series in ``m`` variables modulo terms of degree above ``order``.

    Attributes:
        monomials: exponents, by rising degree; a series is the vector of their coefficients.
    """

    m: int
    order: int
    monomials: tuple[tuple[int, ...], ...]
    _triples: tuple[np.ndarray, np.ndarray, np.ndarray]

    @classmethod
    def of(cls, m: int, order: int) -> SeriesRing:
        exponents = [e for e in product(range(order + 1), repeat=m) if sum(e) <= order]
        exponents.sort(key=lambda e: (sum(e), e))
        index = {e: i for i, e in enumerate(exponents)}
        triples = []
        for i, e in enumerate(exponents):
            for j, f in enumerate(exponents):
                k = index.get(tuple(map(int.__add__, e, f)))
                if k is not None:
                    triples.append((i, j, k))
        left, right, target = np.array(triples).T
        return cls(m, order, tuple(exponents), (left, right, target))

    def __len__(self) -> int:
        return len(self.monomials)

    def multiply(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Product of two series."""
        left, right, target = self._triples
        terms = a[left] * b[right]
        result = np.zeros(len(self), dtype=complex)
        np.add.at(result, target, terms)
        return result

    def degrees(self) -> np.ndarray:
        """Degrees of the monomials."""
        return np.array([sum(e) for e in self.monomials])

    def shifted(self, a: np.ndarray, exponents: tuple[int, ...]) -> np.ndarray:
        """A series times a monomial."""
        unit = np.zeros(len(self), dtype=complex)
        unit[self.monomials.index(exponents)] = 1
        return self.multiply(unit, a)
