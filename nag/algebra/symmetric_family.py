"""Families of systems with a finite group of symmetries, and plane vectors as complex numbers.

A vector ``(x1, x2)`` of the plane has the isotropic coordinates ``x = x1 + i x2`` and
``x^ = x1 - i x2``, conjugate where the vector is real and independent otherwise. Rotations, and
with them the equations of planar linkages, are simplest in these, and over the complex numbers the
two may be of very different sizes, which Cartesian coordinates would hide.

Reference: Wampler, Isotropic coordinates, circularity, and Bezout numbers, 1996.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.family import Family
from nag.algebra.number import ComplexNumber, Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_map import MapError, MapGroup

NO_SYMMETRY = MapGroup((), ((),))


@dataclass(frozen=True)
class SymmetricFamily:
    """A family, the symmetries of its solutions, and the coordinates that paths are tracked in.

    Attributes:
        original: the family.
        group: maps that carry solutions to solutions for the same parameters; with ``plane`` they
            are maps of the complex numbers ``x``, with the ``x`` of the parameters, and hold for
            the ``x^`` as well.
        plane: pairs of indices, of unknowns and then of parameters: the coordinates of vectors.
            Either empty or all of them.
    """

    original: Family
    group: MapGroup = field(default=NO_SYMMETRY)
    plane: tuple[tuple[int, int], ...] = ()

    def __post_init__(self) -> None:
        total = self.original.n + len(self.original.parameters)
        if self.plane and sorted(i for pair in self.plane for i in pair) != list(range(total)):
            raise MapError("every unknown and every parameter must be in one pair of coordinates")
        n = self.original.n
        if any((i < n) != (j < n) for i, j in self.plane):
            raise MapError("an unknown and a parameter cannot be the coordinates of one vector")

    def __len__(self) -> int:
        return len(self.group)

    @cached_property
    def _unknowns(self) -> list[tuple[int, int]]:
        return [pair for pair in self.plane if pair[0] < self.original.n]

    @cached_property
    def _parameters(self) -> list[tuple[int, int]]:
        n = self.original.n
        return [(i - n, j - n) for i, j in self.plane if i >= n]

    @cached_property
    def family(self) -> Family:
        """The family in the coordinates of the paths: all ``x``, then all ``x^``.

        Raises:
            MapError: if its coefficients are not rational there: the equations are not those of
                mirror images for mirror images of the parameters.
        """
        if not self.plane:
            return self.original
        n, total = self.original.n, self.original.n + len(self.original.parameters)
        *X, unit = Polynomial.variables(total + 1)
        images = [Polynomial.constant(total + 1, 0)] * total
        names = [*self.original.variables, *self.original.parameters]
        new = [""] * total
        for first, pairs in ((0, self._unknowns), (n, self._parameters)):
            for k, (i, j) in enumerate(pairs):
                a, b = first + k, first + k + len(pairs)
                images[first + i] = (X[a] + X[b]) * Fraction(1, 2)
                images[first + j] = (X[b] - X[a]) * unit * Fraction(1, 2)
                new[a] = f"{names[first + i]}_{names[first + j]}"
                new[b] = f"{new[a]}_conjugate"
        polynomials = [_rational(f.compose(images)) for f in self.original.polynomials]
        return Family(tuple(new[:n]), tuple(new[n:]), tuple(polynomials))

    def inner(self, points: np.ndarray) -> np.ndarray:
        """Solutions, shape ``(P, n)``, in the coordinates of the paths."""
        return _isotropic(np.asarray(points, dtype=np.complex128), self._unknowns)

    def inner_values(self, values: Sequence[complex] | np.ndarray) -> np.ndarray:
        """Parameters, shape ``(k,)``, in the coordinates of the paths."""
        return _isotropic(np.array([[complex(v) for v in values]]), self._parameters)[0]

    def outer(self, points: np.ndarray) -> np.ndarray:
        """Solutions in the family's own coordinates."""
        return _cartesian(points, self._unknowns)

    def outer_values(self, values: np.ndarray) -> np.ndarray:
        """Parameters in the family's own coordinates."""
        return _cartesian(values[None], self._parameters)[0]

    def images(self, points: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Classes of solutions in the coordinates of the paths, shape ``(len(self), P, n)``."""
        if not self.plane:
            return self.group.images(points, values)
        m, k = len(self._unknowns), len(self._parameters)
        halves = ((points[:, :m], values[:k]), (points[:, m:], values[k:]))
        return np.concatenate([self.group.images(x, d) for x, d in halves], axis=2)


def _rational(f: Polynomial) -> Polynomial:
    """``f`` with its last variable replaced by the imaginary unit, divided by that if need be."""
    parts: list[dict[tuple[int, ...], Fraction]] = [{}, {}]
    for e, c in f.terms.items():
        part = parts[e[-1] % 2]
        part[e[:-1]] = part.get(e[:-1], Fraction(0)) + (-c if e[-1] % 4 > 1 else c)
    real, imaginary = (Polynomial(f.n - 1, part) for part in parts)
    if real and imaginary:
        raise MapError("an equation is not one of mirror images; leave out the pairs")
    return real or imaginary


def _isotropic(points: np.ndarray, pairs: Sequence[tuple[int, int]]) -> np.ndarray:
    if not pairs:
        return points
    first, second = (points[:, [pair[k] for pair in pairs]] for k in (0, 1))
    return np.hstack([first + 1j * second, first - 1j * second])


def _cartesian(points: np.ndarray, pairs: Sequence[tuple[int, int]]) -> np.ndarray:
    if not pairs:
        return points
    m = len(pairs)
    result = np.empty_like(points)
    result[:, [i for i, _ in pairs]] = (points[:, :m] + points[:, m:]) / 2
    result[:, [j for _, j in pairs]] = (points[:, :m] - points[:, m:]) / 2j
    return result


@dataclass(frozen=True)
class FamilyMember:
    """One system of a family.

    Attributes:
        symmetric: the family and its symmetries.
        values: its parameters in the system.
        solutions: number of isolated solutions for general parameters, if it is known.
    """

    symmetric: SymmetricFamily
    values: tuple[Number | ComplexNumber, ...]
    solutions: int | None
