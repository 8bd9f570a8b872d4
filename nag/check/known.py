"""Systems whose prime components the papers give, as functions of their exact parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from nag.check.identities import Root

Values = Sequence[Any]
Formulas = Callable[[Values], list[Any]]
Parameters = Mapping[str, Fraction]


@dataclass(frozen=True)
class Parametrisation:
    """A dense set of points of a component.

    Attributes:
        names: names of its parameters.
        point: from parameters and roots to coordinates.
        roots: square roots that are adjoined.
    """

    names: str
    point: Callable[..., Values]
    roots: tuple[Root, ...] = ()


@dataclass(frozen=True)
class PaperComponent:
    """A prime component as a paper gives it.

    Attributes:
        place: where.
        generators: from the coordinates to what vanishes on it.
        parametrisation: of it.
    """

    place: str
    generators: Formulas
    parametrisation: Parametrisation


@dataclass(frozen=True)
class KnownDecomposition:
    """A system and all its components.

    Attributes:
        name: what it is.
        variables: names of the coordinates.
        equations: from the coordinates to what vanishes.
        components: those of the papers.
    """

    name: str
    variables: tuple[str, ...]
    equations: Formulas
    components: tuple[PaperComponent, ...]


def circle(t: Any) -> tuple[Any, Any]:
    """The point of the unit circle with half-angle tangent t."""
    return (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)


def turned(first: Values, second: Values) -> tuple[Any, Any]:
    """The sum of two directions."""
    return first[0] * second[0] - first[1] * second[1], first[0] * second[1] + first[1] * second[0]


def flat(bars: Sequence[Values]) -> list[Any]:
    """(c, s) of each bar in one list."""
    return [x for bar in bars for x in bar]


def parameter_text(text: str) -> str:
    """Parameters as text, not longer than a line has room for."""
    return text if len(text) <= 60 else f"{text[:57]}..."
