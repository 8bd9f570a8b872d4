"""Homotopies H(x, t) in projective coordinates, tracked from t = 1 to t = 0."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from nag.errors import NagError
from nag.tracking.compiled import CompiledRows, SentByContent, blend

Factors = tuple[tuple[complex, complex], ...]


def _frozen(array: np.ndarray | None, shape: tuple[int, int]) -> np.ndarray:
    if array is None:
        array = np.zeros((max(shape[0], 0), shape[1]), dtype=np.complex128)
    else:
        array = np.array(array, dtype=np.complex128).reshape(shape)
    array.setflags(write=False)
    return array


def norms(points: np.ndarray) -> np.ndarray:
    """Euclidean norms of complex rows, shape ``(P,)``."""
    parts = np.ascontiguousarray(points, dtype=np.complex128).view(np.float64)
    return np.sqrt(np.einsum("ij,ij->i", parts, parts))


@dataclass(frozen=True, eq=False)
class Members:
    """Factors of a homotopy's parts that differ from path to path.

    Attributes:
        factors: of each member ``(a, b)`` of each part, whose factor is ``a + t b``, shape
            ``(M, parts, 2)``.
        rest: what ``a`` lacks of twice the digits of doubles, shape ``(M, parts)``.
    """

    factors: np.ndarray
    rest: np.ndarray


@dataclass(frozen=True, eq=False)
class Homotopy(SentByContent):
    """Polynomial rows, linear rows, and one patch for each group of coordinates.

    Attributes:
        rows: compiled polynomial rows; part ``p`` is multiplied by ``a + t b``,
            ``(a, b) = factors[p]``.
        A0, A1: linear rows ``(A0 + t A1) x``, complex, shape ``(k, N)``.
        factors: one pair for each part; default ``(1, 0)``: rows that do not depend on t.
        infinity: coordinates whose vanishing means that a point is at infinity, or, of a variable
            that vanishes at no zero of the target, that it counts as one that is.
        digits: decimal digits of the coefficients from which those of the rows were worked out
            exactly; None: they are the rows' own.
        members: factors instead of those, of many homotopies of the same rows, which are tracked
            together by `nag.tracking.track.track_members`, and by nothing else.

    The number of polynomial rows, linear rows and groups together is ``N``.
    """

    rows: CompiledRows
    A0: np.ndarray | None = None
    A1: np.ndarray | None = None
    factors: Factors = ()
    infinity: tuple[int, ...] | None = None
    digits: int | None = None
    members: Members | None = None
    _cache: dict[str, object] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        N = self.rows.N
        A0 = _frozen(self.A0, (-1, N))
        A1 = _frozen(self.A1, (len(A0) if self.A1 is None else -1, N))
        if A0.shape != A1.shape:
            raise NagError(f"A0 has {len(A0)} rows, A1 has {len(A1)}")
        object.__setattr__(self, "A0", A0)
        object.__setattr__(self, "A1", A1)
        factors = tuple(self.factors) or ((1.0, 0.0),) * self.rows.part_count
        if len(factors) < self.rows.part_count:
            raise NagError(f"{self.rows.part_count} pairs of factors are needed")
        object.__setattr__(self, "factors", tuple((complex(a), complex(b)) for a, b in factors))
        if self.infinity is None:
            object.__setattr__(self, "infinity", self.rows.infinity)
        if len(self.rows) + len(A0) + len(self.groups) != N:
            raise NagError(
                f"{len(self.rows)} polynomial rows, {len(A0)} linear rows and {len(self.groups)}"
                f" patches do not make {N} rows"
            )

    @property
    def N(self) -> int:
        """Number of coordinates."""
        return self.rows.N

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Groups of coordinates; points live in the product of their projective spaces."""
        return self.rows.groups

    @cached_property
    def group_of(self) -> np.ndarray:
        """Group of each coordinate, shape ``(N,)``."""
        group_of = np.zeros(self.N, dtype=np.int64)
        for g, indices in enumerate(self.groups):
            group_of[list(indices)] = g
        return group_of

    def normalized(self, points: np.ndarray) -> np.ndarray:
        """The same projective points with unit norm in each group, shape ``(P, N)``."""
        points = np.array(points, dtype=np.complex128).reshape(-1, self.N)
        if len(self.groups) == 1:
            return points / norms(points)[:, None]
        for indices in self.groups:
            block = points[:, list(indices)]
            points[:, list(indices)] = block / norms(block)[:, None]
        return points


def straight_line(
    start: CompiledRows,
    target: CompiledRows,
    gamma: complex,
    A0: np.ndarray | None = None,
    A1: np.ndarray | None = None,
) -> Homotopy:
    """``gamma t start + (1 - t) target``, with linear rows ``A0 + t A1`` besides.

    Raises:
        ValueError: if the systems differ in coordinates, groups, number or degrees of rows.
    """
    factors = ((0.0, gamma),) * start.part_count + ((1.0, -1.0),) * target.part_count
    return Homotopy(blend(start, target), A0, A1, factors)
