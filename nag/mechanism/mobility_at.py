"""The mobility of a mechanism, or of parts that are assembled somehow, at a configuration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from nag.algebra.from_python import coordinates
from nag.algebra.given import check_choice, is_a
from nag.algebra.number import Number
from nag.algebra.system import PolynomialSystem
from nag.decomposition.curve_genus import GenusError, genus
from nag.decomposition.given_points import components_through_points
from nag.decomposition.through import through_points, zero_at
from nag.errors import MechanismError, NagError
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.axes import space_of
from nag.mechanism.bonds import BondError, Bonds, bonds, has_bonds
from nag.mechanism.graph import Mechanism, check_mechanism
from nag.mechanism.loops import gruebler_kutzbach, loop_structure
from nag.mechanism.mobility_report import CurveOfMotion, MobilityReport
from nag.mechanism.model import Model
from nag.mechanism.problem import Problem, problem_of
from nag.mechanism.real_assemblies import real_doubt
from nag.numerics.local_dimension import LocalDimension, local_dimension_near
from nag.tracking.run import DEFAULT_RUN, Run, takes_run
from nag.witness.frame import expand_orbits
from nag.witness.witness import Decomposition, WitnessSet


class NoAssembly(MechanismError):
    """Parts that cannot be assembled, with the reason."""


@takes_run
def mobility(
    mechanism: Any,
    point: Sequence[Any] | Mapping[str, Any] | None = None,
    *,
    formulation: str = "auto",
    detail: Literal["local", "components", "curves"] = "components",
    run: Run = DEFAULT_RUN,
) -> MobilityReport:
    """The mobility of a mechanism at its reference configuration, or at another one.

    That of parts which are not assembled is that of a general configuration, if no point is given.

    What counting predicts, the tangent and the local dimension (Wampler, Hauenstein & Sommese
    2011), and the components through the configuration.

    Args:
        mechanism: assembled, or parts that may be assembled (`nag.Case.assembly`), or a case or a
            problem of one of them.
        point: in the model's variables (``nag.model(mechanism).system.variables``), in order or by
            name; exact numbers as `nag.Joint` takes them, or doubles.
        formulation: of a mechanism's model, as for `nag.model`.
        detail: ``"local"`` for what needs no decomposition, ``"components"`` for the components
            through the configuration as well, ``"curves"`` for genus and bonds of curves, too.
        run: a `nag.Run`; its seed, threads, settings and progress may be given one by one.

    Raises:
        nag.mechanism.model.ModelError: if the formulation does not cover the mechanism.
        nag.numerics.local_dimension.NoSolution: if an exact point is no configuration, not even to
            rounding.
        NoAssembly: if parts cannot be assembled.
        ValueError: if parts are to be looked at without a decomposition where no assembly is known,
            or another argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> print(nag.mobility(nag.read_case("cases/bennett.toml").mechanism))
    counted     -2 by Gruebler-Kutzbach (spatial)
    model       1 equation in 2 unknowns, formulation H
    local       tangent dimension 1, local dimension 1
    components  1 through the configuration: dimension 1, degree 2
    mobility    overconstrained: it moves with 1 freedom, though counting predicts -2
    """
    check_choice(detail, "detail", ("local", "components", "curves"))
    tree = tree_of(mechanism)
    if tree is not None:
        return _without_loops(tree)
    problem = problem_of(mechanism, formulation=formulation)
    if problem.model is None:
        check_mechanism(problem.system, "the parts of a case, case.assembly")
    at = problem.reference
    if point is not None:
        at = coordinates(point, problem.system.variables)
    if at is None:
        return _in_general(problem, detail, run)
    return _report(problem, at, detail, run)


def tree_of(given: Any) -> Mechanism | None:
    """The mechanism that is given, if it has no loops, so that it has no equations.

    Raises:
        MechanismError: if what is given is no mechanism, no parts and no problem.
    """
    mechanism = given.described if is_a(given, "nag.files.cases", "Case") else given
    if not isinstance(mechanism, Problem | Model | AssemblyModel | PolynomialSystem):
        check_mechanism(mechanism, "the parts of a case, case.assembly")
        return None if loop_structure(mechanism).loops else mechanism
    return None


def _report(problem: Problem, at: Sequence[Number], detail: str, run: Run) -> MobilityReport:
    found = local_dimension_near(problem.system, at, seed=run.seed)
    free, tangent = problem.free, found.tangent_dimension
    at = zero_at(problem.system, at, found)
    through, doubt = None, ""
    if detail != "local":
        through, doubt = _components(problem, at, found, run)
    motions = []
    if detail == "curves" and through is not None:
        motions = [_curve(problem, c, run) for c in through if c.dimension == 1]
    known = None if through is None else tuple((c.dimension + free, c.degree) for c in through)
    return MobilityReport(
        **_count_freedoms(problem),
        tangent_dimension=None if tangent is None else tangent + free,
        lower=found.lower + free,
        upper=found.upper + free,
        components=known,
        open=doubt,
        local=found,
        curves=tuple(motions),
    )


def _in_general(problem: Problem, detail: str, run: Run) -> MobilityReport:
    """The mobility at a general configuration of parts that may be assembled."""
    if detail == "local":
        raise NagError("the parts are not assembled; give a point, an assembly of them")
    found = problem.decompose(run=run)
    components = expand_orbits(found).components
    if found.complete and not components:
        raise NoAssembly("its parts cannot be assembled, not even with complex coordinates")
    general = max(components, key=lambda c: (c.dimension, c.corank), default=None)
    known = general if found.complete else None
    free = problem.free
    curves = [c for c in components if c.dimension == 1] if detail == "curves" else []
    doubt = ""
    if known is not None and known.dimension and problem.parts is not None:
        doubt = real_doubt(problem.parts, {c.corank for c in components if c.dimension})
    return MobilityReport(
        **_count_freedoms(problem),
        tangent_dimension=None if known is None else known.corank + free,
        lower=free + (0 if known is None else known.dimension),
        upper=free + (problem.system.n if known is None else known.dimension),
        components=tuple((c.dimension + free, c.degree) for c in components)
        if found.complete
        else None,
        open="" if found.complete else _incomplete(found),
        local=None,
        curves=tuple(_curve(problem, c, run) for c in curves),
        general=known,
        doubt=doubt,
    )


def _without_loops(mechanism: Mechanism) -> MobilityReport:
    counted = gruebler_kutzbach(mechanism)
    space = space_of(mechanism.joints)
    free = sum(j.freedoms_in(space) for j in mechanism.joints)
    return MobilityReport(space, counted, "", 0, 0, free, free, free, free, None, "", None)


def _components(
    problem: Problem,
    at: Sequence[Number],
    local: LocalDimension,
    run: Run,
) -> tuple[list[WitnessSet] | None, str]:
    """The components through a point, or why they are not known."""
    found = problem.decompose(run=run)
    if not found.complete and local.smooth:
        return _only_component(problem, local, _incomplete(found), run)
    if not found.complete:
        return None, _incomplete(found)
    through = through_points(found, [("the configuration", tuple(at))], run.threads)[0]
    if not through.solution or through.doubt:
        return None, through.doubt or "the configuration is a rounded one"
    everything = expand_orbits(found).components
    return [everything[i] for i in through.components], ""


def _only_component(
    problem: Problem,
    local: LocalDimension,
    doubt: str,
    run: Run,
) -> tuple[list[WitnessSet] | None, str]:
    """The component through a smooth point, reached from there by loops; or what is not known.

    Exactly one passes through a smooth point, of the local dimension, and it is reduced: where it
    is found, nothing else matters of what a decomposition left open.
    """
    found = components_through_points(problem.system, [(local.lower, local.point)], run=run)
    if found.complete and len(found.components) == 1:
        return list(found.components), ""
    degrees = [c.degree for c in found.components]
    least = f", {degrees[0]} at least" if len(degrees) == 1 else ""
    return None, f"its degree{least}; {doubt}"


def _count_freedoms(problem: Problem) -> dict[str, Any]:
    """What a report says of a problem, whatever was computed."""
    made = problem.model
    return {
        "space": problem.space,
        "gruebler_kutzbach": made.gruebler_kutzbach,
        "formulation": made.formulation_text,
        "variables": problem.system.n,
        "equations": len(problem.system.polynomials),
        "free": problem.free,
        "free_of": " and ".join(f"{count} by {whose}" for count, whose in made.freedoms_left_out),
        "zero_links": made.zero_links,
    }


def _incomplete(found: Decomposition) -> str:
    return f"the decomposition is incomplete: {'; '.join(found.notes)}"


def _curve(problem: Problem, component: WitnessSet, run: Run) -> CurveOfMotion:
    notes = []
    number: int | None = None
    try:
        number = genus(problem.system, component, run=run).genus
    except (GenusError, ValueError) as reason:
        notes.append(f"the genus, {reason}")
    connected: Bonds | None = None
    if has_bonds(problem.model):
        try:
            connected = bonds(problem.model, component, run=run)  # type: ignore[arg-type]
        except (BondError, ValueError) as reason:
            notes.append(f"the bonds, {reason}")
    return CurveOfMotion(component.degree, number, connected, "; ".join(notes))
