"""``nag.decompose``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from nag.algebra.given import check_listed
from nag.algebra.symmetry import SignedPermutation, SymmetryError
from nag.mechanism.problem import Problem, problem_of
from nag.tracking.run import DEFAULT_RUN, Run, takes_run

if TYPE_CHECKING:
    from nag.witness.witness import Decomposition


@takes_run
def decompose(
    system: Any,
    variables: Any = None,
    *,
    run: Run = DEFAULT_RUN,
    symmetries: Iterable[Any] | None = None,
) -> Decomposition:
    """The irreducible components over the complex numbers of what satisfies the equations.

    Equations that factor are decomposed apart, the others intersected one by one (u-generation:
    Duff, Leykin & Rodriguez 2022); points are split by monodromy, and components confirmed by the
    trace test (Sommese, Verschelde & Wampler 2001, 2002).

    Args:
        system: a `nag.Mechanism`, a `nag.model`, a `nag.Case`, a `nag.PolynomialSystem`, or
            equations as `nag.system` takes them: texts, sympy's expressions, one or a list.
        variables: of equations, their names in order; see `nag.system`.
        run: a `nag.Run`; its seed, threads, settings and progress may be given one by one.
        symmetries: signed permutations of the variables that keep the equations, each a
            `nag.SignedPermutation`, a dict ``{"x": "-x", "y": "z", "z": "y"}`` or a sign for each
            variable. Of the components that they carry into each other one is reported, with the
            size of its orbit. By default those that the model or the case has; ``()`` for none.

    Returns:
        The components, by falling dimension, as witness sets: points of shape ``(degree, n)``.
        Of a mechanism they live in the variables of ``nag.model(mechanism).system``.

    Raises:
        nag.mechanism.model.ModelError: if a mechanism has no loop.
        nag.algebra.symmetry.SymmetryError: if a symmetry does not keep the equations.
        ValueError: if another argument makes no sense; the message says which, and what would.

    >>> import nag
    >>> answer = nag.decompose(["(x^2 + y^2 - 1)*(x - y)^2"])
    >>> [(c.dimension, c.degree, c.multiplicity) for c in answer.components]
    [(1, 1, 2), (1, 2, 1)]
    """
    problem = problem_of(system, variables)
    kept = read_symmetries(symmetries, problem)
    try:
        return problem.decompose(run=run, symmetries=kept)
    except SymmetryError as error:
        raise SymmetryError(f"symmetries: {error}") from None


def read_symmetries(given: Iterable[Any] | None, problem: Problem) -> tuple[SignedPermutation, ...]:
    """Symmetries given as signed permutations, as maps of names, or as signs of the variables.

    Raises:
        SymmetryError: if one is none.
    """
    if given is None:
        return problem.symmetries
    check_listed(given, "symmetries", "a list of them: [{'x': '-x'}, ...]")
    found = []
    for i, item in enumerate(given):
        try:
            if isinstance(item, SignedPermutation):
                found.append(item)
            elif isinstance(item, Mapping):
                texts = {str(name): str(image) for name, image in item.items()}
                found.append(SignedPermutation.of_map(texts, problem.system.variables))
            elif isinstance(item, Iterable) and not isinstance(item, str):
                found.append(SignedPermutation.of_signs(tuple(int(sign) for sign in item)))
            else:
                raise SymmetryError("give a dict like {'x': '-x'}, or a sign for each variable")
        except (TypeError, ValueError) as error:
            raise SymmetryError(f"symmetries[{i}]: {error}") from None
    return tuple(found)
