"""A call that is ended at a time limit, whatever it is doing.

A call into FLINT, SciPy or compiled code holds the interpreter for as long as it takes, so that no
thread or signal ends it. It is made in a new process, which tells of progress and of what it has
found; that process is killed when the time is over. It is started anew and not forked, as forks of
a process with threads may hang, and it does not import the caller's main module again, as the
processes of `multiprocessing` do. (A command in a process of its own forks before there are
threads, which is cheaper: `nag.cli.watched`. Commands that a program calls are started as this is.)
"""

from __future__ import annotations

import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING, Any, BinaryIO

from nag.errors import NagError, TimeLimitError

if TYPE_CHECKING:
    from nag.tracking.run import Run


def start_python(statement: str, *words: str, **streams: Any) -> subprocess.Popen[bytes]:
    """A new process of this Python that imports what this one does, and runs a statement.

    Args:
        words: its ``sys.argv[1:]``.
        streams: as of `subprocess.Popen`.

    Raises:
        NagError: if this Python has no program that could be started.
    """
    if not sys.executable:
        raise NagError("time_limit: this Python has no program to start; leave it out")
    path = [os.fspath(folder) for folder in sys.path]
    code = f"import sys; sys.path[:] = {path!r}; {statement}"
    return subprocess.Popen([sys.executable, "-c", code, *words], **streams)


def call_within(
    function: Callable[..., Any],
    given: Sequence[Any],
    named: Mapping[str, Any],
    run: Run,
    answers_early: bool,
) -> Any:
    """What a public function returns, called with ``run`` in a process of its own.

    Args:
        given, named: its arguments but the run.
        run: with a time limit; how long the process takes to start counts.
        answers_early: whether what the function tells by ``run.found`` is an answer to what it is
            asked, though an incomplete one.

    Raises:
        TimeLimitError: if the time is over, unless there is such an answer.
        NagError: if an argument cannot be sent to a process.
    """
    limit = run.time_limit
    assert limit is not None
    deadline = time.monotonic() + limit
    sent = _payload(function, given, named, run)
    start = "from nag.tracking.timed_call import work; work()"
    child = start_python(start, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdin is not None and child.stdout is not None
    heard: queue.SimpleQueue[tuple[str, Any] | None] = queue.SimpleQueue()
    threading.Thread(target=_send, args=(child.stdin, sent), daemon=True).start()
    threading.Thread(target=_take_messages, args=(child.stdout, heard), daemon=True).start()
    found = None
    try:
        while True:
            try:
                message = heard.get(timeout=max(0.0, deadline - time.monotonic()))
            except queue.Empty:
                break
            kind, value = ("ended", None) if message is None else message
            if kind == "progress":
                run.tell(*value)
            elif kind == "found":
                found = value
                if run.found is not None:
                    run.found(value)
            elif kind == "error":
                raise value
            elif kind == "result":
                return value
            elif kind == "ended":
                raise NagError(f"the work was ended from outside, with status {child.wait()}")
    finally:
        child.kill()
        child.wait()
    if found is not None and answers_early:
        return found
    what = "nothing was found by then" if found is None else "`found` of this error has a part"
    raise TimeLimitError(f"time_limit: {limit:g} s are over; {what}", found)


def _payload(
    function: Callable[..., Any], given: Sequence[Any], named: Mapping[str, Any], run: Run
) -> bytes:
    """What the process is to do, as bytes."""
    if run.executor is not None and not isinstance(run.executor, str):
        raise NagError("executor: an object cannot go with time_limit; give the name of one")
    plain = replace(run, time_limit=None, progress=None, found=None)
    asked = (function.__module__, function.__qualname__, tuple(given), dict(named), plain)
    try:
        return pickle.dumps((*asked, run.progress is not None))
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise NagError(f"time_limit: what is given cannot be sent to a process: {error}") from None


def _send(stream: BinaryIO, data: bytes) -> None:
    """Write what is to be done; the stream stays open for as long as somebody waits."""
    try:
        stream.write(data)
        stream.flush()
    except (OSError, ValueError):
        # The process has ended, which the listener says.
        return


def _take_messages(stream: BinaryIO, heard: queue.SimpleQueue[tuple[str, Any] | None]) -> None:
    """Take what the process tells; None when it has ended."""
    try:
        while True:
            heard.put(pickle.load(stream))
    except (EOFError, OSError, ValueError, pickle.UnpicklingError):
        heard.put(None)


def work() -> None:
    """In the process: do what is asked on standard input, and tell on standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    telling = os.fdopen(os.dup(1), "wb")
    # What anything else prints goes elsewhere.
    os.dup2(2, 1)
    module, path, given, named, run, shows_progress = pickle.load(sys.stdin.buffer)
    threading.Thread(target=_end_with_parent, daemon=True).start()

    def tell(kind: str, value: Any) -> None:
        pickle.dump((kind, value), telling)
        telling.flush()

    def progress(*told: Any) -> None:
        tell("progress", told)

    function: Any = import_module(module)
    for name in path.split("."):
        function = getattr(function, name)
    watched = replace(
        run,
        found=lambda answer: tell("found", answer),
        progress=progress if shows_progress else None,
    )
    try:
        tell("result", function(*given, **named, run=watched))
    except Exception as error:
        tell("error", _sendable(error))


def _sendable(error: Exception) -> Exception:
    """The error, or one that says the same, if it does not survive the way."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        kind = NagError if isinstance(error, NagError) else RuntimeError
        return kind(str(error))
    return error


def _end_with_parent() -> None:
    """End when nobody waits any more: the parent holds the other end of standard input."""
    sys.stdin.buffer.read()
    os._exit(1)
