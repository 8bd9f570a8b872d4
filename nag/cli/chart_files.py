"""Files that charts are written to."""

from __future__ import annotations

import argparse
import importlib.util
from collections.abc import Callable

from nag.cli.arguments import UsageError
from nag.cli.running import write_document

KINDS = (".svg", ".png", ".pdf")


def check_targets(options: argparse.Namespace) -> None:
    """Refuse, before any work is done, files that could not be written.

    Raises:
        UsageError: for the first of them, or if matplotlib is missing.
    """
    from nag.files.written_file import TargetError, check_target

    for path in options.picture or ():
        if not path.endswith(KINDS):
            raise UsageError(f"--picture: {path}: name a file that ends in {', '.join(KINDS)}")
        if importlib.util.find_spec("matplotlib") is None:
            text = 'matplotlib is missing; install it with pip install "nag[plot]"'
            raise UsageError(f"--picture: {text}")
        try:
            check_target(path)
        except TargetError as error:
            raise UsageError(f"--picture: {error}") from None


def write_text(path: str | None, text: str) -> None:
    """Write the data, if a file was named.

    Raises:
        UsageError: if it cannot be written.
    """
    if path is not None:
        write_document(text, path)


def write_picture(path: str, draw: Callable[[str], None]) -> None:
    """Draw to a file.

    Raises:
        UsageError: if it cannot be written.
    """
    try:
        draw(path)
    except OSError as error:
        raise UsageError(f"--picture: {path}: {error.strerror or error}") from None
