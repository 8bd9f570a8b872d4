"""Zero sets that fall apart exactly, because equations factor over their coefficients' field.

``V(f g, h)`` is ``V(f, h)`` and ``V(g, h)`` together. Linear factors are solved, so that what is
left may factor again, until every equation of a branch is irreducible (`branch_search`); then what
follows from the equations of a branch is factored as well (`consequences`): so far as equations are
rational. Those with square roots are factored (`conjugate_factors`), and wait.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from nag.algebra.branch_search import Search, State, TooManyBranches, product_of
from nag.algebra.conjugate_factors import make_monic
from nag.algebra.elimination import use_linear
from nag.algebra.factoring import factor_into_irreducibles, ring
from nag.algebra.imaginary_unit import as_real
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem

# Polynomials of more terms are not factored.
MOST_TERMS = 30_000


@dataclass(frozen=True)
class Branch:
    """A part of a zero set.

    Attributes:
        linear: equations of degree one.
        others: equations in which the linear ones have been used, square-free; irreducible where
            the system did not have too many branches.
    """

    linear: tuple[Polynomial, ...]
    others: tuple[Polynomial, ...]

    @property
    def polynomials(self) -> tuple[Polynomial, ...]:
        return self.linear + self.others

    def system(self, like: PolynomialSystem) -> PolynomialSystem:
        """The branch with the variables, conditions and groups of another system."""
        return replace(as_real(like), polynomials=self.polynomials)


@dataclass(frozen=True)
class Branches:
    """What the search for branches of a system shows.

    Attributes:
        parts: the branches, none of them in another one; None if the system is its only branch.
        curved: whether it is, and others are left when linear equations have been used, none of
            them linear in a variable, so that elimination ends there.
    """

    parts: tuple[Branch, ...] | None
    curved: bool = False


def branches(system: PolynomialSystem) -> tuple[Branch, ...] | None:
    """The branches of a system; None if it is its only branch.

    None of them is in another one, if equations are rational; others are not compared as sets.
    Their zero sets together are that of the system, but for what lies in the zero set of a
    polynomial of ``system.nonzero``. There is no branch where the equations contradict each other.
    """
    return search_branches(system).parts


def search_branches(system: PolynomialSystem) -> Branches:
    """The branches of a system, as `branches` says, and what else was seen on the way."""
    apart = _split_with_roots(system)
    if apart is not None:
        return Branches(_join([_branches_or_itself(part) for part in apart]))
    equations = [
        f if f.exact or not f.algebraic else make_monic(f) for f in system.polynomials if f
    ]
    exact = [f for f in equations if f.exact and len(f.terms) <= MOST_TERMS]
    rest = tuple(dict.fromkeys(f for f in equations if not f.exact or len(f.terms) > MOST_TERMS))
    if not exact:
        return Branches(None)
    search = Search(ring(system.n), system.groups, bool(rest))
    start = search.start(exact, [f for f in system.nonzero if f and f.exact])
    if start is None:
        return Branches(())
    try:
        leaves = list(search.leaves(start))
    except TooManyBranches:
        leaves = search.parted(start)
    else:
        if len(leaves) == 1 and (not search.changed or search.without_factors(exact, leaves[0])):
            return Branches(None, not rest and _is_curved(leaves[0]))
        leaves = search.refined(leaves)
    leaves = [leaf for leaf in leaves if not search.contradictory(leaf)]
    found = [_branch(search, leaf, rest) for leaf in search.irredundant(leaves)]
    return Branches(tuple(sorted(found, key=lambda b: len(b.polynomials))))


def _split_with_roots(system: PolynomialSystem) -> list[PolynomialSystem] | None:
    """Systems with one factor each of an equation with square roots; None if none has several.

    A linear factor is solved, so that what is left may factor again.
    """
    for i, f in enumerate(system.polynomials):
        if f.exact or not f.algebraic or len(f.terms) > MOST_TERMS:
            continue
        factors = factor_into_irreducibles(f)
        if [k for _, k in factors] in ([], [1]):
            continue
        others = (*system.polynomials[:i], *system.polynomials[i + 1 :])
        return [replace(system, polynomials=(p, *use_linear(p, others))) for p, _ in factors]
    return None


def _branches_or_itself(system: PolynomialSystem) -> tuple[Branch, ...]:
    found = branches(system)
    if found is not None:
        return found
    given = [f for f in system.polynomials if f]
    if any(f.degree == 0 for f in given):
        return ()
    linear, others = ([f for f in given if (f.degree == 1) == flat] for flat in (True, False))
    return (Branch(tuple(linear), tuple(others)),)


def _join(found: Sequence[Sequence[Branch]]) -> tuple[Branch, ...]:
    """Branches of several systems, without those that have all equations of another one."""
    kept: list[Branch] = []
    for branch in sorted((b for part in found for b in part), key=lambda b: len(b.polynomials)):
        if not any(set(other.polynomials) <= set(branch.polynomials) for other in kept):
            kept.append(branch)
    return tuple(kept)


def _is_curved(leaf: State) -> bool:
    """Whether equations are left, and none of them is linear in a variable."""
    left = [product_of(e) for e in leaf.equations]
    return bool(left) and not any(
        k == 1 and f.derivative(i).is_constant() for f in left for i, k in enumerate(f.degrees())
    )


def _branch(search: Search, leaf: State, rest: tuple[Polynomial, ...]) -> Branch:
    make = search.ring.factor_polynomial
    linear = [make(p.f) for _, p in leaf.solved]
    others = [make(product_of(e)) for e in leaf.equations]
    linear += [f for f in others if f.degree == 1]
    return Branch(tuple(linear), (*(f for f in others if f.degree > 1), *rest))
