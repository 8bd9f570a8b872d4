"""Exact polynomials, scaled about a point, at any number of digits and modulo primes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import floor, gcd, lcm, log2, prod
from operator import mul
from typing import Any

import flint
import numpy as np

from nag.algebra.exact_ranks import PrimeField
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial, sum_terms
from nag.numerics.ball_polynomials import BallPolynomials, factors_of
from nag.numerics.digits import LOG10_2, bits_of, in_bits, log_norm, to_ball
from nag.numerics.power_series import Terms


@dataclass(frozen=True, eq=False)
class ExactSystem:
    """Polynomials in scaled variables ``y_i = x_i / 2^scales_i``, coefficients of order one.

    Attributes:
        n: number of variables.
        rows: exponents and exact coefficients of each polynomial.
        scales: integers, ``n`` of them.
    """

    n: int
    rows: tuple[tuple[tuple[tuple[int, ...], Any], ...], ...]
    scales: tuple[int, ...]
    _known: dict[int, list[Terms]] = field(default_factory=dict, repr=False)
    _above: ExactSystem | None = field(default=None, repr=False)

    @classmethod
    def of(
        cls,
        polynomials: Sequence[Polynomial],
        x: np.ndarray,
        slices: np.ndarray | None = None,
        units: np.ndarray | None = None,
    ) -> ExactSystem:
        """The polynomials and slices, rows on ``(1, x)``, scaled to coordinates of at most one.

        Args:
            units: sizes of the variables' units, to be rounded up to powers of two; by default
                those of the coordinates that are larger than one.
        """
        n = len(x)
        if units is None:
            units = np.maximum(np.abs(np.asarray(x, dtype=complex)), 1.0)
        scales = tuple(int(k) for k in np.ceil(np.log2(units)))
        rows = [_scale_terms(f.terms.items(), scales) for f in polynomials if f]
        units = [tuple(int(i == j) for j in range(n)) for i in range(n)]
        for a in np.zeros((0, 1 + n)) if slices is None else slices:
            rows.append(_scale_terms(zip([(0,) * n, *units], map(complex, a), strict=True), scales))
        return cls(n, tuple(rows), scales)

    def with_row(self, row: Sequence[tuple[tuple[int, ...], Any]]) -> ExactSystem:
        """The system with one more polynomial in the scaled variables."""
        made = ExactSystem(self.n, (*self.rows, tuple(row)), self.scales, _above=self)
        for digits, rows in self._known.items():
            made._known[digits] = [*rows, *_in_digits(made.rows[-1:], digits)]
        return made

    def at(self, digits: int) -> list[Terms]:
        """The rows with coefficients of so many digits."""
        if digits not in self._known:
            self._known[digits] = _in_digits(self.rows, digits)
        return self._known[digits]

    @cached_property
    def functions(self) -> BallPolynomials:
        """The rows in balls."""
        above = None if self._above is None else self._above.functions
        rows = self.rows if above is None else self.rows[len(above) :]
        terms = tuple(tuple((c, factors_of(e)) for e, c in row) for row in rows)
        return BallPolynomials(self.n, terms, above)

    def values_at(self, digits: int) -> PointValues:
        """The rows as functions at points of so many digits."""
        return PointValues(self.functions, bits_of(digits))

    def modulo(self, field: PrimeField) -> list[Terms]:
        """The rows modulo a prime.

        Raises:
            ZeroDivisionError: if it divides a denominator.
        """
        return [[(e, field.of(c)) for e, c in row] for row in self.rows]

    @property
    def rational(self) -> bool:
        return all(isinstance(c, Fraction) for row in self.rows for _, c in row)

    @cached_property
    def most_zeros(self) -> float:
        """Bezout's bound of the multiplicity of an isolated zero; 0 if none is isolated."""
        degrees = sorted(self._degrees, reverse=True)
        return float(prod(degrees[: self.n])) if len(degrees) >= self.n else 0.0

    @property
    def largest_degree(self) -> int:
        return max(self._degrees, default=0)

    @cached_property
    def longest(self) -> float:
        """Digits of the longest rational coefficient, powers of two apart."""
        kept = {c for row in self.rows for _, c in row if isinstance(c, Fraction)}
        return LOG10_2 * max(
            (_odd_bits(c.numerator) + _odd_bits(c.denominator) for c in kept), default=0
        )

    @cached_property
    def _degrees(self) -> list[int]:
        return [max(sum(e) for e, _ in row) for row in self.rows]

    @cached_property
    def height(self) -> int:
        """Decimal digits of the longest coefficient where rows of rationals have whole ones."""
        longest = 0
        for row in self.rows:
            if all(isinstance(c, Fraction) for _, c in row):
                whole = lcm(*(c.denominator for _, c in row))
                numbers = [c.numerator * (whole // c.denominator) for _, c in row]
                largest = max(map(abs, numbers)) // gcd(*numbers)
                longest = max(longest, int(largest.bit_length() * LOG10_2) + 1)
        return longest

    def log_residual(self, y: Sequence[flint.acb], digits: int) -> float:
        """Decimal logarithm of the largest value at a point of so many digits."""
        return log_norm(self.values_at(digits).values(y))

    def vanishes_on_an_axis(self, point: Sequence[Fraction]) -> bool:
        """Whether rational equations vanish where all coordinates but one are those of a point."""
        return any(self._vanishes_along(point, i) for i in range(self.n))

    def _vanishes_along(self, point: Sequence[Fraction], i: int) -> bool:
        for row in self.rows:
            sums: dict[int, Fraction] = {}
            for e, c in row:
                others = (point[j] ** k for j, k in enumerate(e) if k and j != i)
                sums[e[i]] = sums.get(e[i], Fraction(0)) + prod(others, start=c)
            if any(sums.values()):
                return False
        return True

    def vanishes_exactly(self, y: Sequence[Fraction]) -> bool:
        """Whether all rows vanish at a rational point."""
        return all(sum_terms(row, y) == 0 for row in self.rows)


@dataclass(frozen=True)
class PointValues:
    """Rows as functions at exact points, in so many bits: their values are middles of balls."""

    functions: BallPolynomials
    bits: int

    @property
    def n(self) -> int:
        """Number of variables."""
        return self.functions.n

    def values(self, x: Sequence[flint.acb]) -> list[flint.acb]:
        """The value of each row."""
        return list(self.functions.values(x, self.bits).mid().entries())

    def jacobian(self, x: Sequence[flint.acb]) -> list[list[flint.acb]]:
        """The derivatives of each row."""
        return list(self.functions.jacobian(x, self.bits).mid().tolist())


def _in_digits(rows: Sequence[Terms], digits: int) -> list[Terms]:
    with in_bits(bits_of(digits)):
        return [[(e, to_ball(c)) for e, c in row] for row in rows]


def _odd_bits(k: int) -> int:
    return k.bit_length() - (k & -k).bit_length()


def _log2(c: Number | complex) -> float:
    if isinstance(c, Fraction):
        return log2(abs(c.numerator)) - log2(c.denominator)
    return float(np.log2(abs(complex(c) if isinstance(c, complex) else float(c))))


def _scale_terms(
    terms: Any, scales: tuple[int, ...]
) -> tuple[tuple[tuple[int, ...], Number | complex], ...]:
    """Terms in the scaled variables, over a power of two next to the largest.

    Rational coefficients are multiplied by their denominators first: short dyadic numbers are
    exact at any precision, and products with them cost little.
    """
    kept = [(e, c) for e, c in terms if not isinstance(c, complex) or c]
    if all(isinstance(c, Fraction) for _, c in kept):
        ratios = [c.as_integer_ratio() for _, c in kept]
        whole = lcm(*(q for _, q in ratios))
        kept = [
            (e, Fraction(p * (whole // q))) for (e, _), (p, q) in zip(kept, ratios, strict=True)
        ]
    shifts = [sum(map(mul, e, scales)) for e, _ in kept]
    top = floor(max(_log2(c) + s for (_, c), s in zip(kept, shifts, strict=True)))
    powers = {shift: Fraction(2) ** (shift - top) for shift in set(shifts)}
    result = []
    for (e, c), shift in zip(kept, shifts, strict=True):
        if isinstance(c, complex):
            c = complex(np.ldexp(c.real, shift - top), np.ldexp(c.imag, shift - top))
        elif shift != top:
            c = c * powers[shift]
        result.append((e, c))
    return tuple(result)
