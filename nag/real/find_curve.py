"""All real points of a one-dimensional component, as a graph.

A linear form with random rational coefficients makes the curve a covering of the line. Its real
special values are found from fibres in many digits, or, where these are too many, by paths to the
critical points; between them real points neither appear nor vanish, and arcs through them are
traced to the special points at both ends. Where arcs meet smoothly they are joined. Every number on
the way is known twice: how many real points there are on both sides of each value, to which
vertices they go, which sheets meet there.

References:
    Lu, Bates, Sommese & Wampler, Finding all real points of a complex curve, 2007;
    Besana, Di Rocco, Hauenstein, Sommese & Wampler, Cell decomposition of almost smooth real
    algebraic surfaces, 2013.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_type
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError, NagError
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.real.arc_tracing import TracingError
from nag.real.arcs import ROUNDED_AWAY, Skeleton, connect, find_arcs, join_arcs
from nag.real.closure import ProjectiveClosure, turns_of
from nag.real.critical_points import can_be_tracked, find_critical_points
from nag.real.critical_values import (
    ONE_VALUE,
    UnclearDigitsError,
    determinant_degree,
    discriminant_degree,
    discriminant_values,
    real_zeros,
)
from nag.real.curve import PictureVerdict, RealCurve, RealEdge, Turn, chart_of
from nag.real.fibre_table import (
    MORE_SAMPLES,
    CircleOfFibres,
    FibreError,
    FibresOverValues,
    FibreTable,
    fibre_table,
    sample_circle,
)
from nag.real.real_fibres import SpecialFibre, infinite_fibre, real_fibre, special_fibre
from nag.real.tracked_fibres import TrackedFibres, ordinary_fibre, special_fibres_of
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.fibres import Fibre
from nag.witness.witness import WitnessSet

# Tries by paths where these are less work; digits of fibres, tried in turn after that where they do
# not decide; and linear forms in all.
BY_PATHS, DIGITS, ATTEMPTS = 2, (120, 250, 500), 5
# Points of fibres up to which both methods of finding critical values run, and check each other.
MOST_CHECKED = 600
# Points of fibres beyond which paths to critical points are less work: with 33 of a plane cubic
# both take the same time, with 68 of a quartic in space paths two thirds, with 210 of a four-bar
# half.
MOST_SAMPLED = 40
# Paths to critical points at most.
MOST_PATHS = 20_000
# Points of fibres in all at most.
MOST_POINTS = 40_000
# The circle's radius, at least.
LEAST_RADIUS = 1e-3


class RealCurveError(ComponentError):
    """A component whose real curve is not found, with the reason."""


class NotReducedError(RealCurveError):
    """A component of which its equations are singular at all points."""


@takes_run
def find_real_curve(component: WitnessSet, *, run: Run = DEFAULT_RUN) -> RealCurve:
    """The complete real part of a one-dimensional component.

    Args:
        component: one of the components of a `nag.Decomposition`. Where coefficients are complex,
            the curve is one in the variables without the imaginary unit.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        Vertices, edges and pieces; undecided, with the reason, where a check failed.

    Raises:
        RealCurveError: if the component's equations stay singular along it, or its degree is too
            large.
        NagError: if the component is no curve.

    >>> import nag
    >>> lemniscate = nag.decompose("(x^2 + y^2)^2 = 2*(x^2 - y^2)").components[0]
    >>> curve = nag.find_real_curve(lemniscate)
    >>> str(curve.verdict), len(curve.edges), [str(vertex.kind) for vertex in curve.vertices]
    ('complete', 2, ['singular'])
    """
    check_type(component, WitnessSet, "component", "one of the components of a nag.Decomposition")
    if component.dimension != 1:
        raise NagError(f"component: it has dimension {component.dimension}; a curve has 1")
    given = component._known_system()
    given.check_real_coordinates()
    if given.imaginary:
        return _of_complex_equations(component, run)
    natural = coordinates_of(given)
    system = natural.system(given)
    component = carry_component(component, natural, system)
    fibres = component_fibres(system, component)
    equations = _equations(system, component, fibres)
    curve = _Projected(system, component, fibres, equations, turns_of(system), run)
    by_paths = curve.has_few_paths and curve.is_real(run.random(Stream.REAL_CURVE, ATTEMPTS))
    reason, level = "", 0 if by_paths else BY_PATHS
    for attempt in range(ATTEMPTS):
        rng = run.random(Stream.REAL_CURVE, attempt)
        try:
            digits = None if level < BY_PATHS else DIGITS[level - BY_PATHS]
            return _in_given_coordinates(curve.find(digits, rng), given, natural)
        except TracingError as error:
            # Another form has other folds, that need not be as near to what is singular.
            reason = reason or str(error)
            level += level < BY_PATHS and not curve.has_many_points
        except (UnclearDigitsError, FibreError) as error:
            reason, level = reason or str(error), level + 1
            if level == BY_PATHS + len(DIGITS) or (level == BY_PATHS and curve.has_many_points):
                break
            # What stopped paths says nothing of digits.
            reason = "" if level == BY_PATHS else reason
    return undecided_curve(given, reason)


def undecided_curve(system: PolynomialSystem, reason: str) -> RealCurve:
    """What is said of a curve of which nothing real is known, for a reason."""
    turns = turns_of(system)
    return RealCurve(system.variables, turns, (), (), (), PictureVerdict.UNDECIDED, reason)


def _of_complex_equations(component: WitnessSet, run: Run) -> RealCurve:
    # Few equations are complex, and what takes them apart takes a tenth of a second to load.
    from nag.real.real_equations import curve_of_real_points, find_real_equations

    equations = find_real_equations(component, run)
    if equations.inside and equations.inside[0].dimension:
        return find_real_curve(equations.inside[0], run=run)
    return curve_of_real_points(equations)


def _equations(
    system: PolynomialSystem, component: WitnessSet, fibres: Sequence[Fibre]
) -> tuple[Polynomial, ...]:
    """Equations whose Jacobian has full rank at general points of the curve."""
    if component.corank == 1:
        return system.polynomials
    if len(fibres) == 1 and not fibres[0].cut.aux:
        return fibres[0].cut.polynomials
    raise NotReducedError(
        "the component is not reduced: its equations are singular at all of its points, and only "
        "with unknowns added they are not; if you gave the equations, give some of which it is a "
        "simple zero set"
    )


@dataclass(frozen=True, eq=False)
class _Projected:
    """A curve whose real part is looked for by its fibres over the values of a linear form.

    Attributes:
        equations: of full rank at general points of the curve.
        turns: variables of which infinity is an ordinary value.
    """

    system: PolynomialSystem
    component: WitnessSet
    fibres: Sequence[Fibre]
    equations: Sequence[Polynomial]
    turns: Sequence[Turn]
    run: Run

    @cached_property
    def square(self) -> tuple[Polynomial, ...]:
        """One equation fewer than variables, regular at general points of the curve; or none."""
        return _square_equations(self.equations, self.fibres)

    @cached_property
    def multidegree(self) -> list[int]:
        """How many points of the curve have a group of variables fixed, or on a slice."""
        groups, d = self.system.groups, self.component.degree
        # Component by component of a product of spaces; in one space it is the degree.
        if self.component.multidegree is None:
            return [d] * max(1, len(groups))
        own = self.component.multidegree.tolist()
        return own if len(groups) in (0, len(own)) else [d] * len(groups)

    @cached_property
    def degrees(self) -> tuple[int, int | None]:
        """Degrees in the value of products of differences over a fibre, and of determinants."""
        discriminant = discriminant_degree(self.component.degree, True)
        if not self.square:
            return discriminant, None
        groups = self.system.groups
        return discriminant, determinant_degree(self.square, groups, self.multidegree)

    @property
    def sampled_values(self) -> int:
        """Number of fibres that tell the critical values in many digits.

        As many as the smaller of both degrees needs, or the larger, where these are few.
        """
        d, known = self.component.degree, [b for b in self.degrees if b is not None]
        wanted = max(known) if max(known) * d <= MOST_CHECKED else min(known)
        return max(wanted, d + 1) + 1 + MORE_SAMPLES

    @property
    def sampled_points(self) -> int:
        """Number of points of these fibres."""
        return self.sampled_values * self.component.degree

    @property
    def has_many_points(self) -> bool:
        """Whether there are more of these than time is for."""
        return self.sampled_points > MOST_POINTS

    @cached_property
    def groups(self) -> Sequence[Sequence[int]]:
        """The groups by which a determinant has fewer zeros than by its degree, or none."""
        alone = determinant_degree(self.square, (), [self.component.degree])
        return self.system.groups if self.degrees[1] != alone else ()

    @property
    def has_few_paths(self) -> bool:
        """Whether paths to critical points are less work than fibres in many digits."""
        paths = self.degrees[1]
        if paths is None or not self.sampled_points > MOST_SAMPLED or paths > MOST_PATHS:
            return False
        return can_be_tracked(self.square, self.groups)

    def _random_form(self, rng: np.random.Generator) -> tuple[np.ndarray, float]:
        """A linear form, and the size of its values."""
        n = self.system.n
        form = rng.integers(64, 128, n) * rng.choice([-1, 1], n) / 128
        sizes = np.abs(np.vstack([fibre.x for fibre in self.fibres]) @ form)
        return form, float(np.ldexp(1.0, int(np.ceil(np.log2(max(LEAST_RADIUS, sizes.max()))))))

    def is_real(self, rng: np.random.Generator) -> bool:
        """Whether the curve is its own conjugate, or that is not known."""
        form, radius = self._random_form(rng)
        value = (0.5 + float(rng.integers(-64, 64))) / 64 * radius
        try:
            tracked = TrackedFibres.of(
                self.fibres, self.square, self.system, form, radius, rng, self.run
            )
            return tracked.is_real(value)
        except FibreError:
            return True

    def find(self, digits: int | None, rng: np.random.Generator) -> RealCurve:
        """The real curve by a random form, from fibres in so many digits, or by paths if None.

        Raises:
            TracingError, UnclearDigitsError, FibreError: if something is not certain.
            RealCurveError: if there are too many fibres.
        """
        system, component = self.system, self.component
        form, radius = self._random_form(rng)
        closure = ProjectiveClosure.of(self.equations, system, form)
        table, specials, crossed = (
            self._by_paths(closure, form, radius, rng)
            if digits is None
            else self._in_digits(closure, form, radius, digits, rng)
        )
        arcs = find_arcs(table, closure, specials, radius, crossed)
        skeleton = join_arcs(closure, specials, arcs, self.turns)
        # Of a factor of an equation the determinants say nothing of the other ones.
        whole = set(self.square) <= set(system.polynomials)
        doubt = skeleton.doubt or _too_many_pieces(skeleton, component.degree)
        residual = _residual(system, skeleton)
        return RealCurve(
            system.variables,
            tuple(self.turns),
            skeleton.vertices,
            skeleton.edges,
            skeleton.pieces,
            PictureVerdict.UNDECIDED if doubt else PictureVerdict.COMPLETE,
            doubt,
            tuple(float(s.pencil[0]) for s in specials[:-1]),
            residual,
            closure.affine(crossed) if crossed is not None and whole else None,
        )

    def _by_paths(
        self,
        closure: ProjectiveClosure,
        form: np.ndarray,
        radius: float,
        rng: np.random.Generator,
    ) -> _Specials:
        """Special fibres, last that over infinity, by paths to critical points.

        Raises:
            FibreError: if paths fail.
        """
        square, run = self.square, self.run
        tracked = TrackedFibres.of(self.fibres, square, self.system, form, radius, rng, run)
        critical = find_critical_points(self.fibres, square, self.groups, form, rng, run)
        every = special_fibres_of(tracked, closure, critical)
        specials = [fibre for fibre in every if fibre.singular]
        if not specials:
            value = float(_some_value(rng)) * radius
            specials = [ordinary_fibre(tracked, closure, value)]
        beyond = _over_infinity(tracked, closure, tracked.over_infinity, specials)
        return tracked, [*specials, beyond], _find_crossings(closure, every)

    def _in_digits(
        self,
        closure: ProjectiveClosure,
        form: np.ndarray,
        radius: float,
        digits: int,
        rng: np.random.Generator,
    ) -> _Specials:
        """The same from fibres over a circle in so many digits.

        Raises:
            UnclearDigitsError, FibreError: if more digits are needed.
            RealCurveError: if there are too many fibres.
        """
        circle, degrees = self._sample(form, radius, digits, rng)
        table = fibre_table(circle, rng)
        alike = max(self.multidegree) if self.component.multidegree is not None else 1
        specials, crossed = _special_fibres(circle, degrees, table, closure, alike, rng)
        return table, specials, crossed

    def _sample(
        self, form: np.ndarray, radius: float, digits: int, rng: np.random.Generator
    ) -> tuple[CircleOfFibres, tuple[int, int | None]]:
        """Fibres over a circle, with the degrees of products of differences and of determinants."""
        d, fibres, run = self.component.degree, self.fibres, self.run
        if self.has_many_points:
            raise RealCurveError(
                f"the curve has degree {d}: critical values would take {self.sampled_points} "
                f"points of fibres, and {MOST_POINTS} are taken at most"
            )
        count = self.sampled_values
        circle = sample_circle(fibres, form, radius, count, digits, rng, run, self.square)
        if circle.real:
            return circle, self.degrees
        other = discriminant_degree(d, False)
        needed = max(other, 2 * d + 1) + 1 + MORE_SAMPLES
        if needed > count:
            circle = sample_circle(fibres, form, radius, needed, digits, rng, run)
        return circle, (other, None)


_Specials = tuple[FibresOverValues, list[SpecialFibre], np.ndarray | None]


def _some_value(rng: np.random.Generator) -> Fraction:
    """A value that is not special, in radii: any serves to cut loops that pass infinity."""
    return Fraction(int(rng.integers(-32, 32)), 128)


def _square_equations(
    equations: Sequence[Polynomial], fibres: Sequence[Fibre]
) -> tuple[Polynomial, ...]:
    """One equation fewer than variables, regular at general points of the curve; or none."""
    if len(equations) == fibres[0].cut.n - 1:
        return tuple(equations)
    alone = len(fibres) == 1 and not fibres[0].cut.aux
    return fibres[0].cut.polynomials if alone else ()


def _special_fibres(
    circle: CircleOfFibres,
    degrees: tuple[int, int | None],
    table: FibreTable,
    closure: ProjectiveClosure,
    alike: int,
    rng: np.random.Generator,
) -> tuple[list[SpecialFibre], np.ndarray | None]:
    """The fibres over values at which real points meet, ascending, and last that over infinity.

    Also the smooth real points at which the equations are singular, where they are known.

    Raises:
        UnclearDigitsError: if the two methods disagree.
    """
    enough = circle.count - MORE_SAMPLES
    found: list[list[SpecialFibre]] = []
    crossed: np.ndarray | None = None
    discriminant, determinant = degrees
    if discriminant < enough:
        zeros = real_zeros(circle, discriminant_values(circle, rng), discriminant)
        fibres = [special_fibre(table, closure, zero.value) for zero in zeros]
        found.append([fibre for fibre in fibres if fibre.singular])
    if determinant is not None and determinant < enough and circle.determinants is not None:
        zeros = real_zeros(circle, circle.determinants, determinant)
        fibres = [special_fibre(table, closure, zero.value) for zero in zeros]
        found.append([fibre for fibre in fibres if fibre.singular])
        crossed = _find_crossings(closure, fibres)
    if len(found) == 2:
        one, other = ([s.pencil[0] for s in each] for each in found)
        near = ONE_VALUE * circle.radius
        if len(one) != len(other) or not np.allclose(one, other, rtol=0, atol=near):
            raise UnclearDigitsError("two methods find different critical values")
    specials = found[0]
    if not specials:
        specials = [special_fibre(table, closure, flint.arb(float(_some_value(rng))))]
    infinite = partial(infinite_fibre, table, closure, alike)
    return [*specials, _over_infinity(table, closure, infinite, specials)], crossed


def _find_crossings(closure: ProjectiveClosure, fibres: Sequence[SpecialFibre]) -> np.ndarray:
    """Smooth real points at which the equations are singular, shape ``(k, size)``."""
    points = [
        fibre.points[i].real
        for fibre in fibres
        for i in np.flatnonzero(fibre.real & (fibre.sheets == 1))
    ]
    kept = [
        x for x in points if closure.corank_gap(x) < ROUNDED_AWAY and not closure.is_infinite(x)
    ]
    return np.array(kept).reshape(-1, closure.size)


def _over_infinity(
    table: FibresOverValues,
    closure: ProjectiveClosure,
    infinite: Callable[[], SpecialFibre],
    specials: Sequence[SpecialFibre],
) -> SpecialFibre:
    """The fibre over infinity; empty where no real arc goes there."""
    first, last = specials[0].pencil[0], specials[-1].pencil[0]
    beyond = (first - table.radius, last + table.radius)
    if not any(real_fibre(table, closure, np.array([t, 1.0]))[1].any() for t in beyond):
        nothing = np.zeros((0, closure.size), dtype=complex)
        none = np.zeros(0, dtype=int)
        return SpecialFibre(np.array([1.0, 0.0]), nothing, none, none.astype(bool))
    return infinite()


def _too_many_pieces(skeleton: Skeleton, degree: int) -> str:
    """Harnack's bound: no more pieces than the largest genus of a curve of the degree, and one.

    Arcs that meet at infinity are one piece of the closure.
    """
    loops = sum(edge.closed for edge in skeleton.edges)
    ends = [(e.start, e.end) for e in skeleton.edges if e.start is not None and e.end is not None]
    meeting = {v for pair in ends for v in pair}
    pieces = loops + len({root for v, root in connect(ends).items() if v in meeting})
    most = (degree - 1) * (degree - 2) // 2 + 1
    if pieces > most:
        return f"{pieces} pieces were found where a curve of degree {degree} has {most} at most"
    return ""


def _residual(system: PolynomialSystem, skeleton: Skeleton) -> float:
    evaluator = Evaluator.of(system.polynomials, system.n)
    worst = [float(evaluator.residuals(e.points + 0j).max(initial=0.0)) for e in skeleton.edges]
    return max(worst, default=0.0)


def _in_given_coordinates(
    found: RealCurve, system: PolynomialSystem, natural: NaturalCoordinates
) -> RealCurve:
    if natural.is_identity:
        return found
    back = natural.inverse
    turns = turns_of(system)
    vertices = tuple(replace(v, point=back.points(v.point)) for v in found.vertices)
    meetings = None if found.meetings is None else back.points(found.meetings)
    edges = []
    for edge in found.edges:
        points = back.points(edge.points)
        edges.append(RealEdge(edge.start, edge.end, points, chart_of(points, turns)))
    return replace(found, turns=turns, vertices=vertices, edges=tuple(edges), meetings=meetings)
