"""Statements of the papers and what becomes of them when they are tested."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from nag.algebra.groebner import UnfinishedBasis
from nag.text.table import label_lines, printable

ERRATA = "cases/ERRATA.md"


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


@dataclass(frozen=True)
class DecidedStatement:
    """A statement and what became of it."""

    statement: Statement
    verdict: Verdict

    @property
    def label(self) -> str:
        """The answer in a few words."""
        if self.verdict.digits is not None:
            return f"holds to {self.verdict.digits} digits"
        if self.is_known_misprint:
            return "fails, misprint"
        return str(self.verdict.kind)

    @property
    def is_known_misprint(self) -> bool:
        """Whether it fails, as `ERRATA` says."""
        return self.statement.misprint and self.verdict.kind is VerdictKind.FAILS

    @property
    def is_as_expected(self) -> bool:
        """Whether it is decided, and a failure is one of the known misprints."""
        if self.verdict.kind is VerdictKind.OPEN:
            return False
        return (self.verdict.kind is VerdictKind.FAILS) == self.statement.misprint

    def row(self) -> tuple[str, str]:
        """The answer; place, text, and what the answer rests on."""
        text = f"{self.statement.place}: {self.statement.text} [{self.verdict.how}]"
        if self.verdict.counterexample:
            text += f"; counterexample: {self.verdict.counterexample}"
        return self.label, printable(text)

    def document(self) -> dict[str, Any]:
        """The statement and its answer as a JSON object."""
        return {
            "place": self.statement.place,
            "text": self.statement.text,
            "misprint": self.statement.misprint,
            "verdict": str(self.verdict.kind),
            "how": self.verdict.how,
            "counterexample": self.verdict.counterexample,
            "digits": self.verdict.digits,
        }


def summary(decided: Sequence[DecidedStatement]) -> str:
    """Counts of the answers."""
    kinds = [one.verdict.kind for one in decided]
    known = sum(one.is_known_misprint for one in decided)
    parts = [
        f"{kinds.count(VerdictKind.EXACT)} hold exactly",
        f"{kinds.count(VerdictKind.NUMERICAL)} hold numerically",
        f"{known} fail as {ERRATA} says",
    ]
    unknown = kinds.count(VerdictKind.FAILS) - known
    if unknown:
        parts.append(f"{unknown} fail and are not in {ERRATA}")
    if kinds.count(VerdictKind.OPEN):
        parts.append(f"{kinds.count(VerdictKind.OPEN)} are not decided")
    return f"{len(decided)} statements: {', '.join(parts)}"


def section_lines(title: str, decided: Sequence[DecidedStatement]) -> list[str]:
    """A title and its statements."""
    lines = label_lines([one.row() for one in decided], len("holds numerically"))
    return [printable(title), "", *lines, ""]


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
