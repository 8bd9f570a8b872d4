"""What is given as an argument, and one line that names it where it makes no sense."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from inspect import signature
from math import isfinite
from numbers import Integral, Real
from os import PathLike
from typing import Any, TypeAlias

from nag.errors import NagError

# What functions take, by names that help shows: for type checkers they are in the package's stub,
# which says what each may be.
Decomposed: TypeAlias = Any
Drives: TypeAlias = Any
Equations: TypeAlias = Any
Moving: TypeAlias = Any
Names: TypeAlias = Any
Point: TypeAlias = Any
Placements: TypeAlias = Any
Solvable: TypeAlias = Any
Values: TypeAlias = Any
Writable: TypeAlias = Any
# What is asked of an argument by how it is declared.
_TEXT, _TRUTH = "a text", "True or False"
DECLARED: Mapping[str, tuple[Any, str]] = {
    "str": (str, _TEXT),
    "str | None": (str | None, _TEXT),
    "Method": (str, _TEXT),
    "Coordinates | None": (str | None, _TEXT),
    "Space | None": (str | None, _TEXT),
    "bool": (bool, _TRUTH),
    "str | os.PathLike[str]": (str | PathLike, "the name of a file"),
}
# Answers that have the equations which they answer: where these classes are.
ANSWERS = (
    ("nag.witness.witness", "Decomposition"),
    ("nag.solving.solutions", "SolveResult"),
)
# What is said of a graph where a system or a mechanism is asked for.
GRAPH_GIVEN = (
    "a networkx graph is given; make it a mechanism first, "
    "nag.Mechanism.from_graph(graph, ground=...), or of bars nag.framework_of_graph(graph)"
)
SETTINGS = ("fast", "default", "careful")
# More of anything that is counted does not fit into memory.
LARGEST = 10**9


def is_a(value: object, module: str, name: str) -> bool:
    """Whether a value is of a class whose module must have been loaded to make it."""
    loaded = sys.modules.get(module)
    return loaded is not None and isinstance(value, getattr(loaded, name))


def value_text(value: Any) -> str:
    """A value in an error message: itself, if that is short."""
    # Python writes no whole numbers of thousands of digits.
    huge = isinstance(value, int) and value.bit_length() > 1000
    if value is None or (isinstance(value, str | int | float) and not huge):
        text = repr(value)
        return text if len(text) <= 40 else f"{text[:37]}..."
    return f"something of type {type(value).__name__}"


def check_type(value: Any, kind: Any, place: str, advice: str) -> None:
    """Make sure that an argument is of a type, or one of a union.

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


def check_whole(value: Any, place: str, least: int = 0, most: int | None = LARGEST) -> None:
    """Make sure that an argument is a whole number from ``least`` up, to ``most`` if there is one.

    Raises:
        ValueError: if it is not.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or value < least:
        raise NagError(
            f"{place}: {value_text(value)} is given; give a whole number from {least} up"
        )
    if most is not None and int(value) > most:
        raise NagError(f"{place}: {value_text(value)} is given; give at most {most}")


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
    try:
        fits = not isinstance(value, bool) and isinstance(value, Real) and isfinite(value)
    except OverflowError:
        fits = False
    if not (fits and value >= 0):
        raise NagError(f"{place}: {value_text(value)} is given; give a number from 0 up")


def check_choice(value: Any, place: str, known: Sequence[str]) -> None:
    """Make sure that an argument is one of some words.

    Raises:
        ValueError: if it is not.
    """
    if not isinstance(value, str) or value not in known:
        raise NagError(f"{place}: {value_text(value)} is unknown; use {', '.join(known)}")


def check_one_line(text: str, name: str) -> None:
    """Make sure that a text has no line break and no control character.

    Raises:
        nag.NagError: if it has.
    """
    if not text.isprintable():
        raise NagError(f"{name}: holds a line break or a control character; write it in one line")


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
    check_whole(seed, "seed", most=None)
    check_whole(threads, "threads", 1)
    if not is_a(settings, "nag.tracking.settings", "Settings"):
        check_choice(settings, "settings", SETTINGS)
    if progress is not None and progress is not True and not callable(progress):
        raise NagError(
            f"progress: {value_text(progress)} is given; give True for a bar, or a function of a "
            "stage's name, the step reached and the number of steps"
        )


def check_declared(
    function: Callable[..., Any],
) -> Callable[[Sequence[Any], Mapping[str, Any]], None]:
    """What makes sure that texts, truth values and names of files are given where a function
    declares them.

    Other arguments are checked by whoever takes them.
    """
    names = list(signature(function).parameters)
    declared = {
        name: DECLARED[kind]
        for name, kind in function.__annotations__.items()
        if name != "return" and kind in DECLARED
    }

    def check(given: Sequence[Any], named: Mapping[str, Any]) -> None:
        for name, value in (*zip(names, given, strict=False), *named.items()):
            kind, text = declared.get(name, (object, ""))
            if not (kind is bool and is_a(value, "numpy", "bool_")):
                check_type(value, kind, name, text)

    return check


def reading_options(set: Any, format: Any, hold: Any, at: Any) -> dict[str, Any]:
    """How a file is to be read, with dicts of values, and names in a tuple, as `nag.read` has it.

    Raises:
        NagError: if one makes no sense.
    """
    check_type(format, str, "format", 'the name of one, or "auto"')
    names = [hold] if isinstance(hold, str) else hold
    check_listed(names, "hold", "a list of names of links")
    return {
        "set": _values_by_name(set, "set", "parameters"),
        "format": format,
        "hold": tuple(map(str, names)),
        "at": _values_by_name(at, "at", "joints"),
    }


def _values_by_name(given: Any, place: str, what: str) -> dict[Any, Any] | None:
    """Values by name, of a mapping or a series of them; None where none are given."""
    if given is None:
        return None
    if not hasattr(given, "keys"):
        advice = f"give a dict of values by name of {what}"
        raise NagError(f"{place}: {value_text(given)} is given; {advice}, {{'a': 0.3}}")
    return dict(given)
