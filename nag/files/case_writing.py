"""Case files of what they describe; `nag.read` gives back what is written, equal."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from nag.algebra.given import check_one_line, value_text
from nag.algebra.number import ComplexNumber, Number, is_zero, number_text
from nag.algebra.system import PolynomialSystem
from nag.errors import NagError
from nag.files.case_table import CaseError, parse_toml, with_values
from nag.files.cases import Case, case_of_text, parameter_table
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.dh import DHLoop, HalfAngle, check_open
from nag.mechanism.framework import Framework
from nag.mechanism.graph import Mechanism, is_equations
from nag.mechanism.linkage import Linkage
from nag.mechanism.model import Model
from nag.mechanism.problem import Problem, problem_of

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def case_of(given: Any) -> Case:
    """The case itself, or that of a mechanism, a model, parts, a problem or equations.

    Raises:
        NagError: if a case file cannot say it; one line says what.
    """
    if isinstance(given, Case):
        return given
    described = problem_of(given) if is_equations(given) else given
    file = Path("case.toml")
    text = case_text(described)
    try:
        return case_of_text(file, text)
    except CaseError as error:
        # There is no such file.
        raise NagError(f"given: {str(error).removeprefix(f'{file}: ')}") from None


def case_text(given: Any, title: str = "") -> str:
    """The case file of a case, a mechanism, a model, parts, a problem or a system.

    Of a case that was read and not changed it is that file's text. Of a model it is its mechanism,
    from which it is chosen anew.

    Args:
        title: of the case; by default the one that it has, or what it is.

    Raises:
        NagError: if a case file cannot say it; one line says what.
    """
    check_one_line(title or getattr(given, "title", ""), "title")
    if isinstance(given, Case):
        own = _text_of_case(given, title)
        if own is not None:
            return own
        title = title or given.title
    tables = _tables_of(given)
    return _toml({"title": title or _title_of_kind(tables["kind"]), **tables})


def _title_of_kind(kind: str) -> str:
    """What a case of a kind describes, in words."""
    return {"system": "a polynomial system", "dh": "a loop of joints"}.get(kind, f"a {kind}")


def _text_of_case(case: Case, title: str) -> str | None:
    """The text of a case in TOML, with the values that were set and the title that is given.

    None of another format.
    """
    if case.format != "toml" or not case.text:
        return None
    values = parse_toml(case.path, case.text)
    if values["kind"] == "robot":
        # What its file says of the robot may not be there, where the case is written to.
        return None
    if not title and not case.set:
        return case.text
    if title:
        values["title"] = title
    if case.set:
        changed = with_values(parameter_table(case.path, values), case.set).values
        values["parameters"] = {name: _plain(value) for name, value in changed.items()}
        if not case.truth and case.truth_at_reference is None:
            # It is not known of other values.
            values.pop("truth", None)
    return _toml(values)


def _tables_of(given: Any) -> dict[str, Any]:
    """What a case says of something, but its title.

    Raises:
        NagError: if it cannot say it.
    """
    if isinstance(given, Case):
        # In TOML every parameter has a value.
        given.refuse_unset()
        parameters = {name: _plain(value) for name, value in given.parameters.items()}
        own = {"parameters": parameters} if parameters else {}
        return _tables_of(given.described) | own | _of_truth(given)
    if isinstance(given, Problem):
        if given.model is not None:
            return _tables_of(given.model)
        return _of_system(given.system) | _of_problem(given)
    if isinstance(given, Model):
        if given.modes:
            raise NagError("result: a model of other assembly modes; a case has the reference's")
        return _of_mechanism(given.mechanism)
    if isinstance(given, AssemblyModel):
        part = next((getattr(given, n, None) for n in _PARTS if hasattr(given, n)), None)
        return _tables_of(part)
    for kind, tables in _TABLES.items():
        if isinstance(given, kind):
            return tables(given)
    raise NagError(f"result: {value_text(given)} is given; it is nothing that a case describes")


def _of_truth(case: Case) -> dict[str, Any]:
    """What a case says is known."""
    plain = [
        {k: v for k, v in vars(t).items() if v is not None and (k != "source" or v)}
        for t in case.truth
    ]
    at_reference = case.truth_at_reference
    reference = {} if at_reference is None else {"reference": vars(at_reference)}
    known = {**({"component": plain} if plain else {}), **reference}
    return {"truth": known} if known else {}


def _of_system(system: PolynomialSystem) -> dict[str, Any]:
    for name in ("nonzero", "isotropic"):
        if getattr(system, name):
            raise NagError(
                f"result: a case file cannot say what is {name}; give the name of a text, a.txt"
            )
    own = system.own_variables
    groups = [[own[i] for i in group] for group in system.own_groups]
    return {
        "kind": "system",
        "variables": list(own),
        "equations": system.text()[: len(system.polynomials) - system.imaginary],
        **({"imaginary": system.variables[-1]} if system.imaginary else {}),
        **({"groups": groups} if groups else {}),
    }


def _of_problem(given: Problem) -> dict[str, Any]:
    own = given.system.own_variables
    symmetries = [g.text(given.system.variables) for g in given.symmetries]
    points = [
        {"name": p.name, "at": {n: _plain(x) for n, x in zip(own, p.at, strict=False)}}
        for p in given.points
    ]
    return {
        **(
            {"symmetry": [{"map": images} for images in symmetries if images]} if symmetries else {}
        ),
        **({"point": points} if points else {}),
    }


def _of_mechanism(mechanism: Mechanism) -> dict[str, Any]:
    joints = []
    for joint in mechanism.joints:
        known = {"name": joint.name, "type": joint.type, "bodies": list(joint.bodies)}
        vectors = {key: getattr(joint, key) for key in ("point", "axis", "second_axis")}
        if "point" not in joint.of_type.fields and all(map(is_zero, joint.point)):
            del vectors["point"]
        joints.append(known | {k: _vector(v) for k, v in vectors.items() if v is not None})
    bodies = [
        {"name": body.name}
        | ({} if body.orientation is None else {"orientation": _vector(body.orientation)})
        for body in mechanism.bodies
    ]
    tables: dict[str, Any] = {"kind": "mechanism", "ground": mechanism.ground, "joint": joints}
    return tables | ({"body": bodies} if bodies else {})


def _of_linkage(linkage: Linkage) -> dict[str, Any]:
    links = [
        {"name": link.name, "pins": list(link.pins), "shape": [_vector(p) for p in link.shape]}
        for link in linkage.links
    ]
    return {"kind": "linkage", "ground": linkage.ground, "link": links}


def _of_framework(framework: Framework) -> dict[str, Any]:
    tables: dict[str, Any] = {"kind": "framework", "dimension": framework.dimension}
    bars = {"bars": [list(bar) for bar in framework.bars]}
    if framework.placement is None:
        squared = {"squared_lengths": _vector(framework.squared_lengths)}
        return tables | {"points": list(framework.points)} | bars | squared
    places = zip(framework.points, framework.placement, strict=True)
    return tables | bars | {"points": {name: _vector(place) for name, place in places}}


def _of_table(loop: DHLoop) -> dict[str, Any]:
    if loop.open:
        check_open(loop)
    rows = []
    for row in loop.rows:
        known = {"name": row.name, "a": _plain(row.a), "d": _plain(row.d)}
        angles = {"alpha": row.alpha, "theta": row.theta}
        halves = [_half(name, half) for name, half in angles.items() if half is not None]
        rows.append(known | dict(halves))
    return {"kind": "dh", "joint": rows}


def _half(name: str, half: HalfAngle) -> tuple[str, str]:
    cosine, sine = half
    if is_zero(cosine):
        return name, "pi"
    return (name, "0") if is_zero(sine) else (f"{name}_half_tangent", number_text(sine))


# What parts a model of assemblies is of.
_PARTS = ("linkage", "framework", "loop")
_TABLES: Mapping[type, Any] = {
    PolynomialSystem: _of_system,
    Mechanism: _of_mechanism,
    Linkage: _of_linkage,
    Framework: _of_framework,
    DHLoop: _of_table,
}


def _vector(values: Sequence[Number]) -> list[Any]:
    return [_plain(x) for x in values]


def _plain(value: Any) -> Any:
    """A number as a case has it: a small whole number, or a text."""
    if isinstance(value, str | Decimal):
        return value
    if isinstance(value, ComplexNumber):
        return str(value)
    text = number_text(value)
    return int(text) if re.fullmatch(r"-?[0-9]{1,15}", text) else text


def _toml(tables: Mapping[str, Any]) -> str:
    """A file in TOML: what is no table first."""
    lines = [f"{_key(k)} = {_value(v)}" for k, v in tables.items() if not _is_table(v)]
    for key, value in tables.items():
        if isinstance(value, Mapping):
            lines += ["", f"[{_key(key)}]", *(f"{_key(k)} = {_value(v)}" for k, v in value.items())]
        elif _is_table(value):
            for each in value:
                own = (f"{_key(k)} = {_value(v)}" for k, v in each.items())
                lines += ["", f"[[{_key(key)}]]", *own]
    return "\n".join(lines) + "\n"


def _is_table(value: Any) -> bool:
    """Whether it is written as a table, or as several."""
    several = isinstance(value, list) and bool(value)
    return isinstance(value, Mapping) or (several and all(isinstance(v, Mapping) for v in value))


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        inside = ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items())
        return f"{{ {inside} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    return str(value) if isinstance(value, int | Decimal) else json.dumps(value, ensure_ascii=False)
