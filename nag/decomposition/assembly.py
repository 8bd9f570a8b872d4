"""Components put together: points of all dimensions are split, checked and judged, in one way.

A complete decomposition, components discovered from samples and intersections differ in how they
come by their points; from there on they are the same.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.decomposition.final_checks import checked_witness_set
from nag.decomposition.orbits import Action, irreducible_orbits
from nag.decomposition.reduction import Reduction
from nag.decomposition.splitting import Progress
from nag.decomposition.trace import digits_of_evidence
from nag.witness.fibres import Tracker
from nag.witness.points import Points
from nag.witness.witness import PathCounts, Status, WitnessSet


@dataclass(frozen=True, eq=False)
class Assembly:
    """Components, what it took to find them, and what is open.

    Attributes:
        components: by falling dimension, then rising degree.
        notes: doubts that are no single component's.
    """

    components: tuple[WitnessSet, ...]
    counts: PathCounts
    notes: tuple[str, ...]

    @property
    def complete(self) -> bool:
        """Whether every component is confirmed and nothing else is open."""
        undecided = any(c.status is Status.UNDECIDED for c in self.components)
        return not (undecided or self.notes)


def assembled(
    points: Mapping[int, Points],
    reduction: Reduction,
    rng: np.random.Generator,
    tracker: Tracker,
    *,
    actions: Sequence[Action] = (),
    scheme: bool = True,
    progress: Progress | None = None,
) -> Assembly:
    """The irreducible components of sets that are given by their points.

    Args:
        points: by dimension.
        actions: symmetries; one component of each orbit is worked out.
        scheme: whether the sets are components of the scheme of the equations, so that they have
            a multiplicity in it.
    """
    evidence = digits_of_evidence(reduction.system.polynomials)
    components: list[WitnessSet] = []
    counts, notes = PathCounts(), []
    for d in sorted(points, reverse=True):
        if not len(points[d]):
            continue
        if progress is not None:
            progress("splitting", len(components), 0)
        found = irreducible_orbits(points[d], actions, evidence, rng, tracker)
        counts += found.counts
        notes += [f"dimension {d}: {note}" for note in found.notes]
        sets = []
        for orbit in found.orbits:
            component, spent = checked_witness_set(
                orbit.representative, found.points, reduction, rng, tracker, scheme
            )
            counts += spent
            size = 1 + len(orbit.carriers)
            sets.append(replace(component, orbit=size, images=orbit.carriers))
        components += sorted(sets, key=lambda c: c.degree)
    return Assembly(tuple(components), counts, tuple(notes))
