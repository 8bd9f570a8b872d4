"""The components of several equations by paths: intersected one by one, or solved all at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.assembly import Known, assembled
from nag.decomposition.final_checks import judged
from nag.decomposition.hypersurface import NEARER
from nag.decomposition.isolated import contains, counted, is_finite, solved_at_once, with_points
from nag.decomposition.orbits import Action
from nag.decomposition.reduction import Reduction
from nag.decomposition.superset import Ambient, Superset, intersection_order, witness_superset
from nag.decomposition.toric_section import section_at_once
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
    intersecting = np.random.default_rng(seed)
    flag = random_rows(intersecting, reduction.n, reduction.n, NEARER)
    whole, spent = section_at_once(reduction, flag, np.random.default_rng([seed, 23]), tracker)
    if whole is None:
        finite, asked = is_finite(reduction.reduced, rng, tracker)
        spent = spent + asked
        points = solved_at_once(system, rng, tracker, symmetries, finite=True) if finite else None
        if points is not None:
            return replace(points, seed=seed, settings=tracker.settings, paths=points.paths + spent)

    order = [] if whole else intersection_order(reduction.reduced.polynomials)
    superset = whole or _one_by_one(reduction, order, flag, intersecting, tracker)
    superset = replace(superset, counts=superset.counts + spent)
    known = Known(
        actions=[Action.of(g, reduction.frame) for g in symmetries if not g.is_identity],
        scheme=scheme,
    )
    answer, only_points = _put_together(reduction, superset, intersecting, tracker, known)
    answer = replace(answer, order=tuple(order))
    if not answer.complete and answer.dimension > 0 and only_points:
        answer = with_points(answer, rng, tracker, symmetries) or answer
    if not answer.complete and answer.dimension <= 0:
        points = solved_at_once(system, rng, tracker, symmetries)
        if points is not None and contains(points, answer):
            tracked = answer.paths.tracked + points.paths.tracked
            answer = replace(points, paths=replace(points.paths, tracked=tracked))
    # Zeros of a section that is whole were counted before.
    if whole is None or not answer.complete:
        answer = counted(answer, scheme)
    return replace(answer, seed=seed, settings=tracker.settings)


def _one_by_one(
    reduction: Reduction,
    order: Sequence[int],
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> Superset:
    """Witness points by intersecting with one equation after the other."""
    reduced = reduction.reduced
    equations = [reduced.polynomials[i] for i in order]
    return witness_superset(equations, Ambient.space(flag, reduced.nonzero), rng, tracker)


def _put_together(
    reduction: Reduction,
    superset: Superset,
    rng: np.random.Generator,
    tracker: Tracker,
    known: Known,
) -> tuple[Decomposition, bool]:
    """The components of witness points of all dimensions.

    Also whether all doubts of that are about isolated points.
    """
    notes = list(superset.notes)
    if superset.counts.failed:
        notes.append(f"{superset.counts.failed} paths failed; points may be missing")
    points = {d: Points.of(fibres, superset.flag[:d]) for d, fibres in superset.fibres.items()}
    found = assembled(points, reduction, rng, tracker, known)
    notes += found.notes
    paths = superset.counts + found.counts
    answer = judged(reduction.system, found.components, paths, tracker.settings, notes)
    return answer, superset.only_points and not found.notes
