"""The choice of a model: the smallest system of polynomials that is faithful to a mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, get_args

from nag.algebra.given import check_choice, check_listed
from nag.algebra.number import Number
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.mechanism import FORMULATIONS, PLATFORM_ALONE
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.assembly_modes import REFERENCE, Modes
from nag.mechanism.axes import Space, same_line, space_of, zero_length
from nag.mechanism.configuration import Configuration
from nag.mechanism.euler import EulerModel
from nag.mechanism.formulations import (
    Form,
    alternative,
    alternatives,
    description,
    joints_text,
    smallest_alternative,
)
from nag.mechanism.graph import Joint, Mechanism, check_mechanism
from nag.mechanism.half_angles import HalfAngleModel
from nag.mechanism.loops import LoopStructure, gruebler_kutzbach, loop_structure
from nag.mechanism.parts import PARTS, mechanism_in, parts_in_formulation
from nag.mechanism.path_estimates import (
    MOST_DECOMPOSED,
    Alternative,
    ModelError,
    NoLoopError,
    estimated_paths,
    path_bound,
)
from nag.mechanism.planar import PlanarModel
from nag.mechanism.rods import RodModel
from nag.mechanism.unreduced import unreduced_point, unreduced_system
from nag.text.table import count_text, one_line

__all__ = ["Model", "ModelError", "formulations", "model"]


@dataclass(frozen=True)
class Model:
    """A mechanism as a system of polynomials, and the way back to its configurations.

    Attributes:
        mechanism: what is modelled.
        formulation: "E" (Euler parameters; (c, s) in the plane), "H" (half-angles, and slides
            and quaternions of joints that have them), "S" (rods as distances) or "P" (the poses of
            a robot's platform).
        space: the smallest geometry that holds all axes.
        reason: one sentence: why this model.
        system: the equations, exact.
        reference: the reference configuration in the system's variables, an exact solution; empty
            in other assembly modes, and of poses where a leg is not regular.
        sign_group: size of the group of sign changes a -> -a that acts on E; 1 for H and in the
            plane, where configurations have one point each.
        symmetries: generators of that group, as `nag.decompose` takes them.
        path_bound: number of solutions that a square system of these degrees, cut by linear
            equations, has at most (Bezout's number, multihomogeneous where there are groups).
        structure: the part of the mechanism that has loops, and what was cut off.
        form: the equations' own model.
        modes: the joints that are not in the assembly mode of the reference configuration.
    """

    mechanism: Mechanism
    formulation: str
    space: Space
    reason: str
    system: PolynomialSystem
    reference: tuple[Number, ...]
    sign_group: int
    symmetries: tuple[SignedPermutation, ...]
    path_bound: int
    structure: LoopStructure
    form: Form
    modes: Modes = REFERENCE

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution of `system`.

        Exact for exact points; complex for complex ones, `mpmath` for those.
        """
        check_listed(point, "point", f"{self.system.n} numbers")
        if len(point) != self.system.n:
            raise NagError(
                f"point: it has {len(point)} coordinates, the model {self.system.n} variables"
            )
        return self.form.lift(point)

    def project(self, configuration: Configuration) -> tuple[Any, ...]:
        """The point of `system` that a configuration is, for models in Euler parameters.

        Raises:
            ValueError: for other formulations.
        """
        if not isinstance(self.form, EulerModel | PlanarModel):
            raise NagError(f"formulation {self.formulation} has no coordinates of bodies")
        return self.form.project(configuration)

    @cached_property
    def unreduced(self) -> PolynomialSystem:
        """Every constraint of PT13 table 1 in all Euler parameters and positions."""
        return unreduced_system(self.mechanism)

    def unreduced_point(self, configuration: Configuration) -> tuple[Any, ...]:
        """The point of `unreduced` that a configuration is."""
        return unreduced_point(self.mechanism, configuration)

    @cached_property
    def alternatives(self) -> tuple[Alternative, ...]:
        """All formulations of the mechanism, by rising number of paths, and this one."""
        if self.formulation in ("H", "S", PLATFORM_ALONE) and self.form.displacements:
            return (Alternative(self.formulation, self.form),)
        found = alternatives(self.structure, self.space, self.modes)
        if self.formulation in FORMULATIONS:
            return found
        return (*found, Alternative(self.formulation, self.form))

    @property
    def joint_types(self) -> tuple[str, ...]:
        """The types of the mechanism's joints, each once."""
        return tuple(dict.fromkeys(j.type for j in self.mechanism.joints))

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts for the whole mechanism."""
        return gruebler_kutzbach(self.mechanism)

    @property
    def formulation_text(self) -> str:
        """What the equations are, as text."""
        return f"formulation {self.formulation}"

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.mechanism.shown import model_text

        return model_text(self)

    @property
    def zero_links(self) -> tuple[str, ...]:
        """Which links have length zero, as both of their joints turn about one line."""
        found = []
        for body in (self.structure.base, *self.structure.moving):
            own = [j for j in self.structure.joints if body in j.bodies]
            if len(own) == 2 and all(j.of_type.turns_only for j in own) and same_line(*own):
                found.append(zero_length(body, own[0].name, own[1].name))
        return tuple(found)

    @property
    def cut(self) -> tuple[Joint, ...]:
        """Joints of no loop; each adds its own freedoms to every component's dimension."""
        return self.structure.outside

    @property
    def freedoms_left_out(self) -> tuple[tuple[int, str], ...]:
        """Freedoms that every configuration has besides those of `system`, and whose they are."""
        found = []
        if self.structure.cut_freedoms:
            found.append((self.structure.cut_freedoms, "the joints that were cut off"))
        if isinstance(self.form, RodModel) or self.formulation == PLATFORM_ALONE:
            found += self.form.left_out
        return tuple(found)

    @property
    def rank(self) -> tuple[int, int] | None:
        """Number of closure equations in joint coordinates and how many are independent.

        Exact linear algebra; every component has at least as many dimensions as there are
        variables more than independent equations. None for other formulations.
        """
        if not isinstance(self.form, HalfAngleModel):
            return None
        equations = sum(c.equations for c in self.form.closures)
        return equations, len(self.system.polynomials)


def model(
    mechanism: Any,
    formulation: str = "auto",
    modes: Modes = REFERENCE,
    space: Space | None = None,
) -> Model | AssemblyModel:
    """The smallest faithful model of a mechanism, or the one that is asked for.

    Parts that may be assembled in any way have one as well, an `AssemblyModel`.

    The smallest is the one with the fewest estimated paths; of a parallel robot for which these are
    more than a million, Euler parameters.

    Args:
        mechanism: a `nag.Mechanism`, or a `nag.Case` or a model of one; at least one of its joints
            must belong to a loop. Or parts: a `nag.Linkage`, a `nag.Framework`, a `nag.DHLoop`.
        formulation: ``"E"`` for Euler parameters (the constraints of PT13, table 1, by their prime
            components: T25, lemma 2.1; in the plane a cosine and a sine for each body), ``"H"``
            for half-angles and other joint coordinates, ``"S"`` for rods as distances, ``"auto"``;
            ``"P"`` for the poses of a robot's platform, which are not taken by themselves: their
            components need not be those of the joints.
        modes: assembly modes (`nag.mechanism.assembly_modes`), of the mechanism in space.
        space: ``"spatial"`` to take a planar or spherical mechanism as one in space.

    Raises:
        ModelError: if the mechanism has no loop, or ``formulation`` does not cover it.
        NagError: if parts have no model, or not in that formulation, or another argument makes no
            sense; the message says which, and what would.

    >>> import nag
    >>> model = nag.model(nag.read_case("cases/bennett.toml").mechanism)
    >>> model.formulation, model.system.n, model.system.degrees
    ('H', 2, (2,))
    >>> sorted(model.lift(model.reference).euler) == sorted(model.mechanism.body_names)
    True
    """
    check_listed(modes, "modes", "pairs of a joint's name and its mode")
    modes = tuple(modes)
    mechanism = mechanism_in(mechanism)
    if isinstance(mechanism, AssemblyModel):
        for name, given in (("modes", bool(modes)), ("space", space is not None)):
            if given:
                raise NagError(f"{name}: is for a nag.Mechanism, not for parts; leave it out")
        return parts_in_formulation(mechanism, formulation)
    check_mechanism(mechanism, PARTS)
    if space is not None:
        check_choice(space, "space", get_args(Space))
    structure = with_loops(mechanism)
    if space is None:
        space = "spatial" if modes else space_of(structure.joints)
    chosen = _choose(structure, space, formulation, modes)
    return _model_of(mechanism, structure, space, chosen, formulation, modes)


def find_pose_model(made: Model) -> Model | None:
    """The model of a mechanism's platform alone, where it has the fewest paths of what has many.

    Components of poses need not be those of the joints; but these are not found in time then.

    Args:
        made: the model that was chosen.

    Returns:
        None where it is no model of a parallel robot, or has few paths, or fewer than poses have.
    """
    paths = estimated_paths(made.system)
    if made.formulation == PLATFORM_ALONE or paths <= MOST_DECOMPOSED:
        return None
    chosen = alternative(made.structure, made.space, PLATFORM_ALONE, made.modes)
    if chosen.form is None or chosen.paths >= paths:
        return None
    return _model_of(made.mechanism, made.structure, made.space, chosen, "auto", made.modes)


def _model_of(
    mechanism: Mechanism,
    structure: LoopStructure,
    space: Space,
    chosen: Alternative,
    asked: str,
    modes: Modes,
) -> Model:
    form = chosen.form
    symmetries = form.symmetries if isinstance(form, EulerModel) else ()
    return Model(
        mechanism=mechanism,
        formulation=chosen.formulation,
        space=space,
        reason=_reason(structure, space, chosen, asked) + _outside_text(structure),
        system=form.system,
        reference=form.reference,
        sign_group=2 ** len(symmetries),
        symmetries=tuple(map(SignedPermutation.of_signs, symmetries)),
        path_bound=path_bound(form.system),
        structure=structure,
        form=form,
        modes=modes,
    )


def _choose(structure: LoopStructure, space: Space, formulation: str, modes: Modes) -> Alternative:
    if formulation == "auto":
        return smallest_alternative(structure, space, modes)
    if formulation not in (*FORMULATIONS, PLATFORM_ALONE):
        names = ", ".join(f'"{name}"' for name in ("auto", *FORMULATIONS, PLATFORM_ALONE))
        raise ModelError(f"formulation {formulation!r} is unknown; use one of {names}")
    chosen = alternative(structure, space, formulation, modes)
    if chosen.form is None:
        instead = "" if formulation == "E" else "; use formulation E"
        raise ModelError(f"formulation {formulation}: {chosen.problem}{instead}")
    return chosen


def formulations(mechanism: Mechanism) -> tuple[str, ...]:
    """The formulations that cover a mechanism, by rising number of estimated paths.

    Raises:
        ModelError: if the mechanism has no loop.
    """
    structure = with_loops(mechanism)
    found = alternatives(structure, space_of(structure.joints))
    return tuple(a.formulation for a in found if a.form is not None)


def with_loops(mechanism: Mechanism) -> LoopStructure:
    """The part of a mechanism that has loops.

    Raises:
        ModelError: if there is none.
    """
    structure = loop_structure(mechanism)
    check_loops(mechanism, structure)
    return structure


def check_loops(mechanism: Mechanism, structure: LoopStructure) -> None:
    """Make sure that a mechanism has loops.

    Raises:
        NoLoopError: if it has none.
        ModelError: if all bodies are one.
    """
    if structure.groups.is_one_body:
        raise ModelError("all bodies are tied together by rigid joints: nothing moves")
    if not structure.loops:
        moving = sum(joint.of_type.freedoms > 0 for joint in structure.outside)
        joints = "one joint moves" if moving == 1 else f"{moving} joints move"
        raise NoLoopError(
            f"the mechanism has no loop: {joints} freely, so its mobility is "
            f"{structure.cut_freedoms} and there is nothing to decompose"
        )


def _reason(structure: LoopStructure, space: Space, chosen: Alternative, asked: str) -> str:
    loops = count_text(len(structure.loops), "loop")
    text = f"{space}, {loops} of {joints_text(structure.joints)}; {description(chosen, space)}"
    if asked != "auto":
        return f"{text}, as asked"
    unknowns = count_text(chosen.system.n, "unknown")
    how = "at most" if chosen.at_once is None else "at once"
    if chosen.fewer:
        text += (
            f": {unknowns} and short equations, as paths are out of reach, {how} {chosen.paths} "
        )
        text += f"and {chosen.fewer} in half-angles"
    else:
        text += f": {unknowns} and the fewest paths, {how} {chosen.paths}"
    return f"{text}; {chosen.stopped}" if chosen.stopped else text


def _outside_text(structure: LoopStructure) -> str:
    if not structure.outside:
        return ""
    names = ", ".join(j.name for j in structure.outside)
    freedoms = count_text(structure.cut_freedoms, "freedom")
    return f"; cut off, moving freely with {freedoms}: joints {names}"
