"""The numbers that decide something: what is a zero, one point, a rank, an end.

Each stands in its module under a comment that begins with ``Decides:`` and says what it decides,
and why there. ``python -m nag.thresholds`` lists them all. Where a threshold is safe on one side
only, it stands on that side: what does not pass is followed in more digits, or left undecided, not
dismissed. ``python tests/measure_thresholds.py`` measures how far what they judge lies from those
whose comment begins with ``Decides, measured:``, with ``--decompose`` in decompositions. What a
caller may choose stands beside its argument, or in `nag.tracking.settings.Settings`.

Other values of all other constants give the same answers, sooner or later: sizes of steps and
work, bounds of rounding, digits that are taken and when more of them are, scales, sizes of boxes in
which something is proved, where random numbers come from.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

_ROOT = Path(__file__).parent
_COMMENT = re.compile(r"^(# Decides(, measured)?: .*\n(?:#.*\n)*)([A-Z_0-9]+) = ", re.MULTILINE)


@dataclass(frozen=True)
class Threshold:
    """A number that decides something.

    Attributes:
        name: of the module, below ``nag``, and of the constant.
        reason: what it decides, and why there.
        measured: whether `tests/measure_thresholds.py` measures what it judges.
    """

    name: str
    value: float
    reason: str
    measured: bool


def read_thresholds() -> Iterator[Threshold]:
    """All thresholds, by the packages' modules, as their sources tell of them."""
    for file in sorted(_ROOT.rglob("*.py")):
        module = ".".join(file.relative_to(_ROOT).with_suffix("").parts)
        for comment, measured, constant in _COMMENT.findall(file.read_text("utf-8")):
            words = " ".join(line.removeprefix("#") for line in comment.splitlines()).split()
            reason = " ".join(words).split(": ", 1)[1]
            value = float(getattr(import_module(f"nag.{module}"), constant))
            yield Threshold(f"{module}.{constant}", value, reason, bool(measured))


def threshold_lines() -> Iterator[str]:
    """The table of them as text."""
    for threshold in read_thresholds():
        yield f"{threshold.name} = {threshold.value:g}{' (measured)' if threshold.measured else ''}"
        yield from textwrap.wrap(
            threshold.reason, 96, initial_indent="    ", subsequent_indent="    "
        )


if __name__ == "__main__":
    print("\n".join(threshold_lines()))
