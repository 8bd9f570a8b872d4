"""Intersect random pairs of components in coordinates of very unequal sizes; count the verdicts.

    python tests/many_intersections.py [--pairs 0:60] [--seeds 0:1] [--largest 10] [--equations]

Each variable of a pair is in a unit of its own, ten to a random power between -LARGEST and LARGEST.
The truth is that of the pair without units, by minimal primes modulo a prime (Singular): for each
dimension the sum of the degrees of the components. With `--equations` the first component meets
the equations of the second one instead. Prints a line for each pair that is not right,
and the totals; exit status 1 if an answer that is called complete is wrong.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from exact_counts import modular
from random_small import sparse
from singular_counts import PRIME, Singular, SingularError

from nag.algebra.evaluation import Evaluator
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.changes import NAMES
from nag.decomposition import intersect_components, intersect_equations
from nag.decomposition.decompose import decompose
from nag.numerics.zero_values import ON
from nag.witness.witness import Decomposition, WitnessSet

PRIMES = """
proc kinds(ideal I) {
  list primes = minAssGTZ(I); int i; ideal P;
  for (i = 1; i <= size(primes); i++) {
    P = std(primes[i]);
    if (dim(P) >= 0) { print("part " + string(dim(P)) + " " + string(mult(P))); }
  }
}
"""
# Seconds by the clock for the truth of a pair.
LIMIT = 5.0
KINDS = ("surfaces", "double", "curve", "apart")
# Degrees of random polynomials, and draws until components are irreducible.
DEGREES, MOST_DRAWS = (1, 2, 2, 3), 50


class Pair:
    """Equations of two irreducible sets.

    Attributes:
        first, second: their own equations.
        system: equations that both are components of; None if they are of two systems.
    """

    def __init__(self, number: int) -> None:
        rng = np.random.default_rng([number, 31])
        self.kind, self.number = KINDS[number % len(KINDS)], number
        for _ in range(MOST_DRAWS):
            n = 3 if self.kind == "curve" else int(rng.choice([2, 3, 3, 4]))
            f, g, h = (sparse(n, int(rng.choice(DEGREES)), 0, rng) for _ in range(3))
            self.n, self.first, self.second = n, (f,), (g,)
            self.system: tuple[Polynomial, ...] | None = (f * g,)
            if self.kind == "double":
                self.system = (f**2 * g,)
            elif self.kind == "curve":
                self.second, self.system = (g, h), (f * g, f * h)
            elif self.kind == "apart":
                self.second, self.system = ((g, h) if n > 2 else (g,)), None
            if all(map(self._irreducible, (self.first, self.second))):
                return
        raise RuntimeError(f"pair {number}: no irreducible sets were drawn")

    def _irreducible(self, equations: Sequence[Polynomial]) -> bool:
        found = decompose(PolynomialSystem(NAMES[: self.n], tuple(equations)))
        if not (found.complete and len(found.components) == 1):
            return False
        (component,) = found.components
        right = component.dimension == self.n - len(equations) and component.multiplicity == 1
        return right and component.dimension > 0


def truth(pair: Pair, process: Singular) -> Counter[int]:
    """Sums of degrees by dimension of the intersection."""
    names = [f"x({k})" for k in range(pair.n)]
    texts = [
        " + ".join(
            "*".join([str(modular(c, PRIME)), *(f"{x}^{k}" for x, k in zip(names, e, strict=True))])
            for e, c in f.terms.items()
        )
        for f in (*pair.first, *pair.second)
    ]
    commands = f"ring r = {PRIME}, (x(0..{pair.n - 1})), dp; short = 0;\n"
    lines = process.ask(f"{commands}ideal I = {', '.join(texts)};\nkinds(I);", LIMIT)
    found: Counter[int] = Counter()
    for line in lines:
        kind, *numbers = line.split()
        if kind == "part":
            dimension, degree = map(int, numbers)
            found[dimension] += degree
    return found


def in_units(polynomials: Sequence[Polynomial], powers: Sequence[int]) -> tuple[Polynomial, ...]:
    """The polynomials whose zeros are ten to the ``powers`` as large."""
    units = [Fraction(10) ** p for p in powers]
    return tuple(
        Polynomial(f.n, {e: c / _product(units, e) for e, c in f.terms.items()})
        for f in polynomials
    )


def _product(units: Sequence[Fraction], exponents: Sequence[int]) -> Fraction:
    result = Fraction(1)
    for unit, k in zip(units, exponents, strict=True):
        result *= unit**k
    return result


def chosen(
    whole: Decomposition, own: Sequence[Polynomial], powers: Sequence[int]
) -> WitnessSet | None:
    """The component on which equations without units hold; None if that is not one component."""
    evaluator = Evaluator.of(own, whole.system.n)
    plain = [c.points * 10.0 ** -np.array(powers) for c in whole.components]
    found = [k for k, x in enumerate(plain) if evaluator.residuals(x).max(initial=0.0) < ON]
    return whole.components[found[0]] if len(found) == 1 else None


def intersected(
    pair: Pair, powers: Sequence[int], seed: int, equations: bool
) -> Decomposition | str:
    """The intersection in units; why there is none if the components were not found."""
    names = NAMES[: pair.n]
    first, second = in_units(pair.first, powers), in_units(pair.second, powers)
    systems = [in_units(pair.system, powers)] * 2 if pair.system else [first, second]
    wholes = [decompose(PolynomialSystem(names, each), seed=seed) for each in systems]
    own = pair.first, pair.second
    components = [chosen(w, each, powers) for w, each in zip(wholes, own, strict=True)]
    if None in components or not all(whole.complete for whole in wholes):
        return "the components were not found"
    system = wholes[0].system
    if equations:
        further = PolynomialSystem(names, second)
        return intersect_equations(system, components[0], further, seed=seed)
    return intersect_components(system, *components, seed=seed)


def verdict(found: Decomposition | str, right: Counter[int]) -> tuple[str, str]:
    """One word, and what was found."""
    if isinstance(found, str):
        return "open", found
    have: Counter[int] = Counter()
    for c in found.components:
        have[c.dimension] += c.degree
    text = f"{dict(have)} for {dict(right)} {'; '.join(found.notes)}"
    if found.complete:
        return ("right" if have == right else "wrong"), text
    return "open", text


def span(text: str) -> range:
    """The numbers that ``"first:last+1"`` stands for."""
    return range(*map(int, text.split(":")))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=span, default=range(60))
    parser.add_argument("--seeds", type=span, default=range(1))
    parser.add_argument("--largest", type=int, default=10)
    parser.add_argument("--equations", action="store_true")
    options = parser.parse_args(arguments)
    process, totals, begin = Singular(), Counter(), time.process_time()
    process.ask(PRIMES, LIMIT)
    for number in options.pairs:
        pair = Pair(number)
        try:
            right = truth(pair, process)
        except SingularError:
            totals["no truth"] += 1
            process = Singular()
            process.ask(PRIMES, LIMIT)
            continue
        for seed in options.seeds:
            rng = np.random.default_rng([number, seed, 32])
            powers = rng.integers(-options.largest, options.largest + 1, pair.n).tolist()
            try:
                word, text = verdict(intersected(pair, powers, seed, options.equations), right)
            except Exception as error:  # A campaign is not to end with one pair.
                word, text = "error", f"{type(error).__name__}: {error}"
            totals[word] += 1
            if word != "right":
                print(f"{pair.kind} {number}, seed {seed}, units {powers}: {word}: {text}")
                sys.stdout.flush()
    print(f"{dict(totals)} in {time.process_time() - begin:.1f} s")
    return int(bool(totals["wrong"] or totals["error"]))


if __name__ == "__main__":
    sys.exit(main())
