"""NumPy's and SciPy's linear algebra in one thread, while something is worked out.

Matrices here are small, so that threads of its own cost more than they gain; and as sums would be
in another order, answers would depend on the machine.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import threadpool_limits

# What the libraries read, when they are loaded, of how many threads they are to have.
VARIABLES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")

_LOCK = threading.Lock()
# The calls that are inside of each other or side by side, the limits that were set for them, and
# whether SciPy's library, which is loaded when it is needed, was there for the last of these.
_inside = 0
_limits: list[threadpool_limits] = []
_with_scipy = False


@contextmanager
def one_thread() -> Iterator[None]:
    """Inside, linear algebra has one thread; behind the last such call it has as many as before."""
    global _inside
    with _LOCK:
        _inside += 1
        _limit()
    try:
        yield
    finally:
        with _LOCK:
            _inside -= 1
            while not _inside and _limits:
                _limits.pop().restore_original_limits()


def limit_scipy() -> None:
    """Called where SciPy's linear algebra has just been loaded."""
    with _LOCK:
        if _inside:
            _limit()


def _limit() -> None:
    global _with_scipy
    loaded = "scipy.linalg" in sys.modules
    if _limits and loaded == _with_scipy:
        return
    if all(os.environ.get(name) == "1" for name in VARIABLES):
        return
    from threadpoolctl import threadpool_limits

    _limits.append(threadpool_limits(1, user_api="blas"))
    _with_scipy = loaded
