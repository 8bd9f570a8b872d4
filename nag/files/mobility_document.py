"""A mobility report as a JSON object."""

from __future__ import annotations

from typing import Any

from nag.files.local_document import local_document
from nag.mechanism.mobility_report import CurveOfMotion, MobilityReport


def mobility_document(report: MobilityReport) -> dict[str, Any]:
    """What exports say of a mobility."""
    components = report.components
    return {
        "space": report.space,
        "gruebler_kutzbach": report.gruebler_kutzbach,
        "formulation": report.formulation or None,
        "variables": report.variables,
        "equations": report.equations,
        "free": report.free,
        "tangent_dimension": report.tangent_dimension,
        "local_dimension": report.local_dimension,
        "lower": report.lower,
        "upper": report.upper,
        "multiplicity": report.multiplicity,
        "overconstrained": report.overconstrained,
        "status": str(report.status),
        "meaning": report.sentence,
        "components": None
        if components is None
        else [{"dimension": d, "degree": degree} for d, degree in components],
        "open": report.open,
        "curves": [_curve_document(curve) for curve in report.curves],
        "local": None if report.local is None else local_document(report.local),
    }


def _curve_document(curve: CurveOfMotion) -> dict[str, Any]:
    bonds = None
    if curve.bonds is not None:
        bonds = [
            {"joints": list(bond.joints), "orders": list(bond.orders), "count": bond.count}
            for bond in curve.bonds.bonds
        ]
    return {"degree": curve.degree, "genus": curve.genus, "bonds": bonds, "note": curve.note}
