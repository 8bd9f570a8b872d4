"""The operation modes of a parallel robot, and what is printed and exported of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.mechanism.inverse_kinematics import REACHED
from nag.mechanism.leg_image import COORDINATES
from nag.mechanism.motions import MotionType, ScrewSystem
from nag.mechanism.platform import LegEquations, PlatformModel
from nag.numerics.read_only import FixedArrays, Several, equal_values
from nag.text.table import (
    Row,
    align,
    count_text,
    data_frame,
    html_table,
    join_words,
    magnitude,
    one_line,
    sheet,
)
from nag.witness.witness import Decomposition, WitnessSet

if TYPE_CHECKING:
    import pandas

# Of a mode the quadratic equations are printed if they are so few and have so few terms.
MOST_EQUATIONS, MOST_TERMS = 2, 8
NOT_SEEN = (
    "modes are those of the platform's pose: what moves while the platform stands still is not "
    "seen; `nag mobility` counts it in the local dimension"
)


class ModeReality(StrEnum):
    """Whether a mode has real poses, as many as it has dimensions."""

    REAL = "real"
    CONJUGATE = "conjugate pair"
    UNKNOWN = "not known"


@dataclass(frozen=True, eq=False)
class OperationMode(FixedArrays):
    """A component of the poses of a platform.

    Attributes:
        component: the component, in the variables of the model's system.
        dimension, degree: of its closure in the projective space of Study coordinates.
        linear: forms of degree one with real coefficients that vanish on it, a basis of them; of
            one of a conjugate pair they vanish on both.
        quadratic: likewise of degree two, besides these and besides Study's quadric.
        note: why its equations are not known; empty where they are.
        reality: whether it has real poses, as many as it has dimensions.
        conjugate: index of the mode of the conjugate poses; None for one that is its own, or where
            it is not known.
        real_pose: Study coordinates of a real pose where it is smooth; None if none is known.
        motion: what its poses have in common; None for a single pose, or where it is not known.
        screws: its twists at the real pose; None if none is known.
        through_reference: whether the reference pose is on it; None if that is not known.
        residuals: one for each leg, of the poses that inverse kinematics found next to a general
            pose of it, with complex joint coordinates.
        limits: indices of legs that do not reach its general poses, and come as near to these as
            one likes: it is a component of what the closures of their poses have in common.
        real_residuals: as the residuals, with real joint coordinates next to the real pose; empty
            without one.
        singular_legs: of a multiple mode, indices of the legs whose own equations are singular all
            along it.
    """

    component: WitnessSet
    dimension: int
    degree: int
    linear: tuple[Polynomial, ...]
    quadratic: tuple[Polynomial, ...]
    note: str
    reality: ModeReality
    conjugate: int | None
    real_pose: np.ndarray | None
    motion: MotionType | None
    screws: ScrewSystem | None
    through_reference: bool | None
    residuals: tuple[float, ...]
    limits: tuple[int, ...]
    real_residuals: tuple[float, ...]
    singular_legs: tuple[int, ...] = ()

    __eq__ = equal_values

    @property
    def multiplicity(self) -> int | None:
        """In the scheme of the legs' equations; None where it is not known."""
        return self.component.multiplicity

    @property
    def motion_text(self) -> str:
        """What its poses have in common, in words, and whether these are said of complex poses."""
        if self.motion is None:
            return "?"
        if self.reality is ModeReality.REAL:
            return str(self.motion)
        known = ", real ones are not known" if self.reality is ModeReality.UNKNOWN else ""
        return f"{self.motion}, of complex poses{known}"

    @property
    def is_linear(self) -> bool:
        """Whether it is a linear space, given by its linear forms."""
        return self.degree == 1 and len(self.linear) == 7 - self.dimension

    @property
    def reached(self) -> bool:
        """Whether every leg is known to reach a general pose of it."""
        return all(r < REACHED for r in self.residuals)

    @property
    def pose_reached(self) -> bool:
        """Whether every leg is known to reach the real pose with real joint coordinates."""
        return bool(self.real_residuals) and all(r < REACHED for r in self.real_residuals)

    @property
    def really_reached(self) -> bool:
        """Whether every leg is known to reach a real pose with real joint coordinates.

        The reference is one.
        """
        return self.pose_reached or bool(self.through_reference)

    @property
    def equations(self) -> list[str]:
        """Its equations of the first and second degree as texts."""
        forms = [*reversed(self.linear), *self.quadratic]
        return [f"{f.text(COORDINATES)} = 0" for f in forms]

    def document(self) -> dict[str, Any]:
        """What is known of it as a JSON object, its component left out."""
        motion, screws = self.motion, self.screws
        return {
            "dimension": self.dimension,
            "degree": self.degree,
            # In documents 0 stands for what is not known.
            "multiplicity": self.multiplicity or 0,
            "reality": str(self.reality),
            "conjugate": None if self.conjugate is None else self.conjugate + 1,
            "through_reference": self.through_reference,
            "linear": [f.text(COORDINATES) for f in self.linear],
            "quadratic": [f.text(COORDINATES) for f in self.quadratic],
            "note": self.note,
            "motion": None
            if motion is None
            else {
                "rank": motion.rank,
                "turning": motion.turning,
                "group": motion.group,
                "text": self.motion_text,
            },
            "real_pose": None if self.real_pose is None else self.real_pose.tolist(),
            "screws": None
            if screws is None
            else {
                "rank": screws.rank,
                "turning": screws.turning,
                "pitches": list(screws.pitches),
            },
            "residuals": list(map(_finite, self.residuals)),
            "limits": [i + 1 for i in self.limits],
            "real_residuals": list(map(_finite, self.real_residuals)),
            "singular_legs": [i + 1 for i in self.singular_legs],
        }


@dataclass(frozen=True)
class Transition:
    """Where two modes meet.

    Attributes:
        modes: their indices.
        kinds: dimension and degree of each component of their intersection.
        note: why it is not known; empty where it is.
    """

    modes: tuple[int, int]
    kinds: tuple[tuple[int, int], ...]
    note: str = ""

    @property
    def open_text(self) -> str:
        """What is not known of it, and why."""
        pair = f"modes {self.modes[0] + 1} and {self.modes[1] + 1}"
        if self.kinds:
            return f"{pair} meet, and in what all is not known: {self.note}"
        return f"whether {pair} meet is not known: {self.note}"

    def document(self) -> dict[str, Any]:
        """It as a JSON object."""
        return {
            "modes": [i + 1 for i in self.modes],
            "components": [{"dimension": d, "degree": degree} for d, degree in self.kinds],
            "note": self.note,
        }


@dataclass(frozen=True)
class SpuriousComponent:
    """A component of the legs' equations that a leg does not reach.

    Attributes:
        dimension, degree: of the component.
        leg: the leg's name.
    """

    dimension: int
    degree: int
    leg: str


@dataclass(frozen=True, eq=False)
class OperationModes(Several[OperationMode]):
    """The operation modes of a parallel robot.

    Attributes:
        model: the system of the platform's pose.
        decomposition: of that system.
        modes: the components that every leg is known to reach, or may reach, by falling dimension.
        spurious: the other ones.
        transitions: of modes of positive dimension; pairs that do not meet are left out.
        notes: what a reader must know of an incomplete answer.
    """

    model: PlatformModel
    decomposition: Decomposition
    modes: tuple[OperationMode, ...]
    spurious: tuple[SpuriousComponent, ...]
    transitions: tuple[Transition, ...]
    notes: tuple[str, ...]

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[OperationMode, ...]:
        """The modes."""
        return self.modes

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each mode: dimension, degree, motion, reality, whether it has the reference.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        names = ("dimension", "degree", "through_reference")
        columns = {name: [getattr(mode, name) for mode in self.modes] for name in names}
        texts = {
            name: [str(getattr(m, name)) for m in self.modes] for name in ("motion", "reality")
        }
        return data_frame(columns | texts)

    @property
    def complete(self) -> bool:
        """Whether nothing is left undecided."""
        return not self.notes

    @property
    def moving(self) -> tuple[OperationMode, ...]:
        """The modes that are no single poses."""
        return tuple(m for m in self.modes if m.dimension)

    @property
    def isolated(self) -> tuple[OperationMode, ...]:
        """The single poses."""
        return tuple(m for m in self.modes if not m.dimension)

    @property
    def dimension_at_reference(self) -> int | None:
        """The largest dimension of a mode through the reference pose; None if not known."""
        if any(m.through_reference is None for m in self.modes):
            return None
        return max((m.dimension for m in self.modes if m.through_reference), default=None)

    def rows(self) -> list[Row]:
        """Labelled lines above the table: the robot, its legs, the answer."""
        robot = self.model.robot
        legs = Counter(leg.leg.letters for leg in self.model.legs)
        kinds = join_words([f"{count} {letters}" for letters, count in legs.items()])
        found = [
            ("platform", f"{robot.platform}, {kinds} between it and {robot.ground}"),
            *(("leg", _leg_text(leg)) for leg in self.model.legs),
        ]
        if robot.aside:
            names = ", ".join(j.name for j in robot.aside)
            found.append(("aside", f"joints of no leg: {names}"))
        system = self.model.system
        equations = count_text(len(system.polynomials), "equation")
        text = f"{equations} in {system.n} unknowns, the platform alone"
        found.append(("model", text))
        found.append(("answer", self.answer))
        # Transitions have lines of their own, which come later.
        if len(self.notes) > sum(bool(t.note) for t in self.transitions):
            found.append(("", "INCOMPLETE, see below"))
        return found

    @property
    def answer(self) -> str:
        """Modes counted by dimension and degree."""
        if not self.modes and not self.complete:
            return "no operation mode is known"
        limits = [m for m in self.moving if m.limits]
        own = [m for m in self.moving if not m.limits]
        text = count_text(len(own), "operation mode") + _kinds_text(own)
        unreal = sum(m.reality is ModeReality.CONJUGATE for m in own)
        if unreal:
            text += f"; {len(own) - unreal} of them real, {unreal} complex in conjugate pairs"
        if limits:
            text += f"; and {count_text(len(limits), 'component')}{_kinds_text(limits)}"
            text += ", that not all legs reach but in the limit"
        if self.isolated:
            real = sum(m.reality is ModeReality.REAL for m in self.isolated)
            text += f"; and {count_text(len(self.isolated), 'single pose')}, {real} of them real"
        return text

    def table(self) -> list[str]:
        """The modes that are no single poses, one line each."""
        if not self.moving:
            return []
        heads = ["mode", "dimension", "degree", "mult", "reality", "reference", "motion"]
        rows = [heads]
        for i, mode in enumerate(self.moving, 1):
            through = {True: "through", False: "-", None: "?"}[mode.through_reference]
            reality = str(mode.reality)
            if mode.conjugate is not None:
                reality = f"conjugate to {mode.conjugate + 1}"
            numbers = [str(i), str(mode.dimension), str(mode.degree), str(mode.multiplicity or "?")]
            rows.append([*numbers, reality, through, mode.motion_text])
        return align(rows, (4, 5, 6))

    def mode_rows(self) -> list[Row]:
        """Equations and screws of each mode that is no single pose."""
        found = []
        for i, mode in enumerate(self.moving, 1):
            parts = [_equations_text(mode)]
            if mode.screws is not None and mode.motion is not None and not mode.motion.group:
                reached = "" if mode.pose_reached else " that no joints were found to reach"
                where = f"at a real pose{reached}"
                parts.append(f"screw system {where} of {mode.screws}")
            if mode.reality is ModeReality.CONJUGATE:
                other = "its conjugate" if mode.conjugate is None else f"mode {mode.conjugate + 1}"
                parts.append(f"no real poses but some of those where it meets {other}")
            if mode.limits:
                names = join_words([self.model.legs[k].leg.name for k in mode.limits])
                leg = "leg" if len(mode.limits) == 1 else "legs"
                parts.append(f"of {leg} {names} the outer axes differ by an isotropic vector")
            elif mode.real_pose is not None and not mode.really_reached:
                parts.append("no real pose with real joint coordinates was found")
            found.append((f"mode {i}", "; ".join(parts)))
        return found

    def tail(self) -> list[Row]:
        """Labelled lines below: the reference, transitions, what is left out and open."""
        through = [str(i) for i, m in enumerate(self.modes, 1) if m.through_reference]
        found = []
        if through:
            kind = "modes" if len(through) > 1 else "mode"
            text = f"{kind} {join_words(through)} through the reference pose, the largest of "
            unreal = [
                str(i)
                for i, m in enumerate(self.modes, 1)
                if m.through_reference and m.reality is ModeReality.CONJUGATE
            ]
            text += f"dimension {self.dimension_at_reference}"
            if unreal:
                verb = "is" if len(unreal) == 1 else "are"
                text += f"; no real motion along {join_words(unreal)}, which {verb} complex"
            found.append(("reference", text))
        for t in self.transitions:
            pair = f"{t.modes[0] + 1} and {t.modes[1] + 1}"
            counts = Counter(t.kinds)
            listed = [
                f"dimension {d}, degree {degree}" + (f" ({count} times)" if count > 1 else "")
                for (d, degree), count in counts.items()
            ]
            if t.note:
                meeting = "they meet, and in what all is not known; found are "
                listed = [meeting + "; ".join(listed) if t.kinds else "not known whether they meet"]
            found.append(("transition", f"{pair}: {'; '.join(listed)}"))
        if len(self.moving) > 1 and not self.transitions:
            found.append(("transition", "no two modes meet"))
        own = [(i, m) for i, m in enumerate(self.modes, 1) if not m.limits]
        if own and all(m.reached for _, m in own):
            numbers = [str(i) for i, _ in own]
            kind = "modes" if len(own) > 1 else "mode"
            which = "every mode" if len(own) == len(self.modes) else f"{kind} {join_words(numbers)}"
            worst = max(r for _, m in own for r in m.residuals)
            text = f"every leg reaches a general pose of {which}, to {magnitude(worst)}"
            found.append(("reached", text))
        limits = [str(i) for i, m in enumerate(self.modes, 1) if m.limits]
        if limits:
            text = f"{join_words(limits)}: components of the closures of what legs reach; a leg "
            text += (
                "comes as near to their poses as one likes, and no joint coordinates of its own "
            )
            found.append(("limits", f"{text}give a general one"))
        for i, mode in enumerate(self.modes, 1):
            if mode.component.is_multiple:
                found.append(("multiple", f"mode {i}: {self._multiplicity_text(mode)}"))
        for each in self.spurious:
            text = f"a component of dimension {each.dimension}, degree {each.degree} of the "
            found.append(("left out", f"{text}equations, which leg {each.leg} does not reach"))
        found += [("open", note) for note in self.notes]
        found.append(("not seen", NOT_SEEN))
        return found

    def _multiplicity_text(self, mode: OperationMode) -> str:
        """What the multiplicity of a mode comes from."""
        text = f"multiplicity {mode.multiplicity} is that of the legs' equations together"
        names = [self.model.legs[k].leg.name for k in mode.singular_legs]
        if not names:
            return f"{text}, which touch all along it"
        legs = f"leg {names[0]} is" if len(names) == 1 else f"legs {join_words(names)} are"
        return f"{text}: those of {legs} singular all along it, whatever the other legs are"

    def document(self) -> dict[str, Any]:
        """The answer as a JSON object, witness sets left out."""
        robot = self.model.robot
        return {
            "notes": list(self.notes),
            "ground": robot.ground,
            "platform": robot.platform,
            "legs": [_leg_document(self.model, leg) for leg in self.model.legs],
            "aside": [j.name for j in robot.aside],
            "chart": [str(c) for c in self.model.chart],
            "origin": [str(c) for c in self.model.origin],
            "modes": [m.document() for m in self.modes],
            "spurious": [
                {"dimension": s.dimension, "degree": s.degree, "leg": s.leg} for s in self.spurious
            ],
            "transitions": [t.document() for t in self.transitions],
            "dimension_at_reference": self.dimension_at_reference,
        }

    __repr__ = one_line

    def __str__(self) -> str:
        blocks = self.rows(), self.table(), self.mode_rows(), self.tail()
        return "\n".join(sheet("OperationModes", *blocks))

    def _repr_html_(self) -> str:
        rows = [["", ""], *map(list, (*self.rows(), *self.mode_rows(), *self.tail()))]
        return html_table("OperationModes", rows)


def _kinds_text(modes: Sequence[OperationMode]) -> str:
    """Dimensions and degrees, after the number of modes."""
    counts = Counter((m.dimension, m.degree) for m in modes)
    kinds = [(count, f"of dimension {d}, degree {k}") for (d, k), count in counts.items()]
    if len(kinds) > 1:
        return f": {'; '.join(f'{count} {kind}' for count, kind in kinds)}"
    return f", {'each ' * (len(modes) > 1)}{kinds[0][1]}" if kinds else ""


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _equations_text(mode: OperationMode) -> str:
    if mode.note:
        return mode.note
    quadratic = mode.quadratic
    short = len(quadratic) <= MOST_EQUATIONS
    short &= all(len(f.terms) <= MOST_TERMS for f in quadratic)
    shown = mode.equations if short else mode.equations[: len(mode.linear)]
    if not short:
        shown.append(count_text(len(quadratic), "quadratic equation"))
    text = ", ".join(shown) or "no linear or quadratic equations"
    return f"{text}, of both conjugates" if mode.reality is ModeReality.CONJUGATE else text


def _leg_text(leg: LegEquations) -> str:
    degrees = Counter(f.degree for f in leg.image.forms)
    names = {1: "linear form", 2: "quadric", 3: "cubic", 4: "quartic"}
    forms = [count_text(count, names[d]) for d, count in sorted(degrees.items())]
    text = f"{leg.leg.letters} ({leg.leg.name}): {count_text(leg.dimension, 'freedom')}, "
    text += join_words(forms) or "no equations"
    if leg.kept:
        kept = dict.fromkeys(e.factor.joint for e in leg.kept if e.factor is not None)
        text += f" beside {join_words(list(kept))}, whose coordinates are kept"
    if leg.idle:
        text += f"; {count_text(leg.idle, 'freedom')} more leave the platform where it is"
    return text


def _leg_document(model: PlatformModel, leg: LegEquations) -> dict[str, Any]:
    return {
        "joints": [j.name for j in leg.leg.joints],
        "type": leg.leg.letters,
        "dimension": leg.dimension,
        "idle": leg.idle,
        "kept": list(dict.fromkeys(e.factor.joint for e in leg.kept if e.factor is not None)),
        "forms": [f.text(COORDINATES) for f in model.given_forms(leg)],
    }
