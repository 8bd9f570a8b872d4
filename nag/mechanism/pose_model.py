"""Formulation P: the poses of a parallel robot's platform, its legs eliminated.

Its components are those of the poses. A general pose is reached by every leg in some ways, finitely
many or with idle freedoms; the configurations above a component may be several components, where
no motion leads from one way to another, and there may be others besides, at poses that a leg
reaches in more ways than in general. So it stands for all configurations only where it is asked
for, or where poses are finitely many and each leg reaches all of them in finitely many ways: then
its configurations are the combinations of these.

What it says near the reference pose is what is true of the reference configuration, if each leg is
regular there: its velocities have the dimension of its image, whose equations' gradients have the
rank of its codimension. Then the leg's configurations lie smoothly over the poses that its
equations allow, their idle freedoms besides.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from types import MappingProxyType
from typing import Any

import numpy as np

from nag.algebra.exact_ranks import rank
from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import MechanismError
from nag.mechanism.assembly_modes import REFERENCE, Modes
from nag.mechanism.configuration import Arithmetic, Configuration, arithmetic_of, configuration
from nag.mechanism.euler import slide_directions
from nag.mechanism.inverse_kinematics import find_joints
from nag.mechanism.joint_factors import Factor
from nag.mechanism.leg_ways import count_ways, find_leg_ways
from nag.mechanism.legs import parallel_robot
from nag.mechanism.loop_product import Element, displacement, move_place
from nag.mechanism.loops import LoopStructure
from nag.mechanism.platform import LegEquations, PlatformModel, platform_model
from nag.mechanism.quaternion import DualQuaternion, multiply, norm_squared, scale
from nag.text.table import count_text, join_words
from nag.tracking.run import Run, Stream

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
            there, and of joints that are held elsewhere.
        displacements: of joints that are held elsewhere, as `half_angles.LoopClosures.of` takes
            them.
    """

    structure: LoopStructure
    platform: PlatformModel
    reference: tuple[Number, ...]
    displacements: Mapping[str, DualQuaternion] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "displacements", fixed_mapping(self.displacements))

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

    def real_configurations(
        self, points: np.ndarray, run: Run
    ) -> tuple[np.ndarray, Configuration, list[str]]:
        """All real configurations above real poses, each leg in all of its ways.

        Of a leg that moves while the platform stands still one way is taken, if there is any.

        Args:
            points: solutions, shape ``(k, n)``.
            run: how the ways are counted.

        Returns:
            Which of the points each configuration is above; all of them, entry by entry; and what
            is not known.
        """
        model, rng = self.platform, run.random(Stream.POSE_MODEL)
        counts = [None if _idle(leg) else count_ways(leg.middle, run) for leg in model.legs]
        missing: dict[str, int] = {}
        index: list[int] = []
        rows: list[dict[Factor, np.ndarray]] = []
        for k, point in enumerate(points):
            kept = {f: np.array(x) for f, x in model.charts.at(list(point[7:]), float).items()}
            pose = model.study(point[None])[0]
            ways: list[list[dict[Factor, np.ndarray]]] = []
            for leg, count in zip(model.legs, counts, strict=True):
                middle, between = leg.between(pose, kept)
                if count is None:
                    one = find_joints(middle, between.real, model.length, rng, real=True)
                    own, lost = [] if one is None else [tuple(one)], not _idle(leg)
                else:
                    found = find_leg_ways(middle, between.real, count, model.length, rng)
                    own, lost = list(found.joints), found.missing > 0
                if lost:
                    missing[leg.leg.name] = missing.get(leg.leg.name, 0) + 1
                ways.append([_by_factor(middle, joints) for joints in own])
            for chosen in product(*ways):
                index.append(k)
                rows.append({f: x for own in (kept, *chosen) for f, x in own.items()})
        values = {f: tuple(np.array([row[f] for row in rows]).T) for f in (rows[0] if rows else {})}
        notes = [
            f"leg {name}: at {count_text(count, 'pose')} not all ways to reach it are known"
            for name, count in missing.items()
        ]
        placed = self._place(values, Arithmetic(float, np.sqrt)) if rows else None
        return np.array(index, dtype=int), placed, notes

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
            parts = zip(leg.leg.joints, leg.leg.bodies[1:], strict=True)
            for joint, body in parts:
                own = leg.leg.elements_of(joint)
                end += len(own)
                if body not in euler:
                    turn = displacement(elements[:end], values, convert)[0]
                    unit = scale(turn, 1 / arithmetic.sqrt(norm_squared(turn)))
                    frame = [convert(x) for x in mechanism.orientation(body)]
                    euler[body] = multiply(unit, frame)
                if slide_directions(joint) or joint.name in self.displacements:
                    place = [convert(x) for x in joint.point]
                    there = move_place(displacement(own, values, convert), place)
                    slides[joint.name] = tuple(x - y for x, y in zip(there, place, strict=True))
        return configuration(self.structure, euler, arithmetic, slides)


def _by_factor(
    elements: Sequence[Element], joints: Sequence[np.ndarray]
) -> dict[Factor, np.ndarray]:
    """Homogeneous coordinates of the factors among the elements of a product."""
    pairs = zip(elements, joints, strict=True)
    return {e.factor: own for e, own in pairs if e.factor is not None}


def pose_model(
    structure: LoopStructure,
    modes: Modes = REFERENCE,
    displacements: Mapping[str, DualQuaternion] = MappingProxyType({}),
) -> PoseModel:
    """The equations of the poses of the body with the most legs.

    Args:
        structure: the mechanism's part with loops.
        modes: has to be that of the reference.
        displacements: of joints that are held elsewhere, as `half_angles.LoopClosures.of` takes
            them.

    Raises:
        MechanismError: if there is no such body, a leg is no serial chain, not rational, or takes
            forms of too high a degree, or other joints than the legs' have loops.
        nag.interpolation.vanishing.InterpolationError: if forms have too long coefficients.
    """
    if modes:
        raise MechanismError("legs are taken as they are assembled, not in other assembly modes")
    robot = parallel_robot(structure.mechanism, displacements=displacements)
    legs = {j.name for leg in robot.legs for j in leg.joints}
    others = [j.name for j in structure.joints if j.name not in legs]
    if others:
        raise MechanismError(f"joints {join_words(others)} of no leg have loops of their own")
    platform = platform_model(robot, np.random.default_rng(SEED))
    known = not displacements and all(map(is_regular, platform.legs))
    return PoseModel(structure, platform, platform.reference if known else (), displacements)


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
