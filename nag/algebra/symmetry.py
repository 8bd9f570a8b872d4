"""Signed permutations of the variables, and which of them carry a system into itself.

Everything here is decided exactly: a signed permutation is a symmetry when it carries every
equation into the ideal of the equations, which is read off by linear algebra over the rationals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement, islice
from operator import add
from typing import Any

from nag.algebra.exact_ranks import coefficient_rows, field_of, rank, residues
from nag.algebra.given import check_listed, check_type
from nag.algebra.number import is_zero
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import is_name, nearest, quote
from nag.errors import EquationError

# Multiples of equations beyond this number are not searched for the image of an equation.
MOST_MULTIPLES = 400


class SymmetryError(EquationError):
    """A map that is no signed permutation, or does not carry the system into itself."""


@dataclass(frozen=True)
class SignedPermutation:
    """The linear map ``(g x)[i] = signs[i] * x[sources[i]]``."""

    sources: tuple[int, ...]
    signs: tuple[int, ...]

    def __post_init__(self) -> None:
        for name in ("sources", "signs"):
            check_listed(getattr(self, name), name, "a whole number for each variable")
        if sorted(self.sources) != list(range(len(self.sources))):
            raise SymmetryError("each variable must be the image of exactly one")
        if len(self.signs) != len(self.sources) or not set(self.signs) <= {1, -1}:
            raise SymmetryError("each variable must have a sign, 1 or -1")

    @classmethod
    def of_signs(cls, signs: Sequence[int]) -> SignedPermutation:
        """The map that only changes signs."""
        check_listed(signs, "signs", "1 or -1 for each variable")
        return cls(tuple(range(len(signs))), tuple(signs))

    @classmethod
    def of_map(cls, images: Mapping[str, str], variables: Sequence[str]) -> SignedPermutation:
        """From texts like ``{"a": "-b", "b": "a"}``; variables not named stay as they are.

        Raises:
            SymmetryError: if that is no signed permutation of ``variables``.
        """
        check_type(images, Mapping, "images", "a dict like {'x': '-x'}")
        sources, signs = list(range(len(variables))), [1] * len(variables)
        for name, image in images.items():
            _check_variable(name, variables)
            text = image.strip()
            sign = -1 if text.startswith("-") else 1
            text = text[1:].strip() if text[:1] in ("-", "+") else text
            _check_variable(text, variables)
            i = list(variables).index(name)
            sources[i], signs[i] = list(variables).index(text), sign
        for i, name in enumerate(variables):
            goes = [variables[k] for k, source in enumerate(sources) if source == i]
            if len(goes) != 1:
                what = f"is the image of {' and of '.join(goes)}" if goes else "is no image"
                raise SymmetryError(f"{name} {what}; each variable must be the image of one")
        return cls(tuple(sources), tuple(signs))

    @property
    def n(self) -> int:
        return len(self.sources)

    @property
    def is_identity(self) -> bool:
        return self == self.identity(self.n)

    @classmethod
    def identity(cls, n: int) -> SignedPermutation:
        return cls(tuple(range(n)), (1,) * n)

    def after(self, first: SignedPermutation) -> SignedPermutation:
        """This map after ``first``."""
        sources = tuple(first.sources[k] for k in self.sources)
        return SignedPermutation(
            sources,
            tuple(s * first.signs[k] for s, k in zip(self.signs, self.sources, strict=True)),
        )

    @property
    def inverse(self) -> SignedPermutation:
        sources, signs = [0] * self.n, [1] * self.n
        for i, (k, sign) in enumerate(zip(self.sources, self.signs, strict=True)):
            sources[k], signs[k] = i, sign
        return SignedPermutation(tuple(sources), tuple(signs))

    def of_point(self, point: Any) -> Any:
        """The image of points: a sequence of numbers, or an array of shape ``(..., n)``."""
        if hasattr(point, "dtype"):
            return point[..., list(self.sources)] * _as_array(self.signs)
        return [s * point[k] for s, k in zip(self.signs, self.sources, strict=True)]

    def of_polynomial(self, f: Polynomial) -> Polynomial:
        """The polynomial ``x -> f(g x)``."""
        terms: dict[Exponents, Any] = {}
        for exponents, coefficient in f.terms.items():
            moved, sign = [0] * self.n, 1
            for i, k in enumerate(exponents):
                moved[self.sources[i]] = k
                sign *= self.signs[i] if k % 2 else 1
            terms[tuple(moved)] = coefficient * sign
        return Polynomial(f.n, terms)

    def text(self, variables: Sequence[str]) -> dict[str, str]:
        """The variables that are moved and their images, as `of_map` reads them."""
        return {
            name: f"{'-' if sign < 0 else ''}{variables[k]}"
            for i, (name, k, sign) in enumerate(
                zip(variables, self.sources, self.signs, strict=True)
            )
            if k != i or sign < 0
        }


def _check_variable(name: str, variables: Sequence[str]) -> None:
    if name in variables:
        return
    if is_name(name):
        known = nearest(name, variables)
        raise SymmetryError(f"unknown variable {quote(name)}{known}; write names from 'variables'")
    raise SymmetryError(f"{quote(name)} is no variable; write a name, or - and a name")


def _as_array(signs: Sequence[int]) -> Any:
    import numpy as np

    return np.array(signs, dtype=float)


def check_symmetry(system: PolynomialSystem, g: SignedPermutation) -> None:
    """Make sure that ``g`` carries the solutions of ``system`` into themselves.

    Every equation must become a rational combination of multiples of the equations, of no higher
    degree than these have; every polynomial of ``nonzero`` one of them, up to a factor; and each
    group of variables must stay together, in its place.

    Raises:
        SymmetryError: if that is not so, or cannot be shown in this way.
    """
    check_type(g, SignedPermutation, "symmetries", "a list of nag.SignedPermutation")
    if g.n != system.n:
        raise SymmetryError(f"it moves {g.n} variables, the system has {system.n}")
    images = [g.of_polynomial(f) for f in system.polynomials]
    outside = first_outside_span(images, system.polynomials)
    if outside is not None:
        place = "it" if len(system.polynomials) == 1 else f"equation {outside + 1}"
        raise SymmetryError(f"{place} does not become a combination of the equations")
    for f in system.nonzero:
        image = g.of_polynomial(f)
        if not any(_proportional(image, other) for other in system.nonzero):
            raise SymmetryError("it does not keep the conditions that must not vanish")
    for group in system.groups:
        if {g.sources[i] for i in group} != set(group):
            name = system.variables[group[0]]
            raise SymmetryError(f"it does not keep the group of {name} together")


def _proportional(f: Polynomial, g: Polynomial) -> bool:
    if f.terms.keys() != g.terms.keys():
        return False
    if not f:
        return True
    key = next(iter(f.terms))
    p, q = f.terms[key], g.terms[key]
    return all(is_zero(f.terms[e] * q - g.terms[e] * p) for e in f.terms)


def first_outside_span(
    polynomials: Sequence[Polynomial], equations: Sequence[Polynomial]
) -> int | None:
    """Place of the first polynomial that is no combination of multiples of the equations.

    Only rational combinations, of no higher degree than the equations, count; None if each is one.
    """
    left = {
        i: f for i, f in enumerate(polynomials) if not any(_proportional(f, g) for g in equations)
    }
    algebraic = [f for f in left.values() if f.algebraic]
    field = field_of([*algebraic, *(g for g in equations if g.algebraic)])
    spanning: list[Polynomial] = []

    def are_inside(polynomials: Sequence[Polynomial]) -> bool:
        # What is none modulo a prime is none, or has coefficients that the prime divides below.
        return (
            field is None
            or _are_combinations(spanning, polynomials, lambda g: residues(g, field), field.rank)
        ) and _are_combinations(spanning, polynomials, lambda g: g.terms, rank)

    # Those of lower degree first: mostly the equations themselves are enough.
    for multiples in _multiples(equations, max(g.degree for g in equations)) if algebraic else ():
        spanning += multiples
        if are_inside(algebraic):
            algebraic = []
            break
    return next(
        (i for i, f in left.items() if not f.algebraic or (algebraic and not are_inside([f]))),
        None,
    )


def _are_combinations(
    spanning: Sequence[Polynomial],
    polynomials: Sequence[Polynomial],
    terms_of: Callable[[Polynomial], Mapping[Exponents, Any]],
    rank_of: Callable[[Any], int],
) -> bool:
    """Whether the polynomials are combinations of the spanning ones, by ranks."""
    rows = coefficient_rows([terms_of(g) for g in (*spanning, *polynomials)])
    return rank_of(rows) == rank_of(rows[: len(spanning)])


def _multiples(equations: Sequence[Polynomial], degree: int) -> Iterator[list[Polynomial]]:
    """The equations, then their multiples by rising degree, none above ``degree``."""
    exact = [g for g in equations if g and g.algebraic and g.degree <= degree]
    left = MOST_MULTIPLES + len(exact)
    for extra in range(degree + 1):
        chosen = (
            (g, places)
            for g in exact
            if g.degree + extra <= degree
            for places in combinations_with_replacement(range(g.n), extra)
        )
        found = [_times_monomial(g, places) for g, places in islice(chosen, left)]
        if found:
            yield found
        left -= len(found)


def _times_monomial(g: Polynomial, places: Sequence[int]) -> Polynomial:
    shift = tuple(places.count(i) for i in range(g.n))
    return Polynomial(g.n, {tuple(map(add, e, shift)): c for e, c in g.terms.items()})
