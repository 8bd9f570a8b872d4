"""Arrays and mappings of results, which nobody may change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import TypeVar

import numpy as np

Key = TypeVar("Key")
Value = TypeVar("Value")


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
        _equal(getattr(one, each.name), getattr(other, each.name))
        for each in fields(one)
        if each.compare
    )


def _equal(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=True)
    if isinstance(one, tuple | list) and isinstance(other, tuple | list):
        return len(one) == len(other) and all(map(_equal, one, other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_equal(one[key], other[key]) for key in one)
    return bool(one == other)


class FixedMapping(Mapping[Key, Value]):
    """A copy of a mapping that nobody can write to; unlike Python's own it can be pickled."""

    __slots__ = ("_values",)

    def __init__(self, mapping: Mapping[Key, Value]) -> None:
        self._values = dict(mapping)

    def __getitem__(self, key: Key) -> Value:
        return self._values[key]

    def __contains__(self, key: object) -> bool:
        return key in self._values

    def __iter__(self) -> Iterator[Key]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return repr(self._values)


def fixed_mapping(mapping: Mapping[Key, Value]) -> FixedMapping[Key, Value]:
    """The mapping itself if it is such a copy, else one."""
    return mapping if isinstance(mapping, FixedMapping) else FixedMapping(mapping)
