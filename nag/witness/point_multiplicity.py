"""The multiplicity of a variety at a point: 1 exactly where it is smooth.

On a generic slice through the point, of complementary dimension, so many of the points of a
neighbouring slice have come together there.

References:
    Mumford, Algebraic Geometry I: Complex Projective Varieties, 1976, chapter 5;
    Nagata: a variety is smooth at a point exactly if its multiplicity there is 1.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nag.numerics.coincidence import compared
from nag.witness.comparable import coordinate_sizes, move_comparable
from nag.witness.fibres import Fibre, Tracker
from nag.witness.slices import evened, rows_through, unit_complex

# Relative error of ends at a point of multiplicity m, about the m-th root of rounding.
MULTIPLE = 1e-7


def multiplicity_at(
    point: np.ndarray,
    accuracy: float,
    fibres: Sequence[Fibre],
    rows: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> int | None:
    """The multiplicity of the set that ``fibres`` stand for at a point; 0 if it is not on it.

    Args:
        point: complex, affine, shape ``(n,)``.
        accuracy: relative error of the point.
        fibres: the set's points on the slice ``rows``.

    Returns:
        None if it could not be decided.
    """
    fibres = [fibre for fibre in fibres if len(fibre)]
    dimension, scale = len(rows), 1 + float(np.linalg.norm(point))
    sizes = coordinate_sizes(fibres[0])
    source, target = rows, rows_through(rng, dimension, point, sizes)
    source, target = evened(source, sizes), evened(target, sizes)
    gamma = complex(unit_complex(rng))
    count = 0
    for fibre in fibres:
        if dimension == 0:
            ends, regular = fibre.x, np.ones(len(fibre), dtype=bool)
        else:
            moved = move_comparable(fibre, source, target, gamma, tracker, endgame=True)
            if moved.failed.any():
                return None
            ends = moved.points[moved.finite, : fibre.cut.n]
            regular = moved.regular[moved.finite]
        distance = np.linalg.norm(ends - point, axis=1) / scale
        here, doubtful = compared(distance, np.where(regular, accuracy, MULTIPLE))
        if doubtful.any():
            return None
        count += int(here.sum())
    return count
