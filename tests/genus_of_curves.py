"""Compare genera of plane curves with cusps and tacnodes, in unequal scales, with Singular's.

    python tests/genus_of_curves.py [--seeds 0:60] [--show]

Curves are drawn from families with Puiseux branches of several orders, and put in other
coordinates: translated, sheared, and each variable in units of a power of ten up to 10^9.
Singular's `genus` (normal.lib) is asked for the curve as it was drawn, which has the same genus, if
it is absolutely irreducible. Exit status 1 if a genus is wrong.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import time
from collections import Counter

import numpy as np
import sympy

import nag
from nag.decomposition import genus
from nag.decomposition.curve_genus import GenusError

X, Y, T = sympy.symbols("x y t")
PATIENCE = 60


def drawn(rng: np.random.Generator) -> sympy.Expr:
    """The equation of a curve."""

    def whole(least: int, most: int) -> int:
        return int(rng.integers(least, most + 1))

    def nonzero() -> int:
        return int(rng.choice([-3, -2, -1, 1, 2, 3]))

    match whole(0, 7):
        case 0:  # Cusps and tacnodes of any order on a parabola.
            return (Y - nonzero() * X ** whole(1, 2)) ** 2 - nonzero() * X ** whole(4, 8)
        case 1:  # One branch with one characteristic exponent.
            return Y ** whole(2, 4) - nonzero() * X ** whole(4, 9)
        case 2:  # Superelliptic curves with points of several orders.
            right = nonzero() * X ** whole(1, 4) * (X - nonzero()) ** whole(1, 3)
            return Y ** whole(2, 4) - right * (X + whole(4, 6)) ** whole(0, 2)
        case 3:  # Two characteristic exponents.
            return (Y**2 - X**3) ** 2 - 4 * X**5 * Y - X**7 + nonzero() * X ** whole(8, 9)
        case 4:  # Polynomial images of the line.
            f = T ** whole(2, 3) + nonzero() * T ** whole(4, 5)
            g = T ** whole(3, 4) + nonzero() * T
            return sympy.resultant(X - f, Y - g, T)
        case 5:  # Several branches at the origin that touch.
            branches = [Y - nonzero() * X**2, Y**2 - nonzero() * X ** whole(3, 5)]
            return branches[0] * branches[1] + nonzero() * X ** whole(6, 7)
        case 6:  # Quartics with nodes and cusps at three points.
            return X**2 * Y**2 + nonzero() * X**2 + nonzero() * Y**2 + nonzero() * X * Y
        case _:  # Hyperelliptic curves with double points.
            roots = (X - nonzero()) ** whole(1, 3) * (X**2 + nonzero()) * (X + 4) ** whole(1, 2)
            return Y**2 - roots


def in_other_coordinates(f: sympy.Expr, rng: np.random.Generator) -> sympy.Expr:
    """The curve translated, sheared, and in units of powers of ten."""
    a, b, c = (sympy.Rational(int(k), 2) for k in rng.integers(-3, 4, 3))
    k, m = (int(e) for e in rng.integers(-9, 10, 2)) if rng.integers(2) else (0, 0)
    x, y = X * sympy.Integer(10) ** k, Y * sympy.Integer(10) ** m
    return sympy.expand(f.subs({X: x + a, Y: y + b + c * x}, simultaneous=True))


def of_singular(f: sympy.Expr) -> int | None:
    """The genus by Singular; None if it is not absolutely irreducible, or takes too long."""
    text = str(sympy.expand(f)).replace("**", "^")
    program = (
        'LIB "normal.lib"; LIB "absfact.lib"; ring r=0,(x,y),dp; '
        f"poly f={text}; def s=absFactorize(f,77864); setring s; int n=absolute_factors[4]; "
        f'setring r; print("factors "+string(n)); ideal j={text}; print("genus "+string(genus(j)));'
    )
    try:
        found = subprocess.run(
            ["Singular", "-q", "-c", program + "quit;"],
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            stdin=subprocess.DEVNULL,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None
    words = [line.split() for line in found.stdout.splitlines()]
    numbers = {w[0]: int(w[1]) for w in words if len(w) == 2 and w[0] in ("factors", "genus")}
    return numbers.get("genus") if numbers.get("factors") == 1 else None


def answered(f: sympy.Expr, seed: int) -> int | str:
    """The genus, or why there is none."""
    system = nag.system([str(f).replace("**", "^")], "x y")
    curves = nag.decompose(system, seed=seed).components
    if len(curves) != 1:
        return f"{len(curves)} components"
    try:
        return genus(system, curves[0], seed=seed).genus
    except (GenusError, ValueError) as error:
        return str(error)


def main_campaign() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:60")
    parser.add_argument("--show", action="store_true")
    given = parser.parse_args()
    if shutil.which("Singular") is None:
        raise SystemExit("Singular is not installed")
    begin, counts = time.process_time(), Counter[str]()
    for seed in range(*map(int, given.seeds.split(":"))):
        rng = np.random.default_rng([seed, 47])
        f = drawn(rng)
        other = in_other_coordinates(f, rng)
        truth = of_singular(f)
        if truth is None:
            counts["no truth"] += 1
            continue
        found = answered(other, seed)
        word = "right" if found == truth else "open" if isinstance(found, str) else "wrong"
        counts[word] += 1
        if given.show or word != "right":
            print(f"{seed}: {word}: {found}, {truth} is true: {f}: {other}", flush=True)
    print(dict(counts), f"{time.process_time() - begin:.0f} s")
    return int(counts["wrong"] > 0)


if __name__ == "__main__":
    sys.exit(main_campaign())
