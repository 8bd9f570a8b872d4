"""Essential variables: those from which all others follow by a polynomial or rational map.

T25 section 2.3, PT13 definition 2.1. A variable y is a rational function of the essential ones
where a monomial times y is a combination of smaller monomials, with and without the factor y.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf

import flint
import numpy as np

from nag.algebra.number import Exact
from nag.algebra.polynomial import Polynomial
from nag.interpolation.point_cloud import (
    MORE_POINTS,
    Cloud,
    Exponents,
    monomial_values,
    monomials_in_doubles,
    real_rows,
)
from nag.interpolation.vanishing import (
    DIGITS,
    MOST_MONOMIALS,
    Interpolated,
    InterpolationError,
    next_degree,
    primitive,
    start,
)
from nag.numerics.digits import in_bits
from nag.numerics.double_ranks import clearly_independent
from nag.numerics.rational_relations import Echelon, TooFewDigitsError
from nag.numerics.read_only import equal_values

# Largest degree of a numerator that is looked at.
MOST_DEGREE = 4


@dataclass(frozen=True, eq=False)
class VariableMap:
    """A variable as a quotient of polynomials in the essential ones.

    Attributes:
        variable: its index.
        numerator, denominator: polynomials in the essential variables; the denominator is a
            constant where the map is polynomial.
    """

    variable: int
    numerator: Polynomial
    denominator: Polynomial

    __eq__ = equal_values

    @property
    def polynomial(self) -> bool:
        return self.denominator.degree == 0

    def whole_fraction(self) -> tuple[Polynomial, Polynomial]:
        """Numerator and denominator with whole coefficients, coprime ones together."""
        k = self.numerator.n
        # One polynomial that holds both: the denominator times a variable of its own, the first.
        joined = {(0, *e): c for e, c in self.numerator.terms.items()}
        power = 1 + max(0, self.numerator.degree)
        joined |= {(power, *e): c for e, c in self.denominator.terms.items()}
        terms = primitive(Polynomial(k + 1, joined)).terms
        above = Polynomial(k, {e[1:]: c for e, c in terms.items() if not e[0]})
        below = Polynomial(k, {e[1:]: c for e, c in terms.items() if e[0]})
        return above, below


def known_to(cloud: Cloud, known: Interpolated, degree: int) -> Interpolated:
    """What vanishes, up to a degree at least.

    Raises:
        InterpolationError: as `next_degree`.
    """
    while known.degree < degree:
        known = next_degree(cloud, known)
    return known


def maps(
    cloud: Cloud,
    known: Interpolated,
    targets: Sequence[int],
    most_degree: int = MOST_DEGREE,
    polynomial: bool = False,
) -> tuple[VariableMap, ...]:
    """Maps of least degree to those of the targets that have one, polynomial ones first.

    Args:
        known: the essential variables, with what is known to vanish.
        most_degree: of the numerators.
        polynomial: whether no other maps are looked for.

    Raises:
        InterpolationError: if the image's polynomials of low degree are not found.
    """
    found: list[VariableMap] = []
    left = list(targets)
    for degree in range(1, most_degree + 1):
        if not left:
            break
        try:
            known = known_to(cloud, known, degree)
        except InterpolationError:
            if degree == 1:
                raise
            break
        standard = known.up_to(degree)
        lower = [] if polynomial else known.up_to(degree - 1)
        if len(standard) + len(lower) > MOST_MONOMIALS:
            break
        found += _of_degree(cloud, known.coordinates, standard, lower, left)
        left = [y for y in left if all(m.variable != y for m in found)]
    return tuple(sorted(found, key=lambda m: m.variable))


def _of_degree(
    cloud: Cloud,
    coordinates: Sequence[int],
    standard: Sequence[Exponents],
    lower: Sequence[Exponents],
    targets: Sequence[int],
) -> list[VariableMap]:
    """Maps with numerators among the monomials ``standard`` and denominators among ``lower``."""
    count = (len(standard) + len(lower) + 1) // 2 + MORE_POINTS
    doubles = cloud.doubles(count, DIGITS[0])
    found: dict[int, VariableMap | None] = dict.fromkeys(
        _without_map(doubles, coordinates, standard, lower, targets)
    )
    for digits in DIGITS:
        if len(found) == len(targets):
            break
        points = cloud.balls(count, digits)
        values = monomial_values([[p[i] for i in coordinates] for p in points], standard, digits)
        echelon = Echelon(2 * count, digits, cloud.roots)
        try:
            for e in standard:
                echelon.add(real_rows(values[e]))
        except TooFewDigitsError:
            continue
        for y in (y for y in targets if y not in found):
            try:
                factor = [p[y] for p in points]
                found[y] = _map(echelon, y, factor, values, standard, lower)
            except TooFewDigitsError:
                continue
    return [m for m in found.values() if m is not None]


def _without_map(
    points: np.ndarray,
    coordinates: Sequence[int],
    standard: Sequence[Exponents],
    lower: Sequence[Exponents],
    targets: Sequence[int],
) -> list[int]:
    """Targets for which doubles show already that there is no relation of these monomials."""
    values = monomials_in_doubles(points[:, coordinates], standard)
    factors = monomials_in_doubles(points[:, coordinates], lower or standard[:1])
    return [
        y for y in targets if clearly_independent(np.hstack([values, factors * points[:, [y]]]))
    ]


def _map(
    echelon: Echelon,
    variable: int,
    factor: Sequence[flint.acb],
    values: dict[Exponents, list[flint.acb]],
    standard: Sequence[Exponents],
    lower: Sequence[Exponents],
) -> VariableMap | None:
    k = len(standard[0])
    one = Polynomial.constant(k, 1)
    relation = echelon.relation(real_rows(factor))
    if relation is not None:
        return VariableMap(variable, _combination(k, standard, relation), one)
    echelon = echelon.copy()
    for i, e in enumerate(lower):
        with in_bits(echelon.bits):
            products = [x * y for x, y in zip(values[e], factor, strict=True)]
        relation = echelon.add(real_rows(products))
        if relation is not None:
            numerator = _combination(k, standard, relation[: len(standard)])
            below = _combination(k, lower[:i], relation[len(standard) :])
            return VariableMap(variable, numerator, Polynomial(k, {e: Fraction(1)}) - below)
    return None


def _combination(k: int, monomials: Sequence[Exponents], c: Sequence[Exact]) -> Polynomial:
    return Polynomial(k, dict(zip(monomials, c, strict=False)))


def essential_variables(cloud: Cloud, polynomial: bool = False) -> tuple[int, ...]:
    """A set of variables, none of which can be left out, that determine all others.

    Linear combinations of earlier variables are left out first, then polynomials in the remaining
    ones, then rational functions of them, the simplest first. Maps are looked at up to a numerator
    of degree `MOST_DEGREE`, so a choice of fewer variables may exist.

    Args:
        polynomial: whether rational functions are no reason to leave a variable out.
    """
    chosen = _linearly_independent(cloud)
    for only in (True,) if polynomial else (True, False):
        first = chosen
        ranked = sorted((_complexity(cloud, chosen, i, only), -i) for i in chosen)
        for complexity, i in ranked:
            if complexity == inf:
                break
            if chosen is first or _complexity(cloud, chosen, -i, only) < inf:
                chosen = [j for j in chosen if j != -i]
    return tuple(chosen)


def _complexity(cloud: Cloud, chosen: Sequence[int], variable: int, polynomial: bool) -> float:
    """Number of terms of the map to one of the chosen variables from the others; inf if none."""
    rest = [i for i in chosen if i != variable]
    if not rest or cloud.image_dimension(rest) < cloud.source.dimension:
        return inf
    try:
        found = maps(cloud, start(rest, cloud.unit), [variable], MOST_DEGREE, polynomial)
    except InterpolationError:
        return inf
    if not found:
        return inf
    return len(found[0].numerator.terms) + len(found[0].denominator.terms)


def _linearly_independent(cloud: Cloud) -> list[int]:
    n, digits = len(cloud.ambient.system.own_variables), DIGITS[0]
    # Numbers by which columns are multiplied: 1, and the imaginary unit where it is one.
    units = [flint.acb(1)] if cloud.unit is None else [flint.acb(1), flint.acb(0, 1)]
    count = (len(units) * (n + 1) + 1) // 2 + MORE_POINTS
    points = cloud.balls(count, digits)
    chosen = []
    echelon = Echelon(2 * count, digits, cloud.roots)
    for u in units:
        echelon.add(real_rows([u] * count))
    for i in range(n):
        try:
            with in_bits(echelon.bits):
                columns = [real_rows([u * p[i] for p in points]) for u in units]
            relations = [echelon.add(column) for column in columns]
            dependent = relations[0] is not None
        except TooFewDigitsError:
            dependent = False
        if not dependent:
            chosen.append(i)
    return chosen
