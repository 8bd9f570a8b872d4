"""Closures of coordinate projections, by pseudo-witness sets (Hauenstein & Sommese 2010).

The dimension of the closure of the image is the rank of the projection on the tangent space at a
generic point. A slice of as many equations in the image's coordinates, and of further ones in all
coordinates, then meets the component in ``degree`` times ``fibre_degree`` points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.from_python import variable_indices
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError, NagError
from nag.numerics.coincidence import clusters
from nag.numerics.double_ranks import matrix_corank
from nag.numerics.doubles import EPS, ROUGH
from nag.numerics.read_only import ComplexArray, equal_values, fixed_array
from nag.text.table import one_line
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import (
    carry_component,
    carry_points,
    coordinates_of,
)
from nag.witness.component_equations import component_fibres
from nag.witness.exact_points import SharpPoints
from nag.witness.fibres import Fibre
from nag.witness.given_component import check_component
from nag.witness.moving import move_and_sharpen
from nag.witness.slices import random_rows, to_slice
from nag.witness.witness import Slice, WitnessSet, relative_errors

# Slices on which the numbers of points must agree.
SLICES = 2


class ProjectionError(ComponentError):
    """A projection that could not be determined, with the reason."""


@dataclass(frozen=True, eq=False)
class Projection:
    """The closure of the image of a component under a projection to coordinates.

    Attributes:
        coordinates: indices of the variables that are projected to.
        dimension: dimension of the closure.
        degree: its degree, in these coordinates.
        fibre_dimension: dimension of the generic fibre.
        fibre_degree: degree of the generic fibre.
        slice: the pseudo-witness slice; its first ``dimension`` equations contain no other
            variables than those projected to.
        points: the component's points on it, shape ``(degree * fibre_degree, n)``.
        accuracy: largest estimated relative error of these.
    """

    coordinates: tuple[int, ...]
    dimension: int
    degree: int
    fibre_dimension: int
    fibre_degree: int
    slice: Slice
    points: ComplexArray
    accuracy: float

    __eq__ = equal_values

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", fixed_array(self.points))

    __repr__ = one_line

    def __str__(self) -> str:
        from nag.witness.shown import projection_text

        return projection_text(self)

    def _repr_html_(self) -> str:
        from nag.witness.shown import projection_html

        return projection_html(self)


def _image_dimension(fibre: Fibre, coordinates: Sequence[int]) -> int:
    """Rank of the projection on the tangent space at a fibre's first point."""
    z = fibre.points[0] * np.ldexp(1.0, -fibre.cut.powers)
    evaluator = fibre.cut.scaled.evaluator if fibre.cut.powers.any() else fibre.cut.evaluator
    _, _, vh = np.linalg.svd(evaluator.balanced_jacobian(z))
    tangent, _ = np.linalg.qr(vh[len(z) - fibre.dimension :].conj().T[: fibre.cut.n])
    return fibre.dimension - matrix_corank(tangent[list(coordinates)])


def _special_rows(
    rng: np.random.Generator,
    sizes: np.ndarray,
    coordinates: Sequence[int],
    dimension: int,
    rest: int,
) -> np.ndarray:
    """A random slice, the first ``dimension`` equations in the given coordinates only.

    It is generic where homogeneous coordinates are divided by ``sizes``, shape ``(1 + n,)``.
    """
    n = len(sizes) - 1
    inner = random_rows(rng, dimension, len(coordinates))
    first = np.zeros((dimension, 1 + n), dtype=complex)
    first[:, 0] = inner[:, 0]
    first[:, [1 + i for i in coordinates]] = inner[:, 1:]
    return np.vstack([first, random_rows(rng, rest, n)]) / sizes


@takes_run
def project(
    system: PolynomialSystem,
    component: WitnessSet,
    coordinates: Sequence[int | str],
    *,
    run: Run = DEFAULT_RUN,
) -> Projection:
    """Dimension and degree of the closure of a coordinate projection, and of its generic fibre.

    Pseudo-witness sets (Hauenstein & Sommese 2010).

    Args:
        system: the equations that ``component`` was found from.
        component: one of the components of a `nag.Decomposition`.
        coordinates: the variables to project to, at least one, each once: names, sympy's symbols,
            a text of names, or indices.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        Dimensions and degrees, with a slice and the points on it, shape
        ``(degree * fibre_degree, n)``.

    Raises:
        ProjectionError: if paths fail, or the numbers of points differ between slices.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> from nag.decomposition import project
    >>> twisted = nag.decompose(["y - x^2", "z - x^3"])
    >>> image = project(twisted.system, twisted.components[0], ["y", "z"])
    >>> image.dimension, image.degree, image.fibre_degree
    (1, 3, 1)
    """
    check_component(system, component)
    chosen = variable_indices(coordinates, system.own_variables, "coordinates")
    if not chosen or len(set(chosen)) < len(chosen):
        raise NagError(
            f"coordinates: {list(chosen)} are given; give at least one variable, each once"
        )
    rng = run.random(Stream.PROJECTION)
    natural = coordinates_of(system)
    system = natural.system(system)
    component = carry_component(component, natural, system)
    fibres = component_fibres(system, component)
    d = component.dimension
    r = _image_dimension(fibres[0], chosen)
    found = [_pseudo_witness(fibres, chosen, r, rng, run) for _ in range(SLICES)]
    degrees = {numbers for numbers, *_ in found}
    if len(degrees) > 1:
        raise ProjectionError("the numbers of points differ between two slices")
    (degree, fibre_degree), rows, there = found[0]
    cut = to_slice(natural.inverse.rows(rows))
    points, radii = carry_points(there.x, there.radii, natural.inverse)
    accuracy = float(relative_errors(points, radii).max(initial=EPS))
    return Projection(chosen, r, degree, d - r, fibre_degree, cut, points, accuracy)


def _pseudo_witness(
    fibres: Sequence[Fibre],
    coordinates: Sequence[int],
    r: int,
    rng: np.random.Generator,
    run: Run,
) -> tuple[tuple[int, int], np.ndarray, SharpPoints]:
    """Degrees of the image and of the fibre, the slice's rows, and the points on it."""
    sizes, d = fibres[0].sizes, fibres[0].dimension
    target = _special_rows(rng, sizes, coordinates, r, d - r)
    there, paths = move_and_sharpen(fibres, target, rng, run)
    # Finite points of a generic slice are regular (Bertini's theorem).
    if paths.failed or not there.accuracy < ROUGH:
        raise ProjectionError("paths failed; the component may not be irreducible")
    units = sizes[[1 + i for i in coordinates]]
    image = there.x[:, list(coordinates)] / units
    radii = there.radii[:, list(coordinates)] / units
    errors = np.linalg.norm(radii, axis=1) / (1 + np.linalg.norm(image, axis=1))
    images = clusters(image, np.maximum(errors, EPS))
    counts = {len(same) for same in images}
    if len(counts) != 1:
        raise ProjectionError(
            "the fibres over the image's points differ in degree; the component may not be "
            "irreducible"
        )
    return (len(images), counts.pop()), target, there
