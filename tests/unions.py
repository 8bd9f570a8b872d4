"""Random unions of prescribed irreducible components, whose decomposition is known beforehand.

    python tests/unions.py --seeds 0:1000

decomposes many of them and prints the seeds whose answer is wrong or incomplete.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import product
from operator import mul

import numpy as np

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.witness.witness import Decomposition

NAMES = ("x", "y", "z", "w")
# Products of ideals have the product of the numbers of generators.
MOST_EQUATIONS = 40
HIGHEST_DEGREE = 6
MOST_TRIES = 1000


@dataclass(frozen=True)
class Component:
    """An irreducible set: what it is, its ideal's generators, and rational points of it."""

    name: str
    dimension: int
    degree: int
    generators: tuple[Polynomial, ...]
    point: Callable[[np.random.Generator], list[Fraction]]

    def contains(self, point: list[Fraction]) -> bool:
        return all(f(point) == 0 for f in self.generators)

    @property
    def height(self) -> int:
        """The highest degree of a generator."""
        return max((f.degree for f in self.generators), default=0)


@dataclass(frozen=True)
class Union:
    """A union of components and the polynomials that vanish on it exactly."""

    components: tuple[Component, ...]
    system: PolynomialSystem
    truth: Counter[tuple[int, int, int]]


def _number(rng: np.random.Generator) -> Fraction:
    return Fraction(int(rng.integers(-9, 10)), int(rng.integers(1, 5)))


def _standard(kind: str, d: int, n: int) -> tuple[int, list[Polynomial], Callable]:
    """Degree, generators and parametrisation in the first coordinates; the others are zero."""
    x = Polynomial.variables(n)

    def padded(values: list[Fraction]) -> list[Fraction]:
        return values + [Fraction(0)] * (n - len(values))

    def free(rng: np.random.Generator) -> list[Fraction]:
        return [_number(rng) for _ in range(d)]

    if kind == "linear":
        return 1, list(x[d:]), lambda rng: padded(free(rng))
    if kind == "paraboloid":

        def on_paraboloid(rng: np.random.Generator) -> list[Fraction]:
            t = free(rng)
            return padded([*t, sum(v * v for v in t)])

        f = x[d] - sum(v * v for v in x[:d])
        return 2, [f, *x[d + 1 :]], on_paraboloid
    if kind == "sphere":

        def on_sphere(rng: np.random.Generator) -> list[Fraction]:
            t = free(rng)
            s = sum(v * v for v in t)
            return padded([*(2 * v / (1 + s) for v in t), (1 - s) / (1 + s)])

        return 2, [sum(v * v for v in x[: d + 1]) - 1, *x[d + 1 :]], on_sphere
    if kind == "twisted cubic":

        def on_cubic(rng: np.random.Generator) -> list[Fraction]:
            t = _number(rng)
            return padded([t, t**2, t**3])

        return 3, [x[1] - x[0] ** 2, x[2] - x[0] * x[1], *x[3:]], on_cubic

    def on_cusp(rng: np.random.Generator) -> list[Fraction]:
        t = _number(rng)
        return padded([t**2, t**3])

    return 3, [x[1] ** 2 - x[0] ** 3, *x[2:]], on_cusp


def _affine(
    rng: np.random.Generator, n: int
) -> tuple[list[Polynomial], Callable[[list[Fraction]], list[Fraction]]]:
    """Random linear forms, and the inverse of the affine map that they are."""
    x = Polynomial.variables(n)
    # A product of unit triangular matrices, the inverse of which is as short as itself.
    lower = [[Fraction(int(rng.integers(-2, 3))) for _ in range(i)] for i in range(n)]
    upper = [[Fraction(int(rng.integers(-2, 3))) for _ in range(n - i - 1)] for i in range(n)]
    shift = [_number(rng) for _ in range(n)]
    order = rng.permutation(n).tolist()
    middle = [x[order[i]] + sum((c * x[order[i + 1 + j]] for j, c in enumerate(row)), shift[i])
              for i, row in enumerate(upper)]  # fmt: skip
    forms = [m + sum((c * middle[j] for j, c in enumerate(lower[i])), Fraction(0))
             for i, m in enumerate(middle)]  # fmt: skip

    def inverse(y: list[Fraction]) -> list[Fraction]:
        m: list[Fraction] = []
        for i, value in enumerate(y):
            m.append(value - sum(c * m[j] for j, c in enumerate(lower[i])))
        point = [Fraction(0)] * n
        for i in reversed(range(n)):
            point[order[i]] = m[i] - shift[i]
            for j, c in enumerate(upper[i]):
                point[order[i]] -= c * point[order[i + 1 + j]]
        return point

    return forms, inverse


def _component(rng: np.random.Generator, n: int) -> Component:
    kinds = [("linear", d) for d in range(min(n, 4))]
    kinds += [(k, d) for k in ("paraboloid", "sphere") for d in range(1, n)]
    kinds += [("twisted cubic", 1), ("cuspidal cubic", 1)]
    kind, d = kinds[rng.integers(len(kinds))]
    degree, generators, parametrised = _standard(kind, d, n)
    forms, inverse = _affine(rng, n)
    return Component(
        f"{kind} of dimension {d}",
        d,
        degree,
        tuple(f.compose(forms) for f in generators),
        lambda rng: inverse(parametrised(rng)),
    )


def random_union(seed: int) -> Union:
    """Two or three components in three or four variables, no two of them equal.

    Every product of one generator of each component is an equation, so all components are simple.
    A component inside another one does not count.
    """
    rng = np.random.default_rng([seed, 7])
    n = int(rng.integers(3, 5))
    wanted = int(rng.integers(2, 4))
    chosen: list[Component] = []
    tries = 0
    # Two components may leave no room for a third.
    while len(chosen) < wanted and (tries < MOST_TRIES or len(chosen) < 2):
        tries += 1
        new = _component(rng, n)
        equations = reduce(mul, (len(c.generators) for c in [*chosen, new]))
        if equations > MOST_EQUATIONS or sum(c.height for c in [*chosen, new]) > HIGHEST_DEGREE:
            continue
        if not any(c.contains(new.point(rng)) and new.contains(c.point(rng)) for c in chosen):
            chosen.append(new)
    equations = [reduce(mul, choice) for choice in product(*(c.generators for c in chosen))]
    order = rng.permutation(len(equations))
    system = PolynomialSystem(NAMES[:n], tuple(equations[i] for i in order))
    points = [c.point(rng) for c in chosen]
    truth = Counter(
        (c.dimension, c.degree, 1)
        for c, point in zip(chosen, points, strict=True)
        if not any(other.contains(point) for other in chosen if other is not c)
    )
    return Union(tuple(chosen), system, truth)


def found(answer: Decomposition) -> Counter[tuple[int, int, int]]:
    """Components by dimension, degree and multiplicity."""
    return Counter((c.dimension, c.degree, c.multiplicity) for c in answer.components)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", default="0:100", help="first:last+1")
    parser.add_argument("--settings", default="default")
    parser.add_argument("--print", action="store_true", help="print the systems of wrong answers")
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(":"))
    wrong, begin = [], time.perf_counter()
    for seed in range(first, last):
        union, start = random_union(seed), time.perf_counter()
        answer = decompose(union.system, seed=seed, settings=options.settings)
        seconds = time.perf_counter() - start
        if answer.complete and found(answer) == union.truth:
            continue
        wrong.append(seed)
        print(f"seed {seed} ({seconds:.1f} s): {', '.join(c.name for c in union.components)}")
        print(f"  expected {dict(union.truth)}, found {dict(found(answer))}")
        reasons = {c.note for c in answer.components if c.note}
        print(f"  {answer.paths} {'; '.join([*answer.notes, *reasons])}", flush=True)
        if options.print:
            print(f"  variables {union.system.variables}")
            print("".join(f"    {text}\n" for text in union.system.text()))
    print(f"{last - first} unions, {len(wrong)} wrong or incomplete: {wrong}; ", end="")
    print(f"{time.perf_counter() - begin:.1f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
