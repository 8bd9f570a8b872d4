"""Sums of rational multiples of square roots and of cosines of rational turns, in a normal form.

They are sums in the basis of `nag.algebra.root_basis`: a sum that has each member once is zero only
if nothing is left of it, and two are equal only if they are the same. So zero is exact, and sums
that meet in any place have one form without a field being agreed on first.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, product
from math import cos, isclose, isqrt, lcm, pi, prod
from types import MappingProxyType
from typing import Any, ClassVar

import flint

from nag.algebra.flint_numbers import to_fraction, to_rational
from nag.algebra.root_basis import (
    Root,
    add_multiple,
    ball_of,
    conjugations,
    cosine_of_turns,
    generator,
    generators_of,
    image_of_root,
    is_sine,
    multiply_sums,
    powers_of,
    prime_of,
    primes_of,
    radicand_of,
    share_a_field,
    sort_key,
    spanning_roots,
)

# Small primes are looked for in all radicands; of what is then left larger ones are not factored,
# and still larger ones not proved to be prime.
_SMALL_PRIMES, _LARGEST_FACTORED, _LARGEST_PROVED = 10_000, 10**30, 10**100
# Bits with which the evaluation of a sum begins; a rational number's error is far below a double's.
_BITS = 128
# Of a root in a sum of roots, how often one is taken in the search for it.
_DEEPEST = 6
# Turns are looked at down to this part of one, to write a sum as one cosine.
_LARGEST_ORDER = 420
# Degree of a field up to which roots are looked for in it; primes that are tried in a norm; how
# many of them are taken for the radicand of a factor.
_LARGEST_FIELD, _PRIMES_OF_NORM, _MOST_CANDIDATES = 12, 25, 4
# Bits of a relation that is looked for.
_MOST_BITS = 10_000

Exact = Fraction | int


def natural_power(base: Any, exponent: int) -> Any:
    """A number's power, by its squares; the exponent is not negative."""
    result = Fraction(1)
    while exponent:
        if exponent & 1:
            result = base * result
        exponent >>= 1
        if exponent:
            base = base * base
    return result


@dataclass(frozen=True, eq=False, slots=True)
class Surd:
    """A real number that is a sum of rational multiples of roots, and not rational.

    Attributes:
        terms: rational numbers of FLINT's, not zero, by the members of the basis that they
            multiply; 1 is that of the rational part.
    """

    terms: Mapping[Root, flint.fmpq]
    # What an operation gives whose arguments share no field of a small degree: `number` knows.
    make_expression: ClassVar[Callable[[str, Surd, Surd], Any]]

    def __reduce__(self) -> tuple[Any, ...]:
        return normal_sum, (dict(self.terms),)

    def __add__(self, other: Surd | Exact) -> Surd | Fraction:
        theirs = _terms(other)
        if theirs is None:
            return NotImplemented
        if not share_a_field(self.terms, theirs):
            return Surd.make_expression("+", self, other)
        terms = dict(self.terms)
        for r, c in theirs.items():
            terms[r] = terms[r] + c if r in terms else c
        return normal_sum(terms)

    __radd__ = __add__

    def __neg__(self) -> Surd:
        return _of({r: -c for r, c in self.terms.items()})

    def __pos__(self) -> Surd:
        return self

    def __abs__(self) -> Surd:
        return -self if self.sign() < 0 else self

    def __sub__(self, other: Surd | Exact) -> Surd | Fraction:
        theirs = _terms(other)
        if theirs is None:
            return NotImplemented
        if not share_a_field(self.terms, theirs):
            return Surd.make_expression("+", self, -other)
        terms = dict(self.terms)
        for r, c in theirs.items():
            terms[r] = terms[r] - c if r in terms else -c
        return normal_sum(terms)

    def __rsub__(self, other: Exact) -> Surd | Fraction:
        return (-self) + other

    def __mul__(self, other: Surd | Exact) -> Surd | Fraction:
        if isinstance(other, Surd):
            if not share_a_field(self.terms, other.terms):
                return Surd.make_expression("*", self, other)
            return normal_sum(multiply_sums(self.terms, other.terms))
        if not isinstance(other, int | Fraction):
            return NotImplemented
        if not other:
            return Fraction(0)
        q = to_rational(other)
        return _of({r: c * q for r, c in self.terms.items()})

    __rmul__ = __mul__

    def __truediv__(self, other: Surd | Exact) -> Surd | Fraction:
        if isinstance(other, Surd):
            return self * other.inverse()
        if not isinstance(other, int | Fraction):
            return NotImplemented
        return self * (1 / Fraction(other))

    def __rtruediv__(self, other: Exact) -> Surd | Fraction:
        if not isinstance(other, int | Fraction):
            return NotImplemented
        return self.inverse() * other

    def __pow__(self, exponent: int) -> Surd | Fraction:
        if exponent < 0:
            return self.inverse() ** -exponent
        result: Surd | Fraction = natural_power(self, exponent)
        return result

    def inverse(self) -> Surd:
        """One over it."""
        if any(powers_of(r) for r in self.terms):
            return self._inverse_by_matrix()
        if len(self.terms) == 1:
            ((r, c),) = self.terms.items()
            return _of({r: 1 / (c * radicand_of(r))})
        found: Surd | Fraction = Fraction(1)
        rest: Surd | Fraction = self
        while isinstance(rest, Surd):
            conjugate = _change_sign(rest, max(rest.primes()))
            found, rest = found * conjugate, rest * conjugate
        result = found * (1 / rest)
        assert isinstance(result, Surd)
        return result

    def _inverse_by_matrix(self) -> Surd:
        """By the linear equations that its product with a sum in the same field be one."""
        _, basis = spanning_roots(self.terms)
        place = {r: i for i, r in enumerate(basis)}
        matrix = flint.fmpq_mat(len(basis), len(basis))
        for j, s in enumerate(basis):
            for r, c in multiply_sums(self.terms, {s: flint.fmpq(1)}).items():
                matrix[place[r], j] = c
        one = flint.fmpq_mat(len(basis), 1, [int(i == 0) for i in range(len(basis))])
        found = normal_sum(dict(zip(basis, matrix.solve(one).entries(), strict=True)))
        assert isinstance(found, Surd)
        return found

    def conjugate(self, units: Mapping[int, int]) -> Surd:
        """The image under an automorphism, given as `root_basis.image_of_root` wants it."""
        total: dict[Root, flint.fmpq] = {}
        for r, c in self.terms.items():
            add_multiple(total, image_of_root(r, units), c)
        found = normal_sum(total)
        assert isinstance(found, Surd)
        return found

    def primes(self) -> frozenset[int]:
        """The primes in the radicands of its square roots."""
        return frozenset(p for r in self.terms for p in primes_of(radicand_of(r)))

    def ball(self, bits: int) -> flint.arb:
        """A ball that contains it, whose radius is smaller by so many bits."""
        working = bits + 16
        while True:
            with flint.ctx.workprec(working):
                total = flint.arb(0)
                for r, c in self.terms.items():
                    total += ball_of(r) * c
            if total.rel_accuracy_bits() >= bits:
                return total
            working *= 2

    def binary(self, bits: int) -> tuple[int, int]:
        """Integers m and k, for which ``m 2^k`` has about so many bits in common with it."""
        mantissa, exponent = self.ball(bits).mid().man_exp()
        return int(mantissa), int(exponent)

    def sign(self) -> int:
        """1 or -1."""
        return 1 if self.ball(2) > 0 else -1

    def modulo(self, modulus: int, image: Callable[[Root], int]) -> int:
        """Its image modulo a prime number.

        Args:
            image: of members of the basis, modulo that number.

        Raises:
            ZeroDivisionError: if the modulus divides a denominator.
        """
        total = 0
        for r, c in self.terms.items():
            total += int(c.p) * pow_inverse(int(c.q), modulus) % modulus * image(r)
        return total % modulus

    @property
    def size(self) -> int:
        """Number of roots, and the rational part."""
        return len(self.terms)

    @property
    def bits(self) -> int:
        """Bits of the longest integer in it."""
        parts = (max(int(c.p).bit_length(), int(c.q).bit_length()) for c in self.terms.values())
        return max(*parts, *(radicand_of(r).bit_length() for r in self.terms), 1)

    def __float__(self) -> float:
        return float(self.ball(_BITS).mid())

    def __bool__(self) -> bool:
        return True

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Surd):
            return self.terms == other.terms
        return False if isinstance(other, int | Fraction) else NotImplemented

    def __hash__(self) -> int:
        return hash(float(self))

    def _sign_of_difference(self, other: Surd | Exact) -> int:
        difference = self - other
        if isinstance(difference, Surd):
            return difference.sign()
        return (difference > 0) - (difference < 0)

    def __lt__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) < 0

    def __le__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) <= 0

    def __gt__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) > 0

    def __ge__(self, other: Surd | Exact) -> bool:
        if not isinstance(other, int | Fraction | Surd):
            return NotImplemented
        return self._sign_of_difference(other) >= 0

    def __str__(self) -> str:
        """As it is written in a file: ``sqrt(3)/2``, ``(1/2-5*sqrt(2)/3)``, ``2*cos(2*pi/7)``."""
        cosine = _as_cosine(self)
        if cosine is not None:
            return cosine
        texts = [_term_text(r, self.terms[r]) for r in sorted(self.terms, key=sort_key)]
        if len(texts) == 1:
            return texts[0]
        signed = [t if t.startswith("-") else f"+{t}" for t in texts[1:]]
        return f"({texts[0]}{''.join(signed)})"

    def __repr__(self) -> str:
        return f"Surd({self})"


def _as_cosine(value: Surd) -> str | None:
    """A rational multiple of one cosine, as it is written in a file; None for other sums."""
    orders = [q for r in value.terms for q, _ in powers_of(r)]
    n, size = lcm(4, *orders, *value.primes()), float(value)
    if not orders or n > _LARGEST_ORDER:
        return None
    for a in (a for a in range(1, n // 2) if 4 * a != n):
        # Doubles only say where to look.
        ratio = Fraction(size / cos(2 * pi * a / n)).limit_denominator(10**4)
        if ratio > 0 and isclose(float(ratio) * cos(2 * pi * a / n), size):
            terms = cosine_of_turns(Fraction(a, n))
            if terms is not None and normal_sum(terms) * ratio == value:
                top, below = Fraction(2 * a, n).as_integer_ratio()
                angle = f"{top}*pi/{below}" if top > 1 else f"pi/{below}"
                return _multiple_text(f"cos({angle})", to_rational(ratio))
    return None


def _multiple_text(body: str, factor: flint.fmpq) -> str:
    p, q = int(factor.p), int(factor.q)
    front = {1: "", -1: "-"}.get(p, f"{p}*")
    return front + body + (f"/{q}" if q != 1 else "")


def _term_text(root: Root, factor: flint.fmpq) -> str:
    radicand = radicand_of(root)
    factors = [f"sqrt({radicand})"] if radicand > 1 else []
    for order, k in powers_of(root):
        name, scale = ("sin", 4) if is_sine(order) else ("cos", 2)
        factor *= scale**k
        factors.append(f"{name}(2*pi/{order})" + (f"^{k}" if k > 1 else ""))
    return _multiple_text("*".join(factors), factor) if factors else str(factor)


def root_text(root: Root) -> str:
    """A member of the basis, or a simple multiple of it, as it is written in a file."""
    factors = [4 if is_sine(order) else 2 for order, k in powers_of(root) for _ in range(k)]
    return _term_text(root, flint.fmpq(1, prod(factors)))


def _terms(value: Surd | Exact | Any) -> Mapping[Root, flint.fmpq] | None:
    if isinstance(value, Surd):
        return value.terms
    if isinstance(value, int | Fraction):
        return {1: to_rational(value)} if value else {}
    return None


def _of(terms: dict[Root, flint.fmpq]) -> Surd:
    return Surd(MappingProxyType(terms))


def normal_sum(terms: Mapping[Root, flint.fmpq]) -> Surd | Fraction:
    """The sum of rational multiples of members of the basis, zeros among them."""
    kept = {r: c for r, c in terms.items() if c}
    if not kept:
        return Fraction(0)
    if len(kept) == 1 and 1 in kept:
        return to_fraction(kept[1])
    return _of(kept)


def pow_inverse(a: int, modulus: int) -> int:
    """One over an integer modulo a prime.

    Raises:
        ZeroDivisionError: if the prime divides it.
    """
    if a == 1:
        return 1
    if a % modulus == 0:
        raise ZeroDivisionError(f"{modulus} divides a denominator")
    return pow(a, -1, modulus)


@lru_cache(maxsize=4096)
def split_square(n: int) -> tuple[int, int] | None:
    """``(a, r)`` with ``n = a^2 r`` and r square-free, for a positive integer.

    None if its factors are too large to be looked for.
    """
    root = isqrt(n)
    if root * root == n:
        return root, 1
    root, radicand, left = 1, 1, n
    for p in _small_primes():
        if p * p > left:
            break
        if left % p == 0:
            times, left = _divide_out(left, p)
            root, radicand = root * p ** (times // 2), radicand * p ** (times % 2)
    whole = isqrt(left)
    if whole * whole == left:
        return root * whole, radicand
    if left > _LARGEST_PROVED or (left > _LARGEST_FACTORED and not flint.fmpz(left).is_prime()):
        return None
    for p, k in flint.fmpz(left).factor():
        root *= int(p) ** (int(k) // 2)
        radicand *= int(p) ** (int(k) % 2)
    return root, radicand


def _divide_out(n: int, p: int) -> tuple[int, int]:
    """How often ``p`` divides ``n``, a positive integer, and what is left of it."""
    powers = [p]
    while n % powers[-1] == 0:
        powers.append(powers[-1] ** 2)
    times = 0
    for k, power in reversed(list(enumerate(powers))):
        if n % power == 0:
            times, n = times + 2**k, n // power
    return times, n


@lru_cache(maxsize=1)
def _small_primes() -> tuple[int, ...]:
    return tuple(p for p in range(2, _SMALL_PRIMES) if flint.fmpz(p).is_prime())


def root_of_fraction(value: Fraction) -> Surd | Fraction | None:
    """The non-negative square root of a rational number that is not negative.

    None if its radicand has too large factors for a normal form.
    """
    if not value:
        return Fraction(0)
    # Both parts have no common factor: their square-free parts have none either.
    parts = split_square(value.numerator), split_square(value.denominator)
    if parts[0] is None or parts[1] is None:
        return None
    (a, r), (b, s) = parts
    if r * s > _LARGEST_FACTORED and not (r == 1 or s == 1):
        return None
    return normal_sum({r * s: flint.fmpq(a, b * s)})


def root_of_surd(value: Surd) -> Surd | Fraction | None:
    """The positive square root of a positive sum of roots, if that is such a sum and is found."""
    if value.sign() < 0:
        return None
    nested = any(powers_of(r) for r in value.terms)
    found = None if nested else _root_by_conjugates(value, _DEEPEST)
    return _root_in_field(value) if found is None else found


def _root_by_conjugates(value: Surd, depth: int) -> Surd | Fraction | None:
    """The same where both are sums of square roots.

    With ``a + b sqrt(p)`` for the sum, the root and its conjugate have the product
    ``sqrt(a^2 - p b^2)``, and with it the sum and difference of both are roots of simpler numbers.
    """
    if depth == 0 or value.sign() < 0:
        return None
    prime = max(value.primes())
    if all(radicand_of(r) % prime == 0 for r in value.terms):
        # Of sqrt(p) times a number, the fourth root of p would be a factor.
        return None
    even = normal_sum({r: c for r, c in value.terms.items() if radicand_of(r) % prime})
    norm = _root(value * _change_sign(value, prime), depth - 1)
    if norm is None:
        return None
    halves = [_root((even + norm) / 2, depth - 1), _root((even - norm) / 2, depth - 1)]
    if halves[0] is None or halves[1] is None:
        return None
    for found in (halves[0] + halves[1], halves[0] - halves[1]):
        if found * found == value:
            return abs(found)
    return None


def _root(value: Surd | Fraction, depth: int) -> Surd | Fraction | None:
    if isinstance(value, Surd):
        return _root_by_conjugates(value, depth)
    return root_of_fraction(value) if value >= 0 else None


def _change_sign(value: Surd, prime: int) -> Surd:
    """The conjugate of a sum of square roots in which that of a prime changes its sign."""
    return _of({r: c if radicand_of(r) % prime else -c for r, c in value.terms.items()})


def _root_in_field(value: Surd) -> Surd | None:
    """A root that is in the field of the number, times a square root or another generator.

    Its field is abelian if all conjugates of the number are positive, and it is the root of an
    integer m, or a generator of degree two, times a number of the field. The primes of m are
    ramified in the field, or divide the norm.
    """
    generators, basis = spanning_roots(value.terms)
    if len(basis) > _LARGEST_FIELD:
        return None
    conjugates = [value.conjugate(units) for units in conjugations(generators)]
    if any(c.sign() < 0 for c in conjugates):
        return None
    norm = prod(conjugates, start=Fraction(1))
    assert isinstance(norm, Fraction)
    orders = {q for g in generators for q, _ in powers_of(g)}
    ramified = {prime_of(q) for q in orders}
    ramified |= {p for g in generators for p in primes_of(radicand_of(g))}
    size = norm.numerator * norm.denominator
    dividing = {p for p in _small_primes()[:_PRIMES_OF_NORM] if size % p == 0}
    primes = sorted(ramified | dividing | {2})[:_MOST_CANDIDATES]
    powers = [q for q in orders if prime_of(q) == 2]
    new = [generator(q) for q in (2 * max(powers, default=8), 5) if q not in orders]
    new = [g for g in new if ramified.issuperset(generators_of(g)[:1])]
    radicands = sorted(prod(own) for k in range(len(primes) + 1) for own in combinations(primes, k))
    for g, m in product((1, *new), radicands):
        # The norm of a square is one.
        if g == 1 and not _is_square(norm * m ** len(basis)):
            continue
        factor = normal_sum(multiply_sums({m: flint.fmpq(1)}, {g: flint.fmpq(1)}))
        square = factor * factor * value
        surd = isinstance(square, Surd)
        root = _root_by_relation(square) if surd else root_of_fraction(square)
        if root is not None:
            found = root / factor
            assert isinstance(found, Surd)
            return abs(found)
    return None


def _is_square(value: Fraction) -> bool:
    """Whether a rational number that is not negative is the square of one."""
    return all(isqrt(n) ** 2 == n for n in value.as_integer_ratio())


def _root_by_relation(value: Surd) -> Surd | Fraction | None:
    """The root of a number that has one in its field, from an integer relation with the basis.

    None where that takes too many digits.
    """
    _, basis = spanning_roots(value.terms)
    bits = (len(basis) + 1) * (value.bits + _BITS // 2)
    if len(basis) > _LARGEST_FIELD or bits > _MOST_BITS:
        return None
    with flint.ctx.workprec(2 * bits):
        numbers = [value.ball(2 * bits).sqrt(), *map(ball_of, basis)]
        scaled = [int((x * flint.arb(2) ** bits).mid().floor().unique_fmpz()) for x in numbers]
    rows = [[*(int(i == j) for j in range(len(numbers))), n] for i, n in enumerate(scaled)]
    own, *parts = [-int(n) for n in flint.fmpz_mat(rows).lll().tolist()[0]][:-1]
    if not own:
        return None
    found = normal_sum({r: flint.fmpq(-n, own) for r, n in zip(basis, parts, strict=True)})
    return found if found * found == value else None
