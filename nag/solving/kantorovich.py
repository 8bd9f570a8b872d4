"""Regular zeros of a family's systems, confirmed by the theorem of Newton and Kantorovich.

Lengths are measured in each coordinate relative to its own size, so that a zero with coordinates of
very different sizes is as good as any other; if that fails, as it does where a coordinate vanishes,
relative to the largest one. Let beta bound the Newton step at a point, and K the
inverse Jacobian times the second derivatives within `RADIUS`. If ``2 beta K <= 1`` there is exactly
one zero within 1 / K, if that is no more than `RADIUS`, and it lies within 2 beta. Bounds are
computed in doubles, with an allowance for the rounding of the residuals and of the inverse; where
that is too much, residuals are evaluated in more digits.

Reference: Ortega & Rheinboldt, Iterative Solution of Nonlinear Equations, 1970, 12.6.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator, PlacedDerivatives
from nag.algebra.family import Family
from nag.numerics.array_table import ArrayTable
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of, doubles
from nag.numerics.double_newton import Stop, find_zeros
from nag.numerics.doubles import EPS, SHARPEST
from nag.numerics.krawczyk import invert_matrices

# Newton steps in doubles at most, and with residuals in `DIGITS` digits.
STEPS, FINE_STEPS, DIGITS = 8, 4, 50
# Points at once; and how many are worth more digits, some 10 ms each.
BLOCK, MOST_FINE = 256, 200
# Steps that lead nowhere, and such as promise convergence.
LONGEST, PROMISING = 0.1, 1e-3
# Of the ball, beside the coordinates, in which second derivatives are bounded.
RADIUS = 1e-2
# Size of a coordinate that is zero.
TINY = 1e-30


@dataclass(frozen=True, eq=False)
class Confirmed(ArrayTable):
    """Points after Newton's method, shape ``(P, n)``, and what is known of them, shape ``(P,)``.

    Attributes:
        regular: whether there is exactly one zero within `isolation`; it is regular.
        sizes: of the coordinates, in which distances are measured, shape ``(P, n)``.
        accuracy: the zero's distance at most, in the coordinate where it is largest.
        isolation: radius of the ball with one zero.
        condition: of the Jacobian, rows and columns scaled.
        precision: decimal digits of the residuals.
    """

    points: np.ndarray
    regular: np.ndarray
    sizes: np.ndarray
    accuracy: np.ndarray
    isolation: np.ndarray
    condition: np.ndarray
    precision: np.ndarray

    @property
    def radii(self) -> np.ndarray:
        """Bounds of the zeros' distances in each coordinate, shape ``(P, n)``."""
        return self.accuracy[:, None] * self.sizes

    def same(self, others: np.ndarray) -> np.ndarray:
        """Whether the zeros near other points, shape ``(P, n)``, are those of these points."""
        apart = np.abs(others - self.points) / self.sizes
        return self.regular & (apart.max(axis=1) + self.accuracy <= self.isolation)


@dataclass(frozen=True, eq=False)
class Confirmation:
    """Newton's method for the systems of a family with rational coefficients."""

    family: Family

    @cached_property
    def _evaluator(self) -> Evaluator:
        return Evaluator.of(self.family.polynomials, self.family.polynomials[0].n)

    @cached_property
    def _derivatives(self) -> PlacedDerivatives:
        return self._evaluator.placed_derivatives(self.family.n)

    def __call__(self, points: np.ndarray, values: np.ndarray, threads: int = 1) -> Confirmed:
        """Newton's method from ``points``, shape ``(P, n)``, for parameters of shape ``(k,)``."""
        blocks = [points[k : k + BLOCK] for k in range(0, len(points), BLOCK)] or [points[:0]]
        if len(blocks) > 1 and threads > 1:
            self._confirm_block(points[:1], values)  # What is cached is made once.
            with ThreadPoolExecutor(threads) as pool:
                done = list(pool.map(lambda block: self._confirm_block(block, values), blocks))
        else:
            done = [self._confirm_block(block, values) for block in blocks]
        result = Confirmed.concatenate([each for each, _ in done])
        promising = np.flatnonzero(np.concatenate([p for _, p in done]))[:MOST_FINE]
        again = [(i, self._confirm_in_digits(result.points[i], values)) for i in promising.tolist()]
        better = [(i, fine) for i, fine in again if fine is not None and fine.regular[0]]
        if not better:
            return result
        places = np.array([i for i, _ in better])
        return result.replace_rows(places, Confirmed.concatenate([fine for _, fine in better]))

    def _append_parameters(self, points: np.ndarray, values: np.ndarray) -> np.ndarray:
        return np.hstack([points, np.broadcast_to(values, (len(points), len(values)))])

    def _scale_jacobian(
        self, points: np.ndarray, values: np.ndarray, sizes: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The Jacobian with columns scaled by the sizes, and then rows; the rows' factors."""
        matrix = self._derivatives(self._append_parameters(points, values)) * sizes[:, None, :]
        with np.errstate(divide="ignore"):
            factor = 1 / np.abs(matrix).max(axis=2)
        return matrix * factor[:, :, None], factor

    def _confirm_block(
        self, points: np.ndarray, values: np.ndarray
    ) -> tuple[Confirmed, np.ndarray]:
        """The result in doubles, and which of the others Newton's method converges at."""
        with np.errstate(all="ignore"):
            finite = np.isfinite(points).all(axis=1)
            points = np.where(finite[:, None], points, 1.0)

            def equations(here: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
                matrix, factor = self._scale_jacobian(here, values, _sizes(here))
                found = self._evaluator.values(self._append_parameters(here, values))
                return found * factor, matrix

            # A small coordinate may be wrong altogether where others are large.
            stop = Stop(arrived=SHARPEST, longest=LONGEST)
            ends = find_zeros(equations, points, STEPS, stop=stop, units=_sizes)
            points = ends.x
            judged = self._bound_distances(points, values, finite, _sizes(points), None)
            left = np.flatnonzero(finite & ~judged.regular)
            if len(left):
                largest = np.abs(points[left]).max(axis=1, keepdims=True)
                sizes = np.repeat(np.where(largest > 0, largest, 1.0), points.shape[1], axis=1)
                again = self._bound_distances(points[left], values, finite[left], sizes, None)
                judged = judged.replace_rows(left[again.regular], again.select_rows(again.regular))
            return judged, finite & ~judged.regular & (ends.last < PROMISING)

    def _bound_distances(
        self,
        points: np.ndarray,
        values: np.ndarray,
        finite: np.ndarray,
        lengths: np.ndarray,
        exact: np.ndarray | None,
    ) -> Confirmed:
        """Kantorovich's bounds at points; ``exact`` are residuals without rounding errors."""
        n = self.family.n
        matrix, factor = self._scale_jacobian(points, values, lengths)
        inverse = invert_matrices(matrix)
        z = self._append_parameters(points, values)
        # Derivatives in directions of these lengths are at most those where coordinates have them.
        reach = np.maximum(np.abs(points), lengths) + RADIUS * lengths
        sizes, second = self._evaluator.term_sizes(self._append_parameters(reach, values), n)
        residual = self._evaluator.values(z) if exact is None else exact
        # Rounding of the residual, and of its product with the inverse.
        noise = 8 * EPS * sizes if exact is None else n * EPS * np.abs(residual)
        size = np.abs(inverse)
        step = (inverse @ (residual * factor)[:, :, None])[:, :, 0]
        beta = (np.abs(step) + (size @ (noise * factor)[:, :, None])[:, :, 0]).max(axis=1)
        K = (size @ (second * factor)[:, :, None])[:, :, 0].max(axis=1)
        # The inverse in doubles is one up to this factor (Neumann's series).
        rounding = n * EPS * (size @ np.abs(matrix))
        defect = (np.abs(inverse @ matrix - np.eye(n)) + rounding).sum(axis=2).max(axis=1)
        beta, K = beta / (1 - defect), K / (1 - defect)
        condition = np.linalg.norm(inverse, axis=(1, 2)) * np.linalg.norm(matrix, axis=(1, 2))
        finite = finite & np.isfinite(condition)
        regular = finite & (defect < 1) & (2 * beta * K <= 1) & (2 * beta <= RADIUS)
        return Confirmed(
            points,
            regular,
            lengths,
            np.where(regular, np.maximum(2 * beta, EPS), np.inf),
            np.where(regular, np.minimum(1 / K, RADIUS), 0.0),
            np.where(finite, condition, np.inf),
            np.full(len(points), 16 if exact is None else DIGITS),
        )

    def _confirm_in_digits(self, point: np.ndarray, values: np.ndarray) -> Confirmed | None:
        """The same for one point, with residuals in more digits."""

        def equations(here: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            matrix, factor = self._scale_jacobian(here, values, _sizes(here))
            return self._find_residuals(here, values) * factor, matrix

        with np.errstate(all="ignore"):
            stop = Stop(arrived=4 * EPS, longest=LONGEST)
            ends = find_zeros(equations, point[None], FINE_STEPS, stop=stop, units=_sizes)
            if not np.isfinite(ends.last[0]):
                return None
            point = ends.x
            exact = self._find_residuals(point, values)
            return self._bound_distances(point, values, np.ones(1, bool), _sizes(point), exact)

    def _find_residuals(self, point: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Values of the equations in more digits, scaled as the evaluator's, shape ``(1, n)``."""
        z = [flint.acb(complex(x)) for x in (*point[0], *values)]
        found = BallPolynomials.of(self.family.polynomials).values(z, bits_of(DIGITS))
        sizes = [float(max(abs(c) for c in f.terms.values())) for f in self.family.polynomials]
        return doubles(found.mid().entries())[None] / np.array(sizes)


def _sizes(points: np.ndarray) -> np.ndarray:
    """Sizes of the coordinates, none of them zero."""
    return np.maximum(np.abs(points), TINY)
