"""Decompositions as JSON: written, and read back to equal objects.

The format is ``nag-decomposition``, version 2; its JSON Schema is in ``schema/`` beside this
module. A file holds all that is needed to go on from it (system, slices, points, the equations that
cut each component regularly, seed, settings) and nothing that differs between runs with the same
seed (no times, no folders, no thread counts). Files of version 1, which lack these equations, and
of version 2 without error radii, are read as well.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from nag.algebra.given import check_path, check_type
from nag.algebra.symmetry import SignedPermutation, SymmetryError
from nag.algebra.system import PolynomialSystem
from nag.files.json_values import (
    ExportError,
    as_count,
    as_document,
    as_double,
    as_flag,
    as_list,
    as_matrix,
    as_polynomials,
    as_system,
    as_table,
    as_text,
    as_texts,
    as_vector,
    entry,
    lay_out,
    pairs,
    read_file,
    real_or_null,
    system_document,
    wrong,
)
from nag.files.written_file import write_target
from nag.witness.close_points import WORDS, Fine
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.witness import (
    DOUBLE,
    Decomposition,
    PathCounts,
    Slice,
    Status,
    WitnessSet,
    even_radii,
)

FORMAT = "nag-decomposition"
VERSION = 2

# A file is taken into memory whole, several times its size as Python objects.


@dataclass(frozen=True)
class Origin:
    """Where a decomposed system came from.

    Attributes:
        title: title of the case.
        file: name of the case file, without its folder.
        kind: ``"system"``, or ``"mechanism"`` where it is the model of one, assembled or not.
        formulation: of a mechanism's model or a table: ``"E"``, ``"H"`` or ``"S"``.
        reason: why that model was chosen.
    """

    title: str
    file: str
    kind: str
    formulation: str | None = None
    reason: str | None = None


@dataclass(frozen=True)
class Export:
    """What a file holds."""

    decomposition: Decomposition
    origin: Origin | None = None


def component_document(component: WitnessSet, variables: Sequence[str]) -> dict[str, Any]:
    orbit: dict[str, Any] = {"size": component.orbit}
    if component.images:
        orbit["images"] = [g.text(variables) for g in component.images]
    document: dict[str, Any] = {"dimension": component.dimension, "degree": component.degree}
    if component.multidegree is not None:
        document["multidegree"] = component.multidegree.tolist()
    return document | {
        "multiplicity": component.multiplicity,
        "status": str(component.status),
        "note": component.note,
        "orbit": orbit,
        "residual": real_or_null(component.residual),
        "accuracy": real_or_null(component.accuracy),
        "precision": f"{component.precision} digits",
        "corank": component.corank,
        "slice": {"A": pairs(component.slice.A), "b": pairs(component.slice.b)},
        "points": pairs(component.points),
        "radii": [[real_or_null(r) for r in row] for row in component.radii.tolist()],
        "digits": component.digits.tolist(),
    }


def _unknowns(count: int, variables: Sequence[str]) -> list[str]:
    """Names for unknowns that deflation added."""
    stem = "u"
    while any(name.startswith(stem) for name in variables):
        stem += "u"
    return [f"{stem}{i + 1}" for i in range(count)]


def _equations_document(cut: Cut, variables: Sequence[str]) -> dict[str, Any]:
    names = _unknowns(cut.aux, variables)
    texts = [f.text([*variables, *names]) for f in cut.polynomials]
    return {"unknowns": names, "polynomials": texts}


def document(decomposition: Decomposition, origin: Origin | None = None) -> dict[str, Any]:
    """The export as a JSON object (dicts, lists, strings, numbers, None)."""
    system = decomposition.system
    cuts = list(dict.fromkeys(f.cut for c in decomposition.components for f in c.fibres))
    place = {cut: i for i, cut in enumerate(cuts)}
    components = [
        component_document(c, system.variables)
        | {
            "cut_by": [
                {
                    "equations": place[f.cut],
                    "points": len(f),
                    "unknowns": pairs(f.points[:, system.n :]),
                }
                | ({"close": close_document(f.fine)} if f.fine else {})
                for f in c.fibres
            ]
        }
        for c in decomposition.components
    ]
    case = origin and {"title": origin.title, "file": origin.file, "kind": origin.kind}
    return {
        "format": FORMAT,
        "version": VERSION,
        "case": case,
        "formulation": origin and origin.formulation,
        "reason": origin and origin.reason,
        "seed": decomposition.seed,
        "settings": decomposition.settings,
        "complete": decomposition.complete,
        "notes": list(decomposition.notes),
        "paths": {
            "tracked": decomposition.paths.tracked,
            "failed": decomposition.paths.failed,
            "at_infinity": decomposition.paths.at_infinity,
        },
        "method": decomposition.method,
        "order": [int(i) for i in decomposition.order],
        "system": system_document(system),
        "equations": [_equations_document(cut, system.variables) for cut in cuts],
        "components": components,
    }


def export_text(decomposition: Decomposition, origin: Origin | None = None) -> str:
    """The export as JSON text, ASCII, the same for equal arguments."""
    return lay_out(document(decomposition, origin)) + "\n"


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


def _cut(value: Any, system: PolynomialSystem, place: str) -> Cut:
    table = as_table(value, place)
    names = as_texts(entry(table, "unknowns", place), f"{place}.unknowns")
    texts = entry(table, "polynomials", place)
    found = as_polynomials(texts, [*system.variables, *names], f"{place}.polynomials")
    for i, f in enumerate(found):
        if not f:
            raise wrong(f"{place}.polynomials[{i}]", "a polynomial that is not zero")
    return Cut(system.n, len(names), tuple(found))


def _fibres(
    value: Any, cuts: Sequence[Cut], points: np.ndarray, dimension: int, place: str
) -> tuple[Fibre, ...]:
    found, first = [], 0
    for i, item in enumerate(as_list(value, place)):
        here = f"{place}[{i}]"
        table = as_table(item, here)
        which = as_count(entry(table, "equations", here), f"{here}.equations")
        if which >= len(cuts):
            raise wrong(f"{here}.equations", "the index of one of the equations")
        cut = cuts[which]
        last = first + as_count(entry(table, "points", here), f"{here}.points")
        unknowns = as_matrix(entry(table, "unknowns", here), cut.aux, f"{here}.unknowns")
        if last > len(points) or len(unknowns) != last - first:
            raise wrong(f"{here}.unknowns", "one row for each of the points")
        if len(cut.polynomials) != cut.n + cut.aux - dimension:
            raise wrong(f"{here}.equations", "that of as many equations as cut the component")
        own = np.hstack([points[first:last], unknowns])
        close = close_points(table.get("close", []), own, f"{here}.close")
        found.append(Fibre(cut, dimension, own, close))
        first = last
    if found and first != len(points):
        raise wrong(place, "one cut for each of the points")
    return tuple(found)


def _component(value: Any, system: PolynomialSystem, cuts: Sequence[Cut], place: str) -> WitnessSet:
    table = as_table(value, place)

    def get(key: str, convert: Any, *arguments: Any) -> Any:
        return convert(entry(table, key, place), *arguments, f"{place}.{key}")

    cut = get("slice", as_table)
    b = as_vector(entry(cut, "b", f"{place}.slice"), f"{place}.slice.b")
    a = as_matrix(entry(cut, "A", f"{place}.slice"), system.n, f"{place}.slice.A")
    points = get("points", as_matrix, system.n)
    if len(a) != len(b) or get("dimension", as_count) != len(b):
        raise wrong(f"{place}.dimension", "the number of rows of the slice's A and b")
    if not (np.isfinite(a).all() and np.isfinite(b).all() and a.any(axis=1).all()):
        raise wrong(f"{place}.slice", "of equations with finite coefficients, not all of them 0")
    if get("degree", as_count) != len(points):
        raise wrong(f"{place}.degree", "the number of points")
    status = get("status", as_text)
    if status not in set(Status):
        raise wrong(f"{place}.status", " or ".join(Status))
    multidegree = None
    if "multidegree" in table:
        multidegree = get("multidegree", _multidegree, len(system.groups), len(b))
    radii, digits = _errors(table, points, place)
    orbit = get("orbit", as_table)
    size = as_count(entry(orbit, "size", f"{place}.orbit"), f"{place}.orbit.size", 1)
    return WitnessSet(
        slice=Slice(a, b),
        points=points,
        multiplicity=get("multiplicity", as_count),
        status=Status(status),
        residual=get("residual", as_double),
        radii=radii,
        digits=digits,
        corank=get("corank", as_count),
        multidegree=multidegree,
        orbit=size,
        note=get("note", as_text),
        images=_images(orbit.get("images", []), size, system, f"{place}.orbit.images"),
        fibres=_fibres(table.get("cut_by", []), cuts, points, len(b), f"{place}.cut_by"),
    )


def _errors(table: dict[str, Any], points: np.ndarray, place: str) -> tuple[np.ndarray, list[int]]:
    """Error radii and digits of points; those of files without them from the set's accuracy."""
    if "radii" not in table:
        accuracy = as_double(entry(table, "accuracy", place), f"{place}.accuracy")
        radii = np.nan_to_num(even_radii(points, accuracy), nan=np.inf, posinf=np.inf)
        return radii, [DOUBLE] * len(points)
    here, rows = f"{place}.radii", []
    for i, row in enumerate(as_list(table["radii"], here)):
        values = enumerate(as_list(row, f"{here}[{i}]"))
        rows.append([as_double(value, f"{here}[{i}][{j}]") for j, value in values])
    if [len(row) for row in rows] != [points.shape[1]] * len(points):
        raise wrong(here, "as many numbers as the points have, in as many rows")
    here = f"{place}.digits"
    items = enumerate(as_list(entry(table, "digits", place), here))
    digits = [as_count(value, f"{here}[{i}]", 1) for i, value in items]
    if len(digits) != len(points):
        raise wrong(here, "one number for each of the points")
    if max(digits, default=0) > np.iinfo(np.int64).max:
        raise wrong(here, "numbers of at most 64 bits")
    radii = np.array(rows, dtype=float).reshape(points.shape)
    radii[np.isnan(radii)] = np.inf
    if (radii < 0).any():
        raise wrong(f"{place}.radii", "numbers from 0 up")
    return radii, digits


def _images(
    value: Any, size: int, system: PolynomialSystem, place: str
) -> tuple[SignedPermutation, ...]:
    found = []
    for i, item in enumerate(as_list(value, place)):
        table = as_table(item, f"{place}[{i}]")
        texts = {key: as_text(text, f"{place}[{i}].{key}") for key, text in table.items()}
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
    table = as_document(value, FORMAT, VERSION, 1)

    def get(key: str, convert: Any) -> Any:
        return convert(entry(table, key, "the file"), key)

    system = get("system", as_system)
    paths = get("paths", as_table)
    order = [as_count(v, f"order[{i}]") for i, v in enumerate(get("order", as_list))]
    parts = as_list(table.get("equations", []), "equations")
    cuts = [_cut(v, system, f"equations[{i}]") for i, v in enumerate(parts)]
    components = [
        _component(v, system, cuts, f"components[{i}]")
        for i, v in enumerate(get("components", as_list))
    ]
    decomposition = Decomposition(
        system=system,
        components=tuple(components),
        paths=PathCounts(
            *(as_count(entry(paths, k, "paths"), f"paths.{k}") for k in PathCounts.__match_args__)
        ),
        seed=get("seed", as_count),
        settings=get("settings", as_text),
        order=tuple(order),
        complete=get("complete", as_flag),
        notes=tuple(get("notes", as_texts)),
        method=as_text(table.get("method", ""), "method"),
    )
    if table.get("case") is None:
        return Export(decomposition)
    case = as_table(table["case"], "case")
    known = {
        key: as_text(entry(case, key, "case"), f"case.{key}") for key in ("title", "file", "kind")
    }
    model = {k: table[k] for k in ("formulation", "reason") if table.get(k) is not None}
    return Export(decomposition, Origin(**known, **{k: as_text(v, k) for k, v in model.items()}))


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


# Relative difference of a point's coordinates from the same in more digits.
ROUNDED = 1e-12


def close_document(fine: Mapping[int, Fine]) -> list[dict[str, Any]]:
    """The points of a fibre that are close to others, by their indices in it."""
    return [
        {
            "point": i,
            "coordinates": fine[i].words.tolist(),
            "curvature": real_or_null(fine[i].curvature),
        }
        for i in sorted(fine)
    ]


def close_points(value: Any, points: np.ndarray, place: str) -> dict[int, Fine]:
    """What `close_document` wrote of points of shape ``(P, n + aux)``.

    Raises:
        nag.files.json_values.ExportError: if it does not fit them.
    """
    found: dict[int, Fine] = {}
    for k, item in enumerate(as_list(value, place)):
        here = f"{place}[{k}]"
        table = as_table(item, here)
        i = as_count(entry(table, "point", here), f"{here}.point")
        if i >= len(points) or i in found:
            raise wrong(f"{here}.point", "the index of a point, once")
        words = _words(entry(table, "coordinates", here), points.shape[1], f"{here}.coordinates")
        curvature = as_double(entry(table, "curvature", here), f"{here}.curvature")
        found[i] = Fine(words, curvature if np.isfinite(curvature) else np.inf)
        if not np.allclose(found[i].rounded, points[i], rtol=ROUNDED, atol=1e-300):
            raise wrong(f"{here}.coordinates", "those of the point in more digits")
    return found


def _words(value: Any, count: int, place: str) -> np.ndarray:
    rows = [
        [
            [as_double(x, f"{place}[{j}]") for x in as_list(part, f"{place}[{j}]")]
            for part in as_list(parts, f"{place}[{j}]")
        ]
        for j, parts in enumerate(as_list(value, place))
    ]
    shapes = [[len(part) for part in parts] for parts in rows]
    if shapes != [[WORDS, WORDS]] * count:
        raise wrong(
            place, f"{WORDS} numbers for the real and the imaginary part of each of {count}"
        )
    return np.array(rows, dtype=float).reshape(count, 2, WORDS)
