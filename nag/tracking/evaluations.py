"""Evaluations of systems, counted for who asks.

One is the values of all rows at a point, with or without their Jacobian, in whatever arithmetic, or
the rows' Taylor coefficients of one order.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextvars import ContextVar
from dataclasses import dataclass

# What an evaluation in so many doubles to a number takes, beside one in doubles, of which eight are
# made at once.
WEIGHTS = {1: 1, 2: 25, 4: 150, 8: 800}
# The same of a proof, in balls, that a path's end is a regular zero; and of making the arrays of a
# system ready for one arithmetic.
PROOF, PREPARATION = 20_000, 40_000
# The same of a regular zero that Newton's method finds in balls.
ZERO = 7_000


@dataclass
class Evaluations:
    """How many there were.

    Attributes:
        work: the same, those in more digits counted as so many in doubles as they take the time of,
            and proofs of ends as well.
        once: the same of what is done once for all paths.
    """

    number: int = 0
    work: int = 0
    once: int = 0


_counting: ContextVar[Evaluations | None] = ContextVar("counting", default=None)


@contextlib.contextmanager
def count_evaluations() -> Iterator[Evaluations]:
    """Count the evaluations of all paths that are tracked inside the block.

    Whoever counts outside of it counts them as well.
    """
    found = Evaluations()
    token = _counting.set(found)
    try:
        yield found
    finally:
        _counting.reset(token)
        outer = _counting.get()
        if outer is not None:
            outer.number += found.number
            outer.work += found.work
            outer.once += found.once


def count(number: int, words: int = 1) -> None:
    """Add to the number, if someone counts.

    Args:
        words: how many doubles the numbers were sums of.
    """
    found = _counting.get()
    if found is not None:
        found.number += int(number)
        found.work += int(number) * WEIGHTS[words]


def count_proof() -> None:
    """Add the work of a proof that an end is a regular zero, if someone counts."""
    found = _counting.get()
    if found is not None:
        found.work += PROOF


def count_zero() -> None:
    """Add the work of finding a regular zero in balls, if someone counts."""
    found = _counting.get()
    if found is not None:
        found.once += ZERO


def count_preparation() -> None:
    """Add the work of making a system's arrays ready for one arithmetic, if someone counts."""
    found = _counting.get()
    if found is not None:
        found.once += PREPARATION


def count_known(number: int, work: int) -> None:
    """Add evaluations that were counted elsewhere, if someone counts."""
    found = _counting.get()
    if found is not None:
        found.number += number
        found.work += work
