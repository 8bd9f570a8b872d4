"""What moves near a configuration: parts that are idle, locked or rigid, and freedoms of a body.

All but a body's screws, which are those at a given configuration, is said of generic ones near it:
the mechanism is smooth there, or as singular as at all of them, so that it holds all along the
component. The configurations are real and found by Newton's method in doubles, in the coordinates
of the joints (`joint_chains`), whatever the formulation of the equations; where a rank is not
clear, nothing is said.
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import networkx
import numpy as np

from nag.mechanism.graph import Joint, Mechanism
from nag.mechanism.joint_chains import SLIDING, TURNING, JointChains, corank, moves
from nag.mechanism.joint_types import COORDINATES
from nag.mechanism.motions import MotionType, ScrewSystem, motion_of, screw_system
from nag.text.table import count_text, join_words

# Of more units, those between two others are not looked at.
MOST_UNITS = 60
# Freedoms of a body that nothing holds, and how many of these are slides.
FREEDOMS_IN_SPACE, SLIDES_IN_SPACE = 6, 3


@dataclass(frozen=True)
class IdleFreedom:
    """Freedoms with which bodies move by themselves, and nothing else does.

    Attributes:
        bodies: one body, or several that are a chain between two others.
        count: of the freedoms.
        turns: whether it is one, a turn about a line or, if three, about a point.
        joint: the only one by which the body is joined to others, if it turns about it; else empty.
        meant: another body that is perhaps the same, its name spelled otherwise; mostly empty.
    """

    bodies: tuple[str, ...]
    count: int
    turns: bool
    joint: str = ""
    meant: str = ""

    @property
    def alike(self) -> tuple[int, bool, int, str, str]:
        """What freedoms have in common that are told together."""
        return self.count, self.turns, len(self.bodies), self.joint, self.meant

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return {"bodies": list(self.bodies), "freedoms": self.count}


@dataclass(frozen=True)
class BodyFreedoms:
    """How a body moves against the ground.

    Attributes:
        body: its name.
        motion: what its poses have in common, all along the component; of rank 0 where it stands
            still.
        screws: the twists that it can have at the configuration itself; None where that is any.
    """

    body: str
    motion: MotionType
    screws: ScrewSystem | None

    def __str__(self) -> str:
        rank = self.motion.rank
        if not rank:
            return f"{self.body}: no freedom, it stands still"
        text = f"{self.body}: {count_text(rank, 'freedom')}, {self.motion}"
        if self.screws is None:
            return text
        if self.screws.rank < rank:
            there = f"screws of {self.screws} alone" if self.screws.rank else "none of them"
            return f"{text}; at the configuration {there}"
        if self.motion.group:
            return text
        return f"{text}; at the configuration its twists are a screw system of {self.screws}"

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return {
            "body": self.body,
            "freedoms": self.motion.rank,
            "translations": self.motion.rank - self.motion.turning,
            "freedoms_there": None if self.screws is None else self.screws.rank,
            "pitches": None if self.screws is None else list(self.screws.pitches),
            "kind": str(self.motion) if self.motion.rank else "",
        }


@dataclass(frozen=True)
class MovingParts:
    """What moves, all along the component through a configuration.

    Attributes:
        freedoms: of the mechanism.
        idle: freedoms with which parts between two others move by themselves.
        hanging: the same of bodies that are joined to one other body alone, as a pendulum and the
            last link of an arm are.
        locked: names of joints that never move; all those between bodies of one of ``together``;
            and of the turns and slides that never move of other joints.
        together: bodies that never move against each other, groups of two and more.
        body: the freedoms of the body that was asked for; None if none was.
    """

    freedoms: int
    idle: tuple[IdleFreedom, ...]
    hanging: tuple[IdleFreedom, ...]
    locked: tuple[str, ...]
    together: tuple[tuple[str, ...], ...]
    body: BodyFreedoms | None

    @property
    def idle_count(self) -> int:
        """How many freedoms are idle."""
        return sum(each.count for each in self.idle)

    @property
    def idle_text(self) -> str:
        """Which parts are idle; empty where none is."""
        return describe_parts(self.idle)

    @property
    def idle_kinds(self) -> str:
        """How many parts are idle, by whether they are rods that turn about themselves."""
        rods = sum(each.turns and each.count == 1 for each in self.idle)
        others = len(self.idle) - rods
        texts = [
            f"{count_text(count, kind)} that {verb}{'s' * (count == 1)} idly"
            for count, kind, verb in ((rods, "rod", "turn"), (others, "part", "move"))
            if count
        ]
        return join_words(texts)

    def rows(self) -> list[tuple[str, str]]:
        """Labelled lines of what there is to be said."""
        rows = []
        if self.idle:
            rows.append(("idle", f"{count_text(self.idle_count, 'freedom')}: {self.idle_text}"))
        if self.hanging:
            rows.append(("hanging", describe_parts(self.hanging)))
        if self.locked and self.freedoms:
            rows.append(("locked", f"{', '.join(self.locked)}: never moving"))
        if self.freedoms:
            groups = [" with ".join(own) for own in self.together]
            rows += [("rigid", f"{'; '.join(groups)}: as one body")] if groups else []
        if self.body is not None:
            rows.append(("of", str(self.body)))
        return rows

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return {
            "idle": [e.document() for e in self.idle],
            "hanging": [e.document() for e in self.hanging],
            "locked": list(self.locked),
            "together": [list(own) for own in self.together],
            "of": None if self.body is None else self.body.document(),
        }


def _meant_by(name: str, mechanism: Mechanism) -> str:
    """A body of nearly the same name, a letter more or less inside it; empty if there is none."""
    others = [
        other
        for other in sorted({body for joint in mechanism.joints for body in joint.bodies})
        if abs(len(other) - len(name)) == 1
        and f"{name}{other}".isalpha()
        and not other.startswith(name)
        and not name.startswith(other)
    ]
    return next(iter(difflib.get_close_matches(name, others, n=1, cutoff=0.85)), "")


def describe_parts(parts: Sequence[IdleFreedom]) -> str:
    """Which parts move by themselves, and how."""
    texts = []
    for alike in sorted({e.alike for e in parts}):
        count, turns, _, joint, meant = alike
        own = [e for e in parts if e.alike == alike]
        names = join_words([" with ".join(e.bodies) for e in own])
        names += f" (did you mean {meant!r}?)" if meant else ""
        one = len(own) == 1
        about = "itself" if one else "themselves"
        if turns:
            what = f"turn{'s' * one} about "
            alone = joint or about
            what += alone if count == 1 else ("its point" if one else "their points")
        else:
            freedoms = count_text(count, "freedom")
            what = f"move{'s' * one} by {about}, {'' if one else 'each '}with {freedoms}"
        texts.append(f"{names} {what}")
    return "; ".join(texts)


def find_moving_parts(
    mechanism: Mechanism,
    dimension: int,
    rng: np.random.Generator,
    places: Mapping[str, tuple[np.ndarray, np.ndarray]] | None = None,
    body: str | None = None,
) -> MovingParts:
    """What moves near a configuration that is smooth, or as singular as all others near it.

    Args:
        dimension: of the configuration space there, joints outside all loops included.
        places: for each body how it is displaced against the reference configuration, a rotation
            matrix and a vector; by default it is not.
        body: one whose freedoms are asked for.

    Raises:
        nag.mechanism.joint_chains.NotClear: if the configuration is more singular than others, a
            rank is not clear, or no configuration near by is found.
    """
    chain = JointChains.of(mechanism, places)
    singular = chain.singular_corank(dimension)
    along = [np.zeros(chain.n), *chain.generic(dimension, singular, rng)]
    tangents = [chain.tangent(q, dimension, singular) for q in along]
    rates, twists = tangents[-1]
    names = mechanism.body_names
    units = _group(names, twists)
    locked = [
        name
        for joint, own in zip(mechanism.joints, chain.columns, strict=True)
        for name in _locked_names(joint, rates[own])
    ]
    idle, hanging = _idle(mechanism, units, twists) if dimension else ([], [])
    freedoms = None
    if body is not None:
        own = [found[names.index(body)] for _, found in tangents]
        freedoms = _body_freedoms(body, chain, along, own)
    together = tuple(own for own in units if len(own) > 1)
    return MovingParts(*(dimension, tuple(idle), tuple(hanging), tuple(locked), together, freedoms))


def _locked_names(joint: Joint, rates: np.ndarray) -> list[str]:
    """A joint if it never moves, or those of its turns and slides that do not, by their names."""
    if joint.of_type.is_rigid:
        return []
    if not moves(rates):
        return [joint.name]
    factors = joint.of_type.factors
    if not set(factors) <= {"turn", "slide"}:
        return []
    parts = zip(COORDINATES[factors], rates, strict=True)
    return [f"{joint.name}.{part}" for (part, _), own in parts if not moves(own)]


def _group(names: Sequence[str], twists: np.ndarray) -> list[tuple[str, ...]]:
    """Bodies that move as one, in their order."""
    groups: list[list[int]] = []
    for i in range(len(names)):
        for own in groups:
            if not moves(twists[i] - twists[own[0]]):
                own.append(i)
                break
        else:
            groups.append([i])
    return [tuple(names[i] for i in own) for own in groups]


def _idle(
    mechanism: Mechanism, units: Sequence[tuple[str, ...]], twists: np.ndarray
) -> tuple[list[IdleFreedom], list[IdleFreedom]]:
    """Freedoms of one unit, or of several as one, that move nothing else, each once.

    Those of units that are joined to one other body alone come apart: to move by itself is all that
    these can do. A rod between two bodies is none of them, though these be rigid together.
    """
    names = mechanism.body_names
    unit_of = {body: k for k, own in enumerate(units) for body in own}
    first = [names.index(own[0]) for own in units]
    ties = networkx.Graph()
    ties.add_nodes_from(names)
    ties.add_edges_from(joint.bodies for joint in mechanism.joints if joint.of_type.is_rigid)
    welded = {body: k for k, own in enumerate(networkx.connected_components(ties)) for body in own}
    graph = networkx.Graph()
    graph.add_nodes_from(range(len(units)))
    graph.add_edges_from(tuple(unit_of[b] for b in joint.bodies) for joint in mechanism.joints)
    graph.remove_edges_from(list(networkx.selfloop_edges(graph)))
    taken = np.zeros((twists.shape[2], 0))
    found: list[IdleFreedom] = []
    hanging: list[IdleFreedom] = []
    for own in _parts_between(graph, unit_of[mechanism.ground]):
        others = [twists[first[k]] for k in range(len(units)) if k not in own]
        differences = [twists[first[k]] - twists[first[own[0]]] for k in own[1:]]
        matrix = np.vstack([*others, *differences])
        basis = np.linalg.svd(matrix)[2][matrix.shape[1] - corank(matrix) :].T
        both = np.hstack([taken, basis])
        count = both.shape[1] - corank(both) - (taken.shape[1] - corank(taken))
        if not count:
            continue
        taken = both
        turns = count == basis.shape[1] and _are_turns(twists[first[own[0]]] @ basis)
        at = [j for j in mechanism.joints if len({unit_of[b] for b in j.bodies} - set(own)) == 1]
        at = [j for j in at if {unit_of[b] for b in j.bodies} & set(own)]
        joint = at[0].name if turns and count == 1 and len(at) == 1 else ""
        bodies = tuple(body for k in own for body in units[k])
        meant = _meant_by(bodies[0], mechanism) if len(bodies) == len(at) == 1 else ""
        beside = {welded[b] for j in at for b in j.bodies if unit_of[b] not in own}
        if (
            turns
            and len(beside) == 1
            and len(at) == 1
            and _slides_lead_to(mechanism, at[0], bodies)
        ):
            count, turns = FREEDOMS_IN_SPACE, False
        part = IdleFreedom(bodies, count, turns, joint, meant)
        (hanging if len(beside) == 1 else found).append(part)
    return found, hanging


def _slides_lead_to(mechanism: Mechanism, ball: Joint, bodies: Sequence[str]) -> bool:
    """Whether a ball joint, which bodies hang on, is at the end of slides in all directions.

    Slides and turns then are all displacements, and those of the bodies alone.
    """
    if not ball.of_type.turns_about_point:
        return False
    axes: list[np.ndarray] = []
    joint, (end,) = ball, set(ball.bodies) - set(bodies)
    while end != mechanism.ground:
        others = [j for j in mechanism.joints if end in j.bodies and j is not joint]
        axis = others[0].axis if len(others) == 1 and others[0].of_type.slides_only else None
        if axis is None:
            break
        (joint,) = others
        axes.append(np.array([float(x) for x in axis]))
        (end,) = set(joint.bodies) - {end}
    return len(axes) >= SLIDES_IN_SPACE and np.linalg.matrix_rank(np.array(axes)) == SLIDES_IN_SPACE


def _parts_between(graph: networkx.Graph, ground: int) -> list[tuple[int, ...]]:
    """Single units but the ground, and what is connected between two units, the smallest first."""
    single = [(k,) for k in graph if k != ground]
    between: set[tuple[int, ...]] = set()
    for pair in combinations(graph, 2) if len(graph) <= MOST_UNITS else ():
        rest = graph.subgraph(set(graph) - set(pair))
        for part in networkx.connected_components(rest):
            joined = all(part & set(graph.neighbors(k)) for k in pair)
            if len(part) > 1 and ground not in part and joined:
                between.add(tuple(sorted(part)))
    return single + sorted(between, key=lambda part: (len(part), part))


def _are_turns(twists: np.ndarray) -> bool:
    """Whether twists, shape ``(6, k)``, are one turn about a line, or all three about a point."""
    turning, velocity = twists[TURNING], twists[SLIDING]
    symmetric = turning.T @ velocity
    if twists.shape[1] not in (1, 3) or moves(symmetric + symmetric.T):
        return False
    return corank(turning) == 0


def _body_freedoms(
    body: str, chain: JointChains, along: Sequence[np.ndarray], twists: Sequence[np.ndarray]
) -> BodyFreedoms:
    """The freedoms of a body.

    Args:
        along: joint coordinates of the configuration, and of generic ones near it.
        twists: that the body can have there, shape ``(6, d)`` each.
    """
    # Far from the origin, velocities of its point would hide the turns.
    bases = [_basis(own) for own in twists]
    poses = np.array([chain.study(q, body) for q in along])
    generic = bases[1:] or bases
    if not len(generic[0]):
        return BodyFreedoms(body, MotionType(0, 0, ""), ScrewSystem(0, 0, ()))
    motion = motion_of(poses[-len(generic) :], generic, chain.size, chain.centre)
    here = screw_system(bases[0], chain.size) if len(bases[0]) else ScrewSystem(0, 0, ())
    return BodyFreedoms(body, motion, here)


def _basis(twists: np.ndarray) -> np.ndarray:
    """An orthonormal basis of what twists, shape ``(6, d)``, span, shape ``(rank, 6)``."""
    rank = twists.shape[1] - corank(twists) if twists.shape[1] else 0
    return np.linalg.svd(twists)[0][:, :rank].T if rank else np.zeros((0, 6))
