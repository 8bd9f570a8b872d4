"""The coordinates in which given parts may be assembled, and how many paths each may ask for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from nag.algebra.elimination import eliminate_linear
from nag.algebra.system import PolynomialSystem
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.framework_model import FrameworkModel, in_each_coordinates
from nag.mechanism.linkage import LinkageModel, pin_model
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
