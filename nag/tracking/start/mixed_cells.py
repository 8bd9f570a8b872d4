"""Mixed cells and mixed volumes by tropical homotopy continuation.

The cells of simplices are known; one support after the other takes the place of a simplex, and
the cells are followed through the lifting values on the way. A cell is given by an edge of each
support; it changes when a further point comes to lie on the same face of the lower hull, which is
a flip of the circuit of these 2 n + 1 points.

References:
    Jensen, Tropical homotopy continuation, 2016; Huber & Sturmfels, A polyhedral method for
    solving sparse polynomial systems, 1995.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numba
import numpy as np

from nag.tracking.start.target import StartError

# Lifting values are integers below this; equal crossing times are then as good as impossible.
LARGEST_LIFT = 1 << 22
MOST_STEPS = 3_000_000
MOST_CELLS = 200_000


@dataclass(frozen=True, eq=False)
class MixedCells:
    """The mixed cells of supports, for one generic lifting.

    Attributes:
        supports: the supports, each shape ``(terms, n)``.
        lifts: lifting values of each support's points.
        edges: shape ``(cells, n, 2)``: two points' numbers in each support.
        volumes: volume of each cell, shape ``(cells,)``.
    """

    supports: tuple[np.ndarray, ...]
    lifts: tuple[np.ndarray, ...]
    edges: np.ndarray
    volumes: np.ndarray

    @property
    def mixed_volume(self) -> int:
        """Number of solutions without zero coordinates for generic coefficients."""
        return int(self.volumes.sum())


@numba.njit(cache=True, nogil=True)
def _solve(matrix, right):
    """Gaussian elimination with partial pivoting, in place; the determinant's absolute value."""
    n = len(matrix)
    determinant = 1.0
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        if abs(matrix[pivot, k]) < 1e-9:
            return 0.0
        for j in range(n):
            matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        for j in range(right.shape[1]):
            right[k, j], right[pivot, j] = right[pivot, j], right[k, j]
        determinant *= matrix[k, k]
        for i in range(k + 1, n):
            factor = matrix[i, k] / matrix[k, k]
            if factor != 0.0:
                for j in range(k, n):
                    matrix[i, j] -= factor * matrix[k, j]
                for j in range(right.shape[1]):
                    right[i, j] -= factor * right[k, j]
    for k in range(n - 1, -1, -1):
        for j in range(right.shape[1]):
            value = right[k, j]
            for i in range(k + 1, n):
                value -= matrix[k, i] * right[i, j]
            right[k, j] = value / matrix[k, k]
    return abs(determinant)


@numba.njit(cache=True, nogil=True)
def _follow(points, first, lift, slope, begin, most_steps, most_cells):
    """Follow cells for t from minus to plus infinity, where lifting values are lift + t slope.

    Returns the cells at the end and a code: 0, 1 for too many steps, 2 for a degenerate cell.
    """
    n = points.shape[1]
    stack = np.zeros((1024, n, 2), dtype=np.int64)
    times = np.zeros(1024)
    found = np.zeros((1024, n, 2), dtype=np.int64)
    size = 0
    cells = 0
    steps = 0
    matrix = np.zeros((n, n))
    right = np.zeros((n, 2))
    column = np.zeros((n, 1))
    for start in range(len(begin)):
        stack[0] = begin[start]
        times[0] = -np.inf
        size = 1
        while size:
            size -= 1
            cell = stack[size].copy()
            now = times[size]
            while True:
                steps += 1
                if steps > most_steps:
                    return found[:cells], 1
                for i in range(n):
                    a, b = cell[i, 0], cell[i, 1]
                    for j in range(n):
                        matrix[i, j] = points[b, j] - points[a, j]
                    right[i, 0] = lift[a] - lift[b]
                    right[i, 1] = slope[a] - slope[b]
                if _solve(matrix, right) == 0.0:
                    return found[:cells], 2
                following = np.inf
                which, enters = -1, -1
                for i in range(n):
                    a, b = cell[i, 0], cell[i, 1]
                    for c in range(first[i], first[i + 1]):
                        if c in (a, b):
                            continue
                        value = lift[c] - lift[a]
                        rate = slope[c] - slope[a]
                        for j in range(n):
                            d = points[c, j] - points[a, j]
                            value += d * right[j, 0]
                            rate += d * right[j, 1]
                        if rate < -1e-9:
                            time = -value / rate
                            if now < time < following:
                                following = time
                                which, enters = i, c
                if which < 0:
                    if cells == len(found):
                        if cells >= most_cells:
                            return found[:cells], 1
                        larger = np.zeros((2 * cells, n, 2), dtype=np.int64)
                        larger[:cells] = found
                        found = larger
                    found[cells] = cell
                    cells += 1
                    break
                a, b = cell[which, 0], cell[which, 1]
                for i in range(n):
                    for j in range(n):
                        matrix[j, i] = points[cell[i, 1], j] - points[cell[i, 0], j]
                    column[i, 0] = points[enters, i] - points[a, i]
                _solve(matrix, column)
                share = column[which, 0]
                now = following
                if share > 1.0 + 1e-8:
                    # Two cells become one here; the one whose new point comes later goes on.
                    if enters < a:
                        break
                    cell[which, 1] = enters
                elif share < -1e-8:
                    if enters < b:
                        break
                    cell[which, 0] = enters
                elif share < 1e-8:
                    cell[which, 0] = enters
                elif share > 1.0 - 1e-8:
                    cell[which, 1] = enters
                else:
                    if size == len(stack):
                        return found[:cells], 1
                    stack[size] = cell
                    stack[size, which, 0] = enters
                    times[size] = now
                    size += 1
                    cell[which, 1] = enters
    return found[:cells], 0


def mixed_cells(supports: Sequence[np.ndarray], rng: np.random.Generator) -> MixedCells:
    """The mixed cells of ``supports`` for random lifting values.

    Args:
        supports: ``n`` arrays of non-negative exponents, each shape ``(terms, n)``.
        rng: where the lifting values come from.

    Raises:
        StartError: if there are too many cells.
    """
    n = len(supports)
    order = sorted(range(n), key=lambda i: (len(supports[i]), i))
    simplex = np.vstack([np.zeros((1, n)), np.eye(n)])
    # Simplex i has its lowest points at 0 and e_i; at the point -heights of the dual space all
    # the others lie higher.
    heights = rng.random(n) * 100
    simplex_lifts = []
    for i in range(n):
        values = np.append(0.0, heights + 1 + 100 * rng.random(n))
        values[1 + i] = heights[i]
        simplex_lifts.append(values)
    lifts = [rng.integers(0, LARGEST_LIFT, len(s)).astype(float) for s in supports]
    points = [simplex] * n
    values = list(simplex_lifts)
    cells = np.array([[[0, 1 + i] for i in range(n)]], dtype=np.int64)
    for stage, i in enumerate(order):
        degree = max(1, int(supports[i].sum(axis=1).max()))
        count = len(supports[i])
        here = [*points]
        here[stage] = np.vstack([supports[i], degree * simplex])
        lift = [*values]
        lift[stage] = np.append(lifts[i], degree * simplex_lifts[stage])
        slope = [np.zeros(len(p)) for p in here]
        slope[stage][count:] = 1.0
        first = np.cumsum([0] + [len(p) for p in here])
        begin = cells + first[:-1][None, :, None]
        begin[:, stage] += count
        found, code = _follow(
            np.vstack(here).astype(float),
            first,
            np.concatenate(lift),
            np.concatenate(slope),
            np.ascontiguousarray(begin),
            MOST_STEPS,
            MOST_CELLS,
        )
        if code:
            raise StartError("mixed volume: too many cells")
        found = found - first[:-1][None, :, None]
        cells = found[(found[:, stage] < count).all(axis=1)]
        points[stage], values[stage] = supports[i], lifts[i]
    edges = np.zeros_like(cells)
    edges[:, order] = cells
    vectors = np.array(
        [[s[b] - s[a] for s, (a, b) in zip(supports, cell, strict=True)] for cell in edges]
    ).reshape(len(edges), n, n)
    volumes = np.rint(np.abs(np.linalg.det(vectors.astype(float)))).astype(np.int64)
    return MixedCells(tuple(supports), tuple(lifts), edges, volumes)
