"""What an export says, field by field, and what is proved of it.

A certificate is about each statement of an export: it proves it, refutes it, or says that nothing
was done about it. Fields are named as in the JSON Schemas of `nag.files`, with ``[]`` for entries
of lists.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from nag.algebra.zero_count import Completeness, ZeroCount, judge_number
from nag.text.table import printable


class Standing(StrEnum):
    """How a statement stands.

    `PROVED`: it is true. `EVIDENCE`: numbers vanish, or agree, to so many digits, or modulo so many
    primes, that it is hardly false. `REFUTED`: it is proved to be false. `DOUBTED`: it is false by
    such evidence. `OPEN`: it was tried and came to nothing. `UNSEEN`: it was not looked at.
    """

    PROVED = "proved"
    EVIDENCE = "on evidence"
    REFUTED = "refuted"
    DOUBTED = "refuted by evidence"
    OPEN = "not decided"
    UNSEEN = "not looked at"


# What stands before statements that are not true, or not known to be.
LABELS = {Standing.REFUTED: "refuted", Standing.DOUBTED: "doubt", Standing.OPEN: "open"}
# The head of the document of a certificate.
CERTIFICATE = {"format": "nag-certificate", "version": 1}
# Statements that stand like that leave nothing to be said against an export.
GOOD = Standing.PROVED, Standing.EVIDENCE, Standing.UNSEEN
# Entries of a list that are named, of more the first ones.
NAMED = 3


@dataclass(frozen=True)
class Claim:
    """A statement of an export.

    Attributes:
        field: where it stands.
        text: what is said, in words.
        standing: what is known of it.
        subject: the entries of lists that it is about, numbered from 1; empty for the whole file.
        record: whether it says what was asked, or how that was worked out: no proof is about it.
    """

    field: str
    text: str
    standing: Standing
    subject: str = ""
    record: bool = False

    def __str__(self) -> str:
        """Whose statement it is, what it says, and the field where it stands."""
        if not self.subject:
            return f"{self.field}: {self.text}"
        return f"{self.subject}: {self.text} ({self.field})"

    def document(self) -> dict[str, Any]:
        """The statement as a JSON object."""
        return {
            "field": self.field,
            "of": self.subject,
            "says": self.text,
            "standing": str(self.standing),
        }


def name_entries(what: str, places: Sequence[int]) -> str:
    """Entries of a list of things, from their indices.

    >>> name_entries("point", [2]), name_entries("point", [0, 1, 2, 3, 4])
    ('point 3', 'points 1, 2, 3 and 2 more')
    """
    numbers = [str(i + 1) for i in places]
    if len(numbers) == 1:
        return f"{what} {numbers[0]}"
    first, more = numbers[:NAMED], len(numbers) - NAMED
    last = f"{more} more" if more > 0 else first.pop()
    return f"{what}s {', '.join(first)} and {last}"


def claims_of_each(
    field: str, text: str | Sequence[str], standings: Sequence[Standing], what: str
) -> list[Claim]:
    """What is said of each of several things, by how it stands.

    Args:
        text: what is said of all, or of each; what: the name of one of the things.
    """
    texts = [text] * len(standings) if isinstance(text, str) else text
    claims = []
    for standing in Standing:
        places: dict[str, list[int]] = {}
        for i, (each, said) in enumerate(zip(standings, texts, strict=True)):
            if each is standing:
                places.setdefault(said, []).append(i)
        claims += [
            Claim(field, said, standing, name_entries(what, own)) for said, own in places.items()
        ]
    return claims


def claim_of_all(
    field: str, text: str, standings: Sequence[Standing], subject: str, what: str
) -> Claim:
    """What is said of several parts of one thing; of which it is not known to be true.

    Args:
        subject: the thing; what: the name of one of its parts.
    """
    standing = combine_standings(standings)
    if standing not in GOOD:
        places = [i for i, each in enumerate(standings) if each is standing]
        text = f"{text}: {name_entries(what, places)}"
    return Claim(field, text, standing, subject)


def claim_of_number(
    text: str, listed: int, count: ZeroCount | None, imaginary: bool = False
) -> Claim | None:
    """That so many zeros, by their multiplicities, are all, as a count says; None if it does not.

    Args:
        count: modulo two primes.
        imaginary: whether the system has the imaginary unit, so that the zeros of its conjugate
            system are counted as well.
    """
    sides = 1 + imaginary
    verdict = judge_number(sides * listed, count)
    if count is None or verdict is Completeness.UNKNOWN:
        return None
    text = f"{text}: {count.bound // sides} zeros are counted modulo two primes"
    if verdict is Completeness.ALL:
        return Claim("complete", text, Standing.EVIDENCE)
    return Claim("complete", f"{text}, {listed} are listed", Standing.DOUBTED)


def combine_standings(standings: Sequence[Standing]) -> Standing:
    """How it stands that all of some statements are true."""
    order = (
        Standing.REFUTED,
        Standing.DOUBTED,
        Standing.OPEN,
        Standing.UNSEEN,
        Standing.EVIDENCE,
        Standing.PROVED,
    )
    return next((each for each in order if each in standings), Standing.PROVED)


def claims_not_looked_at(fields: Iterable[str], text: str, subject: str = "") -> list[Claim]:
    """Statements that nothing is done about, with the reason."""
    return [Claim(field, text, Standing.UNSEEN, subject) for field in fields]


def records(fields: Iterable[str], text: str, subject: str = "") -> list[Claim]:
    """What a file tells of the question and of the run, with what that is."""
    return [Claim(field, text, Standing.UNSEEN, subject, record=True) for field in fields]


def nothing_against(claims: Iterable[Claim]) -> bool:
    """Whether no statement is refuted, doubted, or left open."""
    return all(claim.standing in GOOD for claim in claims)


def standing_of_field(claims: Iterable[Claim], field: str) -> Standing:
    """How it stands that all is true that is said in a field."""
    return combine_standings([claim.standing for claim in claims if claim.field == field])


def claims_rows(claims: Iterable[Claim]) -> list[tuple[str, str]]:
    """How the statements of an export stand that are not proved, as labelled lines."""
    claims = list(claims)
    rows = [
        (label, f"{c}{', by evidence' if standing is Standing.DOUBTED else ''}")
        for standing, label in LABELS.items()
        for c in claims
        if c.standing is standing
    ]
    kinds = (
        ("evidence", "by evidence only: ", Standing.EVIDENCE, False),
        ("unproved", "neither proved nor refuted here: ", Standing.UNSEEN, False),
        ("records", "what was asked and how it was worked out: ", Standing.UNSEEN, True),
    )
    for label, what, standing, record in kinds:
        fields = [c.field for c in claims if c.standing is standing and c.record is record]
        if fields:
            rows.append((label, what + _fields_text(fields)))
    return [(label, printable(text)) for label, text in rows]


def _fields_text(fields: Iterable[str]) -> str:
    """Fields, each once, those of entries of a list together.

    >>> _fields_text(["a[].x", "b", "a[].y", "a[].x"])
    'b; of each of a: x, y'
    """
    lists: dict[str, list[str]] = {}
    for field in dict.fromkeys(fields):
        of, _, name = field.rpartition("[].")
        lists.setdefault(of, []).append(name)
    alone = [", ".join(lists.pop(""))] if "" in lists else []
    return "; ".join([*alone, *(f"of each of {of}: {', '.join(own)}" for of, own in lists.items())])
