"""A basis of the real numbers that are made of square roots and of cosines of rational turns.

By Kronecker and Weber these are the real numbers whose field is abelian over the rationals. The
square roots of square-free positive integers are independent over the rationals (Besicovitch, On
the linear independence of fractional powers of integers, 1940). Over the field M of all of them,
the field of all cosines has the squares of units modulo all prime powers for its group, a product
with one factor for each prime: what the primes give is independent over M, and has the products for
a basis. For each power q of a prime p there is one generator,

- 2 cos(2 pi / q), where p is 2 or leaves 3 modulo 4,
- 4 sin(2 pi / q), where p leaves 1,

of some degree over M and the generator of q / p, with a monic relation in whole numbers times these
and times the root of p (Washington, Introduction to cyclotomic fields, chapter 2). So every such
number is one sum of rational multiples of the products of roots and of powers of generators below
their degrees; none of these sums but the empty one is zero, and none needs a field to be agreed on.

A member of the basis is an integer where it is the root of one, and else a `RootProduct`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache, lru_cache
from itertools import product
from math import gcd, lcm, prod
from typing import Any, NamedTuple

import flint

# Degree of a field up to which its cosines and sines are written in the basis; and up to which sums
# are added and multiplied in it, over the field of all square roots.
MOST_DEGREE = 12
# Bits in which whole coefficients of relations are worked out: these are below 2^100.
_BITS = 512


class RootProduct(NamedTuple):
    """The root of a square-free integer times powers of generators, at least one.

    Attributes:
        radicand: the integer.
        powers: prime powers q, rising, with exponents of the generators that belong to them.
    """

    radicand: int
    powers: tuple[tuple[int, int], ...]


Root = int | RootProduct
# Rational or other coefficients of members of the basis.
Sum = dict[Root, Any]


def radicand_of(root: Root) -> int:
    """The square-free integer whose root is in it."""
    return root if isinstance(root, int) else root.radicand


def powers_of(root: Root) -> tuple[tuple[int, int], ...]:
    """Orders and exponents of the generators in it."""
    return () if isinstance(root, int) else root.powers


def sort_key(root: Root) -> tuple[Any, ...]:
    """By what members of the basis are sorted: square roots first."""
    return powers_of(root), radicand_of(root)


def root_product(radicand: int, powers: Iterable[tuple[int, int]]) -> Root:
    """The member of the basis with a radicand and exponents of generators, some of which are 0."""
    kept = tuple(sorted((q, k) for q, k in powers if k))
    return RootProduct(radicand, kept) if kept else radicand


def generator(order: int) -> Root:
    """That of a prime power."""
    return RootProduct(1, ((order, 1),))


@lru_cache(maxsize=4096)
def primes_of(radicand: int) -> tuple[int, ...]:
    """The primes that divide a square-free positive integer whose factors can be found."""
    return tuple(int(p) for p, _ in flint.fmpz(radicand).factor()) if radicand > 1 else ()


@cache
def prime_of(order: int) -> int:
    """The prime of which a generator's order is a power."""
    return int(flint.fmpz(order).factor()[0][0])


def is_sine(order: int) -> bool:
    """Whether a generator is four times a sine, and not two times a cosine."""
    return prime_of(order) % 4 == 1


@cache
def degree_of(order: int) -> int:
    """Of a generator, over the root of its prime and the generators before it."""
    p = prime_of(order)
    if order > p and order != 16:
        return p
    return 2 if p == 2 else (p - 1) // 2


@cache
def _is_generator(order: int) -> bool:
    """Whether there is one: of 2, 4, 8, and 3 there are none, as their cosines are roots."""
    return order not in (1, 2, 3, 4, 8)


@lru_cache(maxsize=4096)
def generators_of(root: Root) -> tuple[Root, ...]:
    """The roots of primes and the generators that it is made of, and those of their relations."""
    found: dict[Root, None] = dict.fromkeys(primes_of(radicand_of(root)))
    for order, _ in powers_of(root):
        p = prime_of(order)
        if p % 4 != 3:
            found[p] = None
        q = order
        while _is_generator(q):
            found[generator(q)] = None
            q //= p
    return tuple(sorted(found, key=sort_key))


def share_a_field(first: Iterable[Root], second: Iterable[Root]) -> bool:
    """Whether sums of these members are in one field of a degree up to `MOST_DEGREE`.

    That is its degree over the field of all square roots; which of these there are does not matter.
    """
    orders = {q for each in (first, second) for r in each for q, _ in powers_of(r)}
    if not orders:
        return True
    towers = {g for q in orders for g in generators_of(generator(q)) if not isinstance(g, int)}
    return prod(degree_of(q) for g in towers for q, _ in powers_of(g)) <= MOST_DEGREE


# Arithmetic of sums.


def add_multiple(total: Sum, terms: Mapping[Root, Any], factor: Any = 1) -> None:
    """Add a multiple of a sum to another, in place; what cancels stays as zero."""
    for r, c in terms.items():
        total[r] = total[r] + c * factor if r in total else c * factor


def multiply_sums(first: Mapping[Root, Any], second: Mapping[Root, Any]) -> Sum:
    """The product of sums; what cancels stays as zero.

    Coefficients are of any arithmetic in which whole numbers multiply.
    """
    terms: Sum = {}
    for r, c in first.items():
        for s, d in second.items():
            own = c * d
            for t, factor in multiply_roots(r, s):
                more = own if factor == 1 else own * factor
                terms[t] = terms[t] + more if t in terms else more
    return terms


def multiply_roots(r: Root, s: Root) -> tuple[tuple[Root, int], ...]:
    """The product of two members of the basis, with whole coefficients."""
    if isinstance(r, int) and isinstance(s, int):
        if r == 1:
            return ((s, 1),)
        if s == 1:
            return ((r, 1),)
        if r == s:
            return ((1, r),)
        common = gcd(r, s)
        return (((r // common) * (s // common), common),)
    return _multiply_products(r, s)


@lru_cache(maxsize=65536)
def _multiply_products(r: Root, s: Root) -> tuple[tuple[Root, int], ...]:
    ((radicand, factor),) = multiply_roots(radicand_of(r), radicand_of(s))
    powers = dict(powers_of(r))
    for q, k in powers_of(s):
        powers[q] = powers.get(q, 0) + k
    large = next((q for q in sorted(powers) if powers[q] >= degree_of(q)), None)
    if large is None:
        return ((root_product(radicand, powers.items()), factor),)
    powers[large] -= degree_of(large)
    rest = multiply_sums({radicand: factor}, relation(large))
    for q, k in powers.items():
        for _ in range(k):
            rest = multiply_sums(rest, {generator(q): 1})
    return tuple((t, c) for t, c in rest.items() if c)


@cache
def relation(order: int) -> Mapping[Root, int]:
    """The power of a generator to its degree, as a sum of lower ones."""
    p, degree = prime_of(order), degree_of(order)
    if order > p and order != 16:
        # Of the doubled cosine or sine of an angle, those of p times the angle are a polynomial.
        scale = 2 if is_sine(order) else 1
        before = order // p
        found = {generator(before): scale ** (p - 1)} if _is_generator(before) else {1: -1}
        for k, c in _multiplied_angle(p).items():
            if k < p:
                add_multiple(found, {root_product(1, [(order, k)]): -c * scale ** (p - k)})
        return found
    if p == 2:
        return {1: 2, 2: 1}
    coefficients = _sines_of_squares(p) if is_sine(order) else _cosines(p)
    return {
        t: c
        for k, own in enumerate(coefficients[:degree])
        for r, c in own.items()
        if c
        for t, _ in multiply_roots(r, root_product(1, [(order, k)]) if k else 1)
    }


def _multiplied_angle(m: int) -> dict[int, int]:
    """Of the polynomial that takes 2 cos(t) to 2 cos(m t), by powers."""
    before, now = {0: 2}, {1: 1}
    for _ in range(m - 1):
        after = {k + 1: c for k, c in now.items()}
        for k, c in before.items():
            after[k] = after.get(k, 0) - c
        before, now = now, after
    return {k: c for k, c in now.items() if c}


def _cosines(p: int) -> list[dict[Root, int]]:
    """Minus the coefficients, by powers, of the polynomial whose zeros are 2 cos(2 pi a / p)."""
    return [{1: -int(c)} for c in flint.fmpz_poly.cos_minpoly(p)]


def _sines_of_squares(p: int) -> list[dict[Root, int]]:
    """The same where zeros are 4 sin(2 pi a / p), a the squares modulo p: u + v sqrt(p).

    The other units give the same with the root's sign changed.
    """
    squares = {a * a % p for a in range(1, p)}
    with flint.ctx.workprec(_BITS):
        both = [
            flint.arb_poly.from_roots([_value_at(p, a) for a in own])
            for own in (sorted(squares), sorted(set(range(1, p)) - squares))
        ]
        root = flint.arb(p).sqrt()
        pairs = [(both[0][k], both[1][k]) for k in range(len(squares) + 1)]
        return [{1: -_whole((x + y) / 2), p: -_whole((x - y) / (2 * root))} for x, y in pairs]


def _whole(x: flint.arb) -> int:
    found = x.unique_fmpz()
    assert found is not None
    return int(found)


def _value_at(order: int, unit: int) -> flint.arb:
    """A generator's conjugate, at a multiple of its angle."""
    turns = flint.fmpq(2 * unit, order)
    if is_sine(order):
        return 4 * flint.arb.sin_pi_fmpq(turns)
    return 2 * flint.arb.cos_pi_fmpq(turns)


def ball_of(root: Root) -> flint.arb:
    """A ball that contains a member of the basis, in the digits of FLINT's context."""
    found = flint.arb(radicand_of(root)).sqrt()
    for order, k in powers_of(root):
        found *= _value_at(order, 1) ** k
    return found


# Cosines and sines in the basis.


def cosine_of_turns(turns: Fraction) -> Sum | None:
    """The cosine of a rational number of turns.

    None where cosine and sine are in a field of a degree above `MOST_DEGREE`.
    """
    n = lcm(4, turns.denominator)
    if n > _largest_order() or _totient(n) > 2 * MOST_DEGREE:
        return None
    cosine, sine = {1: flint.fmpq(1)}, {}
    for order, a in _by_prime_powers(turns):
        own = _doubled_cosine(order, a), _doubled_sine(order, a)
        halves = [{r: flint.fmpq(1, 2) * c for r, c in terms.items()} for terms in own]
        c, s = multiply_sums(cosine, halves[0]), multiply_sums(sine, halves[0])
        add_multiple(c, multiply_sums(sine, halves[1]), -1)
        add_multiple(s, multiply_sums(cosine, halves[1]))
        cosine, sine = c, s
    return cosine


def _totient(n: int) -> int:
    return sum(1 for a in range(1, n + 1) if gcd(a, n) == 1)


def _largest_order() -> int:
    """An n above which phi(n) / 2 is larger than `MOST_DEGREE`: phi(n) >= sqrt(n / 2)."""
    return 8 * MOST_DEGREE**2


def _by_prime_powers(turns: Fraction) -> Iterator[tuple[int, int]]:
    """Fractions of prime powers whose sum differs from a number by an integer."""
    n = turns.denominator
    for p, k in flint.fmpz(n).factor() if n > 1 else ():
        q = int(p) ** int(k)
        yield q, turns.numerator * pow(n // q, -1, q) % q


def _multiply_angle(doubled: Sum, m: int) -> Sum:
    """2 cos(m t) from 2 cos(t)."""
    before, now = {1: 2}, doubled
    if m == 0:
        return before
    for _ in range(m - 1):
        after = multiply_sums(doubled, now)
        add_multiple(after, before, -1)
        before, now = now, {r: c for r, c in after.items() if c}
    return now


@lru_cache(maxsize=1024)
def _doubled_cosine(order: int, a: int) -> Mapping[Root, Any]:
    """2 cos(2 pi a / q)."""
    a %= order
    if is_sine(order):
        # The angle is twice b times the first one, and 2 cos(2 t) = 2 - (2 sin t)^2.
        half = _doubled_sine(order, a * pow(2, -1, order) % order)
        found: Sum = {1: 2}
        add_multiple(found, multiply_sums(half, half), -1)
        return found
    first: dict[int, Sum] = {1: {1: 2}, 2: {1: -2}, 3: {1: -1}, 4: {}, 8: {2: 1}}
    return _multiply_angle(first.get(order, {generator(order): 1}), min(a, order - a))


@lru_cache(maxsize=1024)
def _doubled_sine(order: int, a: int) -> Mapping[Root, Any]:
    """2 sin(2 pi a / q)."""
    a %= order
    if order <= 2 or a == 0:
        return {}
    p = prime_of(order)
    if p == 2:
        return _doubled_cosine(order, a - order // 4)
    if is_sine(order):
        # 2 sin(m t) is the doubled cosine's polynomial of 2 sin(t), for odd m, but for the sign.
        m = a if a % 2 else order - a
        sign = (1 if m % 4 == 1 else -1) * (1 if a % 2 else -1)
        found = _multiply_angle({generator(order): flint.fmpq(1, 2)}, m)
        return {r: sign * c for r, c in found.items()}
    # The root of p is the sum of (j/p) sin(2 pi j / p), and products of sines are cosines.
    found = {}
    for j in range(1, p):
        symbol, b = legendre(j, p), j * (order // p)
        add_multiple(found, _doubled_cosine(order, a - b), flint.fmpq(symbol, 2 * p))
        add_multiple(found, _doubled_cosine(order, a + b), flint.fmpq(-symbol, 2 * p))
    return multiply_sums({p: flint.fmpq(1)}, found)


def legendre(a: int, p: int) -> int:
    """1 for a square modulo a prime, -1 for other units; of 2, whether 8 divides a - 1."""
    if p == 2:
        return 1 if a % 8 == 1 else -1
    return 1 if pow(a, (p - 1) // 2, p) == 1 else -1


@cache
def nonsquare(p: int) -> int:
    """The smallest integer whose `legendre` symbol is -1; for 2 one that leaves 1 modulo 4."""
    return 5 if p == 2 else next(a for a in range(2, p) if legendre(a, p) < 0)


# Conjugates.


def image_of_root(root: Root, units: Mapping[int, int]) -> Mapping[Root, Any]:
    """A conjugate of a member of the basis.

    Args:
        units: for primes p an integer prime to p by which roots of unity of orders that are powers
            of p are raised; it leaves 1 modulo 4 for 2, so that the imaginary unit stays. Without
            one for its prime, a generator stays.
    """
    signs = prod(legendre(units[p], p) for p in primes_of(radicand_of(root)) if p in units)
    found: Mapping[Root, Any] = {radicand_of(root): signs}
    for order, k in powers_of(root):
        unit = units.get(prime_of(order), 1) % order
        if is_sine(order):
            image = {r: 2 * c for r, c in _doubled_sine(order, unit).items()}
        else:
            image = dict(_doubled_cosine(order, unit))
        for _ in range(k):
            found = multiply_sums(found, image)
    return found


def conjugations(generators: Iterable[Root]) -> list[dict[int, int]]:
    """The automorphisms of the field of generators, the identity first, as `image_of_root` wants.

    Args:
        generators: with those of their relations; roots of other integers than primes too.
    """
    generators = list(generators)
    orders: dict[int, int] = {}
    for g in generators:
        for p in primes_of(radicand_of(g)):
            orders.setdefault(p, 1)
        for q, _ in powers_of(g):
            orders[prime_of(q)] = max(q, orders.get(prime_of(q), 1))
    units = [[(p, a) for a in _units(p, q)] for p, q in sorted(orders.items())]
    found: dict[Any, dict[int, int]] = {}
    for chosen in product(*units):
        own = dict(chosen)
        images = (image_of_root(g, own).items() for g in generators)
        key = tuple(frozenset((r, flint.fmpq(1) * c) for r, c in image if c) for image in images)
        found.setdefault(key, own)
    return list(found.values())


def _units(p: int, order: int) -> list[int]:
    if p == 2:
        return list(range(1, max(order, 8), 4))
    if order == 1:
        return [1, nonsquare(p)]
    return [a for a in range(1, order) if a % p]


def spanning_roots(roots: Iterable[Root]) -> tuple[tuple[Root, ...], tuple[Root, ...]]:
    """Generators and basis, 1 first, of the least field that has members of the basis.

    The generators are roots of integers, each with a prime that divides none of the others, and
    those of prime powers, the lower ones first.
    """
    roots = list(roots)
    own = {generator(q) for r in roots for q, _ in powers_of(r)}
    closure = {g for r in own for g in generators_of(r)}
    cosines = sorted((g for g in closure if not isinstance(g, int)), key=sort_key)
    radicands: list[int] = []
    for r in sorted({radicand_of(r) for r in roots} | {g for g in closure if isinstance(g, int)}):
        for s in radicands:
            if r % own_prime(s, radicands) == 0:
                ((r, _),) = multiply_roots(r, s)
        if r > 1:
            p = primes_of(r)[-1]
            radicands = [multiply_roots(s, r)[0][0] if s % p == 0 else s for s in radicands] + [r]
    basis: list[Root] = [1]
    for r in radicands:
        basis += [multiply_roots(r, s)[0][0] for s in basis]
    for g in cosines:
        ((order, _),) = powers_of(g)
        basis += [
            root_product(radicand_of(s), [*powers_of(s), (order, k)])
            for k in range(1, degree_of(order))
            for s in tuple(basis)
        ]
    return (*radicands, *cosines), tuple(basis)


def own_prime(radicand: int, radicands: Iterable[int]) -> int:
    """The largest prime of an integer that divides none of the other ones."""
    others = [s for s in radicands if s != radicand]
    return next(p for p in primes_of(radicand)[::-1] if all(s % p for s in others))
