"""Every block of docs/python.md and every cell of the notebooks runs."""

from __future__ import annotations

import json
import re
import warnings
from pathlib import Path

import pytest

import ballflow as bf

DOCS = Path(__file__).resolve().parent.parent.parent / "docs"


def run_all(blocks, name):
    namespace = {"__name__": "__main__"}
    for i, block in enumerate(blocks):
        exec(compile(block, f"{name}, block {i + 1}", "exec"), namespace)
    return namespace


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(autouse=True)
def quiet(monkeypatch, cache):
    monkeypatch.setenv("BALLFLOW_CACHE", str(cache))  # one for all: they run the same graphs
    monkeypatch.setattr("webbrowser.open", lambda url: Path(url[len("file://") :]).unlink())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bf.BallflowWarning)
        yield


def test_the_page_about_python():
    blocks = re.findall(r"```python\n(.*?)```", (DOCS / "python.md").read_text(encoding="utf-8"), re.S)
    assert len(blocks) >= 9
    run_all(blocks, "python.md")
    assert Path("out/balls.csv").exists() and Path("grown.json").exists()


@pytest.mark.parametrize("notebook", sorted(DOCS.glob("notebooks/*.ipynb")), ids=lambda path: path.stem)
def test_notebooks(notebook):
    try:
        import matplotlib

        matplotlib.use("Agg")
        drawn = True
    except ImportError:
        drawn = False  # the cells that draw are left out
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    code = [
        "".join(cell["source"])
        for cell in cells
        if cell["cell_type"] == "code" and (drawn or "needs-matplotlib" not in cell["metadata"].get("tags", []))
    ]
    namespace = run_all(code, notebook.name)
    assert len(namespace["sweep"]) == 3 and namespace["run"].status == "ok"
    assert all(not cell["outputs"] for cell in cells if cell["cell_type"] == "code"), "notebooks ship without outputs"
