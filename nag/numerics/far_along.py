"""Whether equations vanish along a smooth set of zeros of some of them, seen far from the point.

Beside a zero, what vanishes along a curve to a high order cannot be told from what vanishes on it:
it takes as many digits as the order is high. Far away no power of the distance is small, and
equations that are not zero along the curve are not small there either. So the curve is followed
away from the point, in small steps, and one look at its end decides, whatever the order is.

References:
    Sommese & Wampler, The numerical solution of systems of polynomials, 2005, on membership.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.numerics.descent import Point, Round
from nag.numerics.digits import doubles, log_norm, working
from nag.numerics.exact_system import ExactSystem
from nag.numerics.sharpening import DIGITS, predicted, sharpen

# How far a set is followed in the variables that are free, or in any, all of them scaled to a size
# of one; and in how many steps at most. Much further out many sets are nearly singular.
FAR, AT_MOST, STEPS = 10.0, 100.0, 600
# Directions that are tried: some lead into a branch point.
DIRECTIONS = 3
# What Newton's steps may change after a step, as shares of it, so that it leads to no other sheet:
# the first one after steps by a high order and by a low one; the second one beside the first,
# or, where both are rounding, beside the step.
SMALL, SMALL_ROUGHLY, CONTRACTION, ROUNDING = 0.01, 0.1, 0.05, 1e-6
# The first step, and the least one beside the distance that was gone.
FIRST, LEAST = 1e-2, 1e-12
# Inverses (decimal logarithm) up to which doubles do.
GOOD = 5.0


def far_value(
    system: ExactSystem, point: Point, rounds: Sequence[Round], inverse: float, digits: int
) -> float | None:
    """Decimal logarithm of the equations' values far along the smooth set that rounds leave.

    None if the set could not be followed.

    Args:
        inverse: of the blocks that were solved for, decimal logarithm.
        digits: to which their zeros are known.
    """
    left = len(point) - sum(len(r.columns) for r in rounds)
    for attempt in range(DIRECTIONS):
        turn = np.exp(1j * (0.3 + np.arange(left) + 2.0 * attempt))
        if len(rounds) == 1 and inverse < GOOD:
            end = _followed(_Block.of(system, rounds[0], turn), doubles(point))
        else:
            end = _followed_in_digits(system, point, rounds, turn)
        if end is None:
            continue
        size = system.largest_degree * max(0.0, log_norm(end))
        more = digits + int(size)
        with working(more):
            found = sharpen(system, end, rounds, more)
            if found is not None:
                return system.log_residual(found[0], more)
    return None


@dataclass(frozen=True, eq=False)
class _Block:
    """Regular equations, their variables, and a direction in the others."""

    evaluator: Evaluator
    columns: np.ndarray
    free: np.ndarray
    direction: np.ndarray

    @classmethod
    def of(cls, system: ExactSystem, this: Round, direction: np.ndarray) -> _Block:
        rows = [system.at(DIGITS)[i] for i in this.rows]
        exponents = list(dict.fromkeys(e for row in rows for e, _ in row)) or [(0,) * system.n]
        place = {e: i for i, e in enumerate(exponents)}
        coefficients = np.zeros((len(rows), len(exponents)), dtype=complex)
        for line, row in zip(coefficients, rows, strict=True):
            for e, c in row:
                line[place[e]] += complex(c)
        free = np.array([i for i in range(system.n) if i not in this.columns], dtype=np.int64)
        columns = np.array(this.columns, dtype=np.int64)
        evaluator = Evaluator(system.n, np.array(exponents, dtype=np.int64), coefficients)
        return cls(evaluator, columns, free, direction)

    def tangent(self, x: np.ndarray) -> np.ndarray:
        slopes = self.evaluator.jacobian(x)
        along = np.zeros(len(x), dtype=complex)
        along[self.free] = self.direction
        right = slopes[:, self.free] @ self.direction
        along[self.columns] = -np.linalg.solve(slopes[:, self.columns], right)
        return along

    def ahead(self, x: np.ndarray, h: float) -> np.ndarray:
        """A step along the set by the classical method of Runge and Kutta."""
        a = self.tangent(x)
        b = self.tangent(x + h / 2 * a)
        c = self.tangent(x + h / 2 * b)
        d = self.tangent(x + h * c)
        return x + h / 6 * (a + 2 * b + 2 * c + d)

    def newton(self, x: np.ndarray) -> np.ndarray:
        step = np.zeros(len(x), dtype=complex)
        block = self.evaluator.jacobian(x)[:, self.columns]
        step[self.columns] = np.linalg.solve(block, self.evaluator.values(x[None])[0])
        return step


def _followed(block: _Block, x: np.ndarray) -> list[flint.acb] | None:
    """The point far along the set, in doubles."""
    gone, h = 0.0, FIRST
    for _ in range(STEPS):
        if gone >= FAR or np.abs(x).max() >= AT_MOST:
            return [flint.acb(complex(c)) for c in x]
        try:
            start = block.ahead(x, h)
            first = block.newton(start)
            second = block.newton(start - first)
        except np.linalg.LinAlgError:
            return None
        moved, one, two = (float(np.abs(v).max()) for v in (start - x, first, second))
        if not (one <= SMALL * moved and two <= max(CONTRACTION * one, ROUNDING * moved)):
            h /= 2
            if h < LEAST * max(gone, FIRST):
                return None
            continue
        x, gone = start - first - second, gone + h
        h *= 2.0 if one < SMALL / 16 * moved else 1.0
    return None


def _followed_in_digits(
    system: ExactSystem, point: Point, rounds: Sequence[Round], direction: np.ndarray
) -> list[flint.acb] | None:
    """The same in all digits, for sets that are not reduced, or begin close to a singular point."""
    with working(DIGITS):
        x, gone, h = list(point), 0.0, FIRST
        turns = [flint.acb(complex(c)) for c in direction]
        for _ in range(STEPS):
            if gone >= FAR or log_norm(x) >= log10(AT_MOST):
                return x
            start = predicted(system, x, rounds, [c * h for c in turns])
            found = None if start is None else sharpen(system, start, rounds)
            if start is not None and found is not None:
                moved = log_norm(a - b for a, b in zip(start, x, strict=True))
                one = log_norm(a - b for a, b in zip(found[0], start, strict=True))
                if one < moved + log10(SMALL_ROUGHLY):
                    x, gone = found[0], gone + h
                    h *= 2.0 if one < moved + log10(SMALL_ROUGHLY / 4) else 1.0
                    continue
            h /= 2
            if h < 10.0 ** -(DIGITS / 3):
                return None
    return None
