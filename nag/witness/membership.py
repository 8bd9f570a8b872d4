"""Membership of a point in the sets that fibres stand for, by moving the slice through it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.from_python import coordinates
from nag.algebra.given import check_error
from nag.algebra.number import Number, is_zero, number_text
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.coincidence import BEYOND, MISS, SPREAD, classify_arrivals
from nag.numerics.digits import BITS, bits_of, doubles, in_bits, to_ball
from nag.numerics.doubles import ROUNDED
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.numerics.newton import newton_step
from nag.numerics.read_only import Several, equal_values
from nag.numerics.singular_point import Place, analyse
from nag.numerics.zero_values import LEAST, NONZERO, ON
from nag.text.table import data_frame, lines_of, one_line
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_decomposition, coordinates_of
from nag.witness.close_points import BASIN, DIGITS, PointInWords, distance, with_newton_constant
from nag.witness.component_equations import component_fibres, component_system
from nag.witness.cutting import Cut
from nag.witness.exact_points import exact_zeros
from nag.witness.fibres import Fibre, SliceEnds, join_fibres, move_through
from nag.witness.gauss_newton import polish
from nag.witness.given_component import check_decomposition, in_doubles, round_point
from nag.witness.slices import pad_rows
from nag.witness.witness import Decomposition, PathCounts, WitnessSet

if TYPE_CHECKING:
    import pandas


class Membership(Enum):
    """The answer of a membership test."""

    MEMBER = "member"
    FOREIGN = "foreign"
    UNDECIDED = "undecided"


@dataclass(frozen=True, eq=False)
class PointMembership(Several[WitnessSet]):
    """Which components of a decomposition a point lies on.

    Attributes:
        point: exact where all coordinates are real.
        exact: whether it is exact and satisfies the equations exactly.
        residual: largest relative residual of the equations there.
        components: all of them, none for a whole orbit.
        answers: one for each.
        variables: names of the coordinates, that of an imaginary unit last; they are not compared.
    """

    point: tuple[Number | complex, ...]
    exact: bool
    residual: float
    components: tuple[WitnessSet, ...]
    answers: tuple[Membership, ...]
    variables: tuple[str, ...] = field(default=(), compare=False)

    __eq__ = equal_values

    __repr__ = one_line

    def __str__(self) -> str:
        on = [str(i) for i in self.numbers]
        text = f"on component{'s' * (len(on) > 1)} {', '.join(on)}" if on else "on no component"
        if self.open:
            text += f"; not known for {', '.join(map(str, self.open))}"
        point = ", ".join(map(number_text, self.point))
        return lines_of("PointMembership", [("answer", text), ("point", f"({point})")])

    @property
    def entries(self) -> tuple[WitnessSet, ...]:
        """The components that it lies on."""
        return self.on

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each component: its number, dimension, degree, and whether it is on it.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(
            {
                "number": list(range(1, len(self.components) + 1)),
                "dimension": [c.dimension for c in self.components],
                "degree": [c.degree for c in self.components],
                "answer": [answer.value for answer in self.answers],
            }
        )

    @property
    def on(self) -> tuple[WitnessSet, ...]:
        """The components that it lies on."""
        pairs = zip(self.components, self.answers, strict=True)
        return tuple(c for c, answer in pairs if answer is Membership.MEMBER)

    @property
    def numbers(self) -> tuple[int, ...]:
        """Numbers, from 1, of the components that it lies on."""
        return tuple(i for i, a in enumerate(self.answers, 1) if a is Membership.MEMBER)

    @property
    def open(self) -> tuple[int, ...]:
        """Numbers, from 1, of the components for which that is not decided."""
        return tuple(i for i, a in enumerate(self.answers, 1) if a is Membership.UNDECIDED)

    @property
    def complete(self) -> bool:
        """Whether all is decided, and a zero of the equations lies on a component."""
        return not self.open and (bool(self.on) or not self.exact)

    def rows(self) -> list[list[str]]:
        """Headings, and one row for each component; none where there are none."""
        rows = [["component", "dimension", "degree", "multiplicity", "point"]]
        for i, (c, answer) in enumerate(zip(self.components, self.answers, strict=True), 1):
            said = {Membership.MEMBER: "on it", Membership.FOREIGN: "not on it"}.get(answer, "?")
            multiplicity = str(c.multiplicity or "?")
            rows.append([str(i), str(c.dimension), str(c.degree), multiplicity, said])
        return rows if self.components else []

    def document(self) -> dict[str, Any]:
        """The answer as a JSON object, without its head."""
        pairs = zip(self.components, self.answers, strict=True)
        return {
            "point": [number_text(x) for x in self.point],
            "exact": self.exact,
            "residual": self.residual,
            "components": [
                component.facts(i) | {"answer": answer.value}
                for i, (component, answer) in enumerate(pairs, 1)
            ],
        }


@np.errstate(over="ignore", invalid="ignore")
def is_member(
    point: np.ndarray,
    accuracy: float,
    fibres: Sequence[Fibre],
    rng: np.random.Generator,
    run: Run,
    given: Sequence[Number] | None = None,
) -> tuple[Membership, PathCounts]:
    """Whether an affine point lies in the closure of the set that ``fibres`` stand for.

    ``fibres`` lie on one slice. It moves to a generic one through the point; the point is a member
    exactly when a path ends there (Sommese, Verschelde & Wampler 2001).

    Args:
        given: of a point that was asked about, its exact coordinates, none if they are not known;
            ``accuracy`` is a bound of its relative error. A regular end that is further from the
            point than this and its own error explain is another one then. None of a point that
            paths led to.
    """
    ((answer, _),), counts = find_members(point, accuracy, [fibres], rng, run, given)
    return answer, counts


def is_on_larger_set(
    point: np.ndarray,
    accuracy: float,
    sets: Mapping[int, Sequence[Fibre]],
    dimension: int,
    rng: np.random.Generator,
    run: Run,
) -> tuple[Membership, PathCounts]:
    """Whether a point lies on one of some sets, by dimension, of more than its own one."""
    higher = sorted((d for d in sets if d > dimension), reverse=True)
    return is_on_one_of(point, accuracy, [sets[d] for d in higher], rng, run)


def is_on_one_of(
    point: np.ndarray,
    accuracy: float,
    sets: Iterable[Sequence[Fibre]],
    rng: np.random.Generator,
    run: Run,
) -> tuple[Membership, PathCounts]:
    """Whether a point lies on one of some sets at least; the first is asked that it is on."""
    whole, counts = Membership.FOREIGN, PathCounts()
    for fibres in sets:
        answer, spent = is_member(point, accuracy, fibres, rng, run)
        counts += spent
        if answer is Membership.MEMBER:
            return answer, counts
        if answer is Membership.UNDECIDED:
            whole = answer
    return whole, counts


@np.errstate(over="ignore", invalid="ignore")
def find_members(
    point: np.ndarray,
    accuracy: float,
    sets: Sequence[Sequence[Fibre]],
    rng: np.random.Generator,
    run: Run,
    given: Sequence[Number] | None = None,
) -> tuple[list[tuple[Membership, bool]], PathCounts]:
    """`is_member` for several sets of one dimension on one slice, which moves once.

    Sets that the same equations cut may come near to each other where the slice moves to. Their
    paths are tracked together, so that two that end at one point are known to have gone astray.

    Returns:
        With each answer whether it is undecided only because an end of another set is as near to
        the point: it is on one of the two sets, or on both where they meet.
    """
    counts, bounded = PathCounts(), given is not None
    together = _join_by_cut(sets)
    answers: list[set[Membership | None]] = [{Membership.FOREIGN} for _ in sets]
    if not together:
        return [(Membership.FOREIGN, False) for _ in sets], counts
    moves = move_through(point, [fibre for fibre, _ in together], rng, run, given or ())
    for ends, (_, owners) in zip(moves, together, strict=True):
        counts += ends.counts.judged_elsewhere
        if bounded:
            ends = _near_ones_rated(point, accuracy, ends)
        for k in np.unique(owners).tolist():
            answers[k].add(_among_ends(point, accuracy, ends, owners == k, bounded))
    order = Membership.MEMBER, Membership.UNDECIDED, None, Membership.FOREIGN
    words = [next(word for word in order if word in found) for found in answers]
    return [(word or Membership.UNDECIDED, word is None) for word in words], counts


def _join_by_cut(sets: Sequence[Sequence[Fibre]]) -> list[tuple[Fibre, np.ndarray]]:
    """The fibres of all sets, those of one cut as one, with the set that each point is of."""
    parts: dict[tuple[object, ...], list[tuple[int, Fibre]]] = {}
    for k, fibres in enumerate(sets):
        for fibre in fibres:
            if len(fibre):
                key = (fibre.cut.polynomials, fibre.cut.n)
                parts.setdefault(key, []).append((k, fibre))
    return [
        (
            join_fibres([fibre for _, fibre in several]),
            np.repeat([k for k, _ in several], [len(fibre) for _, fibre in several]),
        )
        for several in parts.values()
    ]


def _among_ends(
    point: np.ndarray, accuracy: float, ends: SliceEnds, own: np.ndarray, bounded: bool
) -> Membership | None:
    """Whether a point is one of a set's ``own`` ends, on a slice through it.

    None where it is one of them or one of another set.
    """
    answers = set[Membership | None]()
    fine = [i for i in ends.fine if own[i]]
    if fine:
        error = accuracy * (1 + float(np.linalg.norm(point)))
        answers = {_at_end(point, error, ends, own, i, bounded) for i in fine}
    ends = ends.without({*fine, *np.flatnonzero(~own).tolist()})
    distances = _distances(point, ends, ends.cut.sizes[1:])[ends.finite]
    if Membership.MEMBER in answers or classify_arrivals(distances, accuracy)[0].any():
        return Membership.MEMBER
    errors = np.maximum(accuracy, ends.accuracy[ends.finite])
    unclear = ends.failed.any() or np.any(classify_arrivals(distances, errors))
    if unclear or Membership.UNDECIDED in answers:
        return Membership.UNDECIDED
    return None if None in answers else Membership.FOREIGN


def _distances(point: np.ndarray, ends: SliceEnds, sizes: np.ndarray) -> np.ndarray:
    """Of the ends from a point, relative to its size; infinite for those that are none.

    Paths are tracked, and slices rounded, where the coordinates are divided by their ``sizes``.
    """
    distances = np.full(len(ends), np.inf)
    off = (ends.x[ends.finite] - point) / sizes
    distances[ends.finite] = np.linalg.norm(off, axis=1) / (1 + np.linalg.norm(point / sizes))
    return distances


def _near_ones_rated(point: np.ndarray, accuracy: float, ends: SliceEnds) -> SliceEnds:
    """The ends with Newton's constant of those that are near to a point, and not at it."""
    same, doubtful = classify_arrivals(_distances(point, ends, ends.cut.sizes[1:]), accuracy)
    # Where sizes are unequal, what is little beside the largest may be much for the point.
    away = _distances(point, ends, np.ones(len(point))) > np.maximum(accuracy, ends.accuracy)
    near = ends.regular & (same | doubtful) & away
    fine = dict(ends.fine)
    for i in set(np.flatnonzero(near).tolist()) - fine.keys():
        fine[i] = with_newton_constant(
            ends.cut.polynomials, ends.rows, PointInWords.of_doubles(ends.points[i])
        )
    return replace(ends, fine=fine)


def _at_end(
    point: np.ndarray,
    error: float,
    ends: SliceEnds,
    own: np.ndarray,
    i: int,
    bounded: bool,
) -> Membership | None:
    """Whether a point that is off by so much may be an end to which other zeros are close.

    Undecided where the next zero is no further away than what the point is off by can make out,
    unless that is one of the ``own`` ends as well: then the point is on the set at one or the
    other. None if it is an end of another set.
    """
    end, cut, x = ends.fine[i], ends.cut, ends.x
    # The slice through a point beside the set meets it so much further off at most.
    if bounded:
        error = max(error, float(ends.accuracy[i]) * (1 + float(np.linalg.norm(point))))
    reach = SPREAD * error / _angle(cut, ends.rows, end)
    gap = float(np.linalg.norm(x[i] - point))
    if gap > reach:
        return Membership.FOREIGN
    apart = (1 + float(np.linalg.norm(point))) / end.curvature
    beside = _distance_of_set(cut, point) if bounded else np.inf
    if max(gap, beside) < BASIN * apart:
        # The sheet on which the end is is the one beside the point.
        return Membership.MEMBER if beside <= SPREAD * error else Membership.FOREIGN
    if apart > SPREAD * reach:
        return Membership.MEMBER
    beside_end = set[bool]()
    for j in np.flatnonzero(ends.finite).tolist():
        other = ends.fine.get(j) or (
            None if ends.regular[j] else PointInWords.of_doubles(ends.points[j])
        )
        if j != i and other and distance(x[i], end, x[j], other) < SPREAD * apart:
            beside_end.add(bool(own[j]))
    if True in beside_end:
        return Membership.MEMBER
    return None if beside_end else Membership.UNDECIDED


def _distance_of_set(cut: Cut, point: np.ndarray) -> float:
    """How far the set beside a point is, by Newton's method; infinite if that is unknown."""
    if cut.aux or not cut.polynomials:
        return np.inf
    x = [flint.acb(complex(v)) for v in point]
    step = newton_step(BallPolynomials.of(cut.polynomials), x, bits_of(2 * DIGITS))
    return np.inf if step is None else float(np.linalg.norm(doubles(step)))


def _angle(cut: Cut, rows: np.ndarray, end: PointInWords) -> float:
    """The least singular value of the gradients and the slice, all of length one."""
    exact = BallPolynomials.of(cut.polynomials, pad_rows(rows, 1 + len(end.words)))
    bits = bits_of(2 * DIGITS)
    with in_bits(bits):
        slopes = exact.jacobian(end.balls(), bits)
        lengths = [
            sum((abs(slopes[i, j]) ** 2 for j in range(slopes.ncols())), flint.arb(0)).sqrt()
            for i in range(slopes.nrows())
        ]
        unit = [
            [complex((slopes[i, j] / lengths[i]).mid()) for j in range(slopes.ncols())]
            for i in range(slopes.nrows())
        ]
    return max(float(np.linalg.svd(np.array(unit), compute_uv=False)[-1]), 1e-300)


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def memberships(
    decomposition: Decomposition,
    point: np.ndarray,
    *,
    accuracy: float = 1e-12,
    exact: Sequence[Number] = (),
    run: Run = DEFAULT_RUN,
) -> tuple[Membership, ...]:
    """For each component, whether an affine point lies on it.

    The slice moves through the point, which is on the component exactly if a path ends there
    (Sommese, Verschelde & Wampler 2001).

    Args:
        decomposition: as `nag.decompose` returns it.
        point: complex, shape ``(n,)``, in the system's variables.
        accuracy: bound of the relative error of the point.
        exact: the exact coordinates that ``point`` is rounded from, if they are known: then a
            component on which an equation holds that does not hold there is told from the others
            however near it is.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.witness.membership import memberships
    >>> [str(found.value) for found in memberships(nag.decompose("x*(y - 1)"), [0, 2])]
    ['member', 'foreign']
    """
    check_decomposition(decomposition)
    check_error(accuracy, "accuracy")
    rng = run.random(Stream.MEMBERSHIP)
    system = decomposition.system
    point = in_doubles(point, system.variables)
    if Evaluator.of(system.polynomials, system.n).residuals(point[None]).max(initial=0.0) > NONZERO:
        return (Membership.FOREIGN,) * len(decomposition.components)
    asked = _Asked.of(point, accuracy, exact, coordinates_of(system).without_scales)
    whole = carry_decomposition(decomposition, asked.natural)
    answers, shared = _by_components(whole, asked, rng, run)
    nowhere = all(answer is Membership.FOREIGN for answer in answers)
    if nowhere and not exact and _surely_on_one(decomposition, point, accuracy):
        return (Membership.UNDECIDED,) * len(answers)
    on = [k for k, answer in enumerate(answers) if answer is Membership.MEMBER or shared[k]]
    if len(on) > 1 and not exact:
        told = not any(shared[k] for k in on)
        meet = _meet_near(decomposition, on, point, accuracy, told)
        answer = Membership.MEMBER if meet else Membership.UNDECIDED
        return tuple(answer if k in on else a for k, a in enumerate(answers))
    return answers


def locate_point(
    decomposition: Decomposition, point: Sequence[Number | complex], *, run: Run
) -> PointMembership:
    """Which components of a decomposition a point lies on.

    One that satisfies the equations to `ON` only is taken for a rounded one, and so is a complex
    one.

    Args:
        decomposition: with every component of each orbit.
        point: in the system's variables; exact where all coordinates are real.
        run: how it is worked out.
    """
    system, components = decomposition.system, decomposition.components
    known = [x for x in point if not isinstance(x, complex)]
    exact = len(known) == len(point) and all(is_zero(value) for value in system(known))
    at = round_point(point)
    evaluator = Evaluator.of(system.polynomials, system.n)
    residual = float(evaluator.residuals(at[None]).max(initial=0.0))
    answers = (Membership.FOREIGN,) * len(components)
    if exact or residual < ON:
        answers = memberships(
            decomposition,
            at,
            accuracy=ROUNDED if exact else max(LEAST, 10 * residual),
            exact=known if exact else (),
            run=run,
        )
    return PointMembership(
        tuple(point), exact, residual, components, answers, variables=system.variables
    )


def _meet_near(
    decomposition: Decomposition,
    on: Sequence[int],
    point: np.ndarray,
    accuracy: float,
    told: bool,
) -> bool:
    """Whether components are seen to have a common point within the error of a rounded one.

    Without such a point it is rounded from one of a single component, and it is not known which.
    Of components that one branch of the equations holds nothing is said against it, if paths
    ``told`` that the point is on each; else they meet in a point where the branch is not smooth.
    """
    system, components = decomposition.system, decomposition.components
    parts = dict.fromkeys(component_system(system, components[k]).polynomials for k in on)
    if len(parts) == 1 and told:
        return True
    together = tuple(dict.fromkeys(f for part in parts for f in part))
    error = SPREAD * accuracy
    zero = analyse(together, point, error, np.random.default_rng(0), place_only=True)
    return zero.place is not Place.UNDECIDED and not (len(parts) == 1 and zero.beside is not None)


@dataclass(frozen=True, eq=False)
class _Asked:
    """A point that is asked about, in coordinates about a natural origin.

    Attributes:
        exact: its coordinates, none where only doubles are known.
        error: relative error of the point in doubles as it was given.
    """

    natural: NaturalCoordinates
    point: np.ndarray
    exact: Sequence[Number]
    error: float

    @classmethod
    def of(
        cls, x: np.ndarray, error: float, exact: Sequence[Number], natural: NaturalCoordinates
    ) -> _Asked:
        there = natural.numbers(exact) if len(exact) else ()
        point = natural.points(x) if natural.is_identity or not there else round_point(there)
        return cls(natural, point, there, error)

    def accuracy(self, sizes: np.ndarray | float = 1.0) -> float:
        """The point's error, relative to its size where coordinates are divided by ``sizes``.

        That of doubles is one beside the origin that was taken off as well.
        """
        if len(self.exact):
            return self.error
        far = np.array([float(b) for b in self.natural.origin])
        far, near = (float(np.linalg.norm(z / sizes)) for z in (far, self.point))
        return self.error * (1 + far / (1 + near))

    def may_be_on(self, cut: Cut) -> bool:
        """Whether the exact equations of a cut in the system's variables may hold at the point.

        At one in doubles they do not if they hold nowhere so near to it as ends of paths would have
        to be for a doubt.
        """
        plain = [f for f in cut.polynomials if f.algebraic and max(f.support, default=0) < cut.n]
        if len(self.exact):
            return all(is_zero(f((*self.exact, *[Fraction(0)] * cut.aux))) for f in plain)
        if not plain:
            return True
        off = max(MISS, BEYOND * self.accuracy()) * (1 + float(np.linalg.norm(self.point)))
        near = [flint.acb(flint.arb(z.real, off), flint.arb(z.imag, off)) for z in self.point]
        near += [flint.acb(0)] * cut.aux
        values = BallPolynomials.of(plain).values(near, bits_of(DIGITS)).entries()
        return all(value.contains(0) for value in values)


def _by_components(
    decomposition: Decomposition, asked: _Asked, rng: np.random.Generator, run: Run
) -> tuple[tuple[Membership, ...], tuple[bool, ...]]:
    """For each component by itself, whether a point lies on it, or on another as near to it."""
    system, components = decomposition.system, decomposition.components
    point, exact = asked.point, asked.exact
    answers: dict[int, tuple[Membership, bool]] = {}
    moving: dict[tuple[object, bytes], dict[int, list[Fibre]]] = {}
    for k, component in enumerate(components):
        # Equations that would be found anew may be those of another set beside it.
        if not all(asked.may_be_on(fibre.cut) for fibre in component.fibres):
            answers[k] = Membership.FOREIGN, False
        elif component.dimension == 0:
            found = _at_isolated(system, component, point, asked.accuracy(), exact)
            answers[k] = found, False
        else:
            try:
                fibres = component_fibres(system, component)
            except ValueError:
                answers[k] = Membership.UNDECIDED, False
                continue
            rows = component.slice.rows
            moving.setdefault((rows.shape, rows.tobytes()), {})[k] = fibres
    for several in moving.values():
        sets = list(several.values())
        accuracy = asked.accuracy(sets[0][0].sizes[1:])
        each, _ = find_members(point, accuracy, sets, rng, run, exact)
        answers |= zip(several, each, strict=True)
    if not answers:
        return (), ()
    words, shared = zip(*(answers[k] for k in range(len(components))), strict=True)
    return words, shared


def _surely_on_one(decomposition: Decomposition, point: np.ndarray, accuracy: float) -> bool:
    """Whether a zero within the error of a point must lie on a component that is listed."""
    system = decomposition.system
    if not decomposition.complete or any(c.orbit > 1 for c in decomposition.components):
        return False
    if (Evaluator.of(system.nonzero, system.n).residuals(point[None]) < NONZERO).any():
        return False
    natural = coordinates_of(system)
    moved = natural.system(system).polynomials
    zero = polish(Evaluator.of(moved, system.n), natural.points(point))
    off = float(np.linalg.norm(natural.inverse.points(zero.x) - point))
    return zero.converged and off <= SPREAD * accuracy * (1 + float(np.linalg.norm(point)))


def _at_isolated(
    system: PolynomialSystem,
    isolated: WitnessSet,
    point: np.ndarray,
    accuracy: float,
    exact: Sequence[Number],
) -> Membership:
    """Whether a point is one of some isolated ones, which no slice has to move for.

    Undecided where the next zero is no further away than the errors can make out.
    """
    distances = np.linalg.norm(isolated.points - point, axis=1)
    size = 1 + float(np.linalg.norm(point))
    errors = accuracy * size + np.linalg.norm(isolated.radii, axis=1)
    near = np.flatnonzero(distances <= SPREAD * errors).tolist()
    if not near:
        return Membership.FOREIGN
    if exact and not all(is_zero(f(exact)) for f in system.polynomials):
        return Membership.FOREIGN
    answers = {_is_exactly(system, isolated, i, exact) for i in near} if exact else {None}
    if None not in answers:
        return Membership.MEMBER if True in answers else Membership.FOREIGN
    try:
        fibres = component_fibres(system, isolated)
    except ValueError:
        return Membership.UNDECIDED
    for fibre in fibres:
        polynomials, rows = fibre.cut.polynomials, fibre.rows
        zeros = [
            fibre.fine.get(i) or PointInWords.of_doubles(x) for i, x in enumerate(fibre.points)
        ]
        apart = min(
            size / with_newton_constant(polynomials, rows, zero).curvature for zero in zeros
        )
        if apart < SPREAD * float(errors.max()):
            return Membership.UNDECIDED
    return Membership.MEMBER


def _is_exactly(
    system: PolynomialSystem, isolated: WitnessSet, index: int, point: Sequence[Number]
) -> bool | None:
    """Whether an exact zero is the one that a witness point stands for; None if that is not known.

    The latter is known to 100 digits, and is the only zero within the error of these.
    """
    zeros = exact_zeros(system.polynomials, isolated, index)
    known = zeros[0].precise if len(zeros) == 1 else None
    if known is None:
        return None
    with in_bits(BITS):
        pairs = zip(known.centre, map(to_ball, point), strict=True)
        gaps = [float(abs(a - b).mid()) for a, b in pairs]
    return bool((np.array(gaps) <= SPREAD * known.radii).all())


class UndecidedError(ComponentError):
    """A membership that could not be decided.

    Attributes:
        found: indices of the components that the point certainly lies on.
        open: indices of those for which it could not be decided.
    """

    def __init__(self, found: Sequence[int], undecided: Sequence[int]) -> None:
        self.found, self.open = list(found), list(undecided)
        which = ", ".join(map(str, self.open))
        noun = "component" if len(self.open) == 1 else "components"
        text = f"whether the point lies on {noun} {which} could not be decided"
        if self.found:
            text += f"; it lies on {', '.join(map(str, self.found))}"
        super().__init__(text)


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def components_through(
    decomposition: Decomposition,
    point: np.ndarray,
    *,
    accuracy: float = 1e-12,
    exact: Sequence[Number] = (),
    run: Run = DEFAULT_RUN,
) -> list[int]:
    """Indices of the components that an affine point lies on, the highest dimension first.

    As `memberships` says (Sommese, Verschelde & Wampler 2001).

    Args:
        decomposition: as `nag.decompose` returns it.
        point: complex, shape ``(n,)``, in the system's variables.
        accuracy: bound of the relative error of the point.
        exact: the exact coordinates that ``point`` is rounded from, if they are known.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        UndecidedError: if the membership in a component could not be decided.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import components_through
    >>> components_through(nag.decompose("x*(y - 1)"), [0, 1])
    [0, 1]
    """
    answers = memberships(
        decomposition,
        point,
        accuracy=accuracy,
        exact=exact,
        run=run,
    )
    found = [i for i, answer in enumerate(answers) if answer is Membership.MEMBER]
    undecided = [i for i, answer in enumerate(answers) if answer is Membership.UNDECIDED]
    if undecided:
        raise UndecidedError(found, undecided)
    return found


def rounded_error(system: PolynomialSystem, at: np.ndarray) -> float | None:
    """The relative error that a zero known to rounding may have; None if the point is none."""
    evaluator = Evaluator.of(system.polynomials, system.n)
    residual = float(evaluator.residuals(at[None]).max(initial=0.0))
    return max(LEAST, 10 * residual) if residual < ON else None


def membership_in(
    system: PolynomialSystem,
    component: WitnessSet,
    point: np.ndarray,
    accuracy: float,
    run: Run,
    exact: Sequence[Number] = (),
) -> Membership:
    """`memberships` for one component of a system by itself."""
    alone = Decomposition(system, (component,), PathCounts(), 0, "default", (), False)
    (answer,) = memberships(alone, point, accuracy=accuracy, exact=exact, run=run)
    return answer


def is_on_component(
    system: PolynomialSystem,
    component: WitnessSet,
    point: Any,
    accuracy: float | None,
    run: Run,
) -> bool:
    """Whether a point lies on a component, see `WitnessSet.contains`."""
    entries = coordinates(point, system.variables, system.imaginary)
    exact = all(isinstance(e, Number) for e in entries)
    at = round_point(entries)
    if exact:
        if not all(is_zero(value) for value in system(entries)):
            return False
        accuracy = ROUNDED
    else:
        evaluator = Evaluator.of(system.polynomials, system.n)
        residual = float(evaluator.residuals(at[None]).max(initial=0.0))
        if residual > max(ON, accuracy or 0.0):
            return False
        accuracy = max(LEAST, 10 * residual) if accuracy is None else accuracy
    answer = membership_in(system, component, at, accuracy, run, entries if exact else ())
    if answer is Membership.UNDECIDED:
        raise UndecidedError([], [0])
    return answer is Membership.MEMBER
