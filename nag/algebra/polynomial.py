"""Sparse multivariate polynomials with exact coefficients."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from operator import add, le
from types import MappingProxyType
from typing import Any

import flint

from nag.algebra.flint_numbers import to_rational
from nag.algebra.number import Exact, Number, Surd, is_zero, number_text
from nag.algebra.root_basis import Root, generators_of, multiply_roots, share_a_field
from nag.algebra.surd import normal_sum
from nag.errors import NagError

Exponents = tuple[int, ...]


def divides(e: Exponents, f: Exponents) -> bool:
    """Whether the monomial with exponents ``e`` divides the one with ``f``."""
    return all(map(le, e, f))


def occurring_variables(monomials: Iterable[Exponents]) -> set[int]:
    """Indices of the variables that occur in monomials."""
    return {i for i, powers in enumerate(zip(*monomials, strict=True)) if any(powers)}


# Terms with whole coefficients, by the members of the basis of sums of roots that multiply them.
Parts = dict[Root, dict[Exponents, int]]

# Products of terms beyond which coefficients are multiplied as integers.
FEW_PRODUCTS = 8


def find_nonzero_variables(rows: Iterable[Mapping[Exponents, Any]], n: int) -> tuple[int, ...]:
    """The variables that equations say vanish at none of their zeros, ascending.

    Those of which all terms of one equation but its constant are multiples.
    """
    found: set[int] = set()
    for row in rows:
        others = [e for e in row if any(e)]
        if others and row.get((0,) * n):
            found |= {i for i in range(n) if i not in found and all(e[i] for e in others)}
    return tuple(sorted(found))


def multiply_terms(
    first: Mapping[Exponents, Any], second: Mapping[Exponents, Any]
) -> dict[Exponents, Any]:
    """The product of sums of terms; what cancels stays as zero."""
    terms: dict[Exponents, Any] = {}
    for e, c in first.items():
        for f, d in second.items():
            key = tuple(map(add, e, f))
            product = c * d
            terms[key] = terms[key] + product if key in terms else product
    return terms


def sum_terms(
    terms: Iterable[tuple[Sequence[int], Any]], point: Sequence[Any], start: Any = 0
) -> Any:
    """The value of a sum of terms, in the arithmetic of the coefficients and of the point.

    Args:
        terms: exponents and coefficients.
        start: what they are added to.
    """
    total = start
    for e, c in terms:
        for x, k in zip(point, e, strict=True):
            if k:
                c = c * x**k
        total = total + c
    return total


def multiply_parts(first: Parts, second: Parts) -> Parts:
    """The product of polynomials in roots; what cancels stays as zero."""
    parts: Parts = {}
    for r, f in first.items():
        for s, g in second.items():
            terms = multiply_terms(f, g)
            for t, factor in multiply_roots(r, s):
                add_terms(parts.setdefault(t, {}), terms, factor)
    return parts


def add_terms(sums: dict[Exponents, int], terms: Mapping[Exponents, int], factor: int) -> None:
    """Add a multiple of terms to others, in place."""
    for e, c in terms.items():
        sums[e] = sums[e] + factor * c if e in sums else factor * c


# Decides: Digits of coefficients that ask for no more evidence; each further asks for one more:
# what nearly is something else has long ones.
ROUND_NUMBERS = 6


@dataclass(frozen=True, eq=False)
class Polynomial:
    """A polynomial in ``n`` variables, as a read-only map from exponents to non-zero coefficients.

    Coefficients are `fractions.Fraction`, `Surd` where the input has roots, or `Irrational`
    where it has other functions. The variables have no names here; `PolynomialSystem` names them.
    """

    n: int
    terms: Mapping[Exponents, Number]

    def __post_init__(self) -> None:
        kept, n = {}, self.n
        try:
            for exponents, coefficient in self.terms.items():
                if len(exponents) != n:
                    raise NagError(f"terms: exponents {exponents} do not belong to {n} variables")
                if type(coefficient) is Fraction:
                    # To compare fractions takes five times as long.
                    if coefficient.numerator:
                        kept[exponents] = coefficient
                    continue
                if isinstance(coefficient, Surd):
                    kept[exponents] = coefficient
                    continue
                if isinstance(coefficient, int):
                    coefficient = Fraction(coefficient)
                elif not isinstance(coefficient, Number):
                    raise TypeError
                if not is_zero(coefficient):
                    kept[exponents] = coefficient
        except (AttributeError, TypeError):
            raise NagError(
                "terms: give a dict from tuples of exponents to fractions; nag.system reads "
                "polynomials as text"
            ) from None
        object.__setattr__(self, "terms", MappingProxyType(kept))

    @classmethod
    def of_parts(cls, n: int, parts: Parts, common: int = 1) -> Polynomial:
        """The polynomial whose coefficients are those of its parts over a common denominator."""
        if parts.keys() <= {1}:
            return cls(n, {e: Fraction(c, common) for e, c in parts.get(1, {}).items() if c})
        sums: dict[Exponents, dict[Root, flint.fmpq]] = {}
        for r, terms in parts.items():
            for e, c in terms.items():
                if c:
                    sums.setdefault(e, {})[r] = flint.fmpq(c, common)
        return cls(n, {e: normal_sum(roots) for e, roots in sums.items()})

    @classmethod
    def of_doubles(cls, n: int, terms: Mapping[Exponents, complex]) -> Polynomial:
        """A polynomial whose coefficients are complex doubles, as a slice's are: to be tracked."""
        made = cls(n, {})
        object.__setattr__(made, "terms", MappingProxyType(dict(terms)))
        return made

    def __reduce__(self) -> tuple[Any, ...]:
        return Polynomial, (self.n, dict(self.terms))

    @classmethod
    def constant(cls, n: int, value: Number | int) -> Polynomial:
        return cls(n, {(0,) * n: value})

    @classmethod
    def variable(cls, n: int, index: int) -> Polynomial:
        return cls(n, {tuple(int(i == index) for i in range(n)): Fraction(1)})

    @classmethod
    def variables(cls, n: int) -> tuple[Polynomial, ...]:
        return tuple(cls.variable(n, i) for i in range(n))

    def _coerce(self, other: Polynomial | Number | int) -> Polynomial | None:
        if isinstance(other, Polynomial):
            if other.n != self.n:
                raise NagError(f"polynomials in {self.n} and in {other.n} variables do not mix")
            return other
        if isinstance(other, int | Number):
            return Polynomial.constant(self.n, other)
        return None

    def __add__(self, other: Polynomial | Number | int) -> Polynomial:
        other = self._coerce(other)
        if other is None:
            return NotImplemented
        terms = dict(self.terms)
        for exponents, coefficient in other.terms.items():
            terms[exponents] = terms[exponents] + coefficient if exponents in terms else coefficient
        return Polynomial(self.n, terms)

    __radd__ = __add__

    def __neg__(self) -> Polynomial:
        return Polynomial(self.n, {e: -c for e, c in self.terms.items()})

    def __sub__(self, other: Polynomial | Number | int) -> Polynomial:
        other = self._coerce(other)
        return NotImplemented if other is None else self + (-other)

    def __rsub__(self, other: Number | int) -> Polynomial:
        return (-self) + other

    def __mul__(self, other: Polynomial | Number | int) -> Polynomial:
        if isinstance(other, int | Exact):
            return Polynomial(self.n, {e: c * other for e, c in self.terms.items()})
        other = self._coerce(other)
        if other is None:
            return NotImplemented
        if len(self.terms) * len(other.terms) > FEW_PRODUCTS and self.whole and other.whole:
            # Integers are multiplied in a tenth of the time that fractions take.
            (first, a), (second, b) = self.whole, other.whole
            sums = multiply_terms(first, second)
            return Polynomial(self.n, {e: Fraction(c, a * b) for e, c in sums.items()})
        if len(self.terms) * len(other.terms) > FEW_PRODUCTS and self.parts and other.parts:
            (roots, a), (others, b) = self.parts, other.parts
            if share_a_field(roots, others):
                return Polynomial.of_parts(self.n, multiply_parts(roots, others), a * b)
        return Polynomial(self.n, multiply_terms(self.terms, other.terms))

    __rmul__ = __mul__

    @cached_property
    def whole(self) -> tuple[dict[Exponents, int], int] | None:
        """Integers that are the coefficients times their common denominator; None without one."""
        if not self.exact:
            return None
        ratios = [c.as_integer_ratio() for c in self.terms.values()]
        common = lcm(*[q for _, q in ratios])
        return dict(zip(self.terms, [p * (common // q) for p, q in ratios], strict=True)), common

    @cached_property
    def parts(self) -> tuple[Parts, int] | None:
        """The polynomial in roots, and its denominator; None where other numbers are in it.

        It is the sum of the parts, each times its member of the basis, over the denominator.
        """
        if self.whole:
            return {1: self.whole[0]}, self.whole[1]
        if not self.algebraic:
            return None
        sums = {
            e: c.terms if isinstance(c, Surd) else {1: to_rational(c)}
            for e, c in self.terms.items()
        }
        common = lcm(*(int(c.q) for roots in sums.values() for c in roots.values()))
        parts: Parts = {}
        for e, roots in sums.items():
            for r, c in roots.items():
                parts.setdefault(r, {})[e] = int(c.p) * (common // int(c.q))
        return parts, common

    def __truediv__(self, other: Number | int) -> Polynomial:
        if is_zero(other):
            raise ZeroDivisionError("a polynomial is divided by zero")
        return self * (Fraction(1) / other)

    def __pow__(self, exponent: int) -> Polynomial:
        if exponent < 0:
            raise NagError("a polynomial has no negative power")
        result, base = Polynomial.constant(self.n, 1), self
        while exponent:
            if exponent & 1:
                result = result * base
            exponent >>= 1
            if exponent:
                base = base * base
        return result

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Polynomial):
            return NotImplemented
        return self.n == other.n and dict(self.terms) == dict(other.terms)

    def __hash__(self) -> int:
        known = self.__dict__.get("_hash")
        if known is None:
            known = hash((self.n, frozenset(self.terms.items())))
            object.__setattr__(self, "_hash", known)
        return known

    def __bool__(self) -> bool:
        return bool(self.terms)

    @cached_property
    def degree(self) -> int:
        """Total degree; 0 for a constant, -1 for the zero polynomial."""
        return max(map(sum, self.terms), default=-1)

    @cached_property
    def leading(self) -> list[Exponents]:
        """Exponents of the terms of the highest degree."""
        top = self.degree
        return [e for e in self.terms if sum(e) == top]

    def degree_in(self, indices: Iterable[int]) -> int:
        """Degree in the variables at ``indices`` together; -1 for the zero polynomial."""
        indices = tuple(indices)
        return max((sum([e[i] for i in indices]) for e in self.terms), default=-1)

    @cached_property
    def support(self) -> frozenset[int]:
        """Indices of the variables that occur."""
        return frozenset(occurring_variables(self.terms))

    @cached_property
    def exact(self) -> bool:
        """Whether every coefficient is rational."""
        return all(isinstance(c, Fraction) for c in self.terms.values())

    @cached_property
    def algebraic(self) -> bool:
        """Whether every coefficient is known exactly: rational, or a sum of roots."""
        return all(isinstance(c, Exact) for c in self.terms.values())

    @cached_property
    def generators(self) -> frozenset[Root]:
        """What coefficients that are known exactly are made of, see `nag.algebra.root_basis`."""
        roots = {r for c in self.terms.values() if isinstance(c, Surd) for r in c.terms}
        return frozenset(g for r in roots for g in generators_of(r))

    @property
    def doubles(self) -> list[float]:
        """The coefficients, rounded, in the order of the terms."""
        # A fraction's own way to a float takes three times as long.
        return [
            c.numerator / c.denominator if type(c) is Fraction else float(c)
            for c in self.terms.values()
        ]

    @property
    def digits(self) -> int:
        """Most decimal digits of a rational coefficient's numerator or denominator."""
        parts = [c.as_integer_ratio() for c in self.terms.values() if isinstance(c, Fraction)]
        return len(str(max(max(abs(p), q) for p, q in parts))) if parts else 0

    def derivative(self, index: int) -> Polynomial:
        terms = {}
        for e, c in self.terms.items():
            if e[index]:
                terms[(*e[:index], e[index] - 1, *e[index + 1 :])] = c * e[index]
        return Polynomial(self.n, terms)

    def __call__(self, point: Sequence[Any], convert: Callable[[Number], Any] | None = None) -> Any:
        """Value at ``point``, in the arithmetic of its entries (exact for fractions).

        ``convert`` turns a coefficient into that arithmetic; by default coefficients are used as
        they are when the entries are exact, and as floats otherwise.
        """
        if convert is None:
            if self.exact and all(type(x) is Fraction for x in point):
                return self._at_fractions(point)
            exact = all(isinstance(x, int | Number) for x in point)
            convert = (lambda c: c) if exact else float
        converted = ((e, convert(c)) for e, c in self.terms.items())
        return sum_terms(converted, point, convert(Fraction(0)))

    def _at_fractions(self, point: Sequence[Fraction]) -> Fraction:
        """The value at a rational point: one of integers over one common denominator."""
        assert self.whole
        terms, below = self.whole
        degrees = [max(powers) for powers in zip(*terms, strict=True)]
        tables = []
        for x, degree in zip(point, degrees, strict=bool(terms)):
            p, q = x.as_integer_ratio()
            tables.append([p**k * q ** (degree - k) for k in range(degree + 1)])
            below *= q**degree
        total = 0
        for e, c in terms.items():
            for table, k in zip(tables, e, strict=True):
                c *= table[k]
            total += c
        return Fraction(total, below)

    def compose(self, images: Sequence[Polynomial]) -> Polynomial:
        """The polynomial in the images' variables, variable ``i`` replaced by ``images[i]``."""
        if len(images) != self.n:
            raise NagError(f"{self.n} images are needed, {len(images)} were given")
        if not images:
            return self
        m = images[0].n
        powers: dict[tuple[int, int], Polynomial] = {}
        total: dict[Exponents, Number] = {}
        for e, c in self.terms.items():
            value = Polynomial.constant(m, c)
            for i, k in enumerate(e):
                if k:
                    if (i, k) not in powers:
                        powers[i, k] = images[i] ** k
                    value = value * powers[i, k]
            for f, d in value.terms.items():
                total[f] = total[f] + d if f in total else d
        return Polynomial(m, total)

    def with_variables(self, n: int, positions: Sequence[int]) -> Polynomial:
        """The polynomial among ``n`` variables; variable ``i`` becomes number ``positions[i]``.

        Variables that become the same one are identified.
        """
        if positions == range(self.n):
            more = (0,) * (n - self.n)
            return Polynomial(n, {e + more: c for e, c in self.terms.items()})
        terms: dict[Exponents, Number] = {}
        for e, c in self.terms.items():
            key = [0] * n
            for i, k in enumerate(e):
                if k:
                    key[positions[i]] += k
            moved = tuple(key)
            terms[moved] = terms[moved] + c if moved in terms else c
        return Polynomial(n, terms)

    def text(
        self,
        variables: Sequence[str],
        number: Callable[[Number], str] = number_text,
        unit: bool = False,
    ) -> str:
        """The polynomial as text that `nag.algebra.expression.parse_polynomial` reads back.

        Args:
            variables: their names.
            number: how a coefficient is written, exactly if not said.
            unit: whether the last variable is the imaginary unit, a number of degree zero.
        """
        if not self.terms:
            return "0"
        parts = []

        def place(e: Exponents) -> tuple[int, tuple[int, ...], int]:
            own = e[: len(e) - unit]
            return -sum(own), tuple(-k for k in own), sum(e)

        for e in sorted(self.terms, key=place):
            c = self.terms[e]
            monomial = "*".join(
                v if k == 1 else f"{v}^{k}" for v, k in zip(variables, e, strict=True) if k
            )
            size = number(c)
            negative = size.startswith("-")
            size = size.removeprefix("-")
            if not monomial:
                body = size
            elif size == "1":
                body = monomial
            else:
                body = f"{size}*{monomial}"
            sign = "-" if negative else "+"
            parts.append(f" {sign} {body}" if parts else (f"-{body}" if negative else body))
        return "".join(parts)

    def __repr__(self) -> str:
        return f"Polynomial({self.text([f'x{i}' for i in range(self.n)])})"
