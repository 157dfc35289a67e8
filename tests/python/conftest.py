"""Fixtures: a cache of the test's own, the command line program, and the package as it was built."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import ballflow as bf
from ballflow import _session


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Tests run where there is no checkout, and touch no cache but theirs."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BALLFLOW_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("BALLFLOW_PLUGIN_PATH", raising=False)
    monkeypatch.setenv("BALLFLOW_PYTHON", sys.executable)
    return tmp_path


@pytest.fixture
def program():
    """Runs the program; returns what it prints."""

    def run(*arguments, code=0):
        done = subprocess.run([str(_session.program()), *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        return done.stdout

    return run


@pytest.fixture
def balls():
    return bf.Balls([[0, 0, 0], [1.5, 0, 0]], [1.0, 1.0])


@pytest.fixture
def box():
    """Vertices (8 x 3) and triangles (12 x 3) of a box of 2 x 1 x 1."""
    vertices = np.array([[x, y, z] for x in (0, 2) for y in (0, 1) for z in (0, 1)], dtype=float)
    triangles = np.array(
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
        + [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    )
    return vertices, triangles


def in_child(code: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Runs a program of its own with the package on its path."""
    path = os.pathsep.join([str(Path(bf.__file__).parent.parent), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "PYTHONPATH": path, **variables},
    )
