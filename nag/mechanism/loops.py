"""What of a mechanism can move: bodies that are tied rigidly are one, and the rest has loops.

Gruebler and Kutzbach count freedoms without looking at the geometry.

Triangles of bodies and the like are left as they are: each of their assemblies belongs to other
components. In half-angles a planar triangle's equation factors, so that exact algebra takes it out.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, TypeVar

from nag.algebra.fixed_mapping import fixed_mapping
from nag.mechanism.axes import space_of
from nag.mechanism.graph import Body, Joint, Mechanism, check_mechanism


@dataclass(frozen=True)
class RigidGroups:
    """A mechanism whose rigidly tied bodies are one.

    Attributes:
        original: the mechanism as it was given.
        merged: the same without rigid joints; each group goes by the name of its first body. A
            mechanism of rigid joints only stays as it is.
        leader: that name, for every body of the original.
        idle: joints between two bodies of one group; they cannot move.
    """

    original: Mechanism
    merged: Mechanism
    leader: Mapping[str, str]
    idle: tuple[Joint, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "leader", fixed_mapping(self.leader))

    @property
    def is_one_body(self) -> bool:
        """Whether nothing is left that moves."""
        return len(set(self.leader.values())) == 1

    def __reduce__(self) -> tuple[object, ...]:
        return RigidGroups, (self.original, self.merged, dict(self.leader), self.idle)


def rigid_groups(
    mechanism: Mechanism, held: Collection[str] = (), displaced: Collection[str] = ()
) -> RigidGroups:
    """Tie the bodies of rigid joints together, and of those that are held.

    Joints are in global coordinates of the reference configuration, so that they stay as they are;
    only the names of their bodies change.

    Args:
        held: names of joints.
        displaced: names of rigid joints whose bodies are not where they are drawn: they tie
            nothing.
    """
    ties = {
        j.name
        for j in mechanism.joints
        if j.name not in displaced and (j.of_type.is_rigid or j.name in held)
    }
    leader = {b: b for b in mechanism.body_names}
    order = {b: i for i, b in enumerate(mechanism.body_names)}
    for joint in mechanism.joints:
        if joint.name in ties:
            first, second = sorted((leader[b] for b in joint.bodies), key=order.__getitem__)
            leader = {b: first if name == second else name for b, name in leader.items()}
    kept, idle = [], []
    for joint in mechanism.joints:
        bodies = tuple(leader[b] for b in joint.bodies)
        if joint.name in ties:
            continue
        if bodies[0] == bodies[1]:
            idle.append(joint)
        else:
            kept.append(replace(joint, bodies=bodies))
    if len(kept) == len(mechanism.joints) or not kept:
        return RigidGroups(mechanism, mechanism, leader, tuple(idle))
    used = {b for j in kept for b in j.bodies}
    frames = tuple(Body(b, mechanism.orientation(b)) for b in mechanism.body_names if b in used)
    merged = Mechanism(leader[mechanism.ground], tuple(kept), frames)
    return RigidGroups(mechanism, merged, leader, tuple(idle))


@dataclass(frozen=True)
class Loop:
    """A closed chain: ``joints[i]`` joins ``bodies[i]`` and ``bodies[(i + 1) % n]``."""

    bodies: tuple[str, ...]
    joints: tuple[Joint, ...]

    def start_at(self, start: int) -> Loop:
        """The same loop, read from ``bodies[start]`` on."""
        return Loop(
            self.bodies[start:] + self.bodies[:start], self.joints[start:] + self.joints[:start]
        )


@dataclass(frozen=True)
class LoopStructure:
    """What is left of a mechanism when rigid bodies are merged and dangling trees are cut off.

    A joint between two parts with loops that belongs to none, a bridge, moves freely as well. It is
    held, which merges its two bodies, as if it were rigid.

    Attributes:
        mechanism: the mechanism, each group of bodies that are tied rigidly or held as one body.
        groups: what was tied.
        base: the body taken as fixed: the ground, or, where the ground hangs on a tree, the body
            with loops that is nearest to it.
        moving: the other bodies, in the mechanism's order.
        joints: the joints between these bodies.
        cut: the joints of the trees; each moves freely, whatever the others do.
        loops: a minimum cycle basis.
        bridges: the joints that are held, between the bodies that they were given.
    """

    mechanism: Mechanism
    groups: RigidGroups
    base: str
    moving: tuple[str, ...]
    joints: tuple[Joint, ...]
    cut: tuple[Joint, ...]
    loops: tuple[Loop, ...]
    bridges: tuple[Joint, ...] = ()

    @property
    def outside(self) -> tuple[Joint, ...]:
        """The joints of no loop, each of which moves freely."""
        return self.cut + self.bridges

    @property
    def cut_freedoms(self) -> int:
        """Freedoms of the joints of no loop."""
        return sum(j.of_type.freedoms for j in self.outside)

    @property
    def single(self) -> Loop | None:
        """The loop, if there is only one, read from the base on and to its first neighbour."""
        if len(self.loops) != 1:
            return None
        loop = self.loops[0].start_at(self.loops[0].bodies.index(self.base))
        if self.moving.index(loop.bodies[1]) > self.moving.index(loop.bodies[-1]):
            return Loop(loop.bodies[:1] + loop.bodies[:0:-1], loop.joints[::-1])
        return loop

    def spanning_tree(self) -> Iterator[tuple[str, str, Joint]]:
        """(parent, child, joint) for every body of the mechanism but the base, parents first."""
        reached, frontier = {self.base}, [self.base]
        # Joints with loops first: where a tree hangs does not matter to them.
        order = self.joints + self.cut
        while frontier:
            parent = frontier.pop(0)
            for joint in order:
                if parent in joint.bodies and joint.other(parent) not in reached:
                    child = joint.other(parent)
                    reached.add(child)
                    frontier.append(child)
                    yield parent, child, joint


def loop_structure(mechanism: Mechanism, displaced: Collection[str] = ()) -> LoopStructure:
    """Merge rigid bodies, cut dangling trees off and choose a minimum cycle basis.

    A mechanism without loops gives a structure without moving bodies.

    Args:
        displaced: names of rigid joints that stay joints, as for `rigid_groups`.
    """
    groups, kept, left_out, bridges = _looped_joints(mechanism, displaced)
    mechanism = groups.merged
    if not kept:
        return LoopStructure(mechanism, groups, mechanism.ground, (), (), left_out, ())
    looped = {b for j in kept for b in j.bodies}
    distance = _distances(mechanism)
    base = min((b for b in mechanism.body_names if b in looped), key=lambda b: distance[b])
    moving = tuple(b for b in mechanism.body_names if b in looped and b != base)
    # As many joints as bodies, none of them dangling: they are one loop.
    one = len(kept) == len(looped)
    loops = (_order_loop(list(kept)),) if one else _loops_of(minimum_cycles(_edges(kept)), kept)
    return LoopStructure(mechanism, groups, base, moving, kept, left_out, loops, bridges)


def has_loops(mechanism: Mechanism) -> bool:
    """Whether joints close a loop, as far as bodies are not rigidly tied."""
    return bool(_looped_joints(mechanism)[1])


def _looped_joints(
    given: Mechanism, displaced: Collection[str] = ()
) -> tuple[RigidGroups, tuple[Joint, ...], tuple[Joint, ...], tuple[Joint, ...]]:
    """Rigid groups, the joints of loops, those of dangling trees, and those between loops."""
    groups = rigid_groups(given, displaced=displaced)
    if groups.is_one_body:
        return groups, (), (), ()
    kept, left_out = _split_off_trees(groups.merged.joints)
    names = _bridges(kept)
    if names:
        groups = rigid_groups(given, names, displaced)
        kept, left_out = _split_off_trees(groups.merged.joints)
    return groups, kept, left_out, tuple(j for j in given.joints if j.name in names)


def loop_bases(structure: LoopStructure) -> Iterator[tuple[Loop, ...]]:
    """Bases of the loops: the minimum one, then those of spanning trees at each body.

    A single loop is read from the base on.
    """
    if structure.single is not None:
        yield (structure.single,)
        return
    yield structure.loops
    import networkx

    graph = networkx.Graph(_edges(structure.joints))
    for body in (structure.base, *structure.moving):
        yield _loops_of(networkx.cycle_basis(graph, ("body", body)), structure.joints)


def _split_off_trees(joints: Sequence[Joint]) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
    """The joints without those of dangling trees, and these."""
    kept = tuple(joints)
    while True:
        degrees = Counter(b for j in kept for b in j.bodies)
        inner = tuple(j for j in kept if min(degrees[b] for b in j.bodies) > 1)
        if inner == kept:
            names = {j.name for j in kept}
            return kept, tuple(j for j in joints if j.name not in names)
        kept = inner


def _bridges(joints: Sequence[Joint]) -> set[str]:
    """Names of the joints that belong to no loop, where none is dangling."""
    if len(joints) == len({b for j in joints for b in j.bodies}):
        # One loop, and nothing else.
        return set()
    import networkx

    edges = networkx.bridges(networkx.Graph(_edges(joints)))
    return {name for edge in edges for kind, name in edge if kind == "joint"}


def _distances(mechanism: Mechanism) -> dict[str, int]:
    """How many joints away from the ground each body is."""
    distance, frontier = {mechanism.ground: 0}, [mechanism.ground]
    for body in frontier:
        for joint in mechanism.joints:
            if body in joint.bodies and joint.other(body) not in distance:
                distance[joint.other(body)] = distance[body] + 1
                frontier.append(joint.other(body))
    return distance


Node = TypeVar("Node")


def minimum_cycles(edges: Iterable[tuple[Node, Node]]) -> list[list[Node]]:
    """A minimum cycle basis of a graph, the nodes of each cycle one after the other.

    Each begins with its least node and goes on to its least neighbour. Which of several minimum
    bases is taken follows the hashes of the nodes: numbers have the same ones in every run.
    """
    return [list(cycle) for cycle in _minimum_cycles(tuple(edges))]


@lru_cache(maxsize=16)
def _minimum_cycles(edges: tuple[tuple[Any, Any], ...]) -> tuple[tuple[Any, ...], ...]:
    """The same: a mechanism's are asked for by all who take it apart."""
    import networkx

    graph: networkx.Graph = networkx.Graph(edges)
    cycles = []
    for nodes in networkx.minimum_cycle_basis(graph):
        cycle = [min(nodes)]
        while len(cycle) < len(nodes):
            cycle.append(min(v for v in graph[cycle[-1]] if v in nodes and v not in cycle))
        cycles.append(tuple(cycle))
    return tuple(cycles)


def _edges(joints: Iterable[Joint]) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """A simple graph in which a joint is a node of its own."""
    return [(("body", body), ("joint", joint.name)) for joint in joints for body in joint.bodies]


def _loops_of(
    cycles: Sequence[Sequence[tuple[str, str]]], joints: tuple[Joint, ...]
) -> tuple[Loop, ...]:
    position = {j.name: i for i, j in enumerate(joints)}
    by_name = {j.name: j for j in joints}
    loops = []
    for nodes in cycles:
        names = {name for kind, name in nodes if kind == "joint"}
        loops.append(_order_loop([by_name[n] for n in sorted(names, key=position.__getitem__)]))
    return tuple(sorted(loops, key=lambda p: [position[j.name] for j in p.joints]))


def _order_loop(joints: list[Joint]) -> Loop:
    """The joints of one cycle, in the order in which they follow each other."""
    chain = [joints[0]]
    bodies = list(joints[0].bodies)
    rest = joints[1:]
    while rest:
        joint = next(j for j in rest if bodies[-1] in j.bodies)
        rest.remove(joint)
        chain.append(joint)
        bodies.append(joint.other(bodies[-1]))
    return Loop(tuple(bodies[:-1]), tuple(chain))


def gruebler_kutzbach(mechanism: Mechanism) -> int:
    """Freedoms of all moving bodies minus the conditions of all joints.

    A body has 6 freedoms in space and 3 in planar and spherical mechanisms. The count is wrong
    for overconstrained mechanisms: it knows nothing of the geometry (T25, section 7).

    Raises:
        MechanismError: if something else is given.

    >>> import nag
    >>> nag.gruebler_kutzbach(nag.read_case("cases/bennett.toml").mechanism)  # and yet it moves
    -2
    """
    check_mechanism(mechanism)
    space = space_of(mechanism.joints)
    freedoms = 6 if space == "spatial" else 3
    moving = len(mechanism.body_names) - 1
    lost = sum(freedoms - j.freedoms_in(space) for j in mechanism.joints)
    return freedoms * moving - lost
