"""Mixed cells and mixed volumes by tropical homotopy continuation.

The cells of simplices are known; one support after the other takes the place of a simplex, and
the cells are followed through the lifting values on the way. A cell is given by an edge of each
support; it changes when a further point comes to lie on the same face of the lower hull, which is
a flip of the circuit of these 2 n + 1 points.

Volumes tell whether a cell was lost or found twice. Where support i lies in d simplices, the hull
of both is that of d simplices, so that all cells' volumes, those with corners of the simplices as
well, are together d times what they were before support i came in.

References:
    Jensen, Tropical homotopy continuation, 2016; Huber & Sturmfels, A polyhedral method for
    solving sparse polynomial systems, 1995.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from nag.errors import StartError
from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import aligned_zeros, any_less, load, select_less, splat, store
from nag.machine_code.records import Reals, Wholes

# Lifting values are below this, with all digits of doubles: whole numbers would let points enter at
# the same time, where cells are lost or found twice (of some 10^7 steps one or two).
LARGEST_LIFT = 1 << 22
MOST_STEPS = 3_000_000
MOST_CELLS = 200_000
# Cells that wait to be followed.
DEPTH = 1024
# Decides: Distance from 0 and 1 of fractions with volumes of cells below: less is rounding.
SHARE = 1e-8
# Decides: The same of pivots, and of rates from 0.
ZERO = 1e-9


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

    def blocks(self, most: int) -> Iterator[MixedCells]:
        """The cells in their order, some at a time: of so many solutions at most, or one cell."""
        ends = np.cumsum(self.volumes)
        first = 0
        while first < len(self.edges):
            reached = ends[first] - self.volumes[first] + most
            last = max(first + 1, int(np.searchsorted(ends, reached, "right")))
            yield replace(self, edges=self.edges[first:last], volumes=self.volumes[first:last])
            first = last


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

    ``found, volumes``: the cells at t = infinity, at most ``most_cells``; ``numbers``: how many
    there are, and a code: 0, 1 for too many steps or cells, 2 for a degenerate cell. ``stack,
    times``: at most
    ``depth`` cells to be followed, and from when. ``cell``: the present one. ``matrix,
    pivots, right``: the factors of its edges, and two right-hand sides. ``wide``: the points eight
    by eight, those of support i from number ``blocks[i]`` on: n vectors of coordinates, one of
    ``lift`` and one of ``slope``. Vector ``width``, the last one, is for times.
    """

    most_cells: int
    depth: int
    found: Wholes
    volumes: Reals
    numbers: Wholes
    stack: Wholes
    times: Reals
    cell: Wholes
    matrix: Reals
    pivots: Wholes
    right: Reals
    blocks: Wholes
    wide: Reals
    width: int


def _factorize(n, matrix, pivots):
    """Overwrite a matrix by its factors, with partial pivoting; whether it is regular."""
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[n * i + k]) > abs(matrix[n * pivot + k]):
                pivot = i
        if abs(matrix[n * pivot + k]) < ZERO:
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


def _widen_points(s, w):
    """Put the points eight by eight; where there are fewer, others that never enter."""
    size = s.n + 2
    number = 0
    for i in range(s.n):
        w.blocks[i] = number
        first, count = s.first[i], s.first[i + 1] - s.first[i]
        for k in range(8 * ((count + 7) // 8)):
            place = 8 * size * (number + k // 8) + k % 8
            c = first + min(k, count - 1)
            for j in range(s.n):
                w.wide[place + 8 * j] = s.points[s.n * c + j]
            w.wide[place + 8 * s.n] = s.lift[c] if k < count else np.inf
            w.wide[place + 8 * (s.n + 1)] = s.slope[c]
        number += (count + 7) // 8
    w.blocks[s.n] = number


def _times(s, w, block, a, now):
    """When the points of a block come to lie on the hull's face that has point ``a``."""
    n = s.n
    never = splat(np.inf)
    top = block * (n + 2)
    value = load(w.wide, top + n) - splat(s.lift[a])
    rate = load(w.wide, top + n + 1) - splat(s.slope[a])
    for j in range(n):
        d = load(w.wide, top + j) - splat(s.points[n * a + j])
        value = value + d * splat(w.right[2 * j])
        rate = rate + d * splat(w.right[2 * j + 1])
    time = select_less(rate, splat(-ZERO), (splat(0.0) - value) / rate, never)
    return select_less(splat(now), time, time, never)


def _next(s, w, now):
    """When the cell changes after ``now``, whose edge, and which point enters; -1 if never."""
    following = np.inf
    which, enters = -1, -1
    for i in range(s.n):
        a, b = w.cell[2 * i], w.cell[2 * i + 1]
        for block in range(w.blocks[i], w.blocks[i + 1]):
            times = _times(s, w, block, a, now)
            if any_less(times, splat(following)):
                store(w.wide, w.width, times)
                for lane in range(8):
                    time = w.wide[8 * w.width + lane]
                    c = s.first[i] + 8 * (block - w.blocks[i]) + lane
                    if time < following and c not in (a, b):
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
    _widen_points(s, w)
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
                    volume = 1.0
                    for k in range(n):
                        volume *= abs(w.matrix[n * k + k])
                    w.volumes[numbers[0]] = volume
                    numbers[0] += 1
                    break
                share = _share(s, w, which, enters)
                now = following
                if share > 1.0 + SHARE:
                    # Two cells become one here; the one whose new point comes later goes on.
                    if enters < cell[2 * which]:
                        break
                    cell[2 * which + 1] = enters
                elif share < -SHARE:
                    if enters < cell[2 * which + 1]:
                        break
                    cell[2 * which] = enters
                elif share < SHARE:
                    cell[2 * which] = enters
                elif share > 1.0 - SHARE:
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


_kernel = Kernel(follow_cells)


def _scratch(n: int, points: int) -> Followed:
    width = (points // 8 + n) * (n + 2)
    # Memory that is never written to costs nothing.
    return Followed(
        most_cells=MOST_CELLS,
        depth=DEPTH,
        found=np.empty((MOST_CELLS, n, 2), dtype=np.int64),
        volumes=np.empty(MOST_CELLS),
        numbers=np.zeros(2, dtype=np.int64),
        stack=np.empty((DEPTH, n, 2), dtype=np.int64),
        times=np.empty(DEPTH),
        cell=np.empty((n, 2), dtype=np.int64),
        matrix=np.empty((n, n)),
        pivots=np.empty(n, dtype=np.int64),
        right=np.empty((n, 2)),
        blocks=np.zeros(n + 1, dtype=np.int64),
        wide=aligned_zeros(width + 1),
        width=width,
    )


def _follow(lifted: Lifted, room: Followed) -> tuple[np.ndarray, np.ndarray]:
    """The cells at t = infinity, shape ``(cells, n, 2)``, and their volumes.

    The cells are overwritten by the next ones.
    """
    room.numbers[:] = 0
    _kernel(lifted, room)
    if room.numbers[1]:
        raise StartError("mixed volume: too many cells")
    count = room.numbers[0]
    return room.found[:count], np.rint(room.volumes[:count]).astype(np.int64)


def mixed_cells(
    supports: Sequence[np.ndarray],
    rng: np.random.Generator,
    lifts: Sequence[np.ndarray] | None = None,
) -> MixedCells:
    """The mixed cells of ``supports``, for random lifting values if none are given.

    Args:
        supports: ``n`` arrays of non-negative exponents, each shape ``(terms, n)``.
        rng: where the lifting values come from.
        lifts: from 0 to `LARGEST_LIFT` for each point, generic.

    Raises:
        StartError: if there are too many cells, or their volumes show that some were lost.
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
        lifts = [LARGEST_LIFT * rng.random(len(s)) for s in supports]
    points, values = [simplex] * n, list(simplex_lifts)
    cells = np.array([[[0, 1 + i] for i in range(n)]], dtype=np.int64)
    volumes = np.ones(1, dtype=np.int64)
    room = _scratch(n, sum(map(len, supports)) + (n + 1) ** 2)
    for stage, i in enumerate(order):
        degree, count = max(1, int(supports[i].sum(axis=1).max())), len(supports[i])
        last = [degree * simplex, degree * simplex_lifts[stage]]
        points[stage], values[stage] = supports[i], lifts[i]
        here = [*points[: stage + 1], last[0], *points[stage + 1 :]]
        lift = np.concatenate([*values[: stage + 1], last[1], *values[stage + 1 :]])
        counts = [len(p) for p in points]
        counts[stage] += n + 1
        first = np.array([0, *accumulate(counts)])
        shift = first[:-1, None]
        begin = cells + shift
        begin[:, stage] += count
        slope = np.zeros(len(lift))
        slope[first[stage] + count : first[stage + 1]] = 1.0
        all_points = np.concatenate(here, dtype=float)
        lifted = Lifted(
            n=n,
            cells=len(begin),
            most_steps=MOST_STEPS,
            points=all_points,
            first=first,
            lift=lift,
            slope=slope,
            begin=begin,
        )
        found, reached = _follow(lifted, room)
        if reached.sum() != degree * volumes.sum():
            raise StartError("mixed volume: cells were lost to rounding")
        own = (found[:, stage] < first[stage] + count).all(axis=1)
        cells, volumes = found[own] - shift, reached[own]
    edges = np.zeros_like(cells)
    edges[:, order] = cells
    return MixedCells(tuple(supports), tuple(lifts), edges, volumes)
