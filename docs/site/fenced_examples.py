"""Examples of docstrings as code on the reference pages: Markdown takes ``>>>`` for quotes."""

from __future__ import annotations

import re
from typing import Any

import griffe

EXAMPLE = re.compile(r"^([ \t]*)>>> .*(?:\n[ \t]*\S.*)*", re.MULTILINE)


class FencedExamples(griffe.Extension):
    """Fences round the examples of every docstring."""

    def on_object(self, *, obj: Any, **_: Any) -> None:
        """Mark the examples of one object as code."""
        if obj.docstring is not None:
            fenced = EXAMPLE.sub(r"\1```pycon\n\g<0>\n\1```", obj.docstring.value)
            obj.docstring.value = fenced
