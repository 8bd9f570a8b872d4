"""Cases of the equations that an export of components or solutions answers."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from nag.files import export, solutions_export
from nag.files.cases import Case
from nag.files.json_values import ExportError, read_file
from nag.mechanism.problem import problem_of

# Formats of exports that have their equations.
WITH_EQUATIONS = (export.FORMAT, solutions_export.FORMAT)


def case_of_export(path: str | os.PathLike[str]) -> Case:
    """The equations that an export answers, with the symmetries that its components show.

    Of a mechanism it has those of the model that was asked about, and no mechanism.

    Raises:
        nag.InputError: if it cannot be read, or is an export of something else.
    """
    return read_file(path, lambda value: _case_of_document(Path(path), value))


def _case_of_document(path: Path, value: Any) -> Case:
    name = value.get("format") if isinstance(value, dict) else None
    if name == export.FORMAT:
        components = export.export_of(value)
        asked = problem_of(components.decomposition)
        title = None if components.origin is None else components.origin.title
    elif name == solutions_export.FORMAT:
        solutions = solutions_export.solutions_of(value)
        asked, title = problem_of(solutions.result), solutions.title
    else:
        raise ExportError("has no equations; give a case, or an export of components or solutions")
    return Case(
        title=title or path.stem,
        kind="system",
        path=path,
        parameters={},
        system=asked.system,
        symmetries=asked.symmetries,
        format="export",
    )
