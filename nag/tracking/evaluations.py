"""Evaluations of systems, counted for who asks.

One is the values of all rows at a point, with or without their Jacobian, in whatever arithmetic, or
the rows' Taylor coefficients of one order.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass
class Evaluations:
    """How many there were."""

    number: int = 0


_counting: ContextVar[Evaluations | None] = ContextVar("counting", default=None)


@contextlib.contextmanager
def count_evaluations() -> Iterator[Evaluations]:
    """Count the evaluations of all paths that are tracked inside the block."""
    found = Evaluations()
    token = _counting.set(found)
    try:
        yield found
    finally:
        _counting.reset(token)


def count(number: int) -> None:
    """Add to the number, if someone counts."""
    found = _counting.get()
    if found is not None:
        found.number += int(number)
