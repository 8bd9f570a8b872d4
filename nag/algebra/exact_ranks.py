"""Ranks of exact matrices: over the rationals by FLINT, and modulo primes.

One of three ways to tell a rank; `nag.numerics.ball_ranks` has that of numbers with radii, and
`nag.numerics.double_ranks` that of doubles. What decides is worked out over the rationals, or over
the number field of a zero. Where a bound is enough, one prime gives it: a rank is no larger modulo
a prime than it is, and smaller with a probability of some 1e-18 for random numbers. A matrix of
sums of roots is one of rational blocks; modulo a prime roots are residues. Entries with other
functions, which are zero where they are to many digits, take an elimination of our own.

Nothing here has a tolerance.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import islice, product
from typing import TYPE_CHECKING, Any

import flint

from nag.algebra.flint_numbers import to_fraction, to_rational
from nag.algebra.number import Exact, Irrational, Number, Surd, is_zero
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.root_basis import (
    Root,
    conjugations,
    degree_of,
    generator,
    generators_of,
    is_sine,
    multiply_roots,
    own_prime,
    powers_of,
    primes_of,
    radicand_of,
    relation,
    root_product,
    spanning_roots,
)
from nag.algebra.surd import normal_sum
from nag.errors import NagError

if TYPE_CHECKING:
    import numpy as np

Rows = Sequence[Sequence[int]]
Row = tuple[Number, ...]


def primes_below(bound: int) -> Iterator[int]:
    """The largest primes first, of those that leave 3 modulo 4.

    A square root modulo such a prime p is a power, the one of exponent (p + 1) / 4.
    """
    for p in range((bound - 4) // 4 * 4 + 3, 2, -4):
        if flint.fmpz(p).is_prime():
            yield p


@dataclass(frozen=True)
class PrimeField:
    """Arithmetic modulo a prime below 2^64; numbers are integers, of any size where they are taken.

    A `nag.numerics.ball_ranks.Field`.

    Attributes:
        modulus: the prime.
        choices: which of the zeros of its relation a generator has for an image, as far as it is
            not the first one; generators are those of `nag.algebra.root_basis`.
    """

    modulus: int
    choices: tuple[tuple[Root, int], ...] = ()

    def of(self, c: Exact | int) -> int:
        """The image of an exact number; conjugate numbers may have each other's.

        Raises:
            ZeroDivisionError: if the prime divides its denominator.
            ArithmeticError: if a square root in it does not exist, see `fields_with_roots`.
        """
        if isinstance(c, Surd):
            return c.modulo(self.modulus, self.image)
        if c.denominator % self.modulus == 0:
            raise ZeroDivisionError(f"{self.modulus} divides a denominator")
        return c.numerator * pow(c.denominator, -1, self.modulus) % self.modulus

    def image(self, root: Root) -> int:
        """That of a member of the basis of sums of roots.

        Raises:
            ArithmeticError: if there is none.
        """
        return _image(self, root)

    def root(self, a: int) -> int:
        """One of the two square roots, the same each time.

        Raises:
            ArithmeticError: if there is none.
        """
        root = _root_modulo(a % self.modulus, self.modulus)
        if root is None:
            raise ArithmeticError(f"{a} is no square modulo {self.modulus}")
        return -root % self.modulus if dict(self.choices).get(a) else root

    def _zero(self, order: int) -> int:
        """The image of the generator of a prime power: a zero of its relation."""
        coefficients = [0] * degree_of(order) + [1]
        for r, c in relation(order).items():
            powers = dict(powers_of(r))
            k = powers.pop(order, 0)
            coefficients[k] -= c * self.image(root_product(radicand_of(r), powers.items()))
        p = self.modulus
        factors = flint.nmod_poly([c % p for c in coefficients], p).factor()[1]
        zeros = sorted(int(-f[0] / f[1]) for f, _ in factors if f.degree() == 1)
        if len(zeros) < degree_of(order):
            raise ArithmeticError(f"cosines of {order}ths of a turn are no residues modulo {p}")
        return zeros[dict(self.choices).get(generator(order), 0)]

    def is_zero(self, a: int) -> bool:
        return a % self.modulus == 0

    def matrix(self, rows: Rows) -> flint.nmod_mat:
        """Rows of integers, of which there are some."""
        found = flint.nmod_mat(len(rows), len(rows[0]), self.modulus)
        # Most entries are zero, as a rule, and each that is entered is taken modulo the prime.
        for i, row in enumerate(rows):
            for j, c in enumerate(row):
                if c:
                    found[i, j] = c
        return found

    def rank(self, rows: Rows) -> int:
        """At most that of the same rows over the rationals."""
        return self.matrix(rows).rank() if rows else 0

    def product(self, left: Rows, right: Rows) -> list[list[int]]:
        found = self.matrix(left) * self.matrix(right)
        return [list(map(int, row)) for row in found.tolist()]

    def reduced(self, rows: Rows, columns: int) -> tuple[list[list[int]], list[int]]:
        table, pivots = reduce_matrix(self.matrix(rows))
        return [list(map(int, row)) for row in table], pivots

    def null_space(self, rows: Rows, columns: int) -> list[list[int]]:
        if not rows:
            return [[int(i == j) for j in range(columns)] for i in range(columns)]
        basis, nullity = self.matrix(rows).nullspace()
        return [[int(basis[i, j]) for i in range(columns)] for j in range(nullity)]


@lru_cache(maxsize=4096)
def _image(field: PrimeField, root: Root) -> int:
    found = 1
    for p in primes_of(radicand_of(root)):
        found = found * field.root(p) % field.modulus
    for order, k in powers_of(root):
        base = field.image(generator(order)) if root != generator(order) else field._zero(order)
        found = found * pow(base, k, field.modulus) % field.modulus
    return found


@lru_cache(maxsize=1024)
def _root_modulo(a: int, p: int) -> int | None:
    root = pow(a, (p + 1) // 4, p)
    return root if root * root % p == a else None


# Residues and sums of two are integers of NumPy's too; what is not zero vanishes modulo so large a
# prime by no accident. Two fields where one may be the exception.
LARGEST_PRIME = 2**62
FIELDS = tuple(map(PrimeField, islice(primes_below(LARGEST_PRIME), 2)))
LARGE = FIELDS[0]
# How many primes are tried; half of them lack any one square root.
MOST_PRIMES = 4000
# Square roots, with their products, up to which a matrix is written out over the rationals.
MOST_ROOTS = 8


@lru_cache(maxsize=64)
def fields_with_roots(
    generators: frozenset[Root], bound: int = LARGEST_PRIME, count: int = 2
) -> tuple[PrimeField, ...]:
    """So many fields in which generators of sums of roots have images: `FIELDS` if there are none.

    Fewer where they are not found among the `MOST_PRIMES` largest below a bound.
    """
    found = islice(primes_below(bound), MOST_PRIMES)
    fields = (p for p in found if all(_has_image(g, p) for g in generators))
    return tuple(map(PrimeField, islice(fields, count)))


def _has_image(g: Root, p: int) -> bool:
    """Whether the relation of a generator, and those before it, have all their zeros modulo p.

    Real numbers that are made of n-th roots of unity have, modulo primes that leave 1 or -1.
    """
    if isinstance(g, int):
        return _root_modulo(g, p) is not None
    ((order, _),) = powers_of(g)
    n = 4 * order if is_sine(order) else order
    return p % n in (1, n - 1)


@dataclass(frozen=True)
class NumberField:
    """The field over the rational numbers of sums of roots; it is normal.

    Attributes:
        generators: roots of integers, each with a prime of its own, and those of prime powers.
        roots: a basis, 1 first.
    """

    generators: tuple[Root, ...]
    roots: tuple[Root, ...]

    @classmethod
    def of(cls, values: Iterable[Exact | int]) -> NumberField:
        """The least one that exact numbers are in."""
        return cls(*spanning_roots({r for c in values if isinstance(c, Surd) for r in c.terms}))

    @property
    def degree(self) -> int:
        """Over the rational numbers."""
        return len(self.roots)

    @property
    def basis(self) -> tuple[Exact, ...]:
        """The same as numbers."""
        return tuple(normal_sum({r: flint.fmpq(1)}) for r in self.roots)

    def fields(self, count: int) -> tuple[PrimeField, ...]:
        """So many primes modulo which its numbers have images, fewer if they are not found."""
        every = frozenset(g for r in self.generators for g in generators_of(r))
        return fields_with_roots(every, count=count)

    def conjugates(self, field: PrimeField) -> tuple[PrimeField, ...]:
        """Its images modulo one of these primes, as many as its degree."""
        radicands = [g for g in self.generators if isinstance(g, int)]
        places = [(own_prime(r, radicands), 2) for r in radicands]
        for g in self.generators[len(radicands) :]:
            ((order, _),) = powers_of(g)
            places.append((g, degree_of(order)))
        each = product(*(range(count) for _, count in places))
        return tuple(
            PrimeField(
                field.modulus,
                tuple((g, k) for (g, _), k in zip(places, chosen, strict=True) if k),
            )
            for chosen in each
        )

    def automorphisms(self) -> list[dict[int, int]]:
        """All of them, the identity first, as `Surd.conjugate` wants them."""
        return conjugations(self.generators)


def residues(f: Polynomial, field: PrimeField) -> dict[Exponents, int]:
    """The image of a multiple of a polynomial whose coefficients are known exactly.

    Raises:
        ArithmeticError: if a square root in it does not exist, see `fields_with_roots`.
    """
    assert f.parts
    found: dict[Exponents, int] = {}
    for r, terms in f.parts[0].items():
        root = field.image(r)
        for e, c in terms.items():
            found[e] = (found.get(e, 0) + c * root) % field.modulus
    return found


def field_of(polynomials: Iterable[Polynomial]) -> PrimeField | None:
    """The field of a large prime with images of all coefficients, but for their denominators.

    None where coefficients are not algebraic, or need too many roots.
    """
    generators: set[Root] = set()
    for f in polynomials:
        if not f.algebraic:
            return None
        generators |= f.generators
    return next(iter(fields_with_roots(frozenset(generators))), None)


def rational_matrix(rows: Sequence[Sequence[Fraction | int]]) -> flint.fmpq_mat:
    """Rows, of which there are some, as a matrix of FLINT's."""
    return flint.fmpq_mat([[to_rational(c) for c in row] for row in rows])


def reduce_matrix(matrix: Any) -> tuple[list[list[Any]], list[int]]:
    """The reduced row echelon form of a matrix of FLINT's: its rows, and the pivots' columns."""
    form, rank = matrix.rref()
    table = form.tolist()[:rank]
    return table, [next(j for j, c in enumerate(row) if c) for row in table]


def row_echelon(rows: Sequence[Sequence[Number]]) -> tuple[list[Row], list[int]]:
    """Reduced row echelon form without its zero rows, and the columns of its pivots."""
    if not rows or not rows[0]:
        return [], []
    kinds = {type(c) for row in rows for c in row}
    if Irrational in kinds:
        return _irrational_echelon(rows)
    if Surd in kinds:
        roots = roots_of(rows)
        if len(roots) > MOST_ROOTS:
            return _irrational_echelon(rows)
        return _echelon_with_roots(rows, roots)
    table, pivots = reduce_matrix(rational_matrix(rows))
    return [tuple(map(to_fraction, row)) for row in table], pivots


def roots_of(rows: Iterable[Iterable[Exact | int]]) -> tuple[Root, ...]:
    """Members of the basis, 1 first, that span the least field that exact numbers lie in."""
    return NumberField.of(c for row in rows for c in row).roots


def _over_the_rationals(rows: Sequence[Sequence[Exact | int]], roots: Sequence[Root]) -> Any:
    """The matrix of the same map over the rationals: a block for each entry.

    Rows are multiplied by each root, and the coordinates of entries written side by side.
    """
    size = len(roots)
    found = flint.fmpq_mat(size * len(rows), size * len(rows[0]))
    place = {r: k for k, r in enumerate(roots)}
    for i, row in enumerate(rows):
        for j, c in enumerate(row):
            for r, q in c.terms.items() if isinstance(c, Surd) else ((1, to_rational(c)),):
                for k, s in enumerate(roots) if q else ():
                    for t, factor in multiply_roots(r, s):
                        found[size * i + k, size * j + place[t]] += q * factor
    return found


def _echelon_with_roots(
    rows: Sequence[Sequence[Exact | int]], roots: Sequence[Root]
) -> tuple[list[Row], list[int]]:
    # What it spans over the rationals is mapped to itself by multiplication with any root, so that
    # the reduced form of that matrix is made of blocks as well: units are blocks of ones.
    size = len(roots)
    table, pivots = reduce_matrix(_over_the_rationals(rows, roots))
    echelon = [
        tuple(
            normal_sum(dict(zip(roots, row[k : k + size], strict=True)))
            for k in range(0, len(row), size)
        )
        for row in table[::size]
    ]
    return echelon, [p // size for p in pivots[::size]]


def _irrational_echelon(rows: Sequence[Sequence[Number]]) -> tuple[list[Row], list[int]]:
    matrix = [[Fraction(c) if isinstance(c, int) else c for c in row] for row in rows]
    pivots: list[int] = []
    for column in range(len(matrix[0])):
        done = len(pivots)
        found = next((i for i in range(done, len(matrix)) if not is_zero(matrix[i][column])), None)
        if found is None:
            continue
        matrix[done], matrix[found] = matrix[found], matrix[done]
        pivot = matrix[done][column]
        matrix[done] = [x / pivot for x in matrix[done]]
        for i, row in enumerate(matrix):
            if i != done and not is_zero(row[column]):
                factor = row[column]
                own = zip(row, matrix[done], strict=True)
                matrix[i] = [x - factor * y if y else x for x, y in own]
        pivots.append(column)
    return [tuple(r) for r in matrix[: len(pivots)]], pivots


def rank(rows: Sequence[Sequence[Number]]) -> int:
    """The rank of a matrix that may be empty."""
    kinds = {type(c) for row in rows for c in row}
    if kinds <= {int, Fraction}:
        return int(rational_matrix(rows).rank()) if rows else 0
    return len(row_echelon(rows)[1])


def null_space(rows: Sequence[Sequence[Number]], columns: int) -> list[Row]:
    """A basis of the vectors that all ``rows`` annihilate."""
    reduced, pivots = row_echelon(rows)
    basis = []
    for free in (c for c in range(columns) if c not in pivots):
        vector: list[Number] = [Fraction(0)] * columns
        vector[free] = Fraction(1)
        for row, pivot in zip(reduced, pivots, strict=True):
            vector[pivot] = -row[free]
        basis.append(tuple(vector))
    return basis


def left_inverse(columns: Sequence[Sequence[Number]]) -> list[Row]:
    """Rows y_i with <y_i, columns[j]> = (i == j): the Moore-Penrose left inverse.

    Raises:
        ValueError: if the columns are dependent.
    """
    k = len(columns)
    gram = [
        [sum((x * y for x, y in zip(u, v, strict=True)), Fraction(0)) for v in columns]
        + [Fraction(int(i == j)) for j in range(k)]
        for i, u in enumerate(columns)
    ]
    reduced, pivots = row_echelon(gram)
    if pivots[:k] != list(range(k)):
        raise NagError("the columns are linearly dependent")
    inverse = [row[k:] for row in reduced]
    size = len(columns[0])
    return [
        tuple(
            sum((w * u[m] for w, u in zip(weights, columns, strict=True)), Fraction(0))
            for m in range(size)
        )
        for weights in inverse
    ]


def coefficient_rows(
    polynomials: Sequence[Mapping[Exponents, Any]], monomials: Sequence[Exponents] | None = None
) -> list[list[Any]]:
    """The coefficients of polynomials, given by their terms, in one row each.

    Args:
        monomials: those of the columns, all that occur; in any order if they are left out.
    """
    if monomials is None:
        monomials = list(dict.fromkeys(e for terms in polynomials for e in terms))
    return [[terms.get(e, 0) for e in monomials] for terms in polynomials]


def first_independent_rows(rows: Sequence[Sequence[Number]]) -> list[int]:
    """Indices of the rows that are no linear combinations of those before them."""
    return row_echelon(list(zip(*rows, strict=True)))[1]


def independent_polynomials(polynomials: Sequence[Polynomial]) -> list[Polynomial]:
    """Those polynomials that are no linear combination of earlier ones."""
    rows = coefficient_rows([f.terms for f in polynomials])
    return [polynomials[i] for i in first_independent_rows(rows)]


def jacobian_rank(polynomials: Sequence[Polynomial], point: Sequence[Number]) -> int:
    """The rank of the Jacobian of exact polynomials at an exact point."""
    return rank([[f.derivative(i)(point) for i in range(f.n)] for f in polynomials])


def are_independent_over(rows: Sequence[Sequence[Any]], minimal: flint.fmpq_poly) -> bool:
    """Whether rows over a number field are linearly independent.

    Args:
        rows: of polynomials in a root of ``minimal``, of lower degree.
        minimal: irreducible.
    """
    left = [list(row) for row in rows]
    while left:
        row = left.pop()
        pivot = next((i for i, c in enumerate(row) if c.degree() >= 0), None)
        if pivot is None:
            return False
        common, inverse, _ = row[pivot].xgcd(minimal)
        inverse = inverse / common[0]
        for other in left:
            factor = other[pivot] * inverse % minimal
            if factor.degree() >= 0:
                other[:] = [(a - factor * b) % minimal for a, b in zip(other, row, strict=True)]
    return True


def is_dependent(polynomials: Sequence[Polynomial], rng: np.random.Generator) -> bool:
    """Whether the Jacobian of as many polynomials as variables is singular everywhere.

    Then there are no isolated zeros. Said by its rank at a random point modulo a prime, which is
    smaller than elsewhere with a probability below 1e-15; never said of coefficients that are not
    algebraic.
    """
    field = field_of(polynomials)
    if field is None:
        return False
    n, p = len(polynomials), field.modulus
    try:
        residues = [[(e, field.of(c)) for e, c in f.terms.items()] for f in polynomials]
    except ZeroDivisionError:
        return False
    point = [int(x) for x in rng.integers(1, p, n)]
    inverse = [pow(x, -1, p) for x in point]
    rows = []
    for terms in residues:
        row = [0] * n
        for exponents, value in terms:
            for x, k in zip(point, exponents, strict=True):
                value = value * pow(x, k, p) % p if k else value
            # The derivative of a monomial is the monomial times k / x.
            for i, k in enumerate(exponents):
                if k:
                    row[i] += value * k * inverse[i]
        rows.append(row)
    return field.rank(rows) < n
