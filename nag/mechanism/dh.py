"""Single loops of revolute joints by Denavit and Hartenberg's numbers.

Row i of the table takes the frame of joint i to that of joint i + 1: a turn by theta about z, a
slide by d along z, a slide by a along x, a turn by alpha about x. The loop closes when the product
of all rows is the identity. In dual quaternions a turn of half-angle (c : s) is c + s k, all other
factors are constant, and the product has to be a real number (Hegedus, Schicho & Schroecker 2013).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import acos, degrees, sqrt
from typing import Any

from nag.algebra.linear_algebra import independent_polynomials, left_inverse, null_space
from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import MechanismError
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.axes import zero_length
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.loop_product import closing_equations, split_product
from nag.mechanism.quaternion import (
    DualQuaternion,
    dual_conjugate,
    dual_multiply,
    norm_squared,
    rotate,
    translation,
)

HalfAngle = tuple[Number, Number]

ZERO, ONE = Fraction(0), Fraction(1)
_NONE = (ZERO, ZERO, ZERO, ZERO)
_AXIS: DualQuaternion = ((ZERO, ZERO, ZERO, ONE), _NONE)

# An equation has two to the number of open joints terms.
MOST_JOINTS = 12
# Tangents of the charts' turns, none at a special angle.
_CHARTS = tuple(
    Fraction(a, b)
    for a, b in (
        (3, 7), (-5, 9), (7, 11), (-4, 13), (8, 17),
        (-9, 19), (6, 23), (-11, 29), (13, 31), (-12, 37),
    )
)  # fmt: skip


class DHError(MechanismError):
    """A table that makes no sense.

    Attributes:
        joint: number of the row that is wrong, from 0, or None.
        key: the field that is wrong, or None.
    """

    def __init__(self, message: str, joint: int | None = None, key: str | None = None) -> None:
        super().__init__(message)
        self.joint = joint
        self.key = key


@dataclass(frozen=True)
class Row:
    """A joint and the link after it.

    Attributes:
        name: of the joint.
        a: length of the link, the distance of its two axes.
        d: offset along the joint's axis.
        alpha: (cos : sin) of half the link's twist, up to scale.
        theta: (cos : sin) of half the joint's angle, up to scale; None where it is open.
    """

    name: str
    a: Number
    d: Number
    alpha: HalfAngle
    theta: HalfAngle | None = None

    @property
    def link(self) -> DualQuaternion:
        """The row without its turn about z, up to a real factor."""
        offset: DualQuaternion = ((ONE, ZERO, ZERO, ZERO), (ZERO, ZERO, ZERO, self.d / 2))
        length: DualQuaternion = ((ONE, ZERO, ZERO, ZERO), (ZERO, self.a / 2, ZERO, ZERO))
        twist: DualQuaternion = ((self.alpha[0], self.alpha[1], ZERO, ZERO), _NONE)
        return dual_multiply(dual_multiply(offset, length), twist)


@dataclass(frozen=True)
class DHLoop:
    """A closed table.

    Raises:
        DHError: if there are too few or too many joints, or a name is there twice.
    """

    rows: tuple[Row, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "rows", tuple(self.rows))
        if len(self.rows) < 3:
            raise DHError(f"a loop needs at least 3 joints, not {len(self.rows)}")
        for i, row in enumerate(self.rows):
            if any(row.name == other.name for other in self.rows[:i]):
                raise DHError("another joint has that name", i, "name")
        if len(self.open) > MOST_JOINTS:
            raise DHError(f"{len(self.open)} open joints; at most {MOST_JOINTS} are multiplied out")

    @property
    def open(self) -> tuple[int, ...]:
        """Numbers of the joints whose angles are not given."""
        return tuple(i for i, row in enumerate(self.rows) if row.theta is None)


@dataclass(frozen=True)
class DHModel(AssemblyModel):
    """All ways to close a table with open angles.

    Attributes:
        loop: the table.
        kept: joints that have a variable; the other two open ones follow linearly.
        eliminated: these two.
        charts: for each kept joint the k of its chart (c : s) = (1 - k x : k + x).
        system: the equations; one group a variable; points of norm zero are excluded.
        coordinates: rows that give conj(A) in the basis that the eliminated joints span.
        product: the links after the kept joints.
        rank: number of closure equations and how many are independent, by exact linear algebra.
    """

    loop: DHLoop
    kept: tuple[int, ...]
    eliminated: tuple[int, int]
    charts: tuple[Fraction, ...]
    system: PolynomialSystem
    coordinates: tuple[tuple[Number, ...], ...]
    product: tuple[DualQuaternion, ...]
    rank: tuple[int, int]

    reference = None
    symmetries = ()
    space = "spatial"
    formulation = "H"
    described = "formulation H of the closed table"
    solution = "closing"

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts."""
        return len(self.loop.open) - 6

    @property
    def reason(self) -> str:
        """One sentence: what was made of the table."""
        open_joints, held = len(self.loop.open), len(self.loop.rows) - len(self.loop.open)
        text = f"loop of {len(self.loop.rows)} revolute joints by Denavit and Hartenberg's numbers"
        if held:
            text += f", {held} of them held at a given angle"
        names = " and ".join(self.loop.rows[i].name for i in self.eliminated)
        return (
            f"{text}; {open_joints} open angles, half-angles with {names} eliminated leave "
            f"{len(self.kept)} unknown{'' if len(self.kept) == 1 else 's'}"
        )

    @property
    def zero_links(self) -> tuple[str, ...]:
        """Which links have length zero, as both of their joints turn about one line."""
        rows = self.loop.rows
        # The half twist is 0 or a right angle.
        return tuple(
            zero_length(f"link after {first.name}", first.name, second.name)
            for first, second in zip(rows, (*rows[1:], rows[0]), strict=True)
            if is_zero(first.a) and any(map(is_zero, first.alpha))
        )

    def half_angles(self, point: Sequence[complex]) -> dict[str, tuple[complex, complex]]:
        """(c, s) of every open joint, up to scale each, at a solution of `system`."""
        return self.turns([complex(x) for x in point], lambda c: complex(float(c)))

    def turns(
        self, point: Sequence[Any], convert: Callable[[Number], Any]
    ) -> dict[str, tuple[Any, Any]]:
        """(c, s) of every open joint in some arithmetic, into which ``convert`` takes numbers."""
        one = convert(ONE)
        kept = [
            (one - convert(k) * x, convert(k) + x) for k, x in zip(self.charts, point, strict=True)
        ]
        factors: list[Any] = []
        for (c, s), after in zip(kept, self.product, strict=True):
            factors += [_turn(c, s), tuple(tuple(map(convert, part)) for part in after)]
        flat = _flat(dual_conjugate(_product(factors)))
        w = [
            sum((convert(y) * x for y, x in zip(row, flat, strict=True)), 0 * one)
            for row in self.coordinates
        ]
        ends = split_product(w, lambda x: abs(complex(x)))
        numbers = (*self.kept, *self.eliminated)
        return {self.loop.rows[i].name: x for i, x in zip(numbers, (*kept, *ends), strict=True)}


def dh_model(loop: DHLoop) -> DHModel:
    """The closure equations of a table, with two of its open joints eliminated.

    Raises:
        DHError: if fewer than three angles are open, or all axes of open joints are one line.
    """
    if len(loop.open) < 3:
        raise DHError(
            f"{len(loop.open)} open angles; leave at least three open, or give all of them"
        )
    numbers, links = opened(loop)
    shift, basis, regular = _eliminated(links)
    numbers = numbers[shift:] + numbers[:shift]
    links = links[shift:] + links[:shift]
    n = len(numbers) - 2
    charts, variables = _CHARTS[:n], Polynomial.variables(n)
    factors: list[Any] = []
    for k, x, after in zip(charts, variables, links, strict=False):
        factors += [_turn(1 - k * x, k + x), after]
    flat = _flat(dual_conjugate(_product(factors)))
    coordinates = tuple(left_inverse(basis))
    equations = closing_equations(flat, null_space(basis, 8), () if regular else coordinates)
    names = tuple(f"x_{loop.rows[i].name}" for i in numbers[:-2])
    system = PolynomialSystem(
        names,
        tuple(independent_polynomials(equations)),
        tuple(x * x + 1 for x in variables),
        tuple((i,) for i in range(n)),
    )
    return DHModel(
        loop, numbers[:-2], (numbers[-2], numbers[-1]), charts, system, coordinates,
        tuple(links[:n]), (len(equations), len(system.polynomials)),
    )  # fmt: skip


def assembled(loop: DHLoop) -> Mechanism:
    """The mechanism of a table whose angles are all given.

    Raises:
        DHError: if some are open, or the loop does not close; it names the gap.
    """
    if loop.open:
        raise DHError("some angles are open", loop.open[0], "theta")
    total: DualQuaternion = ((ONE, ZERO, ZERO, ZERO), _NONE)
    joints = []
    count = len(loop.rows)
    for i, row in enumerate(loop.rows):
        moved, size = translation(total)
        axis = tuple(x / size for x in rotate(total[0], (ZERO, ZERO, ONE)))
        point = tuple(x / size for x in moved)
        bodies = (f"link{(i - 1) % count + 1}", f"link{i + 1}")
        joints.append(Joint(row.name, "revolute", bodies, point, axis))
        total = dual_multiply(dual_multiply(total, _turn(*row.theta)), row.link)
    if not all(is_zero(x) for x in (*total[0][1:], *total[1])):
        raise DHError(_gap(total))
    return Mechanism(f"link{count}", tuple(joints))


def _gap(total: DualQuaternion) -> str:
    """How far a product of all rows is from the identity, in words."""
    moved, size = translation(total)
    distance = sqrt(sum((float(x) / float(size)) ** 2 for x in moved))
    cosine = min(1.0, abs(float(total[0][0])) / sqrt(float(norm_squared(total[0]))))
    return (
        f"the loop does not close: after the last row a gap of {distance:.3g} and a turn of "
        f"{degrees(2 * acos(cosine)):.3g} degrees are left; correct the table, or leave angles out "
        "to find how it closes"
    )


def opened(loop: DHLoop) -> tuple[tuple[int, ...], list[DualQuaternion]]:
    """The open joints, and all that is constant after each of them, as one factor."""
    start = loop.open[0]
    count = len(loop.rows)
    numbers: list[int] = []
    links: list[DualQuaternion] = []
    for i in ((start + j) % count for j in range(count)):
        row = loop.rows[i]
        if row.theta is None:
            numbers.append(i)
            links.append(row.link)
        else:
            held = dual_multiply(_turn(*row.theta), row.link)
            links[-1] = dual_multiply(links[-1], held)
    return tuple(numbers), links


def _eliminated(links: Sequence[DualQuaternion]) -> tuple[int, list[list[Number]], bool]:
    """Which joints to eliminate: how far to turn the loop, and the basis that the last two span.

    Two skew axes if there are; else the third value is False, and one more equation is needed.
    """
    count = len(links)
    readings = []
    for shift in range(count):
        before, after = links[(shift - 2) % count], links[(shift - 1) % count]
        span = [dual_multiply(x, y) for x, y in ((before, after),) * 4]
        span[1] = dual_multiply(_AXIS, span[0])
        span[2] = dual_multiply(before, dual_multiply(_AXIS, after))
        span[3] = dual_multiply(_AXIS, span[2])
        first, second = _pluecker(before)
        vector = [[x for part in q for x in part] for q in span]
        readings.append((shift, vector, first, second))
    for shift, basis, skew, _ in readings:
        if skew:
            return shift, basis, True
    for shift, basis, _, distinct in readings:
        if distinct:
            return shift, basis, False
    raise DHError("all axes are one line: every joint turns freely")


def _pluecker(between: DualQuaternion) -> tuple[bool, bool]:
    """Whether the axes before and after a constant factor are skew; whether they are two lines."""
    moved = dual_multiply(dual_multiply(between, _AXIS), dual_conjugate(between))
    direction, moment = moved[0][1:], moved[1][1:]
    # The first axis is the z axis: (0, 0, 1) with moment 0.
    skew = not is_zero(moment[2])
    same = all(is_zero(x) for x in (*direction[:2], *moment))
    return skew, not same


def _turn(c: Any, s: Any) -> DualQuaternion:
    """c + s k."""
    zero = 0 * c
    return (c, zero, zero, s), (zero, zero, zero, zero)


def _product(factors: Sequence[DualQuaternion]) -> DualQuaternion:
    result = factors[0]
    for factor in factors[1:]:
        result = dual_multiply(result, factor)
    return result


def _flat(x: DualQuaternion) -> list[Any]:
    return [entry for part in x for entry in part]
