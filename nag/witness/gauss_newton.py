"""Zeros of polynomial systems from starting points that may be far away.

Steps are damped as by Levenberg and Marquardt until the residuals are small: undamped ones
(`nag.numerics.double_newton`) would lead from afar to anywhere, or nowhere. Those are the last
steps, and invert the Jacobian at a gap of its singular values only, which keeps the convergence
quadratic where its rank drops on the zero set (Zeng, rank-r Newton iteration, 2023).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.numerics.double_newton import find_zeros
from nag.numerics.double_ranks import numerical_corank
from nag.numerics.doubles import SHARP, VANISHING

# Damped steps, and those from where residuals are small.
MOST_STEPS, MOST_LAST_STEPS = 200, 30
# Residuals from which the undamped steps take over, and that a zero must reach.
CLOSE = 1e-6
# Decides: Singular values, over the largest, that may belong to the kernel; the gap decides.
SMALL = 1e-3
# Damping, beside the squared residual: where it begins, the least, and that from which on steps are
# too short to lead anywhere.
FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-2, 1e-8, 1e8
# Part of what a linear equation would gain that makes a step worth taking.
GAIN = 1e-3


@dataclass(frozen=True, eq=False)
class IterationEnd:
    """Where the iteration arrived.

    Attributes:
        x: the point.
        corank: corank of the Jacobian there.
        step: relative size of the last step.
        converged: whether it is a zero to rounding and the steps shrank quadratically.
    """

    x: np.ndarray
    corank: int
    step: float
    converged: bool


def _balance_rows(evaluator: Evaluator, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values and Jacobian, each row divided by the size that its degree lets it have."""
    size = max(1.0, float(np.abs(x).max(initial=1.0)))
    weights = size ** -(evaluator.degrees - 1.0)
    values, jacobian = evaluator.values(x[None])[0] * weights, evaluator.balanced_jacobian(x)
    return (values.real, jacobian.real) if np.isrealobj(x) else (values, jacobian)


def descend(evaluator: Evaluator, x: np.ndarray, close: float = CLOSE) -> np.ndarray | None:
    """A point with residuals of size ``close``, from ``x``; None if they stop to fall before.

    Real starting points lead to real points.
    """
    damping = FIRST_DAMPING
    values, jacobian = _balance_rows(evaluator, x)
    for _ in range(MOST_STEPS):
        size = float(np.linalg.norm(values))
        if size < close * (1 + float(np.linalg.norm(x))):
            return x
        u, s, vh = np.linalg.svd(jacobian, full_matrices=False)
        right = u.conj().T @ values
        while damping < MOST_DAMPING:
            step = vh.conj().T @ (s / (s**2 + damping * size**2) * right)
            trial = x - step
            new_values, new_jacobian = _balance_rows(evaluator, trial)
            gain = size - float(np.linalg.norm(new_values))
            if np.isfinite(gain) and gain > GAIN * size * min(1.0, 1 / (1 + damping)):
                x, values, jacobian = trial, new_values, new_jacobian
                damping = max(damping / 5, LEAST_DAMPING)
                break
            damping *= 4
        else:
            return None
    return None


def polish(evaluator: Evaluator, x: np.ndarray, corank: int | None = None) -> IterationEnd:
    """Newton's method with the Jacobian's rank kept at a gap, from a point near the zero set."""
    n = len(x)

    def equations(x: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, jacobian = _balance_rows(evaluator, x[0])
        return values[None], jacobian[None]

    coranks = [corank or 0]

    def count_rank(s: np.ndarray) -> np.ndarray:
        coranks.append(numerical_corank(s[0], n, SMALL) if corank is None else corank)
        return np.array([n - coranks[-1]])

    ends = find_zeros(equations, x[None], MOST_LAST_STEPS, count_rank)
    x, step = ends.x[0], float(ends.last[0]) / (1 + float(np.linalg.norm(ends.x[0])))
    residual = float(evaluator.residuals(x[None]).max(initial=0.0))
    return IterationEnd(x, coranks[-1], step, step < SHARP and residual < VANISHING)
