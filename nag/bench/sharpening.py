"""Newton's method from rough points in several arithmetics: error against time, step by step."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.bench.reference import Reference
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of
from nag.numerics.newton import newton_step, subtract_step
from nag.tracking.compiled import compile_rows
from nag.tracking.ends.newton_steps import affine_points, newton_steps
from nag.tracking.homotopy import Homotopy
from nag.tracking.newton import refine

# Errors of the points that it begins at: relative to their sizes, and to the way to the next zero.
ROUGH, PART = 1e-4, 1e-2
# Digits of balls, and points that are sharpened in them: each is one by itself.
DIGITS = (50, 100)
# Doubles in a number, and what numbers of so many are called.
WORDS = {2: "double-double", 4: "quad-double"}
MOST_IN_BALLS = 16
MOST_STEPS = 24
# Seconds for which a curve's point is repeated; the fastest run counts.
RUNS = 0.05


@dataclass(frozen=True)
class SharpeningCost:
    """What so many steps gave: processor seconds for one point, and errors."""

    steps: int
    seconds: float
    largest: float
    median: float


def sharpening(
    system: PolynomialSystem, reference: Reference, seed: int = 0
) -> dict[str, list[SharpeningCost]]:
    """Curves by arithmetic: after one Newton step, two, and so on."""
    rng = np.random.default_rng(seed)
    shape = reference.high.shape
    noise = rng.standard_normal(shape) + 1j * rng.standard_normal(shape)
    sizes = np.maximum(np.abs(reference.high), 1e-3)
    rough = reference.high + np.minimum(ROUGH * sizes, PART * _apart(reference)) * noise
    curves = {
        "double": _curve(_in_doubles(system, rough), reference, len(rough), 5),
        "double, residuals in double-double": _curve(
            _with_exact_residuals(system, rough), reference, len(rough), 5
        ),
    }
    for words, name in WORDS.items():
        curves[name] = _word_curve(system, reference, rough, words)
    count = min(MOST_IN_BALLS, len(rough))
    exact = BallPolynomials.of(system.polynomials)
    for digits in DIGITS:
        name = f"balls of {digits} digits"
        curves[name] = _ball_curve(exact, reference, rough[:count], digits)
    return curves


def _apart(reference: Reference) -> np.ndarray:
    """Distances of the zeros from the nearest others, shape ``(k, 1)``."""
    high, low = reference.high, reference.low
    off = (high[:, None] - high) + (low[:, None] - low)
    distances = np.abs(off).max(axis=2, initial=0.0)
    np.fill_diagonal(distances, np.inf)
    return distances.min(axis=1, keepdims=True, initial=np.inf)


def _curve(
    work: Callable[[int], np.ndarray], reference: Reference, count: int, most: int
) -> list[SharpeningCost]:
    found = []
    places = np.arange(len(reference.high))
    work(1)
    for steps in range(1, most + 1):
        best, begun = np.inf, time.process_time()
        while best == np.inf or time.process_time() - begun < RUNS:
            begin = time.process_time()
            points = work(steps)
            best = min(best, time.process_time() - begin)
        errors = reference.errors(points, places)
        found.append(
            SharpeningCost(steps, best / count, float(errors.max()), float(np.median(errors)))
        )
    return found


def _in_doubles(system: PolynomialSystem, rough: np.ndarray) -> Callable[[int], np.ndarray]:
    evaluator = Evaluator.of(system.polynomials, system.n)
    jacobian = evaluator.placed_derivatives(system.n)

    def work(steps: int) -> np.ndarray:
        x = rough
        for _ in range(steps):
            x = x - np.linalg.solve(jacobian(x), evaluator.values(x)[..., None])[..., 0]
        return x

    return work


def _with_exact_residuals(
    system: PolynomialSystem, rough: np.ndarray
) -> Callable[[int], np.ndarray]:
    # One homogenising coordinate, which comes first.
    rows = compile_rows(system.polynomials)
    homotopy = Homotopy(rows, np.zeros((0, rows.N), dtype=complex))
    start = np.hstack([np.ones((len(rough), 1)), rough])

    def work(steps: int) -> np.ndarray:
        x = refine(homotopy, None, start, iterations=steps).points
        return x[:, 1:] / x[:, :1]

    return work


def _word_curve(
    system: PolynomialSystem, reference: Reference, rough: np.ndarray, words: int
) -> list[SharpeningCost]:
    """Newton's method in sums of doubles, as ends of paths are sharpened by."""
    rows = compile_rows(system.polynomials)
    homotopy = Homotopy(rows, np.zeros((0, rows.N), dtype=complex))
    start = np.hstack([np.ones((len(rough), 1)), rough])
    newton_steps(homotopy, start[:1], words, 1)
    found = []
    for steps in range(1, 6 + words // 2):
        best, begun = np.inf, time.process_time()
        while best == np.inf or time.process_time() - begun < RUNS:
            begin = time.process_time()
            points = newton_steps(homotopy, start, words, steps)
            best = min(best, time.process_time() - begin)
        errors = [reference.fine_error(x, i) for i, x in enumerate(affine_points(points))]
        found.append(
            SharpeningCost(steps, best / len(rough), max(errors), float(np.median(errors)))
        )
    return found


def _ball_curve(
    exact: BallPolynomials, reference: Reference, rough: np.ndarray, digits: int
) -> list[SharpeningCost]:
    """Newton's method in balls, used by their midpoints."""
    found = []
    points = [[flint.acb(complex(z)) for z in x] for x in rough]
    seconds, steps = 0.0, 0
    bits = bits_of(digits)
    while steps < MOST_STEPS and (steps < 2 or found[-1].largest < 0.8 * found[-2].largest):
        begin = time.process_time()
        for i, x in enumerate(points):
            points[i] = subtract_step(x, newton_step(exact, x, bits), bits)
        seconds += time.process_time() - begin
        steps += 1
        errors = [reference.fine_error(x, i) for i, x in enumerate(points)]
        found.append(
            SharpeningCost(steps, seconds / len(points), max(errors), float(np.median(errors)))
        )
    return found
