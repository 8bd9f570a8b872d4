"""The JSON Schemas of the exports, which are in the folder ``schema`` beside this module."""

from __future__ import annotations

import json
from importlib import resources
from typing import Any


def schema(name: str, version: int = 1) -> dict[str, Any]:
    """The JSON Schema of a format, such as ``"nag-decomposition"``.

    >>> schema("nag-decomposition", 2)["properties"]["format"]["const"]
    'nag-decomposition'
    """
    file = resources.files("nag.files") / "schema" / f"{name}-{version}.json"
    return json.loads(file.read_text("utf-8"))
