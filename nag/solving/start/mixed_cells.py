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
from typing import NamedTuple

import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.records import Reals, Wholes
from nag.solving.start.target import StartError

# Lifting values are integers below this; equal crossing times are then as good as impossible.
LARGEST_LIFT = 1 << 22
MOST_STEPS = 3_000_000
MOST_CELLS = 200_000
# Cells that wait to be followed.
DEPTH = 1024


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


class Lifted(NamedTuple):
    """Supports with lifting values ``lift + t slope``, and the cells at t = minus infinity.

    ``points``: all supports' points, n coordinates each; those of support i have the numbers
    ``first[i] .. first[i + 1] - 1``. ``begin``: a pair of points' numbers for each support.
    """

    n: int
    cells: int
    most_steps: int
    points: Reals
    first: Wholes
    lift: Reals
    slope: Reals
    begin: Wholes


class Followed(NamedTuple):
    """Results and scratch of `follow_cells`.

    ``found``: the cells at t = infinity, at most ``most_cells``; ``numbers``: how many there are,
    and a code: 0, 1 for too many steps or cells, 2 for a degenerate cell. ``stack, times``: at most
    ``depth`` cells to be followed, and from when. ``cell``: the present one. ``matrix,
    pivots, right``: the factors of its edges, and two right-hand sides.
    """

    most_cells: int
    depth: int
    found: Wholes
    numbers: Wholes
    stack: Wholes
    times: Reals
    cell: Wholes
    matrix: Reals
    pivots: Wholes
    right: Reals


def _factorize(n, matrix, pivots):
    """Overwrite a matrix by its factors, with partial pivoting; whether it is regular."""
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[n * i + k]) > abs(matrix[n * pivot + k]):
                pivot = i
        if abs(matrix[n * pivot + k]) < 1e-9:
            return False
        pivots[k] = pivot
        if pivot != k:
            for j in range(n):
                a, b = n * k + j, n * pivot + j
                matrix[a], matrix[b] = matrix[b], matrix[a]
        for i in range(k + 1, n):
            if matrix[n * i + k] != 0.0:
                factor = matrix[n * i + k] / matrix[n * k + k]
                matrix[n * i + k] = factor
                for j in range(k + 1, n):
                    matrix[n * i + j] -= factor * matrix[n * k + j]
    return True


def _substitute(n, matrix, pivots, right):
    """Overwrite two right-hand sides by the solutions."""
    for k in range(n):
        p = pivots[k]
        for c in range(2):
            a, b = 2 * k + c, 2 * p + c
            right[a], right[b] = right[b], right[a]
    for k in range(n):
        for i in range(k):
            factor = matrix[n * k + i]
            if factor != 0.0:
                right[2 * k] -= factor * right[2 * i]
                right[2 * k + 1] -= factor * right[2 * i + 1]
    for k in range(n - 1, -1, -1):
        for i in range(k + 1, n):
            factor = matrix[n * k + i]
            if factor != 0.0:
                right[2 * k] -= factor * right[2 * i]
                right[2 * k + 1] -= factor * right[2 * i + 1]
        right[2 * k] /= matrix[n * k + k]
        right[2 * k + 1] /= matrix[n * k + k]


def _dual(s, w):
    """Where a cell's edges are lowest, at t = 0 and its change with t, into ``right``."""
    n = s.n
    for i in range(n):
        a, b = w.cell[2 * i], w.cell[2 * i + 1]
        for j in range(n):
            w.matrix[n * i + j] = s.points[n * b + j] - s.points[n * a + j]
        w.right[2 * i] = s.lift[a] - s.lift[b]
        w.right[2 * i + 1] = s.slope[a] - s.slope[b]
    if not _factorize(n, w.matrix, w.pivots):
        return False
    _substitute(n, w.matrix, w.pivots, w.right)
    return True


def _next(s, w, now):
    """When the cell changes after ``now``, whose edge, and which point enters; -1 if never."""
    n = s.n
    following = np.inf
    which, enters = -1, -1
    for i in range(n):
        a, b = w.cell[2 * i], w.cell[2 * i + 1]
        for c in range(s.first[i], s.first[i + 1]):
            if c in (a, b):
                continue
            value = s.lift[c] - s.lift[a]
            rate = s.slope[c] - s.slope[a]
            for j in range(n):
                d = s.points[n * c + j] - s.points[n * a + j]
                value += d * w.right[2 * j]
                rate += d * w.right[2 * j + 1]
            if rate < -1e-9:
                time = -value / rate
                if now < time < following:
                    following = time
                    which, enters = i, c
    return following, which, enters


def _share(s, w, which, enters):
    """Coefficient of edge ``which`` where the edges make up the way to the point that enters.

    It is the product of that way with the vector whose products with the edges are 0, but 1 with
    this one.
    """
    n = s.n
    for k in range(2 * n):
        w.right[k] = 0.0
    w.right[2 * which] = 1.0
    _substitute(n, w.matrix, w.pivots, w.right)
    a = w.cell[2 * which]
    share = 0.0
    for j in range(n):
        share += w.right[2 * j] * (s.points[n * enters + j] - s.points[n * a + j])
    return share


def _copy(target, place, source, start, count):
    for k in range(count):
        target[place + k] = source[start + k]


def follow_cells(s: Lifted, w: Followed) -> None:
    """Follow cells for t from minus to plus infinity."""
    n = s.n
    cell = w.cell
    numbers = w.numbers
    steps = 0
    for start in range(s.cells):
        _copy(w.stack, 0, s.begin, 2 * n * start, 2 * n)
        w.times[0] = -np.inf
        size = 1
        while size > 0:
            size -= 1
            _copy(cell, 0, w.stack, 2 * n * size, 2 * n)
            now = w.times[size]
            while True:
                steps += 1
                if steps > s.most_steps:
                    numbers[1] = 1
                    return
                if not _dual(s, w):
                    numbers[1] = 2
                    return
                following, which, enters = _next(s, w, now)
                if which < 0:
                    if numbers[0] == w.most_cells:
                        numbers[1] = 1
                        return
                    _copy(w.found, 2 * n * numbers[0], cell, 0, 2 * n)
                    numbers[0] += 1
                    break
                share = _share(s, w, which, enters)
                now = following
                if share > 1.0 + 1e-8:
                    # Two cells become one here; the one whose new point comes later goes on.
                    if enters < cell[2 * which]:
                        break
                    cell[2 * which + 1] = enters
                elif share < -1e-8:
                    if enters < cell[2 * which + 1]:
                        break
                    cell[2 * which] = enters
                elif share < 1e-8:
                    cell[2 * which] = enters
                elif share > 1.0 - 1e-8:
                    cell[2 * which + 1] = enters
                else:
                    if size == w.depth:
                        numbers[1] = 1
                        return
                    _copy(w.stack, 2 * n * size, cell, 0, 2 * n)
                    w.stack[2 * (n * size + which)] = enters
                    w.times[size] = now
                    size += 1
                    cell[2 * which + 1] = enters


_kernel = Kernel(follow_cells, "solving")


def _follow(
    points: np.ndarray, first: np.ndarray, lift: np.ndarray, slope: np.ndarray, begin: np.ndarray
) -> np.ndarray:
    """The cells at t = infinity, shape ``(cells, n, 2)``."""
    n = points.shape[1]
    # Memory that is never written to costs nothing.
    found = np.empty((MOST_CELLS, n, 2), dtype=np.int64)
    numbers = np.zeros(2, dtype=np.int64)
    stack = np.empty((DEPTH, n, 2), dtype=np.int64)
    _kernel(
        Lifted(n, len(begin), MOST_STEPS, points, first, lift, slope, begin),
        Followed(
            MOST_CELLS,
            DEPTH,
            found,
            numbers,
            stack,
            np.empty(DEPTH),
            np.empty((n, 2), dtype=np.int64),
            np.empty((n, n)),
            np.empty(n, dtype=np.int64),
            np.empty((n, 2)),
        ),
    )
    if numbers[1]:
        raise StartError("mixed volume: too many cells")
    return found[: numbers[0]].copy()


def mixed_cells(
    supports: Sequence[np.ndarray],
    rng: np.random.Generator,
    lifts: Sequence[np.ndarray] | None = None,
) -> MixedCells:
    """The mixed cells of ``supports``, for random lifting values if none are given.

    Args:
        supports: ``n`` arrays of non-negative exponents, each shape ``(terms, n)``.
        rng: where the lifting values come from.
        lifts: whole numbers from 0 to `LARGEST_LIFT` for each point, generic.

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
    if lifts is None:
        lifts = [rng.integers(0, LARGEST_LIFT, len(s)) for s in supports]
    lifts = [lift.astype(float) for lift in lifts]
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
        found = _follow(
            np.vstack(here).astype(float),
            first,
            np.concatenate(lift),
            np.concatenate(slope),
            np.ascontiguousarray(begin),
        )
        found = found - first[:-1][None, :, None]
        cells = found[(found[:, stage] < count).all(axis=1)]
        points[stage], values[stage] = supports[i], lifts[i]
    edges = np.zeros_like(cells)
    edges[:, order] = cells
    return MixedCells(tuple(supports), tuple(lifts), edges, _volumes(supports, edges))


def _volumes(supports: Sequence[np.ndarray], edges: np.ndarray) -> np.ndarray:
    n = len(supports)
    ends = [s[edges[:, i]] for i, s in enumerate(supports)]
    vectors = np.array([e[:, 1] - e[:, 0] for e in ends]).reshape(n, len(edges), n)
    vectors = vectors.transpose(1, 0, 2)
    return np.rint(np.abs(np.linalg.det(vectors.astype(float)))).astype(np.int64)
