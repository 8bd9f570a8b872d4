"""What the runs of all commands share: when they started, and the file for their answer."""

from __future__ import annotations

import argparse
import contextlib
import os
import time
from collections.abc import Iterator, Sequence

from nag.cli.arguments import UsageError

# What NumPy's linear algebra reads, when it is loaded, of how many threads it is to have.
LINEAR_ALGEBRA_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def begin(options: argparse.Namespace) -> None:
    """Start the clock, and refuse a file that the answer could not be written to.

    NumPy's linear algebra gets one thread, unless the environment says otherwise: the matrices are
    small, threads of its own would wait for each other, and sums would be in another order.

    Raises:
        UsageError: for such a file.
    """
    options.started = time.perf_counter()
    for name in LINEAR_ALGEBRA_THREADS:
        os.environ.setdefault(name, "1")
    target = getattr(options, "json", None)
    if target is not None:
        source = getattr(options, "case", None) or getattr(options, "export", "")
        _check_target(target, source if isinstance(source, str) else "")


def seconds(options: argparse.Namespace) -> float:
    """Seconds that the command runs."""
    return time.perf_counter() - options.started


def run_row(options: argparse.Namespace) -> tuple[str, str]:
    """The last line of what a command prints, with its label."""
    text = f"seed {options.seed}, settings {options.settings}, {seconds(options):.1f} s"
    return "run", text


@contextlib.contextmanager
def writing_json(answer: Sequence[str] = ()) -> Iterator[None]:
    """Write an answer inside the block.

    Args:
        answer: lines that are printed all the same if the file cannot be written.

    Raises:
        UsageError: if it cannot.
    """
    from nag.files.written_file import TargetError

    try:
        yield
    except TargetError as error:
        raise UsageError(f"--json: {error}", answer) from None


def _check_target(target: str, source: str) -> None:
    from nag.files.written_file import check_target

    with writing_json():
        check_target(target)
    if os.path.exists(target) and os.path.exists(source) and os.path.samefile(target, source):
        raise UsageError(f"--json: {target}: is the case file; name another file")
