"""What is given as an argument, and one line that names it where it makes no sense."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from numbers import Integral, Real
from os import PathLike
from typing import Any

from nag.errors import NagError

SETTINGS = ("fast", "default", "careful")


def is_a(value: object, module: str, name: str) -> bool:
    """Whether a value is of a class whose module must have been loaded to make it."""
    loaded = sys.modules.get(module)
    return loaded is not None and isinstance(value, getattr(loaded, name))


def value_text(value: Any) -> str:
    """A value in an error message: itself, if that is short."""
    if value is None or isinstance(value, str | int | float):
        text = repr(value)
        return text if len(text) <= 40 else f"{text[:37]}..."
    return f"something of type {type(value).__name__}"


def check_type(value: Any, kind: type, place: str, advice: str) -> None:
    """Make sure that an argument is of a type.

    Raises:
        ValueError: if it is not; ``advice`` says what to give.
    """
    if not isinstance(value, kind):
        raise NagError(f"{place}: {value_text(value)} is given; give {advice}")


def check_listed(values: Any, place: str, advice: str) -> None:
    """Make sure that an argument is a list, or another iterable that is no text and no mapping.

    Raises:
        ValueError: if it is not.
    """
    if isinstance(values, str | bytes | Mapping) or not isinstance(values, Iterable):
        raise NagError(f"{place}: {value_text(values)} is given; give {advice}")


def check_whole(value: Any, place: str, least: int = 0) -> None:
    """Make sure that an argument is a whole number from ``least`` up.

    Raises:
        ValueError: if it is not.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or value < least:
        raise NagError(
            f"{place}: {value_text(value)} is given; give a whole number from {least} up"
        )


def check_error(value: Any, place: str) -> None:
    """Make sure that an argument is a finite real number from 0 up, or None.

    Raises:
        ValueError: if it is not.
    """
    if value is not None:
        check_size(value, place)


def check_size(value: Any, place: str) -> None:
    """Make sure that an argument is a finite real number from 0 up.

    Raises:
        ValueError: if it is not.
    """
    number = isinstance(value, Real) and not isinstance(value, bool)
    if not (number and isfinite(value) and value >= 0):
        raise NagError(f"{place}: {value_text(value)} is given; give a number from 0 up")


def check_choice(value: Any, place: str, known: Sequence[str]) -> None:
    """Make sure that an argument is one of some words.

    Raises:
        ValueError: if it is not.
    """
    if value not in known:
        raise NagError(f"{place}: {value_text(value)} is unknown; use {', '.join(known)}")


def check_path(value: Any, place: str = "path") -> None:
    """Make sure that an argument can name a file.

    Raises:
        ValueError: if it cannot.
    """
    if not isinstance(value, str | PathLike):
        raise NagError(f"{place}: {value_text(value)} is given; give the name of a file")


def check_running(seed: Any, threads: Any, settings: Any, progress: Any = None) -> None:
    """Make sure that the arguments of a run make sense.

    Raises:
        ValueError: if one does not.
    """
    check_whole(seed, "seed")
    check_whole(threads, "threads", 1)
    if not is_a(settings, "nag.tracking.settings", "Settings"):
        check_choice(settings, "settings", SETTINGS)
    if progress is not None and progress is not True and not callable(progress):
        raise NagError(
            f"progress: {value_text(progress)} is given; give True for a bar, or a function of a "
            "stage's name, the step reached and the number of steps"
        )
