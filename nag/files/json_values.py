"""Values of a JSON document, each checked as it is taken out.

Every function that reads takes the value and its place in the document, returns it in our own type,
and raises `ExportError` with the place and what it must be. Exports are checked by their schemas
as a whole first.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from errno import EISDIR
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from typing import Any, TypeVar

import numpy as np

from nag.algebra.expression import parse_polynomial
from nag.algebra.given import check_path
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import InputError, NagError, unreadable
from nag.files.json_schema import find_problem, schema

LARGEST_FILE = 256 * 1024**2
T = TypeVar("T")


class ExportError(InputError):
    """An export that cannot be read; the message is one line: file, key, what is wrong."""


def wrong(place: str, wanted: str) -> ExportError:
    return ExportError(f"{place}: must be {wanted}")


def check_imaginary_unit(points: np.ndarray, imaginary: bool, place: str) -> None:
    """Of points of complex equations the last coordinate is the imaginary unit.

    Its equation has a second zero, at which all others are the conjugate ones.

    Raises:
        ExportError: if that is what it is.
    """
    if imaginary and (points[..., -1].imag < 0).any():
        raise wrong(
            place, "i in the imaginary unit's coordinate: -i is that of the conjugate system"
        )


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


def as_double(value: Any, place: str) -> float:
    if value is None:
        return math.nan
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise wrong(place, "a number or null")
    try:
        return float(value)
    except OverflowError:
        raise wrong(place, "a number in the range of doubles") from None


def real_number(value: float | None) -> float:
    """A number of a checked document, not-a-number where it is null."""
    return math.nan if value is None else float(value)


def complex_vector(value: list[Any]) -> np.ndarray:
    """The array that `pairs` wrote of one dimension."""
    return np.array(value, dtype=float).reshape(-1, 2).view(complex)[:, 0]


def complex_matrix(value: list[Any], columns: int, place: str) -> np.ndarray:
    """The array that `pairs` wrote of two dimensions.

    Raises:
        ExportError: if it has another number of columns.
    """
    for i, row in enumerate(value):
        if len(row) != columns:
            raise wrong(f"{place}[{i}]", f"of length {columns}, one entry for each variable")
    doubles = np.array(value, dtype=float).reshape(len(value), columns, 2)
    return doubles.view(complex)[..., 0]


def parse_polynomials(
    texts: Sequence[str], variables: Sequence[str], place: str
) -> list[Polynomial]:
    """The polynomials that texts spell.

    Raises:
        ExportError: if one spells none.
    """
    found = []
    for i, text in enumerate(texts):
        try:
            found.append(parse_polynomial(text, variables))
        except ValueError as error:
            raise ExportError(f"{place}[{i}]: {error}") from None
    return found


def parse_system(table: Mapping[str, Any], place: str) -> PolynomialSystem:
    """The system of which this is the document.

    Raises:
        ExportError: if there is none such.
    """
    variables = table["variables"]
    index = {name: i for i, name in enumerate(variables)}
    for i, names in enumerate(table["groups"]):
        if unknown := [name for name in names if name not in index]:
            here = f"{place}.groups[{i}]"
            raise ExportError(f"{here}: {unknown[0]!r} is not one of the variables")
    groups = [[index[name] for name in names] for names in table["groups"]]
    parts = [
        parse_polynomials(table[key], variables, f"{place}.{key}")
        for key in ("polynomials", "nonzero")
    ]
    try:
        unit = table.get("imaginary")
        if unit is not None and [unit] != variables[-1:]:
            raise ExportError(f"{place}.imaginary: {unit!r} is not the last variable")
        return PolynomialSystem(
            variables, *parts, groups, unit is not None, bool(table.get("isotropic"))
        )
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


def checked_document(value: Any, name: str, *versions: int) -> dict[str, Any]:
    """The whole document, which fits the schema of its version of the format.

    Raises:
        ExportError: if it does not.
    """
    table = as_document(value, name, *versions)
    problem = find_problem(table, schema(name, table["version"]))
    if problem is not None:
        place, what = problem
        raise ExportError(f"{place.removeprefix('.') or 'the file'}: {what}")
    return table


def _refuse_constant(name: str) -> float:
    raise NagError(f"{name} is not a JSON number")


class _NoFileName(ValueError):
    """A name that no file can have."""


def _size_of(file: Path) -> int:
    try:
        kind = file.stat()
    except ValueError as error:
        raise _NoFileName(str(error)) from None
    if S_ISDIR(kind.st_mode):
        raise IsADirectoryError(EISDIR, os.strerror(EISDIR))
    if not S_ISREG(kind.st_mode):
        raise ExportError("is not a file")
    return kind.st_size


def read_file(path: str | os.PathLike[str], convert: Callable[[Any], T]) -> T:
    """What ``convert`` makes of the JSON document in a file.

    Raises:
        ExportError: if the file cannot be read, or is not such a document.
    """
    check_path(path)
    file = Path(path)
    try:
        if _size_of(file) > LARGEST_FILE:
            raise ExportError(f"is larger than {LARGEST_FILE // 1024**2} MB")
        return convert(json.loads(file.read_bytes(), parse_constant=_refuse_constant))
    except ExportError as error:
        raise ExportError(f"{file}: {error}") from None
    except OSError as error:
        raise ExportError(unreadable(file, error)) from None
    except _NoFileName as error:
        raise ExportError(unreadable(repr(str(file)), error)) from None
    except RecursionError:
        raise ExportError(f"{file}: is not an export: lists are nested too deep") from None
    except ValueError as error:
        raise ExportError(
            f"{file}: is not JSON: {error}; give an export of components or of solutions"
        ) from None


# What a document says that follows from the rest of it; relative difference that rounding makes.
FOLLOWS = ("accuracy", "precision", "exact")
AGREES = 1e-9


def read_differently(given: Any, again: Any, place: str = "") -> dict[str, str]:
    """Fields of a document that are lost, or come out otherwise, when it is read and written again.

    Args:
        given: the document, or a part of it; again: what is written of what was read.

    Returns:
        For each such field, ``list[0].key`` in lists, why.

    >>> read_differently({"a": 1, "more": 2, "exact": True}, {"a": 1, "exact": False})["exact"]
    'that it is true: the rest of the file says false'
    """
    found: dict[str, str] = {}
    if isinstance(given, dict) and isinstance(again, dict):
        for key, value in given.items():
            here = f"{place}.{key}" if place else key
            if key not in again:
                found[here] = "it is no field of the format"
            elif key in FOLLOWS and not _agree(value, again[key]):
                one, other = json.dumps(value), json.dumps(again[key])
                found[here] = f"that it is {one}: the rest of the file says {other}"
            else:
                found |= read_differently(value, again[key], here)
    elif isinstance(given, list) and isinstance(again, list):
        for i, (one, other) in enumerate(zip(given, again, strict=False)):
            found |= read_differently(one, other, f"{place}[{i}]")
    return found


def _agree(one: Any, other: Any) -> bool:
    numbers = [isinstance(value, float) for value in (one, other)]
    return math.isclose(one, other, rel_tol=AGREES) if all(numbers) else one == other
