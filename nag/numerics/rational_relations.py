"""Linear relations with exact coefficients among columns of numbers of many digits.

Coefficients are rational, or sums of roots out of a field that is known.

Columns are reduced one after the other by the independent ones before them. With balls in place of
numbers a column whose rest contains zero everywhere is a combination of those before it as far as
its digits tell, and the radii say how far that is.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import chain
from math import log10

import flint

from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import Exact
from nag.algebra.root_basis import Root, ball_of
from nag.algebra.surd import Surd, normal_sum
from nag.numerics.ball_ranks import known_zero, regular_block
from nag.numerics.digits import LOG10_2, SPARE, bits_of, in_bits

# Digits by which an approximation must be better than its size explains.
EVIDENCE = 20
# Decides: Share of the digits to which a relation must hold to be one; others show in more points.
SHARP = 0.4


class TooFewDigitsError(ArithmeticError):
    """A relation whose coefficients are not recognised in the digits that there are."""


def rank_of_columns(columns: Sequence[Sequence[flint.acb]], digits: int) -> int | None:
    """The rank over the complex numbers of columns of balls; None if these digits do not tell it.

    It is told where elimination leaves nothing but balls that contain zero and are small.
    """
    limit = flint.arb(10) ** int(-SHARP * digits)
    sizes = [max((float(abs(z).mid()) for z in column), default=0.0) for column in columns]
    with in_bits(bits_of(digits + SPARE)):
        rows = [[z / (1 + s) for z in column] for column, s in zip(columns, sizes, strict=True)]
        block = regular_block(rows, len(rows[0]))
        return block.rank if known_zero(chain(*block.rest), limit) else None


class Echelon:
    """Independent columns of real balls in echelon form, pivots chosen among the rows.

    The columns are a lower triangular matrix, but for the order of its rows, times an upper one.

    Attributes:
        digits: of the numbers in the columns; bits: that are computed with.
        roots: members of the basis of sums of roots, 1 first, that coefficients are in.
    """

    def __init__(self, rows: int, digits: int, roots: Sequence[Root] = (1,)) -> None:
        self.roots = tuple(roots)
        self.digits, self.bits = digits, bits_of(digits + SPARE)
        self._rows = rows
        self._pivots: list[int] = []
        self._lower = flint.arb_mat(rows, rows)
        # The inverse of the rows of pivots, in their order.
        self._inverse = flint.arb_mat(rows, rows)
        self._upper: list[list[flint.arb]] = []

    def __len__(self) -> int:
        """Number of independent columns."""
        return len(self._upper)

    def copy(self) -> Echelon:
        """The same columns; adding to the copy leaves these as they are."""
        other = Echelon(self._rows, self.digits, self.roots)
        other._pivots = list(self._pivots)
        other._lower, other._inverse = flint.arb_mat(self._lower), flint.arb_mat(self._inverse)
        other._upper = list(self._upper)
        return other

    def add(self, column: Sequence[flint.arb]) -> list[Exact] | None:
        """Keep a column if it is independent of those kept; else its coefficients in them.

        Raises:
            TooFewDigitsError: if it is dependent and a coefficient is not recognised, or if the
                digits do not tell whether it is dependent.
        """
        with in_bits(self.bits):
            return self._add(column)

    def _add(self, column: Sequence[flint.arb]) -> list[Exact] | None:
        tops, rest = self._reduce_column(column)
        if self._depends(column, rest.values()):
            return self._coefficients(tops)
        self._keep(tops, rest, max(rest, key=lambda i: rest[i].abs_lower()))
        return None

    def relation(self, column: Sequence[flint.arb]) -> list[Exact] | None:
        """The coefficients of a dependent column; None, and nothing is kept, if it is independent.

        Raises:
            TooFewDigitsError: as `add`.
        """
        with in_bits(self.bits):
            return self._relation(column)

    def _relation(self, column: Sequence[flint.arb]) -> list[Exact] | None:
        tops, rest = self._reduce_column(column)
        return self._coefficients(tops) if self._depends(column, rest.values()) else None

    def _reduce_column(
        self, column: Sequence[flint.arb]
    ) -> tuple[list[flint.arb], dict[int, flint.arb]]:
        """A column's part of the upper matrix, and what is left of it in the other rows."""
        known = [column[i] for i in self._pivots]
        padded = [*known, *[0] * (self._rows - len(known))]
        tops = self._inverse * flint.arb_mat(self._rows, 1, padded)
        rest = (flint.arb_mat(self._rows, 1, column) - self._lower * tops).entries()
        free = set(range(self._rows)).difference(self._pivots)
        return tops.entries()[: len(known)], {i: rest[i] for i in sorted(free)}

    def _keep(self, tops: list[flint.arb], rest: dict[int, flint.arb], pivot: int) -> None:
        r = len(self._pivots)
        before = flint.arb_mat(1, self._rows, [self._lower[pivot, k] for k in range(self._rows)])
        row = (before * self._inverse).entries()
        for k in range(r):
            self._inverse[r, k] = -row[k]
        self._inverse[r, r] = flint.arb(1)
        for i, x in rest.items():
            self._lower[i, r] = x / rest[pivot]
        self._lower[pivot, r] = flint.arb(1)
        self._pivots.append(pivot)
        self._upper.append([*tops, rest[pivot]])

    def _depends(self, column: Sequence[flint.arb], rest: Iterable[flint.arb]) -> bool:
        size = max((float(abs(x).mid()) for x in column), default=0.0)
        found = known_zero(rest, flint.arb(10) ** int(-SHARP * self.digits) * (1 + size))
        if found is None:
            raise TooFewDigitsError(f"{self.digits} digits do not tell whether a column depends")
        return found

    def _coefficients(self, tops: list[flint.arb]) -> list[Exact]:
        """Back substitution; the solution recognised."""
        values = list(tops)
        for k in reversed(range(len(values))):
            upper = self._upper[k]
            values[k] = values[k] / upper[k]
            for i in range(k):
                values[i] = values[i] - upper[i] * values[k]
        return [recognise_sum_of_roots(x, self.roots, self.digits) for x in values]


def recognise_rational(x: flint.arb, digits: float) -> Fraction:
    """The rational number in a ball, if its size shows that it is there by no accident.

    A ball of radius ``r`` holds a fraction with denominator ``q`` by chance with probability of
    about ``q^2 r``.

    Args:
        digits: those of a ball without a radius.

    Raises:
        TooFewDigitsError: if there is none.
    """
    radius = _fraction(x.rad())
    digits = _digits(radius) if radius else digits
    middle = _fraction(x.mid())
    found = middle.limit_denominator(10 ** max(0, int(digits - EVIDENCE) // 2))
    if digits < EVIDENCE or abs(found - middle) > radius:
        raise TooFewDigitsError(f"no rational number is recognised in {digits:.0f} digits")
    return found


def recognise_sum_of_roots(x: flint.arb, roots: Sequence[Root], digits: float) -> Exact:
    """The sum of rational multiples of roots in a ball, if its size shows that it is there.

    The shortest integer relation between the number and the roots, by lattice reduction.

    Args:
        roots: members of the basis of sums of roots, 1 first.
        digits: those of a ball without a radius.

    Raises:
        TooFewDigitsError: if there is none.
    """
    if len(roots) == 1 or x.contains(0):
        return recognise_rational(x, digits)
    radius = _fraction(x.rad())
    digits = int(_digits(radius) if radius else digits)
    with in_bits(bits_of(digits + SPARE)):
        values = [x, *map(ball_of, roots)]
        scaled = [round(_fraction(v.mid()) * 10 ** max(0, digits)) for v in values]
        rows = [[*(int(i == j) for j in range(len(values))), n] for i, n in enumerate(scaled)]
        shortest = [int(n) for n in flint.fmpz_mat(rows).lll().tolist()[0]]
        own, parts = -shortest[0], shortest[1:-1]
        spent = sum(log10(1 + abs(n)) for n in shortest[:-1])
        if own and spent + EVIDENCE <= digits:
            terms = {r: flint.fmpq(n, own) for r, n in zip(roots, parts, strict=True)}
            found = normal_sum(terms)
            bits = bits_of(digits + SPARE)
            near = found.ball(bits) if isinstance(found, Surd) else to_rational(found)
            # Digits are whole here: a little more than the radius.
            if abs(near - x).lower() <= flint.arb(10) ** -digits:
                return found
    raise TooFewDigitsError(f"no sum of roots is recognised in {digits:.0f} digits")


def _fraction(x: flint.arb) -> Fraction:
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _digits(x: Fraction) -> float:
    return (x.denominator.bit_length() - x.numerator.bit_length()) * LOG10_2
