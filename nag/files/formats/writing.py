"""A polynomial system as the text of another program."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import count

from nag.algebra.number import Number, decimal_text, number_text
from nag.algebra.polynomial import Exponents, Polynomial
from nag.algebra.system import PolynomialSystem
from nag.algebra.tokens import names_in
from nag.errors import NagError
from nag.files.formats import plain, words

# Digits of irrational coefficients where a program takes decimals only: some more than a double.
DECIMALS = 20

_LETTERS = re.compile(r"[^A-Za-z0-9]+")
_GREEK = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho "
    "varsigma sigma tau upsilon phi chi psi omega"
)
_LATIN = {chr(0x3B1 + k): name for k, name in enumerate(_GREEK.split())}
_PLAIN = _LATIN | {c.upper(): name.capitalize() for c, name in _LATIN.items() if name != "varsigma"}
_NUMBER = re.compile(r"(?<![\w.])[0-9]+")
# Two whole numbers, the first of which divides nothing itself.
_FRACTION = re.compile(r"(?<![\w./])([0-9]+)/([0-9]+)(?![\w.])")
_INNERMOST = re.compile(r"\([^()]*\)|\{[^{}]*\}")
# A sign that is neither the first nor an exponent's.
_OUTER_SUM = re.compile(r"(?<=.)(?<!e)[+-]")
# What the names of variables must not be in a program besides.
_TAKEN = frozenset(
    "I i ii im E D O S N Q C e pi Pi sin cos exp sqrt tan log lambda".split()  # noqa: SIM905
)


def _plain_names(
    names: Sequence[str],
    allowed: str,
    taken: frozenset[str] = _TAKEN,
    reserved: frozenset[str] = frozenset(),
) -> dict[str, str]:
    """A name of letters and digits for each that a program does not take, no two the same.

    Args:
        allowed: the pattern of names that it takes; one of them stays so with more letters or
            digits behind it, and with ``v`` before it.
        taken: names that it does not take all the same.
        reserved: names that it does not take with an index either, as in ``ring_1``.
    """
    pattern = re.compile(allowed)

    def fits(name: str) -> bool:
        written = pattern.fullmatch(name) and name not in taken
        return bool(written) and name.partition("_")[0] not in reserved

    kept = {n for n in names if fits(n)}
    written: dict[str, str] = {n: n for n in kept}
    used = set(kept)
    for name in names:
        if name in written:
            continue
        # Accents fall off, and raised or lowered digits become digits.
        letters = "".join(_PLAIN.get(c, c) for c in unicodedata.normalize("NFKD", name))
        letters = "".join(c for c in letters if not unicodedata.combining(c)).replace("'", "p")
        base = _LETTERS.sub("_", letters).strip("_") or "x"
        base = base.replace("_", "") if pattern.fullmatch("a_b") is None else base
        base = base if base[0].isalpha() else f"x{base}"
        choice = next(c for c in _longer_names(base) if c not in used and fits(c))
        written[name] = choice
        used.add(choice)
    return {name: written[name] for name in names}


def _longer_names(base: str) -> Iterator[str]:
    """The name, and longer ones without end."""
    stems = (base, f"{base}v", f"v{base}")
    yield from stems
    for k in count(2):
        yield from (f"{stem}{'v' * stem[-1].isdigit()}{k}" for stem in stems)


def _remarks(
    system: PolynomialSystem, names: Mapping[str, str], unit: str, rounded: bool = False
) -> list[str]:
    """Lines of comment: names that were changed, what must not vanish, what was rounded."""
    changed = [f"{new} is {old}" for old, new in names.items() if new != old]
    lines = [f"names: {', '.join(changed)}"] if changed else []
    if rounded and not system.exact:
        lines.append(f"irrational numbers are rounded to {DECIMALS} digits")
    written = list(names.values())
    texts = [_polynomial_text(f, written, number_text, "^", unit) for f in system.nonzero]
    return [*lines, *(f"{plain.NONZERO}{text}" for text in texts)]


def _decimal(value: Number) -> str:
    """An irrational number to `DECIMALS` digits, a rational one as it is."""
    if not hasattr(value, "evaluate") and "sqrt" not in number_text(value):
        return number_text(value)
    return decimal_text(value, DECIMALS)


def _variables(system: PolynomialSystem) -> tuple[str, ...]:
    """The names of the variables but the imaginary unit."""
    return system.variables[: system.n - system.imaginary]


def _polynomials(system: PolynomialSystem) -> tuple[Polynomial, ...]:
    """The polynomials but that of the imaginary unit."""
    return system.polynomials[: len(system.polynomials) - system.imaginary]


def _texts(
    system: PolynomialSystem,
    names: Sequence[str],
    number: Callable[[Number], str],
    power: str,
    unit: str,
) -> list[str]:
    """The polynomials with other names, numbers, powers and imaginary unit."""
    return [_polynomial_text(f, names, number, power, unit) for f in _polynomials(system)]


def _polynomial_text(
    f: Polynomial, names: Sequence[str], number: Callable[[Number], str], power: str, unit: str
) -> str:
    parts = []
    for e, coefficient in _terms(f, len(names)):
        factors = [n if k == 1 else f"{n}{power}{k}" for n, k in zip(names, e, strict=True) if k]
        sign, size = _coefficient(coefficient, number, f"*{unit}")
        if size != "1" or not factors:
            factors.insert(0, size)
        parts.append(f" {sign} {'*'.join(factors)}")
    return _join_terms(parts)


def _join_terms(terms: Sequence[str]) -> str:
    """Terms, each with its sign before it, as one text."""
    text = "".join(terms).removeprefix(" + ") or "0"
    return f"-{text[3:]}" if text.startswith(" - ") else text


def _terms(f: Polynomial, n: int) -> list[tuple[Exponents, Mapping[int, Number]]]:
    """Exponents of the first ``n`` variables, with the coefficient of each power of the unit.

    Programs that know the unit as a number (PHCpack) take it in coefficients only.
    """
    terms: dict[Exponents, dict[int, Number]] = {}
    for e, c in f.terms.items():
        terms.setdefault(e[:n], {})[sum(e[n:])] = c
    return sorted(terms.items(), key=lambda term: (-sum(term[0]), tuple(-k for k in term[0])))


def _coefficient(
    parts: Mapping[int, Number], number: Callable[[Number], str], times_unit: str
) -> tuple[str, str]:
    """A coefficient as its sign and what follows it, in parentheses where it has two parts."""
    texts = []
    for power in sorted(parts):
        sign, size = _sign_and_size(number(parts[power]))
        if _OUTER_SUM.search(_drop_parentheses(size)):
            size = f"({size})"
        if power:
            size = times_unit.lstrip("* ") if size == "1" else f"{size}{times_unit}"
        texts.append((sign, size))
    if len(texts) == 1:
        return texts[0]
    return "+", f"({_join_terms([f' {sign} {size}' for sign, size in texts])})"


def _drop_parentheses(text: str) -> str:
    """The text without what is in parentheses or braces."""
    while text != (shorter := _INNERMOST.sub("", text)):
        text = shorter
    return text


def _sign_and_size(text: str) -> tuple[str, str]:
    """A number's text as a sign and what follows it."""
    whole = re.fullmatch(r"\(-([\w()]+)\)", text)
    text = f"-{whole[1]}" if whole else text
    return ("-", text[1:]) if text.startswith("-") else ("+", text)


def _only_rational(system: PolynomialSystem, program: str) -> None:
    if not system.exact:
        raise NagError(
            f"not all coefficients are rational, which a ring QQ[...] of {program} asks for; write "
            "bertini, phc, sympy, hc or latex"
        )


def write_phc(system: PolynomialSystem, title: str) -> str:
    """The system as PHCpack reads it; irrational numbers to `DECIMALS` digits."""
    variables = _variables(system)
    # An e begins an exponent, an i the unit, whatever follows.
    names = _plain_names(variables, r"[A-DF-HJ-Za-df-hj-z][A-Za-z0-9_]*")
    lines = [f"{len(_polynomials(system))} {len(variables)}"]
    # Unknowns are taken in the order of their first occurrence.
    order = "".join(f"{names[v]} - {names[v]} + " for v in variables)
    for text in _texts(system, list(names.values()), _decimal, "^", "i"):
        lines.append(f"{order}{text};")
        order = ""
    return "\n".join([*lines, "", f"TITLE : {title}", *_remarks(system, names, "i", True)]) + "\n"


def write_bertini(system: PolynomialSystem, title: str) -> str:
    """The system as an input file of Bertini 1; irrational numbers to `DECIMALS` digits."""
    variables = _variables(system)
    names = _plain_names(variables, r"[A-Za-z][A-Za-z0-9_\[\]]*", _TAKEN | words.BERTINI)
    groups = [[i for i in g if i < len(variables)] for g in system.groups or [range(system.n)]]
    functions = [f"f{k}" for k in range(1, len(_polynomials(system)) + 1)]
    functions = [f if f not in names.values() else f"nag_{f}" for f in functions]
    lines = [f"% {line}" for line in (title, *_remarks(system, names, "I", True))]
    lines += ["CONFIG", "END;", "INPUT"]
    written = list(names.values())
    lines += [f"variable_group {', '.join(written[i] for i in g)};" for g in groups if g]
    lines.append(f"function {', '.join(functions)};")
    texts = _texts(system, written, _decimal, "^", "I")
    lines += [f"{name} = {text};" for name, text in zip(functions, texts, strict=True)]
    return "\n".join([*lines, "END;"]) + "\n"


def write_macaulay2(system: PolynomialSystem, title: str) -> str:
    """A ring over QQ, or over QQ with the unit i, and an ideal in it, for Macaulay2."""
    _only_rational(system, "Macaulay2")
    variables = _variables(system)
    # Of x and x_1 the first would be the table of the others.
    tables = {re.split(r"[_\[]", name)[0] for name in variables if not name.isalnum()}
    pattern = r"[A-Za-z][A-Za-z0-9]*(?:_[0-9]+)?"
    names = _plain_names(variables, pattern, _TAKEN | tables, words.MACAULAY2)
    lines = [f"-- {line}" for line in (title, *_remarks(system, names, "i"))]
    written = list(names.values())
    ring, field = (_free_name(letter, written) for letter in "RK")
    texts = _texts(system, written, number_text, "^", "i")
    # A constant as an element of the ring.
    texts = [t if names_in(t) & {*written} else f"{t} + 0*{written[0]}" for t in texts]
    if system.imaginary:
        lines.append(f"{field} = toField(QQ[i]/(i^2+1))")
    lines.append(f"{ring} = {field if system.imaginary else 'QQ'}[{', '.join(written)}]")
    return "\n".join([*lines, "I = ideal(\n  " + ",\n  ".join(texts) + ")"]) + "\n"


def _free_name(name: str, taken: Sequence[str]) -> str:
    """The name, or a longer one that is not taken."""
    while name in taken:
        name = f"nag{name}"
    return name


def write_singular(system: PolynomialSystem, title: str) -> str:
    """A ring over QQ, or over QQ with the unit i, and an ideal in it, for Singular."""
    _only_rational(system, "Singular")
    names = _plain_names(_variables(system), r"[A-Za-z][A-Za-z0-9]*", reserved=words.SINGULAR)
    lines = [f"// {line}" for line in (title, *_remarks(system, names, "i"))]
    written = list(names.values())
    texts = _texts(system, written, number_text, "^", "i")
    ring, ideal = "nagring", "nagideal"
    field = "(0, i)" if system.imaginary else "0"
    lines.append(f"ring {ring} = {field}, ({', '.join(written)}), dp;")
    lines += ["minpoly = i^2 + 1;"] if system.imaginary else []
    return "\n".join([*lines, f"ideal {ideal} =\n  " + ",\n  ".join(texts) + ";"]) + "\n"


def write_sympy(system: PolynomialSystem, title: str) -> str:
    """Lines of Python: symbols, and a list of expressions of sympy's."""
    names = _plain_names(_variables(system), r"[A-Za-z][A-Za-z0-9_]*", _TAKEN | words.SYMPY)
    written = list(names.values())
    symbols = ", ".join(repr(n) for n in names)
    texts = _texts(system, written, lambda c: _NUMBER.sub(r"S(\g<0>)", number_text(c)), "**", "I")
    lines = [f"# {line}" for line in (title, *_remarks(system, names, "I"))]
    lines += ["from sympy import I, S, Symbol, cos, pi, sin, sqrt", ""]
    lines.append(f"{', '.join(written)}, = (Symbol(name) for name in ({symbols},))")
    return "\n".join([*lines, "equations = ["] + [f"    {t}," for t in texts] + ["]"]) + "\n"


def write_julia(system: PolynomialSystem, title: str) -> str:
    """Lines of Julia for HomotopyContinuation.jl."""
    names = _plain_names(_variables(system), r"[A-Za-z]\w*", _TAKEN | words.JULIA)
    written = list(names.values())
    made = _free_name("F", written)
    texts = _texts(system, written, _julia_number, "^", "im")
    lines = [f"# {line}" for line in (title, *_remarks(system, names, "im"))]
    lines += ["using HomotopyContinuation", f"@var {' '.join(written)}", f"{made} = System(["]
    return "\n".join([*lines, *(f"    {t}," for t in texts)]) + (
        f"\n], variables = [{', '.join(written)}])\n"
    )


def _julia_number(c: Number) -> str:
    """A number whose fractions of whole numbers are exact; no others are in Julia."""
    return _FRACTION.sub(r"\1//\2", number_text(c))


def write_latex(system: PolynomialSystem, title: str) -> str:
    """The equations in an ``align*`` of LaTeX."""
    variables = _variables(system)
    names = [_latex_name(name) for name in variables]
    lines = []
    for f in _polynomials(system):
        terms = [_latex_term(e, c, names) for e, c in _terms(f, len(names))]
        lines.append(f"  {_join_terms(terms)} &= 0")
    remarks = _remarks(system, {n: n for n in variables}, "i")
    head = "".join(f"% {line}\n" for line in (title, *remarks))
    return f"{head}\\begin{{align*}}\n" + " \\\\\n".join(lines) + "\n\\end{align*}\n"


def _latex_term(e: Sequence[int], parts: Mapping[int, Number], names: Sequence[str]) -> str:
    sign, size = _coefficient(parts, _latex_number, r" \mathrm{i}")
    powers = [n if k == 1 else f"{n}^{{{k}}}" for n, k in zip(names, e, strict=True) if k]
    body = [*([size] if size != "1" or not powers else []), *powers]
    return f" {sign} {' '.join(body)}"


def _latex_number(c: Number) -> str:
    sign, size = _sign_and_size(number_text(c))
    if match := re.fullmatch(r"([0-9]+)/([0-9]+)", size):
        size = rf"\tfrac{{{match[1]}}}{{{match[2]}}}"
    else:
        size = re.sub(r"sqrt\(([^()]*)\)", r"\\sqrt{\1}", size).replace("*", " ")
        size = re.sub(r"\b(pi|sin|cos)\b", r"\\\1", size)
    return f"-{size}" if sign == "-" else size


def _latex_name(name: str) -> str:
    match = re.fullmatch(r"([^\W\d_]+)_?[\[{]?([0-9A-Za-z,]*)[\]}]?('*)", name)
    if match is None:
        return rf"\mathit{{{name.replace('_', chr(92) + '_')}}}"
    base = "".join(rf"\{_LATIN[c]}" if c in _LATIN else c for c in match[1])
    base = base if len(match[1]) == 1 else rf"\mathit{{{base}}}"
    return base + (f"_{{{match[2]}}}" if match[2] else "") + match[3]


WRITERS: Mapping[str, Callable[[PolynomialSystem, str], str]] = {
    "bertini": write_bertini,
    "phc": write_phc,
    "m2": write_macaulay2,
    "singular": write_singular,
    "text": plain.write,
    "sympy": write_sympy,
    "hc": write_julia,
    "latex": write_latex,
}


def write_system(system: PolynomialSystem, format: str, title: str = "") -> str:
    """The system as the text of another program, one of `WRITERS`.

    Names that the program does not take are changed, which a comment tells, as it does what must
    not vanish at a solution: `nag.read` finds that there, the other program does not.

    Raises:
        NagError: if the format is unknown, or has no numbers that the system has.

    >>> import nag
    >>> print(write_system(nag.system(["x^2 - y/2"]), "singular", "a parabola"), end="")
    // a parabola
    ring nagring = 0, (x, y), dp;
    ideal nagideal =
      x^2 - 1/2*y;
    """
    if format not in WRITERS:
        raise NagError(f"format: {format!r} is unknown; write one of {', '.join(WRITERS)}")
    if not system.polynomials:
        raise NagError("there is no equation to write")
    return WRITERS[format](system, " ".join(title.split()) or "a polynomial system")
