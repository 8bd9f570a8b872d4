"""Multiplicity of a component in the scheme that equations define, at one of its generic points.

There the factors of the equations show what the ideal of the system is: only those that vanish on
the component matter, the others are units.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from nag.algebra.elimination import linear_variables, solve_for, substitute
from nag.algebra.factoring import Factors, factor_into_irreducibles, product
from nag.algebra.polynomial import Polynomial

# Powers of polynomials with more terms are not substituted.
MOST_TERMS = 2000


@dataclass(frozen=True)
class LocalIdeal:
    """Generators of an ideal at a generic point of a component.

    Attributes:
        coordinates: generators that are solved for a variable, which occurs in no other one.
        monomials: the other generators, as powers of distinct irreducible polynomials that vanish
            on the component.
    """

    coordinates: tuple[Polynomial, ...]
    monomials: tuple[Factors, ...]

    @property
    def factors(self) -> tuple[Polynomial, ...]:
        """The distinct polynomials that occur in the monomials."""
        return tuple(dict.fromkeys(p for m in self.monomials for p, _ in m))

    @property
    def generators(self) -> tuple[Polynomial, ...]:
        powers = [product([p**k for p, k in m], m[0][0].n) for m in self.monomials if m]
        return (*self.coordinates, *powers)

    def intersections(self, codimension: int) -> float:
        """Number of choices of a factor of each generator; infinite if these are too many or few.

        As many generators as the codimension are a complete intersection there.
        """
        if len(self.coordinates) + len(self.monomials) != codimension:
            return math.inf
        return math.prod(len(m) for m in self.monomials)

    def multiplicity(
        self, codimension: int, independent: Callable[[Sequence[Polynomial]], bool]
    ) -> int | None:
        """The multiplicity of a component of that codimension; None if it does not show.

        Where coordinates and factors are as many as the codimension and have independent gradients
        at a generic point, they are local coordinates of a slice through it, transversal to the
        component. In these the ideal is one of monomials, and the dimension of the local ring is
        the number of monomials that no generator divides. For a hypersurface that is the least
        exponent.

        Args:
            independent: whether the gradients of polynomials are, at the generic point.
        """
        factors = self.factors
        if len(self.coordinates) + len(factors) != codimension:
            return None
        if codimension > 1 and not independent([*self.coordinates, *factors]):
            return None
        exponents = [tuple(dict(m).get(p, 0) for p in factors) for m in self.monomials]
        return standard_monomials(exponents, len(factors))


def local_ideal(equations: Sequence[Factors], vanishes: Callable[[Polynomial], bool]) -> LocalIdeal:
    """The ideal of the equations at a generic point of a component of their zero set.

    A generator that is linear in a variable, with a constant coefficient, is used to eliminate it
    from the others, which may then have more factors.

    Args:
        equations: those that are not zero, by their factors.
        vanishes: whether a polynomial vanishes on the component.
    """
    known: dict[Polynomial, bool] = {}

    def there(factors: Factors) -> dict[Polynomial, int]:
        found: dict[Polynomial, int] = {}
        for p, k in factors:
            if p not in known:
                known[p] = vanishes(p)
            if known[p]:
                found[p] = k
        return found

    monomials = [there(factors) for factors in equations]
    coordinates: list[Polynomial] = []
    while True:
        monomials = [dict(m) for m in dict.fromkeys(tuple(m.items()) for m in monomials)]
        pivot = _choose_pivot(monomials)
        if pivot is None:
            return LocalIdeal(tuple(coordinates), tuple(tuple(m.items()) for m in monomials))
        row, p, index = pivot
        del monomials[row]
        image = solve_for(p, index)
        coordinates = [substitute(f, index, image) for f in coordinates] + [p]
        reduced = []
        for m in monomials:
            after: dict[Polynomial, int] | None = {}
            for q, k in m.items():
                value = substitute(q, index, image)
                if not value:
                    after = None
                    break
                for r, j in (
                    there(factor_into_irreducibles(value)).items() if value is not q else ((q, 1),)
                ):
                    after[r] = after.get(r, 0) + j * k
            if after is not None:
                reduced.append(after)
        monomials = reduced


def _choose_pivot(monomials: Sequence[dict[Polynomial, int]]) -> tuple[int, Polynomial, int] | None:
    """A generator that is linear in a variable, and the variable: of least degree."""
    alone = [(row, *m.items()) for row, m in enumerate(monomials) if len(m) == 1]
    found = (
        (row, p, index)
        for row, (p, k) in alone
        if k == 1 and len(p.terms) <= MOST_TERMS
        for index in sorted(linear_variables(p))
    )
    return min(found, key=lambda each: (each[1].degree, len(each[1].terms)), default=None)


def standard_monomials(exponents: Sequence[tuple[int, ...]], n: int) -> int | None:
    """Number of monomials in ``n`` variables that none of some monomials divides; None: infinite.

    Args:
        exponents: of the monomials, ``n`` numbers each.
    """
    if n == 0:
        return 0 if exponents else 1
    steps = sorted({e[-1] for e in exponents} | {0})
    total = 0
    for i, low in enumerate(steps):
        below = [e[:-1] for e in exponents if e[-1] <= low]
        count = standard_monomials(below, n - 1)
        if count is None or (count and i + 1 == len(steps)):
            return None
        if count:
            total += count * (steps[i + 1] - low)
    return total


# Generators with more choices of a factor of each are not taken apart.
MOST_INTERSECTIONS = 64


def generic_multiplicity(
    equations: Sequence[Factors],
    codimension: int,
    vanishes: Callable[[Polynomial], bool | None],
    independent: Callable[[Sequence[Polynomial]], bool],
    by_local_ring: Callable[[Sequence[Polynomial]], int],
) -> int:
    """Multiplicity of the component through a generic point of it; 0 if it was not found.

    It is exact where the equations' factors show it, see `LocalIdeal.multiplicity`. Where the
    generators are as many as the codimension, it is the sum of the multiplicities of all choices of
    one factor of each, times their exponents: that many elements whose quotient is of finite length
    are a regular sequence in any order, in a regular local ring, and for such the length is
    additive, ``0 -> R/(f) -> R/(f g) -> R/(g) -> 0`` being exact. Else it is the dimension of the
    local ring of all generators.

    Args:
        equations: those that are not zero, by their factors.
        codimension: of the component.
        vanishes: whether a polynomial vanishes on the component; None if that is not known.
        independent: whether gradients of polynomials certainly are, at a generic point.
        by_local_ring: computes the dimension of the local ring of some generators at a generic
            point, on a slice of complementary dimension; 0 if it was not found.
    """
    unknown = False

    def there(f: Polynomial) -> bool:
        nonlocal unknown
        answer = vanishes(f)
        unknown |= answer is None
        return answer is not False

    ideal = local_ideal(equations, there)
    if unknown:
        return 0
    exact = ideal.multiplicity(codimension, independent)
    if exact is not None:
        return exact
    if ideal.intersections(codimension) > MOST_INTERSECTIONS:
        return by_local_ring(ideal.generators)
    total = 0
    for factors in itertools.product(*ideal.monomials):
        chosen = [*ideal.coordinates, *(p for p, _ in factors)]
        part = local_ideal([((p, 1),) for p in chosen], there)
        single = part.multiplicity(codimension, independent) or by_local_ring(part.generators)
        if not single or unknown:
            return 0
        total += single * math.prod(k for _, k in factors)
    return total
