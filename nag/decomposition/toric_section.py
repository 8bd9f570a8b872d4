"""The section of a set of turns by a slice, all at once and proved whole by counting.

If a system of turns has as many zeros on a slice as a mixed volume allows, all its components have
the least dimension that as many equations leave (`nag.solving.start.isotropic`).
"""

from __future__ import annotations

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import Turns, looped_turns
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
    reduction: Reduction, turns: Turns, flag: np.ndarray, rng: np.random.Generator, run: Run
) -> tuple[Superset | None, PathCounts]:
    """Witness points of a set of turns, if they are proved to be all.

    Also what paths that took. None if there are fewer zeros than the mixed volume: the set may have
    a larger component, or meet infinity where others do not.
    """
    section = _section(reduction, turns, flag)
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
    ends = ends_of_paths(paths, own, flag[:d])
    if not ends.regular.all():
        return None, counts
    return Superset({d: [ends.fibre()]}, PathCounts(), ()), counts


def paths_at_once(system: PolynomialSystem) -> int | None:
    """How many paths `section_at_once` tracks; None if the system is not one of turns."""
    reduction, rng = Reduction.of(system), np.random.default_rng(0)
    turns = turns_to_cut(reduction)
    if turns is None:
        return None
    try:
        section = _section(reduction, turns, random_rows(rng, reduction.n, reduction.n))
        return section.cells(rng).mixed_volume or None
    except StartError:
        return None


def turns_to_cut(reduction: Reduction) -> Turns | None:
    """The turns that a system is one of, in dimension as its equations count; None for others."""
    system = reduction.natural.system(reduction.system)
    turns = None if system.nonzero else looped_turns(system)
    own = turns is not None and turns.freedoms == reduction.n - len(reduction.reduced.polynomials)
    return turns if own else None


def _section(reduction: Reduction, turns: Turns, flag: np.ndarray) -> IsotropicSection:
    """The section by as many rows of the flag as leave points."""
    rows = flag[: turns.freedoms]
    slices = np.zeros((len(rows), 1 + reduction.system.n), dtype=complex)
    slices[:, 0] = rows[:, 0]
    slices[:, [1 + i for i in reduction.kept]] = rows[:, 1:] / reduction.scales
    return IsotropicSection(turns, slices)
