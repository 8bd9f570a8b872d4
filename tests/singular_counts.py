"""The zero set of a small system by standard bases modulo a prime, in a process of Singular's.

Isolated zeros are counted by the characteristic polynomial of the multiplication by a random
linear form in the quotient ring: each is a root, as often as its multiplicity says. Where there
are curves or surfaces, these are found as minimal primes, and the ideal is saturated by them first.
"""

from __future__ import annotations

import ctypes
import os
import random
import select
import shutil
import signal
import subprocess
import time
from collections import Counter
from collections.abc import Sequence
from functools import cache

import flint
from exact_counts import modular

from nag.algebra.polynomial import Polynomial
from nag.bench.verdicts import ZeroSet

# Singular factors modulo primes below 2^29. Next to powers of two and ten a prime divides too many
# discriminants: 2^29 - 3 makes a double root of 64 x^4 - x^3 + 72.
PRIME = 314159257
# Seconds by the clock for a system.
LIMIT = 20.0
END = "ready"
PR_SET_PDEATHSIG = 1

PROCEDURES = """
LIB "primdec.lib"; LIB "elim.lib";
option(redSB); option(noredefine);
proc tables(ideal G, poly l) {
  if (dim(G) > 0) { ERROR("not finite"); }
  print("size " + string(vdim(G)));
  if (vdim(G) > 0) {
    ideal kb = kbase(G); int i;
    for (i = 1; i <= size(kb); i++) { print("row " + string(coeffs(reduce(l*kb[i], G), kb))); }
  }
}
proc off(ideal I, list primes, int k) {
  ideal J = 1; int i;
  for (i = 1; i <= size(primes); i++) {
    if (i != k && dim(std(primes[i])) > 0) { J = intersect(J, primes[i]); }
  }
  return(std(sat(I, J)[1]));
}
proc describe(ideal I, poly l) {
  ideal G = std(I);
  if (dim(G) <= 0) { tables(G, l); return(); }
  list primes = minAssGTZ(I); int i; ideal P;
  for (i = 1; i <= size(primes); i++) {
    P = std(primes[i]);
    if (dim(P) > 0) {
      print("part " + string(dim(P)) + " " + string(mult(P)));
      print("whole " + string(mult(off(I, primes, i))));
    }
  }
  tables(off(I, primes, 0), l);
}
"""


class SingularError(Exception):
    """Singular did not answer in time, or not as was hoped for."""


class Singular:
    """A process that is fed with many systems."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            ["Singular", "-q", "-t", "--no-rc"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            preexec_fn=_end_with_parent,
        )
        self.ask(PROCEDURES, LIMIT)

    def ask(self, commands: str, limit: float) -> list[str]:
        """The lines that ``commands`` print.

        Raises:
            SingularError: if that takes more than ``limit`` seconds, or is an error. The process
                has ended then.
        """
        deadline, pieces = time.monotonic() + limit, b""
        end = f'\nprint("{END}");\n'
        self.process.stdin.write((commands + end).encode())
        self.process.stdin.flush()
        while not pieces.endswith(f"{END}\n".encode()):
            left = deadline - time.monotonic()
            ready, _, _ = select.select([self.process.stdout], [], [], max(0.0, left))
            piece = os.read(self.process.stdout.fileno(), 1 << 16) if ready else b""
            pieces += piece
            if not piece or b"   ? " in pieces:
                self.process.kill()
                self.process.wait()
                raise SingularError(pieces.decode() if piece else f"no answer in {limit:g} s")
        return pieces.decode().splitlines()[:-1]


def _end_with_parent() -> None:
    """Singular runs on for ever when its input ends after an error; so the kernel ends it."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


@cache
def _started(generation: int) -> Singular:
    return Singular()


_generation = 0


def standard_zero_set(n: int, equations: Sequence[Polynomial]) -> ZeroSet | None:
    """The zero set of ``equations`` in ``n`` unknowns; None if Singular is not there or too slow.

    Only sums of degrees are known of components of positive dimension: what is irreducible modulo
    a prime need not be so over the complex numbers, or the other way round.
    """
    global _generation
    if shutil.which("Singular") is None:
        return None
    names = [f"x({k})" for k in range(n)]
    rng = random.Random(n)
    form = " + ".join(f"{rng.randrange(1, PRIME)}*{name}" for name in names)
    texts = [
        " + ".join(
            "*".join([str(modular(c, PRIME)), *(f"{x}^{k}" for x, k in zip(names, e, strict=True))])
            for e, c in f.terms.items()
        )
        for f in equations
    ]
    commands = (
        f"ring r = {PRIME}, (x(0..{n - 1})), dp; short = 0;\n"
        f"ideal I = {', '.join(texts)};\ndescribe(I, {form});"
    )
    try:
        return _read(_started(_generation).ask(commands, LIMIT))
    except SingularError:
        _generation += 1
        return None


def _read(lines: Sequence[str]) -> ZeroSet:
    degrees: Counter[tuple[int, int]] = Counter()
    rows, size, dimension, degree = [], 0, 0, 1
    for line in lines:
        kind, _, rest = line.partition(" ")
        if kind == "part":
            dimension, degree = map(int, rest.split())
        elif kind == "whole":
            degrees[dimension, int(rest) // degree] += degree
        elif kind == "size":
            size = max(0, int(rest))
        elif kind == "row":
            rows.append([int(v) % PRIME for v in rest.split(",")])
    points: Counter[int] = Counter()
    if size:
        polynomial = flint.nmod_mat(rows, PRIME).charpoly()
        points = Counter({k: g.degree() for g, k in polynomial.factor_squarefree()[1]})
    return ZeroSet(points, degrees, None if degrees else Counter(_isolated(points)))


def _isolated(points: Counter[int]) -> dict[tuple[int, int, int], int]:
    return {(0, 1, k): count for k, count in points.items()}
