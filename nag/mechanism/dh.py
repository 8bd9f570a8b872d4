"""Single loops of revolute joints by Denavit and Hartenberg's numbers.

Row i of the table takes the frame of joint i to that of joint i + 1: a turn by theta about z, a
slide by d along z, a slide by a along x, a turn by alpha about x. The loop closes when the product
of all rows is the identity. In dual quaternions a turn of half-angle (c : s) is c + s k, all other
factors are constant, and the product has to be a real number (Hegedus, Schicho & Schroecker 2013).
This one product gives both formulations. In half-angles two neighbouring turns of it are eliminated
(`loop_product`).

In Euler parameters a body lies between two open joints. Its frame is that of the joint before it,
after the turn, so that the body's constant factor (p, v) of rotation and translation leads to the
frame of the next joint before its turn. Joint i + 1 turns about the common z axis: with
r = conj(a) b for the bodies a before and b after it, conj(p) r is a turn about z, two equations
linear in r (T25, lemma 2.1). The loop closes when the sum of all R(a) v vanishes. The last body is
the base, its frame the global one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import acos, atan2, degrees, sqrt
from typing import Any

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.exact_ranks import independent_polynomials
from nag.algebra.from_python import exact_number
from nag.algebra.given import check_listed
from nag.algebra.number import Number, brief_number_text, cosine, is_zero, pi_multiple, sine
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import is_part_name, part_name_text
from nag.errors import MechanismError
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.axes import zero_length
from nag.mechanism.configuration import arithmetic_of, as_entries
from nag.mechanism.euler import independent_equations, parameter_names, sign_changes
from nag.mechanism.given_rotation import turn_about
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.joint_factors import NOTHING, ONE, UNIT, ZERO, Charts, Factor
from nag.mechanism.loop_product import Closure, Element, closure_of
from nag.mechanism.path_estimates import Alternative
from nag.mechanism.quaternion import (
    DualQuaternion,
    conjugate,
    dual_multiply,
    multiply,
    norm_squared,
    rotate,
    scale,
    translation,
)
from nag.text.table import count_text, lines_of, one_line

HalfAngle = tuple[Number, Number]

_AXIS: DualQuaternion = ((ZERO, ZERO, ZERO, ONE), NOTHING)

# The formulations of a table, by rising number of paths.
FORMULATIONS = ("H", "E")

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

    def __str__(self) -> str:
        number: Any = self.joint
        row = "" if number is None else f"row {number + 1}"
        return ": ".join([*filter(None, (row, self.key)), self.message])


@dataclass(frozen=True)
class Row:
    """A joint and the link after it.

    Half-angles are given up to scale and kept as (1 : tangent), or (0 : 1), so that equal rows make
    equal equations.

    Attributes:
        name: of the joint.
        a: length of the link, the distance of its two axes.
        d: offset along the joint's axis.
        alpha: (cos : sin) of half the link's twist.
        theta: (cos : sin) of half the joint's angle; None where it is open.
    """

    name: str
    a: Number
    d: Number
    alpha: HalfAngle
    theta: HalfAngle | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "alpha", _scale_half_angle(self.alpha))
        if self.theta is not None:
            object.__setattr__(self, "theta", _scale_half_angle(self.theta))

    @property
    def link(self) -> DualQuaternion:
        """The row without its turn about z, up to a real factor."""
        offset: DualQuaternion = ((ONE, ZERO, ZERO, ZERO), (ZERO, ZERO, ZERO, self.d / 2))
        length: DualQuaternion = ((ONE, ZERO, ZERO, ZERO), (ZERO, self.a / 2, ZERO, ZERO))
        twist: DualQuaternion = ((self.alpha[0], self.alpha[1], ZERO, ZERO), NOTHING)
        return dual_multiply(dual_multiply(offset, length), twist)

    @property
    def displacement(self) -> DualQuaternion:
        """The whole row, its angle being given, up to a real factor."""
        assert self.theta is not None
        c, s = self.theta
        return dual_multiply(((c, ZERO, ZERO, s), NOTHING), self.link)


def _scale_half_angle(half: HalfAngle) -> HalfAngle:
    """The same with cosine 1, or with sine 1 at half a turn."""
    cosine, sine = half
    return (ZERO, ONE) if is_zero(cosine) else (ONE, sine / cosine)


@dataclass(frozen=True)
class DHLoop:
    """A closed table.

    Raises:
        DHError: if there are too few or too many joints, or a name is there twice.
    """

    rows: tuple[Row, ...]

    @classmethod
    def of(cls, rows: Iterable[Mapping[str, Any]]) -> DHLoop:
        """The table of rows by Denavit and Hartenberg's letters.

        Args:
            rows: each a mapping of ``a``, ``d`` (0 by default), ``alpha``, ``theta`` (radians, open
                if it is not there) and ``name``; ``alpha_half_tangent`` and ``theta_half_tangent``
                may stand for the angles.

        Raises:
            DHError: if the table makes no sense.
            nag.EquationError: if something is no number.

        >>> import nag
        >>> rows = [{"a": 1, "alpha": "pi/2"}, {"a": 2, "alpha": "pi/6"}] * 2
        >>> nag.mobility(nag.DHLoop.of(rows)).local_dimension
        0
        """
        check_listed(rows, "rows", "a list of rows, each a dict")
        return cls(tuple(_row_of(i, row) for i, row in enumerate(rows)))

    def __post_init__(self) -> None:
        object.__setattr__(self, "rows", tuple(self.rows))
        if len(self.rows) < 3:
            raise DHError(f"a loop needs at least 3 joints, not {len(self.rows)}")
        for i, row in enumerate(self.rows):
            if not is_part_name(row.name):
                raise DHError(part_name_text(row.name, "joint"), i, "name")
            if any(row.name == other.name for other in self.rows[:i]):
                raise DHError("another joint has that name", i, "name")
        if len(self.open) > MOST_JOINTS:
            raise DHError(f"{len(self.open)} open joints; at most {MOST_JOINTS} are multiplied out")

    __repr__ = one_line

    def __str__(self) -> str:
        names = ", ".join(row.name for row in self.rows)
        title = f"DHLoop of {count_text(len(self.rows), 'joint')} ({names}), {len(self.open)} open"
        rows = []
        for row in self.rows:
            values = f"a = {brief_number_text(row.a)}, d = {brief_number_text(row.d)}"
            for name, half in (("alpha", row.alpha), ("theta", row.theta)):
                if half is not None:
                    turn = 2 * atan2(float(half[1]), float(half[0]))
                    values += f", {name} = {degrees(turn):.6g} degrees"
            rows.append((row.name, values))
        return lines_of(title, rows)

    @property
    def open(self) -> tuple[int, ...]:
        """Numbers of the joints whose angles are not given."""
        return tuple(i for i, row in enumerate(self.rows) if row.theta is None)

    @property
    def links(self) -> list[DualQuaternion]:
        """All that is constant after each open joint, up to the next one, as one factor."""
        found: list[DualQuaternion] = []
        start = self.open[0]
        for row in (*self.rows[start:], *self.rows[:start]):
            if row.theta is None:
                found.append(row.link)
            else:
                found[-1] = dual_multiply(found[-1], row.displacement)
        return found


_KEYS = ("name", "a", "d", "alpha", "alpha_half_tangent", "theta", "theta_half_tangent")


def half_angle(angle: Number) -> HalfAngle:
    """(cos : sin) of half an angle, up to scale."""
    turns = pi_multiple(angle)
    if turns is not None and turns % 2 == 1:
        return ZERO, ONE
    return 1 + cosine(angle), sine(angle)


def _row_of(index: int, given: Any) -> Row:
    if not isinstance(given, Mapping):
        raise DHError("give a mapping, with alpha and what is not 0 of a and d", index)
    for key in given:
        if key not in _KEYS:
            raise DHError(f"unknown key; the keys are {', '.join(_KEYS)}", index, str(key))
    angles: dict[str, HalfAngle] = {}
    for key in ("alpha", "theta"):
        tangent = f"{key}_half_tangent"
        if given.get(tangent) is not None:
            if given.get(key) is not None:
                raise DHError(f"{key} is given as well; leave one of them out", index, tangent)
            angles[key] = ONE, exact_number(given[tangent], f"rows[{index}]: {tangent}")
        elif given.get(key) is not None:
            angles[key] = half_angle(exact_number(given[key], f"rows[{index}]: {key}"))
    if "alpha" not in angles:
        raise DHError("is missing; give the link's twist", index, "alpha")
    a, d = (exact_number(given.get(key, 0), f"rows[{index}]: {key}") for key in "ad")
    return Row(str(given.get("name", f"J{index + 1}")), a, d, angles["alpha"], angles.get("theta"))


class TableModel(AssemblyModel):
    """All ways to close a table with open angles, in whatever formulation.

    Attributes:
        loop: the table.
    """

    loop: DHLoop

    space = "spatial"
    joint_types = ("revolute",)
    solution = "closing"

    @property
    def formulation_text(self) -> str:
        """What the equations are, as text."""
        return f"formulation {self.formulation} of the closed table"

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts."""
        return len(self.loop.open) - 6

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """The table in all its formulations, by rising number of paths."""
        return tuple(Alternative(name, table_model(self.loop, name)) for name in FORMULATIONS)


@dataclass(frozen=True, repr=False)
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


def check_open(loop: DHLoop) -> None:
    """Make sure that enough angles of a table are open for its loop to be closed.

    Raises:
        DHError: if fewer than three are.
    """
    if len(loop.open) < 3:
        raise DHError(
            f"{len(loop.open)} open angles; leave at least three open, or give all of them"
        )


def dh_model(loop: DHLoop) -> DHModel:
    """The closure equations of a table, with two of its open joints eliminated.

    Raises:
        DHError: if fewer than three angles are open, or all axes of open joints are one line.
    """
    check_open(loop)
    closure = _choose_closure(loop)
    charts = Charts.of([e.factor for e in closure.kept if e.factor is not None])
    equations = independent_polynomials(closure.polynomials(charts))
    return DHModel(loop, closure, charts, replace(charts.system(()), polynomials=tuple(equations)))


def hold_rows(loop: DHLoop, angles: Mapping[str, Number]) -> DHModel:
    """The closure equations of a table with some of its open joints at angles.

    Args:
        loop: the table.
        angles: by the joints' names, in radians; rounded to 16 digits where they are no multiples
            of pi/12.

    Raises:
        DHError: as `dh_model` does.
    """
    rows = []
    for row in loop.rows:
        if row.name in angles:
            turn = turn_about((ZERO, ZERO, ONE), angles[row.name]).quaternion
            row = replace(row, theta=(turn[0], turn[3]))
        rows.append(row)
    return dh_model(DHLoop(tuple(rows)))


def assemble_table(loop: DHLoop) -> Mechanism:
    """The mechanism of a table whose angles are all given.

    Raises:
        DHError: if some are open, or the loop does not close; it names the gap.
    """
    if loop.open:
        raise DHError("some angles are open", loop.open[0], "theta")
    total = UNIT
    joints = []
    count = len(loop.rows)
    for i, row in enumerate(loop.rows):
        moved, size = translation(total)
        axis = tuple(x / size for x in rotate(total[0], (ZERO, ZERO, ONE)))
        point = tuple(x / size for x in moved)
        bodies = (f"link{(i - 1) % count + 1}", f"link{i + 1}")
        joints.append(Joint(row.name, "revolute", bodies, point, axis))
        total = dual_multiply(total, row.displacement)
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


def _choose_closure(loop: DHLoop) -> Closure:
    """The loop with two neighbouring turns eliminated, about skew axes if there are such."""
    elements: list[Element] = []
    for number, link in zip(loop.open, loop.links, strict=True):
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


@dataclass(frozen=True, repr=False)
class DHEulerModel(TableModel):
    """All ways to close a table, by the Euler parameters of the bodies between its open joints.

    Attributes:
        loop: the table.
        links: each body's rotation and translation from its joint's frame to the next one's; body i
            follows the i-th open joint.
        elimination: from all Euler parameters to the variables of `system`.
        system: norms, prime components of the joints, and the closure of the loop.
        symmetries: the sign changes of the bodies' Euler parameters.
    """

    loop: DHLoop
    links: tuple[DualQuaternion, ...]
    elimination: Elimination
    system: PolynomialSystem
    symmetries: tuple[SignedPermutation, ...]

    formulation = "E"

    @property
    def points_of_each(self) -> int:
        """How many solutions each closing is: Euler parameters have signs."""
        return 2 ** len(self.symmetries)

    @property
    def reason(self) -> str:
        """One sentence: what was made of the table."""
        moving = len(self.links) - 1
        return (
            f"formulation E: loop of {len(self.loop.rows)} revolute joints by Denavit and "
            f"Hartenberg's numbers; Euler parameters of {moving} bodies, each in the frame of the "
            f"joint before it, {2 ** len(self.symmetries)} sign changes of them keep the equations"
        )

    def of_half_angles(self, source: DHModel, point: Sequence[Any]) -> tuple[Any, ...]:
        """The point of `system`, one of an orbit, that a closing in half-angles is.

        Exact for exact points, with square roots where norms are no squares.

        Raises:
            ZeroDivisionError: at a point of norm zero, which is no closing.
        """
        point = as_entries(point)
        arithmetic = arithmetic_of(point)
        convert = arithmetic.convert
        angles = source.turns(point, convert)
        values: list[Any] = []
        before: Sequence[Any] = tuple(convert(x) for x in UNIT[0])
        for i, number in enumerate(self.loop.open[:-1]):
            c, s = angles[self.loop.rows[number].name]
            rotation = tuple(convert(x) for x in self.links[i - 1][0])
            turned = multiply(multiply(before, rotation), (c, 0 * c, 0 * c, s))
            before = scale(turned, convert(ONE) / arithmetic.sqrt(norm_squared(turned)))
            values += before
        return tuple(values[k] for k in self.elimination.kept)


def dh_euler_model(loop: DHLoop) -> DHEulerModel:
    """The closure equations of a table in Euler parameters.

    Raises:
        DHError: if no angle is open.
    """
    if not loop.open:
        raise DHError("no angle is open; leave some open")
    links = loop.links
    moving = len(links) - 1
    names = parameter_names(moving)
    n = len(names)
    variables = Polynomial.variables(n)
    bodies = [tuple(variables[4 * i : 4 * i + 4]) for i in range(moving)]
    bodies.append(tuple(Polynomial.constant(n, x) for x in UNIT[0]))
    equations = [norm_squared(a) - 1 for a in bodies[:-1]]
    for i in range(moving + 1):
        # The body before the first one is the base, the last.
        turn = multiply(conjugate(links[i - 1][0]), multiply(conjugate(bodies[i - 1]), bodies[i]))
        equations += turn[1:3]
    total: Sequence[Any] = (ZERO,) * 3
    for body, link in zip(bodies, links, strict=True):
        moved, size = translation(link)
        turned = rotate(body, tuple(x / size for x in moved))
        total = tuple(x + y for x, y in zip(turned, total, strict=True))
    equations += total
    full = PolynomialSystem(names, tuple(f for f in equations if f))
    elimination = eliminate_linear(full, graphs=False)
    system = independent_equations(elimination)
    symmetries = tuple(map(SignedPermutation.of_signs, sign_changes(moving, elimination)))
    return DHEulerModel(loop, tuple(links), elimination, system, symmetries)


def table_model(loop: DHLoop, formulation: str) -> DHModel | DHEulerModel:
    """A table's equations in half-angles or in Euler parameters.

    Raises:
        DHError: if it has no such formulation, or too few angles are open.
    """
    if formulation not in FORMULATIONS:
        raise DHError(
            f"formulation {formulation}: a table has formulations {' and '.join(FORMULATIONS)}"
        )
    return dh_model(loop) if formulation == "H" else dh_euler_model(loop)
