"""The mobility of a mechanism at a configuration: what counting says, and what is true.

References:
    T25, section 7; PT13, section 6;
    Wampler, Hauenstein & Sommese, Mechanism mobility and a local dimension test, 2011.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from nag.algebra.number import Number
from nag.decomposition.components import decompose
from nag.decomposition.through import through_points
from nag.mechanism.axes import space_of
from nag.mechanism.graph import Mechanism
from nag.mechanism.joint_types import freedoms_in
from nag.mechanism.loops import loop_structure
from nag.mechanism.mobility import gruebler_kutzbach
from nag.mechanism.model import Model, model
from nag.numerics.local_dimension import LocalDimension, local_dimension
from nag.witness.expansion import expanded


class MobilityStatus(StrEnum):
    """What a configuration is, the most telling word for it."""

    RIGID = "rigid"
    SHAKY = "shaky"
    MOBILE = "mobile"
    OVERCONSTRAINED = "overconstrained"
    CROSSING = "at a crossing of components"
    KINEMATOTROPIC = "kinematotropic point"
    UNDECIDED = "undecided"


@dataclass(frozen=True, eq=False)
class MobilityReport:
    """The mobility of a mechanism at one configuration.

    Attributes:
        space: ``"planar"``, ``"spherical"`` or ``"spatial"``.
        gruebler_kutzbach: the mobility that counting predicts.
        formulation: of the model; empty where the mechanism has no loop.
        variables, equations: of the model.
        free: freedoms of joints outside all loops, contained in the dimensions below.
        tangent_dimension: of the configuration space's tangent space, the first-order mobility;
            None if it is not decided.
        lower, upper: bounds of the local dimension, the true mobility.
        components: dimension and degree of each component through the configuration; None if they
            were not looked for or are not known.
        open: why the components are not known; empty if they are.
        local: the local dimension in the model, and what it rests on; None without loops.
    """

    space: str
    gruebler_kutzbach: int
    formulation: str
    variables: int
    equations: int
    free: int
    tangent_dimension: int | None
    lower: int
    upper: int
    components: tuple[tuple[int, int], ...] | None
    open: str
    local: LocalDimension | None

    @property
    def local_dimension(self) -> int | None:
        """The mobility at the configuration; None if it is not decided."""
        return self.lower if self.lower == self.upper else None

    @property
    def multiplicity(self) -> int:
        """Of an isolated configuration in the model's equations; else 0."""
        return self.local.multiplicity if self.local is not None else 0

    @property
    def agrees(self) -> bool:
        """Whether the components that were found say what the local dimension says."""
        if not self.components:
            return True
        return self.lower <= max(d for d, _ in self.components) <= self.upper

    def same_motion(self, other: MobilityReport) -> bool:
        """Whether both say the same of the configuration, in whatever formulation."""
        dimensions = [
            None if r.components is None else {d for d, _ in r.components} for r in (self, other)
        ]
        known = self.local_dimension is not None
        same = self.local_dimension == other.local_dimension
        same &= self.tangent_dimension == other.tangent_dimension
        return known and same and (None in dimensions or dimensions[0] == dimensions[1])

    @property
    def overconstrained(self) -> bool:
        """Whether it is more mobile than counting predicts."""
        return self.lower > max(self.gruebler_kutzbach, 0)

    @property
    def status(self) -> MobilityStatus:
        if self.local_dimension is None or self.tangent_dimension is None or not self.agrees:
            return MobilityStatus.UNDECIDED
        if self.local_dimension == 0:
            return MobilityStatus.SHAKY if self.tangent_dimension else MobilityStatus.RIGID
        dimensions = [d for d, _ in self.components or ()]
        if len(set(dimensions)) > 1:
            return MobilityStatus.KINEMATOTROPIC
        if len(dimensions) > 1:
            return MobilityStatus.CROSSING
        return MobilityStatus.OVERCONSTRAINED if self.overconstrained else MobilityStatus.MOBILE

    @property
    def sentence(self) -> str:
        """What the numbers mean."""
        return _sentence(self)

    def __str__(self) -> str:
        return "\n".join(f"{label.ljust(10)}  {text}" for label, text in self.rows())

    def rows(self) -> list[tuple[str, str]]:
        """Five labelled lines."""
        counts = f"{self.gruebler_kutzbach} by Gruebler-Kutzbach ({self.space})"
        model_text = "no loop, no equations"
        if self.formulation:
            model_text = (
                f"{_count(self.equations, 'equation')} in {_count(self.variables, 'unknown')}, "
                f"formulation {self.formulation}"
            )
            if self.free:
                model_text += f"; {self.free} besides"
        return [
            ("counted", counts),
            ("model", model_text),
            ("local", _local_text(self)),
            ("components", _components_text(self)),
            ("mobility", f"{self.status}: {self.sentence}"),
        ]


def _local_text(report: MobilityReport) -> str:
    if report.tangent_dimension is None:
        return "undecided: no exact configuration was found there"
    text = f"tangent dimension {report.tangent_dimension}, local dimension "
    if report.local_dimension is None:
        return f"{text}{report.lower} to {report.upper}"
    text += str(report.local_dimension)
    return f"{text}, multiplicity {report.multiplicity}" if report.multiplicity > 1 else text


def _components_text(report: MobilityReport) -> str:
    if report.components is None:
        return f"not known: {report.open}" if report.open else "not looked for"
    if not report.components:
        return "none through the configuration"
    listed = "; ".join(f"dimension {d}, degree {degree}" for d, degree in report.components)
    return f"{len(report.components)} through the configuration: {listed}"


def _sentence(report: MobilityReport) -> str:
    status = report.status
    if not report.agrees:
        return "the components that were found contradict the local dimension"
    if status is MobilityStatus.UNDECIDED:
        return report.local.reason if report.local is not None else "nothing is known"
    mobility, tangent = report.local_dimension, report.tangent_dimension
    if status is MobilityStatus.RIGID:
        return "it does not move, not even infinitesimally"
    if status is MobilityStatus.SHAKY:
        return (
            f"it does not move, but infinitesimally it does, with {_freedoms(tangent)}: an "
            f"isolated solution of multiplicity {report.multiplicity}"
        )
    text = f"it moves with {_freedoms(mobility)}"
    if report.overconstrained:
        text += f", though counting predicts {report.gruebler_kutzbach}"
    if status is MobilityStatus.KINEMATOTROPIC:
        dimensions = sorted({d for d, _ in report.components or ()})
        text += f"; motions with {' and '.join(map(str, dimensions))} freedoms meet here"
    elif status is MobilityStatus.CROSSING:
        text += f"; {len(report.components or ())} motions meet here"
    elif tangent is not None and mobility is not None and tangent > mobility:
        text += f"; the configuration is singular, infinitesimally it has {_freedoms(tangent)}"
    return text


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _freedoms(number: int | None) -> str:
    return _count(number or 0, "freedom")


def mobility(
    mechanism: Mechanism,
    point: Sequence[Number] | None = None,
    *,
    formulation: str = "auto",
    components: bool = True,
    seed: int = 0,
    threads: int = 1,
    settings: str = "default",
) -> MobilityReport:
    """The mobility of a mechanism at its reference configuration, or at another one.

    Args:
        point: in the model's variables (`nag.model(mechanism).system.variables`), exact or doubles.
        formulation: of the model, as for `nag.model`.
        components: whether to decompose the configuration space as well, to know the components
            through the configuration; it takes longer.
        seed, threads, settings: of the decomposition.

    Raises:
        nag.mechanism.model.ModelError: if the formulation does not cover the mechanism.
        nag.numerics.local_dimension.NoSolution: if an exact point is no configuration.
    """
    if not loop_structure(mechanism).loops:
        return _without_loops(mechanism)
    made = model(mechanism, formulation)
    at = tuple(made.reference) if point is None else tuple(point)
    found = local_dimension(made.system, at, seed=seed)
    through: tuple[tuple[int, int], ...] | None = None
    doubt = ""
    if components:
        through, doubt = _components(made, at, seed, threads, settings)
    return report_of(made, found, through, doubt)


def report_of(
    made: Model,
    found: LocalDimension,
    components: tuple[tuple[int, int], ...] | None,
    doubt: str = "",
) -> MobilityReport:
    """The report of what was found in a model."""
    free = sum(freedoms for freedoms, _ in made.freedoms_left_out)
    tangent = found.tangent_dimension
    return MobilityReport(
        space=space_of(made.mechanism.joints),
        gruebler_kutzbach=made.gruebler_kutzbach,
        formulation=made.formulation,
        variables=made.system.n,
        equations=len(made.system.polynomials),
        free=free,
        tangent_dimension=None if tangent is None else tangent + free,
        lower=found.lower + free,
        upper=found.upper + free,
        components=None if components is None else tuple((d + free, k) for d, k in components),
        open=doubt,
        local=found,
    )


def _without_loops(mechanism: Mechanism) -> MobilityReport:
    counted = gruebler_kutzbach(mechanism)
    space = space_of(mechanism.joints)
    free = sum(freedoms_in(j.type, space) for j in mechanism.joints)
    return MobilityReport(space, counted, "", 0, 0, free, free, free, free, None, "", None)


def _components(
    made: Model, at: Sequence[Number], seed: int, threads: int, settings: str
) -> tuple[tuple[tuple[int, int], ...] | None, str]:
    """Dimension and degree of the components through a point, or why they are not known."""
    found = decompose(
        made.system, seed=seed, threads=threads, settings=settings, symmetries=made.symmetries
    )
    if not found.complete:
        return None, f"the decomposition is incomplete: {'; '.join(found.notes)}"
    through = through_points(found, [("the configuration", tuple(at))], threads)[0]
    if not through.solution or through.doubt:
        return None, through.doubt or "the configuration is a rounded one"
    everything = expanded(found).components
    chosen = (everything[i] for i in through.components)
    return tuple((c.dimension, c.degree) for c in chosen), ""
