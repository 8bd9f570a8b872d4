"""Singular points as a JSON object."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.decomposition.singular_locus import SingularLocus, SingularSet
from nag.files.json_text import pairs
from nag.files.local_document import local_document
from nag.numerics.tangent_cone import form_text


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
