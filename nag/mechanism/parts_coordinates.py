"""The coordinates in which given parts may be assembled, and how many paths each may ask for.

What equations of the same parts in two of them say must agree.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from nag.algebra.elimination import eliminate_linear
from nag.algebra.number import Number
from nag.algebra.system import PolynomialSystem
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.framework_model import (
    FrameworkModel,
    cartesian_model,
    in_each_coordinates,
    in_isotropic_coordinates,
    pin_differently,
)
from nag.mechanism.linkage import LinkageModel, pin_model
from nag.mechanism.mobility_report import Alike
from nag.mechanism.path_estimates import PathNumbers, fewest_estimated_paths, paths_at_once


@dataclass(frozen=True)
class PartsCoordinates(PathNumbers):
    """Coordinates of parts that are to be assembled.

    Attributes:
        formulation: name of the coordinates.
        parts: the equations in them.
        system: what is left of these when linear equations have been solved.
        taken: whether components are found in them.
    """

    formulation: str
    parts: AssemblyModel
    system: PolynomialSystem
    taken: bool

    @cached_property
    def at_once(self) -> int | None:
        """Number of paths to a slice where these may be all it takes: see `paths_at_once`."""
        return paths_at_once(self.parts.system)

    @property
    def most(self) -> int:
        """Estimated number of paths that equation by equation are tracked at most."""
        return fewest_estimated_paths(self.system)


def coordinates_of_parts(parts: AssemblyModel) -> tuple[PartsCoordinates, ...]:
    """The coordinates of a linkage or a framework, those that are taken first.

    A linkage has the cosines and sines of its links' turns or the places of its pins, the same
    after linear equations have been solved; a framework in the plane has isotropic or real ones.
    """
    if isinstance(parts, LinkageModel):
        made: list[tuple[str, AssemblyModel]] = [
            ("turns (c, s)", parts),
            ("pins (x, y)", pin_model(parts)),
        ]
        taken = "turns (c, s)"
    elif isinstance(parts, FrameworkModel):
        each = in_each_coordinates(parts)
        made = [(_name(m), m) for m in each]
        taken = _name(parts.smaller or parts)
    else:
        return ()
    found = [
        PartsCoordinates(name, m, eliminate_linear(m.system, graphs=False).system, name == taken)
        for name, m in made
    ]
    return tuple(sorted(found, key=lambda c: not c.taken))


def _name(model: FrameworkModel) -> str:
    letters = ", ".join(model.coordinates)
    return letters if len(model.coordinates) == 1 else f"({letters})"


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
    pinned = None if at is not None else pin_differently(parts)
    if pinned is None:
        return None
    return Another(f"{'-'.join(pinned.pinned)} pinned", pinned, None, "counts")
