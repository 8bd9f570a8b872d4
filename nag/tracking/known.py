"""What is known of paths before they are tracked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.tracking.paths import Paths


@dataclass(frozen=True, eq=False)
class PathOrbits:
    """Paths that signed permutations of the coordinates carry into each other.

    Attributes:
        chosen: indices of the paths that stand for the others, one of each orbit, shape ``(R,)``.
        orbit: which of these stands for each path, shape ``(P,)``.
        sources, signs: coordinate ``i`` of path ``p`` is ``signs[p, i]`` times coordinate
            ``sources[p, i]`` of the path that stands for it, at every t; shapes ``(P, N)``.
    """

    chosen: np.ndarray
    orbit: np.ndarray
    sources: np.ndarray
    signs: np.ndarray

    def expand(self, paths: Paths, groups: Sequence[Sequence[int]]) -> Paths:
        """All paths, from those chosen; steps count where they were taken."""
        steps = np.zeros(len(self.orbit), dtype=paths.steps.dtype)
        steps[self.chosen] = paths.steps
        every = paths.select_rows(self.orbit).permute(self.sources, self.signs, groups)
        return replace(every, steps=steps)


@dataclass(frozen=True, eq=False)
class KnownOfPaths:
    """What a start system knows of its paths.

    Attributes:
        most: where it is known that the target, if it has so many regular zeros without zero
            coordinates, has no other zeros: once these are found, all other paths lead to
            infinity.
        orbits: paths that need not be tracked, as others are their images.
        bound: the target has no more isolated zeros, by multiplicity.
    """

    most: int | None = None
    orbits: PathOrbits | None = None
    bound: int | None = None


NOTHING = KnownOfPaths()
