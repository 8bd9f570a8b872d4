"""Total degree start systems: x_i^d_i = c_i, with as many solutions as Bezout's number.

Linear equations of the target belong to the start system as well, so that they hold all the way.
"""

from __future__ import annotations

from math import prod

import numpy as np

from nag.tracking.homotopy import straight_line
from nag.tracking.start.target import (
    Start,
    StartError,
    Target,
    group_degrees,
    homogenized,
    unit,
)

# Start points are kept in memory.
MOST_PATHS = 4_000_000


def bezout(target: Target) -> int:
    """The product of the degrees."""
    return prod(target.degrees)


def _linear_rows(target: Target) -> tuple[list[int], np.ndarray, list[int]]:
    """Indices of linear rows, their coefficients ``(k, 1 + n)``, and the variables they solve for.

    No rows if they do not determine as many variables as they are.
    """
    indices = [i for i, d in enumerate(target.degrees) if d == 1]
    matrix = np.zeros((len(indices), 1 + target.n), dtype=np.complex128)
    for k, i in enumerate(indices):
        for e, c in target.rows[i].items():
            matrix[k, 1 + e.index(1) if any(e) else 0] = complex(c)
        matrix[k] /= np.linalg.norm(matrix[k])
    rest, solved = matrix[:, 1:].copy(), []
    for k in range(len(indices)):
        row = rest[k]
        pivot = int(np.abs(row).argmax())
        if abs(row[pivot]) < 1e-10:
            return [], matrix[:0], []
        solved.append(pivot)
        rest[k + 1 :] -= np.outer(rest[k + 1 :, pivot] / row[pivot], row)
    return indices, matrix, solved


def total_degree(target: Target, rng: np.random.Generator) -> Start:
    """The straight-line homotopy from ``x_i^d_i = c_i`` with random ``|c_i| = 1``.

    Raises:
        StartError: if there are more paths than memory is for.
    """
    n, degrees = target.n, target.degrees
    paths = bezout(target)
    if paths > MOST_PATHS:
        raise StartError(f"total degree: {paths} paths; at most {MOST_PATHS} are tracked")
    linear, matrix, solved = _linear_rows(target)
    free = [j for j in range(n) if j not in solved]
    rows = [i for i in range(n) if i not in linear]
    constants = unit(rng, len(rows))
    gamma = complex(unit(rng, 1)[0])
    start_rows = []
    for j, i, c in zip(free, rows, constants, strict=True):
        power = tuple(degrees[i] if k == j else 0 for k in range(n))
        start_rows.append({power: 1.0, (0,) * n: -complex(c)} if degrees[i] else {(0,) * n: 1.0})
    groups = (tuple(range(n)),)
    shape = group_degrees([target.rows[i] for i in rows], groups)
    goal = homogenized([target.rows[i] for i in rows], n, groups, shape)
    begin = homogenized(start_rows, n, groups, shape)
    points = np.ones((paths, 1 + n), dtype=np.complex128)
    index = np.arange(paths)
    for j, i, c in zip(free, rows, constants, strict=True):
        d = degrees[i]
        if d:
            points[:, 1 + j] = complex(c) ** (1 / d) * np.exp(2j * np.pi * (index % d) / d)
            index = index // d
    if linear:
        columns = [1 + j for j in solved]
        known = [0] + [1 + j for j in free]
        right = points[:, known] @ matrix[:, known].T
        points[:, columns] = -np.linalg.solve(matrix[:, columns], right.T).T
    return Start("total", straight_line(begin, goal, gamma, matrix), points, groups)
