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
from nag.real.closure import ProjectiveClosure
from nag.real.critical_values import UnclearDigitsError
from nag.real.fibre_table import SPARE, FibreTable, Point

# Decides: Share of the digits beside a critical value at which its fibre is looked at.
BESIDE = 0.25
# Decides: The same of distances there of points that come together, up to five of them; what is a
# hundred times as far does not, and between them more digits are taken.
TOGETHER = 0.05
# Decides: The hundred times.
BETWEEN = 1e2
# Decides: Share of the digits to which imaginary parts vanish of points over real values that are
# real.
REAL = 0.5
# Decides: The same of those that are not; between them more digits are taken.
COMPLEX = 0.35
# Decides: Imaginary parts of vertices, in doubles, that are real.
ROUNDING = 1e-12
# Decides: And of those that are not; between them more digits are taken.
NOT_REAL = 1e-6
# Decimal order of values at which infinity is looked at, at least; and parts of it: distances there
# of points that come together, and how many times that is between; imaginary parts of real ones,
# and of others.
LEAST_ORDER = 10
# Decides: Share of the order of a large value to which points there come together at infinity.
FAR_TOGETHER = 0.24
# Decides: Times that distance from which on they do not; between them more digits are taken.
FAR_BETWEEN = 10.0
# Decides: The same share of imaginary parts of real ones.
FAR_REAL = 0.75
# Decides: And of others; between them likewise.
FAR_COMPLEX = 0.35


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


def special_fibre(table: FibreTable, closure: ProjectiveClosure, value: flint.arb) -> SpecialFibre:
    """The points over a value, in radii.

    Raises:
        UnclearDigitsError: if it is not clear which points come together.
    """
    with in_bits(bits_of(table.digits + SPARE)):
        step = flint.arb(10) ** round(-BESIDE * table.digits)
        radius = flint.arb(table.radius)
        pencil = np.array([float(value * radius), 1.0])
        fibre = table.at((value + step) * radius)
    points = homogeneous_points(closure, fibre)
    together = 10 ** (-TOGETHER * table.digits)
    middles = []
    clusters = _clusters(closure.distances(points, points), together, BETWEEN * together)
    for members in clusters:
        with in_bits(bits_of(table.digits + SPARE)):
            columns = zip(*(fibre[i] for i in members), strict=True)
            x = [sum(column, flint.acb(0)) / len(members) for column in columns]
        middles.append(closure.homogeneous(doubles(x)[None])[0])
    return _of_middles(closure, pencil, middles, clusters, ROUNDING, NOT_REAL)


def infinite_fibre(table: FibreTable, closure: ProjectiveClosure, alike: int) -> SpecialFibre:
    """The points over infinity.

    Args:
        alike: how many sheets go there along one direction, at most: digits are lost for each.

    Raises:
        UnclearDigitsError: if it is not clear which points come together.
    """
    order = table.digits / (2 * (1 + alike))
    if order < LEAST_ORDER:
        raise UnclearDigitsError("many sheets go to infinity alike")
    with in_bits(bits_of(table.digits + SPARE)):
        fibre = table.at(flint.arb(table.radius) * flint.arb(10) ** round(order))
    points = homogeneous_points(closure, fibre)
    together = 10 ** (-FAR_TOGETHER * order)
    clusters = _clusters(closure.distances(points, points), together, FAR_BETWEEN * together)
    middles = [_aligned(closure, points[members]).mean(axis=0) for members in clusters]
    limits = (10 ** (-part * order) for part in (FAR_REAL, FAR_COMPLEX))
    return _of_middles(closure, np.array([1.0, 0.0]), middles, clusters, *limits)


def _of_middles(
    closure: ProjectiveClosure,
    pencil: np.ndarray,
    middles: Sequence[np.ndarray],
    clusters: Sequence[Sequence[int]],
    rounding: float,
    not_real: float,
) -> SpecialFibre:
    """A fibre of the middles of clusters, which are real up to the limits."""
    points = closure.normalised(np.array(middles))
    points = np.array([_turned_real(closure, point) for point in points])
    off = np.abs(points.imag).max(axis=1)
    if ((off > rounding) & (off < not_real)).any():
        raise UnclearDigitsError("it is not clear which vertices are real")
    sheets = np.array([len(members) for members in clusters])
    return SpecialFibre(pencil, points, sheets, off <= rounding)


def homogeneous_points(closure: ProjectiveClosure, fibre: Sequence[Point]) -> np.ndarray:
    """Points in many digits as normalised ones in doubles."""
    return closure.homogeneous(np.array([doubles(x) for x in fibre]))


def _turned_real(closure: ProjectiveClosure, point: np.ndarray) -> np.ndarray:
    """A point times factors that make the largest coordinate of each group real."""
    result = point.astype(complex).copy()
    for g in range(len(closure.groups)):
        own = np.flatnonzero(closure.group_of == g)
        top = result[own[np.abs(result[own]).argmax()]]
        result[own] *= np.conj(top) / abs(top)
    return result


def _aligned(closure: ProjectiveClosure, points: np.ndarray) -> np.ndarray:
    """Points times factors that make them near to the first."""
    result = points.copy()
    for g in range(len(closure.groups)):
        own = closure.group_of == g
        products = points[:, own] @ points[0, own].conj()
        result[:, own] *= (np.conj(products) / np.abs(products))[:, None]
    return result


def _clusters(distances: np.ndarray, together: float, apart: float) -> list[list[int]]:
    """Indices of points in lists of those that come together."""
    between = (distances > together) & (distances < apart)
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
    table: FibreTable, closure: ProjectiveClosure, pencil: np.ndarray
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
    points = homogeneous_points(closure, fibre)
    return points, np.array(real, dtype=bool)
