"""Components in joint coordinates, carried over to Euler parameters.

One configuration has as many points in Euler parameters as there are sign changes of them, so that
a component in half-angles is an orbit of components there, each a covering of it. The witness
point that is smallest there leads on; loops and the trace find those of the component through it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from nag.decomposition.given_points import best_lifted, components_through_points
from nag.mechanism.dh import dh_euler_model
from nag.mechanism.model import Model, model
from nag.mechanism.problem import Problem, problem_of
from nag.mechanism.rods import RodModel
from nag.witness.witness import Decomposition, Status


def carry_to_euler(
    problem: Problem, decomposition: Decomposition, *, threads: int = 1
) -> tuple[Problem, Decomposition]:
    """A problem in Euler parameters and its components, from those in its own formulation.

    Complete if the given decomposition is and every component was found and confirmed. Degrees and
    multiplicities are those in Euler parameters (and slides that these do not determine).

    Args:
        problem: of a mechanism, or of a table by Denavit and Hartenberg.
        decomposition: its components, all of them or one of each orbit.
        threads: for path tracking.
    """
    if problem.formulation == "E":
        return problem, decomposition
    target, lift, spins = _in_euler_parameters(problem)
    starts = [(c.dimension + spins, best_lifted(c, lift)) for c in decomposition.components]
    notes = [
        f"a component of dimension {component.dimension} is undecided"
        for component in decomposition.components
        if component.status is not Status.IRREDUCIBLE
    ]
    answer = components_through_points(
        target.system,
        starts,
        seed=decomposition.seed,
        threads=threads,
        settings=decomposition.settings,
        symmetries=target.symmetries,
    )
    return target, replace(
        answer,
        paths=decomposition.paths + answer.paths,
        complete=decomposition.complete and answer.complete and not notes,
        notes=(*decomposition.notes, *notes, *answer.notes),
    )


def _in_euler_parameters(
    problem: Problem,
) -> tuple[Problem, Callable[[np.ndarray], np.ndarray], int]:
    """The problem, where its points go, and how many freedoms it has besides."""
    source = problem.model
    if not isinstance(source, Model):
        table = dh_euler_model(source.loop)  # type: ignore[union-attr]
        return problem_of(table), lambda x: table.of_half_angles(source, x), 0  # type: ignore[arg-type]
    made = model(source.mechanism, "E", source.modes, source.space)
    reason = f"{source.reason}; carried over from formulation {source.formulation}"
    target = replace(made, reason=f"{reason} to the bodies' Euler parameters")
    spins = source.form.spins if isinstance(source.form, RodModel) else 0
    return problem_of(target), lambda x: target.project(source.lift(x)), spins
