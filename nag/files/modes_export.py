"""The components of all assembly modes as JSON.

The format is ``nag-modes``, version 1: for each class of modes its combinations and a
``nag-decomposition`` of the first of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from nag.files.export import Origin
from nag.files.export import document as decomposition_document
from nag.mechanism.problem import problem_of

if TYPE_CHECKING:
    from nag.files.cases import Case
    from nag.mechanism.mode_decomposition import ModesAnswer

FORMAT = "nag-modes"
VERSION = 1


def document(answer: ModesAnswer, case: Case) -> dict[str, Any]:
    """The export as a JSON object."""
    classes = []
    for each in answer.classes:
        classes.append(
            {
                "modes": [dict(modes) for modes in each.modes.members],
                "decomposition": decomposition_document(
                    each.decomposition, Origin.of(case, problem_of(each.model))
                ),
            }
        )
    return {
        "format": FORMAT,
        "version": VERSION,
        "complete": answer.complete,
        "modes_apart": answer.apart,
        "meetings": [list(meeting) for meeting in answer.meetings],
        "classes": classes,
    }
