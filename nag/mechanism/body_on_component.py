"""How a body moves along a component of a mechanism's configurations: the component's image.

The body's displacements at the component's points are its image in the group of displacements. Its
dimension is the rank of the derivative of the body's pose on the tangent space at a general point,
a complex one, so that it needs no real point and is that of each component by itself where several
meet. What the poses have in common in words is told as for a platform's (`motions`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nag.interpolation.point_cloud import AmbientVariables, Cloud
from nag.interpolation.precise_samples import source_of_component
from nag.mechanism.inverse_kinematics import conjugate_pose, multiply_poses
from nag.mechanism.joint_chains import JointChains, NotClear
from nag.mechanism.model import Model
from nag.mechanism.motions import MotionType, motion_of, twists_at
from nag.mechanism.moving_parts import BodyFreedoms
from nag.mechanism.pose_model import PoseModel
from nag.mechanism.quaternion import conjugate
from nag.mechanism.rods import RodModel
from nag.numerics.double_ranks import NEARLY_SINGULAR, SINGULAR, matrix_corank
from nag.tracking.run import Run, Stream
from nag.witness.witness import WitnessSet

# General points at which twists are compared.
POINTS = 3
# Step of the derivatives, relative to the point's size, and the weights of values at its multiples:
# errors are its fourth power.
STEP = 1e-3
WEIGHTS = {1: 2 / 3, -1: -2 / 3, 2: -1 / 12, -2: 1 / 12}


def find_body_freedoms(made: Model, component: WitnessSet, body: str, run: Run) -> BodyFreedoms:
    """How a body moves against the ground along a component.

    Rods, which turn about themselves whatever the equations say, do that besides.

    Args:
        made: whose system the component is one of.
        body: its name.

    Raises:
        NotClear: if that is not seen in the model, or a rank is not clear.
        nag.interpolation.precise_samples.SourceError: if no general points are found.
    """
    still = BodyFreedoms(body, MotionType(0, 0, ""), None)
    if body == made.mechanism.ground:
        return still
    if not _is_in_equations(made, body):
        raise NotClear(f"joints that the equations leave out move {body}")
    chain = JointChains.of(made.mechanism, None)
    source = source_of_component(made.system, component, False)
    cloud = Cloud(source, AmbientVariables.itself(made.system), run.random(Stream.BODY_CLOUD), run)
    bases, poses = [], []
    for point, tangents in cloud.tangents(POINTS):
        directions = tangents / np.linalg.norm(tangents, axis=1, keepdims=True)
        here, twists = _twists(made, point, directions, chain)
        own = _equalise_directions(twists)[body]
        if spin := _spins(made, body, here, chain):
            own = np.vstack([own, *spin])
        rank = len(own) - matrix_corank(own.T, NEARLY_SINGULAR) if len(own) else 0
        bases.append(np.linalg.svd(own)[2][:rank] if rank else np.zeros((0, 6)))
        poses.append(here[body])
    if not bases or not len(bases[0]):
        return still
    return replace(still, motion=motion_of(np.array(poses), bases, chain.size, chain.centre))


def _is_in_equations(made: Model, body: str) -> bool:
    """Whether a body is in a loop, and so is what is between it and the ground."""
    structure = made.structure
    if isinstance(made.form, PoseModel):
        return body == made.form.platform.robot.platform
    zero_rods = made.form.zero_rods if isinstance(made.form, RodModel) else ()
    inside = body in structure.moving and body not in zero_rods
    return inside and structure.base == made.mechanism.ground


def _twists(
    made: Model, point: np.ndarray, directions: np.ndarray, chain: JointChains
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """The poses of all bodies, and their twists along some directions, shape ``(d, 6)`` each."""
    here = _poses(made, point, chain.centre)
    step = STEP * (1 + float(np.abs(point).max(initial=0.0)))
    slopes = {body: np.zeros((len(directions), 8), dtype=complex) for body in here}
    for k, direction in enumerate(directions):
        for i, weight in WEIGHTS.items():
            there = _poses(made, point + i * step * direction, chain.centre)
            for body, pose in there.items():
                # A pose's sign is that of a root, and may be another one.
                other = np.abs(pose + here[body]).max() < np.abs(pose - here[body]).max()
                slopes[body][k] += (-weight if other else weight) / step * pose
    return here, {b: twists_at(here[b], slope, chain.size) for b, slope in slopes.items()}


def _equalise_directions(twists: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The same along directions in which all bodies together move equally much.

    How long a direction is in the model's variables is of no matter.
    """
    everything = np.hstack(list(twists.values()))
    left, s, _ = np.linalg.svd(everything, full_matrices=False)
    moving = s > SINGULAR * s.max(initial=0.0)
    even = (left[:, moving].conj() / s[moving]).T
    return {body: even @ own for body, own in twists.items()}


def _poses(made: Model, point: np.ndarray, centre: np.ndarray) -> dict[str, np.ndarray]:
    """How bodies are displaced against the reference, in Study coordinates about a centre."""
    if isinstance(made.form, PoseModel):
        platform = made.form.platform
        return {platform.robot.platform: _about(platform.study(point[None])[0], centre)}
    there = made.lift([complex(x) for x in point])
    found = {}
    for body in (made.structure.base, *made.structure.moving):
        back, turn = np.zeros(8), np.zeros(8, dtype=complex)
        back[:4] = [float(x) for x in conjugate(made.mechanism.orientation(body))]
        turn[:4] = [complex(x) for x in there.euler[body]]
        position = np.array([complex(x) for x in there.position[body]])
        found[body] = _about(multiply_poses(_shift(position), multiply_poses(turn, back)), centre)
    return found


def _about(pose: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """A pose in coordinates about a centre, of norm one."""
    pose = pose / np.sqrt(np.sum(pose[:4] ** 2))
    return multiply_poses(multiply_poses(_shift(-centre), pose), _shift(centre))


def _shift(vector: np.ndarray) -> np.ndarray:
    """A translation as a pose."""
    return np.concatenate([[1, 0, 0, 0, 0], vector / 2])


def _spins(
    made: Model, body: str, poses: dict[str, np.ndarray], chain: JointChains
) -> list[np.ndarray]:
    """The twist of a rod's turn about itself, of length one; none of other bodies."""
    found = []
    for rod in made.form.rods if isinstance(made.form, RodModel) else ():
        if body not in rod.frames:
            continue
        ends = []
        for joint, neighbour in zip(rod.ends, rod.neighbours, strict=True):
            away = np.array([float(x) for x in joint.point]) - chain.centre
            moved = multiply_poses(poses[neighbour], _shift(away))
            ends.append(
                2 * multiply_poses(moved, _invert_rotation(poses[neighbour]))[5:] / chain.size
            )
        twist = np.concatenate([ends[1] - ends[0], np.cross(ends[0], ends[1] - ends[0])])
        found.append(twist / np.linalg.norm(twist))
    return found


def _invert_rotation(pose: np.ndarray) -> np.ndarray:
    """The inverse of a pose's rotation."""
    return conjugate_pose(np.concatenate([pose[:4], np.zeros(4)]))
