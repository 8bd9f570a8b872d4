"""Arrays of results, which nobody may change, and results that are equal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import TypeAlias

import numpy as np

# Arrays of results by what is in them.
ComplexArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]
RealArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
IntegerArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int64]]
ByteArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
BooleanArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]


def fixed_array(array: np.ndarray, dtype: type | None = None) -> np.ndarray:
    """The array itself if nobody can write to it, else a read-only copy: others may hold it."""
    array = np.asarray(array, dtype=dtype)
    if _can_be_written(array):
        array = array.copy()
        array.setflags(write=False)
    return array


def _can_be_written(array: np.ndarray) -> bool:
    """Whether it is writeable, or a view of what is."""
    owner: object = array
    while isinstance(owner, np.ndarray):
        if owner.flags.writeable:
            return True
        owner = owner.base
    return False


def equal_values(one: object, other: object) -> bool:
    """Whether two results of one class agree in all fields that are compared, arrays by value.

    Of arrays entries that are not numbers are equal to each other.
    """
    if type(one) is not type(other) or not is_dataclass(one):
        return False
    return all(
        equal_entries(getattr(one, each.name), getattr(other, each.name))
        for each in fields(one)
        if each.compare
    )


def equal_entries(one: object, other: object) -> bool:
    """Whether two fields or records agree, arrays in them by value."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=True)
    if isinstance(one, tuple | list) and isinstance(other, tuple | list):
        return len(one) == len(other) and all(map(equal_entries, one, other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(
            equal_entries(one[key], other[key]) for key in one
        )
    return bool(one == other)
