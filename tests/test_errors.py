"""Errors for users are of one kind, and say what they are about."""

import copy
import importlib
import inspect
import pickle
import pkgutil

import networkx
import pytest

import nag
from nag.errors import NagError

PUBLIC = ("ComponentError", "EquationError", "InputError", "MechanismError", "StartError")


def classes_of_errors() -> list[type[Exception]]:
    names = [m.name for m in pkgutil.walk_packages(nag.__path__, "nag.")]
    modules = [importlib.import_module(name) for name in names if name != "nag.__main__"]
    values = (each for module in modules for each in vars(module).values())
    classes = {each for each in values if inspect.isclass(each) and issubclass(each, ValueError)}
    return [c for c in classes if c.__module__.startswith("nag.") and c.__name__[0] != "_"]


def test_every_error_for_users_has_one_base_class() -> None:
    found = classes_of_errors()
    assert len(found) > 20
    assert [e for e in found if not issubclass(e, NagError)] == []


def made(kind: type[Exception]) -> Exception:
    """An error of this kind with something in each of its fields."""
    samples = nag.sample(nag.decompose("x^2 + y^2 - 1"), count=1)
    given = {
        "str": "a line",
        "str | None": "a name",
        "int | None": 3,
        "Sequence[int]": (1, 2),
        "object": [0.5],
        "Samples": samples,
    }
    if kind.__init__ is ValueError.__init__:
        return kind("a line")
    fields = list(inspect.signature(kind.__init__).parameters.values())[1:]
    values = {each.name: given[each.annotation] for each in fields}
    return kind(**values)


def test_every_error_for_users_is_the_same_after_a_pickle_and_a_copy() -> None:
    kinds = {NagError, *classes_of_errors()}
    assert {"SamplingError", "NoRealPointsError", "TimeLimitError"} <= {k.__name__ for k in kinds}
    for kind in kinds:
        error = made(kind)
        error.add_note("a note")
        for again in (pickle.loads(pickle.dumps(error)), copy.copy(error), copy.deepcopy(error)):
            assert type(again) is kind
            assert (str(again), again.args, vars(again)) == (str(error), error.args, vars(error))


@pytest.mark.parametrize("name", PUBLIC)
def test_public_errors_are_caught_as_one_and_as_values(name: str) -> None:
    public = getattr(nag, name)
    assert issubclass(public, nag.NagError) and issubclass(public, ValueError)
    assert str(pickle.loads(pickle.dumps(public("a line")))) == "a line"


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda: nag.system("x + ) = 0"), "EquationError"),
        (lambda: nag.read_case("no/such/case.toml"), "InputError"),
        (lambda: nag.Mechanism.from_graph(networkx.MultiGraph(), ground="base"), "MechanismError"),
        (lambda: nag.solve(["x^2 - 1"], start="polyhedrall"), "NagError"),
        (lambda: nag.decompose(["x*y"], seed=-1), "NagError"),
    ],
)
def test_bad_input_raises_the_error_that_names_its_kind(call: object, kind: str) -> None:
    with pytest.raises(getattr(nag, kind)):
        call()  # type: ignore[operator]
