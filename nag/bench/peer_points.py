"""Solutions of other programs, point by point, and the processor time that they take."""

from __future__ import annotations

import importlib.util
import re
import resource
from dataclasses import dataclass, replace

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.bench.peers import in_bertini, in_macaulay2, in_phcpack, installed_programs, plain_texts


@dataclass(frozen=True, eq=False)
class PeerPoints:
    """What a program found.

    Attributes:
        program: its name.
        seconds: processor time, as the program itself says it, or of its whole process.
        points: complex, shape ``(k, n)``; None without an answer.
        remark: why there is none.
    """

    program: str
    seconds: float
    points: np.ndarray | None
    remark: str = ""


# M2 with its solutions sharpened: by itself it stops at errors of 1e-12 or so.
REFINED = "M2, refined"
SCALED = "equations divided by their largest coefficients"


def forms(system: PolynomialSystem) -> dict[str, PolynomialSystem]:
    """The equations as they are, and each divided by its largest coefficient, by what they are.

    Programs that do not scale equations themselves do better with one or the other.
    """
    if not system.exact:
        return {"": system}
    divided = [f / max(abs(c) for c in f.terms.values()) if f else f for f in system.polynomials]
    scaled = replace(system, polynomials=tuple(divided))
    return {"": system} | ({SCALED: scaled} if scaled != system else {})


def programs() -> list[str]:
    """The programs that are there: M2, also refined, phc, and bertini2, a Python package."""
    found = installed_programs()
    refined = [REFINED] if "M2" in found else []
    return [*found, *refined, *(["bertini2"] if importlib.util.find_spec("bertini") else [])]


def peer_points(program: str, system: PolynomialSystem, limit: float) -> PeerPoints:
    """Solve ``system`` with a program, for at most ``limit`` seconds."""
    runs = {"M2": _macaulay2, REFINED: _refined, "phc": _phcpack, "bertini2": _bertini}
    run = runs[program]
    before = children_seconds()
    output = run(system, limit)
    seconds = children_seconds() - before
    if output is None:
        return PeerPoints(program, seconds, None, f"no answer in {limit:.0f} s")
    said, numbers = output
    points = np.array(numbers, dtype=complex).reshape(-1, system.n)
    return PeerPoints(program, seconds if said is None else said, points)


TimedPoints = tuple[float | None, list[complex]] | None


def children_seconds() -> float:
    """Processor time of all processes that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def pairs(lines: str) -> list[complex]:
    """Complex numbers, one in each line ``value re im``."""
    found = re.findall(r"^value (\S+) (\S+)$", lines, re.MULTILINE)
    return [complex(float(re), float(im)) for re, im in found]


def said(output: str) -> float | None:
    """The number in a line ``seconds number``."""
    found = re.search(r"^seconds (\S+)$", output, re.MULTILINE)
    return float(found[1]) if found else None


def told_by_macaulay2(system: PolynomialSystem, work: str, listed: str, limit: float) -> str | None:
    """What Macaulay2 prints of its work: ``seconds``, and what ``listed`` tells; None if too long.

    Args:
        work: makes ``S`` of the equations ``F``.
        listed: lists ``S``; its ``tell`` prints a number.
    """
    rest = (
        "t = cpuTime();\n"
        f"{work}"
        'print("seconds " | toString(cpuTime() - t));\n'
        "full = x -> toExternalString(1.0 * x);\n"
        'tell = z -> print("value " | full realPart z | " " | full imaginaryPart z);\n'
        f"{listed}"
    )
    _, output = in_macaulay2(system, rest, limit)
    # Doubles are written with their precision in bits: .5p53e1.
    return None if output is None else output.replace("p53", "")


def _refined(system: PolynomialSystem, limit: float) -> TimedPoints:
    return _macaulay2(system, limit, "S = refine(F, S, ErrorTolerance => 1e-14);\n")


def _macaulay2(system: PolynomialSystem, limit: float, further: str = "") -> TimedPoints:
    listed = "for s in S do for z in coordinates s do tell z;\n"
    output = told_by_macaulay2(system, f"S = solveSystem F;\n{further}", listed, limit)
    return None if output is None else (said(output), pairs(output))


def _phcpack(system: PolynomialSystem, limit: float) -> TimedPoints:
    names, _ = plain_texts(system)
    _, written = in_phcpack(system, ("-b", "-0"), limit)
    if written is None:
        return None
    numbers = []
    for values in solutions(written[0].partition("THE SOLUTIONS")[2]):
        if all(name in values for name in names):
            numbers += [values[name] for name in names]
    return None, numbers


def solutions(text: str) -> list[dict[str, complex]]:
    """Names and values of the unknowns, in each solution that ``phc`` writes."""
    blocks = re.split(r"^solution \d+ :", text, flags=re.MULTILINE)[1:]
    return [dict(_coordinates(block.partition("== err")[0])) for block in blocks]


def _coordinates(block: str) -> list[tuple[str, complex]]:
    """Names and values of the unknowns, as ``phc`` writes a solution."""
    found = re.findall(r"^ (\w+) : +(\S+) +(\S+)$", block, re.MULTILINE)
    return [(name, complex(float(re), float(im))) for name, re, im in found]


def _bertini(system: PolynomialSystem, limit: float) -> TimedPoints:
    work = (
        "begin = time.process_time()\n"
        "found = bertini.solve(system, show_progress=False, directory='records', seed=1)\n"
        "print('seconds', time.process_time() - begin)\n"
        "for point in found:\n"
        "    for z in point:\n"
        "        z = complex(z)\n"
        "        print('value', repr(z.real), repr(z.imag))\n"
    )
    output = in_bertini(system, work, limit)
    return None if output is None else (said(output), pairs(output))
