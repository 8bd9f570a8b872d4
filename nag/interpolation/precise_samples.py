"""Random points of a component in as many digits as are asked for.

One regular point of a component is enough to begin with: it moves with the slice through it to
random slices, and Newton's method on the equations that cut the component there does the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10

import flint
import numpy as np

from nag.algebra.evaluation import Evaluator
from nag.algebra.exact_ranks import jacobian_rank
from nag.algebra.number import Exact, Number
from nag.algebra.system import PolynomialSystem
from nag.errors import ComponentError
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.digits import SPARE, bits_of, in_bits, to_ball
from nag.numerics.doubles import ROUNDED
from nag.numerics.natural_coordinates import NaturalCoordinates, scale_coordinates
from nag.numerics.newton import find_zero
from nag.numerics.zero_values import ON
from nag.tracking.run import Run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.cutting import Equations, find_cut
from nag.witness.fibres import Fibre
from nag.witness.given_component import round_point
from nag.witness.sampling import move_to_random_slice
from nag.witness.slices import pad_rows, rows_through
from nag.witness.witness import WitnessSet

# Of which numbers equations and points are made.
TAKEN = "rational numbers and sums of their roots"


class SourceError(ComponentError):
    """Points that cannot be sampled from; the message is one line."""


@dataclass(frozen=True, eq=False)
class Source:
    """Regular points of one component, with the equations that cut it there.

    Attributes:
        system: the equations of the component and perhaps of others.
        natural: the coordinates in which the points are, in the units of the system's own.
        fibres: the points.
        exact: the one point that was given exactly; None for witness points.
    """

    system: PolynomialSystem
    natural: NaturalCoordinates
    fibres: tuple[Fibre, ...]
    exact: tuple[Exact, ...] | None = None

    @property
    def dimension(self) -> int:
        return self.fibres[0].dimension


@np.errstate(over="ignore", invalid="ignore")
def source_of_component(
    system: PolynomialSystem, component: WitnessSet, exact: bool = True
) -> Source:
    """The witness points of a component.

    Args:
        exact: whether coefficients have to be such as can be recognised from values.

    Raises:
        SourceError: if they have to be and are no sums of roots, or the points are singular
            in a way that deflation does not mend.
    """
    if exact:
        _check_algebraic(system)
    natural = coordinates_of(system).without_scales
    own = natural.system(system)
    component = carry_component(component, natural, own)
    try:
        fibres = component_fibres(own, component)
    except ValueError as error:
        raise SourceError(str(error)) from None
    return Source(system, natural, tuple(fibres))


def source_at(
    system: PolynomialSystem, point: Sequence[Number], rng: np.random.Generator
) -> Source:
    """The one component through an exact point where the equations are regular.

    Raises:
        SourceError: if coefficients or coordinates are no sums of roots, or the point is no
            zero, is isolated, or is not regular.
    """
    _check_algebraic(system)
    if not all(isinstance(x, Exact) for x in point):
        raise SourceError(f"the point has coordinates other than {TAKEN}")
    if any(f(point) != 0 for f in system.polynomials):
        raise SourceError("the point does not satisfy the equations")
    dimension = system.n - jacobian_rank(system.polynomials, point)
    if dimension == 0:
        raise SourceError("the point is isolated; there is nothing to eliminate from")
    natural = coordinates_of(system).without_scales
    own, x = natural.system(system), round_point(natural.numbers(point))
    sizes = scale_coordinates(own.polynomials, own.n).sizes
    rows = rows_through(rng, dimension, x, np.concatenate([[1.0], sizes]))
    found = find_cut(Equations(own.polynomials, own.n), rows, x, ROUNDED, rng, False)
    if found is None:
        raise SourceError("the point is too near to a singular one")
    cut, z = found
    fibre = Fibre(cut, rows, z[None])
    return Source(system, natural, (fibre,), tuple(point))


def _check_algebraic(system: PolynomialSystem) -> None:
    if not all(f.algebraic for f in system.polynomials):
        raise SourceError(f"the equations have coefficients other than {TAKEN}")


@dataclass(frozen=True, eq=False)
class Sample:
    """A point, in doubles, and what defines it: equations and a slice of doubles.

    Attributes:
        natural: the coordinates of all this.
        fibre: the one point.
    """

    natural: NaturalCoordinates
    fibre: Fibre

    @property
    def x(self) -> np.ndarray:
        """The point in the system's variables."""
        return self.natural.inverse.points(self.fibre.x[0])

    def balls(self, digits: int) -> list[flint.acb]:
        """`x` as balls of radius ``10^-digits``, relative above one.

        Raises:
            SourceError: if Newton's method does not converge.
        """
        (z,), cut = self.fibre.points, self.fibre.cut
        exact = BallPolynomials.of(cut.polynomials, pad_rows(self.fibre.rows, 1 + len(z)))
        more = log10(1 + float(np.abs(z).max(initial=0.0)))
        zero = find_zero(exact, [flint.acb(complex(x)) for x in z], digits + more)
        if zero is None:
            raise SourceError("Newton's method does not converge at a sampled point")
        with in_bits(bits_of(digits + SPARE)):
            radius = flint.arb(10) ** -digits
            x = [z + to_ball(b) for z, b in zip(zero.point, self.natural.origin, strict=False)]
            return [_widen_ball(z, radius * (1 + abs(z).mid())) for z in x]


def _widen_ball(z: flint.acb, radius: flint.arb) -> flint.acb:
    part = flint.arb(0, radius.mid())
    return flint.acb(z.real + part, z.imag + part)


@np.errstate(over="ignore", invalid="ignore")
def samples(source: Source, count: int, rng: np.random.Generator, run: Run) -> list[Sample]:
    """Independent random points of the component.

    Raises:
        SourceError: if a path fails, or ends where the equations do not hold.
    """
    n = source.system.n
    evaluator = Evaluator.of(source.natural.system(source.system).polynomials, n)
    found: list[Sample] = []
    while len(found) < count:
        there = move_to_random_slice(source.fibres, rng, run)
        if not (len(there.x) and np.isfinite(there.accuracy)):
            raise SourceError("the path to a point failed")
        (fibre,) = there.fibres
        if evaluator.residuals(fibre.x).max(initial=0.0) > ON:
            raise SourceError(
                "some equations hold at the point alone and not on what moves through it: it is "
                "singular; name a component"
            ).mended_by("component")
        found.append(Sample(source.natural, fibre))
    return found
