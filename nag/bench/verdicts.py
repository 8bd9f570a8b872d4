"""Answers of `solve` and `decompose`, and how they stand to the zero set that is known exactly."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from statistics import median

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.timed_runs import TimedRun
from nag.decomposition.decompose import decompose
from nag.solving.solve import solve

# Components by dimension, degree and multiplicity.
Components = Counter[tuple[int, int, int]]


@dataclass(frozen=True)
class ZeroSet:
    """The zero set of a system, as a scheme.

    Attributes:
        points: isolated zeros by multiplicity.
        degrees: by dimension, above 0, and multiplicity, the sum of the components' degrees.
        components: all components, isolated zeros included, or None where only the sums of their
            degrees are known.
        facts: what else is known, in words, each with how often it is so.
        dimension: where it is not None, nothing but the dimension is known; -1 for the empty set.
    """

    points: Counter[int] = field(default_factory=Counter)
    degrees: Counter[tuple[int, int]] = field(default_factory=Counter)
    components: Components | None = None
    dimension: int | None = None
    facts: Counter[str] = field(default_factory=Counter)

    @classmethod
    def of(cls, components: Components, facts: Counter[str] | None = None) -> ZeroSet:
        """The zero set that has these components, and of which these facts are known."""
        points: Counter[int] = Counter()
        degrees: Counter[tuple[int, int]] = Counter()
        for (dimension, degree, multiplicity), count in components.items():
            if dimension:
                degrees[dimension, multiplicity] += count * degree
            else:
                points[multiplicity] += count
        return cls(points, degrees, Counter(components), facts=Counter(facts or {}))

    def agrees(self, components: Components) -> bool:
        """Whether these are the components, as far as is known here."""
        if self.dimension is not None:
            return self.dimension == max((key[0] for key in components), default=-1)
        if self.components is not None:
            return self.components == components
        found = ZeroSet.of(components)
        return (self.points, self.degrees) == (found.points, found.degrees)


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


def compute_answer(
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
        found[c.dimension, c.degree, c.multiplicity or 0] += c.orbit
    notes = [*answer.notes, *sorted({c.note for c in answer.components if c.note})]
    return Answer(method, found, answer.complete, f"{answer.paths} {'; '.join(notes)}")


def agrees(answer: Answer, truth: ZeroSet) -> bool:
    """Whether the answer is the truth, as far as its method looks for it."""
    if answer.method == "solve" and truth.dimension is None:
        return ZeroSet.of(answer.components).points == truth.points
    return truth.agrees(answer.components) and answer.facts == truth.facts


def verdict(run: TimedRun, truth: ZeroSet | None) -> str | None:
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


def components_text(components: Components, facts: Counter[str] | None = None) -> str:
    """Like "3 isolated, 1 isolated mult 2, 1 of dim 1 deg 4"."""
    parts = []
    for (dimension, degree, multiplicity), count in sorted(components.items()):
        kind = f"{count} isolated" if dimension == 0 else f"{count} of dim {dimension} deg {degree}"
        parts.append(kind + (f" mult {multiplicity}" if multiplicity != 1 else ""))
    parts += [f"{count} {text}" for text, count in sorted((facts or {}).items())]
    return ", ".join(parts) or "empty"


def known_text(truth: ZeroSet | None, method: str) -> str:
    """What should have been found, in words."""
    if truth is None:
        return "not known"
    if truth.dimension is not None:
        return f"of dimension {truth.dimension}"
    if method != "solve" and truth.components is not None:
        return components_text(truth.components, truth.facts)
    text = components_text(Counter({(0, 1, k): count for k, count in truth.points.items()}))
    if method == "decompose":
        sums = (f"degrees in dim {d} mult {m}: {s}" for (d, m), s in sorted(truth.degrees.items()))
        text = "; ".join([text, *sums])
    return text


def describe_run(run: TimedRun, truth: ZeroSet | None) -> str:
    """What a run gave beside what is known, in one line."""
    if run.value is None:
        return run.error or f"ended after {run.seconds:g} s"
    notes = f" ({run.value.notes})" if not run.value.complete else ""
    found = components_text(run.value.components, run.value.facts)
    return f"{found}; known: {known_text(truth, run.value.method)}{notes}"


def summary(counts: Counter[str], seconds: Sequence[float]) -> str:
    """Counts of verdicts, and the median and largest processor time."""
    kinds = [*VERDICTS, *sorted(set(counts) - set(VERDICTS))]
    text = ", ".join(f"{counts[kind]} {kind}" for kind in kinds if counts[kind])
    return f"{text}; median {median(seconds):.3f} s, largest {max(seconds):.2f} s"
