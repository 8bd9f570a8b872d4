"""The grammar of expressions: what it reads, and what it refuses with one clear line."""

from __future__ import annotations

import random
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nag.algebra.bounded import MAX_DIGITS, MAX_WORK, Budget
from nag.algebra.expression import ExpressionError, parse_number, parse_polynomial
from nag.algebra.number import PI, square_root
from nag.algebra.polynomial import Polynomial

X, Y = Polynomial.variables(2)


def read(text: str, **parameters: object) -> Polynomial:
    return parse_polynomial(text, ("x", "y"), parameters)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", Fraction(1, 10)),
        (".5", Fraction(1, 2)),
        ("3.", 3),
        ("1.25e-2", Fraction(1, 80)),
        ("2E3", 2000),
        ("5/6", Fraction(5, 6)),
        ("1/2/3", Fraction(1, 6)),
        ("1/2*3", Fraction(3, 2)),
        ("1 - 2 - 3", -4),
        ("-2^2", -4),
        ("(-2)^2", 4),
        ("2^3^2", 512),
        ("2**-3", Fraction(1, 8)),
        ("--+-1", -1),
        ("2*-3", -6),
        ("0^0", 1),
        ("(-1)^1000000001", -1),
        ("sqrt(9/4)", Fraction(3, 2)),
        ("sqrt(2)*sqrt(8)", 4),
        ("1/sqrt(3)", square_root(3) / 3),
        ("sin(pi/6)", Fraction(1, 2)),
        ("cos(pi)", -1),
        ("2*sin(pi/4)", square_root(2)),
        (" ( 1 +\n\t2 ) ", 3),
    ],
)
def test_constants(text, value):
    assert parse_number(text) == value


@pytest.mark.parametrize(
    ("text", "polynomial"),
    [
        ("x", X),
        ("2*x*y - y^2/3", 2 * X * Y - Y**2 / 3),
        ("(x + y)^3", (X + Y) ** 3),
        ("-(x - 1)**2", -((X - 1) ** 2)),
        ("x = y", X - Y),
        ("x^2 + y^2 = 1/4", X**2 + Y**2 - Fraction(1, 4)),
        ("1 = 2", Polynomial.constant(2, -1)),
        ("x - x", Polynomial(2, {})),
        ("(x - x)*y^3", Polynomial(2, {})),
        ("(x - x)^0", Polynomial.constant(2, 1)),
        ("7", Polynomial.constant(2, 7)),
        ("sqrt(3)*x/sqrt(3)", X),
        ("x^(1 + 1)", X**2),
    ],
)
def test_polynomials(text, polynomial):
    assert read(text) == polynomial


def test_parameters_are_constants_of_either_kind():
    assert read("a*x + b", a=Fraction(2, 3), b=PI) == Fraction(2, 3) * X + PI
    assert parse_number("a^2", {"a": square_root(5)}) == 5


def test_a_name_may_look_like_a_function_or_an_exponent():
    names = ("sinus", "e5", "_c0")
    e5 = Polynomial.variable(3, 1)
    assert parse_polynomial("2*e5 - sinus*0 - _c0*0", names) == 2 * e5


@pytest.mark.parametrize(
    ("value", "number"),
    [
        (3, 3),
        (0.1, Fraction(1, 10)),
        (Decimal("0.10"), Fraction(1, 10)),
        (Decimal("-1e-3"), Fraction(-1, 1000)),
        (Fraction(2, 7), Fraction(2, 7)),
        (PI, PI),
    ],
)
def test_numbers_that_are_no_text_are_read_as_they_are_written(value, number):
    assert parse_number(value) == number


@pytest.mark.parametrize("value", [True, None, [1], {}, 1j, float("nan"), float("inf")])
def test_what_is_no_real_number_is_refused(value):
    with pytest.raises(ExpressionError, match=r"is no number; write|only real numbers are read"):
        parse_number(value)


REFUSED = [
    ("", "the expression is empty; write"),
    ("   ", "the expression is empty; write"),
    ("2x", "column 2: 'x' follows '2'; write '*'"),
    ("x y", "column 3: 'y' follows 'x'; write '*'"),
    ("2(x)", "column 2: '(' follows '2'; write '*'"),
    ("(x)(y)", "column 4: '(' follows ')'; write '*'"),
    ("(x)2", "column 4: '2' follows ')'; write '*'"),
    ("x(y)", "column 1: 'x' is not a function; write '*'"),
    ("(2 x)", "column 4: 'x' follows '2'; write '*'"),
    ("sin", "column 1: sin needs parentheses; write sin(...)"),
    ("tan(1)", "column 1: 'tan' is not a function; write sqrt, sin or cos"),
    (
        "sin(x)",
        "column 1: sin of a variable is no polynomial; take a cosine and a sine for variables, "
        "with the equation c^2 + s^2 = 1",
    ),
    ("sqrt(x)", "column 1: sqrt of a variable is no polynomial; for the root take a"),
    ("sqrt(-2)", "column 1: square root of a negative number ('-2')"),
    ("sqrt(1 - sqrt(2))", "column 1: square root of a negative number"),
    ("z", "column 1: unknown name 'z'; variables and parameters here: x, y"),
    ("x + lenght", "column 5: unknown name 'lenght' (did you mean 'length'?)"),
    ("x/y", "column 2: the divisor contains a variable"),
    ("x/0", "column 2: division by zero"),
    ("x/(sqrt(2)*sqrt(2) - 2)", "column 2: division by zero"),
    ("0^-1", "column 2: division by zero"),
    ("x^-1", "column 2: a variable has no negative power"),
    ("x^y", "column 2: the exponent is not a whole number"),
    ("x^(1/2)", "column 2: the exponent '1/2' is not whole; for the root take a variable w, with"),
    ("x^(2/3)", "variable w, with the equation w^3 = x"),
    ("2^(1/2)*x", "the exponent '1/2' is not whole; write sqrt(...)"),
    ("2^pi", "column 2: the exponent is not a whole number"),
    ("x^1000000000", "column 2: the exponent 1000000000 is too large"),
    ("x^10^9", "column 2: the exponent 1000000000 is too large"),
    ("2^10^900", "column 2: the exponent of more than 30 digits is too large"),
    ("10^-10^9", "column 3: the exponent -1000000000 is too large"),
    ("(((x+y)^50)^50)", "column 12: the exponent 50 is too large; degrees go up to"),
    ("(x^600)*(y^600)", "column 8: degree 1200 is too high"),
    ("(x + y + 1)^300", "operations to multiply everything out"),
    ("*".join(["(x + y + 1)"] * 900), "operations to multiply everything out"),
    ("(sqrt(2) + sqrt(3)*x)^300", "operations to multiply everything out"),
    ("1e400000", "has too many digits"),
    ("1e-999999999999", "has too many digits"),
    ("1" * 5000, "has too many digits"),
    ("10^1000*x", "a number of the order 1e1000 arises"),
    ("10^-400*x", "a number of the order 1e-400 arises"),
    ("(", "column 2: something is missing after '('"),
    ("(x", "column 1: '(' is never closed"),
    ("(x = y)", "column 1: '(' is never closed"),
    ("x)", "column 2: ')' without its '('"),
    ("()", "column 2: empty parentheses"),
    ("x +", "column 4: something is missing after '+'"),
    ("x * * y", "column 5: '*' is out of place"),
    ("x ^ ^ 2", "column 5: '^' is out of place"),
    ("x == y", "column 3: '==' has no meaning here; write a single '='"),
    ("x = y = 1", "column 7: '=' has no meaning here; leave out all but one"),
    ("= x", "column 1: '=' is out of place"),
    ("x, y", "column 2: ',' has no meaning here"),
    ("x²", "column 2: '²' has no meaning here; write ^2"),
    ("2·x", "column 2: '·' has no meaning here; write *"),
    ("x − 1", "column 3: '−' has no meaning here; write -"),  # noqa: RUF001
    ("x^2 = 1\ny - x", "column 9: 'y' begins another line; write one equation a text"),
    ("x\x00", "has no meaning here"),
    ("__import__('os')", 'column 12: "\'" has no meaning here'),
    ("x.__class__", "column 2: '.' has no meaning here"),
    ("(" * 60 + "x" + ")" * 60, "column 51: nested more than 50 deep"),
    ("^".join(["2"] * 60), "nested more than 50 deep"),
    ("x" + "+x" * 60000, "characters long; at most"),
]


@pytest.mark.parametrize(("text", "message"), REFUSED, ids=[t[:20] for t, _ in REFUSED])
def test_refusals_say_where_and_what(text, message):
    with pytest.raises(ExpressionError) as caught:
        read(text, length=Fraction(1))
    told = str(caught.value).replace("x, y, length", "x, y")
    assert message in told
    assert len(told) < 200 and told.isprintable()


def test_an_equation_is_no_number():
    with pytest.raises(ExpressionError, match="write the number alone"):
        parse_number("1 = 1")


def test_irrational_numbers_cannot_grow_without_bound():
    value = parse_number("sqrt(2) + pi")
    with pytest.raises(ExpressionError, match="irrational number of more than"):
        for _ in range(20):
            value = parse_number("a*a + sqrt(3)", {"a": value})


def test_the_longest_numbers_that_are_read_are_read():
    digits = MAX_DIGITS - 1
    assert parse_number("0." + "3" * 300) == Fraction(int("3" * 300), 10**300)
    with pytest.raises(ExpressionError, match="too many digits"):
        parse_number("1" * (digits + 10))


def test_a_budget_is_shared():
    budget = Budget()
    with pytest.raises(ExpressionError, match=f"more than {MAX_WORK}"):
        for _ in range(1000):
            parse_polynomial("(x + y + 1)^20", ("x", "y"), budget=budget)


@given(st.text(alphabet="xyz0123456789.e+-*/^()= sqrtpi", max_size=40))
def test_any_text_gives_a_polynomial_or_one_line(text):
    try:
        polynomial = parse_polynomial(text, ("x", "y"))
    except ExpressionError as error:
        assert str(error).isprintable()
        assert len(str(error)) < 300
    else:
        assert parse_polynomial(polynomial.text(("x", "y")), ("x", "y")) == polynomial


@given(st.integers(0, 10**6))
def test_random_expressions_have_the_value_that_fractions_give(seed):
    generator = random.Random(seed)
    text, value = _random_expression(generator, 4)
    point = (Fraction(2, 3), Fraction(-5, 4))
    assert read(text)(point) == value(*point)


def _random_expression(generator, depth):
    kind = generator.randrange(6 if depth else 2)
    if kind == 0:
        number = Fraction(generator.randrange(20), generator.randrange(1, 10))
        return f"({number})", lambda x, y: number
    if kind == 1:
        return ("x", lambda x, y: x) if generator.random() < 0.5 else ("y", lambda x, y: y)
    left, f = _random_expression(generator, depth - 1)
    if kind == 5:
        k = generator.randrange(3)
        return f"({left})^{k}", lambda x, y: f(x, y) ** k
    right, g = _random_expression(generator, depth - 1)
    if kind == 2:
        return f"{left} + {right}", lambda x, y: f(x, y) + g(x, y)
    if kind == 3:
        return f"{left} - ({right})", lambda x, y: f(x, y) - g(x, y)
    return f"({left})*({right})", lambda x, y: f(x, y) * g(x, y)
