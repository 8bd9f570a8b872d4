"""Zeros of systems that come down to polynomials in one variable, isolated by FLINT.

Every zero is exact: its coordinates are polynomials in a root of an irreducible polynomial, and a
root is one of the certified balls that FLINT's complex root isolation gives.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.bivariate import zero_families
from nag.algebra.elimination import linear_variables
from nag.algebra.exact_ranks import are_independent_over
from nag.algebra.factoring import Ring, ring
from nag.algebra.flint_numbers import to_rational
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

# Eliminated systems of higher degree, or of more terms, are left to other methods.
MOST_DEGREE = 300
MOST_TERMS = 5000
# Bits in which coordinates are computed, doubled until they are known to those of a double.
LEAST_BITS, MOST_BITS = 64, 1 << 14
DOUBLE_BITS = 54
# Those of zeros whose local rings are looked at.
BITS = 400
# Those in which gradients are looked at before exact algebra is.
BALL_BITS = 256


@dataclass(frozen=True, eq=False)
class AlgebraicZero:
    """A zero whose coordinates are polynomials in one algebraic number.

    Attributes:
        minimal: irreducible polynomial of that number, a FLINT ``fmpq_poly``.
        root: a ball that holds this one of its roots and no other.
        coordinates: one for each variable, ``fmpq_poly`` of lower degree than ``minimal``.
        multiplicity: dimension of the local ring of the system there.
        isolated: balls of all roots by the bits they were computed with, shared by conjugates.
        known: values of polynomials, and which gradients are independent, in exact algebra; they
            are the same for all conjugates and shared by them.
    """

    minimal: Any
    root: Any
    coordinates: tuple[Any, ...]
    multiplicity: int
    isolated: dict[int, list[Any]] = field(default_factory=dict)
    known: dict[Any, Any] = field(default_factory=dict)

    @cached_property
    def point(self) -> np.ndarray:
        """The zero to the precision of doubles in every coordinate, shape ``(n,)``."""
        return np.array([complex(c) for c in self.known_to(DOUBLE_BITS)], dtype=complex)

    def known_to(self, wanted: int) -> list[Any]:
        """Balls (FLINT's ``acb``) that hold the coordinates, each of so many bits if possible."""
        bits = LEAST_BITS
        while bits < min(wanted, MOST_BITS):
            bits *= 2
        while True:
            balls = self.balls(bits)
            if bits >= MOST_BITS or all(
                c.is_zero() or c.rel_accuracy_bits() >= wanted for c in balls
            ):
                return balls
            bits *= 2

    def balls(self, bits: int) -> list[Any]:
        """Balls that hold the coordinates, computed with so many bits."""
        with flint.ctx.workprec(bits):
            root = self.root
            if self.minimal.degree() == 1:
                root = flint.acb(-self.minimal[0] / self.minimal[1])
            elif bits > LEAST_BITS:
                if bits not in self.isolated:
                    self.isolated[bits] = [r for r, _ in self.minimal.complex_roots()]
                (root,) = [r for r in self.isolated[bits] if r.overlaps(self.root)]
            return [
                flint.acb_poly([flint.acb(c[k]) for k in range(c.degree() + 1)])(root)
                for c in self.coordinates
            ]

    @property
    def digits(self) -> int:
        """Decimal digits of the balls that `point` was rounded from, at least."""
        return int(LEAST_BITS * 0.30103)

    @property
    def real(self) -> bool:
        return bool(self.root.imag.is_zero())

    def scale_and_shift(
        self, scales: Sequence[Fraction], origin: Sequence[Fraction]
    ) -> AlgebraicZero:
        """The zero with coordinates ``scales[i] x_i + origin[i]``."""
        moved = tuple(
            c * to_rational(s) + to_rational(b)
            for c, s, b in zip(self.coordinates, scales, origin, strict=True)
        )
        return replace(self, coordinates=moved, known={})

    def value(self, f: Polynomial) -> Any:
        """An exact polynomial at the zero, as a polynomial in the algebraic number."""
        if f not in self.known:
            self.known[f] = _compose_modulo(ring(f.n).of(f), self.coordinates, self.minimal)
        return self.known[f]

    def vanishes(self, f: Polynomial) -> bool:
        """Whether an exact polynomial vanishes at the zero, decided exactly."""
        return self.value(f).degree() < 0

    def independent(self, polynomials: Sequence[Polynomial]) -> bool:
        """Whether the gradients of exact polynomials are independent there, decided exactly."""
        key = tuple(polynomials)
        if key not in self.known:
            self.known[key] = self._seen_independent(key) or are_independent_over(
                [[self.value(f.derivative(i)) for i in range(f.n)] for f in key], self.minimal
            )
        return self.known[key]

    def _seen_independent(self, polynomials: Sequence[Polynomial]) -> bool:
        """Whether balls prove it: Gram's determinant of the gradients is not zero."""
        with flint.ctx.workprec(BALL_BITS):
            x = self.balls(BALL_BITS)
            rows = [
                [f.derivative(i)(x, lambda c: flint.acb(to_rational(c))) for i in range(f.n)]
                for f in polynomials
            ]
            if len(rows) > len(x) or not rows:
                return not rows
            slopes = flint.acb_mat(rows)
            conjugate = flint.acb_mat([[c.conjugate() for c in row] for row in rows])
            return not (slopes * conjugate.transpose()).det().contains(0)


def algebraic_zeros(
    system: PolynomialSystem, two_variables: bool = True
) -> tuple[AlgebraicZero, ...] | None:
    """All zeros of a system that elimination brings down to one variable, with multiplicities.

    Variables that an equation contains linearly, with a constant coefficient, are eliminated, which
    keeps the scheme as it is. None where more variables are left, or the zeros are not finite in
    number, or a coefficient is irrational.

    Args:
        two_variables: whether two equations in two variables, of few zeros, may be left.
    """
    equations = [f for f in system.polynomials if f]
    if not all(f.exact for f in equations) or len(equations) < system.n:
        return None
    if sum(bool(linear_variables(f)) for f in equations) < system.n - 1 - two_variables:
        return None
    over = ring(system.n)
    reduced = _eliminate_linear(over, [over.of(f) for f in equations])
    if reduced is None:
        return None
    rest, images, left = reduced
    if any(g.is_constant() for g in rest):
        return ()
    if len(left) == 2:
        return _of_two_variables(over, rest, images, left) if two_variables else None
    if not rest or len(left) > 2:
        return None
    (index,) = left
    common = _univariate(rest[0], index)
    for g in rest[1:]:
        common = common.gcd(_univariate(g, index))
    return _zeros_of(common, [_univariate(g, index) for g in images])


def _eliminate_linear(
    over: Ring, equations: list[Any]
) -> tuple[list[Any], list[Any], tuple[int, ...]] | None:
    """What is left when variables were eliminated, what each one is then, and which are left."""
    images, left = list(over.context.gens()), set(range(over.n))
    while True:
        equations = [f for f in equations if not f.is_zero()]
        if any(f.is_constant() for f in equations):
            return equations, images, ()
        pivot = _choose_pivot(equations, left)
        if pivot is None or len(left) == 1:
            break
        row, index = pivot
        f = equations.pop(row)
        place = list(over.context.gens())
        place[index] = over.solve_for(f, index)

        def put(g: Any, place: list[Any] = place) -> Any:
            return g.compose(*place, ctx=over.context)

        if any(g.degrees()[index] * place[index].total_degree() > MOST_DEGREE for g in equations):
            return None
        equations, images = [put(g) for g in equations], [put(g) for g in images]
        left.discard(index)
        if any(g.total_degree() > MOST_DEGREE or len(g) > MOST_TERMS for g in equations + images):
            return None
    return equations, images, tuple(sorted(left))


def _of_two_variables(
    over: Ring, equations: list[Any], images: list[Any], left: tuple[int, ...]
) -> tuple[AlgebraicZero, ...] | None:
    if len(equations) != 2:
        return None
    plane = ring(2).context
    place = [plane.constant(0)] * over.n
    place[left[0]], place[left[1]] = plane.gens()
    families = zero_families(*(f.compose(*place, ctx=plane) for f in equations))
    if families is None:
        return None
    found: list[AlgebraicZero] = []
    for each in families:
        at = [each.x if i == left[0] else each.y for i in range(over.n)]
        coordinates = tuple(_compose_modulo(g, at, each.minimal) for g in images)
        found += _conjugates(each.minimal, coordinates, each.multiplicity)
    return tuple(found)


def _compose_modulo(f: Any, at: Sequence[Any], p: Any) -> Any:
    """A polynomial at coordinates that are polynomials modulo p."""
    powers: dict[tuple[int, int], Any] = {}

    def power(i: int, k: int) -> Any:
        if k == 1:
            return at[i]
        if (i, k) not in powers:
            powers[i, k] = power(i, k // 2) * power(i, k - k // 2) % p
        return powers[i, k]

    total = flint.fmpq_poly([])
    for exponents, c in f.to_dict().items():
        term = flint.fmpq_poly([c])
        for i, k in enumerate(exponents):
            if k:
                term = term * power(i, int(k)) % p
        total = total + term
    return total


def _choose_pivot(equations: list[Any], left: set[int]) -> tuple[int, int] | None:
    """An equation and a variable that it is linear in: lowest degree, fewest terms."""
    found = (
        (f.total_degree(), len(f), -index, row)
        for row, f in enumerate(equations)
        for index, degree in enumerate(f.degrees())
        if degree == 1 and index in left and f.derivative(index).is_constant()
    )
    best = min(found, default=None)
    return None if best is None else (best[3], -best[2])


def _univariate(f: Any, index: int) -> Any:
    coefficients = {int(e[index]): c for e, c in f.to_dict().items()}
    top = max(coefficients, default=-1)
    return flint.fmpq_poly([coefficients.get(k, 0) for k in range(top + 1)])


def _zeros_of(f: Any, images: list[Any]) -> tuple[AlgebraicZero, ...]:
    found: list[AlgebraicZero] = []
    for factor, multiplicity in f.factor()[1]:
        p = flint.fmpq_poly(factor)
        found += _conjugates(p, tuple(c % p for c in images), int(multiplicity))
    return tuple(found)


def _conjugates(p: Any, coordinates: tuple[Any, ...], multiplicity: int) -> list[AlgebraicZero]:
    """One zero for each root of an irreducible polynomial."""
    with flint.ctx.workprec(LEAST_BITS):
        if p.degree() == 1:
            roots = [flint.acb(-p[0] / p[1])]
        else:
            roots = [root for root, _ in p.complex_roots()]
    isolated: dict[int, list[Any]] = {}
    known: dict[Any, Any] = {}
    return [AlgebraicZero(p, root, coordinates, multiplicity, isolated, known) for root in roots]
