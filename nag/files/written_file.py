"""Files that a run writes: checked before the work is done, replaced in one step after it."""

from __future__ import annotations

import contextlib
import os
import stat
import uuid
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import BinaryIO

from nag.errors import InputError


class TargetError(InputError):
    """A file that cannot be written; the message is one line for the user."""


def _is_special(path: Path) -> bool:
    """Whether ``path`` is a device or a pipe, which is written to and never replaced."""
    try:
        mode = path.stat().st_mode
    except OSError:
        return False
    return not stat.S_ISREG(mode) and not stat.S_ISDIR(mode)


def _cannot_write(path: Path, error: OSError) -> TargetError:
    return TargetError(f"{path}: cannot be written: {error.strerror or error}")


def _temporary(path: Path) -> Path:
    return path.with_name(f".nag-{os.getpid()}-{uuid.uuid4().hex}.tmp")


def remove_temporary(path: str | os.PathLike[str], process: int) -> None:
    """Delete what a process that is no more had written in part, beside ``path``."""
    with contextlib.suppress(OSError, ValueError):
        for left in Path(path).resolve().parent.glob(f".nag-{process}-*.tmp"):
            left.unlink(missing_ok=True)


# What files of these endings hold; others say nothing.
HELD = {".json": "JSON", ".csv": "table", ".html": "page", ".npz": "arrays", ".parquet": "table"}
HELD |= {".toml": "case", ".urdf": "robot", ".xml": "robot", ".npy": "array"}
HELD |= dict.fromkeys((".svg", ".png", ".pdf"), "picture")


def ending_of(path: str | os.PathLike[str]) -> str:
    """The ending of a file's name, empty of a device or a pipe, whose name says nothing."""
    return "" if _is_special(Path(path)) else os.path.splitext(path)[1].lower()


def check_ending(path: str | os.PathLike[str], endings: Sequence[str]) -> None:
    """Refuse a file whose ending says that it holds something else.

    Args:
        endings: those of what is written, keys of `HELD`.

    Raises:
        TargetError: for another one.
    """
    ending = ending_of(path)
    if ending in HELD and ending not in endings:
        held = " and no ".join(dict.fromkeys(HELD[each] for each in endings))
        names = " or ".join(endings)
        raise TargetError(f"{path}: a file that ends in {ending} holds no {held}; name it {names}")


def check_target(path: str | os.PathLike[str]) -> None:
    """Find out now whether `write_target` could write ``path``; leaves no trace.

    Raises:
        TargetError: if it could not.
    """
    target = Path(path)
    try:
        if _is_special(target):
            return
        real = target.resolve()
        if real.is_dir():
            raise TargetError(f"{target}: is a directory; name a file")
        if not real.parent.is_dir():
            raise TargetError(f"{target}: there is no directory {target.parent}")
        if real.exists() and not os.access(real, os.W_OK):
            raise TargetError(f"{target}: cannot be written: Permission denied")
        trial = _temporary(real)
        with trial.open("x"):
            pass
        trial.unlink()
    except OSError as error:
        raise _cannot_write(target, error) from None
    except (ValueError, RuntimeError) as error:
        if isinstance(error, TargetError):
            raise
        raise TargetError(f"{target}: is not a file name: {error}") from None


Content = str | bytes | Iterable[str] | Callable[[BinaryIO], None]


def write_target(
    path: str | os.PathLike[str],
    content: Content,
    *,
    named: str | os.PathLike[str] | None = None,
) -> None:
    """Write a text, as UTF-8, or bytes to ``path`` through a temporary file beside it.

    A text may come in parts, each of which is written before the next one is asked for; or a
    function writes what it has to. Whoever reads ``path`` sees the old content or the new, never a
    part. A symbolic link stays a link; an existing file keeps its permissions; a device or a pipe
    is written to directly.

    Args:
        named: the file that errors name, if it is another one: that which the user gave.

    Raises:
        TargetError: if it cannot be written; the old content is then untouched.
    """
    target = Path(path)
    temporary = None
    try:
        if _is_special(target):
            # By its own name: what `/dev/stdout` leads to may have none.
            with target.open("wb") as stream:
                _write(stream, content)
            return
        real = target.resolve()
        temporary = _temporary(real)
        with temporary.open("xb") as stream:
            _write(stream, content)
            stream.flush()
            os.fsync(stream.fileno())
        with contextlib.suppress(FileNotFoundError):
            temporary.chmod(stat.S_IMODE(real.stat().st_mode))
        temporary.replace(real)
    except OSError as error:
        raise _cannot_write(target if named is None else Path(named), error) from None
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def _write(stream: BinaryIO, content: Content) -> None:
    if callable(content):
        content(stream)
        return
    parts = [content] if isinstance(content, bytes | str) else content
    stream.writelines(part.encode() if isinstance(part, str) else part for part in parts)
