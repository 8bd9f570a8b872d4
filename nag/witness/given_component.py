"""A component, or a decomposition, that is given with what a run needs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nag.algebra.from_python import coordinates
from nag.algebra.given import check_type, check_whole
from nag.algebra.number import Irrational, Surd
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.witness.witness import Decomposition, WitnessSet


def check_system(system: Any, place: str = "system") -> None:
    """Make sure that a system is one.

    Raises:
        ValueError: if it is not.
    """
    check_type(system, PolynomialSystem, place, "a nag.PolynomialSystem: nag.system(equations)")


def check_component(system: Any, component: Any, place: str = "component") -> None:
    """Make sure that a component of a system is given.

    Raises:
        ValueError: if something else is, or the component has another number of variables.
    """
    check_system(system)
    check_type(component, WitnessSet, place, "one of the components of a nag.Decomposition")
    if component.points.shape[1] != system.n:
        raise NagError(
            f"{place}: it has {component.points.shape[1]} coordinates, and system has "
            f"{system.n} variables; give the system that it is a component of"
        )


def check_decomposition(decomposition: Any) -> None:
    """Make sure that a decomposition is given.

    Raises:
        ValueError: if something else is.
    """
    advice = "what nag.decompose returns"
    check_type(decomposition, Decomposition, "decomposition", advice)


def check_index(value: Any, place: str, count: int) -> None:
    """Make sure that an argument is the index of one of so many components.

    Raises:
        ValueError: if it is not.
    """
    check_whole(value, place)
    if value >= count:
        raise NagError(f"{place}: {value} is no index; there are {count} components, from 0 on")


def in_doubles(point: Any, variables: Sequence[str]) -> np.ndarray:
    """A point as complex doubles, shape ``(n,)``.

    Raises:
        ValueError: if there are more or fewer than variables, or one is no finite number.
    """
    return round_point(coordinates(point, variables))


def round_point(entries: Sequence[Any]) -> np.ndarray:
    """Exact or complex numbers as complex doubles, shape ``(n,)``."""
    return np.array(
        [complex(float(x)) if isinstance(x, Surd | Irrational) else complex(x) for x in entries]
    )
