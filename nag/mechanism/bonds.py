"""Bonds of a closed loop of revolute joints: points at infinity of its motions.

Over a joint's half-angle with c^2 + s^2 = 0 a curve of configurations has ends at which the product
of the joints' rotations vanishes: there at least one other joint's half-angle is of this kind, too.
The two are connected, a configuration that moves the one moves the other; the number of conjugate
pairs of such ends is their connection number. A joint's connection numbers add up to the degree of
the curve over it.

Reference:
    Hegedus, Schicho & Schroecker, The theory of bonds: a new method for the analysis of linkages,
    2013.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from nag.mechanism.axes import direction, dot
from nag.mechanism.half_angles import HalfAngleModel
from nag.mechanism.model import Model
from nag.witness.fibres import Fibre, Tracker, move
from nag.witness.membership import component_fibres
from nag.witness.slices import unit_complex
from nag.witness.witness import WitnessSet

# Distances from an end, relative to the coordinate's size, at which the joints' norms are compared.
NEAR, NEARER = 1e-3, 1e-5
# A norm vanishes at an end if it falls with at least this power of the distance; the least power
# that is possible is the inverse of the number of points that come together.
FALLING = 0.05
ATTEMPTS = 3


class BondError(ValueError):
    """Bonds that could not be determined, with the reason."""


@dataclass(frozen=True)
class Bonds:
    """The bonds of a curve of configurations of a loop.

    Attributes:
        joints: names of the joints, in the order of the loop.
        connections: connection number of each set of joints (mostly pairs) that is connected.
        degrees: for each joint that the model keeps, the number of configurations in which it has a
            given angle.
    """

    joints: tuple[str, ...]
    connections: Mapping[tuple[str, ...], int]
    degrees: Mapping[str, int]

    @property
    def consistent(self) -> bool:
        """Whether the connection numbers of each kept joint add up to its degree."""
        return all(
            sum(k for names, k in self.connections.items() if joint in names) == degree
            for joint, degree in self.degrees.items()
        )

    def __str__(self) -> str:
        if not self.connections:
            return "none"
        parts = []
        for names, number in self.connections.items():
            parts.append("-".join(names) + (f" ({number})" if number > 1 else ""))
        return ", ".join(parts)


def bonds(
    model: Model,
    component: WitnessSet,
    *,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> Bonds:
    """The bonds of a curve of configurations.

    Args:
        model: of a single loop of revolute joints, in half-angles.
        component: a curve among the components of its system.

    Raises:
        BondError: if paths fail.
        ValueError: if the model or the component is another one.
    """
    form = model.form
    if not isinstance(form, HalfAngleModel) or len(form.closures) != 1:
        raise ValueError("bonds are for single loops in formulation H")
    if any(joint.type != "revolute" for joint in model.structure.joints):
        raise ValueError("bonds are for loops of revolute joints")
    if component.dimension != 1:
        raise ValueError(f"the component has dimension {component.dimension}; a curve has 1")
    rng = np.random.default_rng([seed, 10])
    search = _Ends(model, form, component, rng, Tracker(settings, threads))
    kept = search.kept
    order = tuple(joint.name for joint in model.structure.loops[0].joints)
    found: dict[tuple[str, ...], dict[str, int]] = {}
    degrees: dict[str, int] = {}
    for i, joint in enumerate(kept):
        ends, degrees[joint] = search.over(i)
        for names, number in ends.items():
            found.setdefault(names, {})[joint] = number
    connections = {}
    for names in sorted(found, key=lambda s: [order.index(name) for name in s]):
        numbers = set(found[names].values())
        if len(numbers) > 1 or numbers.pop() % 2:
            raise BondError(f"the ends of joints {', '.join(names)} do not fit together")
        connections[names] = next(iter(found[names].values())) // 2
    return Bonds(order, connections, degrees)


class _Ends:
    """Ends of a curve over a joint's half-angles of norm zero."""

    def __init__(
        self,
        model: Model,
        form: HalfAngleModel,
        component: WitnessSet,
        rng: np.random.Generator,
        tracker: Tracker,
    ) -> None:
        self.form, self.component, self.rng, self.tracker = form, component, rng, tracker
        self.nonzero, self.n = model.system.nonzero, model.system.n
        self.fibres = component_fibres(model.system, component)
        owner = {e.factor: name for name, es in form.elements.items() for e in es if e.factor}
        self.kept = tuple(owner[factor] for factor in form.charts.plain)
        axes = {joint.name: direction(joint.axis) for joint in model.structure.joints}
        self.squares = {name: float(dot(axis, axis)) for name, axis in axes.items()}

    def over(self, i: int) -> tuple[Counter[tuple[str, ...]], int]:
        """For each set of joints how many ends over kept joint ``i`` have it, and its degree."""
        coefficients = [complex(float(self._coefficient(i, k))) for k in (2, 1, 0)]
        ends: Counter[tuple[str, ...]] = Counter()
        degree = -1
        for root in np.roots(coefficients):
            names = self._at(i, complex(root))
            if degree not in (-1, len(names)):
                raise BondError("the degrees over conjugate half-angles differ")
            degree = len(names)
            ends.update(names)
        return ends, degree

    def _coefficient(self, i: int, k: int) -> Any:
        return self.nonzero[i].terms.get(tuple(k * int(j == i) for j in range(self.n)), 0)

    def _at(self, i: int, root: complex) -> list[tuple[str, ...]]:
        """The joints whose norms vanish, for each end over a root."""
        size, turn = abs(root) + 1e-3, complex(unit_complex(self.rng))
        result = []
        for fibre in self.fibres:
            for _ in range(ATTEMPTS):
                gamma = complex(unit_complex(self.rng))
                start, goal = (self._rows(i, root + turn * size * r) for r in (NEAR, NEARER))
                first = move(fibre, self.component.slice.rows, start, gamma, self.tracker, True)
                if first.failed.any():
                    continue
                points = first.points[first.regular]
                there = Fibre(fibre.cut, 1, points)
                second = move(there, start, goal, 1.0, self.tracker)
                if second.regular.all():
                    break
            else:
                raise BondError("paths to the ends of the curve failed")
            for x, y in zip(points, second.points, strict=True):
                result.append(self._vanishing(x[: self.n], y[: self.n]))
        return result

    def _rows(self, i: int, value: complex) -> np.ndarray:
        row = np.zeros((1, 1 + self.n), dtype=complex)
        row[0, 0], row[0, 1 + i] = -value, 1
        return row

    def _vanishing(self, x: np.ndarray, y: np.ndarray) -> tuple[str, ...]:
        first, second = self._norms(x), self._norms(y)
        least = FALLING * np.log(NEARER / NEAR)
        loop = [joint.name for joint in self.form.structure.loops[0].joints]
        return tuple(name for name in loop if np.log(second[name] / first[name]) < least)

    def _norms(self, point: np.ndarray) -> dict[str, float]:
        """Of each joint's half-angle, relative to its size."""
        result = {}
        for name, ((c, s),) in self.form.coordinates(list(point)).items():
            square = self.squares[name]
            size = abs(c) ** 2 + square * abs(s) ** 2
            result[name] = max(float(abs(c * c + square * s * s) / size), 1e-300)
        return result
