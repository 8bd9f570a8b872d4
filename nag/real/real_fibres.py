"""Vertices over special values of a linear form, and real points between them.

A little beside a special value the points of the fibre that come together there are close to each
other, and their middle is the vertex, to as many digits as the value is off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import flint
import numpy as np

from nag.numerics.digits import bits_of, doubles, in_bits
from nag.real.closure import Closure
from nag.real.critical_values import UnclearDigitsError
from nag.real.fibre_table import SPARE, FibreTable, Point

# Parts of the digits: how far beside a special value its fibre is looked at, in radii; up to which
# distance of normalised points there they have come together; and how many times that is between.
BESIDE, TOGETHER, BETWEEN = 0.25, 0.05, 1e2
# Imaginary parts of real points over real values: part of the digits; and of others.
REAL, COMPLEX = 0.5, 0.35
# Imaginary parts of vertices that are real: rounding in doubles, and what is beyond it.
ROUNDING, NOT_REAL = 1e-12, 1e-6


@dataclass(frozen=True, eq=False)
class SpecialFibre:
    """The points over a special value, each with the number of sheets that meet there.

    Attributes:
        pencil: the value as a point of a line, shape ``(2,)``.
        points: normalised homogeneous points, complex, shape ``(V, size)``.
        sheets: how many meet at each, shape ``(V,)``.
        real: which of the points are real, shape ``(V,)``.
    """

    pencil: np.ndarray
    points: np.ndarray
    sheets: np.ndarray
    real: np.ndarray

    @property
    def singular(self) -> bool:
        """Whether sheets meet at a real point."""
        return bool((self.real & (self.sheets > 1)).any())


def special_fibre(table: FibreTable, closure: Closure, value: flint.arb | None) -> SpecialFibre:
    """The points over a value, in radii; over infinity where it is None.

    Raises:
        UnclearDigitsError: if it is not clear which points come together.
    """
    with in_bits(bits_of(table.digits + SPARE)):
        step = flint.arb(10) ** round(-BESIDE * table.digits)
        radius = flint.arb(table.radius)
        if value is None:
            at, pencil = radius / step, np.array([1.0, 0.0])
        else:
            at = (value + step) * radius
            pencil = np.array([float(value * radius), 1.0])
        fibre = table.at(at)
    points = homogeneous_points(closure, fibre, table.digits)
    together = 10 ** (-TOGETHER * table.digits)
    clusters = _clusters(closure.distances(points, points), together)
    middles, real = [], []
    for members in clusters:
        if value is None:
            own = points[members]
            middle = _aligned(closure, own).mean(axis=0)
        else:
            with in_bits(bits_of(table.digits + SPARE)):
                x = [
                    sum(column, flint.acb(0)) / len(members)
                    for column in zip(*(fibre[i] for i in members), strict=True)
                ]
            middle = doubles(x)
            middle = closure.homogeneous(middle[None])[0]
        middle = _turned_real(closure, closure.normalised(middle[None])[0])
        off = float(np.abs(middle.imag).max())
        if ROUNDING < off < NOT_REAL:
            raise UnclearDigitsError("it is not clear which vertices are real")
        real.append(off <= ROUNDING)
        middles.append(middle)
    sheets = np.array([len(members) for members in clusters])
    return SpecialFibre(pencil, np.array(middles), sheets, np.array(real, dtype=bool))


def homogeneous_points(closure: Closure, fibre: Sequence[Point], digits: int) -> np.ndarray:
    """Points in many digits as normalised ones in doubles."""
    return closure.homogeneous(np.array([doubles(x) for x in fibre]))


def _turned_real(closure: Closure, point: np.ndarray) -> np.ndarray:
    """A point times factors that make the largest coordinate of each group real."""
    result = point.astype(complex).copy()
    for g in range(len(closure.groups)):
        own = np.flatnonzero(closure.group_of == g)
        top = result[own[np.abs(result[own]).argmax()]]
        result[own] *= np.conj(top) / abs(top)
    return result


def _aligned(closure: Closure, points: np.ndarray) -> np.ndarray:
    """Points times factors that make them near to the first."""
    result = points.copy()
    for g in range(len(closure.groups)):
        own = closure.group_of == g
        products = points[:, own] @ points[0, own].conj()
        result[:, own] *= (np.conj(products) / np.abs(products))[:, None]
    return result


def _clusters(distances: np.ndarray, together: float) -> list[list[int]]:
    between = (distances > together) & (distances < BETWEEN * together)
    left, result = list(range(len(distances))), []
    while left:
        cluster = [left.pop(0)]
        for i in cluster:
            near = [j for j in left if distances[i, j] <= together]
            cluster += near
            left = [j for j in left if j not in near]
        own = np.array(cluster)
        others = np.setdiff1d(np.arange(len(distances)), own)
        if between[np.ix_(own, others)].any():
            raise UnclearDigitsError("it is not clear which points come together")
        result.append(sorted(cluster))
    return result


def real_fibre(
    table: FibreTable, closure: Closure, pencil: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Normalised points over a finite value of the pencil, and which of them are real.

    Raises:
        UnclearDigitsError: if that is not clear.
    """
    with in_bits(bits_of(table.digits + SPARE)):
        fibre = table.at(flint.arb(float(pencil[0])) / flint.arb(float(pencil[1])))
        real_limit, complex_limit = (
            flint.arb(10) ** round(-part * table.digits) for part in (REAL, COMPLEX)
        )
        real = []
        for x in fibre:
            size = max(abs(z).mid() for z in x) + 1
            off = max(abs(z.imag).mid() for z in x)
            if off > real_limit * size and off < complex_limit * size:
                raise UnclearDigitsError("it is not clear which points are real")
            real.append(bool(off <= real_limit * size))
    points = homogeneous_points(closure, fibre, table.digits)
    return points, np.array(real, dtype=bool)
