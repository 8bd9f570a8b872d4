"""How far witness points are from the exact ones: error radii, and the digits these rest on.

A point in doubles is compared with the zero of the same equations on the same slice that Newton's
method finds with residuals in double-double, or in balls where these do not do. The distance is
known to the digits of that arithmetic; what Newton's method leaves there comes on top of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from nag.witness.close_points import chosen
from nag.witness.cutting import sharpen
from nag.witness.exact_points import FEWEST, ExactPoints, exact_points, fixed
from nag.witness.fibres import Fibre
from nag.witness.frame import EPS, Frame
from nag.witness.witness import DOUBLE

# Digits that double-double is said to have, and those that are asked of balls.
DOUBLE_DOUBLE, IN_BALLS = 32, 40
# Where double-double leaves more of an error than this, relative to the point, balls do not.
ENOUGH = 1e-18
# Estimated errors in many digits, and last corrections in doubles, count so many times.
ESTIMATE, CORRECTION = 2.0, 1e2


@dataclass(frozen=True, eq=False)
class Sharp:
    """A fibre's points to rounding, and what is known of them.

    Attributes:
        fibre: the points.
        radii: errors of the coordinates, without added unknowns, shape ``(P, n)``; inf where
            Newton's method did not converge.
        digits: of the arithmetic that they rest on, shape ``(P,)``.
    """

    fibre: Fibre
    radii: np.ndarray
    digits: np.ndarray

    @property
    def errors(self) -> np.ndarray:
        """Errors of the points, relative to one and their sizes, shape ``(P,)``."""
        sizes = 1 + np.linalg.norm(self.fibre.x, axis=1)
        return np.linalg.norm(self.radii, axis=1) / sizes

    def only(self, places: np.ndarray) -> Sharp:
        """Some of the points."""
        fine = chosen(self.fibre.fine, places)
        points = self.fibre.points[places]
        fibre = Fibre(self.fibre.cut, self.fibre.dimension, points, fine)
        return Sharp(fibre, self.radii[places], self.digits[places])


def sharpened(fibre: Fibre, rows: np.ndarray, known: ExactPoints | None = None) -> Sharp:
    """The regular points of a fibre on the slice ``rows``, to rounding.

    Args:
        known: the points in as many digits as `nag.witness.points.Points.exact` has.
    """
    exact = _exact(fibre, rows, known)
    good = np.isfinite(exact.radii)
    points = np.array(fibre.points)
    steps = np.full(len(points), np.inf)
    for i, z in enumerate(points):
        if good[i] and i in fibre.fine:
            points[i] = fibre.fine[i].rounded
            points[i, : fibre.cut.n] = _rounded(exact, i)
        elif good[i] and not fibre.cut.aux:
            points[i] = _rounded(exact, i)
        else:
            ends = sharpen(fibre.cut.evaluator, rows, z)
            points[i], steps[i] = ends.z, ends.step if ends.converged else np.inf
    fibre = replace(fibre, points=points)
    radii, digits = _radii(fibre, exact)
    rough = CORRECTION * np.maximum(steps, EPS) * (1 + np.linalg.norm(points, axis=1))
    radii[~good] = rough[~good, None]
    return Sharp(fibre, radii, digits)


def in_order(points: np.ndarray) -> np.ndarray:
    """Places of points, shape ``(P, n)``, in an order that does not depend on their own."""
    if not points.shape[1]:
        return np.arange(len(points))
    return np.lexsort((points.imag[:, 0], points.real[:, 0]))


def error_radii(fibre: Fibre, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Error radii and digits of regular points on the slice ``rows``, as they are.

    Returns:
        Radii, shape ``(P, n)``, inf where Newton's method does not converge, and digits, shape
        ``(P,)``.
    """
    exact = _exact(fibre, rows)
    radii, digits = _radii(fibre, exact)
    radii[~np.isfinite(exact.radii)] = np.inf
    return radii, digits


def _exact(fibre: Fibre, rows: np.ndarray, known: ExactPoints | None = None) -> ExactPoints:
    """The points in digits that leave hardly an error beside rounding, where that is to be had."""
    found = exact_points(fibre, rows, FEWEST) if known is None else known
    poor = found.radii > ENOUGH * (1 + np.abs(fibre.x).max(axis=1, initial=0.0))
    poor &= ~found.balls
    if not poor.any():
        return found
    better = exact_points(fibre.only(poor), rows, IN_BALLS)
    use = np.isfinite(better.radii)
    values, radii, balls = found.values.copy(), found.radii.copy(), found.balls.copy()
    places = np.flatnonzero(poor)[use]
    values[places] = better.values[use] >> (better.bits - found.bits)
    radii[places] = better.radii[use] + 2.0 ** (1 - found.bits)
    balls[places] = True
    return ExactPoints(values, found.bits, radii, balls)


def _radii(fibre: Fibre, exact: ExactPoints) -> tuple[np.ndarray, np.ndarray]:
    """Distances from points that are known to more digits, and how many these are."""
    off = (exact.values - fixed(fibre.x, exact.bits)).astype(float)
    n = fibre.cut.n
    distances = np.ldexp(np.hypot(off[:, :n], off[:, n:]), -exact.bits)
    radii = (1 + 4 * EPS) * distances + ESTIMATE * exact.radii[:, None]
    balls = np.where(exact.balls, IN_BALLS, DOUBLE_DOUBLE)
    return radii, np.where(np.isfinite(exact.radii), balls, DOUBLE)


def _rounded(exact: ExactPoints, i: int) -> np.ndarray:
    """The doubles nearest to a point's coordinates."""
    unit = 1 << exact.bits
    parts = np.array([value / unit for value in exact.values[i]], dtype=float)
    n = len(parts) // 2
    return parts[:n] + 1j * parts[n:]


def framed(frame: Frame, y: np.ndarray, radii: np.ndarray) -> np.ndarray:
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
