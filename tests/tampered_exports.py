"""Tamper with exports and see what their certificates say.

    python tests/tampered_exports.py [--seeds 0:4] [--paths] [--show]

Every field of an export is changed, at random and in clever ways, so that what it says is false or
at least another thing. A change is caught if the file is refused, if a statement about the field is
refused by the certificate or left open, or if the field is among those that it names as not looked
at; one that is called proved is accepted silently. Prints one line a change that was, and the
totals; exit status 1 if there are any.
"""

from __future__ import annotations

import argparse
import copy
import json
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
from systems import system

from nag.algebra.symmetry import SignedPermutation
from nag.cli import main
from nag.decomposition.decompose import decompose
from nag.files import export
from nag.solving.solve import solve

Document = dict[str, Any]
Change = tuple[str, str, Document]


@dataclass(frozen=True)
class Outcome:
    """What a certificate says of an export.

    Attributes:
        status: exit status.
        against: statements that are refuted or left open.
        standings: of the statements about one field.
    """

    status: int
    against: frozenset[tuple[str, str]]
    standings: frozenset[str]

    def word(self, before: Outcome) -> str:
        """What became of a change, in words; ``before`` is what was said without it."""
        if self.status == 2:
            return "refused"
        if self.against - before.against or self.status > before.status:
            return "refuted or open"
        return "named" if "not looked at" in self.standings else "accepted"


def exports() -> list[Document]:
    """Exports of small systems of all kinds."""
    mirror = SignedPermutation((0, 1, 2), (1, 1, -1))
    solved = [
        system("x y", "x^3 - 2*y^2 + 1", "y^3 + x*y - 3"),
        system("x y", "(x - 1)^2*(x + 2)", "y^2 - x - 3"),
        system("x y", "x^2 + y^2 - 2", "x - y", nonzero=("x + 1",)),
        system("x y z", "x*y - 1", "x^2 + y^2 - 3", "z - x*y", "z*x - x"),
    ]
    sets = [
        (system("x y z", "x*y - z", "x*z - 1"), ()),
        (system("x y", "(x^2 + y^2 - 1)*(x - 2*y)^2"), ()),
        (system("x y", "x^2 + y^2 - 2", "x*y - 1"), ()),
        (system("x y z", "(x^2 + y^2 - 1)*z", "(y - x^2)*z*(z - 2)", nonzero=("z - 2",)), ()),
        (system("x y z", "z^2 - 2", "x^2 + y^2 - 1"), (mirror,)),
    ]
    documents = [solve(s).document("title", "case.toml") for s in solved]
    origin = export.Origin("title", "case.toml", "system", None, "no choice")
    documents += [decompose(s, symmetries=g).document(**origin.head) for s, g in sets]
    return [json.loads(json.dumps(d)) for d in documents]


def leaves(value: Any, place: str = "", path: tuple = ()) -> Iterator[tuple[str, tuple]]:
    """All fields that hold no others, as the schema names them, and the ways to them."""
    if isinstance(value, dict):
        for key, each in value.items():
            yield from leaves(each, f"{place}.{key}" if place else key, (*path, key))
    elif isinstance(value, list) and any(isinstance(v, dict | list) for v in value):
        for i, each in enumerate(value):
            yield from leaves(each, f"{place}[]" if isinstance(each, dict) else place, (*path, i))
    else:
        yield place, path


def changed_value(value: Any, rng: np.random.Generator) -> Any:
    """Another value of the same kind."""
    match value:
        case bool():
            return not value
        case int():
            return int(value + rng.choice([1, 2, 3]))
        case float():
            return float(rng.choice([value * 1e-3, value + 0.125, value * 4 + 1, 0.0]))
        case str():
            return value + " + 1" if value.replace(" ", "") else "other"
        case None:
            return 0.5
        case [float() | int(), *_] as numbers:
            place = int(rng.integers(len(numbers)))
            other = numbers.copy()
            other[place] = changed_value(other[place], rng)
            return other
        case [str(), *_] as texts:
            return texts[:-1]
        case _:
            return [1]


def at_random(document: Document, rng: np.random.Generator, count: int) -> Iterator[Change]:
    """Single fields changed: one of each name, and more by chance."""
    by_name: dict[str, list[tuple]] = {}
    for place, path in leaves(document):
        by_name.setdefault(place, []).append(path)
    names = list(by_name)
    chosen = [names[i] for i in rng.permutation(len(names))[:count]]
    for name in chosen:
        path = by_name[name][int(rng.integers(len(by_name[name])))]
        other = copy.deepcopy(document)
        inside = other
        for key in path[:-1]:
            inside = inside[key]
        before = inside[path[-1]]
        inside[path[-1]] = changed_value(before, rng)
        if not is_harmless(name, before, inside[path[-1]], path, document):
            yield name, f"{name}: {str(before)[:40]} -> {str(inside[path[-1]])[:40]}", other


def is_harmless(name: str, before: Any, after: Any, path: tuple, document: Document) -> bool:
    """Whether a statement is as true as it was: an error that is larger, or an exact one's."""
    if before == after:
        return True
    key = name.rpartition(".")[2]
    if "solutions" in name and key == "accuracy":
        point = np.array(document[path[0]][path[1]]["point"])
        return after >= before or bool((point == np.round(point)).all())
    if key == "radii":
        return all(b is None or b >= a for a, b in zip(before, after, strict=True))
    if key == "points":
        # Within the radii that are given with it.
        return bool(np.abs(np.subtract(before, after)).max() < 1e-17)
    return False


def clever(document: Document) -> Iterator[Change]:
    """Changes that leave the export in agreement with itself."""
    yield from (of_solutions if "solutions" in document else of_components)(document)


def edited(document: Document, edit: Callable[[Document], Any]) -> Document:
    other = copy.deepcopy(document)
    edit(other)
    return other


def of_solutions(document: Document) -> Iterator[Change]:
    count = len(document["solutions"])
    for i in range(count):
        yield (
            "complete",
            f"solution {i + 1} left out",
            edited(document, lambda d, i=i: d["solutions"].pop(i)),
        )
    yield (
        "complete",
        "half of the solutions left out",
        edited(document, lambda d: d.update(solutions=d["solutions"][: count // 2])),
    )
    yield (
        "solutions[].point",
        "a solution listed twice",
        edited(document, lambda d: d["solutions"].append(d["solutions"][0])),
    )

    def conjugate(d: Document) -> None:
        for z in d["solutions"][0]["point"]:
            z[1] = -z[1] + 1e-3

    def move_to_excluded(d: Document) -> None:
        d["excluded_solutions"].append(d["solutions"].pop())
        d["excluded"] += 1

    def move_from_excluded(d: Document) -> None:
        d["solutions"].append(d["excluded_solutions"].pop())
        d["excluded"] -= 1

    def on_components(d: Document) -> None:
        d["on_components"].append(d["solutions"].pop()["point"])

    def no_solution(d: Document) -> None:
        d["undecided"].append([[z[0] + 0.3, z[1]] for z in d["solutions"][0]["point"]])

    def near(d: Document) -> None:
        d["solutions"][0]["point"][0][0] += 1e-12

    def other_equations(d: Document) -> None:
        d["system"]["polynomials"][0] += " + 1/10^9"

    yield "solutions[].point", "a point moved by 1e-3", edited(document, conjugate)
    yield "solutions[].accuracy", "a point moved by 1e-12", edited(document, near)
    yield "excluded_solutions", "a solution said to be excluded", edited(document, move_to_excluded)
    if document["excluded_solutions"]:
        yield (
            "system.nonzero",
            "an excluded zero as a solution",
            edited(document, move_from_excluded),
        )
    yield "on_components", "a solution said to be on a set", edited(document, on_components)
    yield "undecided", "no solution said to be undecided", edited(document, no_solution)
    yield "solutions[].accuracy", "other equations", edited(document, other_equations)


def of_components(document: Document) -> Iterator[Change]:
    rng = np.random.default_rng(0)
    for k, component in enumerate(document["components"]):
        yield from of_component(document, component, k, rng)


def of_component(
    document: Document, component: Document, k: int, rng: np.random.Generator
) -> Iterator[Change]:
    name = f"component {k + 1}"

    def edit(change: Callable[[Document], Any]) -> Document:
        return edited(document, lambda d: change(d["components"][k]))

    def twice(d: Document) -> None:
        other = copy.deepcopy(d["components"][k])
        for i, row in enumerate(other["slice"]["A"]):
            other["slice"]["A"][i] = [[2 * v for v in z] for z in row]
            other["slice"]["b"][i] = [2 * v for v in other["slice"]["b"][i]]
        d["components"].append(other)

    def cut(c: Document) -> None:
        keep = len(c["points"]) - 1
        for key in ("points", "radii", "digits"):
            c[key] = c[key][:keep]
        c["degree"] = keep
        left = keep
        for part in c["cut_by"]:
            part["points"] = min(part["points"], left)
            part["unknowns"] = part["unknowns"][: part["points"]]
            part.pop("close", None)
            left -= part["points"]
        del c["radii"], c["digits"], c["precision"]
        c |= {"precision": "16 digits", "accuracy": 1e-12}

    def off(c: Document) -> None:
        c["points"][0][0][0] += 1e-3

    yield "components", f"{name} listed twice, its slice rescaled", edited(document, twice)
    yield "complete", f"{name} left out", edited(document, lambda d: d["components"].pop(k))
    yield "components[].points", f"a point of {name} moved", edit(off)
    if component["degree"] > 1:
        yield "components[].degree", f"{name} without its last point", edit(cut)
    for value in {1, 2, 3} - {component["multiplicity"]}:
        yield (
            "components[].multiplicity",
            f"{name} of multiplicity {value}",
            edit(lambda c, value=value: c.update(multiplicity=value)),
        )
    for value in {0, 1, 2} - {component["corank"]}:
        yield (
            "components[].corank",
            f"{name} of corank {value}",
            edit(lambda c, value=value: c.update(corank=value)),
        )
    yield (
        "components[].nonzero",
        f"{name} excluded",
        edited(
            document,
            lambda d: d["system"]["nonzero"].append(vanishing_on(d, component)),
        ),
    )
    same = len(document["components"]) > k + 1
    if same and document["components"][k + 1]["dimension"] == component["dimension"]:
        yield (
            "components[].status",
            f"{name} and the next one as one",
            edited(document, lambda d: join(d, k)),
        )


def vanishing_on(document: Document, component: Document) -> str:
    """A factor of an equation that vanishes on a component."""
    from nag.algebra.expression import parse_polynomial
    from nag.algebra.factoring import factor_into_irreducibles

    names = document["system"]["variables"]
    point = np.array(component["points"][0], dtype=float) @ [1, 1j]
    for text in document["system"]["polynomials"]:
        for f, _ in factor_into_irreducibles(parse_polynomial(text, names)):
            value = sum(
                complex(float(c)) * np.prod(point ** np.array(e)) for e, c in f.terms.items()
            )
            if abs(value) < 1e-8:
                return f.text(names)
    raise ValueError("no factor vanishes there")


def join(document: Document, k: int) -> None:
    """Two components as one, of a file without error radii and equations."""
    one, other = document["components"][k], document["components"].pop(k + 1)
    one["points"] += other["points"]
    one["degree"] += other["degree"]
    one.update(cut_by=[], accuracy=1e-12, precision="16 digits")
    del one["radii"], one["digits"]


def outcome(document: Document, field: str, options: list[str]) -> Outcome:
    """What ``nag certify`` says of an export."""
    with tempfile.TemporaryDirectory() as folder:
        file, target = Path(folder) / "export.json", Path(folder) / "certificate.json"
        file.write_text(json.dumps(document))
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            status = main(["certify", str(file), "--json", str(target), *options])
        statements = json.loads(target.read_text())["statements"] if status < 2 else []
    against = {
        (s["field"], s["standing"])
        for s in statements
        if s["standing"] in ("refuted", "refuted by evidence", "not decided")
    }
    own = {s["standing"] for s in statements if is_about(s["field"], field)}
    return Outcome(status, frozenset(against), frozenset(own))


def is_about(statement: str, field: str) -> bool:
    """Whether a statement about one field is one about another, or about what that is a part of."""
    one, other = (text.replace("[]", "").split(".") for text in (statement, field))
    return one == other[: len(one)]


def main_campaign() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="0:4")
    parser.add_argument(
        "--fields", type=int, default=8, help="changed at random, a seed and export"
    )
    parser.add_argument("--paths", action="store_true")
    parser.add_argument("--show", action="store_true")
    given = parser.parse_args()
    options = ["--paths"] if given.paths else []
    first, last = map(int, given.seeds.split(":"))
    begin, counts, wrong = time.process_time(), Counter[str](), 0
    for i, document in enumerate(exports()):
        before = outcome(document, "", options)
        if before.status == 2:
            raise SystemExit(f"export {i}: refused as it is")
        changes = list(clever(document))
        for seed in range(first, last):
            changes += at_random(document, np.random.default_rng([seed, i]), given.fields)
        for field, text, other in changes:
            found = outcome(other, field, options)
            word = found.word(before)
            counts[word] += 1
            wrong += word == "accepted"
            if given.show or word == "accepted":
                print(f"export {i}: {text}: {word} {sorted(found.standings)}", flush=True)
    print(dict(counts), f"{time.process_time() - begin:.0f} s")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main_campaign())
