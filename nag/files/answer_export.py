"""Answers of questions as JSON, as the commands write them with ``--json``.

Components, solutions and points have exports that are read back (`export`, `solutions_export`,
`points_export`). Of other answers `nag.read` gives the JSON object itself. What a command knows
besides, its case, seed and settings, is null where an answer is written in Python.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

from nag.algebra.given import is_a
from nag.algebra.number import number_text
from nag.files.json_schema import schema
from nag.files.written_file import write_target
from nag.text.json_text import lay_out, pairs

Fields = dict[str, Any]


def _mobility_fields(report: Any) -> Fields:
    nothing = {"budget": None, "configuration": [], "known": None, "check": None}
    return nothing | report.document()


def _local_fields(found: Any) -> Fields:
    at = [number_text(x if x.imag else x.real) for x in found.point.tolist()]
    return {"variables": list(found.names), "points": [{"name": "", "at": at, **found.document()}]}


def _member_fields(found: Any) -> Fields:
    return {"variables": list(found.variables), **found.document()}


def _family_fields(found: Any) -> Fields:
    return {"notes": list(found.start.notes), **found.document()}


def _sweep_fields(found: Any) -> Fields:
    return {"notes": [], **found.document()}


def _modes_fields(found: Any) -> Fields:
    """What the document says of the modes, their witness sets with it."""
    system = found.decomposition.system
    points = [
        {
            "slice": {"A": pairs(mode.component.slice.A), "b": pairs(mode.component.slice.b)},
            "points": pairs(mode.component.points),
        }
        for mode in found.modes
    ]
    return {
        **found.document(),
        "paths": asdict(found.decomposition.paths),
        "system": {"variables": list(system.variables), "polynomials": system.text()},
        "witness": points,
    }


def _motion_fields(found: Any) -> Fields:
    return {"formulation": None, "samples": None, **found.document()}


def _own_fields(found: Any) -> Fields:
    return dict(found.document())


# Where each class is, the format of its documents, and what these say below their head.
DOCUMENTS: Mapping[tuple[str, str], tuple[str, Callable[[Any], Fields]]] = {
    ("nag.mechanism.mobility_report", "MobilityReport"): ("nag-mobility", _mobility_fields),
    ("nag.numerics.local_dimension", "LocalDimension"): ("nag-local-dimension", _local_fields),
    ("nag.witness.membership", "PointMembership"): ("nag-membership", _member_fields),
    ("nag.solving.family_members", "FamilySolutions"): ("nag-family", _family_fields),
    ("nag.decomposition.sweep", "Sweep"): ("nag-sweep", _sweep_fields),
    ("nag.mechanism.modes_report", "OperationModes"): ("nag-operation-modes", _modes_fields),
    ("nag.mechanism.mode_decomposition", "ModesAnswer"): ("nag-modes", _own_fields),
    ("nag.interpolation.image_ideal", "ImageIdeal"): ("nag-elimination", _own_fields),
    ("nag.kinematics.motion", "Motion"): ("nag-motion", _motion_fields),
    ("nag.kinematics.driven_motion", "DrivenMotion"): ("nag-driven-motion", _motion_fields),
    ("nag.check.statement", "CheckedStatements"): ("nag-statements", _own_fields),
    ("nag.questions", "Certified"): ("nag-certificate", _own_fields),
    ("nag.real.curve", "RealCurve"): ("nag-real-curve", _own_fields),
}


def is_answer(result: Any) -> bool:
    """Whether something has a document that is not read back as what it is."""
    return any(is_a(result, *kind) for kind in DOCUMENTS)


def fields_of(result: Any) -> Fields:
    """The format of an answer's document, and what it says below its head."""
    name, fields = next(DOCUMENTS[kind] for kind in DOCUMENTS if is_a(result, *kind))
    return {"format": name, **fields(result)}


def answer_document(result: Any) -> dict[str, Any]:
    """The document of an answer whose case, seed and settings are not known."""
    complete: Any = result.complete
    whole = complete if isinstance(complete, bool) else bool(complete.all())
    fields = fields_of(result)
    head = {"format": fields["format"], "version": 1, "case": None, "seed": None, "settings": None}
    head["complete"] = whole
    # Not all formats have all of these.
    published = schema(fields["format"])["properties"]
    return {name: value for name, value in head.items() if name in published} | fields


def write_answer(result: Any, path: str | os.PathLike[str]) -> None:
    """Write the document of an answer to ``path`` in one step.

    Raises:
        nag.files.written_file.TargetError: if the file cannot be written.
    """
    write_target(path, lay_out(answer_document(result)) + "\n")
