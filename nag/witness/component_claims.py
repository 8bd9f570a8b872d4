"""What an export of components says, field by field, and what is proved of it."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import LARGEST, MOST_MONOMIALS, most_zeros
from nag.numerics.certified_points import Proof
from nag.numerics.claims import (
    Claim,
    Standing,
    claim_of_all,
    claim_of_number,
    claims_not_looked_at,
    claims_of_each,
    combine_standings,
    name_entries,
    records,
)
from nag.numerics.point_claims import (
    corank_standings,
    error_standings,
    multiplicity_standings,
    nonzero_standings,
    zero_standings,
)
from nag.numerics.zero_values import ON
from nag.witness.witness import Status, WitnessSet

if TYPE_CHECKING:
    from nag.witness.certificate import ComponentCertificate, DecompositionCertificate

ONE_COMPONENT = "that its points lie on one irreducible component"
ALL_POINTS = "that it has no more points on its slice"
# What an export says of how the components came about, and what doubles made of the points:
# nothing that is proved rests on it.
OF_THE_RUN = (
    "case",
    "formulation",
    "reason",
    "seed",
    "settings",
    "paths",
    "method",
    "order",
    "notes",
)
# Number of the stream of random linear spaces.
SLICED = 31
OF_ARITHMETIC = ("residual", "precision", "digits")


def claims_of_components(certificate: DecompositionCertificate) -> tuple[Claim, ...]:
    """Every statement of an export of a decomposition, and how it stands."""
    decomposition = certificate.decomposition
    claims = [
        claim
        for k, c in enumerate(certificate.components)
        for claim in _claims_of(decomposition.system, c, k)
    ]
    pairs = ((certificate.same, Standing.DOUBTED), (certificate.unknown, Standing.OPEN))
    for found, standing in pairs:
        if found:
            i, j = found[0]
            text = "that they are two components"
            claims.append(Claim("components", text, standing, name_entries("component", [i, j])))
    claims.append(_completeness(certificate))
    text = "whether they follow from the system: no proof rests on them"
    claims += claims_not_looked_at(["equations"], text)
    claims += records(["system"], "that these are the equations of the case")
    claims += records(OF_THE_RUN, "how the components were found")
    return tuple(claims)


def _claims_of(system: PolynomialSystem, certificate: ComponentCertificate, k: int) -> list[Claim]:
    """What is said of one component."""
    component, points = certificate.component, certificate.points
    equations, rows = [f for f in system.polynomials if f], component.slice.rows
    zeros = zero_standings(points)
    errors = error_standings(equations, rows, points, component.radii)
    d, m, corank = component.dimension, component.multiplicity, component.corank
    said = {
        "points": ("that its points are zeros on the slice", zeros),
        "dimension": (f"that its dimension is {d}, by its points", zeros),
        "multiplicity": (
            f"that its multiplicity is {m or 'not known'}",
            multiplicity_standings(points, [m or 0] * component.degree),
        ),
        "radii": ("that its points are no further from zeros than these", errors),
        "accuracy": ("that this is the largest error of its points", errors),
        "corank": (
            f"that its corank is {corank}",
            corank_standings(equations, rows, points, corank),
        ),
    }
    name = name_entries("component", [k])
    claims = [
        claim_of_all(f"components[].{field}", text, standings, name, "point")
        for field, (text, standings) in said.items()
    ]
    if system.nonzero:
        standings = nonzero_standings(system.nonzero, equations, rows, points)
        text = "that nothing that must not vanish does so on it"
        claims.append(claim_of_all("system.nonzero", text, standings, name, "point"))
    claims += [*_irreducibility(certificate, name), *_orbit(certificate, name)]
    if certificate.moved is None:
        text = "that it is none of the others of its dimension"
        claims.append(Claim("components", text, Standing.OPEN, name))
    claims.append(_cut_by(component, name))
    text = "that its slice is a generic one"
    claims += claims_not_looked_at(["components[].slice"], text, name)
    if component.multidegree is not None and component.dimension:
        text = "its degrees in groups of variables"
        claims += claims_not_looked_at(["components[].multidegree"], text, name)
    fields = [f"components[].{field}" for field in (*OF_ARITHMETIC, "note")]
    return [*claims, *records(fields, "what doubles made of its points", name)]


def _irreducibility(certificate: ComponentCertificate, name: str) -> list[Claim]:
    """That all points lie on one irreducible component, and are all its points on the slice."""
    component, claims = certificate.component, []
    if not certificate.distinct:
        text = "that its points are distinct"
        claims.append(Claim("components[].degree", text, Standing.OPEN, name))
    one = ONE_COMPONENT
    if component.dimension and component.degree:
        status, degree = Standing.UNSEEN, Standing.UNSEEN
    elif component.degree == 1:
        status = degree = combine_standings(zero_standings(certificate.points))
    else:
        distinct = certificate.distinct and Proof.NONE not in certificate.points.proofs
        status = degree = Standing.REFUTED if distinct else Standing.OPEN
    if component.status is Status.UNDECIDED:
        one, status = "it is not said to be irreducible", Standing.UNSEEN
    claims.append(Claim("components[].status", one, status, name))
    return [*claims, Claim("components[].degree", ALL_POINTS, degree, name)]


def claims_of_loops(
    certificate: DecompositionCertificate,
    connected: Sequence[bool],
    linear: Sequence[bool | None],
) -> tuple[Claim, ...]:
    """The statements again, where loops and traces of the components are known.

    Args:
        connected: whether the points of a component are proved to lie on one; linear: whether their
            trace is linear, to many digits, so that no point of it is missing; None where that was
            not decided.
    """
    claims = list(certificate.claims)
    for k, c in enumerate(certificate.components):
        if not (c.component.dimension and c.component.degree):
            continue
        name = name_entries("component", [k])
        trace = {True: Standing.EVIDENCE, False: Standing.DOUBTED, None: Standing.OPEN}[linear[k]]
        again = [Claim("components[].degree", ALL_POINTS, trace, name)]
        if c.component.status is Status.IRREDUCIBLE:
            zeros = combine_standings(zero_standings(c.points))
            status = zeros if connected[k] else Standing.OPEN
            again.append(Claim("components[].status", ONE_COMPONENT, status, name))
        said = [(x.field, x.text, x.subject) for x in again]
        claims = [x for x in claims if (x.field, x.text, x.subject) not in said] + again
    return tuple(claims)


def _orbit(certificate: ComponentCertificate, name: str) -> list[Claim]:
    """That symmetries carry the component into others of its orbit."""
    component, field = certificate.component, "components[].orbit"
    if component.orbit == 1:
        return claims_not_looked_at([field], "that symmetries carry it into no other", name)
    if not component.images:
        text = f"its {component.orbit - 1} images are not in the file"
        return claims_not_looked_at([field], text, name)
    standings = [
        Standing.UNSEEN if points is None else combine_standings(zero_standings(points))
        for points in certificate.images
    ]
    text = "that symmetries carry it into components"
    return claims_of_each(field, text, standings, f"{name}, image")


def _cut_by(component: WitnessSet, name: str) -> Claim:
    """That equations cut the component: that they vanish at its points is seen in doubles only."""
    for fibre in component.fibres:
        values = fibre.cut.evaluator.residuals(fibre.points)
        if not (values <= ON).all():
            text = "that these equations cut it"
            return Claim("components[].cut_by", text, Standing.DOUBTED, name)
    text = "the equations that cut it, on which no proof rests"
    return Claim("components[].cut_by", text, Standing.UNSEEN, name)


def _completeness(certificate: DecompositionCertificate) -> Claim:
    """That the components are all, by the bound of their degrees, or the common factors'."""
    found = certificate.decomposition
    if not found.complete:
        return Claim("complete", "the components are not said to be all", Standing.UNSEEN)
    text = "that there are no more components"
    if certificate.complete:
        return Claim("complete", text, Standing.PROVED)
    d, surfaces = found.system.n - 1, certificate.surfaces or 0
    listed = sum(c.degree * c.orbit for c in found.components if c.dimension == d)
    if listed < surfaces:
        text += f": in dimension {d} their degrees add up to {surfaces}, not to {listed}"
        return Claim("complete", text, Standing.REFUTED)
    return (
        _claim_number(certificate, text)
        or _claim_on_slices(certificate, text)
        or Claim("complete", text, Standing.UNSEEN)
    )


def _claim_number(certificate: DecompositionCertificate, text: str) -> Claim | None:
    """The same where there are finitely many zeros, by their number."""
    if any(c.component.dimension or c.component.orbit > 1 for c in certificate.components):
        return None
    system = certificate.decomposition.system
    known = [m for c in certificate.components for m in c.points.multiplicities.tolist()]
    if system.nonzero or certificate.same or certificate.unknown or not all(known):
        return None
    count = most_zeros(system.polynomials, -1, False)
    return claim_of_number(text, sum(known), count, system.imaginary)


def _claim_on_slices(certificate: DecompositionCertificate, text: str) -> Claim | None:
    """That a component is missing of the largest dimension or a larger one; None if it is not seen.

    On a random linear space of codimension k there are as many zeros, by their multiplicities, as
    the degrees of the components of dimension k add up to, where there is none of a larger one.
    """
    found = certificate.decomposition
    system, own = found.system, len(found.system.own_variables)
    if system.nonzero or certificate.same or certificate.unknown:
        return None
    top = max((c.dimension for c in found.components), default=0)
    for k in range(own - 1, max(top, 1) - 1, -1):
        known = [
            (c.component.orbit, m)
            for c in certificate.components
            if c.component.dimension == k
            for m in c.points.multiplicities.tolist()
        ]
        if not all(m for _, m in known):
            return None
        rng = np.random.default_rng([found.seed, SLICED, k])
        on_slice = _on_random_space(system, own - k, rng)
        count = None if on_slice is None else most_zeros(on_slice, -1, False)
        if count is None:
            return None
        said = f"{text}: on a random linear space of codimension {k}"
        listed = sum(orbit * m for orbit, m in known)
        claim = claim_of_number(said, listed, count, system.imaginary)
        if claim is not None and claim.standing is not Standing.EVIDENCE:
            return claim
    return None


def _on_random_space(
    system: PolynomialSystem, dimension: int, rng: np.random.Generator
) -> list[Polynomial] | None:
    """The equations on a random rational linear space; None where they would be too long."""
    own, n = len(system.own_variables), dimension + system.imaginary
    degree = max((f.degree for f in system.polynomials), default=0)
    if not all(f.algebraic for f in system.polynomials) or comb(n + degree, n) > MOST_MONOMIALS:
        return None
    coordinates = Polynomial.variables(n)
    images = []
    for row in rng.integers(-LARGEST, LARGEST, (own, dimension + 1)).tolist():
        place = Polynomial.constant(n, row[-1])
        for a, x in zip(row[:-1], coordinates, strict=False):
            place = place + a * x
        images.append(place)
    images += coordinates[dimension:]
    return [f.compose(images) for f in system.polynomials]
