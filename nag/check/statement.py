"""Statements of the papers and what becomes of them when they are tested."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from nag.algebra.groebner import UnfinishedBasis


class VerdictKind(StrEnum):
    """What is known of a statement."""

    EXACT = "holds exactly"
    NUMERICAL = "holds numerically"
    FAILS = "fails"
    OPEN = "not decided"


@dataclass(frozen=True)
class Verdict:
    """What was found, and what that rests on.

    Attributes:
        kind: the answer.
        how: the argument or computation, in a few words; of a failure what is true instead.
        counterexample: of a failure, an exact point or value.
        digits: of a numerical answer about equations, to how many digits they hold.
    """

    kind: VerdictKind
    how: str
    counterexample: str = ""
    digits: int | None = None


@dataclass(frozen=True)
class Statement:
    """A statement of one of the papers, and the function that decides it.

    Attributes:
        place: paper and place: "T25 lemma 5.1".
        text: what is stated.
        decide: tests it.
        misprint: whether it is known to fail; then `cases/ERRATA.md` has it under `place`.
    """

    place: str
    text: str
    decide: Callable[[], Verdict]
    misprint: bool = False

    def verdict(self) -> Verdict:
        """The answer; `Kind.OPEN` if a Groebner basis grew beyond its bounds."""
        try:
            return self.decide()
        except UnfinishedBasis as error:
            return Verdict(VerdictKind.OPEN, str(error))


def statement(
    place: str, text: str, misprint: bool = False
) -> Callable[[Callable[[], Verdict]], Statement]:
    """Decorator: the function decides this statement."""

    def made(decide: Callable[[], Verdict]) -> Statement:
        return Statement(place, text, decide, misprint)

    return made


def holds(how: str) -> Verdict:
    """It holds exactly."""
    return Verdict(VerdictKind.EXACT, how)


def fails(how: str, counterexample: str) -> Verdict:
    """It fails at an exact point; ``how`` says what is true."""
    return Verdict(VerdictKind.FAILS, how, counterexample)


def decided(true: bool, how: str, otherwise: str) -> Verdict:
    """It holds exactly, or fails as ``otherwise`` says."""
    return holds(how) if true else fails("it is false", otherwise)
