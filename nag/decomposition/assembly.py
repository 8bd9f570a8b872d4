"""Components put together: points of all dimensions are split, checked and judged, in one way.

A complete decomposition, components discovered from samples and intersections differ in how they
come by their points; from there on they are the same.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from nag.decomposition.final_checks import Examined, check_class
from nag.decomposition.orbits import Action, irreducible_orbits
from nag.decomposition.reduction import Reduction
from nag.decomposition.trace import digits_of_evidence
from nag.numerics.zero_values import LEAST
from nag.tracking.run import Run
from nag.witness.fibres import Fibre
from nag.witness.membership import Membership, is_on_larger_set
from nag.witness.points import Points
from nag.witness.witness import PathCounts, WitnessSet


@dataclass(frozen=True, eq=False)
class Assembly:
    """Components, what it took to find them, and what is open.

    Attributes:
        components: by falling dimension, then rising degree.
        indices: for each those of its points among all of their dimension.
        notes: doubts that are no single component's.
    """

    components: tuple[WitnessSet, ...]
    indices: tuple[np.ndarray, ...]
    counts: PathCounts
    notes: tuple[str, ...]


def assemble_components(
    points: Mapping[int, Points],
    reduction: Reduction,
    rng: np.random.Generator,
    run: Run,
    *,
    actions: Sequence[Action] = (),
    scheme: bool = True,
    embedded: bool = False,
    found: Callable[[Sequence[WitnessSet]], None] | None = None,
) -> Assembly:
    """The irreducible components of sets that are given by their points, by dimension.

    Args:
        actions: symmetries; one component of each orbit is worked out.
        scheme: whether the sets are components of the scheme of the equations, so that they have
            a multiplicity in it.
        embedded: whether sets that deflation made reduced may lie on larger ones; those that do
            are left out.
        found: called with the components of the largest dimensions when they are known.
    """
    evidence = digits_of_evidence(reduction.natural.system(reduction.system).polynomials)
    known: list[tuple[WitnessSet, np.ndarray]] = []
    sets: dict[int, list[Fibre]] = {}
    counts, notes = PathCounts(), []
    for d in sorted(points, reverse=True):
        if not len(points[d]):
            continue
        run.tell("splitting", len(known), 0)
        split = irreducible_orbits(points[d], actions, evidence, rng, run)
        counts += split.counts
        notes += [f"dimension {d}: {note}" for note in split.notes]
        here = []
        examined = Examined.of(split.points, split.classes, reduction, rng)
        for own in split.classes:
            fibres = [fibre for fibre, _ in split.points.fibres(own.indices)]
            if embedded and fibres[0].cut.deflated:
                x = fibres[0].x[0]
                answer, spent = is_on_larger_set(x, LEAST, sets, d, rng, run)
                counts += spent
                if answer is Membership.UNDECIDED:
                    notes.append(f"whether a component of dimension {d} is one was not decided")
                if answer is Membership.MEMBER:
                    continue
            component, spent = check_class(own, examined, rng, run, scheme)
            counts += spent
            here.append((component, own.indices, fibres))
        here.sort(key=lambda each: each[0].degree)
        known += [(component, indices) for component, indices, _ in here]
        if found is not None:
            found([component for component, _ in known])
        sets[d] = [fibre for *_, fibres in here for fibre in fibres]
    components, indices = zip(*known, strict=True) if known else ((), ())
    return Assembly(components, indices, counts, tuple(notes))
