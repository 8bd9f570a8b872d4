"""Real points where coefficients are complex: those of the equations' real and imaginary parts.

Where ``g + i h`` vanishes at a real point, so do g and h, whose coefficients are real. Of their
components some lie on a component C of the complex equations: C itself if it is its own conjugate,
else sets of less dimension. Its other real points lie where it meets the others of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.imaginary_unit import (
    append_unit,
    in_variables_with_unit,
    real_and_imaginary_parts,
    restore_unit,
)
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.decomposition.intersection import intersect_equations
from nag.errors import ComponentError
from nag.numerics.coincidence import SPREAD, coincident
from nag.numerics.doubles import EPS
from nag.real.curve import PictureVerdict, PieceKind, RealCurve, RealPiece, RealVertex, VertexKind
from nag.tracking.run import Run
from nag.witness.component_equations import component_system
from nag.witness.exact_points import exact_zeros
from nag.witness.frame import expand_orbits
from nag.witness.membership import Membership, membership_in
from nag.witness.witness import WitnessSet

NOT_KNOWN_REAL = "whether a point is real is not known"


@dataclass(frozen=True)
class RealEquations:
    """What the real and imaginary parts of equations say of the real points of a component.

    Attributes:
        variables: names, without the imaginary unit.
        inside: components of the parts that lie on the component, the largest first.
        met: points, with the imaginary unit, at which it meets others.
        beside: others that it may meet in more, or it is not known where.
        doubt: what is not known; empty where all are.
    """

    variables: tuple[str, ...]
    inside: tuple[WitnessSet, ...]
    met: tuple[WitnessSet, ...]
    beside: tuple[WitnessSet, ...]
    doubt: str = ""


def find_real_equations(component: WitnessSet, run: Run) -> RealEquations:
    """The components of the real and imaginary parts of a component's complex equations.

    Of equations that have factors those of the component are taken, so that it is not asked where
    it meets real zeros of the other ones.
    """
    system = component._known_system()
    parts = real_and_imaginary_parts(restore_unit(component_system(system, component)))
    found = decompose(parts, run=run)
    doubts = [] if found.complete else [f"real and imaginary parts: {'; '.join(found.notes)}"]
    inside, beside, met = [], [], list[WitnessSet]()
    for each in sorted(expand_orbits(found).components, key=lambda c: -c.dimension):
        if each.dimension > component.dimension:
            points = _meeting_points(component, parts, each, run)
            met += points or ()
            beside += [each] if points is None else []
            continue
        point, error = append_unit(each.points[:1])[0], max(float(each.errors[0]), EPS)
        answer = membership_in(system, component, point, error, run)
        if answer is Membership.MEMBER:
            inside.append(each)
        elif answer is Membership.UNDECIDED:
            doubts.append("not known whether one of their components lies on it")
        elif each.dimension:
            points = _meeting_points(component, parts, each, run)
            met += points or ()
            beside += [each] if points is None else []
    known = tuple(inside), tuple(met), tuple(beside)
    return RealEquations(parts.variables, *known, "; ".join(doubts))


def _meeting_points(
    component: WitnessSet, parts: PolynomialSystem, other: WitnessSet, run: Run
) -> tuple[WitnessSet, ...] | None:
    """The points at which a component meets one of the real parts' equations.

    None where they meet in more, or that is not known.
    """
    system = component._known_system()
    own = in_variables_with_unit(component_system(parts, other), system.variables[-1])
    try:
        met = intersect_equations(system, component, own, run=run)
    except ComponentError:
        return None
    points = all(c.dimension == 0 for c in met.components)
    return met.components if met.complete and points else None


def curve_of_real_points(equations: RealEquations) -> RealCurve:
    """The real points of a curve that is not its own conjugate: finitely many."""
    points = [c for c in equations.inside if c.dimension == 0]
    known = [real_points_of(c) for c in (*points, *equations.met)]
    found, _ = distinct_points([own for own, _ in known])
    pieces = (RealPiece(PieceKind.POINT, (), (k,)) for k in range(len(found)))
    doubt = equations.doubt
    if any(doubtful for _, doubtful in known):
        doubt = doubt or NOT_KNOWN_REAL
    doubt = doubt or (
        "points at which it meets a larger set of zeros of the equations' real parts may be missing"
        if equations.beside
        else ""
    )
    return RealCurve(
        equations.variables,
        (),
        tuple(RealVertex(VertexKind.ISOLATED, x) for x in found),
        (),
        tuple(pieces),
        PictureVerdict.UNDECIDED if doubt else PictureVerdict.COMPLETE,
        doubt,
    )


def distinct_points(sets: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """The points of real sets that may have some in common, each once, in the order given.

    Args:
        sets: shapes ``(k, n)``.

    Returns:
        The points, shape ``(m, n)``, and for each given one, set by set, which of them it is.
    """
    found: list[np.ndarray] = []
    places = []
    for x in (x for own in sets for x in own):
        there = np.flatnonzero(coincident(np.array(found).reshape(-1, len(x)), x, 0.0))
        places.append(int(there[0]) if len(there) else len(found))
        if not len(there):
            found.append(x)
    n = sets[0].shape[1] if sets else 0
    return np.array(found).reshape(-1, n), np.array(places, dtype=int)


def real_points_of(component: WitnessSet) -> tuple[np.ndarray, int]:
    """The real points of a finite set, shape ``(k, n)``, and how many others may be real.

    A point is taken for real if its imaginary parts vanish to 100 digits; where that is not known,
    as of several zeros that so many digits do not tell apart, it is not among those points. Of
    complex equations the coordinate that is the imaginary unit is left out.
    """
    system = component._known_system()
    own = len(system.own_variables)
    off, radii = np.abs(component.points.imag[:, :own]), component.radii[:, :own]
    near = np.flatnonzero((off <= radii).all(axis=1)).tolist()
    judged = {k: _is_real(system, component, k, own) for k in near}
    kept = [k for k in near if judged[k]]
    doubtful = sum(answer is None for answer in judged.values())
    return component.points[kept, :own].real, doubtful


def _is_real(system: PolynomialSystem, component: WitnessSet, index: int, own: int) -> bool | None:
    """Whether a point is real to 100 digits; None if it is not known to so many.

    It may stand for several zeros that doubles do not tell apart.
    """
    zeros = exact_zeros(system.polynomials, component, index)
    answers = set[bool]()
    for zero in zeros:
        known = zero.precise
        if known is None:
            return None
        off = np.array([float(abs(z.imag.mid())) for z in known.centre[:own]])
        answers.add(bool((off <= SPREAD * np.asarray(known.radii[:own])).all()))
    return answers.pop() if len(answers) == 1 else None
