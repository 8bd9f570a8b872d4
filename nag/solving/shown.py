"""What solutions show at the prompt, in notebooks and in the commands."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from nag.algebra.system import system_line
from nag.text.table import count_text, html_table, lines_of, magnitude, named_line, number_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from nag.solving.solutions import Solution, Solutions, SolveResult

# Longer lists are left to the export.
MOST_ROWS = 40


Reality: TypeAlias = "Callable[[Solution], bool]"


def has_real_coordinates(solution: Solution) -> bool:
    """Whether a solution is real: its coordinates are."""
    return solution.real


def answer_text(result: SolveResult, is_real: Reality = has_real_coordinates) -> str:
    """The answer in one sentence."""
    count, real = len(result.solutions), int(_which(result, is_real).sum())
    text = "no isolated solution"
    if count:
        text = f"{count_text(count, 'isolated solution')}, {real} real"
    multiple = Counter(result.table.multiplicity.tolist())
    for multiplicity, number in sorted(multiple.items()):
        if multiplicity == 1:
            continue
        text += f", {number} of multiplicity {multiplicity}"
    if result.excluded:
        text += f"; {result.excluded} more excluded, where a polynomial that must not vanish does"
    if result.positive_dimensional:
        text += f"{'; and' if count else ', but'} a solution set of positive dimension"
    elif result.perhaps_infinite:
        text += "; whether there is a solution set of positive dimension could not be decided"
    return text


def _which(result: SolveResult, is_real: Reality) -> np.ndarray:
    """Which solutions are real, shape ``(k,)``."""
    if is_real is has_real_coordinates:
        return result.table.real
    return np.array([is_real(s) for s in result.solutions], dtype=bool)


def solution_rows(
    result: SolveResult,
    most: int | None = None,
    columns: int | None = None,
    is_real: Reality = has_real_coordinates,
) -> list[list[str]]:
    """Headings, and a row for each of at most ``most`` solutions, the real ones first.

    At most ``columns`` coordinates are shown, the imaginary unit not.
    """
    ordered = np.argsort(~_which(result, is_real), kind="stable").tolist()
    names = result.system.own_variables
    columns = len(names) if columns is None else min(columns, len(names))
    dots = ["..."] if len(names) > columns else []
    head = ["solution", *names[:columns], *dots]
    rows = [[*head, "multiplicity", "real", "residual", "condition", "digits"]]
    for i in ordered[:most]:
        s = result.solutions[i]
        rows.append(
            [
                str(i + 1),
                *(coordinate_text(z, s) for z in s.point[:columns]),
                *dots,
                str(s.multiplicity),
                "yes" if is_real(s) else "no",
                magnitude(s.residual),
                magnitude(s.condition),
                str(s.precision),
            ]
        )
    return rows


def coordinate_text(z: complex, solution: Solution) -> str:
    """A coordinate to as many digits as the point's accuracy leaves it."""
    with np.errstate(over="ignore"):
        error = solution.accuracy * (1 + float(np.linalg.norm(solution.point)))
    return number_text(z.real if solution.real else z, error)


def _point_text(solution: Solution) -> str:
    return f"({', '.join(coordinate_text(z, solution) for z in solution.to_numpy())})"


def solution_line(solution: Solution) -> str:
    """A solution in one line, as lists show it."""
    kind = "real" if solution.real else "not real"
    return f"Solution({_point_text(solution)}, {kind}, multiplicity={solution.multiplicity})"


def solution_text(solution: Solution) -> str:
    """A solution in five lines."""
    kind = "real" if solution.real else "not real"
    return lines_of(
        f"Solution {_point_text(solution)}",
        [
            ("kind", f"{kind}, multiplicity {solution.multiplicity}"),
            ("residual", magnitude(solution.residual)),
            ("accuracy", f"{magnitude(solution.accuracy)}, {solution.precision} digits needed"),
            ("condition", magnitude(solution.condition)),
        ],
    )


def solutions_line(solutions: Solutions) -> str:
    """Solutions in one line, however many there are."""
    count = count_text(len(solutions), "isolated solution")
    return named_line(solutions, f": {count}, {int(solutions.real.sum())} real")


def solutions_text(solutions: Solutions) -> str:
    """Solutions, a line for each of the first ones."""
    lines = [solution_line(each) for each in solutions[:MOST_ROWS]]
    left = len(solutions) - len(lines)
    return "\n".join([solutions_line(solutions), *lines, *([f"and {left} more"] if left else [])])


def _rests_on(result: SolveResult) -> str:
    if not result.solutions:
        return "no points"
    residual, accuracy, condition = (
        magnitude(float(np.max(getattr(result.table, name))))
        for name in ("residual", "accuracy", "condition")
    )
    digits = int(result.table.precision.max())
    return f"residual {residual}, accuracy {accuracy}, condition {condition}, {digits} digits"


def _status(result: SolveResult) -> str:
    status = "complete" if result.complete else "INCOMPLETE"
    return ": ".join([status, *(["; ".join(result.notes)] if result.notes else [])])


def _run(result: SolveResult) -> str:
    paths = result.paths
    return (
        f"seed {result.seed}, settings {result.settings}; paths: {paths.tracked} tracked, "
        f"{paths.at_infinity} to infinity, {paths.failed} failed"
    )


def result_text(result: SolveResult) -> str:
    """A result in five lines."""
    return lines_of(
        f"SolveResult for {system_line(result.system)}",
        [
            ("answer", answer_text(result)),
            ("status", _status(result)),
            ("rests on", _rests_on(result)),
            ("run", _run(result)),
        ],
    )


def result_html(result: SolveResult) -> str:
    """A result as a table, one row a solution, the real ones first."""
    rows = solution_rows(result, MOST_ROWS, result.system.n) if result.solutions else []
    hidden = len(result.solutions) - MOST_ROWS
    more = [f"{count_text(hidden, 'more solution')} not shown"] if hidden > 0 else []
    note = "; ".join([_status(result), *more, _run(result)])
    return html_table(f"{answer_text(result)}; {system_line(result.system)}", rows, note)
