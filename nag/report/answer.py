"""The answer to ``nag decompose`` and ``nag model``, put together from a case and its results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nag.algebra.number import Number, is_zero, number_text
from nag.algebra.system import PolynomialSystem
from nag.decomposition.witness import Decomposition, Status
from nag.report.agreement import agreement_text, compare, in_words, kinds
from nag.report.export import Origin
from nag.report.table import (
    component_table,
    labelled,
    paths_line,
    printable,
    remarks,
    system_line,
    title_line,
)

if TYPE_CHECKING:
    from nag.cases import Case
    from nag.mechanism.model import Model

FORMULATIONS = {"E": "E (Euler parameters)", "H": "H (half angles)"}


@dataclass(frozen=True)
class Through:
    """The components through a named point.

    Attributes:
        name: name of the point.
        solution: whether the point satisfies the equations.
        components: indices of the components through it.
    """

    name: str
    solution: bool
    components: tuple[int, ...]

    @property
    def found(self) -> bool:
        """Whether the components account for the point."""
        return bool(self.components) or not self.solution


def system_of(case: Case, model: Model | None) -> PolynomialSystem:
    """The system that is decomposed."""
    system = case.system if model is None else model.system
    if system is None:
        raise ValueError("a case without a system and without a mechanism")
    return system


def points_of(case: Case, model: Model | None) -> list[tuple[str, tuple[Number, ...]]]:
    """Named points of the system: of a mechanism, its reference configuration."""
    if model is not None:
        return [("reference configuration", tuple(model.reference))]
    return [(point.name, tuple(point.at)) for point in case.points]


def through_points(
    decomposition: Decomposition, case: Case, model: Model | None, threads: int = 1
) -> list[Through]:
    """Which components pass through the case's named points."""
    from nag.decomposition.membership import components_through

    found = []
    for name, point in points_of(case, model):
        solution = all(is_zero(value) for value in decomposition.system(point))
        indices: list[int] = []
        if solution and decomposition.components:
            at = np.array([complex(float(x)) for x in point])
            indices = components_through(decomposition, at, threads=threads)
        found.append(Through(name, solution, tuple(indices)))
    return found


def is_complete(decomposition: Decomposition, points: Sequence[Through]) -> bool:
    """Whether nothing is left open."""
    return decomposition.complete and all(point.found for point in points)


def origin(case: Case, model: Model | None) -> Origin:
    """What an export says of where the system came from."""
    from pathlib import Path

    return Origin(
        title=case.title,
        file=Path(case.path).name,
        kind=case.kind,
        formulation=model.formulation if model else None,
        reason=model.reason if model else None,
    )


def _model_row(model: Model) -> tuple[str, str]:
    formulation = FORMULATIONS.get(model.formulation, model.formulation)
    return "model", printable(f"{model.space}, formulation {formulation}: {model.reason}")


def _mobility_rows(
    decomposition: Decomposition, case: Case, model: Model | None, points: Sequence[Through]
) -> list[tuple[str, str]]:
    rows = []
    for point in points:
        components = [decomposition.components[i] for i in point.components]
        if not point.solution:
            text = f"{point.name} is no solution of the equations"
        elif not components:
            text = f"not known: no component that was found passes through {point.name}"
        else:
            largest = max(c.dimension for c in components)
            text = f"{largest} at {point.name}: on {in_words(kinds(components))}"
            if any(c.status is not Status.IRREDUCIBLE for c in components):
                text += ", not all of them decided"
        rows.append(("mobility" if model else "dimension", printable(text)))
    if case.mechanism is not None:
        from nag.mechanism.mobility import gruebler_kutzbach

        rows.append(("counted", f"{gruebler_kutzbach(case.mechanism)} by Gruebler-Kutzbach"))
    return rows


def answer_lines(
    decomposition: Decomposition,
    case: Case,
    model: Model | None,
    points: Sequence[Through],
    seconds: float,
) -> list[str]:
    """The whole answer, line by line."""
    head = [("system", system_line(decomposition.system)), ("answer", title_line(decomposition))]
    if model is not None:
        head.insert(0, _model_row(model))
    if not is_complete(decomposition, points):
        head.append(("", "INCOMPLETE, see below"))
    tail = _mobility_rows(decomposition, case, model, points)
    tail += [("open", line) for line in remarks(decomposition)]
    tail += [
        ("paths", paths_line(decomposition)),
        ("run", f"seed {decomposition.seed}, settings {decomposition.settings}, {seconds:.1f} s"),
    ]
    agreement = compare(decomposition, case.truth, model.formulation if model else None)
    if agreement is not None:
        tail.append(("known", printable(agreement_text(agreement))))
    width = max(len(label) for label, _ in head + tail)
    table = component_table(decomposition)
    return [
        printable(case.title),
        "",
        *labelled(head, width),
        "",
        *([*table, ""] if table else []),
        *labelled(tail, width),
    ]


def model_lines(case: Case, model: Model | None) -> list[str]:
    """The polynomial system of a case, line by line."""
    system = system_of(case, model)
    head = [("system", system_line(system))]
    if model is not None:
        head.insert(0, _model_row(model))
    lines = [printable(case.title), "", *labelled(head), "", "equations"]
    lines += [f"  {text} = 0" for text in system.text()] or ["  none"]
    if system.nonzero:
        lines += ["not zero", *(f"  {f.text(system.variables)}" for f in system.nonzero)]
    if system.groups:
        groups = ("(" + ", ".join(system.variables[i] for i in g) + ")" for g in system.groups)
        lines += ["groups", "  " + ", ".join(groups)]
    for name, point in points_of(case, model):
        values = zip(system.variables, point, strict=True)
        lines += [printable(name), "  " + ", ".join(f"{v} = {number_text(x)}" for v, x in values)]
    return lines
