"""Random points of a component: each lies on a random slice of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.witness.cutting import ON
from nag.witness.error_radii import sharpened
from nag.witness.fibres import Tracker, move
from nag.witness.membership import component_fibres
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import WitnessSet

ATTEMPTS = 4


@dataclass(frozen=True, eq=False)
class Samples:
    """Points of a component.

    Attributes:
        points: complex, shape ``(count, n)``.
        residual: largest relative residual of the equations at the points.
        accuracy: largest relative error of a point, by its radii (`nag.witness.error_radii`).
    """

    points: np.ndarray
    residual: float
    accuracy: float


class SamplingError(ValueError):
    """Points that could not be found, with the reason.

    Attributes:
        found: the points before the one that could not be found.
    """

    def __init__(self, reason: str, found: Samples) -> None:
        self.found = found
        super().__init__(reason)


def sample(
    system: PolynomialSystem,
    component: WitnessSet,
    count: int,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> Samples:
    """``count`` random points of ``component``, accurate to rounding.

    For each point a random witness point follows the component's slice to a random one, so the
    points are independent. Of a component of dimension 0, its points are drawn.

    Raises:
        SamplingError: if a path fails again and again.
    """
    rng = np.random.default_rng([seed, 3])
    fibres = component_fibres(system, component)
    rows, d, n = component.slice.rows, component.dimension, system.n
    owners = [(fibre, i) for fibre in fibres for i in range(len(fibre))]
    evaluator = Evaluator.of(system.polynomials, n)
    points, accuracy = np.zeros((count, n), dtype=complex), np.finfo(float).eps
    for k in range(count):
        for attempt in range(ATTEMPTS):
            fibre, i = owners[int(rng.integers(len(owners)))]
            target, gamma = random_rows(rng, d, n), complex(unit_complex(rng))
            one = fibre.only(np.arange(len(fibre)) == i)
            there = one
            if d:
                tracker = Tracker("careful" if attempt else settings, threads)
                moved = move(one, rows, target, gamma, tracker)
                there = moved.fibre(fibre.cut, d, np.flatnonzero(moved.regular))
            found = sharpened(there, target)
            x, size = found.fibre.x, 1 + np.linalg.norm(found.fibre.x, axis=1)
            error = (np.linalg.norm(found.radii, axis=1) / size).max(initial=0.0)
            if len(x) and error < 1e-10 and evaluator.residuals(x).max(initial=0.0) < ON:
                points[k], accuracy = x[0], max(accuracy, float(error))
                break
        else:
            some = _samples(evaluator, points[:k], accuracy)
            raise SamplingError(f"point {k + 1} of {count}: {ATTEMPTS} paths failed", some)
    return _samples(evaluator, points, accuracy)


def _samples(evaluator: Evaluator, points: np.ndarray, accuracy: float) -> Samples:
    points.setflags(write=False)
    return Samples(points, float(evaluator.residuals(points).max(initial=0.0)), accuracy)
