"""What local dimensions show at the prompt and in the commands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nag.text.table import lines_of, point_text

if TYPE_CHECKING:
    from nag.numerics.local_dimension import LocalDimension

# More coranks of a sequence are left to the export.
MOST_CORANKS = 12


def dimension_text(found: LocalDimension) -> str:
    """The answer in one sentence."""
    if found.tangent_dimension is None:
        return "undecided: no exact solution was found there"
    tangent = f"tangent dimension {found.tangent_dimension}"
    if not found.decided:
        return f"undecided: local dimension {found.lower} to {found.upper}, {tangent}"
    text = f"local dimension {found.lower}, {tangent}"
    if found.lower == 0:
        return f"{text}: isolated, of multiplicity {found.multiplicity}"
    singular = found.tangent_dimension > found.lower
    return f"{text}: {'a singular point of the equations' if singular else 'a regular point'}"


def matrices_text(found: LocalDimension) -> str:
    """The corank sequence and what it was computed in; empty if there is none."""
    if not found.coranks:
        return ""
    shown = ", ".join(map(str, found.coranks[:MOST_CORANKS]))
    if len(found.coranks) > MOST_CORANKS:
        shown += f", .. {found.coranks[-1]} in degree {len(found.coranks) - 1}"
    k = found.hyperplanes
    where = f" on {k} random hyperplane{'' if k == 1 else 's'} through the point" if k else ""
    return f"coranks {shown} in degrees 0, 1, ..{where}, {found.arithmetic}"


def local_rows(found: LocalDimension) -> list[tuple[str, str]]:
    """The answer and what it rests on, as labelled texts."""
    rows = [("answer", dimension_text(found))]
    if found.tangent_dimension is not None:
        bounds = f"at least {found.lower}, at most {found.upper}: {found.reason}"
        rows.append(("bounds", bounds))
    else:
        rows.append(("open", found.reason))
    matrices = matrices_text(found)
    return [*rows, ("matrices", matrices)] if matrices else rows


def local_dimension_text(found: LocalDimension) -> str:
    """A local dimension in at most five lines."""
    return lines_of(f"LocalDimension at {point_text(found.point)}", local_rows(found))
