"""Curves of equations in two variables each, joined in those that they share: fibre products.

Variables are the nodes and equations the edges of a tree. Each equation is a curve in a product of
two lines; all together are the fibre product of these curves over the lines that they share. Where
it is irreducible, its degree and its genus follow from those of its factors, and no point of it is
needed: chains of n four-bars have degrees that grow as 2^n.

Let X and C be irreducible curves over one line, with no branch point in common. Then X x C over the
line is irreducible, as the Galois closures of both have no unramified part in common (the line is
simply connected), and smooth over X where C is unramified; Riemann and Hurwitz say its genus. So
the whole is irreducible if no branch point of an equation's curve over one of its variables is led
by the equations between to one of another equation's. A discriminant vanishes at the branch points;
where it has simple zeros only, the curve is smooth, so that it is irreducible and of the genus
(a - 1)(b - 1) for degrees a and b in the two variables. What is led where are resultants.

All of that is decided modulo a large prime, in random coordinates of the lines: polynomials that
keep their degrees and have no common zero modulo a prime have none over the complex numbers. Where
a common zero is found nothing is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import flint
import numpy as np

from nag.algebra.exact_ranks import PrimeField, field_of, residues
from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

# Resultants of higher degree than this take long: seconds, and four times as long for each double.
MOST_DEGREE = 5_000


@dataclass(frozen=True)
class FibreProduct:
    """An irreducible curve, reduced, in the space of all variables.

    Attributes:
        factors: how many curves it is the product of.
        sheets: how many of its points lie over a general value of each variable.
        degree: of its closure; None where two variables may be infinite at once.
        genus: of its smooth model.
    """

    factors: int
    sheets: tuple[int, ...]
    degree: int | None
    genus: int


def find_fibre_product(
    system: PolynomialSystem, at: Sequence[Number], rng: np.random.Generator
) -> FibreProduct | None:
    """The component of a zero set through a point, where that is a product of curves.

    Args:
        at: an exact zero, at which the equations are independent.
        rng: for the coordinates of the lines, which decide nothing but whether there is an answer.

    Returns:
        None where the equations, without the factors that do not vanish at the point, are no tree
        of equations in two variables each; or a curve is singular, a branch point of one may be
        one of another, or what would decide that is too large.

    >>> import nag
    >>> first, second = "x^2*y^2 + x^2 + 3*y^2 - x*y - 4", "2*y^2*z^2 - 2*y^2 + y*z + z^2 - 2"
    >>> system = nag.system([first, second])
    >>> find_fibre_product(system, (1, 1, 1), np.random.default_rng(0))
    FibreProduct(factors=2, sheets=(4, 4, 4), degree=12, genus=5)
    """
    equations = _equations_through(system, at)
    if equations is None or not _are_tree(equations, system.n):
        return None
    field = field_of(equations)
    if field is None:
        return None
    lines = _Lines.of(system.n, field, rng)
    curves = [lines.curve(f) for f in equations]
    whole = [curve for curve in curves if curve is not None]
    if len(whole) < len(curves) or not _have_no_common_branch_points(lines, whole):
        return None
    sheets, genus = _riemann_hurwitz(whole, system.n)
    infinities = [lines.infinity(v) for v in range(system.n)]
    apart = all(lines.never_meet(whole, v, w) for v, w in combinations(infinities, 2))
    return FibreProduct(len(whole), sheets, sum(sheets) if apart else None, genus)


def _equations_through(
    system: PolynomialSystem, at: Sequence[Number]
) -> tuple[Polynomial, ...] | None:
    """The factor of each equation that vanishes at a point; None where there are several."""
    found = []
    for f in system.polynomials:
        if len(f.support) != 2 or not f.algebraic:
            return None
        own = [g for g, _ in factor_into_irreducibles(f) if is_zero(g(at))]
        if len(own) != 1 or len(own[0].support) != 2:
            return None
        found += own
    return tuple(found)


def _are_tree(equations: Sequence[Polynomial], n: int) -> bool:
    """Whether all variables hang together by the equations, without circles."""
    label = list(range(n))
    for f in equations:
        first, second = (label[i] for i in f.support)
        if first == second:
            return False
        label = [first if k == second else k for k in label]
    return len(equations) == n - 1 > 0


@dataclass(frozen=True, eq=False)
class _Places:
    """Places of a variable's line: the zeros of a form in its coordinate, FLINT's ``nmod_poly``."""

    variable: int
    form: Any


@dataclass(frozen=True, eq=False)
class _Curve:
    """The curve of one equation in two variables, smooth in the product of their lines.

    Attributes:
        ends: its variables.
        degrees: of the equation in each of them.
        terms: of the equation modulo the prime, in the coordinates of its variables.
        branches: over each variable the branch points.
    """

    ends: tuple[int, int]
    degrees: tuple[int, int]
    terms: dict[tuple[int, int], int]
    branches: tuple[_Places, _Places]

    @property
    def genus(self) -> int:
        return (self.degrees[0] - 1) * (self.degrees[1] - 1)

    def sheets(self, variable: int) -> int:
        """How many points lie over a value of a variable."""
        return self.degrees[1 - self.ends.index(variable)]

    def other(self, variable: int) -> int:
        return self.ends[1 - self.ends.index(variable)]

    def powers(self, variable: int, modulus: int) -> list[Any]:
        """What each power of a variable is multiplied by, forms in the other variable."""
        k = self.ends.index(variable)
        table = [[0] * (self.degrees[1 - k] + 1) for _ in range(self.degrees[k] + 1)]
        for e, c in self.terms.items():
            table[e[k]][e[1 - k]] = c
        return [flint.nmod_poly(row, modulus) for row in table]


@dataclass(frozen=True, eq=False)
class _Lines:
    """Random coordinates of the variables' lines modulo a prime.

    Attributes:
        ring: of polynomials in x and y.
        coordinates: a, b, c, d of each variable, which is (a x + b) / (c x + d).
    """

    field: PrimeField
    ring: Any
    coordinates: tuple[tuple[int, int, int, int], ...]
    _led: dict[tuple[_Places, tuple[_Curve, ...]], _Places | None] = field(default_factory=dict)

    @classmethod
    def of(cls, n: int, field: PrimeField, rng: np.random.Generator) -> _Lines:
        ring = flint.nmod_mpoly_ctx.get(("x", "y"), modulus=field.modulus)
        drawn = rng.integers(1, field.modulus, size=(n, 4)).tolist()
        return cls(field, ring, tuple(map(tuple, drawn)))

    def infinity(self, variable: int) -> _Places:
        """The place where a variable is infinite."""
        *_, c, d = self.coordinates[variable]
        return _Places(variable, flint.nmod_poly([d, c], self.field.modulus))

    def curve(self, f: Polynomial) -> _Curve | None:
        """The curve of an equation; None if it may be singular, or the coordinates are special."""
        i, j = sorted(f.support)
        degrees = f.degree_in([i]), f.degree_in([j])
        x, y = self.ring.gens()
        powers = [
            [(a * z + b) ** k * (c * z + d) ** (degree - k) for k in range(degree + 1)]
            for z, degree, (a, b, c, d) in zip(
                (x, y), degrees, (self.coordinates[i], self.coordinates[j]), strict=True
            )
        ]
        form = 0 * x
        for e, c in residues(f, self.field).items():
            form += c * powers[0][e[i]] * powers[1][e[j]]
        if form.degrees() != degrees:
            return None
        branches = []
        for k, name in enumerate("yx"):
            sheets = degrees[1 - k]
            own = form.discriminant(name) if sheets > 1 else 0 * x + 1
            places = _Places((i, j)[k], self._in_one_variable(own, k))
            if places.form.degree() != 2 * (sheets - 1) * degrees[k]:
                return None
            branches.append(places)
        if max(degrees) == 1:
            smooth = bool(form[1, 1] * form[0, 0] - form[1, 0] * form[0, 1])
        else:
            own = branches[degrees[1] == 1].form
            smooth = own.gcd(own.derivative()).is_constant()
        terms = {tuple(map(int, e)): int(c) for e, c in form.to_dict().items()}
        return _Curve((i, j), degrees, terms, (branches[0], branches[1])) if smooth else None

    def _in_one_variable(self, form: Any, index: int) -> Any:
        """A form that contains one variable alone, as ``nmod_poly``."""
        terms = {int(e[index]): int(c) for e, c in form.to_dict().items()}
        row = [terms.get(k, 0) for k in range(max(terms, default=0) + 1)]
        return flint.nmod_poly(row, self.field.modulus)

    def never_meet(self, curves: Sequence[_Curve], first: _Places, second: _Places) -> bool:
        """Whether the curves certainly lead no place to one of some others."""
        path = _path(curves, first.variable, second.variable)
        # Led from both ends to the middle, degrees grow to their roots.
        half = len(path) // 2
        ahead = self._lead(tuple(path[:half]), first)
        back = self._lead(tuple(path[half:][::-1]), second)
        if ahead is None or back is None:
            return False
        return bool(ahead.form.gcd(back.form).is_constant())

    def _lead(self, path: tuple[_Curve, ...], places: _Places) -> _Places | None:
        """Where the curves lead places, one after the other; None if these are too many."""
        if not path:
            return places
        key = places, path
        if key not in self._led:
            before = self._lead(path[:-1], places)
            self._led[key] = None if before is None else self._lead_once(path[-1], before)
        return self._led[key]

    def _lead_once(self, curve: _Curve, places: _Places) -> _Places | None:
        """Where a curve leads places: the resultant, by its values."""
        variable, form, p = places.variable, places.form, self.field.modulus
        degree = form.degree() * curve.sheets(variable)
        if degree > MOST_DEGREE:
            return None
        powers, most = curve.powers(variable, p), curve.degrees[curve.ends.index(variable)]
        values, leading = [], form.leading_coefficient()
        for y in range(degree + 1):
            own = flint.nmod_poly([f(y) for f in powers], p)
            # A leading coefficient that vanishes leaves zeros at infinity out.
            values.append(form.resultant(own) * leading ** (most - max(own.degree(), 0)))
        found = _interpolate(values, p)
        if found.degree() != degree:
            return None
        return _Places(curve.other(variable), found)


def _interpolate(values: Sequence[Any], modulus: int) -> Any:
    """The polynomial modulo a prime that has these values at 0, 1, .."""
    n, factorials = len(values), [1]
    for k in range(1, n):
        factorials.append(factorials[-1] * k % modulus)
    parts = []
    for k, value in enumerate(values):
        # The derivative of (x - 0) (x - 1) .. at k.
        slope = factorials[k] * factorials[n - 1 - k] * (-1) ** (n - 1 - k)
        weight = int(value) * pow(slope, -1, modulus) % modulus
        parts.append((flint.nmod_poly([weight], modulus), flint.nmod_poly([-k, 1], modulus)))
    while len(parts) > 1:
        last = parts[len(parts) & ~1 :]
        pairs = zip(parts[::2], parts[1::2], strict=False)
        parts = [(a * q + b * p, p * q) for (a, p), (b, q) in pairs] + last
    return parts[0][0]


def _path(curves: Sequence[_Curve], first: int, last: int) -> list[_Curve]:
    """The curves that lead from one variable to another."""
    led: dict[int, list[_Curve]] = {first: []}
    frontier = [first]
    for variable in frontier:
        for curve in curves:
            if variable in curve.ends and curve.other(variable) not in led:
                led[curve.other(variable)] = [*led[variable], curve]
                frontier.append(curve.other(variable))
    return led[last]


def _have_no_common_branch_points(lines: _Lines, curves: Sequence[_Curve]) -> bool:
    """Whether no branch point of a curve is certainly led to one of another."""
    for one, other in combinations(curves, 2):
        # The ends that face each other.
        u, v = min(
            ((u, v) for u in one.ends for v in other.ends),
            key=lambda ends: len(_path(curves, *ends)),
        )
        first, second = one.branches[one.ends.index(u)], other.branches[other.ends.index(v)]
        if not lines.never_meet(curves, first, second):
            return False
    return True


def _riemann_hurwitz(curves: Sequence[_Curve], n: int) -> tuple[tuple[int, ...], int]:
    """How many points of the product lie over each variable's values, and its genus."""
    start = curves[0].ends[0]
    sheets, euler = {start: 1}, -2
    left = list(curves)
    while left:
        curve = next(c for c in left if sheets.keys() & set(c.ends))
        left.remove(curve)
        (known,) = sheets.keys() & set(curve.ends)
        own, over = curve.sheets(known), sheets[known]
        euler = own * euler + over * (2 * curve.genus - 2 + 2 * own)
        sheets = {v: own * count for v, count in sheets.items()}
        sheets[curve.other(known)] = over * curve.sheets(curve.other(known))
    return tuple(sheets[v] for v in range(n)), euler // 2 + 1
