"""Errors for users are of one kind, and say what they are about."""

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
