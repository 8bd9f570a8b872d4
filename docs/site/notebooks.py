"""Tutorials as notebooks: the pages of ``docs/tutorials`` are their source."""

from __future__ import annotations

import re
from typing import Any

import jupytext

KERNEL = {"name": "python3", "display_name": "Python 3", "language": "python"}
# Pages do not lie beside a notebook that was saved; pictures and addresses elsewhere stay.
_TO_PAGE = re.compile(r"(?<!!)\[([^\]]*)\]\((?!https?:)[^)]*\)")


def make_notebook(page: str) -> Any:
    """The notebook of a page in Markdown: its programs are the cells of code.

    The same page gives the same bytes.
    """
    notebook = jupytext.reads(page, fmt="md")
    notebook.metadata = {"kernelspec": KERNEL, "language_info": {"name": "python"}}
    for i, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{i}"
        if cell.cell_type == "markdown":
            cell.source = _TO_PAGE.sub(r"*\1*", cell.source)
    return notebook


def write_notebook(page: str) -> str:
    """The text of the notebook's file."""
    return jupytext.writes(make_notebook(page), fmt="ipynb")
