"""The mobility of a mechanism at a configuration: what counting says, and what is true.

References:
    T25, section 7; PT13, section 6;
    Wampler, Hauenstein & Sommese, Mechanism mobility and a local dimension test, 2011.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import zip_longest
from typing import Any, Literal

from nag.mechanism.bonds import Bonds
from nag.mechanism.moving_parts import BodyFreedoms, MovingParts
from nag.mechanism.nearly_mobile import NearMotion
from nag.numerics.local_dimension import LocalDimension
from nag.numerics.read_only import equal_values
from nag.text.table import count_text, html_table, join_words, named_line
from nag.witness.shown import degree_text
from nag.witness.witness import WitnessSet

# What must be the same of components in two formulations.
Alike = Literal["dimensions", "counts", "degrees"]
# The label of what is known before the answer is.
SO_FAR = "so far"
# What components are known by where the poses of a robot's platform stand for all configurations.
ALL_POSES = "the platform's poses, in whose coordinates degrees count: all legs are regular there"


class MobilityStatus(StrEnum):
    """What a configuration is, the most telling word for it."""

    RIGID = "rigid"
    SHAKY = "shaky"
    IDLE = "idle"
    MOBILE = "mobile"
    OVERCONSTRAINED = "overconstrained"
    CROSSING = "at a crossing of components"
    KINEMATOTROPIC = "kinematotropic point"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class CurveOfMotion:
    """A curve of configurations through one.

    Attributes:
        degree: in the model's variables.
        genus: of its smooth model, 0 if the motion has a rational parametrisation; None if it could
            not be determined.
        bonds: of a loop of revolute joints in half-angles; None elsewhere, or if they could not be
            determined.
        note: why something could not; empty otherwise.
    """

    degree: int
    genus: int | None
    bonds: Bonds | None
    note: str = ""

    def __str__(self) -> str:
        text = f"degree {self.degree}"
        if self.genus is not None:
            text += f", genus {self.genus}{' (a rational motion)' if self.genus == 0 else ''}"
        if self.bonds is not None:
            text += f", bonds {self.bonds}"
        return f"{text}; not known: {self.note}" if self.note else text

    def document(self) -> dict[str, Any]:
        """What is said of the curve, as a JSON object."""
        bonds = None
        if self.bonds is not None:
            bonds = [
                {"joints": list(bond.joints), "orders": list(bond.orders), "count": bond.count}
                for bond in self.bonds.bonds
            ]
        return {"degree": self.degree, "genus": self.genus, "bonds": bonds, "note": self.note}


@dataclass(frozen=True, eq=False)
class MobilityReport:
    """The mobility of a mechanism at one configuration.

    Attributes:
        space: ``"planar"``, ``"spherical"`` or ``"spatial"``.
        gruebler_kutzbach: the mobility that counting predicts.
        formulation: of the model, as text; empty where the mechanism has no loop.
        variables, equations: of the model.
        free: freedoms that no equation restricts, contained in the dimensions below: those of
            joints outside all loops, and of rods that turn about themselves.
        tangent_dimension: of the configuration space's tangent space, the first-order mobility;
            None if it is not decided.
        lower, upper: bounds of the local dimension, the true mobility.
        components: dimension and degree of each component through the configuration, a degree of
            None where it is not known; None if they were not looked for or are not known.
        multiplicities: of each of the components in the model's equations, None where it is not
            known; empty where they were not looked for.
        open: why the components are not known; empty if they are.
        local: the local dimension in the model, and what it rests on; None without loops.
        curves: the curves through the configuration, where they were asked for, or are known
            without paths.
        free_of: whose the ``free`` ones are, as text; empty where there are none.
        zero_links: which links have length zero, as text.
        general: of parts that are not assembled, a component of the largest dimension: the report
            is of a general configuration on it, and ``components`` are all that there are, but for
            those of ``without_real``.
        doubt: of such parts that move, why it is not known that they do with real coordinates;
            empty where it is.
        in_line: of such parts, which places their lengths put in line in every real assembly; all
            that is said is of those, but the tangent dimension, which is that of the lengths.
        without_real: of such parts that do not move, how many components more have no real
            assembly.
        least_degree: what the degree of the one component through a smooth configuration is at
            least, where it is not known.
        rests_on: what ``components`` are known by, and why a degree is not; empty where nothing is.
        moving: what moves near a configuration of a mechanism that is smooth, or as singular as all
            others near it; None elsewhere.
        unclear: why it is not known what moves; empty where it is, or was not looked at.
        near: how a rigid mechanism would move if its loops were let open; None if that was not
            asked for.
        hint: at a rigid mechanism that may be meant to move; empty where there is none.
        unreal: freedoms of the local dimension that no real motion leaves the configuration with,
            as terms of second order prove, or components of which none is its own conjugate:
            complex ones alone do.
        real: of each of the components whether real configurations of its dimension come as near as
            one likes, None where that is not known; empty where it was not looked at.
        along: of each of the components how a body that was asked for moves along it, where that is
            not told by ``moving``; empty elsewhere.
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
    components: tuple[tuple[int, int | None], ...] | None
    open: str
    local: LocalDimension | None
    curves: tuple[CurveOfMotion, ...] = ()
    free_of: str = ""
    zero_links: tuple[str, ...] = ()
    general: WitnessSet | None = None
    doubt: str = ""
    in_line: str = ""
    without_real: int = 0
    least_degree: int | None = None
    rests_on: str = ""
    moving: MovingParts | None = None
    unclear: str = ""
    near: NearMotion | None = None
    hint: str = ""
    unreal: int = 0
    multiplicities: tuple[int | None, ...] = ()
    real: tuple[bool | None, ...] = ()
    along: tuple[BodyFreedoms, ...] = ()
    inexact: str = ""

    __eq__ = equal_values

    @property
    def local_dimension(self) -> int | None:
        """The mobility at the configuration; None if it is not decided."""
        return self.lower if self.lower == self.upper else None

    @property
    def multiplicity(self) -> int | None:
        """Of an isolated configuration in the model's equations; else None."""
        if self.general is not None:
            return self.general.multiplicity if self.general.dimension == 0 else None
        return None if self.local is None else self.local.multiplicity

    @property
    def is_blocked(self) -> bool:
        """Whether no real motion of its loops leaves the configuration, as is proved."""
        return self.unreal > 0 and self.unreal == self.lower - self.free

    @property
    def never_reduced(self) -> bool:
        """Whether every configuration near this one is known to be singular in the equations."""
        if self.multiplicities and all((m or 0) > 1 for m in self.multiplicities):
            return True
        # What moves is told of configurations that are smooth, or as singular as all near by.
        singular = self.local is not None and self.local.decided and not self.local.smooth
        return singular and self.moving is not None

    @property
    def body_text(self) -> str | None:
        """How the body moves that was asked for; None if none was, or that is not known."""
        if self.moving is not None and self.moving.body is not None:
            return str(self.moving.body)
        if not self.along:
            return None
        real = self.real or (None,) * len(self.along)
        pairs = zip(self.along, real, strict=True)
        kinds = [own for own, is_real in pairs if is_real is not False] or list(self.along)
        counts = Counter(kinds)
        if len(kinds) == 1:
            return str(kinds[0])
        texts = [str(own).removeprefix(f"{own.body}: ") for own in counts]
        if len(texts) == 1:
            parts = [f"along each of {len(kinds)} motions {texts[0]}"]
        else:
            pairs = zip(counts.values(), texts, strict=True)
            parts = [f"along {count} of {len(kinds)} motions {text}" for count, text in pairs]
        return f"{self.along[0].body}: {'; '.join(parts)}"

    @property
    def _motions(self) -> list[tuple[int, bool | None]]:
        """Dimensions of the components through the configuration, and whether they are real."""
        if self.general is not None:
            return []
        dimensions = [d for d, _ in self.components or ()]
        return list(zip(dimensions, self.real or (True,) * len(dimensions), strict=True))

    @property
    def unreal_reason(self) -> str:
        """Why some freedoms are no real motions'."""
        largest = [real for d, real in self._motions if d == self.local_dimension]
        if largest and not any(real is not False for real in largest):
            return "as no component of its dimension is its own conjugate,"
        return "by terms of second order"

    @property
    def meeting_text(self) -> str:
        """What meets at the configuration, and which of it is real; empty where one motion is."""
        motions = self._motions
        dimensions = [d for d, real in motions if real is not False]
        complex_ones = len(motions) - len(dimensions)
        several = "real motions" if complex_ones else "motions"
        text = ""
        if len(set(dimensions)) > 1:
            listed = " and ".join(map(str, sorted(set(dimensions))))
            text = f"; {several} with {listed} freedoms meet here"
        elif len(dimensions) > 1:
            text = f"; {len(dimensions)} {several} meet here"
        open_ones = sum(real is None for _, real in motions)
        if text and open_ones:
            text += f", {open_ones} of them not known to be real"
        if complex_ones:
            more = f"{complex_ones} more component{'s' * (complex_ones > 1)}"
            kind = "are no real motions" if complex_ones > 1 else "is no real motion"
            whose = "their" if complex_ones > 1 else "its"
            text += f"; {more} through it {kind}: complex, {whose} real configurations are of less "
            text += "dimension, where conjugates meet"
        return text

    @property
    def agrees(self) -> bool:
        """Whether the components that were found say what the local dimension says."""
        if not self.components:
            return True
        return self.lower <= max(d for d, _ in self.components) <= self.upper

    def same_motion(self, other: MobilityReport, alike: Alike = "dimensions") -> bool:
        """Whether both say the same of the configuration, in whatever formulation.

        Args:
            alike: what of the components must be the same: which dimensions there are, how many
                components of each, or of each dimension and degree.
        """
        found = [r.components for r in (self, other)]
        if any(degree is None for known in found for _, degree in known or ()):
            alike = "dimensions" if alike == "dimensions" else "counts"
        dimensions = [None if known is None else _kinds(known, alike) for known in found]
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
        if self.is_blocked and self.free == 0:
            return MobilityStatus.SHAKY
        if self.local_dimension == 0:
            return MobilityStatus.SHAKY if self.tangent_dimension else MobilityStatus.RIGID
        dimensions = [d for d, real in self._motions if real is not False]
        if len(set(dimensions)) > 1:
            return MobilityStatus.KINEMATOTROPIC
        if len(dimensions) > 1:
            return MobilityStatus.CROSSING
        if self.moving is not None and self.moving.idle_count == self.tangent_dimension:
            return MobilityStatus.IDLE
        return MobilityStatus.OVERCONSTRAINED if self.overconstrained else MobilityStatus.MOBILE

    @property
    def complete(self) -> bool:
        """Whether the question is answered, and nothing of the components is left open."""
        decided = self.status is not MobilityStatus.UNDECIDED and not self.open
        return decided and not any(curve.note for curve in self.curves)

    @property
    def local_text(self) -> str:
        """The dimensions at the configuration, in words."""
        if self.tangent_dimension is None:
            return "undecided: no exact configuration was found there"
        text = f"tangent dimension {self.tangent_dimension}, local dimension "
        if self.local_dimension is None:
            return f"{text}{self.lower} to {self.upper}"
        text += str(self.local_dimension)
        return f"{text}, multiplicity {self.multiplicity}" if (self.multiplicity or 0) > 1 else text

    @property
    def sentence(self) -> str:
        """What the numbers mean."""
        return _sentence(self)

    def __repr__(self) -> str:
        return named_line(self, f": {self.sentence}")

    def _repr_html_(self) -> str:
        return html_table("MobilityReport", [["", ""], *map(list, self.rows())])

    def __str__(self) -> str:
        return "\n".join(f"{label.ljust(10)}  {text}" for label, text in self.rows())

    def rows(self) -> list[tuple[str, str]]:
        """Labelled lines: what was asked, what it rests on, and what passes through."""
        return [
            *self._final_rows(),
            ("components", _components_text(self)),
            *self._degree_rows(),
            *(("curve", str(curve)) for curve in self.curves),
        ]

    def _degree_rows(self) -> list[tuple[str, str]]:
        """To what the degrees belong; nothing where none is told, or it is said with them."""
        told = any(dimension and degree for dimension, degree in self.components or ())
        if not self.formulation or self.rests_on == ALL_POSES:
            return []
        return [("degree", degree_text(self.formulation))] if told or self.least_degree else []

    def early_rows(self) -> list[tuple[str, str]]:
        """Those of these lines that no component is needed for, what was asked first.

        At a singular configuration that moves what the numbers mean depends on the components:
        there the first line says what is known before, and the answer follows when it is.
        """
        alone = self.general is not None or self.local is None or self.local.smooth
        if alone or (self.local is not None and self.local.upper == 0):
            return self._final_rows()
        return [(SO_FAR, _known_so_far(self)), *self._local_rows()]

    def _final_rows(self) -> list[tuple[str, str]]:
        (sentence, *rest) = self._meaning_rows()
        return [sentence, *self._local_rows(), *rest]

    @property
    def _status_text(self) -> str:
        """The status, and whether only that of complex assemblies is known."""
        return f"{self.status}, perhaps in complex coordinates alone" if self.doubt else self.status

    def _meaning_rows(self) -> list[tuple[str, str]]:
        """The sentence, and what moves."""
        # The sentence says which freedoms are idle, and how the body moves that was asked for.
        moving = () if self.moving is None else self.moving.rows()
        sentence = self.sentence
        said = {("of", text) for label, text in moving if label == "of" and text in sentence}
        return [
            ("mobility", f"{self._status_text}: {sentence}"),
            *(row for row in moving if row[0] != "idle" and row not in said),
            *(self.near.rows() if self.near is not None else ()),
            *([("hint", self.hint)] if self.hint else []),
        ]

    def _local_rows(self) -> list[tuple[str, str]]:
        """What was counted, the model, and the dimensions at the configuration."""
        model_text = "no loop, no equations"
        if self.formulation:
            unknowns = count_text(self.variables, "unknown")
            model_text = (
                f"{count_text(self.equations, 'equation')} in {unknowns}, {self.formulation}"
            )
        return [
            ("counted", f"{self.gruebler_kutzbach} by Gruebler-Kutzbach ({self.space})"),
            ("model", model_text),
            *(("besides", text) for text in self.zero_links),
            *([("numbers", self.inexact)] if self.inexact else []),
            ("local", self.local_text),
            *([("besides", f"{self.free_of}, counted in all dimensions")] if self.free_of else []),
        ]

    def document(self) -> dict[str, Any]:
        """The answer as a JSON object."""
        components = self.components
        return {
            "space": self.space,
            "gruebler_kutzbach": self.gruebler_kutzbach,
            "formulation": self.formulation or None,
            "variables": self.variables,
            "equations": self.equations,
            "free": self.free,
            "inexact": self.inexact,
            "tangent_dimension": self.tangent_dimension,
            "local_dimension": self.local_dimension,
            "lower": self.lower,
            "upper": self.upper,
            # In documents 0 stands for none.
            "multiplicity": self.multiplicity or 0,
            "overconstrained": self.overconstrained,
            "blocked": self.is_blocked,
            "unreal": self.unreal,
            "status": str(self.status),
            "meaning": self.sentence,
            "components": None
            if components is None
            else [
                {"dimension": d, "degree": degree, "multiplicity": m, "real": real}
                for (d, degree), m, real in zip_longest(
                    components, self.multiplicities[: len(components)], self.real
                )
            ],
            "degree_at_least": self.least_degree,
            "rests_on": self.rests_on,
            "open": self.open,
            "moving": None if self.moving is None else self.moving.document(),
            "moving_unknown": self.unclear,
            "along": [own.document() for own in self.along],
            "near": None if self.near is None else self.near.document(),
            "curves": [curve.document() for curve in self.curves],
            "local": None if self.local is None else self.local.document(),
        }


def is_so_far(rows: Sequence[tuple[str, str]]) -> bool:
    """Whether lines are those of a singular configuration before its components are known."""
    return bool(rows) and rows[0][0] == SO_FAR


def _known_so_far(report: MobilityReport) -> str:
    """What is known at a singular configuration before its components are."""
    most = report.upper - report.unreal
    if report.is_blocked:
        known = _meaning(report)
    elif report.moving is not None:
        known = f"it moves with {count_text(most, 'freedom')}"
    else:
        known = f"it moves with {count_text(most, 'freedom')} at the most"
    return f"{known}; the configuration is singular, and which motions meet here is looked for"


def _kinds(components: Iterable[tuple[int, int | None]], alike: Alike) -> object:
    if alike == "degrees":
        return Counter(components)
    dimensions = Counter(d for d, _ in components)
    return dimensions if alike == "counts" else set(dimensions)


def _components_text(report: MobilityReport) -> str:
    if report.components is None:
        if not report.open:
            return "not looked for"
        return f"not known: {report.open}"
    if not report.components:
        return "none through the configuration"
    count = len(report.components)
    known, real = report.multiplicities or (1,) * count, report.real or (None,) * count
    kinds = [
        f"dimension {d}, degree {degree}"
        + (f", multiplicity {m}" if (m or 0) > 1 else "")
        + (", complex" if own is False else "")
        for (d, degree), m, own in zip(report.components, known, real, strict=True)
    ]
    if report.general is not None:
        listed = "; ".join(f"{count} of {k}" for k, count in Counter(kinds).items())
        if report.without_real:
            return f"{listed}, with real assemblies; {report.without_real} without"
        return listed
    if report.least_degree is not None:
        ((dimension, _),) = report.components
        return (
            f"1 through the configuration: dimension {dimension}, reduced, degree "
            f"{report.least_degree} at least; {report.rests_on}"
        )
    listed = f"{len(report.components)} through the configuration: {'; '.join(kinds)}"
    return f"{listed}; by {ALL_POSES}" if report.rests_on == ALL_POSES else listed


def _sentence(report: MobilityReport) -> str:
    status = report.status
    if not report.agrees:
        return "the components that were found contradict the local dimension"
    if status is MobilityStatus.UNDECIDED:
        return (
            report.local.reason if report.local is not None else report.open or "nothing is known"
        )
    if report.general is None:
        asked = report.body_text
        if asked is None:
            return _meaning(report)
        meaning = _meaning(report)
        if meaning.startswith("it "):
            # "It" would be the body.
            return f"{asked}; the mechanism {meaning.removeprefix('it ')}"
        return f"{asked}; {meaning}"
    if status is MobilityStatus.RIGID and not report.in_line:
        return f"no configuration moves, not even infinitesimally{_nearly(report)}"
    where = "at a general configuration"
    if len({dimension for dimension, _ in report.components or ()}) > 1:
        where += " of those with the most freedoms"
    if report.in_line:
        where = f"in every real assembly {report.in_line}; {where}"
    text = f"{where} {_meaning(report)}"
    return f"{text}; {report.doubt}" if report.doubt else text


def _nearly(report: MobilityReport) -> str:
    """What a tolerance adds to the sentence of a mechanism that does not move."""
    return "" if report.near is None else f"; {report.near.sentence}"


def _meaning(report: MobilityReport) -> str:
    status = report.status
    mobility, tangent = report.local_dimension, report.tangent_dimension
    if status is MobilityStatus.RIGID:
        return f"it does not move, not even infinitesimally{_nearly(report)}"
    if report.is_blocked and mobility:
        moves = f"moves with {count_text(report.free, 'freedom')}, {report.free_of}, and no other"
        does = moves if report.free else "does not move"
        return (
            f"it {does}: {report.unreal_reason} no real motion leaves "
            f"the configuration, though complex ones of dimension {mobility} pass through "
            f"it; infinitesimally it has {count_text(tangent or 0, 'freedom')}"
        )
    if status is MobilityStatus.SHAKY:
        # With places in line it is isolated among the real ones only.
        isolated = f": an isolated solution of multiplicity {report.multiplicity}"
        isolated = "" if report.in_line else isolated
        return (
            "it does not move, but infinitesimally it does, with "
            f"{count_text(tangent or 0, 'freedom')}{isolated}{_nearly(report)}"
        )
    idle = 0 if report.moving is None else report.moving.idle_count
    apart = report.moving is None and report.free and report.free != mobility
    if status is MobilityStatus.IDLE and report.moving is not None:
        freedoms = count_text(idle, "freedom")
        text = f"it is rigid but for {report.moving.idle_kinds}, with {freedoms}"
    elif report.moving is not None and idle and idle == mobility:
        text = f"nothing moves but idly, with {count_text(idle, 'freedom')}"
    else:
        text = f"it moves with {count_text((mobility or 0) - report.unreal, 'freedom')}"
        if report.unreal:
            text += (
                f", and with {report.unreal} more that no real motion has, "
                f"{report.unreal_reason.rstrip(',')}"
            )
        if report.moving is not None and idle:
            text += f", {idle} of them idle: {report.moving.idle_text}"
        elif apart:
            # What the equations leave out is known before anything else.
            text += f", {report.free_of.replace(' by ', ' of them by ', 1)}"
    ends = [] if report.moving is None else [part.bodies[0] for part in report.moving.hanging]
    if not report.formulation and len(ends) > 1:
        # A name that is spelled in two ways leaves two ends; an arm has one.
        text += f"; there is no loop: {join_words(ends)} hang on one joint each"
    if report.overconstrained:
        text += f", though counting predicts {report.gruebler_kutzbach}"
    if report.moving is not None and idle and idle == mobility:
        text += f": {report.moving.idle_text}"
    meeting = report.meeting_text
    if meeting:
        text += meeting
    elif tangent is not None and mobility is not None and tangent > mobility:
        where = "all configurations near by are" if report.never_reduced else "the configuration is"
        text += f"; {where} singular, infinitesimally it has "
        text += count_text(tangent, "freedom")
    return text
