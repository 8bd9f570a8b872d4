"""For which parameters a family of complete intersections has singular members.

The pairs of a parameter p and a singular point x of its member, with null vectors w of the
transposed Jacobian J(x, p), derivatives in the variables alone, make a set S that is decomposed.
What is asked for is the closure of its image in the space of the parameters. Each component of S
has an irreducible image, and those that lie in no other one are the components of the closure.

An image that fills the space is known by the rank of its tangents; one of codimension one, by the
polynomial of its degree that vanishes at random points of many digits, irreducible over the
rational numbers; a smaller one by all polynomials of low degree, if their zeros have its dimension
and its degree. Components whose images are not defined over the rational numbers are conjugate to
others, and have equations with these together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from itertools import groupby
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.given import check_whole
from nag.algebra.groebner import Ideal, UnfinishedBasis, ideal_of
from nag.algebra.polynomial import Polynomial
from nag.algebra.smoothness import BOUNDS
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.decomposition.rank_drop import BITS, new_names, product
from nag.errors import NagError
from nag.interpolation.conjugates import conjugate_classes
from nag.interpolation.image_ideal import common_zeros, equations_of_image
from nag.interpolation.point_cloud import AmbientVariables, Cloud
from nag.interpolation.precise_samples import Source, SourceError, source_of_component
from nag.interpolation.proof import largest_value, proved_by_reduction
from nag.interpolation.vanishing import (
    Interpolated,
    InterpolationError,
    TooManyMonomialsError,
    hypersurface_equation,
    primitive,
)
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import bits_of
from nag.numerics.natural_coordinates import NaturalCoordinates, natural_coordinates
from nag.numerics.precise_point import POINT_DIGITS
from nag.numerics.read_only import Several, equal_values
from nag.text.table import data_frame, lines_of, one_line
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.frame import expand_orbits
from nag.witness.given_component import check_system
from nag.witness.projection import ProjectionError, project
from nag.witness.witness import PathCounts, WitnessSet

if TYPE_CHECKING:
    import pandas

# Of its JSON document.
FORMAT = "nag-singular-parameters"
Proof = Literal["reduction", "points", "dimension"]


@dataclass(frozen=True)
class ParameterSet:
    """Parameters with singular members: a set that is irreducible over the rational numbers.

    Attributes:
        equations: coprime whole coefficients; none where it is the whole space.
        dimension, degree: of the set.
        proof: why these are its equations. ``"reduction"``: they carry something that does not
            vanish on the set of singular points into the ideal of that set's equations;
            ``"points"``: recognised in so many digits, they hold at fresh random points to more,
            and are irreducible or have the set's degree; ``"dimension"``: of the tangent space's
            image, where the set is the whole space.
    """

    equations: tuple[Polynomial, ...]
    dimension: int
    degree: int
    proof: Proof

    def text(self, names: Sequence[str]) -> str:
        """The equations in one line."""
        return " and ".join(f"{f.text(names)} = 0" for f in self.equations) or "all values"


@dataclass(frozen=True, eq=False)
class SingularParameters(Several[ParameterSet]):
    """Where in the space of parameters there are singular points.

    Attributes:
        parameters: their names.
        sets: the components, over the rational numbers, of the closure of these parameters.
        paths: what the run did.
        complete: whether nothing was left open.
        notes: what was.
        proved: whether it is proved that no set is missing: all singular points have the dimension
            that they have at least, one less than there are parameters, and the degree of a
            Groebner basis. It is not proved where something must not vanish.
    """

    parameters: tuple[str, ...]
    sets: tuple[ParameterSet, ...]
    paths: PathCounts
    complete: bool
    notes: tuple[str, ...]
    proved: bool = False

    __eq__ = equal_values

    @property
    def entries(self) -> tuple[ParameterSet, ...]:
        """The sets."""
        return self.sets

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each set: its equations in one text, dimension, degree and proof.

        Raises:
            nag.NagError: if pandas is not installed.
        """
        return data_frame(
            {
                "equations": self.texts(),
                "dimension": [one.dimension for one in self.sets],
                "degree": [one.degree for one in self.sets],
                "proof": [one.proof for one in self.sets],
            }
        )

    __repr__ = one_line

    def __str__(self) -> str:
        return lines_of("SingularParameters", self.rows())

    @property
    def conditions(self) -> tuple[tuple[Polynomial, ...], ...]:
        """The equations of each set; none of the whole space."""
        return tuple(each.equations for each in self.sets)

    def rows(self) -> list[tuple[str, str]]:
        """For which parameters members are singular, what that rests on, and what is open."""
        from nag.decomposition.shown import parameter_rows

        return parameter_rows(self)

    def document(self) -> dict[str, Any]:
        """The sets as a JSON object, without its head."""
        return {
            "format": FORMAT,
            "paths": asdict(self.paths),
            "proved": self.proved,
            "notes": list(self.notes),
            "parameters": list(self.parameters),
            "conditions": [[f.text(self.parameters) for f in each] for each in self.conditions],
            "sets": [
                {"dimension": each.dimension, "degree": each.degree, "proof": each.proof}
                for each in self.sets
            ],
        }

    def texts(self) -> list[str]:
        """Each set of parameters in one line."""
        return [each.text(self.parameters) for each in self.sets]


@takes_run
def singular_parameters(
    system: PolynomialSystem,
    count: int,
    *,
    run: Run = DEFAULT_RUN,
) -> SingularParameters:
    """For which parameters, the last ``count`` variables, the zero set in the others is singular.

    There the transposed Jacobian has a null vector (the rank-deficiency set: Bates, Hauenstein,
    Peterson & Sommese 2009); components of such points are projected to the parameters.

    Args:
        system: a complete intersection in its variables, for general parameters. Singular points
            where something vanishes that must not, `PolynomialSystem.nonzero`, do not count.
        count: how many of the variables are parameters.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        For each set of parameters that is irreducible over the rational numbers its equations, and
        what they rest on. They are those of the closure: for all but a smaller set of the
        parameters in it, the member is singular.

    Raises:
        ValueError: if there are more equations than variables, no complete intersection, or
            another argument makes no sense.

    >>> import nag
    >>> from nag.decomposition import singular_parameters
    >>> singular_parameters(nag.system("x^2 + a*x + b", "x a b"), 2).texts()
    ['a^2 - 4*b = 0']
    """
    n = _variables(system, count)
    natural = natural_coordinates(system.polynomials, system.n)
    whole = _null_space_system(natural.system(system), n, run.random(Stream.NULL_SPACES_OF_MEMBERS))
    found = decompose(whole, run=run)
    ideal, components = _ideal(whole), expand_orbits(found).components
    family = _Family(whole, ideal, tuple(range(n, n + count)), run)
    sets, open_notes = _parameter_sets(family, components)
    # The equations alone say nothing of what is excluded.
    comparable = ideal is not None and not whole.nonzero
    agree = comparable and _agree(ideal, components)
    if found.complete and comparable and not agree:
        open_notes.append(
            "a Groebner basis has singular points of another dimension or degree than were found"
        )
    parameters = NaturalCoordinates(natural.scales[n:], natural.origin[n:])
    sets = [_in_original_coordinates(each, parameters) for each in sets]
    names = system.variables[n:]
    notes = (*found.notes, *open_notes)
    if not (found.complete or notes):
        notes = ("the decomposition of the singular points is not complete",)
    ordered = tuple(sorted(sets, key=lambda each: (-each.dimension, each.text(names))))
    proved = agree and not notes and all(c.dimension < count for c in components)
    return SingularParameters(names, ordered, found.paths, not notes, notes, proved)


def _in_original_coordinates(known: ParameterSet, natural: NaturalCoordinates) -> ParameterSet:
    """A set of parameters where equations are those of the parameters that were given."""
    equations = [_primitive(natural.inverse.polynomial(f)) for f in known.equations]
    return replace(known, equations=tuple(sorted(equations, key=_make_sort_key)))


def _variables(system: PolynomialSystem, count: int) -> int:
    """How many of the variables are no parameters.

    Raises:
        ValueError: if these are no whole number of them, or leave no complete intersection.
    """
    check_system(system)
    check_whole(count, "count", 1)
    n, m = system.n - count, len(system.polynomials)
    if n < 1:
        raise NagError(f"count: {count} is given; give fewer than the {system.n} variables")
    if not 0 < m <= n:
        raise NagError(f"system: {m} equations in {n} variables are no complete intersection")
    return n


def _null_space_system(
    system: PolynomialSystem, n: int, rng: np.random.Generator
) -> PolynomialSystem:
    """Equations and conditions; w keeps its own coordinates, so that what factors still does.

    The chart of w is random enough to leave out no vector that is special.
    """
    total, m = system.n + len(system.polynomials), len(system.polynomials)
    w = [Polynomial.variable(total, system.n + i) for i in range(m)]
    rows = [f.with_variables(total, range(system.n)) for f in system.polynomials]
    for i in range(n):
        terms = [row[i].with_variables(total, range(system.n)) for row in system.jacobian]
        rows.append(product(w, terms))
    chart = [Fraction(int(c), 1 << BITS) for c in rng.integers(1, 1 << BITS, m)]
    rows.append(product(w, [Polynomial.constant(total, c) for c in chart]) - 1)
    names = (*system.variables, *new_names(system.variables, m))
    nonzero = tuple(g.with_variables(total, range(system.n)) for g in system.nonzero)
    return PolynomialSystem(names, tuple(f for f in dict.fromkeys(rows) if f), nonzero)


def _ideal(whole: PolynomialSystem) -> Ideal | None:
    """The ideal of equations that are exact, where it is small enough to be found soon."""
    if not whole.exact:
        return None
    try:
        return ideal_of(whole.polynomials, whole.variables, bounds=BOUNDS)
    except UnfinishedBasis:
        return None


def _agree(ideal: Ideal, components: Sequence[WitnessSet]) -> bool:
    """Whether components of the largest dimension have the ideal's dimension and degree."""
    dimension = max((c.dimension for c in components), default=-1)
    degrees = [c.degree * (c.multiplicity or 0) for c in components if c.dimension == dimension]
    return (dimension, sum(degrees)) == (ideal.dimension, ideal.degree)


@dataclass(frozen=True, eq=False)
class _Family:
    """The equations of pairs and null vectors, and how their zeros are followed.

    Attributes:
        whole: the equations.
        ideal: of these, if it is not too large.
        coordinates: the parameters among their variables.
    """

    whole: PolynomialSystem
    ideal: Ideal | None
    coordinates: tuple[int, ...]
    run: Run

    def cloud(self, sources: Sequence[Source]) -> Cloud:
        """Points of components of one dimension, one after the other."""
        rng = self.run.random(Stream.SINGULAR_MEMBERS)
        return Cloud(sources[0], AmbientVariables.itself(self.whole), rng, self.run, sources[1:])


@dataclass(frozen=True, eq=False)
class _ParameterImage:
    """The image of a component in the space of the parameters.

    Attributes:
        cloud: points of the component.
        dimension: of the image.
    """

    component: WitnessSet
    cloud: Cloud
    dimension: int

    def satisfies(self, equations: Sequence[Polynomial], coordinates: Sequence[int]) -> bool:
        """Whether equations hold at a random point, to all digits that it has."""
        (point,) = self.cloud.balls(1, POINT_DIGITS)
        if not equations:
            return True
        values = BallPolynomials.of(equations).values(
            [point[i] for i in coordinates], bits_of(POINT_DIGITS)
        )
        return all(z.contains(0) for z in values.entries())


class _OpenError(ValueError):
    """Equations of an image that are not known, with the reason."""


def _parameter_sets(
    family: _Family, components: Sequence[WitnessSet]
) -> tuple[list[ParameterSet], list[str]]:
    """The images of components that lie in no other one, and what was left open."""
    images, notes = _images(family, components)
    found: list[ParameterSet] = []
    for dimension, level in groupby(images, key=lambda image: image.dimension):
        conjugate: list[_ParameterImage] = []
        for image in level:
            try:
                if any(image.satisfies(each.equations, family.coordinates) for each in found):
                    continue
                found.append(_set_alone(family, image))
            except (_OpenError, TooManyMonomialsError, SourceError, ProjectionError) as reason:
                notes.append(_left_open(dimension, reason))
            except InterpolationError:
                conjugate.append(image)
        for together in _group_by_kind(conjugate):
            try:
                new = _sets_together(family, together)
            except (_OpenError, InterpolationError, SourceError, ProjectionError) as reason:
                notes.append(_left_open(dimension, reason))
            else:
                found += [each for each in new if each not in found]
    return found, notes


def _left_open(dimension: int, reason: ValueError) -> str:
    return f"there are singular points for a set of parameters of dimension {dimension}: {reason}"


def _images(
    family: _Family, components: Sequence[WitnessSet]
) -> tuple[list[_ParameterImage], list[str]]:
    """The images of components, the largest first, and why some are missing."""
    if components and not family.whole.exact:
        return [], ["sets of parameters are recognised where all coefficients are rational"]
    found, notes = [], []
    for component in components:
        try:
            cloud = family.cloud([source_of_component(family.whole, component)])
            found.append(
                _ParameterImage(component, cloud, cloud.image_dimension(family.coordinates))
            )
        except SourceError as reason:
            notes.append(f"singular points of dimension {component.dimension}: {reason}")
    return sorted(found, key=lambda image: -image.dimension), notes


def _set_alone(family: _Family, image: _ParameterImage) -> ParameterSet:
    """The set that an image is, if it is defined over the rational numbers.

    Raises:
        InterpolationError: if it is not.
        _OpenError: if its equations are not known for another reason.
    """
    count = len(family.coordinates)
    if image.dimension == count:
        return ParameterSet((), count, 1, "dimension")
    degree = _image_degree(family, image)
    if image.dimension < count - 1:
        return _small_set(family, image.cloud, image.dimension, degree)
    known = hypersurface_equation(image.cloud, family.coordinates, degree)
    return _hypersurface(family, image.cloud, known)


def _hypersurface(family: _Family, cloud: Cloud, known: Interpolated) -> ParameterSet:
    """The set of which the equation is known.

    Raises:
        InterpolationError: if it is not irreducible, or does not hold elsewhere.
    """
    equation = _primitive(known.basis[0])
    if [k for _, k in factor_into_irreducibles(equation)] != [1] or equation.degree != known.degree:
        raise InterpolationError("the set is not defined over the rational numbers")
    proof = _proof(family, cloud, equation, known.digits)
    return ParameterSet((equation,), len(family.coordinates) - 1, known.degree, proof)


def _image_degree(family: _Family, image: _ParameterImage) -> int:
    if image.dimension == 0:
        return 1
    found = project(
        family.whole,
        image.component,
        family.coordinates,
        run=family.run,
    )
    if found.dimension != image.dimension:
        raise _OpenError("its dimension is not certain")
    return found.degree


def _proof(family: _Family, cloud: Cloud, equation: Polynomial, digits: int) -> Proof:
    """What it rests on that a polynomial vanishes on images, which was recognised in some digits.

    Raises:
        InterpolationError: if it does not vanish.
    """
    f = equation.with_variables(family.whole.n, family.coordinates)
    if family.ideal is not None and proved_by_reduction(cloud, family.ideal, f):
        return "reduction"
    if largest_value(cloud, [f], 2 * digits) > -digits:
        raise InterpolationError("a polynomial does not hold at fresh points")
    return "points"


def _small_set(family: _Family, cloud: Cloud, dimension: int, degree: int) -> ParameterSet:
    """A set of codimension two or more, of known degree.

    Raises:
        InterpolationError: if it is not defined over the rational numbers.
        _OpenError: if the equations that are found may have further zeros.
    """
    known, _ = equations_of_image(cloud, family.coordinates, dimension)
    if common_zeros(known) != (dimension, degree):
        raise _OpenError(f"the equations up to degree {known.degree} may have further zeros")
    equations = tuple(sorted(map(_primitive, known.generators), key=_make_sort_key))
    proofs = {_proof(family, cloud, f, known.digits) for f in equations}
    return ParameterSet(
        equations, dimension, degree, "points" if "points" in proofs else "reduction"
    )


def _group_by_kind(images: Sequence[_ParameterImage]) -> list[list[_ParameterImage]]:
    """Images that may be conjugate: of components of one dimension and degree."""
    kinds: dict[tuple[int, int], list[_ParameterImage]] = {}
    for image in images:
        kinds.setdefault((image.component.dimension, image.component.degree), []).append(image)
    return list(kinds.values())


def _sets_together(family: _Family, images: Sequence[_ParameterImage]) -> list[ParameterSet]:
    """The sets that images, all of one dimension, are where conjugate ones are taken together.

    Raises:
        InterpolationError: if some are conjugate to others that are not among them.
        _OpenError: if equations are not known for another reason.
    """
    rng, sources = family.run.random(Stream.DISCRIMINANT), [i.cloud.source for i in images]
    dimension, coordinates = images[0].dimension, family.coordinates
    found = []
    for each in conjugate_classes(sources, coordinates, dimension, rng, family.run):
        cloud = family.cloud([sources[i] for i in each.members])
        if dimension < len(coordinates) - 1:
            found.append(_small_set(family, cloud, dimension, each.degree))
        elif dimension == 0:
            values = enumerate(each.polynomial.coeffs())
            f = Polynomial(1, {(k,): Fraction(int(c.p), int(c.q)) for k, c in values if c})
            proof = _proof(family, cloud, f, POINT_DIGITS)
            found.append(ParameterSet((_primitive(f),), 0, each.degree, proof))
        else:
            known = hypersurface_equation(cloud, coordinates, each.degree)
            found.append(_hypersurface(family, cloud, known))
    return found


def _make_sort_key(f: Polynomial) -> tuple[int, tuple[int, ...]]:
    """The order in which polynomials are written: by their degree and their first term."""
    return f.degree, min(tuple(-k for k in e) for e in f.terms if sum(e) == f.degree)


def _primitive(f: Polynomial) -> Polynomial:
    """The multiple with coprime whole coefficients, the one that is written first positive."""
    g = primitive(f)
    return g if g.terms[tuple(-k for k in _make_sort_key(g)[1])] > 0 else -g
