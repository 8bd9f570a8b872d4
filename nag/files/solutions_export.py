"""Solutions as JSON: written, and read back to equal objects.

The format is ``nag-solutions``, version 1; its JSON Schema is in ``schema/`` beside this module.
A file holds nothing that differs between runs with the same seed.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any

from nag.algebra.given import check_path, check_type
from nag.algebra.system import PolynomialSystem
from nag.files.json_values import (
    check_imaginary_unit,
    checked_document,
    complex_matrix,
    complex_vector,
    parse_system,
    read_file,
    real_number,
    wrong,
)
from nag.files.written_file import write_target
from nag.solving.solutions import FORMAT, VERSION, PathStatistics, Solution, SolveResult
from nag.text.json_text import lay_out_parts


@dataclass(frozen=True)
class SolutionsExport:
    """What a file holds: the result, and the title and file of the case it came from."""

    result: SolveResult
    title: str | None = None
    file: str | None = None


def export_text(result: SolveResult, title: str | None = None, file: str | None = None) -> str:
    """The export as JSON text, ASCII, the same for equal arguments."""
    return "".join(_export_parts(result, title, file))


def _export_parts(result: SolveResult, title: str | None, file: str | None) -> Iterator[str]:
    yield from lay_out_parts(result.document_to_write(title, file))
    yield "\n"


def write_solutions(
    result: SolveResult,
    path: str | os.PathLike[str],
    title: str | None = None,
    file: str | None = None,
) -> None:
    """Write the export to ``path`` in one step.

    Args:
        title: of the case that was solved.
        file: name of its file.

    Raises:
        nag.files.written_file.TargetError: if the file cannot be written.
        ValueError: if something else is given.

    >>> import json, nag, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write_solutions(nag.solve("x^2 = 2"), f"{folder}/roots.json")
    ...     with open(f"{folder}/roots.json") as written:
    ...         json.load(written)["format"]
    'nag-solutions'
    """
    check_type(result, SolveResult, "result", "what nag.solve returns")
    check_path(path)
    for name, text in (("title", title), ("file", file)):
        if text is not None:
            check_type(text, str, name, "a text, or leave it out")
    write_target(path, _export_parts(result, title, file))


def _solution(table: dict[str, Any], system: PolynomialSystem, place: str) -> Solution:
    point = complex_vector(table["point"])
    if len(point) != system.n:
        raise wrong(f"{place}.point", f"of length {system.n}, one entry for each variable")
    check_imaginary_unit(point, system.imaginary, f"{place}.point")
    numbers = {key: real_number(table[key]) for key in ("residual", "accuracy", "condition")}
    facts = {key: table[key] for key in ("multiplicity", "real", "precision")}
    return Solution(point=point, **facts, **numbers)


def solutions_of(value: Any) -> SolutionsExport:
    """What a document of the format holds.

    Raises:
        ExportError: if it is not one.
    """
    table = checked_document(value, FORMAT, VERSION)
    system = parse_system(table["system"], "system")

    def get_solutions(key: str) -> tuple[Solution, ...]:
        # Earlier files do not have all of them.
        return tuple(_solution(v, system, f"{key}[{i}]") for i, v in enumerate(table.get(key, [])))

    result = SolveResult(
        system=system,
        solutions=get_solutions("solutions"),
        excluded=table["excluded"],
        paths=PathStatistics(*(table["paths"][f.name] for f in fields(PathStatistics))),
        method=table.get("method", ""),
        start=table["start"],
        reason=table["reason"],
        seed=table["seed"],
        settings=table["settings"],
        complete=table["complete"],
        notes=tuple(table["notes"]),
        excluded_solutions=get_solutions("excluded_solutions"),
        **{
            key: complex_matrix(table.get(key, []), system.n, key)
            for key in ("on_components", "on_excluded", "on_doubtful", "undecided")
        },
    )
    case = table["case"]
    if case is None:
        return SolutionsExport(result)
    return SolutionsExport(result, case["title"], case["file"])


def read_solutions(path: str | os.PathLike[str]) -> SolutionsExport:
    """Read a file that `write_solutions` wrote.

    Returns:
        The result, its points the same doubles, with the title and the file of its case.

    Raises:
        ExportError: if the file cannot be read or is not an export.

    >>> import nag, tempfile
    >>> roots = nag.solve("x^2 = 2")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     nag.write_solutions(roots, f"{folder}/roots.json")
    ...     again = nag.read_solutions(f"{folder}/roots.json").result
    >>> bool((again.points == roots.points).all())
    True
    """
    return read_file(path, solutions_of)
