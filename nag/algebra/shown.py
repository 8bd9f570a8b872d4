"""What systems show at the prompt and in notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nag.text.table import LINE, counted, html_table, printable, shortened

if TYPE_CHECKING:
    from nag.algebra.system import PolynomialSystem

# Of longer systems the first equations are shown.
MOST_LINES, MOST_ROWS = 4, 40


def system_line(system: PolynomialSystem) -> str:
    """Variables, equations and degrees in one line."""
    degrees: dict[int, int] = {}
    for degree in sorted(system.degrees):
        degrees[degree] = degrees.get(degree, 0) + 1
    listed = ", ".join(f"{n} of degree {d}" for d, n in degrees.items())
    names = ", ".join(system.variables)
    text = (
        f"{counted(system.n, 'variable')}{f' ({names})' if 0 < len(names) <= 60 else ''}, "
        f"{counted(len(system.polynomials), 'equation')}{f': {listed}' if listed else ''}"
    )
    return text if system.exact else f"{text}; not all coefficients are rational"


def system_text(system: PolynomialSystem) -> str:
    """A system in five lines: what it is, and its first equations."""
    lines = [f"PolynomialSystem of {system_line(system)}"]
    shown = len(system.polynomials) if len(system.polynomials) <= MOST_LINES else MOST_LINES - 1
    lines += [f"  {f.text(system.variables)} = 0" for f in system.polynomials[:shown]]
    if shown < len(system.polynomials):
        lines.append(f"  and {counted(len(system.polynomials) - shown, 'more equation')}")
    return "\n".join(shortened(printable(line)) for line in lines)


def system_html(system: PolynomialSystem) -> str:
    """A system as a table, one row an equation."""
    rows = [["equation", "degree", "is zero"]]
    for i, f in enumerate(system.polynomials[:MOST_ROWS]):
        rows.append([str(i), str(f.degree), shortened(f.text(system.variables), 2 * LINE)])
    hidden = len(system.polynomials) - MOST_ROWS
    note = f"and {counted(hidden, 'more equation')}" if hidden > 0 else ""
    return html_table(f"PolynomialSystem of {system_line(system)}", rows, note)
