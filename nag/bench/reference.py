"""Solutions to 60 digits, proved, and how far found ones are from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import flint
import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.numerics.ball_boxes import BITS, FineBox, box_about
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.certified_points import independent_equations
from nag.numerics.digits import middle
from nag.numerics.krawczyk import Boxes, enter_box, find_overlaps

# A found point belongs to the solution that is nearest, if it is nearer than this, relative to its
# size.
NEAR = 1e-6


class ReferenceError(NagError):
    """There is no reference, for the reason that the text says."""


@dataclass(frozen=True, eq=False)
class Reference:
    """Simple solutions of a system, each proved.

    Attributes:
        high, low: the solutions as sums of two doubles, shape ``(k, n)``.
        boxes: of 512 bits.
    """

    high: np.ndarray
    low: np.ndarray
    boxes: tuple[FineBox, ...]

    @classmethod
    def of(cls, system: PolynomialSystem, points: np.ndarray, slices: np.ndarray) -> Reference:
        """The solutions next to points, on a slice if there are rows of one.

        Of more equations than unknowns, as many as determine the first point are taken.

        Raises:
            ReferenceError: if a point has no simple solution next to it, or two have the same.
        """
        equations = [f for f in system.polynomials if f]
        if len(equations) + len(slices) < system.n:
            raise ReferenceError("there are fewer equations than unknowns")
        if len(equations) + len(slices) > system.n and len(points):
            chosen = independent_equations(equations, slices, points[0])
            equations = [equations[i] for i in chosen]
        exact = BallPolynomials.of(equations, slices)
        P, n = points.shape
        found = Boxes(
            points.copy(), np.zeros((P, n)), np.zeros((P, n)), np.zeros(P, dtype=bool), {}
        )
        low = np.zeros((P, n), dtype=complex)
        for i in range(P):
            box = box_about(exact, [flint.acb(complex(z)) for z in points[i]], (BITS[-1],))
            if box is None:
                raise ReferenceError(f"no simple solution is proved next to point {i + 1}")
            enter_box(found, i, box)
            rest = zip(box.centre, found.centres[i], strict=True)
            low[i] = [complex(middle(z - complex(c))) for z, c in rest]
        if find_overlaps(found) != ([], []):
            raise ReferenceError("two points lead to one solution")
        return cls(found.centres, low, tuple(found.fine[i] for i in range(P)))

    def errors(self, points: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Distances of points from these solutions, relative to their sizes, at least one.

        Distances and sizes are those of the largest coordinates.
        """
        off = (points - self.high[places]) - self.low[places]
        sizes = np.maximum(1.0, np.abs(self.high[places]).max(axis=1, initial=0.0))
        return np.abs(off).max(axis=1, initial=0.0) / sizes

    def fine_error(self, point: Sequence[flint.acb], place: int) -> float:
        """The same of one point in balls, to as many digits as it has."""
        centre = self.boxes[place].centre
        off = max(float(abs(a - b).mid()) for a, b in zip(point, centre, strict=True))
        size = max(float(abs(b).mid()) for b in centre)
        return off / max(1.0, size)


@dataclass(frozen=True)
class Found:
    """How a list of points stands to a reference.

    Attributes:
        share: of the solutions that are found; false: points that are near none, or near one that
            was found already; largest, median: errors of those that are found.
    """

    share: float
    false: int
    largest: float
    median: float


def compare_points(reference: Reference, points: np.ndarray) -> Found:
    """Points beside the reference."""
    return _compare(
        reference, points, lambda k, place: reference.errors(points[[k]], np.array([place]))[0]
    )


def compare_in_balls(reference: Reference, points: Sequence[Sequence[flint.acb]]) -> Found:
    """The same of points of more digits than doubles have."""
    rounded = np.array([[complex(z.mid()) for z in x] for x in points], dtype=complex)
    rounded = rounded.reshape(len(points), reference.high.shape[1])
    return _compare(reference, rounded, lambda k, place: reference.fine_error(points[k], place))


def _compare(
    reference: Reference, points: np.ndarray, error_of: Callable[[int, int], float]
) -> Found:
    k = len(reference.high)
    best = np.full(k, np.inf)
    false = 0
    for i, x in enumerate(points):
        distance = np.abs(reference.high - x).max(axis=1, initial=0.0)
        place = int(distance.argmin()) if k else 0
        error = error_of(i, place) if k else np.inf
        if not error < NEAR or np.isfinite(best[place]):
            false += 1
            continue
        best[place] = error
    errors = best[np.isfinite(best)]
    share = len(errors) / k if k else 1.0
    return Found(
        share,
        false,
        float(errors.max(initial=0.0)),
        float(np.median(errors)) if len(errors) else float("nan"),
    )


def join_found(found: Sequence[Found]) -> Found:
    """Over seeds: mean share, points that are false in all, largest error, median of medians.

    Errors are those of the seeds for which there are any.
    """
    some = [f for f in found if np.isfinite(f.largest)] or found
    return Found(
        float(np.mean([f.share for f in found])),
        sum(f.false for f in found),
        max(f.largest for f in some),
        float(np.median([f.median for f in some])),
    )
