"""What is proved of a decomposition: lower bounds of degrees, by simple zeros on the slices.

A simple zero of all equations on a slice of codimension d lies on a component of dimension d, and
on no other, so that as many distinct ones as there are on a slice are a lower bound of the sum of
the degrees in that dimension. Components of one dimension are moved to one slice, to be told apart
there; points of those that cannot be are counted together only if other factors of the equations
vanish at them. Which points lie on one component rests on paths, not on proof.

Each statement of an export of components is proved, refuted, or said not to have been looked at.
Nothing is taken from the equations that an export says cut its components: the points are proved to
be zeros of the system.

Reference: Fulton, Intersection theory, 1998, example 8.4.6: the degrees of all components together
are at most the product of the equations' degrees.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.factoring import common_factor, factor_into_irreducibles
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.certified_points import (
    CertifiedPoints,
    Proof,
    certify_points,
    cost_row,
    distinct_simple,
    joined_boxes,
    points_rows,
)
from nag.numerics.claims import CERTIFICATE, Claim, Standing, nothing_against
from nag.numerics.krawczyk import find_overlaps
from nag.numerics.point_claims import (
    find_nonvanishing,
    is_away,
)
from nag.numerics.read_only import equal_values, fix_fields
from nag.witness.component_claims import claims_of_components
from nag.witness.frame import image
from nag.witness.moving import witness_at
from nag.witness.slices import random_rows, to_slice
from nag.witness.witness import Decomposition, Slice, WitnessSet

if TYPE_CHECKING:
    from nag.witness.certified_loops import ProvedMonodromy

# Number of the stream of random slices.
SLICES = 29
# The factor of each equation that a component lies in.
Signature = tuple[Polynomial, ...]


@dataclass(frozen=True, eq=False)
class ComponentCertificate:
    """What is proved of the witness points of one component.

    Attributes:
        component: the component, one of its orbit.
        points: what is proved of each point.
        distinct: whether all proved zeros are proved distinct.
        moved: the same points where the components of its dimension are compared; None where they
            could not be moved there.
        images: what is proved of the points of other components of its orbit, moved there; None
            for those that could not be.
    """

    component: WitnessSet
    points: CertifiedPoints
    distinct: bool
    moved: CertifiedPoints | None
    images: tuple[CertifiedPoints | None, ...] = ()

    __eq__ = equal_values

    def __post_init__(self) -> None:
        # What is worked out of points in place is done.
        fix_fields(self, done=True)

    @property
    def all_proved(self) -> bool:
        """Whether each point is proved, not on evidence, and each pair is distinct."""
        return self.points.all_proved and self.distinct

    def document(self) -> dict[str, Any]:
        """What is proved, as a JSON object."""
        return {
            "dimension": self.component.dimension,
            "degree": self.component.degree,
            "distinct": self.distinct,
            "slice": self.component.slice.document(),
            "points": self.points.document(),
            "images": [points.document() for points in self.images if points is not None],
        }


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
        surfaces: the sum of the degrees of all components of dimension ``n - 1``; None where it is
            not known.
    """

    decomposition: Decomposition
    components: tuple[ComponentCertificate, ...]
    same: tuple[tuple[int, int], ...]
    unknown: tuple[tuple[int, int], ...]
    bounds: dict[int, int]
    most: int
    surfaces: int | None

    __eq__ = equal_values

    @property
    def all_proved(self) -> bool:
        """Whether each point of each component is proved, and nothing against a component."""
        good = not self.same and not self.unknown and not self.multiple
        good = good and all(c.all_proved for c in self.components)
        return good and nothing_against(self.claims)

    @cached_property
    def claims(self) -> tuple[Claim, ...]:
        """Every statement of an export of the decomposition, and how it stands."""
        return claims_of_components(self)

    @property
    def multiple(self) -> tuple[int, ...]:
        """Indices of components that are said to be multiple and are proved not to be.

        A simple zero of all equations on the slice lies on a reduced component.
        """
        return tuple(
            i
            for i, c in enumerate(self.components)
            if c.component.is_multiple and Proof.SIMPLE in c.points.proofs
        )

    @property
    def complete(self) -> bool:
        """Whether it is proved that there are no other components."""
        return bool(self.components) and sum(self.bounds.values()) == self.most

    def rows(self, seconds: float) -> list[tuple[str, str]]:
        """What is proved, as labelled texts; ``seconds``: how long it took."""
        groups = [c.points for c in self.components]
        images = [g for c in self.components for g in c.images if g is not None]
        rows = points_rows(groups, "witness points", images)
        for dimension, bound in sorted(self.bounds.items(), reverse=True):
            if bound:
                text = f"dimension {dimension}: the degrees of all components add up to"
                rows.append(("proved", f"{text} {bound} at least"))
        if self.complete:
            text = f"proved: the degrees of all components add up to {self.most} at most"
            rows.append(("complete", text))
        elif any(c.field == "complete" and c.standing is Standing.UNSEEN for c in self.claims):
            rows.append(("complete", "not looked at here: there may be more components than these"))
        rows.append(cost_row(groups, seconds))
        return rows

    def document(
        self,
        claims: Sequence[Claim] | None = None,
        loops: Sequence[ProvedMonodromy] | None = None,
    ) -> dict[str, Any]:
        """The certificate as a JSON object.

        Args:
            claims: how the statements of an export stand, if loops say more than the certificate.
            loops: what is proved of the loops of each component.
        """
        bounds = sorted(self.bounds.items(), reverse=True)
        components = [c.document() for c in self.components]
        for component, proved in zip(components, loops or (), strict=loops is not None):
            component["loops"] = proved.document()
        return {
            **CERTIFICATE,
            "of": "decomposition",
            "system": self.decomposition.system.document(),
            "all_proved": self.all_proved and nothing_against(claims or ()),
            "complete": self.complete,
            "bound": self.most,
            "degrees": [{"dimension": d, "at_least": int(k)} for d, k in bounds],
            "components": components,
            "statements": [c.document() for c in (self.claims if claims is None else claims)],
        }


@np.errstate(over="ignore", invalid="ignore")
def certify_decomposition(decomposition: Decomposition) -> DecompositionCertificate:
    """Prove what can be proved of the witness points of all components."""
    system = decomposition.system
    equations = [f for f in system.polynomials if f]
    certificates = []
    common = _common_slices(decomposition)
    # Components of different factors are distinct; points on one slice are compared.
    apart: dict[tuple[int, Signature], dict[bytes, list[CertifiedPoints]]] = {}
    for component in decomposition.components:
        target = common[component.dimension]
        certificates.append(_certify_component(system, component, target))
        last = certificates[-1]
        here = last.points if last.moved is None else last.moved
        place = component.slice if last.moved is None else target
        counted = [(here, place), *((g, target) for g in last.images if g is not None)]
        for points, cut in counted:
            key = component.dimension, _signature(equations, points)
            on_slice = apart.setdefault(key, {}).setdefault(cut.rows.tobytes(), [])
            on_slice.append(_without_excluded(system, points, cut))
    bounds = dict.fromkeys((c.dimension for c in decomposition.components), 0)
    for (dimension, signature), slices in apart.items():
        if signature is not None:
            bounds[dimension] += max(map(distinct_simple, slices.values()))
    # The imaginary unit is a number: its equation counts nothing, nor do its powers.
    own = system.degrees[: len(system.polynomials) - system.imaginary]
    most, surfaces = prod(d for d in own if d >= 0), hypersurface_degree(system)
    if len(equations) == 1 and surfaces is not None:
        most = surfaces
    return DecompositionCertificate(
        decomposition, tuple(certificates), *_find_repeated(certificates), bounds, most, surfaces
    )


def hypersurface_degree(system: PolynomialSystem) -> int | None:
    """The sum of the degrees of all components of dimension ``n - 1``.

    They are the zeros of the common factors of the equations, but for those that are excluded. None
    where coefficients are irrational, or where all is a zero.
    """
    equations = [f for f in system.polynomials if f]
    if not equations or not all(f.exact for f in (*equations, *system.nonzero)):
        return None
    common = common_factor(equations)
    if common is None or not all(system.nonzero):
        return 0
    excluded = {p for g in system.nonzero for p, _ in factor_into_irreducibles(g)}
    return sum(p.degree for p, _ in factor_into_irreducibles(common) if p not in excluded)


def _common_slices(decomposition: Decomposition) -> dict[int, Slice]:
    """For each dimension a slice on which its components are compared: theirs, if all have one.

    A slice that is generic for one component need not be so for another.
    """
    slices: dict[int, list[Slice]] = {}
    for component in decomposition.components:
        slices.setdefault(component.dimension, []).append(component.slice)
    rng = np.random.default_rng([decomposition.seed, SLICES])
    return {
        d: found[0]
        if all(np.array_equal(cut.rows, found[0].rows) for cut in found)
        else to_slice(random_rows(rng, d, decomposition.system.n))
        for d, found in slices.items()
    }


def _certify_component(
    system: PolynomialSystem, component: WitnessSet, target: Slice
) -> ComponentCertificate:
    """What is proved of a component, on its slice and on that of its dimension."""
    points = certify_witness_points(system, component)
    same, unknown = find_overlaps(points.boxes)
    bare = replace(component, fibres=())
    there = [_certify_moved(system, bare, target, points)]
    for symmetry in component.images:
        there.append(_certify_moved(system, image(bare, symmetry), target))
    return ComponentCertificate(
        component, points, not (same or unknown), there[0], tuple(there[1:])
    )


def _certify_moved(
    system: PolynomialSystem,
    component: WitnessSet,
    target: Slice,
    points: CertifiedPoints | None = None,
) -> CertifiedPoints | None:
    """What is proved of a component's points on another slice; None where they are not found there.

    Nothing is taken from where it was but where to begin: its points are proved there.

    Args:
        points: what is proved of it on its own slice, where that is known.
    """
    if not component.dimension or np.array_equal(component.slice.rows, target.rows):
        return certify_witness_points(system, component) if points is None else points
    try:
        there = witness_at(system, component, target)
    except ValueError:
        return None
    return certify_witness_points(system, there)


def _without_excluded(
    system: PolynomialSystem, points: CertifiedPoints, cut: Slice
) -> CertifiedPoints:
    """The points, those unproved where something may vanish that must not."""
    if not system.nonzero:
        return points
    equations = [f for f in system.polynomials if f]
    away = find_nonvanishing(system.nonzero, equations, cut.rows, points)
    proofs = [p if a else Proof.NONE for p, a in zip(points.proofs, away, strict=True)]
    return replace(points, proofs=tuple(proofs))


def _find_repeated(
    certificates: Sequence[ComponentCertificate],
) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Pairs of components with a zero in common on one slice, and perhaps with one."""
    same, unknown = set(), set()
    dimensions: dict[int, list[int]] = {}
    for i, c in enumerate(certificates):
        dimensions.setdefault(c.component.dimension, []).append(i)
    # On a generic slice components of one dimension have no point in common.
    proofs = [p for p in Proof if p is not Proof.NONE]
    for members in dimensions.values():
        there = [(i, g) for i in members for g in (certificates[i].moved, *certificates[i].images)]
        there = [(i, g) for i, g in there if g is not None]
        if not there:
            continue
        owners = [(i, k) for k, (i, g) in enumerate(there) for _ in g.having(*proofs)]
        for pairs, found in zip(
            (same, unknown),
            find_overlaps(joined_boxes([g for _, g in there], *proofs)),
            strict=True,
        ):
            pairs |= {
                (owners[i][0], owners[j][0]) for i, j in found if owners[i][1] != owners[j][1]
            }
    return tuple(sorted(same)), tuple(sorted(unknown))


@np.errstate(over="ignore", invalid="ignore")
def certify_witness_points(system: PolynomialSystem, component: WitnessSet) -> CertifiedPoints:
    """What is proved of a component's points on its slice."""
    singular = np.full(component.degree, component.corank > component.dimension)
    rows, errors = component.slice.rows, component.errors
    return certify_points(system.polynomials, rows, component.points, errors, singular)


def _signature(equations: Sequence[Polynomial], points: CertifiedPoints) -> Signature | None:
    """The one factor of each equation that vanishes at the points; None if that is not proved.

    Only that of the component can, where the points are not on another one as well.
    """
    chosen = points.having(Proof.SIMPLE)
    signature = []
    for f in equations:
        factors = [p for p, _ in factor_into_irreducibles(f)]
        if len(factors) > 1:
            factors = [p for p in factors if not is_away(p, points, chosen)]
        if len(factors) != 1:
            return None
        signature.append(factors[0])
    return tuple(signature)
