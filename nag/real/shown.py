"""What a real curve shows at the prompt, in notebooks and in the commands."""

from __future__ import annotations

from nag.real.curve import PieceKind, RealCurve
from nag.text.table import count_text, html_table, join_words, lines_of

PLURALS = {
    PieceKind.CLOSED_LOOP: ("closed loop", "closed loops"),
    PieceKind.ARC_NETWORK: ("network of arcs", "networks of arcs"),
    PieceKind.OPEN_ARC: ("open arc", "open arcs"),
    PieceKind.POINT: ("isolated point", "isolated points"),
}


def answer_text(curve: RealCurve) -> str:
    """The pieces in words: ``2 closed loops and 1 isolated point``."""
    counts = curve.counted()
    found = join_words([count_text(number, *PLURALS[kind]) for kind, number in counts.items()])
    text = found or "no real points"
    return text if curve.complete else f"undecided; found: {text}"


def piece_rows(curve: RealCurve) -> list[list[str]]:
    """Headings, and one row for each piece."""
    rows = [["piece", "kind", "arcs", "vertices", "points"]]
    for k, piece in enumerate(curve.pieces):
        points = sum(len(curve.edges[i]) for i in piece.edges) or len(piece.vertices)
        sizes = (len(piece.edges), len(piece.vertices), points)
        rows.append([str(k + 1), str(piece.kind), *map(str, sizes)])
    return rows


def curve_text(curve: RealCurve) -> str:
    """Lines for the prompt."""
    kinds: dict[str, int] = {}
    for vertex in curve.vertices:
        kinds[str(vertex.kind)] = kinds.get(str(vertex.kind), 0) + 1
    rows = [("answer", answer_text(curve))]
    if kinds:
        rows.append(("vertices", ", ".join(f"{n} {kind}" for kind, n in kinds.items())))
    if curve.edges:
        points = sum(map(len, curve.edges))
        rows.append(("arcs", f"{len(curve.edges)} of {count_text(points, 'point')} in all"))
    if curve.reason:
        rows.append(("open", curve.reason))
    return lines_of(f"RealCurve in {count_text(len(curve.variables), 'variable')}", rows)


def curve_html(curve: RealCurve) -> str:
    """A table for notebooks."""
    return html_table(f"RealCurve: {answer_text(curve)}", piece_rows(curve), curve.reason)
