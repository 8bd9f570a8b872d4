"""Newton's method at a fixed t with residuals in extended precision."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nag.tracking.compiled import CompiledRows
from nag.tracking.homotopy import Homotopy


class Refined(NamedTuple):
    """Result of `refine`.

    Attributes:
        points: unit norm in each group, shape ``(P, N)``.
        error: estimated relative error of each point.
        moved: distance of each point from where it started.
        smallest: smallest singular value of the Jacobian at each point, patches included;
            polynomial rows are scaled by their largest coefficient, linear rows to unit norm.
        condition: largest over smallest singular value.
    """

    points: np.ndarray
    error: np.ndarray
    moved: np.ndarray
    smallest: np.ndarray
    condition: np.ndarray


def refine(
    rows: CompiledRows | Homotopy,
    A: np.ndarray | None,
    points: np.ndarray,
    *,
    t: complex = 0.0,
    iterations: int = 3,
) -> Refined:
    """Newton's method from ``points`` for rows, slices ``A x = 0`` and patches.

    Args:
        rows: polynomial rows, or a whole homotopy, whose linear rows are then used if ``A`` is
            None.
        A: complex, shape ``(k, N)``.
        points: shape ``(P, N)``.
        t: where the homotopy is taken.
        iterations: number of Newton steps.

    A point where the Jacobian is singular is returned with a large ``error`` and whatever
    Newton's method made of it; compare ``moved`` with what was expected.
    """
    homotopy = rows if isinstance(rows, Homotopy) else Homotopy(rows, A)
    if isinstance(rows, Homotopy) and A is not None:
        homotopy = Homotopy(rows.rows, A, None, rows.factors, rows.infinity)
    points = homotopy.normalized(points)
    P = len(points)
    if P == 0:
        nothing = np.zeros(0)
        return Refined(points, nothing, nothing, nothing, nothing)
    start = points
    error = np.full(P, np.inf)
    with np.errstate(all="ignore"):
        for _ in range(iterations):
            patch = homotopy.patch(points)
            J, scale = _scaled_jacobian(homotopy, points, t, patch)
            residual = homotopy.values(points.astype(np.clongdouble), t).astype(np.complex128)
            rhs = np.concatenate([residual, np.zeros((P, patch.shape[1]))], axis=1) / scale
            step = _solve(J, rhs)
            good = np.isfinite(step).all(axis=1) & (np.linalg.norm(step, axis=1) < 0.5)
            step[~good] = 0
            error = np.where(good, np.linalg.norm(step, axis=1), np.inf)
            points = homotopy.normalized(points - step)
        J, _ = _scaled_jacobian(homotopy, points, t, homotopy.patch(points))
        values = np.linalg.svd(J, compute_uv=False)
    smallest = values[:, -1]
    condition = values[:, 0] / np.maximum(smallest, 1e-300)
    # The last step was the error before it; what is left is rounding of the point itself.
    error = np.maximum(np.minimum(error, error**2 * condition), 2e-16)
    moved = np.linalg.norm(aligned_difference(homotopy, points, start), axis=1)
    return Refined(points, error, moved, smallest, condition)


def aligned_difference(homotopy: Homotopy, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """``first - second`` after turning each group of ``second`` into the phase of ``first``."""
    second = second.copy()
    for indices in homotopy.groups:
        g = list(indices)
        product = (second[:, g].conj() * first[:, g]).sum(axis=1, keepdims=True)
        size = np.abs(product)
        second[:, g] *= np.where(size > 0, product / np.where(size > 0, size, 1), 1)
    return first - second


def _scaled_jacobian(
    homotopy: Homotopy, points: np.ndarray, t: complex, patch: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Jacobian with patches, linear rows scaled to unit norm, and the scales of all rows.

    Polynomial rows are scaled by their coefficients when they are compiled and never by their
    gradient at a point: a gradient that vanishes there is what a singular point shows.
    """
    J = np.concatenate([homotopy.jacobian(points, t), patch], axis=1)
    scale = np.ones(J.shape[:2])
    first = len(homotopy.rows)
    last = first + len(homotopy.A0)
    norms = np.linalg.norm(J[:, first:last], axis=2)
    scale[:, first:last] = np.where(norms > 0, norms, 1.0)
    return J / scale[:, :, None], scale


def _solve(J: np.ndarray, rhs: np.ndarray) -> np.ndarray:
    try:
        return np.linalg.solve(J, rhs[:, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        result = np.full(rhs.shape, np.nan, dtype=np.complex128)
        for k in range(len(J)):
            try:
                result[k] = np.linalg.solve(J[k], rhs[k])
            except np.linalg.LinAlgError:
                result[k] = np.linalg.lstsq(J[k], rhs[k], rcond=None)[0]
        return result
