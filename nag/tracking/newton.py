"""Newton's method at a fixed t with residuals in double-double."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nag.tracking import evaluations
from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy, norms
from nag.tracking.projective import ROUNDING, aligned_difference


class Refined(NamedTuple):
    """Result of `refine`.

    Attributes:
        points: unit norm in each group, shape ``(P, N)``.
        error: estimated relative error of each point: length of the last Newton step, at least
            `ROUNDING`; inf where there was none, or it was no small step.
        moved: distance of each point from where it started.
        before: smallest singular value of the Jacobian where the point started, patches included;
            polynomial rows are scaled by their largest coefficient, linear rows to about unit
            norm (by powers of two).
        smallest: the same at the end.
        size: Frobenius norm of the Jacobian.
        condition: ``size / smallest``.
        further: one more Newton step at each point, shape ``(P, N)``, if it was asked for: together
            they have twice the digits of the points alone.
    """

    points: np.ndarray
    error: np.ndarray
    moved: np.ndarray
    before: np.ndarray
    smallest: np.ndarray
    size: np.ndarray
    condition: np.ndarray
    further: np.ndarray | None = None


def refine(
    rows: CompiledRows | Homotopy,
    A: np.ndarray | None,
    points: np.ndarray,
    *,
    t: complex = 0.0,
    iterations: int = 3,
    twice: bool = False,
    member: np.ndarray | None = None,
) -> Refined:
    """Newton's method from ``points`` for rows, slices ``A x = 0`` and patches.

    Residuals are evaluated in double-double from exact coefficients, so that a regular point is
    found to the last digit of double precision.

    Args:
        rows: polynomial rows, or a whole homotopy, whose linear rows are then used if ``A`` is
            None.
        A: complex, shape ``(k, N)``.
        points: shape ``(P, N)``.
        t: where the homotopy is taken.
        iterations: number of Newton steps.
        twice: whether points are found to twice the digits of doubles.
        member: of a homotopy with members, whose zeros are near the points, shape ``(P,)``.

    A point where the Jacobian is singular is returned with a large ``error`` and whatever
    Newton's method made of it; compare ``moved`` with what was expected.
    """
    from nag.tracking.kernel_arrays import at_end, scratch_table
    from nag.tracking.newton_kernel import Refinement, doubled_table, newton_lanes

    homotopy = _at(rows, A, t)
    start = homotopy.normalized(points)
    result = start.copy()
    P = len(start)
    before, smallest, error, size = np.zeros(P), np.zeros(P), np.full(P, np.inf), np.zeros(P)
    further = np.zeros(result.shape if twice else (1, 1), dtype=np.complex128)
    if P:
        batch = Refinement(
            points=result,
            member=np.zeros(P, dtype=np.int64) if member is None else member,
            count=P,
            iterations=iterations,
            before=before,
            after=smallest,
            error=error,
            frobenius=size,
            further=further,
            twice=int(twice),
        )
        newton_lanes(at_end(homotopy), scratch_table(homotopy, 1), doubled_table(homotopy), batch)
        evaluations.count(P * (iterations + 1 + int(twice)))
    # A matrix that is singular in double precision leaves NaN.
    before, smallest = (np.where(np.isfinite(v), v, 0.0) for v in (before, smallest))
    if not np.isfinite(result).all():
        result = np.where(np.isfinite(result), result, start)
    moved = norms(aligned_difference(homotopy.groups, result, start))
    size = np.where(np.isfinite(size), size, 0.0)
    condition = size / np.maximum(smallest, 1e-300)
    error = np.maximum(error, ROUNDING)
    steps = further if twice else None
    return Refined(result, error, moved, before, smallest, size, condition, steps)


def _at(rows: CompiledRows | Homotopy, A: np.ndarray | None, t: complex) -> Homotopy:
    """A homotopy that is at t = 0 what is to be solved."""
    if not isinstance(rows, Homotopy):
        return Homotopy(rows, A)
    if A is None and t == 0:
        return rows
    A = rows.A0 + t * rows.A1 if A is None else A
    factors = tuple((a + t * b, 0.0) for a, b in rows.factors)
    return Homotopy(rows.rows, A, None, factors, rows.infinity)
