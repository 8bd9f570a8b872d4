"""Mappings of results, which nobody may change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


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

    def __hash__(self) -> int:
        # Mappings are equal whatever the order of their items is.
        return hash(frozenset(self._values.items()))

    def __repr__(self) -> str:
        return repr(self._values)


def fixed_mapping(mapping: Mapping[Key, Value]) -> FixedMapping[Key, Value]:
    """The mapping itself if it is such a copy, else one."""
    return mapping if isinstance(mapping, FixedMapping) else FixedMapping(mapping)
