"""Irreducible decomposition of solution sets into witness sets, and what can be done with these."""

from importlib import import_module
from typing import Any

_HOME = {
    "by_sampling": "discovery",
    "components_through": "membership",
    "decompose": "components",
    "intersect_components": "intersection",
    "intersect_equations": "intersection",
    "intersect_pair": "intersection",
    "memberships": "membership",
    "project": "projection",
    "real_points_near": "real_points",
    "sample": "sampling",
    "witness_at": "moving",
}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
