"""Singular ends of paths, judged one by one or in blocks that are kept or shared.

Each has a generator of its own, drawn from its path: what is said of an end depends on no other one
and on no order.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.tracking import blocks

# Ends of a block.
BLOCK = 16


@dataclass(frozen=True, eq=False)
class EndJudgements:
    """Ends of paths that may be singular zeros of some equations.

    Attributes:
        equations: exact, in ``n`` variables.
        points: the ends, shape ``(P, n)``.
        accuracy: relative errors, shape ``(P,)``.
        limits: which are limits of branches, shape ``(P,)``: their coordinates vanish, or are known
            each by itself.
        paths: whose ends they are, shape ``(P,)``.
        most: how many zeros each may stand for at most, shape ``(P,)``; 0 where that is not known.
        key: what their generators are drawn from, besides.
    """

    equations: tuple[Polynomial, ...]
    points: np.ndarray
    accuracy: np.ndarray
    limits: np.ndarray
    paths: np.ndarray
    most: np.ndarray
    key: int
    _judged: dict[int, SingularEnd] = field(default_factory=dict)

    def judge(self, i: int) -> SingularEnd:
        """Where the end ``i`` lies."""
        if i not in self._judged:
            own = (column[i] for column in self._columns)
            self._judged[i] = _judge(self.equations, *own, key=self.key)
        return self._judged[i]

    @property
    def _columns(self) -> tuple[np.ndarray, ...]:
        return self.points, self.accuracy, self.limits, self.paths, self.most

    def judge_in_blocks(self, chosen: Sequence[int]) -> None:
        """Judge several ends where blocks are kept or shared (`nag.tracking.blocks.in_blocks`)."""
        parts = [np.array(chosen[k : k + BLOCK]) for k in range(0, len(chosen), BLOCK)]
        calls = [(self.equations, *(a[part] for a in self._columns), self.key) for part in parts]
        found = blocks.work_out(block_of_judgements, calls, "singular ends")
        for part, (arrays, _) in zip(parts, found, strict=True):
            ends = map(SingularEnd.from_parts, json.loads(arrays["ends"].tobytes()))
            self._judged.update(zip(part.tolist(), ends, strict=True))


def block_of_judgements(
    equations: Sequence[Polynomial],
    points: np.ndarray,
    accuracy: np.ndarray,
    limits: np.ndarray,
    paths: np.ndarray,
    most: np.ndarray,
    key: int,
    threads: int = 1,
) -> dict[str, np.ndarray]:
    """What is said of a block of ends, as JSON in an array of bytes; see `EndJudgements`."""
    columns = points, accuracy, limits, paths, most
    ends = [_judge(equations, *end, key=key) for end in zip(*columns, strict=True)]
    text = json.dumps([end.parts() for end in ends])
    return {"ends": np.frombuffer(text.encode(), dtype=np.uint8)}


def _judge(
    equations: Sequence[Polynomial],
    point: np.ndarray,
    accuracy: float,
    limit: bool,
    path: int,
    most: int,
    *,
    key: int,
) -> SingularEnd:
    rng = np.random.default_rng([key, int(path)])
    known = int(most) or None
    end = analyse(equations, point, float(accuracy), rng, most=known)
    if end.place is Place.UNDECIDED and limit:
        # Each coordinate's own error says more.
        end = analyse(equations, point, accuracy * np.abs(point), rng, most=known)
    return end
