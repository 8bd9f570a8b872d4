"""Components put together: points of all dimensions are split, checked and judged, in one way.

A complete decomposition, components discovered from samples and intersections differ in how they
come by their points; from there on they are the same.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
class KnownOfSets:
    """What is known of sets before they are split.

    Attributes:
        actions: symmetries; one component of each orbit is worked out.
        scheme: whether the sets are components of the scheme of the equations, so that they have
            a multiplicity in it.
        embedded: whether sets that deflation made reduced may lie on larger ones; those that do
            are left out.
    """

    actions: Sequence[Action] = ()
    scheme: bool = True
    embedded: bool = False


NOTHING = KnownOfSets()


@dataclass(frozen=True, eq=False)
class Piece:
    """A component as it was put together.

    Attributes:
        component: the component.
        fibres: its points in the coordinates in which the equations are solved.
        indices: of these among the points of the same dimension.
    """

    component: WitnessSet
    fibres: list[Fibre]
    indices: np.ndarray


@dataclass(frozen=True, eq=False)
class Assembly:
    """Components, what it took to find them, and what is open.

    Attributes:
        pieces: by falling dimension, then rising degree.
        notes: doubts that are no single component's.
    """

    pieces: tuple[Piece, ...]
    counts: PathCounts
    notes: tuple[str, ...]

    @property
    def components(self) -> tuple[WitnessSet, ...]:
        return tuple(piece.component for piece in self.pieces)


def assemble_components(
    points: Mapping[int, Points],
    reduction: Reduction,
    rng: np.random.Generator,
    run: Run,
    known: KnownOfSets = NOTHING,
) -> Assembly:
    """The irreducible components of sets that are given by their points, by dimension."""
    evidence = digits_of_evidence(reduction.natural.system(reduction.system).polynomials)
    pieces: list[Piece] = []
    counts, notes = PathCounts(), []
    for d in sorted(points, reverse=True):
        if not len(points[d]):
            continue
        run.tell("splitting", len(pieces), 0)
        found = irreducible_orbits(points[d], known.actions, evidence, rng, run)
        counts += found.counts
        notes += [f"dimension {d}: {note}" for note in found.notes]
        here = []
        examined = Examined.of(found.points, found.classes, reduction, rng)
        for own in found.classes:
            fibres = [fibre for fibre, _ in found.points.fibres(own.indices)]
            if known.embedded:
                answer, spent = _on_larger_set(fibres[0], pieces, rng, run)
                counts += spent
                if answer is Membership.UNDECIDED:
                    notes.append(f"whether a component of dimension {d} is one was not decided")
                if answer is Membership.MEMBER:
                    continue
            component, spent = check_class(own, examined, rng, run, known.scheme)
            counts += spent
            here.append(Piece(component, fibres, own.indices))
        pieces += sorted(here, key=lambda piece: piece.component.degree)
    return Assembly(tuple(pieces), counts, tuple(notes))


def _on_larger_set(
    fibre: Fibre, pieces: Sequence[Piece], rng: np.random.Generator, run: Run
) -> tuple[Membership, PathCounts]:
    """Whether a set that deflation was needed for lies on one of higher dimension."""
    if not fibre.cut.deflated:
        return Membership.FOREIGN, PathCounts()
    larger: dict[int, list[Fibre]] = {}
    for piece in pieces:
        larger.setdefault(piece.component.dimension, []).extend(piece.fibres)
    return is_on_larger_set(fibre.x[0], LEAST, larger, fibre.dimension, rng, run)
