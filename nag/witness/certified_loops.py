"""Monodromy that is proved: loops of slices along which no path can have jumped.

Points that such loops carry into each other lie on one irreducible component: the smooth part of
one is connected, and the paths are proved to stay on it. They follow equations that are found anew
from the system, not such as a component is said to be cut by; and points are on a component of the
system only where they are proved to be zeros of it.

References:
    Guillemot & Lairez, Validated numerics for algebraic path tracking, 2024, section 1; Sommese &
    Wampler, The numerical solution of systems of polynomials, 2005, section 15.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from nag.algebra.system import PolynomialSystem
from nag.numerics.certified_points import Proof
from nag.numerics.coincidence import NEAR, join_labels
from nag.numerics.discs import Terms
from nag.numerics.read_only import equal_values
from nag.tracking import blocks
from nag.tracking.certified_paths import ProvedZeros, certified_paths, prove_zeros_near
from nag.tracking.moving_discs import MovingPart, MovingSystem
from nag.tracking.run import Stream
from nag.witness.certificate import certify_witness_points
from nag.witness.component_equations import component_fibres
from nag.witness.fibres import Fibre
from nag.witness.slices import pad_rows, random_rows, unit_complex
from nag.witness.witness import Decomposition, WitnessSet

# Loops that are tried until all points are connected.
MOST_LOOPS = 12


@dataclass(frozen=True, eq=False)
class ProvedMonodromy:
    """Loops of a component's witness points.

    Attributes:
        permutations: for each loop where each point's path leads, -1 where that is not proved.
        orbits: for each point the smallest index of those that it is connected with.
        steps: number of tubes.
        zeros: whether all points are proved, or by evidence, to be zeros of all equations.
    """

    permutations: tuple[np.ndarray, ...]
    orbits: np.ndarray
    steps: int
    zeros: bool

    __eq__ = equal_values

    def document(self) -> dict[str, Any]:
        """What is proved, as a JSON object."""
        return {
            "connected": self.connected,
            "permutations": [
                [int(k) if k >= 0 else None for k in places] for places in self.permutations
            ],
            "tubes": self.steps,
        }

    @property
    def connected(self) -> bool:
        """Whether all points are proved to lie on one component."""
        return self.zeros and len(self.orbits) > 0 and not self.orbits.any()


@np.errstate(over="ignore", invalid="ignore")
def prove_monodromy(
    system: PolynomialSystem,
    component: WitnessSet,
    rng: np.random.Generator,
    most: int = MOST_LOOPS,
) -> ProvedMonodromy:
    """At most so many random loops, until the points are proved to lie on one component.

    Raises:
        ValueError: if the points are not regular zeros of the system or of a deflation of it.
        OverflowError: if a coefficient is too large or too small for a double.
    """
    orbits = np.arange(component.degree)
    permutations, joined, steps = [], [], 0
    component = replace(component, fibres=())
    fibres = component_fibres(system, component) if component.degree > 1 else []
    zeros = Proof.NONE not in certify_witness_points(system, component).proofs
    for _ in range(most if component.dimension else 0):
        if not orbits.any():
            break
        middle = random_rows(rng, component.dimension, system.n)
        turns = tuple(complex(g) for g in unit_complex(rng, 2))
        places, spent = _loop(fibres, component.slice.rows, middle, turns)
        steps += spent
        permutations.append(places)
        arrived = np.flatnonzero(places >= 0)
        joined.append(np.column_stack([arrived, places[arrived]]))
        orbits = join_labels(component.degree, joined)
    return ProvedMonodromy(tuple(permutations), orbits, steps, zeros)


@np.errstate(over="ignore", invalid="ignore")
def prove_all(decomposition: Decomposition, seed: int = 0) -> tuple[ProvedMonodromy, ...]:
    """Loops of all components, in their order; those whose points find no equations have none."""
    found = []
    for k, component in enumerate(decomposition.components):
        blocks.tell("proving loops of components", k, len(decomposition.components))
        try:
            rng = np.random.default_rng([seed, Stream.CERTIFIED_LOOPS, k])
            found.append(prove_monodromy(decomposition.system, component, rng))
        except (ValueError, OverflowError):
            found.append(ProvedMonodromy((), np.arange(component.degree), 0, False))
    return tuple(found)


def _loop(
    fibres: list[Fibre], rows: np.ndarray, middle: np.ndarray, turns: tuple[complex, complex]
) -> tuple[np.ndarray, int]:
    """Where a loop leads the points of fibres on the slice ``rows``, and the number of tubes."""
    places, steps, first = [], 0, 0
    for fibre in fibres:
        out = moving_slice(fibre, rows, middle, turns[0])
        back = moving_slice(fibre, middle, rows, turns[1])
        starts = prove_zeros_near(out, fibre.points.astype(complex), 1.0, NEAR)
        there = certified_paths(out, starts)
        half = _keep_arrived(there.ends, there.reached)
        again = certified_paths(back, half)
        ends = _keep_arrived(again.ends, again.reached)
        # Points of another fibre may be zeros of this one's equations as well.
        known, begin = starts, first
        if not fibre.cut.aux:
            every = np.vstack([f.x for f in fibres]).astype(complex)
            known, begin = prove_zeros_near(out, every, 1.0, NEAR), 0
        for i in range(len(fibre)):
            same = np.flatnonzero(ends.select_rows(np.array([i])).same(known))
            places.append(begin + int(same[0]) if len(same) == 1 else -1)
        steps += there.steps + again.steps
        first += len(fibre)
    return np.array(places, dtype=int), steps


def _keep_arrived(ends: ProvedZeros, reached: np.ndarray) -> ProvedZeros:
    """The ends of the paths that got to t = 0."""
    outer = np.where(reached[:, None] == 0, ends.outer, -1.0)
    return ProvedZeros(ends.centres, ends.inner, outer)


def moving_slice(
    fibre: Fibre, source: np.ndarray, target: np.ndarray, turn: complex
) -> MovingSystem:
    """The equations of a fibre with the slice ``t turn source + (1 - t) target``.

    Raises:
        OverflowError: if a coefficient is too large or too small for a double.
    """
    columns = 1 + fibre.cut.n + fibre.cut.aux
    blank = np.zeros((len(source), columns), dtype=complex)
    nothing: list[Terms] = [{}] * len(fibre.cut.polynomials)
    return MovingSystem(
        (
            MovingPart.of(1.0, 0.0, [f.terms for f in fibre.cut.polynomials], blank),
            MovingPart.of(0.0, turn, nothing, pad_rows(source, columns)),
            MovingPart.of(1.0, -1.0, nothing, pad_rows(target, columns)),
        )
    )


def loops_rows(proved: Sequence[ProvedMonodromy], seconds: float) -> list[tuple[str, str]]:
    """What is proved of the loops of components, as labelled lines."""
    connected = sum(m.connected for m in proved)
    loops = sum(len(m.permutations) for m in proved)
    text = (
        f"the witness points of {connected} of {len(proved)} components are proved to lie on one "
        "irreducible component each"
    )
    rows = [("loops", text)]
    for k, m in enumerate(proved):
        if not m.connected:
            sets = len(set(m.orbits.tolist()))
            text = f"component {k + 1}: its {len(m.orbits)} points are in {sets} sets still"
            if not m.zeros:
                text = f"component {k + 1}: not all of its points are proved to be zeros"
            rows.append(("doubt", text))
    rows.append(("", f"{loops} loops, {sum(m.steps for m in proved)} tubes, {seconds:.2f} s"))
    return rows
