"""Systems of polynomials with named variables, and what they show at the prompt."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, overload

from nag.algebra.given import check_listed, check_type, value_text
from nag.algebra.number import (
    EQUALITY_DIGITS,
    Number,
    brief_number_text,
    inexact_parts,
    number_text,
)
from nag.algebra.polynomial import Polynomial
from nag.errors import NagError
from nag.text.table import LINE, count_text, html_table, one_line, printable, shorten_text

# Of longer systems the first equations are shown.
MOST_LINES, MOST_ROWS = 4, 40
# Numbers that are named as examples.
MOST_NAMED = 2


@dataclass(frozen=True)
class NamedPoint:
    """A point of interest, one coordinate for each variable of the system.

    Attributes:
        name: by which it is asked for.
        at: its coordinates, exact where they are real, else in doubles.
        called: what it is called in a sentence, if not by its name.
    """

    name: str
    at: tuple[Number | complex, ...]
    called: str = ""


@dataclass(frozen=True)
class PolynomialSystem:
    """Polynomials ``f`` in named variables, and what is known about the space they live in.

    Attributes:
        variables: names, one for each variable.
        polynomials: the equations ``f_i = 0``.
        nonzero: polynomials that must not vanish: components inside one of their zero sets are no
            solutions (points of norm zero in half-angle models, for example).
        groups: a partition of the variables' indices into groups in which multidegrees are
            counted, or empty. A group is one affine chart of a projective space; a group of one
            variable is a chart of a projective line.
        imaginary: whether the last variable is the imaginary unit, whose square is -1 by the last
            equation: zeros where it is -i are those of the conjugate system, and left out
            (`nag.algebra.imaginary_unit`).
        isotropic: whether variables are coordinates x + iy of points, which are not real where the
            points are; `check_real_coordinates` refuses what asks for real zeros.
    """

    variables: tuple[str, ...]
    polynomials: tuple[Polynomial, ...]
    nonzero: tuple[Polynomial, ...] = ()
    groups: tuple[tuple[int, ...], ...] = ()
    imaginary: bool = False
    isotropic: bool = False

    def __post_init__(self) -> None:
        for name in ("variables", "polynomials", "nonzero"):
            check_listed(getattr(self, name), name, "a list; nag.system reads equations as text")
            object.__setattr__(self, name, tuple(getattr(self, name)))
        object.__setattr__(self, "groups", tuple(tuple(g) for g in self.groups))
        if len(set(self.variables)) != len(self.variables):
            raise NagError("variables: two have the same name")
        for polynomial in self.polynomials + self.nonzero:
            advice = "nag.Polynomial only; nag.system reads equations as text"
            check_type(polynomial, Polynomial, "polynomials", advice)
            if polynomial.n != self.n:
                raise NagError(
                    f"polynomials: one is in {polynomial.n} variables in a system of {self.n}"
                )
        if self.groups and sorted(i for g in self.groups for i in g) != list(range(self.n)):
            raise NagError(
                "groups: they are no partition of the variables; give each variable once"
            )
        if self.imaginary:
            unit = Polynomial.variable(self.n, self.n - 1) if self.n else None
            if unit is None or not self.polynomials or self.polynomials[-1] != unit**2 + 1:
                raise NagError("imaginary: the last equation is not that of the imaginary unit")

    @property
    def n(self) -> int:
        """Number of variables."""
        return len(self.variables)

    @property
    def degrees(self) -> tuple[int, ...]:
        """Total degrees of the polynomials; of the imaginary unit's own equation 2."""
        if not self.imaginary:
            return tuple(f.degree for f in self.polynomials)
        # The imaginary unit is a number.
        own = (max((sum(e[:-1]) for e in f.terms), default=0) for f in self.polynomials[:-1])
        return (*own, 2)

    @property
    def exact(self) -> bool:
        """Whether all coefficients are rational."""
        return all(f.exact for f in self.polynomials + self.nonzero)

    @cached_property
    def inexact_text(self) -> str:
        """Which coefficients are no exact numbers, and how they are taken; empty where all are."""
        values = (c for f in (*self.polynomials, *self.nonzero) for c in f.terms.values())
        parts = (part for c in values for part in inexact_parts(c))
        texts = list(dict.fromkeys(map(brief_number_text, parts)))
        if not texts:
            return ""
        named = ", ".join(texts[:MOST_NAMED]) + (", .." if len(texts) > MOST_NAMED else "")
        known = "is not known exactly" if len(texts) == 1 else "are not known exactly"
        return (
            f"{named} {known}: what agrees in {EQUALITY_DIGITS} digits is taken to be equal; "
            "sums of square roots and cosines of rational turns are exact"
        )

    @cached_property
    def jacobian(self) -> tuple[tuple[Polynomial, ...], ...]:
        """Partial derivatives, one row for each polynomial."""
        return tuple(tuple(f.derivative(i) for i in range(self.n)) for f in self.polynomials)

    @property
    def own_variables(self) -> tuple[str, ...]:
        """The variables without the imaginary unit."""
        return self.variables[: self.n - self.imaginary]

    @property
    def unit(self) -> str:
        """What the imaginary unit is called; empty where coefficients are real."""
        return self.variables[-1] if self.imaginary else ""

    @property
    def own_groups(self) -> tuple[tuple[int, ...], ...]:
        """The groups without one of the imaginary unit alone."""
        alone = (self.n - 1,)
        return tuple(g for g in self.groups if not (self.imaginary and g == alone))

    def __call__(self, point: Sequence[Any]) -> list[Any]:
        """Values of all polynomials at ``point``, exact if its entries are."""
        if not hasattr(point, "__len__") or len(point) != self.n:
            raise NagError(f"point: {value_text(point)} is given; give {self.n} numbers")
        return [f(point) for f in self.polynomials]

    def check_real_coordinates(self) -> None:
        """Refuse variables that are not real where what they describe is.

        Raises:
            nag.NagError: if they are isotropic coordinates.
        """
        if self.isotropic:
            raise NagError(
                "component: its variables are isotropic coordinates x + iy, which are not real "
                "where the points are; ask of the framework itself, not of what was found in these"
            )

    def text(self) -> list[str]:
        """The polynomials as text."""
        return [f.text(self.variables) for f in self.polynomials]

    def __iter__(self) -> Iterator[Polynomial]:
        return iter(self.polynomials)

    def __len__(self) -> int:
        return len(self.polynomials)

    @overload
    def __getitem__(self, index: int) -> Polynomial: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Polynomial, ...]: ...

    def __getitem__(self, index: int | slice) -> Polynomial | tuple[Polynomial, ...]:
        return self.polynomials[index]

    def to_sympy(self) -> list[Any]:
        """The polynomials as sympy's expressions, exact, in symbols of the variables' names.

        Raises:
            nag.NagError: if sympy is not installed.
        """
        from nag.algebra.to_sympy import to_sympy_polynomials

        own = self.polynomials[:-1] if self.imaginary else self.polynomials
        return to_sympy_polynomials(own, self.variables, self.imaginary)

    def document(self) -> dict[str, Any]:
        """The system as a JSON object."""
        unit: dict[str, Any] = {"imaginary": self.variables[-1]} if self.imaginary else {}
        unit |= {"isotropic": True} if self.isotropic else {}
        return {
            "variables": list(self.variables),
            "polynomials": self.text(),
            "nonzero": [f.text(self.variables) for f in self.nonzero],
            "groups": [[self.variables[i] for i in group] for group in self.groups],
            "exact": self.exact,
            **unit,
        }

    __repr__ = one_line

    def __str__(self) -> str:
        """Five lines: what it is, and its first equations."""
        lines = [f"PolynomialSystem of {system_line(self)}"]
        shown = len(self.polynomials) if len(self.polynomials) <= MOST_LINES else MOST_LINES - 1
        lines += [f"  {f.text(self.variables)} = 0" for f in self.polynomials[:shown]]
        if shown < len(self.polynomials):
            lines.append(f"  and {count_text(len(self.polynomials) - shown, 'more equation')}")
        return "\n".join(shorten_text(printable(line)) for line in lines)

    def _repr_html_(self) -> str:
        """A table, one row an equation."""
        rows = [["equation", "degree", "is zero"]]
        for i, f in enumerate(self.polynomials[:MOST_ROWS], 1):
            rows.append([str(i), str(f.degree), shorten_text(f.text(self.variables), 2 * LINE)])
        hidden = len(self.polynomials) - MOST_ROWS
        note = f"and {count_text(hidden, 'more equation')}" if hidden > 0 else ""
        return html_table(f"PolynomialSystem of {system_line(self)}", rows, note)


def values_text(names: Iterable[str], values: Iterable[Number | complex]) -> str:
    """``x = 1/2, y = 3``."""
    return ", ".join(f"{n} = {number_text(x)}" for n, x in zip(names, values, strict=True))


def system_line(system: PolynomialSystem) -> str:
    """Variables, equations and degrees in one line; the imaginary unit is none of the former."""
    degrees: dict[int, int] = {}
    own = len(system.polynomials) - system.imaginary
    for degree in sorted(system.degrees[:own]):
        degrees[degree] = degrees.get(degree, 0) + 1
    listed = ", ".join(f"{n} of degree {d}" for d, n in degrees.items())
    count = len(system.own_variables)
    names = ", ".join(system.own_variables)
    text = (
        f"{count_text(count, 'variable')}{f' ({names})' if 0 < len(names) <= 60 else ''}, "
        f"{count_text(own, 'equation')}{f': {listed}' if listed else ''}"
    )
    text = text if system.exact else f"{text}; not all coefficients are rational"
    text += f"; {system.inexact_text}" if system.inexact_text else ""
    return f"{text}; {system.variables[-1]} is the imaginary unit" if system.imaginary else text
