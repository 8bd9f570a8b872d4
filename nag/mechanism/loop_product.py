"""Products of joints along loops and paths, and the closure of a loop: a product that is real.

Some factors are eliminated linearly. With B their product and A the product of the others, the loop
closes when conj(A) = B up to a real factor. B ranges over the part of norm not zero, on Study's
quadric, of a linear space W:

- two factors that are turns or slides, W = span(1, g, k, gk). If Study's form does not vanish on W,
  it is there a multiple of w00 w11 - w10 w01, so that a displacement in W is a product already;
  else this one quadric is added;
- a spherical or planar joint, W = span of its generators: every displacement in W is one of it;
- one turn or slide, W = span(1, g), or nothing, W = span(1), where other loops use the rest: these
  are displacements as they are.

So each loop is four linear equations in A (and the quadric), or six or seven, multilinear in the
other factors' coordinates. What is eliminated follows linearly: the matrix (w_ij) has rank one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from nag.algebra.exact_ranks import left_inverse, null_space, rank
from nag.algebra.factoring import ring
from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.errors import NagError
from nag.mechanism.axes import dot
from nag.mechanism.graph import Joint
from nag.mechanism.joint_factors import (
    UNIT,
    Charts,
    Factor,
    factors_of_joint,
    mode_constant,
    reversed_generators,
)
from nag.mechanism.quaternion import (
    DualQuaternion,
    dual_conjugate,
    dual_multiply,
    translation,
)


def _as_given(c: Number) -> Number:
    return c


@dataclass(frozen=True)
class Element:
    """A factor as it stands in a loop's product, or a constant.

    Attributes:
        factor: the factor, or None for a constant.
        generators: its generators in the direction in which the loop runs.
    """

    factor: Factor | None
    generators: tuple[DualQuaternion, ...]


@dataclass(frozen=True)
class Closure:
    """A loop whose last elements are eliminated.

    Attributes:
        kept: the elements of A.
        eliminated: the elements of B, if any.
        basis: of W, each a vector of 8 entries: 1, g, k, gk, or the generators of one factor, or 1.
        quadric: whether w00 w11 = w10 w01 is needed as well.
    """

    kept: tuple[Element, ...]
    eliminated: tuple[Element, ...]
    basis: tuple[tuple[Number, ...], ...]
    quadric: bool

    @cached_property
    def annihilator(self) -> tuple[tuple[Number, ...], ...]:
        """Rows whose products with conj(A) vanish when the loop closes."""
        return tuple(null_space(self.basis, 8))

    @cached_property
    def coordinates(self) -> tuple[tuple[Number, ...], ...]:
        """Rows that give conj(A) in the basis of W."""
        return tuple(left_inverse(self.basis))

    @property
    def lost(self) -> tuple[Factor, ...]:
        """The factors that are eliminated."""
        return tuple(e.factor for e in self.eliminated if e.factor is not None)

    @property
    def equations(self) -> int:
        """Number of equations, before dependent ones are left out."""
        return 8 - len(self.basis) + int(self.quadric)

    def polynomials(self, charts: Charts) -> list[Polynomial]:
        """The loop's equations in the charts' variables."""
        values, convert = charts.values, _as_given
        rows, inverse = self.annihilator, self.coordinates if self.quadric else ()
        field = None
        if self._is_rational:
            # FLINT multiplies polynomials in a twentieth of the time.
            field, convert = ring(charts.n), to_rational
            values = {f: tuple(map(field.of, values[f])) for f in factors_in(self.kept)}
            rows, inverse = ([list(map(convert, r)) for r in some] for some in (rows, inverse))
        flat = conjugate_product(self.kept, values.__getitem__, convert)
        equations = closing_equations(flat, rows, inverse, convert(Fraction(0)))
        # Of a loop in which all that moves is held or eliminated they are numbers.
        if field is None:
            return [Polynomial(charts.n, {}) + f for f in equations]
        return [field.polynomial(field.context.constant(0) + f) for f in equations]

    @property
    def _is_rational(self) -> bool:
        """Whether no constant of the loop is a square root or another such number."""
        constants = (x for e in self.kept for g in e.generators for part in g for x in part)
        rows = (x for row in (*self.annihilator, *self.coordinates) for x in row)
        return all(isinstance(x, int | Fraction) for x in (*constants, *rows))

    def recover(
        self, coordinates: Callable[[Factor], Sequence[Any]], convert: Callable[[Number], Any]
    ) -> dict[Factor, tuple[Any, ...]]:
        """Homogeneous coordinates of the eliminated factors, in the arithmetic of the kept ones."""
        flat = conjugate_product(self.kept, coordinates, convert)
        zero = convert(Fraction(0))
        w = [
            sum((convert(y) * x for y, x in zip(row, flat, strict=True)), zero)
            for row in self.coordinates
        ]
        if len(self.lost) == 2:
            return dict(zip(self.lost, split_product(w), strict=True))
        return {factor: tuple(w) for factor in self.lost}


def closing_equations(
    flat: Sequence[Any],
    annihilator: Sequence[Sequence[Any]],
    coordinates: Sequence[Sequence[Any]] = (),
    zero: Any = Fraction(0),
) -> list[Any]:
    """What vanishes when a loop closes.

    Args:
        flat: the entries of conj(A).
        annihilator: rows whose products with these vanish.
        coordinates: rows that give them in the basis of W, where w00 w11 = w10 w01 is needed.
        zero: of the rows' arithmetic.
    """
    equations = [_combine(row, flat, zero) for row in annihilator]
    if coordinates:
        w00, w10, w01, w11 = (_combine(row, flat, zero) for row in coordinates)
        equations.append(w00 * w11 - w10 * w01)
    return equations


def split_product(w: Sequence[Any], size: Callable[[Any], float] = abs) -> tuple[Any, Any]:
    """Homogeneous coordinates of two factors from w00, w10, w01 and w11, those of their product."""
    matrix = ((w[0], w[2]), (w[1], w[3]))
    if any(isinstance(x, np.ndarray) for x in w):
        return _split_products(np.array(np.broadcast_arrays(*w)))
    # The matrix has rank one; its largest entry is never zero, w00 is at half a turn.
    row, column = max(
        ((i, j) for i in (0, 1) for j in (0, 1)), key=lambda ij: size(matrix[ij[0]][ij[1]])
    )
    return (matrix[0][column], matrix[1][column]), matrix[row]


def _split_products(w: np.ndarray) -> tuple[Any, Any]:
    """The same of many products at once, shape ``(4, k)``."""
    matrix = w[[0, 2, 1, 3]].reshape(2, 2, -1)
    row, column = np.divmod(np.abs(matrix).reshape(4, -1).argmax(axis=0), 2)
    each = np.arange(w.shape[1])
    first, second = matrix[:, column, each], matrix[row, :, each].T
    return tuple(first), tuple(second)


def conjugate_product(
    elements: Sequence[Element],
    coordinates: Callable[[Factor], Sequence[Any]],
    convert: Callable[[Number], Any] = _as_given,
) -> list[Any]:
    """conj(A) as 8 entries, for the product A of the elements."""
    product: DualQuaternion | None = None
    for element in elements:
        value = combination(element, coordinates, convert)
        product = value if product is None else dual_multiply(product, value)
    if product is None:
        product = tuple(tuple(map(convert, part)) for part in UNIT)
    return [x for part in dual_conjugate(product) for x in part]


def combination(
    element: Element,
    coordinates: Callable[[Factor], Sequence[Any]],
    convert: Callable[[Number], Any],
) -> DualQuaternion:
    """The element's value: its generators, combined with its factor's coordinates."""
    if element.factor is None:
        (constant,) = element.generators
        return tuple(tuple(convert(x) for x in part) for part in constant)
    weights = coordinates(element.factor)
    parts = []
    for part in (0, 1):
        entries = []
        for i in range(4):
            terms = [
                w * convert(g[part][i])
                for w, g in zip(weights, element.generators, strict=True)
                if not is_zero(g[part][i])
            ]
            entries.append(sum(terms[1:], terms[0]) if terms else convert(Fraction(0)))
        parts.append(tuple(entries))
    return parts[0], parts[1]


def closures(elements: Sequence[Element]) -> Iterator[Closure]:
    """All ways to eliminate one spherical or planar joint or two neighbouring factors of a loop."""
    n = len(elements)
    for start in range(n):
        turned = [*elements[start:], *elements[:start]]
        if turned[-1].factor is None:
            continue
        for length in range(1, n + 1):
            piece = turned[n - length :]
            factors = [e.factor for e in piece if e.factor is not None]
            if sum(f.dimension for f in factors) > (3 if len(factors) == 1 else 2):
                break
            if piece[0].factor is None:
                continue
            if factors[0].dimension == 3 or len(factors) == 2:
                closure = closure_of(turned[: n - length], piece)
                if closure is not None:
                    yield closure
                break


def narrow_closures(elements: Sequence[Element]) -> Iterator[Closure]:
    """All ways to eliminate one turn or slide of a loop, and that to eliminate nothing."""
    for i, element in enumerate(elements):
        if element.factor is not None and element.factor.dimension == 1:
            closure = closure_of([*elements[i + 1 :], *elements[:i]], [element])
            if closure is not None:
                yield closure
    whole = closure_of(elements, ())
    if whole is not None:
        yield whole


def closure_of(kept: Sequence[Element], piece: Sequence[Element]) -> Closure | None:
    """The closure that eliminates ``piece``; None where its products are dependent."""
    products: list[DualQuaternion] = [UNIT]
    for element in piece:
        # The first factor's index runs fastest: 1, g, k, gk.
        products = [dual_multiply(p, g) for g in element.generators for p in products]
    basis = tuple(tuple(x for part in q for x in part) for q in products)
    if rank(basis) < len(basis):
        return None
    pair = sum(e.factor is not None for e in piece) == 2
    study = (dot4(p[0], q[1]) + dot4(p[1], q[0]) for p in products for q in products)
    return Closure(
        kept=tuple(kept),
        eliminated=tuple(piece),
        basis=basis,
        quadric=pair and all(is_zero(x) for x in study),
    )


def dot4(p: Sequence[Any], q: Sequence[Any]) -> Any:
    """The scalar product of two quaternions."""
    return p[0] * q[0] + dot(p[1:], q[1:])


def _combine(row: Sequence[Any], flat: Sequence[Any], zero: Any) -> Any:
    return sum((f * c for c, f in zip(row, flat, strict=True)), zero)


def joint_elements(joint: Joint, mode: int, forward: bool) -> tuple[Element, ...]:
    """The elements of a joint in the direction from its first body to its second.

    ``forward`` is whether its coordinates count in that direction.
    """
    return tuple(_joint_elements(joint, mode, forward))


def _joint_elements(joint: Joint, mode: int, forward: bool) -> Iterator[Element]:
    for factor in factors_of_joint(joint):
        generators = factor.generators
        yield Element(factor, generators if forward else reversed_generators(generators))
    if mode:
        yield Element(None, (mode_constant(joint, mode),))


def factors_in(elements: Sequence[Element]) -> list[Factor]:
    """The factors of a product, each once."""
    return list(dict.fromkeys(e.factor for e in elements if e.factor is not None))


def opposite(elements: Sequence[Element]) -> list[Element]:
    """The elements of the opposite displacement."""
    return [Element(e.factor, reversed_generators(e.generators)) for e in reversed(elements)]


def displacement(
    elements: Sequence[Element],
    values: Mapping[Factor, Sequence[Any]],
    convert: Callable[[Number], Any],
) -> DualQuaternion:
    """The product of the elements, of any length."""
    result: DualQuaternion | None = None
    for element in elements:
        value = combination(element, values.__getitem__, convert)
        result = value if result is None else dual_multiply(result, value)
    if result is None:
        raise NagError("a product of nothing")
    return result


def move_place(motion: DualQuaternion, place: Sequence[Any]) -> tuple[Any, ...]:
    """Where a displacement takes a point."""
    zero = 0 * place[0]
    one = zero + 1
    # A translation by the place, then the displacement: the origin goes where the place goes.
    at = ((one, zero, zero, zero), (zero, *(x / 2 for x in place)))
    numerators, squared = translation(dual_multiply(motion, at))
    return tuple(x / squared for x in numerators)
