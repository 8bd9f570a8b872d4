"""Simple zeros of extreme sizes, from the sizes of the coefficients.

Where two terms of each equation exceed all others by some powers of ten, at a point whose
coordinates have certain sizes, a zero lies near each zero of these binomials. The sizes at which
two terms of each equation are the largest are those of the mixed cells of the supports, lifted by
the logarithms of the coefficients: the tropical zeros. Such a zero is as near to its binomials'
zero as the other terms are small, however far out it is: what paths would be followed for through
a hundred powers of ten is a few steps of Newton's method here.

Reference:
    Avendano, Kogan, Nisse & Rojas, Metric estimates and membership complexity for Archimedean
    amoebae and tropical hypersurfaces, 2018.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.errors import StartError
from nag.numerics.double_newton import find_zeros
from nag.numerics.doubles import SHARPEST
from nag.numerics.scaling import magnitude, scaled_terms
from nag.numerics.singular_point import Place, SingularEnd, analyse
from nag.solving.start.mixed_cells import LARGEST_LIFT, MixedCells, mixed_cells
from nag.solving.start.polyhedral import binomial_solutions, cell_vectors

# Units of a lifting value in a factor of 2, at most, and random ones that make it generic.
UNITS, RANDOM = 4096, 32
# Sizes that doubles hold, powers of them included, as powers of 2.
LARGEST = 900
# Newton's method may lead so far from the binomials' zero, in each coordinate's size.
NEAR = 0.5
# Decides: Relative distance, beyond those errors, of a zero of extreme size from all that were
# found: nearer ones are for paths to find.
APART = 1e-3


@dataclass(frozen=True, eq=False)
class TropicalZero:
    """A simple zero.

    Attributes:
        point: shape ``(n,)``.
        end: what is known of it, in coordinates of about size one.
        residual: largest value of an equation over the sum of the sizes of its terms.
        scales: the powers of two over which those coordinates are.
    """

    point: np.ndarray
    end: SingularEnd
    residual: float
    scales: np.ndarray


def tropical_zeros(
    polynomials: Sequence[Polynomial],
    known: np.ndarray,
    errors: np.ndarray,
    rng: np.random.Generator,
    least: float = 0.0,
) -> list[TropicalZero]:
    """Zeros near those of a cell's binomials that are none of the known ones.

    Args:
        polynomials: ``n`` in ``n`` variables; nothing is found if they are not rational.
        known: zeros, shape ``(k, n)``.
        errors: how far from the exact ones their coordinates may be, shape ``(k,)``.
        least: binary logarithm of a coordinate, or of its inverse, that a zero must have.
    """
    if any(len(f.terms) < 2 or not f.exact for f in polynomials):
        return []
    found: list[TropicalZero] = []
    for logs, angles in _binomial_zeros(polynomials, rng):
        scales = np.rint(logs).astype(np.int64)
        if not least <= np.abs(scales).max() <= LARGEST:
            continue
        start = np.exp2(logs - scales) * np.exp(1j * angles)
        apart = _is_apart(start * np.exp2(scales), known, errors)
        zero = _zero(polynomials, scales, start, rng) if apart else None
        if zero is None or not _is_apart(zero.point, known, errors):
            continue
        if all(_are_two(zero.point, other.point) for other in found):
            found.append(zero)
    return found


def _binomial_zeros(
    polynomials: Sequence[Polynomial], rng: np.random.Generator
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Binary logarithms of the sizes of the coordinates, and their angles; shape ``(n,)`` each."""
    supports = [np.array(list(f.terms), dtype=np.int64) for f in polynomials]
    logs = [np.array([magnitude(c) for c in f.terms.values()]) for f in polynomials]
    try:
        cells = mixed_cells(supports, rng, _lifts(logs, rng))
        signs = [np.array([1.0 if c > 0 else -1.0 for c in f.terms.values()]) for f in polynomials]
        angles, owners = binomial_solutions(cells, signs)
    except StartError:
        return
    sizes = _sizes(cells, logs)
    for angle, owner in zip(angles, owners.tolist(), strict=True):
        yield sizes[owner], angle


def _lifts(logs: Sequence[np.ndarray], rng: np.random.Generator) -> list[np.ndarray]:
    """Lifting values of the terms: the larger a coefficient, the lower."""
    spread = max(float(own.max() - own.min()) for own in logs)
    units = min(UNITS, (LARGEST_LIFT - 2 * RANDOM) / max(spread, 1.0))
    return [units * (own.max() - own) + RANDOM * rng.random(len(own)) for own in logs]


def _sizes(cells: MixedCells, logs: Sequence[np.ndarray]) -> np.ndarray:
    """Binary logarithms of the coordinates' sizes at the zeros of each cell's binomials."""
    rises = [own[cells.edges[:, i, 0]] - own[cells.edges[:, i, 1]] for i, own in enumerate(logs)]
    vectors = cell_vectors(cells).astype(float)
    return np.linalg.solve(vectors, np.stack(rises, axis=1)[:, :, None])[:, :, 0]


def _zero(
    polynomials: Sequence[Polynomial],
    scales: np.ndarray,
    start: np.ndarray,
    rng: np.random.Generator,
) -> TropicalZero | None:
    """The simple zero near ``start``, in variables over the powers of two ``scales``."""
    n = len(start)
    scaled = [Polynomial(n, scaled_terms(f, scales)) for f in polynomials]
    evaluator = Evaluator.of(scaled, n)
    slopes = evaluator.placed_derivatives(n)
    ends = find_zeros(lambda y, _: (evaluator.values(y), slopes(y)), start[None])
    (y,) = ends.x
    if not ends.converged[0] or not (np.abs(y - start) < NEAR * np.abs(start)).all():
        return None
    end = analyse(scaled, y, SHARPEST, rng)
    if end.place is not Place.ISOLATED or end.multiplicity != 1:
        return None
    residual = float(evaluator.residuals(end.point[None]).max())
    return TropicalZero(end.point * np.exp2(scales), end, residual, scales)


def _is_apart(x: np.ndarray, known: np.ndarray, errors: np.ndarray) -> bool:
    """Whether a point is none of the known ones, nor its distance explained by their errors."""
    distance = np.abs(known - x).max(axis=1, initial=0.0)
    return bool((distance > np.maximum(errors, APART * np.abs(x).max())).all())


def _are_two(x: np.ndarray, y: np.ndarray) -> bool:
    """Whether points that are known to rounding in each coordinate are certainly two."""
    return bool((np.abs(x - y) > APART * np.maximum(np.abs(x), np.abs(y))).any())
