"""What each formulation of a mechanism costs: size, Bezout's number, paths, time."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from math import prod
from typing import Any

from nag.algebra.system import PolynomialSystem
from nag.decomposition.decompose import decompose
from nag.mechanism.assembly import AssemblyModel
from nag.mechanism.dh import DHLoop
from nag.mechanism.dh_euler import table_alternatives, table_model
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import model
from nag.mechanism.parts_coordinates import coordinates_of_parts
from nag.mechanism.path_estimates import fewest_estimated_paths
from nag.mechanism.problem import problem_of
from nag.witness.witness import Decomposition

Parts = Mechanism | DHLoop | AssemblyModel

# Systems whose estimated number of paths is larger are not tracked.
MOST_PATHS = 200_000


@dataclass(frozen=True)
class Formulated:
    """One formulation of one mechanism, decomposed.

    Attributes:
        case: name of the case file.
        formulation: its name, or "unreduced"; of parts that are not assembled, the coordinates.
        taken: whether it is the one that is chosen.
        variables, equations: of its system.
        bezout: product of the degrees of as many equations as there are variables, the lowest.
        estimate: estimated number of paths.
        paths: tracked; None if it was not tracked, or not in time.
        seconds: of processor time, warm, model and decomposition; None as above.
        components: dimension, degree and count of each kind, in the formulation's coordinates.
        complete: whether the answer is.
    """

    case: str
    formulation: str
    taken: bool
    variables: int
    equations: int
    bezout: int
    estimate: int
    paths: int | None = None
    seconds: float | None = None
    components: tuple[tuple[int, int, int], ...] = ()
    complete: bool = False

    def document(self) -> dict[str, Any]:
        """As a JSON object."""
        return asdict(self)


def measure_models(
    name: str, mechanism: Mechanism, patience: float, formulations: Sequence[str] | None = None
) -> list[Formulated]:
    """Every formulation of a mechanism, the unreduced one first, each given ``patience`` seconds.

    Raises:
        nag.mechanism.model.ModelError: if the mechanism has no loop.
    """
    chosen = model(mechanism)
    rows = [_measured(name, "unreduced", False, chosen.unreduced, mechanism, patience)]
    for each in chosen.alternatives:
        if each.form is None or (formulations and each.formulation not in formulations):
            continue
        taken = each.formulation == chosen.formulation
        rows.append(_measured(name, each.formulation, taken, each.system, mechanism, patience))
    return rows


def measure_table(name: str, loop: DHLoop, patience: float) -> list[Formulated]:
    """A table by Denavit and Hartenberg in every formulation, each given ``patience`` seconds."""
    return [
        _measured(name, each.formulation, each.formulation == "H", each.system, loop, patience)
        for each in table_alternatives(loop)
    ]


def measure_parts(name: str, parts: AssemblyModel, patience: float) -> list[Formulated]:
    """A linkage or a framework in all its coordinates, each given ``patience`` seconds."""
    return [
        _measured(name, each.formulation, each.taken, each.system, parts, patience)
        for each in coordinates_of_parts(parts)
    ]


def _measured(
    name: str,
    formulation: str,
    taken: bool,
    system: PolynomialSystem,
    mechanism: Parts,
    patience: float,
) -> Formulated:
    degrees = sorted(f.degree for f in system.polynomials)[: system.n]
    row = Formulated(
        name,
        formulation,
        taken,
        system.n,
        len(system.polynomials),
        prod(degrees),
        fewest_estimated_paths(system),
    )
    if row.estimate > MOST_PATHS:
        return row
    answer = _in_time(mechanism, formulation, patience)
    if answer is None:
        return row
    seconds, paths, components, complete = answer
    return replace(row, paths=paths, seconds=seconds, components=components, complete=complete)


def _in_time(mechanism: Parts, formulation: str, patience: float) -> Any:
    """What `_decomposed` gives, in a process of its own, which is ended when time is over."""
    context = multiprocessing.get_context("spawn")
    receiving, sending = context.Pipe(False)
    process = context.Process(target=_send, args=(sending, mechanism, formulation))
    process.start()
    sending.close()
    try:
        return receiving.recv() if receiving.poll(patience) else None
    except EOFError:
        return None
    finally:
        process.terminate()
        process.join()


def _send(sending: Any, mechanism: Parts, formulation: str) -> None:
    sending.send(_decomposed(mechanism, formulation))


def _decomposed(
    mechanism: Parts, formulation: str
) -> tuple[float, int, tuple[tuple[int, int, int], ...], bool]:
    best = float("inf")
    for warm in (False, True):
        begin = time.process_time()
        if not isinstance(mechanism, Mechanism | DHLoop):
            answer = _of_parts(mechanism, formulation)
        elif isinstance(mechanism, DHLoop):
            table = table_model(mechanism, formulation)
            answer = decompose(table.system, symmetries=table.symmetries)
        elif formulation == "unreduced":
            answer = decompose(model(mechanism, "E").unreduced)
        else:
            made = model(mechanism, formulation)
            answer = decompose(made.system, symmetries=made.symmetries)
        best = min(best, time.process_time() - begin) if warm else best
        if not warm and time.process_time() - begin > 10:
            best = time.process_time() - begin
            break
    return best, answer.paths.tracked, _kinds(answer), answer.complete


def _of_parts(parts: AssemblyModel, coordinates: str) -> Decomposition:
    each = next(c for c in coordinates_of_parts(parts) if c.formulation == coordinates)
    if each.taken:
        return problem_of(parts).decompose()
    return decompose(each.parts.system, symmetries=each.parts.symmetries)


def _kinds(answer: Decomposition) -> tuple[tuple[int, int, int], ...]:
    counts: dict[tuple[int, int], int] = {}
    for component in answer.components:
        key = component.dimension, component.degree
        counts[key] = counts.get(key, 0) + component.orbit
    return tuple((*key, count) for key, count in sorted(counts.items()))
