"""Kernels: functions that are compiled once and kept on disk as object code.

The object code lies beside the sources, in ``__pycache__``, or, where that cannot be written, in
the user's cache folder. It bears a digest of all that it was made from, and one of itself.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from hashlib import blake2b
from pathlib import Path
from threading import RLock
from types import FunctionType, ModuleType
from typing import Any

from nag.machine_code.records import table

DIGEST = 32
_lock = RLock()
_listeners: list[Callable[[str], None]] = []


@contextlib.contextmanager
def compilations(listener: Callable[[str], None]) -> Iterator[None]:
    """Call ``listener`` with the name of every kernel before it is compiled inside the block."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


@cache
def _sources(package: str) -> bytes:
    """Digest of all that kernels of ``nag.<package>`` are made of."""
    digest = blake2b(digest_size=DIGEST)
    here = Path(__file__).parent
    for folder in (here, here.parent.joinpath(*package.split("."))):
        for file in sorted(folder.rglob("*.py")):
            digest.update(file.read_bytes())
    return digest.digest()


def _folders(function: FunctionType) -> list[Path]:
    """Where object code may lie, the first choice first."""
    chosen = os.environ.get("NAG_CACHE_DIR")
    if chosen:
        return [Path(chosen)]
    if sys.platform == "win32":
        users = Path(os.environ.get("LOCALAPPDATA", "~/AppData/Local"))
    elif sys.platform == "darwin":
        users = Path("~/Library/Caches")
    else:
        users = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache")
    beside = Path(function.__code__.co_filename).parent / "__pycache__"
    with contextlib.suppress(RuntimeError):
        return [beside, users.expanduser() / "nag"]
    return [beside]


class Kernel:
    """A function of records (see `nag.machine_code.records`), compiled when it is first needed.

    Args:
        function: the Python function; its arguments are annotated with records.
        package: the package below ``nag`` that all it is made of comes from, besides this one; the
            object code is kept on disk until a file of either changes. None: it is not kept.
        modules: what module is meant where the function, or one that it calls, refers to a module
            by one of these names: so one source serves several arithmetics.

    The function itself, called with the same records, does what the kernel does, slowly; for its
    memory to be checked as well see `nag.machine_code.plain`.
    """

    def __init__(
        self,
        function: FunctionType,
        package: str | None,
        modules: Mapping[str, ModuleType] | None = None,
    ) -> None:
        self.function = function
        self.package = package
        self.modules = dict(modules or {})
        self._call: Any = None
        self._loaded: Any = None

    def __call__(self, *records: Any) -> None:
        """Run it, compiled or loaded from disk first if need be.

        Args:
            records: NamedTuples, or tables made of them before.

        Raises:
            TypeError: if an array has not the type that its field says, or their number is wrong.
            KernelError: if it is to be compiled and something in it is not translated.
            ZeroDivisionError: if a whole number was divided by zero; it says in which file and
                line. What was written before stays.
        """
        if self._call is None:
            self.prepare()
        tables = [table(r) for r in records]
        failed = ctypes.c_int64()
        self._call(*(t.address for t in tables), ctypes.addressof(failed))
        if failed.value:
            from nag.machine_code.failures import message

            raise ZeroDivisionError(message(failed.value))

    def prepare(self) -> None:
        """Load it from disk, or compile it."""
        with _lock:
            if self._call is None:
                code = self._read() if self.package else None
                if code is None:
                    for listener in _listeners:
                        listener(self.function.__name__)
                    code = self._compile()
                    if self.package:
                        self._write(code)
                self._load(code)

    def _load(self, code: bytes) -> None:
        from nag.machine_code.processor import Loaded

        self._loaded = Loaded(code)
        count = self.function.__code__.co_argcount
        kind = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * (count + 1))
        self._call = kind(self._loaded.address)

    def _compile(self) -> bytes:
        from nag.machine_code.functions import Module
        from nag.machine_code.processor import object_code

        packages = (f"nag.{self.package}",) if self.package else ()
        return object_code(str(Module(self.function, self.modules, packages).ir))

    @property
    def _origin(self) -> bytes:
        from nag.machine_code.processor import compiler, processor

        digest = blake2b(_sources(self.package), digest_size=DIGEST)
        digest.update(repr((compiler(), processor(), sys.version)).encode())
        return digest.digest()

    @property
    def _file(self) -> str:
        from nag.machine_code.processor import processor

        kind = blake2b(repr(processor()).encode(), digest_size=4).hexdigest()
        name = ".".join([self.function.__name__, *(m.__name__ for m in self.modules.values())])
        return f"{self.function.__module__}.{name}-{kind}.kernel"

    def _read(self) -> bytes | None:
        for folder in _folders(self.function):
            try:
                content = (folder / self._file).read_bytes()
            except OSError:
                continue
            origin, digest = content[:DIGEST], content[DIGEST : 2 * DIGEST]
            code = content[2 * DIGEST :]
            if origin == self._origin and digest == blake2b(code, digest_size=DIGEST).digest():
                return code
        return None

    def _write(self, code: bytes) -> None:
        content = self._origin + blake2b(code, digest_size=DIGEST).digest() + code
        for folder in _folders(self.function):
            with contextlib.suppress(OSError):
                folder.mkdir(parents=True, exist_ok=True)
                part = folder / f"{self._file}.{os.getpid()}.part"
                try:
                    part.write_bytes(content)
                    part.replace(folder / self._file)
                except OSError:
                    part.unlink(missing_ok=True)
                    raise
                return
