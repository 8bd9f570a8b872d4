"""So many steps of Newton's method in 32 or 64 digits, whatever they bring."""

from __future__ import annotations

from typing import NamedTuple

import flint
import numpy as np

from nag.machine_code.kernel import Kernel
from nag.machine_code.lanes import splat, store
from nag.machine_code.records import Reals
from nag.numerics.digits import bits_of, in_bits, number_of_words
from nag.tracking.ends import records
from nag.tracking.ends.corrector import linearize, weigh
from nag.tracking.ends.log_series import lay_patches
from nag.tracking.ends.records import Room
from nag.tracking.evaluation import factors_at
from nag.tracking.homotopy import Homotopy
from nag.tracking.kernel_arrays import KernelEquations
from nag.tracking.numbers.complex_numbers import ARITHMETICS, ComplexNumbers

# Digits in which quotients of coordinates lose nothing.
AFFINE_DIGITS = 200


class Steps(NamedTuple):
    """Points in homogeneous coordinates, shape (count, N, 2, words), which are moved."""

    count: int
    steps: int
    points: Reals


def newton_batch(z: ComplexNumbers, s: KernelEquations, r: Room, b: Steps) -> None:
    """Newton's method at t = 0, eight points at a time."""
    size = 2 * z.number.words * s.N
    for j in range(s.N):
        store(r.least, j, splat(0.0))
        store(r.floors, j, splat(0.0))
    for first in range(0, b.count, 8):
        for lane in range(8):
            path = min(first + lane, b.count - 1)
            for k in range(z.number.words):
                r.t[8 * k + lane] = 0.0
            for k in range(size):
                r.slots[8 * k + lane] = b.points[size * path + k]
        lay_patches(z, s, r)
        factors_at(z, s, r)
        for _ in range(b.steps):
            weigh(z, s, r)
            linearize(z, s, r, splat(0.0), splat(0.0))
            for j in range(s.N):
                z.write(r.slots, j, z.add(z.read(r.slots, j), z.read(r.right, j)))
        for lane in range(min(8, b.count - first)):
            for k in range(size):
                b.points[size * (first + lane) + k] = r.slots[8 * k + lane]


KERNELS = {words: Kernel(newton_batch, ARITHMETICS[words]) for words in (2, 4)}


def newton_steps(homotopy: Homotopy, points: np.ndarray, words: int, steps: int) -> np.ndarray:
    """Points after so many steps at t = 0.

    Args:
        points: homogeneous, shape ``(P, N)``.
        words: doubles in a number, 2 or 4.

    Returns:
        Real and imaginary parts as sums of doubles, shape ``(P, N, 2, words)``.
    """
    result = np.zeros((*points.shape, 2, words))
    result[..., 0, 0], result[..., 1, 0] = points.real, points.imag
    if len(points):
        batch = Steps(count=len(points), steps=steps, points=result.reshape(-1))
        system = records.equations(homotopy, words, 1)
        KERNELS[words](system, records.room(homotopy, words, 1), batch)
    return result


def affine_points(points: np.ndarray) -> list[list[flint.acb]]:
    """Coordinates beside the first one, of points as `newton_steps` returns them."""
    found = []
    for point in points:
        first, *others = map(number_of_words, point)
        with in_bits(bits_of(AFFINE_DIGITS)):
            found.append([z / first for z in others])
    return found
