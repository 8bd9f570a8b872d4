"""All ways in which a serial chain reaches a pose: how many there are, and which.

Above a general pose of its image a chain has as many ways as at one of its own poses, which is a
closed loop of rational numbers: these are its zeros, counted by a decomposition. At any other pose
they are found by Newton's method from random starts until there are as many; fewer are left where
some are singular or at infinity, and that is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nag.decomposition.decompose import decompose
from nag.mechanism.half_angles import cheapest_closure
from nag.mechanism.inverse_kinematics import find_all_joints, real_ways
from nag.mechanism.joint_factors import Charts
from nag.mechanism.loop_product import Element, displacement, factors_in
from nag.mechanism.quaternion import dual_conjugate
from nag.tracking.run import Run, Stream

# Coordinates of a general pose of a chain are whole numbers up to it.
LARGEST = 64


@dataclass(frozen=True, eq=False)
class LegWays:
    """The ways in which a chain reaches a real pose with real joints.

    Attributes:
        joints: of each way homogeneous coordinates of all factors, in the order of the chain.
        missing: how many of all ways, complex ones included, were not found.
    """

    joints: tuple[tuple[np.ndarray, ...], ...]
    missing: int


def count_ways(elements: Sequence[Element], run: Run) -> int | None:
    """In how many ways, complex ones included, a chain reaches a general pose of its own.

    None where there are infinitely many, or their number is not known.
    """
    rng = run.random(Stream.LEG_WAYS)
    values = {
        f: tuple(Fraction(x) for x in rng.integers(1, LARGEST, f.dimension + 1).tolist())
        for f in factors_in(elements)
    }
    closing = Element(None, (dual_conjugate(displacement(elements, values, lambda c: c)),))
    closure = cheapest_closure([*elements, closing])
    if closure is None:
        return None
    charts = Charts.of(factors_in(closure.kept))
    if not charts.n:
        return 1
    found = decompose(charts.system(closure.polynomials(charts)), run=run)
    if not found.complete or any(c.dimension or c.is_multiple for c in found.components):
        return None
    return sum(c.degree for c in found.components)


def find_leg_ways(
    elements: Sequence[Element],
    pose: np.ndarray,
    count: int,
    length: float,
    rng: np.random.Generator,
) -> LegWays:
    """The real ones of all ways in which a chain reaches a real pose.

    Args:
        elements: the chain.
        pose: real Study coordinates, shape ``(8,)``.
        count: how many ways there are, complex ones included.
        length: by which lengths are measured, from an origin amidst the chain.
        rng: for the starts.
    """
    ways = find_all_joints(elements, pose, length, rng, count)
    return LegWays(tuple(real_ways(ways)), max(0, count - len(ways)))
