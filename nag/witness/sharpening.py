"""Regular points of a cut on a slice, to rounding, in doubles."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.witness.slices import padded

# Newton's method from the end point of a path must arrive within this many steps.
NEWTON_STEPS = 12
# Steps that are rounding errors, and residuals at points that are known.
ROUNDING, VANISHING = 1e-14, 1e-11
# Gradients below this, relative to what their degree lets them have, are not scaled up further.
FLAT = 1e-4


@dataclass(frozen=True)
class Sharpened:
    """What Newton's method made of a point: ``z`` affine, the size of the last step, success."""

    z: np.ndarray
    step: float
    converged: bool


def sharpen(evaluator: Evaluator, rows: np.ndarray, z: np.ndarray) -> Sharpened:
    """Gauss-Newton for ``evaluator`` and the slice ``rows`` from the affine point ``z``.

    It succeeds when the steps shrink to rounding at once and the residuals vanish with them, as
    they do near a regular zero and nowhere else.
    """
    a = padded(rows, 1 + len(z))
    step, slow, floor = np.inf, 0, 1e-10
    for _ in range(NEWTON_STEPS):
        values = evaluator.values(z[None])[0]
        jacobian = evaluator.jacobian(z)
        matrix = np.vstack([jacobian, a[:, 1:]])
        right = np.concatenate([values, a[:, 0] + a[:, 1:] @ z])
        weights = 1 / np.maximum(np.linalg.norm(matrix, axis=1), _floors(evaluator, z, len(a)))
        delta, _, _, s = np.linalg.lstsq(matrix * weights[:, None], right * weights, rcond=1e-14)
        z = z - delta
        if len(s) and s[-1] > 0:
            floor = min(max(1e-10, 1e2 * np.finfo(float).eps * s[0] / s[-1]), 1e-8)
        last, step = step, float(np.linalg.norm(delta) / (1 + np.linalg.norm(z)))
        # Rounding alone keeps the steps at a badly conditioned point from shrinking further.
        if step < ROUNDING or (step < floor and step > 0.25 * last):
            break
        slow += step > 0.25 * last
        if not np.isfinite(step) or slow > 2:
            return Sharpened(z, np.inf, False)
    residual = float(evaluator.residuals(z[None]).max(initial=0.0))
    return Sharpened(z, step, bool(step < floor) and residual < VANISHING)


def sharpen_all(evaluator: Evaluator, rows: np.ndarray, points: np.ndarray) -> list[Sharpened]:
    """`sharpen` for points of shape ``(P, n)``; those known to rounding take one step together."""
    found: list[Sharpened | None] = [None] * len(points)
    a = padded(rows, 1 + points.shape[1])
    columns = points.shape[1]
    if len(evaluator.coefficients) + len(a) == columns > 0:
        jacobians = evaluator.placed_derivatives(columns)(points)
        slices = np.broadcast_to(a[:, 1:], (len(points), len(a), columns))
        matrices = np.concatenate([jacobians, slices], axis=1)
        values = [evaluator.values(points), a[:, 0] + points @ a[:, 1:].T]
        with contextlib.suppress(np.linalg.LinAlgError):
            steps = np.linalg.solve(matrices, np.concatenate(values, axis=1)[:, :, None])[:, :, 0]
            moved = points - steps
            sizes = np.linalg.norm(steps, axis=1) / (1 + np.linalg.norm(moved, axis=1))
            residuals = evaluator.residuals(moved).max(axis=1, initial=0.0)
            for i in np.flatnonzero((sizes < ROUNDING) & (residuals < VANISHING)):
                found[i] = Sharpened(moved[i], float(sizes[i]), True)
    return [
        sharpen(evaluator, rows, z) if known is None else known
        for z, known in zip(points, found, strict=True)
    ]


def _floors(evaluator: Evaluator, z: np.ndarray, slices: int) -> np.ndarray:
    """Least sizes that gradients are scaled by.

    A gradient that vanishes at the solution (that of a square, say) is rounding error near it;
    scaled to length one it would outvote the equations that determine the point.
    """
    size = max(1.0, float(np.abs(z).max(initial=1.0)))
    return np.concatenate([FLAT * size ** (evaluator.degrees - 1.0), np.full(slices, 1e-300)])
