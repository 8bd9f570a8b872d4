"""Polyhedral start systems: the supports of the target with random coefficients.

Bernstein's theorem says how many solutions such a system has: the mixed volume. The supports
hold the origin, so that the paths lead to solutions with vanishing coordinates as well.

They are solved by toric degenerations. For a mixed cell with edges ``a_i b_i`` and inner normal
``alpha``, the system whose coefficient at ``a`` is ``c_a exp(-w_a t)``,
``w_a = lift(a) - lift(a_i) + (a - a_i) alpha >= 0``, tends to the binomials on the edges as t
grows; these have as many solutions as the cell's volume.

References:
    Bernstein, The number of roots of a system of equations, 1975;
    Huber & Sturmfels, A polyhedral method for solving sparse polynomial systems, 1995;
    Li & Wang, The BKK root count in C^n, 1996.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count

import numpy as np

from nag.errors import StartError
from nag.numerics.array_table import join_columns
from nag.solving.start.coefficient_monodromy import (
    GenericSystem,
    distinct_points,
    find_by_loops,
    start_at,
)
from nag.solving.start.mixed_cells import MixedCells
from nag.solving.start.target import StartSystem, Target, group_degrees, homogenize_rows
from nag.solving.start.total_degree import MOST_PATHS
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy
from nag.tracking.settings import find_settings
from nag.tracking.track import track_regular

# The homotopies begin where the least power of the degeneration's parameter is exp(-LENGTH);
# Newton's method leads from the binomials' solutions to the start points.
LENGTH = 10.0
# Toric paths that are made ready together.
PATHS_AT_ONCE = 8192
# Largest determinant and entry of an adjugate that doubles give exactly.
LARGEST = 1 << 40
# Arc of the start system's coefficients round those of the target, in turns.
WIDTH = 1 / 3


def polyhedral(
    target: Target, cells: MixedCells, rng: np.random.Generator, threads: int
) -> StartSystem:
    """The homotopy from random coefficients, whose solutions come from the mixed cells.

    What toric paths do not reach is looked for by monodromy.

    Raises:
        StartError: if there are too many paths, or not all solutions were found.
    """
    volume = cells.mixed_volume
    if volume > MOST_PATHS:
        raise StartError(f"polyhedral: {volume} paths; at most {MOST_PATHS} are tracked")
    system, spent = by_degeneration(cells, _near(target, rng), threads)
    reached = len(system.points)
    detail = f"its solutions by {spent} toric paths"
    if 0 < reached < volume:
        system, spent, _ = find_by_loops(system, volume, rng, threads)
        detail += f", {volume - reached} of them by monodromy with {spent} regular paths"
    if len(system.points) != volume:
        raise StartError(
            f"polyhedral: {len(system.points)} of the {volume} solutions of the start system were "
            "found"
        )
    return start_at("polyhedral", target, system, detail, 1.0)


def _near(target: Target, rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Random coefficients of absolute value 1, in an arc round the target's.

    On the way to the target no coefficient comes near zero then; where that of a vertex does, paths
    run far towards infinity and back.
    """
    result = []
    for row, support in zip(target.rows, target.supports, strict=True):
        c = np.array([complex(row.get(tuple(e), 0)) for e in support.tolist()])
        turns = np.where(c == 0, 1.0, WIDTH) * (rng.random(len(c)) - 0.5)
        result.append(np.exp(1j * np.angle(c) + 2j * np.pi * turns))
    return tuple(result)


def cell_vectors(cells: MixedCells) -> np.ndarray:
    """The edges' vectors as rows, shape ``(cells, n, n)``."""
    n = cells.edges.shape[1]
    vectors = [
        s[cells.edges[:, i, 1]] - s[cells.edges[:, i, 0]] for i, s in enumerate(cells.supports)
    ]
    return np.stack(vectors, axis=1).reshape(-1, n, n)


def cell_weights(cells: MixedCells) -> np.ndarray:
    """Exponents ``w`` of the terms of all rows, for each cell, shape ``(cells, terms)``.

    Scaled so that the least one that is not zero is 1; those of the edges are zero.
    """
    vectors = cell_vectors(cells).astype(float)
    index = np.arange(len(cells.edges))[:, None]
    rises = np.stack(
        [
            lift[cells.edges[:, i, 0]] - lift[cells.edges[:, i, 1]]
            for i, lift in enumerate(cells.lifts)
        ],
        axis=1,
    )
    normals = np.linalg.solve(vectors, rises[:, :, None])[:, :, 0]
    weights = []
    for i, (support, lift) in enumerate(zip(cells.supports, cells.lifts, strict=True)):
        values = lift + normals @ support.T
        values -= values[index, cells.edges[:, i, :1]]
        values[index, cells.edges[:, i]] = 0.0
        weights.append(values)
    result = np.maximum(np.concatenate(weights, axis=1), 0.0)
    least = np.where(result > 0, result, np.inf).min(axis=1, initial=np.inf, keepdims=True)
    return result / np.where(np.isfinite(least), least, 1.0)


def binomial_solutions(
    cells: MixedCells, coefficients: Sequence[np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Angles of the coordinates of the solutions of all cells' binomials, and their cells.

    All coordinates have absolute value 1, like the coefficients. Shapes ``(P, n)`` and ``(P,)``.

    Raises:
        StartError: if the exponents are too large.
    """
    vectors = cell_vectors(cells)
    n = vectors.shape[2]
    right = np.stack(
        [
            np.angle(-c[cells.edges[:, i, 0]] / c[cells.edges[:, i, 1]])
            for i, c in enumerate(coefficients)
        ],
        axis=1,
    )
    floats = vectors.astype(float)
    inverse = np.linalg.inv(floats)
    volumes = cells.volumes
    adjugate = np.rint(inverse * volumes[:, None, None])
    if max(np.abs(adjugate).max(initial=0), volumes.max(initial=0)) > LARGEST:
        raise StartError("polyhedral: the exponents are too large")
    adjugate = adjugate.astype(np.int64)
    exact = volumes[:, None, None] * np.eye(n, dtype=np.int64)
    if not np.array_equal(vectors @ adjugate, exact):
        raise StartError("polyhedral: the exponents are too large")
    first = (inverse @ right[:, :, None])[:, :, 0]
    angles, owners = [np.zeros((0, n))], [np.zeros(0, dtype=np.int64)]
    for k, volume in enumerate(volumes.tolist()):
        turns = _span(adjugate[k].T % volume, volume)
        angles.append(first[k] + 2 * np.pi / volume * turns)
        owners.append(np.full(volume, k))
    return np.concatenate(angles), np.concatenate(owners)


def _span(generators: np.ndarray, modulus: int) -> np.ndarray:
    """All sums of the ``generators`` modulo ``modulus``, each once, shape ``(count, n)``."""
    group = np.zeros((1, generators.shape[1]), dtype=np.int64)
    for g in generators:
        if len(group) == modulus:
            break
        known = {tuple(x) for x in group.tolist()}
        multiples = [np.zeros_like(g)]
        while tuple(((multiples[-1] + g) % modulus).tolist()) not in known:
            multiples.append((multiples[-1] + g) % modulus)
        group = ((group[None] + np.array(multiples)[:, None]) % modulus).reshape(-1, len(g))
    return group


def by_degeneration(
    cells: MixedCells, coefficients: tuple[np.ndarray, ...], threads: int
) -> tuple[GenericSystem, int]:
    """A system with the cells' supports, its solutions at the ends of toric paths, their number.

    The coefficients are generic, of absolute value 1. If there are as many solutions as the mixed
    volume, they are all, whatever happened on the way. There are fewer where a path was lost, or
    jumped, so that two have one end: in 4 of 7225 runs over seeds of the benchmarks. They are not
    tracked again, as monodromy finds what is missing from what is there.

    Raises:
        StartError: if the exponents are too large.
    """
    n = len(cells.supports)
    groups = (tuple(range(n)),)
    empty = np.zeros((0, 1 + n), dtype=np.complex128)
    system = GenericSystem(cells.supports, coefficients, empty, np.zeros(0))
    if not len(cells.edges):
        return system, 0
    degrees = group_degrees(system.rows, groups)
    homotopy = Homotopy(_single_terms(homogenize_rows(system.rows, n, groups, degrees)))
    ends, paths = [], 0
    for some in cells.blocks(PATHS_AT_ONCE):
        angles, owners = binomial_solutions(some, coefficients)
        starts = np.exp(1j * np.concatenate([np.zeros((len(angles), 1)), angles], axis=1))
        weights = LENGTH * cell_weights(some)[owners]
        ends.append(track_regular(homotopy, starts, find_settings("fast"), threads, weights))
        paths += len(starts)
    points, errors = join_columns([e.points for e in ends]), join_columns([e.errors for e in ends])
    distinct = distinct_points(points, errors, paths)
    return system.holding(distinct.points, distinct.radii), paths


def _single_terms(rows: CompiledRows) -> CompiledRows:
    """The same rows, each term a part of its own."""
    counter = count()
    parts = tuple(
        tuple((next(counter), {e: c}) for _, terms in row for e, c in terms.items())
        for row in rows.parts
    )
    return CompiledRows(rows.N, parts, rows.groups, rows.infinity, rows.degrees)
