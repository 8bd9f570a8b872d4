"""Witness sets, and the components and decompositions that are made of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.given import check_error, check_listed, check_type
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.algebra.to_sympy import to_sympy_point
from nag.errors import NagError
from nag.numerics.read_only import (
    ComplexArray,
    FixedArrays,
    IntegerArray,
    RealArray,
    Several,
    equal_values,
    fixed_array,
)
from nag.text.json_text import pairs, real_or_null
from nag.text.table import data_frame, known_or_nan, named_apart, one_line
from nag.tracking.run import DEFAULT_RUN, Run, takes_run

if TYPE_CHECKING:
    import pandas
    import sympy

    from nag.decomposition.curve_genus import Genus
    from nag.tracking.settings import Settings
    from nag.witness.constraints import Constraints
    from nag.witness.fibres import Fibre
    from nag.witness.projection import Projection
    from nag.witness.real_points import RealPoints


# Decimal digits of doubles.
DOUBLE = 16

# Of exported decompositions.
FORMAT, VERSION = "nag-decomposition", 2


def even_radii(points: np.ndarray, accuracy: float) -> np.ndarray:
    """Radii of points that are known to one relative error, shape ``(P, n)``."""
    sizes = 1 + np.linalg.norm(points, axis=1, keepdims=True)
    return np.broadcast_to(accuracy * sizes, np.shape(points))


def relative_errors(points: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Errors of points, shape ``(P, n)``, relative to one and their sizes, shape ``(P,)``."""
    with np.errstate(all="ignore"):
        return np.linalg.norm(radii, axis=1) / (1 + np.linalg.norm(points, axis=1))


class Status(StrEnum):
    """What is known of a component."""

    IRREDUCIBLE = "irreducible"
    UNDECIDED = "undecided"


@dataclass(frozen=True, eq=False)
class Slice(FixedArrays):
    """A linear slice ``A x = b`` of codimension ``len(b)`` in affine space.

    Attributes:
        A: complex, shape ``(d, n)``, rows orthonormal, or such in other units of the variables
            and of norms about one in these.
        b: complex, shape ``(d,)``.
    """

    A: ComplexArray
    b: ComplexArray

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for name in ("A", "b"):
            try:
                object.__setattr__(self, name, fixed_array(getattr(self, name), complex))
            except (TypeError, ValueError, OverflowError):
                raise NagError(f"{name}: give an array of numbers") from None
        if self.A.ndim != 2 or self.b.shape != self.A.shape[:1]:
            raise NagError(
                f"A, b: arrays of shapes {self.A.shape} and {self.b.shape} are given; give (d, n) "
                "and (d,)"
            )

    def document(self) -> dict[str, Any]:
        """The slice as a JSON object."""
        return {"A": pairs(self.A), "b": pairs(self.b)}

    @property
    def dimension(self) -> int:
        """Dimension of the sets that it cuts in points."""
        return len(self.b)

    @property
    def rows(self) -> ComplexArray:
        """The slice as rows ``(-b, A)`` that act on homogeneous coordinates ``(1, x)``."""
        return np.hstack([-self.b[:, None], self.A])


@dataclass(frozen=True, eq=False)
class WitnessSet(FixedArrays):
    """A component by its points on a generic slice.

    Attributes:
        slice: the slice.
        points: complex, shape ``(degree, n)``.
        multiplicity: multiplicity of the component in the scheme that the equations define; None
            where it is not known.
        status: `IRREDUCIBLE` where the trace test and the final checks passed.
        residual: largest relative residual of the original equations at the points.
        radii: errors of the points' coordinates, absolute, shape ``(degree, n)``: no coordinate of
            a point is further from that of the exact point on the slice, as far as arithmetic of
            twice the digits shows (`nag.witness.exact_points`); inf where it does not.
        digits: decimal digits of the arithmetic that the radii rest on, shape ``(degree,)``.
        corank: corank of the Jacobian of the original equations at the points.
        multidegree: integer array of order ``dimension``: entry ``[i, j, ..]`` counts the points
            with groups ``i, j, ..`` of the system fixed at random values; None without groups.
        orbit: number of components that a symmetry carries into this one, itself included.
        note: why the status is undecided; empty otherwise.
        images: symmetries of the system that carry it into the others of its orbit, one each;
            empty where they are not known.
        fibres: the points again, in their order, with the square systems in the system's variables
            that cut them as regular zeros, and the unknowns that deflation added; empty where they
            were not kept. With them a component can be moved, sampled and tested.
        system: the equations that it is a component of; a `Decomposition` tells its components.
            It takes no part in comparisons.
    """

    slice: Slice
    points: ComplexArray
    multiplicity: int | None
    status: Status
    residual: float
    radii: RealArray
    digits: IntegerArray
    corank: int
    multidegree: IntegerArray | None = None
    orbit: int = 1
    note: str = ""
    images: tuple[SignedPermutation, ...] = ()
    fibres: tuple[Fibre, ...] = ()
    system: PolynomialSystem | None = field(default=None, compare=False)

    __eq__ = equal_values

    def __post_init__(self) -> None:
        check_type(self.slice, Slice, "slice", "a nag.Slice")
        # Nothing has none of it: 0 is said where it was looked for and not found.
        object.__setattr__(self, "multiplicity", self.multiplicity or None)
        points = fixed_array(self.points, complex)
        object.__setattr__(self, "points", points)
        radii, digits = fixed_array(self.radii, float), fixed_array(self.digits, int)
        if radii.shape != points.shape or digits.shape != points.shape[:1]:
            raise NagError(
                f"radii have shape {radii.shape}, digits {digits.shape}, where the points have "
                f"{points.shape}"
            )
        object.__setattr__(self, "radii", radii)
        object.__setattr__(self, "digits", digits)
        object.__setattr__(self, "status", Status(self.status))
        if self.multidegree is not None:
            object.__setattr__(self, "multidegree", fixed_array(self.multidegree, int))
        rows = fixed_array(self.slice.rows)
        object.__setattr__(self, "fibres", tuple(fibre.fixed_on(rows) for fibre in self.fibres))

    @property
    def dimension(self) -> int:
        return self.slice.dimension

    @property
    def degree(self) -> int:
        return len(self.points)

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables, without the imaginary unit.

        Raises:
            nag.NagError: if the component does not know its equations.
        """
        return self._known_system().own_variables

    @property
    def is_multiple(self) -> bool:
        """Whether its multiplicity is known to be more than 1."""
        return (self.multiplicity or 0) > 1

    @property
    def errors(self) -> RealArray:
        """Errors of the points, relative to one and their sizes, shape ``(degree,)``."""
        return relative_errors(self.points, self.radii)

    @property
    def accuracy(self) -> float:
        """The largest of the points' relative errors."""
        return float(self.errors.max(initial=0.0))

    @property
    def precision(self) -> int:
        """Decimal digits of the arithmetic that the least known of the points rests on."""
        return int(self.digits.min()) if len(self.digits) else DOUBLE

    def __repr__(self) -> str:
        return (
            f"WitnessSet(dimension={self.dimension}, degree={self.degree}, "
            f"multiplicity={self.multiplicity}, {self.status})"
        )

    def __str__(self) -> str:
        from nag.witness.shown import witness_set_text

        return witness_set_text(self)

    def _repr_html_(self) -> str:
        from nag.witness.shown import witness_set_html

        return witness_set_html(self)

    def facts(self, number: int) -> dict[str, Any]:
        """What a document says of a component that it refers to by its number, as a JSON object."""
        return {
            "number": number,
            "dimension": self.dimension,
            "degree": self.degree,
            # In documents 0 stands for what is not known.
            "multiplicity": self.multiplicity or 0,
            "status": str(self.status),
        }

    def document(self, variables: Sequence[str] | None = None) -> dict[str, Any]:
        """The component as a JSON object, without what cuts it.

        Args:
            variables: names of all coordinates, by default those of its equations.
        """
        if variables is None:
            variables = self._known_system().variables
        orbit: dict[str, Any] = {"size": self.orbit}
        if self.images:
            orbit["images"] = [g.text(variables) for g in self.images]
        document: dict[str, Any] = {"dimension": self.dimension, "degree": self.degree}
        if self.multidegree is not None:
            document["multidegree"] = self.multidegree.tolist()
        return document | {
            "multiplicity": self.multiplicity or 0,
            "status": str(self.status),
            "note": self.note,
            "orbit": orbit,
            "residual": real_or_null(self.residual),
            "accuracy": real_or_null(self.accuracy),
            "precision": f"{self.precision} digits",
            "corank": self.corank,
            "slice": self.slice.document(),
            "points": pairs(self.points),
            "radii": [[real_or_null(r) for r in row] for row in self.radii.tolist()],
            "digits": self.digits.tolist(),
        }

    def to_numpy(self) -> ComplexArray:
        """The witness points, shape ``(degree, n)``, to be written to.

        As in frames, without the imaginary unit, which is the last variable of a system with
        complex coefficients.

        Raises:
            nag.NagError: if the component does not know its equations.
        """
        return self.points[:, : len(self._known_system().own_variables)].copy()

    def to_dataframe(self, *, parts: bool = False) -> pandas.DataFrame:
        """A row for each witness point: its coordinates, and its error relative to its size.

        Args:
            parts: two columns of floats for each coordinate, ``x.real`` and ``x.imag``, which can
                be written to any file of tables.

        Raises:
            nag.NagError: if pandas is not installed, or the component does not know its equations.
        """
        names = self._known_system().own_variables
        columns: dict[str, Any] = dict(zip(names, self.to_numpy().T, strict=True))
        return data_frame(named_apart(columns, {"error": self.errors}), parts)

    def to_sympy(self) -> list[dict[sympy.Symbol, sympy.Expr]]:
        """The witness points as sympy has them: values, floats, by symbols.

        Raises:
            nag.NagError: if sympy is not installed, or the component does not know its equations.
        """
        names = self._known_system().own_variables
        return [to_sympy_point(names, x) for x in self.to_numpy()]

    def _known_system(self) -> PolynomialSystem:
        if self.system is None:
            raise NagError(
                "system: the witness set does not know its equations; take it from the "
                "components of a Decomposition, or replace(component, system=...)"
            )
        return self.system

    @takes_run
    def sample(
        self,
        rng: np.random.Generator | int,
        count: int = 1,
        *,
        run: Run = DEFAULT_RUN,
    ) -> ComplexArray:
        """Independent random points of the component, accurate to rounding.

        Each is the end of a path from a random witness point to a random slice (Sommese &
        Wampler 2005, section 15.2); of a finite set its points are drawn. They are complex.
        `nag.decomposition.sample` also says how accurate they are.

        Args:
            rng: NumPy's generator, or a seed.
            count: how many.

        Returns:
            Complex array of shape ``(count, n)``, in the order of the system's variables.

        Raises:
            nag.witness.sampling.SamplingError: if a path fails.
            ValueError: if ``count`` is no whole number from 0 up.

        >>> import nag
        >>> circle = nag.decompose(["x^2 + y^2 = 1"]).components[0]
        >>> points = circle.sample(0, 10)
        >>> points.shape
        (10, 2)
        >>> bool(abs((points**2).sum(axis=1) - 1).max() < 1e-10)
        True
        """
        from nag.witness.sampling import sample_points

        return sample_points(self._known_system(), self, rng, count, run)

    @takes_run
    def contains(
        self,
        point: Any,
        *,
        accuracy: float | None = None,
        run: Run = DEFAULT_RUN,
    ) -> bool:
        """Whether a point lies on the component.

        The slice moves to a generic one through the point; the point lies on the component exactly
        when a path ends there (Sommese, Verschelde & Wampler 2001).

        Args:
            point: one number for each variable, or a mapping from names to numbers. Integers,
                fractions, decimals, texts and sympy's numbers are exact, and the equations are
                then tested exactly; floats and complex numbers are taken for rounded ones.
            accuracy: relative error of a point that is not exact; by default what its residuals
                suggest. One that satisfies an equation only to 1e-9 is on no component.

        Raises:
            nag.witness.membership.UndecidedError: if it could not be decided.
            ValueError: if ``point`` has another number of coordinates, or one is no number.

        >>> import nag
        >>> curve, line = nag.decompose(["(x^2 + y^2 - 1)*(x - y)"]).components[::-1]
        >>> curve.degree, curve.contains(["3/5", "4/5"]), line.contains({"x": 2, "y": 2})
        (2, True, True)
        >>> curve.contains([2, 2])
        False
        """
        from nag.witness.membership import is_on_component

        check_error(accuracy, "accuracy")
        return is_on_component(
            self._known_system(),
            self,
            point,
            accuracy,
            run,
        )

    @takes_run
    def move_to(self, target: Slice, *, run: Run = DEFAULT_RUN) -> WitnessSet:
        """The component on another slice, its points where they come to.

        See `nag.decomposition.witness_at`.

        >>> import nag
        >>> circle = nag.decompose(["x^2 + y^2 = 1"]).components[0]
        >>> moved = circle.move_to(nag.Slice([[1, 0]], [0.6]))
        >>> sorted(moved.points[:, 1].real.round(12).tolist())
        [-0.8, 0.8]
        """
        from nag.witness.moving import witness_at

        return witness_at(self._known_system(), self, target, run=run)

    @takes_run
    def real_points_near(self, near: Any, *, run: Run = DEFAULT_RUN, **options: int) -> RealPoints:
        """Real points of the component near a real point, the nearest first.

        See `nag.decomposition.real_points_near`, which has ``options``.

        >>> import nag
        >>> circle = nag.decompose(["x^2 + y^2 = 1"]).components[0]
        >>> circle.real_points_near([3, 0]).points.round(12).tolist()[0]
        [1.0, 0.0]
        """
        from nag.witness.real_points import real_points_near

        return real_points_near(self._known_system(), self, near, run=run, **options)

    @takes_run
    def intersect(self, other: Any, *, run: Run = DEFAULT_RUN) -> Decomposition:
        """The components of the intersection with another component, or with what equations cut.

        Equations are a `nag.PolynomialSystem`, or what `nag.system` takes, in the same variables.
        See `nag.decomposition.intersect_components` and `nag.decomposition.intersect_equations`.

        >>> import nag
        >>> plane, bowl = nag.decompose(["(x^2 + y^2 - z)*(x - y)"]).components
        >>> [(c.dimension, c.degree) for c in plane.intersect(bowl).components]
        [(1, 2)]
        >>> [(c.dimension, c.degree) for c in bowl.intersect("z = 0").components]
        [(1, 1), (1, 1)]
        """
        from nag.algebra.from_python import system
        from nag.decomposition.intersection import intersect_components, intersect_equations

        own = self._known_system()
        if isinstance(other, WitnessSet):
            return intersect_components(own, self, other, run=run)
        if not isinstance(other, PolynomialSystem):
            unit = own.variables[-1] if own.imaginary else None
            other = system(other, own.own_variables, imaginary=unit)
        return intersect_equations(own, self, other, run=run)

    @takes_run
    def genus(self, *, run: Run = DEFAULT_RUN) -> Genus:
        """The genus of the component, a reduced curve, see `nag.decomposition.genus`.

        >>> import nag
        >>> nag.decompose(["y^2 = x^3 - x"]).components[0].genus().genus
        1
        """
        from nag.decomposition.curve_genus import genus

        return genus(self._known_system(), self, run=run)

    def constraints(self, system: PolynomialSystem | None = None) -> Constraints:
        """Constraints for equations of motion, independent along the component.

        Args:
            system: other equations that hold on it, in variables of their own, as
                ``nag.model(...).unreduced``; by default those that it is a component of.

        Raises:
            ComponentError: if the equations are singular at all of its points.

        >>> import nag
        >>> circle = nag.decompose(["x^2 + y^2 = 1", "x*(x^2 + y^2 - 1)"]).components[0]
        >>> constraints = circle.constraints()
        >>> constraints.jacobian([0.6, 0.8]).shape, constraints.values([0.6, 0.8]).shape
        ((1, 2), (1,))
        """
        from nag.witness.constraints import find_constraints

        return find_constraints(self, system)

    @takes_run
    def project(
        self,
        coordinates: Any,
        *,
        run: Run = DEFAULT_RUN,
    ) -> Projection:
        """Dimension and degree of the closure of a coordinate projection, and of its fibres.

        Pseudo-witness sets (Hauenstein & Sommese 2010).

        Args:
            coordinates: the variables to project to, at least one: names, sympy's symbols, a text
                of names as for `nag.eliminate`, or indices.

        Raises:
            nag.witness.projection.ProjectionError: if it could not be determined.
            ValueError: if ``coordinates`` are no variables, each once.

        >>> import nag
        >>> twisted = nag.decompose(["y - x^2", "z - x^3"]).components[0]
        >>> image = twisted.project("y, z")
        >>> image.dimension, image.degree, image.fibre_degree
        (1, 3, 1)
        """
        from nag.witness.projection import project

        return project(self._known_system(), self, coordinates, run=run)


@dataclass(frozen=True)
class PathCounts:
    """How many paths were tracked, and how they ended that did not end at a point."""

    tracked: int = 0
    failed: int = 0
    at_infinity: int = 0

    @property
    def judged_elsewhere(self) -> PathCounts:
        """The counts without failures, where what they leave open is said in another way."""
        return PathCounts(self.tracked, 0, self.at_infinity)

    def __add__(self, other: PathCounts) -> PathCounts:
        return PathCounts(
            self.tracked + other.tracked,
            self.failed + other.failed,
            self.at_infinity + other.at_infinity,
        )


@dataclass(frozen=True)
class Decomposition(Several[WitnessSet]):
    """The irreducible components of the zero set of ``system``, in the order of their numbers.

    Those that symmetries carry into each other are items one by one, as they are numbered.

    Attributes:
        system: the exact system.
        components: by falling dimension, then rising degree; of an orbit, whose symmetries are
            known, the first one.
        paths: what the run did.
        seed: seed of the random numbers.
        settings: of tracking, or their name; those of one's own are exported as ``custom``.
        order: indices of the equations in the order in which they were intersected, among those
            that are left when linear equations have been solved; empty where they were not, or
            where branches of the system were decomposed apart.
        complete: whether every component is confirmed and no path was left undecided.
        notes: what a reader must know of an incomplete answer.
        method: the name of the one of `nag.decomposition.decompose.METHODS` that answered; empty
            where another operation gave the components, or it is not known.
        algebraic: whether exact algebra gave the components, and no paths were needed.
    """

    system: PolynomialSystem
    components: tuple[WitnessSet, ...]
    paths: PathCounts
    seed: int
    settings: Settings | str
    order: tuple[int, ...]
    complete: bool
    notes: tuple[str, ...] = field(default=())
    method: str = field(default="", compare=False)
    algebraic: bool = field(default=False, compare=False)

    __hash__ = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        check_type(self.system, PolynomialSystem, "system", "a nag.PolynomialSystem")
        check_listed(self.components, "components", "a list of nag.WitnessSet")
        known = tuple(
            c if c.system is self.system else replace(c, system=self.system)
            for c in self.components
        )
        object.__setattr__(self, "components", known)

    @property
    def entries(self) -> tuple[WitnessSet, ...]:
        """All components, each one of an orbit by itself, on a slice of its own."""
        from nag.witness.frame import expand_orbits

        if len(self) == len(self.components):
            return self.components
        return expand_orbits(self).components

    def __len__(self) -> int:
        return len(self._firsts)

    @property
    def _firsts(self) -> list[WitnessSet]:
        """For each component the first one of its orbit."""
        from nag.witness.frame import count_expanded

        return [c for c in self.components for _ in range(count_expanded(c))]

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each component: number, dimension, degree, multiplicity, status, orbit.

        A multiplicity that is not known is NaN. ``orbit`` is the size of the one that it is of.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        facts = [c.facts(k) | {"orbit": c.orbit} for k, c in enumerate(self._firsts, 1)]
        names = ("number", "dimension", "degree", "multiplicity", "status", "orbit")
        columns = {name: [row[name] for row in facts] for name in names}
        return data_frame(columns | {"multiplicity": known_or_nan(columns["multiplicity"])})

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables, without the imaginary unit."""
        return self.system.own_variables

    @property
    def dimension(self) -> int:
        """Largest dimension of a component; -1 for the empty set."""
        return max((c.dimension for c in self.components), default=-1)

    def rows(self) -> list[list[str]]:
        """Headings, and one row for components that are alike."""
        from nag.witness.shown import component_rows

        return component_rows(self)

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> Decomposition:
        """The decomposition that an export as a JSON object is of.

        Raises:
            nag.NagError: if it is none.

        >>> import nag
        >>> circle = nag.decompose("x^2 + y^2 = 1")
        >>> nag.Decomposition.of_document(circle.document()) == circle
        True
        """
        from nag.files.export import export_of

        return export_of(document).decomposition

    def document(
        self,
        case: Mapping[str, str] | None = None,
        formulation: str | None = None,
        reason: str | None = None,
    ) -> dict[str, Any]:
        """The export as a JSON object of the format `FORMAT` (dicts, lists, strings, numbers).

        Args:
            case: title and file of the case, and the kind of what was decomposed.
            formulation: of a mechanism's model.
            reason: why that one.
        """
        cuts = list(dict.fromkeys(f.cut for c in self.components for f in c.fibres))
        place = {cut: i for i, cut in enumerate(cuts)}
        variables = self.system.variables
        return {
            "format": FORMAT,
            "version": VERSION,
            "case": None if case is None else dict(case),
            "formulation": formulation,
            "reason": reason,
            "seed": self.seed,
            "settings": self.settings if isinstance(self.settings, str) else "custom",
            "complete": self.complete,
            "notes": list(self.notes),
            "paths": asdict(self.paths),
            "method": self.method,
            "order": [int(i) for i in self.order],
            "system": self.system.document(),
            "equations": [cut.document(variables) for cut in cuts],
            "components": [
                c.document(variables) | {"cut_by": [f.document(place[f.cut]) for f in c.fibres]}
                for c in self.components
            ],
        }

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.witness.shown import decomposition_text

        return decomposition_text(self)

    def _repr_html_(self) -> str:
        from nag.witness.shown import decomposition_html

        return decomposition_html(self)
