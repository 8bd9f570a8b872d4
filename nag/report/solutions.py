"""The answer to ``nag solve`` as text."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from nag.report.table import align, labelled, magnitude, printable, system_line

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.model import Model
    from nag.solving.solutions import Solution, SolveResult

# Longer lists are left to the export.
MOST_ROWS = 40


def solution_lines(
    result: SolveResult, case: Case, model: Model | None, seconds: float
) -> list[str]:
    """The whole answer, line by line."""
    head = [("system", system_line(result.system)), ("answer", answer_text(result))]
    if model is not None:
        head.insert(0, ("model", printable(f"formulation {model.formulation}: {model.reason}")))
    if not result.complete:
        head.append(("", "INCOMPLETE, see below"))
    paths = result.paths
    tail = [("note", printable(note)) for note in result.notes]
    tail += [
        ("start", result.reason),
        (
            "paths",
            f"{paths.tracked} tracked, {paths.regular} regular, {paths.singular} singular, "
            f"{paths.at_infinity} to infinity, {paths.failed} failed, {paths.steps} steps",
        ),
        ("run", f"seed {result.seed}, settings {result.settings}, {seconds:.2f} s"),
    ]
    known = agreement_text(result, case, model)
    if known:
        tail.append(("known", printable(known)))
    width = max(len(label) for label, _ in head + tail)
    table = solution_table(result)
    return [
        printable(case.title),
        "",
        *labelled(head, width),
        "",
        *([*table, ""] if table else []),
        *labelled(tail, width),
    ]


def answer_text(result: SolveResult) -> str:
    """The answer in one sentence."""
    count, real = len(result.solutions), len(result.real)
    text = f"{count} isolated solution{'' if count == 1 else 's'}, {real} real"
    multiple = Counter(s.multiplicity for s in result.solutions if s.multiplicity > 1)
    for multiplicity, number in sorted(multiple.items()):
        text += f", {number} of multiplicity {multiplicity}"
    if result.excluded:
        text += f"; {result.excluded} more excluded, where a polynomial that must not vanish does"
    if result.positive_dimensional:
        text += "; and a solution set of positive dimension"
    return text


def solution_table(result: SolveResult) -> list[str]:
    """One row a solution, the real ones first."""
    if not result.solutions:
        return []
    ordered = sorted(range(len(result.solutions)), key=lambda i: not result.solutions[i].real)
    names = result.system.variables
    wide = len(names) > 4
    head = ["solution", *names[: 4 if wide else None], *(["..."] if wide else [])]
    head += ["multiplicity", "real", "residual", "condition", "digits"]
    rows = [head]
    for i in ordered[:MOST_ROWS]:
        s = result.solutions[i]
        cells = [number_text(z, s) for z in s.point[: 4 if wide else None]]
        rows.append(
            [
                str(i + 1),
                *cells,
                *(["..."] if wide else []),
                str(s.multiplicity),
                "yes" if s.real else "no",
                magnitude(s.residual),
                magnitude(s.condition),
                str(s.precision),
            ]
        )
    lines = align(rows)
    if len(ordered) > MOST_ROWS:
        lines.append(f"and {len(ordered) - MOST_ROWS} more; --json FILE writes all of them")
    return lines


def number_text(z: complex, solution: Solution) -> str:
    """A coordinate to six digits; parts below the point's accuracy are left out."""
    floor = max(1e-12, 1e2 * solution.accuracy) * (1 + float(abs(solution.point).max()))
    real = 0.0 if abs(z.real) < floor else float(z.real)
    if solution.real or abs(z.imag) < floor:
        return f"{real:.6g}"
    return f"{real:.6g}{z.imag:+.6g}i"


def agreement_text(result: SolveResult, case: Case, model: Model | None) -> str:
    """The answer beside what the case file knows of isolated points; empty if it knows nothing."""
    formulation = model.formulation if model else None
    known = [t for t in case.truth if t.dimension == 0 and t.formulation in (None, formulation)]
    if not known:
        return ""
    wanted: Counter[int] = Counter()
    for item in known:
        wanted[item.multiplicity] += item.count
    found = Counter(s.multiplicity for s in result.solutions)
    sources = "; ".join(dict.fromkeys(t.source for t in known if t.source))

    def words(counts: Counter[int]) -> str:
        return ", ".join(
            f"{k} simple" if m == 1 else f"{k} of multiplicity {m}"
            for m, k in sorted(counts.items())
        )

    if found == wanted:
        return f"agrees with what is known: {words(wanted)} ({sources})"
    return f"differs from what is known: {words(wanted)} ({sources}); found: {words(found)}"
