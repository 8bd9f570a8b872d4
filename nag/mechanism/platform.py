"""The platform alone: the system of a parallel robot in the coordinates of its platform's pose.

Each leg is its image's forms (`leg_image`); with Study's quadric these are all equations that there
are. A leg whose image takes forms of too high a degree keeps some of its joints, those next to the
ground or the platform: what is left of it between them has an image of low degree, and the pose
relative to the kept joints lies on that. One affine chart covers all poses but those of a random
plane, and none where x0 to x3 vanish, which are no displacements.

Coordinates count from a place amidst the joints, about which the legs' forms have the fewest terms,
wherever the robot stands: poses and forms are told in the coordinates that were given.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import factorial, prod
from typing import Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.number import Irrational, Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.root_basis import MOST_DEGREE as MOST_DEGREE_OF_COSINES
from nag.algebra.system import PolynomialSystem
from nag.errors import MechanismError
from nag.interpolation.image_forms import ImageForms
from nag.mechanism.graph import Vector
from nag.mechanism.inverse_kinematics import conjugate_pose, multiply_poses
from nag.mechanism.joint_factors import NOTHING, ONE, UNIT, ZERO, Charts, Factor, primitive
from nag.mechanism.leg_image import (
    COORDINATES,
    MOST_DEGREE,
    Place,
    ProductOfFactors,
    forms_about_origin,
    image_of_chain,
    norm_form,
    study_quadric,
)
from nag.mechanism.legs import Leg, ParallelRobot
from nag.mechanism.loop_product import Element, displacement, factors_in
from nag.mechanism.quaternion import dual_conjugate, dual_multiply
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank
from nag.numerics.natural_coordinates import shorten_origin
from nag.numerics.read_only import equal_values

# Forms of what is left of a leg that keeps joints.
MOST_DEGREE_BESIDE_JOINTS = 2
# Coefficients of the chart are dyadic fractions with this denominator, of size up to one.
CHART_STEPS = 2**12


@dataclass(frozen=True, eq=False)
class LegEquations:
    """What a leg says of the pose.

    Attributes:
        leg: the leg.
        before, behind: the factors that it keeps, next to the ground and next to the platform.
        image: of what is between them.
        dimension: of the image of the whole leg.
    """

    leg: Leg
    before: tuple[Element, ...]
    behind: tuple[Element, ...]
    image: ImageForms
    dimension: int

    __eq__ = equal_values

    @property
    def kept(self) -> tuple[Element, ...]:
        """The factors that it keeps."""
        return self.before + self.behind

    @cached_property
    def middle(self) -> tuple[Element, ...]:
        """The factors between those that it keeps."""
        elements = self.leg.elements()
        return elements[len(self.before) : len(elements) - len(self.behind)]

    def is_singular_at(self, pose: np.ndarray) -> bool:
        """Whether its equations are singular at a pose that satisfies them.

        With Study's quadric they are dependent in first order there, more than elsewhere. Of a leg
        that keeps joints nothing is said.

        Args:
            pose: Study coordinates, shape ``(8,)``.
        """
        forms = (study_quadric(), *self.image.forms)
        if self.kept or not self.image.forms:
            return False
        # Of a form of which the coefficients and the pose are of size one.
        rows = Evaluator.of(forms, 8).jacobian(pose / np.abs(pose).max())
        return 8 - matrix_corank(rows, NEARLY_SINGULAR) < self.image.codimension

    def between(
        self, pose: np.ndarray, kept: Mapping[Factor, Sequence[Any]]
    ) -> tuple[tuple[Element, ...], np.ndarray]:
        """The factors between the kept ones, and what their product is at a pose.

        Args:
            pose: Study coordinates, shape ``(8,)``.
            kept: homogeneous coordinates of the kept factors.
        """
        parts = []
        for own in (self.before, self.behind):
            motion = displacement(own, kept, lambda c: complex(float(c))) if own else UNIT
            entries = np.array([complex(x) for part in motion for x in part])
            parts.append(conjugate_pose(entries))
        return self.middle, multiply_poses(multiply_poses(parts[0], pose), parts[1])

    @property
    def idle(self) -> int:
        """How many freedoms of the leg leave the platform where it is."""
        return self.leg.freedoms - self.dimension

    @property
    def path_factor(self) -> int:
        """By how much its forms multiply Bezout's number of the pose.

        The coefficient of the least power of the pose's class in the product of theirs, where every
        kept factor has a class of its own.
        """
        count = self.image.codimension - len(self.image.known)
        own = sum(e.factor.dimension for e in self.kept if e.factor is not None)
        degrees = sorted(f.degree for f in self.image.forms)[:count]
        return prod(degrees) * factorial(count) // factorial(count - own) if count >= own else 0


@dataclass(frozen=True, eq=False)
class PlatformModel:
    """The system of a platform's pose.

    Attributes:
        robot: the mechanism.
        legs: what each leg says, its joints and forms in the system's coordinates.
        chart: c1, c2, c3 of the affine chart x0 = 1 + c1 x1 + c2 x2 + c3 x3.
        charts: of the factors that legs keep.
        system: the equations: in x1, x2, x3 and y0 to y3, and in coordinates of kept factors.
        origin: the place, in the coordinates that were given, that those of the system count from.
    """

    robot: ParallelRobot
    legs: tuple[LegEquations, ...]
    chart: tuple[Fraction, Fraction, Fraction]
    charts: Charts
    system: PolynomialSystem
    origin: Place

    __eq__ = equal_values

    @property
    def reference(self) -> tuple[Number, ...]:
        """The reference configuration, a solution."""
        return (Fraction(0),) * 7 + self.charts.reference

    @cached_property
    def length(self) -> float:
        """The largest distance between points of joints, by which lengths are measured."""
        return _extent(_places([leg.leg for leg in self.legs]))

    def study(self, points: np.ndarray) -> np.ndarray:
        """Study coordinates at solutions, from shape ``(k, n)`` to ``(k, 8)``."""
        first = 1 + points[:, :3] @ np.array([float(c) for c in self.chart])
        return np.hstack([first[:, None], points[:, :7]])

    def system_of(self, leg: LegEquations) -> PolynomialSystem:
        """The equations of one leg alone, which keeps no joints, in the coordinates of the pose."""
        return _system((leg,), self.chart, Charts.of(()))

    def given_forms(self, leg: LegEquations) -> tuple[Polynomial, ...]:
        """The forms of a leg, in the coordinates that were given."""
        return forms_about_origin(leg.image.forms, self.origin)

    @property
    def forms(self) -> tuple[Polynomial, ...]:
        """Study's quadric and the forms of the legs that keep no joints, as `given_forms`."""
        own = (f for leg in self.legs if not leg.kept for f in self.given_forms(leg))
        return tuple(dict.fromkeys((study_quadric(), *own)))


def platform_model(robot: ParallelRobot, rng: np.random.Generator) -> PlatformModel:
    """The system of a platform's pose.

    Raises:
        MechanismError: if a leg has loops of its own, or a joint is given by other numbers than
            sums of square roots.
        nag.interpolation.vanishing.InterpolationError: if forms have too long coefficients.
    """
    for leg in robot.legs:
        _check_leg(leg, robot.platform)
    middle = _middle(robot.legs)
    legs = tuple(_leg_equations(_shift_leg(leg, middle), rng) for leg in robot.legs)
    step = _sparsest_place(legs)
    legs = tuple(_shift_equations(leg, step) for leg in legs)
    steps = rng.integers(-CHART_STEPS, CHART_STEPS + 1, 3).tolist()
    chart = tuple(Fraction(c, CHART_STEPS) for c in steps)
    charts = Charts.of(factors_in([e for leg in legs for e in leg.kept]))
    x, y, z = (c + d for c, d in zip(middle, step, strict=True))
    return PlatformModel(robot, legs, chart, charts, _system(legs, chart, charts), (x, y, z))


def _places(legs: Sequence[Leg]) -> list[Vector]:
    """The points of joints that turn about one."""
    return [j.point for leg in legs for j in leg.joints if j.of_type.turns_about_point]


def _extent(places: Sequence[Vector]) -> float:
    """The largest distance between points; 1 of less than two."""
    offsets = [[float(x - c) for x, c in zip(p, places[0], strict=True)] for p in places]
    points = np.array(offsets).reshape(-1, 3)
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    return float(apart.max(initial=0.0)) or 1.0


def _middle(legs: Sequence[Leg]) -> Place:
    """The mean of the points of joints, exact where it is a short fraction, else near it."""
    places = _places(legs)
    count, power = max(len(places), 1), int(np.frexp(_extent(places))[1])
    sums = (sum((p[k] for p in places), Fraction(0)) for k in range(3))
    x, y, z = (shorten_origin(c / count, power) for c in sums)
    return x, y, z


def _sparsest_place(legs: Sequence[LegEquations]) -> Place:
    """Of the origin, the middle, and rational points of joints that with the fewest terms about it.

    Of several the one nearest to the middle.
    """
    nothing: Place = (Fraction(0),) * 3
    points = _places([leg.leg for leg in legs])
    rational = [(x, y, z) for x, y, z in points if {type(x), type(y), type(z)} == {Fraction}]

    def badness(place: Place) -> tuple[Any, ...]:
        # An origin elsewhere is a shift of the forms back.
        back = tuple(-c for c in place)
        moved = (f for leg in legs for f in forms_about_origin(leg.image.forms, back))
        return sum(len(f.terms) for f in moved), sum(c * c for c in place), place

    return min(dict.fromkeys([nothing, *rational]), key=badness)


def _shift_leg(leg: Leg, place: Place) -> Leg:
    """A leg in coordinates that count from a place."""
    joints = (
        replace(j, point=tuple(x - c for x, c in zip(j.point, place, strict=True)))
        for j in leg.joints
    )
    origin = ((ONE, *NOTHING[1:]), (ZERO, *(c / 2 for c in place)))
    displacements = {
        name: dual_multiply(dual_multiply(dual_conjugate(origin), moved), origin)
        for name, moved in leg.displacements.items()
    }
    return replace(leg, joints=tuple(joints), displacements=displacements)


def _shift_equations(equations: LegEquations, place: Place) -> LegEquations:
    """What a leg says, in coordinates that count from a place."""
    if not any(place):
        return equations
    leg = _shift_leg(equations.leg, place)
    elements, image = leg.elements(), equations.image
    first, last = len(equations.before), len(elements) - len(equations.behind)
    forms = forms_about_origin(image.forms, tuple(-c for c in place))
    source = ProductOfFactors(elements[first:last])
    return replace(
        equations,
        leg=leg,
        before=elements[:first],
        behind=elements[last:],
        image=replace(image, source=source, forms=forms),
    )


def _check_leg(leg: Leg, platform: str) -> None:
    if not leg.is_serial:
        raise MechanismError(
            f"leg {leg.name} has loops of its own; only serial chains between the ground and "
            f"{platform!r} are its legs: is that the platform?"
        )
    for joint in leg.joints:
        vectors = (joint.point, joint.axis, joint.second_axis)
        entries = [x for v in vectors if v is not None for x in v]
        if any(isinstance(x, Irrational) for x in entries):
            raise MechanismError(
                f"joint {joint.name!r} has coordinates other than rational numbers, square roots "
                "and sines and cosines of rational multiples of pi, of degree "
                f"{MOST_DEGREE_OF_COSINES} at most; operation modes are found of these"
            )


def _leg_equations(leg: Leg, rng: np.random.Generator) -> LegEquations:
    """The whole image where its forms are of low degree, else that beside the fewest joints."""
    elements = leg.elements()
    whole = image_of_chain(elements, rng)
    found = LegEquations(leg, (), (), whole, whole.dimension)
    if whole.cuts:
        return found
    best: LegEquations | None = None
    for count in range(1, len(elements)):
        for first in range(count + 1):
            last = len(elements) - count + first
            part = image_of_chain(elements[first:last], rng, MOST_DEGREE_BESIDE_JOINTS)
            split = replace(found, before=elements[:first], behind=elements[last:], image=part)
            if part.cuts and split.path_factor:
                best = split if best is None else min(best, split, key=lambda s: s.path_factor)
        if best is not None:
            return best
    raise MechanismError(
        f"leg {leg.name}: no forms up to degree {MOST_DEGREE} cut out the poses that it reaches"
    )


def _system(
    legs: Sequence[LegEquations], chart: Sequence[Fraction], charts: Charts
) -> PolynomialSystem:
    n = 7 + charts.n
    variables = Polynomial.variables(n)
    zero = Polynomial(n, {})
    first = sum((x * c for x, c in zip(variables, chart, strict=False)), zero + 1)
    pose = (first, *variables[:7])
    places = range(7, n)
    values = {
        factor: tuple(f.with_variables(n, places) for f in own)
        for factor, own in charts.values.items()
    }
    equations = [study_quadric().compose(pose)]
    for leg in legs:
        beside = _beside_joints(leg, pose, values, zero)
        equations += [primitive(f.compose(beside)) for f in leg.image.forms]
    norms = [norm_form().compose(pose)]
    for factor, group in zip(charts.factors, charts.groups, strict=True):
        norm = factor.norm([variables[7 + i] for i in group])
        norms += [] if norm is None else [norm]
    names = charts.names
    if not set(names).isdisjoint(COORDINATES):
        names = tuple(f"k{i + 1}" for i in range(charts.n))
    groups = (tuple(range(7)), *(tuple(7 + i for i in group) for group in charts.groups))
    return PolynomialSystem(
        (*COORDINATES[1:], *names),
        tuple(dict.fromkeys(f for f in equations if f)),
        tuple(norms),
        groups if charts.n else (),
    )


def _beside_joints(
    leg: LegEquations, pose: Sequence[Polynomial], values: dict[Any, Any], zero: Polynomial
) -> list[Polynomial]:
    """The displacement of what is between the kept joints of a leg, up to a factor."""
    motion = tuple(pose[:4]), tuple(pose[4:])
    if leg.before:
        motion = dual_multiply(dual_conjugate(displacement(leg.before, values, _as_given)), motion)
    if leg.behind:
        motion = dual_multiply(motion, dual_conjugate(displacement(leg.behind, values, _as_given)))
    return [zero + c for part in motion for c in part]


def _as_given(c: Number) -> Number:
    return c
