"""Random linear slices, as rows that act on homogeneous coordinates ``(x0, x)``."""

from __future__ import annotations

import numpy as np

from nag.witness.witness import Slice

# Terms of a slice at points, over those of one that these move to, below which the latter is
# scaled: else paths begin nearer to 1 than their parameter is told from it.
UNEVEN = 1e-5


def unit_complex(rng: np.random.Generator, size: int | tuple[int, ...] = ()) -> np.ndarray:
    """Random complex numbers of absolute value one."""
    return np.exp(2j * np.pi * rng.random(size))


def complex_normal(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Complex standard normal numbers."""
    return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)


def random_rows(
    rng: np.random.Generator, codimension: int, n: int, offset: float = 1.0
) -> np.ndarray:
    """A generic slice of the given codimension: rows ``(-b, A)``, the rows of A orthonormal.

    The numbers b are complex standard normal times ``offset``.

    Any number of leading rows is again a generic slice, so ``random_rows(rng, n, n)`` is a flag
    of slices for all dimensions.
    """
    if codimension == 0:
        return np.zeros((0, 1 + n), dtype=complex)
    q, _ = np.linalg.qr(complex_normal(rng, (n, n)))
    b = complex_normal(rng, (codimension, 1))
    return np.hstack([-offset * b, q[:codimension]])


def rows_through(
    rng: np.random.Generator, codimension: int, point: np.ndarray, sizes: np.ndarray | float = 1.0
) -> np.ndarray:
    """A slice through an affine point, generic where coordinates are divided by ``sizes``.

    Args:
        sizes: of the homogeneous coordinates, shape ``(1 + n,)``.
    """
    rows = random_rows(rng, codimension, len(point)) / sizes
    rows[:, 0] = -rows[:, 1:] @ point
    return rows


def even_rows(rows: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """The same slice by rows of norm about one where coordinates are divided by ``sizes``.

    Further coordinates are of size one.

    Of two rows of very unequal norms one would decide until the very end of a path. Powers of two
    leave the slice as it is, so that points that are close to others are still on it.
    """
    further = np.ones(rows.shape[1] - len(sizes))
    scaled = rows * np.concatenate([sizes, further])
    # Squares of huge numbers leave the range of doubles.
    largest = np.abs(scaled).max(axis=1, keepdims=True)
    norms = np.linalg.norm(scaled / largest, axis=1, keepdims=True)
    return rows / 2.0 ** np.rint(np.log2(largest) + np.log2(norms))


def balance_rows(source: np.ndarray, target: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The target slice by rows that do not outweigh those of the source at points of it.

    A slice that cuts a set in a far smaller or a far larger part than another is 0 to rounding
    beside it at points there: a path from one to the other would be over before it begins, as a
    parameter tells nothing nearer to 1 than it is rounded, and all there is to tell near to 0.

    Args:
        points: affine, shape ``(P, n)``; of all that are to move as one.
    """
    sizes = np.abs(points[:, None, : source.shape[1] - 1])
    largest = [
        np.maximum(np.abs(rows[:, 0]), (np.abs(rows[:, 1:]) * sizes).max(axis=2, initial=0.0))
        for rows in (source, target)
    ]
    ratios = (largest[0] / largest[1]).min(axis=0, initial=1.0)
    # A point may be where all terms of its own slice vanish.
    uneven = (ratios < UNEVEN) & (ratios > 0.0)
    powers = np.rint(np.log2(np.where(uneven, ratios, 1.0)))
    return 2.0 ** powers[:, None] * target


def to_slice(rows: np.ndarray) -> Slice:
    """The slice ``A x = b`` that rows on homogeneous coordinates stand for."""
    return Slice(rows[:, 1:], -rows[:, 0])


def pad_rows(rows: np.ndarray, columns: int) -> np.ndarray:
    """Rows with zero columns appended until there are ``columns``."""
    if rows.shape[1] == columns:
        return rows
    return np.hstack([rows, np.zeros((len(rows), columns - rows.shape[1]))])
