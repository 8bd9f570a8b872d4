"""What is proved of a decomposition: lower bounds of degrees, by simple zeros on the slices.

A simple zero of all equations on a slice of codimension d lies on a component of dimension d, and
on no other, so that as many distinct ones as there are on a slice are a lower bound of the sum of
the degrees in that dimension. On different slices only points of different factors of the equations
are counted together. Which of them lie on one component rests on paths, not on proof.

Reference: Fulton, Intersection theory, 1998, example 8.4.6: the degrees of all components together
are at most the product of the equations' degrees.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import prod

import numpy as np

from nag.algebra.factoring import factored
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.box_relations import overlaps
from nag.numerics.certified_points import (
    CertifiedPoints,
    Proof,
    certify_points,
    distinct_simple,
    joined_boxes,
)
from nag.numerics.discs import DiscPolynomials, Discs
from nag.witness.frame import image
from nag.witness.moving import SliceError, witness_at
from nag.witness.witness import Decomposition, Slice, WitnessSet

# The factor of each equation that a component lies in.
Signature = tuple[Polynomial, ...]


@dataclass(frozen=True, eq=False)
class ComponentCertificate:
    """What is proved of the witness points of one component.

    Attributes:
        component: the component, one of its orbit.
        points: what is proved of each point.
        distinct: whether all proved zeros are proved distinct.
        images: what is proved of the points of other components of its orbit, moved to its slice;
            those that could not be moved are missing.
    """

    component: WitnessSet
    points: CertifiedPoints
    distinct: bool
    images: tuple[CertifiedPoints, ...] = ()

    @property
    def all_proved(self) -> bool:
        """Whether each point is proved, not on evidence, and each pair is distinct."""
        return self.points.all_proved and self.distinct


@dataclass(frozen=True, eq=False)
class DecompositionCertificate:
    """What is proved of a decomposition.

    Attributes:
        decomposition: the components.
        components: what is proved of each.
        same, unknown: pairs of indices of components of which points, as they are written, lead to
            one zero, and of which points were not told apart.
        bounds: by dimension, a number that the sum of the degrees of the components of that
            dimension is proved not to be below.
        most: the sum of the degrees of all components is at most this.
    """

    decomposition: Decomposition
    components: tuple[ComponentCertificate, ...]
    same: tuple[tuple[int, int], ...]
    unknown: tuple[tuple[int, int], ...]
    bounds: dict[int, int]
    most: int

    @property
    def all_proved(self) -> bool:
        """Whether each point of each component is proved, and nothing against a component."""
        good = not self.same and not self.unknown and not self.multiple
        return good and all(c.all_proved for c in self.components)

    @property
    def multiple(self) -> tuple[int, ...]:
        """Indices of components that are said to be multiple and are proved not to be.

        A simple zero of all equations on the slice lies on a reduced component.
        """
        return tuple(
            i
            for i, c in enumerate(self.components)
            if c.component.multiplicity > 1 and Proof.SIMPLE in c.points.proofs
        )

    @property
    def complete(self) -> bool:
        """Whether it is proved that there are no other components."""
        return bool(self.components) and sum(self.bounds.values()) == self.most


def certify_decomposition(decomposition: Decomposition) -> DecompositionCertificate:
    """Prove what can be proved of the witness points of all components."""
    system = decomposition.system
    equations = [f for f in system.polynomials if f]
    certificates = []
    # Components of different factors are distinct; points on one slice are compared.
    apart: dict[tuple[int, Signature], dict[bytes, list[CertifiedPoints]]] = {}
    for component in decomposition.components:
        points = _proved(equations, component, component.slice)
        images = tuple(_proved(equations, c, component.slice) for c in _others(system, component))
        same, unknown = overlaps(points.boxes)
        distinct = not same and not unknown
        certificates.append(ComponentCertificate(component, points, distinct, images))
        for each in (points, *images):
            key = component.dimension, _signature(equations, each)
            on_slice = apart.setdefault(key, {}).setdefault(component.slice.rows.tobytes(), [])
            on_slice.append(each)
    bounds = dict.fromkeys((c.dimension for c in decomposition.components), 0)
    for (dimension, signature), slices in apart.items():
        if signature is not None:
            bounds[dimension] += max(map(distinct_simple, slices.values()))
    most = prod(f.degree for f in equations)
    repeated = _repeated(certificates)
    return DecompositionCertificate(decomposition, tuple(certificates), *repeated, bounds, most)


def _repeated(
    certificates: Sequence[ComponentCertificate],
) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Pairs of components with a zero in common that lies on one only, and perhaps with one."""
    same, unknown = set(), set()
    slices: dict[bytes, list[int]] = {}
    for i, c in enumerate(certificates):
        slices.setdefault(c.component.slice.rows.tobytes(), []).append(i)
    for members in slices.values():
        # A singular zero on a slice may lie on two components, an isolated one is one itself.
        isolated = not certificates[members[0]].component.dimension
        proofs = [Proof.SIMPLE, Proof.PART]
        proofs += [Proof.DEFLATED, Proof.EXACT] if isolated else []
        groups = [certificates[i].points for i in members]
        owners = [i for i, g in zip(members, groups, strict=True) for _ in g.having(*proofs)]
        for pairs, found in zip(
            (same, unknown), overlaps(joined_boxes(groups, *proofs)), strict=True
        ):
            pairs |= {(owners[i], owners[j]) for i, j in found if owners[i] != owners[j]}
    return tuple(sorted(same)), tuple(sorted(unknown))


def _proved(equations: Sequence[Polynomial], component: WitnessSet, cut: Slice) -> CertifiedPoints:
    singular = np.full(component.degree, component.corank > component.dimension)
    return certify_points(equations, cut.rows, component.points, component.errors, singular)


def _others(system: PolynomialSystem, component: WitnessSet) -> list[WitnessSet]:
    """The other components of an orbit, on the slice of the one that is reported.

    Nothing is taken from their symmetries but where to begin: their points are proved there.
    """
    found = []
    for symmetry in component.images:
        there = image(component, symmetry)
        try:
            moved = witness_at(system, there, component.slice) if component.dimension else there
        except SliceError:
            continue
        found.append(moved)
    return found


def _signature(equations: Sequence[Polynomial], points: CertifiedPoints) -> Signature | None:
    """The one factor of each equation that vanishes at the points; None if that is not proved.

    Only that of the component can, where the points are not on another one as well.
    """
    boxes, chosen = points.boxes, points.having(Proof.SIMPLE)
    inner = Discs(boxes.centres[chosen], boxes.inner[chosen])
    signature = []
    for f in equations:
        factors = [p for p, _ in factored(f)]
        if len(factors) > 1:
            factors = [p for p in factors if not _away(p, inner)]
        if len(factors) != 1:
            return None
        signature.append(factors[0])
    return tuple(signature)


def _away(f: Polynomial, boxes: Discs) -> bool:
    """Whether a polynomial is proved to have no zero in any of the boxes."""
    try:
        system = DiscPolynomials.of([f], np.zeros((0, 1 + f.n), dtype=complex))
    except OverflowError:
        return False
    with np.errstate(all="ignore"):
        values = system(boxes)
        return bool((np.abs(values.mid) > 2 * values.rad).all())
