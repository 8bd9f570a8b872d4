"""Systems of polynomials and linear rows in balls: values, Jacobians, sizes of the terms.

In as many bits as each call asks for, whatever precision was worked in before. Every monomial is
made once for all rows, of two earlier ones. A row of many terms is a matrix between monomials in
its first variables and in its last ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

import flint
import numpy as np

from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import Irrational
from nag.algebra.polynomial import Polynomial
from nag.numerics.digits import in_bits, to_ball

# Bits in which the value of an expression may be off, which is evaluated to more than those asked.
GUARD = 4
# Systems that are kept ready to be evaluated.
KEPT = 128
# Terms from which on a row is a matrix, of which this part at least are terms.
MANY_TERMS, FILLED = 200, 0.25

# The variables of a monomial, in their order, each with its exponent.
Factors = tuple[tuple[int, int], ...]


def factors_of(exponents: Iterable[int]) -> Factors:
    """A monomial by its variables.

    >>> factors_of((0, 2, 1))
    ((1, 2), (2, 1))
    """
    return tuple((i, k) for i, k in enumerate(exponents) if k)


@dataclass(frozen=True, eq=False)
class MonomialProducts:
    """A list of one, the variables, and products; a monomial is known by its place there.

    Attributes:
        n: number of variables.
        pairs: places of the factors of each product, both earlier ones.
    """

    n: int
    pairs: list[tuple[int, int]] = field(default_factory=list)
    _places: dict[Factors, int] = field(default_factory=dict)

    def place(self, monomial: Factors) -> int:
        """The place of a monomial, which is appended with all that it needs where it is new."""
        found = self._places.get(monomial)
        if found is None:
            found = self._places[monomial] = self._append(monomial)
        return found

    def _append(self, monomial: Factors) -> int:
        if not monomial:
            return 0
        *first, (i, k) = monomial
        if first:
            parts: tuple[Factors, Factors] = tuple(first), ((i, k),)
        elif k == 1:
            return 1 + i
        else:
            parts = ((i, k // 2),), ((i, k - k // 2),)
        self.pairs.append((self.place(parts[0]), self.place(parts[1])))
        return self.n + len(self.pairs)

    def values(self, x: Sequence[Any]) -> list[Any]:
        """The values of all of them at a point in balls."""
        values = [flint.acb(1), *x]
        for i, j in self.pairs:
            values.append(values[i] * values[j])
        return values


@dataclass(frozen=True, eq=False)
class Slopes:
    """The derivatives of a row: a matrix of coefficients times a column of monomials.

    Attributes:
        places: in the Jacobian matrix, row by row, one for each variable.
        monomials: in the derivatives, as places; that of one alone where the row is linear.
        entries: the matrix row by row, each a coefficient of the row and a factor, or None.
    """

    places: tuple[int, ...]
    monomials: tuple[int, ...]
    entries: tuple[tuple[Any, int] | None, ...]


@dataclass(frozen=True, eq=False)
class DenseRow:
    """A row of many terms: u C v, with monomials u in its first variables and v in its last ones.

    C v and u C, two products in compiled code, give the derivatives by all variables as well.

    Attributes:
        monomials: those of u and v, and of their derivatives.
        sides: places of the entries of u and of v.
        lowered: for u and v, their derivatives by each variable: its index, and for each entry that
            changes its index, its exponent and the place of what it becomes.
        entries: of C that are not zero: row, column, coefficient.
    """

    monomials: MonomialProducts
    sides: tuple[tuple[int, ...], tuple[int, ...]]
    lowered: tuple[tuple[tuple[int, tuple[tuple[int, int, int], ...]], ...], ...]
    entries: tuple[tuple[int, int, Any], ...]
    _matrices: dict[int, flint.acb_mat] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, row: Sequence[tuple[Any, Factors]], n: int) -> DenseRow | None:
        """None where there are few terms, or much of the matrix is empty."""
        if len(row) < MANY_TERMS:
            return None
        support = sorted({i for _, f in row for i, _ in f})
        cut = support[len(support) // 2]
        sides: tuple[dict[Factors, int], dict[Factors, int]] = {}, {}
        entries = []
        for c, f in row:
            k = sum(i < cut for i, _ in f)
            places = (
                side.setdefault(part, len(side))
                for side, part in zip(sides, (f[:k], f[k:]), strict=True)
            )
            entries.append((*places, c))
        if len(row) < FILLED * len(sides[0]) * len(sides[1]):
            return None
        made = MonomialProducts(n)
        lowered = []
        for side in sides:
            derivatives: dict[int, list[tuple[int, int, int]]] = {}
            for f, index in side.items():
                for at, (i, k) in enumerate(f):
                    derivatives.setdefault(i, []).append((index, k, made.place(_lower(f, at))))
            lowered.append(tuple((i, tuple(found)) for i, found in derivatives.items()))
        first, last = (tuple(map(made.place, side)) for side in sides)
        return cls(made, (first, last), tuple(lowered), tuple(entries))

    def value(self, x: Sequence[Any], bits: int) -> flint.acb:
        """The value at a point in balls."""
        u, v = self._monomials_at(self.monomials.values(x))
        return (u * (self._matrix(bits) * v.transpose()))[0, 0]

    def slopes(self, x: Sequence[Any], bits: int) -> Iterator[tuple[int, flint.acb]]:
        """The variables that occur, each with the derivative by it."""
        at, matrix = self.monomials.values(x), self._matrix(bits)
        u, v = self._monomials_at(at)
        beside = matrix * v.transpose(), (u * matrix).transpose()
        for side, column in zip(self.lowered, beside, strict=True):
            for i, changed in side:
                line = flint.acb_mat(1, len(changed), [at[place] * k for _, k, place in changed])
                factors = [column[index, 0] for index, _, _ in changed]
                yield i, (line * flint.acb_mat(len(factors), 1, factors))[0, 0]

    def size(self, x: Sequence[Any]) -> flint.arb:
        """The sum of the absolute values of the terms, in the bits that are worked in."""
        at = [abs(z) for z in self.monomials.values(x)]
        first, last = self.sides
        return sum(
            (abs(in_ball(c)) * at[first[i]] * at[last[j]] for i, j, c in self.entries), flint.arb(0)
        )

    def _monomials_at(self, at: Sequence[Any]) -> Iterator[flint.acb_mat]:
        """u and v, each a row."""
        return (flint.acb_mat(1, len(side), [at[k] for k in side]) for side in self.sides)

    def _matrix(self, bits: int) -> flint.acb_mat:
        """C, in these bits; what rounds nothing in fewer bits is the same in more."""
        if bits not in self._matrices:
            known = (m for b, m in self._matrices.items() if b < bits and m.mid() == m)
            found = next(known, None)
            if found is None:
                rows: list[list[Any]] = [[0] * len(self.sides[1]) for _ in self.sides[0]]
                for i, j, c in self.entries:
                    rows[i][j] = in_ball(c)
                found = flint.acb_mat(rows)
            self._matrices[bits] = found
        return self._matrices[bits]


@dataclass(frozen=True, eq=False)
class BallPolynomials:
    """Rows of terms: pairs of an exact coefficient and the monomial that it stands before.

    Attributes:
        above: rows that stand before these.
    """

    n: int
    rows: tuple[tuple[tuple[Any, Factors], ...], ...]
    above: BallPolynomials | None = None
    _terms: dict[int, list[list[tuple[flint.acb, int]]]] = field(default_factory=dict, repr=False)
    _constants: dict[int, _Constants] = field(default_factory=dict, repr=False)
    _parts: dict[tuple[int, ...], BallPolynomials] = field(default_factory=dict, repr=False)
    _known_dense: dict[int, DenseRow | None] = field(default_factory=dict, repr=False)

    @classmethod
    def of(
        cls, polynomials: Sequence[Polynomial], slices: np.ndarray | None = None
    ) -> BallPolynomials:
        """Exact polynomials, and rows on ``(1, x)``, of exact doubles, shape ``(d, 1 + n)``."""
        n = polynomials[0].n if slices is None else slices.shape[1] - 1
        exact = _of_polynomials(tuple(polynomials), n)
        if slices is None or not len(slices):
            return exact
        rows = []
        for row in slices:
            terms = [(complex(c), ((j, 1),)) for j, c in enumerate(row[1:])]
            rows.append(((complex(row[0]), ()), *terms))
        return cls(n, tuple(rows), exact)

    @property
    def all_rows(self) -> tuple[tuple[tuple[Any, Factors], ...], ...]:
        """The rows, those above first."""
        return self.rows if self.above is None else self.above.all_rows + self.rows

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.rows) + (0 if self.above is None else len(self.above))

    def rows_of(self, chosen: Sequence[int]) -> BallPolynomials:
        """Some of the rows."""
        key = tuple(chosen)
        if key not in self._parts:
            rows = self.all_rows
            part = BallPolynomials(self.n, tuple(rows[i] for i in key))
            part._known_dense.update({k: self._dense_row(i) for k, i in enumerate(key)})
            self._parts[key] = part
        return self._parts[key]

    def _dense_row(self, i: int) -> DenseRow | None:
        """A row of many terms, also one of those above."""
        first = len(self) - len(self.rows)
        if self.above is not None and i < first:
            return self.above._dense_row(i)
        if i - first not in self._known_dense:
            self._known_dense[i - first] = DenseRow.of(self.rows[i - first], self.n)
        return self._known_dense[i - first]

    @cached_property
    def _dense(self) -> list[DenseRow | None]:
        """The rows, without those above, that are of many terms; None for each other."""
        first = len(self) - len(self.rows)
        return [self._dense_row(first + i) for i in range(len(self.rows))]

    @cached_property
    def _short(self) -> list[tuple[tuple[Any, Factors], ...]]:
        """The rows without the terms of those that are of many."""
        pairs = zip(self.rows, self._dense, strict=True)
        return [() if dense else row for row, dense in pairs]

    def values(self, x: Sequence[flint.acb], bits: int) -> flint.acb_mat:
        """Values, a column."""
        with in_bits(bits):
            values = self._values(x, bits)
            return flint.acb_mat(len(values), 1, values)

    def _values(self, x: Sequence[flint.acb], bits: int) -> list[flint.acb]:
        if bits not in self._terms:
            self._terms[bits] = self._terms_in(bits)
        at = self._monomials.values(x)
        values = [] if self.above is None else self.above._values(x, bits)
        for row, dense in zip(self._terms[bits], self._dense, strict=True):
            if dense is not None:
                values.append(dense.value(x, bits))
                continue
            # Terms that cancel exactly leave no error, as they would in a product of matrices.
            total = flint.acb(0)
            for c, place in row:
                total = total + c * at[place]
            values.append(total)
        return values

    def _terms_in(self, bits: int) -> list[list[tuple[flint.acb, int]]]:
        # What rounds nothing in fewer bits is the same in more.
        for fewer, rows in self._terms.items():
            if fewer < bits and all(c.is_exact() for row in rows for c, _ in row):
                return rows
        place = self._monomials.place
        return [[(in_ball(c), place(f)) for c, f in row] for row in self._short]

    def sizes(self, x: Sequence[Any], bits: int) -> list[flint.arb]:
        """Sums of the absolute values of each row's terms at a point."""
        with in_bits(bits):
            at = [abs(z) for z in self._monomials.values(x)]
            sizes = [] if self.above is None else self.above.sizes(x, bits)
            for row, dense in zip(self._short, self._dense, strict=True):
                terms = ((in_ball(c), self._monomials.place(f)) for c, f in row)
                total = sum((abs(c) * at[i] for c, i in terms), flint.arb(0))
                sizes.append(total if dense is None else dense.size(x))
            return sizes

    def jacobian(self, x: Sequence[flint.acb], bits: int) -> flint.acb_mat:
        """The Jacobian matrix."""
        with in_bits(bits):
            return flint.acb_mat(len(self), self.n, self._jacobian(x, bits))

    def _jacobian(self, x: Sequence[flint.acb], bits: int) -> list[flint.acb]:
        monomials, slopes = self._slopes
        if bits not in self._constants:
            self._constants[bits] = self._constants_in(bits)
        constants = self._constants[bits]
        entries = list(constants.entries)
        at = monomials.values(x) if constants.matrices else []
        for k, matrix in constants.matrices:
            row = slopes[k]
            column = flint.acb_mat(len(row.monomials), 1, [at[m] for m in row.monomials])
            for place, slope in zip(row.places, (matrix * column).entries(), strict=True):
                entries[place] = slope
        for k, dense in enumerate(self._dense):
            for i, slope in dense.slopes(x, bits) if dense is not None else ():
                entries[k * self.n + i] = slope
        return entries if self.above is None else self.above._jacobian(x, bits) + entries

    def _constants_in(self, bits: int) -> _Constants:
        for fewer, constants in self._constants.items():
            if fewer < bits and constants.exact:
                return constants
        return _constants_of(self._slopes[1], len(self.rows) * self.n)

    @cached_property
    def _monomials(self) -> MonomialProducts:
        made = MonomialProducts(self.n)
        for row in self._short:
            for _, f in row:
                made.place(f)
        return made

    @cached_property
    def _slopes(self) -> tuple[MonomialProducts, list[Slopes]]:
        made = MonomialProducts(self.n)
        derivatives = [
            [(i, made.place(_lower(f, at)), (c, k)) for c, f in row for at, (i, k) in enumerate(f)]
            for row in self._short
        ]
        return made, [_slopes_of(row, r * self.n) for r, row in enumerate(derivatives)]


@lru_cache(maxsize=KEPT)
def _of_polynomials(polynomials: tuple[Polynomial, ...], n: int) -> BallPolynomials:
    """The same polynomials are asked about at one point after another."""
    rows = tuple(tuple((c, factors_of(e)) for e, c in f.terms.items()) for f in polynomials)
    return BallPolynomials(n, rows)


def _lower(factors: Factors, place: int) -> Factors:
    """The factors of the derivative by the variable at a place."""
    i, k = factors[place]
    return factors[:place] + (((i, k - 1),) if k > 1 else ()) + factors[place + 1 :]


def _slopes_of(derivatives: Sequence[tuple[int, int, tuple[Any, int]]], first: int) -> Slopes:
    """The derivatives of a row whose place in the Jacobian matrix begins at ``first``."""
    variables = {i: v for v, i in enumerate(sorted({i for i, _, _ in derivatives}))}
    columns: dict[int, int] = {}
    for _, place, _ in derivatives:
        columns.setdefault(place, len(columns))
    entries: list[tuple[Any, int] | None] = [None] * (len(variables) * len(columns))
    for i, place, entry in derivatives:
        entries[variables[i] * len(columns) + columns[place]] = entry
    return Slopes(tuple(first + i for i in variables), tuple(columns), tuple(entries))


@dataclass(frozen=True, eq=False)
class _Constants:
    """What is constant in a Jacobian matrix, in some bits.

    Attributes:
        entries: of the matrix, row by row; 0 where they are not constant.
        matrices: for rows that are not linear, by their indices: those that monomials are
            multiplied by.
        exact: whether nothing is rounded.
    """

    entries: list[flint.acb]
    matrices: list[tuple[int, flint.acb_mat]]
    exact: bool


def _constants_of(rows: Sequence[Slopes], size: int) -> _Constants:
    entries, matrices, exact = [flint.acb(0)] * size, [], True
    zero = flint.acb(0)
    for k, row in enumerate(rows):
        # A term has a derivative by each of its variables, with the same coefficient.
        terms = {id(e[0]): e[0] for e in row.entries if e is not None}
        balls = {key: in_ball(c) for key, c in terms.items()}
        values = [zero if e is None else balls[id(e[0])] * e[1] for e in row.entries]
        exact = exact and all(c.is_exact() for c in values)
        if row.monomials == (0,):
            for place, c in zip(row.places, values, strict=True):
                entries[place] = c
        elif values:
            matrices.append((k, flint.acb_mat(len(row.places), len(row.monomials), values)))
    return _Constants(entries, matrices, exact)


def in_ball(c: Any) -> flint.acb:
    """An exact coefficient in the digits that are worked with; a pair has an imaginary part."""
    kind = type(c)
    if kind is Fraction:
        return flint.acb(to_rational(c))
    if kind is complex or kind is flint.acb:
        return flint.acb(c)
    if kind is tuple:
        if type(c[0]) is type(c[1]) is Fraction:
            return flint.acb(flint.arb(to_rational(c[0])), flint.arb(to_rational(c[1])))
        return in_ball(c[0]) + in_ball(c[1]) * flint.acb(0, 1)
    value = to_ball(c)
    if isinstance(c, Irrational):
        off = abs(value) * flint.arb(2) ** (GUARD - flint.ctx.prec)
        value = value + flint.acb(flint.arb(0, off.upper()))
    return value
