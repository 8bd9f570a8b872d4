"""What the website shows that is made while it is built: tutorials' outputs, pictures, gallery.

`NAG_GALLERY_SECONDS` (60 by default) bounds the time for motions that are not kept from an earlier
build; mechanisms that it does not reach are shown by the graph of bodies and joints.
"""

from __future__ import annotations

import ast
import base64
import contextlib
import io
import os
import re
import sys
import tempfile
import tomllib
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).resolve().parents[2]
OURS = [str(ROOT), str(ROOT / "docs" / "site")]
sys.path[:0] = OURS

from mechanism_pictures import make_all  # noqa: E402
from notebooks import write_notebook  # noqa: E402

CASES = sorted(
    (path, table)
    for path in ROOT.glob("cases/**/*.toml")
    if (table := tomllib.loads(path.read_text("utf-8")))["kind"] != "system"
)
# Lines that lead to what a page of the website has in their place.
_TASK_LINK = re.compile(r"^\[In nag\]\(tasks\.md#(\d)-[^)]*\)$", re.MULTILINE)
_NAMES_LINK = re.compile(r"^\[All public names\]\([^)]*\).*$", re.MULTILINE)
FOLDERS = {
    "": "The papers' mechanisms",
    "planar": "In the plane",
    "spherical": "On the sphere",
    "spatial": "In space",
    "shaky": "Shaky structures",
    "robots": "Parallel robots",
    "mobility": "Too large to decompose",
    "benchmarks": "Benchmarks",
    "hard": "Hard ones",
    "literature": "From the literature",
}


def _of_gallery(config: Any) -> list[File]:
    seconds = float(os.environ.get("NAG_GALLERY_SECONDS", "60"))
    # The tour shows that one.
    first = ROOT / "cases" / "bennett.toml"
    made = make_all([path for path, _ in CASES], first, seconds)
    files, cards = [], dict[str, list[str]]()
    for (path, table), (picture, page) in zip(CASES, made, strict=True):
        relative = path.relative_to(ROOT / "cases")
        folder = "" if len(relative.parts) == 1 else relative.parts[0]
        # The folders are kept: `planar-four-bar` and `planar/four-bar` are two mechanisms.
        name, stem = relative.with_suffix("").as_posix(), path.stem
        text = [f"# {table['title']}", ""]
        if picture:
            files.append(File.generated(config, f"gallery/{name}.svg", abs_src_path=str(picture)))
        if page:
            files.append(
                File.generated(config, f"gallery/{name}-moves.html", abs_src_path=str(page))
            )
            text += [
                f'<iframe src="{stem}-moves.html" loading="lazy" title="it moves"></iframe>',
                "",
                f"[The page by itself]({stem}-moves.html): drag a link, or choose a circuit.",
                "",
            ]
        case = f"cases/{relative.as_posix()}"
        asked = "modes" if folder == "robots" else "decompose"
        text += ["```console", f"$ nag {'mobility' if folder == 'mobility' else asked} {case}"]
        text += [f"$ nag motion {case} --html moves.html"] if page else []
        text += ["```", ""]
        known = [t for t in table.get("truth", {}).get("component", []) if "dimension" in t]
        if known:
            text += ["| dimension | degree | count | known from |", "| --- | --- | --- | --- |"]
            text += [
                f"| {t['dimension']} | {t.get('degree', '')} | {t.get('count', 1)} "
                f"| {t.get('source', '')} |"
                for t in known
            ]
            text.append("")
        if picture:
            text += [f"![bodies and joints]({stem}.svg)", ""]
        text += ["The case:", "", "```toml", path.read_text("utf-8").rstrip(), "```", ""]
        files.append(File.generated(config, f"gallery/{name}.md", content="\n".join(text)))
        shown = f'<img src="{name}.svg" alt="" loading="lazy">' if picture else ""
        moves = "&#9654; " if page else ""
        cards.setdefault(folder, []).append(
            f'<a href="{name}.html">{shown}{moves}{table["title"]}</a>'
        )
    text = [
        "# Gallery",
        "",
        f"All {len(CASES)} mechanisms that ship, in `cases/`. Pictures are the graphs of bodies "
        "and joints, as `nag plot --graph` draws them. Those with &#9654; move on their page.",
        "",
    ]
    for folder, title in ((f, t) for f, t in FOLDERS.items() if f in cards):
        text += [f"## {title}", "", '<div class="gallery">', *cards[folder], "</div>", ""]
    assert set(cards) <= set(FOLDERS), "a folder of cases has no heading in the gallery"
    files.append(File.generated(config, "gallery/index.md", content="\n".join(text)))
    return files


def _of_tutorials(config: Any) -> list[File]:
    """The tutorials as notebooks, to be opened in Jupyter."""
    return [
        File.generated(
            config, f"tutorials/{path.stem}.ipynb", content=write_notebook(path.read_text("utf-8"))
        )
        for path in sorted((ROOT / "docs" / "tutorials").glob("*.md"))
    ]


def on_files(files: Files, config: Any) -> Files:
    """Add what is made to what is written."""
    # Mkdocs takes back what a hook changes of the path when it is loaded; processes ask for it.
    sys.path[:0] = OURS
    readme = (ROOT / "README.md").read_text("utf-8").replace("](docs/", "](")
    made = [File.generated(config, "readme.md", content=readme)]
    for chart in sorted((ROOT / "nag" / "bench" / "charts").glob("*.png")):
        made.append(File.generated(config, f"charts/{chart.name}", abs_src_path=str(chart)))
    for file in [*made, *_of_gallery(config), *_of_tutorials(config)]:
        files.append(file)
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Links out of `docs` lead to what was added; tutorials show what their blocks print."""
    uri = Path(page.file.src_uri)
    markdown = markdown.replace("](../README.md", "](readme.md")
    markdown = markdown.replace("](../nag/bench/charts/", "](charts/")
    if uri.name == "reference.md":
        return _NAMES_LINK.sub(lambda _: _public_names(), markdown)
    if uri.parts[0] == "tutorials":
        head, _, rest = markdown.partition("\n\n")
        note = f"[As a notebook, for Jupyter]({uri.stem}.ipynb){{ download }}"
        return f"{head}\n\n{note}\n\n{_executed(rest)}"
    if uri.parts[0] == "coming-from":
        tasks = (ROOT / "docs" / "coming-from" / "tasks.md").read_text("utf-8")
        ours = dict(
            re.findall(r"^## (\d)\..*?\n\n(.*?)\n(?=## |\Z)", tasks, re.DOTALL | re.MULTILINE)
        )
        return _TASK_LINK.sub(lambda match: f"In nag:\n\n{ours[match[1]]}", markdown)
    return markdown


def _public_names() -> str:
    """Where mkdocstrings finds each public name: they are imported on first use."""
    import nag

    kinds: dict[str, list[str]] = {"Functions": [], "Types": [], "Errors": []}
    for name, module in sorted(nag._HOME.items()):
        value = getattr(nag, name)
        if not isinstance(value, type):
            kind = "Functions"
        else:
            kind = "Errors" if issubclass(value, Exception) else "Types"
        options = f"    options:\n      heading: nag.{name}\n      toc_label: {name}\n"
        kinds[kind].append(f"::: {module}.{name}\n{options}")
    return "\n".join(f"## {kind}\n\n" + "\n".join(each) for kind, each in kinds.items())


def _executed(markdown: str) -> str:
    """A page with the output of each of its programs beneath it."""
    import matplotlib

    matplotlib.use("agg")
    space: dict[str, Any] = {"__name__": "tutorial"}

    def with_output(match: re.Match[str]) -> str:
        return match[0] + _output(match[1], space)

    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / "cases").symlink_to(ROOT / "cases")
        with contextlib.chdir(scratch):
            return re.sub(r"```python\n(.*?)```", with_output, markdown, flags=re.DOTALL)


def _output(program: str, space: dict[str, Any]) -> str:
    """What a program prints, the value of its last line, and what it draws, as Markdown."""
    from matplotlib import pyplot

    tree = ast.parse(program)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    written = io.StringIO()
    with contextlib.redirect_stdout(written):
        exec(compile(tree, "tutorial", "exec"), space)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "tutorial", "eval"), space)
            if value is not None and not isinstance(value, int):
                print(repr(value))
    text = written.getvalue().rstrip()
    shown = f'\n\n```text title="prints"\n{text}\n```' if text else ""
    for number in pyplot.get_fignums():
        picture = io.BytesIO()
        pyplot.figure(number).savefig(picture, format="svg", metadata={"Date": None})
        pyplot.close(number)
        data = base64.b64encode(picture.getvalue()).decode()
        shown += f"\n\n![what it draws](data:image/svg+xml;base64,{data})"
    return shown
