"""Systems that the literature on solving polynomials returns to, from their parameters.

Each maker gives the names of the unknowns and the equations as text, as somebody would write them
down: products stay products. What is random is the same every time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations, combinations_with_replacement, pairwise, product
from math import comb
from pathlib import Path

import numpy as np

from nag.algebra.expression import parse_polynomial
from nag.algebra.system import PolynomialSystem
from nag.files.cases import Case, read_case
from nag.mechanism.model import model

CASES = Path(__file__).resolve().parent.parent / "cases"

Equations = tuple[list[str], list[str]]


@dataclass(frozen=True)
class Classic:
    """A system and how many distinct isolated zeros it has.

    Attributes:
        name: like ``"katsura 10"``.
        count: the number of zeros, None where none is proved.
    """

    name: str
    system: PolynomialSystem
    count: int | None


@dataclass(frozen=True)
class ClassicalFamily:
    """A maker, its parameters, and the numbers of zeros for these."""

    make: Callable[..., Equations]
    counts: dict[tuple[int, ...], int | None]


# --- Makers


def _unknowns(letter: str, n: int) -> list[str]:
    return [f"{letter}{i}" for i in range(1, n + 1)]


def _integers(*shape: int, most: int = 99, seed: int = 0) -> np.ndarray:
    """Random integers without zeros, the same ones every time."""
    rng = np.random.default_rng([seed, *shape])
    return rng.integers(1, most + 1, shape) * rng.choice([-1, 1], shape)


def _form(coefficients: Sequence[int], terms: Sequence[str]) -> str:
    return " + ".join(f"({c})*{t}" for c, t in zip(coefficients, terms, strict=True))


def _determinant(rows: Sequence[Sequence[str]]) -> str:
    (a, b, c), (d, e, f), (g, h, i) = [[f"({entry})" for entry in row] for row in rows]
    return f"{a}*({e}*{i} - {f}*{h}) - {b}*({d}*{i} - {f}*{g}) + {c}*({d}*{h} - {e}*{g})"


def eisen(n: int) -> Equations:
    """Two trinomials, one of a high degree."""
    return ["x1", "x2"], [
        f"x1^{n} - 3*x1^{n // 2 + 1}*x2 + 7*x2^2 - 1",
        "x2^3 + x1^5*x2 - 2*x1 + 5",
    ]


def katsura(n: int) -> Equations:
    """Katsura's magnetism in n + 1 unknowns."""
    x = [f"x{i}" for i in range(n + 1)]
    sums = [
        " + ".join(f"{x[abs(k)]}*{x[abs(m - k)]}" for k in range(-n, n + 1) if abs(m - k) <= n)
        + f" - {x[m]}"
        for m in range(n)
    ]
    return x, [*sums, f"{x[0]} + 2*({' + '.join(x[1:])}) - 1"]


def cyclic(n: int) -> Equations:
    """Bjoerck's cyclic n-roots."""
    z = _unknowns("z", n)
    sums = [
        " + ".join("*".join(z[(i + j) % n] for j in range(m)) for i in range(n))
        for m in range(1, n)
    ]
    return z, [*sums, "*".join(z) + " - 1"]


def noon(n: int) -> Equations:
    """Noonburg's neural network."""
    x = _unknowns("x", n)
    squares = {v: " + ".join(f"{w}^2" for w in x if w != v) for v in x}
    return x, [f"{v}*({squares[v]} - 11/10) + 1" for v in x]


def eco(n: int) -> Equations:
    """Morgan's economics."""
    x = _unknowns("x", n)
    last = x.pop()
    lines = [
        f"({x[k]}"
        + "".join(f" + {x[i]}*{x[i + k + 1]}" for i in range(n - 2 - k))
        + f")*{last} - {k + 1}"
        for k in range(n - 1)
    ]
    return [*x, last], [*lines, f"{' + '.join(x)} + 1"]


def redeco(n: int) -> Equations:
    """Economics with the inverse of the last unknown in its place."""
    x = _unknowns("x", n - 1)
    lines = [
        x[k] + "".join(f" + {x[i]}*{x[i + k + 1]}" for i in range(n - 2 - k)) + f" - {k + 1}*u"
        for k in range(n - 1)
    ]
    return [*x, "u"], [*lines, f"{' + '.join(x)} + 1"]


def chandra(n: int) -> Equations:
    """Chandrasekhar's equation of radiative transfer in n points."""
    h = _unknowns("h", n)
    return h, [
        f"{2 * n}*{h[i]} - 51234/100000*{h[i]}*(1"
        + "".join(f" + {i + 1}/{i + j + 2}*{h[j]}" for j in range(n - 1))
        + f") - {2 * n}"
        for i in range(n)
    ]


def lotka_volterra(n: int) -> Equations:
    """Equilibria of n species."""
    x = _unknowns("x", n)
    rates = _integers(n, n + 1, most=999)
    return x, [f"{v}*({_form(row, ['1', *x])})" for v, row in zip(x, rates, strict=True)]


def reimer(n: int) -> Equations:
    """Reimer's alternating sums of powers."""
    x = _unknowns("x", n)
    signs = ["-" if i % 2 else "+" for i in range(n)]
    return x, [
        "".join(f" {s} 2*{v}^{k}" for s, v in zip(signs, x, strict=True)) + " - 1"
        for k in range(2, n + 2)
    ]


def kss(n: int) -> Equations:
    """Kobayashi, Suzuki and Sakai: a zero of multiplicity 2^(n-1) at (1, ..., 1)."""
    x = _unknowns("x", n)
    return x, [f"{v}^2 - 2*{v} + {' + '.join(x)} - {n - 1}" for v in x]


def kuramoto(n: int) -> Equations:
    """Equilibria of n coupled oscillators, the last at rest."""
    c, s = [*_unknowns("c", n - 1), "1"], [*_unknowns("s", n - 1), "0"]
    weights = abs(_integers(n, n))
    weights = weights + weights.T
    balances = [
        " + ".join(f"{weights[i, j]}*({s[i]}*{c[j]} - {c[i]}*{s[j]})" for j in range(n) if j != i)
        + f" - {i + 3}"
        for i in range(n - 1)
    ]
    circles = [f"{c[i]}^2 + {s[i]}^2 - 1" for i in range(n - 1)]
    return c[:-1] + s[:-1], balances + circles


def game(players: int, strategies: int) -> Equations:
    """Totally mixed equilibria, the odds of each player's last strategy set to 1."""
    odds = [[f"p{i}{k}" for k in range(1, strategies)] for i in range(1, players + 1)]
    equations = []
    for i, own in enumerate(odds):
        others = [[*o, "1"] for j, o in enumerate(odds) if j != i]
        terms = ["*".join(choice) for choice in product(*others)]
        pays = _integers(len(own), len(terms), seed=i)
        equations += [_form(row, terms) for row in pays]
    return [p for own in odds for p in own], equations


def conics(tangent: int) -> Equations:
    """Conics that touch so many given ones and pass through points, five in all."""
    forms = _integers(5, 6, most=19)
    names, equations = _unknowns("a", 5), []
    for k, (a, b, c, d, e, f) in enumerate(forms[:tangent], 1):
        x, y = f"x{k}", f"y{k}"
        names += [x, y]
        slopes = [f"(2*a1*{x} + a2*{y} + a4)", f"(a2*{x} + 2*a3*{y} + a5)"]
        given = [f"(({2 * a})*{x} + ({b})*{y} + ({d}))", f"(({b})*{x} + ({2 * c})*{y} + ({e}))"]
        equations += [
            f"a1*{x}^2 + a2*{x}*{y} + a3*{y}^2 + a4*{x} + a5*{y} + 1",
            _form([a, b, c, d, e, f], [f"{x}^2", f"{x}*{y}", f"{y}^2", x, y, "1"]),
            f"{slopes[0]}*{given[1]} - {slopes[1]}*{given[0]}",
        ]
    for x, y in _integers(5, 2, most=19)[tangent:]:
        equations.append(f"a1*({x})^2 + a2*({x * y}) + a3*({y})^2 + a4*({x}) + a5*({y}) + 1")
    return names, equations


def tritangents() -> Equations:
    """Planes h that touch a curve of degree 6 on a quadric in three points."""
    exponents = [e for e in product(range(4), repeat=3) if sum(e) <= 3]
    coefficients = _integers(len(exponents))

    def cubic(point: Sequence[str], along: int | None = None) -> str:
        terms = []
        for c, e in zip(coefficients, exponents, strict=True):
            powers, factor = list(e), int(c)
            if along is not None:
                factor *= powers[along]
                powers[along] -= 1
            if factor:
                each = (f"{v}^{k}" for v, k in zip(point, powers, strict=True) if k)
                terms.append("*".join([f"({factor})", *each]))
        return " + ".join(terms)

    names, equations = _unknowns("h", 3), []
    for letter in "xyz":
        p = _unknowns(letter, 3)
        names += p
        slopes = [cubic(p, k) for k in range(3)]
        equations += [
            f"h1*{p[0]} + h2*{p[1]} + h3*{p[2]} - 1",
            f"{p[2]} - {p[0]}*{p[1]}",
            cubic(p),
            _determinant([["h1", "h2", "h3"], [f"-{p[1]}", f"-{p[0]}", "1"], slopes]),
        ]
    return names, equations


def concentrations(m: int, d: int) -> Equations:
    """Critical points of a likelihood: the inverse s of an m x m matrix in d parameters x."""
    x = _unknowns("x", d)
    pairs = list(combinations_with_replacement(range(m), 2))
    matrices = _integers(d, len(pairs), most=9)
    sample = _integers(len(pairs), most=9)
    entry = {ij: _form(matrices[:, k], x) for k, ij in enumerate(pairs)}
    s = {ij: f"s{ij[0] + 1}{ij[1] + 1}" for ij in pairs}

    def at(table: dict[tuple[int, int], str], i: int, j: int) -> str:
        return table[min(i, j), max(i, j)]

    inverse = [
        " + ".join(f"{at(s, i, k)}*({at(entry, k, j)})" for k in range(m)) + f" - {int(i == j)}"
        for i in range(m)
        for j in range(m)
    ]
    traces = [
        " + ".join(
            f"({int(row[k]) * (1 if i == j else 2)})*({s[i, j]} - ({sample[k]}))"
            for k, (i, j) in enumerate(pairs)
        )
        for row in matrices
    ]
    return [*x, *s.values()], inverse + traces


def phosphorylation(n: int) -> Equations:
    """Steady states of n sites that two enzymes e and f fill and free in turn, by mass action."""
    s = [f"s{i}" for i in range(n + 1)]
    a, b = _unknowns("a", n), _unknowns("b", n)
    rates = abs(_integers(n, 4, most=19))
    equations = []
    for i, (p, q, r, t) in enumerate(rates):
        equations += [
            f"{p}*e*{s[i]} - {q}*{a[i]}",
            f"{r}*f*{s[i + 1]} - {t}*{b[i]}",
            f"{p + r}*{a[i]} - {q + t}*{b[i]}",
        ]
    equations += [
        f"e + {' + '.join(a)} - 7",
        f"f + {' + '.join(b)} - 5",
        f"{' + '.join(s + a + b)} - 40",
    ]
    return [*s, "e", "f", *a, *b], equations


def five_point() -> Equations:
    """Essential matrices of two cameras that see five points."""
    spaces = _integers(3, 3, 4, most=9)
    e = [[_form(spaces[i, j], ["x", "y", "z", "1"]) for j in range(3)] for i in range(3)]

    def inner(u: Sequence[str], v: Sequence[str]) -> str:
        return " + ".join(f"({a})*({b})" for a, b in zip(u, v, strict=True))

    gram = [[inner(e[i], e[k]) for k in range(3)] for i in range(3)]
    trace = " + ".join(gram[i][i] for i in range(3))
    cubics = [
        " + ".join(f"2*({gram[i][k]})*({e[k][j]})" for k in range(3)) + f" - ({trace})*({e[i][j]})"
        for i in range(3)
        for j in range(3)
    ]
    return ["x", "y", "z"], [*cubics, _determinant(e)]


def alt_burmester(poses: int, points: int) -> Equations:
    """Four-bars that guide a body through poses, the first the unit, and one point of it on.

    Two bars hold the body, from (g, h) to (a, b) in it, the second from (u, v) to (p, q).
    """
    names = ["a", "b", "g", "h", "p", "q", "u", "v"]
    shifts = _integers(poses + points, 2, most=9)
    halves = [2, 3, -2, 4, -3]
    equations = []
    for k in range(1, poses + points):
        x, y = shifts[k]
        if k < poses:
            t = halves[k - 1]
            c, s = f"({1 - t * t}/{1 + t * t})", f"({2 * t}/{1 + t * t})"
        else:
            c, s = f"c{k}", f"s{k}"
            names += [c, s]
            equations.append(f"{c}^2 + {s}^2 - 1")
        for a, b, g, h in ("abgh", "pquv"):
            ends = [f"{c}*{a} - {s}*{b} + ({x}) - {g}", f"{s}*{a} + {c}*{b} + ({y}) - {h}"]
            equations.append(f"({ends[0]})^2 + ({ends[1]})^2 - ({a} - {g})^2 - ({b} - {h})^2")
    return names, equations


def burmester() -> Equations:
    """Bars that guide a body through five poses."""
    names, equations = alt_burmester(5, 0)
    return names[:4], equations[::2]


def lines(n: int) -> Equations:
    """Lines on a hypersurface of degree 2n - 3 in projective n-space."""
    degree = 2 * n - 3
    names = _unknowns("a", n - 1) + _unknowns("b", n - 1)
    monomials = list(combinations(range(degree + n), n))
    coefficients = _integers(len(monomials), most=9)
    # The coefficients of t^k of the form on the line of the points (1, t, a + t b).
    parts: list[list[str]] = [[] for _ in range(degree + 1)]
    for c, bars in zip(coefficients, monomials, strict=True):
        places = [-1, *bars, degree + n]
        powers = [q - p - 1 for p, q in pairwise(places)]
        for taken in product(*(range(k + 1) for k in powers[2:])):
            factor, factors = int(c), []
            for i, (k, j) in enumerate(zip(powers[2:], taken, strict=True), 1):
                factor *= comb(k, j)
                factors += [f"{v}{i}^{e}" for v, e in (("a", k - j), ("b", j)) if e]
            parts[powers[1] + sum(taken)].append("*".join([f"({factor})", *factors]))
    return names, [" + ".join(part) for part in parts]


def boon() -> Equations:
    """Boon's neurophysiology."""
    return ["s1", "g1", "s2", "g2", "c1", "c2"], [
        "s1^2 + g1^2 - 1",
        "s2^2 + g2^2 - 1",
        "c1*g1^3 + c2*g2^3 - 6/5",
        "c1*s1^3 + c2*s2^3 - 6/5",
        "c1*g1^2*s1 + c2*g2^2*s2 - 7/10",
        "c1*g1*s1^2 + c2*g2*s2^2 - 7/10",
    ]


def ku(n: int) -> Equations:
    """Bilinear equations around a ring (Steenkamp 1982 has ten such of Ku's)."""
    x = _unknowns("x", n)
    return x, [
        _form(row, [f"{x[i]}*{x[(i + 1) % n]}", x[i], x[(i + 1) % n], "1"])
        for i, row in enumerate(_integers(n, 4, most=9))
    ]


# --- All of them

FAMILIES = {
    "eisen": ClassicalFamily(eisen, {(n,): 3 * n for n in (10, 20, 30, 40, 50, 60)}),
    "katsura": ClassicalFamily(katsura, {(n,): 2**n for n in (6, 8, 10, 11)}),
    "cyclic": ClassicalFamily(cyclic, {(5,): 70, (6,): 156, (7,): 924, (8,): 1152, (10,): 34940}),
    "noon": ClassicalFamily(noon, {(n,): 3**n - 2 * n for n in (4, 5, 6, 7)}),
    "eco": ClassicalFamily(eco, {(n,): 2 ** (n - 2) for n in (6, 8, 10, 12)}),
    "redeco": ClassicalFamily(redeco, {(n,): 2 ** (n - 2) for n in (8, 10, 12)}),
    "chandra": ClassicalFamily(chandra, {(n,): 2 ** (n - 1) for n in (6, 8, 10, 11, 12)}),
    "lotka-volterra": ClassicalFamily(lotka_volterra, {(n,): 2**n for n in (5, 8, 10, 11, 12, 14)}),
    "reimer": ClassicalFamily(reimer, {(4,): 36, (5,): 144, (6,): 576}),
    "kss": ClassicalFamily(kss, {(4,): 6, (5,): 17, (6,): 23}),
    "kuramoto": ClassicalFamily(kuramoto, {(n,): comb(2 * n - 2, n - 1) for n in (4, 5, 6)}),
    # Derangements of n, and of blocks of more.
    "game": ClassicalFamily(
        game,
        {(4, 2): 9, (5, 2): 44, (6, 2): 265, (7, 2): 1854, (3, 3): 10, (3, 4): 56, (4, 3): 297},
    ),
    "conics": ClassicalFamily(conics, {(1,): 6, (2,): 36, (3,): 192, (4,): 816, (5,): 3264}),
    "tritangents": ClassicalFamily(tritangents, {(): 720}),
    "concentrations": ClassicalFamily(concentrations, {(4, 3): 9, (4, 4): 17}),
    "phosphorylation": ClassicalFamily(phosphorylation, {(n,): 2 * n + 1 for n in (1, 2, 3)}),
    "five-point": ClassicalFamily(five_point, {(): 10}),
    "burmester": ClassicalFamily(burmester, {(): 4}),
    "alt-burmester": ClassicalFamily(alt_burmester, {(4, 2): 60}),
    "lines": ClassicalFamily(lines, {(3,): 27, (4,): 2875}),
    "boon": ClassicalFamily(boon, {(): 8}),
    "ku": ClassicalFamily(ku, {(10,): 2}),
}
FILES = (
    "benchmarks/pw-1",
    "benchmarks/heart",
    "benchmarks/degree-60",
    "benchmarks/rps-10",
    "benchmarks/caprasse",
    "benchmarks/inverse-6r",
    "benchmarks/stewart-gough",
    "hard/cassou",
    "hard/chemequ",
    "hard/stewgou40",
    "hard/inverse-position",
)


def _system_of(case: Case) -> PolynomialSystem:
    return case.system if case.mechanism is None else model(case.mechanism).system


def classic_names() -> list[str]:
    """The names of all, those of families with their parameters."""
    own = [" ".join([f, *map(str, each)]) for f, made in FAMILIES.items() for each in made.counts]
    return own + [file.partition("/")[2] for file in FILES]


def make_classic(name: str) -> Classic:
    """A family's member, as ``"katsura 10"``, or what a case file has, by its name.

    Raises:
        KeyError: if there is no such family.
        StopIteration: if there is no such file.
    """
    family, *numbers = name.split()
    if family in FAMILIES:
        made, each = FAMILIES[family], tuple(map(int, numbers))
        variables, equations = made.make(*each)
        polynomials = tuple(parse_polynomial(e, variables) for e in equations)
        return Classic(name, PolynomialSystem(tuple(variables), polynomials), made.counts.get(each))
    file = next(file for file in FILES if file.endswith("/" + name))
    case = read_case(CASES / f"{file}.toml")
    known = [t.count for t in case.truth if t.dimension == 0]
    return Classic(name, _system_of(case), sum(known) if known else None)
