"""A command works in a child process, so that it can be told of, and ended, whatever it is doing.

A call into FLINT, SciPy or compiled code holds the interpreter for as long as it takes: neither a
signal nor a thread is served meanwhile. So the process that was started forks before any thread is
there, and before NumPy is loaded. The child works as if it were alone. The parent does nothing that
takes time: it shows progress, watches time and memory, and takes signals. What is to end is asked
to (SIGINT), and killed if it has not ended `GRACE` seconds later.

A program that calls the command line has threads, and goes on afterwards: it is never forked. A
command with limits of time or memory is started for it as a new process, which does all this.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import select
import signal
import sys
import time
from collections.abc import Sequence
from types import FrameType
from typing import IO, TextIO

from nag.cli.arguments import UsageError
from nag.cli.running import PRINTED, TellParent, forget_unfinished, take_unfinished
from nag.text.progress_line import ProgressLine

# The options that name files which are written.
WRITTEN = ("json", "points", "csv", "html", "out")
# Seconds in which the child may end by itself, its files cleared away; then it is killed. Ctrl-C is
# to be obeyed within one.
GRACE = 0.5
# Seconds between two looks at the clock and at the child's memory, which grows by some hundred MB
# meanwhile at most.
LOOK = 0.1
INCOMPLETE, INTERRUPTED = 1, 130
_KEPT = "has what was found by then, marked incomplete"
_GIGABYTE = 10**9
_ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP) if hasattr(signal, "SIGHUP") else ()
# Of prctl on Linux: the signal that a child gets when its parent has died.
_DEATH_SIGNAL = 1


def work_in_child(options: argparse.Namespace) -> int | None:
    """Fork; the child is to work, the parent waits for it.

    Returns:
        In the parent, when the child has ended, the exit status. In the child, and where there is
        no fork or a process of MPI is not to be forked, None.

    Raises:
        UsageError: for limits that cannot be watched on this system.
    """
    seconds = getattr(options, "time_limit", None)
    gigabytes = getattr(options, "memory_limit", None)
    if gigabytes is not None and not os.path.exists("/proc/self/statm"):
        raise UsageError("--memory-limit: this system does not tell the memory of a process")
    # What MPI has opened in a process is not its child's.
    under_mpi = "mpi4py.MPI" in sys.modules
    if under_mpi or not hasattr(os, "fork"):
        why = "is not for work under mpiexec, which has limits" if under_mpi else ""
        for option, limit in (("--time-limit", seconds), ("--memory-limit", gigabytes)):
            if limit is not None:
                raise UsageError(f"{option}: {why or 'this system has no fork'}")
        return None
    forget_unfinished(options)
    heard, telling = os.pipe()
    acknowledged, acknowledging = os.pipe()
    sys.stdout.flush()
    sys.stderr.flush()
    signal.pthread_sigmask(signal.SIG_BLOCK, _ENDINGS)
    parent = os.getpid()
    child = os.fork()
    if child == 0:
        os.close(heard)
        os.close(acknowledging)
        end_with(parent)
        _take_one_interruption()
        options.tell = TellParent(telling, acknowledged)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDINGS)
        return None
    os.close(telling)
    os.close(acknowledged)
    return _Watch(options, child, heard, acknowledging, seconds, gigabytes).wait()


def work_in_new_process(words: Sequence[str]) -> int:
    """Run a command for a program that goes on, in a new process; the exit status.

    What is printed there is written to this process's ``sys.stdout`` and ``sys.stderr``.
    """
    from subprocess import DEVNULL, PIPE
    from threading import Thread

    from nag.tracking.timed_call import start_python

    start = f"from nag.cli.command_line import main_for; sys.exit(main_for({os.getpid()}))"
    # As the text that is read from its pipes, whatever a terminal here takes.
    coding = os.environ | {"PYTHONIOENCODING": "utf-8"}
    process = start_python(start, *words, stdin=DEVNULL, stdout=PIPE, stderr=PIPE, env=coding)
    assert process.stdout is not None and process.stderr is not None
    pairs = (process.stdout, sys.stdout), (process.stderr, sys.stderr)
    passing = [Thread(target=_pass_on, args=pair, daemon=True) for pair in pairs]
    for each in passing:
        each.start()
    try:
        status = process.wait()
    except KeyboardInterrupt:
        # It says why it ends, in time.
        process.send_signal(signal.SIGINT)
        status = process.wait()
    finally:
        process.kill()
    for each in passing:
        each.join()
    return status if status >= 0 else 128 - status


def _pass_on(source: IO[bytes], target: TextIO) -> None:
    """Write what is read, as long as it is taken."""
    with contextlib.suppress(OSError, ValueError):
        for line in source:
            target.write(line.decode(errors="replace"))
            target.flush()


def leave_to_parent() -> None:
    """End an interrupted child at once: the parent says what there is to say."""
    os._exit(INTERRUPTED)


def end_with(parent: int) -> None:
    """Let this process be killed when its parent dies, where the system can."""
    if sys.platform == "linux":
        import ctypes

        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(_DEATH_SIGNAL, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(INTERRUPTED)


def _take_one_interruption() -> None:
    """Let the first SIGINT interrupt; a terminal and the parent may both send it."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        # What was started to ignore Ctrl-C does; the parent still may end it.
        return

    def interrupt(number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # An interruption inside of a callback of compiled code cannot be raised, only reported.
        sys.unraisablehook = lambda _: None
        raise KeyboardInterrupt

    signal.signal(signal.SIGINT, interrupt)


class _Watch:
    """A parent that waits for its child."""

    def __init__(
        self,
        options: argparse.Namespace,
        child: int,
        heard: int,
        acknowledging: int,
        seconds: float | None,
        gigabytes: float | None,
    ) -> None:
        self._options = options
        self._child = child
        self._heard = heard
        self._acknowledging = acknowledging
        self._seconds, self._gigabytes = seconds, gigabytes
        self._started = time.monotonic()
        self._kill_at = float("inf")
        self._why = ""
        self._printed = False
        self._status = INTERRUPTED
        self._rest = b""
        self._line = ProgressLine(sys.stderr, quiet=getattr(options, "quiet", True))

    def wait(self) -> int:
        """Wait for the child; the exit status."""
        woken, waking = os.pipe()
        os.set_blocking(waking, False)
        for number in (*_ENDINGS, signal.SIGCHLD):
            # Under nohup, or in the background of a script, some are to be ignored.
            if number == signal.SIGCHLD or signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, lambda *_: None)
        signal.set_wakeup_fd(waking)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDINGS)
        while True:
            sources = [woken] if self._heard < 0 else [woken, self._heard]
            ready, _, _ = select.select(sources, [], [], LOOK)
            if woken in ready:
                self._take(os.read(woken, 64))
            if self._heard in ready:
                self._hear()
            ended, status = os.waitpid(self._child, os.WNOHANG)
            if ended:
                return self._end(os.waitstatus_to_exitcode(status))
            self._look()

    def _take(self, numbers: bytes) -> None:
        for number in numbers:
            if number == signal.SIGINT:
                self._stop("interrupted", INTERRUPTED)
            elif number != signal.SIGCHLD:
                # As without a child: the process ends of the signal.
                os.kill(self._child, signal.SIGKILL)
                os.waitpid(self._child, 0)
                self._line.erase()
                self._say_what_is_kept()
                signal.signal(number, signal.SIG_DFL)
                os.kill(os.getpid(), number)

    def _hear(self) -> None:
        """Take what the child tells: a stage, done and total; or nothing, before it prints."""
        data = os.read(self._heard, 1 << 16)
        if not data:
            os.close(self._heard)
            self._heard = -1
        *told, self._rest = (self._rest + data).split(b"\n")
        for each in told:
            if each == PRINTED.encode():
                self._printed = True
            elif each:
                stage, done, total = each.decode().rsplit("\t", 2)
                self._line(stage, int(done), int(total))
            else:
                self._line.erase()
                with contextlib.suppress(OSError):
                    os.write(self._acknowledging, b"\n")

    def _look(self) -> None:
        """Look at the clock and at the memory, and show that there is life."""
        now = time.monotonic()
        if now >= self._kill_at:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self._child, signal.SIGKILL)
            return
        if self._seconds is not None and now - self._started >= self._seconds:
            self._stop(f"the time limit of {self._seconds:g} s is reached", INCOMPLETE)
        if self._gigabytes is not None and _memory_of(self._child) > self._gigabytes * _GIGABYTE:
            self._stop(f"the memory limit of {self._gigabytes:g} GB is reached", INCOMPLETE)
        self._line.show()

    def _stop(self, why: str, status: int) -> None:
        """Ask the child to end, once."""
        if self._why:
            return
        self._why, self._status = why, status
        self._kill_at = time.monotonic() + GRACE
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._child, signal.SIGINT)

    def _end(self, status: int) -> int:
        """The exit status, said why if the child did not come to its own end."""
        self._line.erase()
        killed = status < 0
        if killed:
            # Loaded by those alone who need it: this process is to start at once.
            from nag.files.written_file import remove_temporary

            for name in WRITTEN:
                target = getattr(self._options, name, None)
                if isinstance(target, str):
                    remove_temporary(target, self._child)
        if not killed and status != INTERRUPTED:
            # An answer in full has taken the place of what was kept; an error has not.
            self._say_what_is_kept()
            return status
        if self._why or not killed:
            _say(sys.stderr, self._last_words(self._why or "interrupted"))
            return self._status
        text = ", as when memory is short" if -status == signal.SIGKILL else ""
        _say(sys.stderr, f"the work was ended by {signal.Signals(-status).name}{text}")
        self._say_what_is_kept()
        return 128 - status

    def _say_what_is_kept(self) -> None:
        """Put what was found before another end than asked for where it is looked for."""
        target = getattr(self._options, "json", None)
        if take_unfinished(target):
            _say(sys.stderr, f"{target} {_KEPT}")

    def _last_words(self, why: str) -> str:
        """What is known of the work, and how to go on."""
        target = getattr(self._options, "json", None)
        words = [f"{why} after {time.monotonic() - self._started:.1f} s"]
        if self._line.stage:
            words.append(f" ({self._line.stage_text()})")
        if take_unfinished(target):
            kept = f"; {target} {_KEPT}"
        else:
            was = "as it was" if os.path.exists(target or "") else "not written"
            kept = "" if target is None else f"; {target} is {was}"
        folder = getattr(self._options, "resume", None)
        how = "the same command starts over"
        if "resume" in self._options:
            how += "; with --resume DIR it would go on"
        if folder is not None:
            how = f"the same command goes on with what {folder} holds"
        held = "what is printed above holds, " if self._printed else ""
        return "".join(words) + f"{kept}; {held}{how}"


def _memory_of(process: int) -> int:
    """Bytes of memory in use, 0 of a process that has ended."""
    try:
        with open(f"/proc/{process}/statm", encoding="ascii") as stream:
            return int(stream.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError):
        return 0


def _say(stream: TextIO, text: str) -> None:
    from nag.text.table import printable

    with contextlib.suppress(OSError, ValueError):
        stream.write(f"nag: {printable(text)}\n")
        stream.flush()
