"""The answer to ``nag solve`` as text."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

from nag.algebra.given import is_a
from nag.algebra.system import system_line
from nag.report.assemblies import real_rows
from nag.report.model import model_row
from nag.solving.shown import MOST_ROWS, Reality, answer_text, has_real_coordinates, solution_rows
from nag.solving.solve import METHOD_TEXTS
from nag.text.table import Row, align, sheet

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.problem import Problem
    from nag.solving.solutions import SolveResult


def solution_lines(result: SolveResult, case: Case, problem: Problem, run: Row) -> list[str]:
    """The whole answer, line by line: what was asked, and then what it rests on."""
    is_real = _reality(problem)
    head: list[Row] = [("answer", answer_text(result, is_real))]
    if not result.complete:
        head.append(("", "INCOMPLETE, see below"))
    head += real_rows(problem, result)
    paths = result.paths
    tail: list[Row] = [("note", note) for note in result.notes]
    if result.positive_dimensional:
        tail.append(("hint", "`nag decompose` finds the solution sets of positive dimension"))
    tail += [*case.note_rows, *model_row(problem), ("system", system_line(result.system))]
    if result.method in METHOD_TEXTS:
        tail.append(("method", METHOD_TEXTS[result.method]))
    tail += [
        ("start", result.reason),
        (
            "paths",
            f"{paths.tracked} tracked, {paths.regular} regular, {paths.singular} singular, "
            f"{paths.at_infinity} to infinity, {paths.failed} failed, {paths.steps} steps",
        ),
        run,
    ]
    known = agreement_text(result, case, problem)
    if known:
        tail.append(("known", known))
    return sheet(
        case.title, head, solution_table(result, is_real), realisation_table(problem, result), tail
    )


def realisations(problem: Problem, result: SolveResult) -> list[dict[str, Any]]:
    """Of a framework, the places of all points in each real realisation, with its solution."""
    parts = problem.parts
    if not is_a(parts, "nag.mechanism.framework_model", "FrameworkModel"):
        return []
    return [
        {"solution": i, "places": {p: list(x) for p, x in parts.real_places(s.point).items()}}
        for i, s in enumerate(result.solutions)
        if parts.is_real(s.point)
    ]


def realisation_table(problem: Problem, result: SolveResult) -> list[str]:
    """One row a real realisation of a framework: where its points are, in lengths."""
    found = realisations(problem, result)
    if not found:
        return []
    names = list(found[0]["places"])
    rows = [["realisation", "solution", *names]]
    for number, each in enumerate(found[:MOST_ROWS], start=1):
        places = [f"({', '.join(f'{x + 0.0:.6g}' for x in each['places'][p])})" for p in names]
        rows.append([str(number), str(each["solution"] + 1), *places])
    lines = align(rows)
    if len(found) > MOST_ROWS:
        lines.append(f"and {len(found) - MOST_ROWS} more; --json FILE writes all of them")
    return lines


def _reality(problem: Problem) -> Reality:
    """What makes a solution real: of parts, that the assembly is."""
    parts = problem.parts
    if parts is None:
        return has_real_coordinates
    return lambda solution: parts.is_real(solution.point)


def solution_table(result: SolveResult, is_real: Reality = has_real_coordinates) -> list[str]:
    """One row a solution, the real ones first."""
    if not result.solutions:
        return []
    lines = align(solution_rows(result, MOST_ROWS, 4, is_real))
    if len(result.solutions) > MOST_ROWS:
        lines.append(
            f"and {len(result.solutions) - MOST_ROWS} more; --json FILE writes all of them"
        )
    return lines


def agreement_text(result: SolveResult, case: Case, problem: Problem) -> str:
    """The answer beside what the case file knows of isolated points; empty if it knows nothing."""
    known = [t for t in case.known_in(problem.formulation) if t.dimension == 0]
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
