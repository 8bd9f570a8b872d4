"""Answers of `solve` and `decompose`, and how they stand to what is known exactly."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from statistics import median

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.timed_runs import Run
from nag.bench.zero_set import Components, ZeroSet
from nag.decomposition.components import decompose
from nag.solving.solve import solve

METHODS = ("solve", "decompose")
VERDICTS = ("right", "incomplete", "slow", "wrong", "error")


@dataclass(frozen=True)
class Answer:
    """What was found, whether it is said to be all, what is said beside, and counts of facts."""

    method: str
    components: Components
    complete: bool
    notes: str = ""
    facts: Counter[str] = field(default_factory=Counter)


def answered(
    method: str,
    system: PolynomialSystem,
    seed: int = 0,
    settings: str = "default",
    symmetries: Sequence[SignedPermutation] = (),
) -> Answer:
    """The answer of ``"solve"``, which has isolated zeros only, or of ``"decompose"``."""
    found: Components = Counter()
    if method == "solve":
        result = solve(system, seed=seed, settings=settings)
        found.update((0, 1, s.multiplicity) for s in result.solutions)
        return Answer(method, found, result.complete, f"{result.paths} {'; '.join(result.notes)}")
    answer = decompose(system, seed=seed, settings=settings, symmetries=symmetries)
    for c in answer.components:
        found[c.dimension, c.degree, c.multiplicity] += c.orbit
    notes = [*answer.notes, *sorted({c.note for c in answer.components if c.note})]
    return Answer(method, found, answer.complete, f"{answer.paths} {'; '.join(notes)}")


def agrees(answer: Answer, truth: ZeroSet) -> bool:
    """Whether the answer is the truth, as far as its method looks for it."""
    if answer.method == "solve" and truth.dimension is None:
        return ZeroSet.of(answer.components).points == truth.points
    return truth.agrees(answer.components) and answer.facts == truth.facts


def verdict(run: Run, truth: ZeroSet | None) -> str | None:
    """One of `VERDICTS`; None for a complete answer where the truth is not known.

    Wrong is only what is called complete and is not so.
    """
    if run.value is None:
        return "error" if run.error else "slow"
    if not run.value.complete:
        return "incomplete"
    if truth is None:
        return None
    return "right" if agrees(run.value, truth) else "wrong"


def in_words(components: Components, facts: Counter[str] | None = None) -> str:
    """Like "3 isolated, 1 isolated mult 2, 1 of dim 1 deg 4"."""
    parts = []
    for (dimension, degree, multiplicity), count in sorted(components.items()):
        kind = f"{count} isolated" if dimension == 0 else f"{count} of dim {dimension} deg {degree}"
        parts.append(kind + (f" mult {multiplicity}" if multiplicity != 1 else ""))
    parts += [f"{count} {text}" for text, count in sorted((facts or {}).items())]
    return ", ".join(parts) or "empty"


def known(truth: ZeroSet | None, method: str) -> str:
    """What should have been found, in words."""
    if truth is None:
        return "not known"
    if truth.dimension is not None:
        return f"of dimension {truth.dimension}"
    if method != "solve" and truth.components is not None:
        return in_words(truth.components, truth.facts)
    text = in_words(Counter({(0, 1, k): count for k, count in truth.points.items()}))
    if method == "decompose":
        sums = (f"degrees in dim {d} mult {m}: {s}" for (d, m), s in sorted(truth.degrees.items()))
        text = "; ".join([text, *sums])
    return text


def described(run: Run, truth: ZeroSet | None) -> str:
    """What a run gave beside what is known, in one line."""
    if run.value is None:
        return run.error or f"ended after {run.seconds:g} s"
    notes = f" ({run.value.notes})" if not run.value.complete else ""
    found = in_words(run.value.components, run.value.facts)
    return f"{found}; known: {known(truth, run.value.method)}{notes}"


def summary(counts: Counter[str], seconds: Sequence[float]) -> str:
    """Counts of verdicts, and the median and largest processor time."""
    kinds = [*VERDICTS, *sorted(set(counts) - set(VERDICTS))]
    text = ", ".join(f"{counts[kind]} {kind}" for kind in kinds if counts[kind])
    return f"{text}; median {median(seconds):.3f} s, largest {max(seconds):.2f} s"
