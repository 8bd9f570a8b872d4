"""An answer beside what a case says is known: components, or the reference configuration."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from nag.witness.shown import ComponentKind, flat, kinds, kinds_text
from nag.witness.witness import Decomposition, Status

if TYPE_CHECKING:
    from nag.files.cases import Truth, TruthAtReference
    from nag.mechanism.mobility_report import MobilityReport


class AgreementKind(StrEnum):
    """How an answer stands to what is known."""

    AGREES = "agrees"
    OPEN = "agrees as far as it is decided"
    DIFFERS = "differs"


@dataclass(frozen=True)
class Agreement:
    """Outcome of a comparison.

    Attributes:
        verdict: whether the answer agrees.
        confirmed: what is known and was found.
        missing: what is known and was not found.
        surplus: what was found, in a dimension that the known list covers, and is not known.
        unlisted: what was found in dimensions of which nothing is known.
        undecided: number of components that are undecided.
        sources: where the known things come from.
    """

    verdict: AgreementKind
    confirmed: Counter[ComponentKind]
    missing: Counter[ComponentKind]
    surplus: Counter[ComponentKind]
    unlisted: Counter[ComponentKind]
    undecided: int
    sources: tuple[str, ...]


def compare(
    decomposition: Decomposition, truth: Iterable[Truth], formulation: str | None = None
) -> Agreement | None:
    """Compare with what is known for the system's formulation; None if nothing is.

    Known things that name another formulation are left out. The known list is taken to be
    complete in every dimension that it mentions; of other dimensions it says nothing. Only
    components that are decided are compared.
    """
    known = [t for t in truth if t.formulation is None or t.formulation == formulation]
    if not known:
        return None
    left = kinds(c for c in decomposition.components if c.status is Status.IRREDUCIBLE)
    undecided = sum(c.orbit for c in decomposition.components if c.status is not Status.IRREDUCIBLE)
    confirmed: Counter[ComponentKind] = Counter()
    missing: Counter[ComponentKind] = Counter()
    # The more specific statements choose first among the components that fit.
    for item in sorted(known, key=lambda t: t.multidegree is None):
        wanted = ComponentKind(
            item.dimension, item.degree, item.multiplicity, flat(item.multidegree)
        )
        due = item.count
        for found in list(left):
            fits = (found.dimension, found.degree, found.multiplicity) == (
                wanted.dimension,
                wanted.degree,
                wanted.multiplicity,
            ) and wanted.multidegree in (None, found.multidegree)
            taken = min(due, left[found]) if fits else 0
            left[found] -= taken
            due -= taken
        confirmed[wanted] += item.count - due
        missing[wanted] += due
    covered = {item.dimension for item in known}
    surplus = Counter({k: n for k, n in left.items() if n and k.dimension in covered})
    unlisted = Counter({k: n for k, n in left.items() if n and k.dimension not in covered})
    if surplus or (missing.total() and not undecided):
        verdict = AgreementKind.DIFFERS
    else:
        verdict = AgreementKind.OPEN if missing.total() or undecided else AgreementKind.AGREES
    return Agreement(
        verdict=verdict,
        confirmed=+confirmed,
        missing=+missing,
        surplus=surplus,
        unlisted=unlisted,
        undecided=undecided,
        sources=tuple(dict.fromkeys(item.source for item in known)),
    )


def agreement_text(agreement: Agreement) -> str:
    """The comparison as one sentence."""
    confirmed, missing = kinds_text(agreement.confirmed), kinds_text(agreement.missing)
    sources = f" ({'; '.join(agreement.sources)})" if any(agreement.sources) else ""
    if agreement.verdict is AgreementKind.AGREES:
        text = f"agrees with what is known: {confirmed}"
    elif agreement.verdict is AgreementKind.OPEN:
        text = f"agrees with what is known as far as it is decided: {confirmed}"
        if agreement.missing:
            text += f"; known but not decided here: {missing}"
    else:
        parts = []
        if agreement.missing:
            parts.append(f"not found: {missing}")
        if agreement.surplus:
            parts.append(f"found but not known: {kinds_text(agreement.surplus)}")
        text = f"differs from what is known: {'; '.join(parts)}"
    if agreement.unlisted:
        text += f"; nothing is known of: {kinds_text(agreement.unlisted)}"
    return text + sources


def compare_at_reference(report: MobilityReport, known: TruthAtReference) -> AgreementKind:
    """Compare the dimensions at a reference configuration with those that are known."""
    pairs = (
        (report.local_dimension, known.dimension),
        (report.tangent_dimension, known.tangent_dimension),
    )
    if any(found is not None and found != wanted for found, wanted in pairs):
        return AgreementKind.DIFFERS
    decided = all(found is not None for found, _ in pairs)
    return AgreementKind.AGREES if decided else AgreementKind.OPEN


def reference_text(verdict: AgreementKind, known: TruthAtReference) -> str:
    """That comparison as one sentence."""
    text = {
        AgreementKind.AGREES: "agrees with what is known",
        AgreementKind.OPEN: "agrees with what is known as far as it is decided",
        AgreementKind.DIFFERS: "differs from what is known",
    }[verdict]
    return (
        f"{text}: tangent dimension {known.tangent_dimension}, local dimension {known.dimension} "
        f"({known.source})"
    )
