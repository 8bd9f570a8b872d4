"""What an export says, field by field, and what is proved of it.

A certificate is about each statement of an export: it proves it, refutes it, or says that nothing
was done about it. Fields are named as in the JSON Schemas of `nag.files`, with ``[]`` for entries
of lists.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum


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


# Statements that stand like that leave nothing to be said against an export.
GOOD = Standing.PROVED, Standing.EVIDENCE, Standing.UNSEEN


@dataclass(frozen=True)
class Claim:
    """A statement of an export.

    Attributes:
        field: where it stands.
        text: what is said, in words.
        standing: what is known of it.
    """

    field: str
    text: str
    standing: Standing


def claims_of_each(
    field: str, text: str, standings: Sequence[Standing], what: str, offset: int = 1
) -> list[Claim]:
    """What is said of each of several things, by how it stands.

    Args:
        text: what is said of each; what: the name of one of the things; offset: the number that
            the first of them has.
    """
    claims = []
    for standing in Standing:
        places = [i for i, each in enumerate(standings) if each is standing]
        if places:
            first = f"{what} {places[0] + offset}"
            more = f" and {len(places) - 1} more" if len(places) > 1 else ""
            claims.append(Claim(field, f"{text}: {first}{more}", standing))
    return claims


def unseen(fields: Iterable[str], text: str) -> list[Claim]:
    """Statements that nothing is done about, with the reason."""
    return [Claim(field, text, Standing.UNSEEN) for field in fields]


def nothing_against(claims: Iterable[Claim]) -> bool:
    """Whether no statement is refuted, doubted, or left open."""
    return all(claim.standing in GOOD for claim in claims)
