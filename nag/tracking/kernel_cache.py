"""Compile kernels once, keep them on disk, and know whether that has been done."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numba


@cache
def _stamp() -> tuple[int, int]:
    """Stamp of all sources that kernels are made of: numba's cache knows of one file only."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return max(f.stat().st_mtime_ns for f in files), sum(f.stat().st_size for f in files)


@contextmanager
def _light_optimisation() -> Iterator[None]:
    """Registers are filled by hand: more optimisation takes longer and gains nothing measurable."""
    level, vectorize = numba.config.OPT, numba.config.LOOP_VECTORIZE
    numba.config.OPT, numba.config.LOOP_VECTORIZE = type(level)(1), 0
    try:
        yield
    finally:
        numba.config.OPT, numba.config.LOOP_VECTORIZE = level, vectorize


class Kernel:
    """A function compiled for one set of argument types.

    Args:
        dispatcher: the numba function, with ``cache=True``.
        example: gives arguments of the types to compile for.
    """

    def __init__(self, dispatcher: Any, example: Callable[[], tuple[Any, ...]]) -> None:
        self.dispatcher = dispatcher
        self.example = example
        self._signature: tuple[Any, ...] | None = None

    @property
    def signature(self) -> tuple[Any, ...]:
        """Types of the arguments."""
        if self._signature is None:
            self.dispatcher._cache._cache_file._source_stamp = _stamp()
            self._signature = tuple(numba.typeof(argument) for argument in self.example())
        return self._signature

    @property
    def compiled(self) -> bool:
        """Whether it is compiled already, here or on disk."""
        if self.dispatcher.signatures:
            return True
        cached = self.dispatcher._cache
        return cached.load_overload(self.signature, self.dispatcher.targetctx) is not None

    def __call__(self, *arguments: Any) -> Any:
        """Run it, compiled or loaded from disk first if need be."""
        self.prepare()
        return self.dispatcher(*arguments)

    def prepare(self) -> None:
        """Compile it, or load it from disk, if need be."""
        if not self.dispatcher.signatures:
            with _light_optimisation():
                self.dispatcher.compile(self.signature)
