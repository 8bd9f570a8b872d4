"""Formulation H: loops as products of joints, some of each loop eliminated linearly.

Every joint is a product of factors that are linear in homogeneous coordinates (`joint_factors`): a
half-angle for a turn. Each loop eliminates one spherical or planar joint, or two neighbouring turns
or slides, that no other loop uses (`loop_product`); what is left is four multilinear equations a
loop. A loop that shares all but single joints with others, as in rows of Bennett's linkages,
eliminates one of them or none, and has six or seven equations. Everything is relative to the
reference configuration.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import prod
from types import MappingProxyType
from typing import Any

from nag.algebra.combinations import of_fewest_variables
from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.number import Number
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.mechanism.assembly_modes import REFERENCE, Modes
from nag.mechanism.axes import Space, difference
from nag.mechanism.configuration import (
    Arithmetic,
    Configuration,
    arithmetic_of,
    as_entries,
    configuration,
)
from nag.mechanism.euler import slide_directions
from nag.mechanism.joint_factors import Charts, Factor
from nag.mechanism.loop_product import (
    Closure,
    Element,
    closures,
    displacement,
    factors_in,
    joint_elements,
    move_place,
    narrow_closures,
    opposite,
)
from nag.mechanism.loops import Loop, LoopStructure, loop_bases
from nag.mechanism.path_estimates import intersection_number, intersection_numbers
from nag.mechanism.quaternion import (
    DualQuaternion,
    conjugate,
    multiply,
    norm_squared,
    scale,
)

# Dimension of what two joints, or one of three freedoms, range over.
WIDE = 4
# An equation has at most as many terms as the product of its factors has.
MOST_TERMS = 2**10
# Loops of other and other bases that are looked at, until in one of these each has something of its
# own: a third of a millisecond each.
MOST_LOOPS = 1_000


class ChoiceStopped(NagError):
    """No basis of the loops was found in which each has something of its own, and not all tried.

    Attributes:
        stopped: how many were.
    """

    def __init__(self, problem: str, stopped: str) -> None:
        super().__init__(f"{problem}; {stopped}")
        self.stopped = stopped


@dataclass(frozen=True)
class HalfAngleModel:
    """Loops as equations in the coordinates of the joints that are kept.

    Attributes:
        structure: the mechanism's part with loops.
        closures: one for each loop.
        charts: the kept factors, in the order of their variables.
        elements: for each joint, by name, its factors and constants in the direction from its first
            body to its second.
        system: the equations; one group of variables for each factor; points where a factor's norm
            vanishes are excluded.
        reference: the reference configuration; empty in other assembly modes, and of joints that
            are held elsewhere.
        modes: the assembly modes.
        displacements: of joints that are held elsewhere, as `LoopClosures.of` takes them.
    """

    structure: LoopStructure
    closures: tuple[Closure, ...]
    charts: Charts
    elements: Mapping[str, tuple[Element, ...]]
    system: PolynomialSystem
    reference: tuple[Number, ...]
    modes: Modes
    displacements: Mapping[str, DualQuaternion] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "elements", fixed_mapping(self.elements))
        object.__setattr__(self, "displacements", fixed_mapping(self.displacements))

    def coordinates(self, point: Sequence[Any]) -> dict[str, tuple[tuple[Any, ...], ...]]:
        """For each joint, by name, homogeneous coordinates of its factors at a solution.

        Eliminated joints included. Of a turn they are (c, s), up to scale, in the direction in
        which the loop runs.
        """
        arithmetic = arithmetic_of(point)
        values = self._coordinates(as_entries(point), arithmetic)
        return {
            name: tuple(values[e.factor] for e in elements if e.factor is not None)
            for name, elements in self.elements.items()
        }

    def _coordinates(
        self, point: Sequence[Any], arithmetic: Arithmetic
    ) -> dict[Factor, tuple[Any, ...]]:
        convert = arithmetic.convert
        values = self.charts.at(point, convert)
        for closure in self.closures:
            values |= closure.recover(values.__getitem__, convert)
        return values

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution.

        Exact for exact points (with square roots where norms are no squares). Points of norm zero
        are no configurations.

        Raises:
            ZeroDivisionError: at a point of norm zero.
        """
        arithmetic = arithmetic_of(point)
        convert = arithmetic.convert
        values = self._coordinates(as_entries(point), arithmetic)
        structure, mechanism = self.structure, self.structure.mechanism
        relative = {
            name: displacement(elements, values, convert)
            for name, elements in self.elements.items()
        }
        reference = {
            b: [convert(x) for x in mechanism.orientation(b)]
            for b in (structure.base, *structure.moving)
        }
        base = structure.base
        one = convert(Fraction(1))
        turned = {base: (one, 0 * one, 0 * one, 0 * one)}
        euler, slides = {}, {}
        for parent, child, joint in structure.spanning_tree():
            if child not in reference:
                continue
            turn = relative[joint.name][0]
            turn = turn if joint.bodies[0] == parent else conjugate(turn)
            turned[child] = multiply(turned[parent], turn)
            unit = scale(turned[child], 1 / arithmetic.sqrt(norm_squared(turned[child])))
            turned[child] = unit
            euler[child] = multiply(unit, reference[child])
        for joint in structure.joints:
            if slide_directions(joint) or joint.name in self.displacements:
                place = [convert(x) for x in joint.point]
                there = move_place(relative[joint.name], place)
                slides[joint.name] = difference(there, place)
        return configuration(structure, euler, arithmetic, slides)


@dataclass(frozen=True)
class LoopClosures:
    """How the loops of a mechanism are closed, before anything is multiplied out.

    Attributes:
        structure: the mechanism's part with loops.
        closures: one for each loop.
        elements: for each joint, by name, its factors and constants.
        kept: the factors whose coordinates are the unknowns, in their order.
        modes: the assembly modes.
        stopped: where bases were left that might have been better, how many were looked at.
        displacements: of joints that are held elsewhere.
    """

    structure: LoopStructure
    closures: tuple[Closure, ...]
    elements: Mapping[str, tuple[Element, ...]]
    kept: tuple[Factor, ...]
    modes: Modes
    stopped: str = ""
    displacements: Mapping[str, DualQuaternion] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        structure: LoopStructure,
        modes: Modes = REFERENCE,
        displacements: Mapping[str, DualQuaternion] = MappingProxyType({}),
    ) -> LoopClosures:
        """Those with the fewest paths each.

        Args:
            structure: the mechanism's part with loops.
            modes: the assembly modes.
            displacements: of joints, by name, a constant displacement of the second body against
                the first, from the reference configuration, that comes before what is free.

        Raises:
            ValueError: if a loop has nothing of its own to eliminate, or nothing is left.
        """
        elements, chosen, stopped = _choose_closures(structure, dict(modes), displacements)
        lost = {f for c in chosen for f in c.lost}
        kept = tuple(f for f in _in_order(chosen) if f not in lost)
        if not kept:
            raise NagError(_too_short(len(structure.joints)))
        return cls(structure, tuple(chosen), elements, kept, modes, stopped, displacements)

    def estimated_paths(self, space: Space) -> int:
        """What `nag.mechanism.path_estimates.estimated_paths` says of equations as they look.

        They are taken for independent and of full degree in all factors. Displacements in the plane
        and about a point are in a space of four dimensions, as each pair of joints that is
        eliminated is.
        """
        whole = 8 if space == "spatial" else WIDE
        rows: list[tuple[int, ...]] = []
        for closure in self.closures:
            own = {e.factor for e in closure.kept}
            row = tuple(int(f in own) for f in self.kept)
            rows += [row] * (whole - len(closure.basis))
            if closure.quadric:
                rows.append(tuple(2 * k for k in row))
        dimensions = [f.dimension for f in self.kept]
        return sum(intersection_numbers(sorted(rows, key=sum), dimensions)[1:])

    @cached_property
    def model(self) -> HalfAngleModel:
        """The equations."""
        charts = Charts.of(self.kept)
        equations = [f for c in self.closures for f in _equations(c, charts)]
        return HalfAngleModel(
            self.structure,
            self.closures,
            charts,
            self.elements,
            charts.system(equations),
            () if self.modes or self.displacements else charts.reference,
            self.modes,
            self.displacements,
        )


def half_angle_model(structure: LoopStructure, modes: Modes = REFERENCE) -> HalfAngleModel:
    """The loop equations in half-angles, slides and quaternions of the joints.

    Raises:
        ValueError: if a loop has nothing of its own to eliminate, or nothing is left.
    """
    return LoopClosures.of(structure, modes).model


def _equations(closure: Closure, charts: Charts) -> Sequence[Polynomial]:
    """The equations of a loop; six and more say together what one of two joints says alone."""
    found = closure.polynomials(charts)
    return found if len(closure.basis) == WIDE else of_fewest_variables(found)


def _choose_closures(
    structure: LoopStructure,
    modes: dict[str, int],
    displacements: Mapping[str, DualQuaternion],
) -> tuple[dict[str, tuple[Element, ...]], list[Closure], str]:
    """For some basis of the loops: what each of them eliminates, with the fewest paths.

    Also how many bases were looked at, where others were left.
    """
    # What is held may leave a loop two freedoms, both of which would be eliminated.
    held = bool(displacements)
    single = structure.single is not None and not held
    problem = stopped = ""
    for narrow in (False,) if single else (False, True):
        looked_at = 0
        for k, loops in enumerate(loop_bases(structure)):
            looked_at += len(loops)
            if k and looked_at > MOST_LOOPS:
                bases = "1 basis" if k == 1 else f"{k} bases"
                stopped = f"choosing stopped after {bases} of {len(loops)} loops"
                break
            elements: dict[str, tuple[Element, ...]] = {}
            products = [_loop_elements(p, modes, displacements, elements) for p in loops]
            users = Counter(f for product in products for f in factors_in(product))
            chosen = []
            for loop, product in zip(loops, products, strict=True):
                best = _choose_closure(product, users, narrow, held)
                if best is None:
                    problem = problem or _nothing_to_eliminate(loop)
                    break
                terms = _terms(best)
                if terms > MOST_TERMS:
                    problem = (
                        f"a loop of {len(loop.joints)} joints has {terms} terms an equation, at "
                        f"most {MOST_TERMS} are multiplied out"
                    )
                    break
                chosen.append(best)
            else:
                return elements, chosen, stopped
    raise ChoiceStopped(problem, stopped) if stopped else NagError(problem)


def _choose_closure(
    product: Sequence[Element], users: Mapping[Factor, int], narrow: bool, keeps: bool = False
) -> Closure | None:
    """What a loop eliminates of its own.

    Args:
        narrow: whether that may be one turn or slide, or nothing, where there is no more.
        keeps: whether a factor has to be left.
    """
    for ways in (closures, narrow_closures) if narrow else (closures,):
        own = [c for c in ways(product) if all(users[f] == 1 for f in c.lost)]
        if keeps and factors_in(product):
            own = [c for c in own if factors_in(c.kept)]
        if own:
            return min(own, key=_cost)
    return None


def cheapest_closure(product: Sequence[Element]) -> Closure | None:
    """The closure of a single loop with the fewest paths; None where its products are dependent."""
    return _choose_closure(product, Counter(factors_in(product)), True)


def _terms(closure: Closure) -> int:
    """How many terms an equation has at most."""
    return prod(1 + e.factor.dimension for e in closure.kept if e.factor is not None)


def _nothing_to_eliminate(loop: Loop) -> str:
    if len(loop.joints) < 3:
        return _too_short(len(loop.joints))
    return "all axes of the loop coincide, or all its joints slide: nothing can be eliminated"


def _too_short(count: int) -> str:
    return f"half-angles need a loop of at least 3 joints; this one has {count}"


def _cost(closure: Closure) -> tuple[int, int]:
    """Bound of the number of paths, that of the quadric included."""
    dimensions = [e.factor.dimension for e in closure.kept if e.factor is not None]
    degrees = [(1,) * len(dimensions)] * (8 - len(closure.basis))
    if closure.quadric:
        degrees = [*degrees[:3], (2,) * len(dimensions)]
    return intersection_number(degrees, dimensions), int(closure.quadric)


def _loop_elements(
    loop: Loop,
    modes: dict[str, int],
    displacements: Mapping[str, DualQuaternion],
    known: dict[str, tuple[Element, ...]],
) -> list[Element]:
    """The loop's product; the elements of its joints, first body to second, are put in ``known``.

    A joint's coordinates count in the direction in which the first loop that has it runs.
    """
    product: list[Element] = []
    for joint, body in zip(loop.joints, loop.bodies, strict=True):
        forward = joint.bodies[0] == body
        if joint.name not in known:
            known[joint.name] = joint_elements(joint, modes.get(joint.name, 0), forward)
            if joint.name in displacements:
                before = Element(None, (displacements[joint.name],))
                known[joint.name] = (before, *known[joint.name])
        own = known[joint.name]
        product += own if forward else opposite(own)
    return product


def _in_order(chosen: Sequence[Closure]) -> list[Factor]:
    order: dict[Factor, None] = {}
    for closure in chosen:
        order.update(dict.fromkeys(e.factor for e in closure.kept if e.factor is not None))
    return list(order)
