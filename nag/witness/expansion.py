"""All components of a decomposition that reports one of each orbit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.algebra.symmetry import SignedPermutation
from nag.witness.close_points import Fine
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.witness import Decomposition, Slice, WitnessSet


def image(component: WitnessSet, symmetry: SignedPermutation) -> WitnessSet:
    """The witness set that a symmetry carries a component to, on the image of its slice.

    Exact: coordinates are exchanged and change sign, nothing is computed.
    """
    cut = Slice(symmetry.of_point(component.slice.A), component.slice.b)
    points = symmetry.of_point(component.points)
    fibres = tuple(_image(fibre, symmetry) for fibre in component.fibres)
    radii = np.abs(symmetry.of_point(component.radii))
    return replace(
        component, slice=cut, points=points, radii=radii, orbit=1, images=(), fibres=fibres
    )


def _image(fibre: Fibre, symmetry: SignedPermutation) -> Fibre:
    """A fibre's points and equations, added unknowns left as they are."""
    n, aux = fibre.cut.n, fibre.cut.aux
    back = symmetry.inverse
    whole = SignedPermutation((*back.sources, *range(n, n + aux)), (*back.signs, *([1] * aux)))
    polynomials = tuple(whole.of_polynomial(f) for f in fibre.cut.polynomials)
    points = np.hstack([symmetry.of_point(fibre.x), fibre.points[:, n:]])
    fine = {i: _image_of_fine(each, symmetry, n) for i, each in fibre.fine.items()}
    return Fibre(Cut(n, aux, polynomials), fibre.dimension, points, fine)


def _image_of_fine(point: Fine, symmetry: SignedPermutation, n: int) -> Fine:
    moved = np.moveaxis(symmetry.of_point(np.moveaxis(point.words[:n], 0, -1)), -1, 0)
    return Fine(np.concatenate([moved, point.words[n:]]), point.curvature)


def expanded(decomposition: Decomposition) -> Decomposition:
    """The same decomposition with all components of each orbit, every one on a slice of its own.

    Orbits whose symmetries are not known are left as they are.
    """
    components: list[WitnessSet] = []
    for component in decomposition.components:
        if len(component.images) != component.orbit - 1:
            components.append(component)
            continue
        components.append(replace(component, orbit=1, images=()))
        components += [image(component, symmetry) for symmetry in component.images]
    return replace(decomposition, components=tuple(components))
