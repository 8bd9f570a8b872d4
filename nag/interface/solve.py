"""``nag.solve``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from nag.mechanism.problem import Problem, problem_of
from nag.tracking.run import DEFAULT_RUN, Run, takes_run

if TYPE_CHECKING:
    from nag.solving.solutions import SolveResult


@takes_run
def solve(
    system: Any,
    variables: Any = None,
    *,
    start: str = "auto",
    run: Run = DEFAULT_RUN,
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
        run: a `nag.Run`; its seed, threads, settings and progress may be given one by one.

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

    if start == "parameter" or (start == "auto" and problem.family and problem.family.solutions):
        return _by_family(problem, start == "auto", run)

    from nag.solving.solve import solve as solve_system

    return solve_system(problem.system, start=start, run=run)


def _by_family(problem: Problem, exact_first: bool, run: Run) -> SolveResult:
    from nag.errors import StartError
    from nag.solving.parameter import solve_member

    if problem.family is None:
        raise StartError("parameter: the system has no [family]; leave out start")
    return solve_member(problem.system, problem.family, exact_first=exact_first, run=run)
