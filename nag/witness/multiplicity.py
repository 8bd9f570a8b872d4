"""The multiplicity of a component, by the local ring on a slice, and of a variety at a point.

The latter is 1 exactly where the variety is smooth: on a generic slice through the point, of
complementary dimension, so many of the points of a neighbouring slice have come together there.

References:
    Mumford, Algebraic Geometry I: Complex Projective Varieties, 1976, chapter 5;
    Nagata: a variety is smooth at a point exactly if its multiplicity there is 1.
"""

from __future__ import annotations

from collections.abc import Sequence

import flint
import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.coincidence import LEAST, classify_arrivals
from nag.numerics.doubles import MULTIPLE
from nag.numerics.zero_values import WRITTEN, multiplicity_of_all, possible_zeros
from nag.tracking.run import Run
from nag.witness.fibres import Fibre, move_through
from nag.witness.slices import pad_rows


def multiplicity(
    polynomials: Sequence[Polynomial],
    rows: np.ndarray,
    x: np.ndarray | Sequence[flint.acb],
    rng: np.random.Generator,
) -> int:
    """Multiplicity of the zero ``x`` of ``polynomials`` on the slice ``rows``; 0 if not found.

    ``x`` must be known to rounding, or to `WRITTEN` where it is given in balls. Where it may stand
    for any of several zeros, it is what they all have. See
    `nag.numerics.singular_point.analyse`.
    """
    accuracy = LEAST if isinstance(x, np.ndarray) else WRITTEN
    zeros = possible_zeros(polynomials, x, accuracy, rng, pad_rows(rows, 1 + len(x)))
    return multiplicity_of_all(zeros) or 0


def multiplicity_at(
    point: np.ndarray,
    accuracy: float,
    fibres: Sequence[Fibre],
    rng: np.random.Generator,
    run: Run,
) -> int | None:
    """The multiplicity of the set that ``fibres`` stand for at a point; 0 if it is not on it.

    Args:
        point: complex, affine, shape ``(n,)``.
        accuracy: relative error of the point.
        fibres: the set's points on a slice.

    Returns:
        None if it could not be decided.
    """
    fibres = [fibre for fibre in fibres if len(fibre)]
    dimension = fibres[0].dimension if fibres else 0
    if dimension == 0:
        ends = [(fibre.x, np.ones(len(fibre), dtype=bool)) for fibre in fibres]
        return _come_together(point, accuracy, ends)
    ends = []
    for there in move_through(point, fibres, rng, run):
        if there.failed.any():
            return None
        ends.append((there.x[there.finite], there.regular[there.finite]))
    return _come_together(point, accuracy, ends)


def _come_together(
    point: np.ndarray, accuracy: float, ends: Sequence[tuple[np.ndarray, np.ndarray]]
) -> int | None:
    """How many ends are the point; of each it is said whether it is regular. None if unclear."""
    count, scale = 0, 1 + float(np.linalg.norm(point))
    for x, regular in ends:
        distance = np.linalg.norm(x - point, axis=1) / scale
        here, doubtful = classify_arrivals(distance, np.where(regular, accuracy, MULTIPLE))
        if doubtful.any():
            return None
        count += int(here.sum())
    return count
