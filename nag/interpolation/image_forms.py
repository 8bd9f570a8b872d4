"""The forms that vanish on the image of a map, from the map's values modulo a prime.

A map that is given by formulas with rational coefficients has values modulo a prime at points as
random as the prime is large. Forms of one degree that vanish at more of them than there are
monomials vanish on the image, but for a probability of some 1e-17. Multiples of those of lower
degrees are left out: their leading monomials are, by Gauss' elimination. What is left has a
reduced basis, whose coefficients are recognised from their residues modulo as many primes as that
takes, and has to vanish at points modulo one prime more.

A map with coefficients in a field that is normal over the rational numbers, as those of sums of
roots are, is taken modulo primes that have these numbers. Where the field is mapped to itself,
the image's reduced basis goes into its conjugates', so that the bases of all conjugates together
have the rational parts of each coefficient.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import isqrt
from typing import Protocol

import numpy as np

from nag.algebra.exact_ranks import NumberField, PrimeField
from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.interpolation.vanishing import InterpolationError, monomials_of_degree, primitive
from nag.numerics.read_only import equal_values

# Points beyond the number of monomials: so many more conditions, each of which a form that does not
# vanish on the image meets with a probability of its degree over the prime.
MORE_POINTS = 8
# Primes for one coefficient; each gives it 31 bits for its numerator and as many below.
MOST_PRIMES = 40
# Conjugates of the coefficients, and with them bases.
MOST_CONJUGATES = 16


class ModularMap(Protocol):
    """A map to a projective space of which values modulo primes are known.

    Attributes:
        coefficients: the field of its coefficients.
    """

    @property
    def coefficients(self) -> NumberField: ...

    def value(self, field: PrimeField, rng: np.random.Generator) -> Sequence[int]:
        """The image of a random point, in homogeneous coordinates."""

    def tangents(
        self, field: PrimeField, rng: np.random.Generator
    ) -> tuple[Sequence[int], Sequence[Sequence[int]]]:
        """The image of a random point, and vectors that with it span the tangent space there."""


@dataclass(frozen=True, eq=False)
class ImageForms:
    """The forms up to some degree that vanish on an image.

    Attributes:
        source: the map.
        n: number of homogeneous coordinates.
        dimension: of the image, as a set in projective space.
        known: forms that were known from the beginning.
        forms: those that these and each other do not give, by rising degree, with coprime whole
            coefficients.
        degree: the largest degree that was looked at.
        cuts: whether the image is a component of their common zeros.
    """

    source: ModularMap
    n: int
    dimension: int
    known: tuple[Polynomial, ...]
    forms: tuple[Polynomial, ...]
    degree: int
    cuts: bool

    __eq__ = equal_values

    @property
    def codimension(self) -> int:
        """Of the image."""
        return self.n - 1 - self.dimension


def find_image_forms(
    source: ModularMap,
    n: int,
    known: Sequence[Polynomial],
    most_degree: int,
    rng: np.random.Generator,
) -> ImageForms:
    """The forms of the least degrees that cut out an image as a component of their zeros.

    Args:
        n: number of homogeneous coordinates.
        known: forms that vanish on the image.
        most_degree: the last degree that is looked at, whether they cut it out by then or not.

    Raises:
        InterpolationError: if a coefficient takes more primes than `MOST_PRIMES`, or the
            field of coefficients has more than `MOST_CONJUGATES` conjugates.
        ZeroDivisionError: if the prime divides a denominator of the map's.
    """
    basis = source.coefficients.basis
    if len(basis) > MOST_CONJUGATES:
        names = ", ".join(map(str, basis[1:MOST_CONJUGATES]))
        raise InterpolationError(f"forms are not found with so many numbers as {names} and others")
    field = _fields(source, 1)[0]
    value, tangents = source.tangents(field, rng)
    dimension = field.rank([value, *tangents]) - 1
    found = ImageForms(source, n, dimension, tuple(known), (), 0, False)
    found = replace(found, cuts=_cuts(found, rng))
    while not found.cuts and found.degree < most_degree:
        found = add_degree(found, rng)
    return found


def add_degree(found: ImageForms, rng: np.random.Generator) -> ImageForms:
    """The same with the forms of one degree more.

    Raises:
        InterpolationError: if a coefficient takes more primes than `MOST_PRIMES`.
        ZeroDivisionError: if the prime divides a denominator of the map's.
    """
    degree = found.degree + 1
    candidates = _without_multiples(found, degree)
    forms = [Polynomial(found.n, terms) for terms in _vanishing(found, degree, candidates, rng)]
    more = tuple(primitive(f) for f in forms)
    found = replace(found, forms=found.forms + more, degree=degree)
    return replace(found, cuts=_cuts(found, rng)) if more else found


def _fields(source: ModularMap, count: int) -> list[PrimeField]:
    """The first of the fields that values are taken in.

    Raises:
        InterpolationError: if there are not so many that have the map's coefficients.
    """
    found = source.coefficients.fields(count)
    if len(found) < count:
        raise InterpolationError("no primes are found modulo which there are all coefficients")
    return list(found)


def _without_multiples(found: ImageForms, degree: int) -> list[Exponents]:
    """The monomials of a degree that lead no multiple of the forms that are known."""
    monomials = monomials_of_degree(found.n, degree)[::-1]
    place = {e: i for i, e in enumerate(monomials)}
    field = _fields(found.source, 1)[0]
    rows = []
    for f in (*found.known, *found.forms):
        terms = [(e, field.of(c)) for e, c in f.terms.items()]
        for shift in monomials_of_degree(found.n, degree - f.degree) if f.degree <= degree else ():
            row = [0] * len(monomials)
            for e, c in terms:
                row[place[tuple(a + b for a, b in zip(e, shift, strict=True))]] = c
            rows.append(row)
    leading = set(field.reduced(rows, len(monomials))[1]) if rows else set()
    return [e for i, e in enumerate(monomials) if i not in leading]


def _vanishing(
    found: ImageForms, degree: int, candidates: Sequence[Exponents], rng: np.random.Generator
) -> list[dict[Exponents, Number]]:
    """A reduced basis of the forms in these monomials that vanish on the image."""
    modulus = 1
    residues: list[list[list[int]]] = []
    numbers = found.source.coefficients.basis
    for k in range(MOST_PRIMES):
        field, other = _fields(found.source, k + 2)[k:]
        parts = _parts_modulo(field, found, degree, candidates, rng)
        if not parts[0]:
            return []
        if modulus > 1 and len(parts[0]) != len(residues[0]):
            raise InterpolationError("forms are not the same modulo two primes")
        if modulus > 1:
            both = zip(residues, parts, strict=True)
            parts = [_chinese(old, modulus, new, field.modulus) for old, new in both]
        residues = parts
        modulus *= field.modulus
        forms = _recognise_forms(residues, numbers, modulus, candidates)
        if forms is not None and _hold(forms, found, degree, other, rng):
            return forms
    raise InterpolationError(
        f"forms of degree {degree} have coefficients of more than {31 * MOST_PRIMES} bits"
    )


def _parts_modulo(
    field: PrimeField,
    found: ImageForms,
    degree: int,
    candidates: Sequence[Exponents],
    rng: np.random.Generator,
) -> list[list[list[int]]]:
    """The rational parts of a reduced basis modulo a prime, for each number of the field."""
    p, coefficients = field.modulus, found.source.coefficients
    images = coefficients.conjugates(field)
    bases = [_basis_modulo(image, found, degree, candidates, rng) for image in images]
    if len({len(basis) for basis in bases}) > 1:
        raise InterpolationError("forms are not the same for conjugate coefficients")
    values = field.matrix([[image.of(c) for c in coefficients.basis] for image in images])
    inverse = values.inv().tolist()
    return [
        [
            [sum(int(s) * c for s, c in zip(weights, own, strict=True)) % p for own in columns]
            for columns in (list(zip(*rows, strict=True)) for rows in zip(*bases, strict=True))
        ]
        for weights in inverse
    ]


def _basis_modulo(
    field: PrimeField,
    found: ImageForms,
    degree: int,
    candidates: Sequence[Exponents],
    rng: np.random.Generator,
) -> list[list[int]]:
    """The same, its coefficients modulo a prime."""
    count = len(candidates) + MORE_POINTS
    points = [found.source.value(field, rng) for _ in range(count)]
    rows = [_monomial_values(field, point, degree, candidates) for point in points]
    basis = field.null_space(rows, len(candidates))
    return field.reduced(basis, len(candidates))[0] if basis else []


def _monomial_values(
    field: PrimeField, point: Sequence[int], degree: int, monomials: Sequence[Exponents]
) -> list[int]:
    p = field.modulus
    powers = [[1] for _ in point]
    for own, x in zip(powers, point, strict=True):
        for _ in range(degree):
            own.append(own[-1] * x % p)
    values = []
    for e in monomials:
        value = 1
        for own, k in zip(powers, e, strict=True):
            if k:
                value = value * own[k] % p
        values.append(value)
    return values


def _chinese(
    residues: Sequence[Sequence[int]], modulus: int, others: Sequence[Sequence[int]], prime: int
) -> list[list[int]]:
    """Residues modulo the product of a modulus and a prime."""
    inverse = pow(modulus, -1, prime)
    return [
        [a + modulus * ((b - a) * inverse % prime) for a, b in zip(row, other, strict=True)]
        for row, other in zip(residues, others, strict=True)
    ]


def _recognise_forms(
    residues: Sequence[Sequence[Sequence[int]]],
    numbers: Sequence[Number],
    modulus: int,
    monomials: Sequence[Exponents],
) -> list[dict[Exponents, Number]] | None:
    """The forms of these coefficients; None if a part is no residue of a short fraction."""
    forms = []
    for rows in zip(*residues, strict=True):
        terms: dict[Exponents, Number] = {}
        for e, own in zip(monomials, zip(*rows, strict=True), strict=True):
            fractions = [_short_fraction(residue, modulus) for residue in own]
            if None in fractions:
                return None
            if any(fractions):
                parts = (c * b for c, b in zip(fractions, numbers, strict=True) if c)
                terms[e] = sum(parts, Fraction(0))
        forms.append(terms)
    return forms


def _short_fraction(residue: int, modulus: int) -> Fraction | None:
    """The fraction of numerator and denominator below the root of half the modulus, if any."""
    bound = isqrt(modulus // 2)
    above, rest, before, factor = modulus, residue, 0, 1
    while rest > bound:
        quotient = above // rest
        above, rest = rest, above - quotient * rest
        before, factor = factor, before - quotient * factor
    return Fraction(rest, factor) if factor and abs(factor) <= bound else None


def _hold(
    forms: Sequence[Mapping[Exponents, Number]],
    found: ImageForms,
    degree: int,
    field: PrimeField,
    rng: np.random.Generator,
) -> bool:
    """Whether they vanish at points modulo another prime."""
    for _ in range(MORE_POINTS):
        point = found.source.value(field, rng)
        for terms in forms:
            values = _monomial_values(field, point, degree, list(terms))
            try:
                coefficients = map(field.of, terms.values())
                total = sum(c * v for c, v in zip(coefficients, values, strict=True))
            except ZeroDivisionError:
                return False
            if total % field.modulus:
                return False
    return True


def _cuts(found: ImageForms, rng: np.random.Generator) -> bool:
    """Whether the gradients at a random point of the image leave its tangents alone."""
    if len(found.known) + len(found.forms) < found.codimension:
        return False
    field = _fields(found.source, 1)[0]
    point = [int(x) for x in found.source.value(field, rng)]
    p = field.modulus
    rows = []
    for f in (*found.known, *found.forms):
        row = [0] * found.n
        for e, c in f.terms.items():
            for i, k in enumerate(e):
                if k:
                    value = field.of(c) * k
                    for j, (x, power) in enumerate(zip(point, e, strict=True)):
                        value = value * pow(x, power - (i == j), p) % p
                    row[i] += value
        rows.append([c % p for c in row])
    return not found.codimension or field.rank(rows) == found.codimension
