"""Exports are JSON of the published schema and read back to equal objects."""

from __future__ import annotations

import json
import math
import os
from dataclasses import fields, replace
from fractions import Fraction

import jsonschema
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import nag
from nag.algebra.expression import parse_polynomial
from nag.algebra.polynomial import Polynomial
from nag.algebra.system import PolynomialSystem
from nag.files.export import (
    ExportError,
    Origin,
    export_text,
    read_decomposition,
    read_export,
    write_decomposition,
)
from nag.files.json_schema import schema
from nag.files.written_file import TargetError, check_target, write_target
from nag.tracking.settings import find_settings
from nag.witness.moving import witness_at
from nag.witness.witness import Decomposition, PathCounts, Slice, Status, WitnessSet

VALIDATOR = jsonschema.Draft202012Validator(schema("nag-decomposition", 2))
OLD_VALIDATOR = jsonschema.Draft202012Validator(schema("nag-decomposition", 1))

doubles = st.floats(allow_nan=False, allow_infinity=False)
names = st.lists(
    st.from_regex(r"[a-z][a-z0-9_]{0,4}", fullmatch=True).filter(
        lambda name: name not in ("pi", "sqrt", "sin", "cos")
    ),
    min_size=1,
    max_size=4,
    unique=True,
)
counts = st.integers(0, 2**40)
texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=12)


@st.composite
def complex_arrays(draw: st.DrawFn, shape: tuple[int, ...]) -> np.ndarray:
    size = 2 * math.prod(shape)
    parts = draw(st.lists(doubles, min_size=size, max_size=size))
    return np.array(parts, dtype=float).reshape(-1, 2).view(complex).reshape(shape)


@st.composite
def polynomials(draw: st.DrawFn, n: int) -> Polynomial:
    exponents = st.tuples(*[st.integers(0, 3)] * n)
    coefficients = st.fractions(max_denominator=10**6)
    return Polynomial(n, draw(st.dictionaries(exponents, coefficients, max_size=4)))


@st.composite
def systems(draw: st.DrawFn) -> PolynomialSystem:
    variables = draw(names)
    n = len(variables)
    groups: list[list[int]] = []
    if draw(st.booleans()):
        cut = draw(st.integers(0, n))
        groups = [g for g in (list(range(cut)), list(range(cut, n))) if g]
    return PolynomialSystem(
        variables,
        draw(st.lists(polynomials(n), max_size=3)),
        draw(st.lists(polynomials(n), max_size=2)),
        groups,
    )


@st.composite
def slices(draw: st.DrawFn, dimension: int, n: int) -> Slice:
    """Equations with finite coefficients, of which not all are 0."""
    a = np.nan_to_num(draw(complex_arrays((dimension, n))), posinf=1.0, neginf=-1.0)
    a[~a.any(axis=1), 0] = 1.0
    b = np.nan_to_num(draw(complex_arrays((dimension,))), posinf=1.0, neginf=-1.0)
    return Slice(a, b)


@st.composite
def components(draw: st.DrawFn, system: PolynomialSystem) -> WitnessSet:
    n, dimension, degree = system.n, draw(st.integers(0, 2)), draw(st.integers(0, 3))
    multidegree = None
    if system.groups:
        shape = (len(system.groups),) * dimension
        size = math.prod(shape)
        entries = draw(st.lists(st.integers(0, 99), min_size=size, max_size=size))
        multidegree = np.array(entries).reshape(shape)
    return WitnessSet(
        slice=draw(slices(dimension, n)),
        points=draw(complex_arrays((degree, n))),
        multiplicity=draw(st.integers(0, 5)),
        status=draw(st.sampled_from(Status)),
        residual=draw(doubles),
        radii=np.abs(draw(complex_arrays((degree, n))).real),
        digits=draw(st.lists(st.integers(1, 500), min_size=degree, max_size=degree)),
        corank=draw(st.integers(0, 5)),
        multidegree=multidegree,
        orbit=draw(st.integers(1, 64)),
        note=draw(texts),
    )


@st.composite
def decompositions(draw: st.DrawFn) -> Decomposition:
    system = draw(systems())
    return Decomposition(
        system=system,
        components=tuple(draw(st.lists(components(system), max_size=3))),
        paths=PathCounts(draw(counts), draw(counts), draw(counts)),
        seed=draw(counts),
        settings=draw(st.sampled_from(["fast", "default", "careful"])),
        order=tuple(draw(st.permutations(range(len(system.polynomials))))),
        complete=draw(st.booleans()),
        notes=tuple(draw(st.lists(texts, max_size=2))),
    )


origins = st.none() | st.builds(
    Origin,
    title=texts,
    file=texts,
    kind=st.sampled_from(["system", "mechanism"]),
    formulation=st.sampled_from([None, "E", "H"]),
    reason=st.none() | texts,
)

whole_file = settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])


def circle(**changes: object) -> Decomposition:
    system = PolynomialSystem(("x", "y"), (parse_polynomial("x^2 + y^2 - 1", ["x", "y"]),))
    component = WitnessSet(
        slice=Slice([[0.6, 0.8j]], [0.25]),
        points=[[1.5 + 0.1j, -0.0], [5e-324, 0.1 + 0.2]],
        multiplicity=1,
        status=Status.IRREDUCIBLE,
        residual=1e-16,
        radii=[[1e-15, 0.0], [2e-16, 5e-324]],
        digits=[32, 53],
        corank=1,
    )
    return Decomposition(
        system, (replace(component, **changes),), PathCounts(2, 0, 0), 7, "default", (0,), True
    )


@whole_file
@given(decomposition=decompositions(), origin=origins)
def test_what_is_written_reads_back_equal_and_fits_the_schema(
    decomposition: Decomposition, origin: Origin | None, tmp_path
) -> None:
    file = tmp_path / "export.json"
    write_decomposition(decomposition, file, origin)
    VALIDATOR.validate(json.loads(file.read_text()))
    back = read_export(file)
    assert back.decomposition == decomposition
    assert back.origin == origin
    assert export_text(back.decomposition, back.origin) == file.read_text()


@whole_file
@given(decomposition=decompositions())
def test_points_read_back_to_the_same_bits(decomposition: Decomposition, tmp_path) -> None:
    file = tmp_path / "export.json"
    write_decomposition(decomposition, file)
    for before, after in zip(
        decomposition.components, read_decomposition(file).components, strict=True
    ):
        assert before.points.tobytes() == after.points.tobytes()
        assert before.slice.A.tobytes() == after.slice.A.tobytes()
        assert before.slice.b.tobytes() == after.slice.b.tobytes()


def test_values_that_are_not_finite_become_null_and_read_back_as_not_a_number(tmp_path) -> None:
    strange = circle(
        residual=math.inf,
        points=[[complex(math.nan, -math.inf), 1j]],
        radii=[[math.inf, 1e-17]],
        digits=[16],
    )
    file = tmp_path / "export.json"
    write_decomposition(strange, file)
    content = json.loads(file.read_text(), parse_constant=pytest.fail)
    VALIDATOR.validate(content)
    assert content["components"][0]["points"] == [[[None, None], [0.0, 1.0]]]
    assert content["components"][0]["radii"] == [[None, 1e-17]]
    (component,) = read_decomposition(file).components
    assert math.isnan(component.residual)
    # A radius that is not known is no bound at all.
    assert component.radii.tolist() == [[math.inf, 1e-17]]
    assert math.isnan(component.points[0, 0].real) and math.isnan(component.points[0, 0].imag)
    assert component.points[0, 1] == 1j


def test_irrational_coefficients_read_back_equal_and_are_marked(tmp_path) -> None:
    texts = ["sqrt(3)/2*x - y*pi + cos(1/7)", "x^2 - sqrt(2)"]
    system = PolynomialSystem(("x", "y"), [parse_polynomial(t, ["x", "y"]) for t in texts])
    file = tmp_path / "export.json"
    write_decomposition(replace(circle(), system=system), file)
    assert json.loads(file.read_text())["system"]["exact"] is False
    assert read_decomposition(file).system == system


def test_every_field_of_a_component_is_exported() -> None:
    exported = circle().document()["components"][0]
    names = {field.name for field in fields(WitnessSet)}
    # The system is written once for all components.
    names -= {"multidegree", "images", "fibres", "system"}
    derived = {"dimension", "degree", "cut_by", "accuracy", "precision"}
    assert names | derived == set(exported)


def test_a_component_that_is_read_back_is_moved_by_the_equations_of_the_file(tmp_path) -> None:
    # A double line and a double circle: both need deflation.
    texts = ["(x^2 + y^2 - 1)^2*(x - 3)^2", "(x^2 + y^2 - 1)^2*(x - 3)*(z - x*y)", "(x - 3)*z^2"]
    system = PolynomialSystem(
        ("x", "y", "z"), [parse_polynomial(t, ["x", "y", "z"]) for t in texts]
    )
    answer = nag.decompose(system)
    write_decomposition(answer, tmp_path / "export.json")
    again = read_decomposition(tmp_path / "export.json")
    assert again == answer
    target = Slice(np.array([[0.3 + 0.1j, 0.5, -0.7j]]), np.array([0.2 - 0.4j]))
    curves = [c for c in again.components if c.dimension == 1]
    assert curves
    for curve in curves:
        assert curve.fibres and all(len(f.cut.polynomials) == 2 + f.cut.aux for f in curve.fibres)
        moved = witness_at(system, curve, target)
        assert moved.degree == curve.degree and moved.residual < 1e-12
        assert [f.cut for f in moved.fibres] == [f.cut for f in curve.fibres]
        assert np.array_equal(np.vstack([f.x for f in moved.fibres]), moved.points)


def test_files_of_version_1_are_read(tmp_path) -> None:
    old = circle().document()
    old["version"] = 1
    del old["equations"]
    for component in old["components"]:
        del component["cut_by"]
        del component["radii"], component["digits"]
    OLD_VALIDATOR.validate(old)
    file = tmp_path / "old.json"
    file.write_text(json.dumps(old))
    assert read_decomposition(file) == with_radii_of_its_accuracy(circle())


def with_radii_of_its_accuracy(answer: Decomposition) -> Decomposition:
    (component,) = answer.components
    known = np.repeat(1 + np.linalg.norm(component.points, axis=1)[:, None], 2, axis=1)
    changed = replace(component, radii=component.accuracy * known, digits=[16, 16])
    return replace(answer, components=(changed,))


def test_files_without_error_radii_are_read(tmp_path) -> None:
    old = circle().document()
    for component in old["components"]:
        del component["radii"], component["digits"]
    old["components"][0]["precision"] = "double"
    VALIDATOR.validate(old)
    file = tmp_path / "old.json"
    file.write_text(json.dumps(old))
    assert read_decomposition(file) == with_radii_of_its_accuracy(circle())


def test_multidegree_is_exported_only_where_the_system_has_groups() -> None:
    plain = circle().document()
    assert "multidegree" not in plain["components"][0]
    system = replace(circle().system, groups=((0,), (1,)))
    grouped = replace(circle(multidegree=[2, 2]), system=system).document()
    assert grouped["components"][0]["multidegree"] == [2, 2]
    assert grouped["system"]["groups"] == [["x"], ["y"]]


def test_export_names_the_file_without_its_folder_and_holds_exact_polynomials() -> None:
    system = PolynomialSystem(("x",), [Polynomial(1, {(2,): Fraction(1, 3), (0,): Fraction(-7)})])
    empty = Decomposition(system, (), PathCounts(), 0, "default", (0,), True)
    content = empty.document(**Origin("A title", "case.toml", "system").head)
    assert content["case"] == {"title": "A title", "file": "case.toml", "kind": "system"}
    assert content["system"]["polynomials"] == ["1/3*x^2 - 7"]
    assert content["format"] == "nag-decomposition"
    assert content["version"] == 2


def _broken(change) -> str:
    content = circle().document()
    change(content)
    return json.dumps(content)


def _set(*keys_and_value: object):
    *keys, last, value = keys_and_value

    def change(content) -> None:
        for key in keys:
            content = content[key]
        content[last] = value

    return change


COMPONENT = ("components", 0)
BROKEN = {
    "empty": ("", "is not JSON"),
    "text": ("hello", "is not JSON"),
    "binary": ("\udcff\udcfe\x00", "is not JSON"),
    "list": ("[]", "must be an object"),
    "not a number": ('{"seed": NaN}', "NaN is not a JSON number"),
    "nested": ("[" * 100_000, "nested too deep"),
    "long number": ('{"seed": ' + "9" * 10_000 + "}", "is not JSON"),
    "other format": ('{"format": "nag-solutions", "version": 1}', "format: must be"),
    "later version": ('{"format": "nag-decomposition", "version": 3}', "version: must be 1 or 2"),
    "no system": (_broken(lambda c: c.pop("system")), "the key 'system' is missing"),
    "seed": (_broken(_set("seed", -1)), "seed: must be an integer, 0 or more"),
    "seed is true": (_broken(_set("seed", True)), "seed: must be an integer"),
    "complete": (_broken(_set("complete", 1)), "complete: must be true or false"),
    "settings": (_broken(_set("settings", None)), "settings: must be a string"),
    "order": (_broken(_set("order", [0.5])), "order[0]: must be an integer"),
    "paths": (_broken(_set("paths", "failed", "none")), "paths.failed: must be an integer"),
    "polynomial": (_broken(_set("system", "polynomials", ["x^^2"])), "system.polynomials[0]: "),
    "code": (
        _broken(_set("system", "polynomials", ["__import__('os')"])),
        "system.polynomials[0]: ",
    ),
    "variable": (_broken(_set("system", "variables", ["x", "x"])), "system"),
    "group": (_broken(_set("system", "groups", [["z"]])), "'z' is not one of the variables"),
    "groups": (_broken(_set("system", "groups", [["x"]])), "partition"),
    "status": (_broken(_set(*COMPONENT, "status", "sure")), "components[0].status: must be"),
    "degree": (_broken(_set(*COMPONENT, "degree", 3)), "must be the number of points"),
    "dimension": (_broken(_set(*COMPONENT, "dimension", 2)), "components[0].dimension"),
    "pair": (_broken(_set(*COMPONENT, "points", [[1, 2]])), "must be a pair [re, im]"),
    "few radii": (_broken(_set(*COMPONENT, "radii", [[0.1, 0.1]])), "radii: must be as many"),
    "radius": (
        _broken(_set(*COMPONENT, "radii", [[0.1, -0.1], [0, 0]])),
        "must be a number, 0 or more, or null",
    ),
    "few digits": (_broken(_set(*COMPONENT, "digits", [16])), "digits: must be one number"),
    "no digits": (_broken(_set(*COMPONENT, "digits", [0, 16])), "digits[0]: must be an integer"),
    "short point": (_broken(_set(*COMPONENT, "points", [[[1, 2]]])), "of length 2"),
    "large number": (_broken(_set(*COMPONENT, "residual", 10**400)), "range of doubles"),
    "orbit": (_broken(_set(*COMPONENT, "orbit", {"size": 0})), "orbit.size: must be an integer"),
    "multidegree": (_broken(_set(*COMPONENT, "multidegree", [[1], 2])), "multidegree"),
    "case": (_broken(_set("case", {"title": 1})), "case.title: must be a string"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_export_is_answered_with_one_line(name: str, tmp_path) -> None:
    text, part = BROKEN[name]
    file = tmp_path / "broken.json"
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(ExportError) as caught:
        read_decomposition(file)
    message = str(caught.value)
    assert part in message
    assert message.startswith(f"{file}: ")
    assert "\n" not in message


def test_a_missing_export_and_a_directory_are_answered_with_one_line(tmp_path) -> None:
    with pytest.raises(ExportError, match=r"cannot be read \(No such file"):
        read_decomposition(tmp_path / "none.json")
    with pytest.raises(ExportError, match="Is a directory"):
        read_decomposition(tmp_path)


def test_a_target_is_replaced_as_a_whole_and_leaves_nothing_beside_it(tmp_path) -> None:
    file = tmp_path / "answer.json"
    file.write_text("old")
    file.chmod(0o640)
    link = tmp_path / "link.json"
    link.symlink_to(file)
    check_target(link)
    assert file.read_text() == "old"
    write_target(link, "new")
    assert file.read_text() == "new"
    assert file.stat().st_mode & 0o777 == 0o640
    assert link.is_symlink()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["answer.json", "link.json"]


def test_a_failed_write_keeps_the_old_content(tmp_path) -> None:
    file = tmp_path / "answer.json"
    file.write_text("old")
    with pytest.raises(UnicodeEncodeError):
        write_target(file, "new \udcff")
    assert file.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["answer.json"]


def test_targets_that_cannot_be_written_are_found_before(tmp_path) -> None:
    (tmp_path / "file").write_text("")
    for target, part in {
        tmp_path: "is a directory",
        tmp_path / "none" / "a.json": "there is no directory",
        tmp_path / "file" / "a.json": "there is no directory",
        tmp_path / ("a" * 300): "cannot be written",
        "a\0b": "is not a file name",
        "": "is a directory",
    }.items():
        with pytest.raises(TargetError, match=part) as caught:
            check_target(target)
        assert "\n" not in str(caught.value)


def test_a_device_is_written_to_and_not_replaced() -> None:
    check_target("/dev/null")
    write_target("/dev/null", "text")
    import stat
    from pathlib import Path

    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


def test_settings_of_ones_own_are_exported_by_a_name() -> None:
    careful = replace(find_settings("careful"), retries=1)
    for equations in (["x*y - z", "x^2 + y^2 - z^2 - 1"], ["x^2 + y^2 - 1"]):
        answer = nag.decompose(equations, settings=careful)
        document = json.loads(export_text(answer))
        VALIDATOR.validate(document)
        assert document["settings"] == "custom"
        assert answer.complete


@pytest.mark.skipif(not os.path.isdir("/dev/fd"), reason="there are no names of what is open")
def test_a_pipe_that_has_no_name_of_its_own_is_written_to() -> None:
    reader, writer = os.pipe()
    check_target(f"/dev/fd/{writer}")
    write_target(f"/dev/fd/{writer}", ["some ", "text"])
    os.close(writer)
    with open(reader, "rb") as stream:
        assert stream.read() == b"some text"
