"""Decompositions for many values of a parameter: one is found, the others are followed from it.

The components for a general value are cut by their slices; the parameter goes to a random complex
value and from there to each given one, and the witness points with it (Morgan & Sommese,
Coefficient-parameter polynomial continuation, 1989). Where all arrive at regular points they are
split anew, as a component may fall apart at a special value; where not, the value is special and is
decomposed by itself.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import takewhile
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.family import Family
from nag.algebra.interpolation import family_of
from nag.algebra.number import number_text
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.decomposition.given_points import components_through_points
from nag.numerics.read_only import Several, equal_values
from nag.numerics.zero_values import ON
from nag.solving.parameter_line import parameter_line
from nag.text.json_text import lay_out
from nag.text.progress import REMARK, stage_text
from nag.text.table import align, count_text, data_frame, known_or_nan, named_apart, named_line
from nag.tracking import blocks
from nag.tracking.paths import PathStatus
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.tracking.track import track
from nag.witness.witness import Decomposition, WitnessSet

if TYPE_CHECKING:
    import pandas

SystemAt = Callable[[Fraction], PolynomialSystem]

# Values to learn from are fractions of the interval with this denominator, off the given ones.
GRID = 1009


@dataclass(frozen=True, eq=False)
class Swept:
    """The components for one value of the parameter.

    Attributes:
        value: of the parameter.
        decomposition: the components; of those that were followed, not with others that only this
            value may have.
        followed: whether they were followed from a general value.
        paths: number of paths tracked for this value.
        reason: why they were not followed; empty otherwise.
    """

    value: Fraction
    decomposition: Decomposition
    followed: bool
    paths: int
    reason: str = ""

    __eq__ = equal_values

    def __repr__(self) -> str:
        number, _, _, answer = self.row()
        return f"Swept({number}: {answer})"

    @property
    def complete(self) -> bool:
        """Whether the components are all that there are, as far as they are looked for."""
        return self.decomposition.complete

    def row(self) -> list[str]:
        """The value, how its components were found, paths, and the components."""
        from nag.witness.shown import kinds, kinds_text

        answer = kinds_text(kinds(self.decomposition.components))
        if not self.decomposition.complete:
            answer += " (INCOMPLETE)"
        how = "followed" if self.followed else "by itself"
        return [number_text(self.value), how, str(self.paths), answer]

    def document(self) -> dict[str, Any]:
        """The value and its components as a JSON object, witness sets left out."""
        answer = self.decomposition
        return {
            "value": number_text(self.value),
            "followed": self.followed,
            "reason": self.reason,
            "paths": self.paths,
            "complete": answer.complete,
            "notes": list(answer.notes),
            "components": [
                {"dimension": c.dimension, "degree": c.degree, "multiplicity": c.multiplicity or 0}
                for c in answer.components
            ],
        }


@dataclass(frozen=True, eq=False)
class Sweep(Several[Swept]):
    """The components for many values of a parameter.

    Attributes:
        parameter: its name.
        members: the components for each value.
    """

    parameter: str
    members: tuple[Swept, ...]

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[Swept, ...]:
        """The components for each value."""
        return self.members

    @property
    def complete(self) -> bool:
        """Whether those for every value are complete."""
        return all(each.decomposition.complete for each in self.members)

    def document(self) -> dict[str, Any]:
        """The components for each value as a JSON object, witness sets left out."""
        values = [each.document() for each in self.members]
        return {"parameter": self.parameter, "count": len(values), "values": values}

    @property
    def followed_count(self) -> int:
        """For how many values the components were followed from a general one."""
        return sum(each.followed for each in self.members)

    def rows(self) -> list[list[str]]:
        """Headings, and a row for each value."""
        return [[self.parameter, "", "paths", "components"], *(each.row() for each in self.members)]

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each component for each value.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        found = [(each, c) for each in self.members for c in each.decomposition]
        own = {self.parameter: [float(each.value) for each, _ in found]}
        return data_frame(
            named_apart(
                own,
                {
                    "dimension": [c.dimension for _, c in found],
                    "degree": [c.degree for _, c in found],
                    "multiplicity": known_or_nan([c.multiplicity for _, c in found]),
                },
            )
        )

    def __repr__(self) -> str:
        values = count_text(len(self.members), "value")
        return named_line(self, f": {values} of {self.parameter}, {self.followed_count} followed")

    def __str__(self) -> str:
        return "\n".join(align(self.rows(), (1, 3)))


@dataclass(frozen=True, eq=False)
class _General:
    """The components for a random complex value, each as a family of square systems."""

    value: complex
    variables: tuple[str, ...]
    members: tuple[tuple[Family, np.ndarray, int], ...]


@takes_run
def sweep(
    system_at: SystemAt,
    values: Sequence[Fraction],
    *,
    run: Run = DEFAULT_RUN,
) -> list[Swept]:
    """The components of a system for each value of a parameter.

    Components that are there for single values only are not looked for, unless the others cannot
    be followed there.

    Args:
        system_at: the exact system at a rational value.
        values: each is worked out once, however often it is there.
        run: how it is worked out; its ``found`` is told of the values that are done.
    """
    told, run = run.found, run.without_found
    how, rng = run, run.random(Stream.SWEEP)
    distinct = list(dict.fromkeys(values))
    general, reason = None, "a single value: there is no other one to follow components from"
    if len(distinct) > 1:
        general, reason = _general(system_at, distinct, rng, run)
    swept: dict[Fraction, Swept] = {}
    for k, value in enumerate(distinct):
        system = system_at(value)
        run = _tell_as_value(how, k, len(distinct))
        call = general, reason, system, value
        read = partial(_unpack_member, system, run)
        swept[value] = blocks.keep_result(_find_components_at, call, run, _pack_member, read)
        if told is not None and len(swept) < len(distinct):
            # In the order of the values, as far as each is known.
            told([swept[each] for each in takewhile(swept.__contains__, values)])
    return [swept[value] for value in values]


def _tell_as_value(run: Run, done: int, count: int) -> Run:
    """The same run, whose progress is told as that of the sweep."""
    if not callable(run.progress):
        return run

    def tell(stage: str, step: int, steps: int) -> None:
        run.tell(f"values{REMARK}{stage_text(stage, step, steps)}", done, count)

    return replace(run, progress=tell)


def _find_components_at(
    general: _General | None, reason: str, system: PolynomialSystem, value: Fraction, run: Run
) -> Swept:
    """The components at a value: followed from a general one, unless there is a reason not to."""
    starts, paths, why = [], 0, reason
    if general is not None:
        starts, paths, why = _follow_components(general, system, value, run)
    if not why:
        answer = components_through_points(system, starts, run=run)
        paths += answer.paths.tracked
        if not answer.complete:
            why = "special value: the points that arrive are not general ones"
    if why:
        answer = decompose(system, run=run)
        paths += answer.paths.tracked
    return Swept(value, answer, not why, paths, why)


def _decompose_alone(system: PolynomialSystem, run: Run) -> Decomposition:
    return decompose(system, run=run)


def _pack(answer: Decomposition) -> dict[str, np.ndarray]:
    """Components as a block: their document, and what that leaves out."""
    return {"document": _bytes(answer.document()), "algebraic": np.array(answer.algebraic)}


def _unpack(system: PolynomialSystem, run: Run, block: Mapping[str, np.ndarray]) -> Decomposition:
    """The components of a system that `_pack` made a block of."""
    answer = Decomposition.of_document(json.loads(block["document"].tobytes()))
    algebraic = bool(block["algebraic"])
    return replace(answer, system=system, settings=run.settings, algebraic=algebraic)


def _pack_member(swept: Swept) -> dict[str, np.ndarray]:
    """The components for a value as a block, and how they were found."""
    return {**_pack(swept.decomposition), "member": _bytes(swept.document())}


def _unpack_member(system: PolynomialSystem, run: Run, block: Mapping[str, np.ndarray]) -> Swept:
    """What `_pack_member` made a block of."""
    told = json.loads(block["member"].tobytes())
    answer = _unpack(system, run, block)
    return Swept(Fraction(told["value"]), answer, told["followed"], told["paths"], told["reason"])


def _bytes(document: dict[str, Any]) -> np.ndarray:
    return np.frombuffer(lay_out(document).encode(), dtype=np.uint8)


def _general(
    system_at: SystemAt, values: Sequence[Fraction], rng: np.random.Generator, run: Run
) -> tuple[_General | None, str]:
    """The components for a random complex value, or why they cannot be followed."""
    first, last = min(values), max(values)

    def places(count: int) -> list[Fraction]:
        steps = [2 * (k * (GRID // 2) // count) + 1 for k in range(count)]
        return [first + (last - first) * Fraction(k, GRID) for k in steps]

    polynomials = family_of(system_at, places)
    if polynomials is None:
        return None, "the equations are no rational functions of the parameter"
    start = first + (last - first) * Fraction(int(rng.integers(1, 10**6)), 10**6 + 3)
    system = system_at(start)
    read = partial(_unpack, system, run)
    answer = blocks.keep_result(_decompose_alone, (system,), run, _pack, read)
    if not answer.complete:
        return None, "the components for a general value are not all known"
    if not answer.components:
        return None, "there is no component for a general value"
    if any(c.multiplicity != 1 for c in answer.components):
        return None, "a component for a general value is not simple"
    target = complex(start) + complex(float(last - first)) * complex(
        rng.uniform(-0.5, 0.5), rng.uniform(0.25, 0.5)
    )
    members = []
    for component in answer.components:
        family = _cut_family(system, polynomials, component, rng)
        line = parameter_line(family, [complex(start)], [target])
        paths = track(line.homotopy, line.starts(component.points), run.settings)
        regular = paths.where(PathStatus.REGULAR)
        if len(regular) < component.degree:
            return None, "a component could not be followed to a complex value"
        members.append((family, line.affine(paths.points), component.dimension))
    return _General(target, system.variables, tuple(members)), ""


def _cut_family(
    system: PolynomialSystem,
    polynomials: Sequence[Polynomial],
    component: WitnessSet,
    rng: np.random.Generator,
) -> Family:
    """As many combinations of the equations as the component has codimension, and its slice."""
    n, d = system.n, component.dimension
    equations = list(polynomials)
    if len(equations) > n - d:
        mixed = []
        for _ in range(n - d):
            weights = [Fraction(int(w), 128) for w in rng.integers(32, 129, len(equations))]
            signs = rng.choice([-1, 1], len(equations))
            total = Polynomial(n + 1, {})
            for f, w, sign in zip(equations, weights, signs, strict=True):
                total = total + f * (w * int(sign))
            mixed.append(total)
        equations = mixed
    for row in component.slice.rows:
        terms = {(0,) * (n + 1): complex(row[0])}
        for i in range(n):
            terms[tuple(int(j == i) for j in range(n + 1))] = complex(row[i + 1])
        equations.append(Polynomial.of_doubles(n + 1, terms))
    return Family(system.variables, ("parameter",), tuple(equations))


def _follow_components(
    general: _General, system: PolynomialSystem, value: Fraction, run: Run
) -> tuple[list[tuple[int, np.ndarray]], int, str]:
    """The components' points at a value; the number of paths; why it is special, if it is."""
    if system.variables != general.variables:
        return [], 0, "special value: it has equations in other variables"
    evaluator = Evaluator.of(system.polynomials, system.n)
    starts: list[tuple[int, np.ndarray]] = []
    count = 0
    for family, points, dimension in general.members:
        line = parameter_line(family, [general.value], [value])
        paths = track(line.homotopy, line.starts(points), run.settings, run.threads)
        count += len(points)
        if len(paths.where(PathStatus.REGULAR)) < len(points):
            return [], count, "special value: not all points stay regular and finite"
        ends = line.affine(paths.points)
        if not (evaluator.residuals(ends) < ON).all():
            return [], count, "special value: points leave the set"
        starts += [(dimension, x) for x in ends]
    return starts, count, ""
