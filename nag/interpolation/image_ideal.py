"""The image of a component in some of the variables: its equations, and the way back."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.groebner import dimension_and_degree
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.to_sympy import to_sympy_polynomials
from nag.interpolation.essential import VariableMap, essential_variables, maps
from nag.interpolation.point_cloud import MORE_POINTS, Cloud, monomial_values
from nag.interpolation.precise_samples import Source, source_of_component
from nag.interpolation.proof import (
    FRESH_POINTS,
    Substitution,
    cleared_map,
    equations_ideal,
    largest_value,
    proved_by_reduction,
    substitution,
)
from nag.interpolation.vanishing import (
    DIGITS,
    MOST_MONOMIALS,
    Interpolated,
    InterpolationError,
    NotRationalError,
    TooManyMonomialsError,
    next_degree,
    primitive,
    start,
)
from nag.numerics.double_ranks import NEARLY_SINGULAR, matrix_corank
from nag.numerics.rational_relations import rank_of_columns
from nag.numerics.read_only import Several, equal_values
from nag.text.table import data_frame
from nag.witness.witness import WitnessSet

if TYPE_CHECKING:
    import pandas
    import sympy

# Where no degree is asked for, no higher one is looked at.
MOST_DEGREE = 12
# Degrees beyond the one that makes a curve a component of the zeros, while there are not more
# independent functions than this, to learn whether it is the only one.
MORE_DEGREES, ENOUGH_MONOMIALS = 2, 120


@dataclass(frozen=True, eq=False)
class ImageIdeal(Several[str]):
    """What is known of the closure of the image of a component.

    Coefficients of polynomials are in the field of the system's: rational numbers, with the roots
    and the imaginary unit that occur there. If there is no imaginary unit, those of a component
    that is not kept by the conjugation of complex numbers are the equations of the image together
    with its conjugate (``self_conjugate``); of components that were taken together (``together``),
    of all their images. `repr` says so.

    Attributes:
        variables: names of all variables, without the imaginary unit.
        coordinates: indices of those that the image is in.
        dimension: of the image.
        component_dimension: of the component.
        degree: degree up to which all polynomials that vanish were found.
        generators: polynomials in the ``coordinates`` with coprime whole coefficients; where these
            may be complex, one more variable, the last one, is the imaginary unit.
        generator_proofs: for each, ``"substitution"``, ``"reduction"`` (proofs) or ``"points"``.
        maps: for those of the other variables that have one.
        map_proofs: likewise.
        zeros: dimension of the generators' common zeros, or a bound of it where it is not that of
            the image, and a bound of their degree.
        cuts: whether the image is a component of these.
        defines: whether it is certain that these are the image but for sets of lower dimension.
        digits: in which the coefficients were recognised.
        fresh: number of points, and the decimal logarithm of the largest value there, of a test
            of everything at new points.
        defines_union: whether it is certain that the generators' zeros are the image with its
            conjugate, or all images that were taken together, but for sets of lower dimension;
            defines: whether they are the image alone.
        self_conjugate: whether the equations are not those of a conjugate image as well: the
            image is its own conjugate, or coefficients are complex; None where that is not known.
        together: numbers of the components that were taken together; empty for one.
        note: why degrees are missing; empty otherwise.
        imaginary: what the imaginary unit is called, where coefficients may have it; else empty.
    """

    variables: tuple[str, ...]
    coordinates: tuple[int, ...]
    dimension: int
    component_dimension: int
    degree: int
    generators: tuple[Polynomial, ...]
    generator_proofs: tuple[str, ...]
    maps: tuple[VariableMap, ...]
    map_proofs: tuple[str, ...]
    zeros: tuple[int, int]
    cuts: bool
    defines_union: bool
    self_conjugate: bool | None
    digits: int
    fresh: tuple[int, float]
    together: tuple[int, ...] = ()
    note: str = ""
    imaginary: str = ""

    __eq__ = equal_values

    @property
    def defines(self) -> bool:
        """Whether the image alone is certain to be all zeros but for sets of lower dimension."""
        return self.defines_union and self.self_conjugate is True and not self.together

    @property
    def complete(self) -> bool:
        """Whether nothing was left open."""
        return not self.note

    @property
    def missing(self) -> tuple[int, ...]:
        """Variables without a map."""
        known = {*self.coordinates, *(m.variable for m in self.maps)}
        return tuple(i for i in range(len(self.variables)) if i not in known)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return tuple(self.variables[i] for i in self.coordinates)

    @property
    def letters(self) -> tuple[str, ...]:
        """Names of the variables of generators and maps: `names`, and that of the unit."""
        return (*self.names, self.imaginary) if self.imaginary else self.names

    @property
    def equations(self) -> tuple[str, ...]:
        """The generators as texts in the variables' names."""
        return tuple(map(self.text, self.generators))

    def text(self, f: Polynomial) -> str:
        """A polynomial in the variables of the generators as text."""
        return f.text(self.letters, unit=bool(self.imaginary))

    @property
    def entries(self) -> tuple[str, ...]:
        """The equations, as texts: polynomials know no names."""
        return self.equations

    def to_sympy(self) -> list[sympy.Expr]:
        """The generators as sympy's expressions, in symbols of the variables' names.

        Raises:
            nag.NagError: if sympy is not installed.
        """
        return to_sympy_polynomials(self.generators, self.letters, bool(self.imaginary))

    def maps_to_sympy(self) -> dict[sympy.Symbol, sympy.Expr]:
        """The maps as sympy has them: quotients by the symbols of the variables that they give.

        Raises:
            nag.NagError: if sympy is not installed.
        """
        symbols = to_sympy_polynomials(Polynomial.variables(len(self.variables)), self.variables)
        found = {}
        for m in self.maps:
            parts = m.whole_fraction()
            above, below = to_sympy_polynomials(parts, self.letters, bool(self.imaginary))
            found[symbols[m.variable]] = above / below
        return found

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each generator: its text, its degree, and what proves it.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(
            {
                "equation": list(self.equations),
                "degree": [f.degree_in(range(len(self.names))) for f in self.generators],
                "proof": list(self.generator_proofs),
            }
        )

    def __repr__(self) -> str:
        from nag.interpolation.shown import ideal_line

        return ideal_line(self)

    def __str__(self) -> str:
        from nag.interpolation.shown import elimination_lines
        from nag.text.table import label_lines

        return "\n".join([*label_lines(self.rows()), *elimination_lines(self)])

    def rows(self) -> list[tuple[str, str]]:
        """What is said above the equations, as labelled texts."""
        from nag.interpolation.shown import head_rows

        return head_rows(self)

    def document(self) -> dict[str, Any]:
        """The equations and maps as a JSON object, without its head."""
        maps = []
        for m, proof in zip(self.maps, self.map_proofs, strict=True):
            above, below = map(self.text, m.whole_fraction())
            variable = self.variables[m.variable]
            maps.append(
                {"variable": variable, "numerator": above, "denominator": below, "proof": proof}
            )
        return {
            "format": "nag-elimination",
            "variables": list(self.variables),
            "onto": list(self.names),
            "dimension": self.dimension,
            "component_dimension": self.component_dimension,
            "degree": self.degree,
            "equations": [
                {"polynomial": self.text(f), "proof": proof}
                for f, proof in zip(self.generators, self.generator_proofs, strict=True)
            ],
            "maps": maps,
            "missing": [self.variables[i] for i in self.missing],
            "zeros": {"dimension": self.zeros[0], "degree": self.zeros[1]},
            "cuts": self.cuts,
            "defines": self.defines,
            "defines_union": self.defines_union,
            "self_conjugate": self.self_conjugate,
            "together": list(self.together),
            "digits": self.digits,
            "fresh": {"points": self.fresh[0], "digits": max(0, round(-self.fresh[1]))}
            if self.generators or self.maps
            else None,
            "note": self.note,
            "imaginary": self.imaginary or None,
        }


def eliminate_component(
    cloud: Cloud,
    alike: Mapping[int, WitnessSet],
    coordinates: tuple[int, ...] | None = None,
    degree: int | None = None,
    polynomial_maps: bool = False,
    progress: Callable[[str, int, int], None] | None = None,
) -> ImageIdeal:
    """The same as `image_ideal`, of all components of its kind where it is not rational by itself.

    Args:
        alike: components that may be its conjugates over the rational numbers, by their numbers, it
            first; empty where they are not known.

    Raises:
        InterpolationError: if coefficients are not rational.
        SourceError: if points cannot be sampled.
    """
    how = degree, polynomial_maps, progress
    try:
        return image_ideal(cloud, coordinates, *how)
    except NotRationalError:
        together = _possible_conjugates(cloud, alike, coordinates)
        if len(together) < 2:
            raise
    found = image_ideal(cloud.with_further(list(together.values())[1:]), coordinates, *how)
    return replace(found, self_conjugate=None, together=tuple(sorted(together)))


def _possible_conjugates(
    cloud: Cloud, alike: Mapping[int, WitnessSet], onto: tuple[int, ...] | None
) -> dict[int, Source]:
    """What points of components are sampled from, among which are all conjugates of the first one.

    Conjugate ones over the rational numbers have the same dimension, degree and multiplicity, and
    images of the same dimension.
    """
    found = {k: source_of_component(cloud.source.system, c) for k, c in alike.items()}
    if onto is None:
        return found
    dimension = cloud.image_dimension(onto)
    return {
        k: source
        for k, source in found.items()
        if cloud.of_source(source).image_dimension(onto) == dimension
    }


def image_ideal(
    cloud: Cloud,
    coordinates: Sequence[int] | None = None,
    degree: int | None = None,
    polynomial_maps: bool = False,
    progress: Callable[[str, int, int], None] | None = None,
) -> ImageIdeal:
    """Equations of the image of a component, and maps from there to the other variables.

    Args:
        coordinates: indices of variables; essential ones are chosen if there are none.
        degree: highest degree of the equations; by default the one from which on these define the
            image, or at least cut it down to its dimension.
        polynomial_maps: whether only polynomial maps to the other variables are looked for.
        progress: called with a stage's name, its number and the number of stages.

    Raises:
        InterpolationError: if coefficients are not rational.
        SourceError: if points cannot be sampled.
    """
    tell = progress or (lambda *_: None)
    if coordinates is None:
        tell("choosing essential variables", 0, 4)
        coordinates = essential_variables(cloud, polynomial_maps)
    coordinates = tuple(coordinates)
    dimension = cloud.image_dimension(coordinates)
    tell("interpolating equations", 1, 4)
    known, note = equations_of_image(cloud, coordinates, dimension, degree)
    tell("interpolating maps", 2, 4)
    variables = cloud.ambient.system.own_variables
    others = [i for i in range(len(variables)) if i not in coordinates]
    found: tuple[VariableMap, ...] = ()
    if dimension == cloud.source.dimension:
        found = maps(cloud, known, others, polynomial=polynomial_maps)
    generators = tuple(primitive(f, known.unit) for f in known.generators)
    tell("proving", 3, 4)
    n = cloud.ambient.system.n
    statements = [f.with_variables(n, known.coordinates) for f in generators]
    statements += [cleared_map(m, n, known.coordinates) for m in found]
    proofs = _proofs(cloud, known, found, statements)
    worst = largest_value(cloud, statements, 2 * max(known.digits, DIGITS[0]))
    return ImageIdeal(
        variables=variables,
        coordinates=coordinates,
        dimension=dimension,
        component_dimension=cloud.source.dimension,
        degree=known.degree,
        generators=generators,
        generator_proofs=tuple(proofs[: len(generators)]),
        maps=found,
        map_proofs=tuple(proofs[len(generators) :]),
        zeros=common_zeros(known),
        cuts=_cuts(cloud, known, dimension),
        defines_union=_defines(known, dimension),
        self_conjugate=is_self_conjugate(cloud, known, dimension),
        digits=known.digits,
        fresh=(FRESH_POINTS, worst),
        note=note,
        imaginary="" if cloud.unit is None else cloud.ambient.system.variables[cloud.unit],
    )


def equations_of_image(
    cloud: Cloud, coordinates: tuple[int, ...], dimension: int, degree: int | None = None
) -> tuple[Interpolated, str]:
    """All equations up to a degree, and why some are missing."""
    known, k = start(coordinates, cloud.unit), len(coordinates)
    if dimension == k:
        return known, ""
    last = cut_at = degree or MOST_DEGREE
    while known.degree < last:
        try:
            known = next_degree(cloud, known)
        except TooManyMonomialsError as error:
            if not known.degree:
                raise
            return known, "" if cut_at < MOST_DEGREE and degree is None else str(error)
        if degree is not None or not _cuts(cloud, known, dimension):
            continue
        cut_at = min(cut_at, known.degree)
        enough = dimension > 1 or len(known.standard) > ENOUGH_MONOMIALS
        if enough or _defines(known, dimension):
            return known, ""
        last = min(last, cut_at + MORE_DEGREES)
    cut = _cuts(cloud, known, dimension)
    missing = f"equations up to degree {known.degree} do not cut out the image"
    return known, "" if cut or degree is not None else missing


def _cuts(cloud: Cloud, known: Interpolated, dimension: int) -> bool:
    """Whether the generators' gradients at a random point leave the image's tangents alone."""
    k = len(known.own_coordinates)
    if dimension == k or len(known.generators) < k - dimension:
        return dimension == k
    point = cloud.samples(1)[0].x
    base = [cloud.ambient.images[i](list(point), complex) for i in known.coordinates]
    rows = [[f.derivative(i)(base, complex) for i in range(k)] for f in known.generators]
    gradients = np.array([np.array(row) / max(1e-300, np.linalg.norm(row)) for row in rows])
    return matrix_corank(gradients.reshape(len(rows), k), NEARLY_SINGULAR) == dimension


def common_zeros(known: Interpolated) -> tuple[int, int]:
    """Dimension of the equations' common zeros, and a bound of their degree.

    Those of the leading monomials that are known. The zeros lie in no smaller dimension than the
    image; where the dimensions agree, their degree is at most that of these monomials.
    """
    return dimension_and_degree(known.leading_monomials, len(known.own_coordinates))


def is_self_conjugate(cloud: Cloud, known: Interpolated, dimension: int) -> bool | None:
    """Whether the image is its own conjugate, as it is if real polynomials define it.

    The component through a regular rational point is: so is its conjugate through that point. An
    image Y that is not lies, with its conjugate, among the common zeros, so that Y has at most half
    their degree; and an irreducible set is cut out by polynomials of at most its degree. One of
    these vanishes on Y only: more monomials up to that degree are dependent on Y over the complex
    numbers than over the real ones.

    Returns:
        None where there are too many monomials, or the degree of the zeros is not known.
    """
    if cloud.source.exact is not None or dimension == len(known.own_coordinates) or known.unit:
        return True
    zeros = common_zeros(known)
    half = zeros[1] // 2 if zeros[0] == dimension else known.degree
    monomials, degree = list(known.standard), known.degree
    while degree < half and len(monomials) <= MOST_MONOMIALS:
        degree += 1
        monomials += known.candidates(degree)
    monomials = [e for e in monomials if sum(e) <= half]
    enough = zeros[0] == dimension and len(monomials) <= MOST_MONOMIALS
    if len(monomials) > MOST_MONOMIALS:
        monomials = list(known.standard)
    independent = are_independent(cloud, known.coordinates, monomials)
    return independent if enough or independent is False else None


def are_independent(
    cloud: Cloud, coordinates: Sequence[int], monomials: Sequence[Exponents]
) -> bool | None:
    """Whether monomials are independent over the complex numbers on the image; None if unclear."""
    count = len(monomials) + MORE_POINTS
    for digits in DIGITS:
        points = [[p[i] for i in coordinates] for p in cloud.balls(count, digits)]
        values = monomial_values(points, monomials, digits)
        found = rank_of_columns([values[e] for e in monomials], digits)
        if found is not None:
            return found == len(monomials)
    return None


def _defines(known: Interpolated, dimension: int) -> bool:
    """Whether it is certain that all zeros are images, but for sets of lower dimension.

    The image with its conjugate, or several that were taken together, are of one dimension and lie
    among the zeros, so it is enough that dimension and degree agree. A hypersurface's equation of
    least degree has no other factors. The degree of a curve is at least the number of functions
    that one degree more adds (its hyperplane section has no fewer conditions).
    """
    k, zeros = len(known.own_coordinates), common_zeros(known)
    if zeros[0] != dimension:
        return False
    if dimension >= k - 1 or zeros[1] == 1:
        return True
    return dimension == 1 and known.counts[-1] - known.counts[-2] >= zeros[1]


def _proofs(
    cloud: Cloud,
    known: Interpolated,
    found: Sequence[VariableMap],
    statements: Sequence[Polynomial],
) -> list[str]:
    """What each statement, a polynomial in all variables that vanishes, rests on."""
    if not statements:
        return []
    if not cloud.ambient.system.exact:
        # Proofs are worked out over the rational numbers.
        return ["points"] * len(statements)
    base = _base(cloud, known, found) or _essential_base(cloud)
    ideal = equations_ideal(cloud) if base is None else None
    proofs = []
    for f in statements:
        if base is not None and base.proves(f):
            proofs.append("substitution")
        elif ideal is not None and proved_by_reduction(cloud, ideal, f):
            proofs.append("reduction")
        else:
            proofs.append("points")
    return proofs


def _essential_base(cloud: Cloud) -> Substitution | None:
    """The component as the image of its projection to essential variables, if that is proved."""
    if cloud.source.exact is None:
        return None
    try:
        coordinates = essential_variables(cloud)
        dimension = cloud.image_dimension(coordinates)
        known, _ = equations_of_image(cloud, coordinates, dimension, None)
        others = [i for i in range(cloud.ambient.system.n) if i not in coordinates]
        found = maps(cloud, known, others)
    except InterpolationError:
        return None
    return _base(cloud, known, found)


def _base(cloud: Cloud, known: Interpolated, found: Sequence[VariableMap]) -> Substitution | None:
    return substitution(cloud, known.coordinates, known.generators, known.basis, found)
