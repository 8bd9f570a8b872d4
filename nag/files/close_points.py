"""Points that doubles do not tell from others, in the export: their digits as sums of doubles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from nag.files.json_values import as_count, as_double, as_list, as_table, entry, real_or_null, wrong
from nag.witness.close_points import WORDS, Fine

# Relative difference of a point's coordinates from the same in more digits.
ROUNDED = 1e-12


def close_document(fine: Mapping[int, Fine]) -> list[dict[str, Any]]:
    """The points of a fibre that are close to others, by their indices in it."""
    return [
        {
            "point": i,
            "coordinates": fine[i].words.tolist(),
            "curvature": real_or_null(fine[i].curvature),
        }
        for i in sorted(fine)
    ]


def close_points(value: Any, points: np.ndarray, place: str) -> dict[int, Fine]:
    """What `close_document` wrote of points of shape ``(P, n + aux)``.

    Raises:
        nag.files.json_values.ExportError: if it does not fit them.
    """
    found: dict[int, Fine] = {}
    for k, item in enumerate(as_list(value, place)):
        here = f"{place}[{k}]"
        table = as_table(item, here)
        i = as_count(entry(table, "point", here), f"{here}.point")
        if i >= len(points) or i in found:
            raise wrong(f"{here}.point", "the index of a point, once")
        words = _words(entry(table, "coordinates", here), points.shape[1], f"{here}.coordinates")
        curvature = as_double(entry(table, "curvature", here), f"{here}.curvature")
        found[i] = Fine(words, curvature if np.isfinite(curvature) else np.inf)
        if not np.allclose(found[i].rounded, points[i], rtol=ROUNDED, atol=1e-300):
            raise wrong(f"{here}.coordinates", "those of the point in more digits")
    return found


def _words(value: Any, count: int, place: str) -> np.ndarray:
    rows = [
        [
            [as_double(x, f"{place}[{j}]") for x in as_list(part, f"{place}[{j}]")]
            for part in as_list(parts, f"{place}[{j}]")
        ]
        for j, parts in enumerate(as_list(value, place))
    ]
    shapes = [[len(part) for part in parts] for parts in rows]
    if shapes != [[WORDS, WORDS]] * count:
        raise wrong(
            place, f"{WORDS} numbers for the real and the imaginary part of each of {count}"
        )
    return np.array(rows, dtype=float).reshape(count, 2, WORDS)
