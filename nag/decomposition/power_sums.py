"""Power sums of points over whole components, as linear equations for sets of points.

When a slice moves parallel to itself, by u, the sum over a component's points of the k-th power of
a linear form is a polynomial of degree k in u. (For k = 1 it is the trace.) So the coefficients of
higher powers of u, in the series of the points, sum to zero over each component: linear equations
for the indicators of components, as many as are asked for, at the points as they are. No path is
tracked for them. If nothing but indicators of disjoint sets solves them, no part of these can be a
component (Rupprecht 2004; Chèze & Lecerf 2007 take more powers of u, not of the form).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

import numpy as np

from nag.algebra.evaluation import series_products
from nag.numerics.double_newton import newton_steps
from nag.numerics.doubles import EPS
from nag.witness.cutting import Cut
from nag.witness.points import Points
from nag.witness.slices import complex_normal, pad_rows

# Powers of u, and of forms, up to which equations are taken; and equations for each unknown.
FEWEST_POWERS, MOST_POWERS, MOST_DEGREE, EQUATIONS = 4, 12, 4, 1.5
# Decides: Singular values of equations that are no errors, in units of these: 1e6 to 1e13 in
# systems measured, 800 far from the origin; errors themselves gave 0.01 to 13.
CERTAIN = 100.0
# Decides: How far from 0 and 1 indicators may be.
UNCLEAR = 0.1
# Least error of a column over that of the worst one, as indicators are read in units of errors.
EVEN = 1e-4
# Points that are looked at together.
BLOCK = 300


@dataclass(frozen=True, eq=False)
class PowerSums:
    """Equations for indicators of components.

    Attributes:
        coefficients: real, shape ``(equations, P)``.
        errors: of the columns, in the Euclidean norm, shape ``(P,)``.
    """

    coefficients: np.ndarray
    errors: np.ndarray

    @classmethod
    def of(cls, points: Points, unknowns: int, rng: np.random.Generator) -> PowerSums:
        """Equations for so many unknowns, found twice, with errors by what differs.

        Errors are infinite where points are too close to each other for doubles.
        """
        inside = points.n - points.dimension
        powers = _powers(unknowns, inside)
        if points.fine or powers is None:
            return cls(np.zeros((1, len(points))), np.full(len(points), np.inf))
        forms = _random_forms(unknowns, inside, powers, rng)
        with np.errstate(all="ignore"):
            first, second = (
                _equations(points, series, forms) for series in _two_series(points, powers, rng)
            )
            sizes = np.linalg.norm(first, axis=1, keepdims=True)
            sizes[sizes == 0] = 1.0
            first, second = first / sizes, second / sizes
            errors = np.linalg.norm(first - second, axis=0) + EPS
        return cls(first, errors)

    def smallest_unions(self, classes: Sequence[np.ndarray]) -> list[list[int]] | None:
        """Unions of classes of points that satisfy the equations and contain no smaller such union.

        Returns:
            Disjoint lists of positions in ``classes``; None if it is not clear which these are.
        """
        columns = np.stack([self.coefficients[:, own].sum(axis=1) for own in classes], axis=1)
        errors = np.array([self.errors[own].sum() for own in classes])
        errors = np.maximum(errors, EVEN * errors.max())
        if not (np.isfinite(columns).all() and np.isfinite(errors).all()):
            return None
        # Fewer rows, with the same singular values.
        square = np.linalg.qr(columns / errors, mode="r")
        _, sizes, rows = np.linalg.svd(square)
        sizes = np.append(sizes, np.zeros(len(classes) - len(sizes)))
        # The errors of all columns together, in their own units, have at most this norm.
        kernel = rows[sizes <= CERTAIN * np.sqrt(len(classes))]
        return _indicators(kernel, errors)


def _indicators(kernel: np.ndarray, units: np.ndarray) -> list[list[int]] | None:
    """Disjoint sets whose indicators, in some units, span a space; None if there are none such.

    Vectors of the space at places of one set are parallel, at those of different ones orthogonal.

    Args:
        kernel: an orthonormal basis, shape ``(r, K)``.
    """
    found: list[list[int]] = []
    left = np.linalg.norm(kernel, axis=0)
    for _ in range(len(kernel)):
        first = int(left.argmax())
        values = (kernel[:, first] @ kernel) / units
        values /= values[first]
        inside = np.abs(values - 1) < UNCLEAR
        if not (inside | (np.abs(values) < UNCLEAR)).all() or not left[inside].all():
            return None
        left[inside] = 0.0
        found.append(np.flatnonzero(inside).tolist())
    return sorted(found)


def _powers(unknowns: int, inside: int) -> int | None:
    """Powers of u that give enough equations in a slice of this dimension; None if too many."""
    for powers in range(FEWEST_POWERS, MOST_POWERS + 1):
        if 2 * sum(_numbers(powers, inside)) >= EQUATIONS * unknowns:
            return powers
    return None


def _numbers(powers: int, inside: int) -> list[int]:
    """How many equations there are from forms to the power 1, 2, .."""
    degrees = range(1, min(MOST_DEGREE, powers - 1) + 1)
    return [(powers - k) * comb(inside + k - 1, k) for k in degrees]


def _random_forms(
    unknowns: int, inside: int, powers: int, rng: np.random.Generator
) -> list[np.ndarray]:
    """Linear forms whose powers 1, 2, .. give enough equations, each array ``(forms, inside)``."""
    result, wanted = [], EQUATIONS * unknowns / 2
    for k, number in enumerate(_numbers(powers, inside), start=1):
        count = min(number, max(1, int(np.ceil(wanted)))) // (powers - k) + 1
        count = min(count, number // (powers - k))
        result.append(complex_normal(rng, (count, inside)))
        wanted -= count * (powers - k)
        if wanted <= 0:
            break
    return result


def _equations(points: Points, series: np.ndarray, forms: Sequence[np.ndarray]) -> np.ndarray:
    """Coefficients of sums of powers of forms that vanish for components; real, one column a point.

    Args:
        series: shape ``(P, n, 1 + powers)``.
    """
    _, _, basis = np.linalg.svd(points.rows[:, 1:])
    inside = basis[points.dimension :].conj() @ series
    inside[:, :, 0] -= inside[:, :, 0].mean(axis=0)
    inside /= np.abs(inside[:, :, 0]).max() or 1.0
    blocks = []
    for first in range(0, len(inside), BLOCK):
        parts = []
        for k, own in enumerate(forms, start=1):
            values = own @ inside[first : first + BLOCK]
            power = values
            for _ in range(k - 1):
                power = series_products(power, values)
            parts.append(power[:, :, k + 1 :].reshape(len(power), -1).T)
        blocks.append(np.concatenate(parts))
    rows = np.concatenate(blocks, axis=1)
    return np.concatenate([rows.real, rows.imag])


def _two_series(points: Points, powers: int, rng: np.random.Generator) -> list[np.ndarray]:
    """The points as power series in u, shape ``(P, n, 1 + powers)``.

    Two times, at points that differ by rounding.
    """
    result = []
    for _ in range(2):
        series = np.zeros((len(points), points.n, 1 + powers), dtype=complex)
        for first in range(0, len(points), BLOCK):
            among = range(first, min(first + BLOCK, len(points)))
            for fibre, own in points.fibres(among):
                found = _series(fibre.cut, points.rows, fibre.points, powers, rng)
                series[own] = found[:, : points.n]
        result.append(series)
    return result


def _series(
    cut: Cut, rows: np.ndarray, z: np.ndarray, powers: int, rng: np.random.Generator
) -> np.ndarray:
    """Zeros of a cut on the slice ``rows(x) + u e = 0``, e the last one, as series in u.

    Args:
        z: zeros for u = 0 but for errors, shape ``(P, m)``; what Newton's method makes of them is
            rounded at random.

    Returns:
        Coefficients, shape ``(P, m, 1 + powers)``.
    """
    count, m = z.shape
    slopes = pad_rows(rows, 1 + m)[:, 1:]
    evaluator, derivatives = cut.evaluator, cut.evaluator.placed_derivatives(m)

    def jacobians(z: np.ndarray) -> np.ndarray:
        fixed = np.broadcast_to(slopes, (count, *slopes.shape))
        return np.concatenate([derivatives(z), fixed], axis=1)

    values = np.concatenate([evaluator.values(z), rows[:, 0] + z @ slopes.T], axis=1)
    z = z - newton_steps(values, jacobians(z))
    z = z * (1 + EPS * complex_normal(rng, z.shape))
    inverse = np.linalg.inv(jacobians(z))
    result = np.zeros((count, m, 1 + powers), dtype=complex)
    result[:, :, 0], result[:, :, 1] = z, -inverse[:, :, -1]
    # A coefficient makes up for that of the polynomials' values on what is known of the series.
    for k in range(2, powers + 1):
        left = evaluator.last_coefficients(result[:, :, : k + 1])
        result[:, :, k] = -(inverse[:, :, : left.shape[1]] @ left[:, :, None])[:, :, 0]
    return result
