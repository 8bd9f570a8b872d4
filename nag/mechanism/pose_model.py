"""Formulation P: the poses of a parallel robot's platform, its legs eliminated.

Its components are those of the poses. A general pose is reached by every leg in some ways, finitely
many or with idle freedoms; the configurations above a component may be several components, where
no motion leads from one way to another, and there may be others besides, at poses that a leg
reaches in more ways than in general. So it stands for all configurations only where it is asked
for.

What it says near the reference pose is what is true of the reference configuration, if each leg is
regular there: its velocities have the dimension of its image, whose equations' gradients have the
rank of its codimension. Then the leg's configurations lie smoothly over the poses that its
equations allow, their idle freedoms besides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from nag.algebra.exact_ranks import rank
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import MechanismError
from nag.mechanism.assembly_modes import REFERENCE, Modes
from nag.mechanism.configuration import Arithmetic, Configuration, arithmetic_of, configuration
from nag.mechanism.euler import slide_directions
from nag.mechanism.inverse_kinematics import find_joints
from nag.mechanism.joint_factors import Factor
from nag.mechanism.legs import parallel_robot
from nag.mechanism.loop_product import displacement, joint_elements, move_place
from nag.mechanism.loops import LoopStructure
from nag.mechanism.platform import LegEquations, PlatformModel, platform_model
from nag.mechanism.quaternion import multiply, norm_squared, scale
from nag.text.table import join_words

# The same model each time: random numbers are those of this seed.
SEED = 40
# Decides: Imaginary parts of Study coordinates of a pose, relative, that is lifted to real joints.
REAL = 1e-12


@dataclass(frozen=True, eq=False)
class PoseModel:
    """The platform's poses as a model of a mechanism.

    Attributes:
        structure: the mechanism's part with loops.
        platform: the equations.
        reference: the reference configuration, an exact solution; empty where a leg is not regular
            there.
    """

    structure: LoopStructure
    platform: PlatformModel
    reference: tuple[Number, ...]

    @property
    def system(self) -> PolynomialSystem:
        """The equations, in Study coordinates and the coordinates of joints that legs keep."""
        return self.platform.system

    @property
    def left_out(self) -> list[tuple[int, str]]:
        """Freedoms of the legs that leave the platform where it is, where it is in general."""
        count = sum(map(_idle, self.platform.legs))
        return [(count, "legs that move while the platform stands still")] if count else []

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution.

        Exact at the reference. Elsewhere the legs' joints are found numerically, in doubles: of the
        ways in which a leg reaches the pose the first that is met, a real one if there is one.

        Raises:
            MechanismError: if a leg does not reach the pose, as far as is known.
            ZeroDivisionError: at a point of norm zero.
        """
        if tuple(point) == self.platform.reference:
            arithmetic = arithmetic_of(point)
            one, zero = Fraction(1), Fraction(0)
            values = {
                e.factor: (one, *[zero] * e.factor.dimension)
                for leg in self.platform.legs
                for e in leg.leg.elements()
                if e.factor is not None
            }
        else:
            arithmetic = arithmetic_of([0j])
            values = self._joints(np.array([complex(x) for x in point]))
        return self._place(values, arithmetic)

    def _joints(self, point: np.ndarray) -> dict[Factor, tuple[Any, ...]]:
        """Homogeneous coordinates of all joints' factors."""
        model = self.platform
        kept = model.charts.at(list(point[7:]), lambda c: complex(float(c)))
        pose = model.study(point[None])[0]
        values = dict(kept)
        rng = np.random.default_rng(SEED)
        for leg in model.legs:
            middle, between = leg.between(pose, kept)
            between = between / np.linalg.norm(between)
            largest = between[np.argmax(np.abs(between))]
            between = between * abs(largest) / largest
            ways = [True, False] if np.abs(between.imag).max() < REAL else [False]
            for real in ways:
                goal = between.real if real else between
                found = find_joints(middle, goal, model.length, rng, real)
                if found is not None:
                    break
            else:
                raise MechanismError(f"leg {leg.leg.name} is not known to reach the pose")
            for element, own in zip(middle, found, strict=True):
                values[element.factor] = tuple(map(complex, own))
        return values

    def _place(self, values: dict[Any, Any], arithmetic: Arithmetic) -> Configuration:
        convert, mechanism = arithmetic.convert, self.structure.mechanism
        euler: dict[str, Any] = {}
        slides: dict[str, Any] = {}
        for leg in self.platform.legs:
            elements = leg.leg.elements()
            end = 0
            for joint, body in zip(leg.leg.joints, leg.leg.bodies[1:], strict=True):
                own = joint_elements(joint, 0, True)
                end += len(own)
                if body not in euler:
                    turn = displacement(elements[:end], values, convert)[0]
                    unit = scale(turn, 1 / arithmetic.sqrt(norm_squared(turn)))
                    frame = [convert(x) for x in mechanism.orientation(body)]
                    euler[body] = multiply(unit, frame)
                if slide_directions(joint):
                    place = [convert(x) for x in joint.point]
                    there = move_place(displacement(own, values, convert), place)
                    slides[joint.name] = tuple(x - y for x, y in zip(there, place, strict=True))
        return configuration(self.structure, euler, arithmetic, slides)


def pose_model(structure: LoopStructure, modes: Modes = REFERENCE) -> PoseModel:
    """The equations of the poses of the body with the most legs.

    Raises:
        MechanismError: if there is no such body, a leg is no serial chain, not rational, or takes
            forms of too high a degree, or other joints than the legs' have loops.
        nag.interpolation.vanishing.InterpolationError: if forms have too long coefficients.
    """
    if modes:
        raise MechanismError("legs are taken as they are assembled, not in other assembly modes")
    robot = parallel_robot(structure.mechanism)
    legs = {j.name for leg in robot.legs for j in leg.joints}
    others = [j.name for j in structure.joints if j.name not in legs]
    if others:
        raise MechanismError(f"joints {join_words(others)} of no leg have loops of their own")
    platform = platform_model(robot, np.random.default_rng(SEED))
    regular = all(map(is_regular, platform.legs))
    return PoseModel(structure, platform, platform.reference if regular else ())


def is_regular(leg: LegEquations) -> bool:
    """Whether the reference is a regular configuration of a leg and a smooth point of its image."""
    image = leg.image
    generators = [g for e in leg.middle for g in e.generators]
    velocities = [tuple(x for part in g for x in part) for g in generators]
    if rank(velocities) - 1 != image.dimension:
        return False
    identity = (Fraction(1), *[Fraction(0)] * 7)
    forms: tuple[Polynomial, ...] = (*image.known, *image.forms)
    gradients = [tuple(f.derivative(i)(identity) for i in range(8)) for f in forms]
    return rank(gradients) == image.codimension if gradients else not image.codimension


def _idle(leg: LegEquations) -> int:
    """Freedoms of what is between a leg's kept joints that leave its ends where they are."""
    own = sum(e.factor.dimension for e in leg.middle if e.factor is not None)
    return own - leg.image.dimension
