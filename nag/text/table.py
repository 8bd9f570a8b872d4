"""Cells, rows and labelled lines as text and as HTML."""

from __future__ import annotations

import html
import math
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from nag.errors import NagError

# Length of a line; longer texts are wrapped.
LINE = 100
# Digits of a number that is shown.
SHOWN = 6


def printable(text: str) -> str:
    """``text`` on one line, with everything that could steer a terminal escaped."""
    return "".join(
        c if c.isprintable() else c.encode("unicode_escape", "backslashreplace").decode()
        for c in text
    )


def count_text(number: int, noun: str, plural: str = "") -> str:
    """``1 path``, ``2 paths``; a plural that takes no s is given."""
    return f"{number} {noun}" if number == 1 else f"{number} {plural or noun + 's'}"


def join_words(words: Sequence[str], last: str = "and") -> str:
    """``A``, ``A and B``, ``A, B and C``; another word before the ``last``."""
    return f" {last} ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def magnitude(value: float) -> str:
    """A small positive number to two digits: ``3.1e-16``; ``?`` if it is not known."""
    return f"{value:.1e}" if math.isfinite(value) else "?"


def number_text(value: complex, error: float = 0.0) -> str:
    """A number to as many digits, six at most, as an error that it may have leaves it.

    Parts that are no larger than that error are left out.

    >>> number_text(1 / 3 + 1e-31j, 1e-16), number_text(2.5e-17 + 0.125j, 1e-3)
    ('0.333333', '0+0.12i')
    """
    value = complex(value)
    real = _digits_text(value.real, error)
    if abs(value.imag) <= error < math.inf:
        return real
    return f"{real}{_digits_text(value.imag, error, '+')}i"


def _digits_text(value: float, error: float, sign: str = "") -> str:
    """A real number that may be off by ``error``."""
    if abs(value) <= error < math.inf:
        return "0"
    digits = SHOWN
    if error > 0 and math.isfinite(value):
        known = math.log10(abs(value)) - math.log10(2 * error) if error < math.inf else 1
        digits = max(1, min(SHOWN, int(known)))
    return format(value, f"{sign}.{digits}g")


def point_text(point: Iterable[complex], error: float = 0.0) -> str:
    """A point's coordinates, each of which may be off by ``error``."""
    return f"({', '.join(number_text(z, error) for z in point)})"


def align(rows: Sequence[Sequence[str]], left: Iterable[int] = ()) -> list[str]:
    """Rows of cells as lines with aligned columns, right-aligned except those in ``left``."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    left = set(left)
    return [
        "  ".join(
            cell.ljust(width) if i in left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def label_lines(rows: Sequence[tuple[str, str]], width: int = 0) -> list[str]:
    """Lines ``label  text`` with the texts in one column, the labels at least ``width`` wide.

    Long texts go on below their beginning.
    """
    width = max([width, *(len(label) for label, _ in rows)])
    lines = []
    for label, text in rows:
        parts = textwrap.wrap(text, LINE - width - 2, break_on_hyphens=False) or [""]
        lines += [
            f"{name.ljust(width)}  {part}".rstrip()
            for name, part in zip([label, *[""] * len(parts)], parts, strict=False)
        ]
    return lines


Row = tuple[str, str]
Block = Sequence[Row] | Sequence[str]


def sheet(title: str, *blocks: Block, width: int = 0) -> list[str]:
    """What a command prints: a title, and blocks below it with blank lines between.

    Args:
        blocks: each lines as they are, or labelled texts; empty ones are left out.
        width: of the labels, at least; all texts of all blocks stand in one column.
    """
    labels = [part[0] for block in blocks for part in block if not isinstance(part, str)]
    width = max([width, *map(len, labels)])
    lines = [printable(title)]
    for block in filter(None, blocks):
        lines.append("")
        if isinstance(block[0], str):
            lines += block
        else:
            lines += label_lines([(label, printable(text)) for label, text in block], width)
    return lines


def lines_of(title: str, rows: Sequence[tuple[str, str]]) -> str:
    """What an object shows at the prompt: a title, and one line for each of ``rows``."""
    width = max(len(label) for label, _ in rows)
    lines = [title, *(f"  {label.ljust(width)}  {text}" for label, text in rows)]
    return "\n".join(shorten_text(printable(line)) for line in lines)


def one_line(shown: object) -> str:
    """What is printed in several lines, in one: its answer, or what it is and its first line."""
    title, *rows = (line.strip() for line in str(shown).splitlines())
    answers = [row.split("  ", 1)[1].strip() for row in rows if row.startswith("answer  ")]
    if answers:
        return named_line(shown, f": {answers[0]}")
    name = type(shown).__name__
    about = title.removeprefix(name) if title.startswith(name) else f" {title}"
    return named_line(shown, ": ".join([about, *rows[:1]]))


def named_line(shown: object, text: str) -> str:
    """What an object is at the prompt: its class, whether it is incomplete, and a text."""
    complete: Any = getattr(shown, "complete", True)
    whole = complete if isinstance(complete, bool) else bool(complete.all())
    line = f"<{type(shown).__name__}{'' if whole else ' (INCOMPLETE)'}{text}"
    return shorten_text(" ".join(line.split()), LINE - 1) + ">"


def shorten_text(text: str, width: int = LINE) -> str:
    """``text`` cut to ``width`` characters, with dots where something is missing."""
    return text if len(text) <= width else text[: width - 3].rstrip() + "..."


def html_table(caption: str, rows: Sequence[Sequence[str]], note: str = "") -> str:
    """The first of ``rows`` as headings, the others below it, and a note; everything escaped."""

    def cells(row: Sequence[str], tag: str) -> str:
        return "".join(f"<{tag}>{html.escape(printable(cell))}</{tag}>" for cell in row)

    parts = [f"<caption>{html.escape(printable(caption))}</caption>"]
    if rows:
        body = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows[1:])
        parts.append(f"<thead><tr>{cells(rows[0], 'th')}</tr></thead><tbody>{body}</tbody>")
    table = f"<table>{''.join(parts)}</table>"
    return f"{table}<p>{html.escape(printable(note))}</p>" if note else table


def split_parts(columns: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of floats where there were complex ones: ``x.real`` and ``x.imag`` of ``x``."""
    split: dict[str, Any] = {}
    for name, column in columns.items():
        if getattr(getattr(column, "dtype", None), "kind", "") == "c":
            split |= {f"{name}.{part}": getattr(column, part) for part in ("real", "imag")}
        else:
            split[name] = column
    return split


def named_apart(own: Mapping[str, Any], beside: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of variables, and others beside them, with ``_`` behind names that are variables.

    >>> named_apart({"real": 1, "x": 2}, {"real": 3, "error": 4})
    {'real': 1, 'x': 2, 'real_': 3, 'error': 4}
    """
    columns = dict(own)
    for name, column in beside.items():
        while name in columns:
            name += "_"
        columns[name] = column
    return columns


def known_or_nan(counts: Sequence[int | None]) -> list[float]:
    """A column of counts, those that are not known, None or 0, as NaN."""
    return [count or math.nan for count in counts]


def data_frame(columns: Mapping[str, Sequence[Any]], parts: bool = False) -> Any:
    """A ``pandas.DataFrame`` of these columns.

    Args:
        parts: whether complex ones are split, see `split_parts`.

    Raises:
        nag.NagError: if pandas is not installed.
    """
    try:
        import pandas
    except ImportError:
        raise NagError("to_dataframe: pandas is not installed; pip install pandas") from None
    return pandas.DataFrame(split_parts(columns) if parts else dict(columns))
