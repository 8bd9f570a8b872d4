"""Progress on a terminal, at the boundary: algorithms only call a function of three arguments."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator
from typing import TextIO

Progress = Callable[[str, int, int], None]

# Seconds between two updates of the line: often enough to look alive, too seldom to cost time.
INTERVAL = 0.1

_ERASE = "\r\x1b[K"


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
