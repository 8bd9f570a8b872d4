"""Single loops of revolute joints by Denavit and Hartenberg's numbers.

Row i of the table takes the frame of joint i to that of joint i + 1: a turn by theta about z, a
slide by d along z, a slide by a along x, a turn by alpha about x. The loop closes when the product
of all rows is the identity. In dual quaternions a turn of half-angle (c : s) is c + s k, all other
factors are constant, and the product has to be a real number (Hegedus, Schicho & Schroecker 2013).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import acos, degrees, sqrt
from typing import Any

from nag.algebra.exact_ranks import independent_polynomials
from nag.algebra.number import Number, is_zero
from nag.algebra.system import PolynomialSystem
from nag.errors import MechanismError
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.axes import zero_length
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.joint_factors import UNIT, Charts, Factor
from nag.mechanism.loop_product import Closure, Element, closure_of
from nag.mechanism.quaternion import (
    DualQuaternion,
    dual_multiply,
    norm_squared,
    rotate,
    translation,
)
from nag.text.table import count_text

HalfAngle = tuple[Number, Number]

ZERO, ONE = Fraction(0), Fraction(1)
_NONE = (ZERO, ZERO, ZERO, ZERO)
_AXIS: DualQuaternion = ((ZERO, ZERO, ZERO, ONE), _NONE)

# An equation has two to the number of open joints terms.
MOST_JOINTS = 12


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


class TableModel(AssemblyModel):
    """All ways to close a table with open angles, in whatever formulation.

    Attributes:
        loop: the table.
    """

    loop: DHLoop

    space = "spatial"
    solution = "closing"

    @property
    def formulation_text(self) -> str:
        """What the equations are, as text."""
        return f"formulation {self.formulation} of the closed table"

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts."""
        return len(self.loop.open) - 6


@dataclass(frozen=True)
class DHModel(TableModel):
    """All ways to close a table, by the half-angles of its open joints.

    Attributes:
        loop: the table.
        closure: the product of turns and links; two turns are eliminated and follow linearly.
        charts: the turns that have a variable.
        system: the equations; one group a variable; points of norm zero are excluded.
    """

    loop: DHLoop
    closure: Closure
    charts: Charts
    system: PolynomialSystem

    formulation = "H"

    @property
    def reason(self) -> str:
        """One sentence: what was made of the table."""
        open_joints, held = len(self.loop.open), len(self.loop.rows) - len(self.loop.open)
        text = f"loop of {len(self.loop.rows)} revolute joints by Denavit and Hartenberg's numbers"
        if held:
            text += f", {held} of them held at a given angle"
        names = " and ".join(turn.joint for turn in self.closure.lost)
        return (
            f"{text}; {open_joints} open angles, half-angles with {names} eliminated leave "
            f"{count_text(self.system.n, 'unknown')}"
        )

    @property
    def rank(self) -> tuple[int, int]:
        """Number of closure equations and how many are independent, by exact linear algebra."""
        return self.closure.equations, len(self.system.polynomials)

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
        values = self.charts.at(point, convert)
        values |= self.closure.recover(values.__getitem__, convert)
        return {turn.joint: (c, s) for turn, (c, s) in values.items()}


def dh_model(loop: DHLoop) -> DHModel:
    """The closure equations of a table, with two of its open joints eliminated.

    Raises:
        DHError: if fewer than three angles are open, or all axes of open joints are one line.
    """
    if len(loop.open) < 3:
        raise DHError(
            f"{len(loop.open)} open angles; leave at least three open, or give all of them"
        )
    closure = _choose_closure(loop)
    charts = Charts.of([e.factor for e in closure.kept if e.factor is not None])
    equations = independent_polynomials(closure.polynomials(charts.values.__getitem__))
    return DHModel(loop, closure, charts, replace(charts.system(()), polynomials=tuple(equations)))


def assemble_table(loop: DHLoop) -> Mechanism:
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


def open_joints(loop: DHLoop) -> tuple[tuple[int, ...], list[DualQuaternion]]:
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


def _choose_closure(loop: DHLoop) -> Closure:
    """The loop with two neighbouring turns eliminated, about skew axes if there are such."""
    elements: list[Element] = []
    for number, link in zip(*open_joints(loop), strict=True):
        turn = Factor(loop.rows[number].name, "turn", (UNIT, _AXIS))
        elements += [Element(turn, turn.generators), Element(None, (link,))]
    found = []
    for shift in range(0, len(elements), 2):
        around = [*elements[shift:], *elements[:shift]]
        closure = closure_of(around[:-4], around[-4:])
        if closure is not None and not closure.quadric:
            return closure
        found.append(closure)
    for closure in found:
        if closure is not None:
            return closure
    raise DHError("all axes are one line: every joint turns freely")


def _turn(c: Any, s: Any) -> DualQuaternion:
    """c + s k."""
    zero = 0 * c
    return (c, zero, zero, s), (zero, zero, zero, zero)
