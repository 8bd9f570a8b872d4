"""Frameworks as polynomial systems: the places of the points that are not pinned.

In the plane the first bar is pinned to (0, 0) and (1, 0), and lengths count in multiples of its
own. Frameworks that are given by lengths take isotropic coordinates there, z = x + iy and
w = x - iy: either w is eliminated (`isotropic`), or a bar is (z - z')(w - w') = l^2, bilinear. A
realisation is real where w is the conjugate of z. Where a placement is given, coordinates are its
own, x and y, but components are found in z where that takes fewer paths. In space a triangle of
bars is pinned or, where there is none, two bars that meet: the first is held, the other stays in a
plane through it. The frame is e1 along the first side, e2 across it in the plane, e3 across both,
of whatever lengths make the equations rational where the squared lengths are.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import sqrt
from typing import Any

import numpy as np

from nag.algebra.number import Number, is_zero
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.mechanism.assembly import AssemblyModel, Side
from nag.mechanism.axes import Space, cross, difference, dot
from nag.mechanism.framework import Framework, FrameworkError, Place
from nag.mechanism.isotropic import conjugates, isotropic_system
from nag.mechanism.path_estimates import Alternative, fewest_estimated_paths
from nag.numerics.doubles import ROUGH


@dataclass(frozen=True, repr=False)
class FrameworkModel(AssemblyModel):
    """The realisations of a framework up to motions, as a system.

    Attributes:
        framework: what is modelled.
        pinned: the points that are held: the ends of a bar, or a triangle. Without a triangle of
            bars the third one is held in a plane with the first two.
        coordinates: letters of each point's variables: ``"z"``, ``"zw"``, ``"xy"`` or ``"xyz"``.
        system: one equation for each bar that is not pinned; in z one for each loop.
        reference: the placement in the system's variables, or None.
        symmetries: the reflection that keeps the pinned points, and the half turn about the first
            two where the third one moves.
        smaller: the same framework in coordinates in which components are found by fewer paths.
        instead: other coordinates, and how many paths they would take.
        held: coordinates of the pinned points; empty in isotropic coordinates.
        metric: squared lengths of the orthogonal vectors that coordinates count along; empty there.
    """

    framework: Framework
    pinned: tuple[str, ...]
    coordinates: str
    system: PolynomialSystem
    reference: tuple[Number, ...] | None
    symmetries: tuple[SignedPermutation, ...]
    smaller: FrameworkModel | None = None
    instead: tuple[str, int] | None = None
    held: tuple[Place, ...] = ()
    metric: tuple[Number, ...] = ()

    solution = "realisation"
    counted_up_to = " up to motions"

    @property
    def formulation_text(self) -> str:
        """What the equations are, as text."""
        kind = "isotropic coordinates" if self.system.isotropic else "coordinates"
        return f"{kind} ({', '.join(self.coordinates)}) of a framework"

    @property
    def has_moving_third(self) -> bool:
        """Whether the third pinned point is held in a plane only."""
        return self.system.variables[0] == f"x_{self.pinned[-1]}"

    @property
    def points_of_each(self) -> int:
        """Two where a half turn about the first two pinned points keeps the plane of the third."""
        return 2 if self.has_moving_third and self.system.nonzero else 1

    @property
    def space(self) -> Space:
        """In which the points move."""
        return "planar" if self.framework.dimension == 2 else "spatial"

    @property
    def gruebler_kutzbach(self) -> int:
        """The mobility that counting predicts."""
        return self.framework.freedoms

    @property
    def reason(self) -> str:
        """One sentence: what was made of the framework."""
        plane = self.framework.dimension == 2
        text = (
            f"framework of {len(self.framework.points)} points and {len(self.framework.bars)} bars "
            f"{'in the plane' if plane else 'in space'}; {_in_words(self.coordinates)} of the "
            f"points, {self._pinned_text}"
        )
        if self.instead is not None:
            other, paths = self.instead
            text += f": at most {self.paths} paths, {_in_words(other)} {paths}"
        if self.smaller is not None:
            text += (
                f"; components are found in {_in_words(self.smaller.coordinates)}, at most "
                f"{self.smaller.paths} paths instead of {self.paths}, and carried over"
            )
        return text

    @property
    def _pinned_text(self) -> str:
        if not self.has_moving_third:
            kind = "bar" if self.framework.dimension == 2 else "triangle"
            return f"{kind} {'-'.join(self.pinned)} pinned"
        first, second, third = self.pinned
        return (
            f"bar {first}-{second} pinned, {third} held in a plane with it; realisations with the "
            "three in line are left out"
        )

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """All coordinates, those that components are found in first."""
        taken = (self.smaller or self).coordinates
        each = sorted(in_each_coordinates(self), key=lambda m: m.coordinates != taken)
        return tuple(Alternative.of_parts(_letters(m.coordinates), m) for m in each)

    @property
    def sides(self) -> tuple[Side, ...]:
        """The bars."""
        bars = zip(self.framework.bars, self.framework.squared_lengths, strict=True)
        return tuple(Side(bar, squared, f"bar {'-'.join(bar)}") for bar, squared in bars)

    @property
    def paths(self) -> int:
        """Estimated number of paths that equation by equation are tracked at most."""
        return fewest_estimated_paths(self.system)

    def places_at(self, point: Sequence[Any]) -> dict[str, tuple[Any, ...]]:
        """The points' places in lengths, in the orthonormal frame of the pinned ones.

        Args:
            point: of a model that is not in isotropic coordinates, doubles or arrays of them.
        """
        units = [sqrt(float(m)) for m in self.metric]
        d = len(units)
        at: dict[str, Sequence[Any]] = dict(zip(self.pinned, self.held, strict=True))
        if self.has_moving_third:
            at[self.pinned[-1]] = (*point[:2], 0)
        free = self.framework.points_not_on(self.pinned)
        start = len(point) - d * len(free)
        at |= {p: point[start + d * i : start + d * (i + 1)] for i, p in enumerate(free)}
        return {
            name: tuple(
                (x if isinstance(x, np.ndarray) else float(x)) * u
                for x, u in zip(own, units, strict=True)
            )
            for name, own in at.items()
        }

    def place_polynomials(self) -> Mapping[str, Sequence[Any]]:
        """The points' coordinates along the frame's vectors, as polynomials in the variables."""
        n, d = self.system.n, len(self.metric)
        variables = Polynomial.variables(n)
        at: dict[str, Sequence[Any]] = {
            p: _constants(n, x) for p, x in zip(self.pinned, self.held, strict=True)
        }
        if self.has_moving_third:
            at[self.pinned[-1]] = (*variables[:2], Polynomial(n, {}))
        free = self.framework.points_not_on(self.pinned)
        start = n - d * len(free)
        return at | {p: variables[start + d * i :][:d] for i, p in enumerate(free)}

    def real_places(self, point: Sequence[complex]) -> dict[str, tuple[float, ...]]:
        """Where the points are in a real realisation, in lengths; the first bar along x.

        Args:
            point: a solution, in whatever coordinates, that `is_real` holds of.
        """
        if not self.system.isotropic:
            placed = self.places_at([complex(x).real for x in point])
            return {name: own[: self.framework.dimension] for name, own in placed.items()}
        unit = sqrt(float(self.framework.squared_lengths[0]))
        first, second = self.pinned
        step = len(self.coordinates)
        free = self.framework.points_not_on(self.pinned)
        at = {first: 0j, second: 1 + 0j, **dict(zip(free, point[::step], strict=True))}
        return {p: (unit * at[p].real, unit * at[p].imag) for p in self.framework.points}

    def is_real(self, point: Sequence[complex]) -> bool:
        """Whether a solution is a real realisation, to within rounding."""
        if not self.system.isotropic:
            return self._has_real_frame and super().is_real(point)
        bound = ROUGH * (1 + max((abs(x) for x in point), default=0.0))
        if self.coordinates == "z":
            pairs = zip(point, conjugates(self.framework, point), strict=True)
        else:
            pairs = zip(point[::2], point[1::2], strict=True)
        return all(abs(complex(z) - complex(w).conjugate()) <= bound for z, w in pairs)

    @property
    def _has_real_frame(self) -> bool:
        """Whether the pinned triangle is one: no side of it is longer than the other two.

        No frame rests on a triangle where the third point moves.
        """
        framework = self.framework
        known = framework.dimension == 2 or framework.placement is not None
        if known or self.has_moving_third:
            return True
        first, second, third = self.pinned
        s, t, opposite = (
            framework.squared_length(p, q)
            for p, q in ((first, second), (first, third), (second, third))
        )
        assert s is not None and t is not None and opposite is not None
        return bool(4 * s * t > (s + t - opposite) * (s + t - opposite))


def framework_model(framework: Framework) -> FrameworkModel:
    """The equations of a framework.

    Raises:
        FrameworkError: if there are no points to place, or in space no bars to pin.
    """
    if len(framework.points) <= framework.dimension:
        raise FrameworkError(
            f"{len(framework.points)} points in dimension {framework.dimension} leave nothing to "
            "place; add points",
            "points",
        )
    if framework.dimension == 3:
        return _space_model(framework)
    if framework.placement is None:
        return _isotropic_model(framework)
    return _in_fewer_paths(_plane_model(framework))


def _in_words(coordinates: str) -> str:
    kind = "isotropic coordinates" if coordinates.startswith("z") else "coordinates"
    return f"{kind} {_letters(coordinates)}"


def _letters(coordinates: str) -> str:
    return coordinates if len(coordinates) == 1 else f"({', '.join(coordinates)})"


def _isotropic_model(framework: Framework) -> FrameworkModel:
    """In the isotropic coordinates that take fewer paths."""
    made, other = _by_places(framework), _by_pairs(framework)
    if made is None or made.paths > other.paths:
        return other
    return replace(made, instead=(other.coordinates, other.paths))


def _by_places(framework: Framework) -> FrameworkModel | None:
    system = isotropic_system(framework)
    if system is None:
        return None
    return FrameworkModel(framework, framework.bars[0], "z", system, None, ())


def _by_pairs(framework: Framework) -> FrameworkModel:
    pinned, unit = framework.bars[0], framework.squared_lengths[0]
    free, variables, names = _unknowns(framework, pinned, "zw")
    n = len(names)
    places: dict[str, Sequence[Any]] = {pinned[i]: _constants(n, (i, i)) for i in (0, 1)}
    places |= {p: variables[2 * i : 2 * i + 2] for i, p in enumerate(free)}
    equations = []
    for (a, b), squared in zip(framework.bars[1:], framework.squared_lengths[1:], strict=True):
        z, w = difference(places[a], places[b])
        equations.append(z * w - squared / unit)
    groups = (tuple(range(0, n, 2)), tuple(range(1, n, 2)))
    system = PolynomialSystem(names, tuple(equations), groups=groups, isotropic=True)
    # The reflection exchanges the groups, so it is no symmetry of multidegrees.
    return FrameworkModel(framework, pinned, "zw", system, None, ())


def cartesian_model(framework: Framework) -> FrameworkModel:
    """The realisations in coordinates that are real where a realisation is.

    In the plane the first bar goes from (0, 0) to (1, 0); components are found in isotropic
    coordinates where that takes fewer paths.

    Raises:
        FrameworkError: as `framework_model` does.
    """
    if framework.dimension == 3:
        return _space_model(framework)
    if framework.placement is not None:
        return framework_model(framework)
    pinned, unit = framework.bars[0], framework.squared_lengths[0]
    zero, one = Fraction(0), Fraction(1)
    ends = {pinned[0]: (zero, zero), pinned[1]: (one, zero)}
    return _in_fewer_paths(_metric_model(framework, pinned, ends, [unit, unit]))


def _in_fewer_paths(made: FrameworkModel) -> FrameworkModel:
    """With the isotropic coordinates in which components are found by fewer paths, if they are."""
    found = in_isotropic_coordinates(made)
    if found is None or found.smaller is None or found.smaller.paths >= made.paths:
        return made
    return found


def in_isotropic_coordinates(made: FrameworkModel) -> FrameworkModel | None:
    """With isotropic coordinates in which components are found, whatever the number of paths.

    None if a loop is too long for them.
    """
    other = _by_places(made.framework)
    return None if other is None else replace(made, smaller=other)


def in_each_coordinates(model: FrameworkModel) -> tuple[FrameworkModel, ...]:
    """The same framework in isotropic coordinates z, where they will do, (z, w) and (x, y).

    In space in its own coordinates only.
    """
    framework = model.framework
    if framework.dimension == 3:
        return (model,)
    each = (_by_places(framework), _by_pairs(framework), cartesian_model(framework))
    return tuple(replace(m, smaller=None, instead=None) for m in each if m is not None)


def _plane_model(framework: Framework) -> FrameworkModel:
    pinned, unit = framework.bars[0], framework.squared_lengths[0]
    reference = {}
    origin, end = (_place(framework, p) for p in pinned)
    along = difference(end, origin)
    for point in framework.points:
        x, y = difference(_place(framework, point), origin)
        reference[point] = (
            (x * along[0] + y * along[1]) / unit,
            (y * along[0] - x * along[1]) / unit,
        )
    return _metric_model(framework, pinned, reference, [unit, unit])


def pin_differently(model: FrameworkModel) -> FrameworkModel | None:
    """The same realisations with other points held: another bar, or in space three other points.

    Coordinates in one frame are polynomials in those in the other. None if there is no other.
    """
    framework, known = model.framework, frozenset(model.pinned)
    if framework.dimension == 3:
        try:
            return _space_model(framework, known)
        except FrameworkError:
            return None
    count = len(framework.bars)
    first = next((i for i in range(count) if frozenset(framework.bars[i]) != known), None)
    if first is None:
        return None
    order = [first, *(i for i in range(count) if i != first)]
    bars = tuple(framework.bars[i] for i in order)
    squared = tuple(framework.squared_lengths[i] for i in order)
    turned = replace(framework, bars=bars, squared_lengths=squared)
    return replace(cartesian_model(turned), smaller=None)


def space_models(
    framework: Framework, lines: Sequence[Collection[str]] = ()
) -> Iterator[FrameworkModel]:
    """A framework in space with each triangle pinned, then with each two bars that meet.

    None where all such points are in line.

    Args:
        lines: points that are in line in all realisations that are asked for.
    """
    for pinned in (*framework.triangles(), *framework.bars_that_meet()):
        if any(set(pinned) <= set(line) for line in lines):
            continue
        first, second, third = pinned
        s, t = (framework.squared_length(first, other) for other in (second, third))
        opposite = framework.squared_length(second, third)
        assert s is not None and t is not None
        if framework.placement is not None:
            u, v = _third_in_plane(*(_place(framework, p) for p in pinned))
        elif opposite is not None:
            u = (t + s - opposite) / (2 * s)
            v = t - u * u * s
        else:
            u, v = Fraction(0), s
        # The third point is first + u e1 + e2, with e1 of squared length s, e2 of squared length v.
        if is_zero(v):
            continue
        size = Fraction(max(1, round(sqrt(float(s)))))
        if framework.placement is not None:
            reference = _in_frame(framework, pinned, size)
        else:
            zero, one = Fraction(0), Fraction(1)
            reference = dict(
                zip(pinned, ((zero,) * 3, (one, zero, zero), (u, one, zero)), strict=True)
            )
        metric = [s, v, v * s / (size * size)]
        yield _metric_model(framework, pinned, reference, metric, opposite is None)


def _space_model(framework: Framework, without: frozenset[str] = frozenset()) -> FrameworkModel:
    models = space_models(framework)
    model = next((m for m in models if frozenset(m.pinned) != without), None)
    if model is None:
        raise FrameworkError(
            "all bars that meet are in line; a framework in space needs two that are not, which "
            "are pinned",
            "bars",
        )
    return model


def model_in_line(framework: Framework) -> FrameworkModel:
    """A framework in space for realisations with all points in line; its first bar is pinned.

    A third point is held in a plane with it, and may be in line.
    """
    pinned = (*framework.bars[0], next(iter(framework.points_not_on(framework.bars[0]))))
    zero, one, s = Fraction(0), Fraction(1), framework.squared_lengths[0]
    places: tuple[Place, ...] = ((zero,) * 3, (one, zero, zero), (zero, one, zero))
    held = dict(zip(pinned, places, strict=True))
    made = _metric_model(framework, pinned, held, [s, s, s], third_moves=True)
    return replace(made, system=replace(made.system, nonzero=()))


def _third_in_plane(origin: Place, second: Place, third: Place) -> tuple[Number, Number]:
    """The share of the third point's vector along the second's, and what is left, squared."""
    along, gap = difference(second, origin), difference(third, origin)
    share = dot(gap, along) / dot(along, along)
    return share, dot(gap, gap) - share * share * dot(along, along)


def _in_frame(
    framework: Framework, pinned: Sequence[str], size: Fraction
) -> dict[str, tuple[Number, ...]]:
    """The placement in the frame of the pinned triangle, e3 = e1 x e2 / size."""
    origin, second, third = (_place(framework, p) for p in pinned)
    e1 = difference(second, origin)
    gap = difference(third, origin)
    share = dot(gap, e1) / dot(e1, e1)
    e2 = tuple(x - share * y for x, y in zip(gap, e1, strict=True))
    e3 = tuple(x / size for x in cross(e1, e2))
    frame = (e1, e2, e3)
    return {
        point: tuple(
            dot(difference(_place(framework, point), origin), e) / dot(e, e) for e in frame
        )
        for point in framework.points
    }


def _metric_model(
    framework: Framework,
    pinned: tuple[str, ...],
    reference: dict[str, tuple[Number, ...]],
    metric: Sequence[Number],
    third_moves: bool = False,
) -> FrameworkModel:
    """Coordinates along orthogonal vectors whose squared lengths are ``metric``.

    Args:
        third_moves: the third pinned point is held in the plane of the first two vectors only.
    """
    d = framework.dimension
    free, letters = framework.points_not_on(pinned), "xyz"[:d]
    in_plane = (f"x_{pinned[-1]}", f"y_{pinned[-1]}") if third_moves else ()
    names = (*in_plane, *(f"{letter}_{p}" for p in free for letter in letters))
    n, variables = len(names), Polynomial.variables(len(names))
    places: dict[str, Sequence[Any]] = {p: _constants(n, reference[p]) for p in pinned}
    if third_moves:
        places[pinned[-1]] = (*variables[:2], Polynomial(n, {}))
    start = len(in_plane)
    places |= {p: variables[start + d * i :][:d] for i, p in enumerate(free)}
    equations = []
    for (a, b), squared in zip(framework.bars, framework.squared_lengths, strict=True):
        gap = difference(places[a], places[b])
        if not any(x.support for x in gap):
            continue
        norm = sum((x * x * m for x, m in zip(gap, metric, strict=True)), Polynomial(n, {}))
        equations.append((norm - squared) / metric[0])
    system = PolynomialSystem(names, tuple(equations), tuple(variables[1:2]) if third_moves else ())
    last = letters[-1]
    flips = [last, "yz"] if third_moves else [last]
    symmetries = tuple(
        SignedPermutation.of_signs(tuple(-1 if name[0] in flip else 1 for name in names))
        for flip in flips
    )
    at = None
    if framework.placement is not None:
        held = reference[pinned[-1]][:2] if third_moves else ()
        at = (*held, *(x for p in free for x in reference[p]))
    held_at = tuple(tuple(reference[p]) for p in pinned)
    return FrameworkModel(
        framework, pinned, letters, system, at, symmetries, held=held_at, metric=tuple(metric)
    )


def _unknowns(
    framework: Framework, pinned: Sequence[str], letters: str
) -> tuple[list[str], tuple[Polynomial, ...], tuple[str, ...]]:
    """The points that are not pinned, their coordinates in order, and the names of these."""
    free = framework.points_not_on(pinned)
    names = tuple(f"{letter}_{p}" for p in free for letter in letters)
    return free, Polynomial.variables(len(names)), names


def _constants(n: int, values: Sequence[Number | int]) -> tuple[Polynomial, ...]:
    return tuple(Polynomial.constant(n, x) for x in values)


def _place(framework: Framework, point: str) -> Place:
    assert framework.placement is not None
    return framework.placement[framework.points.index(point)]
