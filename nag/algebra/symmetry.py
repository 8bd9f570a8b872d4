"""Signed permutations of the variables, and which of them carry a system into itself.

Everything here is decided exactly: a signed permutation is a symmetry when it carries every
equation into the ideal of the equations, which is read off by linear algebra over the rationals.
Those that carry every equation to one of the equations, up to its sign, are found: they are the
automorphisms of a graph (McKay & Piperno, Practical graph isomorphism, 2014).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement, islice, product
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
# Vertices of graphs whose automorphisms are looked for: those of larger ones could take long.
MOST_VERTICES = 50_000


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


def find_symmetries(system: PolynomialSystem) -> tuple[SignedPermutation, ...]:
    """Generators of the signed permutations that carry each equation to one, up to its sign.

    They keep the polynomials that must not vanish in the same way, the groups of variables and the
    imaginary unit. Of very large systems none are found.
    """
    import igraph

    graph = _SymmetryGraph.of(system)
    if graph is None:
        return ()
    drawn = igraph.Graph(n=len(graph.colours), edges=graph.edges)
    numbers = {colour: k for k, colour in enumerate(dict.fromkeys(graph.colours))}
    found = drawn.automorphism_group(color=[numbers[colour] for colour in graph.colours])
    maps = [
        # The vertices 2 i and 2 i + 1 are a variable and its negative.
        SignedPermutation(
            tuple(images[2 * i] // 2 for i in range(system.n)),
            tuple(1 - 2 * (images[2 * i] % 2) for i in range(system.n)),
        )
        for images in found
    ]
    return tuple(dict.fromkeys(g for g in maps if not g.is_identity))


@dataclass(frozen=True, eq=False)
class _SymmetryGraph:
    """A graph whose automorphisms are the signed permutations that keep polynomials up to signs.

    Every variable, monomial and polynomial is a pair of adjacent vertices, itself and its negative.
    Powers of variables are pairs if they are odd, single vertices if not. A monomial meets its
    powers in gates, one for each choice of their signs, which lie at the sign of their product; a
    polynomial is adjacent to the monomials with the signs that they have in it.
    """

    colours: list[Any]
    edges: list[tuple[int, int]]

    @classmethod
    def of(cls, system: PolynomialSystem) -> _SymmetryGraph | None:
        """The graph of a system; None if it is too large."""
        graph = cls([], [])
        places = {i: k for k, group in enumerate(system.groups) for i in group}
        unit = system.n - 1 if system.imaginary else -1
        for i in range(system.n):
            graph._add_pair(("variable", places.get(i), i == unit))
        powers: dict[tuple[int, int], tuple[int, ...]] = {}
        for kind, polynomials in (("zero", system.polynomials), ("nonzero", system.nonzero)):
            for f in polynomials:
                own = graph._add_pair((kind,))
                for exponents, c in f.terms.items():
                    size, sign = _size_and_sign(c)
                    one = graph._add_pair(("term", size))
                    graph._join((own[0], one[sign]), (own[1], one[1 - sign]))
                    if not graph._add_gates(exponents, one, powers):
                        return None
        return graph

    def _add(self, colour: Any) -> int:
        self.colours.append(colour)
        return len(self.colours) - 1

    def _add_pair(self, colour: Any) -> tuple[int, int]:
        first, second = self._add(colour), self._add(colour)
        self._join((first, second))
        return first, second

    def _join(self, *edges: tuple[int, int]) -> None:
        self.edges.extend(edges)

    def _power(
        self, i: int, k: int, powers: dict[tuple[int, int], tuple[int, ...]]
    ) -> tuple[int, ...]:
        """The vertices of the power ``k`` of a variable: two that are joined if it is odd."""
        if (i, k) not in powers:
            if k % 2:
                powers[i, k] = self._add(("power", k)), self._add(("power", k))
                self._join((powers[i, k][0], 2 * i), (powers[i, k][1], 2 * i + 1))
            else:
                powers[i, k] = (self._add(("power", k)),)
                self._join((powers[i, k][0], 2 * i), (powers[i, k][0], 2 * i + 1))
        return powers[i, k]

    def _add_gates(
        self,
        exponents: Exponents,
        monomial: tuple[int, int],
        powers: dict[tuple[int, int], tuple[int, ...]],
    ) -> bool:
        """The gates of a monomial; False if the graph becomes too large."""
        meets = [self._power(i, k, powers) for i, k in enumerate(exponents) if k]
        odd = sum(len(each) == 2 for each in meets)
        if len(self.colours) + 2**odd > MOST_VERTICES:
            return False
        for signs in product(*(range(len(each)) for each in meets)):
            gate = self._add(("gate",))
            self._join((gate, monomial[sum(signs) % 2]))
            self._join(*((gate, each[sign]) for each, sign in zip(meets, signs, strict=True)))
        return True


def _size_and_sign(c: Any) -> tuple[str, int]:
    """A number up to its sign, as text, and 0 or 1 by which of the two it is."""
    texts = [repr(c), repr(-c)]
    size = min(texts)
    return size, texts.index(size)


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
