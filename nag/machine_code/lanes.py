"""Eight doubles at a time: operations on the vector registers that carry eight paths.

Work arrays are flat, with the lane (the path) as the last and fastest index, so that vector ``k``
of an array ``a`` is ``a[8 * k : 8 * k + 8]``. Every operation acts on each lane alone, hence a
path's result does not depend on the paths beside it. No operation may be reassociated. Lanes are
added, subtracted, multiplied and divided by Python's operators. Kernels have the functions here
translated; called from Python they do the same with arrays of eight doubles.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from functools import cache, lru_cache
from itertools import accumulate, pairwise
from math import prod
from typing import Any, get_type_hints

import numpy as np

from nag.machine_code.records import Table, Wholes, address

LANES = 8
ALIGNMENT = 64
# Bytes of a vector.
VECTOR = 8 * LANES


def _vector(data: Any, index: int) -> np.ndarray:
    flat = np.asarray(data)
    if not 0 <= index < len(flat) // LANES:
        raise IndexError(f"there is no vector {index} of {len(flat) // LANES}")
    if flat.ctypes.data % ALIGNMENT:
        raise IndexError(f"vectors are read from memory that is aligned to {ALIGNMENT} bytes")
    return flat[LANES * index : LANES * (index + 1)]


def load(data: Any, index: int) -> Any:
    """Vector ``index`` at a pointer that is aligned to 64 bytes."""
    return _vector(data, index).copy()


def store(data: Any, index: int, value: Any) -> None:
    """Write ``value`` to vector ``index`` at a pointer that is aligned to 64 bytes."""
    _vector(data, index)[:] = value


def splat(value: float) -> Any:
    """The same number in every lane."""
    return np.full(LANES, float(value))


def fma(a: Any, b: Any, c: Any) -> Any:
    """``a * b + c``, fused where the machine can; in Python it is."""
    return fused(a, b, c)


def fnma(a: Any, b: Any, c: Any) -> Any:
    """``c - a * b``, fused where the machine can; in Python it is."""
    return fused(-a, b, c)


@cache
def _fused_of_doubles() -> Any:
    """C's function, which rounds once whatever the processor can."""
    function = ctypes.CDLL(None).fma
    function.restype = ctypes.c_double
    function.argtypes = [ctypes.c_double] * 3
    return function


def fused(a: Any, b: Any, c: Any) -> Any:
    """``a * b + c`` with one rounding, on every machine."""
    return np.array(list(map(_fused_of_doubles(), a.tolist(), b.tolist(), c.tolist())))


def select_less(a: Any, b: Any, x: Any, y: Any) -> Any:
    """``x`` in the lanes where ``a < b``, ``y`` elsewhere."""
    return np.where(a < b, x, y)


def any_less(a: Any, b: Any) -> bool:
    """Whether ``a < b`` in at least one lane."""
    return bool((a < b).any())


def square_root(a: Any) -> Any:
    """The square root, lane by lane."""
    with np.errstate(invalid="ignore"):
        return np.sqrt(a)


def aligned_zeros(vectors: int) -> np.ndarray:
    """A flat array of zeros for ``vectors`` vectors, aligned to 64 bytes."""
    raw = np.zeros(vectors * LANES + ALIGNMENT // 8)
    offset = (-address(raw) % ALIGNMENT) // 8
    return raw[offset : offset + vectors * LANES]


@cache
def _shapes(record: type) -> tuple[tuple[str, ...], ...]:
    """The dimensions that the fields of a record name."""
    hints = get_type_hints(record, include_extras=True)
    return tuple(tuple(hint.__metadata__[0].split()) for hint in hints.values())


def _length(dimension: str, dimensions: Mapping[str, int]) -> int:
    """What a number, a name, or a sum of these as ``rows+1``, stands for."""
    parts = dimension.split("+")
    return sum(int(part) if part.isdigit() else dimensions[part] for part in parts)


@lru_cache(1024)
def _layout(record: type, dimensions: tuple[tuple[str, int], ...]) -> tuple[list[int], list[bool]]:
    """Where each field begins, and the last one ends, in vectors; which ones are whole numbers."""
    known = dict(dimensions)
    sizes = [prod(_length(name, known) for name in shape) for shape in _shapes(record)]
    return [0, *accumulate(sizes)], [hint == Wholes for hint in get_type_hints(record).values()]


def scratch(record: Any, **dimensions: int) -> Table:
    """The table of a record of scratch vectors of zeros, one field after the other in memory.

    Args:
        record: a NamedTuple; a field ``Annotated[Reals, "2 rows+1"]`` has twice ``rows + 1``
            vectors, of lanes; one of `Wholes` as many times eight whole numbers.
        dimensions: what the names stand for.
    """
    places, whole = _layout(record, tuple(dimensions.items()))
    vectors = aligned_zeros(places[-1])
    fields = [vectors[LANES * a : LANES * b] for a, b in pairwise(places)]
    made = (field.view(np.int64) if w else field for field, w in zip(fields, whole, strict=True))
    words = np.array(places[:-1]) * VECTOR + address(vectors)
    return Table(words, address(words), record(*made))
