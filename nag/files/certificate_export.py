"""Certificates as JSON, written only: whoever doubts one computes it again from the export.

The format is ``nag-certificate``, version 1; its JSON Schema is in ``schema/`` beside this module.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.files.json_values import system_document
from nag.numerics.ball_boxes import FineBox
from nag.numerics.certified_points import CertifiedPoints
from nag.numerics.claims import Claim, nothing_against
from nag.solving.certificate import SolutionsCertificate
from nag.solving.certified_paths import ProvedPaths
from nag.text.json_text import pairs, real_or_null
from nag.witness.certificate import DecompositionCertificate
from nag.witness.certified_loops import ProvedMonodromy

FORMAT = "nag-certificate"
VERSION = 1
# Most decimal digits of a zero for which doubles do not suffice.
DIGITS = 60


def _points(points: CertifiedPoints) -> list[dict[str, Any]]:
    boxes, errors, centres = points.boxes, points.errors(), pairs(points.boxes.centres)
    documents, evidence = [], points.on_evidence
    for i, proof in enumerate(points.proofs):
        document: dict[str, Any] = {"proof": str(proof), "refuted": i in points.refuted}
        if evidence[i]:
            document["evidence"] = True
        if boxes.proved[i]:
            document |= {
                "centre": centres[i],
                "inner": boxes.inner[i].tolist(),
                "outer": boxes.outer[i].tolist(),
                "error": real_or_null(float(errors[i])),
                "digits": real_or_null(float(points.digits[i])),
            }
        if i in boxes.fine:
            document["decimals"] = _decimals(boxes.fine[i])
        documents.append(document)
    return documents


def _decimals(box: FineBox) -> list[list[str]]:
    """Real and imaginary parts of the zero in a box, to the digits that the box leaves."""
    return [[part.str(DIGITS, radius=False) for part in (z.real, z.imag)] for z in box.balls]


def _reality(certificate: SolutionsCertificate) -> list[bool | None]:
    proved = ~certificate.points.on_evidence
    return [
        True if real else False if other else None
        for real, other in zip(
            certificate.real & proved, certificate.not_real & proved, strict=True
        )
    ]


def _solutions_document(certificate: SolutionsCertificate) -> dict[str, Any]:
    """The certificate of solutions as a JSON object."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "of": "solutions",
        "system": system_document(certificate.result.system),
        "all_proved": certificate.all_proved,
        "complete": certificate.complete,
        "bound": certificate.bound,
        "simple": certificate.simple,
        "real": _reality(certificate),
        "same": [list(pair) for pair in certificate.same],
        "unknown": [list(pair) for pair in certificate.unknown],
        "points": _points(certificate.points),
        "excluded": _points(certificate.excluded),
    }


def _decomposition_document(certificate: DecompositionCertificate) -> dict[str, Any]:
    """The certificate of a decomposition as a JSON object."""
    components = [
        {
            "dimension": c.component.dimension,
            "degree": c.component.degree,
            "distinct": c.distinct,
            "slice": {"A": pairs(c.component.slice.A), "b": pairs(c.component.slice.b)},
            "points": _points(c.points),
            "images": [_points(points) for points in c.images if points is not None],
        }
        for c in certificate.components
    ]
    bounds = sorted(certificate.bounds.items(), reverse=True)
    return {
        "format": FORMAT,
        "version": VERSION,
        "of": "decomposition",
        "system": system_document(certificate.decomposition.system),
        "all_proved": certificate.all_proved,
        "complete": certificate.complete,
        "bound": certificate.most,
        "degrees": [{"dimension": d, "at_least": int(k)} for d, k in bounds],
        "components": components,
    }


def _paths(proved: ProvedPaths) -> dict[str, Any]:
    return {
        "start": proved.start,
        "distinct": proved.distinct,
        "reached": proved.reached.tolist(),
        "ends": [int(k) if k >= 0 else None for k in proved.ends],
        "tubes": proved.steps,
    }


def _loops(proved: ProvedMonodromy) -> dict[str, Any]:
    return {
        "connected": proved.connected,
        "permutations": [
            [int(k) if k >= 0 else None for k in places] for places in proved.permutations
        ],
        "tubes": proved.steps,
    }


def certificate_document(
    certificate: SolutionsCertificate | DecompositionCertificate,
    claims: Sequence[Claim] | None = None,
    paths: ProvedPaths | Sequence[ProvedMonodromy] | None = None,
) -> dict[str, Any]:
    """The certificate as a JSON object.

    Args:
        claims: how the statements of an export stand, if paths say more than the certificate.
        paths: what is proved of the paths to solutions, or of loops, one for each component.
    """
    solved = isinstance(certificate, SolutionsCertificate)
    document = (_solutions_document if solved else _decomposition_document)(certificate)
    if isinstance(paths, ProvedPaths):
        document["paths"] = _paths(paths)
    elif paths is not None:
        for component, proved in zip(document["components"], paths, strict=True):
            component["loops"] = _loops(proved)
    document["all_proved"] = document["all_proved"] and nothing_against(claims or ())
    document["statements"] = [
        {"field": c.field, "of": c.subject, "says": c.text, "standing": str(c.standing)}
        for c in (certificate.claims if claims is None else claims)
    ]
    return document
