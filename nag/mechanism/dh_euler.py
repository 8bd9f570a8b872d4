"""A table by Denavit and Hartenberg as bodies with frames: its loop in Euler parameters.

A body lies between two open joints. Its frame is that of the joint before it, after the turn, so
that the body's constant factor (p, v) of rotation and translation leads to the frame of the next
joint before its turn. Joint i + 1 turns about the common z axis: with r = conj(a) b for the bodies
a before and b after it, conj(p) r is a turn about z, two equations linear in r (T25, lemma 2.1).
The loop closes when the sum of all R(a) v vanishes. The last body is the base, its frame the
global one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from nag.algebra.elimination import Elimination, eliminate_linear
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.mechanism.configuration import arithmetic_of, as_entries
from nag.mechanism.dh import DHError, DHLoop, DHModel, TableModel, dh_model, open_joints
from nag.mechanism.euler import independent_equations, parameter_names, sign_changes
from nag.mechanism.formulations import Alternative
from nag.mechanism.quaternion import (
    DualQuaternion,
    Quaternion,
    conjugate,
    multiply,
    norm_squared,
    rotate,
    scale,
    translation,
)

ZERO, ONE = Fraction(0), Fraction(1)
_IDENTITY: Quaternion = (ONE, ZERO, ZERO, ZERO)


@dataclass(frozen=True)
class DHEulerModel(TableModel):
    """All ways to close a table, by the Euler parameters of the bodies between its open joints.

    Attributes:
        loop: the table.
        joints: numbers of the open joints, in the order of the loop; body i follows joint i.
        links: each body's rotation and translation from its joint's frame to the next one's.
        elimination: from all Euler parameters to the variables of `system`.
        system: norms, prime components of the joints, and the closure of the loop.
        symmetries: the sign changes of the bodies' Euler parameters.
    """

    loop: DHLoop
    joints: tuple[int, ...]
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
        before: Sequence[Any] = tuple(convert(x) for x in _IDENTITY)
        for i, number in enumerate(self.joints[:-1]):
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
    joints, links = open_joints(loop)
    moving = len(links) - 1
    names = parameter_names(moving)
    n = len(names)
    variables = Polynomial.variables(n)
    bodies = [tuple(variables[4 * i : 4 * i + 4]) for i in range(moving)]
    bodies.append(tuple(Polynomial.constant(n, x) for x in _IDENTITY))
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
    return DHEulerModel(loop, joints, tuple(links), elimination, system, symmetries)


# The formulations of a table, by rising number of paths.
FORMULATIONS = ("H", "E")


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


def table_alternatives(loop: DHLoop) -> tuple[Alternative, ...]:
    """A table in all its formulations."""
    return tuple(
        Alternative(name, table_model(loop, name))  # type: ignore[arg-type]
        for name in FORMULATIONS
    )
