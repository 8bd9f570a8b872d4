"""What a decomposition says of a mechanism that was given by its parts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nag.report.model import Rows
from nag.text.table import count_text
from nag.tracking.run import Run
from nag.witness.witness import Decomposition, WitnessSet

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.problem import Problem
    from nag.solving.solutions import SolveResult


def assembly_rows(problem: Problem, decomposition: Decomposition) -> Rows:
    """How many assemblies of parts there are, and whether they move; nothing for other problems."""
    parts = problem.parts
    if parts is None:
        return []
    isolated = [c for c in decomposition.components if c.dimension == 0]
    moving = [c for c in decomposition.components if c.dimension > 0]
    rows: Rows = []
    if moving:
        freedoms = sorted({c.dimension + problem.free for c in moving})
        most = count_text(freedoms[-1], "freedom")
        counted = " or ".join([*map(str, freedoms[:-1]), most])
        on = count_text(sum(c.orbit for c in moving), "component")
        start, end = _reality(problem, moving, decomposition)
        beside = "".join(f", {n} of them by {whose}" for n, whose in problem.freedoms_left_out)
        rows.append(("mobility", f"{start}it moves with {counted}{beside}, on {on}{end}"))
    if isolated:
        each = parts.points_of_each
        count = sum(c.orbit * len(c.points) for c in isolated) // each
        real = sum(c.orbit * sum(parts.is_real(x) for x in c.points) for c in isolated) // each
        text = (
            f"{count_text(count, parts.solution, _plural(parts))}{parts.counted_up_to}, "
            f"{real} of them real"
            + (", that cannot move" if moving else "; it moves in none of them")
            + (", but for the links that turn freely" if problem.free else "")
        )
        rows.append((_plural(parts), text))
    if not rows:
        text = f"no {parts.solution}, not even a complex one: the parts do not fit"
        rows.append((_plural(parts), text))
    return rows


def _reality(
    problem: Problem, moving: Sequence[WitnessSet], decomposition: Decomposition
) -> tuple[str, str]:
    """What is to be said before and behind that complex assemblies move."""
    from nag.mechanism.real_assemblies import real_text

    assert problem.parts is not None
    # Whether those move that are like a placement is a question of that placement.
    of_complex = "in complex coordinates "
    if problem.parts.reference is not None:
        return of_complex, ""
    run = Run(seed=decomposition.seed, settings=decomposition.settings)
    text = real_text(problem, moving, run)
    if text:
        return of_complex, f"; {text}"
    return "", f"; a real {problem.parts.solution} was found"


def real_rows(problem: Problem, result: SolveResult) -> Rows:
    """How many solutions are real assemblies; isotropic coordinates of these are not real."""
    parts = problem.parts
    if parts is None:
        return []
    real, each = [parts.is_real(x) for x in result.points], parts.points_of_each
    texts = [f"{len(real) // each}, {sum(real) // each} of them real"] if real else []
    if result.positive_dimensional:
        # A real one may be isolated among the real ones there, as a stretched loop is.
        texts.append(
            "those on the solution set of positive dimension are not listed: `nag mobility` says "
            "whether real ones are among them, and move"
        )
    return [(_plural(parts), "; ".join(texts))] if texts else []


def _plural(parts: AssemblyModel) -> str:
    return {"assembly": "assemblies"}.get(parts.solution, f"{parts.solution}s")
