"""A path tracker in plain Python, an oracle for the tests of the kernels.

One path at a time, in doubles: Runge-Kutta predictor, Newton corrector, Cauchy endgame. It has
nothing in common with the kernels but the mathematics: other predictor, other endgame, and no
arithmetic but Python's.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from nag.tracking.homotopy import Homotopy

Vector = list[Any]
Matrix = list[Vector]
# Corrections that are rounding errors.
FLOOR = 1e-14


@dataclass(frozen=True)
class OracleEnd:
    """End of a path: the point, its estimated error, winding number, and number of steps.

    ``winding`` is 0 if the path could not be tracked to its end.
    """

    point: np.ndarray
    error: float
    winding: int
    steps: int


class _Lost(Exception):
    pass


@dataclass
class _Path:
    """One homotopy, and the number of steps taken so far."""

    homotopy: Homotopy
    tolerance: float
    max_steps: int
    steps: int = 0

    def __post_init__(self) -> None:
        rows = self.homotopy.rows
        self.terms = [
            [(part, [(complex(c) / s, e) for e, c in terms.items()]) for part, terms in row]
            for row, s in zip(rows.parts, rows.scales.tolist(), strict=True)
        ]

    def rows(self, x: Vector, t: Any) -> tuple[Vector, Vector, Matrix]:
        """Values, derivatives with respect to t, and Jacobian of all rows but the patches."""
        values, slopes, jacobian = [], [], []
        for row in self.terms:
            value, slope, gradient = 0, 0, [0] * len(x)
            for part, terms in row:
                a, b = self.homotopy.factors[part]
                factor = a + t * b
                for c, exponents in terms:
                    used = [(j, k) for j, k in enumerate(exponents) if k]
                    term = c
                    for j, k in used:
                        term = term * x[j] ** k
                    value += factor * term
                    slope += b * term
                    for j, k in used:
                        lowered = c * k
                        for i, m in used:
                            lowered = lowered * x[i] ** (m - (i == j))
                        gradient[j] += factor * lowered
            values.append(value)
            slopes.append(slope)
            jacobian.append(gradient)
        for a_row, b_row in zip(self.homotopy.A0, self.homotopy.A1, strict=True):
            moving = b_row.tolist()
            row = [a + t * b for a, b in zip(a_row.tolist(), moving, strict=True)]
            values.append(sum(r * v for r, v in zip(row, x, strict=True)))
            slopes.append(sum(r * v for r, v in zip(moving, x, strict=True)))
            jacobian.append(row)
        return values, slopes, jacobian

    def step(self, x: Vector, t: Any, patch: Vector, tangent: bool) -> Vector:
        """Newton correction at ``(x, t)``, or the tangent ``dx / dt``, along the patch."""
        values, slopes, jacobian = self.rows(x, t)
        right = [-v for v in (slopes if tangent else values)]
        for indices in self.homotopy.groups:
            inside = set(indices)
            jacobian.append([patch[j] if j in inside else 0 for j in range(len(x))])
            right.append(0)
        return _solve(jacobian, right)

    def normalized(self, x: Vector) -> Vector:
        x = list(x)
        for indices in self.homotopy.groups:
            size = sum(abs(x[j]) ** 2 for j in indices) ** 0.5
            for j in indices:
                x[j] = x[j] / size
        return x

    def newton(self, x: Vector, t: Any) -> tuple[Vector, float, float]:
        """The corrected point, the first correction and the last one."""
        x = self.normalized(x)
        first = previous = None
        for _ in range(8):
            correction = self.step(x, t, [v.conjugate() for v in x], False)
            size = float(_norm(correction))
            x = self.normalized(_plus(x, correction))
            first = size if first is None else first
            if size <= FLOOR or (previous is not None and size > 0.5 * previous):
                break
            previous = size
        return x, first, size

    def follow(self, x: Vector, t: Any, goal: Any) -> Vector:
        """Track along the straight segment from ``t`` to ``goal``."""
        length = abs(goal - t)
        h, done = 0.1, 0.0
        start = t
        while done < 1:
            if self.steps >= self.max_steps or h * length < 1e-12 * max(float(abs(t)), 1e-30):
                raise _Lost
            self.steps += 1
            h = min(h, 1 - done)
            dt = (goal - start) * h
            patch = [v.conjugate() for v in x]
            after = goal if done + h >= 1 else t + dt
            try:
                k1 = self.step(x, t, patch, True)
                k2 = self.step(_plus(x, k1, dt / 2), t + dt / 2, patch, True)
                k3 = self.step(_plus(x, k2, dt / 2), t + dt / 2, patch, True)
                k4 = self.step(_plus(x, k3, dt), t + dt, patch, True)
                total = [a + 2 * b + 2 * c + d for a, b, c, d in zip(k1, k2, k3, k4, strict=True)]
                new, first, last = self.newton(_plus(x, total, dt / 6), after)
            except ZeroDivisionError:
                h /= 4
                continue
            if not first <= self.tolerance or not last <= 1e-8:
                h /= 2
                continue
            x, t, done = new, after, done + h
            h *= min(2.0, 0.9 * (self.tolerance / max(first, 1e-300)) ** 0.2)
        return x


def _solve(matrix: Matrix, right: Vector) -> Vector:
    """Gaussian elimination with partial pivoting."""
    n = len(matrix)
    rows = [[*row, r] for row, r in zip(matrix, right, strict=True)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            if factor:
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    x: Vector = [0] * n
    for i in range(n - 1, -1, -1):
        total = rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))
        x[i] = total / rows[i][i]
    return x


def _plus(x: Vector, y: Vector, factor: Any = 1) -> Vector:
    return [a + factor * b for a, b in zip(x, y, strict=True)]


def _norm(x: Sequence[Any]) -> Any:
    return sum(abs(v) ** 2 for v in x) ** 0.5


def track_one(
    homotopy: Homotopy,
    start: np.ndarray,
    *,
    tolerance: float = 1e-5,
    max_winding: int = 20,
    max_steps: int = 5000,
) -> OracleEnd:
    """Track one path from t = 1 to t = 0, see `nag.tracking.track.track`."""
    path = _Path(homotopy, tolerance, max_steps)
    x: Vector = start.tolist()
    try:
        x, _, _ = path.newton(x, 1)
        return _cauchy(path, x, 1, max_winding)
    except (_Lost, ZeroDivisionError):
        return _end(path, x, float("inf"), 0)


def _end(path: _Path, x: Vector, error: float, winding: int) -> OracleEnd:
    point = np.array([complex(v) for v in x])
    return OracleEnd(path.homotopy.normalized(point)[0], error, winding, path.steps)


def _cauchy(path: _Path, x: Vector, t: Any, max_winding: int) -> OracleEnd:
    """Cauchy endgame: the mean round a closed loop whose modes of negative order vanish."""
    samples_per_loop = 8
    turn = cmath.pi * 2 / samples_per_loop
    best: tuple[float, Vector, int] | None = None
    for level in range(1, 12):
        radius = 0.1**level
        goal = radius / (1 + radius)
        x = path.follow(x, t, goal)
        t = goal
        patch = [v.conjugate() for v in x]
        samples = [_in_patch(path, x, patch)]
        y, here = x, t
        for k in range(1, samples_per_loop * max_winding + 1):
            s = cmath.rect(radius, k * turn)
            s = s / (1 + s)
            y = path.follow(y, here, s)
            here = s
            sample = _in_patch(path, y, patch)
            spread = max((_norm(_plus(s, samples[0], -1)) for s in samples), default=0)
            closed = _norm(_plus(sample, samples[0], -1)) <= 1e-6 * spread + 100 * FLOOR
            if k % samples_per_loop == 0 and closed:
                break
            samples.append(sample)
        else:
            continue
        mean, ratio, error = _modes(samples)
        error = max(error, FLOOR)
        if ratio < 1e-6 or error < 1e-12:
            if best is not None and error >= best[0]:
                break
            best = (error, mean, len(samples) // samples_per_loop)
            if error < 1e-13:
                break
    if best is None:
        return _end(path, x, float("inf"), 0)
    return _end(path, best[1], best[0], best[2])


def _in_patch(path: _Path, x: Vector, patch: Vector) -> Vector:
    """Coordinates scaled so that each group's patch is 1."""
    result = list(x)
    for indices in path.homotopy.groups:
        scale = sum(patch[j] * x[j] for j in indices)
        for j in indices:
            result[j] = x[j] / scale
    return result


def _modes(samples: list[Vector]) -> tuple[Vector, float, float]:
    """Mean of the samples, modes of negative order over those of positive, and the former."""
    count = len(samples)
    mean = [sum(column) / count for column in zip(*samples, strict=True)]
    rest = np.array([[complex(v - m) for v, m in zip(s, mean, strict=True)] for s in samples])
    modes = np.linalg.norm(np.fft.fft(rest, axis=0) / count, axis=1)
    negative = float(np.linalg.norm(modes[count // 2 + 1 :]))
    positive = float(np.linalg.norm(modes[1 : count // 2 + 1]))
    return mean, negative / positive if positive else 0.0, negative
