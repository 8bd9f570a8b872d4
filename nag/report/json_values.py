"""Values of a JSON document, each checked as it is taken out.

Every function takes the value and its place in the document, returns it in our own type, and
raises `ExportError` with the place and what it must be.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np


class ExportError(ValueError):
    """An export that cannot be read; the message is one line: file, key, what is wrong."""


def wrong(place: str, wanted: str) -> ExportError:
    return ExportError(f"{place}: must be {wanted}")


def entry(table: Mapping[str, Any], key: str, place: str) -> Any:
    if key not in table:
        raise ExportError(f"{place}: the key {key!r} is missing")
    return table[key]


def as_table(value: Any, place: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise wrong(place, "an object")
    return value


def as_list(value: Any, place: str) -> list[Any]:
    if not isinstance(value, list):
        raise wrong(place, "a list")
    return value


def as_text(value: Any, place: str) -> str:
    if not isinstance(value, str):
        raise wrong(place, "a string")
    return value


def as_texts(value: Any, place: str) -> list[str]:
    return [as_text(v, f"{place}[{i}]") for i, v in enumerate(as_list(value, place))]


def as_count(value: Any, place: str, least: int = 0) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or value < least:
        raise wrong(place, f"an integer, {least} or more")
    return value


def as_flag(value: Any, place: str) -> bool:
    if not isinstance(value, bool):
        raise wrong(place, "true or false")
    return value


def as_double(value: Any, place: str) -> float:
    if value is None:
        return math.nan
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise wrong(place, "a number or null")
    try:
        return float(value)
    except OverflowError:
        raise wrong(place, "a number in the range of doubles") from None


def as_vector(value: Any, place: str) -> np.ndarray:
    numbers = []
    for i, pair in enumerate(as_list(value, place)):
        if not isinstance(pair, list) or len(pair) != 2:
            raise wrong(f"{place}[{i}]", "a pair [re, im]")
        numbers.append([as_double(x, f"{place}[{i}]") for x in pair])
    return np.array(numbers, dtype=float).reshape(-1, 2).view(complex)[:, 0]


def as_matrix(value: Any, columns: int, place: str) -> np.ndarray:
    rows = [as_vector(row, f"{place}[{i}]") for i, row in enumerate(as_list(value, place))]
    for i, row in enumerate(rows):
        if len(row) != columns:
            raise wrong(f"{place}[{i}]", f"of length {columns}, one entry for each variable")
    return np.array(rows, dtype=complex).reshape(len(rows), columns)
