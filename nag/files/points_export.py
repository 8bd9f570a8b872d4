"""Points of components as JSON, read back to equal objects: samples, and singular points.

The formats are ``nag-samples``, ``nag-singular`` and ``nag-singular-parameters``, version 1, as
``nag sample`` and ``nag singular`` write them with ``--json``; their JSON Schemas are in
``schema/`` beside this module.
"""

from __future__ import annotations

import os
import re
from fractions import Fraction
from typing import Any, TypeAlias

from nag.decomposition import singular_members, singular_points
from nag.decomposition.singular_members import ParameterSet, SingularParameters
from nag.decomposition.singular_points import SingularLocus, SingularSet
from nag.files.json_values import (
    ExportError,
    checked_document,
    complex_matrix,
    complex_vector,
    parse_polynomials,
    real_number,
    wrong,
)
from nag.files.written_file import write_target
from nag.numerics.local_dimension import LocalDimension
from nag.numerics.tangent_cone import Form, TangentCone
from nag.text.json_text import lay_out
from nag.witness import sampling
from nag.witness.sampling import Samples
from nag.witness.witness import PathCounts

# Without exponents: 1e999999999 would fill the memory.
_RATIONAL = re.compile(r"-?[0-9]+(/[0-9]+)?")
Points: TypeAlias = Samples | SingularLocus | SingularParameters


def write_points(result: Points, path: str | os.PathLike[str]) -> None:
    """Write samples or singular points to ``path`` in one step.

    Raises:
        nag.files.written_file.TargetError: if the file cannot be written.
    """
    name = next(name for name, (kind, _) in FORMATS.items() if isinstance(result, kind))
    head = {"format": name, "version": 1, "case": None, "seed": None, "settings": None}
    document = head | {"complete": result.complete} | result.document()
    write_target(path, lay_out(document) + "\n")


def points_of(value: Any) -> Points:
    """What a document of one of `FORMATS` holds.

    Raises:
        ExportError: if it is not one.
    """
    name = value["format"]
    return FORMATS[name][1](checked_document(value, name, 1))


def _samples(table: dict[str, Any]) -> Samples:
    own, unit = _own_variables(table)
    known = table["real_dimensions"]
    points = complex_matrix(table["points"], len(table["variables"]), "points")
    if known and len(known) != len(points):
        raise wrong("real_dimensions", f"of length {len(points)}, one entry for each point")
    return Samples(
        points=points,
        residual=real_number(table["residual"]),
        accuracy=real_number(table["accuracy"]),
        doubt=table["doubt"],
        variables=own,
        real=known is not None,
        real_dimensions=tuple(-1 if d is None else d for d in known or ()),
        unit=unit,
    )


def _own_variables(table: dict[str, Any]) -> tuple[tuple[str, ...], str]:
    """The variables without the imaginary unit, and this, empty if there is none."""
    variables, unit = table["variables"], table["imaginary"]
    if unit is None:
        return tuple(variables), ""
    if [unit] != variables[-1:]:
        raise ExportError(f"imaginary: {unit!r} is not the last variable")
    return tuple(variables[:-1]), unit


def _locus(table: dict[str, Any]) -> SingularLocus:
    own, unit = _own_variables(table)
    names, notes = table["variables"], tuple(table["notes"])
    sets = [_set(one, names, unit, f"sets[{i}]") for i, one in enumerate(table["sets"])]
    return SingularLocus(
        sets=tuple(sets),
        examined=tuple(k - 1 for k in table["examined"]),
        paths=PathCounts(**table["paths"]),
        complete=not notes,
        notes=notes,
        proved=tuple(k - 1 for k in table["proved"]),
        variables=own,
        unit=unit,
    )


def _set(table: dict[str, Any], names: list[str], unit: str, place: str) -> SingularSet:
    cone = table["tangent_cone"]
    return SingularSet(
        dimension=table["dimension"],
        degree=table["degree"],
        points=complex_matrix(table["points"], len(names), f"{place}.points"),
        multiplicities={
            one["component"] - 1: one["multiplicity"] or None for one in table["multiplicities"]
        },
        local=_local(table["local"], len(names), bool(unit), f"{place}.local"),
        cone=None if cone is None else _cone(cone, names, f"{place}.tangent_cone"),
        imaginary=bool(unit),
    )


def _local(table: dict[str, Any], n: int, imaginary: bool, place: str) -> LocalDimension:
    point = complex_vector(table["point"])
    if len(point) != n:
        raise wrong(f"{place}.point", f"of length {n}, one entry for each variable")
    names = ("tangent_dimension", "lower", "upper", "multiplicity", "hyperplanes")
    return LocalDimension(
        point=point,
        **{name: table[name] for name in (*names, "arithmetic", "reason")},
        coranks=tuple(table["coranks"]),
        digits=tuple((real, imag) for real, imag in table["sharpened"]),
        imaginary=imaginary,
    )


def _cone(table: dict[str, Any], names: list[str], place: str) -> TangentCone:
    for i, name in enumerate(table["coordinates"]):
        if name not in names:
            here = f"{place}.coordinates[{i}]"
            raise ExportError(f"{here}: {name!r} is not one of the variables")
    forms, linear = (
        tuple(_form(terms, len(names), f"{place}.{key}[{i}]") for i, terms in enumerate(table[key]))
        for key in ("form_terms", "linear_terms")
    )
    coordinates = tuple(map(names.index, table["coordinates"]))
    return TangentCone(coordinates, table["degree"], forms, linear, table["dimension"])


def _form(terms: list[dict[str, Any]], n: int, place: str) -> Form:
    form: dict[tuple[int, ...], Fraction | complex] = {}
    for i, term in enumerate(terms):
        exponents, number = tuple(term["exponents"]), term["coefficient"]
        if len(exponents) != n:
            raise wrong(f"{place}[{i}].exponents", f"of length {n}, one entry for each variable")
        if isinstance(number, str):
            try:
                form[exponents] = Fraction(number if _RATIONAL.fullmatch(number) else "")
            except (ValueError, ZeroDivisionError):
                raise wrong(f"{place}[{i}].coefficient", "a rational number") from None
        else:
            form[exponents] = complex(*map(real_number, number))
    return form


def _parameters(table: dict[str, Any]) -> SingularParameters:
    names, conditions = table["parameters"], table["conditions"]
    if len(conditions) != len(table["sets"]):
        raise wrong("sets", f"of length {len(conditions)}, one entry for each condition")
    sets = tuple(
        ParameterSet(
            tuple(parse_polynomials(texts, names, f"conditions[{i}]")),
            **{key: one[key] for key in ("dimension", "degree", "proof")},
        )
        for i, (texts, one) in enumerate(zip(conditions, table["sets"], strict=True))
    )
    return SingularParameters(
        parameters=tuple(names),
        sets=sets,
        paths=PathCounts(**table["paths"]),
        complete=table["complete"],
        notes=tuple(table["notes"]),
        proved=table["proved"],
    )


# The class of each format, and what reads a document that fits its schema.
FORMATS = {
    sampling.FORMAT: (Samples, _samples),
    singular_points.FORMAT: (SingularLocus, _locus),
    singular_members.FORMAT: (SingularParameters, _parameters),
}
