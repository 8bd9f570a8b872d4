"""What solving a polynomial system gives: isolated solutions, and what became of the paths."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self, overload

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.algebra.to_sympy import to_sympy_point
from nag.algebra.tokens import list_names
from nag.errors import NagError
from nag.numerics.array_table import RecordTable, map_rows
from nag.numerics.doubles import beyond_doubles
from nag.numerics.read_only import (
    BooleanArray,
    Chosen,
    ComplexArray,
    FixedArrays,
    IntegerArray,
    RealArray,
    Several,
    equal_values,
    fixed_array,
    handed_over,
)
from nag.text.json_text import Objects, pairs, real_or_null
from nag.text.table import count_text, data_frame, named_apart, one_line
from nag.tracking.run import Run

if TYPE_CHECKING:
    import pandas
    import sympy

# Of exported results.
FORMAT, VERSION = "nag-solutions", 1


@dataclass(frozen=True, eq=False)
class Solution(FixedArrays):
    """One isolated solution.

    Attributes:
        point: complex, shape ``(n,)``, in the order of the system's variables.
        multiplicity: dimension of the local ring, equal to the number of paths that end there.
        real: whether the point is real to within its accuracy.
        residual: largest value of an equation at the point over the size of its terms.
        accuracy: estimated relative error of the point.
        condition: condition number of the Jacobian that determines the point; of a multiple
            solution that of the deflated system.
        precision: decimal digits of the arithmetic that was needed.
        radii: errors of the coordinates, absolute, shape ``(n,)``; None where only ``accuracy`` is
            known, as from an export. Solutions are equal whatever these are.
        variables: names of the coordinates, without the imaginary unit, whose coordinate comes last
            where coefficients are complex; none of a solution that was found by itself. They are
            not compared.
    """

    point: ComplexArray
    multiplicity: int
    real: bool
    residual: float
    accuracy: float
    condition: float
    precision: int
    radii: RealArray | None = field(default=None, compare=False)
    variables: tuple[str, ...] = field(default=(), compare=False)

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", fixed_array(self.point, np.complex128))
        if self.radii is not None:
            object.__setattr__(self, "radii", fixed_array(self.radii))

    def to_numpy(self) -> ComplexArray:
        """The values of the variables, in their order, complex, to be written to.

        As in frames, without the imaginary unit.
        """
        return self.point[: len(self.variables) or None].copy()

    def to_sympy(self, variables: Any = None) -> dict[sympy.Symbol, sympy.Expr]:
        """The point as sympy has it: values, floats, by symbols.

        Args:
            variables: other names for them, or sympy's symbols, in order; without the imaginary
                unit where coefficients are complex.

        Raises:
            nag.NagError: if sympy is not installed, or there are not as many coordinates.
        """
        names = self.variables if variables is None else list_names(variables)
        unit = len(self.point) - len(names)
        if unit not in (0, 1) or (unit and self.point[-1] != 1j):
            raise NagError(
                f"variables: {len(names)} {'is' if len(names) == 1 else 'are'} given for "
                f"{len(self.to_numpy())} coordinates; give those of the result's system"
            )
        return to_sympy_point(names, self.point[: len(names)])

    def document(self) -> dict[str, Any]:
        """The solution as a JSON object."""
        return {
            "point": pairs(self.point),
            "multiplicity": self.multiplicity,
            "real": self.real,
            "residual": real_or_null(self.residual),
            "accuracy": real_or_null(self.accuracy),
            "condition": real_or_null(self.condition),
            "precision": self.precision,
        }

    def __repr__(self) -> str:
        from nag.solving.shown import solution_line

        return solution_line(self)

    def __str__(self) -> str:
        from nag.solving.shown import solution_text

        return solution_text(self)


class HasSolutions:
    """What has a table of isolated solutions gives them as other libraries have them."""

    @property
    def table(self) -> Solutions:
        """The isolated solutions as arrays."""
        raise NotImplementedError

    @overload
    def to_numpy(self, real: Literal[False] = False) -> ComplexArray: ...

    @overload
    def to_numpy(self, real: Literal[True]) -> RealArray: ...

    @overload
    def to_numpy(self, real: bool) -> ComplexArray | RealArray: ...

    def to_numpy(self, real: bool = False) -> ComplexArray | RealArray:
        """The values of the variables, complex, shape ``(k, n)``, to be written to.

        As in frames, without the imaginary unit, which is the last variable of a system with
        complex coefficients.

        Args:
            real: only of the real ones, as floats.
        """
        table = self.table
        points = table.points[:, : len(table.variables) or None]
        return points[table.real].real.copy() if real else points.copy()

    def to_dataframe(self, real: bool = False, *, parts: bool = False) -> pandas.DataFrame:
        """A row for each solution: its coordinates, complex, and what is known of it.

        Args:
            real: only the real ones, their coordinates as floats.
            parts: two columns of floats for each coordinate, ``x.real`` and ``x.imag``, which can
                be written to any file of tables.

        Raises:
            nag.NagError: if pandas is not installed, or it is not known what the variables are
                called.
        """
        table = self.table
        if not table.variables and table.points.shape[1]:
            raise NagError("to_dataframe: the solutions know no names of variables")
        own = dict(zip(table.variables, table.to_numpy(real=real).T, strict=True))
        table = table.select_rows(table.real) if real else table
        names = ("multiplicity", "real", "residual", "accuracy", "condition")
        columns = named_apart(own, {name: getattr(table, name) for name in names})
        return data_frame(columns, parts)

    def to_sympy(self) -> list[dict[sympy.Symbol, sympy.Expr]]:
        """The solutions as sympy has them: values, floats, by symbols.

        Raises:
            nag.NagError: if sympy is not installed.
        """
        return [each.to_sympy() for each in self.table]


@dataclass(frozen=True, eq=False)
class Solutions(HasSolutions, RecordTable[Solution]):
    """Isolated solutions: a sequence of `Solution`, kept as columns, shape ``(k,)``.

    Attributes:
        points: complex, shape ``(k, n)``.
        radii: those that are known, by index.
        variables: names of the coordinates, as of a `Solution`.
    """

    points: ComplexArray
    multiplicity: IntegerArray
    real: BooleanArray
    residual: RealArray
    accuracy: RealArray
    condition: RealArray
    precision: IntegerArray
    radii: Mapping[int, RealArray]
    variables: tuple[str, ...] = ()

    numbers: ClassVar[Mapping[str, type[np.generic]]] = {
        "multiplicity": np.int64,
        "real": np.bool_,
        "residual": np.float64,
        "accuracy": np.float64,
        "condition": np.float64,
        "precision": np.int64,
    }

    def __post_init__(self) -> None:
        for name in ("points", *self.numbers):
            # Whoever makes the table hands its columns over: they may be large.
            object.__setattr__(self, name, handed_over(getattr(self, name)))
        fixed = {i: fixed_array(radii) for i, radii in self.radii.items()}
        object.__setattr__(self, "radii", MappingProxyType(fixed))

    def __reduce__(self) -> tuple[Any, ...]:
        columns = {name: getattr(self, name) for name in self.numbers}
        return _solutions, (self.points, columns, dict(self.radii), self.variables)

    @property
    def table(self) -> Solutions:
        """These."""
        return self

    def _columns(self) -> Iterator[tuple[str, Any]]:
        return (each for each in super()._columns() if each[0] != "variables")

    def __add__(self, other: Self) -> Self:
        """Some solutions, and others in the same variables below them."""
        if isinstance(other, Solutions) and other.variables != self.variables:
            one, two = (", ".join(each.variables) or "no names" for each in (self, other))
            raise NagError(f"the solutions do not go together: they are in {one}, and in {two}")
        return super().__add__(other)

    @classmethod
    def of(
        cls, solutions: Sequence[Solution], n: int, variables: tuple[str, ...] = ()
    ) -> Solutions:
        """Solutions one by one, in ``n`` coordinates, those of the variables first."""
        if isinstance(solutions, Solutions):
            same = solutions.variables == variables
            return solutions if same else replace(solutions, variables=variables)
        radii = {i: s.radii for i, s in enumerate(solutions) if s.radii is not None}
        points = np.array([s.point for s in solutions], dtype=complex).reshape(len(solutions), n)
        numbers = cls.collect_numbers(solutions)
        return cls(points=points, radii=radii, variables=variables, **numbers)

    def __repr__(self) -> str:
        from nag.solving.shown import solutions_line

        return solutions_line(self)

    def __str__(self) -> str:
        from nag.solving.shown import solutions_text

        return solutions_text(self)

    def record(self, i: int) -> Solution:
        numbers = self.numbers_of_row(i)
        return Solution(self.points[i], *numbers, self.radii.get(i), self.variables)


def _solutions(
    points: np.ndarray,
    columns: Mapping[str, np.ndarray],
    radii: Mapping[int, np.ndarray],
    variables: tuple[str, ...],
) -> Solutions:
    """What pickles and copies are made of again."""
    return Solutions(points=points, radii=radii, variables=variables, **columns)


@dataclass(frozen=True, eq=False)
class LargerSets(FixedArrays):
    """End points on solution sets of positive dimension, each shape ``(k, n)``.

    Attributes:
        counting: no polynomial that must not vanish does so on all of the set.
        excluded: one does.
        doubtful: that is not known.
    """

    counting: ComplexArray
    excluded: ComplexArray
    doubtful: ComplexArray

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for each in fields(self):
            points = fixed_array(getattr(self, each.name), np.complex128)
            object.__setattr__(self, each.name, points)

    @classmethod
    def of(cls, n: int, points: Sequence[tuple[np.ndarray, bool | None]] = ()) -> LargerSets:
        """Points, each with whether its set is excluded; None where that is not known."""
        parts = [[x for x, answer in points if answer is which] for which in (False, True, None)]
        return cls(*(np.array(part, dtype=complex).reshape(len(part), n) for part in parts))

    @classmethod
    def together(cls, n: int, parts: Sequence[LargerSets]) -> LargerSets:
        """The points of several branches of a system."""
        every = [cls.of(n), *parts]
        return cls(*(np.vstack([getattr(p, f.name) for p in every]) for f in fields(cls)))

    def map_points(self, image: Callable[[np.ndarray], np.ndarray]) -> LargerSets:
        """The points in other coordinates."""
        return LargerSets(image(self.counting), image(self.excluded), image(self.doubtful))

    @property
    def points(self) -> ComplexArray:
        """All of them."""
        return np.vstack([self.counting, self.excluded, self.doubtful])

    @property
    def notes(self) -> list[str]:
        """What a reader must know of them."""
        notes = []
        if count := len(self.counting):
            lie = "lies on it and is no isolated solution"
            if count > 1:
                lie = "lie on it and are no isolated solutions"
            ends = count_text(count, "end point")
            notes.append(f"the solution set has positive dimension; {ends} {lie}")
        if count := len(self.doubtful):
            lie = "lies on a solution set" if count == 1 else "lie on solution sets"
            notes.append(
                f"{count_text(count, 'end point')} {lie} of positive dimension; whether something "
                "that must not vanish does so on all of it was not decided"
            )
        return notes


def select_finite(solutions: Sequence[Solution], n: int) -> Solutions:
    """Those in ``n`` coordinates that are all in the range of doubles."""
    table = Solutions.of(solutions, n)
    finite = map_rows(lambda some: np.isfinite(some).all(axis=1), table.points)
    return table if finite.all() else table.select_rows(finite)


@dataclass(frozen=True)
class PathStatistics:
    """Numbers of paths by how they ended, and the steps that all of them took together."""

    tracked: int = 0
    regular: int = 0
    singular: int = 0
    at_infinity: int = 0
    failed: int = 0
    steps: int = 0

    @classmethod
    def of(cls, status: np.ndarray, steps: int, tracked: int | None = None) -> PathStatistics:
        """Of ends of these `PathStatus`; ``tracked``: if more paths led to them."""
        counts = [int((status == which).sum()) for which in range(4)]
        return cls(len(status) if tracked is None else tracked, *counts, steps)

    def __add__(self, other: PathStatistics) -> PathStatistics:
        return PathStatistics(
            *(getattr(self, f.name) + getattr(other, f.name) for f in fields(PathStatistics))
        )


@dataclass(frozen=True, eq=False)
class SolveResult(HasSolutions, Several[Solution]):
    """All isolated solutions of a system that were found.

    Attributes:
        system: what was solved.
        solutions: the isolated solutions, each once.
        on_components: end points on solution sets of positive dimension, shape ``(k, n)``, on
            which none of `PolynomialSystem.nonzero` vanishes identically.
        on_excluded: on sets on which one of these does; on_doubtful: where that is not known.
        undecided: end points that are solutions but may or may not be isolated, ``(k, n)``.
        excluded: number of isolated solutions left out because one of `PolynomialSystem.nonzero`
            vanishes; excluded_solutions: these, where they were kept.
        paths: what became of the paths of the last attempt, by status.
        start: one of `nag.solving.start.KINDS`, ``"parameter"``, or ``"none"`` where nothing had to
            be tracked.
        reason: why that start system.
        seed: seed of the random numbers.
        settings: name of the tracking settings.
        complete: whether nothing is known that speaks against a complete list.
        notes: what a reader must know.
        method: which of `nag.solving.solve.METHODS` answered, or ``"by_family"``; empty if that is
            not known.
        pathless: whether a part has no paths at all, as no zero of it can be isolated: whether it
            has any, on sets of positive dimension, is not seen then.
    """

    system: PolynomialSystem
    solutions: Sequence[Solution]
    on_components: ComplexArray
    undecided: ComplexArray
    excluded: int
    paths: PathStatistics
    start: str
    reason: str
    seed: int
    settings: str
    complete: bool
    notes: tuple[str, ...] = ()
    excluded_solutions: Sequence[Solution] = ()
    method: str = ""
    pathless: bool = False
    on_excluded: ComplexArray | None = None
    on_doubtful: ComplexArray | None = None

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for name in ("solutions", "excluded_solutions"):
            known = getattr(self, name)
            table = Solutions.of(known, self.system.n, self.system.own_variables)
            object.__setattr__(self, name, table)
        for name in ("on_components", "undecided", "on_excluded", "on_doubtful"):
            points = getattr(self, name)
            if points is None:
                points = np.zeros((0, self.system.n), dtype=complex)
            object.__setattr__(self, name, fixed_array(points, np.complex128))

    @classmethod
    def of(
        cls,
        system: PolynomialSystem,
        run: Run,
        *,
        reason: str,
        start: str = "none",
        method: str = "",
        solutions: Sequence[Solution] = (),
        excluded: Sequence[Solution] = (),
        larger: LargerSets | None = None,
        undecided: np.ndarray | None = None,
        paths: PathStatistics | None = None,
        doubts: Sequence[str] = (),
        remarks: Sequence[str] = (),
        whole: bool = True,
        pathless: bool = False,
    ) -> SolveResult:
        """What a run has found.

        Args:
            larger: end points on solution sets of positive dimension, if there are such.
            undecided: end points that may or may not be isolated.
            doubts: notes that speak against a complete list; ``remarks``: other ones.
            whole: whether the list would be complete without them.

        Solutions whose coordinates are no doubles are left out, and make the list incomplete.
        """
        larger = LargerSets.of(system.n) if larger is None else larger
        fitting, allowed = (select_finite(each, system.n) for each in (solutions, excluded))
        if undecided is not None:
            undecided = undecided[np.isfinite(undecided).all(axis=1)]
        if len(fitting) < len(solutions) or len(allowed) < len(excluded):
            doubts = [*doubts, beyond_doubles("solutions")]
        solutions, excluded = fitting, allowed
        return cls(
            system=system,
            solutions=solutions,
            on_components=larger.counting,
            undecided=np.zeros((0, system.n), dtype=complex) if undecided is None else undecided,
            excluded=len(excluded),
            paths=paths or PathStatistics(),
            start=start,
            reason=reason,
            seed=run.seed,
            settings=run.name,
            complete=whole and not doubts,
            notes=tuple(dict.fromkeys([*doubts, *larger.notes, *remarks])),
            excluded_solutions=excluded,
            method=method,
            pathless=pathless,
            on_excluded=larger.excluded,
            on_doubtful=larger.doubtful,
        )

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables, without the imaginary unit."""
        return self.system.own_variables

    @property
    def points(self) -> ComplexArray:
        """The isolated solutions, shape ``(k, n)``."""
        return self.table.points

    @property
    def table(self) -> Solutions:
        """The isolated solutions as arrays."""
        return Solutions.of(self.solutions, self.system.n, self.system.own_variables)

    @property
    def real(self) -> tuple[Solution, ...]:
        """The real ones among the isolated solutions."""
        return tuple(s for s in self.solutions if s.real)

    @property
    def larger(self) -> LargerSets:
        """The end points on solution sets of positive dimension."""
        return LargerSets(self.on_components, self.on_excluded, self.on_doubtful)

    @property
    def positive_dimensional(self) -> bool:
        """Whether the solution set has points that are not isolated."""
        return len(self.on_components) > 0

    @property
    def perhaps_infinite(self) -> bool:
        """Whether it has such points, or may have."""
        return self.positive_dimensional or len(self.on_doubtful) > 0

    @property
    def entries(self) -> Solutions:
        """The isolated solutions."""
        return self.table

    @overload
    def __getitem__(self, index: int) -> Solution: ...

    @overload
    def __getitem__(self, index: Chosen) -> Solutions: ...

    def __getitem__(self, index: int | Chosen) -> Solution | Solutions:
        return self.table[index]

    def rows(self, most: int | None = None, columns: int | None = None) -> list[list[str]]:
        """Headings, and a row for each solution, the real ones first.

        Args:
            most: so many solutions at most.
            columns: so many coordinates at most.
        """
        from nag.solving.shown import solution_rows

        return solution_rows(self, most, columns)

    def document(self, title: str | None = None, file: str | None = None) -> dict[str, Any]:
        """The export as a JSON object of the format `FORMAT` (dicts, lists, strings, numbers).

        Args:
            title: of the case that was solved.
            file: of the case.
        """
        document = self.document_to_write(title, file)
        for key, value in document.items():
            if isinstance(value, Objects):
                document[key] = [each.document() for each in value.things]
        return document

    def document_to_write(
        self, title: str | None = None, file: str | None = None
    ) -> dict[str, Any]:
        """The same for `nag.text.json_text.lay_out_parts`, without the solutions' objects."""
        return {
            "format": FORMAT,
            "version": VERSION,
            "case": None if title is None else {"title": title, "file": file or ""},
            "seed": self.seed,
            "settings": self.settings,
            "method": self.method,
            "start": self.start,
            "reason": self.reason,
            "complete": self.complete,
            "notes": list(self.notes),
            "paths": {name: int(count) for name, count in asdict(self.paths).items()},
            "system": self.system.document(),
            "solutions": Objects(self.solutions),
            "excluded": self.excluded,
            "excluded_solutions": Objects(self.excluded_solutions),
            "on_components": pairs(self.on_components),
            "on_excluded": pairs(self.on_excluded),
            "on_doubtful": pairs(self.on_doubtful),
            "undecided": pairs(self.undecided),
        }

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.solving.shown import result_text

        return result_text(self)

    def _repr_html_(self) -> str:
        from nag.solving.shown import result_html

        return result_html(self)
