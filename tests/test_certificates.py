"""Certificates hold what is true, and nothing is proved that is not."""

from __future__ import annotations

import json
import warnings
from dataclasses import replace
from fractions import Fraction
from math import isqrt
from pathlib import Path

import flint
import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from solved import components_of
from systems import system

import nag
from nag.algebra.polynomial import Polynomial
from nag.algebra.symmetry import SignedPermutation
from nag.algebra.system import PolynomialSystem
from nag.bench.atlas.stability import family_named
from nag.cli import main
from nag.decomposition.decompose import decompose
from nag.files.cases import read_case
from nag.files.export import write_decomposition
from nag.files.json_schema import schema
from nag.files.solutions_export import read_solutions, write_solutions
from nag.mechanism.model import model
from nag.numerics.ball_boxes import BallOperator, box_about
from nag.numerics.ball_polynomials import BallPolynomials
from nag.numerics.certified_points import Proof, certify_points, certify_regular_points
from nag.numerics.claims import Standing
from nag.numerics.discs import DiscPolynomials, Discs, product
from nag.numerics.krawczyk import (
    boxes_in_doubles,
    find_overlaps,
    prove_boxes,
    sharpen_boxes,
    tell_real_zeros,
)
from nag.numerics.point_claims import zero_digits
from nag.solving.certificate import certify_solutions
from nag.solving.solutions import SolveResult
from nag.solving.solve import solve
from nag.witness.certificate import certify_decomposition
from nag.witness.witness import Decomposition

CASES = Path(__file__).parents[1] / "cases"
x, y = Polynomial.variables(2)
NO_SLICE = np.zeros((0, 3), dtype=complex)

numbers = st.floats(-1e6, 1e6, allow_subnormal=False).filter(lambda v: v == 0 or abs(v) > 1e-6)
radii = st.floats(0, 1e3, allow_subnormal=False)
directions = st.sampled_from([(1, 0), (0, 1), (-1, 0), (0, -1), (Fraction(3, 5), Fraction(4, 5))])


def exactly(z: complex) -> tuple[Fraction, Fraction]:
    return Fraction(z.real), Fraction(z.imag)


def times(a, b):
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def within(z, disc: Discs) -> bool:
    """Whether an exact number lies in a disc of arrays of one element."""
    mid, rad = exactly(complex(disc.mid.item())), Fraction(disc.rad.item())
    return (z[0] - mid[0]) ** 2 + (z[1] - mid[1]) ** 2 <= rad**2


@given(numbers, numbers, radii, directions, numbers, numbers, radii, directions)
def test_the_disc_of_a_product_holds_the_exact_products(a, b, r, d, c, e, s, f) -> None:
    first, second = complex(a, b), complex(c, e)
    disc = product(
        Discs(np.array([first]), np.array([r])), Discs(np.array([second]), np.array([s]))
    )
    for p, q in ((0, 0), (1, 1), (1, -1)):
        left = tuple(u + p * Fraction(r) * v for u, v in zip(exactly(first), d, strict=True))
        right = tuple(u + q * Fraction(s) * v for u, v in zip(exactly(second), f, strict=True))
        assert within(times(left, right), disc)


@given(st.lists(numbers, min_size=4, max_size=4), radii, directions)
def test_the_disc_of_a_polynomial_holds_its_exact_values(parts, r, d) -> None:
    f = x**3 * y / 7 - 5 * x * y**2 + Fraction(1, 3)
    slope = f.derivative(0)
    point = np.array([[complex(*parts[:2]), complex(*parts[2:])]])
    system = DiscPolynomials.of([f], NO_SLICE)
    box = Discs(point, np.array([[r, r]]))
    values, jacobian = system(box), system.jacobian(box)
    shifted = [
        tuple(u + Fraction(r) * v for u, v in zip(exactly(complex(z)), d, strict=True))
        for z in point[0]
    ]
    for g, found in (
        (f, Discs(values.mid[0], values.rad[0])),
        (slope, Discs(jacobian.mid[0, 0, :1], jacobian.rad[0, 0, :1])),
    ):
        assert within(exact_value(g, shifted), found)


def exact_value(f: Polynomial, point) -> tuple[Fraction, Fraction]:
    total = (Fraction(0), Fraction(0))
    for e, c in f.terms.items():
        value = (c, Fraction(0))
        for z, k in zip(point, e, strict=True):
            for _ in range(k):
                value = times(value, z)
        total = (total[0] + value[0], total[1] + value[1])
    return total


def test_boxes_hold_the_rational_zeros_that_they_are_proved_for() -> None:
    zeros = [(Fraction(i, 3), Fraction(j, 7)) for i in (1, 2, 4) for j in (-1, 5)]
    f = (3 * x - 1) * (3 * x - 2) * (3 * x - 4)
    g = (7 * y + 1) * (7 * y - 5) + f
    points = np.array([[float(a), float(b)] for a, b in zeros], dtype=complex)
    found = boxes_in_doubles([f, g], NO_SLICE, points)
    assert found.proved.all()
    for k, zero in enumerate(zeros):
        inside = [
            abs(Fraction(c.real) - v) <= Fraction(r)
            for c, r, v in zip(found.centres[k], found.inner[k], zero, strict=True)
        ]
        assert all(inside)
        others = [z for z in zeros if z != zero]
        assert not any(
            all(
                abs(Fraction(c.real) - v) <= Fraction(r)
                for c, r, v in zip(found.centres[k], found.outer[k], z, strict=True)
            )
            for z in others
        )


@pytest.mark.parametrize("point", [(0.5, 0.5), (1 + 1e-3, 1), (np.nan, 1), (np.inf, 0), (0, 0)])
def test_no_box_is_proved_away_from_zeros(point: tuple[float, float]) -> None:
    equations = [x**2 + y**2 - 2, x - y]
    reach = np.array([1e-6])
    found = prove_boxes(equations, NO_SLICE, np.array([point], dtype=complex), reach)
    assert not found.proved.any()


def test_multiple_zeros_are_not_proved_simple() -> None:
    equations = [(x - y) ** 2, x + y - 2]
    found = prove_boxes(equations, NO_SLICE, np.ones((1, 2), dtype=complex), np.array([1e-6]))
    assert not found.proved.any()


def test_points_on_a_curve_are_seen_at_once_to_have_no_box(monkeypatch) -> None:
    images = []
    image = BallOperator.image
    monkeypatch.setattr(BallOperator, "image", lambda *given: images.append(given) or image(*given))
    # Each of the points is cut by two of three equations, and by none of these pairs regularly.
    curve = [f * (x**2 + y**2 - 2) for f in (x - y, x - 3, y + 5)]
    angles = np.arange(1, 17)
    points = 2**0.5 * np.stack([np.cos(angles), np.sin(angles)], axis=1).astype(complex)
    found = certify_regular_points(curve, NO_SLICE, points, np.full(16, 1e-15))
    assert not found.boxes.proved.any()
    # A test or two in each of three precisions.
    assert len(images) <= 2 * 3 * len(points)


def test_points_at_one_zero_are_seen_to_be_one() -> None:
    points = np.array([[1, 1], [1 + 1e-15, 1], [-1, -1]], dtype=complex)
    boxes = prove_boxes([x**2 + y**2 - 2, x - y], NO_SLICE, points, np.full(3, 1e-6))
    assert boxes.proved.all()
    assert find_overlaps(boxes) == ([(0, 1)], [])


def test_real_and_complex_zeros_are_told_apart() -> None:
    root = 2**0.5
    points = np.array([[root, 1], [root + 1e-17j, 1], [1e-9j, 0]], dtype=complex)
    equations = [(x**2 - 2) * (x**2 + Fraction(1, 10**18)), y - x**2 + 1]
    points[2, 1] = points[2, 0] ** 2 - 1
    boxes = prove_boxes(equations, NO_SLICE, points, np.full(3, 1e-6))
    system = PolynomialSystem(("x", "y"), tuple(equations))
    real, complex_ = tell_real_zeros(boxes, system)
    assert boxes.proved.all()
    assert real.tolist() == [True, True, False]
    assert complex_.tolist() == [False, False, True]


@given(st.integers(2, 10**6), st.integers(2, 10**6), st.integers(-40, 40))
def test_radii_by_sharp_residuals_hold_the_zero_and_no_more_than_its_distance(
    a: int, b: int, off: int
) -> None:
    # One coordinate is a square root, a few doubles off; the other is a fraction of it.
    equations = [x**2 - a, y * b - x]
    root = a**0.5 + off * np.spacing(a**0.5)
    points = np.array([[root, a**0.5 / b]], dtype=complex)
    boxes = prove_boxes(equations, NO_SLICE, points, np.array([1e-6]))
    sharp = sharpen_boxes(equations, NO_SLICE, boxes, np.array([0]))[0]
    exact = Fraction(isqrt(a * 10**80), 10**40)
    for value, point, radius in zip((exact, exact / b), points[0].real, sharp, strict=True):
        distance = abs(Fraction(float(point)) - value)
        assert distance - Fraction(1, 10**38) <= Fraction(float(radius))
        assert float(radius) <= 1.001 * float(distance) + 1e-26 * abs(point)
    assert (sharp <= boxes.inner[0]).all()


def test_errors_of_zeros_near_another_are_proved_as_sharply_as_those_of_others() -> None:
    # Residuals in doubles leave boxes of 1e-10 here, the image of which is 1e-14 wide.
    s = Fraction(1, 10**6)
    equations = [x**2 - 2 * x + 1 - s**2, y - x]
    points = np.full((1, 2), float(1 + s), dtype=complex)
    boxes = prove_boxes(equations, NO_SLICE, points, np.array([1e-6]))
    sharp = sharpen_boxes(equations, NO_SLICE, boxes, np.array([0]))[0]
    error = abs(Fraction(float(1 + s)) - 1 - s)
    assert boxes.inner.min() > 1e-11
    assert error <= Fraction(float(sharp[0])) and sharp.max() <= 1.001 * float(error) + 1e-26


@pytest.mark.parametrize("share", [1.05, 1.3, 2.5])
def test_a_box_that_is_hardly_mapped_into_itself_tells_its_zero_to_all_digits(share) -> None:
    # Of sides 2^-16 slopes are 1 / share.
    s = Fraction(share) / 2**16
    box = box_about(
        BallPolynomials.of([x**2 - s**2, y - 1], NO_SLICE), [flint.acb(float(s)), flint.acb(1)]
    )
    assert box is not None
    assert max(map(float, box.inner)) < 1e-30


def test_zeros_nearer_than_doubles_see_are_not_proved_from_doubles() -> None:
    # Both zeros have the same nearest doubles; a box about these would hold two.
    equations = [(x - 1) ** 2 - Fraction(1, 10**40), y - x]
    points = np.ones((2, 2), dtype=complex)
    assert not prove_boxes(equations, NO_SLICE, points, np.full(2, 1e-9)).proved.any()


def test_each_zero_of_more_equations_is_proved_by_those_that_are_independent_there() -> None:
    # At one zero the first equation is singular, at the other the second.
    equations = [(x - 1) ** 2 * (x - 3), (x - 3) ** 2 * (x - 1), y - 2]
    points = np.array([[1, 2], [3, 2]], dtype=complex)
    found = certify_points(equations, NO_SLICE, points, np.full(2, 1e-16), np.zeros(2, dtype=bool))
    assert found.proofs == (Proof.SIMPLE, Proof.SIMPLE)
    assert np.isinf(found.digits).all()


def test_what_more_equations_do_at_irrational_zeros_is_evidence() -> None:
    equations = [x**2 - 2, y**2 - 3, x**2 + y**2 - 5]
    points = np.sqrt([[2.0, 3.0]]).astype(complex)
    found = certify_points(equations, NO_SLICE, points, np.full(1, 1e-16), np.zeros(1, dtype=bool))
    assert found.proofs == (Proof.PART,)
    assert 140 < found.digits[0] < 160


@pytest.mark.parametrize("power", [2, 3, 4])
def test_zeros_that_are_deflated_several_times_are_proved_real_where_they_are(power: int) -> None:
    for square, real in ((2, True), (-2, False)):
        equations = (x**2 - square, (x - y) ** power)
        certificate = certify_solutions(solve(PolynomialSystem(("x", "y"), equations)))
        assert certificate.points.proofs == (Proof.DEFLATED,) * 2
        assert certificate.real.tolist() == [real] * 2
        assert certificate.not_real.tolist() == [not real] * 2


def test_multiple_zeros_are_proved_real_where_they_are() -> None:
    equations = [(x - y) ** 2 + (x**2 + y**2 - 4) * x, x**2 + y**2 - 4]
    certificate = certify_solutions(solve(PolynomialSystem(("x", "y"), equations)))
    assert set(certificate.points.proofs) == {Proof.DEFLATED}
    assert certificate.real.tolist() == [True, True]
    imaginary = [(x - 2 * y) ** 2, x**2 + y**2 + 4]
    certificate = certify_solutions(solve(PolynomialSystem(("x", "y"), imaginary)))
    assert certificate.real.tolist() == [False, False]
    assert certificate.not_real.tolist() == [True, True]


def test_a_zero_of_some_equations_only_is_refuted() -> None:
    equations = [x**2 - 1, y**2 - 1, x + y - 2 + (x - 1) * Fraction(1, 10**9)]
    points = np.array([[1, 1], [-1, 1]], dtype=complex)
    found = certify_points(equations, NO_SLICE, points, np.full(2, 1e-16), np.zeros(2, dtype=bool))
    assert found.proofs == (Proof.SIMPLE, Proof.NONE)
    assert found.refuted == (1,)


@pytest.mark.parametrize(
    ("equations", "proof"),
    [
        ([(x - y) ** 3, x**2 + y**2 - 2], Proof.EXACT),
        ([(x - y) ** 3, x**2 + y**2 - 3], Proof.DEFLATED),
        ([x**2 - 2, y**2 - x * y + Fraction(1, 2)], Proof.DEFLATED),
    ],
)
def test_multiple_solutions_are_proved_by_exact_values_or_deflation(
    equations: list[Polynomial], proof: Proof
) -> None:
    result = solve(PolynomialSystem(("x", "y"), equations))
    certificate = certify_solutions(result)
    multiple = [p for p, s in zip(certificate.points.proofs, result.solutions, strict=True)
                if s.multiplicity > 1]  # fmt: skip
    assert multiple
    assert set(multiple) == {proof}
    # Deflated equations are more than unknowns: what the others do is evidence.
    assert certificate.all_proved == (proof is Proof.EXACT)
    assert Proof.NONE not in certificate.points.proofs and not certificate.doubted
    assert not certificate.complete


def test_all_solutions_of_katsura_are_certified_and_there_are_no_others() -> None:
    system = read_case(CASES / "benchmarks" / "katsura-6.toml").system
    certificate = certify_solutions(solve(system))
    assert certificate.simple == certificate.bound == 64
    assert not certificate.points.boxes.fine
    assert certificate.complete
    assert (certificate.real | certificate.not_real).all()


def test_a_solution_listed_twice_is_found_out() -> None:
    result = solve(PolynomialSystem(("x", "y"), (x**2 + y**2 - 2, x - y)), start="total")
    twice = replace(result, solutions=(*result.solutions, result.solutions[0]))
    certificate = certify_solutions(twice)
    assert certificate.same == ((0, 2),)
    assert certificate.simple == 2
    assert not certificate.all_proved
    # All zeros are listed, one of them twice.
    assert certificate.complete


def test_degrees_of_components_are_bounded_from_below_by_proved_points() -> None:
    system = PolynomialSystem(("x", "y"), ((x**2 + y**2 - 1) * (x - 2 * y),))
    certificate = certify_decomposition(decompose(system))
    assert certificate.bounds == {1: 3}
    assert certificate.complete
    assert certificate.all_proved


def test_degrees_are_bounded_by_all_components_of_an_orbit() -> None:
    x, y, z = Polynomial.variables(3)
    system = PolynomialSystem(("x", "y", "z"), (z**2 - 2, x**2 + y**2 - 1))
    mirror = SignedPermutation((0, 1, 2), (1, 1, -1))
    answer = decompose(system, symmetries=(mirror,))
    assert [(c.degree, c.orbit) for c in answer.components] == [(2, 2)]
    certificate = certify_decomposition(answer)
    assert certificate.bounds == {1: 4}
    assert certificate.complete


def test_zeros_that_were_left_out_count_for_completeness(tmp_path: Path) -> None:
    system = model(read_case(CASES / "benchmarks" / "inverse-6r.toml").mechanism).system
    result = solve(system)
    write_solutions(result, tmp_path / "solved.json")
    certificate = certify_solutions(read_solutions(tmp_path / "solved.json").result)
    assert (certificate.simple, certificate.zeros, certificate.bound) == (16, 24, 24)
    assert certificate.complete
    digits = zero_digits(system.nonzero, system.polynomials, certificate.excluded)
    assert digits.min() > 140
    without = certify_solutions(replace(result, excluded_solutions=()))
    assert not without.complete


def test_more_digits_than_doubles_prove_that_nothing_vanishes_that_must_not() -> None:
    result = solve(system("x y", "x^2 - 2", "y - x", nonzero=("y^2 - 2 - 1/10^20",)))
    assert len(result.solutions) == 2
    certificate = certify_solutions(result)
    assert certificate.nonzero.all() and certificate.all_proved


def test_points_of_a_double_curve_bound_no_degree() -> None:
    certificate = certify_decomposition(components_of(read_case(CASES / "gonzalez.toml").system))
    proofs = [p for c in certificate.components for p in c.points.proofs]
    assert proofs.count(Proof.SIMPLE) == 8
    assert proofs.count(Proof.DEFLATED) == 4
    assert certificate.bounds == {1: 8}


def test_the_command_certifies_exports_of_both_kinds(tmp_path: Path, capsys) -> None:
    system = PolynomialSystem(("x", "y"), (x**2 + y**2 - 2, x * y - 1))
    solved, decomposed = tmp_path / "solved.json", tmp_path / "decomposed.json"
    write_solutions(solve(system), solved)
    write_decomposition(decompose(PolynomialSystem(("x", "y"), (x * y - 1,))), decomposed)
    for export, line in (
        (solved, "2 of 2 solutions"),
        (decomposed, "2 of 2 witness points"),
    ):
        target = tmp_path / f"certificate-{export.name}"
        assert main(["certify", str(export), "--json", str(target)]) == 0
        assert line in capsys.readouterr().out
        jsonschema.validate(json.loads(target.read_text()), schema("nag-certificate"))
    jsonschema.Draft202012Validator.check_schema(schema("nag-certificate"))


def test_a_point_that_is_no_solution_makes_the_certificate_incomplete(tmp_path, capsys) -> None:
    export = tmp_path / "solved.json"
    result = solve(PolynomialSystem(("x", "y"), (x**2 + y**2 - 3, x * y - 1)))
    moved = replace(result.solutions[0], point=result.solutions[0].point + 0.01)
    write_solutions(replace(result, solutions=(moved, *result.solutions[1:])), export)
    assert main(["certify", str(export)]) == 1
    assert "1 not proved" in capsys.readouterr().out


def test_a_point_of_any_size_is_told_in_the_certificate_alone(tmp_path, capsys) -> None:
    export = tmp_path / "solved.json"
    result = solve(PolynomialSystem(("x", "y"), (x**2 + y**2 - 3, x * y - 1)))
    far = changed(result, 0, point=np.full(2, 1e308 - 1e308j))
    write_solutions(far, export)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert main(["certify", str(export)]) == 1
    assert "1 not proved" in capsys.readouterr().out


def test_what_is_left_over_of_deflated_equations_is_said_to_be_evidence() -> None:
    certificate = certify_solutions(solve(system("x y", "(x^2 - 2)^2 + y", "y")))
    assert set(certificate.points.proofs) == {Proof.DEFLATED}
    lines = [text for _, text in certificate.rows(0.0)]
    assert any(line.endswith("digits, which is evidence and no proof") for line in lines)


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"format": "nag-solutions"}'])
def test_what_is_no_export_is_one_line(tmp_path: Path, capsys, content: str) -> None:
    export = tmp_path / "export.json"
    export.write_text(content)
    assert main(["certify", str(export)]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


@pytest.mark.parametrize("command", ["solve", "decompose"])
def test_answers_are_certified_on_request(command: str, capsys) -> None:
    case = CASES / ("benchmarks/katsura-6.toml" if command == "solve" else "slider-crank.toml")
    assert main([command, str(case), "--certify", "--quiet"]) == 0
    assert "\ncertified" in capsys.readouterr().out


def test_combinations_of_lower_degrees_bound_the_number_of_zeros() -> None:
    x, y = Polynomial.variables(2)
    system = PolynomialSystem(("x", "y"), (x**2 + y**2 - 2 * x - 3, x**2 + y**2 - y - 5))
    certificate = certify_solutions(solve(system))
    assert certificate.bound == 2
    assert certificate.complete


@pytest.mark.parametrize("shift", range(12))
def test_double_irrational_zeros_are_proved_whatever_the_random_conditions(shift: int) -> None:
    result = solve(system("x y", f"(x^2 - 2)^2*(x - {7 + shift}) + y", "y"))
    found = certify_solutions(result)
    assert found.points.proofs.count(Proof.DEFLATED) == found.points.on_evidence.sum() == 2
    assert Proof.NONE not in found.points.proofs and not found.contradicted


def changed(result: SolveResult, i: int, **fields: object) -> SolveResult:
    solutions = list(result.solutions)
    solutions[i] = replace(solutions[i], **fields)
    return replace(result, solutions=tuple(solutions))


@pytest.mark.parametrize("multiplicity", [2, 3])
@pytest.mark.parametrize(
    "equations",
    [
        ["x^2 + y^2 - 5", "x*y - 2"],
        ["x^3 - 2*y^2 + 1", "y^3 + x*y - 3"],
        ["x^2 - 2", "y^2 - x - 5", "x*y^2 - 5*x - 2"],
    ],
)
def test_a_simple_zero_that_is_said_to_be_multiple_is_never_proved_singular(
    equations: list[str], multiplicity: int
) -> None:
    result = solve(system("x y", *equations))
    for i in range(len(result.solutions)):
        found = certify_solutions(changed(result, i, multiplicity=multiplicity))
        assert not set(found.points.proofs) & {Proof.EXACT, Proof.DEFLATED}
        assert found.points.proofs[i] in (Proof.SIMPLE, Proof.PART)
        assert found.simple == certify_solutions(result).simple
        assert not found.all_proved or Proof.PART in found.points.proofs


@pytest.mark.parametrize("equation", ["(x - 1)^2*(x + 2)", "(x^2 - 2)^2*(x - 7)"])
def test_a_multiple_zero_that_is_said_to_be_simple_is_refuted_or_doubted(equation: str) -> None:
    result = solve(system("x y", equation + " + y", "y"))
    i = next(i for i, s in enumerate(result.solutions) if s.multiplicity == 2)
    assert not certify_solutions(result).contradicted | certify_solutions(result).doubted
    found = certify_solutions(changed(result, i, multiplicity=1))
    assert found.contradicted | found.doubted == {"simple": 1} and not found.all_proved
    assert bool(found.contradicted) == (found.points.proofs[i] is Proof.EXACT)
    assert found.points.proofs[i] in (Proof.EXACT, Proof.DEFLATED)


def test_what_is_said_of_reality_is_proved_or_refuted() -> None:
    # Zeros x = 1 +- 1e-9 i, and y real or not.
    result = solve(system("x y", "(x - 1)^2 + 1/10^18", "y^2 - x - 3"), start="total")
    assert certify_solutions(result).all_proved
    found = certify_solutions(changed(result, 0, real=True))
    assert found.contradicted == {"real": 1} and not found.all_proved
    result = solve(system("x y", "x^2 + y^2 - 5", "x*y - 2"))
    assert certify_solutions(changed(result, 1, real=False)).contradicted == {"not real": 1}


@pytest.mark.parametrize("digits", [6, 9, 11, 13, 20, 26])
@pytest.mark.parametrize("start", ["auto", "total"])
def test_zeros_next_to_the_real_ones_are_not_called_real(digits: int, start: str) -> None:
    near = system("x y z", "x*y - 1 + z", f"(x - 1)^2 + 1/10^{digits}", "z^3 + y*x*z - 5*z")
    result = solve(near, start=start)
    assert len(result.solutions) == 6 and not any(s.real for s in result.solutions)
    assert not certify_solutions(result).contradicted


def test_zeros_nearer_than_evidence_reaches_are_not_proved_to_be_one() -> None:
    # Simple zeros at a distance of 1e-35, and 1e-70.
    for digits in (70, 140):
        near = system("x y", f"(x^2 - 2)^2 - 1/10^{digits} + y", "y")
        result = solve(system("x y", "(x^2 - 2)^2 + y", "y"))
        found = certify_solutions(replace(result, system=near))
        assert not set(found.points.proofs) & {Proof.EXACT, Proof.DEFLATED, Proof.SIMPLE}


@pytest.mark.parametrize("digits", [16, 30])
@pytest.mark.parametrize("name", ["cluster-2", "far-cluster", "triple"])
def test_zeros_that_doubles_do_not_tell_apart_are_all_proved(name: str, digits: int) -> None:
    problem = family_named(name).make(digits, np.random.default_rng([1, 20]))
    result = solve(problem.system)
    certificate = certify_solutions(result)
    assert result.complete
    assert certificate.simple == len(result.solutions) == problem.truth[0, 1, 1]
    assert certificate.all_proved and certificate.complete


def test_of_zeros_close_together_as_many_are_real_as_are_proved_to_be() -> None:
    near = system("x y", "(x - 1)^4 - 1/10^80", "y - x*(1 + (x - 1))")
    result = solve(near)
    assert sorted(s.real for s in result.solutions) == [False, False, True, True]
    certificate = certify_solutions(result)
    assert certificate.all_proved
    assert certificate.real.tolist() == [s.real for s in result.solutions]
    i = next(i for i, s in enumerate(result.solutions) if not s.real)
    found = certify_solutions(changed(result, i, real=True))
    assert found.contradicted == {"real": 1} and not found.all_proved


def test_a_zero_listed_twice_beside_one_that_is_close_is_not_proved_to_be_two() -> None:
    result = solve(system("x y", "(x - 1)^2 - 2/10^40", "y - x"))
    twice = replace(result, solutions=(*result.solutions, result.solutions[0]))
    assert certify_solutions(result).all_proved
    assert not certify_solutions(twice).all_proved


def test_nothing_is_called_proved_that_rests_on_evidence(tmp_path: Path, capsys) -> None:
    # Two zeros that are not real, 1e-200 from what passes for a double one.
    result = solve(system("x y", "(x - sqrt(2))^2 + 1/10^400", "y - x"))
    certificate = certify_solutions(result)
    assert certificate.points.on_evidence.all() and not certificate.all_proved
    export, target = tmp_path / "solutions.json", tmp_path / "certificate.json"
    write_solutions(result, export)
    assert main(["certify", str(export), "--json", str(target)]) == 1
    text = capsys.readouterr().out
    assert "0 of 1 solutions; 1 on evidence" in text
    assert "0 proved real, 0 proved not real" in text
    document = json.loads(target.read_text())
    jsonschema.validate(document, schema("nag-certificate"))
    assert document["all_proved"] is False and document["real"] == [None]
    assert document["points"][0]["evidence"] is True
    # Simple and not real, as it is: evidence refutes nothing.
    true = certify_solutions(changed(result, 0, multiplicity=1, real=False))
    assert not true.contradicted


def test_middles_at_points_are_those_of_discs_of_no_size() -> None:
    made = system("x y z", "x^2*y - 3*x*z^3 + 1/3", "y*z - 2", "5")
    polynomials = DiscPolynomials.of(made.polynomials, np.array([[1, 2, 0, 1j]]))
    x = np.random.default_rng(0).standard_normal((5, 3)) + 1j
    values, slopes = polynomials.middles(x)
    exact = Discs(x, np.zeros(x.shape))
    assert np.array_equal(values, polynomials(exact).mid)
    assert np.array_equal(slopes, polynomials.jacobian(exact).mid)


MISSING = {
    "complex surface": ("x y z", ["(x - I*y)*(x^2 + y - z - 2)", "(x - I*y)*(z - I)"], (2, 1)),
    "complex curve of two": ("x y", ["(x - I*y)*(x*y - 1)"], (1, 1)),
    "complex line of four": ("x y z", ["x*z - I*y^2", "y*z - x^2*(1 + I)"], (1, 1)),
    "complex point of four": ("x y", ["x^2 - I*y^2 + 1", "x*y - I"], (0, 1)),
    "the only curve": ("x y z", ["x*y - z", "x*z - 1"], (1, 3)),
    "double line": ("x y z", ["(x - y)^2*(x*z - 1)", "(x - y)^2*z"], (2, 1)),
}


AGAINST = (Standing.REFUTED, Standing.DOUBTED)


def standing_of_completeness(found: Decomposition) -> Standing:
    (said,) = (c for c in certify_decomposition(found).claims if c.field == "complete")
    assert said.text.startswith("that there are no more components")
    return said.standing


@pytest.mark.parametrize("kind", MISSING)
def test_a_missing_component_of_the_largest_dimension_is_seen(kind: str) -> None:
    variables, equations, shape = MISSING[kind]
    whole = decompose(nag.system(equations, variables))
    assert standing_of_completeness(whole) not in AGAINST
    left_out = next(c for c in whole if (c.dimension, c.degree) == shape)
    others = tuple(c for c in whole if c is not left_out)
    assert standing_of_completeness(replace(whole, components=others)) in AGAINST


def test_where_it_was_not_looked_at_whether_components_are_missing_it_says_so() -> None:
    whole = decompose(nag.system(["(x^2 + I*y)*(x - 1)", "(x^2 + I*y)*(y - 2*I)"], "x y"))
    curve = replace(whole, components=whole.components[:1])
    row = ("complete", "not looked at here: there may be more components than these")
    assert row in certify_decomposition(curve).rows(1.0)


def test_degrees_of_complex_equations_bound_those_of_components() -> None:
    whole = decompose(nag.system(["x*z - I*y^2", "y*z - x^2*(1 + I)"], "x y z"))
    certificate = certify_decomposition(whole)
    assert certificate.most == 4 and certificate.complete


def holds_field(document: object, path: list[str]) -> bool:
    """Whether a field, as ``components[].degree``, is in a document."""
    if not path:
        return True
    key, listed = path[0].removesuffix("[]"), path[0].endswith("[]")
    if not isinstance(document, dict) or key not in document:
        return False
    parts = document[key] if listed else [document[key]]
    return any(holds_field(part, path[1:]) for part in parts)


def test_statements_name_fields_that_the_export_has(tmp_path: Path) -> None:
    for found in (
        nag.decompose("(x^2 + y^2 - 1)*(x - y)*z^2"),
        nag.decompose(["x*y", "x*z", "x^2 - x"]),
        nag.solve(["x^2 - 1", "y - x"]),
    ):
        nag.write(found, tmp_path / "found.json")
        document = json.loads((tmp_path / "found.json").read_text())
        for paths in (False, True):
            fields = {claim.field for claim in nag.certify(found, paths=paths).claims}
            assert len(fields) > 10
            assert not [f for f in fields if not holds_field(document, f.split("."))]
