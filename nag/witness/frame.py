"""Reduced coordinates, after linear equations were solved exactly, and the original ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.elimination import Elimination
from nag.witness.witness import Slice


@dataclass(frozen=True, eq=False)
class Frame:
    """How reduced coordinates sit in the original ones: ``x = T y + t``.

    Attributes:
        positions: the original coordinate that each y is, but for its scale.
        scales: ``x = scale * y`` for these; powers of two.
    """

    T: np.ndarray
    t: np.ndarray
    positions: tuple[int, ...]
    scales: np.ndarray

    @classmethod
    def of(cls, elimination: Elimination) -> Frame:
        m = elimination.system.n
        T = np.zeros((len(elimination.images), m))
        t = np.zeros(len(elimination.images))
        for i, image in enumerate(elimination.images):
            for exponents, coefficient in image.terms.items():
                if any(exponents):
                    T[i, exponents.index(1)] = float(coefficient)
                else:
                    t[i] = float(coefficient)
        names = elimination.original_variables
        positions = tuple(names.index(v) for v in elimination.system.variables)
        return cls(T, t, positions, np.ones(m))

    def scaled(self, scales: np.ndarray) -> Frame:
        """The frame of new coordinates, ``scales`` times smaller."""
        return Frame(self.T * scales, self.t, self.positions, self.scales * scales)

    def points(self, y: np.ndarray) -> np.ndarray:
        return y @ self.T.T + self.t

    def slice(self, rows: np.ndarray) -> Slice:
        """A slice of the reduced space as one of the original space: its coordinates are kept."""
        A = np.zeros((len(rows), len(self.t)), dtype=complex)
        A[:, self.positions] = rows[:, 1:] / self.scales
        b = -rows[:, 0]
        if (self.scales != 1).any():
            q, r = np.linalg.qr(A.conj().T)
            A, b = q.conj().T, np.linalg.solve(r.conj().T, b)
        return Slice(A, b)

    def pulled_back(self, A: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Rows on reduced homogeneous coordinates for ``A x = b``."""
        return np.hstack([(A @ self.t - b)[:, None], A @ self.T])
