"""What is shipped is complete, and what the README and `docs` show is what happens."""

from __future__ import annotations

import importlib
import os
import pkgutil
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import jsonschema
import pytest

import nag
import nag.decomposition
from nag.cli import main
from nag.cli.command_line import COMMANDS, parser
from nag.cli.completion import command_words
from nag.files.export import FORMAT, VERSION
from nag.files.json_schema import schema

ROOT = Path(__file__).parent.parent
PAGES = {
    file.relative_to(ROOT).as_posix(): file.read_text("utf-8")
    for file in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
}
README, COMMAND_PAGE = PAGES["README.md"], PAGES["docs/commands.md"]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


@pytest.mark.parametrize("name", nag.__all__)
def test_public_names_are_there(name: str) -> None:
    assert getattr(nag, name) is not None
    assert name in dir(nag)


def test_unknown_names_are_attribute_errors() -> None:
    with pytest.raises(AttributeError, match="frobnicate"):
        _ = nag.frobnicate


@pytest.mark.parametrize("package", [nag, nag.decomposition], ids=lambda package: package.__name__)
def test_no_public_name_is_that_of_a_module(package: ModuleType) -> None:
    modules = {module.name for module in pkgutil.iter_modules(package.__path__)}
    assert modules
    assert not modules & set(package._HOME)


ALL_NAMES = """
from importlib import import_module
import {package}
for module in {package}._HOME.values():
    import_module(module)
for name, module in {package}._HOME.items():
    found = {{}}
    exec(f"from {package} import {{name}}", found)
    value = getattr(import_module(module), name)
    assert value in (found[name], getattr(found[name], "__wrapped__", None)), name
"""


@pytest.mark.parametrize("package", ["nag", "nag.decomposition"])
def test_names_are_what_their_modules_define_after_these_are_loaded(package: str) -> None:
    code = ALL_NAMES.format(package=package)
    subprocess.run([sys.executable, "-c", code], timeout=60, check=True)


@pytest.mark.parametrize(
    "package",
    [
        "nag",
        "nag.algebra",
        "nag.check",
        "nag.decomposition",
        "nag.files",
        "nag.machine_code",
        "nag.mechanism",
        "nag.numerics",
        "nag.report",
        "nag.solving",
        "nag.symbolic",
        "nag.text",
        "nag.tracking",
        "nag.witness",
    ],
)
def test_packages_load_nothing_heavy(package: str) -> None:
    heavy = {"llvmlite", "scipy", "networkx", "matplotlib", "sympy"}
    code = f"import sys, {package}; print(*sorted({heavy} & set(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout == "\n"


RUN = """
import sys
from nag.cli import main
assert main([*sys.argv[1:], "--quiet"]) == 0
unused |= {"jsonschema", "matplotlib", "mpmath", "networkx", "scipy", "nag.machine_code.functions"}
print("loaded:", *sorted(unused & set(sys.modules)), file=sys.stderr)
"""


# What follows paths, which an answer by algebra alone does not ask for.
TRACKERS = ("nag.machine_code.kernel", "nag.solving.start", "nag.tracking.ends")


@pytest.mark.parametrize(
    ("command", "further"),
    [
        ("decompose cases/bennett.toml", TRACKERS),
        ("solve cases/benchmarks/katsura-6.toml", ()),
    ],
)
def test_a_warm_run_loads_no_library_that_it_does_not_use(
    command: str, further: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    assert main([*command.split(), "--quiet"]) == 0
    done = subprocess.run(
        [sys.executable, "-c", f"unused = set({further}){RUN}", *command.split()],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert done.stderr == "loaded:\n"


def test_schema_is_a_schema_of_the_format_that_is_written() -> None:
    published = schema(FORMAT, VERSION)
    jsonschema.Draft202012Validator.check_schema(published)
    assert published["properties"]["format"]["const"] == FORMAT
    assert published["properties"]["version"]["const"] == VERSION


def test_every_file_that_is_no_module_is_declared_as_package_data() -> None:
    data = PROJECT["tool"]["setuptools"]["package-data"]
    declared = {
        file
        for package, patterns in data.items()
        for pattern in patterns
        for file in ROOT.joinpath(*package.split(".")).glob(pattern)
    }
    there = {
        file
        for file in (ROOT / "nag").rglob("*")
        if file.is_file() and file.suffix != ".py" and "__pycache__" not in file.parts
    }
    assert there == declared


def test_every_folder_of_modules_is_a_package() -> None:
    folders = {file.parent for file in (ROOT / "nag").rglob("*.py")}
    assert [folder for folder in folders if not (folder / "__init__.py").is_file()] == []


def test_every_core_dependency_is_imported_somewhere() -> None:
    source = "\n".join(file.read_text("utf-8") for file in (ROOT / "nag").rglob("*.py"))
    for requirement in PROJECT["project"]["dependencies"]:
        name = requirement.split(">=")[0].removeprefix("python-")
        assert f"import {name}" in source or f"from {name}" in source, name


def test_the_command_is_the_function_main() -> None:
    module, function = PROJECT["project"]["scripts"]["nag"].split(":")
    assert callable(getattr(importlib.import_module(module), function))


def test_the_check_runs_the_commands_of_the_readme() -> None:
    check = ROOT / ".ci" / "run"
    assert os.access(check, os.X_OK)
    script = check.read_text("utf-8").replace(" --quiet", "")
    for line in (
        "python -m pip install . && nag decompose cases/bennett.toml",
        'python -m pip install -e ".[test]" && python -m pytest -n auto --dist loadfile',
    ):
        assert line in README
        for command in line.split(" && "):
            assert f"step {command}\n" in script


def _without_measurements(text: str) -> list[str]:
    """Words of ``text`` without times and rounding errors, which differ between machines."""
    return re.sub(r"\d\.\de[-+]\d\d|\d+\.\d+ s\b", "#", text).split()


def test_the_example_of_the_readme_is_what_is_printed(capsys) -> None:
    command = "$ nag decompose cases/bennett.toml\n"
    block = README.split(command)[1].split("\nHow to read it")[0]
    assert main(["decompose", str(ROOT / "cases" / "bennett.toml"), "--quiet"]) == 0
    printed = capsys.readouterr().out
    assert _without_measurements(block) == _without_measurements(printed)
    # Rounding differs between machines, its order does not; a zero would be one of the exact kind.
    written, found = (
        [float(x) for x in re.findall(r"\d\.\de[-+]\d\d", text)] for text in (block, printed)
    )
    assert len(written) == 2
    assert all(x / 10 < y < 10 * x for x, y in zip(written, found, strict=True))


def test_the_certificate_that_is_shown_is_what_is_printed(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    case = ROOT / "cases" / "benchmarks" / "katsura-8.toml"
    assert "nag solve cases/benchmarks/katsura-8.toml --json solutions.json\n" in COMMAND_PAGE
    assert main(["solve", str(case), "--json", "solutions.json", "--quiet"]) == 0
    capsys.readouterr()
    assert main(["certify", "solutions.json"]) == 0
    printed = capsys.readouterr().out
    block = COMMAND_PAGE.split("    $ nag certify solutions.json\n    ...\n")[1].split("\n\n")[0]
    shown = printed[printed.index("certified ") :]
    assert _without_measurements(block) == _without_measurements(shown)


def test_a_point_of_a_case_is_named_after_the_file(monkeypatch, capsys) -> None:
    monkeypatch.chdir(ROOT)
    (command,) = re.findall(r"`nag (member cases/.*?)`", COMMAND_PAGE)
    assert main([*shlex.split(command), "--quiet"]) == 0
    assert " on it\n" in capsys.readouterr().out


def _blocks(language: str) -> list[tuple[str, str]]:
    """What the pages show in a language, each with the page's name."""
    return [
        (page, block)
        for page, text in PAGES.items()
        for block in re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)
    ]


@pytest.mark.parametrize("text", [block for _, block in _blocks("toml")])
def test_the_cases_that_are_shown_give_what_they_say_is_known(text: str, tmp_path, capsys) -> None:
    file = tmp_path / "case.toml"
    file.write_text(text, encoding="utf-8")
    for _, block in _blocks("xml"):
        name = re.match(r"<!-- (\S+) -->", block)[1]
        (tmp_path / name).write_text(block, encoding="utf-8")
    assert main(["decompose", str(file), "--quiet"]) == 0
    assert re.search(r"^known +agrees with what is known: ", capsys.readouterr().out, re.MULTILINE)


SHOWN = [
    page for page, text in PAGES.items() if re.search(r"```(python|console|macaulay2)\n", text)
]


@pytest.mark.parametrize("page", SHOWN)
def test_the_programs_and_commands_that_are_shown_run(page, tmp_path, monkeypatch, capsys) -> None:
    """In the order of the page; a tutorial is one program, elsewhere each is whole in itself."""
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    space: dict[str, object] = {}
    for language, block in re.findall(r"```(python|console)\n(.*?)```", PAGES[page], re.DOTALL):
        if language == "python":
            space = space if page.startswith("docs/tutorials/") else {}
            exec(compile(block, page, "exec"), space)
            continue
        for command, shown in re.findall(r"^\$ nag (.*)\n((?:(?!\$).*\n)*)", block, re.MULTILINE):
            capsys.readouterr()
            assert main([*shlex.split(command), "--quiet"]) == 0
            printed = " ".join(_without_measurements(capsys.readouterr().out))
            for part in shown.split("...\n"):
                assert " ".join(_without_measurements(part)) in printed


@pytest.mark.parametrize("page", [page for page in SHOWN if "/tutorials/" in page])
def test_tutorials_are_notebooks_that_run(page: str, tmp_path, monkeypatch) -> None:
    pytest.importorskip("jupytext", reason='needs pip install ".[docs]"')
    import nbformat

    monkeypatch.syspath_prepend(ROOT / "docs" / "site")
    write_notebook = importlib.import_module("notebooks").write_notebook
    notebook = nbformat.reads(write_notebook(PAGES[page]), as_version=4)
    nbformat.validate(notebook)
    assert notebook.metadata.kernelspec.name == "python3"
    cells = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    programs = re.findall(r"```python\n(.*?)\n```", PAGES[page], re.DOTALL)
    assert cells == programs
    text = "".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    assert ".md)" not in text and ".md#" not in text
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    space: dict[str, object] = {"__name__": "__main__"}
    for cell in cells:
        exec(compile(cell, page, "exec"), space)


def test_the_website_installs_what_its_tutorials_need() -> None:
    """Which are run while it is built: modules by their imports, others by what asks for them."""
    programs = "".join(text for page, text in PAGES.items() if "/tutorials/" in page)
    needed = {
        name for name in ("matplotlib", "sympy") if re.search(rf"^import {name}", programs, re.M)
    }
    needed |= {"pandas"} if "to_dataframe(" in programs else set()
    extra = PROJECT["project"]["optional-dependencies"]["docs"]
    assert needed == {"matplotlib", "pandas"}
    assert needed <= {re.match(r"[a-z]+", requirement)[0] for requirement in extra}


RATIONAL = PAGES["docs/coming-from/rational-linkages.md"]


@pytest.mark.parametrize("program", re.findall(r"```py\n(.*?)```", RATIONAL, re.DOTALL))
def test_what_is_shown_beside_rational_linkages_runs_where_that_is_installed(
    program: str, capsys, monkeypatch
) -> None:
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    pytest.importorskip("rational_linkages")
    exec(compile(program, "rational-linkages.md", "exec"), {})
    assert re.search("then +a Bennett linkage|moves with 1 freedom", capsys.readouterr().out)


MACAULAY2 = re.findall(r"```macaulay2\n(.*?)```", "\n".join(PAGES.values()), re.DOTALL)


@pytest.mark.skipif(not shutil.which("M2"), reason="needs Macaulay2")
def test_what_is_shown_in_macaulay2_runs(tmp_path) -> None:
    assert MACAULAY2
    file = tmp_path / "shown.m2"
    file.write_text("\n".join(MACAULAY2), encoding="utf-8")
    command = [shutil.which("M2"), "--script", str(file)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr
    assert "| u3-v2 |" in done.stdout


SYSTEMS = re.findall(
    r"```text\n(INPUT\n.*?|CONFIG\n.*?|\d.*?)```",
    "\n".join(text for page, text in PAGES.items() if "coming-from" in page),
    re.DOTALL,
)


@pytest.mark.parametrize("text", SYSTEMS)
def test_systems_that_are_shown_in_other_formats_are_read(text: str, tmp_path) -> None:
    file = tmp_path / "input"
    file.write_text(text, encoding="utf-8")
    assert main(["decompose", str(file), "--quiet"]) == 0


MADE_BY_THE_SITE = ("gallery/index.md", "readme.md")


@pytest.mark.slow
def test_the_website_is_built_and_its_links_lead_somewhere(tmp_path) -> None:
    for needed in ("mkdocs", "material", "mkdocstrings", "jupytext"):
        pytest.importorskip(needed, reason='needs pip install ".[docs]"')
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
    command += ["-f", str(ROOT / "docs" / "site" / "mkdocs.yml"), "-d", str(tmp_path / "site")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    assert done.returncode == 0, done.stdout + done.stderr
    # Prompts of examples are prompts, not quotes in quotes.
    assert 'class="gp"' in (tmp_path / "site" / "reference.html").read_text("utf-8")
    # What stands in a page in place of a link to it.
    built = (tmp_path / "site" / "coming-from" / "bertini.html").read_text("utf-8")
    assert "In nag:" in built and ">In nag</a>" not in built
    missing = []
    for page in (tmp_path / "site").rglob("*.html"):
        if page.name == "404.html":  # shown by a server, in any folder
            continue
        for target in re.findall(r'(?:href|src)="([^"#?:]+)[^":]*"', page.read_text("utf-8")):
            if not (page.parent / target).exists():
                missing.append(f"{page.name}: {target}")
    assert not missing


def _heading_names(text: str) -> set[str]:
    """What links call the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {_heading_name(heading) for heading in headings}


def _heading_name(heading: str) -> str:
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_files_and_headings_that_are_there(page: str) -> None:
    for target in re.findall(r"\]\(([^)]*)\)", PAGES[page]):
        path, _, heading = target.partition("#")
        if path.endswith(MADE_BY_THE_SITE):  # checked where the site is built
            continue
        file = (ROOT / page).parent / path if path else ROOT / page
        assert file.is_file(), target
        if heading:
            assert heading in _heading_names(file.read_text("utf-8")), target


def test_pages_read_well_where_they_are_not_built() -> None:
    """Nothing is left for the website to fill in; what it shows in place, a link leads to."""
    tasks = PAGES["docs/coming-from/tasks.md"]
    headings = re.findall(r"^## (\d\. .*)$", tasks, re.MULTILINE)
    for page, text in PAGES.items():
        prose = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
        assert "{{" not in prose, page
        about = page.removeprefix("docs/coming-from/")
        if f"]({about})" not in tasks:
            continue
        links = re.findall(r"^\[In nag\]\(tasks\.md#(.*)\)$", text, re.MULTILINE)
        assert links == [name for name in map(_heading_name, headings) if name in links], page
        assert len(links) == text.count("[In nag]") >= 4


def test_a_first_reader_is_shown_every_command_and_not_more_than_250_lines() -> None:
    named = re.findall(r"^\| \[`nag (\w+)", README, re.MULTILINE)
    assert sorted(named) == sorted(name for name, _, _ in COMMANDS)
    assert 150 <= README.count("\n") <= 250


@pytest.mark.parametrize("command", [name for name, _, _ in COMMANDS])
def test_every_option_is_told_in_the_pages(command: str) -> None:
    told = "\n".join(PAGES.values())
    (grammar,) = (a for a in parser([command])._actions if a.dest == "command")
    left = [grammar.choices[command]]
    while left:
        for action in left.pop()._actions:
            left += action.choices.values() if isinstance(action.choices, dict) else ()
            for option in action.option_strings:
                assert option in ("-h", "--help") or re.search(rf"{option}\b", told), option


def test_commands_have_the_common_options_that_the_page_says() -> None:
    head, exceptions = COMMAND_PAGE.split("| command | has none of | because |")
    exceptions = exceptions.partition("\n## ")[0]
    option = r"`(--[a-z-]+)"
    rows = [row.split("|")[1] for row in head.splitlines() if row.startswith("| `--")]
    common = {name for row in rows for name in re.findall(option, row)}
    assert len(common) == 14
    lacking = {}
    for row in re.findall(r"^\| `[a-z]+` \|.*", exceptions, re.MULTILINE):
        _, command, lacked, *_ = row.split("|")
        lacking[command.strip(" `")] = set(re.findall(option, lacked))
    (without,) = re.findall(r"^(`init`.*)$", exceptions, re.MULTILINE)
    found = {name: common - set(options) for name, options in command_words().items()}
    none_of_them, listed = re.findall(r"`(\w+)` and `(\w+)`", without)
    assert {name: found.pop(name) for name in none_of_them} == dict.fromkeys(none_of_them, common)
    for name in listed:
        assert found.pop(name)
    assert {name: options for name, options in found.items() if options} == lacking
