"""Start systems whose solutions monodromy finds from one of them, all of them by the trace test."""

from __future__ import annotations

from functools import partial

import numpy as np

from nag.errors import StartError
from nag.solving.start.fibre_monodromy import by_monodromy, seeded, start_at
from nag.solving.start.mixed_cells import mixed_cells
from nag.solving.start.pencil import irreducible_row, seeded_pencil, trace_is_linear
from nag.solving.start.target import Start, Target, unit
from nag.solving.start.total_degree import MOST_PATHS


def monodromy(target: Target, rng: np.random.Generator, threads: int) -> Start:
    """The homotopy from random coefficients, whose solutions come from one of them by loops.

    The search ends when the trace test proves that there are no more; if no equation's pencil
    allows it, at the mixed volume.

    Raises:
        StartError: if there are too many paths, or it is not proven that all solutions were found.
    """
    gamma = complex(unit(rng, 1)[0])
    row = irreducible_row(target.supports, rng)
    if row is None:
        return _up_to_the_mixed_volume(target, gamma, rng, threads)
    pencil, seed = seeded_pencil(target.supports, row, rng)
    test = partial(trace_is_linear, pencil, rng=rng, threads=threads)
    system, spent, proven = by_monodromy(seed, MOST_PATHS, rng, threads, test)
    if not proven:
        raise StartError(
            f"monodromy: {len(system.points)} solutions were found, but no trace proves that these "
            "are all"
        )
    detail = f"its solutions by monodromy, {spent} regular paths; all by the trace test"
    return start_at("monodromy", target, system, detail, gamma)


def _up_to_the_mixed_volume(
    target: Target, gamma: complex, rng: np.random.Generator, threads: int
) -> Start:
    volume = mixed_cells(target.supports, rng).mixed_volume
    if volume > MOST_PATHS:
        raise StartError(f"monodromy: {volume} paths; at most {MOST_PATHS} are tracked")
    system, spent = seeded(target.supports, rng), 0
    if volume:
        system, spent, _ = by_monodromy(system, volume, rng, threads)
    else:
        system = system.holding(system.points[:0], system.errors[:0])
    if len(system.points) != volume:
        raise StartError(
            f"monodromy: {len(system.points)} of the {volume} solutions of the start system were "
            "found"
        )
    detail = f"its solutions by monodromy, {spent} regular paths; the mixed volume says how many"
    return start_at("monodromy", target, system, detail, gamma)
