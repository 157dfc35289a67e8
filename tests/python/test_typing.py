"""Types: the stubs are current, and mypy --strict accepts the package, its stubs, and the examples."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

import ballflow as bf

SOURCE = Path(__file__).resolve().parent.parent.parent
PACKAGE = SOURCE / "tools" / "python" / "ballflow"


def mypy(*paths, folder):
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--no-error-summary",
         "--cache-dir", str(folder / "mypy"), *map(str, paths)],
        capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)}, cwd=folder,
    )
    return done.stdout + done.stderr


def test_stubs_are_what_the_declarations_say():
    loader = importlib.machinery.SourceFileLoader("make_stubs", str(PACKAGE.parent / "make_stubs"))
    spec = importlib.util.spec_from_loader("make_stubs", loader)
    module = importlib.util.module_from_spec(spec)
    kept = list(sys.path)
    loader.exec_module(module)
    sys.path[:] = kept
    if os.environ.get("BALLFLOW_TEST_ACCEPT"):
        for name, text in module.stubs().items():
            (PACKAGE / name).write_text(text, encoding="utf-8")
        pytest.skip("written")
    for name, text in module.stubs().items():
        assert (PACKAGE / name).read_text(encoding="utf-8") == text, (
            f"{name} is not current: PYTHONPATH=build/release/python tools/python/make_stubs writes it"
        )
    for name in bf.__all__:
        assert name in (PACKAGE / "__init__.pyi").read_text(encoding="utf-8"), f"{name} is not in the stub"


def test_mypy_accepts_the_package_and_the_examples(tmp_path):
    assert mypy(PACKAGE, SOURCE / "docs" / "examples", folder=tmp_path) == ""


def test_mypy_refuses_what_is_wrong(tmp_path):
    (tmp_path / "wrong.py").write_text(
        "import ballflow as bf\n"
        "balls = bf.Balls([[0, 0, 0]], [1])\n"
        "grown = bf.geometry.enlarge(balls, mode='additives')\n"
        "radius: str = balls.radii\n"
        "bf.run('balls', threads='two')\n"
    )
    found = mypy("wrong.py", folder=tmp_path)
    assert [line.split(":")[1] for line in found.splitlines() if "error" in line] == ["3", "4", "5"], found
