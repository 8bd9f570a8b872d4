"""The command ``nag member``: the components that a point lies on."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from nag.cli.arguments import UsageError, add_running
from nag.cli.running import as_chosen, compilation_notice, run_row
from nag.cli.witness_input import (
    Given,
    Points,
    add_input,
    add_point,
    doubts,
    given,
    head,
    like,
    named_point,
    point_at,
    with_tested_traces,
    write_document,
)

if TYPE_CHECKING:
    from nag.algebra.number import Number

FORMAT = "nag-membership"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag member`` has besides those of every command that runs a case."""
    add_input(parser)
    add_running(parser)
    add_point(parser)


def run(options: argparse.Namespace) -> tuple[list[str], bool]:
    """Test a point and write the export; returns the lines to print and whether all is known.

    Raises:
        UsageError: for bad input, or an export that cannot be written.
    """
    import numpy as np

    from nag.algebra.evaluation import Evaluator
    from nag.algebra.number import is_zero, number_text

    if (options.point is None) == (options.at is None):
        raise UsageError("give either the name of a point of the case or --at, and not both")
    with compilation_notice(sys.stderr, options.quiet):
        from nag.witness.at_prompt import EXACT, INEXACT, ROUNDED
        from nag.witness.membership import Membership, memberships

        found = with_tested_traces(given(options, lambda *known: _point(options, *known)))
        system = found.decomposition.system
        point = _point(options, system.variables, found.points)
        exact = all(is_zero(value) for value in system(point))
        at = np.array([complex(float(value)) for value in point])
        evaluator = Evaluator.of(system.polynomials, system.n)
        residual = float(evaluator.residuals(at[None]).max(initial=0.0))
        answers = (Membership.FOREIGN,) * len(found.decomposition.components)
        if exact or residual < ROUNDED:
            answers = memberships(
                found.decomposition,
                at,
                accuracy=EXACT if exact else max(INEXACT, 10 * residual),
                exact=point if exact else (),
                **as_chosen(options),
            )
    open_ = sum(answer is Membership.UNDECIDED for answer in answers)
    lost = exact and not open_ and Membership.MEMBER not in answers
    complete = found.decomposition.complete and not open_ and not lost
    texts = [number_text(value) for value in point]
    if options.json is not None:
        document = head(found, FORMAT, options) | {
            "complete": complete,
            "variables": list(system.variables),
            "point": texts,
            "exact": exact,
            "residual": residual,
            "components": [
                {"number": i + 1, **like(component), "answer": answer.value}
                for i, (component, answer) in enumerate(
                    zip(found.decomposition.components, answers, strict=True)
                )
            ],
        }
        write_document(document, options.json)
    return _lines(options, found, texts, exact, residual, answers), complete


def _point(
    options: argparse.Namespace, variables: Sequence[str], points: Points
) -> tuple[Number, ...]:
    if options.at is not None:
        return point_at(options.at, variables)
    return named_point(options.case, options.point, points)


def _lines(
    options: argparse.Namespace,
    found: Given,
    texts: list[str],
    exact: bool,
    residual: float,
    answers: tuple[Any, ...],
) -> list[str]:
    from nag.text.table import align, magnitude, printable, sheet
    from nag.witness.at_prompt import ROUNDED
    from nag.witness.membership import Membership

    components = found.decomposition.components
    names = found.decomposition.system.variables
    on = [i for i, answer in enumerate(answers) if answer is Membership.MEMBER]
    undecided = [i for i, answer in enumerate(answers) if answer is Membership.UNDECIDED]
    if exact:
        equations = "hold exactly"
    elif residual < ROUNDED:
        equations = f"hold to rounding, relative residual {magnitude(residual)}"
    else:
        equations = f"do not hold, relative residual {magnitude(residual)}"
    if on:
        text = f"on {len(on)} of {len(components)} components; local dimension "
        text += f"{max(components[i].dimension for i in on)}"
        if undecided:
            text += " at least"
    elif undecided:
        text = "not known"
    else:
        text = "on no component"
        if exact:
            text += " that was found, though it is a solution: one is missing"
    rows = [["component", "dimension", "degree", "multiplicity", "point"]]
    for i, (component, answer) in enumerate(zip(components, answers, strict=True)):
        said = {Membership.MEMBER: "on it", Membership.FOREIGN: "not on it"}.get(answer, "?")
        multiplicity = str(component.multiplicity) if component.multiplicity else "?"
        cells = [str(i + 1), str(component.dimension), str(component.degree), multiplicity, said]
        rows.append(cells)
    point = ", ".join(f"{name} = {value}" for name, value in zip(names, texts, strict=True))
    tail = doubts(found)
    if undecided:
        numbers = ", ".join(str(i + 1) for i in undecided)
        tail.append(("open", f"membership could not be decided for component {numbers}"))
    tail.append(run_row(options))
    top = [("point", printable(point)), ("equations", equations), ("answer", text)]
    return sheet(found.title, top, align(rows, [4]) if components else [], tail)
