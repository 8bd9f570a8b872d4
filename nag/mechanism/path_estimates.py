"""The equations that a mechanism or parts may have, and how many paths each may ask for.

These numbers are what the choice among formulations, and among coordinates, goes by.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, combinations
from math import comb, factorial, prod
from operator import mul, sub
from typing import Any

from nag.algebra.elimination import eliminate_linear
from nag.algebra.system import PolynomialSystem
from nag.algebra.turns import looped_turns
from nag.errors import MechanismError

# So many ways to spend what equations leave are followed at most, whatever time that takes: the
# choice of a model must not depend on the machine.
MOST_STATES = 2_000
# Seconds that a path of a decomposition takes at least.
LEAST_SECONDS = 1e-4
# More paths take from half a minute to hours, so that a parallel robot is decomposed by its
# platform's poses, where these take fewer.
MOST_DECOMPOSED = 10**4
# Of still more not even the component through a reference is found from there: they do not decide
# which equations a parallel robot gets. (That of 3-RRS legs, of 171,000 paths, is, of degree 432.)
MOST_TRACKED = 10**6


class ModelError(MechanismError):
    """A mechanism that the asked formulation does not cover."""


class NoLoopError(ModelError):
    """A mechanism without loops, whose joints all move freely."""


@dataclass(frozen=True)
class Alternative:
    """Equations that a mechanism, a table or parts may have, or why they have none like that.

    Attributes:
        formulation: its name; of parts that have none, that of their coordinates.
        form: what the equations are those of; None if the formulation does not cover the
            mechanism.
        problem: why not; empty otherwise.
        solved: what is left of parts' equations when linear ones have been solved; None where those
            of ``form`` have been already.
        stopped: where the choice among formulations was cut short, after what.
        fewer: how many paths another one takes that was left for its long equations, as so many are
            not tracked; 0 if there is none.
    """

    formulation: str
    form: Any
    problem: str = ""
    solved: PolynomialSystem | None = None
    stopped: str = ""
    fewer: int = 0

    @classmethod
    def of_parts(cls, coordinates: str, form: Any) -> Alternative:
        """The equations of parts in some coordinates."""
        return cls(coordinates, form, solved=eliminate_linear(form.system, graphs=False).system)

    @property
    def system(self) -> PolynomialSystem:
        """The equations, the linear ones solved."""
        if self.form is None:
            raise ModelError(f"formulation {self.formulation}: {self.problem}")
        return self.form.system if self.solved is None else self.solved

    def document(self) -> dict[str, Any]:
        """Its numbers, or why there are none, as a JSON object."""
        if self.form is None:
            return {"formulation": self.formulation, "problem": self.problem}
        return {
            "formulation": self.formulation,
            "variables": self.system.n,
            "equations": len(self.system.polynomials),
            "bezout": self.bezout,
            "bound": self.bound,
            "paths": self.paths,
        }

    @property
    def bezout(self) -> int:
        """Product of the degrees of as many equations as there are variables, the lowest."""
        return prod(sorted(f.degree for f in self.system.polynomials)[: self.system.n])

    @property
    def bound(self) -> int:
        """Bezout's number in the variable groups, cut down to points by linear equations."""
        return path_bound(self.system)

    @cached_property
    def at_once(self) -> int | None:
        """Number of paths to a slice where these may be all it takes: see `paths_at_once`."""
        return paths_at_once(self.system if self.solved is None else self.form.system)

    @property
    def most(self) -> int:
        """Estimated number of paths that equation by equation are tracked at most.

        Of parts with their groups of variables or without, whichever are fewer.
        """
        if self.solved is None:
            return estimated_paths(self.system)
        return fewest_estimated_paths(self.solved)

    @property
    def paths(self) -> int:
        """Estimated number of paths: those at once where there are such."""
        return self.at_once or self.most


def path_bound(system: PolynomialSystem) -> int:
    """Bezout's number of the system's lowest degrees, cut down to points by linear equations.

    Multihomogeneous where the system has groups; slices are linear in all variables together.
    """
    polynomials = sorted(system.polynomials, key=lambda f: f.degree)[: system.n]
    if not system.groups:
        return prod(f.degree for f in polynomials)
    degrees = [tuple(f.degree_in(g) for g in system.groups) for f in polynomials]
    return intersection_number(degrees, [len(g) for g in system.groups])


def estimated_paths(system: PolynomialSystem) -> int:
    """Paths of an intersection equation by equation, if no witness point is lost on the way.

    The sum of the Bezout numbers of the first, the first two, ... equations, by rising degree, each
    with as many linear equations as leave points.
    """
    polynomials = sorted((f for f in system.polynomials if f.degree > 0), key=lambda f: f.degree)
    first = polynomials[: system.n]
    if not system.groups:
        return sum(accumulate((f.degree for f in first), mul))
    degrees = [tuple(f.degree_in(g) for g in system.groups) for f in first]
    return sum(intersection_numbers(degrees, [len(g) for g in system.groups])[1:])


def fewest_estimated_paths(system: PolynomialSystem) -> int:
    """The same with the system's groups of variables or without, whichever are fewer."""
    return min(estimated_paths(s) for s in (system, replace(system, groups=())))


def paths_at_once(system: PolynomialSystem) -> int | None:
    """Paths to a slice that are tracked before any equation by equation; None for most systems.

    They are enough where they all end at zeros; only turns in several loops are asked for them.
    """
    if looped_turns(system) is None:
        return None
    # Path tracking takes longer to load than most models take to be made.
    from nag.decomposition import toric_section

    return toric_section.paths_at_once(system)


def intersection_number(degrees: Sequence[Sequence[int]], dimensions: Sequence[int]) -> int:
    """Solutions of equations of these degrees in a product of projective spaces.

    Missing equations are linear in all spaces together.
    """
    return intersection_numbers(degrees, dimensions)[-1]


def intersection_numbers(
    degrees: Sequence[Sequence[int]], dimensions: Sequence[int]
) -> tuple[int, ...]:
    """Solutions of none, the first, the first two, ... of equations in a product of spaces.

    Each with as many equations that are linear in all spaces together as leave points. It is the
    coefficient of the spaces' point class in the product of the classes sum(d_i h_i): after some
    factors, what is left of each space's class is what counts, and r linear equations more choose
    from that in r! / prod(left!) ways. Spaces of the same degrees in all equations that are left
    count as one, of which the classes are sums: so there are as many states as there are ways to
    spend what is begun and not at its end, few where equations are local.

    Where there are more than `MOST_STATES`, spaces of nearly the same degrees are given the larger
    of them; the number is then a bound.

    Args:
        degrees: of each equation, in each space; of more equations than fit, the first count.
        dimensions: of the spaces.
    """
    rows = [tuple(row) for row in degrees[: sum(dimensions)]]
    left = sum(dimensions)
    # What is still to come of each space: equal ones are alike from here on.
    columns = [tuple(row[i] for row in rows) for i in range(len(dimensions))]
    states = {tuple(dimensions): 1}
    columns, states = _join_alike(columns, states)
    numbers = [_in_general_position(states, left)]
    while left > sum(dimensions) - len(rows):
        following: dict[tuple[int, ...], int] = {}
        for state, ways in states.items():
            for i, column in enumerate(columns):
                if column[0] > 0 and state[i]:
                    key = (*state[:i], state[i] - 1, *state[i + 1 :])
                    following[key] = following.get(key, 0) + ways * column[0]
        columns, states = _join_alike([column[1:] for column in columns], following)
        while len(states) > MOST_STATES:
            columns, states = _join_alike(_level_nearest(columns), states)
        left -= 1
        numbers.append(_in_general_position(states, left))
    return tuple(numbers)


def _in_general_position(states: Mapping[tuple[int, ...], int], left: int) -> int:
    """Solutions of as many equations more, each linear in all spaces together."""
    ways = factorial(left)
    return sum(count * ways // prod(map(factorial, state)) for state, count in states.items())


def _join_alike(
    columns: Sequence[tuple[int, ...]], states: Mapping[tuple[int, ...], int]
) -> tuple[list[tuple[int, ...]], dict[tuple[int, ...], int]]:
    """Spaces of the same degrees as one; its class, the sum of theirs, stands for any of them."""
    kinds = list(dict.fromkeys(columns))
    if len(kinds) == len(columns):
        return list(columns), dict(states)
    place = {column: i for i, column in enumerate(kinds)}
    places = [place[column] for column in columns]
    joined: dict[tuple[int, ...], int] = {}
    for state, ways in states.items():
        together = [0] * len(kinds)
        for i, left in zip(places, state, strict=True):
            together[i] += left
            ways *= comb(together[i], left)
        key = tuple(together)
        joined[key] = joined.get(key, 0) + ways
    return kinds, joined


def _level_nearest(columns: Sequence[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Two columns that differ least, each with the larger of their entries."""
    first, second = min(
        combinations(range(len(columns)), 2),
        key=lambda pair: sum(map(abs, map(sub, *(columns[i] for i in pair)))),
    )
    larger = tuple(map(max, columns[first], columns[second]))
    return [larger if i in (first, second) else c for i, c in enumerate(columns)]
