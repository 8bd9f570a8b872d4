"""What the commands ask, as functions: each takes whatever describes what is asked about.

That is the name of a file (a case, a system in another program's format, an export), a `nag.Case`,
a mechanism, its model, parts, equations, or what was found before. How a file is read is said by
the keywords of `read`, which every question takes (`takes_files`). Components are numbered from 1,
as everywhere in text.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial, wraps
from inspect import Parameter, signature
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar, get_args

from nag.algebra.given import (
    ANSWERS,
    Decomposed,
    Moving,
    Names,
    Point,
    Solvable,
    Values,
    Writable,
    check_choice,
    check_declared,
    check_one_line,
    check_type,
    check_whole,
    is_a,
    value_text,
)
from nag.errors import ComponentError, EquationError, InputError, NagError, unreadable
from nag.numerics.read_only import equal_values
from nag.text.table import join_words
from nag.tracking.run import DEFAULT_RUN, Run, Stream, answers_early, takes_run

if TYPE_CHECKING:
    import numpy as np

    from nag.algebra.family import Family
    from nag.algebra.number import Number
    from nag.algebra.symmetry import SignedPermutation
    from nag.algebra.system import PolynomialSystem
    from nag.check.statement import CheckedStatements
    from nag.decomposition.singular_members import SingularParameters
    from nag.decomposition.singular_points import SingularLocus
    from nag.decomposition.sweep import Sweep
    from nag.files.cases import Case
    from nag.interpolation.image_ideal import ImageIdeal
    from nag.interpolation.point_cloud import AmbientVariables, Cloud
    from nag.kinematics.driven_motion import DrivenMotion
    from nag.kinematics.motion import Motion
    from nag.mechanism.assembly import AssemblyModel
    from nag.mechanism.axes import Space
    from nag.mechanism.mode_decomposition import ModesAnswer
    from nag.mechanism.model import Model
    from nag.mechanism.problem import Problem
    from nag.numerics.claims import Claim
    from nag.numerics.local_dimension import LocalDimension
    from nag.page.mechanism_report import MechanismReport
    from nag.pictures.plot import Picture
    from nag.real.curve import RealCurve
    from nag.real.real_pieces import RealPieces
    from nag.solving.certificate import SolutionsCertificate
    from nag.solving.certified_paths import ProvedPaths
    from nag.solving.family_members import FamilySolutions
    from nag.solving.solutions import SolveResult
    from nag.text.table import Row
    from nag.witness.certificate import DecompositionCertificate
    from nag.witness.certified_loops import ProvedMonodromy
    from nag.witness.membership import PointMembership
    from nag.witness.sampling import Samples
    from nag.witness.witness import Decomposition, WitnessSet

    Exported = Decomposition | SolveResult | Samples | SingularLocus | SingularParameters

Answer = TypeVar("Answer")
Method = Literal["complete", "sampling"]
Coordinates = Literal["joint", "euler"]

# Ends of names that files have and equations have not.
SUFFIXES = (".toml", ".json", ".urdf", ".xml", ".m2", ".sing", ".txt", ".bertini", ".phc")
# How equations are read: keywords of `problem`, of which each is None by default.
EQUATION_OPTIONS = {"variables": "Names | None", "imaginary": "str | None"}
# How a file is read: keywords of `read`, and their defaults.
FILE_OPTIONS: Mapping[str, Any] = {"set": None, "format": "auto", "hold": (), "at": None}
# What a case may describe.
DESCRIPTIONS = (
    ("nag.files.cases", "Case"),
    ("nag.mechanism.graph", "Mechanism"),
    ("nag.mechanism.model", "Model"),
    ("nag.mechanism.assembly", "AssemblyModel"),
    ("nag.mechanism.linkage", "Linkage"),
    ("nag.mechanism.framework", "Framework"),
    ("nag.mechanism.dh", "DHLoop"),
    ("nag.mechanism.problem", "Problem"),
    ("nag.algebra.system", "PolynomialSystem"),
)
# What has exports, which are read back: answers, with the equations that they answer, and others.
EXPORTED = (
    *ANSWERS,
    ("nag.witness.sampling", "Samples"),
    ("nag.decomposition.singular_points", "SingularLocus"),
    ("nag.decomposition.singular_members", "SingularParameters"),
)
# What pages show.
SHOWN_MOVING = (
    ("nag.kinematics.motion", "Motion"),
    ("nag.kinematics.driven_motion", "DrivenMotion"),
)
# Other programs' files by their endings.
ENDINGS = {
    ".m2": "m2",
    ".sing": "singular",
    ".phc": "phc",
    ".bertini": "bertini",
    ".jl": "hc",
    ".txt": "text",
    ".tex": "latex",
    ".py": "sympy",
}
# What is said of a component of an export on which paths fail.
UNTESTED = "the trace of its points could not be tested"


# A text that is a word, and so the name of a file rather than an equation.
_WORD = re.compile(r"[A-Za-z_]{3,}\w*")
# A text that looks like the name of a file rather than like an equation.
_PATH = re.compile(
    r"[\w.~-]*[A-Za-z]{2}[\w.~-]*([/\\][\w.~-]+)+|[\w-]*[A-Za-z]{2}[\w-]*\.[A-Za-z]\w*"
)


# --- Files


def read(
    path: str | os.PathLike[str],
    *,
    set: Mapping[str, Any] | None = None,
    format: str = "auto",
    hold: Sequence[str] = (),
    at: Mapping[str, Any] | None = None,
) -> Case | Exported | dict[str, Any]:
    """What a file holds, told by its content.

    Args:
        path: a case or a system in another program's format, which gives a `nag.Case`; an export
            of a decomposition, of solutions, of samples or of singular points, which gives an
            equal one; or what another command wrote with ``--json``, which gives that JSON object,
            checked by its schema.
        set: of a case, values of some of its parameters in place of its own, by name: numbers, or
            expressions as texts; of a system in another program's format, of unknowns as well.
        format: ``"bertini"``, ``"phc"``, ``"m2"``, ``"singular"``, ``"hc"``, ``"text"``,
            ``"urdf"``, ``"mjcf"`` or ``"toml"``; by default told by the content.
        hold: of a robot (URDF, MJCF), the links that are fixed to the ground.
        at: of a robot, where its joints stand, by name: angles in radians, and lengths; 0 by
            default.

    Raises:
        nag.InputError: if it cannot be read or makes no sense; one line says where and what would
            be right.

    >>> import nag
    >>> nag.read("cases/bennett.toml").kind
    'mechanism'
    >>> dict(nag.read("cases/rhombus.toml", set={"b": 2}).parameters)
    {'a': Fraction(1, 1), 'b': Fraction(2, 1)}
    """
    from nag.algebra.given import check_path, reading_options
    from nag.files.cases import read_case

    check_path(path)
    how = reading_options(set, format, hold, at)
    try:
        with Path(path).open("rb") as file:
            is_json = file.read(256).lstrip()[:1] == b"{"
    except OSError as error:
        raise InputError(unreadable(path, error)) from None
    except ValueError as error:
        raise InputError(unreadable(repr(str(path)), error)) from None
    if not is_json:
        return read_case(path, **how)
    for name, value in how.items():
        if value != FILE_OPTIONS[name]:
            raise InputError(f"{path}: is an export; {name} is for cases, leave it out")
    return _read_export(path)


def _read_export(path: str | os.PathLike[str]) -> Exported | dict[str, Any]:
    from nag.files import export, points_export, solutions_export
    from nag.files.json_schema import published_versions
    from nag.files.json_values import ExportError, checked_document, read_file

    def convert(value: Any) -> Exported | dict[str, Any]:
        name = value.get("format") if isinstance(value, dict) else None
        if name == export.FORMAT:
            return export.export_of(value).decomposition
        if name == solutions_export.FORMAT:
            return solutions_export.solutions_of(value).result
        if name in points_export.FORMATS:
            return points_export.points_of(value)
        versions = published_versions(name) if isinstance(name, str) else ()
        if versions:
            return checked_document(value, name, *versions)
        raise ExportError("format: is none that nag writes")

    return read_file(path, convert)


def write(
    result: Writable, path: str | os.PathLike[str], *, format: str = "auto", title: str = ""
) -> None:
    """Write something to a file that `read` reads.

    Answers are written as the commands do with ``--json``, in JSON. `read` gives components,
    solutions, samples and singular points back; of other answers, whose JSON leaves out what they
    rest on, the JSON object, and `pickle` keeps them whole. Cases, mechanisms, their
    models, parts and systems are written as cases, in TOML: `read` gives a `nag.Case`, equal to the
    one that was written, or in which ``described`` is what was written. Of a motion a page in which
    it moves is written as well, in HTML, which is not read.

    Args:
        result: what a question returns; or a `nag.Case`, a `nag.Mechanism`, a model, parts, a
            `nag.Problem`, a `nag.PolynomialSystem`, or equations as `nag.system` takes them; or the
            name of a file that `nag.read` reads one of them from.
        path: the file; whatever was there is replaced.
        format: of equations, ``"toml"``, or of another program: ``"bertini"``, ``"phc"``,
            ``"m2"``, ``"singular"``, ``"hc"``, ``"text"``, ``"sympy"`` or ``"latex"``; by default
            told by the ending (``.m2``, ``.sing``, ``.phc``, ``.bertini``, ``.jl``, ``.txt``,
            ``.tex``, ``.py``), else TOML.
        title: of a case, or of a page.

    Raises:
        nag.InputError: if the file cannot be written.
        nag.NagError: if ``result`` is nothing of that kind, the format cannot say it, or the ending
            is one of files that say something else; an answer's is ``.json``, or none, and a
            page's ``.html``.

    >>> import nag, tempfile
    >>> circle = nag.decompose("x^2 + y^2 = 1")
    >>> bars = {"base": "AD2", "left": "AB1", "top": "BC2", "right": "CD1"}
    >>> four_bar = nag.Linkage.of(bars, "base")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write(circle, f"{folder}/circle.json")
    ...     nag.write(four_bar, f"{folder}/bars.toml", title="four bars")
    ...     nag.read(f"{folder}/circle.json") == circle
    ...     nag.read(f"{folder}/bars.toml").described == four_bar
    True
    True
    """
    from nag.algebra.given import check_path

    check_path(path)
    check_type(format, str, "format", "a text")
    check_type(title, str, "title", "a text")
    check_one_line(title, "title")
    if names_file(result):
        result = read(result)
    elif _is_equations(result):
        from nag.algebra.from_python import system

        result = system(result)
    from nag.files.answer_export import is_answer
    from nag.files.written_file import HELD, ending_of

    ending = ending_of(path)
    moves = any(is_a(result, *kind) for kind in SHOWN_MOVING)
    if moves and ending == ".html" and format == "auto":
        _write_page(result, path, title)
        return
    if is_answer(result) or any(is_a(result, *kind) for kind in EXPORTED):
        for name, given in (("format", format != "auto"), ("title", bool(title))):
            if given:
                raise NagError(f"{name}: is for cases and equations; an export has its own")
        if ending != ".json" and ending in (*HELD, *ENDINGS):
            other = ", or write the equations alone: nag.write(result.system, path)"
            other = other if any(is_a(result, *kind) for kind in ANSWERS) else ""
            other = ", or .html, a page in which it moves" if moves else other
            raise NagError(
                f"path: a file that ends in {ending} holds no export, which is JSON; name it "
                f".json{other}"
            )
        _write_export(result, path)
        return
    if not any(is_a(result, *kind) for kind in DESCRIPTIONS):
        raise NagError(
            f"result: {value_text(result)} is given; give an answer that a command writes as "
            "JSON, as of nag.decompose or nag.solve, a case, a mechanism, a model, parts or "
            "equations; others are kept by pickle"
        )
    if format == "auto" and ending in HELD and ending != ".toml":
        raise NagError(
            f"path: no case and no equations are written to a file that ends in {ending}; name it "
            f".toml or {', '.join(ENDINGS)}"
        )
    from nag.files.case_writing import case_text
    from nag.files.written_file import write_target

    chosen = ENDINGS.get(ending, "toml") if format == "auto" else format
    if chosen == "toml":
        text = case_text(result, title)
    else:
        from nag.files.formats.writing import write_system
        from nag.mechanism.problem import problem_of

        title = title or getattr(result, "title", "")
        text = write_system(problem_of(result).system, chosen, title)
    write_target(path, text)


def _write_page(result: Motion | DrivenMotion, path: str | os.PathLike[str], title: str) -> None:
    """Write a page in which a mechanism moves."""
    from nag.files.written_file import write_target
    from nag.page import motion_page

    one = is_a(result, *SHOWN_MOVING[0])
    page = motion_page.motion_page if one else motion_page.driven_page
    name = os.path.basename(path).removesuffix(".html")
    write_target(path, page(result, title or name, name))  # type: ignore[arg-type]


def _write_export(result: Any, path: str | os.PathLike[str]) -> None:
    """Write an export of a result."""
    if is_a(result, *EXPORTED[0]):
        from nag.files.export import write_decomposition

        write_decomposition(result, path)
    elif is_a(result, *EXPORTED[1]):
        from nag.files.solutions_export import write_solutions

        write_solutions(result, path)
    elif any(is_a(result, *kind) for kind in EXPORTED):
        from nag.files.points_export import write_points

        write_points(result, path)
    else:
        from nag.files.answer_export import write_answer

        write_answer(result, path)


def _is_equations(given: Any) -> bool:
    """Whether texts, polynomials or sympy's expressions are given, one or several."""
    one = isinstance(given, str | list | tuple) or hasattr(given, "free_symbols")
    return one or is_a(given, "nag.algebra.polynomial", "Polynomial")


def open_file(given: Any, **how: Any) -> Any:
    """What a file holds, if the name of one is given; else what is given.

    Args:
        how: how it is read, as for `read`.

    Raises:
        nag.NagError: if something is said of how a file is read where none is given.
    """
    from nag.algebra.given import reading_options

    if names_file(given):
        return read(given, **how)
    for name, value in reading_options(**{**FILE_OPTIONS, **how}).items():
        if value != FILE_OPTIONS[name]:
            raise NagError(f"{name}: says how a file is read; {_instead_of_file(given, name)}")
    return given


def _instead_of_file(given: Any, name: str) -> str:
    """What is given where the name of a file would be, and what to do."""
    if is_a(given, "nag.algebra.system", "PolynomialSystem") or not _is_equations(given):
        return f"a {type(given).__name__} is given; give the name of the file that it is read from"
    mend = "; nag.system(equations, parameters={'a': 1}) sets values in them"
    return f"equations are given{mend if name == 'set' else ', which are no file'}"


def names_file(given: Any) -> bool:
    """Whether something is the name of a file, by its ending, or as there is one."""
    if isinstance(given, os.PathLike):
        return True
    return isinstance(given, str) and (given.endswith(SUFFIXES) or os.path.isfile(given))


def takes_files(
    function: Callable[..., Answer],
    exports: Sequence[tuple[str, str]] = ANSWERS,
    convert: Callable[[Any], Any] | None = None,
) -> Callable[..., Answer]:
    """The same function, whose first argument may be a file, with the keywords of `read` for it.

    Who takes equations has keywords of `problem` for these as well.

    Args:
        exports: those that it takes; a file of others is refused by its name. Whoever takes none
            takes no equations either.
        convert: what is to be done with what was read.
    """
    own = signature(function)
    check = check_declared(function)
    first, *others = own.parameters.values()
    of_equations = [name for name in EQUATION_OPTIONS if exports and name not in own.parameters]

    @wraps(function)
    def call(*given: Any, **named: Any) -> Answer:
        how = {name: named.pop(name) for name in FILE_OPTIONS if name in named}
        read_as = {name: named.pop(name, None) for name in of_equations}
        if given:
            asked, *rest = given
        elif first.name in named or first.default is not Parameter.empty:
            asked, rest = named.pop(first.name, first.default), []
        else:
            raise NagError(f"{first.name}: nothing is given; give a file, a case, parts, equations")
        opened = open_file(asked, **how)
        if isinstance(opened, str) and _WORD.fullmatch(opened):
            raise NagError(
                f"{first.name}: {opened!r} is no file that is there; "
                f"for the equation {opened} = 0 give [{opened!r}]"
            )
        if opened is not asked:
            _refuse_export(os.fspath(asked), opened, exports)
        if convert is not None and opened is not asked:
            opened = convert(opened)
        check((opened, *rest), named)
        try:
            if any(value is not None for value in read_as.values()):
                opened = _read_equations(opened, **read_as)
            return function(opened, *rest, **named)
        except EquationError as error:
            if isinstance(asked, str) and opened is asked and _PATH.fullmatch(asked):
                error.args = (f"{error} (no file of this name; read as an equation)",)
            raise

    only = Parameter.KEYWORD_ONLY
    taken = [
        Parameter(name, only, default=None, annotation=EQUATION_OPTIONS[name])
        for name in of_equations
    ]
    taken += [signature(read).parameters[name] for name in FILE_OPTIONS]
    run = [p for p in others if p.name == "run"]
    others = [p for p in others if p.name != "run"]
    call.__signature__ = own.replace(parameters=[first, *others, *taken, *run])  # type: ignore[attr-defined]
    call.__annotations__ = function.__annotations__ | {p.name: p.annotation for p in taken}
    said = {
        "of equations, as for `nag.problem`": of_equations,
        "how a file is read, as for `nag.read`": FILE_OPTIONS,
    }
    call.__doc__ = _with_options(function.__doc__ or "", said)
    return call


def _read_equations(given: Any, **read_as: Any) -> Problem:
    """The problem of equations with the keywords for these.

    Raises:
        nag.NagError: if something else is given, or they make no sense.
    """
    from nag.mechanism.problem import problem_of

    if is_a(given, "nag.witness.witness", "WitnessSet"):
        given = given._known_system()
    return problem_of(given, **read_as)


def takes_components(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """`takes_files` of a function of components: those that a file has are tested first."""
    return takes_files(function, convert=_test_traces)


def takes_mechanisms(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """`takes_files` of a function of mechanisms, or of a case's parameters: no export has these."""
    return takes_files(function, exports=())


# What is called in words that has exports.
CALLED = {
    "Decomposition": "components",
    "SolveResult": "solutions",
    "Samples": "samples",
    "SingularLocus": "singular points",
    "SingularParameters": "singular parameters",
}


def _refuse_export(file: str, found: Any, taken: Sequence[tuple[str, str]]) -> None:
    """Refuse what a file holds if it is an export of something else than is taken.

    Raises:
        nag.InputError: which says what it is, and what to give.
    """
    others = any(is_a(found, *kind) for kind in EXPORTED if kind not in taken)
    if not others and not isinstance(found, dict):
        return
    if isinstance(found, dict):
        what = f"what a command wrote ({found['format']})"
    else:
        what = f"an export of {CALLED[type(found).__name__]}"
    if not taken:
        said = "which has no mechanism and no parameters; give the case that it is of"
        raise InputError(f"{file}: is {what}, {said}")
    wanted = ["a case", *(f"an export of {CALLED[name]}" for _, name in taken)]
    raise InputError(f"{file}: is {what}, which has no equations; give {join_words(wanted, 'or')}")


def _test_traces(read: Any) -> Any:
    """What was read, components of it with their traces tested, none for a whole orbit."""
    if not is_a(read, "nag.witness.witness", "Decomposition"):
        return read
    from nag.witness.frame import expand_orbits

    return check_traces(expand_orbits(read))


def _with_options(text: str, said: Mapping[str, Iterable[str]]) -> str:
    """A docstring that says below the arguments what further keywords are, if there are any."""
    lines = {what: ", ".join(names) for what, names in said.items()}
    line = "".join(f"        {names}: {what}.\n" for what, names in lines.items() if names)
    place = text.find("        run: a `nag.Run`")
    if place < 0:
        place = text.find("\n\n", text.find("    Args:")) + 1
    return text[:place] + line + text[place:]


# --- Solution sets


@takes_files
@answers_early
def decompose(
    system: Solvable,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: str = "auto",
    method: Method = "complete",
    starts: int | None = None,
    coordinates: Coordinates | None = None,
    expand: bool = False,
    symmetries: Iterable[Any] | None = None,
    run: Run = DEFAULT_RUN,
) -> Decomposition:
    """The irreducible components over the complex numbers of what satisfies the equations.

    Equations that factor are decomposed apart, the others intersected one by one (u-generation:
    Duff, Leykin & Rodriguez 2022); points are split by monodromy, and components confirmed by the
    trace test (Sommese, Verschelde & Wampler 2001, 2002).

    Args:
        system: the name of a file, a `nag.Case`, a mechanism, its model, parts, a
            `nag.PolynomialSystem`, or equations as `nag.system` takes them: texts, sympy's
            expressions, one or a list (`nag.problem`).
        variables: of equations, their names in order; see `nag.system`.
        imaginary: of equations, what the imaginary unit is called, as for `nag.system`.
        formulation: of a mechanism's model, as for `nag.model`; by itself also ``"P"``, the poses
            of a robot's platform, where the others have more than ten thousand paths, and these
            fewer.
        method: ``"complete"``, or ``"sampling"`` for the components that Newton's method finds from
            random points, of systems that are too large; that is never complete
            (`nag.decomposition.discover`).
        starts: number of random points of ``"sampling"``, 100 by default.
        coordinates: of a mechanism's components: ``"joint"`` for those of its joints, or
            ``"euler"`` for Euler parameters of its bodies, to which the components are carried; by
            default those of the formulation.
        expand: whether every component is listed, not one of each orbit of the symmetries.
        symmetries: signed permutations of the variables that keep the equations, each a
            `nag.SignedPermutation`, a dict ``{"x": "-x", "y": "z", "z": "y"}`` or a sign for each
            variable. Of the components that they carry into each other one is reported, with the
            size of its orbit. By default those that the model or the case has; ``()`` for none.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The components, by falling dimension, as witness sets: points of shape ``(degree, n)``.
        Of a mechanism they live in the variables of ``nag.model(mechanism).system``.

    Raises:
        nag.mechanism.model.ModelError: if a mechanism has no loop.
        nag.algebra.symmetry.SymmetryError: if a symmetry does not keep the equations.
        ValueError: if another argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> answer = nag.decompose(["(x^2 + y^2 - 1)*(x - y)^2"])
    >>> [(c.dimension, c.degree, c.multiplicity) for c in answer.components]
    [(1, 1, 2), (1, 2, 1)]
    """
    from nag.algebra.symmetry import SymmetryError
    from nag.mechanism.problem import problem_of, problem_within_reach, read_symmetries

    check_choice(method, "method", get_args(Method))
    if starts is not None and method != "sampling":
        raise NagError('starts: is for method="sampling"; leave it out')
    asked = problem_of(system, variables, imaginary=imaginary, formulation=formulation)
    if coordinates is not None:
        asked = _in_coordinates(asked, coordinates, formulation)
    elif formulation == "auto" and method != "sampling":
        asked = problem_within_reach(asked)
    kept = read_symmetries(symmetries, asked)
    try:
        found = _decompose_by(asked, method, starts, kept, run)
    except SymmetryError as error:
        raise SymmetryError(f"symmetries: {error}") from None
    if coordinates == "euler":
        from nag.mechanism.coordinates import carry_to_euler

        _, found = carry_to_euler(asked, found, threads=run.threads)
    if not expand:
        return found
    from nag.witness.frame import expand_orbits

    return expand_orbits(found)


def _in_coordinates(asked: Problem, coordinates: str, formulation: str) -> Problem:
    """The problem that is decomposed, where components are wanted in some coordinates.

    Raises:
        NagError: if there are none.
    """
    from nag.mechanism import PLATFORM_ALONE
    from nag.mechanism.problem import problem_of

    check_choice(coordinates, "coordinates", get_args(Coordinates))
    if asked.formulation is None:
        raise NagError("coordinates: is for mechanisms and tables; leave it out")
    if asked.formulation == PLATFORM_ALONE:
        raise NagError(f"coordinates: formulation {PLATFORM_ALONE} has those of a pose only")
    if coordinates == "euler" or asked.formulation != "E":
        return asked
    if formulation == "E":
        raise NagError('coordinates: formulation E has none of joints; give formulation="H"')
    return problem_of(asked, formulation="H")


def _decompose_by(
    asked: Problem,
    method: str,
    starts: int | None,
    symmetries: Sequence[SignedPermutation],
    run: Run,
) -> Decomposition:
    if method == "complete":
        return asked.decompose(run=run, symmetries=symmetries)
    from nag.mechanism import PLATFORM_ALONE

    if asked.formulation == PLATFORM_ALONE:
        raise NagError(f"method: sampling finds no poses; leave out formulation {PLATFORM_ALONE}")
    from nag.decomposition.discovery import STARTS, discover

    count = STARTS if starts is None else starts
    return discover(asked.system, starts=count, symmetries=symmetries, run=run)


@takes_mechanisms
@takes_run
def sweep_parameter(
    given: Moving,
    parameter: str,
    values: Sequence[Any],
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> Sweep:
    """The components for many values of a parameter: found for a general one, and followed.

    Components that are there for single values only are not looked for, unless the others cannot
    be followed there.

    Args:
        given: a case with parameters, or the name of its file.
        parameter: the name of one.
        values: two or more, exact: numbers, or texts as ``"1/3"``; each is worked out once, however
            often it is there.
        formulation: of a mechanism's model, as for `nag.model`; that of the first value for all.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if there is no such parameter, or a value makes no sense.

    >>> import nag
    >>> swept = nag.sweep_parameter("cases/rhombus.toml", "b", ["1/2", 1, 2])
    >>> [[(c.dimension, c.degree) for c in each.decomposition.components] for each in swept]
    [[(1, 2), (1, 4)], [(1, 2), (1, 2), (1, 2)], [(1, 2), (1, 4)]]
    """
    from nag.algebra.from_python import exact_vector
    from nag.decomposition.sweep import Sweep, sweep
    from nag.files.cases import case_with
    from nag.mechanism.problem import problem_of

    if not is_a(given, *DESCRIPTIONS[0]):
        raise NagError("given: a case with parameters is wanted, or the name of its file")
    check_type(parameter, str, "parameter", "the name of one")
    exact = exact_vector(values, "values")
    if len(exact) < 2:
        raise NagError("values: give two or more")

    def case_at(value: Any) -> Case:
        try:
            return case_with(given, {parameter: value})
        except NagError as error:
            if parameter not in given.parameters:
                raise
            raise NagError(f"at {parameter} = {value}: {error}") from None

    # Before general values are tried, which are nobody's.
    cases = [case_at(value) for value in exact]
    first = problem_of(cases[0], formulation=formulation)
    # One formulation for all values, so that their systems are one family.
    formulation = first.formulation or "auto"

    def system_at(value: Any) -> PolynomialSystem:
        return problem_of(case_at(value), formulation=formulation).system

    return Sweep(parameter, tuple(sweep(system_at, exact, run=run)))


@takes_mechanisms
@takes_run
def decompose_modes(
    mechanism: Moving,
    *,
    formulation: str = "auto",
    coordinates: Coordinates | None = None,
    run: Run = DEFAULT_RUN,
) -> ModesAnswer:
    """The components of every combination of the joints' assembly modes, one of each class.

    Args:
        mechanism: a `nag.Mechanism`, a case of one, or the name of its file; it is taken as one in
            space.
        formulation: of the models that are decomposed, as for `nag.model`.
        coordinates: ``"euler"`` for components in Euler parameters, ``"joint"`` for those in the
            coordinates of the formulation; by default Euler parameters, unless formulation H is
            asked for.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.mechanism.model.ModelError: if there are too many combinations, or the formulation does
            not cover the mechanism.

    >>> import nag
    >>> nag.decompose_modes("cases/bennett.toml")
    <ModesAnswer: 16 combinations of modes in 2 classes>
    """
    from nag.mechanism.graph import check_mechanism
    from nag.mechanism.mode_decomposition import decompose_modes
    from nag.mechanism.parts import mechanism_in

    made = mechanism_in(mechanism)
    check_mechanism(made)
    if coordinates is not None:
        check_choice(coordinates, "coordinates", get_args(Coordinates))
    chosen = coordinates or ("joint" if formulation == "H" else "euler")
    return decompose_modes(made, formulation, chosen, run=run)


@takes_mechanisms
@takes_run
def write_report(
    given: Moving,
    path: str | os.PathLike[str],
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> MechanismReport:
    """Write all that is found of a mechanism to one page of HTML, which needs no network.

    Args:
        given: a case of a mechanism, or the name of its file; a mechanism, its model, or parts.
        path: the file, whatever was there is replaced.
        formulation: of the mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        What the page says: its components, how it moves, and whether nothing was left open.

    Raises:
        nag.NagError: if it is no mechanism, or the file cannot be written.

    >>> import nag, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write_report("cases/bennett.toml", f"{folder}/bennett.html").complete
    True
    """
    from nag.files.case_writing import case_of
    from nag.files.written_file import check_ending, check_target, write_target
    from nag.mechanism.problem import problem_of
    from nag.page.mechanism_report import report_of

    check_target(path)
    check_ending(path, (".html",))
    if not any(is_a(given, *kind) for kind in DESCRIPTIONS):
        raise NagError(
            f"given: {value_text(given)} is given; reports are of mechanisms: give a case of one, "
            "the name of its file, a mechanism, its model, or parts"
        )
    case = case_of(given)
    asked = problem_of(case, formulation=formulation)
    if asked.model is None:
        raise NagError("given: is a polynomial system; reports are of mechanisms")
    found = report_of(case, asked, run)
    write_target(path, found.page)
    return found


@takes_files
@answers_early
def solve(
    system: Solvable,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: str = "auto",
    start: str = "auto",
    run: Run = DEFAULT_RUN,
) -> SolveResult:
    """All isolated solutions of equations, each once, with their multiplicities.

    Equations that factor are solved apart; what comes down to one variable, or to two equations in
    two of few solutions, is solved exactly; else one path is tracked for each solution of a start
    system (Sommese & Wampler 2005, chapters 7 and 8). Of a case with a ``[family]`` whose
    number of solutions is known, they are as many as the family has.

    Args:
        system: the name of a file, a `nag.Case`, a `nag.PolynomialSystem`, equations as
            `nag.system` takes them (texts, sympy's expressions, one or a list), a mechanism, its
            model, or parts (`nag.problem`).
        variables: of equations, their names in order; see `nag.system`.
        imaginary: of equations, what the imaginary unit is called, as for `nag.system`.
        formulation: of a mechanism's model, as for `nag.model`.
        start: ``"auto"`` (the family's solutions where their number is known, else the least
            work), ``"total"``, ``"multihomogeneous"``, ``"polyhedral"``, ``"monodromy"``, or
            ``"parameter"`` for loops of the parameters of a case's family.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The solutions; ``.points`` has shape ``(k, n)``, ``.real`` are the real ones.

    Raises:
        nag.StartError: if there would be too many paths, or ``"parameter"``
            is asked for and there is no family.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> answer = nag.solve(["x^2 + y^2 - 1", "x - y"])
    >>> [[round(float(z.real), 6) for z in s.point] for s in answer.real]
    [[-0.707107, -0.707107], [0.707107, 0.707107]]
    """
    from nag.mechanism.problem import problem_of

    asked = problem_of(system, variables, imaginary=imaginary, formulation=formulation)
    return asked.solve(start=start, run=run)


# --- Points


@takes_files
def problem(
    given: Solvable,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: str = "auto",
) -> Problem:
    """What is asked about, read once and for all, to be given to one question after another.

    Args:
        given: the name of a file, a `nag.Case`, a mechanism (`nag.Mechanism`), its model
            (`nag.model`), parts (`nag.Linkage`, `nag.Framework`, `nag.DHLoop`), a
            `nag.PolynomialSystem`, or equations as `nag.system` takes them.
        variables: of equations, their names in order; see `nag.system`.
        imaginary: of equations, what the imaginary unit is called, as for `nag.system`.
        formulation: of a mechanism's model, as for `nag.model`.

    Raises:
        nag.NagError: if it makes no sense; one line says what, and what would.

    >>> import nag
    >>> bennett = nag.problem("cases/bennett.toml", formulation="E")
    >>> bennett.system.n, [point.name for point in bennett.points], nag.local(bennett).dimension
    (8, ['reference'], 1)
    """
    from nag.mechanism.problem import problem_of

    return problem_of(given, variables, imaginary=imaginary, formulation=formulation)


def _points(problem: Problem) -> Mapping[str, tuple[Number, ...]]:
    """The points of a problem by their names."""
    return {point.name: point.at for point in problem.points}


def _point(
    point: Any, system: PolynomialSystem, points: Mapping[str, tuple[Number, ...]]
) -> tuple[Number | complex, ...]:
    """A point's coordinates: those of the one that has this name, or what is given.

    None stands for the only one that has a name.
    """
    if point is None and len(points) == 1:
        return next(iter(points.values()))
    if point is None or isinstance(point, str):
        if point in points:
            return points[point]
        from nag.algebra.tokens import nearest, quote

        said = "which one?"
        if point is not None:
            said = f"{quote(point)} is the name of none{nearest(point, points)};"
        own = system.own_variables
        ways = [f"a dict, {{{own[0]!r}: 1, ...}}", f"{len(own)} numbers, for {', '.join(own)}"]
        if points:
            ways.insert(0, f"a name ({', '.join(map(repr, points))})")
        raise NagError(f"point: {said} give {' or '.join(ways if own else ['()'])}")
    from nag.algebra.from_python import coordinates

    return coordinates(point, system.variables, system.imaginary)


@takes_mechanisms
def gruebler_kutzbach(mechanism: Moving) -> int:
    """Freedoms of all moving bodies minus the conditions of all joints.

    A body has 6 freedoms in space and 3 in planar and spherical mechanisms; of a framework the
    points have freedoms, and bars are conditions. The count is wrong for overconstrained
    mechanisms: it knows nothing of the geometry (T25, section 7).

    Args:
        mechanism: a mechanism, parts (a linkage, a framework, a table), or a case, a model or a
            problem of one of them, or the name of a file.

    Raises:
        nag.MechanismError: if something else is given.

    >>> import nag
    >>> nag.gruebler_kutzbach("cases/bennett.toml")  # and yet it moves
    -2
    """
    from nag.mechanism.graph import check_mechanism
    from nag.mechanism.loops import gruebler_kutzbach as count_freedoms
    from nag.mechanism.parts import PARTS, mechanism_in

    made = mechanism_in(mechanism)
    if is_a(made, "nag.mechanism.assembly", "AssemblyModel"):
        return int(made.gruebler_kutzbach)
    check_mechanism(made, PARTS)
    return count_freedoms(made)


@takes_files
def model(
    mechanism: Moving,
    formulation: str = "auto",
    modes: Sequence[tuple[str, int]] = (),
    space: Space | None = None,
) -> Model | AssemblyModel | Problem:
    """The smallest faithful model of a mechanism, or the one that is asked for.

    Parts that may be assembled in any way have one as well, a `nag.mechanism.assembly.
    AssemblyModel`; of equations it is these themselves, a `nag.Problem`. All have a ``system``.

    The smallest is the one with the fewest estimated paths.

    Args:
        mechanism: a `nag.Mechanism`, a `nag.Case` or a model of one, the name of a file; at least
            one of its joints must belong to a loop. Or parts: a `nag.Linkage`, a `nag.Framework`, a
            `nag.DHLoop`. Or equations, as for `nag.problem`.
        formulation: ``"E"`` for Euler parameters (the constraints of PT13, table 1, by their prime
            components: T25, lemma 2.1; in the plane a cosine and a sine for each body), ``"H"``
            for half-angles and other joint coordinates, ``"S"`` for rods as distances, ``"auto"``;
            ``"P"`` for the poses of a robot's platform, which are never taken by themselves: their
            components need not be those of the joints.
        modes: assembly modes (`nag.mechanism.assembly_modes`), of the mechanism in space.
        space: ``"spatial"`` to take a planar or spherical mechanism as one in space.

    Raises:
        nag.MechanismError: if the mechanism has no loop, or ``formulation`` does not cover it.
        nag.NagError: if parts have no model, or not in that formulation, or another argument makes
            no sense; the message says which, and what would.

    >>> import nag
    >>> model = nag.model("cases/bennett.toml")
    >>> model.formulation, model.system.n, model.system.degrees
    ('H', 2, (2,))
    >>> sorted(model.lift(model.reference).euler) == sorted(model.mechanism.body_names)
    True
    >>> nag.model("cases/rhombus.toml").system.n
    6
    """
    from nag.mechanism.graph import is_equations
    from nag.mechanism.model import model as model_of_mechanism
    from nag.mechanism.problem import problem_of

    plain = is_a(mechanism, "nag.mechanism.problem", "Problem") and mechanism.model is None
    if not (plain or is_equations(mechanism)):
        return model_of_mechanism(mechanism, formulation, modes, space)
    for name, wanted in (("modes", bool(modes)), ("space", space is not None)):
        if wanted:
            raise NagError(f"{name}: is for a nag.Mechanism, not for equations; leave it out")
    return problem_of(mechanism, formulation=formulation)


@takes_files
@takes_run
def local(
    given: Solvable,
    point: Point | None = None,
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> LocalDimension:
    """The dimension that the solution set has at a point; nothing is decomposed for it.

    Args:
        given: anything that describes a problem, see `nag.problem`.
        point: the name of a point (``"reference"`` for a mechanism), a mapping of variables to
            numbers, or numbers in order; by default the only point that has a name.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if it is no solution, or an argument makes no sense.

    >>> import nag
    >>> print(nag.local("cases/bennett.toml").dimension)
    1
    """
    from nag.mechanism.problem import problem_of
    from nag.numerics.local_dimension import local_dimension_near

    asked = problem_of(given, formulation=formulation)
    at = _point(point, asked.system, _points(asked))
    return local_dimension_near(asked.system, at, seed=run.seed)


# --- Components


def find_components(given: Any, run: Run, formulation: str = "auto") -> Decomposition:
    """All components of what is given, none for a whole orbit."""
    return _find_in(given, run, formulation)[0]


def _find_in(
    given: Any,
    run: Run,
    formulation: str,
    *,
    check: Callable[[PolynomialSystem, Mapping[str, tuple[Number, ...]]], object] | None = None,
    real: bool = False,
) -> tuple[Decomposition, Mapping[str, tuple[Number, ...]], str]:
    """The same, the points of a problem by their names, and what proves that no point is real.

    Args:
        check: called with a problem's system and points before it is decomposed.
        real: whether real points are asked for, so that frameworks take coordinates that are real
            where their realisations are, and stretched parts the equations of real assemblies.

    Raises:
        nag.NagError: if a formulation is asked for of components.
    """
    from nag.witness.frame import expand_orbits

    one = is_a(given, "nag.witness.witness", "WitnessSet")
    if one or is_a(given, "nag.witness.witness", "Decomposition"):
        if formulation != "auto":
            raise NagError("formulation: components are given; they are in one already")
        found = _of_one_component(given) if one else expand_orbits(given)
        if check is not None:
            check(found.system, {})
        return found, {}, ""
    from nag.mechanism.problem import in_real_coordinates, problem_of

    asked = problem_of(given, formulation=formulation)
    reason = ""
    if real:
        from nag.mechanism.real_assemblies import obstacle, of_real_assemblies

        reason = "" if asked.parts is None else obstacle(asked.parts)
        asked = of_real_assemblies(in_real_coordinates(asked))
    points = _points(asked)
    if check is not None:
        check(asked.system, points)
    return expand_orbits(asked.decompose(run=run)), points, reason


def _of_one_component(component: WitnessSet) -> Decomposition:
    """A component alone; what else there is is not known."""
    from nag.witness.witness import Decomposition, PathCounts

    notes = ("one component is given; others may be there",)
    system = component._known_system()
    return Decomposition(system, (component,), PathCounts(), 0, "default", (), False, notes)


def check_traces(found: Decomposition) -> Decomposition:
    """A decomposition that was read, components undecided whose traces cannot be tested.

    Raises:
        nag.ComponentError: if the points of one are not all points of a set on its slice.
    """
    components = [check_trace(found, k) for k in range(len(found.components))]
    notes = [
        f"component {k}: {UNTESTED}"
        for k, (new, old) in enumerate(zip(components, found.components, strict=True), 1)
        if new.note != old.note
    ]
    return replace(
        found,
        components=tuple(components),
        complete=found.complete and not notes,
        notes=(*found.notes, *notes),
    )


def check_trace(found: Decomposition, index: int) -> WitnessSet:
    """A component by its index; undecided, if its trace cannot be tested.

    Raises:
        nag.ComponentError: if its points are not all points of a set on its slice.
    """
    from nag.decomposition.trace import linear_trace
    from nag.witness.witness import Status

    component = found.components[index]
    if not component.dimension or component.status is not Status.IRREDUCIBLE:
        return component
    linear = linear_trace(found.system, component, index)
    if linear is False:
        raise ComponentError(
            f"component {index + 1}: the sum of its points does not move linearly with the slice; "
            "some of them are missing, or are those of others"
        )
    return component if linear else replace(component, status=Status.UNDECIDED, note=UNTESTED)


def component_numbered(found: Decomposition, number: int, place: str = "component") -> WitnessSet:
    """The component with a number, counted from 1.

    Raises:
        nag.NagError: if there is none.
    """
    check_whole(number, place, 1)
    count = len(found.components)
    if number > count:
        have = {0: "there are no components", 1: "there is one component, number 1"}.get(
            count, f"there are components 1 to {count}"
        )
        raise NagError(f"{place}: {number}: {have}")
    return found.components[number - 1]


@takes_components
@takes_run
def member(
    given: Decomposed,
    point: Point | None = None,
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> PointMembership:
    """Which components a point lies on.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        point: the name of a point of a case (``"reference"`` for a mechanism), a mapping of
            variables to numbers, or numbers in order.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if there is no such point, or an argument makes no sense.

    >>> import nag
    >>> found = nag.member("(x^2 + y^2 - 1)*(x - y)", (1, 0))
    >>> [(c.dimension, c.degree) for c in found.on]
    [(1, 2)]
    """
    from nag.algebra.from_python import exact_number
    from nag.witness.membership import locate_point

    found, points, _ = _find_in(given, run, formulation, check=partial(_point, point))
    at = _point(point, found.system, points)
    known = [x if isinstance(x, complex) else exact_number(x) for x in at]
    return locate_point(found, known, run=run)


@takes_components
@takes_run
def sample(
    given: Decomposed,
    component: int = 1,
    *,
    count: int = 10,
    real: bool = False,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> Samples:
    """Random points of a component.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        component: its number, from 1.
        count: how many.
        real: whether they are to be real; of a framework in coordinates x, y.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The points, complex, shape ``(count, n)``, and how accurate they are.

    Raises:
        nag.ComponentError: if so many points were not found.
        nag.NagError: if there is no such component, or an argument makes no sense.

    >>> import nag
    >>> nag.sample("x^2 + y^2 - 1", count=5).points.shape
    (5, 2)
    """
    found, _, obstacle = _find_in(given, run, formulation, real=real)
    chosen = component_numbered(found, component)
    if real:
        from nag.real.real_pieces import Reality
        from nag.real.real_samples import sample_real, say_none_real

        if obstacle:
            raise say_none_real(found.system, Reality.NONE, obstacle)
        return sample_real(chosen, count, run=run)
    from nag.witness.sampling import sample as sample_component

    return sample_component(found.system, chosen, count, run=run)


@takes_components
@takes_run
def find_real_points(
    given: Decomposed,
    component: int | None = None,
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> RealPieces:
    """Real points of a component of any dimension, on each connected piece where they are had.

    Of finite sets and curves they are one on each piece, of larger sets at least one.

    Args:
        given: one of the components of a `nag.Decomposition`; all of them, a file of them, or what
            is decomposed now.
        component: the number of the one that is asked about, from 1; by default the only one.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The points, whether there are any, and what that rests on. Where coefficients are complex,
        they have no coordinate for the imaginary unit.

    Raises:
        nag.ComponentError: if the witness points are no regular zeros of equations that cut it.
        nag.NagError: if there are several components, or an argument makes no sense.

    >>> import nag
    >>> found = nag.find_real_points("x^2 + y^2 + z^2 = 1")
    >>> str(found.reality), bool(abs((found.points**2).sum(axis=1) - 1).max() < 1e-12)
    ('found', True)
    >>> [len(nag.find_real_points(c)) for c in nag.decompose("x^4 = 4").components]
    [1, 1, 0, 0]
    """
    from nag.real.real_pieces import find_real_points as find_points_on
    from nag.real.real_pieces import no_real_points

    found, _, obstacle = _find_in(given, run, formulation, real=True)
    chosen = _one_component(found, component, None)
    if obstacle:
        return no_real_points(chosen, obstacle)
    return find_points_on(chosen, run=run)


@takes_components
@takes_run
def find_real_curve(
    given: Decomposed,
    component: int | None = None,
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> RealCurve:
    """The complete real part of a one-dimensional component.

    Args:
        given: one of the components of a `nag.Decomposition`; all of them, a file of them, or what
            is decomposed now. Where coefficients are complex, the curve is one in the variables
            without the imaginary unit.
        component: the number of the one that is asked about, from 1; by default the only one of
            dimension 1.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        Vertices, edges and pieces; undecided, with the reason, where a check failed.

    Raises:
        nag.ComponentError: if the component's equations stay singular along it, or its degree is
            too large.
        nag.NagError: if the component is no curve, there are several, or an argument makes no
            sense.

    >>> import nag
    >>> curve = nag.find_real_curve("(x^2 + y^2)^2 = 2*(x^2 - y^2)")
    >>> str(curve.verdict), len(curve.edges), [str(vertex.kind) for vertex in curve.vertices]
    ('complete', 2, ['singular'])
    """
    from nag.real.find_curve import find_real_curve as find_curve_on

    found, _, _ = _find_in(given, run, formulation, real=True)
    return find_curve_on(_one_component(found, component, 1), run=run)


def _one_component(found: Decomposition, number: int | None, dimension: int | None) -> WitnessSet:
    """The component with a number, or the only one there is, of a dimension if one is given.

    Raises:
        nag.NagError: if there is none, or it is not said which of several.
    """
    if number is not None:
        return component_numbered(found, number)
    parts = enumerate(found.components, 1)
    fitting = [k for k, c in parts if dimension in (None, c.dimension)]
    if len(fitting) == 1 or (not fitting and len(found) == 1):
        return found.components[(fitting or [1])[0] - 1]
    have = "" if dimension is None else f" have dimension {dimension}"
    if not fitting:
        raise NagError(f"component: none{have.replace('have', 'has') or ' is there'}")
    named = join_words([str(k) for k in fitting])
    raise NagError(f"component: which one? {named}{have or ' are there'}; give the number of one")


@takes_components
@takes_run
def singular(
    given: Decomposed,
    component: int | None = None,
    *,
    free: Names | None = None,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> SingularLocus | SingularParameters:
    """Singular points of components, and where components meet.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        component: the number of the one that is asked about, from 1; all by default.
        free: names of parameters of a case, or of unknowns of equations, which are parameters then:
            for which of their values are there singular points?
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if there is no such component, or an argument makes no sense.

    >>> import nag
    >>> nag.singular("y^2 - x^2*(x + 1)").sets[0].dimension
    0
    >>> nag.singular("x^2 + a*x + b", free="a, b").texts()
    ['a^2 - 4*b = 0']
    """
    if free is not None:
        from nag.decomposition.singular_members import singular_parameters

        for name, unfit in (("component", component), ("formulation", formulation != "auto")):
            if unfit:
                raise NagError(f"{name}: is of components; with free= equations are given")
        system, count = free_parameters(given, free)
        return singular_parameters(system, count, run=run)
    from nag.decomposition.singular_points import singular_locus

    found = find_components(given, run, formulation)
    if component is not None:
        component_numbered(found, component)
    return singular_locus(found, only=None if component is None else [component - 1], run=run)


def free_parameters(given: Any, free: Any) -> tuple[PolynomialSystem, int]:
    """The equations of a case or others, whose last variables are these parameters, and how many.

    Raises:
        nag.NagError: if there are none of these names, or coefficients are complex.
    """
    from nag.algebra.system import PolynomialSystem
    from nag.algebra.tokens import list_names, nearest, quote
    from nag.files.cases import as_unknowns, freed_system

    names = list_names(free)
    if len({*names}) < len(names) or not names:
        raise NagError("free: give names of parameters, each once: 'L1, L2'")
    if is_a(given, "nag.files.cases", "Case") and not {*names} & {*_variables_of(given)}:
        system = freed_system(given, names)
    else:
        from nag.mechanism.problem import problem_of

        if is_a(given, "nag.files.cases", "Case"):
            given = as_unknowns(given, names)
        system = problem_of(given).system
        known = system.own_variables
        for name in names:
            if name not in known:
                raise NagError(f"free: {quote(name)} does not occur{nearest(name, known)}")
        order = (*(v for v in known if v not in names), *names)
        if not system.imaginary:
            places = [order.index(v) for v in known]
            parts = (
                tuple(f.with_variables(len(order), places) for f in each)
                for each in (system.polynomials, system.nonzero)
            )
            system = PolynomialSystem(order, *parts)
    if system.imaginary:
        raise NagError("free: is for equations with real coefficients")
    return system, len(names)


def _variables_of(case: Case) -> tuple[str, ...]:
    """The unknowns of a case's equations, without parameters; none of a mechanism."""
    own = case.system.own_variables if case.system is not None else ()
    return tuple(name for name in own if name not in case.unset)


@takes_components
@takes_run
def intersect(
    given: Decomposed,
    first: int,
    second: int,
    *,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> Decomposition:
    """The components of the intersection of two components, by their numbers from 1.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        first: the number of one.
        second: that of the other, which may be the same.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if there is no such component, or an argument makes no sense.

    >>> import nag
    >>> nag.intersect("(x^2 + y^2 - 1)*(x - y)", 1, 2).components[0].dimension
    0
    """
    from nag.decomposition.intersection import intersect_components

    found = find_components(given, run, formulation)
    pair = (
        component_numbered(found, first, "first"),
        component_numbered(found, second, "second"),
    )
    return intersect_components(found.system, *pair, run=run)


@takes_components
@takes_run
def eliminate(
    given: Decomposed,
    onto: Names | None = None,
    component: int | None = None,
    *,
    point: Point | None = None,
    degree: int | None = None,
    polynomial: bool = False,
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> ImageIdeal:
    """Exact equations of a component in some variables, and maps from these to the others.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        onto: names of the variables, sympy's symbols, or a text of them; by default essential ones,
            from which all others follow. Of a linkage ``x_P, y_P`` are the place of its pin P: the
            equation is that of the curve which this point of a coupler draws.
        component: its number, from 1, in the order of `nag.decompose`; by default 1, and of a
            mechanism the one through its reference configuration, for which nothing is decomposed.
        point: a point, as for `nag.member`, that the component goes through, instead of its number:
            where it is exact and regular nothing is decomposed either.
        degree: all equations up to this degree; by default until they define the image.
        polynomial: whether only polynomial maps to the other variables are looked for.
        formulation: of a mechanism's model, as for `nag.model`. By default a mechanism is taken in
            its bodies' Euler parameters, ``"E"``, as in the papers; with ``component`` in the
            formulation of `nag.decompose`, whose numbers are meant.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.ComponentError: if coefficients are not recognised.
        nag.NagError: if there is no such component or variable.

    >>> import nag
    >>> found = nag.eliminate(["y - x^2", "z - x^3"], "y, z")
    >>> [str(f) for f in found.equations]
    ['y^3 - z^2']
    """
    from nag.algebra.tokens import list_names
    from nag.interpolation.image_ideal import eliminate_component

    if degree is not None:
        check_whole(degree, "degree", 1)
    if point is not None and component is not None:
        raise NagError("point: component names one already; give one of the two")
    given = asked_of_component(given, component, formulation)
    names = None if onto is None else list_names(onto)
    chosen = choose_component(given, component, point, run, names or ())
    places = None if names is None else place_variables(names, chosen.cloud.ambient.system)
    return eliminate_component(chosen.cloud, chosen.alike, places, degree, polynomial, run.tell)


@dataclass(frozen=True, eq=False)
class ChosenComponent:
    """A component whose equations are asked for.

    Attributes:
        cloud: its points, as many as are asked for, in the variables that equations may be in.
        place: the point that it was reached from, in words; empty where it has a number.
        number: of the component among those that were found, from 1; 0 where none were.
        found: the components, if they were found.
    """

    cloud: Cloud
    place: str = ""
    number: int = 0
    found: Decomposition | None = None

    @property
    def alike(self) -> dict[int, WitnessSet]:
        """Components that may be conjugates of this one, by their numbers, this one first."""
        return {} if self.found is None else list_alike(self.found, self.number)


def asked_of_component(given: Any, component: int | None, formulation: str) -> Any:
    """Components as they are given, else the problem in which one is asked about.

    Raises:
        nag.NagError: if a formulation is asked for of components.
    """
    one = is_a(given, "nag.witness.witness", "WitnessSet")
    if one or is_a(given, "nag.witness.witness", "Decomposition"):
        if formulation != "auto":
            raise NagError("formulation: components are given; they are in one already")
        return given
    from nag.mechanism.problem import problem_of

    formulation = formulation_of_component(given, component, formulation)
    return problem_of(given, formulation=formulation)


def formulation_of_component(given: Any, component: int | None, formulation: str) -> str:
    """Euler parameters of a mechanism, unless a formulation is asked for.

    A component's number is that of `decompose`, and stands for its formulation.
    """
    if formulation != "auto" or component is not None:
        return formulation
    mechanism = getattr(given, "mechanism", None) if is_a(given, *DESCRIPTIONS[0]) else given
    return "E" if is_a(mechanism, *DESCRIPTIONS[1]) else "auto"


def choose_component(
    given: Any, component: int | None, point: Any, run: Run, onto: Sequence[str] = ()
) -> ChosenComponent:
    """The component with a number, or through a point, as `eliminate` takes them.

    Args:
        given: components, or a problem: what `asked_of_component` returns.
        onto: variables that are asked for, which may be places of a linkage's pins.

    Raises:
        nag.NagError: if there is none, or more than one through the point.
    """
    from nag.interpolation.point_cloud import Cloud
    from nag.interpolation.precise_samples import SourceError, source_of_component

    rng = run.random(Stream.ELIMINATION)
    problem = given if is_a(given, "nag.mechanism.problem", "Problem") else None
    at: Sequence[Number | complex] | None = None
    if problem is not None:
        if component is None and point is None and problem.mechanism is not None:
            point = "reference" if "reference" in _points(problem) else None
        if point is not None:
            at = _point_on(problem, point, run)
            reached = _reach_component(problem, point, at, rng, run, onto)
            if reached is not None:
                return reached
        found = find_components(problem, run)
    else:
        found = find_components(given, run)
        if point is not None:
            at = _point(point, found.system, {})
    if at is not None:
        component = _number_through(found, at, run)
    component = 1 if component is None else component
    chosen = component_numbered(found, component)
    if not chosen.dimension:
        raise SourceError("the component is a point; there is nothing to eliminate from")
    ambient = ambient_variables(found.system if problem is None else problem, onto)
    source = source_of_component(found.system, chosen)
    return ChosenComponent(Cloud(source, ambient, rng, run), "", component, found)


def _point_on(problem: Problem, point: Any, run: Run) -> tuple[Number | complex, ...]:
    """A point in the variables of the equations, where it is given in all of a mechanism's.

    Raises:
        nag.NagError: if it is no solution, and not the rounding of one.
    """
    from nag.numerics.local_dimension import NoSolution, local_dimension_near

    points, ambient = _points(problem), ambient_variables(problem)
    # Points that have a name are in the variables that linear equations left.
    named = isinstance(point, str) and point in points
    system = problem.system if named else ambient.system
    at = points[point] if named else _point(point, system, points)
    if any(f(at) != 0 for f in system.polynomials):
        try:
            local_dimension_near(system, at, seed=run.seed)
        except NoSolution:
            raise NagError("point: it does not satisfy the equations") from None
    return at if named else tuple(at[i] for i in ambient.kept)


def _reach_component(
    problem: Problem,
    point: Any,
    at: Sequence[Number | complex],
    rng: np.random.Generator,
    run: Run,
    onto: Sequence[str],
) -> ChosenComponent | None:
    """The component through an exact point that is regular; None if the point is not exact.

    Raises:
        nag.NagError: if it is exact and not regular.
    """
    from nag.interpolation.point_cloud import Cloud
    from nag.interpolation.precise_samples import SourceError, source_at

    exact = [x for x in at if not isinstance(x, complex)]
    if len(exact) < len(at) or any(f(exact) != 0 for f in problem.system.polynomials):
        return None
    name = point if isinstance(point, str) else ""
    try:
        source = source_at(problem.system, exact, rng)
    except SourceError as error:
        what = "the reference configuration" if name == "reference" else "point"
        reason = str(error).replace("the point is", "it is").removesuffix("; name a component")
        text = f"{what}: {reason}; name a component by its number"
        raise NagError(text).mended_by("component") from None
    cloud = Cloud(source, ambient_variables(problem, onto), rng, run)
    return ChosenComponent(cloud, name or "the point")


def ambient_variables(
    given: Problem | PolynomialSystem, onto: Sequence[str] = ()
) -> AmbientVariables:
    """All variables of a mechanism, where linear equations left only some in its system.

    Args:
        onto: names of variables; of a linkage these may be the places x_P and y_P of a pin P.
    """
    from nag.algebra.polynomial import Polynomial
    from nag.interpolation.point_cloud import AmbientVariables

    if not is_a(given, "nag.mechanism.problem", "Problem"):
        return AmbientVariables.itself(given)
    made = given.mechanism
    parts: Any = getattr(given, "parts", None)
    if is_a(parts, "nag.mechanism.linkage", "LinkageModel"):
        own = parts.system.variables
        places = {
            f"{letter}_{pin}": place
            for pin, both in parts.place_polynomials().items()
            for letter, place in zip("xy", both, strict=True)
        }
        further = [name for name in dict.fromkeys(onto) if name in places and name not in own]
        images = (*Polynomial.variables(len(own)), *(places[name] for name in further))
        return AmbientVariables.of(parts.system, (*own, *further), range(len(own)), images)
    elimination = None if made is None else getattr(made.form, "elimination", None)
    if elimination is None or elimination.system.variables != given.system.variables:
        return AmbientVariables.itself(given.system)
    names, kept = elimination.original_variables, elimination.kept
    return AmbientVariables.of(given.system, names, kept, elimination.images)


def _number_through(found: Decomposition, at: Sequence[Number | complex], run: Run) -> int:
    """The number of the one component through a point.

    Raises:
        nag.NagError: if there is not one.
    """
    from nag.witness.membership import locate_point

    located = locate_point(found, at, run=run)
    if located.open or len(located.numbers) != 1:
        on = ", ".join(map(str, located.numbers))
        said = f"it lies on components {on}" if on else "it lies on no component"
        if located.open:
            said = "it is not known which components it lies on"
        text = f"point: {said}; name a component by its number"
        raise NagError(text).mended_by("component")
    return located.numbers[0]


def list_alike(found: Decomposition, number: int) -> dict[int, WitnessSet]:
    """Components of one's dimension, degree and multiplicity, by their numbers, that one first."""

    def kind(c: WitnessSet) -> tuple[int, int, int | None]:
        return c.dimension, c.degree, c.multiplicity

    chosen = found.components[number - 1]
    others = {k: c for k, c in enumerate(found.components, 1) if kind(c) == kind(chosen)}
    return {number: chosen} | others


def place_variables(names: Sequence[str], system: Any) -> tuple[int, ...]:
    """Indices of variables by their names; the imaginary unit, a number, is left out.

    Raises:
        nag.NagError: if there is no such variable, or one is named twice.
    """
    from nag.algebra.tokens import nearest, quote, shorten_names

    known = system.own_variables
    names = [name for name in names if name not in system.variables[len(known) :]]
    for name in names:
        if name not in known:
            more = "of a mechanism formulation E has Euler parameters, H half-angles"
            if name[:2] in ("x_", "y_"):
                more = "of the case of a linkage x_P and y_P are the place of its pin P"
            raise NagError(
                f"onto: {quote(name)} is not one of the variables{nearest(name, known)}; they are "
                f"{shorten_names(known)}; {more}"
            ).mended_by("formulation")
    if len(set(names)) < len(names):
        raise NagError("onto: a variable is given twice")
    if not names:
        raise NagError("onto: no variable is given; leave it out, or name one")
    return tuple(known.index(name) for name in names)


# --- Families


@takes_files
@takes_run
def solve_family(
    equations: Solvable,
    parameters: Names | None = None,
    values: Values | None = None,
    variables: Names | None = None,
    *,
    imaginary: str | None = None,
    formulation: str = "auto",
    start: str = "auto",
    count: int | None = None,
    known: tuple[Any, Any] | None = None,
    run: Run = DEFAULT_RUN,
) -> FamilySolutions:
    """The isolated solutions of many systems that differ in the values of their parameters.

    Args:
        equations: as many as there are unknowns: anything that describes a problem, see
            `nag.problem`.
        parameters: their names, or sympy's symbols: of a case parameters, or unknowns that become
            parameters; of anything else names in the equations. By default those of the case's
            ``[family]``, or the names of the columns of ``values``.
        values: those of each member, real or complex: an array, shape ``(M, k)``, in the order of
            ``parameters``, of one parameter also a list of numbers or a Series; or columns by
            their names, each of a parameter: a DataFrame or a mapping; or a file of either, CSV or
            ``.npy``. Members keep the index of a DataFrame or a Series.
        variables: of equations, names of the unknowns, in order; by default all other names that
            occur.
        imaginary: of equations, what the imaginary unit is called, as for `nag.system`.
        formulation: of a mechanism's model, as for `nag.model`.
        start: how the family is solved for random parameters, as for
            `nag.solving.parameter.solve_generic`: a start system, or ``"parameter"``, by loops,
            which is the default where the number of solutions is known.
        count: the number of solutions of a general member, if it is known; with loops and with
            ``known`` no member is called complete without it. By default the one that the case's
            ``[family]`` gives.
        known: values of the parameters, shape ``(k,)``, and regular solutions there, shape
            ``(S, n)``, from which the family is solved instead.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if equations, parameters or values do not fit each other.
        nag.StartError: if the family cannot be solved that way.

    Reference: Morgan & Sommese, Coefficient-parameter polynomial continuation, 1989.

    >>> import nag
    >>> circles = nag.solve_family(["x^2 + y^2 = r", "x = a*y"], ["r", "a"], [[2, 1], [8, -1]])
    >>> circles.points.shape, circles.complete.all()
    ((2, 2, 2), np.True_)
    >>> sorted(circles.real(0).round(9).tolist())
    [[-1.0, -1.0], [1.0, 1.0]]
    """
    from nag.algebra.tokens import list_names
    from nag.solving.family_members import labels_of, solve_family_members

    if values is None:
        raise NagError(
            "values: none are given; give an array, shape (members, parameters), columns by their "
            "names, or a file of either"
        )
    labels = labels_of(values)
    if _is_series(values):
        name = values.name if parameters is None else None
        values = values.to_numpy() if name is None else {str(name): values.to_numpy()}
    named = parameters is None
    names = _names_of_columns(values) if named else list_names(parameters)
    asked = names, named, variables, imaginary, formulation
    try:
        family, own, solutions = _family_in(equations, *asked)
    except NagError as error:
        said = str(error)
        about_names = said.startswith("parameters: ") and names
        if about_names and named and isinstance(values, str | os.PathLike):
            column = said.removeprefix("parameters: ")
            raise InputError(f"{os.fspath(values)}: line 1: {column}") from None
        raise
    values = _values_of_members(values, family.parameters, own)
    count = solutions if count is None else count
    if start == "auto" and solutions is not None and known is None:
        start = "parameter"
    return solve_family_members(
        family, values, start=start, count=count, known=known, labels=labels, run=run
    )


def _is_series(values: Any) -> bool:
    """Whether values are one column, as of a data frame, whose index are no names of columns."""
    return hasattr(values, "keys") and getattr(values, "ndim", 0) == 1


def _names_of_columns(values: Any) -> list[str]:
    """The names of the columns of values; none where they have none."""
    if isinstance(values, str | os.PathLike):
        from nag.files.member_values import read_member_names

        return read_member_names(values)
    return [str(name) for name in values.keys()] if hasattr(values, "keys") else []  # noqa: SIM118


def _values_of_members(
    values: Any, parameters: Sequence[str], own: Sequence[complex] | None
) -> Any:
    """Values as they are given, or from a file; those that a table leaves out are the case's own.

    Args:
        own: values of the case's parameters, if it has any.
    """
    if isinstance(values, str | os.PathLike):
        from nag.files.member_values import read_member_values

        return read_member_values(values, parameters, own or [0] * len(parameters))
    if own is None or not hasattr(values, "keys") or not len(values.keys()):
        return values
    from nag.solving.family_members import read_columns

    known = read_columns(values)
    count = len(next(iter(known.values())))
    return {n: [x] * count for n, x in zip(parameters, own, strict=True)} | known


def _family_in(
    given: Any,
    names: Sequence[str],
    by_name: bool,
    variables: Any,
    imaginary: str | None,
    formulation: str,
) -> tuple[Family, list[complex] | None, int | None]:
    """The family that is meant; of a case's ``[family]`` its own values, and how many solutions.

    Args:
        by_name: whether the names are those of columns of values.

    Raises:
        nag.NagError: if it is not said which are the parameters, or they are none.
    """
    from nag.algebra.tokens import list_names
    from nag.mechanism.problem import problem_of
    from nag.solving.family_members import family_of

    if is_a(given, "nag.files.cases", "Case"):
        member = given.family
        if member is not None:
            family = member.symmetric.original
            # Columns have names, in any order, and those that are left out their own values.
            subset = by_name and {*names} <= {*family.parameters}
            if not names or tuple(names) == family.parameters or subset:
                return family, [complex(v) for v in member.values], member.solutions
        from nag.files.cases import as_unknowns, freed_system

        if names and {*names} <= {*given.parameters, *given.unset}:
            return family_of(freed_system(given, names), names), None, None
        given = as_unknowns(given, names)
    if not names:
        raise NagError("parameters: which are they? give their names, ['a', 'b']")
    every = None if variables is None else [*list_names(variables), *names]
    asked = problem_of(given, every, imaginary=imaginary, formulation=formulation)
    return family_of(asked.system, names), None, None


# --- Pictures


@takes_components
@takes_run
def plot(
    given: Decomposed,
    path: str | os.PathLike[str],
    *,
    onto: Names | None = None,
    joints: Sequence[str] | str | None = None,
    point: str | None = None,
    graph: bool = False,
    mechanism: bool = False,
    tree: bool = False,
    component: int | None = None,
    circuit: str | int = "reference",
    formulation: str = "auto",
    run: Run = DEFAULT_RUN,
) -> Picture:
    """Draw real curves, joint angles, paths of points, or bodies with joints; one of these.

    Args:
        given: anything that describes a problem, see `nag.problem`, or components
            that were found.
        path: the file, ending in .svg, .png or .pdf.
        onto: two variables or three, names, symbols or a text of them: the real points of the
            components of dimension one, or where there is none, in three variables, of dimension
            two; beside ``point`` two of x, y and z.
        joints: two joints, whose angles or slides are drawn against each other along the motion.
        point: a joint's point, or one of a framework, whose path is drawn.
        graph: the graph of bodies and joints.
        mechanism: the mechanism at its reference configuration, or once on each circuit.
        tree: all components by their dimensions.
        component: the number of the one that is drawn ``onto`` variables, from 1; all by default.
        circuit: as for `nag.motion`.
        formulation: as for `nag.motion`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.ComponentError: if what is to be drawn was not found.
        nag.NagError: if it is not there, or an argument makes no sense.

    >>> import nag, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     picture = nag.plot("x^2 + y^2 - 1", f"{folder}/circle.svg", onto="x, y")
    >>> picture.complete
    True
    """
    from nag.algebra.tokens import list_names
    from nag.files.written_file import check_target
    from nag.pictures.plot import (
        check_kind,
        choose_picture,
        plot_components,
        plot_mechanism,
        variables_onto,
    )

    onto = None if onto is None else tuple(list_names(onto))
    joints = None if joints is None else list_joints(joints)
    asked: dict[str, Any] = {"onto": onto, "joints": joints, "point": point}
    asked |= {"graph": graph, "mechanism": mechanism, "tree": tree}
    kind, target = choose_picture(asked), os.fspath(path)
    if component is not None and kind != "onto":
        raise NagError("component: is for onto; leave it out")
    check_kind(target)
    check_target(target)
    title = given.title if is_a(given, "nag.files.cases", "Case") else ""
    if kind not in ("onto", "tree"):
        from nag.mechanism.problem import problem_of

        asked_of = problem_of(given, formulation=formulation)
        return plot_mechanism(
            asked_of, kind, asked[kind], title, target, run, onto=onto, circuit=circuit
        )

    def check(system: PolynomialSystem, _: object) -> None:
        if kind == "onto":
            variables_onto(onto or (), system.own_variables)

    found, _, _ = _find_in(given, run, formulation, check=check, real=kind == "onto")
    chosen = None if component is None else {component: component_numbered(found, component)}
    return plot_components(found, kind, onto, title, target, run, chosen)


def list_joints(joints: Any) -> tuple[str, ...]:
    """Joints' names, which may have blanks in them, one by one or in a text with commas between."""
    if isinstance(joints, str):
        joints = joints.split(",") if "," in joints else joints.split()
    listed = joints if isinstance(joints, Iterable) else [joints]
    return tuple(filter(None, (str(name).strip() for name in listed)))


# --- Proofs


@takes_files
@takes_run
def check_statements(given: Moving | None = None, *, run: Run = DEFAULT_RUN) -> CheckedStatements:
    """Test what the founding papers state of a mechanism or a system, or all that they state.

    Args:
        given: a case that the papers speak of, or the name of its file; by default everything.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The statements, each with what was found and what that rests on; complete if each is
        decided, and what fails is a known misprint.

    Raises:
        nag.NagError: if the papers say nothing of it.

    >>> import nag
    >>> nag.check_statements("cases/slider-crank.toml").complete
    True
    """
    from nag.check.statement import CheckedStatements, DecidedStatement
    from nag.check.subjects import WITH_CASES, everything, recognised
    from nag.decomposition.decompose import decompose as decompose_system
    from nag.files.case_writing import case_of

    def find_components(system: Any) -> Decomposition:
        return decompose_system(system, run=run)

    if given is None:
        sections = everything(find_components)
    else:
        case = case_of(given)
        found = recognised(case, find_components)
        if found is None:
            known = ", ".join(WITH_CASES)
            place = case.path if case is given else "given"
            said = f"{place}: the papers give no components of it; they do of {known}"
            raise NagError(said).mended_by("all")
        sections = [
            (found.subject.title, found.subject.statements),
            (f"{case.title}: decomposition", found.comparison),
        ]
    decided = []
    for title, statements in sections:
        rows = []
        for i, statement in enumerate(statements):
            run.tell(title, i, len(statements))
            rows.append(DecidedStatement.of(statement, statement.verdict()))
        decided.append((title, tuple(rows)))
    return CheckedStatements(tuple(decided))


@dataclass(frozen=True, eq=False)
class Certified:
    """What was proved of a result.

    True where all is proved that is said of the points, and nothing is to be said against the rest;
    that there is nothing else may rest on evidence all the same, see ``complete``.

    Attributes:
        rows: labelled lines, which say how long it took as well, and are not compared.
        all_proved: whether each point, and each path or loop that was asked for, is proved, none of
            them by evidence only, and no statement of the result is refuted, doubted, or was looked
            at in vain.
        certificate, paths: of the points, and of the paths or loops, if they were asked for.
        claims: how every statement of an export of the result stands.
    """

    rows: tuple[tuple[str, str], ...] = field(compare=False)
    all_proved: bool
    certificate: SolutionsCertificate | DecompositionCertificate
    paths: ProvedPaths | tuple[ProvedMonodromy, ...] | None
    claims: tuple[Claim, ...]

    __eq__ = equal_values

    @property
    def found(self) -> SolveResult | Decomposition:
        """The result that it is of."""
        from nag.solving.certificate import SolutionsCertificate

        of = self.certificate
        return of.result if isinstance(of, SolutionsCertificate) else of.decomposition

    @property
    def complete(self) -> bool:
        """Whether it is proved that there are no other solutions, or components."""
        return self.certificate.complete

    def document(self) -> dict[str, Any]:
        """The boxes, and what is claimed, as a JSON object."""
        document = self.certificate.document(self.claims, self.paths)
        return document | {"all_proved": self.all_proved, "complete": self.complete}

    def __bool__(self) -> bool:
        return self.all_proved

    def __repr__(self) -> str:
        from nag.numerics.claims import Standing, standing_of_field

        proved = "all points proved" if self.all_proved else "NOT all proved"
        complete = Standing.PROVED if self.complete else standing_of_field(self.claims, "complete")
        said = "not proved" if complete is Standing.UNSEEN else str(complete)
        return f"<Certified: {proved}; complete: {said}>"

    def __str__(self) -> str:
        from nag.text.table import label_lines

        return "\n".join(label_lines(self.rows))


_WHOLE = "points are proved together with their system: give all that nag.solve returned"
# What has points, and is nothing that `certify` takes.
NOT_CERTIFIED = {
    ("nag.solving.solutions", "Solution"): _WHOLE,
    ("nag.solving.solutions", "Solutions"): _WHOLE,
    ("nag.solving.family_members", "FamilySolutions"): (
        "members are proved one by one: give what nag.solve returns of one"
    ),
}


@takes_files
@takes_run
def certify(
    given: Decomposed, paths: bool = False, *, formulation: str = "auto", run: Run = DEFAULT_RUN
) -> Certified:
    """Prove the points of a result: one zero in a box about each, distinct, and which are real.

    Args:
        given: what `nag.solve` or `nag.decompose` returned, an export of it, or a component; or
            anything that describes a problem, see `nag.problem`, which is solved now if it is as
            many equations as unknowns and no mechanism, else decomposed.
        paths: whether the paths from the start system are proved as well, and of components the
            loops that connect their points.
        formulation: of a mechanism's model, as for `nag.model`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        What was proved; it is true where each point is proved, and no statement is refuted or was
        looked at in vain. Its ``complete`` says whether it is proved that there is nothing else,
        its ``found`` is the result.

    Raises:
        nag.NagError: if ``given`` is nothing of that kind.

    >>> import nag
    >>> bool(nag.certify(nag.solve(["x^2 + y^2 - 1", "x - y"])))
    True
    >>> proved = nag.certify("x^2 + y^2 - 1")
    >>> proved
    <Certified: all points proved; complete: proved>
    >>> proved.found
    <Decomposition: 1 component of dimension 1, degree 2>
    """
    one = given[0] if isinstance(given, list | tuple) and given else given
    for kind, advice in NOT_CERTIFIED.items():
        if is_a(one, *kind):
            raise NagError(f"given: {kind[1]} is given; {advice}")
    if is_a(given, "nag.witness.witness", "WitnessSet"):
        given = _of_one_component(given)
    known = is_a(given, "nag.solving.solutions", "SolveResult")
    if known or is_a(given, "nag.witness.witness", "Decomposition"):
        if formulation != "auto":
            raise NagError("formulation: a result is given; it is in one already")
        return certify_result(given, paths)
    from nag.mechanism.problem import problem_of

    asked = problem_of(given, formulation=formulation)
    square = len(asked.system.polynomials) == asked.system.n
    solved = asked.model is None and square
    return certify_result(asked.solve(run=run) if solved else asked.decompose(run=run), paths)


def certify_result(
    found: SolveResult | Decomposition, paths: bool = False, lost: Sequence[Claim] = ()
) -> Certified:
    """The certificate of a result, with ``paths`` also of the paths that lead to it.

    Args:
        lost: fields of an export that are not in what was read of it.
    """
    from nag.numerics.claims import claims_rows, nothing_against
    from nag.solving.certificate import certify_solutions
    from nag.solving.solutions import SolveResult
    from nag.witness.certificate import certify_decomposition

    started = time.perf_counter()
    if isinstance(found, SolveResult):
        certificate, prove = certify_solutions(found), _prove_paths
    else:
        certificate, prove = certify_decomposition(found), _prove_loops
    claims = certificate.claims
    rows = certificate.rows(time.perf_counter() - started)
    proved, further, good, claims = prove(certificate) if paths else (None, [], True, claims)
    claims = (*claims, *lost)
    good = good and certificate.all_proved and nothing_against(claims)
    said = (*rows, *further, *claims_rows(claims))
    return Certified(said, good, certificate, proved, claims)


Further = tuple[Any, "list[Row]", bool, tuple["Claim", ...]]


def _prove_paths(certificate: SolutionsCertificate) -> Further:
    """The proof of the paths to solutions, its lines, whether nothing was left open, statements."""
    from nag.solving.certified_paths import PathsError, prove_paths
    from nag.solving.solution_claims import claims_of_paths

    found, started = certificate.result, time.perf_counter()
    try:
        proved = prove_paths(found)
    except PathsError as error:
        return None, [("paths", f"not proved: {error}")], False, certificate.claims
    rows = proved.rows(len(found.solutions), time.perf_counter() - started)
    simple = sum(s.multiplicity == 1 for s in found.solutions)
    good = proved.distinct and not proved.lost and len(proved.solutions) >= simple
    return proved, rows, good, claims_of_paths(certificate, proved.others)


def _prove_loops(certificate: DecompositionCertificate) -> Further:
    """The proof of the loops of all components, its lines, whether all is proved, statements."""
    from nag.decomposition.trace import linear_traces
    from nag.witness.certified_loops import loops_rows, prove_all
    from nag.witness.component_claims import claims_of_loops

    found, started = certificate.decomposition, time.perf_counter()
    proved = prove_all(found)
    connected = [m.connected for m in proved]
    claims = claims_of_loops(certificate, connected, linear_traces(found))
    rows = loops_rows(proved, time.perf_counter() - started)
    return proved, rows, all(connected), claims
