"""Components that symmetries of the system carry known ones to, known or not themselves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.numerics.coincidence import coincident
from nag.witness.expansion import image
from nag.witness.moving import witness_at
from nag.witness.witness import Slice, WitnessSet


def in_orbits(
    system: PolynomialSystem,
    components: Sequence[WitnessSet],
    symmetries: Sequence[SignedPermutation],
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
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
        options = {"seed": seed, "threads": threads, "settings": settings}
        return witness_at(system, component, target, **options)

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
