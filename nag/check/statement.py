"""Statements of the papers and what becomes of them when they are tested."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any

from nag.algebra.groebner import UnfinishedBasis
from nag.numerics.read_only import Several, equal_values
from nag.text.table import data_frame, label_lines, named_line, printable

if TYPE_CHECKING:
    import pandas

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
    """A statement and what became of it.

    Attributes:
        place, text, misprint: as of the `Statement`.
        verdict: what was found.
    """

    place: str
    text: str
    misprint: bool
    verdict: Verdict

    @classmethod
    def of(cls, statement: Statement, verdict: Verdict) -> DecidedStatement:
        """The statement with its answer."""
        return cls(statement.place, statement.text, statement.misprint, verdict)

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
        return self.misprint and self.verdict.kind is VerdictKind.FAILS

    @property
    def is_as_expected(self) -> bool:
        """Whether it is decided, and a failure is one of the known misprints."""
        if self.verdict.kind is VerdictKind.OPEN:
            return False
        return (self.verdict.kind is VerdictKind.FAILS) == self.misprint

    def row(self) -> tuple[str, str]:
        """The answer; place, text, and what the answer rests on."""
        text = f"{self.place}: {self.text} [{self.verdict.how}]"
        if self.verdict.counterexample:
            text += f"; counterexample: {self.verdict.counterexample}"
        return self.label, printable(text)

    def document(self) -> dict[str, Any]:
        """The statement and its answer as a JSON object."""
        return {
            "place": self.place,
            "text": self.text,
            "misprint": self.misprint,
            "verdict": str(self.verdict.kind),
            "how": self.verdict.how,
            "counterexample": self.verdict.counterexample,
            "digits": self.verdict.digits,
        }


@dataclass(frozen=True, eq=False)
class CheckedStatements(Several[DecidedStatement]):
    """Statements of the papers, tested, under the titles of what they are about.

    Attributes:
        sections: title and statements of each.
    """

    sections: tuple[tuple[str, tuple[DecidedStatement, ...]], ...]

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[DecidedStatement, ...]:
        """All statements."""
        return tuple(one for _, rows in self.sections for one in rows)

    @property
    def complete(self) -> bool:
        """Whether each is decided, and what fails is a known misprint."""
        return all(one.is_as_expected for one in self.entries)

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each statement.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        names = ("place", "text", "verdict", "how", "counterexample", "misprint")
        rows = [one.document() for one in self.entries]
        return data_frame({name: [row[name] for row in rows] for name in names})

    def lines(self) -> list[str]:
        """Titles and statements, line by line."""
        return [line for title, rows in self.sections for line in section_lines(title, rows)]

    def document(self) -> dict[str, Any]:
        """The statements as a JSON object, without its head."""
        return {
            "complete": self.complete,
            "sections": [
                {"title": title, "statements": [one.document() for one in rows]}
                for title, rows in self.sections
            ],
        }

    def __repr__(self) -> str:
        return named_line(self, f": {summary(self.entries)}")

    def __str__(self) -> str:
        return "\n".join([*self.lines(), summary(self.entries)])


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
