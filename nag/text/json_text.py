"""JSON as it is written: complex arrays as pairs, one line for each key and each point."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

# Objects of a list that are laid out at once.
AT_ONCE = 1000
_SCALARS = frozenset((str, int, float, bool, type(None)))


@dataclass(frozen=True, eq=False)
class Objects:
    """A list of the JSON objects of things, each made when it is written, and not kept."""

    things: Sequence[Any]

    def parts(self) -> Iterator[list[dict[str, Any]]]:
        """Some at a time, in their order."""
        for first in range(0, len(self.things), AT_ONCE):
            yield [each.document() for each in self.things[first : first + AT_ONCE]]


def real_or_null(value: float) -> float | None:
    """The number, or None where it is not finite: JSON knows no other numbers."""
    return float(value) if math.isfinite(value) else None


def pairs(array: np.ndarray) -> list[Any]:
    """A complex array as nested lists with ``[re, im]`` in place of each entry."""
    doubles = np.ascontiguousarray(array).view(float).reshape(*array.shape, 2)
    if np.isfinite(doubles).all():
        return doubles.tolist()
    return np.where(np.isfinite(doubles), doubles.astype(object), None).tolist()


def _depth(value: Any) -> float:
    """Nesting depth of lists; infinite if there is an object inside."""
    if isinstance(value, dict):
        return math.inf
    return 1 + max(map(_depth, value), default=0) if isinstance(value, list) else 0


def _is_flat(value: Any) -> bool:
    """Whether it is an object that has keys, and neither lists nor objects inside."""
    return (
        isinstance(value, dict)
        and len(value) > 0
        and _SCALARS.issuperset(map(type, value.values()))
    )


def _lay_out_flat(objects: list[dict[str, Any]], deeper: str) -> str:
    """What `lay_out` makes of many objects that are flat, one after the other, in one call."""
    # No text in JSON has this character: between } and { it parts objects, elsewhere keys.
    text = json.dumps(objects, allow_nan=False, separators=("\0", ": "))[2:-2]
    text = text.replace("}\0{", f"\n{deeper}}},\n{deeper}{{\n{deeper}  ")
    text = text.replace("\0", f",\n{deeper}  ")
    return f"{{\n{deeper}  {text}\n{deeper}}}"


def lay_out_parts(document: dict[str, Any]) -> Iterator[str]:
    """What `lay_out` makes of an object, some of whose values may be `Objects`, part by part."""
    if not document:
        yield lay_out(document)
        return
    start = "{\n"
    for key, value in document.items():
        yield f"{start}  {json.dumps(key)}: "
        start = ",\n"
        if not isinstance(value, Objects) or not value.things:
            yield lay_out([] if isinstance(value, Objects) else value, "  ")
            continue
        between = "[\n"
        for some in value.parts():
            # Without the brackets about them, and the line breaks beside these.
            yield between + lay_out(some, "  ")[2:-4]
            between = ",\n"
        yield "\n  ]"
    yield "\n}"


def lay_out(value: Any, indent: str = "") -> str:
    """JSON text with one line for each key, and one line for each point."""
    deeper = indent + "  "
    if isinstance(value, dict) and value:
        parts = [f"{json.dumps(k)}: {lay_out(v, deeper)}" for k, v in value.items()]
        left, right = "{}"
    elif isinstance(value, list) and (_depth(value) > 2 or any(isinstance(v, str) for v in value)):
        flat = all(map(_is_flat, value))
        parts = [_lay_out_flat(value, deeper)] if flat else [lay_out(v, deeper) for v in value]
        left, right = "[]"
    else:
        return json.dumps(value, allow_nan=False)
    return f"{left}\n{deeper}" + f",\n{deeper}".join(parts) + f"\n{indent}{right}"
