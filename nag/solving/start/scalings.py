"""Scalings of unknowns and parameters that keep the equations of a family.

The length unit of a mechanism is the simplest one; where all coefficients of an equation are
parameters, they may be multiplied by a number.
"""

from __future__ import annotations

import numpy as np

from nag.algebra.exact_ranks import LARGE
from nag.algebra.family import Family

# Starts and steps of the search for the nearest scaling.
TRIALS, NEWTON_STEPS = 8, 20


def scaling_weights(family: Family) -> np.ndarray:
    """Weights of unknowns and parameters for which all equations are homogeneous.

    Returns:
        A basis of them, shape ``(m, n + k)``, each largest weight one in absolute value. Those that
        keep all parameters are left out.
    """
    n = family.n
    size = n + len(family.parameters)
    rows = [np.zeros((1, size))]
    for f in family.polynomials:
        exponents = np.array(list(f.terms), dtype=float).reshape(-1, size)
        rows.append(exponents[1:] - exponents[:1])
    matrix = np.concatenate(rows)
    whole = matrix.astype(int).tolist()
    dimension = size - LARGE.rank(whole)
    kernel = np.linalg.svd(matrix, full_matrices=True)[2][size - dimension :]
    # Of the kernel that part is kept which moves parameters.
    directions = np.linalg.svd(kernel[:, n:], full_matrices=False)[2]
    count = dimension - n + LARGE.rank([row[:n] for row in whole])
    if not count:
        return np.zeros((0, size))
    coordinates = np.linalg.lstsq(kernel[:, n:].T, directions[:count].T, rcond=None)[0]
    weights = coordinates.T @ kernel
    return weights / np.abs(weights).max(axis=1, keepdims=True)


def random_scaling(weights: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Factors of unknowns and parameters, shape ``(n + k,)``."""
    m = len(weights)
    exponents = rng.normal(scale=0.5, size=m) + 2j * np.pi * rng.random(m)
    return np.exp(exponents @ weights)


def nearest_scaling(
    weights: np.ndarray, values: np.ndarray, target: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """Factors of unknowns and parameters that bring ``values`` near to ``target``.

    The squared distance of the parameters is made small by Newton's method of Gauss, from random
    factors and from one. Nothing need vanish, steps are shortened and the best end counts, arrived
    or not: no zeros are looked for, as by `nag.numerics.double_newton`.
    """
    k = len(values)
    best, nearest = np.zeros(len(weights), dtype=np.complex128), np.inf
    W = weights[:, weights.shape[1] - k :]
    for trial in range(TRIALS if len(weights) else 0):
        exponents = np.zeros(len(W), dtype=np.complex128)
        if trial:
            exponents += rng.normal(size=len(W)) + 2j * np.pi * rng.random(len(W))
        for _ in range(NEWTON_STEPS):
            moved = values * np.exp(exponents @ W)
            step = np.linalg.lstsq((moved * W).T, target - moved, rcond=None)[0]
            exponents = exponents + step / max(1.0, float(np.abs(step).max(initial=0.0)))
        distance = float(np.linalg.norm(values * np.exp(exponents @ W) - target))
        if distance < nearest:
            best, nearest = exponents, distance
    return np.exp(best @ weights)
