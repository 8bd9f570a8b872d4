"""Planar linkages by the places of their pins: no loops, no angles.

The first two pins of a link keep their distance, and its other pins follow from them linearly. Pins
are linear in the cosines and sines of `linkage`, and these in the pins: components correspond to
each other, of the same dimensions and degrees, though no equation is the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.mechanism.linkage import Link, LinkageModel


@dataclass(frozen=True)
class PinModel:
    """All assemblies of a linkage as the places of its pins.

    Attributes:
        turns: the same linkage by its links' turns.
        pins: those that are not on the held link, in the order of the variables.
        system: a distance for each moving link, and two equations for each further pin.
    """

    turns: LinkageModel
    pins: tuple[str, ...]
    system: PolynomialSystem

    reference = None
    symmetries = ()

    @property
    def reason(self) -> str:
        """One sentence: what was made of the linkage."""
        return f"planar linkage of {len(self.turns.linkage.links)} links by the places of its pins"

    def is_real(self, point: Sequence[complex]) -> bool:
        """Whether a solution is a real assembly, to within rounding."""
        return self.turns.is_real(point)

    def at(self, point: Sequence[Number]) -> tuple[Number, ...]:
        """The places of the pins where the moving links have these cosines and sines."""
        held, *moving = self.turns.in_loops
        turn: dict[str, tuple[Any, Any]] = {held.name: (1, 0)}
        turn |= {k.name: (point[2 * i], point[2 * i + 1]) for i, k in enumerate(moving)}
        places: dict[str, tuple[Any, Any]] = dict(zip(held.pins, held.shape, strict=True))
        left = list(moving)
        while left:
            link = next(k for k in left if places.keys() & set(k.pins))
            left.remove(link)
            (c, s), start = turn[link.name], next(p for p in link.pins if p in places)
            (x0, y0), origin = places[start], link.shape[link.pins.index(start)]
            for pin, (x, y) in zip(link.pins, link.shape, strict=True):
                dx, dy = x - origin[0], y - origin[1]
                places.setdefault(pin, (x0 + c * dx - s * dy, y0 + s * dx + c * dy))
        return tuple(x for pin in self.pins for x in places[pin])


def pin_model(turns: LinkageModel) -> PinModel:
    """The equations of a linkage's pins, of the links that are in loops."""
    held, *moving = turns.in_loops
    pins = tuple(dict.fromkeys(p for k in moving for p in k.pins if p not in held.pins))
    n = 2 * len(pins)
    x = Polynomial.variables(n)
    places: dict[str, tuple[Polynomial, Polynomial]] = {
        pin: (Polynomial.constant(n, a), Polynomial.constant(n, b))
        for pin, (a, b) in zip(held.pins, held.shape, strict=True)
    }
    places |= {pin: (x[2 * i], x[2 * i + 1]) for i, pin in enumerate(pins)}
    equations = [f for link in moving for f in _rigid(link, places)]
    names = tuple(f"{letter}_{pin}" for pin in pins for letter in "xy")
    return PinModel(turns, pins, PolynomialSystem(names, tuple(equations)))


def _rigid(link: Link, places: dict[str, tuple[Polynomial, Polynomial]]) -> list[Polynomial]:
    """That the pins of a link have its shape, and not the mirror image."""
    first, second, *others = link.pins
    (a, b), origin = (
        tuple(v - u for u, v in zip(link.shape[0], link.shape[1], strict=True)),
        link.shape[0],
    )
    squared = a * a + b * b
    u, v = (q - p for p, q in zip(places[first], places[second], strict=True))
    equations = [u * u + v * v - squared]
    for pin, place in zip(others, link.shape[2:], strict=True):
        x, y = (q - p for p, q in zip(origin, place, strict=True))
        along, across = (x * a + y * b) / squared, (y * a - x * b) / squared
        here = [q - p for p, q in zip(places[first], places[pin], strict=True)]
        equations += [here[0] - u * along + v * across, here[1] - v * along - u * across]
    return equations
