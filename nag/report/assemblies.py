"""What a decomposition says of a mechanism that was given by its parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from nag.report.model import Rows
from nag.text.table import count_text
from nag.tracking.run import Run
from nag.witness.witness import Decomposition, WitnessSet

if TYPE_CHECKING:
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.problem import Problem


def assembly_rows(problem: Problem, decomposition: Decomposition) -> Rows:
    """How many assemblies of parts there are, and whether they move; nothing for other problems."""
    parts = problem.parts
    if parts is None:
        return []
    isolated = [c for c in decomposition.components if c.dimension == 0]
    moving = [c for c in decomposition.components if c.dimension > 0]
    texts = []
    if moving:
        largest = max(c.dimension for c in moving) + problem.free
        on = count_text(sum(c.orbit for c in moving), "component")
        texts.append(
            f"mobile, mobility {largest} at most, on {on}{_reality(problem, moving, decomposition)}"
        )
    if isolated:
        each = parts.points_of_each
        count = sum(c.orbit * len(c.points) for c in isolated) // each
        real = sum(c.orbit * sum(parts.is_real(x) for x in c.points) for c in isolated) // each
        texts.append(
            f"{count_text(count, parts.solution, _plural(parts))}{parts.counted_up_to}, "
            f"{real} of them real"
            + (", that cannot move" if moving else "; rigid in each of them")
            + (", but for the links that turn freely" if problem.free else "")
        )
    if not texts:
        texts = [f"no {parts.solution}, not even a complex one: the parts do not fit"]
    return [(_plural(parts), "; ".join(texts))]


def _reality(problem: Problem, moving: Sequence[WitnessSet], decomposition: Decomposition) -> str:
    from nag.mechanism.real_assemblies import real_text

    if problem.parts is None or problem.parts.reference is not None:
        return ""
    run = Run(seed=decomposition.seed, settings=decomposition.settings)
    return f"; {real_text(problem, moving, run)}"


def real_rows(problem: Problem, points: Iterable[Sequence[complex]]) -> Rows:
    """How many solutions are real assemblies; isotropic coordinates of these are not real."""
    parts = problem.parts
    if parts is None:
        return []
    real, each = [parts.is_real(x) for x in points], parts.points_of_each
    return [(_plural(parts), f"{len(real) // each}, {sum(real) // each} of them real")]


def _plural(parts: AssemblyModel) -> str:
    return {"assembly": "assemblies"}.get(parts.solution, f"{parts.solution}s")
