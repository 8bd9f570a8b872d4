"""Random points of a component: each lies on a random slice of its own."""

from __future__ import annotations

import numbers
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.given import check_whole
from nag.algebra.system import PolynomialSystem
from nag.algebra.to_sympy import to_sympy_point
from nag.errors import ComponentError, NagError
from nag.numerics.doubles import EPS, SHARP
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.numerics.read_only import ComplexArray, RealArray, Several, equal_values, fixed_array
from nag.numerics.zero_values import ON
from nag.text.json_text import pairs, real_or_null
from nag.text.table import data_frame, one_line
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, carry_points, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.exact_points import SharpPoints
from nag.witness.fibres import Fibre
from nag.witness.given_component import check_component
from nag.witness.moving import move_and_sharpen
from nag.witness.slices import random_rows
from nag.witness.witness import WitnessSet, relative_errors

if TYPE_CHECKING:
    import pandas
    import sympy

# Of their JSON documents.
FORMAT = "nag-samples"


@dataclass(frozen=True, eq=False)
class Samples(Several[ComplexArray]):
    """Points of a component.

    Attributes:
        points: complex, shape ``(count, n)``.
        residual: largest relative residual of the equations at the points.
        accuracy: largest estimated relative error of a point.
        doubt: why the set that they are drawn from may not be whole; empty if it is.
        variables: names of the coordinates, without the imaginary unit.
        real: whether real points were asked for, whose imaginary parts are all 0.
        real_dimensions: of real points, those of the component's real part round each, or -1 where
            it is not known, as at singular points.
        unit: name of the imaginary unit, whose coordinate comes last in ``points``; empty where
            coefficients are real.
    """

    points: ComplexArray
    residual: float
    accuracy: float
    doubt: str = ""
    variables: tuple[str, ...] = ()
    real: bool = False
    real_dimensions: tuple[int, ...] = ()
    unit: str = ""

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", fixed_array(self.points))

    @property
    def entries(self) -> ComplexArray:
        """The points."""
        return self.points

    @property
    def complete(self) -> bool:
        """Whether the set that they are drawn from is certain to be whole."""
        return not self.doubt

    def to_numpy(self) -> ComplexArray | RealArray:
        """The points, complex, or floats where real ones were asked for, to be written to.

        As in frames, without the imaginary unit: shape ``(count, variables)``.
        """
        points = self.points[:, : len(self.variables)]
        return points.real.copy() if self.real else points.copy()

    def to_dataframe(self, *, parts: bool = False) -> pandas.DataFrame:
        """A row for each point: its coordinates, as `to_numpy` has them, by their names.

        Args:
            parts: two columns of floats for each complex coordinate, ``x.real`` and ``x.imag``,
                which can be written to any file of tables.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        columns = self.to_numpy().T
        return data_frame(dict(zip(self.variables, columns, strict=True)), parts)

    def to_sympy(self) -> list[dict[sympy.Symbol, sympy.Expr]]:
        """The points as sympy has them: values, floats, by symbols.

        Raises:
            nag.NagError: if sympy is not installed.
        """
        return [to_sympy_point(self.variables, x) for x in self.to_numpy()]

    def rows(self, variables: Sequence[str]) -> list[list[str]]:
        """Headings, and a row for each of the first points, in their first coordinates."""
        from nag.witness.shown import sample_rows

        return sample_rows(self, variables)

    def document(self, component: dict[str, Any] | None = None) -> dict[str, Any]:
        """The points as a JSON object, without its head.

        Args:
            component: what is said of the component that they are of, if that is known.
        """
        known = [None if d < 0 else d for d in self.real_dimensions]
        return {
            "variables": [*self.variables, *([self.unit] if self.unit else [])],
            "imaginary": self.unit or None,
            "component": component,
            "residual": real_or_null(self.residual),
            "accuracy": real_or_null(self.accuracy),
            "points": pairs(self.points),
            "real_dimensions": known if self.real else None,
            "doubt": self.doubt,
        }

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.witness.shown import samples_text

        return samples_text(self)

    def _repr_html_(self) -> str:
        from nag.witness.shown import samples_html

        return samples_html(self)


class SamplingError(ComponentError):
    """Points that could not be found, with the reason.

    Attributes:
        found: the points before the one that could not be found.
    """

    def __init__(self, reason: str, found: Samples) -> None:
        self.found = found
        super().__init__(reason)


class NoRealPointsError(NagError):
    """Real points were asked of a component that has none, which is proved.

    Attributes:
        found: no points.
    """

    def __init__(self, reason: str, found: Samples) -> None:
        self.found = found
        super().__init__(reason)


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def sample(
    system: PolynomialSystem,
    component: WitnessSet,
    count: int,
    *,
    run: Run = DEFAULT_RUN,
) -> Samples:
    """``count`` random points of ``component``, accurate to rounding.

    For each point a random witness point follows the component's slice to a random one, so the
    points are independent (Sommese & Wampler 2005, section 15.2). Of a component of dimension 0,
    its points are drawn.

    Args:
        system: the equations that ``component`` was found from.
        component: one of the components of a `nag.Decomposition`.
        count: how many.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The points, complex of shape ``(count, n)``, with their residual and accuracy.

    Raises:
        SamplingError: if a path fails; it has the points that were found before.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import sample
    >>> circle = nag.decompose("x^2 + y^2 = 1")
    >>> found = sample(circle.system, circle.components[0], 5)
    >>> found.points.shape, found.residual < 1e-12
    ((5, 2), True)
    """
    check_component(system, component)
    check_whole(count, "count")
    rng = run.random(Stream.SAMPLING)
    if not component.dimension:
        drawn = rng.integers(len(component.points), size=count)
        at, evaluator = component.points[drawn], Evaluator.of(system.polynomials, system.n)
        residual = float(evaluator.residuals(at).max(initial=0.0))
        errors = relative_errors(at, component.radii[drawn])
        error = float(errors.max(initial=EPS))
        return Samples(at, residual, error, variables=system.own_variables, unit=system.unit)
    given, natural = system, coordinates_of(system)
    system = natural.system(system)
    component = carry_component(component, natural, system)
    fibres = component_fibres(system, component)
    evaluator = Evaluator.of(system.polynomials, system.n)
    points, radii = np.zeros((count, system.n), dtype=complex), np.zeros((count, system.n))
    for k in range(count):
        there = move_to_random_slice(fibres, rng, run)
        x = there.x
        if not (len(x) and there.accuracy < SHARP and evaluator.residuals(x).max(initial=0.0) < ON):
            some = _samples(evaluator, points[:k], radii[:k], natural, given)
            raise SamplingError(f"point {k + 1} of {count}: the path to it failed", some)
        points[k], radii[k] = x[0], there.radii[0]
    return _samples(evaluator, points, radii, natural, given)


def move_to_random_slice(
    fibres: Sequence[Fibre], rng: np.random.Generator, run: Run
) -> SharpPoints:
    """What became of a random point of the fibres on its way to a random slice."""
    chosen = int(rng.integers(sum(map(len, fibres))))
    for fibre in fibres:
        if chosen < len(fibre):
            break
        chosen -= len(fibre)
    one = fibre.only([chosen])
    target = random_rows(rng, fibre.dimension, fibre.cut.n) / fibre.sizes
    return move_and_sharpen([one], target, rng, run, endgame=False)[0]


def _samples(
    evaluator: Evaluator,
    y: np.ndarray,
    radii: np.ndarray,
    natural: NaturalCoordinates,
    given: PolynomialSystem,
) -> Samples:
    """Points in natural coordinates in those of the system that was given."""
    residual = float(evaluator.residuals(y).max(initial=0.0))
    points, radii = carry_points(y, radii, natural.inverse)
    error = float(relative_errors(points, radii).max(initial=EPS))
    return Samples(points, residual, error, variables=given.own_variables, unit=given.unit)


def sample_points(
    system: PolynomialSystem,
    component: WitnessSet,
    rng: np.random.Generator | int,
    count: int,
    run: Run,
) -> ComplexArray:
    """Points of a component, see `WitnessSet.sample`."""
    check_whole(count, "count")
    if isinstance(rng, numbers.Integral) and not isinstance(rng, bool) and rng >= 0:
        seed = int(rng)
    elif isinstance(rng, np.random.Generator):
        seed = int(rng.integers(2**63))
    else:
        raise NagError(f"rng: {rng!r} is given; give numpy.random.default_rng(), or a seed")
    found = sample(system, component, int(count), run=replace(run, seed=seed))
    return found.points
