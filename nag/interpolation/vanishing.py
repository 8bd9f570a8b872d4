"""Polynomials that vanish on the image of a component, by interpolation.

Their coefficients are rational, or in the field of the system's. Where that has the imaginary unit,
this is one more variable, the last one, of degree zero: beside each monomial stands the same one
times the unit, as one more column, so that relations over the rational numbers are those over the
Gaussian ones.

Monomials are taken in ascending order, that of degrees and then the reverse lexicographic one. One
whose values at random points are a combination of those before it is the leading monomial of an
element of the reduced Groebner basis, and its multiples need not be looked at (Moeller & Buchberger
1982). Numbers of points are chosen larger than there are monomials.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import comb, gcd, lcm

import flint
import numpy as np

from nag.algebra.exact_ranks import coefficient_rows, first_independent_rows
from nag.algebra.flint_numbers import to_fraction
from nag.algebra.imaginary_unit import reduce_unit
from nag.algebra.multipliers import order
from nag.algebra.number import Exact
from nag.algebra.polynomial import Polynomial, divides
from nag.algebra.root_basis import Root
from nag.algebra.surd import Surd, root_text
from nag.errors import ComponentError
from nag.interpolation.point_cloud import (
    Cloud,
    Exponents,
    monomial_values,
    monomials_in_doubles,
    real_rows,
)
from nag.numerics.digits import SPARE, bits_of, in_bits
from nag.numerics.double_ranks import clearly_independent
from nag.numerics.rational_relations import (
    Echelon,
    TooFewDigitsError,
    recognise_rational,
)
from nag.text.table import join_words

# Digits that are tried one after the other.
DIGITS = (100, 250, 700)
# More monomials cost more time than anybody waits for.
MOST_MONOMIALS = 400
# Coefficients of one polynomial of known degree, which are solved for together.
MOST_COEFFICIENTS = 500
# A linear form of these is one: its coefficients are random whole numbers up to this.
LARGEST_NUMBER = 10**6
# Entries of a matrix of multiples of equations.
MOST_ENTRIES = 4_000_000


class InterpolationError(ComponentError):
    """Polynomials that are not found, with the reason in one line."""


class NotRationalError(InterpolationError):
    """Coefficients that are not in the field that they are looked for in."""


class TooManyMonomialsError(InterpolationError):
    """A degree with more monomials than are looked at."""


@dataclass(frozen=True, eq=False)
class Interpolated:
    """All polynomials up to some degree that vanish on the image.

    Attributes:
        coordinates: indices of the variables that they are in.
        degree: the largest degree that was looked at.
        basis: the elements up to that degree of the reduced Groebner basis of the image's ideal
            in the graded reverse lexicographic order, leading coefficients one.
        generators: those of them that no combination, without cancelling terms of higher degree,
            of those before them gives.
        counts: for each degree from 0 on the number of independent functions on the image that
            are polynomials of at most this degree.
        standard: monomials up to ``degree`` that no leading monomial divides, ascending.
        digits: in which the coefficients were recognised.
        unit: whether the last of the coordinates is the imaginary unit, which is a number.
    """

    coordinates: tuple[int, ...]
    degree: int
    basis: tuple[Polynomial, ...]
    generators: tuple[Polynomial, ...]
    counts: tuple[int, ...]
    standard: tuple[Exponents, ...]
    digits: int
    unit: bool = False

    @property
    def own_coordinates(self) -> tuple[int, ...]:
        """The coordinates without the imaginary unit."""
        return self.coordinates[: len(self.coordinates) - self.unit]

    @property
    def leading_monomials(self) -> list[Exponents]:
        """The leading monomials of the basis, in the coordinates without the imaginary unit."""
        leading = (leading_monomial(f, self.unit) for f in self.basis)
        return [e[: len(self.own_coordinates)] for e in leading]

    def up_to(self, degree: int) -> list[Exponents]:
        """The standard monomials up to a degree."""
        return [e for e in self.standard if sum(e[: len(self.own_coordinates)]) <= degree]

    def candidates(self, degree: int) -> list[Exponents]:
        """The monomials of a degree that no leading one divides."""
        leading, k = self.leading_monomials, len(self.own_coordinates)
        found = [
            e for e in monomials_of_degree(k, degree) if not any(divides(m, e) for m in leading)
        ]
        return with_unit(found) if self.unit else found


def monomials_of_degree(n: int, degree: int) -> list[Exponents]:
    """All monomials of a degree in ``n`` variables, ascending in reverse lexicographic order."""
    if n == 0:
        return [()] if degree == 0 else []
    found = [
        (*head, last)
        for last in range(degree, -1, -1)
        for head in monomials_of_degree(n - 1, degree - last)
    ]
    return found


def with_unit(monomials: Iterable[Exponents]) -> list[Exponents]:
    """Monomials, each followed by the same one times the imaginary unit, one more variable."""
    return [(*e, power) for e in monomials for power in range(2)]


def start(coordinates: Sequence[int], unit: int | None = None) -> Interpolated:
    """What is known of degree 0: no constant vanishes.

    Args:
        unit: the index of the imaginary unit, if coefficients may have it.
    """
    one = (0,) * len(coordinates)
    if unit is None:
        return Interpolated(tuple(coordinates), 0, (), (), (1,), (one,), 0)
    both = tuple(with_unit([one]))
    return Interpolated((*coordinates, unit), 0, (), (), (1,), both, 0, True)


def columns_at(
    cloud: Cloud, coordinates: Sequence[int], monomials: Sequence[Exponents], digits: int, more: int
) -> dict[Exponents, list[flint.arb]]:
    """Real columns of the monomials' values, for ``more`` columns beside these."""
    count = cloud.points_for(len(monomials) + more)
    points = [[p[i] for i in coordinates] for p in cloud.balls(count, digits)]
    values = monomial_values(points, monomials, digits)
    return {e: real_rows(values[e]) for e in monomials}


def next_degree(cloud: Cloud, known: Interpolated) -> Interpolated:
    """The polynomials of one degree more; the cloud keeps them.

    Raises:
        TooManyMonomialsError: if there are too many monomials.
        NotRationalError: if coefficients are not in the field of the system's.
    """
    key = known.coordinates, known.degree
    if key not in cloud.interpolated:
        cloud.interpolated[key] = _next_degree(cloud, known)
    return cloud.interpolated[key]


def _next_degree(cloud: Cloud, known: Interpolated) -> Interpolated:
    k, degree = len(known.own_coordinates), known.degree + 1
    total = len(known.standard) + comb(k + degree - 1, degree)
    if comb(k + degree - 1, degree) > 100 * MOST_MONOMIALS:
        raise _too_many(total, degree, k, MOST_MONOMIALS)
    candidates = known.candidates(degree)
    if len(known.standard) + len(candidates) > MOST_MONOMIALS:
        raise _too_many(len(known.standard) + len(candidates), degree, k, MOST_MONOMIALS)
    for digits in DIGITS:
        if digits < known.digits:
            continue
        try:
            standard, relations = _split(cloud, known, candidates, digits)
            break
        except TooFewDigitsError:
            continue
    else:
        raise _not_rational(degree, cloud.roots, known.unit)
    generators = list(known.generators)
    new = []
    for lead, coefficients in relations:
        terms = {e: -c for e, c in zip(standard, coefficients, strict=False) if c}
        new.append(Polynomial(len(known.coordinates), {lead: Fraction(1), **terms}))
    if known.unit:
        # Twice each: the other one is its product with the unit.
        new = [f for f in new if not leading_monomial(f, True)[-1]]
    generators += _new_generators(generators, new, degree, known.unit)
    return Interpolated(
        known.coordinates,
        degree,
        (*known.basis, *new),
        tuple(generators),
        (*known.counts, len(standard) // (1 + known.unit)),
        tuple(standard),
        digits,
        known.unit,
    )


def _too_many(count: int, degree: int, variables: int, most: int) -> TooManyMonomialsError:
    return TooManyMonomialsError(
        f"{count} monomials of degree up to {degree} in {variables} variables are more than "
        f"{most}; project to fewer variables or take a lower degree"
    )


def _not_rational(
    degree: int, roots: Sequence[Root] = (1,), unit: bool = False
) -> NotRationalError:
    numbers = "Gaussian rational numbers" if unit else "rational numbers"
    if len(roots) > 1:
        numbers += f" with {join_words([root_text(r) for r in roots[1:]])}"
    return NotRationalError(
        f"the polynomials of degree {degree} have coefficients that are not recognised as "
        f"{numbers} in {DIGITS[-1]} digits: the component is not defined over the {numbers}"
    )


def _split(
    cloud: Cloud,
    known: Interpolated,
    candidates: Sequence[Exponents],
    digits: int,
) -> tuple[list[Exponents], list[tuple[Exponents, list[Exact]]]]:
    """The candidates that are independent, after those known to be, and the others' relations."""
    together = [*known.standard, *candidates]
    points = cloud.doubles(cloud.points_for(len(together)), digits)[:, known.coordinates]
    if clearly_independent(monomials_in_doubles(points, together)):
        return together, []
    columns = columns_at(cloud, known.coordinates, together, digits, 0)
    echelon = Echelon(len(columns[together[0]]), digits, cloud.roots)
    standard, relations = [], []
    for e in together:
        relation = echelon.add(columns[e])
        if relation is None:
            standard.append(e)
        else:
            relations.append((e, relation))
    return standard, relations


def leading_monomial(f: Polynomial, unit: bool = False) -> Exponents:
    """The largest monomial in the graded reverse lexicographic order.

    Args:
        unit: whether the last variable is the imaginary unit, which is a number.
    """
    if unit:
        return max(f.terms, key=lambda e: (order(e[:-1]), -e[-1]))
    return max(f.terms, key=order)


def primitive(f: Polynomial, unit: bool = False) -> Polynomial:
    """The multiple with coprime whole coefficients, the leading one positive.

    Of sums of roots the rational parts are whole numbers, and coprime together. With other
    numbers in it the leading coefficient is made positive.
    """
    lead = f.terms[leading_monomial(f, unit)]
    if not f.algebraic:
        return f if lead > 0 else -f
    parts = [
        part
        for c in f.terms.values()
        for part in (map(to_fraction, c.terms.values()) if isinstance(c, Surd) else [c])
    ]
    factor = Fraction(lcm(*(c.denominator for c in parts)))
    common = gcd(*(int(c * factor) for c in parts))
    sign = 1 if lead > 0 else -1
    return f * (sign * factor / common)


def _new_generators(
    known: Sequence[Polynomial], new: Sequence[Polynomial], degree: int, unit: bool
) -> list[Polynomial]:
    """Those of ``new``, all of one degree, that do not lie in the span of multiples of the others.

    Multiples of ``known`` by monomials count up to ``degree``; ranks are exact. With the imaginary
    unit among the coefficients, as the last variable, all count times the unit as well.

    Raises:
        TooManyMonomialsError: if there are too many multiples.
    """
    if not known or not new:
        return list(new)
    k = known[0].n - unit
    columns = comb(k + degree, degree)
    degrees = [f.degree_in(range(k)) for f in known]
    count = sum(comb(k + degree - d, k) for d in degrees) + len(new)
    if count * columns * (1 + unit) ** 2 > MOST_ENTRIES:
        raise TooManyMonomialsError(
            f"{columns} monomials of degree up to {degree} in {k} variables are too many to tell "
            "which equations are multiples of others; project to fewer variables or take a lower "
            "degree"
        )

    def multiples(f: Polynomial, monomials: Iterable[Exponents]) -> list[Polynomial]:
        every = with_unit(monomials) if unit else monomials
        found = [f * Polynomial(f.n, {e: Fraction(1)}) for e in every]
        return [reduce_unit(g) for g in found] if unit else found

    rows = []
    for f, own in zip(known, degrees, strict=True):
        below = (e for d in range(degree - own + 1) for e in monomials_of_degree(k, d))
        rows += multiples(f, below)
    first = len(rows)
    for f in new:
        rows += multiples(f, [(0,) * k])
    independent = first_independent_rows(coefficient_rows([f.terms for f in rows]))
    return [rows[i] for i in independent if i >= first and not (i - first) % (1 + unit)]


def forms_of_degree(
    cloud: Cloud,
    coordinates: Sequence[int],
    degree: int,
    known: Sequence[Polynomial],
) -> list[Polynomial]:
    """The homogeneous polynomials of a degree that vanish on the image, beside those known.

    Args:
        coordinates: the variables that they are homogeneous in.
        known: forms of lower degrees, whose leading monomials' multiples are left out.

    Raises:
        NotRationalError: if coefficients are not in this field.
        SourceError: if points cannot be sampled.
    """
    k = len(coordinates)
    leading = [leading_monomial(f) for f in known]
    monomials = [
        e for e in monomials_of_degree(k, degree) if not any(divides(m, e) for m in leading)
    ]
    nothing = replace(start(coordinates), standard=())
    for digits in DIGITS:
        try:
            standard, relations = _split(cloud, nothing, monomials, digits)
        except TooFewDigitsError:
            continue
        found = []
        for lead, coefficients in relations:
            terms = {e: -c for e, c in zip(standard, coefficients, strict=False) if c}
            found.append(primitive(Polynomial(k, {lead: Fraction(1), **terms})))
        return found
    raise _not_rational(degree, cloud.roots)


def hypersurface_equation(cloud: Cloud, coordinates: Sequence[int], degree: int) -> Interpolated:
    """The polynomial of least degree that vanishes on the image, a hypersurface of known degree.

    Up to a factor it is the only one of this degree, so that a random linear form of its
    coefficients being one makes a regular system of its values at random points: its solution in
    balls is a proof of that, at these points.

    Raises:
        TooManyMonomialsError: if there are too many monomials.
        InterpolationError: if the coefficients are not rational.
        SourceError: if points cannot be sampled.
    """
    k = len(coordinates)
    total = comb(k + degree, k)
    if total > MOST_COEFFICIENTS:
        raise _too_many(total, degree, k, MOST_COEFFICIENTS)
    monomials = [e for d in range(degree + 1) for e in monomials_of_degree(k, d)]
    form = np.random.default_rng(total).integers(1, LARGEST_NUMBER, total).tolist()
    for digits in DIGITS:
        points = [[p[i] for i in coordinates] for p in cloud.balls((total + 1) // 2, digits)]
        values = monomial_values(points, monomials, digits)
        columns = [real_rows(values[e])[: total - 1] for e in monomials]
        entries = [column[i] for i in range(total - 1) for column in columns]
        entries += map(flint.arb, form)
        try:
            with in_bits(bits_of(digits + SPARE)):
                right = flint.arb_mat(total, 1, [0] * (total - 1) + [1])
                solution = flint.arb_mat(total, total, entries).solve(right).entries()
            coefficients = [recognise_rational(c, digits) for c in solution]
        except (ZeroDivisionError, TooFewDigitsError):
            continue
        terms = {e: c for e, c in zip(monomials, coefficients, strict=True) if c}
        found = primitive(Polynomial(k, terms))
        lead = leading_monomial(found)
        monic = found / found.terms[lead]
        standard = tuple(e for e in monomials if not divides(lead, e))
        counts = tuple(sum(sum(e) <= d for e in standard) for d in range(degree + 1))
        return Interpolated(
            tuple(coordinates), degree, (monic,), (monic,), counts, standard, digits
        )
    raise _not_rational(degree)
