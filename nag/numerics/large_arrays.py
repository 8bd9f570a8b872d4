"""Arrays that may be larger than memory: beyond some size they live in files without a name.

Such an array is used like any other. Its pages are read and written where they are asked for, and
the system takes them out of memory where it has no room; who has gone through one says so, and its
pages are left to the file. The files lie where temporary files do (`TMPDIR`), and are gone with the
process, however it ends.
"""

from __future__ import annotations

import mmap
import os
import tempfile
from math import prod

import numpy as np

# Bytes of an array from which on it is in a file.
LARGE = 1 << 24


def empty_array(shape: tuple[int, ...], dtype: np.dtype | type) -> np.ndarray:
    """An array whose entries are to be set, in a file if it is large.

    Where there is no room for a file, or the system cannot promise it, the array is in memory.
    """
    dtype = np.dtype(dtype)
    size = prod(shape) * dtype.itemsize
    # A page that finds no room on the disk when it is written would end the process.
    if size < LARGE or not hasattr(os, "posix_fallocate"):
        return np.empty(shape, dtype=dtype)
    try:
        with tempfile.TemporaryFile(prefix="nag-") as file:
            os.posix_fallocate(file.fileno(), 0, size)
            pages = mmap.mmap(file.fileno(), size)
    except OSError:
        return np.empty(shape, dtype=dtype)
    return np.frombuffer(pages, dtype=dtype).reshape(shape)


def full_array(shape: tuple[int, ...], value: float) -> np.ndarray:
    """An array of doubles all of whose entries are one value, in a file if it is large."""
    whole = empty_array(shape, float)
    whole.fill(value)
    leave_to_file(whole)
    return whole


def leave_to_file(*arrays: np.ndarray) -> None:
    """Take the pages of those arrays that are in files out of memory; nothing is lost."""
    for array in arrays:
        owner: object = array
        while isinstance(owner, np.ndarray | memoryview):
            owner = owner.base if isinstance(owner, np.ndarray) else owner.obj
        if isinstance(owner, mmap.mmap) and hasattr(mmap, "MADV_DONTNEED"):
            owner.madvise(mmap.MADV_DONTNEED)
