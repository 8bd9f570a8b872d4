"""What is proved of solutions: a zero in a box about each, distinct, real or not, and all of them.

Each statement of an export of solutions is proved, refuted, or said not to have been looked at.

References:
    Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, 1969;
    Breiding, Rose & Timme, Certifying zeros of polynomial systems using interval arithmetic, 2023.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from nag.algebra.combinations import of_lowest_degrees
from nag.algebra.imaginary_unit import as_real
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.numerics.certified_points import (
    CertifiedPoints,
    Proof,
    certify_points,
    cost_row,
    distinct_simple,
    points_rows,
)
from nag.numerics.claims import CERTIFICATE, Claim, Standing, nothing_against, standing_of_field
from nag.numerics.krawczyk import find_overlaps, tell_real_zeros
from nag.numerics.point_claims import (
    find_nonvanishing,
    zero_digits,
)
from nag.numerics.read_only import equal_values, fix_fields
from nag.solving.solution_claims import claims_of_solutions
from nag.solving.solutions import Solution, Solutions, SolveResult
from nag.solving.start.multihomogeneous import best_groups
from nag.solving.start.target import Target
from nag.solving.start.total_degree import bezout
from nag.text.table import count_text
from nag.tracking.blocks import share

if TYPE_CHECKING:
    from nag.solving.certified_paths import ProvedPaths


@dataclass(frozen=True, eq=False)
class SolutionsCertificate:
    """What is proved of the solutions of a system.

    Attributes:
        result: the solutions.
        points: what is proved of each of them.
        real, not_real: which of the zeros in their boxes are real, and which not, shape ``(k,)``;
            proved but for those on evidence, `CertifiedPoints.on_evidence`.
        same, unknown: pairs of indices with the same zero, and of which that is not known; all
            other pairs of proved zeros are proved distinct.
        nonzero: which solutions are proved to be no zeros of `PolynomialSystem.nonzero`, ``(k,)``.
        excluded: what is proved of the solutions that were left out, as far as they are known;
            solutions_left_out: which of these are proved to be solutions, as nothing that must not
            vanish does so there.
        bound: no system of these monomials has more isolated zeros, or None for a system of more
            equations than unknowns; bound_name: which number that is.
    """

    result: SolveResult
    points: CertifiedPoints
    real: np.ndarray
    not_real: np.ndarray
    same: tuple[tuple[int, int], ...]
    unknown: tuple[tuple[int, int], ...]
    nonzero: np.ndarray
    excluded: CertifiedPoints
    solutions_left_out: np.ndarray
    bound: int | None
    bound_name: str

    __eq__ = equal_values

    def __post_init__(self) -> None:
        # What is worked out of points in place is done.
        fix_fields(self, done=True)

    @cached_property
    def simple(self) -> int:
        """Number of distinct simple solutions that are proved."""
        return distinct_simple([self.points])

    @cached_property
    def zeros(self) -> int:
        """Number of distinct simple zeros of all equations, with those that were left out."""
        return distinct_simple([self.points, self.excluded])

    @property
    def distinct(self) -> bool:
        """Whether all proved zeros are proved distinct."""
        return not self.same and not self.unknown

    @property
    def contradicted(self) -> dict[str, int]:
        """What the result says of so many solutions, and is proved to be false."""
        left_out = int(self.solutions_left_out.sum())
        found = self._false(~self._deflated_on_evidence)
        return found | ({"excluded": left_out} if left_out else {})

    @property
    def doubted(self) -> dict[str, int]:
        """What the result says of so many solutions, and is false by evidence."""
        return self._false(self._deflated_on_evidence)

    @property
    def _deflated_on_evidence(self) -> np.ndarray:
        # Elsewhere no other zero of as many equations as unknowns is in the box.
        return self.points.on_evidence & np.array(
            [p is Proof.DEFLATED for p in self.points.proofs], dtype=bool
        )

    def _false(self, among: np.ndarray) -> dict[str, int]:
        proofs, said_real = self.points.proofs, self.result.table.real
        said_simple = self.result.table.multiplicity == 1
        simple = np.array([p is Proof.SIMPLE for p in proofs], dtype=bool)
        singular = np.array([p in (Proof.EXACT, Proof.DEFLATED) for p in proofs], dtype=bool)
        found = {
            "real": said_real & self.not_real,
            "not real": ~said_real & self.real,
            "multiple": ~said_simple & simple,
            "simple": said_simple & singular,
        }
        counts = {what: int((false & among).sum()) for what, false in found.items()}
        return {what: count for what, count in counts.items() if count}

    @property
    def all_proved(self) -> bool:
        """Whether each is proved a solution, as is said of it, and all differ; not on evidence."""
        proved = self.points.all_proved and self._is_borne_out and bool(self.nonzero.all())
        return proved and nothing_against(self.claims)

    @cached_property
    def claims(self) -> tuple[Claim, ...]:
        """Every statement of an export of the solutions, and how it stands."""
        return claims_of_solutions(self)

    @property
    def _is_borne_out(self) -> bool:
        """Whether each point is next to a zero of the equations of its own, as is said of it."""
        told = not self.contradicted and not self.doubted
        return Proof.NONE not in self.points.proofs and self.distinct and told

    @property
    def complete(self) -> bool:
        """Whether it is proved that the equations have no isolated solutions but those listed.

        As many simple zeros as can be are among the points of the lists, whatever else is there.
        """
        listed = self.bound is not None and self.zeros == self.bound
        return listed and not self.solutions_left_out.any()

    def rows(self, seconds: float) -> list[tuple[str, str]]:
        """What is proved, as labelled texts; ``seconds``: how long it took."""
        points, proved = self.points, self.points.boxes.proved
        rows = points_rows([points], "solutions")
        evidence = points.on_evidence
        sides = self.real, self.not_real
        real, complex_ = (int((side & ~evidence).sum()) for side in sides)
        text = f"{real} proved real, {complex_} proved not real"
        open_ = int((proved & ~sides[0] & ~sides[1]).sum())
        rows.append(("reality", text + (f", {open_} open" if open_ else "")))
        if evidence.any():
            real, complex_ = (int((side & evidence).sum()) for side in sides)
            rows.append(("", f"on evidence {real} real, {complex_} not real"))
        if self.distinct:
            rows.append(("distinct", "the zeros in the boxes are proved to be distinct"))
        rows += self._excluded_rows()
        if self.bound is not None:
            number = f"{self.bound_name}, {self.bound}"
            text = f"proved: there are no more isolated zeros than {number}"
            if not self.complete:
                simple = f"{count_text(self.zeros, 'simple zero')} "
                simple += "is proved" if self.zeros == 1 else "are proved"
                text = f"not proved: {simple}"
                if self.solutions_left_out.any():
                    text += ", among them solutions that are said to be excluded"
                text += f"; there are no more than {number}"
                if standing_of_field(self.claims, "complete") is Standing.EVIDENCE:
                    text += "; on evidence these are all, as many as are counted modulo two primes"
            rows.append(("complete", text))
        rows.append(cost_row([points], seconds))
        return rows

    def _excluded_rows(self) -> list[tuple[str, str]]:
        """What is proved of the zeros where something vanishes that must not."""
        left_out = self.excluded
        chosen = left_out.boxes.proved & ~self.solutions_left_out
        if not chosen.any():
            return []
        system = self.result.system
        equations = [f for f in system.polynomials if f]
        digits = zero_digits(system.nonzero, equations, left_out)[chosen].min()
        text = (
            f"{chosen.sum()} more zeros of the equations are proved, where something that must not "
            f"vanish does to {digits:.0f} digits"
        )
        return [("excluded", text)]

    def document(
        self, claims: Sequence[Claim] | None = None, paths: ProvedPaths | None = None
    ) -> dict[str, Any]:
        """The certificate as a JSON object.

        Args:
            claims: how the statements of an export stand, if paths say more than the certificate.
            paths: what is proved of the paths to the solutions.
        """
        proved = ~self.points.on_evidence
        return {
            **CERTIFICATE,
            "of": "solutions",
            "system": self.result.system.document(),
            "all_proved": self.all_proved and nothing_against(claims or ()),
            "complete": self.complete,
            "bound": self.bound,
            "simple": self.simple,
            "real": [
                True if real else False if other else None
                for real, other in zip(self.real & proved, self.not_real & proved, strict=True)
            ],
            "same": [list(pair) for pair in self.same],
            "unknown": [list(pair) for pair in self.unknown],
            "points": self.points.document(),
            "excluded": self.excluded.document(),
            **({} if paths is None else {"paths": paths.document()}),
            "statements": [c.document() for c in (self.claims if claims is None else claims)],
        }


@np.errstate(over="ignore", invalid="ignore")
def certify_solutions(result: SolveResult) -> SolutionsCertificate:
    """Prove what can be proved of the solutions of a system."""
    system = result.system
    none = np.zeros((0, 1 + system.n), dtype=complex)
    equations = [f for f in system.polynomials if f]

    def proved(solutions: Sequence[Solution]) -> CertifiedPoints:
        said = Solutions.of(solutions, system.n)
        # A zero that is alone with its conjugate in a box is real only if coefficients are.
        real = said.real & (not system.imaginary)
        multiple = said.multiplicity > 1
        return certify_points(
            system.polynomials, none, said.points, said.accuracy, multiple, real, share
        )

    points = proved(result.solutions)
    same, unknown = find_overlaps(points.boxes)
    real, not_real = tell_real_zeros(points.boxes, system)
    real |= points.real
    bound, name = bound_of_zeros(system)
    excluded = proved(result.excluded_solutions)
    return SolutionsCertificate(
        result=result,
        points=points,
        real=real,
        not_real=not_real,
        same=tuple(same),
        unknown=tuple(unknown),
        nonzero=find_nonvanishing(system.nonzero, equations, none, points),
        excluded=excluded,
        solutions_left_out=find_nonvanishing(system.nonzero, equations, none, excluded),
        bound=bound,
        bound_name=name,
    )


def bound_of_zeros(system: PolynomialSystem) -> tuple[int | None, str]:
    """A number that isolated zeros cannot exceed, by Bezout's theorem, and its name.

    The product of the degrees, or the coefficient that belongs to groups of variables (Morgan &
    Sommese 1987), of the equations or of combinations of theirs; integers that are computed
    exactly. Where the imaginary unit is a variable, half of them are zeros of the conjugate system.
    """
    if system.imaginary:
        number, name = bound_of_zeros(as_real(system))
        return None if number is None else number // 2, f"half of {name}"
    equations = [f for f in system.polynomials if f]
    if not equations or len(equations) != system.n:
        return None, ""
    if any(f.degree == 0 for f in equations):
        return 0, "a constant that is not zero"
    number, name = _bezout_number(system, equations)
    lower = of_lowest_degrees(equations)
    fewer, how = _bezout_number(system, lower)
    return (fewer, f"{how} of combinations of the equations") if fewer < number else (number, name)


def _bezout_number(system: PolynomialSystem, equations: Sequence[Polynomial]) -> tuple[int, str]:
    """The smallest of Bezout's numbers of equations in a system's variables, and its name."""
    target = Target(system.n, tuple(dict(f.terms) for f in equations))
    total = bezout(target)
    groups, number = best_groups(target, system.groups)
    if number < total:
        sizes = ", ".join(str(len(g)) for g in groups)
        return number, f"Bezout's number in groups of {sizes}"
    return total, "Bezout's number"
