"""The genus of a curve, by monodromy round all branch points of a projection to a line.

A generic linear form makes the curve a covering of the line, with as many sheets as its degree.
The permutations of the sheets round the values at which points come together, and round infinity,
give the genus by Riemann and Hurwitz's formula: 2 g - 2 = -2 d + sum over them of d minus the
number of cycles. Singular points that no sheets exchange are unramified; the genus is that of the
smooth model. That the permutations multiply to that of a loop round all of them is a check.

References:
    Riemann 1857; Hurwitz 1891;
    Bates, Peterson, Sommese & Wampler, Numerical computation of the genus of an irreducible curve
    within an algebraic set, 2011.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.decomposition.branch_points import BranchPointError, branch_points, parallel_row
from nag.decomposition.factor import IntersectionError
from nag.decomposition.monodromy import locate_points
from nag.decomposition.rank_drop import rank_drop, rank_drop_points
from nag.errors import ComponentError, NagError
from nag.numerics.coincidence import join_labels
from nag.tracking.run import DEFAULT_RUN, Run, Stream, takes_run
from nag.witness.change_of_coordinates import carry_component, coordinates_of
from nag.witness.component_equations import component_fibres
from nag.witness.fibres import Fibre, move_regular
from nag.witness.given_component import check_component
from nag.witness.points import with_fine
from nag.witness.slices import random_rows, unit_complex
from nag.witness.witness import WitnessSet

# Corners of a circle, and its radius beside the distance of the next branch point.
CORNERS, NEAR = 8, 0.4
# Distance of the base point, relative to that of the branch points.
OUTSIDE = 2.0
# Their distance from their middle, beside its size, that is taken at least.
LEAST_RADIUS = 1e-3
# Distance from a branch point at the end of a leg of the way there, beside that at its beginning.
SHRINK = 1e-2


class GenusError(ComponentError):
    """A genus that could not be determined, with the reason."""


@dataclass(frozen=True)
class Genus:
    """The genus of a curve's smooth model, and what it was found from.

    Attributes:
        genus: 0 for a rational curve.
        sheets: degree of the projection.
        branch_points: number of finite values round which sheets are exchanged.
        ramification: sum over all of them, infinity included, of the sheets minus the cycles.
    """

    genus: int
    sheets: int
    branch_points: int
    ramification: int

    @property
    def rational(self) -> bool:
        """Whether the curve has a rational parametrisation."""
        return self.genus == 0


@takes_run
@np.errstate(over="ignore", invalid="ignore")
def genus(
    system: PolynomialSystem,
    component: WitnessSet,
    *,
    run: Run = DEFAULT_RUN,
) -> Genus:
    """The genus of an irreducible, reduced curve.

    By the permutations of its points round the branch points of a projection to a line (Bates,
    Peterson, Sommese & Wampler 2011).

    Args:
        system: the equations that ``component`` was found from.
        component: one of the components of a `nag.Decomposition`.
        run: a `nag.Run`; its fields, as ``seed=1`` or ``time_limit=60``, may be given one by one.

    Returns:
        The genus of the smooth model, and what it was found from.

    Raises:
        GenusError: if paths fail, or the permutations do not multiply to the identity.
        ValueError: if the component is no reduced curve, or another argument makes no sense.

    >>> import nag
    >>> from nag.decomposition import genus
    >>> cubic = nag.decompose("y^2 = x^3 - x")
    >>> genus(cubic.system, cubic.components[0]).genus
    1
    """
    check_component(system, component)
    if component.dimension != 1:
        raise NagError(f"the component has dimension {component.dimension}; a curve has 1")
    rng = run.random(Stream.GENUS, 0)
    natural = coordinates_of(system)
    system = natural.system(system)
    component = carry_component(component, natural, system)
    try:
        sheets = _sheets(system, component, rng, run)
        values = branch_points(sheets, rng, run)
        # Sheets that are exchanged round a cusp have bounded derivatives there.
        cusps = _singular_points(system, component, run)
        values += [complex(v) for v in cusps @ sheets[0].rows[0, 1:]]
        cover = _Cover(sheets, values, rng, run)
        return _riemann_hurwitz(cover.permutations(), cover.round_all(), component.degree)
    except (BranchPointError, IntersectionError) as error:
        raise GenusError(str(error)) from None


def _singular_points(system: PolynomialSystem, component: WitnessSet, run: Run) -> np.ndarray:
    """The curve's singular points, perhaps with others, round whose values nothing is exchanged.

    Raises:
        GenusError: if one of them may be missing.
    """
    try:
        found = rank_drop(system, component, run=run)
        if not found.notes:
            return found.isolated()
        reason = "; ".join(found.notes)
    except IntersectionError as error:
        reason = str(error)
    points = rank_drop_points(system, component, run=run)
    if points is None:
        raise GenusError(f"its singular points are not all known: {reason}")
    return points


def _sheets(
    system: PolynomialSystem, component: WitnessSet, rng: np.random.Generator, run: Run
) -> list[Fibre]:
    """The curve's points over a random value of a random form."""
    row = random_rows(rng, 1, system.n)
    gamma = complex(unit_complex(rng))
    fibres, _ = move_regular(component_fibres(system, component), row, gamma, run)
    if fibres is None:
        raise GenusError("paths to the first slice failed")
    return with_fine(fibres)


def _riemann_hurwitz(permutations: list[np.ndarray], all_: np.ndarray, sheets: int) -> Genus:
    """The genus, from the permutations in the order in which their loops make up the last one."""
    product = np.arange(sheets)
    for p in permutations:
        product = p[product]
    if (product != all_).any():
        raise GenusError("the permutations round the branch points do not make up that round all")
    if _orbits(permutations, sheets) != 1:
        raise GenusError("the permutations do not connect all sheets; it may not be irreducible")
    drops = [sheets - _orbits([p], sheets) for p in [*permutations, all_]]
    total = sum(drops)
    if total % 2:
        raise GenusError("the ramification is odd")
    return Genus(1 - sheets + total // 2, sheets, sum(d > 0 for d in drops[:-1]), total)


def _orbits(permutations: Sequence[np.ndarray], sheets: int) -> int:
    """Into how many orbits permutations part the sheets."""
    pairs = [np.column_stack([np.arange(sheets), p]) for p in permutations]
    return len(np.unique(join_labels(sheets, pairs)))


class _Cover:
    """The curve over the line of values of a linear form, and loops round the branch points."""

    def __init__(
        self, sheets: list[Fibre], values: list[complex], rng: np.random.Generator, run: Run
    ) -> None:
        self.run = run
        self.centre = complex(np.mean(values)) if values else 0j
        least = LEAST_RADIUS * (1 + abs(self.centre))
        radius = OUTSIDE * max([least, *(abs(v - self.centre) for v in values)])
        self.base = self.centre + radius * complex(unit_complex(rng))
        inwards = self.centre - self.base
        # Seen from outside, one after the other from the right to the left.
        self.values = sorted(values, key=lambda v: np.angle((v - self.base) / inwards))
        gamma = complex(unit_complex(rng))
        fibres, _ = move_regular(sheets, parallel_row(sheets[0].rows, self.base), gamma, run)
        if fibres is None:
            raise GenusError("paths to the base point failed")
        self.sheets = with_fine(fibres)

    def _carry_sheets(self, corners: Sequence[complex]) -> np.ndarray:
        """Where each sheet over the base point is carried along a closed polygon from there."""
        fibres = self.sheets
        for t in [*corners, self.base]:
            there, _ = move_regular(fibres, parallel_row(fibres[0].rows, t), 1.0, self.run)
            if there is None:
                raise GenusError("paths round a branch point failed")
            # Near a cusp sheets are closer to each other than to the value.
            fibres = with_fine(there)
        start = np.vstack([fibre.x for fibre in self.sheets])
        images = locate_points(np.vstack([fibre.x for fibre in fibres]), start)
        if images is None or sorted(images.tolist()) != list(range(len(start))):
            raise GenusError("sheets were mixed up on the way")
        return images

    def permutations(self) -> list[np.ndarray]:
        """The permutation of the sheets round each value, in the order of `values`."""
        result = []
        for v in self.values:
            others = [abs(v - w) for w in [*self.values, self.base] if w != v]
            radius, away = NEAR * min(others), self.base - v
            shrink = radius / abs(away)
            # Steps are in proportion to the leg that they are on.
            legs = max(1, round(np.log(shrink) / np.log(SHRINK)))
            inwards = [v + away * shrink ** (k / legs) for k in range(1, legs)]
            turns = np.exp(2j * np.pi * np.arange(CORNERS + 1) / CORNERS)
            circle = [complex(v + away * shrink * turn) for turn in turns]
            result.append(self._carry_sheets([*inwards, *circle, *inwards[::-1]]))
        return result

    def round_all(self) -> np.ndarray:
        """The permutation of the sheets round all values together."""
        away = self.base - self.centre
        turns = [np.exp(2j * np.pi * k / (2 * CORNERS)) for k in range(1, 2 * CORNERS)]
        return self._carry_sheets([self.centre + away * turn for turn in turns])
