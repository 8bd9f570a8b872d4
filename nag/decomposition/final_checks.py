"""The last checks of a class of points before it is reported as a component."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations_with_replacement, permutations

import numpy as np

from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import Class
from nag.numerics.small_values import ON, SINGULAR
from nag.witness.confirm import confirmed
from nag.witness.cutting import Equations, numerical_corank
from nag.witness.error_radii import Sharp, framed, in_order, sharpened
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.frame import Frame
from nag.witness.multiplicity import multiplicity
from nag.witness.points import Points
from nag.witness.slices import complex_normal, unit_complex
from nag.witness.witness import PathCounts, Slice, Status, WitnessSet

# Multidegrees are counted only where so many choices of groups are enough.
MOST_MULTIDEGREES = 100


def _multidegree(
    fibres: Sequence[Fibre],
    rows: np.ndarray,
    groups: Sequence[Sequence[int]],
    frame: Frame,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[np.ndarray | None, PathCounts]:
    """Numbers of points with groups fixed at random values, by moving the slice there."""
    d, counts = len(rows), PathCounts()
    choices = list(combinations_with_replacement(range(len(groups)), d))
    sizes = [len(g) for g in groups]
    choices = [c for c in choices if all(c.count(g) <= sizes[g] for g in c)]
    if not groups or len(choices) > MOST_MULTIDEGREES:
        return None, counts
    degrees = np.zeros((len(groups),) * d, dtype=int)
    for choice in choices:
        A = np.zeros((d, len(frame.t)), dtype=complex)
        for row, g in enumerate(choice):
            A[row, list(groups[g])] = complex_normal(rng, (sizes[g],))
        target = frame.pulled_back(A, complex_normal(rng, (d,)))
        finite = 0
        if d == 0 or np.linalg.matrix_rank(target[:, 1:]) == d:
            gamma = complex(unit_complex(rng))
            for fibre in fibres:
                ends = move(fibre, rows, target, gamma, tracker, endgame=True)
                counts += ends.counts
                if ends.failed.any():
                    return None, counts
                finite += int(ends.finite.sum())
        for place in set(permutations(choice)):
            degrees[place] = finite
    return degrees, counts


def _coranks(
    equations: Equations, rows: np.ndarray, fibre: Fibre, rng: np.random.Generator
) -> list[int]:
    """Coranks of the Jacobian at the points of a fibre on the slice ``rows``.

    Where the equations cut the component in regular points, and doubles say otherwise, as they do
    where coordinates differ much in size, digits decide; of points that are close to others, they
    have.
    """
    d, result, regular = len(rows), [], not fibre.cut.deflated
    matrices = [equations.evaluator.balanced_jacobian(point) for point in fibre.x]
    singular = np.linalg.svd(np.array(matrices), compute_uv=False)
    for i, (point, s) in enumerate(zip(fibre.x, singular, strict=True)):
        if regular and i in fibre.fine:
            result.append(d)
            continue
        corank = numerical_corank(s, len(point), SINGULAR)
        if regular and corank != d and multiplicity(equations.polynomials, rows, point, rng) == 1:
            corank = d
        result.append(corank)
    return result


def _in_original(
    chosen: Sequence[Sharp], rows: np.ndarray, reduction: Reduction
) -> tuple[list[Sharp], Slice]:
    """Points in the original coordinates, and their slice.

    A slice of scaled coordinates is rounded on its way to the original ones, and the points on it
    are found anew; where points are close to each other, it is taken over exactly.
    """
    frame, close = reduction.frame, any(each.fibre.fine for each in chosen)
    cut = frame.slice(rows, orthonormal=not close)
    lifted = [_lifted(each.fibre, reduction) for each in chosen]
    if (frame.scales != 1).any():
        return [sharpened(fibre, cut.rows) for fibre in lifted], cut
    radii = [framed(frame, each.fibre.x, each.radii) for each in chosen]
    whole = zip(lifted, radii, chosen, strict=True)
    return [Sharp(fibre, r, each.digits) for fibre, r, each in whole], cut


def _lifted(fibre: Fibre, reduction: Reduction) -> Fibre:
    """A fibre in the original coordinates."""
    points = np.hstack([reduction.frame.points(fibre.x), fibre.points[:, fibre.cut.n :]])
    fine = {i: reduction.lifted_fine(each) for i, each in fibre.fine.items()}
    return Fibre(reduction.lifted(fibre.cut), fibre.dimension, points, fine)


def checked_witness_set(
    found: Class,
    points: Points,
    reduction: Reduction,
    rng: np.random.Generator,
    tracker: Tracker,
    scheme: bool = True,
) -> tuple[WitnessSet, PathCounts]:
    """A class of points as a witness set, after the final checks.

    Without ``scheme`` the set need not be a component of the scheme of the equations; then its
    multiplicity is 1 if it is a reduced one, and 0, not known, otherwise.
    """
    rows, d, counts = points.rows, points.dimension, PathCounts()
    reduced, frame, groups = reduction.equations, reduction.frame, reduction.system.groups
    by_cuts = points.fibres(found.indices)
    first = by_cuts[0][0].points[0], by_cuts[0][0].fine.get(0)
    sharp = [in_order(sharpened(f, rows, points.exact.only(own))) for f, own in by_cuts]
    chosen = [each.fibre for each in sharp]
    y = np.vstack([fibre.x for fibre in chosen])
    lifted, cut = _in_original(sharp, rows, reduction)
    x = np.vstack([each.fibre.x for each in lifted])
    residual = float(reduction.original.residuals(x).max(initial=0.0))
    coranks = [k for fibre in chosen for k in _coranks(reduced, rows, fibre, rng)]
    reasons = [found.reason] if found.reason else []
    if residual > ON:
        reasons.append("a point does not satisfy all equations")
    if not confirmed(chosen[0].cut, reduced.polynomials, rows, *first):
        reasons.append("a point does not satisfy all equations in 100 digits: zeros too close")
    if len(set(coranks)) > 1:
        reasons.append("the corank of the Jacobian differs between its points")
    multiple = int(coranks[0] == d)
    if scheme and not multiple:
        nearest = y[np.linalg.norm(y, axis=1).argmin()]
        multiple = multiplicity(reduced.polynomials, rows, nearest, rng)
    if scheme and coranks[0] != d and not chosen[0].cut.deflated:
        reasons.append("its points are regular and singular at once: zeros too close")
    if scheme and multiple == 0:
        reasons.append("its multiplicity was not found")
    multidegree = None
    if groups:
        multidegree, counts = _multidegree(chosen, rows, groups, frame, rng, tracker)
    return (
        WitnessSet(
            slice=cut,
            points=x,
            multiplicity=multiple,
            status=Status.UNDECIDED if reasons else Status.IRREDUCIBLE,
            residual=residual,
            radii=np.vstack([each.radii for each in lifted]),
            digits=np.concatenate([each.digits for each in lifted]),
            corank=coranks[0],
            multidegree=multidegree,
            note="; ".join(reasons),
            fibres=tuple(each.fibre for each in lifted),
        ),
        counts,
    )
