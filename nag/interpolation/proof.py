"""That interpolated polynomials and maps hold on a component: proofs, and tests at fresh points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import prod

import flint

from nag.algebra.exact_ranks import jacobian_rank
from nag.algebra.groebner import (
    Divisor,
    Ideal,
    UnfinishedBasis,
    clear_denominators,
    divisor,
    ideal_of,
    remainder,
)
from nag.algebra.multipliers import multipliers
from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_function import FunctionField, RationalFunction
from nag.interpolation.essential import VariableMap
from nag.interpolation.point_cloud import Cloud
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import SPARE, bits_of
from nag.numerics.zero_values import NONZERO

FRESH_POINTS = 30
# Groebner bases of larger systems are not begun.
MOST_VARIABLES, MOST_SOLUTIONS = 10, 64
# Degree and number of monomials of the factors that carry a polynomial into an ideal.
MOST_FACTOR_DEGREE, MOST_FACTOR_TERMS = 3, 120
# Powers of a polynomial that vanishes on a multiple component.
MOST_POWER = 2
DIGITS = 50


@dataclass(frozen=True, eq=False)
class Substitution:
    """A component as the image of a variety under proved maps.

    Attributes:
        divisors: polynomials that vanish on the variety.
        values: all variables as rational functions on it.
    """

    divisors: tuple[Divisor, ...]
    values: tuple[RationalFunction, ...]

    def proves(self, f: Polynomial) -> bool:
        """Whether the divisors divide a polynomial in all variables, with the maps put in."""
        field = self.values[0].field
        return remainder(f(self.values, field).numerator, self.divisors, len(field.names)) == 0


def substitution(
    cloud: Cloud,
    coordinates: Sequence[int],
    generators: Sequence[Polynomial],
    basis: Sequence[Polynomial],
    maps: Sequence[VariableMap],
) -> Substitution | None:
    """The component as the image of the generators' zeros, if that is proved exactly.

    Let r be the exact point, regular on the d-dimensional component. The k - d generators in k
    variables have independent gradients at the image of r, so the set Z that they cut there is
    smooth of dimension d. With the maps, regular at r and with the right values there, put for
    the variables, all equations lie in the ideal of the generators: the maps carry Z to solutions
    through r, of dimension d, and that can only be the component.

    Args:
        basis: elements of the generators' ideal, of its Groebner basis as far as that is known;
            what they divide without remainder lies in the ideal.
    """
    ambient, point = cloud.ambient, cloud.source.exact
    d, k = cloud.source.dimension, len(coordinates)
    if point is None or len(generators) != k - d or len(maps) + k != ambient.system.n:
        return None
    full = [image(point) for image in ambient.images]
    base = [full[i] for i in coordinates]
    if any(f(base) != 0 for f in generators) or jacobian_rank(generators, base) != k - d:
        return None
    for m in maps:
        below = m.denominator(base)
        if below == 0 or m.numerator(base) != below * full[m.variable]:
            return None
    field = FunctionField([ambient.system.variables[i] for i in coordinates], "degrevlex")
    divisors = tuple(divisor(clear_denominators(f, field), k) for f in basis)
    values = dict(zip(coordinates, field.variables, strict=True))
    for m in maps:
        above, below = (f(field.variables, field) for f in (m.numerator, m.denominator))
        values[m.variable] = above / below
    found = Substitution(divisors, tuple(values[i] for i in range(ambient.system.n)))
    return found if all(map(found.proves, ambient.system.polynomials)) else None


def equations_ideal(cloud: Cloud) -> Ideal | None:
    """The ideal of all equations, where it is small enough to be found."""
    system = cloud.ambient.system
    if system.n > MOST_VARIABLES or prod(system.degrees) > MOST_SOLUTIONS:
        return None
    try:
        return ideal_of(system.polynomials, system.variables)
    except UnfinishedBasis:
        return None


def proved_by_reduction(cloud: Cloud, ideal: Ideal, f: Polynomial) -> bool:
    """Whether a power of ``f`` times some s that is not zero on the component lies in the ideal.

    A component is irreducible, so where ``s f^2`` vanishes on it and ``s`` does not, ``f`` does.
    Of conjugate components each needs such an s.

    Args:
        ideal: of all equations.
        f: in all variables.
    """
    points = cloud.balls(len(cloud.sources), DIGITS)
    for power in range(1, MOST_POWER + 1):
        for degree in range(MOST_FACTOR_DEGREE + 1):
            factors = multipliers(ideal, f**power, degree, MOST_FACTOR_TERMS)
            if factors is None:
                break
            points = [p for p in points if not any(_value(s, p) > NONZERO for s in factors)]
            if not points:
                return True
    return False


def _value(f: Polynomial, point: Sequence[flint.acb]) -> flint.arb:
    """Size of a value beside the largest coefficient."""
    largest = max(abs(c) for c in f.terms.values())
    value = BallPolynomials.of((f / largest,)).values(point, bits_of(DIGITS))[0, 0]
    return value.abs_lower()


def cleared_map(m: VariableMap, n: int, coordinates: Sequence[int]) -> Polynomial:
    """Denominator times variable minus numerator, in all ``n`` variables."""
    above, below = (f.with_variables(n, coordinates) for f in (m.numerator, m.denominator))
    return below * Polynomial.variable(n, m.variable) - above


def largest_value(cloud: Cloud, polynomials: Sequence[Polynomial], digits: int) -> float:
    """The decimal logarithm of the largest value at `FRESH_POINTS` new points.

    Relative to the terms, coordinates below one counted as one; radii of the balls included. Of
    isolated points, which are the same in all digits, these are taken.

    Args:
        polynomials: in all variables.
        digits: of the points.
    """
    known = cloud.count if cloud.source.dimension else 0
    points = cloud.balls(known + FRESH_POINTS, digits)[known:]
    worst = float("-inf")
    if not polynomials:
        return worst
    system, bits, ten = (
        BallPolynomials.of(polynomials),
        bits_of(digits + SPARE),
        flint.arb(10).log(),
    )
    for p in points:
        bounds = system.sizes([flint.acb(max(abs(x).mid(), flint.arb(1))) for x in p], bits)
        for value, bound in zip(system.values(p, bits).entries(), bounds, strict=True):
            ratio = value.abs_upper() / bound
            worst = max(worst, float((ratio.log() / ten).mid()))
    return worst
