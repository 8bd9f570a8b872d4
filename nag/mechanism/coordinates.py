"""A decomposition in joint coordinates, carried over to Euler parameters.

One configuration has as many points in Euler parameters as there are sign changes of them, so that
a component in half-angles is an orbit of components there, each a covering of it. The witness
point that is smallest there leads on; loops and the trace find those of the component through it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.given_points import best_lifted, components_through_points
from nag.mechanism.model import Model, model
from nag.mechanism.rods import RodModel
from nag.witness.witness import Decomposition, Status


def euler_decomposition(
    source: Model, decomposition: Decomposition, *, threads: int = 1
) -> tuple[Model, Decomposition]:
    """The model in Euler parameters and its components, from those in other coordinates.

    Complete if the given decomposition is and every component was found and confirmed. Degrees and
    multiplicities are those in Euler parameters (and slides that these do not determine).

    Args:
        source: the model that was decomposed.
        decomposition: its components, all of them or one of each orbit.
        threads: for path tracking.
    """
    target = model(source.mechanism, "E", source.modes, source.space)
    reason = f"{source.reason}; carried over from formulation {source.formulation}"
    target = replace(target, reason=f"{reason} to the bodies' Euler parameters")
    spins = source.form.spins if isinstance(source.form, RodModel) else 0
    starts = []
    for component in decomposition.components:
        point = best_lifted(component, lambda x: target.project(source.lift(x)))
        starts.append((component.dimension + spins, point))
    return target, carry_components_over(
        decomposition, target.system, target.symmetries, starts, threads
    )


def carry_components_over(
    decomposition: Decomposition,
    system: PolynomialSystem,
    symmetries: Sequence[SignedPermutation],
    starts: Sequence[tuple[int, np.ndarray]],
    threads: int,
) -> Decomposition:
    """Components in other coordinates, each through a point that a component was lifted to.

    Complete if the given decomposition is and every component was found and confirmed.

    Args:
        system: the equations in the other coordinates; symmetries: theirs.
        starts: for each component its dimension there and the point.
    """
    notes = [
        f"a component of dimension {component.dimension} is undecided"
        for component in decomposition.components
        if component.status is not Status.IRREDUCIBLE
    ]
    answer = components_through_points(
        system,
        starts,
        seed=decomposition.seed,
        threads=threads,
        settings=decomposition.settings,
        symmetries=symmetries,
    )
    return replace(
        answer,
        paths=decomposition.paths + answer.paths,
        complete=decomposition.complete and answer.complete and not notes,
        notes=(*decomposition.notes, *notes, *answer.notes),
    )
