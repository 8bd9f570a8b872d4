"""The zeros of a cluster, found from the series in the variables that do not determine them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

import flint
import numpy as np

from nag.numerics.deflation import DeflatedPoint
from nag.numerics.descent import Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, log_size
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import move_point
from nag.numerics.power_series import Series, SeriesRing
from nag.numerics.series_zeros import ScaledSeries

# Random starts for each zero that a cluster in several variables may have.
STARTS, MOST_STARTS = 12, 400
# Starts that lead to points nearer to each other than this, beside the cluster's size, are not
# followed twice; points are compared again when they are known to all digits.
ALIKE = 1e-5


def find_zeros_of_cluster(
    system: ExactSystem, found: DeflatedPoint, reach: float, rng: np.random.Generator
) -> Iterator[tuple[Point, float, bool]]:
    """Approximate zeros of a cluster about a point that is no exact zero, and their distance.

    The equations that remain after the regular part is solved are series whose terms of low order
    are small, but not zero: the size of the cluster is where all terms are equally large.

    Yields:
        points, the decimal logarithm of the size of the cluster, and whether the point seems to be
        a regular zero; those that are come first.
    """
    first = Round(found.rounds[0].rows, found.rounds[0].columns)
    order = found.rounds[0].order
    if not found.corank or not order:
        return
    descent = descend(system, DIGITS, found.point, [first], order)
    assert descent is not None
    size = _size(descent.ring, descent.remaining, order)
    if not size < reach + 1:
        return
    scaled = ScaledSeries.of(descent.ring, descent.remaining, size)
    scale = flint.arb(10) ** flint.arb(size)
    zeros = [(scaled.regular(u), u) for u in _zeros(scaled, order, rng)]
    for regular, u in sorted(zeros, key=lambda zero: not zero[0]):
        along = [flint.acb(complex(c)) * scale for c in u]
        step = descend(system, DIGITS, found.point, [first], order, along)
        if step is not None:
            yield move_point(found.point, step.displacement, BITS), size, regular


def _size(ring: SeriesRing, series: Sequence[Series], order: int) -> float:
    norms = [-inf] * (order + 1)
    for s in series:
        for key, c in s.items():
            degree = ring.degree(key)
            if degree <= order:
                norms[degree] = max(norms[degree], log_size(c))
    return max((norms[j] - norms[order]) / (order - j) for j in range(order))


def _zeros(scaled: ScaledSeries, order: int, rng: np.random.Generator) -> Iterator[np.ndarray]:
    if scaled.m == 1:
        for root in np.roots(scaled.coefficients(order)[::-1]):
            yield np.array([root])
        return
    known: list[np.ndarray] = []
    for _ in range(min(STARTS * order**scaled.m, MOST_STARTS)):
        start = rng.normal(size=scaled.m) + 1j * rng.normal(size=scaled.m)
        u = scaled.newton(start)
        if u is None or np.abs(u).max() > 100:
            continue
        if all(np.abs(u - v).max() > ALIKE for v in known):
            known.append(u)
            yield u
