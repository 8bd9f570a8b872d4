"""The papers' statements and what became of them, as text."""

from __future__ import annotations

from collections.abc import Sequence

from nag.check.statement import Statement, Verdict, VerdictKind
from nag.text.table import label_lines, printable

Decided = tuple[Statement, Verdict]
ERRATA = "cases/ERRATA.md"


def label(statement: Statement, verdict: Verdict) -> str:
    """The answer in a few words."""
    if verdict.digits is not None:
        return f"holds to {verdict.digits} digits"
    if verdict.kind is VerdictKind.FAILS and statement.misprint:
        return "fails, misprint"
    return str(verdict.kind)


def statement_rows(decided: Sequence[Decided]) -> list[tuple[str, str]]:
    """One row a statement: answer; place, text, and what the answer rests on."""
    rows = []
    for statement, verdict in decided:
        text = f"{statement.place}: {statement.text} [{verdict.how}]"
        if verdict.counterexample:
            text += f"; counterexample: {verdict.counterexample}"
        rows.append((label(statement, verdict), printable(text)))
    return rows


def is_as_expected(statement: Statement, verdict: Verdict) -> bool:
    """Whether a statement is decided, and a failure is one of the known misprints."""
    if verdict.kind is VerdictKind.OPEN:
        return False
    return (verdict.kind is VerdictKind.FAILS) == statement.misprint


def summary(decided: Sequence[Decided]) -> str:
    """Counts of the answers."""
    kinds = [verdict.kind for _, verdict in decided]
    known = sum(s.misprint and v.kind is VerdictKind.FAILS for s, v in decided)
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


def section(title: str, decided: Sequence[Decided]) -> list[str]:
    """A title and its statements."""
    return [
        printable(title),
        "",
        *label_lines(statement_rows(decided), len("holds numerically")),
        "",
    ]
