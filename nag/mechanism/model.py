"""The choice of a model: the smallest system of polynomials that is faithful to a mechanism."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from nag.algebra.number import Number
from nag.algebra.system import PolynomialSystem
from nag.mechanism.axes import Space, space_of
from nag.mechanism.configuration import Configuration
from nag.mechanism.euler import EulerModel, euler_model
from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.half_angles import HalfAngleModel, half_angle_model
from nag.mechanism.loops import LoopStructure, loop_structure
from nag.mechanism.mobility import gruebler_kutzbach
from nag.mechanism.path_estimates import path_bound
from nag.mechanism.planar import PlanarModel, planar_model
from nag.mechanism.unreduced import unreduced_point, unreduced_system

Formulation = Literal["auto", "E", "H"]

# An equation in half-angles has two to the number of joints terms.
MOST_HALF_ANGLE_JOINTS = 12


class ModelError(ValueError):
    """A mechanism that the asked formulation does not cover."""


@dataclass(frozen=True)
class Model:
    """A mechanism as a system of polynomials, and the way back to its configurations.

    Attributes:
        mechanism: what is modelled.
        formulation: "E" (Euler parameters; (c, s) in the plane) or "H" (half-angles).
        space: the smallest geometry that holds all axes.
        reason: one sentence: why this model.
        system: the equations, exact.
        reference: the reference configuration in the system's variables, an exact solution.
        sign_group: size of the group of sign changes a -> -a that acts on E; 1 for H and in the
            plane, where configurations have one point each.
        symmetries: generators of that group, as signs of the system's variables.
        path_bound: number of solutions that a square system of these degrees, cut by linear
            equations, has at most (Bezout's number, multihomogeneous where there are groups).
        structure: the part of the mechanism that has loops, and what was cut off.
        form: the equations' own model.
    """

    mechanism: Mechanism
    formulation: Literal["E", "H"]
    space: Space
    reason: str
    system: PolynomialSystem
    reference: tuple[Number, ...]
    sign_group: int
    symmetries: tuple[tuple[int, ...], ...]
    path_bound: int
    structure: LoopStructure
    form: EulerModel | HalfAngleModel | PlanarModel

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution of `system`.

        Exact for exact points; complex for complex ones, `mpmath` for those.
        """
        if len(point) != self.system.n:
            raise ValueError(f"the point has {len(point)} coordinates, the model {self.system.n}")
        return self.form.lift(point)

    @cached_property
    def unreduced(self) -> PolynomialSystem:
        """Every constraint of PT13 table 1 in all Euler parameters and positions."""
        return unreduced_system(self.mechanism)

    def unreduced_point(self, configuration: Configuration) -> tuple[Any, ...]:
        """The point of `unreduced` that a configuration is."""
        return unreduced_point(self.mechanism, configuration)

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts for the whole mechanism."""
        return gruebler_kutzbach(self.mechanism)

    @property
    def cut(self) -> tuple[Joint, ...]:
        """Joints of dangling trees; each adds its own freedom to every component's dimension."""
        return self.structure.cut


def model(mechanism: Mechanism, formulation: Formulation = "auto") -> Model:
    """The smallest faithful model of a mechanism, or the one that is asked for.

    Planar mechanisms take (c, s) of each body, single loops in space half-angles, all others Euler
    parameters.

    Raises:
        ModelError: if the mechanism has no loop, or ``formulation`` does not cover it.
    """
    if formulation not in ("auto", "E", "H"):
        raise ModelError(f'formulation {formulation!r} is unknown; use "auto", "E" or "H"')
    structure = loop_structure(mechanism)
    if structure.groups.is_one_body:
        raise ModelError("all bodies are tied together by rigid joints: nothing moves")
    if not structure.loops:
        raise ModelError(
            f"the mechanism has no loop: each of its {len(mechanism.joints)} joints moves freely, "
            f"so its mobility is {structure.cut_freedoms} and there is nothing to decompose"
        )
    space = space_of(structure.joints)
    chosen, why = _choose(structure, space, formulation)
    form = _build(structure, space, chosen)
    symmetries = form.symmetries if isinstance(form, EulerModel) else ()
    return Model(
        mechanism=mechanism,
        formulation=chosen,
        space=space,
        reason=why + _cut_text(structure),
        system=form.system,
        reference=form.reference,
        sign_group=2 ** len(symmetries),
        symmetries=symmetries,
        path_bound=path_bound(form.system),
        structure=structure,
        form=form,
    )


def _choose(
    structure: LoopStructure, space: Space, formulation: Formulation
) -> tuple[Literal["E", "H"], str]:
    joints, loops = len(structure.joints), len(structure.loops)
    what = f"{space}, {_count(loops, 'loop')} of {_joints_text(structure.joints)}"
    only_turns = all(j.type == "revolute" for j in structure.joints)
    if formulation == "H":
        if joints > MOST_HALF_ANGLE_JOINTS:
            raise ModelError(
                f"formulation H: a loop of {joints} joints has 2^{joints - 2} terms an equation, "
                f"at most {MOST_HALF_ANGLE_JOINTS} joints are multiplied out; use formulation E"
            )
        return "H", f"{what}; half-angles, as asked"
    if formulation == "E":
        pairs = "one pair (c, s) for each body" if space == "planar" else "Euler parameters"
        return "E", f"{what}; {pairs}, as asked"
    if space == "planar":
        return "E", f"{what}; all axes are parallel, so one pair (c, s) for each body"
    if space == "spherical":
        return "E", f"{what}; all axes meet, so Euler parameters without loop equations"
    if loops == 1 and only_turns and 3 <= joints <= MOST_HALF_ANGLE_JOINTS:
        unknowns = 4 * len(structure.moving) - 4
        return "H", (
            f"{what}; half-angles with two joints eliminated leave "
            f"{_count(joints - 2, 'unknown')}, Euler parameters {unknowns}"
        )
    return "E", (
        f"{what}; Euler parameters: half-angles are for a single loop of 3 to "
        f"{MOST_HALF_ANGLE_JOINTS} revolute joints"
    )


def _build(
    structure: LoopStructure, space: Space, formulation: Literal["E", "H"]
) -> EulerModel | HalfAngleModel | PlanarModel:
    if formulation == "H":
        try:
            return half_angle_model(structure)
        except ValueError as error:
            raise ModelError(f"formulation H: {error}; use formulation E") from None
    if space == "planar":
        return planar_model(structure)
    return euler_model(structure, spherical=space == "spherical")


def _cut_text(structure: LoopStructure) -> str:
    if not structure.cut:
        return ""
    names = ", ".join(j.name for j in structure.cut)
    return (
        f"; cut off, moving freely with {_count(structure.cut_freedoms, 'freedom')}: joints {names}"
    )


def _joints_text(joints: Sequence[Joint]) -> str:
    kinds = Counter(j.type for j in joints)
    parts = [_count(number, f"{kind} joint") for kind, number in kinds.items()]
    return " and ".join(filter(None, [", ".join(parts[:-1]), parts[-1]]))


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
