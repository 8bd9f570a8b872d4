"""What an export of solutions says, field by field, and what is proved of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.imaginary_unit import has_unit
from nag.algebra.system import PolynomialSystem
from nag.algebra.zero_count import most_zeros
from nag.numerics.array_table import map_rows
from nag.numerics.certified_points import (
    CertifiedPoints,
    Proof,
    certify_regular_points,
    joined_boxes,
)
from nag.numerics.claims import (
    Claim,
    Standing,
    claim_of_number,
    claims_not_looked_at,
    claims_of_each,
    name_entries,
    records,
)
from nag.numerics.krawczyk import find_overlaps, tell_real_zeros
from nag.numerics.point_claims import (
    error_standings,
    find_nonvanishing,
    multiplicity_standings,
    nonzero_standings,
    zero_standings,
)
from nag.solving.path_ends import NEARLY
from nag.solving.solutions import Solution, Solutions, SolveResult
from nag.tracking.blocks import share

if TYPE_CHECKING:
    from nag.solving.certificate import SolutionsCertificate

# What an export says of how the solutions came about, and of their arithmetic: nothing that is
# proved rests on it.
OF_THE_RUN = ("case", "seed", "settings", "method", "start", "reason", "notes", "paths")
OF_ARITHMETIC = ("residual", "condition", "precision")
LISTS = {"solutions": "solution", "excluded_solutions": "excluded solution"}


def claims_of_solutions(certificate: SolutionsCertificate) -> tuple[Claim, ...]:
    """Every statement of an export of solutions, and how it stands."""
    result = certificate.result
    claims = _claims_of_points("solutions", certificate.points, result.solutions, result.system)
    claims += _claims_of_points(
        "excluded_solutions", certificate.excluded, result.excluded_solutions, result.system
    )
    claims += [*_pairs(certificate), *_exclusions(certificate), *_ends(result)]
    claims.append(_completeness(certificate))
    claims += records(["system"], "that these are the equations of the case")
    claims += records(OF_THE_RUN, "how the solutions were found")
    for key in LISTS:
        if getattr(result, key):
            fields = [f"{key}[].{name}" for name in OF_ARITHMETIC]
            claims += records(fields, "what doubles made of the points")
    return tuple(claims)


def _claims_of_points(
    key: str, points: CertifiedPoints, solutions: Sequence[Solution], system: PolynomialSystem
) -> list[Claim]:
    """What is said of each of the solutions in a list."""
    equations = [f for f in system.polynomials if f]
    none = np.zeros((0, 1 + system.n), dtype=complex)
    said = Solutions.of(solutions, system.n)
    multiplicities, real = said.multiplicity.tolist(), said.real.tolist()
    # One text for all of which the same is said: there may be 10^6.
    of_number = {m: f"that its multiplicity is {m}" for m in set(multiplicities)}
    of_reality = {True: "that it is real", False: "that it is not real"}
    # Points that are no solutions may be of any size.
    with np.errstate(all="ignore"):
        sizes = 1 + map_rows(lambda some: np.linalg.norm(some, axis=1), points.points)
        radii = said.accuracy * sizes
    radii = np.broadcast_to(radii[:, None], points.points.shape)
    found = {
        "point": ("that its point is a zero of the equations", zero_standings(points)),
        "multiplicity": (
            [of_number[m] for m in multiplicities],
            multiplicity_standings(points, multiplicities),
        ),
        "accuracy": (
            "that its point is no further from a zero than it says",
            error_standings(equations, none, points, radii, share),
        ),
        "real": ([of_reality[r] for r in real], _reality(points, real, system)),
    }
    return [
        claim
        for field, (text, standings) in found.items()
        for claim in claims_of_each(f"{key}[].{field}", text, standings, LISTS[key])
    ]


def _reality(
    points: CertifiedPoints, said: Sequence[bool], system: PolynomialSystem
) -> list[Standing]:
    """That zeros are real, or are not."""
    real, not_real = tell_real_zeros(points.boxes, system)
    real |= points.real
    found = []
    for i, (claimed, evidence) in enumerate(zip(said, points.on_evidence, strict=True)):
        # Of deflated equations the zero is the only one in its box, of the given ones it need not.
        rests = evidence and points.proofs[i] is Proof.DEFLATED
        if (real if claimed else not_real)[i]:
            found.append(Standing.EVIDENCE if evidence else Standing.PROVED)
        elif (not_real if claimed else real)[i]:
            found.append(Standing.DOUBTED if rests else Standing.REFUTED)
        else:
            found.append(Standing.OPEN)
    return found


def _pairs(certificate: SolutionsCertificate) -> list[Claim]:
    """That the entries of each list are distinct."""
    claims = []
    for key, (same, unknown) in {
        "solutions": (certificate.same, certificate.unknown),
        "excluded_solutions": find_overlaps(certificate.excluded.boxes),
    }.items():
        for pairs, standing in ((same, Standing.REFUTED), (unknown, Standing.OPEN)):
            if pairs:
                i, j = pairs[0]
                text = "that they are two zeros"
                subject = name_entries(LISTS[key], [i, j])
                claims.append(Claim(f"{key}[].point", text, standing, subject))
    return claims


def _exclusions(certificate: SolutionsCertificate) -> list[Claim]:
    """That nothing that must not vanish does so at solutions, and something at those left out."""
    result, system, claims = certificate.result, certificate.result.system, []
    equations = [f for f in system.polynomials if f]
    none = np.zeros((0, 1 + system.n), dtype=complex)
    if system.nonzero and result.solutions:
        standings = nonzero_standings(system.nonzero, equations, none, certificate.points)
        text = "that nothing that must not vanish does so there"
        claims += claims_of_each("system.nonzero", text, standings, "solution")
    opposite = {
        Standing.PROVED: Standing.REFUTED,
        Standing.REFUTED: Standing.PROVED,
        Standing.DOUBTED: Standing.EVIDENCE,
    }
    if result.excluded_solutions:
        standings = nonzero_standings(system.nonzero, equations, none, certificate.excluded)
        standings = [opposite.get(each, each) for each in standings]
        text = "that something that must not vanish does so there"
        claims += claims_of_each("excluded_solutions", text, standings, "excluded solution")
    known = len(result.excluded_solutions)
    if result.excluded and not known:
        claims += claims_not_looked_at(
            ["excluded"], f"{result.excluded} solutions left out are not in the file"
        )
    else:
        agree = Standing.PROVED if result.excluded == known else Standing.REFUTED
        text = f"that it is {result.excluded}, as many as are listed"
        claims.append(Claim("excluded", text, agree))
    return claims


def _ends(result: SolveResult) -> list[Claim]:
    """What is said of ends that are no isolated solutions, or may not be."""
    evaluator = Evaluator.of([f for f in result.system.polynomials if f], result.system.n)
    none = np.zeros((0, 1 + result.system.n), dtype=complex)
    claims = []
    for key, text in (
        ("on_components", "that it is on a set of positive dimension"),
        ("on_excluded", "that it is on a set of positive dimension, all of which is left out"),
        ("on_doubtful", "that it is on a set of positive dimension, which may be left out"),
        ("undecided", "that it is a solution, isolated or not"),
    ):
        ends = np.asarray(getattr(result, key), dtype=complex)
        if not len(ends):
            claims += claims_not_looked_at([key], "that there are no such ends of paths")
            continue
        zeros = evaluator.residuals(ends).max(axis=1, initial=0.0) <= NEARLY
        found = certify_regular_points(result.system.polynomials, none, ends, np.zeros(len(ends)))
        isolated = found.boxes.proved if key != "undecided" else np.zeros(len(ends), dtype=bool)
        standings = [
            Standing.UNSEEN if zero and not alone else Standing.DOUBTED
            for zero, alone in zip(zeros, isolated, strict=True)
        ]
        claims += claims_of_each(key, text, standings, f"{key}, point")
    return claims


def _completeness(certificate: SolutionsCertificate) -> Claim:
    """That the solutions are all isolated ones, by Bezout's number or a count of all zeros."""
    result = certificate.result
    text = "that there are no more isolated solutions"
    if not result.complete:
        return Claim("complete", "the solutions are not said to be all", Standing.UNSEEN)
    if certificate.complete:
        return Claim("complete", text, Standing.PROVED)
    others = np.flatnonzero(certificate.solutions_left_out).tolist()
    if others:
        text = f"{text}: {name_entries(LISTS['excluded_solutions'], others)}"
        return Claim("complete", text, Standing.REFUTED)
    left_out = result.excluded and not result.excluded_solutions
    listed = _zeros_by_multiplicity(certificate)
    count = None if left_out or listed is None else most_zeros(result.system.polynomials, -1, False)
    imaginary = result.system.imaginary
    counted = None if listed is None else claim_of_number(text, listed, count, imaginary)
    return counted or Claim("complete", text, Standing.UNSEEN)


def _zeros_by_multiplicity(certificate: SolutionsCertificate) -> int | None:
    """The number of the zeros that are listed, if they are known to be zeros, and distinct."""
    groups = certificate.points, certificate.excluded
    known = all((g.multiplicities > 0).all() for g in groups)
    if not (known and certificate.distinct):
        return None
    return sum(int(g.multiplicities.sum()) for g in groups)


def claims_of_paths(certificate: SolutionsCertificate, others: np.ndarray) -> tuple[Claim, ...]:
    """The statements again, where proved paths are known to end in other points as well.

    Args:
        others: these, shape ``(k, n)``.
    """
    system = certificate.result.system
    if system.imaginary:
        others = others[has_unit(others)]
    none = np.zeros((0, 1 + system.n), dtype=complex)
    found = certify_regular_points(system.polynomials, none, others, np.zeros(len(others)))
    equations = [f for f in system.polynomials if f]
    away = find_nonvanishing(system.nonzero, equations, none, found)
    missing = {
        Standing.REFUTED: _distinct_from(certificate, found, away, Proof.SIMPLE),
        Standing.DOUBTED: _distinct_from(certificate, found, away, Proof.PART),
    }
    for standing, count in missing.items():
        if count and certificate.result.complete:
            text = f"that there are no more isolated solutions: paths lead to {count} more"
            rest = [c for c in certificate.claims if c.field != "complete"]
            return (*rest, Claim("complete", text, standing))
    return certificate.claims


def _distinct_from(
    certificate: SolutionsCertificate, found: CertifiedPoints, away: np.ndarray, proof: Proof
) -> int:
    """Number of zeros with a proof that are distinct, and none of those listed, by proof."""
    known = [certificate.points, certificate.excluded]
    proofs = [p for p in Proof if p is not Proof.NONE]
    listed = joined_boxes(known, *proofs)
    first, chosen = len(listed.centres), found.having(proof)
    together = joined_boxes([*known, found], *proofs)
    everything = found.having(*proofs).tolist()
    same, unknown = find_overlaps(together)
    taken = {max(pair) for pair in [*same, *unknown]}
    return sum(bool(away[i]) and first + everything.index(i) not in taken for i in chosen.tolist())
