"""Components that symmetries of the system carry known ones to, known or not themselves.

Sign changes commute and are their own inverses, so that each of them either keeps the orbit found
so far or doubles it: one motion of the slice for each, with all points at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.numerics.coincidence import coincident
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre, move
from nag.witness.frame import image
from nag.witness.moving import witness_at
from nag.witness.slices import unit_complex
from nag.witness.witness import PathCounts, Slice, WitnessSet


@takes_run
def in_orbits(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    symmetries: Sequence[SignedPermutation],
    *,
    run: Run = DEFAULT_RUN,
) -> list[WitnessSet]:
    """One component of each orbit, with the symmetries that carry it into the others.

    An image of a component is told from the others by one of its points, moved to the common
    slice. Images that are in nobody's list are added to the orbit all the same.

    Args:
        components: complete ones, those of one dimension on a common slice.
        symmetries: signed permutations that keep the system.

    Raises:
        nag.witness.moving.SliceError: if points cannot be moved to the common slice.
    """

    def moved(component: WitnessSet, target: Slice) -> WitnessSet:
        if component.dimension == 0:
            return component
        return witness_at(system, component, target, run=run)

    absorbed: set[int] = set()
    found: list[WitnessSet] = []
    for i, first in enumerate(components):
        if i in absorbed:
            continue
        members = [(SignedPermutation.identity(system.n), first)]
        for carrier, _ in members:
            for symmetry in symmetries:
                way = symmetry.after(carrier)
                there = image(first, way)
                end = moved(_first_point(there), first.slice)
                if any(_among(end, member) for _, member in members):
                    continue
                # Components that stand earlier have their whole orbits.
                for j in range(i + 1, len(components)):
                    like = components[j].dimension == first.dimension
                    if like and _among(end, components[j]):
                        absorbed.add(j)
                        members.append((way, components[j]))
                        break
                else:
                    members.append((way, moved(there, first.slice)))
        images = tuple(way for way, _ in members[1:])
        found.append(replace(first, orbit=len(members), images=images))
    return found


def _first_point(component: WitnessSet) -> WitnessSet:
    """A witness set with one of its points only, to be moved."""
    fibres = tuple(fibre.only(np.arange(len(fibre)) == 0) for fibre in component.fibres[:1])
    own = {name: getattr(component, name)[:1] for name in ("points", "radii", "digits")}
    return replace(component, **own, fibres=fibres)


def _among(end: WitnessSet, component: WitnessSet) -> bool:
    """Whether the one point of a witness set is among those of another."""
    error = max(end.accuracy, component.accuracy)
    return bool(coincident(component.points, end.points[0], error).any())


Signs = tuple[int, ...]


def keeps(cut: Cut, signs: Sequence[int]) -> bool:
    """Whether a sign change carries each polynomial of a cut to itself or to its negative."""
    flipped = [i for i, s in enumerate(signs) if s < 0]
    return not cut.deflated and all(
        len({sum(e[i] for i in flipped) % 2 for e in f.terms}) <= 1 for f in cut.polynomials
    )


def sign_orbit(
    fibre: Fibre,
    generators: Sequence[Signs],
    rng: np.random.Generator,
    run: Run,
) -> tuple[list[tuple[int, ...]] | None, PathCounts]:
    """The sign changes that carry a component to those of its orbit, itself first.

    Args:
        fibre: all points of the component on a generic slice, with a cut that the generators keep.
        generators: signs of the variables.

    Returns:
        For each component of the orbit the indices of the generators whose product carries to it,
        and the paths; None instead if paths fail.
    """
    carriers: list[tuple[int, ...]] = [()]
    points, counts = fibre.points, PathCounts()
    for k, signs in enumerate(generators):
        factor = np.array(signs, dtype=float)
        images, error, spent = _moved(fibre, points * factor, factor, rng, run)
        counts += spent
        if images is None:
            return None, counts
        if coincident(points, images[0], error).any():
            continue
        points = np.vstack([points, images])
        carriers += [(*carrier, k) for carrier in carriers]
    return carriers, counts


def _moved(
    fibre: Fibre,
    images: np.ndarray,
    factor: np.ndarray,
    rng: np.random.Generator,
    run: Run,
) -> tuple[np.ndarray | None, float, PathCounts]:
    """Images of points, from the slice that they lie on to the common one, and their error.

    None if a path fails.
    """
    if fibre.dimension == 0:
        return images, 0.0, PathCounts()
    moved = Fibre(fibre.cut, fibre.rows * np.concatenate([[1.0], factor]), images)
    (ends,) = move([moved], fibre.rows, complex(unit_complex(rng)), run)
    if not ends.regular.all():
        return None, 0.0, ends.counts.judged_elsewhere
    return ends.points, float(ends.accuracy.max(initial=0.0)), ends.counts.judged_elsewhere
