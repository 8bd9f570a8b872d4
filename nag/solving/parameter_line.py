"""Homotopies in which the parameters of a family move along a straight line.

Reference: Morgan & Sommese, Coefficient-parameter polynomial continuation, 1989.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.family import Family
from nag.algebra.number import ComplexNumber, Number
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy


@dataclass(frozen=True, eq=False)
class ParameterLine:
    """A homotopy between two systems of a family, from t = 1 to t = 0.

    Attributes:
        homotopy: in the coordinates ``(x0, x, s)``; ``s = t x0`` is there only where the
            coefficients are of higher degree in t.
        n: number of unknowns of the family.
    """

    homotopy: Homotopy
    n: int

    def starts(self, points: np.ndarray) -> np.ndarray:
        """Affine points, shape ``(P, n)``, in the homotopy's coordinates at t = 1."""
        ones = np.ones((len(points), 1), dtype=np.complex128)
        return np.hstack([ones, points, *[ones] * (self.homotopy.N - 1 - self.n)])

    def affine(self, points: np.ndarray) -> np.ndarray:
        """The unknowns, shape ``(P, n)``; not numbers at infinity."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            result = points[:, 1 : 1 + self.n] / points[:, :1]
        return np.where(np.isfinite(result), result, np.nan)


def parameter_line(
    family: Family,
    first: Sequence[Number | complex] | np.ndarray,
    second: Sequence[Number | ComplexNumber | complex] | np.ndarray,
) -> ParameterLine:
    """The homotopy whose parameters are ``t first + (1 - t) second``.

    The system at t = 0 has exact coefficients if ``second`` is exact.
    """
    n, k = family.n, len(family.parameters)
    here = np.array([complex(v) for v in second])
    step = np.array([complex(v) for v in first]) - here
    moving = max((sum(e[n:]) for f in family.polynomials for e in f.terms), default=0)
    extra = int(moving > 1)
    rows, degrees = [], []
    for f, fixed in zip(family.polynomials, family.terms(list(second)), strict=True):
        # A coefficient q0 + q1 t + q2 t^2 + .. is q0 in one part, q1 + q2 s + .. in the other.
        parts: list[dict[tuple[int, ...], Number | complex]] = [{}, {}]
        for e, c in fixed.items():
            parts[0][(*e, *[0] * extra)] = c
        for e, c in f.terms.items():
            along = _coefficients_along(complex(c), here, step, e[n : n + k])
            for power, q in enumerate(along[1:]):
                key = (*e[:n], *[power] * extra)
                parts[1][key] = parts[1].get(key, 0.0) + q
        degree = max((sum(e) for part in parts for e in part), default=0)
        rows.append(
            tuple(
                (p, {(degree - sum(e), *e): c for e, c in part.items() if c != 0})
                for p, part in enumerate(parts)
                if any(c != 0 for c in part.values())
            )
        )
        degrees.append([degree])
    N = 1 + n + extra
    compiled = CompiledRows(N, tuple(rows), (tuple(range(N)),), (0,), np.array(degrees))
    A0, A1 = np.zeros((extra, N)), np.zeros((extra, N))
    A0[:, N - 1 :], A1[:, 0] = 1.0, -1.0
    return ParameterLine(Homotopy(compiled, A0, A1, ((1.0, 0.0), (0.0, 1.0))), n)


def _coefficients_along(
    coefficient: complex, here: np.ndarray, step: np.ndarray, exponents: Sequence[int]
) -> np.ndarray:
    """Coefficients in t of ``coefficient * prod((here + t step) ** exponents)``."""
    result = np.array([coefficient])
    for a, b, k in zip(here, step, exponents, strict=True):
        for _ in range(k):
            result = np.convolve(result, [a, b])
    return result
