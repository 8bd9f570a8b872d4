"""Vertices over special values of a linear form, and real points between them.

A little beside a special value the points of the fibre that come together there are close to each
other, and their middle is the vertex, to as many digits as the value is off. A fibre over a real
value is its own conjugate: a point is real if none of the others is nearer to its conjugate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import flint
import numpy as np

from nag.numerics.digits import bits_of, doubles, in_bits
from nag.real.closure import ProjectiveClosure
from nag.real.critical_values import UnclearDigitsError
from nag.real.fibre_table import SPARE, FibresOverValues, FibreTable, Point

# Decides: Share of the digits beside a critical value at which its fibre is looked at.
BESIDE = 0.25
# Share of the digits by which another fibre is further from it: what meets is further apart there.
APART = 0.1
# Decides: The same of distances there of points that come together, up to five of them; what is a
# hundred times as far does not, and between them more digits are taken.
TOGETHER = 0.05
# Decides: The hundred times.
BETWEEN = 1e2
# Decimal order of values at which infinity is looked at, at least.
LEAST_ORDER = 10
# Decides: Share of the order of a large value to which points there come together at infinity.
FAR_TOGETHER = 0.24
# Decides: Times that distance from which on they do not; between them more digits are taken.
FAR_BETWEEN = 10.0
# Distance from a conjugate, beside the least one in doubles, of points of which digits say which is
# nearest; and what doubles leave of that, beside the points' sizes.
NEARBY, ROUNDING = 4.0, 1e-8


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
        further = table.at((value + step * flint.arb(10) ** round(APART * table.digits)) * radius)
    points = homogeneous_points(closure, fibre)
    together = 10 ** (-TOGETHER * table.digits)
    middles = []
    clusters = find_clusters(closure.distances(points, points), together, BETWEEN * together)
    for members in clusters:
        with in_bits(bits_of(table.digits + SPARE)):
            _check_together(fibre, further, members, APART * table.digits)
            columns = zip(*(fibre[i] for i in members), strict=True)
            x = [sum(column, flint.acb(0)) / len(members) for column in columns]
        middles.append(closure.homogeneous(doubles(x)[None])[0])
    return join_middles(closure, pencil, middles, list(map(len, clusters)))


def _check_together(
    fibre: Sequence[Sequence[flint.acb]],
    further: Sequence[Sequence[flint.acb]],
    members: Sequence[int],
    orders: float,
) -> None:
    """Make sure that points come together at a value, and are not near to each other only.

    Args:
        further: the fibre so many ``orders`` further from the value: m sheets that meet are at
            least the m-th part of the orders further from each other there.

    Raises:
        UnclearDigitsError: if they stay apart.
    """
    if len(members) < 2:
        return
    here = [fibre[i] for i in members]
    nearest = sorted(further, key=lambda x: float(_distance(x, here[0])))[: len(members)]
    near, far = (
        max(_distance(x, y) for x, y in combinations(points, 2)) for points in (here, nearest)
    )
    if near > far * flint.arb(10) ** (-orders / (2 * len(members))):
        raise UnclearDigitsError("points stay apart where they seemed to come together")


def _distance(x: Sequence[flint.acb], y: Sequence[flint.acb]) -> flint.arb:
    return max(abs(a - b).mid() for a, b in zip(x, y, strict=True))


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
    clusters = find_clusters(closure.distances(points, points), together, FAR_BETWEEN * together)
    middles = [_align_points(closure, points[members]).mean(axis=0) for members in clusters]
    return join_middles(closure, np.array([1.0, 0.0]), middles, list(map(len, clusters)))


def join_middles(
    closure: ProjectiveClosure,
    pencil: np.ndarray,
    middles: Sequence[np.ndarray] | np.ndarray,
    sheets: Sequence[int],
) -> SpecialFibre:
    """A fibre of points, each with its sheets; real are those that are their own conjugates.

    Raises:
        UnclearDigitsError: if two points seem to have one conjugate.
    """
    points = closure.normalise(np.array(middles))
    points = np.array([_turned_real(closure, point) for point in points])
    real = find_own_conjugates(closure.distances(points.conj(), points))
    return SpecialFibre(pencil, points, np.array(sheets, dtype=int), real)


def find_own_conjugates(apart: np.ndarray) -> np.ndarray:
    """Which points of a set that is its own conjugate are real, shape ``(P,)``.

    Args:
        apart: distances of the conjugate of each from each, shape ``(P, P)``.

    Raises:
        UnclearDigitsError: if two points seem to have one conjugate.
    """
    nearest, own = apart.argmin(axis=1), np.arange(len(apart))
    if (nearest[nearest] != own).any():
        raise UnclearDigitsError("it is not clear which points are real")
    return nearest == own


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


def _align_points(closure: ProjectiveClosure, points: np.ndarray) -> np.ndarray:
    """Points times factors that make them near to the first."""
    result = points.copy()
    for g in range(len(closure.groups)):
        own = closure.group_of == g
        products = points[:, own] @ points[0, own].conj()
        result[:, own] *= (np.conj(products) / np.abs(products))[:, None]
    return result


def find_clusters(distances: np.ndarray, together: float, apart: float) -> list[list[int]]:
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
    table: FibresOverValues, closure: ProjectiveClosure, pencil: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Normalised points over a finite value of the pencil, and which of them are real.

    Raises:
        UnclearDigitsError: if that is not clear.
    """
    with in_bits(bits_of(table.digits + SPARE)):
        fibre = table.at(flint.arb(float(pencil[0])) / flint.arb(float(pencil[1])))
        real = find_own_conjugates(distances_of_conjugates(fibre))
    return homogeneous_points(closure, fibre), real


def distances_of_conjugates(fibre: Sequence[Point]) -> np.ndarray:
    """Distances of the conjugate of each point from each; in digits where they are least."""
    x = np.array([doubles(point) for point in fibre])
    apart = np.abs(x.conj()[:, None] - x[None]).max(axis=2)
    sizes = 1 + np.abs(x).max(axis=1, keepdims=True)
    for i, j in np.argwhere(apart <= NEARBY * apart.min(axis=1, keepdims=True) + ROUNDING * sizes):
        pairs = zip(fibre[i], fibre[j], strict=True)
        apart[i, j] = max(float(abs(z.conjugate() - w).mid()) for z, w in pairs)
    return apart
