"""Polyhedral start systems: the supports of the target with random coefficients.

Bernstein's theorem says how many solutions such a system has: the mixed volume. The supports
hold the origin, so that the paths lead to solutions with vanishing coordinates as well; only where
equations tell that there are no such, they are those of the target alone.

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
from dataclasses import dataclass, replace
from itertools import count
from math import lcm, prod

import flint
import numpy as np

from nag.errors import StartError
from nag.numerics.array_table import join_columns
from nag.solving.start.coefficient_monodromy import (
    GenericSystem,
    distinct_points,
    find_by_loops,
    start_at,
)
from nag.solving.start.invariance import (
    close_under,
    find_invariant,
    find_orbits,
    find_row_symmetries,
)
from nag.solving.start.mixed_cells import MixedCells
from nag.solving.start.target import StartSystem, Target, group_degrees, homogenize_rows
from nag.solving.start.total_degree import MOST_PATHS
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy
from nag.tracking.known import KnownOfPaths
from nag.tracking.settings import find_settings
from nag.tracking.track import track_regular

# The homotopies begin where the least power of the degeneration's parameter is exp(-LENGTH);
# Newton's method leads from the binomials' solutions to the start points.
LENGTH = 10.0
# Toric paths that are made ready together.
PATHS_AT_ONCE = 8192
# Largest determinant and entry of an adjugate that doubles give exactly.
LARGEST = 1 << 40
# So many paths take more time than symmetries to be looked for.
MANY = 2048
# So many solutions show whether coefficients are generic.
PILOT = 256
# The largest group of turns that is used.
MOST_TURNS = 4096
# Arc of the start system's coefficients round those of the target, in turns.
WIDTH = 1 / 3


def polyhedral(
    target: Target, cells: MixedCells, rng: np.random.Generator, threads: int
) -> StartSystem:
    """The homotopy from random coefficients, whose solutions come from the mixed cells.

    The coefficients are such as symmetries of the target keep, if these have as many solutions.
    What toric paths do not reach is looked for by monodromy.

    Raises:
        StartError: if there are too many paths, or not all solutions were found.
    """
    volume = cells.mixed_volume
    if volume > MOST_PATHS:
        raise StartError(f"polyhedral: {volume} paths; at most {MOST_PATHS} are tracked")
    near = _near(target, rng)
    if volume >= MANY:
        start = _symmetric(target, cells, near, threads)
        if start is not None:
            return start
    system, spent = by_degeneration(cells, near, threads)
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


def _symmetric(
    target: Target, cells: MixedCells, near: Sequence[np.ndarray], threads: int
) -> StartSystem | None:
    """The homotopy from coefficients that symmetries keep; None if there are no such symmetries.

    Nor where such coefficients leave fewer solutions than the mixed volume.
    """
    step = -(-cells.mixed_volume // PILOT)
    some = replace(cells, edges=cells.edges[::step], volumes=cells.volumes[::step])

    def is_generic(coefficients: tuple[np.ndarray, ...]) -> bool:
        found, _ = by_degeneration(some, coefficients, threads)
        return len(found.points) == some.mixed_volume

    generators = find_row_symmetries(target)
    coefficients, symmetries = find_invariant(target.supports, near, generators, is_generic)
    if not symmetries:
        return None
    system, spent = by_degeneration(cells, coefficients, threads)
    system = close_under(system, symmetries, cells.mixed_volume)
    orbits = find_orbits(system, symmetries)
    if len(system.points) != cells.mixed_volume or orbits is None:
        return None
    detail = f"its solutions by {spent} toric paths; symmetries leave {len(orbits.chosen)} of them"
    start = start_at("polyhedral", target, system, detail, 1.0)
    return replace(start, known=KnownOfPaths(orbits=orbits))


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
    cells: MixedCells, coefficients: Sequence[np.ndarray], turns: CoordinateTurns | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Angles of the coordinates of the solutions of all cells' binomials, and their cells.

    With ``turns`` there is one of those that these carry into each other. All coordinates have
    absolute value 1, like the coefficients. Shapes ``(P, n)`` and ``(P,)``.

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
        kept = np.zeros((1, n), dtype=np.int64) if turns is None else turns.modulo(volume)
        _, cosets = _span(adjugate[k].T % volume, volume, volume, kept)
        angles.append(first[k] + 2 * np.pi / volume * cosets)
        owners.append(np.full(len(cosets), k))
    return np.concatenate(angles), np.concatenate(owners)


def _span(
    generators: np.ndarray, modulus: int, size: int, subgroup: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """All sums of the ``generators`` and elements of a ``subgroup``, modulo ``modulus``, each once.

    And one of each coset of the subgroup. Shapes ``(size, n)``, as so many sums there are, and
    ``(count, n)``.
    """
    group = subgroup
    cosets = np.zeros((1, generators.shape[1]), dtype=np.int64)
    for g in generators:
        if len(group) == size:
            break
        known = {tuple(x) for x in group.tolist()}
        multiples = [np.zeros_like(g)]
        while tuple(((multiples[-1] + g) % modulus).tolist()) not in known:
            multiples.append((multiples[-1] + g) % modulus)
        more = np.array(multiples)[:, None]
        group = ((group[None] + more) % modulus).reshape(-1, len(g))
        cosets = ((cosets[None] + more) % modulus).reshape(-1, len(g))
    return group, cosets


@dataclass(frozen=True, eq=False)
class CoordinateTurns:
    """The finite group of turns of the coordinates that keep all systems of given supports.

    Turned by its elements, each row is multiplied by a number: the exponents of a row differ by
    whole numbers of turns.

    Attributes:
        order: the least common multiple of the orders of its elements.
        elements: angles in units of ``1 / order`` of a turn, the identity first, shape ``(m, n)``.
    """

    order: int
    elements: np.ndarray

    @classmethod
    def of(cls, supports: Sequence[np.ndarray]) -> CoordinateTurns:
        """The group for these supports; of a large one, or an infinite one, the identity alone."""
        n = len(supports)
        identity = cls(1, np.zeros((1, n), dtype=np.int64))
        rows = np.concatenate([np.zeros((0, n), dtype=np.int64), *(s - s[:1] for s in supports)])
        lattice = flint.fmpz_mat(np.unique(rows, axis=0).tolist())
        if lattice.rank() < n:
            return identity
        form = lattice.hnf().table()[:n]
        size = prod(int(row[i]) for i, row in enumerate(form))
        if size > MOST_TURNS:
            return identity
        inverse = (flint.fmpq_mat(flint.fmpz_mat(form)) ** -1).table()
        order = lcm(*(int(c.q) for row in inverse for c in row))
        generators = np.array([[int(c * order) % order for c in row] for row in inverse]).T
        return cls(order, _span(generators, order, size, identity.elements)[0])

    def modulo(self, modulus: int) -> np.ndarray:
        """The elements' angles in units of ``1 / modulus`` of a turn."""
        return self.elements * modulus // self.order

    def of_points(self, points: np.ndarray) -> np.ndarray:
        """All images of points in projective coordinates, shape ``(P m, 1 + n)``."""
        factors = np.exp(2j * np.pi / self.order * self.elements)
        factors = np.concatenate([np.ones((len(factors), 1)), factors], axis=1)
        return (points[:, None] * factors).reshape(-1, points.shape[1])


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
    turns, ends, paths = CoordinateTurns.of(cells.supports), [], 0
    for some in cells.blocks(PATHS_AT_ONCE):
        angles, owners = binomial_solutions(some, coefficients, turns)
        starts = np.exp(1j * np.concatenate([np.zeros((len(angles), 1)), angles], axis=1))
        weights = LENGTH * cell_weights(some)[owners]
        ends.append(track_regular(homotopy, starts, find_settings("fast"), threads, weights))
        paths += len(starts)
    points = turns.of_points(join_columns([e.points for e in ends]))
    errors = np.repeat(join_columns([e.errors for e in ends]), len(turns.elements))
    distinct = distinct_points(points, errors, len(points))
    return system.holding(distinct.points, distinct.radii), paths


def _single_terms(rows: CompiledRows) -> CompiledRows:
    """The same rows, each term a part of its own."""
    counter = count()
    parts = tuple(
        tuple((next(counter), {e: c}) for _, terms in row for e, c in terms.items())
        for row in rows.parts
    )
    return CompiledRows(rows.N, parts, rows.groups, rows.infinity, rows.degrees)
