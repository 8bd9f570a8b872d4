"""Values of a JSON document, each checked as it is taken out.

Every function takes the value and its place in the document, returns it in our own type, and
raises `ExportError` with the place and what it must be.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

LARGEST_FILE = 256 * 1024**2
T = TypeVar("T")


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


def as_integer(value: Any, place: str) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise wrong(place, "an integer")
    return value


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


def as_polynomials(value: Any, variables: Sequence[str], place: str) -> list[Polynomial]:
    found = []
    for i, text in enumerate(as_texts(value, place)):
        try:
            found.append(parse_polynomial(text, variables))
        except ValueError as error:
            raise ExportError(f"{place}[{i}]: {error}") from None
    return found


def as_system(value: Any, place: str) -> PolynomialSystem:
    table = as_table(value, place)
    variables = as_texts(entry(table, "variables", place), f"{place}.variables")
    index = {name: i for i, name in enumerate(variables)}
    groups = []
    for i, names in enumerate(as_list(entry(table, "groups", place), f"{place}.groups")):
        here = f"{place}.groups[{i}]"
        if unknown := [name for name in as_texts(names, here) if name not in index]:
            raise ExportError(f"{here}: {unknown[0]!r} is not one of the variables")
        groups.append([index[name] for name in names])
    parts = {
        key: as_polynomials(entry(table, key, place), variables, f"{place}.{key}")
        for key in ("polynomials", "nonzero")
    }
    try:
        return PolynomialSystem(variables, parts["polynomials"], parts["nonzero"], groups)
    except ValueError as error:
        raise ExportError(f"{place}: {error}") from None


def as_document(value: Any, name: str, *versions: int) -> dict[str, Any]:
    """The whole document, of the format and one of the versions given."""
    table = as_table(value, "the file")
    if table.get("format") != name:
        raise wrong("format", f'"{name}"')
    if table.get("version") not in versions:
        known = " or ".join(str(version) for version in sorted(versions))
        raise wrong("version", f"{known}, which this program reads")
    return table


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} is not a JSON number")


def read_file(path: str | os.PathLike[str], convert: Callable[[Any], T]) -> T:
    """What ``convert`` makes of the JSON document in a file.

    Raises:
        ExportError: if the file cannot be read, or is not such a document.
    """
    file = Path(path)
    try:
        if not file.is_file():
            raise ExportError("is not a file" if file.exists() else "there is no such file")
        if file.stat().st_size > LARGEST_FILE:
            raise ExportError(f"is larger than {LARGEST_FILE // 1024**2} MB")
        return convert(json.loads(file.read_bytes(), parse_constant=_refuse_constant))
    except ExportError as error:
        raise ExportError(f"{file}: {error}") from None
    except OSError as error:
        raise ExportError(f"{file}: cannot be read: {error.strerror or error}") from None
    except RecursionError:
        raise ExportError(f"{file}: is not an export: lists are nested too deep") from None
    except ValueError as error:
        raise ExportError(f"{file}: is not JSON: {error}") from None
