"""Witness sets asked with what users have at hand: a generator, exact or rounded points."""

from __future__ import annotations

import numbers
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.from_python import exact_number, variable_indices
from nag.algebra.number import Number, is_zero
from nag.algebra.system import PolynomialSystem
from nag.witness.membership import Membership, UndecidedError, memberships
from nag.witness.sampling import sample
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

# A point that satisfies the equations so well, relative to their terms, is taken for a rounded one.
ROUNDED = 1e-9
# Relative error of an exact point that is rounded to doubles, with room for its coordinates' sums.
EXACT = 1e-12


def sampled(
    system: PolynomialSystem,
    component: WitnessSet,
    rng: np.random.Generator | int,
    count: int,
    threads: int,
    settings: str,
) -> np.ndarray:
    """Points of a component, see `WitnessSet.sample`."""
    if isinstance(count, bool) or not isinstance(count, numbers.Integral) or count < 0:
        raise ValueError(f"count: {count!r} is given; give a whole number from 0 up")
    if isinstance(rng, numbers.Integral) and not isinstance(rng, bool) and rng >= 0:
        seed = int(rng)
    elif isinstance(rng, np.random.Generator):
        seed = int(rng.integers(2**63))
    else:
        raise ValueError(f"rng: {rng!r} is given; give numpy.random.default_rng(), or a seed")
    found = sample(system, component, int(count), seed=seed, threads=threads, settings=settings)
    return found.points


def contains(
    system: PolynomialSystem,
    component: WitnessSet,
    point: Any,
    accuracy: float | None,
    running: Mapping[str, Any],
) -> bool:
    """Whether a point lies on a component, see `WitnessSet.contains`."""
    entries = coordinates(point, system.variables)
    at = np.array([e if isinstance(e, complex) else complex(float(e)) for e in entries])
    if not any(isinstance(e, complex) for e in entries):
        if not all(is_zero(value) for value in system(entries)):
            return False
        accuracy = EXACT
    else:
        evaluator = Evaluator.of(system.polynomials, system.n)
        residual = float(evaluator.residuals(at[None]).max(initial=0.0))
        if residual > max(ROUNDED, accuracy or 0.0):
            return False
        accuracy = max(EXACT, 10 * residual) if accuracy is None else accuracy
    alone = Decomposition(system, (component,), PathCounts(), 0, "default", (), True)
    (answer,) = memberships(alone, at, accuracy=accuracy, **running)
    if answer is Membership.UNDECIDED:
        raise UndecidedError([], [0])
    return answer is Membership.MEMBER


def coordinates(point: Any, variables: Sequence[str]) -> tuple[Number | complex, ...]:
    """A point's coordinates: exact numbers, and floats and complex numbers as complex ones.

    Raises:
        ValueError: if there are more or fewer than variables, or one is no number.
    """
    n = len(variables)
    if isinstance(point, Mapping):
        places = variable_indices(point, variables, "point")
        missing = [name for i, name in enumerate(variables) if i not in places]
        if missing:
            raise ValueError(f"point: no value for {missing[0]!r}; give one for each variable")
        by_place = dict(zip(places, point.values(), strict=True))
        values = [by_place[i] for i in range(n)]
    elif isinstance(point, Iterable) and not isinstance(point, str):
        values = list(point)
    else:
        raise ValueError(f"point: {point!r} is given; give {n} numbers, or a dict of them by name")
    if len(values) != n:
        raise ValueError(
            f"point: {len(values)} coordinates are given; there are {n} variables: "
            f"{', '.join(variables)}"
        )
    entries = [_entry(value, f"point[{i}]") for i, value in enumerate(values)]
    if not all(np.isfinite(e) for e in entries if isinstance(e, complex)):
        raise ValueError("point: not all coordinates are finite numbers")
    return tuple(entries)


def _entry(value: Any, place: str) -> Number | complex:
    if isinstance(value, float | complex | np.inexact):
        return complex(value)
    return exact_number(value, place)
