"""Solutions as JSON: written, and read back to equal objects.

The format is ``nag-solutions``, version 1; its JSON Schema is in ``schema/`` beside this module.
A file holds nothing that differs between runs with the same seed.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, fields
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem
from nag.report.json_values import (
    ExportError,
    as_count,
    as_double,
    as_flag,
    as_list,
    as_matrix,
    as_table,
    as_text,
    as_texts,
    as_vector,
    entry,
    wrong,
)
from nag.report.target import write_target
from nag.tracking.solutions import PathStatistics, Solution, SolveResult

FORMAT = "nag-solutions"
VERSION = 1
LARGEST_FILE = 256 * 1024**2


@dataclass(frozen=True)
class SolutionsExport:
    """What a file holds: the result, and the title and file of the case it came from."""

    result: SolveResult
    title: str | None = None
    file: str | None = None


def schema() -> dict[str, Any]:
    """The JSON Schema of the format."""
    name = f"{FORMAT}-{VERSION}.json"
    return json.loads((resources.files("nag.report") / "schema" / name).read_text("utf-8"))


def _real(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _pairs(array: np.ndarray) -> list[Any]:
    return [
        [[_real(z.real), _real(z.imag)] for z in row]
        if np.ndim(row)
        else [_real(row.real), _real(row.imag)]
        for row in array
    ]


def _solution_document(solution: Solution) -> dict[str, Any]:
    return {
        "point": _pairs(solution.point),
        "multiplicity": solution.multiplicity,
        "real": solution.real,
        "residual": _real(solution.residual),
        "accuracy": _real(solution.accuracy),
        "condition": _real(solution.condition),
        "precision": solution.precision,
    }


def document(
    result: SolveResult, title: str | None = None, file: str | None = None
) -> dict[str, Any]:
    """The export as a JSON object (dicts, lists, strings, numbers, None)."""
    system = result.system
    return {
        "format": FORMAT,
        "version": VERSION,
        "case": None if title is None else {"title": title, "file": file or ""},
        "seed": result.seed,
        "settings": result.settings,
        "start": result.start,
        "reason": result.reason,
        "complete": result.complete,
        "notes": list(result.notes),
        "paths": {f.name: int(getattr(result.paths, f.name)) for f in fields(PathStatistics)},
        "system": {
            "variables": list(system.variables),
            "polynomials": system.text(),
            "nonzero": [f.text(system.variables) for f in system.nonzero],
            "groups": [[system.variables[i] for i in group] for group in system.groups],
            "exact": system.exact,
        },
        "solutions": [_solution_document(s) for s in result.solutions],
        "excluded": result.excluded,
        "on_components": _pairs(result.on_components),
        "undecided": _pairs(result.undecided),
    }


def _lay_out(value: Any, indent: str = "") -> str:
    """JSON text with one line for each key, and one for each point."""
    deeper = indent + "  "
    if isinstance(value, dict) and value:
        parts = [f"{json.dumps(k)}: {_lay_out(v, deeper)}" for k, v in value.items()]
        left, right = "{}"
    elif isinstance(value, list) and any(
        isinstance(v, str | dict) or (isinstance(v, list) and v and isinstance(v[0], list))
        for v in value
    ):
        parts = [_lay_out(v, deeper) for v in value]
        left, right = "[]"
    else:
        return json.dumps(value, allow_nan=False)
    return f"{left}\n{deeper}" + f",\n{deeper}".join(parts) + f"\n{indent}{right}"


def export_text(result: SolveResult, title: str | None = None, file: str | None = None) -> str:
    """The export as JSON text, ASCII, the same for equal arguments."""
    return _lay_out(document(result, title, file)) + "\n"


def write_solutions(
    result: SolveResult,
    path: str | os.PathLike[str],
    title: str | None = None,
    file: str | None = None,
) -> None:
    """Write the export to ``path`` in one step.

    Raises:
        nag.report.target.TargetError: if the file cannot be written.
    """
    write_target(path, export_text(result, title, file))


def _system(value: Any, place: str) -> PolynomialSystem:
    table = as_table(value, place)
    variables = as_texts(entry(table, "variables", place), f"{place}.variables")
    parts = {}
    for key in ("polynomials", "nonzero"):
        parts[key] = []
        for i, text in enumerate(as_texts(table.get(key, []), f"{place}.{key}")):
            try:
                parts[key].append(parse_polynomial(text, variables))
            except ValueError as error:
                raise ExportError(f"{place}.{key}[{i}]: {error}") from None
    groups = []
    for i, names in enumerate(as_list(table.get("groups", []), f"{place}.groups")):
        here = f"{place}.groups[{i}]"
        if unknown := [name for name in as_texts(names, here) if name not in variables]:
            raise ExportError(f"{here}: {unknown[0]!r} is not one of the variables")
        groups.append([variables.index(name) for name in names])
    try:
        return PolynomialSystem(variables, parts["polynomials"], parts["nonzero"], groups)
    except ValueError as error:
        raise ExportError(f"{place}: {error}") from None


def _solution(value: Any, n: int, place: str) -> Solution:
    table = as_table(value, place)

    def get(key: str, convert: Any, *arguments: Any) -> Any:
        return convert(entry(table, key, place), f"{place}.{key}", *arguments)

    point = get("point", as_vector)
    if len(point) != n:
        raise wrong(f"{place}.point", f"of length {n}, one entry for each variable")
    return Solution(
        point=point,
        multiplicity=get("multiplicity", as_count, 1),
        real=get("real", as_flag),
        residual=get("residual", as_double),
        accuracy=get("accuracy", as_double),
        condition=get("condition", as_double),
        precision=get("precision", as_count, 1),
    )


def _export(value: Any) -> SolutionsExport:
    table = as_table(value, "the file")
    if table.get("format") != FORMAT:
        raise wrong("format", f'"{FORMAT}"')
    if table.get("version") != VERSION:
        raise wrong("version", f"{VERSION}, the version that this program reads")

    def get(key: str, convert: Any) -> Any:
        return convert(entry(table, key, "the file"), key)

    system = get("system", _system)
    paths = get("paths", as_table)
    points = {}
    for key in ("on_components", "undecided"):
        points[key] = as_matrix(entry(table, key, "the file"), system.n, key)
    result = SolveResult(
        system=system,
        solutions=tuple(
            _solution(v, system.n, f"solutions[{i}]")
            for i, v in enumerate(get("solutions", as_list))
        ),
        excluded=get("excluded", as_count),
        paths=PathStatistics(
            *(
                as_count(entry(paths, f.name, "paths"), f"paths.{f.name}")
                for f in fields(PathStatistics)
            )
        ),
        start=get("start", as_text),
        reason=get("reason", as_text),
        seed=get("seed", as_count),
        settings=get("settings", as_text),
        complete=get("complete", as_flag),
        notes=tuple(get("notes", as_texts)),
        **points,
    )
    if table.get("case") is None:
        return SolutionsExport(result)
    case = as_table(table["case"], "case")
    title, file = (as_text(entry(case, key, "case"), f"case.{key}") for key in ("title", "file"))
    return SolutionsExport(result, title, file)


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} is not a JSON number")


def read_solutions(path: str | os.PathLike[str]) -> SolutionsExport:
    """Read a file that `write_solutions` wrote.

    Raises:
        ExportError: if the file cannot be read or is not an export.
    """
    file = Path(path)
    try:
        if not file.is_file():
            raise ExportError("is not a file" if file.exists() else "there is no such file")
        if file.stat().st_size > LARGEST_FILE:
            raise ExportError(f"is larger than {LARGEST_FILE // 1024**2} MB")
        return _export(json.loads(file.read_bytes(), parse_constant=_refuse_constant))
    except ExportError as error:
        raise ExportError(f"{file}: {error}") from None
    except OSError as error:
        raise ExportError(f"{file}: cannot be read: {error.strerror or error}") from None
    except RecursionError:
        raise ExportError(f"{file}: is not an export: lists are nested too deep") from None
    except ValueError as error:
        raise ExportError(f"{file}: is not JSON: {error}") from None
