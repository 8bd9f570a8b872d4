"""Tables: of each of P things the same is known, and some are chosen, replaced or added.

Columns are arrays of first length P, tables, or mappings by index of what only some things have.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any, ClassVar, Self, TypeVar, overload

import numpy as np

from nag.errors import NagError
from nag.numerics.large_arrays import empty_array, leave_to_file
from nag.numerics.read_only import Chosen, Entries, equal_entries, read_index

Record = TypeVar("Record")
# Rows whose values are worked out at once.
ROWS = 4096


def map_rows(function: Callable[..., np.ndarray], *columns: np.ndarray) -> np.ndarray:
    """What a function makes of rows, some at a time.

    What it needs on the way is never there for all rows together.

    Args:
        function: of arrays of some rows, to an array with as many rows.
        columns: of the same first length P.
    """
    count = len(columns[0])
    found = function(*(column[:ROWS] for column in columns))
    if count <= ROWS:
        return found
    whole = empty_array((count, *found.shape[1:]), found.dtype)
    whole[:ROWS] = found
    for first in range(ROWS, count, ROWS):
        whole[first : first + ROWS] = function(*(c[first : first + ROWS] for c in columns))
        leave_to_file(whole, *columns)
    return whole


def copy_rows(column: np.ndarray) -> np.ndarray:
    """The same rows, which may be written to."""
    return map_rows(np.array, column)


def take_rows(column: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Some rows of a column, by their indices, some at a time."""
    rows = map_rows(lambda some: column[some], chosen)
    leave_to_file(column)
    return rows


def join_columns(parts: Sequence[np.ndarray]) -> np.ndarray:
    """The rows of one column after those of another; there is at least one."""
    first, dtype = 0, np.result_type(*parts)
    whole = empty_array((sum(map(len, parts)), *parts[0].shape[1:]), dtype)
    for part in parts:
        whole[first : first + len(part)] = part
        first += len(part)
    return whole


class ArrayTable:
    """A dataclass all of whose fields are columns."""

    def _columns(self) -> Iterator[tuple[str, Any]]:
        for each in fields(self):  # type: ignore[arg-type]
            yield each.name, getattr(self, each.name)

    def __len__(self) -> int:
        return len(next(column for _, column in self._columns()))

    def select_rows(self, indices: np.ndarray) -> Self:
        """Those at some indices, in that order, or where a mask is true."""
        indices = np.arange(len(self))[indices]
        chosen: dict[str, Any] = {}
        for name, column in self._columns():
            if isinstance(column, Mapping):
                places = enumerate(indices.tolist())
                chosen[name] = {k: column[i] for k, i in places if i in column}
            elif isinstance(column, ArrayTable):
                chosen[name] = column.select_rows(indices)
            else:
                chosen[name] = take_rows(column, indices)
        return replace(self, **chosen)  # type: ignore[type-var]

    def replace_rows(self, indices: np.ndarray, others: Self) -> Self:
        """The same with others at some indices."""
        gone, changed = set(indices.tolist()), {}
        for name, column in self._columns():
            new = getattr(others, name)
            if isinstance(column, Mapping):
                kept = {i: value for i, value in column.items() if i not in gone}
                changed[name] = kept | {int(indices[k]): value for k, value in new.items()}
            elif isinstance(column, ArrayTable):
                changed[name] = column.replace_rows(indices, new)
            else:
                changed[name] = copy_rows(column)
                changed[name][indices] = new
        return replace(self, **changed)  # type: ignore[type-var]

    @classmethod
    def concatenate(cls, tables: Sequence[Self]) -> Self:
        """The rows of one table after those of another; there is at least one."""
        firsts = np.cumsum([0, *map(len, tables)]).tolist()
        whole: dict[str, Any] = {}
        for name, column in tables[0]._columns():
            parts = [getattr(table, name) for table in tables]
            if isinstance(column, Mapping):
                pairs = zip(firsts, parts, strict=False)
                whole[name] = {first + k: part[k] for first, part in pairs for k in part}
            elif isinstance(column, ArrayTable):
                whole[name] = column.concatenate(parts)
            else:
                whole[name] = join_columns(parts)
        return replace(tables[0], **whole)  # type: ignore[type-var]

    @classmethod
    def collect(cls, tables: Iterable[Self], count: int) -> Self:
        """The same of tables of arrays and mappings that come one by one, and are not kept.

        Args:
            count: rows of all together; there is at least one table.
        """
        whole: dict[str, Any] = {}
        first, table = 0, None
        for table in tables:
            for name, column in table._columns():
                if isinstance(column, Mapping):
                    whole.setdefault(name, {}).update({first + k: v for k, v in column.items()})
                    continue
                if name not in whole:
                    whole[name] = empty_array((count, *column.shape[1:]), column.dtype)
                whole[name][first : first + len(column)] = column
                leave_to_file(whole[name])
            first += len(table)
        if table is None or first != count:
            raise ValueError(f"{first} rows came, not {count}")
        return replace(table, **whole)  # type: ignore[type-var]


class RecordTable(ArrayTable, Entries[Record]):
    """A table whose rows are read as records, each made when it is asked for.

    It equals any sequence of equal records.

    Attributes:
        numbers: names of the columns that hold a number for each row, and their types, in the order
            of a record's fields.
    """

    numbers: ClassVar[Mapping[str, type[np.generic]]] = {}

    @classmethod
    def collect_numbers(cls, records: Sequence[Record]) -> dict[str, np.ndarray]:
        """The columns of numbers of some records, by name."""
        return {
            name: np.array([getattr(record, name) for record in records], dtype=dtype)
            for name, dtype in cls.numbers.items()
        }

    def numbers_of_row(self, i: int) -> Iterator[Any]:
        """The numbers of a row, as Python has them."""
        return (getattr(self, name)[i].item() for name in self.numbers)

    def record(self, i: int) -> Record:
        """The row ``i``, from 0 on."""
        raise NotImplementedError

    @overload
    def __getitem__(self, index: int) -> Record: ...

    @overload
    def __getitem__(self, index: Chosen) -> Self: ...

    def __getitem__(self, index: int | Chosen) -> Record | Self:
        chosen = read_index(index, len(self))
        if isinstance(chosen, int):
            return self.record(chosen)
        return self.select_rows(chosen)  # type: ignore[arg-type]

    def __iter__(self) -> Iterator[Record]:
        return map(self.record, range(len(self)))

    def __add__(self, other: Self) -> Self:
        """The rows of one table, and those of another below them."""
        if type(other) is not type(self):
            return NotImplemented
        for name, column in self._columns():
            own, others = np.shape(column)[1:], np.shape(getattr(other, name))[1:]
            if own != others:
                raise NagError(f"the tables do not go together: {name} have shapes {own}, {others}")
        return self.concatenate([self, other])

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sequence):
            return NotImplemented
        same = len(self) == len(other)
        return same and all(map(equal_entries, self, other))

    __hash__ = None  # type: ignore[assignment]
