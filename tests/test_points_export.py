"""Samples and singular points are read back equal from what is written of them."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import nag
from nag.cli import main
from nag.files.points_export import points_of, write_points
from nag.witness.sampling import Samples

COMPLEX = "x^2 + I*y - 1"
FOUND = {
    "samples": lambda: nag.sample("x^2 + y^2 - 1", count=3),
    "real samples": lambda: nag.sample("x^2 + y^2 - 1", count=3, real=True),
    "samples of complex equations": lambda: nag.sample(
        nag.problem(COMPLEX, imaginary="I"), count=2
    ),
    "a node": lambda: nag.singular("y^2 - x^2*(x + 1)"),
    "nothing singular": lambda: nag.singular("y^2 - x"),
    "a cone that is not rational": lambda: nag.singular("(x^2 - 2*y^2)*(x - 1)"),
    "singular points of complex equations": lambda: nag.singular(
        nag.problem("(x^2 + I*y)*(x - y)", imaginary="I")
    ),
    "a singular line": lambda: nag.singular("z*(x^2 - y^2*z)"),
    "singular parameters": lambda: nag.singular("x^2 + a*x + b", free="a, b"),
}


@pytest.fixture(scope="module", params=FOUND)
def found(request: pytest.FixtureRequest):
    return FOUND[request.param]()


def test_what_is_written_reads_back_equal(found, tmp_path: Path) -> None:
    file = tmp_path / "points.json"
    nag.write(found, file)
    assert nag.read(file) == found
    written = file.read_bytes()
    nag.write(nag.read(file), file)
    assert file.read_bytes() == written


numbers = st.complex_numbers(allow_nan=False, allow_infinity=False)


@given(
    points=arrays(complex, st.tuples(st.integers(0, 4), st.just(3)), elements=numbers),
    residual=st.floats(0, allow_nan=False, allow_infinity=False),
    doubt=st.text(max_size=9),
    unit=st.booleans(),
    real=st.booleans(),
    dimensions=st.lists(st.integers(-1, 3), min_size=4, max_size=4),
)
def test_samples_read_back_to_the_same_bits(
    tmp_path_factory: pytest.TempPathFactory,
    points: np.ndarray,
    residual: float,
    doubt: str,
    unit: bool,
    real: bool,
    dimensions: list[int],
) -> None:
    known = tuple(dimensions[: len(points)]) if real else ()
    names, last = (("x", "y"), "i") if unit else (("x", "y", "z"), "")
    samples = Samples(points, residual, 1e-16, doubt, names, real, known, last)
    file = tmp_path_factory.getbasetemp() / "samples.json"
    write_points(samples, file)
    again = nag.read(file)
    assert again == samples
    assert again.points.tobytes() == samples.points.tobytes()


@pytest.mark.parametrize(
    ("arguments", "asked"),
    [
        (["sample", "--count", "2"], lambda case: nag.sample(case, count=2)),
        (["sample", "--count", "2", "--real"], lambda case: nag.sample(case, count=2, real=True)),
        (["singular"], nag.singular),
        (["singular", "--free", "a"], lambda case: nag.singular(case, free="a")),
    ],
)
def test_the_command_writes_what_the_function_returns(
    arguments, asked, tmp_path: Path, capsys
) -> None:
    case, file = tmp_path / "case.toml", tmp_path / "out.json"
    case.write_text(
        'title = "t"\nkind = "system"\nvariables = ["x", "y"]\nparameters = { a = 0 }\n'
        'equations = ["y^2 - x^2*(x + 1) - a"]\n'
    )
    name, *options = arguments
    assert main([name, str(case), *options, "--json", str(file)]) == 0
    assert nag.read(file) == asked(case)
    assert json.loads(file.read_text())["case"]["title"] == "t"
    capsys.readouterr()
    assert main(["show", str(file)]) == 0
    assert "t (case.toml)" in capsys.readouterr().out


def test_a_file_of_points_is_shown(found, tmp_path: Path, capsys) -> None:
    file = tmp_path / "points.json"
    nag.write(found, file)
    assert main(["show", str(file)]) == 0
    assert str(found).splitlines()[0] in capsys.readouterr().out


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d: d["sets"][0]["local"]["point"].pop(), "sets[0].local.point: must be of length"),
        (
            lambda d: d["sets"][0]["tangent_cone"]["form_terms"][0][0].update(coefficient="1e9999"),
            "must be a rational number",
        ),
        (
            lambda d: d["sets"][0]["tangent_cone"]["form_terms"][0][0].update(exponents=[1]),
            "exponents: must be of length 2",
        ),
        (lambda d: d["sets"][0]["tangent_cone"].update(coordinates=["q"]), "'q' is not one of"),
        (lambda d: d.update(imaginary="q"), "'q' is not the last variable"),
        (lambda d: d.pop("paths"), "the key 'paths' is missing"),
    ],
)
def test_a_broken_file_is_refused_in_one_line(change, said: str, tmp_path: Path) -> None:
    file = tmp_path / "points.json"
    nag.write(FOUND["a node"](), file)
    document = json.loads(file.read_text())
    assert points_of(document).sets[0].cone.forms[0][2, 0] == Fraction(1)
    change(document)
    file.write_text(json.dumps(document))
    with pytest.raises(nag.InputError) as error:
        nag.read(file)
    assert said in str(error.value)
    assert "\n" not in str(error.value)
