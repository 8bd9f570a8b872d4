"""Eliminate from components over quadratic and cubic fields and compare with exact norms.

    python tests/eliminated_fields.py [--seeds 0:12] [--show]

A curve y = f(x, t), z = g(x, y), or f(x, y, t) = 0, over the field of a root t of a polynomial m is
a component of the system that its norm to the rational numbers makes; so are its conjugates. What
is said of each is compared with the exact truth: equations with the norm's irreducible factor over
the rational numbers, and whether the image is defined there, is its own conjugate, or one of more.
Exit status 1 if anything is wrong.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from collections import Counter
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import sympy

from nag.cli import main

X, Y, Z, T = sympy.symbols("x y z t")
# Quadratic fields, real and imaginary, and cubic ones with one and with three real roots.
FIELDS = (
    T**2 + 5, T**2 - 2, T**2 + 1, T**2 - T - 1, T**2 + T + 1, T**2 - 7,
    T**3 - 2, T**3 - 3 * T + 1, T**3 + T + 1, T**3 - T**2 - 2 * T + 1,
)  # fmt: skip


@dataclass(frozen=True)
class Problem:
    """A system, the variables to eliminate to, and what is true of the images of its components.

    Attributes:
        image: the image's equation with the field's generator in it.
        minimal: the polynomial of which that is a root.
    """

    variables: str
    equations: tuple[str, ...]
    onto: str
    image: sympy.Expr
    minimal: sympy.Expr

    @property
    def factors(self) -> list[sympy.Poly]:
        """The irreducible factors over the rational numbers of the norm of the image's equation."""
        names = sympy.symbols(self.onto.split(","))
        norm = sympy.resultant(self.minimal, self.image, T)
        return [sympy.Poly(f, *names) for f, _ in sympy.factor_list(norm, *names)[1]]

    @property
    def conjugates(self) -> list[tuple[bool, bool, bool]]:
        """For each root whether the image is rational, its own conjugate, one of a pair of two."""
        # The image's equation is monic in the last variable, so that its coefficients tell it.
        names = sympy.symbols(self.onto.split(","))
        coefficients = sympy.Poly(self.image, *names).coeffs()
        found = []
        for root in sympy.Poly(self.minimal, T).nroots(n=50):
            values = [complex(sympy.N(c.subs(T, root), 40)) for c in coefficients]
            self_conjugate = all(abs(v.imag) < 1e-20 for v in values)
            rational = all(
                sympy.Poly(sympy.rem(c, self.minimal, T), T).degree() <= 0 for c in coefficients
            )
            (factor,) = self.factors
            pair = factor.total_degree() == 2 * sympy.Poly(self.image, *names).total_degree()
            found.append((rational, self_conjugate, pair))
        return found


def drawn(rng: np.random.Generator) -> Problem:
    """A problem with random small coefficients."""
    minimal = FIELDS[int(rng.integers(len(FIELDS)))]
    a, b, c = (int(k) for k in rng.choice([-3, -2, -1, 1, 2, 3], 3))
    powers = [T, T**2 if minimal.subs(T, 0) != 0 else T]
    kind = int(rng.integers(4))
    if kind == 3:
        f = Y**2 + a * X * Y + (b * T + c) * X ** int(rng.integers(2, 4)) + int(rng.integers(1, 4))
        norm = sympy.expand(sympy.resultant(minimal, f, T))
        return Problem("x y", (str(norm),), "x,y", f, minimal)
    f = powers[0] * X ** int(rng.integers(1, 3)) * a + b
    norm = sympy.expand(sympy.resultant(minimal, Y - f, T))
    square = bool(rng.integers(2))
    g = (Y - b) ** 2 + c * X if square else X * Y + c
    equations = (str(norm), str(sympy.expand(Z - g)))
    if kind == 0:
        return Problem("x y z", equations, "x,y", Y - f, minimal)
    image = sympy.expand(Z - g.subs(Y, f))
    return Problem("x y z", equations, "x,z", image, minimal)


def eliminated(problem: Problem, number: int) -> tuple[int, dict[str, Any] | None]:
    """Exit status and export of ``nag eliminate`` for a component."""
    with tempfile.TemporaryDirectory() as folder:
        case, target = Path(folder) / "case.toml", Path(folder) / "found.json"
        names = json.dumps(problem.variables.split())
        texts = json.dumps([e.replace("**", "^") for e in problem.equations])
        case.write_text(f'title = "t"\nkind = "system"\nvariables = {names}\nequations = {texts}\n')
        argv = ["eliminate", str(case), "--quiet", "--onto", problem.onto, "--json", str(target)]
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            status = main([*argv, "--component", str(number)])
        return status, json.loads(target.read_text()) if target.exists() else None


def expected(problem: Problem) -> Counter[tuple[Any, ...]]:
    """What is true of all components: defined by the equations, its own conjugate, alone."""
    return Counter(
        (True, True, True) if rational else
        (False, False, True) if pair and not real else
        (False, None, False)
        for rational, real, pair in problem.conjugates
    )  # fmt: skip


def said(content: dict[str, Any]) -> tuple[Any, ...]:
    return content["defines"], content["self_conjugate"], not content["together"]


def compare(problem: Problem) -> list[str]:
    """What is wrong or missing in the answers for all components, each in a line."""
    wanted, complaints = expected(problem), []
    (factor,) = problem.factors
    names = sympy.symbols(problem.onto.split(","))
    answers = []
    for number in range(1, sum(wanted.values()) + 1):
        status, content = eliminated(problem, number)
        if status or content is None:
            complaints.append(f"open: component {number}: exit status {status}")
            continue
        answers.append(said(content))
        texts = [e["polynomial"].replace("^", "**") for e in content["equations"]]
        found = [sympy.Poly(sympy.sympify(text), *names) for text in texts]
        same = len(found) == 1 and found[0].monic() == factor.monic()
        if not same:
            complaints.append(f"wrong: component {number}: {texts} for {factor.as_expr()}")
        if not content["defines_union"]:
            complaints.append(f"open: component {number}: not seen to be all zeros")
    for kind, count in (Counter(answers) - wanted).items():
        complaints.append(f"wrong: {count} components said to be {kind}, true is {dict(wanted)}")
    return complaints


def main_campaign() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:12")
    parser.add_argument("--show", action="store_true")
    given = parser.parse_args()
    begin, counts = time.process_time(), Counter[str]()
    for seed in range(*map(int, given.seeds.split(":"))):
        problem = drawn(np.random.default_rng([seed, 32]))
        complaints = compare(problem)
        counts["components"] += sum(expected(problem).values())
        counts.update(text.partition(":")[0] for text in complaints)
        if given.show or complaints:
            print(seed, problem.equations, problem.onto, dict(expected(problem)), flush=True)
        for text in complaints:
            print(f"    {text}", flush=True)
    print(dict(counts), f"{time.process_time() - begin:.0f} s")
    return int(counts["wrong"] > 0)


if __name__ == "__main__":
    sys.exit(main_campaign())
