"""Singular end points: sharpened by deflation, and told apart into isolated ones and others.

References:
    Leykin, Verschelde & Zhao, Newton's method with deflation for isolated singularities, 2006;
    Hauenstein & Wampler, Isosingular sets and deflation, 2013.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from fractions import Fraction

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.high_precision import vanish
from nag.algebra.local_ring import local_dimension
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial

MOST_DEFLATIONS = 4
MOST_UNKNOWNS = 60
MOST_POLYNOMIALS = 1000
NEWTON_STEPS = 12
# Distances, relative to the point, at which further points of the solution set are looked for.
NEARBY = (0.02, 0.1)
# Values there that count as zero; next to a multiple component more cannot be reached.
NOTHING = 1e-13


class Place(Enum):
    """How a zero lies in the solution set."""

    ISOLATED = "isolated"
    ON_COMPONENT = "on a component of positive dimension"
    UNDECIDED = "undecided"


@dataclass(frozen=True, eq=False)
class SingularEnd:
    """A singular zero: the sharpened point, where it lies, and its multiplicity if isolated."""

    point: np.ndarray
    place: Place
    multiplicity: int
    accuracy: float
    condition: float


def corank_at(singular: np.ndarray, columns: int, accuracy: float) -> int:
    """Corank of a scaled Jacobian, read at the widest gap of its singular values."""
    values = np.zeros(columns)
    values[: min(columns, len(singular))] = singular[:columns]
    floor = max(accuracy, 1e-15)
    # The first entry stands for the size that coefficients of order one give a Jacobian.
    ladder = np.maximum(np.concatenate([[max(values.max(initial=0.0), 0.1)], values]), floor)
    best, corank = 1e2, 0
    for rank in range(columns):
        ratio = ladder[rank] / ladder[rank + 1]
        if ladder[rank + 1] < 1e-3 and ratio > best:
            best, corank = ratio, columns - rank
    return corank


@dataclass(frozen=True, eq=False)
class _Newton:
    z: np.ndarray
    step: float
    condition: float
    regular: bool
    polynomials: tuple[Polynomial, ...] = ()


def _gauss_newton(evaluator: Evaluator, z: np.ndarray) -> _Newton:
    step = np.inf
    for _ in range(NEWTON_STEPS):
        jacobian = evaluator.jacobian(z)
        delta, *_ = np.linalg.lstsq(jacobian, evaluator.values(z[None])[0], rcond=1e-14)
        z = z - delta
        last, step = step, float(np.linalg.norm(delta) / (1 + np.linalg.norm(z)))
        if not np.isfinite(step) or step > 1.0:
            return _Newton(z, np.inf, np.inf, False)
        if step < 1e-15 or (step < 1e-12 and step >= last):
            break
    s = np.linalg.svd(evaluator.jacobian(z), compute_uv=False)
    square = len(s) == len(z)
    residual = float(evaluator.residuals(z[None]).max(initial=0.0))
    # Coefficients of order one give a Jacobian such a size; a much smaller one is all rounding.
    limit = max(1e4 * step, 1e-9) * max(s[0], 0.1)
    regular = square and step < 1e-11 and residual < 1e-12 and s[-1] > limit
    return _Newton(z, step, float(s[0] / max(s[-1], 1e-300)), bool(regular))


def _deflated(
    polynomials: Sequence[Polynomial], n: int, q1: np.ndarray, q2: np.ndarray
) -> list[Polynomial]:
    """The polynomials and ``J (q1 + q2 L) = 0``, exact, in the variables ``(z, L)``."""
    m, k = q1.shape[1], q2.shape[1]
    total = n + m * k
    result = [f.with_variables(total, range(n)) for f in polynomials]
    constant = [[Fraction(v) for v in row] for row in q1.tolist()]
    slopes = [[Fraction(v) for v in row] for row in q2.tolist()]
    none = (0,) * (m * k)
    for f in polynomials:
        gradient = [f.derivative(i) for i in range(n)]
        for column in range(m):
            terms: dict[tuple[int, ...], Number] = {}
            for i, derivative in enumerate(gradient):
                entry = [(none, constant[i][column])]
                for j in range(k):
                    place = column * k + j
                    entry.append(((*none[:place], 1, *none[place + 1 :]), slopes[i][j]))
                for e, c in derivative.terms.items():
                    for unknown, weight in entry:
                        key = e + unknown
                        terms[key] = terms[key] + c * weight if key in terms else c * weight
            value = Polynomial(total, terms)
            if value:
                result.append(value)
    return result


def sharpened(
    polynomials: Sequence[Polynomial], x: np.ndarray, accuracy: float, rng: np.random.Generator
) -> _Newton | None:
    """The zero near ``x`` with the unknowns and polynomials of a deflation that makes it regular.

    None if there is none.
    """
    n = len(x)
    polynomials, z = list(polynomials), x
    grown = 0
    while grown <= MOST_DEFLATIONS and len(polynomials) <= MOST_POLYNOMIALS:
        evaluator = Evaluator.of(polynomials, len(z))
        found = _gauss_newton(evaluator, z)
        moved = np.linalg.norm(found.z[:n] - x) / (1 + np.linalg.norm(x))
        if found.regular and moved < max(1e3 * accuracy, 1e-7):
            return replace(found, polynomials=tuple(polynomials))
        jacobian = evaluator.jacobian(z)
        s = np.linalg.svd(jacobian, compute_uv=False)
        m = corank_at(s, len(z), accuracy)
        if m == 0 or len(z) + m * (len(z) - m) > MOST_UNKNOWNS:
            return None
        # Dyadic numbers, so that the deflated system is exact.
        q = np.rint(64 * np.linalg.qr(rng.normal(size=(len(z), len(z))))[0]) / 64
        q1, q2 = q[:, :m], q[:, m:]
        unknowns, *_ = np.linalg.lstsq(jacobian @ q2, -jacobian @ q1, rcond=None)
        # Deflations that need no new unknowns only add derivatives.
        grown += m < len(z)
        polynomials = list(dict.fromkeys(_deflated(polynomials, len(z), q1, q2)))
        z = np.concatenate([z, unknowns.T.ravel()])
    return None


def has_neighbours(
    evaluator: Evaluator, x: np.ndarray, accuracy: float, rng: np.random.Generator
) -> bool:
    """Whether zeros are found on random hyperplanes that pass near the zero ``x``.

    Gauss-Newton finds them if ``x`` lies on a curve; near an isolated zero of order k the values
    at distance r are of the size of r^k, which is no rounding error for k below 12.
    """
    _, s, vh = np.linalg.svd(evaluator.jacobian(x))
    m = max(1, corank_at(s, len(x), accuracy))
    null = vh[len(x) - m :].conj().T
    size = 1 + np.linalg.norm(x)
    for radius in NEARBY:
        for _ in range(3):
            v = null @ (rng.normal(size=m) + 1j * rng.normal(size=m))
            v /= np.linalg.norm(v)
            if _zero_on(evaluator, x, v, radius * size):
                break
        else:
            return False
    return True


def _zero_on(evaluator: Evaluator, x: np.ndarray, v: np.ndarray, distance: float) -> bool:
    y = x + distance * v
    with np.errstate(all="ignore"):
        for _ in range(40):
            matrix = np.vstack([evaluator.jacobian(y), v.conj()[None]])
            right = np.append(evaluator.values(y[None])[0], v.conj() @ (y - x) - distance)
            delta, *_ = np.linalg.lstsq(matrix, right, rcond=1e-7)
            y = y - delta
            if not np.linalg.norm(y - x) < 10 * distance:
                return False
            if np.linalg.norm(delta) < 1e-15 * (1 + np.linalg.norm(y)):
                break
    residual = float(evaluator.residuals(y[None]).max(initial=0.0))
    return residual < NOTHING and bool(abs(v.conj() @ (y - x) - distance) < 1e-9 * distance)


def analyse(
    polynomials: Sequence[Polynomial], x: np.ndarray, accuracy: float, rng: np.random.Generator
) -> SingularEnd:
    """Sharpen a singular end point and decide whether it is isolated."""
    evaluator = Evaluator.of(polynomials, len(x))
    if has_neighbours(evaluator, x, accuracy, rng):
        return SingularEnd(x, Place.ON_COMPONENT, 0, accuracy, np.inf)
    found = sharpened(polynomials, x, accuracy, rng)
    if found is None:
        return SingularEnd(x, Place.UNDECIDED, 0, accuracy, np.inf)
    point, known = found.z[: len(x)], max(1e3 * found.step, 1e-12)
    dimension = local_dimension(evaluator, point, lambda s, k: corank_at(s, k, known))
    # Zeros that are close together look like a multiple one in doubles.
    if dimension is None or not _exact(polynomials, found):
        return SingularEnd(point, Place.UNDECIDED, 0, found.step, found.condition)
    return SingularEnd(point, Place.ISOLATED, dimension, max(found.step, 1e-16), found.condition)


def _exact(polynomials: Sequence[Polynomial], found: _Newton) -> bool:
    """Whether the polynomials vanish at the exact zero of a square part of their deflation."""
    import scipy.linalg

    jacobian = Evaluator.of(found.polynomials, len(found.z)).jacobian(found.z)
    _, _, pivots = scipy.linalg.qr(jacobian.T, mode="economic", pivoting=True)
    chosen = sorted(int(p) for p in pivots[: len(found.z)])
    square = [found.polynomials[i] for i in chosen]
    slices = np.zeros((0, 1 + len(found.z)))
    return vanish(polynomials, square, slices, jacobian[chosen], found.z) is True
