"""Points nearer to each other than paths in doubles can tell: known to more digits.

Two sheets of a set that come near to each other everywhere, as conjugate parallel lines do, have
points that doubles may not distinguish, and their paths jump from one to the other. Such points are
kept as sums of doubles, and tracked in as many digits as their distance asks for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import flint
import numpy as np

from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import neighbours
from nag.numerics.digits import WORDS, bits_of, in_bits, number_of_words, to_ball, words_of_number
from nag.numerics.newton import find_zero, inverse_of, newton_step, subtract_step
from nag.numerics.precise_point import PrecisePoint
from nag.numerics.read_only import fixed_array
from nag.text.json_text import real_or_null
from nag.witness.slices import pad_rows

if TYPE_CHECKING:
    from nag.algebra.polynomial import Polynomial

# Decides: Relative distance of points that are tracked in more digits: corrections that need not
# contract any more may be as large as a hundredth of it.
CLOSE = 1e-4
# Decides: The same far from the origin that suits the equations, where nothing is tracked: of
# doubles about that one so many digits are left.
CLOSE_AFAR = 1e-9
# Digits that sums of `WORDS` doubles hold.
DIGITS = 62
# Decides: Part of the distance to the next point that Newton's method may move one by.
BASIN = 0.1
# Digits behind the point to which Newton's constant is probed: beyond all distances of points that
# can be tracked, before what is left of their digits. And digits that are computed with: twice as
# many, and as many as rounding may take of a point.
OFF, PROBED = 56, 4 * DIGITS
# Newton's constant where no more is known than that the next point is near; more asks for no more
# digits.
STEEPEST = 1e100


@dataclass(frozen=True, eq=False)
class PointInWords:
    """A point in many digits.

    Attributes:
        words: real and imaginary parts of the affine coordinates, those that deflation added
            included, as sums of doubles, the largest first, shape ``(n + aux, 2, WORDS)``.
        curvature: Newton's constant, as of the inverse distance to the next point.
    """

    words: np.ndarray
    curvature: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "words", fixed_array(self.words))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PointInWords):
            return NotImplemented
        return self.curvature == other.curvature and np.array_equal(self.words, other.words)

    def document(self) -> dict[str, Any]:
        """The digits as a JSON object."""
        return {"coordinates": self.words.tolist(), "curvature": real_or_null(self.curvature)}

    @classmethod
    def of_doubles(cls, x: np.ndarray, curvature: float = 1.0) -> PointInWords:
        """A point of which no more is known than complex doubles, shape ``(n,)``."""
        words = np.zeros((len(x), 2, WORDS))
        words[:, 0, 0], words[:, 1, 0] = x.real, x.imag
        return cls(words, curvature)

    def first(self, count: int) -> PointInWords:
        """The first coordinates only."""
        return PointInWords(self.words[:count], self.curvature)

    def with_last(self, value: float) -> PointInWords:
        """With one coordinate more."""
        last = np.zeros((1, 2, WORDS))
        last[0, 0, 0] = value
        return PointInWords(np.concatenate([self.words, last]), self.curvature)

    @property
    def rounded(self) -> np.ndarray:
        """The point in doubles."""
        return self.words[:, 0, 0] + 1j * self.words[:, 1, 0]

    def balls(self) -> list[flint.acb]:
        """The coordinates as exact numbers."""
        return list(map(number_of_words, self.words))

    @property
    def homogeneous(self) -> np.ndarray:
        """With a first coordinate one, over a power of two that leaves a size of about one."""
        one = np.zeros((1, 2, WORDS))
        one[0, 0, 0] = 1.0
        words = np.concatenate([one, self.words])
        return np.ldexp(words, -int(np.frexp(np.linalg.norm(words[:, :, 0]))[1]))


def fine_of_balls(values: Sequence[flint.acb], curvature: float) -> PointInWords:
    """A point from the middles of coordinates."""
    words = [words_of_number(z, WORDS) for z in values]
    return PointInWords(np.array(words).reshape(len(words), 2, WORDS), curvature)


def affine_fine(centre: np.ndarray, curvature: float) -> PointInWords:
    """The affine point of homogeneous coordinates in words, shape ``(N, 2, words)``."""
    first, *others = PointInWords(centre, curvature).balls()
    with in_bits(bits_of(2 * DIGITS)):
        return fine_of_balls([z / first for z in others], curvature)


def with_newton_constant(
    polynomials: Sequence[Polynomial], rows: np.ndarray, point: PointInWords
) -> PointInWords:
    """A zero of a square system on a slice with Newton's constant there, relative to its size.

    Two of Newton's corrections from a point that is a little off: their quotient over the first.
    """
    if not len(point.words):
        # The only point of a space without coordinates has no other zero near it.
        return PointInWords(point.words, 1.0)
    exact = BallPolynomials.of(polynomials, pad_rows(rows, 1 + len(point.words)))
    size, most, bits = 1 + float(np.linalg.norm(point.rounded)), 1.0, bits_of(PROBED)
    centre = point.balls()
    for turn in (1, 2):
        way = np.exp(1j * np.arange(1, len(centre) + 1) ** 2 * turn) * size
        off = [flint.acb(complex(v)) * flint.arb(10) ** -OFF for v in way]
        x, lengths = subtract_step(centre, off, bits), []
        for _ in range(2):
            step = newton_step(exact, x, bits)
            if step is None:
                return PointInWords(point.words, STEEPEST)
            x = subtract_step(x, step, bits)
            lengths.append(float(max(abs(z.mid()) for z in step).mid()) / size)
        # One after the other, as the square of a step may leave the range of doubles.
        most = max(most, lengths[1] / lengths[0] / lengths[0]) if lengths[0] else STEEPEST
    return PointInWords(point.words, min(most, STEEPEST))


def with_roots(point: PointInWords, f: Polynomial) -> list[PointInWords]:
    """A point with each root of ``u^m = f`` there, for f of degree m, as a further coordinate."""
    x, m = point.balls(), f.degree
    with in_bits(bits_of(2 * DIGITS)):
        root = f(x[: f.n], to_ball).root(m)
        turns = [flint.acb(flint.fmpq(2 * k, m)).exp_pi_i() for k in range(m)]
        return [fine_of_balls([*x, root * turn], point.curvature) for turn in turns]


def zero_from(
    polynomials: Sequence[Polynomial], rows: np.ndarray, start: PointInWords, digits: int
) -> PrecisePoint | None:
    """The regular zero of a square system on a slice near a point, to so many digits.

    None if Newton's method does not converge at once to a simple zero that is far nearer than the
    next one.
    """
    exact = BallPolynomials.of(polynomials, pad_rows(rows, 1 + len(start.words)))
    found = find_zero(exact, start.balls(), digits, np.log10(BASIN / start.curvature))
    return None if found is None else PrecisePoint.of(found.point, found.error)


def follow_slice(
    polynomials: Sequence[Polynomial], rows: np.ndarray, point: PointInWords
) -> PointInWords:
    """The zero of a square system on a slice that a zero on a slice beside it belongs to.

    The step along the tangent may be much longer than other zeros are far, as these move along:
    only what is left after it, of the order of its square, has to be small beside their distance.
    """
    exact = BallPolynomials.of(polynomials, pad_rows(rows, 1 + len(point.words)))
    x, bits = point.balls(), bits_of(2 * DIGITS)
    off, inverse = exact.values(x, bits).mid(), inverse_of(exact.jacobian(x, bits), bits)
    if inverse is None:
        return point
    for i in range(len(polynomials)):
        off[i, 0] = 0
    with in_bits(bits):
        step = (inverse * off).entries()
    there = fine_of_balls(subtract_step(x, step, bits), point.curvature)
    found = zero_from(polynomials, rows, there, DIGITS)
    return there if found is None else fine_of_balls(found.centre, point.curvature)


def close_pairs(x: np.ndarray, close: float = CLOSE) -> list[tuple[int, int]]:
    """Pairs of points, shape ``(P, n)``, that are close: no further apart than this, relatively."""
    if len(x) < 2 or not x.shape[1]:
        return []
    widths = close * (1 + np.linalg.norm(x, axis=1))
    weights = np.exp(1j * np.arange(1, x.shape[1] + 1) ** 2)
    found = []
    for i, j in neighbours((x @ weights).real, np.sqrt(x.shape[1]) * widths):
        near = np.linalg.norm(x[i] - x[j], axis=1) <= np.maximum(widths[i], widths[j])
        found += list(zip(i[near].tolist(), j[near].tolist(), strict=True))
    return found


def distance(
    x: np.ndarray, fine: PointInWords | None, y: np.ndarray, other: PointInWords | None
) -> float:
    """The distance of two points in all digits that are known, without added unknowns.

    Doubles that are near to each other have an exact difference.
    """
    n = len(x)
    if fine is None or other is None:
        return float(np.linalg.norm(x - y))
    parts = fine.words[:n, :, 0] - other.words[:n, :, 0]
    parts = parts + (fine.words[:n, :, 1:] - other.words[:n, :, 1:]).sum(axis=-1)
    return float(np.linalg.norm(parts))


def select_fine(
    fine: Mapping[int, PointInWords], indices: Sequence[int]
) -> dict[int, PointInWords]:
    """What is known of some points, by their places among these."""
    return {k: fine[int(i)] for k, i in enumerate(indices) if int(i) in fine}
