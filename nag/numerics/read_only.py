"""What results have in common: arrays that nobody may change, equality, and what they hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, TypeAlias, TypeVar, overload

import numpy as np

# Arrays of results by what is in them.
ComplexArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]
RealArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
IntegerArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int64]]
ByteArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
BooleanArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]


Item = TypeVar("Item")


def fixed_array(array: np.ndarray, dtype: type | None = None) -> np.ndarray:
    """The array itself if nobody can write to it, else a read-only copy: others may hold it."""
    array = np.asarray(array, dtype=dtype)
    if _can_be_written(array):
        array = array.copy()
    return handed_over(array) if array.flags.owndata else array


def handed_over(array: np.ndarray) -> np.ndarray:
    """An array, to which nobody else will write, as one to which nobody can.

    Of one that owns its data the flag could be set back; of a view of it that is refused. It is not
    copied, as it may lie in a file.
    """
    if array.flags.owndata:
        array.setflags(write=False)
        return array.view()
    if not (array.size and array.flags.c_contiguous):
        return fixed_array(array)
    content = memoryview(array.reshape(-1).view(np.uint8)).toreadonly()
    return np.frombuffer(content, dtype=array.dtype).reshape(array.shape)


def _can_be_written(array: np.ndarray) -> bool:
    """Whether it is writeable, or a view of what is."""
    owner: object = array
    while isinstance(owner, np.ndarray):
        if owner.flags.writeable:
            return True
        owner = owner.base
    return False


class FixedArrays:
    """A dataclass whose arrays cannot be written to, after it was pickled or copied either."""

    def __post_init__(self) -> None:
        fix_fields(self)

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        for name, value in state.items():
            fixed = handed_over(value) if isinstance(value, np.ndarray) else value
            object.__setattr__(self, name, fixed)


def fix_fields(made: Any, done: bool = False) -> None:
    """Fix the arrays that a dataclass holds.

    Args:
        done: whether nobody will write to them any more, nor to those of dataclasses that it
            holds, which are fixed as well; else it was just made, and others may hold them.
    """
    for each in fields(made):
        value = getattr(made, each.name)
        if isinstance(value, np.ndarray):
            fixed = handed_over(value) if done and _can_be_written(value) else fixed_array(value)
            object.__setattr__(made, each.name, fixed)
        elif done and is_dataclass(value):
            fix_fields(value, done)


class Several(FixedArrays, Sequence[Item]):
    """A result that is a sequence of what it holds."""

    @property
    def entries(self) -> Sequence[Item]:
        """What that is, in order."""
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self.entries)

    def __iter__(self) -> Iterator[Item]:
        return iter(self.entries)

    @overload
    def __getitem__(self, index: int) -> Item: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Item]: ...

    def __getitem__(self, index: int | slice) -> Item | Sequence[Item]:
        return self.entries[index]

    def __contains__(self, item: object) -> bool:
        return any(equal_entries(each, item) for each in self.entries)


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
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return False
    return bool(one == other)
