"""Membership of a point in the sets that fibres stand for, by moving the slice through it."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.system import PolynomialSystem
from nag.decomposition.cutting import Equations
from nag.decomposition.fibres import Fibre, Tracker, admit, move
from nag.decomposition.slices import rows_through, unit_complex
from nag.decomposition.witness import Decomposition, PathCounts, WitnessSet

# Ends of membership paths lay within 5e-11 of a member and beyond 7e-4 of any other point in all
# systems measured; what falls between is asked again on another slice.
HIT = 1e-8
MISS = 1e-5
ATTEMPTS = 4


class Membership(Enum):
    """The answer of a membership test."""

    MEMBER = "member"
    FOREIGN = "foreign"
    UNDECIDED = "undecided"


def is_member(
    point: np.ndarray,
    accuracy: float,
    fibres: Sequence[Fibre],
    flag: np.ndarray,
    rng: np.random.Generator,
    tracker: Tracker,
) -> tuple[Membership, PathCounts]:
    """Whether an affine point lies in the closure of the set that ``fibres`` stand for.

    ``fibres`` have one dimension and lie on the leading rows of ``flag``. The slice moves to a
    generic one through the point; the point is a member exactly when a path ends there
    (Sommese, Verschelde & Wampler 2001).
    """
    counts = PathCounts()
    fibres = [fibre for fibre in fibres if len(fibre)]
    if not fibres:
        return Membership.FOREIGN, counts
    dimension = fibres[0].dimension
    scale = 1 + float(np.linalg.norm(point))
    hit, miss = max(HIT, 1e2 * accuracy), max(MISS, 1e4 * accuracy)
    for attempt in range(ATTEMPTS):
        target = rows_through(rng, dimension, point)
        gamma = complex(unit_complex(rng))
        careful = Tracker("careful" if attempt else tracker.settings, tracker.threads)
        nearest, unclear = np.inf, False
        for fibre in fibres:
            ends = move(fibre, flag[:dimension], target, gamma, careful, endgame=True)
            counts += ends.counts.repeatable
            x = ends.points[ends.finite, : fibre.cut.n]
            distances = np.linalg.norm(x - point, axis=1) / scale
            nearest = distances.min(initial=nearest)
            if nearest < hit:
                return Membership.MEMBER, counts
            unclear |= bool(ends.failed.any() or (distances < miss).any())
            unclear |= bool((distances < 1e4 * ends.accuracy[ends.finite]).any())
        if not unclear:
            return Membership.FOREIGN, counts
    return Membership.UNDECIDED, counts


def component_fibres(
    system: PolynomialSystem, component: WitnessSet, rng: np.random.Generator
) -> list[Fibre]:
    """The points of a component with square systems that cut them, found anew from the system.

    Raises:
        ValueError: if the points are not regular zeros of the system or of a deflation of it.
    """
    rows = np.hstack([-component.slice.b[:, None], component.slice.A])
    accuracy = max(component.accuracy, 1e-12)
    equations = Equations(system.polynomials, system.n)
    fibres: list[Fibre] = []
    for x in component.points:
        deflate = component.multiplicity != 1
        if not admit(x, accuracy, fibres, equations, rows, rng, deflate):
            raise ValueError("the witness points are no regular zeros of the system")
    return fibres


def components_through(
    decomposition: Decomposition,
    point: np.ndarray,
    *,
    accuracy: float = 1e-12,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> list[int]:
    """Indices of the components that an affine point lies on, the highest dimension first.

    Args:
        point: complex, shape ``(n,)``, in the system's variables.
        accuracy: relative error of the point.

    Raises:
        ValueError: if the membership in a component could not be decided.
    """
    rng = np.random.default_rng([seed, 1])
    tracker = Tracker(settings, threads)
    point = np.asarray(point, dtype=complex)
    system = decomposition.system
    found = []
    if Evaluator.of(system.polynomials, system.n).residuals(point[None]).max(initial=0.0) > 1e-6:
        return found
    for i, component in enumerate(decomposition.components):
        rows = np.hstack([-component.slice.b[:, None], component.slice.A])
        fibres = component_fibres(system, component, rng)
        answer, _ = is_member(point, accuracy, fibres, rows, rng, tracker)
        if answer is Membership.UNDECIDED:
            raise ValueError(f"whether the point lies on component {i} could not be decided")
        if answer is Membership.MEMBER:
            found.append(i)
    return found
