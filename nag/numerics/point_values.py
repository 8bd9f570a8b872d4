"""Values and Jacobians of polynomials at points of many digits, in few multiplications.

Every monomial is an earlier one times a power of one variable, and each is made once for all
equations; what is left are products of matrices, in compiled code.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import flint

from nag.numerics.digits import middle
from nag.numerics.power_series import Terms

Exponents = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class PointValues:
    """Polynomials as coefficients of shared monomials.

    Attributes:
        n: number of variables.
        powers: pairs of a variable and an exponent that occur.
        steps: each monomial as an earlier one (-1: one) times one of the powers (-1: one).
        coefficients: of all rows, shape ``(R, M)``, and where their monomials stand.
        slopes: of the derivatives by each variable, likewise; None where it does not occur.
        exact: whether the coefficients are, so that the values are right to any number of digits.
        above: rows that stand before these.
    """

    n: int
    powers: tuple[tuple[int, int], ...]
    steps: tuple[tuple[int, int], ...]
    coefficients: tuple[flint.acb_mat, tuple[int, ...]]
    slopes: tuple[tuple[flint.acb_mat, tuple[int, ...]] | None, ...]
    exact: bool
    above: PointValues | None = None

    @classmethod
    def of(cls, rows: Sequence[Terms], n: int, above: PointValues | None = None) -> PointValues:
        """Rows with coefficients of as many digits as the values shall have, beneath others."""
        made = _Monomials({}, [], {}, [])
        exponents = list(dict.fromkeys(e for row in rows for e, _ in row))
        values = _matrix(rows, exponents)
        places = tuple(made.place(e) for e in exponents)
        slopes: list[tuple[flint.acb_mat, tuple[int, ...]] | None] = []
        for i in range(n):
            here = [e for e in exponents if e[i]]
            if not here:
                slopes.append(None)
                continue
            derived = [[(e, c * e[i]) for e, c in row if e[i]] for row in rows]
            lowered = tuple(made.place((*e[:i], e[i] - 1, *e[i + 1 :])) for e in here)
            slopes.append((_matrix(derived, here), lowered))
        steps, powers = tuple(made.steps), tuple(made.powers)
        matrices = [values, *(s[0] for s in slopes if s is not None)]
        exact = all(c.is_exact() for matrix in matrices for c in matrix.entries())
        exact &= above is None or above.exact
        return cls(n, powers, steps, (values, places), tuple(slopes), exact, above)

    def _powers(self, x: Sequence[flint.acb]) -> dict[int, flint.acb]:
        found: dict[int, flint.acb] = {}
        variable, exponent, value = -1, 0, flint.acb(1)
        for place in sorted(range(len(self.powers)), key=self.powers.__getitem__):
            i, k = self.powers[place]
            if i != variable:
                variable, exponent, value = i, 0, flint.acb(1)
            more = k - exponent
            exponent, value = k, middle(value * (x[i] ** more if more > 1 else x[i]))
            found[place] = value
        return found

    def _monomials(self, x: Sequence[flint.acb], count: int | None = None) -> list[flint.acb]:
        """The first so many monomials; balls, as taking the middle of each costs as much again."""
        powers = self._powers(x)
        powers[-1] = flint.acb(1)
        values: list[flint.acb] = []
        for before, power in self.steps[:count]:
            values.append(powers[power] if before < 0 else values[before] * powers[power])
        return values

    def values(self, x: Sequence[flint.acb]) -> list[flint.acb]:
        """The value of each row."""
        before = [] if self.above is None else self.above.values(x)
        # Those of the equations are made first, further ones of their derivatives after them.
        count = 1 + max(self.coefficients[1], default=-1)
        return before + _product(self.coefficients, self._monomials(x, count))

    def jacobian(self, x: Sequence[flint.acb]) -> list[list[flint.acb]]:
        """The derivatives of each row."""
        monomials = self._monomials(x)
        size = self.coefficients[0].nrows()
        blank = [flint.acb(0)] * size
        columns = [blank if s is None else _product(s, monomials) for s in self.slopes]
        before = [] if self.above is None else self.above.jacobian(x)
        return before + [[column[r] for column in columns] for r in range(size)]


@dataclass(frozen=True, eq=False)
class _Monomials:
    """Monomials in the order in which they are made."""

    known: dict[Exponents, int]
    steps: list[tuple[int, int]]
    factors: dict[tuple[int, int], int]
    powers: list[tuple[int, int]]

    def place(self, e: Exponents) -> int:
        if e not in self.known:
            last = max((i for i, k in enumerate(e) if k), default=-1)
            if last < 0:
                step = (-1, -1)
            else:
                rest = (*e[:last], *(0,) * (len(e) - last))
                step = (self.place(rest) if any(rest) else -1, self._factor(last, e[last]))
            self.known[e] = len(self.steps)
            self.steps.append(step)
        return self.known[e]

    def _factor(self, i: int, k: int) -> int:
        if (i, k) not in self.factors:
            self.factors[i, k] = len(self.powers)
            self.powers.append((i, k))
        return self.factors[i, k]


def _matrix(rows: Sequence[Terms], exponents: Sequence[Exponents]) -> flint.acb_mat:
    place = {e: i for i, e in enumerate(exponents)}
    table = [[flint.acb(0)] * len(exponents) for _ in rows]
    for line, row in zip(table, rows, strict=True):
        for e, c in row:
            line[place[e]] = line[place[e]] + c
    return flint.acb_mat(len(rows), len(exponents), [c for line in table for c in line])


def _product(
    matrix: tuple[flint.acb_mat, tuple[int, ...]], monomials: Sequence[flint.acb]
) -> list[flint.acb]:
    coefficients, places = matrix
    column = flint.acb_mat(len(places), 1, [monomials[p] for p in places])
    return list((coefficients * column).mid().entries())
