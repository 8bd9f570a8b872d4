"""``nag.solve``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from nag.algebra.given import check_running
from nag.interface.problem import Problem, problem_of

if TYPE_CHECKING:
    from nag.solving.solutions import SolveResult
    from nag.tracking.settings import Settings


def solve(
    system: Any,
    variables: Any = None,
    *,
    start: str = "auto",
    seed: int = 0,
    threads: int = 1,
    settings: Settings | str = "default",
    progress: Callable[[str, int, int], None] | None = None,
) -> SolveResult:
    """All isolated solutions of equations, each once, with their multiplicities.

    Equations that factor are solved apart; what comes down to one variable, or to two equations in
    two of few solutions, is solved exactly; else one path is tracked for each solution of a start
    system (Sommese & Wampler 2005, chapters 7 and 8). Of a case with a ``[family]`` whose
    number of solutions is known, they are as many as the family has.

    Args:
        system: equations as `nag.system` takes them (texts, sympy's expressions, one or a list), a
            `nag.PolynomialSystem`, a `nag.Case`, or a mechanism or its model.
        variables: of equations, their names in order; see `nag.system`.
        start: ``"auto"`` (the family's solutions where their number is known, else the least
            work), ``"total"``, ``"multihomogeneous"``, ``"polyhedral"``, ``"monodromy"``, or
            ``"parameter"`` for loops of the parameters of a case's family.
        seed: of the random numbers; the same seed gives the same answer for any ``threads``.
        threads: number of threads.
        settings: ``"fast"``, ``"default"`` or ``"careful"`` tracking.
        progress: called with a stage, the work done and the whole work.

    Returns:
        The solutions; ``.points`` has shape ``(k, n)``, ``.real`` are the real ones.

    Raises:
        nag.StartError: if there would be too many paths, or ``"parameter"``
            is asked for and there is no family.
        ValueError: if an argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> answer = nag.solve(["x^2 + y^2 - 1", "x - y"])
    >>> [[round(float(z.real), 6) for z in s.point] for s in answer.real]
    [[-0.707107, -0.707107], [0.707107, 0.707107]]
    """
    problem = problem_of(system, variables)
    check_running(seed, threads, settings, progress)

    options: dict[str, Any] = {"seed": int(seed), "threads": int(threads), "settings": settings}
    options["progress"] = progress
    if start == "parameter" or (start == "auto" and problem.family and problem.family.solutions):
        return _by_family(problem, start == "auto", options)

    from nag.solving.solve import solve as solve_system

    return solve_system(problem.system, start=start, **options)


def _by_family(problem: Problem, exact_first: bool, options: dict[str, Any]) -> SolveResult:
    from nag.errors import StartError
    from nag.solving.parameter import solve_member

    if problem.family is None:
        raise StartError("parameter: the system has no [family]; leave out start")
    return solve_member(problem.system, problem.family, exact_first=exact_first, **options)
