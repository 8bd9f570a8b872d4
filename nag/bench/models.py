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
from nag.mechanism.graph import Mechanism
from nag.mechanism.model import model
from nag.mechanism.path_estimates import fewest_estimated_paths
from nag.mechanism.problem import problem_of
from nag.witness.witness import Decomposition

Parts = Mechanism | AssemblyModel
UNREDUCED = "unreduced"

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
    name: str, given: Parts, patience: float, formulations: Sequence[str] | None = None
) -> list[Formulated]:
    """A mechanism, a table or parts in all formulations, or coordinates, that they may have.

    Each is given ``patience`` seconds. The unreduced equations of a mechanism are the first.

    Raises:
        nag.mechanism.model.ModelError: if a mechanism has no loop.
    """
    problem = problem_of(given)
    made, rows = problem.model, []
    if problem.mechanism is not None:
        unreduced = problem.mechanism.unreduced
        rows.append(_measured(name, UNREDUCED, False, unreduced, given, patience))
    covered = [a for a in made.alternatives if a.form is not None]
    taken = made.formulation or covered[0].formulation
    for each in covered:
        if not formulations or each.formulation in formulations:
            here = each.formulation == taken
            rows.append(_measured(name, each.formulation, here, each.system, given, patience))
    return rows


def _measured(
    name: str,
    formulation: str,
    taken: bool,
    system: PolynomialSystem,
    given: Parts,
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
    answer = _in_time(given, formulation, patience)
    if answer is None:
        return row
    seconds, paths, components, complete = answer
    return replace(row, paths=paths, seconds=seconds, components=components, complete=complete)


def _in_time(given: Parts, formulation: str, patience: float) -> Any:
    """What `_decomposed` gives, in a process of its own, which is ended when time is over."""
    context = multiprocessing.get_context("spawn")
    receiving, sending = context.Pipe(False)
    process = context.Process(target=_send, args=(sending, given, formulation))
    process.start()
    sending.close()
    try:
        return receiving.recv() if receiving.poll(patience) else None
    except EOFError:
        return None
    finally:
        process.terminate()
        process.join()


def _send(sending: Any, given: Parts, formulation: str) -> None:
    sending.send(_decomposed(given, formulation))


def _decomposed(
    given: Parts, formulation: str
) -> tuple[float, int, tuple[tuple[int, int, int], ...], bool]:
    best = float("inf")
    for warm in (False, True):
        begin = time.process_time()
        answer = _answer(given, formulation)
        best = min(best, time.process_time() - begin) if warm else best
        if not warm and time.process_time() - begin > 10:
            best = time.process_time() - begin
            break
    return best, answer.paths.tracked, _kinds(answer), answer.complete


def _answer(given: Parts, formulation: str) -> Decomposition:
    if formulation == UNREDUCED:
        return decompose(model(given, "E").unreduced)
    if isinstance(given, AssemblyModel) and given.formulation is None:
        others = {a.formulation: a.form for a in given.alternatives[1:]}
        return problem_of(others.get(formulation, given)).decompose()
    return problem_of(given, formulation=formulation).decompose()


def _kinds(answer: Decomposition) -> tuple[tuple[int, int, int], ...]:
    counts: dict[tuple[int, int], int] = {}
    for component in answer.components:
        key = component.dimension, component.degree
        counts[key] = counts.get(key, 0) + component.orbit
    return tuple((*key, count) for key, count in sorted(counts.items()))
