"""Components of frameworks, found in the coordinates that take fewest paths.

A placed framework has coordinates x and y. Its components are found as sets of complex numbers z
(`isotropic`), a point of each is carried over, and loops and the trace find its witness points in
x and y. The reflection of the plane exchanges z and w, so that components are carried over once a
pair.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.decomposition.decompose import decompose
from nag.decomposition.given_points import best_lifted, components_through_points
from nag.mechanism.framework_model import FrameworkModel
from nag.mechanism.isotropic import conjugates
from nag.numerics.zero_values import LEAST
from nag.tracking.run import Run, Stream
from nag.witness.component_equations import component_fibres
from nag.witness.membership import Membership, is_member
from nag.witness.witness import Decomposition, Status, WitnessSet


def decompose_framework(
    parts: FrameworkModel,
    *,
    run: Run,
    symmetries: Sequence[SignedPermutation],
) -> Decomposition:
    """The components of `parts.system`, as `nag.decompose` gives them.

    What is not complete when it was carried over is found again in the system's own coordinates.

    Args:
        parts: the model of all realisations.
        run: how it is worked out.
        symmetries: those of `parts`, or none.
    """
    smaller = parts.smaller
    known = not symmetries or tuple(symmetries) == tuple(parts.symmetries)
    tracked = None
    if smaller is not None and known:
        found = decompose(smaller.system, run=run)
        carried = _carry_over(parts, found, symmetries, run) if found.complete else None
        if carried is not None:
            return carried
        tracked = found.paths.judged_elsewhere
    answer = decompose(parts.system, run=run, symmetries=symmetries)
    return answer if tracked is None else replace(answer, paths=answer.paths + tracked)


def _carry_over(
    parts: FrameworkModel,
    found: Decomposition,
    symmetries: Sequence[SignedPermutation],
    run: Run,
) -> Decomposition | None:
    """Components in z as components in x and y; None if they cannot be, or not for certain."""
    chosen = list(found.components)
    if symmetries:
        chosen = _one_of_each_pair(parts, found, run.random(Stream.MIRROR_IMAGES), run)
    starts = [(c.dimension, best_lifted(c, lambda z: _in_the_plane(parts, z))) for c in chosen]
    answer = components_through_points(parts.system, starts, run=run, symmetries=symmetries)
    counted = sum(c.orbit for c in answer.components)
    if not answer.complete or counted != len(found.components):
        return None
    return replace(answer, paths=found.paths + answer.paths)


def _in_the_plane(parts: FrameworkModel, z: np.ndarray) -> np.ndarray:
    w = np.array(conjugates(parts.framework, z))
    return np.stack([(z + w) / 2, (z - w) / 2j], axis=1).ravel()


def _one_of_each_pair(
    parts: FrameworkModel, found: Decomposition, rng: np.random.Generator, run: Run
) -> list[WitnessSet]:
    """Components of which none is the reflection of another, as far as that can be told."""
    chosen: list[WitnessSet] = []
    for component in found.components:
        image = np.array(conjugates(parts.framework, component.points[0]))
        alike = [c for c in chosen if _kind(c) == _kind(component)]
        if not any(_lies_on(c, image, found, rng, run) for c in alike):
            chosen.append(component)
    return chosen


def _kind(component: WitnessSet) -> tuple[int, int, int | None]:
    return component.dimension, component.degree, component.multiplicity


def _lies_on(
    component: WitnessSet,
    point: np.ndarray,
    found: Decomposition,
    rng: np.random.Generator,
    run: Run,
) -> bool:
    """Whether the reflection of a point of a component of the same kind lies on a component."""
    if component.status is not Status.IRREDUCIBLE:
        return False
    if component.dimension == 0:
        others = [c for c in found.components if c.dimension == 0]
        return min(others, key=lambda c: np.linalg.norm(c.points[0] - point)) is component
    fibres = component_fibres(found.system, component)
    answer, _ = is_member(point, LEAST, fibres, rng, run)
    return answer is Membership.MEMBER
