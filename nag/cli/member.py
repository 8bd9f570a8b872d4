"""The command ``nag member``: the components that a point lies on."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from nag.cli.arguments import UsageError
from nag.cli.running import CommandAnswer, answer_of, chosen_run
from nag.cli.witness_input import (
    ONE_POINT,
    add_input,
    add_point,
    chosen_point,
    component_facts,
    doubt_rows,
    read_components,
    with_tested_traces,
)

if TYPE_CHECKING:
    from nag.witness.membership import Membership
    from nag.witness.witness import WitnessSet

FORMAT = "nag-membership"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments that ``nag member`` has besides those of every command that runs a case."""
    add_input(parser)
    add_point(parser)


def run(options: argparse.Namespace) -> CommandAnswer:
    """Which components a point lies on."""
    import numpy as np

    from nag.algebra.evaluation import Evaluator
    from nag.algebra.number import is_zero, number_text
    from nag.algebra.system import values_text
    from nag.witness.membership import EXACT, INEXACT, ROUNDED, Membership, memberships

    if (options.point is None) == (options.at is None):
        raise UsageError(ONE_POINT)
    found = with_tested_traces(
        read_components(options, lambda *known: chosen_point(options, *known))
    )
    system, components = found.decomposition.system, found.decomposition.components
    point = chosen_point(options, system.variables, found.points)
    exact = all(is_zero(value) for value in system(point))
    at = np.array([complex(float(value)) for value in point])
    evaluator = Evaluator.of(system.polynomials, system.n)
    residual = float(evaluator.residuals(at[None]).max(initial=0.0))
    answers = (Membership.FOREIGN,) * len(components)
    if exact or residual < ROUNDED:
        answers = memberships(
            found.decomposition,
            at,
            accuracy=EXACT if exact else max(INEXACT, 10 * residual),
            exact=point if exact else (),
            run=chosen_run(options),
        )
    open_ = [str(i) for i, answer in enumerate(answers, 1) if answer is Membership.UNDECIDED]
    lost = exact and not open_ and Membership.MEMBER not in answers
    texts = [number_text(value) for value in point]
    numbered = list(zip(components, answers, strict=True))
    fields = {
        "format": FORMAT,
        "variables": list(system.variables),
        "point": texts,
        "exact": exact,
        "residual": residual,
        "components": [
            {"number": i, **component_facts(component), "answer": answer.value}
            for i, (component, answer) in enumerate(numbered, 1)
        ],
    }
    top = [
        ("point", values_text(system.variables, point)),
        ("equations", _equations_text(exact, residual)),
        ("answer", _answer_text(numbered, exact)),
    ]
    tail = doubt_rows(found)
    if open_:
        tail.append(("open", f"membership could not be decided for component {', '.join(open_)}"))
    complete = found.decomposition.complete and not open_ and not lost
    return answer_of(options, found.case, (top, _table(numbered)), tail, fields, complete)


def _equations_text(exact: bool, residual: float) -> str:
    from nag.text.table import magnitude
    from nag.witness.membership import ROUNDED

    if exact:
        return "hold exactly"
    hold = "hold to rounding" if residual < ROUNDED else "do not hold"
    return f"{hold}, relative residual {magnitude(residual)}"


def _answer_text(numbered: Sequence[tuple[WitnessSet, Membership]], exact: bool) -> str:
    on = [component for component, answer in numbered if answer.value == "member"]
    undecided = any(answer.value == "undecided" for _, answer in numbered)
    if on:
        text = f"on {len(on)} of {len(numbered)} components; local dimension "
        return f"{text}{max(c.dimension for c in on)}{' at least' if undecided else ''}"
    if undecided:
        return "not known"
    missing = " that was found, though it is a solution: one is missing" if exact else ""
    return f"on no component{missing}"


def _table(numbered: Sequence[tuple[WitnessSet, Membership]]) -> list[str]:
    from nag.text.table import align

    if not numbered:
        return []
    rows = [["component", "dimension", "degree", "multiplicity", "point"]]
    for i, (component, answer) in enumerate(numbered, 1):
        said = {"member": "on it", "foreign": "not on it"}.get(answer.value, "?")
        multiplicity = str(component.multiplicity) if component.multiplicity else "?"
        rows.append([str(i), str(component.dimension), str(component.degree), multiplicity, said])
    return align(rows, [4])
