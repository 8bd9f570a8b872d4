"""Eight doubles at a time: operations on the vector registers that carry eight paths.

Work arrays are flat, with the lane (the path) as the last and fastest index, so that vector ``k``
of an array ``a`` is ``a[8 * k : 8 * k + 8]``. Every operation acts on each lane alone, hence a
path's result does not depend on the paths beside it. No operation may be reassociated. Lanes are
added, subtracted, multiplied and divided by Python's operators. Except for the last two, the
functions here are names that kernels use; nothing calls them.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

LANES = 8
ALIGNMENT = 64


def load(data: Any, index: int) -> Any:
    """Vector ``index`` at a pointer that is aligned to 64 bytes."""


def store(data: Any, index: int, value: Any) -> None:
    """Write ``value`` to vector ``index`` at a pointer that is aligned to 64 bytes."""


def shifted(data: Any, index: int) -> Any:
    """The pointer to entry ``index``."""


def splat(value: float) -> Any:
    """The same number in every lane."""


def fma(a: Any, b: Any, c: Any) -> Any:
    """``a * b + c``, fused where the machine can."""


def fnma(a: Any, b: Any, c: Any) -> Any:
    """``c - a * b``, fused where the machine can."""


def fused(a: Any, b: Any, c: Any) -> Any:
    """``a * b + c`` with one rounding, on every machine."""


def select_less(a: Any, b: Any, x: Any, y: Any) -> Any:
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""


def any_less(a: Any, b: Any) -> bool:
    """Whether ``a < b`` in at least one lane."""


def square_root(a: Any) -> Any:
    """The square root, lane by lane."""


def aligned(vectors: int) -> np.ndarray:
    """A flat array of zeros for ``vectors`` vectors, aligned to 64 bytes."""
    raw = np.zeros(vectors * LANES + ALIGNMENT // 8)
    offset = (-raw.ctypes.data % ALIGNMENT) // 8
    return raw[offset : offset + vectors * LANES]


def separate(vectors: np.ndarray, sizes: Sequence[int]) -> list[np.ndarray]:
    """Parts of an `aligned` array with that many vectors each, one after the other."""
    ends = LANES * np.cumsum([0, *sizes])
    return [vectors[a:b] for a, b in pairwise(ends.tolist())]
