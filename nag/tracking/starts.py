"""Start points by index: what a formula gives need not be in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

# Points are worked out so many at once, always the same ones together: products of matrices round
# otherwise in other company.
TOGETHER = 1024


@dataclass(frozen=True, eq=False)
class StartsByIndex:
    """Start points that are worked out when they are asked for.

    They are read as an array is: by a slice or an array of indices, whole by ``np.asarray``.

    Attributes:
        shape: ``(P, N)``.
        make: the points with some indices that follow each other, shape ``(k, N)``.
    """

    shape: tuple[int, int]
    make: Callable[[np.ndarray], np.ndarray]

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, rows: slice | np.ndarray) -> np.ndarray:
        indices = np.arange(len(self))[rows]
        found = np.empty((len(indices), self.shape[1]), dtype=np.complex128)
        for first, places in _by_company(indices):
            points = self.make(np.arange(first, min(first + TOGETHER, len(self))))
            found[places] = points[indices[places] - first]
        return found

    def __array__(
        self, dtype: np.dtype[np.generic] | None = None, copy: bool | None = None
    ) -> np.ndarray:
        return np.asarray(self[:], dtype=dtype)


def _by_company(indices: np.ndarray) -> Iterator[tuple[int, np.ndarray]]:
    """The first index of those that are worked out together, and which places ask for some."""
    company = indices // TOGETHER
    order = np.argsort(company, kind="stable")
    for places in np.split(order, np.flatnonzero(np.diff(company[order])) + 1):
        if len(places):
            yield int(company[places[0]]) * TOGETHER, places
