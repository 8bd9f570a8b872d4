"""Planar four-bars with equal opposite sides, as mechanisms: their bars as the papers have them."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.number import square_root
from nag.mechanism.axes import difference, dot
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import Model, ModelError, model
from nag.mechanism.planar import PlanarModel
from nag.mechanism.quaternion import conjugate, rotate


@dataclass(frozen=True)
class EqualSides:
    """A four-bar with sides a, b, a, b in the plane.

    Attributes:
        model: its model.
        sides: a and b, exact.
        links: the vectors from joint to joint round the loop, the fixed body's first.
        bodies: the bodies that have them.
    """

    model: Model
    sides: tuple[Fraction, Fraction]
    links: tuple[tuple[Fraction, ...], ...]
    bodies: tuple[str, ...]

    def coordinates(self, points: np.ndarray) -> np.ndarray:
        """(c, s) of bars 1, 2, 3 of PT13 5.3 at solutions of the model, shape ``(P, 6)``.

        a e_0 - b e_1 - a e_2 + b e_3 = 0 for unit vectors e_i with e_0 = (1, 0).
        """
        return np.array([self._bars(point) for point in points])

    def _bars(self, point: np.ndarray) -> list[complex]:
        euler = self.model.lift(list(point)).euler
        mechanism = self.model.mechanism
        across = np.array([float(x) for x in self.model.form.normal])
        across = across / np.linalg.norm(across)
        base = np.array([float(x) for x in self.links[0]])
        bars = []
        for body, link, sign in zip(self.bodies[1:], self.links[1:], (-1, -1, 1), strict=True):
            local = rotate(conjugate(mechanism.orientation(body)), link)
            turned = np.array(rotate(euler[body], [float(x) for x in local]), dtype=complex)
            length = np.linalg.norm(base) * float(np.sqrt(float(dot(link, link))))
            bars += [
                sign * (base @ turned) / length,
                sign * (np.cross(base, turned) @ across) / length,
            ]
        return bars


def equal_sides(mechanism: Mechanism) -> EqualSides | None:
    """The mechanism as a planar four-bar with rational equal opposite sides, or None."""
    # Models of many bodies take long.
    if len(mechanism.joints) != 4:
        return None
    try:
        made = model(mechanism, "E")
    except ModelError:
        return None
    loop = made.structure.single
    if made.space != "planar" or loop is None or len(loop.bodies) != 4 or made.structure.cut:
        return None
    if not isinstance(made.form, PlanarModel) or {j.type for j in loop.joints} != {"revolute"}:
        return None
    links: list[Any] = []
    for i in range(4):
        link = difference(loop.joints[i].point, loop.joints[i - 1].point)
        normal = made.form.normal
        along = dot(link, normal) / dot(normal, normal)
        links.append(tuple(x - along * y for x, y in zip(link, normal, strict=True)))
    lengths = [square_root(dot(v, v)) for v in links]
    rational = all(isinstance(x, Fraction) and x > 0 for x in lengths)
    if not rational or lengths[0] != lengths[2] or lengths[1] != lengths[3]:
        return None
    return EqualSides(made, (lengths[0], lengths[1]), tuple(links), loop.bodies)
