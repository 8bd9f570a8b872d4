"""Axes as lines by Pluecker coordinates: a direction, and the moment point x direction.

Other programs for linkages have their axes like that, rational-linkages among them, whose lines
are read as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from nag.algebra.from_python import exact_vector
from nag.algebra.number import is_zero
from nag.errors import MechanismError
from nag.mechanism.axes import cross, dot, vanishes
from nag.mechanism.graph import Joint, Mechanism

# Decides: How far direction and moment may be from orthogonal, in numbers that are rounded.
ROUNDED = 1e-9


def loop_of_lines(lines: Iterable[Any]) -> Mechanism:
    """The closed loop of revolute joints about lines, in their order; the first body is fixed.

    Raises:
        MechanismError: if one is no line.
    """
    axes = [_axis(line, i) for i, line in enumerate(lines)]
    count = len(axes)
    joints = [
        Joint(f"J{i + 1}", "revolute", (f"link{i}", f"link{(i + 1) % count}"), point, axis)
        for i, (point, axis) in enumerate(axes)
    ]
    return Mechanism("link0", tuple(joints))


def _axis(line: Any, index: int) -> tuple[Sequence[Any], Sequence[Any]]:
    """A point and the direction of a line."""
    try:
        values = exact_vector(list(line), f"lines[{index}]")
    except TypeError:
        values = ()
    if len(values) != 6:
        raise MechanismError(f"lines[{index}]: give six numbers, a direction and its moment")
    direction, moment = values[:3], values[3:]
    if vanishes(direction):
        raise MechanismError(f"lines[{index}]: its direction has length zero")
    product, squared = dot(direction, moment), dot(direction, direction)
    if not is_zero(product):
        size = float(squared) ** 0.5 * float(dot(moment, moment)) ** 0.5
        if abs(float(product)) > ROUNDED * size:
            raise MechanismError(
                f"lines[{index}]: direction and moment are not orthogonal; the moment is point x "
                "direction"
            )
    return tuple(x / squared for x in cross(direction, moment)), direction


def lines_of(mechanism: Mechanism) -> np.ndarray:
    """Direction, of length 1, and moment of each joint that has an axis, shape ``(k, 6)``."""
    rows = []
    for joint in mechanism.joints:
        if joint.axis is not None:
            direction = np.array([float(x) for x in joint.axis])
            direction /= np.linalg.norm(direction)
            moment = np.cross([float(x) for x in joint.point], direction)
            rows.append([*direction, *moment])
    return np.array(rows).reshape(-1, 6)
