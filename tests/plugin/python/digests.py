"""What the digest of a node in Python follows: digests.py PACKAGE FOLDER, with the package of ballflow."""

from __future__ import annotations

import importlib.util
import itertools
import sys
import textwrap
import unittest
from pathlib import Path
from typing import Any

spec = importlib.util.spec_from_file_location("_worker", Path(sys.argv[1]) / "_worker.py")
assert spec is not None and spec.loader is not None
worker: Any = importlib.util.module_from_spec(spec)
spec.loader.exec_module(worker)
sys.path.insert(0, "")  # the place of the file's folder
worker.make_package()
from ballflow import _artifact, _node, _source  # noqa: E402

FOLDER = Path(sys.argv[2])
ARRAYS = [
    {"name": "centers", "dtype": "f64", "shape": ["n", 3], "doc": ""},
    {"name": "radii", "dtype": "f64", "shape": ["n"], "doc": ""},
]
_artifact.declare([{"id": "Balls", "version": 1, "doc": "", "arrays": ARRAYS, "summary": []}])
numbers = itertools.count()

START = """
import ballflow as bf
import functools, os, math
import numpy as np
import helpers
from numpy.linalg import norm as length
from package import inner

def used(x):
    return deeper(x)

def deeper(x):
    return x + 1

def unused(x):
    return x

LIMIT = 3.0
TABLE = {"a": [1, 2], "b": np.arange(3)}
OTHER = 5

class Model:
    scale = 2.0
    def apply(self, x):
        return in_class(x) * self.scale

def in_class(x):
    return x

model = Model()

def decorate(f):
    @functools.wraps(f)
    def wrapper(*a):
        return f(*a)
    return wrapper

@decorate
def decorated(x):
    return x

def outer(k):
    def closed(x):
        return x * k
    return closed

closed = outer(4)

add = np.add
power = functools.partial(math.pow, 3.0)
vector = np.vectorize(lambda x: x + 10)

@functools.lru_cache(maxsize=None)
def cached(x):
    return x

@bf.node
def N(count: int = 1) -> bf.Balls:
    "What it does."
    import late
    f = [used(y) for y in range(LIMIT)]
    add(cached(power(vector(length(1)))), 2)
    return model.apply(helpers.go(inner.go(decorated(closed(TABLE["a"])))))
"""
HELPERS = "import more\ndef go(x):\n    return more.on(x)\n"


class Digests(unittest.TestCase):
    def setUp(self) -> None:
        self.files = {
            "helpers.py": HELPERS,
            "more.py": "def on(x):\n    return x\n",
            "late.py": "Y = 1\n",
            "unnamed.py": "Z = 1\n",
            "package/__init__.py": "",
            "package/inner.py": "from . import sibling\ndef go(x):\n    return sibling.K\n",
            "package/sibling.py": "K = 1\n",
        }
        self.before = self.digest(START)

    def digest(self, source: str, name: str = "N", **files: str) -> str:
        folder = FOLDER / str(next(numbers))
        changed = {key.replace("__", "/").replace("_py", ".py"): value for key, value in files.items()}
        for file, content in {**self.files, **changed, "my_nodes.py": source}.items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_text(content)
        for module in ("my_nodes", "helpers", "more", "late", "package", "package.inner", "package.sibling"):
            sys.modules.pop(module, None)
        _node._registered.clear()
        return str(worker.load(str(folder / "my_nodes.py"))[name].digest)

    def follows(self, what: str, by: str) -> None:
        self.assertIn(what, START)
        self.assertNotEqual(self.digest(START.replace(what, by)), self.before, f"{what} -> {by}")

    def ignores(self, what: str, by: str) -> None:
        self.assertIn(what, START)
        self.assertEqual(self.digest(START.replace(what, by)), self.before, f"{what} -> {by}")

    def test_it_is_the_same_in_another_folder(self) -> None:
        self.assertEqual(self.digest(START), self.before)
        self.assertRegex(self.before, "^[0-9a-f]{64}$")

    def test_functions_that_are_called(self) -> None:
        self.follows("return deeper(x)", "return deeper(x) * 1")
        self.follows("return x + 1", "return x + 2")
        self.follows("def in_class(x):\n    return x", "def in_class(x):\n    return -x")
        self.follows("@decorate\ndef decorated(x):\n    return x", "@decorate\ndef decorated(x):\n    return 0")
        self.follows("        return f(*a)", "        return 2 * f(*a)")
        self.follows("        return x * k", "        return x / k")
        self.ignores("def unused(x):\n    return x", "def unused(x):\n    return 7")

    def test_comments_and_layout(self) -> None:
        self.ignores("    return x + 1", "    # why\n\n    return (x +\n        1)")
        self.ignores("def used(x):", "# moves everything below\n\n\ndef used(x):")
        self.follows('"What it does."', '"What it did."')

    def test_data(self) -> None:
        self.follows("LIMIT = 3.0", "LIMIT = 3.5")
        self.ignores("LIMIT = 3.0", "LIMIT = 1.5 * 2")
        self.follows('"a": [1, 2]', '"a": [1, 3]')
        self.follows("np.arange(3)", "np.arange(4)")
        self.follows("closed = outer(4)", "closed = outer(5)")
        self.ignores("OTHER = 5", "OTHER = 6")

    def test_classes_and_objects(self) -> None:
        self.follows("    scale = 2.0", "    scale = 3.0")
        self.follows("model = Model()", "model = [Model()][0]")

    def test_names_for_what_is_elsewhere(self) -> None:
        self.follows("add = np.add", "add = np.subtract")
        self.follows("norm as length", "det as length")
        self.follows("math.pow, 3.0", "math.pow, 4.0")
        self.follows("math.pow, 3.0", "math.atan2, 3.0")
        self.follows("lambda x: x + 10", "lambda x: x + 11")
        self.follows("def cached(x):\n    return x", "def cached(x):\n    return 2")

    def test_modules_of_ones_own(self) -> None:
        self.assertEqual(self.digest(START, helpers_py=HELPERS + "# more\n"), self.before)
        self.assertEqual(self.digest(START, unnamed_py="Z = 2\n"), self.before)
        for file, content in {
            "helpers_py": HELPERS + "W = 1\n",
            "more_py": "def on(x):\n    return -x\n",
            "late_py": "Y = 2\n",
            "package__sibling_py": "K = 2\n",
        }.items():
            self.assertNotEqual(self.digest(START, **{file: content}), self.before, file)

    def test_installed_packages_and_python_are_libraries(self) -> None:
        self.digest(START)
        libraries = worker.load.__globals__["sys"].modules["my_nodes"].N.declaration["libraries"]
        self.assertEqual(libraries["Python"], f"{sys.version_info[0]}.{sys.version_info[1]}")
        self.assertEqual(set(libraries), {"Python", "numpy"})

    def test_version(self) -> None:
        self.follows("@bf.node\ndef N", "@bf.node(version=2)\ndef N")

    def test_what_cannot_be_told_is_refused(self) -> None:
        scope: dict[str, Any] = {"bf": sys.modules["ballflow"], "np": worker.__dict__}
        source = "import random\nrng = random.Random(1)\n"
        exec(compile(source, "<cell 1>", "exec"), scope)
        cell = "@bf.node\ndef R() -> bf.Balls:\n    return rng.random()\n"
        exec(compile(cell, "<cell 2>", "exec"), scope)
        with self.assertRaisesRegex(ValueError, "R uses rng, a Random, and nothing says what it is made of"):
            scope["R"].digest
        # In a file the statement says it.
        self.digest(START + textwrap.dedent(source) + cell, "R")

    def test_classes_of_cells_count_by_what_they_hold(self) -> None:
        scope: dict[str, Any] = {"bf": sys.modules["ballflow"], "__name__": "__main__"}
        digests = set()
        for scale in (1, 1, 2):
            exec(f"class Config:\n    scale = {scale}\n", scope)
            exec("@bf.node\ndef C() -> bf.Balls:\n    return Config.scale\n", scope)
            digests.add(scope["C"].digest)
        self.assertEqual(len(digests), 2)

    def test_a_cell_that_runs_again_counts(self) -> None:
        scope: dict[str, Any] = {"bf": sys.modules["ballflow"]}
        exec("def helper(x):\n    return 1\n", scope)
        exec("@bf.node\ndef C() -> bf.Balls:\n    return helper(1)\n", scope)
        first = scope["C"].digest
        self.assertEqual(scope["C"].digest, first)
        exec("def helper(x):\n    return 2\n", scope)
        self.assertNotEqual(scope["C"].digest, first)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
