"""One problem, whatever it is given as: a system, and what its solutions are configurations of.

Equations, mechanisms, their models, parts that may be assembled, tables by Denavit and Hartenberg
and cases of all of these come down to a `Problem`. What solves, decomposes, moves or reports one
asks the problem, and never again what it was given as.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from nag.algebra.from_python import system as system_of_equations
from nag.algebra.given import is_a
from nag.algebra.number import Number
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import NamedPoint, PolynomialSystem
from nag.errors import NagError
from nag.mechanism.assembly import AssemblyModel
from nag.tracking.run import DEFAULT_RUN, Run, takes_run

if TYPE_CHECKING:
    from nag.algebra.symmetric_family import FamilyMember
    from nag.mechanism.axes import Space
    from nag.mechanism.configuration import Configuration
    from nag.mechanism.mobility_report import Alike
    from nag.mechanism.model import Model
    from nag.witness.witness import Decomposition


class FormulationError(NagError):
    """A formulation is asked for of what has none."""


@dataclass(frozen=True)
class Problem:
    """An exact system, and what its solutions are configurations of.

    Attributes:
        system: the equations.
        symmetries: signed permutations of its variables that keep it.
        points: solutions that have a name.
        family: the one that the system is declared to belong to.
        model: what the equations are those of, a mechanism at a reference configuration or parts
            that may be assembled; None for equations by themselves.
    """

    system: PolynomialSystem
    symmetries: tuple[SignedPermutation, ...] = ()
    points: tuple[NamedPoint, ...] = ()
    family: FamilyMember | None = None
    model: Model | AssemblyModel | None = None

    @property
    def parts(self) -> AssemblyModel | None:
        """The model of parts of which it is not given how they are assembled."""
        return self.model if isinstance(self.model, AssemblyModel) else None

    @property
    def mechanism(self) -> Model | None:
        """The model of a mechanism at its reference configuration."""
        return None if isinstance(self.model, AssemblyModel) else self.model

    @property
    def reference(self) -> tuple[Number, ...] | None:
        """A configuration that is known, an exact solution."""
        return None if self.model is None or not self.model.reference else self.model.reference

    @property
    def named(self) -> list[tuple[str, tuple[Number, ...]]]:
        """The points as they are called in sentences."""
        return [(point.called or point.name, point.at) for point in self.points]

    @property
    def formulation(self) -> str | None:
        """Name of the formulation; None for equations, and for parts that have coordinates only."""
        return None if self.model is None else self.model.formulation

    @property
    def freedoms_left_out(self) -> tuple[tuple[int, str], ...]:
        """Freedoms that every configuration has besides those of `system`, and whose they are."""
        return () if self.model is None else self.model.freedoms_left_out

    @property
    def space(self) -> Space | None:
        """In which everything moves, what is in no loop included; None for equations."""
        made = self.mechanism
        if made is not None:
            from nag.mechanism.axes import space_of

            return space_of(made.mechanism.joints)
        return None if self.parts is None else self.parts.space

    @property
    def free(self) -> int:
        """How many freedoms every configuration has besides."""
        return sum(count for count, _ in self.freedoms_left_out)

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution, as `nag.model`'s lift gives them.

        Raises:
            NagError: if the system is not that of a mechanism.
        """
        if self.mechanism is None:
            raise NagError("lift: only mechanisms at a reference configuration have bodies")
        return self.mechanism.lift(point)

    @takes_run
    def decompose(
        self,
        *,
        run: Run = DEFAULT_RUN,
        symmetries: Sequence[SignedPermutation] | None = None,
    ) -> Decomposition:
        """The components of the system, found in the coordinates that take fewest paths.

        Args:
            run: how it is worked out; ``seed=1`` and the like stand for a run.
            symmetries: those that are used, all by default.
        """
        used = self.symmetries if symmetries is None else symmetries
        if is_a(self.model, "nag.mechanism.framework_model", "FrameworkModel"):
            from nag.mechanism.framework_decomposition import decompose_framework

            return decompose_framework(self.model, run=run, symmetries=used)  # type: ignore[arg-type]
        from nag.decomposition.components import decompose

        return decompose(self.system, run=run, symmetries=used)


def problem_of(given: Any, variables: Any = None, *, formulation: str = "auto") -> Problem:
    """The problem that a mechanism, a model, parts, a case, a system or equations describe.

    Args:
        given: any of these, or a problem, which is taken as it is.
        variables: of equations, their names in order.
        formulation: of a mechanism as for `nag.model`, or of a table: ``"H"`` or ``"E"``.

    Raises:
        FormulationError: if a formulation is asked for of what has none.
        nag.mechanism.model.ModelError: if a mechanism has no loop, or no such formulation.
        nag.mechanism.dh.DHError: if a table has no such formulation.
        NagError: if ``given`` is none of these, or an equation is no polynomial.
    """
    problem = _describe_problem(given, formulation)
    if problem is None:
        check_formulation(formulation)
        return Problem(system_of_equations(given, variables))
    if variables is not None:
        raise NagError("variables: are for equations; what is given has its own, leave them out")
    return problem


def _describe_problem(given: Any, formulation: str) -> Problem | None:
    """What describes a problem without being equations; None if these are given."""
    if is_a(given, "nag.files.cases", "Case"):
        made = problem_of(given.described, formulation=formulation)
        return replace(
            made,
            symmetries=made.symmetries or given.symmetries,
            points=given.points or made.points,
            family=given.family,
        )
    if is_a(given, "nag.mechanism.graph", "Mechanism"):
        from nag.mechanism.model import model

        return _of_model(model(given, formulation))
    if is_a(given, "nag.mechanism.model", "Model"):
        if formulation not in ("auto", given.formulation):
            return problem_of(given.mechanism, formulation=formulation)
        return _of_model(given)
    if isinstance(given, AssemblyModel):
        return _of_parts(given, formulation)
    if isinstance(given, Problem):
        if formulation != "auto" and given.model is not None:
            return problem_of(given.model, formulation=formulation)
        check_formulation(formulation)
        return given
    if isinstance(given, PolynomialSystem):
        check_formulation(formulation)
        return Problem(given)
    if is_a(given, "networkx", "Graph"):
        raise NagError(
            "system: a networkx graph is given; make it a mechanism first: "
            "nag.Mechanism.from_graph(graph, ground=...)"
        )
    if given is None or isinstance(given, Mapping | bool | int | float):
        raise NagError(
            f"system: something of type {type(given).__name__} is given; give equations in a list, "
            "or a nag.PolynomialSystem, nag.Mechanism, nag.Case, or a model"
        )
    return None


def check_formulation(formulation: str) -> None:
    """Make sure that no formulation is asked for of what has none.

    Raises:
        FormulationError: if one is.
    """
    if formulation != "auto":
        raise FormulationError(f"formulation {formulation}: is for mechanisms and tables")


def _of_model(made: Model) -> Problem:
    # Other assembly modes have no reference configuration.
    reference = NamedPoint("reference", tuple(made.reference), "the reference configuration")
    points = (reference,) if made.reference else ()
    return Problem(made.system, tuple(made.symmetries), points, model=made)


def _of_parts(parts: AssemblyModel, formulation: str) -> Problem:
    if formulation not in ("auto", parts.formulation):
        if parts.formulation is None:
            check_formulation(formulation)
        from nag.mechanism.dh_euler import table_model

        parts = table_model(parts.loop, formulation)  # type: ignore[attr-defined]
    known = () if parts.reference is None else (NamedPoint("placement", parts.reference),)
    return Problem(parts.system, tuple(parts.symmetries), known, model=parts)


def carry_to_euler(
    problem: Problem, decomposition: Decomposition, *, threads: int = 1
) -> tuple[Problem, Decomposition]:
    """A problem in Euler parameters and its components, from those in its own formulation."""
    if problem.formulation == "E":
        return problem, decomposition
    if problem.mechanism is not None:
        from nag.mechanism.coordinates import euler_decomposition

        made, carried = euler_decomposition(problem.mechanism, decomposition, threads=threads)
        return problem_of(made), carried
    from nag.mechanism.dh_euler import euler_closings

    parts, carried = euler_closings(problem.model, decomposition, threads=threads)  # type: ignore[arg-type]
    return problem_of(parts), carried


def in_real_coordinates(problem: Problem) -> Problem:
    """The same in coordinates in which a real configuration has real coordinates."""
    if not is_a(problem.model, "nag.mechanism.framework_model", "FrameworkModel"):
        return problem
    from nag.mechanism.framework_model import cartesian_model

    return problem_of(cartesian_model(problem.model.framework))  # type: ignore[union-attr]


@dataclass(frozen=True)
class OtherEquations:
    """A problem in other equations, to compare what both say.

    Attributes:
        name: of its formulation or its coordinates.
        problem: in them.
        at: the configuration in its variables; None if none was given.
        alike: what of the components is the same in both.
    """

    name: str
    problem: Problem
    at: tuple[Number, ...] | None
    alike: Alike


def other_equations(
    problem: Problem, at: Sequence[Number] | None = None
) -> Iterator[OtherEquations]:
    """Other equations of the same mechanism or parts: formulations, or coordinates.

    Args:
        at: a configuration in the variables of the problem; where it cannot be carried over, there
            are none.
    """
    if problem.mechanism is not None:
        yield from () if at is not None else _other_formulations(problem.mechanism)
    elif problem.formulation == "H":
        other = problem_of(problem, formulation="E")
        there = None if at is None else tuple(other.model.of_half_angles(problem.model, at))  # type: ignore[union-attr]
        yield OtherEquations("formulation E", other, there, "dimensions")
    elif problem.parts is not None:
        from nag.mechanism.parts_coordinates import another_model

        another = another_model(problem.parts, at)
        if another is not None:
            there = another.at
            yield OtherEquations(another.name, problem_of(another.parts), there, another.alike)


def _other_formulations(made: Model) -> Iterator[OtherEquations]:
    from nag.mechanism.formulation_names import FORMULATIONS
    from nag.mechanism.model import ModelError

    for name in FORMULATIONS:
        if name != made.formulation:
            with suppress(ModelError):
                other = problem_of(made.mechanism, formulation=name)
                yield OtherEquations(f"formulation {name}", other, None, "dimensions")
