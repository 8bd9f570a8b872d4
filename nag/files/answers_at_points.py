"""What exports say of points: local dimensions, mobilities, singular points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from nag.files.json_values import pairs
from nag.numerics.tangent_cone import form_text

if TYPE_CHECKING:
    from nag.decomposition.singular_points import SingularLocus, SingularSet
    from nag.mechanism.mobility_report import CurveOfMotion, MobilityReport
    from nag.numerics.local_dimension import LocalDimension


def local_document(found: LocalDimension) -> dict[str, Any]:
    """What exports say of a local dimension."""
    return {
        "tangent_dimension": found.tangent_dimension,
        "local_dimension": found.dimension,
        "lower": found.lower,
        "upper": found.upper,
        "isolated": found.isolated,
        "multiplicity": found.multiplicity,
        "hyperplanes": found.hyperplanes,
        "coranks": list(found.coranks),
        "arithmetic": found.arithmetic,
        "reason": found.reason,
        "sharpened": [list(pair) for pair in found.digits],
    }


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


def singular_document(locus: SingularLocus, variables: Sequence[str]) -> dict[str, Any]:
    """What exports say of a singular locus; components are numbered from 1."""
    return {
        "examined": [i + 1 for i in locus.examined],
        "smooth": [i + 1 for i in locus.smooth],
        "sets": [_set_document(one, variables) for one in locus.sets],
    }


def _set_document(one: SingularSet, variables: Sequence[str]) -> dict[str, Any]:
    cone = one.cone
    return {
        "dimension": one.dimension,
        "degree": one.degree,
        "essential": [i + 1 for i in one.essential],
        "intersection": one.intersection,
        "multiplicities": [
            {"component": i + 1, "multiplicity": m} for i, m in one.multiplicities.items()
        ],
        "points": pairs(one.points),
        "local": local_document(one.local),
        "tangent_cone": None
        if cone is None
        else {
            "degree": cone.degree,
            "forms": [form_text(f, variables) for f in cone.forms],
            "linear": [form_text(f, variables) for f in cone.linear],
        },
    }
