"""What results have in common: arrays that nobody may change, equality, and what they hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, Protocol, TypeAlias, TypeVar, overload

import numpy as np

from nag.algebra.given import value_text

# Arrays of results by what is in them.
ComplexArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]
RealArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.float64]]
IntegerArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int64]]
ByteArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
BooleanArray: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]


class Column(Protocol):
    """A column of a table, as pandas has it."""

    @property
    def ndim(self) -> int: ...
    def to_numpy(self) -> np.ndarray: ...


# Of a sequence some entries: a slice, places, or a truth value for each.
Chosen: TypeAlias = slice | Sequence[int] | np.ndarray | Column
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


class Entries(Sequence[Item]):
    """A sequence whose entries are compared whole, arrays in them by value."""

    def __contains__(self, item: object) -> bool:
        return any(equal_entries(each, item) for each in self)

    def index(self, value: object, start: int = 0, stop: int | None = None) -> int:
        """The place of the first entry that equals a value, from 0 on.

        Raises:
            ValueError: if there is none.
        """
        places = range(len(self))[start:stop]
        for i, each in enumerate(self):
            if i in places and equal_entries(each, value):
                return i
        raise ValueError(f"{value_text(value)} is none of the {len(self)}")

    def count(self, value: object) -> int:
        """How many entries equal a value."""
        return sum(equal_entries(each, value) for each in self)


def read_index(index: Any, count: int) -> int | slice | IntegerArray:
    """What is chosen of so many: one, counted from 0, a slice, or places in an array.

    Args:
        index: a whole number or a slice; a list, an array or a column of whole numbers, or of as
            many truth values as there are.

    Raises:
        TypeError: if it is something else.
        IndexError: if there is none of that number, or not as many truth values.
    """
    if isinstance(index, slice):
        return index
    if isinstance(index, list) or getattr(index, "ndim", 0) == 1:
        given = np.asarray(index, dtype=None if len(index) else int)
        if given.ndim == 1 and all(isinstance(each, bool) for each in given.tolist()):
            if len(given) not in (0, count):
                raise IndexError(f"{len(given)} truth values for {count}; give one for each")
            return np.flatnonzero(given)
        if given.ndim == 1 and given.dtype.kind in "iu":
            return np.array([_place_of(i, count) for i in given.tolist()], dtype=int)
    try:
        return _place_of(index, count)
    except TypeError:
        said = f"{value_text(index)} is no index; give a whole number, a slice, or a list or an "
        raise TypeError(f"{said}array of whole numbers or of truth values") from None


def _place_of(index: Any, count: int) -> int:
    try:
        return range(count)[index]
    except IndexError:
        raise IndexError(f"index {index} of {count}, counted from 0") from None


class Several(FixedArrays, Entries[Item]):
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
    def __getitem__(self, index: Chosen) -> Sequence[Item]: ...

    def __getitem__(self, index: int | Chosen) -> Item | Sequence[Item]:
        chosen, entries = read_index(index, len(self)), self.entries
        if isinstance(chosen, np.ndarray):
            if isinstance(entries, np.ndarray):
                return fixed_array(entries[chosen])  # type: ignore[return-value]
            return tuple(entries[i] for i in chosen.tolist())
        return entries[chosen]


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
