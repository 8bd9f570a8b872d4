"""What a result says, and is proved to be false, leaves its certificate open."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.cli import main
from nag.decomposition import decompose
from nag.files.export import write_decomposition
from nag.solving.certificate import certify_solutions
from nag.solving.solve import solve
from nag.witness.certificate import certify_decomposition

x, y = Polynomial.variables(2)
LINE_AND_CIRCLE = PolynomialSystem(("x", "y"), (x**2 + y**2 - 2, x - y))


@pytest.mark.parametrize("nonzero", [(), (x + 2,)])
def test_a_solution_that_is_said_to_be_excluded_and_is_not_is_refuted(nonzero) -> None:
    result = solve(replace(LINE_AND_CIRCLE, nonzero=nonzero))
    first, second = result.solutions
    certificate = certify_solutions(
        replace(result, solutions=(first,), excluded=1, excluded_solutions=(second,))
    )
    assert certificate.contradicted == {"excluded": 1}
    assert not certificate.all_proved
    assert not certificate.complete


def test_a_zero_of_what_must_not_vanish_is_no_proved_solution() -> None:
    result = solve(LINE_AND_CIRCLE)
    certificate = certify_solutions(
        replace(result, system=replace(LINE_AND_CIRCLE, nonzero=(x - 1,)))
    )
    assert sorted(certificate.nonzero.tolist()) == [False, True]
    assert not certificate.all_proved
    assert certificate.complete


def test_a_component_that_is_said_to_be_multiple_and_is_not_is_refuted() -> None:
    answer = decompose(PolynomialSystem(("x", "y"), (x * y - 1,)))
    double = replace(answer.components[0], multiplicity=2)
    certificate = certify_decomposition(replace(answer, components=(double,)))
    assert certificate.multiple == (0,)
    assert not certificate.all_proved


@pytest.mark.parametrize(
    "equations", [((x**2 + y**2 - 1) * (x - 2 * y),), (x**2 - 2, y - x), (x**2 - 2, (y - x) ** 2)]
)
def test_a_component_listed_twice_is_found_out(equations) -> None:
    answer = decompose(PolynomialSystem(("x", "y"), equations))
    assert not certify_decomposition(answer).same
    parts = answer.components
    certificate = certify_decomposition(replace(answer, components=(*parts, parts[0])))
    assert (0, len(parts)) in (*certificate.same, *certificate.unknown)
    assert not certificate.all_proved


@pytest.mark.parametrize("row", [[[0, 0], [0, 0]], [[None, 0], [1, 0]]])
def test_a_slice_that_is_none_is_refused_in_one_line(row, tmp_path: Path, capsys) -> None:
    export = tmp_path / "export.json"
    write_decomposition(decompose(PolynomialSystem(("x", "y"), (x * y - 1,))), export)
    document = json.loads(export.read_text())
    document["components"][0]["slice"]["A"] = [row]
    export.write_text(json.dumps(document))
    assert main(["certify", str(export)]) == 2
    assert "components[0].slice" in capsys.readouterr().err
