"""Kernels: functions that are compiled once and kept on disk as object code.

The object code lies beside the sources, in ``__pycache__``, or, where that cannot be written, in
the user's cache folder. It bears a digest of all that it was made from, and one of itself.

What it was made from is told by Python's own code of the functions that it reaches, and the numbers
that they name, as they are in this process: no file is read for it, and neither comments nor
docstrings count. The compiler's own files are told by their bytes, as they need not be loaded.
"""

from __future__ import annotations

import contextlib
import ctypes
import opcode
import os
import sys
from collections.abc import Callable, Iterator
from functools import cache
from hashlib import blake2b
from pathlib import Path
from threading import RLock
from types import CodeType, FunctionType, ModuleType
from typing import Any, get_type_hints

from nag.machine_code.records import record, table

DIGEST = 32
_MACHINE_CODE = __name__.rpartition(".")[0]
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
def _compiler_files() -> bytes:
    """Digest of this package."""
    digest = blake2b(digest_size=DIGEST)
    for file in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(file.read_bytes())
    return digest.digest()


def _instructions(code: CodeType) -> tuple[Any, ...]:
    """What a function does, without its docstring and where it stands."""
    operations, numbers = code.co_code[::2], bytearray(code.co_code[1::2])
    used = []
    for k, operation in enumerate(operations):
        if operation in opcode.hasconst:
            used.append(code.co_consts[numbers[k]])
            numbers[k] = 0
    named = code.co_names, code.co_varnames, code.co_argcount
    return operations, bytes(numbers), repr(used), *named


class _Origin:
    """Digest of functions and constants that a kernel reaches; ``met`` are those that it has."""

    def __init__(self) -> None:
        self.digest = blake2b(digest_size=DIGEST)
        self.met: dict[int, Any] = {}

    def add(self, name: str, value: Any, names: tuple[str, ...] = ()) -> None:
        """Add what a name stands for; of a module, what it has under some of ``names``."""
        if isinstance(value, bool | int | float | complex):
            self.digest.update(f"{name} = {value!r}".encode())
            return
        known = id(value) in self.met and not isinstance(value, ModuleType)
        self.digest.update(f"{name}: {known}".encode())
        if known:
            return
        self.met[id(value)] = value
        if isinstance(value, ModuleType):
            for attribute in names:
                if attribute in vars(value):
                    self.add(f"{name}.{attribute}", vars(value)[attribute], names)
        elif isinstance(value, FunctionType) and not _is_told_otherwise(value.__module__):
            self.digest.update(repr(_instructions(value.__code__)).encode())
            for attribute in value.__code__.co_names:
                if attribute in value.__globals__:
                    found = value.__globals__[attribute]
                    self.add(attribute, found, value.__code__.co_names)

    def add_constant(self, value: Any) -> None:
        """Add an object with all of its attributes, and the methods of its classes."""
        self.add(str(value), value)
        for owner in type(value).__mro__[:-1]:
            for name, method in sorted(vars(owner).items()):
                plain = method.__func__ if isinstance(method, staticmethod) else method
                plain = plain.fget if isinstance(plain, property) else plain
                if isinstance(plain, FunctionType) and not name.startswith("__"):
                    self.add(name, plain)
        for name, part in sorted(vars(value).items()):
            if isinstance(part, bool | int | float | complex | str):
                self.digest.update(f"{name} = {part!r}".encode())
            else:
                self.add_constant(part)


def _is_told_otherwise(module: str) -> bool:
    """Whether functions of a module are this package's, or a library's, and not looked into."""
    return module.startswith(f"{_MACHINE_CODE}.") or module.partition(".")[0] in ("numpy", "math")


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
        function: the Python function; arguments that are not constant are annotated with records.
        constants: its first arguments in every call, objects whose attributes and methods do not
            change, as an arithmetic is: the object code is for these.
        keep: whether the object code is kept on disk, until anything that it is made of changes.

    The function itself, called with the constants and the same records, does what the kernel does,
    slowly; for its memory to be checked as well see `nag.machine_code.plain`.
    """

    def __init__(self, function: FunctionType, *constants: Any, keep: bool = True) -> None:
        self.function = function
        self.constants = constants
        self.keep = keep
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
                function. What was written before stays.
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
                code = self._read() if self.keep else None
                if code is None:
                    for listener in _listeners:
                        listener(self.function.__name__)
                    code = self._compile()
                    if self.keep:
                        self._write(code)
                self._load(code)

    def _load(self, code: bytes) -> None:
        from nag.machine_code.processor import Loaded

        self._loaded = Loaded(code)
        count = self.function.__code__.co_argcount - len(self.constants)
        kind = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * (count + 1))
        self._call = kind(self._loaded.address)

    def _compile(self) -> bytes:
        from nag.machine_code.functions import Module
        from nag.machine_code.processor import object_code

        return object_code(str(Module(self.function, self.constants).ir))

    @property
    def name(self) -> str:
        """The function's name, and what it is compiled for."""
        return ".".join([self.function.__name__, *map(str, self.constants)])

    @property
    def _origin(self) -> bytes:
        """Digest of all that the object code is made from."""
        from nag.machine_code.processor import compiler, processor

        origin = _Origin()
        origin.add(self.name, self.function)
        for value in self.constants:
            origin.add_constant(value)
        kinds = [record(kind) for kind in self._records]
        made_by = compiler(), processor(), sys.version, _compiler_files()
        origin.digest.update(repr((kinds, made_by)).encode())
        return origin.digest.digest()

    @property
    def _records(self) -> list[type]:
        """The classes of the records."""
        hints, code = get_type_hints(self.function), self.function.__code__
        names = code.co_varnames[len(self.constants) : code.co_argcount]
        return [hints[name] for name in names]

    @property
    def _file(self) -> str:
        from nag.machine_code.processor import processor

        kind = blake2b(repr(processor()).encode(), digest_size=4).hexdigest()
        return f"{self.function.__module__}.{self.name}-{kind}.kernel"

    def _read(self) -> bytes | None:
        expected = self._origin
        for folder in _folders(self.function):
            try:
                content = (folder / self._file).read_bytes()
            except OSError:
                continue
            origin, digest = content[:DIGEST], content[DIGEST : 2 * DIGEST]
            code = content[2 * DIGEST :]
            if origin == expected and digest == blake2b(code, digest_size=DIGEST).digest():
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
