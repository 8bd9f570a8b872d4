"""Polyhedral start systems: the supports of the target with random coefficients.

Bernstein's theorem says how many solutions such a system has: the mixed volume. The supports
hold the origin, so that the paths lead to solutions with vanishing coordinates as well.

References:
    Bernstein, The number of roots of a system of equations, 1975; Huber & Sturmfels, 1995;
    Li & Wang, The BKK root count in C^n, 1996.
"""

from __future__ import annotations

import numpy as np

from nag.solving.start.fibre_monodromy import by_monodromy, start_at
from nag.solving.start.mixed_cells import MixedCells
from nag.solving.start.target import Start, StartError, Target
from nag.solving.start.toric import by_degeneration
from nag.solving.start.total_degree import MOST_PATHS

# Arc of the start system's coefficients round those of the target, in turns.
WIDTH = 1 / 3


def polyhedral(target: Target, cells: MixedCells, rng: np.random.Generator, threads: int) -> Start:
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
        system, spent, _ = by_monodromy(system, volume, rng, threads)
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
