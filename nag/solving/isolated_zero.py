"""An isolated zero, in doubles and in as many digits as were worked out, and whether it is real."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import flint
import numpy as np

from nag.numerics.array_table import RecordTable, map_rows
from nag.numerics.coincidence import SAFETY, SortedPoints
from nag.numerics.digits import bits_of, in_bits, number_of_words
from nag.numerics.precise_point import WORKING_DIGITS, PrecisePoint
from nag.numerics.singular_point import SingularEnd
from nag.numerics.zero_values import VANISHES
from nag.solving.start.target import StartSystem
from nag.tracking.paths import Ball

# Relative error of a coordinate in doubles, where a few operations led to it.
ROUNDING = 2.0**-50
# Decides, measured: Imaginary parts, beside a point's size, of zeros in doubles that are real
# unless another zero is their conjugate; beyond that, or their errors in more digits, they are not.
# `nag certify` proves it.
REAL = 1e-10


def affine_point(begin: StartSystem, ball: Ball) -> PrecisePoint:
    """The affine coordinates of an end that a path reached in more digits."""
    shift, x = len(begin.groups), [number_of_words(c) for c in ball.centre]
    values: dict[int, flint.acb] = {}
    errors: dict[int, float] = {}
    with in_bits(bits_of(WORKING_DIGITS)):
        for k, group in enumerate(begin.groups):
            size = float(abs(x[k]).mid())
            for i in group:
                values[i] = (x[shift + i] / x[k]).mid()
                own = float(abs(values[i]).mid())
                errors[i] = (ball.radii[shift + i] + own * ball.radii[k]) / size
    order = sorted(values)
    return PrecisePoint(tuple(values[i] for i in order), np.array([errors[i] for i in order]))


class IsolatedZero(NamedTuple):
    """An isolated solution in the scaled variables; ``fine``: more digits of it, if known."""

    point: np.ndarray
    multiplicity: int
    residual: float
    accuracy: float
    condition: float
    precision: int
    fine: PrecisePoint | None = None

    @property
    def radii(self) -> np.ndarray | None:
        """Errors of the coordinates in doubles, shape ``(n,)``, where each is known."""
        if self.fine is None:
            return None
        return self.fine.radii + ROUNDING * np.abs(self.point)

    @classmethod
    def of_end(cls, end: SingularEnd, residual: float, precision: int) -> IsolatedZero:
        """An end that was judged to be one."""
        numbers = residual, end.accuracy, end.condition, precision
        return cls(end.point, end.multiplicity, *numbers, end.precise)

    def is_apart_from(self, other: IsolatedZero) -> bool:
        """Whether two zeros are two, in the digits that both are known to."""
        if self.fine is None or other.fine is None:
            return False
        error = max(VANISHES, self.fine.error + other.fine.error)
        pairs = zip(self.fine.centre, other.fine.centre, strict=True)
        return any(float(abs(a - b).mid()) > error * (1 + float(abs(a).mid())) for a, b in pairs)


@dataclass(frozen=True, eq=False)
class IsolatedZeros(RecordTable[IsolatedZero]):
    """Isolated solutions in the scaled variables: the fields of `IsolatedZero`, as columns."""

    points: np.ndarray
    multiplicity: np.ndarray
    residual: np.ndarray
    accuracy: np.ndarray
    condition: np.ndarray
    precision: np.ndarray
    fine: Mapping[int, PrecisePoint]

    numbers: ClassVar[Mapping[str, type[np.generic]]] = {
        "multiplicity": np.int64,
        "residual": np.float64,
        "accuracy": np.float64,
        "condition": np.float64,
        "precision": np.int64,
    }

    @classmethod
    def of(cls, zeros: Sequence[IsolatedZero], n: int) -> IsolatedZeros:
        """Zeros one by one, in ``n`` variables."""
        points = np.array([zero.point for zero in zeros], dtype=complex).reshape(-1, n)
        fine = {i: zero.fine for i, zero in enumerate(zeros) if zero.fine is not None}
        return cls(points=points, fine=fine, **cls.collect_numbers(zeros))

    def record(self, i: int) -> IsolatedZero:
        return IsolatedZero._make((self.points[i], *self.numbers_of_row(i), self.fine.get(i)))

    def join(self, zeros: Sequence[IsolatedZero]) -> IsolatedZeros:
        """These, and more after them."""
        if not zeros:
            return self
        return self.concatenate([self, self.of(zeros, self.points.shape[1])])


def which_are_real(
    points: np.ndarray, accuracy: np.ndarray, fine: Mapping[int, PrecisePoint]
) -> np.ndarray:
    """Which zeros of equations with real coefficients are real, shape ``(k,)``.

    Imaginary parts beyond the errors, in the digits that a zero is known to, say that it is not.
    Of a zero in doubles a little beyond its estimated error, another zero that is its conjugate
    says so.

    Args:
        points: all of them, in doubles, shape ``(k, n)``.
        accuracy: their relative errors, shape ``(k,)``.
        fine: more digits of those that are known to more, by index.
    """
    imaginary, errors, nearly = _imaginary_parts(points, accuracy)
    in_doubles = np.ones(len(points), dtype=bool)
    for i, precise in fine.items():
        in_doubles[i] = False
        parts = np.array([float(abs(z.imag).mid()) for z in precise.centre])
        # A small coordinate may be known far better than others.
        over = parts / np.maximum(precise.radii, VANISHES * (1 + np.abs(points[i])))
        imaginary[i], errors[i] = over.max(initial=0.0), SAFETY
    real = imaginary <= errors
    asked = np.flatnonzero(in_doubles & ~real & (imaginary <= nearly)).tolist()
    every = SortedPoints.of(points if asked else points[:0])
    for i in asked:
        x = points[i].conj()
        near = every.near(x, np.sqrt(len(x)) * errors[i])
        apart = np.abs(points[near[near != i]] - x).max(axis=1)
        real[i] = not (apart <= errors[i]).any()
    return real


def are_within_errors(points: np.ndarray, accuracy: np.ndarray) -> np.ndarray:
    """Which zeros in doubles may be real: their imaginary parts are within their errors, ``(k,)``.

    Args:
        points: shape ``(k, n)``; accuracy: relative errors, shape ``(k,)``.
    """
    imaginary, errors, _ = _imaginary_parts(points, accuracy)
    return np.asarray(imaginary <= errors)


def which_members_are_real(points: np.ndarray, accuracy: np.ndarray) -> np.ndarray:
    """Which zeros of many systems are real, as `which_are_real` of each says, shape ``(m, S)``.

    Args:
        points: all zeros of each, in doubles, shape ``(m, S, n)``.
        accuracy: their relative errors, shape ``(m, S)``.
    """
    shape, n = accuracy.shape, points.shape[-1]
    parts = _imaginary_parts(points.reshape(-1, n), accuracy.ravel())
    imaginary, errors, nearly = (part.reshape(shape) for part in parts)
    real = imaginary <= errors
    asked = (~real & (imaginary <= nearly)).any(axis=1)
    for k in np.flatnonzero(asked).tolist():
        real[k] = which_are_real(points[k], accuracy[k], {})
    return np.asarray(real)


def _imaginary_parts(
    points: np.ndarray, accuracy: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The largest of each point, its error, and what it may be of a real zero, each ``(k,)``."""
    sizes = 1 + map_rows(lambda some: np.abs(some).max(axis=1, initial=0.0), points)
    imaginary = map_rows(lambda some: np.abs(some.imag).max(axis=1, initial=0.0), points)
    return imaginary, SAFETY * sizes * accuracy, REAL * sizes
