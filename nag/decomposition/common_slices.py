"""Points that were come by one by one, brought to a common slice for each dimension."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from nag.numerics.coincidence import coincident
from nag.numerics.small_values import ON
from nag.witness.cutting import Cut, Equations
from nag.witness.fibres import Fibre, Tracker, admit, move
from nag.witness.points import Points
from nag.witness.slices import random_rows, rows_through, unit_complex
from nag.witness.witness import PathCounts


@dataclass(frozen=True, eq=False)
class Start:
    """A solution through which there is a component to be found.

    Attributes:
        x: the solution, with its relative error.
        dimensions: those that the component may have; the first fits in which ``x`` is regular.
        deflate: whether deflation may make it regular.
    """

    x: np.ndarray
    accuracy: float
    dimensions: Iterable[int]
    deflate: bool


@dataclass(frozen=True, eq=False)
class CommonSlices:
    """Points of components on the leading rows of one flag of slices.

    Attributes:
        equations: those that hold on the components.
        flag: shape ``(n, 1 + n)``.
        points: by dimension.
        errors: relative errors of the points of each dimension, shape ``(P,)``.
    """

    equations: Equations
    flag: np.ndarray
    points: Mapping[int, Points]
    errors: Mapping[int, np.ndarray]

    @classmethod
    def random(cls, equations: Equations, rng: np.random.Generator) -> CommonSlices:
        """A generic flag, without points."""
        return cls(equations, random_rows(rng, equations.n, equations.n), {}, {})

    def with_point(self, cut: Cut, z: np.ndarray, d: int, error: float) -> tuple[CommonSlices, int]:
        """With a point of dimension ``d``, unless it is there, and its index."""
        known, errors = self.points.get(d, Points(self.flag[:d])), self.errors.get(d, np.zeros(0))
        there = coincident(known.x, z[: cut.n], np.maximum(errors, error))
        if there.any():
            return self, int(there.argmax())
        points = {**self.points, d: known.with_point(cut, z)}
        errors = {**self.errors, d: np.append(errors, error)}
        return replace(self, points=points, errors=errors), len(known)

    def with_start(
        self, start: Start, rng: np.random.Generator, tracker: Tracker
    ) -> tuple[CommonSlices, tuple[int, int] | None, PathCounts]:
        """With the point that a solution leads to, and its dimension and index.

        These are None if it led to no component; then nothing changes.
        """
        local = self._local(start, rng)
        if local is None:
            return self, None, PathCounts()
        fibre, rows = local
        d = fibre.dimension
        z, error, counts = fibre.points[0], start.accuracy, PathCounts()
        if d:
            gamma = complex(unit_complex(rng))
            ends = move(fibre, rows, self.flag[:d], gamma, tracker)
            z, error, counts = ends.points[0], float(ends.accuracy[0]), ends.counts.judged_elsewhere
            if not ends.regular.all():
                return self, None, counts
        # A cut that leaves out an equation which only seems to hold gives itself away elsewhere.
        if self._residual(z[: fibre.cut.n]) > ON:
            return self, None, counts
        slices, place = self.with_point(fibre.cut, z, d, error)
        return slices, (d, place), counts

    def _residual(self, x: np.ndarray) -> float:
        return float(self.equations.evaluator.residuals(x[None]).max(initial=0.0))

    def _local(self, start: Start, rng: np.random.Generator) -> tuple[Fibre, np.ndarray] | None:
        """A slice through a point, and the fibre that has it as a regular point there."""
        for d in start.dimensions:
            rows = rows_through(rng, d, start.x)
            cuts = self.points[d].cuts if d in self.points else ()
            fibres = [Fibre(c, d, np.zeros((0, c.n + c.aux), dtype=complex)) for c in cuts]
            if admit(start.x, start.accuracy, fibres, self.equations, rows, rng, start.deflate):
                (fibre,) = (f for f in fibres if len(f))
                return fibre, rows
        return None
