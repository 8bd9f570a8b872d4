"""Formulation S: rods between two spherical joints as distances, free bodies by Study coordinates.

A body that has two spherical joints and nothing else only keeps two points of its neighbours at
their distance; it turns freely about the line through them. Without such rods the bodies are trees
of joints; one that hangs in the air has Study coordinates (e, g), a dual quaternion e + eps g on
the quadric e.g = 0 (Husty 1996). With A the displacement of the rod's one neighbour against the
other, a and b its ends, |A_0 b + 2 A_1 - a A_0|^2 = |b - a|^2 |A_0|^2.

A rod of length zero is no distance: |p - q|^2 = 0 is a cone over the complex numbers, of which
p = q is the vertex. It is a spherical joint between its neighbours, about which the rod turns as it
likes. Spherical joints that close a loop of the joints that are left are the four equations
A_0 a + 2 A_1 - a A_0 = 0, of A's degree: with Study's quadric they say p = q and nothing else.
Other joints that close one are eliminated from it, as in half-angles (`loop_product`).

Bodies whose joints are all held against each other are one body, that may be a rod: of a leg with a
slide between two spherical joints, that is held, its length. Turns of rods about themselves are no
unknowns, so that what is left with joints held moves no more than it is seen to.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from types import MappingProxyType
from typing import Any

import numpy as np

from nag.algebra.fixed_mapping import fixed_mapping
from nag.algebra.number import Number, is_zero
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.mechanism.assembly_modes import REFERENCE, Modes
from nag.mechanism.axes import across, cross, difference, dot
from nag.mechanism.configuration import (
    Arithmetic,
    Configuration,
    arithmetic_of,
    as_entries,
    configuration,
)
from nag.mechanism.euler import slide_directions
from nag.mechanism.graph import Joint
from nag.mechanism.joint_factors import UNIT, Charts, free_factor
from nag.mechanism.loop_product import (
    Closure,
    Element,
    closure_of,
    displacement,
    dot4,
    factors_in,
    joint_elements,
    move_place,
    opposite,
)
from nag.mechanism.loops import LoopStructure
from nag.mechanism.quaternion import (
    DualQuaternion,
    Quaternion,
    dual_conjugate,
    dual_multiply,
    multiply,
    norm_squared,
    scale,
)

# Factors along a path, beyond which a distance has too many terms.
MOST_FACTORS = 5

# Freedoms of a rod that has length zero: those of turning about a point.
TURNS_ABOUT_A_POINT = 3


@dataclass(frozen=True)
class Rod:
    """A body that keeps two points at their distance, or several that are held against each other.

    Attributes:
        body: its name, of several that of the first.
        ends: its spherical joints.
        neighbours: the bodies at these.
        frames: for each of its bodies, by name, where it is against the first, from where they are
            drawn.
        span: from the first to the second of its ends, as seen from its first body.
    """

    body: str
    ends: tuple[Joint, Joint]
    neighbours: tuple[str, str]
    frames: Mapping[str, DualQuaternion]
    span: tuple[Number, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "frames", fixed_mapping(self.frames))

    def ends_on(self, body: str) -> tuple[tuple[Number, ...], tuple[Number, ...]]:
        """Both ends as one of its bodies carries them, where that is drawn."""
        own = next(b for b in self.ends[0].bodies if b in self.frames)
        first = move_place(self.frames[own], self.ends[0].point)
        second = tuple(x + y for x, y in zip(first, self.span, strict=True))
        back = dual_conjugate(self.frames[body])
        return tuple(move_place(back, first)), tuple(move_place(back, second))


@dataclass(frozen=True)
class RodModel:
    """Distances between trees of joints.

    Attributes:
        structure: the mechanism's part with loops.
        rods: what is taken as distances; each turns freely about itself.
        zero_rods: the bodies that are rods of length zero; each turns freely about its point.
        charts: the factors of all joints that are left, and of bodies in the air.
        paths: for each body that is no rod, the elements of its displacement against the base.
        joints: the elements of the joints that are left, but for spherical ones that close a loop.
        closures: the loops that other joints close, these eliminated.
        displacements: of joints that are held elsewhere, as `half_angles.LoopClosures.of` takes
            them.
        system: the distances, the joints that close a loop, and Study's quadrics.
        reference: the reference configuration; empty in other assembly modes, and of joints that
            are held elsewhere.
        modes: the assembly modes.
    """

    structure: LoopStructure
    rods: tuple[Rod, ...]
    zero_rods: tuple[str, ...]
    charts: Charts
    paths: Mapping[str, tuple[Element, ...]]
    joints: Mapping[str, tuple[Element, ...]]
    closures: tuple[Closure, ...]
    system: PolynomialSystem
    reference: tuple[Number, ...]
    modes: Modes
    displacements: Mapping[str, DualQuaternion] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("paths", "joints", "displacements"):
            object.__setattr__(self, name, fixed_mapping(getattr(self, name)))

    @property
    def spins(self) -> int:
        """Freedoms that the equations leave out: each rod turns about itself, or its point."""
        return sum(freedoms for freedoms, _ in self.left_out)

    @property
    def left_out(self) -> list[tuple[int, str]]:
        """The same by kind of rod: how many freedoms and, in words, whose they are."""
        by_kind = (
            (len(self.rods), "rods that turn idly about themselves"),
            (
                TURNS_ABOUT_A_POINT * len(self.zero_rods),
                "rods of length zero that turn idly about their points",
            ),
        )
        return [(freedoms, whose) for freedoms, whose in by_kind if freedoms]

    @property
    def idle(self) -> tuple[tuple[tuple[str, ...], int], ...]:
        """The bodies that turn about themselves, or their points, and with how many freedoms."""
        turning = [(tuple(rod.frames), 1) for rod in self.rods]
        about_points = [((body,), TURNS_ABOUT_A_POINT) for body in self.zero_rods]
        return (*turning, *about_points)

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution.

        The rods, which may turn about themselves, are turned the shortest way from the reference
        configuration; those of length zero are not turned.

        Raises:
            ZeroDivisionError: at a point of norm zero.
        """
        arithmetic = arithmetic_of(point)
        convert = arithmetic.convert
        values = self.charts.at(as_entries(point), convert)
        for closure in self.closures:
            values |= closure.recover(values.__getitem__, convert)
        motions = {b: _motion(e, values, convert) for b, e in self.paths.items()}
        structure, mechanism = self.structure, self.structure.mechanism
        turns = {b: _unit(m[0], arithmetic) for b, m in motions.items()}
        for rod in self.rods:
            ends = [[convert(x) for x in j.point] for j in rod.ends]
            there = [move_place(motions[b], p) for b, p in zip(rod.neighbours, ends, strict=True)]
            before, after = [convert(x) for x in rod.span], difference(there[1], there[0])
            turned = _shortest_turn(before, after, arithmetic)
            for body, (frame, _) in rod.frames.items():
                turns[body] = _unit(multiply(turned, [convert(x) for x in frame]), arithmetic)
        one, zero = convert(Fraction(1)), convert(Fraction(0))
        turns |= dict.fromkeys(self.zero_rods, (one, zero, zero, zero))
        euler = {
            b: multiply(turns[b], [convert(x) for x in mechanism.orientation(b)])
            for b in structure.moving
        }
        slides = {}
        for joint in structure.joints:
            if slide_directions(joint) or joint.name in self.displacements:
                place = [convert(x) for x in joint.point]
                own = self.joints.get(joint.name) or _elements(joint, 0, self.displacements)
                there = move_place(displacement(own, values, convert), place)
                slides[joint.name] = difference(there, place)
        return configuration(structure, euler, arithmetic, slides)


def rod_model(
    structure: LoopStructure,
    modes: Modes = REFERENCE,
    displacements: Mapping[str, DualQuaternion] = MappingProxyType({}),
) -> RodModel:
    """The distances that rods keep.

    Args:
        structure: the mechanism's part with loops.
        modes: the assembly modes.
        displacements: of joints that are held elsewhere, as `half_angles.LoopClosures.of` takes
            them.

    Raises:
        ValueError: if there are no such rods, a joint that closes a loop cannot be eliminated from
            it, a distance or a loop spans too many joints, or only rods turn (unless joints are
            held: all that is left to be said is then whether there is an assembly).
    """
    without, zero_rods = contract_zero_rods(structure)
    rods = _rods(without, displacements)
    if not rods and not zero_rods:
        raise NagError("no body has two spherical joints and no other joint")
    inside = {body for rod in rods for body in rod.frames}
    tree, closing = _spanning_joints(without, inside)
    elements = {
        j.name: _elements(j, dict(modes).get(j.name, 0), displacements)
        for j in (*tree, *closing)
        if j in tree or not j.of_type.turns_freely
    }
    paths = _trees(without, inside, tree, elements)
    charts = Charts.of(factors_in([e for own in paths.values() for e in own]))
    if not charts.n and not displacements:
        raise NagError("nothing turns but rods about themselves")
    equations: list[Any] = []
    products: dict[tuple[str, str], DualQuaternion] = {}
    first: dict[tuple[str, str], Any] = {}

    def elements_between(bodies: tuple[str, str], what: str) -> list[Element]:
        between = _without_common(paths[bodies[0]], paths[bodies[1]])
        if len(factors_in(between)) > MOST_FACTORS:
            raise NagError(f"{what} spans more than {MOST_FACTORS} joint coordinates")
        return between

    def displacement_between(bodies: tuple[str, str], what: str) -> DualQuaternion:
        if bodies not in products:
            products[bodies] = _motion(elements_between(bodies, what), charts.values, lambda c: c)
        return products[bodies]

    closed: list[Closure] = []
    for joint in closing:
        what = f"joint {joint.name!r}"
        if joint.of_type.turns_freely:
            motion = displacement_between(joint.bodies, what)
            equations += _gap(motion, joint.point, joint.point)
            continue
        back = elements_between(joint.bodies[::-1], what)
        closed.append(_close(joint.name, back, elements[joint.name]))
        equations += closed[-1].polynomials(charts)
    for rod in sorted(rods, key=lambda r: r.neighbours):
        motion = displacement_between(rod.neighbours, f"rod {rod.body!r}")
        value = _distance(motion, *(j.point for j in rod.ends), dot(rod.span, rod.span))
        # Differences of distances between the same two bodies are of lower degree in g.
        equations.append(value - first[rod.neighbours] if rod.neighbours in first else value)
        first.setdefault(rod.neighbours, value)
    for factor in charts.plain:
        if factor.kind == "free":
            values = charts.values[factor]
            equations.append(dot4(values[:4], values[4:]))
    return RodModel(
        structure,
        rods,
        zero_rods,
        charts,
        paths,
        elements,
        tuple(closed),
        charts.system(equations),
        () if modes or displacements else charts.reference,
        modes,
        displacements,
    )


def _elements(
    joint: Joint, mode: int, displacements: Mapping[str, DualQuaternion]
) -> tuple[Element, ...]:
    """A joint's elements from its first body to its second."""
    own = joint_elements(joint, mode, True)
    before = displacements.get(joint.name)
    return own if before is None else (Element(None, (before,)), *own)


def _close(name: str, back: Sequence[Element], own: Sequence[Element]) -> Closure:
    """The loop of a joint and the way back from its second body to its first, that eliminated."""
    start = next((i for i, e in enumerate(own) if e.factor is not None), len(own))
    closure = closure_of([*back, *own[:start]], own[start:])
    if closure is None:
        raise NagError(f"joint {name!r} closes a loop and cannot be eliminated from it")
    return closure


def contract_zero_rods(structure: LoopStructure) -> tuple[LoopStructure, tuple[str, ...]]:
    """The structure without rods of length zero, and the names of these.

    Each is a spherical joint between its neighbours; where both are one body, it is nothing.
    Loops stay those of the given structure.
    """
    joints, moving = list(structure.joints), list(structure.moving)
    found: list[str] = []
    while True:
        zero = next((b for b in moving if _is_zero_rod(_joints_of(b, joints))), None)
        if zero is None:
            contracted = replace(structure, joints=tuple(joints), moving=tuple(moving))
            return contracted, tuple(found)
        first, second = _joints_of(zero, joints)
        ends = (first.other(zero), second.other(zero))
        at = joints.index(first)
        joints = [j for j in joints if j not in (first, second)]
        if ends[0] != ends[1]:
            joints.insert(at, replace(first, bodies=ends))
        moving.remove(zero)
        found.append(zero)


def _joints_of(body: str, joints: Sequence[Joint]) -> list[Joint]:
    return [j for j in joints if body in j.bodies]


def _is_rod(joints: Sequence[Joint]) -> bool:
    return len(joints) == 2 and all(j.of_type.turns_freely for j in joints)


def _is_zero_rod(joints: Sequence[Joint]) -> bool:
    return _is_rod(joints) and all(map(is_zero, difference(joints[1].point, joints[0].point)))


def _rods(structure: LoopStructure, displacements: Mapping[str, DualQuaternion]) -> tuple[Rod, ...]:
    rods: list[Rod] = []
    for frames in _held_together(structure, displacements):
        ends = [j for j in structure.joints if len(frames.keys() & set(j.bodies)) == 1]
        if structure.base in frames or not _is_rod(ends):
            continue
        own = [next(b for b in j.bodies if b in frames) for j in ends]
        neighbours = [j.other(b) for j, b in zip(ends, own, strict=True)]
        taken = {body for rod in rods for body in rod.frames}
        if neighbours[0] == neighbours[1] or taken & set(neighbours):
            continue
        places = [move_place(frames[b], j.point) for j, b in zip(ends, own, strict=True)]
        if neighbours[1] < neighbours[0]:
            neighbours, ends, places = neighbours[::-1], ends[::-1], places[::-1]
        span = difference(places[1], places[0])
        if all(map(is_zero, span)):
            raise NagError("what is held makes a rod of length zero")
        (first, *_), (low, high) = frames, ends
        rods.append(Rod(first, (low, high), (neighbours[0], neighbours[1]), frames, span))
    return tuple(rods)


def _held_together(
    structure: LoopStructure, displacements: Mapping[str, DualQuaternion]
) -> Iterator[dict[str, DualQuaternion]]:
    """Bodies that held joints tie together, each with where it is against the first of them.

    Those that they tie in a loop, so that they might not be assembled, are left out.
    """
    bodies = (*structure.moving, structure.base)
    held = [j for j in structure.joints if j.of_type.is_rigid]
    seen: set[str] = set()
    for body in bodies:
        if body in seen:
            continue
        frames, frontier = {body: UNIT}, [body]
        for parent in frontier:
            for joint in held:
                child = joint.other(parent) if parent in joint.bodies else parent
                if child in frames:
                    continue
                moved = displacements[joint.name]
                forward = joint.bodies[0] == parent
                step = moved if forward else dual_conjugate(moved)
                frames[child] = dual_multiply(frames[parent], step)
                frontier.append(child)
        seen |= frames.keys()
        if sum(set(j.bodies) <= frames.keys() for j in held) == len(frames) - 1:
            yield frames


def _spanning_joints(
    structure: LoopStructure, rods: set[str]
) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
    """Joints that span the bodies that are no rods, and those that close their loops."""
    left = [j for j in structure.joints if not rods & set(j.bodies)]
    tree: dict[str, str] = {}
    closing = []

    def root(body: str) -> str:
        while body in tree:
            body = tree[body]
        return body

    # Those with the most freedoms last: of joints that close a loop these are no unknowns.
    for joint in sorted(left, key=lambda j: (j.of_type.turns_freely, j.of_type.freedoms)):
        ends = [root(b) for b in joint.bodies]
        if ends[0] != ends[1]:
            tree[ends[1]] = ends[0]
        else:
            closing.append(joint)
    return tuple(j for j in left if j not in closing), tuple(closing)


def _trees(
    structure: LoopStructure,
    rods: set[str],
    tree: Sequence[Joint],
    elements: Mapping[str, tuple[Element, ...]],
) -> dict[str, tuple[Element, ...]]:
    """Elements of each body's displacement against the base, along the joints of the trees."""
    paths: dict[str, tuple[Element, ...]] = {structure.base: ()}
    waiting, used = [b for b in structure.moving if b not in rods], set()
    frontier = [structure.base]
    while frontier or waiting:
        if not frontier:
            body = waiting[0]
            free = free_factor(body)
            paths[body] = (Element(free, free.generators),)
            frontier.append(body)
        parent = frontier.pop(0)
        waiting = [b for b in waiting if b != parent]
        for joint in tree:
            if joint.name in used or parent not in joint.bodies:
                continue
            used.add(joint.name)
            child = joint.other(parent)
            own = elements[joint.name]
            step = own if joint.bodies[0] == parent else tuple(opposite(own))
            paths[child] = (*paths[parent], *step)
            frontier.append(child)
    return paths


def _without_common(first: Sequence[Element], second: Sequence[Element]) -> list[Element]:
    """The displacement of a body against another one, without what both have in common."""
    pairs = zip(first, second, strict=False)
    common = next((i for i, (a, b) in enumerate(pairs) if a != b), min(len(first), len(second)))
    return [*opposite(first[common:]), *second[common:]]


def _distance(
    motion: DualQuaternion, a: Sequence[Number], b: Sequence[Number], squared: Number
) -> Any:
    """|A_0 b + 2 A_1 - a A_0|^2 - L^2 |A_0|^2, L the length of the rod."""
    return norm_squared(_gap(motion, a, b)) - norm_squared(motion[0]) * squared


def _gap(motion: DualQuaternion, a: Sequence[Number], b: Sequence[Number]) -> tuple[Any, ...]:
    """A_0 b + 2 A_1 - a A_0: the vector from a to where b goes, times A_0."""
    zero = Fraction(0)
    real, dual = motion
    gap = difference(multiply(real, (zero, *b)), multiply((zero, *a), real))
    return tuple(x + 2 * y for x, y in zip(gap, dual, strict=True))


def _motion(elements: Sequence[Element], values: Any, convert: Any) -> DualQuaternion:
    if elements:
        return displacement(elements, values, convert)
    zero, one = convert(Fraction(0)), convert(Fraction(1))
    return (one, zero, zero, zero), (zero, zero, zero, zero)


def _unit(q: Sequence[Any], arithmetic: Arithmetic) -> Quaternion:
    return scale(q, 1 / arithmetic.sqrt(norm_squared(q)))


def _shortest_turn(
    before: Sequence[Any], after: Sequence[Any], arithmetic: Arithmetic
) -> Quaternion:
    """A unit quaternion that turns one vector to another of the same length."""
    squared, product = dot(before, before), dot(before, after)
    if any(isinstance(x, np.ndarray) for x in after):
        return _shortest_turns(before, after)
    if abs(squared + product) <= abs(squared) / 1000:
        # Nearly opposite: half a turn across the first vector, then the short way.
        half = (0 * squared, *_across(before))
        opposite_vector = tuple(-x for x in before)
        rest = _shortest_turn(opposite_vector, after, arithmetic)
        return multiply(rest, _unit(half, arithmetic))
    return _unit((squared + product, *cross(before, after)), arithmetic)


def _shortest_turns(before: Sequence[Any], after: Sequence[Any]) -> Quaternion:
    """The same to many vectors at once, arrays of coordinates."""
    real = Arithmetic(float, np.sqrt)
    before = tuple(float(x) for x in before)
    squared, product = dot(before, before), dot(before, after)
    near = abs(squared + product) <= squared / 1000
    back = tuple(-x for x in before)
    # Either is taken where it is well conditioned, and of any length elsewhere.
    one = np.where(near, 1.0, squared + product)
    short = _unit((one, *cross(before, after)), real)
    rest = _unit((np.where(near, squared - product, 1.0), *cross(back, after)), real)
    long = multiply(rest, _unit((0.0, *_across(before)), real))
    return tuple(np.where(near, x, y) for x, y in zip(long, short, strict=True))


def _across(vector: Sequence[Any]) -> Sequence[Any]:
    """A vector orthogonal to another, of no small length."""
    if all(isinstance(x, Fraction) for x in vector):
        return across(vector)[0]
    units = [tuple(int(i == j) for j in range(3)) for i in range(3)]
    return max((cross(vector, u) for u in units), key=lambda v: abs(dot(v, v)))
