"""The command ``nag init``: a commented case to begin with."""

from __future__ import annotations

import argparse
import os
from importlib.resources import files

from nag.cli.arguments import UsageError
from nag.cli.running import STANDARD_OUTPUT, CommandAnswer

KINDS = ("linkage", "mechanism", "framework", "dh", "system")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag init``."""
    parser.add_argument(
        "kind", choices=KINDS, metavar=f"{{{','.join(KINDS)}}}", help="what the case is to describe"
    )
    parser.add_argument(
        "file",
        nargs="?",
        metavar="FILE",
        help="the file to be written, which must not be there yet (default, or -: it is printed)",
    )


def read_template(kind: str) -> str:
    """The text of a case of this kind."""
    return files("nag.files").joinpath("templates", f"{kind}.toml").read_text("utf-8")


def run(options: argparse.Namespace) -> CommandAnswer:
    """A commented case, written or printed."""
    text = read_template(options.kind)
    if options.file in (None, STANDARD_OUTPUT):
        return CommandAnswer(text.splitlines())
    if os.path.lexists(options.file):
        raise UsageError(f"{options.file}: is there already; name a file that is not")
    from nag.files.written_file import check_target, write_target

    check_target(options.file)
    write_target(options.file, text)
    return CommandAnswer([f"{options.file} is written; edit it, and ask: nag {options.file}"])
