"""The last checks of a class of points before it is reported as a component."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations_with_replacement, permutations

import numpy as np

from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import Class
from nag.witness.confirm import confirmed
from nag.witness.cutting import ON, Equations, numerical_corank, sharpen
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.frame import Frame
from nag.witness.multiplicity import multiplicity
from nag.witness.points import Points
from nag.witness.slices import complex_normal, unit_complex
from nag.witness.witness import PathCounts, Status, WitnessSet

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
    equations: Equations, rows: np.ndarray, x: np.ndarray, regular: bool, rng: np.random.Generator
) -> list[int]:
    """Coranks of the Jacobian at points on the slice ``rows``, shape ``(P, n)``.

    Where the slice cuts the component in ``regular`` points, and doubles say otherwise, as they do
    where coordinates differ much in size, digits decide.
    """
    d, result = len(rows), []
    for point in x:
        s = np.linalg.svd(equations.evaluator.balanced_jacobian(point), compute_uv=False)
        corank = numerical_corank(s, len(point), 1e-9)
        if regular and corank != d and multiplicity(equations.polynomials, rows, point, rng) == 1:
            corank = d
        result.append(corank)
    return result


def _sharpened(fibres: Sequence[Fibre], rows: np.ndarray) -> tuple[list[Fibre], float]:
    """Points to rounding, in an order that does not depend on how they were found."""
    result, largest = [], float(np.finfo(float).eps)
    for fibre in fibres:
        ends = [sharpen(fibre.cut.evaluator, rows, z) for z in fibre.points]
        largest = max([largest, *(s.step if np.isfinite(s.step) else np.inf for s in ends)])
        points = np.array([s.z for s in ends])
        if points.shape[1]:
            points = points[np.lexsort((points.imag[:, 0], points.real[:, 0]))]
        result.append(Fibre(fibre.cut, fibre.dimension, points))
    return result, largest


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
    chosen, _ = points.fibres(found.indices)
    first = chosen[0].points[0]
    chosen, accuracy = _sharpened(chosen, rows)
    y = np.vstack([fibre.x for fibre in chosen])
    x, accuracy = frame.points(y), frame.error(y, accuracy)
    residual = float(reduction.original.residuals(x).max(initial=0.0))
    coranks = _coranks(reduced, rows, y, not chosen[0].cut.deflated, rng)
    reasons = [found.reason] if found.reason else []
    if residual > ON:
        reasons.append("a point does not satisfy all equations")
    if not confirmed(chosen[0].cut, reduced.polynomials, rows, first):
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
            slice=frame.slice(rows),
            points=x,
            multiplicity=multiple,
            status=Status.UNDECIDED if reasons else Status.IRREDUCIBLE,
            residual=residual,
            accuracy=accuracy,
            corank=coranks[0],
            multidegree=multidegree,
            note="; ".join(reasons),
            fibres=tuple(
                Fibre(
                    reduction.lifted(fibre.cut),
                    d,
                    np.hstack([frame.points(fibre.x), fibre.points[:, fibre.cut.n :]]),
                )
                for fibre in chosen
            ),
        ),
        counts,
    )
