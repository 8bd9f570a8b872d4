"""Kernels as plain Python: slow, with lanes as NumPy arrays, and every place in memory checked.

It is what compiled kernels are compared with. Integers are Python's own, which do not wrap round;
divisions of doubles by zero give an infinity or NaN as in machine code, but functions of the
standard library raise where they have no value. Numbers below the normal ones are not zero here.
"""

from __future__ import annotations

from types import FunctionType
from typing import Any

import numpy as np


class Memory:
    """An array of a record as a kernel sees it: flat, read and written one number at a time.

    Raises:
        IndexError: if a place is not one of its numbers, counted from 0.
    """

    def __init__(self, array: np.ndarray, name: str) -> None:
        self._flat = array.reshape(-1)
        self._name = name
        assert np.shares_memory(self._flat, array) or not array.size

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return self._flat

    def _place(self, k: Any) -> int:
        if isinstance(k, bool) or not isinstance(k, int | np.integer):
            raise IndexError(f"{self._name}: {k!r} is no place in memory")
        if not 0 <= k < len(self._flat):
            raise IndexError(f"{self._name}: there is no number {k} of {len(self._flat)}")
        return int(k)

    def __getitem__(self, k: Any) -> Any:
        value = self._flat[self._place(k)]
        return value if isinstance(value, np.floating) else value.item()

    def __setitem__(self, k: Any, value: Any) -> None:
        place = self._place(k)
        if not np.can_cast(np.min_scalar_type(value), self._flat.dtype, "same_kind"):
            raise TypeError(f"{self._name}: {value!r} is no {self._flat.dtype}")
        self._flat[place] = value


def _check_record(record: Any) -> Any:
    """A record with arrays that check, and doubles that may be divided by zero."""
    kind = type(record).__name__
    fields = {}
    for name, value in zip(record._fields, record, strict=True):
        if isinstance(value, np.ndarray):
            fields[name] = Memory(value, f"{kind}.{name}")
        else:
            fields[name] = np.float64(value) if isinstance(value, float) else value
    return record._replace(**fields)


def run(function: FunctionType, *records: Any, constants: tuple[Any, ...] = ()) -> None:
    """What ``Kernel(function, *constants)`` does with these records, in plain Python.

    Args:
        function: a function that can be compiled.
        records: NamedTuples; their arrays are written to.
        constants: its first arguments, see `nag.machine_code.kernel.Kernel`.

    Raises:
        IndexError: if it reads or writes outside an array, or lanes that are not aligned.
        ZeroDivisionError: if it divides a whole number by zero.
    """
    with np.errstate(all="ignore"):
        function(*constants, *map(_check_record, records))
