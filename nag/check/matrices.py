"""Small matrices with entries in any commutative ring."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from nag.mechanism.axes import dot

Matrix = Sequence[Sequence[Any]]


def product(a: Matrix, b: Matrix) -> tuple[tuple[Any, ...], ...]:
    """The product ab."""
    return tuple(tuple(dot(row, column) for column in zip(*b, strict=True)) for row in a)


def transpose(a: Matrix) -> tuple[tuple[Any, ...], ...]:
    """Rows and columns exchanged."""
    return tuple(zip(*a, strict=True))


def apply(a: Matrix, v: Sequence[Any]) -> tuple[Any, ...]:
    """The product av."""
    return tuple(dot(row, v) for row in a)


def scalar(x: Any, size: int) -> tuple[tuple[Any, ...], ...]:
    """x times the unit matrix."""
    return tuple(tuple(x if i == j else 0 * x for j in range(size)) for i in range(size))


def determinant(a: Matrix) -> Any:
    """By expansion along the first row."""
    if len(a) == 1:
        return a[0][0]
    total = 0 * a[0][0]
    for j, x in enumerate(a[0]):
        minor = [[*row[:j], *row[j + 1 :]] for row in a[1:]]
        total = total + (x if j % 2 == 0 else -x) * determinant(minor)
    return total


def minors(a: Matrix, size: int) -> Iterator[Any]:
    """All minors of that size: generators of the Fitting ideal of T25 theorem 2.2."""
    for rows in combinations(range(len(a)), size):
        for columns in combinations(range(len(a[0])), size):
            yield determinant([[a[i][j] for j in columns] for i in rows])
