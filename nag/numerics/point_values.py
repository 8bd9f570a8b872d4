"""Values and Jacobians of polynomials at points of many digits, in few multiplications.

Every monomial is made once for all equations; what is left are products of matrices, in compiled
code.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import flint

from nag.numerics.power_series import Terms

Exponents = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class PointValues:
    """Polynomials as coefficients of shared monomials.

    Attributes:
        n: number of variables.
        products: the monomials, see `MonomialProducts`.
        coefficients: of all rows, shape ``(R, M)``, and where their monomials stand.
        slopes: of the derivatives by each variable, likewise; None where it does not occur.
        exact: whether the coefficients are, so that the values are right to any number of digits.
        above: rows that stand before these.
    """

    n: int
    products: tuple[tuple[int, int], ...]
    coefficients: tuple[flint.acb_mat, tuple[int, ...]]
    slopes: tuple[tuple[flint.acb_mat, tuple[int, ...]] | None, ...]
    exact: bool
    above: PointValues | None = None

    @classmethod
    def of(cls, rows: Sequence[Terms], n: int, above: PointValues | None = None) -> PointValues:
        """Rows with coefficients of as many digits as the values shall have, beneath others."""
        made = MonomialProducts(n)
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
        matrices = [values, *(s[0] for s in slopes if s is not None)]
        exact = all(c.is_exact() for matrix in matrices for c in matrix.entries())
        exact &= above is None or above.exact
        return cls(n, tuple(made.pairs), (values, places), tuple(slopes), exact, above)

    def _monomials(self, x: Sequence[flint.acb], products: int) -> list[flint.acb]:
        """One, the variables and the first so many products.

        They are balls: to take the middle of each costs as much again.
        """
        values = [flint.acb(1), *x]
        for i, j in self.products[:products]:
            values.append(values[i] * values[j])
        return values

    def values(self, x: Sequence[flint.acb]) -> list[flint.acb]:
        """The value of each row."""
        before = [] if self.above is None else self.above.values(x)
        # Those of the equations are made first, further ones of their derivatives after them.
        products = max(self.coefficients[1], default=0) - self.n
        return before + _product(self.coefficients, self._monomials(x, max(products, 0)))

    def jacobian(self, x: Sequence[flint.acb]) -> list[list[flint.acb]]:
        """The derivatives of each row."""
        monomials = self._monomials(x, len(self.products))
        size = self.coefficients[0].nrows()
        blank = [flint.acb(0)] * size
        columns = [blank if s is None else _product(s, monomials) for s in self.slopes]
        before = [] if self.above is None else self.above.jacobian(x)
        return before + [[column[r] for column in columns] for r in range(size)]


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


@dataclass(frozen=True, eq=False)
class MonomialProducts:
    """A list of one, the variables, and products; a monomial is known by its place there.

    Attributes:
        n: number of variables.
        pairs: places of the factors of each product, both earlier ones.
    """

    n: int
    pairs: list[tuple[int, int]] = field(default_factory=list)
    _places: dict[Exponents, int] = field(default_factory=dict)

    def place(self, e: Exponents) -> int:
        """The place of a monomial, which is appended with all that it needs where it is new."""
        if e not in self._places:
            self._places[e] = self._made(e)
        return self._places[e]

    def _made(self, e: Exponents) -> int:
        last = max((i for i, k in enumerate(e) if k), default=-1)
        if sum(e) <= 1:
            return 1 + last
        first, rest = e[:last], e[last + 1 :]
        half = 0 if any(first) else e[last] // 2
        factors = (*first, half, *rest), (*(0,) * last, e[last] - half, *rest)
        self.pairs.append((self.place(factors[0]), self.place(factors[1])))
        return self.n + len(self.pairs)
