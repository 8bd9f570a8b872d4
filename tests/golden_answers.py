"""Keep what is answered, and judge changes by it: the same bytes, or a difference to be explained.

    python tests/golden_answers.py keep FOLDER [--case NAME ...] [--ask NAME ...] [--seeds 0:3]
        [--below SECONDS] [--jobs J]
    python tests/golden_answers.py compare FOLDER_A FOLDER_B [--all]
    python tests/golden_answers.py pair OLD_CHECKOUT NEW_CHECKOUT [--case NAME ...] [--rounds 5]

`keep` asks the package that is imported (set PYTHONPATH to a checkout) every question of `ASKED`
about its own cases, and the atlas, and writes a file for each: CASE/QUESTION.SEED.txt with the
command, the exit status and what is printed, and beside it what is exported. What takes longer than
the limit of processor time is kept as slow, for later seeds as well. Asked again with a larger
limit, a folder is completed: only what is slow or missing is asked.

`compare` tells same bytes; the same answer (the same components, solutions and statements in any
order, points equal to their radii); the same components on other slices; and what is different,
with exit status 1.

`pair` times the benchmarks of two checkouts in turn, in processor time.
"""

from __future__ import annotations

import argparse
import contextlib
import difflib
import io
import json
import os
import re
import resource
import subprocess
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path
from statistics import geometric_mean, median
from typing import Any
from unittest.mock import patch

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching
from scipy.spatial import cKDTree

import nag
from nag.bench.timed_runs import TimedRun, timed_runs
from nag.cli import main as run_command

CHECKOUT = Path(nag.__file__).parents[1]
CASES = CHECKOUT / "cases"
FIXED = ("--threads", "1", "--quiet")
ASKED = {
    "model": "the polynomial system",
    "decompose": "the components",
    "solve": "the isolated solutions",
    "mobility": "of mechanisms, for every seed",
    "curves": "of mechanisms: the genus of the curves of motion, and bonds",
    "local": "the local dimension at the points that a case names",
    "check": "statements of the papers, of the cases that have no folder of their own",
    "certify-decompose": "proofs of the exported witness points",
    "certify-solve": "proofs of the exported solutions",
    "prove-decompose": "the same, and of loops",
    "prove-solve": "the same, and of paths",
    "singular": "singular points of the exported components",
    "intersect": "the intersection of the first two of them",
    "eliminate": "equations of the first of them",
    "sample": "points of the first of them",
    "member": "the components through the first point that a case names",
    "atlas": "verdicts on the families of the atlas, by family",
}
SLOW = "slow: more than "
# Asked of each new process before it is timed: what is loaded on first use is loaded then.
WARM = ("solve", "cases/benchmarks/katsura-6.toml", *FIXED)


# --- What is asked


@dataclass(frozen=True)
class Question:
    """A command about a case.

    Attributes:
        case: path of its file below the cases, without the ending.
        name: one of `ASKED`.
        words: of the command line, but for the seed and the export.
        seed: None where nothing is random.
        exports: whether there is an export as well.
        target: the file that is written, without its ending.
    """

    case: str
    name: str
    words: tuple[str, ...]
    seed: int | None
    exports: bool
    target: Path

    @property
    def command(self) -> list[str]:
        seeded = [] if self.seed is None else ["--seed", str(self.seed)]
        return [*self.words, *seeded, *(["--json", f"{self.target}.json"] if self.exports else [])]


@dataclass(frozen=True)
class Asker:
    """Where answers are kept, and for which questions and seeds."""

    folder: Path
    names: frozenset[str]
    seeds: range

    def question(
        self, case: str, name: str, words: Iterable[str], seed: int | None, exports: bool = True
    ) -> Question:
        file = name if seed is None else f"{name}.{seed}"
        return Question(case, name, tuple(words), seed, exports, self.folder / case / file)

    def about_cases(self, cases: Sequence[str]) -> Iterator[Question]:
        """Questions that a case is enough for, those of the first seed first."""
        for seed in self.seeds:
            for case in cases:
                file, first = f"cases/{case}.toml", seed == self.seeds[0]
                table = case_table(case)
                moves = table["kind"] != "system"
                if first:
                    yield self.question(case, "model", ["model", file], None, exports=False)
                yield self.question(case, "decompose", ["decompose", file, *FIXED], seed)
                yield self.question(case, "solve", ["solve", file, *FIXED], seed)
                if moves:
                    yield self.question(case, "mobility", ["mobility", file, *FIXED], seed)
                if first and moves:
                    words = ["mobility", file, "--curves", *FIXED]
                    yield self.question(case, "curves", words, seed)
                if first and (table["kind"] == "mechanism" or "point" in table):
                    yield self.question(case, "local", ["local", file, *FIXED], seed)
                if first and "/" not in case:
                    words = ["check", file, *FIXED]
                    yield self.question(case, "check", words, seed, exports=False)

    def about_exports(self, cases: Sequence[str]) -> Iterator[Question]:
        """Questions about what was exported."""
        for seed in self.seeds:
            for case in cases:
                first = seed == self.seeds[0]
                for kind in ("decompose", "solve"):
                    export = self.folder / case / f"{kind}.{seed}.json"
                    if not export.exists():
                        continue
                    file = str(export)
                    name = f"certify-{kind}"
                    target = self.folder / case / f"{name}.{seed}"
                    yield Question(case, name, ("certify", file), None, True, target)
                    if not first:
                        continue
                    target, words = self.folder / case / f"prove-{kind}", ("certify", file)
                    yield Question(case, target.name, (*words, "--paths"), None, True, target)
                    if kind == "decompose":
                        yield from self._about_components(case, export, seed)

    def _about_components(self, case: str, export: Path, seed: int) -> Iterator[Question]:
        components = json.loads(export.read_text())["components"]
        if not components:
            return
        file, last = str(export), ("--component", "1", *FIXED)
        yield self.question(case, "singular", ("singular", file, *FIXED), seed)
        yield self.question(case, "eliminate", ("eliminate", file, *last), seed)
        yield self.question(case, "sample", ("sample", file, "--count", "3", *last), seed)
        if sum(c["orbit"]["size"] for c in components) > 1:
            words = ("intersect", file, "--components", "1", "2", *FIXED)
            yield self.question(case, "intersect", words, seed)
        table = case_table(case)
        names = [point["name"] for point in table.get("point", ())]
        names += ["reference"] if table["kind"] == "mechanism" else []
        if names:
            words = ("member", f"cases/{case}.toml", names[0], *FIXED)
            yield self.question(case, "member", words, seed)

    def left(self, questions: Iterable[Question], limit: float) -> Iterator[Question]:
        """Those of the questions asked for that are not answered yet.

        One that is slow for the first seed is slow for all, and is not asked again.
        """
        for question in questions:
            if question.name not in self.names or _kept(question.target, limit):
                continue
            first = self.folder / question.case / f"{question.name}.{self.seeds[0]}.txt"
            if first.exists() and first.read_text().startswith(SLOW):
                _write(question.target, first.read_text())
            else:
                yield question


@cache
def case_table(case: str) -> dict[str, Any]:
    return tomllib.loads((CASES / f"{case}.toml").read_text())


def all_cases() -> list[str]:
    found = (path.relative_to(CASES).with_suffix("") for path in CASES.rglob("*.toml"))
    return sorted(path.as_posix() for path in found)


def _kept(target: Path, limit: float) -> bool:
    file = Path(f"{target}.txt")
    if not file.exists():
        return False
    text = file.read_text()
    return not text.startswith(SLOW) or float(text.removeprefix(SLOW).split()[0]) >= limit


def _write(target: Path, text: str) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    Path(f"{target}.txt").write_text(text)


# --- Asking


def ask(question: Question | tuple[str, ...]) -> str:
    """What a command answers, as text: it, its exit status, what it prints and complains of.

    The clock stands still meanwhile, so that no time is in the text, and no line is broken
    elsewhere because of one; folders are left out.
    """
    words = question.command if isinstance(question, Question) else list(question)
    printed, complained = io.StringIO(), io.StringIO()
    os.chdir(CHECKOUT)
    if isinstance(question, Question):
        question.target.parent.mkdir(parents=True, exist_ok=True)
    with (
        contextlib.redirect_stdout(printed),
        contextlib.redirect_stderr(complained),
        patch("time.perf_counter", return_value=0.0),
    ):
        status = run_command(words)
    text = f"nag {' '.join(words)}\nexit status {status}\n\n{printed.getvalue()}"
    if complained.getvalue():
        text += f"\non standard error:\n{complained.getvalue()}"
    if isinstance(question, Question):
        text = text.replace(f"{question.target.parent}{os.sep}", "")
    return text


def _keep_run(run: TimedRun) -> None:
    target, text = run.task.target, run.value
    if text is None:
        Path(f"{target}.json").unlink(missing_ok=True)
        text = f"error: {run.error}\n"
        if run.slow and not run.error:
            text = f"{SLOW}{run.seconds:g} s of processor time\n"
    _write(target, text)


def keep(options: argparse.Namespace) -> int:
    folder: Path = options.folder.resolve()
    refused = _refused(folder)
    if refused:
        print(refused, file=sys.stderr)
        return 2
    cases = all_cases()
    unknown = sorted(set(options.case or ()) - set(cases))
    if unknown:
        print(f"--case: there is no cases/{unknown[0]}.toml", file=sys.stderr)
        return 2
    first, last = map(int, options.seeds.split(":"))
    asker = Asker(folder, frozenset(options.ask or ASKED), range(first, last))
    chosen = options.case or cases
    seconds: list[tuple[float, str]] = []
    slow = 0
    for questions in (asker.about_cases(chosen), asker.about_exports(chosen)):
        left = asker.left(questions, options.below)
        for run in timed_runs(ask, left, limit=options.below, jobs=options.jobs, first=WARM):
            _keep_run(run)
            name = str(run.task.target.relative_to(folder))
            seconds.append((run.seconds, name))
            slow += run.slow
            if run.error:
                print(f"{name}: {run.error}", flush=True)
    if "atlas" in asker.names and not options.case:
        began = _children()
        keep_atlas(folder / "atlas", len(asker.seeds), max(1, round(options.below)), options.jobs)
        seconds.append((_children() - began, "atlas"))
    total = sum(s for s, _ in seconds)
    print(f"{len(seconds)} questions, {slow} slow, {total:.0f} s of processor time")
    for spent, name in sorted(seconds, reverse=True)[:10]:
        print(f"{spent:8.1f} s  {name}")
    return 0


def _refused(folder: Path) -> str:
    """Why nothing can be kept there: answers of other sources are in it."""
    describe = ["git", "-C", str(CHECKOUT), "describe", "--always", "--abbrev=40", "--dirty"]
    now = subprocess.run(describe, capture_output=True, text=True, check=True).stdout
    file = folder / "sources.txt"
    if file.exists() and (file.read_text() != now or "dirty" in now):
        held = file.read_text().strip()
        return f"{folder}: holds answers of {held}, these are of {now.strip()}; name another folder"
    folder.mkdir(parents=True, exist_ok=True)
    file.write_text(now)
    return ""


def _children() -> float:
    """Processor time of all processes that were started here and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def keep_atlas(folder: Path, seeds: int, limit: int, jobs: int) -> None:
    """The counts of the atlas, one file a family, without times."""
    from nag.bench.atlas.families import FAMILIES

    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(CHECKOUT)
    for family in FAMILIES:
        file = folder / f"{family.name}.json"
        if file.exists():
            known = json.loads(file.read_text())
            if known["seeds"] >= seeds and (known["limit"] >= limit or not _slow_cells(known)):
                continue
        options = {"--family": family.name, "--seeds": seeds, "--limit": limit, "--jobs": jobs}
        words = [str(word) for pair in options.items() for word in pair]
        with contextlib.redirect_stdout(io.StringIO()):
            run_command(["chart", "stability", "--quiet", *words, "--json", str(file)])
        found = json.loads(file.read_text())
        for row in found["rows"]:
            for cell in row["cells"]:
                del cell["seconds"]
        file.write_text(json.dumps(found, indent=1) + "\n")


def _slow_cells(atlas: dict[str, Any]) -> int:
    return sum(cell["slow"] for row in atlas["rows"] for cell in row["cells"])


# --- Comparing


class Grade(StrEnum):
    BYTES = "same bytes"
    SAME = "same answer"
    ELSEWHERE = "same, on other slices"
    SLOW = "slow in one or both"
    MISSING = "in one only"
    OTHER = "DIFFERENT"


@dataclass(frozen=True)
class Placed:
    """Points that are compared with those of the same facts and the same slice.

    Attributes:
        facts: of the set that they belong to.
        slice: that they lie on; empty for isolated points.
        points: complex, shape ``(P, n)``.
        radii: of the coordinates, absolute, shape ``(P, n)``; zero where they are not known.
    """

    facts: str
    slice: str
    points: np.ndarray
    radii: np.ndarray


# How something was found and written, what it rests on, and where points are.
HOW = frozenset([
    "paths", "notes", "note", "order", "start", "reason", "cut_by", "images", "tubes",
    "permutations", "reached", "ends", "arithmetic", "sharpened", "says", "number", "component",
    "residual", "condition", "accuracy", "precision", "digits", "error",
    "slice", "points", "radii", "centre", "inner", "outer", "decimals", "forms", "linear",
    "excluded_solutions", "on_components", "on_excluded", "on_doubtful", "undecided",
])  # fmt: skip
# Numbers of components in the order of the export.
NUMBERS = frozenset(["essential", "examined", "smooth", "same", "unknown"])
# Lines of what is printed that are part of the answer.
ROWS = ("answer", "known", "mobility", "components", "curve", "point")
# Relative radius of points that are exported without.
ROUNDED = 1e-8


def facts_of(document: dict[str, Any]) -> dict[str, Any]:
    """What a document states, but for where points are: dimensions, degrees, counts, proofs."""
    found = _facts(document)
    if document.get("format") == "nag-decomposition":
        del found["equations"]
    if document.get("format") == "nag-solutions":
        for key in ("on_components", "on_excluded", "on_doubtful", "undecided"):
            found[key] = len(document.get(key, ()))
        found["solutions"] = [_facts(_without_point(s)) for s in document["solutions"]]
        found["solutions"].sort(key=_text)
    return found


def _text(value: Any) -> str:
    return json.dumps(value, sort_keys=True)


def _without_point(solution: dict[str, Any]) -> dict[str, Any]:
    return {k: v for k, v in solution.items() if k != "point"}


def _facts(value: Any) -> Any:
    if isinstance(value, dict):
        kept = {k: v for k, v in value.items() if k not in HOW}
        proofs = {
            f"{k} ({proof})": n
            for k in ("points", "excluded")
            for proof, n in _proofs(value.get(k)).items()
        }
        return proofs | {k: len(v) if k in NUMBERS else _facts(v) for k, v in kept.items()}
    if isinstance(value, list):
        parts = [_facts(v) for v in value]
        return sorted(parts, key=_text) if any(isinstance(v, dict) for v in value) else parts
    return value


def _proofs(points: Any) -> Counter[str]:
    """How many points of a certificate are proved, and as what."""
    if not isinstance(points, list):
        return Counter()
    return Counter(
        f"{p['proof']}{', refuted' if p['refuted'] else ''}"
        for p in points
        if isinstance(p, dict) and "proof" in p
    )


def placed_in(document: dict[str, Any]) -> list[Placed]:
    """The points that a document exports, with what they belong to."""
    kind = document.get("format")
    if kind in ("nag-decomposition", "nag-intersection"):
        return [_placed(c, c, c["points"], c["radii"]) for c in document["components"]]
    if kind == "nag-solutions":
        keys = ("solutions", "excluded_solutions")
        return [_solution(key, s) for key in keys for s in document.get(key, ())]
    if kind == "nag-certificate":
        proved = []
        for owner in document.get("components", [document]):
            boxes = [p for p in owner["points"] if "centre" in p]
            about = owner if "slice" in owner else {}
            centres, inner = [p["centre"] for p in boxes], [p["inner"] for p in boxes]
            proved.append(_placed(about, about, centres, inner))
        return proved
    if kind == "nag-singular":
        # Positive-dimensional sets are given by points of slices that are not exported.
        return [
            _placed(s, {"slice": s["points"] if s["dimension"] else ""}, s["points"], None)
            for s in document["sets"]
        ]
    if kind == "nag-samples":
        return [_placed({}, {"slice": document["points"]}, document["points"], None)]
    return []


def _placed(facts: Any, sliced: dict[str, Any], points: Any, radii: Any) -> Placed:
    pairs = np.array(points, dtype=float).reshape(len(points), -1, 2)
    z = np.nan_to_num(pairs[..., 0] + 1j * pairs[..., 1], posinf=0.0, neginf=0.0)
    if radii is None:
        found = ROUNDED * (1 + np.abs(z))
    else:
        found = np.array(radii, dtype=float).reshape(z.shape)
        found[~np.isfinite(found)] = 0.0
    return Placed(_text(_facts(facts)), _text(sliced.get("slice", "")), z, found)


def _solution(key: str, solution: dict[str, Any]) -> Placed:
    point = np.array(solution["point"], dtype=float)
    accuracy = solution["accuracy"] or 0.0
    radii = [[accuracy * (1 + float(np.linalg.norm(point)))] * len(point)]
    return _placed({key: _facts(_without_point(solution))}, {}, [solution["point"]], radii)


def compare_points(a: Sequence[Placed], b: Sequence[Placed]) -> tuple[Grade, str]:
    """Whether sets of points are the same to their radii, set by set, in any order.

    Sets are alike if they have the same facts; where the slices of like sets differ, their points
    cannot be compared.
    """
    if Counter(p.facts for p in a) != Counter(p.facts for p in b):
        return Grade.OTHER, "the points belong to other sets"
    if Counter((p.facts, p.slice) for p in a) != Counter((p.facts, p.slice) for p in b):
        return Grade.ELSEWHERE, ""
    for key in {(p.facts, p.slice): None for p in a}:
        told = _difference(*([p for p in s if (p.facts, p.slice) == key] for s in (a, b)))
        if told:
            return Grade.OTHER, f"{told}, of {key[0][:200]}"
    return Grade.SAME, ""


def _difference(a: Sequence[Placed], b: Sequence[Placed]) -> str:
    """What differs between the points of like sets on one slice; empty if nothing does."""
    points, radii, owners = [], [], []
    for sets in (a, b):
        points.append(np.concatenate([p.points for p in sets]))
        radii.append(np.concatenate([p.radii for p in sets]))
        owners.append(np.repeat(np.arange(len(sets)), [len(p.points) for p in sets]))
    if points[0].shape != points[1].shape:
        return f"{len(points[0])} and {len(points[1])} points"
    if not points[0].size:
        return ""
    reach = 2 * max(r.max() for r in radii)
    tree = cKDTree(points[1].view(float))
    pairs = [
        (i, j)
        for i, near in enumerate(tree.query_ball_point(points[0].view(float), reach, p=np.inf))
        for j in near
        if (np.abs(points[0][i] - points[1][j]) <= radii[0][i] + radii[1][j]).all()
    ]
    rows, columns = np.array(pairs, dtype=int).reshape(-1, 2).T
    size = len(points[0])
    graph = csr_array((np.ones(len(rows), dtype=bool), (rows, columns)), shape=(size, size))
    match = maximum_bipartite_matching(graph, perm_type="column")
    lost = np.flatnonzero(match < 0)
    if len(lost):
        i = lost[0]
        nearest = np.abs(points[1] - points[0][i]).max(axis=1).min()
        return (
            f"{len(lost)} of {size} points moved, one by {nearest:.1e}, its radius being "
            f"{radii[0][i].max():.1e}"
        )
    met = {(int(x), int(y)) for x, y in zip(owners[0], owners[1][match], strict=True)}
    if len(met) != len({x for x, _ in met}):
        return "points are on other components"
    return ""


def _printed_rows(text: str) -> dict[str, str]:
    """The lines that are part of the answer, by their label, their continuations joined."""
    rows: dict[str, str] = {}
    label = ""
    for line in text.splitlines():
        first = re.match(r"(\w+)\s{2,}", line)
        if first:
            label = first[1]
        elif not line.startswith(" "):
            label = ""
        if label in ROWS:
            rows[label] = f"{rows.get(label, '')} {' '.join(line.split())}"
    return rows


def _diff(a: Sequence[str], b: Sequence[str]) -> str:
    lines = list(difflib.unified_diff(a, b, lineterm="", n=0))[2:]
    lines = [line[:160] for line in lines if not line.startswith("@@")]
    return "\n".join(lines[:6] + ([f"... {len(lines) - 6} more lines"] if len(lines) > 6 else []))


def _lines(value: Any) -> list[str]:
    return json.dumps(value, indent=1, sort_keys=True).splitlines()


def compare_documents(a: dict[str, Any], b: dict[str, Any]) -> tuple[Grade, str]:
    """How two exports compare, and what is different."""
    facts = facts_of(a), facts_of(b)
    if facts[0] != facts[1]:
        return Grade.OTHER, _diff(*map(_lines, facts))
    return compare_points(placed_in(a), placed_in(b))


def compare_answers(a: Path, b: Path) -> tuple[Grade, str]:
    """How two answers compare that were kept as these files, without endings."""
    texts = [file.read_text() for file in (Path(f"{a}.txt"), Path(f"{b}.txt"))]
    if any(text.startswith(SLOW) for text in texts):
        return Grade.SLOW, ""
    exports = [file.read_bytes() if file.exists() else b"" for file in _exports(a, b)]
    if exports[0] == exports[1]:
        if texts[0] == texts[1]:
            return Grade.BYTES, ""
        return Grade.OTHER, _diff(*(text.splitlines() for text in texts))
    statuses = [text.splitlines()[1] for text in texts]
    if not all(exports) or statuses[0] != statuses[1]:
        return Grade.OTHER, _diff(*(text.splitlines() for text in texts))
    grade, told = compare_documents(*map(json.loads, exports))
    rows = [_printed_rows(text) for text in texts]
    if grade is not Grade.OTHER and rows[0] != rows[1]:
        return Grade.OTHER, _diff(*([f"{k} {v}" for k, v in row.items()] for row in rows))
    return grade, told


def _exports(a: Path, b: Path) -> tuple[Path, Path]:
    return Path(f"{a}.json"), Path(f"{b}.json")


def compare_atlas(a: Path, b: Path) -> tuple[Grade, str]:
    """How the counts of a family compare; answers that are slow in one are not compared."""
    texts = [file.read_text() for file in _exports(a, b)]
    if texts[0] == texts[1]:
        return Grade.BYTES, ""
    atlases = [json.loads(text) for text in texts]
    cells = [
        {str(c["value"]): c for row in atlas["rows"] for c in row["cells"]} for atlas in atlases
    ]
    counts = [
        [f"{v}: {c['right']} right, {c['undecided']} undecided, {c['wrong']} wrong"
         for v, c in found.items() if not any(o.get(v, c)["slow"] for o in cells)]
        for found in cells
    ]  # fmt: skip
    if counts[0] != counts[1]:
        return Grade.OTHER, _diff(*counts)
    return (Grade.SLOW if any(map(_slow_cells, atlases)) else Grade.SAME), ""


def kept_in(folder: Path) -> set[str]:
    """Names of the answers in a folder: files without endings."""
    files = [*folder.rglob("*/*.txt"), *(folder / "atlas").glob("*.json")]
    return {file.relative_to(folder).with_suffix("").as_posix() for file in files}


def compare(options: argparse.Namespace) -> int:
    counts: Counter[Grade] = Counter()
    names = [kept_in(folder) for folder in (options.a, options.b)]
    for name in sorted(names[0] | names[1]):
        grade, told = Grade.MISSING, ""
        if name in names[0] & names[1]:
            judge = compare_atlas if name.startswith("atlas/") else compare_answers
            grade, told = judge(options.a / name, options.b / name)
        counts[grade] += 1
        if grade is not Grade.BYTES or options.all:
            print(f"{name}: {grade}")
        for line in told.splitlines():
            print(f"    {line}")
    print(", ".join(f"{counts[grade]} {grade}" for grade in Grade if counts[grade]) or "nothing")
    return 1 if counts[Grade.OTHER] else 0


# --- Times in pairs

# Runs of a command in a round; one that takes longer than LONG seconds is run once.
RUNS = 3
LONG = 2.0
START_UP = ("decompose", "cases/bennett.toml", *FIXED)


def serve() -> int:
    """Run each command that comes in as a line of JSON; its processor time goes out."""
    out, sys.stdout = sys.stdout, io.StringIO()
    for line in sys.stdin:
        began = time.process_time()
        run_command(json.loads(line))
        print(time.process_time() - began, file=out, flush=True)
        sys.stdout.seek(0)
        sys.stdout.truncate()
    return 0


def _environment(checkout: Path) -> dict[str, Any]:
    return {"cwd": checkout, "env": os.environ | {"PYTHONPATH": str(checkout.resolve())}}


@contextlib.contextmanager
def timer(checkout: Path) -> Iterator[Any]:
    """A function that gives the processor time of a command in one process of a checkout."""
    command = [sys.executable, str(Path(__file__).resolve()), "serve"]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, **pipes, **_environment(checkout)) as process:

        def seconds(words: Sequence[str]) -> float:
            assert process.stdin is not None and process.stdout is not None
            process.stdin.write(json.dumps(list(words)) + "\n")
            process.stdin.flush()
            return float(process.stdout.readline())

        yield seconds


def _process_seconds(checkout: Path) -> float:
    began = _children()
    command = [sys.executable, "-m", "nag", *START_UP]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=False, **_environment(checkout))
    return _children() - began


def pair(options: argparse.Namespace) -> int:
    from nag.cli import bench, bench_decompose

    commands = {f"solve benchmarks/{name}": ("solve", f"benchmarks/{name}") for name in bench.NAMES}
    commands |= {f"decompose {name}": ("decompose", name) for name in bench_decompose.NAMES}
    if options.case:
        commands = {name: words for name, words in commands.items() if words[1] in options.case}
    checkouts = (options.old, options.new)
    found: dict[str, tuple[list[float], list[float]]] = {}
    for turn in range(options.rounds):
        # Who is first changes from round to round.
        order = (0, 1) if turn % 2 == 0 else (1, 0)
        for k in order:
            found.setdefault("a process: decompose bennett", ([], []))[k].append(
                _process_seconds(checkouts[k])
            )
        with timer(checkouts[0]) as old, timer(checkouts[1]) as new:
            timers = (old, new)
            for name, (verb, case) in commands.items():
                words = (verb, f"cases/{case}.toml", *FIXED)
                first = [timers[k](words) for k in (0, 1)]
                for _ in range(1 if max(first) > LONG else RUNS):
                    for k in order:
                        found.setdefault(name, ([], []))[k].append(timers[k](words))
    width = max(map(len, found))
    print(f"{'seconds of processor time':<{width}}  least: old    new  ratio  median: old    new")
    ratios = []
    for name, (old_times, new_times) in found.items():
        ratios.append(min(new_times) / min(old_times))
        print(
            f"{name:<{width}}  {min(old_times):10.4f} {min(new_times):6.4f} {ratios[-1]:6.3f}"
            f"  {median(old_times):11.4f} {median(new_times):6.4f}"
        )
    print(f"geometric mean of the ratios {geometric_mean(ratios):.3f}, largest {max(ratios):.3f}")
    return 0


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("keep")
    one.add_argument("folder", type=Path)
    one.add_argument("--case", action="append", help="path below cases/, without .toml")
    one.add_argument("--ask", action="append", choices=tuple(ASKED), help="only this question")
    one.add_argument("--seeds", default="0:3", help="first:last+1")
    one.add_argument("--below", type=float, default=20.0, help="seconds for a question")
    one.add_argument("--jobs", type=int, default=1, help="processes")
    two = commands.add_parser("compare")
    two.add_argument("a", type=Path)
    two.add_argument("b", type=Path)
    two.add_argument("--all", action="store_true", help="list answers of the same bytes as well")
    three = commands.add_parser("pair")
    three.add_argument("old", type=Path)
    three.add_argument("new", type=Path)
    three.add_argument("--case", action="append", help="like benchmarks/katsura-8, or bennett")
    three.add_argument("--rounds", type=int, default=5)
    commands.add_parser("serve")
    return parser.parse_args()


def main() -> int:
    os.environ |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    options = arguments()
    if options.command == "serve":
        return serve()
    return {"keep": keep, "compare": compare, "pair": pair}[options.command](options)


if __name__ == "__main__":
    sys.exit(main())
