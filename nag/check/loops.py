"""Single spatial loops with named frames: the mechanisms of T25, and their exact equations."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from nag.algebra.rational_function import FunctionField
from nag.check.rings import euler_ring, unit
from nag.mechanism.axes import difference
from nag.mechanism.graph import Body, Joint, Mechanism
from nag.mechanism.quaternion import conjugate, multiply, rotate
from nag.symbolic import bennett, bennett_geometry, bricard


def loop(points: Sequence[Any], axes: Sequence[Any], frames: Sequence[Any]) -> Mechanism:
    """Bodies B0, B1, ..; joint J_l joins B_{l-1} and B_l; B0 is fixed."""
    n = len(points)
    joints = [
        Joint(
            f"J{i}",
            "revolute",
            (f"B{(i - 1) % n}", f"B{i}"),
            tuple(map(Fraction, points[i])),
            tuple(map(Fraction, axes[i])),
        )
        for i in range(n)
    ]
    bodies = [Body(f"B{i + 1}", frame) for i, frame in enumerate(frames)]
    return Mechanism("B0", tuple(joints), tuple(bodies))


def bennett_mechanism(m: Sequence[Fraction]) -> Mechanism:
    """B_H with the points, axes and frames of T25 sections 5 and 6."""
    return loop(bennett_geometry.points(m), bennett_geometry.axes(m), bennett.orientations(m))


def bricard_mechanism() -> Mechanism:
    """Bricard's mechanism of T25 section 4."""
    return loop(bricard.POINTS, bricard.AXES, bricard.ORIENTATIONS)


def local(frame: Sequence[Any] | None, v: Sequence[Any]) -> tuple[Any, ...]:
    """A global vector in a body's frame; ``None`` is the fixed body."""
    return tuple(v) if frame is None else rotate(conjugate(frame), v)


def axis_equations(
    chi: Sequence[Any], bodies: tuple[Any, Any], frames: tuple[Any, Any], sign: int = 1
) -> list[Any]:
    """R(a) chi = sign R(b) chi, chi in both bodies' frames: four equations linear in conj(a) b.

    ``bodies`` and ``frames`` have None for the fixed body.
    """
    one = next(b for b in bodies if b is not None)[0]
    zero = 0 * one
    fixed = (zero + 1, zero, zero, zero)
    a, b = (fixed if q is None else q for q in bodies)
    r = multiply(conjugate(a), b)
    left = (zero, *local(frames[0], chi))
    right = (zero, *(sign * x for x in local(frames[1], chi)))
    return list(difference(multiply(left, r), multiply(r, right)))


def loop_equations(
    points: Sequence[Any],
    axes: Sequence[Any],
    frames: Sequence[Any],
    bodies: Sequence[Any],
    signs: Sequence[int] = (),
) -> list[Any]:
    """Prime components of the joints, norms and the loop equation.

    Args:
        bodies: Euler parameters of the moving bodies, as variables or numbers.
        signs: -1 for a joint whose axis is reversed against the reference configuration.
    """
    n = len(points)
    q, f = [None, *bodies], [None, *frames]
    signs = signs or (1,) * n
    found = unit(*bodies)
    for i in range(n):
        pair = (q[i - 1], q[i]), (f[i - 1], f[i])
        found += axis_equations(axes[i], *pair, signs[i])
    total = [0, 0, 0]
    for i in range(n):
        v = local(f[i], difference(points[(i + 1) % n], points[i]))
        turned = v if q[i] is None else rotate(q[i], v)
        total = [x + y for x, y in zip(turned, total, strict=True)]
    return [g for g in [*found, *total] if g]


def bricard_equations(bodies: Sequence[Any], signs: Sequence[int] = ()) -> list[Any]:
    """Those of Bricard's mechanism."""
    return loop_equations(bricard.POINTS, bricard.AXES, bricard.ORIENTATIONS, bodies, signs)


def bennett_equations(m: Sequence[Any], bodies: Sequence[Any]) -> list[Any]:
    """Those of B_H, for parameters that are numbers or functions."""
    return loop_equations(
        bennett_geometry.points(m), bennett_geometry.axes(m), bennett.orientations(m), bodies
    )


def bricard_ring(order: Any = "degrevlex") -> tuple[FunctionField, list[tuple[Any, ...]]]:
    """Euler parameters a to e."""
    return euler_ring("abcde", order)
