"""Krawczyk's test in balls: a box that is proved to hold exactly one zero, in more digits.

The operator is that of `nag.numerics.krawczyk`; slopes over a box are values in wide balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import flint
import numpy as np

from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import in_bits
from nag.numerics.doubles import NEWTON_STEPS
from nag.numerics.newton import (
    Functions,
    inverse_of,
    newton_step,
    newton_to_rest,
    slopes_over,
)

# Bits of a word of the machine.
WORD = 64
# Bits of the balls, one after the other.
BITS = (128, 256, 512)
# Sides of boxes of balls, beside the coordinates and the largest of them: powers of two.
FIRST_SIDE, SIDES_APART, LAST_SIDE = -16, 16, 24
# Times that a box is replaced by its image, in which its zero lies.
SMALLER = 12
# Spectral radius, in doubles, of slopes over a box that is none's image, nor is one about it.
EXPANDING = 2.0


@dataclass(frozen=True, eq=False)
class FineBox:
    """A box of more digits than doubles have.

    Attributes:
        centre: exact numbers.
        outer: radii of a box about it that holds exactly one zero.
        inner: radii of a box about it that this zero lies in.
    """

    centre: tuple[flint.acb, ...]
    outer: tuple[flint.arb, ...]
    inner: tuple[flint.arb, ...]

    @property
    def balls(self) -> list[flint.acb]:
        """The box in which the zero lies."""
        return [
            flint.acb(flint.arb(z.real, r), flint.arb(z.imag, r))
            for z, r in zip(self.centre, self.inner, strict=True)
        ]

    def decimals(self, digits: int) -> list[list[str]]:
        """Real and imaginary parts of the zero, to what the box leaves, at most so many digits."""
        return [[part.str(digits, radius=False) for part in (z.real, z.imag)] for z in self.balls]


def one_zero(a: FineBox, b: FineBox) -> bool | None:
    """Whether two boxes have the same zero: the zero of one lies where the other has but one.

    The centres are exact, so that distances are right to all but rounding in any precision.
    None where it is not known.
    """
    distance = [abs(x - y) for x, y in zip(a.centre, b.centre, strict=True)]
    sums = zip(distance, a.inner, b.inner, strict=True)
    if any(d > r + s for d, r, s in sums):
        return False
    if all(d + r < s for d, r, s in zip(distance, a.inner, b.outer, strict=True)):
        return True
    if all(d + s < r for d, r, s in zip(distance, a.outer, b.inner, strict=True)):
        return True
    return None


def holds_conjugate(box: FineBox) -> bool:
    """Whether a box holds the conjugate of its zero as well."""
    triples = zip(box.centre, box.inner, box.outer, strict=True)
    return all(2 * abs(z.imag) + r < s for z, r, s in triples)


def box_about(
    system: BallPolynomials, start: Sequence[flint.acb], ladder: Sequence[int] = BITS
) -> FineBox | None:
    """The box of the simple zero that Newton's method finds from a point, or None.

    Args:
        ladder: bits of the balls, tried one after the other.
    """
    for bits in ladder:
        x = newton_to_rest(system, start, bits, NEWTON_STEPS)
        box = None if x is None else ball_box(system, x, bits)
        if box is not None:
            return box
    return None


def ball_box(system: Functions, x: list[flint.acb], bits: int) -> FineBox | None:
    """Krawczyk's test in balls about ``x``, for boxes from large to small."""
    about = BallOperator.about(system, x, bits)
    if about is None:
        return None
    with in_bits(bits):
        scale = max([abs(z).mid() for z in x if abs(z).mid() > 0], default=flint.arb(1))
        alike = [scale] * len(x)
        for exponent in range(FIRST_SIDE, -bits + LAST_SIDE, -SIDES_APART):
            part = flint.arb(2) ** exponent
            # Sides of one size, and sides as the coordinates have them.
            for sizes in (alike, [abs(z).mid() + scale * part for z in x]):
                outer = [(size * part).mid() for size in sizes]
                if not all(a < r for a, r in zip(about.far, outer, strict=True)):
                    continue
                inner = about.zero_in(outer)
                if inner is not None:
                    return FineBox(tuple(x), tuple(outer), inner)
                if not about.may_contract:
                    return None
    return None


@dataclass(frozen=True, eq=False)
class BallOperator:
    """Krawczyk's operator about an exact point, in balls of so many bits.

    Attributes:
        inverse: a matrix near the inverse Jacobian at ``x``; step: Newton's by it, in balls.
    """

    system: Functions
    x: list[flint.acb]
    bits: int
    inverse: flint.acb_mat
    step: list[flint.acb]

    @classmethod
    def about(cls, system: Functions, x: list[flint.acb], bits: int) -> BallOperator | None:
        """None where the Jacobian has no inverse."""
        # Any matrix near the inverse will do, and words that are not full cost as much.
        inverse = inverse_of(system.jacobian(x, bits), bits // WORD * WORD)
        if inverse is None:
            return None
        step = newton_step(system, x, bits, inverse.mid())
        return None if step is None else cls(system, x, bits, inverse.mid(), step)

    @cached_property
    def far(self) -> list[flint.arb]:
        """Upper bounds of Newton's step, which a box with its image inside is larger than."""
        with in_bits(self.bits):
            return [z.abs_upper() for z in self.step]

    @cached_property
    def may_contract(self) -> bool:
        """Whether some box may have its image inside.

        Each such box holds the one as large as Newton's step. The smaller a box is, the smaller are
        all entries of its slopes, and the spectral radius of one with its image inside is below 1.
        """
        entries = [[float(z.mid()) for z in row] for row in self.slopes(self.far).tolist()]
        if not np.isfinite(entries).all():
            return False
        return bool(np.abs(np.linalg.eigvals(entries)).max(initial=0.0) < EXPANDING)

    def slopes(self, sides: Sequence[flint.arb]) -> flint.arb_mat:
        """Absolute values of the entries of ``1 - Y F'(X)`` for discs X of these radii."""
        return slopes_over(self.system, self.x, sides, self.inverse, self.bits)

    def image(self, slopes: flint.arb_mat, sides: Sequence[flint.arb]) -> list[flint.arb]:
        """Upper bounds of the distances of K(X) from ``x``, for discs X of these radii about it.

        Args:
            slopes: over these discs, or over larger ones.
        """
        with in_bits(self.bits):
            moved = (slopes * flint.arb_mat(len(sides), 1, list(sides))).entries()
            return [(a + b).upper() for a, b in zip(self.far, moved, strict=True)]

    def zero_in(self, sides: Sequence[flint.arb]) -> tuple[flint.arb, ...] | None:
        """Radii of the smallest discs that the one zero in larger ones is seen in; None if not one.

        Args:
            sides: the radii of those, shape ``(n,)``.
        """
        if not all(a < r for a, r in zip(self.far, sides, strict=True)):
            return None
        slopes = self.slopes(sides)
        image = self.image(slopes, sides)
        if not all(a < r for a, r in zip(image, sides, strict=True)):
            return None
        for _ in range(SMALLER):
            # Images are never below Newton's step. A first one that is hardly smaller than its
            # discs is no end: slopes shrink as discs do, and images the faster.
            near = all(a < 2 * b for a, b in zip(image, self.far, strict=True))
            if not near:
                slopes = self.slopes(image)
            image = self.image(slopes, image)
            if near:
                break
        return tuple(image)
