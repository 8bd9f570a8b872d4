"""Lines of overconstrained linkages in doubles, and their mechanisms with rounded numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from linkages import CASES
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from nag.files.cases import read_case
from nag.mechanism.graph import Joint, Mechanism

Lines = tuple[np.ndarray, np.ndarray]


def rounded_loop(lines: Lines, digits: int) -> Mechanism:
    """A loop of revolute joints about lines, all numbers rounded to so many decimals."""
    axes, points = lines
    n = len(axes)
    joints = [
        Joint(
            f"J{i}",
            "revolute",
            (f"B{(i - 1) % n}", f"B{i}"),
            tuple(f"{x:.{digits}f}" for x in point),
            tuple(f"{x:.{digits}f}" for x in axis),
        )
        for i, (axis, point) in enumerate(zip(axes, points, strict=True))
    ]
    return Mechanism("B0", tuple(joints))


def turned(lines: Lines) -> Lines:
    """The same, turned so that no number is a special one."""
    q = np.linalg.qr(np.array([[0.61, -0.23, 0.4], [0.1, 0.77, -0.35], [-0.2, 0.31, 0.9]]))[0]
    return lines[0] @ q, lines[1] @ q + np.array([0.12, -0.3, 0.21])


def posed(lines: Lines, seed: int) -> Lines:
    """The same somewhere else, at random."""
    turn = Rotation.random(random_state=seed)
    shift = np.random.default_rng(seed).standard_normal(3)
    return turn.apply(lines[0]), turn.apply(lines[1]) + shift


def unit(rows: Sequence[Sequence[float]]) -> np.ndarray:
    found = np.array(rows, dtype=float)
    return found / np.linalg.norm(found, axis=1, keepdims=True)


HALF_TURN, MIRROR = np.diag([-1.0, -1.0, 1.0]), np.diag([1.0, -1.0, 1.0])
AXES = [[0.3, 0.7, -0.4], [0.9, -0.2, 0.5], [-0.1, 0.6, 0.8]]
POINTS = [[1.1, 0.2, -0.3], [0.4, 0.9, 0.5], [-0.6, 0.8, 0.1]]


def line_symmetric() -> Lines:
    """Three lines, and where half a turn about another one takes them."""
    axes, points = unit(AXES), np.array(POINTS)
    return np.vstack([axes, axes @ HALF_TURN]), np.vstack([points, points @ HALF_TURN])


def plane_symmetric() -> Lines:
    """Two lines of a plane, and two pairs of images between them."""
    axes, points = unit(AXES), np.array(POINTS)
    inside = unit([[0.8, 0, 0.3], [-0.2, 0, 0.9]])
    places = np.array([[1.3, 0, 0.2], [-0.9, 0, 0.4]])
    order = [inside[0], axes[0], axes[1], inside[1], axes[1] @ MIRROR, axes[0] @ MIRROR]
    there = [places[0], points[0], points[1], places[1], points[1] @ MIRROR, points[0] @ MIRROR]
    return np.array(order), np.array(there)


def spherical() -> Lines:
    """Four lines through a point, each drawn at a point of its own."""
    axes = unit([[0.3, 0.1, 0.9], [0.8, -0.2, 0.6], [0.9, 0.7, 0.3], [-0.2, 0.8, 0.5]])
    return axes, axes * np.array([[1.1], [0.9], [1.2], [0.8]])


def sarrus() -> Lines:
    """Three parallel lines, and three of another direction."""
    first, second = unit([[1, 0, 0], [0.3, 0.9, 0.2]])
    points = [[0, 1, 0], [0.1, 1.4, 0.6], [0, 1, 1.1], [1, 0, 1.1], [1.5, 0.2, 0.5], [1, 0, 0]]
    # Of unequal lengths, as else equal ones are rounded alike and stay parallel.
    lengths = np.array([[1], [1.3], [0.8], [1.1], [0.7], [0.9]])
    return np.array([first] * 3 + [second] * 3) * lengths, np.array(points, dtype=float)


def assembled(name: str) -> Lines:
    """The lines of a table in cases/spatial, in the first assembly that turns are found for."""
    rows = read_case(CASES / "spatial" / f"{name}.toml").assembly.loop.rows
    table = []
    for row in rows:
        twist = 2 * np.arctan2(float(row.alpha[1]), float(row.alpha[0]))
        table.append((float(row.a), float(row.d), np.cos(twist), np.sin(twist)))

    def frames(angles: np.ndarray) -> list[np.ndarray]:
        found = [np.eye(4)]
        for angle, (a, d, c, s) in zip(angles, table, strict=True):
            about = np.eye(4)
            about[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
            about[2, 3] = d
            along = np.eye(4)
            along[1:3, 1:3], along[0, 3] = [[c, -s], [s, c]], a
            found.append(found[-1] @ about @ along)
        return found

    def opening(angles: np.ndarray) -> np.ndarray:
        return (frames(angles)[-1] - np.eye(4))[:3].ravel()

    rng = np.random.default_rng(0)
    while True:
        found = least_squares(opening, rng.uniform(-3, 3, len(table)), xtol=1e-15, ftol=1e-15)
        if found.cost < 1e-25 and np.abs(np.sin(found.x)).min() > 0.1:
            closed = frames(found.x)[:-1]
            axes, points = (np.array([f[:3, k] for f in closed]) for k in (2, 3))
            lines = np.hstack([axes, np.cross(points, axes)])
            if np.linalg.svd(lines)[1][len(table) - 1] < 1e-10:
                return axes, points
