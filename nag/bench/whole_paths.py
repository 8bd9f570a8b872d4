"""Paths tracked wholly in one arithmetic, from their starts to their ends: error against time.

Doubles, with ends as they are or sharpened with residuals in double-double; double-double and
quad-double throughout. In balls, in which a step of Newton's method takes some hundred times as
long as in doubles, only the ends of paths in doubles are sharpened.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.reference import NEAR, Found, Reference, compare_in_balls, compare_points
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of, change_units
from nag.numerics.newton import newton_step, subtract_step
from nag.solving.isolated_zero import affine_point
from nag.solving.square_problem import SquareProblem
from nag.solving.start.choice import choose
from nag.solving.start.target import StartSystem, Target
from nag.tracking.ends.follow import follow_whole
from nag.tracking.evaluations import count_evaluations
from nag.tracking.newton import refine
from nag.tracking.paths import PathStatus, Reason
from nag.tracking.settings import NAMED, Settings
from nag.tracking.track import run_in_doubles

# Largest corrections after a prediction, by which a curve's points differ.
WHOLE_TOLERANCES = (1e-1, 1e-3, 1e-5)
# Doubles in a number, and what numbers of so many are called.
WORDS = {"double-double": 2, "quad-double": 4}
# Digits of balls, and steps of Newton's method in them, from the end of a path in doubles.
DIGITS, STEPS = {"balls of 50 digits": 50, "balls of 100 digits": 100}, {50: 3, 100: 4}
DOUBLE, RESIDUALS = "double", "double, residuals in double-double"
# Digits of what is worked out from ends, and a singular value that does not vanish.
FINEST, TINY = 120, 1e-12
ARITHMETICS = (DOUBLE, RESIDUALS, *WORDS, *DIGITS)

Ends = np.ndarray | list[list[Any]]


@dataclass(frozen=True, eq=False)
class WholePaths:
    """A square system in scaled variables and the paths to its zeros, each to be tracked.

    Attributes:
        others: equations that these zeros need not satisfy, and nonzero: polynomials that must not
            vanish; in the system's own variables.
    """

    others: tuple[Polynomial, ...]
    nonzero: tuple[Polynomial, ...]
    target: Target
    begin: StartSystem

    @classmethod
    def of(cls, system: PolynomialSystem, seed: int) -> WholePaths:
        """The start system that `nag.solving.solve.solve` would choose."""
        rng = np.random.default_rng(seed)
        problem = SquareProblem.of(system, [f for f in system.polynomials if f], rng)
        others = system.polynomials if problem.squared else ()
        begin = choose(problem.target, "auto", system.groups, rng, 1)[0]
        return cls(others, system.nonzero, problem.target, begin)

    def tracked(self, arithmetic: str, tolerance: float) -> Ends:
        """Regular ends in the system's own variables, where they are finite."""
        settings = replace(NAMED["default"], tolerance=tolerance, digits=16)
        if arithmetic in (DOUBLE, RESIDUALS):
            ends = self._in_doubles(settings, arithmetic == RESIDUALS)
            return self.target.original(ends)
        if arithmetic in WORDS:
            return self._original(self._in_words(WORDS[arithmetic], settings))
        return self._original(self._in_balls(DIGITS[arithmetic], settings))

    def zeros_among(self, ends: Ends) -> Ends:
        """The ends that are zeros of the system, as far as doubles tell."""
        if not len(ends) or not (self.others or self.nonzero):
            return ends
        points = ends
        if not isinstance(ends, np.ndarray):
            points = np.array([[complex(z.mid()) for z in x] for x in ends])
        n = self.target.n
        kept = np.ones(len(points), dtype=bool)
        if self.others:
            kept &= (Evaluator.of(self.others, n).residuals(points) < NEAR).all(axis=1)
        if self.nonzero:
            kept &= (Evaluator.of(self.nonzero, n).residuals(points) >= NEAR).all(axis=1)
        return ends[kept] if ends is points else [x for x, k in zip(ends, kept, strict=True) if k]

    def _in_doubles(self, settings: Settings, sharpened: bool) -> np.ndarray:
        homotopy = self.begin.homotopy
        starts = homotopy.normalized(self.begin.points)
        run = run_in_doubles(homotopy, starts, settings, 1, endgame=False)
        ends = run.points[run.reason == Reason.NONE]
        return self.begin.affine(refine(homotopy, None, ends).points if sharpened else ends)

    def _in_words(self, words: int, settings: Settings) -> list[list[Any]]:
        homotopy = self.begin.homotopy
        starts = homotopy.normalized(self.begin.points)
        least = refine(homotopy, None, starts, t=1.0, iterations=0).smallest
        parts = np.zeros((*starts.shape, 2, words))
        parts[..., 0, 0], parts[..., 1, 0] = starts.real, starts.imag
        paths = follow_whole(homotopy, parts, 1 / np.maximum(least, TINY), settings)
        chosen = paths.where(PathStatus.REGULAR).tolist()
        return [list(affine_point(self.begin, paths.balls[i]).centre) for i in chosen]

    def _in_balls(self, digits: int, settings: Settings) -> list[list[Any]]:
        n = self.target.n
        rows = BallPolynomials.of([Polynomial(n, dict(row)) for row in self.target.rows])
        found = []
        for point in self._in_doubles(settings, True):
            x: list[Any] | None = [flint.acb(complex(z)) for z in point]
            for _ in range(STEPS[digits]):
                step = None if x is None else newton_step(rows, x, bits_of(digits))
                # Where the matrix is singular, the end is no regular one.
                x = None if step is None else subtract_step(x, step, bits_of(digits))
            if x is not None:
                found.append(x)
        return found

    def _original(self, points: list[list[Any]]) -> list[list[Any]]:
        if not self.target.scales:
            return points
        powers, natural = self.target.scales, self.target.natural
        factors = [s * Fraction(2) ** int(k) for s, k in zip(natural.scales, powers, strict=True)]
        bits = bits_of(FINEST)
        return [change_units(x, factors, natural.origin, bits) for x in points]


def tracked_in(
    paths: WholePaths, reference: Reference, arithmetic: str, tolerance: float
) -> tuple[float, int, Found]:
    """Processor seconds of tracking, evaluations of the system, and what was found."""
    with count_evaluations() as spent:
        begin = time.process_time()
        ends = paths.zeros_among(paths.tracked(arithmetic, tolerance))
        seconds = time.process_time() - begin
    compare = compare_points if isinstance(ends, np.ndarray) else compare_in_balls
    return seconds, spent.number, compare(reference, ends)
