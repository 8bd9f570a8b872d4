"""Pairs of variables on circles, and linear equations that are complex ones in them.

Where c^2 + N s^2 = r, the isotropic coordinates z = c + i sqrt(N) s and w = c - i sqrt(N) s have
the product r. Of two linear equations in such pairs, one of which is the other turned by a right
angle, as those by which a loop of a planar linkage closes, one times i sqrt(N) plus the other is an
equation in the z alone, and its conjugate is one in the w.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import sqrt

import numpy as np

from nag.algebra.number import Exact, Surd
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem

Pair = tuple[int, int]
# Of one loop there are so few paths that finding a start system takes longer.
FEWEST_LOOPS = 2
# Numbers beyond this, or below its inverse, are left alone: as doubles they might vanish.
LARGEST = 10**100
# Coefficients of each c and each s, and the constant.
_Linear = tuple[tuple[tuple[Exact, Exact], ...], Exact]


@dataclass(frozen=True, eq=False)
class Turns:
    """A system in pairs (c, s) on circles, linear equations in which are complex ones.

    Attributes:
        pairs: the indices of c and s, two for each circle: all variables.
        weight: the N of all circles, positive.
        squares: the r of each circle, not zero.
        loops: the equations in z and one, complex, shape ``(L, 1 + len(pairs))``, the constants
            last; zero exactly where they are.
    """

    pairs: tuple[Pair, ...]
    weight: Exact
    squares: tuple[Exact, ...]
    loops: np.ndarray

    @property
    def freedoms(self) -> int:
        """How many dimensions the equations leave at least; negative if there are more of these."""
        return len(self.pairs) - 2 * len(self.loops)


def turns_of(system: PolynomialSystem) -> Turns | None:
    """The pairs that all equations are about, and the equations between them.

    None if there is another variable or another equation, or one whose coefficients are not exact
    or of extreme size.
    """
    circles: dict[Pair, Exact] = {}
    weights = set()
    linear = []
    for f in system.polynomials:
        if not f.algebraic:
            return None
        if f.degree <= 1:
            linear.append(f)
            continue
        circle = _circle(f)
        if circle is None or circle[0] in circles:
            return None
        circles[circle[0]] = circle[2]
        weights.add(circle[1])
    pairs = tuple(sorted(circles))
    if len(weights) != 1 or sorted(i for pair in pairs for i in pair) != list(range(system.n)):
        return None
    weight = weights.pop()
    if not all(map(_is_moderate, (weight, *circles.values()))):
        return None
    loops = _loops([_in_pairs(f, pairs) for f in linear], weight)
    if loops is None:
        return None
    rows = np.array(loops, dtype=np.complex128).reshape(len(loops), 1 + len(pairs))
    return Turns(pairs, weight, tuple(circles[pair] for pair in pairs), rows)


def looped_turns(system: PolynomialSystem) -> Turns | None:
    """The turns of a system, if there are loops enough, and no more equations than variables."""
    turns = turns_of(system)
    if turns is None or len(turns.loops) < FEWEST_LOOPS or turns.freedoms < 0:
        return None
    return turns


def _is_moderate(x: Exact) -> bool:
    if isinstance(x, Surd):
        return Fraction(1, LARGEST) < abs(x) < LARGEST
    p, q = abs(x.numerator), x.denominator
    return not p or (q < LARGEST * p and p < LARGEST * q)


def _circle(f: Polynomial) -> tuple[Pair, Exact, Exact] | None:
    """The pair, N and r of a multiple of c^2 + N s^2 - r; None for anything else."""
    support = sorted(f.support)
    if len(support) != 2 or len(f.terms) != 3:
        return None
    c, s = (f.terms.get(_power(f.n, i, 2), Fraction(0)) for i in support)
    constant = f.terms.get(_power(f.n, 0, 0), Fraction(0))
    if c * s <= 0 or not constant:
        return None
    return (support[0], support[1]), s / c, -constant / c


def _power(n: int, i: int, k: int) -> Exponents:
    return tuple(k if j == i else 0 for j in range(n))


def _in_pairs(f: Polynomial, pairs: Sequence[Pair]) -> _Linear:
    zero = Fraction(0)
    own = [[f.terms.get(_power(f.n, i, 1), zero) for i in pair] for pair in pairs]
    return tuple((c, s) for c, s in own), f.terms.get(_power(f.n, 0, 0), zero)


def _loops(linear: Sequence[_Linear], weight: Exact) -> list[list[complex]] | None:
    """Equations that come in twos, as complex ones; None if one has no other."""
    loops: list[list[complex]] = []
    left, root = list(linear), sqrt(weight)
    while left:
        first = left.pop(0)
        found = next(((g, q) for g in left if (q := _find_quarter_turn(first, g, weight))), None)
        if found is None:
            return None
        other, factor = found
        left.remove(other)
        # With j = i sqrt(N), a c + b s and a s - b c / N are parts of (a - b j / N) (c + j s).
        exact = [(a, -b / weight) for a, b in first[0]] + [(first[1], other[1] / factor)]
        if not all(map(_is_moderate, (x for part in exact for x in part))):
            return None
        loops.append([complex(float(x), float(y) * root) for x, y in exact])
    return loops


def _find_quarter_turn(first: _Linear, second: _Linear, weight: Exact) -> Exact | None:
    """How many times ``second`` is ``first``, turned by a right angle; None if it is not."""
    for (a, b), (c, s) in zip(first[0], second[0], strict=True):
        if a or b:
            factor = -c * weight / b if b else s / a
            break
    else:
        return None
    quarter = tuple((-b * factor / weight, a * factor) for a, b in first[0])
    return factor if factor and quarter == second[0] else None
