"""Case files: a polynomial system or a mechanism, and what is known about it, in TOML.

Polynomial systems are read from other programs' files as well (`nag.files.formats`). A case file is
data: nothing in it is evaluated as code, and its size and the work that its expressions ask for are
bounded before they are spent.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from nag.algebra.bounded import Budget
from nag.algebra.expression import parse_number, parse_polynomial
from nag.algebra.family import Family
from nag.algebra.fixed_mapping import FixedMapping
from nag.algebra.given import check_path, reading_options
from nag.algebra.imaginary_unit import (
    adjoin_unit,
    has_imaginary_root,
    name_unit,
    parse_parameter,
    values_with_unit,
    write_out_unit,
)
from nag.algebra.number import ComplexNumber, Number, brief_number_text
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation, SymmetryError, check_symmetry
from nag.algebra.system import NamedPoint, PolynomialSystem
from nag.algebra.tokens import (
    ONLY_REAL,
    ExpressionError,
    is_name,
    names_in,
    nearest,
    quote,
    taken_text,
)
from nag.errors import NagError
from nag.files.case_table import (
    CaseError,
    CaseTable,
    ExportGiven,
    ReadNumber,
    kind_of,
    line_of,
    parse_toml,
    read_case_text,
    read_parameters,
    wanted_text,
    with_values,
)
from nag.files.formats import READ, ROBOTS
from nag.mechanism import FORMULATIONS, PLATFORM_ALONE
from nag.text.table import count_text, lines_of, one_line

if TYPE_CHECKING:
    from nag.algebra.symmetric_family import FamilyMember
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.dh import DHLoop
    from nag.mechanism.framework import Framework
    from nag.mechanism.graph import Mechanism
    from nag.mechanism.linkage import Linkage

__all__ = ["Case", "CaseError", "NamedPoint", "Truth", "TruthAtReference", "read_case"]


_TOML = re.compile(r"^[ \t]*(?:title|kind)[ \t]*=[ \t]*[\"']", re.MULTILINE)

CaseKind = Literal["system", "mechanism", "dh", "robot", "framework", "linkage"]

_KEYS = {
    "system": (
        "title",
        "kind",
        "variables",
        "equations",
        "imaginary",
        "groups",
        "parameters",
        "family",
        "symmetry",
        "point",
        "truth",
    ),
    "mechanism": ("title", "kind", "ground", "parameters", "joint", "body", "truth"),
    "dh": ("title", "kind", "parameters", "joint", "truth"),
    "robot": ("title", "kind", "parameters", "file", "hold", "at", "closure", "truth"),
    "framework": (
        "title",
        "kind",
        "parameters",
        "dimension",
        "points",
        "bars",
        "lengths",
        "squared_lengths",
        "point",
        "truth",
    ),
    "linkage": ("title", "kind", "parameters", "ground", "link", "point", "truth"),
}
# What a case of each kind cannot be without, and what to write.
_NEEDED = {
    "system": {
        "variables": "a list of names of variables",
        "equations": "a list of equations",
    },
    "mechanism": {
        "ground": wanted_text("ground"),
        "joint": "a table [[joint]] for every joint",
    },
    "dh": {"joint": "a table [[joint]] for every joint"},
    "robot": {"file": wanted_text("file")},
    "framework": {
        "points": "a list of names of points",
        "bars": 'a list of pairs of points ["A", "B"]',
    },
    "linkage": {
        "ground": wanted_text("ground"),
        "link": "a table [[link]] for every link, the ground included",
    },
}
# Kinds of which `nag init` writes a case.
_WRITTEN = ("system", "mechanism", "linkage", "framework", "dh")
_TRUTH_KEYS = (
    "dimension",
    "degree",
    "count",
    "multiplicity",
    "multidegree",
    "formulation",
    "source",
)


@dataclass(frozen=True)
class Truth:
    """``count`` irreducible components over the complex numbers that are known to be there.

    Attributes:
        dimension: of each.
        degree: of each, in the variables of the system.
        count: how many there are.
        multiplicity: of each.
        multidegree: of each in the system's variable groups, nested by dimension, or None.
        formulation: formulation of the mechanism for which this holds, "P" for the poses of its
            platform, or None for a system.
        source: where it is known from.
    """

    dimension: int
    degree: int
    count: int = 1
    multiplicity: int = 1
    multidegree: tuple[Any, ...] | None = None
    formulation: str | None = None
    source: str = ""


@dataclass(frozen=True)
class TruthAtReference:
    """What is known of the reference configuration alone.

    Attributes:
        dimension: the local dimension, in all freedoms: the mobility.
        tangent_dimension: of the configuration space's tangent space there.
        source: where it is known from.
    """

    dimension: int
    tangent_dimension: int
    source: str


@dataclass(frozen=True)
class Case:
    """A case file, read and checked. Either `system` or `mechanism` is there.

    `symmetries` are those that the file declares; each was verified exactly on the equations.
    `family` is the one that the file declares the system to belong to. Of a framework, a linkage
    and a table of joints these are `parts`; where they do not fix how they are assembled,
    `assembly` is the model of all ways, and `system` is its own. Where parameters are declared and
    have no value, they are `unset`, and the last variables of `system`: nothing is asked of a case
    before they have one, or are the parameters of a family. What the
    `notes` say is what numbers of a robot's file were taken for, and what is not used. What the
    file says is known, of components (`truth`) or at the reference configuration alone
    (`truth_at_reference`), is left out where parameters were given other values.
    """

    title: str
    kind: CaseKind
    path: Path = field(compare=False)
    parameters: Mapping[str, Number | ComplexNumber]
    system: PolynomialSystem | None = None
    mechanism: Mechanism | None = None
    points: tuple[NamedPoint, ...] = ()
    truth: tuple[Truth, ...] = ()
    symmetries: tuple[SignedPermutation, ...] = ()
    family: FamilyMember | None = None
    unset: tuple[str, ...] = ()
    parts: Framework | Linkage | DHLoop | None = None
    assembly: AssemblyModel | None = None
    truth_at_reference: TruthAtReference | None = None
    notes: tuple[str, ...] = field(default=(), compare=False)
    text: str = field(default="", compare=False)
    format: str = field(default="toml", compare=False)
    set: Mapping[str, str | Number] = field(default_factory=lambda: FixedMapping({}), compare=False)

    __repr__ = one_line

    def __str__(self) -> str:
        rows = [("kind", self.kind)]
        if self.parameters:
            values = (f"{name} = {brief_number_text(x)}" for name, x in self.parameters.items())
            rows.append(("parameters", ", ".join(values)))
        if self.points:
            rows.append(("points", ", ".join(point.name for point in self.points)))
        described = one_line(self.described)[1:-1]
        return lines_of(f'Case "{self.title}"', [*rows, ("describes", described)])

    @property
    def described(self) -> Mechanism | Framework | Linkage | DHLoop | PolynomialSystem:
        """What the file describes: a mechanism, parts of one, or equations."""
        given = self.mechanism or self.system if self.parts is None else self.parts
        if given is None:
            raise NagError("a case without a system and without a mechanism")
        return given

    @property
    def problem_source(self) -> Mechanism | AssemblyModel | PolynomialSystem:
        """What its problem is made of: a mechanism, the model of its assemblies, or equations.

        Raises:
            CaseError: if parameters have no values.
        """
        self.refuse_unset()
        if self.mechanism is not None:
            return self.mechanism
        given = self.system if self.assembly is None else self.assembly
        if given is None:
            raise NagError("a case without a system and without a mechanism")
        return given

    def refuse_unset(self) -> None:
        """Make sure that all parameters have values.

        Raises:
            CaseError: otherwise.
        """
        if self.unset:
            names, first = ", ".join(self.unset), self.unset[0]
            what, them = f"parameter {names} has no value", "it"
            if len(self.unset) > 1:
                what, them = f"parameters {names} have no values", "each"
            raise CaseError(
                f"{self.path}: {what}; solve for many values with nag family, or set {them}, as "
                f"{first}=1"
            ).mended_by("set")

    @property
    def note_rows(self) -> list[tuple[str, str]]:
        """What its file was taken for, as labelled lines."""
        return [("read", note) for note in self.notes]

    def known_in(self, formulation: str | None) -> tuple[Truth, ...]:
        """What is known of the system in a formulation."""
        return tuple(t for t in self.truth if t.formulation in (None, formulation))


def read_case(
    path: str | os.PathLike[str],
    set: Mapping[str, str | Number] | None = None,
    *,
    format: str = "auto",
    hold: Sequence[str] = (),
    at: Mapping[str, str | Number] | None = None,
) -> Case:
    """Read the case file at ``path``.

    Args:
        set: numbers or expressions for some of the parameters, in place of the file's.
        format: one of `nag.files.formats.READ`; by default told by the content.
        hold: links of a robot (URDF, MJCF) that are fixed to the ground.
        at: angles in radians and lengths of a robot's joints at its reference configuration, 0 by
            default.

    Raises:
        CaseError: if it cannot be read or makes no sense; one line says where and what would be
            right.

    >>> import nag
    >>> case = nag.read_case("cases/slider-crank.toml")
    >>> case.kind, case.system.n, [point.name for point in case.points]
    ('system', 6, ['singular, s1 = -1', 'singular, s1 = 1'])
    """
    check_path(path)
    path = Path(path)
    how = reading_options(set, format, hold, at)
    set, hold, at = how["set"], how["hold"], how["at"]
    text = read_case_text(path)
    chosen = _format_of(path, text, format)
    case = _case_of_text(path, text, (format, chosen), set or {}, hold, at)
    return replace(case, text=text, format=chosen, set=FixedMapping(set or {}))


def case_of_text(path: Path, text: str) -> Case:
    """The case of a text in TOML, as if it were that of the file at ``path``.

    Raises:
        CaseError: if it makes no sense.
    """
    case = _case_of_text(path, text, ("toml", "toml"), {}, (), None)
    return replace(case, text=text)


def case_with(case: Case, values: Mapping[str, str | Number]) -> Case:
    """The same case with other values of some parameters.

    Raises:
        CaseError: if it has no such parameters, or makes no sense with these values.
    """
    given = {**case.set, **values}
    formats = (case.format, case.format)
    made = _case_of_text(Path(case.path), case.text, formats, given, (), None)
    return replace(made, text=case.text, format=case.format, set=FixedMapping(given))


def _case_of_text(
    path: Path,
    text: str,
    formats: tuple[str, str],
    values: Mapping[str, str | Number],
    hold: Sequence[str],
    at: Mapping[str, str | Number] | None,
) -> Case:
    """The case of a file; ``formats``: the one that is asked for, and the one that it has."""
    format, chosen = formats
    if chosen in ROBOTS:
        return _robot_case(path, text, chosen, values, hold, at or {})
    if hold or at is not None:
        option = "hold" if hold else "at"
        message = f"{option}: is for robots in URDF or MJCF; leave it out, or write it in the case"
        raise CaseError(line_of(str(path), message))
    if chosen != "toml":
        try:
            return _system_case(path, text, chosen, values)
        except CaseError as error:
            if (format, chosen) != ("auto", "text"):
                raise
            # Whatever is no other format is taken for this one.
            raise CaseError(f"{error} (read as plain text, a polynomial a line)") from None
    top = CaseTable(str(path), "", parse_toml(path, text))
    for key in {"plate", "plates"} & top.values.keys():
        top.fail(key, 'plates are links of kind = "linkage": [[link]] with pins and their shape')
    top.allow(sorted({key for keys in _KEYS.values() for key in keys}))
    _refuse_misplaced(top)
    _require_all(top)
    kind = top.text("kind")
    if kind not in _KEYS:
        top.fail("kind", f"{quote(kind)} is no kind of case; write one of {', '.join(_KEYS)}")
    title = top.text("title")
    budget = Budget()
    table = top.table("parameters")
    variables = top.values.get("variables")
    unit = _unit_name(top) if kind == "system" else None
    unit = None if isinstance(variables, list) and unit in variables else unit
    parameters = read_parameters(table, budget, unit)
    truth, at_reference = _read_truth(top, kind)
    if values:
        changed = read_parameters(with_values(table, values), budget, unit)
        if changed != parameters:
            truth, at_reference = (), None
        parameters = changed
    numbers = _Numbers(parameters, budget)
    if kind != "system":
        parts, made, notes = _read_parts(kind, top, numbers.number)
        case = _assembly_case(made, title=title, kind=kind, path=path, truth=truth, of=parameters)
        case = replace(case, truth_at_reference=at_reference, notes=notes, parts=parts)
        return _with_points(case, top, numbers)
    system, family = _read_system(top, numbers)
    return Case(
        title,
        "system",
        path,
        parameters,
        system=system,
        points=_read_points(top, system, numbers),
        truth=truth,
        symmetries=_read_symmetries(top, system),
        family=family,
    )


def _refuse_misplaced(top: CaseTable) -> None:
    """Complain about a key that a case of another kind has."""
    kind = top.values.get("kind")
    own = _KEYS.get(kind) if isinstance(kind, str) else None
    for key in [] if own is None else sorted(top.values.keys() - set(own)):
        other = next(k for k, keys in _KEYS.items() if key in keys)
        top.fail(key, f"belongs to a case of kind {other!r}; leave it out")


def _require_all(top: CaseTable) -> None:
    """Complain about all that a case of its kind cannot be without, at once."""
    kind = top.values.get("kind")
    needed = {
        "title": wanted_text("title"),
        "kind": f"{wanted_text('kind')}, one of {', '.join(_KEYS)}",
    }
    if isinstance(kind, str) and kind in _NEEDED:
        needed |= _NEEDED[kind]
    elif "kind" in top.values:
        return
    # Of other kinds none is written, and who left the kind out may choose among those that are.
    hint = f" (`nag init {kind}` prints a whole case)" if kind in _WRITTEN else ""
    if kind is None:
        hint = " (`nag init system`, mechanism, linkage, framework or dh prints a whole case)"
    top.require(needed, hint)


def _format_of(path: Path, text: str, format: str) -> str:
    """The format of a file that is asked for, else the one that its name or its text tells."""
    if format != "auto":
        if format not in READ:
            raise CaseError(f"format: {quote(format)} is unknown; write one of {', '.join(READ)}")
        return format
    if path.suffix == ".toml" or _TOML.search(text):
        return "toml"
    if text.lstrip().startswith("<"):
        from nag.files.robots.reading import recognise_robot

        return recognise_robot(str(path), text)
    from nag.files.formats.reading import recognise_format

    return recognise_format(text)


def parameter_table(path: Path, values: Mapping[str, Any]) -> CaseTable:
    """The parameters of a case, as they are written, from what its file holds."""
    return CaseTable(str(path), "", values).table("parameters")


def is_robot(path: str | os.PathLike[str], format: str = "auto") -> bool:
    """Whether a file is one of a robot, by its format: if that is not given, by its content."""
    try:
        text = read_case_text(Path(path))
    except ExportGiven:
        return False
    return _format_of(Path(path), text, format) in ROBOTS


def _robot_case(
    path: Path,
    text: str,
    format: str,
    values: Mapping[str, str | Number] | None,
    hold: Sequence[str],
    at: Mapping[str, str | Number],
) -> Case:
    from nag.files.robots.reading import read_robot
    from nag.files.robots.robot import assemble

    if values:
        raise CaseError(line_of(str(path), "has no parameters; joint values are given by `at`"))
    robot = read_robot(str(path), text, format)
    mechanism, notes = assemble(robot, str(path), hold, at)
    held = f", {', '.join(hold)} held" if hold else ""
    return Case(robot.title + held, "mechanism", path, {}, mechanism=mechanism, notes=notes)


def _system_case(
    path: Path, text: str, format: str, values: Mapping[str, str | Number] | None
) -> Case:
    from nag.files.formats.reading import read_system_text

    system, parameters, unset = read_system_text(str(path), text, format, values)
    return Case(path.name, "system", path, parameters, system=system, unset=unset)


def as_unknowns(case: Case, names: Sequence[str]) -> Case:
    """The same case, where parameters of these names need no value: they are unknowns."""
    return replace(case, unset=tuple(name for name in case.unset if name not in names))


def freed_system(case: Case, names: Sequence[str]) -> PolynomialSystem:
    """The equations of a case; the parameters ``names`` are its last variables.

    Raises:
        CaseError: if the case is no polynomial system, has no such parameters, or has others that
            depend on them.
    """
    path, text, values = case.path, case.text, dict(case.set)
    if case.system is None or case.assembly is not None:
        raise CaseError(
            f"{path}: is a mechanism, and parameters are freed in polynomial systems only; "
            "ask about one value after the other"
        ).mended_by("set")
    for name in names:
        declared = (*case.parameters, *case.unset)
        if name not in declared:
            raise CaseError(
                f"{path}: {quote(name)} is no parameter{nearest(name, declared)}; it has "
                f"{', '.join(declared) or 'none'}"
            )
    as_unknowns(case, names).refuse_unset()
    if case.format != "toml":
        from nag.files.formats.reading import read_system_text

        return read_system_text(str(path), text, case.format, values, freed=names)[0]
    top = CaseTable(str(path), "", parse_toml(path, text))
    for other, given in with_values(top.table("parameters"), values).values.items():
        used = sorted(names_in(given) & {*names}) if isinstance(given, str) else []
        if used and other not in names:
            raise CaseError(f"{path}: parameters: {other}: depends on {used[0]}; free it as well")
    own = case.system.variables
    unit = own[-1] if case.system.imaginary else None
    variables = [*(own if unit is None else own[:-1]), *names, *(() if unit is None else (unit,))]
    known = {name: value for name, value in case.parameters.items() if name not in names}
    equations = _read_equations(top, _Numbers(known, Budget()), variables, unit)
    if unit is not None:
        return adjoin_unit(variables, equations)
    return PolynomialSystem(tuple(variables), equations)


def _read_parts(
    kind: str, top: CaseTable, number: ReadNumber
) -> tuple[Framework | Linkage | DHLoop | None, AssemblyModel | Mechanism, tuple[str, ...]]:
    """What parts are given, what they make, and the notes of `Case`.

    They make the model of all assemblies, or a mechanism where that is fixed.
    """
    if kind == "robot":
        from nag.files.robot_case import read_robot_case

        return None, *read_robot_case(top, number)
    if kind == "mechanism":
        from nag.files.mechanism_case import read_mechanism

        return None, read_mechanism(top, number), ()
    if kind == "dh":
        from nag.files.dh_case import read_dh

        return *read_dh(top, number), ()
    if kind == "framework":
        from nag.files.framework_case import read_framework

        return *read_framework(top, number), ()
    from nag.files.linkage_case import read_linkage

    return *read_linkage(top, number), ()


def _assembly_case(
    made: AssemblyModel | Mechanism,
    *,
    title: str,
    kind: CaseKind,
    path: Path,
    truth: tuple[Truth, ...],
    of: Mapping[str, Number],
) -> Case:
    from nag.mechanism.graph import Mechanism
    from nag.mechanism.problem import problem_of

    if isinstance(made, Mechanism):
        # A robot is a mechanism once its file is read.
        kind = "mechanism" if kind == "robot" else kind
        return Case(title, kind, path, of, mechanism=made, truth=truth)
    problem = problem_of(made)
    # What is known of half-angles says nothing of Euler parameters.
    truth = tuple(replace(t, formulation=t.formulation or problem.formulation) for t in truth)
    return Case(
        title,
        kind,
        path,
        of,
        system=made.system,
        points=problem.points,
        truth=truth,
        symmetries=made.symmetries,
        assembly=made,
    )


def _with_points(case: Case, top: CaseTable, numbers: _Numbers) -> Case:
    if case.system is None:
        if "point" in top.values:
            top.fail("point", "the places fix the point, `reference`; leave it out")
        return case
    named = _read_points(top, case.system, numbers, case.points)
    return replace(case, points=(*case.points, *named))


@dataclass(frozen=True)
class _Numbers:
    """Reads numbers and polynomials with the parameters of the case, on one budget."""

    parameters: Mapping[str, Number | ComplexNumber]
    budget: Budget

    def number(self, value: Any) -> Number:
        real = {k: v for k, v in self.parameters.items() if not isinstance(v, ComplexNumber)}
        used = names_in(value) - real.keys() if isinstance(value, str) else frozenset()
        for name in sorted(used & self.parameters.keys()):
            raise ExpressionError(f"{name} is complex; {ONLY_REAL}")
        return parse_number(value, real, self.budget)

    def polynomial(
        self, text: str, variables: Sequence[str], unit: str | None = None
    ) -> Polynomial:
        """The polynomial that a text spells; with ``unit``, the last variable is that one."""
        known = self.parameters if unit is None else values_with_unit(self.parameters, variables)
        known = {k: v for k, v in known.items() if k not in variables}
        return parse_polynomial(text, variables, known, self.budget, unit=unit)


def _read_system(top: CaseTable, numbers: _Numbers) -> tuple[PolynomialSystem, FamilyMember | None]:
    variables = top.texts("variables", "names of variables")
    for i, name in enumerate(variables, 1):
        if not is_name(name):
            top.fail(
                f"variables {i}",
                f"{quote(name)} cannot name a variable; use letters, digits and _, not a function",
            )
        if name in variables[: i - 1]:
            top.fail(f"variables {i}", f"{quote(name)} is there twice; name each variable once")
        if name in numbers.parameters:
            top.fail(f"variables {i}", f"{quote(name)} is a parameter as well; rename one of them")
    groups = _read_groups(top, variables)
    unit, taken = _unit_name(top), [*variables, *numbers.parameters]
    complex_ = {k for k, v in numbers.parameters.items() if isinstance(v, ComplexNumber)}
    if unit not in taken:
        complex_.add(unit)
    elif "imaginary" in top.values:
        top.fail("imaginary", taken_text(unit))
    else:
        unit = name_unit(taken)
    texts = top.texts("equations", "equations")
    is_complex = any(
        names_in(text) & complex_ or has_imaginary_root(text, variables, numbers.parameters)
        for text in texts
    )
    if "family" in top.values:
        family = _read_family(top, numbers, variables, unit, complex_)
        system = family.symmetric.original.at(family.values)
        if system.imaginary:
            return adjoin_unit(system.variables, system.polynomials[:-1], groups=groups), family
        return PolynomialSystem(tuple(variables), system.polynomials, groups=groups), family
    if not is_complex:
        equations = _read_equations(top, numbers, variables)
        return PolynomialSystem(tuple(variables), equations, groups=groups), None
    names = [*variables, unit]
    return adjoin_unit(names, _read_equations(top, numbers, names, unit), groups=groups), None


def _unit_name(top: CaseTable) -> str:
    """What a case calls the imaginary unit: ``I``, or what it says."""
    if "imaginary" not in top.values:
        return "I"
    unit = top.text("imaginary")
    if not is_name(unit):
        top.fail("imaginary", f"{quote(unit)} is no name; write a letter of its own")
    return unit


def _read_equations(
    top: CaseTable, numbers: _Numbers, names: list[str], unit: str | None = None
) -> tuple[Polynomial, ...]:
    equations = []
    for i, text in enumerate(top.texts("equations", "equations"), 1):
        with top.at(f"equations {i}"):
            equations.append(numbers.polynomial(text, names, unit))
    return tuple(equations)


def _read_family(
    top: CaseTable, numbers: _Numbers, variables: list[str], unit: str, complex_: set[str]
) -> FamilyMember:
    """The family of a system; ``complex_`` are names of what is complex, one of them ``unit``."""
    from nag.files.case_family import family_parameters, read_family

    table = top.table("family")
    free = family_parameters(table, numbers.parameters)
    names = [*variables, *free]
    texts = top.texts("equations", "equations")
    is_complex = any(
        names_in(text) & complex_ - {*free} or has_imaginary_root(text, names, numbers.parameters)
        for text in texts
    )
    if is_complex:
        names.append(unit)
    equations = _read_equations(top, numbers, names, unit if is_complex else None)
    if len(equations) != len(variables):
        table.fail(
            None,
            f"{count_text(len(equations), 'equation')} in "
            f"{count_text(len(variables), 'variable')}; a family has as many of them, so leave it "
            "out",
        )
    values = [numbers.parameters[name] for name in free]
    parts = [part for v in values for part in (v if isinstance(v, ComplexNumber) else (v,))]
    if not all(isinstance(v, Fraction) for v in parts) or not all(f.exact for f in equations):
        table.fail(None, "has irrational numbers; write rational ones, or leave it out")
    if is_complex:
        family = Family.of_system(adjoin_unit(names, equations), len(free))
    else:
        family = Family(tuple(variables), tuple(free), equations)
    return read_family(table, family, values, numbers.polynomial)


def _read_groups(top: CaseTable, variables: list[str]) -> tuple[tuple[int, ...], ...]:
    if "groups" not in top.values:
        return ()
    groups, seen = [], set()
    for i, group in enumerate(top.items("groups", "lists of variables"), 1):
        if not isinstance(group, list) or not group or not all(isinstance(g, str) for g in group):
            top.fail(f"groups {i}", "is no list of names; write a list of variables")
        for name in group:
            if name not in variables:
                top.fail(
                    f"groups {i}",
                    f"unknown variable {quote(name)}{nearest(name, variables)}; "
                    "write names from 'variables'",
                )
            if name in seen:
                top.fail(f"groups {i}", f"{name!r} is in a group already; write it in one only")
            seen.add(name)
        groups.append(tuple(variables.index(name) for name in group))
    missing = [name for name in variables if name not in seen]
    if missing:
        top.fail("groups", f"{missing[0]!r} is in no group; write every variable in one group")
    return tuple(groups)


def _read_points(
    top: CaseTable, system: PolynomialSystem, numbers: _Numbers, known: Sequence[NamedPoint] = ()
) -> tuple[NamedPoint, ...]:
    """The named points, besides those that are known."""
    points: list[NamedPoint] = []
    for table in top.tables("point"):
        table.allow(("name", "at"))
        name = table.text("name")
        table = table.called(name)
        if any(name == p.name for p in (*known, *points)):
            table.fail("name", "another point has that name; give each a name of its own")
        coordinates = CaseTable(
            table.file, f"{table.place}: at", table.get("at", dict, "{ variable = number, ... }")
        )
        coordinates.allow(system.own_variables)
        at: list[Number | complex] = []
        for variable in system.own_variables:
            if variable not in coordinates.values:
                coordinates.fail(variable, "is missing; give a number for every variable")
            with coordinates.at(variable):
                at.append(_read_coordinate(coordinates.values[variable], system, numbers))
        points.append(NamedPoint(name, (*at, *[1j] * system.imaginary)))
    return tuple(points)


def _read_coordinate(value: Any, system: PolynomialSystem, numbers: _Numbers) -> Number | complex:
    """A point's coordinate, in doubles where it is complex."""
    taken = {*system.own_variables, *numbers.parameters}
    units = [unit for unit in (*system.variables[-1:], "I") if unit not in taken]
    complex_ = {k for k, v in numbers.parameters.items() if isinstance(v, ComplexNumber)}
    if isinstance(value, str) and units:
        value = write_out_unit(value, units[0])
    if isinstance(value, str) and names_in(value) & {*units, *complex_}:
        found = parse_parameter(value, units or ["I"], numbers.parameters, numbers.budget)
        return complex(found) if isinstance(found, ComplexNumber) else found
    return numbers.number(value)


def _read_symmetries(top: CaseTable, system: PolynomialSystem) -> tuple[SignedPermutation, ...]:
    symmetries = []
    for table in top.tables("symmetry"):
        table.allow(("map",))
        wanted = '{ variable = "-variable", ... }'
        images = table.get("map", dict, wanted)
        for name, image in images.items():
            if not isinstance(image, str):
                table.fail("map", f"{quote(name)} is {kind_of(image)}; write {wanted}")
        try:
            symmetry = SignedPermutation.of_map(images, system.variables)
        except SymmetryError as error:
            table.fail("map", str(error))
        try:
            check_symmetry(system, symmetry)
        except SymmetryError as error:
            table.fail("map", f"is no symmetry: {error}; correct it or leave it out")
        symmetries.append(symmetry)
    return tuple(symmetries)


def _read_truth(top: CaseTable, kind: str) -> tuple[tuple[Truth, ...], TruthAtReference | None]:
    known = top.table("truth")
    known.allow(("component", "reference"))
    components = tuple(_read_component(t, kind) for t in known.tables("component", "truth."))
    if "reference" not in known.values:
        return components, None
    placed = kind in ("mechanism", "robot") or isinstance(top.values.get("points"), dict)
    if not placed:
        known.fail("reference", "there is no reference configuration; give components instead")
    table = known.table("reference")
    table.allow(("dimension", "tangent_dimension", "source"))
    dimension = table.count("dimension", 0)
    tangent = table.count("tangent_dimension", 0)
    if tangent < dimension:
        table.fail("tangent_dimension", f"is {tangent}; it is as much as the dimension, or more")
    return components, TruthAtReference(dimension, tangent, table.text("source"))


def _read_component(table: CaseTable, kind: str) -> Truth:
    table.allow(_TRUTH_KEYS)
    formulation = None
    if "formulation" in table.values:
        if kind not in ("mechanism", "dh", "robot"):
            table.fail("formulation", "a system has no formulation; leave it out")
        formulation = table.text("formulation")
        if formulation not in (*FORMULATIONS, PLATFORM_ALONE):
            names = " or ".join(repr(name) for name in (*FORMULATIONS, PLATFORM_ALONE))
            table.fail("formulation", f"{quote(formulation)} is unknown; write {names}")
    multidegree = None
    if "multidegree" in table.values:
        multidegree = _read_multidegree(table, table.items("multidegree", "whole numbers"))
    return Truth(
        dimension=table.count("dimension", 0),
        degree=table.count("degree", 1),
        count=table.count("count", 1, default=1),
        multiplicity=table.count("multiplicity", 1, default=1),
        multidegree=multidegree,
        formulation=formulation,
        source=table.text("source"),
    )


def _read_multidegree(table: CaseTable, values: list[Any]) -> tuple[Any, ...]:
    def is_degree(value: Any) -> bool:
        return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 10**9

    if not all(is_degree(v) or isinstance(v, list) for v in values):
        table.fail("multidegree", "holds something else; write whole numbers from 0 up")
    return tuple(_read_multidegree(table, v) if isinstance(v, list) else v for v in values)
