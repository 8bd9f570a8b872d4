"""The search for branches of zero sets: factors are followed one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import flint

from nag.algebra.consequences import Consequences, consequences, generators
from nag.algebra.exact_ranks import coefficient_rows, reduce_matrix
from nag.algebra.factoring import Ring
from nag.algebra.polynomial import Polynomial

# A system that falls apart into more branches is better solved as a whole; those that are a linear
# space, or the zeros of one polynomial in one variable, cost next to nothing.
MOST_BRANCHES = 64
MOST_SIMPLE_BRANCHES = 1000
MOST_CHOICES = 5000
# Larger matrices of coefficients are not reduced.
MOST_ENTRIES = 30_000


class TooManyBranches(Exception):
    """There are more branches than are worth it."""


@dataclass(frozen=True, eq=False)
class Irreducible:
    """An irreducible polynomial; ``key`` is the same for equal ones."""

    key: str
    f: Any
    support: frozenset[int]
    degree: int


Equation = tuple[Irreducible, ...]


@dataclass(frozen=True, eq=False)
class State:
    """A branch on the way: each equation is the product of its distinct irreducible factors.

    Attributes:
        equations: in the variables that are left.
        solved: equations of degree one, each with a variable that occurs nowhere else.
        excluded: polynomials whose zeros need not be found: they lie in a branch that was followed
            before, or must not be found at all.
    """

    equations: tuple[Equation, ...]
    solved: tuple[tuple[int, Irreducible], ...]
    excluded: tuple[Irreducible, ...]


class Search:
    def __init__(
        self, over: Ring, groups: Sequence[Sequence[int]], others: bool, split: bool = True
    ) -> None:
        self.ring, self.others, self.split = over, others, split
        self.groups = tuple(tuple(g) for g in groups)
        self.known: dict[str, Equation] = {}
        self.generators = list(over.context.gens())
        self.changed = self.deep = False
        self.choices = self.hard = self.simple = 0

    def factors(self, f: Any) -> Equation:
        """The distinct irreducible factors of a polynomial that is no constant."""
        text = str(f)
        if text not in self.known:
            found = self.ring.factors(f) if self.split else [(f, 1)]
            self.known[text] = tuple(
                self._irreducible(p, text if p is f else str(p)) for p, _ in found
            )
            self.changed |= len(found) != 1 or found[0][1] != 1
        return self.known[text]

    def _irreducible(self, p: Any, text: str) -> Irreducible:
        support = frozenset([i for i, k in enumerate(p.degrees()) if k])
        return Irreducible(text, p, support, int(p.total_degree()))

    def start(self, equations: Sequence[Polynomial], nonzero: Sequence[Polynomial]) -> State | None:
        found = []
        for f in equations:
            if f.degree == 0:
                return None
            found.append(self.factors(self.ring.of(f)))
        changed, self.changed = self.changed, False
        excluded = [p for f in nonzero if f.degree > 0 for p in self.factors(self.ring.of(f))]
        self.changed = changed
        return State(tuple(found), (), tuple(excluded))

    def leaves(self, state: State) -> Iterator[State]:
        self.choices += 1
        simpler = self.simplified(state)
        if simpler is None:
            self.changed = True
            return
        choice = self.choice(simpler)
        if choice is None and self.deep:
            yield from self.finer(simpler)
            return
        if choice is None:
            self._count(simpler)
            yield simpler
            return
        rest = [e for e in simpler.equations if e is not choice]
        often = {p.key: -sum(any(p.key == q.key for q in e) for e in rest) for p in choice}
        tried: list[Irreducible] = []
        for p in sorted(choice, key=lambda p: (often[p.key], p.degree, len(p.f), p.key)):
            excluded = (*simpler.excluded, *tried)
            yield from self.leaves(State((*rest, (p,)), simpler.solved, excluded))
            tried.append(p)

    def refined(self, leaves: Sequence[State]) -> list[State]:
        """The branches that branches fall into by what follows from their equations."""
        self.deep, self.hard, self.simple = True, 0, 0
        try:
            return [finer for leaf in leaves for finer in self.leaves(leaf)]
        except TooManyBranches:
            return list(leaves)

    def finer(self, leaf: State) -> Iterator[State]:
        """The branches of a branch whose equations are irreducible; itself where it has none."""
        found = consequences([product_of(e) for e in leaf.equations])
        more = self.find_telling_equations(leaf, found) if found is not None else []
        needed = 0 if found is None else found.codimension
        if more:
            state = replace(leaf, equations=(*leaf.equations, *more))
            parts = list(self.leaves(state))
            most = len(leaf.equations) + len(leaf.solved)
            # More equations than there were would be squared up, and their zeros less well known.
            if not any(len(p.equations) + len(p.solved) > most for p in parts) and (
                not parts or len(leaf.equations) > needed
            ):
                yield from parts
                return
        elif found is not None and len(leaf.equations) > needed:
            equations = [product_of(e) for e in leaf.equations]
            chosen = generators([*equations, *found.basis])
            leaf = replace(leaf, equations=tuple(self.factors(f) for f in chosen))
        self._count(leaf)
        yield leaf

    def find_telling_equations(self, leaf: State, found: Consequences) -> list[Equation]:
        """Consequences of a branch's equations that say more when factors are excluded."""
        excluded = {p.key for p in leaf.excluded}
        given = {p.key for e in leaf.equations for p in e}
        result: list[Equation] = []
        for g in found.basis:
            factors = () if g.is_constant() else self.factors(g)
            kept = tuple(p for p in factors if p.key not in excluded)
            if sum(p.degree for p in kept) == g.total_degree() and len(kept) == 1:
                continue
            if not any(p.key in given for p in kept):
                result.append(kept)
        return result

    def without_factors(self, equations: Sequence[Polynomial], leaf: State) -> bool:
        """Whether solving linear equations alone leads to the equations of a branch.

        Such a branch is the system's only one, and the same scheme.
        """
        plain = Search(self.ring, self.groups, self.others, split=False)
        start = plain.start(equations, ())
        state = None if start is None else plain.simplified(start)
        if state is None or len(state.solved) != len(leaf.solved):
            return False
        images = self._images(leaf)
        found = set()
        for (p,) in state.equations:
            value = p.f.compose(*images, ctx=self.ring.context)
            found.add(str(value / value.leading_coefficient()))
        return found == {str(f / f.leading_coefficient()) for f in map(product_of, leaf.equations)}

    def _count(self, leaf: State) -> None:
        if _in_one_variable(leaf.equations) and not self.others:
            self.simple += 1
        else:
            self.hard += 1
        if (
            self.hard > MOST_BRANCHES
            or self.simple > MOST_SIMPLE_BRANCHES
            or self.choices > MOST_CHOICES
        ):
            raise TooManyBranches

    def choice(self, state: State) -> Equation | None:
        """The equation to follow the factors of; None where that is not needed."""
        if _in_one_variable(state.equations):
            return None
        several = [e for e in state.equations if len(e) > 1]
        return min(several, key=len, default=None)

    def simplified(self, state: State) -> State | None:
        """The state with linear equations solved; None if it has no zeros that are asked for."""
        while True:
            equations = self._distinct(state)
            if equations is None:
                return None
            state = replace(state, equations=equations)
            pivot = self.choose_pivot(equations)
            if pivot is None:
                return state
            reduced = self._substitute_image(state, *pivot)
            if reduced is None:
                return None
            state = reduced

    def _distinct(self, state: State) -> tuple[Equation, ...] | None:
        """The equations without excluded factors, and without those that others imply."""
        excluded = {p.key for p in state.excluded}
        found: list[Equation] = []
        for e in state.equations:
            kept = tuple(p for p in e if p.key not in excluded)
            if not kept:
                return None
            found.append(kept if len(kept) < len(e) else e)
        single = {e[0].key: e for e in found if len(e) == 1}
        seen: dict[frozenset[str], Equation] = {}
        for e in found:
            keys = frozenset(p.key for p in e)
            if len(e) > 1 and keys & single.keys():
                continue
            seen.setdefault(keys, e)
        self.changed |= any(len(e) < len(f) for e, f in zip(found, state.equations, strict=True))
        if not self.split:
            return tuple(seen.values())
        # Two irreducible polynomials in one variable have no zero in common.
        alone = [next(iter(e[0].support)) for e in single.values() if len(e[0].support) == 1]
        if len(set(alone)) < len(alone):
            return None
        result = tuple(seen.values())
        if len(result) > 1 and _in_one_variable(result):
            self.changed = True
            common = set.intersection(*({p.key for p in e} for e in result))
            kept = tuple(p for p in result[0] if p.key in common)
            return (kept,) if kept else None
        return result

    def choose_pivot(self, equations: Sequence[Equation]) -> tuple[Irreducible, int] | None:
        """A linear equation and the variable to solve it for: the one that fills in least."""
        supports = [frozenset().union(*(p.support for p in e)) for e in equations]
        alone = [e[0] for e in equations if len(e) == 1 and e[0].degree == 1]
        if self.groups:
            # Elsewhere it would raise the degree in a group of variables.
            alone = [p for p in alone if any(p.support <= set(g) for g in self.groups)]
        found = (
            ((len(p.f) - 2) * (sum(index in s for s in supports) - 1), len(p.f), index, k)
            for k, p in enumerate(alone)
            for index in p.support
        )
        best = min(found, default=None)
        return None if best is None else (alone[best[3]], best[2])

    def _substitute_image(self, state: State, p: Irreducible, index: int) -> State | None:
        image = self.ring.solve_for(p.f, index)
        images = [*self.generators[:index], image, *self.generators[index + 1 :]]

        def put(q: Irreducible) -> Any:
            return q.f.compose(*images, ctx=self.ring.context) if index in q.support else q.f

        equations: list[Equation] = []
        for e in state.equations:
            if len(e) == 1 and e[0] is p:
                continue
            if all(index not in q.support for q in e):
                equations.append(e)
                continue
            values = [put(q) for q in e]
            if any(v.is_zero() for v in values):
                continue
            parts = [r for v in values if not v.is_constant() for r in self.factors(v)]
            if not parts:
                return None
            if len(parts) < len(e):
                self.changed = True
            equations.append(tuple({r.key: r for r in parts}.values()))
        excluded: list[Irreducible] = []
        for q in state.excluded:
            value = put(q)
            if value.is_zero():
                return None
            if index not in q.support:
                excluded.append(q)
            elif not value.is_constant():
                changed = self.changed
                excluded.extend(self.factors(value))
                self.changed = changed
        put_in = [(i, put(q)) for i, q in state.solved]
        solved = [(i, self._irreducible(value, str(value))) for i, value in put_in]
        return State(tuple(equations), (*solved, (index, p)), tuple(excluded))

    def parted(self, start: State) -> list[State]:
        """Branches where there are too many: common factors, and the system without them."""
        common = set.intersection(*({p.key for p in e} for e in start.equations))
        excluded = {p.key for p in start.excluded}
        shared = [p for p in start.equations[0] if p.key in common - excluded]
        leaves = [State(((p,),), (), start.excluded) for p in shared]
        rest = [tuple(p for p in e if p.key not in common | excluded) for e in start.equations]
        return [*leaves, State(tuple(rest), (), start.excluded)] if all(rest) else leaves

    def contradictory(self, leaf: State) -> bool:
        """Whether a combination of the equations, by numbers, is a constant that is not zero."""
        if len(leaf.equations) < 2:
            return False
        rows = [product_of(e).to_dict() for e in leaf.equations]
        monomials = sorted({e for row in rows for e in row}, reverse=True)
        if any(monomials[-1]) or len(rows) * len(monomials) > MOST_ENTRIES:
            return False
        _, pivots = reduce_matrix(flint.fmpq_mat(coefficient_rows(rows, monomials)))
        return pivots[-1] == len(monomials) - 1

    def irredundant(self, leaves: Sequence[State]) -> list[State]:
        """The branches without those whose zero sets are seen to lie in others."""
        kept = list(leaves)
        if len(kept) > MOST_BRANCHES:
            return kept
        for leaf in reversed(leaves):
            images, zero = self._images(leaf), [product_of(e) for e in leaf.equations]
            if any(o is not leaf and self._is_contained(leaf, images, zero, o) for o in kept):
                kept.remove(leaf)
        return kept

    def _is_contained(
        self, leaf: State, images: Sequence[Any], zero: Sequence[Any], other: State
    ) -> bool:
        for f in [p.f for _, p in other.solved] + [product_of(e) for e in other.equations]:
            value = f.compose(*images, ctx=self.ring.context) if leaf.solved else f
            if not value.is_zero() and not any(divmod(value, g)[1].is_zero() for g in zero):
                return False
        return True

    def _images(self, leaf: State) -> list[Any]:
        """The variables, those that were solved for as polynomials in the others."""
        images = list(self.generators)
        for i, p in leaf.solved:
            images[i] = self.ring.solve_for(p.f, i)
        return images


def product_of(equation: Equation) -> Any:
    result = equation[0].f
    for p in equation[1:]:
        result = result * p.f
    return result


def _in_one_variable(equations: Sequence[Equation]) -> bool:
    """Whether all equations are in one and the same variable; so it is if there are none."""
    return len(frozenset().union(*(p.support for e in equations for p in e))) < 2
