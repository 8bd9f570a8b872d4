"""Many members of a family, solved together.

The family is solved once, for random parameters. From there all members are tracked in lanes, as
many paths each as there are solutions, with coefficients of their own. Where these end in as many
distinct regular zeros, Newton's method proves them, and there are no more; any other member is
solved by itself, as `nag.solving.parameter.solve_targets` solves one, and where paths are lost even
so, without its family. Whether a zero is real is decided as `nag.solving.solve.solve` decides it.
"""

from __future__ import annotations

from collections.abc import Generator, Hashable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from nag.algebra.family import Family
from nag.algebra.from_python import exact_complex, system
from nag.algebra.imaginary_unit import append_unit, as_real, real_and_imaginary_parts
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import list_names
from nag.errors import NagError, StartError
from nag.numerics.coincidence import radii_of_balls
from nag.numerics.read_only import (
    BooleanArray,
    ByteArray,
    ComplexArray,
    IntegerArray,
    RealArray,
    Several,
    equal_values,
    fixed_array,
    handed_over,
)
from nag.solving.certificate import bound_of_zeros
from nag.solving.isolated_zero import are_within_errors, which_members_are_real
from nag.solving.member_lines import MemberLines
from nag.solving.parameter import (
    Solved,
    check_count,
    compare_with_count,
    move_regular,
    solve_generic,
    solve_targets,
)
from nag.solving.solve import is_real_zero, solve
from nag.solving.start.family_monodromy import random_values
from nag.text.table import count_text, data_frame, lines_of, named_apart, one_line
from nag.tracking import blocks
from nag.tracking.paths import PathStatus
from nag.tracking.run import DEFAULT_RUN, Run, TellFound, takes_run
from nag.tracking.settings import Settings, find_settings
from nag.tracking.track import track_members

if TYPE_CHECKING:
    import pandas

    from nag.solving.solutions import SolveResult

__all__ = ["FamilySolutions", "family_of", "solve_family_members", "solve_members"]

# Members that are tracked together, and paths; neither changes an answer.
MEMBERS, PATHS = 1000, 1 << 16
# Bytes of the results of one call.
MOST_BYTES = 1 << 34
# Fields of `FamilySolutions` that have a row for each member, but for the values.
ARRAYS = (
    "points",
    "status",
    "errors",
    "one_by_one",
    "complete",
    "is_real",
    "positive_dimensional",
)
# Members that a line names.
NAMED = 5
# Zeros, by Bezout's bound, of a member that is solved without its family, where paths from that are
# lost.
MOST_ZEROS = 10_000


@dataclass(frozen=True, eq=False)
class FamilySolutions(Several[ComplexArray]):
    """The isolated solutions of M members of a family.

    Attributes:
        start: the family solved for random parameters, from where all paths lead.
        values: the members' parameters, shape ``(M, k)``.
        points: solutions, complex, shape ``(M, S, n)``, NaN where a member has fewer than S.
        status: what each is, shape ``(M, S)``: `PathStatus.REGULAR` or ``SINGULAR`` for a solution,
            ``AT_INFINITY`` where a member is complete and has fewer isolated ones, ``FAILED`` where
            that is not known.
        errors: estimated relative errors of the points, shape ``(M, S)``; inf where there is none.
        one_by_one: members that were solved by themselves, shape ``(M,)``.
        complete: members all of whose isolated solutions are here, shape ``(M,)``.
        is_real: which solutions are real, shape ``(M, S)``.
        positive_dimensional: members with a solution set of positive dimension besides, on which a
            path to them ended, shape ``(M,)``; those that were not solved by themselves have one if
            general members do.
        labels: what members are called, by the index of the frame that their values came in; None
            where that counts them from 0, or there was none. They are not compared.
    """

    start: Solved
    values: ComplexArray
    points: ComplexArray
    status: ByteArray
    errors: RealArray
    one_by_one: BooleanArray
    complete: BooleanArray
    is_real: BooleanArray
    positive_dimensional: BooleanArray
    labels: tuple[Hashable, ...] | None = field(default=None, compare=False)

    __eq__ = equal_values

    def __post_init__(self) -> None:
        for name in ("values", *ARRAYS):
            object.__setattr__(self, name, fixed_array(getattr(self, name)))

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the unknowns."""
        return self.start.family.own_variables

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.start.family.parameters

    @property
    def entries(self) -> Sequence[ComplexArray]:
        """The solutions of each member, as `at` has them."""
        return [self.at(k) for k in range(len(self))]

    def __len__(self) -> int:
        return len(self.values)

    def to_numpy(self) -> ComplexArray:
        """All solutions, complex, shape ``(M, S, n)``, NaN where there is none, to be written to.

        The same as `points`, which cannot be written to.
        """
        return self.points.copy()

    __repr__ = one_line

    def __str__(self) -> str:
        all_known = int(self.complete.sum())
        answer = f"{count_text(int(self.counts.sum()), 'solution')} of {len(self)} members"
        infinite = int(self.positive_dimensional.sum())
        if infinite:
            answer += f"; {infinite} with a set of positive dimension besides"
        rows = [
            ("answer", answer),
            ("complete", f"{all_known} of {count_text(len(self), 'member')}"),
        ]
        if self.one_by_one.any():
            rows.append(("by themselves", count_text(int(self.one_by_one.sum()), "member")))
        if infinite:
            rows.append(("infinite", self.name_members(self.positive_dimensional)))
        title = f"FamilySolutions of {', '.join(self.variables)} by {', '.join(self.parameters)}"
        rows += [("note", note) for note in self.start.notes]
        return lines_of(title, rows)

    def name_members(self, chosen: np.ndarray) -> str:
        """Names of the first of some members, shape ``(M,)``, counted from 1, as in all texts."""
        places = np.flatnonzero(chosen).tolist()
        more = " and more" if len(places) > NAMED else ""
        word = "member" if len(places) == 1 else "members"
        named = f"{word} {', '.join(str(k + 1) for k in places[:NAMED])}{more}"
        if self.labels is None:
            return named
        labels = ", ".join(str(self.labels[k]) for k in places[:NAMED])
        return f"{named}, in the index {labels}{more}"

    def to_dataframe(
        self, real: bool = False, *, parts: bool = False, members: bool = False
    ) -> pandas.DataFrame:
        """A row for each solution: its member, parameters, coordinates, and what is known of it.

        The column ``member`` has the index of the frame that the values came in, so that the two
        can be joined on it; of other values it counts members from 0, in their order. A member
        without isolated solutions has no row, whatever else it has.

        Args:
            real: only the real ones, their coordinates as floats.
            parts: two columns of floats for each complex one, ``x.real`` and ``x.imag``, which can
                be written to any file of tables.
            members: a row for each member instead: its parameters, how many solutions it has, and
                what is known of these, as in `document`.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        if members:
            rows = np.arange(len(self))
            own: dict[str, Any] = self._parameters_of(rows)
            facts: dict[str, Any] = self._columns_of_members
        else:
            chosen = self.is_real if real else self.status <= PathStatus.SINGULAR
            rows, places = np.nonzero(chosen)
            points = self.points[rows, places]
            own = self._parameters_of(rows)
            own |= dict(zip(self.variables, (points.real if real else points).T, strict=True))
            facts = {
                "real": self.is_real[rows, places],
                "error": self.errors[rows, places],
                "positive_dimensional": self.positive_dimensional[rows],
            }
        called: Any = rows
        if self.labels is not None:
            called = [self.labels[k] for k in rows.tolist()]
        columns = named_apart(own, {"member": called} | facts)
        first = next(name for name in columns if name not in own)
        return data_frame({first: called} | columns, parts)

    def _parameters_of(self, members: np.ndarray) -> dict[str, Any]:
        """The parameters of some members by their names."""
        # Values that are all real are floats, as they were given.
        values = self.values if self.values.imag.any() else self.values.real
        return dict(zip(self.parameters, values[members].T, strict=True))

    @property
    def _columns_of_members(self) -> dict[str, np.ndarray]:
        """Numbers of solutions of each member, and what is known of these, each ``(M,)``."""
        return {
            "solutions": self.counts,
            "real": self.real_counts,
            "complete": self.complete,
            "one_by_one": self.one_by_one,
            "positive_dimensional": self.positive_dimensional,
        }

    def document(self) -> dict[str, Any]:
        """The numbers of solutions of each member as a JSON object, the solutions left out."""
        columns = self._columns_of_members
        numbers = zip(*(column.tolist() for column in columns.values()), strict=True)
        return {
            "variables": list(self.variables),
            "parameters": list(self.parameters),
            "solutions": len(self.start.points),
            "members": [dict(zip(columns, each, strict=True)) for each in numbers],
        }

    @property
    def real_counts(self) -> IntegerArray:
        """Numbers of distinct real solutions, shape ``(M,)``."""
        return self.is_real.sum(axis=1)

    @property
    def counts(self) -> IntegerArray:
        """Numbers of distinct solutions, shape ``(M,)``."""
        return (self.status <= PathStatus.SINGULAR).sum(axis=1)

    def at(self, member: int) -> ComplexArray:
        """The solutions of one member, shape ``(count, n)``."""
        return self.points[member, self.status[member] <= PathStatus.SINGULAR]

    def real(self, member: int) -> RealArray:
        """The real ones among them, shape ``(count, n)``."""
        return self.points[member, self.is_real[member]].real


@takes_run
def solve_family_members(
    family: Family,
    values: Any,
    *,
    start: str = "auto",
    count: int | None = None,
    known: tuple[Any, Any] | None = None,
    labels: tuple[Hashable, ...] | None = None,
    run: Run = DEFAULT_RUN,
) -> FamilySolutions:
    """The isolated solutions of many members of a family, see `nag.solve_family`.

    Args:
        family: the equations and their parameters.
        values: of each member, see `check_values`.
        start, count, known: as for `nag.solve_family`.
        labels: what members are called, see `FamilySolutions`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if family and values do not fit each other.
        nag.StartError: if the family cannot be solved that way.
    """
    wanted = check_values(family, values, labels)
    if known is None:
        solved = solve_generic(family, start=start, count=count, run=run.without_found)
    else:
        solved = _solve_from_known(family, known, count, run)
    return solve_members(solved, wanted, labels, run=run)


def family_of(
    equations: Any,
    parameters: Any,
    variables: Any = None,
    imaginary: str | None = None,
) -> Family:
    """The family that equations, or a system, and the names of parameters define.

    Raises:
        NagError: if equations and unknowns are not as many, or a parameter has a wrong name.
    """
    names = list_names(parameters)
    if isinstance(equations, PolynomialSystem):
        given = equations
        if variables is not None or imaginary is not None:
            name = "imaginary" if variables is None else "variables"
            raise NagError(f"{name}: is for equations; a system has its own, leave it out")
        for name in names:
            if name not in given.own_variables:
                known = ", ".join(given.own_variables)
                raise NagError(f"parameters: {name!r} does not occur; the names are {known}")
        if given.nonzero:
            raise NagError("system: some polynomials must not vanish there; give equations alone")
        # The unit's own equation is made anew.
        equations = given.text()[: len(given.polynomials) - given.imaginary]
        variables = [name for name in given.own_variables if name not in names]
        imaginary = given.variables[-1] if given.imaginary else None
    if variables is None:
        found = system(equations, imaginary=imaginary).own_variables
        unknowns = [name for name in found if name not in names]
        missing = [name for name in names if name not in found]
        if missing:
            raise NagError(f"parameters: {missing[0]!r} does not occur in the equations")
    else:
        unknowns = list(system("0", variables).variables)
    made = system(equations, [*unknowns, *names], imaginary=imaginary)
    return Family.of_system(made, len(names))


def labels_of(values: Any) -> tuple[Hashable, ...] | None:
    """The index of a DataFrame or a Series, unless that counts from 0; None of other values."""
    index: Any = getattr(values, "index", None)
    if not hasattr(index, "tolist"):
        return None
    labels = tuple(index.tolist())
    return None if labels == tuple(range(len(labels))) else labels


def check_values(
    family: Family, values: Any, labels: tuple[Hashable, ...] | None = None
) -> np.ndarray:
    """Values of the parameters as an array of complex doubles, shape ``(M, k)``.

    Args:
        labels: what members are called, see `FamilySolutions`.

    Raises:
        NagError: if they are no finite numbers, or not as many as parameters.
    """
    k = len(family.parameters)
    if hasattr(values, "keys") and np.ndim(values) != 1:
        values = _columns_by_name(family.parameters, values)
    try:
        if _are_truth_values(values):
            raise NagError("values: True or False is among them; give numbers")
        array = np.asarray(_without_texts(values), dtype=np.complex128)
    except OverflowError:
        raise NagError("values: are too large; give numbers up to 1e308") from None
    except NagError:
        raise
    except (TypeError, ValueError):
        raise NagError("values: are no numbers; give an array of shape (members, k)") from None
    if array.ndim == 1 and k == 1:
        array = array[:, None]
    if array.ndim != 2 or array.shape[1] != k:
        raise NagError(
            f"values: have shape {array.shape}; give {count_text(k, 'parameter')} for each member, "
            f"shape (members, {k})"
        )
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(wrong):
        called = "" if labels is None else f", {labels[wrong[0]]} in the index,"
        raise NagError(f"values: those of member {wrong[0] + 1}{called} are not all finite")
    return array


def _are_truth_values(values: Any) -> bool:
    """Whether one of many values is True or False."""
    array = np.asarray(values)
    if array.dtype != object:
        # Of a list that has others as well NumPy makes numbers.
        listed = values if isinstance(values, list | tuple) else ()
        rows = (row if isinstance(row, list | tuple) else (row,) for row in listed)
        return array.dtype == bool or any(isinstance(x, bool) for row in rows for x in row)
    return any(isinstance(x, bool) for x in array.ravel().tolist())


def _without_texts(values: Any) -> Any:
    """Values with texts like "1/3" as complex doubles."""
    array = np.asarray(values)
    if array.dtype.kind not in "OU":
        return values
    numbers = [
        complex(exact_complex(x, "values")) if isinstance(x, str) else x
        for x in array.ravel().tolist()
    ]
    return np.array(numbers, dtype=object).reshape(array.shape)


def read_columns(table: Any) -> dict[str, np.ndarray]:
    """The columns of a table by their names.

    Raises:
        NagError: if one is no list of values.
    """
    columns = {str(name): np.asarray(table[name]) for name in table.keys()}  # noqa: SIM118
    for name, column in columns.items():
        if column.ndim != 1:
            raise NagError(f"values: column {name!r} is no list; give a number for each member")
    return columns


def _columns_by_name(parameters: Sequence[str], table: Any) -> np.ndarray:
    """The columns of a table, in the order of the parameters.

    Raises:
        NagError: if one is missing, or is of no parameter.
    """
    names = [str(name) for name in table.keys()]  # noqa: SIM118, of a DataFrame the columns
    for name in parameters:
        if names.count(name) != 1:
            raise NagError(f"values: {names.count(name)} columns have the name {name!r}; give one")
    for name in names:
        if name not in parameters:
            raise NagError(
                f"values: column {name!r} is no parameter, leave it out; they are "
                f"{', '.join(parameters)}"
            )
    columns = read_columns(table)
    if len({column.shape for column in columns.values()}) != 1:
        raise NagError("values: the columns have different lengths")
    return np.stack([columns[name] for name in parameters], axis=-1)


def _solve_from_known(
    family: Family, known: tuple[Any, Any], count: int | None, run: Run
) -> Solved:
    """The family at random parameters, by paths from a member whose solutions are known."""
    check_count(count)
    n = len(family.own_variables)
    try:
        first, solutions = known
        here = check_values(family, [first])[0]
        points = np.asarray(solutions, dtype=np.complex128)
    except (TypeError, ValueError):
        raise NagError(
            f"known: give values of the parameters and solutions there, shape (S, {n}), in a pair"
        ) from None
    if points.ndim != 2 or points.shape[1] != n or not np.isfinite(points).all():
        raise NagError(f"known: solutions have shape {points.shape}, not (S, {n}), or holes")
    points = append_unit(points) if family.imaginary else points
    there = random_values(family, run.random())
    ends = move_regular(family, here, points, there, run)
    if len(ends) < len(points):
        lost = len(points) - len(ends)
        raise StartError(f"known: {lost} of {len(points)} solutions are not regular, or none")
    detail = f"{len(points)} known solutions"
    return compare_with_count(Solved(family, there, ends, len(points) == count, detail), count, run)


class _Block(NamedTuple):
    """What became of some members' paths, see `FamilySolutions`; ``proved``: shape ``(m,)``."""

    points: np.ndarray
    errors: np.ndarray
    proved: np.ndarray


class _Alone(NamedTuple):
    """A member that was solved by itself, see `FamilySolutions`."""

    points: np.ndarray
    status: np.ndarray
    errors: np.ndarray
    is_real: np.ndarray
    complete: bool
    positive_dimensional: bool


@takes_run
def solve_members(
    solved: Solved,
    values: Any,
    labels: tuple[Hashable, ...] | None = None,
    *,
    run: Run = DEFAULT_RUN,
) -> FamilySolutions:
    """The members of a family that is solved for random parameters.

    Args:
        solved: by `nag.solving.parameter.solve_generic`.
        values: the parameters of each member, shape ``(M, k)``.
        labels: what members are called, see `FamilySolutions`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if the values do not fit the family.
    """
    family, S = solved.family, len(solved.points)
    values = check_values(family, values, labels)
    M = len(values)
    if M * S * (16 * family.n + 10) > MOST_BYTES:
        raise NagError(f"values: {M} members of {S} solutions are too many at once; give fewer")
    places = np.full((M, S, family.n), np.nan, dtype=np.complex128)
    # The imaginary unit is a coordinate of the paths, and none of the points.
    points = places[..., : len(family.own_variables)]
    status = np.full((M, S), PathStatus.FAILED, dtype=np.int8)
    errors = np.full((M, S), np.inf)
    proved = np.zeros(M, dtype=bool)
    one_by_one = np.zeros(M, dtype=bool)
    complete = np.zeros(M, dtype=bool)
    is_real = np.zeros((M, S), dtype=bool)
    infinite = np.zeros(M, dtype=bool)
    arrays = (points, status, errors, one_by_one, complete, is_real, infinite)
    done = 0

    def of_arrays(
        own: np.ndarray, columns: Iterable[np.ndarray], called: tuple[Hashable, ...] | None
    ) -> FamilySolutions:
        named: dict[str, Any] = dict(zip(ARRAYS, columns, strict=True))
        return FamilySolutions(solved, own, labels=called, **named)

    def first_members() -> FamilySolutions:
        # What is told stays as it is, while the others are solved.
        called = None if labels is None else labels[:done]
        return of_arrays(values[:done].copy(), (a[:done].copy() for a in arrays), called)

    # What is under way ends before what was found is told.
    with TellFound(run, first_members) as tell, closing(_track_all(solved, values, run)) as tracked:
        for chunk, block in tracked:
            places[chunk], errors[chunk], proved[chunk] = block
            status[chunk][block.proved] = PathStatus.REGULAR
            complete[chunk] = block.proved & solved.complete
            infinite[chunk] = block.proved & solved.positive_dimensional
            is_real[chunk] = _which_are_real(solved, values[chunk], block)
            done += len(block.proved)
            run.tell("members", done, M)
            tell(done < M or not proved.all())
        one_by_one[:] = ~proved
        alone = np.flatnonzero(~proved)
        for number, member in enumerate(alone.tolist()):
            run.tell("members one by one", number, len(alone))
            own = _solve_alone(solved, values[member], run)
            places[member], status[member], errors[member] = own.points, own.status, own.errors
            is_real[member], complete[member] = own.is_real, own.complete
            infinite[member] = own.positive_dimensional
            tell(number + 1 < len(alone))
    # The values may be the caller's; the others are nobody else's, and large.
    return of_arrays(values, (handed_over(array) for array in arrays), labels)


def _which_are_real(solved: Solved, values: np.ndarray, block: _Block) -> np.ndarray:
    """Which solutions of some members are real, shape ``(m, S)``; of unproved ones none is said.

    Of real equations the conjugate of a zero is a zero: where as many as there can be are distinct,
    one whose conjugate is no other one is real; where there may be more, its conjugate may be one
    of these, and its error alone decides. Of complex ones exact equations decide.
    """
    family, points, errors = solved.family, block.points, block.errors
    real = np.zeros(errors.shape, dtype=bool)
    has_complex = values.imag.any(axis=1) | family.imaginary
    chosen = block.proved & ~has_complex
    if solved.complete:
        real[chosen] = which_members_are_real(points[chosen], errors[chosen])
    else:
        within = are_within_errors(points[chosen].reshape(-1, family.n), errors[chosen].ravel())
        real[chosen] = within.reshape(-1, errors.shape[1])
    own = points[..., : len(family.own_variables)]
    for k in np.flatnonzero(block.proved & has_complex).tolist():
        near = np.flatnonzero(are_within_errors(own[k], errors[k])).tolist()
        if near:
            exact = [exact_complex(v, "values") for v in values[k].tolist()]
            system = family.with_unit().at(exact)
            both, parts = as_real(system), real_and_imaginary_parts(system).polynomials
            real[k, near] = [
                is_real_zero(np.append(own[k, i], 1j), float(errors[k, i]), both, parts)
                for i in near
            ]
    return real


def _track_all(
    solved: Solved, values: np.ndarray, run: Run
) -> Generator[tuple[slice, _Block], None, None]:
    """All members in chunks, each the same whatever the others are."""
    S = len(solved.points)
    size = max(1, min(MEMBERS, PATHS // max(S, 1)))
    chunks = [slice(first, first + size) for first in range(0, len(values), size)]
    lines = MemberLines(solved.family, solved.values)
    if blocks.in_blocks():
        settings = find_settings(run.settings)
        calls = [(lines, solved.points, values[chunk], settings) for chunk in chunks]
        done = blocks.work_out(block_of_members, calls, "members", run.threads)
        yield from ((c, _Block(**arrays)) for c, (arrays, _) in zip(chunks, done, strict=True))
        return
    work = partial(_track_chunk, lines, solved.points, settings=run.settings)
    if run.threads == 1 or len(chunks) < 2:
        made = (work(values[chunk], threads=run.threads) for chunk in chunks)
        yield from zip(chunks, made, strict=True)
        return
    # What is made once is made before threads share it.
    chunk = chunks[0]
    yield chunk, work(values[chunk], threads=run.threads)
    pool = ThreadPoolExecutor(run.threads)
    try:
        rest = chunks[1:]
        yield from zip(rest, pool.map(work, [values[chunk] for chunk in rest]), strict=True)
    finally:
        # Who interrupts does not wait for the chunks that are being worked out.
        pool.shutdown(wait=False, cancel_futures=True)


def block_of_members(
    lines: MemberLines,
    solutions: np.ndarray,
    values: np.ndarray,
    settings: Settings,
    threads: int = 1,
) -> dict[str, np.ndarray]:
    """Some members, see `_Block`."""
    return _track_chunk(lines, solutions, values, settings, threads)._asdict()


def _track_chunk(
    lines: MemberLines,
    solutions: np.ndarray,
    values: np.ndarray,
    settings: Any = "default",
    threads: int = 1,
) -> _Block:
    """Some members' paths; a member is proved if each of its paths has a regular end of its own."""
    m, S, n = len(values), len(solutions), lines.family.n
    line = lines.to(values)
    starts = np.tile(line.starts(solutions), (m, 1))
    member = np.repeat(np.arange(m, dtype=np.int64), S)
    paths = track_members(line.homotopy, starts, member, settings, threads)
    points = line.affine(paths.points).reshape(m, S, n)
    errors = paths.accuracy.reshape(m, S)
    proved = (paths.status.reshape(m, S) == PathStatus.REGULAR).all(axis=1)
    proved &= np.isfinite(points).all(axis=(1, 2))
    proved[proved] = _are_distinct(points[proved], errors[proved])
    # Where there are no paths, none of them tells what else a member has.
    proved &= S > 0
    points[~proved], errors[~proved] = np.nan, np.inf
    return _Block(points, errors, proved)


def _are_distinct(points: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """Which members' solutions are all distinct for certain, shape ``(m,)``.

    Points that coincide have neighbours in a projection that do.
    """
    m, S, n = points.shape
    flat = points.reshape(m * S, n)
    radii = radii_of_balls(flat, errors.ravel()).reshape(m, S)
    weights = np.exp(1j * np.arange(1, n + 1) ** 2) / np.sqrt(n)
    keys = (points @ weights).real
    order = np.argsort(keys, axis=1)
    keys = np.take_along_axis(keys, order, axis=1)
    widest = radii.max(axis=1, initial=0.0)
    near = (np.diff(keys, axis=1) <= 2 * widest[:, None]).any(axis=1)
    distinct = np.ones(m, dtype=bool)
    for k in np.flatnonzero(near).tolist():
        apart = np.linalg.norm(points[k, :, None] - points[k, None], axis=2)
        np.fill_diagonal(apart, np.inf)
        distinct[k] = not (apart <= radii[k][:, None] + radii[k][None]).any()
    return distinct


def _solve_alone(solved: Solved, values: np.ndarray, run: Run) -> _Alone:
    """One member by itself."""
    S, n = len(solved.points), solved.family.n
    points = np.full((S, n), np.nan, dtype=np.complex128)
    status = np.full(S, PathStatus.FAILED, dtype=np.int8)
    errors = np.full(S, np.inf)
    is_real = np.zeros(S, dtype=bool)
    exact = [exact_complex(v, "values") for v in values.tolist()]
    alone = replace(run, progress=None, found=None)
    (result,) = solve_targets(replace(solved, classes=None), [exact], run=alone)
    # Without paths nothing is seen of the member.
    if result.paths.failed or not S:
        result = _solve_without_family(result, solved.family.at(exact), alone)
    found = result.solutions[:S]
    for i, each in enumerate(found):
        points[i], errors[i], is_real[i] = each.point[:n], each.accuracy, each.real
        status[i] = PathStatus.REGULAR if each.multiplicity == 1 else PathStatus.SINGULAR
    whole = result.complete and len(result.solutions) <= S
    if whole:
        status[len(found) :] = PathStatus.AT_INFINITY
    return _Alone(points, status, errors, is_real, whole, result.positive_dimensional)


def _solve_without_family(result: SolveResult, system: PolynomialSystem, run: Run) -> SolveResult:
    """The better answer, of that to which paths from random parameters led and one without these.

    Doubles do not resolve the way from random parameters to ones of another size altogether; the
    system by itself is solved in coordinates that suit it.
    """
    bound = bound_of_zeros(system)[0]
    if bound is None or bound > MOST_ZEROS:
        return result
    try:
        other = solve(system, run=run)
    except StartError:
        return result
    better = other.complete or len(other.solutions) > len(result.solutions)
    return other if better else result
