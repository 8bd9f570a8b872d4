"""Values of a family's parameters for many members, from a table (CSV) or an array (NumPy)."""

from __future__ import annotations

import contextlib
import csv
import os
import re
from cmath import isfinite
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NoReturn

import numpy as np

from nag.algebra.from_python import exact_complex
from nag.algebra.tokens import nearest, quote
from nag.errors import InputError, unreadable

# The imaginary unit, with the digit before it where there is one.
_UNIT = re.compile(r"(?:(?<=([0-9.]))\*?|(?<![0-9.*]))[iIjJ]")
# Bytes of a file that is read.
MOST_BYTES = 1 << 30


def read_member_values(
    path: str | os.PathLike[str], parameters: Sequence[str], given: Sequence[complex]
) -> np.ndarray:
    """The parameters' values of each member, real or complex, shape ``(M, k)``.

    Args:
        path: a ``.npy`` file with an array of that shape, of one parameter also ``(M,)``; or a
            table whose first line names parameters, in any order.
        parameters: their names.
        given: their values where a table has no column of one.

    Raises:
        InputError: if the file cannot be read or has something else in it; one line.
    """
    file = Path(path)
    with _refuse_other_files(path):
        if file.stat().st_size > MOST_BYTES:
            _fail(path, f"is larger than {MOST_BYTES >> 30} GB; cut it in parts")
        if file.suffix == ".npy":
            return _read_array(file, len(parameters))
        with file.open(encoding="utf-8-sig", newline="") as stream:
            return _read_table(file, csv.reader(stream), parameters, given)


def read_member_names(path: str | os.PathLike[str]) -> list[str]:
    """The names in the first line of a table; none of an array.

    Raises:
        InputError: if the file cannot be read; one line.
    """
    if Path(path).suffix == ".npy":
        return []
    with (
        _refuse_other_files(path),
        Path(path).open(encoding="utf-8-sig", newline="") as stream,
    ):
        return [name.strip() for name in next(csv.reader(stream), [])]


def check_names(
    path: object, names: Sequence[str], known: Sequence[str], wrong: str = "does not occur"
) -> None:
    """That the names in the first line of a table are known, each there once.

    Args:
        wrong: what is said of one that is not.

    Raises:
        InputError: if they are not; one line.
    """
    if not any(names):
        _fail(path, f"is empty; its first line names parameters, of {', '.join(known)}")
    for name in names:
        if name in known:
            if names.count(name) > 1:
                _fail(path, f"line 1: {name!r} is there twice")
            continue
        if ";" in name:
            advice = "; write commas between names, and between values"
        elif _is_number(name):
            advice = f"; write a line of names above the numbers, of {', '.join(known)}"
        else:
            advice = f"{nearest(name, known)}; the names are {', '.join(known)}"
        _fail(path, f"line 1: {quote(name)} {wrong}{advice}")


@contextlib.contextmanager
def _refuse_other_files(path: object) -> Iterator[None]:
    """One line of what cannot be read, or is no table."""
    try:
        yield
    except OSError as error:
        raise InputError(unreadable(path, error)) from None
    except UnicodeDecodeError:
        _fail(path, "is no text; write a table with commas, or a NumPy array named .npy")
    except csv.Error as error:
        _fail(path, f"is no table: {error}")


def _fail(path: object, text: str) -> NoReturn:
    raise InputError(f"{path}: {text}")


def _read_array(file: Path, k: int) -> np.ndarray:
    try:
        array = np.load(file, allow_pickle=False)
    except (ValueError, EOFError):
        _fail(file, "is no array of NumPy's; save one by numpy.save")
    if not isinstance(array, np.ndarray) or array.dtype.kind not in "fiuc":
        _fail(file, "holds no numbers; save an array of doubles")
    if array.ndim == 1 and k == 1:
        array = array[:, None]
    if array.ndim != 2 or array.shape[1] != k:
        _fail(file, f"has shape {array.shape}; of {k} parameters it must be (members, {k})")
    rows = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(rows):
        _fail(file, f"row {rows[0] + 1} has a value that is not finite; leave the row out")
    return array


def _read_table(
    file: Path, lines: csv.Reader, parameters: Sequence[str], given: Sequence[complex]
) -> np.ndarray:
    names = [name.strip() for name in next(lines, [])]
    check_names(file, names, parameters, "is no parameter of the family")
    rows = []
    for line in lines:
        if not line:
            continue
        if len(line) != len(names):
            _fail(file, f"line {lines.line_num}: {len(line)} values, not {len(names)}")
        try:
            rows.append([_number(text) for text in line])
            finite = [isfinite(value) for value in rows[-1]]
        except ValueError:
            wrong = next(text for text in line if not _is_number(text))
            _fail(
                file,
                f"line {lines.line_num}: {quote(wrong)} is no number; write 0.5, or as in a case "
                "1/3, sqrt(2), 1 + 2*I",
            )
        if not all(finite):
            _fail(
                file,
                f"line {lines.line_num}: {quote(line[finite.index(False)])} is not finite; leave "
                "the line out",
            )
    if not rows:
        _fail(file, "has no values below its first line")
    found = np.tile(np.array(given, dtype=complex), (len(rows), 1))
    found[:, [list(parameters).index(name) for name in names]] = rows
    return found


def _number(text: str) -> complex:
    """A number as programs write it, 1.5, (1+2j), 1 + 2*I, or as a case does, 1/3, sqrt(2).

    Expressions are worked out exactly, and then rounded to doubles.

    Raises:
        ValueError: if it is none.
    """
    try:
        return float(text)
    except ValueError:
        plain = re.sub(r"\s*([+-])\s*", r"\1", text.strip())
    try:
        return complex(_UNIT.sub(lambda m: "j" if m[1] else "1j", plain))
    except ValueError:
        return complex(exact_complex(text, "value"))


def _is_number(text: str) -> bool:
    try:
        _number(text)
    except ValueError:
        return False
    return True
