"""Polyhedral start systems: the supports of the target with random coefficients.

Bernstein's theorem says how many solutions such a system has: the mixed volume. The supports
hold the origin, so that the paths lead to solutions with vanishing coordinates as well.

References:
    Bernstein, The number of roots of a system of equations, 1975; Huber & Sturmfels, 1995;
    Li & Wang, The BKK root count in C^n, 1996.
"""

from __future__ import annotations

import numpy as np

from nag.tracking.homotopy import straight_line
from nag.tracking.start.fibre_monodromy import GenericSystem, by_monodromy, seeded
from nag.tracking.start.mixed_cells import MixedCells
from nag.tracking.start.target import Start, StartError, Target, group_degrees, homogenized, unit
from nag.tracking.start.toric import by_degeneration
from nag.tracking.start.total_degree import MOST_PATHS

# Arc of the start system's coefficients round those of the target, in turns.
WIDTH = 1 / 3


def polyhedral(target: Target, cells: MixedCells, rng: np.random.Generator, threads: int) -> Start:
    """The homotopy from random coefficients, whose solutions come from the mixed cells.

    What toric paths do not reach is looked for by monodromy.

    Raises:
        StartError: if there are too many paths, or not all solutions were found.
    """
    volume = _bounded("polyhedral", cells.mixed_volume)
    system, spent = by_degeneration(cells, _near(target, rng), threads)
    reached = len(system.points)
    detail = f"its solutions by {spent} toric paths"
    if 0 < reached < volume:
        system, spent = by_monodromy(system, volume, rng, threads)
        detail += f", {volume - reached} of them by monodromy with {spent} regular paths"
    return _start("polyhedral", target, system, volume, detail, 1.0)


def monodromy(target: Target, volume: int, rng: np.random.Generator, threads: int) -> Start:
    """The homotopy from random coefficients, whose solutions come from one of them by loops.

    Args:
        target: the system to be solved.
        volume: the mixed volume, the number of solutions that the start system has.
        rng: where the coefficients come from.
        threads: number of threads.

    Raises:
        StartError: if there are too many paths, or not all those solutions were found.
    """
    _bounded("monodromy", volume)
    system, spent = seeded(target.supports, rng), 0
    if volume == 0:
        system = GenericSystem(system.supports, system.coefficients, system.points[:0])
    else:
        system, spent = by_monodromy(system, volume, rng, threads)
    detail = f"its solutions by monodromy, {spent} regular paths"
    return _start("monodromy", target, system, volume, detail, complex(unit(rng, 1)[0]))


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


def _bounded(name: str, volume: int) -> int:
    if volume > MOST_PATHS:
        raise StartError(f"{name}: {volume} paths; at most {MOST_PATHS} are tracked")
    return volume


def _start(
    name: str,
    target: Target,
    system: GenericSystem,
    volume: int,
    detail: str,
    gamma: complex,
) -> Start:
    if len(system.points) != volume:
        raise StartError(
            f"{name}: {len(system.points)} of the {volume} solutions of the start system were found"
        )
    groups = (tuple(range(target.n)),)
    degrees = group_degrees(system.rows, groups)
    begin = homogenized(system.rows, target.n, groups, degrees)
    goal = homogenized(target.rows, target.n, groups, degrees)
    homotopy = straight_line(begin, goal, gamma)
    return Start(name, homotopy, system.points, groups, detail=detail)
