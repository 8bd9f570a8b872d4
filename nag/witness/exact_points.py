"""Zeros of a cut on a slice in as many digits as are asked for, and how far points are from them.

Zeros are integers of a small unit: sums of them are exact, so that what cancels is known to the
error of the points alone.

A point in doubles is compared with the zero of the same equations on the same slice that Newton's
method finds with residuals in double-double, or in balls where these do not do. The distance, its
error radius, is known to the digits of that arithmetic; what Newton's method leaves there comes on
top of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.coincidence import LEAST
from nag.numerics.digits import LOG10_2
from nag.numerics.doubles import EPS
from nag.numerics.precise_point import PrecisePoint
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import WRITTEN, choose_alike, possible_zeros, select_isolated
from nag.tracking.newton import Refined, refine
from nag.witness.confirm import zero_in_digits
from nag.witness.cutting import sharpen
from nag.witness.fibres import Fibre, homogeneous
from nag.witness.frame import Frame
from nag.witness.slices import pad_rows
from nag.witness.witness import DOUBLE, WitnessSet, relative_errors

# Digits that points are known to at least, where their condition allows it.
FEWEST = 28
# Digits for which Newton's method with residuals in double-double may be enough.
DOUBLE_DOUBLE = 30
# Error of a step that is solved in doubles, in roundings times the condition.
STEP = 16.0
# Error of residuals in double-double: a bound.
RESIDUAL = 1e-31
# Newton's last step in doubles; after a larger one points are found in balls.
ARRIVED = 1e-6
# Splits a double into halves of 26 digits: 2^27 + 1.
SPLITTER = 134217729.0
# Bits beyond the digits that are asked for.
GUARD = 40


@dataclass(frozen=True, eq=False)
class ExactPoints:
    """Points ``values / 2 ** bits`` with errors.

    Attributes:
        values: Python integers, real parts and then imaginary parts, shape ``(P, 2 n)``.
        bits: the unit is ``2 ** -bits``.
        radii: estimated errors of the coordinates, the largest of each point; inf where Newton's
            method did not converge, shape ``(P,)``.
        balls: which points were found in balls, not in double-double, shape ``(P,)``.
    """

    values: np.ndarray
    bits: int
    radii: np.ndarray
    balls: np.ndarray

    def only(self, indices: Sequence[int] | slice) -> ExactPoints:
        """Some of the points."""
        return ExactPoints(
            self.values[indices], self.bits, self.radii[indices], self.balls[indices]
        )


def join_points(parts: Sequence[ExactPoints]) -> ExactPoints:
    """Points of the same unit, one part after the other."""
    values, radii, balls = (
        np.concatenate([getattr(part, name) for part in parts])
        for name in ("values", "radii", "balls")
    )
    return ExactPoints(values, parts[0].bits, radii, balls)


def of_balls(points: Sequence[Sequence[Any]]) -> ExactPoints:
    """Points from balls (FLINT's ``acb``) that hold their coordinates, in the fewest digits."""
    bits = unit_of(FEWEST)
    values = np.array([_to_integers(point, bits) for point in points], dtype=object)
    radii = [max((float(z.rad()) for z in point), default=0.0) for point in points]
    return ExactPoints(
        values, bits, np.array(radii) + 2.0 ** (1 - bits), np.ones(len(points), dtype=bool)
    )


def unit_of(digits: int) -> int:
    """The unit's exponent for numbers of so many digits behind the point."""
    return int(np.ceil(digits / LOG10_2)) + GUARD


def exact_points(fibre: Fibre, digits: int) -> ExactPoints:
    """The coordinates, without added unknowns, of the regular points of a fibre.

    Args:
        digits: behind the decimal point of coordinates of size one. Those of double-double are as
            many as the condition of the point leaves; ``radii`` tells.
    """
    n, bits = fibre.cut.n, unit_of(digits)
    values = np.zeros((len(fibre), 2 * n), dtype=object)
    radii = np.full(len(fibre), np.inf)
    if digits <= DOUBLE_DOUBLE:
        values, radii = _twice(fibre, bits)
    radii[list(fibre.fine)] = np.inf
    balls = ~np.isfinite(radii)
    for i in np.flatnonzero(balls).tolist():
        found = zero_in_digits(fibre, i, digits, spare=1)
        if found is not None:
            values[i] = _to_integers(found.centre[:n], bits)
            radii[i] = float(found.radii.max(initial=0.0)) + 2.0**-bits
    return ExactPoints(values, bits, radii, balls)


@np.errstate(over="ignore", invalid="ignore")
def _twice(fibre: Fibre, bits: int) -> tuple[np.ndarray, np.ndarray]:
    """By one step more than the points in doubles show."""
    n = fibre.cut.n
    start = homogeneous(fibre.points)
    a = pad_rows(fibre.rows, start.shape[1])
    found = refine(fibre.cut.rows, a, start, iterations=1, twice=True)
    v, step = found.points, found.further
    quotient = v[:, 1 : n + 1] / v[:, :1]
    # What the quotient leaves: v - q v0 without rounding, and the step's part of it.
    rest = _remainder(v[:, 1 : n + 1], quotient, v[:, :1]) + (
        step[:, 1 : n + 1] - quotient * step[:, :1]
    )
    rest = rest / v[:, :1]
    values = fixed_point_numbers(quotient, bits) + fixed_point_numbers(rest, bits)
    sizes = 1 + np.abs(quotient).max(axis=1, initial=0.0)
    return values, _errors(found) * sizes / np.abs(v[:, 0])


def _errors(found: Refined) -> np.ndarray:
    """Errors of points of norm one with their further steps."""
    eps = np.finfo(float).eps
    length = np.linalg.norm(found.further, axis=1)
    error = found.condition * (STEP * eps * length + RESIDUAL)
    return np.where(np.isfinite(error) & (found.error < ARRIVED), error, np.inf)


def _remainder(a: np.ndarray, q: np.ndarray, b: np.ndarray) -> np.ndarray:
    """``a - q b`` for complex doubles, almost without rounding where ``q`` is ``a / b`` rounded."""
    b = np.broadcast_to(b, q.shape)
    real = [(q.real, b.real), (-q.imag, b.imag)]
    imag = [(q.real, b.imag), (q.imag, b.real)]
    parts = []
    for total, pairs in ((a.real, real), (a.imag, imag)):
        low = 0.0
        for x, y in pairs:
            product, error = _exact_product(x, y)
            difference = total - product
            other = difference - total
            low = low + ((total - (difference - other)) - (product + other)) - error
            total = difference
        parts.append(total + low)
    return parts[0] + 1j * parts[1]


def _exact_product(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """``x y`` rounded and the rounding error, by Veltkamp's and Dekker's splitting."""
    product = x * y
    a, b = x * SPLITTER, y * SPLITTER
    x1, y1 = a - (a - x), b - (b - y)
    x2, y2 = x - x1, y - y1
    return product, ((x1 * y1 - product) + x1 * y2 + x2 * y1) + x2 * y2


def fixed_point_numbers(z: np.ndarray, bits: int) -> np.ndarray:
    """Complex doubles as integers of the unit ``2 ** -bits``, real and then imaginary parts."""
    parts = np.concatenate([z.real, z.imag], axis=1)
    result = np.zeros(parts.shape, dtype=object)
    ratios = map(float.as_integer_ratio, np.where(np.isfinite(parts), parts, 0.0).ravel().tolist())
    # Denominators are powers of two.
    result.flat = [(whole << bits) >> (unit.bit_length() - 1) for whole, unit in ratios]
    return result


def _to_integers(point: Sequence[flint.acb], bits: int) -> np.ndarray:
    """Coordinates as integers of the unit ``2 ** -bits``, real and then imaginary parts."""
    parts = [x.real for x in point] + [x.imag for x in point]
    ratios = [(int(m), int(e) + bits) for m, e in (x.mid().man_exp() for x in parts)]
    return np.array([m << e if e > 0 else m >> -e for m, e in ratios], dtype=object)


# Digits that double-double is said to have, and those that are asked of balls.
IN_DOUBLE_DOUBLE, IN_BALLS = 32, 40
# Where double-double leaves more of an error than this, relative to the point, balls do not.
ENOUGH = 1e-18
# Estimated errors in many digits, and last corrections in doubles, count so many times.
ESTIMATE, CORRECTION = 2.0, 1e2


@dataclass(frozen=True, eq=False)
class SharpPoints:
    """Points of a set on a slice to rounding, and what is known of them.

    Attributes:
        fibres: the points, with what cuts them.
        radii: errors of the coordinates, without added unknowns, shape ``(P, n)``; inf where
            Newton's method did not converge.
        digits: of the arithmetic that they rest on, shape ``(P,)``.
    """

    fibres: tuple[Fibre, ...]
    radii: np.ndarray
    digits: np.ndarray

    def __len__(self) -> int:
        return len(self.digits)

    @cached_property
    def x(self) -> np.ndarray:
        """The points without added unknowns, shape ``(P, n)``."""
        return np.vstack([fibre.x for fibre in self.fibres])

    @property
    def accuracy(self) -> float:
        """Largest relative error, infinite where Newton's method did not converge."""
        return float(relative_errors(self.x, self.radii).max(initial=EPS))

    def only(self, places: np.ndarray) -> SharpPoints:
        """Some of the points, those of each fibre together, in this order within one."""
        parts = list(self._by_fibre(places))
        order = np.concatenate([places[:0], *(first + own for _, first, own in parts)])
        fibres = tuple(fibre.only(own) for fibre, _, own in parts)
        return SharpPoints(fibres, self.radii[order], self.digits[order])

    def order(self, places: np.ndarray) -> np.ndarray:
        """Places of points, fibre by fibre in an order that does not depend on their own."""
        parts = self._by_fibre(places)
        ordered = [first + own[_order_points(fibre.points[own])] for fibre, first, own in parts]
        return np.concatenate([places[:0], *ordered])

    def _by_fibre(self, places: np.ndarray) -> Iterator[tuple[Fibre, int, np.ndarray]]:
        """Fibres with points at some places: the place of the first one, and those within it."""
        first = 0
        for fibre in self.fibres:
            within = places - first
            own = within[(within >= 0) & (within < len(fibre))]
            if len(own):
                yield fibre, first, own
            first += len(fibre)


def sharpen_points(fibres: Sequence[Fibre], known: ExactPoints | None = None) -> SharpPoints:
    """The regular points of fibres on one slice, to rounding.

    Args:
        known: the points in as many digits as `nag.witness.points.Points.exact` has.
    """
    parts, first = [], 0
    for fibre in fibres:
        own = None if known is None else known.only(slice(first, first + len(fibre)))
        parts.append(_sharpen(fibre, own))
        first += len(fibre)
    sharp, radii, digits = zip(*parts, strict=True)
    return SharpPoints(sharp, np.vstack(radii), np.concatenate(digits))


def _sharpen(fibre: Fibre, known: ExactPoints | None) -> tuple[Fibre, np.ndarray, np.ndarray]:
    """The points of one fibre, the errors of their coordinates, and digits."""
    exact = _exact(fibre, known)
    good = np.isfinite(exact.radii)
    points = np.array(fibre.points)
    steps = np.full(len(points), np.inf)
    for i, z in enumerate(points):
        if good[i] and i in fibre.fine:
            points[i] = fibre.fine[i].rounded
            points[i, : fibre.cut.n] = _round_point(exact, i)
        elif good[i] and not fibre.cut.aux:
            points[i] = _round_point(exact, i)
        else:
            ends = sharpen(fibre.cut.evaluator, fibre.rows, z)
            points[i], steps[i] = ends.z, ends.step if ends.converged else np.inf
            if good[i]:
                points[i, : fibre.cut.n] = _round_point(exact, i)
    fibre = replace(fibre, points=points)
    radii, digits = _radii(fibre, exact)
    rough = CORRECTION * np.maximum(steps, EPS) * (1 + np.linalg.norm(points, axis=1))
    radii[~good] = rough[~good, None]
    return fibre, radii, digits


def exact_zeros(
    equations: Sequence[Polynomial], component: WitnessSet, index: int = 0
) -> tuple[SingularEnd, ...]:
    """The zeros on a component's slice that a witness point may stand for, to 100 digits.

    Args:
        equations: those in whose scheme the component has its multiplicity.
        index: of the witness point.
    """
    x, radii, rows = component.points[index], component.radii[index], component.slice.rows
    known = _close_in_digits(component, index)
    if known is not None:
        zeros = possible_zeros(equations, known.centre, WRITTEN, np.random.default_rng(0), rows)
        return select_isolated(zeros)
    isolated = not component.fibres and not component.dimension
    each_known, simple = isolated and bool(np.ptp(radii) > 0), component.multiplicity == 1
    accuracy: float | np.ndarray = component.accuracy
    if each_known and simple:
        accuracy = radii
    elif component.fibres or not (each_known or simple):
        # Of what was sharpened by a deflation no more is known.
        accuracy = max(component.accuracy, LEAST)
    zeros = select_isolated(possible_zeros(equations, x, accuracy, np.random.default_rng(0), rows))
    if isolated:
        # Paths end at a zero as many times as its multiplicity says: no other is meant.
        zeros = tuple(z for z in zeros if z.multiplicity == component.multiplicity)
    return choose_alike(zeros, x) if len(zeros) > 1 else zeros


def _close_in_digits(component: WitnessSet, index: int) -> PrecisePoint | None:
    """A witness point that is close to others, to 100 digits; None of one that is not known so."""
    for fibre in component.fibres:
        if index < len(fibre):
            found = zero_in_digits(fibre, index) if index in fibre.fine else None
            return None if found is None else found.first(fibre.cut.n)
        index -= len(fibre)
    return None


def _order_points(points: np.ndarray) -> np.ndarray:
    """Places of points, shape ``(P, n)``, in an order that does not depend on their own."""
    if not points.shape[1]:
        return np.arange(len(points))
    return np.lexsort((points.imag[:, 0], points.real[:, 0]))


def _exact(fibre: Fibre, known: ExactPoints | None = None) -> ExactPoints:
    """The points in digits that leave hardly an error beside rounding, where that is to be had."""
    found = exact_points(fibre, FEWEST) if known is None else known
    poor = found.radii > ENOUGH * (1 + np.abs(fibre.x).max(axis=1, initial=0.0))
    poor &= ~found.balls
    if not poor.any():
        return found
    better = exact_points(fibre.only(poor), IN_BALLS)
    use = np.isfinite(better.radii)
    values, radii, balls = found.values.copy(), found.radii.copy(), found.balls.copy()
    places = np.flatnonzero(poor)[use]
    values[places] = better.values[use] >> (better.bits - found.bits)
    radii[places] = better.radii[use] + 2.0 ** (1 - found.bits)
    balls[places] = True
    return ExactPoints(values, found.bits, radii, balls)


def _radii(fibre: Fibre, exact: ExactPoints) -> tuple[np.ndarray, np.ndarray]:
    """Distances from points that are known to more digits, and how many these are."""
    # Whole numbers of the unit may leave the range of doubles.
    off = ((exact.values - fixed_point_numbers(fibre.x, exact.bits)) / (1 << exact.bits)).astype(
        float
    )
    n = fibre.cut.n
    distances = np.hypot(off[:, :n], off[:, n:])
    radii = (1 + 4 * EPS) * distances + ESTIMATE * exact.radii[:, None]
    balls = np.where(exact.balls, IN_BALLS, IN_DOUBLE_DOUBLE)
    return radii, np.where(np.isfinite(exact.radii), balls, DOUBLE)


def _round_point(exact: ExactPoints, i: int) -> np.ndarray:
    """The doubles nearest to a point's coordinates."""
    unit = 1 << exact.bits
    parts = np.array([value / unit for value in exact.values[i]], dtype=float)
    n = len(parts) // 2
    return parts[:n] + 1j * parts[n:]


def carry_radii(frame: Frame, y: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Radii of the points that a frame makes of ``y``: those of ``y``, and what rounding adds."""
    terms = 4 + np.count_nonzero(frame.T, axis=1)
    rounding = EPS * (np.abs(y) @ np.abs(frame.T).T + np.abs(frame.t))
    exact = (np.count_nonzero(frame.T, axis=1) == 1) & (frame.t == 0) & _powers(frame.T)
    rounding[:, exact] = 0.0
    known = np.where(np.isfinite(radii), radii, 0.0) @ np.abs(frame.T).T + rounding * terms
    known[~np.isfinite(radii).all(axis=1)] = np.inf
    return known


def _powers(T: np.ndarray) -> np.ndarray:
    """Rows whose largest entry is a power of two, which rounds nothing."""
    return np.frexp(np.abs(T).max(axis=1, initial=0.0))[0] == 0.5
