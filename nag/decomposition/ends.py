"""Ends of paths sorted out: regular ones, clusters of singular ones, and where lost paths lead."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.decomposition.excluded import excluded
from nag.numerics.coincidence import clusters, coincident
from nag.witness.fibres import Fibre, PathEnds

# Failed paths that are known to lead next to a point are known to so much of it, no better: what
# they were seen to go to is the limit of several branches that are one to the digits they had.
ASTRAY = 1e-6
Cluster = list[tuple[np.ndarray, float]]


@dataclass(frozen=True, eq=False)
class Candidates:
    """Ends of one dimension: fibres of regular ones, and clusters of singular ones.

    A cluster is its points, the best known one first, with their errors. ``unclear``: ends of which
    it is not known whether they are excluded. ``lost``: where failed paths seem to lead, as
    clusters, and how many ends of paths there are in all next to each of them.
    """

    fibres: list[Fibre]
    singular: list[Cluster]
    unclear: int
    lost: list[tuple[Cluster, int]]


def collect(pieces: Sequence[PathEnds], nonzero: Sequence[Polynomial]) -> Candidates:
    """The ends of paths to points on a slice, with the systems that cut them.

    Args:
        nonzero: polynomials that must not vanish; ends where one does are left out.
    """
    n = pieces[0].cut.n
    fibres: list[Fibre] = []
    unclear = 0
    seen = np.zeros((0, n), dtype=complex)
    singular, errors = [np.zeros((0, n), dtype=complex)], [np.zeros(0)]
    failed, every = [np.zeros((0, n), dtype=complex)], []
    for ends in pieces:
        x = ends.x
        left_out, doubtful = excluded(nonzero, ends)
        allowed, unclear = ends.finite & ~left_out, unclear + doubtful
        # The tracker has seen that ends of one piece are distinct.
        chosen = [
            i
            for i in np.flatnonzero(allowed & ends.regular)
            if not (len(seen) and coincident(seen, x[i], ends.accuracy[i]).any())
        ]
        if chosen:
            seen = np.vstack([seen, x[chosen]])
            fibres.append(ends.fibre(chosen))
        rest = allowed & ~ends.regular
        singular.append(x[rest])
        errors.append(ends.accuracy[rest])
        lost = ends.failed & (ends.accuracy < ASTRAY)
        failed.append(x[lost])
        every.append(x[ends.finite | lost])
    points, accuracy = np.vstack(singular), np.concatenate(errors)
    groups = clusters(points, accuracy)
    several = [[(points[i], float(accuracy[i])) for i in g] for g in groups]
    return Candidates(fibres, several, unclear, _crowds(np.vstack(failed), every))


def _crowds(lost: np.ndarray, every: Sequence[np.ndarray]) -> list[tuple[Cluster, int]]:
    """Clusters of failed ends, and how many of all ends are next to each."""
    if not len(lost):
        return []
    found, ends = [], np.vstack(every)
    for own in clusters(lost, np.full(len(lost), ASTRAY)):
        near = np.any([coincident(ends, lost[i], ASTRAY) for i in own], axis=0)
        found.append(([(lost[i], ASTRAY) for i in own], int(near.sum())))
    return found
