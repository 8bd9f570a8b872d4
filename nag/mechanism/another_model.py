"""The same parts in other equations: what both say must agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from nag.algebra.number import Number
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.framework_model import (
    FrameworkModel,
    cartesian_model,
    differently_pinned,
    in_isotropic_coordinates,
)
from nag.mechanism.linkage import LinkageModel
from nag.mechanism.mobility_report import Alike
from nag.mechanism.pins import pin_model


@dataclass(frozen=True)
class Another:
    """Another model of the same parts.

    Attributes:
        name: of its coordinates.
        parts: the model.
        at: the configuration in its variables; None if none was given.
        alike: what of the components is the same in both.
    """

    name: str
    parts: AssemblyModel
    at: tuple[Number, ...] | None
    alike: Alike


def another_model(parts: AssemblyModel, at: Sequence[Number] | None = None) -> Another | None:
    """Other equations of a linkage or a framework; None if there are none.

    A linkage that was given by its links' turns is taken by the places of its pins. A framework in
    the plane is taken in x and y without isotropic coordinates, or with them where it had none; in
    space another triangle is pinned.

    Args:
        at: a configuration in the variables of ``parts``.
    """
    if isinstance(parts, LinkageModel):
        pins = pin_model(parts)
        return Another("pins", pins, None if at is None else pins.at(at), "degrees")
    if not isinstance(parts, FrameworkModel):
        return None
    here = None if at is None else tuple(at)
    if parts.coordinates.startswith("z"):
        plain = replace(cartesian_model(parts.framework), smaller=None)
        return Another("coordinates (x, y)", plain, here, "counts")
    if parts.smaller is not None:
        return Another("coordinates (x, y)", replace(parts, smaller=None), here, "degrees")
    isotropic = in_isotropic_coordinates(parts) if parts.coordinates == "xy" else None
    if isotropic is not None:
        return Another("isotropic coordinates", isotropic, here, "degrees")
    pinned = None if at is not None else differently_pinned(parts)
    if pinned is None:
        return None
    return Another(f"{'-'.join(pinned.pinned)} pinned", pinned, None, "counts")
