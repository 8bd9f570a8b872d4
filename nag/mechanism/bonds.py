"""Bonds of a closed loop of revolute joints: points at infinity of its motions.

Over a joint's half-angle with c^2 + s^2 = 0 a curve of configurations has ends at which the product
of the joints' rotations vanishes: there at least one other joint's half-angle is of this kind, too.
They are connected; the number of conjugate pairs of such ends is their connection number. A joint's
connection numbers, with the orders to which its norm vanishes, add up to the degree of the curve
over it.

Reference:
    Hegedus, Schicho & Schroecker, The theory of bonds: a new method for the analysis of linkages,
    2013.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Any

import flint
import numpy as np

from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.number import Number
from nag.algebra.system import PolynomialSystem
from nag.errors import MechanismError, NagError
from nag.mechanism.axes import direction, dot
from nag.mechanism.dh import DHModel
from nag.mechanism.half_angles import HalfAngleModel
from nag.mechanism.model import Model
from nag.numerics.digits import bits_of, in_bits, to_ball
from nag.numerics.precise_point import POINT_DIGITS
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.component_equations import component_fibres
from nag.witness.confirm import zero_in_digits
from nag.witness.fibres import Fibre, move
from nag.witness.points import with_fine
from nag.witness.slices import unit_complex
from nag.witness.witness import WitnessSet

# Distances from an end, relative to the coordinate's size, at which the joints' norms are compared.
NEAR, NEARER = 1e-3, 1e-5
# What is added to that size, which may be zero.
LEAST_SIZE = 1e-3
# Norms fall with a power of the distance that is a ratio of orders.
LARGEST_ORDER = 6
# Decides: How far orders of bonds may be from fractions.
UNCLEAR = 0.03


_Kind = tuple[tuple[str, int], ...]


class BondError(MechanismError):
    """Bonds that could not be determined, with the reason."""


@dataclass(frozen=True)
class Bond:
    """Conjugate pairs of ends of a curve that are alike.

    Attributes:
        joints: names of the joints that are connected, in the order of the loop.
        orders: to which order the norm of each one's half-angle vanishes.
        count: number of pairs.
    """

    joints: tuple[str, ...]
    orders: tuple[int, ...]
    count: int

    def __str__(self) -> str:
        text = "-".join(self.joints)
        if max(self.orders) > 1:
            text += f" of orders {', '.join(map(str, self.orders))}"
        return f"{text} ({self.count})" if self.count > 1 else text


@dataclass(frozen=True)
class Bonds:
    """The bonds of a curve of configurations of a loop.

    Attributes:
        joints: names of the joints, in the order of the loop.
        bonds: the connected sets of joints, mostly pairs.
        degrees: for each joint that the model keeps, the number of configurations in which it has a
            given angle.
    """

    joints: tuple[str, ...]
    bonds: tuple[Bond, ...]
    degrees: Mapping[str, int]

    def __post_init__(self) -> None:
        object.__setattr__(self, "degrees", fixed_mapping(self.degrees))

    def __str__(self) -> str:
        return ", ".join(map(str, self.bonds)) or "none"


@dataclass(frozen=True)
class _Loop:
    """A loop of revolute joints with equations in half-angles.

    Attributes:
        system: the equations; ``nonzero`` are the norms of the kept half-angles.
        joints: names of the joints, in the order of the loop.
        kept: names of those that have a variable, in the order of the variables.
        squares: squared lengths of the axes' vectors.
        half_angles: (c, s) of all joints at a solution.
    """

    system: PolynomialSystem
    joints: tuple[str, ...]
    kept: tuple[str, ...]
    squares: Mapping[str, Number]
    half_angles: Callable[[Sequence[Any]], Mapping[str, tuple[Any, Any]]]


def _loop(given: Model | DHModel) -> _Loop:
    """The loop of a model.

    Raises:
        ValueError: if it has none of this kind.
    """
    if isinstance(given, DHModel):
        rows = given.loop.rows
        if len(given.loop.open) < len(rows):
            raise NagError("bonds are for loops with all joints open")
        names = tuple(row.name for row in rows)
        kept = tuple(turn.joint for turn in given.charts.plain)

        def turns(point: Sequence[Any]) -> Mapping[str, tuple[Any, Any]]:
            return given.turns(point, to_ball)

        return _Loop(given.system, names, kept, dict.fromkeys(names, Fraction(1)), turns)
    form = given.form
    if not isinstance(form, HalfAngleModel) or len(form.closures) != 1:
        raise NagError("bonds are for single loops in formulation H")
    if not all(joint.of_type.turns_only for joint in given.structure.joints):
        raise NagError("bonds are for loops of revolute joints")
    axes = {joint.name: direction(joint.axis) for joint in given.structure.joints}
    return _Loop(
        given.system,
        tuple(joint.name for joint in given.structure.loops[0].joints),
        tuple(factor.joint for factor in form.charts.plain),
        {name: dot(axis, axis) for name, axis in axes.items()},
        lambda point: {name: cs for name, (cs,) in form.coordinates(list(point)).items()},
    )


def has_bonds(given: object) -> bool:
    """Whether something is a model of a loop that has bonds."""
    try:
        return isinstance(given, Model | DHModel) and bool(_loop(given).joints)
    except ValueError:
        return False


@takes_run
def bonds(
    model: Model | DHModel,
    component: WitnessSet,
    *,
    run: Run = DEFAULT_RUN,
) -> Bonds:
    """The bonds of a curve of configurations.

    Args:
        model: of a single loop of revolute joints, in half-angles.
        component: a curve among the components of its system.

    Raises:
        BondError: if paths fail.
        ValueError: if the model or the component is another one.
    """
    loop = _loop(model)
    if component.dimension != 1:
        raise NagError(f"the component has dimension {component.dimension}; a curve has 1")
    rng = run.random(Stream.BONDS)
    search = _Ends(loop, component, rng, run)
    order = loop.joints
    found: dict[_Kind, set[Fraction]] = {}
    degrees: dict[str, int] = {}
    for i, joint in enumerate(loop.kept):
        ends, degrees[joint] = search.bonds_over(i)
        for kind, paths in ends.items():
            # So many paths as the order come together at each of two conjugate ends.
            found.setdefault(kind, set()).add(Fraction(paths, 2 * dict(kind)[joint]))
    pairs = []
    for kind in sorted(found, key=lambda kind: [order.index(name) for name, _ in kind]):
        (count, *others) = found[kind]
        names, orders = zip(*kind, strict=True)
        if others or count.denominator > 1:
            raise BondError(f"the ends of joints {', '.join(names)} do not fit together")
        pairs.append(Bond(names, orders, int(count)))
    _check_orders(pairs, degrees)
    return Bonds(order, tuple(pairs), degrees)


def _check_orders(found: Sequence[Bond], degrees: Mapping[str, int]) -> None:
    """Make sure that the orders at each kept joint add up to its degree.

    Raises:
        BondError: if they do not.
    """
    totals: Counter[str] = Counter()
    for bond in found:
        for name, order in zip(bond.joints, bond.orders, strict=True):
            totals[name] += order * bond.count
    wrong = [joint for joint, degree in degrees.items() if totals[joint] != degree]
    if wrong:
        raise BondError(f"the orders at joints {', '.join(wrong)} do not add up to their degrees")


class _Ends:
    """Ends of a curve over a joint's half-angles of norm zero."""

    def __init__(
        self, loop: _Loop, component: WitnessSet, rng: np.random.Generator, run: Run
    ) -> None:
        self.loop, self.component, self.rng, self.run = loop, component, rng, run
        self.n = loop.system.n
        self.fibres = component_fibres(loop.system, component)

    def bonds_over(self, i: int) -> tuple[Counter[_Kind], int]:
        """How many paths to ends over kept joint ``i`` there are of each kind, and its degree."""
        coefficients = [complex(float(self._coefficient(i, k))) for k in (2, 1, 0)]
        ends: Counter[_Kind] = Counter()
        degree = -1
        for root in np.roots(coefficients):
            names = self._kinds_at(i, complex(root))
            if degree not in (-1, len(names)):
                raise BondError("the degrees over conjugate half-angles differ")
            degree = len(names)
            ends.update(names)
        return ends, degree

    def _coefficient(self, i: int, k: int) -> Any:
        return self.loop.system.nonzero[i].terms.get(
            tuple(k * int(j == i) for j in range(self.n)), 0
        )

    def _kinds_at(self, i: int, root: complex) -> list[_Kind]:
        """The joints whose norms vanish, for each end over a root."""
        size, turn = abs(root) + LEAST_SIZE, complex(unit_complex(self.rng))
        result = []
        for fibre in self.fibres:
            gamma = complex(unit_complex(self.rng))
            start, goal = (self._rows(i, root + turn * size * r) for r in (NEAR, NEARER))
            (first,) = move([fibre], start, gamma, self.run, endgame=True)
            regular = np.flatnonzero(first.regular)
            if first.failed.any():
                raise BondError("paths to the ends of the curve failed")
            if not len(regular):
                continue
            (near,) = with_fine([first.fibre(regular)])
            (second,) = move([near], goal, 1.0, self.run)
            if not second.regular.all():
                raise BondError("paths to the ends of the curve failed")
            for k in range(len(near)):
                norms = (self._norms(self._sharpen(at, k)) for at in (near, second.fibre()))
                result.append(self._vanishing_orders(*norms))
        return result

    def _sharpen(self, fibre: Fibre, k: int) -> list[flint.acb]:
        """A point near an end in many digits: eliminated joints lose most of them there."""
        zero = zero_in_digits(fibre, k)
        if zero is None:
            raise BondError("points near the ends of the curve are not regular")
        return list(zero.centre[: self.n])

    def _rows(self, i: int, value: complex) -> np.ndarray:
        row = np.zeros((1, 1 + self.n), dtype=complex)
        row[0, 0], row[0, 1 + i] = -value, 1
        return row

    def _vanishing_orders(self, first: Mapping[str, float], second: Mapping[str, float]) -> _Kind:
        """The joints whose norms vanish at the end that two points lead to, with the orders."""
        powers: dict[str, Fraction] = {}
        for name in self.loop.joints:
            slope = float(np.log(second[name] / first[name]) / np.log(NEARER / NEAR))
            power = Fraction(slope).limit_denominator(LARGEST_ORDER)
            if abs(float(power) - slope) > UNCLEAR:
                raise BondError(f"the order to which joint {name} vanishes is not clear")
            if power > 0:
                powers[name] = power
        unit = lcm(*(power.denominator for power in powers.values()))
        orders = {name: int(power * unit) for name, power in powers.items()}
        return tuple((name, order // gcd(*orders.values())) for name, order in orders.items())

    def _norms(self, point: Sequence[flint.acb]) -> dict[str, float]:
        """Of each joint's half-angle, relative to its size."""
        result = {}
        with in_bits(bits_of(POINT_DIGITS)):
            for name, (c, s) in self.loop.half_angles(point).items():
                square = to_ball(self.loop.squares[name])
                size = abs(c) ** 2 + square.real * abs(s) ** 2
                result[name] = max(float((abs(c * c + square * s * s) / size).mid()), 1e-300)
        return result
