"""Coordinates in which a system looks as if its origin and its units had been chosen for it.

``f(y + c)`` has the leading form of ``f`` and, in the next degree, ``f_(d-1) + c . grad f_d``. The
origin ``c`` is where as many of these coefficients as possible vanish, exactly: the centres of
circles, spheres and quadrics, of products of them, and of anything that was translated from such
coordinates. Where they have different centres, equations vote, and what has the fewest terms is
taken. What leading forms do not determine, the next forms do, degree by degree. Scales make pure
powers in one equation, as ``a x^2 + b y^2`` has, of one size, exactly where the root is rational,
and leave coefficients of comparable size else. Where little is gained, or there would be more
terms, nothing changes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import comb, gcd, inf, isqrt, lcm, log2, prod
from typing import Any

import numpy as np

from nag.algebra.number import Number
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.scaling import Logarithms, magnitude, scaled_terms, variable_scales

# Least distance from 0, in radii of where the zeros lie, that makes a new origin worth its digits.
FAR = 8.0
# Binary orders between coefficients of one equation, at their best scales, from which on there are
# zeros of several sizes: what was translated little is far from some of them.
SEVERAL_SIZES = 8.0
# Scales below this bring nothing.
LEAST_SCALE = 8
# An origin may leave a variable this many binary orders larger than it was: roundings of scales.
LARGER = 1
# Numbers of so many bits are taken as they are; others to so many bits beyond the radius.
SIMPLE, DIGITS = 128, 6
# Terms beyond which no system is moved.
MOST_TERMS = 20_000
# Terms beyond which places of as many votes are not compared by the terms that are left there.
MOST_COMPARED = 500
Row = dict[int, int]
Plane = tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class NaturalCoordinates:
    """Variables ``y`` with ``x_i = scales[i] y_i + origin[i]``, exactly.

    Attributes:
        scales: positive.
    """

    scales: tuple[Fraction, ...]
    origin: tuple[Fraction, ...]

    @classmethod
    def identity(cls, n: int) -> NaturalCoordinates:
        """The variables as they are."""
        return cls((Fraction(1),) * n, (Fraction(0),) * n)

    @cached_property
    def is_identity(self) -> bool:
        return not any(self.origin) and all(s == 1 for s in self.scales)

    @cached_property
    def is_exact_in_doubles(self) -> bool:
        """Whether to change coordinates rounds nothing."""
        return not any(self.origin) and all(_is_power_of_two(s) for s in self.scales)

    @cached_property
    def sizes(self) -> np.ndarray:
        """The scales in doubles, shape ``(n,)``."""
        return np.array([float(s) for s in self.scales])

    @cached_property
    def without_scales(self) -> NaturalCoordinates:
        """The same origin, and the units that are given."""
        return replace(self, scales=(Fraction(1),) * len(self.scales))

    @cached_property
    def inverse(self) -> NaturalCoordinates:
        """The way back: ``y_i = (x_i - origin[i]) / scales[i]``."""
        if self.is_identity:
            return self
        scales = tuple(1 / s for s in self.scales)
        return NaturalCoordinates(
            scales, tuple(-b * s for b, s in zip(self.origin, scales, strict=True))
        )

    def compose(self, other: NaturalCoordinates) -> NaturalCoordinates:
        """Other coordinates of ``y``."""
        if other.is_identity:
            return self
        scales = tuple(s * t for s, t in zip(self.scales, other.scales, strict=True))
        steps = (s * b for s, b in zip(self.scales, other.origin, strict=True))
        return NaturalCoordinates(
            scales, tuple(b + step for b, step in zip(self.origin, steps, strict=True))
        )

    def polynomial(self, f: Polynomial) -> Polynomial:
        """A polynomial in ``x`` as one in ``y``, over a power of two near its largest number.

        Further variables, after these, stay as they are.
        """
        if self.is_identity:
            return f
        further = f.n - len(self.scales)
        if self.is_exact_in_doubles:
            return Polynomial(f.n, scaled_terms(f, np.pad(self._powers, (0, further))))
        moved = shift_polynomial(f, (*self.origin, *([Fraction(0)] * further)))
        scales = (*self.scales, *([Fraction(1)] * further))
        factors = {e: _power_product(scales, e) for e in moved.terms}
        return _normalise_size(Polynomial(f.n, {e: c * factors[e] for e, c in moved.terms.items()}))

    def system(self, system: PolynomialSystem) -> PolynomialSystem:
        """A system in ``x`` as one in ``y``."""
        if self.is_identity:
            return system
        return replace(
            system,
            polynomials=tuple(self.polynomial(f) for f in system.polynomials),
            nonzero=tuple(self.polynomial(g) for g in system.nonzero),
        )

    def points(self, x: np.ndarray) -> np.ndarray:
        """Points ``x`` in doubles as ``y``, the last axis theirs; further coordinates stay."""
        if self.is_identity:
            return x
        n = len(self.scales)
        first, rest = self._origin_in_doubles
        y = (x[..., :n] - first - rest) / self.sizes
        return np.concatenate([y, x[..., n:]], axis=-1)

    def numbers(self, x: Sequence[Number]) -> tuple[Number, ...]:
        """An exact point ``x`` as ``y``."""
        if self.is_identity:
            return tuple(x)
        parts = zip(x, self.scales, self.origin, strict=True)
        return tuple((z - b) / s for z, s, b in parts)

    def rows(self, rows: np.ndarray) -> np.ndarray:
        """A slice by rows on ``(1, x)`` as one by rows on ``(1, y)``, of norms about one.

        Each number is rounded once, and none where only powers of two are scales.
        """
        if self.is_identity:
            return rows
        if self.is_exact_in_doubles:
            moved = rows * np.append(1.0, self.sizes)
        else:
            moved = np.array([self._row(row) for row in rows.tolist()]).reshape(rows.shape)
        norms = np.frexp(np.linalg.norm(moved[:, 1:], axis=1))[1]
        return np.ldexp(1.0, -norms)[:, None] * moved

    def _row(self, row: Sequence[complex]) -> list[complex]:
        parts = []
        for name in ("real", "imag"):
            first, *own = (Fraction(getattr(c, name)) for c in row)
            first += sum((c * b for c, b in zip(own, self.origin, strict=True) if c), Fraction(0))
            own = [c * s for c, s in zip(own, self.scales, strict=True)]
            parts.append([float(c) for c in (first, *own)])
        return [complex(a, b) for a, b in zip(*parts, strict=True)]

    @cached_property
    def _powers(self) -> np.ndarray:
        """Binary logarithms of scales that are powers of two."""
        ratios = (s.as_integer_ratio() for s in self.scales)
        return np.array([p.bit_length() - q.bit_length() for p, q in ratios], dtype=np.int64)

    @cached_property
    def _origin_in_doubles(self) -> tuple[np.ndarray, np.ndarray]:
        """The origin, and what is left of it when it is rounded."""
        first = [float(b) for b in self.origin]
        rest = [float(b - Fraction(a)) for a, b in zip(first, self.origin, strict=True)]
        return np.array(first), np.array(rest)


def natural_coordinates(polynomials: Sequence[Polynomial], n: int) -> NaturalCoordinates:
    """The coordinates that suit polynomials in ``n`` variables best; often those that they have.

    Equations of degree one do not count: they are solved before anything is tracked.
    """
    nothing = NaturalCoordinates.identity(n)
    curved = [f for f in polynomials if f.degree > 1]
    if not curved or not all(f.exact for f in polynomials):
        return nothing
    origin = _origin(curved, n)
    if not any(origin) and all(map(_is_even, curved)):
        return nothing
    origin, moved, powers = _accepted_origin(curved, origin)
    if _are_small(powers):
        return nothing if not any(origin) else replace(nothing, origin=origin)
    return NaturalCoordinates(_scales(moved, powers), origin)


def scale_coordinates(polynomials: Sequence[Polynomial], n: int) -> NaturalCoordinates:
    """Powers of two as scales, about the same origin, that make the coefficients comparable.

    The coordinates that are given, where that is little.

    >>> import nag
    >>> system = nag.system("(1024*x)^2 + y^2 - 1", "x y")
    >>> [str(s) for s in scale_coordinates(system.polynomials, system.n).scales]
    ['1/1024', '1']
    """
    powers = variable_scales(polynomials, n)
    if _are_small(powers):
        return NaturalCoordinates.identity(n)
    return NaturalCoordinates(tuple(Fraction(2) ** int(k) for k in powers), (Fraction(0),) * n)


def comparable_coordinates(polynomials: Sequence[Polynomial], n: int) -> NaturalCoordinates:
    """Natural coordinates, scaled so that the coefficients of all equations are comparable.

    Whatever starts from sets of zeros begins by going there, linear equations and all.
    """
    natural = natural_coordinates(polynomials, n)
    return natural.compose(scale_coordinates([natural.polynomial(f) for f in polynomials], n))


def shift_polynomial(f: Polynomial, origin: Sequence[Fraction]) -> Polynomial:
    """``f(y + origin)``."""
    if not any(origin[i] for i in f.support):
        return f
    terms, common = _shift_terms(f, origin)
    if f.exact:
        return Polynomial(f.n, {e: Fraction(c, common) for e, c in terms.items()})
    return Polynomial(f.n, {e: c / common for e, c in terms.items()})


def _shift_terms(f: Polynomial, origin: Sequence[Fraction]) -> tuple[dict[Exponents, Any], int]:
    """``f(y + origin)`` times a whole number, and that: of an exact polynomial, in integers."""
    terms, common = f.whole or (dict(f.terms), 1)
    for i in f.support:
        p, q = origin[i].as_integer_ratio()
        if not p:
            continue
        top = max(e[i] for e in terms)
        common *= q**top
        # Binomial coefficients times powers of the shift, for each exponent.
        weights = [
            [comb(k, j) * p**j * q ** (top - j) for j in range(k + 1)] for k in range(top + 1)
        ]
        shifted: dict[Exponents, Any] = {}
        for e, c in terms.items():
            key, k = e, e[i]
            for j, weight in enumerate(weights[k]):
                if j:
                    key = (*e[:i], k - j, *e[i + 1 :])
                shifted[key] = shifted[key] + c * weight if key in shifted else c * weight
        terms = shifted
    return {e: c for e, c in terms.items() if c} if f.exact else terms, common


def _accepted_origin(
    polynomials: Sequence[Polynomial], origin: tuple[Fraction, ...]
) -> tuple[tuple[Fraction, ...], Sequence[Polynomial], np.ndarray]:
    """An origin where it is far away for how close the zeros lie together around it; 0 else.

    Also the polynomials about that origin, and their `variable_scales`.
    """
    n = len(origin)
    given = Logarithms.of(polynomials, n)
    before = given.best_scales()
    nothing = (Fraction(0),) * n, polynomials, before
    if not any(origin):
        return nothing
    moved = [_shift_terms(f, origin) for f in polynomials]
    pairs = zip(polynomials, moved, strict=True)
    vanishing = [len(f.terms) - len(terms) for f, (terms, _) in pairs]
    sizes = [magnitude(b) if b else -inf for b in origin]
    # That more terms vanish than numbers were chosen is no accident.
    translated = sum(vanishing) > sum(map(bool, origin))
    # Else no equation may be denser for it. Zeros that are far from their origin make their
    # coordinates as large as it is.
    far = (b > k - log2(FAR) for b, k in zip(sizes, before.tolist(), strict=True))
    if not translated and (min(vanishing) < 0 or not any(far)):
        return nothing
    # Scales that the equations leave free, as those of a cone, are any: to have them is a gain only
    # where terms vanish for it. Else they are what they were.
    there = Logarithms.of_integers(moved, n)
    after = there.best_scales(near=0.0 if sum(vanishing) > 0 else before)
    each = list(zip(sizes, before.tolist(), after.tolist(), strict=True))
    # Terms that vanish far from all zeros, as where a linear form of several variables is zero on
    # the axis of one of them, say nothing of where these are.
    kept = [k <= old + LARGER or b <= old for b, old, k in each]
    gain = max((b - k for (b, _, k), keep in zip(each, kept, strict=True) if keep), default=-inf)
    several = translated and there.spread(after) > SEVERAL_SIZES
    if gain <= log2(FAR) and not several:
        return nothing
    # What is gained in distance must not be lost in coefficients that no scales make comparable.
    if not translated and gain <= there.unevenness(after) - given.unevenness(before):
        return nothing
    accepted = tuple(
        shorten_origin(b, k) if keep else Fraction(0)
        for b, k, keep in zip(origin, after.tolist(), kept, strict=True)
    )
    about = [shift_polynomial(f, accepted) for f in polynomials]
    return accepted, about, after if accepted == origin else variable_scales(about, n)


def _are_small(powers: np.ndarray) -> bool:
    """Whether scales bring nothing."""
    return max(map(abs, powers.tolist()), default=0) < log2(LEAST_SCALE)


def _is_even(f: Polynomial) -> bool:
    """Whether no coefficients differ by the scales that are worth it."""
    sizes = [abs(c) for c in f.whole[0].values()]
    return max(sizes) <= LEAST_SCALE * min(sizes)


def shorten_origin(b: Number, power: int) -> Fraction:
    """A number as it is, if it is a short fraction; else one near it, for a radius ``2^power``."""
    near = b if isinstance(b, Fraction) else Fraction(float(b))
    if near is b and b.numerator.bit_length() + b.denominator.bit_length() <= SIMPLE:
        return b
    unit = Fraction(2) ** (power - DIGITS)
    return round(near / unit) * unit


def _origin(polynomials: Sequence[Polynomial], n: int) -> tuple[Fraction, ...]:
    """Where coefficients below the leading ones vanish, as many as can be made to; 0 if unknown.

    A translation of the equations translates it, but along directions that change none of them: to
    sort the equations, to count votes and terms does not depend on where the origin is. Variables
    with a coefficient that vanishes already stay.
    """
    origin = [Fraction(0)] * n
    directions = [{i: 1} for i in _misplaced_variables(polynomials, n)]
    if directions:
        polynomials = sorted(polynomials, key=_simplicity)
    moved = polynomials
    for level in range(1, max(f.degree for f in polynomials) + 1):
        if not directions:
            break
        if not _have_few_terms(polynomials, [origin], MOST_TERMS):
            return (Fraction(0),) * n
        if any(origin):
            moved = [shift_polynomial(f, origin) for f in polynomials]
        variables = sorted({i for way in directions for i in way})
        rows = [_conditions(f, level, variables) for f in moved]
        step, directions = _solve_rows(rows, directions, moved)
        for i, b in step.items():
            origin[i] += b
    return tuple(origin)


def _misplaced_variables(polynomials: Sequence[Polynomial], n: int) -> list[int]:
    """The variables whose origin may be another one.

    Where ``x^e`` is a leading term and ``x^(e - 1_i)`` has no other one for a neighbour, and is no
    term, variable i was not translated; nor where all other such neighbours' variables were not.
    """
    rows: list[list[int]] = []
    for f in polynomials:
        below: dict[Exponents, list[int]] = {}
        terms = f.terms
        for e in f.leading:
            for i, k in enumerate(e):
                if k:
                    key = (*e[:i], k - 1, *e[i + 1 :])
                    if key not in terms:
                        below.setdefault(key, []).append(i)
        rows += below.values()
    left = set(range(n))
    while settled := {places[0] for places in rows if len(places) == 1}:
        left -= settled
        rows = [[i for i in places if i in left] for places in rows]
    return sorted(left)


def _simplicity(f: Polynomial) -> tuple[int, int]:
    """Numbers of variables and of leading terms, which are the same about any origin."""
    return len(f.support), len(f.leading)


def _have_few_terms(
    polynomials: Sequence[Polynomial], origins: Iterable[Sequence[Fraction]], most: int
) -> bool:
    """Whether polynomials have at most so many terms about all origins, before any are collected.

    No more terms are counted than the answer takes: planes can be many, and polynomials large.
    """
    count = 0
    for origin in origins:
        for f in polynomials:
            places = [i for i in f.support if origin[i]]
            if not places:
                count += len(f.terms)
                continue
            for e in f.terms:
                count += prod(1 + e[i] for i in places)
                if count > most:
                    return False
    return count <= most


def _conditions(f: Polynomial, level: int, variables: Sequence[int]) -> list[tuple[Row, int]]:
    """Linear equations for a shift by which the form ``level`` degrees below the first vanishes.

    For shifts of some variables that change no form above it; each a row and a right side, times
    the common denominator of the coefficients.
    """
    top, rows = f.degree, dict[Exponents, Row]()
    if level > top:
        return []
    terms, _ = f.whole
    for e in f.leading if level == 1 else [e for e in terms if sum(e) == top - level + 1]:
        for i in variables:
            k = e[i]
            if k:
                row = rows.setdefault((*e[:i], k - 1, *e[i + 1 :]), {})
                row[i] = row.get(i, 0) + k * terms[e]
    below = sorted(rows, reverse=True)
    return [(rows[e], -terms.get(e, 0)) for e in below]


def _solve_rows(
    rows: Iterable[Sequence[tuple[Row, int]]],
    directions: Sequence[Row],
    polynomials: Sequence[Polynomial],
) -> tuple[dict[int, Fraction], list[Row]]:
    """A combination of directions that satisfies many rows, and the directions left free.

    Each row is a plane of combinations. The plane that most equations have comes first, then the
    one that most have within it, and so on. Of as many votes, those come first that ask for fewest
    directions, and of those that ask for one only, that about which the polynomials have the
    fewest terms. All is done in integers, which take a tenth of the time of fractions: rows and
    directions count up to factors.

    Args:
        rows: those of each equation.
    """
    along: dict[int, list[tuple[int, int]]] = {}
    for k, way in enumerate(directions):
        for i, c in way.items():
            along.setdefault(i, []).append((k, c))
    # The right side stands in the place of the number of directions.
    right = len(directions)
    votes: dict[Plane, int] = {}
    for of_equation in rows:
        planes: dict[Plane, int] = {}
        for row, value in of_equation:
            own: Row = {}
            for i, c in row.items():
                for k, d in along.get(i, ()):
                    own[k] = own.get(k, 0) + c * d
            own[right] = value
            _add_votes(planes, own, 1, right)
        for plane in planes:
            votes[plane] = votes.get(plane, 0) + 1
    pivots: dict[int, Row] = {}
    while votes:
        pivot = dict(_most_voted(votes, pivots, directions, polynomials))
        column = min(pivot)
        for row in pivots.values():
            if column in row:
                _eliminate(row, pivot, column)
        pivots[column] = pivot
        for plane in [plane for plane in votes if any(k == column for k, _ in plane)]:
            row, count = dict(plane), votes.pop(plane)
            _eliminate(row, pivot, column)
            _add_votes(votes, row, count, right)
    step = _combine_directions(pivots, directions)
    free = []
    for k, way in enumerate(directions):
        if k not in pivots:
            depending = [
                (row[column], column, row[k]) for column, row in pivots.items() if k in row
            ]
            common = lcm(*(lead for lead, _, _ in depending))
            left = {i: common * c for i, c in way.items()}
            for lead, j, c in depending:
                _add(left, directions[j], -c * (common // lead))
            free.append(left)
    return step, free


def _add_votes(votes: dict[Plane, int], row: Row, count: int, right: int) -> None:
    """Add votes for the plane that a row is; a row with nothing but a right side is none."""
    items = sorted((k, c) for k, c in row.items() if c)
    if not items or items[0][0] == right:
        return
    unit = gcd(*(c for _, c in items))
    if items[0][1] < 0:
        unit = -unit
    plane = tuple((k, c // unit) for k, c in items)
    votes[plane] = votes.get(plane, 0) + count


def _combine_directions(pivots: dict[int, Row], directions: Sequence[Row]) -> dict[int, Fraction]:
    """The combination of directions that rows, each alone in its column, ask for."""
    step: dict[int, Fraction] = {}
    right = len(directions)
    for column, row in pivots.items():
        if right in row:
            value = Fraction(row[right], row[column])
            for i, c in directions[column].items():
                step[i] = step.get(i, Fraction(0)) + c * value
    return step


def _most_voted(
    votes: dict[Plane, int],
    pivots: dict[int, Row],
    directions: Sequence[Row],
    polynomials: Sequence[Polynomial],
) -> Plane:
    """The plane of most votes, the first of several; see `_solve_rows` for parallel ones."""
    most, right = max(votes.values()), len(directions)
    tied = [plane for plane, count in votes.items() if count == most]
    tied.sort(key=lambda plane: sum(k < right for k, _ in plane))
    (column, _), *others = tied[0]
    if any(k < right for k, _ in others):
        return tied[0]
    parallel = [plane for plane in tied if [k for k, _ in plane if k < right] == [column]]
    if len(parallel) == 1:
        return tied[0]
    steps = []
    for plane in parallel:
        within = {column: dict(plane)}
        for k, pivot in pivots.items():
            row = dict(pivot)
            if column in row:
                _eliminate(row, within[column], column)
            within[k] = row
        step = _combine_directions(within, directions)
        steps.append([step.get(i, Fraction(0)) for i in range(polynomials[0].n)])
    if not _have_few_terms(polynomials, steps, MOST_COMPARED):
        return tied[0]
    counts = [_count_terms(polynomials, step) for step in steps]
    return parallel[counts.index(min(counts))]


def _count_terms(polynomials: Sequence[Polynomial], origin: Sequence[Fraction]) -> int:
    """Terms of the polynomials about another origin."""
    return sum(len(_shift_terms(f, origin)[0]) for f in polynomials)


def _eliminate(row: Row, other: Row, column: int) -> None:
    """Free a row of a column by a multiple of another one; common factors are taken out."""
    lead, factor = other[column], -row[column]
    for i in row:
        row[i] *= lead
    _add(row, other, factor)
    common = gcd(*row.values())
    if common > 1:
        for i in row:
            row[i] //= common


def _add(row: Row, other: Row, factor: int) -> None:
    """Add a multiple of another row; what becomes zero is left out."""
    for i, c in other.items():
        value = row.get(i, 0) + factor * c
        if value:
            row[i] = value
        else:
            row.pop(i, None)


def _scales(polynomials: Sequence[Polynomial], powers: np.ndarray) -> tuple[Fraction, ...]:
    """Scales near the powers of two given, with which pure powers in an equation are of one size.

    Args:
        powers: binary logarithms, as `variable_scales` finds them.
    """
    n = len(powers)
    # Variables whose scales hang together, each with its scale beside that of its group.
    group, beside = list(range(n)), [Fraction(1)] * n
    for f in polynomials:
        for i, j, ratio in _equal_powers(f):
            if group[i] != group[j]:
                factor, old = ratio * beside[j] / beside[i], group[i]
                for k in range(n):
                    if group[k] == old:
                        group[k], beside[k] = group[j], beside[k] * factor
    scales = [Fraction(1)] * n
    for name in set(group):
        own = [k for k in range(n) if group[k] == name]
        mean = round(sum(int(powers[k]) - magnitude(beside[k]) for k in own) / len(own))
        for k in own:
            scales[k] = beside[k] * Fraction(2) ** mean
    return tuple(scales)


def _equal_powers(f: Polynomial) -> list[tuple[int, int, Fraction]]:
    """Variables i, j and ``s_i / s_j`` with which two pure powers of one degree are of one size."""
    pure: dict[int, list[tuple[int, Fraction]]] = {}
    for e, c in sorted(f.terms.items(), reverse=True):
        k = sum(e)
        if k > 1 and k in e:
            pure.setdefault(k, []).append((e.index(k), abs(c)))
    found = []
    for k, powers in pure.items():
        (j, d), *others = powers
        for i, c in others:
            ratio = _rational_root(d / c, k)
            if ratio is not None:
                found.append((i, j, ratio))
    return found


def _rational_root(c: Fraction, k: int) -> Fraction | None:
    """The k-th root of a positive number, if it is rational."""
    roots = []
    for whole in (c.numerator, c.denominator):
        root = isqrt(whole) if k == 2 else round(2.0 ** (log2(whole) / k))
        if root**k != whole:
            return None
        roots.append(root)
    return Fraction(*roots)


def _power_product(numbers: Sequence[Fraction], exponents: Exponents) -> Fraction:
    return prod((b**k for b, k in zip(numbers, exponents, strict=True) if k), start=Fraction(1))


def _normalise_size(f: Polynomial) -> Polynomial:
    """A polynomial over a power of two near its largest coefficient."""
    return Polynomial(f.n, scaled_terms(f, np.zeros(f.n, dtype=np.int64)))


def _is_power_of_two(s: Fraction) -> bool:
    p, q = s.numerator, s.denominator
    return p & (p - 1) == 0 and q & (q - 1) == 0
