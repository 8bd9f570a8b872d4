"""What the runs of all commands share: their start, the file for their answer, their progress."""

from __future__ import annotations

import argparse
import contextlib
import os
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TextIO

from nag.cli.arguments import UsageError

# What NumPy's linear algebra reads, when it is loaded, of how many threads it is to have.
LINEAR_ALGEBRA_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
Progress = Callable[[str, int, int], None]

# Seconds between two updates of the line: often enough to look alive, too seldom to cost time.
INTERVAL = 0.1

_ERASE = "\r\x1b[K"


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


def as_chosen(options: argparse.Namespace) -> dict[str, Any]:
    """The keywords of whatever tracks paths: the seed, the threads and the settings chosen."""
    return {name: getattr(options, name) for name in ("seed", "threads", "settings")}


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


class ProgressLine:
    """One line on a terminal that is written over as work goes on.

    Called as ``line(stage, done, total)``, from any thread; a ``total`` of 0 means not known.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._last = -INTERVAL
        self._shown = False

    def __call__(self, stage: str, done: int, total: int) -> None:
        now = time.monotonic()
        if now - self._last < INTERVAL:
            return
        self._last = now
        self._shown = True
        count = f"{done} of {total}" if total else f"{done}"
        self._stream.write(f"{_ERASE}{stage}: {count}")
        self._stream.flush()

    def erase(self) -> None:
        """Take the line off the terminal."""
        if self._shown:
            self._stream.write(_ERASE)
            self._stream.flush()
            self._shown = False


@contextlib.contextmanager
def progress_line(stream: TextIO, quiet: bool = False) -> Iterator[Progress | None]:
    """A progress callback for ``stream`` if it is a terminal, else None."""
    if quiet or not stream.isatty():
        yield None
        return
    line = ProgressLine(stream)
    try:
        yield line
    finally:
        line.erase()


@contextlib.contextmanager
def compilation_notice(stream: TextIO, quiet: bool = False) -> Iterator[None]:
    """Say so on ``stream``, once, when a kernel is compiled inside the block.

    Kernels that are loaded from the cache are not compiled, so the line appears only when there is
    a wait.
    """
    if quiet:
        yield
        return
    from nag.machine_code.kernel import compilations

    given: list[str] = []

    def notice(name: str) -> None:
        if not given:
            start = _ERASE if stream.isatty() else ""
            stream.write(f"{start}compiling the tracker, once; this takes a few seconds ...\n")
            stream.flush()
        given.append(name)

    with compilations(notice):
        yield
