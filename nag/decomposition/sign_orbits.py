"""Orbits of components under sign changes of variables that keep every equation.

Sign changes commute and are their own inverses, so that each of them either keeps the orbit found
so far or doubles it: one motion of the slice for each, with all points at once.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.numerics.coincidence import coincident
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.slices import unit_complex
from nag.witness.witness import PathCounts

Signs = tuple[int, ...]


def keeps(cut: Cut, signs: Sequence[int]) -> bool:
    """Whether a sign change carries each polynomial of a cut to itself or to its negative."""
    flipped = [i for i, s in enumerate(signs) if s < 0]
    return not cut.deflated and all(
        len({sum(e[i] for i in flipped) % 2 for e in f.terms}) <= 1 for f in cut.polynomials
    )


def sign_orbit(
    fibre: Fibre,
    rows: np.ndarray,
    generators: Sequence[Signs],
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[list[tuple[int, ...]] | None, PathCounts]:
    """The sign changes that carry a component to those of its orbit, itself first.

    Args:
        fibre: all points of the component on a generic slice, with a cut that the generators keep.
        rows: that slice.
        generators: signs of the variables.

    Returns:
        For each component of the orbit the indices of the generators whose product carries to it,
        and the paths; None instead if paths fail.
    """
    carriers: list[tuple[int, ...]] = [()]
    points, counts = fibre.points, PathCounts()
    for k, signs in enumerate(generators):
        factor = np.array(signs, dtype=float)
        images, error, spent = _moved(fibre, points * factor, rows, factor, rng, tracker)
        counts += spent
        if images is None:
            return None, counts
        if coincident(points, images[0], error).any():
            continue
        points = np.vstack([points, images])
        carriers += [(*carrier, k) for carrier in carriers]
    return carriers, counts


def _moved(
    fibre: Fibre,
    images: np.ndarray,
    rows: np.ndarray,
    factor: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[np.ndarray | None, float, PathCounts]:
    """Images of points, from the slice that they lie on to the common one, and their error.

    None if a path fails.
    """
    if fibre.dimension == 0:
        return images, 0.0, PathCounts()
    moved = Fibre(fibre.cut, fibre.dimension, images)
    there = rows * np.concatenate([[1.0], factor])
    ends = move(moved, there, rows, complex(unit_complex(rng)), tracker)
    if not ends.regular.all():
        return None, 0.0, ends.counts.judged_elsewhere
    return ends.points, float(ends.accuracy.max(initial=0.0)), ends.counts.judged_elsewhere
