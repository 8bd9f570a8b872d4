"""All statements by subject, and the cases that the papers know the components of."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from nag.algebra.polynomial import Polynomial
from nag.algebra.rational_function import FunctionField
from nag.check import (
    bennett,
    bennett_elimination,
    bennett_geometry,
    bennett_special,
    bennett_variety,
    bricard,
    bricard_variety,
    four_bar,
    four_way,
    joints,
    known_planar,
    known_space,
    mechanisms,
    revolute,
    rotations,
    rows_of_four_bars,
    slider_crank,
    triangle,
)
from nag.check.four_way import Decompose, as_polynomial
from nag.check.known import KnownDecomposition, parameter_text
from nag.check.mechanisms import KnownMechanism, bennett_parameters
from nag.check.planar_mechanism import equal_sides
from nag.check.statement import Statement
from nag.mechanism.axes import cross, vanishes
from nag.mechanism.graph import Mechanism

if TYPE_CHECKING:
    from nag.files.cases import Case

Parameters = Mapping[str, Fraction]


@dataclass(frozen=True)
class Subject:
    """Statements about one thing.

    Attributes:
        title: what they are about.
        statements: those of the papers.
    """

    title: str
    statements: tuple[Statement, ...]


SUBJECTS = {
    "rotations": Subject("T25 section 2: Euler parameters", rotations.STATEMENTS),
    "revolute": Subject("T25 section 3: the revolute joint", revolute.STATEMENTS),
    "joints": Subject("PT13 sections 3, 5.1, 5.4: joints", joints.STATEMENTS),
    "triangle": Subject("PT13 sections 2, 5.2: a graph, three bars", triangle.STATEMENTS),
    "four-bar": Subject("PT13 section 5.3: the four-bar", four_bar.STATEMENTS),
    "rows": Subject("PT13 sections 5.3, 7.2: four-bars in a row", rows_of_four_bars.STATEMENTS),
    "slider crank": Subject("PT13 section 7.2: the slider crank", slider_crank.STATEMENTS),
    "bricard": Subject(
        "T25 section 4, PT13 section 5.5: Bricard's mechanism",
        bricard.STATEMENTS + bricard_variety.STATEMENTS,
    ),
    "bennett": Subject(
        "T25 sections 5, 6: Bennett's mechanism",
        bennett_geometry.STATEMENTS
        + bennett.STATEMENTS
        + bennett_elimination.STATEMENTS
        + bennett_variety.STATEMENTS
        + bennett_special.STATEMENTS,
    ),
}


@dataclass(frozen=True)
class SystemFamily:
    """Polynomial systems with known components.

    Attributes:
        subject: key of `SUBJECTS`.
        parameters: their names in a case.
        build: the system and its components at given parameters.
        examples: parameters at which ``nag check --all`` compares.
        admissible: whether the papers allow the parameters.
    """

    subject: str
    parameters: tuple[str, ...]
    build: Callable[[Parameters], KnownDecomposition]
    examples: tuple[tuple[str, ...], ...] = ((),)
    admissible: Callable[[Parameters], bool] = lambda given: True


EQUAL, APART = ("1", "1"), ("2", "1")
SYSTEMS = (
    SystemFamily("triangle", (), known_space.graph),
    SystemFamily(
        "triangle",
        ("L1", "L2"),
        known_space.three_bars,
        (("3/2", "5/4"),),
        known_space.is_triangle,
    ),
    SystemFamily(
        "four-bar", ("a", "b"), known_planar.free_four_bar, (APART, EQUAL), known_planar.positive
    ),
    SystemFamily(
        "four-bar", ("a", "b"), known_planar.fixed_four_bar, (APART, EQUAL), known_planar.positive
    ),
    SystemFamily(
        "rows", ("a", "b"), known_planar.two_four_bars, (("3", "5/2"), EQUAL), known_planar.positive
    ),
    SystemFamily("rows", (), known_planar.gonzalez),
    SystemFamily("slider crank", (), known_planar.slider),
    SystemFamily("bricard", (), known_space.bricards_variety),
    SystemFamily(
        "bennett",
        ("m0", "m1", "m2"),
        known_space.bennetts_variety,
        (("7/4", "5/6", "1/3"),),
        known_space.has_variety,
    ),
)
# Subjects that have cases.
WITH_CASES = tuple(key for key in SUBJECTS if any(family.subject == key for family in SYSTEMS))
# Parameters of Bennett's mechanism: T25's own, others outside Omega, and q5 = 0.
BENNETT = (("7/4", "5/6", "1/3"), ("-3/2", "-2/5", "7/3"), ("7/4", "56/33", "1/3"))


@dataclass(frozen=True)
class Recognised:
    """What a case is, to the papers.

    Attributes:
        subject: what they state about it.
        comparison: the four ways in which its decomposition is compared with them.
    """

    subject: Subject
    comparison: tuple[Statement, ...]


def everything(decompose: Decompose) -> list[tuple[str, tuple[Statement, ...]]]:
    """All statements and comparisons, under their titles."""
    found = []
    for key, subject in SUBJECTS.items():
        found.append((subject.title, subject.statements))
        compared: list[Statement] = []
        for family in SYSTEMS:
            if family.subject == key:
                for values in family.examples:
                    given = dict(zip(family.parameters, map(Fraction, values), strict=True))
                    compared += four_way.four_ways(_named(family, given), decompose)
        if key == "bricard":
            compared += mechanisms.four_ways(mechanisms.known_bricard(), decompose)
        if key == "bennett":
            for values in BENNETT:
                known = mechanisms.known_bennett(tuple(map(Fraction, values)))
                compared += mechanisms.four_ways(known, decompose)
        if compared:
            found.append((f"{subject.title}: decompositions", tuple(compared)))
    return found


def _named(family: SystemFamily, given: Parameters) -> KnownDecomposition:
    """The family at given parameters, which its name says."""
    known = family.build(given)
    if not given:
        return known
    text = parameter_text(", ".join(f"{k} = {v}" for k, v in given.items()))
    return KnownDecomposition(
        f"{known.name}, {text}", known.variables, known.equations, known.components
    )


def recognised(case: Case, decompose: Decompose) -> Recognised | None:
    """What the papers know of a case, found by its equations or joints, never by its name."""
    if case.mechanism is not None:
        for subject, known in _mechanisms(case, case.mechanism):
            if same_mechanism(case.mechanism, known.mechanism):
                return Recognised(SUBJECTS[subject], mechanisms.four_ways(known, decompose))
        return _planar(case.mechanism, decompose)
    for family in SYSTEMS:
        given = {k: case.parameters[k] for k in family.parameters if k in case.parameters}
        exact = all(isinstance(x, Fraction) for x in given.values())
        if len(given) < len(family.parameters) or not exact or not family.admissible(given):
            continue
        known = _named(family, given)
        if _same_system(case, known):
            return Recognised(SUBJECTS[family.subject], four_way.four_ways(known, decompose))
    return None


def _planar(mechanism: Mechanism, decompose: Decompose) -> Recognised | None:
    found = equal_sides(mechanism)
    if found is None:
        return None
    known = known_planar.fixed_four_bar(dict(zip("ab", found.sides, strict=True)))
    ways = four_way.four_ways(known, lambda _: decompose(found.model.system), found.coordinates)
    return Recognised(SUBJECTS["four-bar"], ways)


def _mechanisms(case: Case, mechanism: Mechanism) -> Sequence[tuple[str, KnownMechanism]]:
    found = [("bricard", mechanisms.known_bricard())]
    # Lemma 5.2: several m have the same points. A case's own are preferred.
    own = tuple(case.parameters.get(k) for k in ("m0", "m1", "m2"))
    for m in sorted(bennett_parameters(mechanism), key=lambda m: m != own):
        if known_space.in_omega(m):
            found.append(("bennett", mechanisms.known_bennett(m)))
    return found


def same_mechanism(left: Mechanism, right: Mechanism) -> bool:
    """Whether they have the same axes between the same bodies, in the same order.

    The direction in which a case gives an axis does not matter.
    """
    if len(left.joints) != len(right.joints):
        return False
    names = {left.ground: right.ground}
    for a, b in zip(left.joints, right.joints, strict=True):
        for x, y in zip(a.bodies, b.bodies, strict=True):
            if names.setdefault(x, y) != y:
                return False
        if a.type != b.type or a.point != b.point:
            return False
        if not vanishes(cross(a.axis, b.axis)):
            return False
    return len(set(names.values())) == len(names)


def _same_system(case: Case, known: KnownDecomposition) -> bool:
    """Whether the equations are the same up to order and constant factors."""
    if case.system is None or set(case.system.variables) != set(known.variables):
        return False
    names = case.system.variables
    field = FunctionField(names, "degrevlex")
    by_name = dict(zip(names, field.variables, strict=True))
    functions: list[Any] = known.equations([by_name[x] for x in known.variables])
    wanted = {_monic(as_polynomial(f.numerator)) for f in functions if f}
    return wanted == {_monic(f) for f in case.system.polynomials if f}


def _monic(f: Polynomial) -> Polynomial:
    return f / f.terms[max(f.terms)]
