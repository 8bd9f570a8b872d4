"""Irreducible decomposition: supersets of witness points, split into components, then judged.

Read in this order: `superset` (equation by equation) on `hypersurface` (one step of it);
`irreducible` on `monodromy` and `trace` (splitting), `orbits` (the same up to symmetry);
`final_checks`; `components`, which puts the answer together. `discovery` and `intersection` begin
elsewhere and end alike. `branch_components` follows what exact factoring decides.
"""

from importlib import import_module
from typing import Any

_HOME = {
    "by_sampling": "nag.decomposition.discovery",
    "components_through": "nag.witness.membership",
    "decompose": "nag.decomposition.components",
    "genus": "nag.decomposition.curve_genus",
    "intersect_components": "nag.decomposition.intersection",
    "intersect_equations": "nag.decomposition.intersection",
    "intersect_pair": "nag.decomposition.intersection",
    "memberships": "nag.witness.membership",
    "project": "nag.witness.projection",
    "real_points_near": "nag.witness.real_points",
    "sample": "nag.witness.sampling",
    "singular_locus": "nag.decomposition.singular_locus",
    "singular_parameters": "nag.decomposition.singular_parameters",
    "witness_at": "nag.witness.moving",
}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
