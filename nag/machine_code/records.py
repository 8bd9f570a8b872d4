"""Types of the values in kernels, and records: the arguments that Python hands over.

A record is a NamedTuple whose fields are annotated with ``int``, ``float``, ``bool`` or one of
`Wholes`, `Reals`, `Complexes`. A kernel sees it as a pointer to a table of 64-bit words, a number
or the address of an array's first entry each; a field's numbers stay what they are during a call.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cache
from operator import index
from struct import Struct
from typing import Any, get_type_hints

import numpy as np

Wholes = np.ndarray[Any, np.dtype[np.int64]]
Reals = np.ndarray[Any, np.dtype[np.float64]]
Complexes = np.ndarray[Any, np.dtype[np.complex128]]


@dataclass(frozen=True)
class Type:
    """Type of a value in a kernel: a number, or the ``name`` of anything else."""

    name: str

    def __str__(self) -> str:
        return self.name


# Numbers, each of which converts to the later ones.
BOOL, INT, REAL, COMPLEX = Type("bool"), Type("int"), Type("float"), Type("complex")
NUMBERS = (BOOL, INT, REAL, COMPLEX)
# A register with one double for each of eight paths.
LANES = Type("lanes")
NONE = Type("None")


@dataclass(frozen=True)
class Pointer(Type):
    """Pointer to numbers of one type."""

    element: Type


@dataclass(frozen=True)
class Tuple(Type):
    """Several values."""

    items: tuple[Type, ...]


@dataclass(frozen=True)
class Constant(Type):
    """An object that is known when a kernel is compiled; functions are translated for each one."""

    value: Any


@dataclass(frozen=True)
class Record(Type):
    """A table of words; ``fields`` are the types of what they stand for."""

    fields: tuple[tuple[str, Type], ...]


def constant_type(value: Any) -> Constant:
    """The type of an object that is known."""
    return Constant(type(value).__name__, value)


def pointer(element: Type) -> Pointer:
    """The type of pointers to ``element``."""
    return Pointer(f"{element}*", element)


def several(items: tuple[Type, ...]) -> Tuple:
    """The type of tuples of ``items``."""
    return Tuple(f"({', '.join(map(str, items))})", items)


_FIELDS: dict[Any, Type] = {
    bool: BOOL,
    int: INT,
    float: REAL,
    Wholes: pointer(INT),
    Reals: pointer(REAL),
    Complexes: pointer(COMPLEX),
}
_WORDS: dict[Type, Any] = {
    BOOL: bool,
    INT: int,
    REAL: float,
    pointer(INT): np.dtype("i8"),
    pointer(REAL): np.dtype("f8"),
    pointer(COMPLEX): np.dtype("c16"),
}
# A double as the word that it is.
_REAL, _WHOLE = Struct("=d"), Struct("=q")
# No bytes, wherever they begin.
_PLACE = ctypes.c_char * 0


@cache
def record(cls: type) -> Record:
    """The type of a NamedTuple.

    Raises:
        TypeError: if a field's annotation is none of those that a kernel can read.
    """
    hints = get_type_hints(cls)
    for name, hint in hints.items():
        if hint not in _FIELDS:
            raise TypeError(f"{cls.__name__}.{name}: a kernel cannot read {hint}")
    return Record(cls.__name__, tuple((name, _FIELDS[hint]) for name, hint in hints.items()))


@dataclass(frozen=True, eq=False)
class Table:
    """The words of a record that is handed over more than once; it keeps the record alive."""

    words: np.ndarray
    address: int
    record: Any


def table(values: Any) -> Table:
    """The words of a NamedTuple, int64; the arrays in it must stay as they are.

    Raises:
        TypeError: if an array is not contiguous or has another type than its field, or a number is
            none of its field's type.
    """
    if isinstance(values, Table):
        return values
    layout = _layout(type(values))
    pairs = zip(values, layout, strict=True)
    words = np.array(
        [_word(k, value, dtype, values) for k, (value, dtype) in enumerate(pairs)], dtype=np.int64
    )
    return Table(words, address(words), values)


def replaced(known: Table, **fields: Any) -> Table:
    """The words of a table's record with other values of some ``fields``.

    Raises:
        TypeError: as `table` does.
    """
    values = known.record._replace(**fields)
    layout, places = _layout(type(values)), _places(type(values))
    words = known.words.copy()
    for name, value in fields.items():
        k = places[name]
        words[k] = _word(k, value, layout[k], values)
    return Table(words, address(words), values)


def _word(k: int, value: Any, dtype: Any, values: Any) -> int:
    """Word ``k``, of a field of ``values``."""
    if dtype is int:
        return index(value)
    if dtype is bool:
        return bool(value)
    if dtype is float:
        return _WHOLE.unpack(_REAL.pack(value))[0]
    if (value.dtype is not dtype and value.dtype != dtype) or not value.flags.c_contiguous:
        name = f"{type(values).__name__}.{values._fields[k]}"
        raise TypeError(f"{name} is no contiguous array of {dtype.name}")
    return address(value)


def address(array: np.ndarray) -> int:
    """Where the first entry of a contiguous array lies."""
    try:
        # Four times as fast as asking NumPy.
        return ctypes.addressof(_PLACE.from_buffer(array))
    except TypeError:
        # It must not be written to.
        return array.ctypes.data


@cache
def _layout(cls: type) -> tuple[Any, ...]:
    """What each field's word is made from: ``bool, int, float``, or an array of a dtype."""
    return tuple(_WORDS[kind] for _, kind in record(cls).fields)


@cache
def _places(cls: type) -> dict[str, int]:
    """The number of each field's word."""
    return {name: k for k, name in enumerate(cls._fields)}
