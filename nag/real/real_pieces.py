"""Real points of a component: whether there are any, and at least one on each connected piece.

Of a finite set they are those of its points that are real, of a curve what the complete picture of
it says. On each connected piece of the real part of a larger set, which is closed, some point is
nearest to a given one (Seidenberg 1954): with n - d of the equations f it satisfies
``x - p = J^T l``, a system in x and l whose isolated solutions are found, if the nearest point is
smooth (Hauenstein 2012; Wu & Reid 2013). Where that takes too many paths, Newton's method looks for
real points round random ones. A component that is not its own conjugate has real points only where
it meets that, which is a smaller set.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.decomposition.intersection import intersect_components
from nag.errors import ComponentError, StartError
from nag.numerics.coincidence import NEAR, coincident
from nag.numerics.local_dimension import local_dimension
from nag.numerics.read_only import RealArray, Several, equal_values, fixed_array
from nag.numerics.zero_values import LEAST, ON
from nag.real.curve import RealCurve
from nag.real.find_curve import RealCurveError, find_real_curve
from nag.real.real_equations import (
    NOT_KNOWN_REAL,
    RealEquations,
    distinct_points,
    find_real_equations,
    real_points_of,
)
from nag.real.real_through import is_other_than_its_conjugate
from nag.solving.solve import solve
from nag.text.table import lines_of, one_line, point_text
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.frame import expand_orbits
from nag.witness.membership import Membership, is_member
from nag.witness.real_points import real_points_near
from nag.witness.shown import real_dimension_text
from nag.witness.witness import Slice, WitnessSet

# Paths of the system of nearest points, by the product of its degrees, up to which it is solved.
MOST_PATHS = 3000
# Random points round which Newton's method looks for real ones, of each size.
PLACES, SIZES = 3, (0.3, 1.0, 3.0)


class Reality(StrEnum):
    """Whether a component has real points.

    It has none, which is proved, where its picture is complete, or it does not meet its conjugate;
    where none was found there may be some.
    """

    FOUND = "found"
    NONE_FOUND = "none found"
    NONE = "none, proved"


@dataclass(frozen=True, eq=False)
class RealPieces(Several[RealArray]):
    """Real points of a component.

    Attributes:
        points: real, shape ``(k, n)``.
        dimensions: of the real part round each, or -1 where it is not known.
        reality: whether there are any.
        each_piece: whether at least one on each connected piece is among them.
        reason: what that rests on, or what is not known.
    """

    points: RealArray
    dimensions: tuple[int, ...]
    reality: Reality
    each_piece: bool
    reason: str

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", fixed_array(self.points, float))

    @property
    def entries(self) -> RealArray:
        """The points."""
        return self.points

    @property
    def complete(self) -> bool:
        """Whether it is known that there are none, or one is here of each connected piece."""
        return self.reality is Reality.NONE or (self.reality is Reality.FOUND and self.each_piece)

    def to_numpy(self) -> RealArray:
        """The points, shape ``(k, n)``, to be written to."""
        return self.points.copy()

    __repr__ = one_line

    def __str__(self) -> str:
        rows = [("answer", answer_text(self))]
        rows += [("real", real_dimension_text(self.dimensions))] if len(self) else []
        rows.append(("rests on", self.reason))
        rows += [("point", point_text(x)) for x in self.points[:1]]
        return lines_of("RealPieces", rows)


def answer_text(found: RealPieces) -> str:
    """Whether there are real points, in words."""
    if found.reality is not Reality.FOUND:
        return f"real points: {found.reality}"
    number = len(found)
    pieces = "at least one" if found.each_piece else "perhaps not"
    return f"{number} real point{'s' * (number > 1)}, {pieces} on each connected piece"


@takes_run
def find_real_points(component: WitnessSet, *, run: Run = DEFAULT_RUN) -> RealPieces:
    """Real points of a component of any dimension, on each connected piece where they are had.

    Of finite sets and curves they are one on each piece, of larger sets at least one.

    Args:
        component: one of the components of a `nag.Decomposition`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The points, whether there are any, and what that rests on. Where coefficients are complex,
        they have no coordinate for the imaginary unit.

    Raises:
        nag.ComponentError: if the witness points are no regular zeros of equations that cut it.

    >>> import nag
    >>> sphere, = nag.decompose("x^2 + y^2 + z^2 = 1").components
    >>> found = nag.find_real_points(sphere)
    >>> str(found.reality), bool(abs((found.points**2).sum(axis=1) - 1).max() < 1e-12)
    ('found', True)
    >>> [len(nag.find_real_points(c)) for c in nag.decompose("x^4 = 4").components]
    [1, 1, 0, 0]
    """
    check_type(component, WitnessSet, "component", "one of the components of a nag.Decomposition")
    component._known_system().check_real_coordinates()
    if component.dimension == 0:
        return _of_finite_set(component)
    if component._known_system().imaginary:
        return _of_complex_equations(component, run)
    if component.dimension == 1:
        return _of_curve(component, run)
    return _of_larger_set(component, run)


def no_real_points(component: WitnessSet, reason: str) -> RealPieces:
    """The answer for a component of which something proves that none of its points is real."""
    n = len(component._known_system().own_variables)
    return RealPieces(np.zeros((0, n)), (), Reality.NONE, True, reason)


def _of_finite_set(component: WitnessSet) -> RealPieces:
    points, doubtful = real_points_of(component)
    if doubtful:
        reality = Reality.FOUND if len(points) else Reality.NONE_FOUND
        return RealPieces(points, (0,) * len(points), reality, False, NOT_KNOWN_REAL)
    if len(points):
        reason = "points whose imaginary parts are 0 to 100 digits"
        return RealPieces(points, (0,) * len(points), Reality.FOUND, True, reason)
    reason = "all points are away from their conjugates by more than their errors"
    return RealPieces(points, (), Reality.NONE, True, reason)


def _of_complex_equations(component: WitnessSet, run: Run) -> RealPieces:
    """Real points of a set of larger dimension than zero, where coefficients are complex."""
    equations = find_real_equations(component, run)
    inside = [find_real_points(c, run=run) for c in equations.inside]
    return join_pieces(component, equations, inside, run)


def join_pieces(
    component: WitnessSet, equations: RealEquations, inside: Sequence[RealPieces], run: Run
) -> RealPieces:
    """Real points of a component by those of the parts of its complex equations.

    Args:
        inside: those of the components that lie on it.
    """
    found = [*inside, *(find_real_points(c, run=run) for c in equations.met)]
    beside = [find_real_points(c, run=run).reality for c in equations.beside]
    doubts = [equations.doubt] if equations.doubt else []
    if any(reality is not Reality.NONE for reality in beside):
        doubts.append("real points may be missing at which it meets other real zeros")
    doubts += [f.reason for f in found if not f.each_piece]
    reason = "; ".join(doubts) or "real and imaginary parts of the equations"
    itself = equations.inside and equations.inside[0].dimension == component.dimension
    with_conjugate = _where_conjugates_meet(component, run) if doubts and not itself else None
    if with_conjugate is not None and with_conjugate.each_piece:
        return with_conjugate
    return _join(found, len(equations.variables), reason, not doubts)


def _join(found: Sequence[RealPieces], n: int, reason: str, each_piece: bool) -> RealPieces:
    """The real points of several sets together, in ``n`` variables, each once."""
    known = [f for f in found if len(f)]
    if known:
        points, places = distinct_points([f.points for f in known])
        dimensions = np.full(len(points), -1)
        np.maximum.at(dimensions, places, [d for f in known for d in f.dimensions])
        own = tuple(dimensions.tolist())
        return RealPieces(points, own, Reality.FOUND, each_piece, reason)
    reality = Reality.NONE if each_piece else Reality.NONE_FOUND
    return RealPieces(np.zeros((0, n)), (), reality, each_piece, reason)


def _of_curve(component: WitnessSet, run: Run) -> RealPieces:
    try:
        curve = find_real_curve(component, run=run)
    except RealCurveError as error:
        return _near_random_points(component, str(error), run)
    if not curve.complete:
        return _near_random_points(component, curve.reason, run)
    points, dimensions = points_of_pieces(curve)
    reality = Reality.FOUND if len(points) else Reality.NONE
    reason = "all real points of a curve, from its fibres in many digits"
    return RealPieces(points, dimensions, reality, True, reason)


def points_of_pieces(curve: RealCurve) -> tuple[np.ndarray, tuple[int, ...]]:
    """A point on each piece of a curve, a smooth one of arcs, and the dimensions there."""
    points, dimensions = [], []
    for piece in curve.pieces:
        if piece.edges:
            own = curve.edges[piece.edges[0]].points
            points.append(own[len(own) // 2])
        else:
            points.append(curve.vertices[piece.vertices[0]].point)
        dimensions.append(int(bool(piece.edges)))
    shape = len(points), len(curve.variables)
    return np.array(points, dtype=float).reshape(shape), tuple(dimensions)


def _of_larger_set(component: WitnessSet, run: Run) -> RealPieces:
    given = component._known_system()
    if is_other_than_its_conjugate(given, component, run):
        with_conjugate = _where_conjugates_meet(component, run)
        if with_conjugate is not None:
            return with_conjugate
    natural = coordinates_of(given)
    system = natural.system(given)
    here = carry_component(component, natural, system)
    fibres = component_fibres(system, here)
    cut = fibres[0].cut
    if cut.aux:
        reason = "the component is not reduced: its nearest points are not looked for"
        return _near_random_points(component, reason, run)
    rng = run.random(Stream.REAL_PIECES)
    target = [Fraction(int(c), 64) for c in rng.integers(-128, 128, system.n)]
    nearest = nearest_points_system(cut, target)
    if np.prod([float(f.degree) for f in nearest.polynomials]) > MOST_PATHS:
        reason = f"nearest points would take more than {MOST_PATHS} paths"
        return _near_random_points(component, reason, run)
    try:
        found = solve(nearest, run=run)
    except StartError as error:
        return _near_random_points(component, str(error), run)
    starts = np.array([s.point[: system.n] for s in found.real]).reshape(-1, system.n).real
    points, undecided = _members(system, fibres, starts, rng, run)
    complete = found.complete and not undecided and not len(found.on_components)
    doubt = "" if complete else "some nearest points may be missing"
    doubt = doubt or _singular_doubt(cut, rng, run)
    if not len(points):
        if not doubt:
            reason = "no nearest point of a random one is real, and none is singular"
            return RealPieces(np.zeros((0, system.n)), (), Reality.NONE, True, reason)
        return _near_random_points(component, f"no real nearest point was found; {doubt}", run)
    dimensions = tuple(real_dimension_at(system, here, x) for x in points)
    reason = f"points whose distance from a random one is stationary; {doubt or 'all of them'}"
    back = natural.inverse.points(points)
    return RealPieces(back, dimensions, Reality.FOUND, not doubt, reason)


def _where_conjugates_meet(component: WitnessSet, run: Run) -> RealPieces | None:
    """The real points of a component that is not its own conjugate; None if these are not known.

    They lie on its conjugate as well.
    """
    met = meet_conjugate(component, run)
    if met is None:
        return None
    system = component._known_system()
    found = [find_real_points(each, run=run) for each in met]
    doubts = [each.reason for each in found if not each.each_piece]
    reason = "it is not its own conjugate, and its real points are where it meets that"
    return _join(found, len(system.own_variables), "; ".join([reason, *doubts]), not doubts)


def meet_conjugate(component: WitnessSet, run: Run) -> tuple[WitnessSet, ...] | None:
    """The components of where one meets its conjugate; None where these are not known."""
    system = component._known_system()
    try:
        met = intersect_components(system, component, _conjugate(component), run=run)
    except ComponentError:
        return None
    return expand_orbits(met).components if met.complete else None


def _conjugate(component: WitnessSet) -> WitnessSet:
    """The component whose points are the conjugates, of the conjugate equations.

    The imaginary unit is i in these as well.
    """
    system = component._known_system()
    own = len(system.own_variables)
    A, points = component.slice.A.conj(), component.points.conj()
    if system.imaginary:
        A[:, own:] *= -1
        points[:, own:] *= -1
        signs = (*(1,) * own, -1)
        unit = SignedPermutation.of_signs(signs)
        polynomials = tuple(unit.of_polynomial(f) for f in system.polynomials)
        system = replace(system, polynomials=polynomials)
    return replace(
        component,
        slice=Slice(A, component.slice.b.conj()),
        points=points,
        orbit=1,
        images=(),
        fibres=(),
        system=system,
    )


def _singular_doubt(cut: Cut, rng: np.random.Generator, run: Run) -> str:
    """Why a piece may have no smooth nearest point; empty where no real point is singular."""
    system = singular_points_system(cut, rng)
    if np.prod([float(f.degree) for f in system.polynomials[: system.n]]) > MOST_PATHS:
        return f"singular points would take more than {MOST_PATHS} paths"
    try:
        found = solve(system, run=run)
    except StartError as error:
        return str(error)
    if found.complete and not (len(found.on_components) or found.real or found.pathless):
        return ""
    return "pieces whose nearest point is singular may be missing"


def singular_points_system(cut: Cut, rng: np.random.Generator) -> PolynomialSystem:
    """Equations of points at which gradients depend on each other, with multipliers."""
    n, m = cut.n, len(cut.polynomials)
    total = n + m
    rows = [f.with_variables(total, range(n)) for f in cut.polynomials]
    multipliers = Polynomial.variables(total)[n:]
    for i in range(n):
        slopes = (f.derivative(i).with_variables(total, range(n)) for f in cut.polynomials)
        products = (m * slope for m, slope in zip(multipliers, slopes, strict=True))
        rows.append(sum(products, Polynomial(total, {})))
    weights = (Fraction(int(c), 64) for c in rng.integers(32, 96, m))
    patch = sum((w * m for w, m in zip(weights, multipliers, strict=True)), Polynomial(total, {}))
    names = (*(f"x{i}" for i in range(n)), *(f"l{j}" for j in range(m)))
    return PolynomialSystem(names, (*rows, patch - Polynomial.constant(total, 1)))


def nearest_points_system(cut: Cut, target: Sequence[Fraction]) -> PolynomialSystem:
    """Equations of points x whose distance from a target is stationary, with multipliers.

    Args:
        cut: the equations f; the others are ``x - p = J^T l``.
    """
    n, m = cut.n, len(cut.polynomials)
    total = n + m
    variables = Polynomial.variables(total)
    rows = [f.with_variables(total, range(n)) for f in cut.polynomials]
    normals = []
    for i in range(n):
        normal = variables[i] - Polynomial.constant(total, target[i])
        for j, f in enumerate(cut.polynomials):
            slope = f.derivative(i).with_variables(total, range(n))
            normal = normal - variables[n + j] * slope
        normals.append(normal)
    names = (*(f"x{i}" for i in range(n)), *(f"l{j}" for j in range(m)))
    return PolynomialSystem(names, (*rows, *normals))


def _members(
    system: PolynomialSystem,
    fibres: Sequence[Fibre],
    points: np.ndarray,
    rng: np.random.Generator,
    run: Run,
) -> tuple[np.ndarray, int]:
    """Those of the points that lie on the component, each once, and how many are not decided."""
    evaluator = Evaluator.of(system.polynomials, system.n)
    known, undecided = np.zeros((0, system.n)), 0
    for x in points:
        if evaluator.residuals(x[None] + 0j).max(initial=0.0) > ON:
            continue
        if coincident(known, x, 0.0).any():
            continue
        answer, _ = is_member(x + 0j, LEAST, fibres, rng, run)
        undecided += answer is Membership.UNDECIDED
        if answer is Membership.MEMBER:
            known = np.vstack([known, x])
    return known, undecided


def real_dimension_at(system: PolynomialSystem, component: WitnessSet, x: np.ndarray) -> int:
    """The component's dimension where the equations have the rank that they have on it.

    There the real part has the same dimension; elsewhere it is not known, -1. A nearest point at
    which the set is singular is a multiple solution, and known to fewer digits.
    """
    there = local_dimension(system, x + 0j, accuracy=NEAR)
    smooth = there.tangent_dimension == component.corank
    return component.dimension if smooth else -1


def _near_random_points(component: WitnessSet, why: str, run: Run) -> RealPieces:
    """What Newton's method finds round random points."""
    system = component._known_system()
    size = float(np.median(np.abs(component.points)))
    rng = run.random(Stream.CRITICAL_POINTS)
    for scale in SIZES:
        for _ in range(PLACES):
            near = scale * max(size, 1.0) * rng.standard_normal(system.n)
            found = real_points_near(system, component, near, run=run, starts=6)
            if len(found):
                points = np.asarray(found.points)[:1]
                dimension = real_dimension_at(system, component, points[0])
                reason = f"Newton's method from random points; {why}"
                return RealPieces(points, (dimension,), Reality.FOUND, False, reason)
    nothing = np.zeros((0, system.n))
    reason = f"nor by Newton's method from random points; {why}"
    return RealPieces(nothing, (), Reality.NONE_FOUND, False, reason)
