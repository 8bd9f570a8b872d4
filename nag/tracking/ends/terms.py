"""The terms of a homotopy as exact numbers of ball arithmetic."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import flint
import numpy as np

from nag.algebra.number import Irrational, Number, rounded_fraction
from nag.numerics.digits import EXACT, in_bits
from nag.tracking.homotopy import Homotopy

# Bits of working precision for numbers of as many words.
BITS = {2: 140, 4: 280, 8: 560}
# Exponents as (coordinate, exponent) pairs; with them, the coefficients of 1 and of t.
Factors = tuple[tuple[int, int], ...]
Term = tuple[Factors, Any, Any]


@dataclass(frozen=True, eq=False)
class Terms:
    """The terms of all rows of a homotopy, the linear ones last."""

    homotopy: Homotopy

    @cached_property
    def finer(self) -> Terms:
        """The same, to be asked for in another precision."""
        return Terms(self.homotopy)

    @cached_property
    def rows(self) -> list[list[Term]]:
        """For each row its terms."""
        h = self.homotopy
        rows: list[list[Term]] = []
        for row in h.rows.parts:
            terms = []
            for part, own in row:
                a, b = (flint.acb(c) for c in h.factors[part])
                for e, c in own.items():
                    value = exact(c)
                    factors = tuple((j, int(k)) for j, k in enumerate(e) if k)
                    terms.append((factors, value * a, value * b))
            rows.append(terms)
        for first, second in zip(h.A0.tolist(), h.A1.tolist(), strict=True):
            pairs = zip(first, second, strict=True)
            rows.append([(((j, 1),), flint.acb(a), flint.acb(b)) for j, (a, b) in enumerate(pairs)])
        return rows

    @cached_property
    def at_end(self) -> list[list[tuple[Factors, Any]]]:
        """The terms of the polynomial rows at t = 0: exponents, and coefficients that are not 0."""
        factors = [flint.acb(a) if a != 1 else None for a, _ in self.homotopy.factors]
        rows = []
        for row in self.homotopy.rows.parts:
            terms = []
            for part, own in row:
                a = factors[part]
                if a is not None and a == 0:
                    continue
                for e, c in own.items():
                    value = exact(c) if a is None else exact(c) * a
                    if value != 0:
                        terms.append((tuple((j, int(k)) for j, k in enumerate(e) if k), value))
            rows.append(terms)
        return rows

    @cached_property
    def lines(self) -> list[list[Any]]:
        """The linear rows at t = 0."""
        return [[flint.acb(c) for c in row] for row in self.homotopy.A0.tolist()]

    def work_out(self) -> None:
        """Give what there is at t = 0 the digits that are worked with now."""
        _ = self.at_end, self.lines


def real(parts: np.ndarray) -> Any:
    """A sum of doubles, exactly."""
    with in_bits(EXACT):
        return sum(map(flint.arb, parts.tolist()), flint.arb(0))


def number(parts: np.ndarray) -> Any:
    """A complex number from sums of doubles, shape ``(2, words)``."""
    return flint.acb(real(parts[0]), real(parts[1]))


def doubles(z: Any, words: int) -> np.ndarray:
    """Real and imaginary part as sums of so many doubles, shape ``(2, words)``."""
    parts = np.zeros((2, words))
    with in_bits(EXACT):
        for k, rest in enumerate((z.real.mid(), z.imag.mid())):
            for i in range(words):
                parts[k, i] = float(rest)
                rest = (rest - parts[k, i]).mid()
    return parts


def exact(c: Number | complex) -> Any:
    """A coefficient, to the working precision."""
    if isinstance(c, complex | float | np.complexfloating | np.floating):
        return flint.acb(complex(c))
    if isinstance(c, Irrational):
        c = rounded_fraction(c, max(100, flint.ctx.dps + 10))
    p, q = c.as_integer_ratio()
    return flint.acb(flint.fmpq(p, q) if q != 1 else p)
