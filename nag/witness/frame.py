"""Reduced coordinates, after linear equations were solved exactly, and the original ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.elimination import Elimination
from nag.witness.witness import Slice

EPS = float(np.finfo(float).eps)


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

    def error(self, y: np.ndarray, accuracy: float) -> float:
        """The largest error of `points`, relative to ``1 + |x|``, where y has that one to its size.

        Sums that cancel lose digits.
        """
        off = accuracy * (1 + np.linalg.norm(y, axis=1))
        rounding = EPS * (np.abs(y) @ np.abs(self.T).T + np.abs(self.t))
        moved = off[:, None] * np.linalg.norm(self.T, axis=1) + rounding
        sizes = 1 + np.linalg.norm(self.points(y), axis=1)
        return float((np.linalg.norm(moved, axis=1) / sizes).max(initial=EPS))

    def slice(self, rows: np.ndarray, orthonormal: bool = True) -> Slice:
        """A slice of the reduced space as one of the original space: its coordinates are kept.

        Where coordinates are scaled, making the rows orthonormal rounds them; without it they are
        exact.
        """
        A = np.zeros((len(rows), len(self.t)), dtype=complex)
        A[:, self.positions] = rows[:, 1:] / self.scales
        b = -rows[:, 0]
        if (self.scales != 1).any() and not orthonormal:
            powers = -np.frexp(np.linalg.norm(A, axis=1))[1]
            A, b = A * np.ldexp(1.0, powers)[:, None], b * np.ldexp(1.0, powers)
        elif (self.scales != 1).any():
            q, r = np.linalg.qr(A.conj().T)
            A, b = q.conj().T, np.linalg.solve(r.conj().T, b)
        return Slice(A, b)

    def pulled_back(self, A: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Rows on reduced homogeneous coordinates for ``A x = b``."""
        return np.hstack([(A @ self.t - b)[:, None], A @ self.T])
