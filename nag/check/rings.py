"""Rings in the Euler parameters of several bodies, in degree order, and small matrices over any."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

from nag.algebra.groebner import Ideal, ideal
from nag.algebra.rational_function import FunctionField, Order, RationalFunction
from nag.mechanism.axes import dot
from nag.mechanism.quaternion import norm_squared

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


def euler_ring(
    letters: str, order: Order = "degrevlex"
) -> tuple[FunctionField, list[tuple[Any, ...]]]:
    """Variables x0 to x3 for each letter x: the ring, and a quaternion for each letter."""
    field = FunctionField([f"{x}{i}" for x in letters for i in range(4)], order)
    v = field.variables
    return field, [tuple(v[4 * i : 4 * i + 4]) for i in range(len(letters))]


def unit(*quaternions: Sequence[Any]) -> list[Any]:
    """|a|^2 - 1 for each."""
    return [norm_squared(a) - 1 for a in quaternions]


def contains(big: Ideal, functions: Sequence[Any]) -> bool:
    """Whether the numerators of all functions lie in the ideal."""
    return big.contains([f.numerator for f in functions])


def radical_contains(big: Ideal, f: Any, power: int = 8) -> bool:
    """Whether f^power lies in the ideal, so that f vanishes on its zeros."""
    return contains(big, [f**power])


def intersect_in(big: Ideal, parts: Sequence[Ideal]) -> bool:
    """Whether ``big`` is the intersection of ideals without common zeros.

    Two by two without common zeros, their intersection is their product.
    """
    for i, part in enumerate(parts):
        if not part.contains(big.generators) or any(not (part + p).whole for p in parts[:i]):
            return False
    products = parts[0].generators
    for part in parts[1:-1]:
        products = ideal(big.field, [f * g for f in products for g in part.generators]).basis
    return big.contains([f * g for f in products for g in parts[-1].generators])


def derivatives(field: FunctionField, f: Any, names: Sequence[str] = ()) -> list[Any]:
    """Partial derivatives of a polynomial, by all variables or those of the given names."""
    one = field(1).numerator
    return [RationalFunction(field, f.numerator.derivative(x), one) for x in names or field.names]


def smooth(field: FunctionField, generators: Sequence[Any], codimension: int) -> bool:
    """Whether the Jacobian has that rank at all common zeros (T25 theorem 2.2)."""
    jacobian = [derivatives(field, f) for f in generators]
    return ideal(field, [*generators, *minors(jacobian, codimension)]).whole
