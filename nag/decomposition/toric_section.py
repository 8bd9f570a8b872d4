"""The section of a set of turns by a slice, all at once and proved whole by counting.

If a system of turns has as many zeros on a slice as a mixed volume allows, all its components have
the least dimension that as many equations leave (`nag.solving.start.isotropic`).
"""

from __future__ import annotations

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import looped_turns
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Superset
from nag.errors import StartError
from nag.solving.start.isotropic import IsotropicSection, in_doubles
from nag.tracking.compiled import compile_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.run import Run
from nag.tracking.track import track
from nag.witness.cutting import Cut
from nag.witness.fibres import ends_of_paths, homogeneous
from nag.witness.slices import random_rows
from nag.witness.witness import PathCounts


def section_at_once(
    reduction: Reduction, flag: np.ndarray, rng: np.random.Generator, run: Run
) -> tuple[Superset | None, PathCounts]:
    """Witness points of a set of turns, if they are proved to be all.

    Also what paths that took. None if the system is not one of turns, or if there are fewer zeros
    than the mixed volume: the set may have a larger component, or meet infinity where others do
    not.
    """
    section = _section(reduction, flag)
    if section is None:
        return None, PathCounts()
    x, tracked = section.zeros(run.settings, rng, run.threads)
    counts = PathCounts(tracked)
    if x is None:
        return None, counts
    # At rest the points become zeros of the equations with all their coefficients, on the slice.
    n, d = reduction.n, section.turns.freedoms
    own = Cut(n, 0, reduction.reduced.polynomials)
    paths = track(
        Homotopy(compile_rows(own.polynomials, n=n), flag[:d]),
        homogeneous(x[:, reduction.kept] / reduction.scales),
        in_doubles(run.settings),
        run.threads,
        endgame=False,
    )
    ends = ends_of_paths(paths, keep=n)
    if not ends.regular.all():
        return None, counts
    return Superset({d: [ends.fibre(own, d, range(len(x)))]}, flag, PathCounts(), ()), counts


def paths_at_once(system: PolynomialSystem) -> int | None:
    """How many paths `section_at_once` tracks; None if the system is not one of turns."""
    reduction, rng = Reduction.of(system), np.random.default_rng(0)
    section = _section(reduction, random_rows(rng, reduction.n, reduction.n))
    try:
        return None if section is None else section.cells(rng).mixed_volume or None
    except StartError:
        return None


def _section(reduction: Reduction, flag: np.ndarray) -> IsotropicSection | None:
    """The section by as many rows of the flag as leave points; None for other systems."""
    system = reduction.natural.system(reduction.system)
    turns = None if system.nonzero else looped_turns(system)
    if turns is None or turns.freedoms != reduction.n - len(reduction.reduced.polynomials):
        return None
    rows = flag[: turns.freedoms]
    slices = np.zeros((len(rows), 1 + system.n), dtype=complex)
    slices[:, 0] = rows[:, 0]
    slices[:, [1 + i for i in reduction.kept]] = rows[:, 1:] / reduction.scales
    return IsotropicSection(turns, slices)
