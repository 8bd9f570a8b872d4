"""Irreducible decomposition of solution sets into witness sets."""

from typing import Any

__all__ = ["decompose"]


def __getattr__(name: str) -> Any:
    if name == "decompose":
        from nag.decomposition.components import decompose

        return decompose
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
