"""Certificates as text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np

from nag.numerics.certified_points import CertifiedPoints, Proof
from nag.numerics.claims import Claim, Standing
from nag.numerics.point_claims import zero_digits
from nag.solving.certificate import SolutionsCertificate
from nag.solving.certified_paths import ProvedPaths
from nag.text.table import magnitude, printable
from nag.witness.certificate import DecompositionCertificate
from nag.witness.certified_loops import ProvedMonodromy

Rows = list[tuple[str, str]]
# Fields of one line, and what stands before statements that are not true, or not known to be.
FIELDS_IN_A_LINE = 6
LABELS = {Standing.REFUTED: "refuted", Standing.DOUBTED: "doubt", Standing.OPEN: "open"}

WORDS = {
    Proof.SIMPLE: "simple zeros of all equations, one in each box",
    Proof.PART: "simple zeros of as many equations as unknowns, the others vanishing there to "
    "{digits}",
    Proof.DEFLATED: "singular, as simple zeros of as many deflated equations as unknowns, the "
    "others vanishing there to {digits}",
    Proof.EXACT: "singular, as exact rational zeros",
    Proof.NONE: "not proved",
}


def solution_rows(certificate: SolutionsCertificate, seconds: float) -> Rows:
    """What is proved of solutions, as labelled lines."""
    points, proved = certificate.points, certificate.points.boxes.proved
    rows = _points_rows([points], "solutions")
    evidence = points.on_evidence
    sides = certificate.real, certificate.not_real
    real, complex_ = (int((side & ~evidence).sum()) for side in sides)
    text = f"{real} proved real, {complex_} proved not real"
    open_ = int((proved & ~sides[0] & ~sides[1]).sum())
    rows.append(("reality", text + (f", {open_} open" if open_ else "")))
    if evidence.any():
        real, complex_ = (int((side & evidence).sum()) for side in sides)
        rows.append(("", f"on evidence {real} real, {complex_} not real"))
    if certificate.distinct:
        rows.append(("distinct", "the zeros in the boxes are proved to be distinct"))
    rows += _excluded_rows(certificate)
    if certificate.bound is not None:
        number = f"{certificate.bound_name}, {certificate.bound}"
        text = f"proved: there are no more isolated zeros than {number}"
        if not certificate.complete:
            text = f"not proved: {certificate.zeros} simple zeros are proved"
            if certificate.solutions_left_out.any():
                text += ", among them solutions that are said to be excluded"
            text += f"; there are no more than {number}"
        rows.append(("complete", text))
    rows.append(_cost([points], seconds))
    return rows


def _excluded_rows(certificate: SolutionsCertificate) -> Rows:
    """What is proved of the zeros where something vanishes that must not."""
    left_out = certificate.excluded
    chosen = left_out.boxes.proved & ~certificate.solutions_left_out
    if not chosen.any():
        return []
    system = certificate.result.system
    equations = [f for f in system.polynomials if f]
    digits = zero_digits(system.nonzero, equations, left_out)[chosen].min()
    text = (
        f"{chosen.sum()} more zeros of the equations are proved, where something that must not "
        f"vanish does to {digits:.0f} digits"
    )
    return [("excluded", text)]


def decomposition_rows(certificate: DecompositionCertificate, seconds: float) -> Rows:
    """What is proved of a decomposition, as labelled lines."""
    groups = [c.points for c in certificate.components]
    images = [g for c in certificate.components for g in c.images if g is not None]
    rows = _points_rows(groups, "witness points", images)
    for dimension, bound in sorted(certificate.bounds.items(), reverse=True):
        if bound:
            text = (
                f"dimension {dimension}: the degrees of all components add up to {bound} at least"
            )
            rows.append(("proved", text))
    if certificate.complete:
        text = f"proved: the degrees of all components add up to {certificate.most} at most"
        rows.append(("complete", text))
    rows.append(_cost(groups, seconds))
    return rows


def paths_rows(proved: ProvedPaths, found: int, seconds: float) -> Rows:
    """What is proved of the paths to so many solutions, as labelled lines."""
    total, ends, largest = len(proved.reached), len(proved.solutions), proved.reached.max(initial=0)
    text = (
        f"{total - proved.lost} of {total} proved from t = 1 on; {proved.arrived} end in simple "
        f"zeros, among them {ends} of the {found} solutions"
    )
    if proved.followed:
        text += f"; {proved.followed} go on to t = {proved.reached[proved.left].max():.0e}"
    rows = [("paths", text)]
    if proved.lost:
        rows.append(("doubt", f"{proved.lost} paths were lost, the first at t = {largest:.2g}"))
    if not proved.distinct:
        rows.append(("doubt", "the start points were not proved to be distinct"))
    rows.append(("", f"{proved.steps} tubes, {seconds:.2f} s"))
    return rows


def loops_rows(proved: Sequence[ProvedMonodromy], seconds: float) -> Rows:
    """What is proved of the loops of components, as labelled lines."""
    connected = sum(m.connected for m in proved)
    loops = sum(len(m.permutations) for m in proved)
    text = (
        f"the witness points of {connected} of {len(proved)} components are proved to lie on one "
        "irreducible component each"
    )
    rows = [("loops", text)]
    for k, m in enumerate(proved):
        if not m.connected:
            sets = len(set(m.orbits.tolist()))
            text = f"component {k + 1}: its {len(m.orbits)} points are in {sets} sets still"
            if not m.zeros:
                text = f"component {k + 1}: not all of its points are proved to be zeros"
            rows.append(("doubt", text))
    rows.append(("", f"{loops} loops, {sum(m.steps for m in proved)} tubes, {seconds:.2f} s"))
    return rows


def _points_rows(
    groups: Iterable[CertifiedPoints], what: str, images: Sequence[CertifiedPoints] = ()
) -> Rows:
    groups = list(groups)
    counts = Counter(p for g in groups for p in g.proofs)
    total = sum(counts.values())
    evidence = sum(int(g.on_evidence.sum()) for g in groups)
    proved = total - counts[Proof.NONE]
    more = f"; {evidence} on evidence" if evidence else ""
    rows = [("certified", f"{proved - evidence} of {total} {what}{more}")]
    rows += [
        ("", f"{counts[p]} {WORDS[p].format(digits=_least_digits(groups, p))}")
        for p in Proof
        if counts[p]
    ]
    if images:
        there = sum(int(g.boxes.proved.sum()) for g in images)
        points = sum(len(g.points) for g in images)
        text = f"besides {there} of {points} on {len(images)} more components, by symmetries"
        rows.append(("", text))
    errors = [g.errors()[g.boxes.proved] for g in groups]
    largest = max((float(e.max()) for e in errors if len(e)), default=0.0)
    if proved:
        text = f"no point is further from its zero than {magnitude(largest)}, relative to its size"
        rows.append(("error", text))
    return rows


def _least_digits(groups: Iterable[CertifiedPoints], proof: Proof) -> str:
    """Digits to which equations that a proof of this kind did not need vanish, in words."""
    least = min((float(g.digits[g.having(proof)].min(initial=np.inf)) for g in groups),
                default=np.inf)  # fmt: skip
    if np.isinf(least):
        return "all digits"
    return f"{least:.0f} digits, which is evidence and no proof"


def _claim_text(claim: Claim) -> str:
    """Whose statement it is, what it says, and the field where it stands."""
    if not claim.subject:
        return f"{claim.field}: {claim.text}"
    return f"{claim.subject}: {claim.text} ({claim.field})"


def claims_rows(claims: Iterable[Claim]) -> Rows:
    """How the statements of an export stand that are not proved, as labelled lines."""
    claims = list(claims)
    rows = [
        (label, f"{_claim_text(c)}{', by evidence' if standing is Standing.DOUBTED else ''}")
        for standing, label in LABELS.items()
        for c in claims
        if c.standing is standing
    ]
    for standing, label in ((Standing.EVIDENCE, "evidence"), (Standing.UNSEEN, "unseen")):
        fields = list(dict.fromkeys(c.field for c in claims if c.standing is standing))
        for first in range(0, len(fields), FIELDS_IN_A_LINE):
            text = ", ".join(fields[first : first + FIELDS_IN_A_LINE])
            what = "by evidence only: " if standing is Standing.EVIDENCE else "not looked at: "
            rows.append(("" if first else label, text if first else what + text))
    return [(label, printable(text)) for label, text in rows]


def _cost(groups: list[CertifiedPoints], seconds: float) -> tuple[str, str]:
    fine = sum(len(g.boxes.fine) for g in groups)
    proved = sum(int(g.boxes.proved.sum()) for g in groups)
    text = f"{proved - fine} boxes in doubles, {fine} in balls of more digits"
    return ("proof", printable(f"{text}, {seconds:.3f} s"))
