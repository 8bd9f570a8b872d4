"""For which parameters families have singular members, against exact elimination.

    python tests/discriminants.py [--seeds 0:1] [--only TEXT] [--random] [--threads N]
        [--limit SECONDS]

Each seed draws other whole coefficients for the families; with `--random`, it draws one family of
one or two sparse equations, in one to three variables and parameters. The oracle is Singular: the
elimination ideal of the equations and the minors of their Jacobian, and its minimal primes over the
rational numbers. Where it is not installed or too slow, families in one variable have the
discriminant that sympy finds; others have no oracle. Prints a line for each family, and a table by
the largest degree of a condition: right, open (and said so), wrong, without an oracle. Exit status
1 if an answer is wrong: a condition that is no component, or a component that is missing where
nothing is said to be open.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations

import numpy as np
from singular_counts import Singular, SingularError

import nag
from nag.algebra.expression import parse_polynomial
from nag.algebra.factoring import factor_into_irreducibles
from nag.algebra.polynomial import Polynomial
from nag.algebra.smoothness import determinant
from nag.decomposition import singular_parameters
from nag.decomposition.singular_members import SingularParameters

# Equations, variables and parameters; each # stands for a whole number that is drawn.
FAMILIES = (
    ("x^2 + #*a*x + #*b", "x", "a b"),
    ("x^3 + #*x^2 + a", "x", "a"),
    ("x^3 + a*x + #*b", "x", "a b"),
    ("x^3 + a*x^2 + b*x + #*c", "x", "a b c"),
    ("#*x^3 + #*a*x^2 + b*x + c + #", "x", "a b c"),
    ("x^4 + #*x^2 + #*x + a", "x", "a"),
    ("x^4 + #*a*x^2 + b*x + #*c", "x", "a b c"),
    ("x^4 + a*x^3 + b*x^2 + #*x + c", "x", "a b c"),
    ("a*x^4 + #*x^3 + b*x^2 + x + #", "x", "a b"),
    ("#*x^5 + a*x + b", "x", "a b"),
    ("x^5 + a*x^2 + b*x + #", "x", "a b"),
    ("x^5 + a*x^3 + b*x + #*c", "x", "a b c"),
    ("x^6 + a*x^2 + #*x + b", "x", "a b"),
    ("x^6 + #*x^4 + #*x + a", "x", "a"),
    ("x^7 + a*x^2 + b*x + #*c", "x", "a b c"),
    ("x^8 + #*x^3 + #*x + a", "x", "a"),
    ("x^10 + #*x^3 + a*x + b", "x", "a b"),
    ("x^12 + #*x^7 + #*x + a", "x", "a"),
    ("x^13 + #*x^5 + #*x^2 + #*x + a", "x", "a"),
    ("y^2 - x^3 + x - a", "x y", "a"),
    ("y^2 - x^3 + 1000000*x - a", "x y", "a"),
    ("y^2 - (x - 1000)^3 + #*x - a - b", "x y", "a b"),
    ("y^2 - x^3 - a*x - b", "x y", "a b"),
    ("(y - 7)^2 + #*(x - 1000000)^3 + a*(x - 1000000) + b", "x y", "a b"),
    ("y^2 - x^3 - (a - 10000)*x + #*b + 1000", "x y", "a b"),
    ("y^2 - x^4 - a*x^2 - b*x + #", "x y", "a b"),
    ("y^2 - x^5 + #*a*x + b", "x y", "a b"),
    ("y^2 - x^6 + #*x^2 + a*x + b", "x y", "a b"),
    ("x^2 + #*y^2 + #*a*x*y + b*x + #", "x y", "a b"),
    ("x^3 + y^3 + # + a*x*y", "x y", "a"),
    ("x^3 + y^3 + # + a*x*y + b*x", "x y", "a b"),
    ("x^3 + #*y^3 + 1 + a*x + b*y", "x y", "a b"),
    ("x^3 + y^3 + # + a*(x^2*y + #*y + x) + b*(x*y^2 + 3*x^2 - 1)", "x y", "a b"),
    ("x^4 + y^4 + # + a*x*y", "x y", "a"),
    ("x^4 + y^3 + #*x^2*y + #*x + a", "x y", "a"),
    ("x^3 + #*y^2 + a*x*y + b", "x y", "a b"),
    ("y^3 - x^4 + a*x + #*y + b", "x y", "a b"),
    ("x^2*y + #*y^2 + a*x + b*y + c", "x y", "a b c"),
    ("x*y*(x + #*y + #) - a", "x y", "a"),
    ("y^2 - (x^2 - 2)*(x - a)", "x y", "a"),
    ("y^2 - (x^3 - 2)*(x - a)*(x - b)", "x y", "a b"),
    ("x^2 + #*y^2 - a^2 + 2*b^2", "x y", "a b"),
    ("x^2 + #*y^2 + a^4 + #*b^4", "x y", "a b"),
    ("y^2 - x^3 - a", "x y", "a"),
    ("y^3 - x^4 - a^2 + #*b", "x y", "a b"),
    ("x^2 + #*y^2 + z^2 + a*x*y + b*z + #", "x y z", "a b"),
    ("x*y*z + a*x + b*y + #*z + 1", "x y z", "a b"),
    ("x^2 + y^2 + z^3 + a*z + #*b", "x y z", "a b"),
    ("x^3 + y^3 + z^3 + # + a*x*y*z", "x y z", "a"),
    ("x^2*z + #*y^2 + a*x + b*y + c*z", "x y z", "a b c"),
    ("x*y*z - a*x - b*y - c", "x y z", "a b c"),
    ("x*(a^3 - 2) + y*(b - a)*(b^2 + #)", "x y", "a b"),
    ("x^2 + y^2 - 1; #*x^2 + a*y^2 - b", "x y", "a b"),
    ("x*y - a; x + #*y - b", "x y", "a b"),
    ("x^2 + y^2 - 1; (x - a)^2 + (y - b)^2 - #", "x y", "a b"),
    ("y - x^3; #*y - a*x - b", "x y", "a b"),
    ("y - x^2; x^2 + #*y^2 + a*x + b", "x y", "a b"),
    ("x^2 + y^2 + z^2 - #; x*y + a*z + b", "x y z", "a b"),
    ("x^2 + y^2 + z^2 - #; z - a*x - b", "x y z", "a b"),
    ("x^2 + y^2 - 1; z^2 + #*x - a", "x y z", "a"),
    ("x^2 + # - a*y; y^2 - b", "x y", "a b"),
    ("a*s + b*t; u^2 + s^2 - 1; v^2 + t^2 - 1", "s t u v", "a b"),
    ("(x^2 - a)*(y - b)", "x y", "a b"),
    ("x^2*(x - a) + #*y^2", "x y", "a"),
    ("y - x^3 - a*x - b", "x y", "a b"),
)

LIBRARIES = 'LIB "primdec.lib"; LIB "elim.lib"; option(redSB); option(noredefine);'


# How often a coefficient has a parameter, and a number is added to it.
WITH_PARAMETER, WITH_NUMBER = 0.6, 0.3

# Families at which a process of Singular's ended.
ENDED: list[str] = []


@dataclass(frozen=True)
class Family:
    """A family with its coefficients.

    Attributes:
        system: equations in variables and, last, parameters.
        count: how many are parameters.
    """

    text: str
    system: nag.PolynomialSystem
    count: int

    @property
    def parameters(self) -> tuple[str, ...]:
        return self.system.variables[self.system.n - self.count :]


def family(number: int, seed: int) -> Family:
    """A family with the coefficients of a seed."""
    template, variables, parameters = FAMILIES[number]
    rng = np.random.default_rng([seed, number])
    first, *rest = template.split("#")
    drawn = [f"({int(c)})" for c in rng.choice([-7, -5, -4, -3, -2, 2, 3, 4, 5, 7], len(rest))]
    text = first + "".join(c + piece for c, piece in zip(drawn, rest, strict=True))
    system = nag.system(text.split(";"), f"{variables} {parameters}")
    return Family(text, system, len(parameters.split()))


def random_family(seed: int) -> Family:
    """Few terms of degree three at most, their coefficients with and without parameters."""
    rng = np.random.default_rng([seed, 1000])
    variables = "xyz"[: rng.integers(1, 4)]
    parameters = "abc"[: rng.integers(1, 4)]
    texts = []
    for _ in range(min(len(variables), int(rng.integers(1, 3)))):
        terms = []
        for _ in range(int(rng.integers(3, 6))):
            factors = [str(int(rng.integers(1, 6)) * int(rng.choice([-1, 1])))]
            factors += list(rng.choice(list(variables), int(rng.integers(0, 4))))
            if rng.random() < WITH_PARAMETER:
                form = "{} + {}" if rng.random() < WITH_NUMBER else "{}"
                factors.append("(" + form.format(rng.choice(list(parameters)), seed % 5 - 2) + ")")
            terms.append("*".join(factors))
        texts.append(" + ".join(f"({term})" for term in terms))
    system = nag.system(texts, " ".join(variables + parameters))
    return Family("; ".join(texts), system, len(parameters))


def minors(of: Family) -> list[Polynomial]:
    """The largest minors of the Jacobian in the variables alone."""
    n, m = of.system.n - of.count, len(of.system.polynomials)
    return [
        determinant([[row[j] for j in columns] for row in of.system.jacobian])
        for columns in combinations(range(n), m)
    ]


@cache
def started(generation: int) -> Singular:
    """A process of Singular's; another one after each that has ended."""
    return Singular()


def disagreement(of: Family, found: SingularParameters, oracle: Singular, limit: float) -> str:
    """What a standard basis finds otherwise; empty if nothing.

    Raises:
        SingularError: if there is none in time.
    """
    names = of.system.variables
    ideal = [f.text(names) for f in (*of.system.polynomials, *minors(of)) if f]
    unknowns = "*".join(names[: of.system.n - of.count])
    commands = [
        f"{LIBRARIES} ring r = 0, ({', '.join(names)}), dp; short = 0;",
        f"ideal I = {', '.join(ideal)}; ideal E = eliminate(I, {unknowns});",
        "list L; if (size(E) == 0) { L[1] = ideal(0); }"
        " else { if (reduce(1, std(E)) != 0) { L = minAssGTZ(E); } }",
        "int j; int k; ideal P; ideal Q; list M;",
        'for (j = 1; j <= size(L); j++) { print("prime " + string(L[j])); }',
    ]
    for i, equations in enumerate(found.conditions):
        texts = ", ".join(f.text(found.parameters) for f in equations) or "0"
        commands.append(
            f"P = {texts}; if (size(P) == 0) {{ M = list(P); }} else {{ M = minAssGTZ(P); }}"
            f'if (size(M) != 1) {{ print("reducible {i}"); }}'
            "P = std(ideal(M[1])); for (j = 1; j <= size(L); j++) { Q = std(ideal(L[j]));"
            "if (size(reduce(P, Q)) + size(reduce(Q, P)) == 0)"
            f'{{ print("same {i} " + string(j)); }} }}'
        )
    lines = oracle.ask("\n".join(commands), limit)
    primes = [line.removeprefix("prime ") for line in lines if line.startswith("prime ")]
    same = [tuple(map(int, line.split()[1:])) for line in lines if line.startswith("same ")]
    doubts = [line for line in lines if line.startswith("reducible ")]
    held, met = {i for i, _ in same}, {j for _, j in same}
    doubts += [f"no component: {t}" for i, t in enumerate(found.texts()) if i not in held]
    if found.complete:
        doubts += [f"missing: {p[:300]}" for j, p in enumerate(primes, 1) if j not in met]
    return "; ".join(doubts)


def disagreement_with_discriminant(of: Family, found: SingularParameters) -> str | None:
    """What the discriminant of one polynomial in one variable, monic, has otherwise.

    None for other families.
    """
    import sympy

    names = of.system.variables
    if of.system.n - of.count > 1 or len(of.system.polynomials) > 1:
        return None
    x, f = sympy.Symbol(names[0]), sympy.sympify(of.system.polynomials[0].text(names))
    if not sympy.Poly(f, x).LC().is_number:
        return None
    text = str(sympy.expand(sympy.discriminant(f, x))).replace("**", "^")
    known = {_monic(p) for p, _ in factor_into_irreducibles(parse_polynomial(text, of.parameters))}
    own = {_monic(f) for equations in found.conditions for f in equations}
    doubts = [f"no component: {f.text(of.parameters)}" for f in own - known]
    if found.complete:
        doubts += [f"missing: {f.text(of.parameters)}" for f in known - own]
    return "; ".join(doubts)


def _monic(f: Polynomial) -> Polynomial:
    return f / f.terms[max(f.terms)]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seeds", default="0:1", help="first and last but one: 0:10")
    parser.add_argument("--only", default="", help="families whose text holds this")
    parser.add_argument("--random", action="store_true", help="one random family a seed")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for the oracle")
    options = parser.parse_args(arguments)
    counts: Counter[tuple[int, str]] = Counter()
    for seed in range(*map(int, options.seeds.split(":"))):
        drawn = [family(number, seed) for number in range(len(FAMILIES))]
        for of in [random_family(seed)] if options.random else drawn:
            if options.only in of.text:
                counts[judged(of, seed, options.threads, options.limit)] += 1
    words = ("right", "open", "wrong", "no oracle")
    print("degree   " + "".join(f"{word:>11}" for word in words))
    for degree in sorted({d for d, _ in counts}):
        print(f"{degree:<9}" + "".join(f"{counts[degree, word]:>11}" for word in words))
    totals = [sum(c for (_, w), c in counts.items() if w == word) for word in words]
    print("all      " + "".join(f"{total:>11}" for total in totals))
    return int(any(word == "wrong" for _, word in counts))


def judged(of: Family, seed: int, threads: int, limit: float) -> tuple[int, str]:
    """The largest degree of a condition that was found, and the verdict, which is printed."""
    begin = time.process_time()
    found = singular_parameters(of.system, of.count, seed=seed, threads=threads)
    spent = time.process_time() - begin
    degree = max((each.degree for each in found.sets if each.equations), default=0)
    doubts: str | None
    oracle = "Singular"
    try:
        doubts = disagreement(of, found, started(len(ENDED)), limit)
    except (SingularError, OSError):
        ENDED.append(of.text)
        oracle, doubts = "sympy", disagreement_with_discriminant(of, found)
    verdict = "right" if found.complete else "open"
    if doubts is None:
        verdict = "no oracle"
    elif doubts:
        verdict = "wrong"
    proofs = ", ".join(sorted({each.proof for each in found.sets}))
    print(f"{verdict:10}{degree:3} {spent:6.2f} s  seed {seed}  {of.text}  {proofs}  ({oracle})")
    for line in (*found.notes, *([doubts] if doubts else [])):
        print("    " + line)
    sys.stdout.flush()
    return degree, verdict


if __name__ == "__main__":
    sys.exit(main())
