"""Exact random changes of coordinates and of equations, which hide how a system was made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

NAMES = ("x", "y", "z", "w")


def _unimodular(n: int, rng: np.random.Generator) -> list[list[Fraction]]:
    """An integer matrix of determinant 1: triangular ones without zeros, multiplied."""
    lower = np.tril(rng.choice([-1, 1], (n, n)), -1) + np.eye(n, dtype=int)
    upper = np.triu(rng.choice([-2, -1, 1, 2], (n, n)), 1) + np.eye(n, dtype=int)
    return [[Fraction(int(v)) for v in row] for row in lower @ upper]


@dataclass(frozen=True)
class Coordinates:
    """Affine forms to be put in for the variables; their inverse is as simple."""

    forms: tuple[Polynomial, ...]

    @classmethod
    def random(cls, n: int, rng: np.random.Generator, shift: bool = True) -> Coordinates:
        """Integer forms of determinant 1 and, if wanted, a rational shift."""
        x = Polynomial.variables(n)
        forms = []
        for row in _unimodular(n, rng):
            constant = Fraction(int(rng.integers(-9, 10)), 7) if shift else Fraction(0)
            forms.append(
                sum((c * v for c, v in zip(row, x, strict=True)), start=x[0] * 0) + constant
            )
        return cls(tuple(forms))

    def of(self, f: Polynomial) -> Polynomial:
        return f.compose(self.forms)


def mixed(equations: Sequence[Polynomial], rng: np.random.Generator) -> tuple[Polynomial, ...]:
    """Combinations of the equations that generate the same ideal."""
    n = len(equations)
    zero = equations[0] * 0
    return tuple(
        sum((c * f for c, f in zip(row, equations, strict=True) if c), start=zero)
        for row in _unimodular(n, rng)
    )


def hidden(equations: Sequence[Polynomial], rng: np.random.Generator) -> PolynomialSystem:
    """The system of the equations, mixed, in other coordinates."""
    n = equations[0].n
    coordinates = Coordinates.random(n, rng)
    moved = [coordinates.of(f) for f in equations]
    return PolynomialSystem(NAMES[:n], mixed(moved, rng))
