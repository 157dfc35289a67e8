"""What a function written in Python depends on, as a digest: the part of a node's key that compiled nodes
have from the file of their library.

The digest is the SHA-256 of a set of items, sorted. An item is one of

    function NAME TEXT     the function, and every function of the same file that it names, and so on
    class NAME TEXT        likewise, whole, with what its methods name
    value NAME TEXT        a global, a variable of an enclosing function, or a default that is plain data:
                           None, numbers, texts, bytes, paths, compiled patterns, arrays, and tuples, lists,
                           sets, dicts and dataclasses of these; by content. Or which module, function or class
                           of another module it is
    statement NAME TEXT    the statements of the file that give a name to any other object
    module NAME TEXT       a module of one's own that one of them names (the whole package, if it is in one),
                           and every module of one's own that this imports, and so on

TEXT of code is what ``ast.unparse`` makes of it, so that comments and layout count nowhere. Modules of one's
own are those that are neither in the standard library nor in a folder ``site-packages`` or
``dist-packages``. Installed packages that are named count by their version, Python by its major and minor,
and numpy always: `libraries`. What a function reads at run time (files, the environment, the clock) is not
seen.
"""

from __future__ import annotations

import ast
import dataclasses
import enum
import functools
import hashlib
import importlib.machinery
import importlib.metadata
import importlib.util
import inspect
import json
import linecache
import logging
import os
import sys
import threading
import types
from pathlib import Path
from typing import Any, Optional

import numpy as np

from ._source_text import (
    content_of,
    function_text,
    globals_of,
    imported,
    imports_of,
    normal,
    parsed,
    plain,
    text_of,
    texts,
)


def remember(function: types.FunctionType) -> None:
    """Reads the file of a function, and what it has imported, while they are what Python has just read itself.
    They may be edited afterwards, and what runs is what was read."""
    name = function.__code__.co_filename
    linecache.checkcache(name)
    texts[name] = "".join(linecache.getlines(name, function.__globals__))
    try:
        _Walk(function).function(function)
    except (ValueError, OSError):
        pass  # said when the digest is asked for


_LOCKS = (type(threading.Lock()), type(threading.RLock()))


def _home_of(value: Any, own: str) -> str:
    """The module that a function in C, or what works like one, is an attribute of under its own name; "" where
    it is of none."""
    name = getattr(value, "__name__", None)
    if not callable(value) or not isinstance(name, str):
        return ""
    said = str(getattr(value, "__module__", None))
    homes: list[str] = [
        module
        for module, content in list(sys.modules.items())
        if module not in (own, "__main__") and getattr(content, "__dict__", {}).get(name) is value
    ]
    return said if said in homes else min(homes, default="")


@functools.lru_cache(maxsize=None)
def _version_of(package: str) -> str:
    """Of an installed package, by the name under which it is imported."""
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        pass
    for distribution in importlib.metadata.packages_distributions().get(package, ()):
        return importlib.metadata.version(distribution)
    return str(getattr(sys.modules.get(package), "__version__", "unknown"))


def _installed(origin: str) -> bool:
    return bool({"site-packages", "dist-packages"} & set(Path(origin).parts))


class _Walk:
    def __init__(self, root: types.FunctionType) -> None:
        self.root = root
        self.items: set[tuple[str, str, str]] = set()
        self.libraries = {
            "Python": f"{sys.version_info[0]}.{sys.version_info[1]}",
            "numpy": np.__version__,
        }
        self.seen: set[int] = set()
        self.modules: set[str] = set()
        self.kept: list[Any] = []  # ids in `seen` stay theirs

    def add(self, kind: str, name: str, text: str) -> None:
        self.items.add((kind, name, text))

    def is_new(self, value: Any) -> bool:
        if id(value) in self.seen:
            return False
        self.seen.add(id(value))
        self.kept.append(value)
        return True

    def function(self, function: types.FunctionType) -> None:
        if not self.is_new(function):
            return
        text = function_text(function)
        self.add("function", function.__qualname__, text)
        names = globals_of(function.__code__)
        tree = parsed(text)
        if tree is not None:
            for name in imports_of(tree, str(function.__globals__.get("__package__") or "")):
                self.module(name)
            for statement in tree.body:  # decorators are outside of the code of the function
                for decorator in getattr(statement, "decorator_list", ()):
                    names |= {node.id for node in ast.walk(decorator) if isinstance(node, ast.Name)}
        self.names(names, function.__globals__)
        cells = zip(function.__code__.co_freevars, function.__closure__ or ())
        for name, cell in cells:
            try:
                self.value(name, cell.cell_contents, function.__globals__)
            except ValueError as problem:
                if "empty" not in str(problem):
                    raise
        defaults = [*(function.__defaults__ or ()), *(function.__kwdefaults__ or {}).values()]
        for index, value in enumerate(defaults):
            self.value(f"{function.__qualname__}.default.{index}", value, function.__globals__)
        wrapped = getattr(function, "__wrapped__", None)
        if isinstance(wrapped, types.FunctionType):
            self.value(function.__qualname__, wrapped, function.__globals__)

    def names(self, names: set[str], scope: dict[str, Any]) -> None:
        for name in sorted(names):
            if name in scope:
                self.value(name, scope[name], scope)

    def value(self, name: str, value: Any, scope: dict[str, Any]) -> None:
        text = plain(value)
        if text is not None:
            self.add("value", name, text)
            return
        if isinstance(value, types.ModuleType):
            self.add("value", name, f"module {value.__name__}")
            self.module(value.__name__)
            return
        if hasattr(value, "_ballflow_function"):  # another node
            self.value(name, value._ballflow_function, scope)
            return
        if isinstance(value, (staticmethod, classmethod)):
            self.value(name, value.__func__, scope)
            return
        if isinstance(value, property):
            for part in (value.fget, value.fset, value.fdel):
                if part is not None:
                    self.value(name, part, scope)
            return
        if isinstance(value, types.FunctionType):
            if value.__globals__ is self.root.__globals__:
                self.function(value)
            else:
                self.of_other_module(name, value, scope)
            return
        if isinstance(value, type):
            if value.__module__ == self.root.__module__:
                self.class_(value)
            else:
                self.foreign(name, value)
            return
        if not self.is_new(value):
            return
        if isinstance(value, types.MethodType):
            self.value(name, value.__func__, scope)
            self.value(name, value.__self__, scope)
            return
        if isinstance(value, functools.partial):
            parts = [value.func, *value.args, *(x for item in sorted(value.keywords.items()) for x in item)]
            for index, part in enumerate(parts):
                self.value(f"{name}.{index}", part, scope)
            return
        if isinstance(value, (list, tuple, set, frozenset)):
            for index, part in enumerate(value):
                self.value(f"{name}.{index}", part, scope)
            return
        if isinstance(value, dict):
            for key, part in value.items():
                self.value(f"{name}.{key}", part, scope)
            return
        for wrapped in ("__wrapped__", "py_func"):  # functools.lru_cache, compilers of functions
            inner = getattr(value, wrapped, None)
            if isinstance(inner, types.FunctionType):
                self.module(type(value).__module__)
                self.value(name, inner, scope)
                return
        self.object(name, value, scope)

    def foreign(self, name: str, value: Any) -> None:
        """A function or class of another module: which, and its module."""
        self.add("value", name, f"{value.__module__}.{value.__qualname__}")
        self.module(value.__module__ or "")

    def of_other_module(self, name: str, function: types.FunctionType, scope: dict[str, Any]) -> None:
        """Its module counts as a whole; but a decorator that came from there holds a function of ours."""
        self.foreign(name, function)
        if not self.is_new(function):
            return
        if (function.__module__ or "").partition(".")[0] == "ballflow":
            return
        for cell in function.__closure__ or ():
            try:
                inner = cell.cell_contents
            except ValueError:  # not filled yet
                continue
            if isinstance(inner, types.FunctionType) or plain(inner) is not None:
                self.value(name, inner, scope)  # anything else belongs to that module

    def class_(self, cls: type) -> None:
        if not self.is_new(cls):
            return
        scope = self.root.__globals__
        for base in cls.__bases__:
            self.value(base.__name__, base, scope)
        methods = [member for member in vars(cls).values() if isinstance(member, types.FunctionType)]
        files = {self.root.__code__.co_filename, *(method.__code__.co_filename for method in methods)}
        found = False
        for filename in sorted(files):
            tree = parsed(text_of(filename, scope))
            for node in ast.walk(tree) if tree is not None else ():
                if not isinstance(node, ast.ClassDef) or node.name != cls.__name__:
                    continue
                found = True
                self.add("class", cls.__qualname__, ast.unparse(node))
                self.names({inner.id for inner in ast.walk(node) if isinstance(inner, ast.Name)}, scope)
                for name in imports_of(node, str(scope.get("__package__") or "")):
                    self.module(name)
        if found:
            return
        for name, member in vars(cls).items():  # made at a prompt, or by a function
            if not name.startswith("__") or isinstance(member, types.FunctionType):
                self.value(f"{cls.__qualname__}.{name}", member, scope)

    def is_known(self, name: str, value: Any, scope: dict[str, Any]) -> bool:
        """Objects of which something better is known than who made them."""
        if isinstance(value, enum.Enum):
            self.add("value", name, f"{type(value).__qualname__}.{value.name}")
            self.value(type(value).__name__, type(value), scope)
        elif isinstance(value, types.SimpleNamespace) or dataclasses.is_dataclass(value):
            for field, part in sorted(vars(value).items()):
                self.value(f"{name}.{field}", part, scope)
            self.value(type(value).__name__, type(value), scope)
        elif type(value).__module__ == "typing" or isinstance(value, (logging.Logger, *_LOCKS)):
            pass  # no result depends on it
        else:
            home = _home_of(value, self.root.__module__)
            if not home:
                return False
            self.add("value", name, f"{home.partition('.')[0]}.{value.__name__}")
            self.module(home)
            for statement in self.statements_of(name, scope):
                self.add("statement", name, ast.unparse(statement))
        return True

    def statements_of(self, name: str, scope: dict[str, Any]) -> list[ast.stmt]:
        """The statements of the file of the node that give something to a global name."""
        statements: list[ast.stmt] = []
        tree = parsed(text_of(self.root.__code__.co_filename, self.root.__globals__))
        if scope is not self.root.__globals__ or tree is None:
            return statements
        for statement in tree.body:
            if isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
                continue
            inner = list(ast.walk(statement))
            bound = {node.id for node in inner if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
            for node in inner:
                if isinstance(node, (ast.Import, ast.ImportFrom)):
                    bound |= {alias.asname or alias.name.partition(".")[0] for alias in node.names}
            if name in bound:
                statements.append(statement)
        return statements

    def object(self, name: str, value: Any, scope: dict[str, Any]) -> None:
        """Neither code nor data: the statements that make it count, and the module of its class."""
        if self.is_known(name, value, scope):
            return
        self.module(type(value).__module__)
        statements = self.statements_of(name, scope)
        if not statements:
            raise ValueError(
                f"{self.root.__name__} uses {name}, a {type(value).__name__}, and nothing says what it is made "
                "of, so it cannot be part of the key: make it inside the function, or in the file of the function"
            )
        for statement in statements:
            self.add("statement", name, ast.unparse(statement))
            used = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
            self.names(used - {name}, self.root.__globals__)
            for imported_name in imports_of(statement, str(scope.get("__package__") or "")):
                self.module(imported_name)

    def module(self, name: str) -> None:
        top = name.partition(".")[0]
        if not name or name in self.modules or top in ("ballflow", "builtins", "__main__", "__future__"):
            return
        self.modules.add(name)
        if top in sys.stdlib_module_names or name == self.root.__module__:
            return
        spec = self._spec(name)
        if spec is None:
            return
        places = [spec.origin] if spec.has_location and spec.origin else list(spec.submodule_search_locations or ())
        if not places or any(_installed(place) for place in places):
            if top != "numpy":
                self.libraries[top] = _version_of(top)
            return
        top_spec = spec if top == name else self._spec(top)
        if top_spec is not None and top_spec.submodule_search_locations is not None and top_spec.origin:
            for folder in top_spec.submodule_search_locations:
                for path in sorted(Path(folder).rglob("*")):
                    if path.suffix in (".py", *importlib.machinery.EXTENSION_SUFFIXES):
                        inner = path.relative_to(folder).parts
                        self.file("/".join([top, *inner]), ".".join([top, *inner[:-1]]), path, top_spec)
        elif spec.origin:
            self.file(f"{name}{Path(spec.origin).suffix}", name.rpartition(".")[0], Path(spec.origin), spec)

    @staticmethod
    def _spec(name: str) -> Optional[importlib.machinery.ModuleSpec]:
        spec: Optional[importlib.machinery.ModuleSpec] = getattr(sys.modules.get(name), "__spec__", None)
        if spec is not None:
            return spec  # another one after a reload
        try:
            return importlib.util.find_spec(name)
        except (ImportError, ValueError, AttributeError):
            return None  # an attribute, not a module; or what fails when it is imported

    def file(self, name: str, package: str, path: Path, spec: importlib.machinery.ModuleSpec) -> None:
        """A file of a module of one's own, and what it imports."""
        content = content_of(path, spec)
        if path.suffix != ".py":
            self.add("module", name, hashlib.sha256(content).hexdigest())
            return
        self.add("module", name, normal(content))
        try:
            tree = ast.parse(content)
        except (SyntaxError, ValueError):
            return
        for imports in imports_of(tree, package):
            self.module(imports)


def digest(function: types.FunctionType, version: int) -> tuple[str, dict[str, str]]:
    """Of a function with what it names: 64 hexadecimal digits, and the installed libraries that it uses, by
    version. Raises ValueError where something that it names cannot be part of a key."""
    walk = _Walk(function)
    walk.function(function)
    text = json.dumps(["ballflow python node 1", version, sorted(walk.items)], ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest(), dict(sorted(walk.libraries.items()))


def is_interactive(function: types.FunctionType) -> bool:
    """Whether its file may grow while its module lives: a notebook, a prompt."""
    return not os.path.isfile(function.__code__.co_filename)


def location(function: Any) -> str:
    """Where a function is, for messages: "my_nodes.py:12"."""
    code = inspect.unwrap(function).__code__
    return f"{os.path.basename(code.co_filename)}:{code.co_firstlineno}"
