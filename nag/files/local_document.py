"""A local dimension as a JSON object."""

from __future__ import annotations

from typing import Any

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
