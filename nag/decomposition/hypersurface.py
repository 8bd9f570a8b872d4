"""Sets of all dimensions, by their points on a flag of slices, meet a hypersurface.

Where an equation f of degree m vanishes on a point of dimension d, the point stays; from the others
start the paths of ``f = u^m`` from the slice ``L_d = 0`` to ``u = 0``, m from each, which end at
the points of dimension d - 1 (Duff, Leykin & Rodriguez 2022).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.decomposition.roots import line, points_in_balls, zeros_on
from nag.numerics.doubles import ROUNDED
from nag.tracking.compiled import CompiledRows, compile_rows
from nag.tracking.homotopy import Homotopy
from nag.tracking.run import Run
from nag.tracking.track import track
from nag.witness.close_points import with_roots
from nag.witness.confirm import find_vanishing
from nag.witness.cutting import Cut, leading_power
from nag.witness.fibres import (
    Fibre,
    SliceEnds,
    ends_of_paths,
    homogeneous,
    join_ends,
    track_close_points,
)
from nag.witness.points import with_fine
from nag.witness.slices import pad_rows, unit_complex
from nag.witness.witness import PathCounts

# Slices to which points may have to be moved to get to another flag.
# Offsets of the flags tried later, as part of those of the first: slices nearer to the origin.
NEARER = 0.3
# Roots of a polynomial of higher degree are not found soon.
MOST_ROOTS = 64


@dataclass(frozen=True, eq=False)
class HypersurfaceSection:
    """What became of sets that met a hypersurface.

    Attributes:
        kept: points on the hypersurface, by dimension.
        ends: ends of the paths of the others, by dimension.
    """

    kept: Mapping[int, Sequence[Fibre]]
    ends: Mapping[int, Sequence[SliceEnds]]

    @property
    def counts(self) -> PathCounts:
        """Of these paths."""
        return sum((ends.counts for own in self.ends.values() for ends in own), PathCounts())

    @property
    def singular(self) -> int:
        """Number of finite ends that are not regular."""
        pieces = [ends for own in self.ends.values() for ends in own]
        return sum(int(np.sum(ends.finite & ~ends.regular)) for ends in pieces)

    def failed_to(self, d: int) -> int:
        """Number of paths to points of dimension ``d`` that failed."""
        return sum(int(ends.failed.sum()) for ends in self.ends.get(d, ()))


def intersect(
    fibre: Fibre, f: Polynomial, gamma: complex, run: Run, nonzero: Sequence[int] = ()
) -> SliceEnds:
    """The ends of the paths from a fibre's points, none of them on f, to the hypersurface f = 0.

    They are on all rows of the fibre's slice but the last one. Paths to where a variable of
    ``nonzero`` vanishes count as paths to infinity.
    """
    if fibre.fine:
        return _intersect_close(fibre, f, gamma, run, nonzero)
    cut, d, degree = fibre.cut, fibre.dimension, f.degree
    total, after = cut.n + cut.aux, cut.extended(f)
    if not cut.polynomials and len(fibre) == 1 and f.algebraic and degree <= MOST_ROOTS:
        found = _on_line(after, fibre.rows[:-1], nonzero)
        if found is not None:
            return found
    f = f * (1 / leading_power(f))
    compiled = _with_power(cut, f)
    columns = total + 2
    slices = pad_rows(fibre.rows, columns)
    a0, a1 = slices.copy(), np.zeros_like(slices)
    a0[d - 1] = 0
    a0[d - 1, -1] = 1
    a1[d - 1] = gamma * slices[d - 1] - a0[d - 1]
    values = f(fibre.x.T)
    roots = np.exp(2j * np.pi * np.arange(degree) / degree)
    u_start = (values.astype(complex) ** (1 / degree))[:, None] * roots[None, :]
    starts = np.concatenate(
        [np.repeat(fibre.points, degree, axis=0), u_start.reshape(-1, 1)], axis=1
    )
    infinity = (*compiled.infinity, *(1 + i for i in nonzero))
    homotopy, points = Homotopy(compiled, a0, a1, infinity=infinity), homogeneous(starts)
    paths = track(homotopy, points, settings=run.settings, threads=run.threads)
    return ends_of_paths(paths, after, fibre.rows[:-1])


def _on_line(cut: Cut, rows: np.ndarray, nonzero: Sequence[int]) -> SliceEnds | None:
    """The zeros of one polynomial on the line of the slices ``rows``, without paths.

    None where they cannot be told apart, or are not as many as its degree. A generic line meets the
    polynomial's zeros where a variable of ``nonzero`` vanishes just if that is a factor.
    """
    (f,) = cut.polynomials
    balls = zeros_on(f, line(rows))
    if balls is None:
        return None
    points = points_in_balls(cut, rows, balls)
    factors = [i for i in nonzero if all(exponents[i] for exponents in f.terms)]
    found = np.array([not any(ball[i].contains(0) for i in factors) for ball in balls])
    failed = np.zeros(len(points), dtype=bool)
    accuracy = np.full(len(points), ROUNDED)
    return SliceEnds(cut, rows, points.x, found, found, failed, accuracy, fine=points.fine)


def _with_power(cut: Cut, f: Polynomial) -> CompiledRows:
    """The equations of a cut and ``f = u^m``, with u as the last variable."""
    total = cut.n + cut.aux
    u = Polynomial.variable(total + 1, total)
    rows = [g.with_variables(total + 1, range(total)) for g in cut.polynomials]
    rows.append(f.with_variables(total + 1, range(cut.n)) - u**f.degree)
    return compile_rows(rows, n=total + 1)


def _intersect_close(
    fibre: Fibre, f: Polynomial, gamma: complex, run: Run, nonzero: Sequence[int]
) -> SliceEnds:
    """`intersect` where some points are close to others: their paths are tracked in more digits.

    The slices that stay turn with ``gamma`` as well, which leaves them as they are.
    """
    from nag.tracking.close_paths import moving_rows

    cut, d, degree = fibre.cut, fibre.dimension, f.degree
    total, after = cut.n + cut.aux, cut.extended(f)
    indices = np.array(sorted(fibre.fine))
    plain = np.setdiff1d(np.arange(len(fibre)), indices)
    rest = replace(fibre, points=fibre.points[plain], fine={})
    f = f * (1 / leading_power(f))
    source = pad_rows(fibre.rows, total + 2)
    target = source.copy()
    target[d - 1] = 0
    target[d - 1, -1] = 1
    starts = [start for i in indices for start in with_roots(fibre.fine[i], f)]
    homotopy = moving_rows(_with_power(cut, f), source, target, gamma)
    infinity = (*homotopy.infinity, *(1 + i for i in nonzero))
    homotopy = replace(homotopy, infinity=infinity)
    close = track_close_points(homotopy, starts, after, fibre.rows[:-1], run, endgame=True)
    places = {
        k: (own[:, None] * degree + np.arange(degree)).ravel()
        for k, own in enumerate((plain, indices))
    }
    return join_ends(places, (intersect(rest, f, gamma, run, nonzero), close))


def hypersurface_section(
    sets: Mapping[int, Sequence[Fibre]],
    f: Polynomial,
    rng: np.random.Generator,
    run: Run,
    nonzero: Sequence[int] = (),
) -> HypersurfaceSection:
    """All points of sets, by dimension, where ``f`` vanishes, and how many paths led there.

    Args:
        nonzero: variables that do not vanish at the zeros that are looked for; ends of paths where
            one does are left out.
    """
    gamma = complex(unit_complex(rng))
    kept: dict[int, list[Fibre]] = {}
    ends: dict[int, list[SliceEnds]] = {}
    for d in sorted(sets, reverse=True):
        own = [fibre for fibre in sets[d] if len(fibre)]
        for fibre in with_fine(own) if own else ():
            found = find_vanishing(fibre, f)
            # A point where that is left open is found out by the final checks.
            on = np.array([there is not False for there in found], dtype=bool)
            if on.any():
                kept.setdefault(d, []).append(fibre.only(on))
            if d > 0 and f.degree > 0 and not on.all():
                new = intersect(fibre.only(~on), f, gamma, run, nonzero)
                ends.setdefault(d - 1, []).append(new)
    return HypersurfaceSection(kept, ends)
