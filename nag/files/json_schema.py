"""JSON documents checked by the JSON Schemas of their formats, which are in the folder ``schema``.

What the schemas are written in is a part of the language of 2020-12, and what is wrong is said in
one line, with its place and what must be there. (The library ``jsonschema`` takes 15 times as long
as reading a file does, and says neither.)
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Mapping
from functools import cache
from importlib import resources
from typing import Any

# What is wrong: where below the value, and what; None if nothing is.
Violation = tuple[str, str]
Check = Callable[[Any], Violation | None]

# Keywords that say nothing of values.
REMARKS = frozenset({"$schema", "$id", "$defs", "title", "description"})
# Of each type its name in a line, and what Python reads it as.
TYPES = {
    "null": ("null", type(None)),
    "boolean": ("true or false", bool),
    "integer": ("an integer", int),
    "number": ("a number", int, float),
    "string": ("a string", str),
    "array": ("a list", list),
    "object": ("an object", dict),
}


@cache
def schema(name: str, version: int = 1) -> dict[str, Any]:
    """The JSON Schema of a format, such as ``"nag-decomposition"``.

    >>> schema("nag-decomposition", 2)["properties"]["format"]["const"]
    'nag-decomposition'
    """
    file = resources.files("nag.files") / "schema" / f"{name}-{version}.json"
    return json.loads(file.read_text("utf-8"))


@cache
def published_versions(name: str) -> tuple[int, ...]:
    """The versions of a format that have a schema; none of a name that is no format's.

    >>> published_versions("nag-decomposition"), published_versions("svg")
    ((1, 2), ())
    """
    folder = resources.files("nag.files") / "schema"
    parts = (file.name.removesuffix(".json").rpartition("-") for file in folder.iterdir())
    return tuple(sorted(int(version) for own, _, version in parts if own == name))


def find_problem(value: Any, published: dict[str, Any]) -> Violation | None:
    """The first place where a document does not fit a schema, and what is wrong there.

    >>> find_problem({"seed": -1}, {"properties": {"seed": {"type": "integer", "minimum": 0}}})
    ('.seed', 'must be an integer, 0 or more')
    """
    return _check_of(published, published.get("$defs", {}), {})(value)


def _check_of(node: Mapping[str, Any], defs: Mapping[str, Any], made: dict[str, Check]) -> Check:
    """The check of a schema; ``made`` holds those of ``defs``, which may contain themselves.

    Raises:
        KeyError: for a keyword that is not known here.
    """
    checks: list[Check] = []
    rest = dict(node)
    for remark in REMARKS & rest.keys():
        del rest[remark]
    if "$ref" in rest:
        name = rest.pop("$ref").removeprefix("#/$defs/")
        if name not in made:
            made[name] = lambda value: made[name](value)
            made[name] = _check_of(defs[name], defs, made)
        checks.append(lambda value: made[name](value))
    if "const" in rest:
        checks.append(_one_of([rest.pop("const")]))
    if "enum" in rest:
        checks.append(_one_of(rest.pop("enum")))
    if "oneOf" in rest:
        checks.append(_alternatives([_check_of(n, defs, made) for n in rest.pop("oneOf")]))
    wanted = node.get("title")
    if "type" in rest:
        types = rest.pop("type")
        types = [types] if isinstance(types, str) else types
        least, most = rest.pop("minimum", None), rest.pop("maximum", None)
        checks.append(_of_type(types, least, most, wanted))
    if "minItems" in rest or "maxItems" in rest:
        length = _of_length(rest.pop("minItems", 0), rest.pop("maxItems", None), wanted)
        checks.append(_where(list, length))
    if rest.pop("uniqueItems", False):
        checks.append(_where(list, _distinct))
    if "items" in rest:
        checks.append(_where(list, _items(_check_of(rest.pop("items"), defs, made))))
    if "dependentRequired" in rest:
        checks.append(_where(dict, _together(rest.pop("dependentRequired"))))
    if rest.keys() & {"required", "properties", "additionalProperties"}:
        properties = rest.pop("properties", {})
        known = {key: _check_of(n, defs, made) for key, n in properties.items()}
        more = rest.pop("additionalProperties", True)
        other = None if more is True else _check_of(more, defs, made)
        checks.append(_where(dict, _keys(rest.pop("required", []), known, other)))
    for keyword in rest:
        raise KeyError(f"{keyword}: a keyword of schemas that is not known here")
    return checks[0] if len(checks) == 1 else _all(checks)


def _all(checks: list[Check]) -> Check:
    def check(value: Any) -> Violation | None:
        return next(filter(None, (one(value) for one in checks)), None)

    return check


def _where(kind: type, one: Check) -> Check:
    """What a keyword says of values of a type, and of no others."""
    return lambda value: one(value) if type(value) is kind else None


def _one_of(values: list[Any]) -> Check:
    wanted = " or ".join(v if isinstance(v, str) else json.dumps(v) for v in values)

    def check(value: Any) -> Violation | None:
        # True equals 1.
        same = any(value == v and type(value) is type(v) for v in values)
        return None if same else ("", f"must be {wanted}")

    return check


def _alternatives(checks: list[Check]) -> Check:
    """Of what is wrong with each alternative what lies deepest, or comes last: that was meant."""

    def check(value: Any) -> Violation | None:
        problems = [one(value) for one in reversed(checks)]
        return None if None in problems else max(problems, key=lambda problem: len(problem[0]))

    return check


def _of_type(
    types: list[str], least: float | None, most: float | None, wanted: str | None
) -> Check:
    first, *others = (TYPES[name][0] for name in types)
    bounds = [] if least is None else [f"{least} or more"]
    bounds += [] if most is None else [f"{most} or less"]
    others = [f"or {other}" for other in others]
    text = wanted or (", " if bounds else " ").join([", ".join([first, *bounds]), *others])
    allowed = frozenset(kind for name in types for kind in TYPES[name][1:])
    low, high = -math.inf if least is None else least, math.inf if most is None else most
    bounded = bool(bounds)

    def check(value: Any) -> Violation | None:
        # By its very type: true and false are integers to `isinstance`.
        if type(value) not in allowed:
            return "", f"must be {text}"
        if bounded and value is not None and not low <= value <= high:
            return "", f"must be {text}"
        if type(value) is int and float in allowed and abs(value) > sys.float_info.max:
            return "", "must be a number in the range of doubles"
        return None

    return check


def _of_length(least: int, most: int | None, wanted: str | None) -> Check:
    text = wanted or (f"{least} entries" if least == most else f"{least} entries or more")

    def check(value: Any) -> Violation | None:
        right = least <= len(value) and (most is None or len(value) <= most)
        return None if right else ("", f"must be {text}")

    return check


def _distinct(value: Any) -> Violation | None:
    return None if len({json.dumps(v) for v in value}) == len(value) else ("", "has an entry twice")


def _items(one: Check) -> Check:
    def check(value: Any) -> Violation | None:
        for i, item in enumerate(value):
            problem = one(item)
            if problem is not None:
                return f"[{i}]{problem[0]}", problem[1]
        return None

    return check


def _together(needed: Mapping[str, list[str]]) -> Check:
    """Keys that are needed where another one is."""

    def check(value: Any) -> Violation | None:
        wanted = (key for one, keys in needed.items() if one in value for key in keys)
        missing = next((key for key in wanted if key not in value), None)
        return None if missing is None else ("", f"the key {missing!r} is missing")

    return check


def _keys(required: list[str], known: Mapping[str, Check], other: Check | None) -> Check:
    def check(value: Any) -> Violation | None:
        for key, item in value.items():
            one = known.get(key, other)
            problem = None if one is None else one(item)
            if problem is not None:
                return f".{key}{problem[0]}", problem[1]
        missing = next((key for key in required if key not in value), None)
        return None if missing is None else ("", f"the key {missing!r} is missing")

    return check
