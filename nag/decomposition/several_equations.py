"""The components of several equations by paths: intersected one by one, or solved all at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.assembly import Known, assembled
from nag.decomposition.hypersurface import NEARER
from nag.decomposition.isolated import contains, counted, is_finite, solved_at_once, with_points
from nag.decomposition.orbits import Action
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Ambient, intersection_order, witness_superset
from nag.witness.fibres import Tracker
from nag.witness.points import Points
from nag.witness.slices import random_rows
from nag.witness.witness import Decomposition


def decompose_several(
    reduction: Reduction,
    seed: int,
    rng: np.random.Generator,
    tracker: Tracker,
    symmetries: Sequence[SignedPermutation],
    scheme: bool,
) -> Decomposition:
    """The components of a system whose linear equations are solved, by paths.

    Args:
        seed: of the intersections; ``rng`` serves what comes before and instead of them.
        scheme: whether multiplicities are of interest.
    """
    system = reduction.system
    if is_finite(reduction.reduced, rng, tracker):
        points = solved_at_once(system, rng, tracker, symmetries, finite=True)
        if points is not None:
            return replace(points, seed=seed, settings=tracker.settings)

    answer, only_points = _one_by_one(
        reduction, np.random.default_rng(seed), tracker, symmetries, scheme
    )
    if not answer.complete and answer.dimension > 0 and only_points:
        answer = with_points(answer, rng, tracker, symmetries) or answer
    if not answer.complete and answer.dimension <= 0:
        points = solved_at_once(system, rng, tracker, symmetries)
        if points is not None and contains(points, answer):
            tracked = answer.paths.tracked + points.paths.tracked
            answer = replace(points, paths=replace(points.paths, tracked=tracked))
    return counted(replace(answer, seed=seed, settings=tracker.settings), scheme)


def _one_by_one(
    reduction: Reduction,
    rng: np.random.Generator,
    tracker: Tracker,
    symmetries: Sequence[SignedPermutation],
    scheme: bool,
) -> tuple[Decomposition, bool]:
    """The components by intersecting with one equation after the other.

    Also whether all doubts of that are about isolated points.
    """
    reduced = reduction.reduced
    order = intersection_order(reduced.polynomials)
    equations = [reduced.polynomials[i] for i in order]
    flag = random_rows(rng, reduced.n, reduced.n, NEARER)
    superset = witness_superset(equations, Ambient.space(flag, reduced.nonzero), rng, tracker)
    notes = list(superset.notes)
    if superset.counts.failed:
        notes.append(f"{superset.counts.failed} paths failed; points may be missing")
    known = Known(
        actions=[Action.of(g, reduction.frame) for g in symmetries if not g.is_identity],
        scheme=scheme,
    )
    points = {d: Points.of(fibres, superset.flag[:d]) for d, fibres in superset.fibres.items()}
    found = assembled(points, reduction, rng, tracker, known)
    answer = Decomposition(
        system=reduction.system,
        components=found.components,
        paths=superset.counts + found.counts,
        seed=0,
        settings=tracker.settings,
        order=tuple(order),
        complete=found.complete and not notes,
        notes=(*notes, *found.notes),
    )
    return answer, superset.only_points and not found.notes
