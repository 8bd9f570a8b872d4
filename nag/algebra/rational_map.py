"""Rational maps of the unknowns of a family, and the finite groups that they generate.

Roberts' cognates, three four-bars with one coupler curve, are images of each other under such maps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.errors import EquationError, NagError

# Larger groups are taken for infinite ones.
MOST_ELEMENTS = 720


class MapError(EquationError):
    """Maps that cannot be used; the message is one line."""


@dataclass(frozen=True)
class RationalMap:
    """A map of ``n`` unknowns that may depend on parameters.

    Attributes:
        numerators, denominators: one for each unknown, polynomials in the unknowns followed by the
            parameters.
    """

    numerators: tuple[Polynomial, ...]
    denominators: tuple[Polynomial, ...]

    def __post_init__(self) -> None:
        if not self.numerators or len(self.numerators) != len(self.denominators):
            raise NagError("a map needs a numerator and a denominator for each unknown")
        if len({f.n for f in (*self.numerators, *self.denominators)}) != 1:
            raise NagError("numerators and denominators are in the same variables")

    @property
    def n(self) -> int:
        """Number of unknowns."""
        return len(self.numerators)

    def exact(self, point: Sequence[Fraction], values: Sequence[Fraction]) -> tuple[Any, ...]:
        """The image of a rational point, exact.

        Raises:
            ZeroDivisionError: if a denominator vanishes there.
        """
        z = (*point, *values)
        return tuple(f(z) / g(z) for f, g in zip(self.numerators, self.denominators, strict=True))

    def __call__(self, points: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Images of points, shape ``(P, n)``, for parameters of shape ``(k,)``.

        They are not finite where a denominator vanishes.
        """
        z = [*np.asarray(points, dtype=np.complex128).T, *np.asarray(values, np.complex128)]
        result = np.empty((len(points), self.n), dtype=np.complex128)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            for i, (f, g) in enumerate(zip(self.numerators, self.denominators, strict=True)):
                result[:, i] = f(z, complex) / np.broadcast_to(g(z, complex), len(points))
        return result


@dataclass(frozen=True)
class MapGroup:
    """A finite group of rational maps.

    Attributes:
        generators: maps that generate it.
        words: for each element the generators that are applied one after the other; the first word
            is empty, and each of the others is an earlier one with one more generator.
    """

    generators: tuple[RationalMap, ...]
    words: tuple[tuple[int, ...], ...]

    def __len__(self) -> int:
        return len(self.words)

    @classmethod
    def generated(cls, generators: Sequence[RationalMap], seed: int = 0) -> MapGroup:
        """The group that maps generate.

        Elements are told apart by the exact images of a random rational point, for random rational
        parameters.

        Raises:
            MapError: if it has more than `MOST_ELEMENTS` elements.
        """
        generators = tuple(generators)
        if not generators:
            return cls((), ((),))
        rng = np.random.default_rng(seed)
        n, total = generators[0].n, generators[0].numerators[0].n
        if any((g.n, g.numerators[0].n) != (n, total) for g in generators):
            raise NagError("the maps are of different unknowns or parameters")
        z = [Fraction(int(a), int(b)) for a, b in rng.integers(1, 1 << 20, (total, 2))]
        values = z[n:]
        words: list[tuple[int, ...]] = [()]
        images = [tuple(z[:n])]
        seen = set(images)
        for word, point in zip(words, images, strict=False):
            for i, generator in enumerate(generators):
                try:
                    image = generator.exact(point, values)
                except ZeroDivisionError:
                    raise MapError("a denominator vanishes everywhere") from None
                if image in seen:
                    continue
                if len(words) == MOST_ELEMENTS:
                    raise MapError(f"the maps generate more than {MOST_ELEMENTS} maps")
                seen.add(image)
                words.append((*word, i))
                images.append(image)
        return cls(generators, tuple(words))

    def images(self, points: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Images under all elements, shape ``(len(self), P, n)``, the points themselves first."""
        found = {(): np.asarray(points, dtype=np.complex128)}
        for word in self.words[1:]:
            found[word] = self.generators[word[-1]](found[word[:-1]], values)
        return np.stack([found[word] for word in self.words])
