"""What the commands ask, as functions: each takes whatever describes what is asked about.

That is the name of a file (a case, a system in another program's format, an export), a `nag.Case`,
a mechanism, its model, parts, equations, or what was found before. Components are numbered from 1,
as everywhere in text.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from nag.algebra.given import check_whole, is_a, value_text
from nag.errors import ComponentError, InputError, NagError
from nag.tracking.run import DEFAULT_RUN, Run, takes_run

if TYPE_CHECKING:
    from nag.algebra.number import Number
    from nag.algebra.system import PolynomialSystem
    from nag.decomposition.singular_points import SingularLocus
    from nag.files.cases import Case
    from nag.interpolation.image_ideal import ImageIdeal
    from nag.mechanism.problem import Problem
    from nag.numerics.claims import Claim
    from nag.numerics.local_dimension import LocalDimension
    from nag.pictures.plot import Picture
    from nag.solving.certificate import SolutionsCertificate
    from nag.solving.certified_paths import ProvedPaths
    from nag.solving.solutions import SolveResult
    from nag.text.table import Row
    from nag.witness.certificate import DecompositionCertificate
    from nag.witness.certified_loops import ProvedMonodromy
    from nag.witness.membership import PointMembership
    from nag.witness.sampling import Samples
    from nag.witness.witness import Decomposition, WitnessSet

Answer = TypeVar("Answer")

# Ends of names that files have and equations have not.
SUFFIXES = (".toml", ".json", ".urdf", ".xml", ".m2", ".sing", ".txt", ".bertini", ".phc")
# What is said of a component of an export on which paths fail.
UNTESTED = "the trace of its points could not be tested"


# --- Files


def read(path: str | os.PathLike[str]) -> Case | Decomposition | SolveResult | dict[str, Any]:
    """What a file holds, told by its content.

    Args:
        path: a case or a system in another program's format, which gives a `nag.Case`; an export
            of a decomposition or of solutions, which gives an equal one; or what another command
            wrote with ``--json``, which gives that JSON object, checked by its schema.

    Raises:
        nag.InputError: if it cannot be read or makes no sense; one line says where and what would
            be right.

    >>> import nag
    >>> nag.read("cases/bennett.toml").kind
    'mechanism'
    """
    from nag.files.cases import read_case

    try:
        with Path(path).open("rb") as file:
            is_json = file.read(256).lstrip()[:1] == b"{"
        return _read_export(path) if is_json else read_case(path)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from None


def _read_export(
    path: str | os.PathLike[str],
) -> Decomposition | SolveResult | dict[str, Any]:
    from nag.files import export, solutions_export
    from nag.files.json_schema import published_versions
    from nag.files.json_values import ExportError, checked_document, read_file

    def convert(value: Any) -> Decomposition | SolveResult | dict[str, Any]:
        name = value.get("format") if isinstance(value, dict) else None
        if name == export.FORMAT:
            return export.export_of(value).decomposition
        if name == solutions_export.FORMAT:
            return solutions_export.solutions_of(value).result
        versions = published_versions(name) if isinstance(name, str) else ()
        if versions:
            return checked_document(value, name, *versions)
        raise ExportError("format: is none that nag writes with --json")

    return read_file(path, convert)


def write(result: Decomposition | SolveResult, path: str | os.PathLike[str]) -> None:
    """Write a decomposition or solutions to a file from which `read` gives an equal one.

    The file is what ``nag decompose`` and ``nag solve`` write with ``--json``. Documents of other
    commands say less than their results hold, so these are kept by `pickle`.

    Raises:
        nag.InputError: if the file cannot be written.
        nag.NagError: if ``result`` is neither.

    >>> import nag, tempfile
    >>> circle = nag.decompose("x^2 + y^2 = 1")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write(circle, f"{folder}/circle.json")
    ...     nag.read(f"{folder}/circle.json") == circle
    True
    """
    if is_a(result, "nag.witness.witness", "Decomposition"):
        from nag.files.export import write_decomposition

        write_decomposition(result, path)  # type: ignore[arg-type]
    elif is_a(result, "nag.solving.solutions", "SolveResult"):
        from nag.files.solutions_export import write_solutions

        write_solutions(result, path)  # type: ignore[arg-type]
    else:
        raise NagError(
            f"result: {value_text(result)} is given; give what nag.decompose, nag.intersect or "
            "nag.solve returns: other results are kept by pickle, or by their command's --json"
        )


def open_file(given: Any) -> Any:
    """What a file holds, if the name of one is given; else what is given."""
    if isinstance(given, os.PathLike):
        return read(given)
    if isinstance(given, str) and (given.endswith(SUFFIXES) or os.path.isfile(given)):
        return read(given)
    return given


def taking_files(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """The same function, whose first argument may be the name of a file."""

    @wraps(function)
    def call(given: Any, *arguments: Any, **named: Any) -> Answer:
        return function(open_file(given), *arguments, **named)

    return call


# --- Points


def _problem_and_points(given: Any) -> tuple[Problem, Mapping[str, tuple[Number, ...]]]:
    from nag.mechanism.problem import problem_of

    problem = problem_of(open_file(given))
    return problem, {point.name: point.at for point in problem.points}


def _point(
    point: Any, system: PolynomialSystem, points: Mapping[str, tuple[Number, ...]]
) -> tuple[Number | complex, ...]:
    """A point's coordinates: those of the one that has this name, or what is given.

    None stands for the only one that has a name.
    """
    if point is None and len(points) == 1:
        return next(iter(points.values()))
    if point is None or isinstance(point, str):
        known = f"its points are {', '.join(points)}" if points else "it has none with a name"
        if point not in points:
            names = ", ".join(system.own_variables)
            raise NagError(
                f"point: {value_text(point)} is given; give the name of one ({known}), or numbers "
                f"for {names}"
            )
        return points[point]
    from nag.algebra.from_python import coordinates

    return coordinates(point, system.variables, system.imaginary)


def local(given: Any, point: Any = None, *, seed: int = 0) -> LocalDimension:
    """The dimension that the solution set has at a point; nothing is decomposed for it.

    Args:
        given: anything that describes a problem, see `nag.decompose`, or a file's name.
        point: the name of a point (``"reference"`` for a mechanism), a mapping of variables to
            numbers, or numbers in order; by default the only point that has a name.
        seed: of random directions.

    Raises:
        nag.NagError: if it is no solution, or an argument makes no sense.

    >>> import nag
    >>> print(nag.local("cases/bennett.toml").dimension)
    1
    """
    from nag.numerics.local_dimension import local_dimension_near

    problem, points = _problem_and_points(given)
    at = _point(point, problem.system, points)
    return local_dimension_near(problem.system, at, seed=seed)


# --- Components


def find_components(given: Any, run: Run, real: bool = False) -> Decomposition:
    """All components of what is given, none for a whole orbit; those of an export are tested.

    Args:
        real: whether real points are asked for, so that frameworks take coordinates that are real
            where their realisations are.
    """
    return _find_in(given, open_file(given), run, real=real)[0]


def _find_in(
    given: Any,
    opened: Any,
    run: Run,
    check: Callable[[PolynomialSystem], object] | None = None,
    real: bool = False,
) -> tuple[Decomposition, Mapping[str, tuple[Number, ...]]]:
    """The same of what is given, or was read from it, and the points of a problem by their names.

    Args:
        check: called with a problem's system before it is decomposed.
        real: as of `find_components`.
    """
    from nag.witness.frame import expand_orbits

    if is_a(opened, "nag.witness.witness", "WitnessSet"):
        return _of_one_component(opened), {}
    if is_a(opened, "nag.witness.witness", "Decomposition"):
        found = expand_orbits(opened)
        return (found if opened is given else check_traces(found)), {}
    problem, points = _problem_and_points(opened)
    if real:
        from nag.mechanism.problem import in_real_coordinates

        problem = in_real_coordinates(problem)
    if check is not None:
        check(problem.system)
    return expand_orbits(problem.decompose(run=run)), points


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


@takes_run
def member(given: Any, point: Any = None, *, run: Run = DEFAULT_RUN) -> PointMembership:
    """Which components a point lies on.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        point: as for `local`.
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

    found, points = _find_in(given, open_file(given), run)
    at = _point(point, found.system, points)
    known = [x if isinstance(x, complex) else exact_number(x) for x in at]
    return locate_point(found, known, run=run)


@takes_run
def sample(
    given: Any,
    component: int = 1,
    *,
    count: int = 10,
    real: bool = False,
    run: Run = DEFAULT_RUN,
) -> Samples:
    """Random points of a component.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        component: its number, from 1.
        count: how many.
        real: whether they are to be real; of a framework in coordinates x, y.
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
    found = find_components(given, run, real)
    chosen = component_numbered(found, component)
    if real:
        from nag.real.real_samples import sample_real

        return sample_real(chosen, count, run=run)
    from nag.witness.sampling import sample as sample_component

    return sample_component(found.system, chosen, count, run=run)


@takes_run
def singular(given: Any, component: int | None = None, *, run: Run = DEFAULT_RUN) -> SingularLocus:
    """Singular points of components, and where components meet.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        component: the number of the one that is asked about, from 1; all by default.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if there is no such component, or an argument makes no sense.

    >>> import nag
    >>> nag.singular("y^2 - x^2*(x + 1)").sets[0].dimension
    0
    """
    from nag.decomposition.singular_points import singular_locus

    found = find_components(given, run)
    if component is not None:
        component_numbered(found, component)
    return singular_locus(found, only=None if component is None else [component - 1], run=run)


@takes_run
def intersect(given: Any, first: int, second: int, *, run: Run = DEFAULT_RUN) -> Decomposition:
    """The components of the intersection of two components, by their numbers from 1.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        first: the number of one.
        second: that of the other, which may be the same.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.NagError: if there is no such component, or an argument makes no sense.

    >>> import nag
    >>> nag.intersect("(x^2 + y^2 - 1)*(x - y)", 1, 2).components[0].dimension
    0
    """
    from nag.decomposition.intersection import intersect_components

    found = find_components(given, run)
    pair = (
        component_numbered(found, first, "first"),
        component_numbered(found, second, "second"),
    )
    return intersect_components(found.system, *pair, run=run)


@takes_run
def eliminate(
    given: Any,
    onto: Sequence[str] | str | None = None,
    component: int = 1,
    *,
    degree: int | None = None,
    polynomial: bool = False,
    run: Run = DEFAULT_RUN,
) -> ImageIdeal:
    """Exact equations of a component in some variables, and maps from these to the others.

    Args:
        given: components that were found, a file of them, or what is decomposed now.
        onto: names of the variables, or a text of them with commas; by default essential ones, from
            which all others follow.
        component: its number, from 1.
        degree: all equations up to this degree; by default until they define the image.
        polynomial: whether only polynomial maps to the other variables are looked for.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Raises:
        nag.ComponentError: if coefficients are not recognised.
        nag.NagError: if there is no such component or variable.

    >>> import nag
    >>> found = nag.eliminate(["y - x^2", "z - x^3"], "y, z")
    >>> [str(f) for f in found.equations]
    ['y^3 - z^2']
    """
    from nag.interpolation.image_ideal import eliminate_component
    from nag.interpolation.point_cloud import AmbientVariables, Cloud
    from nag.interpolation.precise_samples import SourceError, source_of_component

    found = find_components(given, run)
    chosen = component_numbered(found, component)
    if not chosen.dimension:
        raise SourceError("the component is a point; there is nothing to eliminate from")
    names = onto.split(",") if isinstance(onto, str) else onto
    places = None if names is None else place_variables([n.strip() for n in names], found.system)
    source = source_of_component(found.system, chosen)
    cloud = Cloud(source, AmbientVariables.itself(found.system), run.random(4), run)
    alike = list_alike(found, component)
    return eliminate_component(cloud, alike, places, degree, polynomial, run.progress)


def list_alike(found: Decomposition, number: int) -> dict[int, WitnessSet]:
    """Components of one's dimension, degree and multiplicity, by their numbers, that one first."""

    def kind(c: WitnessSet) -> tuple[int, int, int]:
        return c.dimension, c.degree, c.multiplicity

    chosen = found.components[number - 1]
    others = {k: c for k, c in enumerate(found.components, 1) if kind(c) == kind(chosen)}
    return {number: chosen} | others


def place_variables(names: Sequence[str], system: Any) -> tuple[int, ...]:
    """Indices of variables by their names.

    Raises:
        nag.NagError: if there is no such variable, or one is named twice.
    """
    from nag.algebra.tokens import nearest, quote

    known = system.variables
    for name in names:
        if name not in known:
            raise NagError(f"onto: {quote(name)} is not one of the variables{nearest(name, known)}")
    if len(set(names)) < len(names):
        raise NagError("onto: a variable is given twice")
    return tuple(known.index(name) for name in names)


# --- Pictures


@takes_run
def plot(
    given: Any,
    path: str | os.PathLike[str],
    *,
    onto: Sequence[str] | str | None = None,
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
        given: anything that describes a problem, see `nag.decompose`, a file's name, or components
            that were found.
        path: the file, ending in .svg, .png or .pdf.
        onto: two variables or three, names or a text of them with commas: the real points of the
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
    from nag.files.written_file import check_target
    from nag.pictures.plot import (
        check_kind,
        choose_picture,
        plot_components,
        plot_mechanism,
        variables_onto,
    )

    onto, joints = _listed_names(onto), _listed_names(joints)
    asked = {"onto": onto, "joints": joints, "point": point}
    asked |= {"graph": graph, "mechanism": mechanism, "tree": tree}
    kind, target = choose_picture(asked), os.fspath(path)
    if component is not None and kind != "onto":
        raise NagError("component: is for onto; leave it out")
    check_kind(target)
    check_target(target)
    opened = open_file(given)
    title = opened.title if is_a(opened, "nag.files.cases", "Case") else ""
    if kind not in ("onto", "tree"):
        from nag.mechanism.problem import problem_of

        problem = problem_of(opened, formulation=formulation)
        return plot_mechanism(
            problem, kind, asked[kind], title, target, run, onto=onto, circuit=circuit
        )

    def check(system: PolynomialSystem) -> None:
        if kind == "onto":
            variables_onto(onto or (), system.own_variables)

    found, _ = _find_in(given, opened, run, check, real=kind == "onto")
    chosen = None if component is None else {component: component_numbered(found, component)}
    return plot_components(found, kind, onto, title, target, run, chosen)


def _listed_names(names: Sequence[str] | str | None) -> tuple[str, ...] | None:
    if names is None:
        return None
    return tuple(n.strip() for n in (names.split(",") if isinstance(names, str) else names))


# --- Proofs


@dataclass(frozen=True)
class Certified:
    """What was proved of a result.

    Attributes:
        rows: labelled lines; all_proved: whether nothing was refuted or left open.
        certificate, paths: of the points, and of the paths or loops, if they were asked for.
        claims: how every statement of an export of the result stands.
    """

    rows: list[tuple[str, str]]
    all_proved: bool
    certificate: SolutionsCertificate | DecompositionCertificate
    paths: ProvedPaths | tuple[ProvedMonodromy, ...] | None
    claims: tuple[Claim, ...]

    def document(self) -> dict[str, Any]:
        """The boxes, and what is claimed, as a JSON object."""
        return self.certificate.document(self.claims, self.paths)

    def __bool__(self) -> bool:
        return self.all_proved

    def __repr__(self) -> str:
        return f"<Certified: {'all proved' if self.all_proved else 'NOT all proved'}>"

    def __str__(self) -> str:
        from nag.text.table import label_lines

        return "\n".join(label_lines(self.rows))


def certify(found: Any, paths: bool = False) -> Certified:
    """Prove the points of a result: one zero in a box about each, distinct, and which are real.

    Args:
        found: what `nag.solve` or `nag.decompose` returned, or the name of an export of it.
        paths: whether the paths from the start system are proved as well, and of components the
            loops that connect their points.

    Returns:
        What was proved; it is true where nothing was refuted or left open.

    Raises:
        nag.NagError: if ``found`` is no such result.

    >>> import nag
    >>> bool(nag.certify(nag.solve(["x^2 + y^2 - 1", "x - y"])))
    True
    """
    opened = open_file(found)
    known = is_a(opened, "nag.solving.solutions", "SolveResult")
    if not (known or is_a(opened, "nag.witness.witness", "Decomposition")):
        raise NagError(
            f"found: {value_text(found)} is given; give what nag.solve or nag.decompose returns, "
            "or the name of an export"
        )
    return certify_result(opened, paths)


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
    return Certified([*rows, *further, *claims_rows(claims)], good, certificate, proved, claims)


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
