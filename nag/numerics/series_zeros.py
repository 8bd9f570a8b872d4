"""Zeros of truncated power series at a small scale, in doubles: those of a cluster among them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import flint
import numpy as np

from nag.numerics.deflation import DeflatedPoint
from nag.numerics.descent import Point, Round, descend
from nag.numerics.digits import BITS, DIGITS, log_norm, log_size
from nag.numerics.double_newton import Stop, count_above, find_zeros
from nag.numerics.double_ranks import is_regular
from nag.numerics.exact_system import ExactSystem
from nag.numerics.newton import STEPS, move_point
from nag.numerics.power_series import Series, SeriesRing
from nag.numerics.sharpening import ZERO

# Singular values beside the largest one that Newton's method does not divide by.
RANK = 1e-12
# Steps beside the point that lead nowhere.
ASTRAY = 1e3
# Decides: Newton's last step that has come near to a zero, perhaps a multiple one, of truncated
# series; what there is shows in all digits.
SLOW = 1e-2
# Decides: Values there, beside the point's square.
VANISHING = 1e-6


@dataclass(frozen=True, eq=False)
class ScaledSeries:
    """Series ``s(r u)`` as polynomials in ``u``, each divided by its largest coefficient.

    Series of equations that follow from the others are nothing but rounding, and left out.

    Attributes:
        m: number of variables.
        exponents: int, shape ``(M, m)``.
        rows: complex, shape ``(R, M)``.
    """

    m: int
    exponents: np.ndarray
    rows: np.ndarray

    @classmethod
    def of(cls, ring: SeriesRing, series: Sequence[Series], size: float) -> ScaledSeries:
        """At the scale ``r = 10^size``, which may be far below the range of doubles' squares."""
        keys = sorted({k for s in series for k in s}) or [0]
        place = {k: i for i, k in enumerate(keys)}
        powers = [flint.arb(10) ** (flint.arb(size) * d) for d in range(ring.order + 1)]
        rows = []
        for s in series:
            if log_norm(s.values()) <= ZERO:
                continue
            values = {k: flint.acb(c) * powers[ring.degree(k)] for k, c in s.items()}
            largest = max(v.abs_upper() for v in values.values())
            row = np.zeros(len(keys), dtype=complex)
            for k, v in values.items():
                row[place[k]] = complex(v / largest)
            rows.append(row)
        exponents = np.array([ring.exponents(k) for k in keys], dtype=np.int64)
        table = np.array(rows, dtype=complex).reshape(len(rows), len(keys))
        return cls(ring.m, exponents.reshape(len(keys), ring.m), table)

    def coefficients(self, order: int) -> np.ndarray:
        """In one variable: the coefficients of the row with the largest one of that order."""
        result = np.zeros((len(self.rows), order + 1), dtype=complex)
        for column, (k,) in enumerate(self.exponents.tolist()):
            if k <= order:
                result[:, k] = self.rows[:, column]
        return result[np.abs(result[:, order]).argmax()]

    def _values(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        top = int(self.exponents.max(initial=0))
        powers = np.ones((self.m, top + 1), dtype=complex)
        for k in range(1, top + 1):
            powers[:, k] = powers[:, k - 1] * u
        factors = powers[np.arange(self.m), self.exponents]
        values = self.rows @ factors.prod(axis=1)
        jacobian = np.zeros((len(self.rows), self.m), dtype=complex)
        for i in range(self.m):
            lowered = factors.copy()
            k = self.exponents[:, i]
            lowered[:, i] = k * powers[i, np.maximum(k - 1, 0)]
            jacobian[:, i] = self.rows @ lowered.prod(axis=1)
        return values, jacobian

    def regular(self, u: np.ndarray) -> bool:
        """Whether a zero is a regular one, as far as doubles can tell."""
        _, jacobian = self._values(u)
        return is_regular(jacobian)

    def newton(
        self, u: np.ndarray, plane: np.ndarray | None = None, most: int = STEPS
    ) -> np.ndarray | None:
        """Gauss-Newton from ``u``, on the hyperplane ``plane u = 1`` if there is one.

        It converges slowly to multiple zeros; None where it does not at all.
        """

        def equations(x: np.ndarray, _: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            values, jacobian = self._values(x[0])
            if plane is not None:
                values = np.append(values, plane @ x[0] - 1)
                jacobian = np.vstack([jacobian, plane])
            return values[None], jacobian[None]

        ends = find_zeros(equations, u[None], most, count_above(RANK), Stop(longest=ASTRAY))
        u = ends.x[0]
        values, _ = self._values(u)
        small = VANISHING * max(1.0, float(np.abs(u).max(initial=0.0))) ** 2
        return u if ends.last[0] < SLOW and np.abs(values).max(initial=0.0) < small else None


# Random starts for each zero that a cluster in several variables may have.
STARTS, MOST_STARTS = 12, 400
# Decides: Starts nearer to each other, beside the cluster's size, are followed once; their ends are
# compared in all digits.
ALIKE = 1e-5


def find_zeros_of_cluster(
    system: ExactSystem, found: DeflatedPoint, reach: float, rng: np.random.Generator
) -> Iterator[tuple[Point, float, bool]]:
    """Approximate zeros of a cluster about a point that is no exact zero, and their distance.

    The equations that remain after the regular part is solved are series whose terms of low order
    are small, but not zero: the size of the cluster is where all terms are equally large.

    Yields:
        points, the decimal logarithm of the size of the cluster, and whether the point seems to be
        a regular zero; those that are come first.
    """
    first = Round(found.rounds[0].rows, found.rounds[0].columns)
    order = found.rounds[0].order
    if not found.corank or not order:
        return
    descent = descend(system, DIGITS, found.point, [first], order)
    assert descent is not None
    size = _size(descent.ring, descent.remaining, order)
    if not size < reach + 1:
        return
    scaled = ScaledSeries.of(descent.ring, descent.remaining, size)
    scale = flint.arb(10) ** flint.arb(size)
    zeros = [(scaled.regular(u), u) for u in _zeros(scaled, order, rng)]
    for regular, u in sorted(zeros, key=lambda zero: not zero[0]):
        along = [flint.acb(complex(c)) * scale for c in u]
        step = descend(system, DIGITS, found.point, [first], order, along)
        if step is not None:
            yield move_point(found.point, step.displacement, BITS), size, regular


def _size(ring: SeriesRing, series: Sequence[Series], order: int) -> float:
    norms = [-inf] * (order + 1)
    for s in series:
        for key, c in s.items():
            degree = ring.degree(key)
            if degree <= order:
                norms[degree] = max(norms[degree], log_size(c))
    return max((norms[j] - norms[order]) / (order - j) for j in range(order))


def _zeros(scaled: ScaledSeries, order: int, rng: np.random.Generator) -> Iterator[np.ndarray]:
    if scaled.m == 1:
        for root in np.roots(scaled.coefficients(order)[::-1]):
            yield np.array([root])
        return
    known: list[np.ndarray] = []
    for _ in range(min(STARTS * order**scaled.m, MOST_STARTS)):
        start = rng.normal(size=scaled.m) + 1j * rng.normal(size=scaled.m)
        u = scaled.newton(start)
        if u is None or np.abs(u).max() > 100:
            continue
        if all(np.abs(u - v).max() > ALIKE for v in known):
            known.append(u)
            yield u
