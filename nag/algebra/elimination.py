"""Exact elimination of variables that equations give as polynomials in the others."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from operator import itemgetter
from typing import Any

from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.polynomial import (
    Exponents,
    Parts,
    Polynomial,
    add_terms,
    multiply_parts,
    multiply_terms,
    occurring_variables,
)
from nag.algebra.root_basis import share_a_field
from nag.algebra.system import PolynomialSystem

# Bits by which coefficients differ that are as good to divide by.
STEEP = 3


@dataclass(frozen=True)
class Elimination:
    """A system with fewer variables, and the way back.

    The original solution set is the graph of `images` over that of `system` (PT13 definition 2.1),
    so dimensions, irreducibility and multiplicities are the same. Degrees are the same if every
    image is of degree one.

    Attributes:
        system: the reduced system.
        original_variables: names of the original variables.
        kept: index, among the original variables, of each variable of `system`.
        images: each original variable as a polynomial in the variables of `system`.
    """

    system: PolynomialSystem
    original_variables: tuple[str, ...]
    kept: tuple[int, ...]
    images: tuple[Polynomial, ...]

    @cached_property
    def irreducible(self) -> frozenset[Polynomial]:
        """Irreducible polynomials that are zero exactly where an equation of the system is."""
        known = [factor_into_irreducibles(f) for f in self.system.polynomials]
        return frozenset(factors[0][0] for factors in known if len(factors) == 1)

    def lift(self, point: Sequence[Any]) -> Any:
        """The point of the original space above ``point``.

        ``point`` is a sequence of numbers, exact ones giving exact ones, or a NumPy array of shape
        (..., reduced n), which gives an array of shape (..., n).
        """
        if not hasattr(point, "dtype"):
            return [image(point) for image in self.images]
        import numpy as np

        array = np.asarray(point)
        columns = [array[..., i] for i in range(array.shape[-1])]
        lifted = np.empty((*array.shape[:-1], len(self.images)), dtype=np.result_type(array, float))
        for i, image in enumerate(self.images):
            lifted[..., i] = image(columns)
        return lifted

    def lift_radii(self, point: Any, radii: Any) -> Any:
        """Errors of the coordinates above ``point``, of those of ``point``.

        Both are arrays, of shape (..., reduced n); the result is of shape (..., n).
        """
        import numpy as np

        sizes = np.abs(point)
        terms = [{e: abs(float(c)) for e, c in f.terms.items()} for f in self.images]

        def largest(within: Any) -> Any:
            values = np.zeros((*within.shape[:-1], len(terms)))
            for i, each in enumerate(terms):
                values[..., i] = sum(c * np.prod(within**e, axis=-1) for e, c in each.items())
            return values

        operations = np.array(
            [len(f.terms) * (1 + f.degree) if f.degree else 0 for f in self.images]
        )
        operations[list(self.kept)] = 1
        there = largest(sizes)
        return largest(sizes + radii) - there + operations * np.finfo(float).eps * there

    def project(self, point: Sequence[Any]) -> Any:
        """The coordinates of a point of the original space that the reduced system keeps."""
        if hasattr(point, "dtype"):
            return point[..., list(self.kept)]
        return [point[i] for i in self.kept]


def eliminate_linear(
    system: PolynomialSystem, keep: Collection[int] = (), graphs: bool = True
) -> Elimination:
    """Solve equations for variables that they contain linearly, with a constant coefficient.

    Equations of degree one are solved first, those with the fewest terms before others and each
    for the variable that spreads least; that raises no degree. With ``graphs``, an equation of
    higher degree is solved as well (``z - x^2`` for ``z``) where no degree of another equation
    rises. That changes the degrees of components, so systems whose degrees are asked for want
    ``graphs=False``. Where the system has variable groups, no degree in a group rises either; still
    multidegrees are then those of the reduced system.

    Equations that reduce to zero are dropped. One that reduces to another constant stays: the
    system has no solutions; so it is where a condition in ``nonzero`` reduces to zero. A group
    all of whose variables are eliminated disappears.

    Args:
        system: the equations; conditions in ``nonzero`` are carried along.
        keep: indices of variables that must stay.
        graphs: whether equations of degree two and more may be solved.
    """
    n = system.n
    equations = [f for f in system.polynomials if f]
    nonzero = list(system.nonzero)
    images = list(Polynomial.variables(n))
    kept = set(range(n))
    groups = system.groups
    while True:
        pivot = _choose_pivot(equations, nonzero, kept - set(keep), groups, graphs)
        if pivot is None:
            break
        row, index = pivot
        image = solve_for(equations[row], index)
        del equations[row]
        equations = [g for g in (substitute(f, index, image) for f in equations) if g]
        nonzero = [substitute(f, index, image) for f in nonzero]
        images = [substitute(f, index, image) for f in images]
        kept.discard(index)
    order = sorted(kept)
    return Elimination(
        system=PolynomialSystem(
            tuple(system.variables[i] for i in order),
            tuple(_restrict(f, order) for f in equations),
            tuple(_restrict(f, order) for f in nonzero),
            tuple(g for g in (tuple(order.index(i) for i in g if i in kept) for g in groups) if g),
            isotropic=system.isotropic,
        ),
        original_variables=system.variables,
        kept=tuple(order),
        images=tuple(_restrict(f, order) for f in images),
    )


def _choose_pivot(
    equations: list[Polynomial],
    nonzero: list[Polynomial],
    free: set[int],
    groups: tuple[tuple[int, ...], ...],
    graphs: bool,
) -> tuple[int, int] | None:
    """Equation and variable to solve it for: those that fill in least, lowest degree first.

    Where several are as good, a variable with a small coefficient is not taken: points that are as
    far apart as others would be close together in the variables that are left.
    """
    others = [f.support for f in equations]
    best: tuple[Any, tuple[int, int]] | None = None
    for row, f in enumerate(equations):
        if f.degree < 1 or (f.degree > 1 and not graphs):
            continue
        steepness = _steepness(f)
        for index in linear_variables(f) & free:
            used_in = [i for i, support in enumerate(others) if index in support and i != row]
            fill = (len(f.terms) - 2) * len(used_in)
            key = (f.degree, fill, len(f.terms), steepness[index], index, row)
            if best is not None and key >= best[0]:
                continue
            affected = [equations[i] for i in used_in]
            affected += [g for g in nonzero if index in g.support]
            if (f.degree > 1 or groups) and _raises_degrees(affected, f, index, groups):
                continue
            best = key, (row, index)
    return None if best is None else best[1]


def _steepness(f: Polynomial) -> dict[int, int]:
    """For each variable of linear terms how small its coefficient is beside the largest of them."""
    bits = {e.index(1): _binary_size(c) for e, c in f.terms.items() if sum(e) == 1}
    most = max(bits.values(), default=0)
    return {index: (most - own) // STEEP for index, own in bits.items()}


def _binary_size(c: Any) -> int:
    """The binary logarithm of a number's absolute value, within one."""
    if isinstance(c, Fraction):
        return abs(c.numerator).bit_length() - c.denominator.bit_length()
    return math.frexp(abs(complex(c)))[1]


def linear_variables(f: Polynomial) -> set[int]:
    """Variables that occur in ``f`` in one term only, linearly and alone."""
    alone = {e.index(1) for e in f.terms if sum(e) == 1}
    return alone - occurring_variables(e for e in f.terms if sum(e) > 1) if alone else alone


def solve_for(f: Polynomial, index: int) -> Polynomial:
    """What ``f = 0`` says the variable is."""
    variable = Polynomial.variable(f.n, index)
    (exponents,) = variable.terms
    coefficient = f.terms[exponents]
    return variable - f / coefficient


def use_linear(p: Polynomial, others: Iterable[Polynomial]) -> list[Polynomial]:
    """Polynomials with what ``p = 0`` says of its last variable, if it is of degree one."""
    if p.degree > 1:
        return list(others)
    index = max(p.support)
    image = solve_for(p, index)
    return [substitute(f, index, image) for f in others]


def substitute(f: Polynomial, index: int, image: Polynomial) -> Polynomial:
    """``f`` with one variable replaced, by Horner's rule in that variable."""
    if index not in f.support:
        return f
    if f.whole and image.whole:
        return _substitute_in_integers(f, index, image)
    if f.parts and image.parts and share_a_field(f.parts[0], image.parts[0]):
        return _substitute_in_parts(f, index, image)
    by_power = _by_power(f.terms, index)
    top = max(by_power)
    result = Polynomial(f.n, by_power[top])
    for power in range(top - 1, -1, -1):
        result = result * image + Polynomial(f.n, by_power.get(power, {}))
    return result


def _substitute_in_integers(f: Polynomial, index: int, image: Polynomial) -> Polynomial:
    """The same, with one division at the end."""
    assert f.whole
    assert image.whole
    (whole, common), (of_image, b) = f.whole, image.whole
    by_power = _by_power(whole, index)
    top = max(by_power)
    result, factor = by_power[top], 1
    for power in range(top - 1, -1, -1):
        result = {e: c for e, c in multiply_terms(result, of_image).items() if c}
        factor *= b
        for e, c in by_power.get(power, {}).items():
            result[e] = result[e] + factor * c if e in result else factor * c
    common *= factor
    if common == 1:
        return Polynomial(f.n, {e: Fraction(c) for e, c in result.items() if c})
    return Polynomial(f.n, {e: Fraction(c, common) for e, c in result.items() if c})


def _substitute_in_parts(f: Polynomial, index: int, image: Polynomial) -> Polynomial:
    """The same where coefficients are sums of roots."""
    assert f.parts
    assert image.parts
    (parts, common), (of_image, b) = f.parts, image.parts
    by_power: dict[int, Parts] = {}
    for r, terms in parts.items():
        for power, own in _by_power(terms, index).items():
            by_power.setdefault(power, {})[r] = own
    top = max(by_power)
    result, factor = by_power[top], 1
    for power in range(top - 1, -1, -1):
        result = multiply_parts(result, of_image)
        factor *= b
        for r, terms in by_power.get(power, {}).items():
            add_terms(result.setdefault(r, {}), terms, factor)
    return Polynomial.of_parts(f.n, result, common * factor)


def _by_power(terms: Mapping[Exponents, Any], index: int) -> dict[int, dict[Exponents, Any]]:
    """Coefficients of the powers of a variable, as terms in the others."""
    by_power: dict[int, dict[Exponents, Any]] = {}
    for e, c in terms.items():
        by_power.setdefault(e[index], {})[(*e[:index], 0, *e[index + 1 :])] = c
    return by_power


def _raises_degrees(
    affected: Iterable[Polynomial],
    f: Polynomial,
    index: int,
    groups: tuple[tuple[int, ...], ...],
) -> bool:
    """Whether substituting for the variable can raise the degree of one that contains it.

    Degrees before cancellation are compared: a degree that only cancellation keeps low is a
    coincidence that is not worth the larger coefficients.
    """
    for measured in (tuple(range(f.n)), *groups):
        of_image = max((sum(e[i] for i in measured) for e in f.terms if not e[index]), default=0)
        of_variable = int(index in measured)
        for g in affected:
            degree = g.degree_in(measured)
            for e in g.terms:
                if sum(e[i] for i in measured) + e[index] * (of_image - of_variable) > degree:
                    return True
    return False


def _restrict(f: Polynomial, order: Sequence[int]) -> Polynomial:
    if len(order) == f.n:
        return f
    if len(order) < 2:
        return Polynomial(len(order), {tuple(e[i] for i in order): c for e, c in f.terms.items()})
    chosen = itemgetter(*order)
    return Polynomial(len(order), {chosen(e): c for e, c in f.terms.items()})
