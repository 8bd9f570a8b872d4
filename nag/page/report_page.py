"""One self-contained HTML file of all that was found of a mechanism, to be sent to a colleague."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from nag.page.motion_page import page_part, script_text

Row = tuple[str, str]


@dataclass(frozen=True)
class Section:
    """A part of a report.

    Attributes:
        heading: its heading.
        content: labelled texts, or lines as they are, or ready HTML.
    """

    heading: str
    content: Sequence[Row] | Sequence[str] | str

    def html(self) -> str:
        """The part as HTML."""
        if isinstance(self.content, str):
            body = self.content
        elif self.content and isinstance(self.content[0], str):
            body = f"<pre>{escape(chr(10).join(map(str, self.content)))}</pre>"
        else:
            pairs = (f"<dt>{escape(a)}</dt><dd>{escape(b)}</dd>" for a, b in self.content)
            body = f"<dl>{''.join(pairs)}</dl>"
        return f"<section><h2>{escape(self.heading)}</h2>\n{body}</section>"


def report_page(
    title: str,
    lead: str,
    complete: bool,
    motion: str,
    sections: Sequence[Section],
    document: str,
    name: str,
    footer: str,
) -> str:
    """The page.

    Args:
        title: of the case.
        lead: the answer in a sentence.
        complete: whether nothing is open.
        motion: the page in which it moves, see `nag.page.motion_page`; empty if there is none.
        sections: what is said below that.
        document: the answer as JSON.
        name: of the file in which that is saved, without its ending.
        footer: how the answer was worked out.
    """
    frame = ""
    if motion:
        # An attribute ends at its quote alone; of the two the page has fewer single ones.
        inside = motion.replace("&", "&amp;").replace("'", "&#39;")
        frame = f'<iframe id="moving" title="the mechanism moves" srcdoc=\'{inside}\'></iframe>'
    parts = {
        "title": escape(title),
        "lead": escape(lead),
        "doubt": "" if complete else " open",
        "motion": frame,
        "sections": "\n".join(section.html() for section in sections),
        "data": script_text(document),
        "name": re.sub(r"[^A-Za-z0-9_.-]", "_", name),
        "footer": escape(footer),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], page_part("report.html"))
