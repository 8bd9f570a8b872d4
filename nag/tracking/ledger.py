"""A ledger: blocks of work that are done, kept on disk, so that a run that was ended is a rerun.

A block is a function's result for some arguments, and is found again by a digest of both, of nag's
own sources and of the processor. There is no other state: whoever asks the same again finds what is
done. A file appears whole or not at all, and one whose own digest is wrong counts as missing.
"""

from __future__ import annotations

import contextlib
import io
import os
import stat
import uuid
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from fractions import Fraction
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np

from nag.errors import InputError

# How a file begins; what follows are the digests of the block's content and of the rest, the rest.
MAGIC = b"nag block 1\n"
DIGEST = 32
# Seconds, by the folder's clock, after which a block that is still being written is nobody's: to
# write one takes less than one of them.
DEAD = 3600.0

Arrays = Mapping[str, np.ndarray]


@dataclass(eq=False)
class Ledger:
    """Blocks in a folder.

    Attributes:
        folder: which one; it is made if there is none.
        found, kept: how many blocks were found there, and how many were added.
        damaged: files that were not what they should be; their blocks are worked out again.
    """

    folder: Path
    found: int = 0
    kept: int = 0
    damaged: list[str] = field(default_factory=list)

    @classmethod
    def open(cls, folder: str | os.PathLike[str]) -> Ledger:
        """The ledger in a folder.

        Raises:
            nag.errors.InputError: if there cannot be one; one line.
        """
        path = Path(folder)
        try:
            path.mkdir(parents=True, exist_ok=True)
            trial = path / f"{uuid.uuid4().hex}.part"
            trial.touch()
            _clear_away(path, trial.stat().st_mtime - DEAD)
            trial.unlink()
        except OSError as error:
            raise InputError(
                f"{folder}: finished work cannot be kept there: {error.strerror}; name a folder"
            ) from None
        return cls(path)

    def find(self, key: bytes) -> dict[str, np.ndarray] | None:
        """The block of a key, if it is there and whole.

        Raises:
            nag.errors.InputError: if a folder has its name, which none can replace.
        """
        file = self._file(key)
        try:
            mode = file.stat().st_mode
            # To read a pipe or a device may never end.
            content = file.read_bytes() if stat.S_ISREG(mode) else b""
        except FileNotFoundError:
            return None
        except OSError:
            mode, content = 0, b""
        if stat.S_ISDIR(mode):
            raise InputError(f"{file}: is a folder, where a block is to be kept; remove it")
        arrays = _unpacked(content, key)
        if arrays is None:
            self.damaged.append(file.name)
            return None
        self.found += 1
        return arrays

    def keep(self, key: bytes, arrays: Arrays) -> None:
        """Add a block.

        Raises:
            nag.errors.InputError: if it cannot be written.
        """
        file = self._file(key)
        part = file.with_name(f"{file.name}.{uuid.uuid4().hex}.part")
        try:
            part.write_bytes(_packed(arrays, key))
            os.replace(part, file)
        except OSError as error:
            part.unlink(missing_ok=True)
            raise InputError(f"{self.folder}: a block cannot be kept: {error.strerror}") from None
        self.kept += 1

    @property
    def used(self) -> bool:
        """Whether it was asked for anything."""
        return bool(self.found or self.kept)

    @property
    def text(self) -> str:
        """What it was good for, in one line."""
        text = f"{self.found} blocks found, {self.kept} worked out"
        if self.damaged:
            text += f"; {len(self.damaged)} of these were damaged, as {self.damaged[0]}"
        return text

    def _file(self, key: bytes) -> Path:
        return self.folder / f"{key.hex()}.block"


def _clear_away(folder: Path, before: float) -> None:
    """Remove what was being written then, and never came to its name."""
    for part in folder.glob("*.part"):
        # Another run may do the same.
        with contextlib.suppress(OSError):
            if part.stat().st_mtime < before:
                part.unlink()


def _packed(arrays: Arrays, key: bytes) -> bytes:
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    content = key + stream.getvalue()
    return MAGIC + blake2b(content, digest_size=DIGEST).digest() + content


def _unpacked(content: bytes, key: bytes) -> dict[str, np.ndarray] | None:
    head, rest = len(MAGIC) + DIGEST, content[len(MAGIC) + DIGEST :]
    digest = blake2b(rest, digest_size=DIGEST).digest()
    if content[:head] != MAGIC + digest or rest[:DIGEST] != key:
        return None
    try:
        with np.load(io.BytesIO(rest[DIGEST:]), allow_pickle=False) as arrays:
            return {name: arrays[name] for name in arrays.files}
    except (ValueError, OSError, EOFError, zipfile.BadZipFile):
        return None


def key_of(function: Any, arguments: tuple[Any, ...]) -> bytes:
    """The digest of a function of nag's and of arguments, of which canonical bytes are made."""
    digest = blake2b(digest_size=DIGEST)
    digest.update(_origin())
    digest.update(f"{function.__module__}.{function.__qualname__}".encode())
    add_content(digest, arguments)
    return digest.digest()


@cache
def _origin() -> bytes:
    """Digest of nag's sources, of what compiles them, and of the processor."""
    from nag.machine_code.processor import compiler, processor

    digest = blake2b(digest_size=DIGEST)
    package = Path(__file__).parents[1]
    for file in sorted(package.rglob("*.py")):
        digest.update(file.relative_to(package).as_posix().encode())
        digest.update(file.read_bytes())
    digest.update(repr((compiler(), processor(), np.__version__)).encode())
    return digest.digest()


def add_content(digest: Any, value: Any) -> None:
    """Add a value to a digest: numbers, texts, arrays, and tuples, maps and dataclasses of these.

    A dataclass may have ``content_digest`` instead, which it works out once.

    Raises:
        TypeError: for anything else, which has no canonical bytes.
    """
    own = getattr(value, "content_digest", None)
    if own is not None:
        digest.update(own)
    elif isinstance(value, np.ndarray):
        digest.update(f"array {value.dtype.str} {value.shape}".encode())
        digest.update(np.ascontiguousarray(value).tobytes())
    elif value is None or isinstance(value, bool | int | float | complex | str | Fraction):
        digest.update(f"{type(value).__name__} {value!r};".encode())
    elif isinstance(value, tuple | list):
        digest.update(f"tuple {len(value)};".encode())
        for each in value:
            add_content(digest, each)
    elif isinstance(value, Mapping):
        digest.update(f"map {len(value)};".encode())
        for key, each in value.items():
            add_content(digest, key)
            add_content(digest, each)
    elif type(value).__name__ in ("fmpq", "fmpz"):
        digest.update(f"exact {value};".encode())
    elif isinstance(value, np.generic):
        add_content(digest, value.item())
    elif is_dataclass(value):
        digest.update(digest_of_fields(value))
    else:
        raise TypeError(f"{type(value).__name__} has no canonical bytes")


def digest_of_fields(value: Any) -> bytes:
    """The digest of a dataclass: of its name and its public fields."""
    digest = blake2b(digest_size=DIGEST)
    digest.update(f"{type(value).__module__}.{type(value).__qualname__};".encode())
    for each in fields(value):
        if not each.name.startswith("_"):
            add_content(digest, getattr(value, each.name))
    return digest.digest()
