"""Real assemblies that do not move: isolated real points of the solution set.

They are the real points of its finite components, and of its curves the real points at which only
branches that are not real meet, but for those through which another component moves. On components
of larger dimension they are not looked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from nag.kinematics.driven import DrivenAssembly, half_turns_forwards, is_same_assembly
from nag.kinematics.joint_values import joint_values
from nag.kinematics.poses import SAME, Poses, join_poses, pose_distances
from nag.kinematics.scene import Scene
from nag.real.curve import PieceKind, RealCurve
from nag.real.real_pieces import find_real_points
from nag.text.table import count_text, join_words
from nag.tracking.run import Run
from nag.witness.witness import Decomposition, WitnessSet

# Decimals of values by which assemblies are put in order.
DECIMALS = 9
# Isolated complex solutions of which it is looked which are real, each to 100 digits; isolated
# points of curves of which it is asked whether other components pass through them.
MOST_SOLUTIONS, MOST_POINTS = 1_000, 24
# Decides: Coordinates of points near infinity: what else passes through them is not said.
FAR = 1e6


@dataclass(frozen=True, eq=False)
class RigidAssemblies:
    """Real assemblies that do not move.

    Attributes:
        assemblies: in the order of their values, each once.
        not_looked_for: where others were not looked for, in words; empty if they were everywhere.
        doubts: why others may be missing where they were.
    """

    assemblies: tuple[DrivenAssembly, ...]
    not_looked_for: str
    doubts: tuple[str, ...]


@dataclass(frozen=True)
class Configurations:
    """The components of a decomposition, by the configurations that they are.

    Attributes:
        everything: the decomposition, with the components of all orbits.
        classes: of each of its components the index of the first one with the same configurations,
            as those are that differ in signs of Euler parameters.
    """

    everything: Decomposition
    classes: tuple[int, ...]

    @property
    def finite(self) -> tuple[WitnessSet, ...]:
        """The components of dimension 0, each set of configurations once."""
        components = self.everything.components
        return tuple(
            components[i] for i in dict.fromkeys(self.classes) if components[i].dimension == 0
        )

    def count(self, indices: Iterable[int]) -> int:
        """How many sets of configurations components are."""
        return len({self.classes[i] for i in indices})


def find_rigid_assemblies(
    scene: Scene, configurations: Configurations, curves: Mapping[int, RealCurve], run: Run
) -> RigidAssemblies:
    """The real assemblies among finite components and isolated on curves.

    Args:
        curves: the real points of those that were looked at, by a component's index.
    """
    components = configurations.everything.components
    finite = configurations.finite
    elsewhere, doubts = [], []
    found: list[DrivenAssembly] = []
    number = sum(len(each.points) for each in finite)
    if number > MOST_SOLUTIONS:
        elsewhere.append(f"among {number} isolated complex ones")
    else:
        found, doubts = isolated_assemblies(scene, finite, run)
    on_curves, own_doubts = _isolated_on_curves(scene, configurations, curves, run)
    doubts += own_doubts
    seen = {configurations.classes[i] for i in curves}
    others = [i for i, k in enumerate(configurations.classes) if k not in seen]
    along = configurations.count(i for i in others if components[i].dimension == 1)
    larger = configurations.count(i for i in others if components[i].dimension > 1)
    if along:
        elsewhere.append(f"on {count_text(along, 'other curve')} (circuit: all)")
    if larger:
        elsewhere.append(f"on {count_text(larger, 'component')} of dimension 2 or more")
    assemblies = distinct_assemblies(scene, [*found, *on_curves])
    return RigidAssemblies(_in_order(assemblies), join_words(elsewhere), tuple(doubts))


def distinct_assemblies(scene: Scene, assemblies: Sequence[DrivenAssembly]) -> list[DrivenAssembly]:
    """Those that are the same configuration as none before them."""
    if not assemblies:
        return []
    every = join_poses([each.poses for each in assemblies])
    kept: list[int] = []
    for i in range(len(assemblies)):
        before, own = every.at(np.array(kept, dtype=int)), every.at(np.full(len(kept), i))
        if not (pose_distances(own, before, scene.measure) < SAME).any():
            kept.append(i)
    return [assemblies[i] for i in kept]


def _in_order(assemblies: Iterable[DrivenAssembly]) -> tuple[DrivenAssembly, ...]:
    return tuple(sorted(assemblies, key=lambda each: tuple(np.round(each.values, DECIMALS))))


def isolated_assemblies(
    scene: Scene, components: Sequence[WitnessSet], run: Run
) -> tuple[list[DrivenAssembly], list[str]]:
    """The real assemblies among components of dimension 0, and what is not known of others."""
    every, doubtful = list[np.ndarray](), 0
    for component in components:
        real = find_real_points(component, run=run)
        doubtful += not real.each_piece
        every += list(np.asarray(real.points))
    notes = []
    if doubtful:
        notes.append(f"assemblies left out as it is not known whether they are real: {doubtful}")
    points = np.array(every)
    if scene.lift_all is None or not every:
        return (_assemblies_at(scene, points) if every else []), notes
    above, poses, doubts = scene.lift_all(points, run)
    return _assemblies_of(scene, points[above], poses), [*notes, *doubts]


def _assemblies_at(scene: Scene, points: np.ndarray) -> list[DrivenAssembly]:
    """The assemblies at points of the equations."""
    return _assemblies_of(scene, points, scene.lift(points))


def _assemblies_of(scene: Scene, points: np.ndarray, poses: Poses) -> list[DrivenAssembly]:
    values = half_turns_forwards(scene, joint_values(scene, poses))
    return [
        DrivenAssembly(None, None, values[i], poses.at(slice(i, i + 1)), points[i])
        for i in range(len(points))
    ]


def _isolated_on_curves(
    scene: Scene, configurations: Configurations, curves: Mapping[int, RealCurve], run: Run
) -> tuple[list[DrivenAssembly], list[str]]:
    """Assemblies at isolated real points of curves through which no other component moves."""
    alone = {i: _assemblies_at(scene, _isolated_points(curve)) for i, curve in curves.items()}
    several = configurations.count(range(len(configurations.classes))) > 1
    number = sum(map(len, alone.values()))
    if several and number > MOST_POINTS:
        return [], [f"isolated real points of curves, through which others may move: {number}"]
    found, doubts = list[DrivenAssembly](), list[str]()
    for i, own in alone.items():
        for each in own:
            assert each.point is not None
            through = find_components_through(configurations, each.point, run)
            if through is None:
                doubts.append("through an isolated real point of a curve another one may move")
                continue
            others = [k for k in through if k != configurations.classes[i]]
            # A real point of another curve is on an arc of it, or isolated there as well.
            if all(
                any(is_same_assembly(scene, each, other) for other in alone[k])
                for k in others
                if k in alone
            ) and all(k in alone for k in others):
                found.append(each)
    return found, list(dict.fromkeys(doubts))


def _isolated_points(curve: RealCurve) -> np.ndarray:
    points = [
        curve.vertices[piece.vertices[0]].point
        for piece in curve.pieces
        if piece.kind is PieceKind.POINT
    ]
    return np.array(points, dtype=float).reshape(len(points), len(curve.variables))


def find_components_through(
    configurations: Configurations, point: np.ndarray, run: Run
) -> tuple[int, ...] | None:
    """Which components pass through a singular point, each configuration's once, by its class.

    None where that is not decided.
    """
    if len(configurations.everything.components) == 1:
        return (0,)
    if not (np.abs(point) < FAR).all():
        return None
    from nag.witness.membership import components_through

    try:
        through = components_through(configurations.everything, point, accuracy=SAME, run=run)
    except ValueError:
        return None
    return tuple(dict.fromkeys(configurations.classes[i] for i in through))
