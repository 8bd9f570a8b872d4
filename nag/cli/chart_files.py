"""Files that charts are written to."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from nag.cli.arguments import UsageError
from nag.cli.running import check_option_target
from nag.errors import NagError
from nag.pictures.plot import check_kind


def check_targets(options: argparse.Namespace) -> None:
    """Refuse, before any work is done, files that could not be written.

    Raises:
        UsageError: for the first of them, or if matplotlib is missing.
    """
    for path in options.picture or ():
        check_picture("picture", path)


def check_picture(option: str, path: str, source: str = "") -> None:
    """Refuse a picture that could not be written.

    Args:
        option: names the file.
        source: the file that is read, which it must not be.

    Raises:
        UsageError: if it could not, or if matplotlib is missing.
    """
    try:
        check_kind(path)
    except NagError as error:
        raise UsageError(f"--{option}: {error}") from None
    check_option_target(option, path, source)


def write_picture(path: str, draw: Callable[[str], None], option: str = "picture") -> None:
    """Draw to a file.

    Raises:
        UsageError: if it cannot be written.
    """
    try:
        draw(path)
    except OSError as error:
        raise UsageError(f"--{option}: {path}: {error.strerror or error}") from None
