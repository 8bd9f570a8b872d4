"""The point of a model in Euler parameters, or in (c, s) of each body, that a configuration is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nag.algebra.number import Number
from nag.mechanism.axes import dot
from nag.mechanism.configuration import Arithmetic, Configuration, arithmetic_of
from nag.mechanism.euler import EulerModel, slide_carrier, slide_directions
from nag.mechanism.graph import Joint
from nag.mechanism.loops import LoopStructure
from nag.mechanism.planar import PlanarModel
from nag.mechanism.quaternion import conjugate, multiply, rotate


def project_configuration(form: EulerModel | PlanarModel, placed: Configuration) -> tuple[Any, ...]:
    """The coordinates of a configuration in the form's system.

    The signs of Euler parameters are taken as they are; (c, s) know no signs.
    """
    structure = form.structure
    bodies = [placed.euler[b] for b in structure.moving]
    entries = [x for q in bodies for x in q]
    arithmetic = arithmetic_of(entries)
    if isinstance(form, PlanarModel):
        entries = [x for b in structure.moving for x in _turn(form, b, placed, arithmetic)]
    for joint in structure.joints:
        if slide_directions(joint):
            entries += _distances(structure, joint, placed, arithmetic)
    return tuple(form.elimination.project(entries))


def _relative(
    structure: LoopStructure, body: str, placed: Configuration, arithmetic: Arithmetic
) -> Sequence[Any]:
    """The turn of a body from the reference configuration."""
    reference = [arithmetic.convert(x) for x in structure.mechanism.orientation(body)]
    return multiply(placed.euler[body], conjugate(reference))


def _turn(
    form: PlanarModel, body: str, placed: Configuration, arithmetic: Arithmetic
) -> tuple[Any, Any]:
    normal = [arithmetic.convert(x) for x in form.normal]
    squared = dot(normal, normal)
    half = _relative(form.structure, body, placed, arithmetic)
    s = dot(half[1:], normal) / squared
    c, s = half[0] * half[0] - squared * (s * s), 2 * half[0] * s
    c0, s0 = (arithmetic.convert(x) for x in form.offsets[body])
    return c * c0 - squared * (s * s0), s * c0 + c * s0


def _distances(
    structure: LoopStructure, joint: Joint, placed: Configuration, arithmetic: Arithmetic
) -> list[Any]:
    convert = arithmetic.convert
    point = [convert(x) for x in joint.point]
    carrier = slide_carrier(structure, joint)
    turns = {b: _relative(structure, b, placed, arithmetic) for b in joint.bodies}
    at = {
        b: [r + x for r, x in zip(placed.position[b], rotate(turns[b], point), strict=True)]
        for b in joint.bodies
    }
    gap = [y - x for x, y in zip(at[carrier], at[joint.other(carrier)], strict=True)]
    gap = rotate(conjugate(turns[carrier]), gap)
    return [_along(gap, [convert(x) for x in u]) for u in slide_directions(joint)]


def _along(vector: Sequence[Any], direction: Sequence[Number]) -> Any:
    return dot(vector, direction) / dot(direction, direction)
