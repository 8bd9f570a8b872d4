"""How far work is, where someone reads it: a line on a terminal, in a file, in a notebook.

It is shown by processes that load little, so that little is imported here.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Iterator
from typing import Any, TextIO

from nag.text.progress import draw_bar, stage_name, stage_text

# Seconds between two updates of the line: often enough to look alive, too seldom to cost time.
INTERVAL = 0.1
# Seconds between two lines in a file or a pipe: a batch job can be told from a hang, and a day of
# work leaves 1,440 lines.
MINUTE = 60.0
# Steps of a stage from which on the others are taken to be like them: of a few one may be the most.
ALIKE = 10

ERASE = "\r\x1b[K"
# Columns of a terminal that does not know how many it has.
WIDTH = 80


def can_erase(stream: TextIO) -> bool:
    """Whether a stream leads to a terminal that knows how to take a line away."""
    return stream.isatty() and os.environ.get("TERM") != "dumb"


class ProgressLine:
    """How far the work is: one line on a terminal, with a bar; elsewhere a line every minute.

    A terminal that cannot take a line away, ``TERM=dumb``, is elsewhere.

    Called as ``line(stage, done, total)``, from any thread; a ``total`` of 0 means not known. From
    then on until `erase` the line stands; `show` keeps its times up to date.

    Attributes:
        stage: that was told last, empty before the first.
    """

    def __init__(self, stream: TextIO, quiet: bool = False) -> None:
        self._stream = stream
        self._changes = can_erase(stream)
        self._quiet = quiet
        self._started = time.monotonic()
        self._last = self._started - (INTERVAL if self._changes else 0.0)
        self._standing = self._shown = False
        self.stage, self._done, self._total = "", 0, 0
        self._stage_started, self._stage_first = self._started, 0

    def __call__(self, stage: str, done: int, total: int) -> None:
        if stage_name(stage) != stage_name(self.stage) or done < self._done:
            self._stage_started, self._stage_first = time.monotonic(), done
        self.stage, self._done, self._total = stage, done, total
        self._standing = True
        self.show()

    def stage_text(self) -> str:
        """The stage that was told last, and how far it was."""
        return stage_text(self.stage, self._done, self._total)

    def show(self) -> None:
        """Write the line, if it is time to."""
        now = time.monotonic()
        wait = INTERVAL if self._changes else MINUTE
        if self._quiet or not self._standing or now - self._last < wait:
            return
        self._last = now
        bar = draw_bar(self._done, self._total) if self._changes else ""
        text = f"{bar}{' ' if bar else ''}{self.stage_text()}{self._speed_text(now)}"
        with contextlib.suppress(OSError, ValueError):
            if self._changes:
                self._put(text)
                self._shown = True
            else:
                self._stream.write(f"nag: {text}\n")
                self._stream.flush()

    def _put(self, text: str) -> None:
        """Write a text in place of the one before."""
        self._stream.write(f"{ERASE}{text[: self._width - 1]}")
        self._stream.flush()

    def _take_away(self) -> None:
        """Take the text away."""
        self._stream.write(ERASE)
        self._stream.flush()

    @property
    def _width(self) -> int:
        """Columns of the terminal; one that nobody has told its size says 0."""
        try:
            return os.get_terminal_size(self._stream.fileno()).columns or WIDTH
        except (OSError, ValueError):
            return WIDTH

    def _speed_text(self, now: float) -> str:
        """Seconds since the start; steps a second and the time left of the stage."""
        parts = [f"{_duration(now - self._started)} so far"]
        steps, seconds = self._done - self._stage_first, now - self._stage_started
        if steps > 0 and seconds >= 1.0:
            parts.append(f"{steps / seconds:.3g} a second")
            if self._total > self._done and steps >= ALIKE:
                left = (self._total - self._done) * seconds / steps
                parts.append(f"{_duration(left)} left of this")
        return " (" + ", ".join(parts) + ")"

    def erase(self) -> None:
        """Take the line off the terminal, until more is told."""
        self._standing = False
        if self._shown:
            with contextlib.suppress(OSError, ValueError):
                self._take_away()
            self._shown = False


class NotebookLine(ProgressLine):
    """The same in a notebook: an output of the cell, which changes and is empty at the end."""

    def __init__(self) -> None:
        super().__init__(sys.stderr)
        self._changes = True
        self._output: Any = None

    def _put(self, text: str) -> None:
        from IPython.display import display

        shown = {"text/plain": text}
        if self._output is None:
            self._output = display(shown, raw=True, display_id=True)
        else:
            self._output.update(shown, raw=True)

    def _take_away(self) -> None:
        self._put("")


def _in_notebook() -> bool:
    """Whether Python is asked by a notebook."""
    ask = getattr(sys.modules.get("IPython"), "get_ipython", None)
    return getattr(ask() if ask else None, "kernel", None) is not None


def _duration(seconds: float) -> str:
    whole = int(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02} min"


@contextlib.contextmanager
def progress_line(
    stream: TextIO | None = None, quiet: bool = False
) -> Iterator[ProgressLine | None]:
    """A progress callback that writes to a stream; None if nothing is to be written.

    Args:
        stream: where to; None for where Python is used: a notebook, else standard error.
    """
    if quiet:
        yield None
        return
    if stream is None and _in_notebook():
        line: ProgressLine = NotebookLine()
    else:
        line = ProgressLine(sys.stderr if stream is None else stream)
    try:
        yield line
    finally:
        line.erase()
