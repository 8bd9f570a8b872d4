"""The way back: from reduced coordinates to the original ones, from an orbit to its components."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.elimination import Elimination
from nag.algebra.symmetry import SignedPermutation
from nag.numerics.doubles import EPS
from nag.numerics.natural_coordinates import NaturalCoordinates
from nag.witness.close_points import PointInWords
from nag.witness.cutting import Cut
from nag.witness.fibres import Fibre
from nag.witness.witness import Decomposition, Slice, WitnessSet


@dataclass(frozen=True, eq=False)
class Frame:
    """How reduced coordinates sit in the original ones: ``x = T y + t``.

    Attributes:
        positions: the original coordinate that each y is, but for its scale and its origin.
        scales: ``x = scale * y + t`` for these.
        exact: whether ``x = scale * y`` rounds nothing: powers of two about the same origin.
    """

    T: np.ndarray
    t: np.ndarray
    positions: tuple[int, ...]
    scales: np.ndarray
    exact: bool = True

    @classmethod
    def of(cls, elimination: Elimination, natural: NaturalCoordinates | None = None) -> Frame:
        """The frame of what elimination leaves, in ``natural`` coordinates if they are others."""
        m = elimination.system.n
        T = np.zeros((len(elimination.images), m))
        t = np.zeros(len(elimination.images))
        for i, image in enumerate(elimination.images):
            for exponents, coefficient in image.terms.items():
                if any(exponents):
                    T[i, exponents.index(1)] = float(coefficient)
                else:
                    t[i] = float(coefficient)
        names = elimination.original_variables
        positions = tuple(names.index(v) for v in elimination.system.variables)
        if natural is None or natural.is_identity:
            return cls(T, t, positions, np.ones(m))
        units = np.array([float(s) for s in natural.scales])
        t = units * t + np.array([float(b) for b in natural.origin])
        scales = units[list(positions)]
        return cls(units[:, None] * T, t, positions, scales, natural.is_exact_in_doubles)

    def scaled(self, scales: np.ndarray) -> Frame:
        """The frame of new coordinates, ``scales`` times smaller, powers of two."""
        return replace(self, T=self.T * scales, scales=self.scales * scales)

    @property
    def is_plain(self) -> bool:
        """Whether the coordinates are original ones as they are."""
        return self.exact and bool((self.scales == 1).all())

    def points(self, y: np.ndarray) -> np.ndarray:
        return y @ self.T.T + self.t

    def coordinates(self, x: np.ndarray) -> np.ndarray:
        """The reduced coordinates of original points, the last axis theirs."""
        kept = list(self.positions)
        return (x[..., kept] - self.t[kept]) / self.scales

    def error(self, y: np.ndarray, accuracy: float) -> float:
        """The largest error of `points`, relative to ``1 + |x|``, where y has that one to its size.

        Sums that cancel lose digits.
        """
        off = accuracy * (1 + np.linalg.norm(y, axis=1))
        rounding = EPS * (np.abs(y) @ np.abs(self.T).T + np.abs(self.t))
        moved = off[:, None] * np.linalg.norm(self.T, axis=1) + rounding
        sizes = 1 + np.linalg.norm(self.points(y), axis=1)
        return float((np.linalg.norm(moved, axis=1) / sizes).max(initial=EPS))

    def slice(self, rows: np.ndarray) -> Slice:
        """A slice of the reduced space as one of the original space: its coordinates are kept.

        Nothing is rounded but by another origin: where coordinates are scaled, rows are of norms
        about one, and no more orthonormal, which would leave nothing of their entries for the
        largest coordinates.
        """
        A = np.zeros((len(rows), len(self.t)), dtype=complex)
        A[:, self.positions] = rows[:, 1:] / self.scales
        b = -rows[:, 0]
        if not self.exact:
            b = b + A @ self.t
        if not self.is_plain:
            powers = -np.frexp(np.linalg.norm(A, axis=1))[1]
            A, b = A * np.ldexp(1.0, powers)[:, None], b * np.ldexp(1.0, powers)
        return Slice(A, b)

    def pulled_back(self, A: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Rows on reduced homogeneous coordinates for ``A x = b``."""
        return np.hstack([(A @ self.t - b)[:, None], A @ self.T])


def image(component: WitnessSet, symmetry: SignedPermutation) -> WitnessSet:
    """The witness set that a symmetry carries a component to, on the image of its slice.

    Exact: coordinates are exchanged and change sign, nothing is computed.
    """
    cut = Slice(symmetry.of_point(component.slice.A), component.slice.b)
    points = symmetry.of_point(component.points)
    fibres = tuple(_image(fibre, symmetry, cut.rows) for fibre in component.fibres)
    radii = np.abs(symmetry.of_point(component.radii))
    return replace(
        component, slice=cut, points=points, radii=radii, orbit=1, images=(), fibres=fibres
    )


def _image(fibre: Fibre, symmetry: SignedPermutation, rows: np.ndarray) -> Fibre:
    """A fibre on the image ``rows`` of its slice, added unknowns left as they are."""
    n, aux = fibre.cut.n, fibre.cut.aux
    back = symmetry.inverse
    whole = SignedPermutation((*back.sources, *range(n, n + aux)), (*back.signs, *([1] * aux)))
    polynomials = tuple(whole.of_polynomial(f) for f in fibre.cut.polynomials)
    points = np.hstack([symmetry.of_point(fibre.x), fibre.points[:, n:]])
    fine = {i: _image_of_fine(each, symmetry, n) for i, each in fibre.fine.items()}
    return Fibre(Cut(n, aux, polynomials), rows, points, fine)


def _image_of_fine(point: PointInWords, symmetry: SignedPermutation, n: int) -> PointInWords:
    moved = np.moveaxis(symmetry.of_point(np.moveaxis(point.words[:n], 0, -1)), -1, 0)
    return PointInWords(np.concatenate([moved, point.words[n:]]), point.curvature)


def count_expanded(component: WitnessSet) -> int:
    """How many components `expand_orbits` makes of one: its orbit, if its symmetries are known."""
    return component.orbit if len(component.images) == component.orbit - 1 else 1


def expand_orbits(decomposition: Decomposition) -> Decomposition:
    """The same decomposition with all components of each orbit, every one on a slice of its own.

    Orbits whose symmetries are not known are left as they are.
    """
    components: list[WitnessSet] = []
    for component in decomposition.components:
        if count_expanded(component) < component.orbit:
            components.append(component)
            continue
        components.append(replace(component, orbit=1, images=()))
        components += [image(component, symmetry) for symmetry in component.images]
    return replace(decomposition, components=tuple(components))
