"""What a result says, and is proved to be false, leaves its certificate open."""

from __future__ import annotations

import copy
import json
import re
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.cli import main
from nag.decomposition.decompose import decompose
from nag.files.export import write_decomposition
from nag.files.json_schema import schema
from nag.numerics.claims import Standing, claims_rows
from nag.solving.certificate import certify_solutions
from nag.solving.solve import solve
from nag.witness.certificate import DecompositionCertificate, certify_decomposition
from nag.witness.certified_loops import prove_all
from nag.witness.witness import Slice

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


@pytest.mark.parametrize(
    ("equations", "nonzero", "surfaces"),
    [
        ((x**2 - 2 * y**2,), (), 2),
        (((x - y) ** 2 * (x * y - 1),), (x - y,), 2),
        (((x - 1) * (y - 2), (x - 1) * (x**2 + y)), (), 1),
    ],
)
def test_a_list_without_a_common_factor_of_the_equations_is_not_complete(
    equations, nonzero, surfaces
) -> None:
    answer = decompose(PolynomialSystem(("x", "y"), equations, nonzero))
    certificate = certify_decomposition(answer)
    assert answer.complete and certificate.surfaces == surfaces
    assert completeness(certificate) in (Standing.PROVED, Standing.UNSEEN)
    rest = tuple(c for c in answer.components if not c.dimension)
    fewer = certify_decomposition(replace(answer, components=rest))
    assert completeness(fewer) is Standing.REFUTED and not fewer.all_proved


def completeness(certificate: DecompositionCertificate) -> Standing:
    (found,) = (claim.standing for claim in certificate.claims if claim.field == "complete")
    return found


@pytest.mark.parametrize("row", [[[0, 0], [0, 0]], [[None, 0], [1, 0]]])
def test_a_slice_that_is_none_is_refused_in_one_line(row, tmp_path: Path, capsys) -> None:
    file = tmp_path / "export.json"
    write_decomposition(decompose(PolynomialSystem(("x", "y"), (x * y - 1,))), file)
    document = json.loads(file.read_text())
    document["components"][0]["slice"]["A"] = [row]
    file.write_text(json.dumps(document))
    assert main(["certify", str(file)]) == 2
    assert "components[0].slice" in capsys.readouterr().err


def tampered(document: dict, tmp_path: Path, *options: str) -> tuple[int, dict[str, set[str]]]:
    """Exit status of ``nag certify`` of an export, and the standings of statements by field."""
    file, target = tmp_path / "export.json", tmp_path / "certificate.json"
    file.write_text(json.dumps(document))
    status = main(["certify", str(file), "--json", str(target), *options])
    certificate = json.loads(target.read_text())
    jsonschema.validate(certificate, schema("nag-certificate"))
    standings: dict[str, set[str]] = {}
    for statement in certificate["statements"]:
        standings.setdefault(statement["field"], set()).add(statement["standing"])
    return status, standings


def test_a_component_that_is_excluded_is_refuted_and_not_counted() -> None:
    system = PolynomialSystem(("x", "y"), ((x**2 + y**2 - 1) * (x - 2 * y),))
    answer = decompose(system)
    assert certify_decomposition(answer).bounds == {1: 3}
    certificate = certify_decomposition(
        replace(answer, system=replace(system, nonzero=(x - 2 * y,)))
    )
    assert certificate.bounds == {1: 2}
    (refuted,) = [c for c in certificate.claims if c.standing is Standing.REFUTED]
    assert refuted.subject == "component 1" and refuted.field == "system.nonzero"
    assert refuted.text == "that nothing that must not vanish does so on it: point 1"
    assert not certificate.all_proved


def test_a_point_that_is_no_zero_is_not_proved_to_lie_on_a_component() -> None:
    answer = decompose(PolynomialSystem(("x", "y"), (x - 2 * y,)))
    assert prove_all(answer)[0].connected
    line = answer.components[0]
    off = replace(answer, components=(replace(line, points=line.points + 0.5, fibres=()),))
    assert not prove_all(off)[0].connected


@pytest.mark.parametrize("equation", [x * y - 1, (x - 2 * y) ** 2])
def test_a_component_listed_twice_on_a_rescaled_slice_is_found_out(equation) -> None:
    answer = decompose(PolynomialSystem(("x", "y"), (equation,)))
    (curve,) = answer.components
    scaled = replace(curve, slice=Slice(3j * curve.slice.A, 3j * curve.slice.b), fibres=())
    certificate = certify_decomposition(replace(answer, components=(curve, scaled)))
    assert (0, 1) in (*certificate.same, *certificate.unknown)
    assert not certificate.all_proved


def test_components_are_told_apart_on_slices_that_are_not_generic_for_each_other() -> None:
    # x = 0 and y = 0, each on a slice through points of the other at infinity.
    answer = decompose(PolynomialSystem(("x", "y"), (x * y,)))
    assert certify_decomposition(answer).all_proved
    assert certify_decomposition(answer).bounds == {1: 2}


@pytest.mark.parametrize("multiplicity, standing", [(1, Standing.REFUTED), (3, Standing.DOUBTED)])
def test_a_wrong_multiplicity_of_an_isolated_point_is_refuted(multiplicity, standing) -> None:
    answer = decompose(PolynomialSystem(("x", "y"), (x**2 + y**2 - 2, x * y - 1)))
    first, second = answer.components
    wrong = replace(answer, components=(replace(first, multiplicity=multiplicity), second))
    first_said = [c for c in certify_decomposition(wrong).claims if c.subject == "component 1"]
    said = {c.field: c.standing for c in first_said}
    assert said["components[].multiplicity"] is standing
    said = {c.field: c.standing for c in certify_decomposition(answer).claims if c.subject}
    assert said["components[].multiplicity"] is Standing.EVIDENCE


@pytest.mark.parametrize("options", [(), ("--paths",)])
def test_a_list_of_five_of_nine_solutions_is_not_complete(options, tmp_path: Path) -> None:
    result = solve(PolynomialSystem(("x", "y"), (x**3 - 2 * y**2 + 1, y**3 + x * y - 3)))
    whole = result.document()
    status, standings = tampered(whole, tmp_path, *options)
    assert (status, standings["complete"]) == (0, {"proved"})
    status, standings = tampered(whole | {"solutions": whole["solutions"][:5]}, tmp_path, *options)
    assert (status, standings["complete"]) == (1, {"refuted" if options else "refuted by evidence"})


def test_a_component_without_one_of_its_points_has_no_linear_trace(tmp_path: Path) -> None:
    answer = decompose(PolynomialSystem(("x", "y"), (x**3 + y**2 - 3,)))
    (curve,) = answer.components
    cut = replace(
        curve,
        points=curve.points[:2],
        radii=curve.radii[:2],
        digits=curve.digits[:2],
        fibres=(),
    )
    whole, less = (replace(answer, components=(c,)).document() for c in (curve, cut))
    status, standings = tampered(whole, tmp_path, "--paths")
    assert (status, standings["components[].degree"]) == (0, {"on evidence"})
    status, standings = tampered(less, tmp_path, "--paths")
    assert (status, standings["components[].degree"]) == (1, {"refuted by evidence"})


def test_two_components_as_one_and_points_that_are_two_are_refuted() -> None:
    answer = decompose(PolynomialSystem(("x", "y"), (x**2 - 2, y - x)))
    one, other = answer.components
    both = replace(
        one,
        points=[*one.points, *other.points],
        radii=[*one.radii, *other.radii],
        digits=[16, 16],
        fibres=(),
    )
    said = {c.field: c for c in certify_decomposition(replace(answer, components=(both,))).claims}
    assert said["components[].status"].standing is Standing.REFUTED


@pytest.mark.parametrize("edit", ["accuracy", "precision", "exact", "more"])
def test_what_the_rest_of_a_file_contradicts_and_what_is_not_read_is_named(edit, tmp_path) -> None:
    document = decompose(PolynomialSystem(("x", "y"), (x * y - 1,))).document()
    inside = {"exact": document["system"], "more": document}.get(edit, document["components"][0])
    inside[edit] = {"accuracy": 1e-20, "precision": "99 digits", "exact": False, "more": 1}[edit]
    status, standings = tampered(document, tmp_path)
    own = next(found for field, found in standings.items() if field.endswith(edit) and found)
    assert own & {"refuted", "not looked at"}
    assert status == (edit != "more")


def fields_of(value: object, place: str = "") -> set[str]:
    if isinstance(value, list):
        return {place}.union(*(fields_of(v, f"{place}[]") for v in value if isinstance(v, dict)))
    if not isinstance(value, dict) or place == "components[].orbit":
        return {place}
    return set().union(*(fields_of(v, f"{place}.{k}".lstrip(".")) for k, v in value.items()))


def test_there_is_a_statement_about_every_field_of_an_export(tmp_path: Path) -> None:
    system = PolynomialSystem(("x", "y"), ((x**2 - 2) * y, (x - y) * y), (), [[0], [1]])
    result = solve(replace(LINE_AND_CIRCLE, nonzero=(x + 1,)))
    for written in (decompose(system).document(), result.document()):
        _, standings = tampered(written, tmp_path)
        for field in fields_of(written) - {"format", "version", "components", "solutions"}:
            whole = field.replace("[]", "").split(".")
            # What nobody looks at may be named as a whole, components and solutions may not.
            least = 2 if whole[0] in ("components", "solutions") else 1
            said = [name.replace("[]", "").split(".") for name in standings]
            assert any(whole[: len(f)] == f and len(f) >= least for f in said), field


def certified_lines(document: dict, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> str:
    """What ``nag certify`` prints of an export, each labelled text in one line."""
    file = tmp_path / "export.json"
    file.write_text(json.dumps(document))
    main(["certify", str(file)])
    return re.sub(r"\n {8,}", " ", capsys.readouterr().out)


def test_a_refutation_names_the_entry_the_field_and_what_it_says(tmp_path: Path, capsys) -> None:
    answer = decompose(PolynomialSystem(("x", "y"), ((x**2 + y**2 - 1) * (x - 2 * y),)))
    document = answer.document()
    k = next(i for i, c in enumerate(document["components"]) if c["degree"] == 2)
    document["components"][k] |= {"multiplicity": 3, "accuracy": 1e-20}
    document["components"][k]["radii"][1] = [0.0, 0.0]
    printed, name = certified_lines(document, tmp_path, capsys), f"component {k + 1}"
    for field, text in {
        "multiplicity": "that its multiplicity is 3: points 1 and 2",
        "radii": "that its points are no further from zeros than these: point 2",
    }.items():
        assert f"refuted    {name}: {text} (components[].{field})\n" in printed
    assert f"refuted    {name}: that it is 1e-20: the rest of the file says" in printed


def test_lines_about_completeness_do_not_contradict_each_other(tmp_path: Path, capsys) -> None:
    circles = PolynomialSystem(("x", "y"), (x**2 + y**2 - 5, x * y - 2))
    document = solve(circles).document()
    wrong = copy.deepcopy(document)
    wrong["solutions"][2]["multiplicity"] = 2
    printed = certified_lines(wrong, tmp_path, capsys)
    assert "refuted    solution 3: that its multiplicity is 2 (solutions[].multiplicity)" in printed
    # The four zeros are all that there can be, whatever is said of their multiplicities.
    assert "complete   proved: there are no more isolated zeros than Bezout's number, 4" in printed
    left_out = copy.deepcopy(document)
    left_out["excluded_solutions"].append(left_out["solutions"].pop())
    left_out["excluded"] = 1
    printed = certified_lines(left_out, tmp_path, capsys)
    assert "4 simple zeros are proved, among them solutions that are said to be excluded" in printed
    assert "complete: that there are no more isolated solutions: excluded solution 1\n" in printed


def test_records_of_the_run_are_told_apart_from_statements_that_are_not_proved() -> None:
    claims = certify_solutions(solve(LINE_AND_CIRCLE)).claims
    rows = dict(claims_rows(claims))
    assert rows["unproved"].endswith(": on_components, on_excluded, on_doubtful, undecided")
    assert "seed" in rows["records"] and "of each of solutions: residual" in rows["records"]
