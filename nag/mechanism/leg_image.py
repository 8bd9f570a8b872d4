"""The poses that a leg lets its platform have, as forms in the eight Study coordinates.

A displacement p + eps d is a point (p, d) of projective space on Study's quadric p.d = 0 (Study
1903, Husty 1996). Those of a serial chain are products of its joints', so that their closure, the
leg's image, is irreducible; its forms are interpolated (`nag.interpolation.image_forms`). An image
of dimension 5 is cut out of the quadric by one form exactly, as the quadric's forms have unique
factors. Of a smaller one the forms may have other zeros besides; whether a leg reaches a pose is
tested by its inverse kinematics.

Another origin is a linear change of Study coordinates, which keeps the quadric. Of forms about one
origin those about another are the reduced basis of what they span there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from nag.algebra.exact_ranks import NumberField, PrimeField, coefficient_rows, row_echelon
from nag.algebra.number import Exact
from nag.algebra.polynomial import Polynomial
from nag.interpolation.image_forms import ImageForms, find_image_forms
from nag.interpolation.vanishing import InterpolationError, monomials_of_degree, primitive
from nag.mechanism.loop_product import Element
from nag.mechanism.quaternion import DualQuaternion, dual_conjugate, dual_multiply

# Study coordinates: the real part of the quaternion first, its dual part behind.
COORDINATES = ("x0", "x1", "x2", "x3", "y0", "y1", "y2", "y3")
# Forms of higher degrees have too many monomials.
MOST_DEGREE = 4
Place = tuple[Fraction, Fraction, Fraction]


def study_quadric() -> Polynomial:
    """x0 y0 + x1 y1 + x2 y2 + x3 y3, which vanishes at displacements."""
    x = Polynomial.variables(8)
    return sum((x[i] * x[4 + i] for i in range(1, 4)), x[0] * x[4])


def norm_form(n: int = 8) -> Polynomial:
    """x0^2 + x1^2 + x2^2 + x3^2, which vanishes at no displacement."""
    x = Polynomial.variables(n)
    return sum((x[i] * x[i] for i in range(1, 4)), x[0] * x[0])


def forms_about_origin(forms: Sequence[Polynomial], place: Place) -> tuple[Polynomial, ...]:
    """Forms in Study coordinates about a place as such in those about the origin, reduced.

    Args:
        forms: by rising degree, those of each degree the reduced basis of what vanishes on a set
            beside Study's quadric and multiples of those of lower degrees.

    Returns:
        These bases in those coordinates, primitive, the largest leading monomials first.
    """
    if not any(place):
        return tuple(forms)
    images = _coordinates_about(place)
    moved = [f.compose(images) for f in forms]
    found: list[Polynomial] = []
    for degree in sorted({f.degree for f in moved}):
        lower = [f for f in (study_quadric(), *found) if f.degree <= degree]
        monomials = monomials_of_degree(8, degree)[::-1]
        multiples = [
            f * Polynomial(8, {e: Fraction(1)})
            for f in lower
            for e in monomials_of_degree(8, degree - f.degree)
        ]
        own = [f for f in moved if f.degree == degree]
        known = coefficient_rows([f.terms for f in multiples], monomials)
        rows = known + coefficient_rows([f.terms for f in own], monomials)
        # Leading monomials of multiples are left out, as where forms are interpolated.
        left_out = set(row_echelon(known)[1])
        reduced = zip(*row_echelon(rows), strict=True)
        found += [
            primitive(Polynomial(8, {e: c for e, c in zip(monomials, row, strict=True) if c}))
            for row, pivot in reduced
            if pivot not in left_out
        ]
    return tuple(found)


def _coordinates_about(place: Place) -> tuple[Polynomial, ...]:
    """Study coordinates about a place as linear forms of those about the origin."""
    x = Polynomial.variables(8)
    zero, one = Polynomial(8, {}), Polynomial.constant(8, 1)
    half = [Polynomial.constant(8, c / 2) for c in place]
    there = ((one, zero, zero, zero), (zero, *half))
    pose = (tuple(x[:4]), tuple(x[4:]))
    moved = dual_multiply(dual_multiply(dual_conjugate(there), pose), there)
    return tuple(part for each in moved for part in each)


@dataclass(frozen=True)
class ProductOfFactors:
    """The map from homogeneous coordinates of factors to their product.

    A `nag.interpolation.image_forms.ModularMap`.

    Attributes:
        elements: the factors, and constants.
    """

    elements: tuple[Element, ...]

    @cached_property
    def coefficients(self) -> NumberField:
        """The field that the generators are in.

        Raises:
            InterpolationError: if one of them is no sum of roots.
        """
        entries = [c for e in self.elements for g in e.generators for part in g for c in part]
        if not all(isinstance(c, int | Exact) for c in entries):
            raise InterpolationError("coordinates are no sums of roots")
        return NumberField.of(entries)

    def value(self, field: PrimeField, rng: np.random.Generator) -> list[int]:
        """A random product modulo a prime."""
        product = _UNIT
        for factor in self._factors(field, rng)[0]:
            product = _multiply(product, factor, field.modulus)
        return [*product[0], *product[1]]

    def tangents(
        self, field: PrimeField, rng: np.random.Generator
    ) -> tuple[list[int], list[list[int]]]:
        """A random product modulo a prime, and its derivatives by all homogeneous coordinates."""
        p = field.modulus
        factors, generators = self._factors(field, rng)
        before, behind = [_UNIT], [_UNIT]
        for factor in factors:
            before.append(_multiply(before[-1], factor, p))
        for factor in reversed(factors):
            behind.append(_multiply(factor, behind[-1], p))
        rows = []
        for i, own in enumerate(generators):
            for generator in own:
                left = _multiply(before[i], generator, p)
                real, dual = _multiply(left, behind[len(factors) - 1 - i], p)
                rows.append([*real, *dual])
        return [*before[-1][0], *before[-1][1]], rows

    def _factors(
        self, field: PrimeField, rng: np.random.Generator
    ) -> tuple[list[DualQuaternion], list[list[DualQuaternion]]]:
        """Random values of the factors modulo a prime, and their generators."""
        p = field.modulus
        values, generators = [], []
        for element in self.elements:
            own = [
                tuple(tuple(field.of(c) for c in part) for part in g) for g in element.generators
            ]
            weights = rng.integers(1, p, len(own)).tolist() if element.factor else [1]
            values.append(
                tuple(
                    tuple(
                        sum(w * g[part][i] for w, g in zip(weights, own, strict=True)) % p
                        for i in range(4)
                    )
                    for part in (0, 1)
                )
            )
            generators.append(own if element.factor else [])
        return values, generators


_UNIT: DualQuaternion = ((1, 0, 0, 0), (0, 0, 0, 0))


def _multiply(x: DualQuaternion, y: DualQuaternion, p: int) -> DualQuaternion:
    """The product of two dual quaternions of residues."""
    real = _product(x[0], y[0], p)
    first, second = _product(x[0], y[1], p), _product(x[1], y[0], p)
    return real, tuple((a + b) % p for a, b in zip(first, second, strict=True))


def _product(a: Sequence[int], b: Sequence[int], p: int) -> tuple[int, int, int, int]:
    a0, a1, a2, a3 = a
    b0, b1, b2, b3 = b
    return (
        (a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3) % p,
        (a0 * b1 + a1 * b0 + a2 * b3 - a3 * b2) % p,
        (a0 * b2 - a1 * b3 + a2 * b0 + a3 * b1) % p,
        (a0 * b3 + a1 * b2 - a2 * b1 + a3 * b0) % p,
    )


def image_of_chain(
    elements: Sequence[Element], rng: np.random.Generator, most_degree: int = MOST_DEGREE
) -> ImageForms:
    """The forms of a serial chain's image, besides Study's quadric.

    Raises:
        nag.interpolation.vanishing.InterpolationError: if coefficients are too long.
    """
    source = ProductOfFactors(tuple(elements))
    return find_image_forms(source, 8, (study_quadric(),), most_degree, rng)
