"""Answers with other random numbers, where doubts are left in the first."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Protocol, TypeVar

from nag.witness.witness import PathCounts, Status, WitnessSet

# Answers that are asked for at the most, if they do not take more paths together.
ATTEMPTS = 3
MOST_PATHS = 20_000


class Judged(Protocol):
    """An answer that says what is open in it."""

    components: tuple[WitnessSet, ...]
    paths: PathCounts
    complete: bool
    notes: tuple[str, ...]


Answer = TypeVar("Answer", bound=Judged)


def least_doubtful(answers: Iterable[Answer]) -> Answer:
    """The first complete answer, or the one with the fewest doubts, with the paths of all.

    Args:
        answers: at least one; those after a complete one, or after too many paths, are not asked
            for.
    """
    known, tracked = [], 0
    for answer in answers:
        known.append(answer)
        tracked += answer.paths.tracked
        if answer.complete or tracked > MOST_PATHS:
            break
    best = min(known, key=lambda a: (not a.complete, _undecided(a), len(a.notes)))
    return replace(best, paths=replace(best.paths, tracked=tracked))


def _undecided(answer: Judged) -> int:
    return sum(c.status is Status.UNDECIDED for c in answer.components)
