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
from nag.tracking.settings import Settings
from nag.tracking.start.fibre_monodromy import generic_solutions
from nag.tracking.start.target import Start, StartError, Target, group_degrees, homogenized, unit
from nag.tracking.start.total_degree import MOST_PATHS


def mixed_volume(target: Target, rng: np.random.Generator) -> int:
    """The mixed volume of the supports, each with the origin.

    Raises:
        StartError: if there are too many mixed cells.
    """
    from nag.tracking.start.mixed_cells import mixed_cells

    return mixed_cells(target.supports, rng).mixed_volume


def polyhedral(
    target: Target,
    volume: int,
    rng: np.random.Generator,
    settings: Settings | str,
    threads: int,
    name: str = "polyhedral",
) -> Start:
    """The homotopy from random coefficients to those of the target.

    Args:
        volume: the mixed volume, the number of solutions that the start system has.

    Raises:
        StartError: if there are too many paths, or not all of those solutions were found.
    """
    if volume > MOST_PATHS:
        raise StartError(f"polyhedral: {volume} paths; at most {MOST_PATHS} are tracked")
    groups = (tuple(range(target.n)),)
    if volume == 0:
        rows = tuple({tuple(e): 1.0 for e in s.tolist()} for s in target.supports)
        points, spent = np.zeros((0, 1 + target.n), dtype=np.complex128), 0
    else:
        rows, points, spent = generic_solutions(target.supports, volume, rng, settings, threads)
    if len(points) != volume:
        raise StartError(
            f"polyhedral: {len(points)} of the {volume} solutions of the start system were found"
        )
    degrees = group_degrees(rows, groups)
    begin = homogenized(rows, target.n, groups, degrees)
    goal = homogenized(target.rows, target.n, groups, degrees)
    gamma = complex(unit(rng, 1)[0])
    detail = f"its solutions by monodromy, {spent} regular paths"
    return Start(name, straight_line(begin, goal, gamma), points, groups, detail=detail)
