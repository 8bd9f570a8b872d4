"""Exact random changes of coordinates and of equations, which hide how a system was made.

Those of the second kind keep a sparse system sparse.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
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


def combine_equations(
    equations: Sequence[Polynomial], rng: np.random.Generator
) -> tuple[Polynomial, ...]:
    """Combinations of the equations that generate the same ideal."""
    n = len(equations)
    zero = equations[0] * 0
    return tuple(
        sum((c * f for c, f in zip(row, equations, strict=True) if c), start=zero)
        for row in _unimodular(n, rng)
    )


def hide_equations(equations: Sequence[Polynomial], rng: np.random.Generator) -> PolynomialSystem:
    """The system of the equations, mixed, in other coordinates."""
    n = equations[0].n
    coordinates = Coordinates.random(n, rng)
    moved = [coordinates.of(f) for f in equations]
    return PolynomialSystem(NAMES[:n], combine_equations(moved, rng))


# Sizes of scalings: powers of ten up to this.
DECADES = 4
# Unknowns, and equations, to which a multiple of another one is added.
MIXED = 3
# What `sparsely_changed` does, one of these at a time.
KINDS = ("scaled", "shifted", "variables", "equations")


def change_system(system: PolynomialSystem, rng: np.random.Generator) -> PolynomialSystem:
    """The system in other coordinates, with other equations of the same ideal.

    Every variable is scaled by a power of ten and shifted, multiples of some variables are added
    to others, and multiples of some equations to others of at least their degree.
    """
    n = system.n
    x = Polynomial.variables(n)
    forms = [power(rng, DECADES) * x[i] + _shift(rng) for i in range(n)]
    for i, j in _pairs(n, MIXED, rng):
        forms[i] = forms[i] + small(rng) * forms[j]
    moved = _in_forms(system, forms)
    polynomials = mix_equations(moved.polynomials, MIXED, rng)
    scaled = tuple(power(rng, DECADES) * f for f in polynomials)
    return replace(moved, polynomials=scaled)


def sparsely_changed(
    system: PolynomialSystem, rng: np.random.Generator, kind: str | None = None
) -> PolynomialSystem:
    """The system with its variables and equations in another order, and changed in one way more.

    Args:
        kind: every variable and equation is ``"scaled"`` by 1/10, 1 or 10, one variable is
            ``"shifted"``, multiples of one of the ``"variables"`` or of one of the
            ``"equations"``, of no higher degree, are added to another one; by default one of
            these at random.
    """
    n = system.n
    kind = KINDS[rng.integers(len(KINDS))] if kind is None else kind
    x = Polynomial.variables(n)
    forms = [x[i] for i in rng.permutation(n)]
    if kind == "scaled":
        forms = [power(rng, 1) * v for v in forms]
    if kind == "shifted":
        forms[rng.integers(n)] += _shift(rng)
    if kind == "variables":
        for i, j in _pairs(n, 1, rng):
            forms[i] = forms[i] + small(rng) * forms[j]
    moved = _in_forms(system, forms)
    polynomials = [moved.polynomials[i] for i in rng.permutation(len(moved.polynomials))]
    if kind == "scaled":
        polynomials = [power(rng, 1) * f for f in polynomials]
    if kind == "equations":
        polynomials = mix_equations(polynomials, 1, rng)
    # Forms of several variables do not keep a partition of these.
    return replace(moved, polynomials=tuple(polynomials), groups=())


# Coordinates that lie far from a system's own ones, by so many powers of ten: every variable
# ``"translated"``, a ``"third"`` of them, or ``"one"``; ``"scaled"`` by powers of ten up to that;
# in ``"dense"`` linear forms of that condition.
FAR_COORDINATES = ("translated", "third", "one", "scaled", "dense")


def in_far_coordinates(
    system: PolynomialSystem, kind: str, decades: int, rng: np.random.Generator
) -> PolynomialSystem:
    """The system in coordinates of one of `FAR_COORDINATES`.

    Args:
        decades: how far they lie; for ``"dense"``, the condition of the linear forms.
    """
    n = system.n
    forms = list(Polynomial.variables(n))
    if kind == "scaled":
        forms = [power(rng, decades) * x for x in forms]
    elif kind == "dense":
        weights = [Fraction(10) ** round(decades * i / max(n - 1, 1)) for i in range(n)]
        inner, outer = _unimodular(n, rng), _unimodular(n, rng)
        scaled = [weights[i] * _form(row, forms) for i, row in enumerate(inner)]
        forms = [_form(row, scaled) for row in outer]
    else:
        count = {"translated": n, "third": -(-n // 3), "one": 1}[kind]
        for i in rng.choice(n, count, replace=False).tolist():
            forms[i] = forms[i] - Fraction(int(rng.integers(-(10**6), 10**6)), 10**6) * 10**decades
    groups = () if kind == "dense" else system.groups
    return replace(_in_forms(system, forms), groups=groups)


def _form(row: Sequence[Fraction], forms: Sequence[Polynomial]) -> Polynomial:
    """A combination of linear forms."""
    return sum((c * x for c, x in zip(row, forms, strict=True)), start=forms[0] * 0)


def _in_forms(system: PolynomialSystem, forms: list[Polynomial]) -> PolynomialSystem:
    """The system with affine forms put in for its variables."""
    polynomials = tuple(f.compose(forms) for f in system.polynomials)
    nonzero = tuple(g.compose(forms) for g in system.nonzero)
    return replace(system, polynomials=polynomials, nonzero=nonzero)


def mix_equations(
    equations: Sequence[Polynomial], count: int, rng: np.random.Generator
) -> list[Polynomial]:
    """The equations, multiples of some added to others of at least their degree."""
    found = list(equations)
    for pair in _pairs(len(found), count, rng):
        i, j = sorted(pair, key=lambda k: -found[k].degree)
        found[i] = found[i] + small(rng) * found[j]
    return found


def _shift(rng: np.random.Generator) -> Fraction:
    return Fraction(int(rng.integers(-9, 10)), int(rng.integers(1, 8)))


def power(rng: np.random.Generator, decades: int) -> Fraction:
    return Fraction(10) ** int(rng.integers(-decades, decades + 1))


def small(rng: np.random.Generator) -> Fraction:
    return Fraction(int(rng.choice([-3, -2, -1, 1, 2, 3])), int(rng.integers(1, 4)))


def _pairs(n: int, count: int, rng: np.random.Generator) -> list[tuple[int, int]]:
    """Some pairs of different numbers below ``n``."""
    return [tuple(rng.choice(n, 2, replace=False).tolist()) for _ in range(count if n > 1 else 0)]
