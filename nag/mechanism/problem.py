"""One problem, whatever it is given as: a system, and what its solutions are configurations of.

Equations, mechanisms, their models, parts that may be assembled, tables by Denavit and Hartenberg
and cases of all of these come down to a `Problem`. What solves, decomposes, moves or reports one
asks the problem, and never again what it was given as. What `nag.questions` asks takes whatever
describes one; `nag.decomposition` and `nag.solving` take systems only.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from nag.algebra.from_python import system as system_of_equations
from nag.algebra.given import ANSWERS, GRAPH_GIVEN, check_listed, is_a
from nag.algebra.number import Number, number_text
from nag.algebra.symmetry import SignedPermutation, SymmetryError
from nag.algebra.system import NamedPoint, PolynomialSystem
from nag.errors import NagError, StartError
from nag.mechanism import PLATFORM_ALONE
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.parts import check_formulation, model_parts, parts_in_formulation
from nag.text.table import lines_of, one_line
from nag.tracking.run import DEFAULT_RUN, Run, answers_early

if TYPE_CHECKING:
    from nag.algebra.symmetric_family import FamilyMember
    from nag.mechanism.axes import Space
    from nag.mechanism.configuration import Configuration
    from nag.mechanism.model import Model
    from nag.solving.solutions import SolveResult
    from nag.witness.witness import Decomposition


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

    __repr__ = one_line

    def __str__(self) -> str:
        about = [("system", one_line(self.system)[1:-1])]
        if self.model is not None:
            about.append(("of", one_line(self.model)[1:-1]))
        if self.points:
            about.append(("points", ", ".join(point.name for point in self.points)))
        if self.symmetries:
            about.append(("symmetries", str(len(self.symmetries))))
        return lines_of("Problem", about)

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
        known = None if self.model is None else self.model.reference
        # Other assembly modes have none; a model without unknowns has the empty one.
        return known if known or not self.system.n else None

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

    def document(self) -> dict[str, Any]:
        """The equations, and what they are those of, as a JSON object without its head."""
        model = None
        if self.model is not None:
            left_out = [{"freedoms": n, "of": whose} for n, whose in self.freedoms_left_out]
            model = {
                "formulation": self.formulation,
                "reason": self.model.reason,
                "space": self.space,
                "gruebler_kutzbach": self.model.gruebler_kutzbach,
                "freedoms_left_out": left_out,
                "alternatives": [each.document() for each in self.model.alternatives],
            }
        return {
            "format": "nag-model",
            "system": self.system.document(),
            "symmetries": [g.text(self.system.variables) for g in self.symmetries],
            "points": [
                {"name": point.name, "at": [number_text(x) for x in point.at]}
                for point in self.points
            ],
            "model": model,
        }

    def lift(self, point: Sequence[Any]) -> Configuration:
        """All bodies' orientations and positions at a solution, as `nag.model`'s lift gives them.

        Raises:
            NagError: if the system is not that of a mechanism.
        """
        if self.mechanism is None:
            raise NagError("lift: only mechanisms at a reference configuration have bodies")
        return self.mechanism.lift(point)

    @answers_early
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
        if self.formulation == PLATFORM_ALONE:
            from nag.mechanism.operation_modes import decompose_poses

            return decompose_poses(self.model.form.platform, run)  # type: ignore[union-attr]
        from nag.decomposition.decompose import decompose

        return decompose(self.system, run=run, symmetries=used)

    @answers_early
    def solve(self, *, start: str = "auto", run: Run = DEFAULT_RUN) -> SolveResult:
        """The isolated solutions of the system, as `nag.solve` gives them.

        Args:
            start: as for `nag.solve`.
            run: how it is worked out; ``seed=1`` and the like stand for a run.
        """
        family = self.family
        if start == "parameter" or (start == "auto" and family and family.solutions):
            from nag.solving.parameter import solve_member

            if family is None:
                said = "start: 'parameter' is for a case with a [family]; take another one"
                raise StartError(said).mended_by("start")
            return solve_member(self.system, family, exact_first=start == "auto", run=run)
        from nag.solving.solve import solve as solve_system

        return solve_system(self.system, start=start, run=run)


def problem_of(
    given: Any,
    variables: Any = None,
    *,
    imaginary: str | None = None,
    formulation: str = "auto",
) -> Problem:
    """The problem that a mechanism, a model, parts, a case, a system or equations describe.

    Args:
        given: any of these; or a problem, which is taken as it is; or what `nag.solve` or
            `nag.decompose` found, whose equations are meant.
        variables: of equations, their names in order.
        imaginary: of equations, what the imaginary unit is called, as for `nag.system`.
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
        return Problem(system_of_equations(given, variables, imaginary=imaginary))
    for name, value in (("variables", variables), ("imaginary", imaginary)):
        if value is not None:
            raise NagError(f"{name}: is for equations; what is given has its own, leave it out")
    return problem


def _describe_problem(given: Any, formulation: str) -> Problem | None:
    """What describes a problem without being equations; None if these are given."""
    if is_a(given, "nag.files.cases", "Case"):
        made = problem_of(given.problem_source, formulation=formulation)
        return replace(
            made,
            symmetries=made.symmetries or given.symmetries,
            points=given.points or made.points,
            family=given.family,
        )
    given = model_parts(given)
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
    if any(is_a(given, *kind) for kind in ANSWERS):
        check_formulation(formulation)
        return _of_answer(given)
    if is_a(given, "networkx", "Graph"):
        raise NagError(f"system: {GRAPH_GIVEN}")
    if given is None or isinstance(given, Mapping | bool | int | float):
        raise NagError(
            f"system: something of type {type(given).__name__} is given; give equations in a list, "
            "or a nag.PolynomialSystem, nag.Mechanism, nag.Case, or a model"
        )
    return None


def _of_model(made: Model) -> Problem:
    # Other assembly modes have no reference configuration.
    reference = NamedPoint("reference", tuple(made.reference), "the reference configuration")
    points = (reference,) if made.reference or not made.system.n else ()
    return Problem(made.system, tuple(made.symmetries), points, model=made)


def _of_answer(found: Decomposition | SolveResult) -> Problem:
    """The equations that were answered, with the symmetries that carry components into others."""
    components = getattr(found, "components", ())
    return Problem(found.system, tuple(dict.fromkeys(g for c in components for g in c.images)))


def problem_within_reach(problem: Problem) -> Problem:
    """What is decomposed: a robot's poses where the paths of all other equations are very many."""
    if problem.mechanism is None:
        return problem
    from nag.mechanism.model import find_pose_model

    poses = find_pose_model(problem.mechanism)
    return problem if poses is None else _of_model(poses)


def _of_parts(parts: AssemblyModel, formulation: str) -> Problem:
    parts = parts_in_formulation(parts, formulation)
    known = () if parts.reference is None else (NamedPoint("placement", parts.reference),)
    return Problem(parts.system, tuple(parts.symmetries), known, model=parts)


def in_real_coordinates(problem: Problem) -> Problem:
    """The same in coordinates in which a real configuration has real coordinates."""
    if not problem.system.isotropic:
        return problem
    from nag.mechanism.framework_model import cartesian_model

    return problem_of(cartesian_model(problem.model.framework))  # type: ignore[union-attr]


def read_symmetries(given: Iterable[Any] | None, problem: Problem) -> tuple[SignedPermutation, ...]:
    """Symmetries given as signed permutations, as maps of names, or as signs of the variables.

    Raises:
        SymmetryError: if one is none.
    """
    if given is None:
        return problem.symmetries
    check_listed(given, "symmetries", "a list of them: [{'x': '-x'}, ...]")
    found = []
    for i, item in enumerate(given):
        try:
            if isinstance(item, SignedPermutation):
                found.append(item)
            elif isinstance(item, Mapping):
                texts = {str(name): str(image) for name, image in item.items()}
                found.append(SignedPermutation.of_map(texts, problem.system.variables))
            elif isinstance(item, Iterable) and not isinstance(item, str):
                found.append(SignedPermutation.of_signs(tuple(int(sign) for sign in item)))
            else:
                raise SymmetryError("give a dict like {'x': '-x'}, or a sign for each variable")
        except (TypeError, ValueError) as error:
            raise SymmetryError(f"symmetries[{i}]: {error}") from None
    return tuple(found)
