"""Decompositions as JSON: written, and read back to equal objects.

The format is ``nag-decomposition``, version 2; its JSON Schema is in ``schema/`` beside this
module. A file holds all that is needed to go on from it (system, slices, points, the equations that
cut each component regularly, seed, settings) and nothing that differs between runs with the same
seed (no times, no folders, no thread counts). Files of version 1, which lack these equations, and
of version 2 without error radii, are read as well.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.given import check_path, check_type
from nag.algebra.symmetry import SignedPermutation, SymmetryError
from nag.algebra.system import PolynomialSystem
from nag.files.json_values import (
    ExportError,
    check_imaginary_unit,
    checked_document,
    complex_matrix,
    complex_vector,
    parse_polynomials,
    parse_system,
    read_file,
    real_number,
    wrong,
)
from nag.files.written_file import write_target
from nag.numerics.digits import WORDS
from nag.numerics.zero_values import LEAST
from nag.text.json_text import lay_out
from nag.witness.close_points import PointInWords
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.witness import (
    DOUBLE,
    FORMAT,
    VERSION,
    Decomposition,
    PathCounts,
    Slice,
    Status,
    WitnessSet,
    even_radii,
)

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.problem import Problem


@dataclass(frozen=True)
class Origin:
    """Where a decomposed system came from.

    Attributes:
        title: title of the case.
        file: name of the case file, without its folder.
        kind: ``"system"``, or ``"mechanism"`` where it is the model of one, assembled or not.
        formulation: of a mechanism's model or a table: ``"E"``, ``"H"``, ``"S"`` or ``"P"``.
        reason: why that model was chosen.
    """

    title: str
    file: str
    kind: str
    formulation: str | None = None
    reason: str | None = None

    @classmethod
    def of(cls, case: Case, problem: Problem) -> Origin:
        """A case and what of it was decomposed."""
        made = problem.model
        kind, reason = ("system", None) if made is None else ("mechanism", made.reason)
        return cls(case.title, Path(case.path).name, kind, problem.formulation, reason)

    @property
    def head(self) -> dict[str, Any]:
        """What a decomposition's document says of it."""
        case = {"title": self.title, "file": self.file, "kind": self.kind}
        return {"case": case, "formulation": self.formulation, "reason": self.reason}


@dataclass(frozen=True)
class Export:
    """What a file holds."""

    decomposition: Decomposition
    origin: Origin | None = None


def export_text(decomposition: Decomposition, origin: Origin | None = None) -> str:
    """The export as JSON text, ASCII, the same for equal arguments."""
    return lay_out(decomposition.document(**(origin.head if origin else {}))) + "\n"


def write_decomposition(
    decomposition: Decomposition,
    path: str | os.PathLike[str],
    origin: Origin | None = None,
) -> None:
    """Write the export to ``path`` in one step.

    Args:
        origin: the case that was decomposed, where there is one.

    Raises:
        nag.files.written_file.TargetError: if the file cannot be written.
        ValueError: if something else is given.

    >>> import json, nag, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write_decomposition(nag.decompose("x*y"), f"{folder}/lines.json")
    ...     with open(f"{folder}/lines.json") as written:
    ...         json.load(written)["format"]
    'nag-decomposition'
    """
    check_type(decomposition, Decomposition, "decomposition", "what nag.decompose returns")
    check_path(path)
    if origin is not None:
        check_type(origin, Origin, "origin", "a nag.files.export.Origin, or leave it out")
    write_target(path, export_text(decomposition, origin))


def _multidegree(value: Any, groups: int, dimension: int, place: str) -> np.ndarray:
    try:
        array = np.array(value)
    except ValueError:
        array = np.array(None)
    if array.shape != (groups,) * dimension or array.dtype.kind not in "iu" or (array < 0).any():
        raise wrong(place, f"{groups} counts in each of {dimension} nested lists")
    return array


def _cut(table: dict[str, Any], system: PolynomialSystem, place: str) -> Cut:
    names = table["unknowns"]
    here = f"{place}.polynomials"
    found = parse_polynomials(table["polynomials"], [*system.variables, *names], here)
    for i, f in enumerate(found):
        if not f:
            raise wrong(f"{here}[{i}]", "a polynomial that is not zero")
    return Cut(system.n, len(names), tuple(found))


def _fibres(
    parts: Sequence[dict[str, Any]],
    cuts: Sequence[Cut],
    points: np.ndarray,
    rows: np.ndarray,
    place: str,
) -> tuple[Fibre, ...]:
    found, first = [], 0
    for i, table in enumerate(parts):
        here = f"{place}[{i}]"
        if table["equations"] >= len(cuts):
            raise wrong(f"{here}.equations", "the index of one of the equations")
        cut = cuts[table["equations"]]
        last = first + table["points"]
        unknowns = complex_matrix(table["unknowns"], cut.aux, f"{here}.unknowns")
        if last > len(points) or len(unknowns) != last - first:
            raise wrong(f"{here}.unknowns", "one row for each of the points")
        if len(cut.polynomials) != cut.n + cut.aux - len(rows):
            raise wrong(f"{here}.equations", "that of as many equations as cut the component")
        own = np.hstack([points[first:last], unknowns])
        close = close_points(table.get("close", []), own, f"{here}.close")
        found.append(Fibre(cut, rows, own, close))
        first = last
    if found and first != len(points):
        raise wrong(place, "one cut for each of the points")
    return tuple(found)


def _component(
    table: dict[str, Any], system: PolynomialSystem, cuts: Sequence[Cut], place: str
) -> WitnessSet:
    b = complex_vector(table["slice"]["b"])
    a = complex_matrix(table["slice"]["A"], system.n, f"{place}.slice.A")
    points = complex_matrix(table["points"], system.n, f"{place}.points")
    check_imaginary_unit(points, system.imaginary, f"{place}.points")
    if len(a) != len(b) or table["dimension"] != len(b):
        raise wrong(f"{place}.dimension", "the number of rows of the slice's A and b")
    if not (np.isfinite(a).all() and np.isfinite(b).all() and a.any(axis=1).all()):
        raise wrong(f"{place}.slice", "of equations with finite coefficients, not all of them 0")
    if table["degree"] != len(points):
        raise wrong(f"{place}.degree", "the number of points")
    multidegree = table.get("multidegree")
    if multidegree is not None:
        here = f"{place}.multidegree"
        multidegree = _multidegree(multidegree, len(system.own_groups), len(b), here)
    radii, digits = _errors(table, points, place)
    orbit, cut = table["orbit"], Slice(a, b)
    return WitnessSet(
        slice=cut,
        points=points,
        multiplicity=table["multiplicity"],
        status=Status(table["status"]),
        residual=real_number(table["residual"]),
        radii=radii,
        digits=digits,
        corank=table["corank"],
        multidegree=multidegree,
        orbit=orbit["size"],
        note=table["note"],
        images=_images(orbit.get("images", []), orbit["size"], system, f"{place}.orbit.images"),
        fibres=_fibres(table.get("cut_by", []), cuts, points, cut.rows, f"{place}.cut_by"),
    )


def _errors(table: dict[str, Any], points: np.ndarray, place: str) -> tuple[np.ndarray, list[int]]:
    """Error radii and digits of points; those of files without them from the set's accuracy."""
    if "radii" not in table:
        accuracy = real_number(table["accuracy"])
        radii = np.nan_to_num(even_radii(points, accuracy), nan=np.inf, posinf=np.inf)
        return radii, [DOUBLE] * len(points)
    if [len(row) for row in table["radii"]] != [points.shape[1]] * len(points):
        raise wrong(f"{place}.radii", "as many numbers as the points have, in as many rows")
    here, digits = f"{place}.digits", table["digits"]
    if len(digits) != len(points):
        raise wrong(here, "one number for each of the points")
    if max(digits, default=0) > np.iinfo(np.int64).max:
        raise wrong(here, "numbers of at most 64 bits")
    radii = np.array(table["radii"], dtype=float).reshape(points.shape)
    radii[np.isnan(radii)] = np.inf
    return radii, digits


def _images(
    maps: Sequence[dict[str, str]], size: int, system: PolynomialSystem, place: str
) -> tuple[SignedPermutation, ...]:
    found = []
    for i, texts in enumerate(maps):
        try:
            found.append(SignedPermutation.of_map(texts, system.variables))
        except SymmetryError as error:
            raise ExportError(f"{place}[{i}]: {error}") from None
    if len(found) not in (0, size - 1):
        raise wrong(place, "one symmetry for each other component of the orbit")
    return tuple(found)


def export_of(value: Any) -> Export:
    """What a document of the format holds.

    Raises:
        ExportError: if it is not one.
    """
    table = checked_document(value, FORMAT, VERSION, 1)
    system = parse_system(table["system"], "system")
    # Files of version 1 have none.
    cuts = [_cut(v, system, f"equations[{i}]") for i, v in enumerate(table.get("equations", []))]
    components = [
        _component(v, system, cuts, f"components[{i}]") for i, v in enumerate(table["components"])
    ]
    decomposition = Decomposition(
        system=system,
        components=tuple(components),
        paths=PathCounts(*(table["paths"][name] for name in PathCounts.__match_args__)),
        seed=table["seed"],
        settings=table["settings"],
        order=tuple(table["order"]),
        complete=table["complete"],
        notes=tuple(table["notes"]),
        method=table.get("method", ""),
    )
    case = table["case"]
    if case is None:
        return Export(decomposition)
    place = {key: case[key] for key in ("title", "file", "kind")}
    return Export(
        decomposition, Origin(**place, **{k: table[k] for k in ("formulation", "reason")})
    )


def read_export(path: str | os.PathLike[str]) -> Export:
    """Read a file that `write_decomposition` wrote: the decomposition and where it came from.

    Raises:
        ExportError: if the file cannot be read or is not an export.
    """
    return read_file(path, export_of)


def read_decomposition(path: str | os.PathLike[str]) -> Decomposition:
    """Read a decomposition that `write_decomposition` wrote, equal to the one written.

    Values that were not finite are written as null and come back as not-a-number. The components
    know their system again, so that they can be sampled and tested.

    Raises:
        ExportError: if the file cannot be read or is not an export.

    >>> import nag, tempfile
    >>> circle = nag.decompose("x^2 + y^2 = 1")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write_decomposition(circle, f"{folder}/circle.json")
    ...     again = nag.read_decomposition(f"{folder}/circle.json")
    >>> again == circle, again.components[0].contains(["3/5", "4/5"])
    (True, True)
    """
    return read_export(path).decomposition


def close_points(
    value: Sequence[dict[str, Any]], points: np.ndarray, place: str
) -> dict[int, PointInWords]:
    """What `Fibre.document` says of close ones of points of shape ``(P, n + aux)``.

    Raises:
        nag.files.json_values.ExportError: if it does not fit them.
    """
    found: dict[int, PointInWords] = {}
    shape = points.shape[1], 2, WORDS
    for k, table in enumerate(value):
        here = f"{place}[{k}]"
        i = table["point"]
        if i >= len(points) or i in found:
            raise wrong(f"{here}.point", "the index of a point, once")
        words = np.array(table["coordinates"], dtype=float)
        if words.shape != shape:
            each = f"{WORDS} numbers for the real and the imaginary part of each of {shape[0]}"
            raise wrong(f"{here}.coordinates", each)
        curvature = real_number(table["curvature"])
        found[i] = PointInWords(words, curvature if np.isfinite(curvature) else np.inf)
        if not np.allclose(found[i].rounded, points[i], rtol=LEAST, atol=1e-300):
            raise wrong(f"{here}.coordinates", "those of the point in more digits")
    return found
